/* Materials as files give them: arrays, spectra, and warnings of those that make light. */
#include "base/constants.h"
#include "scenario/scenario.h"
#include "scenario_text.h"

/* ------------------------------------------------------------------ helpers */

/* The small scenario in these bands with that material "white" in place of its own. */
static const char *write_material(const char *bands, const char *material)
{
    const char *parts[N_PARTS];
    char settings[128];
    memcpy(parts, SOUND, sizeof parts);
    snprintf(settings, sizeof settings, "[photometry]\nbands = %s\n", bands);
    parts[PART_SETTINGS] = settings;
    return write_file("scenario.toml", with_part(parts, PART_MATERIAL, material).text);
}

/* Reads a scenario that must be right but for warnings, of which *n are counted; the first holds
 * all three texts (NULL: any). */
static glint_scenario *read_warned(const char *path, size_t n, const char *a, const char *b,
                                   const char *c)
{
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    ck_assert_msg(glint_scenario_read(path, NULL, 0, &s, errors) == GLINT_OK, "%s",
                  list_errors(errors));
    ck_assert_msg(glint_errors_count(errors) == n, "%zu warnings wanted; got:%s", n,
                  list_errors(errors));
    const char *const texts[3] = {a, b, c};
    for (int k = 0; k < 3 && n > 0; k++)
        ck_assert_msg(!texts[k] || strstr(glint_errors_get(errors, 0)->message, texts[k]),
                      "'%s' wanted; got:%s", texts[k], list_errors(errors));
    glint_errors_free(errors);
    return s;
}

/* A number of a lobe of the only material, in band b. */
static double lobe_number(const glint_scenario *s, int band, int lobe, const char *name)
{
    const brdf_lobe *l = &s->satellite.materials[0].bands[band].lobes[lobe];
    for (int k = 0; k < l->model->n_params; k++)
        if (strcmp(l->model->params[k].name, name) == 0) return l->params[k];
    ck_abort_msg("no parameter %s", name);
    return 0;
}

#define PHONG "[materials.white]\nbrdf = \"phong\"\n"

/* ------------------------------------------------------------------ spectra */

/* Pivot wavelengths: V 0.5511 um, R 0.6582 um, I 0.8034 um (Willmer 2018). */
START_TEST(test_spectrum_is_linear_between_neighbours)
{
    const char *path = write_material(
        "[\"V\", \"R\", \"I\"]",
        PHONG "rho_d = 0.9\nrho_s = 0.4\nspectrum = [ { wavelength_um = 0.4, rho_d = 0.1, n = 10 },"
              " { wavelength_um = 0.6, rho_d = 0.3, n = 20 },"
              " { wavelength_um = 1, rho_d = 0.2, n = 60 } ]\n");
    glint_scenario *s = read_warned(path, 0, NULL, NULL, NULL);
    assert_rel(lobe_number(s, 0, 0, "rho_d"), 0.1 + 0.2 * (0.5511 - 0.4) / 0.2, 1e-15);
    assert_rel(lobe_number(s, 1, 0, "rho_d"), 0.3 - 0.1 * (0.6582 - 0.6) / 0.4, 1e-15);
    assert_rel(lobe_number(s, 2, 0, "n"), 20 + 40 * (0.8034 - 0.6) / 0.4, 1e-15);
    for (int b = 0; b < 3; b++) /* not in the spectrum */
        assert_near(lobe_number(s, b, 0, "rho_s"), 0.4, 0);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_spectrum_yields_to_band)
{
    const char *path = write_material(
        "[\"V\", \"R\"]", PHONG
        "rho_s = 0.4\nspectrum = [ { wavelength_um = 0.5, rho_d = 0.1, n = 10 },"
        " { wavelength_um = 0.7, rho_d = 0.3, n = 20 } ]\nbands.R = { n = 7, rho_s = 0.2 }\n");
    glint_scenario *s = read_warned(path, 0, NULL, NULL, NULL);
    assert_rel(lobe_number(s, 0, 0, "n"), 10 + 10 * 0.0511 / 0.2, 1e-14);
    assert_near(lobe_number(s, 1, 0, "n"), 7, 0);
    assert_near(lobe_number(s, 1, 0, "rho_s"), 0.2, 0);
    assert_rel(lobe_number(s, 1, 0, "rho_d"), 0.1 + 0.2 * 0.1582 / 0.2, 1e-14);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_spectrum_outside_range_takes_nearest_and_warns)
{
    const char *const spectrum =
        PHONG "rho_s = 0.4\nspectrum = [ { wavelength_um = 0.6, rho_d = 0.1, n = 10 },"
              " { wavelength_um = 0.7, rho_d = 0.3, n = 20 } ]\n";
    glint_scenario *s = read_warned(write_material("[\"V\"]", spectrum), 1, "from 0.6 to 0.7 um",
                                    "band V (0.551 um)", "'white'");
    assert_near(lobe_number(s, 0, 0, "rho_d"), 0.1, 0);
    glint_scenario_free(s);
    s = read_warned(write_material("[\"I\"]", spectrum), 1, "band I (0.803 um)", NULL, NULL);
    assert_near(lobe_number(s, 0, 0, "rho_d"), 0.3, 0);
    glint_scenario_free(s);
    char both[512]; /* the band gives all that the spectrum would */
    snprintf(both, sizeof both, "%sbands.V = { rho_d = 0.2, n = 5 }\n", spectrum);
    s = read_warned(write_material("[\"V\"]", both), 0, NULL, NULL, NULL);
    assert_near(lobe_number(s, 0, 0, "n"), 5, 0);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_spectrum_of_one_wavelength_holds_there)
{
    const char *path = write_material(
        "[\"V\"]",
        PHONG "rho_s = 0.4\nn = 3\nspectrum = [ { wavelength_um = 0.5511, rho_d = 0.1 } ]\n");
    glint_scenario *s = read_warned(path, 0, NULL, NULL, NULL);
    assert_near(lobe_number(s, 0, 0, "rho_d"), 0.1, 0);
    glint_scenario_free(s);
}
END_TEST

