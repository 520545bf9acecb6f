/* oem.h: orbit ephemeris messages (CCSDS 502.0-B-3, section 5), KVN and XML. */
#ifndef GLINT_ORBIT_OEM_H
#define GLINT_ORBIT_OEM_H

#include "orbit/orbit_table.h"

/* Reads the table of one object. object: its name or id, letter case ignored; NULL: the only one of
 * the file. asked_from: where the file was asked for (PLACE_NONE allowed). Frames: EME2000 (J2000),
 * GCRF, ICRF, TEME, ITRF; times: see time_scale; centre: the Earth. Without INTERPOLATION the
 * method is Hermite's, and without INTERPOLATION_DEGREE the degree is 7 (1 if linear). Covariances
 * and accelerations are skipped. Errors (GLINT_INPUT), all of the object's: unreadable, another
 * message, a version above 3, no such object or several, a keyword missing or with a value that is
 * not taken, records that are not a time and six (or nine) numbers, a place inside the Earth or
 * farther than 1e7 km; and those of orbit_table_finish. Warnings: unknown keywords, records that
 * end before STOP_TIME. *out: end it with orbit_table_free; NULL on error. */
glint_status oem_read(const char *path, place asked_from, const char *object, orbit_table **out,
                      glint_errors *errors);

#endif
