#include "facets/crinkle.h"

#include "base/constants.h"
#include "base/random.h"
#include "base/text.h"
#include "base/vec.h"

#include <stdlib.h>

/* A crinkled rectangle in the making: (n + 1)^2 heights, row after row along the first side. */
typedef struct foil {
    const rectangle *rectangle;
    int n;
    double *height;           /* owned; m along the normal, before scaling */
    bool *falling;            /* owned; n^2: which diagonal divides a cell */
    double first_m, second_m; /* sides of a cell */
    double normal[3];
} foil;

/* The corners of triangle `which` (0, 1) of a cell, as steps along the sides, anticlockwise. */
static void triangle_steps(const foil *f, int column, int row, int which, int out[3][2])
{
    static const int steps[2][2][3][2] = {{{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}},
                                          {{{0, 0}, {1, 0}, {0, 1}}, {{1, 0}, {1, 1}, {0, 1}}}};
    for (int k = 0; k < 3; k++) {
        out[k][0] = column + steps[f->falling[row * f->n + column]][which][k][0];
        out[k][1] = row + steps[f->falling[row * f->n + column]][which][k][1];
    }
}

/* The slopes of a triangle along the two sides, before scaling. */
static void slopes_of(const foil *f, int corner[3][2], double out[2])
{
    double h[3], u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = corner[k][0] * f->first_m;
        v[k] = corner[k][1] * f->second_m;
        h[k] = f->height[corner[k][1] * (f->n + 1) + corner[k][0]];
    }
    const double u1 = u[1] - u[0], u2 = u[2] - u[0], v1 = v[1] - v[0], v2 = v[2] - v[0];
    const double h1 = h[1] - h[0], h2 = h[2] - h[0], twice = u1 * v2 - u2 * v1;
    out[0] = (h1 * v2 - h2 * v1) / twice;
    out[1] = (h2 * u1 - h1 * u2) / twice;
}

/* Mean square of the tilt when the heights are scaled, rad^2. All triangles have the same projected
 * area. */
static double tilt2_when(const foil *f, double scale)
{
    double sum = 0.0;
    for (int cell = 0; cell < f->n * f->n; cell++)
        for (int which = 0; which < 2; which++) {
            int corner[3][2];
            double slope[2];
            triangle_steps(f, cell % f->n, cell / f->n, which, corner);
            slopes_of(f, corner, slope);
            const double tilt = atan(scale * hypot(slope[0], slope[1]));
            sum += tilt * tilt;
        }
    return sum / (2.0 * f->n * f->n);
}

/* By which the heights are to be multiplied: the tilt grows with it, so halving finds it. */
static double scale_for(const foil *f, double tilt_rms_rad)
{
    const double wanted = tilt_rms_rad * tilt_rms_rad;
    double lo = 0.0, hi = 1.0;
    while (tilt2_when(f, hi) < wanted)
        hi *= 2.0;
    for (int k = 0; k < 60; k++) { /* to the last digit */
        const double middle = 0.5 * (lo + hi);
        if (tilt2_when(f, middle) < wanted)
            lo = middle;
        else
            hi = middle;
    }
    return 0.5 * (lo + hi);
}

static void make_heights(foil *f, const crinkle *c, uint64_t face)
{
    const int n = f->n;
    uint64_t state = c->seed, other = face;
    state ^= random_next(&other); /* faces far apart in the sequence */
    random_next(&state);
    /* Of the order of a cell, so that slopes are of the order of 1. */
    const double unit_m = fmin(f->first_m, f->second_m);
    for (int row = 1; row < n; row++)
        for (int column = 1; column < n; column++)
            f->height[row * (n + 1) + column] = unit_m * random_normal(&state);
    for (int cell = 0; cell < n * n; cell++)
        f->falling[cell] = random_next(&state) >> 63;
    const double scale = scale_for(f, c->tilt_rms_rad);
    for (int k = 0; k < (n + 1) * (n + 1); k++)
        f->height[k] *= scale;
}

