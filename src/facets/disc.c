/* A flat round disc. */
#include "base/vec.h"
#include "facets/revolved.h"

#include <stdlib.h>

enum { RADIUS, SIDES, TOLERANCE, CENTRE, NORMAL, TANGENT, MATERIAL, BACK_MATERIAL, N_KEYS };

static const primitive_key keys[N_KEYS] = {
    [RADIUS] = {.name = "radius_m",
                .unit = "m",
                .doc = "radius; the corners of the polygon lie on it",
                .kind = KEY_NUMBER,
                .required = true,
                LENGTH_RANGE},
    [SIDES] = SIDES_KEY,
    [TOLERANCE] = TOLERANCE_KEY,
    [CENTRE] = CENTRE_KEY,
    [NORMAL] = {.name = "normal",
                .unit = "",
                .doc = "direction in which the front looks",
                .kind = KEY_DIRECTION,
                .required = true},
    [TANGENT] =
        {.name = "tangent",
         .unit = "",
         .doc = "direction of the first corner, made orthogonal to the normal; absent: x or y, "
                "whichever is less along the normal",
         .kind = KEY_DIRECTION},
    [MATERIAL] = {.name = "material",
                  .unit = "",
                  .doc = "material of the front",
                  .kind = KEY_MATERIAL,
                  .required = true},
    [BACK_MATERIAL] = {.name = "back_material",
                       .unit = "",
                       .doc = "material of the back; absent: black, but it still casts shadows",
                       .kind = KEY_MATERIAL},
};

static glint_status check(const primitive_spec *spec, glint_errors *errors)
{
    glint_status status = check_resolution(spec, SIDES, TOLERANCE, errors);
    if (spec->given[TANGENT] && primitive_key_sound(spec, NORMAL) &&
        primitive_key_sound(spec, TANGENT) &&
        primitive_parallel(spec->value[NORMAL], spec->value[TANGENT]))
        status = errors_add(errors, GLINT_INPUT, spec->key_place[TANGENT],
                            "tangent is along the normal; expected a direction across it");
    return status;
}

/* The normal, and the direction of the first corner: the tangent, or else x or y as about an axis.
 */
static void directions(const primitive_spec *spec, double normal[3], double first[3])
{
    revolved_axes(spec->value[NORMAL], normal, first);
    if (spec->given[TANGENT]) perp3(spec->value[TANGENT], normal, first);
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    const double radius_m = spec->value[RADIUS][0];
    const int n = sides_of(spec, SIDES, TOLERANCE, radius_m);
    double normal[3], first[3];
    directions(spec, normal, first);
    double(*ring)[3] = malloc((size_t)n * sizeof *ring);
    if (!ring) return error_no_memory(error);
    revolved_ring(spec->value[CENTRE], normal, first, radius_m, n, ring);
    const glint_status status = add_two_sided(out, ring, n, first, spec->material[MATERIAL],
                                              spec->material[BACK_MATERIAL], component, error);
    free(ring);
    return status;
}

static void centre(const primitive_spec *spec, double out[3])
{
    copy3(spec->value[CENTRE], out);
}

const primitive_kind primitive_disc = {
    .name = "disc",
    .doc =
        "flat round disc, one polygon; reflects in front, and behind where back_material is given. "
        "Tangent: the direction of the first corner",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre = centre,
};
