/* revolved.h: what bodies of revolution share; private to this room. */
#ifndef GLINT_FACETS_REVOLVED_H
#define GLINT_FACETS_REVOLVED_H

#include "facets/primitive_kinds.h"

/* Into how many flat sides a circle is divided. */
enum { SIDES_MIN = 3, SIDES_MAX = 10000, SIDES_DEFAULT = 64 };

/* The two keys that say so: by count, or by how far sides may lie inside the circle. */
#define SIDES_KEY                                                                                  \
    {                                                                                              \
        .name = "sides", .unit = "", .doc = "number of flat sides about the axis",                 \
        .kind = KEY_COUNT, .def = {SIDES_DEFAULT}, .min = SIDES_MIN, .max = SIDES_MAX              \
    }
#define TOLERANCE_KEY                                                                              \
    {                                                                                              \
        .name = "tolerance_m", .unit = "m",                                                        \
        .doc = "in place of a count: how far facets may lie off the true surface",                 \
        .kind = KEY_NUMBER, LENGTH_RANGE                                                           \
    }

/* What else several of them have. */
#define AXIS_KEY(DOC)                                                                              \
    {                                                                                              \
        .name = "axis", .unit = "", .doc = DOC, .kind = KEY_DIRECTION, .def = { 0, 0, 1 }          \
    }
#define CORNER_KEY                                                                                 \
    {                                                                                              \
        .name = "tangent", .unit = "",                                                             \
        .doc = "direction of the first corner, made orthogonal to the normal; absent: x or y, "    \
               "whichever is less along the normal",                                               \
        .kind = KEY_DIRECTION                                                                      \
    }
#define CAP_MATERIAL_KEY                                                                           \
    {                                                                                              \
        .name = "cap_material", .unit = "",                                                        \
        .doc = "material of the caps; absent: that of the sides", .kind = KEY_MATERIAL             \
    }
#define INSIDE_MATERIAL_KEY                                                                        \
    {                                                                                              \
        .name = "inside_material", .unit = "",                                                     \
        .doc = "material of the inside of an open one; absent: black", .kind = KEY_MATERIAL        \
    }
#define OPEN_KEY                                                                                   \
    {                                                                                              \
        .name = "open", .unit = "", .doc = "true leaves the caps out", .kind = KEY_SWITCH,         \
        .max = 1                                                                                   \
    }

/* An error where both a count and a tolerance are given. */
glint_status check_resolution(const primitive_spec *spec, int count_key, int tolerance_key,
                              glint_errors *errors);

/* Errors where a material is given for what is not there: for the caps of an open body, for the
 * inside of a closed one. inside_key: negative where the kind has no such key. */
glint_status check_ends(const primitive_spec *spec, int cap_key, int inside_key, int open_key,
                        glint_errors *errors);

/* The number of sides by the values of these keys for circles up to that radius, m. */
int sides_of(const primitive_spec *spec, int sides_key, int tolerance_key, double radius_m);

/* The unit vector of `axis` (any length), and the direction from which circles about it are
 * divided: x or y, whichever is less along it, made perpendicular; x where both are alike, since
 * what is nearer than PARALLEL_RAD differs by rounding. */
void revolved_axes(const double axis[3], double unit_axis[3], double first[3]);

/* The normal of a flat round piece (unit), and the direction of its first corner: the tangent made
 * orthogonal to it where that is given, or else as about an axis. */
void disc_axes(const primitive_spec *spec, int normal_key, int tangent_key, double normal[3],
               double first[3]);

/* Writes n points at k 360/n deg, right-handed about the axis, from `first`. axis, first: unit,
 * orthogonal. */
void revolved_ring(const double centre_m[3], const double axis[3], const double first[3],
                   double radius_m, int n, double (*out)[3]);

/* A body between two circles (m, on one axis), or a circle and a point. */
typedef struct frustum {
    double centre_m[3];               /* of the axis between its ends */
    double axis[3];                   /* unit, from the bottom to the top */
    double first[3];                  /* unit, across the axis */
    double length_m, bottom_m, top_m; /* radii of the circles through the corners; top 0: a point */
    int sides;
    bool round; /* the sides stand for a cone; else they are flat */
    bool open;  /* no caps */
    int material, cap_material, inside_material; /* the latter: PRIMITIVE_NO_MATERIAL for none */
} frustum;

/* Appends the sides, the top, the bottom and the inside, as far as there are any. Tangents: on the
 * sides along them, upwards; `first` on the caps. Errors: GLINT_INTERNAL (memory). */
glint_status frustum_build(const frustum *f, int component, facet_list *out, glint_error *error);

#endif
