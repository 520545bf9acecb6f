/* The one face of the propagators: element sets to GCRS end to end, Kepler, geostationary. */
#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "kepler_table.h"
#include "orbit/earth.h"
#include "orbit/orbit.h"
#include "testing.h"

static void assert_vec_near(const double got[3], double x, double y, double z, double tol)
{
    assert_near(got[0], x, tol);
    assert_near(got[1], y, tol);
    assert_near(got[2], z, tol);
}

/* ---------------------------------------------------------------- element sets */

/* The synthetic element sets of the topocentric reference. */
static const char *const element_sets[][2] = {
    {"1 25544U 98067A   24001.50000000  .00016717  00000-0  30270-3 0  9999",
     "2 25544  51.6400 208.9163 0006317  69.9862 290.2553 15.49560532 10001"},
    {"1 41866U 16071A   24001.50000000 -.00000100  00000-0  00000+0 0  9993",
     "2 41866   0.0300  90.0000 0001000 100.0000 262.0000  1.00271000 26000"}};

static tle elements_of(int k)
{
    tle elements;
    glint_error error = {0};
    const glint_status status = tle_parse(element_sets[k][0], element_sets[k][1], true,
                                          (place){"synthetic.3le", 2, 1}, NULL, &elements, &error);
    ck_assert_msg(status == GLINT_OK, "%s", error.message);
    return elements;
}

/* A run of two and a half days from 2024-01-01T00:00:00 UTC; the element sets' epoch is at noon. */
static const utc_time run_start = {2024, 1, 1, 0, 0, 0.0};
static const double run_span_s = 2.5 * DAY_S, noon_s = 43200.0;

typedef struct run {
    run_clock clock;
    frame_grid *grid;
} run;

static run start_run(void)
{
    static const earth_orientation no_polar_motion = {0, 0};
    run r = {.grid = NULL};
    run_clock_start(&run_start, run_span_s, 0.0, &r.clock);
    ck_assert_int_eq(
        frame_grid_prepare(&r.clock, &no_polar_motion, 0.0, run_span_s, 60.0, &r.grid, NULL),
        GLINT_OK);
    return r;
}

static orbit *orbit_of(int k, const run_clock *clock)
{
    const tle elements = elements_of(k);
    glint_error error = {0};
    orbit *o = NULL;
    ck_assert_msg(orbit_from_sets(&elements, 1, clock, 0, 0, &o, &error) == GLINT_OK, "%s",
                  error.message);
    return o;
}

static void state_at(const run *r, const orbit *o, double t_s, orbit_cursor *cursor,
                     frame_set *frames, double r_gcrs_m[3], double v_gcrs_m_s[3])
{
    glint_error error = {0};
    frame_grid_at(r->grid, t_s, orbit_wanted_frames(o), frames);
    ck_assert_msg(orbit_state(o, t_s, frames, cursor, r_gcrs_m, v_gcrs_m_s, &error) == GLINT_OK,
                  "%s", error.message);
}

/* How fast the range from a site grows: the part along the line of sight of the velocity in ITRS,
 * which is the inertial one less omega x r. */
static double range_rate(const csv_table *t, long row, const frame_set *frames,
                         const double r_itrs_m[3], const double v_gcrs_m_s[3])
{
    earth_site site;
    ck_assert_int_eq(earth_site_at(table_number(t, row, "lat_deg") * DEG,
                                   table_number(t, row, "lon_deg") * DEG,
                                   table_number(t, row, "h_m"), &site, NULL),
                     GLINT_OK);
    double v_itrs_m_s[3], sight[3];
    mat_vec(frames->itrs_gcrs, v_gcrs_m_s, v_itrs_m_s);
    v_itrs_m_s[0] += EARTH_RATE_RAD_S * r_itrs_m[1];
    v_itrs_m_s[1] -= EARTH_RATE_RAD_S * r_itrs_m[0];
    sub3(r_itrs_m, site.r_itrs_m, sight);
    unit3(sight, sight);
    return dot3(v_itrs_m_s, sight);
}