static void point_at(const foil *f, const int step[2], double out[3])
{
    const double u = (double)step[0] / f->n, v = (double)step[1] / f->n;
    add_scaled3(f->rectangle->corner_m, u, f->rectangle->first_m, out);
    add_scaled3(out, v, f->rectangle->second_m, out);
    add_scaled3(out, f->height[step[1] * (f->n + 1) + step[0]], f->normal, out);
}

/* Adds a triangle, with its tilt along the rectangle's tangent and across it. */
static void count(const foil *f, const facet *triangle, crinkle_sums *sums)
{
    double along[3], across[3];
    perp3(f->rectangle->tangent, f->normal, along);
    cross3(f->normal, along, across);
    const double c = dot3(triangle->normal, f->normal), projected_m2 = c * triangle->area_m2;
    const double x = atan2(dot3(triangle->normal, along), c);
    const double y = atan2(dot3(triangle->normal, across), c);
    const double tilt = angle3(triangle->normal, f->normal);
    sums->n_facets++;
    sums->projected_m2 += projected_m2;
    sums->area_m2 += triangle->area_m2;
    sums->along2 += projected_m2 * x * x;
    sums->across2 += projected_m2 * y * y;
    sums->all2 += projected_m2 * tilt * tilt;
    sums->most_rad = fmax(sums->most_rad, tilt);
}

static glint_status add_triangle(const foil *f, int cell, int which, int surface, int component,
                                 facet_list *out, crinkle_sums *sums, glint_error *error)
{
    const rectangle *r = f->rectangle;
    int step[3][2];
    double corner[3][3];
    triangle_steps(f, cell % f->n, cell / f->n, which, step);
    for (int k = 0; k < 3; k++)
        point_at(f, step[k], corner[k]);
    const int at = out->n;
    const glint_status status =
        add_two_sided(out, corner, 3, r->tangent, r->material, r->back_material, component, error);
    if (!status) count(f, &out->items[at], sums);
    for (int k = at; k < out->n; k++)
        out->items[k].surface = surface;
    return status;
}

glint_status rectangle_crinkle(const rectangle *r, const crinkle *c, uint64_t face, int component,
                               facet_list *out, crinkle_sums *sums, glint_error *error)
{
    const int n = c->facets_per_side;
    foil f = {.rectangle = r, .n = n};
    f.first_m = norm3(r->first_m) / n;
    f.second_m = norm3(r->second_m) / n;
    cross3(r->first_m, r->second_m, f.normal);
    unit3(f.normal, f.normal);
    f.height = calloc((size_t)(n + 1) * (size_t)(n + 1), sizeof *f.height);
    f.falling = malloc((size_t)n * (size_t)n * sizeof *f.falling);
    glint_status status = f.height && f.falling ? GLINT_OK : error_no_memory(error);
    if (!status) make_heights(&f, c, face);
    curved_surface flat = {.kind = SURFACE_FOIL};
    int surface = 0;
    copy3(f.normal, flat.axis);
    if (!status) status = facet_list_add_surface(out, &flat, &surface, error);
    for (int cell = 0; cell < n * n && !status; cell++)
        for (int which = 0; which < 2 && !status; which++)
            status = add_triangle(&f, cell, which, surface, component, out, sums, error);
    free(f.height);
    free(f.falling);
    return status;
}

void crinkle_report(const primitive_spec *spec, const crinkle_sums *sums)
{
    if (!spec->report || sums->n_facets == 0) return;
    const double all = sums->projected_m2;
    text_printf(
        spec->report,
        "%s of crinkled foil: %d facets, tilted by %.4g deg rms (%.4g along the tangent, %.4g "
        "across it), at most %.4g; their area is %.6g of the outline's\n",
        spec->kind->name, sums->n_facets, sqrt(sums->all2 / all) / DEG,
        sqrt(sums->along2 / all) / DEG, sqrt(sums->across2 / all) / DEG, sums->most_rad / DEG,
        sums->area_m2 / all);
}
