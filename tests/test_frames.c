/* GCRS, ITRS, TEME and the Sun: in full against reference tables and ERFA, and the grid against the
 * evaluation in full. */
#include "orbit/frames.h"

#include "base/constants.h"
#include "base/vec.h"
#include "table.h"

#include <erfa.h>

/* Rounding of the Earth's angle in rad: 0.0027 turns a day make 41 turns by 2041, whose half unit
 * in the last place is 3.6e-15 turns. */
static const double ANGLE_ROUNDING = 3e-14;

/* A step so long that everything is evaluated in full, and a usual one. */
static const double FULL_STEP_S = 86400.0, GRID_STEP_S = 1.0;

static frame_grid *grid_new(const run_clock *clock, double xp_rad, double yp_rad, double t0_s,
                            double t1_s, double step_s)
{
    const earth_orientation orientation = {xp_rad, yp_rad};
    frame_grid *grid = NULL;
    ck_assert(frame_grid_prepare(clock, &orientation, t0_s, t1_s, step_s, &grid, NULL) == GLINT_OK);
    return grid;
}

static run_clock clock_from(const char *start, double span_s, double dut1_s)
{
    utc_time utc;
    run_clock clock;
    ck_assert(utc_parse(start, PLACE_NONE, &utc, NULL) == GLINT_OK);
    run_clock_start(&utc, span_s, dut1_s, &clock);
    return clock;
}

/* Everything at one moment of UTC, in full. */
static frame_set full_set(const char *utc, double dut1_s, double xp_rad, double yp_rad)
{
    const run_clock clock = clock_from(utc, 0.0, dut1_s);
    frame_grid *grid = grid_new(&clock, xp_rad, yp_rad, 0.0, 0.0, FULL_STEP_S);
    frame_set set;
    frame_grid_at(grid, 0.0, FRAMES_TEME | FRAMES_SUN, &set);
    frame_grid_free(grid);
    return set;
}

static void table_matrix(const csv_table *t, long row, double out[9])
{
    for (int i = 0; i < 9; i++) {
        char name[32];
        snprintf(name, sizeof name, "r%d%d", i / 3, i % 3);
        out[i] = table_number(t, row, name);
    }
}

static void assert_matrix(const double got[9], const double want[9], double tol)
{
    for (int i = 0; i < 9; i++)
        assert_near(got[i], want[i], tol);
}

/* The same for a matrix of ERFA's. */
static void assert_erfa_matrix(const double got[9], double want[3][3], double tol)
{
    for (int i = 0; i < 9; i++)
        assert_near(got[i], want[i / 3][i % 3], tol);
}

static void assert_vector(const double got[3], const double want[3], double tol)
{
    for (int i = 0; i < 3; i++)
        assert_near(got[i], want[i], tol);
}

/* ---------------------------------------------------------- against tables */

static void check_itrs(const char *path)
{
    csv_table t = table_open(path);
    for (long k = 0; k < t.n_rows; k++) {
        double want[9];
        table_matrix(&t, k, want);
        const frame_set set = full_set(table_text(&t, k, "utc"), table_number(&t, k, "dut1_s"),
                                       table_number(&t, k, "xp_arcsec") * ARCSEC,
                                       table_number(&t, k, "yp_arcsec") * ARCSEC);
        assert_matrix(set.itrs_gcrs, want, ANGLE_ROUNDING);
    }
    csv_free(&t);
}

START_TEST(test_frames_itrs_matches_reference)
{
    table_check(check_itrs, "orbit/gcrs_to_itrs.csv");
}
END_TEST

static void check_teme(const char *path)
{
    csv_table t = table_open(path);
    for (long k = 0; k < t.n_rows; k++) {
        double want[9], teme_km[3], gcrs_km[3], want_km[3];
        table_matrix(&t, k, want);
        table_vector(&t, k, "teme_", "_km", teme_km);
        table_vector(&t, k, "gcrs_", "_km", want_km);
        const frame_set set = full_set(table_text(&t, k, "utc"), 0.0, 0.0, 0.0);
        assert_matrix(set.gcrs_teme, want, ANGLE_ROUNDING);
        mat_vec(set.gcrs_teme, teme_km, gcrs_km);
        assert_vector(gcrs_km, want_km, 1e-8); /* km: the table's last digit */
    }
    csv_free(&t);
}

