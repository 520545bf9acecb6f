/* time_column.h: the times of a CSV table whose rows belong to moments. */
#ifndef GLINT_ORBIT_TIME_COLUMN_H
#define GLINT_ORBIT_TIME_COLUMN_H

#include "base/csv.h"
#include "orbit/clock.h"

/* Light leaves the satellite before it arrives, and a table of the observer's times begins when it
 * arrives: a table's first interval is drawn out backwards by this many s (0.3 s of light are
 * 90 000 km). */
#define TIME_LEAD_S 0.3
/* Dates come out to 1e-11 s: a table holds for this many s more than it says. */
#define TIME_SLACK_S 1e-6

/* Reads the column `t_s` (TT s from the start of the run) or `utc` (as in utc_parse) into t_s
 * (n_rows of the table): times that grow from row to row, within 2e9 s of the start. clock: NULL
 * where there is none (then `utc` is refused). Errors (GLINT_INPUT, all of them): neither column or
 * both; no rows; a cell that is no time; times that do not grow. */
glint_status time_column_read(const csv_table *table, const run_clock *clock, double *t_s,
                              glint_errors *errors);

#endif
