/* visibility_view.h: the model as seen from a direction; private to visibility*.c.
 *
 * Coordinates x, y lie across the direction and z towards whoever looks, so that what lies before a
 * facet casts its shadow on it straight down along z: in x and y the shadow is the outline itself.
 */
#ifndef GLINT_FACETS_VISIBILITY_VIEW_H
#define GLINT_FACETS_VISIBILITY_VIEW_H

#include "facets/lanes.h"
#include "facets/visibility_plan.h"

/* Boxes of a node's children, wider than they are by the rounding of floats; empty where there is
 * no child or nothing that counts. Of z only the end that is nearest to the one who looks matters.
 */
typedef struct view_node {
    float8 lo_x, hi_x, lo_y, hi_y, hi_z;
} view_node;

typedef struct view_box {
    float lo_x, hi_x, lo_y, hi_y, hi_z;
} view_box;

/* What an occluder hides in a view: a ring of points, anticlockwise. */
typedef struct view_ring {
    int first, n; /* in view.points; n: VIEW_NOT_TRACED, or 0 where nothing is hidden or known */
} view_ring;

enum { VIEW_NOT_TRACED = -1 };

typedef struct view {
    bool valid, has_boxes;
    double towards_body[3]; /* unit; that the following was computed for */
    double width;           /* sine of the angle by which the view may be turned; 0 */
    double basis[9];        /* rows: x, y, z axes in the body frame */
    double (*axes)[9];      /* owned; of each component: rows: x, y, z axes in its frame */
    double (*shift_m)[3];   /* owned; where its origin lies */
    double (*vertices)[3];  /* owned; m */
    double *cosine;         /* owned; of each facet: z of its normal */
    view_node *nodes;       /* owned */
    view_box *roots;        /* owned; around each tree */
    double (*points)[3];    /* owned; m; those of an occluder side by side, from its `first` on */
    view_ring *rings;       /* owned; of each occluder */
    int *next;              /* owned; of each vertex: the next one on an outline; scratch */
} view;

/* False when memory is out; view_free is due either way. */
bool view_allocate(view *v, const visibility *plan);
void view_free(view *v);

/* Looks from a direction (unit, body frame), unless that was done already. */
void view_set(const visibility *plan, const visibility_pose *poses, const double towards_body[3],
              view *v);

/* The same for all directions that lie within an angle of that one: polygons count that may be
 * turned to any of them. sine: of the angle, 0 to 1. Outlines are those along the middle. */
void view_set_wide(const visibility *plan, const visibility_pose *poses,
                   const double towards_body[3], double sine, view *v);

/* The outline of occluder k, which is traced if need be; empty where rounding makes a mess of a
 * body's facets that are all but edge-on. */
view_ring view_outline(const visibility *plan, view *v, int k);

enum { SHAFT_SIDES = 8 };

/* What lies before a facet in a view, seen from it: points above its plane, where
 * normal . point > offset, and inside sides through its edges along z, where a x + b y + c > 0 (the
 * first eight edges; sides that are not used let everything through). */
typedef struct shaft {
    double normal[3], offset_m, contact_m; /* what rises no higher than that counts as not above */
    double slope;                          /* by which it widens with the height above lo_z */
    double4 a[SHAFT_SIDES / 4], b[SHAFT_SIDES / 4], c[SHAFT_SIDES / 4];
    int n_fours; /* of sides */
    double lo_x, hi_x, lo_y, hi_y, lo_z;
} shaft;

/* The shaft before a facet; a side lets through what is more than a rounding error inside. slope:
 * 0, or the tangent of an angle, for all directions within that of the view's. */
void shaft_make(const visibility *plan, const view *v, const exposed_facet *f, double slope,
                shaft *out);

/* Lists the occluders of the trees from one to before another whose boxes reach into the shaft;
 * returns how many. nodes: scratch for plan.n_nodes + NODE_CHILDREN; out: room for plan.n_occluders
 * + NODE_CHILDREN. */
int view_candidates(const visibility *plan, view *v, const shaft *s, int first_root, int end_root,
                    int *nodes, int *out);

/* How points lie to the shaft: any of these. */
enum {
    SHAFT_ASIDE = 1,  /* all are outside one of the sides */
    SHAFT_BELOW = 2,  /* none is above the plane */
    SHAFT_CROSSES = 4 /* some are behind the plane */
};
unsigned view_relate(const shaft *s, const double (*points)[3], int n);

#endif
