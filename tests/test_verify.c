/* Scenarios that say what they expect: values, tables, requirements; what is met, what is not, and
 * how it is counted. */
#include "scenario_text.h"

#define POINT "[photometry]\nsolar_disc = \"point\"\n"
#define PLATE                                                                                      \
    "[[component.plate]]\nsize_m = [3.1415926535897932, 1]\nnormal = [0, 0, 1]\n"                  \
    "tangent = [1, 0, 0]\nmaterial = \"white\"\n"

/* A white plate of pi m^2 seen along its normal from 1000 km, while the Sun goes down in steps of
 * 30 deg: the flux ratio is 1e-12 cos(30 deg k), 0 from the fourth row on. */
static const char *const PLATES[N_PARTS] = {
    [PART_TIME] = "[geometry]\nsweep = { phase_deg = [0, 120, 30], plane = \"xz\" }\n",
    [PART_SETTINGS] = POINT,
    [PART_MATERIAL] = "[materials.white]\nbrdf = \"lambert\"\nrho = 1\n",
    [PART_COMPONENT] = "[[component]]\nname = \"plate\"\n",
    [PART_PRIMITIVE] = PLATE,
};

/* What must come of one text of expectations: counts, and for each deviation a piece of its
 * message; the first stands at the '@'. */
typedef struct outcome {
    const char *text;
    long long expectations, deviations;
    const char *said[4];
} outcome;

static void assert_outcome(const char *const parts[N_PARTS], const outcome *o)
{
    const marked_text m = with_part(parts, PART_EXPECT, o->text);
    const char *path = write_file("scenario.toml", m.text);
    glint_errors *errors = glint_errors_new();
    glint_verdict verdict = {-1, -1, NULL};
    const glint_status status = glint_verify(path, NULL, 0, 1, &verdict, errors);
    ck_assert_msg(status == (o->said[0] ? GLINT_INPUT : GLINT_OK), "status %d of:\n%s%s", status,
                  o->text, list_errors(errors));
    ck_assert_msg(verdict.expectations == o->expectations && verdict.deviations == o->deviations,
                  "%lld of %lld not met, instead of %lld of %lld, of:\n%s%s",
                  (long long)verdict.deviations, (long long)verdict.expectations, o->deviations,
                  o->expectations, o->text, list_errors(errors));
    size_t n = 0;
    for (; n < COUNT_OF(o->said) && o->said[n]; n++)
        ck_assert_msg(has_error(errors, path, n ? 0 : m.line, m.column, o->said[n], NULL),
                      "'%s' is not said of:\n%s%s", o->said[n], o->text, list_errors(errors));
    ck_assert_msg(glint_errors_error_count(errors) == n, "%zu errors wanted:%s", n,
                  list_errors(errors));
    glint_errors_free(errors);
    glint_free(verdict.requirements);
    ck_assert_int_eq(glint_verify(path, NULL, 0, 1, NULL, NULL), status);
}

#define FLUX "column = \"flux_ratio_V\"\n"

START_TEST(test_verify_values_met)
{
    static const outcome all[] = {
        {"[[expect]]\nrow = 0\n" FLUX "value = 1e-12\nrelative = 1e-12\n", 1, 0, {NULL}},
        {"[[expect]]\nt_s = 3\n" FLUX "value = 0\ntolerance = 0\n", 1, 0, {NULL}},
        {"[[expect]]\nt_s = 1.0000005\n" FLUX "value = 1e-12\nrelative = 0.2\n", 1, 0, {NULL}},
        {"[[expect]]\nrow = 1\n" FLUX "value = 0.9e-12\ntolerance = 3.4e-14\n", 1, 0, {NULL}},
        {"[[expect]]\nrow = 1\n" FLUX "value = 0.9e-12\ntolerance = 2e-14\nrelative = 0.016\n",
         1,
         0,
         {NULL}}, /* both tolerances add: 2e-14 + 1.44e-14 */
        {"[[expect]]\nrow = 2\ncolumn = \"phase_angle_deg\"\nvalue = 60\ntolerance = 1e-12\n"
         "[[expect]]\nrow = 2\ncolumn = \"range_km\"\nvalue = 1000\ntolerance = 0\n"
         "[[expect]]\nrow = 2\ncolumn = \"sunlit_fraction\"\nvalue = 1\ntolerance = 0\n"
         "[[expect]]\nrow = 2\ncolumn = \"share_material_white\"\nvalue = 1\ntolerance = 0\n",
         4,
         0,
         {NULL}},
    };
    for (size_t k = 0; k < COUNT_OF(all); k++)
        assert_outcome(PLATES, &all[k]);
}
END_TEST

