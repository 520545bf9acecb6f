/* flash.c: when flat surfaces mirror the Sun to the observer.
 *
 * The mirror angle of a surface lies between the direction to the observer and that into which it
 * mirrors the Sun. A flash lasts while it is within a limit. The search looks at moments that are
 * near to each other against all motion: where an angle is smaller than at both neighbours its
 * minimum is sought; where it passes the limit, there or between two looks, the crossing is found
 * as a root.
 *
 * A surface that turns steadily and fast is looked at so only while it can flash at all. The angle
 * that it would have at the best phase of its turn changes as slowly as the Sun, the observer and
 * the axis move against each other; while that is above the limit, time is skipped.
 *
 * Any other surface is looked at in steps over which no part turns by more than a few degrees, and
 * the angle cannot fall from where it is to the limit, by the rates at which the parts turn and the
 * directions move at that moment (twice these, since they may grow within the step), or until these
 * may jump: at the ends of slews, at the rows of tables.
 *
 * The work is bounded by the number of flashes and of looks; what is cut off by that is said. */
#include "base/constants.h"
#include "base/vec.h"
#include "lightcurve/pass_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------- mirror angles */

/* All angles at one moment, and how far the search may go. */
typedef struct flash_look {
    double t_s, step_s;
    double *angles; /* one for each mirror, less the limit */
} flash_look;

/* A mirror's flash that has begun. */
typedef struct flash_state {
    bool inside;
    double from_s;
} flash_state;

/* A search in progress. */
typedef struct flash_search {
    watch *w;
    const flash_request *wanted;
    const mirror **mirrors; /* owned array; those that are looked at together */
    int n;
    int chosen;          /* the one that angle_at speaks of */
    double steady_s;     /* step; 0: as the rates allow */
    double tolerance_s;  /* of peaks and crossings */
    flash_look looks[3]; /* the last three */
    int n_looks;         /* of these, since the start */
    double *angles;      /* owned; theirs */
    flash_state *states; /* owned; one for each mirror */
    double (*before)[9]; /* owned; n_components: scratch */
    size_t found;        /* flashes */
    long looks_left;     /* how often the satellite may still be looked at */
} flash_search;

/* Looks at the satellite for all mirrors of one kind: some seconds. */
static const long MOST_LOOKS = 2000000;

/* More flashes than can be kept, or no more looks. */
static bool is_over(const flash_search *f)
{
    return f->found > f->wanted->most || f->looks_left <= 0;
}

static glint_status turn_at(flash_search *f, double t_s, sighting *seen, double body_gcrs[9],
                            glint_error *error)
{
    f->looks_left--;
    const glint_status status = watch_at(f->w, t_s, seen, error);
    if (status) return status;
    return satellite_turn(f->w->s, &seen->moment, body_gcrs, f->wanted->component_gcrs, NULL,
                          error);
}

static double angle_of(const flash_search *f, const mirror *one, const moment *m)
{
    double normal[3];
    mat_tvec(f->wanted->component_gcrs[one->component], one->normal, normal);
    return mirror_angle(normal, m->sun, m->observer);
}

/* Above the limit: > 0. */
static glint_status angle_at(void *context, double t_s, double *y, glint_error *error)
{
    flash_search *f = context;
    sighting seen;
    double body[9];
    const glint_status status = turn_at(f, t_s, &seen, body, error);
    if (!status) *y = angle_of(f, f->mirrors[f->chosen], &seen.moment) - f->wanted->limit;
    return status;
}

/* ------------------------------------------------------------------- steps */

/* Twice the rates of a moment: they may grow within a step. */
static const double SAFETY = 2;
/* Directions turn by less within a step, rad; and the longest step. */
static const double MOST_TURN = 0.1, LONGEST_S = 600;
/* Time over which rates are taken; shorter where that would be much of a turn. */
static const double RATE_OVER_S = 0.01, RATE_OVER_TURN = 0.1;

/* Another moment to take rates from: earlier, but not before the search begins, where attitudes may
 * not be known. */
