/* An attitude that stays as it is in GCRS. */
#include "base/vec.h"
#include "orbit/attitude_law.h"

enum { QUATERNION, N_KEYS };
static const attitude_key keys[N_KEYS] = {
    {"quaternion_wxyz", "", "body to GCRS, scalar first: v_gcrs = q v_body q*", ATTITUDE_QUATERNION,
     true, 0, NULL},
};

static glint_status prepare(const attitude_spec *spec, attitude *out, glint_errors *errors)
{
    (void)errors;
    double gcrs_body[9];
    mat_from_quat(spec->value[QUATERNION], gcrs_body);
    mat_transpose(gcrs_body, out->matrix);
    out->to.kind = out->second_to.kind = DIRECTION_STAR; /* nothing that moves */
    return GLINT_OK;
}

static glint_status at(const attitude *a, const moment *m, double body_gcrs[9], glint_error *error)
{
    (void)m, (void)error;
    memcpy(body_gcrs, a->matrix, sizeof a->matrix);
    return GLINT_OK;
}

const attitude_law attitude_inertial = {
    .name = "inertial",
    .doc = "fixed in GCRS",
    .keys = keys,
    .n_keys = N_KEYS,
    .prepare = prepare,
    .at = at,
};
