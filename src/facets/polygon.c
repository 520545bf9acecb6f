#include "facets/polygon.h"

#include "base/grow.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* --- one polygon --- */

static inline point2 minus(point2 a, point2 b)
{
    return (point2){a.x - b.x, a.y - b.y};
}

static inline double cross2(point2 a, point2 b)
{
    return a.x * b.y - a.y * b.x;
}

/* A length between |a| and 1.42 |a|, for tolerances: spares the root. */
static inline double rough_length(point2 a)
{
    return fabs(a.x) + fabs(a.y);
}

double polygon_area(const point2 *points, int n)
{
    double twice = 0.0;
    for (int k = 2; k < n; k++)
        twice += cross2(minus(points[k - 1], points[0]), minus(points[k], points[0]));
    return 0.5 * twice;
}

double polygon_perimeter(const point2 *points, int n)
{
    double sum = 0.0;
    point2 before = points[n - 1];
    for (int k = 0; k < n; k++) {
        const point2 way = minus(points[k], before);
        sum += sqrt(way.x * way.x + way.y * way.y);
        before = points[k];
    }
    return sum;
}

box2 polygon_box(const point2 *points, int n)
{
    box2 box = {points[0].x, points[0].y, points[0].x, points[0].y};
    for (int k = 1; k < n; k++) {
        box.lo_x = points[k].x < box.lo_x ? points[k].x : box.lo_x;
        box.lo_y = points[k].y < box.lo_y ? points[k].y : box.lo_y;
        box.hi_x = points[k].x > box.hi_x ? points[k].x : box.hi_x;
        box.hi_y = points[k].y > box.hi_y ? points[k].y : box.hi_y;
    }
    return box;
}

/* True when b stands out of the line from a to c by more than `near`, to the right of it. */
static inline bool is_corner(point2 a, point2 b, point2 c, double near)
{
    const point2 chord = minus(c, a);
    return cross2(minus(b, a), chord) > near * rough_length(chord);
}

/* One round of polygon_tidy. */
static int drop_flat_points(point2 *points, int n, double near)
{
    int kept = 0;
    point2 before = points[n - 1];
    for (int k = 0; k < n; k++) {
        const point2 own = points[k];
        if (!is_corner(before, own, k + 1 < n ? points[k + 1] : points[0], near)) continue;
        before = points[kept++] = own;
    }
    return kept;
}

int polygon_tidy(point2 *points, int n, double near)
{
    while (n >= 3) {
        const int kept = drop_flat_points(points, n, near);
        if (kept == n) return n;
        n = kept;
    }
    return 0;
}

static bool comes_before(point2 p, point2 q)
{
    return p.x != q.x ? p.x < q.x : p.y < q.y;
}

/* By x, then y: Shell's method with the gaps of Ciura (2001, FCT, 106), which for the some hundred
 * points that there are at most is several times as fast as qsort, whose comparisons are calls. */
static void sort_points(point2 *points, int n)
{
    static const int GAPS[] = {1750, 701, 301, 132, 57, 23, 10, 4, 1};
    for (size_t g = 0; g < sizeof GAPS / sizeof *GAPS; g++) {
        const int gap = GAPS[g];
        for (int k = gap; k < n; k++) {
            const point2 own = points[k];
            int at = k;
            for (; at >= gap && comes_before(own, points[at - gap]); at -= gap)
                points[at] = points[at - gap];
            points[at] = own;
        }
    }
}

/* Appends p to the hull's side that begins at hull[first], which keeps turning left. */
static int extend_hull(point2 *hull, int n, int first, point2 p)
{
    while (n - first >= 2 && cross2(minus(hull[n - 1], hull[n - 2]), minus(p, hull[n - 2])) <= 0.0)
        n--;
    hull[n] = p;
    return n + 1;
}

int polygon_hull(point2 *points, int n, point2 *hull)
{
    int n_hull = 0;
    sort_points(points, n);
    for (int k = 0; k < n; k++)
        n_hull = extend_hull(hull, n_hull, 0, points[k]);
    const int first = n_hull - 1;
    for (int k = n - 2; k >= 0; k--)
        n_hull = extend_hull(hull, n_hull, first, points[k]);
    return n_hull > 1 ? n_hull - 1 : n_hull;
}

/* --- lists --- */

