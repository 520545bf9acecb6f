/* hinge.h: how a component turns about its hinge. */
#ifndef GLINT_ORBIT_HINGE_H
#define GLINT_ORBIT_HINGE_H

#include "orbit/direction.h"

typedef enum hinge_drive { HINGE_FIXED, HINGE_RATE, HINGE_TRACK } hinge_drive;

/* A hinge; plain data. At angle 0 the component's axes are its parent's; positive angles are
 * right-handed about `axis`. */
typedef struct hinge {
    double origin_m[3]; /* parent's coordinates */
    double axis[3];     /* unit; the same numbers in the parent and in the component */
    hinge_drive drive;
    double angle; /* rad: fixed, or at epoch_s */
    double rate_rad_s, epoch_s;
    direction target; /* HINGE_TRACK */
    double face[3];   /* unit, component's axes, made normal to the axis: turned towards target */
    double offset;    /* rad, added to whatever the drive gives */
    bool has_limits;
    double limits[2]; /* rad; applied last */
} hinge;

/* Prepares `face`: takes its part normal to the axis, which must be set. face: component's axes,
 * any length. Errors (GLINT_INPUT, at `where`): face zero, or parallel to the axis within 1e-9.
 * Only for HINGE_TRACK. */
glint_status hinge_set_face(hinge *h, const double face[3], place where, glint_error *error);

/* The angle in rad, at t_s; target_parent: unit direction in the parent's axes (HINGE_TRACK only,
 * else NULL). delta = atan2(s.(a x n0), s.n0), then + offset, then clamped; a direction along the
 * axis (within 1e-9) gives 0, since no angle is better than another. */
double hinge_angle(const hinge *h, double t_s, const double target_parent[3]);
/* component_parent: v_component = R v_parent. */
void hinge_matrix(const hinge *h, double angle, double component_parent[9]);

#endif
