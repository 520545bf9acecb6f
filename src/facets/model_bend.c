/* Imported facets that look like a curve. */
#include "base/vec.h"
#include "facets/model.h"
#include "facets/solids.h"

#include <stdlib.h>

/* An edge between two imported facets of one material, and how much it bends, rad. */
typedef struct bent_edge {
    int material;
    double bend_rad;
} bent_edge;

static int compare_edges(const void *a, const void *b)
{
    const bent_edge *p = a, *q = b;
    if (p->material != q->material) return p->material < q->material ? -1 : 1;
    return (p->bend_rad > q->bend_rad) - (p->bend_rad < q->bend_rad);
}

static bool is_flat_import(const facet *f)
{
    return f->imported && f->surface == 0;
}

static bool has_flat_imports(const model *m)
{
    for (int k = 0; k < m->n_facets; k++)
        if (is_flat_import(&m->polygons.items[k])) return true;
    return false;
}

/* Collects the edges that may belong to a curve; returns how many. */
static int collect_edges(const model *m, const solids *s, bent_edge *out)
{
    static const double PLANE = 1e-4; /* rad */
    int n = 0;
    for (int e = 0; e < s->n_edges; e++) {
        const facet *left = &m->polygons.items[s->edges[e].left];
        const facet *right = &m->polygons.items[s->edges[e].right];
        if (!is_flat_import(left) || !is_flat_import(right) || left->material != right->material)
            continue;
        const double bend_rad = angle3(left->normal, right->normal);
        if (bend_rad > PLANE && bend_rad < MODEL_MOST_BEND_RAD)
            out[n++] = (bent_edge){left->material, bend_rad};
    }
    return n;
}

glint_status model_material_bends(const model *m, double *bends_rad, glint_error *error)
{
    enum { FEWEST = 6 };
    for (int k = 0; k < m->n_materials; k++)
        bends_rad[k] = 0.0;
    if (!has_flat_imports(m)) return GLINT_OK;
    solids s;
    const glint_status status = solids_find(m, &s, error);
    if (status) return status;
    bent_edge *edges = malloc(((size_t)s.n_edges + 1) * sizeof *edges);
    const int n = edges ? collect_edges(m, &s, edges) : 0;
    if (edges) qsort(edges, (size_t)n, sizeof *edges, compare_edges);
    for (int first = 0, end; first < n; first = end) {
        end = first + 1;
        while (end < n && edges[end].material == edges[first].material)
            end++;
        if (end - first >= FEWEST)
            bends_rad[edges[first].material] = edges[first + 3 * (end - first) / 4].bend_rad;
    }
    const bool failed = !edges;
    free(edges);
    solids_free(&s);
    return failed ? error_no_memory(error) : GLINT_OK;
}
