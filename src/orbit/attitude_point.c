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
    {"axis", "", "body axis that points exactly", ATTITUDE_AXIS, true, 0},
    {"to", "", "where it points", ATTITUDE_DIRECTION, true, 0},
    {"second_axis", "", "body axis that points as nearly as the first allows", ATTITUDE_AXIS, true,
     0},
    {"second_to", "", "where the second axis points", ATTITUDE_DIRECTION, true, 0},
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
    {"axis", "", "body axis that points exactly at the Sun", ATTITUDE_AXIS, true, 0},
    {"second_axis", "", "body axis that points as nearly as the first allows", ATTITUDE_AXIS, true,
     0},
    {"second_to", "", "where the second axis points", ATTITUDE_DIRECTION, true, 0},
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
