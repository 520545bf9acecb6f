/* The fractions, moment by moment: what covers each facet in the two views, and what that leaves.
 * The facet is brought to the view in which it is less foreshortened; what lies before it in the
 * other one is carried over through the facet's plane. */
#include "base/vec.h"
#include "facets/polygon.h"
#include "facets/visibility_rays.h"
#include "facets/visibility_sectors.h"

#include <math.h>
#include <stdlib.h>

struct visibility_scratch {
    const visibility *plan; /* borrowed */
    visibility_pose *poses; /* owned; that the views were computed for */
    bool has_poses;
    view views[2]; /* of the source, of the observer */
    sectors sectors;
    const sector_lists *
        *lists[2];        /* owned; for each view and root; NULL: the tree is to be walked */
    polygon_list outline; /* of the facet, in the plane of its better view */
    polygon_list covers;  /* there too */
    polygon_work work;
    point2 *points;          /* owned; of a body's part before the facet */
    double (*ring)[3];       /* owned; what matters of an outline */
    long long *sides;        /* owned; for trimming: of each point of an outline, and the first */
    int *kept;               /* owned; likewise: points that matter */
    double *heights_m;       /* owned; of each vertex, where they are asked for */
    int *nodes, *candidates; /* owned; for the walk through the trees; what it found */
    unsigned *passed_over;   /* owned; of each occluder: number of the last search that did so */
    unsigned n_searches;
    int n_whole; /* polygons among the covers of a view that are wholly before the facet */
    bool ragged; /* some edge of these, with nothing beyond, may lie across the facet */
};

/* Rings of more corners are trimmed before they are looked at more closely. */
enum { WORTH_TRIMMING = 12 };

/* Cosine below which a facet beyond an edge may be lost in rounding (visibility_plan.c: SPLINTER).
 */
#define FORESHORTENED 1e-3

/* A facet in one view. */
typedef struct target {
    const exposed_facet *facet;
    view *view;
    const sector_lists *lists; /* of the facet's group; NULL: none */
    double near_m;
    shaft shaft;
    const double *from; /* its first corner */
    double to_plane[4]; /* x, y relative to that, to the plane of the better view: row-major */
} target;

/* --- the target --- */

