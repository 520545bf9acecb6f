#include "scenario/observed_file.h"

#include "base/constants.h"
#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const observed_column_names[OBSERVED_COLUMNS] = {
    [OBSERVED_UTC] = "utc",         [OBSERVED_JD] = "jd",
    [OBSERVED_MJD] = "mjd",         [OBSERVED_MAGNITUDE] = "magnitude",
    [OBSERVED_SIGMA] = "sigma",     [OBSERVED_RANGE] = "range_km",
    [OBSERVED_PHASE] = "phase_deg", [OBSERVED_FILTER] = "filter"};

/* What numbers may be: slips of units and columns end here. */
static const double MOST_MAG = 60, MOST_SIGMA = 60, MOST_KM = 1e9, MOST_DEG = 180;

static bool same_word(const char *a, const char *b)
{
    for (; *a && *b; a++, b++)
        if ((*a | 0x20) != (*b | 0x20)) return false;
    return *a == *b;
}

/* A number of a file in a range. */
static glint_status read_number(const char *word, place where, const char *what, double least,
                                double most, double *out, glint_errors *errors)
{
    if (!number_read(word, strlen(word), out))
        return errors_add(errors, GLINT_INPUT, where, "the %s is '%.40s'; expected a number", what,
                          word);
    if (*out >= least && *out <= most) return GLINT_OK;
    return errors_add(errors, GLINT_INPUT, where, "the %s is %.40s; expected %g to %g", what, word,
                      least, most);
}

/* A Julian date of UTC in two parts, so that no digit is lost: whole days, and the rest of them. */
static glint_status read_julian(const char *word, double zero_jd, place where, double tt_jd[2],
                                glint_errors *errors)
{
    static const double FIRST_JD = 2441317.5, LAST_JD = 2488434.5; /* 1972 to 2101: utc_check */
    const char *point = strchr(word, '.');
    const size_t n = point ? (size_t)(point - word) : strlen(word);
    double whole = 0, rest = 0;
    const bool digits = n > 0 && strspn(word, "0123456789") == n &&
                        (!point || strspn(point + 1, "0123456789") == strlen(point + 1));
    if (!digits || !number_read(word, n, &whole) ||
        (point && point[1] && !number_read(point, strlen(point), &rest)))
        return errors_add(errors, GLINT_INPUT, where,
                          "the date is '%.40s'; expected a number of days such as %.1f", word,
                          2460000.5 - zero_jd);
    if (zero_jd + whole < FIRST_JD || zero_jd + whole > LAST_JD)
        return errors_add(errors, GLINT_INPUT, where,
                          "the date %.40s is not in the years 1972 to 2100; expected %s", word,
                          zero_jd > 0 ? "a modified Julian date, as 60000.25"
                                      : "a Julian date, as 2460000.75");
    const double utc_jd[2] = {zero_jd + whole, rest};
    utc_jd_to_tt(utc_jd, tt_jd, NULL);
    return GLINT_OK;
}

static glint_status read_time(int kind, const char *word, place where, double tt_jd[2],
                              glint_errors *errors)
{
    static const double MJD_ZERO_JD = 2400000.5;
    glint_error error;
    if (kind != OBSERVED_UTC)
        return read_julian(word, kind == OBSERVED_MJD ? MJD_ZERO_JD : 0, where, tt_jd, errors);
    const glint_status status = time_parse(word, SCALE_UTC, where, tt_jd, &error);
    return status ? errors_take(errors, &error, where) : GLINT_OK;
}

/* True, and counted, when a row's filter is not the one that is asked for. */
static bool is_other_filter(const observed_wanted *wanted, const char *filter, observed_track *out)
{
    if (!wanted->filter || same_word(filter, wanted->filter)) return false;
    if (out->other_filter++ == 0) snprintf(out->a_filter, sizeof out->a_filter, "%s", filter);
    return true;
}

/* Keeps a row, or counts why not. `out->rows` has room. */
static void keep(const observed_wanted *wanted, const double tt_jd[2], observed_row row,
                 observed_track *out)
{
    static const double SLACK_S = 1e-6; /* dates come out to 1e-11 s */
    row.t_s = jd_difference_s(tt_jd, wanted->clock->tt_jd);
    const bool is_first = out->n == 0 && out->outside_time == 0;
    out->from_s = is_first ? row.t_s : fmin(out->from_s, row.t_s);
    out->to_s = is_first ? row.t_s : fmax(out->to_s, row.t_s);
    if (row.t_s < -SLACK_S || row.t_s > wanted->span_s + SLACK_S) {
        out->outside_time++;
        return;
    }
    row.t_s = fmin(fmax(row.t_s, 0), wanted->span_s);
    out->rows[out->n++] = row;
}

