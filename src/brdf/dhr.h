/* dhr.h: directional-hemispherical reflectance: how much of the light from one direction a material
 * sends back into all directions together. */
#ifndef GLINT_BRDF_DHR_H
#define GLINT_BRDF_DHR_H

#include "brdf/brdf.h"

/* The integral of f cr over the hemisphere of directions to the observer, mirrors included, a pure
 * number.
 *
 * theta_i: zenith angle of the source, rad, 0 <= theta_i < pi/2; phi_i: its azimuth from the
 * tangent towards the bitangent, rad. relative_tolerance: wanted of the result; below 1e-12 as
 * 1e-12. error_bound: estimate of the absolute error, NULL allowed; at tolerances above 1e-5 folded
 * or very anisotropic lobes may exceed it several times.
 * Errors: GLINT_ARGUMENT: theta_i out of range (nothing is set). GLINT_INPUT: the tolerance could
 * not be met with the work allowed (5 million samples a lobe); *dhr and *error_bound hold what was
 * reached. GLINT_INTERNAL: memory is out. */
glint_status brdf_dhr(const brdf_material *material, double theta_i, double phi_i,
                      double relative_tolerance, double *dhr, double *error_bound,
                      glint_error *error);

/* The largest reflectance that was found, and where. */
typedef struct brdf_energy {
    double theta_i, phi_i; /* rad */
    double dhr; /* to 1e-3 of it, and where it is near 1 to 1e-7, or 1e-5 of measured values */
} brdf_energy;

/* Looks for the incidence at which a material reflects most: zenith angles from 0 to 85 deg and,
 * unless it is isotropic, azimuths of 0 and 90 deg. True when at one of them it surely reflects
 * more than it gets (dhr > 1 + 1e-6). *worst is set in any case. Costs milliseconds. */
bool brdf_energy_gain(const brdf_material *material, brdf_energy *worst);

#endif
