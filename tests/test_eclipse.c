/* The Sun's disc behind the Earth's limb. */
#include "orbit/eclipse.h"
#include "orbit/moon.h"

#include "base/constants.h"
#include "base/vec.h"
#include "table.h"

static const double Z[3] = {0.0, 0.0, 1.0};

static double fraction(const double r_m[3], const double sun[3])
{
    return eclipse_sunlit_fraction(r_m, sun, AU_M, Z, 0);
}

static void check_reference(const char *path)
{
    csv_table t = table_open(path);
    for (long k = 0; k < t.n_rows; k++) {
        double r[3], sun[3];
        table_vector(&t, k, "sat_", "_km", r);
        table_vector(&t, k, "sun_", "_km", sun);
        scale3(r, 1e3, r);
        scale3(sun, 1e3, sun);
        sub3(sun, r, sun);
        const double distance_m = unit3(sun, sun);
        const double f = eclipse_sunlit_fraction(r, sun, distance_m, Z, 0);
        /* the same method, to the table's eight decimals; then the exact integral */
        assert_near(f, table_number(&t, k, "f_limbdisc_ellipsoid"), 6e-9);
        assert_near(f, table_number(&t, k, "f_ellipsoid"), 2.5e-4);
    }
    csv_free(&t);
}

START_TEST(test_eclipse_matches_reference)
{
    table_check(check_reference, "orbit/shadow_fraction.csv");
}
END_TEST

/* ------------------------------------------------------------ two plane discs */

START_TEST(test_eclipse_discs_follow_closed_forms)
{
    assert_near(eclipse_disc_fraction(1.0, 0.5, 1.5), 1.0, 0.0); /* touch outside */
    assert_near(eclipse_disc_fraction(1.0, 0.5, 9.0), 1.0, 0.0);
    assert_near(eclipse_disc_fraction(0.5, 1.0, 0.5), 0.0, 0.0); /* touch inside */
    assert_near(eclipse_disc_fraction(0.5, 1.0, 0.0), 0.0, 0.0);
    assert_near(eclipse_disc_fraction(1.0, 0.5, 0.0), 0.75, 1e-16); /* annular */
    assert_near(eclipse_disc_fraction(1.0, 0.5, 0.5), 0.75, 1e-16);
    assert_near(eclipse_disc_fraction(1.0, 1.0, 0.0), 0.0, 0.0);
    /* equal discs: the lens is 2 acos(d/2) - d/2 sqrt(4 - d^2) */
    for (int k = 1; k < 200; k++) {
        const double d = 0.01 * k;
        const double lens = 2.0 * acos(0.5 * d) - 0.5 * d * sqrt(4.0 - d * d);
        assert_near(eclipse_disc_fraction(1.0, 1.0, d), 1.0 - lens / PI, 1e-14);
        assert_near(eclipse_disc_fraction(1e-3, 1e-3, 1e-3 * d), 1.0 - lens / PI, 1e-14);
    }
}
END_TEST

/* Covered area of the disc of radius a at the origin by strips across the line of centres, in the
 * angle p of x = -a cos(p). Where a rim ends the height goes as a square root, so the midpoint rule
 * is good to the strip's width to the power 3/2, some 1e-7. */
static double fraction_by_strips(double a, double b, double d)
{
    enum { STRIPS = 200000 };
    double covered = 0.0;
    for (int k = 0; k < STRIPS; k++) {
        const double p = PI * (k + 0.5) / STRIPS, x = -a * cos(p), y = a * sin(p);
        const double left = (b - d + x) * (b + d - x); /* square of the other rim's height at x */
        if (left > 0.0) covered += 2.0 * fmin(y, sqrt(left)) * a * sin(p) * PI / STRIPS;
    }
    return 1.0 - covered / (PI * a * a);
}

