/* measured.c: reads files of measured BRDF values. */
#include "brdf/measured.h"

#include "base/angle.h"
#include "base/constants.h"
#include "base/grow.h"
#include "base/text.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_COLUMNS = 256 };

/* Azimuths err by the last digit that is written: 1e-6 rad is 0.2 arcsec, finer than any mount. */
static const double IN_PLANE = 1e-6;
/* How far past 90 deg an angle may lie that was rounded when it was turned into rad; rad. */
static const double PAST_HORIZON = 1e-8;

static const char *const names[MEASURED_COLUMNS] = {"theta_i", "phi_i", "theta_r", "phi_r", "f"};

/* A piece of the file, not terminated. */
typedef struct cell {
    const char *text;
    size_t length;
    int column; /* from 1 */
} cell;

/* The cells of one line; line 0: there is none. */
typedef struct cells {
    cell at[MOST_COLUMNS];
    int n, line;
} cells;

/* One line of the file without its end. */
typedef struct line {
    const char *start, *end;
    int number; /* from 1 */
} line;

typedef struct reader {
    const char *path;
    place asked_from;
    const measured_format *format;
    measured *out;
    int capacity; /* points */
    glint_errors *errors;
    glint_status status;              /* the worst so far */
    line comment;                     /* the last one so far */
    cells header, row;                /* the row that is being read */
    bool knows_columns;               /* once the first row is there */
    int n_cells;                      /* of every row */
    int index[MEASURED_COLUMNS];      /* cell of each quantity, -1 for none */
    double most_zenith, most_azimuth; /* largest angles without their signs, in the file's unit */
    place most_zenith_at;
} reader;

const char *measured_name(int quantity)
{
    return names[quantity];
}

/* ------------------------------------------------------------------ lines and cells */

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static const char *skip_blanks(const char *at, const char *end)
{
    while (at < end && is_blank(*at))
        at++;
    return at;
}

static bool is_comment(const char *at, const char *end)
{
    if (at >= end) return false;
    return strchr("#%!", *at) || (*at == '/' && at + 1 < end && at[1] == '/');
}

/* What parts the cells of a line; ' ' stands for any run of blanks and tabs. */
static char find_separator(const line *l)
{
    const size_t n = (size_t)(l->end - l->start);
    return memchr(l->start, ';', n) ? ';' : memchr(l->start, ',', n) ? ',' : ' ';
}

/* A cell from `start` to `end` without the blanks and one pair of quotes around it. */
static cell make_cell(const line *l, const char *start, const char *end)
{
    start = skip_blanks(start, end);
    while (end > start && is_blank(end[-1]))
        end--;
    const int column = (int)(start - l->start) + 1;
    if (end - start >= 2 && *start == '"' && end[-1] == '"') start++, end--;
    return (cell){start, (size_t)(end - start), column};
}

/* Parts a line into cells, from `at` on; false when there are too many. A separator at the end of
 * the line starts no cell. */
static bool split(const line *l, const char *at, cells *out)
{
    const char separator = find_separator(l);
    out->n = 0;
    out->line = l->number;
    for (at = skip_blanks(at, l->end); at < l->end; at = skip_blanks(at, l->end)) {
        const char *stop = at;
        while (stop < l->end && !(separator == ' ' ? is_blank(*stop) : *stop == separator))
            stop++;
        if (out->n == MOST_COLUMNS) return false;
        out->at[out->n++] = make_cell(l, at, stop);
        at = stop < l->end ? stop + 1 : stop;
    }
    return true;
}

static bool holds_a_number(const cells *c)
{
    double value;
    for (int k = 0; k < c->n; k++)
        if (number_read(c->at[k].text, c->at[k].length, &value)) return true;
    return false;
}

static void fail(reader *r, glint_status status)
{
    if (status > r->status) r->status = status;
}

/* ------------------------------------------------------------------ which column is which */

/* The comment that stands before the first row, as a header, where it looks like one. */
static void take_comment_as_header(reader *r)
{
    if (r->header.line || !r->comment.number) return;
    const char *at = r->comment.start;
    while (at < r->comment.end && (is_blank(*at) || strchr("#%!/", *at)))
        at++;
    cells words;
    if (split(&r->comment, at, &words) && words.n == r->n_cells && !holds_a_number(&words))
        r->header = words;
}

static int find_name(const cells *header, const char *name)
{
    const size_t length = strlen(name);
    for (int k = 0; k < header->n; k++)
        if (header->at[k].length == length && memcmp(header->at[k].text, name, length) == 0)
            return k;
    return -1;
}

