/* No rays: what stands in for rays.c where glint is built without Embree. */
#include "facets/rays.h"

bool rays_are_built(void)
{
    return false;
}

glint_status ray_scene_make(const double (*vertices)[3], int n_vertices, const int (*triangles)[3],
                            int n_triangles, ray_scene **out, glint_error *error)
{
    (void)vertices, (void)n_vertices, (void)triangles, (void)n_triangles;
    *out = NULL;
    return error_set(error, GLINT_INPUT, PLACE_NONE,
                     "this glint was built without Embree, and sends no rays");
}

void ray_scene_free(ray_scene *scene)
{
    (void)scene;
}

void ray_scene_meet(const ray_scene *scene, const double (*origin_m)[3], const double direction[3],
                    int n, bool *met)
{
    (void)scene, (void)origin_m, (void)direction, (void)n, (void)met;
}
