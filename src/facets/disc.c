/* A flat round disc. */
#include "base/vec.h"
#include "facets/revolved.h"

#include <stdlib.h>

enum { RADIUS, SIDES, TOLERANCE, CENTRE, NORMAL, TANGENT, MATERIAL, BACK_MATERIAL, N_KEYS };

static const primitive_key keys[N_KEYS] = {
    [RADIUS] = LENGTH_KEY("radius_m", "radius; the corners of the polygon lie on it"),
    [SIDES] = SIDES_KEY,
    [TOLERANCE] = TOLERANCE_KEY,
    [CENTRE] = CENTRE_KEY,
    [NORMAL] = NORMAL_KEY("direction in which the front looks"),
    [TANGENT] = CORNER_KEY,
    [MATERIAL] = MATERIAL_KEY("material of the front"),
    [BACK_MATERIAL] = BACK_MATERIAL_KEY("material of the back"),
};

static glint_status check(const primitive_spec *spec, glint_errors *errors)
{
    const glint_status count = check_resolution(spec, SIDES, TOLERANCE, errors);
    const glint_status across = check_tangent_key(spec, NORMAL, TANGENT, errors);
    return count ? count : across;
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    const double radius_m = spec->value[RADIUS][0];
    const int n = sides_of(spec, SIDES, TOLERANCE, radius_m);
    double normal[3], first[3];
    disc_axes(spec, NORMAL, TANGENT, normal, first);
    double(*ring)[3] = malloc((size_t)n * sizeof *ring);
    if (!ring) return error_no_memory(error);
    revolved_ring(spec->value[CENTRE], normal, first, radius_m, n, ring);
    const glint_status status = add_two_sided(out, ring, n, first, spec->material[MATERIAL],
                                              spec->material[BACK_MATERIAL], component, error);
    free(ring);
    return status;
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
    .centre_key = CENTRE,
};
