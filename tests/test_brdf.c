/* BRDF models against reference values, and the table of models. */
#include "base/constants.h"
#include "brdf/brdf.h"
#include "brdf/sharpness.h"
#include "table.h"

/* ------------------------------------------------------------------ helpers */

/* Relative error that rounding leaves: the angles' sines and cosines err by 1e-16, and an exponent
 * of up to 100 (where the diffuse term does not hide the lobe) makes a few of those 1e-13 at most.
 */
static const double rounding = 1e-13;

static void direction(double theta_deg, double phi_deg, double out[3])
{
    const double theta = theta_deg * DEG, phi = phi_deg * DEG;
    out[0] = sin(theta) * cos(phi);
    out[1] = sin(theta) * sin(phi);
    out[2] = cos(theta);
}

static void prepare(const char *name, const double *params, double coef[BRDF_MAX_COEF])
{
    const brdf_model *model = brdf_model_named(name);
    ck_assert_ptr_nonnull(model);
    ck_assert_int_eq(model->prepare(params, coef, NULL), GLINT_OK);
}

/* f (1/sr) of a model from four angles in deg. */
static double f_of(const char *name, const double *params, const double angles_deg[4])
{
    double coef[BRDF_MAX_COEF], i[3], r[3];
    prepare(name, params, coef);
    direction(angles_deg[0], angles_deg[1], i);
    direction(angles_deg[2], angles_deg[3], r);
    return brdf_model_named(name)->eval(coef, i, r) / (i[2] * r[2]);
}

/* The row's four angles, in columns of these names. */
static void row_angles(const csv_table *table, long row, const char *const names[4], double out[4])
{
    for (int k = 0; k < 4; k++)
        out[k] = table_number(table, row, names[k]);
}

/* Holds a value against a cell and keeps the worst relative error. */
static void check_cell(const csv_table *table, long row, const char *column, double got, double rel,
                       double *worst)
{
    const double want = table_number(table, row, column);
    ck_assert_msg(is_near(got, want, rel * fabs(want)), "%s, row %ld, %s: %.17g; expected %.17g",
                  table->path, row, column, got, want);
    *worst = fmax(*worst, fabs(got / want - 1.0));
}

static const char *const long_names[4] = {"theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg"};
static const char *const short_names[4] = {"ti", "pi", "tr", "pr"};

/* rho_d, rho_s, alpha_x, alpha_y, k_per_um, wavelength_um of the published materials and of
 * anisotropic variants. */
static const struct {
    const char *name;
    double params[6];
} wards[] = {
    {"panel", {0.17, 0.7, 0.12, 0.12, 0.14, 10.6}},
    {"mli", {0.1, 0.75, 0.06, 0.06, 0.14, 10.6}},
    {"panel_vis", {0.17, 0.7, 0.12, 0.12, 0.14, 0.55}},
    {"aniso_a", {0.17, 0.7, 0.12, 0.3, 0.14, 10.6}},
    {"aniso_b", {0.1, 0.75, 0.2, 0.06, 0.14, 10.6}},
};

static const double *ward_named(const char *name)
{
    for (size_t k = 0; k < sizeof wards / sizeof wards[0]; k++)
        if (strcmp(wards[k].name, name) == 0) return wards[k].params;
    ck_abort_msg("no material %s", name);
    return NULL;
}

/* --------------------------------------------------------- reference values */

static void check_wards(const char *path, const char *const angle_names[4], double rel)
{
    csv_table table = table_open(path);
    double worst = 0.0;
    for (long row = 0; row < table.n_rows; row++) {
        const double *params = ward_named(table_text(&table, row, "case"));
        double angles[4];
        row_angles(&table, row, angle_names, angles);
        check_cell(&table, row, "f_seed_eq6", f_of("ward", params, angles), rel, &worst);
        check_cell(&table, row, "f_duer2006", f_of("ward-duer", params, angles), rel, &worst);
        check_cell(&table, row, "f_gmd2010", f_of("ward-gmd", params, angles), rel, &worst);
    }
    printf("%s: worst relative error %.2g\n", path, worst);
    csv_free(&table);
}

static void check_ward_grid(const char *path)
{
    check_wards(path, long_names, rounding);
}

static void check_ward_spots(const char *path)
{
    check_wards(path, short_names, 1e-11);
}

