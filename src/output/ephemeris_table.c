/* ephemeris_table.c: an ephemeris as CSV with an ECSV header, as JSON, as a table for people. */
#include "base/text.h"
#include "output/ecsv.h"
#include "output/facts.h"
#include "output/file.h"
#include "output/json.h"

#include <string.h>

/* ---------------------------------------------------------------------- CSV */

static bool fact_of(const void *ephemeris, size_t k, const char **key, const char **value)
{
    return glint_ephemeris_fact(ephemeris, k, key, value);
}

static void csv_header(const glint_ephemeris *e, text *t)
{
    size_t n;
    const glint_column *columns = glint_ephemeris_columns(e, &n);
    ecsv_begin(t, columns, n);
    ecsv_facts(t, fact_of, e);
    ecsv_end(t, columns, n);
}

static void add_utc(text *t, const glint_utc *u)
{
    text_printf(t, "%04d-%02d-%02dT%02d:%02d:%02d.%06dZ", u->year, u->month, u->day, u->hour,
                u->minute, u->second, u->microsecond);
}

static void csv_row(const glint_ephemeris *e, const glint_ephemeris_row *row, text *t)
{
    size_t n;
    double value;
    const glint_column *columns = glint_ephemeris_columns(e, &n);
    add_utc(t, &row->utc);
    for (size_t k = 1; k < n; k++) {
        text_char(t, ',');
        if (columns[k].is_text)
            ecsv_cell(t, row->observer_name);
        else if (glint_ephemeris_value(e, row, k, &value))
            text_double(t, value);
    }
    text_char(t, '\n');
}

/* --------------------------------------------------------------- for people */

/* The columns that fit on a line, and how: width and decimals. */
static const struct {
    const char *name, *head;
    int width, decimals;
} SHOWN[] = {
    {"azimuth_deg", "azimuth", 8, 3},
    {"elevation_deg", "elev.", 8, 3},
    {"range_km", "range km", 10, 3},
    {"range_rate_km_s", "km/s", 8, 4},
    {"ra_deg", "RA", 9, 4},
    {"dec_deg", "dec", 9, 4},
    {"rate_arcsec_s", "arcsec/s", 9, 2},
    {"phase_angle_deg", "phase", 7, 2},
    {"sunlit_fraction", "sunlit", 7, 3},
    {"sun_elevation_deg", "Sun el.", 8, 2},
    {"latitude_deg", "lat.", 8, 3},
    {"longitude_deg", "long.", 9, 3},
    {"height_km", "height km", 10, 3},
};

enum { N_SHOWN = sizeof SHOWN / sizeof *SHOWN };

static bool has_column(const glint_column *columns, size_t n, const char *name)
{
    for (size_t i = 0; i < n; i++)
        if (string_equal(columns[i].name, name)) return true;
    return false;
}

static void people_header(const glint_ephemeris *e, text *t)
{
    size_t n;
    const glint_column *columns = glint_ephemeris_columns(e, &n);
    text_printf(t, "%-24s", "UTC");
    for (size_t k = 0; k < N_SHOWN; k++)
        text_printf(t, " %*s", SHOWN[k].width, SHOWN[k].head);
    if (has_column(columns, n, "observer")) text_add(t, "  observer");
    text_char(t, '\n');
}

static void people_row(const glint_ephemeris *e, const glint_ephemeris_row *row, text *t)
{
    size_t n;
    double value;
    const glint_column *columns = glint_ephemeris_columns(e, &n);
    const glint_utc *u = &row->utc;
    text_printf(t, "%04d-%02d-%02dT%02d:%02d:%02d.%03dZ", u->year, u->month, u->day, u->hour,
                u->minute, u->second, u->microsecond / 1000);
    for (size_t k = 0; k < N_SHOWN; k++) {
        bool filled = false;
        for (size_t i = 1; i < n && !filled; i++)
            filled = string_equal(columns[i].name, SHOWN[k].name) &&
                     glint_ephemeris_value(e, row, i, &value);
        if (filled)
            text_printf(t, " %*.*f", SHOWN[k].width, SHOWN[k].decimals, value);
        else
            text_printf(t, " %*s", SHOWN[k].width, "-");
    }
    if (has_column(columns, n, "observer")) text_printf(t, "  %s", row->observer_name);
    text_char(t, '\n');
}

