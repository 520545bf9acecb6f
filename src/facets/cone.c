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
    [RADIUS] = LENGTH_KEY("radius_m", "radius of the base; the corners of the facets lie on it"),
    [TOP_RADIUS] = {.name = "top_radius_m",
                    .unit = "m",
                    .doc = "radius of the other end; 0: a point",
                    .kind = KEY_NUMBER,
                    .min = 0,
                    .max = LENGTH_MAX_M},
    [LENGTH] = LENGTH_KEY("length_m", "length along the axis"),
    [SIDES] = SIDES_KEY,
    [TOLERANCE] = TOLERANCE_KEY,
    [CENTRE] = CENTRE_KEY,
    [AXIS] = AXIS_KEY("direction from the base to the other end"),
    [MATERIAL] = MATERIAL_KEY("material of the side"),
    [CAP_MATERIAL] = CAP_MATERIAL_KEY,
    [INSIDE_MATERIAL] = INSIDE_MATERIAL_KEY,
    [OPEN] = OPEN_KEY,
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

const primitive_kind primitive_cone = {
    .name = "cone",
    .doc =
        "round cone, or a frustum where top_radius_m is given; centre_m is the middle of its axis. "
        "Tangents: upwards along the side, the direction of the first corner on the caps",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre_key = CENTRE,
};
