#include "orbit/orbit_table.h"

#include "base/constants.h"
#include "base/grow.h"
#include "base/sorted.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/frames.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ------------------------------------------------------------------- building */

orbit_table *orbit_table_new(const char *path, const char *format)
{
    orbit_table *table = calloc(1, sizeof *table);
    if (!table) return NULL;
    table->format = format;
    table->path = string_copy(path, strlen(path));
    if (table->path) return table;
    free(table);
    return NULL;
}

void orbit_table_free(orbit_table *table)
{
    if (!table) return;
    for (size_t k = 0; k < table->n; k++)
        free(table->segments[k].nodes);
    free(table->segments);
    free(table->path);
    free(table);
}

table_segment *orbit_table_add(orbit_table *table)
{
    if (!grow_list(&table->segments, &table->capacity, table->n + 1, sizeof *table->segments))
        return NULL;
    table_segment *segment = &table->segments[table->n++];
    *segment = (table_segment){0};
    return segment;
}

double orbit_table_seconds(const orbit_table *table, const double tt_jd[2])
{
    return jd_difference_s(tt_jd, table->reference_jd);
}

bool orbit_table_add_node(orbit_table *table, table_segment *segment, const double tt_jd[2],
                          const double r_m[3], const double v_m_s[3])
{
    if (!grow_list(&segment->nodes, &segment->capacity, segment->n + 1, sizeof *segment->nodes))
        return false;
    if (table->n == 1 && segment->n == 0) memcpy(table->reference_jd, tt_jd, 2 * sizeof *tt_jd);
    table_node *node = &segment->nodes[segment->n++];
    node->t_s = orbit_table_seconds(table, tt_jd);
    copy3(r_m, node->r_m);
    copy3(v_m_s, node->v_m_s);
    return true;
}

/* ITRF, ITRF2014, ITRF-97, ITRF97, ITRS. */
static bool is_itrf(const char *name)
{
    if (strcasecmp(name, "ITRS") == 0) return true;
    if (strncasecmp(name, "ITRF", 4) != 0) return false;
    const char *year = name + 4 + (name[4] == '-');
    const size_t digits = strspn(year, "0123456789");
    return year[digits] == '\0' && (digits == 4 || digits == 2 || (digits == 0 && !name[4]));
}

bool table_frame_find(const char *name, table_frame *out, bool *eme2000)
{
    static const struct {
        const char *name;
        table_frame frame;
        bool eme2000;
    } NAMES[] = {{"EME2000", TABLE_GCRS, true}, {"J2000", TABLE_GCRS, true},
                 {"GCRF", TABLE_GCRS, false},   {"GCRS", TABLE_GCRS, false},
                 {"ICRF", TABLE_GCRS, false},   {"ICRS", TABLE_GCRS, false},
                 {"TEME", TABLE_TEME, false},   {"TEMEOFDATE", TABLE_TEME, false}};
    *eme2000 = false;
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; k++)
        if (strcasecmp(name, NAMES[k].name) == 0) {
            *out = NAMES[k].frame;
            *eme2000 = NAMES[k].eme2000;
            return true;
        }
    if (!is_itrf(name)) return false;
    *out = TABLE_ITRS;
    return true;
}

void table_node_from_eme2000(double r_m[3], double v_m_s[3])
{
    double turn[9];
    frame_bias(turn); /* v_eme2000 = turn v_gcrs */
    mat_tvec(turn, r_m, r_m);
    mat_tvec(turn, v_m_s, v_m_s);
}

/* ------------------------------------------------------------------- checking */

