/* The SGP4 propagator: the public verification set, its errors, the cursor, what it refuses. */
#include "base/constants.h"
#include "base/vec.h"
#include "orbit/sgp4.h"
#include "table.h"

/* The set prints km to 1e-8 and km/s to 1e-9. Positions differ by up to 1.2e-7 km where angles of
 * thousands of radians (years from the epoch) meet an eccentricity near 1: there two orders of
 * the same sums in double precision part; elsewhere by 7.1e-8 km (an orbit that reaches out to the
 * Moon) and less. */
static const double position_tolerance_km = 1.2e-7, velocity_tolerance_km_s = 9e-10;

enum { LINE_ROOM = 256, SETS_MAX = 64 };

/* The element sets of a verification file, in its order. */
typedef struct verification {
    int count;
    tle elements[SETS_MAX];
    double stop_min[SETS_MAX]; /* 0 where the file does not say */
} verification;

static void read_verification(const char *path, verification *v)
{
    char line1[LINE_ROOM], line2[LINE_ROOM];
    FILE *file = fopen(path, "r");
    ck_assert_msg(file != NULL, "cannot open %s", path);
    v->count = 0;
    while (fgets(line1, sizeof line1, file)) {
        if (line1[0] == '#') continue;
        ck_assert_int_lt(v->count, SETS_MAX);
        ck_assert_ptr_nonnull(fgets(line2, sizeof line2, file));
        glint_error error;
        const glint_status status =
            tle_parse(line1, line2, false, PLACE_NONE, NULL, &v->elements[v->count], &error);
        ck_assert_msg(status == GLINT_OK, "%s", error.message);
        double start_min, stop_min = 0.0;
        if (strlen(line2) > 69) sscanf(line2 + 69, "%lf %lf", &start_min, &stop_min);
        v->stop_min[v->count++] = stop_min;
    }
    fclose(file);
    ck_assert_int_gt(v->count, 0);
}

static sgp4 *prepare(const tle *elements)
{
    sgp4 *s;
    glint_error error;
    const glint_status status = sgp4_new(elements, &s, &error);
    ck_assert_msg(status == GLINT_OK, "%d: %s", elements->number, error.message);
    return s;
}

/* The propagator of a satellite of the set beside the tests. */
static sgp4 *prepare_number(int number)
{
    static verification v;
    read_verification(path_in(TEST_DATA_DIR, "sgp4_verification.tle"), &v);
    for (int k = 0; k < v.count; k++)
        if (v.elements[k].number == number) return prepare(&v.elements[k]);
    ck_abort_msg("the set has no satellite %d", number);
}

static tle parse(const char *line1, const char *line2)
{
    tle elements;
    glint_error error;
    const glint_status status = tle_parse(line1, line2, false, PLACE_NONE, NULL, &elements, &error);
    ck_assert_msg(status == GLINT_OK, "%s", error.message);
    return elements;
}

/* The largest deviations of a component from a table. */
typedef struct deviation {
    double km, km_s;
} deviation;

static void assert_state(int number, double minutes, const double r_m[3], const double v_m_s[3],
                         const double r_km[3], const double v_km_s[3], deviation *worst)
{
    for (int k = 0; k < 3; k++) {
        const double dr_km = r_m[k] / 1000.0 - r_km[k], dv_km_s = v_m_s[k] / 1000.0 - v_km_s[k];
        ck_assert_msg(is_near(dr_km, 0.0, position_tolerance_km),
                      "%d at %g min: %c is off by %g km", number, minutes, "xyz"[k], dr_km);
        ck_assert_msg(is_near(dv_km_s, 0.0, velocity_tolerance_km_s),
                      "%d at %g min: the rate of %c is off by %g km/s", number, minutes, "xyz"[k],
                      dv_km_s);
        worst->km = fmax(worst->km, fabs(dr_km));
        worst->km_s = fmax(worst->km_s, fabs(dv_km_s));
    }
}

/* ------------------------------------------------------------ published values */

