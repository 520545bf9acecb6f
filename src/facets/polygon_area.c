/* The area of a polygon that others leave uncovered. */
#include "base/grow.h"
#include "facets/polygon.h"

#include <math.h>
#include <string.h>

/* --- cutting --- */

/* A line and what is within `slack` of it, in the same units. */
typedef struct cut_line {
    double a, b, c, slack;
} cut_line;

static inline cut_line line_of(const polygon_list *list, const polygon_item *item, int edge)
{
    const polygon_lines *l = &list->lines[item->first_lines + edge / 4];
    const int j = edge % 4;
    return (cut_line){l->a[j], l->b[j], l->c[j], l->slack[j]};
}

static inline double side_of(const cut_line *l, point2 p)
{
    return l->a * p.x + l->b * p.y + l->c;
}

/* Where the edge from p to q goes through a line. */
static inline point2 meeting(point2 p, point2 q, double side_p, double side_q)
{
    const double t = side_p / (side_p - side_q);
    return (point2){p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
}

/* The part of a polygon inside a line; points within the slack belong to it. A convex polygon
 * crosses a line twice at most, so that this has n + 1 points at most; the guard keeps to n + 2
 * whatever the polygon, and what is written behind the end needs room for one more. Without
 * branches: which way they would go is anybody's guess. */
static int clip(const point2 *points, int n, const cut_line *l, point2 *inside)
{
    int in = 0, crossings = 0;
    point2 p = points[n - 1];
    double side_p = side_of(l, p);
    for (int k = 0; k < n; k++) {
        const point2 q = points[k];
        const double side_q = side_of(l, q);
        const bool crosses = (((side_p > l->slack) & (side_q < -l->slack)) |
                              ((side_p < -l->slack) & (side_q > l->slack))) &
                             (crossings < 2);
        inside[in] = meeting(p, q, side_p, side_q); /* nonsense where it does not cross: not kept */
        in += crosses;
        crossings += crosses;
        inside[in] = q;
        in += side_q >= -l->slack;
        p = q;
        side_p = side_q;
    }
    return in;
}

/* The parts on the two sides of a line. */
static void cut(const point2 *points, int n, const cut_line *l, point2 *inside, int *n_inside,
                point2 *outside, int *n_outside)
{
    const cut_line other_side = {-l->a, -l->b, -l->c, l->slack};
    *n_inside = clip(points, n, l, inside);
    *n_outside = clip(points, n, &other_side, outside);
}

/* How points lie to a line: POLYGON_APART when none is inside, POLYGON_COVERED when none is
 * outside. */
static polygon_relation relate_to_line(const point2 *points, int n, const cut_line *l)
{
    bool inside = false, outside = false;
    for (int k = 0; k < n; k++) {
        const double side = side_of(l, points[k]);
        inside |= side > l->slack;
        outside |= side < -l->slack;
    }
    return !outside ? POLYGON_COVERED : inside ? POLYGON_CROSSED : POLYGON_APART;
}

/* --- the uncovered area --- */

/* Up to so many covers: the areas that they share with the polygon, less what these share. The
 * number of areas doubles with each cover, where all have a part in common. */
enum { FEW_COVERS = 4 };
/* From so many covers on, halving is tried. */
enum { MANY_COVERS = 16 };
/* Halving is not worth it where the two halves together meet more than this many times the covers
 * of the whole. Below 1.42 (the root of 2 for each half) the work stays at worst quadratic. */
static const double WORTH_HALVING = 1.4;

/* A part that is thinner than so many times `near` is not halved. */
static const double THIN = 16.0;

/* What is to be done with a part: the tasks lie on each other as the parts in work.parts do. */
typedef struct polygon_task {
    int first, n; /* in work.lists: covers that the part may meet */
    bool sifted;  /* it does meet them */
} polygon_task;

/* What the subtraction reads, and where it works. */
typedef struct subtraction {
    const polygon_list *covers;
    double near;
    polygon_work *work;
    double area; /* of what was found to be uncovered so far */
    double sign; /* that parts count with */
} subtraction;

void polygon_work_free(polygon_work *work)
{
    if (!work) return;
    polygon_list_free(&work->parts);
    free(work->spare);
    free(work->tasks);
    free(work->lists);
    free(work->edges);
    free(work->ends);
    *work = (polygon_work){0};
}

/* --- few covers --- */

/* Which of four lines have points of a ring on their outer side; *apart is set where one has no
 * points on its inner side. */
CLONES static void find_cutting(const point2 *points, int n, const polygon_lines *lines,
                                bool cuts[4], bool *apart)
{
    const double4 a = lines->a, b = lines->b, c = lines->c, slack = lines->slack;
    mask4 inside = {0}, outside = {0};
    for (int k = 0; k < n; k++) {
        const double4 side = a * points[k].x + b * points[k].y + c;
        inside |= side > slack;
        outside |= side < -slack;
    }
    for (int j = 0; j < 4; j++)
        cuts[j] = outside[j] != 0;
    *apart = !(inside[0] & inside[1] & inside[2] & inside[3]);
}

/* What a ring and a cover have in common: *out gets it, in one of the two rooms; returns its number
 * of points. */
static int intersect(const polygon_list *covers, const polygon_item *cover, const point2 *ring,
                     int n, point2 *room, point2 *other_room, const point2 **out)
{
    for (int first = 0; first < cover->n; first += 4) {
        bool cuts[4], apart;
        find_cutting(ring, n, &covers->lines[cover->first_lines + first / 4], cuts, &apart);
        if (apart) return 0;
        for (int edge = first; edge < first + 4 && edge < cover->n; edge++) {
            if (!cuts[edge - first]) continue;
            const cut_line line = line_of(covers, cover, edge);
            point2 *const next = ring == room ? other_room : room;
            n = clip(ring, n, &line, next);
            if (n < 3) return 0;
            ring = next;
        }
    }
    *out = ring;
    return n;
}

/* Four edges y = left_y + slope (x - left_x), from left_x to right_x; sign: 1 of an upper edge, -1
 * of a lower one. Upright edges count for nothing: there left_x = right_x. */
typedef struct four_edges {
    double4 left_x, left_y, right_x, slope, sign;
} four_edges;

/* Differences of abscissae up to this are none: squares of heights on the lines through edges, far
 * from them too, stay finite. */
#define UPRIGHT 1e-100

/* The edges of a ring by fours, the last point again where there is none left. */
CLONES static void find_edges(const point2 *ring, int n, four_edges *out)
{
    const double4 zero = {0}, one = all4(1.0);
    point2 p = ring[n - 1];
    for (int first = 0; first < n; first += 4) {
        point2 q[4];
        for (int j = 0; j < 4; j++)
            q[j] = ring[first + j < n ? first + j : n - 1];
        const double4 x = {p.x, q[0].x, q[1].x, q[2].x}, y = {p.y, q[0].y, q[1].y, q[2].y};
        const double4 to_x = {q[0].x, q[1].x, q[2].x, q[3].x};
        const double4 to_y = {q[0].y, q[1].y, q[2].y, q[3].y};
        const double4 dx = to_x - x;
        const mask4 upper = dx<-UPRIGHT, lower = dx> UPRIGHT;
        four_edges *e = &out[first / 4];
        e->left_x = pick4(upper, to_x, x);
        e->left_y = pick4(upper, to_y, y);
        e->right_x = pick4(lower, to_x, x);
        e->slope = (to_y - y) / pick4(upper | lower, dx, one);
        e->sign = pick4(upper, one, pick4(lower, -one, zero));
        p = q[3];
    }
}

/* The area that two polygons share: sums over pairs of edges, signed, of what is below both. It
 * turns on no decision: edges that coincide, or nearly, do it no harm. */
CLONES static double shared_area(const four_edges *a, int n_a, const four_edges *b, int n_b)
{
    const double4 zero = {0}, tiny = all4(1e-300);
    double4 sum = {0};
    for (int first = 0; first < n_a; first += 4)
        for (int j = 0; j < 4 && first + j < n_a; j++) {
            const four_edges *own = &a[first / 4];
            const double left_x = own->left_x[j], left_y = own->left_y[j], slope = own->slope[j];
            const double4 a_left = all4(left_x), a_right = all4(own->right_x[j]);
            const double sign = own->sign[j];
            for (int i = 0; 4 * i < n_b; i++) {
                const double4 from = most4(a_left, b[i].left_x);
                const double4 to = least4(a_right, b[i].right_x);
                const double4 width = most4(to - from, zero);
                const double4 b_from = b[i].left_y + b[i].slope * (from - b[i].left_x);
                const double4 b_to = b[i].left_y + b[i].slope * (to - b[i].left_x);
                const double4 d_from = left_y + slope * (from - left_x) - b_from;
                const double4 d_to = left_y + slope * (to - left_x) - b_to;
                const double4 below = least4(d_from, zero) + least4(d_to, zero);
                const double4 all = size4(d_from) + size4(d_to);
                /* of the triangle or trapezoid by which the edge of a is below that of b */
                const double4 less = below * -below / most4(all, tiny);
                sum += sign * b[i].sign * width * (b_from + b_to + less);
            }
        }
    return 0.5 * ((sum[0] + sum[1]) + (sum[2] + sum[3]));
}

/* What is needed for the areas that few covers leave. */
typedef struct few_covers {
    const polygon_list *covers;
    const int *list;
    const four_edges *edges[FEW_COVERS]; /* of the covers */
    int most; /* the greatest number of points that a ring can come to have */
} few_covers;

static inline box2 common_box(const box2 *a, const box2 *b)
{
    return (box2){a->lo_x > b->lo_x ? a->lo_x : b->lo_x, a->lo_y > b->lo_y ? a->lo_y : b->lo_y,
                  a->hi_x < b->hi_x ? a->hi_x : b->hi_x, a->hi_y < b->hi_y ? a->hi_y : b->hi_y};
}

/* The area of a ring that none of the first n covers covers: of what each shares with it, that
 * counts which those before it leave. room: for 2 `most` points and as many again for each cover;
 * edges: for the edges of rings of `most` points, one for each cover and one more. */
static double uncovered_by_few(const few_covers *f, int n_covers, const point2 *ring, int n,
                               const box2 *box, point2 *room, four_edges *edges)
{
    double left = polygon_area(ring, n);
    find_edges(ring, n, edges);
    for (int k = 0; k < n_covers; k++) {
        const polygon_item *cover = &f->covers->items[f->list[k]];
        if (!boxes_overlap(box, &cover->box)) continue;
        const box2 both = common_box(box, &cover->box);
        bool alone = true;
        for (int j = 0; j < k; j++)
            alone &= !boxes_overlap(&both, &f->covers->items[f->list[j]].box);
        if (alone) {
            left -= shared_area(edges, n, f->edges[k], cover->n);
            continue;
        }
        const point2 *shared;
        const int n_shared = intersect(f->covers, cover, ring, n, room, room + f->most, &shared);
        if (n_shared < 3) continue;
        const box2 within = polygon_box(shared, n_shared);
        left -= uncovered_by_few(f, k, shared, n_shared, &within, room + 2L * f->most,
                                 edges + (f->most + 3) / 4);
    }
    return left;
}

/* Counts what few covers leave of a polygon of a list. */
static bool subtract_few(subtraction *s, const polygon_list *from, const polygon_item *own,
                         const int *list, int n_list)
{
    polygon_work *w = s->work;
    few_covers f = {.covers = s->covers, .list = list, .most = own->n + 3};
    int n_fours = 0;
    for (int k = 0; k < n_list; k++) {
        const int n = s->covers->items[list[k]].n;
        f.most += n;
        n_fours += (n + 3) / 4;
    }
    n_fours += (n_list + 1) * ((f.most + 3) / 4);
    if (!grow_room(&w->spare, &w->spare_capacity, 2L * f.most * (n_list + 1), sizeof *w->spare) ||
        !grow_room(&w->edges, &w->edge_capacity, n_fours, sizeof *w->edges))
        return false;
    four_edges *edges = w->edges;
    for (int k = 0; k < n_list; k++) {
        const polygon_item *cover = &s->covers->items[list[k]];
        f.edges[k] = edges;
        find_edges(s->covers->points + cover->first, cover->n, edges);
        edges += (cover->n + 3) / 4;
    }
    s->area += s->sign * uncovered_by_few(&f, n_list, from->points + own->first, own->n, &own->box,
                                          w->spare, edges);
    return true;
}

/* --- many covers --- */

/* Puts a ring on the stack, with a list of covers. */
static bool push_part(const subtraction *s, const point2 *ring, int n, polygon_task task)
{
    polygon_work *w = s->work;
    point2 *room = polygon_list_room(&w->parts, n);
    if (!room || !grow_room(&w->tasks, &w->task_capacity, w->n_tasks + 1L, sizeof *w->tasks))
        return false;
    memcpy(room, ring, (size_t)n * sizeof *ring);
    if (polygon_list_take(&w->parts, n, s->near)) w->tasks[w->n_tasks++] = task;
    return true;
}

/* Moves the top part to the spare room, which gets room for three rings of `most` points. */
static bool take_off(const subtraction *s, int most)
{
    polygon_work *w = s->work;
    const polygon_item *top = &w->parts.items[w->parts.n - 1];
    if (!grow_room(&w->spare, &w->spare_capacity, 3L * most, sizeof *w->spare)) return false;
    memcpy(w->spare, w->parts.points + top->first, (size_t)top->n * sizeof *w->spare);
    polygon_list_drop(&w->parts);
    return true;
}

/* Divides the top part along the edges of a cover: what is outside goes back on the stack, what is
 * left inside is covered. */
static bool divide_by_cover(const subtraction *s, int cover, polygon_task rest)
{
    polygon_work *w = s->work;
    const polygon_item *c = &s->covers->items[cover];
    int n = w->parts.items[w->parts.n - 1].n;
    const int most = n + c->n + 3;
    if (!take_off(s, most)) return false;
    point2 *inside = w->spare, *next = w->spare + most, *const outside = w->spare + 2L * most;
    for (int edge = 0; edge < c->n && n > 0; edge++) {
        const cut_line line = line_of(s->covers, c, edge);
        if (relate_to_line(inside, n, &line) == POLYGON_COVERED) continue;
        int n_outside;
        cut(inside, n, &line, next, &n, outside, &n_outside);
        point2 *const swap = inside;
        inside = next, next = swap;
        if (n_outside >= 3 && !push_part(s, outside, n_outside, rest)) return false;
    }
    return true;
}

/* A line that halves a box, and how many covers reach into the two halves together; INT_MAX where
 * the halves would be too thin for the line to tell them apart. */
typedef struct halving {
    cut_line line;
    int n_covers;
} halving;

static halving halve(const subtraction *s, const box2 *box, bool by_x, const int *list, int n)
{
    const double x = 0.5 * (box->lo_x + box->hi_x), y = 0.5 * (box->lo_y + box->hi_y);
    halving h = {by_x ? (cut_line){1, 0, -x, s->near} : (cut_line){0, 1, -y, s->near}, 0};
    box2 high = *box, low = *box;
    if (by_x)
        high.lo_x = low.hi_x = x;
    else
        high.lo_y = low.hi_y = y;
    if ((by_x ? box->hi_x - box->lo_x : box->hi_y - box->lo_y) < THIN * s->near)
        h.n_covers = INT_MAX;
    for (int k = 0; k < n && h.n_covers < INT_MAX; k++) {
        const box2 *cover = &s->covers->items[list[k]].box;
        h.n_covers += boxes_overlap(&high, cover) + boxes_overlap(&low, cover);
    }
    return h;
}

/* Divides the top part in halves, if that separates the covers; *done tells. */
static bool divide_in_halves(const subtraction *s, polygon_task task, bool *done)
{
    polygon_work *w = s->work;
    const polygon_item *top = &w->parts.items[w->parts.n - 1];
    const int *list = w->lists + task.first, n = top->n, most = n + 3;
    const halving by_x = halve(s, &top->box, true, list, task.n);
    const halving by_y = halve(s, &top->box, false, list, task.n);
    const halving *best = by_x.n_covers <= by_y.n_covers ? &by_x : &by_y;
    *done = best->n_covers <= WORTH_HALVING * task.n;
    if (!*done) return true;
    if (!take_off(s, most)) return false;
    point2 *const high = w->spare + most, *const low = w->spare + 2L * most;
    int n_high, n_low;
    cut(w->spare, n, &best->line, high, &n_high, low, &n_low);
    return (n_high < 3 || push_part(s, high, n_high, task)) &&
           (n_low < 3 || push_part(s, low, n_low, task));
}

/* Keeps those covers of a task that cross the top part, in a new list behind the others; false when
 * one covers all of it. The lists have room. */
static bool sift(const subtraction *s, polygon_task *task)
{
    polygon_work *w = s->work;
    const int first = w->n_lists;
    for (int k = task->first; k < task->first + task->n; k++) {
        const polygon_relation relation =
            polygon_relate(&w->parts, w->parts.n - 1, s->covers, w->lists[k]);
        if (relation == POLYGON_COVERED) return false;
        if (relation == POLYGON_CROSSED) w->lists[w->n_lists++] = w->lists[k];
    }
    *task = (polygon_task){first, w->n_lists - first, true};
    return true;
}

/* Does the top task. Parts that come of it share its list: when the first of them is up, all that
 * was put behind the list has been done with. */
static bool do_task(subtraction *s)
{
    polygon_work *w = s->work;
    polygon_task task = w->tasks[--w->n_tasks];
    w->n_lists = task.first + task.n;
    if (!grow_room(&w->lists, &w->list_capacity, (long)w->n_lists + task.n, sizeof *w->lists))
        return false;
    const bool covered = !task.sifted && !sift(s, &task);
    if (covered) polygon_list_drop(&w->parts);
    if (covered) return true;
    if (task.n <= FEW_COVERS) {
        const polygon_item *top = &w->parts.items[w->parts.n - 1];
        const bool ok = subtract_few(s, &w->parts, top, w->lists + task.first, task.n);
        polygon_list_drop(&w->parts);
        return ok;
    }
    bool done = false;
    task.sifted = false;
    if (task.n >= MANY_COVERS && !divide_in_halves(s, task, &done)) return false;
    if (done) return true;
    /* The last of the list makes way for the one that divides. */
    int *list = w->lists + task.first, *middle = &list[task.n / 2];
    const int cover = *middle;
    *middle = list[--task.n];
    return divide_by_cover(s, cover, task);
}

/* --- covers of which few meet --- */

/* Of so many covers it is found out which of them meet: of fewer or more, division is faster. */
enum { WORTH_RELATING = 20, MOST_RELATED = 600 };
/* So it is where more pairs meet than so many for each cover. */
enum { MANY_PAIRS = 3 };

/* Lists, behind the first n_list covers in work.lists, those that share area with each of them and
 * stand before it: of number k they end before work.lists[work.ends[k]]. *few: whether these are
 * few. */
static bool list_meeting(const subtraction *s, int n_list, bool *few)
{
    polygon_work *w = s->work;
    const polygon_item *items = s->covers->items;
    const int most = (1 + MANY_PAIRS) * n_list;
    int n = n_list;
    if (!grow_room(&w->ends, &w->end_capacity, n_list, sizeof *w->ends) ||
        !grow_room(&w->lists, &w->list_capacity, most + 1L, sizeof *w->lists))
        return false;
    for (int k = 0; k < n_list && n <= most; k++) {
        const box2 *box = &items[w->lists[k]].box;
        for (int j = 0; j < k && n <= most; j++) {
            const int other = w->lists[j];
            if (boxes_overlap(&items[other].box, box) &&
                polygon_relate(s->covers, w->lists[k], s->covers, other) != POLYGON_APART)
                w->lists[n++] = other;
        }
        w->ends[k] = n;
    }
    *few = n <= most;
    return true;
}

static bool do_tasks(subtraction *s)
{
    bool ok = true;
    while (ok && s->work->n_tasks > 0)
        ok = do_task(s);
    return ok;
}

/* The area that a cover shares with a polygon is taken off, but for what n others share of it:
 * those at the end of work.lists. */
static bool take_off_cover(subtraction *s, const polygon_list *from, const polygon_item *own,
                           int which, int n)
{
    polygon_work *w = s->work;
    const polygon_item *cover = &s->covers->items[which];
    const int most = own->n + cover->n + 3, n_fours = (own->n + 3) / 4;
    const point2 *shared, *points = from->points + own->first;
    if (!grow_room(&w->spare, &w->spare_capacity, 2L * most, sizeof *w->spare) ||
        !grow_room(&w->edges, &w->edge_capacity, n_fours + (cover->n + 3) / 4, sizeof *w->edges))
        return false;
    if (n == 0) {
        find_edges(points, own->n, w->edges);
        find_edges(s->covers->points + cover->first, cover->n, w->edges + n_fours);
        s->area -= shared_area(w->edges, own->n, w->edges + n_fours, cover->n);
        return true;
    }
    const int n_shared =
        intersect(s->covers, cover, points, own->n, w->spare, w->spare + most, &shared);
    if (n_shared < 3) return true;
    s->sign = -1.0;
    const bool ok =
        push_part(s, shared, n_shared, (polygon_task){w->n_lists - n, n, n <= FEW_COVERS}) &&
        do_tasks(s);
    s->sign = 1.0;
    return ok;
}

/* Counts what is left of a polygon by many covers of which few meet: of what each shares with it,
 * that counts which those before it leave. *done: false where they are not few. */
static bool subtract_one_by_one(subtraction *s, const polygon_list *from, const polygon_item *own,
                                int n, bool *done)
{
    polygon_work *w = s->work;
    if (!list_meeting(s, n, done)) return false;
    if (!*done) return true;
    s->area += polygon_area(from->points + own->first, own->n);
    for (int k = n - 1; k >= 0; k--) { /* tasks put their lists where those before are done with */
        const int first = k > 0 ? w->ends[k - 1] : n;
        w->n_lists = w->ends[k];
        if (!take_off_cover(s, from, own, w->lists[k], w->ends[k] - first)) return false;
    }
    return true;
}

glint_status polygon_uncovered_area(const polygon_list *list, int subject,
                                    const polygon_list *covers, double near, polygon_work *work,
                                    double *area, glint_error *error)
{
    subtraction s = {covers, near, work, 0.0, 1.0};
    const polygon_item *item = &list->items[subject];
    polygon_list_clear(&work->parts);
    work->n_tasks = 0;
    if (!grow_room(&work->lists, &work->list_capacity, covers->n, sizeof *work->lists))
        return error_no_memory(error);
    for (int k = 0; k < covers->n; k++)
        work->lists[k] = k;
    bool ok = true, done = covers->n <= FEW_COVERS;
    if (done)
        ok = subtract_few(&s, list, item, work->lists, covers->n);
    else if (covers->n >= WORTH_RELATING && covers->n <= MOST_RELATED)
        ok = subtract_one_by_one(&s, list, item, covers->n, &done);
    if (ok && !done)
        ok = push_part(&s, list->points + item->first, item->n,
                       (polygon_task){0, covers->n, true}) &&
             do_tasks(&s);
    *area = s.area;
    return ok ? GLINT_OK : error_no_memory(error);
}
