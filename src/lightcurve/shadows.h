/* shadows.h: the fraction of every facet that is lit and seen, for the rows of one tile. */
#ifndef GLINT_LIGHTCURVE_SHADOWS_H
#define GLINT_LIGHTCURVE_SHADOWS_H

#include "lightcurve/tile.h"

/* Fills worker.visible in the lanes whose rows are bright, in the way that the scenario asks for;
 * the worker has a plan. Errors: those of visibility_fill. */
glint_status shadows_fill(const glint_scenario *s, tile_worker *w, glint_error *error);

#endif
