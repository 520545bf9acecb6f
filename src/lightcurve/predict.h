/* predict.h: rows at moments of one's own choice, over threads. */
#ifndef GLINT_LIGHTCURVE_PREDICT_H
#define GLINT_LIGHTCURVE_PREDICT_H

#include "scenario/scenario.h"

/* Takes the row of moment k; called once for each, by any thread. */
typedef void predict_taker(void *context, size_t k, const glint_row *row);

/* Computes the rows of n moments t_s (TT s from the start, in the order of time) as `who`, of the
 * scenario's observers, sees them: averaged over exposures where the scenario has them. threads: 0:
 * all processors. The rows are the same on any number of threads. Errors: GLINT_ARGUMENT (threads
 * below 0 or above 1024); those of a run at some moment; GLINT_INTERNAL. */
glint_status predict_rows(const glint_scenario *s, const scenario_observer *who, const double *t_s,
                          size_t n, int threads, predict_taker *take, void *context,
                          glint_error *error);

#endif
