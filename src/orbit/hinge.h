/* hinge.h: how a component turns about its hinge. */
#ifndef GLINT_ORBIT_HINGE_H
#define GLINT_ORBIT_HINGE_H

#include "orbit/clock.h"
#include "orbit/direction.h"

typedef enum hinge_drive { HINGE_FIXED, HINGE_RATE, HINGE_TRACK, HINGE_TABLE } hinge_drive;

/* Angles over time. */
typedef struct hinge_table {
    double *t_s;   /* owned; n; TT s from the start, growing */
    double *angle; /* owned; n; rad */
    long n;
} hinge_table;

/* A hinge; hinge_free ends it. At angle 0 the component's axes are its parent's; positive angles
 * are right-handed about `axis`. */
typedef struct hinge {
    double origin_m[3]; /* parent's coordinates */
    double axis[3];     /* unit; the same numbers in the parent and in the component */
    hinge_drive drive;
    double angle; /* rad: fixed, or at epoch_s */
    double rate_rad_s, epoch_s;
    direction target;  /* HINGE_TRACK */
    double face[3];    /* unit, component's axes, made normal to the axis: turned towards target */
    hinge_table table; /* HINGE_TABLE */
    double offset;     /* rad, added to whatever the drive gives */
    bool has_limits;
    double limits[2]; /* rad; applied last */
} hinge;

/* Prepares `face`: takes its part normal to the axis, which must be set. face: component's axes,
 * any length. Errors (GLINT_INPUT, at `where`): face zero, or parallel to the axis within 1e-9.
 * Only for HINGE_TRACK. */
glint_status hinge_set_face(hinge *h, const double face[3], place where, glint_error *error);

/* Reads the angles of a table: CSV, columns t_s or utc, and angle_deg. clock: what utc is counted
 * from; NULL where there is none. shortest_way: angles that differ by full turns are the same, so
 * that from 350 to 10 deg the hinge turns by 20 deg; else the numbers are followed as they stand.
 * asked_from: place of the value that names the file. Warnings: a last row that may be cut is left
 * out; neighbours more than half a turn apart where the numbers stand. Errors (GLINT_INPUT, all of
 * the file). */
glint_status hinge_set_table(hinge *h, const char *path, bool shortest_way, const run_clock *clock,
                             place asked_from, glint_errors *errors);
/* Frees what a hinge owns. */
void hinge_free(hinge *h);

/* The angle in rad, at t_s; target_parent: unit direction in the parent's axes (HINGE_TRACK only,
 * else NULL). delta = atan2(s.(a x n0), s.n0), or straight between the rows of the table; then +
 * offset, then clamped; a direction along the axis (within 1e-9) gives 0, since no angle is better
 * than another. Errors (GLINT_INPUT): the table does not cover the moment. */
glint_status hinge_angle(const hinge *h, double t_s, const double target_parent[3], double *angle,
                         glint_error *error);
/* The first time after t_s at which a row of its table stands, and its rate may jump; INFINITY
 * where there is none. */
double hinge_next_change(const hinge *h, double t_s);
/* component_parent: v_component = R v_parent. */
void hinge_matrix(const hinge *h, double angle, double component_parent[9]);

#endif