static void set_target(const visibility *plan, visibility_scratch *s, int which,
                       const exposed_facet *f, target *t)
{
    view *v = &s->views[which];
    t->facet = f;
    t->view = v;
    t->lists = s->lists[which][f->root];
    t->near_m = plan->near_m;
    t->from = v->vertices[plan->rings[f->first]];
    t->to_plane[0] = t->to_plane[3] = 1.0;
    t->to_plane[1] = t->to_plane[2] = 0.0;
    shaft_make(plan, v, f, 0.0, &t->shaft);
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

/* Which sides of a box a point is outside of, a bit for each. */
static inline unsigned sides_outside(const box2 *box, const double *p)
{
    return (p[0] < box->lo_x) | (p[0] > box->hi_x) << 1 | (p[1] < box->lo_y) << 2 |
           (p[1] > box->hi_y) << 3;
}

/* The same of n points of `size` numbers each, of which the first two are x and y. */
CLONES static void find_sides(const box2 *box, const double *ring, int size, int n, long long *out)
{
    const long stride = size;
    int k = 0;
    for (; k + 4 <= n; k += 4) {
        const double *p = ring + stride * k;
        const double4 x = {p[0], p[stride], p[2 * stride], p[3 * stride]};
        const double4 y = {p[1], p[stride + 1], p[2 * stride + 1], p[3 * stride + 1]};
        *(mask4 *)(out + k) = ((x < box->lo_x) & 1) | ((x > box->hi_x) & 2) |
                              ((y < box->lo_y) & 4) | ((y > box->hi_y) & 8);
    }
    for (; k < n; k++)
        out[k] = sides_outside(box, ring + stride * k);
}

/* Leaves out of a ring what makes no difference inside a box: of points that follow each other
 * outside the same side of it, only the first and the last matter. Points of `size` numbers, of
 * which the first two are x and y. Returns how many are left, in `out`, which may be `ring`. */
static int trim(visibility_scratch *s, const box2 *box, const double *ring, int size, int n,
                double *out)
{
    long long *sides = s->sides, common = 0; /* `common` to all since the last one kept */
    int count = 0;
    find_sides(box, ring, size, n, sides);
    sides[n] = sides[0];
    for (int k = 0; k < n; k++) {
        const long long before = common & sides[k];
        const bool matters = (before & sides[k + 1]) == 0;
        common = matters ? sides[k] : before;
        s->kept[count] = k; /* a branch would be guessed wrong */
        count += matters;
    }
    for (int k = 0; k < count; k++)
        for (int j = 0; j < size; j++)
            out[(long)size * k + j] = ring[(long)size * s->kept[k] + j];
    return count;
}

/* How the search for covers ended. */
typedef enum outcome { PARTLY_COVERED, ALL_COVERED, NO_MEMORY } outcome;

/* Takes in a cover that was written behind the list, if it covers any of the facet. in_shaft: it is
 * known not to be outside any of the facet's edges. */
static outcome take_cover(const target *t, visibility_scratch *s, int n, bool in_shaft)
{
    const polygon_item *outline = &s->outline.items[0];
    double *points = &s->covers.points[s->covers.n_points].x;
    if (n > WORTH_TRIMMING) n = trim(s, &outline->box, points, 2, n, points);
    if (!polygon_list_take(&s->covers, n, t->near_m)) return PARTLY_COVERED;
    const polygon_relation relation = (in_shaft ? polygon_relate_to_edges : polygon_relate)(
        &s->outline, 0, &s->covers, s->covers.n - 1);
    if (relation == POLYGON_APART) polygon_list_drop(&s->covers);
    return relation == POLYGON_COVERED ? ALL_COVERED : PARTLY_COVERED;
}

/* A ring that is wholly before the facet's plane, and not outside any side of the shaft, which has
 * only the first SHAFT_SIDES of the facet's edges. */
static outcome cover_by_ring(const target *t, visibility_scratch *s, const double (*ring)[3], int n)
{
    point2 *room = polygon_list_room(&s->covers, n);
    if (!room) return NO_MEMORY;
    for (int k = 0; k < n; k++)
        room[k] = in_plane(t, ring[k][0], ring[k][1]);
    return take_cover(t, s, n, t->facet->n <= SHAFT_SIDES);
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
    return take_cover(t, s, count, false);
}

/* Heights of a body's corners over the facet's plane, in scratch.heights_m; returns the greatest.
 */
static double find_heights(const visibility *plan, const target *t, visibility_scratch *s,
                           const occluder *o)
{
    double highest_m = -INFINITY;
    for (int c = o->first; c < o->first + o->n; c++) {
        const int v = plan->corners[c];
        const double height_m = height_of(t, t->view->vertices[v]);
        s->heights_m[v] = height_m;
        highest_m = height_m > highest_m ? height_m : highest_m;
    }
    return highest_m;
}

/* Takes in the hull of the n points in scratch.points. */
static outcome cover_by_points(const target *t, visibility_scratch *s, int n)
{
    if (n == 0 || polygon_has_aside(&s->outline, 0, s->points, n)) return PARTLY_COVERED;
    point2 *room = polygon_list_room(&s->covers, n + 1);
    if (!room) return NO_MEMORY;
    return take_cover(t, s, polygon_hull(s->points, n, room), true);
}

/* Appends to n points those at which a body's edges go through the facet's plane.
 * A corner in the plane counts as before it, as it does in cover_by_part. */
static int add_crossings(const visibility *plan, const target *t, visibility_scratch *s,
                         const occluder *o, int n)
{
    const double(*const vertices)[3] = (const double(*)[3])t->view->vertices;
    for (int e = o->first_edge; e < o->first_edge + o->n_edges; e++) {
        const int from = plan->edges[e].from, to = plan->edges[e].to;
        const double at_p = s->heights_m[from], at_q = s->heights_m[to];
        if ((at_p >= 0.0) != (at_q >= 0.0))
            s->points[n++] = crossing(t, vertices[from], vertices[to], at_p, at_q);
    }
    return n;
}

/* Whether a body may meet the facet itself, not only its plane, and what it cuts out of it is not
 * known from the plan: it moves to the facet. */
static bool may_cut_anew(const visibility *plan, const exposed_facet *f, int k)
{
    return plan->component_root[plan->occluders[k].component] != f->root;
}

/* Takes in what bodies that go through the facet cut out of it: that is hidden from both sides. */
static outcome cover_by_sections(const visibility *plan, const target *t, visibility_scratch *s)
{
    const exposed_facet *f = t->facet;
    const double *axes = t->view->axes[f->component], *shift_m = t->view->shift_m[f->component];
    for (int k = f->first_section; k < f->first_section + f->n_sections; k++) {
        const section *own = &plan->sections[k];
        if (own->n == 0) continue;
        point2 *room = polygon_list_room(&s->covers, own->n);
        if (!room) return NO_MEMORY;
        for (int c = 0; c < own->n; c++) {
            double p[3];
            mat_vec(axes, plan->section_points[own->first + c], p);
            room[c] = in_plane(t, p[0] + shift_m[0], p[1] + shift_m[1]);
        }
        const outcome found = take_cover(t, s, own->n, false);
        if (found != PARTLY_COVERED) return found;
    }
    return PARTLY_COVERED;
}

/* Where the outline of a body is not known: the hull of its corners before the facet's plane and of
 * the points where its edges go through it. */
static outcome cover_by_hull(const visibility *plan, const target *t, visibility_scratch *s,
                             const occluder *o)
{
    int n = 0;
    if (find_heights(plan, t, s, o) <= t->facet->contact_m) return PARTLY_COVERED;
    for (int c = o->first; c < o->first + o->n; c++) {
        const double *p = t->view->vertices[plan->corners[c]];
        if (height_of(t, p) >= 0.0) s->points[n++] = in_plane(t, p[0], p[1]);
    }
    return cover_by_points(t, s, add_crossings(plan, t, s, o, n));
}

/* The part of a body before the facet's plane. What it hides ends at that part of its outline that
 * is before the plane, and at the section along which the plane cuts it: the section and the ring
 * of that part of the outline, closed straight through the section, cover the same together. */
static outcome cover_by_cut_body(const visibility *plan, const target *t, visibility_scratch *s,
                                 int k, const double (*ring)[3], int n, bool outline_below)
{
    const occluder *o = &plan->occluders[k];
    if (!outline_below) {
        const outcome found = cover_by_part(t, s, ring, n);
        if (found != PARTLY_COVERED) return found;
    }
    if (!may_cut_anew(plan, t->facet, k)) return PARTLY_COVERED;
    if (find_heights(plan, t, s, o) <= t->facet->contact_m) return PARTLY_COVERED;
    return cover_by_points(t, s, add_crossings(plan, t, s, o, 0));
}

/* Whether an edge may lie across the facet: it has points of the facet on its outer side, and its
 * ends are not both outside one side of the shaft. */
static bool lies_across(const visibility *plan, const target *t, const double from[3],
                        const double to[3])
{
    const exposed_facet *f = t->facet;
    const double dx = to[0] - from[0], dy = to[1] - from[1];
    const double slack = plan->near_m * (fabs(dx) + fabs(dy));
    bool beyond = false;
    for (int k = f->first; k < f->first + f->n && !beyond; k++) {
        const double *p = t->view->vertices[plan->rings[k]];
        beyond = dx * (p[1] - from[1]) - dy * (p[0] - from[0]) < -slack;
    }
    if (!beyond) return false;
    const double ends[2][3] = {{from[0], from[1], 0}, {to[0], to[1], 0}};
    return !(view_relate(&t->shaft, ends, 2) & SHAFT_ASIDE);
}

/* Notes whether a polygon that covers part of the facet ends there. Where it does not, the facet
 * beyond its edge goes on covering: it is turned the same way, so that it lies on the other side of
 * the edge, and the edge is not one in the plane of the facet that is to be covered. */
static void note_edges(const visibility *plan, const target *t, visibility_scratch *s,
                       const occluder *o, const double (*ring)[3])
{
    const double *cosine = t->view->cosine;
    const bool backwards = cosine[o->facet] < 0.0;
    s->n_whole++;
    for (int k = 0; k < o->n && !s->ragged; k++) {
        const double *from = ring[k], *to = ring[k + 1 < o->n ? k + 1 : 0];
        const int corner = !backwards ? k : k + 1 < o->n ? o->n - 2 - k : o->n - 1;
        const int beyond = plan->beyond[o->first + corner];
        const bool goes_on = beyond >= 0 &&
                             (backwards ? -cosine[beyond] : cosine[beyond]) > FORESHORTENED &&
                             fmax(height_of(t, from), height_of(t, to)) > t->facet->contact_m;
        s->ragged = !goes_on && lies_across(plan, t, from, to);
    }
}

/* Takes in what an occluder covers of the facet. A body may rise before the facet's plane where its
 * outline does not. */
static outcome cover_by(const visibility *plan, const target *t, visibility_scratch *s, int k)
{
    const view_ring outline = view_outline(plan, t->view, k);
    const double(*ring)[3] = (const double(*)[3])t->view->points + outline.first;
    const occluder *o = &plan->occluders[k];
    int n = outline.n;
    if (n == 0) return o->facet < 0 ? cover_by_hull(plan, t, s, o) : PARTLY_COVERED;
    if (n > WORTH_TRIMMING) {
        const shaft *before = &t->shaft;
        const box2 box = {before->lo_x, before->lo_y, before->hi_x, before->hi_y};
        n = trim(s, &box, ring[0], 3, n, s->ring[0]);
        ring = (const double(*)[3])s->ring;
    }
    const unsigned lies = view_relate(&t->shaft, ring, n);
    if (lies & SHAFT_ASIDE) return PARTLY_COVERED;
    const bool whole = lies == 0;
    if (o->facet < 0)
        return whole ? cover_by_ring(t, s, ring, n)
                     : cover_by_cut_body(plan, t, s, k, ring, n, lies & SHAFT_BELOW);
    if (lies & SHAFT_BELOW) return PARTLY_COVERED;
    const int n_covers = s->covers.n;
    const outcome found = whole ? cover_by_ring(t, s, ring, n) : cover_by_part(t, s, ring, n);
    if (s->covers.n > n_covers && whole)
        note_edges(plan, t, s, o, (const double(*)[3])t->view->points + outline.first);
    s->ragged |= s->covers.n > n_covers && !whole;
    return found;
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
        const int fan = plan->fan_at[c];
        if (fan < 0) continue;
        const int first = plan->first_blade[fan], end = plan->first_blade[fan + 1];
        bool open = true;
        for (int k = first; k < end; k++)
            open &= t->view->cosine[plan->blades[k].facet] > BRDF_EDGE;
        for (int k = first; open && k < end; k++)
            s->passed_over[plan->blades[k].occluder] = s->n_searches;
    }
}

