#include "output/colour.h"

#include <math.h>

static double clamp(double t)
{
    return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
}

/* IEC 61966-2-1. */
static double encode(double linear)
{
    const double x = clamp(linear);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

static double decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

colour colour_oklab(double lightness, double a, double b)
{
    const double l = lightness + 0.3963377774 * a + 0.2158037573 * b;
    const double m = lightness - 0.1055613458 * a - 0.0638541728 * b;
    const double s = lightness - 0.0894841775 * a - 1.2914855480 * b;
    const double l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
    return (colour){encode(4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3),
                    encode(-1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3),
                    encode(-0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3)};
}

/* The hues are a parabola in the plane of a and b through these, at t = 0, 1/2 and 1. */
colour colour_scale(double t)
{
    static const double DARKEST = 0.24, LIGHTEST = 0.94;
    static const double A[3] = {0.02, 0.125, -0.03}, B[3] = {-0.11, 0.035, 0.11};
    t = clamp(t);
    const double start = (1 - t) * (1 - 2 * t), middle = 4 * t * (1 - t), end = t * (2 * t - 1);
    return colour_oklab(DARKEST + (LIGHTEST - DARKEST) * t,
                        start * A[0] + middle * A[1] + end * A[2],
                        start * B[0] + middle * B[1] + end * B[2]);
}

colour colour_of_set(int k)
{
    static const unsigned char SET[][3] = {{86, 180, 233},  {230, 159, 0}, {0, 158, 115},
                                           {204, 121, 167}, {0, 114, 178}, {213, 94, 0},
                                           {240, 228, 66}};
    enum { N = sizeof SET / sizeof *SET };
    const unsigned char *own = SET[k % N];
    const colour c = {own[0] / 255.0, own[1] / 255.0, own[2] / 255.0};
    const int round = k / N % 3;
    if (round == 0) return c;
    if (round == 1) return colour_dim(c, 0.55);
    return (colour){0.5 + 0.5 * c.red, 0.5 + 0.5 * c.green, 0.5 + 0.5 * c.blue};
}

colour colour_dim(colour c, double brightness)
{
    const double part = clamp(brightness);
    return (colour){encode(part * decode(c.red)), encode(part * decode(c.green)),
                    encode(part * decode(c.blue))};
}
