/* mirror.c: a perfect flat mirror: all its light goes into one direction. */
#include "brdf/fresnel.h"
#include "brdf/lane.h"
#include "brdf/models.h"

enum { R, N, K };
enum { SHARE, INDEX, ABSORPTION }; /* INDEX 0: the same at every incidence */

static const param_info params[] = {
    {"R", "", "reflectance; with n, the share of the surface that is such a boundary", 0, 1,
     PARAM_REQUIRED, 0},
    {"n", "", "refractive index; without it R holds at every incidence", 0, 100, PARAM_NONE,
     PARAM_MIN_OPEN | PARAM_OPTIONAL},
    {"k", "", "extinction coefficient, with n only; without it a dielectric", 0, 1000, PARAM_NONE,
     PARAM_OPTIONAL},
};

static glint_status prepare(const double *given, double coef[BRDF_MAX_COEF], glint_error *error)
{
    if (isnan(given[N]) && !isnan(given[K]))
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "k without n; expected both, n alone, or neither");
    coef[SHARE] = given[R];
    coef[INDEX] = isnan(given[N]) ? 0.0 : given[N];
    coef[ABSORPTION] = isnan(given[K]) ? 0.0 : given[K];
    return GLINT_OK;
}

/* f = R F(ci) delta(r - mirrored i)/cr, F Fresnel's reflectance, or 1 without n. */
static double specular(const double *coef, double ci)
{
    if (coef[INDEX] == 0.0) return coef[SHARE];
    return coef[SHARE] * fresnel_unpolarised(coef[INDEX], coef[ABSORPTION], ci);
}

/* What is not a delta function: nothing. */
static inline double mirror_lane(const double *coef, const brdf_lane *l)
{
    (void)coef;
    (void)l;
    return 0.0;
}

#define BRDF_LANE mirror_lane
#include "brdf/tile.h"

const brdf_model brdf_mirror = {
    .name = "mirror",
    .doc = "perfect flat mirror: a delta function in the mirror direction, 0 elsewhere",
    .source = "Nicodemus et al. 1977, NBS Monograph 160; Fresnel's reflectance as Born "
              "and Wolf 1999, Principles of Optics, sections 1.5 and 14.2",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = BRDF_ISOTROPIC | BRDF_PASSIVE,
    .prepare = prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
    .specular = specular,
};