START_TEST(test_verify_values_not_met_are_all_reported)
{
    static const outcome all[] = {
        {"@[[expect]]\nrow = 1\n" FLUX "value = 0.9e-12\ntolerance = 3.3e-14\nsource = \"hand\"\n",
         1,
         1,
         {"flux_ratio_V at t_s = 1 (row 1) is 8.66025403784439e-13; expected 9e-13 within 3.3e-14, "
          "off by -3.4e-14 (hand)"}},
        {"@[[expect]]\nrow = 0\n" FLUX "value = 1.0000000001e-12\nrelative = 1e-12\n",
         1,
         1,
         {"expected 1.0000000001e-12"}},
        {"@[[expect]]\nrow = 3\ncolumn = \"mag_V\"\nvalue = 99\ntolerance = 1e9\n",
         1,
         1,
         {"mag_V at t_s = 3 (row 3) is empty; expected 99"}},
        {"@[[expect]]\nrow = 5\n" FLUX "value = 1\ntolerance = 1\n",
         1,
         1,
         {"there is no row 5; the run has 5 rows"}},
        {"@[[expect]]\nt_s = 0.5\n" FLUX "value = 1\ntolerance = 1\n",
         1,
         1,
         {"there is no row at t_s = 0.5"}},
        {"[[expect]]\nrow = 0\n" FLUX "value = 0\ntolerance = 1\n"
         "@[[expect]]\nrow = 0\n" FLUX "value = 1\ntolerance = 0\n"
         "[[expect]]\nrow = 1\n" FLUX "value = 2\ntolerance = 0\n"
         "[[expect]]\nrow = 9\n" FLUX "value = 2\ntolerance = 0\n",
         4,
         3,
         {"expected 1 within 0", "expected 2 within 0", "there is no row 9"}},
        {"@[[expect]]\nrow = 0\ncolumn = \"flux_ratio_B\"\nvalue = 0\ntolerance = 1\n",
         0,
         0,
         {"no number column 'flux_ratio_B'; did you mean 'flux_ratio_V'?"}},
        {"@[[expect]]\nrow = 0\ncolumn = \"flags\"\nvalue = 0\ntolerance = 1\n",
         0,
         0,
         {"no number column 'flags'"}},
        {"@[[expect]]\nrow = 0\ncolumn = \"elevation_deg\"\nvalue = 0\ntolerance = 1\n",
         0,
         0,
         {"no number column 'elevation_deg'"}},
    };
    for (size_t k = 0; k < COUNT_OF(all); k++)
        assert_outcome(PLATES, &all[k]);
}
END_TEST

START_TEST(test_verify_scenario_that_expects_nothing_is_an_error)
{
    const marked_text m = with_part(PLATES, PART_EXPECT, "");
    const char *path = write_file("scenario.toml", m.text);
    glint_errors *errors = glint_errors_new();
    glint_verdict verdict = {-1, -1, NULL};
    ck_assert_int_eq(glint_verify(path, NULL, 0, 1, &verdict, errors), GLINT_INPUT);
    ck_assert(has_error(errors, path, 0, 0, "nothing to verify", "[[expect]]"));
    ck_assert_int_eq(verdict.expectations, 0);
    ck_assert_int_eq(verdict.deviations, 0);
    glint_errors_clear(errors);
    ck_assert_int_eq(glint_verify(in_folder("absent"), NULL, 0, 1, &verdict, errors), GLINT_INPUT);
    ck_assert_uint_eq(glint_errors_error_count(errors), 1);
    glint_errors_free(errors);
}
END_TEST

START_TEST(test_verify_overrides_act_on_the_run_and_on_what_it_expects)
{
    const marked_text m = with_part(
        PLATES, PART_EXPECT, "[[expect]]\nrow = 0\n" FLUX "value = 1e-12\nrelative = 1e-12\n");
    const char *path = write_file("scenario.toml", m.text);
    const char *const half[] = {"materials.white.rho=0.5", "expect.0.value=5e-13"};
    ck_assert_int_eq(glint_verify(path, half, 0, 1, NULL, NULL), GLINT_OK);
    ck_assert_int_eq(glint_verify(path, half, 1, 1, NULL, NULL), GLINT_INPUT);
    ck_assert_int_eq(glint_verify(path, half, 2, 1, NULL, NULL), GLINT_OK);
}
END_TEST

