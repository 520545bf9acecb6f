/* UTC, leap seconds and the time line of a run. */
#include "orbit/clock.h"

#include "base/constants.h"
#include "table.h"

#include <erfa.h>

static utc_time parsed(const char *string)
{
    utc_time utc;
    glint_error error;
    const glint_status status = utc_parse(string, PLACE_NONE, &utc, &error);
    ck_assert_msg(status == GLINT_OK, "'%s': %s", string, status ? error.message : "");
    return utc;
}

static void assert_utc(const utc_time *utc, int year, int month, int day, int hour, int minute,
                       double second)
{
    ck_assert_int_eq(utc->year, year);
    ck_assert_int_eq(utc->month, month);
    ck_assert_int_eq(utc->day, day);
    ck_assert_int_eq(utc->hour, hour);
    ck_assert_int_eq(utc->minute, minute);
    assert_near(utc->second, second, 0.0);
}

/* UTC of a run at t_s as it is written. */
static const char *text_at(const run_clock *clock, double t_s)
{
    static char out[UTC_TEXT_SIZE];
    glint_utc utc;
    run_clock_utc(clock, t_s, &utc);
    utc_write(&utc, out);
    return out;
}

static run_clock clock_from(const char *start, double span_s)
{
    const utc_time utc = parsed(start);
    run_clock clock;
    run_clock_start(&utc, span_s, 0.0, &clock);
    return clock;
}

/* ------------------------------------------------------------------ reading */

START_TEST(test_clock_parse_accepts_forms)
{
    static const struct {
        const char *string;
        int year, month, day, hour, minute;
        double second;
    } cases[] = {
        {"2025-07-24T19:10:00Z", 2025, 7, 24, 19, 10, 0.0},
        {"2025-07-24t19:10:00z", 2025, 7, 24, 19, 10, 0.0},
        {"2025-07-24 19:10:59.25", 2025, 7, 24, 19, 10, 59.25},
        {"2025-07-24T19:10", 2025, 7, 24, 19, 10, 0.0},
        {"2025-07-24T19:10Z", 2025, 7, 24, 19, 10, 0.0},
        {"2025-07-24", 2025, 7, 24, 0, 0, 0.0},
        {"2024-02-29T00:00:00.123456789Z", 2024, 2, 29, 0, 0, 0.123456789},
        {"2000-02-29T23:59:59.999999", 2000, 2, 29, 23, 59, 59.999999},
        {"1972-01-01", 1972, 1, 1, 0, 0, 0.0},
        {"2100-12-31T23:59:59Z", 2100, 12, 31, 23, 59, 59.0},
        {"2016-12-31T23:59:60Z", 2016, 12, 31, 23, 59, 60.0},
        {"2016-12-31T23:59:60.999999Z", 2016, 12, 31, 23, 59, 60.999999},
        {"2025-205T19:10:00Z", 2025, 7, 24, 19, 10, 0.0},
        {"2024-060", 2024, 2, 29, 0, 0, 0.0},
        {"2023-060", 2023, 3, 1, 0, 0, 0.0},
        {"2024-366T01:02:03.5", 2024, 12, 31, 1, 2, 3.5},
        {"2016-366T23:59:60Z", 2016, 12, 31, 23, 59, 60.0},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const utc_time utc = parsed(cases[k].string);
        assert_utc(&utc, cases[k].year, cases[k].month, cases[k].day, cases[k].hour,
                   cases[k].minute, cases[k].second);
    }
}
END_TEST

