/* tile.h: builds, from a model's one formula, the two faces of brdf_model: brdf_eval and brdf_tile.
 *
 * A model's file defines BRDF_LANE as the name of its formula
 *
 *     static inline double formula(const double *coef, const brdf_lane *lane);
 *
 * which returns g = f ci cr (1/sr) of one pair of directions from the coefficients of `prepare`,
 * and then includes this file; if the model keeps its numbers in the lobe (prepare_lobe), it also
 * defines BRDF_LONG_COEF. The formula must be finite wherever ci > BRDF_EDGE and cr >
 * BRDF_EDGE; elsewhere it may return anything, but must not trap. What it does not read of the lane
 * costs nothing: after inlining the compiler drops it.
 *
 * The kernel takes one facet after another, and for each a whole tile of directions, which the
 * compiler turns into vectors. Each lane adds its facets in their order, so that a result never
 * depends on how the work is shared among threads. */
#ifndef BRDF_LANE
#error "define BRDF_LANE, the name of the model's formula, before including tile.h"
#endif
#ifndef GLINT_BRDF_TILE_H
#define GLINT_BRDF_TILE_H

#include "base/clones.h"
#include "brdf/lane.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* BRDF_NO_CLONES: for tests that need one version alone. */
#if defined(BRDF_NO_CLONES)
#define BRDF_CLONES
#else
#define BRDF_CLONES CLONES
#endif

/* In place of the kind of a watch: there is none. */
#define WATCH_NOTHING (-1)

/* What tile_cosines tells of a facet: bit k, that lane k is one to show; and this one, that some
 * pair is on its front. */
#define TILE_LIT ((int64_t)1 << BRDF_TILE)

#define TILE_BITS(k) 1ll << (k), 2ll << (k), 4ll << (k), 8ll << (k)
/* In a table, as compilers do not put shifts by a counter into vector code. */
static const int64_t TILE_BIT[BRDF_TILE] = {TILE_BITS(0),  TILE_BITS(4),  TILE_BITS(8),
                                            TILE_BITS(12), TILE_BITS(16), TILE_BITS(20),
                                            TILE_BITS(24), TILE_BITS(28)};

/* The cosines of a tile's directions to facet f, and what they mean. kind: of facets->watch, known
 * to the compiler. */
static inline int64_t tile_cosines(const brdf_facets *facets, int f, const brdf_light *light,
                                   int kind, double ci[BRDF_TILE], double cr[BRDF_TILE])
{
    const double n0 = facets->normal[0][f], n1 = facets->normal[1][f], n2 = facets->normal[2][f];
    const brdf_watch *const watch = facets->watch;
    int64_t seen = 0;
    for (int k = 0; k < BRDF_TILE; k++) {
        ci[k] = n0 * light->i[0][k] + n1 * light->i[1][k] + n2 * light->i[2][k];
        cr[k] = n0 * light->r[0][k] + n1 * light->r[1][k] + n2 * light->r[2][k];
        int64_t here = ci[k] > BRDF_EDGE ? TILE_LIT : 0;
        if (kind >= BRDF_WATCH_SOURCE) here |= fabs(ci[k]) < watch->low[k] ? TILE_BIT[k] : 0;
        if (kind >= BRDF_WATCH_LOBE) here |= ci[k] + cr[k] > watch->near[k] ? TILE_BIT[k] : 0;
        if (kind >= BRDF_WATCH_WINGS)
            here |= fabs(ci[k]) + cr[k] < watch->graze[k] ? TILE_BIT[k] : 0;
        seen |= cr[k] > BRDF_EDGE ? here : 0;
    }
    return seen;
}

#endif

static double brdf_eval(const double *coef, const double i[3], const double r[3])
{
    if (!(i[2] > BRDF_EDGE && r[2] > BRDF_EDGE)) return 0.0;
    brdf_lane l = {.ci = i[2], .cr = r[2], .it = i[0], .ib = i[1], .rt = r[0], .rb = r[1]};
    l.ht = l.it + l.rt;
    l.hb = l.ib + l.rb;
    l.hn = l.ci + l.cr;
    l.hh = l.ht * l.ht + l.hb * l.hb + l.hn * l.hn;
    l.hlen = sqrt(l.hh);
    return BRDF_LANE(coef, &l);
}

/* Adds facet f to the lanes' totals: scale[k] g. The facet's numbers are read into locals first,
 * since the compiler cannot know that the totals do not lie among them. */
