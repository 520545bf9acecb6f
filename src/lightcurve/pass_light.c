/* pass_light.c: how bright the satellite is during a pass, and when most. */
#include "base/constants.h"
#include "lightcurve/pass_parts.h"

#include <math.h>
#include <stdlib.h>

glint_status light_meter_make(watch *w, const visibility *plan, light_meter *out,
                              glint_error *error)
{
    *out = (light_meter){.w = w};
    const glint_status status = tile_worker_make(w->s, plan, &out->worker, error);
    return status ? status : photometry_rows_make(w->s, TILE, &out->photometry, error);
}

void light_meter_free(light_meter *meter)
{
    if (meter->w) tile_worker_free(&meter->worker);
    photometry_rows_free(&meter->photometry);
    *meter = (light_meter){0};
}

/* Has the geometry of n <= TILE times in the worker's tile and lights. */
static glint_status light_meter_aim(light_meter *meter, const double *t_s, int n,
                                    glint_error *error)
{
    watch *w = meter->w;
    const glint_status status = watch_cover(w, t_s[0], t_s[0], error);
    if (status) return status;
    return geometry_fill_at(w->s, w->grid, 0, t_s, n, &meter->worker.geometry, &meter->worker.tile,
                            meter->worker.lights, error);
}

glint_status light_meter_read(light_meter *meter, const double *t_s, int n, double *magnitude,
                              glint_error *error)
{
    watch *w = meter->w;
    glint_status status = light_meter_aim(meter, t_s, n, error);
    if (!status) status = tile_worker_sum(w->s, &meter->worker, &meter->photometry, error);
    const glint_row *rows = meter->photometry.rows;
    for (int k = 0; !status && k < n; k++)
        magnitude[k] = rows[k].flux_ratio[0] > 0 ? rows[k].magnitude[0] : HUGE_VAL;
    return status;
}

static glint_status magnitude_at(void *context, double t_s, double *y, glint_error *error)
{
    return light_meter_read(context, &t_s, 1, y, error);
}

/* Looks between two times for the smallest magnitude, to 1 ms. */
static glint_status refine(light_meter *meter, double from_s, double to_s, brightest *best,
                           glint_error *error)
{
    static const double TOLERANCE_S = 1e-3;
    double t_s, magnitude;
    const glint_status status =
        minimum_find(magnitude_at, meter, from_s, to_s, TOLERANCE_S, &t_s, &magnitude, error);
    if (!status && magnitude < best->magnitude) *best = (brightest){t_s, magnitude};
    return status;
}

/* Refines where a sample is brighter than its neighbours and less than REACH fainter than the best.
 */
static glint_status refine_minima(light_meter *meter, const double *t_s, const double *magnitude,
                                  int n, brightest *best, glint_error *error)
{
    enum { MOST = 16 };
    static const double REACH_MAG = 1;
    double least = HUGE_VAL;
    int refined = 0;
    for (int k = 0; k < n; k++)
        least = fmin(least, magnitude[k]);
    for (int k = 0; k < n && refined < MOST; k++) {
        const int before = k > 0 ? k - 1 : k, after = k + 1 < n ? k + 1 : k;
        const bool is_least = magnitude[k] == least;
        if (!(magnitude[k] <= magnitude[before] && magnitude[k] <= magnitude[after]) ||
            !(magnitude[k] < least + REACH_MAG) || before == after)
            continue;
        if (!is_least && refined == MOST - 1) continue; /* the last is kept for the best */
        refined++;
        const glint_status status = refine(meter, t_s[before], t_s[after], best, error);
        if (status) return status;
    }
    return GLINT_OK;
}

/* How the light of one component stood when it was last measured. */
typedef struct aim {
    double sun[3], observer[3]; /* unit, in its axes */
} aim;

/* Whether, in lane k, Sun or observer have moved by STEP_RAD or more in the axes of any component
 * since `last`, or the Sun has grown or shrunk behind the Earth. A mirrored ray moves by twice the
 * step at most, 0.2 deg, less than half of the Sun's width. */