START_TEST(test_clock_parse_takes_offsets_off)
{
    utc_time utc = parsed("2025-07-24T21:10:00+02:00");
    assert_utc(&utc, 2025, 7, 24, 19, 10, 0.0);
    utc = parsed("2025-01-01T00:30:00.5+01:00");
    assert_utc(&utc, 2024, 12, 31, 23, 30, 0.5);
    utc = parsed("2024-02-28T23:30-01:00");
    assert_utc(&utc, 2024, 2, 29, 0, 30, 0.0);
    utc = parsed("2025-03-01T00:00:00+05:45");
    assert_utc(&utc, 2025, 2, 28, 18, 15, 0.0);
    utc = parsed("2025-07-24T19:10:00-00:00");
    assert_utc(&utc, 2025, 7, 24, 19, 10, 0.0);
    /* a leap second happens everywhere at once */
    utc = parsed("2017-01-01T05:29:60.5+05:30");
    assert_utc(&utc, 2016, 12, 31, 23, 59, 60.5);
    /* only the UTC year is limited */
    utc = parsed("2101-01-01T00:30+01:00");
    assert_utc(&utc, 2100, 12, 31, 23, 30, 0.0);
}
END_TEST

START_TEST(test_clock_parse_refuses_other_forms)
{
    static const char *const wrong[] = {
        "",
        "now",
        "2025",
        "2025-07",
        "2025-7-24",
        "25-07-24",
        "2025-07-24T",
        "2025-07-24T19",
        "2025-07-24T19:1",
        "2025-07-24T19:10:",
        "2025-07-24T19:10:0",
        "2025-07-24T19:10:00.",
        "2025-07-24T19:10:00.5e0",
        "2025-07-24T19:10:00 Z",
        "2025-07-24T19:10:00ZZ",
        "2025-07-24Z",
        "2025-07-24  19:10",
        "2025-07-24T19:10:00+2:00",
        "2025-07-24T19:10:00+0200",
        "2025-07-24T19:10:00+24:00",
        "2025-07-24T19:10:00+01:60",
        "2025-07-24T19:10:-1",
        "+2025-07-24",
        " 2025-07-24",
        "2025/07/24",
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        utc_time utc = {.year = -1};
        glint_error error = {0};
        const place where = {"s.toml", 3, 9};
        ck_assert_msg(utc_parse(wrong[k], where, &utc, &error) == GLINT_INPUT, "'%s'", wrong[k]);
        ck_assert_msg(strstr(error.message, "expected a form like") != NULL, "%s", error.message);
        ck_assert_str_eq(error.file, "s.toml");
        ck_assert_int_eq(error.line, 3);
        ck_assert_int_eq(error.column, 9);
        ck_assert_int_eq(utc.year, -1);
    }
}
END_TEST

START_TEST(test_clock_parse_names_what_does_not_exist)
{
    static const struct {
        const char *string, *message;
    } cases[] = {
        {"2025-13-01", "month 13"},
        {"2025-00-01", "month 00"},
        {"2025-02-29", "has 28 days"},
        {"2100-02-29", "has 28 days"},
        {"2025-04-31T00:00", "has 30 days"},
        {"2025-12-00", "day 2025-12-00"},
        {"2025-01-01T24:00:00", "24:00"},
        {"2025-01-01T10:60:00", "10:60"},
        {"2025-01-01T10:10:61", "10:10:61"},
        {"1971-12-31T23:59:59Z", "expected 1972 to 2100"},
        {"2101-01-01", "expected 1972 to 2100"},
        {"0000-01-01", "expected 1972 to 2100"},
        {"1972-01-01T00:30+01:00", "expected 1972 to 2100"},
        {"2016-12-31T23:58:60Z", "only at 23:59 UTC"},
        {"2016-12-31T23:59:60+01:00", "only at 23:59 UTC"},
        {"2025-07-24T23:59:60Z", "no leap second ends that day"},
        {"2015-12-31T23:59:60Z", "no leap second ends that day"},
        {"2025-000", "has 365 days"},
        {"2025-366", "has 365 days"},
        {"2024-367T00:00:00", "has 366 days"},
        {"1971-365", "expected 1972 to 2100"},
        {"9999-001", "expected 1972 to 2100"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        utc_time utc;
        glint_error error = {0};
        ck_assert_msg(utc_parse(cases[k].string, PLACE_NONE, &utc, &error) == GLINT_INPUT, "'%s'",
                      cases[k].string);
        ck_assert_msg(strstr(error.message, cases[k].message) != NULL, "'%s' says: %s",
                      cases[k].string, error.message);
        ck_assert(utc_parse(cases[k].string, PLACE_NONE, &utc, NULL) == GLINT_INPUT);
    }
}
END_TEST

START_TEST(test_clock_parse_worded_reads_named_months)
{
    static const char *const months[] = {"Jan", "feb", "MAR", "Apr", "May", "Jun",
                                         "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    static const char *const wrong[] = {"",
                                        "24 Jul 2025",
                                        "24 July 2025 00:00:00",
                                        "24 Foo 2025 00:00:00",
                                        "32 Jul 2025 00:00:00",
                                        "24 Jul 2025 25:00:00",
                                        "24 Jul 2025 00:00:00 UTCG",
                                        "24 ulA 2025 00:00:00",
                                        "2025-07-24T00:00:00"};
    utc_time utc;
    for (int k = 0; k < 12; k++) {
        char string[64];
        snprintf(string, sizeof string, "%d %s 2024 19:10:00.25", k + 1, months[k]);
        ck_assert_int_eq(utc_parse_worded(string, PLACE_NONE, &utc, NULL), GLINT_OK);
        assert_utc(&utc, 2024, k + 1, k + 1, 19, 10, 0.25);
    }
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++)
        ck_assert_msg(utc_parse_worded(wrong[k], PLACE_NONE, &utc, NULL) == GLINT_INPUT, "'%s'",
                      wrong[k]);
}
END_TEST

