/* pass_edges.c: when a pass goes from light into shadow and back, of the Earth and of the Moon, and
 * from night into day. */
#include "base/constants.h"
#include "lightcurve/pass_parts.h"
#include "orbit/eclipse.h"

#include <math.h>

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

glint_status pass_edge_find(watch *w, const pass_span *span, edge_kind kind, edge *out,
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

glint_status pass_edge_events(watch *w, const edge *e, edge_kind kind, event_list *out,
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

glint_status pass_edge_spans(const edge *e, const pass_span *span, root_list *out,
                             glint_error *error)
{
    glint_status status = GLINT_OK;
    if (e->above_at_start) status = root_list_add(out, span->from_s, error);
    for (size_t k = 0; !status && k < e->at.n; k++)
        status = root_list_add(out, e->at.items[k], error);
    if (!status && out->n % 2) status = root_list_add(out, span->to_s, error);
    return status;
}
