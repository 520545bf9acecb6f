/* sgp4_parts.h: what the files of the SGP4 propagator share; included by sgp4*.c alone.
 *
 * Inside the theory lengths are in equatorial radii of WGS72, times in minutes and angles in
 * radians. "STR3" is Spacetrack Report No. 3 (1980), whose symbols the comments give. */
#ifndef GLINT_ORBIT_SGP4_PARTS_H
#define GLINT_ORBIT_SGP4_PARTS_H

#include "base/constants.h"
#include "orbit/sgp4.h"

#include <math.h>

/* WGS72, with which element sets are made (AIAA 2006-6753). */
#define WGS72_RADIUS_KM 6378.135 /* km */
#define WGS72_MU_KM3_S2 398600.8 /* km^3/s^2 */
#define WGS72_J2 1.082616e-3     /* unnormalised zonal harmonics */
#define WGS72_J3 (-2.53881e-6)
#define WGS72_J4 (-1.65597e-6)

/* sqrt(mu) in Earth radii^1.5 / min (STR3: k_e); the compiler folds it. */
static inline double sgp4_ke(void)
{
    return 60.0 / sqrt(WGS72_RADIUS_KM * WGS72_RADIUS_KM * WGS72_RADIUS_KM / WGS72_MU_KM3_S2);
}

/* Mean elements at some time, or their rates per minute. */
typedef struct mean_elements {
    double mean_motion;                                                        /* rad/min */
    double eccentricity, inclination, raan, argument_of_perigee, mean_anomaly; /* rad */
} mean_elements;

/* The five combinations of elements that the Sun and the Moon perturb: eccentricity; inclination;
 * mean anomaly (STR3: l); argument of perigee plus cos i times node (gh); sin i times node (h). */
enum { LS_E, LS_I, LS_L, LS_GH, LS_H, LS_COUNT };

/* Periodic terms of one perturbing body. With f its true anomaly, combination k is perturbed by
 * cos2f[k] cos 2f + sin2f[k] sin 2f + sinf[k] sin f. */
typedef struct third_body {
    double anomaly0, anomaly_rate; /* mean anomaly at the epoch, rad; rad/min */
    double eccentricity;
    double cos2f[LS_COUNT], sin2f[LS_COUNT], sinf[LS_COUNT];
} third_body;

/* What the Sun and the Moon do to an orbit; immutable. */
typedef struct lunisolar {
    mean_elements rate; /* secular, per minute; mean_motion: 0 */
    third_body body[2];
} lunisolar;

/* Prepares the lunar and solar terms of an orbit. epoch_jd: quasi-JD of the epoch. */
void lunisolar_start(const mean_elements *epoch, double epoch_jd, lunisolar *out);
/* Adds the secular part, t minutes from the epoch. */
void lunisolar_add_secular(const lunisolar *ls, double t, mean_elements *m);
/* Adds the periodic part. The node must lie within a turn; the inclination comes out >= 0. */
void lunisolar_add_periodic(const lunisolar *ls, double t, mean_elements *m);

/* Resonance with the Earth's rotation. The resonant longitude is
 * lambda = M + with_perigee * omega + node_factor * (Omega - theta), theta the Greenwich angle. */
typedef struct resonance {
    bool active;
    double with_perigee, node_factor; /* 24 h: 1, 1; 12 h: 0, 2 */
    double theta0;                    /* Greenwich angle at the epoch, rad */
    double mean_motion0, longitude0;  /* rad/min, rad */
    double drift;                     /* d lambda/dt - n, rad/min */
    double argument0, argument_rate;  /* of perigee: rad, rad/min */
    double re[3][4], im[3][4];        /* harmonics, rad/min^2: see resonance_rates */
} resonance;

/* Finds out whether an orbit is resonant and prepares it. rate: all secular rates but the mean
 * motion's, of the Earth's figure (`figure`) and of Sun and Moon (`third`). */
void resonance_start(const mean_elements *epoch, const mean_elements *figure,
                     const mean_elements *third, double epoch_jd, resonance *out);
/* Puts the resonant mean motion and mean anomaly in *m, t minutes from the epoch; m's node and
 * perigee must be those of t. `of`: the propagator, to tell whether the cursor is its own. */
void resonance_apply(const resonance *r, double t, const sgp4 *of, sgp4_cursor *cursor,
                     mean_elements *m);

#endif