START_TEST(test_frames_teme_matches_reference)
{
    table_check(check_teme, "orbit/teme_to_gcrs.csv");
}
END_TEST

static void check_teme_to_itrs(const char *path)
{
    csv_table t = table_open(path);
    for (long k = 0; k < t.n_rows; k++) {
        double teme_km[3], gcrs_km[3], itrs_km[3], want_km[3];
        table_vector(&t, k, "teme_", "_km", teme_km);
        table_vector(&t, k, "itrs_", "_km", want_km);
        const frame_set set = full_set(table_text(&t, k, "utc"), 0.0, 0.0, 0.0);
        mat_vec(set.gcrs_teme, teme_km, gcrs_km);
        mat_vec(set.itrs_gcrs, gcrs_km, itrs_km);
        assert_vector(itrs_km, want_km, 2e-7); /* km: the table's last digit */
    }
    csv_free(&t);
}

START_TEST(test_frames_teme_reaches_reference_itrs)
{
    table_check(check_teme_to_itrs, "orbit/topocentric.csv");
}
END_TEST

static void check_sun(const char *path)
{
    csv_table t = table_open(path);
    for (long k = 0; k < t.n_rows; k++) {
        const frame_set set = full_set(table_text(&t, k, "utc"), 0.0, 0.0, 0.0);
        double gcrs_km[3], itrs_km[3], want_km[3], want_itrs_km[3];
        table_vector(&t, k, "", "_gcrs_km", want_km);
        table_vector(&t, k, "", "_itrs_km", want_itrs_km);
        scale3(set.sun_gcrs_m, 1e-3, gcrs_km);
        mat_vec(set.itrs_gcrs, gcrs_km, itrs_km);
        assert_vector(gcrs_km, want_km, 1e-6);
        assert_vector(itrs_km, want_itrs_km, 1e-5); /* 1.5e8 km times the rounding */
    }
    csv_free(&t);
}

START_TEST(test_frames_sun_matches_reference)
{
    table_check(check_sun, "orbit/sun_gcrs_itrs.csv");
}
END_TEST

/* The table's apparent direction comes from JPL's DE405, from which ERFA's Sun differs by up to
 * 0.012 arcsec; so the way from geometric to apparent is checked on DE405's Sun, too. */
static void check_apparent_sun(const char *path)
{
    csv_table t = table_open(path);
    const double centre[3] = {0.0, 0.0, 0.0};
    for (long k = 0; k < t.n_rows; k++) {
        frame_set set = full_set(table_text(&t, k, "utc"), 0.0, 0.0, 0.0);
        double de405_km[3], want[3], got[3], distance_m;
        table_vector(&t, k, "de405_", "_km", de405_km);
        table_vector(&t, k, "app_", "", want);
        sun_from_point(&set, centre, true, got, &distance_m);
        assert_near(angle3(got, want), 0.0, 0.015 * ARCSEC);
        scale3(de405_km, 1e3, set.sun_gcrs_m);
        sun_from_point(&set, centre, true, got, &distance_m);
        assert_near(angle3(got, want), 0.0, 5e-6 * ARCSEC);
        assert_rel(distance_m, 1e3 * norm3(de405_km), 1e-15);
    }
    csv_free(&t);
}

START_TEST(test_frames_apparent_sun_matches_reference)
{
    table_check(check_apparent_sun, "orbit/sun_gcrs_itrs.csv");
}
END_TEST

/* ------------------------------------------------------------ against ERFA */

