/* globe_highlight.c: what a narrow lobe shows of the globe. Its neighbourhood is integrated over
 * bisectors, which a window picks out; what is left of the lobe outside the window is broad, and
 * the nodes show it. */
#include "base/constants.h"
#include "base/vec.h"
#include "facets/globe_parts.h"

#include <math.h>
#include <string.h>

/* An axis without a lobe is taken as this wide (slope). */
#define WIDEST 1.0

/* --- the window --- */

/* In slopes x, y of the bisector: 1 within CORE widths, 0 past MARGIN (rad, or slope) outside that.
 * The margin is wide against the distance of nodes. */
#define CORE 4.0
#define MARGIN 0.2

typedef struct window {
    double inner[2], outer[2]; /* 1 / the half axes of two ellipses */
} window;

static window window_of(const lobe_shape *shape)
{
    window w;
    for (int j = 0; j < 2; j++) {
        const double core = CORE * fmin(shape->width[j], WIDEST);
        w.inner[j] = 1.0 / core;
        w.outer[j] = 1.0 / (core + MARGIN);
    }
    return w;
}

/* x^3 (10 - 15 x + 6 x^2) between the ellipses: smooth in the second derivative. */
static inline double window_at(const window *w, double x, double y)
{
    const double xi = x * w->inner[0], yi = y * w->inner[1];
    const double xo = x * w->outer[0], yo = y * w->outer[1];
    const double inner = sqrt(xi * xi + yi * yi), outer = sqrt(xo * xo + yo * yo);
    if (inner <= 1.0) return 1.0;
    if (outer >= 1.0) return 0.0;
    /* With the ellipses at s/inner and s/outer on this ray, and the bisector at s. */
    const double part = inner * (1.0 - outer) / (inner - outer);
    return part * part * part * (10.0 + part * (6.0 * part - 15.0));
}

static brdf_facets one_facet(const brdf_facets *facets, int f)
{
    brdf_facets one = {.n = 1, .area = facets->area + f};
    for (int j = 0; j < 3; j++) {
        one.normal[j] = facets->normal[j] + f;
        one.tangent[j] = facets->tangent[j] + f;
        one.bitangent[j] = facets->bitangent[j] + f;
    }
    return one;
}

void globe_add_outside(const globe_matter *matter, int which, const brdf_facets *facets,
                       const brdf_light *light, const double *visible, double *sum)
{
    const brdf_material one = {.n_lobes = 1, .lobes = &matter->narrow[which]};
    const window w = window_of(&matter->shapes[which]);
    for (int f = 0; f < facets->n; f++) {
        const brdf_facets lone = one_facet(facets, f);
        double part[BRDF_TILE];
        for (int k = 0; k < BRDF_TILE; k++) {
            double slope[3] = {0, 0, 0};
            for (int j = 0; j < 3; j++) {
                slope[0] += lone.tangent[j][0] * light->h[j][k];
                slope[1] += lone.bitangent[j][0] * light->h[j][k];
                slope[2] += lone.normal[j][0] * light->h[j][k];
            }
            const double up = slope[2] > 0.0 ? 1.0 / slope[2] : 0.0;
            part[k] = 1.0 - (up > 0.0 ? window_at(&w, slope[0] * up, slope[1] * up) : 0.0);
            if (visible) part[k] *= visible[(size_t)f * BRDF_TILE + (size_t)k];
        }
        brdf_material_tile(&one, &lone, light, part, sum);
    }
}

/* --- inside of it --- */

/* Where one facet looks, in its own frame t, b, n. */
typedef struct highlight {
    const brdf_lobe *lobe;
    const lobe_shape *shape;
    const brdf_material *ground;
    window window;
    globe_view view; /* in the facet's frame */
    double r[3];     /* to the observer */
    double area_m2;
    int lane;
    batch *batch;
} highlight;

/* A line of bisectors away from the normal: slopes per unit of the radius, in widths. */
typedef struct spoke {
    const highlight *light;
    double x, y;
    double weight; /* of its angle, with the area that the unit of both widths has */
} spoke;

/* The direction i = 2 (r.h) h - r that a bisector h mirrors to the observer, and the radiance that
 * comes from there; 0 where it is dark or below the facet's plane. *u: r.h; *hn: the bisector's
 * cosine. */
static double look_along(const spoke *s, double radius, double i[3], double *u, double *hn)
{
    const highlight *l = s->light;
    const double x = s->x * radius, y = s->y * radius;
    *hn = 1.0 / sqrt(1.0 + x * x + y * y);
    const double h[3] = {x * *hn, y * *hn, *hn};
    *u = dot3(l->r, h);
    if (!(*u > 0.0)) return 0.0;
    for (int j = 0; j < 3; j++)
        i[j] = 2.0 * *u * h[j] - l->r[j];
    return i[2] > BRDF_EDGE ? globe_radiance(&l->view, l->ground, i) : 0.0;
}

