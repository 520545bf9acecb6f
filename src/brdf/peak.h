/* peak.h: where a lobe has its maximum. */
#ifndef GLINT_BRDF_PEAK_H
#define GLINT_BRDF_PEAK_H

#include "brdf/brdf.h"

/* The maximum of f in the plane of incidence that is reached uphill from the mirror direction. It
 * lies a little beyond that direction wherever the model divides by cosines. theta_i: zenith angle
 * of the source, rad, |theta_i| < pi/2; phi_i: its azimuth, rad. *theta_r: zenith angle of the
 * maximum, rad, positive on the mirror side (azimuth phi_i + pi), good to 1e-7 rad; *f: 1/sr, good
 * to rounding. False where f rises as far as the horizon, or is 0. */
bool brdf_peak(const brdf_material *material, double theta_i, double phi_i, double *theta_r,
               double *f);

#endif
