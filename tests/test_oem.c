/* Orbit ephemeris messages, and interpolation in tables of positions. */
#include "base/constants.h"
#include "base/random.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/oem.h"
#include "orbit/orbit.h"
#include "scenario_text.h"

static const char *data(const char *name)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/messages/%s", TEST_DATA_DIR, name);
    return path;
}

static orbit_table *read_table(const char *path, const char *object, size_t n_entries)
{
    orbit_table *table;
    glint_errors *errors = glint_errors_new();
    const glint_status status = oem_read(path, PLACE_NONE, object, &table, errors);
    ck_assert_msg(status == GLINT_OK, "%s:%s", path, list_errors(errors));
    ck_assert_msg(glint_errors_count(errors) == n_entries, "%s:%s", path, list_errors(errors));
    glint_errors_free(errors);
    return table;
}

/* Seconds of a UTC from the table's reference. */
static double at(const orbit_table *table, const char *utc)
{
    double tt_jd[2];
    ck_assert_int_eq(time_parse(utc, SCALE_UTC, PLACE_NONE, tt_jd, NULL), GLINT_OK);
    return orbit_table_seconds(table, tt_jd);
}

static void assert_state(const orbit_table *table, double t_s, const double r_m[3],
                         const double v_m_s[3], double tol_m, double tol_m_s)
{
    double r[3], v[3];
    table_frame frame;
    glint_error error = {0};
    ck_assert_msg(orbit_table_state(table, t_s, &frame, r, v, &error) == GLINT_OK, "%s",
                  error.message);
    for (int i = 0; i < 3; i++) {
        assert_near(r[i], r_m[i], tol_m);
        assert_near(v[i], v_m_s[i], tol_m_s);
    }
}

/* ------------------------------------------------------------------- reading */

/* Uniform motion, as the file has it: before the manoeuvre and after. */
static void assert_cube(const orbit_table *table)
{
    const double rounding_m = 1e-7;   /* of dates, 5e-12 s, at 7.6 km/s */
    const double rounding_m_s = 1e-9; /* that of places, over a step of 60 s */
    ck_assert_str_eq(table->object, "CUBE");
    ck_assert_str_eq(table->id, "2025-001A");
    ck_assert_uint_eq(table->n, 2);
    ck_assert_uint_eq(table->segments[0].n, 5);
    ck_assert_uint_eq(table->segments[1].n, 4);
    ck_assert_int_eq(table->segments[0].method, TABLE_LAGRANGE);
    ck_assert_int_eq(table->segments[1].method, TABLE_HERMITE);
    ck_assert_int_eq(table->segments[0].degree, 3);
    for (double t_s = 60; t_s < 240; t_s += 7) {
        const double r_m[3] = {7000e3 + 1000 * t_s, 7500 * t_s, 100e3 - 500 * t_s};
        assert_state(table, t_s, r_m, (double[]){1000, 7500, -500}, rounding_m, rounding_m_s);
    }
    for (double t_s = 240; t_s <= 420; t_s += 7.5) { /* the moment of both is the later's */
        const double dt_s = t_s - 240;
        const double r_m[3] = {7240e3 + 500 * dt_s, 1800e3 + 7000 * dt_s, -20e3 + 250 * dt_s};
        assert_state(table, t_s, r_m, (double[]){500, 7000, 250}, rounding_m, rounding_m_s);
    }
}

START_TEST(test_oem_read_takes_segments_of_both_notations)
{
    static const char *const files[] = {"cube.oem", "cube.xml"};
    for (size_t k = 0; k < COUNT_OF(files); k++) {
        orbit_table *table = read_table(data(files[k]), NULL, 0);
        assert_cube(table);
        orbit_table_free(table);
    }
}
END_TEST

/* As other systems and people write it. */
START_TEST(test_oem_read_takes_line_ends_tabs_case_mark_and_long_lines)
{
    size_t n;
    char *plain = read_bytes(data("cube.oem"), &n);
    text other = {0};
    text_add(&other, "\xEF\xBB\xBF");
    for (const char *c = plain; *c; c++) {
        if (*c == '\n') text_add(&other, "\t\r");
        const bool in_keyword = c == plain || c[-1] == '\n';
        text_char(&other, in_keyword && *c >= 'A' && *c <= 'Z' ? (char)(*c + 32) : *c);
        if (*c == ' ') text_add(&other, " \t");
    }
    text_add(&other, "COMMENT ");
    for (int k = 0; k < 100000; k++)
        text_char(&other, 'x');
    text_add(&other, "\r\n");
    orbit_table *table = read_table(write_bytes("other.oem", other.data, other.length), "cube", 0);
    assert_cube(table);
    orbit_table_free(table);
    text_free(&other);
    free(plain);
}
END_TEST