/* Copies the list of a facet's own group; *in_fans is set where it has some of a fan. */
static int copy_list(const visibility *plan, const target *t, int *out, bool *in_fans)
{
    const long own = t->facet - plan->exposed - plan->roots[t->facet->root].first_exposed;
    const int *first = t->lists->first + own;
    const int n = first[1] - first[0], *items = t->lists->items + first[0];
    if (n == 1 && items[0] == SECTOR_WALK) return -1;
    for (int k = 0; k < n; k++) {
        const bool fan = items[k] < 0;
        out[k] = fan ? items[k] + SECTOR_FAN : items[k];
        *in_fans |= fan;
    }
    return n;
}

/* Lists what may lie before the facet in one view, in scratch.candidates; returns how many.
 * *in_fans: its neighbours may be among them, and itself. */
static int find_candidates(const visibility *plan, const target *t, visibility_scratch *s,
                           bool *in_fans)
{
    const int own = t->facet->root;
    *in_fans = false;
    int n = view_candidates(plan, t->view, &t->shaft, 0, own, s->nodes, s->candidates);
    const int listed = t->lists ? copy_list(plan, t, s->candidates + n, in_fans) : -1;
    *in_fans |= listed < 0;
    n += listed >= 0
             ? listed
             : view_candidates(plan, t->view, &t->shaft, own, own + 1, s->nodes, s->candidates + n);
    return n + view_candidates(plan, t->view, &t->shaft, own + 1, plan->n_roots, s->nodes,
                               s->candidates + n);
}

