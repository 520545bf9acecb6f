/* A round cylinder. */
#include "base/vec.h"
#include "facets/revolved.h"

enum {
    RADIUS,
    LENGTH,
    SIDES,
    TOLERANCE,
    CENTRE,
    AXIS,
    MATERIAL,
    CAP_MATERIAL,
    INSIDE_MATERIAL,
    OPEN,
    N_KEYS
};

static const primitive_key keys[N_KEYS] = {
    [RADIUS] = {.name = "radius_m",
                .unit = "m",
                .doc = "radius; the corners of the facets lie on it",
                .kind = KEY_NUMBER,
                .required = true,
                LENGTH_RANGE},
    [LENGTH] = {.name = "length_m",
                .unit = "m",
                .doc = "length along the axis",
                .kind = KEY_NUMBER,
                .required = true,
                LENGTH_RANGE},
    [SIDES] = SIDES_KEY,
    [TOLERANCE] = TOLERANCE_KEY,
    [CENTRE] = CENTRE_KEY,
    [AXIS] = {.name = "axis",
              .unit = "",
              .doc = "direction of the axis",
              .kind = KEY_DIRECTION,
              .def = {0, 0, 1}},
    [MATERIAL] = {.name = "material",
                  .unit = "",
                  .doc = "material of the side",
                  .kind = KEY_MATERIAL,
                  .required = true},
    [CAP_MATERIAL] = {.name = "cap_material",
                      .unit = "",
                      .doc = "material of the caps; absent: that of the sides",
                      .kind = KEY_MATERIAL},
    [INSIDE_MATERIAL] = {.name = "inside_material",
                         .unit = "",
                         .doc = "material of the inside of an open one; absent: black",
                         .kind = KEY_MATERIAL},
    [OPEN] = {.name = "open",
              .unit = "",
              .doc = "true leaves the caps out",
              .kind = KEY_SWITCH,
              .max = 1},
};

static glint_status check(const primitive_spec *spec, glint_errors *errors)
{
    const glint_status ends = check_ends(spec, CAP_MATERIAL, INSIDE_MATERIAL, OPEN, errors);
    const glint_status count = check_resolution(spec, SIDES, TOLERANCE, errors);
    return ends ? ends : count;
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    const double radius_m = spec->value[RADIUS][0];
    frustum cylinder = {.length_m = spec->value[LENGTH][0],
                        .bottom_m = radius_m,
                        .top_m = radius_m,
                        .sides = sides_of(spec, SIDES, TOLERANCE, radius_m),
                        .round = true,
                        .open = spec->value[OPEN][0] != 0.0,
                        .material = spec->material[MATERIAL],
                        .cap_material = material_or(spec, CAP_MATERIAL, MATERIAL),
                        .inside_material = spec->material[INSIDE_MATERIAL]};
    copy3(spec->value[CENTRE], cylinder.centre_m);
    revolved_axes(spec->value[AXIS], cylinder.axis, cylinder.first);
    return frustum_build(&cylinder, component, out, error);
}

static void centre(const primitive_spec *spec, double out[3])
{
    copy3(spec->value[CENTRE], out);
}

const primitive_kind primitive_cylinder = {
    .name = "cylinder",
    .doc = "round cylinder; facets as of a prism, that stand for the round side. Tangents: the "
           "axis on the "
           "side, the direction of the first corner on the caps",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre = centre,
};