static bool is_lit(const spoke *s, double radius)
{
    double i[3], u, hn;
    return look_along(s, radius, i, &u, &hn) > 0.0;
}

/* Where light ends between a radius that has some and one that has none. */
static double edge_between(const spoke *s, double lit, double dark)
{
    for (int step = 0; step < 20; step++) { /* to 1e-6 of a panel */
        const double middle = 0.5 * (lit + dark);
        if (is_lit(s, middle))
            lit = middle;
        else
            dark = middle;
    }
    return 0.5 * (lit + dark);
}

/* Gauss's four points on 0..1 and their weights. */
static const double GAUSS4[4] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281,
                                 0.9305681557970263};
static const double WEIGHT4[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                  0.17392742256872693};

/* A part of a spoke that is lit: dw_h = h_n^3 dx dy, dw_i = 4 (r.h) dw_h (Torrance and Sparrow
 * 1967). */
static void push_part(const spoke *s, double from, double to)
{
    const highlight *l = s->light;
    for (int k = 0; k < 4; k++) {
        const double radius = from + (to - from) * GAUSS4[k];
        const double inside = window_at(&l->window, s->x * radius, s->y * radius);
        double i[3], u, hn;
        const double radiance = inside > 0.0 ? look_along(s, radius, i, &u, &hn) : 0.0;
        if (!(radiance > 0.0)) continue;
        const double weight = s->weight * radius * (to - from) * WEIGHT4[k] * inside;
        batch_push(l->batch, l->lane, i, l->r, 0.0, 0.0,
                   l->area_m2 * radiance * weight * 4.0 * u * hn * hn * hn);
    }
}

/* A panel of a spoke, cut where the globe's lit part ends. */
static void push_panel(const spoke *s, double from, double to)
{
    const double middle = 0.5 * (from + to);
    const bool first = is_lit(s, from), last = is_lit(s, to);
    if (first && last)
        push_part(s, from, to);
    else if (first)
        push_part(s, from, edge_between(s, from, to));
    else if (last)
        push_part(s, edge_between(s, to, from), to);
    else if (is_lit(s, middle))
        push_part(s, edge_between(s, middle, from), edge_between(s, middle, to));
}

/* Panels of even length where a lobe may fall as a Gaussian does, then growing, until the window is
 * over. */
static void push_spoke(const spoke *s)
{
    static const double LENGTH = 0.8, EVEN = 5.0, GROWTH = 1.5; /* widths */
    const double most = CORE + MARGIN * s->light->shape->narrow;
    for (double from = 0.0, to = LENGTH; from < most; to = to < EVEN ? to + LENGTH : GROWTH * to) {
        push_panel(s, from, fmin(to, most));
        from = to;
    }
}

static void push_window(const highlight *l)
{
    enum { SPOKES = 64 };
    const double wx = fmin(l->shape->width[0], WIDEST), wy = fmin(l->shape->width[1], WIDEST);
    for (int k = 0; k < SPOKES; k++) {
        const double angle = TWO_PI * k / SPOKES;
        const spoke s = {l, wx * cos(angle), wy * sin(angle), wx * wy * TWO_PI / SPOKES};
        push_spoke(&s);
    }
}

/* A mirror: f = R delta(i - r')/c_r, so that X = R A c_r times the radiance seen in it. */
static double mirrored(const highlight *l)
{
    const double i[3] = {-l->r[0], -l->r[1], l->r[2]};
    return l->lobe->weight * l->lobe->model->specular(brdf_lobe_coef(l->lobe), i[2]) * l->area_m2 *
           l->r[2] * globe_radiance(&l->view, l->ground, i);
}

/* Whether the globe is too far from the mirror direction for the window: a direction turns by less
 * than twice the tilt of the bisector, and a tilt is less than its slope. */
static bool is_out_of_reach(const highlight *l)
{
    const double slope = 1.0 / fmin(l->window.outer[0], l->window.outer[1]);
    const double mirror[3] = {l->r[0], l->r[1], -l->r[2]}; /* reversed: to compare with up */
    return angle3(mirror, l->view.up) > asin(1.0 / l->view.distance) + 2.0 * slope;
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
    batch pairs;
    highlight l = {.lobe = lobe,
                   .shape = &matter->shapes[which],
                   .ground = &g->ground[band],
                   .window = window_of(&matter->shapes[which]),
                   .batch = &pairs};
    batch_start(&pairs, &one);
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
                push_window(&l);
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