/* ITRS from TEME with polar motion, from ERFA's own rotations, over decades. */
START_TEST(test_frames_teme_takes_polar_motion_without_s_prime)
{
    const double span_s = 50.0 * 365.25 * DAY_S, xp = 0.2 * ARCSEC, yp = 0.4 * ARCSEC;
    const run_clock clock = clock_from("1990-05-06T07:08:09Z", span_s, -0.2);
    frame_grid *grid = grid_new(&clock, xp, yp, 0.0, span_s, FULL_STEP_S);
    for (int k = 0; k < 100; k++) {
        const double t_s = span_s * k / 100.0;
        double ut1_jd[2], pef_teme[3][3], polar[3][3], want[3][3], got[9];
        frame_set set;
        frame_grid_at(grid, t_s, FRAMES_TEME, &set);
        run_clock_ut1(&clock, t_s, ut1_jd);
        eraIr(pef_teme);
        eraRz(eraGmst82(ut1_jd[0], ut1_jd[1]), pef_teme);
        eraPom00(xp, yp, 0.0, polar);
        eraRxr(polar, pef_teme, want);
        mat_mul(set.itrs_gcrs, set.gcrs_teme, got);
        /* ERFA sums seconds of time: 3.5e6 of them round to 2.3e-10 s = 1.7e-14 rad, twice */
        assert_erfa_matrix(got, want, 2.0 * ANGLE_ROUNDING);
    }
    frame_grid_free(grid);
}
END_TEST

/* All of GCRS to ITRS in one call of ERFA. */
START_TEST(test_frames_itrs_agrees_with_erfa)
{
    const double span_s = 30.0 * 365.25 * DAY_S, xp = -0.1 * ARCSEC, yp = 0.3 * ARCSEC;
    const run_clock clock = clock_from("2000-01-01", span_s, 0.3);
    frame_grid *grid = grid_new(&clock, xp, yp, 0.0, span_s, FULL_STEP_S);
    for (int k = 0; k < 100; k++) {
        const double t_s = span_s * k / 100.0;
        double tt[2], ut1[2], want[3][3];
        frame_set set;
        run_clock_tt(&clock, t_s, tt);
        run_clock_ut1(&clock, t_s, ut1);
        eraC2t06a(tt[0], tt[1], ut1[0], ut1[1], xp, yp, want);
        frame_grid_at(grid, t_s, 0, &set);
        assert_erfa_matrix(set.itrs_gcrs, want, ANGLE_ROUNDING);
    }
    frame_grid_free(grid);
}
END_TEST

START_TEST(test_frames_velocities_agree_with_erfa)
{
    const run_clock clock = clock_from("2024-05-06T07:08:09Z", 0.0, 0.0);
    frame_grid *grid = grid_new(&clock, 0.0, 0.0, 0.0, 0.0, FULL_STEP_S);
    frame_set set;
    frame_grid_at(grid, 0.0, FRAMES_SUN, &set);
    double tt[2], heliocentric[2][3], barycentric[2][3];
    run_clock_tt(&clock, 0.0, tt);
    eraEpv00(tt[0], tt[1], heliocentric, barycentric);
    for (int i = 0; i < 3; i++) {
        const double m_s_per_au_d = AU_M / DAY_S;
        assert_near(set.earth_velocity_m_s[i], barycentric[1][i] * m_s_per_au_d, 1e-10);
        assert_near(set.sun_velocity_m_s[i],
                    (barycentric[1][i] - heliocentric[1][i]) * m_s_per_au_d, 1e-10);
    }
    frame_grid_free(grid);
}
END_TEST

/* Sun seen from a geostationary satellite: parallax, then light time, then ERFA's aberration. */
START_TEST(test_frames_sun_from_satellite_agrees_with_erfa)
{
    const run_clock clock = clock_from("2024-05-06T07:08:09Z", 365.0 * DAY_S, 0.0);
    frame_grid *grid = grid_new(&clock, 0.0, 0.0, 0.0, 365.0 * DAY_S, FULL_STEP_S);
    for (int k = 0; k < 50; k++) {
        frame_set set;
        frame_grid_at(grid, 7.3 * DAY_S * k, FRAMES_SUN, &set);
        const double r[3] = {-3e7, 2.5e7 * cos(k), 2.5e7 * sin(k)};
        double to_sun[3], natural[3], want[3], got[3], distance_m, velocity[3];
        sub3(set.sun_gcrs_m, r, to_sun);
        const double length_m = norm3(to_sun);
        sun_from_point(&set, r, false, got, &distance_m);
        assert_near(angle3(got, to_sun), 0.0, 1e-15);
        assert_rel(distance_m, length_m, 1e-15);
        add_scaled3(to_sun, -length_m / LIGHT_SPEED_M_S, set.sun_velocity_m_s, to_sun);
        unit3(to_sun, natural);
        scale3(set.earth_velocity_m_s, 1.0 / LIGHT_SPEED_M_S, velocity);
        eraAb(natural, velocity, length_m / AU_M, sqrt(1.0 - dot3(velocity, velocity)), want);
        sun_from_point(&set, r, true, got, &distance_m);
        assert_near(norm3(got), 1.0, 4e-16);
        assert_rel(distance_m, length_m, 1e-15);
        /* ERFA adds the Sun's gravity: 2e-8 au/d of v/c = 1e-4, 2e-12 rad */
        assert_near(angle3(got, want), 0.0, 4e-12);
    }
    frame_grid_free(grid);
}
END_TEST

