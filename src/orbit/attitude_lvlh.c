/* The two local frames of an orbit, from the inertial position and velocity: LVLH in the sense of
 * the CCSDS (SANA registry of orbit-relative reference frames), and RSW, which others also call
 * LVLH. */
#include "base/vec.h"
#include "orbit/attitude_law.h"

/* Unit vectors outwards and, normal to it, forwards: the two that span the plane of the orbit.
 * Errors: GLINT_INPUT where position and velocity span none. */
static glint_status orbit_triad(const moment *m, double outward_forward_normal[9],
                                glint_error *error)
{
    static const direction zenith = {.kind = DIRECTION_ZENITH},
                           velocity = {.kind = DIRECTION_VELOCITY};
    double out[3], forward[3];
    glint_status status = direction_at(&zenith, m, out, error);
    if (!status) status = direction_at(&velocity, m, forward, error);
    if (status) return status;
    if (attitude_triad(out, forward, outward_forward_normal)) return GLINT_OK;
    return error_set(error, GLINT_INPUT, PLACE_NONE,
                     "position and velocity are parallel within %g at %.10g s from the start, so "
                     "the plane of the orbit, which this attitude follows, is not defined",
                     DIRECTION_PARALLEL, m->t_s);
}

static glint_status prepare_nadir(const attitude_spec *spec, attitude *out, glint_errors *errors)
{
    (void)spec, (void)errors;
    out->to.kind = DIRECTION_NADIR;
    out->second_to.kind = DIRECTION_VELOCITY;
    return GLINT_OK;
}

/* z to nadir and y = -(orbit normal) make x = y x z the forward direction. */
static glint_status nadir_at(const attitude *a, const moment *m, double body_gcrs[9],
                             glint_error *error)
{
    (void)a;
    double triad[9];
    const glint_status status = orbit_triad(m, triad, error);
    if (status) return status;
    copy3(triad + 3, body_gcrs);
    scale3(triad + 6, -1.0, body_gcrs + 3);
    scale3(triad, -1.0, body_gcrs + 6);
    return GLINT_OK;
}

static glint_status prepare_rsw(const attitude_spec *spec, attitude *out, glint_errors *errors)
{
    (void)spec, (void)errors;
    out->to.kind = DIRECTION_ZENITH;
    out->second_to.kind = DIRECTION_VELOCITY;
    return GLINT_OK;
}

/* x outwards and z along the orbit normal make y = z x x the forward direction. */
static glint_status rsw_at(const attitude *a, const moment *m, double body_gcrs[9],
                           glint_error *error)
{
    (void)a;
    return orbit_triad(m, body_gcrs, error);
}

const attitude_law attitude_nadir = {
    .name = "nadir",
    .doc = "z to the Earth's centre, y against the orbit normal, x forwards (CCSDS LVLH)",
    .flags = ATTITUDE_NEEDS_ORBIT,
    .prepare = prepare_nadir,
    .at = nadir_at,
};

const attitude_law attitude_rsw = {
    .name = "rsw",
    .doc = "x radially outwards, z along the orbit normal, y forwards",
    .flags = ATTITUDE_NEEDS_ORBIT,
    .prepare = prepare_rsw,
    .at = rsw_at,
};