START_TEST(test_clock_check_refuses_fields_out_of_range)
{
    const utc_time good = {2025, 7, 24, 19, 10, 0.0};
    ck_assert(utc_check(&good, PLACE_NONE, NULL) == GLINT_OK);
    utc_time bad[6] = {good, good, good, good, good, good};
    bad[0].hour = -1;
    bad[1].minute = 60;
    bad[2].second = -1e-9;
    bad[3].second = (double)NAN;
    bad[4].day = 32;
    bad[5].month = -3;
    for (int k = 0; k < 6; k++)
        ck_assert_msg(utc_check(&bad[k], PLACE_NONE, NULL) == GLINT_INPUT, "case %d", k);
}
END_TEST

START_TEST(test_clock_parse_keeps_long_decimals_in_their_second)
{
    utc_time utc = parsed("2025-07-24T19:10:59.99999999999999999999999999");
    ck_assert(utc.second < 60.0);
    assert_near(utc.second, 60.0, 1e-14);
    utc = parsed("2016-12-31T23:59:60.99999999999999999999999999");
    ck_assert(utc.second < 61.0);
}
END_TEST

/* -------------------------------------------------------------- other scales */

static double seconds_from(const char *string, time_scale scale, const double from_jd[2])
{
    double tt_jd[2];
    glint_error error = {0};
    ck_assert_msg(time_parse(string, scale, PLACE_NONE, tt_jd, &error) == GLINT_OK, "'%s': %s",
                  string, error.message);
    return jd_difference_s(tt_jd, from_jd);
}

/* One moment in every scale: TAI-UTC is 37 s in 2025, TT-TAI 32.184 s, TAI-GPS 19 s. */
START_TEST(test_clock_time_parse_reads_one_moment_in_all_scales)
{
    const double rounding_s = 2e-11; /* of a day's fraction */
    double utc_jd[2];
    const utc_time utc = parsed("2025-07-24T19:10:00Z");
    utc_to_tt(&utc, utc_jd, NULL, NULL);
    assert_near(seconds_from("2025-205T19:10:00", SCALE_UTC, utc_jd), 0.0, 0.0);
    assert_near(seconds_from("2025-07-24T19:10:37", SCALE_TAI, utc_jd), 0.0, rounding_s);
    assert_near(seconds_from("2025-07-24T19:11:09.184", SCALE_TT, utc_jd), 0.0, rounding_s);
    assert_near(seconds_from("2025-07-24T19:10:18Z", SCALE_GPS, utc_jd), 0.0, rounding_s);
    /* TDB-TT = 0.001657 s sin g with g = 357.53 deg + 0.9856003 deg a day from J2000.0: the
     * Astronomical Almanac's approximation, good to 3e-5 s; 9336.3 d give g = 199.3 deg */
    const double g = (357.53 + 0.9856003 * 9336.3) * DEG;
    assert_near(seconds_from("2025-07-24T19:11:09.184", SCALE_TDB, utc_jd), -0.001657 * sin(g),
                5e-5);
}
END_TEST

