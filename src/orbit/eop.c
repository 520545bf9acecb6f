#include "orbit/eop.h"

#include "base/constants.h"
#include "base/grow.h"
#include "base/text.h"

#include <ctype.h>
#include <erfa.h>
#include <erfam.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef enum eop_kind { EOP_UNKNOWN, EOP_FINALS, EOP_C04 } eop_kind;

/* One day. */
typedef struct eop_row {
    double tt_days; /* 0h UTC as days of TT from J2000.0 */
    eop_values values;
} eop_row;

struct eop_table {
    eop_kind kind;
    int first_mjd, predicted_mjd; /* as of eop_span; 0 while nothing is predicted */
    eop_row *rows;                /* owned; n */
    int n, capacity;
};

enum { FIRST_MJD = 41317 }; /* 1972-01-01: UTC has whole leap seconds since */

/* ----------------------------------------------------------------- one line */

/* A record as it stands in a line. */
typedef struct eop_record {
    int year, month, day;
    double mjd;
    double x_arcsec, y_arcsec, ut1_utc_s;
    bool predicted, has_ut1;
} eop_record;

/* A line being read: bytes and their place. */
typedef struct eop_line {
    const char *text;
    size_t length; /* without the line end */
    place where;   /* of its first byte */
} eop_line;

static place column_of(const eop_line *line, size_t column)
{
    return (place){line->where.file, line->where.line, (int)column};
}

/* The bytes of columns from..to (counted from 1), blanks around them left out. */
static const char *field(const eop_line *line, size_t from, size_t to, size_t *length)
{
    const size_t last = to < line->length ? to : line->length;
    const char *a = line->text + (from - 1 < last ? from - 1 : last), *b = line->text + last;
    while (a < b && *a == ' ')
        a++;
    while (b > a && b[-1] == ' ')
        b--;
    *length = (size_t)(b - a);
    return a;
}

/* The number in columns from..to; an error where there is none. */
static glint_status fixed_number(const eop_line *line, size_t from, size_t to, const char *what,
                                 double *out, glint_errors *errors)
{
    size_t n;
    const char *bytes = field(line, from, to, &n);
    *out = 0;
    if (n > 0 && number_read(bytes, n, out)) return GLINT_OK;
    return errors_add(errors, GLINT_INPUT, column_of(line, from),
                      "columns %zu to %zu hold '%.*s'; expected %s", from, to, (int)n, bytes, what);
}

/* finals2000A: fixed columns, its read-me file says which. Bulletin A. */
static glint_status read_finals(const eop_line *line, eop_record *out, glint_errors *errors)
{
    double year, month, day;
    size_t n;
    glint_status status = fixed_number(line, 1, 2, "the year", &year, errors);
    if (!status) status = fixed_number(line, 3, 4, "the month", &month, errors);
    if (!status) status = fixed_number(line, 5, 6, "the day of the month", &day, errors);
    if (!status) status = fixed_number(line, 8, 15, "the MJD", &out->mjd, errors);
    if (status) return status;
    out->year = (int)year + (out->mjd <= 51543 ? 1900 : 2000); /* 51543: the end of 1999 */
    out->month = (int)month;
    out->day = (int)day;
    field(line, 59, 68, &n);
    out->has_ut1 = n > 0;
    if (!out->has_ut1) return GLINT_OK;
    status = fixed_number(line, 19, 27, "polar motion x in arcsec", &out->x_arcsec, errors);
    if (!status)
        status = fixed_number(line, 38, 46, "polar motion y in arcsec", &out->y_arcsec, errors);
    if (!status) status = fixed_number(line, 59, 68, "UT1-UTC in s", &out->ut1_utc_s, errors);
    const char pole = line->length > 16 ? line->text[16] : ' ';
    const char turn = line->length > 57 ? line->text[57] : ' ';
    if (!status && ((pole != 'I' && pole != 'P') || (turn != 'I' && turn != 'P')))
        status =
            errors_add(errors, GLINT_INPUT, column_of(line, pole == 'I' || pole == 'P' ? 58 : 17),
                       "expected the flag I (measured) or P (predicted) in columns 17 and 58");
    out->predicted = pole == 'P' || turn == 'P';
    return status;
}

