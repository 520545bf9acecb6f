/* The Moon against another implementation's positions. */
#include "base/constants.h"
#include "base/vec.h"
#include "orbit/moon.h"
#include "table.h"

#include <erfa.h>
#include <erfam.h>

/* eraMoon98 keeps to about 14 arcsec and 9 km of a full ephemeris: 25 km in all, as the reference
 * table's README says; its DE405 columns are that full ephemeris. */
static void check_moon(const char *path)
{
    csv_table table = table_open(path);
    for (long row = 0; row < table.n_rows; row++) {
        utc_time start;
        run_clock clock;
        double got[3], want_km[3], off[3];
        ck_assert_int_eq(utc_parse(table_text(&table, row, "utc"), PLACE_NONE, &start, NULL),
                         GLINT_OK);
        run_clock_start(&start, 0, 0, &clock);
        moon_position(&clock, 0, NULL, got);
        table_vector(&table, row, "de405_moon_", "_km", want_km);
        for (int i = 0; i < 3; i++)
            off[i] = got[i] * 1e-3 - want_km[i];
        assert_near(norm3(off), 0, 25);
    }
    csv_free(&table);
}

START_TEST(test_moon_agrees_with_an_ephemeris)
{
    table_check(check_moon, "orbit/sun_gcrs_itrs.csv");
}
END_TEST

/* A month later, counted on the clock, it is nearly where it was; half a month later opposite. */
START_TEST(test_moon_goes_round_in_a_sidereal_month)
{
    static const double MONTH_S = 27.321661 * 86400; /* sidereal month, s */
    utc_time start = {2025, 7, 1, 0, 0, 0};
    run_clock clock;
    double now[3], half[3], later[3];
    run_clock_start(&start, MONTH_S, 0, &clock);
    moon_position(&clock, 0, NULL, now);
    moon_position(&clock, 0.5 * MONTH_S, NULL, half);
    moon_position(&clock, MONTH_S, NULL, later);
    ck_assert(angle3(now, later) < 0.15); /* rad: the ellipse turns and breathes */
    ck_assert(angle3(now, half) > 2.8);
    ck_assert(norm3(now) > 3.5e8 && norm3(now) < 4.1e8); /* m */
}
END_TEST

/* The cubic between nodes against the series at every moment: 0.4 km, 60 times better than the
 * series itself. What a cursor held before does not matter. */
START_TEST(test_moon_between_nodes_stays_near_the_series)
{
    utc_time start = {2025, 1, 1, 0, 0, 0};
    run_clock clock;
    moon_cursor cursor = {0};
    double worst_m = 0;
    run_clock_start(&start, 400 * DAY_S, 0, &clock);
    for (int k = 0; k < 4000; k++) {
        /* forth, back and in leaps */
        const double t_s = fmod(7919.0 * 3600 * k, 400 * DAY_S);
        double tt_jd[2], pv[2][3], got[3], alone[3], want[3], off[3];
        run_clock_tt(&clock, t_s, tt_jd);
        eraMoon98(tt_jd[0], tt_jd[1], pv);
        scale3(pv[0], AU_M, want);
        moon_position(&clock, t_s, &cursor, got);
        moon_position(&clock, t_s, NULL, alone);
        for (int i = 0; i < 3; i++)
            ck_assert_double_eq(got[i], alone[i]);
        sub3(got, want, off);
        worst_m = fmax(worst_m, norm3(off));
    }
    assert_near(worst_m, 0, 400);
}
END_TEST

/* Phases of 2025 and 2026 as almanacs print them (UTC, to the minute). Quarters are where the
 * Moon's longitude is 90 deg from the Sun's, which leaves 0.15 deg of phase (the Sun is not
 * infinitely far) and its latitude, up to 5.2 deg, which does not enter at 90 deg. */
START_TEST(test_moon_phases_are_those_of_the_almanac)
{
    static const struct {
        utc_time when;
        double illuminated, tolerance;
    } PHASES[] = {
        {{2025, 3, 14, 6, 55, 0}, 1, 0.0005},  /* full, in eclipse */
        {{2025, 3, 29, 10, 58, 0}, 0, 0.0005}, /* new, in eclipse */
        {{2025, 9, 7, 18, 9, 0}, 1, 0.0005},   /* full, in eclipse */
        {{2025, 1, 6, 23, 56, 0}, 0.5, 0.003}, /* first quarter */
        {{2025, 1, 21, 20, 31, 0}, 0.5, 0.003},
        {{2026, 8, 12, 17, 37, 0}, 0, 0.0005}, /* new, in eclipse */
    };
    for (size_t k = 0; k < sizeof PHASES / sizeof *PHASES; k++) {
        run_clock clock;
        double moon[3], tt_jd[2], from_sun[2][3], from_barycentre[2][3], sun[3];
        run_clock_start(&PHASES[k].when, 0, 0, &clock);
        run_clock_tt(&clock, 0, tt_jd);
        eraEpv00(tt_jd[0], tt_jd[1], from_sun, from_barycentre);
        scale3(from_sun[0], -AU_M, sun);
        moon_position(&clock, 0, NULL, moon);
        assert_near(moon_illuminated(moon, sun), PHASES[k].illuminated, PHASES[k].tolerance);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("moon");
    TCase *tc = tcase_create("moon");
    tcase_add_test(tc, test_moon_agrees_with_an_ephemeris);
    tcase_add_test(tc, test_moon_goes_round_in_a_sidereal_month);
    tcase_add_test(tc, test_moon_between_nodes_stays_near_the_series);
    tcase_add_test(tc, test_moon_phases_are_those_of_the_almanac);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
