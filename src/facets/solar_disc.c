#include "facets/solar_disc.h"

#include "base/clones.h"
#include "base/constants.h"
#include "base/gauss.h"
#include "base/vec.h"

#include <math.h>
#include <string.h>

/* --- the disc's own moments --- */

/* Means of s and s^2 over the disc, s the square of the distance from its middle in radii. With mu
 * = sqrt(1 - s): the integral of s^k (1 - u + u mu) is (1 - u)/(k + 1) + u B(k + 1, 3/2), and B is
 * 2/3, 4/15, 16/105 for k = 0, 1, 2. */
static void disc_moments(bool limb_darkened, double *s, double *s2)
{
    const double u = limb_darkened ? SUN_LIMB_DARKENING : 0.0, whole = 1.0 - u / 3.0;
    *s = ((1.0 - u) / 2.0 + u * 4.0 / 15.0) / whole;
    *s2 = ((1.0 - u) / 3.0 + u * 16.0 / 105.0) / whole;
}

/* Brightness at s over its mean over the disc. */
static double brightness_at(bool limb_darkened, double s)
{
    if (!limb_darkened) return 1.0;
    const double mu = s < 1.0 ? sqrt(1.0 - s) : 0.0;
    return (1.0 - SUN_LIMB_DARKENING * (1.0 - mu)) / (1.0 - SUN_LIMB_DARKENING / 3.0);
}

/* Gauss's four points on 0..1 and their weights. */
static const double GAUSS4[4] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281,
                                 0.9305681557970263};