static bool has_no_columns(const measured_format *format)
{
    for (int q = 0; q < MEASURED_COLUMNS; q++)
        if (format->column[q].name || format->column[q].number) return false;
    return true;
}

/* Whether a column of that name is wanted for some quantity. */
static bool is_wanted(const measured_format *format, const char *name)
{
    const bool usual = has_no_columns(format);
    for (int q = 0; q < MEASURED_COLUMNS; q++) {
        const char *wanted = usual ? names[q] : format->column[q].name;
        if (wanted && string_equal(wanted, name)) return true;
    }
    return false;
}

/* The columns of the header that have no use yet, as terminated names in *all, which they borrow.
 */
static size_t unused_names(const reader *r, text *all, const char *out[MOST_COLUMNS])
{
    size_t n = 0;
    for (int k = 0; k < r->header.n; k++) {
        text_append(all, r->header.at[k].text, r->header.at[k].length);
        text_char(all, '\0');
    }
    const char *at = all->failed ? NULL : all->data;
    for (int k = 0; at && k < r->header.n; k++, at += strlen(at) + 1)
        if (!is_wanted(r->format, at)) out[n++] = at;
    return n;
}

/* Says that there is no column of that name, and which there are. */
static void fail_name(reader *r, const char *name, place where)
{
    if (!r->header.line) {
        fail(r, errors_add(r->errors, GLINT_INPUT, where,
                           "'%s' has no header line that names its columns; expected the number of "
                           "the column in place of '%.60s'",
                           r->path, name));
        return;
    }
    text list = {0}, all = {0};
    const char *unused[MOST_COLUMNS];
    const size_t n_unused = unused_names(r, &all, unused);
    const char *near = nearest_name(name, unused, n_unused);
    for (int k = 0; k < r->header.n; k++) {
        text_add(&list, k ? ", " : "");
        text_append(&list, r->header.at[k].text, r->header.at[k].length);
    }
    fail(r, errors_add(r->errors, GLINT_INPUT, where,
                       "'%s' has no column '%.60s'%s%.60s%s; it has: %.600s", r->path, name,
                       near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "",
                       list.data ? list.data : ""));
    text_free(&list);
    text_free(&all);
}

static bool may_be_absent(int quantity)
{
    return quantity == MEASURED_PHI_I || quantity == MEASURED_PHI_R;
}

/* The cell of a quantity; -1 where there is none, which is an error unless it may be absent. */
static int find_column(reader *r, int quantity)
{
    const measured_column *c = &r->format->column[quantity];
    const place where = c->where.file ? c->where : r->asked_from;
    if (has_no_columns(r->format)) {
        const int found = find_name(&r->header, names[quantity]);
        if (found < 0 && !may_be_absent(quantity)) fail_name(r, names[quantity], where);
        return found;
    }
    if (c->name) {
        const int found = find_name(&r->header, c->name);
        if (found < 0) fail_name(r, c->name, where);
        return found;
    }
    if (c->number < 0 || c->number > r->n_cells)
        fail(r, errors_add(r->errors, GLINT_INPUT, where,
                           "column %d for %s is not in '%s'; its rows have %d cells", c->number,
                           names[quantity], r->path, r->n_cells));
    else if (c->number == 0 && !may_be_absent(quantity))
        fail(r,
             errors_add(r->errors, GLINT_INPUT, where,
                        "no column is given for %s; expected its name or number", names[quantity]));
    return c->number - 1;
}

/* Finds the columns when the first row is there. */
static void find_columns(reader *r)
{
    r->knows_columns = true;
    r->n_cells = r->row.n;
    take_comment_as_header(r);
    if (r->header.line && r->header.n != r->n_cells) {
        fail(r, errors_add(r->errors, GLINT_INPUT, (place){r->path, r->row.line, 1},
                           "this row has %d cells; expected %d, as in the header", r->n_cells,
                           r->header.n));
        return;
    }
    for (int q = 0; q < MEASURED_COLUMNS; q++) {
        r->index[q] = find_column(r, q);
        for (int p = 0; p < q; p++)
            if (r->index[q] >= 0 && r->index[q] == r->index[p])
                fail(r, errors_add(r->errors, GLINT_INPUT, r->format->column[q].where,
                                   "%s and %s are both column %d of '%s'; expected two columns",
                                   names[p], names[q], r->index[q] + 1, r->path));
    }
}

/* ------------------------------------------------------------------ rows */

static place place_of(const reader *r, int quantity)
{
    return (place){r->path, r->row.line, r->row.at[r->index[quantity]].column};
}

