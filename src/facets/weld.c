#include "facets/weld.h"

#include "base/vec.h"

#include <stdint.h>
#include <stdlib.h>

/* Edge of a cell of the grid that vertices are looked up in, over the distance within which they
 * are one: large, so that few look-ups touch a second cell; so small that a cell seldom holds two.
 */
#define CELL 100.0

/* Numbers for vertices, the same for those that are one. Open addressing: a slot holds a vertex
 * that was given a number of its own, or -1. */
typedef struct vertex_table {
    const double (*vertices)[3]; /* borrowed */
    double same_m;
    int *slots; /* owned; mask + 1 of them, more than twice the vertices */
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
        if (dot3(d, d) <= t->same_m * t->same_m) return t->slots[slot];
    }
    *end = slot;
    return -1;
}

static int64_t cell_of(const vertex_table *t, double x_m)
{
    return (int64_t)floor(x_m / (CELL * t->same_m));
}

/* The number of vertex v: that of an earlier one at its place, else its own, which is recorded.
 * Looks in all cells that come so near to it, its own one last. */
static int number_vertex(vertex_table *t, int v)
{
    const double *p = t->vertices[v];
    int64_t own[3], other[3], cell[3];
    for (int j = 0; j < 3; j++) {
        const int64_t below = cell_of(t, p[j] - t->same_m), above = cell_of(t, p[j] + t->same_m);
        own[j] = cell_of(t, p[j]);
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

glint_status weld_vertices(const double (*vertices)[3], int n, int *numbers, glint_error *error)
{
    return weld_vertices_within(vertices, n, WELD_SAME_M, numbers, error);
}

glint_status weld_vertices_within(const double (*vertices)[3], int n, double same_m, int *numbers,
                                  glint_error *error)
{
    size_t size = 16;
    while (size <= 2 * (size_t)n)
        size *= 2;
    vertex_table t = {vertices, same_m, malloc(size * sizeof *t.slots), size - 1};
    if (!t.slots) return error_no_memory(error);
    for (size_t k = 0; k < size; k++)
        t.slots[k] = -1;
    for (int v = 0; v < n; v++)
        numbers[v] = number_vertex(&t, v);
    free(t.slots);
    return GLINT_OK;
}