static inline void brdf_tile_add(const double *coef, const brdf_facets *facets, int f,
                                 const brdf_light *light, const double ci[BRDF_TILE],
                                 const double cr[BRDF_TILE], const double scale[BRDF_TILE],
                                 double total[BRDF_TILE])
{
    const double t0 = facets->tangent[0][f], t1 = facets->tangent[1][f];
    const double t2 = facets->tangent[2][f], b0 = facets->bitangent[0][f];
    const double b1 = facets->bitangent[1][f], b2 = facets->bitangent[2][f];
    for (int k = 0; k < BRDF_TILE; k++) {
        const double i0 = light->i[0][k], i1 = light->i[1][k], i2 = light->i[2][k];
        const double r0 = light->r[0][k], r1 = light->r[1][k], r2 = light->r[2][k];
        const double h0 = light->h[0][k], h1 = light->h[1][k], h2 = light->h[2][k];
        const brdf_lane l = {.ci = ci[k],
                             .cr = cr[k],
                             .ht = t0 * h0 + t1 * h1 + t2 * h2,
                             .hb = b0 * h0 + b1 * h1 + b2 * h2,
                             .hn = ci[k] + cr[k],
                             .hh = light->hh[k],
                             .hlen = light->hlen[k],
                             .it = t0 * i0 + t1 * i1 + t2 * i2,
                             .ib = b0 * i0 + b1 * i1 + b2 * i2,
                             .rt = t0 * r0 + t1 * r1 + t2 * r2,
                             .rb = b0 * r0 + b1 * r1 + b2 * r2};
        const double g = scale[k] * BRDF_LANE(coef, &l);
        const bool lit = (ci[k] > BRDF_EDGE) & (cr[k] > BRDF_EDGE);
        total[k] += lit ? g : 0.0;
    }
}

/* Adds all facets to the lanes' totals. kind: as above. */
static inline void brdf_tile_run(const double *coef, double weight, const brdf_facets *facets,
                                 const brdf_light *light, const double *visible, int kind,
                                 double total[BRDF_TILE])
{
    _Alignas(64) double ci[BRDF_TILE], cr[BRDF_TILE], scale[BRDF_TILE];
    for (int f = 0; f < facets->n; f++) {
        const int64_t seen = tile_cosines(facets, f, light, kind, ci, cr);
        const uint32_t shown = kind == WATCH_NOTHING ? 0 : (uint32_t)seen;
        const int64_t taken = shown ? facets->watch->found(facets->watch->finder, f, shown) : 0;
        if (!(seen & TILE_LIT)) continue;
        const double *part = visible ? visible + (size_t)f * BRDF_TILE : NULL;
        const double area = weight * facets->area[f];
        for (int k = 0; k < BRDF_TILE; k++)
            scale[k] = part ? area * part[k] : area;
        for (int k = 0; k < BRDF_TILE && taken; k++)
            scale[k] = taken & TILE_BIT[k] ? 0.0 : scale[k];
        brdf_tile_add(coef, facets, f, light, ci, cr, scale, total);
    }
}

BRDF_CLONES FLATTEN static void brdf_tile(const double *coef, double weight,
                                          const brdf_facets *facets, const brdf_light *light,
                                          const double *visible, double sum[BRDF_TILE])
{
#ifdef BRDF_LONG_COEF
    const double *const c = coef;
#else
    double c[BRDF_MAX_COEF]; /* a copy that nothing else can point at */
    memcpy(c, coef, sizeof c);
#endif
    _Alignas(64) double total[BRDF_TILE] = {0};
    switch (facets->watch ? (int)facets->watch->kind : WATCH_NOTHING) {
    case BRDF_WATCH_SOURCE:
        brdf_tile_run(c, weight, facets, light, visible, BRDF_WATCH_SOURCE, total);
        break;
    case BRDF_WATCH_LOBE:
        brdf_tile_run(c, weight, facets, light, visible, BRDF_WATCH_LOBE, total);
        break;
    case BRDF_WATCH_WINGS:
        brdf_tile_run(c, weight, facets, light, visible, BRDF_WATCH_WINGS, total);
        break;
    default:
        brdf_tile_run(c, weight, facets, light, visible, WATCH_NOTHING, total);
    }
    for (int k = 0; k < BRDF_TILE; k++)
        sum[k] += total[k];
}
