/* Models that are right: materials, components, hinges and primitives as a scenario reads them. */
#include "base/constants.h"
#include "base/vec.h"
#include "scenario/scenario.h"
#include "scenario_text.h"

#include <sys/stat.h>

/* Two roundings of a conversion of units, relative. */
static const double rounding = 5e-16;
/* Areas of a few facets: some dozen roundings, relative. */
static const double area_rounding = 1e-14;

static void assert_vec(const double got[3], double x, double y, double z)
{
    assert_near(got[0], x, rounding);
    assert_near(got[1], y, rounding);
    assert_near(got[2], z, rounding);
}

/* ------------------------------------------------------------------ materials */

#define PLATE                                                                                      \
    "[[component]]\nname = \"bus\"\n[[component.plate]]\nsize_m = [1, 1]\nnormal = [0, 0, 1]\n"    \
    "tangent = [1, 0, 0]\nmaterial = \"m\"\n"

/* A scenario in bands V, R and lsst_g whose only material has these keys. */
static glint_scenario *read_material_text(const char *keys)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_SETTINGS] = "[photometry]\nbands = [\"V\", \"R\", \"lsst_g\"]\n";
    parts[PART_COMPONENT] = PLATE;
    parts[PART_PRIMITIVE] = NULL;
    char content[1024];
    snprintf(content, sizeof content, "[materials.m]\n%s", keys);
    return read_with(parts, PART_MATERIAL, content);
}

static const brdf_lobe *lobe_of(const glint_scenario *s, int band, int k)
{
    const brdf_material *m = &s->satellite.materials[0].bands[band];
    ck_assert_int_lt(k, m->n_lobes);
    return &m->lobes[k];
}

/* A parameter of a lobe, by name. */
static double parameter(const brdf_lobe *lobe, const char *name)
{
    for (int k = 0; k < lobe->model->n_params; k++)
        if (strcmp(lobe->model->params[k].name, name) == 0) return lobe->params[k];
    ck_abort_msg("%s has no %s", lobe->model->name, name);
    return NAN;
}

START_TEST(test_model_material_keys_that_differ_in_a_band)
{
    glint_scenario *s = read_material_text(
        "brdf = \"ward\"\nrho_d = 0.17\nrho_s = 0.7\nalpha_x = 0.12\nalpha_y = 0.24\n"
        "source = \"someone 2013\"\n[materials.m.bands.R]\nrho_d = 0.05\nalpha_x = 0.5\n"
        "[materials.m.bands.U]\nrho_d = 0.9\n");
    const double rho_d[3] = {0.17, 0.05, 0.17}, alpha_x[3] = {0.12, 0.5, 0.12};
    for (int b = 0; b < 3; b++) {
        const brdf_lobe *lobe = lobe_of(s, b, 0);
        ck_assert_str_eq(lobe->model->name, "ward");
        assert_near(parameter(lobe, "rho_d"), rho_d[b], 0);
        assert_near(parameter(lobe, "rho_s"), 0.7, 0);
        assert_near(parameter(lobe, "alpha_x"), alpha_x[b], 0);
        assert_near(parameter(lobe, "alpha_y"), 0.24, 0);
        ck_assert(isnan(parameter(lobe, "k_per_um"))); /* k lambda = 1 */
    }
    ck_assert_str_eq(s->satellite.materials[0].source, "someone 2013");
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_model_material_wavelength_is_its_own_or_the_bands)
{
#define WARD                                                                                       \
    "brdf = \"ward\"\nrho_d = 0.1\nrho_s = 0.5\nalpha_x = 0.1\nalpha_y = 0.1\n"                    \
    "k_per_um = 2\nwavelength_um = 0.5\n"
    glint_scenario *s = read_material_text(WARD);
    for (int b = 0; b < 3; b++)
        assert_near(parameter(lobe_of(s, b, 0), "wavelength_um"), 0.5, 0);
    glint_scenario_free(s);
    s = read_material_text(WARD "follow_band = true\n");
    const double pivot_um[3] = {0.5511, 0.6582, 0.4808}; /* Willmer 2018, tables 3 and 4 */
    for (int b = 0; b < 3; b++)
        assert_near(parameter(lobe_of(s, b, 0), "wavelength_um"), pivot_um[b], 0);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_model_material_sum_has_its_parts)
{
    glint_scenario *s = read_material_text(
        "brdf = \"sum\"\nparts = [{ weight = 0.25, brdf = \"lambert\", rho = 0.4 },\n"
        "{ brdf = \"minnaert\", rho = 0.3, k = 0.6 }, { weight = 0, brdf = \"lambert\", rho = 1 "
        "}]\n");
    ck_assert_int_eq(s->satellite.materials[0].bands[0].n_lobes, 3);
    assert_near(lobe_of(s, 0, 0)->weight, 0.25, 0);
    assert_near(lobe_of(s, 0, 1)->weight, 1, 0);
    assert_near(lobe_of(s, 0, 2)->weight, 0, 0);
    ck_assert_str_eq(lobe_of(s, 0, 1)->model->name, "minnaert");
    assert_near(parameter(lobe_of(s, 0, 1), "k"), 0.6, 0);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_model_every_brdf_of_the_table_is_read)
{
    for (size_t k = 0; brdf_model_at(k); k++) {
        const brdf_model *brdf = brdf_model_at(k);
        if (brdf->flags & BRDF_MEASURED) continue; /* needs a file: test_materials.c */
        if (brdf->specular) continue;              /* refused with a point Sun: test_materials.c */
        char keys[1024];
        int n = snprintf(keys, sizeof keys, "brdf = \"%s\"\n", brdf->name);
        for (int j = 0; j < brdf->n_params; j++) {
            const param_info *p = &brdf->params[j];
            if (!param_is_required(p)) continue;
            const double lo = isfinite(p->min) ? p->min : -1, hi = isfinite(p->max) ? p->max : 2;
            const bool rows = p->flags & PARAM_ROWS;
            n += snprintf(keys + n, sizeof keys - (size_t)n, "%s = %s%.17g%s\n", p->name,
                          rows ? "[[" : "", lo + 0.3 * (hi - lo), rows ? "]]" : "");
        }
        glint_scenario *s = read_material_text(keys);
        ck_assert_ptr_eq(lobe_of(s, 2, 0)->model, brdf);
        glint_scenario_free(s);
    }
}
END_TEST

