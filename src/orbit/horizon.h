/* horizon.h: how high the horizon of a site is, all around. */
#ifndef GLINT_ORBIT_HORIZON_H
#define GLINT_ORBIT_HORIZON_H

#include "base/error.h"

/* A point of a mask. */
typedef struct horizon_point {
    double azimuth, elevation; /* rad; azimuth 0..2 pi */
    int index;                 /* its place in the order given, from 0 */
} horizon_point;

/* What an observer cannot see: everything below `least`, and below the mask where there is one. */
typedef struct horizon {
    double least;           /* rad: min_elevation_deg */
    horizon_point *points;  /* owned; in the order of their azimuths, all different; NULL: none */
    int n;                  /* of points; 0: no mask */
    double lowest, highest; /* rad: the limits of the limit, over all azimuths */
} horizon;

/* Makes a horizon. points: n of them in any order, azimuths -2 pi to 2 pi, elevations -pi/2..pi/2;
 * taken over (from malloc), NULL where n is 0. Points that are equal, as those at 0 and 360 deg may
 * be, count once. Returns the index of a point whose azimuth another one has at another elevation,
 * which leaves the mask undefined; -1 when all is well. horizon_free ends it in both cases. */
int horizon_make(double least, horizon_point *points, int n, horizon *out);
void horizon_free(horizon *h);

/* The elevation (rad) below which nothing is seen at an azimuth of 0..2 pi: linear between the
 * points, all around, and never below `least`. */
double horizon_limit(const horizon *h, double azimuth);
/* How far one may go in azimuth, either way, and be still on the same straight piece of the mask,
 * or past its end by no more than a quarter of the narrowest of it and its neighbours; rad. */
double horizon_room(const horizon *h, double azimuth);

#endif
