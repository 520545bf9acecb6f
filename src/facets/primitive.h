/* primitive.h: the solids and plates that models are made of, and the polygons they turn into.
 *
 * A primitive is one file and one row in the table: its keys, their kinds, ranges and defaults
 * stand in the row, and the reader, the checks and the reference pages follow from it. */
#ifndef GLINT_FACETS_PRIMITIVE_H
#define GLINT_FACETS_PRIMITIVE_H

#include "base/error.h"

/* A flat convex polygon that reflects on the side of its normal. Component coordinates, m. */
typedef struct facet {
    int first_vertex, n_vertices; /* in facet_list.vertices, anticlockwise seen from outside */
    int material;                 /* index, as the caller numbers them */
    int component;                /* index, as the caller numbers them */
    double normal[3], tangent[3]; /* unit, orthogonal */
    double area_m2;
} facet;

/* A growing list of facets; zero-initialise. Owned arrays. */
typedef struct facet_list {
    facet *items;
    double (*vertices)[3];
    int n, capacity, n_vertices, vertex_capacity;
} facet_list;

void facet_list_free(facet_list *list);
/* Makes room for n_facets more facets with n_vertices more vertices in all. Errors: GLINT_INTERNAL
 * (memory, or more than INT_MAX of either). */
glint_status facet_list_reserve(facet_list *list, int n_facets, int n_vertices, glint_error *error);
/* Appends a polygon: n >= 3 vertices (m; not inside the list), anticlockwise from outside; its
 * normal and area follow from them (Newell's method), the tangent is `tangent` (any length, not
 * along the normal) made orthogonal to the normal. Errors: GLINT_INPUT when the polygon encloses no
 * area; GLINT_INTERNAL (memory). On error the list is unchanged. */
glint_status facet_list_add(facet_list *list, const double (*vertices)[3], int n,
                            const double tangent[3], int material, int component,
                            glint_error *error);

/* What kind of value a key takes. */
typedef enum primitive_key_kind {
    KEY_NUMBER,    /* one number */
    KEY_COUNT,     /* one whole number */
    KEY_SWITCH,    /* true or false: 1 or 0 */
    KEY_VECTOR,    /* `length` (2 or 3) numbers */
    KEY_DIRECTION, /* 3 numbers, not all zero; need not be unit */
    KEY_POINTS,    /* 3 or more points of 3 numbers */
    KEY_MATERIAL,  /* the name of a material */
    KEY_FACES      /* a table "+x".."-z" -> name of a material */
} primitive_key_kind;

typedef struct primitive_key {
    const char *name, *unit, *doc; /* unit: "" where there is none */
    primitive_key_kind kind;
    int length; /* KEY_VECTOR */
    bool required;
    double def[3];   /* default of number kinds */
    double min, max; /* range of each number (closed; min_open: min itself is out); a KEY_DIRECTION
                        has none */
    bool min_open;
} primitive_key;

enum {
    PRIMITIVE_MAX_KEYS = 12,
    PRIMITIVE_NO_MATERIAL = -1,
    PRIMITIVE_MAX_FACETS = 5242880 /* 20 * 4^9: of one primitive with its copies */
};

/* A primitive as read: values in the order of its kind's keys. */
typedef struct primitive_spec {
    const struct primitive_kind *kind;
    place where;                         /* of the primitive's table */
    place key_place[PRIMITIVE_MAX_KEYS]; /* of each key's value; `where` if not given */
    bool given[PRIMITIVE_MAX_KEYS];
    double value[PRIMITIVE_MAX_KEYS][3]; /* number kinds; defaults filled in */
    int material[PRIMITIVE_MAX_KEYS];    /* KEY_MATERIAL; PRIMITIVE_NO_MATERIAL if not given */
    int face_material[6]; /* KEY_FACES, +x -x +y -y +z -z; NO_MATERIAL if not given */
    double (*points)[3];  /* KEY_POINTS; owned */
    int n_points;
    /* Common to all: rotation about the primitive's centre (tangents too), then copies. */
    bool has_rotation;
    double rotation_axis[3], rotation_rad;  /* axis unit */
    int repeat_count;                       /* 1: no copies; the original included */
    double repeat_axis[3], repeat_step_rad; /* about the component's origin, axis unit */
    int mirror;                             /* 0 none; 1, 2, 3: also reflected in x, y, z = 0 */
} primitive_spec;

typedef struct primitive_kind {
    const char *name, *doc;
    const primitive_key *keys;
    int n_keys;
    /* Semantic checks that the ranges of single keys cannot make (tangent along normal, points not
     * planar or not convex, ...): all errors found, each at the key's place. NULL: none. */
    glint_status (*check)(const primitive_spec *spec, glint_errors *errors);
    /* Appends the primitive's facets, without rotation and copies. Only after check succeeded. */
    glint_status (*build)(const primitive_spec *spec, int component, facet_list *out,
                          glint_error *error);
    /* The point that rotation_deg turns about. */
    void (*centre)(const primitive_spec *spec, double out[3]);
} primitive_kind;

/* The table: kind k from 0, NULL past the end. */
const primitive_kind *primitive_kind_at(size_t k);
const primitive_kind *primitive_kind_named(const char *name);
/* Index of a key in a kind, or -1. */
int primitive_key_index(const primitive_kind *kind, const char *name);

/* Fills in a spec's defaults, with the kind and the place of its table. */
void primitive_spec_start(const primitive_kind *kind, place where, primitive_spec *spec);
void primitive_spec_free(primitive_spec *spec);

/* Checks a spec: required keys given, numbers finite and in the ranges of their rows, directions
 * not zero, and what the kind's own check adds. Errors: GLINT_INPUT, all that were found, each at
 * the place of its key. */
glint_status primitive_check(const primitive_spec *spec, glint_errors *errors);

/* Checks (primitive_check), builds, rotates and copies one primitive. component: index given to its
 * facets. Errors: GLINT_INPUT from the checks, or when the primitive with its copies has more than
 * PRIMITIVE_MAX_FACETS facets; GLINT_INTERNAL (memory). On error the list is unchanged. */
glint_status primitive_add(const primitive_spec *spec, int component, facet_list *out,
                           glint_errors *errors);

#endif