START_TEST(test_oem_read_respects_useable_times)
{
    orbit_table *table = read_table(data("cube.oem"), NULL, 0);
    static const struct {
        const char *utc;
        bool inside;
    } cases[] = {{"2025-07-24T12:00:00", false},
                 {"2025-07-24T12:00:59.8", false},
                 {"2025-07-24T12:01:00", true},
                 {"2025-07-24T12:07:00", true},
                 {"2025-07-24T12:07:00.2", false}};
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        double r_m[3], v_m_s[3];
        table_frame frame;
        glint_error error = {0};
        const glint_status status =
            orbit_table_state(table, at(table, cases[k].utc), &frame, r_m, v_m_s, &error);
        ck_assert_msg((status == GLINT_OK) == cases[k].inside, "%s", cases[k].utc);
        if (status)
            ck_assert_ptr_nonnull(strstr(
                error.message, "2025-07-24T12:01:00.000000Z to 2025-07-24T12:07:00.000000Z"));
    }
    orbit_table_free(table);
}
END_TEST

/* ------------------------------------------------------------------- messages */

#define HEAD "CCSDS_OEM_VERS = 2.0\nCREATION_DATE = 2025-001\nORIGINATOR = X\n"
#define META_OF(frame, system, more)                                                               \
    "META_START\nOBJECT_NAME = CUBE\nOBJECT_ID = 1\nCENTER_NAME = EARTH\nREF_FRAME = " frame       \
    "\nTIME_SYSTEM = " system "\n" more "META_STOP\n"
#define META META_OF("GCRF", "UTC", "")
#define ROW(minute, x) "2025-07-24T12:" minute ":00 " x " 0 0 0 7.5 0\n"
#define ROWS ROW("00", "7000") ROW("01", "7001") ROW("02", "7002")

static glint_status read_text(const char *content, const char *object, orbit_table **out,
                              glint_errors *errors)
{
    return oem_read(write_file("in.oem", content), PLACE_NONE, object, out, errors);
}

/* Reading must fail with exactly one error, at the '@' (line 0 without one). */
static void assert_text_refused(const char *content, const char *object, const char *word)
{
    marked_text m = {.text = ""};
    ck_assert_uint_lt(strlen(content), sizeof m.text);
    strcpy(m.text, content);
    take_mark(&m);
    orbit_table *table = (orbit_table *)folder;
    glint_errors *errors = glint_errors_new();
    ck_assert_msg(read_text(m.text, object, &table, errors) == GLINT_INPUT, "wanted '%s' for\n%s",
                  word, m.text);
    ck_assert_ptr_null(table);
    ck_assert_msg(has_error(errors, in_folder("in.oem"), m.line, m.column, word, NULL),
                  "wanted %d:%d '%s'; got:%s", m.line, m.column, word, list_errors(errors));
    ck_assert_msg(glint_errors_error_count(errors) == 1, "%s", list_errors(errors));
    glint_errors_free(errors);
    ck_assert_int_eq(read_text(m.text, object, &table, NULL), GLINT_INPUT);
}

START_TEST(test_oem_read_places_every_error)
{
    static const char *const wrong[][2] = {
        {"CCSDS_AEM_VERS = @1.0\n", "no orbit ephemeris message"},
        {"CCSDS_OEM_VERS = @4.0\n", "version"},
        {HEAD, "no segment"},
        {HEAD META_OF("@TOD", "UTC", "") ROWS, "'TOD' is not taken"},
        {HEAD META_OF("TEME", "UTC", "REF_FRAME_EPOCH = @2025-001\n") ROWS, "TEME of one epoch"},
        {HEAD META_OF("GCRF", "@UT1", "") ROWS, "turns of the Earth"},
        {HEAD META_OF("GCRF", "@MET", "") ROWS, "'MET' is not taken"},
        {HEAD META_OF("GCRF", "UTC", "INTERPOLATION = @SPLINE\n") ROWS, "expected HERMITE"},
        {HEAD META_OF("GCRF", "UTC", "INTERPOLATION_DEGREE = @0\n") ROWS, "from 1 to 25"},
        {HEAD META_OF("GCRF", "UTC", "INTERPOLATION_DEGREE = @2.5\n") ROWS, "from 1 to 25"},
        {HEAD META_OF("GCRF", "UTC", "CENTER_NAME = @EARTH\n") ROWS, "stands twice"},
        {HEAD "@META_START\nOBJECT_NAME = CUBE\nCENTER_NAME = EARTH\nTIME_SYSTEM = "
              "UTC\nMETA_STOP\n" ROWS,
         "no REF_FRAME"},
        {HEAD META ROW("00", "7000") "@2025-07-24T12:01:00 7000 0 0 7.5\n", "has 5 parts"},
        {HEAD META ROWS "2025-07-24T12:03:00 7000 @1e 0 0 7.5 0\n", "'1e' is no number"},
        {HEAD META ROWS "2025-07-24T12:03:00 7000 @nan 0 0 7.5 0\n", "'nan' is no number"},
        {HEAD META ROWS "@2025-07-24T12:60:00 7000 0 0 0 7.5 0\n", "12:60"},
        {HEAD META ROWS "@2025-07-24T12:05:00 7000000 0 70000000 0 7.5 0\n", "unit is km"},
        {HEAD META ROWS "@2025-07-24T12:05:00 0 0 0 0 7.5 0\n", "unit is km"},
        {HEAD META ROWS ROW("02", "7000"), "record 4 of this segment"},
        {HEAD META ROW("00", "7000") "2025-07-26T12:00:00 7000 0 0 0 7 0\n",
         "by 0.001 to 100000 s"},
        {HEAD META ROWS "@2025-07-24T12:05:00 7000 0 0 0 7000 0\n", "the unit is km/s"},
        {HEAD META ROW("00", "7000"), "one record"},
        {HEAD META, "no record"},
        {HEAD META ROWS "EPOCH = @2025-001\n", "among the records"},
        {HEAD META ROWS META ROW("01", "7000") ROW("05", "7000"), "before the one before it"},
        {HEAD META_OF("GCRF", "UTC", "USEABLE_START_TIME = 2025-07-24T13:00:00\n") ROWS,
         "may be used"},
    };
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        assert_text_refused(wrong[k][0], NULL, wrong[k][1]);
    }
}
END_TEST