/* C04: year, month, day, in newer files the hour, then MJD, x, y, UT1-UTC; blanks between. */
static glint_status read_c04(const eop_line *line, eop_record *out, glint_errors *errors)
{
    enum { MOST = 8 };
    double number[MOST];
    int n = 0;
    for (size_t at = 0; n < MOST;) {
        while (at < line->length && isspace((unsigned char)line->text[at]))
            at++;
        if (at == line->length) break;
        size_t end = at;
        while (end < line->length && !isspace((unsigned char)line->text[end]))
            end++;
        if (!number_read(line->text + at, end - at, &number[n++]))
            return errors_add(errors, GLINT_INPUT, column_of(line, at + 1),
                              "'%.*s' is no number; expected year, month, day, MJD, x, y, UT1-UTC",
                              (int)(end - at < 40 ? end - at : 40), line->text + at);
        at = end;
    }
    const int hour = n > 3 && number[3] < 24; /* no MJD: those of 1962 on have five digits */
    if (n < 7 + hour)
        return errors_add(errors, GLINT_INPUT, column_of(line, 1),
                          "the line holds %d numbers; expected year, month, day, %sMJD, x, y, "
                          "UT1-UTC",
                          n, hour ? "hour, " : "");
    if (hour && number[3] != 0)
        return errors_add(errors, GLINT_INPUT, column_of(line, 1),
                          "the hour is %g; expected a series of days at 0h", number[3]);
    const double *rest = number + 3 + hour;
    *out = (eop_record){(int)number[0], (int)number[1], (int)number[2], rest[0], rest[1],
                        rest[2],        rest[3],        false,          true};
    return GLINT_OK;
}

/* What kind of file a line belongs to; EOP_UNKNOWN for a line of text. */
static eop_kind kind_of_line(const eop_line *line)
{
    enum { FINALS_MJD_FROM = 8, FINALS_MJD_TO = 15, FINALS_POINT = 13 }; /* " 1 1 1 41684.00" */
    double mjd;
    size_t n;
    const char *bytes = field(line, FINALS_MJD_FROM, FINALS_MJD_TO, &n);
    if (n == 8 && line->text[FINALS_POINT - 1] == '.' && number_read(bytes, n, &mjd))
        return EOP_FINALS;
    bytes = field(line, 1, line->length, &n);
    return n > 0 && isdigit((unsigned char)*bytes) ? EOP_C04 : EOP_UNKNOWN;
}

/* ----------------------------------------------------------------- one row */

static glint_status check_date(const eop_line *line, const eop_record *r, glint_errors *errors)
{
    double zero, mjd;
    if (eraCal2jd(r->year, r->month, r->day, &zero, &mjd) == 0 && mjd == r->mjd) return GLINT_OK;
    return errors_add(errors, GLINT_INPUT, column_of(line, 1),
                      "the date %d-%02d-%02d does not fit MJD %.10g; expected a day at 0h", r->year,
                      r->month, r->day, r->mjd);
}

static glint_status check_values(const eop_line *line, const eop_record *r, glint_errors *errors)
{
    /* The pole stays within 0.6 arcsec of the axis, and UTC is kept within 0.9 s of UT1, but for
     * predictions across a leap second that was not known. */
    static const double POLE_ARCSEC = 1, UT1_S = 2;
    if (fabs(r->x_arcsec) <= POLE_ARCSEC && fabs(r->y_arcsec) <= POLE_ARCSEC &&
        fabs(r->ut1_utc_s) <= UT1_S)
        return GLINT_OK;
    return errors_add(errors, GLINT_INPUT, column_of(line, 1),
                      "polar motion %g, %g arcsec, UT1-UTC %g s; expected at most %g arcsec and "
                      "%g s",
                      r->x_arcsec, r->y_arcsec, r->ut1_utc_s, POLE_ARCSEC, UT1_S);
}

static glint_status add_row(eop_table *t, const eop_line *line, const eop_record *r,
                            glint_errors *errors)
{
    if (t->n > 0 && r->mjd != t->first_mjd + t->n)
        return errors_add(errors, GLINT_INPUT, column_of(line, 1),
                          "MJD %.10g follows MJD %d; expected the next day", r->mjd,
                          t->first_mjd + t->n - 1);
    if (!grow_room(&t->rows, &t->capacity, t->n + 1L, sizeof *t->rows))
        return errors_no_memory(errors);
    if (t->n == 0) t->first_mjd = (int)r->mjd;
    if (r->predicted && !t->predicted_mjd) t->predicted_mjd = (int)r->mjd;
    double tai_utc_s;
    eraDat(r->year, r->month, r->day, 0, &tai_utc_s);
    t->rows[t->n++] =
        (eop_row){r->mjd - (ERFA_DJ00 - ERFA_DJM0) + (tai_utc_s + TT_MINUS_TAI_S) / DAY_S,
                  {r->ut1_utc_s - tai_utc_s, r->x_arcsec * ARCSEC, r->y_arcsec * ARCSEC}};
    return GLINT_OK;
}

/* ---------------------------------------------------------------- the file */

