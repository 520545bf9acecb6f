/* curve_plot.h: the picture of a light curve: magnitudes in all bands over time, and below them the
 * shares of materials and components; made as rows stream by, in constant memory. */
#ifndef GLINT_OUTPUT_CURVE_PLOT_H
#define GLINT_OUTPUT_CURVE_PLOT_H

#include "base/text.h"

/* What has been kept of a curve for its picture. */
typedef struct curve_plot curve_plot;

/* NULL when memory is out. The curve must outlive the picture. */
curve_plot *curve_plot_start(const glint_curve *curve);
void curve_plot_add(curve_plot *p, const glint_row *rows, size_t n);
/* Has the first band of another curve over the same times drawn behind: that of the satellite as it
 * is given, while `p` is that of a changed one. note: says below the title what was changed. Both
 * borrowed until curve_plot_write. */
void curve_plot_compare(curve_plot *p, const curve_plot *given, const char *note);
/* Appends the commands that draw it (plot.h); once, at the end. */
void curve_plot_write(curve_plot *p, text *script);
void curve_plot_free(curve_plot *p);

#endif
