#include "lightcurve/geometry.h"

#include "base/constants.h"
#include "base/vec.h"
#include "orbit/eclipse.h"
#include "orbit/moon.h"

#include <math.h>
#include <stdlib.h>

/* The frames tau_s earlier, to first order in what moves slowly: the Earth turns back by its
 * rotation (about ITRS z instead of the CIP, which polar motion keeps within 3e-6 rad: 3e-11 rad
 * over a second), the Sun goes back along its path. */
static void frames_earlier(const frame_set *f, double tau_s, frame_set *out)
{
    *out = *f;
    const double c = cos(EARTH_TURN_RAD_S * tau_s), s = sin(EARTH_TURN_RAD_S * tau_s);
    for (int i = 0; i < 3; i++) {
        out->itrs_gcrs[i] = c * f->itrs_gcrs[i] - s * f->itrs_gcrs[3 + i];
        out->itrs_gcrs[3 + i] = s * f->itrs_gcrs[i] + c * f->itrs_gcrs[3 + i];
        out->sun_gcrs_m[i] -= tau_s * (f->sun_velocity_m_s[i] - f->earth_velocity_m_s[i]);
    }
}

/* The satellite's state when the light that arrives at t_s left it; leaves the frames of emission.
 */
static glint_status solve_light_time(const glint_scenario *s, double t_s, double guess_s,
                                     orbit_cursor *cursor, sighting *out, frame_set *emission,
                                     glint_error *error)
{
    /* A correction this small is applied along the velocity: it moves the satellite by at most
     * 11 mm, and the curvature of the orbit over it by 1e-11 m. */
    static const double SMALL_S = 1e-6;
    enum { MOST_ROUNDS = 10 };
    double *r = out->moment.r_m, *v = out->moment.v_m_s, rho[3];
    double tau = s->light_time ? guess_s : 0;
    for (int round = 0;; round++) {
        frames_earlier(&out->frames, tau, emission);
        const glint_status status = orbit_state(s->orbit.propagator, t_s - tau, emission, cursor, r, v, error);
        if (status) return status;
        sub3(r, out->site_gcrs_m, rho);
        out->range_m = unit3(rho, out->sight_gcrs);
        if (!s->light_time) break;
        const double change = out->range_m / LIGHT_SPEED_M_S - tau;
        tau += change;
        if (fabs(change) > SMALL_S && round < MOST_ROUNDS) continue;
        add_scaled3(r, -change, v, r);
        sub3(r, out->site_gcrs_m, rho);
        out->range_m = unit3(rho, out->sight_gcrs);
        break;
    }
    out->light_time_s = tau;
    return GLINT_OK;
}

glint_status sighting_at(const glint_scenario *s, const frame_grid *grid, double t_s,
                         double guess_s, orbit_cursor *cursor, sighting *out, glint_error *error)
{
    frame_grid_at(grid, t_s, orbit_wanted_frames(s->orbit.propagator) | FRAMES_SUN, &out->frames);
    mat_tvec(out->frames.itrs_gcrs, s->site.r_itrs_m, out->site_gcrs_m);
    frame_set emission;
    const glint_status status = solve_light_time(s, t_s, guess_s, cursor, out, &emission, error);
    if (status) return status;
    if (!(out->range_m > 0.0))
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "at t_s = %.3f the satellite is at the observer; expected a distance",
                         t_s);
    moment *m = &out->moment;
    m->t_s = t_s - out->light_time_s;
    scale3(out->sight_gcrs, -1.0, m->observer);
    memcpy(m->itrs_gcrs, emission.itrs_gcrs, sizeof m->itrs_gcrs);
    sun_from_point(&emission, m->r_m, s->aberration, m->sun, &out->sun_distance_m);
    if (s->needs_moon) {
        double moon[3];
        moon_position(&s->clock, m->t_s, moon);
        sub3(moon, m->r_m, moon);
        unit3(moon, m->moon);
    }
    return GLINT_OK;
}

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

/* The elevation is precise at the zenith too. */
void sky_place(const glint_scenario *s, const frame_set *frames, const double gcrs[3],
               double *azimuth, double *elevation)
{
    double itrs[3], enu[3];
    mat_vec(frames->itrs_gcrs, gcrs, itrs);
    mat_vec(s->site.enu_itrs, itrs, enu);
    const double angle = atan2(enu[0], enu[1]);
    const double turned = angle + TWO_PI; /* may round to a full turn: that is 0 */
    *azimuth = angle >= 0 ? angle : turned < TWO_PI ? turned : 0;
    *elevation = atan2(enu[2], sqrt(enu[0] * enu[0] + enu[1] * enu[1]));
}

static void fill_site(const glint_scenario *s, const sighting *seen, int k, tile_geometry *out)
{
    double sun[3], distance_m, sun_azimuth;
    sky_place(s, &seen->frames, seen->sight_gcrs, &out->azimuth[k], &out->elevation[k]);
    out->seen[k] = out->elevation[k] >= s->min_elevation;
    sun_from_point(&seen->frames, seen->site_gcrs_m, s->aberration, sun, &distance_m);
    sky_place(s, &seen->frames, sun, &sun_azimuth, &out->sun_elevation[k]);
}

/* How fast the satellite moves against the stars, as the site sees it. */
static double angular_rate(const sighting *seen)
{
    double spin[3], velocity[3];
    scale3(seen->frames.itrs_gcrs + 6, EARTH_TURN_RAD_S, spin);
    cross3(spin, seen->site_gcrs_m, velocity);
    sub3(seen->moment.v_m_s, velocity, velocity);
    add_scaled3(velocity, -dot3(velocity, seen->sight_gcrs), seen->sight_gcrs, velocity);
    return norm3(velocity) / seen->range_m;
}

/* One row of a run with an orbit. */
static glint_status fill_row(const glint_scenario *s, const frame_grid *grid, unsigned wanted,
                             double guess_s, int k, geometry_worker *worker, tile_geometry *out,
                             brdf_light *lights, sighting *seen, glint_error *error)
{
    glint_status status = sighting_at(s, grid, out->t_s[k], guess_s, &worker->cursor, seen, error);
    if (status) return status;
    const moment *m = &seen->moment;
    const double *pole = m->itrs_gcrs + 6;
    out->range_m[k] = seen->range_m;
    out->angular_rate[k] = angular_rate(seen);
    out->phase_angle[k] = angle3(m->sun, m->observer);
    out->sunlit[k] = eclipse_sunlit_fraction(m->r_m, m->sun, seen->sun_distance_m, pole);
    const double au = AU_M / seen->sun_distance_m;
    out->sun_radius[k] = asin(SUN_RADIUS_M / seen->sun_distance_m);
    out->sun_weight[k] = out->sunlit[k] * au * au;
    fill_site(s, seen, k, out);
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
    out->angular_rate[k] = 0;
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