glint_status table_state_check(const double r_m[3], const double v_m_s[3], const char *unit,
                               place where, glint_error *error)
{
    static const double NEAREST_M = 6000e3, FARTHEST_M = 1e10, FASTEST_M_S = 1e6;
    const double distance_m = norm3(r_m), speed_m_s = norm3(v_m_s);
    if (!(distance_m >= NEAREST_M && distance_m <= FARTHEST_M))
        return error_set(error, GLINT_INPUT, where,
                         "this record lies %.6g km from the Earth's centre; expected %g to %g km "
                         "(the unit is %s)",
                         distance_m * 1e-3, NEAREST_M * 1e-3, FARTHEST_M * 1e-3, unit);
    if (!(speed_m_s <= FASTEST_M_S))
        return error_set(error, GLINT_INPUT, where,
                         "this record moves with %.6g km/s; expected at most %g km/s (the unit is "
                         "%s/s)",
                         speed_m_s * 1e-3, FASTEST_M_S * 1e-3, unit);
    return GLINT_OK;
}

static void time_text(const orbit_table *table, double t_s, char out[UTC_TEXT_SIZE + 1])
{
    const double tt_jd[2] = {table->reference_jd[0], table->reference_jd[1] + t_s / DAY_S};
    tt_write_utc(tt_jd, out);
    out[UTC_TEXT_SIZE - 1] = '\0';
}

/* Nodes that an interpolation of that degree takes. */
static int nodes_for(table_method method, int degree)
{
    const int hermite = degree < 3 ? 2 : (degree + 2) / 2;
    return method == TABLE_HERMITE ? hermite : degree + 1;
}

static glint_status check_nodes(const orbit_table *table, table_segment *s, glint_errors *errors)
{
    static const double SHORTEST_STEP_S = 1e-3, LONGEST_STEP_S = 1e5;
    const place where = {table->path, s->line, 0};
    if (s->n < 2)
        return errors_add(errors, GLINT_INPUT, where,
                          "this segment has %s; expected at least two, to interpolate between: the "
                          "file may be cut; get it again, or take the segment out",
                          s->n ? "one record" : "no record");
    for (size_t k = 1; k < s->n; k++) {
        const double step_s = s->nodes[k].t_s - s->nodes[k - 1].t_s;
        if (step_s >= SHORTEST_STEP_S && step_s <= LONGEST_STEP_S) continue;
        char when[UTC_TEXT_SIZE + 1];
        time_text(table, s->nodes[k].t_s, when);
        return errors_add(errors, GLINT_INPUT, where,
                          "record %zu of this segment, of %s UTC, is %.6g s later than the one "
                          "before it; expected times that grow, by %g to %g s",
                          k + 1, when, step_s, SHORTEST_STEP_S, LONGEST_STEP_S);
    }
    return GLINT_OK;
}

static glint_status check_use(const orbit_table *table, table_segment *s, glint_errors *errors)
{
    const double first_s = s->nodes[0].t_s, last_s = s->nodes[s->n - 1].t_s;
    if (!s->has_use) {
        s->from_s = first_s;
        s->to_s = last_s;
    }
    /* A limit without records around it cannot be kept; its rounding as a JD is 1e-10 s. */
    if (s->from_s < first_s) s->from_s = first_s;
    if (s->to_s > last_s) s->to_s = last_s;
    if (s->from_s < s->to_s) return GLINT_OK;
    return errors_add(errors, GLINT_INPUT, (place){table->path, s->line, 0},
                      "nothing of this segment may be used: its records end before its "
                      "USEABLE_START_TIME, or begin after its USEABLE_STOP_TIME; the file may be "
                      "cut: get it again");
}

static void lower_degree(const orbit_table *table, table_segment *s, glint_errors *errors)
{
    const int asked = s->degree;
    if (s->method == TABLE_LINEAR) s->degree = 1;
    if ((size_t)nodes_for(s->method, s->degree) <= s->n) return;
    s->degree = s->method == TABLE_HERMITE ? 2 * (int)s->n - 1 : (int)s->n - 1;
    errors_warn(errors, (place){table->path, s->line, 0},
                "%s interpolation of degree %d takes %d records and this segment has %zu: degree "
                "%d is taken",
                table_method_name(s->method), asked, nodes_for(s->method, asked), s->n, s->degree);
}

