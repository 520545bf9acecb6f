/* table_scans.c: in-plane tables whose rows form scans: one direction fixed, the other moving.
 *
 * In the plane of incidence a pair is two zenith angles with signs, the source's turned so that the
 * mirror direction has its sign: (x, y). Reciprocity exchanges them; an isotropic surface looks the
 * same with both signs turned. theta_h = |y - x|/2 and theta_d = |y + x|/2. A scan at incidence s
 * gives ln f along the line x = s, as a function of y, and by those symmetries along y = s, x = -s
 * and y = -s too: a net of lines.
 *
 * Along a line: a monotone cubic through the nodes. Between lines: at a fixed theta_h (so that
 * peaks are blended with peaks) every line that crosses gives one value; those with y = +-s are one
 * family, those with x = +-s the other, which is the first one mirrored. A monotone cubic through
 * the values of a family gives G(y) and G(-x). Each is exact on its own lines; they are blended by
 * the squares of the distances to them, W = e2^2/(e1^2 + e2^2), which makes the whole exact on all
 * lines and smooth. Where two lines cross both must agree: they share a node there.
 *
 * That the mirror image is exact makes it smooth through the peak: at theta_h = 0 both families
 * give the same, and their slopes along theta_h are opposite.
 *
 * Beyond the end of a scan its last value holds, and beyond the outermost lines those lines do. */
#include "base/constants.h"
#include "base/grow.h"
#include "base/sorted.h"
#include "brdf/monotone.h"
#include "brdf/table_parts.h"

#include <stdlib.h>
#include <string.h>

/* A line as the data hold it: by signed incidence, ascending. */
enum {
    LINE_INCIDENCE, /* rad, signed */
    LINE_SIGN,      /* of it; the scan is read at sign (incidence - 2 theta_h) */
    LINE_NODES,     /* index of its nodes: all angles, then all ln f, then all slopes, and then,
                       for as many equal parts of its range, the number of nodes in those before */
    LINE_N_NODES,
    LINE_PARTS, /* parts per rad */
    LINE_SIZE
};

/* What is held beyond the outermost line, or beyond the end of a scan, errs with the first power of
 * the distance; what is interpolated, with a higher one. So those distances count more; most of all
 * the latter, which is one in theta_h, where lobes are steep. */
static const double HELD_LINE = 8.0, HELD_END = 32.0;

/* ------------------------------------------------------------------ evaluation */

/* Index k, low <= k < high, of the interval between neighbours of ascending numbers in which x
 * lies; x is taken to lie between numbers low and high. */
static int find_interval(const double *ascending, int low, int high, int stride, double x)
{
    const double *first = ascending + (size_t)low * (size_t)stride;
    const size_t n = (size_t)(high - low) + 1, bytes = (size_t)stride * sizeof *first;
    return low + (int)sorted_interval(first, n, bytes, x);
}

/* ln f where a line has this theta_h, and HELD_END times how far (in theta_h) that lies past the
 * scan's end. */
static double line_value(const double *data, const double *line, double theta_h, double *past)
{
    const int n = (int)line[LINE_N_NODES];
    const double *angle = data + (size_t)line[LINE_NODES], *log_f = angle + n, *slope = log_f + n;
    const double wanted = line[LINE_SIGN] * (line[LINE_INCIDENCE] - 2.0 * theta_h);
    const double at = fmin(fmax(wanted, angle[0]), angle[n - 1]);
    *past = 0.5 * HELD_END * fabs(wanted - at);
    if (n == 1) return log_f[0];
    const double *before = slope + n;
    const int part = (int)((at - angle[0]) * line[LINE_PARTS]);
    const int low = (int)before[part] - 1, high = (int)before[part + 1];
    const int k = find_interval(angle, low > 0 ? low : 0, high < n ? high : n - 1, 1, at);
    const double width = angle[k + 1] - angle[k];
    return monotone_cubic(width, (at - angle[k]) / width, log_f[k], slope[k], log_f[k + 1],
                          slope[k + 1]);
}

