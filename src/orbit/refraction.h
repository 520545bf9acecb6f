/* refraction.h: how much the air lifts what is seen through it. */
#ifndef GLINT_ORBIT_REFRACTION_H
#define GLINT_ORBIT_REFRACTION_H

#include <stdbool.h>

/* The air at a site; zero-initialised: none. */
typedef struct refraction {
    bool on;
    double pressure_hpa, temperature_c; /* at the site */
} refraction;

/* The standard atmosphere (ISO 2533:1975) at a height above sea level, m; what is below 0 or above
 * 11 km, where its troposphere ends, counts as those. */
refraction refraction_standard(double height_m);

/* What refraction adds to an elevation, rad, at least 0. apparent: the elevation that is seen, rad.
 * Bennett 1982, Journal of Navigation 35, 255, scaled with the density of the air: good to 0.1
 * arcmin in the air that it was made for, 1010 hPa and 10 C, at all elevations of 0 and above.
 * Below 0 it stays at its value there, 34.5 arcmin. 0 without air. */
double refraction_lift(const refraction *air, double apparent);

/* The apparent elevation of a geometric one, and back; rad. Both rise together. */
double refraction_apparent(const refraction *air, double geometric);
double refraction_geometric(const refraction *air, double apparent);

#endif