/* -------------------------------------------------------------- properties */

START_TEST(test_frames_matrices_are_rotations)
{
    const run_clock clock = clock_from("2025-01-01", 1e7, 0.1);
    frame_grid *grid = grid_new(&clock, 1e-6, 2e-6, 0.0, 1e7, GRID_STEP_S);
    for (int k = 0; k < 500; k++) {
        frame_set set;
        frame_grid_at(grid, 1e7 * k / 500.0, FRAMES_TEME, &set);
        const double *const matrices[] = {set.itrs_gcrs, set.gcrs_teme};
        for (int m = 0; m < 2; m++) {
            double transposed[9], product[9], identity[9], z[3];
            mat_transpose(matrices[m], transposed);
            mat_mul(matrices[m], transposed, product);
            mat_identity(identity);
            assert_matrix(product, identity, 1e-15);
            cross3(matrices[m], matrices[m] + 3, z); /* right-handed */
            assert_vector(z, matrices[m] + 6, 1e-15);
        }
    }
    frame_grid_free(grid);
}
END_TEST

/* The Earth turns eastwards by 1.00273781191135448 turns a day of UT1 (IAU 2000 resolution B1.8):
 * the ITRS longitude of a star falls. Precession moves the pole by 2e-11 rad in the ten minutes. */
START_TEST(test_frames_earth_turns_eastwards)
{
    const run_clock clock = clock_from("2025-03-04T05:06:07Z", 600.0, 0.0);
    frame_grid *grid = grid_new(&clock, 0.0, 0.0, 0.0, 600.0, FULL_STEP_S);
    frame_set set;
    double longitude[2];
    for (int k = 0; k < 2; k++) {
        const double star[3] = {1.0, 0.0, 0.0};
        double itrs[3];
        frame_grid_at(grid, 600.0 * k, 0, &set);
        mat_vec(set.itrs_gcrs, star, itrs);
        longitude[k] = atan2(itrs[1], itrs[0]);
    }
    const double turned = fmod(longitude[0] - longitude[1] + TWO_PI, TWO_PI);
    assert_near(turned, 1.00273781191135448 * TWO_PI * 600.0 / DAY_S, 1e-10);
    frame_grid_free(grid);
}
END_TEST

/* -------------------------------------------------------------------- grid */

START_TEST(test_frames_grid_agrees_with_full)
{
    const double span_s = 50.0 * 365.25 * DAY_S;
    const run_clock clock = clock_from("2000-01-01", span_s, 0.0);
    frame_grid *full = grid_new(&clock, 1e-6, 2e-6, 0.0, 0.0, FULL_STEP_S);
    frame_grid *grid = NULL;
    const earth_orientation orientation = {1e-6, 2e-6};
    for (int k = 0; k < 1500; k++) {
        /* steps that meet all phases of the grid */
        const double t_s = span_s * fmod(0.618033988749895 * k, 1.0);
        ck_assert(frame_grid_prepare(&clock, &orientation, t_s, t_s, GRID_STEP_S, &grid, NULL) ==
                  GLINT_OK);
        frame_set a, b;
        frame_grid_at(full, t_s, FRAMES_TEME | FRAMES_SUN, &a);
        frame_grid_at(grid, t_s, FRAMES_TEME | FRAMES_SUN, &b);
        assert_matrix(b.itrs_gcrs, a.itrs_gcrs, 1e-11); /* 2e-6 arcsec */
        assert_matrix(b.gcrs_teme, a.gcrs_teme, 1e-11);
        assert_vector(b.sun_gcrs_m, a.sun_gcrs_m, 10.0);
        assert_vector(b.sun_velocity_m_s, a.sun_velocity_m_s, 1e-3);
        assert_vector(b.earth_velocity_m_s, a.earth_velocity_m_s, 1e-3);
    }
    frame_grid_free(full);
    frame_grid_free(grid);
}
END_TEST

