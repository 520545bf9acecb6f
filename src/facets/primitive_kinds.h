/* primitive_kinds.h: what the files of the single primitives share; private to this room. */
#ifndef GLINT_FACETS_PRIMITIVE_KINDS_H
#define GLINT_FACETS_PRIMITIVE_KINDS_H

#include "facets/primitive.h"

#include <math.h>

/* Lengths that a primitive takes, m. Wide of anything that flies: they catch slips of unit, and
 * keep areas and the differences of vertices clear of overflow and rounding. */
#define LENGTH_MIN_M 1e-6
#define LENGTH_MAX_M 1e7
#define LENGTH_RANGE .min = LENGTH_MIN_M, .max = LENGTH_MAX_M
#define COORDINATE_RANGE .min = -LENGTH_MAX_M, .max = LENGTH_MAX_M

/* Rows of keys that several kinds have; each says in `doc` what its own is. */
#define LENGTH_KEY(NAME, DOC)                                                                      \
    {                                                                                              \
        .name = NAME, .unit = "m", .doc = DOC, .kind = KEY_NUMBER, .required = true, LENGTH_RANGE  \
    }
#define POINT_KEY(NAME, DOC)                                                                       \
    {                                                                                              \
        .name = NAME, .unit = "m", .doc = DOC, .kind = KEY_VECTOR, .length = 3, COORDINATE_RANGE   \
    }
#define CENTRE_KEY POINT_KEY("centre_m", "centre")
#define NORMAL_KEY(DOC)                                                                            \
    {                                                                                              \
        .name = "normal", .unit = "", .doc = DOC, .kind = KEY_DIRECTION, .required = true          \
    }
#define MATERIAL_KEY(DOC)                                                                          \
    {                                                                                              \
        .name = "material", .unit = "", .doc = DOC, .kind = KEY_MATERIAL, .required = true         \
    }
#define BACK_MATERIAL_KEY(DOC)                                                                     \
    {                                                                                              \
        .name = "back_material", .unit = "",                                                       \
        .doc = DOC "; absent: black, but it still casts shadows", .kind = KEY_MATERIAL             \
    }

/* Two directions nearer than this to one line are parallel, rad. */
#define PARALLEL_RAD 1e-9

/* The rows of the table, each in the file of its name. */
extern const primitive_kind primitive_plate, primitive_facet, primitive_box, primitive_prism,
    primitive_sphere, primitive_cylinder, primitive_cone, primitive_disc, primitive_annulus,
    primitive_dish, primitive_wing, primitive_boom, primitive_mesh;

/* True when key k has a value that stands alone: given or by default, finite, in range, and not
 * zero where a direction is asked for. Kinds ask before they compare values. */
bool primitive_key_sound(const primitive_spec *spec, int k);

/* The material of a key, or where it is not given that of another. */
static inline int material_or(const primitive_spec *spec, int key, int other)
{
    return spec->material[key] != PRIMITIVE_NO_MATERIAL ? spec->material[key]
                                                        : spec->material[other];
}

/* Appends a polygon of n corners, and its back where back_material is one. Errors: as
 * facet_list_add. */
glint_status add_two_sided(facet_list *out, const double (*vertices)[3], int n,
                           const double tangent[3], int material, int back_material, int component,
                           glint_error *error);

/* True when the lines of two directions (any length, not zero) are parallel. */
bool primitive_parallel(const double a[3], const double b[3]);
/* An error where the tangent is given and runs along the normal (any length, not zero). */
glint_status check_tangent(const primitive_spec *spec, const double normal[3], int tangent_key,
                           glint_errors *errors);
/* The same, where the normal is a key too. */
glint_status check_tangent_key(const primitive_spec *spec, int normal_key, int tangent_key,
                               glint_errors *errors);

/* Makes the points run the other way round. */
void reverse_points(double (*points)[3], int n);

#endif