/* The Ward models have a wavelength_um of their own, which a spectrum leaves alone. */
START_TEST(test_spectrum_leaves_wavelength_of_ward_models_alone)
{
    const char *path = write_material(
        "[\"V\"]", "[materials.white]\nbrdf = \"ward\"\nrho_s = 0.4\nalpha_x = 0.1\nalpha_y = 0.2\n"
                   "k_per_um = 2\nwavelength_um = 0.5\nspectrum = [ { wavelength_um = 0.4, rho_d = "
                   "0.1 }, { wavelength_um = 0.7, rho_d = 0.4 } ]\n");
    glint_scenario *s = read_warned(path, 0, NULL, NULL, NULL);
    assert_rel(lobe_number(s, 0, 0, "rho_d"), 0.1 + 0.1511, 1e-14);
    assert_near(lobe_number(s, 0, 0, "wavelength_um"), 0.5, 0);
    assert_near(lobe_number(s, 0, 0, "k_per_um"), 2, 0);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_spectrum_of_a_part_of_a_sum)
{
    const char *path = write_material(
        "[\"V\"]",
        "[materials.white]\nbrdf = \"sum\"\nparts = [ { brdf = \"lambert\", spectrum = [ "
        "{ wavelength_um = 0.6, rho = 0.1 } ] }, { brdf = \"lambert\", rho = 0.3 } ]\n");
    glint_scenario *s = read_warned(path, 1, "from 0.6 to 0.6 um", "band V", NULL);
    assert_near(lobe_number(s, 0, 0, "rho"), 0.1, 0);
    assert_near(lobe_number(s, 0, 1, "rho"), 0.3, 0);
    glint_scenario_free(s);
}
END_TEST

#define LAMBERT "[materials.white]\nbrdf = \"lambert\"\n"

