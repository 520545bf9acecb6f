/* Interpolated shadows: some rows of a tile are nodes, for which fractions are exact; those of the
 * rows between two nodes are interpolated by how far everything has moved. A tile's first and last
 * bright row are nodes, and tiles are the same on any number of threads: so are the fractions. */
#include "lightcurve/shadows.h"

#include "base/vec.h"

#include <math.h>

static glint_status fill_exactly(const glint_scenario *s, tile_worker *w, int lane,
                                 glint_error *error)
{
    const size_t first = (size_t)lane * (size_t)s->satellite.n_components;
    return visibility_fill(w->plan, w->scratch, w->geometry.poses + first, w->tile.sun[lane],
                           w->tile.observer[lane], lane, w->visible, error);
}

static int list_bright(const tile_geometry *t, int lanes[TILE])
{
    int n = 0;
    for (int k = 0; k < t->n; k++)
        if (t->seen[k] && t->sun_weight[k] > 0) lanes[n++] = k;
    return n;
}

/* Angle of the rotation that takes one orientation to another, rad: the elements of their
 * difference have squares that add to 8 sin^2 of half of it. */
static double turn_between(const double a[9], const double b[9])
{
    double sum = 0;
    for (int j = 0; j < 9; j++)
        sum += (a[j] - b[j]) * (a[j] - b[j]);
    return 2 * asin(fmin(1, sqrt(sum / 8)));
}

/* How far things move from one lane to another, rad: no direction moves by more, seen from any
 * component, and no component by more, seen from another (twice as much). */
static double motion_between(const glint_scenario *s, const tile_worker *w, int from, int to)
{
    const tile_geometry *t = &w->tile;
    const size_t n = (size_t)s->satellite.n_components;
    double most = 0;
    for (size_t c = 0; c < n; c++)
        most = fmax(most, turn_between(w->geometry.poses[(size_t)from * n + c].body_component,
                                       w->geometry.poses[(size_t)to * n + c].body_component));
    return most +
           fmax(angle3(t->sun[from], t->sun[to]), angle3(t->observer[from], t->observer[to]));
}

/* Lanes and the way that everything has gone since the first of them, rad. */
typedef struct track {
    int n, lanes[TILE];
    double way[TILE];
} track;

static bool is_turned_to_both(const brdf_facets *facets, int k, const brdf_light *light, int lane)
{
    double ci = 0, cr = 0;
    for (int j = 0; j < 3; j++) {
        ci += facets->normal[j][k] * light->i[j][lane];
        cr += facets->normal[j][k] * light->r[j][lane];
    }
    return ci > BRDF_EDGE && cr > BRDF_EDGE;
}

/* The lanes of one facet between two nodes. A facet that is turned away at a node has no fraction
 * there: that of the other node holds, or else it is taken as whole: it is so nearly edge-on then
 * that it hardly shines. */
static void interpolate_facet(const track *t, int first, int last, const brdf_facets *facets, int k,
                              const brdf_light *light, double *visible)
{
    const double from = visible[t->lanes[first]], to = visible[t->lanes[last]];
    const double way = t->way[last] - t->way[first];
    const bool from_counts = is_turned_to_both(facets, k, light, t->lanes[first]);
    const bool to_counts = is_turned_to_both(facets, k, light, t->lanes[last]);
    for (int j = first + 1; j < last; j++) {
        const double weight = way > 0 ? (t->way[j] - t->way[first]) / way : 0;
        double fraction = from_counts ? from : to_counts ? to : 1;
        if (from_counts && to_counts) fraction = from + weight * (to - from);
        visible[t->lanes[j]] = is_turned_to_both(facets, k, light, t->lanes[j]) ? fraction : 0;
    }
}

static void interpolate(const model *m, tile_worker *w, const track *t, int first, int last)
{
    if (last - first < 2) return;
    for (int s = 0; s < m->n_spans; s++) {
        const model_span *span = &m->spans[s];
        for (int k = 0; k < span->n; k++)
            interpolate_facet(t, first, last, &span->facets, k, &w->lights[span->component],
                              w->visible + (size_t)(span->first + k) * TILE);
    }
}

static glint_status fill_interpolated(const glint_scenario *s, tile_worker *w, track *t,
                                      glint_error *error)
{
    t->way[0] = 0;
    for (int k = 1; k < t->n; k++)
        t->way[k] = t->way[k - 1] + motion_between(s, w, t->lanes[k - 1], t->lanes[k]);
    glint_status status = fill_exactly(s, w, t->lanes[0], error);
    for (int first = 0, last; first < t->n - 1 && !status; first = last) {
        last = first + 1;
        while (last < t->n - 1 && t->way[last + 1] - t->way[first] <= s->shadow_step)
            last++;
        status = fill_exactly(s, w, t->lanes[last], error);
        if (!status) interpolate(&s->satellite.model, w, t, first, last);
    }
    return status;
}

glint_status shadows_fill(const glint_scenario *s, tile_worker *w, glint_error *error)
{
    track t;
    glint_status status = GLINT_OK;
    t.n = list_bright(&w->tile, t.lanes);
    if (t.n > 0 && s->self_shadows == SHADOWS_INTERPOLATED)
        return fill_interpolated(s, w, &t, error);
    for (int k = 0; k < t.n && !status; k++)
        status = fill_exactly(s, w, t.lanes[k], error);
    return status;
}
