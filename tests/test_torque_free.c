/* Free tumbling against an integration in 34 digits, and the laws of mechanics. */
#include "base/constants.h"
#include "base/vec.h"
#include "orbit/attitude.h"
#include "orbit/torque_free.h"
#include "table.h"

static void body_from_quat(const double q[4], double body_inertial[9])
{
    double inertial_body[9];
    mat_from_quat(q, inertial_body);
    mat_transpose(inertial_body, body_inertial);
}

static void read_quat(const csv_table *table, long row, const char *const names[4], double q[4])
{
    double norm2 = 0;
    for (int i = 0; i < 4; i++) {
        q[i] = table_number(table, row, names[i]);
        norm2 += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++)
        q[i] /= sqrt(norm2); /* the table's start may be given unnormalised */
}

/* Stated tolerance of the reference: 1e-11 to 600 s, 1e-9 at a day; we hold ten times less. */
static double tolerance(double t_s)
{
    return t_s <= 600 ? 1e-12 : 1e-10;
}

static void check_tumble(const char *path)
{
    static const char *const start[4] = {"q0w", "q0x", "q0y", "q0z"};
    static const char *const later[4] = {"qw", "qx", "qy", "qz"};
    csv_table table = table_open(path);
    for (long row = 0; row < table.n_rows; row++) {
        double inertia[3], w0[3], q[4], body0[9], got[9], want[9], got_w[3];
        for (int i = 0; i < 3; i++) {
            char name[32];
            snprintf(name, sizeof name, "I%d", i + 1);
            inertia[i] = table_number(&table, row, name);
            snprintf(name, sizeof name, "w%d_0_rads", i + 1);
            w0[i] = table_number(&table, row, name);
        }
        const double t_s = table_number(&table, row, "t_s");
        torque_free b;
        read_quat(&table, row, start, q);
        body_from_quat(q, body0);
        torque_free_start(inertia, w0, body0, &b);
        torque_free_at(&b, t_s, got, got_w);
        read_quat(&table, row, later, q);
        body_from_quat(q, want);
        for (int i = 0; i < 9; i++)
            assert_near(got[i], want[i], tolerance(t_s));
        for (int i = 0; i < 3; i++) {
            char name[32];
            snprintf(name, sizeof name, "w%d_rads", i + 1);
            assert_near(got_w[i], table_number(&table, row, name), tolerance(t_s));
        }
    }
    csv_free(&table);
}

START_TEST(test_torque_free_agrees_with_34_digits)
{
    table_check(check_tumble, "orbit/tumble_torquefree.csv");
}
END_TEST

/* Inertia and rates that reach every branch: about each axis, both ends of the momentum scale,
 * every order of the axes, symmetric, spherical, at rest, on and next to the separatrix. */
static const struct {
    double inertia[3], w[3]; /* kg m^2, rad/s */
} CASES[] = {{{1, 2, 2.5}, {0.1, 0.2, 0.3}},
             {{2.5, 2, 1}, {0.1, 0.2, 0.3}},
             {{2, 1, 2.5}, {0.1, 0.2, -0.3}},
             {{2, 2.5, 1}, {-0.1, 0.2, 0.3}},
             {{1, 2.5, 2}, {0.1, -0.2, 0.3}},
             {{2.5, 1, 2}, {0.5, 0.2, 0.1}},
             {{1, 2, 2.5}, {0.7, 0.1, 0.05}},
             {{1, 2, 2.5}, {-0.7, 0.1, 0.05}},
             {{1, 2, 2.5}, {0, 0, 0.4}},
             {{1, 2, 2.5}, {0.4, 0, 0}},
             {{1, 2, 2.5}, {0, 0.4, 0}},
             {{1, 2, 2.5}, {0, 0, -0.4}},
             {{1, 1, 2}, {0.1, 0.2, 0.3}},
             {{2, 2, 1}, {0.1, 0.2, 0.3}},
             {{2, 1, 1}, {0.3, -0.2, 0.1}},
             {{2, 2, 2}, {0.3, -0.2, 0.1}},
             {{1, 2, 2.5}, {0, 0, 0}},
             {{1, 2, 3}, {0.2, 0.1, 0.2 / 1.7320508075688772}},
             {{1, 2, 2.5}, {1e-9, 0.4, 0}},
             {{1, 2, 2.5}, {0, 1e-12, 0.4}},
             {{1, 2, 2.5}, {0.4, 1e-12, -1e-12}},
             {{1, 1 + 1e-9, 2}, {0.1, 0.2, 0.3}}};
