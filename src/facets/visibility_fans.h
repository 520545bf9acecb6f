/* visibility_fans.h: facets around a corner that cannot hide each other; private to visibility*.c.
 *
 * Seen from a side from which all facets around a corner of a surface are turned to the one who
 * looks, they lie around it like the blades of a fan, one beside the other. None hides any part of
 * another: each is convex, and so it stays within its blade. On meshes most facets that come near a
 * facet are such neighbours, and to know them spares work. */
#ifndef GLINT_FACETS_VISIBILITY_FANS_H
#define GLINT_FACETS_VISIBILITY_FANS_H

#include "facets/solids.h"

/* The facets around each vertex where they form one closed fan; none for all other vertices, such
 * as those on a rim, and none of convex bodies, whose facets cast no shadows of their own. */
typedef struct fans {
    int *first;  /* owned; n_vertices + 1: where a vertex's facets begin in `facets` */
    int *facets; /* owned */
    int n_facets;
} fans;

/* Errors: GLINT_INTERNAL (memory). */
glint_status fans_find(const solids *s, fans *out, glint_error *error);
void fans_free(fans *f);

#endif
