/* shapes.h: what the tests of primitives and models share: filling in primitives, and integrals
 * over facets. */
#ifndef GLINT_SHAPES_H
#define GLINT_SHAPES_H

#include "base/constants.h"
#include "base/vec.h"
#include "facets/model.h"
#include "testing.h"

/* The place of every primitive's table in these tests; key k stands KEY_LINE + k. */
enum { TABLE_LINE = 10, KEY_LINE = 20 };

static inline primitive_spec shape(const char *kind)
{
    primitive_spec spec;
    const primitive_kind *row = primitive_kind_named(kind);
    ck_assert_ptr_nonnull(row);
    primitive_spec_start(row, (place){"shape.toml", TABLE_LINE, 1}, &spec);
    return spec;
}

static inline int shape_key(primitive_spec *spec, const char *key)
{
    const int k = primitive_key_index(spec->kind, key);
    ck_assert_int_ge(k, 0);
    spec->given[k] = true;
    spec->key_place[k] = (place){"shape.toml", KEY_LINE + k, 5};
    return k;
}

static inline void shape_set(primitive_spec *spec, const char *key, const double *v, size_t n)
{
    memcpy(spec->value[shape_key(spec, key)], v, n * sizeof *v);
}
#define SET(spec, key, ...)                                                                        \
    shape_set(spec, key, (double[]){__VA_ARGS__}, sizeof((double[]){__VA_ARGS__}) / sizeof(double))

static inline void shape_material(primitive_spec *spec, const char *key, int material)
{
    spec->material[shape_key(spec, key)] = material;
}

static inline void shape_points(primitive_spec *spec, const double (*points)[3], int n)
{
    shape_key(spec, "vertices_m");
    free(spec->points);
    spec->points = malloc((size_t)n * sizeof *points);
    memcpy(spec->points, points, (size_t)n * sizeof *points);
    spec->n_points = n;
}

static inline void shape_rotate(primitive_spec *spec, double x, double y, double z, double deg)
{
    const double axis[3] = {x, y, z};
    unit3(axis, spec->rotation_axis);
    spec->has_rotation = true;
    spec->rotation_rad = deg * DEG;
}

static inline void shape_repeat(primitive_spec *spec, int count, const double axis[3], double deg)
{
    unit3(axis, spec->repeat_axis);
    spec->repeat_count = count;
    spec->repeat_step_rad = deg * DEG;
}

/* Adds the primitive, which must succeed, and frees it. */
static inline void shape_add(primitive_spec *spec, int component, facet_list *list)
{
    glint_errors *errors = glint_errors_new();
    const glint_status status = primitive_add(spec, component, list, errors);
    const glint_error *first = glint_errors_get(errors, 0);
    ck_assert_msg(status == GLINT_OK, "%s: %s", spec->kind->name, first ? first->message : "?");
    ck_assert_uint_eq(glint_errors_count(errors), 0);
    glint_errors_free(errors);
    primitive_spec_free(spec);
}

static inline primitive_spec plate_shape(double a_m, double b_m, const double centre_m[3],
                                         const double normal[3], const double tangent[3])
{
    primitive_spec spec = shape("plate");
    SET(&spec, "size_m", a_m, b_m);
    shape_set(&spec, "centre_m", centre_m, 3);
    shape_set(&spec, "normal", normal, 3);
    shape_set(&spec, "tangent", tangent, 3);
    shape_material(&spec, "material", 0);
    return spec;
}

static inline primitive_spec box_shape(double x_m, double y_m, double z_m)
{
    primitive_spec spec = shape("box");
    SET(&spec, "size_m", x_m, y_m, z_m);
    shape_material(&spec, "material", 0);
    return spec;
}

static inline primitive_spec prism_shape(int sides, double radius_m, double length_m)
{
    primitive_spec spec = shape("prism");
    SET(&spec, "sides", sides);
    SET(&spec, "radius_m", radius_m);
    SET(&spec, "length_m", length_m);
    shape_material(&spec, "material", 0);
    return spec;
}

static inline primitive_spec sphere_shape(double radius_m, int facets)
{
    primitive_spec spec = shape("sphere");
    SET(&spec, "radius_m", radius_m);
    SET(&spec, "facets", facets);
    shape_material(&spec, "material", 0);
    return spec;
}

/* Integrals over the facets first .. first + n - 1. */
typedef struct surface {
    double area_m2;
    double vector_m2[3]; /* sum of area times normal: 0 where the surface is closed */
    double volume_m3;    /* divergence theorem: a third of the sum of area times normal . point */
} surface;

static inline surface surface_of(const facet_list *list, int first, int n)
{
    surface s = {0};
    for (int k = first; k < first + n; k++) {
        const facet *f = &list->items[k];
        s.area_m2 += f->area_m2;
        add_scaled3(s.vector_m2, f->area_m2, f->normal, s.vector_m2);
        s.volume_m3 += f->area_m2 * dot3(f->normal, list->vertices[f->first_vertex]) / 3.0;
    }
    return s;
}

static inline void assert_near3(const double got[3], const double want[3], double tol)
{
    for (int j = 0; j < 3; j++)
        assert_near(got[j], want[j], tol);
}

#endif