/* Slope of the family at its line k, from the widths and secants on both sides: w[1], s[1] is the
 * interval of interest, w[0], s[0] the one across the line, w[2], s[2] the one at its other end;
 * a width of 0 says that there is none. */
static double slope_across(const double w[3], const double s[3])
{
    if (w[0] > 0.0) return monotone_slope(w[0], s[0], w[1], s[1]);
    return w[2] > 0.0 ? monotone_end_slope(w[1], s[1], w[2], s[2]) : s[1];
}

/* A family beyond its first or last line: that line's ln f. */
static double held_value(const double *data, const double *line, double theta_h, double y,
                         double *error2)
{
    double past;
    const double z = line_value(data, line, theta_h, &past);
    const double away = HELD_LINE * (y - line[LINE_INCIDENCE]);
    *error2 = away * away + past * past;
    return z;
}

/* One family: ln f at angle y from the four lines around, at a fixed theta_h. *error2: square of
 * the distance to what was measured, 0 on a line. */
static double family_value(const double *data, double theta_h, double y, double *error2)
{
    const double *lines = data + (size_t)data[TABLE_LINES];
    const int n = (int)data[TABLE_N_LINES];
    const double *last = lines + (size_t)(n - 1) * LINE_SIZE;
    if (y >= last[LINE_INCIDENCE]) return held_value(data, last, theta_h, y, error2);
    if (y <= lines[LINE_INCIDENCE]) return held_value(data, lines, theta_h, y, error2);
    const int k = find_interval(lines, 0, n - 1, LINE_SIZE, y);
    double x[4], z[4], past[4], w[3], s[3];
    for (int j = 0; j < 4; j++) {
        const double *line = lines + (k - 1 + j) * LINE_SIZE;
        if (k - 1 + j < 0 || k - 1 + j >= n) continue;
        x[j] = line[LINE_INCIDENCE];
        z[j] = line_value(data, line, theta_h, &past[j]);
    }
    for (int j = 0; j < 3; j++) {
        const bool exists = k - 1 + j >= 0 && k + j < n;
        w[j] = exists ? x[j + 1] - x[j] : 0.0;
        s[j] = exists ? (z[j + 1] - z[j]) / w[j] : 0.0;
    }
    const double turned_w[3] = {w[2], w[1], w[0]}, turned_s[3] = {s[2], s[1], s[0]};
    const double part = (y - x[1]) / w[1];
    const double away = w[1] * part * (1.0 - part); /* 0 on both lines, and its slope there is 1 */
    const double beyond = past[1] + part * (past[2] - past[1]);
    *error2 = away * away + beyond * beyond;
    return monotone_cubic(w[1], part, z[1], slope_across(w, s), z[2],
                          slope_across(turned_w, turned_s));
}

double table_scans_log_f(const double *data, const table_place *p)
{
    /* Out of the plane theta_h + theta_d may exceed 90 deg; in it that is the horizon. */
    const double h = p->theta_h, d = fmin(p->theta_d, PI / 2.0 - h);
    double e1, e2;
    const double g1 = family_value(data, h, h + d, &e1);
    const double g2 = family_value(data, h, h - d, &e2);
    const double weight = e1 + e2 > 0.0 ? e2 / (e1 + e2) : 0.5;
    return g2 + weight * (g1 - g2);
}

/* ------------------------------------------------------------------ construction */

typedef struct scan_node {
    double angle, log_f, slope; /* of the moving direction, rad, signed */
} scan_node;

typedef struct scan {
    double incidence; /* rad, at least 0 */
    scan_node *nodes; /* owned */
    int n, capacity;
    bool failed; /* memory is out */
} scan;

typedef struct scan_list {
    scan *at; /* owned */
    int n;
} scan_list;

