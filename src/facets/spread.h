/* spread.h: a cone about the directions of a tile, with which facets are passed over that none of
 * them can concern; private to this room. */
#ifndef GLINT_FACETS_SPREAD_H
#define GLINT_FACETS_SPREAD_H

#include "base/vec.h"
#include "brdf/brdf.h"

/* The cone. */
typedef struct spread {
    double middle[3];    /* unit; 0 where the directions look every way */
    double cosine, sine; /* of the widest angle of a direction from it; cosine <= 0: no telling */
} spread;

/* Of the directions v, of any length. */
static inline spread spread_of(const double v[3][BRDF_TILE])
{
    spread s = {{0, 0, 0}, -1.0, 0.0};
    for (int k = 0; k < BRDF_TILE; k++)
        for (int j = 0; j < 3; j++)
            s.middle[j] += v[j][k];
    unit3(s.middle, s.middle);
    double least = 1.0;
    for (int k = 0; k < BRDF_TILE; k++) {
        const double one[3] = {v[0][k], v[1][k], v[2][k]};
        const double c = dot3(one, s.middle);
        if (!(c > 0.0)) return s;
        least = fmin(least, c / norm3(one));
    }
    s.cosine = least;
    s.sine = sqrt(fmax(0.0, 1.0 - least * least));
    return s;
}

/* False when the cosine of no direction to the normal is above the root of cosine2. */
static inline bool spread_can_be_near(const spread *s, const double normal[3], double cosine2)
{
    if (!(s->cosine > 0.0)) return true;
    const double c = dot3(s->middle, normal), limit = sqrt(cosine2);
    /* cos(reach + spread); the two together beyond 90 deg: do not judge */
    const double bound = limit * s->cosine - sqrt(1.0 - cosine2) * s->sine;
    return !(bound > 0.0) || c >= bound - 1e-12;
}

/* True when all directions are more than the angle of that sine above the plane, or all of them
 * more than that below it. */
static inline bool spread_is_off_plane(const spread *s, const double normal[3], double sine)
{
    return s->cosine > 0.0 && fabs(dot3(s->middle, normal)) > s->sine + sine + 1e-12;
}

#endif
