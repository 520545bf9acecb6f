/* visibility_rays.h: fractions from points spread over each facet, by rays to the source and to the
 * observer; private to visibility*.c.
 *
 * A point counts when neither ray meets anything. The points of a facet are the same at all moments
 * and on all machines. Rays are traced in each component's own coordinates, in floats; parts on
 * hinges stay as they are, and the rays are turned. */
#ifndef GLINT_FACETS_VISIBILITY_RAYS_H
#define GLINT_FACETS_VISIBILITY_RAYS_H

#include "facets/visibility_plan.h"

typedef struct ray_plan ray_plan;

/* Errors: those of ray_scene_make. */
glint_status ray_plan_make(const visibility *plan, const model *m, int rays_per_facet,
                           ray_plan **out, glint_error *error);
void ray_plan_free(ray_plan *rays, int n_components);

/* The fraction of an exposed facet that is turned to both. poses, directions: as visibility_fill
 * takes them; finite. */
double ray_plan_fraction(const visibility *plan, const ray_plan *rays, const visibility_pose *poses,
                         const exposed_facet *f, const double sun_body[3],
                         const double observer_body[3]);

#endif