void polygon_list_free(polygon_list *list)
{
    if (!list) return;
    free(list->points);
    free(list->lines);
    free(list->items);
    *list = (polygon_list){0};
}

void polygon_list_clear(polygon_list *list)
{
    list->n = list->n_points = list->n_lines = 0;
}

point2 *polygon_list_room(polygon_list *list, int n)
{
    const bool ok = grow_room(&list->points, &list->point_capacity, (long)list->n_points + n,
                              sizeof *list->points) &&
                    grow_room(&list->lines, &list->line_capacity, list->n_lines + n / 4 + 1L,
                              sizeof *list->lines) &&
                    grow_room(&list->items, &list->capacity, list->n + 1L, sizeof *list->items);
    return ok ? list->points + list->n_points : NULL;
}

/* Lines along the edges that end in the points from number `first` on, four at most. */
static void set_lines(const point2 *points, int n, int first, double near, polygon_lines *lines)
{
    double a[4] = {0}, b[4] = {0}, c[4] = {1, 1, 1, 1}, slack[4] = {0};
    point2 from = points[first > 0 ? first - 1 : n - 1];
    for (int j = 0; j < 4 && first + j < n; j++) {
        const point2 to = points[first + j], along = minus(to, from);
        a[j] = -along.y;
        b[j] = along.x;
        c[j] = along.y * from.x - along.x * from.y;
        slack[j] = near * rough_length(along);
        from = to;
    }
    *lines = (polygon_lines){{a[0], a[1], a[2], a[3]},
                             {b[0], b[1], b[2], b[3]},
                             {c[0], c[1], c[2], c[3]},
                             {slack[0], slack[1], slack[2], slack[3]}};
}

/* Lines along the edges of a ring, as set_lines has them, and its box. False where some corner
 * turns by no more than rounding: polygon_tidy is to see to it. */
CLONES static bool take_neat(const point2 *points, int n, double near, polygon_lines *lines,
                             box2 *box)
{
    double4 least = {points[0].x, points[0].y, -points[0].x, -points[0].y};
    mask4 flat = {0};
    for (int first = 0; first < n; first += 4) {
        point2 p[6]; /* from the one before the first to the one after the last */
        p[0] = points[first > 0 ? first - 1 : n - 1];
        for (int j = 0; j < 5; j++)
            p[j + 1] = points[first + j < n ? first + j : 0];
        for (int j = 1; j < 5; j++)
            least = least4(least, (double4){p[j].x, p[j].y, -p[j].x, -p[j].y});
        const double4 from_x = {p[0].x, p[1].x, p[2].x, p[3].x};
        const double4 from_y = {p[0].y, p[1].y, p[2].y, p[3].y};
        const double4 to_x = {p[1].x, p[2].x, p[3].x, p[4].x};
        const double4 to_y = {p[1].y, p[2].y, p[3].y, p[4].y};
        const double4 next_x = {p[2].x, p[3].x, p[4].x, p[5].x};
        const double4 next_y = {p[2].y, p[3].y, p[4].y, p[5].y};
        const double4 dx = to_x - from_x, dy = to_y - from_y;
        const double4 chord_x = next_x - from_x, chord_y = next_y - from_y;
        const double4 turn = dx * chord_y - dy * chord_x;
        const mask4 own = (mask4){0, 1, 2, 3} < n - first; /* lanes with an edge */
        polygon_lines *l = &lines[first / 4];
        flat |= own & (turn <= near * (size4(chord_x) + size4(chord_y)));
        l->a = pick4(own, -dy, all4(0.0));
        l->b = pick4(own, dx, all4(0.0));
        l->c = pick4(own, dy * from_x - dx * from_y, all4(1.0));
        l->slack = pick4(own, near * (size4(dx) + size4(dy)), all4(0.0));
    }
    *box = (box2){least[0], least[1], -least[2], -least[3]};
    return !(flat[0] | flat[1] | flat[2] | flat[3]);
}

bool polygon_list_take(polygon_list *list, int n, double near)
{
    point2 *points = list->points + list->n_points;
    polygon_lines *lines = list->lines + list->n_lines;
    polygon_item item = {.first = list->n_points, .n = n, .first_lines = list->n_lines};
    if (!(n >= 3 && take_neat(points, n, near, lines, &item.box))) {
        item.n = n = polygon_tidy(points, n, near);
        if (n == 0) return false;
        item.box = polygon_box(points, n);
        for (int first = 0; first < n; first += 4)
            set_lines(points, n, first, near, &lines[first / 4]);
    }
    list->items[list->n++] = item;
    list->n_points += n;
    list->n_lines += (n + 3) / 4;
    return true;
}

