/* Sequences of attitude laws: slews between them, as they are read and as they turn. */
#include "base/constants.h"
#include "base/vec.h"
#include "orbit/attitude_plan.h"
#include "scenario/scenario.h"
#include "scenario_text.h"

/* ------------------------------------------------------------------ helpers */

/* Rounding of a few dozen operations on numbers of size 1. */
static const double rounding = 1e-14;

static const double x_axis[3] = {1, 0, 0}, z_axis[3] = {0, 0, 1};

static attitude inertial(const double axis[3], double angle)
{
    attitude_spec spec;
    attitude a;
    attitude_spec_start(attitude_law_named("inertial"), PLACE_NONE, &spec);
    quat_turn(axis, angle, spec.value[0]);
    spec.given[0] = true;
    ck_assert_int_eq(attitude_prepare(&spec, &a, NULL), GLINT_OK);
    return a;
}

/* Turns about its z, which stays along GCRS z, from `phase_deg` at the start. */
static attitude spinning(double rate_deg_s, double phase_deg)
{
    attitude_spec spec;
    attitude a;
    attitude_spec_start(attitude_law_named("spin"), PLACE_NONE, &spec);
    static const char *const names[] = {"body_axis", "pole", "rate_deg_s", "phase_deg"};
    int k[4];
    for (int i = 0; i < 4; i++) {
        k[i] = attitude_key_index(spec.law, names[i]);
        spec.given[k[i]] = true;
    }
    copy3(z_axis, spec.value[k[0]]);
    spec.to[k[1]].kind = DIRECTION_NORTH;
    spec.value[k[2]][0] = rate_deg_s;
    spec.value[k[3]][0] = phase_deg;
    ck_assert_int_eq(attitude_prepare(&spec, &a, NULL), GLINT_OK);
    return a;
}

static attitude_plan plan_of(attitude before, attitude after, double from_s, double slew_s)
{
    attitude_plan plan = {0};
    const attitude_leg first = {.law = before, .from_s = -INFINITY},
                       second = {.law = after, .from_s = from_s, .slew_s = slew_s};
    ck_assert_int_eq(attitude_plan_add(&plan, &first, NULL), GLINT_OK);
    ck_assert_int_eq(attitude_plan_add(&plan, &second, NULL), GLINT_OK);
    return plan;
}

static void settle(attitude_plan *plan)
{
    const moment m = {.t_s = plan->legs[1].from_s};
    ck_assert_int_eq(attitude_plan_settle(plan, 1, &m, 1, NULL), GLINT_OK);
}

static void axes_at(const attitude_plan *plan, double t_s, double body_gcrs[9])
{
    const moment m = {.t_s = t_s};
    glint_error error = {0};
    ck_assert_msg(attitude_plan_at(plan, &m, body_gcrs, &error) == GLINT_OK, "%s", error.message);
}

/* The angle of the turn between two attitudes, rad. */
static double angle_between(const double a[9], const double b[9])
{
    double transposed[9], turn[9], q[4];
    mat_transpose(a, transposed);
    mat_mul(b, transposed, turn);
    quat_from_mat(turn, q);
    return 2 * atan2(norm3(q + 1), q[0]);
}

static void assert_mat_near(const double got[9], const double want[9], double tol)
{
    for (int i = 0; i < 9; i++)
        assert_near(got[i], want[i], tol);
}

/* ----------------------------------------------------------------------- slews */

/* 120 deg about a fixed axis in 60 s: 2 deg each second. */
START_TEST(test_attitude_plan_slew_between_fixed_attitudes_is_steady)
{
    double axis[3];
    unit3((const double[3]){1, -2, 3}, axis);
    attitude_plan plan = plan_of(inertial(axis, 20 * DEG), inertial(axis, 140 * DEG), 100, 60);
    settle(&plan);
    for (int i = 0; i <= 60; i++) {
        double got[9], want[9];
        axes_at(&plan, 100 + i, got);
        mat_turn(axis, -(20 + 2 * i) * DEG, want); /* the body turns, coordinates turn back */
        assert_mat_near(got, want, rounding);
    }
    attitude_plan_free(&plan);
}
END_TEST

