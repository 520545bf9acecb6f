/* Satellites that are wrong: models, materials, components, hinges, primitives. In the texts an '@'
 * marks where the error must be. */
#include "facets/primitive.h"
#include "scenario_text.h"

/* ------------------------------------------------------------------ the satellite */

START_TEST(test_scenario_satellite_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_SATELLITE, "[satellite]\nshadow_step_deg = @2\n", "\"interpolated\" only",
         "or no shadow_step_deg", 0},
        {PART_SATELLITE, "[satellite]\nself_shadows = \"interpolated\"\nshadow_step_deg = @0\n",
         "0", "0.001", 0},
        {PART_SATELLITE, "[satellite]\nrays_per_facet = @16\n", "\"rays\" only",
         "or no rays_per_facet", 0},
        {PART_SATELLITE, "[satellite]\nself_shadows = \"rays\"\nrays_per_facet = @0\n", "0",
         "65536", 0},
        {PART_SATELLITE, "[satellite]\nself_shadows = @false\n", "false", "a string", 0},
        {PART_SATELLITE, "[satellite]\nself_shadows = @\"some\"\n", "\"some\"",
         "exact, none, interpolated, rays", 0},
        {PART_SATELLITE, "[satellite]\nmodel = @\"model.toml\"\n", "both a model file and",
         "one of them", 0},
        {PART_SATELLITE, "[satellite]\n@modle = \"model.toml\"\n", "unknown key 'modle'",
         "did you mean 'model'?", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

/* A scenario whose satellite is a model file. */
static marked_text with_model(const char *satellite)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_MATERIAL] = parts[PART_COMPONENT] = parts[PART_PRIMITIVE] = NULL;
    return with_part(parts, PART_SATELLITE, satellite);
}

START_TEST(test_scenario_model_file_absent_or_unreadable_is_refused)
{
    static const struct {
        const char *text, *found, *expected;
    } all[] = {
        {"@[satellite]\n", "no 'model' and this file has no [[component]]", "one of them"},
        {"[satellite]\nmodel = @\"nothing.toml\"\n", "nothing.toml", "No such file"},
        {"[satellite]\nmodel = @\"/\"\n", "directory", "expected a file"},
        {"[satellite]\nmodel = @\"/dev/null\"\n", "not a regular file", "expected a file"},
        {"[satellite]\nmodel = @1\n", "the number 1", "the path of a model file"},
    };
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        const marked_text m = with_model(all[k].text);
        const char *path = write_file("scenario.toml", m.text);
        assert_refused_set(path, NULL, 0, path, m.line, m.column, all[k].found, all[k].expected, 1);
    }
    const marked_text none = with_model("");
    const char *path = write_file("scenario.toml", none.text);
    assert_refused_set(path, NULL, 0, path, 1, 1, "there is no satellite", "[[component]]", 1);
}
END_TEST

START_TEST(test_scenario_model_file_errors_are_in_the_model_file)
{
#define PART "[[component]]\nname = \"a\"\n"
#define BALL "[[component.sphere]]\nradius_m = 1\nmaterial = \"white\"\n"
    static const char *const models[] = {
        "[materials.white]\nbrdf = \"lambert\"\nrho = @2\n" PART BALL,
        "[materials.white]\nbrdf = \"lambert\"\nrho = 1\n" PART "@colour = 1\n" BALL,
        "[materials.white]\nbrdf = \"lambert\"\nrho = 1\n" PART BALL "material = @\"white\"\n",
        "[materials.white]\nbrdf = \"lambert\"\nrho = 1\n[@time]\n" PART BALL};
    for (size_t k = 0; k < COUNT_OF(models); k++) {
        marked_text m;
        strcpy(m.text, models[k]);
        take_mark(&m);
        const char *model = write_file("model.toml", m.text);
        const marked_text s = with_model("[satellite]\nmodel = \"model.toml\"\n");
        assert_refused_set(write_file("scenario.toml", s.text), NULL, 0, model, m.line, m.column,
                           NULL, NULL, 1);
    }
}
END_TEST

