#include "base/error.h"

#include "base/constants.h"
#include "lightcurve/columns.h"
#include "lightcurve/coverage.h"
#include "lightcurve/exposure.h"
#include "lightcurve/facts.h"
#include "lightcurve/tile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glint_version.h"

/* Rows that are computed together, a multiple of TILE: as many as these, so that threads rarely
 * wait for each other, but fewer where rows are wide. */
enum { BLOCK_MOST = 512 * TILE, BLOCK_NUMBERS = 1 << 22 };

struct glint_curve {
    const glint_scenario *s; /* borrowed */
    unsigned wanted;         /* of the geometry */
    visibility *plan;        /* owned; NULL where no shadows are wanted or none can be */
    int n_threads;
    tile_worker *workers;       /* owned; n_threads */
    exposure_worker *exposures; /* owned; n_threads; NULL where rows are samples */
    frame_grid *grid;           /* owned; covers grid_from_s to grid_to_s */
    double grid_from_s, grid_to_s;
    size_t block;           /* rows of a block */
    int64_t next;           /* first row of the next block: observer after observer */
    photometry_rows rows;   /* owned; block */
    glint_row *chosen;      /* owned; block */
    coverage watched;       /* measured materials */
    unsigned char *outside; /* owned; block x watched.n: of coverage_mark */
    int64_t *n_outside;     /* owned; watched.n: rows handed out so far of which that holds */
    column_set columns;
    fact_list facts;
};

static bool make_workers(glint_curve *c)
{
    c->workers = calloc((size_t)c->n_threads, sizeof *c->workers);
    if (!c->workers) return false;
    for (int i = 0; i < c->n_threads; i++)
        if (tile_worker_make(c->s, c->plan, &c->workers[i], NULL)) return false;
    if (!(c->s->exposure_s > 0)) return true;
    c->exposures = calloc((size_t)c->n_threads, sizeof *c->exposures);
    if (!c->exposures) return false;
    for (int i = 0; i < c->n_threads; i++)
        if (exposure_worker_make(c->s, &c->exposures[i], NULL)) return false;
    return true;
}

static bool make_rows(glint_curve *c)
{
    const model *m = &c->s->satellite.model;
    const size_t n_bands = (size_t)c->s->n_bands, n_materials = (size_t)m->n_materials,
                 n_components = (size_t)m->n_components;
    const size_t n_surfaces = (size_t)c->s->satellite.n_surfaces;
    const bool has_earth = c->s->earth.wanted;
    const size_t width = (has_earth ? 3 : 2) * n_bands + n_materials + n_components + n_surfaces;
    const size_t fitting = BLOCK_NUMBERS / width / TILE * TILE;
    c->block = fitting < TILE ? TILE : fitting > BLOCK_MOST ? BLOCK_MOST : fitting;
    c->chosen = calloc(c->block, sizeof *c->chosen);
    c->outside = calloc(c->block * (size_t)c->watched.n + 1, sizeof *c->outside);
    c->n_outside = calloc((size_t)c->watched.n + 1, sizeof *c->n_outside);
    return c->outside && c->n_outside && c->chosen &&
           !photometry_rows_make(c->s, c->block, &c->rows, NULL);
}

static bool asks_for_height(const glint_scenario *s)
{
    for (int i = 0; i < s->n_requirements; i++)
        if (s->requirements[i].has_reference) return true;
    return false;
}

glint_status glint_curve_open(const glint_scenario *scenario, int threads, glint_curve **out,
                              glint_errors *errors)
{
    *out = NULL;
    glint_error error = {0};
    int n_threads;
    glint_status status = tile_count_threads(threads, &n_threads, &error);
    if (status) return errors_take(errors, &error, PLACE_NONE);
    if (!scenario->has_satellite)
        return errors_add(
            errors, GLINT_ARGUMENT, PLACE_NONE,
            "this scenario was read without a satellite that could shine; expected one "
            "from glint_scenario_read");
    glint_curve *c = calloc(1, sizeof *c);
    if (!c) return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    c->s = scenario;
    c->n_threads = n_threads;
    if (asks_for_height(scenario)) c->wanted |= GEOMETRY_HEIGHT;
    if (scenario->moon_columns) c->wanted |= GEOMETRY_MOON;
    if (scenario->has_telescope) c->wanted |= GEOMETRY_RATE;
    status = column_set_make(scenario, &c->columns, &error);
    facts_of_run(scenario, &c->facts);
    if (!status) status = tile_plan_shadows(scenario, &c->plan, &error);
    if (!status)
        status = coverage_make(&scenario->satellite, scenario->n_bands, &c->watched, &error);
    if (!status && c->plan)
        status = tile_fit_threads(scenario->satellite.model.n_facets, scenario->earth.wanted,
                                  c->n_threads, &c->n_threads, &error);
    if (!status && (c->facts.failed || !make_workers(c) || !make_rows(c)))
        status = error_no_memory(&error);
    if (status) {
        glint_curve_close(c);
        return errors_take(errors, &error, PLACE_NONE);
    }
    *out = c;
    return GLINT_OK;
}

