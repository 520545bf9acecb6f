/* Geometry of a component in numbers: area, bounding box, and whether it is closed. */
#include "base/vec.h"
#include "facets/model.h"

#include <assert.h>
#include <stdint.h>
#include <stdlib.h>

#define SAME_VERTEX_M 1e-9 /* vertices nearer than this are one, m */
/* Edge of a cell of the grid that vertices are looked up in, m: many times SAME_VERTEX_M, so that
 * few look-ups touch a second cell; so small that a cell seldom holds two vertices. */
#define CELL_M 1e-7

/* Numbers for vertices, the same for those that are one. Open addressing: a slot holds a vertex
 * that was given a number of its own, or -1. */
typedef struct vertex_table {
    const double (*vertices)[3]; /* borrowed */
    int *slots;                  /* owned; mask + 1 of them, more than twice the vertices */
    size_t mask;
} vertex_table;

static size_t slot_of(const vertex_table *t, const int64_t cell[3])
{
    /* Each coordinate is spread over all bits by an odd multiplier (the fractional digits of the
     * golden ratio, of sqrt 2 and of sqrt 3), then the high bits are folded on the low ones. */
    uint64_t h = (uint64_t)cell[0] * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 32)) + (uint64_t)cell[1] * 0x6a09e667f3bcc909u;
    h = (h ^ (h >> 29)) + (uint64_t)cell[2] * 0xbb67ae8584caa73bu;
    h = (h ^ (h >> 32)) * 0x9e3779b97f4a7c15u;
    return (size_t)(h ^ (h >> 32)) & t->mask;
}

/* The vertex in the chain of a cell that is the same as vertex v, or -1; *end is the free slot that
 * ends the chain. */
static int find_in_cell(const vertex_table *t, const int64_t cell[3], int v, size_t *end)
{
    size_t slot = slot_of(t, cell);
    for (; t->slots[slot] >= 0; slot = (slot + 1) & t->mask) {
        double d[3];
        sub3(t->vertices[t->slots[slot]], t->vertices[v], d);
        if (dot3(d, d) <= SAME_VERTEX_M * SAME_VERTEX_M) return t->slots[slot];
    }
    *end = slot;
    return -1;
}

static int64_t cell_of(double x_m)
{
    return (int64_t)floor(x_m / CELL_M);
}

/* The number of vertex v: that of an earlier one at its place, else its own, which is recorded.
 * Looks in all cells that come within SAME_VERTEX_M of it, its own one last. */
static int number_vertex(vertex_table *t, int v)
{
    const double *p = t->vertices[v];
    int64_t own[3], other[3], cell[3];
    for (int j = 0; j < 3; j++) {
        const int64_t below = cell_of(p[j] - SAME_VERTEX_M), above = cell_of(p[j] + SAME_VERTEX_M);
        own[j] = cell_of(p[j]);
        other[j] = below != own[j] ? below : above;
    }
    size_t end = 0;
    for (int corner = 7; corner >= 0; corner--) {
        bool repeated = false;
        for (int j = 0; j < 3; j++) {
            const bool aside = corner >> j & 1;
            repeated |= aside && other[j] == own[j];
            cell[j] = aside ? other[j] : own[j];
        }
        if (repeated) continue;
        const int found = find_in_cell(t, cell, v, &end);
        if (found >= 0) return found;
    }
    t->slots[end] = v;
    return v;
}

/* Numbers for n vertices. */
static glint_status number_vertices(const double (*vertices)[3], int n, int *numbers,
                                    glint_error *error)
{
    size_t size = 16;
    while (size <= 2 * (size_t)n)
        size *= 2;
    vertex_table t = {vertices, malloc(size * sizeof *t.slots), size - 1};
    if (!t.slots) return error_no_memory(error);
    for (size_t k = 0; k < size; k++)
        t.slots[k] = -1;
    for (int v = 0; v < n; v++)
        numbers[v] = number_vertex(&t, v);
    free(t.slots);
    return GLINT_OK;
}

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

/* Writes the codes of all edges of the facets; returns how many. Edges shorter than SAME_VERTEX_M
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
        status = number_vertices(polygons->vertices + items->first_vertex, n, numbers, error);
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
