/* visibility_planner.h: how the plan of visibility_plan.h is made, step by step; private to
 * visibility_plan.c, which takes the steps in the order in which they stand here, and to the files
 * of the steps.
 *
 * Places are in the body frame, in m, at the moment of the components' poses; vertices have the
 * numbers that the solids give them, until visibility_plan.c numbers them anew in the end. Errors
 * of all steps: GLINT_INTERNAL (memory); what they have put into the plan by then is the plan's. */
#ifndef GLINT_FACETS_VISIBILITY_PLANNER_H
#define GLINT_FACETS_VISIBILITY_PLANNER_H

#include "facets/visibility_plan.h"

/* A facet's plane. */
typedef struct plane {
    double normal[3], offset_m; /* unit; normal . point of the plane */
    double contact_m;           /* what rises no higher over the plane lies in it */
} plane;

/* What is needed on the way. */
typedef struct planner {
    const model *m;
    const visibility_component *components;
    visibility *plan;
    solids solids;         /* owned */
    double (*vertices)[3]; /* owned */
    plane *planes;         /* owned; of the facets */
    int *own;              /* owned; the occluder that each facet is part of */
    int *group;            /* owned; of each component: those that never move to each other */
    int *hinge; /* owned; of each group: the component by whose hinge it turns; -1 for the body's */
    int n_groups;
    double (*box)[6]; /* owned; of each node: lowest and highest x, y, z */
    int *node_group;  /* owned; of each node */
    int caster;       /* the only component that counts as casting shadows; ALL_CAST: all do */
} planner;

enum { ALL_CAST = -1 };

/* Finds the groups of components, and their hinges. Components that do not move belong to their
 * parent's group; group 0 is the body's. */
void planner_find_groups(planner *p);

/* Builds the trees over the occluders, one for each group that has any, and puts the occluders and
 * p->own into the order of the leaves. Takes the groups, occluders and vertices. */
glint_status planner_build_trees(planner *p, glint_error *error);

/* Marks the facets that p->caster can come before, at any angles of the hinges, in
 * plan.is_exposed, which is all false before. Takes the planes and trees. */
glint_status planner_find_exposed(const planner *p, glint_error *error);

/* Lists the facets that are marked, in the order of the trees. */
glint_status planner_list_exposed(const planner *p, glint_error *error);

/* Gives polygons of a group that lie in one plane the same number in plan.flats, and all other
 * occluders numbers of their own. */
glint_status planner_find_flats(const planner *p, glint_error *error);

/* Lists, for each exposed facet, what its plane cuts out of the bodies of its group that may go
 * through it. */
glint_status planner_find_sections(const planner *p, glint_error *error);

/* The box around n vertices, n > 0: lowest and highest x, y, z. */
void planner_box(const planner *p, const int *vertices, int n, double box[6]);

#endif
