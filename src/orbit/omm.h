/* omm.h: orbit mean-elements messages (CCSDS 502.0-B-3, section 4) as KVN, XML, JSON and CSV, the
 * latter two as CelesTrak and Space-Track give them. */
#ifndef GLINT_ORBIT_OMM_H
#define GLINT_ORBIT_OMM_H

#include "orbit/tle.h"

/* Reads the element sets of one satellite from a file of one or more messages; the notation is told
 * by the content. The theory must be SGP4 (SGP4-XP is refused by name), the frame TEME, the centre
 * the Earth, the time system UTC: KVN and XML must say so, JSON and CSV may leave it out. Other
 * keywords than those that SGP4 needs are not looked at. asked_from: where the file was asked for
 * (PLACE_NONE allowed). Errors (GLINT_INPUT): unreadable; not of these notations; those of
 * element_sets_choose; in the sets that fit, all that is missing, no number or out of range (as for
 * two-line sets). A last line of KVN or CSV without its line end is left out with a warning. *out
 * is empty on error; end it with tle_list_free. */
glint_status omm_file_read(const char *path, place asked_from, const tle_query *query,
                           tle_list *out, glint_errors *errors);

#endif
