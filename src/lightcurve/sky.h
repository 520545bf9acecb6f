/* sky.h: angles from coordinates, for one moment or, in a loop that the compiler can put into
 * vector code, for many: to the same bits. */
#ifndef GLINT_LIGHTCURVE_SKY_H
#define GLINT_LIGHTCURVE_SKY_H

#include "base/constants.h"
#include "brdf/fastmath.h"

/* The angle, -pi to pi, whose sine and cosine are in the ratio y to x; 0 where both are 0. As
 * atan2, within 5e-16 of pi, but knows no signed zeros. */
static inline double sky_angle(double y, double x)
{
    const double s = fabs(y), c = fabs(x);
    const double acute = fast_angle(s, s + c > 0 ? c : 1.0);
    const double angle = x < 0 ? PI - acute : acute;
    return y < 0 ? -angle : angle;
}

/* From north through east, 0 to 2 pi, that itself left out; 0 at the zenith. */
static inline double sky_azimuth(double east, double north)
{
    const double angle = sky_angle(east, north);
    const double turned = angle + TWO_PI; /* may round to a full turn: that is 0 */
    return angle >= 0 ? angle : turned < TWO_PI ? turned : 0.0;
}

/* Precise at the zenith, too. */
static inline double sky_elevation(double east, double north, double up)
{
    return sky_angle(up, sqrt(east * east + north * north));
}

#endif
