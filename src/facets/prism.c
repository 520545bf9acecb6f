/* A right prism over a regular polygon. */
#include "base/constants.h"
#include "base/vec.h"
#include "facets/primitive_kinds.h"

#include <stdlib.h>

enum { RADIUS, LENGTH, SIDES, CENTRE, AXIS, MATERIAL, CAP_MATERIAL, OPEN, N_KEYS };

static const primitive_key keys[N_KEYS] = {
    [RADIUS] = {.name = "radius_m",
                .unit = "m",
                .doc = "radius of the circle through the vertices",
                .kind = KEY_NUMBER,
                .required = true,
                LENGTH_RANGE},
    [LENGTH] = {.name = "length_m",
                .unit = "m",
                .doc = "length along the axis",
                .kind = KEY_NUMBER,
                .required = true,
                LENGTH_RANGE},
    [SIDES] = {.name = "sides",
               .unit = "",
               .doc = "number of sides",
               .kind = KEY_COUNT,
               .required = true,
               .min = 3,
               .max = 10000},
    [CENTRE] = CENTRE_KEY,
    [AXIS] = {.name = "axis",
              .unit = "",
              .doc = "direction of the axis",
              .kind = KEY_DIRECTION,
              .def = {0, 0, 1}},
    [MATERIAL] = {.name = "material",
                  .unit = "",
                  .doc = "material of the sides",
                  .kind = KEY_MATERIAL,
                  .required = true},
    [CAP_MATERIAL] = {.name = "cap_material",
                      .unit = "",
                      .doc = "material of the caps; absent: that of the sides",
                      .kind = KEY_MATERIAL},
    [OPEN] = {.name = "open",
              .unit = "",
              .doc = "true leaves the caps out",
              .kind = KEY_SWITCH,
              .max = 1},
};

/* Unit axis, and the unit direction of the first vertex: x or y, whichever is less along the axis,
 * made perpendicular. x where both are alike: nearer than PARALLEL_RAD they differ by rounding. */
static void directions(const primitive_spec *spec, double axis[3], double first[3])
{
    static const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
    unit3(spec->value[AXIS], axis);
    perp3(fabs(axis[1]) < fabs(axis[0]) - PARALLEL_RAD ? y : x, axis, first);
}

/* The two ends, n vertices each, right-handed about the axis: bottom[k] and top[k] share a side. */
static void rings(const primitive_spec *spec, const double axis[3], const double first[3],
                  double (*bottom)[3], double (*top)[3])
{
    const int n = (int)spec->value[SIDES][0];
    const double half_m = 0.5 * spec->value[LENGTH][0], radius_m = spec->value[RADIUS][0];
    double second[3];
    cross3(axis, first, second);
    for (int k = 0; k < n; k++) {
        const double angle = k * (TWO_PI / n);
        double p[3];
        add_scaled3(spec->value[CENTRE], radius_m * cos(angle), first, p);
        add_scaled3(p, radius_m * sin(angle), second, p);
        add_scaled3(p, -half_m, axis, bottom[k]);
        add_scaled3(p, half_m, axis, top[k]);
    }
}

static glint_status add_sides(const primitive_spec *spec, const double axis[3],
                              const double (*bottom)[3], const double (*top)[3], int component,
                              facet_list *out, glint_error *error)
{
    const int n = (int)spec->value[SIDES][0];
    for (int k = 0; k < n; k++) {
        const int next = (k + 1) % n;
        double side[4][3];
        copy3(bottom[k], side[0]), copy3(bottom[next], side[1]);
        copy3(top[next], side[2]), copy3(top[k], side[3]);
        const glint_status status =
            facet_list_add(out, side, 4, axis, spec->material[MATERIAL], component, error);
        if (status) return status;
    }
    return GLINT_OK;
}

/* Reverses the bottom ring, so that it runs anticlockwise seen from below. */
static glint_status add_caps(const primitive_spec *spec, const double first[3], double (*bottom)[3],
                             const double (*top)[3], int component, facet_list *out,
                             glint_error *error)
{
    const int n = (int)spec->value[SIDES][0];
    const int material = spec->material[CAP_MATERIAL] != PRIMITIVE_NO_MATERIAL
                             ? spec->material[CAP_MATERIAL]
                             : spec->material[MATERIAL];
    for (int a = 0, b = n - 1; a < b; a++, b--) {
        double swap[3];
        copy3(bottom[a], swap), copy3(bottom[b], bottom[a]), copy3(swap, bottom[b]);
    }
    const glint_status status = facet_list_add(out, top, n, first, material, component, error);
    return status ? status : facet_list_add(out, bottom, n, first, material, component, error);
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_error *error)
{
    const int n = (int)spec->value[SIDES][0];
    double axis[3], first[3];
    directions(spec, axis, first);
    double(*bottom)[3] = malloc(2 * (size_t)n * sizeof *bottom);
    if (!bottom) return error_no_memory(error);
    double(*top)[3] = bottom + n;
    rings(spec, axis, first, bottom, top);
    glint_status status = add_sides(spec, axis, bottom, top, component, out, error);
    if (!status && spec->value[OPEN][0] == 0.0)
        status = add_caps(spec, first, bottom, top, component, out, error);
    free(bottom);
    return status;
}

static void centre(const primitive_spec *spec, double out[3])
{
    copy3(spec->value[CENTRE], out);
}

const primitive_kind primitive_prism = {
    .name = "prism",
    .doc = "right prism over a regular polygon; its vertices stand at k 360/sides deg, "
           "right-handed about the axis, from the first of x and y that is perpendicular to or "
           "least along it, made perpendicular. Tangents: the axis on the sides, that first "
           "direction on the caps",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = NULL,
    .build = build,
    .centre = centre,
};
