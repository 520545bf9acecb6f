/* angle.h: a look at the unit of angles that people give. */
#ifndef GLINT_BASE_ANGLE_H
#define GLINT_BASE_ANGLE_H

#include <stdbool.h>

/* Whether angles that ought to be deg look like rad: the largest from a normal, and the largest
 * azimuth, both without their signs, are no more than pi/2 and 2 pi rounded up, and not all are 0,
 * which is the same in any unit. */
static inline bool angles_look_like_rad(double most_zenith, double most_azimuth)
{
    static const double RIGHT = 1.571, FULL = 6.284; /* rad */
    return most_zenith > 0.0 && most_zenith <= RIGHT && most_azimuth <= FULL;
}

#endif
