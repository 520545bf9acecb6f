/* Directional-hemispherical reflectance against reference values, closed forms and a quadrature of
 * another kind. */
#include "base/constants.h"
#include "brdf/dhr.h"
#include "table.h"

/* ------------------------------------------------------------------ helpers */

/* A material of one lobe, which the caller keeps. */
static brdf_material one_lobe(brdf_lobe *lobe, const char *name, const double *params)
{
    *lobe = (brdf_lobe){.model = brdf_model_named(name), .weight = 1.0};
    ck_assert_msg(lobe->model != NULL, "no model %s", name);
    ck_assert_int_eq(lobe->model->prepare(params, lobe->coef, NULL), GLINT_OK);
    return (brdf_material){.n_lobes = 1, .lobes = lobe};
}

/* The reflectance, which must be found to the tolerance. */
static double dhr_of(const char *name, const double *params, double theta_deg, double phi_deg,
                     double tolerance)
{
    brdf_lobe lobe;
    const brdf_material material = one_lobe(&lobe, name, params);
    glint_error error = {0};
    double dhr, bound;
    const glint_status status =
        brdf_dhr(&material, theta_deg * DEG, phi_deg * DEG, tolerance, &dhr, &bound, &error);
    ck_assert_msg(status == GLINT_OK, "%s at %g deg: %s", name, theta_deg, error.message);
    ck_assert_msg(bound >= 0.0 && bound <= tolerance * dhr * (1 + 1e-9), "bound %g of %g", bound,
                  dhr);
    return dhr;
}

static const double angles_deg[] = {0, 20, 40, 60, 75, 85, 88};
enum { N_ANGLES = sizeof angles_deg / sizeof angles_deg[0] };

/* --------------------------------------------------------- reference values */

/* The file's values are printed to 12 digits and hold to 1e-8 up to 88 deg, or to twice the
 * difference of the two quadratures that they come from where that is larger (a lobe at 88 deg:
 * 1e-5). */
static void check_ward(const char *path)
{
    static const char *const models[3][3] = {{"ward", "lobe_seed_eq6", "total_seed_eq6"},
                                             {"ward-duer", "lobe_duer2006", "total_duer2006"},
                                             {"ward-gmd", "lobe_gmd2010", "total_gmd2010"}};
    csv_table table = table_open(path);
    double worst = 0.0;
    for (long row = 0; row < table.n_rows; row++) {
        const double theta_deg = table_number(&table, row, "theta_i_deg");
        if (theta_deg > 88) continue;
        const double ax = table_number(&table, row, "ax"), ay = table_number(&table, row, "ay");
        const double k_lambda = table_number(&table, row, "k_lambda");
        const double rho_d = table_number(&table, row, "rho_d");
        const double rho_s = table_number(&table, row, "rho_s");
        const double tolerance =
            fmax(1e-8, 2 * table_number(&table, row, "max_rel_diff_between_two_quadratures"));
        const double params[2][6] = {{0, 1, ax, ay, k_lambda, 1},
                                     {rho_d, rho_s, ax, ay, k_lambda, 1}};
        for (int m = 0; m < 3; m++)
            for (int total = 0; total < 2; total++) {
                const double got = dhr_of(models[m][0], params[total], theta_deg, 0, 1e-10);
                const double want = table_number(&table, row, models[m][1 + total]);
                ck_assert_msg(is_near(got, want, tolerance * want),
                              "%s, row %ld, %s: %.13g; not %.13g", path, row, models[m][1 + total],
                              got, want);
                if (tolerance <= 1e-8) worst = fmax(worst, fabs(got / want - 1.0));
            }
    }
    printf("%s: worst relative error %.2g (of the rows held to 1e-8)\n", path, worst);
    csv_free(&table);
}

START_TEST(test_dhr_of_ward_models_matches_reference)
{
    table_check(check_ward, "brdf/dhr.csv");
}
END_TEST

/* ------------------------------------------------------------- closed forms */

START_TEST(test_dhr_of_lambert_is_its_reflectance)
{
    for (int k = 0; k < N_ANGLES; k++)
        assert_rel(dhr_of("lambert", (double[]){0.3}, angles_deg[k], 10, 1e-12), 0.3, 1e-12);
    assert_rel(dhr_of("lambert", (double[]){0.3}, 89.99, 10, 1e-12), 0.3, 1e-12);
    assert_near(dhr_of("lambert", (double[]){0}, 30, 0, 1e-12), 0.0, 0.0);
}
END_TEST

