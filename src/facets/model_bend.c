/* Imported facets that look like a curve. */
#include "base/constants.h"
#include "base/vec.h"
#include "facets/model.h"
#include "facets/solids.h"

#include <assert.h>
#include <stdlib.h>

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool is_flat_import(const facet *f, int material)
{
    return f->imported && f->surface == 0 && f->material == material;
}

static bool has_flat_imports(const model *m, int material)
{
    for (int k = 0; k < m->n_facets; k++)
        if (is_flat_import(&m->polygons.items[k], material)) return true;
    return false;
}

glint_status model_material_bend(const model *m, int material, double *bend_rad, glint_error *error)
{
    static const double SHARP = 40 * DEG, PLANE = 1e-4; /* rad */
    enum { FEWEST = 6 };
    assert(material >= 0 && material < m->n_materials);
    *bend_rad = 0.0;
    if (!has_flat_imports(m, material)) return GLINT_OK;
    solids s;
    const glint_status status = solids_find(m, &s, error);
    if (status) return status;
    double *bends = malloc(((size_t)s.n_edges + 1) * sizeof *bends);
    int n = 0;
    for (int e = 0; e < s.n_edges && bends; e++) {
        const facet *left = &m->polygons.items[s.edges[e].left];
        const facet *right = &m->polygons.items[s.edges[e].right];
        if (!is_flat_import(left, material) || !is_flat_import(right, material)) continue;
        const double bend = angle3(left->normal, right->normal);
        if (bend > PLANE && bend < SHARP) bends[n++] = bend;
    }
    if (bends) qsort(bends, (size_t)n, sizeof *bends, compare_numbers);
    if (bends && n >= FEWEST) *bend_rad = bends[3 * n / 4];
    const bool failed = !bends;
    free(bends);
    solids_free(&s);
    return failed ? error_no_memory(error) : GLINT_OK;
}