static void check_golden_topocentric(const char *path)
{
    csv_table t = table_open(path);
    run r = start_run();
    orbit *orbits[2] = {orbit_of(0, &r.clock), orbit_of(1, &r.clock)};
    orbit_cursor cursors[2] = {0};
    for (long row = 0; row < t.n_rows; row++) {
        const int k = string_equal(table_text(&t, row, "sat"), "GEO");
        const double t_s = noon_s + 60.0 * table_number(&t, row, "tsince_min");
        frame_set frames;
        double r_gcrs_m[3], v_gcrs_m_s[3], r_itrs_m[3], want_km[3];
        state_at(&r, orbits[k], t_s, &cursors[k], &frames, r_gcrs_m, v_gcrs_m_s);
        mat_vec(frames.itrs_gcrs, r_gcrs_m, r_itrs_m);
        table_vector(&t, row, "itrs_", "_km", want_km);
        /* m: half a decimal of the file and what SGP4 itself is held to */
        assert_vec_near(r_itrs_m, 1e3 * want_km[0], 1e3 * want_km[1], 1e3 * want_km[2], 2e-4);
        /* m/s: the true rate of rotation is 2e-8 above the nominal one */
        assert_near(range_rate(&t, row, &frames, r_itrs_m, v_gcrs_m_s),
                    1e3 * table_number(&t, row, "range_rate_kms"), 1e-4);
    }
    orbit_free(orbits[0]);
    orbit_free(orbits[1]);
    frame_grid_free(r.grid);
    csv_free(&t);
}

START_TEST(test_orbit_element_set_matches_reference)
{
    table_check(check_golden_topocentric, "orbit/topocentric.csv");
}
END_TEST

/* TEME is not GCRS: precession since J2000.0 has moved the equinox and the pole, and places near
 * the equator with them, by 46.12 arcsec a year in right ascension and by 20.04 arcsec a year times
 * the cosine of right ascension in declination (Lieske et al. 1977). Nutation, which those leave
 * out, is below 10 arcsec in each. */
START_TEST(test_orbit_element_set_is_turned_out_of_teme)
{
    const double years = 24.0, left_out = 15 * ARCSEC;
    csv_table t = table_open(path_in(TEST_DATA_DIR, "orbit/topocentric.csv"));
    run r = start_run();
    orbit *o = orbit_of(1, &r.clock);
    for (long row = 0; row < t.n_rows; row++) {
        if (!string_equal(table_text(&t, row, "sat"), "GEO")) continue;
        frame_set frames;
        double teme_m[3], r_gcrs_m[3], v_gcrs_m_s[3];
        table_vector(&t, row, "teme_", "_km", teme_m);
        scale3(teme_m, 1e3, teme_m);
        state_at(&r, o, noon_s + 60.0 * table_number(&t, row, "tsince_min"), NULL, &frames,
                 r_gcrs_m, v_gcrs_m_s);
        const double far_m = norm3(teme_m), ra = atan2(teme_m[1], teme_m[0]);
        assert_near(norm3(r_gcrs_m), far_m, 1e-2); /* m */
        const double ra_shift = remainder(ra - atan2(r_gcrs_m[1], r_gcrs_m[0]), TWO_PI);
        assert_near(ra_shift, 46.12 * years * ARCSEC, left_out);
        assert_near((teme_m[2] - r_gcrs_m[2]) / far_m, 20.04 * years * cos(ra) * ARCSEC, left_out);
    }
    orbit_free(o);
    frame_grid_free(r.grid);
    csv_free(&t);
}
END_TEST

/* The epoch is noon in UTC, and the run counts TT: no leap second lies between, so 43200 s. From a
 * start before the leap second of 2016-12-31 there are 7.5 years of 86400 s and one second more. */