/* Warnings with the file they stand in. */
static void assert_warns(const char *keys, const char *said, size_t n)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_SETTINGS] = "[photometry]\nbands = [\"V\", \"B\"]\n";
    parts[PART_COMPONENT] = PLATE;
    parts[PART_PRIMITIVE] = NULL;
    char content[1024];
    snprintf(content, sizeof content,
             "@[materials.m]\nbrdf = \"ward\"\nrho_d = 0.1\nrho_s = 0.5\n%s", keys);
    const marked_text m = with_part(parts, PART_MATERIAL, content);
    const char *path = write_file("scenario.toml", m.text);
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(glint_scenario_read(path, NULL, 0, &s, errors), GLINT_OK);
    ck_assert_msg(glint_errors_count(errors) == n, "%zu warnings wanted; got:%s", n,
                  list_errors(errors));
    for (size_t k = 0; k < n; k++) {
        const glint_error *e = glint_errors_get(errors, k);
        ck_assert_int_eq(e->severity, GLINT_WARNING);
        ck_assert_msg(strstr(e->message, said) != NULL, "'%s' is not in: %s", said, e->message);
        ck_assert_int_eq(e->line, m.line);
    }
    glint_scenario_free(s);
    glint_errors_free(errors);
}

START_TEST(test_model_material_used_where_it_does_not_hold_gets_a_warning)
{
    assert_warns("alpha_x = 0.1\nalpha_y = 0.1\n", "", 0);
    assert_warns("alpha_x = 0.1\nalpha_y = 0.1\nk_per_um = 2\nwavelength_um = 0.5\n", "", 0);
    assert_warns("alpha_x = 0.1\nalpha_y = 0.1\nk_per_um = 0.14\nwavelength_um = 10.6\n",
                 "hold at 10.6 um and is used in band V", 1); /* said once, not in every band */
    assert_warns("alpha_x = 0.5\nalpha_y = 0.1\n", "", 0);
    assert_warns("alpha_x = 0.1\nalpha_y = 0.51\n", "more than a third of its energy", 2);
    /* 0.12 / (0.14 x 0.5511) = 1.56, as on the physics page; B: 1.95 */
    assert_warns("alpha_x = 0.12\nalpha_y = 0.12\nk_per_um = 0.14\nwavelength_um = 10.6\n"
                 "follow_band = true\n",
                 "more than a third of its energy", 2);
}
END_TEST

