/* Steady rotation about a body axis that is held along a pole.
 *
 * The phase is counted from the attitude in which a second body axis, e, is as near as possible to
 * GCRS z, or to GCRS x where the pole is z. e is the axis that follows, in x -> y -> z -> x, the
 * one that body_axis is nearest to; its component along body_axis is then at most 1/sqrt(2) and
 * never in the way. Turning about the pole moves e on a cone, on which it comes nearest where its
 * part normal to body_axis and the reference's part normal to the pole coincide. */
#include "base/constants.h"
#include "base/vec.h"
#include "orbit/attitude_law.h"

enum { BODY_AXIS, POLE, PERIOD, RATE, PHASE, EPOCH, N_KEYS };
static const attitude_key keys[N_KEYS] = {
    {"body_axis", "", "body axis about which it turns, right-handed", ATTITUDE_AXIS, true, 0, NULL},
    {"pole", "", "where body_axis points", ATTITUDE_DIRECTION, true, 0, NULL},
    {"period_s", "s", "time of one turn, above 0; this or rate_deg_s", ATTITUDE_NUMBER, false, 0,
     NULL},
    {"rate_deg_s", "deg/s", "rate of turning; this or period_s", ATTITUDE_NUMBER, false, 0, NULL},
    {"phase_deg", "deg", "angle turned at the epoch", ATTITUDE_NUMBER, false, 0, NULL},
    {"epoch", "", "UTC time at which phase_deg holds; the start of the run if not given",
     ATTITUDE_EPOCH, false, 0, NULL},
};

/* Exactly one of the two keys says how fast the body turns. */
static glint_status read_rate(const attitude_spec *spec, double *rate_rad_s, glint_errors *errors)
{
    const bool has_period = spec->given[PERIOD], has_rate = spec->given[RATE];
    *rate_rad_s = 0.0;
    if (has_period && has_rate)
        return errors_add(errors, GLINT_INPUT, spec->key_place[RATE],
                          "'rate_deg_s' and 'period_s' say the same thing; expected only one");
    if (!has_period && !has_rate)
        return errors_add(errors, GLINT_INPUT, spec->where,
                          "the law 'spin' needs one of the keys 'period_s' and 'rate_deg_s'");
    const double period_s = spec->value[PERIOD][0];
    *rate_rad_s = has_rate ? spec->value[RATE][0] * DEG : TWO_PI / period_s;
    if (has_period && !(period_s > 0.0 && isfinite(*rate_rad_s)))
        return errors_add(errors, GLINT_INPUT, spec->key_place[PERIOD],
                          "'period_s' is %g; expected a number above 0 (a negative 'rate_deg_s' "
                          "turns the other way)",
                          period_s);
    return GLINT_OK;
}

static glint_status prepare(const attitude_spec *spec, attitude *out, glint_errors *errors)
{
    copy3(spec->value[BODY_AXIS], out->axis);
    out->second_axis[(largest3(out->axis) + 1) % 3] = 1.0;
    attitude_triad(out->axis, out->second_axis, out->matrix);
    out->to = spec->to[POLE];
    out->second_to.kind = DIRECTION_NORTH; /* GCRS z */
    out->phase_rad = spec->value[PHASE][0] * DEG;
    out->epoch_s = spec->value[EPOCH][0];
    return read_rate(spec, &out->rate_rad_s, errors);
}

/* Turning the body right-handed by `angle` about the pole, the first row of the triad in GCRS,
 * turns the other two rows with it. */
static void turn_triad(double angle, double triad[9])
{
    const double c = cos(angle), s = sin(angle);
    for (int i = 0; i < 3; i++) {
        const double y = triad[3 + i], z = triad[6 + i];
        triad[3 + i] = c * y + s * z;
        triad[6 + i] = c * z - s * y;
    }
}

static glint_status at(const attitude *a, const moment *m, double body_gcrs[9], glint_error *error)
{
    static const double x[3] = {1, 0, 0}, z[3] = {0, 0, 1};
    double pole[3], triad[9];
    const glint_status status = direction_at(&a->to, m, pole, error);
    if (status) return status;
    if (!attitude_triad(pole, z, triad)) attitude_triad(pole, x, triad);
    turn_triad(a->phase_rad + a->rate_rad_s * (m->t_s - a->epoch_s), triad);
    attitude_align(a->matrix, triad, body_gcrs);
    return GLINT_OK;
}

static void turning(const attitude *a, attitude_turning *out)
{
    out->fastest_rad_s = fabs(a->rate_rad_s);
    out->is_steady = true;
    copy3(a->axis, out->axis_body);
}

const attitude_law attitude_spin = {
    .name = "spin",
    .doc = "steady rotation about a body axis that is held along a pole",
    .keys = keys,
    .n_keys = N_KEYS,
    .prepare = prepare,
    .at = at,
    .turning = turning,
};