START_TEST(test_orbit_element_set_epoch_counts_tt)
{
    run_clock clock;
    size_t n;
    run_clock_start(&run_start, 60.0, 0.0, &clock);
    orbit *o = orbit_of(0, &clock);
    /* the epoch of a line is given to 1e-8 d, and two-part dates keep 1e-11 d at least */
    assert_near(orbit_sets(o, &n)->epoch_s, noon_s, 1e-6);
    ck_assert_uint_eq(n, 1);
    ck_assert_uint_eq(orbit_wanted_frames(o), FRAMES_TEME);
    orbit_free(o);
    const utc_time before = {2016, 7, 1, 0, 0, 0.0};
    run_clock_start(&before, 60.0, 0.0, &clock);
    o = orbit_of(0, &clock);
    const double days = 184 + 7 * 365 + 1; /* of 2016; of 2017 to 2023, with 2020 a leap year */
    assert_near(orbit_sets(o, &n)->epoch_s, days * DAY_S + 1.0 + noon_s, 1e-6);
    orbit_free(o);
}
END_TEST

/* A cursor is a memory, not an input: not one bit depends on it, in any order of time. */
START_TEST(test_orbit_state_does_not_depend_on_the_cursor)
{
    run r = start_run();
    orbit *o = orbit_of(1, &r.clock);
    orbit_cursor cursor = {0};
    for (int k = 0; k < 40; k++) {
        const double t_s = fmod(7919.0 * 13 * k, run_span_s);
        frame_set frames;
        double with_r[3], with_v[3], without_r[3], without_v[3];
        state_at(&r, o, t_s, &cursor, &frames, with_r, with_v);
        state_at(&r, o, t_s, NULL, &frames, without_r, without_v);
        assert_vec_near(with_r, without_r[0], without_r[1], without_r[2], 0);
        assert_vec_near(with_v, without_v[0], without_v[1], without_v[2], 0);
    }
    orbit_free(o);
    frame_grid_free(r.grid);
}
END_TEST

/* A low orbit with a huge drag term is down within days; the error says when it was asked for. */
START_TEST(test_orbit_element_set_that_decays_says_when)
{
    run r = start_run();
    tle elements = elements_of(0);
    elements.bstar = 0.9;
    orbit *o;
    ck_assert_int_eq(orbit_from_sets(&elements, 1, &r.clock, 0, 0, &o, NULL), GLINT_OK);
    frame_set frames;
    frame_grid_at(r.grid, 0.0, FRAMES_TEME, &frames);
    double r_m[3], v_m_s[3];
    glint_error error = {0};
    ck_assert_int_eq(orbit_state(o, 40 * DAY_S, &frames, NULL, r_m, v_m_s, &error), GLINT_INPUT);
    ck_assert_msg(strstr(error.message, "3456000 s from the start") != NULL, "%s", error.message);
    ck_assert_int_eq(orbit_state(o, 40 * DAY_S, &frames, NULL, r_m, v_m_s, NULL), GLINT_INPUT);
    orbit_free(o);
    frame_grid_free(r.grid);
}
END_TEST

START_TEST(test_orbit_element_set_that_sgp4_refuses)
{
    run_clock clock;
    run_clock_start(&run_start, 60.0, 0.0, &clock);
    tle elements = elements_of(0);
    elements.mean_motion = 0.1; /* rad/min: 23 turns a day, inside the Earth */
    orbit *o;
    glint_error error = {0};
    ck_assert_int_eq(orbit_from_sets(&elements, 1, &clock, 0, 0, &o, &error), GLINT_INPUT);
    ck_assert_ptr_null(o);
    ck_assert_uint_gt(strlen(error.message), 0);
}
END_TEST

/* ---------------------------------------------------------------------- Kepler */

static kepler_elements golden_elements(const csv_table *t, long row)
{
    return (kepler_elements){.semi_major_axis_m = 1e3 * table_number(t, row, "a_km"),
                             .eccentricity = table_number(t, row, "e"),
                             .inclination = DEG * table_number(t, row, "i_deg"),
                             .raan = DEG * table_number(t, row, "raan_deg"),
                             .argument_of_perigee = DEG * table_number(t, row, "argp_deg"),
                             .mean_anomaly = DEG * table_number(t, row, "M0_deg")};
}

