/* batch.h: pairs of directions that come one by one, on their way through the vectorised kernel;
 * private to this room. */
#ifndef GLINT_FACETS_BATCH_H
#define GLINT_FACETS_BATCH_H

#include "brdf/brdf.h"

#include <string.h>

/* A facet of 1 m^2 in its own frame: its areas are given as what is visible of it. */
extern const brdf_facets BATCH_FACET;

/* Pairs with the matter that they meet. A lane's sum does not depend on the other lanes but for
 * the grouping of its own pairs, which is the same in every run. */
typedef struct batch {
    const brdf_material *material;                        /* borrowed */
    _Alignas(64) double i[3][BRDF_TILE], r[3][BRDF_TILE]; /* unit; in the frame of the piece */
    double x[BRDF_TILE], y[BRDF_TILE]; /* slopes of the matter's normal in that frame */
    double area_m2[BRDF_TILE];
    int lane[BRDF_TILE]; /* of the light that they come from */
    int n;
    double sum[BRDF_TILE]; /* by these lanes, m^2/sr */
} batch;

/* Adds matter of that area with a pair of directions (unit, in the frame t, b, n of its piece), its
 * normal being t x + b y + n, made unit, its tangent t made orthogonal to that. */
void batch_push(batch *b, int lane, const double i[3], const double r[3], double x, double y,
                double area_m2);
/* Empties it; all of it need not be zero before. material: borrowed. */
static inline void batch_start(batch *b, const brdf_material *material)
{
    b->material = material;
    b->n = 0;
    memset(b->sum, 0, sizeof b->sum);
}

/* Sends what has been pushed through the kernel: `sum` is complete then. */
void batch_flush(batch *b);

#endif
