/* ashikhmin_shirley.c: the anisotropic Phong model of Ashikhmin and Shirley. */
#include "base/constants.h"
#include "brdf/ashikhmin.h"
#include "brdf/models.h"

enum { R_D, R_S, N_U, N_V };

const param_info ashikhmin_params[ASHIKHMIN_N_PARAMS] = {
    {"R_d", "", "diffuse reflectance of the layer below", 0, 1, PARAM_REQUIRED, 0},
    {"R_s", "", "specular reflectance at normal incidence", 0, 1, PARAM_REQUIRED, 0},
    /* The lobe's rms slope is about 1/sqrt(n): 1e6 is 1e-3 rad, the width of a polished plate. */
    {"n_u", "", "exponent of the lobe along the tangent", 0, 1e6, PARAM_REQUIRED, 0},
    {"n_v", "", "exponent of the lobe across the tangent", 0, 1e6, PARAM_REQUIRED, 0},
};

glint_status ashikhmin_prepare(const double *params, double coef[BRDF_MAX_COEF], glint_error *error)
{
    (void)error;
    coef[ASHIKHMIN_DIFFUSE] = 28.0 * params[R_D] * (1.0 - params[R_S]) / (23.0 * PI);
    coef[ASHIKHMIN_LOBE] = sqrt((params[N_U] + 1.0) * (params[N_V] + 1.0)) / (8.0 * PI);
    coef[ASHIKHMIN_U] = 0.5 * params[N_U];
    coef[ASHIKHMIN_V] = 0.5 * params[N_V];
    coef[ASHIKHMIN_FRESNEL] = params[R_S];
    return GLINT_OK;
}

/* f = specular / (u max(ci, cr)) + diffuse; ci cr / max = min. u = |H|/2. */
static inline double ashikhmin_shirley_lane(const double *coef, const brdf_lane *l)
{
    const double smaller = l->ci < l->cr ? l->ci : l->cr;
    return ashikhmin_specular(coef, l) * (2.0 * smaller / l->hlen) + ashikhmin_diffuse(coef, l);
}

#define BRDF_LANE ashikhmin_shirley_lane
#include "brdf/tile.h"

const brdf_model brdf_ashikhmin_shirley = {
    .name = "ashikhmin-shirley",
    .doc = "anisotropic Phong lobe with Fresnel gain over a diffuse layer that the lobe dims",
    .source = "Ashikhmin and Shirley 2000, Journal of Graphics Tools 5(2) 25",
    .params = ashikhmin_params,
    .n_params = ASHIKHMIN_N_PARAMS,
    .flags = BRDF_PASSIVE,
    .prepare = ashikhmin_prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
