#include "facets/model.h"

#include "base/vec.h"
#include "facets/curved.h"
#include "facets/lobe_tile.h"

#include <assert.h>
#include <stdlib.h>

enum { ARRAYS = 10 }; /* normal, tangent, bitangent: 3 each; area */

/* --- sorting --- */

typedef enum sort_key { SORT_MATERIAL, SORT_PART, SORT_COMPONENT } sort_key;

static int key_of(const facet *f, sort_key key)
{
    return key == SORT_MATERIAL ? f->material : key == SORT_PART ? f->part : f->component;
}

/* Stable counting sort: writes the indices of `in` to `out` in rising order of the key. count:
 * n_keys + 1 entries of scratch. */
static void sort_by(const facet *items, const int *in, int n, sort_key key, int *count, int n_keys,
                    int *out)
{
    memset(count, 0, ((size_t)n_keys + 1) * sizeof *count);
    for (int k = 0; k < n; k++)
        count[key_of(&items[k], key) + 1]++;
    for (int k = 0; k < n_keys; k++)
        count[k + 1] += count[k];
    for (int k = 0; k < n; k++)
        out[count[key_of(&items[in[k]], key)]++] = in[k];
}

static int count_parts(const facet_list *facets)
{
    int n = 1;
    for (int k = 0; k < facets->n; k++)
        n = facets->items[k].part < n ? n : facets->items[k].part + 1;
    return n;
}

static int largest(int a, int b, int c)
{
    return a > b ? (a > c ? a : c) : b > c ? b : c;
}

/* The order of the facets by component, then part, then material, then as they came. `order` has
 * room for n. */
static glint_status find_order(const facet_list *facets, int n_materials, int n_components,
                               int *order, glint_error *error)
{
    const int n = facets->n, n_parts = count_parts(facets);
    const int most = largest(n_materials, n_components, n_parts);
    int *other = malloc((size_t)n * sizeof *other);
    int *count = malloc(((size_t)most + 1) * sizeof *count);
    const bool ok = other && count;
    if (ok) {
        for (int k = 0; k < n; k++)
            other[k] = k;
        sort_by(facets->items, other, n, SORT_MATERIAL, count, n_materials, order);
        sort_by(facets->items, order, n, SORT_PART, count, n_parts, other);
        sort_by(facets->items, other, n, SORT_COMPONENT, count, n_components, order);
    }
    free(other);
    free(count);
    return ok ? GLINT_OK : error_no_memory(error);
}

/* Copies the surfaces, and makes room for the normals at the vertices where there are any. */
static glint_status copy_surfaces(const facet_list *facets, facet_list *out, glint_error *error)
{
    const glint_status status = facet_list_reserve_surfaces(out, facets->n_surfaces, error);
    if (status) return status;
    out->n_surfaces = facets->n_surfaces;
    if (out->n_surfaces > 0)
        memcpy(out->surfaces, facets->surfaces, (size_t)out->n_surfaces * sizeof *out->surfaces);
    if (!facets->normals) return GLINT_OK;
    out->normals = calloc((size_t)out->vertex_capacity, sizeof *out->normals);
    return out->normals ? GLINT_OK : error_no_memory(error);
}

/* Copies the facets and their vertices in that order. */
static glint_status copy_in_order(const facet_list *facets, const int *order, facet_list *out,
                                  glint_error *error)
{
    glint_status status = facet_list_reserve(out, facets->n, facets->n_vertices, error);
    if (!status) status = copy_surfaces(facets, out, error);
    if (status) return status;
    for (int k = 0; k < facets->n; k++) {
        facet f = facets->items[order[k]];
        const size_t size = (size_t)f.n_vertices * sizeof *out->vertices;
        memcpy(out->vertices + out->n_vertices, facets->vertices + f.first_vertex, size);
        if (out->normals)
            memcpy(out->normals + out->n_vertices, facets->normals + f.first_vertex, size);
        f.first_vertex = out->n_vertices;
        out->n_vertices += f.n_vertices;
        out->items[out->n++] = f;
    }
    return GLINT_OK;
}

static glint_status sort_facets(const facet_list *facets, int n_materials, int n_components,
                                facet_list *out, glint_error *error)
{
    int *order = malloc((size_t)facets->n * sizeof *order);
    if (!order) return error_no_memory(error);
    glint_status status = find_order(facets, n_materials, n_components, order, error);
    if (!status) status = copy_in_order(facets, order, out, error);
    free(order);
    return status;
}

