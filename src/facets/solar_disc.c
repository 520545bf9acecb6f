#include "facets/solar_disc.h"

#include "base/constants.h"
#include "base/vec.h"
#include "brdf/sharpness.h"
#include "facets/lanes.h"

#include <math.h>
#include <stdint.h>

/* How far a point Sun is off is a matter of z, the change of the lobe's logarithm from the middle
 * of the disc to its rim: the mean of exp(z x) over a uniform disc is 1 + z^2/8, and of exp(-z^2
 * x^2/2) 1 - z^2/4 Up to this the middle alone is within 5e-4 (half a millimagnitude) of the mean,
 * as is every rule within its limits. */
#define Z_POINT 0.045
/* The logarithm of lobes that fall off as a power of the angle changes by no more per width. */
#define WING_POWER 3.0
/* Nearer to the horizon than this, in radii of the disc, g may follow the root of the cosine. */
#define LOW 6.0
/* And so near to opposition, in radii of the disc, powders have cusps. */
#define OPPOSITION 8.0

/* Whether f changes at once when the two directions, 50 deg from the normal, part by 1 deg. */
static bool has_surge(const brdf_lobe *lobe)
{
    static const double CHANGE = 0.02;
    const double away = sin(50 * DEG), up = cos(50 * DEG), apart = 1 * DEG;
    const double i[3] = {away, 0.0, up}, r[3] = {away * cos(apart), away * sin(apart), up};
    const double together = lobe->model->eval(brdf_lobe_coef(lobe), i, i);
    return fabs(lobe->model->eval(brdf_lobe_coef(lobe), i, r) - together) > CHANGE * together;
}

void lobe_shape_find(const brdf_lobe *lobe, lobe_shape *out)
{
    *out = (lobe_shape){.specular = lobe->model->specular != NULL};
    if (out->specular) {
        out->narrow = HUGE_VAL;
        return;
    }
    brdf_sharpness sharpness;
    brdf_lobe_sharpness(lobe, &sharpness);
    for (int j = 0; j < 2; j++) {
        out->width[j] = fmin(sharpness.width[j], LOBE_WIDEST);
        out->reach = fmax(out->reach, sharpness.reach[j] / out->width[j]);
    }
    out->narrow = 1.0 / fmin(out->width[0], out->width[1]);
    out->surge = has_surge(lobe);
}

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
/* Gauss's five points on -1..1 and their weights over 2. */
static const double GAUSS5[5] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                 0.9061798459386640};
static const double WEIGHT5[5] = {0.1184634425280945, 0.2393143352496832, 0.2844444444444444,
                                  0.2393143352496832, 0.1184634425280945};

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
    double i[3], h[3];
    point_at(s, x, y, i);
    add3(i, s->r, h);
    if (!(h[2] > 0.0)) return false;
    for (int j = 0; j < 2; j++) {
        const double slope = h[j] / h[2], narrow = 1.0 / s->sample->shape->width[j];
        out->at[j] = slope * narrow;
        out->turn[j][0] = s->scale * (s->e1[j] - slope * s->e1[2]) / h[2] * narrow;
        out->turn[j][1] = s->scale * (s->e2[j] - slope * s->e2[2]) / h[2] * narrow;
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

/* Integrates over the part of the disc that lies beyond `from` along the first of two orthogonal
 * axes (from = -1: all of it), with the lobe's top at `top` in these axes, and its width along them
 * given. x = sin psi, y = cos psi sin chi: then nothing is singular at the rim. */
typedef struct patch {
    double along[2], from, top[2], width[2], reach;
} patch;

/* Points of a rule over the panels of a line between -c and c, in the angle whose sine is the place
 * over c; parts too long for cosines are cut on. */
typedef struct rule {
    int n;
    double angle[5 * 4 * MOST_ENDS], weight[5 * 4 * MOST_ENDS];
} rule;

static void fill_rule(const panels *line, double c, rule *out)
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
                out->weight[out->n++] = WEIGHT5[g] * length / parts;
            }
    }
}

static void push_line(const scene *s, const patch *p, double psi, double weight)
{
    const double x = sin(psi), c = cos(psi);
    const panels line = cut(-c, c, p->top[1], p->width[1], p->reach);
    rule points;
    fill_rule(&line, c, &points);
    for (int k = 0; k < points.n; k++) {
        const double y = c * sin(points.angle[k]);
        const double bright = brightness_at(s->disc->limb_darkened, x * x + y * y);
        push_point(s, x * p->along[0] - y * p->along[1], x * p->along[1] + y * p->along[0],
                   weight * points.weight[k] * c * cos(points.angle[k]) * bright);
    }
}

