/* Runs say where measured materials are used outside of their measurements. */
#include "base/constants.h"
#include "scenario_text.h"

/* Scans at 20 and 40 deg from -50 to 50 deg. In the angles of the half vector theta_h + theta_d is
 * the larger zenith angle: what is beyond 50 deg is surely not covered, and theta_i = theta_r up to
 * 40 deg is. */
static void write_rows(void)
{
    char rows[4096] = "theta_i,theta_r,f\n";
    for (int theta_i = 20; theta_i <= 40; theta_i += 20)
        for (int theta_r = -50; theta_r <= 50; theta_r += 5) {
            const size_t n = strlen(rows);
            snprintf(rows + n, sizeof rows - n, "%d,%d,0.2\n", theta_i, theta_r);
        }
    write_file("rows.csv", rows);
}

#define PLATE                                                                                      \
    "[[component]]\nname = \"c\"\n[[component.plate]]\nsize_m = [1, 1]\nnormal = [0, 0, 1]\n"      \
    "tangent = [1, 0, 0]\nmaterial = \"panel\"\nback_material = \"paint\"\n"                       \
    "[materials.panel]\nbrdf = \"table\"\nfile = \"rows.csv\"\nsigned_zenith = true\n"             \
    "[materials.paint]\nbrdf = \"lambert\"\nrho = 0.5\n"

/* The scenario of a plate whose directions are those of n pairs of zenith angles, deg, in the plane
 * xz; angles past 90 deg are below the plate. */
static glint_scenario *read_plate(const double (*pairs)[2], int n, const char *settings)
{
    static char table[1 << 20], text[4096];
    size_t used = (size_t)snprintf(table, sizeof table, "sun_x,sun_y,sun_z,obs_x,obs_y,obs_z\n");
    for (int k = 0; k < n; k++) {
        const double i = pairs[k][0] * DEG, r = pairs[k][1] * DEG;
        used += (size_t)snprintf(table + used, sizeof table - used, "%.17g,0,%.17g,%.17g,0,%.17g\n",
                                 -sin(i), cos(i), sin(r), cos(r));
    }
    write_rows();
    write_file("directions.csv", table);
    snprintf(text, sizeof text, "[geometry]\ntable = \"directions.csv\"\nrange_km = 1000\n%s%s",
             settings, PLATE);
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    ck_assert_msg(glint_scenario_read(write_file("scenario.toml", text), NULL, 0, &s, errors) ==
                      GLINT_OK,
                  "%s", list_errors(errors));
    glint_errors_free(errors);
    return s;
}

/* Runs it, and returns the number of rows in which the panel was not measured; *name is as said. */
static int64_t count_unmeasured(const glint_scenario *s, int threads, int64_t *n_rows)
{
    glint_curve *curve;
    const glint_row *rows;
    size_t n;
    int64_t found;
    const char *name;
    *n_rows = 0;
    ck_assert_int_eq(glint_curve_open(s, threads, &curve, NULL), GLINT_OK);
    do {
        ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
        *n_rows += (int64_t)n;
    } while (n > 0);
    ck_assert(glint_curve_unmeasured(curve, 0, &name, &found));
    ck_assert_str_eq(name, "panel");
    ck_assert(!glint_curve_unmeasured(curve, 1, &name, &found));
    glint_curve_close(curve);
    return found;
}

START_TEST(test_curve_counts_rows_that_were_not_measured)
{
    static const double pairs[][2] = {
        {20, 20},  {40, 40},   {30, 30}, /* covered */
        {60, 10},  {10, 60},   {80, 80}, /* not */
        {120, 20}, {120, 120},           /* the panel is dark */
    };
    int64_t n_rows;
    glint_scenario *s = read_plate(pairs, 8, "");
    ck_assert_int_eq(count_unmeasured(s, 1, &n_rows), 3);
    ck_assert_int_eq(n_rows, 8);
    glint_scenario_free(s);
    s = read_plate(pairs, 3, "[photometry]\nbands = [\"B\", \"V\"]\n");
    ck_assert_int_eq(count_unmeasured(s, 1, &n_rows), 0);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_curve_counts_the_same_on_any_number_of_threads)
{
    enum { MANY = 5000 };
    static double pairs[MANY][2];
    int beyond = 0;
    for (int k = 0; k < MANY; k++) {
        const bool covered = k % 7 < 3;
        pairs[k][0] = covered ? 5.0 * (k % 7) + 20 : 55 + k % 30;
        pairs[k][1] = covered ? pairs[k][0] : -70 + k % 140;
        beyond += !covered;
    }
    glint_scenario *s = read_plate((const double(*)[2])pairs, MANY, "");
    for (int threads = 1; threads <= 4; threads++) {
        int64_t n_rows;
        ck_assert_int_eq(count_unmeasured(s, threads, &n_rows), beyond);
        ck_assert_int_eq(n_rows, MANY);
    }
    glint_scenario_free(s);
}
END_TEST

/* A scenario without measured materials has nothing to say; the header tells of those there are. */
START_TEST(test_curve_header_tells_what_was_measured)
{
    static const double pair[][2] = {{20, 20}};
    glint_scenario *s = read_plate(pair, 1, "");
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    const char *key, *value;
    int n_measured = 0;
    for (size_t k = 0; glint_curve_fact(curve, k, &key, &value); k++) {
        if (strcmp(key, "measured") != 0) continue;
        n_measured++;
        ck_assert_msg(strstr(value, "material panel in V: 42 rows of the plane of incidence") &&
                          strstr(value, "elsewhere the nearest values hold"),
                      "%s", value);
    }
    ck_assert_int_eq(n_measured, 1);
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("coverage");
    TCase *tests = tcase_create("measured materials");
    tcase_add_checked_fixture(tests, folder_make, folder_remove);
    tcase_add_test(tests, test_curve_counts_rows_that_were_not_measured);
    tcase_add_test(tests, test_curve_counts_the_same_on_any_number_of_threads);
    tcase_add_test(tests, test_curve_header_tells_what_was_measured);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
