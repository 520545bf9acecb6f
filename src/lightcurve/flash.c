/* flash.c: when flat surfaces mirror the Sun to the observer.
 *
 * The mirror angle of a surface lies between the direction to the observer and that into which it
 * mirrors the Sun. A flash lasts while it is within a limit. The search goes in steps over which no
 * part turns by more than a few degrees, and the angle cannot fall from where it is to the limit,
 * by the rates at which the parts turn and the directions move at that moment (twice these, since
 * they may grow within the step), or until they may jump: at the ends of slews, at the rows of
 * tables. Where an angle is smaller than at both neighbours its minimum is sought. Where it passes
 * the limit, there or between two steps, the crossing is found as a root.
 */
#include "base/constants.h"
#include "base/vec.h"
#include "brdf/sharpness.h"
#include "lightcurve/pass_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ mirrors */

static bool is_shiny(const satellite *sat, int material)
{
    return brdf_material_width(&sat->model.materials[material].bands[0]) < HUGE_VAL;
}

static int same_way(const mirror_list *list, int component, const double normal[3])
{
    static const double SAME = 1e-9; /* rad: as parallel as rounding lets facets be */
    for (int k = 0; k < list->n; k++)
        if (list->items[k].component == component && angle3(list->items[k].normal, normal) < SAME)
            return k;
    return -1;
}

glint_status mirrors_of(const satellite *sat, mirror_list *out, glint_error *error)
{
    const model *m = &sat->model;
    *out = (mirror_list){.items = calloc((size_t)m->n_facets + 1, sizeof *out->items)};
    bool *shiny = calloc((size_t)m->n_materials + 1, sizeof *shiny);
    if (!out->items || !shiny) {
        free(shiny);
        return error_no_memory(error);
    }
    for (int k = 0; k < m->n_materials; k++)
        shiny[k] = is_shiny(sat, k);
    for (int k = 0; k < m->polygons.n; k++) {
        const facet *f = &m->polygons.items[k];
        if (f->surface || !shiny[f->material] || same_way(out, f->component, f->normal) >= 0)
            continue;
        mirror *added = &out->items[out->n++];
        added->component = f->component;
        copy3(f->normal, added->normal);
    }
    free(shiny);
    return GLINT_OK;
}

/* ------------------------------------------------------------- mirror angles */

/* A search in progress. */
typedef struct flash_search {
    watch *w;
    const mirror_list *mirrors;
    double (*component_gcrs)[9]; /* n_components: scratch */
    double limit;
    int chosen; /* the mirror that angle_at speaks of */
} flash_search;

/* pi where the Sun or the observer stands behind the surface. */
static double mirror_angle(const double normal[3], const double sun[3], const double observer[3])
{
    double to[3];
    const double ci = dot3(normal, sun);
    if (!(ci > 0) || !(dot3(normal, observer) > 0)) return PI;
    for (int i = 0; i < 3; i++)
        to[i] = 2 * ci * normal[i] - sun[i];
    return angle3(to, observer);
}

static glint_status turn_at(const flash_search *f, double t_s, sighting *seen, glint_error *error)
{
    double body_gcrs[9];
    const glint_status status = watch_at(f->w, t_s, seen, error);
    if (status) return status;
    return satellite_turn(f->w->s, &seen->moment, body_gcrs, f->component_gcrs, NULL, error);
}

static double angle_of(const flash_search *f, int k, const moment *m)
{
    const mirror *one = &f->mirrors->items[k];
    double normal[3];
    mat_tvec(f->component_gcrs[one->component], one->normal, normal);
    return mirror_angle(normal, m->sun, m->observer);
}

/* Above the limit: > 0. */
static glint_status angle_at(void *context, double t_s, double *y, glint_error *error)
{
    const flash_search *f = context;
    sighting seen;
    const glint_status status = turn_at(f, t_s, &seen, error);
    if (!status) *y = angle_of(f, f->chosen, &seen.moment) - f->limit;
    return status;
}

/* ------------------------------------------------------------------- steps */