void glint_curve_close(glint_curve *c)
{
    if (!c) return;
    for (int i = 0; c->workers && i < c->n_threads; i++)
        tile_worker_free(&c->workers[i]);
    for (int i = 0; c->exposures && i < c->n_threads; i++)
        exposure_worker_free(&c->exposures[i]);
    free(c->exposures);
    free(c->workers);
    visibility_free(c->plan);
    frame_grid_free(c->grid);
    photometry_rows_free(&c->rows);
    free(c->chosen);
    free(c->outside);
    free(c->n_outside);
    coverage_free(&c->watched);
    column_set_free(&c->columns);
    fact_list_free(&c->facts);
    free(c);
}

/* At least 1: given directions belong to one observer. */
static int64_t count_observers(const glint_scenario *s)
{
    return s->n_observers > 1 ? s->n_observers : 1;
}

size_t glint_curve_observers(const glint_curve *c)
{
    return (size_t)count_observers(c->s);
}

int64_t glint_curve_length(const glint_curve *c)
{
    return c->s->n_steps * count_observers(c->s);
}

double glint_curve_step_s(const glint_curve *c)
{
    return c->s->has_geometry ? 0 : c->s->step_s;
}

/* Has the frames of the block's times at hand. The grid is laid out for a few days at once, since
 * its nodes are dear. */
static glint_status cover_block(glint_curve *c, int64_t first, int64_t n, glint_error *error)
{
    static const double AHEAD_S = 4 * DAY_S;
    if (c->s->has_geometry) return GLINT_OK;
    const double step_s = c->s->step_s, half_s = 0.5 * c->s->exposure_s;
    const double from_s = (double)first * step_s - half_s;
    const double to_s = (double)(first + n - 1) * step_s + half_s;
    if (c->grid && from_s >= c->grid_from_s && to_s <= c->grid_to_s) return GLINT_OK;
    const double end_s = (double)(c->s->n_steps - 1) * step_s + half_s;
    double reach_s = from_s + AHEAD_S < end_s ? from_s + AHEAD_S : end_s;
    if (reach_s < to_s) reach_s = to_s;
    const earth_orientation still = {0, 0};
    const glint_status status =
        frame_grid_prepare(&c->s->clock, &still, from_s, reach_s, step_s, &c->grid, error);
    if (status) return status;
    c->grid_from_s = from_s;
    c->grid_to_s = reach_s;
    return GLINT_OK;
}

/* One tile of the block: geometry, visibility, sum, photometry. */
static glint_status compute_tile(glint_curve *c, tile_worker *w, int64_t first, int n, int64_t at,
                                 glint_error *error)
{
    const glint_scenario *s = c->s;
    const model *m = &s->satellite.model;
    const glint_status status =
        geometry_fill(s, c->grid, c->wanted, first, n, &w->geometry, &w->tile, w->lights, error);
    if (status) return status;
    const photometry_rows *all = &c->rows;
    const photometry_rows rows = {
        .rows = all->rows + at,
        .flux_ratio = all->flux_ratio + at * s->n_bands,
        .magnitude = all->magnitude + at * s->n_bands,
        .share_material = all->share_material + at * m->n_materials,
        .share_component = all->share_component + at * m->n_components,
        .share_surface =
            all->share_surface ? all->share_surface + at * s->satellite.n_surfaces : NULL,
        .earthshine = all->earthshine ? all->earthshine + at * s->n_bands : NULL};
    const glint_status summed = tile_worker_sum(s, w, &rows, error);
    if (summed) return summed;
    if (c->watched.n > 0) coverage_mark(&c->watched, w, c->outside + at * c->watched.n);
    if (!c->exposures) return GLINT_OK;
    return exposure_average(s, c->grid, w, &c->exposures[w - c->workers], n, &rows, error);
}

/* The rows of a block: so many from number `first` of the run on. */
typedef struct block_task {
    glint_curve *curve;
    int64_t first, n;
} block_task;