/* --- compiling --- */

static bool same_span(const facet *a, const facet *b)
{
    return a->component == b->component && a->part == b->part && a->material == b->material;
}

/* Length of one array: an odd number of whole cache lines (8 doubles). Odd, so that the places of
 * one facet in the ten arrays, which are read together, fall in different sets of the cache. */
static size_t array_stride(int n_facets)
{
    const size_t lines = ((size_t)n_facets + 7) / 8;
    return 8 * (lines | 1);
}

static glint_status fill_arrays(model *m, glint_error *error)
{
    const size_t stride = array_stride(m->n_facets);
    m->arrays = aligned_alloc(64, ARRAYS * stride * sizeof *m->arrays);
    if (!m->arrays) return error_no_memory(error);
    memset(m->arrays, 0, ARRAYS * stride * sizeof *m->arrays);
    for (int k = 0; k < m->n_facets; k++) {
        const facet *f = &m->polygons.items[k];
        double bitangent[3];
        cross3(f->normal, f->tangent, bitangent);
        for (size_t j = 0; j < 3; j++) {
            m->arrays[j * stride + (size_t)k] = f->normal[j];
            m->arrays[(3 + j) * stride + (size_t)k] = f->tangent[j];
            m->arrays[(6 + j) * stride + (size_t)k] = bitangent[j];
        }
        m->arrays[9 * stride + (size_t)k] = f->area_m2;
    }
    return GLINT_OK;
}

static model_span make_span(const model *m, int first, int end)
{
    const facet *f = &m->polygons.items[first];
    const size_t stride = array_stride(m->n_facets);
    const double *start = m->arrays + first;
    model_span span = {.component = f->component,
                       .material = f->material,
                       .part = f->part,
                       .first = first,
                       .n = end - first,
                       .facets = {.n = end - first, .area = start + 9 * stride}};
    for (size_t j = 0; j < 3; j++) {
        span.facets.normal[j] = start + j * stride;
        span.facets.tangent[j] = start + (3 + j) * stride;
        span.facets.bitangent[j] = start + (6 + j) * stride;
    }
    return span;
}

static glint_status make_spans(model *m, glint_error *error)
{
    const facet *items = m->polygons.items;
    int n_spans = 1;
    for (int k = 1; k < m->n_facets; k++)
        n_spans += !same_span(&items[k - 1], &items[k]);
    m->spans = malloc((size_t)n_spans * sizeof *m->spans);
    if (!m->spans) return error_no_memory(error);
    for (int first = 0, end; first < m->n_facets; first = end) {
        end = first + 1;
        while (end < m->n_facets && same_span(&items[first], &items[end]))
            end++;
        m->spans[m->n_spans++] = make_span(m, first, end);
    }
    return GLINT_OK;
}

static glint_status find_same_bands(model *m, glint_error *error)
{
    m->same_band = malloc((size_t)m->n_materials * (size_t)m->n_bands * sizeof *m->same_band);
    if (!m->same_band) return error_no_memory(error);
    for (int k = 0; k < m->n_materials; k++) {
        const brdf_material *bands = m->materials[k].bands;
        int *same = m->same_band + (size_t)k * (size_t)m->n_bands;
        for (int b = 0; b < m->n_bands; b++) {
            same[b] = 0;
            while (same[b] < b && !brdf_material_same(&bands[same[b]], &bands[b]))
                same[b]++;
        }
    }
    return GLINT_OK;
}

static glint_status find_curved(model *m, glint_error *error)
{
    for (int s = 0; s < m->n_spans; s++) {
        model_span *span = &m->spans[s];
        const int *same = m->same_band + (size_t)span->material * (size_t)m->n_bands;
        const glint_status status =
            curved_span_make(&m->polygons, span->first, span->n, m->materials[span->material].bands,
                             same, m->n_bands, &span->curved, error);
        if (status) return status;
    }
    return GLINT_OK;
}