/* Minnaert: rho (k+1)/(2 pi) ci^(k-1) times 2 pi times the integral of c^k over 0..1. k < 1 has an
 * infinite slope at grazing observation. */
START_TEST(test_dhr_of_minnaert_is_a_power_of_the_incidence)
{
    for (int k = 0; k < N_ANGLES; k++)
        for (double power = 0.2; power < 3; power += 0.4) {
            const double got = dhr_of("minnaert", (double[]){0.4, power}, angles_deg[k], 0, 1e-10);
            assert_rel(got, 0.4 * pow(cos(angles_deg[k] * DEG), power - 1), 1e-10);
        }
}
END_TEST

/* Lommel-Seeliger: w/2 times the integral of c/(ci+c) over 0..1. */
START_TEST(test_dhr_of_lommel_seeliger_is_a_logarithm)
{
    for (int k = 0; k < N_ANGLES; k++) {
        const double ci = cos(angles_deg[k] * DEG);
        const double got = dhr_of("lommel-seeliger", (double[]){0.3}, angles_deg[k], 0, 1e-11);
        assert_rel(got, 0.15 * (1 - ci * log((1 + ci) / ci)), 1e-11);
    }
}
END_TEST

/* The mean of the observer's cosine over a Phong lobe that ends above the horizon is ci
 * (n+1)/(n+2): the odd part of the cosine drops out. So the reflectance is rho_d + rho_s ci. The
 * part of a lobe of n = 1e4 that is cut off at 85 deg is 10^-16. */
START_TEST(test_dhr_of_narrow_phong_lobes)
{
    for (int k = 0; k < N_ANGLES && angles_deg[k] <= 85; k++)
        for (double n = 1e4; n <= 1e6; n *= 10) {
            const double got = dhr_of("phong", (double[]){0.1, 0.5, n}, angles_deg[k], 0, 1e-11);
            assert_rel(got, 0.1 + 0.5 * cos(angles_deg[k] * DEG), 1e-11);
        }
}
END_TEST

/* ABg at normal incidence: 2 pi A times the integral of x/(B + x^g) over 0..1; for g = 2 a
 * logarithm, for g = 4 an arc tangent. The core of B = 1e-12, g = 4 is 1e-3 wide, that of
 * B = 1e-15, g = 2 is 3e-8 wide. */
START_TEST(test_dhr_of_abg_at_normal_incidence)
{
    for (double b = 1e-15; b < 1; b *= 100) {
        const double log_form = dhr_of("abg", (double[]){0.1, 0.02, b, 2}, 0, 0, 1e-11);
        assert_rel(log_form, 0.1 + PI * 0.02 * log1p(1 / b), 1e-11);
        const double atan_form = dhr_of("abg", (double[]){0.1, 0.02, b, 4}, 0, 0, 1e-11);
        assert_rel(atan_form, 0.1 + PI * 0.02 / sqrt(b) * atan(1 / sqrt(b)), 1e-11);
    }
}
END_TEST

/* The diffuse term k_d/ci alone: pi k_d/ci. Oren-Nayar at normal incidence: the terms with B or its
 * sine vanish, rho C1 + .17 rho^2 s2/(s2+.13) is left. */
START_TEST(test_dhr_of_five_parameter_diffuse_and_of_oren_nayar)
{
    const double s2 = 30 * DEG * 30 * DEG, ci = cos(75 * DEG);
    assert_rel(dhr_of("five-parameter", (double[]){0, 1, 0.1, 1, 0}, 75, 0, 1e-11), PI * 0.1 / ci,
               1e-11);
    assert_rel(dhr_of("oren-nayar", (double[]){0.9, 30}, 0, 0, 1e-11),
               0.9 * (1 - 0.5 * s2 / (s2 + 0.33)) + 0.17 * 0.81 * s2 / (s2 + 0.13), 1e-11);
}
END_TEST

/* The newest Ward form reflects all of rho_s but corrections of the order alpha^2/ci^2, in any
 * azimuth, also where one slope is a thousand times the other. */
START_TEST(test_dhr_of_narrow_ward_lobes)
{
    for (int k = 0; k < N_ANGLES; k++) {
        const double ci = cos(angles_deg[k] * DEG);
        for (double a = 1e-6; a < 2e-3; a *= 10)
            for (double b = a; b < 2e-3; b *= 10) {
                const double params[] = {0, 1, a, b, PARAM_NONE, PARAM_NONE};
                const double got = dhr_of("ward-gmd", params, angles_deg[k], 25, 1e-8);
                assert_near(got, 1.0, 2 * b * b / (ci * ci) + 1e-8);
            }
    }
}
END_TEST

