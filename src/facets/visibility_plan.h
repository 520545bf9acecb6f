/* visibility_plan.h: what is known of shadows from the model alone; private to visibility*.c. */
#ifndef GLINT_FACETS_VISIBILITY_PLAN_H
#define GLINT_FACETS_VISIBILITY_PLAN_H

#include "facets/solids.h"
#include "facets/visibility.h"

/* What rises over a facet's plane by less than this fraction of the model's size touches it: room
 * for coordinates written with 10 digits. Shadows of such things are left out. */
#define VISIBILITY_CONTACT 1e-10

/* Something that casts one convex shadow: a polygon, or a closed convex body. */
typedef struct occluder {
    int component;
    int first, n; /* its corners, in plan.corners: of a polygon in order, of a body in any */
    int facet;    /* a polygon lies in its plane, anticlockwise seen from outside; -1 for a body */
    bool both_sides; /* a polygon: else it only counts where its facet is turned to the light: where
                        light goes through a closed body, it meets such a facet */
    int first_edge, n_edges; /* a body's, in plan.edges */
} occluder;

/* A facet that something can come before at some time. Component frame. */
typedef struct exposed_facet {
    int facet, component;
    int root;                      /* of the tree that its group has */
    int own;                       /* the occluder that it is part of */
    int first, n;                  /* its corners, in plan.rings */
    double normal[3], offset_m;    /* unit; normal . point of the plane */
    double contact_m;              /* what rises no higher over the plane lies in it */
    int first_section, n_sections; /* in plan.sections: bodies that may go through it */
} exposed_facet;

/* What a facet's plane cuts out of a body of its group: hidden from all directions. */
typedef struct section {
    int body;     /* the occluder */
    int first, n; /* in plan.section_points; n: 0 where it shares nothing with the facet */
} section;

/* A facet of those around a vertex that form a closed fan (visibility_fans.h). */
typedef struct fan_blade {
    int facet, occluder;
} fan_blade;

enum { NODE_CHILDREN = 8 };

/* A node of the trees over the occluders: its children are all nodes or all occluders. There is a
 * tree for every group of components that do not move to each other. Children come after their
 * parents. */
typedef struct plan_node {
    bool leaf;                /* its children are occluders */
    int n;                    /* children */
    int child[NODE_CHILDREN]; /* indices of nodes or occluders */
} plan_node;

/* The tree of a group. */
typedef struct plan_root {
    int node;
    int component;                /* one of the group */
    int first_exposed, n_exposed; /* facets of the group, in plan.exposed */
} plan_root;

/* Vertices, occluders and exposed facets are in the order of the trees: what is near in space is
 * near in memory. */
struct visibility {
    int n_facets, n_components, n_vertices, n_corners, n_occluders, n_nodes, n_roots, n_exposed;
    double (*vertices)[3];  /* owned; m, component frame; those of a component side by side */
    int *first_vertex;      /* owned; n_components + 1 */
    double *normals;        /* owned; x of all facets, then y, then z: component frame */
    int *first_facet;       /* owned; n_components + 1 */
    exposed_facet *exposed; /* owned */
    bool *is_exposed;       /* owned; n_facets */
    int *rings;             /* owned; n_corners vertices: corners of the facets */
    occluder *occluders;    /* owned */
    int *flats;             /* owned; of each occluder: those of one number lie in one plane of
                               a group, and hide nothing of each other's facets */
    int *corners;           /* owned; n_corners vertices: corners of the occluders */
    int *beyond;            /* owned; n_corners: of a polygon, the facet beyond the edge from this
                               corner to the next; -1 where there is none, or a splinter */
    solid_edge *edges;      /* owned; of the bodies */
    int *component_root;    /* owned; of each component: the tree of its group */
    section *sections;      /* owned; of exposed facets */
    double (*section_points)[3]; /* owned; m, frame of the facet's component; anticlockwise as seen
                                    from where its normal points to */
    int *fan_at;           /* owned; at each entry of `rings`: the fan around this corner that the
                              facet is part of; -1 for none */
    int *first_blade;      /* owned; of each fan, and one more */
    fan_blade *blades;     /* owned; those of a fan side by side */
    plan_node *nodes;      /* owned */
    plan_root *roots;      /* owned */
    double size_m;         /* greatest distance from the body's origin */
    double near_m;         /* rounding error of coordinates, for polygon.h */
    int most_corners;      /* of an occluder or a facet */
    int most_edges;        /* of a body */
    struct ray_plan *rays; /* owned; NULL: fractions are exact */
};

#endif
