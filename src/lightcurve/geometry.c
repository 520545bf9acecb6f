#include "lightcurve/geometry.h"

#include "base/clones.h"
#include "base/constants.h"
#include "base/vec.h"
#include "lightcurve/sky.h"
#include "orbit/eclipse.h"

#include <math.h>
#include <stdlib.h>

/* Turns a direction of the vocabulary into a component's parent's axes. */
static glint_status target_in_parent(const direction *target, const moment *m,
                                     const double parent_gcrs[9], double out[3], glint_error *error)
{
    double gcrs[3];
    const glint_status status = direction_at(target, m, gcrs, error);
    if (!status) mat_vec(parent_gcrs, gcrs, out);
    return status;
}

/* Orientation of every component at one moment, parents first, from the body's; and the angle of
 * its hinge, 0 without one (hinge_rad: NULL allowed). */
static glint_status turn_components(const satellite *sat, const moment *m,
                                    const double body_gcrs[9], double (*component_gcrs)[9],
                                    double *hinge_rad, glint_error *error)
{
    for (int k = 0; k < sat->n_components; k++) {
        const int c = sat->order[k];
        const scenario_component *component = &sat->components[c];
        const double *parent =
            component->parent < 0 ? body_gcrs : component_gcrs[component->parent];
        if (!component->has_hinge) {
            memcpy(component_gcrs[c], parent, 9 * sizeof(double));
            if (hinge_rad) hinge_rad[c] = 0;
            continue;
        }
        const hinge *h = &component->hinge;
        double target[3], turn[9], angle;
        glint_status status = GLINT_OK;
        if (h->drive == HINGE_TRACK)
            status = target_in_parent(&h->target, m, parent, target, error);
        if (!status)
            status = hinge_angle(h, m->t_s, h->drive == HINGE_TRACK ? target : NULL, &angle, error);
        if (status) return status;
        hinge_matrix(h, angle, turn);
        if (hinge_rad) hinge_rad[c] = angle;
        mat_mul(turn, parent, component_gcrs[c]);
    }
    return GLINT_OK;
}

double satellite_next_change(const glint_scenario *s, double t_s)
{
    double next_s = attitude_plan_next_change(&s->attitude, t_s);
    for (int c = 0; c < s->satellite.n_components; c++)
        next_s = fmin(next_s, hinge_next_change(&s->satellite.components[c].hinge, t_s));
    return next_s;
}

glint_status satellite_turn(const glint_scenario *s, const moment *m, double body_gcrs[9],
                            double (*component_gcrs)[9], double *hinge_rad, glint_error *error)
{
    const glint_status status = attitude_plan_at(&s->attitude, m, body_gcrs, error);
    if (status) return status;
    return turn_components(&s->satellite, m, body_gcrs, component_gcrs, hinge_rad, error);
}

/* Where every component is at one moment, parents first, in the frame that body_gcrs maps from. */
static void place_components(const satellite *sat, const double body_gcrs[9],
                             const double (*component_gcrs)[9], visibility_pose *poses)
{
    for (int k = 0; k < sat->n_components; k++) {
        const int c = sat->order[k];
        const scenario_component *component = &sat->components[c];
        const int parent = component->parent;
        double origin[3] = {0, 0, 0};
        mat_transpose(component_gcrs[c], poses[c].body_component);
        /* The hinge's origin is given in the parent's coordinates: its axes are the body's without
         * one. */
        if (component->has_hinge)
            mat_tvec(parent < 0 ? body_gcrs : component_gcrs[parent], component->hinge.origin_m,
                     origin);
        if (parent >= 0) add3(origin, poses[parent].origin_m, origin);
        copy3(origin, poses[c].origin_m);
    }
}

/* Leaves directions and poses of lane k for the stage that finds out what is visible. */
static void keep_for_visibility(const satellite *sat, const moment *m, const double body_gcrs[9],
                                const geometry_worker *worker, int k, tile_geometry *out)
{
    copy3(m->sun, out->sun[k]);
    copy3(m->observer, out->observer[k]);
    if (worker->body) memcpy(worker->body[k], body_gcrs, sizeof worker->body[k]);
    if (worker->poses)
        place_components(sat, body_gcrs, (const double(*)[9])worker->component_gcrs,
                         worker->poses + (size_t)k * (size_t)sat->n_components);
}

