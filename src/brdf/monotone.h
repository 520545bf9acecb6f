/* monotone.h: cubic interpolation that stays between neighbouring values and is smooth (C1): slopes
 * after Fritsch and Butland 1984, SIAM Journal on Scientific and Statistical Computing 5, 300. */
#ifndef GLINT_BRDF_MONOTONE_H
#define GLINT_BRDF_MONOTONE_H

#include <math.h>

/* Slope at a node between two intervals of widths w0, w1 > 0 with secant slopes s0, s1: a weighted
 * harmonic mean, and 0 at an extremum. */
static inline double monotone_slope(double w0, double s0, double w1, double s1)
{
    if (!(s0 * s1 > 0.0)) return 0.0;
    const double a = 2.0 * w1 + w0, b = w1 + 2.0 * w0;
    return (a + b) / (a / s0 + b / s1);
}

/* Slope at the end of the first interval (w0, s0): that of the parabola through the first three
 * nodes, restrained where it would leave the range of the first two. */
static inline double monotone_end_slope(double w0, double s0, double w1, double s1)
{
    const double slope = ((2.0 * w0 + w1) * s0 - w0 * s1) / (w0 + w1);
    if (!(slope * s0 > 0.0)) return 0.0;
    return fabs(slope) > 3.0 * fabs(s0) ? 3.0 * s0 : slope;
}

/* The cubic on an interval of width w, from value z0 and slope m0 to z1 and m1, at w x, 0 <= x
 * <= 1. Exact at both ends. */
static inline double monotone_cubic(double w, double x, double z0, double m0, double z1, double m1)
{
    const double y = 1.0 - x;
    return z0 * (y * y * (1.0 + 2.0 * x)) + z1 * (x * x * (1.0 + 2.0 * y)) +
           w * x * y * (m0 * y - m1 * x);
}

#endif
