/* summary.h: what a run came to, in constant memory. */
#ifndef GLINT_OUTPUT_SUMMARY_H
#define GLINT_OUTPUT_SUMMARY_H

#include "base/error.h"

/* A summary being made. */
typedef struct summary_maker summary_maker;

/* NULL when memory is out. step_s: 0 where rows have no time; last_s: time of the run's last step.
 */
summary_maker *summary_start(double step_s, double last_s, bool has_utc);
void summary_add(summary_maker *maker, const glint_row *rows, size_t n);
void summary_finish(const summary_maker *maker, glint_summary *out);
void summary_free(summary_maker *maker);

#endif
