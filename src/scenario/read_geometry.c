/* read_geometry.c: [geometry]: directions in the body frame, from a table, a sweep or a rotation.
 */
#include "base/constants.h"
#include "base/vec.h"
#include "scenario/reading.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_ROWS = 100000000 };

static const param_info RANGE = {"range_km", "km", "observer to satellite", 1e-6, 1e12, 1000, 0};

static bool allocate(reading *rd, int64_t n)
{
    geometry_table *g = &rd->s->geometry;
    const size_t size = (size_t)(n > 0 ? n : 1);
    g->sun = calloc(size, sizeof *g->sun);
    g->observer = calloc(size, sizeof *g->observer);
    g->range_m = calloc(size, sizeof *g->range_m);
    g->t_s = calloc(size, sizeof *g->t_s);
    g->n = n;
    if (g->sun && g->observer && g->range_m && g->t_s) return true;
    reading_no_memory(rd);
    return false;
}

/* Reads three cells as a direction. */
static glint_status read_cells(reading *rd, const csv_table *csv, long row, const int column[3],
                               double out[3])
{
    double v[3] = {0, 0, 0};
    glint_status status = GLINT_OK;
    for (int i = 0; i < 3; i++)
        if (csv_number(csv, row, column[i], &v[i], rd->errors)) status = GLINT_INPUT;
    if (status == GLINT_OK && !(unit3(v, out) > 0.0))
        status = errors_add(rd->errors, GLINT_INPUT, csv_place(csv, csv_at(csv, row, column[0])),
                            "%s to %s is a zero vector; expected a direction",
                            csv->cells[column[0]].text, csv->cells[column[2]].text);
    return status;
}

static void read_rows(reading *rd, const csv_table *csv, const int column[8], double range_km)
{
    static const double LONGEST_S = 1e10; /* 300 years */
    geometry_table *g = &rd->s->geometry;
    for (long row = 0; row < csv->n_rows; row++) {
        double km = range_km, t_s = (double)row;
        reading_note(rd, read_cells(rd, csv, row, column, g->sun[row]));
        reading_note(rd, read_cells(rd, csv, row, column + 3, g->observer[row]));
        if (column[6] >= 0) {
            if (csv_number(csv, row, column[6], &km, rd->errors))
                reading_note(rd, GLINT_INPUT);
            else if (!param_accepts(&RANGE, km))
                reading_note(
                    rd,
                    errors_add(rd->errors, GLINT_INPUT, csv_place(csv, csv_at(csv, row, column[6])),
                               "range_km is %g; expected a distance between 1e-6 and 1e12 km", km));
        }
        if (column[7] >= 0) reading_note(rd, csv_number(csv, row, column[7], &t_s, rd->errors));
        if (!(fabs(t_s) <= LONGEST_S))
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT,
                                        csv_place(csv, csv_at(csv, row, column[7])),
                                        "t_s is %g; expected at most %g s", t_s, LONGEST_S));
        g->range_m[row] = km * 1e3;
        g->t_s[row] = t_s;
    }
}

static void read_table(reading *rd, reader *r, double range_km)
{
    static const char *const NAMES[8] = {"sun_x", "sun_y", "sun_z",    "obs_x",
                                         "obs_y", "obs_z", "range_km", "t_s"};
    const toml_node *file = reader_get(r, "table", TOML_STRING, true, "the path of a CSV file");
    if (!file) return;
    char *path = reading_path(rd, file);
    csv_table csv;
    const glint_status status =
        path ? csv_read(path, file->where, &csv, rd->errors) : GLINT_INTERNAL;
    free(path);
    reading_note(rd, status);
    if (status) return;
    csv_leave_out_cut_row(&csv, rd->errors);
    int column[8];
    bool complete = true;
    for (int i = 0; i < 8; i++) {
        column[i] = csv_column(&csv, NAMES[i]);
        if (column[i] < 0 && i < 6) {
            complete = false;
            reading_note(rd,
                         errors_add(rd->errors, GLINT_INPUT, csv_place(&csv, &csv.cells[0]),
                                    "the table has no column '%s'; expected sun_x, sun_y, sun_z, "
                                    "obs_x, obs_y, obs_z and, if wanted, range_km and t_s",
                                    NAMES[i]));
        }
    }
    if (complete && csv.n_rows == 0)
        reading_note(rd, errors_add(rd->errors, GLINT_INPUT, (place){csv.path, 0, 0},
                                    "the table has no rows; expected at least one"));
    else if (complete && allocate(rd, csv.n_rows))
        read_rows(rd, &csv, column, range_km);
    csv_free(&csv);
}

