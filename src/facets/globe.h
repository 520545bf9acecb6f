/* globe.h: sunlight that comes by way of a globe: the lit part of the Earth that the satellite
 * sees, as a source that fills a part of the sky.
 *
 * Rings around the point below the satellite carry nodes: directions in which light arrives, with
 * the irradiance that each brings. Rings lie at Gauss's points in the angle at which light leaves
 * the ground (0 below the satellite, 90 deg at the limb), in which everything is smooth; nodes on a
 * ring lie evenly where all of it is lit, else at Gauss's points between its two crossings of the
 * terminator. The rings are cut in two where they begin to cross it. So nothing but a facet's own
 * horizon is sampled across an edge.
 *
 * Lobes narrower than the nodes would show are integrated around their highlight instead, over
 * bisectors; a mirror sees the one point of the globe that it shows. (Physics page, section 8.) */
#ifndef GLINT_FACETS_GLOBE_H
#define GLINT_FACETS_GLOBE_H

#include "facets/model.h"
#include "facets/visibility.h"

/* The smallest width of a lobe (brdf/sharpness.h) that nodes resolve, rad. A globe's own lobes must
 * not be narrower; those of the model's materials are treated by themselves where they are. */
#define GLOBE_NARROW 0.05

enum { GLOBE_FEWEST_RINGS = 8, GLOBE_MOST_RINGS = 400 };

/* How a satellite and the Sun stand to the globe; the vectors in one frame of any kind. */
typedef struct globe_view {
    double up[3];      /* unit, from the globe's centre to the satellite */
    double sun[3];     /* unit, from the globe's centre to the Sun */
    double distance;   /* of the satellite from the centre, in radii of the globe, above 1 */
    double irradiance; /* of the Sun at the globe over that at 1 au */
} globe_view;

/* Radiance over the solar irradiance at 1 au, 1/sr, that comes from direction `to` (unit, from the
 * satellite, in the view's frame); 0 past the limb and where the ground is dark. ground: isotropic,
 * no mirror. */
double globe_radiance(const globe_view *view, const brdf_material *ground, const double to[3]);

typedef struct globe globe;
typedef struct globe_scratch globe_scratch;

/* Prepares a globe as a source for a model. m: borrowed until globe_free. ground: how the globe
 * reflects in each of the model's bands, isotropic, no mirror, no lobe below GLOBE_NARROW;
 * borrowed. rings: from limb to limb through the point below the satellite there are twice as many,
 * GLOBE_FEWEST_RINGS to GLOBE_MOST_RINGS, taken up to the next multiple of 4; 0: as the widths of
 * the lobes ask for. Errors: GLINT_INTERNAL (memory). */
glint_status globe_make(const model *m, const brdf_material *ground, int rings, globe **out,
                        glint_error *error);
void globe_free(globe *g);
/* Rings in use. */
int globe_rings(const globe *g);

/* Memory for one thread; no lane is set. Errors: GLINT_INTERNAL (memory). */
glint_status globe_scratch_make(const globe *g, globe_scratch **out, glint_error *error);
void globe_scratch_free(globe_scratch *scratch);

/* Lays the nodes of a lane out. view: NULL leaves the lane dark. centre: where the light comes from
 * on the whole, the mean direction weighted with the first band's irradiance; unit, in the view's
 * frame; NULL allowed. False where no lit ground is seen; *centre is then unset. */
bool globe_look(const globe *g, globe_scratch *scratch, int lane, const globe_view *view,
                double centre[3]);

/* The light of the globe for one tile: as model_sum, but each band's sum carries the irradiance of
 * its nodes over that of the Sun at 1 au, and the source is what globe_look has laid out. poses:
 * BRDF_TILE x n_components, of which the orientations count, into the frame of the views; only
 * those of lanes that are not dark are read. lights: one per component, of which the observer's
 * directions count. visible: as model_sum takes it. Pieces of curved surfaces count with their own
 * normals. */
void globe_sum(const globe *g, globe_scratch *scratch, const visibility_pose *poses,
               const brdf_light *lights, const double *visible, double *x);

#endif