/* Reads the row's cells into values (0 where there is no column); false on error. */
static bool read_values(reader *r, double value[MEASURED_COLUMNS])
{
    bool good = true;
    for (int q = 0; q < MEASURED_COLUMNS; q++) {
        value[q] = 0.0;
        if (r->index[q] < 0) continue;
        const cell *c = &r->row.at[r->index[q]];
        if (number_read(c->text, c->length, &value[q])) continue;
        const int shown = c->length < 40 ? (int)c->length : 40;
        fail(r, errors_add(r->errors, GLINT_INPUT, place_of(r, q),
                           "%s is '%.*s'; expected a finite number", names[q], shown, c->text));
        good = false;
    }
    return good;
}

/* A zenith angle in rad; false with an error where it is out of range. */
static bool read_zenith(reader *r, int quantity, double given, double *theta)
{
    *theta = r->format->radians ? given : given * DEG;
    const bool is_signed = r->format->signed_zenith;
    const double right = PI / 2.0, least = is_signed ? -right : 0.0;
    if (*theta > least - PAST_HORIZON && *theta < right + PAST_HORIZON) {
        *theta = fmin(fmax(*theta, least), right);
        return true;
    }
    const bool lacks_sign = !is_signed && *theta < 0.0 && *theta > -right - PAST_HORIZON;
    const bool may_be_deg = r->format->radians && fabs(given) <= 90.0;
    fail(r, errors_add(r->errors, GLINT_INPUT, place_of(r, quantity),
                       "%s is %.10g %s; expected %s90 deg from the normal%s", names[quantity],
                       given, r->format->radians ? "rad" : "deg", is_signed ? "-90 to " : "0 to ",
                       lacks_sign   ? " (signed angles need signed_zenith = true)"
                       : may_be_deg ? " (degrees need angles = \"deg\")"
                                    : ""));
    return false;
}

static void set_direction(double theta, double phi, double out[3])
{
    out[0] = sin(theta) * cos(phi);
    out[1] = sin(theta) * sin(phi);
    out[2] = cos(theta);
}

/* Keeps the largest angles, for a look at their unit. */
static void note_angles(reader *r, const double value[MEASURED_COLUMNS])
{
    for (int q = 0; q < MEASURED_F; q++) {
        const bool is_zenith = q == MEASURED_THETA_I || q == MEASURED_THETA_R;
        const double size = fabs(value[q]);
        if (!is_zenith) {
            r->most_azimuth = fmax(r->most_azimuth, size);
        } else if (size > r->most_zenith) {
            r->most_zenith = size;
            r->most_zenith_at = place_of(r, q);
        }
    }
}

/* Refuses angles that are rad where nobody said so. */
static void check_unit(reader *r)
{
    const measured_format *format = r->format;
    if (format->radians || format->unit_given) return;
    if (!angles_look_like_rad(r->most_zenith, r->most_azimuth)) return;
    fail(r, errors_add(r->errors, GLINT_INPUT, r->most_zenith_at,
                       "the largest angle from the normal is %.10g: these look like radians; "
                       "expected degrees, or the unit said outright: angles = \"rad\", or angles = "
                       "\"deg\" where degrees are so small (on a command line --angles)",
                       r->most_zenith));
}

static bool push(reader *r, const measured_point *point)
{
    if (!grow_room(&r->out->points, &r->capacity, r->out->n + 1L, sizeof *r->out->points)) {
        fail(r, errors_no_memory(r->errors));
        return false;
    }
    r->out->points[r->out->n++] = *point;
    return true;
}

/* Takes the row in r->row. */
static void read_row(reader *r)
{
    double value[MEASURED_COLUMNS], theta_i, theta_r;
    if (r->row.n != r->n_cells) {
        fail(r, errors_add(r->errors, GLINT_INPUT, (place){r->path, r->row.line, 1},
                           "this row has %d cells; expected %d, as in the first", r->row.n,
                           r->n_cells));
        return;
    }
    if (!read_values(r, value)) return;
    note_angles(r, value);
    const bool good_i = read_zenith(r, MEASURED_THETA_I, value[MEASURED_THETA_I], &theta_i);
    const bool good_r = read_zenith(r, MEASURED_THETA_R, value[MEASURED_THETA_R], &theta_r);
    const double f = value[MEASURED_F];
    if (f < 0.0)
        fail(r, errors_add(r->errors, GLINT_INPUT, place_of(r, MEASURED_F),
                           "f is %.10g; expected a BRDF of at least 0", f));
    if (!good_i || !good_r || f < 0.0) return;
    if (f <= r->format->floor) {
        r->out->n_dropped++;
        return;
    }
    const double unit = r->format->radians ? 1.0 : DEG;
    const double phi_i = value[MEASURED_PHI_I] * unit;
    const double phi_r = r->index[MEASURED_PHI_R] < 0 ? phi_i + PI : value[MEASURED_PHI_R] * unit;
    measured_point point = {.angle = {value[MEASURED_THETA_I], value[MEASURED_PHI_I],
                                      value[MEASURED_THETA_R], phi_r / unit},
                            .f = f,
                            .line = r->row.line};
    set_direction(theta_i, phi_i, point.i);
    set_direction(theta_r, phi_r, point.r);
    push(r, &point);
}

