/* ashikhmin_premoze.c: the Ashikhmin-Shirley lobe with the denominator of distribution-based BRDFs.
 */
#include "brdf/ashikhmin.h"
#include "brdf/models.h"

/* f = specular / (ci + cr - ci cr) + diffuse */
static inline double ashikhmin_premoze_lane(const double *coef, const brdf_lane *l)
{
    const double w = l->ci * l->cr;
    return ashikhmin_specular(coef, l) * (w / (l->hn - w)) + ashikhmin_diffuse(coef, l);
}

#define BRDF_LANE ashikhmin_premoze_lane
#include "brdf/tile.h"

const brdf_model brdf_ashikhmin_premoze = {
    .name = "ashikhmin-premoze",
    .doc = "ashikhmin-shirley with ci + cr - ci cr below the lobe, as used for inverting light "
           "curves",
    .source = "Ashikhmin and Premoze 2007, Distribution-based BRDFs, University of Utah",
    .params = ashikhmin_params,
    .n_params = ASHIKHMIN_N_PARAMS,
    .flags = BRDF_PASSIVE,
    .prepare = ashikhmin_prepare,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
