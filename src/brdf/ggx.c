/* ggx.c: anisotropic microfacets with the long-tailed GGX (Trowbridge-Reitz) slopes. */
#include "base/constants.h"
#include "brdf/fresnel.h"
#include "brdf/lane.h"
#include "brdf/models.h"

enum { RHO_D, S, ALPHA_X, ALPHA_Y, N, K };
enum { DIFFUSE, LOBE, X2, Y2, INVERSE_X2, INVERSE_Y2, INDEX, ABSORPTION };

static const param_info params[] = {
    {"rho_d", "", "diffuse reflectance", 0, 1, PARAM_REQUIRED, 0},
    {"s", "", "share of the surface that is specular", 0, 1, PARAM_REQUIRED, 0},
    {"alpha_x", "", "roughness along the tangent", 1e-6, 10, PARAM_REQUIRED, 0},
    {"alpha_y", "", "roughness across the tangent", 1e-6, 10, PARAM_REQUIRED, 0},
    {"n", "", "refractive index", 0, 100, PARAM_REQUIRED, PARAM_MIN_OPEN},
    {"k", "", "extinction coefficient; 0: a dielectric", 0, 1000, 0, 0},
};

static glint_status prepare(const double *given, double coef[BRDF_MAX_COEF], glint_error *error)
{
    (void)error;
    const double ax = given[ALPHA_X], ay = given[ALPHA_Y];
    coef[DIFFUSE] = given[RHO_D] / PI;
    coef[LOBE] = given[S] / (2.0 * PI * ax * ay);
    coef[X2] = ax * ax;
    coef[Y2] = ay * ay;
    coef[INVERSE_X2] = 1.0 / coef[X2];
    coef[INVERSE_Y2] = 1.0 / coef[Y2];
    coef[INDEX] = given[N];
    coef[ABSORPTION] = given[K];
    return GLINT_OK;
}

/* f = rho_d/pi + s D G F/(4 ci cr), D = 1/(pi ax ay ((ht/ax)^2 + (hb/ay)^2 + hz^2)^2).
 * G = 1/(1 + L(i) + L(r)), L = (sqrt(1 + (ax^2 t^2 + ay^2 b^2)/c^2) - 1)/2 for a direction (t, b,
 * c); multiplied through: G = 2 ci cr/(cr sqrt(ci^2 + ..) + ci sqrt(cr^2 + ..)), finite at grazing.
 */
static inline double ggx_lane(const double *coef, const brdf_lane *l)
{
    const double w = l->ci * l->cr;
    const double slopes =
        coef[INVERSE_X2] * (l->ht * l->ht) + coef[INVERSE_Y2] * (l->hb * l->hb) + l->hn * l->hn;
    const double d = l->hh / slopes;
    const double si = coef[X2] * (l->it * l->it) + coef[Y2] * (l->ib * l->ib) + l->ci * l->ci;
    const double sr = coef[X2] * (l->rt * l->rt) + coef[Y2] * (l->rb * l->rb) + l->cr * l->cr;
    const double g = w / (l->cr * sqrt(si) + l->ci * sqrt(sr));
    const double f = fresnel_unpolarised(coef[INDEX], coef[ABSORPTION], 0.5 * l->hlen);
    return coef[DIFFUSE] * w + coef[LOBE] * (d * d) * g * f;
}

#define BRDF_LANE ggx_lane
#include "brdf/tile.h"

const brdf_model brdf_ggx = {
    .name = "ggx",
    .doc = "anisotropic microfacets with long tails, height-correlated shadowing and exact Fresnel "
           "reflectance",
    .source = "Walter, Marschner, Li and Torrance 2007, Eurographics Symposium on Rendering; "
              "shadowing: Heitz 2014, Journal of Computer Graphics Techniques 3(2) 48",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = 0,
    .prepare = prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