START_TEST(test_sgp4_state_matches_published_rows)
{
    csv_table table = table_open(path_in(TEST_DATA_DIR, "sgp4_verification.csv"));
    deviation worst = {0};
    for (long row = 0; row < table.n_rows; row++) {
        const int number = (int)table_number(&table, row, "number");
        const double minutes = table_number(&table, row, "minutes");
        double r_km[3], v_km_s[3], r_m[3], v_m_s[3];
        table_vector(&table, row, "", "_km", r_km);
        table_vector(&table, row, "v", "_km_s", v_km_s);
        sgp4 *s = prepare_number(number);
        ck_assert_int_eq(sgp4_state(s, minutes, NULL, r_m, v_m_s, NULL), GLINT_OK);
        assert_state(number, minutes, r_m, v_m_s, r_km, v_km_s, &worst);
        sgp4_free(s);
    }
    csv_free(&table);
}
END_TEST

/* Compares the rows of one satellite up to the next header line; returns their number. */
static int compare_block(FILE *expected, const tle *elements, double *last_min, deviation *worst)
{
    char line[2 * LINE_ROOM];
    sgp4 *s = prepare(elements);
    sgp4_cursor cursor = {0};
    int rows = 0;
    while (fgets(line, sizeof line, expected) && !strstr(line, "xx")) {
        double minutes, r_km[3], v_km_s[3], r_m[3], v_m_s[3];
        ck_assert_int_eq(sscanf(line, "%lf %lf %lf %lf %lf %lf %lf", &minutes, &r_km[0], &r_km[1],
                                &r_km[2], &v_km_s[0], &v_km_s[1], &v_km_s[2]),
                         7);
        /* This one fails at once; the program that wrote the file repeated the row before. */
        if (elements->number == 33334) continue;
        glint_error error;
        const glint_status status = sgp4_state(s, minutes, &cursor, r_m, v_m_s, &error);
        ck_assert_msg(status == GLINT_OK, "%s", error.message);
        assert_state(elements->number, minutes, r_m, v_m_s, r_km, v_km_s, worst);
        *last_min = minutes;
        rows++;
    }
    sgp4_free(s);
    return rows;
}

START_TEST(test_sgp4_state_matches_whole_verification_set)
{
    const char *dir = reference_dir("the SGP4 verification set");
    if (!dir) return;
    static verification v;
    char line[LINE_ROOM];
    read_verification(path_in(dir, "golden/sgp4/SGP4-VER.TLE"), &v);
    FILE *expected = fopen(path_in(dir, "golden/sgp4/tcppver.out"), "r");
    ck_assert_ptr_nonnull(expected);
    ck_assert_ptr_nonnull(fgets(line, sizeof line, expected));
    int rows = 0, ended_early = 0;
    deviation worst = {0};
    for (int k = 0; k < v.count; k++) {
        double last_min = 0.0;
        rows += compare_block(expected, &v.elements[k], &last_min, &worst);
        ended_early += last_min < v.stop_min[k];
    }
    fclose(expected);
    printf("verification set: %d rows, worst: %.2g km, %.2g km/s\n", rows, worst.km, worst.km_s);
    ck_assert_int_eq(v.count, 33);
    ck_assert_int_eq(rows, 666); /* 667 lines less the repeated one */
    ck_assert_int_eq(ended_early, 7);
}
END_TEST

/* Where the set's satellites fail, with the number and the value that other programs report (the
 * unit tests of the public Python package sgp4, by B. Rhodes, list them). */
static const struct {
    int number;
    double minutes;
    const char *code, *value;
} published_errors[] = {
    {22312, 494.2028672, "SGP4 error 1:", "-0.001329"},
    {28350, 1560.0, "SGP4 error 1:", "-0.001208"},
    {28872, 55.0, "SGP4 error 6:", "0.996159"},
    {29141, 440.0, "SGP4 error 6:", "0.996252"},
    {33333, 25.0, "SGP4 error 4:", "-0.103223"},
    {33334, 0.0, "SGP4 error 3:", "-122.217"},
    {20413, 1844345.0, "SGP4 error 6:", "0.830534"},
};

START_TEST(test_sgp4_state_fails_as_published)
{
    sgp4 *s = prepare_number(published_errors[_i].number);
    double r[3] = {1, 2, 3}, v[3] = {4, 5, 6};
    glint_error error = {0};
    ck_assert_int_eq(sgp4_state(s, published_errors[_i].minutes, NULL, r, v, &error), GLINT_INPUT);
    ck_assert_msg(strstr(error.message, published_errors[_i].code) == error.message, "%s",
                  error.message);
    ck_assert_msg(strstr(error.message, published_errors[_i].value) != NULL, "%s", error.message);
    ck_assert(r[0] == 1 && r[1] == 2 && r[2] == 3 && v[0] == 4 && v[1] == 5 && v[2] == 6);
    ck_assert_int_eq(sgp4_state(s, published_errors[_i].minutes, NULL, r, v, NULL), GLINT_INPUT);
    sgp4_free(s);
}
END_TEST

