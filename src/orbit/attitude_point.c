/* Pointing: one body axis exactly towards a direction, a second one as near to another direction as
 * that allows. Turning about the first axis, the second comes nearest where both it and its
 * direction have their parts normal to the first on the same side: the two triads coincide. */
#include "base/vec.h"
#include "orbit/attitude_law.h"

/* True, with the vector, for directions that no moment changes. */
static bool fixed_in_gcrs(const direction *d, double out[3])
{
    static const double north[3] = {0, 0, 1};
    if (d->kind != DIRECTION_STAR && d->kind != DIRECTION_NORTH) return false;
    copy3(d->kind == DIRECTION_STAR ? d->star : north, out);
    return true;
}

static bool is_vertical(direction_kind kind)
{
    return kind == DIRECTION_NADIR || kind == DIRECTION_ZENITH;
}

/* True where two directions are parallel or opposite at every moment, so that no moment is needed
 * to refuse them. */
static bool always_parallel(const direction *a, const direction *b)
{
    double p[3], q[3], triad[9];
    if (fixed_in_gcrs(a, p) && fixed_in_gcrs(b, q)) return !attitude_triad(p, q, triad);
    if (a->kind == DIRECTION_PLACE && b->kind == DIRECTION_PLACE) {
        double apart_m[3];
        sub3(a->place_itrs_m, b->place_itrs_m, apart_m);
        return !(norm3(apart_m) > 0.0);
    }
    return a->kind == b->kind || (is_vertical(a->kind) && is_vertical(b->kind));
}

/* The part that both laws share; out->to is set. axis, second_axis, second_to: positions of the
 * keys. */
static glint_status prepare_pair(const attitude_spec *spec, int axis, int second_axis,
                                 int second_to, attitude *out, glint_errors *errors)
{
    glint_status status = GLINT_OK;
    copy3(spec->value[axis], out->axis);
    copy3(spec->value[second_axis], out->second_axis);
    out->second_to = spec->to[second_to];
    if (!attitude_triad(out->axis, out->second_axis, out->matrix))
        status = errors_add(errors, GLINT_INPUT, spec->key_place[second_axis],
                            "'second_axis' is parallel to 'axis' within %g; expected another axis "
                            "of the body",
                            DIRECTION_PARALLEL);
    if (always_parallel(&out->to, &out->second_to))
        status = errors_add(errors, GLINT_INPUT, spec->key_place[second_to],
                            "'second_to' is '%s', always parallel to '%s', where 'axis' points; "
                            "expected another direction",
                            direction_name(&out->second_to), direction_name(&out->to));
    return status;
}

static glint_status point_at(const attitude *a, const moment *m, double body_gcrs[9],
                             glint_error *error)
{
    double to[3], second_to[3], triad[9];
    glint_status status = direction_at(&a->to, m, to, error);
    if (!status) status = direction_at(&a->second_to, m, second_to, error);
    if (status) return status;
    if (!attitude_triad(to, second_to, triad))
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "the directions '%s' and '%s' are parallel within %g at %.10g s from the "
                         "start, so the attitude is not defined",
                         direction_name(&a->to), direction_name(&a->second_to), DIRECTION_PARALLEL,
                         m->t_s);
    attitude_align(a->matrix, triad, body_gcrs);
    return GLINT_OK;
}

enum { POINT_AXIS, POINT_TO, POINT_SECOND_AXIS, POINT_SECOND_TO, N_POINT_KEYS };
static const attitude_key point_keys[N_POINT_KEYS] = {
    {"axis", "", "body axis that points exactly", ATTITUDE_AXIS, true, 0, NULL},
    {"to", "", "where it points", ATTITUDE_DIRECTION, true, 0, NULL},
    {"second_axis", "", "body axis that points as nearly as the first allows", ATTITUDE_AXIS, true,
     0, NULL},
    {"second_to", "", "where the second axis points", ATTITUDE_DIRECTION, true, 0, NULL},
};

static glint_status prepare_point(const attitude_spec *spec, attitude *out, glint_errors *errors)
{
    out->to = spec->to[POINT_TO];
    return prepare_pair(spec, POINT_AXIS, POINT_SECOND_AXIS, POINT_SECOND_TO, out, errors);
}

