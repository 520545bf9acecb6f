/* fresnel.h: reflectance of a smooth boundary, for the microfacet models. */
#ifndef GLINT_BRDF_FRESNEL_H
#define GLINT_BRDF_FRESNEL_H

#include <math.h>

/* Unpolarised Fresnel reflectance of a boundary from vacuum to the refractive index n - i k (n > 0,
 * k >= 0) at incidence of cosine 0 < c <= 1.
 *
 * With a - i b = sqrt((n - i k)^2 - s^2), s^2 = 1 - c^2:
 * R_s = |(a - c) - i b|^2 / |(a + c) - i b|^2 and
 * R_p = R_s |(a c - s^2) - i b c|^2 / |(a c + s^2) - i b c|^2
 * (Born and Wolf, Principles of Optics, sections 1.5 and 14.2; only sums of squares, so nothing
 * cancels). x and y4 are the real part of a square and the square of its imaginary part; the larger
 * of 2 a^2 and 2 b^2 is found as a sum, the smaller from their product y4. */
static inline double fresnel_unpolarised(double n, double k, double c)
{
    const double c2 = c * c, s2 = 1.0 - c2, y4 = 4.0 * n * n * k * k;
    const double x = (n * n - 1.0 - k * k) + c2;
    const double large = sqrt(x * x + y4) + fabs(x) + 1e-300, small = y4 / large;
    const double a = sqrt(0.5 * (x >= 0.0 ? large : small));
    const double b2 = 0.5 * (x >= 0.0 ? small : large);
    const double rs = ((a - c) * (a - c) + b2) / ((a + c) * (a + c) + b2);
    const double p_minus = a * c - s2, p_plus = a * c + s2, bc2 = b2 * c2;
    const double rp = rs * (p_minus * p_minus + bc2) / (p_plus * p_plus + bc2);
    return 0.5 * (rs + rp);
}

#endif
