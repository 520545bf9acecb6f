/* mesh_smooth.h: which faces of a mesh stand for a curved surface, and its normals; private to this
 * room. */
#ifndef GLINT_FACETS_MESH_SMOOTH_H
#define GLINT_FACETS_MESH_SMOOTH_H

#include "facets/mesh_mend.h"

/* Where smooth normals come from. */
typedef struct smoothing {
    bool from_file; /* what the file says */
    double below;   /* rad: else, from faces that meet at less than this angle; 0: none */
} smoothing;

/* The normals of the matter at the corners of faces. Owned arrays, one entry for each face. */
typedef struct mesh_corners {
    bool *is_smooth;
    double (*normal)[3][3]; /* unit; only those of smooth faces count */
} mesh_corners;

void mesh_corners_free(mesh_corners *c);

/* A face is smooth when the normals at its corners differ from each other. Normals of the file that
 * look away from a face's own do not count; such faces are noted as DEFECT_BACKWARD, together with
 * what the reader found. normals: unit, of the faces. Errors: GLINT_INTERNAL (memory). */
glint_status mesh_smooth(const mesh *m, const double (*normals)[3], const smoothing *how,
                         mesh_corners *out, mesh_defects *defects, glint_error *error);

#endif
