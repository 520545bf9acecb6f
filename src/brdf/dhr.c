/* dhr.c: directional-hemispherical reflectance by adaptive quadrature over half vectors.
 *
 * A direction r above the facet is given by its half vector, and that by its slopes (s, t): H = i +
 * r is parallel to (s, t, 1). All lobes are high near s = t = 0, the mirror direction, whatever the
 * incidence. With q = 1 + s^2 + t^2 and m = s i.t + t i.b + ci:
 *     H = (2 m / q) (s, t, 1),   cr = 2 m / q - ci,   dOmega_r = (4 m / q^2) ds dt
 * (dOmega_r = 4 (i.h) dOmega_h, dOmega_h = h_n^3 ds dt, i.h = m / sqrt(q)). cr > 0 is the inside of
 * the circle around tan(theta_i) (cos phi_i, sin phi_i) of the radius 1 / ci, which holds the
 * origin.
 *
 * Polar coordinates around the origin: in the radius rho = R v^4, v = 1 - (1 - w)^2, 0 <= w <= 1,
 * where R is the circle's: the power resolves lobes down to slopes of 1e-6, and the square makes
 * the roots smooth that some models have at grazing observation. The azimuth runs over quadrants.
 * Each lobe is integrated by itself, since their widths differ. What mirrors reflect is known
 * without. */
#include "brdf/dhr.h"

#include "base/constants.h"
#include "base/grow.h"
#include "base/kronrod.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = KRONROD_POINTS, SAMPLES = POINTS * POINTS };

/* 5 million samples: about 20 ms. */
enum { MAX_CELLS = 22000 };

/* What is integrated. */
typedef struct integral {
    brdf_material lobe; /* one lobe; borrowed */
    double i[3];        /* unit, facet frame */
    double tan_i;
    /* The azimuth is counted from this direction in the facet's plane: the azimuth of i where the
     * lobe is isotropic, and then half a turn is enough; else the tangent. */
    double from[2];
    bool isotropic;
} integral;

/* A rectangle: 0 <= w <= 1 in the radius, 0 <= y <= 1 in the azimuth of a quadrant. */
typedef struct cell {
    int quadrant;
    double w, y, dw, dy;
    double value, error;
    bool split_w; /* the radius is where the error comes from */
} cell;

typedef struct cell_list {
    cell *cells; /* owned */
    int n, capacity;
} cell_list;

/* A ray of constant azimuth. */
typedef struct ray {
    double direction[2]; /* unit, in the facet's plane */
    double i_along;      /* i . direction */
    double radius;       /* slope where cr = 0 */
    double weight;       /* d azimuth / dy */
} ray;

/* The azimuth in a quadrant. A lobe that is much wider along one axis is a ridge in azimuth, at an
 * edge of its quadrants: y^4 / (y^4 + (1-y)^4) gathers the points there. */
static ray make_ray(const integral *it, int quadrant, double y)
{
    double share = y, slope = 1.0;
    if (!it->isotropic) {
        const double z = 1.0 - y, a = y * y * y * y, b = z * z * z * z, sum = a + b;
        share = a / sum;
        slope = 4.0 * y * y * y * z * z * z / (sum * sum);
    }
    const double angle = 0.5 * PI * share, c0 = cos(angle), s0 = sin(angle);
    const double c = quadrant % 2 ? -s0 : c0, s = quadrant % 2 ? c0 : s0;
    const double sign = quadrant / 2 ? -1.0 : 1.0;
    ray out = {.direction = {sign * (c * it->from[0] - s * it->from[1]),
                             sign * (c * it->from[1] + s * it->from[0])},
               .weight = 0.5 * PI * slope};
    out.i_along = it->i[0] * out.direction[0] + it->i[1] * out.direction[1];
    const double t = out.i_along / it->i[2], root = sqrt(1.0 + t * t);
    out.radius = t > 0.0 ? t + root : 1.0 / (root - t);
    return out;
}

/* Puts a pair of directions into a lane; returns dOmega_r / dw dy. */
static double set_lane(brdf_light *light, int lane, const integral *it, const ray *along, double w)
{
    const double v = w * (2.0 - w), v3 = v * v * v, rho = along->radius * v * v3;
    const double q = 1.0 + rho * rho, m = rho * along->i_along + it->i[2], k = 2.0 * m / q;
    const double h[3] = {k * rho * along->direction[0], k * rho * along->direction[1], k};
    for (int j = 0; j < 3; j++) {
        light->i[j][lane] = it->i[j];
        light->r[j][lane] = h[j] - it->i[j];
        light->h[j][lane] = h[j];
    }
    light->hh[lane] = k * k * q;
    light->hlen[lane] = k * sqrt(q);
    const double drho_dw = along->radius * 8.0 * v3 * (1.0 - w);
    return 4.0 * m / (q * q) * rho * drho_dw * along->weight;
}

