/* passes.c: passes with what happens in them: light and shadow, darkness, brightness, flashes. */
#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "lightcurve/facts.h"
#include "lightcurve/pass_parts.h"
#include "orbit/eclipse.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct glint_passes {
    const glint_scenario *s; /* borrowed */
    glint_pass *items;       /* owned, with their events */
    size_t n;
};

/* What a search shares between its threads. */
typedef struct pass_search {
    const glint_scenario *s;
    bool has_light; /* attitude and satellite are there */
    watch all;      /* owned; has the frames of the whole run: a node of them takes as long as
                       hundreds of looks, and several sites and all searches go through them */
    double flash_angle;
    visibility *plan;    /* owned */
    mirror_list mirrors; /* owned */
} pass_search;

/* ------------------------------------------------------------------ events */

glint_status event_list_add(event_list *list, watch *w, glint_event_kind kind, double t_s,
                            glint_error *error)
{
    if (list->n == list->capacity) {
        const size_t capacity = list->capacity ? 2 * list->capacity : 16;
        glint_pass_event *items = realloc(list->items, capacity * sizeof *items);
        if (!items) return error_no_memory(error);
        list->items = items;
        list->capacity = capacity;
    }
    sighting seen;
    const glint_status status = watch_at(w, t_s, &seen, error);
    if (status) return status;
    glint_pass_event *e = &list->items[list->n++];
    const moment *m = &seen.moment;
    const scenario_observer *site = w->viewer.observer;
    *e = (glint_pass_event){.kind = kind,
                            .t_s = t_s,
                            .range_m = seen.range_m,
                            .sun_elevation_rad = sighting_sun_elevation(w->s, site, &seen),
                            .phase_angle_rad = angle3(m->sun, m->observer),
                            .sunlit_fraction = sighting_sunlit(w->s, &w->viewer, &seen, NULL)};
    sighting_place(site, &seen, &e->azimuth_rad, &e->elevation_rad);
    e->site_dark = e->sun_elevation_rad < w->s->sun_elevation_max;
    run_clock_utc(&w->s->clock, t_s, &e->utc);
    return GLINT_OK;
}

/* In time; at the same time in the order of the kinds. */
static int event_order(const void *a, const void *b)
{
    const glint_pass_event *x = a, *y = b;
    if (x->t_s != y->t_s) return x->t_s < y->t_s ? -1 : 1;
    return (int)x->kind - (int)y->kind;
}

/* ------------------------------------------------------- light and darkness */

/* The angles whose signs tell light from shadow and day from night. */
typedef enum edge_kind {
    EDGE_UMBRA,    /* > 0: some of the Sun is seen */
    EDGE_PENUMBRA, /* > 0: all of it */
    EDGE_MOON,     /* > 0: the Moon covers nothing of it */
    EDGE_DARKNESS, /* > 0: the site is dark */
    N_EDGES
} edge_kind;

typedef struct edge_search {
    watch *w;
    edge_kind kind;
} edge_search;

static glint_status edge_at(void *context, double t_s, double *y, glint_error *error)
{
    const edge_search *e = context;
    sighting seen;
    /* looks beyond a span go no farther than the run, behind which a table of positions may end */
    const double inside_s = fmin(fmax(t_s, 0), e->w->s->span_s);
    const glint_status status = watch_at(e->w, inside_s, &seen, error);
    if (status) return status;
    if (e->kind == EDGE_DARKNESS) {
        const glint_scenario *s = e->w->s;
        *y = s->sun_elevation_max - sighting_sun_elevation(s, e->w->viewer.observer, &seen);
        return GLINT_OK;
    }
    if (e->kind == EDGE_MOON) {
        *y = sighting_moon_gap(e->w->s, &e->w->viewer, &seen);
        return GLINT_OK;
    }
    eclipse_discs discs;
    const moment *m = &seen.moment;
    eclipse_discs_at(m->r_m, m->sun, seen.sun_distance_m, m->itrs_gcrs + 6, &discs);
    const double sun = e->kind == EDGE_UMBRA ? discs.sun : -discs.sun;
    *y = discs.separation - discs.earth + sun;
    return GLINT_OK;
}

