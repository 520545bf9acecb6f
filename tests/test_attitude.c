/* Directions and attitude laws: closed forms, reference values, and properties of every law. */
#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/attitude.h"
#include "table.h"
#include "testing.h"

/* ------------------------------------------------------------------ helpers */

/* Rounding of a few dozen operations on numbers of size 1. */
static const double rounding = 1e-14;

/* Uniform in -1..1, the same sequence on every machine (Knuth's MMIX generator). */
static double next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(int64_t)(*state >> 11) / 4503599627370496.0 - 1.0;
}

static void random_unit(uint64_t *state, double out[3])
{
    double v[3];
    do {
        for (int i = 0; i < 3; i++)
            v[i] = next_random(state);
    } while (norm3(v) > 1.0 || norm3(v) < 0.1);
    unit3(v, out);
}

static void random_rotation(uint64_t *state, double out[9])
{
    double axis[3];
    random_unit(state, axis);
    mat_turn(axis, PI * next_random(state), out);
}

/* A satellite on some orbit, with everything in sight. */
static moment random_moment(uint64_t *state)
{
    moment m = {.t_s = 1000.0 * next_random(state)};
    double r[3], v[3];
    random_unit(state, r);
    do
        random_unit(state, v);
    while (fabs(dot3(r, v)) > 0.9);
    scale3(r, 7e6, m.r_m);
    scale3(v, 7.5e3, m.v_m_s);
    random_unit(state, m.sun);
    random_unit(state, m.moon);
    random_unit(state, m.observer);
    random_rotation(state, m.itrs_gcrs);
    return m;
}

/* The same moment seen in axes that are turned: every vector becomes q v. */
static moment turned_moment(const moment *m, const double q[9])
{
    moment out = {.t_s = m->t_s};
    double q_transposed[9];
    mat_vec(q, m->r_m, out.r_m);
    mat_vec(q, m->v_m_s, out.v_m_s);
    mat_vec(q, m->sun, out.sun);
    mat_vec(q, m->moon, out.moon);
    mat_vec(q, m->observer, out.observer);
    mat_transpose(q, q_transposed);
    mat_mul(m->itrs_gcrs, q_transposed, out.itrs_gcrs);
    return out;
}

static void assert_vec_near(const double got[3], double x, double y, double z, double tol)
{
    assert_near(got[0], x, tol);
    assert_near(got[1], y, tol);
    assert_near(got[2], z, tol);
}

static void assert_mat_near(const double got[9], const double want[9], double tol)
{
    for (int i = 0; i < 9; i++)
        assert_near(got[i], want[i], tol);
}

static void assert_rotation(const double r[9])
{
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    double transposed[9], product[9], z[3];
    mat_transpose(r, transposed);
    mat_mul(r, transposed, product);
    assert_mat_near(product, one, rounding);
    cross3(r, r + 3, z);
    assert_vec_near(r + 6, z[0], z[1], z[2], rounding);
}

static direction word(const char *name)
{
    direction d;
    ck_assert_msg(direction_from_word(name, &d), "no direction '%s'", name);
    return d;
}

static direction star(double ra_deg, double dec_deg)
{
    direction d;
    direction_star(ra_deg * DEG, dec_deg * DEG, &d);
    return d;
}

/* Each key in a place of its own: line 10 + its position. The law stands in line 3. */
static attitude_spec start_law(const char *name)
{
    const attitude_law *law = attitude_law_named(name);
    ck_assert_msg(law != NULL, "no law '%s'", name);
    attitude_spec spec;
    attitude_spec_start(law, (place){"scenario.toml", 3, 1}, &spec);
    for (int k = 0; k < law->n_keys; k++)
        spec.key_place[k].line = 10 + k;
    return spec;
}

static int key_of(attitude_spec *spec, const char *name)
{
    const int k = attitude_key_index(spec->law, name);
    ck_assert_msg(k >= 0, "no key '%s'", name);
    spec->given[k] = true;
    return k;
}

static void set_number(attitude_spec *spec, const char *name, double value)
{
    const int k = key_of(spec, name);
    spec->value[k][0] = value;
}

static void set_axis(attitude_spec *spec, const char *name, double x, double y, double z)
{
    const int k = key_of(spec, name);
    unit3((const double[3]){x, y, z}, spec->value[k]);
}

static void set_direction(attitude_spec *spec, const char *name, direction d)
{
    const int k = key_of(spec, name);
    spec->to[k] = d;
}

static void set_quaternion(attitude_spec *spec, const double q[4])
{
    const int k = key_of(spec, "quaternion_wxyz");
    memcpy(spec->value[k], q, 4 * sizeof *q);
}

static void set_offset(attitude_spec *spec, double x, double y, double z, double angle_deg)
{
    spec->has_offset = true;
    unit3((const double[3]){x, y, z}, spec->offset_axis);
    spec->offset_rad = angle_deg * DEG;
}

static attitude prepared(const attitude_spec *spec)
{
    attitude a;
    glint_errors *errors = glint_errors_new();
    const glint_status status = attitude_prepare(spec, &a, errors);
    const glint_error *first = glint_errors_get(errors, 0);
    ck_assert_msg(status == GLINT_OK, "%s", first ? first->message : "no message");
    ck_assert_uint_eq(glint_errors_count(errors), 0);
    glint_errors_free(errors);
    return a;
}

static void evaluate(const attitude *a, const moment *m, double body_gcrs[9])
{
    glint_error error = {0};
    ck_assert_msg(attitude_at(a, m, body_gcrs, &error) == GLINT_OK, "%s", error.message);
}

static attitude_spec point_spec(const double axis[3], direction to, const double second_axis[3],
                                direction second_to)
{
    attitude_spec spec = start_law("point");
    set_axis(&spec, "axis", axis[0], axis[1], axis[2]);
    set_direction(&spec, "to", to);
    set_axis(&spec, "second_axis", second_axis[0], second_axis[1], second_axis[2]);
    set_direction(&spec, "second_to", second_to);
    return spec;
}

static attitude_spec spin_spec(double x, double y, double z, direction pole, double rate_deg_s)
{
    attitude_spec spec = start_law("spin");
    set_axis(&spec, "body_axis", x, y, z);
    set_direction(&spec, "pole", pole);
    set_number(&spec, "rate_deg_s", rate_deg_s);
    return spec;
}