static const wrong_text wrong_spectra[] = {
    {PART_MATERIAL, LAMBERT "rho = 1\nspectrum = @3\n", "'spectrum' is the number 3",
     "[[spectrum]]", 0},
    {PART_MATERIAL, LAMBERT "rho = 1\nspectrum = @[]\n", "'spectrum' is empty", "wavelength_um", 0},
    {PART_MATERIAL, LAMBERT "rho = 1\nspectrum = [ @{ rho = 0.1 } ]\n", "no 'wavelength_um'",
     "above 0", 0},
    {PART_MATERIAL, LAMBERT "rho = 1\nspectrum = [ { wavelength_um = @0, rho = 0.1 } ]\n",
     "'wavelength_um' is the number 0", "above 0", 0},
    {PART_MATERIAL, LAMBERT "rho = 1\nspectrum = [ { wavelength_um = 0.5, rho = @1.5 } ]\n",
     "'rho' is the number 1.5", "between 0 and 1", 0},
    {PART_MATERIAL,
     LAMBERT "rho = 1\nspectrum = [ { wavelength_um = 0.5, rho = 0.5, @roh = 0.1 } ]\n",
     "unknown key 'roh'", "did you mean 'rho'?", 0},
    {PART_MATERIAL,
     LAMBERT
     "rho = 1\nspectrum = [ { wavelength_um = 0.5, rho = 0.5 }, @{ wavelength_um = 0.6 } ]\n",
     "'rho' stands in some entries", "in all or in none", 0},
    {PART_MATERIAL,
     LAMBERT
     "rho = 1\nspectrum = [ { wavelength_um = 0.5, rho = 0.5 }, @{ wavelength_um = 0.5, rho "
     "= 0.5 } ]\n",
     "0.5 um after 0.5 um", "rising order", 0},
    {PART_MATERIAL,
     LAMBERT
     "rho = 1\nspectrum = [ { wavelength_um = 0.5, rho = 0.5 }, @{ wavelength_um = 0.4, rho "
     "= 0.5 } ]\n",
     "0.4 um after 0.5 um", "rising order", 0},
    {PART_MATERIAL, LAMBERT "rho = @2\nspectrum = [ { wavelength_um = 0.5, rho = 0.5 } ]\n",
     "'rho' is the number 2", "between 0 and 1", 0},
    {PART_MATERIAL,
     LAMBERT
     "rho = 1\n[materials.white.bands.V]\n@spectrum = [ { wavelength_um = 0.5, rho = 0.5 } ]\n",
     "a band has no 'spectrum'", "the numbers in this band", 0},
    {PART_MATERIAL,
     "@[materials.white]\nbrdf = \"phong\"\nrho_d = 0.1\nrho_s = 0.1\nspectrum = [ { wavelength_um "
     "= "
     "0.5, rho_d = 0.5 } ]\n",
     "no 'n'", "between 0 and 1e+06", 0},
};

START_TEST(test_spectrum_that_is_wrong_is_refused_at_its_place)
{
    ASSERT_ALL_WRONG(SOUND, wrong_spectra);
}
END_TEST

/* ------------------------------------------------------------------- arrays */

#define BINOMIAL "[materials.white]\nbrdf = \"binomial\"\nd = 3\nl1 = -5\n"

START_TEST(test_array_of_one_row_needs_no_outer_brackets)
{
    static const char *const texts[] = {BINOMIAL "B = [1, -2, 0]\nC = [[-1.5]]\n",
                                        BINOMIAL "B = [[1, -2, 0]]\nC = [-1.5]\n"};
    for (int k = 0; k < 2; k++) {
        glint_scenario *s = read_sound(write_material("[\"V\"]", texts[k]));
        const brdf_lobe *lobe = &s->satellite.materials[0].bands[0].lobes[0];
        ck_assert_int_eq(lobe->arrays[0].rows, 1);
        ck_assert_int_eq(lobe->arrays[0].columns, 3);
        assert_near(lobe->arrays[0].values[1], -2, 0);
        ck_assert_int_eq(lobe->arrays[1].columns, 1);
        assert_near(lobe->arrays[1].values[0], -1.5, 0);
        glint_scenario_free(s);
    }
}
END_TEST

START_TEST(test_array_of_rows_is_row_major_and_differs_by_band)
{
    const char *path = write_material("[\"V\", \"R\"]",
                                      BINOMIAL "B = [[1, 2], [3, 4], [5, 6]]\nC = [[1], [1], [1]]\n"
                                               "bands.R.B = [[0], [0], [0.5]]\n");
    glint_scenario *s = read_sound(path);
    const brdf_array *v = s->satellite.materials[0].bands[0].lobes[0].arrays;
    const brdf_array *r = s->satellite.materials[0].bands[1].lobes[0].arrays;
    ck_assert_int_eq(v[0].rows, 3);
    for (int k = 0; k < 6; k++)
        assert_near(v[0].values[k], k + 1, 0);
    ck_assert_int_eq(r[0].columns, 1);
    assert_near(r[0].values[2], 0.5, 0);
    glint_scenario_free(s);
}
END_TEST