/* g dOmega_r / dw dy at SAMPLES points: azimuth by azimuth, the radius inside. */
static void sample(const integral *it, const cell *c, double out[SAMPLES])
{
    static const double zero = 0.0, one = 1.0;
    const brdf_facets facet = {.n = 1,
                               .normal = {&zero, &zero, &one},
                               .tangent = {&one, &zero, &zero},
                               .bitangent = {&zero, &one, &zero},
                               .area = &one};
    ray rays[POINTS];
    for (int a = 0; a < POINTS; a++)
        rays[a] = make_ray(it, c->quadrant, c->y + c->dy * KRONROD_NODES[a]);
    for (int first = 0; first < SAMPLES; first += BRDF_TILE) {
        brdf_light light;
        double jacobian[BRDF_TILE], g[BRDF_TILE] = {0};
        for (int k = 0; k < BRDF_TILE; k++) {
            const int s = first + k < SAMPLES ? first + k : SAMPLES - 1;
            const double w = c->w + c->dw * KRONROD_NODES[s % POINTS];
            jacobian[k] = set_lane(&light, k, it, &rays[s / POINTS], w);
        }
        brdf_material_tile(&it->lobe, &facet, &light, NULL, g);
        for (int k = 0; k < BRDF_TILE && first + k < SAMPLES; k++)
            out[first + k] = jacobian[k] * g[k];
    }
}

/* The error of Kronrod's rule from its difference to Gauss's: that difference is the error of the
 * weaker rule, and the better one's falls as its power 3/2 or faster (Piessens et al. 1983,
 * QUADPACK, section 2.2.4.2); never taken below the rounding. */
static double rule_error(double difference, double value)
{
    const double size = fabs(value), d = fabs(difference);
    if (!(size > 0.0)) return d;
    return fmax(fmin(d, size * pow(200.0 * d / size, 1.5)), 1e-15 * size);
}

static void integrate_cell(const integral *it, cell *c)
{
    double f[SAMPLES], value = 0.0, gauss_w = 0.0, gauss_y = 0.0;
    sample(it, c, f);
    for (int a = 0; a < POINTS; a++) {
        double along = 0.0, along_gauss = 0.0;
        for (int b = 0; b < POINTS; b++) {
            along += KRONROD[b] * f[a * POINTS + b];
            along_gauss += KRONROD_GAUSS[b] * f[a * POINTS + b];
        }
        value += KRONROD[a] * along;
        gauss_w += KRONROD[a] * along_gauss;
        gauss_y += KRONROD_GAUSS[a] * along;
    }
    const double area = c->dw * c->dy;
    const double error_w = rule_error(value - gauss_w, value);
    const double error_y = rule_error(value - gauss_y, value);
    c->value = area * value;
    c->error = area * (error_w + error_y);
    c->split_w = error_w >= error_y;
}

static bool add_cell(cell_list *list, const cell *c)
{
    if (!grow_room(&list->cells, &list->capacity, list->n + 1L, sizeof *list->cells)) return false;
    list->cells[list->n++] = *c;
    return true;
}

/* Cells that no lobe slips through: each spans a factor of 16 or so in the radius. */
static bool first_cells(const integral *it, cell_list *list)
{
    static const double edges[] = {0.0, 0.06, 0.13, 0.27, 0.5, 1.0};
    enum { RINGS = sizeof edges / sizeof edges[0] - 1 };
    const int quadrants = it->isotropic ? 2 : 4;
    for (int k = 0; k < quadrants; k++)
        for (int ring = 0; ring < RINGS; ring++) {
            cell c = {
                .quadrant = k, .w = edges[ring], .dw = edges[ring + 1] - edges[ring], .dy = 1};
            integrate_cell(it, &c);
            if (!add_cell(list, &c)) return false;
        }
    return true;
}

/* Halves cell k along the coordinate that its error comes from. */
static bool split_cell(const integral *it, cell_list *list, int k)
{
    cell a = list->cells[k];
    if (a.split_w)
        a.dw *= 0.5;
    else
        a.dy *= 0.5;
    cell b = a;
    if (a.split_w)
        b.w += a.dw;
    else
        b.y += a.dy;
    integrate_cell(it, &a);
    integrate_cell(it, &b);
    list->cells[k] = a;
    return add_cell(list, &b);
}

static void add_up(const cell_list *list, double *value, double *error)
{
    *value = *error = 0.0;
    for (int k = 0; k < list->n; k++) {
        *value += list->cells[k].value;
        *error += list->cells[k].error;
    }
}

