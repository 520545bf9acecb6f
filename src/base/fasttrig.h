/* fasttrig.h: sine and cosine together, in line. */
#ifndef GLINT_BASE_FASTTRIG_H
#define GLINT_BASE_FASTTRIG_H

#include <math.h>
#include <stdint.h>
#include <string.h>

/* pi/2 in three parts: the first two have 33 bits, so that their products with integers below 2^20
 * are exact. */
#define FASTTRIG_HALF_PI_1 0x1.921fb544p+0
#define FASTTRIG_HALF_PI_2 0x1.0b4611a6p-34
#define FASTTRIG_HALF_PI_3 0x1.3198a2e037073p-69
/* Beyond, in rad, the C library's own reduction is needed. */
#define FASTTRIG_LARGEST 1e6
/* Adding it to |x| < 2^51 rounds x to an integer and leaves that integer in the low bits. */
#define FASTTRIG_ROUND 0x1.8p52

/* sin x and cos x of |x| < FASTTRIG_LARGEST (rad), within 1.5 ulp but where they come near 0: there
 * within 1e-16 of 1. Without branches: compilers can put it into vector code.
 *
 * x = n pi/2 + r with |r| <= pi/4; sin r = r + r^3 s(r^2), cos r = 1 - r^2/2 + r^4 c(r^2). s and c
 * are interpolations at 6 Chebyshev nodes, found in 60 digits and rounded: they leave 2e-17 of sin
 * r and 1e-18 of cos r. */
static inline void near_sin_cos(double x, double *sine, double *cosine)
{
    const double shifted = x * 0x1.45f306dc9c883p-1 + FASTTRIG_ROUND; /* 2/pi */
    const double n = shifted - FASTTRIG_ROUND;
    const double r =
        ((x - n * FASTTRIG_HALF_PI_1) - n * FASTTRIG_HALF_PI_2) - n * FASTTRIG_HALF_PI_3;
    uint64_t quadrant;
    memcpy(&quadrant, &shifted, sizeof quadrant);
    const double y = r * r, y2 = y * y, y4 = y2 * y2;
    const double s01 = -0x1.5555555555555p-3 + y * 0x1.1111111110bb1p-7;
    const double s23 = -0x1.a01a019e8357dp-13 + y * 0x1.71de37961e4c6p-19;
    const double s45 = -0x1.ae600a926c89ap-26 + y * 0x1.5e0af186af739p-33;
    const double s = r + r * y * ((s01 + y2 * s23) + y4 * s45);
    const double c01 = 0x1.5555555555555p-5 - y * 0x1.6c16c16c16966p-10;
    const double c23 = 0x1.a01a019f4e867p-16 - y * 0x1.27e4fa17a41b4p-22;
    const double c45 = 0x1.1eeb68b109173p-29 - y * 0x1.907d7aebd5e3dp-37;
    const double half = 0.5 * y, near = 1.0 - half;
    const double c = near + (((1.0 - near) - half) + y2 * ((c01 + y2 * c23) + y4 * c45));
    const double a = quadrant & 1 ? c : s, b = quadrant & 1 ? s : c;
    *sine = quadrant & 2 ? -a : a;
    *cosine = (quadrant + 1) & 2 ? -b : b;
}

/* The same of any x; NaN for what is not finite. */
static inline void fast_sin_cos(double x, double *sine, double *cosine)
{
    if (fabs(x) < FASTTRIG_LARGEST) {
        near_sin_cos(x, sine, cosine);
        return;
    }
    *sine = sin(x);
    *cosine = cos(x);
}

/* Turns sine and cosine of an angle into those of one that is greater by x, |x| <= 1e-3 rad, by
 * the series of sin x and 1 - cos x; what is left out is below 1e-17. */
static inline void turn_sin_cos(double x, double *sine, double *cosine)
{
    const double y = x * x, s = *sine, c = *cosine;
    const double sin_x = x - x * y * (1.0 / 6.0 - y * (1.0 / 120.0));
    const double versine = y * (0.5 - y * (1.0 / 24.0));
    *sine = s + (c * sin_x - s * versine);
    *cosine = c - (s * sin_x + c * versine);
}

#endif