static const wrong_text wrong_arrays[] = {
    {PART_MATERIAL, "@" BINOMIAL "B = [1]\n", "no 'C'", "rows of equally many numbers", 0},
    {PART_MATERIAL, BINOMIAL "B = @1\nC = [1]\n", "'B' is the number 1",
     "rows of equally many numbers, each between -10000 and 10000", 0},
    {PART_MATERIAL, BINOMIAL "B = @[]\nC = [1]\n", "a row of 'B' is empty", "rows", 0},
    {PART_MATERIAL, BINOMIAL "B = [[1], @[]]\nC = [1]\n", "a row of 'B' is empty", "rows", 0},
    {PART_MATERIAL, BINOMIAL "B = [[1], @2]\nC = [1]\n", "a row of 'B' is a whole number", "rows",
     0},
    {PART_MATERIAL, BINOMIAL "B = [[1, 2], @[3]]\nC = [1]\n", "has 1 numbers and the first has 2",
     "rows", 0},
    {PART_MATERIAL, BINOMIAL "B = [1, @\"x\"]\nC = [1]\n", "'B' is the string \"x\"", "a number",
     0},
    {PART_MATERIAL, BINOMIAL "B = [1, @2e4]\nC = [1]\n", "'B' holds the number 20000", "-10000", 0},
    {PART_MATERIAL, "@" BINOMIAL "B = [[1], [2]]\nC = [1]\n", "B has 2 rows and C has 1",
     "expected as many", 0},
    {PART_MATERIAL, BINOMIAL "B = [1]\nC = [1]\nspectrum = [ { wavelength_um = 0.5, @B = [1] } ]\n",
     "unknown key 'B'", "wavelength_um", 0},
};

START_TEST(test_array_that_is_wrong_is_refused_at_its_place)
{
    ASSERT_ALL_WRONG(SOUND, wrong_arrays);
}
END_TEST

/* ----------------------------------------------------------------- warnings */

START_TEST(test_material_that_makes_light_is_named_with_angle_and_value)
{
    /* Minnaert at 85 deg: rho ci^(k-1) = 0.5 / sqrt(cos 85 deg) = 1.6937 */
    const char *path = write_material(
        "[\"V\", \"R\"]", "[materials.white]\nbrdf = \"minnaert\"\nrho = 0.5\nk = 0.5\n");
    glint_scenario_free(read_warned(path, 1, "'white' reflects more than it gets in band V",
                                    "1.694 times", "at 85 deg"));
    path =
        write_material("[\"V\", \"R\"]", "[materials.white]\nbrdf = \"phong\"\nrho_d = 0.5\nrho_s "
                                         "= 0.3\nn = 10\nbands.R.rho_s = 0.75\n");
    glint_scenario_free(
        read_warned(path, 1, "more than it gets in band R", "1.25 times", "at 0 deg"));
}
END_TEST

START_TEST(test_material_that_keeps_its_light_is_not_warned_of)
{
    static const char *const sound[] = {
        LAMBERT "rho = 1\n",
        "[materials.white]\nbrdf = \"ward-gmd\"\nrho_d = 0\nrho_s = 1\nalpha_x = 1e-4\nalpha_y = "
        "0.2\n",
        LAMBERT "rho = 1\n[materials.unused]\nbrdf = \"minnaert\"\nrho = 1\nk = 0.1\n"};
    for (size_t k = 0; k < COUNT_OF(sound); k++)
        glint_scenario_free(read_warned(write_material("[\"V\"]", sound[k]), 0, NULL, NULL, NULL));
}
END_TEST

/* A ratio of wavelengths of 1.5 is let pass: from 0.532 um to 0.798 um, short of I at 0.8034 um. A
 * band with keys of its own is not warned of. */
