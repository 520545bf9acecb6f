/* Hinges: how far a component turns, and which way. */
#include "base/constants.h"
#include "base/vec.h"
#include "orbit/hinge.h"
#include "scenario_text.h"
#include "table.h"

/* Rounding of a few operations on numbers of size 1. */
static const double rounding = 1e-14;

static hinge hinge_about(double x, double y, double z, hinge_drive drive)
{
    hinge h = {.drive = drive};
    unit3((const double[3]){x, y, z}, h.axis);
    return h;
}

static hinge tracking(double x, double y, double z, const double face[3])
{
    hinge h = hinge_about(x, y, z, HINGE_TRACK);
    glint_error error = {0};
    ck_assert_msg(hinge_set_face(&h, face, PLACE_NONE, &error) == GLINT_OK, "%s", error.message);
    return h;
}

static double angle_at(const hinge *h, double t_s, const double target_parent[3])
{
    double angle;
    glint_error error = {0};
    ck_assert_msg(hinge_angle(h, t_s, target_parent, &angle, &error) == GLINT_OK, "%s",
                  error.message);
    return angle;
}

static void assert_vec_near(const double got[3], double x, double y, double z, double tol)
{
    assert_near(got[0], x, tol);
    assert_near(got[1], y, tol);
    assert_near(got[2], z, tol);
}

static const double x_axis[3] = {1, 0, 0}, y_axis[3] = {0, 1, 0}, z_axis[3] = {0, 0, 1};

/* Turned right-handed about y by 90 deg, the component's z lies along the parent's x. */
START_TEST(test_hinge_matrix_quarter_turn)
{
    const hinge h = hinge_about(0, 1, 0, HINGE_FIXED);
    double component_parent[9], out[3];
    hinge_matrix(&h, 90 * DEG, component_parent);
    mat_vec(component_parent, x_axis, out);
    assert_vec_near(out, 0, 0, 1, rounding);
    mat_vec(component_parent, z_axis, out);
    assert_vec_near(out, -1, 0, 0, rounding);
    mat_vec(component_parent, y_axis, out);
    assert_vec_near(out, 0, 1, 0, rounding);
    hinge_matrix(&h, 0, component_parent);
    mat_vec(component_parent, x_axis, out);
    assert_vec_near(out, 1, 0, 0, 0);
}
END_TEST

/* A third of a turn about the diagonal brings x to y, y to z, z to x: components move the other
 * way. */
START_TEST(test_hinge_matrix_third_turn_about_the_diagonal)
{
    const hinge h = hinge_about(1, 1, 1, HINGE_FIXED);
    const double v[3] = {3, 5, 7};
    double component_parent[9], out[3];
    hinge_matrix(&h, 120 * DEG, component_parent);
    mat_vec(component_parent, v, out);
    assert_vec_near(out, 5, 7, 3, 10 * rounding);
}
END_TEST

START_TEST(test_hinge_angle_fixed_with_offset)
{
    hinge h = hinge_about(0, 1, 0, HINGE_FIXED);
    h.angle = 0.7;
    assert_near(angle_at(&h, 0, NULL), 0.7, 0);
    assert_near(angle_at(&h, 1e4, NULL), 0.7, 0);
    h.offset = 0.2;
    assert_near(angle_at(&h, 1e4, NULL), 0.9, rounding);
}
END_TEST

START_TEST(test_hinge_angle_rate_from_its_epoch)
{
    hinge h = hinge_about(0, 1, 0, HINGE_RATE);
    h.angle = 0.5, h.rate_rad_s = -0.01, h.epoch_s = 60;
    assert_near(angle_at(&h, 60, NULL), 0.5, 0);
    assert_near(angle_at(&h, 0, NULL), 1.1, rounding);
    assert_near(angle_at(&h, 260, NULL), -1.5, rounding);
    h.offset = 1.0;
    assert_near(angle_at(&h, 260, NULL), -0.5, rounding);
    h.has_limits = true, h.limits[0] = -1, h.limits[1] = 0.25;
    assert_near(angle_at(&h, 60, NULL), 0.25, 0);
    assert_near(angle_at(&h, 260, NULL), -0.5, rounding);
    assert_near(angle_at(&h, 1e3, NULL), -1, 0);
}
END_TEST

