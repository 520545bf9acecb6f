/* What bodies that go through facets hide of them for good. */
#include "facets/visibility_planner.h"

#include "base/grow.h"
#include "base/vec.h"
#include "facets/polygon.h"

#include <stdlib.h>

/* Sections as they are found, and memory to find them in. */
typedef struct section_list {
    section *items;      /* owned; become the plan's */
    double (*points)[3]; /* owned; become the plan's */
    int n, n_points, capacity, point_capacity;
    point2 *corners, *hull; /* owned */
    double *heights_m;      /* owned; of each vertex */
    polygon_list outlines;
} section_list;

static bool make_room(section_list *list, int n_points)
{
    return grow_room(&list->items, &list->capacity, list->n + 1L, sizeof *list->items) &&
           grow_room(&list->points, &list->point_capacity, (long)list->n_points + n_points,
                     sizeof *list->points);
}

/* A facet's plane, with axes in it from its first corner. */
typedef struct sheet {
    const plane *own;
    const double *from_m;
    double x[3], y[3];
} sheet;

static point2 in_sheet(const sheet *s, const double at_m[3])
{
    double d[3];
    sub3(at_m, s->from_m, d);
    return (point2){dot3(s->x, d), dot3(s->y, d)};
}

/* The hull of a body's corners in a plane, and of where its edges go through it, in list->hull;
 * none where the body does not rise over the plane. A corner nearer than rounding may count to
 * either side in a view: here it lies in the plane, so that what it bounds is not lost. */
static int cut_body(const planner *p, const sheet *s, const occluder *o, section_list *list)
{
    const double near_m = 4.0 * p->plan->near_m;
    double highest_m = -INFINITY;
    int n = 0;
    for (int c = o->first; c < o->first + o->n; c++) {
        const int v = p->plan->corners[c];
        const double height_m = dot3(s->own->normal, p->vertices[v]) - s->own->offset_m;
        list->heights_m[v] = height_m;
        highest_m = fmax(highest_m, height_m);
        if (fabs(height_m) <= near_m) list->corners[n++] = in_sheet(s, p->vertices[v]);
    }
    if (highest_m <= s->own->contact_m) return 0;
    for (int e = o->first_edge; e < o->first_edge + o->n_edges; e++) {
        const solid_edge *edge = &p->solids.edges[e];
        const double from_m = list->heights_m[edge->from], to_m = list->heights_m[edge->to];
        double way[3], at_m[3];
        if (!(fmax(from_m, to_m) > near_m && fmin(from_m, to_m) < -near_m)) continue;
        sub3(p->vertices[edge->to], p->vertices[edge->from], way);
        add_scaled3(p->vertices[edge->from], from_m / (from_m - to_m), way, at_m);
        list->corners[n++] = in_sheet(s, at_m);
    }
    return n < 3 ? 0 : polygon_hull(list->corners, n, list->hull);
}

/* Whether the hull in list->hull may share area with the facet. */
static bool meets_outline(const planner *p, const sheet *s, const exposed_facet *f, int n,
                          section_list *list)
{
    polygon_list_clear(&list->outlines); /* it has room */
    for (int k = 0; k < f->n; k++)
        list->outlines.points[k] = in_sheet(s, p->vertices[p->solids.corners[f->first + k]]);
    return polygon_list_take(&list->outlines, f->n, p->plan->near_m) &&
           !polygon_has_aside(&list->outlines, 0, list->hull, n);
}

/* Appends the section of a body by a facet's plane. */
static bool add_section(const planner *p, const exposed_facet *f, int body, section_list *list)
{
    const occluder *o = &p->plan->occluders[body];
    const int *ring = p->solids.corners + f->first;
    const visibility_pose *pose = &p->components[f->component].pose;
    sheet s = {.own = &p->planes[f->facet], .from_m = p->vertices[ring[0]]};
    sub3(p->vertices[ring[1]], s.from_m, s.x);
    unit3(s.x, s.x);
    cross3(s.own->normal, s.x, s.y);
    int n = cut_body(p, &s, o, list);
    if (n > 0 && !meets_outline(p, &s, f, n, list)) n = 0;
    if (!make_room(list, n)) return false;
    list->items[list->n++] = (section){body, list->n_points, n};
    for (int k = 0; k < n; k++) {
        double at_m[3], *out = list->points[list->n_points++];
        add_scaled3(s.from_m, list->hull[k].x, s.x, at_m);
        add_scaled3(at_m, list->hull[k].y, s.y, at_m);
        sub3(at_m, pose->origin_m, at_m);
        mat_tvec(pose->body_component, at_m, out);
    }
    return true;
}