/* Follows one row, with the epoch of the elements anywhere in the run. */
static void check_golden_state(const csv_table *t, long row, bool j2, double tol_m, double tol_m_s)
{
    const double epoch_s = -1234.5, t_s = table_number(t, row, "t_s");
    const kepler_elements elements = golden_elements(t, row);
    orbit *o;
    double r_m[3], v_m_s[3], want[3];
    ck_assert_int_eq(orbit_from_kepler(&elements, epoch_s, j2, &o, NULL), GLINT_OK);
    ck_assert_int_eq(orbit_state(o, epoch_s + t_s, NULL, NULL, r_m, v_m_s, NULL), GLINT_OK);
    table_vector(t, row, "", "_km", want);
    assert_vec_near(r_m, 1e3 * want[0], 1e3 * want[1], 1e3 * want[2], tol_m);
    table_kepler_velocity(t, row, j2, want);
    assert_vec_near(v_m_s, 1e3 * want[0], 1e3 * want[1], 1e3 * want[2], tol_m_s);
    ck_assert_uint_eq(orbit_wanted_frames(o), 0);
    orbit_free(o);
}

static void check_golden_two_body(const char *path)
{
    csv_table t = table_open(path);
    for (long row = 0; row < t.n_rows; row++)
        check_golden_state(&t, row, false, 1e-3, 1e-6);
    csv_free(&t);
}

START_TEST(test_orbit_kepler_matches_reference)
{
    table_check(check_golden_two_body, "orbit/kepler_twobody.csv");
}
END_TEST

/* The reference has J2 = 1.08262668e-3, the orbit WGS84's 1.0826298e-3, 3e-6 more: over 5400 s, in
 * which J2 moves a low satellite by 25 km, that is 0.2 m and 2e-4 m/s. */
static void check_golden_j2(const char *path)
{
    csv_table t = table_open(path);
    long n_checked = 0;
    for (long row = 0; row < t.n_rows; row++)
        if (fabs(table_number(&t, row, "t_s")) <= 5401.0) {
            check_golden_state(&t, row, true, 0.3, 3e-4);
            n_checked++;
        }
    ck_assert_int_gt(n_checked, 0);
    csv_free(&t);
}

START_TEST(test_orbit_kepler_with_j2_matches_reference)
{
    table_check(check_golden_j2, "orbit/kepler_j2secular.csv");
}
END_TEST

START_TEST(test_orbit_kepler_perigee_inside_the_earth_is_refused)
{
    kepler_elements elements = {.semi_major_axis_m = 6500e3, .eccentricity = 0.1};
    orbit *o;
    glint_error error = {0};
    ck_assert_int_eq(orbit_from_kepler(&elements, 0, false, &o, &error), GLINT_INPUT);
    ck_assert_ptr_null(o);
    /* 6500 km x 0.9 - 6378.137 km */
    ck_assert_msg(strstr(error.message, "-528.137 km") != NULL, "%s", error.message);
    elements.semi_major_axis_m = 6378.138e3, elements.eccentricity = 0;
    ck_assert_int_eq(orbit_from_kepler(&elements, 0, false, &o, &error), GLINT_OK);
    orbit_free(o);
    elements.eccentricity = 1.0;
    ck_assert_int_eq(orbit_from_kepler(&elements, 0, true, &o, &error), GLINT_INPUT);
    ck_assert_ptr_null(o);
    elements.eccentricity = NAN;
    ck_assert_int_eq(orbit_from_kepler(&elements, 0, true, &o, NULL), GLINT_INPUT);
}
END_TEST

/* ---------------------------------------------------------------- geostationary */

/* With the Earth turned by an angle about z, the satellite stands at longitude + angle, 42164.17 km
 * out, and moves eastwards at 7.292115e-5 rad/s x 42164.17 km = 3074.66 m/s: the rate of the Earth
 * rotation angle, 2 pi 1.00273781191135448 a day (IERS Conventions 2010, equation 5.15). */
