/* attitude_stk.c: attitude files of STK (.a): a heading of keywords, then rows of seconds from an
 * epoch and a quaternion, whose numbers are those of q with v_axes = q v_body q*. */
#include "base/text.h"
#include "base/vec.h"
#include "orbit/attitude_table_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Forms of the rows: the numbers after the time, and the first of which is the scalar. */
typedef struct stk_form {
    const char *name;
    int n_numbers, scalar;
} stk_form;
static const stk_form forms[] = {
    {"AttitudeTimeQuaternions", 4, 3},
    {"AttitudeTimeQuatScalarFirst", 4, 0},
    {"AttitudeTimeQuatAngVels", 7, 3},
};
enum { N_FORMS = sizeof forms / sizeof *forms, MOST_NUMBERS = 7 };

/* Keywords that have no weight here: the way between rows is always the shortest one. */
static const char *const idle_words[] = {"InterpolationOrder", "InterpolationMethod",
                                         "BlockingFactor", "MessageLevel"};

typedef struct stk_reading {
    attitude_reading *r;
    char *line; /* the current one, terminated, blanks taken off */
    int number; /* of the current line */
    int column; /* where it begins */
    bool begun, ended, has_epoch, has_axes;
    double epoch_s; /* TT s from the start of the run */
    file_frame frame;
    const stk_form *form; /* of the rows; NULL before them */
    long announced;       /* NumberOfAttitudePoints; -1 where not said */
    long n;               /* rows */
} stk_reading;

static place here(const stk_reading *s, const char *at)
{
    return (place){s->r->table->path, s->number, s->column + (int)(at - s->line)};
}

/* The next word of the line: its length through *n, 0 at the end. */
static const char *next_word(const char **at, size_t *n)
{
    const char *word = *at + strspn(*at, " \t");
    *n = strcspn(word, " \t");
    *at = word + *n;
    return word;
}

static bool is_word(const char *word, size_t n, const char *wanted)
{
    return n == strlen(wanted) && strncasecmp(word, wanted, n) == 0;
}

/* "1 Jan 2024 12:00:00.000000000": UTC. */
static void read_epoch(stk_reading *s, const char *value)
{
    static const char months[] = "janfebmaraprmayjunjulaugsepoctnovdec";
    int day, year, used = 0;
    char month[4], clock[32], iso[64];
    double tt_jd[2];
    glint_error error;
    const bool good =
        sscanf(value, "%2d %3[A-Za-z] %4d %31s%n", &day, month, &year, clock, &used) == 4 &&
        value[used] == '\0' && strlen(month) == 3 && day > 0 && year > 0;
    int k = 0;
    while (good && k < 12 && strncasecmp(months + 3 * k, month, 3) != 0)
        k++;
    if (!good || k == 12) {
        attitude_table_fail(s->r, here(s, value),
                            "ScenarioEpoch is '%.40s'; expected a UTC time such as 1 Jan 2024 "
                            "12:00:00.000",
                            value);
        return;
    }
    snprintf(iso, sizeof iso, "%04d-%02d-%02dT%s", year, k + 1, day, clock);
    if (time_parse(iso, SCALE_UTC, here(s, value), tt_jd, &error)) {
        s->r->status = errors_take(s->r->errors, &error, here(s, value));
        return;
    }
    s->epoch_s = jd_difference_s(tt_jd, s->r->clock->tt_jd);
    s->has_epoch = true;
}

static void read_axes(stk_reading *s, const char *value)
{
    static const struct {
        const char *name;
        file_frame frame;
    } axes[] = {{"ICRF", FILE_GCRS},
                {"Inertial", FILE_GCRS},
                {"J2000", FILE_EME2000},
                {"TEMEOfDate", FILE_TEME},
                {"Fixed", FILE_ITRS}};
    for (size_t k = 0; k < sizeof axes / sizeof *axes; k++)
        if (strcasecmp(value, axes[k].name) == 0) {
            s->frame = axes[k].frame;
            s->has_axes = true;
            return;
        }
    attitude_table_fail(
        s->r, here(s, value),
        "CoordinateAxes is '%.40s'; expected ICRF, Inertial, J2000, TEMEOfDate or Fixed", value);
}

static void read_count(stk_reading *s, const char *value)
{
    double n;
    if (number_read(value, strlen(value), &n) && n >= 0 && n <= 1e9 && n == (double)(long)n)
        s->announced = (long)n;
    else
        attitude_table_fail(s->r, here(s, value),
                            "NumberOfAttitudePoints is '%.40s'; expected a whole number", value);
}

/* A line that begins the rows of one form or another. True when it is one. */
static bool begin_rows(stk_reading *s, const char *word, size_t n)
{
    for (int k = 0; k < N_FORMS; k++)
        if (is_word(word, n, forms[k].name)) s->form = &forms[k];
    if (!s->form) {
        if (n < 12 || strncasecmp(word, "AttitudeTime", 12) != 0) return false;
        attitude_table_fail(s->r, here(s, word),
                            "rows of the form %.*s are not read; expected AttitudeTimeQuaternions, "
                            "AttitudeTimeQuatScalarFirst or AttitudeTimeQuatAngVels",
                            (int)(n < 60 ? n : 60), word);
        s->ended = true; /* nothing after this can be read */
        return true;
    }
    if (!s->has_epoch)
        attitude_table_fail(s->r, here(s, word), "the rows begin, and there was no ScenarioEpoch");
    if (!s->has_axes)
        attitude_table_fail(s->r, here(s, word), "the rows begin, and there was no CoordinateAxes");
    attitude_table_begin_span(s->r, s->frame, here(s, word));
    return true;
}

