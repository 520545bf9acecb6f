/* The fans around the corners of surfaces, counted by hand. */
#include "facets/visibility_fans.h"

#include "shapes.h"

enum { SIDES = 12, RINGS = 4 };

typedef struct found {
    facet_list facets;
    model model;
    brdf_lobe lobe;
    brdf_material band;
    solids solids;
    fans fans;
} found;

static void add_dish(found *f, bool two_sided, double axis_z)
{
    primitive_spec spec = shape("dish");
    SET(&spec, "radius_m", 1);
    SET(&spec, "depth_m", 0.3);
    SET(&spec, "sides", SIDES);
    SET(&spec, "rings", RINGS);
    SET(&spec, "centre_m", 0, 0, 0);
    SET(&spec, "axis", 0, 0, axis_z);
    shape_material(&spec, "material", 0);
    if (two_sided) shape_material(&spec, "back_material", 0);
    shape_add(&spec, 0, &f->facets);
}

static void find(found *f)
{
    static const model_component part = {"all"};
    f->lobe = (brdf_lobe){.model = brdf_model_named("lambert"), .weight = 1.0, .params = {0.5}};
    ck_assert_int_eq(f->lobe.model->prepare(f->lobe.params, f->lobe.coef, NULL), GLINT_OK);
    f->band = (brdf_material){1, &f->lobe};
    const model_material grey = {"grey", &f->band};
    ck_assert_int_eq(model_compile(&f->facets, &grey, 1, &part, 1, 1, &f->model, NULL), GLINT_OK);
    ck_assert_int_eq(solids_find(&f->model, &f->solids, NULL), GLINT_OK);
    ck_assert_int_eq(fans_find(&f->model, &f->solids, &f->fans, NULL), GLINT_OK);
}

static void let_go(found *f)
{
    fans_free(&f->fans);
    solids_free(&f->solids);
    model_free(&f->model);
    facet_list_free(&f->facets);
}

static bool has(const fans *f, int fan, int facet_index)
{
    for (int k = f->first[fan]; k < f->first[fan + 1]; k++)
        if (f->facets[k] == facet_index) return true;
    return false;
}

/* Every corner within the rim has a fan that its facet is part of, with the four facets around it
 * (at the vertex as many as there are sides), all on one side of the dish. At the rim of a thin
 * dish the two sides together go around a corner: nobody sees all of these from in front. */
static void check_fans(const found *f)
{
    for (int k = 0; k < f->model.n_facets; k++) {
        const facet *own = &f->model.polygons.items[k];
        for (int c = own->first_vertex; c < own->first_vertex + own->n_vertices; c++) {
            const double *at = f->model.polygons.vertices[c];
            const double radius_m = hypot(at[0], at[1]);
            const int fan = f->fans.at_corner[c];
            ck_assert_int_eq(fan >= 0, radius_m < 1 - 0.5 / RINGS);
            if (fan < 0) continue;
            ck_assert(has(&f->fans, fan, k));
            ck_assert_int_eq(f->fans.first[fan + 1] - f->fans.first[fan],
                             radius_m < 0.5 / RINGS ? SIDES : 4);
            for (int j = f->fans.first[fan]; j < f->fans.first[fan + 1]; j++) {
                const facet *other = &f->model.polygons.items[f->fans.facets[j]];
                ck_assert(own->normal[2] * other->normal[2] > 0.0);
            }
        }
    }
}

START_TEST(test_fans_of_a_dish)
{
    found f = {0};
    add_dish(&f, false, 1);
    find(&f);
    ck_assert_int_eq(f.fans.n, (RINGS - 1) * SIDES + 1);
    check_fans(&f);
    let_go(&f);
}
END_TEST

/* Front and back share their corners. */
START_TEST(test_fans_of_a_thin_dish_are_two_at_each_corner)
{
    found f = {0};
    add_dish(&f, true, 1);
    find(&f);
    ck_assert_int_eq(f.fans.n, 2 * ((RINGS - 1) * SIDES + 1));
    check_fans(&f);
    let_go(&f);
}
END_TEST

/* Two dishes share their vertex, and nothing else. */
START_TEST(test_fans_of_surfaces_that_meet_in_a_point_are_apart)
{
    found f = {0};
    add_dish(&f, false, 1);
    add_dish(&f, false, -1);
    find(&f);
    ck_assert_int_eq(f.fans.n, 2 * ((RINGS - 1) * SIDES + 1));
    check_fans(&f);
    let_go(&f);
}
END_TEST

/* Two sheets of a winding stair, of which the upper one leads down to the lower one's beginning. */
START_TEST(test_fans_that_wind_twice_are_not_listed)
{
    static const double z_m[8] = {0, 0.1, 0.25, 0.3, 0.4, 0.35, 0.15, 0.05};
    const double tangent[3] = {0, 0, 1};
    found f = {0};
    for (int k = 0; k < 8; k++) {
        const int next = (k + 1) % 8;
        const double turn = 0.25 * TWO_PI * k;
        const double triangle[3][3] = {
            {0, 0, 0}, {cos(turn), sin(turn), z_m[k]}, {-sin(turn), cos(turn), z_m[next]}};
        ck_assert_int_eq(facet_list_add(&f.facets, triangle, 3, tangent, 0, 0, NULL), GLINT_OK);
    }
    find(&f);
    ck_assert_int_eq(f.solids.n_edges, 8);
    ck_assert_int_eq(f.fans.n, 0);
    let_go(&f);
}
END_TEST

START_TEST(test_fans_of_convex_bodies_and_sheets_are_not_listed)
{
    found f = {0};
    const double centre_m[3] = {5, 0, 0}, normal[3] = {0, 0, 1}, tangent[3] = {1, 0, 0};
    primitive_spec box = shape("box"), plate = plate_shape(1, 1, centre_m, normal, tangent);
    SET(&box, "size_m", 1, 2, 3);
    shape_material(&box, "material", 0);
    shape_material(&plate, "back_material", 0);
    shape_add(&box, 0, &f.facets);
    shape_add(&plate, 0, &f.facets);
    find(&f);
    ck_assert_int_eq(f.fans.n, 0);
    for (int c = 0; c < f.model.polygons.n_vertices; c++)
        ck_assert_int_eq(f.fans.at_corner[c], -1);
    let_go(&f);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fans");
    TCase *tc = tcase_create("core");
    tcase_add_test(tc, test_fans_of_a_dish);
    tcase_add_test(tc, test_fans_of_a_thin_dish_are_two_at_each_corner);
    tcase_add_test(tc, test_fans_of_surfaces_that_meet_in_a_point_are_apart);
    tcase_add_test(tc, test_fans_that_wind_twice_are_not_listed);
    tcase_add_test(tc, test_fans_of_convex_bodies_and_sheets_are_not_listed);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
