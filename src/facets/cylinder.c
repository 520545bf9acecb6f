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
    [RADIUS] = LENGTH_KEY("radius_m", "radius; the corners of the facets lie on it"),
    [LENGTH] = LENGTH_KEY("length_m", "length along the axis"),
    [SIDES] = SIDES_KEY,
    [TOLERANCE] = TOLERANCE_KEY,
    [CENTRE] = CENTRE_KEY,
    [AXIS] = AXIS_KEY("direction of the axis"),
    [MATERIAL] = MATERIAL_KEY("material of the side"),
    [CAP_MATERIAL] = CAP_MATERIAL_KEY,
    [INSIDE_MATERIAL] = INSIDE_MATERIAL_KEY,
    [OPEN] = OPEN_KEY,
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

const primitive_kind primitive_cylinder = {
    .name = "cylinder",
    .doc = "round cylinder; facets as of a prism, that stand for the round side. Tangents: the "
           "axis on the "
           "side, the direction of the first corner on the caps",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre_key = CENTRE,
};