/* Times at which one edge is crossed during a pass, and the side at its start. */
typedef struct edge {
    root_list at;
    bool above_at_start;
} edge;

static glint_status find_edge(watch *w, const pass_span *span, edge_kind kind, edge *out,
                              glint_error *error)
{
    /* All change with the satellite's or the Earth's turn: 200 samples of either leave 1.8 deg,
     * within which the angles have one extremum. */
    static const double LEAST = 16, PER_TURN = 200;
    edge_search search = {w, kind};
    sighting seen;
    double start;
    glint_status status = watch_at(w, span->from_s, &seen, error);
    if (!status) status = edge_at(&search, span->from_s, &start, error);
    if (status) return status;
    const double turn_s = fmin(pass_period_s(&seen), DAY_S);
    const double length_s = span->to_s - span->from_s;
    const int steps = (int)fmax(LEAST, ceil(PER_TURN * length_s / turn_s));
    out->above_at_start = start > 0;
    if (!(length_s > 0)) return GLINT_OK;
    return roots_between(edge_at, &search, span->from_s, span->to_s, steps, EVENT_TOLERANCE_S,
                         &out->at, error);
}

static glint_status add_edges(watch *w, const edge *e, edge_kind kind, event_list *out,
                              glint_error *error)
{
    static const glint_event_kind KINDS[N_EDGES][2] = {
        {GLINT_UMBRA_BEGIN, GLINT_UMBRA_END},
        {GLINT_PENUMBRA_BEGIN, GLINT_PENUMBRA_END},
        {GLINT_MOON_SHADOW_BEGIN, GLINT_MOON_SHADOW_END},
        {GLINT_DARKNESS_END, GLINT_DARKNESS_BEGIN},
    };
    bool above = e->above_at_start;
    for (size_t k = 0; k < e->at.n; k++) {
        above = !above;
        const glint_status status =
            event_list_add(out, w, KINDS[kind][above], e->at.items[k], error);
        if (status) return status;
        /* behind the Earth there is nothing for the Moon to cover */
        if (kind == EDGE_MOON && out->items[out->n - 1].sunlit_fraction == 0) out->n--;
    }
    return GLINT_OK;
}

/* Intervals of a pass in which an edge is above, as pairs of from and to. */
static glint_status edge_spans(const edge *e, const pass_span *span, root_list *out,
                               glint_error *error)
{
    glint_status status = GLINT_OK;
    if (e->above_at_start) status = root_list_add(out, span->from_s, error);
    for (size_t k = 0; !status && k < e->at.n; k++)
        status = root_list_add(out, e->at.items[k], error);
    if (!status && out->n % 2) status = root_list_add(out, span->to_s, error);
    return status;
}

/* Time that two sets of intervals have in common, s. */
static double common_s(const root_list *a, const root_list *b)
{
    double sum = 0;
    for (size_t i = 0; i + 1 < a->n; i += 2)
        for (size_t j = 0; j + 1 < b->n; j += 2)
            sum += fmax(0, fmin(a->items[i + 1], b->items[j + 1]) - fmax(a->items[i], b->items[j]));
    return sum;
}

/* --------------------------------------------------------------- brightness */

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

/* The brightest moment so far. */
typedef struct brightest {
    double t_s, magnitude;
} brightest;

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

/* One sunlit span: samples every second (more, so that there are 64 at least; fewer, so that there
 * are 20 000 at most, or where little moves), then the minima among them by golden section. */
static glint_status brightest_in_span(light_meter *meter, double from_s, double to_s,
                                      brightest *best, glint_error *error)
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

/* ------------------------------------------------------------------- a pass */

/* Gives the events their magnitudes; flashes tell of bright moments that samples may have missed.
 */
