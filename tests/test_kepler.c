/* Two-body motion and the secular effect of J2. */
#include "orbit/kepler.h"

#include "base/constants.h"
#include "base/vec.h"
#include "kepler_table.h"

static const double MU = 398600.4418e9; /* m^3/s^2, of the reference tables */

static kepler_orbit orbit_of(const kepler_elements *elements, double j2)
{
    kepler_orbit orbit;
    ck_assert(kepler_start(elements, MU, j2, 6378137.0, &orbit, NULL) == GLINT_OK);
    return orbit;
}

static kepler_elements table_elements(const csv_table *t, long k)
{
    return (kepler_elements){
        .semi_major_axis_m = 1e3 * table_number(t, k, "a_km"),
        .eccentricity = table_number(t, k, "e"),
        .inclination = DEG * table_number(t, k, "i_deg"),
        .raan = DEG * table_number(t, k, "raan_deg"),
        .argument_of_perigee = DEG * table_number(t, k, "argp_deg"),
        .mean_anomaly = DEG * table_number(t, k, "M0_deg"),
    };
}

/* What is left is the rounding of angles, the largest of them the mean anomaly: 2900 rad after a
 * month in low orbit, good to 2.3e-13 rad, which are 1.6e-9 km. */
static void assert_state(const csv_table *t, long k, const kepler_orbit *orbit, bool drifts)
{
    double r[3], v[3], r_want_km[3], v_want_km_s[3];
    kepler_state(orbit, table_number(t, k, "t_s"), r, v);
    table_vector(t, k, "", "_km", r_want_km);
    table_kepler_velocity(t, k, drifts, v_want_km_s);
    for (int i = 0; i < 3; i++) {
        assert_near(1e-3 * r[i], r_want_km[i], 4e-9);
        assert_near(1e-3 * v[i], v_want_km_s[i], 5e-12);
    }
}

static void check_two_body(const char *path)
{
    csv_table t = table_open(path);
    for (long k = 0; k < t.n_rows; k++) {
        const kepler_elements elements = table_elements(&t, k);
        const kepler_orbit orbit = orbit_of(&elements, 0.0);
        assert_state(&t, k, &orbit, false);
        const double mean = elements.mean_anomaly + orbit.mean_motion * table_number(&t, k, "t_s");
        assert_near(kepler_eccentric_anomaly(mean, elements.eccentricity),
                    table_number(&t, k, "E_rad"), 2e-12);
    }
    csv_free(&t);
}

START_TEST(test_kepler_two_body_matches_reference)
{
    table_check(check_two_body, "orbit/kepler_twobody.csv");
}
END_TEST

static void check_j2(const char *path)
{
    csv_table t = table_open(path);
    for (long k = 0; k < t.n_rows; k++) {
        const kepler_elements elements = table_elements(&t, k);
        const kepler_orbit orbit = orbit_of(&elements, 1.08262668e-3);
        assert_rel(orbit.raan_rate, table_number(&t, k, "raan_dot_rads"), 2e-15);
        assert_rel(orbit.argument_rate, table_number(&t, k, "argp_dot_rads"), 1e-14);
        assert_rel(orbit.mean_motion, table_number(&t, k, "M_dot_rads"), 1e-15);
        assert_state(&t, k, &orbit, true);
    }
    csv_free(&t);
}

START_TEST(test_kepler_j2_matches_reference)
{
    table_check(check_j2, "orbit/kepler_j2secular.csv");
}
END_TEST

/* The velocity is the rate of the position, where J2 acts, too: by differences of fourth order over
 * 2 s, whose error is h^4/30 times the fifth derivative, 1e-9 m/s near the perigee, and the
 * rounding of positions, 1e-8 m. */
START_TEST(test_kepler_velocity_is_the_rate_of_the_position)
{
    static const kepler_elements ORBITS[] = {{7000e3, 0.001, 0.9, 1, 2, 3},
                                             {26560e3, 0.74, 63.4 * DEG, 2, -1.5, 0.01},
                                             {12000e3, 0.4, 2.5, 0.3, 0.7, 5}};
    static const double H = 2;
    for (size_t k = 0; k < sizeof ORBITS / sizeof *ORBITS; k++)
        for (double t_s = 0; t_s < 86400; t_s += 977) {
            const kepler_orbit orbit = orbit_of(&ORBITS[k], 1.08262668e-3);
            double r[4][3], v[3], unused[3];
            for (int j = 0; j < 4; j++)
                kepler_state(&orbit, t_s + H * (j < 2 ? j - 2 : j - 1), r[j], unused);
            kepler_state(&orbit, t_s, unused, v);
            for (int i = 0; i < 3; i++)
                assert_near(v[i], (8 * (r[2][i] - r[1][i]) - (r[3][i] - r[0][i])) / (12 * H), 3e-7);
        }
}
END_TEST