/* A spec of any law in the table, filled from the kinds of its keys. */
static attitude_spec random_spec(const attitude_law *law, uint64_t *state)
{
    static const char *const looks[] = {"sun", "velocity", "observer"};
    attitude_spec spec = start_law(law->name);
    int n_looks = 0;
    for (int k = 0; k < law->n_keys; k++) {
        const char *name = law->keys[k].name;
        double axis[3], turn[9], q[4];
        random_unit(state, axis);
        random_rotation(state, turn);
        quat_from_mat(turn, q);
        if (string_equal(name, "period_s")) continue; /* excludes rate_deg_s */
        if (law->keys[k].kind == ATTITUDE_AXIS) set_axis(&spec, name, axis[0], axis[1], axis[2]);
        if (law->keys[k].kind == ATTITUDE_DIRECTION)
            set_direction(
                &spec, name,
                word(string_equal(law->name, "sun-pointing") ? "velocity" : looks[n_looks++ % 3]));
        if (law->keys[k].kind == ATTITUDE_QUATERNION) set_quaternion(&spec, q);
        if (law->keys[k].kind ==
            ATTITUDE_VECTOR) { /* between 3 and 5: a rigid body's moments, too */
            spec.given[k] = true;
            for (int i = 0; i < 3; i++)
                spec.value[k][i] = 4.0 + next_random(state);
        }
        if (law->keys[k].kind == ATTITUDE_NUMBER || law->keys[k].kind == ATTITUDE_EPOCH)
            set_number(&spec, name, 10.0 * next_random(state));
    }
    return spec;
}

/* Attitudes from files have tests of their own. */
static bool has_no_file(const attitude_law *law)
{
    return attitude_key_index(law, "file") < 0;
}

/* Prepares a spec that must fail with n errors, and returns the one at index `which`. */
static glint_error prepare_failure(const attitude_spec *spec, size_t n, size_t which)
{
    attitude a;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(attitude_prepare(spec, &a, errors), GLINT_INPUT);
    ck_assert_uint_eq(glint_errors_error_count(errors), n);
    const glint_error error = *glint_errors_get(errors, which);
    glint_errors_free(errors);
    ck_assert_str_eq(error.file, "scenario.toml");
    return error;
}

static void assert_fails_at(const attitude_spec *spec, const moment *m, const char *says)
{
    const attitude a = prepared(spec);
    double body_gcrs[9];
    glint_error error;
    ck_assert_int_eq(attitude_at(&a, m, body_gcrs, &error), GLINT_INPUT);
    ck_assert_msg(strstr(error.message, says) != NULL, "'%s' says nothing of '%s'", error.message,
                  says);
    ck_assert_int_eq(attitude_at(&a, m, body_gcrs, NULL), GLINT_INPUT);
}

static const double x_axis[3] = {1, 0, 0}, y_axis[3] = {0, 1, 0}, z_axis[3] = {0, 0, 1};

/* --------------------------------------------------------------- directions */

START_TEST(test_direction_words_roundtrip)
{
    size_t n = 0;
    for (; direction_word(n); n++) {
        direction d;
        ck_assert(direction_from_word(direction_word(n), &d));
        ck_assert_uint_eq(d.kind, n);
        ck_assert_str_eq(direction_name(&d), direction_word(n));
    }
    ck_assert_uint_eq(n, DIRECTION_STAR);
    direction d = {.kind = DIRECTION_MOON};
    ck_assert(!direction_from_word("Nadir", &d));
    ck_assert(!direction_from_word("", &d));
    ck_assert_int_eq(d.kind, DIRECTION_MOON);
}
END_TEST

static void assert_direction(direction d, const moment *m, double x, double y, double z, double tol)
{
    double got[3];
    glint_error error = {0};
    ck_assert_msg(direction_at(&d, m, got, &error) == GLINT_OK, "%s", error.message);
    assert_vec_near(got, x, y, z, tol);
    assert_near(norm3(got), 1.0, rounding);
}

