/* Materials through the public header: reading, values, reflectance, peaks, tables. */
#include "scenario_text.h"
#include "table.h"

#include "base/constants.h"

/* ------------------------------------------------------------------ helpers */

static const char HUANG[] = SCENARIO_DIR "/materials/huang2013.toml";

/* Reads a material that must be right. glint_material_free ends it. */
static glint_material *read_good(const char *path, const char *name, const char *band)
{
    glint_material *material;
    glint_errors *errors = glint_errors_new();
    const glint_status status = glint_material_read(path, name, band, &material, errors);
    ck_assert_msg(status == GLINT_OK, "%s:%s:%s", path, name, list_errors(errors));
    ck_assert_uint_eq(glint_errors_error_count(errors), 0);
    glint_errors_free(errors);
    return material;
}

/* Reads a material that must be refused, with an error at that line of a file that holds the text,
 * and n errors in all. */
static void assert_refused_material(const char *path, const char *name, const char *band,
                                    glint_status wanted, const char *file, int line,
                                    const char *text, size_t n)
{
    glint_material *material = (glint_material *)folder; /* must be cleared */
    glint_errors *errors = glint_errors_new();
    const glint_status status = glint_material_read(path, name, band, &material, errors);
    bool found = false;
    for (size_t k = 0; k < glint_errors_count(errors); k++) {
        const glint_error *e = glint_errors_get(errors, k);
        found = found || (e->severity == GLINT_ERROR && strcmp(e->file, file) == 0 &&
                          e->line == line && strstr(e->message, text));
    }
    ck_assert_int_eq(status, wanted);
    ck_assert_ptr_null(material);
    ck_assert_msg(found, "wanted %s:%d: ... %s; got:%s", file, line, text, list_errors(errors));
    ck_assert_uint_eq(glint_errors_error_count(errors), n);
    glint_errors_free(errors);
    ck_assert_int_eq(glint_material_read(path, name, band, &material, NULL), wanted);
}

/* f, 1/sr, at angles in deg. */
static double f_of(const glint_material *material, double theta_i, double phi_i, double theta_r,
                   double phi_r)
{
    double f = -1;
    glint_error error = {0};
    const glint_status status = glint_material_brdf(material, theta_i * DEG, phi_i * DEG,
                                                    theta_r * DEG, phi_r * DEG, &f, &error);
    ck_assert_msg(status == GLINT_OK, "%s", error.message);
    return f;
}

/* Writes the three Ward forms with a row's parameters as materials "ward", "ward-duer", "ward-gmd".
 */
static const char *write_wards(const csv_table *table, long row)
{
    static const char *const FORMS[] = {"ward", "ward-duer", "ward-gmd"};
    char text[2048] = "";
    for (int k = 0; k < 3; k++) {
        const size_t n = strlen(text);
        snprintf(text + n, sizeof text - n,
                 "[materials.%s]\nbrdf = \"%s\"\nrho_d = %s\nrho_s = %s\nalpha_x = %s\n"
                 "alpha_y = %s\nk_per_um = %s\nwavelength_um = %s\n",
                 FORMS[k], FORMS[k], table_text(table, row, "rho_d"),
                 table_text(table, row, "rho_s"), table_text(table, row, "ax"),
                 table_text(table, row, "ay"), table_text(table, row, "k_per_um"),
                 table_text(table, row, "lambda_um"));
    }
    return write_file("wards.toml", text);
}

/* ----------------------------------------------------------- reference values */

/* As in test_brdf.c: an exponent of up to 100 makes 1e-13 of the 1e-16 by which angles err. */
static const double ROUNDING = 1e-13;

static void check_wards(const char *path)
{
    static const char *const COLUMNS[][2] = {
        {"ward", "f_seed_eq6"}, {"ward-duer", "f_duer2006"}, {"ward-gmd", "f_gmd2010"}};
    csv_table table = table_open(path);
    glint_material *materials[3] = {NULL};
    double worst = 0;
    for (long row = 0; row < table.n_rows; row++) {
        const bool is_new = row == 0 || strcmp(table_text(&table, row, "case"),
                                               table_text(&table, row - 1, "case")) != 0;
        const char *file = is_new ? write_wards(&table, row) : NULL;
        for (int k = 0; k < 3; k++) {
            if (is_new) {
                glint_material_free(materials[k]);
                materials[k] = read_good(file, COLUMNS[k][0], NULL);
            }
            const double got = f_of(materials[k], table_number(&table, row, "theta_i_deg"),
                                    table_number(&table, row, "phi_i_deg"),
                                    table_number(&table, row, "theta_r_deg"),
                                    table_number(&table, row, "phi_r_deg"));
            const double want = table_number(&table, row, COLUMNS[k][1]);
            assert_rel(got, want, ROUNDING);
            worst = fmax(worst, fabs(got / want - 1));
        }
    }
    printf("%s: worst relative error %.2g\n", path, worst);
    for (int k = 0; k < 3; k++)
        glint_material_free(materials[k]);
    csv_free(&table);
}

START_TEST(test_material_brdf_matches_reference)
{
    table_check(check_wards, "brdf/golden_in_plane.csv");
    table_check(check_wards, "brdf/golden_out_of_plane.csv");
}
END_TEST

static void check_published(const char *path)
{
    static const char *const NAMES[][2] = {{"panel", "solar-panel"}, {"mli", "mli"}};
    csv_table table = table_open(path);
    int compared = 0;
    for (int k = 0; k < 2; k++) {
        glint_material *material = read_good(HUANG, NAMES[k][1], NULL);
        for (long row = 0; row < table.n_rows; row++) {
            if (strcmp(table_text(&table, row, "case"), NAMES[k][0]) != 0) continue;
            assert_rel(f_of(material, table_number(&table, row, "theta_i_deg"),
                            table_number(&table, row, "phi_i_deg"),
                            table_number(&table, row, "theta_r_deg"),
                            table_number(&table, row, "phi_r_deg")),
                       table_number(&table, row, "f_seed_eq6"), ROUNDING);
            compared++;
        }
        glint_material_free(material);
    }
    ck_assert_int_ge(compared, 10);
    csv_free(&table);
}