START_TEST(test_attitude_plan_slew_goes_the_shorter_way)
{
    attitude_plan plan = plan_of(inertial(z_axis, 170 * DEG), inertial(z_axis, -170 * DEG), 0, 20);
    double got[9], want[9];
    axes_at(&plan, 5, got);
    mat_turn(z_axis, -175 * DEG, want);
    assert_mat_near(got, want, rounding);
    attitude_plan_free(&plan);
}
END_TEST

START_TEST(test_attitude_plan_laws_are_exact_outside_slews)
{
    attitude_plan plan = plan_of(spinning(3, 10), inertial(x_axis, 1), 50, 25);
    settle(&plan);
    for (int i = -100; i <= 200; i++) {
        if (i >= 50 && i < 75) continue;
        const moment m = {.t_s = i};
        double got[9], want[9];
        axes_at(&plan, i, got);
        ck_assert_int_eq(attitude_at(&plan.legs[i >= 50].law, &m, want, NULL), GLINT_OK);
        assert_mat_near(got, want, 0);
    }
    attitude_plan_free(&plan);
}
END_TEST

START_TEST(test_attitude_plan_without_a_slew_jumps)
{
    attitude_plan plan = plan_of(inertial(z_axis, 0), inertial(z_axis, 1), 50, 0);
    double before[9], after[9];
    axes_at(&plan, nextafter(50, 0), before);
    axes_at(&plan, 50, after);
    assert_near(angle_between(before, after), 1, rounding);
    attitude_plan_free(&plan);
}
END_TEST

/* Two laws of which one turns by 1 deg/s pass through opposite attitudes during the slew: the body
 * keeps to its side, so that it never moves faster than both rates and the slew's together. */
START_TEST(test_attitude_plan_slew_does_not_jump_where_laws_are_opposite)
{
    static const double step_s = 0.01;
    for (int way = -1; way <= 1; way += 2) {
        /* at the start 160 deg apart, 20 s later 180 deg */
        attitude_plan plan = plan_of(inertial(z_axis, 0), spinning(way, way * 160), 0, 60);
        settle(&plan);
        double before[9], after[9];
        axes_at(&plan, 0, before);
        axes_at(&plan, 60, after);
        assert_near(angle_between(before, after), (360 - 220) * DEG, 1e-12);
        for (int i = 1; i <= 6500; i++) {
            axes_at(&plan, i * step_s, after);
            /* the share grows by 1/60 each second of at most 220 deg, of which at most 1 deg/s more
             */
            ck_assert_double_le(angle_between(before, after),
                                (220.0 / 60 + 1) * DEG * step_s + 1e-7);
            memcpy(before, after, sizeof before);
        }
        attitude_plan_free(&plan);
    }
}
END_TEST

/* The attitude begins at the old law and ends at the new one's, both moving. */
START_TEST(test_attitude_plan_slew_meets_both_laws)
{
    attitude_plan plan = plan_of(spinning(2, 0), inertial(x_axis, 2), 30, 45);
    settle(&plan);
    const double ends[2] = {30, 75};
    for (int k = 0; k < 2; k++) {
        double inside[9], outside[9];
        axes_at(&plan, ends[k] + (k ? -1e-9 : 1e-9), inside);
        axes_at(&plan, ends[k] + (k ? 1e-9 : -1e-9), outside);
        assert_near(angle_between(inside, outside), 0, 1e-8);
    }
    attitude_plan_free(&plan);
}
END_TEST

START_TEST(test_attitude_plan_slew_of_a_given_rate_lasts_the_angle_over_it)
{
    attitude_plan plan = plan_of(inertial(x_axis, 0), inertial(x_axis, -75 * DEG), 10, 0);
    plan.legs[1].rate_rad_s = 1.5 * DEG;
    settle(&plan);
    assert_near(plan.legs[1].slew_s, 50, 1e-12);
    attitude_plan_free(&plan);
}
END_TEST

/* Two observers see the slew begin at different moments of the law before, 40 and 60 deg from where
 * it ends: each of them sees one of its own length. */
