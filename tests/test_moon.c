/* The Moon against another implementation's positions. */
#include "base/vec.h"
#include "orbit/moon.h"
#include "table.h"

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

int main(void)
{
    Suite *suite = suite_create("moon");
    TCase *tc = tcase_create("moon");
    tcase_add_test(tc, test_moon_agrees_with_an_ephemeris);
    tcase_add_test(tc, test_moon_goes_round_in_a_sidereal_month);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
