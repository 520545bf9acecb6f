/* noise.h: how well a telescope measures a satellite: electrons and their scatter. */
#ifndef GLINT_LIGHTCURVE_NOISE_H
#define GLINT_LIGHTCURVE_NOISE_H

#include "scenario/scenario.h"

/* One exposure. */
typedef struct noise_view {
    double magnitude;  /* apparent, as it arrives at the telescope */
    double exposure_s; /* > 0 */
    double trail_rad;  /* length of the trail on the sky, >= 0 */
    double airmass;    /* >= 1; 0: no atmosphere, so that nothing scintillates */
    double height_m;   /* of the telescope above sea level */
} noise_view;

/* What ends up in the box around the trail, electrons; all but the signal are standard deviations.
 */
typedef struct noise_terms {
    double signal_e;         /* from the satellite, in the box */
    double fraction, pixels; /* part of the light that falls into the box; its area */
    double photon_e, sky_e, dark_e, read_e, scintillation_e;
} noise_terms;

/* The terms of one exposure in a band of the telescope. The image is a Gaussian as wide as the
 * seeing, drawn out along the trail; the box reaches half_width_rad beyond the trail at both sides
 * and at both ends. Scintillation: Young 1967, AJ 72, 747, with the coefficient of Osborn et al.
 * 2015, MNRAS 452, 1707, eq. 7, for exposures that are long against the time in which the wind
 * crosses the aperture. */
void noise_of(const telescope *scope, int band, const noise_view *view, noise_terms *out);

/* Signal over the root of the sum of squares of all terms; 0 without a signal. */
double noise_snr(const noise_terms *terms);
/* Standard deviation of a magnitude with that ratio > 0, to first order: 2.5 / (ln 10 snr). */
double noise_sigma_mag(double snr);

/* The same of a row of a run, whose magnitude in the band exists. */
double noise_row_snr(const glint_scenario *s, const glint_row *row, int band);

#endif