/* With the axis y and the face z, a target at angle p from z towards x asks for p. */
START_TEST(test_hinge_angle_track_closed_form)
{
    const hinge h = tracking(0, 1, 0, z_axis);
    for (int p = -179; p <= 180; p++) {
        const double target[3] = {0.6 * sin(p * DEG), 0.8, 0.6 * cos(p * DEG)};
        assert_near(angle_at(&h, 0, target), p * DEG, rounding);
    }
}
END_TEST

/* The drive first, then the offset, then the limits: 40 + 10 stops at 45, where the other order
 * would give 50. */
START_TEST(test_hinge_angle_order_is_drive_offset_limits)
{
    hinge h = tracking(0, 1, 0, z_axis);
    h.offset = 10 * DEG;
    h.has_limits = true, h.limits[0] = -45 * DEG, h.limits[1] = 45 * DEG;
    const double towards_x[3] = {sin(40 * DEG), 0, cos(40 * DEG)};
    const double away[3] = {-sin(80 * DEG), 0, cos(80 * DEG)};
    const double between[3] = {sin(20 * DEG), 0, cos(20 * DEG)};
    assert_near(angle_at(&h, 0, towards_x), 45 * DEG, 0);
    assert_near(angle_at(&h, 0, away), -45 * DEG, 0);
    assert_near(angle_at(&h, 0, between), 30 * DEG, rounding);
}
END_TEST

/* Along the axis no angle is better than another: 0, then the offset and the limits as ever. */
START_TEST(test_hinge_angle_track_along_the_axis)
{
    const double minus_z[3] = {0, 0, -1};
    hinge h = tracking(0, 1, 0, minus_z);
    for (int sign = -1; sign <= 1; sign += 2) {
        const double along[3] = {0, sign, 0}, nearly[3] = {0, sign, 0.9e-9};
        const double apart[3] = {0, sign, 1.1e-9};
        h.offset = 0;
        assert_near(angle_at(&h, 0, along), 0, 0);
        assert_near(angle_at(&h, 0, nearly), 0, 0);
        assert_near(fabs(angle_at(&h, 0, apart)), PI, rounding);
        h.offset = 0.1;
        assert_near(angle_at(&h, 0, along), 0.1, 0);
    }
}
END_TEST

/* Turned by its angle the face is as near to the target as the hinge allows. */
START_TEST(test_hinge_angle_track_is_best)
{
    for (int i = 0; i < 60; i++) {
        const double face[3] = {cos(i), sin(2.0 * i), cos(3.0 * i + 1)};
        double target[3] = {sin(5.0 * i), cos(7.0 * i), sin(11.0 * i + 2)};
        const hinge h = tracking(sin(13.0 * i), cos(17.0 * i), sin(19.0 * i + 3), face);
        unit3(target, target);
        double component_parent[9], target_component[3], unit_face[3];
        unit3(face, unit_face);
        const double angle = angle_at(&h, 0, target);
        hinge_matrix(&h, angle, component_parent);
        mat_vec(component_parent, target, target_component);
        const double best = dot3(target_component, unit_face);
        assert_near(dot3(target_component, h.axis), dot3(target, h.axis), rounding);
        for (int k = 1; k < 72; k++) {
            hinge_matrix(&h, angle + k * 5 * DEG, component_parent);
            mat_vec(component_parent, target, target_component);
            ck_assert_double_lt(dot3(target_component, unit_face), best);
        }
    }
}
END_TEST

/* The part of `face` along the axis cannot be turned and is taken off. */
START_TEST(test_hinge_set_face_takes_the_normal_part)
{
    const double face[3] = {0, -40, 3};
    const hinge h = tracking(0, 1, 0, face);
    assert_vec_near(h.face, 0, 0, 1, rounding);
}
END_TEST

