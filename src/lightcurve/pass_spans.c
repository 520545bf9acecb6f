/* pass_spans.c: when the satellite is above the site's horizon.
 *
 * "Above" is the inside of a cone with its tip at the site. The search goes through time in steps
 * in which the satellite, at the speed it has and with the largest acceleration it can have, cannot
 * reach the surface of the cone: no pass can begin or end between. Near the surface such steps
 * would become ever smaller; there they are a small part of the time over which the direction to
 * the satellite turns, so that the elevation has one extremum at most within a step, and where its
 * rate changes sign the extremum is sought. So passes are found however short they are, and so are
 * gaps in a pass.
 *
 * With a mask there are two cones, those of its lowest and its highest point: outside them, the
 * same holds. Steps are then so short that the azimuth stays on one straight piece of the mask, or
 * passes its end by a small part of a piece. */
#include "base/constants.h"
#include "base/grow.h"
#include "base/vec.h"
#include "lightcurve/pass_parts.h"

#include <math.h>
#include <stdlib.h>

/* What is known of one moment of the search. */
typedef struct look {
    double t_s;
    double margin; /* elevation above the limit, rad */
    double rate;   /* of the margin or what rises with it: for its sign */
    double safe_s; /* the surface of the next cone is not reached before */
    double fine_s; /* small against the time in which the direction turns */
} look;

double pass_period_s(const sighting *seen)
{
    static const double LONGEST_S = 30 * DAY_S; /* what is unbound or nearly so */
    const double r = norm3(seen->moment.r_m), v = norm3(seen->moment.v_m_s);
    const double a = 1 / (2 / r - v * v / EARTH_MU_M3_S2);
    if (!(a > 0)) return LONGEST_S;
    return fmin(TWO_PI * sqrt(a * a * a / EARTH_MU_M3_S2), LONGEST_S);
}

/* Velocity of the satellite against the turning Earth, GCRS axes, m/s. */
static void ground_velocity(const sighting *seen, double out[3])
{
    double spin[3], carried[3];
    scale3(seen->frames.itrs_gcrs + 6, EARTH_RATE_RAD_S, spin);
    cross3(spin, seen->moment.r_m, carried);
    sub3(seen->moment.v_m_s, carried, out);
}

/* Time in which the satellite can get as far as distance_m, from its speed and a bound of its
 * acceleration against the turning Earth. */
static double reach_s(const sighting *seen, double speed_m_s, double distance_m)
{
    static const double LONGEST_S = 3600;
    /* Gravity is largest at the surface: mu / R^2, and 5 % more for the Earth's shape and lower
     * ground. Coriolis: 2 omega times a speed, at most the escape speed there, 11.2 km/s, and what
     * the Earth's turning adds; centrifugal: omega^2 r. r grows by no more than 11.2 km/s. */
    static const double ESCAPE_M_S = 11.2e3, MARGIN = 1.05;
    const double w = EARTH_RATE_RAD_S;
    const double r = norm3(seen->moment.r_m) + ESCAPE_M_S * LONGEST_S;
    const double acceleration = MARGIN * EARTH_MU_M3_S2 / (EARTH_RADIUS_M * EARTH_RADIUS_M) +
                                2 * w * (ESCAPE_M_S + w * r) + w * w * r;
    const double time_s =
        2 * distance_m / (speed_m_s + sqrt(speed_m_s * speed_m_s + 2 * acceleration * distance_m));
    return fmin(time_s, LONGEST_S);
}

/* How far the satellite is above the horizon, as both appear. */
static double margin_of(const watch *w, const sighting *seen)
{
    const scenario_observer *site = w->viewer.observer;
    double azimuth, elevation;
    sighting_place(site, seen, &azimuth, &elevation);
    return elevation - horizon_limit(&site->horizon, azimuth);
}

static glint_status margin_at(void *context, double t_s, double *y, glint_error *error)
{
    watch *w = context;
    sighting seen;
    const glint_status status = watch_at(w, t_s, &seen, error);
    if (!status) *y = margin_of(w, &seen);
    return status;
}

/* Angle from the satellite to the nearest cone on which it can rise or set, rad; 0 between two. */
static double angle_to_cone(const scenario_observer *site, double elevation)
{
    const double lowest = refraction_geometric(&site->air, site->horizon.lowest);
    const double highest = refraction_geometric(&site->air, site->horizon.highest);
    return fmax(0, fmax(lowest - elevation, elevation - highest));
}

