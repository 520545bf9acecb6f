/* mesh.h: triangles from files of others; private to this room. */
#ifndef GLINT_FACETS_MESH_H
#define GLINT_FACETS_MESH_H

#include "base/text.h"
#include "facets/primitive.h"

/* What a file says of some of its faces; owned, NULL where it says nothing. */
typedef struct mesh_label {
    char *material; /* OBJ: usemtl */
    char *group;    /* OBJ: g, names parted by single blanks */
    char *object;   /* OBJ: o; STL: solid */
    int line;       /* of the first face */
    int n_faces;
} mesh_label;

/* A triangle, anticlockwise seen from outside. */
typedef struct mesh_face {
    int corner[3]; /* in mesh.vertices */
    int normal[3]; /* in mesh.normals; -1: none is given */
    int label;
    int line; /* where it stands; of a binary file: its number from 1 */
} mesh_face;

/* A mesh as its file has it; zero-initialise. Owned arrays. */
typedef struct mesh {
    double (*vertices)[3]; /* in the file's units and axes */
    double (*normals)[3];  /* unit */
    mesh_face *faces;
    mesh_label *labels;
    int n_vertices, n_normals, n_faces, n_labels;
    int vertex_capacity, normal_capacity, face_capacity, label_capacity;
    bool is_binary;     /* mesh_face.line counts triangles */
    int n_backward;     /* STL: faces whose normal in the file looks the other way */
    int first_backward; /* its line */
} mesh;

void mesh_free(mesh *m);

enum {
    MESH_MAX_FACES = PRIMITIVE_MAX_FACETS,
    MESH_MAX_VERTICES = 50000000,
    MESH_MAX_CORNERS = 1000, /* of one polygon */
    MESH_MAX_ERRORS = 20     /* of one file: reading ends there */
};

/* Reads a Wavefront OBJ or an STL file (text or binary), told apart by the suffix. Polygons of more
 * than three corners are cut into triangles. *out is mesh_free's on success and empty on error.
 * asked_from: place of the value that names the file. most: coordinates may have this size, in the
 * file's units. Errors (GLINT_INPUT, at the line of the file; of an OBJ file all of them, up to
 * MESH_MAX_ERRORS): unreadable; another suffix; what is not of the format; a number that is none,
 * or larger than `most`; a face that names a corner that does not exist, or whose outline crosses
 * itself; no faces, or more than MESH_MAX_FACES; a file that ends too early, as far as its format
 * shows. GLINT_INTERNAL: memory. */
glint_status mesh_read(const char *path, place asked_from, double most, mesh *out,
                       glint_errors *errors);

/* A file that is being read. */
typedef struct mesh_source {
    const char *path;
    const char *bytes; /* terminated by a zero byte that does not count */
    size_t size;
    double most; /* as of mesh_read */
    glint_errors *errors;
} mesh_source;

/* What the readers say of a number beyond `most`, with the two. */
#define MESH_TOO_FAR                                                                               \
    "has the coordinate %g; expected at most %g, which is 1e7 m: check unit or scale"

/* The readers of the two formats. */
glint_status mesh_read_obj(const mesh_source *source, mesh *out);
glint_status mesh_read_stl(const mesh_source *source, mesh *out);

/* For the readers. Each appends one thing; errors as above, and GLINT_INTERNAL (memory). */
glint_status mesh_add_vertex(mesh *m, const double v[3], place where, glint_errors *errors);
glint_status mesh_add_normal(mesh *m, const double v[3], glint_errors *errors);
glint_status mesh_add_face(mesh *m, const mesh_face *face, place where, glint_errors *errors);
/* Takes over the texts of the label. */
glint_status mesh_add_label(mesh *m, const mesh_label *label, glint_errors *errors);

/* Cuts a simple polygon into n - 2 triangles by their corners' numbers in it. vertices: n of them,
 * any unit, in space; where they are not in one plane, their mean plane counts. where: of the
 * polygon. Errors: GLINT_INPUT when its outline crosses itself; GLINT_INTERNAL (memory). */
glint_status mesh_cut_polygon(const double (*vertices)[3], int n, int (*triangles)[3], place where,
                              glint_errors *errors);

#endif
