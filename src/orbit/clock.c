#include "orbit/clock.h"

#include "base/constants.h"
#include "base/text.h"

#include <erfa.h>
#include <erfam.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { DAY_SECONDS = 86400, MICRO = 1000000, FIRST_YEAR = 1972, LAST_YEAR = 2100 };

/* ---------------------------------------------------------------- calendar */

/* Days from 1970-01-01 (MJD 40587) to a date that eraCal2jd accepts. */
static int64_t days_from_date(int year, int month, int day)
{
    double mjd_zero, mjd;
    eraCal2jd(year, month, day, &mjd_zero, &mjd);
    return (int64_t)mjd - 40587;
}

/* The Gregorian date that lies `days` after 1970-01-01: the integer algorithm of Fliegel and Van
 * Flandern 1968, Commun. ACM 11, 657, whose names these are. Its day number counts noons: that of
 * 1970-01-01 is 2440588. */
static void date_from_days(int64_t days, int *year, int *month, int *day)
{
    int l = (int)days + 2440588 + 68569;
    const int n = 4 * l / 146097;
    l -= (146097 * n + 3) / 4;
    const int i = 4000 * (l + 1) / 1461001;
    l += 31 - 1461 * i / 4;
    const int j = 80 * l / 2447;
    *day = l - 2447 * j / 80;
    *month = j + 2 - 12 * (j / 11);
    *year = 100 * (n - 49) + i + j / 11;
}

static int month_length(int year, int month)
{
    const int next_year = month == 12 ? year + 1 : year, next_month = month % 12 + 1;
    return (int)(days_from_date(next_year, next_month, 1) - days_from_date(year, month, 1));
}

/* TAI-UTC in s on a date from 1972 on; true in *dubious when it is not known for that year. */
static double tai_minus_utc(int year, int month, int day, bool *dubious)
{
    double difference;
    const int code = eraDat(year, month, day, 0.0, &difference);
    if (dubious) *dubious = code > 0;
    return difference;
}

/* True when a leap second ends the day. */
static bool has_leap_second(int year, int month, int day)
{
    int y, m, d;
    date_from_days(days_from_date(year, month, day) + 1, &y, &m, &d);
    return tai_minus_utc(y, m, d, NULL) > tai_minus_utc(year, month, day, NULL) + 0.5;
}

/* ----------------------------------------------------------------- reading */

/* In place of a month: the day counts from 1 January. */
enum { DAY_OF_YEAR = -1 };

/* Reads exactly `count` digits. */
static bool take_digits(const char **at, int count, int *value)
{
    *value = 0;
    for (int k = 0; k < count; k++, ++*at) {
        if (**at < '0' || **at > '9') return false;
        *value = 10 * *value + (**at - '0');
    }
    return true;
}

static bool take(const char **at, char c)
{
    if (**at != c) return false;
    ++*at;
    return true;
}

/* ss or ss.fff with any number of decimals. */
static bool take_second(const char **at, double *second)
{
    const char *first = *at;
    int whole;
    if (!take_digits(at, 2, &whole)) return false;
    if (take(at, '.')) {
        const char *decimals = *at;
        while (**at >= '0' && **at <= '9')
            ++*at;
        if (*at == decimals) return false;
    }
    if (!number_read(first, (size_t)(*at - first), second)) return false;
    /* A long row of nines must not round up into the next second: 59.9... would become 60. */
    if (*second >= whole + 1) *second = nextafter(whole + 1, 0.0);
    return true;
}

/* Year and month and day, or year and day of the year; the latter stands in out->day with the
 * month DAY_OF_YEAR until day_of_year turns it into the former. */
static bool take_date(const char **at, utc_time *out)
{
    if (!take_digits(at, 4, &out->year) || !take(at, '-')) return false;
    if (strspn(*at, "0123456789") == 3) {
        out->month = DAY_OF_YEAR;
        return take_digits(at, 3, &out->day);
    }
    return take_digits(at, 2, &out->month) && take(at, '-') && take_digits(at, 2, &out->day);
}

static bool take_time(const char **at, utc_time *out)
{
    return take_digits(at, 2, &out->hour) && take(at, ':') && take_digits(at, 2, &out->minute) &&
           (!take(at, ':') || take_second(at, &out->second));
}

