/* visibility.h: which part of every facet is both lit by the source and seen by the observer.
 *
 * Of a facet with normal n, lit from direction i and seen from direction r (both at infinity), the
 * fraction of its area that is left when the shadows of all other facets, projected on its plane
 * along i, and what they hide, projected along r, are taken away. Exact: polygons are subtracted
 * from polygons, nothing is sampled. Every facet casts shadows from both sides; facets in one plane
 * cast none on each other. (Physics page, section 6.)
 *
 * A plan is made once from the model: which facets form closed and convex bodies (these cast their
 * shadow as one outline), which can ever be shadowed by anything, and a tree over all that casts
 * shadows. It is immutable and shared by threads; each thread has a scratch of its own. Results do
 * not depend on the number of threads. */
#ifndef GLINT_FACETS_VISIBILITY_H
#define GLINT_FACETS_VISIBILITY_H

#include "facets/model.h"

/* Where a component is: v_body = R v_component + origin. Any frame common to all components may
 * stand for the body's, as long as the directions are given in it too. */
typedef struct visibility_pose {
    double body_component[9]; /* a rotation */
    double origin_m[3];       /* of the component, body frame */
} visibility_pose;

/* A component as the plan takes it. A component that moves turns about its hinge's axis, which goes
 * through its origin, by any angle; others stay where they are in their parent. */
typedef struct visibility_component {
    int parent; /* index, -1 for the body itself */
    bool moves;
    double axis[3];       /* unit, component frame; only where it moves */
    visibility_pose pose; /* at one moment, the same for all components; any moment will do */
} visibility_component;

typedef struct visibility visibility;
typedef struct visibility_scratch visibility_scratch;

/* Makes a plan. m: borrowed until visibility_free. components: m->n_components of them, their
 * parents in any order but without cycles; only read during the call. Errors: GLINT_INTERNAL
 * (memory). */
glint_status visibility_make(const model *m, const visibility_component *components,
                             visibility **out, glint_error *error);
void visibility_free(visibility *plan);

enum { VISIBILITY_MOST_RAYS = 65536 };

/* Has fractions come from rays from now on: those of rays_per_facet points (1 to
 * VISIBILITY_MOST_RAYS) of each facet that can be shadowed, spread evenly and the same at all
 * times. A fraction x is then off by about sqrt(x (1 - x)) n^-0.7, and a sum over facets by less.
 * For models of so many polygons that exact fractions take too long. Errors: GLINT_INPUT where
 * glint is built without rays; GLINT_INTERNAL (memory). */
glint_status visibility_use_rays(visibility *plan, const model *m, int rays_per_facet,
                                 glint_error *error);
/* Whether glint is built with them. */
bool visibility_has_rays(void);

/* True when no facet can ever be shadowed, as on a convex body: visibility_fill would give 1 for
 * everything that is lit and seen, and need not be called. */
bool visibility_is_trivial(const visibility *plan);

/* Number of facets that can be shadowed by something at some time. */
int visibility_n_exposed(const visibility *plan);

/* How many facets of each component each component can come before, at some angle of the hinges:
 * counts[on n + by], n = m->n_components; a component may come before its own facets. Hinges
 * between two components are taken to turn by any angle, and balls about them for what they sweep:
 * what never happens may be counted, what happens is never left out. Errors: GLINT_INTERNAL
 * (memory). */
glint_status visibility_count_exposed(const model *m, const visibility_component *components,
                                      int *counts, glint_error *error);

/* Memory for one thread. Errors: GLINT_INTERNAL (memory). */
glint_status visibility_scratch_make(const visibility *plan, visibility_scratch **out,
                                     glint_error *error);
void visibility_scratch_free(visibility_scratch *scratch);

/* Writes the fraction for every facet f to visible[f BRDF_TILE + lane], 0 to 1; 0 where the facet
 * is not lit or not seen (cosines up to BRDF_EDGE). poses: of all components at this moment.
 * sun_body, observer_body: unit, body frame, away from the satellite. visible: m->n_facets x
 * BRDF_TILE, as model_sum takes it. What was computed for one direction is kept: calls that follow
 * with the same poses and the same observer (another source) or the same source are cheaper.
 * Errors: GLINT_INTERNAL (memory). */
glint_status visibility_fill(const visibility *plan, visibility_scratch *scratch,
                             const visibility_pose *poses, const double sun_body[3],
                             const double observer_body[3], int lane, double *visible,
                             glint_error *error);

#endif
