/* band.h: photometric bands with the apparent magnitude of the Sun in them. */
#ifndef GLINT_BASE_BAND_H
#define GLINT_BASE_BAND_H

#include <stdbool.h>
#include <stddef.h>

typedef enum magnitude_system { SYSTEM_VEGA, SYSTEM_AB } magnitude_system;

/* One band. */
typedef struct band_info {
    const char *name;        /* "V", "sdss_g", "lsst_g" */
    const char *doc;         /* the filter, in words */
    double pivot_um;         /* pivot wavelength, um */
    double sun_vega, sun_ab; /* apparent magnitude of the Sun at 1 au; NAN where not published */
    double site_extinction;  /* mag per airmass at the LSST site; NAN where the scenario must say */
    magnitude_system system; /* its usual system */
    double relative_width;   /* width over wavelength, with the filter's peak as 1; NAN where the
                                scenario must give a zero point */
} band_info;

/* Band k of the table from 0; NULL past the end. */
const band_info *band_at(size_t k);
/* The band of that name, or NULL. */
const band_info *band_named(const char *name);
/* The Sun's magnitude in a system; NAN where there is none. */
double band_sun_magnitude(const band_info *band, magnitude_system system);
/* Photons per s and m^2 above the atmosphere from a star of magnitude 0 whose spectrum is flat per
 * frequency, through a filter whose peak is 1: the flux of AB magnitude 0 over Planck's constant,
 * times the relative width. Magnitudes of the Vega system become AB ones by the Sun's magnitudes in
 * both. NAN where the width or the Sun's magnitude is not known. */
double band_photons_m2_s(const band_info *band, magnitude_system system);
const char *magnitude_system_name(magnitude_system system);
/* Where the table's numbers come from. */
#define BAND_SOURCE "Willmer 2018, ApJS 236, 47"

#endif
