/* torque_free.h: the rotation of a rigid body on which no torque acts, in closed form. */
#ifndef GLINT_ORBIT_TORQUE_FREE_H
#define GLINT_ORBIT_TORQUE_FREE_H

#include "orbit/elliptic.h"

/* A rotation, prepared for any moment; plain data. Axes i, j, k are a permutation of the body's
 * principal axes: j has the middle moment of inertia, and the angular momentum circles about k. */
typedef struct torque_free {
    int i, j, k;
    double amplitude[3];   /* rad/s, of the rates about i, j, k; the signs of j and k included */
    double side_i, side_j; /* unitless: direction of the momentum's part normal to k */
    double inertia[3];     /* kg m^2, of i, j, k */
    double momentum;       /* N m s */
    double u0, rate;       /* Jacobi argument: u = u0 + rate t */
    double pi0;            /* the third integral at u0 */
    double precession,
        nutation; /* rad/s: azimuth = precession t + nutation (Pi(u) - Pi(u0)) / rate */
    elliptic e;
    double start_from_momentum[9]; /* inertial from the momentum's frame at t = 0 */
    double steady_axis[3],
        steady_rate;        /* unit, body; rad/s: the body turns steadily where is_steady */
    double steady_start[9]; /* body_inertial at t = 0 */
    int is_steady;          /* all moments equal, or no rotation at all */
} torque_free;

/* inertia: principal moments about body x, y, z, kg m^2, > 0; rates: body rates at t = 0, rad/s;
 * body_inertial: v_body = R v_inertial at t = 0.
 * Closed form: Landau and Lifshitz, Mechanics, section 37; the precession angle as in Whittaker,
 * Analytical Dynamics, section 69. */
void torque_free_start(const double inertia[3], const double rates[3],
                       const double body_inertial[9], torque_free *out);
/* The body never turns faster, rad/s. */
double torque_free_fastest(const torque_free *b);
/* Attitude and body rates (rad/s; NULL allowed) t_s after (before, if negative) the start. */
void torque_free_at(const torque_free *b, double t_s, double body_inertial[9], double rates[3]);

#endif
