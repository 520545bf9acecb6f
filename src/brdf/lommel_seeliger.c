/* lommel_seeliger.c: a dark scattering layer in which light is scattered once. */
#include "base/constants.h"
#include "brdf/lane.h"
#include "brdf/models.h"

static const param_info params[] = {
    {"w", "", "single-scattering albedo of the grains", 0, 1, PARAM_REQUIRED, 0},
};

static glint_status prepare(const double *given, double coef[BRDF_MAX_COEF], glint_error *error)
{
    (void)error;
    coef[0] = given[0] / (4.0 * PI);
    return GLINT_OK;
}

/* f = w/(4 pi)/(ci + cr) */
static inline double lommel_seeliger_lane(const double *coef, const brdf_lane *l)
{
    return coef[0] * (l->ci * l->cr / l->hn);
}

#define BRDF_LANE lommel_seeliger_lane
#include "brdf/tile.h"

const brdf_model brdf_lommel_seeliger = {
    .name = "lommel-seeliger",
    .doc = "dark dust that scatters light once and evenly",
    .source = "Lommel 1889, Annalen der Physik 36, 473; Hapke 2012, Theory of Reflectance and "
              "Emittance Spectroscopy",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = BRDF_ISOTROPIC | BRDF_PASSIVE,
    .prepare = prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
