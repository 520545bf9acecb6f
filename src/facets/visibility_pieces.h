/* visibility_pieces.h: the facets cut up along outlines and shadows, as polygons: for pictures, and
 * wherever the area alone does not do.
 *
 * Seen from one direction, lit from another, both at infinity. What visibility_fill gives as a
 * fraction of a facet's area is here the area of its pieces that are seen and lit. */
#ifndef GLINT_FACETS_VISIBILITY_PIECES_H
#define GLINT_FACETS_VISIBILITY_PIECES_H

#include "facets/visibility.h"

typedef enum visibility_light {
    VISIBILITY_LIT,
    VISIBILITY_SHADOWED,    /* turned to the source, but something is before it */
    VISIBILITY_TURNED_AWAY, /* from the source, or edge-on */
    VISIBILITY_BACK         /* of a facet that has no other side: black, and seen from behind */
} visibility_light;

/* A convex part of a facet that is seen. */
typedef struct visibility_piece {
    int facet;
    visibility_light light;
    int first, n;   /* in visibility_pieces.points, anticlockwise as seen by the observer */
    double area_m2; /* on the facet, not foreshortened */
} visibility_piece;

/* What is drawn along an edge between two facets. */
typedef enum visibility_edge_kind {
    VISIBILITY_RIM,    /* beyond it the surface ends, or turns out of sight */
    VISIBILITY_CREASE, /* the other facet is seen, too */
    VISIBILITY_SMOOTH  /* so it is, and both stand for one curved surface or lie in one plane */
} visibility_edge_kind;

/* A part of an edge of a facet that is seen. Where both facets are seen it is listed once. */
typedef struct visibility_edge {
    int facet, neighbour; /* neighbour: -1 where there is none */
    visibility_edge_kind kind;
    double turn_rad; /* between the normals of the two; 0 without a neighbour */
    double from_m[3], to_m[3];
} visibility_edge;

/* Points in the frame of the poses, m. Owned arrays. */
typedef struct visibility_pieces {
    visibility_piece *items;
    double (*points)[3];
    visibility_edge *edges;
    int n, n_points, n_edges, capacity, point_capacity, edge_capacity;
} visibility_pieces;

/* Finds all pieces, facet by facet. plan: made from m; poses: of all components, as of
 * visibility_fill. source_body: unit; NULL: nothing casts a shadow, and whatever faces the observer
 * counts as turned away from the light. casts_shadows: false: only what is turned away is unlit.
 * observer_body: unit. visibility_pieces_free is due either way. Errors: GLINT_INTERNAL (memory).
 */
glint_status visibility_pieces_find(const visibility *plan, const model *m,
                                    const visibility_pose *poses, const double *source_body,
                                    bool casts_shadows, const double observer_body[3],
                                    visibility_pieces *out, glint_error *error);
void visibility_pieces_free(visibility_pieces *pieces);

#endif
