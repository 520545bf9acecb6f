/* test_vec.c: vectors, matrices and quaternions against closed forms. */
#include "testing.h"

#include "base/constants.h"
#include "base/vec.h"

#include <float.h>

/* A few roundings of numbers of size 1. */
static const double ROUNDING = 4 * DBL_EPSILON;

#define assert_vec(got, x, y, z, tol)                                                              \
    do {                                                                                           \
        assert_near((got)[0], x, tol);                                                             \
        assert_near((got)[1], y, tol);                                                             \
        assert_near((got)[2], z, tol);                                                             \
    } while (0)

static const double X[3] = {1, 0, 0}, Y[3] = {0, 1, 0}, Z[3] = {0, 0, 1};

START_TEST(test_vec_cross_is_right_handed)
{
    double out[3];
    cross3(X, Y, out);
    assert_vec(out, 0, 0, 1, 0);
    cross3(Y, Z, out);
    assert_vec(out, 1, 0, 0, 0);
    cross3(Z, X, out);
    assert_vec(out, 0, 1, 0, 0);
    double a[3] = {1, 2, 3};
    const double b[3] = {4, 5, 6};
    cross3(a, b, a); /* the output may be an input */
    assert_vec(a, -3, 6, -3, 0);
}
END_TEST

START_TEST(test_vec_unit_keeps_direction_at_any_length)
{
    static const double lengths[] = {1, 1e-300, 1e300, 4.94e-324 * 1e10, 1e-160, 1e200};
    for (size_t k = 0; k < sizeof lengths / sizeof *lengths; k++) {
        const double a[3] = {3 * lengths[k], -4 * lengths[k], 12 * lengths[k]};
        double out[3];
        assert_rel(unit3(a, out), 13 * lengths[k], 1e-9); /* denormals hold 10 digits here */
        assert_vec(out, 3.0 / 13, -4.0 / 13, 12.0 / 13, 1e-9);
        assert_near(norm3(out), 1, ROUNDING);
    }
    const double zero[3] = {0, -0.0, 0};
    double out[3] = {7, 7, 7};
    assert_near(unit3(zero, out), 0, 0);
    assert_vec(out, 0, 0, 0, 0);
}
END_TEST

START_TEST(test_vec_angle_is_exact_near_zero_and_pi)
{
    static const double angles[] = {1e-12, 1e-8, 1e-3, 1, PI / 2, 3, PI - 1e-3, PI - 1e-8};
    for (size_t k = 0; k < sizeof angles / sizeof *angles; k++) {
        const double a[3] = {5, 0, 0};
        const double b[3] = {0.1 * cos(angles[k]), 0, 0.1 * sin(angles[k])};
        assert_near(angle3(a, b), angles[k], 2 * ROUNDING * fmax(angles[k], 1e-3)); /* rad */
    }
    assert_near(angle3(X, X), 0, 0);
}
END_TEST

START_TEST(test_vec_perp_is_normal_even_where_little_is_left)
{
    const double n[3] = {1 / sqrt(3), 1 / sqrt(3), 1 / sqrt(3)};
    const double a[3] = {1, 1, 1 + 1e-9};
    double out[3];
    const double length = perp3(a, n, out);
    /* a - (a.n) n = 1e-9 (-1, -1, 2)/3, of length 1e-9 sqrt(2/3); 1 + 1e-9 is rounded. */
    assert_rel(length, 1e-9 * sqrt(2.0 / 3), 1e-6);
    assert_near(dot3(out, n), 0, ROUNDING);
    assert_vec(out, -1 / sqrt(6), -1 / sqrt(6), 2 / sqrt(6), 1e-6);
}
END_TEST

START_TEST(test_vec_turn_follows_the_right_hand)
{
    double r[9], out[3];
    mat_turn(Z, PI / 2, r);
    mat_vec(r, X, out);
    assert_vec(out, 0, 1, 0, ROUNDING);
    mat_tvec(r, Y, out);
    assert_vec(out, 1, 0, 0, ROUNDING);
    mat_turn(X, PI / 6, r);
    mat_vec(r, Y, out);
    assert_vec(out, 0, sqrt(3) / 2, 0.5, ROUNDING);
    /* A third of a turn about the diagonal carries x to y to z. */
    const double d[3] = {1 / sqrt(3), 1 / sqrt(3), 1 / sqrt(3)};
    mat_turn(d, TWO_PI / 3, r);
    mat_vec(r, X, out);
    assert_vec(out, 0, 1, 0, ROUNDING);
    mat_vec(r, Y, out);
    assert_vec(out, 0, 0, 1, ROUNDING);
}
END_TEST

