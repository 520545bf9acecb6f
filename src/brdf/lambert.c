/* lambert.c: a surface that looks equally bright from everywhere. */
#include "base/constants.h"
#include "brdf/lane.h"
#include "brdf/models.h"

static const param_info params[] = {
    {"rho", "", "reflectance", 0, 1, PARAM_REQUIRED, 0},
};

static glint_status prepare(const double *given, double coef[BRDF_MAX_COEF], glint_error *error)
{
    (void)error;
    coef[0] = given[0] / PI;
    return GLINT_OK;
}

/* f = rho / pi */
static inline double lambert_lane(const double *coef, const brdf_lane *l)
{
    return coef[0] * (l->ci * l->cr);
}

#define BRDF_LANE lambert_lane
#include "brdf/tile.h"

const brdf_model brdf_lambert = {
    .name = "lambert",
    .doc = "perfectly diffuse: equally bright from every direction",
    .source = "Lambert 1760, Photometria",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = BRDF_ISOTROPIC | BRDF_PASSIVE,
    .prepare = prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
