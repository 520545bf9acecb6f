/* kepler.h: elliptic two-body motion, with the secular effect of J2 on request. */
#ifndef GLINT_ORBIT_KEPLER_H
#define GLINT_ORBIT_KEPLER_H

#include "base/error.h"

/* Elements at an epoch; mean elements where J2 acts. */
typedef struct kepler_elements {
    double semi_major_axis_m, eccentricity;                      /* e < 1 */
    double inclination, raan, argument_of_perigee, mean_anomaly; /* rad, of any size */
} kepler_elements;

/* An orbit prepared for many moments; immutable. */
typedef struct kepler_orbit {
    kepler_elements at_epoch;
    double mean_motion;              /* rad/s, with the J2 term */
    double raan_rate, argument_rate; /* rad/s */
    double semi_minor_axis_m;
    double speed_m_s; /* mean motion times semi-major axis */
    double sin_inclination, cos_inclination;
} kepler_orbit;

/* elements: in any inertial frame, which is then that of the states. mu: m^3/s^2; j2:
 * dimensionless, 0 for two-body motion; radius_m: equatorial radius that j2 is for. Secular rates:
 * Brouwer 1959, Astron. J. 64, 378, to first order in J2. Errors (GLINT_INPUT, no place):
 * eccentricity not in [0,1), semi-major axis not positive and finite, an angle not finite. */
glint_status kepler_start(const kepler_elements *elements, double mu_m3_s2, double j2,
                          double radius_m, kepler_orbit *out, glint_error *error);
/* Position (m) and its rate of change (m/s; the drift of the ellipse included) `dt_s` after the
 * epoch, of any sign. */
void kepler_state(const kepler_orbit *orbit, double dt_s, double r_m[3], double v_m_s[3]);
/* Eccentric anomaly, -pi to pi, of a mean anomaly of any size (rad), for 0 <= eccentricity < 1:
 * converges for every input. Start: Mikkola 1987, Celest. Mech. 40, 329; corrections of fourth
 * order: Danby and Burkardt 1983, Celest. Mech. 31, 95, held inside a bracket. */
double kepler_eccentric_anomaly(double mean_anomaly, double eccentricity);

#endif
