#include "orbit/stk.h"

#include "base/constants.h"
#include "base/grow.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/clock.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Forms of rows: how many numbers follow the time. */
static const struct {
    const char *name;
    int n_numbers;
} FORMS[] = {{"EphemerisTimePos", 3}, {"EphemerisTimePosVel", 6}, {"EphemerisTimePosVelAcc", 9}};
enum { N_FORMS = sizeof FORMS / sizeof *FORMS, MOST_NUMBERS = 9, DEFAULT_SAMPLES_M1 = 5 };

/* Where in the file the reading is. */
typedef enum stk_part { PART_HEAD, PART_BOUNDARIES, PART_ROWS, PART_SKIPPED } stk_part;

typedef struct stk_reading {
    orbit_table *table;
    glint_errors *errors;
    glint_status worst;
    char *line; /* the current one, terminated, blanks taken off */
    int number, column;
    stk_part part;
    bool begun, ended, has_epoch;
    double epoch_jd[2]; /* TT */
    char frame_name[TABLE_TEXT_SIZE];
    table_frame frame;
    bool eme2000;
    double unit_m;
    const char *unit;
    table_method method;
    int samples_m1;
    int n_numbers;  /* of a row */
    long announced; /* NumberOfEphemerisPoints; -1 where not said */
    long n;
    double *boundaries_s; /* owned; SegmentBoundaryTimes */
    size_t n_boundaries, boundary_capacity;
    double last_s; /* time of the last row */
} stk_reading;

static place here(const stk_reading *s, const char *at)
{
    return (place){s->table->path, s->number, s->column + (int)(at - s->line)};
}

static void fail(stk_reading *s, const char *at, const char *format, ...) GLINT_PRINTF(3, 4);

static void fail(stk_reading *s, const char *at, const char *format, ...)
{
    char message[512];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    s->worst = errors_add(s->errors, GLINT_INPUT, here(s, at), "%s", message);
}

