/* direction.h: the vocabulary of directions: where "nadir", "sun", "observer", a star or a place
 * lie as seen from the satellite at one moment. */
#ifndef GLINT_ORBIT_DIRECTION_H
#define GLINT_ORBIT_DIRECTION_H

#include "base/error.h"

/* Two directions count as parallel (or opposite) when the sine of the angle between them is at most
 * this: what depends on the plane that they span is then not defined. */
#define DIRECTION_PARALLEL 1e-9

/* What is known of the satellite at the moment when the light leaves it. Vectors in GCRS. */
typedef struct moment {
    double t_s;              /* TT s from the start of the run */
    double r_m[3], v_m_s[3]; /* geocentre to satellite; inertial velocity */
    double sun[3];           /* unit, satellite to apparent Sun */
    double moon[3];          /* unit, satellite to Moon; set only where something looks at it */
    double observer[3];      /* unit, satellite to observer along the light path */
    int viewer;              /* number of that observer in the scenario, from 0 */
    double itrs_gcrs[9];     /* v_itrs = R v_gcrs */
} moment;

typedef enum direction_kind {
    DIRECTION_NADIR, /* geocentric */
    DIRECTION_GEODETIC_NADIR,
    DIRECTION_ZENITH, /* geocentric */
    DIRECTION_VELOCITY,
    DIRECTION_ORBIT_NORMAL, /* r x v */
    DIRECTION_NORTH,        /* GCRS +z */
    DIRECTION_SUN,
    DIRECTION_MOON,
    DIRECTION_OBSERVER,
    DIRECTION_STAR, /* fixed in GCRS */
    DIRECTION_PLACE /* a point fixed to the Earth */
} direction_kind;

typedef struct direction {
    direction_kind kind;
    double star[3];         /* unit, GCRS; DIRECTION_STAR */
    double place_itrs_m[3]; /* DIRECTION_PLACE */
} direction;

/* The words of the vocabulary (the kinds before DIRECTION_STAR), in the order of the enum; NULL
 * past the end. */
const char *direction_word(size_t k);
/* False when there is no such word; *out is then unchanged. */
bool direction_from_word(const char *word, direction *out);
/* How a scenario writes a direction, for messages: its word, or the keys of a star or place. */
const char *direction_name(const direction *d);
/* ra, dec: right ascension and declination, rad, GCRS. */
void direction_star(double ra, double dec, direction *out);
/* latitude: geodetic, -pi/2..pi/2 rad; longitude: rad, east; height_m: above the ellipsoid. Errors:
 * those of earth_site_at. */
glint_status direction_place(double latitude, double longitude, double height_m, direction *out,
                             glint_error *error);

/* out: unit vector, GCRS, from the satellite. Errors (GLINT_INPUT, saying when and why): the
 * direction is not defined: the velocity of a body at rest, the orbit normal where r and v are
 * parallel, a place within 1 mm, anything that the moment does not hold (all zero). */
glint_status direction_at(const direction *d, const moment *m, double out[3], glint_error *error);

#endif