/* An all but parabolic 24 h orbit, which the resonance drives below zero mean motion. */
START_TEST(test_sgp4_state_fails_by_number_2_when_mean_motion_is_lost)
{
    tle elements = parse("1 33335U 05008A   06176.46683397 -.00000205  00000-0  10000-3 0  2190",
                         "2 33335   0.0019 286.9433 0000004  13.7918  55.6504  1.06000000  4891");
    elements.eccentricity = 0.99999999;
    sgp4 *s = prepare(&elements);
    double r[3], v[3];
    glint_error error = {0};
    ck_assert_int_eq(sgp4_state(s, -60000.0, NULL, r, v, &error), GLINT_INPUT);
    ck_assert_msg(strstr(error.message, "SGP4 error 2:") == error.message, "%s", error.message);
    sgp4_free(s);
}
END_TEST

/* The published formulas square the drag's factor on the orbit's size, so that an orbit that has
 * shrunk to nothing grows again. Here it stays decayed. */
START_TEST(test_sgp4_state_stays_decayed_after_decay)
{
    const tle elements =
        parse("1 25544U 98067A   25206.16725053  .00012111  00000+0  21923-1 0  9999",
              "2 25544  51.6348 118.8254 0002056 114.0852 246.0352 15.50079803521055");
    sgp4 *s = prepare(&elements);
    double r[3], v[3];
    int first_failure = -1;
    for (int day = 0; day < 4000; day++) {
        const glint_status status = sgp4_state(s, 1440.0 * day, NULL, r, v, NULL);
        if (status && first_failure < 0) first_failure = day;
        ck_assert_msg(!(first_failure >= 0 && !status), "risen again on day %d", day);
    }
    ck_assert_int_gt(first_failure, 0);
    sgp4_free(s);
}
END_TEST

/* ------------------------------------------------------------ closed forms */

/* The node of a nearly circular orbit without drag drifts by -1.5 J2 n (Re/p)^2 cos i: first order
 * in J2, so to J2 relative, and the short-period terms (1.5e-3 rad at most) over 10 days. */
START_TEST(test_sgp4_state_turns_the_node_as_j2_says)
{
    const tle elements =
        parse("1 20580U 90037B   25206.18639832  .00000000  00000+0  00000+0 0  9994",
              "2 20580  28.4670 147.2783 0002058 146.9713 213.1010 15.25650446738758");
    const double j2 = 1.082616e-3, radius_m = 6378135.0, mu = 398600.8e9; /* WGS72 */
    const double days = 10.0, n_rad_s = 15.25650446 * TWO_PI / DAY_S;
    const double p_m = cbrt(mu / (n_rad_s * n_rad_s)); /* e^2: nothing */
    const double ratio = radius_m / p_m;
    const double expected = -1.5 * j2 * n_rad_s * ratio * ratio * cos(28.4670 * DEG) * days * DAY_S;
    sgp4 *s = prepare(&elements);
    double node[2];
    for (int k = 0; k < 2; k++) {
        double r[3], v[3], normal[3];
        ck_assert_int_eq(sgp4_state(s, 1440.0 * days * k, NULL, r, v, NULL), GLINT_OK);
        cross3(r, v, normal);
        node[k] = atan2(normal[0], -normal[1]);
    }
    assert_near(remainder(node[1] - node[0] - expected, TWO_PI), 0.0,
                3e-3 + 3.0 * j2 * fabs(expected));
    sgp4_free(s);
}
END_TEST

/* Velocity is the derivative of position but for the slow drift of the elements, which the theory
 * leaves out of it: J2 times the velocity, some m/s. */
