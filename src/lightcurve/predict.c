#include "lightcurve/predict.h"

#include "base/constants.h"
#include "lightcurve/exposure.h"
#include "lightcurve/pass_parts.h"

#include <stdlib.h>

/* What one thread needs. */
typedef struct predictor {
    watch w;
    light_meter meter;
    exposure_worker exposure;
} predictor;

/* Moments, and how they are cut into tiles: alike for any number of threads. */
typedef struct prediction {
    const glint_scenario *s;
    const double *t_s;
    size_t *first; /* owned; n_tiles + 1: where tiles begin */
    size_t n_tiles;
    visibility *plan; /* owned */
    int n_threads;
    predictor *threads; /* owned; n_threads */
    predict_taker *take;
    void *context;
} prediction;

/* A tile is shorter than a watch sees ahead. */
static bool cut_tiles(prediction *p, size_t n)
{
    static const double MOST_S = DAY_S;
    p->first = calloc(n + 1, sizeof *p->first);
    if (!p->first) return false;
    for (size_t k = 0; k < n; k++) {
        const size_t begun = p->n_tiles ? p->first[p->n_tiles - 1] : 0;
        if (p->n_tiles == 0 || k - begun == TILE || p->t_s[k] - p->t_s[begun] > MOST_S)
            p->first[p->n_tiles++] = k;
    }
    p->first[p->n_tiles] = n;
    return true;
}

static glint_status make_threads(prediction *p, const scenario_observer *who, glint_error *error)
{
    const size_t n = (size_t)p->n_threads < p->n_tiles ? (size_t)p->n_threads : p->n_tiles;
    p->n_threads = n > 0 ? (int)n : 1;
    p->threads = calloc((size_t)p->n_threads, sizeof *p->threads);
    if (!p->threads) return error_no_memory(error);
    glint_status status = GLINT_OK;
    for (int k = 0; k < p->n_threads && !status; k++) {
        predictor *own = &p->threads[k];
        own->w = (watch){.s = p->s, .viewer.observer = who};
        status = light_meter_make(&own->w, p->plan, &own->meter, error);
        own->meter.worker.geometry.viewer = own->w.viewer;
        if (!status && p->s->exposure_s > 0)
            status = exposure_worker_make(p->s, &own->exposure, error);
    }
    return status;
}

static void end(prediction *p)
{
    for (int k = 0; p->threads && k < p->n_threads; k++) {
        exposure_worker_free(&p->threads[k].exposure);
        light_meter_free(&p->threads[k].meter);
        watch_free(&p->threads[k].w);
    }
    free(p->threads);
    free(p->first);
    visibility_free(p->plan);
}

static glint_status predict_tile(void *context, int thread, int64_t tile, glint_error *error)
{
    const prediction *p = context;
    predictor *own = &p->threads[thread];
    const size_t first = p->first[tile];
    const int n = (int)(p->first[tile + 1] - first);
    double magnitude[TILE];
    light_meter *meter = &own->meter;
    glint_status status = light_meter_read(meter, p->t_s + first, n, magnitude, error);
    if (!status && p->s->exposure_s > 0)
        status = exposure_average(p->s, own->w.grid, &meter->worker, &own->exposure, n,
                                  &meter->photometry, error);
    for (int k = 0; k < n && !status; k++)
        p->take(p->context, first + (size_t)k, &meter->photometry.rows[k]);
    return status;
}

glint_status predict_rows(const glint_scenario *s, const scenario_observer *who, const double *t_s,
                          size_t n, int threads, predict_taker *take, void *context,
                          glint_error *error)
{
    prediction p = {.s = s, .t_s = t_s, .take = take, .context = context};
    glint_status status = tile_count_threads(threads, &p.n_threads, error);
    if (!status) status = tile_plan_shadows(s, &p.plan, error);
    if (!status && !cut_tiles(&p, n)) status = error_no_memory(error);
    if (!status && p.plan)
        status = tile_fit_threads(s->satellite.model.n_facets, s->earth.wanted, p.n_threads,
                                  &p.n_threads, error);
    if (!status) status = make_threads(&p, who, error);
    if (!status) status = tiles_do(predict_tile, &p, (int64_t)p.n_tiles, p.n_threads, error);
    end(&p);
    return status;
}
