/* table.c: measured BRDFs: the rows of a table merged into nodes, and the model that reads them. */
#include "brdf/table.h"

#include "base/constants.h"
#include "base/grow.h"
#include "brdf/fastmath.h"
#include "brdf/lane.h"
#include "brdf/models.h"
#include "brdf/table_parts.h"

#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ evaluation */

/* |H| = 2 cos theta_d and |i - r| = 2 sin theta_d; tan theta_h is H's tangential part over its
 * normal one. Both keep their digits at 0, where an arc cosine would not. */
static inline table_place lane_place(const brdf_lane *l)
{
    const double tilt = 0.5 * (l->ci - l->cr);
    return (table_place){.theta_h = fast_angle(sqrt(l->ht * l->ht + l->hb * l->hb), l->hn),
                         .theta_d = fast_angle(sqrt(lane_difference2(l)), l->hlen),
                         .tilt = tilt * tilt};
}

static inline double place_log_f(const double *data, const table_place *p)
{
    return data[TABLE_SCATTERED] != 0.0 ? table_scatter_log_f(data, p) : table_scans_log_f(data, p);
}

static inline double table_lane(const double *data, const brdf_lane *l)
{
    if (!(l->ci > BRDF_EDGE && l->cr > BRDF_EDGE)) return 0.0; /* dear, unlike other models' */
    const table_place p = lane_place(l);
    return exp(place_log_f(data, &p)) * (l->ci * l->cr);
}

#define BRDF_LANE table_lane
#define BRDF_LONG_COEF
#include "brdf/tile.h"

/* Length of i + r below which its direction is rounding. */
static const double OPPOSITE = 1e-9;

void table_find_place(const double i[3], const double r[3], table_place *out)
{
    brdf_lane l = {.ci = i[2], .cr = r[2], .it = i[0], .ib = i[1], .rt = r[0], .rb = r[1]};
    l.ht = l.it + l.rt;
    l.hb = l.ib + l.rb;
    l.hn = fmax(l.ci + l.cr, 0.0);
    l.hlen = sqrt(l.ht * l.ht + l.hb * l.hb + l.hn * l.hn);
    *out = lane_place(&l);
    if (l.hlen < OPPOSITE) out->theta_h = 0.0; /* along the surface: what mirrors tend to */
}

double table_f(const brdf_lobe *lobe, const double i[3], const double r[3])
{
    table_place p;
    table_find_place(i, r, &p);
    return exp(place_log_f(lobe->numbers, &p));
}

bool table_covers(const brdf_lobe *lobe, const double i[3], const double r[3])
{
    return table_cover_holds(lobe->numbers, i, r);
}

/* ------------------------------------------------------------------ construction */

size_t table_data_add(table_data *data, const double *numbers, size_t n)
{
    const size_t at = data->n;
    if (data->failed) return at;
    if (!grow_list(&data->at, &data->capacity, at + n, sizeof *data->at)) {
        data->failed = true;
        return at;
    }
    for (size_t k = 0; k < n; k++)
        data->at[at + k] = numbers ? numbers[k] : 0.0;
    data->n += n;
    return at;
}

static int compare_numbers(double x, double y)
{
    return (x > y) - (x < y);
}

static int compare_theta_h(const void *a, const void *b)
{
    return compare_numbers(((const table_node *)a)->place.theta_h,
                           ((const table_node *)b)->place.theta_h);
}

static int compare_theta_d(const void *a, const void *b)
{
    return compare_numbers(((const table_node *)a)->place.theta_d,
                           ((const table_node *)b)->place.theta_d);
}

/* Sorts by theta_h, and those of the same by theta_d. */
static void sort_nodes(table_node *nodes, int n)
{
    qsort(nodes, (size_t)n, sizeof *nodes, compare_theta_h);
    for (int from = 0, to; from < n; from = to) {
        to = from + 1;
        while (to < n && nodes[to].place.theta_h - nodes[to - 1].place.theta_h <= TABLE_SAME_ANGLE)
            to++;
        qsort(nodes + from, (size_t)(to - from), sizeof *nodes, compare_theta_d);
    }
}

static bool is_same_place(const table_place *p, const table_place *q, bool in_plane)
{
    return fabs(p->theta_h - q->theta_h) <= TABLE_SAME_ANGLE &&
           fabs(p->theta_d - q->theta_d) <= TABLE_SAME_ANGLE &&
           (in_plane || fabs(p->tilt - q->tilt) <= TABLE_SAME_ANGLE);
}

/* Moves the nodes that share the place of the first of n sorted ones to the front; returns their
 * number. */
static int gather(table_node *nodes, int n, bool in_plane)
{
    int same = 1;
    for (int k = 1; k < n; k++) {
        if (fabs(nodes[k].place.theta_d - nodes[0].place.theta_d) > TABLE_SAME_ANGLE) break;
        if (!is_same_place(&nodes[0].place, &nodes[k].place, in_plane)) continue;
        const table_node found = nodes[k];
        /* what stood between keeps its order */
        memmove(&nodes[same + 1], &nodes[same], (size_t)(k - same) * sizeof *nodes);
        nodes[same++] = found;
    }
    return same;
}

/* Merges rows of one place; returns the number of nodes, and fills in the facts of it. */
static int merge_nodes(table_node *nodes, int n, bool in_plane, double *data)
{
    int kept = 0, merged = 0;
    double spread = 0.0;
    sort_nodes(nodes, n);
    for (int at = 0; at < n;) {
        const int same = gather(nodes + at, n - at, in_plane);
        double mean = nodes[at].log_f;
        for (int k = 1; k < same; k++)
            mean += (nodes[at + k].log_f - mean) / (k + 1);
        for (int k = 0; k < same; k++)
            spread = fmax(spread, fabs(nodes[at + k].log_f - mean));
        if (same > 1) merged += same;
        nodes[kept] = nodes[at];
        nodes[kept++].log_f = mean;
        at += same;
    }
    data[TABLE_NODES] = kept;
    data[TABLE_MERGED] = merged;
    data[TABLE_SPREAD] = spread;
    return kept;
}