START_TEST(test_ward_matches_reference_in_plane)
{
    table_check(check_ward_grid, "brdf/golden_in_plane.csv");
}
END_TEST

START_TEST(test_ward_matches_reference_out_of_plane)
{
    table_check(check_ward_grid, "brdf/golden_out_of_plane.csv");
}
END_TEST

START_TEST(test_ward_matches_reference_at_spots)
{
    table_check(check_ward_spots, "brdf/spots.csv");
}
END_TEST

static void check_peaks(const char *path)
{
    static const char *const models[][2] = {
        {"seed", "ward"}, {"duer", "ward-duer"}, {"gmd", "ward-gmd"}};
    csv_table table = table_open(path);
    double worst = 0.0;
    for (long row = 0; row < table.n_rows; row++) {
        const double *params = ward_named(table_text(&table, row, "case"));
        const double theta_i = table_number(&table, row, "theta_i_deg");
        const double theta_peak = table_number(&table, row, "theta_r_of_in_plane_peak_deg");
        for (int k = 0; k < 3; k++) {
            if (strcmp(models[k][0], table_text(&table, row, "model")) != 0) continue;
            const double mirror[4] = {theta_i, 0, theta_i, 180},
                         peak[4] = {theta_i, 0, theta_peak, 180};
            const char *model = models[k][1];
            check_cell(&table, row, "f_at_exact_specular", f_of(model, params, mirror), 1e-9,
                       &worst);
            check_cell(&table, row, "f_peak", f_of(model, params, peak), 1e-9, &worst);
        }
    }
    printf("%s: worst relative error %.2g\n", path, worst);
    csv_free(&table);
}

START_TEST(test_ward_peaks_match_reference)
{
    table_check(check_peaks, "brdf/peaks.csv");
}
END_TEST

/* The published claim: the blanket's peak is about 4 times the panel's. At normal incidence the
 * ratio is (0.1/pi + 0.75/(4 pi a^2)) / (0.17/pi + 0.7/(4 pi (2a)^2)), a = 0.06/1.484. */
START_TEST(test_ward_peak_ratio_of_published_materials)
{
    const double normal[4] = {0, 0, 0, 0}, a = 0.06 / 1.484;
    const double ratio =
        f_of("ward", ward_named("mli"), normal) / f_of("ward", ward_named("panel"), normal);
    assert_rel(ratio, (0.1 + 0.75 / (4 * a * a)) / (0.17 + 0.7 / (16 * a * a)), 1e-14);
    assert_near(ratio, 4.2624, 5e-5);
}
END_TEST

/* The reference's name and parameters of a model, and ours. */
static const struct {
    const char *reference, *reference_params, *model;
    double params[BRDF_MAX_PARAMS];
} others[] = {
    {"lambert", "rho=0.5", "lambert", {0.5}},
    {"phong_normalised", "rd=.34 rs=.40 n=8.9", "phong", {0.34, 0.40, 8.9}},
    {"ashikhmin_shirley", "Rd=.5 Rs=.3 nu=100 nv=400", "ashikhmin-shirley", {0.5, 0.3, 100, 400}},
    {"ashikhmin_premoze_linares",
     "Rd=.5 Rs=.3 nu=100 nv=400",
     "ashikhmin-premoze",
     {0.5, 0.3, 100, 400}},
    {"cook_torrance_beckmann_vgroove_dielectric",
     "rd=.3 s=.7 m=.2 n=1.5",
     "cook-torrance",
     {0.3, 0.7, 0.2, 1.5, 0}},
    {"ggx_smith_correlated_conductor",
     "ax=.1 ay=.3 n=.96 k=6.69",
     "ggx",
     {0, 1, 0.1, 0.3, 0.96, 6.69}},
    {"oren_nayar_full", "rho=.9 sigma=30deg", "oren-nayar", {0.9, 30}},
    {"minnaert", "rho=1 k=.8", "minnaert", {1, 0.8}},
    {"lommel_seeliger_isotropic", "w=.3", "lommel-seeliger", {0.3}},
    {"hapke_smooth_HG", "w=.3 b=-.25 B0=1 h=.1", "hapke", {0.3, -0.25, 1, 0.1}},
    {"abg", "A=3.362e-3 B=4.309e-6 g=2.068", "abg", {0, 3.362e-3, 4.309e-6, 2.068}},
    {"five_parameter_form_unconfirmed",
     "kb=5 kr=2 kd=.1 a=.5 b=-3",
     "five-parameter",
     {5, 2, 0.1, 0.5, -3}},
};