START_TEST(test_mat_products_and_transposes_agree)
{
    const double a[9] = {1, 2, 3, 4, 5, 6, 7, 8, 10}, b[9] = {2, 0, 1, -1, 3, 5, 4, 1, -2};
    static const double product[9] = {12, 9, 5, 27, 21, 17, 46, 34, 27}; /* by hand */
    double c[9], at[9], out[3];
    mat_mul(a, b, c);
    for (int k = 0; k < 9; k++)
        assert_near(c[k], product[k], 0);
    memcpy(c, a, sizeof c);
    mat_mul(c, b, c); /* the output may be an input */
    for (int k = 0; k < 9; k++)
        assert_near(c[k], product[k], 0);
    mat_transpose(a, at);
    mat_vec(at, Y, out);
    assert_vec(out, 4, 5, 6, 0);
    mat_tvec(a, Y, out);
    assert_vec(out, 4, 5, 6, 0);
    mat_vec(a, Y, out);
    assert_vec(out, 2, 5, 8, 0);
    mat_identity(c);
    mat_vec(c, a, out);
    assert_vec(out, 1, 2, 3, 0);
    mat_rows(X, Z, Y, c);
    mat_vec(c, a, out);
    assert_vec(out, 1, 3, 2, 0);
}
END_TEST

/* The quaternion of a turn by `angle` about the unit `axis`. */
static void turn_quat(const double axis[3], double angle, double q[4])
{
    q[0] = cos(angle / 2);
    scale3(axis, sin(angle / 2), q + 1);
}

START_TEST(test_quat_means_the_same_turn_as_the_matrix)
{
    for (int k = 0; k < 500; k++) {
        const double raw[3] = {cos(1.7 * k), sin(2.3 * k), cos(0.9 * k + 1)};
        const double angle = 0.05 * k - 12;
        double axis[3], q[4], r[9], turned[9], back[4];
        unit3(raw, axis);
        turn_quat(axis, angle, q);
        mat_from_quat(q, r);
        mat_turn(axis, angle, turned);
        for (int i = 0; i < 9; i++)
            assert_near(r[i], turned[i], 2 * ROUNDING);
        quat_from_mat(r, back);
        ck_assert(back[0] >= 0);
        const double sign = q[0] < 0 ? -1 : 1;
        for (int i = 0; i < 4; i++)
            assert_near(back[i], sign * q[i], 2 * ROUNDING);
    }
}
END_TEST

START_TEST(test_quat_comes_from_half_turns_too)
{
    static const double axes[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, 0, 0.8}};
    for (size_t k = 0; k < 4; k++) {
        double q[4], r[9], back[4];
        turn_quat(axes[k], PI, q);
        mat_from_quat(q, r);
        quat_from_mat(r, back);
        const double sign = dot3(back + 1, axes[k]) < 0 ? -1 : 1;
        assert_near(back[0], 0, ROUNDING);
        assert_vec(back + 1, sign * axes[k][0], sign * axes[k][1], sign * axes[k][2], ROUNDING);
    }
}
END_TEST

START_TEST(test_vec_largest_and_smallest_take_the_first_on_a_tie)
{
    const double tie[3] = {-2, 2, 1}, all[3] = {1, -1, 1}, last[3] = {0, 1, -3};
    ck_assert_int_eq(largest3(tie), 0);
    ck_assert_int_eq(smallest3(tie), 2);
    ck_assert_int_eq(largest3(all), 0);
    ck_assert_int_eq(smallest3(all), 0);
    ck_assert_int_eq(largest3(last), 2);
    ck_assert_int_eq(smallest3(last), 0);
}
END_TEST

START_TEST(test_vec_sums_and_copies)
{
    const double a[3] = {1, 2, 3}, b[3] = {10, 20, 30};
    double out[3];
    add3(a, b, out);
    assert_vec(out, 11, 22, 33, 0);
    sub3(a, b, out);
    assert_vec(out, -9, -18, -27, 0);
    add_scaled3(a, -0.5, b, out);
    assert_vec(out, -4, -8, -12, 0);
    copy3(a, out);
    assert_vec(out, 1, 2, 3, 0);
    assert_near(dot3(a, b), 140, 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("vec");
    TCase *all = tcase_create("all");
    tcase_add_test(all, test_vec_cross_is_right_handed);
    tcase_add_test(all, test_vec_unit_keeps_direction_at_any_length);
    tcase_add_test(all, test_vec_angle_is_exact_near_zero_and_pi);
    tcase_add_test(all, test_vec_perp_is_normal_even_where_little_is_left);
    tcase_add_test(all, test_vec_turn_follows_the_right_hand);
    tcase_add_test(all, test_mat_products_and_transposes_agree);
    tcase_add_test(all, test_quat_means_the_same_turn_as_the_matrix);
    tcase_add_test(all, test_quat_comes_from_half_turns_too);
    tcase_add_test(all, test_vec_largest_and_smallest_take_the_first_on_a_tie);
    tcase_add_test(all, test_vec_sums_and_copies);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
