/* polygon.h: convex polygons in a plane, and the area of one that others leave uncovered.
 *
 * A polygon is a ring of points, anticlockwise, without its first point repeated. All lengths are
 * in one unit (m here, areas m^2). `near` is the distance below which two things are at one place:
 * a few times the rounding error of the coordinates. Decisions that turn on less than `near` change
 * areas by no more than `near` times the length of the outlines, whichever way they fall: areas are
 * always divided, never counted twice or lost. */
#ifndef GLINT_FACETS_POLYGON_H
#define GLINT_FACETS_POLYGON_H

#include "base/error.h"
#include "facets/lanes.h"

typedef struct point2 {
    double x, y;
} point2;

typedef struct box2 {
    double lo_x, lo_y, hi_x, hi_y;
} box2;

static inline bool boxes_overlap(const box2 *a, const box2 *b)
{
    return (a->lo_x < b->hi_x) & (b->lo_x < a->hi_x) & (a->lo_y < b->hi_y) & (b->lo_y < a->hi_y);
}

/* Area by the shoelace formula; negative when the ring runs clockwise. n: 0 or more. */
double polygon_area(const point2 *points, int n);

/* Length of the outline; n: 1 or more. */
double polygon_perimeter(const point2 *points, int n);

/* Smallest box along the axes around n >= 1 points. */
box2 polygon_box(const point2 *points, int n);

/* Leaves out, in place, points that lie within `near` of the line through their neighbours or on
 * the inner side of it, so that every corner that is left turns by more than its rounding error.
 * Returns how many are left: 0 where that is less than 3. */
int polygon_tidy(point2 *points, int n, double near);

/* The convex hull (Andrew 1979, Information Processing Letters 9(5) 216), in `hull`, which has room
 * for n + 1 points; `points` is sorted. Returns the number of corners, fewer than 3 where all
 * points are on one line. */
int polygon_hull(point2 *points, int n, point2 *hull);

/* How a polygon lies to a second one that may cover it. */
typedef enum polygon_relation {
    POLYGON_APART,   /* they share no area */
    POLYGON_CROSSED, /* a part of it is covered */
    POLYGON_COVERED  /* all of it is */
} polygon_relation;

/* Lines along four edges of a polygon: a point is inside of line j by (a x + b y + c)[j] in units
 * of the edge's rough length; `slack` is `near` in these units. Lanes without an edge have
 * everything inside. */
typedef struct polygon_lines {
    double4 a, b, c, slack;
} polygon_lines;

/* A growing list of polygons; zero-initialise. Owned arrays. */
typedef struct polygon_item {
    int first, n;    /* in polygon_list.points */
    int first_lines; /* in polygon_list.lines: one for every four edges */
    box2 box;
} polygon_item;

typedef struct polygon_list {
    point2 *points;
    polygon_lines *lines;
    polygon_item *items;
    int n, capacity, n_points, point_capacity, n_lines, line_capacity;
} polygon_list;

void polygon_list_free(polygon_list *list);
void polygon_list_clear(polygon_list *list);
/* Room for a polygon of n points behind the last one, to be filled by the caller; NULL when memory
 * is out. */
point2 *polygon_list_room(polygon_list *list, int n);
/* Takes in the polygon of n points that was written there, tidied; one that is left without area
 * (false) is not taken. */
bool polygon_list_take(polygon_list *list, int n, double near);
/* Takes the last polygon out again. */
void polygon_list_drop(polygon_list *list);

/* How polygon k of a list lies to polygon `cover` of another or the same. Two convex polygons share
 * no area when a line along an edge of one of them parts them (the separating axis theorem). */
polygon_relation polygon_relate(const polygon_list *list, int k, const polygon_list *covers,
                                int cover);

/* The same, but that only the cover's edges are tried: apart may be taken for crossed. */
polygon_relation polygon_relate_to_edges(const polygon_list *list, int k,
                                         const polygon_list *covers, int cover);

/* Whether n >= 1 points are all outside the same edge of polygon k of a list: then their convex
 * hull shares no area with it. */
bool polygon_has_aside(const polygon_list *list, int k, const point2 *points, int n);

/* Memory that polygon_uncovered_area works in; zero-initialise; grows as needed; owned arrays. */
typedef struct polygon_work {
    polygon_list parts; /* a stack */
    point2 *spare;
    struct polygon_task *tasks;
    int *lists, *ends;
    struct four_edges *edges;
    int spare_capacity, n_tasks, task_capacity, n_lists, list_capacity, end_capacity, edge_capacity;
} polygon_work;

void polygon_work_free(polygon_work *work);

/* The area of polygon `subject` of a list that no polygon of `covers` covers: exact but for
 * rounding. Fastest when every one of these crosses it. Few covers: the areas that they share with
 * it, less what they share among each other. Many, of which few share area, as the facets of a dish
 * do: the same, one cover after the other. Else the polygon is divided, along the edges of a cover
 * or, where there are many, in halves, until each part meets few. Time: about linear in the number
 * of covers where few cross at one place, at worst their number to the third power; memory: the
 * parts of one branch at a time. Errors: GLINT_INTERNAL (memory). */
glint_status polygon_uncovered_area(const polygon_list *list, int subject,
                                    const polygon_list *covers, double near, polygon_work *work,
                                    double *area, glint_error *error);

#endif
