/* stk.h: ephemeris files of STK (.e). */
#ifndef GLINT_ORBIT_STK_H
#define GLINT_ORBIT_STK_H

#include "orbit/orbit_table.h"

/* Reads the table of a file. Rows: EphemerisTimePos, EphemerisTimePosVel, EphemerisTimePosVelAcc
 * (accelerations are skipped), in seconds from ScenarioEpoch, which is UTC. Axes: ICRF, Inertial,
 * J2000, TEMEOfDate, Fixed. Lagrange through InterpolationSamplesM1 + 1 rows (6 by default), or
 * Hermite through as many with their velocities. Segments part at the SegmentBoundaryTimes, and
 * where a time stands twice. asked_from: where the file was asked for (PLACE_NONE allowed). Errors
 * (GLINT_INPUT), all of the file: unreadable, not of this format, a file without its end or with
 * another number of rows than it says, other values, and those of orbit_table_finish. Warnings:
 * unknown keywords. *out: end it with orbit_table_free; NULL on error. */
glint_status stk_read(const char *path, place asked_from, orbit_table **out, glint_errors *errors);

#endif