START_TEST(test_oem_read_finds_all_errors)
{
    glint_errors *errors = glint_errors_new();
    orbit_table *table;
    ck_assert_int_eq(read_text(HEAD META_OF("TOD", "UTC", "INTERPOLATION = NO\n") ROW("00", "x")
                                   ROW("01", "70"),
                               NULL, &table, errors),
                     GLINT_INPUT);
    ck_assert_msg(glint_errors_error_count(errors) == 4, "%s", list_errors(errors));
    glint_errors_free(errors);
}
END_TEST

START_TEST(test_oem_read_warns_of_what_may_be_wrong)
{
    static const char *const doubtful[][2] = {
        {HEAD META_OF("GCRF", "UTC", "INTERPOLATON = HERMITE\n") ROWS ROW("03", "7003"),
         "is it INTERPOLATION?"},
        {HEAD META_OF("GCRF", "UTC", "STOP_TIME = 2025-07-24T13:00:00\n") ROWS ROW("03", "7003"),
         "3420 s before its STOP_TIME"},
        {HEAD META ROWS, "degree 5 is taken"}, /* Hermite's of degree 7 takes four records */
        {HEAD META ROWS ROW("03", "7003") "2025-07-24T12:04:00 7000 0 0 0 7.5 0", "no line end"},
    };
    for (size_t k = 0; k < COUNT_OF(doubtful); k++) {
        glint_errors *errors = glint_errors_new();
        orbit_table *table;
        ck_assert_msg(read_text(doubtful[k][0], NULL, &table, errors) == GLINT_OK, "%s",
                      list_errors(errors));
        ck_assert_msg(glint_errors_count(errors) == 1, "%s", list_errors(errors));
        const glint_error *warning = glint_errors_get(errors, 0);
        ck_assert_msg(strstr(warning->message, doubtful[k][1]) != NULL, "%s", warning->message);
        ck_assert_int_gt(warning->line, 0);
        orbit_table_free(table);
        glint_errors_free(errors);
    }
}
END_TEST

#define OTHER                                                                                      \
    "META_START\nOBJECT_NAME = BALL\nOBJECT_ID = 2\nCENTER_NAME = MARS\nREF_FRAME = ME\n"          \
    "TIME_SYSTEM = MET\nMETA_STOP\n1 2 3\n"

START_TEST(test_oem_read_chooses_an_object)
{
    static const char both[] = HEAD OTHER META ROWS ROW("03", "7003");
    static const char *const names[] = {"CUBE", "cube", "1"};
    for (size_t k = 0; k < COUNT_OF(names); k++) {
        orbit_table *table = read_table(write_file("both.oem", both), names[k], 0);
        ck_assert_str_eq(table->object, "CUBE");
        ck_assert_uint_eq(table->n, 1);
        orbit_table_free(table);
    }
    assert_text_refused(both, NULL, "several objects: BALL (2), CUBE (1); say which one");
    assert_text_refused(both, "cub",
                        "no object of the name or id 'cub'; it has BALL (2), CUBE (1)");
}
END_TEST

/* ------------------------------------------------------------------ other axes */

/* EME2000 is turned against GCRS by the frame bias: -16.6170, -6.8192 and -14.6 mas (IERS
 * Conventions 2010, section 5.4.4 and equation 5.21), here to first order: the second is 1e-14. */