START_TEST(test_scenario_model_without_facets_is_refused)
{
    const marked_text joint = with_part(SOUND, PART_PRIMITIVE, "");
    const char *path = write_file("scenario.toml", joint.text);
    assert_refused_set(path, NULL, 0, path, 0, 0, "no facets", "at least one primitive", 1);

    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_PRIMITIVE] = NULL;
    const marked_text nothing = with_part(parts, PART_COMPONENT, "");
    path = write_file("scenario.toml", nothing.text);
    assert_refused_set(path, NULL, 0, path, 1, 1, "no component", "at least one [[component]]", 1);
}
END_TEST

START_TEST(test_scenario_of_a_model_file_is_refused)
{
    const char *path =
        write_file("model.toml", "[materials.white]\nbrdf = \"lambert\"\nrho = 0.5\n"
                                 "[[component]]\nname = \"a\"\n[[component.sphere]]\nradius_m = 1\n"
                                 "material = \"white\"\n");
    assert_refused_set(path, NULL, 0, path, 0, 0, "a model file, not a scenario",
                       "expected a scenario", 1);
}
END_TEST

/* ------------------------------------------------------------------ materials */

#define WHITE "[materials.white]\n"

START_TEST(test_scenario_material_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_MATERIAL, "@" WHITE "rho = 0.5\n", "no 'brdf'", "a string", 0},
        {PART_MATERIAL, WHITE "brdf = @\"lambret\"\nrho = 0.5\n", "no BRDF 'lambret'",
         "(did you mean 'lambert'?)", 0},
        {PART_MATERIAL, "@" WHITE "brdf = \"table\"\n", "no 'file'", "a string", 0},
        {PART_MATERIAL, WHITE "brdf = \"table\"\nfile = @\"a.csv\"\n", "a.csv", "No such file", 0},
        {PART_MATERIAL, "@" WHITE "brdf = \"lambert\"\n", "no 'rho'", "between 0 and 1", 0},
        {PART_MATERIAL, WHITE "brdf = \"lambert\"\nrho = @1.01\n", "1.01", "between 0 and 1", 0},
        {PART_MATERIAL, WHITE "brdf = \"lambert\"\nrho = @nan\n", "nan", "a finite number", 0},
        {PART_MATERIAL, WHITE "brdf = \"lambert\"\nrho = @true\n", "true", "a number", 0},
        {PART_MATERIAL, WHITE "brdf = \"lambert\"\nrho = 0.5\n@rho_d = 0.5\n",
         "unknown key 'rho_d'", "did you mean 'rho'?", 0},
        {PART_MATERIAL,
         "@" WHITE "brdf = \"ward\"\nrho_d = 0\nrho_s = 1\nalpha_x = 0.1\nalpha_y = 0.1\n"
         "k_per_um = 0.14\n",
         "wavelength_um", NULL, 0},
        {PART_MATERIAL,
         WHITE "brdf = \"ward\"\nrho_d = 0\nrho_s = 1\nalpha_x = @0\nalpha_y = 0.1\n", "alpha_x",
         "between", 0},
        {PART_MATERIAL,
         WHITE "brdf = \"ward\"\nrho_d = 0\nrho_s = 1\nalpha_x = 0.1\nalpha_y = 0.1\n"
               "follow_band = @true\n",
         "'follow_band' needs k_per_um and wavelength_um", "both", 0},
        {PART_MATERIAL, "@" WHITE "brdf = \"sum\"\n", "a sum needs 'parts'", "a list of", 0},
        {PART_MATERIAL, WHITE "brdf = \"sum\"\nparts = [@{ weight = 1 }]\n", "no 'brdf'",
         "a string", 0},
        {PART_MATERIAL,
         WHITE "brdf = \"sum\"\nparts = [{ weight = @-1, brdf = \"lambert\", rho = 1 }]\n", "-1",
         "between 0 and", 0},
        {PART_MATERIAL,
         WHITE "brdf = \"sum\"\nparts = [{ brdf = \"lambert\", rho = 1, @alpha = 1 }]\n",
         "unknown key 'alpha'", "rho", 0},
        {PART_MATERIAL, WHITE "brdf = \"lambert\"\nrho = 0.5\nbands = @3\n", "a whole number",
         "[materials.NAME.bands.V]", 0},
        {PART_MATERIAL,
         WHITE "brdf = \"lambert\"\nrho = 0.5\n[materials.white.bands.@W]\nrho = 1\n",
         "'W' is not a table of a band", "lsst_y", 0},
        {PART_MATERIAL,
         WHITE "brdf = \"lambert\"\nrho = 0.5\n[materials.white.bands.V]\nrho = @-1\n",
         "the number -1", "between 0 and 1", 0},
        {PART_MATERIAL,
         WHITE "brdf = \"lambert\"\nrho = 0.5\n[materials.white.bands.R]\nrho = @-1\n",
         "the number -1", "between 0 and 1", 0},
        {PART_MATERIAL,
         WHITE "brdf = \"lambert\"\nrho = 0.5\n[materials.white.bands.R]\n@Rho = 1\n",
         "unknown key 'Rho' in [materials.white.bands.R]", "did you mean 'rho'?", 0},
        {PART_MATERIAL, WHITE "brdf = \"lambert\"\nrho = 0.5\n[materials.@\"a b\"]\nbrdf = \"x\"\n",
         "'a b' cannot name a material", "letters, digits", 0},
        {PART_MATERIAL, "[materials]\nwhite = @0.5\n", "'white' is a number", "[materials.NAME]",
         2},
        {PART_PRIMITIVE, "[[component.box]]\nsize_m = [1, 1, 1]\nmaterial = @\"whit\"\n",
         "no material 'whit'", "did you mean 'white'?", 0},
        {PART_TOP, "materials_from = @\"m.toml\"\n", "the string", "a list of paths", 0},
        {PART_TOP, "materials_from = [@4]\n", "a whole number", "the path of a file", 0},
        {PART_TOP, "materials_from = [@\"nothing.toml\"]\n", "nothing.toml", "No such file", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

START_TEST(test_scenario_materials_from_wrong_file_is_refused)
{
    const char *others = write_file(
        "others.toml", "[materials.white]\nbrdf = \"lambert\"\nrho = 0.1\n[extra]\nx = 1\n");
    const char *from = "materials_from = [\"others.toml\"]\n";
    const marked_text m = with_part(SOUND, PART_TOP, from);
    const char *path = write_file("scenario.toml", m.text);
    assert_refused_set(path, NULL, 0, path, 0, 0, "material 'white' stands twice", "another name",
                       2);
    assert_refused_set(path, NULL, 0, others, 4, 2, "unknown key 'extra'", NULL, 2);
}
END_TEST

/* ------------------------------------------------------------------ components and hinges */

#define BUS "[[component]]\nname = \"bus\"\n"
#define HINGE BUS "hinge = { origin_m = [0, 0, 0], axis = [0, 1, 0], "

START_TEST(test_scenario_component_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_COMPONENT, "@[[component]]\n", "no 'name'", "a string", 0},
        {PART_COMPONENT, "[[component]]\nname = @\"\"\n", "'' cannot name a component",
         "letters, digits", 0},
        {PART_COMPONENT, "[[component]]\nname = @\"a,b\"\n", "'a,b' cannot name a component",
         "letters, digits", 0},
        {PART_COMPONENT, "[[component]]\nname = \"bus\"\n[[component]]\nname = @\"bus\"\n",
         "component 'bus' stands twice", "another name", 0},
        {PART_COMPONENT, BUS "parent = @\"buss\"\n", "no component 'buss'", "did you mean 'bus'?",
         0},
        {PART_COMPONENT, BUS "parent = @4\n", "the number 4", "the name of another component", 0},
        {PART_COMPONENT, "@" BUS "parent = \"bus\"\n", "its own ancestor", "without parent", 0},
        {PART_COMPONENT, BUS "@boxx = 1\n", "unknown key 'boxx'", "did you mean 'box'?", 0},
        {PART_COMPONENT, BUS "plate = @1\n", "the number 1", "[[plate]]", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

START_TEST(test_scenario_components_in_a_circle_are_refused)
{
    const char *const circle = "[[component]]\nname = \"a\"\nparent = \"c\"\n"
                               "[[component]]\nname = \"b\"\nparent = \"a\"\n"
                               "[[component]]\nname = \"c\"\nparent = \"b\"\n"
                               "[[component]]\nname = \"d\"\n";
    const marked_text m = with_part(SOUND, PART_COMPONENT, circle);
    const char *path = write_file("scenario.toml", m.text);
    assert_refused_set(path, NULL, 0, path, 0, 0, "component 'a' is its own ancestor", NULL, 3);
    assert_refused_set(path, NULL, 0, path, 0, 0, "component 'b' is its own ancestor", NULL, 3);
    assert_refused_set(path, NULL, 0, path, 0, 0, "component 'c' is its own ancestor", NULL, 3);
}
END_TEST

START_TEST(test_scenario_hinge_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_COMPONENT, BUS "hinge = @1\n", "the number 1", "a table", 0},
        {PART_COMPONENT, BUS "hinge = @{ origin_m = [0, 0, 0], angle_deg = 1 }\n", "no 'axis'",
         "3 numbers", 0},
        {PART_COMPONENT, BUS "hinge = @{ axis = [0, 0, 1], angle_deg = 1 }\n", "no 'origin_m'",
         "3 numbers", 0},
        {PART_COMPONENT, BUS "hinge = { origin_m = [0, 0, 0], axis = @[0, 0, 0], angle_deg = 1 }\n",
         "a zero vector", "a direction", 0},
        {PART_COMPONENT, BUS "hinge = @{ origin_m = [0, 0, 0], axis = [0, 1, 0] }\n", "no drive",
         "one of angle_deg, rate_deg_s, track", 0},
        {PART_COMPONENT, HINGE "track = @\"sunn\", face = [0, 0, 1] }\n", "\"sunn\"",
         "(did you mean \"sun\"?)", 0},
        {PART_COMPONENT,
         BUS "hinge = @{ origin_m = [0, 0, 0], axis = [0, 1, 0], track = \"sun\" }\n", "no 'face'",
         "3 numbers", 0},
        {PART_COMPONENT, HINGE "track = \"sun\", face = @[0, 2, 0] }\n", "parallel to the hinge",
         NULL, 0},
        {PART_COMPONENT, HINGE "track = \"sun\", face = @[0, 0, 0] }\n", "a zero vector",
         "a direction", 0},
        {PART_COMPONENT, HINGE "track = \"sun\", face = [0, 0, 1], angle_deg = @3 }\n",
         "both 'track' and 'angle_deg'", "one drive", 0},
        {PART_COMPONENT, HINGE "track = \"sun\", face = [0, 0, 1], rate_deg_s = @3 }\n",
         "both 'track' and 'rate_deg_s'", "one drive", 0},
        {PART_COMPONENT, HINGE "angle_deg = 3, face = @[0, 0, 1] }\n", "'face' belongs to 'track'",
         "both or neither", 0},
        {PART_COMPONENT, HINGE "table = @\"angles.csv\" }\n", "cannot open", "angles.csv", 0},
        {PART_COMPONENT, HINGE "table = \"angles.csv\", angle_deg = @3 }\n",
         "both 'table' and 'angle_deg'", "one drive", 2},
        {PART_COMPONENT, HINGE "track = \"sun\", face = [0, 0, 1], table = @\"angles.csv\" }\n",
         "both 'track' and 'table'", "one drive", 2},
        {PART_COMPONENT, HINGE "angle_deg = 3, shortest_way = @true }\n",
         "'shortest_way' belongs to 'table'", "both or neither", 0},
        {PART_COMPONENT, HINGE "angle_deg = @\"9\" }\n", "the string \"9\"", "a number in deg", 1},
        {PART_COMPONENT, HINGE "angle_deg = 0, limits_deg = @[30, -30] }\n",
         "the lower limit lies above", "[lower, upper]", 0},
        {PART_COMPONENT, HINGE "angle_deg = 0, limits_deg = @[30] }\n", "1 elements", "2 numbers",
         0},
        {PART_COMPONENT, HINGE "angle_deg = 0, offset_deg = @400 }\n", "400",
         "between -360 and 360", 0},
        {PART_COMPONENT, HINGE "angle_deg = 0, @rate_deg = 3 }\n", "unknown key 'rate_deg'",
         "did you mean 'rate_deg_s'?", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

/* ------------------------------------------------------------------ primitives */

#define MAT "material = \"white\"\n"
#define PLATE "[[component.plate]]\n" MAT
#define BOX "[[component.box]]\nsize_m = [1, 2, 3]\n" MAT
#define PRISM "[[component.prism]]\n" MAT
#define FACET "[[component.facet]]\n" MAT

START_TEST(test_scenario_primitive_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_PRIMITIVE, "@" PLATE "normal = [0, 0, 1]\ntangent = [1, 0, 0]\n", "no 'size_m'",
         "2 numbers", 0},
        {PART_PRIMITIVE, PLATE "size_m = [1, @\"1\"]\nnormal = [0, 0, 1]\ntangent = [1, 0, 0]\n",
         "the string", "a number", 0},
        {PART_PRIMITIVE, PLATE "size_m = @[1, 1, 1]\nnormal = [0, 0, 1]\ntangent = [1, 0, 0]\n",
         "3 elements", "2 numbers", 0},
        {PART_PRIMITIVE, PLATE "size_m = @[1, -1]\nnormal = [0, 0, 1]\ntangent = [1, 0, 0]\n", "-1",
         "expected", 0},
        {PART_PRIMITIVE, PLATE "size_m = [1, 1]\nnormal = @[0, 0, 0]\ntangent = [1, 0, 0]\n",
         "a zero vector", "a direction", 0},
        {PART_PRIMITIVE, PLATE "size_m = [1, 1]\nnormal = [0, 0, 1]\ntangent = @[0, 0, -3]\n",
         "tangent", "expected", 0},
        {PART_PRIMITIVE,
         PLATE "size_m = [1, 1]\nnormal = [0, 0, 1]\ntangent = [1, 0, 0]\n"
               "back_material = @\"grey\"\n",
         "no material 'grey'", "[materials.NAME]", 0},
        {PART_PRIMITIVE, "@[[component.box]]\nsize_m = [1, 1, 1]\n", "face +x has no material",
         "expected the key material", 0},
        {PART_PRIMITIVE, BOX "faces = { \"+z\" = @\"grey\" }\n", "no material 'grey'",
         "[materials.NAME]", 0},
        {PART_PRIMITIVE, BOX "faces = { @\"+w\" = \"white\" }\n", "unknown key '+w'", NULL, 0},
        {PART_PRIMITIVE, BOX "crinkle = { facets_per_side = @1, tilt_rms_deg = 4, seed = 7 }\n",
         "the number 1", "a whole number from 2 to 256", 0},
        {PART_PRIMITIVE, BOX "crinkle = { facets_per_side = 8, tilt_rms_deg = @61 }\n", "61",
         "above 0 and at most 60", 0},
        {PART_PRIMITIVE, BOX "crinkle = @{ facets_per_side = 8 }\n", "no 'tilt_rms_deg'", "deg", 0},
        {PART_PRIMITIVE, BOX "crinkle = { facets_per_side = 8, tilt_rms_deg = 4, @sed = 7 }\n",
         "unknown key 'sed'", "did you mean 'seed'?", 0},
        {PART_PRIMITIVE, BOX "rotation_deg = @{ axis = [0, 0, 1] }\n", "no 'angle'", "deg", 0},
        {PART_PRIMITIVE, BOX "rotation_deg = { axis = @[0, 0], angle = 1 }\n", "2 elements",
         "3 numbers", 0},
        {PART_PRIMITIVE, BOX "repeat = { count = @0, axis = [0, 0, 1], step_deg = 1 }\n",
         "the number 0", "from 1 to", 0},
        {PART_PRIMITIVE, BOX "repeat = { count = @1.5, axis = [0, 0, 1], step_deg = 1 }\n", "1.5",
         "a whole number", 0},
        {PART_PRIMITIVE, BOX "repeat = @{ count = 2, axis = [0, 0, 1] }\n", "no 'step_deg'", "deg",
         0},
        {PART_PRIMITIVE, BOX "mirror = @\"xy\"\n", "\"xy\"", "x, y, z", 0},
        {PART_PRIMITIVE, PRISM "radius_m = 1\nlength_m = 2\nsides = @2\n", "the number 2",
         "a whole number from 3", 0},
        {PART_PRIMITIVE, PRISM "radius_m = 1\nlength_m = 2\nsides = @8.0\n", "the number 8",
         "a whole number", 0},
        {PART_PRIMITIVE, PRISM "radius_m = @0\nlength_m = 2\nsides = 8\n", "the number 0",
         "expected", 0},
        {PART_PRIMITIVE, PRISM "radius_m = 1\nlength_m = 2\nsides = 8\nopen = @0\n", "the number 0",
         "true or false", 0},
        {PART_PRIMITIVE, PRISM "radius_m = 1\nlength_m = 2\nsides = 8\n@radius = 1\n",
         "unknown key 'radius'", "did you mean 'radius_m'?", 0},
        {PART_PRIMITIVE, "[[component.sphere]]\nradius_m = 1\nfacets = @1000\n" MAT, "1000", "20",
         0},
        {PART_PRIMITIVE, FACET "vertices_m = @[[0, 0, 0], [1, 0, 0]]\n", "2 points",
         "three or more", 0},
        {PART_PRIMITIVE, FACET "vertices_m = [[0, 0, 0], [1, 0, 0], @[1, 1]]\n", "2 elements",
         "3 numbers", 0},
        {PART_PRIMITIVE, FACET "vertices_m = @[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1]]\n",
         "off the plane", "one plane", 0},
        {PART_PRIMITIVE, FACET "vertices_m = @[[0, 0, 0], [1, 0, 0], [0.2, 0.2, 0], [0, 1, 0]]\n",
         "inwards", "convex", 0},
        {PART_PRIMITIVE, FACET "vertices_m = @[[0, 0, 0], [1, 0, 0], [2, 0, 0]]\n", "no area",
         "expected", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

static Suite *model_errors_suite(void)
{
    Suite *suite = suite_create("model errors");
    TCase *model = tcase_create("model");
    tcase_set_timeout(model, 60);
    tcase_add_checked_fixture(model, folder_make, folder_remove);
    tcase_add_test(model, test_scenario_satellite_wrong_is_refused);
    tcase_add_test(model, test_scenario_model_file_absent_or_unreadable_is_refused);
    tcase_add_test(model, test_scenario_model_file_errors_are_in_the_model_file);
    tcase_add_test(model, test_scenario_model_without_facets_is_refused);
    tcase_add_test(model, test_scenario_of_a_model_file_is_refused);
    tcase_add_test(model, test_scenario_material_wrong_is_refused);
    tcase_add_test(model, test_scenario_materials_from_wrong_file_is_refused);
    tcase_add_test(model, test_scenario_component_wrong_is_refused);
    tcase_add_test(model, test_scenario_components_in_a_circle_are_refused);
    tcase_add_test(model, test_scenario_hinge_wrong_is_refused);
    tcase_add_test(model, test_scenario_primitive_wrong_is_refused);
    suite_add_tcase(suite, model);
    return suite;
}

int main(void)
{
    return run_suite(model_errors_suite());
}
