/* The fractions, moment by moment: what covers each facet in the two views, and what that leaves.
 * The facet is brought to the view in which it is less foreshortened; what lies before it in the
 * other one is carried over through the facet's plane. */
#include "base/vec.h"
#include "facets/polygon.h"
#include "facets/visibility_view.h"

#include <math.h>
#include <stdlib.h>

struct visibility_scratch {
    visibility_pose *poses; /* owned; that the views were computed for */
    bool has_poses;
    view views[2];        /* of the source, of the observer */
    polygon_list outline; /* of the facet, in the plane of its better view */
    polygon_list covers;  /* there too */
    polygon_work work;
    point2 *points;          /* owned; of a body's part before the facet */
    int *nodes, *candidates; /* owned; for the walk through the trees; what it found */
    unsigned *passed_over;   /* owned; of each occluder: number of the last search that did so */
    unsigned n_searches;
};

/* A facet in one view. */
typedef struct target {
    const exposed_facet *facet;
    view *view;
    double near_m;
    shaft shaft;
    const double *from; /* its first corner */
    double to_plane[4]; /* x, y relative to that, to the plane of the better view: row-major */
} target;

/* --- the target --- */

/* A side lets through what is more than a rounding error inside. */
static void make_shaft(const visibility *plan, const view *v, const exposed_facet *f, shaft *s)
{
    const int *ring = plan->rings + f->first;
    double a[SHAFT_SIDES] = {0}, b[SHAFT_SIDES] = {0}, c[SHAFT_SIDES] = {1, 1, 1, 1, 1, 1, 1, 1};
    mat_vec(v->axes[f->component], f->normal, s->normal);
    s->offset_m = f->offset_m + dot3(s->normal, v->shift_m[f->component]);
    s->contact_m = f->contact_m;
    s->lo_x = s->lo_y = INFINITY, s->hi_x = s->hi_y = -INFINITY;
    for (int k = 0; k < f->n; k++) {
        const double *p = v->vertices[ring[k]], *q = v->vertices[ring[k + 1 < f->n ? k + 1 : 0]];
        const double x = p[0], y = p[1], dx = q[0] - x, dy = q[1] - y;
        s->lo_x = x < s->lo_x ? x : s->lo_x, s->hi_x = x > s->hi_x ? x : s->hi_x;
        s->lo_y = y < s->lo_y ? y : s->lo_y, s->hi_y = y > s->hi_y ? y : s->hi_y;
        if (k >= SHAFT_SIDES) continue;
        a[k] = -dy, b[k] = dx;
        c[k] = dy * x - dx * y - plan->near_m * (fabs(dx) + fabs(dy));
    }
    s->n_fours = f->n > 4 ? 2 : 1;
    for (int k = 0; k < s->n_fours; k++) {
        const int j = 4 * k;
        s->a[k] = (double4){a[j], a[j + 1], a[j + 2], a[j + 3]};
        s->b[k] = (double4){b[j], b[j + 1], b[j + 2], b[j + 3]};
        s->c[k] = (double4){c[j], c[j + 1], c[j + 2], c[j + 3]};
    }
}

static void set_target(const visibility *plan, view *v, const exposed_facet *f, target *t)
{
    t->facet = f;
    t->view = v;
    t->near_m = plan->near_m;
    t->from = v->vertices[plan->rings[f->first]];
    t->to_plane[0] = t->to_plane[3] = 1.0;
    t->to_plane[1] = t->to_plane[2] = 0.0;
    make_shaft(plan, v, f, &t->shaft);
}

/* What is at x, y in one view of a point of the facet's plane is at to_plane (x, y) in the other: z
 * follows from normal . point = 0, and the three are turned. Where the facet is foreshortened, this
 * magnifies rounding errors. */
