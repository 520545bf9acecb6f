/* A boom: a thin prism from one point to another. */
#include "base/vec.h"
#include "facets/revolved.h"

enum { FROM, TO, RADIUS, SIDES, MATERIAL, CAP_MATERIAL, OPEN, N_KEYS };

static const primitive_key keys[N_KEYS] = {
    [FROM] = {.name = "from_m",
              .unit = "m",
              .doc = "where it begins",
              .kind = KEY_VECTOR,
              .length = 3,
              .required = true,
              COORDINATE_RANGE},
    [TO] = {.name = "to_m",
            .unit = "m",
            .doc = "where it ends",
            .kind = KEY_VECTOR,
            .length = 3,
            .required = true,
            COORDINATE_RANGE},
    [RADIUS] = LENGTH_KEY("radius_m", "radius of the circle through its edges"),
    [SIDES] = {.name = "sides",
               .unit = "",
               .doc = "number of flat sides",
               .kind = KEY_COUNT,
               .def = {4},
               .min = SIDES_MIN,
               .max = SIDES_MAX},
    [MATERIAL] = MATERIAL_KEY("material of the sides"),
    [CAP_MATERIAL] = CAP_MATERIAL_KEY,
    [OPEN] = OPEN_KEY,
};

static glint_status check(const primitive_spec *spec, glint_errors *errors)
{
    const glint_status ends = check_ends(spec, CAP_MATERIAL, -1, OPEN, errors);
    double along[3];
    sub3(spec->value[TO], spec->value[FROM], along);
    if (!primitive_key_sound(spec, FROM) || !primitive_key_sound(spec, TO) ||
        norm3(along) >= LENGTH_MIN_M)
        return ends;
    return errors_add(errors, GLINT_INPUT, spec->key_place[TO],
                      "the boom has no length; expected to_m at least %g m from from_m",
                      LENGTH_MIN_M);
}

static void centre(const primitive_spec *spec, double out[3])
{
    add3(spec->value[FROM], spec->value[TO], out);
    scale3(out, 0.5, out);
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    double along[3];
    sub3(spec->value[TO], spec->value[FROM], along);
    frustum boom = {.length_m = norm3(along),
                    .bottom_m = spec->value[RADIUS][0],
                    .top_m = spec->value[RADIUS][0],
                    .sides = (int)spec->value[SIDES][0],
                    .open = spec->value[OPEN][0] != 0.0,
                    .material = spec->material[MATERIAL],
                    .cap_material = material_or(spec, CAP_MATERIAL, MATERIAL),
                    .inside_material = PRIMITIVE_NO_MATERIAL};
    centre(spec, boom.centre_m);
    revolved_axes(along, boom.axis, boom.first);
    return frustum_build(&boom, component, out, error);
}

const primitive_kind primitive_boom = {
    .name = "boom",
    .doc = "boom or strut: a thin prism from one point to another; its edges stand at k 360/sides "
           "deg, "
           "right-handed about its axis, from x or y as those of a prism. Tangents as of a prism",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre = centre,
};