START_TEST(test_sgp4_state_velocity_is_the_rate_of_position)
{
    static const int numbers[] = {5, 6251, 28057, 28129, 24208, 8195};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        sgp4 *s = prepare_number(numbers[k]);
        for (double minutes = -1000.0; minutes < 1000.0; minutes += 61.0) {
            const double step_min = 0.01; /* min; third derivatives: below 0.01 m/s */
            double before[3], after[3], r[3], v[3], ignored[3], rate[3];
            ck_assert_int_eq(sgp4_state(s, minutes - step_min, NULL, before, ignored, NULL), 0);
            ck_assert_int_eq(sgp4_state(s, minutes + step_min, NULL, after, ignored, NULL), 0);
            ck_assert_int_eq(sgp4_state(s, minutes, NULL, r, v, NULL), 0);
            sub3(after, before, rate);
            scale3(rate, 1.0 / (120.0 * step_min), rate);
            sub3(rate, v, rate);
            assert_near(norm3(rate), 0.0, 1.0826e-3 * norm3(v));
        }
        sgp4_free(s);
    }
}
END_TEST

START_TEST(test_sgp4_is_deep_space_from_a_period_of_225_min)
{
    const char *line1 = "1 88888U          80275.98708465  .00000000  00000-0  00000-0 0    87";
    /* 1440/225 = 6.4 rev/day in Brouwer's mean motion, which J2 keeps within 2e-4 of Kozai's here
     */
    const tle shorter =
        parse(line1, "2 88888  72.8435 115.9689 0086731  52.6988 110.5714  6.40200000  1058");
    const tle longer =
        parse(line1, "2 88888  72.8435 115.9689 0086731  52.6988 110.5714  6.39800000  1058");
    sgp4 *near_earth = prepare(&shorter), *deep = prepare(&longer);
    ck_assert(!sgp4_is_deep_space(near_earth));
    ck_assert(sgp4_is_deep_space(deep));
    sgp4_free(near_earth);
    sgp4_free(deep);
}
END_TEST

/* ------------------------------------------------------------ the cursor */

/* A pseudorandom number in [0, 1): MMIX's linear congruential generator (Knuth), upper bits. */
static double next_random(unsigned long long *state)
{
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(*state >> 11) * 0x1p-53;
}

/* 24 h resonance (geostationary, inclined), 12 h resonance (three eccentricities), none. */
static const int cursor_numbers[] = {28626, 24208, 9880, 8195, 21897, 28129, 5};
enum { N_CURSOR_NUMBERS = sizeof cursor_numbers / sizeof *cursor_numbers };

static void assert_same_bits(const sgp4 *s, double minutes, sgp4_cursor *cursor)
{
    double r0[3], v0[3], r1[3], v1[3];
    const glint_status alone = sgp4_state(s, minutes, NULL, r0, v0, NULL);
    ck_assert_int_eq(sgp4_state(s, minutes, cursor, r1, v1, NULL), alone);
    if (alone) return;
    ck_assert_msg(memcmp(r0, r1, sizeof r0) == 0 && memcmp(v0, v1, sizeof v0) == 0,
                  "the cursor changes the result at %.17g min", minutes);
}

START_TEST(test_sgp4_state_is_the_same_to_the_bit_with_any_cursor)
{
    sgp4 *s = prepare_number(cursor_numbers[_i]);
    sgp4_cursor cursor = {0};
    unsigned long long seed = 7 + (unsigned)_i;
    for (int k = 0; k < 2000; k++) /* forward and backward, near and far, on both sides */
        assert_same_bits(s, (next_random(&seed) - 0.5) * (k % 3 ? 5e3 : 4e5), &cursor);
    for (int k = -60; k <= 60; k++) /* the integrator's own nodes, and beside them */
        for (int side = -1; side <= 1; side++)
            assert_same_bits(s, 720.0 * k + 1e-9 * side, &cursor);
    for (double t = -3000.0; t < 3000.0; t += 17.0) /* in order, across the epoch */
        assert_same_bits(s, t, &cursor);
    for (double t = 3000.0; t > -3000.0; t -= 17.0)
        assert_same_bits(s, t, &cursor);
    sgp4_free(s);
}
END_TEST

START_TEST(test_sgp4_state_is_the_same_to_the_bit_with_a_shared_cursor)
{
    sgp4 *s[N_CURSOR_NUMBERS];
    sgp4_cursor cursor = {0};
    for (int k = 0; k < N_CURSOR_NUMBERS; k++)
        s[k] = prepare_number(cursor_numbers[k]);
    for (double t = 0.0; t < 6000.0; t += 100.0)
        for (int k = 0; k < N_CURSOR_NUMBERS; k++)
            assert_same_bits(s[k], t, &cursor);
    for (int k = 0; k < N_CURSOR_NUMBERS; k++)
        sgp4_free(s[k]);
}
END_TEST