START_TEST(test_material_far_from_where_it_holds_is_named)
{
    const char *const at = LAMBERT "rho = 1\nholds_um = 0.532\n";
    glint_scenario_free(read_warned(write_material("[\"V\", \"R\"]", at), 0, NULL, NULL, NULL));
    glint_scenario_free(read_warned(write_material("[\"V\", \"I\"]", at), 1, "hold at 0.532 um",
                                    "band I (0.803 um)", "'white'"));
    const char *const range = LAMBERT "rho = 1\nholds_um = [0.9, 2]\n";
    glint_scenario_free(read_warned(write_material("[\"V\", \"B\"]", range), 1,
                                    "hold from 0.9 to 2 um", "band V (0.551 um)", NULL));
    glint_scenario_free(read_warned(write_material("[\"R\"]", range), 0, NULL, NULL, NULL));
    const char *const own = LAMBERT "rho = 1\nholds_um = 0.532\nbands.I.rho = 0.9\n";
    glint_scenario_free(read_warned(write_material("[\"I\"]", own), 0, NULL, NULL, NULL));
}
END_TEST

static const wrong_text wrong_places[] = {
    {PART_MATERIAL, LAMBERT "rho = 1\nholds_um = @\"V\"\n", "'holds_um' is the string \"V\"",
     "a number", 0},
    {PART_MATERIAL, LAMBERT "rho = 1\nholds_um = @0\n", "0 to 0", "above 0", 0},
    {PART_MATERIAL, LAMBERT "rho = 1\nholds_um = @[0.7, 0.4]\n", "0.7 to 0.4", "rising order", 0},
    {PART_MATERIAL, LAMBERT "rho = 1\nholds_um = @[0.7]\n", "1 elements", "2 numbers", 0},
};

START_TEST(test_material_place_that_is_wrong_is_refused)
{
    ASSERT_ALL_WRONG(SOUND, wrong_places);
}
END_TEST

/* ----------------------------------------------------------------- mirrors */

static const wrong_text wrong_mirrors[] = {
    {PART_MATERIAL, "@[materials.white]\nbrdf = \"mirror\"\nR = 0.9\n",
     "material 'white' is a perfect mirror", "solar_disc = \"uniform\", or a narrow lobe", 0},
    {PART_MATERIAL,
     "@[materials.white]\nbrdf = \"sum\"\nparts = [ { brdf = \"lambert\", rho = 0.1 }, "
     "{ brdf = \"mirror\", R = 1, n = 1.5 } ]\n",
     "material 'white' is a perfect mirror", "solar_disc = \"point\"", 0},
    {PART_MATERIAL, "@[materials.white]\nbrdf = \"mirror\"\nR = 0.9\nk = 2\n", "k without n",
     "n alone", 0},
};

START_TEST(test_material_that_is_a_mirror_is_refused_with_a_point_sun)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_SETTINGS] = "[photometry]\nsolar_disc = \"point\"\n";
    ASSERT_ALL_WRONG(parts, wrong_mirrors);
}
END_TEST

/* Whatever no surface shows may stand there. */
START_TEST(test_material_that_is_a_mirror_may_stand_unused)
{
    const char *text = LAMBERT "rho = 1\n[materials.unused]\nbrdf = \"mirror\"\nR = 0.9\n";
    glint_scenario_free(read_warned(write_material("[\"V\"]", text), 0, NULL, NULL, NULL));
}
END_TEST

START_TEST(test_check_shows_what_a_mirror_reflects)
{
    const char *path = write_file("m.toml", "[materials.glass]\nbrdf = \"sum\"\nparts = [\n"
                                            "  { brdf = \"mirror\", R = 1, n = 1.5 },\n"
                                            "  { brdf = \"lambert\", rho = 0.25 } ]\n");
    char *report;
    ck_assert_int_eq(glint_check(path, NULL, 0, &report, NULL), GLINT_OK);
    /* Fresnel: 0.0400 at 0 deg, 0.0415 at 30 deg, 0.0892 at 60 deg */
    ck_assert_msg(strstr(report, "reflects 0.290, 0.292, 0.339 of the light"), "%s", report);
    ck_assert_msg(strstr(report, "of that 0.040, 0.042, 0.089 into the mirror direction"), "%s",
                  report);
    glint_free(report);
}
END_TEST

/* ------------------------------------------------------------------- check */