/* ---------------------------------------------------------------------- CSV */

/* Finds one column by the name that was asked for, or by its own; -1 where there is none. */
static glint_status find_column(const observed_wanted *wanted, const csv_table *csv, int which,
                                int *column, glint_errors *errors)
{
    const char *asked = wanted->columns[which];
    *column = csv_column(csv, asked ? asked : observed_column_names[which]);
    if (*column >= 0 || !asked || wanted->is_template) return GLINT_OK;
    const char **names = calloc((size_t)csv->n_columns + 1, sizeof *names);
    for (int k = 0; names && k < csv->n_columns; k++)
        names[k] = csv->cells[k].text;
    const char *near = names ? nearest_name(asked, names, (size_t)csv->n_columns) : NULL;
    errors_add(errors, GLINT_INPUT, wanted->column_places[which], "%s has no column '%.60s'%s%s%s",
               csv->path, asked, near ? "; did you mean '" : "", near ? near : "",
               near ? "'?" : "");
    free(names);
    return GLINT_INPUT;
}

/* The columns of a template that a comparison cannot be without. */
static glint_status check_template(const observed_wanted *wanted, place header,
                                   const int column[OBSERVED_COLUMNS], glint_errors *errors)
{
    const int needed[] = {OBSERVED_UTC, OBSERVED_MAGNITUDE, OBSERVED_FILTER};
    const int n = wanted->filter ? 3 : 2; /* the filter where rows are chosen by it */
    glint_status status = GLINT_OK;
    for (int k = 0; k < n; k++)
        if (column[needed[k]] < 0)
            status = errors_add(errors, GLINT_INPUT, header,
                                "the file has no column '%s'; expected the columns of SCORE's "
                                "template, or another 'format' in [observed]",
                                wanted->columns[needed[k]]);
    return status;
}

static glint_status find_columns(const observed_wanted *wanted, const csv_table *csv,
                                 int column[OBSERVED_COLUMNS], int *time, glint_errors *errors)
{
    glint_status status = GLINT_OK;
    int n_times = 0;
    *time = -1;
    for (int k = 0; k < OBSERVED_COLUMNS; k++)
        if (find_column(wanted, csv, k, &column[k], errors)) status = GLINT_INPUT;
    bool asked = false;
    for (int k = 0; k < OBSERVED_TIMES; k++)
        asked = asked || wanted->columns[k];
    for (int k = 0; k < OBSERVED_TIMES; k++) {
        if (column[k] < 0 || (asked && !wanted->columns[k])) continue;
        n_times++;
        *time = k;
    }
    if (status) return status;
    const place header = csv_place(csv, &csv->cells[0]);
    if (wanted->is_template) return check_template(wanted, header, column, errors);
    if (n_times != 1)
        status = errors_add(errors, GLINT_INPUT, header,
                            "the file has %s of the columns utc, jd and mjd; expected one of them, "
                            "or columns = { utc = \"NAME\", ... } in [observed]",
                            n_times ? "several" : "none");
    if (!status && column[OBSERVED_MAGNITUDE] < 0)
        status = errors_add(errors, GLINT_INPUT, header,
                            "the file has no column 'magnitude'; expected one, or columns = "
                            "{ magnitude = \"NAME\", ... } in [observed]");
    if (!status && wanted->filter && column[OBSERVED_FILTER] < 0)
        status = errors_add(errors, GLINT_INPUT, header,
                            "rows of filter '%.40s' are asked for and the file has no column "
                            "'filter'; expected one, or columns = { filter = \"NAME\", ... }",
                            wanted->filter);
    return status;
}

/* A number that may be absent; *out is left alone then. */
static glint_status read_optional(const csv_table *csv, long row, int column, const char *what,
                                  double least, double most, double *out, glint_errors *errors)
{
    if (column < 0) return GLINT_OK;
    const csv_cell *cell = csv_at(csv, row, column);
    if (!cell->text[0]) return GLINT_OK;
    return read_number(cell->text, csv_place(csv, cell), what, least, most, out, errors);
}