START_TEST(test_material_file_that_ships_holds_the_published_materials)
{
    table_check(check_published, "brdf/golden_in_plane.csv");
}
END_TEST

/* What is published of mirrors: reflectances of metals at normal incidence, to three digits, and
 * the shares of sunlight that navigation satellites absorb and mirror. */
START_TEST(test_material_files_that_ship_hold_the_published_mirrors)
{
    static const char METALS[] = SCENARIO_DIR "/materials/metals.toml",
                      NAVIGATION[] = SCENARIO_DIR "/materials/navigation.toml";
    static const struct {
        const char *path, *name;
        double mirrored, reflected;
    } published[] = {{METALS, "aluminium-mirror", 0.921, 0.921},
                     {METALS, "silver-mirror", 0.960, 0.960},
                     {METALS, "gold-mirror", 0.848, 0.848},
                     {NAVIGATION, "galileo-foc-a", 0.00, 0.07},
                     {NAVIGATION, "galileo-foc-b", 0.22, 0.43},
                     {NAVIGATION, "galileo-foc-c", 0.73, 0.92},
                     {NAVIGATION, "galileo-foc-array-d", 0.10, 0.10},
                     {NAVIGATION, "galileo-foc-array-e", 0.08, 0.08},
                     {NAVIGATION, "gps-ii-body", 0.20 * 0.56, 0.56},
                     {NAVIGATION, "gps-ii-panel", 0.85 * 0.23, 0.23},
                     {NAVIGATION, "gps-iir-panel", 0.85 * 0.28, 0.28}};
    for (size_t k = 0; k < COUNT_OF(published); k++) {
        glint_material *m = read_good(published[k].path, published[k].name, NULL);
        double dhr;
        assert_near(glint_material_mirrored(m, 0), published[k].mirrored, 5e-4);
        ck_assert_int_eq(glint_material_dhr(m, 0, 0, &dhr, NULL, NULL), GLINT_OK);
        assert_near(dhr, published[k].reflected, 5e-4);
        glint_material_free(m);
    }
}
END_TEST

static void check_reflectance(const char *path)
{
    static const char *const NAMES[][2] = {{"panel", "solar-panel"}, {"mli", "mli"}};
    csv_table table = table_open(path);
    int compared = 0;
    for (int k = 0; k < 2; k++) {
        glint_material *material = read_good(HUANG, NAMES[k][1], NULL);
        for (long row = 0; row < table.n_rows; row++) {
            const double theta_i_deg = table_number(&table, row, "theta_i_deg");
            double dhr, bound;
            if (strcmp(table_text(&table, row, "case"), NAMES[k][0]) != 0 || theta_i_deg > 88)
                continue;
            ck_assert_int_eq(glint_material_dhr(material, theta_i_deg * DEG, 0, &dhr, &bound, NULL),
                             GLINT_OK);
            const double want = table_number(&table, row, "total_seed_eq6");
            assert_rel(dhr, want, 1e-8);
            ck_assert_msg(fabs(dhr - want) <= bound + 1e-12, "off %g, bound %g", dhr - want, bound);
            compared++;
        }
        glint_material_free(material);
    }
    ck_assert_int_ge(compared, 4);
    csv_free(&table);
}

START_TEST(test_material_dhr_matches_reference)
{
    table_check(check_reflectance, "brdf/dhr.csv");
}
END_TEST

/* ---------------------------------------------------------------------- peaks */

/* f of the file holds to 1e-9. Around its maximum f falls by (distance / width)^2: an error of
 * 1e-16 of it is one of 1e-8 of the width (some deg), and the search says 1e-7 rad = 6e-6 deg. */
static void check_peaks(const char *path)
{
    static const char *const FORMS[][2] = {
        {"seed", "ward"}, {"duer", "ward-duer"}, {"gmd", "ward-gmd"}};
    static const char *const CASES[][2] = {{"panel", "0.17"}, {"mli", "0.1"}};
    csv_table table = table_open(path);
    double worst_f = 0, worst_deg = 0;
    int compared = 0;
    for (long row = 0; row < table.n_rows; row++) {
        const bool is_panel = strcmp(table_text(&table, row, "case"), CASES[0][0]) == 0;
        for (int k = 0; k < 3; k++) {
            if (strcmp(table_text(&table, row, "model"), FORMS[k][0]) != 0) continue;
            char text[512];
            snprintf(text, sizeof text,
                     "[materials.m]\nbrdf = \"%s\"\nrho_d = %s\nrho_s = %s\nalpha_x = %s\n"
                     "alpha_y = %s\nk_per_um = 0.14\nwavelength_um = 10.6\n",
                     FORMS[k][1], CASES[!is_panel][1], is_panel ? "0.7" : "0.75",
                     is_panel ? "0.12" : "0.06", is_panel ? "0.12" : "0.06");
            glint_material *m = read_good(write_file("peak.toml", text), "m", NULL);
            double theta_r, f;
            ck_assert(glint_material_peak(m, table_number(&table, row, "theta_i_deg") * DEG, 0.3,
                                          &theta_r, &f));
            const double want_f = table_number(&table, row, "f_peak");
            const double want_deg = table_number(&table, row, "theta_r_of_in_plane_peak_deg");
            assert_rel(f, want_f, 1e-9);
            assert_near(theta_r / DEG, want_deg, 1e-5);
            worst_f = fmax(worst_f, fabs(f / want_f - 1));
            worst_deg = fmax(worst_deg, fabs(theta_r / DEG - want_deg));
            glint_material_free(m);
            compared++;
        }
    }
    printf("%s: worst relative error %.2g, worst place %.2g deg\n", path, worst_f, worst_deg);
    ck_assert_int_ge(compared, 9);
    csv_free(&table);
}

