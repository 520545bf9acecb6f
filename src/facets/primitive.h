/* primitive.h: the solids and plates that models are made of, and the polygons they turn into.
 *
 * A primitive is one file and one row in the table: its keys, their kinds, ranges and defaults
 * stand in the row, and the reader, the checks and the reference pages follow from it. */
#ifndef GLINT_FACETS_PRIMITIVE_H
#define GLINT_FACETS_PRIMITIVE_H

#include "base/error.h"

#include <stdint.h>

/* A flat convex polygon that reflects on the side of its normal. Component coordinates, m. */
typedef struct facet {
    int first_vertex, n_vertices; /* in facet_list.vertices, anticlockwise seen from outside */
    int material;                 /* index, as the caller numbers them */
    int component;                /* index, as the caller numbers them */
    int surface; /* 1 + index in facet_list.surfaces of what it stands for a piece of; 0: itself */
    int part;    /* number of the group that sums are wanted of; 0 where they are not told apart */
    bool imported; /* from a mesh: flat facets may stand for a curve that nobody tells of */
    double normal[3], tangent[3]; /* unit, orthogonal */
    double area_m2;
} facet;

typedef enum surface_kind {
    SURFACE_SPHERE,
    SURFACE_CONE, /* round about an axis, straight along it: cylinders too */
    SURFACE_PARABOLOID,
    SURFACE_SMOOTH, /* known by its normals at the vertices alone */
    SURFACE_FOIL    /* flat but crinkled: facets count with their own normals */
} surface_kind;

/* A curved surface that facets stand for: it says which way the matter under each of them looks.
 * A facet shows the side of it that its own normal shows. Component coordinates. */
typedef struct curved_surface {
    surface_kind kind;
    double centre_m[3]; /* of a sphere; a point of a cone's axis; the vertex of a paraboloid */
    double axis[3];     /* unit; of a paraboloid: towards its focus; of a foil: where it faces */
    double
        radius_m; /* of a sphere; of curvature at a paraboloid's vertex: twice the focal length */
    double lean;  /* of a cone: outward normal . axis; 0 for a cylinder */
} curved_surface;

/* A growing list of facets; zero-initialise. Owned arrays. */
typedef struct facet_list {
    facet *items;
    double (*vertices)[3];
    double (*normals)[3]; /* unit, at each vertex; only those of facets of a SURFACE_SMOOTH count;
                             NULL where there are none */
    curved_surface *surfaces;
    int n, capacity, n_vertices, vertex_capacity, n_surfaces, surface_capacity;
} facet_list;

void facet_list_free(facet_list *list);
/* Cuts the list back to what it was when it had that many facets, vertices and surfaces. */
void facet_list_truncate(facet_list *list, int n, int n_vertices, int n_surfaces);
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
/* Makes room for n more surfaces. Errors: GLINT_INTERNAL (memory). */
glint_status facet_list_reserve_surfaces(facet_list *list, int n, glint_error *error);
/* Appends a surface; *number is what facet.surface takes. Errors: GLINT_INTERNAL (memory). */
glint_status facet_list_add_surface(facet_list *list, const curved_surface *surface, int *number,
                                    glint_error *error);
/* Makes facet k of the list part of a SURFACE_SMOOTH: normals has one for each of its vertices
 * (unit, within 90 deg of the facet's normal). Errors: GLINT_INTERNAL (memory). */
glint_status facet_list_smooth(facet_list *list, int k, int surface, const double (*normals)[3],
                               glint_error *error);

/* Whether a facet stands for a piece of something curved, and is not merely crinkled. */
static inline bool facet_is_curved(const facet_list *list, const facet *f)
{
    return f->surface && list->surfaces[f->surface - 1].kind != SURFACE_FOIL;
}

/* What kind of value a key takes. */
typedef enum primitive_key_kind {
    KEY_NUMBER,    /* one number */
    KEY_COUNT,     /* one whole number */
    KEY_SWITCH,    /* true or false: 1 or 0 */
    KEY_VECTOR,    /* `length` (2 or 3) numbers */
    KEY_DIRECTION, /* 3 numbers, not all zero; need not be unit */
    KEY_POINTS,    /* 3 or more points of 3 numbers */
    KEY_MATERIAL,  /* the name of a material */
    KEY_FACES,     /* a table "+x".."-z" -> name of a material */
    KEY_WORD,      /* one of the row's words */
    KEY_PATH,      /* a file */
    KEY_NAMES,     /* a table: any name -> name of a material */
    KEY_CRINKLE    /* a table { facets_per_side, tilt_rms_deg, seed } */
} primitive_key_kind;