START_TEST(test_hinge_set_face_without_a_normal_part_is_refused)
{
    hinge h = hinge_about(0, 1, 0, HINGE_TRACK);
    const place where = {"model.toml", 7, 3};
    const double zero[3] = {0, 0, 0}, along[3] = {0, -5, 4e-9}, apart[3] = {0, -5, 6e-9};
    const double nan[3] = {0, NAN, 1};
    glint_error error;
    ck_assert_int_eq(hinge_set_face(&h, zero, where, &error), GLINT_INPUT);
    ck_assert_str_eq(error.file, "model.toml");
    ck_assert_int_eq(error.line, 7);
    ck_assert_ptr_nonnull(strstr(error.message, "zero"));
    ck_assert_int_eq(hinge_set_face(&h, along, where, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "parallel"));
    ck_assert_int_eq(hinge_set_face(&h, nan, where, NULL), GLINT_INPUT);
    ck_assert_int_eq(hinge_set_face(&h, apart, where, &error), GLINT_OK);
}
END_TEST

/* An array with the axis +y and the face -z that follows the Sun: its angle, where its normal then
 * lies in the body, and the cosine that is left between normal and Sun. */
static void check_golden_array(const char *path)
{
    const double minus_z[3] = {0, 0, -1};
    const hinge h = tracking(0, 1, 0, minus_z);
    csv_table t = table_open(path);
    for (long row = 0; row < t.n_rows; row++) {
        double sun_body[3], component_body[9], normal_body[3], want[3];
        table_vector(&t, row, "sunB_", "", sun_body);
        const double angle = angle_at(&h, 0, sun_body);
        assert_near(angle, table_number(&t, row, "delta_rad"), 1e-9);
        hinge_matrix(&h, angle, component_body);
        mat_tvec(component_body, minus_z, normal_body);
        table_vector(&t, row, "nB_", "", want);
        assert_vec_near(normal_body, want[0], want[1], want[2], 1e-9);
        assert_near(dot3(normal_body, sun_body), table_number(&t, row, "cos_inc"), 1e-9);
    }
    csv_free(&t);
}

START_TEST(test_hinge_angle_track_matches_reference)
{
    table_check(check_golden_array, "orbit/attitude_lvlh_array.csv");
}
END_TEST

/* ---------------------------------------------------------------------- chains */

static double random_number(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(int64_t)(*state >> 11) / 4503599627370496.0 - 1.0;
}

static void random_axis(uint64_t *state, double out[3])
{
    double v[3];
    do {
        for (int i = 0; i < 3; i++)
            v[i] = random_number(state);
    } while (norm3(v) > 1 || norm3(v) < 0.1);
    unit3(v, out);
}

/* How well the face looks at a direction in the parent's axes, with the hinge at an angle. */
static double facing(const hinge *h, double angle, const double target_parent[3])
{
    double component_parent[9], seen[3];
    hinge_matrix(h, angle, component_parent);
    mat_vec(component_parent, target_parent, seen);
    return dot3(seen, h->face);
}

/* Each hinge of a chain of two, the outer one on what the inner one has turned to, is at the best
 * of all angles that its limits allow, searched for in steps of 0.01 deg. */
START_TEST(test_hinge_angle_track_is_best_in_a_chain_within_limits)
{
    enum { STEPS = 36000 };
    uint64_t state = 5;
    for (int round = 0; round < 12; round++) {
        double target[3], parent[3];
        random_axis(&state, target);
        copy3(target, parent);
        for (int deep = 0; deep < 2; deep++) {
            double axis[3], face[3], matrix[9];
            random_axis(&state, axis);
            random_axis(&state, face);
            hinge h = tracking(axis[0], axis[1], axis[2], face);
            h.has_limits = round % 3 > 0;
            h.limits[1] = (100 + 70 * random_number(&state)) * DEG;
            h.limits[0] = -h.limits[1];
            const double angle = angle_at(&h, 0, parent), got = facing(&h, angle, parent);
            double best = -2;
            for (int k = -STEPS / 2; k <= STEPS / 2; k++) {
                const double at = k * TWO_PI / STEPS;
                if (!h.has_limits || fabs(at) <= h.limits[1])
                    best = fmax(best, facing(&h, at, parent));
            }
            ck_assert(!h.has_limits || fabs(angle) <= h.limits[1]);
            ck_assert_double_ge(got, best - rounding);
            /* near a limit the search may stop a step short: 0.01 deg is 1.8e-4 */
            ck_assert_double_le(got, best + 1.8e-4);
            hinge_matrix(&h, angle, matrix);
            mat_vec(matrix, parent, parent);
        }
    }
}
END_TEST

