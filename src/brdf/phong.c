/* phong.c: a lobe around the mirror direction, a power of the cosine of the distance from it. */
#include "base/constants.h"
#include "brdf/fastmath.h"
#include "brdf/lane.h"
#include "brdf/models.h"

enum { RHO_D, RHO_S, EXPONENT };
enum { DIFFUSE, LOBE, POWER };

static const param_info params[] = {
    {"rho_d", "", "diffuse reflectance", 0, 1, PARAM_REQUIRED, 0},
    {"rho_s", "", "strength of the lobe: its reflectance at normal incidence", 0, 1, PARAM_REQUIRED,
     0},
    /* The lobe's width is about 1/sqrt(n): 1e6 is 1e-3 rad, narrower than the Sun. */
    {"n", "", "exponent of the lobe", 0, 1e6, PARAM_REQUIRED, 0},
};

static glint_status prepare(const double *given, double coef[BRDF_MAX_COEF], glint_error *error)
{
    (void)error;
    coef[DIFFUSE] = given[RHO_D] / PI;
    coef[LOBE] = given[RHO_S] * (given[EXPONENT] + 2.0) / (2.0 * PI);
    coef[POWER] = given[EXPONENT];
    return GLINT_OK;
}

/* f = rho_d/pi + rho_s (n+2)/(2 pi) max(0, c)^n, c = R.r with R the mirror image of i.
 * R - r has the tangential part -(H.t, H.b) and the normal part ci - cr, so that 1 - c = |R -
 * r|^2/2 is known without cancellation where the lobe is high. */
static inline double phong_lane(const double *coef, const brdf_lane *l)
{
    const double n = l->ci - l->cr;
    const double s = 0.5 * (l->ht * l->ht + l->hb * l->hb + n * n), c = 1.0 - s;
    const double power = fast_exp(coef[POWER] * fast_log_1m(c, s));
    return (coef[DIFFUSE] + coef[LOBE] * (c > 0.0 ? power : 0.0)) * (l->ci * l->cr);
}

#define BRDF_LANE phong_lane
#include "brdf/tile.h"

const brdf_model brdf_phong = {
    .name = "phong",
    .doc = "diffuse light and the normalised Phong lobe",
    .source = "Phong 1975, Communications of the ACM 18(6) 311; normalisation: Lafortune and "
              "Willems 1994, report CW 197, KU Leuven",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = BRDF_ISOTROPIC,
    .prepare = prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
