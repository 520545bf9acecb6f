/* tile.h: one tile of rows from geometry to magnitudes, and what a thread needs for it. */
#ifndef GLINT_LIGHTCURVE_TILE_H
#define GLINT_LIGHTCURVE_TILE_H

#include "lightcurve/earthshine.h"
#include "lightcurve/photometry.h"

/* What one thread needs for a tile. */
typedef struct tile_worker {
    geometry_worker geometry;
    tile_geometry tile;
    brdf_light *lights;          /* owned; n_components */
    double *x;                   /* owned; n_bands x n_spans x TILE */
    const visibility *plan;      /* borrowed; NULL without shadows */
    visibility_scratch *scratch; /* owned; NULL without shadows */
    double *visible;             /* owned; n_facets x TILE; NULL without shadows */
    earthshine earth;
    source_disc disc; /* the Sun's, but for the radii, which every tile sets */
} tile_worker;

/* Plans the shadows that parts cast on each other; *out is NULL where none are wanted or none can
 * be. Errors: GLINT_INTERNAL (memory); those of visibility_use_rays. */
glint_status tile_plan_shadows(const glint_scenario *s, visibility **out, glint_error *error);

/* Work space of all threads for shadows, bytes: more is neither needed nor to be had everywhere. */
#define TILE_MOST_SHADOW_BYTES (4.0 * 1024 * 1024 * 1024)

/* The number of threads that a caller's word stands for: 1 to 1024, or all processors for 0.
 * Errors: GLINT_ARGUMENT (any other number). */
glint_status tile_count_threads(int wanted, int *n_threads, glint_error *error);

/* How many of `wanted` (1 or more) threads have room for the shadows of n_facets facets in
 * TILE_MOST_SHADOW_BYTES. Errors: GLINT_INPUT when not even one has. */
glint_status tile_fit_threads(int n_facets, bool has_earth, int wanted, int *n_threads,
                              glint_error *error);

/* plan: of tile_plan_shadows, must outlive the worker. Errors: GLINT_INTERNAL (memory);
 * tile_worker_free ends *out in every case. */
glint_status tile_worker_make(const glint_scenario *s, const visibility *plan, tile_worker *out,
                              glint_error *error);
void tile_worker_free(tile_worker *w);

/* From the worker's tile and lights, which geometry_fill has filled, to rows: visibility, sum,
 * photometry. Errors: those of visibility_fill. */
glint_status tile_worker_sum(const glint_scenario *s, tile_worker *w, const photometry_rows *rows,
                             glint_error *error);

/* Does tile number `tile` on a thread, 0 to n_threads - 1. */
typedef glint_status tile_task(void *context, int thread, int64_t tile, glint_error *error);

/* Does tiles 0 to n_tiles - 1, in any order, over n_threads threads: what becomes of a tile must
 * not depend on the others nor on the thread. The error of the earliest tile that fails is told. */
glint_status tiles_do(tile_task *task, void *context, int64_t n_tiles, int n_threads,
                      glint_error *error);

#endif
