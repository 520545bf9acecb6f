/* orbit.h: one face for all propagators: where the satellite is at a moment of the run. */
#ifndef GLINT_ORBIT_ORBIT_H
#define GLINT_ORBIT_ORBIT_H

#include "orbit/clock.h"
#include "orbit/frames.h"
#include "orbit/kepler.h"
#include "orbit/orbit_table.h"
#include "orbit/sgp4.h"
#include "orbit/tle.h"

/* A propagator tied to a run's clock; immutable and shared by threads. */
typedef struct orbit orbit;

/* What one thread keeps between calls; results do not depend on it. Zero-initialise, and again when
 * an orbit that it was used with is freed. */
typedef struct orbit_cursor {
    sgp4_cursor sgp4;
} orbit_cursor;

/* An element set of an orbit and when it is used. */
typedef struct orbit_set_use {
    size_t index;        /* in the list that the orbit was made from */
    double epoch_s;      /* TT s from the start */
    double from_s, to_s; /* TT s from the start; -INFINITY and INFINITY at the ends */
    bool has_jump;       /* false for the first, and where one of the two sets has decayed */
    double jump_m;       /* how far the satellite moves where this set takes over */
} orbit_set_use;

/* From element sets of one satellite in the order of their epochs (copied): at any moment the one
 * whose epoch is nearest is used, halfway between two the earlier one. Those that are nearest to no
 * moment of from_s..to_s (TT s from the start) are left out. Errors: those of sgp4_new. */
glint_status orbit_from_sets(const tle *sets, size_t n, const run_clock *clock, double from_s,
                             double to_s, orbit **out, glint_error *error);
/* The sets in use, in the order of time: n of them; NULL and 0 for other orbits. Borrowed. */
const orbit_set_use *orbit_sets(const orbit *o, size_t *n);
/* From a table of positions, which is taken over in any case. Errors: GLINT_INTERNAL (memory). */
glint_status orbit_from_table(orbit_table *table, const run_clock *clock, orbit **out,
                              glint_error *error);
/* The table of such an orbit, and through reference_s its reference in TT s from the start (NULL
 * allowed); NULL for other orbits. Borrowed. */
const orbit_table *orbit_table_of(const orbit *o, double *reference_s);
/* From Kepler elements (GCRS axes) at epoch_s (TT s from the start). j2: with the secular drift, J2
 * of WGS84. Errors: those of kepler_start; GLINT_INPUT: perigee below the equatorial radius, naming
 * its height. */
glint_status orbit_from_kepler(const kepler_elements *elements, double epoch_s, bool j2,
                               orbit **out, glint_error *error);
/* Fixed in ITRS on the equator at that longitude (rad). Errors: GLINT_INTERNAL (memory). */
glint_status orbit_geostationary(double longitude, orbit **out, glint_error *error);
void orbit_free(orbit *o);

/* The frame that the propagator works in decides what frames are wanted: FRAMES_TEME or 0. */
unsigned orbit_wanted_frames(const orbit *o);
/* Position (m) and inertial velocity (m/s) in GCRS at t_s; frames: of that moment, with what
 * orbit_wanted_frames asks for (Kepler orbits need none: NULL allowed); cursor: NULL allowed.
 * Velocities are turned, not differentiated: the frames' own rates are left out (7e-12 rad/s:
 * nothing), but an Earth-fixed orbit gets omega x r. Errors: GLINT_INPUT (decayed, outside a table,
 * ...), saying when. */
glint_status orbit_state(const orbit *o, double t_s, const frame_set *frames, orbit_cursor *cursor,
                         double r_gcrs_m[3], double v_gcrs_m_s[3], glint_error *error);

#endif