/* Smooth metal at normal incidence: Fresnel's ((n-1)^2+k^2)/((n+1)^2+k^2), but for what is in the
 * tails of the order alpha^2 ln(1/alpha). */
START_TEST(test_dhr_of_smooth_ggx_is_fresnel)
{
    const double params[] = {0, 1, 1e-5, 1e-5, 0.96, 6.69}, k2 = 6.69 * 6.69;
    const double fresnel = (0.04 * 0.04 + k2) / (1.96 * 1.96 + k2);
    assert_rel(dhr_of("ggx", params, 0, 0, 1e-10), fresnel, 2e-9);
}
END_TEST

/* ---------------------------------------------------------------- properties */

/* Gauss-Legendre points and weights on 0..1, by Newton's method. */
static void legendre_rule(int n, double *x, double *weight)
{
    for (int k = 0; k < n; k++) {
        double z = cos(PI * (k + 0.75) / (n + 0.5)), slope = 1.0;
        for (int step = 0; step < 30; step++) {
            double p = 1.0, before = 0.0;
            for (int j = 1; j <= n; j++) {
                const double next = ((2 * j - 1) * z * p - (j - 1) * before) / j;
                before = p;
                p = next;
            }
            slope = n * (z * p - before) / (z * z - 1);
            z -= p / slope;
        }
        x[k] = 0.5 * (1 + z);
        weight[k] = 1 / ((1 - z * z) * slope * slope);
    }
}

/* The other sum: light that comes from everywhere and goes in one direction r, as a share of what a
 * white surface would send there: the integral of f ci over the directions of the source. Plain
 * spherical coordinates, cosines c = x^2. */