static const double WEIGHT4[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                  0.17392742256872693};
/* Gauss's two and three points on 0..1 and their weights. */
static const double GAUSS2[2] = {0.21132486540518713, 0.7886751345948129};
static const double WEIGHT2[2] = {0.5, 0.5};
static const double GAUSS3[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
static const double WEIGHT3[3] = {0.2777777777777778, 0.4444444444444444, 0.2777777777777778};

/* Adds a ring of points to a rule, at s = radius^2, turned by a part of their spacing. */
static void add_ring(disc_rule *rule, double s, double weight, int n, double turned)
{
    const double radius = sqrt(s);
    for (int k = 0; k < n; k++) {
        const double angle = TWO_PI * (k + turned) / n;
        rule->x[rule->n] = radius * cos(angle);
        rule->y[rule->n] = radius * sin(angle);
        rule->weight[rule->n++] = weight / n;
    }
}

/* Rings at Gauss's points in s, which stand for equal areas; their weights add to 1. */
static void add_rings(disc_rule *rule, bool limb_darkened, int n, const double *s,
                      const double *weight, int spokes)
{
    double whole = 0.0;
    for (int k = 0; k < n; k++)
        whole += weight[k] * brightness_at(limb_darkened, s[k]);
    /* Turned a little, so that no spoke runs along the edge of a facet of a symmetric body. */
    for (int k = 0; k < n; k++)
        add_ring(rule, s[k], weight[k] * brightness_at(limb_darkened, s[k]) / whole, spokes,
                 0.3 + 0.5 * (k % 2));
}

void source_disc_start(source_disc *disc, bool limb_darkened)
{
    double s, s2;
    disc->limb_darkened = limb_darkened;
    disc_moments(limb_darkened, &s, &s2);
    for (int k = 0; k < DISC_RULES; k++)
        disc->rules[k].n = 0;
    disc_rule *rule = disc->rules;
    add_ring(&rule[DISC_CENTRE], 0.0, 1.0, 1, 0.0);
    /* Right for polynomials of degree 3, 5 and 7; then 9 and 15 but for the limb. */
    add_ring(&rule[DISC_CROSS], s, 1.0, 4, 0.0);
    add_ring(&rule[DISC_RING], 0.0, 1.0 - s * s / s2, 1, 0.0);
    add_ring(&rule[DISC_RING], s2 / s, s * s / s2, 6, 0.0);
    add_rings(&rule[DISC_TWO], limb_darkened, 2, GAUSS2, WEIGHT2, 8);
    add_rings(&rule[DISC_THREE], limb_darkened, 3, GAUSS3, WEIGHT3, 10);
    add_rings(&rule[DISC_FOUR], limb_darkened, 4, GAUSS4, WEIGHT4, 16);
}

void source_disc_set(source_disc *disc, int lane, double radius)
{
    disc->radius[lane] = radius;
    disc->scale[lane] = tan(radius);
}

/* --- one sample --- */

/* The disc before the facet. Its points are i + scale (x e1 + y e2), made unit, with x^2 + y^2 <=
 * 1: e1 goes up in the plane of incidence, e2 level. */
typedef struct scene {
    batch *batch;
    const disc_sample *sample;
    const source_disc *disc; /* the sample's */
    double i[3], r[3], e1[3], e2[3];
    double scale; /* tangent of the disc's radius */
    double area_m2;
    double horizon; /* only points with x above it are up, -1 or less: all of them */
    double middle;  /* x half way up what is up */
} scene;

static void look_at(scene *s, const double i[3], const double r[3])
{
    static const double UP[3] = {0.0, 0.0, 1.0}, ALONG[3] = {1.0, 0.0, 0.0};
    copy3(i, s->i);
    copy3(r, s->r);
    /* Where the source stands overhead the observer gives the plane. */
    if (!(perp3(UP, i, s->e1) > 1e-6) && !(perp3(r, i, s->e1) > 1e-6)) perp3(ALONG, i, s->e1);
    cross3(i, s->e1, s->e2);
}

static void point_at(const scene *s, double x, double y, double out[3])
{
    const double a = s->scale * x, b = s->scale * y, c = 1.0 / sqrt(1.0 + a * a + b * b);
    for (int j = 0; j < 3; j++)
        out[j] = c * (s->i[j] + a * s->e1[j] + b * s->e2[j]);
}

static void push_point(const scene *s, double x, double y, double weight)
{
    double i[3];
    point_at(s, x, y, i);
    batch_push(s->batch, s->sample->lane, i, s->r, 0.0, 0.0, s->area_m2 * weight);
}

/* Where the bisector leans, in widths of the lobe: at a point of the disc, and how that changes
 * with the point's coordinates. False where there is no telling. */
typedef struct lean {
    double at[2], turn[2][2];
} lean;

static bool lean_at(const scene *s, double x, double y, lean *out)
{
    double i[3], h[3], way[2][3];
    point_at(s, x, y, i);
    add3(i, s->r, h);
    if (!(h[2] > 0.0)) return false;
    /* of i, unit all the way: matters where all is grazing */
    const double length = dot3(i, s->i), bend = s->scale * length;
    for (int j = 0; j < 3; j++) {
        way[0][j] = s->scale * length * (s->e1[j] - bend * x * i[j]);
        way[1][j] = s->scale * length * (s->e2[j] - bend * y * i[j]);
    }
    for (int j = 0; j < 2; j++) {
        const double slope = h[j] / h[2], narrow = 1.0 / s->sample->shape->width[j];
        out->at[j] = slope * narrow;
        for (int k = 0; k < 2; k++)
            out->turn[j][k] = (way[k][j] - slope * way[k][2]) / h[2] * narrow;
    }
    return true;
}

/* turn = (rotation) diag(size) [along, across]^T: along is the way in the disc on which the lobe
 * changes fastest; size[0] >= size[1]. */
typedef struct ellipse {
    double along[2], size[2];
} ellipse;

/* turn^T turn = [mean + a, b; b, mean - a], whose eigenvalues are mean +- sqrt(a^2 + b^2). */
static void square_of(const lean *l, double *mean, double *a, double *b)
{
    const double(*t)[2] = l->turn;
    const double xx = t[0][0] * t[0][0] + t[1][0] * t[1][0];
    const double yy = t[0][1] * t[0][1] + t[1][1] * t[1][1];
    *mean = 0.5 * (xx + yy);
    *a = 0.5 * (xx - yy);
    *b = t[0][0] * t[0][1] + t[1][0] * t[1][1];
}

static double largest_size(const lean *l)
{
    double mean, a, b;
    square_of(l, &mean, &a, &b);
    return sqrt(mean + sqrt(a * a + b * b));
}

static ellipse ellipse_of(const lean *l)
{
    double mean, a, b;
    square_of(l, &mean, &a, &b);
    const double half = sqrt(a * a + b * b), angle = 0.5 * atan2(b, a);
    return (ellipse){{cos(angle), sin(angle)}, {sqrt(mean + half), sqrt(fmax(mean - half, 0.0))}};
}

static void push_rule(const scene *s, const disc_rule *rule)
{
    for (int k = 0; k < rule->n; k++)
        push_point(s, rule->x[k], rule->y[k], rule->weight[k]);
}

/* --- the rule for a narrow lobe, or a part of the disc --- */

/* Panels along a line: their ends, ascending. */
enum { MOST_ENDS = 96 };

typedef struct panels {
    int n; /* ends */
    double end[MOST_ENDS];
} panels;

static void add_end(panels *p, double end, double hi)
{
    if (p->n < MOST_ENDS - 1 && end > p->end[p->n - 1] && end < hi) p->end[p->n++] = end;
}

/* Cuts lo..hi so that a lobe is smooth over each panel: at its top and at distances from it, evenly
 * where it may fall as a Gaussian does, then doubling, until it is over. width: of the lobe along
 * the line, may be infinite. */
static panels cut(double lo, double hi, double top, double width, double reach)
{
    enum { MOST = 40 };
    panels p = {1, {lo}};
    double distance[MOST];
    int n = 0;
    for (double d = 1.3; n < MOST; d = d < 6.0 ? d + 1.3 : 2.0 * d) {
        distance[n++] = d * width;
        if (d >= reach || d * width > 2.0) break; /* the disc is 2 wide */
    }
    for (int k = n - 1; k >= 0; k--)
        add_end(&p, top - distance[k], hi);
    add_end(&p, top, hi);
    for (int k = 0; k < n; k++)
        add_end(&p, top + distance[k], hi);
    p.end[p.n++] = hi;
    return p;
}

static double asin_within(double x)
{
    return asin(fmin(fmax(x, -1.0), 1.0));
}

/* Integrates over the disc along two orthogonal axes: lines in the direction in which the lobe
 * changes slowest, one beside the other in that in which it changes fastest. `top`, `width`,
 * `reach`: where it is highest on the fast axis, its width there in radii, where it is narrowest,
 * and how many of these it reaches at most; each line looks for its own top and width, from
 * slow_top. Place x = sin psi, on the line y = cos psi sin chi: then nothing is singular at the
 * rim. */
typedef struct patch {
    double fast[2], slow[2]; /* the axes, unit */
    double top, width, reach, slow_top;
} patch;

/* Points of a rule over the panels of a line between -c and c, in the angle whose sine is the place
 * over c; parts too long for cosines are cut on. */
typedef struct line_rule {
    int n;
    double angle[5 * 4 * MOST_ENDS], weight[5 * 4 * MOST_ENDS];
} line_rule;

static void fill_rule(const panels *line, double c, line_rule *out)
{
    static const double LONGEST = 1.6; /* rad: Gauss's rule gives squared cosines to 1e-5 */
    out->n = 0;
    for (int k = 0; k + 1 < line->n; k++) {
        const double from = asin_within(line->end[k] / c);
        const double length = asin_within(line->end[k + 1] / c) - from;
        const int parts = 1 + (int)(length / LONGEST); /* 4 at most: pi long */
        for (int part = 0; part < parts; part++)
            for (int g = 0; g < 5; g++) {
                out->angle[out->n] = from + length * (part + 0.5 + 0.5 * GAUSS5[g]) / parts;
                out->weight[out->n++] = GAUSS5_WEIGHT[g] * length / parts;
            }
    }
}

static void place_on(const patch *p, double fast, double slow, double out[2])
{
    for (int j = 0; j < 2; j++)
        out[j] = fast * p->fast[j] + slow * p->slow[j];
}

/* Where the lobe is highest on a line, and how wide it is there, as it looks from the point of the
 * line between lo and hi that is next to the first guess in *top. */
static void find_on_line(const scene *s, const patch *p, double across, double lo, double hi,
                         double *top, double *width)
{
    lean l;
    double at[2], along[2];
    const double y = fmin(fmax(*top, lo), hi);
    place_on(p, across, y, at);
    *width = HUGE_VAL;
    if (!lean_at(s, at[0], at[1], &l)) return;
    for (int j = 0; j < 2; j++)
        along[j] = l.turn[j][0] * p->slow[0] + l.turn[j][1] * p->slow[1];
    const double square = along[0] * along[0] + along[1] * along[1];
    if (!(square > 0.0)) return;
    *top = y - (l.at[0] * along[0] + l.at[1] * along[1]) / square;
    *width = 1.0 / sqrt(square);
}

/* The part of a line that is up; false where none of it is. */
static bool find_up(const scene *s, const patch *p, double across, double *lo, double *hi)
{
    static const double LEVEL = 1e-6; /* so level is a line that is up as a whole, or not */
    if (s->horizon <= -1.0) return true;
    const double above = across * p->fast[0] - s->horizon, rise = p->slow[0];
    if (fabs(rise) < LEVEL) return above > 0.0;
    if (rise > 0.0)
        *lo = fmax(*lo, -above / rise);
    else
        *hi = fmin(*hi, -above / rise);
    return *lo < *hi;
}

static void push_line(const scene *s, const patch *p, double psi, double weight)
{
    const double x = sin(psi), c = cos(psi);
    double lo = -c, hi = c, top = p->slow_top, width;
    if (!find_up(s, p, x, &lo, &hi)) return;
    find_on_line(s, p, x, lo, hi, &top, &width);
    const panels line = cut(lo, hi, top, width, p->reach);
    line_rule points;
    fill_rule(&line, c, &points);
    for (int k = 0; k < points.n; k++) {
        double at[2];
        const double y = c * sin(points.angle[k]);
        const double bright = brightness_at(s->disc->limb_darkened, x * x + y * y);
        place_on(p, x, y, at);
        push_point(s, at[0], at[1], weight * points.weight[k] * c * cos(points.angle[k]) * bright);
    }
}

static void push_patch(const scene *s, const patch *p)
{
    const panels line = cut(-1.0, 1.0, p->top, p->width, p->reach);
    line_rule points;
    fill_rule(&line, 1.0, &points);
    for (int k = 0; k < points.n; k++)
        push_line(s, p, points.angle[k], points.weight[k] * cos(points.angle[k]) / PI);
}

/* Mean over a disc that sets of the height, as a cosine to the normal, of its points; 0 of those
 * that have set. With the middle at x radii, the mean of max(0, x + y) over a uniform disc is `a`
 * below; over a part of it whose brightness goes with mu, the polynomial. */
static double mean_height(const scene *s)
{
    const double u = s->disc->limb_darkened ? SUN_LIMB_DARKENING : 0.0;
    const double x = s->i[2] < s->scale ? s->i[2] / s->scale : 1.0, x2 = x * x;
    const double a = (sqrt(1.0 - x2) * (2.0 + x2) / 3.0 + x * (0.5 * PI + asin(x))) / PI;
    const double polynomial = 0.125 + x / 3.0 + x2 / 4.0 - x2 * x2 / 24.0;
    return s->scale * ((1.0 - u) * a + u * polynomial) / (1.0 - u / 3.0);
}

/* Where the disc sets behind the facet's plane its light is that of a point at its mean height:
 * exact where g goes with the cosine of incidence, as it does for most surfaces so low. */
static void push_set(const scene *s)
{
    const double up = mean_height(s);
    const double level = sqrt((1.0 - up * up) / (s->i[0] * s->i[0] + s->i[1] * s->i[1]));
    const double i[3] = {level * s->i[0], level * s->i[1], up};
    batch_push(s->batch, s->sample->lane, i, s->r, 0.0, 0.0, s->area_m2);
}

/* Brings a point, in radii, to the disc: along the slow axis of the lobe as far as that does, and
 * up from the horizon, where a lobe may have no width. */
static void bring_to_disc(const scene *s, const double fast[2], double point[2])
{
    static const double ABOVE = 0.1; /* part of the height of what is up */
    const double f = fmin(fmax(point[0] * fast[0] + point[1] * fast[1], -1.0), 1.0);
    const double most = sqrt(1.0 - f * f);
    const double w = fmin(fmax(point[1] * fast[0] - point[0] * fast[1], -most), most);
    point[0] = f * fast[0] - w * fast[1];
    point[1] = f * fast[1] + w * fast[0];
    if (s->horizon > -1.0) point[0] = fmax(point[0], s->horizon + ABOVE * (1.0 - s->horizon));
}

/* Where the lobe's top is, in radii: the source in the mirror direction of the observer. False
 * where that is far away. */
static bool find_mirrored(const scene *s, double top[2])
{
    static const double FAR = 50.0; /* radii: lobes of that reach are not narrow */
    const double mirrored[3] = {-s->r[0], -s->r[1], s->r[2]};
    const double along = dot3(mirrored, s->i) * s->scale;
    if (!(along > 0.0)) return false;
    top[0] = dot3(mirrored, s->e1) / along;
    top[1] = dot3(mirrored, s->e2) / along;
    const double far = hypot(top[0], top[1]);
    if (far > FAR) top[0] *= FAR / far, top[1] *= FAR / far;
    return true;
}

/* Finds the lobe's top, in radii, and its axes, both as they look from `from`, the point of the
 * disc next to the top: at grazing incidence a lobe whose top is some radii away is many times as
 * wide on the disc as it is there. */
static bool find_top(const scene *s, double top[2], double from[2], ellipse *shape)
{
    static const double LEVEL[2] = {0.0, 1.0}; /* as a rule the fast one where all is grazing */
    if (!find_mirrored(s, top)) return false;
    for (int step = 0; step < 3; step++) {
        lean l;
        from[0] = top[0], from[1] = top[1];
        bring_to_disc(s, step > 0 ? shape->along : LEVEL, from);
        if (!lean_at(s, from[0], from[1], &l)) return false;
        *shape = ellipse_of(&l);
        const double det = l.turn[0][0] * l.turn[1][1] - l.turn[0][1] * l.turn[1][0];
        if (!(fabs(det) > 1e-9 * shape->size[0] * shape->size[0])) return step > 0;
        top[0] = from[0] - (l.turn[1][1] * l.at[0] - l.turn[0][1] * l.at[1]) / det;
        top[1] = from[1] - (l.turn[0][0] * l.at[1] - l.turn[1][0] * l.at[0]) / det;
    }
    return true;
}

/* Smallest and largest height of the bisector over what is up of the disc, over that at a point. */
static void find_heights(const scene *s, const double from[2], double *low, double *high)
{
    double i[3];
    point_at(s, from[0], from[1], i);
    const double here = i[2] + s->r[2], swing = s->scale * s->e1[2];
    *low = fmin(1.0, (fmax(s->i[2] - swing, 0.0) + s->r[2]) / here);
    *high = fmax(1.0, (s->i[2] + swing + s->r[2]) / here);
}

static void push_narrow(const scene *s)
{
    double top[2], from[2];
    ellipse shape = {{1.0, 0.0}, {0.0, 0.0}};
    if (!find_top(s, top, from, &shape)) {
        push_rule(s, &s->disc->rules[DISC_FOUR]);
        return;
    }
    /* the width goes with the bisector's height, which varies over the disc where all is grazing */
    double low, high;
    find_heights(s, from, &low, &high);
    const double fast[2] = {shape.along[0], shape.along[1]}, slow[2] = {-fast[1], fast[0]};
    const patch p = {.fast = {fast[0], fast[1]},
                     .slow = {slow[0], slow[1]},
                     .top = top[0] * fast[0] + top[1] * fast[1],
                     .slow_top = top[0] * slow[0] + top[1] * slow[1],
                     .width = low / shape.size[0],
                     .reach = s->sample->shape->reach * high / low};
    push_patch(s, &p);
}

/* A mirror: the disc's image is seen, or not. Its radiance times the solid angle that a point of
 * the facet offers: R A cos / (pi sin^2 q) in place of X. */
static void push_mirror(const scene *s)
{
    const double *i = s->i, *r = s->r;
    const double along = i[2] * r[2] - i[0] * r[0] - i[1] * r[1]; /* cosine to the image of r */
    const double x = -r[0], y = -r[1], z = r[2];
    const double across[3] = {i[1] * z - i[2] * y, i[2] * x - i[0] * z, i[0] * y - i[1] * x};
    const double distance = norm3(across) / (along * s->scale); /* in radii */
    if (!(along > 0.0 && distance <= 1.0)) return;
    const double sine = sin(s->disc->radius[s->sample->lane]);
    const double bright = brightness_at(s->disc->limb_darkened, distance * distance);
    s->batch->sum[s->sample->lane] += s->area_m2 *
                                      brdf_material_specular(s->batch->material, r[2]) * r[2] *
                                      bright / (PI * sine * sine);
}

/* The rule where the lobe is narrow, or seems so to disc_rule_of. */
static int rule_of(const scene *s)
{
    lean l;
    if (!lean_at(s, s->middle, 0.0, &l)) return DISC_CENTRE;
    const double distance = sqrt(l.at[0] * l.at[0] + l.at[1] * l.at[1]);
    return disc_rule_at(s->sample, s->i, s->r, largest_size(&l), distance);
}

void disc_push(batch *b, const disc_sample *sample, int rule, const double i[3], const double r[3],
               double area_m2)
{
    scene s = {.batch = b,
               .sample = sample,
               .disc = sample->disc,
               .scale = sample->disc->scale[sample->lane],
               .area_m2 = area_m2};
    if (rule == DISC_SET && sample->shape->narrow <= 1.0 / LOBE_WIDEST) { /* no lobe to look for */
        copy3(i, s.i);
        copy3(r, s.r);
        push_set(&s);
        return;
    }
    look_at(&s, i, r);
    if (sample->shape->specular) {
        push_mirror(&s);
        return;
    }
    const bool sets = s.i[2] < s.scale;
    s.horizon = sets ? -s.i[2] / (s.scale * s.e1[2]) : -1.0;
    s.middle = sets ? 0.5 * (1.0 + s.horizon) : 0.0;
    if (sets) { /* a lobe that is narrow at the disc's middle may be over for what is up */
        double up[3];
        point_at(&s, s.middle, 0.0, up);
        rule = disc_rule_of(sample, up, r);
    }
    if (rule == DISC_NARROW) rule = rule_of(&s);
    if (rule == DISC_NARROW)
        push_narrow(&s);
    else if (sets)
        push_set(&s);
    else
        push_rule(&s, &s.disc->rules[rule]);
}

/* --- many samples by one rule --- */

/* The axes of the disc, as look_at makes them. */
CLONES static void find_axes(const disc_queue *q, double e1[3][BRDF_TILE], double e2[3][BRDF_TILE])
{
    for (int k = 0; k < BRDF_TILE; k++) {
        const double x = q->i[0][k], y = q->i[1][k], z = q->i[2][k];
        const double across2 = x * x + y * y, scale = 1.0 / sqrt(across2 > 1e-12 ? across2 : 1.0);
        e1[0][k] = -z * x * scale;
        e1[1][k] = -z * y * scale;
        e1[2][k] = across2 * scale;
        e2[0][k] = y * e1[2][k] - z * e1[1][k];
        e2[1][k] = z * e1[0][k] - x * e1[2][k];
        e2[2][k] = x * e1[1][k] - y * e1[0][k];
    }
    for (int k = 0; k < BRDF_TILE; k++) {
        if (q->i[0][k] * q->i[0][k] + q->i[1][k] * q->i[1][k] > 1e-12) continue;
        scene s;
        look_at(&s, (double[3]){q->i[0][k], q->i[1][k], q->i[2][k]},
                (double[3]){q->r[0][k], q->r[1][k], q->r[2][k]});
        for (int j = 0; j < 3; j++)
            e1[j][k] = s.e1[j], e2[j][k] = s.e2[j];
    }
}

CLONES static void move_source(const disc_queue *restrict q, const double e1[restrict 3][BRDF_TILE],
                               const double e2[restrict 3][BRDF_TILE], double x, double y,
                               brdf_light *restrict light)
{
    for (int k = 0; k < BRDF_TILE; k++) {
        const double a = q->scale[k] * x, b = q->scale[k] * y;
        const double c = 1.0 / sqrt(1.0 + a * a + b * b);
        double hh = 0.0;
        for (int j = 0; j < 3; j++) {
            const double i = c * (q->i[j][k] + a * e1[j][k] + b * e2[j][k]);
            light->i[j][k] = i;
            light->h[j][k] = i + q->r[j][k];
            hh += light->h[j][k] * light->h[j][k];
        }
        light->hh[k] = hh;
        light->hlen[k] = sqrt(hh);
    }
}

void disc_queue_flush(disc_queue *q, const brdf_material *material, const disc_rule *rule)
{
    if (q->n == 0) return;
    for (int k = q->n; k < BRDF_TILE; k++) { /* spare lanes */
        for (int j = 0; j < 3; j++)
            q->i[j][k] = q->i[j][0], q->r[j][k] = q->r[j][0];
        q->scale[k] = q->scale[0];
        q->area_m2[k] = 0.0;
    }
    _Alignas(64) double e1[3][BRDF_TILE], e2[3][BRDF_TILE], sum[BRDF_TILE] = {0};
    _Alignas(64) double part[BRDF_TILE];
    brdf_light light;
    memcpy(light.r, q->r, sizeof light.r);
    find_axes(q, e1, e2);
    for (int p = 0; p < rule->n; p++) {
        move_source(q, (const double(*)[BRDF_TILE])e1, (const double(*)[BRDF_TILE])e2, rule->x[p],
                    rule->y[p], &light);
        for (int k = 0; k < BRDF_TILE; k++)
            part[k] = q->area_m2[k] * rule->weight[p];
        brdf_material_tile(material, &BATCH_FACET, &light, part, sum);
    }
    for (int k = 0; k < q->n; k++)
        q->sum[q->lane[k]] += sum[k];
    q->n = 0;
}

void disc_queue_push(disc_queue *q, const brdf_material *material, const disc_rule *rule,
                     double scale, int lane, const double i[3], const double r[3], double area_m2)
{
    const int k = q->n++;
    for (int j = 0; j < 3; j++)
        q->i[j][k] = i[j], q->r[j][k] = r[j];
    q->scale[k] = scale;
    q->area_m2[k] = area_m2;
    q->lane[k] = lane;
    if (q->n == BRDF_TILE) disc_queue_flush(q, material, rule);
}
