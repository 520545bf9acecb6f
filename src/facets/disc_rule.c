/* Which rule the mean over the disc takes for one sample, and for which samples that need be asked.
 */
#include "base/constants.h"
#include "base/vec.h"
#include "brdf/sharpness.h"
#include "facets/solar_disc.h"

#include <math.h>
#include <string.h>

/* A point Sun is off by size^2 (D^2 - 2)/8 of a Gaussian lobe's value: size is how far the bisector
 * runs while the source crosses from the middle of its disc to the rim, D how far the bisector is
 * from the lobe's top, both in widths of the lobe. Up to this size^2 max(2, D^2 - 2) the middle
 * alone is within 8e-4. */
#define POINT_ERROR 6.4e-3
/* Half of it where lobes end, as they were looked at from a few directions only. */
#define END_ERROR (0.5 * POINT_ERROR)
/* And so near to opposition, in radii of the disc, powders have cusps. */
#define OPPOSITION 8.0

/* --- lobes --- */

/* Whether f changes at once when the two directions, 50 deg from the normal, part by 1 deg. */
static bool has_surge(const brdf_lobe *lobe)
{
    static const double CHANGE = 0.02;
    const double away = sin(50 * DEG), up = cos(50 * DEG), apart = 1 * DEG;
    const double i[3] = {away, 0.0, up}, r[3] = {away * cos(apart), away * sin(apart), up};
    const double together = lobe->model->eval(brdf_lobe_coef(lobe), i, i);
    return fabs(lobe->model->eval(brdf_lobe_coef(lobe), i, r) - together) > CHANGE * together;
}

/* Half of the phase angles at which lobes are looked at, rad; |H| there. */
#define PHASE_STEP (20.0 * DEG)
#define PHASE_LAST (70.0 * DEG)
#define PHASE_LAST_HLEN 0.6840402866513375
static const double PHASE_HLEN[LOBE_PHASES - 1] = {1.8793852415718169, 1.5320888862379560, 1.0};

/* A way for the bisector to leave the normal, with the two directions on both sides of it. */
typedef struct slice {
    const brdf_lobe *lobe;
    int axis;          /* 0 along the tangent, 1 across it */
    double half_phase; /* rad */
    double width;      /* of the lobe that way, rad */
} slice;

/* f at that many widths from the lobe's top, 1/sr. */
static double f_at(const slice *s, double distance)
{
    const double tilt = distance * s->width, c = cos(s->half_phase), across = sin(s->half_phase);
    double i[3], r[3];
    i[s->axis] = r[s->axis] = sin(tilt) * c;
    i[1 - s->axis] = across;
    r[1 - s->axis] = -across;
    i[2] = r[2] = cos(tilt) * c;
    return s->lobe->model->eval(brdf_lobe_coef(s->lobe), i, r) / (i[2] * i[2]);
}

/* How f, with all that the material reflects besides, bends at a distance from the lobe's top:
 * f''/f and f'/(f distance), per width^2. */
static double bend_at(const slice *s, double distance)
{
    const double step = fmax(0.2, 0.06 * distance); /* so that no kink is passed over */
    const double f = f_at(s, distance), on = f_at(s, distance + step);
    const double before = f_at(s, distance - step);
    if (!(f > 0.0)) return 0.0;
    return (fabs(on - 2.0 * f + before) / (step * step) +
            fabs(on - before) / (2.0 * step * distance)) /
           f;
}

/* Where along a slice the bends are over: end[j] for those of LOBE_BEND 4^j, infinite where they
 * are not. Adds to what is there. Returns the power with which the lobe falls at most. */
static double find_ends(const slice *s, double end[LOBE_ENDS])
{
    static const double FAR = 1.2; /* rad */
    double wing = 0.0;
    for (double d = 1.0; d * s->width < FAR; d *= 1.12) {
        const double bend = bend_at(s, d), next = 1.12 * d;
        if (bend >= LOBE_BEND) wing = fmax(wing, d * sqrt(bend));
        for (int j = 0; j < LOBE_ENDS && bend >= LOBE_BEND * (double)(1 << 2 * j); j++)
            end[j] = fmax(end[j], next * s->width < FAR ? next : HUGE_VAL);
    }
    return wing;
}

/* Looks how a lobe falls and to where. What it stands out from changes with the phase angle, and so
 * does its width, for some. */
static void look_at_wings(const brdf_lobe *lobe, lobe_shape *out)
{
    slice s = {lobe, out->width[1] < out->width[0], 0.0, 1.0 / out->narrow};
    out->wing = find_ends(&s, out->end[0]);
    for (int p = 0; p < LOBE_PHASES; p++) {
        if (p > 0) memcpy(out->end[p], out->end[p - 1], sizeof out->end[p]);
        s.half_phase = fmin(PHASE_STEP * (p + 1), PHASE_LAST);
        find_ends(&s, out->end[p]);
    }
}

/* The row of lobe_shape.end for directions whose sum is so long. */
static int phase_of(double hlen)
{
    int p = 0;
    while (p + 1 < LOBE_PHASES && hlen < PHASE_HLEN[p])
        p++;
    return p;
}