/* A last row that may have been cut. */
static void leave_out(reader *r, const line *l)
{
    errors_warn(r->errors, (place){r->path, l->number, 1},
                "this last row has no line end, so that it may have been cut off, and is left out; "
                "end it with a new line if it is whole");
}

/* Takes one line; is_ended: it has a line end. False where reading on makes no sense. */
static bool read_line(reader *r, const line *l, bool is_ended)
{
    const char *at = skip_blanks(l->start, l->end);
    if (at == l->end) return true;
    if (is_comment(at, l->end)) {
        if (!r->knows_columns) r->comment = *l;
        return true;
    }
    if (!split(l, at, &r->row)) {
        fail(r, errors_add(r->errors, GLINT_INPUT, (place){r->path, l->number, 1},
                           "this row has more than %d cells", MOST_COLUMNS));
        return false;
    }
    if (!r->knows_columns && !r->header.line && !holds_a_number(&r->row)) {
        r->header = r->row;
        return true;
    }
    if (!is_ended) {
        leave_out(r, l);
        return true;
    }
    if (!r->knows_columns) {
        find_columns(r);
        if (r->status) return false;
    }
    read_row(r);
    return r->status != GLINT_INTERNAL;
}

static void read_lines(reader *r, const char *bytes, size_t size)
{
    const char *end = bytes + size;
    const size_t bom = size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    line l = {.start = bytes + bom, .number = 1};
    while (l.start < end && l.number < INT_MAX) {
        const char *newline = memchr(l.start, '\n', (size_t)(end - l.start));
        l.end = newline ? newline : end;
        if (!read_line(r, &l, newline != NULL)) return;
        l.start = newline ? newline + 1 : end;
        l.number++;
    }
}

/* ------------------------------------------------------------------ the whole file */

static bool is_in_plane(const measured_point *p)
{
    return fabs(p->i[0] * p->r[1] - p->i[1] * p->r[0]) <= IN_PLANE;
}

/* Refuses a file of hardly any rows. */
static void check_number(reader *r)
{
    enum { FEWEST = 3 };
    const place whole = {r->path, 0, 0};
    const int n = r->out->n, dropped = r->out->n_dropped;
    if (n >= FEWEST) return;
    if (dropped > 0)
        fail(r, errors_add(r->errors, GLINT_INPUT, whole,
                           "found %d usable rows (and %d without light); expected at least %d", n,
                           dropped, FEWEST));
    else
        fail(r, errors_add(r->errors, GLINT_INPUT, whole,
                           "found %d rows of numbers; expected at least %d", n, FEWEST));
}

static void read_bytes(reader *r, const char *bytes, size_t size)
{
    const char *nul = memchr(bytes, '\0', size);
    if (nul) {
        fail(r, errors_add(r->errors, GLINT_INPUT, (place){r->path, 0, 0},
                           "this is not a text file: a zero byte stands at offset %zu",
                           (size_t)(nul - bytes)));
        return;
    }
    read_lines(r, bytes, size);
    if (r->status) return;
    check_unit(r);
    check_number(r);
    r->out->in_plane = true;
    for (int k = 0; k < r->out->n; k++)
        if (!is_in_plane(&r->out->points[k])) r->out->in_plane = false;
}

glint_status measured_read(const char *path, place asked_from, const measured_format *format,
                           measured *out, glint_errors *errors)
{
    *out = (measured){0};
    glint_error error;
    char *bytes;
    size_t size;
    if (file_read(path, &bytes, &size, asked_from, &error))
        return errors_take(errors, &error, asked_from);
    reader *r = calloc(1, sizeof *r);
    glint_status status = GLINT_INTERNAL;
    if (r) {
        r->path = path;
        r->asked_from = asked_from.file ? asked_from : (place){path, 0, 0};
        r->format = format;
        r->out = out;
        r->errors = errors;
        read_bytes(r, bytes, size);
        status = r->status;
    } else {
        errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    }
    free(r);
    free(bytes);
    if (status) measured_free(out);
    return status;
}

void measured_free(measured *m)
{
    if (!m) return;
    free(m->points);
    *m = (measured){0};
}
