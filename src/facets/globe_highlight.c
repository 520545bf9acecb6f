/* globe_highlight.c: what a narrow lobe shows of the globe: its neighbourhood, over bisectors. */
#include "base/constants.h"
#include "base/vec.h"
#include "facets/globe_parts.h"

#include <math.h>
#include <string.h>

/* Where one facet looks, in its own frame t, b, n. */
typedef struct highlight {
    const brdf_lobe *lobe;
    const lobe_shape *shape;
    const brdf_material *ground;
    globe_view view; /* in the facet's frame */
    double r[3];     /* to the observer */
    double area_m2;
    int lane;
    batch *batch;
} highlight;

/* Slopes per unit of the radius; an axis without a lobe is taken as this wide. */
#define WIDEST 1.0

/* The bisector h in slopes x, y over its axes: dw_h = h_n^3 dx dy, and the direction i = 2 (r.h) h
 * - r changes by dw_i = 4 (r.h) dw_h (Torrance and Sparrow 1967). */
static void push_bisector(const highlight *l, double x, double y, double weight)
{
    const double hn = 1.0 / sqrt(1.0 + x * x + y * y), h[3] = {x * hn, y * hn, hn};
    const double u = dot3(l->r, h);
    if (!(u > 0.0)) return;
    double i[3];
    for (int j = 0; j < 3; j++)
        i[j] = 2.0 * u * h[j] - l->r[j];
    if (!(i[2] > BRDF_EDGE)) return;
    const double radiance = globe_radiance(&l->view, l->ground, i);
    if (!(radiance > 0.0)) return;
    batch_push(l->batch, l->lane, i, l->r, 0.0, 0.0,
               l->area_m2 * radiance * weight * 4.0 * u * hn * hn * hn);
}

/* Gauss's four points on 0..1 and their weights. */
static const double GAUSS4[4] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281,
                                 0.9305681557970263};
static const double WEIGHT4[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                  0.17392742256872693};

/* One panel of radii, in widths of the lobe. */
static void push_panel(const highlight *l, double from, double to)
{
    enum { SPOKES = 32 };
    const double wx = fmin(l->shape->width[0], WIDEST), wy = fmin(l->shape->width[1], WIDEST);
    for (int k = 0; k < 4; k++) {
        const double radius = from + (to - from) * GAUSS4[k];
        const double weight = (to - from) * WEIGHT4[k] * radius * wx * wy * TWO_PI / SPOKES;
        for (int j = 0; j < SPOKES; j++) {
            /* Rings are turned against each other, so that the globe's edges average out. */
            const double angle = TWO_PI * (j + 0.25 * k) / SPOKES;
            push_bisector(l, wx * radius * cos(angle), wy * radius * sin(angle), weight);
        }
    }
}

/* Panels of even length where a lobe may fall as a Gaussian does, then doubling, until it is over or
 * the bisector lies flat. */
static void push_panels(const highlight *l)
{
    static const double LENGTH = 0.8, EVEN = 5.0, FLAT = 30.0; /* widths; slope of the bisector */
    const double most = fmin(l->shape->reach, FLAT * l->shape->narrow);
    for (double from = 0.0, to = LENGTH; from < most; to = to < EVEN ? to + LENGTH : 2.0 * to) {
        push_panel(l, from, fmin(to, most));
        from = to;
    }
}

/* A mirror: f = R delta(i - r')/c_r, so that X = R A c_r times the radiance seen in it. */
static double mirrored(const highlight *l)
{
    const double i[3] = {-l->r[0], -l->r[1], l->r[2]};
    return l->lobe->weight * l->lobe->model->specular(brdf_lobe_coef(l->lobe), i[2]) * l->area_m2 *
           l->r[2] * globe_radiance(&l->view, l->ground, i);
}

/* Whether the globe is too far from the mirror direction: direction runs at twice the tilt of the
 * bisector. */
static bool is_out_of_reach(const highlight *l)
{
    static const double SAFETY = 1.2, LARGE = 0.5; /* slopes of bisectors that are angles, nearly */
    const double wide = fmax(l->shape->width[0], l->shape->width[1]);
    const double tilt = l->shape->reach * wide;
    if (!(tilt < LARGE)) return false;
    const double mirror[3] = {l->r[0], l->r[1], -l->r[2]}; /* reversed: to compare with up */
    return angle3(mirror, l->view.up) > asin(1.0 / l->view.distance) + 2.0 * SAFETY * tilt;
}