/* r along (1, 2, 2)/3, v along (2, 1, -2)/3: r x v along (-6, 6, -3)/9. */
START_TEST(test_direction_at_known_moment)
{
    const moment m = {.r_m = {7e6 / 3, 14e6 / 3, 14e6 / 3},
                      .v_m_s = {5000, 2500, -5000},
                      .sun = {0.6, 0, 0.8},
                      .moon = {0, -0.6, 0.8},
                      .observer = {-0.28, 0.96, 0},
                      .itrs_gcrs = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    const double third = 1.0 / 3.0;
    assert_direction(word("nadir"), &m, -third, -2 * third, -2 * third, rounding);
    assert_direction(word("zenith"), &m, third, 2 * third, 2 * third, rounding);
    assert_direction(word("velocity"), &m, 2 * third, third, -2 * third, rounding);
    assert_direction(word("orbit-normal"), &m, -2 * third, 2 * third, -third, rounding);
    assert_direction(word("north"), &m, 0, 0, 1, 0);
    assert_direction(word("sun"), &m, 0.6, 0, 0.8, rounding);
    assert_direction(word("moon"), &m, 0, -0.6, 0.8, rounding);
    assert_direction(word("observer"), &m, -0.28, 0.96, 0, rounding);
}
END_TEST

/* Right ascension and declination as every textbook has them. */
START_TEST(test_direction_star_known_places)
{
    const moment m = {.t_s = 0};
    assert_direction(star(0, 0), &m, 1, 0, 0, rounding);
    assert_direction(star(90, 0), &m, 0, 1, 0, rounding);
    assert_direction(star(123, 90), &m, 0, 0, 1, rounding);
    assert_direction(star(-90, -30), &m, 0, -sqrt(0.75), -0.5, rounding);
    const direction d = star(0, 0);
    ck_assert_str_eq(direction_name(&d), "{ ra_deg, dec_deg }");
}
END_TEST

/* The Earth turned by 90 deg: the meridian of Greenwich lies along GCRS y. */
static const double greenwich_along_y[9] = {0, 1, 0, -1, 0, 0, 0, 0, 1};

/* A point at geodetic latitude f and height h lies at ((N + h) cos f, 0, (N (1 - e^2) + h) sin f)
 * in the plane of its meridian, N = a / sqrt(1 - e^2 sin^2 f); straight down is (-cos f, 0, -sin
 * f). */
START_TEST(test_direction_geodetic_nadir_closed_form)
{
    const double e2 = EARTH_FLATTENING * (2 - EARTH_FLATTENING);
    for (int latitude_deg = -90; latitude_deg <= 90; latitude_deg += 15)
        for (double height_m = 200e3; height_m < 5e7; height_m *= 14) {
            const double c = cos(latitude_deg * DEG), s = sin(latitude_deg * DEG);
            const double n_m = EARTH_RADIUS_M / sqrt(1 - e2 * s * s);
            moment m = {.r_m = {0, (n_m + height_m) * c, (n_m * (1 - e2) + height_m) * s}};
            memcpy(m.itrs_gcrs, greenwich_along_y, sizeof m.itrs_gcrs);
            assert_direction(word("geodetic-nadir"), &m, 0, -c, -s, 1e-13);
        }
}
END_TEST

/* The north pole is at the polar radius of WGS84, 6356752.3142 m (NIMA TR8350.2, table 3.3). */
START_TEST(test_direction_place_closed_form)
{
    const double polar_radius_m = 6356752.3142;
    moment m = {.r_m = {EARTH_RADIUS_M + 5e5, 0, 0}};
    memcpy(m.itrs_gcrs, greenwich_along_y, sizeof m.itrs_gcrs);
    direction pole, below, east;
    ck_assert_int_eq(direction_place(PI / 2, 1.0, 0.0, &pole, NULL), GLINT_OK);
    ck_assert_int_eq(direction_place(0.0, -PI / 2, 1000.0, &below, NULL), GLINT_OK);
    ck_assert_int_eq(direction_place(0.0, 0.0, 0.0, &east, NULL), GLINT_OK);
    ck_assert_str_eq(direction_name(&pole), "{ latitude_deg, longitude_deg }");
    const double x_m = EARTH_RADIUS_M + 5e5;
    /* 0.05 mm in the polar radius as published, 1 in 1e11 of the distance */
    const double far_m = hypot(x_m, polar_radius_m);
    assert_direction(pole, &m, -x_m / far_m, 0, polar_radius_m / far_m, 1e-11);
    assert_direction(below, &m, -1, 0, 0, rounding);
    const double away_m = hypot(x_m, EARTH_RADIUS_M);
    assert_direction(east, &m, -x_m / away_m, EARTH_RADIUS_M / away_m, 0, rounding);
}
END_TEST

START_TEST(test_direction_at_undefined_is_refused)
{
    moment m = {.t_s = 12.5, .itrs_gcrs = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    static const struct {
        const char *word, *why;
    } cases[] = {{"nadir", "centre"},   {"geodetic-nadir", "centre"}, {"zenith", "centre"},
                 {"velocity", "rest"},  {"orbit-normal", "parallel"}, {"sun", "not known"},
                 {"moon", "not known"}, {"observer", "not known"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const direction d = word(cases[k].word);
        double out[3];
        glint_error error;
        ck_assert_int_eq(direction_at(&d, &m, out, &error), GLINT_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, cases[k].word));
        ck_assert_ptr_nonnull(strstr(error.message, cases[k].why));
        ck_assert_ptr_nonnull(strstr(error.message, "12.5 s from the start"));
    }
    /* straight up, and where the satellite itself is */
    direction d = word("orbit-normal");
    double out[3];
    m.r_m[0] = EARTH_RADIUS_M, m.v_m_s[0] = 7000, m.v_m_s[1] = 6e-6;
    ck_assert_int_eq(direction_at(&d, &m, out, NULL), GLINT_INPUT);
    m.v_m_s[1] = 8e-6; /* 1.1e-9 of the speed: defined, along z */
    assert_direction(d, &m, 0, 0, 1, rounding);
    ck_assert_int_eq(direction_place(0, 0, 0, &d, NULL), GLINT_OK);
    ck_assert_int_eq(direction_at(&d, &m, out, NULL), GLINT_INPUT);
    m.r_m[0] = NAN;
    ck_assert_int_eq(direction_at(&d, &m, out, NULL), GLINT_INPUT);
}
END_TEST

/* ------------------------------------------------------------------ the table */

START_TEST(test_attitude_table_is_complete)
{
    size_t n = 0;
    for (const attitude_law *law; (law = attitude_law_at(n)); n++) {
        ck_assert_ptr_eq(attitude_law_named(law->name), law);
        ck_assert_uint_gt(strlen(law->doc), 0);
        ck_assert_int_le(law->n_keys, ATTITUDE_MAX_KEYS);
        ck_assert_int_eq(attitude_key_index(law, "no such key"), -1);
        for (int k = 0; k < law->n_keys; k++) {
            ck_assert_int_eq(attitude_key_index(law, law->keys[k].name), k);
            ck_assert_uint_gt(strlen(law->keys[k].doc), 0);
            ck_assert_ptr_nonnull(law->keys[k].unit);
        }
    }
    ck_assert_uint_eq(n, 9);
    ck_assert_ptr_null(attitude_law_named("Nadir"));
}
END_TEST

START_TEST(test_attitude_every_law_is_a_rotation)
{
    uint64_t state = 1;
    for (size_t n = 0; attitude_law_at(n); n++)
        for (int i = 0; i < 200 && has_no_file(attitude_law_at(n)); i++) {
            const attitude_spec spec = random_spec(attitude_law_at(n), &state);
            const attitude a = prepared(&spec);
            const moment m = random_moment(&state);
            double body_gcrs[9];
            evaluate(&a, &m, body_gcrs);
            assert_rotation(body_gcrs);
        }
}
END_TEST

/* Turning everything that the law looks at turns the body with it: v_body does not change. Laws
 * that refer to GCRS itself (inertial, torque-free; spin to its z) are held to turns that leave
 * their reference alone. */
START_TEST(test_attitude_every_law_turns_with_the_scene)
{
    uint64_t state = 2;
    for (size_t n = 0; attitude_law_at(n); n++)
        for (int i = 0; i < 100 && has_no_file(attitude_law_at(n)); i++) {
            const attitude_law *law = attitude_law_at(n);
            double turn[9], before[9], after[9], transposed[9], want[9];
            if (string_equal(law->name, "inertial")) continue;
            if (string_equal(law->name, "torque-free")) continue;
            random_rotation(&state, turn);
            if (string_equal(law->name, "spin")) mat_turn(z_axis, 0.06 * i, turn);
            const attitude_spec spec = random_spec(law, &state);
            const attitude a = prepared(&spec);
            const moment m = random_moment(&state), turned = turned_moment(&m, turn);
            evaluate(&a, &m, before);
            evaluate(&a, &turned, after);
            mat_transpose(turn, transposed);
            mat_mul(before, transposed, want);
            /* directions with a sine of 0.01 between them lose two digits */
            assert_mat_near(after, want, 1e-12);
        }
}
END_TEST

START_TEST(test_attitude_every_offset_turns_the_body_about_its_axis)
{
    uint64_t state = 3;
    for (size_t n = 0; attitude_law_at(n); n++)
        for (int i = 0; i < 50 && has_no_file(attitude_law_at(n)); i++) {
            attitude_spec spec = random_spec(attitude_law_at(n), &state);
            const moment m = random_moment(&state);
            double law[9], off[9], axis[3], pole[3], other[3], turn[9], got[3], want[3];
            attitude a = prepared(&spec);
            evaluate(&a, &m, law);
            random_unit(&state, axis);
            set_offset(&spec, axis[0], axis[1], axis[2], 25.0);
            a = prepared(&spec);
            evaluate(&a, &m, off);
            assert_rotation(off);
            /* the axis stays where it was; any other body vector turns right-handed about it */
            mat_tvec(law, axis, pole);
            mat_tvec(off, axis, got);
            assert_vec_near(got, pole[0], pole[1], pole[2], rounding);
            random_unit(&state, other);
            mat_tvec(law, other, want);
            mat_turn(pole, 25.0 * DEG, turn);
            mat_vec(turn, want, want);
            mat_tvec(off, other, got);
            assert_vec_near(got, want[0], want[1], want[2], rounding);
        }
}
END_TEST

START_TEST(test_attitude_prepare_reports_missing_and_infinite_keys)
{
    attitude_spec spec = start_law("point");
    set_axis(&spec, "axis", 0, 0, 1);
    glint_error error = prepare_failure(&spec, 3, 0);
    ck_assert_int_eq(error.line, 3);
    ck_assert_ptr_nonnull(strstr(error.message, "'to'"));
    error = prepare_failure(&spec, 3, 2);
    ck_assert_ptr_nonnull(strstr(error.message, "'second_to'"));
    spec = spin_spec(1, 0, 0, word("sun"), INFINITY);
    set_number(&spec, "phase_deg", NAN);
    set_offset(&spec, 1, 0, 0, NAN);
    error = prepare_failure(&spec, 3, 1);
    ck_assert_int_eq(error.line, spec.key_place[attitude_key_index(spec.law, "rate_deg_s")].line);
    error = prepare_failure(&spec, 3, 2);
    ck_assert_ptr_nonnull(strstr(error.message, "'phase_deg'"));
}
END_TEST

/* What is asked for must be known before the moments are filled. */
START_TEST(test_attitude_wants_what_it_looks_at)
{
    attitude_spec spec = point_spec(z_axis, word("moon"), x_axis, word("velocity"));
    attitude a = prepared(&spec);
    ck_assert(attitude_wants(&a, DIRECTION_MOON));
    ck_assert(attitude_wants(&a, DIRECTION_VELOCITY));
    ck_assert(!attitude_wants(&a, DIRECTION_SUN));
    spec = start_law("sun-pointing");
    set_axis(&spec, "axis", 0, 0, 1);
    set_axis(&spec, "second_axis", 1, 0, 0);
    set_direction(&spec, "second_to", word("moon"));
    a = prepared(&spec);
    ck_assert(attitude_wants(&a, DIRECTION_SUN));
    ck_assert(attitude_wants(&a, DIRECTION_MOON));
    spec = spin_spec(1, 0, 0, word("moon"), 1);
    a = prepared(&spec);
    ck_assert(attitude_wants(&a, DIRECTION_MOON));
    spec = start_law("nadir");
    a = prepared(&spec);
    ck_assert(!attitude_wants(&a, DIRECTION_MOON));
    ck_assert(attitude_law_named("nadir")->flags & ATTITUDE_NEEDS_ORBIT);
    ck_assert(attitude_law_named("rsw")->flags & ATTITUDE_NEEDS_ORBIT);
    ck_assert(!(attitude_law_named("inertial")->flags & ATTITUDE_NEEDS_ORBIT));
}
END_TEST

/* ----------------------------------------------------------------- nadir, rsw */

/* Over the equator eastwards: north, the orbit normal, is on -y. */
START_TEST(test_attitude_nadir_equatorial_closed_form)
{
    const moment m = {.r_m = {7e6, 0, 0}, .v_m_s = {100, 7500, 0}};
    const double want[9] = {0, 1, 0, 0, 0, -1, -1, 0, 0};
    const attitude_spec spec = start_law("nadir");
    const attitude a = prepared(&spec);
    double body_gcrs[9];
    evaluate(&a, &m, body_gcrs);
    assert_mat_near(body_gcrs, want, rounding);
}
END_TEST

START_TEST(test_attitude_rsw_equatorial_closed_form)
{
    const moment m = {.r_m = {0, 7e6, 0}, .v_m_s = {-7500, 100, 0}};
    const double want[9] = {0, 1, 0, -1, 0, 0, 0, 0, 1};
    const attitude_spec spec = start_law("rsw");
    const attitude a = prepared(&spec);
    double body_gcrs[9];
    evaluate(&a, &m, body_gcrs);
    assert_mat_near(body_gcrs, want, rounding);
}
END_TEST

static moment golden_moment(const csv_table *t, long row)
{
    moment m = {.t_s = 0};
    table_vector(t, row, "r_", "_km", m.r_m);
    table_vector(t, row, "v_", "_kms", m.v_m_s);
    table_vector(t, row, "sun_", "", m.sun);
    scale3(m.r_m, 1e3, m.r_m);
    scale3(m.v_m_s, 1e3, m.v_m_s);
    return m;
}

/* The law's matrix against that of the quaternion, through the law "inertial", whose quaternion
 * turns body vectors into GCRS. */
static void check_golden_quaternion(const csv_table *t, long row, const char *law,
                                    const char *prefix)
{
    const moment m = golden_moment(t, row);
    double q[4], got[9], want[9];
    char scalar[16];
    snprintf(scalar, sizeof scalar, "%sw", prefix);
    q[0] = table_number(t, row, scalar);
    table_vector(t, row, prefix, "", q + 1);
    attitude_spec spec = start_law("inertial");
    set_quaternion(&spec, q);
    const attitude fixed = prepared(&spec);
    evaluate(&fixed, &m, want);
    spec = start_law(law);
    const attitude moving = prepared(&spec);
    evaluate(&moving, &m, got);
    /* r and v have 9 decimals in km and km/s: 3e-10 of the speed */
    assert_mat_near(got, want, 1e-9);
}

static void check_golden_lvlh(const char *path)
{
    csv_table t = table_open(path);
    for (long row = 0; row < t.n_rows; row++) {
        check_golden_quaternion(&t, row, "nadir", "qvvlh_");
        check_golden_quaternion(&t, row, "rsw", "qrsw_");
        const moment m = golden_moment(&t, row);
        const attitude_spec spec = start_law("nadir");
        const attitude a = prepared(&spec);
        double body_gcrs[9], sun_body[3], want[3];
        evaluate(&a, &m, body_gcrs);
        mat_vec(body_gcrs, m.sun, sun_body);
        table_vector(&t, row, "sunB_", "", want);
        assert_vec_near(sun_body, want[0], want[1], want[2], 1e-9);
    }
    csv_free(&t);
}

START_TEST(test_attitude_lvlh_matches_reference)
{
    table_check(check_golden_lvlh, "orbit/attitude_lvlh_array.csv");
}
END_TEST

START_TEST(test_attitude_nadir_is_a_case_of_point)
{
    uint64_t state = 4;
    for (int i = 0; i < 100; i++) {
        const moment m = random_moment(&state);
        const double minus_y[3] = {0, -1, 0};
        const attitude_spec nadir = start_law("nadir");
        const attitude_spec point =
            point_spec(z_axis, word("nadir"), minus_y, word("orbit-normal"));
        const attitude a = prepared(&nadir), b = prepared(&point);
        double got[9], want[9];
        evaluate(&a, &m, got);
        evaluate(&b, &m, want);
        assert_mat_near(got, want, rounding);
    }
}
END_TEST

/* Turned by +10 deg about +y, right-handed, the body's z leans from nadir towards +x, forwards; so
 * nadir itself is found on the other side: (-sin 10, 0, cos 10). */
START_TEST(test_attitude_offset_of_nadir_closed_form)
{
    uint64_t state = 5;
    const moment m = random_moment(&state);
    attitude_spec spec = start_law("nadir");
    set_offset(&spec, 0, 1, 0, 10.0);
    const attitude a = prepared(&spec);
    double body_gcrs[9], nadir[3], nadir_body[3];
    evaluate(&a, &m, body_gcrs);
    unit3(m.r_m, nadir);
    scale3(nadir, -1, nadir);
    mat_vec(body_gcrs, nadir, nadir_body);
    assert_vec_near(nadir_body, -sin(10 * DEG), 0, cos(10 * DEG), rounding);
    ck_assert_double_gt(dot3(body_gcrs + 6, m.v_m_s), dot3(nadir, m.v_m_s));
}
END_TEST

START_TEST(test_attitude_lvlh_radial_motion_is_refused)
{
    const moment up = {.t_s = 12.5, .r_m = {7e6, 0, 0}, .v_m_s = {3000, 2e-6, 0}};
    const moment rest = {.t_s = 12.5, .r_m = {7e6, 0, 0}};
    static const char *const names[] = {"nadir", "rsw"};
    for (int i = 0; i < 2; i++) {
        const attitude_spec spec = start_law(names[i]);
        assert_fails_at(&spec, &up, "parallel");
        assert_fails_at(&spec, &up, "12.5 s from the start");
        assert_fails_at(&spec, &rest, "velocity");
    }
}
END_TEST

/* -------------------------------------------------------------- point, sun-pointing */

START_TEST(test_attitude_point_closed_form)
{
    const moment m = {.sun = {0, 0, 1}, .observer = {0.6, 0.8, 0}};
    /* body y at the observer exactly; body x as near to the Sun, normal to it here, as can be */
    const attitude_spec spec = point_spec(y_axis, word("observer"), x_axis, word("sun"));
    const attitude a = prepared(&spec);
    /* z = x x y: (0,0,1) x (.6,.8,0) = (-.8,.6,0) */
    const double want[9] = {0, 0, 1, 0.6, 0.8, 0, -0.8, 0.6, 0};
    double body_gcrs[9];
    evaluate(&a, &m, body_gcrs);
    assert_mat_near(body_gcrs, want, rounding);
}
END_TEST

/* The first axis is exact; no turn about it brings the second nearer to its direction. */
START_TEST(test_attitude_point_second_axis_is_nearest)
{
    uint64_t state = 6;
    for (int i = 0; i < 100; i++) {
        const moment m = random_moment(&state);
        double axis[3], second[3], body_gcrs[9], to_body[3], second_to_body[3], side[3], turn[9];
        random_unit(&state, axis);
        random_unit(&state, second);
        const attitude_spec spec = point_spec(axis, word("sun"), second, word("velocity"));
        const attitude a = prepared(&spec);
        evaluate(&a, &m, body_gcrs);
        mat_vec(body_gcrs, m.sun, to_body);
        assert_vec_near(to_body, axis[0], axis[1], axis[2], rounding);
        mat_vec(body_gcrs, m.v_m_s, second_to_body);
        unit3(second_to_body, second_to_body);
        cross3(axis, second, side);
        assert_near(dot3(second_to_body, side), 0.0, rounding);
        const double nearest = dot3(second_to_body, second);
        for (int k = 1; k < 36; k++) {
            double elsewhere[3];
            mat_turn(axis, k * 10.0 * DEG, turn);
            mat_vec(turn, second, elsewhere);
            ck_assert_double_lt(dot3(second_to_body, elsewhere), nearest);
        }
    }
}
END_TEST

START_TEST(test_attitude_sun_pointing_is_point_to_sun)
{
    uint64_t state = 7;
    for (int i = 0; i < 50; i++) {
        const moment m = random_moment(&state);
        double axis[3], second[3], got[9], want[9];
        random_unit(&state, axis);
        random_unit(&state, second);
        attitude_spec spec = start_law("sun-pointing");
        set_axis(&spec, "axis", axis[0], axis[1], axis[2]);
        set_axis(&spec, "second_axis", second[0], second[1], second[2]);
        set_direction(&spec, "second_to", word("orbit-normal"));
        const attitude a = prepared(&spec);
        evaluate(&a, &m, got);
        spec = point_spec(axis, word("sun"), second, word("orbit-normal"));
        const attitude b = prepared(&spec);
        evaluate(&b, &m, want);
        assert_mat_near(got, want, 0.0);
    }
}
END_TEST

/* The Sun at the elevation beta above the plane of a circular orbit, the satellite at the angle mu
 * from midnight: psi = atan2(-tan beta, sin mu), a turn about z from the frame of the law 'nadir'
 * (Montenbruck et al. 2015, eq. 4). */
START_TEST(test_attitude_yaw_steering_closed_form)
{
    attitude_spec spec = start_law("yaw-steering"), level = start_law("nadir");
    const attitude yaw = prepared(&spec), nadir = prepared(&level);
    for (int b = -85; b <= 85; b += 17)
        for (int i = 0; i < 360; i += 7) {
            const double beta = b * DEG, mu = i * DEG;
            /* the orbit's plane is xy, the Sun above -x */
            const moment m = {.r_m = {26.56e6 * cos(mu), 26.56e6 * sin(mu), 0},
                              .v_m_s = {-3.9e3 * sin(mu), 3.9e3 * cos(mu), 0},
                              .sun = {-cos(beta), 0, sin(beta)}};
            double got[9], level_gcrs[9], turn[9], want[9];
            if (b == 0 && i % 180 == 0) continue; /* not defined there */
            evaluate(&yaw, &m, got);
            evaluate(&nadir, &m, level_gcrs);
            mat_turn(z_axis, -atan2(-tan(beta), sin(mu)), turn);
            mat_mul(turn, level_gcrs, want);
            /* b = 0 within 7 deg of the line to the Sun loses a digit */
            assert_mat_near(got, want, 1e-13);
            /* y is normal to the Sun, which is on the side of +x */
            assert_near(dot3(got + 3, m.sun), 0, 1e-14);
            ck_assert_double_ge(dot3(got, m.sun), 0);
        }
}
END_TEST

/* At beta = 0 the yaw flips by half a turn at noon and midnight; at these very moments it is 0. */
START_TEST(test_attitude_yaw_steering_at_noon_and_midnight)
{
    attitude_spec spec = start_law("yaw-steering"), level = start_law("nadir");
    const attitude yaw = prepared(&spec), nadir = prepared(&level);
    for (int noon = 0; noon <= 1; noon++) {
        moment m = {.r_m = {noon ? -26.56e6 : 26.56e6, 0, 0},
                    .v_m_s = {0, noon ? -3.9e3 : 3.9e3, 0},
                    .sun = {-1, 0, 0}};
        double got[9], want[9];
        evaluate(&yaw, &m, got);
        evaluate(&nadir, &m, want);
        assert_mat_near(got, want, rounding);
        for (int side = -1; side <= 1; side += 2) { /* 1e-6 rad before and after */
            m.sun[1] = side * 1e-6;
            evaluate(&yaw, &m, got);
            assert_rotation(got);
            assert_vec_near(got, 0, side, 0, 2e-6);
        }
    }
    const moment radial = {.r_m = {7e6, 0, 0}, .v_m_s = {7e3, 0, 0}, .sun = {1, 0, 0}};
    assert_fails_at(&spec, &radial, "yaw steering is not defined");
}
END_TEST

/* z along the normal of the ellipsoid through a point whose geodetic place is given. */
START_TEST(test_attitude_nadir_geodetic_closed_form)
{
    static const double a_m = 6378137, f = 1 / 298.257223563; /* WGS84 */
    attitude_spec spec = start_law("nadir");
    set_number(&spec, "nadir", 1);
    const attitude geodetic = prepared(&spec);
    const double e2 = f * (2 - f), h_m = 550e3;
    for (int latitude_deg = -80; latitude_deg <= 80; latitude_deg += 20)
        for (int longitude_deg = 0; longitude_deg < 360; longitude_deg += 45) {
            const double b = latitude_deg * DEG, l = longitude_deg * DEG;
            const double n_m = a_m / sqrt(1 - e2 * sin(b) * sin(b));
            const double up[3] = {cos(b) * cos(l), cos(b) * sin(l), sin(b)};
            const moment m = {
                .r_m = {(n_m + h_m) * up[0], (n_m + h_m) * up[1], (n_m * (1 - e2) + h_m) * up[2]},
                .v_m_s = {-7e3 * sin(l), 7e3 * cos(l), 2e3},
                .itrs_gcrs = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
            double got[9], normal[3];
            evaluate(&geodetic, &m, got);
            assert_rotation(got);
            assert_vec_near(got + 6, -up[0], -up[1], -up[2], 1e-12);
            /* y is as far against the normal as it can be: x, normal to both, is normal to it */
            cross3(m.r_m, m.v_m_s, normal);
            unit3(normal, normal);
            assert_near(dot3(got, normal), 0, 1e-12);
            ck_assert_double_lt(dot3(got + 3, normal), -0.99);
        }
    ck_assert(attitude_wants(&geodetic, DIRECTION_GEODETIC_NADIR));
}
END_TEST

START_TEST(test_attitude_point_parallel_axes_are_refused)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        const double near[3] = {0.9e-9, 0, sign}, apart[3] = {1.1e-9, 0, sign};
        attitude_spec spec = point_spec(z_axis, word("sun"), near, word("nadir"));
        const glint_error error = prepare_failure(&spec, 1, 0);
        ck_assert_int_eq(error.line, 12);
        ck_assert_ptr_nonnull(strstr(error.message, "parallel"));
        spec = point_spec(z_axis, word("sun"), apart, word("nadir"));
        prepared(&spec);
    }
}
END_TEST

START_TEST(test_attitude_point_always_parallel_directions_are_refused)
{
    direction vienna, opposite;
    ck_assert_int_eq(direction_place(0.8, 0.3, 0, &vienna, NULL), GLINT_OK);
    ck_assert_int_eq(direction_place(-0.8, 0.3, 0, &opposite, NULL), GLINT_OK);
    const direction pairs[][2] = {
        {word("nadir"), word("zenith")}, {word("sun"), word("sun")}, {star(10, 20), star(190, -20)},
        {word("north"), star(10, -90)},  {vienna, vienna},           {word("moon"), word("moon")}};
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++) {
        /* both errors of the spec are found */
        const attitude_spec spec = point_spec(z_axis, pairs[k][0], z_axis, pairs[k][1]);
        ck_assert_int_eq(prepare_failure(&spec, 2, 0).line, 12);
        ck_assert_int_eq(prepare_failure(&spec, 2, 1).line, 13);
    }
    const direction fine[][2] = {{word("nadir"), word("geodetic-nadir")},
                                 {star(10, 20), star(10, 21)},
                                 {word("north"), star(10, 20)},
                                 {vienna, opposite},
                                 {vienna, word("nadir")}};
    for (size_t k = 0; k < sizeof fine / sizeof *fine; k++) {
        const attitude_spec spec = point_spec(z_axis, fine[k][0], x_axis, fine[k][1]);
        prepared(&spec);
    }
    attitude_spec spec = start_law("sun-pointing");
    set_axis(&spec, "axis", 0, 0, 1);
    set_axis(&spec, "second_axis", 1, 0, 0);
    set_direction(&spec, "second_to", word("sun"));
    ck_assert_int_eq(prepare_failure(&spec, 1, 0).line, 12);
}
END_TEST

