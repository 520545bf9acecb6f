/* The sum facet by facet. It has to be the sum that curves are made of, whatever goes into that: so
 * a model is made in which every facet is a component of its own, and summed. */
#include "facets/model.h"

#include <stdlib.h>
#include <string.h>

/* Facets that are summed together: bounds the memory that their lights take. */
enum { CHUNK = 512 };

static const model_component PART = {"facet"};

/* Copies facets first .. first + n - 1 to a list in which they are components 0 .. n - 1. */
static glint_status copy_facets(const facet_list *from, int first, int n, facet_list *to,
                                glint_error *error)
{
    const facet *items = from->items + first;
    int n_vertices = 0;
    for (int k = 0; k < n; k++)
        n_vertices += items[k].n_vertices;
    const size_t corners = (size_t)n_vertices, surfaces = (size_t)from->n_surfaces;
    to->items = malloc((size_t)n * sizeof *to->items);
    to->vertices = malloc(corners * sizeof *to->vertices);
    to->normals = from->normals ? malloc(corners * sizeof *to->normals) : NULL;
    to->surfaces = surfaces ? malloc(surfaces * sizeof *to->surfaces) : NULL;
    if (!to->items || !to->vertices || (from->normals && !to->normals) ||
        (surfaces && !to->surfaces))
        return error_no_memory(error);
    to->capacity = n, to->vertex_capacity = n_vertices;
    to->n_surfaces = to->surface_capacity = from->n_surfaces;
    if (surfaces) memcpy(to->surfaces, from->surfaces, surfaces * sizeof *to->surfaces);
    for (; to->n < n; to->n++) {
        facet *f = &to->items[to->n];
        *f = items[to->n];
        const size_t size = (size_t)f->n_vertices * sizeof *to->vertices;
        memcpy(to->vertices + to->n_vertices, from->vertices + f->first_vertex, size);
        if (to->normals)
            memcpy(to->normals + to->n_vertices, from->normals + f->first_vertex, size);
        f->first_vertex = to->n_vertices;
        f->component = to->n;
        to->n_vertices += f->n_vertices;
    }
    return GLINT_OK;
}

/* What one chunk needs. */
typedef struct chunk {
    model_component *parts; /* owned; CHUNK */
    brdf_light *lights;     /* owned; CHUNK */
    double *sums;           /* owned */
} chunk;

static glint_status sum_chunk(const model *m, const brdf_light *lights, const source_disc *disc,
                              int band, int lane, int first, int n, chunk *c, double *x,
                              glint_error *error)
{
    facet_list list = {0};
    model single = {0};
    glint_status status = copy_facets(&m->polygons, first, n, &list, error);
    for (int k = 0; !status && k < n; k++)
        c->lights[k] = lights[m->polygons.items[first + k].component];
    if (!status)
        status = model_compile(&list, m->materials, m->n_materials, c->parts, n, m->n_bands,
                               &single, error);
    if (!status) {
        model_sum(&single, c->lights, disc, NULL, c->sums);
        for (int k = 0; k < n; k++) /* a span for each facet, in their order */
            x[first + k] =
                c->sums[((size_t)band * (size_t)n + (size_t)k) * BRDF_TILE + (size_t)lane];
    }
    model_free(&single);
    facet_list_free(&list);
    return status;
}

glint_status model_sum_facets(const model *m, const brdf_light *lights, const source_disc *disc,
                              int band, int lane, double *x, glint_error *error)
{
    const size_t n_sums = (size_t)m->n_bands * CHUNK * BRDF_TILE;
    chunk c = {malloc(CHUNK * sizeof *c.parts), aligned_alloc(64, CHUNK * sizeof *c.lights),
               malloc(n_sums * sizeof *c.sums)};
    glint_status status = GLINT_OK;
    if (!c.parts || !c.lights || !c.sums) status = error_no_memory(error);
    for (int k = 0; !status && k < CHUNK; k++)
        c.parts[k] = PART;
    for (int first = 0; !status && first < m->n_facets; first += CHUNK) {
        const int left = m->n_facets - first;
        status = sum_chunk(m, lights, disc, band, lane, first, left < CHUNK ? left : CHUNK, &c, x,
                           error);
    }
    free(c.parts);
    free(c.lights);
    free(c.sums);
    return status;
}