START_TEST(test_orbit_geostationary_closed_form)
{
    const double radius_m = 42164.17e3,
                 speed_m_s = 2 * PI * 1.00273781191135448 / 86400 * 42164.17e3;
    const double longitude = 16.37 * DEG;
    orbit *o;
    ck_assert_int_eq(orbit_geostationary(longitude, &o, NULL), GLINT_OK);
    for (int k = 0; k < 12; k++) {
        const double turned = 0.55 * k, at = longitude + turned;
        frame_set frames = {
            .itrs_gcrs = {cos(turned), sin(turned), 0, -sin(turned), cos(turned), 0, 0, 0, 1}};
        double r_m[3], v_m_s[3];
        ck_assert_int_eq(orbit_state(o, 100.0 * k, &frames, NULL, r_m, v_m_s, NULL), GLINT_OK);
        assert_vec_near(r_m, radius_m * cos(at), radius_m * sin(at), 0, 1e-7);
        assert_vec_near(v_m_s, -speed_m_s * sin(at), speed_m_s * cos(at), 0, 1e-11);
    }
    ck_assert_uint_eq(orbit_wanted_frames(o), 0);
    orbit_free(o);
}
END_TEST

/* In the true frames: at rest in ITRS, and the velocity is how the position changes. Differences
 * over 20 s leave (10 s omega)^2 / 6 of the speed (2.7e-4 m/s), and the true rate of rotation is
 * 2e-8 above the nominal one (6e-5 m/s). */
START_TEST(test_orbit_geostationary_velocity_is_the_change_of_position)
{
    run r = start_run();
    orbit *o;
    ck_assert_int_eq(orbit_geostationary(-75 * DEG, &o, NULL), GLINT_OK);
    for (double t_s = 3600; t_s < DAY_S; t_s += 7200) {
        frame_set frames;
        double before_m[3], after_m[3], r_m[3], v_m_s[3], itrs_m[3], change_m_s[3], ignored[3];
        state_at(&r, o, t_s - 10, NULL, &frames, before_m, ignored);
        state_at(&r, o, t_s + 10, NULL, &frames, after_m, ignored);
        state_at(&r, o, t_s, NULL, &frames, r_m, v_m_s);
        mat_vec(frames.itrs_gcrs, r_m, itrs_m);
        assert_vec_near(itrs_m, 42164.17e3 * cos(75 * DEG), -42164.17e3 * sin(75 * DEG), 0, 1e-6);
        sub3(after_m, before_m, change_m_s);
        scale3(change_m_s, 1.0 / 20, change_m_s);
        assert_vec_near(v_m_s, change_m_s[0], change_m_s[1], change_m_s[2], 4e-4);
    }
    orbit_free(o);
    orbit_free(NULL);
    frame_grid_free(r.grid);
}
END_TEST

static Suite *orbit_suite(void)
{
    Suite *suite = suite_create("orbit");
    TCase *tests = tcase_create("orbit");
    tcase_add_test(tests, test_orbit_element_set_matches_reference);
    tcase_add_test(tests, test_orbit_element_set_is_turned_out_of_teme);
    tcase_add_test(tests, test_orbit_element_set_epoch_counts_tt);
    tcase_add_test(tests, test_orbit_state_does_not_depend_on_the_cursor);
    tcase_add_test(tests, test_orbit_element_set_that_decays_says_when);
    tcase_add_test(tests, test_orbit_element_set_that_sgp4_refuses);
    tcase_add_test(tests, test_orbit_kepler_matches_reference);
    tcase_add_test(tests, test_orbit_kepler_with_j2_matches_reference);
    tcase_add_test(tests, test_orbit_kepler_perigee_inside_the_earth_is_refused);
    tcase_add_test(tests, test_orbit_geostationary_closed_form);
    tcase_add_test(tests, test_orbit_geostationary_velocity_is_the_change_of_position);
    suite_add_tcase(suite, tests);
    return suite;
}

int main(void)
{
    return run_suite(orbit_suite());
}
