/* A round cone, or a part of one between two circles. */
#include "base/vec.h"
#include "facets/revolved.h"

enum {
    RADIUS,
    TOP_RADIUS,
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
                .doc = "radius of the base; the corners of the facets lie on it",
                .kind = KEY_NUMBER,
                .required = true,
                LENGTH_RANGE},
    [TOP_RADIUS] = {.name = "top_radius_m",
                    .unit = "m",
                    .doc = "radius of the other end; 0: a point",
                    .kind = KEY_NUMBER,
                    .min = 0,
                    .max = LENGTH_MAX_M},
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
              .doc = "direction from the base to the other end",
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
    glint_status status = check_ends(spec, CAP_MATERIAL, INSIDE_MATERIAL, OPEN, errors);
    const glint_status count = check_resolution(spec, SIDES, TOLERANCE, errors);
    if (count) status = count;
    const double top_m = spec->value[TOP_RADIUS][0];
    if (primitive_key_sound(spec, TOP_RADIUS) && top_m > 0.0 && top_m < LENGTH_MIN_M)
        status = errors_add(errors, GLINT_INPUT, spec->key_place[TOP_RADIUS],
                            "top_radius_m is %.10g; expected 0 for a point, or at least %g", top_m,
                            LENGTH_MIN_M);
    return status;
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    const double radius_m = spec->value[RADIUS][0], top_m = spec->value[TOP_RADIUS][0];
    const double larger_m = radius_m > top_m ? radius_m : top_m;
    frustum cone = {.length_m = spec->value[LENGTH][0],
                    .bottom_m = radius_m,
                    .top_m = top_m,
                    .sides = sides_of(spec, SIDES, TOLERANCE, larger_m),
                    .round = true,
                    .open = spec->value[OPEN][0] != 0.0,
                    .material = spec->material[MATERIAL],
                    .cap_material = material_or(spec, CAP_MATERIAL, MATERIAL),
                    .inside_material = spec->material[INSIDE_MATERIAL]};
    copy3(spec->value[CENTRE], cone.centre_m);
    revolved_axes(spec->value[AXIS], cone.axis, cone.first);
    return frustum_build(&cone, component, out, error);
}

static void centre(const primitive_spec *spec, double out[3])
{
    copy3(spec->value[CENTRE], out);
}

const primitive_kind primitive_cone = {
    .name = "cone",
    .doc =
        "round cone, or a frustum where top_radius_m is given; centre_m is the middle of its axis. "
        "Tangents: upwards along the side, the direction of the first corner on the caps",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre = centre,
};
