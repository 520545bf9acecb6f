/* solids.h: what the facets of a model form together: the corners that they share, the edges along
 * which they meet, and the closed and convex bodies among them. */
#ifndef GLINT_FACETS_SOLIDS_H
#define GLINT_FACETS_SOLIDS_H

#include "facets/model.h"

/* An edge along which two facets meet: `left` runs through it from `from` to `to`, `right` the
 * other way. */
typedef struct solid_edge {
    int from, to;    /* vertices */
    int left, right; /* facets */
} solid_edge;

typedef enum solid_kind {
    SOLID_OPEN,   /* has a rim, or is inside out: seen from both sides */
    SOLID_SHEET,  /* two facets, back to back: one polygon */
    SOLID_CLOSED, /* encloses a volume (or none, but has no rim), outside on the side of its normals
                   */
    SOLID_CONVEX  /* closed and convex, as boxes and spheres are */
} solid_kind;

/* Facets of one component that hang together along edges. */
typedef struct solid {
    solid_kind kind;
    int component;
    int first_facet, n_facets; /* in solids.facets */
    int first_edge, n_edges;   /* in solids.edges */
} solid;

typedef struct solids {
    int n_vertices;
    double (*vertices)[3]; /* owned; m, component coordinates; those of a component side by side */
    int *corners;          /* owned; the vertex at each entry of model.polygons.vertices */
    int n;
    solid *items;      /* owned */
    int *facets;       /* owned; facets of the model, solid after solid */
    solid_edge *edges; /* owned; edges of the solids, solid after solid */
    int n_edges;
} solids;

/* Finds the solids of a model. A body counts as closed when every edge of every facet is shared
 * with exactly one other that runs through it the other way (where more than two facets meet at an
 * edge, those that bound the same wedge of matter belong together; where more than 64 do, they
 * count as rims, so that what hangs on them is open and casts its shadow facet by facet). Time: n
 * log n in the number of corners. Errors: GLINT_INTERNAL (memory). */
glint_status solids_find(const model *m, solids *out, glint_error *error);
void solids_free(solids *s);

#endif
