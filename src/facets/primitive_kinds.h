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

/* The key of a primitive's centre. */
#define CENTRE_KEY                                                                                 \
    {                                                                                              \
        .name = "centre_m", .unit = "m", .doc = "centre", .kind = KEY_VECTOR, .length = 3,         \
        COORDINATE_RANGE                                                                           \
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

#endif