START_TEST(test_attitude_point_parallel_at_a_moment_is_refused)
{
    const attitude_spec spec = point_spec(z_axis, word("sun"), x_axis, word("observer"));
    moment m = {.t_s = 12.5, .sun = {1, 0, 0}, .observer = {-1, 0.9e-9, 0}};
    assert_fails_at(&spec, &m, "'sun' and 'observer' are parallel");
    assert_fails_at(&spec, &m, "12.5 s from the start");
    m.observer[1] = 1.1e-9;
    const attitude a = prepared(&spec);
    double body_gcrs[9];
    evaluate(&a, &m, body_gcrs);
    assert_rotation(body_gcrs);
    m.observer[0] = 0, m.observer[1] = 0;
    assert_fails_at(&spec, &m, "'observer' is not defined");
}
END_TEST

/* ---------------------------------------------------------------------- inertial */

/* A turn by 90 deg about z brings body x to GCRS y: q = (cos 45, 0, 0, sin 45). */
START_TEST(test_attitude_inertial_quaternion_is_body_to_gcrs)
{
    const double h = sqrt(0.5), q[4] = {h, 0, 0, h};
    attitude_spec spec = start_law("inertial");
    set_quaternion(&spec, q);
    const attitude a = prepared(&spec);
    uint64_t state = 8;
    for (int i = 0; i < 3; i++) {
        const moment m = random_moment(&state);
        double body_gcrs[9], x_gcrs[3];
        evaluate(&a, &m, body_gcrs);
        mat_tvec(body_gcrs, x_axis, x_gcrs);
        assert_vec_near(x_gcrs, 0, 1, 0, rounding);
    }
}
END_TEST