START_TEST(test_oem_read_turns_eme2000_by_the_frame_bias)
{
    const double mas = ARCSEC * 1e-3, xi = -16.6170 * mas, eta = -6.8192 * mas, da = -14.6 * mas;
    static const char content[] = HEAD META_OF(
        "J2000", "UTC", "INTERPOLATION = LINEAR\n") "2025-07-24T12:00:00 7000 0 0 0 7 "
                                                    "0\n2025-07-24T12:01:00 0 7000 0 0 0 7\n"
                                                    "2025-07-24T12:02:00 0 0 7000 7 0 0\n";
    const double gcrs_eme[9] = {1, -da, xi, da, 1, eta, -xi, -eta, 1};
    orbit_table *table = read_table(write_file("eme.oem", content), NULL, 0);
    for (int k = 0; k < 3; k++) {
        double r_m[3], v_m_s[3];
        for (int i = 0; i < 3; i++) {
            r_m[i] = 7000e3 * gcrs_eme[3 * i + k];
            v_m_s[i] = 7000 * gcrs_eme[3 * i + (k + 1) % 3];
        }
        /* 1e-5 arcsec, to which models of the bias agree, at 7000 km */
        assert_state(table, 60.0 * k, r_m, v_m_s, 4e-4, 4e-7);
    }
    ck_assert_int_eq(table->segments[0].frame, TABLE_GCRS);
    orbit_table_free(table);
}
END_TEST

START_TEST(test_oem_table_frame_find_knows_names)
{
    static const struct {
        const char *name;
        table_frame frame;
        bool known, eme2000;
    } cases[] = {
        {"EME2000", TABLE_GCRS, true, true},   {"J2000", TABLE_GCRS, true, true},
        {"GCRF", TABLE_GCRS, true, false},     {"icrf", TABLE_GCRS, true, false},
        {"TEME", TABLE_TEME, true, false},     {"ITRF", TABLE_ITRS, true, false},
        {"ITRF2000", TABLE_ITRS, true, false}, {"ITRF-97", TABLE_ITRS, true, false},
        {"ITRF93", TABLE_ITRS, true, false},   {"itrf2020", TABLE_ITRS, true, false},
        {"ITRFx", TABLE_ITRS, false, false},   {"ITRF-", TABLE_ITRS, false, false},
        {"ITRF200", TABLE_ITRS, false, false}, {"TOD", TABLE_ITRS, false, false},
        {"GRC", TABLE_ITRS, false, false},     {"", TABLE_ITRS, false, false},
    };
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        table_frame frame;
        bool eme2000;
        ck_assert_msg(table_frame_find(cases[k].name, &frame, &eme2000) == cases[k].known, "%s",
                      cases[k].name);
        if (!cases[k].known) continue;
        ck_assert_int_eq(frame, cases[k].frame);
        ck_assert_int_eq(eme2000, cases[k].eme2000);
    }
}
END_TEST

/* A moment in five scales: TAI-UTC is 37 s in 2025, TT-TAI 32.184 s, TAI-GPS 19 s; TDB is within
 * 1.7 ms of TT. */
START_TEST(test_oem_read_takes_time_systems)
{
    static const struct {
        const char *system, *start, *stop;
        double tol_s;
    } cases[] = {{"UTC", "2025-205T12:00:00", "2025-205T12:01:00", 1e-9},
                 {"TAI", "2025-07-24T12:00:37", "2025-07-24T12:01:37", 1e-9},
                 {"TT", "2025-07-24T12:01:09.184", "2025-07-24T12:02:09.184", 1e-9},
                 {"TDB", "2025-07-24T12:01:09.184", "2025-07-24T12:02:09.184", 1.7e-3},
                 {"GPS", "2025-07-24T12:00:18", "2025-07-24T12:01:18", 1e-9}};
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        char content[1024];
        snprintf(content, sizeof content,
                 HEAD META_OF("GCRF", "%s", "INTERPOLATION = linear\n") "%s 7000 0 0 1 2 3\n"
                                                                        "%s 7060 0 0 1 2 3\n",
                 cases[k].system, cases[k].start, cases[k].stop);
        orbit_table *table = read_table(write_file("scale.oem", content), NULL, 0);
        assert_near(at(table, "2025-07-24T12:00:00"), 0, cases[k].tol_s);
        /* TDB gains 3.3e-10 of TT at most */
        assert_near(table->segments[0].nodes[1].t_s, 60, 2.5e-8);
        orbit_table_free(table);
    }
}
END_TEST

/* ---------------------------------------------------------------- truncation */