/* Blocks of a run, a whole run and moments outside what was prepared give the same bits. */
START_TEST(test_frames_grid_does_not_depend_on_blocks)
{
    const double span_s = 5.0 * DAY_S;
    const run_clock clock = clock_from("2025-06-07T08:09:10Z", span_s, 0.1);
    const earth_orientation orientation = {1e-6, -2e-6};
    frame_grid *whole = grid_new(&clock, 1e-6, -2e-6, 0.0, span_s, GRID_STEP_S);
    frame_grid *nothing = grid_new(&clock, 1e-6, -2e-6, -9e7, -9e7, GRID_STEP_S);
    frame_grid *blocks = NULL;
    const double block_s = 5000.0;
    /* there and back, so that stretches are both extended and left behind */
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k * block_s < span_s; k++) {
            const double t0_s = pass ? span_s - (k + 1) * block_s : k * block_s;
            ck_assert(frame_grid_prepare(&clock, &orientation, t0_s, t0_s + block_s, GRID_STEP_S,
                                         &blocks, NULL) == GLINT_OK);
            for (int i = 0; i <= 10; i++) {
                const double t_s = t0_s + i * block_s / 10.0;
                frame_set a, b, c;
                frame_grid_at(whole, t_s, FRAMES_TEME | FRAMES_SUN, &a);
                frame_grid_at(blocks, t_s, FRAMES_TEME | FRAMES_SUN, &b);
                ck_assert(memcmp(&a, &b, sizeof a) == 0);
                if (i % 5) continue;
                frame_grid_at(nothing, t_s, FRAMES_TEME | FRAMES_SUN, &c);
                ck_assert(memcmp(&a, &c, sizeof a) == 0);
            }
        }
    frame_grid_free(whole);
    frame_grid_free(nothing);
    frame_grid_free(blocks);
}
END_TEST

START_TEST(test_frames_grid_is_chosen_by_step_alone)
{
    const run_clock clock = clock_from("2025-06-07T08:09:10Z", 1e6, 0.0);
    frame_grid *fine = grid_new(&clock, 0.0, 0.0, 0.0, 1e6, 21600.0);
    frame_grid *coarse = grid_new(&clock, 0.0, 0.0, 0.0, 1e6, 21600.1);
    frame_grid *moment = grid_new(&clock, 0.0, 0.0, 5e5, 5e5, 21600.0);
    frame_set a, b, c;
    frame_grid_at(fine, 5e5, FRAMES_SUN, &a);
    frame_grid_at(coarse, 5e5, FRAMES_SUN, &b);
    frame_grid_at(moment, 5e5, FRAMES_SUN, &c);
    ck_assert(memcmp(a.sun_gcrs_m, b.sun_gcrs_m, sizeof a.sun_gcrs_m) != 0);
    ck_assert(memcmp(a.sun_gcrs_m, c.sun_gcrs_m, sizeof a.sun_gcrs_m) == 0);
    frame_grid_free(fine);
    frame_grid_free(coarse);
    frame_grid_free(moment);
    frame_grid_free(NULL);
}
END_TEST

/* One grid used for another run must not keep what belonged to the first. */
/* A tile gives the bits that its moments give alone: within some minutes, across the nodes of the
 * grid, outside what it holds, and where it is not used at all; with polar motion and without. */
