#include "lightcurve/tile.h"

#include "lightcurve/shadows.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

static void *aligned(size_t n, size_t size)
{
    const size_t bytes = (n * size + 63) / 64 * 64;
    void *memory = aligned_alloc(64, bytes ? bytes : 64);
    if (memory) memset(memory, 0, bytes ? bytes : 64);
    return memory;
}

glint_status tile_plan_shadows(const glint_scenario *s, visibility **out, glint_error *error)
{
    *out = NULL;
    if (s->self_shadows == SHADOWS_NONE) return GLINT_OK;
    glint_status status = satellite_plan_shadows(&s->satellite, out, error);
    const bool wanted = !status && !visibility_is_trivial(*out);
    if (wanted && s->self_shadows == SHADOWS_RAYS)
        status = visibility_use_rays(*out, &s->satellite.model, s->rays_per_facet, error);
    if (!wanted || status) {
        visibility_free(*out);
        *out = NULL;
    }
    return status;
}

glint_status tile_count_threads(int wanted, int *n_threads, glint_error *error)
{
    enum { MOST = 1024 };
    if (wanted < 0 || wanted > MOST)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "%d threads asked for; expected 1 to %d, or 0 for all processors", wanted,
                         MOST);
    *n_threads = wanted > 0 ? wanted : omp_get_num_procs();
    return GLINT_OK;
}

glint_status tile_fit_threads(int n_facets, bool has_earth, int wanted, int *n_threads,
                              glint_error *error)
{
    /* What visibility_scratch_make takes for a facet, bytes: its corners and its bounds as the Sun
     * and as the observer see them; rather too much. */
    static const double VIEWS = 768;
    const double fractions = (has_earth ? 3 : 1) * TILE * sizeof(double),
                 bytes = n_facets * (fractions + VIEWS);
    if (bytes > TILE_MOST_SHADOW_BYTES)
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "the shadows of %d facets take %.1f GB of work space; expected at most "
                         "%.1f GB: take fewer facets, or self_shadows = \"none\"",
                         n_facets, bytes * 1e-9, TILE_MOST_SHADOW_BYTES * 1e-9);
    const double fitting = floor(TILE_MOST_SHADOW_BYTES / fmax(bytes, 1.0));
    *n_threads = fitting < wanted ? (int)fitting : wanted;
    return GLINT_OK;
}

glint_status tile_worker_make(const glint_scenario *s, const visibility *plan, tile_worker *w,
                              glint_error *error)
{
    const model *m = &s->satellite.model;
    const size_t n_components = (size_t)m->n_components;
    *w = (tile_worker){.plan = plan};
    source_disc_start(&w->disc, s->solar_disc == SOLAR_LIMB_DARKENED);
    w->lights = aligned(n_components, sizeof *w->lights);
    w->x = aligned((size_t)m->n_bands * (size_t)m->n_spans * TILE, sizeof *w->x);
    w->geometry.component_gcrs = calloc(n_components, sizeof *w->geometry.component_gcrs);
    if (!w->lights || !w->x || !w->geometry.component_gcrs) return error_no_memory(error);
    if (plan || s->earth.source) {
        w->geometry.poses = calloc(TILE * n_components, sizeof *w->geometry.poses);
        if (!w->geometry.poses) return error_no_memory(error);
    }
    const glint_status status = earthshine_make(s, plan != NULL, &w->earth, error);
    if (status || !plan) return status;
    w->visible = aligned((size_t)m->n_facets * TILE, sizeof *w->visible);
    if (!w->visible) return error_no_memory(error);
    return visibility_scratch_make(plan, &w->scratch, error);
}

void tile_worker_free(tile_worker *w)
{
    free(w->lights);
    free(w->x);
    free(w->geometry.component_gcrs);
    free(w->geometry.poses);
    free(w->geometry.body);
    free(w->visible);
    earthshine_free(&w->earth);
    visibility_scratch_free(w->scratch);
    *w = (tile_worker){0};
}

/* The Sun's disc in every lane, a point in those that nobody asks for; NULL where all of them take
 * the Sun for a point. */
static const source_disc *disc_of(const glint_scenario *s, tile_worker *w)
{
    const tile_geometry *tile = &w->tile;
    if (s->solar_disc == SOLAR_POINT) return NULL;
    for (int k = 0; k < TILE; k++) {
        const bool bright = k < tile->n && tile->seen[k] && tile->sun_weight[k] > 0;
        source_disc_set(&w->disc, k, bright ? tile->sun_radius[k] : 0);
    }
    return &w->disc;
}

glint_status tile_worker_sum(const glint_scenario *s, tile_worker *w, const photometry_rows *rows,
                             glint_error *error)
{
    if (w->tile.any_bright && w->plan) {
        const glint_status status = shadows_fill(s, w, error);
        if (status) return status;
    }
    if (w->tile.any_bright)
        model_sum(&s->satellite.model, w->lights, disc_of(s, w), w->visible, w->x);
    bool has_earth = false;
    if (s->earth.source) {
        const glint_status status = earthshine_fill(s, w->plan, w->scratch, &w->geometry, &w->tile,
                                                    w->lights, &w->earth, &has_earth, error);
        if (status) return status;
    }
    photometry_fill(s, &w->tile, w->tile.any_bright ? w->x : NULL, has_earth ? w->earth.x : NULL,
                    rows);
    return GLINT_OK;
}

glint_status tiles_do(tile_task *task, void *context, int64_t n_tiles, int n_threads,
                      glint_error *error)
{
    int64_t failed_tile = n_tiles;
    glint_status failed = GLINT_OK;
#pragma omp parallel for schedule(dynamic) num_threads(n_threads) if (n_tiles > 1 && n_threads > 1)
    for (int64_t tile = 0; tile < n_tiles; tile++) {
        glint_error own = {0};
        const glint_status status = task(context, omp_get_thread_num(), tile, &own);
        if (!status) continue;
#pragma omp critical(glint_first_error)
        if (tile < failed_tile) {
            failed_tile = tile;
            failed = status;
            if (error) *error = own;
        }
    }
    return failed;
}
