/* hapke.c: a powder with multiple scattering and the opposition surge. */
#include "base/constants.h"
#include "brdf/lane.h"
#include "brdf/models.h"

enum { W, B, B0, H };
enum { FACTOR, PHASE, PHASE_0, PHASE_H, PHASE_D, SURGE, WIDTH, GAMMA };

static const param_info params[] = {
    {"w", "", "single-scattering albedo of the grains", 0, 1, PARAM_REQUIRED, 0},
    {"b", "", "asymmetry of the grains' phase function; negative: backward", -1, 1, PARAM_REQUIRED,
     PARAM_MIN_OPEN | PARAM_MAX_OPEN},
    /* Theory says at most 1; fits to laboratory samples reach about 3. */
    {"B0", "", "height of the opposition surge", 0, 10, PARAM_REQUIRED, 0},
    {"h", "", "width of the opposition surge, tan of half the phase angle", 0, 10, PARAM_REQUIRED,
     PARAM_MIN_OPEN},
};

/* The phase function's 1 + 2 b cos a + b^2 is (1-b)^2 + b |H|^2 and also (1+b)^2 - b |i-r|^2: the
 * one whose terms are both positive keeps all digits near b = 1 and b = -1. */
static glint_status prepare(const double *given, double coef[BRDF_MAX_COEF], glint_error *error)
{
    (void)error;
    const double b = given[B], rest = 1.0 - fabs(b);
    coef[FACTOR] = given[W] / (4.0 * PI);
    coef[PHASE] = (1.0 - b) * (1.0 + b);
    coef[PHASE_0] = rest * rest;
    coef[PHASE_H] = b > 0.0 ? b : 0.0;
    coef[PHASE_D] = b > 0.0 ? 0.0 : -b;
    coef[SURGE] = given[B0];
    coef[WIDTH] = given[H];
    coef[GAMMA] = sqrt(1.0 - given[W]);
    return GLINT_OK;
}

/* H(c) - 1 for H(c) = (1 + 2c)/(1 + 2c gamma) */
static inline double multiple_scattering(double gamma, double c)
{
    return 2.0 * c * (1.0 - gamma) / (1.0 + 2.0 * c * gamma);
}

/* f = w/(4 pi)/(ci + cr) [(1 + B) P + H(ci) H(cr) - 1], a = phase angle,
 * P = (1-b^2)/(1 + 2 b cos a + b^2)^1.5, B = B0/(1 + tan(a/2)/h), tan(a/2) = |i-r|/|H|. */
static inline double hapke_lane(const double *coef, const brdf_lane *l)
{
    const double d2 = lane_difference2(l);
    const double q = coef[PHASE_0] + coef[PHASE_H] * l->hh + coef[PHASE_D] * d2;
    const double phase = coef[PHASE] / (q * sqrt(q));
    const double wide = coef[WIDTH] * l->hlen;
    const double surge = coef[SURGE] * (wide / (wide + sqrt(d2)));
    const double mi = multiple_scattering(coef[GAMMA], l->ci);
    const double mr = multiple_scattering(coef[GAMMA], l->cr);
    const double sum = (1.0 + surge) * phase + (mi + mr + mi * mr);
    return coef[FACTOR] * (l->ci * l->cr / l->hn) * sum;
}

#define BRDF_LANE hapke_lane
#include "brdf/tile.h"

const brdf_model brdf_hapke = {
    .name = "hapke",
    .doc = "powder with multiple scattering and an opposition surge (smooth surface)",
    .source = "Hapke 1986, Icarus 67, 264, with a Henyey-Greenstein phase function and the first "
              "approximation of H (Hapke 1981, Journal of Geophysical Research 86, 3039)",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = BRDF_ISOTROPIC,
    .prepare = prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
