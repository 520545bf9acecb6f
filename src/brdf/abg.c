/* abg.c: scatter of polished surfaces, a power law with a shoulder. */
#include "base/constants.h"
#include "brdf/fastmath.h"
#include "brdf/lane.h"
#include "brdf/models.h"

enum { RHO_D, A, B, G };
enum { DIFFUSE, HEIGHT, SHOULDER, HALF_POWER };

static const param_info params[] = {
    {"rho_d", "", "diffuse reflectance", 0, 1, PARAM_REQUIRED, 0},
    {"A", "1/sr", "strength: the peak is A/B", 0, 1000, PARAM_REQUIRED, 0},
    /* The peak's half width is B^(1/g); below 1e-15 it is a mirror's. */
    {"B", "", "shoulder: the peak is flat where |beta - beta0|^g is below it", 1e-15, 1000,
     PARAM_REQUIRED, 0},
    {"g", "", "slope of the wings in a log-log plot", 0, 10, PARAM_REQUIRED, PARAM_MIN_OPEN},
};

static glint_status prepare(const double *given, double coef[BRDF_MAX_COEF], glint_error *error)
{
    (void)error;
    coef[DIFFUSE] = given[RHO_D] / PI;
    coef[HEIGHT] = given[A];
    coef[SHOULDER] = given[B];
    coef[HALF_POWER] = 0.5 * given[G];
    return GLINT_OK;
}

/* f = rho_d/pi + A/(B + |beta - beta0|^g); beta and beta0 are the tangential parts of r and of i's
 * mirror image, their difference the tangential part of H. */
static inline double abg_lane(const double *coef, const brdf_lane *l)
{
    const double distance2 = l->ht * l->ht + l->hb * l->hb;
    const double power = fast_exp(coef[HALF_POWER] * fast_log(distance2));
    const double lobe = coef[HEIGHT] / (coef[SHOULDER] + (distance2 > 0.0 ? power : 0.0));
    return (coef[DIFFUSE] + lobe) * (l->ci * l->cr);
}

#define BRDF_LANE abg_lane
#include "brdf/tile.h"

const brdf_model brdf_abg = {
    .name = "abg",
    .doc =
        "diffuse light and the ABg scatter of polished surfaces, a function of the distance from "
        "the mirror direction in direction cosines",
    .source = "Harvey 1976, dissertation, University of Arizona (shift invariance); used for "
              "satellites by Fankhauser, Tyson and Askari 2023, Astronomical Journal 166, 59",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = BRDF_ISOTROPIC,
    .prepare = prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