/* True when every record of `part` is one of `whole`: bit by bit, and in its place. */
static bool holds_first_records(const orbit_table *part, const orbit_table *whole)
{
    if (part->n > whole->n) return false;
    for (size_t k = 0; k < part->n; k++) {
        const table_segment *p = &part->segments[k], *w = &whole->segments[k];
        if (p->n > w->n || (k + 1 < part->n && p->n != w->n)) return false;
        if (memcmp(p->nodes, w->nodes, p->n * sizeof *p->nodes) != 0) return false;
        if (p->method != w->method || p->frame != w->frame || p->from_s != w->from_s) return false;
    }
    return true;
}

static void cut_everywhere(const char *path)
{
    size_t n;
    char *bytes = read_bytes(path, &n);
    orbit_table *whole, *part;
    const glint_status status = oem_read(path, PLACE_NONE, NULL, &whole, NULL);
    size_t sound = 0;
    for (size_t cut = 0; cut < n; cut++) {
        glint_errors *errors = glint_errors_new();
        if (oem_read(write_bytes("cut.oem", bytes, cut), PLACE_NONE, NULL, &part, errors)) {
            ck_assert_uint_gt(glint_errors_error_count(errors), 0);
            ck_assert_ptr_null(part);
        } else {
            ck_assert_msg(status == GLINT_OK && holds_first_records(part, whole),
                          "%s cut after %zu bytes of %zu", path, cut, n);
            orbit_table_free(part);
            sound++;
        }
        glint_errors_free(errors);
    }
    printf("%s: %zu of %zu cuts leave whole records\n", path, sound, n);
    orbit_table_free(whole);
    free(bytes);
}

START_TEST(test_oem_read_takes_no_cut_number_for_a_whole_one)
{
    cut_everywhere(data("cube.oem"));
    cut_everywhere(data("cube.xml"));
    const char *dir = reference_dir("cut samples of OEM");
    static const char *const samples[] = {"oem_iss_eme2000_v2.oem", "oem_itrf.oem",
                                          "oem_example3.xml"};
    for (size_t k = 0; dir && k < COUNT_OF(samples); k++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/samples/%s", dir, samples[k]);
        cut_everywhere(path);
    }
}
END_TEST

/* Bytes changed at random: an error, or a table whose states are numbers. */
static void damage(const char *path, int n_times, uint64_t seed)
{
    size_t n;
    char *whole = read_bytes(path, &n);
    for (int k = 0; k < n_times; k++) {
        char *bytes = string_copy(whole, n);
        for (int changes = 1 + (int)(random_next(&seed) % 4); changes > 0; changes--) {
            static const char likely[] = "0123456789.-+eE= \n\t<>/[]\"T:#\0";
            bytes[random_next(&seed) % n] = random_next(&seed) % 4
                                                ? likely[random_next(&seed) % sizeof likely]
                                                : (char)random_next(&seed);
        }
        orbit_table *table;
        if (!oem_read(write_bytes("damaged.oem", bytes, n), PLACE_NONE, NULL, &table, NULL)) {
            double from_s, to_s, r_m[3], v_m_s[3];
            table_frame frame;
            orbit_table_span(table, &from_s, &to_s);
            for (int i = 0; i <= 10; i++)
                if (!orbit_table_state(table, from_s + 0.1 * i * (to_s - from_s), &frame, r_m,
                                       v_m_s, NULL))
                    ck_assert(isfinite(dot3(r_m, r_m)) && isfinite(dot3(v_m_s, v_m_s)));
            orbit_table_free(table);
        }
        free(bytes);
    }
    free(whole);
}

START_TEST(test_oem_read_survives_damage)
{
    const char *times = getenv("GLINT_DAMAGE"); /* more of it, on request */
    const int n = times ? atoi(times) : 1500;
    damage(data("cube.oem"), n, 1);
    damage(data("cube.xml"), n, 2);
}
END_TEST

/* -------------------------------------------------------------- interpolation */

/* A table of n nodes `step_s` apart, from a function of time. */
typedef void motion(double t_s, const double *parameters, double r_m[3], double v_m_s[3]);

static orbit_table *table_of(motion *move, const double *parameters, int n, double step_s,
                             table_method method, int degree)
{
    const double reference_jd[2] = {2460880.5, 0.5};
    orbit_table *table = orbit_table_new("made", "OEM");
    table_segment *s = orbit_table_add(table);
    s->method = method;
    s->degree = degree;
    s->has_velocity = true;
    for (int k = 0; k < n; k++) {
        /* uneven where asked for by a negative step */
        const double t_s = step_s > 0 ? k * step_s : -step_s * (k + 0.2 * sin(7.0 * k));
        const double tt_jd[2] = {reference_jd[0], reference_jd[1] + t_s / DAY_S};
        double r_m[3], v_m_s[3];
        move(t_s, parameters, r_m, v_m_s);
        ck_assert(orbit_table_add_node(table, s, tt_jd, r_m, v_m_s));
        s->nodes[k].t_s = t_s; /* without the rounding of dates */
    }
    ck_assert_int_eq(orbit_table_finish(table, NULL), GLINT_OK);
    return table;
}

