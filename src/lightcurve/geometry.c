#include "lightcurve/geometry.h"

#include "base/constants.h"
#include "base/vec.h"
#include "orbit/eclipse.h"
#include "orbit/moon.h"

#include <math.h>

/* Rate of the Earth rotation angle, rad/s: Capitaine, Guinot, McCarthy 2000; IERS Conventions 2010,
 * eq. 5.15. */
static const double ERA_RATE = TWO_PI * 1.00273781191135448 / DAY_S;

/* The frames tau_s earlier, to first order in what moves slowly: the Earth turns back by its rotation
 * (about ITRS z instead of the CIP, which polar motion keeps within 3e-6 rad: 3e-11 rad over a second),
 * the Sun goes back along its path. */
static void frames_earlier(const frame_set *f, double tau_s, frame_set *out)
{
    *out = *f;
    const double c = cos(ERA_RATE * tau_s), s = sin(ERA_RATE * tau_s);
    for (int i = 0; i < 3; i++) {
        out->itrs_gcrs[i] = c * f->itrs_gcrs[i] - s * f->itrs_gcrs[3 + i];
        out->itrs_gcrs[3 + i] = s * f->itrs_gcrs[i] + c * f->itrs_gcrs[3 + i];
        out->sun_gcrs_m[i] -= tau_s * (f->sun_velocity_m_s[i] - f->earth_velocity_m_s[i]);
    }
}

/* The satellite's state when the light that arrives at t_s left it; leaves the frames of emission. */
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
        const glint_status status = orbit_state(s->orbit, t_s - tau, emission, cursor, r, v, error);
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
    frame_grid_at(grid, t_s, orbit_wanted_frames(s->orbit) | FRAMES_SUN, &out->frames);
    mat_tvec(out->frames.itrs_gcrs, s->site.r_itrs_m, out->site_gcrs_m);
    frame_set emission;
    const glint_status status = solve_light_time(s, t_s, guess_s, cursor, out, &emission, error);
    if (status) return status;
    if (!(out->range_m > 0.0))
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "at t_s = %.3f the satellite is at the observer; expected a distance", t_s);
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
                                     const double parent_gcrs[9], double out[3],
                                     glint_error *error)
{
    double gcrs[3];
    const glint_status status = direction_at(target, m, gcrs, error);
    if (!status) mat_vec(parent_gcrs, gcrs, out);
    return status;
}

/* Orientation of every component at one moment, parents first, from the body's. */
static glint_status turn_components(const satellite *sat, const moment *m,
                                    const double body_gcrs[9], double (*component_gcrs)[9],
                                    glint_error *error)
{
    for (int k = 0; k < sat->n_components; k++) {
        const int c = sat->order[k];
        const scenario_component *component = &sat->components[c];
        const double *parent =
            component->parent < 0 ? body_gcrs : component_gcrs[component->parent];
        if (!component->has_hinge) {
            memcpy(component_gcrs[c], parent, 9 * sizeof(double));
            continue;
        }
        const hinge *h = &component->hinge;
        double target[3], turn[9];
        if (h->drive == HINGE_TRACK) {
            const glint_status status = target_in_parent(&h->target, m, parent, target, error);
            if (status) return status;
        }
        hinge_matrix(h, hinge_angle(h, m->t_s, h->drive == HINGE_TRACK ? target : NULL), turn);
        mat_mul(turn, parent, component_gcrs[c]);
    }
    return GLINT_OK;
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

/* Elevation of a unit vector in the site's frame, rad; precise at the zenith too. */
static double elevation_of(const double enu[3])
{
    return atan2(enu[2], sqrt(enu[0] * enu[0] + enu[1] * enu[1]));
}

static void fill_site(const glint_scenario *s, const sighting *seen, int k, tile_geometry *out)
{
    double itrs[3], enu[3], sun[3], distance_m;
    mat_vec(seen->frames.itrs_gcrs, seen->sight_gcrs, itrs);
    mat_vec(s->site.enu_itrs, itrs, enu);
    const double azimuth = atan2(enu[0], enu[1]);
    const double turned = azimuth + TWO_PI; /* may round to a full turn: that is 0 */
    out->azimuth[k] = azimuth >= 0 ? azimuth : turned < TWO_PI ? turned : 0;
    out->elevation[k] = elevation_of(enu);
    out->seen[k] = out->elevation[k] >= s->min_elevation;
    sun_from_point(&seen->frames, seen->site_gcrs_m, s->aberration, sun, &distance_m);
    mat_vec(seen->frames.itrs_gcrs, sun, itrs);
    mat_vec(s->site.enu_itrs, itrs, enu);
    out->sun_elevation[k] = elevation_of(enu);
}

/* One row of a run with an orbit. */
static glint_status fill_row(const glint_scenario *s, const frame_grid *grid, unsigned wanted,
                             double guess_s, int k, geometry_worker *worker, tile_geometry *out,
                             brdf_light *lights, sighting *seen, glint_error *error)
{
    glint_status status =
        sighting_at(s, grid, out->t_s[k], guess_s, &worker->cursor, seen, error);
    if (status) return status;
    const moment *m = &seen->moment;
    const double *pole = m->itrs_gcrs + 6;
    out->range_m[k] = seen->range_m;
    out->phase_angle[k] = angle3(m->sun, m->observer);
    out->sunlit[k] = eclipse_sunlit_fraction(m->r_m, m->sun, seen->sun_distance_m, pole);
    const double au = AU_M / seen->sun_distance_m;
    out->sun_weight[k] = out->sunlit[k] * au * au;
    fill_site(s, seen, k, out);
    if (wanted & GEOMETRY_HEIGHT) {
        double itrs[3], latitude, longitude;
        mat_vec(m->itrs_gcrs, m->r_m, itrs);
        earth_geodetic(itrs, &latitude, &longitude, &out->height_m[k]);
    }
    double body_gcrs[9];
    status = attitude_at(&s->attitude, m, body_gcrs, error);
    if (!status)
        status = turn_components(&s->satellite, m, body_gcrs, worker->component_gcrs, error);
    if (status) return status;
    light_components(&s->satellite, m, (const double(*)[9])worker->component_gcrs, k, lights);
    return GLINT_OK;
}

/* One row of a run whose directions are given in the body frame: that frame stands for GCRS. */
static glint_status fill_given_row(const glint_scenario *s, int64_t row, int k,
                                   geometry_worker *worker, tile_geometry *out,
                                   brdf_light *lights, glint_error *error)
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
    const glint_status status =
        turn_components(&s->satellite, &m, body, worker->component_gcrs, error);
    if (!status)
        light_components(&s->satellite, &m, (const double(*)[9])worker->component_gcrs, k, lights);
    return status;
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
