#include "lightcurve/sighting.h"

#include "base/constants.h"
#include "base/fasttrig.h"
#include "base/vec.h"
#include "lightcurve/sky.h"
#include "orbit/eclipse.h"

#include <math.h>

/* The frames tau_s earlier, to first order in what moves slowly: the Earth turns back by its
 * rotation (about ITRS z instead of the CIP, which polar motion keeps within 3e-6 rad: 3e-11 rad
 * over a second), the Sun goes back along its path. */
static void frames_earlier(const frame_set *f, double tau_s, frame_set *out)
{
    static const double SMALL = 1e-3; /* rad: 14 s */
    const double angle = EARTH_TURN_RAD_S * tau_s;
    double s = 0, c = 1;
    if (fabs(angle) < SMALL)
        turn_sin_cos(angle, &s, &c);
    else
        fast_sin_cos(angle, &s, &c);
    *out = *f;
    for (int i = 0; i < 3; i++) {
        out->itrs_gcrs[i] = c * f->itrs_gcrs[i] - s * f->itrs_gcrs[3 + i];
        out->itrs_gcrs[3 + i] = s * f->itrs_gcrs[i] + c * f->itrs_gcrs[3 + i];
        out->sun_gcrs_m[i] -= tau_s * (f->sun_velocity_m_s[i] - f->earth_velocity_m_s[i]);
    }
}

/* The satellite's state when the light that arrives at t_s left it; leaves the frames of emission.
 */
static glint_status solve_light_time(const glint_scenario *s, double t_s, double guess_s, viewer *v,
                                     sighting *out, frame_set *emission, glint_error *error)
{
    /* A correction this small is applied along the velocity: it moves the satellite by at most
     * 11 mm, and the curvature of the orbit over it by 1e-11 m. */
    static const double SMALL_S = 1e-6;
    enum { MOST_ROUNDS = 10 };
    double *r = out->moment.r_m, *speed = out->moment.v_m_s, rho[3];
    double tau = s->light_time ? guess_s : 0;
    for (int round = 0;; round++) {
        frames_earlier(&out->frames, tau, emission);
        const glint_status status =
            orbit_state(s->orbit.propagator, t_s - tau, emission, &v->target, r, speed, error);
        if (status) return status;
        sub3(r, out->observer_gcrs_m, rho);
        if (!s->light_time) break;
        const double change = norm3(rho) * (1 / LIGHT_SPEED_M_S) - tau;
        tau += change;
        if (fabs(change) > SMALL_S && round < MOST_ROUNDS) continue;
        add_scaled3(r, -change, speed, r);
        sub3(r, out->observer_gcrs_m, rho);
        break;
    }
    out->range_m = unit3(rho, out->sight_gcrs);
    out->light_time_s = tau;
    return GLINT_OK;
}

/* Where a site or a satellite is when the light arrives. */
static glint_status place_observer(double t_s, viewer *v, sighting *out, glint_error *error)
{
    const scenario_observer *o = v->observer;
    if (o->kind == OBSERVER_SATELLITE)
        return orbit_state(o->orbit.propagator, t_s, &out->frames, &v->own, out->observer_gcrs_m,
                           out->observer_v_m_s, error);
    double spin[3];
    mat_tvec(out->frames.itrs_gcrs, o->site.r_itrs_m, out->observer_gcrs_m);
    scale3(out->frames.itrs_gcrs + 6, EARTH_TURN_RAD_S, spin);
    cross3(spin, out->observer_gcrs_m, out->observer_v_m_s);
    return GLINT_OK;
}

/* What is known of the satellite when its light leaves it, but for the observer. */
static void fill_moment(const glint_scenario *s, double t_s, const frame_set *emission, viewer *v,
                        sighting *out)
{
    moment *m = &out->moment;
    m->t_s = t_s - out->light_time_s;
    m->viewer = (int)(v->observer - s->observers);
    memcpy(m->itrs_gcrs, emission->itrs_gcrs, sizeof m->itrs_gcrs);
    sun_from_point(emission, m->r_m, s->aberration, m->sun, &out->sun_distance_m);
    if (s->needs_moon) {
        double moon[3];
        moon_position(&s->clock, m->t_s, &v->moon, moon);
        sub3(moon, m->r_m, moon);
        unit3(moon, m->moon);
    }
}

/* The observer stands in a fixed direction, so that the satellite is known first. */
static glint_status look_from_direction(const glint_scenario *s, double t_s, viewer *v,
                                        sighting *out, glint_error *error)
{
    const scenario_observer *o = v->observer;
    moment *m = &out->moment;
    frame_set emission;
    out->range_m = o->range_m;
    out->light_time_s = s->light_time ? o->range_m / LIGHT_SPEED_M_S : 0;
    frames_earlier(&out->frames, out->light_time_s, &emission);
    glint_status status = orbit_state(s->orbit.propagator, t_s - out->light_time_s, &emission,
                                      &v->target, m->r_m, m->v_m_s, error);
    if (status) return status;
    fill_moment(s, t_s, &emission, v, out);
    copy3(o->direction, m->observer);
    if (o->in_body) {
        double body_gcrs[9];
        status = attitude_plan_at(&s->attitude, m, body_gcrs, error);
        if (status) return status;
        mat_tvec(body_gcrs, o->direction, m->observer);
    }
    scale3(m->observer, -1.0, out->sight_gcrs);
    add_scaled3(m->r_m, o->range_m, m->observer, out->observer_gcrs_m);
    scale3(m->v_m_s, 0.0, out->observer_v_m_s);
    return GLINT_OK;
}

