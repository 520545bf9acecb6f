#include "orbit/horizon.h"

#include "base/constants.h"
#include "base/sorted.h"

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
    return (int)sorted_up_to(&h->points->azimuth, (size_t)h->n, sizeof *h->points, azimuth);
}

/* A straight piece of a mask: from point k to the next, whose azimuth is not below its own. */
typedef struct piece {
    double from, to;            /* azimuth, rad */
    double elevation[2], width; /* at its ends; its width, rad */
} piece;

static piece piece_at(const horizon *h, int k)
{
    const horizon_point *a = &h->points[(k + h->n) % h->n], *b = &h->points[(k + 1) % h->n];
    const double to = b->azimuth > a->azimuth ? b->azimuth : b->azimuth + TWO_PI;
    return (piece){a->azimuth, to, {a->elevation, b->elevation}, to - a->azimuth};
}

/* Number of the piece that an azimuth lies on; it may have to go up by a turn to lie within. */
static int piece_number(const horizon *h, double *azimuth)
{
    const int k = points_up_to(h, *azimuth) - 1;
    if (k >= 0) return k;
    *azimuth += TWO_PI;
    return h->n - 1;
}

double horizon_limit(const horizon *h, double azimuth)
{
    if (h->n == 0) return h->least;
    const piece p = piece_at(h, piece_number(h, &azimuth));
    const double part = (azimuth - p.from) / p.width;
    return fmax(h->least, p.elevation[0] + part * (p.elevation[1] - p.elevation[0]));
}

double horizon_room(const horizon *h, double azimuth)
{
    static const double PART = 0.25;
    if (h->n < 2) return TWO_PI;
    const int k = piece_number(h, &azimuth);
    const piece p = piece_at(h, k);
    const double narrowest =
        fmin(p.width, fmin(piece_at(h, k - 1).width, piece_at(h, k + 1).width));
    return fmax(PART * narrowest, fmin(azimuth - p.from, p.to - azimuth));
}
