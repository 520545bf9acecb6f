/* five_parameter.c: the five-parameter model of laboratory work on satellite materials. */
#include "brdf/fastmath.h"
#include "brdf/lane.h"
#include "brdf/models.h"

enum { K_B, K_R, K_D, POWER_A, FACTOR_B };
enum { STRENGTH, SPREAD, DIFFUSE, EXPONENT, FACTOR };

static const param_info params[] = {
    {"k_b", "1/sr", "strength of the lobe", 0, 1e6, PARAM_REQUIRED, 0},
    {"k_r", "", "spread of the microfacets' normals; below 1 the lobe is narrow", 1e-6, 1000,
     PARAM_REQUIRED, 0},
    {"k_d", "1/sr", "strength of the diffuse light", 0, 1e6, PARAM_REQUIRED, 0},
    {"a", "", "exponent of the dependence on incidence at the microfacet", 0, 10, PARAM_REQUIRED,
     PARAM_MIN_OPEN},
    /* e^100 times the lobe is past any surface, and still a number. */
    {"b", "", "factor of the dependence on incidence at the microfacet", -100, 100, PARAM_REQUIRED,
     0},
};

static glint_status prepare(const double *given, double coef[BRDF_MAX_COEF], glint_error *error)
{
    (void)error;
    coef[STRENGTH] = given[K_B];
    coef[SPREAD] = given[K_R] * given[K_R];
    coef[DIFFUSE] = given[K_D];
    coef[EXPONENT] = given[POWER_A];
    coef[FACTOR] = given[FACTOR_B];
    return GLINT_OK;
}

/* f = k_b kr^2 cosA/(1 + (kr^2 - 1) cosA) exp{b (1 - cosG)^a} S/(ci cr) + k_d/ci, cosA = h.n,
 * cosG = i.h = |H|/2, S = min(1, 2 cosA cr/cosG, 2 cosA ci/cosG).
 * Both 1 - cos are wanted where the cosine is near 1, and are had without cancellation from
 * 1 - cos = (1 - cos^2)/(1 + cos): 1 - cosA^2 = |H tangential|^2/|H|^2, 1 - cosG^2 = |i - r|^2/4.
 */
static inline double five_parameter_lane(const double *coef, const brdf_lane *l)
{
    const double cos_a = l->hn / l->hlen, cos_g = 0.5 * l->hlen;
    const double smaller = l->ci < l->cr ? l->ci : l->cr;
    const double shadowing = 4.0 * l->hn * smaller / l->hh, s = shadowing < 1.0 ? shadowing : 1.0;
    const double spread = coef[SPREAD] * cos_a;
    const double tilt = (l->ht * l->ht + l->hb * l->hb) / (l->hh * (1.0 + cos_a)); /* 1 - cosA */
    const double angle = 0.25 * lane_difference2(l) / (1.0 + cos_g);               /* 1 - cosG */
    const double power = fast_exp(coef[EXPONENT] * fast_log(angle));
    const double fresnel = fast_exp(coef[FACTOR] * (angle > 0.0 ? power : 0.0));
    const double lobe = coef[STRENGTH] * (spread / (tilt + spread));
    return lobe * fresnel * s + coef[DIFFUSE] * l->cr;
}

#define BRDF_LANE five_parameter_lane
#include "brdf/tile.h"

const brdf_model brdf_five_parameter = {
    .name = "five-parameter",
    .doc = "provisional: its published form could not be checked; microfacet lobe and a diffuse "
           "term k_d/ci that is not reciprocal",
    .source = "after Wu, Xie et al. 2002, Acta Optica Sinica 22(8) 897",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = BRDF_ISOTROPIC | BRDF_NOT_RECIPROCAL,
    .prepare = prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