/* ---------------------------------------------------------- Kepler's equation */

static const double eccentricities[] = {0.0,  1e-12, 1e-3, 0.05,  0.0999,   0.1,       0.3,
                                        0.74, 0.9,   0.99, 0.999, 1 - 1e-6, 1 - 1e-12, 1 - 1.2e-16};
enum { N_ECCENTRICITIES = sizeof eccentricities / sizeof *eccentricities };

/* x - sin(x) in extended precision by its whole series, which has no cancellation below 1. */
static long double minus_sine(long double x)
{
    long double term = x * x * x / 6.0L, sum = 0.0L;
    for (int k = 4; fabsl(term) > 1e-22L * fabsl(sum); k += 2) {
        sum += term;
        term *= -x * x / (k * (k + 1));
    }
    return sum;
}

/* E from M, put back into the equation in extended precision: the residual over the slope is the
 * error of E. It is relative even where e is next to 1 and the equation is E^3/6 = M. */
START_TEST(test_kepler_equation_holds_for_every_eccentricity)
{
    for (int j = 0; j < N_ECCENTRICITIES; j++)
        for (int k = 0; k <= 4000; k++) {
            const double e = eccentricities[j];
            /* even steps, then steps of the logarithm from 1e-18 rad to 1 rad */
            const double m = k <= 2000 ? PI * k / 2000.0 : pow(10.0, -18.0 + (k - 2000) / 111.2);
            const double x = kepler_eccentric_anomaly(m, e);
            const long double less = 1.0L - (long double)e, half = sinl(0.5L * (long double)x);
            const long double residual = less * (long double)x +
                                         (long double)e * minus_sine((long double)x) -
                                         (long double)m;
            const long double slope = less + 2.0L * (long double)e * half * half;
            assert_near(slope > 0.0L ? (double)(residual / slope) : 0.0, 0.0, 1e-15 * x);
            assert_near(kepler_eccentric_anomaly(-m, e), -x, 0.0);
        }
}
END_TEST

START_TEST(test_kepler_equation_takes_mean_anomalies_of_any_size)
{
    static const double turns[] = {1.0, -7.0, 12345.0, 1e6, -1e9, 1e12};
    for (size_t i = 0; i < sizeof turns / sizeof *turns; i++)
        for (int k = -9; k <= 9; k++) {
            const double m = 0.3 * k, big = m + turns[i] * TWO_PI;
            /* the exact value that `big` stands for, less whole turns of the exact 2 pi */
            const long double two_pi = 6.283185307179586476925286766559L;
            const double left = (double)((long double)big - (long double)turns[i] * two_pi);
            /* extended precision keeps 5e-20 of the big angle */
            const double blur = 1e-19 * fabs(big), e = 0.4;
            assert_near(kepler_eccentric_anomaly(big, e), kepler_eccentric_anomaly(left, e),
                        2e-15 + blur / (1.0 - e));
        }
    ck_assert(fabs(kepler_eccentric_anomaly(1e300, 0.9)) <= PI);
    assert_near(kepler_eccentric_anomaly(PI, 0.99), PI, 4e-16);
    assert_near(kepler_eccentric_anomaly(0.0, 0.99), 0.0, 0.0);
}
END_TEST

/* ---------------------------------------------------------------- properties */

/* Energy -mu/2a and angular momentum sqrt(mu a (1-e^2)) along the pole, at any time. */
START_TEST(test_kepler_conserves_energy_and_angular_momentum)
{
    static const double eccentricity[] = {0.0, 0.001, 0.1, 0.5, 0.9, 0.99};
    for (int j = 0; j < 6; j++) {
        const double e = eccentricity[j], a = 7e6 / (1.0 - e), i = 1.1, raan = -2.0;
        const kepler_elements elements = {a, e, i, raan, 0.7, 3.0};
        const kepler_orbit orbit = orbit_of(&elements, 0.0);
        const double pole[3] = {sin(raan) * sin(i), -cos(raan) * sin(i), cos(i)};
        const double momentum = sqrt(MU * a * (1.0 - e * e));
        for (int k = -300; k <= 300; k++) {
            double r[3], v[3], h[3];
            kepler_state(&orbit, 1e6 * k + 3.7 * k * k, r, v); /* ten years each way */
            cross3(r, v, h);
            /* near the perigee two terms, (1+e)/(1-e) times the sum, cancel */
            assert_near(0.5 * dot3(v, v) - MU / norm3(r), -MU / (2.0 * a),
                        2e-15 * MU / (a * (1.0 - e)));
            for (int c = 0; c < 3; c++)
                assert_near(h[c], momentum * pole[c], 1e-14 * momentum);
        }
    }
}
END_TEST