static void no_memory(stk_reading *s)
{
    s->worst = errors_add(s->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
}

static bool same(const char *a, const char *b)
{
    return strcasecmp(a, b) == 0;
}

/* -------------------------------------------------------------------- heading */

static void read_epoch(stk_reading *s, const char *value)
{
    utc_time utc;
    glint_error error;
    if (utc_parse_worded(value, here(s, value), &utc, &error)) {
        s->worst = errors_take(s->errors, &error, PLACE_NONE);
        return;
    }
    utc_to_tt(&utc, s->epoch_jd, NULL, NULL);
    s->has_epoch = true;
}

static void read_axes(stk_reading *s, const char *value)
{
    snprintf(s->frame_name, sizeof s->frame_name, "%s", value);
    if (same(value, "Fixed"))
        s->frame = TABLE_ITRS;
    else if (same(value, "Inertial"))
        s->frame = TABLE_GCRS;
    else if (!table_frame_find(value, &s->frame, &s->eme2000))
        fail(s, value,
             "CoordinateSystem '%.40s' is not taken; expected ICRF, Inertial, J2000, TEMEOfDate or "
             "Fixed",
             value);
}

static void read_method(stk_reading *s, const char *value)
{
    if (same(value, "Hermite"))
        s->method = TABLE_HERMITE;
    else if (!same(value, "Lagrange"))
        fail(s, value, "InterpolationMethod is '%.40s'; expected Lagrange or Hermite", value);
}

/* A whole number of that range. */
static void read_whole(stk_reading *s, const char *keyword, const char *value, long min, long max,
                       long *out)
{
    double number;
    if (number_read(value, strlen(value), &number) && number >= (double)min &&
        number <= (double)max && number == floor(number))
        *out = (long)number;
    else
        fail(s, value, "%s is '%.40s'; expected a whole number from %ld to %ld", keyword, value,
             min, max);
}

static void read_unit(stk_reading *s, const char *value)
{
    if (same(value, "Kilometers")) {
        s->unit_m = 1e3;
        s->unit = "km";
    } else if (!same(value, "Meters")) {
        fail(s, value, "DistanceUnit is '%.40s'; expected Meters or Kilometers", value);
    }
}

/* A word that must be the only one. */
static void require_value(stk_reading *s, const char *keyword, const char *value,
                          const char *expected)
{
    if (!same(value, expected))
        fail(s, value, "%s is '%.40s'; expected %s", keyword, value, expected);
}

/* A line that begins rows of one form or another; false when it is none. */
static bool begin_rows(stk_reading *s, const char *keyword)
{
    int form = 0;
    while (form < N_FORMS && !same(keyword, FORMS[form].name))
        form++;
    if (form == N_FORMS) {
        if (strncasecmp(keyword, "Covariance", 10) == 0) {
            s->part = PART_SKIPPED;
            return true;
        }
        if (strncasecmp(keyword, "Ephemeris", 9) != 0) return false;
        fail(s, s->line,
             "rows of the form %.40s are not taken; expected EphemerisTimePos, "
             "EphemerisTimePosVel or EphemerisTimePosVelAcc",
             keyword);
        s->part = PART_SKIPPED;
        return true;
    }
    s->part = PART_ROWS;
    s->n_numbers = FORMS[form].n_numbers;
    if (!s->has_epoch && !s->worst)
        fail(s, s->line, "the rows begin, and there was no ScenarioEpoch; expected one");
    if (!s->frame_name[0])
        fail(s, s->line, "the rows begin, and there was no CoordinateSystem; expected one");
    if (s->method == TABLE_HERMITE && s->n_numbers < 6)
        fail(s, s->line, "Hermite's method asks for velocities; expected EphemerisTimePosVel");
    return true;
}

static void take_keyword(stk_reading *s)
{
    static const char *const IDLE[] = {"BlockingFactor", "MessageLevel", "StkMetaData"};
    char *value = s->line + strcspn(s->line, " \t");
    if (*value) *value++ = '\0';
    value += strspn(value, " \t");
    const char *keyword = s->line;
    long samples = s->samples_m1;
    if (same(keyword, "ScenarioEpoch"))
        read_epoch(s, value);
    else if (same(keyword, "CoordinateSystem"))
        read_axes(s, value);
    else if (same(keyword, "CoordinateSystemEpoch"))
        fail(s, keyword, "axes of one epoch are not taken; expected axes of date");
    else if (same(keyword, "InterpolationMethod"))
        read_method(s, value);
    else if (same(keyword, "InterpolationSamplesM1") || same(keyword, "InterpolationOrder"))
        read_whole(s, keyword, value, 1, 15, &samples);
    else if (same(keyword, "NumberOfEphemerisPoints"))
        read_whole(s, keyword, value, 0, 1000000000, &s->announced);
    else if (same(keyword, "DistanceUnit"))
        read_unit(s, value);
    else if (same(keyword, "CentralBody"))
        require_value(s, keyword, value, "Earth");
    else if (same(keyword, "TimeFormat"))
        require_value(s, keyword, value, "EpSec");
    else if (!begin_rows(s, keyword)) {
        for (size_t k = 0; k < sizeof IDLE / sizeof *IDLE; k++)
            if (same(keyword, IDLE[k])) return;
        errors_warn(s->errors, here(s, keyword),
                    "the keyword '%.40s' is not known here and not looked at", keyword);
    }
    s->samples_m1 = (int)samples;
}

/* ------------------------------------------------------------------------ rows */

/* The numbers of a line: how many there are; -1, and an error, where one is none. */
static int take_numbers(stk_reading *s, double *numbers, int most)
{
    int n = 0;
    for (const char *at = s->line; *at; n++) {
        const size_t length = strcspn(at, " \t");
        double number;
        if (!number_read(at, length, &number)) {
            fail(s, at, "'%.*s' stands here; expected a finite number",
                 (int)(length < 40 ? length : 40), at);
            return -1;
        }
        if (n < most) numbers[n] = number;
        at += length + strspn(at + length, " \t");
    }
    return n;
}

static void take_boundary(stk_reading *s)
{
    double t_s;
    if (take_numbers(s, &t_s, 1) != 1) {
        if (!s->worst) fail(s, s->line, "expected one time of a boundary on this line");
        return;
    }
    if (!grow_list(&s->boundaries_s, &s->boundary_capacity, s->n_boundaries + 1,
                   sizeof *s->boundaries_s)) {
        no_memory(s);
        return;
    }
    s->boundaries_s[s->n_boundaries++] = t_s;
}

static table_segment *begin_segment(stk_reading *s)
{
    table_segment *segment = orbit_table_add(s->table);
    if (!segment) {
        no_memory(s);
        return NULL;
    }
    memcpy(segment->frame_name, s->frame_name, sizeof segment->frame_name);
    segment->frame = s->frame;
    segment->method = s->method;
    segment->degree = s->method == TABLE_HERMITE ? 2 * s->samples_m1 + 1 : s->samples_m1;
    segment->has_velocity = s->n_numbers >= 6;
    segment->line = s->number;
    return segment;
}

/* The segment that a row of that time belongs to; NULL when memory is out. A time that stands twice
 * begins a new one, and so does a boundary since the last row; a boundary on the last row makes
 * that row the first of the new segment as well. */
static table_segment *segment_for(stk_reading *s, double t_s)
{
    table_segment *last = s->table->n ? &s->table->segments[s->table->n - 1] : NULL;
    if (!last || t_s == s->last_s) return begin_segment(s);
    for (size_t k = 0; k < s->n_boundaries; k++) {
        const double at_s = s->boundaries_s[k];
        if (at_s < s->last_s || at_s >= t_s || last->n == 1) continue;
        const table_node node = last->nodes[last->n - 1];
        table_segment *next = begin_segment(s);
        if (!next || at_s > s->last_s) return next;
        const double tt_jd[2] = {s->epoch_jd[0], s->epoch_jd[1] + s->last_s / DAY_S};
        if (!orbit_table_add_node(s->table, next, tt_jd, node.r_m, node.v_m_s)) {
            no_memory(s);
            return NULL;
        }
        return next;
    }
    return last;
}

static void take_row(stk_reading *s)
{
    static const double FARTHEST_S = 4e9; /* some 130 years */
    double numbers[1 + MOST_NUMBERS] = {0}, r_m[3], v_m_s[3];
    const int n = take_numbers(s, numbers, 1 + MOST_NUMBERS);
    glint_error error;
    if (n < 0) return;
    if (n != s->n_numbers + 1) {
        fail(s, s->line, "this row has %d numbers; expected %d: a time and %d others", n,
             s->n_numbers + 1, s->n_numbers);
        return;
    }
    s->n++;
    scale3(numbers + 1, s->unit_m, r_m);
    scale3(numbers + 4, s->unit_m, v_m_s); /* zeros where the rows have none */
    if (table_state_check(r_m, v_m_s, s->unit, here(s, s->line), &error)) {
        s->worst = errors_take(s->errors, &error, PLACE_NONE);
        return;
    }
    if (!(fabs(numbers[0]) <= FARTHEST_S)) {
        fail(s, s->line, "the time of this row is %g s; expected at most %g s from ScenarioEpoch",
             numbers[0], FARTHEST_S);
        return;
    }
    if (s->eme2000) table_node_from_eme2000(r_m, v_m_s);
    table_segment *segment = segment_for(s, numbers[0]);
    if (!segment) return;
    const double tt_jd[2] = {s->epoch_jd[0], s->epoch_jd[1] + numbers[0] / DAY_S};
    if (!orbit_table_add_node(s->table, segment, tt_jd, r_m, v_m_s)) no_memory(s);
    s->last_s = numbers[0];
}

/* ------------------------------------------------------------------------ lines */

/* BEGIN and END lines; false for others. */
static bool take_mark(stk_reading *s)
{
    const bool begins = strncasecmp(s->line, "BEGIN", 5) == 0 && strchr(" \t", s->line[5]);
    const bool ends = strncasecmp(s->line, "END", 3) == 0 && strchr(" \t", s->line[3]);
    if (!begins && !ends) return false;
    const char *what = s->line + strcspn(s->line, " \t");
    what += strspn(what, " \t");
    if (same(what, "Ephemeris")) {
        s->begun = s->begun || begins;
        s->ended = ends;
    } else if (same(what, "SegmentBoundaryTimes")) {
        s->part = begins ? PART_BOUNDARIES : PART_HEAD;
    } else {
        s->part = begins ? PART_SKIPPED : PART_HEAD;
    }
    return true;
}

static void take_line(stk_reading *s)
{
    if (take_mark(s)) return;
    if (!s->begun) {
        fail(s, s->line, "'%.40s' stands before BEGIN Ephemeris", s->line);
        return;
    }
    const bool is_word = strchr("+-.0123456789", s->line[0]) == NULL;
    if (s->part == PART_ROWS && is_word && begin_rows(s, s->line)) return;
    if (s->part == PART_HEAD)
        take_keyword(s);
    else if (s->part == PART_BOUNDARIES)
        take_boundary(s);
    else if (s->part == PART_ROWS)
        take_row(s);
}

static void finish(stk_reading *s)
{
    s->line = NULL;
    const place end = {s->table->path, s->number, 0};
    glint_status status = GLINT_OK;
    if (!s->ended)
        status = errors_add(s->errors, GLINT_INPUT, end,
                            "the file ends without END Ephemeris: it is cut off; get it again");
    else if (s->announced >= 0 && s->n != s->announced && !s->worst)
        status = errors_add(s->errors, GLINT_INPUT, end,
                            "NumberOfEphemerisPoints is %ld, and the file has %ld rows: it is "
                            "damaged; get it again",
                            s->announced, s->n);
    else if (!s->worst)
        status = orbit_table_finish(s->table, s->errors);
    if (status) s->worst = status;
}

static void take_file(stk_reading *s, char *at)
{
    if (strncmp(at, "\xEF\xBB\xBF", 3) == 0) at += 3;
    bool versioned = false;
    while (*at && !s->ended && s->worst != GLINT_INTERNAL) {
        char *line = at, *end = line + strcspn(line, "\n");
        at = *end ? end + 1 : end;
        while (end > line && strchr(" \t\r", end[-1]))
            end--;
        *end = '\0';
        s->number++;
        s->line = line + strspn(line, " \t");
        s->column = (int)(s->line - line) + 1;
        if (!s->line[0] || s->line[0] == '#') continue;
        if (versioned) {
            take_line(s);
        } else if (strncasecmp(s->line, "stk.v.", 6) == 0) {
            versioned = true;
        } else {
            fail(s, s->line, "this is no file of STK: it begins with '%.40s'; expected stk.v.",
                 s->line);
            return;
        }
    }
    finish(s);
}

glint_status stk_read(const char *path, place asked_from, orbit_table **out, glint_errors *errors)
{
    *out = NULL;
    char *bytes;
    size_t size;
    glint_error error;
    if (file_read(path, &bytes, &size, asked_from, &error))
        return errors_take(errors, &error, asked_from);
    stk_reading s = {.table = orbit_table_new(path, "STK"),
                     .errors = errors,
                     .unit_m = 1.0,
                     .unit = "m",
                     .method = TABLE_LAGRANGE,
                     .samples_m1 = DEFAULT_SAMPLES_M1,
                     .announced = -1};
    if (!s.table)
        no_memory(&s);
    else if (memchr(bytes, '\0', size))
        s.worst = errors_add(errors, GLINT_INPUT, (place){path, 0, 0},
                             "this is not a text file; expected an ephemeris file of STK");
    else
        take_file(&s, bytes);
    free(s.boundaries_s);
    free(bytes);
    if (s.worst)
        orbit_table_free(s.table);
    else
        *out = s.table;
    return s.worst;
}
