/* ward.c: Ward's anisotropic Gaussian lobe with a wavelength factor. */
#include "brdf/ward.h"

#include "base/constants.h"
#include "brdf/fastmath.h"
#include "brdf/lane.h"
#include "brdf/models.h"

enum { RHO_D, RHO_S, ALPHA_X, ALPHA_Y, K_PER_UM, WAVELENGTH_UM };

const param_info ward_params[WARD_N_PARAMS] = {
    {"rho_d", "", "diffuse reflectance", 0, 1, PARAM_REQUIRED, 0},
    {"rho_s", "", "strength of the lobe", 0, 1, PARAM_REQUIRED, 0},
    /* Below 1e-6 (0.2 arcsec) a surface is a mirror to anything that is measured here. */
    {"alpha_x", "", "slope parameter along the tangent, sqrt(2) times the rms slope", 1e-6, 10,
     PARAM_REQUIRED, 0},
    {"alpha_y", "", "slope parameter across the tangent", 1e-6, 10, PARAM_REQUIRED, 0},
    {"k_per_um", "1/um", "wavelength factor: slopes are divided by k_per_um wavelength_um", 0, 1000,
     PARAM_NONE, PARAM_MIN_OPEN | PARAM_OPTIONAL},
    {"wavelength_um", "um", "wavelength that belongs to k_per_um", 0, 1000, PARAM_NONE,
     PARAM_MIN_OPEN | PARAM_OPTIONAL},
};

static glint_status scaled_slope(const double *params, int which, double k_lambda, double *slope,
                                 glint_error *error)
{
    const param_info *p = &ward_params[which];
    *slope = params[which] / k_lambda;
    if (*slope >= p->min && *slope <= p->max) return GLINT_OK;
    return error_set(error, GLINT_INPUT, PLACE_NONE,
                     "%s / (k_per_um wavelength_um) = %g must be between %g and %g", p->name,
                     *slope, p->min, p->max);
}

glint_status ward_prepare(const double *params, double coef[BRDF_MAX_COEF], glint_error *error)
{
    const bool has_k = !isnan(params[K_PER_UM]), has_lambda = !isnan(params[WAVELENGTH_UM]);
    if (has_k != has_lambda)
        return error_set(error, GLINT_INPUT, PLACE_NONE, "%s without %s: give both or neither",
                         has_k ? "k_per_um" : "wavelength_um",
                         has_k ? "wavelength_um" : "k_per_um");
    const double k_lambda = has_k ? params[K_PER_UM] * params[WAVELENGTH_UM] : 1.0;
    double ax, ay;
    glint_status status = scaled_slope(params, ALPHA_X, k_lambda, &ax, error);
    if (status == GLINT_OK) status = scaled_slope(params, ALPHA_Y, k_lambda, &ay, error);
    if (status != GLINT_OK) return status;
    coef[WARD_DIFFUSE] = params[RHO_D] / PI;
    coef[WARD_LOBE] = params[RHO_S] / (4.0 * PI * ax * ay);
    coef[WARD_X] = 1.0 / (ax * ax);
    coef[WARD_Y] = 1.0 / (ay * ay);
    return GLINT_OK;
}

/* f = rho_d/pi + rho_s/(4 pi ax ay sqrt(ci cr)) exp(-2 [(h.t/ax)^2 + (h.b/ay)^2] / (1 + h.n)),
 * h = H/|H|; times ci cr, which leaves no division by a vanishing cosine. */
static inline double ward_lane(const double *coef, const brdf_lane *l)
{
    const double w = l->ci * l->cr;
    const double slopes = coef[WARD_X] * (l->ht * l->ht) + coef[WARD_Y] * (l->hb * l->hb);
    const double exponent = -2.0 * slopes / (l->hh + l->hlen * l->hn);
    return coef[WARD_DIFFUSE] * w + coef[WARD_LOBE] * sqrt(w) * fast_exp(exponent);
}

#define BRDF_LANE ward_lane
#include "brdf/tile.h"

const brdf_model brdf_ward = {
    .name = "ward",
    .doc = "diffuse light and Ward's anisotropic Gaussian lobe, with a wavelength factor; loses "
           "energy towards grazing incidence",
    .source = "Ward 1992, Computer Graphics 26(2) 265, eq. 5b; with the wavelength factor: Huang, "
              "Wu, Yang and Jiang 2013, Laser & Infrared 43(6) 668, eq. 6",
    .params = ward_params,
    .n_params = WARD_N_PARAMS,
    .flags = BRDF_WAVELENGTH,
    .prepare = ward_prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