START_TEST(test_clock_time_parse_refuses_what_a_scale_has_not)
{
    static const char *const wrong[] = {"2016-12-31T23:59:60", "2025-07-24T19:10:00+01:00",
                                        "1971-12-31",          "2101-001",
                                        "2025-02-29",          "now"};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        double tt_jd[2];
        glint_error error = {0};
        ck_assert_msg(time_parse(wrong[k], SCALE_TAI, (place){"x.oem", 3, 4}, tt_jd, &error) ==
                          GLINT_INPUT,
                      "'%s'", wrong[k]);
        ck_assert_int_eq(error.column, 4);
    }
}
END_TEST

START_TEST(test_clock_time_scale_find_knows_names)
{
    time_scale scale;
    glint_error error = {0};
    static const char *const NAMES[] = {"UTC", "TAI", "TT", "TDB", "GPS"};
    static const time_scale SCALES[] = {SCALE_UTC, SCALE_TAI, SCALE_TT, SCALE_TDB, SCALE_GPS};
    for (int k = 0; k < 5; k++) {
        ck_assert_int_eq(time_scale_find(NAMES[k], PLACE_NONE, &scale, NULL), GLINT_OK);
        ck_assert_int_eq(scale, SCALES[k]);
    }
    ck_assert_int_eq(time_scale_find("tdt", PLACE_NONE, &scale, NULL), GLINT_OK);
    ck_assert_int_eq(scale, SCALE_TT);
    ck_assert_int_eq(time_scale_find("UT1", PLACE_NONE, &scale, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "turns of the Earth"));
    ck_assert_int_eq(time_scale_find("SCLK", PLACE_NONE, &scale, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "'SCLK'"));
}
END_TEST

START_TEST(test_clock_tt_write_utc_names_leap_second)
{
    char out[UTC_TEXT_SIZE + 1] = "";
    double tt_jd[2];
    const utc_time utc = parsed("2016-12-31T23:59:60.25Z");
    utc_to_tt(&utc, tt_jd, NULL, NULL);
    tt_write_utc(tt_jd, out);
    ck_assert_str_eq(out, "2016-12-31T23:59:60.250000Z");
}
END_TEST

/* ------------------------------------------------------------- leap seconds */

/* Year and month that each leap second ended (IERS Bulletin C; all inserted, none removed). */
static const int leap_days[][2] = {
    {1972, 6},  {1972, 12}, {1973, 12}, {1974, 12}, {1975, 12}, {1976, 12}, {1977, 12},
    {1978, 12}, {1979, 12}, {1981, 6},  {1982, 6},  {1983, 6},  {1985, 6},  {1987, 12},
    {1989, 12}, {1990, 12}, {1992, 6},  {1993, 6},  {1994, 6},  {1995, 12}, {1997, 6},
    {1998, 12}, {2005, 12}, {2008, 12}, {2012, 6},  {2015, 6},  {2016, 12},
};
enum { N_LEAPS = sizeof leap_days / sizeof *leap_days };

START_TEST(test_clock_check_knows_every_leap_second)
{
    int found = 0;
    for (int year = 1972; year <= 2025; year++)
        for (int month = 6; month <= 12; month += 6) {
            const utc_time utc = {year, month, month == 6 ? 30 : 31, 23, 59, 60.5};
            const bool there =
                found < N_LEAPS && leap_days[found][0] == year && leap_days[found][1] == month;
            ck_assert_msg((utc_check(&utc, PLACE_NONE, NULL) == GLINT_OK) == there, "%d-%d", year,
                          month);
            found += there;
        }
    ck_assert_int_eq(found, N_LEAPS);
}
END_TEST

