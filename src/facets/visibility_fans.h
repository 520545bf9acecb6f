/* visibility_fans.h: facets around a corner that cannot hide each other; private to visibility*.c.
 *
 * Seen from a side from which all facets around a corner of a surface are turned to the one who
 * looks, they lie around it like the blades of a fan, one beside the other. None hides any part of
 * another: each is convex, and so it stays within its blade. On meshes most facets that come near a
 * facet are such neighbours, and to know them spares work. */
#ifndef GLINT_FACETS_VISIBILITY_FANS_H
#define GLINT_FACETS_VISIBILITY_FANS_H

#include "facets/solids.h"

/* The closed fans of a model. A vertex has one, or several where surfaces meet in it, as the two
 * sides of a thin dish do. It has none where it is on a rim, where its facets are turned to no side
 * all together, as about a needle's point, and where they go around it more than once. Convex
 * bodies and sheets have none: their facets cast no shadows of their own. */
typedef struct fans {
    int n;
    int *first;     /* owned; n + 1: where a fan's facets begin in `facets` */
    int *facets;    /* owned */
    int *at_corner; /* owned; of each entry of model.polygons.vertices: the fan around that corner
                       that its facet is part of; -1 for none */
} fans;

/* Errors: GLINT_INTERNAL (memory). */
glint_status fans_find(const model *m, const solids *s, fans *out, glint_error *error);
void fans_free(fans *f);

#endif