/* Shapes of the lobes of every material in every band. */
static glint_status find_shapes(model *m, glint_error *error)
{
    const size_t n = (size_t)m->n_materials * (size_t)m->n_bands;
    int n_lobes = 0;
    m->first_shape = calloc(n + 1, sizeof *m->first_shape);
    if (!m->first_shape) return error_no_memory(error);
    for (size_t k = 0; k < n; k++) {
        m->first_shape[k] = n_lobes;
        n_lobes += m->materials[k / (size_t)m->n_bands].bands[k % (size_t)m->n_bands].n_lobes;
    }
    m->shapes = calloc((size_t)n_lobes + 1, sizeof *m->shapes);
    if (!m->shapes) return error_no_memory(error);
    for (size_t k = 0; k < n; k++) {
        const brdf_material *band =
            &m->materials[k / (size_t)m->n_bands].bands[k % (size_t)m->n_bands];
        if (m->same_band[k] < (int)(k % (size_t)m->n_bands)) continue;
        for (int j = 0; j < band->n_lobes; j++)
            lobe_shape_find(&band->lobes[j], &m->shapes[m->first_shape[k] + j]);
    }
    return GLINT_OK;
}

static void assert_indices(const facet_list *facets, int n_materials, int n_components)
{
    for (int k = 0; k < facets->n; k++) {
        assert(facets->items[k].material >= 0 && facets->items[k].material < n_materials);
        assert(facets->items[k].component >= 0 && facets->items[k].component < n_components);
    }
    (void)facets, (void)n_materials, (void)n_components;
}

glint_status model_compile(facet_list *facets, const model_material *materials, int n_materials,
                           const model_component *components, int n_components, int n_bands,
                           model *out, glint_error *error)
{
    *out = (model){0};
    if (facets->n == 0)
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "the model has no facets; expected at least one primitive");
    *out = (model){.n_materials = n_materials,
                   .n_components = n_components,
                   .n_bands = n_bands,
                   .n_facets = facets->n,
                   .materials = materials,
                   .components = components};
    assert_indices(facets, n_materials, n_components);
    glint_status status = sort_facets(facets, n_materials, n_components, &out->polygons, error);
    if (!status) status = fill_arrays(out, error);
    if (!status) status = make_spans(out, error);
    if (!status) status = find_same_bands(out, error);
    if (!status) status = find_shapes(out, error);
    if (!status) status = find_curved(out, error);
    if (status)
        model_free(out);
    else
        facet_list_free(facets);
    return status;
}

void model_free(model *m)
{
    if (!m) return;
    for (int s = 0; s < m->n_spans; s++)
        curved_span_free(m->spans[s].curved);
    free(m->spans);
    free(m->arrays);
    free(m->same_band);
    free(m->first_shape);
    free(m->shapes);
    facet_list_free(&m->polygons);
    *m = (model){0};
}

/* --- the sum --- */

void model_sum(const model *m, const brdf_light *lights, const source_disc *disc,
               const double *visible, double *x)
{
    const size_t band_size = (size_t)m->n_spans * BRDF_TILE;
    for (int s = 0; s < m->n_spans; s++) {
        const model_span *span = &m->spans[s];
        const brdf_material *bands = m->materials[span->material].bands;
        const size_t first_band = (size_t)span->material * (size_t)m->n_bands;
        const int *same = m->same_band + first_band;
        const double *seen = visible ? visible + (size_t)span->first * BRDF_TILE : NULL;
        double *sum = x + (size_t)s * BRDF_TILE;
        for (int b = 0; b < m->n_bands; b++, sum += band_size) {
            if (same[b] < b) {
                memcpy(sum, sum - (size_t)(b - same[b]) * band_size, BRDF_TILE * sizeof *sum);
                continue;
            }
            memset(sum, 0, BRDF_TILE * sizeof *sum);
            const brdf_light *light = &lights[span->component];
            if (span->curved || disc)
                lobe_tile(span->curved, b, &bands[b],
                          m->shapes + m->first_shape[first_band + (size_t)b], &span->facets, light,
                          disc, seen, sum);
            else
                brdf_material_tile(&bands[b], &span->facets, light, seen, sum);
        }
    }
}

double model_material_area(const model *m, int material, int *n_facets)
{
    double area_m2 = 0.0;
    int n = 0;
    for (int s = 0; s < m->n_spans; s++) {
        if (m->spans[s].material != material) continue;
        n += m->spans[s].n;
        for (int k = 0; k < m->spans[s].n; k++)
            area_m2 += m->spans[s].facets.area[k];
    }
    if (n_facets) *n_facets = n;
    return area_m2;
}