static double hemispherical_directional(const brdf_lobe *lobe, double theta_deg, double phi_deg)
{
    enum { RINGS = 200, TURNS = 600 };
    static double x[RINGS], weight[RINGS];
    if (!(x[0] > 0)) legendre_rule(RINGS, x, weight);
    const double theta = theta_deg * DEG, phi = phi_deg * DEG;
    const double r[3] = {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
    double sum = 0.0;
    for (int a = 0; a < RINGS; a++) {
        const double c = x[a] * x[a], s = sqrt((1 - c) * (1 + c));
        for (int b = 0; b < TURNS; b++) {
            const double turn = TWO_PI * (b + 0.5) / TURNS;
            const double i[3] = {s * cos(turn), s * sin(turn), c};
            sum += weight[a] * 2 * x[a] * (TWO_PI / TURNS) * lobe->model->eval(lobe->coef, i, r);
        }
    }
    return sum / r[2];
}

/* Lobes wide enough for the plain quadrature. It is good to 1e-7 where the model is smooth;
 * `kinks` marks those that are not, of which it leaves 1e-5. */
static const struct {
    const char *model;
    double params[BRDF_MAX_PARAMS];
    bool kinks;
} wide[] = {
    {"lambert", {0.5}, false},
    {"oren-nayar", {0.9, 30}, true},
    {"minnaert", {0.5, 0.8}, false},
    {"ward", {0.17, 0.7, 0.2, 0.4, PARAM_NONE, PARAM_NONE}, false},
    {"ward-duer", {0.17, 0.7, 0.2, 0.4, PARAM_NONE, PARAM_NONE}, false},
    {"ward-gmd", {0.17, 0.7, 0.2, 0.4, PARAM_NONE, PARAM_NONE}, false},
    {"phong", {0.3, 0.4, 8.9}, true},
    {"ashikhmin-shirley", {0.5, 0.3, 20, 40}, true},
    {"ashikhmin-premoze", {0.5, 0.3, 20, 40}, false},
    {"cook-torrance", {0.3, 0.7, 0.4, 1.5, 0}, true},
    {"ggx", {0.1, 0.9, 0.3, 0.5, 0.96, 6.69}, false},
    {"abg", {0.1, 0.02, 0.02, 2}, false},
    {"lommel-seeliger", {0.3}, false},
    {"hapke", {0.3, -0.25, 1, 0.4}, false},
};

/* Reciprocity makes the two sums equal; they are found in different coordinates. */
START_TEST(test_dhr_equals_hemispherical_directional_sum)
{
    static const double thetas[] = {0, 35, 60, 80};
    double worst = 0.0;
    brdf_lobe lobe;
    one_lobe(&lobe, wide[_i].model, wide[_i].params);
    for (size_t k = 0; k < sizeof thetas / sizeof thetas[0]; k++) {
        const double got = dhr_of(wide[_i].model, wide[_i].params, thetas[k], 30, 1e-8);
        const double want = hemispherical_directional(&lobe, thetas[k], 30);
        assert_rel(got, want, wide[_i].kinks ? 1e-5 : 1e-7);
        worst = fmax(worst, fabs(got / want - 1));
    }
    printf("%s: two sums differ by %.2g at most\n", wide[_i].model, worst);
}
END_TEST

START_TEST(test_dhr_turns_with_the_tangent)
{
    const double along[] = {0.1, 0.8, 0.05, 0.3, PARAM_NONE, PARAM_NONE};
    const double across[] = {0.1, 0.8, 0.3, 0.05, PARAM_NONE, PARAM_NONE};
    for (double phi = -180; phi <= 180; phi += 22.5)
        assert_rel(dhr_of("ward-gmd", along, 50, phi, 1e-10),
                   dhr_of("ward-gmd", across, 50, phi + 90, 1e-10), 2e-10);
}
END_TEST

START_TEST(test_dhr_is_linear_in_lobes_and_weights)
{
    brdf_lobe lobes[2];
    one_lobe(&lobes[0], "lambert", (double[]){0.3});
    one_lobe(&lobes[1], "phong", (double[]){0.0, 0.5, 1e5});
    lobes[0].weight = 0.5;
    lobes[1].weight = 0.25;
    const brdf_material material = {.n_lobes = 2, .lobes = lobes};
    double dhr;
    ck_assert_int_eq(brdf_dhr(&material, 0.0, 0.0, 1e-11, &dhr, NULL, NULL), GLINT_OK);
    assert_rel(dhr, 0.5 * 0.3 + 0.25 * 0.5, 1e-11);
}
END_TEST

/* --------------------------------------------------------------------- limits */

/* A mirror reflects its share, whatever else the sum holds, and counts for the energy. */
START_TEST(test_dhr_of_mirrors_is_that_of_the_mirror_direction)
{
    const brdf_model *mirror = brdf_model_named("mirror"), *lambert = brdf_model_named("lambert");
    for (int k = 0; k < N_ANGLES; k++)
        assert_near(
            dhr_of("mirror", (double[]){0.7, PARAM_NONE, PARAM_NONE}, angles_deg[k], 20, 1e-12),
            0.7, 0);
    assert_rel(dhr_of("mirror", (double[]){1, 1.5, PARAM_NONE}, 0, 0, 1e-12), 0.04, 1e-14);
    brdf_lobe lobes[2] = {{.model = mirror, .weight = 0.5, .params = {0.8, PARAM_NONE, PARAM_NONE}},
                          {.model = lambert, .weight = 2, .params = {0.1}}};
    for (int k = 0; k < 2; k++)
        ck_assert_int_eq(brdf_lobe_prepare(&lobes[k], NULL), GLINT_OK);
    const brdf_material sum = {.n_lobes = 2, .lobes = lobes};
    double dhr, bound;
    ck_assert_int_eq(brdf_dhr(&sum, 0.5, 0, 1e-12, &dhr, &bound, NULL), GLINT_OK);
    assert_rel(dhr, 0.5 * 0.8 + 2 * 0.1, 1e-12);
    brdf_energy worst;
    ck_assert(!brdf_energy_gain(&sum, &worst));
    lobes[0].weight = 1.1; /* 0.88 + 0.2 */
    ck_assert(brdf_energy_gain(&sum, &worst));
    assert_rel(worst.dhr, 1.08, 1e-6);
}
END_TEST

START_TEST(test_dhr_refuses_incidence_out_of_range)
{
    static const double bad[] = {-0.1, PI / 2, 2.0, NAN, INFINITY};
    brdf_lobe lobe;
    const brdf_material material = one_lobe(&lobe, "lambert", (double[]){0.5});
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        double dhr = -1;
        glint_error error;
        ck_assert_int_eq(brdf_dhr(&material, bad[k], 0, 1e-6, &dhr, NULL, &error), GLINT_ARGUMENT);
        ck_assert_ptr_nonnull(strstr(error.message, "expected 0 to below 90 deg"));
        assert_near(dhr, -1, 0);
    }
}
END_TEST

/* The fold of the shadowing factor is more than the work allowed can follow to 1e-12; what was
 * reached is within its bound of a run that asked for less. */
