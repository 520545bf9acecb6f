/* passes.c: passes with what happens in them: light and shadow, darkness, brightness, flashes. */
#include "base/constants.h"
#include "base/grow.h"
#include "base/vec.h"
#include "lightcurve/facts.h"
#include "lightcurve/pass_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct glint_passes {
    const glint_scenario *s; /* borrowed */
    glint_pass *items;       /* owned, with their events */
    size_t n;
    fact_list facts;
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
    if (!grow_list(&list->items, &list->capacity, list->n + 1, sizeof *list->items))
        return error_no_memory(error);
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

/* ------------------------------------------------------------------- a pass */

/* Time that two sets of intervals have in common, s. */
static double common_s(const root_list *a, const root_list *b)
{
    double sum = 0;
    for (size_t i = 0; i + 1 < a->n; i += 2)
        for (size_t j = 0; j + 1 < b->n; j += 2)
            sum += fmax(0, fmin(a->items[i + 1], b->items[j + 1]) - fmax(a->items[i], b->items[j]));
    return sum;
}

static glint_status add_light(const pass_search *p, light_meter *meter, const root_list *sunlit,
                              glint_pass *pass, event_list *events, glint_error *error)
{
    enum { MOST_FLASHES = 1000 };
    const size_t first = events->n;
    double until_s = 0;
    brightest best = {0, HUGE_VAL};
    glint_status status = pass_measure_events(meter, events, 0, NULL, error);
    for (size_t k = 0; k + 1 < sunlit->n && !status; k += 2) {
        const double from_s = sunlit->items[k], to_s = sunlit->items[k + 1];
        if (!(to_s > from_s)) continue;
        status = pass_brightest_in_span(meter, from_s, to_s, &best, error);
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
    if (!status) status = pass_measure_events(meter, events, first, &best, error);
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
        status = pass_edge_find(w, span, (edge_kind)k, &edges[k], error);
        if (!status) status = pass_edge_events(w, &edges[k], (edge_kind)k, &events, error);
    }
    if (!status) status = pass_edge_spans(&edges[EDGE_UMBRA], span, &sunlit, error);
    if (!status) status = pass_edge_spans(&edges[EDGE_DARKNESS], span, &dark, error);
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

static glint_status check_call(const glint_scenario *s, const glint_pass_options *o, int *n_threads,
                               glint_error *error)
{
    glint_status status = glint_passes_check(s, error);
    if (!status) status = tile_count_threads(o->threads, n_threads, error);
    if (status) return status;
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
    int n_threads;
    glint_status status = check_call(s, &o, &n_threads, error);
    if (status) return status;
    glint_passes *passes = calloc(1, sizeof *passes);
    if (!passes) return error_no_memory(error);
    passes->s = s;
    if (s->has_satellite && s->has_attitude)
        facts_of_run(s, &passes->facts);
    else
        facts_of_orbit(s, &passes->facts);
    pass_search search = {.s = s,
                          .has_light = s->has_satellite && s->has_attitude,
                          .flash_angle =
                              o.flash_angle_rad > 0 ? o.flash_angle_rad : USUAL_FLASH_ANGLE};
    status =
        passes->facts.failed ? error_no_memory(error) : find_all(&search, n_threads, passes, error);
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
    fact_list_free(&passes->facts);
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

bool glint_passes_fact(const glint_passes *passes, size_t k, const char **key, const char **value)
{
    return fact_list_get(&passes->facts, k, key, value);
}

bool glint_passes_reads(const glint_passes *passes, const char *path)
{
    return file_list_has(&passes->s->files, path);
}