START_TEST(test_attitude_plan_slew_begins_anew_for_every_observer)
{
    attitude_plan plan = plan_of(spinning(1, 0), inertial(z_axis, 0), 50, 0);
    const moment starts[2] = {{.t_s = 40}, {.t_s = 60, .viewer = 1}};
    plan.legs[1].rate_rad_s = 2 * DEG;
    ck_assert_int_eq(attitude_plan_settle(&plan, 1, starts, 2, NULL), GLINT_OK);
    assert_near(plan.legs[1].slew_s, 30, 1e-12);
    for (int viewer = 0; viewer < 2; viewer++) {
        const double end_s = 50 + (viewer ? 30 : 20);
        double before[9], after[9];
        const moment inside = {.t_s = end_s - 0.5, .viewer = viewer};
        const moment outside = {.t_s = end_s + 1e-9, .viewer = viewer};
        ck_assert_int_eq(attitude_plan_at(&plan, &inside, before, NULL), GLINT_OK);
        ck_assert_int_eq(attitude_plan_at(&plan, &outside, after, NULL), GLINT_OK);
        ck_assert_double_gt(angle_between(before, after), 0.5 * DEG); /* still on its way */
        assert_near(angle_between(after, (double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}), 0, 1e-12);
    }
    attitude_plan_free(&plan);
}
END_TEST

START_TEST(test_attitude_plan_wants_what_any_law_looks_at)
{
    attitude_plan plan = plan_of(inertial(x_axis, 0), spinning(1, 0), 10, 0);
    ck_assert(attitude_plan_wants(&plan, DIRECTION_NORTH));
    ck_assert(!attitude_plan_wants(&plan, DIRECTION_MOON));
    attitude_plan_free(&plan);
}
END_TEST

/* -------------------------------------------------------------------- scenarios */

#define SECOND "[[attitude]]\nlaw = \"nadir\"\n"