enum { N_OTHERS = sizeof others / sizeof others[0] };

/* The entry of a row of the reference, or -1: a variant that is not among the models. */
static int other_of(const csv_table *table, long row)
{
    for (int k = 0; k < N_OTHERS; k++)
        if (strcmp(others[k].reference, table_text(table, row, "model")) == 0) {
            ck_assert_str_eq(others[k].reference_params, table_text(table, row, "params"));
            return k;
        }
    return -1;
}

static void check_others(const char *path)
{
    csv_table table = table_open(path);
    double worst[N_OTHERS] = {0};
    int rows[N_OTHERS] = {0};
    for (long row = 0; row < table.n_rows; row++) {
        const int k = other_of(&table, row);
        if (k < 0) continue;
        double angles[4];
        row_angles(&table, row, long_names, angles);
        const double f = f_of(others[k].model, others[k].params, angles);
        check_cell(&table, row, "f", f, rounding, &worst[k]);
        rows[k]++;
    }
    for (int k = 0; k < N_OTHERS; k++) {
        ck_assert_msg(rows[k] == 12, "%s: %d rows of %s", path, rows[k], others[k].reference);
        printf("%s: %s: worst relative error %.2g\n", path, others[k].model, worst[k]);
    }
    csv_free(&table);
}

START_TEST(test_brdf_other_models_match_reference)
{
    table_check(check_others, "brdf/other_models.csv");
}
END_TEST

/* A lobe of the binomial model; brdf_lobe_free ends it. */
static brdf_lobe binomial_of(int rows, int n_b, const double *b, int n_c, const double *c, double d,
                             double l1)
{
    brdf_lobe lobe = {.model = brdf_model_named("binomial"), .weight = 1.0};
    lobe.params[2] = d;
    lobe.params[3] = l1;
    ck_assert(brdf_lobe_make_arrays(&lobe));
    const int columns[2] = {n_b, n_c};
    const double *const values[2] = {b, c};
    for (int k = 0; k < 2; k++) {
        const size_t n = (size_t)(rows * columns[k]);
        lobe.arrays[k] = (brdf_array){rows, columns[k], malloc(n * sizeof(double))};
        ck_assert_ptr_nonnull(lobe.arrays[k].values);
        memcpy(lobe.arrays[k].values, values[k], n * sizeof(double));
    }
    glint_error error;
    ck_assert_msg(brdf_lobe_prepare(&lobe, &error) == GLINT_OK, "%s", error.message);
    return lobe;
}

/* The laboratory fits to flight materials (Fankhauser et al. 2023), and a form with V. */
static brdf_lobe binomial_named(const char *name)
{
    static const double chassis_b[] = {3.34, -98.085}, array_b[] = {0.534, -20.409};
    static const double chassis_c[] = {-999.999, 867.538,  1000,    1000,     -731.248,
                                       618.552,  -294.054, 269.248, -144.853, 75.196};
    static const double array_c[] = {-527.765, 1000, -676.579, 430.596, -175.806, 57.879};
    static const double two_b[] = {0.5, -1.25, 0.75, 1.5, -0.5, 0.25},
                        two_c[] = {-2, 1, 0.5, -0.25};
    if (strcmp(name, "chassis") == 0) return binomial_of(1, 2, chassis_b, 10, chassis_c, 3, -5);
    if (strcmp(name, "array") == 0) return binomial_of(1, 2, array_b, 6, array_c, 3, -3);
    ck_assert_str_eq(name, "two_rows");
    return binomial_of(2, 3, two_b, 2, two_c, 2, -1);
}

/* f (1/sr) of a lobe from four angles in deg. */
static double lobe_f(const brdf_lobe *lobe, const double angles_deg[4])
{
    double i[3], r[3];
    direction(angles_deg[0], angles_deg[1], i);
    direction(angles_deg[2], angles_deg[3], r);
    return lobe->model->eval(brdf_lobe_coef(lobe), i, r) / (i[2] * r[2]);
}

