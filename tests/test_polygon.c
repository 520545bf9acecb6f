/* The area that polygons leave uncovered, against closed forms and against another way to find it:
 * sums over vertical slabs. */
#include "testing.h"

#include "base/constants.h"
#include "base/random.h"
#include "facets/polygon.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_COVERS = 40, MOST_CORNERS = 9, MOST_STOPS = 20000 };

static const double NEAR = 1e-14;

typedef struct ring {
    int n;
    point2 points[MOST_CORNERS + 1];
} ring;

/* --- the area by slabs: between neighbouring abscissae of corners and crossings, everything is
 * linear in x, so that the middle of a slab stands for all of it --- */

static int add_crossing(point2 p, point2 q, point2 a, point2 b, double *stops, int n)
{
    const double d = (q.x - p.x) * (b.y - a.y) - (q.y - p.y) * (b.x - a.x);
    const double t = ((a.x - p.x) * (b.y - a.y) - (a.y - p.y) * (b.x - a.x)) / d;
    const double u = ((a.x - p.x) * (q.y - p.y) - (a.y - p.y) * (q.x - p.x)) / d;
    if (!(t >= 0 && t <= 1 && u >= 0 && u <= 1)) return n;
    stops[n] = p.x + t * (q.x - p.x);
    return n + 1;
}

static int find_stops(const ring *rings, int n_rings, double *stops)
{
    int n = 0;
    for (int i = 0; i < n_rings; i++)
        for (int k = 0; k < rings[i].n; k++) {
            const point2 p = rings[i].points[k], q = rings[i].points[(k + 1) % rings[i].n];
            stops[n++] = p.x;
            for (int j = 0; j < i; j++)
                for (int l = 0; l < rings[j].n; l++)
                    n = add_crossing(p, q, rings[j].points[l],
                                     rings[j].points[(l + 1) % rings[j].n], stops, n);
        }
    return n;
}