glint_status orbit_table_finish(orbit_table *table, glint_errors *errors)
{
    glint_status worst = GLINT_OK;
    if (table->n == 0)
        return errors_add(errors, GLINT_INPUT, (place){table->path, 0, 0},
                          "there is no segment of positions in this file");
    for (size_t k = 0; k < table->n; k++) {
        table_segment *s = &table->segments[k], *before = k ? s - 1 : NULL;
        glint_status status = check_nodes(table, s, errors);
        if (!status) status = check_use(table, s, errors);
        if (!status) lower_degree(table, s, errors);
        if (!status && !worst && before && s->from_s < before->to_s)
            status = errors_add(errors, GLINT_INPUT, (place){table->path, s->line, 0},
                                "this segment begins before the one before it (line %d) ends; "
                                "expected segments in order of time, that share no more than a "
                                "moment",
                                before->line);
        if (status > worst) worst = status;
    }
    return worst;
}

/* ------------------------------------------------------------------ evaluation */

void orbit_table_span(const orbit_table *table, double *from_s, double *to_s)
{
    *from_s = table->segments[0].from_s;
    *to_s = table->segments[table->n - 1].to_s;
}

static glint_status outside(const orbit_table *table, double t_s, const char *problem,
                            double from_s, double to_s, glint_error *error)
{
    char at[UTC_TEXT_SIZE + 1], from[UTC_TEXT_SIZE + 1], to[UTC_TEXT_SIZE + 1];
    time_text(table, t_s, at);
    time_text(table, from_s, from);
    time_text(table, to_s, to);
    return error_set(error, GLINT_INPUT, (place){table->path, 0, 0}, "%s UTC %s %s to %s", at,
                     problem, from, to);
}

/* The last segment that begins at t_s or before; NULL where there is none that goes as far. */
static const table_segment *segment_at(const orbit_table *table, double t_s, glint_error *error)
{
    size_t lo = 0, hi = table->n;
    while (lo < hi) { /* the first that begins after t_s */
        const size_t middle = lo + (hi - lo) / 2;
        if (table->segments[middle].from_s > t_s + (middle == 0 ? TABLE_EDGE_S : 0.0))
            hi = middle;
        else
            lo = middle + 1;
    }
    double from_s, to_s;
    orbit_table_span(table, &from_s, &to_s);
    const table_segment *s = lo ? &table->segments[lo - 1] : NULL;
    if (s && t_s <= s->to_s + TABLE_EDGE_S) return s;
    if (s && lo < table->n)
        outside(table, t_s, "lies in the gap of the table from", s->to_s,
                table->segments[lo].from_s, error);
    else
        outside(table, t_s, "lies outside the table, which goes from", from_s, to_s, error);
    return NULL;
}

/* First of the `count` nodes around t_s. */
static size_t window_at(const table_segment *s, double t_s, size_t count)
{
    const size_t at = sorted_interval(&s->nodes->t_s, s->n, sizeof *s->nodes, t_s);
    const size_t before = (count - 1) / 2;
    const size_t first = at > before ? at - before : 0;
    return first + count > s->n ? s->n - count : first;
}

/* Lagrange's polynomials of a node at t, in units of t: value and derivative; and the derivative
 * at the node itself. */
typedef struct basis {
    double value, slope, own_slope;
} basis;

static basis lagrange_basis(const table_node *nodes, int n, int j, double t_s)
{
    basis b = {1.0, 0.0, 0.0};
    for (int m = 0; m < n; m++) {
        if (m == j) continue;
        const double width = nodes[j].t_s - nodes[m].t_s;
        const double factor = (t_s - nodes[m].t_s) / width, factor_slope = 1.0 / width;
        b.slope = b.slope * factor + b.value * factor_slope;
        b.value *= factor;
        b.own_slope += factor_slope;
    }
    return b;
}

/* Positions by Lagrange; velocities by the same polynomials, or as the positions' derivative. */
static void interpolate_lagrange(const table_node *nodes, int n, bool has_velocity, double t_s,
                                 double r_m[3], double v_m_s[3])
{
    for (int j = 0; j < n; j++) {
        const basis b = lagrange_basis(nodes, n, j, t_s);
        add_scaled3(r_m, b.value, nodes[j].r_m, r_m);
        if (has_velocity)
            add_scaled3(v_m_s, b.value, nodes[j].v_m_s, v_m_s);
        else
            add_scaled3(v_m_s, b.slope, nodes[j].r_m, v_m_s);
    }
}