static glint_status read_csv_row(const observed_wanted *wanted, const csv_table *csv, long row,
                                 const int column[OBSERVED_COLUMNS], int time, observed_track *out,
                                 glint_errors *errors)
{
    if (wanted->filter &&
        is_other_filter(wanted, csv_at(csv, row, column[OBSERVED_FILTER])->text, out))
        return GLINT_OK;
    const csv_cell *when = csv_at(csv, row, column[time]);
    const csv_cell *magnitude = csv_at(csv, row, column[OBSERVED_MAGNITUDE]);
    observed_row o = {.line = when->line, .phase = -1};
    double tt_jd[2], km = 0, deg = -1;
    glint_status status = read_time(time, when->text, csv_place(csv, when), tt_jd, errors);
    if (magnitude->text[0] && read_number(magnitude->text, csv_place(csv, magnitude), "magnitude",
                                          -MOST_MAG, MOST_MAG, &o.magnitude, errors))
        status = GLINT_INPUT;
    if (read_optional(csv, row, column[OBSERVED_SIGMA], "standard deviation", 0, MOST_SIGMA,
                      &o.sigma, errors) ||
        read_optional(csv, row, column[OBSERVED_RANGE], "range, km,", 1e-3, MOST_KM, &km, errors) ||
        read_optional(csv, row, column[OBSERVED_PHASE], "phase angle, deg,", 0, MOST_DEG, &deg,
                      errors))
        status = GLINT_INPUT;
    const csv_cell *sigma =
        column[OBSERVED_SIGMA] < 0 ? NULL : csv_at(csv, row, column[OBSERVED_SIGMA]);
    if (!status && sigma && sigma->text[0] && o.sigma == 0 && !wanted->is_template)
        status = errors_add(errors, GLINT_INPUT, csv_place(csv, sigma),
                            "the standard deviation is 0; expected more, or an empty cell");
    if (status) return status;
    o.range_m = km * 1e3;
    o.phase = deg < 0 ? -1 : deg * DEG;
    if (magnitude->text[0])
        keep(wanted, tt_jd, o, out);
    else
        out->without_magnitude++;
    return GLINT_OK;
}

glint_status observed_read_csv(const observed_wanted *wanted, observed_track *out,
                               glint_errors *errors)
{
    csv_table csv;
    int column[OBSERVED_COLUMNS], time;
    glint_status status = csv_read(wanted->path, wanted->asked_from, &csv, errors);
    if (status) return status;
    csv_leave_out_cut_row(&csv, errors);
    status = find_columns(wanted, &csv, column, &time, errors);
    out->rows = calloc((size_t)csv.n_rows + 1, sizeof *out->rows);
    if (!out->rows) status = errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    const bool found = !status;
    for (long row = 0; found && row < csv.n_rows; row++)
        if (read_csv_row(wanted, &csv, row, column, time, out, errors)) status = GLINT_INPUT;
    csv_free(&csv);
    return status;
}

/* ---------------------------------------------------------------------- MMT */

enum {
    MMT_DATE,
    MMT_TIME,
    MMT_STD_MAG,
    MMT_MAG,
    MMT_FILTER,
    MMT_PENUMBRA,
    MMT_DISTANCE,
    MMT_PHASE,
    MMT_CHANNEL,
    MMT_TRACK,
    MMT_WORDS
};

static const char *const MMT_NAMES[MMT_WORDS] = {
    "Date", "Time", "StdMag", "Mag", "Filter", "Penumbra", "Distance", "Phase", "Channel", "Track"};

/* A line cut into words, in place. */
typedef struct mmt_line {
    int line, n; /* of words: more than MMT_WORDS are counted, not kept */
    char *words[MMT_WORDS];
    int columns[MMT_WORDS];
} mmt_line;

static void cut_words(char *bytes, mmt_line *out)
{
    static const char BLANKS[] = " \t\r";
    char *at = bytes;
    out->n = 0;
    for (;;) {
        at += strspn(at, BLANKS);
        if (!*at) return;
        if (out->n < MMT_WORDS) {
            out->words[out->n] = at;
            out->columns[out->n] = (int)(at - bytes) + 1;
        }
        out->n++;
        at += strcspn(at, BLANKS);
        if (*at) *at++ = '\0';
    }
}

/* A comment that names columns must name these: "# Date Time StdMag ...", with units or without. */
static glint_status check_names(const observed_wanted *wanted, mmt_line *line, glint_errors *errors)
{
    for (int k = 0; k < line->n; k++) {
        if (k < MMT_WORDS) line->words[k][strcspn(line->words[k], "([,")] = '\0';
        if (k >= MMT_WORDS || !same_word(line->words[k], MMT_NAMES[k]))
            return errors_add(
                errors, GLINT_INPUT,
                (place){wanted->path, line->line, k < MMT_WORDS ? line->columns[k] : 0},
                "column %d of the track is '%.40s'; expected %s", k + 1,
                k < MMT_WORDS ? line->words[k] : "another",
                k < MMT_WORDS ? MMT_NAMES[k] : "nine or ten columns");
    }
    return GLINT_OK;
}