START_TEST(test_material_peak_matches_reference)
{
    table_check(check_peaks, "brdf/peaks.csv");
}
END_TEST

/* The paper has "about 4 times". At normal incidence the peak is rho_d/pi + rho_s/(4 pi a'^2) with
 * a' = a/1.484. */
START_TEST(test_material_peak_of_mli_is_four_times_that_of_the_panel)
{
    glint_material *panel = read_good(HUANG, "solar-panel", NULL);
    glint_material *mli = read_good(HUANG, "mli", NULL);
    double theta_r, f_panel, f_mli;
    ck_assert(glint_material_peak(panel, 0, 0, &theta_r, &f_panel));
    assert_near(theta_r / DEG, 0, 1e-5);
    ck_assert(glint_material_peak(mli, 0, 0, &theta_r, &f_mli));
    assert_near(theta_r / DEG, 0, 1e-5);
    const double a = 0.12 / 1.484, b = 0.06 / 1.484;
    assert_rel(f_panel, (0.17 + 0.7 / (4 * a * a)) / PI, 1e-14);
    assert_rel(f_mli, (0.1 + 0.75 / (4 * b * b)) / PI, 1e-14);
    assert_near(f_mli / f_panel, 4.2624, 0.00005);
    glint_material_free(panel);
    glint_material_free(mli);
}
END_TEST

START_TEST(test_material_peak_of_a_flat_surface_is_in_the_mirror_direction)
{
    const char *path = write_file("m.toml", "[materials.white]\nbrdf = \"lambert\"\nrho = 0.5\n"
                                            "[materials.black]\nbrdf = \"lambert\"\nrho = 0\n"
                                            "[materials.rim]\nbrdf = \"minnaert\"\nrho = 0.5\n"
                                            "k = 0.5\n");
    glint_material *white = read_good(path, "white", NULL), *black = read_good(path, "black", NULL);
    glint_material *rim = read_good(path, "rim", NULL);
    double theta_r, f;
    ck_assert(glint_material_peak(white, 0.7, 0, &theta_r, &f));
    assert_near(theta_r, 0.7, 1e-15);
    assert_rel(f, 0.5 / PI, 1e-15);
    /* (ci cr)^-0.5 rises as far as the horizon */
    ck_assert(!glint_material_peak(rim, 0.7, 0, &theta_r, &f));
    ck_assert(!glint_material_peak(black, 0.7, 0, &theta_r, &f));
    ck_assert(!glint_material_peak(white, PI / 2, 0, &theta_r, &f));
    ck_assert(!glint_material_peak(white, (double)NAN, 0, &theta_r, &f));
    ck_assert(!glint_material_peak(white, 0, (double)INFINITY, &theta_r, &f));
    glint_material_free(white);
    glint_material_free(black);
    glint_material_free(rim);
}
END_TEST

/* ---------------------------------------------------------------------- values */

START_TEST(test_material_brdf_is_zero_from_the_horizon_down)
{
    glint_material *panel = read_good(HUANG, "solar-panel", NULL);
    static const double BELOW_DEG[] = {90, 91, 135, 180, -90, -100, 269};
    for (size_t k = 0; k < COUNT_OF(BELOW_DEG); k++) {
        ck_assert(f_of(panel, BELOW_DEG[k], 0, 30, 180) == 0);
        ck_assert(f_of(panel, 30, 0, BELOW_DEG[k], 180) == 0);
        ck_assert(f_of(panel, BELOW_DEG[k], 0, BELOW_DEG[k], 180) == 0);
    }
    ck_assert(f_of(panel, 0, 0, 89.999, 0) > 0);
    ck_assert(f_of(panel, 30, 0, 390, 180) > 0); /* a full turn more */
    glint_material_free(panel);
}
END_TEST

/* In the mirror direction f has sqrt(ci cr) = 1e-11 below the fraction line. The 1e-16 by which the
 * directions err tilt H, which is 2e-11 long, by 6e-6: the square of that over a' is 6e-9. */
START_TEST(test_material_brdf_near_the_horizon_is_large_and_finite)
{
    glint_material *panel = read_good(HUANG, "solar-panel", NULL);
    const double theta_i = acos(1e-11);
    double f;
    ck_assert_int_eq(glint_material_brdf(panel, theta_i, 0, theta_i, PI, &f, NULL), GLINT_OK);
    const double c = cos(theta_i), a = 0.12 / 1.484;
    assert_rel(f, (0.17 + 0.7 / (4 * a * a * c)) / PI, 1e-7);
    glint_material_free(panel);
}
END_TEST

START_TEST(test_material_brdf_takes_negative_zenith_angles_for_the_other_side)
{
    glint_material *mli = read_good(HUANG, "mli", NULL);
    for (double theta = 1; theta < 90; theta += 8) {
        const double other_side = f_of(mli, 30, 20, theta, 200);
        assert_rel(f_of(mli, 30, 20, -theta, 20), other_side, 1e-11);
        assert_rel(f_of(mli, -30, 200, theta, 200), other_side, 1e-11);
    }
    glint_material_free(mli);
}
END_TEST

