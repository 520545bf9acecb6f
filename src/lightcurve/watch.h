/* watch.h: the satellite as one observer sees it at any moment, for searches that move through
 * time.
 */
#ifndef GLINT_LIGHTCURVE_WATCH_H
#define GLINT_LIGHTCURVE_WATCH_H

#include "lightcurve/geometry.h"

/* A watcher; zero-initialise, set `s` and the viewer's observer. One for each thread. */
typedef struct watch {
    const glint_scenario *s; /* borrowed */
    frame_grid *grid;        /* owned; covers from_s to to_s */
    double from_s, to_s;
    viewer viewer;
    double light_time_s; /* of the last look: the next guess */
} watch;

void watch_free(watch *w);
/* Has the frames of t_s at hand. Errors: GLINT_INTERNAL (memory). */
glint_status watch_cover(watch *w, double t_s, glint_error *error);
/* Errors: those of sighting_at. */
glint_status watch_at(watch *w, double t_s, sighting *out, glint_error *error);

#endif
