/* The vectorisable exp, log and angle against the C library's long double functions. */
#include "base/constants.h"
#include "brdf/fastmath.h"
#include "testing.h"

#include <float.h>

/* Distance from the true value in units of the last place of a double of that size. */
static double ulps(double got, long double want)
{
    const int exponent = ilogb((double)want);
    const long double ulp = ldexpl(1.0L, exponent - (DBL_MANT_DIG - 1));
    return (double)(fabsl((long double)got - want) / ulp);
}

START_TEST(test_fast_exp_within_stated_ulp)
{
    double worst = 0.0;
    for (double x = -708.3; x < 709.0; x += 0.0037) {
        const double error = ulps(fast_exp(x), expl((long double)x));
        ck_assert_msg(error <= 1.1, "exp(%.17g) is off by %g ulp", x, error);
        worst = fmax(worst, error);
    }
    printf("fast_exp: worst error %.3f ulp\n", worst);
}
END_TEST

START_TEST(test_fast_exp_tiny_argument_keeps_digits)
{
    for (double x = 1e-300; x < 0.1; x *= 7.3) {
        ck_assert_msg(ulps(fast_exp(x), expl((long double)x)) <= 1.1, "exp(%g)", x);
        ck_assert_msg(ulps(fast_exp(-x), expl(-(long double)x)) <= 1.1, "exp(%g)", -x);
    }
    assert_near(fast_exp(0.0), 1.0, 0.0);
}
END_TEST

/* Below -1022.5 ln 2 the result is 0, from there on down to minus infinity. */
START_TEST(test_fast_exp_far_below_zero_is_zero)
{
    const double x[] = {-708.75, -709.1, -745.2, -1e4, -1e17, -1e300, -HUGE_VAL};
    for (size_t k = 0; k < sizeof x / sizeof x[0]; k++)
        assert_near(fast_exp(x[k]), 0.0, 0.0);
    ck_assert(fast_exp(-708.74) > 0.0);
    assert_rel(fast_exp(-708.0), exp(-708.0), 1e-15);
}
END_TEST

START_TEST(test_fast_exp_nan_stays_nan)
{
    ck_assert(isnan(fast_exp((double)NAN)));
}
END_TEST

START_TEST(test_fast_log_within_stated_ulp)
{
    double worst = 0.0;
    for (double x = 1e-307; x < 1e307; x *= 1.0123) {
        const double error = ulps(fast_log(x), logl((long double)x));
        ck_assert_msg(error <= 2.0, "log(%.17g) is off by %g ulp", x, error);
        worst = fmax(worst, error);
    }
    for (double x = 0.5; x < 2.0; x += 1.3e-4) {
        const double error = ulps(fast_log(x), logl((long double)x));
        ck_assert_msg(error <= 2.0, "log(%.17g) is off by %g ulp", x, error);
        worst = fmax(worst, error);
    }
    assert_near(fast_log(1.0), 0.0, 0.0);
    printf("fast_log: worst error %.3f ulp\n", worst);
}
END_TEST

/* Near c = 1 the complement carries the digits. */
START_TEST(test_fast_log_1m_small_complement_keeps_digits)
{
    double worst = 0.0;
    for (double s = 1e-290; s < 0.29; s *= 1.37) {
        const double error = ulps(fast_log_1m(1.0 - s, s), log1pl(-(long double)s));
        ck_assert_msg(error <= 2.0, "log(1 - %.17g) is off by %g ulp", s, error);
        worst = fmax(worst, error);
    }
    printf("fast_log_1m: worst error %.3f ulp\n", worst);
}
END_TEST

/* As documented: finite, and so low that any usual power of it is nothing. */
START_TEST(test_fast_log_zero_is_finite_and_low)
{
    ck_assert(fast_log(0.0) < -708.0);
    ck_assert(fast_log(0.0) > -711.0);
    ck_assert(fast_log(4.9e-324) < -708.0);
}
END_TEST

START_TEST(test_fast_angle_within_stated_ulp)
{
    double worst = 0.0;
    for (double x = 1e-9; x < 0.5 * PI; x = x * 1.01 < x + 1e-3 ? x * 1.01 : x + 1e-3) {
        const double s = sin(x), c = cos(x);
        const double error = ulps(fast_angle(s, c), atan2l((long double)s, (long double)c));
        ck_assert_msg(error <= 4.0, "angle(%.17g, %.17g) is off by %g ulp", s, c, error);
        worst = fmax(worst, error);
    }
    assert_near(fast_angle(0.0, 1.0), 0.0, 0.0);
    assert_near(fast_angle(1.0, 0.0), 0.5 * PI, 4e-16);
    printf("fast_angle: worst error %.3f ulp\n", worst);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fastmath");
    TCase *tests = tcase_create("fastmath");
    tcase_add_test(tests, test_fast_exp_within_stated_ulp);
    tcase_add_test(tests, test_fast_exp_tiny_argument_keeps_digits);
    tcase_add_test(tests, test_fast_exp_far_below_zero_is_zero);
    tcase_add_test(tests, test_fast_exp_nan_stays_nan);
    tcase_add_test(tests, test_fast_log_within_stated_ulp);
    tcase_add_test(tests, test_fast_log_1m_small_complement_keeps_digits);
    tcase_add_test(tests, test_fast_log_zero_is_finite_and_low);
    tcase_add_test(tests, test_fast_angle_within_stated_ulp);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