/* Terms of ln f up to 1e4 in size cancel to a few units: 1e-12 is left. */
START_TEST(test_binomial_matches_reference)
{
    csv_table table = table_open(path_in(TEST_DATA_DIR, "brdf/binomial.csv"));
    double worst = 0.0;
    for (long row = 0; row < table.n_rows; row++) {
        brdf_lobe lobe = binomial_named(table_text(&table, row, "case"));
        double angles[4];
        row_angles(&table, row, long_names, angles);
        check_cell(&table, row, "f", lobe_f(&lobe, angles), 1e-11, &worst);
        brdf_lobe_free(&lobe);
    }
    printf("binomial: worst relative error %.2g\n", worst);
    csv_free(&table);
}
END_TEST

/* Another program's values (lumos-sat 1.0.9), printed to 10 digits. */
START_TEST(test_brdf_matches_values_of_another_program)
{
    static const char *const names[4] = {"theta_i", "phi_i", "theta_o", "phi_o"};
    static const struct {
        const char *column, *model;
        double params[4];
    } models[] = {
        {"lambert_0.5", "lambert", {0.5}},
        {"phong_0.34_0.40_8.9", "phong", {0.34, 0.40, 8.9}},
        {"phong_0.15_0.25_0.26", "phong", {0.15, 0.25, 0.26}},
        {"phong_0.53_0.28_7.31", "phong", {0.53, 0.28, 7.31}},
        {"abg_0.01999_2.285e-6_2.264",
         "abg",
         {0, 0.019989862079564824, 2.2851243807209376e-06, 2.2640286229702555}},
    };
    const char *dir = reference_dir("values of another program");
    if (!dir) return;
    csv_table table = table_open(path_in(dir, "validation/starlink_v15/brdf_expected_lumos.csv"));
    brdf_lobe chassis = binomial_named("chassis"), array = binomial_named("array");
    double worst = 0.0;
    for (long row = 0; row < table.n_rows; row++) {
        double angles[4];
        row_angles(&table, row, names, angles);
        for (size_t k = 0; k < sizeof models / sizeof models[0]; k++)
            check_cell(&table, row, models[k].column,
                       f_of(models[k].model, models[k].params, angles), 1e-8, &worst);
        check_cell(&table, row, "binomial_starlink_chassis", lobe_f(&chassis, angles), 1e-8,
                   &worst);
        check_cell(&table, row, "binomial_starlink_solar_array", lobe_f(&array, angles), 1e-8,
                   &worst);
    }
    printf("another program's values: worst relative error %.2g\n", worst);
    brdf_lobe_free(&chassis);
    brdf_lobe_free(&array);
    csv_free(&table);
}
END_TEST

/* ------------------------------------------------------------- closed forms */

/* One power of D and one logarithm: f = 10^(B0 + B1 D) (1 + d^l1 D^2)^(C/2). At 30 deg on the
 * source's side D = 1. */
START_TEST(test_binomial_single_terms)
{
    const double b[] = {-1, 0.5}, c[] = {-3}, angles[4] = {30, 0, 30, 0};
    brdf_lobe lobe = binomial_of(1, 2, b, 1, c, 4, 2);
    assert_rel(lobe_f(&lobe, angles), pow(10, -0.5) * pow(17, -1.5), 1e-14);
    brdf_lobe_free(&lobe);
}
END_TEST

START_TEST(test_binomial_refuses_shapes_that_do_not_match)
{
    const double b[] = {1, 2}, c[] = {3, 4};
    brdf_lobe lobe = binomial_of(2, 1, b, 1, c, 3, 0);
    glint_error error;
    lobe.arrays[1].rows = 1;
    ck_assert_int_eq(brdf_lobe_prepare(&lobe, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "B has 2 rows and C has 1"));
    lobe.arrays[0].rows = lobe.arrays[1].rows = 17;
    ck_assert_int_eq(brdf_lobe_prepare(&lobe, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "at most 16 rows of 64"));
    brdf_lobe_free(&lobe);
}
END_TEST

/* Dielectric at normal incidence: F = ((n-1)/(n+1))^2; conductor: ((n-1)^2+k^2)/((n+1)^2+k^2).
 * Cook-Torrance there: D = 1/(pi m^2), G = 1, g = s D F/4. */
START_TEST(test_cook_torrance_normal_incidence_is_fresnel)
{
    const double up[3] = {0, 0, 1}, m = 0.3;
    for (double k = 0; k < 8; k += 1.7) {
        const double params[] = {0, 1, m, 0.8, k};
        double coef[BRDF_MAX_COEF];
        prepare("cook-torrance", params, coef);
        const double f = (0.2 * 0.2 + k * k) / (1.8 * 1.8 + k * k);
        assert_rel(brdf_model_named("cook-torrance")->eval(coef, up, up), f / (4 * PI * m * m),
                   1e-14);
    }
}
END_TEST

