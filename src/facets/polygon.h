/* polygon.h: convex polygons in a plane, and the area of one that others leave uncovered.
 *
 * A polygon is a ring of points, anticlockwise, without its first point repeated. All lengths are in
 * one unit (m here, areas m^2). `near` is the distance below which two things are at one place: a
 * few times the rounding error of the coordinates. Decisions that turn on less than `near` change
 * areas by no more than `near` times the length of the outlines, whichever way they fall: areas are
 * always divided, never counted twice or lost. */
#ifndef GLINT_FACETS_POLYGON_H
#define GLINT_FACETS_POLYGON_H

#include "base/error.h"

typedef struct point2 {
    double x, y;
} point2;

typedef struct box2 {
    double lo_x, lo_y, hi_x, hi_y;
} box2;

/* Area by the shoelace formula; negative when the ring runs clockwise. n: 0 or more. */
double polygon_area(const point2 *points, int n);

/* Smallest box along the axes around n >= 1 points. */
box2 polygon_box(const point2 *points, int n);

/* Leaves out, in place, points that lie within `near` of the line through their neighbours or on the
 * inner side of it, so that every corner that is left turns by more than its rounding error. Returns
 * how many are left: 0 where that is less than 3. */
int polygon_tidy(point2 *points, int n, double near);

/* The convex hull (Andrew 1979, Information Processing Letters 9(5) 216), in `hull`, which has room
 * for n + 1 points; `points` is sorted. Returns the number of corners, fewer than 3 where all points
 * are on one line. */
int polygon_hull(point2 *points, int n, point2 *hull);

/* Cuts a polygon along the line from `a` in the direction `along`: `left` and `right` get the parts on
 * its two sides (room for n + 1 points each; neither may be `points`). Points within `near` of the line
 * belong to both. A side without area gets 0 points. */
void polygon_cut(const point2 *points, int n, point2 a, point2 along, double near, point2 *left,
                 int *n_left, point2 *right, int *n_right);

/* How a polygon lies to a second one that may cover it. */
typedef enum polygon_relation {
    POLYGON_APART,  /* they share no area */
    POLYGON_CROSSED, /* a part of it is covered */
    POLYGON_COVERED /* all of it is */
} polygon_relation;

/* Both polygons tidy. Two convex polygons share no area when a line along an edge of one of them parts
 * them (the separating axis theorem). */
polygon_relation polygon_relate(const point2 *points, int n, const point2 *cover, int n_cover,
                                double near);

/* A growing list of polygons; zero-initialise. Owned arrays. */
typedef struct polygon_item {
    int first, n; /* in polygon_list.points */
    box2 box;
} polygon_item;

typedef struct polygon_list {
    point2 *points;
    polygon_item *items;
    int n, capacity, n_points, point_capacity;
} polygon_list;

void polygon_list_free(polygon_list *list);
void polygon_list_clear(polygon_list *list);
/* Room for a polygon of n points behind the last one, to be filled by the caller; NULL when memory is
 * out. */
point2 *polygon_list_room(polygon_list *list, int n);
/* Takes in the polygon of n points that was written there, tidied; one that is left without area
 * (false) is not taken. */
bool polygon_list_take(polygon_list *list, int n, double near);
/* Takes the last polygon out again. */
void polygon_list_drop(polygon_list *list);

/* Memory that polygon_uncovered_area works in; zero-initialise; grows as needed; owned arrays. */
typedef struct polygon_work {
    struct polygon_piece *pieces;
    point2 *points, *spare[2];
    int *lists;
    int n_pieces, piece_capacity, n_points, point_capacity, spare_capacity[2], n_lists,
        list_capacity;
} polygon_work;

void polygon_work_free(polygon_work *work);

/* The area of a tidy polygon that no polygon of the list covers: exact but for rounding. The polygon
 * is divided along the edges of those that cross it, one after the other; where there are many, it is
 * first halved until each part meets few. Time: about linear in the number of covers where they are
 * small or few cross at one place, at worst their number to the third power; memory: the pieces of
 * one branch at a time. Errors: GLINT_INTERNAL (memory). */
glint_status polygon_uncovered_area(const point2 *points, int n, const polygon_list *covers,
                                    double near, polygon_work *work, double *area,
                                    glint_error *error);

#endif
