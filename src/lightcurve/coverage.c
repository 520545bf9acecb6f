#include "lightcurve/coverage.h"

#include "base/vec.h"
#include "brdf/table.h"

#include <stdlib.h>
#include <string.h>

/* A measured lobe that has a weight and does not cover the hemisphere. */
static bool is_watched(const brdf_lobe *lobe)
{
    if (!(lobe->model->flags & BRDF_MEASURED) || lobe->weight == 0.0) return false;
    table_facts facts;
    table_describe(lobe, &facts);
    return !facts.whole;
}

/* The lobes of material m in all bands that differ; false when memory is out. */
static bool find_lobes(const satellite *sat, int m, int n_bands, coverage_material *out)
{
    const brdf_material *bands = sat->materials[m].bands;
    const int *same = sat->model.same_band + (size_t)m * (size_t)n_bands;
    size_t most = 1;
    for (int b = 0; b < n_bands; b++)
        most += (size_t)bands[b].n_lobes;
    *out = (coverage_material){.material = m, .lobes = malloc(most * sizeof *out->lobes)};
    if (!out->lobes) return false;
    for (int b = 0; b < n_bands; b++)
        for (int l = 0; l < bands[b].n_lobes && same[b] == b; l++)
            if (is_watched(&bands[b].lobes[l])) out->lobes[out->n_lobes++] = &bands[b].lobes[l];
    return true;
}

glint_status coverage_make(const satellite *sat, int n_bands, coverage *out, glint_error *error)
{
    *out = (coverage){.sat = sat};
    out->items = malloc(((size_t)sat->n_materials + 1) * sizeof *out->items);
    if (!out->items) return error_no_memory(error);
    for (int m = 0; m < sat->n_materials; m++) {
        coverage_material *next = &out->items[out->n];
        if (!find_lobes(sat, m, n_bands, next)) return error_no_memory(error);
        if (next->n_lobes > 0)
            out->n++;
        else
            free(next->lobes);
    }
    return GLINT_OK;
}

void coverage_free(coverage *c)
{
    for (int k = 0; k < c->n; k++)
        free(c->items[k].lobes);
    free(c->items);
    *c = (coverage){0};
}

/* Whether all lobes cover a pair of directions (facet frame). */
static bool covers(const coverage_material *item, const double i[3], const double r[3])
{
    for (int l = 0; l < item->n_lobes; l++)
        if (!table_covers(item->lobes[l], i, r)) return false;
    return true;
}

/* A direction of lane k in the frame of facet f: tangent, bitangent, normal. */
static void into_facet(const brdf_facets *facets, int f, const double v[3][BRDF_TILE], int k,
                       double out[3])
{
    const double given[3] = {v[0][k], v[1][k], v[2][k]};
    const double frame[9] = {
        facets->tangent[0][f],   facets->tangent[1][f],   facets->tangent[2][f],
        facets->bitangent[0][f], facets->bitangent[1][f], facets->bitangent[2][f],
        facets->normal[0][f],    facets->normal[1][f],    facets->normal[2][f]};
    mat_vec(frame, given, out);
}

/* Whether a facet of the span is lit, seen and not covered in lane k. */
static bool is_outside(const coverage_material *item, const model_span *span, const tile_worker *w,
                       int k)
{
    const brdf_light *light = &w->lights[span->component];
    for (int f = 0; f < span->n; f++) {
        if (w->visible && !(w->visible[(size_t)(span->first + f) * TILE + (size_t)k] > 0.0))
            continue;
        double i[3], r[3];
        into_facet(&span->facets, f, light->i, k, i);
        into_facet(&span->facets, f, light->r, k, r);
        if (i[2] > BRDF_EDGE && r[2] > BRDF_EDGE && !covers(item, i, r)) return true;
    }
    return false;
}

void coverage_mark(const coverage *c, const tile_worker *w, unsigned char *outside)
{
    const model *m = &c->sat->model;
    memset(outside, 0, (size_t)w->tile.n * (size_t)c->n);
    for (int j = 0; j < c->n; j++)
        for (int s = 0; s < m->n_spans; s++) {
            if (m->spans[s].material != c->items[j].material) continue;
            for (int k = 0; k < w->tile.n; k++) {
                unsigned char *mark = &outside[(size_t)k * (size_t)c->n + (size_t)j];
                const bool bright = w->tile.seen[k] && w->tile.sun_weight[k] > 0.0;
                if (bright && !*mark) *mark = is_outside(&c->items[j], &m->spans[s], w, k);
            }
        }
}
