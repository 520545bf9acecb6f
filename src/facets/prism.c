/* A right prism over a regular polygon. */
#include "base/vec.h"
#include "facets/revolved.h"

enum { RADIUS, LENGTH, SIDES, CENTRE, AXIS, MATERIAL, CAP_MATERIAL, OPEN, N_KEYS };

static const primitive_key keys[N_KEYS] = {
    [RADIUS] = LENGTH_KEY("radius_m", "radius of the circle through the vertices"),
    [LENGTH] = LENGTH_KEY("length_m", "length along the axis"),
    [SIDES] = {.name = "sides",
               .unit = "",
               .doc = "number of sides",
               .kind = KEY_COUNT,
               .required = true,
               .min = SIDES_MIN,
               .max = SIDES_MAX},
    [CENTRE] = CENTRE_KEY,
    [AXIS] = AXIS_KEY("direction of the axis"),
    [MATERIAL] = MATERIAL_KEY("material of the sides"),
    [CAP_MATERIAL] = CAP_MATERIAL_KEY,
    [OPEN] = OPEN_KEY,
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
    .centre_key = CENTRE,
};
