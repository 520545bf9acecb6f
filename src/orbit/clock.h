/* clock.h: UTC with leap seconds, TT, and the time line of one run. Built on ERFA. */
#ifndef GLINT_ORBIT_CLOCK_H
#define GLINT_ORBIT_CLOCK_H

#include "orbit/eop.h"

/* A moment of UTC as people write it; second may be 60.x on a day that ends in a leap second. */
typedef struct utc_time {
    int year, month, day, hour, minute;
    double second;
} utc_time;

/* Reads "2025-07-24T19:10:00Z": date, 'T' or a blank, hh:mm or hh:mm:ss with any decimals, and
 * nothing, 'Z' or an offset +hh:mm (nothing means UTC; offsets are taken off; 't' and 'z' count as
 * 'T' and 'Z'). A date alone is its 0h. The date may be a year and the day in it, "2025-205" (CCSDS
 * 301.0-B-4, section 3.5). Errors: GLINT_INPUT: not of that form, no such date or time, a year that
 * utc_check refuses, second 60 where there is no leap second. *out is set on success only. */
glint_status utc_parse(const char *string, place where, utc_time *out, glint_error *error);

/* Reads "24 Jul 2025 19:10:00.000", as STK writes times; months in English. Errors as above. */
glint_status utc_parse_worded(const char *string, place where, utc_time *out, glint_error *error);

/* Checks the calendar (years 1972 to 2100: UTC has whole leap seconds since 1972, the Sun's
 * ephemeris holds to 2100) and the day's length. Errors: GLINT_INPUT. */
glint_status utc_check(const utc_time *utc, place where, glint_error *error);

/* The scales in which files of others give their times. GPS runs 19 s behind TAI. */
typedef enum time_scale { SCALE_UTC, SCALE_TAI, SCALE_TT, SCALE_TDB, SCALE_GPS } time_scale;
/* The scale of that name, letter case ignored ("TDT" is an old name of TT). Errors: GLINT_INPUT: a
 * scale that is not one of these; of UT1, GMST and those of other bodies or clocks the message says
 * what is missing. */
glint_status time_scale_find(const char *name, place where, time_scale *out, glint_error *error);
/* Reads a moment of a scale, written as in utc_parse (offsets of zones only in UTC), as TT in two
 * parts, the day and the rest. TDB: by eraDtdb for the Earth's centre, to 1e-5 s. Errors as in
 * utc_parse. */
glint_status time_parse(const char *string, time_scale scale, place where, double tt_jd[2],
                        glint_error *error);
/* Writes a TT as UTC, for messages: "2025-07-24T19:10:00.000000Z", rounded to the microsecond. */
void tt_write_utc(const double tt_jd[2], char *out);

/* UTC as ERFA's two-part quasi-JD (0h of the day, fraction of the day's true length). Pass only
 * checked times. */
void utc_to_jd(const utc_time *utc, double utc_jd[2]);
/* Length of the UTC day that begins at a JD, s: 86 400, or 86 401 where a leap second ends it. */
double utc_day_length_s(double jd);
/* UTC to TT as two-part JD, with TAI-UTC in s; inside a leap second that is still the value of the
 * day that the leap second ends. Pass only checked times. tai_minus_utc_s, dubious: NULL allowed;
 * dubious: true when leap seconds are not known for that year. */
void utc_to_tt(const utc_time *utc, double tt_jd[2], double *tai_minus_utc_s, bool *dubious);
/* The same from a quasi-JD (epochs of element sets). */
void utc_jd_to_tt(const double utc_jd[2], double tt_jd[2], bool *dubious);
/* (a - b) in s, for two-part JDs. */
double jd_difference_s(const double a[2], const double b[2]);

/* The time line of a run: TT seconds from its start. Leap seconds that fall inside shift UTC but
 * not TT. UT1 = TT - 32.184 s - (TAI-UTC) + DUT1 with the TAI-UTC and DUT1 of the start throughout;
 * or, after run_clock_orient, of measured Earth orientation. Immutable after these. */
enum { CLOCK_MAX_LEAPS = 64 }; /* 27 leap seconds were inserted from 1972 to 2017 */
typedef struct run_clock {
    double tt_jd[2];        /* TT of the start */
    double tai_minus_utc_s; /* at the start */
    double dut1_s;          /* UT1-UTC at the start */
    utc_time start;
    int64_t start_day;               /* days since 1970-01-01 */
    int64_t start_s;                 /* whole s of the start since 0h UTC of that day */
    double start_fraction_s;         /* the rest of it, 0 <= fraction < 1 */
    int n_leaps;                     /* leap seconds that end after the start, within the span */
    int64_t leap_s[CLOCK_MAX_LEAPS]; /* when each 23:59:60 begins: s since 0h UTC of the start's
                                        day, earlier leap seconds counted */
    bool dubious;                    /* leap seconds not known for the start or the end */
    const eop_table *eop;            /* borrowed; NULL: the same DUT1 throughout */
} run_clock;

/* start: a checked time; span_s: length of the run in TT s, 0 to 6e9; dut1_s: UT1-UTC in s. */
void run_clock_start(const utc_time *start, double span_s, double dut1_s, run_clock *clock);
/* 0h UTC of a modified Julian day, years 1 to 9999. */
void utc_from_mjd(int mjd, glint_utc *out);
/* From now on UT1 is that of a table, which must outlive the clock and cover the run. */
void run_clock_orient(run_clock *clock, const eop_table *eop);
/* UTC at t_s >= 0 within the span, rounded to the microsecond (never ...:60.000000 but inside a
 * leap second). */
void run_clock_utc(const run_clock *clock, double t_s, glint_utc *out);
/* TT and UT1 at t_s (of any sign) as two-part JD: whole days with the start's first part, and the
 * rest, which stays within a few days of 0 so that it keeps 1e-11 s however long the run. */
void run_clock_tt(const run_clock *clock, double t_s, double tt_jd[2]);
void run_clock_ut1(const run_clock *clock, double t_s, double ut1_jd[2]);
/* Length that the text of a UTC takes: "2025-07-24T19:10:00.000000Z" */
enum { UTC_TEXT_SIZE = 28 };
/* Writes it with exactly six decimals, terminated; fast (no printf). Years 0 to 9999. */
void utc_write(const glint_utc *utc, char out[UTC_TEXT_SIZE]);

#endif
