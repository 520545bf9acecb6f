/* moon.h: where the Moon is. */
#ifndef GLINT_ORBIT_MOON_H
#define GLINT_ORBIT_MOON_H

#include "orbit/clock.h"

/* Geocentric position of the Moon, GCRS, m, geometric, t_s after the start of the clock (ERFA's
 * eraMoon98, Meeus 1998: about 25 km, 14 arcsec). Takes some microseconds. */
void moon_position(const run_clock *clock, double t_s, double moon_gcrs_m[3]);

#endif