/* The offset is added to the angle that looks best. */
START_TEST(test_hinge_angle_track_offset_turns_on_from_the_best)
{
    const double face[3] = {0, 0, 1}, target[3] = {sin(0.3), 0, cos(0.3)};
    hinge h = tracking(0, 1, 0, face);
    h.offset = -0.5;
    assert_near(angle_at(&h, 0, target), -0.2, rounding);
}
END_TEST

/* ---------------------------------------------------------------------- tables */

static const char ANGLES[] = "# a drive\nt_s,angle_deg\n0,10\n10,30\n20,350\n40,10\n";

static glint_status read_angles(const char *content, bool shortest_way, hinge *h,
                                glint_errors *errors)
{
    *h = hinge_about(0, 1, 0, HINGE_TABLE);
    return hinge_set_table(h, write_file("angles.csv", content), shortest_way, NULL, PLACE_NONE,
                           errors);
}

START_TEST(test_hinge_table_goes_straight_between_its_rows)
{
    hinge h;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(read_angles(ANGLES, false, &h, errors), GLINT_OK);
    assert_near(angle_at(&h, 0, NULL), 10 * DEG, rounding);
    assert_near(angle_at(&h, 5, NULL), 20 * DEG, rounding);
    assert_near(angle_at(&h, 10, NULL), 30 * DEG, rounding);
    assert_near(angle_at(&h, 15, NULL), 190 * DEG, rounding);
    assert_near(angle_at(&h, 30, NULL), 180 * DEG, rounding);
    assert_near(angle_at(&h, 40, NULL), 10 * DEG, rounding);
    /* drawn out backwards by the time that light takes */
    assert_near(angle_at(&h, -0.2, NULL), 9.6 * DEG, rounding);
    /* a step of more than half a turn is named */
    ck_assert_uint_eq(glint_errors_count(errors), 1);
    ck_assert_int_eq(glint_errors_get(errors, 0)->line, 6);
    ck_assert_ptr_nonnull(strstr(glint_errors_get(errors, 0)->message, "shortest_way"));
    h.offset = 5 * DEG;
    h.has_limits = true;
    h.limits[0] = 0, h.limits[1] = 1;
    assert_near(angle_at(&h, 5, NULL), 25 * DEG, rounding);
    assert_near(angle_at(&h, 30, NULL), 1, 0);
    hinge_free(&h);
    glint_errors_free(errors);
}
END_TEST

START_TEST(test_hinge_table_shortest_way_unwinds_full_turns)
{
    hinge h;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(read_angles(ANGLES, true, &h, errors), GLINT_OK);
    ck_assert_uint_eq(glint_errors_count(errors), 0);
    assert_near(angle_at(&h, 15, NULL), 10 * DEG, rounding);
    assert_near(angle_at(&h, 20, NULL), -10 * DEG, rounding);
    assert_near(angle_at(&h, 30, NULL), 0, rounding);
    hinge_free(&h);
    glint_errors_free(errors);
}
END_TEST

START_TEST(test_hinge_table_says_nothing_outside_its_times)
{
    static const double outside_s[] = {-0.31, 40.001, NAN};
    hinge h;
    ck_assert_int_eq(read_angles(ANGLES, true, &h, NULL), GLINT_OK);
    for (size_t k = 0; k < COUNT_OF(outside_s); k++) {
        double angle;
        glint_error error;
        ck_assert_int_eq(hinge_angle(&h, outside_s[k], NULL, &angle, &error), GLINT_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, "from 0 to 40 s"));
    }
    hinge_free(&h);
}
END_TEST

START_TEST(test_hinge_table_reads_dates)
{
    run_clock clock;
    const utc_time start = {.year = 2025, .month = 7, .day = 24};
    run_clock_start(&start, 60, 0, &clock);
    hinge h = hinge_about(0, 1, 0, HINGE_TABLE);
    const char *path =
        write_file("dates.csv", "utc,angle_deg\n2025-07-24T00:00:00Z,0\n2025-07-24T00:00:10Z,90\n");
    ck_assert_int_eq(hinge_set_table(&h, path, false, &clock, PLACE_NONE, NULL), GLINT_OK);
    assert_near(angle_at(&h, 5, NULL), 45 * DEG, 1e-11);
    hinge_free(&h);
    /* a run without dates cannot tell */
    ck_assert_int_eq(hinge_set_table(&h, path, false, NULL, PLACE_NONE, NULL), GLINT_INPUT);
}
END_TEST

