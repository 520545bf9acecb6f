/* ashikhmin.h: what the Ashikhmin models share. */
#ifndef GLINT_BRDF_ASHIKHMIN_H
#define GLINT_BRDF_ASHIKHMIN_H

#include "brdf/fastmath.h"
#include "brdf/lane.h"

enum { ASHIKHMIN_N_PARAMS = 4 };
extern const param_info ashikhmin_params[ASHIKHMIN_N_PARAMS];

/* What ashikhmin_prepare fills in. */
enum {
    ASHIKHMIN_DIFFUSE, /* 28 R_d (1 - R_s) / (23 pi), 1/sr */
    ASHIKHMIN_LOBE,    /* sqrt((n_u + 1) (n_v + 1)) / (8 pi), 1/sr */
    ASHIKHMIN_U,       /* n_u / 2 */
    ASHIKHMIN_V,       /* n_v / 2 */
    ASHIKHMIN_FRESNEL  /* R_s */
};

glint_status ashikhmin_prepare(const double *params, double coef[BRDF_MAX_COEF],
                               glint_error *error);

/* 1 - (1 - c/2)^5, expanded so that small c loses no digits. */
static inline double ashikhmin_coupling(double c)
{
    const double x = 0.5 * c;
    return x * (5.0 + x * (-10.0 + x * (10.0 + x * (-5.0 + x))));
}

/* The diffuse term, times ci cr. */
static inline double ashikhmin_diffuse(const double *coef, const brdf_lane *l)
{
    return coef[ASHIKHMIN_DIFFUSE] * ashikhmin_coupling(l->ci) * ashikhmin_coupling(l->cr) *
           (l->ci * l->cr);
}

/* sqrt((nu+1)(nv+1))/(8 pi) hz^((nu ht^2 + nv hb^2)/(1 - hz^2)) F(u), h = H/|H|, u = i.h = |H|/2,
 * F = Rs + (1 - Rs)(1 - u)^5.
 *
 * hz^(x/(1 - hz^2)) = exp(x ln(1 - s) / (2 s)) with s = 1 - hz^2 = ht^2 + hb^2. ln(1 - s)/s tends
 * to -1 at the peak; taking s from the tangential parts and keeping it above 0 avoids 0/0 there. */
static inline double ashikhmin_specular(const double *coef, const brdf_lane *l)
{
    const double inverse = 1.0 / l->hh;
    const double ht2 = l->ht * l->ht * inverse, hb2 = l->hb * l->hb * inverse;
    const double s = ht2 + hb2 + 1e-300;
    const double slope = fast_log_1m(l->hn * l->hn * inverse, s) / s;
    const double lobe = fast_exp((coef[ASHIKHMIN_U] * ht2 + coef[ASHIKHMIN_V] * hb2) * slope);
    const double v = 1.0 - 0.5 * l->hlen, v2 = v * v;
    const double fresnel =
        coef[ASHIKHMIN_FRESNEL] + (1.0 - coef[ASHIKHMIN_FRESNEL]) * (v2 * v2 * v);
    return coef[ASHIKHMIN_LOBE] * lobe * fresnel;
}

#endif
