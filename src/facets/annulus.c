/* A flat ring. */
#include "base/vec.h"
#include "facets/revolved.h"

#include <stdlib.h>

enum {
    RADIUS,
    INNER_RADIUS,
    SIDES,
    TOLERANCE,
    CENTRE,
    NORMAL,
    TANGENT,
    MATERIAL,
    BACK_MATERIAL,
    N_KEYS
};

static const primitive_key keys[N_KEYS] = {
    [RADIUS] = LENGTH_KEY("radius_m", "radius outside; corners of the facets lie on it"),
    [INNER_RADIUS] =
        LENGTH_KEY("inner_radius_m", "radius of the hole; corners of the facets lie on it"),
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
    glint_status status = check_resolution(spec, SIDES, TOLERANCE, errors);
    const double outer_m = spec->value[RADIUS][0], inner_m = spec->value[INNER_RADIUS][0];
    if (primitive_key_sound(spec, RADIUS) && primitive_key_sound(spec, INNER_RADIUS) &&
        !(inner_m < outer_m - LENGTH_MIN_M))
        status = errors_add(errors, GLINT_INPUT, spec->key_place[INNER_RADIUS],
                            "inner_radius_m is %.10g and radius_m %.10g; expected a hole smaller "
                            "than the disc",
                            inner_m, outer_m);
    const glint_status across = check_tangent_key(spec, NORMAL, TANGENT, errors);
    return across ? across : status;
}

/* A trapezoid from corner k to the next. */
static glint_status add_piece(const primitive_spec *spec, const double (*outer)[3],
                              const double (*inner)[3], int n, int k, const double first[3],
                              int component, facet_list *out, glint_error *error)
{
    const int next = (k + 1) % n;
    double corners[4][3];
    copy3(inner[k], corners[0]), copy3(outer[k], corners[1]);
    copy3(outer[next], corners[2]), copy3(inner[next], corners[3]);
    return add_two_sided(out, corners, 4, first, spec->material[MATERIAL],
                         spec->material[BACK_MATERIAL], component, error);
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    const int n = sides_of(spec, SIDES, TOLERANCE, spec->value[RADIUS][0]);
    double normal[3], first[3];
    disc_axes(spec, NORMAL, TANGENT, normal, first);
    double(*outer)[3] = malloc(2 * (size_t)n * sizeof *outer);
    if (!outer) return error_no_memory(error);
    double(*inner)[3] = outer + n;
    revolved_ring(spec->value[CENTRE], normal, first, spec->value[RADIUS][0], n, outer);
    revolved_ring(spec->value[CENTRE], normal, first, spec->value[INNER_RADIUS][0], n, inner);
    glint_status status = GLINT_OK;
    for (int k = 0; k < n && !status; k++)
        status = add_piece(spec, outer, inner, n, k, first, component, out, error);
    free(outer);
    return status;
}

const primitive_kind primitive_annulus = {
    .name = "annulus",
    .doc = "flat ring of trapezoids; reflects in front, and behind where back_material is given. "
           "Tangent: the direction of the first corner",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre_key = CENTRE,
};