/* At Brewster's angle, tan u = n, a dielectric reflects no p light: F = ((n^2-1)/(n^2+1))^2/2. In
 * the mirror direction hz = 1, D = 1/(pi a^2), and a lobe of small a has G = 1: g = F/(4 pi a^2) to
 * a^2. */
START_TEST(test_ggx_mirror_direction_at_brewster_angle)
{
    const double n = 1.5, a = 1e-6, theta = atan(n);
    const double params[] = {0, 1, a, a, n, 0};
    const double i[3] = {sin(theta), 0, cos(theta)}, r[3] = {-sin(theta), 0, cos(theta)};
    double coef[BRDF_MAX_COEF];
    prepare("ggx", params, coef);
    const double q = (n * n - 1) / (n * n + 1), want = 0.5 * q * q / (4 * PI * a * a);
    assert_rel(brdf_model_named("ggx")->eval(coef, i, r), want, 1e-11);
}
END_TEST

/* An index below 1 without absorption reflects everything past the critical angle, sin u = n. */
START_TEST(test_fresnel_total_reflection_past_critical_angle)
{
    const double theta = 60 * DEG, m = 0.3, params[] = {0, 1, m, 0.8, 0};
    const double i[3] = {sin(theta), 0, cos(theta)}, r[3] = {-sin(theta), 0, cos(theta)};
    double coef[BRDF_MAX_COEF];
    prepare("cook-torrance", params, coef);
    assert_rel(brdf_model_named("cook-torrance")->eval(coef, i, r), 1 / (4 * PI * m * m), 1e-14);
}
END_TEST

/* Smooth walls make Oren-Nayar Lambert's; k = 1 makes Minnaert Lambert's; n = 0 makes Phong's lobe
 * Lambert's within 90 deg of the mirror direction. */
START_TEST(test_brdf_diffuse_limits_are_lambert)
{
    const double angles[4] = {35, 10, 50, 250}, smooth[] = {0.4, 0}, even[] = {0.4, 1};
    const double flat[] = {0.1, 0.3, 0};
    assert_rel(f_of("oren-nayar", smooth, angles), 0.4 / PI, 1e-14);
    assert_rel(f_of("minnaert", even, angles), 0.4 / PI, 1e-14);
    assert_rel(f_of("phong", flat, angles), 0.4 / PI, 1e-14);
}
END_TEST

/* A powder of forward-peaked grains without surge or multiple scattering: w so small that H = 1
 * leaves f = w/(4 pi)/(ci+cr) (1-b^2)/(1+2b cos a+b^2)^1.5; the terms left out are of the order
 * w/P, 2e-14 here. */
START_TEST(test_hapke_single_scattering_limit)
{
    for (int k = 0; k < 3; k++) {
        const double b = (double[]){-0.9, 0.0, 0.9}[k], params[] = {1e-15, b, 0, 1};
        const double i[3] = {0.6, 0, 0.8}, r[3] = {0, 0.8, 0.6}; /* cos a = 0.48 */
        double coef[BRDF_MAX_COEF];
        prepare("hapke", params, coef);
        const double phase = (1 - b * b) / pow(1 + 2 * b * 0.48 + b * b, 1.5);
        const double want = 1e-15 / (4 * PI) / 1.4 * phase * 0.48;
        assert_rel(brdf_model_named("hapke")->eval(coef, i, r), want, 1e-13);
    }
}
END_TEST

/* In the peak A/B; where |beta - beta0| = 1, A/(B + 1) whatever g is. */
START_TEST(test_abg_peak_and_unit_distance)
{
    const double params[] = {0, 0.02, 1e-6, 1.7};
    const double mirror[4] = {40, 0, 40, 180}, unit[4] = {30, 0, 30, 0}, normal[4] = {0, 0, 0, 0};
    assert_rel(f_of("abg", params, mirror), 0.02 / 1e-6, 1e-12);
    assert_rel(f_of("abg", params, normal), 0.02 / 1e-6, 1e-14);
    assert_rel(f_of("abg", params, unit), 0.02 / (1e-6 + 1), 1e-14);
}
END_TEST

/* ------------------------------------------------------------------- mirrors */