typedef struct primitive_key {
    const char *name, *unit, *doc; /* unit: "" where there is none */
    primitive_key_kind kind;
    int length; /* KEY_VECTOR */
    bool required;
    double def[3];   /* default of number kinds and KEY_WORD */
    double min, max; /* range of each number (closed; min_open: min itself is out); a KEY_DIRECTION
                        has none */
    bool min_open;
    const char *const *words; /* KEY_WORD: what may be said; the value is the number of the word */
    int n_words;
} primitive_key;

enum {
    PRIMITIVE_MAX_KEYS = 12,
    PRIMITIVE_NO_MATERIAL = -1,
    PRIMITIVE_MAX_FACETS = 5242880 /* 20 * 4^9: of one primitive with its copies */
};

/* A name that a file gives to some of its faces, and the material that it stands for. */
typedef struct primitive_name {
    const char *name; /* borrowed */
    int material;
    place where;
} primitive_name;

/* Crinkled foil: how a flat face is bent. */
typedef struct crinkle {
    int facets_per_side; /* 2 to CRINKLE_MAX; 0: the face stays flat */
    double tilt_rms_rad; /* above 0, to 60 deg */
    uint64_t seed;
} crinkle;

enum { CRINKLE_MAX = 256, CRINKLE_MOST_TILT_DEG = 60 };

/* A primitive as read: values in the order of its kind's keys. */
typedef struct primitive_spec {
    const struct primitive_kind *kind;
    place where;                         /* of the primitive's table */
    place key_place[PRIMITIVE_MAX_KEYS]; /* of each key's value; `where` if not given */
    bool given[PRIMITIVE_MAX_KEYS];
    double value[PRIMITIVE_MAX_KEYS][3]; /* number kinds and KEY_WORD; defaults filled in */
    int material[PRIMITIVE_MAX_KEYS];    /* KEY_MATERIAL; PRIMITIVE_NO_MATERIAL if not given */
    int face_material[6]; /* KEY_FACES, +x -x +y -y +z -z; NO_MATERIAL if not given */
    double (*points)[3];  /* KEY_POINTS; owned */
    int n_points;
    char *path;            /* KEY_PATH; owned */
    primitive_name *names; /* KEY_NAMES; owned */
    int n_names;
    crinkle crinkle; /* KEY_CRINKLE */
    /* Common to all: rotation about the primitive's centre (tangents too), then copies. */
    bool has_rotation;
    double rotation_axis[3], rotation_rad;  /* axis unit */
    int repeat_count;                       /* 1: no copies; the original included */
    double repeat_axis[3], repeat_step_rad; /* about the component's origin, axis unit */
    int mirror;                             /* 0 none; 1, 2, 3: also reflected in x, y, z = 0 */
    struct text
        *report; /* borrowed; gets lines on what was made of it, for people; NULL: not wanted */
} primitive_spec;

typedef struct primitive_kind {
    const char *name, *doc;
    const primitive_key *keys;
    int n_keys;
    /* Semantic checks that the ranges of single keys cannot make (tangent along normal, points not
     * planar or not convex, ...): all errors found, each at the key's place. NULL: none. */
    glint_status (*check)(const primitive_spec *spec, glint_errors *errors);
    /* Appends the primitive's facets, without rotation and copies. Only after check succeeded. What
     * went wrong is either in *error (zero before; its place is filled in where it has none), or
     * already among `errors`, which also takes warnings; NULL allowed. */
    glint_status (*build)(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *errors, glint_error *error);
    /* The point that rotation_deg turns about: the value of a key or, where the kind has none that
     * says it, what this function finds. */
    int centre_key;
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
 * facets. Errors: GLINT_INPUT from the checks, from the file that the primitive names, or when the
 * primitive with its copies has more than PRIMITIVE_MAX_FACETS facets; GLINT_INTERNAL (memory). On
 * error the list is unchanged. */
glint_status primitive_add(const primitive_spec *spec, int component, facet_list *out,
                           glint_errors *errors);

#endif
