/* curved_tile.c: the light of curved facets in one tile. */
#include "base/gauss.h"
#include "base/vec.h"
#include "facets/batch.h"
#include "facets/curved.h"
#include "facets/curved_parts.h"
#include "facets/solar_disc.h"
#include "facets/spread.h"

#include <stdint.h>

/* One facet in the light of one lane. */
typedef struct scene {
    batch *batch;
    int lane;
    double i[3], r[3];          /* in the frame of the piece: t, b, n */
    double width[2], narrow[2]; /* of the lobe, rad, and 1 / that */
    double reach;               /* of the lobe, in widths */
    double blur;                /* how far the disc moves the highlight, in widths */
    double highlight[2];        /* slopes of the bisector; of triangles only */
    double part;                /* of the facet that is lit and seen */
    const disc_sample *disc;    /* NULL: the source is a point */
} scene;

static double square(double x, double y)
{
    return x * x + y * y;
}

/* Whether the lobe is smooth over a piece; squares in widths of the lobe. */
static bool is_fine(const scene *s, double extent2, double distance2)
{
    if (extent2 <= CURVED_FINE * CURVED_FINE) return true;
    const double extent = sqrt(extent2), wing = CURVED_NEAR + extent / CURVED_FAR;
    const double past = s->reach + extent, enough = (wing < past ? wing : past) + s->blur;
    return distance2 >= enough * enough;
}

/* --- triangles of slopes --- */

/* A triangle of slopes in widths of the lobe, seen from the highlight. */
typedef struct triangle {
    double x[3], y[3];
    int level; /* halvings so far */
} triangle;

/* The density of matter at slopes x, y. */
static double density_at(const curved_piece *p, double x, double y)
{
    const double q = 1.0 + x * x + y * y;
    if (p->kind == SURFACE_SPHERE) return 1.0 / (q * sqrt(q));
    if (p->kind != SURFACE_PARABOLOID) return 1.0;
    const double look = p->view[0] * x + p->view[1] * y + p->view[2], look2 = look * look;
    return sqrt(q) / (look2 * look2);
}

/* Adds matter at a place that is given in widths of the lobe from the highlight. */
static void push_slopes(const scene *s, const curved_piece *p, double from_x, double from_y,
                        double area_m2)
{
    const double x = s->highlight[0] + from_x * s->width[0];
    const double y = s->highlight[1] + from_y * s->width[1];
    batch_push(s->batch, s->lane, s->i, s->r, x, y, area_m2 * density_at(p, x, y));
}

/* Integrates over a triangle, with rules whose points all lie inside: three points, exact for
 * polynomials of degree 2, in the wings of the lobe; seven points, exact for degree 5 (Radon 1948,
 * Monatshefte fuer Mathematik 52, 286), in its core. */
static void push_triangle(const scene *s, const curved_piece *p, const triangle *t)
{
    static const double ROOT_15 = 3.872983346207417;
    const double reach[2] = {(1.0 + ROOT_15) / 7.0, (1.0 - ROOT_15) / 7.0}; /* of corner - middle */
    const double weight[2] = {(155.0 - ROOT_15) / 1200.0, (155.0 + ROOT_15) / 1200.0};
    const double area_m2 = s->part * p->area_m2 / (double)(1ull << t->level);
    const double x = (t->x[0] + t->x[1] + t->x[2]) / 3.0, y = (t->y[0] + t->y[1] + t->y[2]) / 3.0;
    const bool core = square(x, y) < CURVED_CORE * CURVED_CORE;
    if (core) push_slopes(s, p, x, y, 9.0 / 40.0 * area_m2);
    for (int ring = 0; ring < (core ? 2 : 1); ring++)
        for (int k = 0; k < 3; k++) {
            const double out = core ? reach[ring] : 0.5;
            push_slopes(s, p, x + out * (t->x[k] - x), y + out * (t->y[k] - y),
                        (core ? weight[ring] : 1.0 / 3.0) * area_m2);
        }
}

/* True when the lobe is smooth over the triangle. *longest: the side that faces this corner is the
 * longest. */