START_TEST(test_eclipse_discs_agree_with_strips)
{
    const double a = 0.00465; /* the Sun from 1 au, rad */
    static const double limbs[] = {1.2, 0.15, 0.006, 0.00465, 0.004, 0.001};
    for (size_t j = 0; j < sizeof limbs / sizeof *limbs; j++)
        for (int k = -9; k <= 9; k++) {
            const double b = limbs[j], reach = fmin(a, b), d = fmax(a, b) + 0.1 * k * reach;
            assert_near(eclipse_disc_fraction(a, b, d), fraction_by_strips(a, b, d), 2e-7);
        }
}
END_TEST

/* The light of a darkened disc past a straight edge (b very large) at x of its radius from the
 * middle, as strips: those at y across the edge's normal have the light of a chord c = sqrt(1 -
 * y^2), (1 - u) 2c + u (pi/2) c^2. */
START_TEST(test_eclipse_darkened_disc_sets_as_strips_do)
{
    enum { N = 200000 };
    static const double U = 0.6, A = 0.00465, B = 1e7;
    for (int k = -9; k <= 9; k++) {
        const double x = 0.1 * k; /* the edge; what is beyond it shines, and b reaches up to it */
        double light = 0;
        for (int j = 0; j < N; j++) {
            const double y = x + (1 - x) * (j + 0.5) / N, c2 = 1 - y * y;
            light += ((1 - U) * 2 * sqrt(c2) + U * PI / 2 * c2) * (1 - x) / N;
        }
        light /= PI * (1 - U / 3);
        assert_near(eclipse_disc_light(A * 1e9, B * 1e9, (B - A * x) * 1e9, U), light, 2e-6);
    }
}
END_TEST

START_TEST(test_eclipse_darkened_disc_keeps_its_limits)
{
    for (int k = 0; k <= 40; k++) {
        const double d = 0.05 * k;
        assert_near(eclipse_disc_light(1, 0.7, d, 0), eclipse_disc_fraction(1, 0.7, d), 0);
        const double plain = eclipse_disc_fraction(1, 0.7, d);
        const double dark = eclipse_disc_light(1, 0.7, d, 0.6);
        ck_assert(dark >= 0 && dark <= 1 && fabs(dark - plain) < 0.12);
    }
    /* A ring is left: its light from its brightness, integrated in closed form: with w = 1 - s^2
     * the integral of 1 - u + u sqrt(w) from 0 to 1 - b^2. */
    const double b = 0.7, w = 1 - b * b, u = 0.6;
    assert_near(eclipse_disc_light(1, b, 0, u),
                ((1 - u) * w + u * 2 / 3 * w * sqrt(w)) / (1 - u / 3), 1e-6);
}
END_TEST

START_TEST(test_eclipse_discs_take_point_sun)
{
    assert_near(eclipse_disc_fraction(0.0, 1.0, 1.0 + 1e-12), 1.0, 0.0);
    assert_near(eclipse_disc_fraction(0.0, 1.0, 1.0 - 1e-12), 0.0, 0.0);
}
END_TEST

/* -------------------------------------------------------------- the ellipsoid */

/* In the plane of the equator the limb is that of a circle of 6378.137 km. */
START_TEST(test_eclipse_limb_is_equator_for_equatorial_geometry)
{
    static const double radii_m[] = {6.5e6, 7e6, 2e7, 42164e3};
    const double a = asin(SUN_RADIUS_M / AU_M), sun[3] = {1.0, 0.0, 0.0};
    for (int j = 0; j < 4; j++)
        for (int k = -10; k <= 10; k++) {
            const double limb = asin(6378137.0 / radii_m[j]), d = limb + 0.1 * k * a;
            const double r[3] = {-radii_m[j] * cos(d), radii_m[j] * sin(d), 0.0};
            assert_near(fraction(r, sun), eclipse_disc_fraction(a, limb, d), 1e-10);
        }
}
END_TEST

/* Above a pole a tangent from z = h to the ellipse x^2/a^2 + z^2/b^2 = 1 has tan(limb) =
 * a/sqrt(h^2 - b^2). */