START_TEST(test_kepler_velocity_is_derivative_of_position)
{
    const kepler_elements elements = {1.2e7, 0.4, 0.5, 1.5, 2.5, 0.1};
    const kepler_orbit orbit = orbit_of(&elements, 0.0);
    for (int k = 0; k < 50; k++) {
        const double t_s = 300.0 * k, h_s = 0.5;
        double r[3], v[3], before[3], after[3], unused[3];
        kepler_state(&orbit, t_s, r, v);
        kepler_state(&orbit, t_s - h_s, before, unused);
        kepler_state(&orbit, t_s + h_s, after, unused);
        /* a central difference leaves h^2/6 r''', at most 5e-4 m/s here */
        for (int i = 0; i < 3; i++)
            assert_near((after[i] - before[i]) / (2.0 * h_s), v[i], 5e-4);
    }
}
END_TEST

/* At the perigee, a (1-e) from the focus, and moving across. */
START_TEST(test_kepler_perigee_stands_where_elements_say)
{
    const kepler_elements elements = {1e7, 0.3, 0.0, 0.0, PI / 2.0, 0.0};
    const kepler_orbit orbit = orbit_of(&elements, 0.0);
    double r[3], v[3];
    kepler_state(&orbit, 0.0, r, v);
    assert_near(r[0], 0.0, 1e-8);
    assert_near(r[1], 7e6, 1e-8);
    assert_near(r[2], 0.0, 0.0);
    assert_near(v[0], -sqrt(MU / 1e7 * 1.3 / 0.7), 1e-11);
    assert_near(v[1], 0.0, 1e-11);
    const double period_s = TWO_PI * sqrt(1e21 / MU);
    kepler_state(&orbit, 0.5 * period_s, r, v); /* apogee */
    assert_near(r[1], -1.3e7, 1e-7);
}
END_TEST

/* A sun-synchronous node follows the mean Sun: 360 deg in a tropical year of 365.2422 d. Satellites
 * at 800 km do it at 98.6 deg (Landsat, ERS, SPOT); 0.05 deg are 0.6 % of the rate. */
START_TEST(test_kepler_j2_turns_sun_synchronous_node)
{
    const kepler_elements elements = {7178137.0, 0.0, 98.6 * DEG, 0.0, 0.0, 0.0};
    const kepler_orbit orbit = orbit_of(&elements, 1.08262668e-3);
    assert_rel(orbit.raan_rate, TWO_PI / (365.2422 * DAY_S), 0.006);
}
END_TEST

START_TEST(test_kepler_start_refuses_bad_elements)
{
    const kepler_elements good = {7e6, 0.1, 1.0, 1.0, 1.0, 1.0};
    kepler_elements bad[10] = {good, good, good, good, good, good, good, good, good, good};
    bad[0].eccentricity = 1.0;
    bad[1].eccentricity = -0.1;
    bad[2].eccentricity = (double)NAN;
    bad[3].semi_major_axis_m = 0.0;
    bad[4].semi_major_axis_m = -7e6;
    bad[5].semi_major_axis_m = (double)INFINITY;
    bad[6].inclination = (double)NAN;
    bad[7].raan = (double)INFINITY;
    bad[8].argument_of_perigee = (double)NAN;
    bad[9].mean_anomaly = (double)NAN;
    for (int k = 0; k < 10; k++) {
        kepler_orbit orbit;
        glint_error error = {0};
        ck_assert(kepler_start(&bad[k], MU, 0.0, 6378137.0, &orbit, &error) == GLINT_INPUT);
        ck_assert(strstr(error.message, "expected") != NULL);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("kepler");
    TCase *tcase = tcase_create("kepler");
    suite_add_tcase(suite, tcase);
    tcase_add_test(tcase, test_kepler_two_body_matches_reference);
    tcase_add_test(tcase, test_kepler_j2_matches_reference);
    tcase_add_test(tcase, test_kepler_velocity_is_the_rate_of_the_position);
    tcase_add_test(tcase, test_kepler_equation_holds_for_every_eccentricity);
    tcase_add_test(tcase, test_kepler_equation_takes_mean_anomalies_of_any_size);
    tcase_add_test(tcase, test_kepler_conserves_energy_and_angular_momentum);
    tcase_add_test(tcase, test_kepler_velocity_is_derivative_of_position);
    tcase_add_test(tcase, test_kepler_perigee_stands_where_elements_say);
    tcase_add_test(tcase, test_kepler_j2_turns_sun_synchronous_node);
    tcase_add_test(tcase, test_kepler_start_refuses_bad_elements);
    return run_suite(suite);
}
