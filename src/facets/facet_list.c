#include "base/grow.h"
#include "base/vec.h"
#include "facets/primitive.h"

#include <assert.h>
#include <stdlib.h>

void facet_list_free(facet_list *list)
{
    if (!list) return;
    free(list->items);
    free(list->vertices);
    free(list->normals);
    free(list->surfaces);
    *list = (facet_list){0};
}

void facet_list_truncate(facet_list *list, int n, int n_vertices, int n_surfaces)
{
    assert(n <= list->n && n_vertices <= list->n_vertices && n_surfaces <= list->n_surfaces);
    list->n = n;
    list->n_vertices = n_vertices;
    list->n_surfaces = n_surfaces;
}

glint_status facet_list_reserve(facet_list *list, int n_facets, int n_vertices, glint_error *error)
{
    assert(n_facets >= 0 && n_vertices >= 0);
    const long n = (long)list->n + n_facets, n_corners = (long)list->n_vertices + n_vertices;
    int of_normals = list->vertex_capacity;
    if (!grow_room(&list->items, &list->capacity, n, sizeof *list->items) ||
        (list->normals &&
         !grow_room(&list->normals, &of_normals, n_corners, sizeof *list->normals)) ||
        !grow_room(&list->vertices, &list->vertex_capacity, n_corners, sizeof *list->vertices))
        return error_no_memory(error);
    return GLINT_OK;
}

/* Unit normal and area of a polygon (Newell's method: half the sum of the cross products of
 * neighbouring vertices). The products are taken from the first vertex, so that a small polygon far
 * from the origin loses no digits. */
static double newell(const double (*vertices)[3], int n, double normal[3])
{
    double twice_area[3] = {0, 0, 0};
    double a[3], b[3], c[3];
    sub3(vertices[1], vertices[0], a);
    for (int k = 2; k < n; k++) {
        sub3(vertices[k], vertices[0], b);
        cross3(a, b, c);
        add3(twice_area, c, twice_area);
        copy3(b, a);
    }
    return 0.5 * unit3(twice_area, normal);
}

glint_status facet_list_add(facet_list *list, const double (*vertices)[3], int n,
                            const double tangent[3], int material, int component,
                            glint_error *error)
{
    assert(n >= 3);
    facet f = {.first_vertex = list->n_vertices,
               .n_vertices = n,
               .material = material,
               .component = component};
    f.area_m2 = newell(vertices, n, f.normal);
    if (!(f.area_m2 > 0.0))
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "a facet encloses no area; expected corners that are not on one line");
    const double across = perp3(tangent, f.normal, f.tangent);
    assert(across > 0.0);
    (void)across;
    const glint_status status = facet_list_reserve(list, 1, n, error);
    if (status) return status;
    memcpy(list->vertices + list->n_vertices, vertices, (size_t)n * sizeof *vertices);
    list->n_vertices += n;
    list->items[list->n++] = f;
    return GLINT_OK;
}

glint_status facet_list_reserve_surfaces(facet_list *list, int n, glint_error *error)
{
    return grow_room(&list->surfaces, &list->surface_capacity, (long)list->n_surfaces + n,
                     sizeof *list->surfaces)
               ? GLINT_OK
               : error_no_memory(error);
}

glint_status facet_list_add_surface(facet_list *list, const curved_surface *surface, int *number,
                                    glint_error *error)
{
    const glint_status status = facet_list_reserve_surfaces(list, 1, error);
    if (status) return status;
    list->surfaces[list->n_surfaces++] = *surface;
    *number = list->n_surfaces;
    return GLINT_OK;
}

glint_status facet_list_smooth(facet_list *list, int k, int surface, const double (*normals)[3],
                               glint_error *error)
{
    assert(k >= 0 && k < list->n && surface >= 1 && surface <= list->n_surfaces);
    assert(list->surfaces[surface - 1].kind == SURFACE_SMOOTH);
    if (!list->normals) {
        list->normals = malloc((size_t)list->vertex_capacity * sizeof *list->normals);
        if (!list->normals) return error_no_memory(error);
    }
    facet *f = &list->items[k];
    f->surface = surface;
    memcpy(list->normals + f->first_vertex, normals, (size_t)f->n_vertices * sizeof *normals);
    return GLINT_OK;
}