/* Takes in everything that lies before the facet in one view. Where polygons cover part of it and
 * none of them ends there, together they cover all of it. */
static outcome find_covers(const visibility *plan, const target *t, visibility_scratch *s)
{
    bool in_fans;
    const int n = find_candidates(plan, t, s, &in_fans);
    if (n == 0) return PARTLY_COVERED;
    if (in_fans) pass_over_fans(plan, t, s);
    s->n_whole = 0;
    s->ragged = false;
    const int own_flat = plan->flats[t->facet->own];
    for (int k = 0; k < n; k++) {
        if (plan->flats[s->candidates[k]] == own_flat) continue;
        if (in_fans && s->passed_over[s->candidates[k]] == s->n_searches) continue;
        const outcome found = cover_by(plan, t, s, s->candidates[k]);
        if (found != PARTLY_COVERED) return found;
    }
    return s->n_whole > 0 && !s->ragged ? ALL_COVERED : PARTLY_COVERED;
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

/* What is left of an outline when rounding alone leaves it, at most, m^2: each side of it and of
 * what n covers share with it may be off by `near`, and that, convex within convex, has no longer
 * an outline than it has itself. */
static double lost_in_rounding(const polygon_list *list, int subject, int n_covers, double near_m)
{
    const polygon_item *item = &list->items[subject];
    return near_m * polygon_perimeter(list->points + item->first, item->n) * (1.0 + n_covers);
}

/* The fraction of a facet that is lit and seen; it is turned to both. What is left
 * counts where rounding cannot have left it: slivers along the seams of covers would shine in the
 * dark. */
static glint_status fraction_of(const visibility *plan, visibility_scratch *s,
                                const exposed_facet *f, double *fraction, glint_error *error)
{
    const int better = s->views[0].cosine[f->facet] >= s->views[1].cosine[f->facet] ? 0 : 1;
    target t;
    *fraction = 0.0;
    polygon_list_clear(&s->covers);
    set_target(plan, s, better, f, &t);
    if (!trace_facet(plan, &t, s)) return GLINT_OK;
    outcome found = cover_by_sections(plan, &t, s);
    if (found == PARTLY_COVERED) found = find_covers(plan, &t, s);
    if (found == PARTLY_COVERED) {
        set_target(plan, s, 1 - better, f, &t);
        carry_over(&s->views[better], &t);
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
    const bool any = left_m2 > lost_in_rounding(&s->outline, 0, s->covers.n, t.near_m);
    *fraction = any ? fmin(1.0, left_m2 / all_m2) : 0.0;
    return status;
}

/* Whether a facet is lit and seen, but for what comes before it. */
static bool is_turned_to_both(const visibility_scratch *s, int k)
{
    return s->views[0].cosine[k] > BRDF_EDGE && s->views[1].cosine[k] > BRDF_EDGE;
}

/* Looks from both directions. */
static void set_views(const visibility *plan, visibility_scratch *s, const visibility_pose *poses,
                      const double sun_body[3], const double observer_body[3])
{
    const size_t size = (size_t)plan->n_components * sizeof *poses;
    if (!s->has_poses || memcmp(s->poses, poses, size) != 0) {
        memcpy(s->poses, poses, size);
        s->has_poses = true;
        s->views[0].valid = s->views[1].valid = false;
    }
    view_set(plan, poses, sun_body, &s->views[0]);
    view_set(plan, poses, observer_body, &s->views[1]);
    for (int which = 0; which < 2 && !plan->rays; which++)
        for (int root = 0; root < plan->n_roots; root++)
            s->lists[which][root] = sectors_visit(&s->sectors, plan, poses, &s->views[which], root);
}

/* Rays must be numbers: Embree ends the program where one is not. */
static glint_status check_numbers(const visibility *plan, const visibility_pose *poses,
                                  const double sun_body[3], const double observer_body[3],
                                  glint_error *error)
{
    double sum = 0.0;
    for (int j = 0; j < 3; j++)
        sum += fabs(sun_body[j]) + fabs(observer_body[j]);
    for (int c = 0; c < plan->n_components; c++) {
        for (int j = 0; j < 9; j++)
            sum += fabs(poses[c].body_component[j]);
        for (int j = 0; j < 3; j++)
            sum += fabs(poses[c].origin_m[j]);
    }
    if (isfinite(sum)) return GLINT_OK;
    return error_set(error, GLINT_INTERNAL, PLACE_NONE,
                     "a direction or a place of a component is no finite number");
}

glint_status visibility_fill(const visibility *plan, visibility_scratch *s,
                             const visibility_pose *poses, const double sun_body[3],
                             const double observer_body[3], int lane, double *visible,
                             glint_error *error)
{
    glint_status status = GLINT_OK;
    if (plan->rays) status = check_numbers(plan, poses, sun_body, observer_body, error);
    if (status) return status;
    set_views(plan, s, poses, sun_body, observer_body);
    for (int k = 0; k < plan->n_facets; k++)
        visible[(size_t)k * BRDF_TILE + (size_t)lane] = is_turned_to_both(s, k) ? 1.0 : 0.0;
    for (int k = 0; k < plan->n_exposed && !status; k++) {
        const exposed_facet *f = &plan->exposed[k];
        if (!is_turned_to_both(s, f->facet)) continue;
        double *fraction = visible + (size_t)f->facet * BRDF_TILE + (size_t)lane;
        if (plan->rays)
            *fraction = ray_plan_fraction(plan, plan->rays, poses, f, sun_body, observer_body);
        else
            status = fraction_of(plan, s, f, fraction, error);
    }
    return status;
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
    s->heights_m = malloc((size_t)plan->n_vertices * sizeof *s->heights_m);
    s->ring = malloc(n * sizeof *s->ring);
    s->sides = malloc((n + n_hull + 2) * sizeof *s->sides); /* of parts of rings, and of hulls */
    s->kept = malloc((n + n_hull + 1) * sizeof *s->kept);
    s->points = malloc(n_hull * sizeof *s->points);
    /* the walk writes a whole node's children and then keeps some */
    s->nodes = malloc(((size_t)plan->n_nodes + NODE_CHILDREN) * sizeof *s->nodes);
    s->candidates = malloc(((size_t)plan->n_occluders + NODE_CHILDREN) * sizeof *s->candidates);
    s->passed_over = calloc((size_t)plan->n_occluders, sizeof *s->passed_over);
    const bool views = view_allocate(&s->views[0], plan) && view_allocate(&s->views[1], plan);
    const bool all_sectors = sectors_allocate(&s->sectors, plan);
    for (int which = 0; which < 2; which++)
        s->lists[which] = calloc((size_t)plan->n_roots, sizeof **s->lists);
    const bool outline = polygon_list_room(&s->outline, plan->most_corners);
    s->plan = plan;
    if (!views || !all_sectors || !s->lists[0] || !s->lists[1] || !outline || !s->poses ||
        !s->ring || !s->sides || !s->kept || !s->heights_m || !s->points || !s->nodes ||
        !s->candidates || !s->passed_over) {
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
    sectors_free(&s->sectors, s->plan);
    free(s->lists[0]);
    free(s->lists[1]);
    polygon_list_free(&s->outline);
    polygon_list_free(&s->covers);
    polygon_work_free(&s->work);
    free(s->ring);
    free(s->sides);
    free(s->kept);
    free(s->heights_m);
    free(s->points);
    free(s->nodes);
    free(s->candidates);
    free(s->passed_over);
    free(s);
}
