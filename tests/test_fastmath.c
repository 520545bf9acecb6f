/* The vectorisable exp, log and angle against the C library's long double functions. */
#include "base/constants.h"
#include "base/fasttrig.h"
#include "brdf/fastmath.h"
#include "lightcurve/sky.h"
#include "testing.h"

#include <float.h>

/* Distance from the true value in units of the last place of a double of that size. */
static double ulps(double got, long double want)
{
    const int exponent = ilogb((double)want);
    const long double ulp = ldexpl(1.0L, exponent - (DBL_MANT_DIG - 1));
    return (double)(fabsl((long double)got - want) / ulp);
}

/* |got - want| in ulp, or in 1e-16 where that is more. */
static void assert_trig(double x)
{
    double s, c;
    fast_sin_cos(x, &s, &c);
    const long double sine = sinl((long double)x), cosine = cosl((long double)x);
    ck_assert_msg(fabsl((long double)s - sine) <= 1e-16L || ulps(s, sine) <= 1.5,
                  "sin(%.17g) is off by %g ulp", x, ulps(s, sine));
    ck_assert_msg(fabsl((long double)c - cosine) <= 1e-16L || ulps(c, cosine) <= 1.5,
                  "cos(%.17g) is off by %g ulp", x, ulps(c, cosine));
}

START_TEST(test_fast_sin_cos_within_stated_error)
{
    for (double x = -20; x < 20; x += 0.000317)
        assert_trig(x);
    for (double x = 1e-300; x < 1e300; x *= 1.37) {
        assert_trig(x);
        assert_trig(-x);
    }
    for (int k = -300000; k < 300000; k += 7) { /* next to the edges of quadrants and octants */
        assert_trig(0.25 * PI * k);
        assert_trig(nextafter(0.25 * PI * k, 1e9));
    }
    double s, c;
    fast_sin_cos(0, &s, &c);
    assert_near(s, 0, 0);
    assert_near(c, 1, 0);
    const double wrong[] = {(double)NAN, HUGE_VAL, -HUGE_VAL};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        fast_sin_cos(wrong[k], &s, &c);
        ck_assert(isnan(s) && isnan(c));
    }
}
END_TEST

START_TEST(test_turn_sin_cos_turns)
{
    for (double x = -4; x < 4; x += 0.013)
        for (double turn = -1e-3; turn <= 1e-3; turn += 1.7e-4) {
            double s = sin(x), c = cos(x);
            turn_sin_cos(turn, &s, &c);
            /* the angle's rounding, twice that of the numbers */
            assert_near(s, (double)sinl((long double)x + (long double)turn), 3e-16);
            assert_near(c, (double)cosl((long double)x + (long double)turn), 3e-16);
        }
}
END_TEST

START_TEST(test_sky_angle_is_that_of_atan2)
{
    for (double x = -1; x <= 1; x += 0.0123)
        for (double y = -1; y <= 1; y += 0.0117)
            assert_near(sky_angle(y, x), (double)atan2l((long double)y, (long double)x), 1.6e-15);
    for (double y = 1e-300; y < 1e-3; y *= 13) {
        assert_rel(sky_angle(y, 1), y, 1e-6); /* y - y^3/3 */
        assert_rel(sky_angle(-y, 1), -y, 1e-6);
        assert_near(sky_angle(y, -1), PI - y, 1e-9);
        assert_near(sky_angle(1, y), 0.5 * PI - y, 1e-9);
    }
    assert_near(sky_angle(0, 0), 0, 0);
    assert_near(sky_angle(0, -1), PI, 0);
    assert_near(sky_azimuth(0, 0), 0, 0);
    assert_near(sky_azimuth(-1e-300, 1), 0, 0); /* not a full turn */
    assert_near(sky_azimuth(-1, 0), 1.5 * PI, 1e-15);
    assert_near(sky_azimuth(1, 0), 0.5 * PI, 4e-16);
    assert_near(sky_elevation(0, 0, 1), 0.5 * PI, 4e-16);
    assert_near(sky_elevation(3, 4, -5), -0.25 * PI, 4e-16);
}
END_TEST

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
    tcase_add_test(tests, test_fast_sin_cos_within_stated_error);
    tcase_add_test(tests, test_turn_sin_cos_turns);
    tcase_add_test(tests, test_fast_exp_within_stated_ulp);
    tcase_add_test(tests, test_fast_exp_tiny_argument_keeps_digits);
    tcase_add_test(tests, test_fast_exp_far_below_zero_is_zero);
    tcase_add_test(tests, test_fast_exp_nan_stays_nan);
    tcase_add_test(tests, test_fast_log_within_stated_ulp);
    tcase_add_test(tests, test_fast_log_1m_small_complement_keeps_digits);
    tcase_add_test(tests, test_fast_log_zero_is_finite_and_low);
    tcase_add_test(tests, test_fast_angle_within_stated_ulp);
    tcase_add_test(tests, test_sky_angle_is_that_of_atan2);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