static void push_patch(const scene *s, const patch *p)
{
    const panels line = cut(fmax(p->from, -1.0), 1.0, p->top[0], p->width[0], p->reach);
    rule points;
    fill_rule(&line, 1.0, &points);
    for (int k = 0; k < points.n; k++)
        push_line(s, p, points.angle[k], points.weight[k] * cos(points.angle[k]) / PI);
}

/* The part of the disc above the facet's horizon, where nothing is narrow. */
static void push_risen(const scene *s)
{
    const patch p = {.along = {1.0, 0.0},
                     .from = -s->i[2] / (s->scale * s->e1[2]),
                     .width = {HUGE_VAL, HUGE_VAL}};
    push_patch(s, &p);
}

/* Finds the point, in radii, at which the bisector does not lean: the lobe's top. Its axes there.
 */
static bool find_top(const scene *s, double top[2], ellipse *shape)
{
    static const double FAR = 50.0; /* radii: lobes of that reach are not narrow */
    top[0] = top[1] = 0.0;
    for (int step = 0; step < 4; step++) {
        lean l;
        if (!lean_at(s, top[0], top[1], &l)) return false;
        *shape = ellipse_of(&l);
        const double det = l.turn[0][0] * l.turn[1][1] - l.turn[0][1] * l.turn[1][0];
        if (!(fabs(det) > 1e-9 * shape->size[0] * shape->size[0])) return step > 0;
        top[0] -= (l.turn[1][1] * l.at[0] - l.turn[0][1] * l.at[1]) / det;
        top[1] -= (l.turn[0][0] * l.at[1] - l.turn[1][0] * l.at[0]) / det;
        const double far = hypot(top[0], top[1]);
        if (far > FAR) top[0] *= FAR / far, top[1] *= FAR / far;
    }
    return true;
}