START_TEST(test_material_angles_that_are_not_finite_are_refused)
{
    glint_material *mli = read_good(HUANG, "mli", NULL);
    static const double BAD[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    for (size_t k = 0; k < COUNT_OF(BAD); k++)
        for (int which = 0; which < 4; which++) {
            double angles[4] = {0.1, 0.2, 0.3, 0.4}, f = -1;
            angles[which] = BAD[k];
            glint_error error = {0};
            ck_assert_int_eq(
                glint_material_brdf(mli, angles[0], angles[1], angles[2], angles[3], &f, &error),
                GLINT_ARGUMENT);
            ck_assert_ptr_nonnull(strstr(error.message, "finite"));
            if (which < 2)
                ck_assert_int_eq(glint_material_dhr(mli, angles[0], angles[1], &f, NULL, NULL),
                                 GLINT_ARGUMENT);
        }
    double dhr;
    ck_assert_int_eq(glint_material_dhr(mli, PI / 2, 0, &dhr, NULL, NULL), GLINT_ARGUMENT);
    ck_assert_int_eq(glint_material_dhr(mli, -0.1, 0, &dhr, NULL, NULL), GLINT_ARGUMENT);
    glint_material_free(mli);
}
END_TEST

START_TEST(test_material_of_parts_is_their_weighted_sum)
{
    const char *path =
        write_file("m.toml", "[materials.both]\nbrdf = \"sum\"\nsource = \"made up\"\nparts = [\n"
                             "  { weight = 0.5, brdf = \"lambert\", rho = 0.4 },\n"
                             "  { weight = 2, brdf = \"lambert\", rho = 0.1 } ]\n");
    glint_material *both = read_good(path, "both", NULL);
    assert_rel(f_of(both, 10, 0, 50, 70), 0.4 / PI, 1e-14);
    double dhr;
    ck_assert_int_eq(glint_material_dhr(both, 0.3, 0, &dhr, NULL, NULL), GLINT_OK);
    assert_rel(dhr, 0.4, 1e-8);
    ck_assert_str_eq(glint_material_name(both), "both");
    ck_assert_str_eq(glint_material_source(both), "made up");
    ck_assert_str_eq(glint_material_band(both), "");
    ck_assert_str_eq(glint_material_model(both), "0.5 * lambert rho=0.4 + 2 * lambert rho=0.1");
    glint_material_free(both);
}
END_TEST

static const char MIRROR[] = "[materials.glass]\nbrdf = \"sum\"\nparts = [\n"
                             "  { weight = 0.5, brdf = \"mirror\", R = 1, n = 1.5 },\n"
                             "  { brdf = \"lambert\", rho = 0.1 } ]\n";

/* Light that is mirrored is in the reflectance, not in f; 0.04: ((n-1)/(n+1))^2. */
START_TEST(test_material_that_mirrors_says_how_much)
{
    glint_material *glass = read_good(write_file("m.toml", MIRROR), "glass", NULL);
    assert_rel(glint_material_mirrored(glass, 0), 0.02, 1e-14);
    assert_rel(f_of(glass, 30, 0, 30, 180), 0.1 / PI, 1e-14);
    double dhr;
    ck_assert_int_eq(glint_material_dhr(glass, 0, 0, &dhr, NULL, NULL), GLINT_OK);
    assert_rel(dhr, 0.12, 1e-8);
    const double nowhere[] = {-0.1, PI / 2, 2, NAN, INFINITY};
    for (size_t k = 0; k < COUNT_OF(nowhere); k++)
        assert_near(glint_material_mirrored(glass, nowhere[k]), 0, 0);
    glint_material_free(glass);
}
END_TEST

START_TEST(test_material_table_says_what_f_leaves_out)
{
    glint_material *glass = read_good(write_file("m.toml", MIRROR), "glass", NULL);
    const glint_material *const all[] = {glass};
    static const double THETA_DEG[] = {0};
    glint_material_view view = {
        .kind = GLINT_VIEW_PLANE, .theta_i_deg = THETA_DEG, .n_theta_i = 1, .step_deg = 10};
    for (int dhr = 0; dhr < 2; dhr++) {
        if (dhr) view.kind = GLINT_VIEW_DHR;
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(glint_material_table_write(all, 1, &view, "/dev/null", errors), GLINT_OK);
        ck_assert_uint_eq(glint_errors_count(errors), dhr ? 0 : 1);
        if (!dhr)
            ck_assert_ptr_nonnull(strstr(glint_errors_get(errors, 0)->message,
                                         "'glass' is a perfect mirror for 0.02 of the light"));
        glint_errors_free(errors);
    }
    glint_material_free(glass);
}
END_TEST

/* -------------------------------------------------------------------- reading */

static const char BANDS[] = "[materials.paint]\nbrdf = \"lambert\"\nrho = 0.5\n"
                            "[materials.paint.bands.V]\nrho = 0.2\n";

START_TEST(test_material_of_a_band_has_what_differs_in_it)
{
    const char *path = write_file("m.toml", BANDS);
    static const struct {
        const char *band;
        double rho;
    } cases[] = {{NULL, 0.5}, {"V", 0.2}, {"B", 0.5}, {"lsst_g", 0.5}};
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        glint_material *paint = read_good(path, "paint", cases[k].band);
        assert_rel(f_of(paint, 0, 0, 45, 0), cases[k].rho / PI, 1e-14);
        ck_assert_str_eq(glint_material_band(paint), cases[k].band ? cases[k].band : "");
        glint_material_free(paint);
    }
    assert_refused_material(path, "paint", "W", GLINT_ARGUMENT, "", 0, "'W' is not a band", 1);
}
END_TEST