static bool has_moved(const light_meter *meter, int n_components, int k, const aim *last,
                      double last_sunlit)
{
    static const double STEP_RAD = 0.1 * DEG, STEP_SUNLIT = 0.02;
    if (fabs(meter->worker.tile.sunlit[k] - last_sunlit) >= STEP_SUNLIT) return true;
    for (int c = 0; c < n_components; c++) {
        const brdf_light *light = &meter->worker.lights[c];
        double sun2 = 0, observer2 = 0;
        for (int axis = 0; axis < 3; axis++) {
            const double sun = light->i[axis][k] - last[c].sun[axis],
                         observer = light->r[axis][k] - last[c].observer[axis];
            sun2 += sun * sun;
            observer2 += observer * observer;
        }
        if (fmax(sun2, observer2) >= STEP_RAD * STEP_RAD) return true;
    }
    return false;
}

static void remember(const light_meter *meter, int n_components, int k, aim *last)
{
    for (int c = 0; c < n_components; c++)
        for (int axis = 0; axis < 3; axis++) {
            last[c].sun[axis] = meter->worker.lights[c].i[axis][k];
            last[c].observer[axis] = meter->worker.lights[c].r[axis][k];
        }
}

/* Leaves out those of the times between which next to nothing moves: of a slow satellite most of
 * them. The first and the last stay, and so does one of `most_apart` in a row. */
static glint_status thin_samples(light_meter *meter, int most_apart, double *t_s, int *n,
                                 glint_error *error)
{
    const int n_components = meter->w->s->satellite.n_components, all = *n;
    aim *last = calloc((size_t)n_components, sizeof *last);
    if (!last) return error_no_memory(error);
    double last_sunlit = 0;
    int kept = 0, since = 0;
    glint_status status = GLINT_OK;
    for (int first = 0; first < all && !status; first += TILE) {
        const int in_tile = all - first < TILE ? all - first : TILE;
        status = light_meter_aim(meter, t_s + first, in_tile, error);
        for (int k = 0; k < in_tile && !status; k++) {
            since++;
            if (first + k > 0 && first + k + 1 < all && since < most_apart &&
                !has_moved(meter, n_components, k, last, last_sunlit))
                continue;
            remember(meter, n_components, k, last);
            last_sunlit = meter->worker.tile.sunlit[k];
            t_s[kept++] = t_s[first + k];
            since = 0;
        }
    }
    free(last);
    *n = kept;
    return status;
}

glint_status pass_brightest_in_span(light_meter *meter, double from_s, double to_s, brightest *best,
                                    glint_error *error)
{
    static const double STEP_S = 1, LEAST = 64, MOST = 20000;
    const int steps = (int)fmin(fmax(ceil((to_s - from_s) / STEP_S), LEAST), MOST);
    int n = steps + 1;
    double *t_s = malloc(2 * (size_t)n * sizeof *t_s), *magnitude = t_s + n;
    if (!t_s) return error_no_memory(error);
    for (int k = 0; k < n; k++)
        t_s[k] = k < steps ? from_s + (to_s - from_s) * k / steps : to_s;
    glint_status status = thin_samples(meter, (int)(steps / LEAST), t_s, &n, error);
    for (int k = 0; k < n && !status; k += TILE)
        status =
            light_meter_read(meter, t_s + k, n - k < TILE ? n - k : TILE, magnitude + k, error);
    for (int k = 0; k < n && !status; k++)
        if (magnitude[k] < best->magnitude) *best = (brightest){t_s[k], magnitude[k]};
    if (!status) status = refine_minima(meter, t_s, magnitude, n, best, error);
    free(t_s);
    return status;
}

glint_status pass_measure_events(light_meter *meter, event_list *events, size_t first,
                                 brightest *best, glint_error *error)
{
    for (size_t k = first; k < events->n; k++) {
        glint_pass_event *e = &events->items[k];
        double magnitude;
        const glint_status status = light_meter_read(meter, &e->t_s, 1, &magnitude, error);
        if (status) return status;
        e->has_magnitude = magnitude < HUGE_VAL;
        e->magnitude = e->has_magnitude ? magnitude : 0;
        if (best && e->has_magnitude && magnitude < best->magnitude + 1) {
            const glint_status refined = refine(meter, e->from_s, e->to_s, best, error);
            if (refined) return refined;
        }
    }
    return GLINT_OK;
}