START_TEST(test_hinge_table_wrong_files_are_refused)
{
    static const struct {
        const char *content, *found;
        int line;
    } all[] = {{"t_s,angle\n0,1\n", "no column 'angle_deg'", 1},
               {"angle_deg\n1\n", "t_s and utc", 1},
               {"t_s,utc,angle_deg\n0,2025-01-01,1\n", "both of the columns", 1},
               {"t_s,angle_deg\n0,1\n0,2\n", "times that grow", 3},
               {"t_s,angle_deg\n0,1\n1,up\n", "'up'", 3},
               {"t_s,angle_deg\n0,1\n1,1e300\n", "1e+300", 3},
               {"t_s,angle_deg\nnan,1\n", "'nan'", 2},
               {"t_s,angle_deg\n", "no rows", 0}};
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        hinge h;
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(read_angles(all[k].content, false, &h, errors), GLINT_INPUT);
        ck_assert_msg(has_error(errors, in_folder("angles.csv"), 0, 0, all[k].found, NULL),
                      "wanted '%s'; got:%s", all[k].found, list_errors(errors));
        ck_assert_int_eq(glint_errors_get(errors, 0)->line, all[k].line);
        glint_errors_free(errors);
    }
}
END_TEST

/* What is left of a cut file is whole rows, or an error. */
START_TEST(test_hinge_table_cut_anywhere_gives_whole_rows_or_an_error)
{
    hinge whole;
    ck_assert_int_eq(read_angles(ANGLES, false, &whole, NULL), GLINT_OK);
    for (size_t n = 0; n < strlen(ANGLES); n++) {
        hinge h = hinge_about(0, 1, 0, HINGE_TABLE);
        const char *path = write_bytes("angles.csv", ANGLES, n);
        if (hinge_set_table(&h, path, false, NULL, PLACE_NONE, NULL)) continue;
        ck_assert_int_lt(h.table.n, whole.table.n);
        for (long k = 0; k < h.table.n; k++) {
            assert_near(h.table.t_s[k], whole.table.t_s[k], 0);
            assert_near(h.table.angle[k], whole.table.angle[k], 0);
        }
        hinge_free(&h);
    }
    hinge_free(&whole);
}
END_TEST

static Suite *hinge_suite(void)
{
    Suite *suite = suite_create("hinge");
    TCase *tests = tcase_create("hinge");
    tcase_add_checked_fixture(tests, folder_make, folder_remove);
    tcase_add_test(tests, test_hinge_matrix_quarter_turn);
    tcase_add_test(tests, test_hinge_matrix_third_turn_about_the_diagonal);
    tcase_add_test(tests, test_hinge_angle_fixed_with_offset);
    tcase_add_test(tests, test_hinge_angle_rate_from_its_epoch);
    tcase_add_test(tests, test_hinge_angle_track_closed_form);
    tcase_add_test(tests, test_hinge_angle_order_is_drive_offset_limits);
    tcase_add_test(tests, test_hinge_angle_track_along_the_axis);
    tcase_add_test(tests, test_hinge_angle_track_is_best);
    tcase_add_test(tests, test_hinge_set_face_takes_the_normal_part);
    tcase_add_test(tests, test_hinge_set_face_without_a_normal_part_is_refused);
    tcase_add_test(tests, test_hinge_angle_track_matches_reference);
    tcase_add_test(tests, test_hinge_angle_track_is_best_in_a_chain_within_limits);
    tcase_add_test(tests, test_hinge_angle_track_offset_turns_on_from_the_best);
    tcase_add_test(tests, test_hinge_table_goes_straight_between_its_rows);
    tcase_add_test(tests, test_hinge_table_shortest_way_unwinds_full_turns);
    tcase_add_test(tests, test_hinge_table_says_nothing_outside_its_times);
    tcase_add_test(tests, test_hinge_table_reads_dates);
    tcase_add_test(tests, test_hinge_table_wrong_files_are_refused);
    tcase_add_test(tests, test_hinge_table_cut_anywhere_gives_whole_rows_or_an_error);
    suite_add_tcase(suite, tests);
    return suite;
}

int main(void)
{
    return run_suite(hinge_suite());
}