static bool boxes_meet(const double a[6], const double b[6], double margin_m)
{
    for (int j = 0; j < 3; j++)
        if (a[j] > b[3 + j] + margin_m || b[j] > a[3 + j] + margin_m) return false;
    return true;
}

/* Whether all corners of a body are outside the side of a facet's outline along one of its edges,
 * by more than what counts as contact. */
static bool is_beside_edge(const planner *p, const exposed_facet *f, const occluder *o, int edge)
{
    const int *ring = p->solids.corners + f->first;
    const double *from = p->vertices[ring[edge]];
    double along[3], inwards[3], d[3];
    sub3(p->vertices[ring[(edge + 1) % f->n]], from, along);
    cross3(p->planes[f->facet].normal, along, inwards);
    if (!(unit3(inwards, inwards) > 0.0)) return false;
    for (int c = o->first; c < o->first + o->n; c++) {
        sub3(p->vertices[p->plan->corners[c]], from, d);
        if (dot3(d, inwards) > -VISIBILITY_CONTACT * p->plan->size_m) return false;
    }
    return true;
}

/* Whether all corners of a facet are outside a face of a body. */
static bool is_before_face(const planner *p, const exposed_facet *f, int face)
{
    const plane *own = &p->planes[face];
    for (int c = f->first; c < f->first + f->n; c++) {
        const double *at = p->vertices[p->solids.corners[c]];
        if (dot3(own->normal, at) - own->offset_m < own->contact_m) return false;
    }
    return true;
}

/* Whether a body may go through a facet; false only where it certainly does not. */
static bool may_pierce(const planner *p, const exposed_facet *f, const occluder *o)
{
    const plane *own = &p->planes[f->facet];
    double least_m = INFINITY;
    for (int c = o->first; c < o->first + o->n; c++) {
        const double *at = p->vertices[p->plan->corners[c]];
        least_m = fmin(least_m, dot3(own->normal, at) - own->offset_m);
    }
    if (least_m > own->contact_m) return false;
    for (int edge = 0; edge < f->n; edge++)
        if (is_beside_edge(p, f, o, edge)) return false;
    for (int e = o->first_edge; e < o->first_edge + o->n_edges; e++)
        if (is_before_face(p, f, p->solids.edges[e].left) ||
            is_before_face(p, f, p->solids.edges[e].right))
            return false;
    return true;
}

/* Appends the bodies below a node that may go through a facet; box: the facet's. */
static bool list_piercing(const planner *p, const exposed_facet *f, const double box[6], int k,
                          section_list *list)
{
    const visibility *plan = p->plan;
    const plan_node *node = &plan->nodes[k];
    bool ok = true;
    if (!boxes_meet(box, p->box[k], VISIBILITY_CONTACT * plan->size_m)) return true;
    for (int j = 0; j < node->n && ok; j++) {
        const int child = node->child[j];
        if (!node->leaf)
            ok = list_piercing(p, f, box, child, list);
        else if (plan->occluders[child].facet < 0 && child != f->own &&
                 may_pierce(p, f, &plan->occluders[child]))
            ok = add_section(p, f, child, list);
    }
    return ok;
}

glint_status planner_find_sections(const planner *p, glint_error *error)
{
    visibility *plan = p->plan;
    section_list list = {0};
    const size_t most = (size_t)plan->most_corners + (size_t)plan->most_edges;
    list.corners = malloc(most * sizeof *list.corners);
    list.hull = malloc((most + 1) * sizeof *list.hull);
    list.heights_m = malloc((size_t)plan->n_vertices * sizeof *list.heights_m);
    bool ok = list.corners && list.hull && list.heights_m &&
              polygon_list_room(&list.outlines, plan->most_corners);
    for (int k = 0; k < plan->n_exposed && ok; k++) {
        exposed_facet *f = &plan->exposed[k];
        double box[6];
        planner_box(p, p->solids.corners + f->first, f->n, box);
        f->first_section = list.n;
        ok = list_piercing(p, f, box, plan->roots[f->root].node, &list);
        f->n_sections = list.n - f->first_section;
    }
    plan->sections = list.items;
    plan->section_points = list.points;
    free(list.corners);
    free(list.hull);
    free(list.heights_m);
    polygon_list_free(&list.outlines);
    return ok ? GLINT_OK : error_no_memory(error);
}