START_TEST(test_dhr_says_when_tolerance_is_out_of_reach)
{
    const double params[] = {0.3, 0.7, 0.2, 1.5, 0};
    brdf_lobe lobe;
    const brdf_material material = one_lobe(&lobe, "cook-torrance", params);
    double dhr, bound;
    glint_error error;
    ck_assert_int_eq(brdf_dhr(&material, 88 * DEG, 0, 0, &dhr, &bound, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "88 deg"));
    ck_assert(bound > 1e-12 * dhr && bound < 1e-9 * dhr);
    assert_rel(dhr, dhr_of("cook-torrance", params, 88, 0, 1e-8), 1e-8);
}
END_TEST

/* --------------------------------------------------------------------- energy */

static bool gain_of(const char *name, const double *params, brdf_energy *worst)
{
    brdf_lobe lobe;
    const brdf_material material = one_lobe(&lobe, name, params);
    return brdf_energy_gain(&material, worst);
}

START_TEST(test_energy_gain_names_the_worst_incidence)
{
    brdf_energy worst;
    /* decreases from normal incidence, where it is pi A ln(1 + 1/B) */
    ck_assert(gain_of("abg", (double[]){0, 0.05, 1e-5, 2}, &worst));
    assert_near(worst.theta_i, 0, 0);
    assert_rel(worst.dhr, PI * 0.05 * log1p(1e5), 1e-3);
    /* rho ci^(k-1) */
    ck_assert(gain_of("minnaert", (double[]){0.5, 0.5}, &worst));
    assert_rel(worst.theta_i, 85 * DEG, 1e-15);
    assert_rel(worst.dhr, 0.5 / sqrt(cos(85 * DEG)), 1e-3);
}
END_TEST

START_TEST(test_energy_gain_is_sharp_at_one)
{
    brdf_energy worst;
    ck_assert(!gain_of("lambert", (double[]){1}, &worst));
    assert_rel(worst.dhr, 1, 1e-6);
    ck_assert(!gain_of("phong", (double[]){0, 1, 1e5}, &worst));
    ck_assert(!gain_of("ward-gmd", (double[]){0, 1, 0.1, 0.3, PARAM_NONE, PARAM_NONE}, &worst));
    brdf_lobe lobe;
    brdf_material material = one_lobe(&lobe, "lambert", (double[]){1});
    lobe.weight = 1.00001;
    ck_assert(brdf_energy_gain(&material, &worst));
    material.n_lobes = 0;
    ck_assert(!brdf_energy_gain(&material, &worst));
    assert_near(worst.dhr, 0, 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("dhr");
    TCase *reference = tcase_create("reference");
    tcase_set_timeout(reference, 120);
    tcase_add_test(reference, test_dhr_of_ward_models_matches_reference);
    suite_add_tcase(suite, reference);
    TCase *closed = tcase_create("closed forms");
    tcase_set_timeout(closed, 120);
    tcase_add_test(closed, test_dhr_of_lambert_is_its_reflectance);
    tcase_add_test(closed, test_dhr_of_minnaert_is_a_power_of_the_incidence);
    tcase_add_test(closed, test_dhr_of_lommel_seeliger_is_a_logarithm);
    tcase_add_test(closed, test_dhr_of_narrow_phong_lobes);
    tcase_add_test(closed, test_dhr_of_abg_at_normal_incidence);
    tcase_add_test(closed, test_dhr_of_five_parameter_diffuse_and_of_oren_nayar);
    tcase_add_test(closed, test_dhr_of_narrow_ward_lobes);
    tcase_add_test(closed, test_dhr_of_smooth_ggx_is_fresnel);
    tcase_add_test(closed, test_dhr_of_mirrors_is_that_of_the_mirror_direction);
    suite_add_tcase(suite, closed);
    TCase *properties = tcase_create("properties");
    tcase_set_timeout(properties, 120);
    tcase_add_loop_test(properties, test_dhr_equals_hemispherical_directional_sum, 0,
                        sizeof wide / sizeof wide[0]);
    tcase_add_test(properties, test_dhr_turns_with_the_tangent);
    tcase_add_test(properties, test_dhr_is_linear_in_lobes_and_weights);
    suite_add_tcase(suite, properties);
    TCase *limits = tcase_create("limits");
    tcase_set_timeout(limits, 120);
    tcase_add_test(limits, test_dhr_refuses_incidence_out_of_range);
    tcase_add_test(limits, test_dhr_says_when_tolerance_is_out_of_reach);
    tcase_add_test(limits, test_energy_gain_names_the_worst_incidence);
    tcase_add_test(limits, test_energy_gain_is_sharp_at_one);
    suite_add_tcase(suite, limits);
    return run_suite(suite);
}
