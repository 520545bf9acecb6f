#include "facets/revolved.h"

#include "base/constants.h"
#include "base/vec.h"

#include <stdlib.h>

glint_status check_resolution(const primitive_spec *spec, int count_key, int tolerance_key,
                              glint_errors *errors)
{
    if (!spec->given[count_key] || !spec->given[tolerance_key]) return GLINT_OK;
    return errors_add(errors, GLINT_INPUT, spec->key_place[tolerance_key],
                      "both %s and %s are given; expected one of them",
                      spec->kind->keys[count_key].name, spec->kind->keys[tolerance_key].name);
}

glint_status check_ends(const primitive_spec *spec, int cap_key, int inside_key, int open_key,
                        glint_errors *errors)
{
    const bool open = spec->value[open_key][0] != 0.0;
    if (open && spec->given[cap_key])
        return errors_add(
            errors, GLINT_INPUT, spec->key_place[cap_key],
            "cap_material is given, but open = true leaves the caps out; expected one "
            "of them");
    if (!open && inside_key >= 0 && spec->given[inside_key])
        return errors_add(errors, GLINT_INPUT, spec->key_place[inside_key],
                          "inside_material is given, but caps hide the inside; expected open = "
                          "true beside it");
    return GLINT_OK;
}

int sides_of(const primitive_spec *spec, int sides_key, int tolerance_key, double radius_m)
{
    if (!spec->given[tolerance_key]) return (int)spec->value[sides_key][0];
    /* The middle of a side lies r (1 - cos(pi/n)) = 2 r sin^2(pi/2n) inside the circle. */
    const double part = spec->value[tolerance_key][0] / (2.0 * radius_m);
    if (part >= 0.25) return SIDES_MIN; /* 2 sin^2(30 deg) / 2 */
    const double n =
        ceil(PI / (2.0 * asin(sqrt(part))) - 1e-9); /* as many as fit but for rounding */
    return n < SIDES_MIN ? SIDES_MIN : n > SIDES_MAX ? SIDES_MAX : (int)n;
}

void revolved_axes(const double axis[3], double unit_axis[3], double first[3])
{
    static const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
    unit3(axis, unit_axis);
    perp3(fabs(unit_axis[1]) < fabs(unit_axis[0]) - PARALLEL_RAD ? y : x, unit_axis, first);
}

void disc_axes(const primitive_spec *spec, int normal_key, int tangent_key, double normal[3],
               double first[3])
{
    revolved_axes(spec->value[normal_key], normal, first);
    if (spec->given[tangent_key]) perp3(spec->value[tangent_key], normal, first);
}

void revolved_ring(const double centre_m[3], const double axis[3], const double first[3],
                   double radius_m, int n, double (*out)[3])
{
    double second[3];
    cross3(axis, first, second);
    for (int k = 0; k < n; k++) {
        const double angle = k * (TWO_PI / n);
        add_scaled3(centre_m, radius_m * cos(angle), first, out[k]);
        add_scaled3(out[k], radius_m * sin(angle), second, out[k]);
    }
}

/* The sides from outside or, run through backwards, from inside. */
static glint_status add_sides(const frustum *f, const double (*bottom)[3], const double (*top)[3],
                              int surface, bool inside, int component, facet_list *out,
                              glint_error *error)
{
    const int corners = f->top_m > 0.0 ? 4 : 3;
    for (int k = 0; k < f->sides; k++) {
        const int next = (k + 1) % f->sides;
        double side[4][3], along[3];
        copy3(bottom[k], side[0]), copy3(bottom[next], side[1]);
        copy3(top[next], side[2]), copy3(top[k], side[3]);
        if (inside) reverse_points(side, corners);
        for (int j = 0; j < 3; j++) /* from the middle of the bottom edge to that of the top edge */
            along[j] = top[k][j] + top[next][j] - bottom[k][j] - bottom[next][j];
        const double *tangent = f->bottom_m == f->top_m ? f->axis : along;
        const glint_status status =
            facet_list_add(out, side, corners, tangent, inside ? f->inside_material : f->material,
                           component, error);
        if (status) return status;
        out->items[out->n - 1].surface = surface;
    }
    return GLINT_OK;
}

static glint_status add_surface(const frustum *f, facet_list *out, int *surface, glint_error *error)
{
    *surface = 0;
    if (!f->round) return GLINT_OK;
    curved_surface cone = {.kind = SURFACE_CONE};
    copy3(f->centre_m, cone.centre_m);
    copy3(f->axis, cone.axis);
    const double inwards_m = f->bottom_m - f->top_m;
    cone.lean = inwards_m / hypot(inwards_m, f->length_m);
    return facet_list_add_surface(out, &cone, surface, error);
}

glint_status frustum_build(const frustum *f, int component, facet_list *out, glint_error *error)
{
    const int n = f->sides;
    double low_m[3], high_m[3];
    double(*bottom)[3] = malloc(2 * (size_t)n * sizeof *bottom);
    if (!bottom) return error_no_memory(error);
    double(*top)[3] = bottom + n;
    add_scaled3(f->centre_m, -0.5 * f->length_m, f->axis, low_m);
    add_scaled3(f->centre_m, 0.5 * f->length_m, f->axis, high_m);
    revolved_ring(low_m, f->axis, f->first, f->bottom_m, n, bottom);
    revolved_ring(high_m, f->axis, f->first, f->top_m, n, top);
    int surface;
    glint_status status = add_surface(f, out, &surface, error);
    if (!status) status = add_sides(f, bottom, top, surface, false, component, out, error);
    if (!status && !f->open && f->top_m > 0.0)
        status = facet_list_add(out, top, n, f->first, f->cap_material, component, error);
    if (!status && f->inside_material != PRIMITIVE_NO_MATERIAL)
        status = add_sides(f, bottom, top, surface, true, component, out, error);
    if (!status && !f->open) {
        reverse_points(bottom, n);
        status = facet_list_add(out, bottom, n, f->first, f->cap_material, component, error);
    }
    free(bottom);
    return status;
}
