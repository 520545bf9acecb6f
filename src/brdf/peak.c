#include "brdf/peak.h"

#include "base/constants.h"

#include <math.h>

/* A plane of incidence. */
typedef struct plane {
    const brdf_material *material;
    double i[3];
    double cos_phi, sin_phi; /* of the mirror side */
} plane;

/* f at a signed zenith angle, 1/sr. */
static double f_at(const plane *p, double theta_r)
{
    const double s = sin(theta_r), c = cos(theta_r);
    const double r[3] = {s * p->cos_phi, s * p->sin_phi, c};
    return brdf_material_eval(p->material, p->i, r) / (p->i[2] * c);
}

/* The maximum between two angles that has one there, by golden sections: each step keeps 0.618 of
 * the interval, 60 of them 3e-13 of it. */
static double narrow(const plane *p, double lo, double hi)
{
    static const double PART = 0.38196601125010515; /* 2 - golden ratio */
    enum { SECTIONS = 60 };
    double a = lo + PART * (hi - lo), b = hi - PART * (hi - lo);
    double f_a = f_at(p, a), f_b = f_at(p, b);
    for (int k = 0; k < SECTIONS; k++) {
        if (f_a >= f_b) {
            hi = b;
            b = a;
            f_b = f_a;
            a = lo + PART * (hi - lo);
            f_a = f_at(p, a);
        } else {
            lo = a;
            a = b;
            f_a = f_b;
            b = hi - PART * (hi - lo);
            f_b = f_at(p, b);
        }
    }
    return 0.5 * (lo + hi);
}

bool brdf_peak(const brdf_material *material, double theta_i, double phi_i, double *theta_r,
               double *f)
{
    static const double STEP = 0.02 * DEG;    /* lobes of 1 deg are climbed in 50 */
    static const double RISE = 1 + 1e-12;     /* less is rounding: a diffuse surface has no slope */
    static const double LAST = PI / 2 - 1e-6; /* closer to the horizon nothing is a maximum */
    if (!(fabs(theta_i) < LAST) || !isfinite(phi_i)) return false;
    const double s = sin(theta_i);
    const plane p = {
        material, {s * cos(phi_i), s * sin(phi_i), cos(theta_i)}, -cos(phi_i), -sin(phi_i)};
    double at = theta_i, f_here = f_at(&p, at);
    const double above = f_at(&p, fmin(at + STEP, LAST)), below = f_at(&p, fmax(at - STEP, -LAST));
    const double way = above >= below ? STEP : -STEP;
    for (double f_next; fabs(at) < LAST; at += way, f_here = f_next) {
        f_next = f_at(&p, fmax(fmin(at + way, LAST), -LAST));
        if (!(f_next > RISE * f_here)) break;
    }
    if (!(fabs(at) < LAST) || !(f_here > 0)) return false;
    const double best = narrow(&p, fmax(at - STEP, -LAST), fmin(at + STEP, LAST));
    const double f_best = f_at(&p, best);
    *theta_r = f_best > RISE * f_here ? best : at;
    *f = fmax(f_best, f_here);
    return true;
}