START_TEST(test_check_describes_a_file_of_materials)
{
    const char *path = write_file("m.toml", LAMBERT "rho = 0.25\nsource = \"made up\"\n"
                                                    "[materials.shiny]\nbrdf = \"phong\"\nrho_d = "
                                                    "0.1\nrho_s = 0.5\nn = 1e5\n");
    char *report;
    ck_assert_int_eq(glint_check(path, NULL, 0, &report, NULL), GLINT_OK);
    ck_assert_ptr_nonnull(strstr(report, "a file of 2 materials"));
    ck_assert_ptr_nonnull(strstr(report, "white  (made up)"));
    ck_assert_ptr_nonnull(strstr(report, "0.250, 0.250, 0.250 of the light from 0, 30, 60 deg"));
    /* a narrow Phong lobe: rho_d + rho_s cos(theta_i) */
    ck_assert_ptr_nonnull(strstr(report, "0.600, 0.533, 0.350 of the light"));
    glint_free(report);
    const char *const set[] = {"materials.white.rho=0.5"};
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(glint_check(path, set, 1, &report, errors), GLINT_ARGUMENT);
    ck_assert_ptr_null(report);
    ck_assert_ptr_nonnull(strstr(glint_errors_get(errors, 0)->message, "a file of materials"));
    glint_errors_free(errors);
}
END_TEST

START_TEST(test_check_shows_both_azimuths_where_they_differ)
{
    const char *path =
        write_file("m.toml", "[materials.brushed]\nbrdf = \"ward-gmd\"\nrho_d = 0\nrho_s = "
                             "1\nalpha_x = 0.05\nalpha_y = 0.5\n");
    char *report;
    ck_assert_int_eq(glint_check(path, NULL, 0, &report, NULL), GLINT_OK);
    ck_assert_ptr_nonnull(strstr(report, "60 deg along the tangent"));
    ck_assert_ptr_nonnull(strstr(report, " across it"));
    glint_free(report);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("materials");
    TCase *spectra = tcase_create("spectra");
    tcase_add_checked_fixture(spectra, folder_make, folder_remove);
    tcase_add_test(spectra, test_spectrum_is_linear_between_neighbours);
    tcase_add_test(spectra, test_spectrum_yields_to_band);
    tcase_add_test(spectra, test_spectrum_outside_range_takes_nearest_and_warns);
    tcase_add_test(spectra, test_spectrum_of_one_wavelength_holds_there);
    tcase_add_test(spectra, test_spectrum_leaves_wavelength_of_ward_models_alone);
    tcase_add_test(spectra, test_spectrum_of_a_part_of_a_sum);
    tcase_add_test(spectra, test_spectrum_that_is_wrong_is_refused_at_its_place);
    suite_add_tcase(suite, spectra);
    TCase *arrays = tcase_create("arrays");
    tcase_add_checked_fixture(arrays, folder_make, folder_remove);
    tcase_add_test(arrays, test_array_of_one_row_needs_no_outer_brackets);
    tcase_add_test(arrays, test_array_of_rows_is_row_major_and_differs_by_band);
    tcase_add_test(arrays, test_array_that_is_wrong_is_refused_at_its_place);
    suite_add_tcase(suite, arrays);
    TCase *warnings = tcase_create("warnings");
    tcase_add_checked_fixture(warnings, folder_make, folder_remove);
    tcase_add_test(warnings, test_material_that_makes_light_is_named_with_angle_and_value);
    tcase_add_test(warnings, test_material_that_keeps_its_light_is_not_warned_of);
    tcase_add_test(warnings, test_material_far_from_where_it_holds_is_named);
    tcase_add_test(warnings, test_material_place_that_is_wrong_is_refused);
    suite_add_tcase(suite, warnings);
    TCase *mirrors = tcase_create("mirrors");
    tcase_add_checked_fixture(mirrors, folder_make, folder_remove);
    tcase_add_test(mirrors, test_material_that_is_a_mirror_is_refused_with_a_point_sun);
    tcase_add_test(mirrors, test_material_that_is_a_mirror_may_stand_unused);
    tcase_add_test(mirrors, test_check_shows_what_a_mirror_reflects);
    suite_add_tcase(suite, mirrors);
    TCase *check = tcase_create("check");
    tcase_add_checked_fixture(check, folder_make, folder_remove);
    tcase_add_test(check, test_check_describes_a_file_of_materials);
    tcase_add_test(check, test_check_shows_both_azimuths_where_they_differ);
    suite_add_tcase(suite, check);
    return run_suite(suite);
}
