/* watch.h: the satellite as one observer sees it at any moment, for searches that move through
 * time.
 */
#ifndef GLINT_LIGHTCURVE_WATCH_H
#define GLINT_LIGHTCURVE_WATCH_H

#include "lightcurve/geometry.h"

/* A watcher; zero-initialise, set `s` and the viewer's observer. One for each thread. */
typedef struct watch {
    const glint_scenario *s; /* borrowed */
    frame_grid *grid;        /* owned unless borrowed; covers from_s to to_s */
    double from_s, to_s;
    bool borrowed;
    viewer viewer;
    double light_time_s; /* of the last look: the next guess */
} watch;

void watch_free(watch *w);
/* Has the frames from first_s to last_s at hand: 90 kB a year of them. Errors: GLINT_INTERNAL
 * (memory). */
glint_status watch_cover(watch *w, double first_s, double last_s, glint_error *error);
/* Takes the frames of another watcher, which must not move while they are in use; any number of
 * threads may. */
void watch_borrow(watch *w, const watch *lender);
/* Errors: those of sighting_at. */
glint_status watch_at(watch *w, double t_s, sighting *out, glint_error *error);

#endif
