/* sharpness.h: how little a surface need tilt before its reflection changes. */
#ifndef GLINT_BRDF_SHARPNESS_H
#define GLINT_BRDF_SHARPNESS_H

#include "brdf/brdf.h"

/* Tilts of the normal, rad, along the tangent [0] and across it [1]. */
typedef struct brdf_sharpness {
    double width[2]; /* over which f changes as much as a Gaussian does in one standard deviation
                        from its top: by 1 - exp(-1/2) of its height. Of Ward's lobes alpha /
                        sqrt(2), but for terms of third order. HUGE_VAL: not within SHARPNESS_BROAD,
                        as of a diffuse surface */
    double reach[2]; /* past which less than SHARPNESS_TAIL of that height is left of the lobe.
                        HUGE_VAL: it has wings as far as SHARPNESS_BROAD */
} brdf_sharpness;

#define SHARPNESS_BROAD 0.5 /* rad: what changes more slowly does not count as a lobe */
#define SHARPNESS_TAIL 1e-4

/* Describes one lobe. Found by looking: f (1/sr) is compared with itself while the bisector of the
 * two directions leaves the normal, at phase angles 0 and 60 deg; the sharper of the two counts for
 * the width, the wider one for the reach. Light that is mirrored perfectly is not looked at. */
void brdf_lobe_sharpness(const brdf_lobe *lobe, brdf_sharpness *out);

/* The smallest width of the lobes of a material that have a weight, along and across the tangent; 0
 * where one of them is a mirror. */
double brdf_material_width(const brdf_material *material);

#endif