const attitude_law attitude_point = {
    .name = "point",
    .doc = "a body axis exactly towards a direction, a second as near to another as may be",
    .keys = point_keys,
    .n_keys = N_POINT_KEYS,
    .prepare = prepare_point,
    .at = point_at,
};

enum { SUN_AXIS, SUN_SECOND_AXIS, SUN_SECOND_TO, N_SUN_KEYS };
static const attitude_key sun_pointing_keys[N_SUN_KEYS] = {
    {"axis", "", "body axis that points exactly at the Sun", ATTITUDE_AXIS, true, 0, NULL},
    {"second_axis", "", "body axis that points as nearly as the first allows", ATTITUDE_AXIS, true,
     0, NULL},
    {"second_to", "", "where the second axis points", ATTITUDE_DIRECTION, true, 0, NULL},
};

static glint_status prepare_sun_pointing(const attitude_spec *spec, attitude *out,
                                         glint_errors *errors)
{
    out->to.kind = DIRECTION_SUN;
    return prepare_pair(spec, SUN_AXIS, SUN_SECOND_AXIS, SUN_SECOND_TO, out, errors);
}

const attitude_law attitude_sun_pointing = {
    .name = "sun-pointing",
    .doc = "a body axis exactly towards the Sun: the law 'point' with to = \"sun\"",
    .keys = sun_pointing_keys,
    .n_keys = N_SUN_KEYS,
    .prepare = prepare_sun_pointing,
    .at = point_at,
};

/* Nominal yaw steering of navigation satellites, in the axes of the IGS (Montenbruck et al. 2015,
 * Adv. Space Res. 56, 1015): z to the Earth's centre; y, the axis of the solar arrays, along
 * (Sun) x (zenith), normal to the Sun; x = y x z then lies on the Sun's side. In the frame of the
 * law 'nadir' that is a yaw about z by psi = atan2(-tan beta, sin mu), beta the Sun's elevation
 * above the orbit's plane, mu the satellite's angle from midnight. Where the Sun is within
 * DIRECTION_PARALLEL of nadir or zenith (beta = 0 at noon and midnight) that is atan2(0, 0), which
 * IEEE arithmetic has as 0: the attitude of the law 'nadir'. */
static glint_status prepare_yaw_steering(const attitude_spec *spec, attitude *out,
                                         glint_errors *errors)
{
    (void)spec, (void)errors;
    out->axis[2] = 1.0;
    out->second_axis[0] = 1.0;
    attitude_triad(out->axis, out->second_axis, out->matrix);
    out->to.kind = DIRECTION_NADIR;
    out->second_to.kind = DIRECTION_SUN;
    return GLINT_OK;
}

static glint_status yaw_steering_at(const attitude *a, const moment *m, double body_gcrs[9],
                                    glint_error *error)
{
    static const direction velocity = {.kind = DIRECTION_VELOCITY};
    double nadir[3], sun[3], triad[9];
    glint_status status = direction_at(&a->to, m, nadir, error);
    if (!status) status = direction_at(&a->second_to, m, sun, error);
    if (!status && !attitude_triad(nadir, sun, triad)) {
        status = direction_at(&velocity, m, sun, error);
        if (!status && !attitude_triad(nadir, sun, triad))
            status = error_set(error, GLINT_INPUT, PLACE_NONE,
                               "the Sun and the velocity are both parallel to nadir within %g at "
                               "%.10g s from the start, so yaw steering is not defined",
                               DIRECTION_PARALLEL, m->t_s);
    }
    if (status) return status;
    attitude_align(a->matrix, triad, body_gcrs);
    return GLINT_OK;
}

const attitude_law attitude_yaw_steering = {
    .name = "yaw-steering",
    .doc = "z to the Earth's centre, x on the Sun's side, y normal to the Sun (GNSS, IGS axes)",
    .flags = ATTITUDE_NEEDS_ORBIT,
    .prepare = prepare_yaw_steering,
    .at = yaw_steering_at,
};