/* Writes the Sun and the observer into lane k of every component's light. */
static void light_components(const satellite *sat, const moment *m,
                             const double (*component_gcrs)[9], int k, brdf_light *lights)
{
    for (int c = 0; c < sat->n_components; c++) {
        double i[3], r[3];
        mat_vec(component_gcrs[c], m->sun, i);
        mat_vec(component_gcrs[c], m->observer, r);
        for (int axis = 0; axis < 3; axis++) {
            lights[c].i[axis][k] = i[axis];
            lights[c].r[axis][k] = r[axis];
        }
    }
}

_Static_assert((int)TILE == (int)FRAME_LANES, "frames come by the tile");

/* What the angles of a tile follow from: number i of lane k at [i][k]. */
typedef struct view_lanes {
    double satellite[3][TILE], sun[3][TILE]; /* east, north, up of a site; else 0 */
    double phase[2][TILE];                   /* sine and cosine of the phase angle */
} view_lanes;

static void keep_lane(const double v[3], int k, double lanes[3][TILE])
{
    for (int i = 0; i < 3; i++)
        lanes[i][k] = v[i];
}

/* Leaves what the observer of lane k sees, for when all lanes are there. */
static void keep_view(const glint_scenario *s, const sighting *seen, int k,
                      const scenario_observer *who, view_lanes *lanes)
{
    double across[3], enu[3], sun[3], distance_m;
    cross3(seen->moment.sun, seen->moment.observer, across);
    lanes->phase[0][k] = norm3(across);
    lanes->phase[1][k] = dot3(seen->moment.sun, seen->moment.observer);
    if (who->kind != OBSERVER_SITE) return;
    sky_axes(who, &seen->frames, seen->sight_gcrs, enu);
    keep_lane(enu, k, lanes->satellite);
    sun_from_point(&seen->frames, seen->observer_gcrs_m, s->aberration, sun, &distance_m);
    sky_axes(who, &seen->frames, sun, enu);
    keep_lane(enu, k, lanes->sun);
}

/* Angles of all lanes at once. */
CLONES FLATTEN static void find_angles(const view_lanes *restrict l, tile_geometry *restrict out)
{
    for (int k = 0; k < TILE; k++) {
        out->phase_angle[k] = sky_angle(l->phase[0][k], l->phase[1][k]);
        out->azimuth[k] = sky_azimuth(l->satellite[0][k], l->satellite[1][k]);
        out->elevation[k] =
            sky_elevation(l->satellite[0][k], l->satellite[1][k], l->satellite[2][k]);
        out->sun_elevation[k] = sky_elevation(l->sun[0][k], l->sun[1][k], l->sun[2][k]);
    }
}

/* What follows from the angles: refraction, and what stands above the horizon. */
static void finish_view(const view_lanes *lanes, tile_geometry *out)
{
    const scenario_observer *o = out->who;
    find_angles(lanes, out);
    for (int k = 0; k < out->n; k++) {
        if (o->kind == OBSERVER_SITE) {
            out->elevation[k] = refraction_apparent(&o->air, out->elevation[k]);
            out->seen[k] = out->elevation[k] >= horizon_limit(&o->horizon, out->azimuth[k]);
        }
        if (out->seen[k] && out->sun_weight[k] > 0) out->any_bright = true;
    }
}

/* The Moon as the observer sees it. */
static void fill_moon(const glint_scenario *s, const sighting *seen, int k, viewer *v,
                      tile_geometry *out)
{
    double moon[3], sun[3], unit[3];
    sighting_moon(s, v, seen, out->t_s[k], moon);
    sub3(seen->frames.sun_gcrs_m, seen->observer_gcrs_m, sun);
    out->moon_separation[k] = angle3(moon, seen->sight_gcrs);
    out->moon_illuminated[k] = moon_illuminated(moon, sun);
    out->moon_azimuth[k] = out->moon_elevation[k] = 0;
    unit3(moon, unit);
    if (out->who->kind == OBSERVER_SITE)
        sky_place(out->who, &seen->frames, unit, &out->moon_azimuth[k], &out->moon_elevation[k]);
}

/* How fast the satellite moves against the stars, as a site or a satellite sees it; 0 from a fixed
 * direction. */
static double angular_rate(const sighting *seen, const scenario_observer *who)
{
    double velocity[3];
    if (who->kind == OBSERVER_DIRECTION) return 0;
    sub3(seen->moment.v_m_s, seen->observer_v_m_s, velocity);
    add_scaled3(velocity, -dot3(velocity, seen->sight_gcrs), seen->sight_gcrs, velocity);
    return norm3(velocity) / seen->range_m;
}