/* ------------------------------------------------------------------ tables */

#define TABLE "[expect_table]\nfile = \"want.csv\"\n"

/* The table with this text must give these counts, and say this at that place of it (line 0: in the
 * scenario). */
static void assert_table(const char *settings, const char *table, long long expectations,
                         long long deviations, int line, int column, const char *said)
{
    const char *want = write_file("want.csv", table);
    char content[512];
    snprintf(content, sizeof content, TABLE "%s", settings);
    const marked_text m = with_part(PLATES, PART_EXPECT, content);
    const char *path = write_file("scenario.toml", m.text);
    glint_errors *errors = glint_errors_new();
    glint_verdict verdict;
    const glint_status status = glint_verify(path, NULL, 0, 1, &verdict, errors);
    ck_assert_msg(status == (said ? GLINT_INPUT : GLINT_OK), "%d:%s", status, list_errors(errors));
    ck_assert_msg(verdict.expectations == expectations && verdict.deviations == deviations,
                  "%lld of %lld not met:%s", (long long)verdict.deviations,
                  (long long)verdict.expectations, list_errors(errors));
    if (said)
        ck_assert_msg(has_error(errors, line ? want : path, line, column, said, NULL),
                      "'%s' is not said at %d:%d:%s", said, line, column, list_errors(errors));
    ck_assert_int_eq((long long)glint_errors_error_count(errors), deviations);
    glint_errors_free(errors);
}

#define FIVE "flux_ratio_V,note,mag_V\n1e-12,a,3.24\n8.6602540378443865e-13,b,3.3961734\n5e-13,c,"

START_TEST(test_verify_table_row_by_row)
{
    const char *const both = "relative = { flux_ratio_V = 1e-12 }\ntolerance = { mag_V = 1e-6 }\n";
    /* 3.24 = -26.76 + 30; cos 30 and 60 deg: + 0.15617342 and + 0.75257499 mag */
    assert_table(both, FIVE "3.992575\n0,d,\n0,e,\n", 10, 0, 0, 0, NULL);
    assert_table(both, FIVE "3.992578\n0,d,\n0,e,\n", 10, 1, 4, 9, "mag_V at row 2");
    assert_table(both, FIVE "\n0,d,\n0,e,\n", 10, 1, 4, 9, "expected an empty cell");
    assert_table(both, FIVE "3.992575\n0,d,50\n0,e,\n", 10, 1, 5, 5, "is empty; expected 50");
    assert_table(both, FIVE "3.992575\n1e-30,d,\n0,e,\n", 10, 1, 5, 1,
                 "flux_ratio_V at row 3 is 0");
    assert_table(both, FIVE "x\n0,d,\n0,e,\n", 10, 1, 4, 9, "'x'; expected a number or nothing");
    assert_table(both, FIVE "3.992575\n0,d,\n", 9, 1, 0, 0, "the run has 5 rows");
    assert_table(both, FIVE "3.992575\n0,d,\n0,e,\n0,f,\n", 11, 1, 0, 0,
                 "the expected table has 6");
    assert_table("tolerance = { mag_V = 1e-6 }\n", FIVE "3.992575\n7,d,\n8,e,\n", 5, 0, 0, 0, NULL);
}
END_TEST

START_TEST(test_verify_table_column_that_the_run_has_not)
{
    write_file("want.csv", "mag_B,mag_V\n1,2\n");
    const outcome o = {
        "@" TABLE "tolerance = { mag_B = 1 }\n", 0, 0, {"no number column 'mag_B'; did you mean"}};
    assert_outcome(PLATES, &o);
}
END_TEST

/* ------------------------------------------------------------------ requirements */

#define REQUIRE "[[require]]\ncolumn = \"mag_V\"\n"

