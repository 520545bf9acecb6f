/* table_scatter.c: tables whose nodes lie anywhere in the hemisphere.
 *
 * Nodes are points in three coordinates that are smooth functions of the directions and measure
 * distance as BRDFs vary: x = ln(1 + (theta_h/s)^2)/2, which resolves a peak and grows with the
 * logarithm outside of it; y, from theta_d; z, the tilt (for full tables only). x is flat at
 * theta_h = 0, so that every function of it is smooth through the peak.
 *
 * ln f is Shepard's interpolation in the local form of Franke and Little (Barnhill 1977, in
 * Mathematical Software III, ed. Rice): the mean of planes through the nearest nodes, weighted by
 * ((R - r)/(R r))^2, R the distance of the first node that no longer counts. A plane's gradient is
 * the least-squares one among its neighbours, restrained (Barth and Jespersen 1989, AIAA 89-0366)
 * so that halfway to a neighbour it stays in the range of the values there; and everywhere, also
 * beyond the outermost nodes, it is kept in that range. */
#include "brdf/table_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    DIMENSIONS = 3,
    NEAREST = 20 /* nodes that count */
};

/* A node as the data hold it; the records form a balanced k-d tree: the middle one of a range
 * parts it along the axis that its depth names. */
enum {
    RECORD_X, /* three coordinates */
    RECORD_LOG_F = DIMENSIONS,
    RECORD_GRADIENT,                             /* three */
    RECORD_LEAST = RECORD_GRADIENT + DIMENSIONS, /* range of ln f among the neighbours */
    RECORD_LARGEST,
    RECORD_SIZE
};

/* x grows by 1 when theta_h grows by a factor of e, z from 0 to 1 over its range. y follows
 * -ln cos theta_d, since f rises towards grazing with powers of 1/cos theta_d; it ends where i and
 * r are both within 0.1 deg of the horizon. Its weight, like that of z, was tried on tables of
 * Gaussian lobes, scattered and in grids: half or double make ln f err by up to twice as much. */
static void coordinates(const table_place *p, double scale, bool in_plane, double x[DIMENSIONS])
{
    static const double WEIGHT_Y = 0.6, END = 1.0 - 1e-3;
    const double q = p->theta_h / scale, half = sin(0.5 * p->theta_d);
    x[0] = 0.5 * log1p(q * q);
    x[1] = -WEIGHT_Y * log1p(-fmin(2.0 * half * half, END)); /* 2 sin^2(d/2) = 1 - cos d */
    x[2] = in_plane ? 0.0 : p->tilt;
}

/* ------------------------------------------------------------------ nearest nodes */

/* The nearest nodes found so far, by distance. */
typedef struct nearest {
    const double *x; /* from where */
    int n, most;
    double distance2[NEAREST + 1];
    const double *record[NEAREST + 1];
} nearest;

static void offer(nearest *found, const double *record)
{
    double distance2 = 0.0;
    for (int j = 0; j < DIMENSIONS; j++) {
        const double away = record[RECORD_X + j] - found->x[j];
        distance2 += away * away;
    }
    if (found->n == found->most && distance2 >= found->distance2[found->n - 1]) return;
    int k = found->n < found->most ? found->n++ : found->n - 1;
    for (; k > 0 && found->distance2[k - 1] > distance2; k--) {
        found->distance2[k] = found->distance2[k - 1];
        found->record[k] = found->record[k - 1];
    }
    found->distance2[k] = distance2;
    found->record[k] = record;
}

/* Looks through records low..high-1 of the tree. */
static void search(const double *records, int low, int high, int axis, nearest *found)
{
    while (low < high) {
        const int middle = (low + high) / 2;
        const double *record = records + (size_t)middle * RECORD_SIZE;
        const double away = found->x[axis] - record[RECORD_X + axis];
        const int next = (axis + 1) % DIMENSIONS;
        offer(found, record);
        if (away < 0.0)
            search(records, low, middle, next, found);
        else
            search(records, middle + 1, high, next, found);
        if (found->n == found->most && away * away >= found->distance2[found->n - 1]) return;
        if (away < 0.0)
            low = middle + 1;
        else
            high = middle;
        axis = next;
    }
}

