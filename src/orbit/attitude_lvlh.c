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

enum { NADIR_NADIR, N_NADIR_KEYS };
static const char *const nadirs[] = {"geocentric", "geodetic", NULL};
static const attitude_key nadir_keys[N_NADIR_KEYS] = {
    {"nadir", "", "where z points: to the Earth's centre, or straight down to the ellipsoid",
     ATTITUDE_WORD, false, 0, nadirs},
};

static glint_status prepare_nadir(const attitude_spec *spec, attitude *out, glint_errors *errors)
{
    (void)errors;
    out->geodetic = spec->value[NADIR_NADIR][0] == 1;
    out->to.kind = out->geodetic ? DIRECTION_GEODETIC_NADIR : DIRECTION_NADIR;
    out->second_to.kind = DIRECTION_VELOCITY;
    return GLINT_OK;
}

/* z straight down, at most 0.2 deg from the Earth's centre, and y as near to -(orbit normal) as
 * that allows. */
static glint_status geodetic_at(const attitude *a, const moment *m, const double normal[3],
                                double body_gcrs[9], glint_error *error)
{
    double down[3], side[3];
    const glint_status status = direction_at(&a->to, m, down, error);
    if (status) return status;
    scale3(normal, -1.0, side);
    perp3(side, down, side);
    cross3(side, down, body_gcrs);
    copy3(side, body_gcrs + 3);
    copy3(down, body_gcrs + 6);
    return GLINT_OK;
}

/* z to nadir and y = -(orbit normal) make x = y x z the forward direction. */
static glint_status nadir_at(const attitude *a, const moment *m, double body_gcrs[9],
                             glint_error *error)
{
    double triad[9];
    const glint_status status = orbit_triad(m, triad, error);
    if (status) return status;
    if (a->geodetic) return geodetic_at(a, m, triad + 6, body_gcrs, error);
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
    .doc = "z down, y against the orbit normal, x forwards (CCSDS LVLH)",
    .keys = nadir_keys,
    .n_keys = N_NADIR_KEYS,
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