/* ------------------------------------------------------------ refusals, limits */

START_TEST(test_sgp4_state_refuses_times_out_of_reach)
{
    static const double beyond[] = {
        SGP4_SPAN_MIN + 1.0, -SGP4_SPAN_MIN - 1.0, 1e15, -1e300, INFINITY, -INFINITY, NAN};
    sgp4 *s = prepare_number(9880);
    sgp4_cursor cursor = {0};
    double r[3], v[3];
    for (size_t k = 0; k < sizeof beyond / sizeof *beyond; k++) {
        glint_error error = {0};
        ck_assert_int_eq(sgp4_state(s, beyond[k], &cursor, r, v, &error), GLINT_INPUT);
        ck_assert_msg(strstr(error.message, "out of reach") != NULL, "%s", error.message);
    }
    sgp4_free(s);
}
END_TEST

/* At the ends of the span every set of the file answers, with a state or an error; the test
 * framework ends a test that hangs. */
START_TEST(test_sgp4_state_answers_at_the_ends_of_the_span)
{
    static verification sets;
    read_verification(path_in(TEST_DATA_DIR, "sgp4_verification.tle"), &sets);
    for (int k = 0; k < sets.count; k++) {
        sgp4 *s = prepare(&sets.elements[k]);
        for (int sign = -1; sign <= 1; sign += 2) {
            double r[3], v[3];
            if (sgp4_state(s, sign * SGP4_SPAN_MIN, NULL, r, v, NULL)) continue;
            ck_assert(isfinite(norm3(r)) && isfinite(norm3(v)));
        }
        sgp4_free(s);
    }
}
END_TEST

/* Elements from all over their ranges, and beyond what catalogues hold. */
static tle random_elements(unsigned long long *seed)
{
    tle e = {.number = 1, .epoch_jd = {2460310.5, 0.25}};
    e.eccentricity = next_random(seed);
    if (next_random(seed) < 0.3) e.eccentricity *= 0.01;
    if (next_random(seed) < 0.1) e.eccentricity = 1.0 - pow(10.0, -8.0 * next_random(seed));
    e.inclination = PI * next_random(seed);
    if (next_random(seed) < 0.1) e.inclination = 0.0;
    if (next_random(seed) < 0.1) e.inclination = PI;
    e.raan = TWO_PI * next_random(seed);
    e.argument_of_perigee = TWO_PI * next_random(seed);
    e.mean_anomaly = TWO_PI * next_random(seed);
    double rev_per_day = pow(10.0, 3.0 * next_random(seed) - 1.5);
    if (next_random(seed) < 0.2) rev_per_day = 2.0 + 0.1 * (next_random(seed) - 0.5);
    if (next_random(seed) < 0.2) rev_per_day = 1.0 + 0.3 * (next_random(seed) - 0.5);
    e.mean_motion = rev_per_day * TWO_PI / 1440.0;
    e.bstar = pow(10.0, -8.0 * next_random(seed)) * (next_random(seed) < 0.5 ? -1.0 : 1.0);
    return e;
}

START_TEST(test_sgp4_state_is_finite_or_an_error_for_any_elements)
{
    unsigned long long seed = 11;
    int answered = 0;
    for (int k = 0; k < 20000; k++) {
        const tle elements = random_elements(&seed);
        sgp4 *s;
        if (sgp4_new(&elements, &s, NULL)) continue;
        for (int j = 0; j < 4; j++) {
            const double far = pow(10.0, 6.0 * next_random(&seed));
            double r[3] = {NAN, NAN, NAN}, v[3] = {NAN, NAN, NAN};
            if (sgp4_state(s, far * (2.0 * next_random(&seed) - 1.0), NULL, r, v, NULL)) continue;
            answered++;
            ck_assert_msg(isfinite(norm3(r)) && isfinite(norm3(v)), "e %.17g, i %.17g, n %.17g",
                          elements.eccentricity, elements.inclination, elements.mean_motion);
        }
        sgp4_free(s);
    }
    ck_assert_int_gt(answered, 20000);
}
END_TEST