/* All angles at one moment, and how far the search may go. */
typedef struct flash_look {
    double t_s, step_s;
    double *angles; /* owned; one for each mirror, less the limit */
} flash_look;

/* Largest angle by which a component turns from one set of orientations to another, rad. */
static double largest_turn(const flash_search *f, double (*a)[9], double (*b)[9])
{
    double most = 0;
    for (int k = 0; k < f->mirrors->n; k++) {
        const int c = f->mirrors->items[k].component;
        double difference[9], transposed[9];
        mat_transpose(a[c], transposed);
        mat_mul(b[c], transposed, difference);
        /* |R - R'| has sin of the angle in its three numbers: precise for small ones */
        const double axis[3] = {difference[7] - difference[5], difference[2] - difference[6],
                                difference[3] - difference[1]};
        const double trace = difference[0] + difference[4] + difference[8];
        most = fmax(most, atan2(norm3(axis), trace - 1));
    }
    return most;
}

static glint_status look_at(const flash_search *f, double (*before)[9], double t_s, flash_look *out,
                            glint_error *error)
{
    static const double RATE_OVER_S = 0.01; /* over which rates are taken */
    static const double SAFETY = 2, MOST_TURN = 0.1, LONGEST_S = 600; /* -, rad, s */
    const size_t n_components = (size_t)f->w->s->satellite.n_components;
    sighting a, b;
    glint_status status = turn_at(f, t_s - RATE_OVER_S, &a, error);
    if (status) return status;
    memcpy(before, f->component_gcrs, n_components * sizeof *before);
    status = turn_at(f, t_s, &b, error);
    if (status) return status;
    const double turn = largest_turn(f, before, f->component_gcrs) / RATE_OVER_S;
    const double moved =
        (angle3(a.moment.observer, b.moment.observer) + angle3(a.moment.sun, b.moment.sun)) /
        RATE_OVER_S;
    const double rate = SAFETY * (2 * turn + moved);
    double nearest = PI;
    for (int k = 0; k < f->mirrors->n; k++) {
        out->angles[k] = angle_of(f, k, &b.moment) - f->limit;
        nearest = fmin(nearest, fmax(out->angles[k], f->limit));
    }
    out->t_s = t_s;
    out->step_s = fmin(fmin(nearest, MOST_TURN) / fmax(rate, 1e-12), LONGEST_S);
    /* Rates hold until something begins or ends; then they are taken anew. */
    const double change_s = satellite_next_change(f->w->s, b.moment.t_s) - b.moment.t_s;
    out->step_s = fmin(out->step_s, change_s + RATE_OVER_S);
    return GLINT_OK;
}

/* -------------------------------------------------------------- one flash */

/* A mirror's flash that has begun. */
typedef struct flash_state {
    bool inside;
    double from_s;
} flash_state;

/* Appends the chosen mirror's flash; its peak is where the angle is smallest. */
static glint_status add_flash(flash_search *f, double from_s, double to_s, event_list *out,
                              glint_error *error)
{
    const mirror *one = &f->mirrors->items[f->chosen];
    double peak_s, angle;
    glint_status status =
        minimum_find(angle_at, f, from_s, to_s, EVENT_TOLERANCE_S, &peak_s, &angle, error);
    if (!status) status = event_list_add(out, f->w, GLINT_FLASH, peak_s, error);
    if (status) return status;
    glint_pass_event *e = &out->items[out->n - 1];
    e->from_s = from_s;
    e->to_s = to_s;
    e->mirror_angle_rad = angle + f->limit;
    e->component = f->w->s->satellite.components[one->component].name;
    copy3(one->normal, e->normal);
    return GLINT_OK;
}

static glint_status crossing(flash_search *f, double a_s, double a, double b_s, double b,
                             double *t_s, glint_error *error)
{
    return root_find(angle_at, f, a_s, a, b_s, b, EVENT_TOLERANCE_S, t_s, error);
}