static double mirrored(const double params[3], double theta_deg)
{
    const brdf_model *mirror = brdf_model_named("mirror");
    double coef[BRDF_MAX_COEF];
    prepare("mirror", params, coef);
    return mirror->specular(coef, cos(theta_deg * DEG));
}

/* Without n the share holds at every incidence; g is 0 also in the mirror direction. */
START_TEST(test_mirror_reflectance_without_index_is_its_share)
{
    const double params[] = {0.85, PARAM_NONE, PARAM_NONE};
    for (double theta_deg = 0; theta_deg < 90; theta_deg += 7)
        assert_near(mirrored(params, theta_deg), 0.85, 0);
    const double angles[4] = {40, 0, 40, 180}, beside[4] = {40, 10, 20, 60};
    assert_near(f_of("mirror", params, angles), 0, 0);
    assert_near(f_of("mirror", params, beside), 0, 0);
}
END_TEST

/* Glass: ((n-1)/(n+1))^2 at normal incidence; at Brewster's angle atan(n) nothing of the one
 * polarisation, and ((n^2-1)/(n^2+1))^2 of the other. Aluminium at normal incidence:
 * ((n-1)^2 + k^2)/((n+1)^2 + k^2). At grazing incidence all is reflected. */
START_TEST(test_mirror_reflectance_with_index_is_fresnel)
{
    const double glass[] = {1, 1.5, PARAM_NONE}, half[] = {0.5, 1.5, PARAM_NONE};
    const double metal[] = {1, 0.96, 6.69};
    assert_rel(mirrored(glass, 0), 0.04, 1e-14);
    assert_rel(mirrored(half, 0), 0.02, 1e-14);
    const double brewster = 1.25 / 3.25;
    assert_rel(mirrored(glass, atan(1.5) / DEG), 0.5 * brewster * brewster, 1e-14);
    const double k2 = 6.69 * 6.69;
    assert_rel(mirrored(metal, 0), (0.04 * 0.04 + k2) / (1.96 * 1.96 + k2), 1e-14);
    assert_rel(mirrored(glass, 89.9999), 1, 1e-4);
    assert_rel(mirrored(metal, 89.9999), 1, 1e-4);
}
END_TEST

/* No tilt is too small to change what a mirror shows; without a weight it shows nothing. */
START_TEST(test_mirror_is_sharper_than_any_lobe)
{
    brdf_lobe lobes[2] = {
        {.model = brdf_model_named("mirror"), .weight = 1, .params = {1, PARAM_NONE, PARAM_NONE}},
        {.model = brdf_model_named("lambert"), .weight = 1, .params = {0.5}}};
    for (int k = 0; k < 2; k++)
        ck_assert_int_eq(brdf_lobe_prepare(&lobes[k], NULL), GLINT_OK);
    const brdf_material both = {.n_lobes = 2, .lobes = lobes};
    assert_near(brdf_material_width(&both), 0, 0);
    lobes[0].weight = 0;
    ck_assert(brdf_material_width(&both) == HUGE_VAL);
}
END_TEST

START_TEST(test_mirror_refuses_absorption_without_index)
{
    double coef[BRDF_MAX_COEF];
    glint_error error;
    const double params[] = {1, PARAM_NONE, 3};
    ck_assert_int_eq(brdf_model_named("mirror")->prepare(params, coef, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "k without n"));
}
END_TEST

/* ----------------------------------------------------------- Ward parameters */

START_TEST(test_ward_wavelength_factor_divides_slopes)
{
    const double angles[4] = {40, 20, 45, 190};
    const double with[] = {0.1, 0.5, 0.3, 0.15, 0.14, 10.6};
    const double without[] = {0.1, 0.5, 0.3 / 1.484, 0.15 / 1.484, PARAM_NONE, PARAM_NONE};
    assert_rel(f_of("ward", with, angles), f_of("ward", without, angles), 1e-13);
}
END_TEST

START_TEST(test_ward_refuses_half_a_wavelength_factor)
{
    const double k_only[] = {0.1, 0.5, 0.3, 0.15, 0.14, PARAM_NONE};
    const double lambda_only[] = {0.1, 0.5, 0.3, 0.15, PARAM_NONE, 10.6};
    double coef[BRDF_MAX_COEF];
    glint_error error;
    for (size_t k = 0; brdf_model_at(k); k++) {
        const brdf_model *model = brdf_model_at(k);
        if (!(model->flags & BRDF_WAVELENGTH)) continue;
        ck_assert_int_eq(model->prepare(k_only, coef, &error), GLINT_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, "k_per_um without wavelength_um"));
        ck_assert_int_eq(model->prepare(lambda_only, coef, &error), GLINT_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, "wavelength_um without k_per_um"));
    }
}
END_TEST