START_TEST(test_clock_run_counts_every_leap_second)
{
    const run_clock clock = clock_from("1972-01-01", 60.0 * 365.25 * DAY_S);
    ck_assert_int_eq(clock.n_leaps, N_LEAPS);
    for (int k = 0; k < N_LEAPS; k++) {
        char want[UTC_TEXT_SIZE];
        snprintf(want, sizeof want, "%04d-%02d-%02dT23:59:60.000000Z", leap_days[k][0],
                 leap_days[k][1], leap_days[k][1] == 6 ? 30 : 31);
        ck_assert_str_eq(text_at(&clock, (double)clock.leap_s[k]), want);
    }
}
END_TEST

START_TEST(test_clock_run_spans_leap_second)
{
    static const char *const want[] = {
        "2016-12-31T23:59:58.750000Z", "2016-12-31T23:59:59.250000Z", "2016-12-31T23:59:59.750000Z",
        "2016-12-31T23:59:60.250000Z", "2016-12-31T23:59:60.750000Z", "2017-01-01T00:00:00.250000Z",
        "2017-01-01T00:00:00.750000Z", "2017-01-01T00:00:01.250000Z",
    };
    const run_clock clock = clock_from("2016-12-31T23:59:58.75Z", 10.0);
    for (int k = 0; k < 8; k++)
        ck_assert_str_eq(text_at(&clock, 0.5 * k), want[k]);
}
END_TEST

START_TEST(test_clock_run_starts_inside_leap_second)
{
    const run_clock clock = clock_from("2016-12-31T23:59:60.5Z", 10.0);
    ck_assert_str_eq(text_at(&clock, 0.0), "2016-12-31T23:59:60.500000Z");
    ck_assert_str_eq(text_at(&clock, 0.4), "2016-12-31T23:59:60.900000Z");
    ck_assert_str_eq(text_at(&clock, 0.5), "2017-01-01T00:00:00.000000Z");
    assert_near(clock.tai_minus_utc_s, 36.0, 0.0);
}
END_TEST

START_TEST(test_clock_run_ends_at_leap_second)
{
    const run_clock clock = clock_from("2016-12-31T23:59:00Z", 60.0);
    ck_assert_str_eq(text_at(&clock, 60.0), "2016-12-31T23:59:60.000000Z");
}
END_TEST

START_TEST(test_clock_text_rounds_to_microsecond)
{
    const run_clock clock = clock_from("2024-12-31T23:59:59Z", 10.0);
    ck_assert_str_eq(text_at(&clock, 0.9999994), "2024-12-31T23:59:59.999999Z");
    ck_assert_str_eq(text_at(&clock, 0.9999996), "2025-01-01T00:00:00.000000Z");
    ck_assert_str_eq(text_at(&clock, 0.1 + 0.2), "2024-12-31T23:59:59.300000Z");
    const run_clock leap = clock_from("2016-12-31T23:59:59Z", 10.0);
    ck_assert_str_eq(text_at(&leap, 0.9999996), "2016-12-31T23:59:60.000000Z");
    ck_assert_str_eq(text_at(&leap, 1.9999994), "2016-12-31T23:59:60.999999Z");
    ck_assert_str_eq(text_at(&leap, 1.9999996), "2017-01-01T00:00:00.000000Z");
    const run_clock late = clock_from("2024-06-30T23:59:59.9999999Z", 10.0);
    ck_assert_str_eq(text_at(&late, 0.0), "2024-07-01T00:00:00.000000Z");
}
END_TEST

/* ERFA's own way back from TT to a UTC text, through its quasi-JD. */
static void erfa_text(const double tt_jd[2], char out[UTC_TEXT_SIZE])
{
    double tai[2], utc[2];
    int year, month, day, hmsf[4];
    eraTttai(tt_jd[0], tt_jd[1], &tai[0], &tai[1]);
    eraTaiutc(tai[0], tai[1], &utc[0], &utc[1]);
    eraD2dtf("UTC", 6, utc[0], utc[1], &year, &month, &day, hmsf);
    const glint_utc fields = {year, month, day, hmsf[0], hmsf[1], hmsf[2], hmsf[3]};
    utc_write(&fields, out);
}

