/* Interpolated shadows and those by rays in whole runs, against exact ones. */
#include "facets/visibility.h"
#include "scenario_text.h"

#include <math.h>

/* The bodies of data/shadows on a turntable: 3600 rows in steps of 0.1 deg. */
static const char *const BODIES[] = {TEST_DATA_DIR "/shadows/box-wing.toml",
                                     TEST_DATA_DIR "/shadows/station.toml",
                                     TEST_DATA_DIR "/shadows/nook.toml"};
enum { ROWS = 3600 };

/* Flux ratios of the first rows of a run, the others 0; step: of the turntable, "0.1" or longer;
 * way: of shadows; key: one that goes with it, or NULL. */
static double *fluxes(const char *path, const char *step, const char *way, const char *key,
                      int threads)
{
    char turn[64];
    snprintf(turn, sizeof turn, "geometry.rotate.step_deg=%s", step);
    const char *const set[] = {turn, way, key};
    glint_scenario *s = read_sound_set(path, set, key ? 3 : 2);
    double *out = calloc(ROWS, sizeof *out);
    glint_curve *curve;
    size_t n_all = 0;
    ck_assert_int_eq(glint_curve_open(s, threads, &curve, NULL), GLINT_OK);
    for (size_t n = 1; n > 0;) {
        const glint_row *rows;
        ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
        for (size_t k = 0; k < n; k++)
            out[n_all++] = rows[k].flux_ratio[0];
    }
    ck_assert_uint_eq(n_all, (size_t)lround(360 / atof(step)));
    glint_curve_close(curve);
    glint_scenario_free(s);
    return out;
}

static const char EXACT[] = "satellite.self_shadows=\"exact\"";
static const char INTERPOLATED[] = "satellite.self_shadows=\"interpolated\"";
static const char RAYS[] = "satellite.self_shadows=\"rays\"";

/* Differences as fractions of the mean flux over the rows that are not dark. */
typedef struct deviation {
    double rms, most;
} deviation;

static deviation compare(const double *got, const double *exact)
{
    deviation out = {0, 0};
    double mean = 0;
    int n = 0;
    for (int k = 0; k < ROWS; k++)
        n += exact[k] > 0;
    for (int k = 0; k < ROWS; k++)
        mean += exact[k] / n;
    for (int k = 0; k < ROWS; k++) {
        const double off = fabs(got[k] - exact[k]) / mean;
        ck_assert(isfinite(off));
        out.rms += off * off / n;
        out.most = fmax(out.most, off);
    }
    out.rms = sqrt(out.rms);
    return out;
}

static deviation deviation_of(const char *path, const char *step, const char *way, const char *key)
{
    double *exact = fluxes(path, step, EXACT, NULL, 1), *got = fluxes(path, step, way, key, 1);
    const deviation out = compare(got, exact);
    free(exact);
    free(got);
    return out;
}

/* At the usual step: what docs/physics.md says. */
START_TEST(test_shadows_interpolated_err_as_documented)
{
    const deviation d = deviation_of(BODIES[_i], "0.1", INTERPOLATED, NULL);
    printf("%s: rms %.2g, at most %.2g\n", BODIES[_i], d.rms, d.most);
    ck_assert_double_lt(d.rms, 3e-4);
    ck_assert_double_lt(d.most, 4e-3);
    ck_assert_double_gt(d.rms, 0); /* they are not exact in secret */
}
END_TEST

/* As the step goes to 0; below that of the rows every row is exact. */
START_TEST(test_shadows_interpolated_converge_to_exact)
{
    static const char *const STEPS[] = {"4", "2", "1", "0.5"};
    double before = 1, *exact = fluxes(BODIES[_i], "0.1", EXACT, NULL, 1);
    for (size_t k = 0; k < COUNT_OF(STEPS); k++) {
        char key[64];
        snprintf(key, sizeof key, "satellite.shadow_step_deg=%s", STEPS[k]);
        double *got = fluxes(BODIES[_i], "0.1", INTERPOLATED, key, 1);
        const deviation d = compare(got, exact);
        free(got);
        ck_assert_double_lt(d.rms, before * 1.1); /* a tile of 32 rows bounds the longest steps */
        before = d.rms;
    }
    free(exact);
    const deviation none =
        deviation_of(BODIES[_i], "1", INTERPOLATED, "satellite.shadow_step_deg=0.5");
    assert_near(none.most, 0, 0);
}
END_TEST

START_TEST(test_shadows_are_the_same_on_any_number_of_threads)
{
    const char *const ways[] = {EXACT, INTERPOLATED, RAYS};
    for (size_t way = 0; way < COUNT_OF(ways); way++) {
        if (ways[way] == RAYS && !visibility_has_rays()) continue;
        const char *key = ways[way] == RAYS ? "satellite.rays_per_facet=3" : NULL;
        double *one = fluxes(BODIES[0], "1", ways[way], key, 1);
        for (int threads = 2; threads <= 5; threads += 3) {
            double *many = fluxes(BODIES[0], "1", ways[way], key, threads);
            ck_assert_mem_eq(one, many, ROWS * sizeof *one);
            free(many);
        }
        free(one);
    }
}
END_TEST

/* With parts on hinges too (the first body). Large facets are the worst for rays. */
START_TEST(test_shadows_by_rays_converge_to_exact)
{
    if (!visibility_has_rays()) {
        printf("SKIPPED: built without Embree\n");
        return;
    }
    const deviation few = deviation_of(BODIES[_i], "2", RAYS, "satellite.rays_per_facet=16");
    const deviation many = deviation_of(BODIES[_i], "2", RAYS, "satellite.rays_per_facet=256");
    printf("%s: rms %.2g with 16 rays, %.2g with 256\n", BODIES[_i], few.rms, many.rms);
    ck_assert_double_lt(few.rms, 0.1);
    ck_assert_double_lt(many.rms, few.rms / 3); /* 16 times the rays: 4 by n^-1/2 */
}
END_TEST

/* The header of a table says how shadows were found, and how far off they are. */
START_TEST(test_shadows_are_told_in_the_header)
{
    const char *const set[] = {INTERPOLATED, "satellite.shadow_step_deg=2"};
    glint_scenario *s = read_sound_set(BODIES[2], set, 2);
    glint_curve *curve;
    const char *key, *value = NULL;
    bool found = false;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    for (size_t k = 0; !found && glint_curve_fact(curve, k, &key, &value); k++)
        found = strcmp(key, "self_shadows") == 0;
    ck_assert(found);
    ck_assert_ptr_nonnull(strstr(value, "interpolated"));
    ck_assert_ptr_nonnull(strstr(value, "every 2 deg"));
    ck_assert_ptr_nonnull(strstr(value, "of the mean flux"));
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

static Suite *shadows_suite(void)
{
    Suite *suite = suite_create("shadows");
    TCase *tc = tcase_create("runs");
    tcase_set_timeout(tc, 300);
    const int n = (int)COUNT_OF(BODIES);
    tcase_add_loop_test(tc, test_shadows_interpolated_err_as_documented, 0, n);
    tcase_add_loop_test(tc, test_shadows_interpolated_converge_to_exact, 0, n);
    tcase_add_test(tc, test_shadows_are_the_same_on_any_number_of_threads);
    tcase_add_loop_test(tc, test_shadows_by_rays_converge_to_exact, 0, n);
    tcase_add_test(tc, test_shadows_are_told_in_the_header);
    suite_add_tcase(suite, tc);
    return suite;
}

int main(void)
{
    return run_suite(shadows_suite());
}
