/* visibility_sectors.h: what can come before each facet for all directions of a sector of the sky;
 * private to visibility*.c.
 *
 * The sky around a group of components that do not move to each other is divided into sectors. A
 * sector that is looked from again and again gets lists: for each exposed facet of the group, the
 * occluders of the same group that may cover some of it for some direction in the sector. Then the
 * walk through the group's tree is spared, with most of what it finds in vain. A list may hold too
 * much, never too little, and has the order of the walk: fractions are the same bits with lists and
 * without. Each thread makes its own. */
#ifndef GLINT_FACETS_VISIBILITY_SECTORS_H
#define GLINT_FACETS_VISIBILITY_SECTORS_H

#include "facets/visibility_view.h"

#include <limits.h>

/* The lists of one sector for one group. Items of facet e, the exposed one number e of the group:
 * items[first[e]] to items[first[e + 1] - 1]. */
typedef struct sector_lists {
    int *first; /* NULL: not made */
    int *items; /* occluders; those of a fan around a corner of the facet less SECTOR_FAN */
    int n_visits;
} sector_lists;

/* Set off an occluder's index in a list, where it belongs to a fan. */
enum { SECTOR_FAN = 1 << 30, SECTOR_WALK = INT_MAX };

typedef struct sectors {
    sector_lists *lists;  /* owned; of each root, one sector after the other */
    size_t bytes;         /* of all lists */
    view view;            /* along the middle of a sector */
    unsigned char *marks; /* owned; of each occluder: how it belongs to the facet at hand */
    int *nodes, *found;   /* owned; for the walk */
    int *items;           /* owned; that are being gathered */
    int item_capacity;
} sectors;

/* False when memory is out; sectors_free is due either way. */
bool sectors_allocate(sectors *s, const visibility *plan);
void sectors_free(sectors *s, const visibility *plan);

/* The lists for a view's direction and a root of the plan; makes them when it is time. NULL where
 * there are none: also when memory is out, since the walk serves as well. */
const sector_lists *sectors_visit(sectors *s, const visibility *plan, const visibility_pose *poses,
                                  const view *v, int root);

#endif
