/* sgp4.h: the SGP4/SDP4 analytic propagator with WGS72 constants, improved operation mode ('i').
 *
 * Source: D. A. Vallado, P. Crawford, R. Hujsak, T. S. Kelso, "Revisiting Spacetrack Report #3",
 * AIAA 2006-6753, which corrects F. R. Hoots and R. L. Roehrich, "Models for Propagation of NORAD
 * Element Sets", Spacetrack Report No. 3 (1980). */
#ifndef GLINT_ORBIT_SGP4_H
#define GLINT_ORBIT_SGP4_H

#include "orbit/tle.h"

/* The constants of one element set, computed once; immutable afterwards and shared by threads. */
typedef struct sgp4 sgp4;

/* Farthest time from the epoch that sgp4_state takes, min: a Julian century. Element sets serve for
 * days to weeks; the limit only bounds the work that a mistyped date can cause. */
#define SGP4_SPAN_MIN (36525.0 * 1440.0)

/* Where the resonance integrator of a deep-space orbit stands, so that a run in time order need not
 * integrate from the epoch at every call. Belongs to one thread; zero-initialise. A result does
 * not depend on it: not by one bit. It may be handed to several propagators in turn, but must be
 * zeroed when one that it was used with is freed. */
typedef struct sgp4_cursor {
    const sgp4 *of;                              /* borrowed, only compared; NULL: unset */
    double time_min;                             /* from the epoch, a multiple of 720 min */
    double mean_motion, longitude;               /* rad/min, rad: there */
    double mean_motion_dot, mean_motion_dot_dot; /* rad/min^2, rad/min^3: there */
} sgp4_cursor;

/* Prepares an element set; *out: free it with sgp4_free (NULL on error). Errors: GLINT_INPUT, with
 * the place of the set: an element not finite or out of range, an orbit inside the Earth;
 * GLINT_INTERNAL: out of memory. */
glint_status sgp4_new(const tle *elements, sgp4 **out, glint_error *error);
void sgp4_free(sgp4 *s);
/* True when the period is 225 min or longer (SDP4). */
bool sgp4_is_deep_space(const sgp4 *s);

/* Position (m) and velocity (m/s) in TEME of date, `minutes` from the epoch (negative: before it).
 * cursor: NULL allowed; without it, or with steps towards the epoch, the resonance of a 12 h or
 * 24 h orbit is integrated anew, in time proportional to |minutes|.
 * Errors (GLINT_INPUT, without a place; r and v are then left alone): `minutes` not finite or
 * beyond SGP4_SPAN_MIN; and, by name, as the published code numbers them: 1 mean eccentricity out
 * of range, 2 mean motion not positive, 3 perturbed eccentricity out of range, 4 semi-latus rectum
 * negative, 6 decayed (below the Earth's surface, or nothing of the orbit left by the drag terms).
 */
glint_status sgp4_state(const sgp4 *s, double minutes, sgp4_cursor *cursor, double r_teme_m[3],
                        double v_teme_m_s[3], glint_error *error);

#endif
