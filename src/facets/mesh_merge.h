/* mesh_merge.h: adjoining triangles of one plane and one material, as convex polygons; private to
 * this room. */
#ifndef GLINT_FACETS_MESH_MERGE_H
#define GLINT_FACETS_MESH_MERGE_H

#include "facets/mesh.h"

/* Convex polygons over the vertices of a mesh. Owned arrays. */
typedef struct mesh_polygons {
    int n;
    int *first;  /* n + 1: the corners of polygon k are corner[first[k]] .. [first[k + 1] - 1] */
    int *corner; /* vertices of the mesh, anticlockwise seen from outside */
    int *face;   /* a face of the mesh that is part of each */
} mesh_polygons;

void mesh_polygons_free(mesh_polygons *p);

/* Faces that adjoin along an edge (mesh_twins) are one polygon where they have the same `group`
 * (one number per face; negative: never merged), lie within flat_m (m) of their mean plane, look
 * the same way, and the polygon is convex; corners at which it goes straight on within flat_m are
 * dropped unless a neighbour turns there. Faces look the same way within MERGE_ANGLE_RAD and what
 * flat_m makes of low triangles, at most 3e-4 rad more. Areas and outlines are kept to flat_m.
 * normals: unit, one per face. Errors: GLINT_INTERNAL (memory). */
glint_status mesh_merge(const mesh *m, const int *group, const double (*normals)[3], double flat_m,
                        mesh_polygons *out, glint_error *error);

/* Smaller than the 0.005 deg by which a specular flash is placed. */
#define MERGE_ANGLE_RAD 5e-5

#endif