static place mmt_place(const observed_wanted *wanted, const mmt_line *line, int word)
{
    return (place){wanted->path, line->line, line->columns[word]};
}

static glint_status read_mmt_row(const observed_wanted *wanted, const mmt_line *line,
                                 observed_track *out, glint_errors *errors)
{
    if (line->n != MMT_WORDS && line->n != MMT_WORDS - 1)
        return errors_add(
            errors, GLINT_INPUT, (place){wanted->path, line->line, 1},
            "the line has %d word%s; expected nine or ten: Date Time StdMag Mag Filter "
            "Penumbra Distance Phase Channel and perhaps Track",
            line->n, line->n == 1 ? "" : "s");
    char when[64];
    double tt_jd[2], km, deg, magnitude;
    snprintf(when, sizeof when, "%.30sT%.30s", line->words[MMT_DATE], line->words[MMT_TIME]);
    glint_status status =
        read_time(OBSERVED_UTC, when, mmt_place(wanted, line, MMT_DATE), tt_jd, errors);
    const int column = wanted->standard ? MMT_STD_MAG : MMT_MAG;
    const struct {
        int word;
        const char *what;
        double least, most, *to;
    } numbers[] = {{column, "magnitude", -MOST_MAG, MOST_MAG, &magnitude},
                   {MMT_DISTANCE, "distance, km,", 1e-3, MOST_KM, &km},
                   {MMT_PHASE, "phase angle, deg,", 0, MOST_DEG, &deg}};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        if (read_number(line->words[numbers[k].word], mmt_place(wanted, line, numbers[k].word),
                        numbers[k].what, numbers[k].least, numbers[k].most, numbers[k].to, errors))
            status = GLINT_INPUT;
    if (status) return status;
    const observed_row row = {
        .line = line->line, .magnitude = magnitude, .range_m = km * 1e3, .phase = deg * DEG};
    if (!is_other_filter(wanted, line->words[MMT_FILTER], out)) keep(wanted, tt_jd, row, out);
    return GLINT_OK;
}

/* One line of the file, without its end. */
static glint_status read_mmt_line(const observed_wanted *wanted, char *bytes, int number,
                                  observed_track *out, glint_errors *errors)
{
    mmt_line line = {.line = number};
    const bool comment = bytes[strspn(bytes, " \t")] == '#';
    if (comment) *strchr(bytes, '#') = ' ';
    cut_words(bytes, &line);
    if (line.n == 0) return GLINT_OK;
    if (!comment) return read_mmt_row(wanted, &line, out, errors);
    const bool names = line.n > 2 && strncmp(line.words[0], "Date", 4) == 0;
    return names ? check_names(wanted, &line, errors) : GLINT_OK;
}

glint_status observed_read_mmt(const observed_wanted *wanted, observed_track *out,
                               glint_errors *errors)
{
    char *bytes;
    size_t size;
    glint_error error;
    if (file_read(wanted->path, &bytes, &size, wanted->asked_from, &error))
        return errors_take(errors, &error, wanted->asked_from);
    size_t n_lines = 1;
    for (size_t k = 0; k < size; k++)
        n_lines += bytes[k] == '\n';
    glint_status status = GLINT_OK;
    out->rows = calloc(n_lines, sizeof *out->rows);
    if (!out->rows) status = errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    int number = 1;
    for (char *at = bytes; out->rows && at < bytes + size; number++) {
        char *end = memchr(at, '\n', (size_t)(bytes + size - at));
        if (!end) {
            if (at[strspn(at, " \t\r")] && *at != '#')
                errors_warn(errors, (place){wanted->path, number, 0},
                            "the last line has no line end and may be cut: it is left out; end it "
                            "with a line break if it is whole");
            break;
        }
        *end = '\0';
        if (strlen(at) != (size_t)(end - at))
            status = errors_add(errors, GLINT_INPUT, (place){wanted->path, number, 0},
                                "the line has a zero byte; expected text");
        else if (read_mmt_line(wanted, at, number, out, errors))
            status = GLINT_INPUT;
        at = end + 1;
    }
    free(bytes);
    return status;
}
