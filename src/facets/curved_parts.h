/* curved_parts.h: what the two files of curved.h share; private to them. */
#ifndef GLINT_FACETS_CURVED_PARTS_H
#define GLINT_FACETS_CURVED_PARTS_H

#include "facets/batch.h"
#include "facets/curved.h"
#include "facets/solar_disc.h"
#include "facets/spread.h"

#define CURVED_ACTIVE 1.0
#define CURVED_OFF 0.004
#define CURVED_FINE 1.6
#define CURVED_NEAR 3.0
#define CURVED_CORE 4.0
#define CURVED_FAR 0.5
#define CURVED_FLAT 0.25

/* In place of the width of a lobe that has none, rad: the image of the Sun in a cylinder that is a
 * perfect mirror is found with pieces of 1.6 of these. */
#define CURVED_MIRROR_WIDTH 5e-5

/* One lobe of a material on the facets of a span in one tile: the user sets the first lines, the
 * rest is zero. */
typedef struct curved_tile {
    const curved_span *span;
    const curved_lobe *lobe;
    const lobe_shape *shape; /* of the same lobe */
    const brdf_facets *facets;
    const brdf_light *light;
    const source_disc *disc; /* NULL: the source is a point */
    batch *batch;            /* for its pairs; with the material */
    spread bisectors;
    double widest, longest_reach; /* of the lobe: width, rad; reach in any lane, in widths */
    double longest_disc;          /* of the disc, in widths */
} curved_tile;

void curved_tile_start(curved_tile *t);
/* Integrates facet k for the lanes whose highlight is near, and takes these lanes out of `left`,
 * the fractions that are lit and seen. False when there are none. */
bool curved_add_near(curved_tile *t, int k, double left[BRDF_TILE]);

#endif