START_TEST(test_eclipse_limb_is_ellipse_above_pole)
{
    const double equator_m = 6378137.0, polar_m = equator_m * (1.0 - 1.0 / 298.257223563);
    const double a = asin(SUN_RADIUS_M / AU_M);
    static const double heights_m[] = {6.4e6, 7e6, 2e7, 4e7};
    for (int j = 0; j < 4; j++)
        for (int k = -10; k <= 10; k++) {
            const double h = heights_m[j];
            const double limb = atan(equator_m / sqrt((h - polar_m) * (h + polar_m)));
            const double d = limb + 0.1 * k * a, r[3] = {0.0, 0.0, h};
            const double sun[3] = {sin(d) * cos(1.0), sin(d) * sin(1.0), -cos(d)};
            assert_near(fraction(r, sun), eclipse_disc_fraction(a, limb, d), 1e-10);
        }
}
END_TEST

/* Past 1.4 million km the Earth is smaller than the Sun. */
START_TEST(test_eclipse_is_annular_from_far_away)
{
    const double polar_m = 6378137.0 * (1.0 - 1.0 / 298.257223563), h = 2e9;
    const double r[3] = {0.0, 0.0, h}, sun[3] = {0.0, 0.0, -1.0};
    const double limb = atan(6378137.0 / sqrt((h - polar_m) * (h + polar_m)));
    const double covered = limb / asin(SUN_RADIUS_M / AU_M);
    assert_near(fraction(r, sun), 1.0 - covered * covered, 1e-13);
    /* from the plane of the equator the limb is anything between the polar and equatorial one */
    const double far_m[3] = {h, 0.0, 0.0}, behind[3] = {-1.0, 0.0, 0.0};
    const double ring = fraction(far_m, behind);
    ck_assert(ring > 1.0 - 1.0001 * covered * covered);
    ck_assert(ring < 1.0 - 0.993 * covered * covered);
    /* a little aside, still within the Sun's disc */
    const double aside[3] = {sin(1e-3), 0.0, -cos(1e-3)};
    assert_near(fraction(r, aside), 1.0 - covered * covered, 1e-13);
}
END_TEST

START_TEST(test_eclipse_is_total_in_umbra_and_none_in_sunlight)
{
    const double sun[3] = {1.0, 0.0, 0.0};
    for (int k = 0; k < 360; k++) {
        const double angle = k * DEG, radius_m = 7e6;
        const double r[3] = {-radius_m * cos(angle), radius_m * sin(angle) * 0.6,
                             radius_m * sin(angle) * 0.8};
        const double f = fraction(r, sun);
        /* limb at 7000 km: 65.7 deg (equator) to 65.2 deg (pole); the Sun's radius is 0.27 deg */
        const double from_axis = k < 180 ? k : 360 - k;
        if (from_axis < 64.0) assert_near(f, 0.0, 0.0);
        if (from_axis > 67.0) assert_near(f, 1.0, 0.0);
        ck_assert(f >= 0.0 && f <= 1.0);
    }
}
END_TEST

/* Through the penumbra the fraction only rises, without a step where quick answers end. */
START_TEST(test_eclipse_rises_steadily_through_penumbra)
{
    const double sun[3] = {cos(0.3), 0.0, sin(0.3)};
    static const double radii_m[] = {6.4e6, 6.9e6, 4.2e7, 4e8};
    for (int j = 0; j < 4; j++) {
        const double axis[3] = {0.3, -0.9, 0.1};
        double before = -1.0, side[3], largest_step = 0.0;
        const double across[3] = {-sun[0], -sun[1], -sun[2]};
        perp3(axis, across, side);
        const double limb = asin(6378137.0 / radii_m[j]);
        const double from = fmax(0.0, limb - 0.02), to = limb + 0.01;
        for (int k = 0; k <= 20000; k++) {
            const double d = from + (to - from) * k / 20000.0;
            double r[3];
            for (int i = 0; i < 3; i++)
                r[i] = radii_m[j] * (cos(d) * across[i] + sin(d) * side[i]);
            const double f = fraction(r, sun);
            ck_assert_msg(f >= before - 1e-12, "%g after %g", f, before);
            if (k > 0) largest_step = fmax(largest_step, f - before);
            before = f;
        }
        assert_near(before, 1.0, 0.0);
        /* the steepest slope is 2/(pi a) for a straight limb; 4/pi/a bounds it for all */
        ck_assert(largest_step < 4.0 / PI / 0.00465 * (to - from) / 20000.0);
    }
}
END_TEST

