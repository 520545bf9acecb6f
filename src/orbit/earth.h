/* earth.h: the WGS84 ellipsoid through GeographicLib (Geocentric, NormalGravity), as a C face. */
#ifndef GLINT_ORBIT_EARTH_H
#define GLINT_ORBIT_EARTH_H

#include "base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A place on the Earth. */
typedef struct earth_site {
    double latitude, longitude; /* geodetic, rad */
    double height_m;            /* above the ellipsoid */
    double r_itrs_m[3];
    double enu_itrs[9]; /* v_enu = R v_itrs: east, north, up */
} earth_site;

/* latitude -pi/2..pi/2 rad, longitude rad, height m. Errors: GLINT_INTERNAL when GeographicLib
 * refuses (not for finite values in range). */
glint_status earth_site_at(double latitude, double longitude, double height_m, earth_site *out,
                           glint_error *error);
/* Geodetic latitude, longitude (rad) and height (m) of an ITRS point. */
void earth_geodetic(const double r_itrs_m[3], double *latitude, double *longitude,
                    double *height_m);
/* Unit vector, ITRS, from a point straight down to the ellipsoid. */
void earth_geodetic_nadir(const double r_itrs_m[3], double nadir_itrs[3]);
/* J2 of WGS84's normal gravity field. */
double earth_j2(void);

#ifdef __cplusplus
}
#endif
#endif