START_TEST(test_frames_of_a_tile_are_those_of_its_moments)
{
    static const struct {
        double from_s, step_s;
        int n;
    } CASES[] = {{1000, 1, 32}, {1000, 0.01, 7},   {20000, 100, 32}, {43000, 60, 31},
                 {0, 3600, 32}, {86000, 3000, 32}, {-9e5, 1, 3},     {50, 40000, 32}};
    const utc_time start = {2025, 7, 25, 3, 4, 5.6};
    run_clock clock;
    run_clock_start(&start, 2e6, 0.1, &clock);
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++)
        for (int moves = 0; moves < 2; moves++) {
            const earth_orientation orientation = {moves * 1e-6, moves * 2e-6};
            frame_grid *grid = NULL;
            ck_assert_int_eq(
                frame_grid_prepare(&clock, &orientation, 0, 1e5, CASES[c].step_s, &grid, NULL),
                GLINT_OK);
            double t_s[FRAME_LANES];
            frame_set tile[FRAME_LANES], alone;
            memset(tile, 0, sizeof tile);
            for (int k = 0; k < CASES[c].n; k++)
                t_s[k] = CASES[c].from_s + k * CASES[c].step_s;
            frame_grid_fill(grid, t_s, CASES[c].n, FRAMES_TEME | FRAMES_SUN, tile);
            for (int k = 0; k < CASES[c].n; k++) {
                memset(&alone, 0, sizeof alone);
                frame_grid_at(grid, t_s[k], FRAMES_TEME | FRAMES_SUN, &alone);
                ck_assert_msg(memcmp(&alone, &tile[k], sizeof alone) == 0, "case %zu, moment %d", c,
                              k);
            }
            frame_grid_free(grid);
        }
}
END_TEST

START_TEST(test_frames_grid_is_reusable_for_another_run)
{
    const run_clock first = clock_from("2025-06-07T08:09:10Z", 1e5, 0.0);
    const run_clock second = clock_from("2025-06-07T18:00:00Z", 1e5, 0.2);
    const earth_orientation none = {0.0, 0.0}, some = {1e-6, 2e-6};
    frame_grid *used = NULL;
    ck_assert(frame_grid_prepare(&first, &none, 0.0, 1e5, 1.0, &used, NULL) == GLINT_OK);
    ck_assert(frame_grid_prepare(&second, &some, 0.0, 1e5, 1.0, &used, NULL) == GLINT_OK);
    frame_grid *fresh = grid_new(&second, 1e-6, 2e-6, 0.0, 1e5, 1.0);
    frame_set a, b;
    frame_grid_at(used, 4321.0, FRAMES_TEME | FRAMES_SUN, &a);
    frame_grid_at(fresh, 4321.0, FRAMES_TEME | FRAMES_SUN, &b);
    ck_assert(memcmp(&a, &b, sizeof a) == 0);
    frame_grid_free(used);
    frame_grid_free(fresh);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("frames");
    TCase *tcase = tcase_create("frames");
    tcase_set_timeout(tcase, 60);
    suite_add_tcase(suite, tcase);
    tcase_add_test(tcase, test_frames_itrs_matches_reference);
    tcase_add_test(tcase, test_frames_teme_matches_reference);
    tcase_add_test(tcase, test_frames_teme_reaches_reference_itrs);
    tcase_add_test(tcase, test_frames_sun_matches_reference);
    tcase_add_test(tcase, test_frames_apparent_sun_matches_reference);
    tcase_add_test(tcase, test_frames_teme_takes_polar_motion_without_s_prime);
    tcase_add_test(tcase, test_frames_itrs_agrees_with_erfa);
    tcase_add_test(tcase, test_frames_velocities_agree_with_erfa);
    tcase_add_test(tcase, test_frames_sun_from_satellite_agrees_with_erfa);
    tcase_add_test(tcase, test_frames_matrices_are_rotations);
    tcase_add_test(tcase, test_frames_earth_turns_eastwards);
    tcase_add_test(tcase, test_frames_grid_agrees_with_full);
    tcase_add_test(tcase, test_frames_grid_does_not_depend_on_blocks);
    tcase_add_test(tcase, test_frames_grid_is_chosen_by_step_alone);
    tcase_add_test(tcase, test_frames_grid_is_reusable_for_another_run);
    tcase_add_test(tcase, test_frames_of_a_tile_are_those_of_its_moments);
    return run_suite(suite);
}