/* The angle is above the limit at both times: does it fall below it in between? */
static glint_status look_for_dip(flash_search *f, double a_s, double a, double b_s, double b,
                                 event_list *out, glint_error *error)
{
    double low_s, low, from_s, to_s;
    glint_status status =
        minimum_find(angle_at, f, a_s, b_s, EVENT_TOLERANCE_S, &low_s, &low, error);
    if (status || low > 0) return status;
    status = crossing(f, a_s, a, low_s, low, &from_s, error);
    if (!status) status = crossing(f, low_s, low, b_s, b, &to_s, error);
    return status ? status : add_flash(f, from_s, to_s, out, error);
}

/* Goes on from looks[1] to looks[2] for the chosen mirror; looks[0] came before. first, last: there
 * is none before, none after. */
static glint_status advance(flash_search *f, const flash_look looks[3], bool first, bool last,
                            flash_state *state, event_list *out, glint_error *error)
{
    const int k = f->chosen;
    const double a = first ? HUGE_VAL : looks[0].angles[k], b = looks[1].angles[k],
                 c = looks[2].angles[k], behind = PI - f->limit;
    const double b_s = looks[1].t_s, c_s = looks[2].t_s;
    glint_status status = GLINT_OK;
    if (b > 0 && c > 0) {
        if (a > 0 && b <= a && b <= c && b < behind)
            status = look_for_dip(f, first ? b_s : looks[0].t_s, first ? b : a, c_s, c, out, error);
        else if (last && c < b)
            status = look_for_dip(f, b_s, b, c_s, c, out, error);
        return status;
    }
    if (b > 0) {
        status = crossing(f, b_s, b, c_s, c, &state->from_s, error);
        state->inside = true;
    }
    double to_s = c_s;
    if (!status && c > 0) status = crossing(f, b_s, b, c_s, c, &to_s, error);
    if (status || (c <= 0 && !last)) return status;
    state->inside = false;
    return add_flash(f, state->from_s, to_s, out, error);
}

static glint_status walk(flash_search *f, flash_look looks[3], flash_state *states,
                         double (*before)[9], double from_s, double to_s, size_t most,
                         event_list *out, bool *more, glint_error *error)
{
    const int n = f->mirrors->n;
    glint_status status = look_at(f, before, from_s, &looks[2], error);
    for (int k = 0; k < n && !status; k++)
        states[k] = (flash_state){looks[2].angles[k] <= 0, from_s};
    for (bool first = true; !status && looks[2].t_s < to_s; first = false) {
        const flash_look spare = looks[0];
        const double next_s = fmin(looks[2].t_s + looks[2].step_s, to_s);
        looks[0] = looks[1], looks[1] = looks[2], looks[2] = spare;
        status = look_at(f, before, next_s, &looks[2], error);
        for (int k = 0; k < n && !status; k++) {
            *more = *more || out->n >= most;
            if (*more) return GLINT_OK;
            f->chosen = k;
            status = advance(f, looks, first, next_s >= to_s, &states[k], out, error);
        }
    }
    return status;
}

glint_status flashes_find(watch *w, const mirror_list *mirrors, double (*component_gcrs)[9],
                          double from_s, double to_s, double limit, size_t most, event_list *out,
                          bool *more, glint_error *error)
{
    if (mirrors->n == 0) return GLINT_OK;
    const size_t n = (size_t)mirrors->n, n_components = (size_t)w->s->satellite.n_components;
    flash_search f = {w, mirrors, component_gcrs, limit, 0};
    double *angles = calloc(3 * n, sizeof *angles),
           (*before)[9] = calloc(n_components, sizeof *before);
    flash_state *states = calloc(n, sizeof *states);
    glint_status status = GLINT_INTERNAL;
    if (angles && before && states) {
        flash_look looks[3] = {
            {.angles = angles}, {.angles = angles + n}, {.angles = angles + 2 * n}};
        status = walk(&f, looks, states, before, from_s, to_s, most, out, more, error);
    } else {
        error_no_memory(error);
    }
    free(angles);
    free(before);
    free(states);
    return status;
}