START_TEST(test_clock_text_agrees_with_erfa_over_decades)
{
    const double span_s = 35.0 * 365.25 * DAY_S;
    const run_clock clock = clock_from("1990-03-04T05:06:07.008009Z", span_s);
    for (int k = 0; k < 20000; k++) {
        /* 0.3 us past a whole microsecond, so that no moment is a tie */
        const double t_s = floor(span_s / 20000.0 * k * 1024.0) / 1024.0 + 0.3e-6;
        double tt_jd[2];
        char want[UTC_TEXT_SIZE];
        run_clock_tt(&clock, t_s, tt_jd);
        erfa_text(tt_jd, want);
        ck_assert_str_eq(text_at(&clock, t_s), want);
    }
}
END_TEST

START_TEST(test_clock_date_agrees_with_erfa_on_every_day)
{
    const double days = 84.0 * 365.25;
    const run_clock clock = clock_from("2017-01-01", days * DAY_S);
    for (int k = 0; k < (int)days; k++) {
        int year, month, day;
        double fraction;
        glint_utc utc;
        eraJd2cal(2457754.5, k, &year, &month, &day, &fraction); /* 2017-01-01 0h */
        run_clock_utc(&clock, k * DAY_S + 43200.0, &utc);
        ck_assert(utc.year == year && utc.month == month && utc.day == day && utc.hour == 12);
    }
}
END_TEST

START_TEST(test_clock_write_pads_with_zeros)
{
    const glint_utc utc = {987, 6, 5, 4, 3, 2, 1};
    char out[UTC_TEXT_SIZE];
    utc_write(&utc, out);
    ck_assert_str_eq(out, "0987-06-05T04:03:02.000001Z");
}
END_TEST

/* ------------------------------------------------------------- time scales */

static void check_time_scales(const char *path)
{
    csv_table t = table_open(path);
    for (long k = 0; k < t.n_rows; k++) {
        const utc_time utc = parsed(table_text(&t, k, "utc"));
        const double want_utc[2] = {table_number(&t, k, "utc_jd1"), table_number(&t, k, "utc_jd2")};
        const double want_tt[2] = {table_number(&t, k, "tt_jd1"), table_number(&t, k, "tt_jd2")};
        double utc_jd[2], tt_jd[2], again_jd[2], tai_minus_utc_s;
        utc_to_jd(&utc, utc_jd);
        utc_to_tt(&utc, tt_jd, &tai_minus_utc_s, NULL);
        utc_jd_to_tt(want_utc, again_jd, NULL);
        /* 2e-11 s is the rounding of a day's fraction */
        assert_near(jd_difference_s(utc_jd, want_utc), 0.0, 2e-11);
        assert_near(jd_difference_s(tt_jd, want_tt), 0.0, 2e-11);
        assert_near(jd_difference_s(again_jd, want_tt), 0.0, 2e-11);
        assert_near(tai_minus_utc_s, table_number(&t, k, "tai_minus_utc_s"), 0.0);
    }
    csv_free(&t);
}

START_TEST(test_clock_tt_matches_reference)
{
    table_check(check_time_scales, "orbit/sun_gcrs_itrs.csv");
}
END_TEST

static void check_ut1(const char *path)
{
    csv_table t = table_open(path);
    for (long k = 0; k < t.n_rows; k++) {
        const utc_time utc = parsed(table_text(&t, k, "utc"));
        run_clock clock;
        double ut1_jd[2];
        run_clock_start(&utc, 0.0, table_number(&t, k, "dut1_s"), &clock);
        run_clock_ut1(&clock, 0.0, ut1_jd);
        /* rad; 1e-14 rad of rotation is 0.14 ns */
        assert_near(eraEra00(ut1_jd[0], ut1_jd[1]), table_number(&t, k, "era_rad"), 1e-14);
    }
    csv_free(&t);
}