static void carry_over(const view *to, target *from)
{
    const double *a = from->view->basis, *b = to->basis;
    const double *normal = from->shaft.normal;
    const double dz_dx = -normal[0] / normal[2], dz_dy = -normal[1] / normal[2];
    double most = 1.0;
    for (int row = 0; row < 2; row++) {
        const double *axis = b + 3 * row, z = dot3(axis, a + 6);
        from->to_plane[2 * row] = dot3(axis, a) + z * dz_dx;
        from->to_plane[2 * row + 1] = dot3(axis, a + 3) + z * dz_dy;
        most = fmax(most, fabs(from->to_plane[2 * row]));
        most = fmax(most, fabs(from->to_plane[2 * row + 1]));
    }
    from->near_m *= most;
}

/* Height of a point over the facet's plane. */
static inline double height_of(const target *t, const double p[3])
{
    return dot3(t->shaft.normal, p) - t->shaft.offset_m;
}

/* Where the point that lies at x, y in the view comes to lie in the plane of the better one. */
static inline point2 in_plane(const target *t, double x, double y)
{
    const double dx = x - t->from[0], dy = y - t->from[1];
    return (point2){t->to_plane[0] * dx + t->to_plane[1] * dy,
                    t->to_plane[2] * dx + t->to_plane[3] * dy};
}

/* Where the way from p to q, at these heights, goes through the facet's plane. */
static point2 crossing(const target *t, const double p[3], const double q[3], double height_p,
                       double height_q)
{
    const double s = height_p / (height_p - height_q);
    return in_plane(t, p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]));
}

/* --- covers --- */

/* How the search for covers ended. */
typedef enum outcome { PARTLY_COVERED, ALL_COVERED, NO_MEMORY } outcome;

/* Takes in a cover that was written behind the list, if it covers any of the facet. */
static outcome take_cover(const target *t, visibility_scratch *s, int n)
{
    if (!polygon_list_take(&s->covers, n, t->near_m)) return PARTLY_COVERED;
    const polygon_relation relation = polygon_relate(&s->outline, 0, &s->covers, s->covers.n - 1);
    if (relation == POLYGON_APART) polygon_list_drop(&s->covers);
    return relation == POLYGON_COVERED ? ALL_COVERED : PARTLY_COVERED;
}

/* A ring that is wholly before the facet's plane. */
static outcome cover_by_ring(const target *t, visibility_scratch *s, const double (*ring)[3], int n)
{
    point2 *room = polygon_list_room(&s->covers, n);
    if (!room) return NO_MEMORY;
    for (int k = 0; k < n; k++)
        room[k] = in_plane(t, ring[k][0], ring[k][1]);
    return take_cover(t, s, n);
}

/* The part of a polygon before the facet's plane. */
static outcome cover_by_part(const target *t, visibility_scratch *s, const double (*ring)[3], int n)
{
    point2 *room = polygon_list_room(&s->covers, 2 * n);
    if (!room) return NO_MEMORY;
    int count = 0;
    double height_m = height_of(t, ring[0]);
    for (int k = 0; k < n; k++) {
        const double *p = ring[k], *q = ring[k + 1 < n ? k + 1 : 0];
        const double next_m = height_of(t, q);
        if (height_m >= 0.0) room[count++] = in_plane(t, p[0], p[1]);
        if ((height_m > 0.0 && next_m < 0.0) || (height_m < 0.0 && next_m > 0.0))
            room[count++] = crossing(t, p, q, height_m, next_m);
        height_m = next_m;
    }
    return take_cover(t, s, count);
}

/* The part of a body before the facet's plane: the hull of its corners there and of the points
 * where its edges go through the plane. */
static outcome cover_by_hull(const visibility *plan, const target *t, visibility_scratch *s,
                             const occluder *o)
{
    const double(*const vertices)[3] = (const double(*)[3])t->view->vertices;
    int n = 0;
    double highest_m = -INFINITY;
    for (int c = o->first; c < o->first + o->n; c++) {
        const double *p = vertices[plan->corners[c]], height_m = height_of(t, p);
        highest_m = fmax(highest_m, height_m);
        if (height_m >= 0.0) s->points[n++] = in_plane(t, p[0], p[1]);
    }
    if (highest_m <= t->facet->contact_m) return PARTLY_COVERED;
    for (int e = o->first_edge; e < o->first_edge + o->n_edges; e++) {
        const double *p = vertices[plan->edges[e].from], *q = vertices[plan->edges[e].to];
        const double at_p = height_of(t, p), at_q = height_of(t, q);
        if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0))
            s->points[n++] = crossing(t, p, q, at_p, at_q);
    }
    point2 *room = polygon_list_room(&s->covers, n + 1);
    if (!room) return NO_MEMORY;
    return take_cover(t, s, polygon_hull(s->points, n, room));
}

