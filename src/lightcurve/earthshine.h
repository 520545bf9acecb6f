/* earthshine.h: the light of the lit Earth in one tile of rows, and what a thread needs for it. */
#ifndef GLINT_LIGHTCURVE_EARTHSHINE_H
#define GLINT_LIGHTCURVE_EARTHSHINE_H

#include "lightcurve/geometry.h"

/* Zero-initialised: no earthshine. */
typedef struct earthshine {
    globe_scratch *scratch; /* owned */
    double *x;              /* owned; n_bands x n_spans x TILE, m^2/sr times irradiance at 1 au */
    double *visible;        /* owned; n_facets x TILE; NULL without shadows */
    double *joint;          /* owned; the same, for one direction */
} earthshine;

/* Leaves *out zero where the scenario wants none. Errors: GLINT_INTERNAL (memory); earthshine_free
 * ends *out in every case. */
glint_status earthshine_make(const glint_scenario *s, bool has_shadows, earthshine *out,
                             glint_error *error);
void earthshine_free(earthshine *e);

/* Fills e->x from what geometry_fill has left (poses among it), for the rows that are seen; *any:
 * whether there is any light. plan, scratch: of the shadows, or NULL. A facet that sees the centre
 * of the lit ground (the mean direction of its light) shines with the part of its area that is open
 * both to that and to the observer, another facet with the part that the observer sees. Errors:
 * GLINT_INPUT when the satellite is not above the Earth's sphere; those of visibility_fill. */
glint_status earthshine_fill(const glint_scenario *s, const visibility *plan,
                             visibility_scratch *scratch, const geometry_worker *worker,
                             const tile_geometry *tile, const brdf_light *lights, earthshine *e,
                             bool *any, glint_error *error);

#endif