static glint_status measure_events(light_meter *meter, event_list *events, size_t first,
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

static glint_status add_light(const pass_search *p, light_meter *meter, const root_list *sunlit,
                              glint_pass *pass, event_list *events, glint_error *error)
{
    enum { MOST_FLASHES = 1000 };
    const size_t first = events->n;
    double until_s = 0;
    brightest best = {0, HUGE_VAL};
    glint_status status = measure_events(meter, events, 0, NULL, error);
    for (size_t k = 0; k + 1 < sunlit->n && !status; k += 2) {
        const double from_s = sunlit->items[k], to_s = sunlit->items[k + 1];
        if (!(to_s > from_s)) continue;
        status = brightest_in_span(meter, from_s, to_s, &best, error);
        if (status || pass->more_flashes) continue;
        const flash_request wanted = {.mirrors = &p->mirrors,
                                      .component_gcrs = meter->worker.geometry.component_gcrs,
                                      .from_s = from_s,
                                      .to_s = to_s,
                                      .limit = p->flash_angle,
                                      .first = first,
                                      .most = MOST_FLASHES};
        status = flashes_find(meter->w, &wanted, events, &until_s, error);
        pass->more_flashes = until_s < to_s;
    }
    if (!status) status = measure_events(meter, events, first, &best, error);
    if (!status && pass->more_flashes)
        status = event_list_add(events, meter->w, GLINT_MORE_FLASHES, until_s, error);
    if (status || !(best.magnitude < HUGE_VAL)) return status;
    const size_t at = events->n;
    status = event_list_add(events, meter->w, GLINT_BRIGHTEST, best.t_s, error);
    if (status) return status;
    events->items[at].has_magnitude = true;
    events->items[at].magnitude = best.magnitude;
    return GLINT_OK;
}

static glint_status add_horizon(watch *w, const pass_span *span, event_list *events,
                                glint_error *error)
{
    double top_s;
    glint_status status = pass_culmination(w, span, &top_s, error);
    if (!status) status = event_list_add(events, w, GLINT_CULMINATION, top_s, error);
    if (!status && !span->up_at_start)
        status = event_list_add(events, w, GLINT_RISE, span->from_s, error);
    if (!status && !span->up_at_end)
        status = event_list_add(events, w, GLINT_SET, span->to_s, error);
    return status;
}

/* Fills a pass; its events are handed over to it. */
static glint_status fill_pass(const pass_search *p, light_meter *meter, watch *w,
                              const pass_span *span, glint_pass *pass, glint_error *error)
{
    event_list events = {0};
    edge edges[N_EDGES] = {0};
    root_list sunlit = {0}, dark = {0};
    const root_list all = {(double[]){span->from_s, span->to_s}, 2, 0};
    *pass = (glint_pass){.site = span->site->name,
                         .from_s = span->from_s,
                         .to_s = span->to_s,
                         .up_at_start = span->up_at_start,
                         .up_at_end = span->up_at_end,
                         .has_magnitudes = p->has_light};
    /* what this thread looked at before must not decide last digits */
    w->light_time_s = 0;
    w->viewer = (viewer){.observer = span->site};
    if (p->has_light) meter->worker.geometry.viewer = w->viewer;
    glint_status status = add_horizon(w, span, &events, error);
    for (int k = 0; k < N_EDGES && !status; k++) {
        status = find_edge(w, span, (edge_kind)k, &edges[k], error);
        if (!status) status = add_edges(w, &edges[k], (edge_kind)k, &events, error);
    }
    if (!status) status = edge_spans(&edges[EDGE_UMBRA], span, &sunlit, error);
    if (!status) status = edge_spans(&edges[EDGE_DARKNESS], span, &dark, error);
    if (!status && p->has_light) status = add_light(p, meter, &sunlit, pass, &events, error);
    if (!status) {
        pass->sunlit_s = common_s(&sunlit, &all);
        pass->dark_site_s = common_s(&sunlit, &dark);
    }
    if (events.n > 1) qsort(events.items, events.n, sizeof *events.items, event_order);
    pass->events = events.items;
    pass->n_events = events.n;
    for (int k = 0; k < N_EDGES; k++)
        root_list_free(&edges[k].at);
    root_list_free(&sunlit);
    root_list_free(&dark);
    return status;
}

/* --------------------------------------------------------------- all passes */

/* All passes over the threads; what a pass holds does not depend on their number. The error of the
 * earliest pass wins. */
static glint_status fill_passes(const pass_search *p, const pass_span_list *spans, int threads,
                                glint_passes *out, glint_error *error)
{
    const int n = (int)spans->n;
    int failed_at = n;
    glint_status failed = GLINT_OK;
#pragma omp parallel num_threads(threads)
    {
        watch w = {.s = p->s};
        watch_borrow(&w, &p->all);
        light_meter meter = {0};
        glint_error own = {0};
        glint_status status = p->has_light ? light_meter_make(&w, p->plan, &meter, &own) : GLINT_OK;
#pragma omp for schedule(dynamic)
        for (int k = 0; k < n; k++) {
            if (!status) status = fill_pass(p, &meter, &w, &spans->items[k], &out->items[k], &own);
            if (!status) continue;
#pragma omp critical(glint_first_pass_error)
            if (k < failed_at) {
                failed_at = k;
                failed = status;
                if (error) *error = own;
            }
        }
        light_meter_free(&meter);
        watch_free(&w);
    }
    return failed;
}

glint_status glint_passes_check(const glint_scenario *s, glint_error *error)
{
    if (s->has_geometry)
        return error_set(error, GLINT_INPUT, (place){s->documents[0]->path, 0, 0},
                         "[geometry] gives directions, so there is no orbit to look for passes in; "
                         "expected [time], [observer] and [orbit]");
    bool any_site = false;
    for (int k = 0; k < s->n_observers; k++)
        any_site = any_site || s->observers[k].kind == OBSERVER_SITE;
    if (!any_site)
        return error_set(error, GLINT_INPUT, s->observers[0].where,
                         "no observer is a site, so there is no horizon to pass over; expected "
                         "latitude_deg and longitude_deg in [observer]");
    return GLINT_OK;
}

static glint_status check_call(const glint_scenario *s, const glint_pass_options *o,
                               glint_error *error)
{
    enum { MOST_THREADS = 1024 };
    const glint_status status = glint_passes_check(s, error);
    if (status) return status;
    if (o->threads < 0 || o->threads > MOST_THREADS)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "%d threads asked for; expected 1 to %d, or 0 for all processors",
                         o->threads, MOST_THREADS);
    const double angle_deg = o->flash_angle_rad / DEG, rounding = 1e-12;
    if (angle_deg != 0 && !(angle_deg >= GLINT_FLASH_ANGLE_MIN_DEG * (1 - rounding) &&
                            angle_deg <= GLINT_FLASH_ANGLE_MAX_DEG * (1 + rounding)))
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "the largest mirror angle of a flash is %g deg; expected %g to %g, or 0 "
                         "for the usual 1 deg",
                         angle_deg, GLINT_FLASH_ANGLE_MIN_DEG, GLINT_FLASH_ANGLE_MAX_DEG);
    return GLINT_OK;
}