static double beside(const flash_search *f, double t_s, double over_s)
{
    return t_s - over_s >= f->wanted->from_s ? t_s - over_s : t_s + over_s;
}

static double slow_rate(const sighting *a, const sighting *b, double over_s)
{
    return (angle3(a->moment.observer, b->moment.observer) + angle3(a->moment.sun, b->moment.sun)) /
           over_s;
}

/* Largest angle by which a component turns from one set of orientations to another, rad. */
static double largest_turn(const flash_search *f, double (*a)[9], double (*b)[9])
{
    double most = 0;
    for (int k = 0; k < f->n; k++) {
        const int c = f->mirrors[k]->component;
        if (k > 0 && c == f->mirrors[k - 1]->component) continue;
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

/* How fast mirror angles can fall at t_s, rad/s; leaves the satellite as it is then. */
static glint_status find_rate(flash_search *f, double t_s, sighting *seen, double *rate,
                              glint_error *error)
{
    const size_t n_components = (size_t)f->w->s->satellite.n_components;
    double known = 0, body[9];
    for (int k = 0; k < f->n; k++)
        known = fmax(known, f->mirrors[k]->fastest_rad_s);
    const double over_s = fmin(RATE_OVER_S, RATE_OVER_TURN / fmax(known, 1e-12));
    sighting before;
    glint_status status = turn_at(f, beside(f, t_s, over_s), &before, body, error);
    if (status) return status;
    memcpy(f->before, f->wanted->component_gcrs, n_components * sizeof *f->before);
    status = turn_at(f, t_s, seen, body, error);
    if (status) return status;
    const double turn = largest_turn(f, f->before, f->wanted->component_gcrs) / over_s;
    *rate = SAFETY * (2 * fmax(turn, known) + slow_rate(&before, seen, over_s));
    return GLINT_OK;
}

static glint_status look_at(flash_search *f, double t_s, flash_look *out, glint_error *error)
{
    enum { ANGLES_OF_A_LOOK = 16 }; /* take as long as finding the satellite */
    sighting seen;
    double rate = 0, body[9];
    const glint_status status = f->steady_s > 0 ? turn_at(f, t_s, &seen, body, error)
                                                : find_rate(f, t_s, &seen, &rate, error);
    if (status) return status;
    double nearest = PI;
    for (int k = 0; k < f->n; k++) {
        out->angles[k] = angle_of(f, f->mirrors[k], &seen.moment) - f->wanted->limit;
        nearest = fmin(nearest, fmax(out->angles[k], f->wanted->limit));
    }
    f->looks_left -= f->n / ANGLES_OF_A_LOOK;
    out->t_s = t_s;
    out->step_s = f->steady_s > 0 ? f->steady_s
                                  : fmin(fmin(nearest, MOST_TURN) / fmax(rate, 1e-12), LONGEST_S);
    if (f->steady_s > 0) return GLINT_OK;
    /* Rates hold until something begins or ends; then they are taken anew. */
    const double change_s = satellite_next_change(f->w->s, seen.moment.t_s) - seen.moment.t_s;
    out->step_s = fmin(out->step_s, change_s + RATE_OVER_S);
    return GLINT_OK;
}

/* -------------------------------------------------------------- one flash */

/* Appends the chosen mirror's flash; its peak is where the angle is smallest. */
static glint_status add_flash(flash_search *f, double from_s, double to_s, event_list *out,
                              glint_error *error)
{
    const mirror *one = f->mirrors[f->chosen];
    double peak_s, angle;
    glint_status status =
        minimum_find(angle_at, f, from_s, to_s, f->tolerance_s, &peak_s, &angle, error);
    if (!status) status = event_list_add(out, f->w, GLINT_FLASH, peak_s, error);
    if (status) return status;
    glint_pass_event *e = &out->items[out->n - 1];
    e->from_s = from_s;
    e->to_s = to_s;
    e->mirror_angle_rad = angle + f->wanted->limit;
    e->component = f->w->s->satellite.components[one->component].name;
    copy3(one->normal, e->normal);
    f->found++;
    return GLINT_OK;
}

static glint_status crossing(flash_search *f, double a_s, double a, double b_s, double b,
                             double *t_s, glint_error *error)
{
    return root_find(angle_at, f, a_s, a, b_s, b, f->tolerance_s, t_s, error);
}

/* The angle is above the limit at both times: does it fall below it in between? */
static glint_status look_for_dip(flash_search *f, double a_s, double a, double b_s, double b,
                                 event_list *out, glint_error *error)
{
    double low_s, low, from_s, to_s;
    glint_status status = minimum_find(angle_at, f, a_s, b_s, f->tolerance_s, &low_s, &low, error);
    if (status || low > 0) return status;
    status = crossing(f, a_s, a, low_s, low, &from_s, error);
    if (!status) status = crossing(f, low_s, low, b_s, b, &to_s, error);
    return status ? status : add_flash(f, from_s, to_s, out, error);
}

/* What is fast is found more finely, so that the angle at the peak is right to some 1e-6 rad. */
static void set_tolerance(flash_search *f)
{
    static const double TOLERANCE = 1e-6; /* rad */
    f->tolerance_s = EVENT_TOLERANCE_S;
    for (int k = 0; k < f->n; k++)
        f->tolerance_s = fmin(f->tolerance_s, TOLERANCE / f->mirrors[k]->fastest_rad_s);
}

/* ------------------------------------------------------------------- a walk */

/* Goes on from looks[1] to looks[2] for the chosen mirror. */
static glint_status advance(flash_search *f, event_list *out, glint_error *error)
{
    const int k = f->chosen;
    const flash_look *l = f->looks;
    const bool first = f->n_looks < 3; /* looks[0] is not there */
    const double a = first ? HUGE_VAL : l[0].angles[k], b = l[1].angles[k], c = l[2].angles[k];
    const double b_s = l[1].t_s, c_s = l[2].t_s, behind = PI - f->wanted->limit;
    flash_state *state = &f->states[k];
    if (b > 0 && c > 0) {
        if (!(a > 0 && b <= a && b <= c && b < behind)) return GLINT_OK;
        return look_for_dip(f, first ? b_s : l[0].t_s, first ? b : a, c_s, c, out, error);
    }
    if (b > 0) {
        state->inside = true;
        return crossing(f, b_s, b, c_s, c, &state->from_s, error);
    }
    if (!(c > 0)) return GLINT_OK;
    double to_s;
    const glint_status status = crossing(f, b_s, b, c_s, c, &to_s, error);
    state->inside = false;
    return status ? status : add_flash(f, state->from_s, to_s, out, error);
}

static glint_status walk_start(flash_search *f, double t_s, glint_error *error)
{
    const glint_status status = look_at(f, t_s, &f->looks[2], error);
    for (int k = 0; k < f->n && !status; k++)
        f->states[k] = (flash_state){f->looks[2].angles[k] <= 0, t_s};
    f->n_looks = 1;
    set_tolerance(f);
    return status;
}

static glint_status walk_on(flash_search *f, double to_s, event_list *out, glint_error *error)
{
    glint_status status = GLINT_OK;
    while (!status && f->looks[2].t_s < to_s && !is_over(f)) {
        const flash_look spare = f->looks[0];
        const double next_s = fmin(f->looks[2].t_s + f->looks[2].step_s, to_s);
        f->looks[0] = f->looks[1], f->looks[1] = f->looks[2], f->looks[2] = spare;
        if (f->n_looks < 3) f->n_looks++;
        status = look_at(f, next_s, &f->looks[2], error);
        for (f->chosen = 0; f->chosen < f->n && !status; f->chosen++)
            status = advance(f, out, error);
    }
    return status;
}

/* Flashes that the last look leaves open: what has begun, and what may dip after the last but one.
 */
static glint_status walk_end(flash_search *f, event_list *out, glint_error *error)
{
    const flash_look *b = &f->looks[1], *c = &f->looks[2];
    glint_status status = GLINT_OK;
    for (f->chosen = 0; f->chosen < f->n && !status && f->n_looks > 1; f->chosen++) {
        const int k = f->chosen;
        if (f->states[k].inside)
            status = add_flash(f, f->states[k].from_s, c->t_s, out, error);
        else if (c->angles[k] < b->angles[k])
            status = look_for_dip(f, b->t_s, b->angles[k], c->t_s, c->angles[k], out, error);
    }
    f->n_looks = 0;
    return status;
}

/* ------------------------------------------------------------------ searches */

static void search_free(flash_search *f)
{
    free(f->mirrors);
    free(f->angles);
    free(f->states);
    free(f->before);
}

/* n: as many mirrors as are looked at together. */
static glint_status search_make(watch *w, const flash_request *wanted, int n, flash_search *f,
                                glint_error *error)
{
    const size_t count = (size_t)n, n_components = (size_t)w->s->satellite.n_components;
    *f = (flash_search){.w = w, .wanted = wanted};
    f->mirrors = calloc(count, sizeof *f->mirrors);
    f->angles = calloc(3 * count, sizeof *f->angles);
    f->states = calloc(count, sizeof *f->states);
    f->before = calloc(n_components, sizeof *f->before);
    if (!f->mirrors || !f->angles || !f->states || !f->before) {
        search_free(f);
        return error_no_memory(error);
    }
    for (size_t k = 0; k < 3; k++)
        f->looks[k].angles = f->angles + k * count;
    return GLINT_OK;
}

/* Until when all flashes of a search that was cut off have been found: those that its last steps
 * left open may be missing. */
static double complete_until(const flash_search *f)
{
    double until_s = f->n_looks < 3 ? f->wanted->from_s : f->looks[0].t_s;
    for (int k = 0; k < f->n; k++)
        if (f->states[k].inside) until_s = fmin(until_s, f->states[k].from_s);
    return until_s;
}

/* Mirrors of all kinds, together. *reached_s: as of flashes_find. */
static glint_status search_any(flash_search *f, double to_s, event_list *out, double *reached_s,
                               glint_error *error)
{
    glint_status status = walk_start(f, f->wanted->from_s, error);
    if (!status) status = walk_on(f, to_s, out, error);
    *reached_s = is_over(f) ? complete_until(f) : to_s;
    return status || is_over(f) ? status : walk_end(f, out, error);
}

/* The mirror angle at the best phase of a steady turn, and how fast it can change, rad/s. */
static glint_status best_phase(flash_search *f, double t_s, double *angle, double *rate,
                               glint_error *error)
{
    const mirror *one = f->mirrors[0];
    const double at_s[2] = {beside(f, t_s, RATE_OVER_S), t_s};
    double pole[2][3], body[9];
    sighting seen[2];
    for (int k = 0; k < 2; k++) {
        const glint_status status = turn_at(f, at_s[k], &seen[k], body, error);
        if (status) return status;
        mat_tvec(one->frame < 0 ? body : f->wanted->component_gcrs[one->frame], one->axis, pole[k]);
    }
    const double turn = angle3(pole[0], pole[1]) / RATE_OVER_S;
    *rate = fmax(SAFETY * (2 * turn + slow_rate(&seen[0], &seen[1], RATE_OVER_S)), 1e-12);
    *angle = mirror_least_angle(one, pole[1], seen[1].moment.sun, seen[1].moment.observer);
    return GLINT_OK;
}

/* One mirror that turns steadily: f->mirrors[0]. */
static glint_status search_steady(flash_search *f, double to_s, event_list *out, double *reached_s,
                                  glint_error *error)
{
    /* Looks in a turn: sin^2(m/2) of the mirror angle m has no higher harmonic than the second, so
     * that there is one minimum within two of them. */
    static const double PER_TURN = 48;
    const double period_s = f->mirrors[0]->period_s, limit = f->wanted->limit;
    bool walking = false;
    double t_s = f->wanted->from_s;
    glint_status status = GLINT_OK;
    while (!status && t_s < to_s && !is_over(f)) {
        double angle, rate;
        status = best_phase(f, t_s, &angle, &rate, error);
        if (status) break;
        const double longest_s = fmin(MOST_TURN / rate, LONGEST_S), spare = angle - limit;
        if (spare > rate * period_s) { /* it cannot flash for a whole turn or more */
            if (walking) status = walk_end(f, out, error);
            walking = false;
            t_s = fmin(t_s + fmin(spare / rate, fmax(longest_s, period_s)), to_s);
            continue;
        }
        f->steady_s = fmin(period_s / PER_TURN, longest_s);
        if (!walking) status = walk_start(f, t_s, error);
        walking = true;
        const double stay_s = period_s + fmax(0, -spare / rate); /* it may flash as long as that */
        t_s = fmin(t_s + fmin(stay_s, fmax(longest_s, period_s)), to_s);
        if (!status) status = walk_on(f, t_s, out, error);
    }
    *reached_s = !is_over(f) ? to_s : walking ? complete_until(f) : t_s;
    return status || is_over(f) || !walking ? status : walk_end(f, out, error);
}

static int time_order(const void *a, const void *b)
{
    const glint_pass_event *x = a, *y = b;
    return (x->t_s > y->t_s) - (x->t_s < y->t_s);
}

/* Keeps the earliest flashes: as many as are wanted, and none after *until_s, which becomes the
 * time of the last one where there were too many. */
static void keep_earliest(const flash_request *wanted, event_list *events, double *until_s)
{
    const size_t first = wanted->first, n = events->n - first;
    if (n > 1) qsort(events->items + first, n, sizeof *events->items, time_order);
    if (n > wanted->most) {
        events->n = first + wanted->most;
        *until_s = fmin(*until_s, events->items[events->n - 1].t_s);
    }
    while (events->n > first && events->items[events->n - 1].t_s > *until_s)
        events->n--;
}

/* Turning steadily: each alone, in a time that becomes shorter as flashes become too many. */
static glint_status search_all_steady(watch *w, const flash_request *wanted, event_list *out,
                                      double *until_s, glint_error *error)
{
    flash_search f;
    glint_status status = search_make(w, wanted, 1, &f, error);
    if (status) return status;
    int n_steady = 0;
    for (int k = 0; k < wanted->mirrors->n; k++)
        n_steady += wanted->mirrors->items[k].period_s > 0;
    for (int k = 0; k < wanted->mirrors->n && !status; k++) {
        f.mirrors[0] = &wanted->mirrors->items[k];
        if (!(f.mirrors[0]->period_s > 0)) continue;
        double reached_s;
        f.n = 1;
        f.found = 0;
        f.looks_left = MOST_LOOKS / n_steady;
        status = search_steady(&f, *until_s, out, &reached_s, error);
        *until_s = fmin(*until_s, reached_s);
        keep_earliest(wanted, out, until_s);
    }
    search_free(&f);
    return status;
}

glint_status flashes_find(watch *w, const flash_request *wanted, event_list *out, double *until_s,
                          glint_error *error)
{
    const mirror_list *all = wanted->mirrors;
    *until_s = wanted->to_s;
    if (all->n == 0) return GLINT_OK;
    flash_search f;
    glint_status status = search_make(w, wanted, all->n, &f, error);
    if (status) return status;
    for (int k = 0; k < all->n; k++)
        if (!(all->items[k].period_s > 0)) f.mirrors[f.n++] = &all->items[k];
    double reached_s = wanted->to_s;
    f.looks_left = MOST_LOOKS;
    if (f.n > 0) status = search_any(&f, *until_s, out, &reached_s, error);
    search_free(&f);
    *until_s = fmin(*until_s, reached_s);
    keep_earliest(wanted, out, until_s);
    return status ? status : search_all_steady(w, wanted, out, until_s, error);
}