/* One row of a run with an orbit, but for its angles; seen: with the frames. */
static glint_status fill_row(const glint_scenario *s, unsigned wanted, double guess_s, int k,
                             geometry_worker *worker, tile_geometry *out, brdf_light *lights,
                             view_lanes *lanes, sighting *seen, glint_error *error)
{
    viewer *v = &worker->viewer;
    glint_status status = sighting_complete(s, out->t_s[k], guess_s, v, seen, error);
    if (status) return status;
    const moment *m = &seen->moment;
    out->range_m[k] = seen->range_m;
    out->sunlit[k] = sighting_sunlit(s, v, seen, &out->moon_covers[k]);
    const double au = AU_M / seen->sun_distance_m;
    out->sun_radius[k] = asin(SUN_RADIUS_M / seen->sun_distance_m);
    out->sun_weight[k] = out->sunlit[k] * au * au;
    out->sun_distance_m[k] = seen->sun_distance_m;
    copy3(m->r_m, out->satellite_m[k]);
    out->seen[k] = v->observer->kind != OBSERVER_SATELLITE ||
                   !eclipse_earth_between(seen->observer_gcrs_m, m->r_m, m->itrs_gcrs + 6);
    keep_view(s, seen, k, v->observer, lanes);
    if (wanted & GEOMETRY_MOON) fill_moon(s, seen, k, v, out);
    out->angular_rate[k] = wanted & GEOMETRY_RATE ? angular_rate(seen, v->observer) : 0;
    if (wanted & GEOMETRY_HEIGHT) {
        double itrs[3], latitude, longitude;
        mat_vec(m->itrs_gcrs, m->r_m, itrs);
        earth_geodetic(itrs, &latitude, &longitude, &out->height_m[k]);
    }
    double body_gcrs[9];
    status = satellite_turn(s, m, body_gcrs, worker->component_gcrs, NULL, error);
    if (status) return status;
    light_components(&s->satellite, m, (const double(*)[9])worker->component_gcrs, k, lights);
    keep_for_visibility(&s->satellite, m, body_gcrs, worker, k, out);
    return GLINT_OK;
}

/* One row of a run whose directions are given in the body frame: that frame stands for GCRS. */
static glint_status fill_given_row(const glint_scenario *s, int64_t row, int k,
                                   geometry_worker *worker, tile_geometry *out, brdf_light *lights,
                                   glint_error *error)
{
    double body[9];
    moment m = {.t_s = out->t_s[k]};
    mat_identity(body);
    copy3(s->geometry.sun[row], m.sun);
    copy3(s->geometry.observer[row], m.observer);
    out->range_m[k] = s->geometry.range_m[row];
    out->phase_angle[k] = angle3(m.sun, m.observer);
    out->sunlit[k] = out->sun_weight[k] = 1;
    out->sun_radius[k] = asin(SUN_RADIUS_M / AU_M);
    out->seen[k] = true;
    out->moon_covers[k] = false;
    out->angular_rate[k] = 0;
    out->azimuth[k] = out->elevation[k] = out->sun_elevation[k] = 0;
    const glint_status status =
        turn_components(&s->satellite, &m, body, worker->component_gcrs, NULL, error);
    if (status) return status;
    light_components(&s->satellite, &m, (const double(*)[9])worker->component_gcrs, k, lights);
    keep_for_visibility(&s->satellite, &m, body, worker, k, out);
    return GLINT_OK;
}

/* Spare lanes get the last row's light, so that they hold usable numbers. */
static void fill_spare_lanes(int n, int n_components, brdf_light *lights)
{
    for (int c = 0; c < n_components; c++) {
        for (int axis = 0; axis < 3; axis++)
            for (int k = n; k < TILE; k++) {
                lights[c].i[axis][k] = lights[c].i[axis][n - 1];
                lights[c].r[axis][k] = lights[c].r[axis][n - 1];
            }
        brdf_light_finish(&lights[c]);
    }
}

/* Rows of a run whose directions are given. */
static glint_status fill_given(const glint_scenario *s, int64_t first, geometry_worker *worker,
                               tile_geometry *out, brdf_light *lights, glint_error *error)
{
    for (int k = 0; k < out->n; k++) {
        out->t_s[k] = s->geometry.t_s[first + k];
        const glint_status status = fill_given_row(s, first + k, k, worker, out, lights, error);
        if (status) return status;
        out->any_bright = true;
    }
    return GLINT_OK;
}

/* Rows of a run with an orbit, at out->t_s. in_steps: times are steps of a run, so that the next
 * light time is guessed by straight extrapolation: right to 1e-6 s for short steps. */
