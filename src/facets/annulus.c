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
    [RADIUS] = {.name = "radius_m",
                .unit = "m",
                .doc = "radius outside; corners of the facets lie on it",
                .kind = KEY_NUMBER,
                .required = true,
                LENGTH_RANGE},
    [INNER_RADIUS] = {.name = "inner_radius_m",
                      .unit = "m",
                      .doc = "radius of the hole; corners of the facets lie on it",
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
    const double outer_m = spec->value[RADIUS][0], inner_m = spec->value[INNER_RADIUS][0];
    if (primitive_key_sound(spec, RADIUS) && primitive_key_sound(spec, INNER_RADIUS) &&
        !(inner_m < outer_m - LENGTH_MIN_M))
        status = errors_add(errors, GLINT_INPUT, spec->key_place[INNER_RADIUS],
                            "inner_radius_m is %.10g and radius_m %.10g; expected a hole smaller "
                            "than the disc",
                            inner_m, outer_m);
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
    directions(spec, normal, first);
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

static void centre(const primitive_spec *spec, double out[3])
{
    copy3(spec->value[CENTRE], out);
}

const primitive_kind primitive_annulus = {
    .name = "annulus",
    .doc = "flat ring of trapezoids; reflects in front, and behind where back_material is given. "
           "Tangent: the direction of the first corner",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre = centre,
};
