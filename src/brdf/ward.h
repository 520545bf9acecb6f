/* ward.h: what the three Ward models share. */
#ifndef GLINT_BRDF_WARD_H
#define GLINT_BRDF_WARD_H

#include "brdf/brdf.h"

enum { WARD_N_PARAMS = 6 };
extern const param_info ward_params[WARD_N_PARAMS];

/* What ward_prepare fills in. */
enum {
    WARD_DIFFUSE, /* rho_d / pi, 1/sr */
    WARD_LOBE,    /* rho_s / (4 pi ax' ay'), 1/sr */
    WARD_X,       /* 1 / ax'^2 */
    WARD_Y        /* 1 / ay'^2 */
};

/* The coefficients above, with ax' = alpha_x / (k lambda) and ay' alike (k lambda = 1 where both
 * are NAN). Errors (GLINT_INPUT): only one of k_per_um and wavelength_um given; a slope ax' or ay'
 * outside the range of alpha_x. */
glint_status ward_prepare(const double *params, double coef[BRDF_MAX_COEF], glint_error *error);

#endif