/* A polynomial in t/100 s of degree parameters[0], the same for all axes but for a sign. */
static void polynomial(double t_s, const double *parameters, double r_m[3], double v_m_s[3])
{
    const double x = t_s / 100.0;
    double value = 0, slope = 0;
    for (int k = (int)parameters[0]; k >= 0; k--) {
        slope = slope * x + value;
        value = value * x + parameters[1 + k];
    }
    for (int i = 0; i < 3; i++) {
        r_m[i] = (i == 1 ? -1 : 1) * value;
        v_m_s[i] = (i == 1 ? -1 : 1) * slope / 100.0;
    }
}

START_TEST(test_oem_interpolation_of_degree_k_is_exact_for_polynomials_of_degree_k)
{
    for (int k = 1; k <= 15; k++)
        for (int m = TABLE_LINEAR; m <= TABLE_HERMITE; m++) {
            const int degree = m == TABLE_LINEAR ? 1 : k;
            /* the largest value over the table is some 1e6 m */
            double p[17] = {degree, 3e5, -2e5, 1e5, -3e4, 8e3, -1e3, 100, -10, 1, -.1, 1e-2, -1e-3};
            orbit_table *table = table_of(polynomial, p, 20, -30.0, (table_method)m, degree);
            for (double t_s = 0; t_s < 560; t_s += 3.7) {
                double r_m[3], v_m_s[3];
                polynomial(t_s, p, r_m, v_m_s);
                /* Lagrange's velocities are polynomials of their own. The weights near the ends
                 * grow as 2^k and their slopes as k 2^k/step. */
                const double grown = ldexp(3e-16, degree) * 1e7;
                assert_state(table, t_s, r_m, v_m_s, grown + 1e-8, degree * grown / 30 + 1e-9);
            }
            orbit_table_free(table);
        }
}
END_TEST

START_TEST(test_oem_interpolation_reproduces_nodes_to_the_bit)
{
    const double p[6] = {4, 3e5, -2e5, 1e5, -3e4, 8e3};
    for (int m = TABLE_LINEAR; m <= TABLE_HERMITE; m++)
        for (int degree = 1; degree <= 12; degree++) {
            orbit_table *table = table_of(polynomial, p, 15, -30.0, (table_method)m, degree);
            for (size_t k = 0; k < 15; k++) {
                const table_node *node = &table->segments[0].nodes[k];
                assert_state(table, node->t_s, node->r_m, node->v_m_s, 0.0, 0.0);
            }
            orbit_table_free(table);
        }
}
END_TEST

/* parameters: radius (m), angular rate (rad/s). */
static void circle(double t_s, const double *parameters, double r_m[3], double v_m_s[3])
{
    const double a = parameters[0], n = parameters[1], c = cos(n * t_s), s = sin(n * t_s);
    r_m[0] = a * c, r_m[1] = a * s, r_m[2] = 0;
    v_m_s[0] = -a * n * s, v_m_s[1] = a * n * c, v_m_s[2] = 0;
}

/* The remainder of a polynomial through m conditions is f^(m)/m! times the product of the distances
 * to their nodes; on a circle |f^(m)| = a n^m. Halfway between the inner nodes it comes out to a
 * few percent, since the derivative turns little over the nodes. */
START_TEST(test_oem_interpolation_errs_as_theory_says)
{
    static const struct {
        table_method method;
        int degree, conditions;
        double product; /* of the distances, in steps */
    } cases[] = {{TABLE_LINEAR, 1, 2, 0.25},       {TABLE_LAGRANGE, 3, 4, 0.5625},
                 {TABLE_LAGRANGE, 5, 6, 3.515625}, {TABLE_LAGRANGE, 7, 8, 43.06640625},
                 {TABLE_HERMITE, 3, 4, 0.0625},    {TABLE_HERMITE, 7, 8, 0.31640625}};
    const double step_s = 200, p[2] = {6.8e6, 1.126e-3}; /* a low orbit */
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        orbit_table *table = table_of(circle, p, 20, step_s, cases[k].method, cases[k].degree);
        double want_m = p[0] * cases[k].product, r_m[3], v_m_s[3], true_m[3], unused[3];
        for (int i = 1; i <= cases[k].conditions; i++)
            want_m *= p[1] * step_s / i;
        const double t_s = 9.5 * step_s;
        table_frame frame;
        ck_assert_int_eq(orbit_table_state(table, t_s, &frame, r_m, v_m_s, NULL), GLINT_OK);
        circle(t_s, p, true_m, unused);
        sub3(r_m, true_m, r_m);
        assert_rel(norm3(r_m), want_m, 0.1);
        orbit_table_free(table);
    }
}
END_TEST