/* -------------------------------------------------------------------------- spin */

static void assert_spin(const attitude_spec *spec, double t_s, const double want[9])
{
    const attitude a = prepared(spec);
    const moment m = {.t_s = t_s};
    double body_gcrs[9];
    evaluate(&a, &m, body_gcrs);
    assert_mat_near(body_gcrs, want, rounding);
}

/* body x along GCRS y; the axis that follows, body y, along GCRS z. A quarter turn later,
 * right-handed about GCRS y, it has gone from z to x. */
START_TEST(test_attitude_spin_closed_form)
{
    const double start[9] = {0, 1, 0, 0, 0, 1, 1, 0, 0};
    const double quarter[9] = {0, 1, 0, 1, 0, 0, 0, 0, -1};
    attitude_spec spec = spin_spec(1, 0, 0, star(90, 0), 3.0);
    assert_spin(&spec, 0, start);
    assert_spin(&spec, 30, quarter);
    set_number(&spec, "phase_deg", 90);
    assert_spin(&spec, 0, quarter);
    set_number(&spec, "epoch", 50);
    assert_spin(&spec, 20, start);
    set_number(&spec, "rate_deg_s", -3);
    assert_spin(&spec, 80, start);
}
END_TEST

/* Where the pole is GCRS z or against it, the reference is GCRS x. */
START_TEST(test_attitude_spin_about_gcrs_z_refers_to_x)
{
    const double north[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double south[9] = {1, 0, 0, 0, -1, 0, 0, 0, -1};
    attitude_spec spec = spin_spec(0, 0, 1, word("north"), 1);
    assert_spin(&spec, 0, north);
    spec = spin_spec(0, 0, 1, star(77, -90), 1);
    assert_spin(&spec, 0, south);
    /* 2 arcsec from the pole the reference is z again */
    spec = spin_spec(0, 0, 1, star(0, 90 - 5e-4), 1);
    const double c = cos(5e-4 * DEG), s = sin(5e-4 * DEG);
    const double near[9] = {-c, 0, s, 0, -1, 0, s, 0, c};
    assert_spin(&spec, 0, near);
}
END_TEST

/* The axis that body_axis names is its largest component by absolute value, the first on a tie; the
 * part of the following axis normal to body_axis is what is turned to GCRS x. */
START_TEST(test_attitude_spin_reference_axis_follows_the_largest)
{
    const double h = sqrt(0.5);
    const double tie[9] = {-h, 0, h, h, 0, h, 0, 1, 0};
    attitude_spec spec = spin_spec(1, 1, 0, word("north"), 1);
    assert_spin(&spec, 0, tie);
    /* z is named, x follows: normal to (0, .6, -.8); z x x = y there is (0, -.8, -.6) in the body
     */
    const double negative[9] = {1, 0, 0, 0, -0.8, 0.6, 0, -0.6, -0.8};
    spec = spin_spec(0, 0.6, -0.8, word("north"), 1);
    assert_spin(&spec, 0, negative);
    /* y is named, z follows */
    const double second[9] = {0, 1, 0, 0, 0, 1, 1, 0, 0};
    spec = spin_spec(0, 1, 0, word("north"), 1);
    assert_spin(&spec, 0, second);
}
END_TEST

/* At the epoch, with no phase, no turn about the pole brings the reference axis nearer to GCRS z.
 */
START_TEST(test_attitude_spin_starts_nearest_to_gcrs_z)
{
    uint64_t state = 9;
    for (int i = 0; i < 50; i++) {
        double axis[3], reference[3] = {0, 0, 0}, body_gcrs[9];
        random_unit(&state, axis);
        reference[(largest3(axis) + 1) % 3] = 1.0;
        attitude_spec spec =
            spin_spec(axis[0], axis[1], axis[2],
                      star(180 * next_random(&state), 80 * next_random(&state)), 0);
        double nearest = -1;
        for (int k = 0; k < 36; k++) {
            set_number(&spec, "phase_deg", 10.0 * k);
            const attitude a = prepared(&spec);
            const moment m = {.t_s = 0};
            double reference_gcrs[3];
            evaluate(&a, &m, body_gcrs);
            mat_tvec(body_gcrs, reference, reference_gcrs);
            if (k == 0) nearest = reference_gcrs[2];
            ck_assert_double_le(reference_gcrs[2], nearest);
        }
    }
}
END_TEST

/* Over time the body turns about the pole, right-handed, by rate times time; body_axis stays there.
 */
START_TEST(test_attitude_spin_turns_at_its_rate)
{
    uint64_t state = 10;
    for (int i = 0; i < 50; i++) {
        double axis[3], vector[3], pole[3], before[9], after[9], turn[9], want[3], got[3];
        random_unit(&state, axis);
        random_unit(&state, vector);
        attitude_spec spec = random_spec(attitude_law_named("spin"), &state);
        set_axis(&spec, "body_axis", axis[0], axis[1], axis[2]);
        set_number(&spec, "rate_deg_s", 7.0);
        const attitude a = prepared(&spec);
        moment m = random_moment(&state);
        evaluate(&a, &m, before);
        m.t_s += 10.0;
        evaluate(&a, &m, after);
        mat_tvec(before, axis, pole);
        mat_tvec(after, axis, got);
        assert_vec_near(got, pole[0], pole[1], pole[2], rounding);
        assert_vec_near(m.sun, pole[0], pole[1], pole[2], rounding);
        mat_turn(pole, 70.0 * DEG, turn);
        mat_tvec(before, vector, want);
        mat_vec(turn, want, want);
        mat_tvec(after, vector, got);
        /* 1010 s at 7 deg/s is 123 rad, known to 1.4e-14 */
        assert_vec_near(got, want[0], want[1], want[2], 1e-13);
    }
}
END_TEST

START_TEST(test_attitude_spin_period_equals_rate)
{
    attitude_spec rate = spin_spec(1, 2, 3, star(30, 40), 360.0 / 51.5);
    attitude_spec period = start_law("spin");
    set_axis(&period, "body_axis", 1, 2, 3);
    set_direction(&period, "pole", star(30, 40));
    set_number(&period, "period_s", 51.5);
    const attitude a = prepared(&rate), b = prepared(&period);
    for (double t_s = -1000; t_s < 1000; t_s += 33.3) {
        const moment m = {.t_s = t_s}, one_turn_later = {.t_s = t_s + 51.5};
        double want[9], got[9];
        evaluate(&a, &m, want);
        evaluate(&b, &m, got);
        assert_mat_near(got, want, 1e-13); /* 122 rad, known to 1.4e-14 */
        evaluate(&b, &one_turn_later, got);
        assert_mat_near(got, want, 1e-13);
    }
}
END_TEST

START_TEST(test_attitude_spin_wrong_keys_are_refused)
{
    attitude_spec spec = spin_spec(1, 0, 0, word("sun"), 7.0);
    set_number(&spec, "period_s", 10);
    glint_error error = prepare_failure(&spec, 1, 0);
    ck_assert_int_eq(error.line, 13);
    ck_assert_ptr_nonnull(strstr(error.message, "only one"));
    spec = start_law("spin");
    set_axis(&spec, "body_axis", 1, 0, 0);
    set_direction(&spec, "pole", word("sun"));
    error = prepare_failure(&spec, 1, 0);
    ck_assert_int_eq(error.line, 3);
    ck_assert_ptr_nonnull(strstr(error.message, "period_s"));
    static const double bad[] = {0.0, -5.0, 1e-320};
    for (int i = 0; i < 3; i++) {
        set_number(&spec, "period_s", bad[i]);
        error = prepare_failure(&spec, 1, 0);
        ck_assert_int_eq(error.line, 12);
        ck_assert_ptr_nonnull(strstr(error.message, "above 0"));
    }
    const moment rest = {.t_s = 12.5};
    spec = spin_spec(1, 0, 0, word("velocity"), 7.0);
    assert_fails_at(&spec, &rest, "velocity");
}
END_TEST

static Suite *attitude_suite(void)
{
    Suite *suite = suite_create("attitude");
    TCase *directions = tcase_create("directions");
    tcase_add_test(directions, test_direction_words_roundtrip);
    tcase_add_test(directions, test_direction_at_known_moment);
    tcase_add_test(directions, test_direction_star_known_places);
    tcase_add_test(directions, test_direction_geodetic_nadir_closed_form);
    tcase_add_test(directions, test_direction_place_closed_form);
    tcase_add_test(directions, test_direction_at_undefined_is_refused);
    suite_add_tcase(suite, directions);
    TCase *table = tcase_create("every law");
    tcase_add_test(table, test_attitude_table_is_complete);
    tcase_add_test(table, test_attitude_every_law_is_a_rotation);
    tcase_add_test(table, test_attitude_every_law_turns_with_the_scene);
    tcase_add_test(table, test_attitude_every_offset_turns_the_body_about_its_axis);
    tcase_add_test(table, test_attitude_prepare_reports_missing_and_infinite_keys);
    tcase_add_test(table, test_attitude_wants_what_it_looks_at);
    suite_add_tcase(suite, table);
    TCase *laws = tcase_create("laws");
    tcase_add_test(laws, test_attitude_nadir_equatorial_closed_form);
    tcase_add_test(laws, test_attitude_rsw_equatorial_closed_form);
    tcase_add_test(laws, test_attitude_lvlh_matches_reference);
    tcase_add_test(laws, test_attitude_nadir_is_a_case_of_point);
    tcase_add_test(laws, test_attitude_offset_of_nadir_closed_form);
    tcase_add_test(laws, test_attitude_lvlh_radial_motion_is_refused);
    tcase_add_test(laws, test_attitude_point_closed_form);
    tcase_add_test(laws, test_attitude_point_second_axis_is_nearest);
    tcase_add_test(laws, test_attitude_sun_pointing_is_point_to_sun);
    tcase_add_test(laws, test_attitude_point_parallel_axes_are_refused);
    tcase_add_test(laws, test_attitude_yaw_steering_closed_form);
    tcase_add_test(laws, test_attitude_yaw_steering_at_noon_and_midnight);
    tcase_add_test(laws, test_attitude_nadir_geodetic_closed_form);
    tcase_add_test(laws, test_attitude_point_always_parallel_directions_are_refused);
    tcase_add_test(laws, test_attitude_point_parallel_at_a_moment_is_refused);
    tcase_add_test(laws, test_attitude_inertial_quaternion_is_body_to_gcrs);
    tcase_add_test(laws, test_attitude_spin_closed_form);
    tcase_add_test(laws, test_attitude_spin_about_gcrs_z_refers_to_x);
    tcase_add_test(laws, test_attitude_spin_reference_axis_follows_the_largest);
    tcase_add_test(laws, test_attitude_spin_starts_nearest_to_gcrs_z);
    tcase_add_test(laws, test_attitude_spin_turns_at_its_rate);
    tcase_add_test(laws, test_attitude_spin_period_equals_rate);
    tcase_add_test(laws, test_attitude_spin_wrong_keys_are_refused);
    suite_add_tcase(suite, laws);
    return suite;
}

int main(void)
{
    return run_suite(attitude_suite());
}
