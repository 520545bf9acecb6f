/* fastmath.h: exp, log and an arc tangent that the compiler can put into vector code.
 *
 * The C library's own are calls, which keep a loop scalar, and its vector versions need
 * -ffast-math and have slow branches far from 0. These have no branches and no tables. */
#ifndef GLINT_BRDF_FASTMATH_H
#define GLINT_BRDF_FASTMATH_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#define FASTMATH_LOG2_E 0x1.71547652b82fep+0 /* 1/ln 2 */
/* ln 2 in two parts: the first has 42 bits after the point, so that its product with an integer
 * below 2^11 is exact also without fused multiplication. */
#define FASTMATH_LN2_HIGH 0x1.62e42fefa38p-1
#define FASTMATH_LN2_LOW 0x1.ef35793c7673p-45
/* -1023 ln 2. The power of two that belongs to it has the exponent field 0, which makes it the
 * number 0: clamping here gives exactly 0 without a test of the result. */
#define FASTMATH_EXP_LOWEST (-709.0895657128241)
/* Adding it to |x| < 2^51 rounds x to an integer and leaves that integer in the low bits. */
#define FASTMATH_ROUND 0x1.8p52

static inline uint64_t fastmath_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double fastmath_double(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* e^x for x <= 709, within 1.1 ulp; exactly 0 below -1022.5 ln 2 = -708.74 (where e^x < 1.6e-308);
 * NaN for NaN.
 *
 * x = n ln 2 + r with |r| <= ln 2 / 2, e^x = 2^n (1 + r + r^2 q(r)). q is the interpolation of
 * (e^r - 1 - r) / r^2 at the 10 Chebyshev nodes of that interval, found in 60 digits and rounded:
 * it leaves an error of 1.6e-17 of e^r, a seventh of an ulp. */
static inline double fast_exp(double x)
{
    const double y = x < FASTMATH_EXP_LOWEST ? FASTMATH_EXP_LOWEST : x;
    const double shifted = y * FASTMATH_LOG2_E + FASTMATH_ROUND;
    const double n = shifted - FASTMATH_ROUND;
    const double r = (y - n * FASTMATH_LN2_HIGH) - n * FASTMATH_LN2_LOW;
    const double r2 = r * r, r4 = r2 * r2;
    const double q01 = 0x1.0000000000001p-1 + r * 0x1.5555555555556p-3;
    const double q23 = 0x1.5555555553d37p-5 + r * 0x1.11111111109a6p-7;
    const double q45 = 0x1.6c16c1789d1d7p-10 + r * 0x1.a01a01a7cebcdp-13;
    const double q67 = 0x1.a019b8ca26fcfp-16 + r * 0x1.71de0d85293b8p-19;
    const double q89 = 0x1.2891d4ffbb0f9p-22 + r * 0x1.af390ba7e6f47p-26;
    const double q = (q01 + r2 * q23) + r4 * ((q45 + r2 * q67) + r4 * q89);
    const double scale = fastmath_double((fastmath_bits(shifted) + 1023) << 52);
    return (1.0 + (r + r2 * q)) * scale;
}

/* ln(m 2^e) from f = m - 1 with m between sqrt(1/2) and sqrt(2).
 *
 * With z = f / (2 + f): ln m = 2 artanh z = 2 z + z^3 p(z^2). p is the interpolation of
 * (2 artanh z / z - 2) / z^2 at 7 Chebyshev nodes of 0 <= z^2 <= 0.02944 (60 digits, rounded):
 * error 4.3e-18 of ln m. */
static inline double fastmath_log_parts(double f, double e)
{
    const double z = f / (2.0 + f), y = z * z, y2 = y * y;
    const double p01 = 0x1.5555555555558p-1 + y * 0x1.9999999995273p-2;
    const double p23 = 0x1.2492492dfd86cp-2 + y * 0x1.c71c62d5e53e0p-3;
    const double p45 = 0x1.7462b91b8df65p-3 + y * 0x1.39fdcceb4bb45p-3;
    const double p = (p01 + y2 * p23) + y2 * y2 * (p45 + y2 * 0x1.2b5f68a50d903p-3);
    /* 2 z = f - z f, which keeps the exact f as the leading term. */
    const double log_m = f - (z * f - z * y * p);
    return e * FASTMATH_LN2_HIGH + (log_m + e * FASTMATH_LN2_LOW);
}

/* ln(c) of c = 1 - s, both given because one of them is known better than their sum allows: near
 * c = 1 the result has the relative precision of s. c positive; 0 and denormal numbers give about
 * -709, so that a positive power of them made with fast_exp is as good as 0. */
static inline double fast_log_1m(double c, double s)
{
    /* bits of sqrt(1/2): subtracting them makes the exponent field count from there */
    const uint64_t base = UINT64_C(0x3fe6a09e667f3bcd), mantissa = UINT64_C(0x000fffffffffffff);
    const uint64_t offset = UINT64_C(0x3ff0000000000000) - base;
    const uint64_t shifted = fastmath_bits(c) + offset;
    const double m = fastmath_double((shifted & mantissa) + base);
    /* the integer exponent field, put under the exponent of 2^52, reads as 2^52 + field */
    const double e =
        fastmath_double((shifted >> 52) | UINT64_C(0x4330000000000000)) - (0x1p52 + 1023.0);
    return fastmath_log_parts(e == 0.0 ? -s : m - 1.0, e);
}

/* ln(x) of a positive normal number, within 2 ulp; 0 and denormal numbers give about -709. */
static inline double fast_log(double x)
{
    return fast_log_1m(x, 1.0 - x);
}

/* The angle in rad, 0 to pi/2, whose sine and cosine are s, c >= 0 (not both 0); within 4 ulp.
 *
 * Two halvings, tan(x/2) = s / (c + |(s, c)|), bring the tangent v below sqrt(2) - 1; then
 * 4 atan v = 4 (v + v^3 q(v^2)), q interpolated at 11 Chebyshev nodes (60 digits, rounded): error
 * 6.5e-18 of the angle. */
static inline double fast_angle(double s, double c)
{
    const double t = s / (c + sqrt(s * s + c * c));
    const double v = t / (1.0 + sqrt(1.0 + t * t)), y = v * v, y2 = y * y, y4 = y2 * y2;
    const double q01 = -0x1.5555555555555p-2 + y * 0x1.999999999933dp-3;
    const double q23 = -0x1.24924924355d5p-3 + y * 0x1.c71c7184c32bfp-4;
    const double q45 = -0x1.745d0b153ffadp-4 + y * 0x1.3b126143b5cbcp-4;
    const double q67 = -0x1.10fa5ee9ab25cp-4 + y * 0x1.dfe49b2919c4ep-5;
    const double q89 = -0x1.a090d1950d2b4p-5 + y * 0x1.41495cefb6c73p-5;
    const double high = (q45 + y2 * q67) + y4 * (q89 - y2 * 0x1.39f38ad451ea7p-6);
    return 4.0 * (v + v * y * ((q01 + y2 * q23) + y4 * high));
}

#endif