static bool measure(const scene *s, const triangle *t, int *longest)
{
    const double x = (t->x[0] + t->x[1] + t->x[2]) / 3.0, y = (t->y[0] + t->y[1] + t->y[2]) / 3.0;
    const double corner0 = square(t->x[0] - x, t->y[0] - y);
    const double corner1 = square(t->x[1] - x, t->y[1] - y);
    const double corner2 = square(t->x[2] - x, t->y[2] - y);
    const double extent2 = corner0 > corner1 ? corner0 : corner1;
    if (is_fine(s, extent2 > corner2 ? extent2 : corner2, square(x, y))) return true;
    const double side0 = square(t->x[1] - t->x[2], t->y[1] - t->y[2]);
    const double side1 = square(t->x[2] - t->x[0], t->y[2] - t->y[0]);
    const double side2 = square(t->x[0] - t->x[1], t->y[0] - t->y[1]);
    *longest = side0 >= side1 && side0 >= side2 ? 0 : side1 >= side2 ? 1 : 2;
    return false;
}

static triangle half_of(const triangle *t, int longest, bool second)
{
    const int b = (longest + 1) % 3, c = (longest + 2) % 3;
    const double x = 0.5 * (t->x[b] + t->x[c]), y = 0.5 * (t->y[b] + t->y[c]);
    triangle half = *t;
    half.x[second ? b : c] = x;
    half.y[second ? b : c] = y;
    half.level++;
    return half;
}

static void add_triangle(const scene *s, const curved_piece *p)
{
    enum { DEEPEST = 60 }; /* 30 halvings of each side: 1e-9 of it */
    triangle stack[DEEPEST + 1];
    int n = 1;
    for (int c = 0; c < 3; c++) {
        stack[0].x[c] = (p->corner[c][0] - s->highlight[0]) * s->narrow[0];
        stack[0].y[c] = (p->corner[c][1] - s->highlight[1]) * s->narrow[1];
    }
    stack[0].level = 0;
    while (n > 0) {
        const triangle t = stack[--n];
        int longest;
        if (t.level == DEEPEST || measure(s, &t, &longest)) {
            push_triangle(s, p, &t);
            continue;
        }
        stack[n++] = half_of(&t, longest, false);
        stack[n++] = half_of(&t, longest, true);
    }
}

/* --- arcs --- */

/* Turns v against the turn of the arc's frame: gives it in the frame that was turned by 2 atan(u).
 */
static void turn_back(const curved_piece *p, double u, const double v[3], double out[3])
{
    const double c = (1.0 - u * u) / (1.0 + u * u), sine = 2.0 * u / (1.0 + u * u);
    const double along = dot3(p->axis, v) * (1.0 - c);
    double cross[3];
    cross3(p->axis, v, cross);
    for (int j = 0; j < 3; j++)
        out[j] = c * v[j] - sine * cross[j] + along * p->axis[j];
}

/* Integrates over the angle from 2 atan(lo) to 2 atan(hi) with Gauss's five points. */
static void push_arc(const scene *s, const curved_piece *p, double lo, double hi)
{
    const double whole = 4.0 * atan(p->end);
    for (int k = 0; k < 5; k++) {
        const double u = 0.5 * (lo + hi) + 0.5 * GAUSS5[k] * (hi - lo);
        const double part = GAUSS5_WEIGHT[k] * (hi - lo) * 2.0 / (1.0 + u * u) / whole;
        double i[3], r[3];
        turn_back(p, u, s->i, i);
        turn_back(p, u, s->r, r);
        if (s->disc)
            disc_push(s->batch, s->disc, disc_rule_of(s->disc, i, r), i, r,
                      s->part * p->area_m2 * part);
        else
            batch_push(s->batch, s->lane, i, r, 0.0, 0.0, s->part * p->area_m2 * part);
    }
}

static void add_arc(const scene *s, const curved_piece *p)
{
    enum { DEEPEST = 48 };
    double stack[DEEPEST + 1][2], h[3], turned[3];
    int depth[DEEPEST + 1], n = 1;
    /* widths of the lobe per rad: the normal moves along axis x normal */
    const double speed = hypot(p->axis[1] * s->narrow[0], p->axis[0] * s->narrow[1]);
    add3(s->i, s->r, h);
    stack[0][0] = -p->end, stack[0][1] = p->end;
    depth[0] = 0;
    while (n > 0) {
        const double lo = stack[--n][0], hi = stack[n][1], middle = 0.5 * (lo + hi);
        const int level = depth[n];
        turn_back(p, middle, h, turned);
        const double extent = (hi - lo) / (1.0 + middle * middle) * speed;
        const double x = turned[0] * s->narrow[0], y = turned[1] * s->narrow[1];
        const bool behind = !(turned[2] > 0.0);
        const double distance2 = (x * x + y * y) / (turned[2] * turned[2]);
        if (behind || is_fine(s, extent * extent, distance2) || level == DEEPEST) {
            push_arc(s, p, lo, hi);
            continue;
        }
        for (int half = 0; half < 2; half++, n++) {
            stack[n][0] = half ? middle : lo;
            stack[n][1] = half ? hi : middle;
            depth[n] = level + 1;
        }
    }
}

