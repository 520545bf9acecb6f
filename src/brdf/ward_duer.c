/* ward_duer.c: Ward's lobe in Duer's normalisation. */
#include "brdf/fastmath.h"
#include "brdf/lane.h"
#include "brdf/models.h"
#include "brdf/ward.h"

/* f = rho_d/pi + rho_s/(4 pi ax ay ci cr) exp(-[(h.t/ax)^2 + (h.b/ay)^2] / (h.n)^2); the ratios of
 * h's components are those of H's. */
static inline double ward_duer_lane(const double *coef, const brdf_lane *l)
{
    const double slopes = coef[WARD_X] * (l->ht * l->ht) + coef[WARD_Y] * (l->hb * l->hb);
    return coef[WARD_DIFFUSE] * (l->ci * l->cr) +
           coef[WARD_LOBE] * fast_exp(-slopes / (l->hn * l->hn));
}

#define BRDF_LANE ward_duer_lane
#include "brdf/tile.h"

const brdf_model brdf_ward_duer = {
    .name = "ward-duer",
    .doc = "Ward's lobe divided by ci cr instead of its root: keeps its energy to within 3 % "
           "up to 85 deg incidence, and exceeds any bound at grazing",
    .source = "Duer 2006, Journal of Graphics Tools 11(1) 51",
    .params = ward_params,
    .n_params = WARD_N_PARAMS,
    .flags = BRDF_WAVELENGTH,
    .prepare = ward_prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