static glint_status fill_rows(const glint_scenario *s, const frame_grid *grid, unsigned wanted,
                              bool in_steps, geometry_worker *worker, tile_geometry *out,
                              brdf_light *lights, glint_error *error)
{
    frame_set frames[TILE];
    view_lanes lanes = {0};
    sighting seen;
    double guess_s = 0, before_s = 0;
    frame_grid_fill(grid, out->t_s, out->n, sighting_wanted_frames(s, &worker->viewer), frames);
    for (int k = 0; k < out->n; k++) {
        seen.frames = frames[k];
        const glint_status status =
            fill_row(s, wanted, guess_s, k, worker, out, lights, &lanes, &seen, error);
        if (status) return status;
        const double rate = in_steps && k > 0 ? seen.light_time_s - before_s : 0;
        before_s = seen.light_time_s;
        guess_s = before_s + rate > 0 ? before_s + rate : before_s;
    }
    finish_view(&lanes, out);
    return GLINT_OK;
}

glint_status geometry_fill(const glint_scenario *s, const frame_grid *grid, unsigned wanted,
                           int64_t first, int n, geometry_worker *worker, tile_geometry *out,
                           brdf_light *lights, glint_error *error)
{
    out->first = first;
    out->n = n;
    out->who = s->has_geometry ? NULL : worker->viewer.observer;
    out->any_bright = false;
    for (int k = 0; k < n; k++)
        out->t_s[k] = (double)(first + k) * s->step_s;
    const glint_status status = s->has_geometry
                                    ? fill_given(s, first, worker, out, lights, error)
                                    : fill_rows(s, grid, wanted, true, worker, out, lights, error);
    if (!status) fill_spare_lanes(n, s->satellite.n_components, lights);
    return status;
}

glint_status geometry_fill_at(const glint_scenario *s, const frame_grid *grid, unsigned wanted,
                              const double *t_s, int n, geometry_worker *worker, tile_geometry *out,
                              brdf_light *lights, glint_error *error)
{
    out->first = 0;
    out->n = n;
    out->who = worker->viewer.observer;
    out->any_bright = false;
    memcpy(out->t_s, t_s, (size_t)n * sizeof *t_s);
    const glint_status status = fill_rows(s, grid, wanted, false, worker, out, lights, error);
    if (!status) fill_spare_lanes(n, s->satellite.n_components, lights);
    return status;
}

/* The components as the visibility stage takes them, from malloc. NULL when memory is out. */
static visibility_component *components_for_plan(const satellite *sat)
{
    const size_t n = (size_t)sat->n_components;
    double body[9], (*component_body)[9] = calloc(n, sizeof *component_body);
    visibility_pose *poses = calloc(n, sizeof *poses);
    visibility_component *components = calloc(n, sizeof *components);
    if (!component_body || !poses || !components) {
        free(component_body);
        free(poses);
        free(components);
        return NULL;
    }
    mat_identity(body);
    for (size_t k = 0; k < n; k++) { /* at angle 0 of all hinges but the fixed ones */
        const size_t c = (size_t)sat->order[k];
        const scenario_component *part = &sat->components[c];
        const bool turned = part->has_hinge && part->hinge.drive == HINGE_FIXED;
        double turn[9], angle = 0;
        if (turned) (void)hinge_angle(&part->hinge, 0, NULL, &angle, NULL); /* fixed ones hold */
        hinge_matrix(&part->hinge, angle, turn);
        mat_mul(turn, part->parent < 0 ? body : component_body[part->parent], component_body[c]);
    }
    place_components(sat, body, (const double(*)[9])component_body, poses);
    for (size_t c = 0; c < n; c++) {
        const scenario_component *part = &sat->components[c];
        components[c] =
            (visibility_component){.parent = part->parent,
                                   .moves = part->has_hinge && part->hinge.drive != HINGE_FIXED,
                                   .pose = poses[c]};
        copy3(part->hinge.axis, components[c].axis);
    }
    free(component_body);
    free(poses);
    return components;
}

glint_status satellite_plan_shadows(const satellite *sat, visibility **out, glint_error *error)
{
    *out = NULL;
    visibility_component *components = components_for_plan(sat);
    if (!components) return error_no_memory(error);
    const glint_status status = visibility_make(&sat->model, components, out, error);
    free(components);
    return status;
}

glint_status satellite_count_shadowed(const satellite *sat, int *counts, glint_error *error)
{
    visibility_component *components = components_for_plan(sat);
    if (!components) return error_no_memory(error);
    const glint_status status = visibility_count_exposed(&sat->model, components, counts, error);
    free(components);
    return status;
}
