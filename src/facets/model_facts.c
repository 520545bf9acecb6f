/* Geometry of a component in numbers: area, bounding box, and whether it is closed. */
#include "base/vec.h"
#include "facets/model.h"
#include "facets/weld.h"

#include <assert.h>
#include <stdint.h>
#include <stdlib.h>

/* An edge as one number to sort by: the smaller and the larger vertex, then the sense. */
static uint64_t edge_code(int from, int to)
{
    const uint64_t low = (uint64_t)(from < to ? from : to),
                   high = (uint64_t)(from < to ? to : from);
    return low << 32 | high << 1 | (from < to);
}

static int compare_codes(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Writes the codes of all edges of the facets; returns how many. Edges shorter than WELD_SAME_M
 * are points and are left out. */
static size_t list_edges(const facet *items, int n_facets, const int *numbers, uint64_t *codes)
{
    size_t n = 0;
    for (int k = 0; k < n_facets; k++) {
        const int *ring = numbers + (items[k].first_vertex - items[0].first_vertex);
        for (int v = 0; v < items[k].n_vertices; v++) {
            const int from = ring[v], to = ring[(v + 1) % items[k].n_vertices];
            if (from != to) codes[n++] = edge_code(from, to);
        }
    }
    return n;
}

/* Number of different edges that are not run through as often one way as the other. */
static int count_open(uint64_t *codes, size_t n)
{
    qsort(codes, n, sizeof *codes, compare_codes);
    int open = 0;
    for (size_t k = 0; k < n;) {
        const uint64_t edge = codes[k] >> 1;
        long balance = 0;
        for (; k < n && codes[k] >> 1 == edge; k++)
            balance += codes[k] & 1 ? 1 : -1;
        open += balance != 0;
    }
    return open;
}

static glint_status count_open_edges(const facet_list *polygons, int first, int n_facets,
                                     int *n_open, glint_error *error)
{
    const facet *items = polygons->items + first;
    const facet *last = items + n_facets - 1;
    const int n = last->first_vertex + last->n_vertices - items->first_vertex;
    int *numbers = malloc((size_t)n * sizeof *numbers);
    uint64_t *codes = malloc((size_t)n * sizeof *codes);
    glint_status status = GLINT_OK;
    if (!numbers || !codes)
        status = error_no_memory(error);
    else
        status = weld_vertices(polygons->vertices + items->first_vertex, n, numbers, error);
    if (!status) *n_open = count_open(codes, list_edges(items, n_facets, numbers, codes));
    free(numbers);
    free(codes);
    return status;
}

/* Facets of a component lie side by side: *first of them, and how many. */
static int component_facets(const model *m, int c, int *first)
{
    int n = 0;
    *first = 0;
    for (int s = 0; s < m->n_spans; s++) {
        if (m->spans[s].component != c) continue;
        if (n == 0) *first = m->spans[s].first;
        n += m->spans[s].n;
    }
    return n;
}

glint_status model_component_describe(const model *m, int c, model_component_facts *out,
                                      glint_error *error)
{
    assert(c >= 0 && c < m->n_components);
    int first;
    const int n = component_facets(m, c, &first);
    *out = (model_component_facts){.n_facets = n};
    if (n == 0) return GLINT_OK;
    copy3(m->polygons.vertices[m->polygons.items[first].first_vertex], out->lo_m);
    copy3(out->lo_m, out->hi_m);
    for (int k = first; k < first + n; k++) {
        const facet *f = &m->polygons.items[k];
        out->area_m2 += f->area_m2;
        for (int v = 0; v < f->n_vertices; v++)
            for (int j = 0; j < 3; j++) {
                const double x_m = m->polygons.vertices[f->first_vertex + v][j];
                out->lo_m[j] = fmin(out->lo_m[j], x_m);
                out->hi_m[j] = fmax(out->hi_m[j], x_m);
            }
    }
    const glint_status status = count_open_edges(&m->polygons, first, n, &out->n_open_edges, error);
    out->closed = !status && out->n_open_edges == 0;
    return status;
}