/* Nothing, Z, or an offset from UTC below 24 h. */
static bool take_zone(const char **at, int *offset_min)
{
    *offset_min = 0;
    if (take(at, 'Z') || take(at, 'z')) return true;
    const int sign = **at == '-' ? -1 : 1;
    if (!take(at, '+') && !take(at, '-')) return true;
    int hours, minutes;
    if (!take_digits(at, 2, &hours) || !take(at, ':') || !take_digits(at, 2, &minutes) ||
        hours > 23 || minutes > 59)
        return false;
    *offset_min = sign * (60 * hours + minutes);
    return true;
}

static bool take_all(const char *at, utc_time *out, int *offset_min)
{
    *offset_min = 0;
    if (!take_date(&at, out)) return false;
    if (!*at) return true;
    if (!take(&at, 'T') && !take(&at, 't') && !take(&at, ' ')) return false;
    return take_time(&at, out) && take_zone(&at, offset_min) && !*at;
}

/* -------------------------------------------------------------------- checks */

/* A date that was written as year and day of the year, as year, month and day. */
static glint_status day_of_year(utc_time *utc, place where, glint_error *error)
{
    if (utc->year < FIRST_YEAR - 1 || utc->year > LAST_YEAR + 1) { /* what it is: utc_check says */
        utc->month = utc->day = 1;
        return GLINT_OK;
    }
    const int64_t january_1 = days_from_date(utc->year, 1, 1);
    const int length = (int)(days_from_date(utc->year + 1, 1, 1) - january_1), day = utc->day;
    if (day < 1 || day > length)
        return error_set(error, GLINT_INPUT, where,
                         "day %03d of the year %04d does not exist; that year has %d days", day,
                         utc->year, length);
    date_from_days(january_1 + day - 1, &utc->year, &utc->month, &utc->day);
    return GLINT_OK;
}

/* The calendar and the clock face, without years' limits and without leap seconds. */
static glint_status check_fields(const utc_time *utc, place where, glint_error *error)
{
    if (utc->month < 1 || utc->month > 12)
        return error_set(error, GLINT_INPUT, where, "month %02d does not exist; expected 01 to 12",
                         utc->month);
    const int days = month_length(utc->year, utc->month);
    if (utc->day < 1 || utc->day > days)
        return error_set(error, GLINT_INPUT, where,
                         "day %04d-%02d-%02d does not exist; that month has %d days", utc->year,
                         utc->month, utc->day, days);
    if (utc->hour < 0 || utc->hour > 23 || utc->minute < 0 || utc->minute > 59 ||
        !(utc->second >= 0.0 && utc->second < 61.0))
        return error_set(error, GLINT_INPUT, where,
                         "time %02d:%02d:%06.3f does not exist; expected 00:00:00 to 23:59:60",
                         utc->hour, utc->minute, utc->second);
    return GLINT_OK;
}

glint_status utc_check(const utc_time *utc, place where, glint_error *error)
{
    if (utc->year < FIRST_YEAR || utc->year > LAST_YEAR)
        return error_set(error, GLINT_INPUT, where,
                         "year %04d UTC is out of range; expected %d to %d", utc->year, FIRST_YEAR,
                         LAST_YEAR);
    const glint_status status = check_fields(utc, where, error);
    if (status || utc->second < 60.0) return status;
    if (utc->hour != 23 || utc->minute != 59)
        return error_set(error, GLINT_INPUT, where,
                         "second 60 stands at %02d:%02d UTC; a leap second comes only at 23:59 UTC",
                         utc->hour, utc->minute);
    if (!has_leap_second(utc->year, utc->month, utc->day))
        return error_set(error, GLINT_INPUT, where,
                         "second 60 does not exist on %04d-%02d-%02d: no leap second ends that day",
                         utc->year, utc->month, utc->day);
    return GLINT_OK;
}

/* Takes a local time's offset off. */
static void shift_minutes(utc_time *utc, int offset_min)
{
    const int minute_of_day = 60 * utc->hour + utc->minute - offset_min;
    const int day_shift = minute_of_day < 0 ? -1 : minute_of_day >= 1440 ? 1 : 0;
    if (day_shift)
        date_from_days(days_from_date(utc->year, utc->month, utc->day) + day_shift, &utc->year,
                       &utc->month, &utc->day);
    utc->hour = (minute_of_day - 1440 * day_shift) / 60;
    utc->minute = (minute_of_day - 1440 * day_shift) % 60;
}