static void break_elements(tle *e, int how)
{
    switch (how) {
    case 0:
        e->eccentricity = 1.0;
        break;
    case 1:
        e->eccentricity = -1e-9;
        break;
    case 2:
        e->eccentricity = NAN;
        break;
    case 3:
        e->mean_motion = 0.0;
        break;
    case 4:
        e->mean_motion = -0.06;
        break;
    case 5:
        e->mean_motion = INFINITY;
        break;
    case 6:
        e->inclination = -0.1;
        break;
    case 7:
        e->inclination = 3.2;
        break;
    case 8:
        e->raan = NAN;
        break;
    case 9:
        e->argument_of_perigee = INFINITY;
        break;
    case 10:
        e->mean_anomaly = NAN;
        break;
    case 11:
        e->bstar = NAN;
        break;
    case 12:
        e->epoch_jd[0] = NAN;
        break;
    case 13:
        e->epoch_jd[0] = 0.0;
        break;
    case 14:
        e->mean_motion = 17.2 * TWO_PI / 1440.0;
        break; /* 21 km below the surface */
    }
}

enum { N_BROKEN = 15 };

START_TEST(test_sgp4_new_refuses_elements_out_of_range)
{
    tle elements = parse("1 25544U 98067A   25206.16725053  .00012111  00000+0  21923-3 0  9999",
                         "2 25544  51.6348 118.8254 0002056 114.0852 246.0352 15.50079803521055");
    elements.where = (place){"stations.tle", 7, 1};
    sgp4 *s = prepare(&elements);
    sgp4_free(s);
    break_elements(&elements, _i);
    glint_error error = {0};
    ck_assert_int_eq(sgp4_new(&elements, &s, &error), GLINT_INPUT);
    ck_assert_ptr_null(s);
    ck_assert_str_eq(error.file, "stations.tle");
    ck_assert_int_eq(error.line, 7);
    ck_assert_msg(strstr(error.message, "25544") && strstr(error.message, "expected"), "%s",
                  error.message);
    ck_assert_int_eq(sgp4_new(&elements, &s, NULL), GLINT_INPUT);
}
END_TEST

START_TEST(test_sgp4_free_takes_null)
{
    sgp4_free(NULL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("sgp4");
    TCase *published = tcase_create("published");
    tcase_set_timeout(published, 60); /* s */
    tcase_add_test(published, test_sgp4_state_matches_published_rows);
    tcase_add_test(published, test_sgp4_state_matches_whole_verification_set);
    tcase_add_loop_test(published, test_sgp4_state_fails_as_published, 0,
                        sizeof published_errors / sizeof *published_errors);
    tcase_add_test(published, test_sgp4_state_fails_by_number_2_when_mean_motion_is_lost);
    tcase_add_test(published, test_sgp4_state_stays_decayed_after_decay);
    suite_add_tcase(suite, published);

    TCase *forms = tcase_create("closed forms");
    tcase_add_test(forms, test_sgp4_state_turns_the_node_as_j2_says);
    tcase_add_test(forms, test_sgp4_state_velocity_is_the_rate_of_position);
    tcase_add_test(forms, test_sgp4_is_deep_space_from_a_period_of_225_min);
    suite_add_tcase(suite, forms);

    TCase *cursor = tcase_create("cursor");
    tcase_set_timeout(cursor, 60); /* s */
    tcase_add_loop_test(cursor, test_sgp4_state_is_the_same_to_the_bit_with_any_cursor, 0,
                        N_CURSOR_NUMBERS);
    tcase_add_test(cursor, test_sgp4_state_is_the_same_to_the_bit_with_a_shared_cursor);
    suite_add_tcase(suite, cursor);

    TCase *limits = tcase_create("limits");
    tcase_set_timeout(limits, 60); /* s */
    tcase_add_test(limits, test_sgp4_state_refuses_times_out_of_reach);
    tcase_add_test(limits, test_sgp4_state_answers_at_the_ends_of_the_span);
    tcase_add_test(limits, test_sgp4_state_is_finite_or_an_error_for_any_elements);
    tcase_add_loop_test(limits, test_sgp4_new_refuses_elements_out_of_range, 0, N_BROKEN);
    tcase_add_test(limits, test_sgp4_free_takes_null);
    suite_add_tcase(suite, limits);
    return run_suite(suite);
}
