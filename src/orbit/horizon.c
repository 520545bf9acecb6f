#include "orbit/horizon.h"

#include "base/constants.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points of one azimuth leave the mask undefined; closer ones than this are taken for that. */
static const double SAME = 1e-12; /* rad */

/* Equal ones stay in the order given. */
static int by_azimuth(const void *a, const void *b)
{
    const horizon_point *x = a, *y = b;
    if (x->azimuth != y->azimuth) return x->azimuth > y->azimuth ? 1 : -1;
    return x->index - y->index;
}

/* 0 up to a full turn; what rounding leaves short of one is 0, too. */
static double within_a_turn(double azimuth)
{
    double turned = azimuth < 0 ? azimuth + TWO_PI : azimuth;
    if (turned >= TWO_PI) turned -= TWO_PI;
    return TWO_PI - turned < SAME || turned < 0 ? 0 : turned;
}

/* Leaves one of each azimuth; the index of a point that contradicts another, or -1. */
static int remove_equals(horizon *h)
{
    int kept = 0;
    for (int i = 0; i < h->n; i++) {
        const horizon_point *p = &h->points[i], *last = kept > 0 ? &h->points[kept - 1] : NULL;
        if (!last || p->azimuth - last->azimuth >= SAME)
            h->points[kept++] = *p;
        else if (p->elevation != last->elevation)
            return p->index > last->index ? p->index : last->index;
    }
    h->n = kept;
    return -1;
}

int horizon_make(double least, horizon_point *points, int n, horizon *out)
{
    *out = (horizon){.least = least, .points = points, .n = n, .lowest = least, .highest = least};
    if (n == 0) return -1;
    for (int i = 0; i < n; i++) {
        points[i].azimuth = within_a_turn(points[i].azimuth);
        points[i].index = i;
    }
    qsort(points, (size_t)n, sizeof *points, by_azimuth);
    const int twice = remove_equals(out);
    double lowest = points[0].elevation;
    for (int i = 0; i < out->n; i++) {
        lowest = fmin(lowest, points[i].elevation);
        out->highest = fmax(out->highest, points[i].elevation);
    }
    out->lowest = fmax(least, lowest);
    return twice;
}

void horizon_free(horizon *h)
{
    free(h->points);
    *h = (horizon){0};
}

/* Number of points whose azimuth is at most this one. */
static int points_up_to(const horizon *h, double azimuth)
{
    int lo = 0, hi = h->n;
    while (lo < hi) {
        const int middle = lo + (hi - lo) / 2;
        if (h->points[middle].azimuth <= azimuth)
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo;
}

double horizon_limit(const horizon *h, double azimuth)
{
    if (h->n == 0) return h->least;
    const int after = points_up_to(h, azimuth);
    const horizon_point *a = &h->points[after > 0 ? after - 1 : h->n - 1];
    const horizon_point *b = &h->points[after < h->n ? after : 0];
    const double from = after > 0 ? a->azimuth : a->azimuth - TWO_PI;
    const double to = after < h->n ? b->azimuth : b->azimuth + TWO_PI;
    const double part = (azimuth - from) / (to - from);
    return fmax(h->least, a->elevation + part * (b->elevation - a->elevation));
}

double horizon_spacing(const horizon *h)
{
    double least = TWO_PI;
    for (int i = 0; i < h->n && h->n > 1; i++) {
        const double next = i + 1 < h->n ? h->points[i + 1].azimuth : h->points[0].azimuth + TWO_PI;
        least = fmin(least, next - h->points[i].azimuth);
    }
    return least;
}