enum { N_CASES = sizeof CASES / sizeof *CASES };

static void start_case(int k, torque_free *b, double body0[9])
{
    static const double q[4] = {0.5, -0.5, 0.1, 0.7}; /* norm 1 */
    body_from_quat(q, body0);
    torque_free_start(CASES[k].inertia, CASES[k].w, body0, b);
}

START_TEST(test_torque_free_keeps_energy_and_momentum_in_space)
{
    torque_free b;
    double body[9], l0[3], w[3];
    start_case(_i, &b, body);
    double energy0 = 0, l_body[3], l[3];
    for (int i = 0; i < 3; i++) {
        l_body[i] = CASES[_i].inertia[i] * CASES[_i].w[i];
        energy0 += l_body[i] * CASES[_i].w[i];
    }
    mat_tvec(body, l_body, l0);
    for (double t_s = -500; t_s <= 500; t_s += 13.7) {
        torque_free_at(&b, t_s, body, w);
        double energy = 0, identity[9], transposed[9];
        for (int i = 0; i < 3; i++) {
            l_body[i] = CASES[_i].inertia[i] * w[i];
            energy += l_body[i] * w[i];
        }
        assert_near(energy, energy0, 1e-12);
        mat_tvec(body, l_body, l);
        for (int i = 0; i < 3; i++)
            assert_near(l[i], l0[i], 2e-12);
        mat_transpose(body, transposed);
        mat_mul(body, transposed, identity);
        for (int i = 0; i < 9; i++)
            assert_near(identity[i], i % 4 == 0, 1e-13);
    }
}
END_TEST

/* The attitude changes at the body rates: dR/dt = -[w] R, by central differences. */
START_TEST(test_torque_free_attitude_follows_its_rates)
{
    static const double H_S = 1e-3; /* error of the difference: H^2 w^3/6, 1e-7 rad/s at most */
    torque_free b;
    double at_start[9];
    start_case(_i, &b, at_start);
    for (double t_s = 0; t_s <= 60; t_s += 7.3) {
        double before[9], body[9], after[9], w[3], turned[3];
        torque_free_at(&b, t_s - H_S, before, NULL);
        torque_free_at(&b, t_s, body, w);
        torque_free_at(&b, t_s + H_S, after, NULL);
        for (int column = 0; column < 3; column++) {
            const double axis[3] = {body[column], body[3 + column], body[6 + column]};
            cross3(axis, w, turned); /* -w x axis */
            for (int i = 0; i < 3; i++)
                assert_near((after[3 * i + column] - before[3 * i + column]) / (2 * H_S), turned[i],
                            2e-7);
        }
    }
}
END_TEST

/* The bound of the rate holds at every moment, and is not wide of it: it joins the largest squares
 * of components that need not be large at once, which is a factor of sqrt(2) at most. */
START_TEST(test_torque_free_fastest_bounds_the_rates)
{
    torque_free b;
    double body[9], w[3], most = 0;
    start_case(_i, &b, body);
    const double fastest = torque_free_fastest(&b);
    for (double t_s = -500; t_s <= 500; t_s += 0.1) {
        torque_free_at(&b, t_s, body, w);
        most = fmax(most, norm3(w));
    }
    ck_assert_double_le(most, fastest * (1 + 1e-12));
    ck_assert_double_ge(most, fastest / sqrt(2) * (1 - 1e-3)); /* between moments looked at */
}
END_TEST

START_TEST(test_torque_free_starts_where_it_is_told)
{
    torque_free b;
    double want[9], got[9], w[3];
    start_case(_i, &b, want);
    torque_free_at(&b, 0, got, w);
    for (int i = 0; i < 9; i++)
        assert_near(got[i], want[i], 1e-14);
    for (int i = 0; i < 3; i++)
        assert_near(w[i], CASES[_i].w[i], 1e-14);
}
END_TEST