/* --- facets --- */

static void vector_at(const double *const v[3], int k, double out[3])
{
    out[0] = v[0][k], out[1] = v[1][k], out[2] = v[2][k];
}

static void lane_at(const double v[3][BRDF_TILE], int k, double out[3])
{
    out[0] = v[0][k], out[1] = v[1][k], out[2] = v[2][k];
}

/* Past it nothing is left of the lobe, in widths. Lobes about the mirror direction, and those that
 * know the length of i + r, are wider in terms of the normal where the phase angle is large. */
static double reach_of(const curved_tile *t, int lane)
{
    return t->lobe->reach * 2.0 / t->light->hlen[lane];
}

/* How far the bisector leans, at most, while the source moves from the middle of its disc to the
 * rim: in the smaller width of the lobe. */
static double disc_reach(const curved_tile *t, int lane)
{
    if (!t->disc) return 0.0;
    const double narrowest = fmin(t->lobe->width[0], t->lobe->width[1]);
    return 1.3 * t->disc->radius[lane] / (t->light->hlen[lane] * narrowest);
}

void curved_tile_start(curved_tile *t)
{
    t->bisectors = spread_of(t->light->h);
    t->widest = fmax(t->lobe->width[0], t->lobe->width[1]);
    for (int lane = 0; lane < BRDF_TILE; lane++) {
        t->longest_reach = fmax(t->longest_reach, reach_of(t, lane));
        t->longest_disc = fmax(t->longest_disc, disc_reach(t, lane));
    }
}

/* A perfect mirror that is curved both ways shows an image of the disc, whose points are counted:
 * those that the piece has the normal for. Near that normal dA of the matter send the light on over
 * 4 dA / (dA / dw) sr. e1: the first axis of the disc, the same for all facets, in this frame. */
static void add_image(const curved_tile *t, const scene *s, const double e1[3],
                      const curved_piece *p)
{
    const disc_rule *points = &t->disc->rules[DISC_FOUR];
    double e2[3];
    cross3(s->i, e1, e2);
    const double scale = tan(t->disc->radius[s->lane]);
    const double(*c)[2] = p->corner;
    const double whole =
        (c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) - (c[1][1] - c[0][1]) * (c[2][0] - c[0][0]);
    for (int k = 0; k < points->n; k++) {
        double i[3], h[3];
        for (int j = 0; j < 3; j++)
            i[j] = s->i[j] + scale * (points->x[k] * e1[j] + points->y[k] * e2[j]);
        unit3(i, i);
        add3(i, s->r, h);
        if (!(h[2] > 0.0)) continue;
        const double at[2] = {h[0] / h[2], h[1] / h[2]};
        bool inside = whole != 0.0;
        for (int j = 0; j < 3 && inside; j++) {
            const double *a = c[j], *b = c[(j + 1) % 3];
            inside = ((b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0])) * whole >= 0;
        }
        if (!inside) continue;
        const double q = 1.0 + at[0] * at[0] + at[1] * at[1];
        const double per_sr = p->area_m2 / (0.5 * fabs(whole)) * density_at(p, at[0], at[1]) * q *
                              sqrt(q); /* dA / dw, m^2/sr */
        s->batch->sum[s->lane] += s->part * points->weight[k] * 0.25 * per_sr *
                                  brdf_material_specular(s->batch->material, 0.5 * norm3(h));
    }
}

/* Arcs are integrated for every point of the disc, so no piece of them need be much finer than what
 * the disc blurs. */
static void widen_by_disc(const curved_tile *t, int lane, scene *s)
{
    /* Pieces per radius of the disc. The image in a mirror ends sharply, somewhere in a piece. */
    const double fineness = t->shape->specular ? 200.0 : 10.0;
    const double size = t->disc->radius[lane] / t->light->hlen[lane]; /* rad, of the normal */
    double most = 0.0;
    for (int j = 0; j < 2; j++) {
        const double wide = fmax(t->lobe->width[j], size / fineness);
        most = fmax(most, size / wide);
        s->width[j] = wide;
        s->narrow[j] = 1.0 / wide;
    }
    s->blur = 1.5 * most;
}