/* Sets the view and the observer in the frame of facet f; false where it sees nothing of the globe,
 * or is not seen. */
static bool set_facet(const brdf_facets *facets, int f, const double component[9],
                      const globe_view *view, const brdf_light *light, highlight *l)
{
    double frame[9], given[3], sun[3];
    for (int j = 0; j < 3; j++) {
        frame[j] = facets->tangent[j][f];
        frame[3 + j] = facets->bitangent[j][f];
        frame[6 + j] = facets->normal[j][f];
        given[j] = light->r[j][l->lane];
    }
    mat_vec(frame, given, l->r);
    if (!(l->r[2] > BRDF_EDGE)) return false;
    mat_tvec(component, view->up, given);
    mat_tvec(component, view->sun, sun);
    l->view = *view;
    mat_vec(frame, given, l->view.up);
    mat_vec(frame, sun, l->view.sun);
    return l->view.up[2] < 1.0 / view->distance; /* some of the globe stands above its plane */
}

/* One lobe of one span in one band: adds to the lanes' sums. */
static void add_lobe(const globe *g, globe_scratch *s, const visibility_pose *poses,
                     const model_span *span, const globe_matter *matter, int which, int band,
                     const double *visible, double *sum)
{
    const brdf_lobe *lobe = &matter->narrow[which];
    const brdf_material one = {.n_lobes = 1, .lobes = &matter->narrow[which]};
    batch pairs = {.material = &one};
    highlight l = {.lobe = lobe,
                   .shape = &matter->shapes[which],
                   .ground = &g->ground[band],
                   .batch = &pairs};
    for (l.lane = 0; l.lane < BRDF_TILE; l.lane++) {
        if (s->lanes[l.lane].n_rings == 0) continue;
        const double *component =
            poses[(size_t)l.lane * (size_t)g->model->n_components + (size_t)span->component]
                .body_component;
        for (int f = 0; f < span->n; f++) {
            const size_t at = (size_t)(span->first + f) * BRDF_TILE + (size_t)l.lane;
            l.area_m2 = span->facets.area[f] * (visible ? visible[at] : 1.0);
            if (!(l.area_m2 > 0.0)) continue;
            if (!set_facet(&span->facets, f, component, &s->lanes[l.lane].view,
                           &s->lights[span->component], &l))
                continue;
            if (l.shape->specular)
                sum[l.lane] += mirrored(&l);
            else if (!is_out_of_reach(&l))
                push_panels(&l);
        }
    }
    batch_flush(&pairs);
    for (int lane = 0; lane < BRDF_TILE; lane++)
        sum[lane] += pairs.sum[lane];
}

void globe_add_highlights(const globe *g, globe_scratch *s, const visibility_pose *poses,
                          const double *visible, double *x)
{
    const model *m = g->model;
    for (int k = 0; k < m->n_spans; k++) {
        const model_span *span = &m->spans[k];
        const size_t first = (size_t)span->material * (size_t)m->n_bands;
        for (int b = 0; b < m->n_bands; b++) {
            const int same = m->same_band[first + (size_t)b];
            const globe_matter *matter = &g->matter[first + (size_t)same];
            if (matter->n_narrow == 0) continue;
            double *own = s->own + b * BRDF_TILE;
            if (same < b && g->same_ground[b] == g->same_ground[same]) {
                memcpy(own, s->own + same * BRDF_TILE, BRDF_TILE * sizeof *own);
            } else {
                memset(own, 0, BRDF_TILE * sizeof *own);
                for (int j = 0; j < matter->n_narrow; j++)
                    add_lobe(g, s, poses, span, matter, j, b, visible, own);
            }
            double *sum = x + ((size_t)b * (size_t)m->n_spans + (size_t)k) * BRDF_TILE;
            for (int lane = 0; lane < BRDF_TILE; lane++)
                sum[lane] += own[lane];
        }
    }
}