static void take_keyword(stk_reading *s)
{
    const char *at = s->line;
    size_t n;
    const char *word = next_word(&at, &n), *value = at + strspn(at, " \t");
    if (is_word(word, n, "ScenarioEpoch"))
        read_epoch(s, value);
    else if (is_word(word, n, "CoordinateAxes"))
        read_axes(s, value);
    else if (is_word(word, n, "NumberOfAttitudePoints"))
        read_count(s, value);
    else if (is_word(word, n, "CentralBody")) {
        if (strcasecmp(value, "Earth") != 0)
            attitude_table_fail(s->r, here(s, value), "CentralBody is '%.40s'; expected Earth",
                                value);
    } else if (!begin_rows(s, word, n)) {
        for (size_t k = 0; k < sizeof idle_words / sizeof *idle_words; k++)
            if (is_word(word, n, idle_words[k])) return;
        attitude_table_fail(
            s->r, here(s, word),
            "'%.*s' is not a keyword that is read here; expected ScenarioEpoch, "
            "CentralBody, CoordinateAxes, NumberOfAttitudePoints, Interpolation..., or one "
            "of the forms of rows",
            (int)(n < 40 ? n : 40), word);
    }
}

static void take_row(stk_reading *s)
{
    double t_s = 0, numbers[MOST_NUMBERS] = {0};
    const char *at = s->line, *word;
    size_t n;
    int count = 0;
    for (; (word = next_word(&at, &n)) && n > 0; count++) {
        double *out = count == 0 ? &t_s : &numbers[count - 1];
        if (count > s->form->n_numbers) continue;
        if (!number_read(word, n, out)) {
            attitude_table_fail(s->r, here(s, word), "'%.*s' stands here; expected a finite number",
                                (int)(n < 40 ? n : 40), word);
            return;
        }
    }
    if (count != s->form->n_numbers + 1) {
        attitude_table_fail(s->r, here(s, s->line),
                            "this row has %d numbers; expected %d: a time and those of %s", count,
                            s->form->n_numbers + 1, s->form->name);
        return;
    }
    const int first = s->form->scalar == 0 ? 1 : 0;
    const double q[4] = {numbers[s->form->scalar], numbers[first], numbers[first + 1],
                         numbers[first + 2]};
    attitude_table_add_row(s->r, s->epoch_s + t_s, q, here(s, s->line));
    s->n++;
}

static void take_line(stk_reading *s)
{
    const char *at = s->line;
    size_t n, m;
    const char *word = next_word(&at, &n), *next = next_word(&at, &m);
    if (is_word(word, n, "BEGIN") && is_word(next, m, "Attitude"))
        s->begun = true;
    else if (is_word(word, n, "END") && is_word(next, m, "Attitude"))
        s->ended = true;
    else if (!s->begun)
        attitude_table_fail(s->r, here(s, word), "'%.40s' stands before BEGIN Attitude", s->line);
    else if (s->form)
        take_row(s);
    else
        take_keyword(s);
}

/* What can be said only when the whole file has been read. */
static void finish(stk_reading *s)
{
    const place end = {s->r->table->path, s->number, 0};
    if (!s->ended)
        attitude_table_fail(s->r, end,
                            "the file ends without its END Attitude: it is cut off; get it again");
    else if (!s->form && !s->r->status)
        attitude_table_fail(s->r, end,
                            "there are no rows of attitudes; expected AttitudeTimeQuaternions");
    else if (s->announced >= 0 && s->n != s->announced && !s->r->status)
        attitude_table_fail(
            s->r, end,
            "NumberOfAttitudePoints is %ld, and the file has %ld rows: it is damaged; get "
            "it again",
            s->announced, s->n);
    if (s->form) attitude_table_end_span(s->r, -INFINITY, INFINITY);
}

void attitude_stk_read(attitude_reading *r, char *bytes, size_t size)
{
    stk_reading s = {.r = r, .announced = -1};
    if (memchr(bytes, '\0', size)) {
        attitude_table_fail(r, (place){r->table->path, 0, 0},
                            "this is not a text file; expected an attitude file of STK");
        free(bytes);
        return;
    }
    char *at = bytes + (strncmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0);
    bool versioned = false;
    while (*at && !s.ended && r->status != GLINT_INTERNAL) {
        char *line = at, *end = line + strcspn(line, "\n");
        at = *end ? end + 1 : end;
        while (end > line && strchr(" \t\r\n", end[-1]))
            end--;
        *end = '\0';
        s.number++;
        s.line = line + strspn(line, " \t");
        s.column = (int)(s.line - line) + 1;
        if (!s.line[0] || s.line[0] == '#') continue;
        if (versioned) take_line(&s);
        versioned = true; /* the first line is stk.v.N: that is how the file was known */
    }
    finish(&s);
    free(bytes);
}