/* Reads the fields; what only UTC has, leap seconds and the years since 1972, is not checked. */
static glint_status parse_fields(const char *string, place where, utc_time *out, int *offset_min,
                                 glint_error *error)
{
    if (!take_all(string, out, offset_min))
        return error_set(error, GLINT_INPUT, where,
                         "'%.40s' is not a time; expected a form like 2025-07-24T19:10:00Z",
                         string);
    if (out->month == DAY_OF_YEAR) {
        const glint_status status = day_of_year(out, where, error);
        if (status) return status;
    }
    return check_fields(out, where, error);
}

glint_status utc_parse(const char *string, place where, utc_time *out, glint_error *error)
{
    utc_time utc = {0};
    int offset_min;
    glint_status status = parse_fields(string, where, &utc, &offset_min, error);
    if (status) return status;
    shift_minutes(&utc, offset_min);
    status = utc_check(&utc, where, error);
    if (!status) *out = utc;
    return status;
}

glint_status utc_parse_worded(const char *string, place where, utc_time *out, glint_error *error)
{
    static const char MONTHS[] = "janfebmaraprmayjunjulaugsepoctnovdec";
    int day, year, used = 0, k = 0;
    char month[4], time[32], plain[64];
    const bool good =
        sscanf(string, "%2d %3[A-Za-z] %4d %31s%n", &day, month, &year, time, &used) == 4 &&
        string[used] == '\0' && strlen(month) == 3 && day >= 0 && year >= 0;
    while (good && k < 12 && strncasecmp(MONTHS + 3 * k, month, 3) != 0)
        k++;
    if (!good || k == 12)
        return error_set(error, GLINT_INPUT, where,
                         "'%.40s' is not a time; expected a form like 24 Jul 2025 19:10:00.000",
                         string);
    snprintf(plain, sizeof plain, "%04d-%02d-%02dT%s", year, k + 1, day, time);
    return utc_parse(plain, where, out, error);
}

/* --------------------------------------------------------------- time scales */

void utc_to_jd(const utc_time *utc, double utc_jd[2])
{
    eraDtf2d("UTC", utc->year, utc->month, utc->day, utc->hour, utc->minute, utc->second,
             &utc_jd[0], &utc_jd[1]);
}

double utc_day_length_s(double jd)
{
    int year, month, day;
    double fraction;
    eraJd2cal(jd, 0.0, &year, &month, &day, &fraction);
    return DAY_S + (has_leap_second(year, month, day) ? 1.0 : 0.0);
}

void utc_to_tt(const utc_time *utc, double tt_jd[2], double *tai_minus_utc_s, bool *dubious)
{
    double utc_jd[2];
    utc_to_jd(utc, utc_jd);
    utc_jd_to_tt(utc_jd, tt_jd, dubious);
    if (tai_minus_utc_s) *tai_minus_utc_s = tai_minus_utc(utc->year, utc->month, utc->day, NULL);
}

void utc_jd_to_tt(const double utc_jd[2], double tt_jd[2], bool *dubious)
{
    double tai_jd[2];
    const int code = eraUtctai(utc_jd[0], utc_jd[1], &tai_jd[0], &tai_jd[1]);
    eraTaitt(tai_jd[0], tai_jd[1], &tt_jd[0], &tt_jd[1]);
    if (dubious) *dubious = code != 0;
}

double jd_difference_s(const double a[2], const double b[2])
{
    return ((a[0] - b[0]) + (a[1] - b[1])) * DAY_S;
}

/* ------------------------------------------------------------- times of files */

static const char *const SCALE_NAMES[] = {
    [SCALE_UTC] = "UTC", [SCALE_TAI] = "TAI", [SCALE_TT] = "TT",
    [SCALE_TDB] = "TDB", [SCALE_GPS] = "GPS",
};

