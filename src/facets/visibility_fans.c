#include "facets/visibility_fans.h"

#include "base/vec.h"

#include <math.h>
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
 * becomes that edge. Edges that are -1 are done with. -1 where there is none. */
static int next_facet(const solids *s, const int *edges, int n, int facet_index, int *edge)
{
    for (int k = 0; k < n; k++) {
        const solid_edge *e = &s->edges[edges[k]];
        if (edges[k] < 0 || edges[k] == *edge ||
            (e->left != facet_index && e->right != facet_index))
            continue;
        *edge = edges[k];
        return e->left == facet_index ? e->right : e->left;
    }
    return -1;
}

/* Walks around a vertex of n edges from one of them; returns how many facets follow each other
 * until the first comes again, 0 where it does not. They are written to `out`, which has room for
 * as many as there are edges left; those that are passed are -1 afterwards. */
static int walk_around(const solids *s, int *edges, int n, int from, int *out)
{
    int edge = edges[from], at = s->edges[edge].left, count = 0, n_left = 0;
    const int start = at;
    for (int k = 0; k < n; k++)
        n_left += edges[k] >= 0;
    do {
        out[count++] = at;
        at = next_facet(s, edges, n, at, &edge);
    } while (at >= 0 && at != start && count < n_left);
    for (int k = 0; k < n; k++)
        for (int j = 0; j < count && edges[k] >= 0; j++)
            if (s->edges[edges[k]].left == out[j] || s->edges[edges[k]].right == out[j])
                edges[k] = -1;
    return at == start ? count : 0;
}

/* --- how often a fan winds --- */

/* Cosine up to which a blade counts as edge-on, and the tries to find a side from which none is. */
#define EDGE_ON 1e-6
enum { MOST_TRIES = 32 };

/* Finds a direction (not zero) from which n facets are all turned to the one who looks: the sum of
 * their normals, to which that of the facet that is turned away most is added until none is
 * (Rosenblatt 1958, Psychological Review 65(6) 386). False where there seems to be none. */
static bool find_side(const model *m, const int *facets, int n, double towards[3])
{
    const facet *items = m->polygons.items;
    copy3((const double[3]){0, 0, 0}, towards);
    for (int k = 0; k < n; k++)
        add3(towards, items[facets[k]].normal, towards);
    for (int round = 0; round < MOST_TRIES; round++) {
        const double edge_on = EDGE_ON * norm3(towards);
        double least = INFINITY;
        int worst = 0;
        for (int k = 0; k < n; k++) {
            const double cosine = dot3(items[facets[k]].normal, towards);
            if (cosine < least) least = cosine, worst = k;
        }
        if (least > edge_on) return true;
        add3(towards, items[facets[worst]].normal, towards);
    }
    return false;
}

/* The vertices before and after a vertex on a facet; false where the facet, thin as a hair, comes
 * to it more than once. */
static bool find_neighbours(const model *m, const solids *s, int facet_index, int vertex,
                            int *before, int *after)
{
    const facet *f = &m->polygons.items[facet_index];
    const int *ring = s->corners + f->first_vertex;
    int n_before = 0, n_after = 0;
    for (int k = 0; k < f->n_vertices; k++) {
        const int from = ring[k], to = ring[k + 1 < f->n_vertices ? k + 1 : 0];
        if (from == to) continue;
        if (to == vertex) *before = from, n_before++;
        if (from == vertex) *after = to, n_after++;
    }
    return n_before == 1 && n_after == 1;
}

/* Whether n facets that follow each other around a vertex go around it once: those that go around
 * twice come before each other. Seen from where all are turned to the one who looks, each turns
 * left by less than half a turn: counted are those that turn across one half of a line. */
static bool winds_once(const model *m, const solids *s, int vertex, const int *facets, int n)
{
    double towards[3], across[3];
    if (!find_side(m, facets, n, towards)) return false; /* it is never open, or hardly ever */
    unit3(towards, towards);
    const double axis[3] = {fabs(towards[0]) < 0.5, fabs(towards[0]) >= 0.5, 0};
    perp3(axis, towards, across);
    const double at_m = dot3(across, s->vertices[vertex]);
    int turns = 0;
    for (int k = 0; k < n; k++) {
        int before = vertex, after = vertex;
        if (!find_neighbours(m, s, facets[k], vertex, &before, &after)) return false;
        turns +=
            dot3(across, s->vertices[after]) < at_m && dot3(across, s->vertices[before]) >= at_m;
    }
    return turns == 1;
}

/* --- all fans --- */

/* Appends the fan of n facets around a vertex that stands behind the others. */
static void add_fan(const model *m, const solids *s, int vertex, int n, fans *out)
{
    const int first = out->first[out->n];
    for (int k = first; k < first + n; k++) {
        const facet *f = &m->polygons.items[out->facets[k]];
        for (int c = f->first_vertex; c < f->first_vertex + f->n_vertices; c++)
            if (s->corners[c] == vertex) out->at_corner[c] = out->n;
    }
    out->first[++out->n] = first + n;
}

glint_status fans_find(const model *m, const solids *s, fans *out, glint_error *error)
{
    spokes around = {0};
    const size_t n_ends = 2 * (size_t)s->n_edges, n_corners = (size_t)m->polygons.n_vertices;
    *out = (fans){0};
    out->first = malloc((n_ends + 1) * sizeof *out->first);
    out->facets = malloc((n_ends + 1) * sizeof *out->facets);
    out->at_corner = malloc(n_corners * sizeof *out->at_corner);
    const bool ok = out->first && out->facets && out->at_corner && find_spokes(s, &around);
    for (size_t c = 0; ok && c < n_corners; c++)
        out->at_corner[c] = -1;
    if (ok) out->first[0] = 0;
    for (int v = 0; ok && v < s->n_vertices; v++) {
        int *const edges = around.edges + around.first[v];
        const int n = around.first[v + 1] - around.first[v];
        for (int k = 0; k < n; k++) {
            if (edges[k] < 0) continue;
            int *const facets = out->facets + out->first[out->n];
            const int count = walk_around(s, edges, n, k, facets);
            if (count > 0 && winds_once(m, s, v, facets, count)) add_fan(m, s, v, count, out);
        }
    }
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
    free(f->at_corner);
    *f = (fans){0};
}