/* Reads a line into the table; *done at the first day without UT1. */
static glint_status take_line(eop_table *t, const eop_line *line, bool *done, glint_errors *errors)
{
    size_t n;
    const char *bytes = field(line, 1, line->length, &n);
    if (n == 0 || *bytes == '#') return GLINT_OK;
    if (t->kind == EOP_UNKNOWN) t->kind = kind_of_line(line);
    if (t->kind == EOP_UNKNOWN) return GLINT_OK; /* the head of a C04 file */
    eop_record r = {0};
    glint_status status =
        t->kind == EOP_FINALS ? read_finals(line, &r, errors) : read_c04(line, &r, errors);
    if (!status) status = check_date(line, &r, errors);
    if (status || r.mjd < FIRST_MJD) return status;
    if (!r.has_ut1) {
        *done = true;
        return GLINT_OK;
    }
    status = check_values(line, &r, errors);
    return status ? status : add_row(t, line, &r, errors);
}

static glint_status take_lines(eop_table *t, const char *path, const char *at, const char *end,
                               glint_errors *errors)
{
    enum { MOST_ERRORS = 20 }; /* a file of something else has no good line at all */
    glint_status worst = GLINT_OK;
    bool done = false;
    int bad = 0;
    for (int number = 1; at < end && !done && bad < MOST_ERRORS; number++) {
        const char *stop = memchr(at, '\n', (size_t)(end - at));
        eop_line line = {at, (size_t)((stop ? stop : end) - at), {path, number, 1}};
        if (!stop) {
            errors_warn(errors, line.where,
                        "the last line has no line end and may be cut, so it is left out; if it is "
                        "whole, end it with a line end");
            break;
        }
        if (line.length > 0 && line.text[line.length - 1] == '\r') line.length--;
        const glint_status status = take_line(t, &line, &done, errors);
        if (status > worst) worst = status;
        bad += status != GLINT_OK;
        at = stop + 1;
    }
    return worst;
}

glint_status eop_read(const char *path, place asked_from, eop_table **out, glint_errors *errors)
{
    glint_error error;
    size_t size;
    char *bytes;
    *out = NULL;
    glint_status status = file_read(path, &bytes, &size, asked_from, &error);
    if (status) return errors_take(errors, &error, asked_from);
    eop_table *t = calloc(1, sizeof *t);
    if (!t) {
        free(bytes);
        return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    }
    const size_t mark = size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    if (memchr(bytes, '\0', size))
        status = errors_add(errors, GLINT_INPUT, (place){path, 0, 0},
                            "this is not a text file: it holds a zero byte");
    else
        status = take_lines(t, path, bytes + mark, bytes + size, errors);
    if (!status && t->n < 2)
        status =
            errors_add(errors, GLINT_INPUT, (place){path, 0, 0},
                       "the file has %d whole days of Earth orientation from 1972 on; expected "
                       "at least 2, as finals2000A or C04",
                       t->n);
    free(bytes);
    if (status)
        eop_free(t);
    else
        *out = t;
    return status;
}

void eop_free(eop_table *table)
{
    if (!table) return;
    free(table->rows);
    free(table);
}

/* ------------------------------------------------------------------ values */

const char *eop_format(const eop_table *table)
{
    return table->kind == EOP_FINALS ? "finals2000A" : "C04";
}

void eop_span(const eop_table *t, int *first_mjd, int *last_mjd, int *predicted_mjd)
{
    *first_mjd = t->first_mjd;
    *last_mjd = t->first_mjd + t->n - 1;
    *predicted_mjd = t->predicted_mjd ? t->predicted_mjd : *last_mjd + 1;
}

static double days_since_j2000(const double jd[2])
{
    return (jd[0] - ERFA_DJ00) + jd[1];
}

bool eop_covers(const eop_table *t, const double tt_jd[2])
{
    const double days = days_since_j2000(tt_jd);
    return days >= t->rows[0].tt_days && days <= t->rows[t->n - 1].tt_days;
}

void eop_at(const eop_table *t, const double tt_jd[2], eop_values *out)
{
    /* Days are 86400 s, some one more: the right row is this one, or a neighbour. */
    const double days = days_since_j2000(tt_jd), position = days - t->rows[0].tt_days;
    int k = (int)fmin(fmax(floor(position), 0), t->n - 2);
    if (k > 0 && days < t->rows[k].tt_days) k--;
    const eop_row *a = &t->rows[k], *b = a + 1;
    const double u = (days - a->tt_days) / (b->tt_days - a->tt_days), v = 1 - u;
    out->ut1_minus_tai_s = v * a->values.ut1_minus_tai_s + u * b->values.ut1_minus_tai_s;
    out->xp_rad = v * a->values.xp_rad + u * b->values.xp_rad;
    out->yp_rad = v * a->values.yp_rad + u * b->values.yp_rad;
}

uint64_t eop_fingerprint(const eop_table *t)
{
    /* FNV-1a (Fowler, Noll, Vo) over the rows, which have no gaps between their numbers. */
    uint64_t hash = 0xcbf29ce484222325ull;
    const unsigned char *bytes = (const unsigned char *)t->rows;
    for (size_t i = 0; i < (size_t)t->n * sizeof *t->rows; i++)
        hash = (hash ^ bytes[i]) * 0x100000001b3ull;
    return hash;
}
