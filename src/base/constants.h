/* constants.h: physical and astronomical constants, each with its unit and source. */
#ifndef GLINT_BASE_CONSTANTS_H
#define GLINT_BASE_CONSTANTS_H

#define PI 3.14159265358979323846
#define TWO_PI (2.0 * PI)
#define DEG (PI / 180.0)      /* rad per degree */
#define ARCSEC (DEG / 3600.0) /* rad per second of arc */
#define DAY_S 86400.0         /* s per day */

#define LIGHT_SPEED_M_S 299792458.0 /* m/s, exact (SI) */
#define PLANCK_J_S 6.62607015e-34   /* J s, exact (SI) */
#define AU_M 149597870700.0         /* m, exact (IAU 2012 resolution B2) */
#define SUN_RADIUS_M 695700e3       /* m, nominal (IAU 2015 resolution B3) */
/* Linear limb darkening of the Sun: I(mu) is proportional to 1 - u (1 - mu), mu the cosine of the
 * angle at which light leaves its surface. u at 550 nm: physics page, section 4. */
#define SUN_LIMB_DARKENING 0.6

#define EARTH_MU_M3_S2 398600.4418e9           /* m^3/s^2, EGM96 with atmosphere */
#define EARTH_RADIUS_M 6378137.0               /* m, WGS84 equatorial radius */
#define EARTH_FLATTENING (1.0 / 298.257223563) /* WGS84 */
#define EARTH_RATE_RAD_S 7.292115e-5           /* rad/s, WGS84 nominal rotation rate */
/* rad/s, rate of the Earth rotation angle: Capitaine, Guinot, McCarthy 2000; IERS Conventions 2010,
 * eq. 5.15 */
#define EARTH_TURN_RAD_S (TWO_PI * 1.00273781191135448 / DAY_S)
#define GEOSTATIONARY_RADIUS_M 42164.17e3 /* m, geostationary distance from the geocentre */

#define TT_MINUS_TAI_S 32.184 /* s, exact (definition of TT) */

#endif