START_TEST(test_ward_refuses_scaled_slope_out_of_range)
{
    const double wide[] = {0.1, 0.5, 5, 0.15, 0.1, 0.5}, narrow[] = {0.1, 0.5, 0.3, 1e-5, 1, 100};
    double coef[BRDF_MAX_COEF];
    glint_error error;
    ck_assert_int_eq(brdf_model_named("ward")->prepare(wide, coef, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "alpha_x"));
    ck_assert_int_eq(brdf_model_named("ward")->prepare(narrow, coef, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "alpha_y"));
}
END_TEST

/* ------------------------------------------------------------------ materials */

static brdf_lobe lobe_of(const char *name, double weight, const double *params)
{
    brdf_lobe lobe = {.model = brdf_model_named(name), .weight = weight};
    memcpy(lobe.params, params, (size_t)lobe.model->n_params * sizeof *params);
    prepare(name, params, lobe.coef);
    return lobe;
}

static brdf_material two_lobes(double weight, double alpha)
{
    brdf_material material = {.n_lobes = 2, .lobes = malloc(2 * sizeof(brdf_lobe))};
    ck_assert_ptr_nonnull(material.lobes);
    material.lobes[0] = lobe_of("lambert", weight, (double[]){0.3});
    material.lobes[1] =
        lobe_of("ward", 0.5, (double[]){0.1, 0.4, alpha, 0.2, PARAM_NONE, PARAM_NONE});
    return material;
}

START_TEST(test_material_is_weighted_sum_of_lobes)
{
    brdf_material material = two_lobes(0.25, 0.1);
    const double i[3] = {0.6, 0, 0.8}, r[3] = {-0.48, 0.64, 0.6};
    const double want = 0.25 * brdf_model_named("lambert")->eval(material.lobes[0].coef, i, r) +
                        0.5 * brdf_model_named("ward")->eval(material.lobes[1].coef, i, r);
    assert_rel(brdf_material_eval(&material, i, r), want, 1e-15);
    brdf_material_free(&material);
    ck_assert_ptr_null(material.lobes);
    ck_assert_int_eq(material.n_lobes, 0);
    brdf_material_free(NULL);
}
END_TEST

START_TEST(test_material_same_compares_function_not_place)
{
    brdf_material a = two_lobes(0.25, 0.1), b = two_lobes(0.25, 0.1), weight = two_lobes(0.26, 0.1);
    brdf_material parameter = two_lobes(0.25, 0.11), shorter = two_lobes(0.25, 0.1);
    shorter.n_lobes = 1;
    ck_assert(brdf_material_same(&a, &b));
    ck_assert(!brdf_material_same(&a, &weight));
    ck_assert(!brdf_material_same(&a, &parameter));
    ck_assert(!brdf_material_same(&a, &shorter));
    brdf_lobe chassis = binomial_named("chassis"), again = binomial_named("chassis");
    brdf_lobe array = binomial_named("array");
    array.params[3] = chassis.params[3];
    const brdf_material x = {1, &chassis}, y = {1, &again}, z = {1, &array};
    ck_assert(brdf_material_same(&x, &y));
    ck_assert(!brdf_material_same(&x, &z));
    brdf_lobe_free(&chassis);
    brdf_lobe_free(&again);
    brdf_lobe_free(&array);
    brdf_material *const all[] = {&a, &b, &weight, &parameter, &shorter};
    for (int k = 0; k < 5; k++)
        brdf_material_free(all[k]);
}
END_TEST

/* ---------------------------------------------------------------- public face */

