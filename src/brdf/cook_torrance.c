/* cook_torrance.c: Cook and Torrance's microfacets with Beckmann's slopes and V-shaped grooves. */
#include "base/constants.h"
#include "brdf/fastmath.h"
#include "brdf/fresnel.h"
#include "brdf/lane.h"
#include "brdf/models.h"

enum { RHO_D, S, M, N, K };
enum { DIFFUSE, LOBE, SLOPE, INDEX, ABSORPTION };

static const param_info params[] = {
    {"rho_d", "", "diffuse reflectance", 0, 1, PARAM_REQUIRED, 0},
    {"s", "", "share of the surface that is specular", 0, 1, PARAM_REQUIRED, 0},
    {"m", "", "roughness: sqrt(2) times the rms slope along one direction", 1e-6, 10,
     PARAM_REQUIRED, 0},
    {"n", "", "refractive index", 0, 100, PARAM_REQUIRED, PARAM_MIN_OPEN},
    {"k", "", "extinction coefficient; 0: a dielectric", 0, 1000, 0, 0},
};

static glint_status prepare(const double *given, double coef[BRDF_MAX_COEF], glint_error *error)
{
    (void)error;
    const double m2 = given[M] * given[M];
    coef[DIFFUSE] = given[RHO_D] / PI;
    coef[LOBE] = given[S] / (4.0 * PI * m2);
    coef[SLOPE] = 1.0 / m2;
    coef[INDEX] = given[N];
    coef[ABSORPTION] = given[K];
    return GLINT_OK;
}

/* f = rho_d/pi + s D G F/(4 ci cr), D = exp(-tan^2 d/m^2)/(pi m^2 hz^4), tan d = |h_tangential|/hz,
 * G = min(1, 2 hz cr/u, 2 hz ci/u), u = i.h = |H|/2, so 2 hz/u = 4 (H.n)/|H|^2. */
static inline double cook_torrance_lane(const double *coef, const brdf_lane *l)
{
    const double inverse = 1.0 / (l->hn * l->hn), smaller = l->ci < l->cr ? l->ci : l->cr;
    const double tan2 = (l->ht * l->ht + l->hb * l->hb) * inverse, sec2 = l->hh * inverse;
    const double d = sec2 * sec2 * fast_exp(-coef[SLOPE] * tan2);
    const double shadowing = 4.0 * l->hn * smaller / l->hh;
    const double g = shadowing < 1.0 ? shadowing : 1.0;
    const double f = fresnel_unpolarised(coef[INDEX], coef[ABSORPTION], 0.5 * l->hlen);
    return coef[DIFFUSE] * (l->ci * l->cr) + coef[LOBE] * d * g * f;
}

#define BRDF_LANE cook_torrance_lane
#include "brdf/tile.h"

const brdf_model brdf_cook_torrance = {
    .name = "cook-torrance",
    .doc = "microfacets with Beckmann's slopes, V-groove shadowing and exact Fresnel reflectance",
    .source = "Cook and Torrance 1982, ACM Transactions on Graphics 1(1) 7, with 4 in place of pi "
              "below the lobe (Walter et al. 2007, Eurographics Symposium on Rendering)",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = BRDF_ISOTROPIC,
    .prepare = prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
