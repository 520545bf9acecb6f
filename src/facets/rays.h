/* rays.h: whether rays meet triangles: the face of Embree 3 (rays.c), or of nothing, where glint is
 * built without it (rays_none.c); private to this room. */
#ifndef GLINT_FACETS_RAYS_H
#define GLINT_FACETS_RAYS_H

#include "base/error.h"

/* Triangles that rays are sent through. Immutable, shared by threads. */
typedef struct ray_scene ray_scene;

/* Whether there are rays at all. */
bool rays_are_built(void);

/* vertices: m, n_vertices >= 1, finite, copied. triangles: indices of vertices, n_triangles >= 1,
 * copied; hit from both sides. Errors: GLINT_INPUT where glint is built without rays;
 * GLINT_INTERNAL (memory). */
glint_status ray_scene_make(const double (*vertices)[3], int n_vertices, const int (*triangles)[3],
                            int n_triangles, ray_scene **out, glint_error *error);
void ray_scene_free(ray_scene *scene);

enum { RAY_BATCH = 8 };

/* Sets met[k] where the ray from origin_m[k] along `direction`, without end, meets a triangle, and
 * leaves it alone elsewhere; rays that are met already are not sent. n: RAY_BATCH at most. All in
 * the scene's coordinates, which are rounded to floats; finite. */
void ray_scene_meet(const ray_scene *scene, const double (*origin_m)[3], const double direction[3],
                    int n, bool *met);

#endif