glint_status sighting_at(const glint_scenario *s, const frame_grid *grid, double t_s,
                         double guess_s, viewer *v, sighting *out, glint_error *error)
{
    frame_grid_at(grid, t_s, sighting_wanted_frames(s, v), &out->frames);
    return sighting_complete(s, t_s, guess_s, v, out, error);
}

unsigned sighting_wanted_frames(const glint_scenario *s, const viewer *v)
{
    const scenario_observer *o = v->observer;
    unsigned wanted = orbit_wanted_frames(s->orbit.propagator) | FRAMES_SUN;
    if (o->kind == OBSERVER_SATELLITE) wanted |= orbit_wanted_frames(o->orbit.propagator);
    return wanted;
}

glint_status sighting_complete(const glint_scenario *s, double t_s, double guess_s, viewer *v,
                               sighting *out, glint_error *error)
{
    const scenario_observer *o = v->observer;
    if (o->kind == OBSERVER_DIRECTION) return look_from_direction(s, t_s, v, out, error);
    frame_set emission;
    glint_status status = place_observer(t_s, v, out, error);
    if (!status) status = solve_light_time(s, t_s, guess_s, v, out, &emission, error);
    if (status) return status;
    if (!(out->range_m > 0.0))
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "at t_s = %.3f the satellite is at the observer; expected a distance",
                         t_s);
    fill_moment(s, t_s, &emission, v, out);
    scale3(out->sight_gcrs, -1.0, out->moment.observer);
    return GLINT_OK;
}

void sky_axes(const scenario_observer *site, const frame_set *frames, const double gcrs[3],
              double enu[3])
{
    double itrs[3];
    mat_vec(frames->itrs_gcrs, gcrs, itrs);
    mat_vec(site->site.enu_itrs, itrs, enu);
}

void sky_place(const scenario_observer *site, const frame_set *frames, const double gcrs[3],
               double *azimuth, double *elevation)
{
    double enu[3];
    sky_axes(site, frames, gcrs, enu);
    *azimuth = sky_azimuth(enu[0], enu[1]);
    *elevation = sky_elevation(enu[0], enu[1], enu[2]);
}

void sighting_place(const scenario_observer *site, const sighting *seen, double *azimuth,
                    double *elevation)
{
    sky_place(site, &seen->frames, seen->sight_gcrs, azimuth, elevation);
    *elevation = refraction_apparent(&site->air, *elevation);
}

double sighting_sun_elevation(const glint_scenario *s, const scenario_observer *site,
                              const sighting *seen)
{
    double sun[3], distance_m, azimuth, elevation;
    sun_from_point(&seen->frames, seen->observer_gcrs_m, s->aberration, sun, &distance_m);
    sky_place(site, &seen->frames, sun, &azimuth, &elevation);
    return elevation;
}

/* How long before and after a moment the Moon surely stays away from the Sun, as the satellite sees
 * them. The two discs are less than 5.3 deg in radius together while the Moon is farther than
 * 20 000 km; nothing on an orbit about the Earth moves faster than 12 km/s, the Moon 1.1 km/s, and
 * the Sun's direction not by more than a degree in the longest time that comes out. */
static double moon_away_s(const double moon_m[3], const double sun[3])
{
    static const double NEAR = 6.5 * DEG, NEAR_M = 2e7, SPEED_M_S = 13.5e3;
    const double distance_m = norm3(moon_m), free = angle3(moon_m, sun) - NEAR;
    if (!(free > 0 && distance_m > 2 * NEAR_M)) return 0;
    return (distance_m - NEAR_M) * sin(fmin(free, 0.5 * PI)) / SPEED_M_S;
}

static double limb_darkening(const glint_scenario *s)
{
    return s->solar_disc == SOLAR_LIMB_DARKENED ? SUN_LIMB_DARKENING : 0;
}

/* Visible fraction of the solar disc past the Moon, 1 nearly always. */
static double past_moon(const glint_scenario *s, viewer *v, const sighting *seen)
{
    const moment *m = &seen->moment;
    double moon[3];
    if (m->t_s > v->no_moon_from_s && m->t_s < v->no_moon_to_s) return 1;
    moon_position(&s->clock, m->t_s, &v->moon, moon);
    sub3(moon, m->r_m, moon);
    const double away_s = moon_away_s(moon, m->sun);
    v->no_moon_from_s = m->t_s - away_s;
    v->no_moon_to_s = m->t_s + away_s;
    return eclipse_moon_fraction(moon, m->sun, seen->sun_distance_m, limb_darkening(s));
}

double sighting_sunlit(const glint_scenario *s, viewer *v, const sighting *seen, bool *moon_covers)
{
    const moment *m = &seen->moment;
    const double past_earth = eclipse_sunlit_fraction(m->r_m, m->sun, seen->sun_distance_m,
                                                      m->itrs_gcrs + 6, limb_darkening(s));
    if (moon_covers) *moon_covers = false;
    if (!(past_earth > 0)) return past_earth;
    const double beside_moon = past_moon(s, v, seen);
    if (moon_covers) *moon_covers = beside_moon < 1;
    return past_earth * beside_moon;
}

double sighting_moon_gap(const glint_scenario *s, viewer *v, const sighting *seen)
{
    const moment *m = &seen->moment;
    double moon[3];
    moon_position(&s->clock, m->t_s, &v->moon, moon);
    sub3(moon, m->r_m, moon);
    return eclipse_moon_gap(moon, m->sun, seen->sun_distance_m);
}

void sighting_moon(const glint_scenario *s, viewer *v, const sighting *seen, double t_s,
                   double moon_m[3])
{
    moon_position(&s->clock, t_s, &v->moon, moon_m);
    sub3(moon_m, seen->observer_gcrs_m, moon_m);
}