static glint_status find_all(pass_search *p, int threads, glint_passes *out, glint_error *error)
{
    pass_span_list spans = {0};
    watch *w = &p->all;
    *w = (watch){.s = p->s};
    glint_status status = watch_cover(w, 0, p->s->span_s, error);
    for (int k = 0; k < p->s->n_observers && !status; k++) {
        if (p->s->observers[k].kind != OBSERVER_SITE) continue;
        w->light_time_s = 0;
        w->viewer = (viewer){.observer = &p->s->observers[k]};
        status = pass_spans_find(w, &spans, error);
    }
    if (!status && p->has_light) status = tile_plan_shadows(p->s, &p->plan, error);
    if (!status && p->has_light)
        status = mirrors_of(&p->s->satellite, &p->s->attitude, &p->mirrors, error);
    if (!status) {
        out->items = calloc(spans.n + 1, sizeof *out->items);
        out->n = out->items ? spans.n : 0;
        status = out->items ? fill_passes(p, &spans, threads, out, error) : error_no_memory(error);
    }
    visibility_free(p->plan);
    free(p->mirrors.items);
    free(spans.items);
    watch_free(w);
    return status;
}

glint_status glint_passes_find(const glint_scenario *s, const glint_pass_options *options,
                               glint_passes **out, glint_error *error)
{
    static const double USUAL_FLASH_ANGLE = DEG;
    const glint_pass_options o = options ? *options : (glint_pass_options){0};
    *out = NULL;
    glint_status status = check_call(s, &o, error);
    if (status) return status;
    glint_passes *passes = calloc(1, sizeof *passes);
    if (!passes) return error_no_memory(error);
    passes->s = s;
    pass_search search = {.s = s,
                          .has_light = s->has_satellite && s->has_attitude,
                          .flash_angle =
                              o.flash_angle_rad > 0 ? o.flash_angle_rad : USUAL_FLASH_ANGLE};
    status = find_all(&search, o.threads > 0 ? o.threads : omp_get_num_procs(), passes, error);
    if (status) {
        if (error && !error->file[0])
            snprintf(error->file, sizeof error->file, "%s", s->documents[0]->path);
        glint_passes_free(passes);
        return status;
    }
    *out = passes;
    return GLINT_OK;
}