/* --------------------------------------------------------------------- JSON */

static void json_row(const glint_ephemeris *e, const glint_ephemeris_row *row, json *j)
{
    size_t n;
    double value;
    const glint_column *columns = glint_ephemeris_columns(e, &n);
    text utc = {0};
    json_object(j, NULL);
    add_utc(&utc, &row->utc);
    if (utc.failed)
        j->out->failed = true;
    else
        json_string(j, columns[0].name, utc.data);
    text_free(&utc);
    for (size_t k = 1; k < n; k++)
        if (columns[k].is_text)
            json_string(j, columns[k].name, row->observer_name);
        else if (glint_ephemeris_value(e, row, k, &value))
            json_number(j, columns[k].name, value);
    json_end(j, '}');
}

/* The facts; the list of rows is left open. */
static void json_header(const glint_ephemeris *e, json *j)
{
    json_object(j, NULL);
    json_facts(j, fact_of, e);
    json_list(j, "rows");
}

/* ---------------------------------------------------------------- the whole */

/* Sends what is written so far on its way. */
static glint_status flush_text(text *t, out_file *file, glint_error *error)
{
    if (t->failed) return error_no_memory(error);
    const glint_status status = out_file_write(file, t->data, t->length, error);
    text_clear(t);
    return status;
}

static void write_rows(const glint_ephemeris *e, const glint_ephemeris_row *rows, size_t n,
                       glint_format format, json *j)
{
    for (size_t k = 0; k < n; k++) {
        if (format == GLINT_FORMAT_CSV)
            csv_row(e, &rows[k], j->out);
        else if (format == GLINT_FORMAT_JSON)
            json_row(e, &rows[k], j);
        else
            people_row(e, &rows[k], j->out);
    }
}

static void write_header(const glint_ephemeris *e, glint_format format, json *j)
{
    if (format == GLINT_FORMAT_CSV)
        csv_header(e, j->out);
    else if (format == GLINT_FORMAT_JSON)
        json_header(e, j);
    else
        people_header(e, j->out);
}

/* The header waits for the first block, so that a run that fails at its start writes nothing. */
static glint_status write_all(glint_ephemeris *e, glint_format format, out_file *file, json *j,
                              glint_progress *progress, void *context, glint_error *error)
{
    for (bool first = true;; first = false) {
        const glint_ephemeris_row *rows;
        size_t n;
        glint_status status = glint_ephemeris_next(e, &rows, &n, error);
        if (status) return status;
        if (first) write_header(e, format, j);
        write_rows(e, rows, n, format, j);
        if (n == 0 && format == GLINT_FORMAT_JSON) {
            json_end(j, ']');
            json_end(j, '}');
        }
        status = flush_text(j->out, file, error);
        if (status || n == 0) return status;
        if (progress && !progress(context, glint_ephemeris_done(e), glint_ephemeris_length(e)))
            return error_set(error, GLINT_OUTPUT, PLACE_NONE, "stopped before the end");
    }
}

glint_status glint_ephemeris_write(glint_ephemeris *e, glint_format format, const char *path,
                                   glint_progress *progress, void *context, glint_error *error)
{
    out_file *file;
    text t = {0};
    json j = {.out = &t};
    if (path && glint_ephemeris_reads(e, path)) return out_file_is_input(path, error);
    glint_status status = out_file_open(path, &file, error);
    if (status) return status;
    status = write_all(e, format, file, &j, progress, context, error);
    text_free(&t);
    if (!status) return out_file_commit(file, error);
    out_file_abandon(file);
    return status;
}
