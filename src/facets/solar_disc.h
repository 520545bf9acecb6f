/* solar_disc.h: the light of a source that is a disc, not a point; private to this room.
 *
 * What a facet reflects is the mean of its term over the disc. A lobe that is much wider than the
 * disc hardly notices; near the highlight of a narrow one, and where the source sets behind the
 * facet's plane, the mean is taken with as few points as do: chosen sample by sample from how far
 * the bisector of the two directions runs, in widths of the lobe, while the source moves across its
 * disc. The mirror direction of a perfect mirror lies on the disc or does not, which is a closed
 * form. Physics page, section 4. */
#ifndef GLINT_FACETS_SOLAR_DISC_H
#define GLINT_FACETS_SOLAR_DISC_H

#include "brdf/brdf.h"
#include "facets/batch.h"
#include "facets/model.h"

/* How narrow a lobe is (brdf/sharpness.h), as the rooms for curved facets and discs ask. */
typedef struct lobe_shape {
    double width[2]; /* rad, along and across the tangent, at most LOBE_WIDEST */
    double narrow;   /* 1 / the smaller one */
    double reach;    /* past it nothing is left, in widths, at phase angle 0; may be infinite */
    bool specular;   /* all of it in the mirror direction */
    bool surge;      /* f changes over less than a few degrees of the phase angle */
} lobe_shape;

/* In place of the width of what has no lobe along one axis, rad. */
#define LOBE_WIDEST 1e3

void lobe_shape_find(const brdf_lobe *lobe, lobe_shape *out);

/* One facet, or a piece of one, under the disc in one lane. */
typedef struct disc_sample {
    const lobe_shape *shape; /* of the batch's only lobe */
    const source_disc *disc;
    int lane; /* with a radius above 0 */
} disc_sample;

/* Adds the mean over the disc of the light of matter of that area, with a pair of directions (i: to
 * the disc's centre) in its own frame t, b, n. Points of the disc below the horizon give nothing.
 */
void disc_push(batch *b, const disc_sample *sample, const double i[3], const double r[3],
               double area_m2);

/* Which lanes of a facet need more than the centre of the disc. Returns a bit for each. */
uint32_t disc_lanes(const lobe_shape *shape, const brdf_facets *facets, int which,
                    const brdf_light *light, const source_disc *disc);

#endif