/* The published parameters hold at 10.6 um. */
/* Keys that the band's model does not have, and the spectrum, are those of the other model. */
START_TEST(test_material_of_a_band_may_be_of_another_model)
{
    const char *path = write_file(
        "m.toml",
        "[materials.film]\nbrdf = \"ward-gmd\"\nrho_s = 0.3\nalpha_x = 0.1\n"
        "alpha_y = 0.1\nspectrum = [ { wavelength_um = 0.4, rho_d = 0.1 },\n"
        "  { wavelength_um = 0.9, rho_d = 0.2 } ]\n"
        "[materials.film.bands.V]\nbrdf = \"lambert\"\nrho = 0.4\n"
        "[materials.film.bands.R]\nbrdf = \"sum\"\n"
        "parts = [ { brdf = \"lambert\", rho = 0.1 }, { brdf = \"lambert\", rho = 0.2 } ]\n");
    static const struct {
        const char *band;
        double f;
    } cases[] = {{"V", 0.4 / PI}, {"R", 0.3 / PI}};
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        glint_material *film = read_good(path, "film", cases[k].band);
        assert_rel(f_of(film, 10, 0, 50, 70), cases[k].f, 1e-14);
        glint_material_free(film);
    }
    glint_material *film = read_good(path, "film", NULL);
    ck_assert_ptr_nonnull(strstr(glint_material_model(film), "ward-gmd"));
    glint_material_free(film);
}
END_TEST

START_TEST(test_material_far_from_where_it_holds_is_warned_of_in_a_band_alone)
{
    for (int in_band = 0; in_band < 2; in_band++) {
        glint_errors *errors = glint_errors_new();
        glint_material *panel;
        ck_assert_int_eq(
            glint_material_read(HUANG, "solar-panel", in_band ? "V" : NULL, &panel, errors),
            GLINT_OK);
        ck_assert_uint_eq(glint_errors_count(errors), (size_t)in_band);
        for (size_t k = 0; k < glint_errors_count(errors); k++) {
            ck_assert_int_eq(glint_errors_get(errors, k)->severity, GLINT_WARNING);
            ck_assert_ptr_nonnull(strstr(glint_errors_get(errors, k)->message, "10.6 um"));
        }
        glint_material_free(panel);
        glint_errors_free(errors);
    }
}
END_TEST

START_TEST(test_material_names_come_in_the_order_of_the_files)
{
    write_file("others.toml", "[materials.third]\nbrdf = \"lambert\"\nrho = 0.1\n"
                              "[materials.first]\nbrdf = \"lambert\"\nrho = 0.1\n");
    const char *path = write_file("m.toml", "materials_from = [\"others.toml\"]\n"
                                            "[materials.second]\nbrdf = \"lambert\"\nrho = 0.1\n"
                                            "[[component]]\nname = 17\n");
    const char **names;
    size_t n;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(glint_material_names(path, &names, &n, errors), GLINT_OK);
    ck_assert_uint_eq(glint_errors_count(errors), 0);
    ck_assert_uint_eq(n, 3);
    ck_assert_str_eq(names[0], "third");
    ck_assert_str_eq(names[1], "first");
    ck_assert_str_eq(names[2], "second");
    for (size_t k = 0; k < n; k++) {
        glint_material *material = read_good(path, names[k], NULL);
        ck_assert_str_eq(glint_material_name(material), names[k]);
        glint_material_free(material);
    }
    glint_free(names);
    glint_errors_free(errors);
}
END_TEST

START_TEST(test_material_is_found_in_models_and_scenarios)
{
    glint_material *m = read_good(SCENARIO_DIR "/models/box-wing.toml", "white-paint", NULL);
    assert_rel(f_of(m, 0, 0, 0, 0), 0.6 / PI, 1e-14);
    glint_material_free(m);
    m = read_good(SCENARIO_DIR "/models/box-wing.toml", "mli", NULL);
    ck_assert_str_eq(glint_material_name(m), "mli");
    glint_material_free(m);
    const marked_text whole = with_part(GIVEN, PART_TOP, GIVEN[PART_TOP]);
    m = read_good(write_file("scenario.toml", whole.text), "white", NULL);
    assert_rel(f_of(m, 0, 0, 0, 0), 0.5 / PI, 1e-14);
    glint_material_free(m);
}
END_TEST

START_TEST(test_material_that_is_not_there_suggests_the_nearest)
{
    const char *path = write_file("m.toml", BANDS);
    assert_refused_material(
        path, "paitn", NULL, GLINT_INPUT, path, 0,
        "there is no material 'paitn' (did you mean 'paint'?); expected one of: "
        "paint",
        1);
    assert_refused_material(path, "steel", NULL, GLINT_INPUT, path, 0,
                            "there is no material 'steel'; expected one of: paint", 1);
    assert_refused_material(path, "", NULL, GLINT_INPUT, path, 0, "there is no material ''", 1);
}
END_TEST

START_TEST(test_material_file_that_cannot_be_read_is_named)
{
    const char *absent = in_folder("absent.toml");
    assert_refused_material(absent, "m", NULL, GLINT_INPUT, absent, 0, "No such file", 1);
    assert_refused_material(folder, "m", NULL, GLINT_INPUT, folder, 0, "", 1);
    const char *empty = write_file("empty.toml", "title = \"nothing\"\n");
    assert_refused_material(empty, "m", NULL, GLINT_INPUT, empty, 0, "no materials here", 1);
    const char *broken = write_file("broken.toml", "[materials.m\n");
    assert_refused_material(broken, "m", NULL, GLINT_INPUT, broken, 1, "", 1);
    const char *from = write_file("from.toml", "\nmaterials_from = [\"absent.toml\"]\n"
                                               "[materials.m]\nbrdf = \"lambert\"\nrho = 1\n");
    assert_refused_material(from, "m", NULL, GLINT_INPUT, from, 2, "absent.toml", 1);
    const char **names = (const char **)(void *)folder;
    size_t n = 1;
    ck_assert_int_eq(glint_material_names(absent, &names, &n, NULL), GLINT_INPUT);
    ck_assert_ptr_null(names);
    ck_assert_uint_eq(n, 0);
}
END_TEST