START_TEST(test_eclipse_is_dark_inside_earth)
{
    const double sun[3] = {0.0, 0.0, 1.0};
    const double places[][3] = {
        {0.0, 0.0, 0.0}, {0.0, 0.0, 6356751.0}, {6378136.0, 0.0, 0.0}, {-1e6, 2e6, 3e6}};
    for (int k = 0; k < 4; k++)
        assert_near(fraction(places[k], sun), 0.0, 0.0);
    /* just above the pole and below the equatorial radius: in the open, the Sun overhead */
    const double above_pole[3] = {0.0, 0.0, 6358000.0};
    assert_near(fraction(above_pole, sun), 1.0, 0.0);
}
END_TEST

START_TEST(test_eclipse_does_not_depend_on_frame)
{
    const double axis[3] = {0.6, 0.0, 0.8}, sun[3] = {1.0, 0.0, 0.0};
    double turn[9], turned_pole[3], turned_sun[3];
    mat_turn(axis, 1.234, turn);
    mat_vec(turn, Z, turned_pole);
    mat_vec(turn, sun, turned_sun);
    for (int k = 0; k < 200; k++) {
        const double d = 1.13 + 1e-4 * k;
        const double r[3] = {-7e6 * cos(d), 7e6 * sin(d) * cos(0.5), 7e6 * sin(d) * sin(0.5)};
        double turned_r[3];
        mat_vec(turn, r, turned_r);
        assert_near(eclipse_sunlit_fraction(turned_r, turned_sun, AU_M, turned_pole, 0),
                    fraction(r, sun), 1e-10);
    }
}
END_TEST

/* The Moon's disc of radius b before the Sun's of radius a: closed forms of the overlap. Half
 * covered areas of equal discs: the lens of two unit circles at distance 1 is 2 pi/3 - sqrt(3)/2.
 */
START_TEST(test_eclipse_by_the_moon_follows_closed_forms)
{
    static const double MOON_M = 1737.4e3, SUN_M = 695700e3;
    const double sun[3] = {1, 0, 0}, sun_m = AU_M, a = asin(SUN_M / sun_m);
    const double equal_m = MOON_M / sin(a); /* both discs have the same size */
    const struct {
        double distance_m, separation, fraction;
    } CASES[] = {
        {equal_m, 0, 0},
        {equal_m, a, 1 - (2 * PI / 3 - sqrt(3) / 2) / PI},
        {equal_m, 2.0001 * a, 1},
        {1.1 * equal_m, 0, 1 - pow(asin(sin(a) / 1.1) / a, 2)}, /* annular */
        {0.9 * equal_m, 0.05 * a, 0},                           /* total */
        {3.8e8, 1.0, 1},
        {1e7, 1.0, 1},
        {1.8e6, 1.0, 0}, /* just above the Moon: it fills the half of the sky */
        {1e6, 2.0, 0},   /* inside */
    };
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++) {
        const double d = CASES[k].separation, r = CASES[k].distance_m;
        const double moon[3] = {r * cos(d), 0.6 * r * sin(d), -0.8 * r * sin(d)};
        /* rounding of the angles, 1e-16 rad in 1e-3, where the discs touch by a square root */
        assert_near(eclipse_moon_fraction(moon, sun, sun_m, 0), CASES[k].fraction, 1e-7);
    }
}
END_TEST

/* Places and directions from another program: from a point at rest on the geostationary circle the
 * Moon passes before the Sun. Made with astropy 5.2.1 and ERFA; the table says how. */
