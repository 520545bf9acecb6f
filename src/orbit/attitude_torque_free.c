/* Free tumbling: a rigid body on which no torque acts (torque_free.h). */
#include "base/constants.h"
#include "base/vec.h"
#include "orbit/attitude_law.h"

enum { INERTIA, RATES, QUATERNION, EPOCH, N_KEYS };
static const attitude_key keys[N_KEYS] = {
    {"inertia_kg_m2", "kg m^2", "principal moments of inertia about body x, y, z", ATTITUDE_VECTOR,
     true, 0, NULL},
    {"rates_deg_s", "deg/s", "rates about body x, y, z at the epoch", ATTITUDE_VECTOR, true, 0,
     NULL},
    {"quaternion_wxyz", "", "attitude at the epoch, body to GCRS", ATTITUDE_QUATERNION, true, 0,
     NULL},
    {"epoch", "", "UTC time at which rates and quaternion hold; the start of the run if not given",
     ATTITUDE_EPOCH, false, 0, NULL},
};

/* No rigid body has a principal moment that exceeds the sum of the other two. */
static glint_status check_inertia(const attitude_spec *spec, glint_errors *errors)
{
    static const double ROUNDING =
        1e-9; /* relative; lets flat bodies through, whose moments add up */
    const double *inertia = spec->value[INERTIA];
    const double largest = fmax(inertia[0], fmax(inertia[1], inertia[2]));
    const double sum = inertia[0] + inertia[1] + inertia[2];
    if (!(inertia[0] > 0 && inertia[1] > 0 && inertia[2] > 0))
        return errors_add(errors, GLINT_INPUT, spec->key_place[INERTIA],
                          "inertia_kg_m2 = [%g, %g, %g]; expected three numbers above 0",
                          inertia[0], inertia[1], inertia[2]);
    if (largest > (sum - largest) * (1 + ROUNDING))
        return errors_add(
            errors, GLINT_INPUT, spec->key_place[INERTIA],
            "inertia_kg_m2 = [%g, %g, %g] belongs to no rigid body: the largest moment "
            "exceeds the sum of the other two",
            inertia[0], inertia[1], inertia[2]);
    return GLINT_OK;
}

static glint_status prepare(const attitude_spec *spec, attitude *out, glint_errors *errors)
{
    const glint_status status = check_inertia(spec, errors);
    if (status) return status;
    double rates[3], gcrs_body[9], body_gcrs[9];
    scale3(spec->value[RATES], DEG, rates);
    mat_from_quat(spec->value[QUATERNION], gcrs_body);
    mat_transpose(gcrs_body, body_gcrs);
    torque_free_start(spec->value[INERTIA], rates, body_gcrs, &out->tumble);
    out->epoch_s = spec->value[EPOCH][0];
    out->to.kind = out->second_to.kind = DIRECTION_NORTH; /* asks for nothing that moves */
    return GLINT_OK;
}

static glint_status at(const attitude *a, const moment *m, double body_gcrs[9], glint_error *error)
{
    (void)error;
    torque_free_at(&a->tumble, m->t_s - a->epoch_s, body_gcrs, NULL);
    return GLINT_OK;
}

static void turning(const attitude *a, attitude_turning *out)
{
    out->fastest_rad_s = torque_free_fastest(&a->tumble);
    out->is_steady = a->tumble.is_steady;
    copy3(a->tumble.steady_axis, out->axis_body);
}

const attitude_law attitude_torque_free = {
    .name = "torque-free",
    .doc = "free tumbling of a rigid body; the body axes are its principal axes",
    .keys = keys,
    .n_keys = N_KEYS,
    .prepare = prepare,
    .at = at,
    .turning = turning,
};