glint_status time_scale_find(const char *name, place where, time_scale *out, glint_error *error)
{
    for (int k = 0; k <= SCALE_GPS; k++)
        if (strcasecmp(name, SCALE_NAMES[k]) == 0) {
            *out = (time_scale)k;
            return GLINT_OK;
        }
    if (strcasecmp(name, "TDT") == 0) {
        *out = SCALE_TT;
        return GLINT_OK;
    }
    const bool earth = strcasecmp(name, "UT1") == 0 || strcasecmp(name, "GMST") == 0;
    return error_set(error, GLINT_INPUT, where,
                     "the time system '%.20s' is not taken%s; expected UTC, TAI, TT, TDB or GPS; "
                     "have the file written in one of these",
                     name,
                     earth ? ": it counts turns of the Earth, which the file does not give" : "");
}

/* Fields of a uniform scale as its own two-part JD. */
static void uniform_jd(const utc_time *t, double jd[2])
{
    eraCal2jd(t->year, t->month, t->day, &jd[0], &jd[1]);
    jd[0] += jd[1];
    jd[1] = (3600.0 * t->hour + 60.0 * t->minute + t->second) / DAY_S;
}

glint_status time_parse(const char *string, time_scale scale, place where, double tt_jd[2],
                        glint_error *error)
{
    static const double GPS_MINUS_TAI_S = -19.0; /* s, IS-GPS-200: the scales met in 1980 */
    utc_time t = {0};
    if (scale == SCALE_UTC) {
        const glint_status status = utc_parse(string, where, &t, error);
        if (!status) utc_to_tt(&t, tt_jd, NULL, NULL);
        return status;
    }
    int offset_min;
    const glint_status status = parse_fields(string, where, &t, &offset_min, error);
    if (status) return status;
    if (offset_min != 0 || t.second >= 60.0 || t.year < FIRST_YEAR || t.year > LAST_YEAR)
        return error_set(error, GLINT_INPUT, where,
                         "'%.40s' is no time of %s; expected the years %d to %d, no offset of a "
                         "zone and no second 60",
                         string, SCALE_NAMES[scale], FIRST_YEAR, LAST_YEAR);
    uniform_jd(&t, tt_jd);
    if (scale == SCALE_TAI) tt_jd[1] += TT_MINUS_TAI_S / DAY_S;
    if (scale == SCALE_GPS) tt_jd[1] += (TT_MINUS_TAI_S - GPS_MINUS_TAI_S) / DAY_S;
    if (scale == SCALE_TDB) /* at the Earth's centre: neither longitude nor UT matter there */
        tt_jd[1] -= eraDtdb(tt_jd[0], tt_jd[1], 0.0, 0.0, 0.0, 0.0) / DAY_S;
    return GLINT_OK;
}

void tt_write_utc(const double tt_jd[2], char *out)
{
    double tai_jd[2], utc_jd[2];
    int year, month, day, time[4];
    eraTttai(tt_jd[0], tt_jd[1], &tai_jd[0], &tai_jd[1]);
    eraTaiutc(tai_jd[0], tai_jd[1], &utc_jd[0], &utc_jd[1]);
    eraD2dtf("UTC", 6, utc_jd[0], utc_jd[1], &year, &month, &day, time);
    utc_write(&(glint_utc){.year = year,
                           .month = month,
                           .day = day,
                           .hour = time[0],
                           .minute = time[1],
                           .second = time[2],
                           .microsecond = time[3]},
              out);
}

/* ---------------------------------------------------------- a run's time line */

/* Finds the leap seconds of the span. They are inserted at the ends of months only (ITU-R
 * TF.460-6). */
static void find_leaps(run_clock *clock, double span_s)
{
    int year = clock->start.year, month = clock->start.month;
    double before_s = clock->tai_minus_utc_s;
    while (clock->n_leaps < CLOCK_MAX_LEAPS) {
        year += month == 12;
        month = month % 12 + 1;
        const int64_t day = days_from_date(year, month, 1) - clock->start_day;
        const int64_t end_of_month_s = day * DAY_SECONDS + clock->n_leaps;
        if ((double)end_of_month_s > (double)(clock->start_s + 1) + span_s) return;
        const double after_s = tai_minus_utc(year, month, 1, NULL);
        if (after_s > before_s + 0.5) clock->leap_s[clock->n_leaps++] = end_of_month_s;
        before_s = after_s;
    }
}