START_TEST(test_eclipse_by_the_moon_agrees_with_another_program)
{
    csv_table t = table_open(TEST_DATA_DIR "/orbit/moon_shadow.csv");
    int partial = 0;
    for (long row = 0; row < t.n_rows; row++) {
        const double d = table_number(&t, row, "separation_deg") * DEG;
        const double b = table_number(&t, row, "moon_radius_deg") * DEG;
        const double a = table_number(&t, row, "sun_radius_deg") * DEG;
        const double r = MOON_RADIUS_M / sin(b), sun[3] = {0, 0, 1};
        const double moon[3] = {r * sin(d), 0, r * cos(d)};
        const double want = table_number(&t, row, "fraction");
        /* nine digits, of arc cosines that lose some */
        assert_near(eclipse_moon_fraction(moon, sun, SUN_RADIUS_M / sin(a), 0), want, 2e-9);
        partial += want > 0 && want < 1;
    }
    ck_assert_int_gt(partial, 15);
    csv_free(&t);
}
END_TEST

/* Two points on one circle of radius r about the equator: the chord between them passes the centre
 * at r cos(half the angle). Over the poles the ellipsoid is lower. */
START_TEST(test_eclipse_earth_is_between_where_the_chord_cuts_it)
{
    static const double SMALL = 1e-9;
    const double polar_m = EARTH_RADIUS_M * (1 - EARTH_FLATTENING);
    for (int k = 0; k < 20; k++) {
        const double r = EARTH_RADIUS_M * (1.001 + 0.3 * k), half = acos(EARTH_RADIUS_M / r);
        const double polar_half = acos(polar_m / r);
        for (int side = -1; side <= 1; side += 2) {
            const double angle = 2 * half + side * SMALL, c = cos(angle), s = sin(angle);
            const double a[3] = {r, 0, 0}, b[3] = {r * c, r * s, 0};
            ck_assert_int_eq(eclipse_earth_between(a, b, Z), side > 0);
            ck_assert_int_eq(eclipse_earth_between(b, a, Z), side > 0);
            /* symmetric about the pole, so that the chord is lowest above it */
            const double p = polar_half + side * SMALL;
            const double u[3] = {0, r * sin(p), r * cos(p)}, v[3] = {0, -r * sin(p), r * cos(p)};
            ck_assert_int_eq(eclipse_earth_between(u, v, Z), side > 0);
        }
        /* on the same side, and from far behind: the nearest point of the line is not between */
        const double a[3] = {r, 0, 0}, far[3] = {50 * r, 1, 2}, opposite[3] = {-50 * r, 1, 2};
        ck_assert(!eclipse_earth_between(a, far, Z));
        ck_assert(eclipse_earth_between(a, opposite, Z));
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("eclipse");
    TCase *tcase = tcase_create("eclipse");
    suite_add_tcase(suite, tcase);
    tcase_add_test(tcase, test_eclipse_matches_reference);
    tcase_add_test(tcase, test_eclipse_discs_follow_closed_forms);
    tcase_add_test(tcase, test_eclipse_discs_agree_with_strips);
    tcase_add_test(tcase, test_eclipse_discs_take_point_sun);
    tcase_add_test(tcase, test_eclipse_darkened_disc_sets_as_strips_do);
    tcase_add_test(tcase, test_eclipse_darkened_disc_keeps_its_limits);
    tcase_add_test(tcase, test_eclipse_limb_is_equator_for_equatorial_geometry);
    tcase_add_test(tcase, test_eclipse_limb_is_ellipse_above_pole);
    tcase_add_test(tcase, test_eclipse_is_annular_from_far_away);
    tcase_add_test(tcase, test_eclipse_is_total_in_umbra_and_none_in_sunlight);
    tcase_add_test(tcase, test_eclipse_rises_steadily_through_penumbra);
    tcase_add_test(tcase, test_eclipse_is_dark_inside_earth);
    tcase_add_test(tcase, test_eclipse_does_not_depend_on_frame);
    tcase_add_test(tcase, test_eclipse_by_the_moon_follows_closed_forms);
    tcase_add_test(tcase, test_eclipse_by_the_moon_agrees_with_another_program);
    tcase_add_test(tcase, test_eclipse_earth_is_between_where_the_chord_cuts_it);
    return run_suite(suite);
}