/* How many of n nodes count: not all, since one must tell how far the others reach. */
static int count_nearest(int n)
{
    return NEAREST < n ? NEAREST : n - 1;
}

/* ------------------------------------------------------------------ evaluation */

/* The plane through a node, kept in the range of its neighbours. */
static double plane_value(const double *record, const double x[DIMENSIONS])
{
    double z = record[RECORD_LOG_F];
    for (int j = 0; j < DIMENSIONS; j++)
        z += record[RECORD_GRADIENT + j] * (x[j] - record[RECORD_X + j]);
    return fmin(fmax(z, record[RECORD_LEAST]), record[RECORD_LARGEST]);
}

double table_scatter_log_f(const double *data, const table_place *p)
{
    const double *records = data + (size_t)data[TABLE_LINES];
    const int n = (int)data[TABLE_N_LINES];
    const bool in_plane = data[TABLE_IN_PLANE] != 0.0;
    double x[DIMENSIONS];
    if (n == 1) return records[RECORD_LOG_F];
    coordinates(p, data[TABLE_SCALE], in_plane, x);
    const int counted = count_nearest(n);
    nearest found = {.x = x, .most = counted + 1};
    search(records, 0, n, 0, &found);
    const double radius = sqrt(found.distance2[counted]);
    double sum = 0.0, weights = 0.0;
    for (int k = 0; k < counted; k++) {
        const double r = sqrt(found.distance2[k]);
        if (r == 0.0) return found.record[k][RECORD_LOG_F];
        const double part = (radius - r) / (radius * r), weight = part * part;
        sum += weight * plane_value(found.record[k], x);
        weights += weight;
    }
    /* all at one distance: none is nearer than the first that does not count */
    return weights > 0.0 ? sum / weights : found.record[0][RECORD_LOG_F];
}

/* ------------------------------------------------------------------ construction */

/* A node with its coordinates, while the tree is being made. */
static int compare_axis(const void *a, const void *b, int axis)
{
    const double x = ((const double *)a)[RECORD_X + axis], y = ((const double *)b)[RECORD_X + axis];
    return (x > y) - (x < y);
}

static int compare_x(const void *a, const void *b)
{
    return compare_axis(a, b, 0);
}

static int compare_y(const void *a, const void *b)
{
    return compare_axis(a, b, 1);
}

static int compare_z(const void *a, const void *b)
{
    return compare_axis(a, b, 2);
}

static void make_tree(double *records, int n, int axis)
{
    static int (*const compare[DIMENSIONS])(const void *, const void *) = {compare_x, compare_y,
                                                                           compare_z};
    if (n < 2) return;
    qsort(records, (size_t)n, RECORD_SIZE * sizeof *records, compare[axis]);
    const int middle = n / 2, next = (axis + 1) % DIMENSIONS;
    make_tree(records, middle, next);
    make_tree(records + (size_t)(middle + 1) * RECORD_SIZE, n - middle - 1, next);
}

/* Solves the symmetric positive definite a g = b of three unknowns (Cholesky). */
static void solve3(double a[3][3], const double b[3], double g[3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            double sum = a[i][j];
            for (int k = 0; k < j; k++)
                sum -= a[i][k] * a[j][k];
            a[i][j] = i == j ? sqrt(sum) : sum / a[j][j];
        }
    for (int i = 0; i < 3; i++) {
        g[i] = b[i];
        for (int k = 0; k < i; k++)
            g[i] -= a[i][k] * g[k];
        g[i] /= a[i][i];
    }
    for (int i = 2; i >= 0; i--) {
        for (int k = i + 1; k < 3; k++)
            g[i] -= a[k][i] * g[k];
        g[i] /= a[i][i];
    }
}

