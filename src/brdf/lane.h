/* lane.h: what a model's formula is given: one pair of directions as seen from a facet. */
#ifndef GLINT_BRDF_LANE_H
#define GLINT_BRDF_LANE_H

#include "brdf/brdf.h"

/* One pair of directions in the facet's frame (t, b, n). H = i + r. */
typedef struct brdf_lane {
    double ci, cr;         /* i.n, r.n */
    double ht, hb, hn;     /* H.t, H.b, H.n = ci + cr */
    double hh, hlen;       /* |H|^2, |H| = 2 cos(half of the phase angle) */
    double it, ib, rt, rb; /* i.t, i.b, r.t, r.b */
} brdf_lane;

/* |i - r|^2 = 4 sin^2(half of the phase angle), precise also where the two nearly coincide. */
static inline double lane_difference2(const brdf_lane *l)
{
    const double t = l->it - l->rt, b = l->ib - l->rb, n = l->ci - l->cr;
    return t * t + b * b + n * n;
}

#endif