/* Takes in what an occluder covers of the facet. A body may rise before the facet's plane where its
 * outline does not. */
static outcome cover_by(const visibility *plan, const target *t, visibility_scratch *s, int k)
{
    const view_ring outline = view_outline(plan, t->view, k);
    if (outline.n == 0) return cover_by_hull(plan, t, s, &plan->occluders[k]);
    const double(*ring)[3] = (const double(*)[3])t->view->points + outline.first;
    const shaft_relation lies = view_relate(&t->shaft, ring, outline.n);
    if (lies.aside) return PARTLY_COVERED;
    if (!lies.below && !lies.crosses_plane) return cover_by_ring(t, s, ring, outline.n);
    if (plan->occluders[k].facet < 0) return cover_by_hull(plan, t, s, &plan->occluders[k]);
    return lies.below ? PARTLY_COVERED : cover_by_part(t, s, ring, outline.n);
}

/* Marks the facet's neighbours around those of its corners from which all are turned to the one who
 * looks: they hide nothing of it. */
static void pass_over_fans(const visibility *plan, const target *t, visibility_scratch *s)
{
    if (++s->n_searches == 0) { /* after 4 294 967 295 of them */
        memset(s->passed_over, 0, (size_t)plan->n_occluders * sizeof *s->passed_over);
        s->n_searches = 1;
    }
    s->passed_over[t->facet->own] = s->n_searches;
    for (int c = t->facet->first; c < t->facet->first + t->facet->n; c++) {
        const int first = plan->first_blade[plan->rings[c]];
        const int end = plan->first_blade[plan->rings[c] + 1];
        bool open = true;
        for (int k = first; k < end; k++)
            open &= t->view->cosine[plan->blades[k].facet] > BRDF_EDGE;
        for (int k = first; open && k < end; k++)
            s->passed_over[plan->blades[k].occluder] = s->n_searches;
    }
}

/* Takes in everything that lies before the facet in one view. */
static outcome find_covers(const visibility *plan, const target *t, visibility_scratch *s)
{
    const int n = view_candidates(plan, t->view, &t->shaft, s->nodes, s->candidates);
    if (n == 0) return PARTLY_COVERED;
    pass_over_fans(plan, t, s);
    for (int k = 0; k < n; k++) {
        if (s->passed_over[s->candidates[k]] == s->n_searches) continue;
        const outcome found = cover_by(plan, t, s, s->candidates[k]);
        if (found != PARTLY_COVERED) return found;
    }
    return PARTLY_COVERED;
}

/* --- the fraction --- */

/* Traces the facet in its better view, relative to its first corner; false where it is so nearly
 * edge-on that its outline is lost in rounding. */
static bool trace_facet(const visibility *plan, const target *t, visibility_scratch *s)
{
    const exposed_facet *f = t->facet;
    polygon_list_clear(&s->outline);
    point2 *room = polygon_list_room(&s->outline, f->n); /* made sure of when s was made */
    for (int k = 0; k < f->n; k++) {
        const double *p = t->view->vertices[plan->rings[f->first + k]];
        room[k] = in_plane(t, p[0], p[1]);
    }
    return polygon_list_take(&s->outline, f->n, t->near_m);
}