void polygon_list_drop(polygon_list *list)
{
    assert(list->n > 0);
    const polygon_item *last = &list->items[--list->n];
    list->n_points = last->first;
    list->n_lines = last->first_lines;
}

/* --- two polygons --- */

static inline bool boxes_overlap(const box2 *a, const box2 *b)
{
    return (a->lo_x < b->hi_x) & (b->lo_x < a->hi_x) & (a->lo_y < b->hi_y) & (b->lo_y < a->hi_y);
}

/* How points lie to the lines of a polygon: apart, when all are outside one line; covered, when
 * none is outside any. */
CLONES static polygon_relation relate_to_lines(const point2 *points, int n,
                                               const polygon_lines *lines, int n_lines)
{
    polygon_relation relation = POLYGON_COVERED;
    for (int l = 0; l < n_lines; l++) {
        const double4 a = lines[l].a, b = lines[l].b, c = lines[l].c, slack = lines[l].slack;
        mask4 inside = {0}, outside = {0};
        for (int k = 0; k < n; k++) {
            const double4 side = a * points[k].x + b * points[k].y + c;
            inside |= side > slack;
            outside |= side < -slack;
        }
        if (!(inside[0] & inside[1] & inside[2] & inside[3])) return POLYGON_APART;
        if (outside[0] | outside[1] | outside[2] | outside[3]) relation = POLYGON_CROSSED;
    }
    return relation;
}

bool polygon_has_aside(const polygon_list *list, int k, const point2 *points, int n)
{
    const polygon_item *p = &list->items[k];
    return relate_to_lines(points, n, list->lines + p->first_lines, (p->n + 3) / 4) ==
           POLYGON_APART;
}

polygon_relation polygon_relate_to_edges(const polygon_list *list, int k,
                                         const polygon_list *covers, int cover)
{
    const polygon_item *p = &list->items[k], *c = &covers->items[cover];
    if (!boxes_overlap(&p->box, &c->box)) return POLYGON_APART;
    return relate_to_lines(list->points + p->first, p->n, covers->lines + c->first_lines,
                           (c->n + 3) / 4);
}

polygon_relation polygon_relate(const polygon_list *list, int k, const polygon_list *covers,
                                int cover)
{
    const polygon_item *p = &list->items[k], *c = &covers->items[cover];
    const polygon_relation relation = polygon_relate_to_edges(list, k, covers, cover);
    if (relation != POLYGON_CROSSED) return relation;
    return relate_to_lines(covers->points + c->first, c->n, list->lines + p->first_lines,
                           (p->n + 3) / 4) == POLYGON_APART
               ? POLYGON_APART
               : POLYGON_CROSSED;
}

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
} subtraction;

void polygon_work_free(polygon_work *work)
{
    if (!work) return;
    polygon_list_free(&work->parts);
    free(work->spare);
    free(work->tasks);
    free(work->lists);
    free(work->edges);
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
    s->area +=
        uncovered_by_few(&f, n_list, from->points + own->first, own->n, &own->box, w->spare, edges);
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

glint_status polygon_uncovered_area(const polygon_list *list, int subject,
                                    const polygon_list *covers, double near, polygon_work *work,
                                    double *area, glint_error *error)
{
    subtraction s = {covers, near, work, 0.0};
    const polygon_item *item = &list->items[subject];
    polygon_list_clear(&work->parts);
    work->n_tasks = 0;
    if (!grow_room(&work->lists, &work->list_capacity, covers->n, sizeof *work->lists))
        return error_no_memory(error);
    for (int k = 0; k < covers->n; k++)
        work->lists[k] = k;
    const bool few = covers->n <= FEW_COVERS;
    bool ok = few ? subtract_few(&s, list, item, work->lists, covers->n)
                  : push_part(&s, list->points + item->first, item->n,
                              (polygon_task){0, covers->n, true});
    while (ok && work->n_tasks > 0)
        ok = do_task(&s);
    *area = s.area;
    return ok ? GLINT_OK : error_no_memory(error);
}