/* A symmetric top turns about L at L/I and about its own axis, in closed form (Goldstein). */
START_TEST(test_torque_free_symmetric_top_precesses_at_l_over_i)
{
    static const double inertia[3] = {2, 2, 3}, w[3] = {0.3, 0, 0.2};
    double body[9], got[9];
    mat_identity(body);
    torque_free b;
    torque_free_start(inertia, w, body, &b);
    const double l[3] = {0.6, 0, 0.6};
    double unit_l[3], turn[9], space_axis[3];
    const double rate = unit3(l, unit_l) / 2; /* rad/s */
    for (double t_s = 0; t_s < 100; t_s += 9.1) {
        torque_free_at(&b, t_s, got, NULL);
        mat_turn(unit_l, rate * t_s, turn);
        const double z[3] = {0, 0, 1};
        double want[3];
        mat_vec(turn, z, want);       /* the axis precesses about L */
        mat_tvec(got, z, space_axis); /* and so does ours */
        for (int i = 0; i < 3; i++)
            assert_near(space_axis[i], want[i], 1e-13);
    }
}
END_TEST

START_TEST(test_torque_free_law_refuses_impossible_bodies)
{
    static const double bad[][3] = {{1, 1, 2.1}, {0, 1, 1}, {-1, 1, 1}};
    const attitude_law *law = attitude_law_named("torque-free");
    ck_assert_ptr_nonnull(law);
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        attitude_spec spec;
        attitude out;
        glint_errors *errors = glint_errors_new();
        attitude_spec_start(law, PLACE_NONE, &spec);
        for (int i = 0; i < 3; i++)
            spec.given[i] = true;
        copy3(bad[k], spec.value[0]);
        spec.value[2][0] = 1;
        ck_assert_int_eq(attitude_prepare(&spec, &out, errors), GLINT_INPUT);
        ck_assert_uint_eq(glint_errors_count(errors), 1);
        glint_errors_free(errors);
    }
}
END_TEST

/* Through the law: a quaternion body to GCRS, rates in deg/s, counted from the epoch. */
START_TEST(test_torque_free_law_counts_from_its_epoch)
{
    const attitude_law *law = attitude_law_named("torque-free");
    attitude_spec spec;
    attitude a;
    attitude_spec_start(law, PLACE_NONE, &spec);
    for (int i = 0; i < law->n_keys; i++)
        spec.given[i] = true;
    const double inertia[3] = {1, 2, 2.5}, rates_deg_s[3] = {0, 0, 3}, x[3] = {1, 0, 0};
    copy3(inertia, spec.value[0]);
    copy3(rates_deg_s, spec.value[1]);
    spec.value[2][0] = 1; /* body axes along GCRS at the epoch */
    spec.value[3][0] = 40;
    ck_assert_int_eq(attitude_prepare(&spec, &a, NULL), GLINT_OK);
    const moment m = {.t_s = 50};
    double body_gcrs[9], body[3];
    ck_assert_int_eq(attitude_at(&a, &m, body_gcrs, NULL), GLINT_OK);
    mat_vec(body_gcrs, x, body); /* the body has turned by +30 deg about z in 10 s */
    assert_near(body[0], cos(30 * DEG), 1e-14);
    assert_near(body[1], -sin(30 * DEG), 1e-14);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("torque-free");
    TCase *tc = tcase_create("torque-free");
    tcase_add_test(tc, test_torque_free_agrees_with_34_digits);
    tcase_add_loop_test(tc, test_torque_free_keeps_energy_and_momentum_in_space, 0, N_CASES);
    tcase_add_loop_test(tc, test_torque_free_attitude_follows_its_rates, 0, N_CASES);
    tcase_add_loop_test(tc, test_torque_free_starts_where_it_is_told, 0, N_CASES);
    tcase_add_loop_test(tc, test_torque_free_fastest_bounds_the_rates, 0, N_CASES);
    tcase_add_test(tc, test_torque_free_symmetric_top_precesses_at_l_over_i);
    tcase_add_test(tc, test_torque_free_law_refuses_impossible_bodies);
    tcase_add_test(tc, test_torque_free_law_counts_from_its_epoch);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
