/* crinkle.h: rectangles of crinkled foil; private to this room. */
#ifndef GLINT_FACETS_CRINKLE_H
#define GLINT_FACETS_CRINKLE_H

#include "facets/primitive_kinds.h"

#define CRINKLE_KEY                                                                                \
    {                                                                                              \
        .name = "crinkle", .unit = "",                                                             \
        .doc = "{ facets_per_side, tilt_rms_deg, seed }: crinkled foil in place of flat faces",    \
        .kind = KEY_CRINKLE                                                                        \
    }

/* A rectangle: corner, and the edges from there along the first and the second side, m. It looks
 * along first x second. */
typedef struct rectangle {
    double corner_m[3], first_m[3], second_m[3];
    double tangent[3];
    int material, back_material; /* back_material: PRIMITIVE_NO_MATERIAL for none */
} rectangle;

/* What became of crinkled rectangles: sums over the facets of their fronts. */
typedef struct crinkle_sums {
    int n_facets;                 /* of the front */
    double projected_m2, area_m2; /* of the front */
    double along2, across2, all2; /* tilts squared, rad^2, times projected area: sums */
    double most_rad;
} crinkle_sums;

/* Appends a crinkled rectangle, and its back. The foil is cut into facets_per_side^2 equal cells of
 * two triangles each. Their inner corners are raised and lowered at random, those on the outline
 * stay: the outline, the projected area along the normal and the vector area are those of the flat
 * rectangle, and rectangles that share an edge still do. The heights are scaled so that the angle
 * between the normals of the triangles and of the rectangle is tilt_rms_rad, in the root of its
 * mean square over the projected area. The foil's own area is larger than the outline's. c: with
 * facets_per_side not 0. face: tells the faces of one primitive apart. sums: adds to them. Errors:
 * GLINT_INTERNAL (memory). */
glint_status rectangle_crinkle(const rectangle *r, const crinkle *c, uint64_t face, int component,
                               facet_list *out, crinkle_sums *sums, glint_error *error);

/* Adds a line on them to the primitive's report, where that is wanted. */
void crinkle_report(const primitive_spec *spec, const crinkle_sums *sums);

#endif
