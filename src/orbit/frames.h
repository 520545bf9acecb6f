/* frames.h: GCRS, ITRS and TEME, the Sun, by ERFA on a coarse grid (physics page, section 5). */
#ifndef GLINT_ORBIT_FRAMES_H
#define GLINT_ORBIT_FRAMES_H

#include "orbit/clock.h"

/* Polar motion that a run assumes where its clock has no table of it; immutable. */
typedef struct earth_orientation {
    double xp_rad, yp_rad; /* polar motion */
} earth_orientation;

/* Slow quantities over a stretch of the run, tabulated at fixed moments (multiples of the grid step
 * from J2000.0 TT, so that the result at a moment never depends on how the run was cut into
 * blocks). X, Y, s every 0.25 d (4-point Lagrange); Sun and Earth every 0.5 d (cubic Hermite). A
 * run whose step is longer than 0.25 d has fewer moments than grid points: there they are evaluated
 * in full instead. Owned arrays; reading it changes nothing, so threads may share it. */
typedef struct frame_grid frame_grid;

/* Prepares a stretch from t0_s to t1_s (TT s from the clock's start, t0 <= t1; a margin of 2 s for
 * light times is added inside). clock, orientation: copied. step_s: the run's step, which alone
 * decides between the grid and full evaluation, so that all blocks of a run agree. *grid is made
 * when NULL, else used again: what it holds of the new stretch is kept. Moments outside the stretch
 * are answered with the same bits, but 500 times more slowly. Errors: GLINT_INTERNAL (memory);
 * *grid stays valid. */
glint_status frame_grid_prepare(const run_clock *clock, const earth_orientation *orientation,
                                double t0_s, double t1_s, double step_s, frame_grid **grid,
                                glint_error *error);
/* NULL allowed. */
void frame_grid_free(frame_grid *grid);

/* All that depends on time alone, at one moment. */
typedef struct frame_set {
    double itrs_gcrs[9];          /* v_itrs = R v_gcrs */
    double gcrs_teme[9];          /* v_gcrs = R v_teme; via ITRS, GMST82 (only if asked for) */
    double sun_gcrs_m[3];         /* geocentre to Sun, geometric (these three only if asked for) */
    double sun_velocity_m_s[3];   /* of the Sun relative to the barycentre, GCRS axes */
    double earth_velocity_m_s[3]; /* of the Earth relative to the barycentre, GCRS axes */
} frame_set;

enum { FRAMES_TEME = 1u, FRAMES_SUN = 2u }; /* what is wanted besides itrs_gcrs */
/* t_s: TT s from the clock's start. wanted: any of the flags above. GCRS to ITRS is CIO based IAU
 * 2006/2000A (IERS Conventions 2010, section 5.4); the Sun is ERFA's eraEpv00 with TT taken as TDB
 * (they differ by 2 ms, the Sun moves 0.05 km in that). Measured against full evaluation, 2000 to
 * 2050: directions to 2e-6 arcsec, the Sun's place to 10 m, velocities to 1e-3 m/s. */
void frame_grid_at(const frame_grid *grid, double t_s, unsigned wanted, frame_set *out);
/* The same of n moments at once, 1 <= n <= FRAME_LANES, to the same bits; a few times faster where
 * they stand within some hours. */
enum { FRAME_LANES = 32 };
void frame_grid_fill(const frame_grid *grid, const double *t_s, int n, unsigned wanted,
                     frame_set *out);

/* The mean equator and equinox of J2000.0 (EME2000, "J2000") against the axes of GCRS, 23 mas
 * apart: v_eme2000 = R v_gcrs. IAU 2006 frame bias (eraBp06). */
void frame_bias(double eme2000_gcrs[9]);

/* Direction and distance of the Sun from a point r_gcrs_m: unit vector and m. With aberration:
 * light time over the distance and stellar aberration by the Earth's barycentric velocity; without:
 * geometric. frames: must have been asked for FRAMES_SUN. distance_m: geometric in both cases. */
void sun_from_point(const frame_set *frames, const double r_gcrs_m[3], bool aberration,
                    double sun_gcrs[3], double *distance_m);

#endif
