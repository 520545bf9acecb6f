/* eop.h: measured Earth orientation, from the files that the IERS publishes. */
#ifndef GLINT_ORBIT_EOP_H
#define GLINT_ORBIT_EOP_H

#include "base/error.h"

/* A table of UT1 and polar motion, one row for each day at 0h UTC; immutable. */
typedef struct eop_table eop_table;

/* Earth orientation at one moment. */
typedef struct eop_values {
    double ut1_minus_tai_s;
    double xp_rad, yp_rad; /* polar motion */
} eop_values;

/* Reads a file, known by its content: finals2000A (all, data, daily; the values of Bulletin A), or
 * a C04 series (with or without a column of hours). Values are taken from 1972 on, up to the first
 * day without UT1. asked_from: place of the value that names the file, for messages. Days must
 * follow each other, dates must fit their MJD, and values be plausible. A last line that lacks its
 * line end may be cut and is left out with a warning. Errors: GLINT_INPUT, all of the file with
 * their places; GLINT_INTERNAL (memory). eop_free ends *out. */
glint_status eop_read(const char *path, place asked_from, eop_table **out, glint_errors *errors);
/* NULL allowed. */
void eop_free(eop_table *table);

/* "finals2000A" or "C04"; the days (MJD, 0h UTC) of the first and the last row; the first day that
 * is a prediction, past the last where none is. */
const char *eop_format(const eop_table *table);
void eop_span(const eop_table *table, int *first_mjd, int *last_mjd, int *predicted_mjd);
/* True when a moment lies in the table. tt_jd: two-part JD of TT. */
bool eop_covers(const eop_table *table, const double tt_jd[2]);
/* Linear between the days (UT1-TAI, which knows no leap seconds); outside, the first or last two
 * days go on. */
void eop_at(const eop_table *table, const double tt_jd[2], eop_values *out);
/* A number that changes with the table's values. */
uint64_t eop_fingerprint(const eop_table *table);

#endif