static void *without_const(const void *pointer)
{
    void *out;
    memcpy(&out, &pointer, sizeof out);
    return out;
}

void glint_passes_free(glint_passes *passes)
{
    if (!passes) return;
    for (size_t k = 0; k < passes->n; k++)
        free(without_const(passes->items[k].events));
    free(passes->items);
    free(passes);
}

size_t glint_passes_count(const glint_passes *passes)
{
    return passes->n;
}

const glint_pass *glint_passes_get(const glint_passes *passes, size_t k)
{
    return k < passes->n ? &passes->items[k] : NULL;
}

const char *glint_passes_band(const glint_passes *passes)
{
    return passes->s->bands[0]->name;
}

const char *glint_passes_satellite(const glint_passes *passes)
{
    const glint_scenario *s = passes->s;
    const char *name = scenario_object(s);
    return name[0] ? name : s->title;
}

const char *glint_event_name(glint_event_kind kind)
{
    static const char *const NAMES[] = {
        [GLINT_RISE] = "rise",
        [GLINT_CULMINATION] = "culmination",
        [GLINT_SET] = "set",
        [GLINT_UMBRA_END] = "umbra-end",
        [GLINT_PENUMBRA_END] = "penumbra-end",
        [GLINT_PENUMBRA_BEGIN] = "penumbra-begin",
        [GLINT_UMBRA_BEGIN] = "umbra-begin",
        [GLINT_MOON_SHADOW_BEGIN] = "moon-shadow-begin",
        [GLINT_MOON_SHADOW_END] = "moon-shadow-end",
        [GLINT_DARKNESS_BEGIN] = "darkness-begin",
        [GLINT_DARKNESS_END] = "darkness-end",
        [GLINT_BRIGHTEST] = "brightest",
        [GLINT_FLASH] = "flash",
        [GLINT_MORE_FLASHES] = "more-flashes",
    };
    return (size_t)kind < sizeof NAMES / sizeof *NAMES ? NAMES[kind] : NULL;
}

const char *glint_compass_point(double azimuth_rad)
{
    static const char *const POINTS[] = {"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                         "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
    const double turns = azimuth_rad / TWO_PI;
    return POINTS[(int)floor((turns - floor(turns)) * 16 + 0.5) % 16];
}

bool glint_passes_reads(const glint_passes *passes, const char *path)
{
    return file_list_has(&passes->s->files, path);
}