START_TEST(test_brdf_public_table_lists_every_model)
{
    size_t k = 0;
    for (; brdf_model_at(k); k++) {
        const brdf_model *model = brdf_model_at(k);
        ck_assert_ptr_eq(glint_brdf_name(k), model->name);
        ck_assert_ptr_eq(glint_brdf_doc(k), model->doc);
        ck_assert_ptr_eq(glint_brdf_source(k), model->source);
        glint_brdf_param param;
        for (int j = 0; j < model->n_params; j++) {
            ck_assert(glint_brdf_parameter(k, (size_t)j, &param));
            ck_assert_ptr_eq(param.name, model->params[j].name);
            ck_assert(param.required == param_is_required(&model->params[j]));
            ck_assert(param.min_open == ((model->params[j].flags & PARAM_MIN_OPEN) != 0));
            ck_assert(param.max_open == ((model->params[j].flags & PARAM_MAX_OPEN) != 0));
            ck_assert_int_eq(param.dimensions, model->params[j].flags & PARAM_ROWS ? 2 : 0);
        }
        ck_assert(!glint_brdf_parameter(k, (size_t)model->n_params, &param));
    }
    ck_assert_ptr_null(glint_brdf_name(k));
    ck_assert_ptr_null(glint_brdf_doc(k));
    ck_assert_ptr_null(glint_brdf_source(k));
    ck_assert(!glint_brdf_parameter(k, 0, &(glint_brdf_param){0}));
}
END_TEST

START_TEST(test_brdf_optional_parameter_is_not_required)
{
    const brdf_model *ward = brdf_model_named("ward"), *ggx = brdf_model_named("ggx");
    ck_assert_str_eq(ward->params[4].name, "k_per_um");
    ck_assert(!param_is_required(&ward->params[4]));
    ck_assert(isnan(ward->params[4].def));
    ck_assert(param_is_required(&ward->params[0]));
    ck_assert_str_eq(ggx->params[5].name, "k");
    ck_assert(!param_is_required(&ggx->params[5]));
    assert_near(ggx->params[5].def, 0.0, 0.0);
}
END_TEST

START_TEST(test_brdf_model_named_unknown_is_null)
{
    ck_assert_ptr_null(brdf_model_named("Lambert"));
    ck_assert_ptr_null(brdf_model_named(""));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("brdf");
    TCase *reference = tcase_create("reference");
    tcase_add_test(reference, test_ward_matches_reference_in_plane);
    tcase_add_test(reference, test_ward_matches_reference_out_of_plane);
    tcase_add_test(reference, test_ward_matches_reference_at_spots);
    tcase_add_test(reference, test_ward_peaks_match_reference);
    tcase_add_test(reference, test_ward_peak_ratio_of_published_materials);
    tcase_add_test(reference, test_brdf_other_models_match_reference);
    tcase_add_test(reference, test_binomial_matches_reference);
    tcase_add_test(reference, test_brdf_matches_values_of_another_program);
    suite_add_tcase(suite, reference);
    TCase *closed = tcase_create("closed forms");
    tcase_add_test(closed, test_cook_torrance_normal_incidence_is_fresnel);
    tcase_add_test(closed, test_ggx_mirror_direction_at_brewster_angle);
    tcase_add_test(closed, test_fresnel_total_reflection_past_critical_angle);
    tcase_add_test(closed, test_brdf_diffuse_limits_are_lambert);
    tcase_add_test(closed, test_hapke_single_scattering_limit);
    tcase_add_test(closed, test_abg_peak_and_unit_distance);
    tcase_add_test(closed, test_mirror_reflectance_without_index_is_its_share);
    tcase_add_test(closed, test_mirror_reflectance_with_index_is_fresnel);
    tcase_add_test(closed, test_mirror_is_sharper_than_any_lobe);
    tcase_add_test(closed, test_mirror_refuses_absorption_without_index);
    tcase_add_test(closed, test_binomial_single_terms);
    tcase_add_test(closed, test_binomial_refuses_shapes_that_do_not_match);
    suite_add_tcase(suite, closed);
    TCase *face = tcase_create("parameters and table");
    tcase_add_test(face, test_ward_wavelength_factor_divides_slopes);
    tcase_add_test(face, test_ward_refuses_half_a_wavelength_factor);
    tcase_add_test(face, test_ward_refuses_scaled_slope_out_of_range);
    tcase_add_test(face, test_material_is_weighted_sum_of_lobes);
    tcase_add_test(face, test_material_same_compares_function_not_place);
    tcase_add_test(face, test_brdf_public_table_lists_every_model);
    tcase_add_test(face, test_brdf_optional_parameter_is_not_required);
    tcase_add_test(face, test_brdf_model_named_unknown_is_null);
    suite_add_tcase(suite, face);
    return run_suite(suite);
}