START_TEST(test_clock_ut1_gives_reference_earth_rotation)
{
    table_check(check_ut1, "orbit/gcrs_to_itrs.csv");
}
END_TEST

START_TEST(test_clock_tt_runs_evenly_over_leap_seconds)
{
    const run_clock clock = clock_from("2008-12-31T12:34:56.789Z", 4e8);
    static const double times_s[] = {-5.0, 0.0, 1e-3, 41103.211, 86400.0, 1e6, 123456789.015625,
                                     4e8};
    for (size_t k = 0; k < sizeof times_s / sizeof *times_s; k++) {
        double tt_jd[2], ut1_jd[2];
        run_clock_tt(&clock, times_s[k], tt_jd);
        run_clock_ut1(&clock, times_s[k], ut1_jd);
        /* the parts keep 4e-11 s (rounding of 2 d); one double for the difference, 2e-16 of it */
        assert_near(jd_difference_s(tt_jd, clock.tt_jd), times_s[k], 8e-11 + 2e-16 * times_s[k]);
        assert_near(jd_difference_s(tt_jd, ut1_jd), 32.184 + 33.0,
                    8e-11); /* TAI-UTC of the start */
        ck_assert(fabs(tt_jd[1]) < 3.0);
    }
}
END_TEST

START_TEST(test_clock_dubious_where_leap_seconds_are_unknown)
{
    ck_assert(!clock_from("2020-01-01", 1e6).dubious);
    ck_assert(clock_from("2098-01-01", 1e6).dubious);
    ck_assert(clock_from("2020-01-01", 60.0 * 365.25 * DAY_S).dubious);
    const utc_time utc = parsed("2098-01-01");
    double tt_jd[2];
    bool dubious = false;
    utc_to_tt(&utc, tt_jd, NULL, &dubious);
    ck_assert(dubious);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("clock");
    TCase *tcase = tcase_create("clock");
    suite_add_tcase(suite, tcase);
    tcase_add_test(tcase, test_clock_parse_accepts_forms);
    tcase_add_test(tcase, test_clock_parse_takes_offsets_off);
    tcase_add_test(tcase, test_clock_parse_refuses_other_forms);
    tcase_add_test(tcase, test_clock_parse_names_what_does_not_exist);
    tcase_add_test(tcase, test_clock_parse_worded_reads_named_months);
    tcase_add_test(tcase, test_clock_check_refuses_fields_out_of_range);
    tcase_add_test(tcase, test_clock_parse_keeps_long_decimals_in_their_second);
    tcase_add_test(tcase, test_clock_time_parse_reads_one_moment_in_all_scales);
    tcase_add_test(tcase, test_clock_time_parse_refuses_what_a_scale_has_not);
    tcase_add_test(tcase, test_clock_time_scale_find_knows_names);
    tcase_add_test(tcase, test_clock_tt_write_utc_names_leap_second);
    tcase_add_test(tcase, test_clock_check_knows_every_leap_second);
    tcase_add_test(tcase, test_clock_run_counts_every_leap_second);
    tcase_add_test(tcase, test_clock_run_spans_leap_second);
    tcase_add_test(tcase, test_clock_run_starts_inside_leap_second);
    tcase_add_test(tcase, test_clock_run_ends_at_leap_second);
    tcase_add_test(tcase, test_clock_text_rounds_to_microsecond);
    tcase_add_test(tcase, test_clock_text_agrees_with_erfa_over_decades);
    tcase_add_test(tcase, test_clock_date_agrees_with_erfa_on_every_day);
    tcase_add_test(tcase, test_clock_write_pads_with_zeros);
    tcase_add_test(tcase, test_clock_tt_matches_reference);
    tcase_add_test(tcase, test_clock_ut1_gives_reference_earth_rotation);
    tcase_add_test(tcase, test_clock_tt_runs_evenly_over_leap_seconds);
    tcase_add_test(tcase, test_clock_dubious_where_leap_seconds_are_unknown);
    return run_suite(suite);
}
