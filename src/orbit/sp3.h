/* sp3.h: precise orbits of navigation satellites (SP3-a to SP3-d; S. Hilla, "The Extended Standard
 * Product 3 Orbit Format", 2010 and 2016). */
#ifndef GLINT_ORBIT_SP3_H
#define GLINT_ORBIT_SP3_H

#include "orbit/orbit_table.h"

/* Reads the table of one satellite. satellite: its identifier, "G01", letter case ignored; NULL:
 * the only one of the file. Positions are Earth-fixed; they are interpolated by Lagrange's
 * polynomials of degree 9, whose derivatives are the velocities (the file's own are not used).
 * Epochs without a position (0 0 0) and missing ones part segments. Time systems: GPS, GAL, QZS,
 * UTC, GLO, TAI. asked_from: where the file was asked for (PLACE_NONE allowed). Errors
 * (GLINT_INPUT), all of the satellite's: unreadable, not of this format, a file without its EOF or
 * with another number of epochs than it says, no such satellite or several, other values, and those
 * of orbit_table_finish. *out: end it with orbit_table_free; NULL on error. */
glint_status sp3_read(const char *path, place asked_from, const char *satellite, orbit_table **out,
                      glint_errors *errors);

#endif