START_TEST(test_material_that_is_wrong_is_refused_with_places)
{
    const char *path = write_file("m.toml", "[materials.bad]\nbrdf = \"lambert\"\nrho = 1.5\n"
                                            "colour = 3\n"
                                            "[materials.good]\nbrdf = \"lambert\"\nrho = 0.5\n"
                                            "[materials.flat]\nbrdf = \"wrad\"\n");
    assert_refused_material(path, "bad", NULL, GLINT_INPUT, path, 3, "'rho' is the number 1.5", 2);
    assert_refused_material(path, "bad", "V", GLINT_INPUT, path, 4, "unknown key 'colour'", 2);
    assert_refused_material(path, "flat", NULL, GLINT_INPUT, path, 9, "did you mean 'ward'", 1);
    glint_material_free(read_good(path, "good", NULL)); /* is right, whatever its neighbours are */
    const char *twice = write_file("twice.toml", "materials_from = [\"m.toml\"]\n"
                                                 "[materials.good]\nbrdf = \"lambert\"\nrho = 1\n");
    assert_refused_material(twice, "good", NULL, GLINT_INPUT, twice, 2, "stands twice", 1);
}
END_TEST

/* --------------------------------------------------------------------- tables */

static const double CURVES_DEG[] = {0, 15, 30, 45, 60, 75};

/* Writes what is shown of the two published materials; csv_free ends the table. */
static csv_table show(const glint_material_view *view)
{
    glint_material *pair[2] = {read_good(HUANG, "solar-panel", NULL),
                               read_good(HUANG, "mli", NULL)};
    glint_errors *errors = glint_errors_new();
    const char *path = in_folder("shown.csv");
    const glint_status status =
        glint_material_table_write((const glint_material *const *)pair, 2, view, path, errors);
    ck_assert_msg(status == GLINT_OK, "%s", list_errors(errors));
    for (int k = 0; k < 2; k++)
        glint_material_free(pair[k]);
    glint_errors_free(errors);
    return table_open(path);
}

/* Rows of the reference that the table of curves must hold: in steps of 5 deg. */
static void check_curves(const char *path)
{
    const glint_material_view view = {
        .kind = GLINT_VIEW_PLANE, .theta_i_deg = CURVES_DEG, .n_theta_i = 6, .step_deg = 5};
    csv_table got = show(&view), want = table_open(path);
    int compared = 0;
    for (long row = 0; row < want.n_rows; row++) {
        const char *name = table_text(&want, row, "case");
        const bool is_panel = strcmp(name, "panel") == 0;
        if (!is_panel && strcmp(name, "mli") != 0) continue;
        bool found = false;
        for (long at = 0; at < got.n_rows; at++) {
            if (strcmp(table_text(&got, at, "material"), is_panel ? "solar-panel" : "mli") != 0 ||
                table_number(&got, at, "theta_i_deg") != table_number(&want, row, "theta_i_deg") ||
                table_number(&got, at, "signed_theta_r_deg") !=
                    table_number(&want, row, "signed_theta_r_deg"))
                continue;
            const double f = table_number(&got, at, "f_per_sr");
            assert_rel(f, table_number(&want, row, "f_seed_eq6"), ROUNDING);
            assert_near(table_number(&got, at, "theta_r_deg"),
                        table_number(&want, row, "theta_r_deg"), 0);
            assert_rel(table_number(&got, at, "g_per_sr"),
                       f * cos(table_number(&want, row, "theta_i_deg") * DEG) *
                           cos(table_number(&want, row, "theta_r_deg") * DEG),
                       1e-14);
            found = true;
        }
        ck_assert_msg(found, "row %ld of %s is not in the table", row, path);
        compared++;
    }
    ck_assert_int_ge(compared, 10);
    /* 2 materials, 6 angles, -85 to 85 deg */
    ck_assert_int_eq(got.n_rows, 2 * 6 * 35);
    csv_free(&got);
    csv_free(&want);
}

START_TEST(test_material_table_of_curves_matches_reference)
{
    table_check(check_curves, "brdf/golden_in_plane.csv");
}
END_TEST

START_TEST(test_material_table_has_the_mirror_direction_between_steps)
{
    static const double THETA_DEG[] = {12.3};
    const glint_material_view view = {.kind = GLINT_VIEW_PLANE,
                                      .theta_i_deg = THETA_DEG,
                                      .n_theta_i = 1,
                                      .phi_i_deg = 200,
                                      .step_deg = 0.1 * 70};
    csv_table got = show(&view);
    double last_deg = -90;
    int mirrors = 0;
    for (long row = 0; row < got.n_rows / 2; row++) {
        const double theta_deg = table_number(&got, row, "signed_theta_r_deg");
        ck_assert_msg(theta_deg > last_deg, "%g after %g", theta_deg, last_deg);
        last_deg = theta_deg;
        mirrors += theta_deg == 12.3;
        assert_near(table_number(&got, row, "phi_r_deg"), theta_deg < 0 ? 200 : 20, 0);
    }
    ck_assert_int_eq(mirrors, 1);
    ck_assert_int_eq(got.n_rows, 2 * (25 + 1)); /* -84, -77 .. 84, and 12.3 */
    csv_free(&got);
}
END_TEST

/* Steps are round numbers in the table. */
START_TEST(test_material_table_steps_have_no_rounding_tails)
{
    static const double THETA_DEG[] = {0};
    const glint_material_view view = {
        .kind = GLINT_VIEW_PLANE, .theta_i_deg = THETA_DEG, .n_theta_i = 1, .step_deg = 0.1};
    csv_table got = show(&view);
    for (long row = 0; row < got.n_rows; row++)
        ck_assert_uint_le(strlen(table_text(&got, row, "signed_theta_r_deg")), 5);
    csv_free(&got);
}
END_TEST