/* Magnitudes: 3.24, 3.396, 3.993, and two dark rows. */
START_TEST(test_verify_requirements)
{
    static const outcome all[] = {
        {REQUIRE "fainter_than = 3.2\n", 1, 0, {NULL}},
        {"@" REQUIRE "fainter_than = 3.3\n",
         1,
         1,
         {"mag_V is fainter than required in 80 % of 5 rows; expected 100 %; it breaks its limit "
          "of "
          "3.300 most at t_s = 0 with 3.240"}},
        {REQUIRE "fainter_than = 3.3\nfor_fraction = 0.8\n", 1, 0, {NULL}},
        {"@" REQUIRE "fainter_than = 3.3\nfor_fraction = 0.81\n", 1, 1, {"80 % of 5 rows"}},
        {REQUIRE "fainter_than = 99\nfor_fraction = 0.4\n",
         1,
         0,
         {NULL}}, /* dark is faint enough */
        {REQUIRE "fainter_than = 3.3\nwhen = { phase_angle_deg = [15, 180] }\n", 1, 0, {NULL}},
        {"@" REQUIRE "fainter_than = 3.5\nwhen = { phase_angle_deg = [15, 75], t_s = [0, 1] }\n",
         1,
         1,
         {"0 % of 1 rows; expected 100 %; it breaks its limit of 3.500 most at t_s = 1 with "
          "3.396"}},
        {"@" REQUIRE "fainter_than = 1\nwhen = { t_s = [10, 20] }\n", 1, 1, {"no row fits 'when'"}},
        {REQUIRE "fainter_than = 1\nwhen = { t_s = [1, 1] }\n", 1, 0, {NULL}}, /* both ends count */
        {"@" REQUIRE "fainter_than = 3.3\nwhen = { mag_V = [0, 99] }\n",
         1,
         1,
         {"of 3 rows"}}, /* an empty cell is in no range */
        {REQUIRE "fainter_than = 1\nwhen = {}\n", 1, 0, {NULL}},
        {REQUIRE "fainter_than = 1\nwhen = { @flags = [0, 1] }\n", 0, 0, {"column 'flags'"}},
        {"@[[require]]\ncolumn = \"mag_R\"\nfainter_than = 1\n", 0, 0, {"column 'mag_R'"}},
        {"[[expect]]\nrow = 0\n" FLUX "value = 1e-12\nrelative = 1e-12\n@" REQUIRE
         "fainter_than = 4\n" REQUIRE "fainter_than = 3\n",
         3,
         1,
         {"40 % of 5 rows"}},
    };
    for (size_t k = 0; k < COUNT_OF(all); k++)
        assert_outcome(PLATES, &all[k]);
}
END_TEST

/* Beside the white plate a grey one of three quarters of its brightness, 3/7 of the light; only the
 * white one's component has a back. The moment of a run in time is a date. */
START_TEST(test_verify_broken_requirement_names_the_surface_and_the_date)
{
    static const char grey[] = "[materials.grey]\nbrdf = \"lambert\"\nrho = 0.75\n"
                               "[[component]]\nname = \"wing\"\n[[component.plate]]\n"
                               "size_m = [3.1415926535897932, 1]\ncentre_m = [0, 9, 0]\n"
                               "normal = [0, 0, 1]\ntangent = [1, 0, 0]\nmaterial = \"grey\"\n";
    char text[1024];
    snprintf(text, sizeof text, "@" REQUIRE "fainter_than = 3\n%s", grey);
    const outcome plates = {
        text,
        1,
        1,
        {"most at t_s = 0 with 2.632; 57 % of its light in V comes from plate/white/+z"}};
    assert_outcome(PLATES, &plates);
    const outcome box = {"@" REQUIRE "fainter_than = 20\nwhen = { t_s = [30, 30] }\n",
                         1,
                         1,
                         {
                             "most at 2025-07-25T20:37:30Z with ",
                         }};
    assert_outcome(SOUND, &box);
    const outcome surface = {"@" REQUIRE "fainter_than = 20\nwhen = { t_s = [30, 30] }\n",
                             1,
                             1,
                             {"of its light in V comes from bus/white/"}};
    assert_outcome(SOUND, &surface);
}
END_TEST

/* The limit is meant for a satellite at the reference height: another may be brighter by
 * 2.5 log10(h / reference). At 780 km over the equator, h is 780 km to 1 m at the nodes. */