static glint_status compute_block_tile(void *context, int thread, int64_t tile, glint_error *error)
{
    const block_task *b = context;
    const int64_t at = tile * TILE;
    const int rows = b->n - at < TILE ? (int)(b->n - at) : TILE;
    return compute_tile(b->curve, &b->curve->workers[thread], b->first + at, rows, at, error);
}

/* All tiles of the block, over the threads; tiles are the same for any number of them. */
static glint_status compute_block(glint_curve *c, int64_t first, int64_t n, glint_error *error)
{
    block_task block = {c, first, n};
    return tiles_do(compute_block_tile, &block, (n + TILE - 1) / TILE, c->n_threads, error);
}

/* All workers look through the eyes of the observer whose rows come next. */
static void begin_observer(glint_curve *c)
{
    const scenario_observer *o = c->s->observers + c->next / c->s->n_steps;
    for (int i = 0; i < c->n_threads && !c->s->has_geometry; i++)
        c->workers[i].geometry.viewer = (viewer){.observer = o};
}

/* Whether [output] rows lets a row through; where there is no site, nothing must be dark. */
static bool is_wanted(const glint_scenario *s, const glint_row *row)
{
    if (s->rows == ROWS_ALL) return true;
    if (row->flags & (GLINT_BELOW_HORIZON | GLINT_BLOCKED | GLINT_UMBRA)) return false;
    return s->rows == ROWS_VISIBLE || !row->has_site || row->flags & GLINT_SITE_DARK;
}

/* Hands out row k of the block, and counts what was not measured in it. */
static void choose_row(glint_curve *c, int64_t k, size_t *n)
{
    c->chosen[(*n)++] = c->rows.rows[k];
    for (int j = 0; j < c->watched.n; j++)
        c->n_outside[j] += c->outside[k * c->watched.n + j];
}

glint_status glint_curve_next(glint_curve *c, const glint_row **rows, size_t *n, glint_error *error)
{
    *rows = c->chosen;
    *n = 0;
    while (*n == 0 && c->next < glint_curve_length(c)) {
        const int64_t first = c->next % c->s->n_steps; /* of the observer whose turn it is */
        const int64_t left = c->s->n_steps - first, block = (int64_t)c->block;
        const int64_t count = left < block ? left : block;
        if (first == 0) begin_observer(c);
        glint_status status = cover_block(c, first, count, error);
        if (!status) status = compute_block(c, first, count, error);
        if (status) {
            if (error && !error->file[0])
                snprintf(error->file, sizeof error->file, "%s", c->s->documents[0]->path);
            return status;
        }
        for (int64_t k = 0; k < count; k++)
            if (is_wanted(c->s, &c->rows.rows[k])) choose_row(c, k, n);
        c->next += count;
    }
    return GLINT_OK;
}

int64_t glint_curve_done(const glint_curve *c)
{
    return c->next;
}

int glint_curve_threads(const glint_curve *c)
{
    return c->n_threads;
}

bool glint_curve_unmeasured(const glint_curve *c, size_t k, const char **material, int64_t *rows)
{
    if (k >= (size_t)c->watched.n) return false;
    *material = c->s->satellite.materials[c->watched.items[k].material].name;
    *rows = c->n_outside[k];
    return true;
}

bool glint_curve_fact(const glint_curve *c, size_t k, const char **key, const char **value)
{
    return fact_list_get(&c->facts, k, key, value);
}

bool glint_curve_reads(const glint_curve *c, const char *path)
{
    return glint_scenario_reads(c->s, path);
}

const char *glint_curve_scenario(const glint_curve *c)
{
    return c->s->text;
}

const char *glint_curve_band(const glint_curve *c)
{
    return c->s->bands[0]->name;
}

const glint_column *glint_curve_columns(const glint_curve *c, size_t *n)
{
    *n = c->columns.n;
    return c->columns.columns;
}

bool glint_curve_value(const glint_curve *c, const glint_row *row, size_t column, double *value)
{
    return column < c->columns.n && column_value(&c->columns, row, column, value);
}

size_t glint_curve_text(const glint_curve *c, const glint_row *row, size_t column,
                        char out[GLINT_CELL_SIZE])
{
    out[0] = '\0';
    return column < c->columns.n ? column_text(&c->columns, row, column, out) : 0;
}

const char *glint_version(void)
{
    return GLINT_VERSION_TEXT;
}

void glint_free(void *memory)
{
    free(memory);
}
