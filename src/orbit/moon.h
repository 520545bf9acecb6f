/* moon.h: where the Moon is. */
#ifndef GLINT_ORBIT_MOON_H
#define GLINT_ORBIT_MOON_H

#include "orbit/clock.h"

#define MOON_RADIUS_M 1737.4e3 /* m, mean (IAU 2015 working group on cartographic coordinates) */

/* The Moon at two moments, between which one thread finds its place; what is found does not depend
 * on it. Zero-initialise. */
typedef struct moon_cursor {
    bool set;
    int64_t node;    /* the first moment: node times a step from J2000.0 TT */
    double pv[2][6]; /* place (m) and velocity (m/s) at that one and the next, GCRS */
} moon_cursor;

/* Geocentric position of the Moon, GCRS, m, geometric, t_s after the start of the clock. ERFA's
 * eraMoon98 (Meeus 1998: about 25 km, 14 arcsec) every half day and a cubic between, which is
 * within 0.4 km of it. cursor: NULL allowed. */
void moon_position(const run_clock *clock, double t_s, moon_cursor *cursor, double moon_gcrs_m[3]);

/* Illuminated fraction of the Moon's disc, seen from a point; moon_m, sun_m: from there. That of a
 * sphere: (1 + cos p)/2 with p the angle at the Moon between Sun and observer. */
double moon_illuminated(const double moon_m[3], const double sun_m[3]);

#endif