/* How much wider than in the last row they may be at phase angles beyond it. */
static double room_at(double hlen)
{
    return hlen < PHASE_LAST_HLEN ? PHASE_LAST_HLEN / hlen : 1.0;
}

/* Past how many widths the middle of a disc of that size will do. */
static double end_of(const double end[LOBE_ENDS], double size)
{
    int j = 0;
    double bend = 4.0 * LOBE_BEND * size * size;
    for (; j + 1 < LOBE_ENDS && bend <= END_ERROR; j++)
        bend *= 4.0;
    return end[j];
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
    look_at_wings(lobe, out);
}

/* --- one sample --- */

/* The cheapest rule that will do, DISC_NARROW where the disc is large against the lobe. size of the
 * disc and distance from the lobe's top in its widths. */
static inline int rule_for(double size, double distance, double wing)
{
    const double far = distance > 1.0 ? distance : 1.0, over = wing / far;
    const double fall = distance < over ? distance : over;  /* of the logarithm, per width */
    const double here = distance < 2.0 + size ? size : 0.0; /* the disc reaches the core */
    const double bend = fall * fall;
    const double least = here > 0.0 ? 2.0 : 0.0, steep = size * fall / 1.6;
    const double change = steep > here ? steep : here;
    if (!(size * size * (bend > least ? bend : least) > POINT_ERROR)) return DISC_CENTRE;
    return DISC_CROSS + (change > 0.28) + (change > 0.62) + (change > 1.0) + (change > 1.5) +
           (change > 2.0);
}

_Static_assert(DISC_CENTRE == 0 && DISC_CROSS == 1 && DISC_FOUR == 5 && DISC_NARROW == 6,
               "rule_for counts the limits that are passed");

/* A lobe that the disc may be felt in, or a mirror. */
static bool has_lobe(const lobe_shape *shape)
{
    return shape->specular || shape->narrow > 1.0 / LOBE_WIDEST;
}

/* In place of 1, for the bisector's way while the source crosses the disc: room for its bend. */
#define BISECTOR_WAY 1.01

/* Rad; a mirror's lobe ends at once, whatever its width. */
static double widest_of(const lobe_shape *shape)
{
    if (shape->specular) return 1.0;
    return shape->width[0] > shape->width[1] ? shape->width[0] : shape->width[1];
}

/* The rule for a lobe. The disc's size is an upper bound, as the source's way may be foreshortened.
 */
static int lobe_rule(const lobe_shape *shape, double scale, const double h[3], double hlen)
{
    const double up = 1.0 / (h[2] > 1e-30 ? h[2] : 1e-30), x = h[0] * up, y = h[1] * up;
    const double t2 = x * x + y * y, tilt = sqrt(t2), way = BISECTOR_WAY * scale / hlen;
    const double size = way * shape->narrow * (1.0 + t2);
    const double end =
        shape->specular ? 0.0 : room_at(hlen) * end_of(shape->end[phase_of(hlen)], size);
    /* The nearest that the bisector can come to the lobe's top: by the tangents of angles. */
    if (tilt - way > end * widest_of(shape) * (1.0 + tilt * way)) return DISC_CENTRE;
    if (shape->specular) return DISC_NARROW;
    const double from_x = x / shape->width[0], from_y = y / shape->width[1];
    const double distance = sqrt(from_x * from_x + from_y * from_y);
    return distance - size > end ? DISC_CENTRE : rule_for(size, distance, shape->wing);
}

/* Powders have cusps at opposition. */
static bool is_at_surge(const lobe_shape *shape, double scale, double hh)
{
    const double near = OPPOSITION * scale;
    return shape->surge && hh > 4.0 - near * near; /* |i - r|^2 = 4 - |H|^2 */
}

int disc_rule_at(const disc_sample *sample, const double i[3], const double r[3], double size,
                 double distance)
{
    double h[3];
    add3(i, r, h);
    const int rule = rule_for(size, distance, sample->shape->wing);
    const double scale = sample->disc->scale[sample->lane];
    return rule < DISC_FOUR && is_at_surge(sample->shape, scale, dot3(h, h)) ? DISC_FOUR : rule;
}

int disc_rule_of(const disc_sample *sample, const double i[3], const double r[3])
{
    const lobe_shape *shape = sample->shape;
    const double scale = sample->disc->scale[sample->lane];
    if (!(scale > 0.0 && i[2] > -scale && r[2] > BRDF_EDGE)) return DISC_CENTRE;
    double h[3];
    add3(i, r, h);
    const double hh = dot3(h, h);
    const int rule = has_lobe(shape) ? lobe_rule(shape, scale, h, sqrt(hh)) : DISC_CENTRE;
    if (rule == DISC_NARROW) return rule;
    if (i[2] < scale) return DISC_SET;
    return is_at_surge(shape, scale, hh) ? DISC_FOUR : rule;
}

/* --- which samples are worth a look --- */

