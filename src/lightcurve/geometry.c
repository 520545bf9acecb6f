#include "lightcurve/geometry.h"

#include "base/constants.h"
#include "base/vec.h"
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
        double target[3], turn[9];
        if (h->drive == HINGE_TRACK) {
            const glint_status status = target_in_parent(&h->target, m, parent, target, error);
            if (status) return status;
        }
        const double angle = hinge_angle(h, m->t_s, h->drive == HINGE_TRACK ? target : NULL);
        hinge_matrix(h, angle, turn);
        if (hinge_rad) hinge_rad[c] = angle;
        mat_mul(turn, parent, component_gcrs[c]);
    }
    return GLINT_OK;
}

glint_status satellite_turn(const glint_scenario *s, const moment *m, double body_gcrs[9],
                            double (*component_gcrs)[9], double *hinge_rad, glint_error *error)
{
    const glint_status status = attitude_at(&s->attitude, m, body_gcrs, error);
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

/* Whether the observer can see the satellite, and where in its sky it is. */
static void fill_view(const glint_scenario *s, const sighting *seen, int k, tile_geometry *out)
{
    const scenario_observer *o = out->who;
    out->azimuth[k] = out->elevation[k] = out->sun_elevation[k] = 0;
    out->seen[k] = true;
    if (o->kind == OBSERVER_SATELLITE)
        out->seen[k] = !eclipse_earth_between(seen->observer_gcrs_m, seen->moment.r_m,
                                              seen->moment.itrs_gcrs + 6);
    if (o->kind != OBSERVER_SITE) return;
    sighting_place(o, seen, &out->azimuth[k], &out->elevation[k]);
    out->seen[k] = out->elevation[k] >= horizon_limit(&o->horizon, out->azimuth[k]);
    out->sun_elevation[k] = sighting_sun_elevation(s, o, seen);
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

/* One row of a run with an orbit. */
static glint_status fill_row(const glint_scenario *s, const frame_grid *grid, unsigned wanted,
                             double guess_s, int k, geometry_worker *worker, tile_geometry *out,
                             brdf_light *lights, sighting *seen, glint_error *error)
{
    viewer *v = &worker->viewer;
    glint_status status = sighting_at(s, grid, out->t_s[k], guess_s, v, seen, error);
    if (status) return status;
    const moment *m = &seen->moment;
    out->range_m[k] = seen->range_m;
    out->phase_angle[k] = angle3(m->sun, m->observer);
    out->sunlit[k] = sighting_sunlit(s, v, seen, &out->moon_covers[k]);
    const double au = AU_M / seen->sun_distance_m;
    out->sun_weight[k] = out->sunlit[k] * au * au;
    fill_view(s, seen, k, out);
    if (wanted & GEOMETRY_MOON) fill_moon(s, seen, k, v, out);
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
    out->seen[k] = true;
    out->moon_covers[k] = false;
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

glint_status geometry_fill(const glint_scenario *s, const frame_grid *grid, unsigned wanted,
                           int64_t first, int n, geometry_worker *worker, tile_geometry *out,
                           brdf_light *lights, glint_error *error)
{
    sighting seen;
    double guess_s = 0, rate = 0, before_s = 0;
    out->first = first;
    out->n = n;
    out->who = s->has_geometry ? NULL : worker->viewer.observer;
    out->any_bright = false;
    for (int k = 0; k < n; k++) {
        glint_status status;
        if (s->has_geometry) {
            out->t_s[k] = s->geometry.t_s[first + k];
            status = fill_given_row(s, first + k, k, worker, out, lights, error);
        } else {
            out->t_s[k] = (double)(first + k) * s->step_s;
            status = fill_row(s, grid, wanted, guess_s, k, worker, out, lights, &seen, error);
            /* The next light time by straight extrapolation: right to 1e-6 s for short steps. */
            if (k > 0) rate = seen.light_time_s - before_s;
            before_s = seen.light_time_s;
            guess_s = before_s + rate > 0 ? before_s + rate : before_s;
        }
        if (status) return status;
        if (out->seen[k] && out->sun_weight[k] > 0) out->any_bright = true;
    }
    fill_spare_lanes(n, s->satellite.n_components, lights);
    return GLINT_OK;
}

glint_status geometry_fill_at(const glint_scenario *s, const frame_grid *grid, unsigned wanted,
                              const double *t_s, int n, geometry_worker *worker, tile_geometry *out,
                              brdf_light *lights, glint_error *error)
{
    sighting seen = {0};
    out->first = 0;
    out->n = n;
    out->who = worker->viewer.observer;
    out->any_bright = false;
    for (int k = 0; k < n; k++) {
        out->t_s[k] = t_s[k];
        const glint_status status =
            fill_row(s, grid, wanted, seen.light_time_s, k, worker, out, lights, &seen, error);
        if (status) return status;
        if (out->seen[k] && out->sun_weight[k] > 0) out->any_bright = true;
    }
    fill_spare_lanes(n, s->satellite.n_components, lights);
    return GLINT_OK;
}

glint_status satellite_plan_shadows(const satellite *sat, visibility **out, glint_error *error)
{
    const size_t n = (size_t)sat->n_components;
    double body[9], (*component_body)[9] = calloc(n, sizeof *component_body);
    visibility_pose *poses = calloc(n, sizeof *poses);
    visibility_component *components = calloc(n, sizeof *components);
    *out = NULL;
    glint_status status = GLINT_INTERNAL;
    if (component_body && poses && components) {
        mat_identity(body);
        for (size_t k = 0; k < n; k++) { /* at angle 0 of all hinges but the fixed ones */
            const size_t c = (size_t)sat->order[k];
            const scenario_component *part = &sat->components[c];
            const bool turned = part->has_hinge && part->hinge.drive == HINGE_FIXED;
            double turn[9];
            hinge_matrix(&part->hinge, turned ? hinge_angle(&part->hinge, 0, NULL) : 0, turn);
            mat_mul(turn, part->parent < 0 ? body : component_body[part->parent],
                    component_body[c]);
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
        status = visibility_make(&sat->model, components, out, error);
    } else {
        error_no_memory(error);
    }
    free(component_body);
    free(poses);
    free(components);
    return status;
}
