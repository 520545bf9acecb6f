/* lobe_tile.h: the light of one span of facets in one tile, where facets are curved or the source
 * is a disc; private to this room. */
#ifndef GLINT_FACETS_LOBE_TILE_H
#define GLINT_FACETS_LOBE_TILE_H

#include "facets/curved.h"
#include "facets/solar_disc.h"

/* As brdf_material_tile. curved: NULL where all facets are flat; band: of it, no other's same.
 * shapes: of the material's lobes. disc: NULL where the source is a point. A lane's result depends
 * on that lane alone. */
void lobe_tile(const curved_span *curved, int band, const brdf_material *material,
               const lobe_shape *shapes, const brdf_facets *facets, const brdf_light *light,
               const source_disc *disc, const double *visible, double sum[BRDF_TILE]);

#endif
