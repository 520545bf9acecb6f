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