/* Splits what has more than its share of the error allowed, until the sum is good enough. False
 * when memory is out. */
static bool integrate(const integral *it, double tolerance, double *value, double *error)
{
    cell_list list = {0};
    bool good = first_cells(it, &list);
    for (;;) {
        add_up(&list, value, error);
        if (!good || *error <= tolerance * *value || list.n >= MAX_CELLS) break;
        const double share = tolerance * *value / list.n;
        const int n = list.n;
        for (int k = 0; k < n && good; k++)
            if (list.cells[k].error > share) good = split_cell(it, &list, k);
    }
    free(list.cells);
    const double turns = it->isotropic ? 2.0 : 1.0;
    *value *= turns / it->i[2];
    *error *= turns / it->i[2];
    return good;
}

glint_status brdf_dhr(const brdf_material *material, double theta_i, double phi_i,
                      double relative_tolerance, double *dhr, double *error_bound,
                      glint_error *error)
{
    const double ci = cos(theta_i), si = sin(theta_i);
    if (!(theta_i >= 0.0 && theta_i < 0.5 * PI && ci > BRDF_EDGE && isfinite(phi_i)))
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "incidence of %g deg; expected 0 to below 90 deg", theta_i / DEG);
    const double tolerance = fmax(relative_tolerance, 1e-12);
    const double azimuth[2] = {cos(phi_i), sin(phi_i)};
    double sum = 0.0, bound = 0.0;
    for (int k = 0; k < material->n_lobes; k++) {
        const bool isotropic = material->lobes[k].model->flags & BRDF_ISOTROPIC;
        const integral it = {.lobe = {.n_lobes = 1, .lobes = &material->lobes[k]},
                             .i = {si * azimuth[0], si * azimuth[1], ci},
                             .from = {isotropic ? azimuth[0] : 1.0, isotropic ? azimuth[1] : 0.0},
                             .isotropic = isotropic};
        double value, value_error;
        if (!integrate(&it, tolerance, &value, &value_error)) return error_no_memory(error);
        sum += value;
        bound += value_error;
    }
    sum += brdf_material_specular(material, ci);
    *dhr = sum;
    if (error_bound) *error_bound = bound;
    if (bound <= tolerance * sum * (1.0 + 1e-9)) return GLINT_OK;
    return error_set(error, GLINT_INPUT, PLACE_NONE,
                     "the reflectance at %g deg of incidence could be found to %.1g only, not to "
                     "%.1g",
                     theta_i / DEG, bound, tolerance * sum);
}

#define SCAN_TOLERANCE 1e-3 /* relative: enough to find the largest */

/* True when the material surely reflects more than it gets at this incidence. What comes near 1 in
 * the first look, which is good to about SCAN_TOLERANCE, is looked at again. */
static bool gains_at(const brdf_material *material, double theta_i, double phi_i, double *dhr)
{
    static const double in_doubt = 10.0 * SCAN_TOLERANCE, surplus = 1e-6;
    const double fine = brdf_material_is_measured(material) ? 1e-5 : 1e-7;
    double bound = 0.0;
    *dhr = 0.0;
    (void)brdf_dhr(material, theta_i, phi_i, SCAN_TOLERANCE, dhr, &bound, NULL);
    if (fabs(*dhr - 1.0) <= bound + in_doubt)
        (void)brdf_dhr(material, theta_i, phi_i, fine, dhr, &bound, NULL);
    return *dhr - bound > 1.0 + surplus;
}

static bool is_isotropic(const brdf_material *material)
{
    for (int k = 0; k < material->n_lobes; k++)
        if (!(material->lobes[k].model->flags & BRDF_ISOTROPIC)) return false;
    return true;
}

bool brdf_energy_gain(const brdf_material *material, brdf_energy *worst)
{
    static const double theta_deg[] = {0, 30, 60, 75, 85};
    static const double phi_deg[] = {0, 90};
    const size_t n_phi = is_isotropic(material) ? 1 : sizeof phi_deg / sizeof phi_deg[0];
    bool gains = false;
    *worst = (brdf_energy){0};
    for (size_t a = 0; a < sizeof theta_deg / sizeof theta_deg[0]; a++)
        for (size_t b = 0; b < (a == 0 ? 1 : n_phi); b++) {
            const double theta_i = theta_deg[a] * DEG, phi_i = phi_deg[b] * DEG;
            double dhr;
            if (gains_at(material, theta_i, phi_i, &dhr)) gains = true;
            if (dhr > worst->dhr * (1.0 + SCAN_TOLERANCE))
                *worst = (brdf_energy){theta_i, phi_i, dhr};
        }
    return gains;
}
