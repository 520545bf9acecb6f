/* attitude_law.h: the rows of the table of attitude laws, and what the laws share; for the files
 * attitude*.c alone. */
#ifndef GLINT_ORBIT_ATTITUDE_LAW_H
#define GLINT_ORBIT_ATTITUDE_LAW_H

#include "orbit/attitude.h"

extern const attitude_law attitude_nadir, attitude_rsw;          /* attitude_lvlh.c */
extern const attitude_law attitude_point, attitude_sun_pointing; /* attitude_point.c */
extern const attitude_law attitude_yaw_steering;                 /* attitude_point.c */
extern const attitude_law attitude_table_law;                    /* attitude_table.c */
extern const attitude_law attitude_inertial;                     /* attitude_inertial.c */
extern const attitude_law attitude_spin;                         /* attitude_spin.c */
extern const attitude_law attitude_torque_free;                  /* attitude_torque_free.c */

/* The right-handed triad of two directions, as rows: `first`, the part of `second` normal to it,
 * and their cross product. first, second: unit, in one frame. False where they are parallel within
 * DIRECTION_PARALLEL (or not numbers); `triad` is then not to be used. */
bool attitude_triad(const double first[3], const double second[3], double triad[9]);

/* body_gcrs of a body whose triad (rows, body coordinates) coincides with that in GCRS. */
void attitude_align(const double triad_body[9], const double triad_gcrs[9], double body_gcrs[9]);

#endif