/* The fraction of a facet that is lit and seen; it is turned to both. */
static glint_status fraction_of(const visibility *plan, visibility_scratch *s,
                                const exposed_facet *f, double *fraction, glint_error *error)
{
    const bool source_first = s->views[0].cosine[f->facet] >= s->views[1].cosine[f->facet];
    view *better = &s->views[source_first ? 0 : 1], *other = &s->views[source_first ? 1 : 0];
    target t;
    *fraction = 0.0;
    polygon_list_clear(&s->covers);
    set_target(plan, better, f, &t);
    if (!trace_facet(plan, &t, s)) return GLINT_OK;
    outcome found = find_covers(plan, &t, s);
    if (found == PARTLY_COVERED) {
        set_target(plan, other, f, &t);
        carry_over(better, &t);
        found = find_covers(plan, &t, s);
    }
    if (found == NO_MEMORY) return error_no_memory(error);
    if (found == ALL_COVERED) return GLINT_OK;
    *fraction = 1.0;
    if (s->covers.n == 0) return GLINT_OK;
    double left_m2;
    const glint_status status =
        polygon_uncovered_area(&s->outline, 0, &s->covers, t.near_m, &s->work, &left_m2, error);
    const polygon_item *outline = &s->outline.items[0];
    const double all_m2 = polygon_area(s->outline.points + outline->first, outline->n);
    *fraction = fmin(1.0, fmax(0.0, left_m2 / all_m2));
    return status;
}

/* Whether a facet is lit and seen, but for what comes before it. */
static bool is_turned_to_both(const visibility_scratch *s, int k)
{
    return s->views[0].cosine[k] > BRDF_EDGE && s->views[1].cosine[k] > BRDF_EDGE;
}

glint_status visibility_fill(const visibility *plan, visibility_scratch *s,
                             const visibility_pose *poses, const double sun_body[3],
                             const double observer_body[3], int lane, double *visible,
                             glint_error *error)
{
    const size_t size = (size_t)plan->n_components * sizeof *poses;
    if (!s->has_poses || memcmp(s->poses, poses, size) != 0) {
        memcpy(s->poses, poses, size);
        s->has_poses = true;
        s->views[0].valid = s->views[1].valid = false;
    }
    view_set(plan, poses, sun_body, &s->views[0]);
    view_set(plan, poses, observer_body, &s->views[1]);
    for (int k = 0; k < plan->n_facets; k++)
        visible[(size_t)k * BRDF_TILE + (size_t)lane] = is_turned_to_both(s, k) ? 1.0 : 0.0;
    for (int k = 0; k < plan->n_exposed; k++) {
        const exposed_facet *f = &plan->exposed[k];
        if (!is_turned_to_both(s, f->facet)) continue;
        double *fraction = visible + (size_t)f->facet * BRDF_TILE + (size_t)lane;
        const glint_status status = fraction_of(plan, s, f, fraction, error);
        if (status) return status;
    }
    return GLINT_OK;
}

/* --- scratch --- */

glint_status visibility_scratch_make(const visibility *plan, visibility_scratch **out,
                                     glint_error *error)
{
    *out = NULL;
    visibility_scratch *s = calloc(1, sizeof *s);
    if (!s) return error_no_memory(error);
    const size_t n = (size_t)plan->most_corners, n_hull = n + (size_t)plan->most_edges;
    s->poses = malloc((size_t)plan->n_components * sizeof *s->poses);
    s->points = malloc(n_hull * sizeof *s->points);
    /* the walk writes a whole node's children and then keeps some */
    s->nodes = malloc(((size_t)plan->n_nodes + NODE_CHILDREN) * sizeof *s->nodes);
    s->candidates = malloc(((size_t)plan->n_occluders + NODE_CHILDREN) * sizeof *s->candidates);
    s->passed_over = calloc((size_t)plan->n_occluders, sizeof *s->passed_over);
    const bool views = view_allocate(&s->views[0], plan) && view_allocate(&s->views[1], plan);
    const bool outline = polygon_list_room(&s->outline, plan->most_corners);
    if (!views || !outline || !s->poses || !s->points || !s->nodes || !s->candidates ||
        !s->passed_over) {
        visibility_scratch_free(s);
        return error_no_memory(error);
    }
    *out = s;
    return GLINT_OK;
}

void visibility_scratch_free(visibility_scratch *s)
{
    if (!s) return;
    free(s->poses);
    view_free(&s->views[0]);
    view_free(&s->views[1]);
    polygon_list_free(&s->outline);
    polygon_list_free(&s->covers);
    polygon_work_free(&s->work);
    free(s->points);
    free(s->nodes);
    free(s->candidates);
    free(s->passed_over);
    free(s);
}
