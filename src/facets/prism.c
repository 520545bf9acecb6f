/* A right prism over a regular polygon. */
#include "base/vec.h"
#include "facets/revolved.h"

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
               .min = SIDES_MIN,
               .max = SIDES_MAX},
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

static glint_status check(const primitive_spec *spec, glint_errors *errors)
{
    return check_ends(spec, CAP_MATERIAL, -1, OPEN, errors);
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    frustum prism = {.length_m = spec->value[LENGTH][0],
                     .bottom_m = spec->value[RADIUS][0],
                     .top_m = spec->value[RADIUS][0],
                     .sides = (int)spec->value[SIDES][0],
                     .open = spec->value[OPEN][0] != 0.0,
                     .material = spec->material[MATERIAL],
                     .cap_material = material_or(spec, CAP_MATERIAL, MATERIAL),
                     .inside_material = PRIMITIVE_NO_MATERIAL};
    copy3(spec->value[CENTRE], prism.centre_m);
    revolved_axes(spec->value[AXIS], prism.axis, prism.first);
    return frustum_build(&prism, component, out, error);
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
    .check = check,
    .build = build,
    .centre = centre,
};