/* A mask has corners: its margin's rate is a difference over a time that is short against them. */
static glint_status mask_look(watch *w, const sighting *seen, double azimuth, double elevation,
                              look *out, glint_error *error)
{
    static const double TURN = 0.02, LEAST_COSINE = 1e-3;
    static const double PART = 0.25, SHORTEST_S = 1e-3, HALF_MOST_S = 0.1;
    double velocity[3], before, after;
    ground_velocity(seen, velocity);
    /* within a step the elevation changes by TURN at most, and the azimuth runs the faster the
     * higher it is */
    const double turning =
        norm3(velocity) / (seen->range_m * fmax(cos(elevation) - TURN, LEAST_COSINE));
    const double piece_s =
        horizon_room(&w->viewer.observer->horizon, azimuth) / fmax(turning, 1e-9);
    out->fine_s = fmax(fmin(out->fine_s, piece_s), SHORTEST_S);
    const double half_s = fmin(HALF_MOST_S, PART * out->fine_s);
    glint_status status = margin_at(w, out->t_s - half_s, &before, error);
    if (!status) status = margin_at(w, out->t_s + half_s, &after, error);
    if (!status) out->rate = after - before;
    return status;
}

static glint_status look_at(watch *w, double t_s, look *out, glint_error *error)
{
    /* Light time lets the satellite seem faster by v/c at most, 4e-5; the rest is rounding. */
    static const double SAFETY = 0.999;
    static const double FINE = 0.02, FINE_OF_PERIOD = 0.005;
    sighting seen;
    const glint_status status = watch_at(w, t_s, &seen, error);
    if (status) return status;
    const scenario_observer *site = w->viewer.observer;
    double azimuth, elevation, velocity[3], up[3];
    sky_place(site, &seen.frames, seen.sight_gcrs, &azimuth, &elevation);
    ground_velocity(&seen, velocity);
    mat_tvec(seen.frames.itrs_gcrs, site->site.enu_itrs + 6, up);
    const double speed = norm3(velocity), away = dot3(velocity, seen.sight_gcrs);
    out->t_s = t_s;
    out->margin = margin_of(w, &seen);
    out->rate = (dot3(velocity, up) - away * sin(elevation)) / seen.range_m;
    const double angle = angle_to_cone(site, elevation);
    const double distance_m = seen.range_m * (angle < 0.5 * PI ? sin(angle) : 1);
    out->safe_s = SAFETY * reach_s(&seen, speed, distance_m);
    out->fine_s =
        fmin(FINE * seen.range_m / fmax(speed, 1e-3), FINE_OF_PERIOD * pass_period_s(&seen));
    return site->horizon.n > 0 ? mask_look(w, &seen, azimuth, elevation, out, error) : GLINT_OK;
}

/* The sine of the elevation: smooth at the zenith, too. */
static glint_status height_at(watch *w, double t_s, double *y, glint_error *error)
{
    sighting seen;
    double up[3];
    const glint_status status = watch_at(w, t_s, &seen, error);
    if (status) return status;
    mat_tvec(seen.frames.itrs_gcrs, w->viewer.observer->site.enu_itrs + 6, up);
    *y = dot3(seen.sight_gcrs, up);
    return GLINT_OK;
}

/* Its rate by a symmetric difference, since the velocity of SGP4 is not quite the rate of its
 * position. Over 0.1 s on either side rounding (3e-11 rad) shifts the root by 1e-5 s, curvature by
 * less. */
static glint_status height_rate_at(void *context, double t_s, double *y, glint_error *error)
{
    static const double HALF_S = 0.1;
    double before, after;
    glint_status status = height_at(context, t_s - HALF_S, &before, error);
    if (!status) status = height_at(context, t_s + HALF_S, &after, error);
    if (!status) *y = (after - before) / (2 * HALF_S);
    return status;
}

/* Where the margin passes 0, on the side above, so that the satellite is up at its rise and set. */
static glint_status crossing(watch *w, double a, double margin_a, double b, double margin_b,
                             double *t_s, glint_error *error)
{
    enum { MOST_NUDGES = 8 };
    const double inward_s = (margin_a >= 0) == (a < b) ? -EVENT_TOLERANCE_S : EVENT_TOLERANCE_S;
    glint_status status =
        root_find(margin_at, w, a, margin_a, b, margin_b, EVENT_TOLERANCE_S, t_s, error);
    for (int k = 0; k < MOST_NUDGES && !status; k++) {
        double margin;
        status = margin_at(w, *t_s, &margin, error);
        if (status || margin >= 0) break;
        *t_s += inward_s;
    }
    return status;
}

/* The extremum of the elevation between two looks, if the rate has different signs there. */
static glint_status extremum(watch *w, double a, double b, double *t_s, bool *found,
                             glint_error *error)
{
    double rate_a, rate_b;
    *found = false;
    glint_status status = height_rate_at(w, a, &rate_a, error);
    if (!status) status = height_rate_at(w, b, &rate_b, error);
    if (status || (rate_a > 0) == (rate_b > 0)) return status;
    *found = true;
    return root_find(height_rate_at, w, a, rate_a, b, rate_b, EVENT_TOLERANCE_S, t_s, error);
}

/* The margin with a sign, for its largest or its smallest value. */
typedef struct signed_margin {
    watch *w;
    double sign;
} signed_margin;