static void free_scans(scan_list *scans)
{
    for (int k = 0; k < scans->n; k++)
        free(scans->at[k].nodes);
    free(scans->at);
    *scans = (scan_list){0};
}

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int compare_nodes(const void *a, const void *b)
{
    return compare_numbers(&((const scan_node *)a)->angle, &((const scan_node *)b)->angle);
}

/* Sorts angles and keeps one of each; returns their number. */
static int sort_unique(double *angles, int n)
{
    int kept = 0;
    qsort(angles, (size_t)n, sizeof *angles, compare_numbers);
    for (int k = 0; k < n; k++)
        if (kept == 0 || angles[k] - angles[kept - 1] > TABLE_SAME_ANGLE)
            angles[kept++] = angles[k];
    return kept;
}

static double zenith(const double v[3])
{
    return atan2(hypot(v[0], v[1]), v[2]);
}

/* The incidences of the scans, in `angles` (room for all rows): the zenith angles of the direction
 * that has fewer of them. */
static int find_incidences(const measured *rows, double *angles)
{
    for (int k = 0; k < rows->n; k++)
        angles[k] = zenith(rows->points[k].r);
    const int n_r = sort_unique(angles, rows->n);
    for (int k = 0; k < rows->n; k++)
        angles[k] = zenith(rows->points[k].i);
    const int n_i = sort_unique(angles, rows->n);
    if (n_i <= n_r) return n_i;
    for (int k = 0; k < rows->n; k++)
        angles[k] = zenith(rows->points[k].r);
    return sort_unique(angles, rows->n);
}

static void scan_add(scan *s, double angle, double log_f)
{
    s->failed = s->failed || !grow_room(&s->nodes, &s->capacity, s->n + 1L, sizeof *s->nodes);
    if (!s->failed) s->nodes[s->n++] = (scan_node){angle, log_f, 0.0};
}

/* A scan's incidence is that of one of its rows, and merging moves a node by as much; rad. */
static const double NEAR = 4.0 * TABLE_SAME_ANGLE;

static bool is_normal(const scan *s)
{
    return s->incidence <= NEAR;
}

/* Puts a node on a scan if it lies there: incidence and the signed angle of the other direction.
 * At normal incidence both signs are the same. */
static void place_node(scan *s, double incidence, double angle, double log_f)
{
    if (fabs(incidence - s->incidence) > NEAR) return;
    scan_add(s, angle, log_f);
    if (is_normal(s) && fabs(angle) > TABLE_SAME_ANGLE) scan_add(s, -angle, log_f);
}

/* Puts every node on the one or two scans that it belongs to. */
static void place_nodes(scan_list *scans, const table_node *nodes, int n)
{
    for (int j = 0; j < n; j++) {
        const double large = nodes[j].place.theta_d + nodes[j].place.theta_h;
        const double small = nodes[j].place.theta_d - nodes[j].place.theta_h; /* signed */
        for (int k = 0; k < scans->n; k++) {
            place_node(&scans->at[k], large, small, nodes[j].log_f);
            if (large - fabs(small) > TABLE_SAME_ANGLE)
                place_node(&scans->at[k], fabs(small), copysign(large, small), nodes[j].log_f);
        }
    }
}

/* Slope of node k of n >= 2 sorted ones. */
static double node_slope(const scan_node *v, int n, int k)
{
    double w[4] = {0}, secant[4] = {0}; /* of the intervals k-2 .. k+1, by their left nodes */
    for (int j = 0; j < 4; j++) {
        const int left = k - 2 + j;
        if (left < 0 || left + 1 >= n) continue;
        w[j] = v[left + 1].angle - v[left].angle;
        secant[j] = (v[left + 1].log_f - v[left].log_f) / w[j];
    }
    if (k > 0 && k < n - 1) return monotone_slope(w[1], secant[1], w[2], secant[2]);
    if (n == 2) return k == 0 ? secant[2] : secant[1];
    return k == 0 ? monotone_end_slope(w[2], secant[2], w[3], secant[3])
                  : monotone_end_slope(w[1], secant[1], w[0], secant[0]);
}

