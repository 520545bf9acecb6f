#include "facets/visibility_fans.h"

#include <stdlib.h>

/* The edges that end at each vertex. */
typedef struct spokes {
    int *first; /* owned; n_vertices + 1 */
    int *edges; /* owned */
} spokes;

static bool find_spokes(const solids *s, spokes *out)
{
    const size_t n = (size_t)s->n_vertices;
    out->first = calloc(n + 2, sizeof *out->first);
    out->edges = malloc((2 * (size_t)s->n_edges + 1) * sizeof *out->edges);
    if (!out->first || !out->edges) return false;
    for (int round = 0; round < 2; round++) {
        for (int k = 0; k < s->n; k++) {
            const solid *body = &s->items[k];
            if (body->kind == SOLID_CONVEX || body->kind == SOLID_SHEET) continue;
            for (int e = body->first_edge; e < body->first_edge + body->n_edges; e++) {
                const int ends[2] = {s->edges[e].from, s->edges[e].to};
                for (int end = 0; end < 2; end++) {
                    /* First the numbers are counted, two places further on; then each vertex's
                     * place is where the next edge goes, and ends up where those of the next begin.
                     */
                    if (round == 0)
                        out->first[ends[end] + 2]++;
                    else
                        out->edges[out->first[ends[end] + 1]++] = e;
                }
            }
        }
        for (size_t v = 2; round == 0 && v < n + 2; v++)
            out->first[v] += out->first[v - 1];
    }
    return true;
}

/* The facet beside `facet` on the other side of one of n edges at a vertex, not `*edge`, which
 * becomes that edge. -1 where there is none. */
static int next_facet(const solids *s, const int *edges, int n, int facet_index, int *edge)
{
    for (int k = 0; k < n; k++) {
        const solid_edge *e = &s->edges[edges[k]];
        if (edges[k] == *edge || (e->left != facet_index && e->right != facet_index)) continue;
        *edge = edges[k];
        return e->left == facet_index ? e->right : e->left;
    }
    return -1;
}

/* Walks around a vertex of n edges; true when all its facets follow each other. They are written to
 * `out`. */
static bool walk_around(const solids *s, const int *edges, int n, int *out)
{
    int edge = edges[0], at = s->edges[edge].left, count = 0;
    const int start = at;
    do {
        out[count++] = at;
        at = next_facet(s, edges, n, at, &edge);
    } while (at >= 0 && at != start && count < n);
    return at == start && count == n;
}

glint_status fans_find(const solids *s, fans *out, glint_error *error)
{
    spokes around = {0};
    *out = (fans){0};
    out->first = malloc(((size_t)s->n_vertices + 1) * sizeof *out->first);
    out->facets = malloc((2 * (size_t)s->n_edges + 1) * sizeof *out->facets);
    const bool ok = out->first && out->facets && find_spokes(s, &around);
    for (int v = 0; ok && v < s->n_vertices; v++) {
        const int n = around.first[v + 1] - around.first[v];
        out->first[v] = out->n_facets;
        if (n > 0 && walk_around(s, around.edges + around.first[v], n, out->facets + out->n_facets))
            out->n_facets += n;
    }
    if (ok) out->first[s->n_vertices] = out->n_facets;
    free(around.first);
    free(around.edges);
    if (!ok) fans_free(out);
    return ok ? GLINT_OK : error_no_memory(error);
}

void fans_free(fans *f)
{
    if (!f) return;
    free(f->first);
    free(f->facets);
    *f = (fans){0};
}