/* The least-squares gradient of ln f at record found->record[0], from the others. */
static void fit_gradient(const nearest *found, double gradient[DIMENSIONS])
{
    static const double RIDGE = 1e-6; /* of the trace: directions without nodes get no slope */
    const double *centre = found->record[0];
    double a[3][3] = {{0}}, b[3] = {0};
    for (int k = 1; k < found->n; k++) {
        const double weight = 1.0 / fmax(found->distance2[k], 1e-30);
        const double rise = found->record[k][RECORD_LOG_F] - centre[RECORD_LOG_F];
        for (int i = 0; i < 3; i++) {
            const double away = found->record[k][RECORD_X + i] - centre[RECORD_X + i];
            b[i] += weight * away * rise;
            for (int j = 0; j < 3; j++)
                a[i][j] += weight * away * (found->record[k][RECORD_X + j] - centre[RECORD_X + j]);
        }
    }
    const double ridge = RIDGE * (a[0][0] + a[1][1] + a[2][2]);
    for (int i = 0; i < 3; i++)
        a[i][i] += ridge;
    solve3(a, b, gradient);
}

/* The range of ln f among a record and its neighbours. */
static void find_range(const nearest *found, double *least, double *largest)
{
    *least = *largest = found->record[0][RECORD_LOG_F];
    for (int k = 1; k < found->n; k++) {
        *least = fmin(*least, found->record[k][RECORD_LOG_F]);
        *largest = fmax(*largest, found->record[k][RECORD_LOG_F]);
    }
}

/* Scales the gradient so that halfway to each neighbour the plane is in the range of the values. */
static void restrain(const nearest *found, double least, double largest,
                     double gradient[DIMENSIONS])
{
    const double *centre = found->record[0];
    const double up = largest - centre[RECORD_LOG_F], down = least - centre[RECORD_LOG_F];
    double factor = 1.0;
    for (int k = 1; k < found->n; k++) {
        double half = 0.0;
        for (int j = 0; j < DIMENSIONS; j++)
            half += 0.5 * gradient[j] * (found->record[k][RECORD_X + j] - centre[RECORD_X + j]);
        if (half > up) factor = fmin(factor, up / half);
        if (half < down) factor = fmin(factor, down / half);
    }
    for (int j = 0; j < DIMENSIONS; j++)
        gradient[j] *= factor;
}

/* The theta_h that a fifth of the nodes do not reach: where the table is fine, so are the
 * distances. Tried on tables of Gaussian lobes, scattered and in grids; a tenth and a third do
 * about as well. */
static double find_scale(const table_node *nodes, int n)
{
    static const double FINEST = 1e-3; /* rad: finer lobes are blurred by the Sun's disc anyway */
    enum { PART = 5 };
    return fmax(nodes[n / PART].place.theta_h, FINEST);
}

void table_scatter_make(const table_node *nodes, int n, bool in_plane, table_data *data)
{
    const size_t at = table_data_add(data, NULL, (size_t)n * RECORD_SIZE);
    if (data->failed) return;
    double *records = data->at + at;
    const double scale = find_scale(nodes, n);
    data->at[TABLE_LINES] = (double)at;
    data->at[TABLE_N_LINES] = n;
    data->at[TABLE_SCALE] = scale;
    for (int k = 0; k < n; k++) {
        double *record = records + (size_t)k * RECORD_SIZE;
        coordinates(&nodes[k].place, scale, in_plane, record + RECORD_X);
        record[RECORD_LOG_F] = nodes[k].log_f;
    }
    make_tree(records, n, 0);
    for (int k = 0; k < n && n > 1; k++) {
        double *record = records + (size_t)k * RECORD_SIZE;
        nearest found = {.x = record, .most = count_nearest(n) + 1};
        search(records, 0, n, 0, &found);
        find_range(&found, &record[RECORD_LEAST], &record[RECORD_LARGEST]);
        fit_gradient(&found, record + RECORD_GRADIENT);
        restrain(&found, record[RECORD_LEAST], record[RECORD_LARGEST], record + RECORD_GRADIENT);
    }
}