START_TEST(test_material_table_of_a_map_covers_the_hemisphere)
{
    static const double THETA_DEG[] = {30, 41};
    const glint_material_view view = {.kind = GLINT_VIEW_HEMISPHERE,
                                      .theta_i_deg = THETA_DEG,
                                      .n_theta_i = 2,
                                      .phi_i_deg = 10,
                                      .step_deg = 10};
    csv_table got = show(&view);
    /* the normal, 8 rings of 36, and one ring more for 41 deg */
    ck_assert_int_eq(got.n_rows, 2 * ((1 + 8 * 36) + (1 + 9 * 36)));
    glint_material *panel = read_good(HUANG, "solar-panel", NULL);
    int mirrors = 0;
    for (long row = 0; row < 1 + 8 * 36; row++) {
        const double theta_deg = table_number(&got, row, "theta_r_deg");
        const double phi_deg = table_number(&got, row, "phi_r_deg");
        ck_assert(phi_deg >= 0 && phi_deg < 360);
        assert_rel(table_number(&got, row, "f_per_sr"), f_of(panel, 30, 10, theta_deg, phi_deg),
                   1e-14);
        mirrors += theta_deg == 30 && phi_deg == 190;
    }
    ck_assert_int_eq(mirrors, 1);
    glint_material_free(panel);
    csv_free(&got);
}
END_TEST

START_TEST(test_material_table_at_angles_of_a_file)
{
    const char *angles =
        write_file("angles.csv", "# any order, other columns are passed over\n"
                                 "phi_r_deg,theta_r_deg,who,phi_i_deg,theta_i_deg\n"
                                 "180,30,a,0,30\n37,10,b,0,15\n180,-30,c,180,30\n0,90,d,0,0\n");
    const glint_material_view view = {.kind = GLINT_VIEW_ANGLES, .angles = angles};
    csv_table got = show(&view);
    ck_assert_int_eq(got.n_rows, 8);
    /* spots.csv and golden_out_of_plane.csv */
    assert_rel(table_number(&got, 0, "f_per_sr"), 9.89111681886, 1e-11);
    assert_rel(table_number(&got, 1, "f_per_sr"), 6.6343562558350907e-2, ROUNDING);
    assert_rel(table_number(&got, 2, "f_per_sr"), 9.89111681886, 1e-11);
    assert_near(table_number(&got, 3, "f_per_sr"), 0, 0);
    assert_near(table_number(&got, 3, "g_per_sr"), 0, 0);
    csv_free(&got);
}
END_TEST

START_TEST(test_material_table_of_reflectances)
{
    const glint_material_view view = {
        .kind = GLINT_VIEW_DHR, .theta_i_deg = CURVES_DEG, .n_theta_i = 6};
    csv_table got = show(&view);
    ck_assert_int_eq(got.n_rows, 12);
    /* dhr.csv: the panel at 0, 15 and 30 deg */
    static const double WANT[] = {0.863149125726, 0.839609173708, 0.770611389203};
    for (int k = 0; k < 3; k++) {
        assert_near(table_number(&got, k, "theta_i_deg"), CURVES_DEG[k], 0);
        assert_rel(table_number(&got, k, "dhr"), WANT[k], 1e-8);
        ck_assert(table_number(&got, k, "dhr_error") <= 1e-8);
    }
    csv_free(&got);
}
END_TEST

START_TEST(test_material_table_calls_materials_by_their_labels)
{
    static const char *const LABELS[] = {"one, \"two\"", "plain"};
    static const double THETA_DEG[] = {0};
    const glint_material_view view = {
        .kind = GLINT_VIEW_DHR, .theta_i_deg = THETA_DEG, .n_theta_i = 1, .labels = LABELS};
    csv_table got = show(&view);
    for (int k = 0; k < 2; k++)
        ck_assert_str_eq(table_text(&got, k, "material"), LABELS[k]);
    csv_free(&got);
}
END_TEST

/* Shows a material in a way that must be refused, with the text in the error; nothing is written.
 */
static void assert_refused_view(const glint_material_view *view, glint_status wanted, int line,
                                const char *text)
{
    glint_material *mli = read_good(HUANG, "mli", NULL);
    const glint_material *const one[] = {mli};
    const char *path = in_folder("refused.csv");
    glint_errors *errors = glint_errors_new();
    const glint_status status = glint_material_table_write(one, 1, view, path, errors);
    ck_assert_msg(status == wanted, "status %d; wanted %d: %s", status, wanted, text);
    ck_assert_uint_ge(glint_errors_count(errors), 1);
    const glint_error *e = glint_errors_get(errors, 0);
    ck_assert_msg(strstr(e->message, text) && e->line == line, "wanted %d: %s; got:%s", line, text,
                  list_errors(errors));
    ck_assert_int_ne(access(path, F_OK), 0);
    glint_errors_free(errors);
    glint_material_free(mli);
}

START_TEST(test_material_view_that_cannot_be_is_refused)
{
    static const double GOOD[] = {0}, HORIZON[] = {0, 90}, NEGATIVE[] = {-1},
                        NOT_A_NUMBER[] = {(double)NAN};
    const glint_material_view wrong[] = {
        {.kind = GLINT_VIEW_PLANE, .theta_i_deg = HORIZON, .n_theta_i = 2, .step_deg = 1},
        {.kind = GLINT_VIEW_DHR, .theta_i_deg = NEGATIVE, .n_theta_i = 1},
        {.kind = GLINT_VIEW_DHR, .theta_i_deg = NOT_A_NUMBER, .n_theta_i = 1},
        {.kind = GLINT_VIEW_PLANE, .theta_i_deg = GOOD, .n_theta_i = 1, .step_deg = 0.0009},
        {.kind = GLINT_VIEW_PLANE, .theta_i_deg = GOOD, .n_theta_i = 1, .step_deg = 46},
        {.kind = GLINT_VIEW_PLANE, .theta_i_deg = GOOD, .n_theta_i = 1, .step_deg = (double)NAN},
        {.kind = GLINT_VIEW_HEMISPHERE, .theta_i_deg = GOOD, .n_theta_i = 1, .step_deg = 0.2},
        {.kind = GLINT_VIEW_PLANE,
         .theta_i_deg = GOOD,
         .n_theta_i = 1,
         .step_deg = 1,
         .phi_i_deg = 361},
    };
    static const char *const TEXTS[] = {"incidence is 90", "incidence is -1", "incidence is nan",
                                        "step is 0.0009",  "step is 46",      "step is nan",
                                        "step is 0.2",     "azimuth is 361"};
    for (size_t k = 0; k < COUNT_OF(wrong); k++)
        assert_refused_view(&wrong[k], GLINT_ARGUMENT, 0, TEXTS[k]);
}
END_TEST