static void push_narrow(const scene *s)
{
    double top[2];
    ellipse shape;
    if (!find_top(s, top, &shape)) {
        push_rule(s, &s->disc->rules[DISC_FOUR]);
        return;
    }
    const patch p = {.along = {shape.along[0], shape.along[1]},
                     .from = -1.0,
                     .top = {top[0] * shape.along[0] + top[1] * shape.along[1],
                             top[1] * shape.along[0] - top[0] * shape.along[1]},
                     .width = {1.0 / shape.size[0], 1.0 / shape.size[1]},
                     .reach = s->sample->shape->reach};
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

/* How the lobe's logarithm changes over the disc: from its size and distance from the lobe's top,
 * in widths. */
static double change_of(double size, double distance, double reach)
{
    return size * (reach < HUGE_VAL ? 1.0 + distance : fmin(1.0 + distance, WING_POWER));
}

/* The cheapest rule that will do; DISC_RULES: none of them does. z: the change; size: of the disc,
 * in widths of the lobe. */
static disc_rule_kind rule_for(double z, double size)
{
    static const struct {
        disc_rule_kind rule;
        double most_z, most_size;
    } LIMITS[] = {{DISC_CENTRE, Z_POINT, Z_POINT}, {DISC_CROSS, 0.5, 0.35},
                  {DISC_RING, 1.2, 0.7},           {DISC_TWO, 2.0, 1.0},
                  {DISC_THREE, 3.0, 1.5},          {DISC_FOUR, 4.0, 2.0}};
    for (int k = 0; k < DISC_RULES; k++)
        if (z <= LIMITS[k].most_z && size <= LIMITS[k].most_size) return LIMITS[k].rule;
    return DISC_RULES;
}

/* Powders have cusps at opposition. */
static bool is_at_surge(const scene *s)
{
    double apart[3];
    if (!s->sample->shape->surge) return false;
    sub3(s->i, s->r, apart);
    return norm3(apart) < OPPOSITION * s->scale;
}

void disc_push(batch *b, const disc_sample *sample, const double i[3], const double r[3],
               double area_m2)
{
    scene s = {.batch = b,
               .sample = sample,
               .disc = sample->disc,
               .scale = sample->disc->scale[sample->lane],
               .area_m2 = area_m2};
    if (!(r[2] > BRDF_EDGE)) return;
    look_at(&s, i, r);
    if (sample->shape->specular) {
        push_mirror(&s);
        return;
    }
    if (s.i[2] <= -s.scale * s.e1[2]) return; /* all of it has set */
    lean l;
    const bool has_lean = lean_at(&s, 0.0, 0.0, &l);
    const double size = has_lean ? largest_size(&l) : 0.0;
    const double distance = has_lean ? sqrt(l.at[0] * l.at[0] + l.at[1] * l.at[1]) : 0.0;
    double h[3];
    add3(i, r, h);
    const bool past = (distance - size) * norm3(h) > 2.0 * sample->shape->reach;
    disc_rule_kind which =
        past ? DISC_CENTRE : rule_for(change_of(size, distance, sample->shape->reach), size);
    if (s.i[2] < LOW * s.scale && which < DISC_RING) which = DISC_RING;
    if (is_at_surge(&s) && which < DISC_FOUR) which = DISC_FOUR;
    if (which == DISC_RULES)
        push_narrow(&s);
    else if (s.i[2] < s.scale * s.e1[2])
        push_risen(&s);
    else
        push_rule(&s, &s.disc->rules[which]);
}

/* --- which lanes --- */

/* What is the same for all lanes of a facet. */
typedef struct facet_axes {
    double n[3], t[3], b[3];
} facet_axes;

/* Lanes in which the facet is lit by some of the disc, and seen: -1. low: of these, the ones in
 * which the disc is near to the horizon or the two directions are near to each other. */
CLONES static bool find_lit(const facet_axes *f, const brdf_light *light, const source_disc *disc,
                            double opposition, int64_t lit[BRDF_TILE], int64_t low[BRDF_TILE])
{
    const double n0 = f->n[0], n1 = f->n[1], n2 = f->n[2];
    int64_t any = 0;
    for (int k = 0; k < BRDF_TILE; k++) {
        const double q = disc->radius[k];
        const double ci = n0 * light->i[0][k] + n1 * light->i[1][k] + n2 * light->i[2][k];
        const double cr = n0 * light->r[0][k] + n1 * light->r[1][k] + n2 * light->r[2][k];
        lit[k] = -(int64_t)(q > 0.0) & -(int64_t)(ci > -1.01 * q) & -(int64_t)(cr > BRDF_EDGE);
        low[k] = lit[k] & (-(int64_t)(ci < LOW * 1.01 * q) |
                           -(int64_t)(light->hh[k] > 4.0 - opposition * opposition * q * q));
        any |= lit[k];
    }
    return any != 0;
}

/* The scalar test of disc_push, loosened, for all lanes of a facet at once: adds to `wanted`. */
CLONES static void find_blurred(const lobe_shape *shape, const facet_axes *f,
                                const brdf_light *light, const source_disc *disc,
                                const int64_t lit[BRDF_TILE], int64_t wanted[BRDF_TILE])
{
    const double n0 = f->n[0], n1 = f->n[1], n2 = f->n[2], t0 = f->t[0], t1 = f->t[1];
    const double t2 = f->t[2], b0 = f->b[0], b1 = f->b[1], b2 = f->b[2];
    /* A mirror's width is taken as 1 rad: its lobe is over at once. */
    const double narrow_x = shape->specular ? 1.0 : 1.0 / shape->width[0];
    const double narrow_y = shape->specular ? 1.0 : 1.0 / shape->width[1];
    const double narrow = shape->specular ? 1.0 : shape->narrow;
    const double least = shape->specular ? 0.0 : Z_POINT;
    const bool wings = !(shape->reach < HUGE_VAL);
    const double reach = wings ? 1e30 : shape->reach, power = wings ? WING_POWER : 1e30;
    for (int k = 0; k < BRDF_TILE; k++) {
        const double h0 = light->h[0][k], h1 = light->h[1][k], h2 = light->h[2][k];
        const double hn = n0 * h0 + n1 * h1 + n2 * h2, up = 1.0 / (hn > 1e-30 ? hn : 1e-30);
        const double x = (t0 * h0 + t1 * h1 + t2 * h2) * up;
        const double y = (b0 * h0 + b1 * h1 + b2 * h2) * up;
        const double distance = sqrt(x * x * narrow_x * narrow_x + y * y * narrow_y * narrow_y);
        const double size = 1.1 * disc->radius[k] * narrow * up * (1.0 + sqrt(x * x + y * y));
        const double fall = 1.0 + distance < power ? 1.0 + distance : power;
        wanted[k] |= lit[k] & -(int64_t)(size * fall > least) &
                     -(int64_t)((distance - size) * light->hlen[k] <= 2.0 * reach);
    }
}

uint32_t disc_lanes(const lobe_shape *shape, const brdf_facets *facets, int which,
                    const brdf_light *light, const source_disc *disc)
{
    facet_axes f;
    int64_t lit[BRDF_TILE], wanted[BRDF_TILE];
    for (int j = 0; j < 3; j++) {
        f.n[j] = facets->normal[j][which];
        f.t[j] = facets->tangent[j][which];
        f.b[j] = facets->bitangent[j][which];
    }
    if (!find_lit(&f, light, disc, shape->surge ? OPPOSITION : 0.0, lit, wanted)) return 0;
    if (shape->specular || shape->narrow > 1.0 / LOBE_WIDEST)
        find_blurred(shape, &f, light, disc, lit, wanted);
    uint32_t bits = 0;
    for (int k = 0; k < BRDF_TILE; k++)
        bits |= (uint32_t)(wanted[k] & 1) << k;
    return bits;
}