START_TEST(test_oem_interpolation_is_continuous_at_nodes)
{
    const double p[2] = {6.8e6, 1.126e-3};
    for (int m = TABLE_LINEAR; m <= TABLE_HERMITE; m++)
        for (int degree = 3; degree <= 8; degree++) {
            orbit_table *table = table_of(circle, p, 12, 200, (table_method)m, degree);
            for (int k = 1; k < 11; k++) {
                double before_m[3], after_m[3], unused[3];
                table_frame frame;
                const double t_s = 200.0 * k, little_s = 1e-9;
                orbit_table_state(table, t_s - little_s, &frame, before_m, unused, NULL);
                orbit_table_state(table, t_s, &frame, after_m, unused, NULL);
                sub3(after_m, before_m, after_m);
                assert_near(norm3(after_m), 0.0, 2e-5); /* 7.7 km/s over 1 ns, and rounding */
            }
            orbit_table_free(table);
        }
}
END_TEST

/* ---------------------------------------------------------------- whole orbits */

/* A run of half an hour, and its frames. */
static const utc_time run_start = {2025, 7, 24, 12, 0, 0.0};
static const double run_span_s = 1800.0;

static frame_grid *frames_of(run_clock *clock)
{
    static const earth_orientation no_polar_motion = {0, 0};
    frame_grid *grid = NULL;
    run_clock_start(&run_start, run_span_s, 0.0, clock);
    ck_assert_int_eq(
        frame_grid_prepare(clock, &no_polar_motion, -120, run_span_s + 120, 60, &grid, NULL),
        GLINT_OK);
    return grid;
}

/* Writes the states of an orbit every 60 s as OEM, from 2 min before the run to 2 min after. */
static const char *write_oem(const orbit *o, const frame_grid *grid, const char *frame_name)
{
    text out = {0};
    text_printf(&out, HEAD META_OF("%s", "TT", ""), frame_name);
    for (int k = -2; k <= 32; k++) {
        frame_set frames;
        double r_m[3], v_m_s[3], r[3], v[3];
        frame_grid_at(grid, 60.0 * k, FRAMES_TEME, &frames);
        ck_assert_int_eq(orbit_state(o, 60.0 * k, &frames, NULL, r_m, v_m_s, NULL), GLINT_OK);
        if (string_equal(frame_name, "TEME")) {
            mat_tvec(frames.gcrs_teme, r_m, r);
            mat_tvec(frames.gcrs_teme, v_m_s, v);
        } else if (string_equal(frame_name, "ITRF2020")) {
            mat_vec(frames.itrs_gcrs, r_m, r);
            mat_vec(frames.itrs_gcrs, v_m_s, v);
            v[0] += 7.2921151467e-5 * r[1]; /* rad/s: the rate of the Earth rotation angle */
            v[1] -= 7.2921151467e-5 * r[0];
        } else {
            copy3(r_m, r);
            copy3(v_m_s, v);
        }
        const int minute = k + 1; /* 12:00 UTC is 12:01:09.184 TT */
        text_printf(&out, "2025-07-24T%02d:%02d:09.184 %.17g %.17g %.17g %.17g %.17g %.17g\n",
                    minute < 0 ? 11 : 12, (minute + 60) % 60, r[0] * 1e-3, r[1] * 1e-3, r[2] * 1e-3,
                    v[0] * 1e-3, v[1] * 1e-3, v[2] * 1e-3);
    }
    const char *path = write_bytes("orbit.oem", out.data, out.length);
    text_free(&out);
    return path;
}

static void compare(const orbit *true_orbit, const char *frame_name, double tol_m, double tol_m_s)
{
    run_clock clock;
    frame_grid *grid = frames_of(&clock);
    orbit *o;
    orbit_table *table = read_table(write_oem(true_orbit, grid, frame_name), NULL, 0);
    ck_assert_int_eq(orbit_from_table(table, &clock, &o, NULL), GLINT_OK);
    for (double t_s = 0; t_s <= run_span_s; t_s += 7.3) {
        frame_set frames;
        double r_m[3], v_m_s[3], want_m[3], want_m_s[3];
        frame_grid_at(grid, t_s, FRAMES_TEME, &frames);
        ck_assert_int_eq(orbit_state(true_orbit, t_s, &frames, NULL, want_m, want_m_s, NULL),
                         GLINT_OK);
        frame_grid_at(grid, t_s, orbit_wanted_frames(o), &frames);
        ck_assert_int_eq(orbit_state(o, t_s, &frames, NULL, r_m, v_m_s, NULL), GLINT_OK);
        sub3(r_m, want_m, r_m);
        sub3(v_m_s, want_m_s, v_m_s);
        assert_near(norm3(r_m), 0.0, tol_m);
        assert_near(norm3(v_m_s), 0.0, tol_m_s);
    }
    orbit_free(o);
    frame_grid_free(grid);
}

