/* eclipse.h: how much of the Sun's disc a satellite sees past the Earth and the Moon, and what the
 * Earth hides. */
#ifndef GLINT_ORBIT_ECLIPSE_H
#define GLINT_ORBIT_ECLIPSE_H

#include <stdbool.h>

/* Visible fraction, 0 to 1, of the light of the solar disc above the limb of the WGS84 ellipsoid.
 * r_m: geocentre to satellite; sun: unit vector from the satellite to the (apparent) Sun;
 * sun_distance_m: from the satellite; pole: unit vector along the Earth's axis; all in one frame.
 * The limb's angle is that of the ellipsoid in the plane satellite - centre - Sun; then the overlap
 * of two plane discs (physics page, section 7): within 3e-4 of the exact integral. A satellite
 * inside the ellipsoid is dark. Refraction is not modelled. limb_darkening: as below. */
double eclipse_sunlit_fraction(const double r_m[3], const double sun[3], double sun_distance_m,
                               const double pole[3], double limb_darkening);

/* The two discs that the fraction follows from, as the satellite sees them; all in rad. */
typedef struct eclipse_discs {
    double sun;        /* angular radius */
    double earth;      /* angle from the Earth's centre to its limb, towards the Sun */
    double separation; /* of the centres */
} eclipse_discs;

/* Finds them; arguments as above. The Sun is whole where separation >= earth + sun, and hidden
 * where separation <= earth - sun. The satellite must be outside the ellipsoid. */
void eclipse_discs_at(const double r_m[3], const double sun[3], double sun_distance_m,
                      const double pole[3], eclipse_discs *out);

/* Visible fraction, 0 to 1, of the light of the solar disc beside the Moon's: the overlap of two
 * plane discs. moon_m: from the satellite to the Moon, m, not zero; sun: unit; sun_distance_m; in
 * one frame. A satellite inside the Moon is dark. */
double eclipse_moon_fraction(const double moon_m[3], const double sun[3], double sun_distance_m,
                             double limb_darkening);

/* Angle between the rims of the Moon's and the Sun's discs, rad; negative where the Moon covers a
 * part of the Sun. Arguments as above; the point must be outside the Moon. */
double eclipse_moon_gap(const double moon_m[3], const double sun[3], double sun_distance_m);

/* True when the WGS84 ellipsoid stands between two points outside it; m from the geocentre; pole:
 * unit vector along the Earth's axis; all in one frame. Refraction is not modelled. */
bool eclipse_earth_between(const double a_m[3], const double b_m[3], const double pole[3]);

/* Uncovered fraction of a disc of angular radius a behind one of radius b at distance d (all rad,
 * at least 0, treated as plane). a = 0 is a point: 1 or 0. */
double eclipse_disc_fraction(double a, double b, double d);
/* The same of the light of a disc whose brightness at s of its radius from the middle is
 * proportional to 1 - limb_darkening (1 - sqrt(1 - s^2)), linear limb darkening, 0 to 1: 0 is the
 * uniform disc, above. To 1e-6. */
double eclipse_disc_light(double a, double b, double d, double limb_darkening);

#endif
