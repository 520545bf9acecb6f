/* Earthshine through whole runs: what reaches the table, and that it is light beside the Sun's. */
#include "scenario_text.h"

/* 24 h of a low orbit, seen from a station that never sets: all of the day and the umbra. */
static const char ORBIT_DAY[] =
    "[time]\nstart = 2025-07-25T00:00:00Z\nduration_s = 86400\nstep_s = 300\n";
static const char ANYWHERE[] =
    "[observer]\nlatitude_deg = 48.2\nlongitude_deg = 16.37\nmin_elevation_deg = -90\n";

static const char *settings_of(const char *earthshine)
{
    static char text[1024];
    snprintf(text, sizeof text,
             "[photometry]\nbands = [\"V\", \"B\"]\nearthshine = %s\n[output]\nshares = \"both\"\n",
             earthshine);
    return text;
}

static glint_scenario *scenario_of(const char *earthshine)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = ORBIT_DAY;
    parts[PART_OBSERVER] = ANYWHERE;
    return read_with(parts, PART_SETTINGS, settings_of(earthshine));
}

enum { MOST_ROWS = 400 };

typedef struct run {
    int n;
    double flux[MOST_ROWS][2], earth[MOST_ROWS][2], sunlit[MOST_ROWS], shares[MOST_ROWS];
    unsigned flags[MOST_ROWS];
    bool has_earth;
} run;

static run *run_of(const char *earthshine, int threads)
{
    run *out = calloc(1, sizeof *out);
    glint_scenario *s = scenario_of(earthshine);
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, threads, &curve, NULL), GLINT_OK);
    const glint_row *rows;
    size_t n;
    for (;;) {
        ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
        if (n == 0) break;
        for (size_t k = 0; k < n; k++, out->n++) {
            ck_assert_int_lt(out->n, MOST_ROWS);
            out->has_earth = rows[k].earthshine_flux_ratio != NULL;
            for (int b = 0; b < 2; b++) {
                out->flux[out->n][b] = rows[k].flux_ratio[b];
                if (out->has_earth) out->earth[out->n][b] = rows[k].earthshine_flux_ratio[b];
            }
            out->sunlit[out->n] = rows[k].sunlit_fraction;
            out->flags[out->n] = rows[k].flags;
            out->shares[out->n] = rows[k].share_material[0];
        }
    }
    glint_curve_close(curve);
    glint_scenario_free(s);
    return out;
}

START_TEST(test_earthshine_adds_to_sunlight)
{
    run *without = run_of("false", 1), *with = run_of("{ albedo = 0.3 }", 1);
    const double most = 0.5 * 1.74 * 0.3 / 3.14 / (780e3 * 780e3);
    int n_day = 0;
    ck_assert(!without->has_earth && with->has_earth);
    ck_assert_int_eq(with->n, without->n);
    for (int k = 0; k < with->n; k++) {
        const double earth = with->earth[k][0];
        assert_rel(with->flux[k][0], without->flux[k][0] + earth, 1e-14);
        ck_assert_int_eq(!!(with->flags[k] & GLINT_UMBRA), !!(without->flags[k] & GLINT_UMBRA));
        if (with->flux[k][0] > 0) assert_near(with->shares[k], 1, 1e-12);
        /* Where the limb hides the Sun, all ground in sight is dark: but for flattening. */
        if (!(with->sunlit[k] > 0)) ck_assert(earth < 1e-4 * most);
        /* no box of 1 m^2 sides, rho 0.5, shines by more: E < 0.3, 1.7 m^2 seen, 780 km */
        ck_assert(earth >= 0 && earth < 1.1 * most);
        n_day += earth > 0;
    }
    ck_assert_int_ge(n_day, 50);
    free(with);
    free(without);
}
END_TEST

/* A Lambertian ground by either name, twice as bright, and another in each band. */
START_TEST(test_earthshine_follows_the_ground)
{
    run *albedo = run_of("{ albedo = 0.3 }", 1);
    run *twice = run_of("{ brdf = \"lambert\", rho = 0.6 }", 1);
    run *spectrum =
        run_of("{ brdf = \"lambert\", rho = 0, spectrum = [ { wavelength_um = 0.4396, rho "
               "= 0.6 }, { wavelength_um = 0.5511, rho = 0.3 } ] }",
               1);
    for (int k = 0; k < albedo->n; k++) {
        assert_rel(twice->earth[k][0], 2 * albedo->earth[k][0], 1e-13);
        assert_rel(spectrum->earth[k][0], albedo->earth[k][0], 1e-13);
        assert_rel(spectrum->earth[k][1], twice->earth[k][1], 1e-13);
    }
    free(albedo);
    free(twice);
    free(spectrum);
}
END_TEST

START_TEST(test_earthshine_is_the_same_on_any_number_of_threads)
{
    run *one = run_of("{ brdf = \"phong\", rho_d = 0.53, rho_s = 0.28, n = 7.31 }", 1);
    run *three = run_of("{ brdf = \"phong\", rho_d = 0.53, rho_s = 0.28, n = 7.31 }", 3);
    ck_assert_mem_eq(one, three, sizeof *one);
    free(one);
    free(three);
}
END_TEST

/* 1e-4 of the brightest row: rings by hand against the rings that are chosen. */
START_TEST(test_earthshine_converges_with_rings)
{
    run *chosen = run_of("{ albedo = 0.3 }", 0), *fine = run_of("{ albedo = 0.3, rings = 80 }", 0);
    double most = 0;
    for (int k = 0; k < fine->n; k++)
        most = fmax(most, fine->earth[k][0]);
    for (int k = 0; k < fine->n; k++)
        assert_near(chosen->earth[k][0], fine->earth[k][0], 1e-4 * most);
    free(chosen);
    free(fine);
}
END_TEST

START_TEST(test_earthshine_is_refused_where_directions_are_given)
{
    static const wrong_text WRONG[] = {
        {PART_SETTINGS, "[photometry]\nearthshine = @{ albedo = 0.3 }\n",
         "do not say where the Earth is", "earthshine = false", 0},
    };
    ASSERT_ALL_WRONG(GIVEN, WRONG);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("earthshine");
    TCase *c = tcase_create("earthshine");
    tcase_set_timeout(c, 300);
    tcase_add_checked_fixture(c, folder_make, folder_remove);
    tcase_add_test(c, test_earthshine_adds_to_sunlight);
    tcase_add_test(c, test_earthshine_follows_the_ground);
    tcase_add_test(c, test_earthshine_is_the_same_on_any_number_of_threads);
    tcase_add_test(c, test_earthshine_converges_with_rings);
    tcase_add_test(c, test_earthshine_is_refused_where_directions_are_given);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