/* Sorts the nodes, keeps one of each angle, and finds the slopes. */
static void finish_scan(scan *s)
{
    int kept = 0;
    qsort(s->nodes, (size_t)s->n, sizeof *s->nodes, compare_nodes);
    for (int k = 0; k < s->n; k++)
        if (kept == 0 || s->nodes[k].angle - s->nodes[kept - 1].angle > TABLE_SAME_ANGLE)
            s->nodes[kept++] = s->nodes[k];
    s->n = kept;
    for (int k = 0; k < s->n && s->n > 1; k++)
        s->nodes[k].slope = node_slope(s->nodes, s->n, k);
}

/* ln f of a finished scan at an angle; false when the angle is outside of it. *is_node: whether
 * a node lies there. */
static bool read_scan(const scan *s, double angle, double *log_f, bool *is_node)
{
    *is_node = false;
    for (int k = 0; k < s->n; k++) {
        const scan_node *a = &s->nodes[k], *b = a + 1;
        if (fabs(a->angle - angle) <= TABLE_SAME_ANGLE) {
            *log_f = a->log_f;
            *is_node = true;
            return true;
        }
        if (k + 1 == s->n || a->angle > angle || b->angle <= angle + TABLE_SAME_ANGLE) continue;
        const double w = b->angle - a->angle, x = (angle - a->angle) / w;
        *log_f = monotone_cubic(w, x, a->log_f, a->slope, b->log_f, b->slope);
        return true;
    }
    return false;
}

/* A node that a scan gets where it crosses another. */
typedef struct crossing {
    scan *on;
    double angle, log_f;
} crossing;

/* Where two scans cross they get a common node: the one's measurement where only one was measured
 * there, and the mean where none was. (Where both were, the rows were merged before.) Returns the
 * number of new nodes. */
static int cross_scans(scan *a, scan *b, double sign, crossing out[2])
{
    double za, zb;
    bool node_a, node_b;
    int n = 0;
    if (!read_scan(a, sign * b->incidence, &za, &node_a) ||
        !read_scan(b, sign * a->incidence, &zb, &node_b))
        return 0;
    const double z = node_a ? za : node_b ? zb : 0.5 * (za + zb);
    if (!node_a) out[n++] = (crossing){a, sign * b->incidence, z};
    if (!node_b) out[n++] = (crossing){b, sign * a->incidence, z};
    return n;
}

/* False when memory is out. */
static bool cross_all(scan_list *scans)
{
    const size_t n = (size_t)scans->n;
    crossing *found = malloc(2 * n * n * sizeof *found); /* n (n-1)/2 pairs, two signs, two nodes */
    if (!found) return false;
    int n_found = 0;
    for (int a = 0; a < scans->n; a++)
        for (int b = a + 1; b < scans->n; b++) {
            n_found += cross_scans(&scans->at[a], &scans->at[b], 1.0, found + n_found);
            if (!is_normal(&scans->at[a])) /* else both signs are the same */
                n_found += cross_scans(&scans->at[a], &scans->at[b], -1.0, found + n_found);
        }
    for (int k = 0; k < n_found; k++)
        place_node(found[k].on, found[k].on->incidence, found[k].angle, found[k].log_f);
    free(found);
    return true;
}

/* Equal parts of a scan's range per rad: as many as it has nodes, and the last node in the last. */
static double parts_per_rad(const scan *s)
{
    static const double WITHIN = 1.0 - 1e-12;
    const double range = s->nodes[s->n - 1].angle - s->nodes[0].angle;
    return s->n > 1 ? s->n * WITHIN / range : 0.0;
}

