/* exposure.h: light averaged over the time in which a camera's shutter is open. */
#ifndef GLINT_LIGHTCURVE_EXPOSURE_H
#define GLINT_LIGHTCURVE_EXPOSURE_H

#include "lightcurve/tile.h"

/* Largest difference between Gauss's and Kronrod's sums of one interval, as a part of the whole
 * exposure's in the brightest band. */
#define EXPOSURE_TOLERANCE 1e-8

/* What one thread needs for averaging; zero-initialise. */
typedef struct exposure_worker {
    photometry_rows rows;   /* owned; TILE: samples */
    double *panels, *stack; /* owned; see exposure.c */
    size_t n_panels, panel_capacity, n_stack, stack_capacity;
    double
        largest_step; /* rad: of the Sun and the observer, together, between neighbouring samples */
} exposure_worker;

/* Errors: GLINT_INTERNAL (memory). exposure_worker_free ends *out in every case. */
glint_status exposure_worker_make(const glint_scenario *s, exposure_worker *out,
                                  glint_error *error);
void exposure_worker_free(exposure_worker *e);

/* Puts the mean over exposure_s, centred on each row's time, in the place of fluxes, magnitudes and
 * shares of n rows that a tile was turned into, and says in their flags which means are dark. grid:
 * covers the exposures. The worker's tile is used up.
 *
 * Adaptive bisection with Kronrod's 15 points. No interval counts before the directions to the Sun
 * and to the observer, in the axes of every component, move by less than largest_step from sample
 * to sample: a quarter of the Sun's radius, or half the narrowest lobe, at least. A lobe, and a
 * mirror's image that crosses more of the disc than that, is so met by samples however short it is.
 * Then intervals are halved down to the tolerance. Errors: those of geometry_fill_at; GLINT_INPUT
 * where that takes more than some millions of samples; GLINT_INTERNAL (memory). */
glint_status exposure_average(const glint_scenario *s, const frame_grid *grid, tile_worker *w,
                              exposure_worker *e, int n, const photometry_rows *rows,
                              glint_error *error);

#endif
