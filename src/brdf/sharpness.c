#include "brdf/sharpness.h"

#include "base/constants.h"
#include "base/vec.h"

#include <math.h>

/* The tilts at which lobes are looked at: STEPS of them, evenly in their logarithm. */
enum { STEPS = 56 };
#define NARROWEST 1e-7 /* rad */

#define PART 0.39346934028736658 /* 1 - exp(-1/2) */
#define FLAT 0.2                 /* a range of values below this part of the largest is no lobe */

/* One way to look at a lobe: the bisector leaves the normal along one axis of the facet's frame,
 * and the two directions lie on both sides of it along the other. */
typedef struct profile {
    const brdf_lobe *lobe;
    int axis;                                 /* 0 along the tangent, 1 across it */
    double half_phase;                        /* rad */
    double tilt[STEPS], f[STEPS], top, floor; /* rad, 1/sr */
} profile;

/* f at a tilt of the bisector, 1/sr. */
static double f_at(const profile *p, double tilt)
{
    const double c = cos(p->half_phase), s = sin(p->half_phase);
    double i[3], r[3];
    i[p->axis] = r[p->axis] = sin(tilt) * c;
    i[2] = r[2] = cos(tilt) * c;
    i[1 - p->axis] = s, r[1 - p->axis] = -s;
    return p->lobe->model->eval(brdf_lobe_coef(p->lobe), i, r) / (i[2] * r[2]);
}

static void look(profile *p)
{
    const double factor = pow(SHARPNESS_BROAD / NARROWEST, 1.0 / (STEPS - 1));
    p->top = f_at(p, 0.0);
    p->floor = fmin(p->top, f_at(p, 2 * SHARPNESS_BROAD));
    for (int k = 0; k < STEPS; k++) {
        p->tilt[k] = NARROWEST * pow(factor, k);
        p->f[k] = f_at(p, p->tilt[k]);
        p->floor = fmin(p->floor, p->f[k]);
    }
}

/* The highest value over the floor, 1/sr; 0 where that is no lobe. */
static double height_of(const profile *p)
{
    double most = p->top;
    for (int k = 0; k < STEPS; k++)
        most = fmax(most, p->f[k]);
    return most - p->floor > FLAT * most ? most - p->floor : 0.0;
}

static double width_of(const profile *p, double height)
{
    const double change = PART * height;
    int k = 0;
    while (k < STEPS && !(fabs(p->f[k] - p->top) >= change))
        k++;
    if (k == STEPS) return HUGE_VAL;
    double lo = k ? p->tilt[k - 1] : 0.0, hi = p->tilt[k];
    for (int step = 0; step < 40; step++) { /* 2^-40: past the digits of any use */
        const double middle = 0.5 * (lo + hi);
        if (fabs(f_at(p, middle) - p->top) >= change)
            hi = middle;
        else
            lo = middle;
    }
    return hi;
}

static double reach_of(const profile *p, double height)
{
    int k = STEPS;
    while (k > 0 && p->f[k - 1] - p->floor <= SHARPNESS_TAIL * height)
        k--;
    return k == STEPS ? HUGE_VAL : p->tilt[k];
}

void brdf_lobe_sharpness(const brdf_lobe *lobe, brdf_sharpness *out)
{
    static const double HALF_PHASES[] = {0.0, 30.0 * DEG};
    for (int axis = 0; axis < 2; axis++) {
        out->width[axis] = HUGE_VAL;
        out->reach[axis] = 0.0;
        for (int g = 0; g < 2; g++) {
            profile p = {.lobe = lobe, .axis = axis, .half_phase = HALF_PHASES[g]};
            look(&p);
            const double height = height_of(&p);
            if (!(height > 0.0)) continue;
            out->width[axis] = fmin(out->width[axis], width_of(&p, height));
            out->reach[axis] = fmax(out->reach[axis], reach_of(&p, height));
        }
        if (out->width[axis] == HUGE_VAL) out->reach[axis] = HUGE_VAL;
    }
}

double brdf_material_width(const brdf_material *material)
{
    double width = HUGE_VAL;
    for (int k = 0; k < material->n_lobes; k++) {
        if (material->lobes[k].weight == 0.0) continue;
        if (material->lobes[k].model->specular) return 0.0;
        brdf_sharpness s;
        brdf_lobe_sharpness(&material->lobes[k], &s);
        width = fmin(width, fmin(s.width[0], s.width[1]));
    }
    return width;
}