void run_clock_start(const utc_time *start, double span_s, double dut1_s, run_clock *clock)
{
    *clock = (run_clock){.start = *start, .dut1_s = dut1_s};
    bool start_dubious, end_dubious;
    utc_to_tt(start, clock->tt_jd, &clock->tai_minus_utc_s, &start_dubious);
    clock->start_day = days_from_date(start->year, start->month, start->day);
    const int second = (int)start->second;
    clock->start_s = 3600 * start->hour + 60 * start->minute + second;
    clock->start_fraction_s = start->second - second;
    find_leaps(clock, span_s);
    glint_utc end;
    run_clock_utc(clock, span_s, &end);
    tai_minus_utc(end.year, end.month, end.day, &end_dubious);
    clock->dubious = start_dubious || end_dubious;
}

void run_clock_utc(const run_clock *clock, double t_s, glint_utc *out)
{
    /* Whole seconds and fractions are added apart, so that a long run loses no digits. */
    const int64_t whole_s = (int64_t)t_s;
    const double fraction_s = clock->start_fraction_s + (t_s - (double)whole_s);
    const int64_t us = (clock->start_s + whole_s) * MICRO + (int64_t)llrint(fraction_s * 1e6);
    int passed = 0;
    bool inside = false;
    for (; passed < clock->n_leaps && us >= clock->leap_s[passed] * MICRO; passed++)
        inside = us < (clock->leap_s[passed] + 1) * MICRO;
    /* Inside a leap second the day's count stands at 23:59:59, and a second is added below. */
    const int64_t count_us = us - (int64_t)passed * MICRO;
    const int64_t count_s = count_us / MICRO, days = count_s / DAY_SECONDS;
    const int second_of_day = (int)(count_s - days * DAY_SECONDS);
    date_from_days(clock->start_day + days, &out->year, &out->month, &out->day);
    out->hour = second_of_day / 3600;
    out->minute = second_of_day / 60 % 60;
    out->second = second_of_day % 60 + inside;
    out->microsecond = (int)(count_us - count_s * MICRO);
}

/* The start in one scale, moved by t_s: whole days go to the first part. */
static void jd_after(const double start_jd[2], double t_s, double offset_s, double jd[2])
{
    const double days = floor(t_s / DAY_S);
    jd[0] = start_jd[0] + days;
    jd[1] = start_jd[1] + (t_s - days * DAY_S + offset_s) / DAY_S;
}

void run_clock_tt(const run_clock *clock, double t_s, double tt_jd[2])
{
    jd_after(clock->tt_jd, t_s, 0.0, tt_jd);
}

void run_clock_ut1(const run_clock *clock, double t_s, double ut1_jd[2])
{
    double ut1_minus_tai_s = clock->dut1_s - clock->tai_minus_utc_s;
    if (clock->eop) {
        double tt_jd[2];
        eop_values values;
        run_clock_tt(clock, t_s, tt_jd);
        eop_at(clock->eop, tt_jd, &values);
        ut1_minus_tai_s = values.ut1_minus_tai_s;
    }
    jd_after(clock->tt_jd, t_s, ut1_minus_tai_s - TT_MINUS_TAI_S, ut1_jd);
}

void utc_from_mjd(int mjd, glint_utc *out)
{
    double fraction;
    *out = (glint_utc){0};
    eraJd2cal(ERFA_DJM0, mjd, &out->year, &out->month, &out->day, &fraction);
}

void run_clock_orient(run_clock *clock, const eop_table *eop)
{
    eop_values values;
    eop_at(eop, clock->tt_jd, &values);
    clock->eop = eop;
    clock->dut1_s = values.ut1_minus_tai_s + clock->tai_minus_utc_s;
}

/* ------------------------------------------------------------------- writing */

static void put2(char *out, int value)
{
    out[0] = (char)('0' + value / 10);
    out[1] = (char)('0' + value % 10);
}

void utc_write(const glint_utc *utc, char out[UTC_TEXT_SIZE])
{
    const int us = utc->microsecond;
    memcpy(out, "....-..-..T..:..:.........Z", UTC_TEXT_SIZE);
    put2(out, utc->year / 100);
    put2(out + 2, utc->year % 100);
    put2(out + 5, utc->month);
    put2(out + 8, utc->day);
    put2(out + 11, utc->hour);
    put2(out + 14, utc->minute);
    put2(out + 17, utc->second);
    put2(out + 20, us / 10000);
    put2(out + 22, us / 100 % 100);
    put2(out + 24, us % 100);
}