/* Tilts of the bisector from the normal, by their tangents; empty where from >= to. */
typedef struct tilts {
    double from, to;
} tilts;

/* Where the lobe's top is farther from all of the disc than that, in widths. By lobe_rule, with t
 * the tangent of the tilt, the disc is as large as `size` (1 + t^2), and the distance at least
 * t `narrow`. */
static tilts tilts_beyond(double widths, double size, double narrow)
{
    const double square = narrow * narrow - 4.0 * size * (size + widths);
    if (!(square > 0.0)) return (tilts){0.0, 0.0};
    const double sum = narrow + sqrt(square);
    return (tilts){2.0 * (size + widths) / sum, sum / (2.0 * size)};
}

/* Up to where size (1 + t^2) is no larger than that; -1: nowhere. */
static double tilt_of_size(double size, double most)
{
    return most > size ? sqrt(most / size - 1.0) : -1.0;
}

/* From where all of the disc is past a tilt; way: of the bisector. */
static double tilt_past(double tilt, double way)
{
    return tilt * way < 1.0 ? (tilt + way) / (1.0 - tilt * way) : HUGE_VAL;
}

/* Both together, where they touch; else a. */
static tilts either(tilts a, tilts b)
{
    if (!(b.from < b.to && b.from <= a.to && a.from <= b.to)) return a;
    return (tilts){fmin(a.from, b.from), fmax(a.to, b.to)};
}

/* Tilts at which lobe_rule says DISC_CENTRE: for certain in all lanes in which the disc is no
 * larger, and the bisector no shorter, than that. */
static tilts tilts_at_ease(const lobe_shape *shape, double scale, double hlen)
{
    const double way = BISECTOR_WAY * scale / hlen, wide = room_at(hlen) * widest_of(shape);
    if (shape->specular) return (tilts){way, HUGE_VAL};
    const double size = way * shape->narrow, narrow = 1.0 / widest_of(shape), wing = shape->wing;
    const double limit = sqrt(POINT_ERROR), *end = shape->end[phase_of(hlen)];
    /* Past each end, up to where the disc is too large for it. */
    tilts past = {tilt_past(wide * end[0], way), HUGE_VAL};
    for (int j = 1; j < LOBE_ENDS; j++) {
        const double most = sqrt(END_ERROR / (LOBE_BEND * (double)(1 << 2 * j)));
        past = either(past, (tilts){tilt_past(wide * end[j], way), tilt_of_size(size, most)});
    }
    /* `least` of rule_for */
    const tilts small = {-1.0, tilt_of_size(size, limit / sqrt(2.0))};
    const tilts core = either(tilts_beyond(2.0, size, narrow), small);
    /* `fall` is at most wing / (t narrow), and nowhere above the smaller of wing and its root */
    const double b = limit * narrow / (size * wing), root = sqrt(fmax(b * b - 4.0, 0.0));
    const tilts steep = {b > 2.0 ? 2.0 / (b + root) : 1.0, b > 2.0 ? 0.5 * (b + root) : 1.0};
    const tilts gentle = {-1.0, tilt_of_size(size, limit / fmin(wing, sqrt(wing)))};
    const tilts bend = either(steep, gentle);
    const tilts calm = {fmax(core.from, bend.from), fmin(core.to, bend.to)};
    return either(past, calm);
}

bool disc_watch_set(const lobe_shape *shape, const brdf_light *light, const source_disc *disc,
                    brdf_watch *out)
{
    static const double ROUNDING = 1e-12; /* of cosines, many times over */
    double scale = 0.0, hlen = 2.0;
    bool surge = false;
    for (int k = 0; k < BRDF_TILE; k++) {
        const double q = disc->scale[k];
        if (!(q > 0.0)) continue;
        scale = q > scale ? q : scale;
        hlen = light->hlen[k] < hlen ? light->hlen[k] : hlen;
        surge |= is_at_surge(shape, q, light->hh[k]);
    }
    const bool lobe = has_lobe(shape);
    tilts ease = {-1.0, HUGE_VAL};
    if (lobe) ease = hlen > 1e-3 ? tilts_at_ease(shape, scale, hlen) : (tilts){0.0, 0.0};
    const bool none = !(ease.from < ease.to);
    const double from = ease.from >= 0.0 ? 1.0 / sqrt(1.0 + ease.from * ease.from) : HUGE_VAL;
    const double to = 1.0 / sqrt(1.0 + ease.to * ease.to);
    out->kind = to > 0.0 ? BRDF_WATCH_WINGS : lobe || surge ? BRDF_WATCH_LOBE : BRDF_WATCH_SOURCE;
    for (int k = 0; k < BRDF_TILE; k++) {
        const double q = disc->scale[k];
        const bool all = none || is_at_surge(shape, q, light->hh[k]);
        out->low[k] = q > 0.0 ? q + ROUNDING : -1.0;
        out->near[k] = all ? -HUGE_VAL : from * light->hlen[k] - ROUNDING;
        out->graze[k] = to * light->hlen[k] + ROUNDING;
    }
    return scale > 0.0;
}