static bool allocate_steps(reading *rd, reader *r, const char *key, double n, double range_km)
{
    if (n > MOST_ROWS) {
        reader_fail(r, reader_place(r, key), "'%s' asks for %.3g rows; expected at most %d", key, n,
                    MOST_ROWS);
        return false;
    }
    if (!allocate(rd, (int64_t)n)) return false;
    for (int64_t k = 0; k < rd->s->geometry.n; k++) {
        rd->s->geometry.range_m[k] = range_km * 1e3;
        rd->s->geometry.t_s[k] = (double)k;
    }
    return true;
}

/* The observer stays on the plane's second axis; the Sun goes from it towards the first. */
static void read_sweep(reading *rd, reader *outer, double range_km)
{
    static const char *const PLANES[] = {"xy", "xz", "yz", "yx", "zx", "zy"};
    const toml_node *table = reader_table(outer, "sweep", true);
    if (!table) return;
    reader r = reader_start(table, "sweep", rd->errors);
    double phase[3] = {0, 0, 1};
    int plane;
    const bool has_phase = reader_vector(&r, "phase_deg", true, 3, phase);
    reader_choice(&r, "plane", PLANES, 6, -1, &plane);
    if (has_phase && (phase[2] <= 0 || phase[1] < phase[0] || phase[0] < -360 || phase[1] > 360))
        reader_fail(&r, reader_place(&r, "phase_deg"),
                    "phase_deg = [%g, %g, %g]; expected [from, to, step] within -360 to 360 with "
                    "from <= to and step > 0",
                    phase[0], phase[1], phase[2]);
    const double n = floor((phase[1] - phase[0]) / phase[2] + 1e-9) + 1;
    if (r.status == GLINT_OK && allocate_steps(rd, &r, "phase_deg", n, range_km)) {
        const int first = PLANES[plane][0] - 'x', second = PLANES[plane][1] - 'x';
        for (int64_t k = 0; k < rd->s->geometry.n; k++) {
            const double angle = (phase[0] + (double)k * phase[2]) * DEG;
            rd->s->geometry.observer[k][second] = 1;
            rd->s->geometry.sun[k][first] = sin(angle);
            rd->s->geometry.sun[k][second] = cos(angle);
        }
    }
    reading_done(rd, &r);
}

/* The satellite turns right-handed about a body axis, so directions turn the other way in it. */
static void read_rotate(reading *rd, reader *outer, double range_km)
{
    static const param_info STEP = {"step_deg", "deg", "", 0, 360, PARAM_REQUIRED, PARAM_MIN_OPEN};
    const toml_node *table = reader_table(outer, "rotate", true);
    if (!table) return;
    reader r = reader_start(table, "rotate", rd->errors);
    double axis[3], sun[3], observer[3], step_deg;
    reader_axis(&r, "axis", true, axis);
    reader_axis(&r, "sun", true, sun);
    reader_axis(&r, "observer", true, observer);
    reader_param(&r, &STEP, &step_deg);
    if (r.status == GLINT_OK &&
        allocate_steps(rd, &r, "step_deg", ceil(360 / step_deg - 1e-9), range_km)) {
        for (int64_t k = 0; k < rd->s->geometry.n; k++) {
            double turn[9];
            mat_turn(axis, -(double)k * step_deg * DEG, turn);
            mat_vec(turn, sun, rd->s->geometry.sun[k]);
            mat_vec(turn, observer, rd->s->geometry.observer[k]);
        }
    }
    reading_done(rd, &r);
}

void read_geometry(reading *rd, const toml_node *table)
{
    reader r = reader_start(table, "[geometry]", rd->errors);
    double range_km;
    reader_param(&r, &RANGE, &range_km);
    const bool has_table = reader_has(&r, "table"), has_sweep = reader_has(&r, "sweep"),
               has_rotate = reader_has(&r, "rotate");
    const int sources = has_table + has_sweep + has_rotate;
    if (sources != 1)
        reader_fail(&r, table->where,
                    "[geometry] has %s; expected exactly one of table, sweep, rotate",
                    sources ? "several sources" : "no source");
    else if (has_table)
        read_table(rd, &r, range_km);
    else if (has_sweep)
        read_sweep(rd, &r, range_km);
    else
        read_rotate(rd, &r, range_km);
    rd->s->n_steps = rd->s->geometry.n;
    reading_done(rd, &r);
}