START_TEST(test_attitude_plan_reads_times_and_slews)
{
    glint_scenario *s =
        read_with(SOUND, PART_ATTITUDE,
                  "[[attitude]]\nfrom = -5\nlaw = \"rsw\"\n"
                  "[[attitude]]\nfrom = 2025-07-25T20:37:10Z\nslew_s = 5\nlaw = \"nadir\"\n"
                  "[[attitude]]\nfrom = 30.5\nslew_rate_deg_s = 90\nlaw = \"inertial\"\n"
                  "quaternion_wxyz = [1, 0, 0, 0]\noffset_deg = { axis = [1, 0, 0], angle = 3 }\n");
    ck_assert_int_eq(s->attitude.n, 3);
    assert_near(s->attitude.legs[1].from_s, 10, 1e-9);
    assert_near(s->attitude.legs[1].slew_s, 5, 0);
    assert_near(s->attitude.legs[2].from_s, 30.5, 0);
    /* at most half a turn */
    ck_assert_double_gt(s->attitude.legs[2].slew_s, 0);
    ck_assert_double_le(s->attitude.legs[2].slew_s, 2);
    ck_assert_int_eq(s->attitude.legs[1].n_starts, 1);
    ck_assert(s->attitude.legs[2].law.has_offset);
    glint_scenario_free(s);
    /* from rsw to nadir the turn is by 120 deg about a diagonal of the orbit's axes */
    s = read_with(SOUND, PART_ATTITUDE,
                  "[[attitude]]\nlaw = \"rsw\"\n"
                  "[[attitude]]\nfrom = 10\nslew_rate_deg_s = 60\nlaw = \"nadir\"\n");
    assert_near(s->attitude.legs[1].slew_s, 2, 1e-9);
    glint_scenario_free(s);
    /* also where it begins after the last row: passes are sought to the end */
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 60\nstep_s = 45\n";
    s = read_with(parts, PART_ATTITUDE,
                  "[[attitude]]\nlaw = \"rsw\"\n"
                  "[[attitude]]\nfrom = 50\nslew_rate_deg_s = 60\nlaw = \"nadir\"\n");
    assert_near(s->attitude.legs[1].slew_s, 2, 1e-9);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_attitude_plan_wrong_sequences_are_refused)
{
    static const wrong_text all[] = {
        {PART_ATTITUDE, "[[attitude]]\nfrom = @5\nlaw = \"nadir\"\n", "begins 5 s after the start",
         "no 'from'", 0},
        {PART_ATTITUDE, "[[attitude]]\nslew_s = @5\nlaw = \"nadir\"\n", "no law before it", NULL,
         0},
        {PART_ATTITUDE, SECOND "@[[attitude]]\nlaw = \"nadir\"\n", "no 'from'", "UTC or seconds",
         0},
        {PART_ATTITUDE,
         SECOND "[[attitude]]\nfrom = 9\nlaw = \"rsw\"\n[[attitude]]\nfrom = @9\nlaw = \"rsw\"\n",
         "times that grow", NULL, 0},
        {PART_ATTITUDE,
         SECOND "[[attitude]]\nfrom = 9\nslew_s = 3\nslew_rate_deg_s = @3\nlaw = \"rsw\"\n",
         "both slew_s and slew_rate_deg_s", "one of them", 0},
        {PART_ATTITUDE,
         SECOND "@[[attitude]]\nfrom = 9\nslew_s = 3\nlaw = \"rsw\"\n"
                "[[attitude]]\nfrom = 11\nlaw = \"rsw\"\n",
         "ends 1 s after the next law begins", NULL, 0},
        {PART_ATTITUDE, SECOND "[[attitude]]\nfrom = @\"soon\"\nlaw = \"rsw\"\n", "'soon'", NULL,
         0},
        {PART_ATTITUDE, SECOND "[[attitude]]\nfrom = 9\nslew_s = @-3\nlaw = \"rsw\"\n", "-3",
         "between 0 and", 0},
        {PART_ATTITUDE, SECOND "[[attitude]]\nfrom = 9\n@slew = 3\nlaw = \"rsw\"\n", "'slew'",
         "did you mean 'slew_s'?", 0},
        {PART_ATTITUDE, "[attitude]\n@from = 3\nlaw = \"rsw\"\n", "unknown key 'from'", NULL, 0},
        {PART_ATTITUDE, "[attitude]\nlaw = \"nadir\"\nnadir = @\"down\"\n", "\"down\"",
         "geocentric, geodetic", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

/* A table that ends before the run is in use: a warning, and the run ends with an error. */
START_TEST(test_attitude_plan_short_table_is_warned_of)
{
    write_file("short.csv", "t_s,qw,qx,qy,qz\n0,1,0,0,0\n30,1,0,0,0\n");
    const marked_text m =
        with_part(SOUND, PART_ATTITUDE, "[attitude]\nlaw = \"table\"\nfile = \"short.csv\"\n");
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(glint_scenario_read(write_file("scenario.toml", m.text), NULL, 0, &s, errors),
                     GLINT_OK);
    ck_assert_uint_eq(glint_errors_count(errors), 1);
    ck_assert_ptr_nonnull(strstr(glint_errors_get(errors, 0)->message, "nothing at 30 s"));
    glint_errors_free(errors);
    glint_scenario_free(s);
    /* not where another law takes over in time */
    s = read_with(SOUND, PART_ATTITUDE,
                  "[[attitude]]\nlaw = \"table\"\nfile = \"short.csv\"\n"
                  "[[attitude]]\nfrom = 20\nslew_s = 10\nlaw = \"nadir\"\n");
    glint_scenario_free(s);
}
END_TEST

static Suite *plan_suite(void)
{
    Suite *suite = suite_create("attitude plan");
    TCase *tests = tcase_create("attitude plan");
    tcase_add_checked_fixture(tests, folder_make, folder_remove);
    tcase_add_test(tests, test_attitude_plan_slew_between_fixed_attitudes_is_steady);
    tcase_add_test(tests, test_attitude_plan_slew_goes_the_shorter_way);
    tcase_add_test(tests, test_attitude_plan_laws_are_exact_outside_slews);
    tcase_add_test(tests, test_attitude_plan_without_a_slew_jumps);
    tcase_add_test(tests, test_attitude_plan_slew_does_not_jump_where_laws_are_opposite);
    tcase_add_test(tests, test_attitude_plan_slew_meets_both_laws);
    tcase_add_test(tests, test_attitude_plan_slew_of_a_given_rate_lasts_the_angle_over_it);
    tcase_add_test(tests, test_attitude_plan_slew_begins_anew_for_every_observer);
    tcase_add_test(tests, test_attitude_plan_wants_what_any_law_looks_at);
    tcase_add_test(tests, test_attitude_plan_reads_times_and_slews);
    tcase_add_test(tests, test_attitude_plan_wrong_sequences_are_refused);
    tcase_add_test(tests, test_attitude_plan_short_table_is_warned_of);
    suite_add_tcase(suite, tests);
    return suite;
}

int main(void)
{
    return run_suite(plan_suite());
}
