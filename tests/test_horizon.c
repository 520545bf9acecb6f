/* Horizon masks: linear between their points, all around. */
#include "base/constants.h"
#include "orbit/horizon.h"
#include "testing.h"

/* Angles in and out of degrees. */
static const double ROUNDING = 1e-12;

static horizon make(double least_deg, const double (*points_deg)[2], int n, int twice)
{
    horizon h;
    horizon_point *points = n ? calloc((size_t)n, sizeof *points) : NULL;
    for (int i = 0; i < n; i++)
        points[i] = (horizon_point){points_deg[i][0] * DEG, points_deg[i][1] * DEG, 0};
    ck_assert_int_eq(horizon_make(least_deg * DEG, points, n, &h), twice);
    return h;
}

static double limit_deg(const horizon *h, double azimuth_deg)
{
    return horizon_limit(h, azimuth_deg * DEG) / DEG;
}

START_TEST(test_horizon_without_a_mask_is_level)
{
    horizon h = make(7, NULL, 0, -1);
    for (double azimuth = 0; azimuth < 360; azimuth += 33)
        assert_near(limit_deg(&h, azimuth), 7, ROUNDING);
    assert_near(h.lowest / DEG, 7, ROUNDING);
    assert_near(h.highest / DEG, 7, ROUNDING);
    assert_near(horizon_room(&h, 1), TWO_PI, 0);
    horizon_free(&h);
}
END_TEST

START_TEST(test_horizon_is_linear_between_points_and_through_north)
{
    /* in no order; -90 is 270 */
    static const double POINTS[][2] = {{180, 0}, {-90, 10}, {90, 20}};
    static const double WANT[][2] = {{90, 20},  {135, 10},   {180, 0}, {225, 5},
                                     {270, 10}, {315, 12.5}, {0, 15},  {45, 17.5}};
    horizon h = make(-90, POINTS, 3, -1);
    for (size_t k = 0; k < sizeof WANT / sizeof *WANT; k++)
        assert_near(limit_deg(&h, WANT[k][0]), WANT[k][1], ROUNDING);
    assert_near(limit_deg(&h, 359.999999), 15 - 1e-6 * 5 / 90, 1e-9);
    assert_near(h.lowest / DEG, 0, ROUNDING);
    assert_near(h.highest / DEG, 20, ROUNDING);
    /* on a piece of 90 deg beside one of 180 deg, which goes through north */
    assert_near(horizon_room(&h, 130 * DEG) / DEG, 40, ROUNDING);
    assert_near(horizon_room(&h, 91 * DEG) / DEG, 22.5, ROUNDING);
    assert_near(horizon_room(&h, 359 * DEG) / DEG, 89, ROUNDING);
    assert_near(horizon_room(&h, 0) / DEG, 90, ROUNDING);
    assert_near(horizon_room(&h, 88 * DEG) / DEG, 22.5, ROUNDING);
    horizon_free(&h);
}
END_TEST

START_TEST(test_horizon_never_falls_below_the_least)
{
    static const double POINTS[][2] = {{0, 0}, {180, 20}};
    horizon h = make(10, POINTS, 2, -1);
    assert_near(limit_deg(&h, 45), 10, ROUNDING);
    assert_near(limit_deg(&h, 135), 15, ROUNDING);
    assert_near(h.lowest / DEG, 10, ROUNDING);
    assert_near(h.highest / DEG, 20, ROUNDING);
    horizon_free(&h);
}
END_TEST

START_TEST(test_horizon_of_one_point_is_level)
{
    static const double POINTS[][2] = {{123, 4}};
    horizon h = make(0, POINTS, 1, -1);
    for (double azimuth = 0; azimuth < 360; azimuth += 41)
        assert_near(limit_deg(&h, azimuth), 4, ROUNDING);
    horizon_free(&h);
}
END_TEST

START_TEST(test_horizon_takes_equal_points_once_and_names_contradictions)
{
    static const double CLOSED[][2] = {{0, 3}, {90, 9}, {360, 3}};
    static const double TORN[][2] = {{90, 9}, {360, 3}, {45, 1}, {0, 4}};
    horizon h = make(0, CLOSED, 3, -1);
    ck_assert_int_eq(h.n, 2);
    assert_near(limit_deg(&h, 45), 6, ROUNDING);
    assert_near(limit_deg(&h, 225), 6, ROUNDING);
    horizon_free(&h);
    h = make(0, TORN, 4, 3); /* the later one of the two */
    horizon_free(&h);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("horizon");
    TCase *tc = tcase_create("horizon");
    tcase_add_test(tc, test_horizon_without_a_mask_is_level);
    tcase_add_test(tc, test_horizon_is_linear_between_points_and_through_north);
    tcase_add_test(tc, test_horizon_never_falls_below_the_least);
    tcase_add_test(tc, test_horizon_of_one_point_is_level);
    tcase_add_test(tc, test_horizon_takes_equal_points_once_and_names_contradictions);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