/* before[p]: the number of nodes in the parts before p = 0 .. n. */
static void count_before(const scan *s, double *before)
{
    const double parts = parts_per_rad(s);
    for (int k = 0; k < s->n; k++)
        before[(int)((s->nodes[k].angle - s->nodes[0].angle) * parts) + 1] += 1.0;
    for (int p = 0; p < s->n; p++)
        before[p + 1] += before[p];
}

/* Appends a scan's nodes; returns their index. */
static size_t write_nodes(const scan *s, table_data *data)
{
    const size_t n = (size_t)s->n, at = table_data_add(data, NULL, 4 * n + 1);
    if (data->failed) return 0;
    count_before(s, data->at + at + 3 * n);
    for (size_t k = 0; k < n; k++) {
        data->at[at + k] = s->nodes[k].angle;
        data->at[at + n + k] = s->nodes[k].log_f;
        data->at[at + 2 * n + k] = s->nodes[k].slope;
    }
    return at;
}

static void write_line(const scan *s, double sign, size_t nodes, table_data *data)
{
    double line[LINE_SIZE];
    line[LINE_INCIDENCE] = sign * s->incidence;
    line[LINE_SIGN] = sign;
    line[LINE_NODES] = (double)nodes;
    line[LINE_N_NODES] = s->n;
    line[LINE_PARTS] = parts_per_rad(s);
    table_data_add(data, line, LINE_SIZE);
}

static void write_scans(const scan_list *scans, size_t *nodes, table_data *data)
{
    for (int k = 0; k < scans->n; k++)
        nodes[k] = write_nodes(&scans->at[k], data);
    const size_t lines = data->n;
    for (int k = scans->n - 1; k >= 0; k--)
        if (!is_normal(&scans->at[k])) write_line(&scans->at[k], -1.0, nodes[k], data);
    for (int k = 0; k < scans->n; k++)
        write_line(&scans->at[k], 1.0, nodes[k], data);
    if (data->failed) return;
    data->at[TABLE_LINES] = (double)lines;
    data->at[TABLE_N_LINES] = (double)((data->n - lines) / LINE_SIZE);
}

static bool start_scans(const double *incidences, int n, scan_list *scans)
{
    *scans = (scan_list){calloc((size_t)n, sizeof *scans->at), 0};
    if (!scans->at) return false;
    for (; scans->n < n; scans->n++)
        scans->at[scans->n].incidence = incidences[scans->n];
    return true;
}

/* False when memory is out. */
static bool finish_scans(scan_list *scans)
{
    for (int k = 0; k < scans->n; k++) {
        if (scans->at[k].failed) return false;
        finish_scan(&scans->at[k]);
    }
    return true;
}

/* Makes the scans of those incidences; false when memory is out. */
static bool make_scans(const double *incidences, int n_scans, const table_node *nodes, int n,
                       table_data *data)
{
    scan_list scans;
    size_t *indices = malloc((size_t)n_scans * sizeof *indices);
    bool good = start_scans(incidences, n_scans, &scans) && indices;
    if (good) place_nodes(&scans, nodes, n);
    good = good && finish_scans(&scans) && cross_all(&scans) && finish_scans(&scans);
    if (good) write_scans(&scans, indices, data);
    free(indices);
    free_scans(&scans);
    return good;
}

bool table_scans_make(const measured *rows, const table_node *nodes, int n, table_data *data)
{
    enum { FEWEST = 3, MOST_SCANS = 500 }; /* nodes of a scan, on average: fewer are no curve */
    if (!rows->in_plane) return false;
    double *angles = malloc((size_t)rows->n * sizeof *angles);
    if (!angles) {
        data->failed = true;
        return false;
    }
    const int n_scans = find_incidences(rows, angles);
    const bool found = n_scans <= n / FEWEST && n_scans <= MOST_SCANS;
    if (found && !make_scans(angles, n_scans, nodes, n, data)) data->failed = true;
    free(angles);
    return found && !data->failed;
}