START_TEST(test_model_materials_in_use_only_in_the_order_of_the_files)
{
    write_file("others.toml", "title = \"others\"\n[materials.z]\nbrdf = \"lambert\"\nrho = 0.1\n"
                              "[materials.unused]\nbrdf = \"lambert\"\nrho = 0.2\n");
    ck_assert_int_eq(mkdir(in_folder("models"), 0755), 0);
    write_file("models/model.toml",
               "materials_from = [\"../others.toml\"]\n"
               "[materials.idle]\nbrdf = \"lambert\"\nrho = 1\n"
               "[materials.a]\nbrdf = \"lambert\"\nrho = 0.3\n"
               "[[component]]\nname = \"bus\"\n[[component.box]]\nsize_m = [1, 1, 1]\n"
               "material = \"a\"\nfaces = { \"-y\" = \"z\" }\n");
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_MATERIAL] = parts[PART_COMPONENT] = parts[PART_PRIMITIVE] = NULL;
    glint_scenario *s =
        read_with(parts, PART_SATELLITE, "[satellite]\nmodel = \"models/model.toml\"\n");
    ck_assert_int_eq(s->satellite.n_materials, 2);
    ck_assert_str_eq(s->satellite.materials[0].name, "z");
    ck_assert_str_eq(s->satellite.materials[1].name, "a");
    assert_rel(model_material_area(&s->satellite.model, 0, NULL), 1, area_rounding);
    assert_rel(model_material_area(&s->satellite.model, 1, NULL), 5, area_rounding);
    glint_scenario_free(s);
    remove(in_folder("models/model.toml"));
}
END_TEST

/* ------------------------------------------------------------------ components */