static void add_pieces(curved_tile *t, int k, int lane, const double frame[9], double part)
{
    scene s = {.batch = t->batch,
               .lane = lane,
               .width = {t->lobe->width[0], t->lobe->width[1]},
               .narrow = {1.0 / t->lobe->width[0], 1.0 / t->lobe->width[1]},
               .reach = reach_of(t, lane),
               .part = part};
    const double radius = t->disc ? t->disc->radius[lane] : 0.0;
    const disc_sample disc = {.shape = t->shape, .disc = t->disc, .lane = lane};
    double i[3], r[3], h[3], e1[3], own_e1[3];
    lane_at(t->light->i, lane, i);
    lane_at(t->light->r, lane, r);
    const int away = smallest3(i);
    perp3((double[3]){away == 0, away == 1, away == 2}, i, e1);
    for (int p = t->span->first_piece[k]; p < t->span->first_piece[k + 1]; p++) {
        const curved_piece *piece = &t->span->pieces[p];
        const bool is_arc = piece->kind == SURFACE_CONE;
        const double *own = is_arc ? piece->frame : frame;
        mat_vec(own, i, s.i);
        mat_vec(own, r, s.r);
        if (is_arc) {
            scene arc = s;
            if (radius > 0.0) {
                arc.disc = &disc;
                widen_by_disc(t, lane, &arc);
            }
            add_arc(&arc, piece);
            continue;
        }
        if (t->shape->specular) {
            mat_vec(own, e1, own_e1);
            if (radius > 0.0) add_image(t, &s, own_e1, piece);
            continue;
        }
        add3(s.i, s.r, h);
        s.highlight[0] = h[0] / h[2], s.highlight[1] = h[1] / h[2];
        add_triangle(&s, piece);
    }
}

/* How far from facet k the highlight may be, in widths, before its normal alone will do. */
static double near_of(const curved_lobe *lobe, int k, double reach)
{
    const double wing = CURVED_NEAR + lobe->extent[k] / CURVED_FLAT, past = reach + lobe->extent[k];
    return wing < past ? wing : past;
}

/* Cosines between the bisectors of all lanes and a normal, times the lengths of i + r. False when
 * the square of none is above cosine2. */
static bool bisector_cosines(const brdf_light *light, const double normal[3], double cosine2,
                             double out[BRDF_TILE])
{
    const double n0 = normal[0], n1 = normal[1], n2 = normal[2];
    int64_t any = 0; /* as wide as a double, so that it fits the vectors */
    for (int k = 0; k < BRDF_TILE; k++) {
        const double c = n0 * light->h[0][k] + n1 * light->h[1][k] + n2 * light->h[2][k];
        out[k] = c;
        any |= -(int64_t)(c > 0.0) & -(int64_t)(c * c > cosine2 * light->hh[k]);
    }
    return any != 0;
}

/* True when the highlight of a lane is so near to the facet that its normal alone will not do. hn:
 * i + r along the normal. */
static bool is_near(const curved_tile *t, int k, int lane, const double frame[9], double hn)
{
    if (!(hn > 0.0)) return false;
    const curved_lobe *lobe = t->lobe;
    double h[3];
    lane_at(t->light->h, lane, h);
    const double x = dot3(frame, h) / lobe->width[0], y = dot3(frame + 3, h) / lobe->width[1];
    const double near = near_of(lobe, k, reach_of(t, lane)) + disc_reach(t, lane);
    return square(x, y) < near * near * hn * hn;
}

static bool is_lit(const curved_tile *t, const double normal[3], int lane)
{
    double i[3], r[3];
    lane_at(t->light->i, lane, i);
    lane_at(t->light->r, lane, r);
    return dot3(i, normal) > BRDF_EDGE && dot3(r, normal) > BRDF_EDGE;
}

bool curved_add_near(curved_tile *t, int k, double left[BRDF_TILE])
{
    if (t->lobe->extent[k] == 0.0) return false;
    double frame[9], hn[BRDF_TILE];
    vector_at(t->facets->tangent, k, frame);
    vector_at(t->facets->bitangent, k, frame + 3);
    vector_at(t->facets->normal, k, frame + 6);
    const double near = near_of(t->lobe, k, t->longest_reach) + t->longest_disc;
    const double slope = t->widest * near; /* at most */
    const double cosine2 = 1.0 / (1.0 + slope * slope);
    if (!spread_can_be_near(&t->bisectors, frame + 6, cosine2) ||
        !bisector_cosines(t->light, frame + 6, cosine2, hn))
        return false;
    bool any = false;
    for (int lane = 0; lane < BRDF_TILE; lane++) {
        if (!is_near(t, k, lane, frame, hn[lane]) || !is_lit(t, frame + 6, lane)) continue;
        any = true;
        const double part = left[lane];
        left[lane] = 0.0;
        if (part > 0.0) add_pieces(t, k, lane, frame, part);
    }
    return any;
}
