/* minnaert.c: diffuse light with limb darkening (k > 1) or brightening (k < 1). */
#include "base/constants.h"
#include "brdf/fastmath.h"
#include "brdf/lane.h"
#include "brdf/models.h"

enum { RHO, K };

static const param_info params[] = {
    {"rho", "", "reflectance at normal incidence", 0, 1, PARAM_REQUIRED, 0},
    {"k", "", "limb exponent; 1: lambert", 0, 10, PARAM_REQUIRED, 0},
};

static glint_status prepare(const double *given, double coef[BRDF_MAX_COEF], glint_error *error)
{
    (void)error;
    coef[0] = given[RHO] * (given[K] + 1.0) / (2.0 * PI);
    coef[1] = given[K];
    return GLINT_OK;
}

/* f = rho (k+1)/(2 pi) (ci cr)^(k-1) */
static inline double minnaert_lane(const double *coef, const brdf_lane *l)
{
    return coef[0] * fast_exp(coef[1] * fast_log(l->ci * l->cr));
}

#define BRDF_LANE minnaert_lane
#include "brdf/tile.h"

const brdf_model brdf_minnaert = {
    .name = "minnaert",
    .doc = "diffuse with limb darkening (k > 1) or brightening (k < 1); for k < 1 it reflects too "
           "much at grazing incidence",
    .source = "Minnaert 1941, Astrophysical Journal 93, 403",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = BRDF_ISOTROPIC,
    .prepare = prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