START_TEST(test_model_components_parents_before_children)
{
    glint_scenario *s = read_with(
        SOUND, PART_COMPONENT,
        "[[component]]\nname = \"tip\"\nparent = \"boom\"\n[[component]]\nname = \"boom\"\n"
        "parent = \"bus\"\nhinge = { origin_m = [1, 2, 3], axis = [0, 0, 2], angle_deg = 30 }\n"
        "[[component]]\nname = \"bus\"\n");
    const satellite *sat = &s->satellite;
    ck_assert_int_eq(sat->n_components, 3);
    ck_assert_str_eq(sat->components[0].name, "tip"); /* columns keep the order of the file */
    ck_assert_int_eq(sat->components[0].parent, 1);
    ck_assert_int_eq(sat->components[1].parent, 2);
    ck_assert_int_eq(sat->components[2].parent, -1);
    ck_assert_int_eq(sat->order[0], 2);
    ck_assert_int_eq(sat->order[1], 1);
    ck_assert_int_eq(sat->order[2], 0);
    ck_assert(!sat->components[0].has_hinge && sat->components[1].has_hinge);
    assert_vec(sat->components[1].hinge.origin_m, 1, 2, 3);
    assert_vec(sat->components[1].hinge.axis, 0, 0, 1);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_model_hinge_drives)
{
#define HINGE "[[component]]\nname = \"bus\"\nhinge = { origin_m = [0, 0, 0], axis = [0, 3, 4], "
    glint_scenario *s =
        read_with(SOUND, PART_COMPONENT, HINGE "angle_deg = 30, offset_deg = -5 }\n");
    const hinge *h = &s->satellite.components[0].hinge;
    ck_assert_int_eq(h->drive, HINGE_FIXED);
    assert_vec(h->axis, 0, 0.6, 0.8);
    assert_rel(h->angle, PI / 6, rounding);
    assert_rel(h->offset, -5 * PI / 180, rounding);
    ck_assert(!h->has_limits);
    glint_scenario_free(s);

    s = read_with(SOUND, PART_COMPONENT, HINGE "rate_deg_s = -2, angle_deg = 10 }\n");
    h = &s->satellite.components[0].hinge;
    ck_assert_int_eq(h->drive, HINGE_RATE);
    assert_rel(h->rate_rad_s, -2 * PI / 180, rounding);
    assert_rel(h->angle, 10 * PI / 180, rounding);
    assert_near(h->epoch_s, 0, 0);
    glint_scenario_free(s);

    s = read_with(SOUND, PART_COMPONENT,
                  HINGE "track = \"moon\", face = [2, 0, 0], limits_deg = [-45, 90] }\n");
    h = &s->satellite.components[0].hinge;
    ck_assert_int_eq(h->drive, HINGE_TRACK);
    ck_assert_int_eq(h->target.kind, DIRECTION_MOON);
    ck_assert(s->needs_moon);
    assert_vec(h->face, 1, 0, 0);
    ck_assert(h->has_limits);
    assert_rel(h->limits[0], -PI / 4, rounding);
    assert_rel(h->limits[1], PI / 2, rounding);
    glint_scenario_free(s);

    s = read_with(GIVEN, PART_COMPONENT, HINGE "track = \"observer\", face = [1, 0, 0] }\n");
    ck_assert_int_eq(s->satellite.components[0].hinge.target.kind, DIRECTION_OBSERVER);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------------ primitives */

/* Facets and area in m^2 of a primitive in closed form. */
START_TEST(test_model_primitives_with_their_keys)
{
    static const double r60 = 0.86602540378443864676; /* sin 60 deg */
    const struct {
        const char *text;
        int n;
        double area_m2;
    } all[] = {
        {"plate]]\nsize_m = [2, 3]\nnormal = [0, 0, 1]\ntangent = [1, 0, 0]\n", 1, 6},
        {"plate]]\nsize_m = [2, 3]\nnormal = [0, 1, 1]\ntangent = [1, 0, 0.5]\ncentre_m = [1, 2, "
         "3]\n"
         "back_material = \"white\"\n",
         2, 12},
        {"facet]]\nvertices_m = [[0, 0, 0], [2, 0, 0], [0, 3, 0]]\n", 1, 3},
        {"facet]]\nvertices_m = [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]\ntangent = [1, 1, 0]\n"
         "back_material = \"white\"\n",
         2, 2},
        {"box]]\nsize_m = [1, 2, 3]\n", 6, 22},
        {"box]]\nsize_m = [1, 2, 3]\ncentre_m = [5, 0, 0]\n"
         "rotation_deg = { axis = [1, 1, 1], angle = 77 }\n",
         6, 22},
        {"box]]\nsize_m = [1, 2, 3]\nrepeat = { count = 3, axis = [0, 0, 1], step_deg = 120 }\n"
         "mirror = \"y\"\n",
         36, 132},
        {"prism]]\nradius_m = 2\nlength_m = 5\nsides = 6\n", 8, 6 * 2 * 5 + 2 * 6 * 2 * r60},
        {"prism]]\nradius_m = 2\nlength_m = 5\nsides = 6\nopen = true\naxis = [1, 2, 3]\n", 6, 60},
        {"prism]]\nradius_m = 2\nlength_m = 5\nsides = 6\ncap_material = \"white\"\n", 8,
         6 * 2 * 5 + 2 * 6 * 2 * r60},
    };
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        char content[512];
        snprintf(content, sizeof content, "[[component.%smaterial = \"white\"\n", all[k].text);
        glint_scenario *s = read_with(SOUND, PART_PRIMITIVE, content);
        int n;
        assert_rel(model_material_area(&s->satellite.model, 0, &n), all[k].area_m2, area_rounding);
        ck_assert_int_eq(n, all[k].n);
        glint_scenario_free(s);
    }
    glint_scenario *s = read_with(SOUND, PART_PRIMITIVE,
                                  "[[component.sphere]]\nradius_m = 1\nmaterial = \"white\"\n");
    ck_assert_int_eq(s->satellite.model.n_facets, 1280); /* unless said otherwise */
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_model_numbers_may_be_whole)
{
    glint_scenario *s = read_with(SOUND, PART_PRIMITIVE,
                                  "[[component.plate]]\nsize_m = [2, 3.0]\nnormal = [0, 0, 1]\n"
                                  "tangent = [1, 0, 0]\nmaterial = \"white\"\n");
    glint_scenario *t =
        read_with(SOUND, PART_PRIMITIVE,
                  "[[component.plate]]\nsize_m = [2.0, 3]\nnormal = [0.0, 0.0, 1.0]\n"
                  "tangent = [1e0, 0.0, -0.0]\nmaterial = \"white\"\n");
    const facet *a = &s->satellite.model.polygons.items[0],
                *b = &t->satellite.model.polygons.items[0];
    assert_near(a->area_m2, b->area_m2, 0);
    assert_vec(a->normal, b->normal[0], b->normal[1], b->normal[2]);
    assert_vec(a->tangent, b->tangent[0], b->tangent[1], b->tangent[2]);
    glint_scenario_free(s);
    glint_scenario_free(t);
}
END_TEST

static Suite *scenario_model_suite(void)
{
    Suite *suite = suite_create("scenario model");
    TCase *all = tcase_create("model");
    tcase_set_timeout(all, 60);
    tcase_add_checked_fixture(all, folder_make, folder_remove);
    tcase_add_test(all, test_model_material_keys_that_differ_in_a_band);
    tcase_add_test(all, test_model_material_wavelength_is_its_own_or_the_bands);
    tcase_add_test(all, test_model_material_sum_has_its_parts);
    tcase_add_test(all, test_model_every_brdf_of_the_table_is_read);
    tcase_add_test(all, test_model_material_used_where_it_does_not_hold_gets_a_warning);
    tcase_add_test(all, test_model_materials_in_use_only_in_the_order_of_the_files);
    tcase_add_test(all, test_model_components_parents_before_children);
    tcase_add_test(all, test_model_hinge_drives);
    tcase_add_test(all, test_model_primitives_with_their_keys);
    tcase_add_test(all, test_model_numbers_may_be_whole);
    suite_add_tcase(suite, all);
    return suite;
}

int main(void)
{
    return run_suite(scenario_model_suite());
}
