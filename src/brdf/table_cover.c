/* table_cover.c: which directions lie between the measurements.
 *
 * In two angles that a table spans: (theta_h, theta_d) where it was measured in the plane, the two
 * zenith angles where it is full. Both may change sign, and the zenith angles may be exchanged,
 * without a change of f; so the region is the convex hull of the nodes and their images. */
#include "base/constants.h"
#include "brdf/table_parts.h"

#include <math.h>
#include <stdlib.h>

/* Rounding of the angles: nodes on the rim count as covered. rad */
static const double RIM = 1e-9;

typedef struct point {
    double x, y;
} point;

static int compare_points(const void *a, const void *b)
{
    const point *p = a, *q = b;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : (p->y > q->y) - (p->y < q->y);
}

/* Twice the area of the triangle, positive when it runs anticlockwise. */
static double turn(const point *a, const point *b, const point *c)
{
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

/* The corners of the convex hull, anticlockwise (Andrew 1979, Information Processing Letters 9,
 * 216), into hull, which has room for n + 1; returns their number. Sorts the points. */
static int find_hull(point *points, int n, point *hull)
{
    int m = 0;
    qsort(points, (size_t)n, sizeof *points, compare_points);
    for (int pass = 0; pass < 2; pass++) {
        const int start = m;
        for (int k = 0; k < n; k++) {
            const point *p = &points[pass == 0 ? k : n - 1 - k];
            while (m >= start + 2 && turn(&hull[m - 2], &hull[m - 1], p) <= 0.0)
                m--;
            hull[m++] = *p;
        }
        m--; /* the last point starts the other half */
    }
    return m > 0 ? m : 1;
}

static double zenith(const double v[3])
{
    return atan2(hypot(v[0], v[1]), v[2]);
}

/* Azimuth between two directions, rad, 0 to pi; false near normal incidence, where it means little
 * (and nothing to an isotropic surface). */
static bool azimuth_between(const double i[3], const double r[3], double *azimuth)
{
    static const double NORMAL = 1e-6; /* product of the sines of both zenith angles */
    const double cross = i[0] * r[1] - i[1] * r[0], dot = i[0] * r[0] + i[1] * r[1];
    *azimuth = atan2(fabs(cross), dot);
    return hypot(cross, dot) > NORMAL;
}

/* Hull of the points and their images under changes of sign and, if so wanted, exchange. */
static bool add_hull(const point *points, int n, bool exchange, table_data *data)
{
    const int images = exchange ? 8 : 4;
    const size_t most = (size_t)images * (size_t)n;
    point *all = malloc((2 * most + 1) * sizeof *all), *hull = all + most;
    if (!all) {
        data->failed = true;
        return false;
    }
    for (size_t k = 0; k < most; k++) {
        const point *p = &points[k / (size_t)images];
        const size_t image = k % (size_t)images;
        const bool swap = image & 4;
        const double x = swap ? p->y : p->x, y = swap ? p->x : p->y;
        all[k] = (point){image & 1 ? -x : x, image & 2 ? -y : y};
    }
    const int m = find_hull(all, (int)most, hull);
    const size_t at = table_data_add(data, NULL, 2 * (size_t)m);
    for (int k = 0; k < m && !data->failed; k++) {
        data->at[at + 2 * (size_t)k] = hull[k].x;
        data->at[at + 2 * (size_t)k + 1] = hull[k].y;
    }
    free(all);
    if (data->failed) return false;
    data->at[TABLE_HULL] = (double)at;
    data->at[TABLE_N_HULL] = m;
    return true;
}

static void find_azimuths(const measured *rows, double *least, double *largest)
{
    *least = PI;
    *largest = 0.0;
    for (int k = 0; k < rows->n; k++) {
        double azimuth;
        if (!azimuth_between(rows->points[k].i, rows->points[k].r, &azimuth)) continue;
        *least = fmin(*least, azimuth);
        *largest = fmax(*largest, azimuth);
    }
}

bool table_cover_holds(const double *data, const double i[3], const double r[3])
{
    const double *hull = data + (size_t)data[TABLE_HULL]; /* x, y of each corner */
    const int n = (int)data[TABLE_N_HULL];
    point p;
    if (data[TABLE_IN_PLANE] != 0.0) {
        table_place at;
        table_find_place(i, r, &at);
        p = (point){at.theta_h, at.theta_d};
        if (p.x + p.y > PI / 2.0 + RIM) return false;
    } else {
        double azimuth;
        p = (point){zenith(i), zenith(r)};
        if (azimuth_between(i, r, &azimuth) &&
            (azimuth < data[TABLE_AZIMUTH_MIN] - RIM || azimuth > data[TABLE_AZIMUTH_MAX] + RIM))
            return false;
    }
    for (int k = 0; k < n; k++) {
        const double *c = hull + 2 * (size_t)k, *d = hull + 2 * (size_t)((k + 1) % n);
        const point a = {c[0], c[1]}, b = {d[0], d[1]};
        if (turn(&a, &b, &p) < -RIM * hypot(b.x - a.x, b.y - a.y)) return false;
    }
    return true;
}

/* The part of all pairs of directions that is covered, each with the weight ci cr: the midpoint
 * rule over the squares of both sines and the azimuth between. */
static double find_covered(const double *data)
{
    enum { STEPS = 24 }; /* each way: to about 1 % */
    int covered = 0;
    for (int a = 0; a < STEPS; a++)
        for (int b = 0; b < STEPS; b++)
            for (int c = 0; c < STEPS; c++) {
                const double si2 = (a + 0.5) / STEPS, sr2 = (b + 0.5) / STEPS;
                const double azimuth = PI * (c + 0.5) / STEPS, sr = sqrt(sr2);
                const double i[3] = {sqrt(si2), 0.0, sqrt(1.0 - si2)};
                const double r[3] = {sr * cos(azimuth), sr * sin(azimuth), sqrt(1.0 - sr2)};
                covered += table_cover_holds(data, i, r);
            }
    return (double)covered / (STEPS * STEPS * STEPS);
}

void table_cover_make(const measured *rows, table_data *data)
{
    point *points = malloc((size_t)rows->n * sizeof *points);
    if (!points) {
        data->failed = true;
        return;
    }
    for (int k = 0; k < rows->n; k++) {
        const measured_point *row = &rows->points[k];
        table_place at;
        table_find_place(row->i, row->r, &at);
        points[k] = rows->in_plane ? (point){at.theta_h, at.theta_d}
                                   : (point){zenith(row->i), zenith(row->r)};
    }
    if (add_hull(points, rows->n, !rows->in_plane, data)) {
        find_azimuths(rows, &data->at[TABLE_AZIMUTH_MIN], &data->at[TABLE_AZIMUTH_MAX]);
        data->at[TABLE_COVERED] = find_covered(data->at);
    }
    free(points);
}