START_TEST(test_verify_requirement_at_a_reference_height)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_OBSERVER] = "[observer]\nlatitude_deg = 0\nlongitude_deg = 0\nmin_elevation_deg = "
                           "-90\n";
    parts[PART_TIME] = "[time]\nstart = 2025-03-20T12:00:00Z\nduration_s = 0\nstep_s = 1\n";
    parts[PART_ORBIT] = "[orbit]\ncircular = { height_km = 780, inclination_deg = 0, raan_deg = 0, "
                        "argument_of_latitude_deg = 0 }\n";
    glint_scenario *s = read_with(parts, PART_EXPECT, "");
    glint_curve *curve;
    const glint_row *rows;
    size_t n;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
    ck_assert_uint_eq(n, 1);
    ck_assert_double_gt(rows[0].flux_ratio[0], 0);
    const double mag = rows[0].magnitude[0], shift = 2.5 * log10(780.0 / 550.0);
    glint_curve_close(curve);
    glint_scenario_free(s);
    for (int k = 0; k < 2; k++) {
        char content[256];
        snprintf(content, sizeof content,
                 "%s" REQUIRE "fainter_than = %.9f\nreference_height_km = 550\n", k ? "@" : "",
                 mag - shift + (k ? 1e-5 : -1e-5)); /* 1e-5 mag: 4 m of height */
        const outcome o = {content, 1, k, {k ? "0 % of 1 rows" : NULL}};
        assert_outcome(parts, &o);
    }
}
END_TEST

START_TEST(test_verify_requirement_says_its_margin)
{
    /* Magnitudes 3.24, 3.39617342, 3.99257499, and two rows that are dark. */
    static const struct {
        const char *limit;
        glint_status status;
        const char *said;
    } cases[] = {
        {"fainter_than = 3\n", GLINT_OK,
         "mag_V fainter than 3 in 100 % of 5 rows, required 100 %; margin +0.240 mag\n"},
        {"fainter_than = 3.3\nfor_fraction = 0.8\n", GLINT_OK,
         "mag_V fainter than 3.3 in 80 % of 5 rows, required 80 %; margin +0.096 mag\n"},
        {"fainter_than = 4\nfor_fraction = 0.5\n", GLINT_INPUT,
         "mag_V fainter than 4 in 40 % of 5 rows, required 50 %; margin -0.007 mag\n"},
        {"fainter_than = 4\nfor_fraction = 0.4\n", GLINT_OK,
         "mag_V fainter than 4 in 40 % of 5 rows, required 40 %; any brightness would do\n"},
        {"fainter_than = 4\nwhen = { mag_V = [3.9, 4] }\nfor_fraction = 0\n", GLINT_OK,
         "mag_V fainter than 4 in 0 % of 1 rows, required 0 %; any brightness would do\n"},
        {"fainter_than = 4\nwhen = { mag_V = [8, 9] }\n", GLINT_INPUT, NULL},
    };
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        char content[256];
        snprintf(content, sizeof content, "[[require]]\ncolumn = \"mag_V\"\n%s", cases[k].limit);
        const marked_text m = with_part(PLATES, PART_EXPECT, content);
        glint_verdict verdict;
        ck_assert_int_eq(
            glint_verify(write_file("scenario.toml", m.text), NULL, 0, 1, &verdict, NULL),
            cases[k].status);
        ck_assert_pstr_eq(verdict.requirements, cases[k].said);
        glint_free(verdict.requirements);
    }
}
END_TEST

START_TEST(test_verify_expected_table_without_its_last_line_end_lacks_that_row)
{
    /* cut within the last number, "0.5" of "0.5e-12" would pass as another value */
    assert_table("tolerance = { flux_ratio_V = 1 }\n", "flux_ratio_V\n1e-12\n9e-13\n5e-13\n0\n0", 5,
                 1, 0, 0, "the expected table has 4");
}
END_TEST

static Suite *verify_suite(void)
{
    Suite *suite = suite_create("verify");
    TCase *all = tcase_create("verify");
    tcase_set_timeout(all, 60);
    tcase_add_checked_fixture(all, folder_make, folder_remove);
    tcase_add_test(all, test_verify_values_met);
    tcase_add_test(all, test_verify_values_not_met_are_all_reported);
    tcase_add_test(all, test_verify_scenario_that_expects_nothing_is_an_error);
    tcase_add_test(all, test_verify_overrides_act_on_the_run_and_on_what_it_expects);
    tcase_add_test(all, test_verify_table_row_by_row);
    tcase_add_test(all, test_verify_table_column_that_the_run_has_not);
    tcase_add_test(all, test_verify_requirements);
    tcase_add_test(all, test_verify_broken_requirement_names_the_surface_and_the_date);
    tcase_add_test(all, test_verify_requirement_at_a_reference_height);
    tcase_add_test(all, test_verify_requirement_says_its_margin);
    tcase_add_test(all, test_verify_expected_table_without_its_last_line_end_lacks_that_row);
    suite_add_tcase(suite, all);
    return suite;
}

int main(void)
{
    return run_suite(verify_suite());
}