/* Hermite's remainder at 60 s is a (n 60 s)^8/8! 0.88 at most, 4e-8 m; the file's rounding is
 * 1e-9 m, and that of its times 1e-11 s, or 1e-7 m. */
START_TEST(test_oem_table_of_a_kepler_orbit_follows_it)
{
    const kepler_elements elements = {6.8e6, 0.01, 0.9, 1.0, 0.5, 0.2};
    orbit *o;
    ck_assert_int_eq(orbit_from_kepler(&elements, -500, false, &o, NULL), GLINT_OK);
    compare(o, "GCRF", 1e-6, 1e-8);
    orbit_free(o);
}
END_TEST

/* The slow turns of these frames (precession, 8e-12 rad/s, 5e-5 m/s) are no part of the velocities
 * that are written, which bends the path between nodes: by less than a quarter of a step, 60 s, of
 * it. */
START_TEST(test_oem_table_in_turning_axes_follows_the_orbit)
{
    const kepler_elements elements = {6.8e6, 0.01, 0.9, 1.0, 0.5, 0.2};
    orbit *o;
    ck_assert_int_eq(orbit_from_kepler(&elements, -500, false, &o, NULL), GLINT_OK);
    compare(o, "TEME", 8e-4, 2e-4);
    compare(o, "ITRF2020", 8e-4, 2e-4);
    orbit_free(o);
}
END_TEST

/* Records of files that others wrote, at their own times. */
START_TEST(test_oem_read_reads_samples)
{
    static const struct {
        const char *file, *utc;
        double r_km[3], v_km_s[3];
        bool eme2000;
    } cases[] = {{"oem_iss_eme2000_v2.oem",
                  "2022-01-17T13:00:00",
                  {5021.218457183220, -2714.921344536780, -3693.631863364480},
                  {5.15002544728106, 3.64780592200467, 4.33367398742523},
                  true},
                 {"oem_itrf.oem",
                  "2017-04-12T00:31:43.121856",
                  {5825.853392143991, -3231.061588206852, 1282.967800440292},
                  {3.1070211850223437, 3.259992083196232, -5.8345209607524176},
                  false}};
    const char *dir = reference_dir("samples of OEM");
    for (size_t k = 0; dir && k < COUNT_OF(cases); k++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/samples/%s", dir, cases[k].file);
        orbit_table *table = read_table(path, "ISS", 0);
        double r_m[3], v_m_s[3];
        scale3(cases[k].r_km, 1e3, r_m);
        scale3(cases[k].v_km_s, 1e3, v_m_s);
        if (cases[k].eme2000) table_node_from_eme2000(r_m, v_m_s);
        /* m: rounding of dates, 1e-11 s, at 7.7 km/s */
        assert_state(table, at(table, cases[k].utc), r_m, v_m_s, 1e-6, 1e-9);
        orbit_table_free(table);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("oem");
    TCase *files = tcase_create("files"), *numbers = tcase_create("numbers");
    tcase_add_checked_fixture(files, folder_make, folder_remove);
    tcase_add_checked_fixture(numbers, folder_make, folder_remove);
    tcase_set_timeout(files, 300);
    tcase_add_test(files, test_oem_read_takes_segments_of_both_notations);
    tcase_add_test(files, test_oem_read_takes_line_ends_tabs_case_mark_and_long_lines);
    tcase_add_test(files, test_oem_read_respects_useable_times);
    tcase_add_test(files, test_oem_read_places_every_error);
    tcase_add_test(files, test_oem_read_finds_all_errors);
    tcase_add_test(files, test_oem_read_warns_of_what_may_be_wrong);
    tcase_add_test(files, test_oem_read_chooses_an_object);
    tcase_add_test(files, test_oem_read_turns_eme2000_by_the_frame_bias);
    tcase_add_test(files, test_oem_table_frame_find_knows_names);
    tcase_add_test(files, test_oem_read_takes_time_systems);
    tcase_add_test(files, test_oem_read_takes_no_cut_number_for_a_whole_one);
    tcase_add_test(files, test_oem_read_survives_damage);
    tcase_add_test(files, test_oem_read_reads_samples);
    tcase_add_test(numbers,
                   test_oem_interpolation_of_degree_k_is_exact_for_polynomials_of_degree_k);
    tcase_add_test(numbers, test_oem_interpolation_reproduces_nodes_to_the_bit);
    tcase_add_test(numbers, test_oem_interpolation_errs_as_theory_says);
    tcase_add_test(numbers, test_oem_interpolation_is_continuous_at_nodes);
    tcase_add_test(numbers, test_oem_table_of_a_kepler_orbit_follows_it);
    tcase_add_test(numbers, test_oem_table_in_turning_axes_follows_the_orbit);
    suite_add_tcase(suite, files);
    suite_add_tcase(suite, numbers);
    return run_suite(suite);
}