static glint_status signed_margin_at(void *context, double t_s, double *y, glint_error *error)
{
    const signed_margin *m = context;
    const glint_status status = margin_at(m->w, t_s, y, error);
    if (!status) *y *= m->sign;
    return status;
}

/* Where the margin comes nearest to the other side, between two looks on the same one. */
static glint_status nearest_approach(watch *w, const look *a, const look *b, double *t_s,
                                     bool *found, glint_error *error)
{
    if (w->viewer.observer->horizon.n == 0) return extremum(w, a->t_s, b->t_s, t_s, found, error);
    signed_margin m = {w, a->margin >= 0 ? 1 : -1};
    *found = true;
    return minimum_find(signed_margin_at, &m, a->t_s, b->t_s, EVENT_TOLERANCE_S, t_s, NULL, error);
}

/* Appends the horizon crossings between two neighbouring looks. */
static glint_status crossings_between(watch *w, const look *a, const look *b, root_list *out,
                                      glint_error *error)
{
    double t_s;
    glint_status status;
    if ((a->margin >= 0) != (b->margin >= 0)) {
        status = crossing(w, a->t_s, a->margin, b->t_s, b->margin, &t_s, error);
        return status ? status : root_list_add(out, t_s, error);
    }
    const double up = a->margin >= 0 ? -1 : 1; /* which way the extremum would have to go */
    if (!(up * a->rate > 0 && up * b->rate < 0)) return GLINT_OK;
    bool found;
    double top_s, margin;
    status = nearest_approach(w, a, b, &top_s, &found, error);
    if (!status && found) status = margin_at(w, top_s, &margin, error);
    if (status || !found || (margin >= 0) == (a->margin >= 0)) return status;
    status = crossing(w, a->t_s, a->margin, top_s, margin, &t_s, error);
    if (!status) status = root_list_add(out, t_s, error);
    if (!status) status = crossing(w, top_s, margin, b->t_s, b->margin, &t_s, error);
    return status ? status : root_list_add(out, t_s, error);
}

static glint_status add_span(pass_span_list *list, pass_span span, glint_error *error)
{
    if (!grow_list(&list->items, &list->capacity, list->n + 1, sizeof *list->items))
        return error_no_memory(error);
    list->items[list->n++] = span;
    return GLINT_OK;
}

/* From crossings, which turn up into down and back, to spans. */
static glint_status make_spans(const root_list *crossings, const scenario_observer *site, bool up,
                               double end_s, pass_span_list *out, glint_error *error)
{
    pass_span span = {.up_at_start = up, .site = site};
    for (size_t k = 0; k < crossings->n; k++, up = !up) {
        if (!up) {
            span = (pass_span){.from_s = crossings->items[k], .site = site};
            continue;
        }
        span.to_s = crossings->items[k];
        const glint_status status = add_span(out, span, error);
        if (status) return status;
    }
    if (!up) return GLINT_OK;
    span.to_s = end_s;
    span.up_at_end = true;
    return add_span(out, span, error);
}

glint_status pass_spans_find(watch *w, pass_span_list *out, glint_error *error)
{
    const double end_s = w->s->span_s;
    root_list crossings = {0};
    look before, now;
    glint_status status = look_at(w, 0, &before, error);
    const bool up_at_start = !status && before.margin >= 0;
    while (!status && before.t_s < end_s) {
        const double step_s = fmax(before.safe_s, before.fine_s);
        status = look_at(w, fmin(before.t_s + step_s, end_s), &now, error);
        if (!status) status = crossings_between(w, &before, &now, &crossings, error);
        before = now;
    }
    if (!status)
        status = make_spans(&crossings, w->viewer.observer, up_at_start, end_s, out, error);
    root_list_free(&crossings);
    return status;
}

glint_status pass_culmination(watch *w, const pass_span *span, double *t_s, glint_error *error)
{
    /* Samples: a pass of a low satellite has one maximum; longer ones get 50 looks an orbit. */
    static const double LEAST = 64, PER_PERIOD = 50;
    sighting seen;
    glint_status status = watch_at(w, span->from_s, &seen, error);
    if (status) return status;
    const double length_s = span->to_s - span->from_s;
    const int n = (int)fmax(LEAST, ceil(PER_PERIOD * length_s / pass_period_s(&seen)));
    double best = -2;
    int at = 0;
    for (int k = 0; k <= n; k++) {
        double height;
        status = height_at(w, span->from_s + length_s * k / n, &height, error);
        if (status) return status;
        if (height > best) best = height, at = k;
    }
    *t_s = span->from_s + length_s * at / n;
    const double from_s = span->from_s + length_s * fmax(at - 1, 0) / n;
    const double to_s = span->from_s + length_s * fmin(at + 1, n) / n;
    bool found;
    double top_s;
    status = extremum(w, from_s, to_s, &top_s, &found, error);
    if (!status && found) *t_s = top_s;
    return status;
}