static int compare_numbers(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* From where to where a ring reaches on an upright line; lo > hi where it does not. */
static void cut_line(const ring *r, double x, double *lo, double *hi)
{
    *lo = INFINITY, *hi = -INFINITY;
    for (int k = 0; k < r->n; k++) {
        const point2 p = r->points[k], q = r->points[(k + 1) % r->n];
        if ((p.x <= x) == (q.x <= x)) continue;
        const double y = p.y + (x - p.x) / (q.x - p.x) * (q.y - p.y);
        *lo = fmin(*lo, y), *hi = fmax(*hi, y);
    }
}

/* Length of the first ring's part of an upright line that the others leave. */
static double left_of_line(const ring *rings, int n_rings, double x)
{
    double intervals[MOST_COVERS][2], lo, hi, at, left = 0.0;
    int n = 0;
    cut_line(&rings[0], x, &lo, &hi);
    if (!(lo < hi)) return 0.0;
    for (int k = 1; k < n_rings; k++) {
        cut_line(&rings[k], x, &intervals[n][0], &intervals[n][1]);
        n += intervals[n][0] < intervals[n][1];
    }
    qsort(intervals, (size_t)n, sizeof *intervals, compare_numbers);
    at = lo;
    for (int k = 0; k < n; k++) {
        left += fmax(fmin(intervals[k][0], hi) - at, 0.0);
        at = fmax(at, intervals[k][1]);
    }
    return left + fmax(hi - at, 0.0);
}

static double area_by_slabs(const ring *rings, int n_rings)
{
    static double stops[MOST_STOPS];
    const int n = find_stops(rings, n_rings, stops);
    double sum = 0.0;
    qsort(stops, (size_t)n, sizeof *stops, compare_numbers);
    for (int k = 0; k + 1 < n; k++)
        sum += (stops[k + 1] - stops[k]) *
               left_of_line(rings, n_rings, 0.5 * (stops[k] + stops[k + 1]));
    return sum;
}

/* --- ours --- */

static double area_left(const ring *rings, int n_rings)
{
    polygon_list subject = {0}, covers = {0};
    polygon_work work = {0};
    double area = -1.0;
    for (int k = 0; k < n_rings; k++) {
        polygon_list *list = k == 0 ? &subject : &covers;
        point2 *room = polygon_list_room(list, rings[k].n);
        ck_assert_ptr_nonnull(room);
        memcpy(room, rings[k].points, (size_t)rings[k].n * sizeof *room);
        polygon_list_take(list, rings[k].n, NEAR);
    }
    if (subject.n == 1) /* as callers do: only those that cross it */
        for (int k = covers.n - 1; k >= 0; k--)
            if (polygon_relate(&subject, 0, &covers, k) == POLYGON_COVERED) area = 0.0;
    if (area < 0.0)
        ck_assert_int_eq(polygon_uncovered_area(&subject, 0, &covers, NEAR, &work, &area, NULL),
                         GLINT_OK);
    polygon_list_free(&subject);
    polygon_list_free(&covers);
    polygon_work_free(&work);
    return area;
}

static ring rectangle(double lo_x, double lo_y, double hi_x, double hi_y)
{
    return (ring){4, {{lo_x, lo_y}, {hi_x, lo_y}, {hi_x, hi_y}, {lo_x, hi_y}}};
}

START_TEST(test_polygon_uncovered_area_closed_forms)
{
    const ring square = rectangle(0, 0, 2, 2);
    const ring diamond = {4, {{1, -0.5}, {2.5, 1}, {1, 2.5}, {-0.5, 1}}};
    const ring corner = {3, {{0, 0}, {2, 0}, {0, 2}}};
    const ring alone[] = {square};
    const ring tips[] = {square, diamond}; /* four triangles with sides of 0.5 are left */
    const ring half[] = {square, corner};
    const ring twice[] = {square, corner, corner};
    const ring strips[] = {square, rectangle(-1, -1, 0.5, 3), rectangle(0.5, -1, 1, 3),
                           rectangle(1.5, -1, 1.75, 3), rectangle(-1, 0.5, 3, 1)};
    const ring quarters[] = {square, rectangle(-1, -1, 1, 1), rectangle(1, -1, 3, 1),
                             rectangle(-1, 1, 1, 3), rectangle(1, 1, 3, 3)};
    assert_near(area_left(alone, 1), 4.0, 1e-15);
    assert_near(area_left(tips, 2), 0.5, 1e-15);
    assert_near(area_left(half, 2), 2.0, 1e-15);
    assert_near(area_left(twice, 3), 2.0, 1e-15);
    assert_near(area_left(strips, 5), 0.75 * 1.5, 1e-15);
    assert_near(area_left(quarters, 5), 0.0, 1e-15);
}
END_TEST

/* What turns on differences of abscissae: those that are all but none, and all but the largest. */
START_TEST(test_polygon_uncovered_area_is_a_number_where_edges_are_all_but_upright)
{
    const ring square = rectangle(-1, -1, 1, 1);
    for (int power = -300; power <= 0; power += 5) {
        const double lean = pow(10, power);
        const ring right = {4, {{0, -2}, {3, -2}, {3, 2}, {-lean, 2}}};
        const ring two[] = {square, right};
        const ring three[] = {square, right, rectangle(-2, -2, -0.5, 2)};
        /* the edge goes from 3 lean/4 to lean/4 left of the middle */
        assert_near(area_left(two, 2), 2.0 - lean, 1e-14);
        if (lean < 0.5) assert_near(area_left(three, 3), 1.0 - lean, 1e-14);
    }
}
END_TEST

/* A convex ring: the hull of random points; on a grid, so that many edges lie on one line. */
static ring random_ring(uint64_t *state, double reach, double size, double grid)
{
    ring out = {0};
    const double x = reach * random_even(state), y = reach * random_even(state);
    while (out.n < 3) {
        point2 points[MOST_CORNERS], hull[MOST_CORNERS + 1];
        const int n = 3 + (int)(6.999 * random_even(state));
        for (int k = 0; k < n; k++) {
            points[k].x = x + size * (random_even(state) - 0.5);
            points[k].y = y + size * (random_even(state) - 0.5);
            if (grid > 0.0) points[k].x = grid * round(points[k].x / grid);
            if (grid > 0.0) points[k].y = grid * round(points[k].y / grid);
        }
        out.n = polygon_hull(points, n, hull);
        memcpy(out.points, hull, (size_t)out.n * sizeof *hull);
    }
    return out;
}

/* Scenes of up to `most` covers against the slabs; the worst difference. */
static double worst_of_scenes(int n_scenes, int most, double size, double grid)
{
    static ring rings[MOST_COVERS + 1];
    uint64_t state = 11;
    double worst = 0.0, partly = 0.0;
    for (int scene = 0; scene < n_scenes; scene++) {
        const int n = 1 + (int)(most * random_even(&state) + 0.999);
        rings[0] = random_ring(&state, 0.2, 3.0, grid);
        for (int k = 1; k < n; k++)
            rings[k] = random_ring(&state, 1.5, size, grid);
        const double want = area_by_slabs(rings, n);
        worst = fmax(worst, fabs(area_left(rings, n) - want));
        partly += want > 0.01 && want < 0.99 * polygon_area(rings[0].points, rings[0].n);
    }
    ck_assert_msg(partly > 0.25 * n_scenes, "%g of %d are partly covered", partly, n_scenes);
    return worst;
}

START_TEST(test_polygon_uncovered_area_agrees_with_slabs)
{
    assert_near(worst_of_scenes(4000, 4, 1.5, 0), 0.0, 1e-13);
    assert_near(worst_of_scenes(1000, 8, 1.2, 0), 0.0, 1e-13);
    assert_near(worst_of_scenes(300, MOST_COVERS, 0.8, 0), 0.0, 3e-13);
    assert_near(worst_of_scenes(300, MOST_COVERS, 0.4, 0), 0.0, 3e-13);
}
END_TEST

START_TEST(test_polygon_uncovered_area_agrees_with_slabs_where_edges_coincide)
{
    assert_near(worst_of_scenes(4000, 4, 1.5, 0.25), 0.0, 1e-13);
    assert_near(worst_of_scenes(1000, 8, 1.2, 0.25), 0.0, 1e-13);
    assert_near(worst_of_scenes(300, MOST_COVERS, 0.8, 0.25), 0.0, 3e-13);
    assert_near(worst_of_scenes(300, MOST_COVERS, 0.4, 0.125), 0.0, 3e-13);
}
END_TEST

/* Two lattices of tiles that touch, of 5 m x 4 m and of 4 m x 5 m, in any position: they share
 * 2 m x 2 m, so that 20 + 20 - 4 m2 of 100 are covered. Strips from edge to edge between y = 2 m and
 * 4 m, which touch too, take what the lattices leave there: 10 - 5 m2 of the lower half and 10 - 7
 * of the upper one. */
START_TEST(test_polygon_uncovered_area_of_tiles_that_touch)
{
    enum { TILES = 20, STRIPS = 9 };
    static ring rings[1 + 2 * TILES + STRIPS];
    for (int turn_deg = 0; turn_deg < 360; turn_deg += 7) {
        const double c = cos(turn_deg * DEG), d = sin(turn_deg * DEG);
        int n = 0;
        rings[n++] = rectangle(0, 0, 10, 10);
        for (int k = 0; k < TILES; k++) {
            const double x = 1 + k % 5, y = 1 + k / 5, u = 4 + k % 4, v = 3 + k / 4;
            rings[n++] = rectangle(x, y, x + 1, y + 1);
            rings[n++] = rectangle(u, v, u + 1, v + 1);
        }
        for (int k = 0; k < STRIPS; k++)
            rings[n++] = rectangle(-1, 2 + 2.0 * k / STRIPS, 11, 2 + 2.0 * (k + 1) / STRIPS);
        for (int k = 0; k < n; k++)
            for (int j = 0; j < rings[k].n; j++) {
                const point2 p = rings[k].points[j];
                rings[k].points[j] = (point2){c * p.x - d * p.y, d * p.x + c * p.y};
            }
        assert_near(area_left(rings, 1 + 2 * TILES), 100.0 - 36.0, 1e-12);
        assert_near(area_left(rings, n), 100.0 - 36.0 - 5.0 - 3.0, 1e-12);
    }
}
END_TEST

START_TEST(test_polygon_uncovered_area_does_not_depend_on_order_or_axes)
{
    ring rings[7], other[7];
    uint64_t state = 5;
    for (int scene = 0; scene < 500; scene++) {
        rings[0] = random_ring(&state, 0.2, 3.0, 0);
        for (int k = 1; k < 7; k++)
            rings[k] = random_ring(&state, 1.5, 1.5, 0);
        const double area = area_left(rings, 7), turn = TWO_PI * random_even(&state);
        other[0] = rings[0];
        for (int k = 1; k < 7; k++)
            other[k] = rings[7 - k];
        assert_near(area_left(other, 7), area, 1e-13);
        for (int k = 0; k < 7; k++)
            for (int j = 0; j < rings[k].n; j++) {
                const point2 p = rings[k].points[j];
                other[k].n = rings[k].n;
                other[k].points[j] =
                    (point2){cos(turn) * p.x - sin(turn) * p.y, sin(turn) * p.x + cos(turn) * p.y};
            }
        assert_near(area_left(other, 7), area, 1e-13);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("polygon");
    TCase *tc = tcase_create("core");
    tcase_set_timeout(tc, 60);
    tcase_add_test(tc, test_polygon_uncovered_area_closed_forms);
    tcase_add_test(tc, test_polygon_uncovered_area_is_a_number_where_edges_are_all_but_upright);
    tcase_add_test(tc, test_polygon_uncovered_area_agrees_with_slabs);
    tcase_add_test(tc, test_polygon_uncovered_area_agrees_with_slabs_where_edges_coincide);
    tcase_add_test(tc, test_polygon_uncovered_area_of_tiles_that_touch);
    tcase_add_test(tc, test_polygon_uncovered_area_does_not_depend_on_order_or_axes);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
