/* coverage.h: rows in which a measured material was lit and seen in directions that its table does
 * not cover. */
#ifndef GLINT_LIGHTCURVE_COVERAGE_H
#define GLINT_LIGHTCURVE_COVERAGE_H

#include "lightcurve/tile.h"

/* A material to be watched, and its measured lobes that do not cover the hemisphere, in all bands.
 */
typedef struct coverage_material {
    int material;            /* of the satellite */
    const brdf_lobe **lobes; /* owned array; borrowed from the satellite */
    int n_lobes;
} coverage_material;

/* All of them. Immutable after coverage_make; shared by threads. Borrows the satellite. */
typedef struct coverage {
    const satellite *sat;
    coverage_material *items; /* owned */
    int n;
} coverage;

/* Finds them. coverage_free ends *out in every case. Errors: GLINT_INTERNAL (memory). */
glint_status coverage_make(const satellite *sat, int n_bands, coverage *out, glint_error *error);
void coverage_free(coverage *c);

/* Marks the rows of a worker's tile after tile_worker_sum: outside[k n + j] becomes 1 where, in row
 * k, a facet of watched material j is lit and seen, with its own normal, in a pair of directions
 * that some measured lobe of the material (in any band) does not cover, and 0 elsewhere. outside:
 * (rows of the tile) x n. A row's marks depend on that row alone. */
void coverage_mark(const coverage *c, const tile_worker *w, unsigned char *outside);

#endif