/* The nodes of the rows, from malloc; NULL when memory is out. */
static table_node *make_nodes(const measured *rows, double *data, int *n)
{
    table_node *nodes = malloc((size_t)rows->n * sizeof *nodes);
    if (!nodes) return NULL;
    for (int k = 0; k < rows->n; k++) {
        table_find_place(rows->points[k].i, rows->points[k].r, &nodes[k].place);
        nodes[k].log_f = log(rows->points[k].f);
    }
    *n = merge_nodes(nodes, rows->n, rows->in_plane, data);
    data[TABLE_LEAST] = data[TABLE_LARGEST] = nodes[0].log_f;
    for (int k = 1; k < *n; k++) {
        data[TABLE_LEAST] = fmin(data[TABLE_LEAST], nodes[k].log_f);
        data[TABLE_LARGEST] = fmax(data[TABLE_LARGEST], nodes[k].log_f);
    }
    return nodes;
}

static void make_data(const measured *rows, table_data *data)
{
    table_data_add(data, NULL, TABLE_HEAD);
    if (data->failed) return;
    data->at[TABLE_IN_PLANE] = rows->in_plane;
    data->at[TABLE_ROWS] = rows->n;
    data->at[TABLE_DROPPED] = rows->n_dropped;
    int n;
    table_node *nodes = make_nodes(rows, data->at, &n);
    if (!nodes) {
        data->failed = true;
        return;
    }
    if (!table_scans_make(rows, nodes, n, data)) {
        if (!data->failed) data->at[TABLE_SCATTERED] = 1.0;
        table_scatter_make(nodes, n, rows->in_plane, data);
    }
    free(nodes);
    if (!data->failed) table_cover_make(rows, data);
}

glint_status table_prepare(const measured *rows, brdf_lobe *lobe, glint_error *error)
{
    table_data data = {0};
    make_data(rows, &data);
    if (data.failed) {
        free(data.at);
        return error_no_memory(error);
    }
    brdf_lobe_free(lobe);
    lobe->model = &brdf_table;
    lobe->numbers = data.at;
    lobe->n_numbers = data.n;
    return GLINT_OK;
}

/* ------------------------------------------------------------------ reports */

void table_describe(const brdf_lobe *lobe, table_facts *facts)
{
    static const double WHOLE = 0.995; /* covered is found to about 1 % */
    const double *data = lobe->numbers;
    *facts = (table_facts){.n_rows = (int)data[TABLE_ROWS],
                           .n_dropped = (int)data[TABLE_DROPPED],
                           .n_nodes = (int)data[TABLE_NODES],
                           .n_merged = (int)data[TABLE_MERGED],
                           .spread = data[TABLE_SPREAD],
                           .in_plane = data[TABLE_IN_PLANE] != 0.0,
                           .scans = data[TABLE_SCATTERED] == 0.0,
                           .least = exp(data[TABLE_LEAST]),
                           .largest = exp(data[TABLE_LARGEST]),
                           .covered = data[TABLE_COVERED],
                           .whole = data[TABLE_IN_PLANE] == 0.0 && data[TABLE_COVERED] >= WHOLE};
}

void table_report(const brdf_lobe *lobe, const char *indent, text *t)
{
    table_facts facts;
    table_describe(lobe, &facts);
    text_printf(t, "%s%d rows %s, f from %.3g to %.3g per sr", indent, facts.n_rows,
                !facts.in_plane ? "in the hemisphere"
                : facts.scans   ? "in scans of the plane of incidence"
                                : "in the plane of incidence",
                facts.least, facts.largest);
    if (facts.n_dropped) text_printf(t, "; %d without light left out", facts.n_dropped);
    if (facts.n_merged)
        text_printf(
            t,
            "\n%s%d rows repeat others or are their reciprocals: averaged, by up to %.1f %% "
            "from the mean",
            indent, facts.n_merged, 100.0 * (exp(facts.spread) - 1.0));
    if (facts.in_plane)
        text_printf(t, "\n%scarried out of the plane as if f did not depend on phi_d", indent);
    text_printf(t,
                "\n%s%.0f %% of the hemisphere lie between the measurements; elsewhere the nearest "
                "values hold\n",
                indent, 100.0 * facts.covered);
}

/* ------------------------------------------------------------------ the model */

static const param_info params[] = {
    [TABLE_FLOOR] = {"floor_per_sr", "1/sr", "rows with f at or below it are left out", 0, 1e6, 0,
                     0},
};

static glint_status prepare_lobe(brdf_lobe *lobe, glint_error *error)
{
    if (lobe->numbers) return GLINT_OK; /* table_prepare was here */
    return error_set(error, GLINT_INPUT, PLACE_NONE, "a table needs the rows of a file");
}

const brdf_model brdf_table = {
    .name = "table",
    .doc = "measured values, in the plane of incidence or full, interpolated over the half and "
           "difference angles; isotropic",
    .source = "angles: Rusinkiewicz 1998, Rendering Techniques '98, 11; interpolation: Fritsch and "
              "Butland 1984, SIAM Journal on Scientific and Statistical Computing 5, 300",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = BRDF_ISOTROPIC | BRDF_MEASURED,
    .prepare = brdf_prepare_without_arrays,
    .prepare_lobe = prepare_lobe,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