/* Hermite's polynomial of degree 2n - 1 and its derivative: with L Lagrange's polynomial of node j
 * and s its slope there, positions are weighted with (1 - 2 (t - t_j) s) L^2 and velocities with
 * (t - t_j) L^2 (Hildebrand 1974, Introduction to Numerical Analysis, section 8.2). */
static void interpolate_hermite(const table_node *nodes, int n, double t_s, double r_m[3],
                                double v_m_s[3])
{
    for (int j = 0; j < n; j++) {
        const basis b = lagrange_basis(nodes, n, j, t_s);
        const double dt = t_s - nodes[j].t_s, square = b.value * b.value;
        const double square_slope = 2.0 * b.value * b.slope, part = 1.0 - 2.0 * dt * b.own_slope;
        add_scaled3(r_m, part * square, nodes[j].r_m, r_m);
        add_scaled3(r_m, dt * square, nodes[j].v_m_s, r_m);
        add_scaled3(v_m_s, part * square_slope - 2.0 * b.own_slope * square, nodes[j].r_m, v_m_s);
        add_scaled3(v_m_s, square + dt * square_slope, nodes[j].v_m_s, v_m_s);
    }
}

/* The state from n nodes around t_s. */
static void interpolate(const table_segment *s, int n, double t_s, double r_m[3], double v_m_s[3])
{
    const table_node *nodes = s->nodes + window_at(s, t_s, (size_t)n);
    for (int i = 0; i < 3; i++)
        r_m[i] = v_m_s[i] = 0.0;
    if (s->method == TABLE_HERMITE)
        interpolate_hermite(nodes, n, t_s, r_m, v_m_s);
    else
        interpolate_lagrange(nodes, n, s->has_velocity, t_s, r_m, v_m_s);
}

glint_status orbit_table_state(const orbit_table *table, double t_s, table_frame *frame,
                               double r_m[3], double v_m_s[3], glint_error *error)
{
    const table_segment *s = segment_at(table, t_s, error);
    if (!s) return GLINT_INPUT;
    interpolate(s, nodes_for(s->method, s->degree), t_s, r_m, v_m_s);
    *frame = s->frame;
    return GLINT_OK;
}

/* How far the interpolation moves where one more node on either side is taken, or where there are
 * no more, one node less. */
static double doubt_m(const table_segment *s, double t_s)
{
    const int n = nodes_for(s->method, s->degree), other = (size_t)n + 2 <= s->n ? n + 2 : n - 1;
    double r_m[3], other_m[3], unused[3];
    interpolate(s, n, t_s, r_m, unused);
    interpolate(s, other, t_s, other_m, unused);
    sub3(other_m, r_m, r_m);
    return norm3(r_m);
}

double orbit_table_error_m(const orbit_table *table, double from_s, double to_s)
{
    enum { MOST = 64 }; /* intervals looked at */
    double worst_m = 0.0;
    for (size_t k = 0; k < table->n; k++) {
        const table_segment *s = &table->segments[k];
        const double lo_s = fmax(from_s, s->from_s), hi_s = fmin(to_s, s->to_s);
        if (lo_s > hi_s) continue;
        const size_t first = window_at(s, lo_s, 2), last = window_at(s, hi_s, 2);
        const size_t step = (last - first) / MOST + 1;
        for (size_t i = first; i <= last; i += step) {
            const double off_m = doubt_m(s, 0.5 * (s->nodes[i].t_s + s->nodes[i + 1].t_s));
            if (off_m > worst_m) worst_m = off_m;
        }
    }
    return worst_m;
}

const char *table_method_name(table_method method)
{
    static const char *const NAMES[] = {
        [TABLE_LINEAR] = "linear", [TABLE_LAGRANGE] = "Lagrange", [TABLE_HERMITE] = "Hermite"};
    return NAMES[method];
}