/* Small angles, where they can be degrees alone or are said to be. */
START_TEST(test_material_angles_of_a_file_may_be_small)
{
    static const char *const texts[] = {
        "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0.5,0,0.5,180\n",
        "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0,0,0,0\n",
        "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0.5,0,0.5,0\n",
    };
    for (int k = 0; k < 3; k++) {
        const glint_material_view view = {.kind = GLINT_VIEW_ANGLES,
                                          .angles = write_file("angles.csv", texts[k]),
                                          .unit_given = k == 2};
        csv_table got = show(&view);
        ck_assert_int_eq(got.n_rows, 2);
        assert_near(table_number(&got, 0, "theta_r_deg"), k == 1 ? 0 : 0.5, 0);
        csv_free(&got);
    }
}
END_TEST

START_TEST(test_material_angles_of_a_file_that_are_wrong_are_refused_with_places)
{
    static const struct {
        const char *text, *found;
        int line;
    } cases[] = {
        {"theta_i_deg,phi_i_deg,theta_r_deg\n0,0,0\n", "no column 'phi_r_deg'", 1},
        {"theta_i_deg,phi_i_deg,theta_r_deg,phi_o_deg\n0,0,0,0\n",
         "no column 'phi_r_deg' (is 'phi_o_deg' meant?)", 1},
        {"theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n", "no rows", 0},
        {"theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0,0,x,0\n", "'x'", 2},
        {"theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0,0,0,0\n0,0,91,0\n", "found 91", 3},
        {"theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0,-400,0,0\n", "found -400", 2},
        {"theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n0,0,0.5,0\n0.1,3.1416,1.5708,0\n1,0,0,0\n",
         "1.5708: these look like radians", 3},
    };
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        const char *path = write_file("angles.csv", cases[k].text);
        const glint_material_view view = {.kind = GLINT_VIEW_ANGLES, .angles = path};
        assert_refused_view(&view, GLINT_INPUT, cases[k].line, cases[k].found);
    }
    const glint_material_view absent = {.kind = GLINT_VIEW_ANGLES, .angles = in_folder("no.csv")};
    assert_refused_view(&absent, GLINT_INPUT, 0, "No such file");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("material_api");
    TCase *all = tcase_create("all");
    tcase_add_checked_fixture(all, folder_make, folder_remove);
    tcase_set_timeout(all, 120);
    tcase_add_test(all, test_material_brdf_matches_reference);
    tcase_add_test(all, test_material_file_that_ships_holds_the_published_materials);
    tcase_add_test(all, test_material_files_that_ship_hold_the_published_mirrors);
    tcase_add_test(all, test_material_dhr_matches_reference);
    tcase_add_test(all, test_material_peak_matches_reference);
    tcase_add_test(all, test_material_peak_of_mli_is_four_times_that_of_the_panel);
    tcase_add_test(all, test_material_peak_of_a_flat_surface_is_in_the_mirror_direction);
    tcase_add_test(all, test_material_brdf_is_zero_from_the_horizon_down);
    tcase_add_test(all, test_material_brdf_near_the_horizon_is_large_and_finite);
    tcase_add_test(all, test_material_brdf_takes_negative_zenith_angles_for_the_other_side);
    tcase_add_test(all, test_material_angles_that_are_not_finite_are_refused);
    tcase_add_test(all, test_material_of_parts_is_their_weighted_sum);
    tcase_add_test(all, test_material_that_mirrors_says_how_much);
    tcase_add_test(all, test_material_table_says_what_f_leaves_out);
    tcase_add_test(all, test_material_of_a_band_has_what_differs_in_it);
    tcase_add_test(all, test_material_of_a_band_may_be_of_another_model);
    tcase_add_test(all, test_material_far_from_where_it_holds_is_warned_of_in_a_band_alone);
    tcase_add_test(all, test_material_names_come_in_the_order_of_the_files);
    tcase_add_test(all, test_material_is_found_in_models_and_scenarios);
    tcase_add_test(all, test_material_that_is_not_there_suggests_the_nearest);
    tcase_add_test(all, test_material_file_that_cannot_be_read_is_named);
    tcase_add_test(all, test_material_that_is_wrong_is_refused_with_places);
    tcase_add_test(all, test_material_table_of_curves_matches_reference);
    tcase_add_test(all, test_material_table_has_the_mirror_direction_between_steps);
    tcase_add_test(all, test_material_table_steps_have_no_rounding_tails);
    tcase_add_test(all, test_material_table_of_a_map_covers_the_hemisphere);
    tcase_add_test(all, test_material_table_at_angles_of_a_file);
    tcase_add_test(all, test_material_table_of_reflectances);
    tcase_add_test(all, test_material_table_calls_materials_by_their_labels);
    tcase_add_test(all, test_material_view_that_cannot_be_is_refused);
    tcase_add_test(all, test_material_angles_of_a_file_may_be_small);
    tcase_add_test(all, test_material_angles_of_a_file_that_are_wrong_are_refused_with_places);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
