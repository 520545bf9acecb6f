/* oren_nayar.c: diffuse V-shaped grooves, shadowed, masked and lighting each other. */
#include "base/constants.h"
#include "brdf/fastmath.h"
#include "brdf/lane.h"
#include "brdf/models.h"

enum { RHO, SIGMA_DEG };
enum { DIRECT, C1, C2, C3, INDIRECT };

static const param_info params[] = {
    {"rho", "", "reflectance of the grooves' walls", 0, 1, PARAM_REQUIRED, 0},
    /* Steeper walls than this are outside of the fit from which the coefficients come. */
    {"sigma_deg", "deg", "standard deviation of the walls' slope angle", 0, 60, PARAM_REQUIRED, 0},
};

static glint_status prepare(const double *given, double coef[BRDF_MAX_COEF], glint_error *error)
{
    (void)error;
    const double rho = given[RHO], sigma = given[SIGMA_DEG] * DEG, s2 = sigma * sigma;
    coef[DIRECT] = rho / PI;
    coef[C1] = 1.0 - 0.5 * s2 / (s2 + 0.33);
    coef[C2] = 0.45 * s2 / (s2 + 0.09);
    coef[C3] = 0.125 * s2 / (s2 + 0.09);
    coef[INDIRECT] = 0.17 * rho * rho / PI * s2 / (s2 + 0.13);
    return GLINT_OK;
}

/* f = rho/pi [C1 + cos p C2 tan B + (1 - |cos p|) C3 tan((A+B)/2)]
 *     + .17 rho^2/pi s2/(s2+.13) [1 - cos p (2B/pi)^2],
 * A, B the larger and smaller zenith angle, p the difference of azimuths; C2 carries the factor
 * sin A, less (2B/pi)^3 where cos p < 0; C3 the factor (4AB/pi^2)^2.
 *
 * cos p sin A sin B is the product of the tangential parts, which turns ci cr cos p tan B into
 * (product / sin A) cos A, and tan((A+B)/2) = (sin A + sin B)/(ci + cr). p is undefined at normal
 * incidence, where all that it multiplies is 0. For walls steeper than about 38 deg the fit goes
 * below 0 in forward scattering far from the normal; f is 0 there. */
static inline double oren_nayar_lane(const double *coef, const brdf_lane *l)
{
    const double si = sqrt(l->it * l->it + l->ib * l->ib);
    const double sr = sqrt(l->rt * l->rt + l->rb * l->rb);
    const double ti = fast_angle(si, l->ci) * (2.0 / PI), tr = fast_angle(sr, l->cr) * (2.0 / PI);
    const double a = ti > tr ? ti : tr, b = ti > tr ? tr : ti; /* in right angles */
    const double sin_a = ti > tr ? si : sr, cos_a = ti > tr ? l->ci : l->cr;
    const double product = l->it * l->rt + l->ib * l->rb;
    const double cos_p = product / (si * sr + 1e-300);
    const double w = l->ci * l->cr;
    const double backward = sin_a - (product < 0.0 ? b * b * b : 0.0);
    const double spread = (1.0 - fabs(cos_p)) * (a * b) * (a * b) * (si + sr) / l->hn;
    const double direct = coef[C1] * w + coef[C3] * spread * w +
                          coef[C2] * backward * (product / (sin_a + 1e-300)) * cos_a;
    const double g = coef[DIRECT] * direct + coef[INDIRECT] * w * (1.0 - cos_p * (b * b));
    return g > 0.0 ? g : 0.0;
}

#define BRDF_LANE oren_nayar_lane
#include "brdf/tile.h"

const brdf_model brdf_oren_nayar = {
    .name = "oren-nayar",
    .doc = "rough diffuse surface (the full model of 1994): flatter than lambert, brighter towards "
           "the source",
    .source = "Oren and Nayar 1994, SIGGRAPH 94, 239",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = BRDF_ISOTROPIC,
    .prepare = prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
