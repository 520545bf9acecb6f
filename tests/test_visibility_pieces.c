/* Facets cut up along outlines and shadows: against the worked case, the fractions that the curves
 * are made of, and what always holds of parts of a whole. */
#include "facets/visibility_pieces.h"

#include "shapes.h"

static const double x_axis[3] = {1, 0, 0}, z_axis[3] = {0, 0, 1};

enum { N_COMPONENTS = 2 };

/* A model under test. */
typedef struct scene {
    facet_list facets;
    brdf_lobe lobe;
    brdf_material band;
    model_material material;
    model_component parts[N_COMPONENTS];
    visibility_component components[N_COMPONENTS];
    visibility_pose poses[N_COMPONENTS];
    model model;
    visibility *plan;
    visibility_pieces pieces;
} scene;

static scene *scene_new(void)
{
    scene *s = calloc(1, sizeof *s);
    s->lobe = (brdf_lobe){.model = brdf_model_named("lambert"), .weight = 1.0, .params = {0.5}};
    ck_assert_int_eq(brdf_lobe_prepare(&s->lobe, NULL), GLINT_OK);
    s->band = (brdf_material){1, &s->lobe};
    s->material = (model_material){"grey", &s->band};
    for (int c = 0; c < N_COMPONENTS; c++) {
        s->parts[c].name = "part";
        s->components[c].parent = -1;
        mat_identity(s->components[c].pose.body_component);
    }
    return s;
}

static void scene_plan(scene *s)
{
    ck_assert_int_eq(
        model_compile(&s->facets, &s->material, 1, s->parts, N_COMPONENTS, 1, &s->model, NULL),
        GLINT_OK);
    ck_assert_int_eq(visibility_make(&s->model, s->components, &s->plan, NULL), GLINT_OK);
    for (int c = 0; c < N_COMPONENTS; c++)
        s->poses[c] = s->components[c].pose;
}

static void scene_free(scene *s)
{
    visibility_pieces_free(&s->pieces);
    visibility_free(s->plan);
    model_free(&s->model);
    free(s);
}

static void cut(scene *s, const double *sun, const double observer[3])
{
    visibility_pieces_free(&s->pieces);
    ck_assert_int_eq(
        visibility_pieces_find(s->plan, &s->model, s->poses, sun, true, observer, &s->pieces, NULL),
        GLINT_OK);
}

/* Area of a facet's pieces in that light, m^2. */
static double area_of(const scene *s, int index, visibility_light light)
{
    double sum = 0.0;
    for (int k = 0; k < s->pieces.n; k++)
        if (s->pieces.items[k].facet == index && s->pieces.items[k].light == light)
            sum += s->pieces.items[k].area_m2;
    return sum;
}

/* Area of all pieces as the observer sees them, from their corners, m^2. */
static double projected_area(const scene *s, const double observer[3])
{
    double sum = 0.0;
    for (int k = 0; k < s->pieces.n; k++) {
        const visibility_piece *piece = &s->pieces.items[k];
        const double(*p)[3] = (const double(*)[3])s->pieces.points + piece->first;
        for (int v = 2; v < piece->n; v++) {
            double a[3], b[3], c[3];
            sub3(p[v - 1], p[0], a), sub3(p[v], p[0], b);
            cross3(a, b, c);
            const double area_m2 = 0.5 * dot3(c, observer);
            ck_assert_msg(area_m2 > -1e-12, "piece %d runs clockwise: %g m^2", k, area_m2);
            sum += area_m2;
        }
    }
    return sum;
}

static void add_plate(scene *s, double a_m, double b_m, double z_m)
{
    const double centre[3] = {0, 0, z_m};
    primitive_spec spec = plate_shape(a_m, b_m, centre, z_axis, x_axis);
    shape_add(&spec, 0, &s->facets);
}

/* A box with a hollow dish over it, a wing that goes through it, and a ball beside it. */
static void add_satellite(scene *s)
{
    primitive_spec bus = box_shape(2, 2, 3), dish = shape("dish");
    shape_add(&bus, 0, &s->facets);
    SET(&dish, "radius_m", 0.75);
    SET(&dish, "depth_m", 0.3);
    SET(&dish, "centre_m", 0, 0, 1.8);
    shape_material(&dish, "material", 0);
    shape_material(&dish, "back_material", 0);
    shape_add(&dish, 0, &s->facets);
    const double centre[3] = {0, 0.5, 0}, normal[3] = {1, 0, 1}, y_axis[3] = {0, 1, 0};
    primitive_spec wing = plate_shape(8, 1.5, centre, normal, y_axis);
    shape_material(&wing, "back_material", 0);
    shape_add(&wing, 1, &s->facets);
    primitive_spec ball = sphere_shape(0.4, 320);
    SET(&ball, "centre_m", 1.6, -1.2, 0.7);
    shape_add(&ball, 1, &s->facets);
}

/* Physics page, section 6. */
START_TEST(test_pieces_two_plates)
{
    const double sun[3] = {sin(30 * DEG), 0, cos(30 * DEG)};
    const double observer[3] = {-sin(45 * DEG), 0, cos(45 * DEG)};
    scene *s = scene_new();
    add_plate(s, 4, 4, 0);
    add_plate(s, 2, 2, 1);
    scene_plan(s);
    cut(s, sun, observer);
    assert_near(area_of(s, 0, VISIBILITY_LIT), 8.845299461620748, 1e-13);
    /* The upper plate hides 2 x 2 m^2, from x = 0 to 2; its shadow, of the same size, begins at
     * x = -1 - tan 30 deg, and what of it lies at x < 0 is seen. */
    const double shadow_m2 = 2.0 * (1.0 + tan(30 * DEG));
    assert_near(area_of(s, 0, VISIBILITY_SHADOWED), shadow_m2, 1e-13);
    assert_near(area_of(s, 1, VISIBILITY_LIT), 4.0, 1e-14);
    scene_free(s);
}
END_TEST

START_TEST(test_pieces_areas_are_the_fractions)
{
    scene *s = scene_new();
    add_satellite(s);
    scene_plan(s);
    visibility_scratch *scratch;
    ck_assert_int_eq(visibility_scratch_make(s->plan, &scratch, NULL), GLINT_OK);
    /* Coordinates are good to 1e-15 m, which a view at a slant magnifies in the plane of a facet.
     */
    static const double AREA_M2 = 1e-12;
    double *visible = malloc((size_t)s->model.n_facets * BRDF_TILE * sizeof *visible);
    for (int look = 0; look < 20; look++) {
        const double a = 0.7 * look, b = 1.3 * look + 0.4;
        const double towards_sun[3] = {cos(a), sin(a), sin(0.9 * look)};
        const double towards_observer[3] = {cos(b), sin(b), cos(1.7 * look)};
        double sun[3], observer[3];
        unit3(towards_sun, sun), unit3(towards_observer, observer);
        mat_turn(z_axis, 0.05 * look, s->poses[1].body_component);
        cut(s, sun, observer);
        ck_assert_int_eq(
            visibility_fill(s->plan, scratch, s->poses, sun, observer, 0, visible, NULL), GLINT_OK);
        for (int k = 0; k < s->model.n_facets; k++) {
            const double whole_m2 = s->model.polygons.items[k].area_m2;
            const double expected_m2 = visible[(size_t)k * BRDF_TILE] * whole_m2;
            assert_near(area_of(s, k, VISIBILITY_LIT), expected_m2, AREA_M2);
        }
        /* What is lit from where the observer stands is what he sees, in whatever light. */
        ck_assert_int_eq(
            visibility_fill(s->plan, scratch, s->poses, observer, observer, 0, visible, NULL),
            GLINT_OK);
        for (int k = 0; k < s->model.n_facets; k++) {
            const double whole_m2 = s->model.polygons.items[k].area_m2;
            const double seen_m2 = area_of(s, k, VISIBILITY_LIT) +
                                   area_of(s, k, VISIBILITY_SHADOWED) +
                                   area_of(s, k, VISIBILITY_TURNED_AWAY);
            assert_near(seen_m2, visible[(size_t)k * BRDF_TILE] * whole_m2, AREA_M2);
        }
    }
    free(visible);
    visibility_scratch_free(scratch);
    scene_free(s);
}
END_TEST

/* What is seen does not depend on the light, and a body's outline has the area that it has. */
START_TEST(test_pieces_seen_area_is_the_outline)
{
    scene *s = scene_new();
    primitive_spec box = box_shape(1, 2, 3);
    shape_add(&box, 0, &s->facets);
    add_plate(s, 6, 6, -1.6); /* one-sided; the box hovers over it */
    scene_plan(s);
    const double above[3] = {2.0 / 7, 3.0 / 7, 6.0 / 7}, sun[3] = {-0.6, 0, 0.8};
    /* Seen from above: the plate's outline, and what of the box stands out beyond it: nothing. Its
     * top, 3.1 m over the plate, is seen 1.0 and 1.6 m aside, where the plate has 2.5 and 2 m. */
    cut(s, sun, above);
    assert_near(projected_area(s, above), 36.0 * above[2], 1e-12);
    cut(s, NULL, above);
    assert_near(projected_area(s, above), 36.0 * above[2], 1e-12);
    for (int k = 0; k < s->model.n_facets; k++)
        assert_near(area_of(s, k, VISIBILITY_LIT), 0.0, 0.0);
    /* From below there is the black back of the plate alone. */
    const double below[3] = {2.0 / 7, 3.0 / 7, -6.0 / 7};
    cut(s, sun, below);
    assert_near(projected_area(s, below), 36.0 * above[2], 1e-12);
    double back_m2 = 0.0;
    for (int k = 0; k < s->model.n_facets; k++)
        back_m2 += area_of(s, k, VISIBILITY_BACK);
    assert_near(back_m2, 36.0, 1e-12);
    scene_free(s);
}
END_TEST

/* Length of the edges of a kind that are seen, m. */
static double length_of(const scene *s, visibility_edge_kind kind)
{
    double sum = 0.0, d[3];
    for (int k = 0; k < s->pieces.n_edges; k++) {
        if (s->pieces.edges[k].kind != kind) continue;
        sub3(s->pieces.edges[k].to_m, s->pieces.edges[k].from_m, d);
        sum += norm3(d);
    }
    return sum;
}

START_TEST(test_pieces_edges_of_a_box)
{
    scene *s = scene_new();
    primitive_spec box = box_shape(1, 2, 3);
    shape_add(&box, 0, &s->facets);
    scene_plan(s);
    const double corner[3] = {2.0 / 7, 3.0 / 7, 6.0 / 7};
    cut(s, z_axis, corner);
    assert_near(length_of(s, VISIBILITY_CREASE), 1 + 2 + 3,
                1e-14); /* the three that meet nearest */
    assert_near(length_of(s, VISIBILITY_RIM), 2 * (1 + 2 + 3), 1e-14);
    for (int k = 0; k < s->pieces.n_edges; k++)
        assert_near(s->pieces.edges[k].turn_rad, PI / 2, 1e-15);
    scene_free(s);
}
END_TEST

START_TEST(test_pieces_edges_hidden_in_part)
{
    scene *s = scene_new();
    add_plate(s, 4, 4, 0);
    primitive_spec box = box_shape(1, 6, 1);
    SET(&box, "centre_m", 0, 0, 2);
    shape_add(&box, 0, &s->facets);
    scene_plan(s);
    cut(s, z_axis, z_axis);
    /* From above the bar of 1 x 6 hides 1 m of two edges of the plate. */
    assert_near(length_of(s, VISIBILITY_RIM), (16 - 2) + 14, 1e-13);
    scene_free(s);
}
END_TEST

START_TEST(test_pieces_sphere_has_no_creases)
{
    scene *s = scene_new();
    primitive_spec ball = sphere_shape(1, 1280);
    shape_add(&ball, 0, &s->facets);
    scene_plan(s);
    const double observer[3] = {2.0 / 7, 3.0 / 7, 6.0 / 7};
    cut(s, z_axis, observer);
    assert_near(length_of(s, VISIBILITY_CREASE), 0.0, 0.0);
    ck_assert(length_of(s, VISIBILITY_SMOOTH) > 0.0);
    scene_free(s);
}
END_TEST

/* ---------------------------------------------------- what can shadow what */

START_TEST(test_visibility_counts_what_can_be_shadowed_by_what)
{
    scene *s = scene_new();
    primitive_spec box = box_shape(2, 2, 2); /* component 0: faces at +-1 m */
    shape_add(&box, 0, &s->facets);
    const double beside[3] = {0, 3, 0};
    primitive_spec wing = plate_shape(1, 4, beside, z_axis, x_axis); /* from y = 1 m to 5 m */
    shape_material(&wing, "back_material", 0);
    shape_add(&wing, 1, &s->facets);
    scene_plan(s);
    int counts[N_COMPONENTS * N_COMPONENTS];
    enum { BOX_BY_BOX, BOX_BY_WING, WING_BY_BOX, WING_BY_WING };
    ck_assert_int_eq(visibility_count_exposed(&s->model, s->components, counts, NULL), GLINT_OK);
    ck_assert_int_eq(counts[BOX_BY_BOX], 0);  /* convex */
    ck_assert_int_eq(counts[BOX_BY_WING], 1); /* the face at y = 1 m alone */
    ck_assert_int_eq(counts[WING_BY_BOX], 2);
    ck_assert_int_eq(counts[WING_BY_WING], 0);
    ck_assert_int_eq(visibility_n_exposed(s->plan), 3);
    /* Turning about x through the middle of the box, it comes before four faces: x = +-1 m stay
     * out of reach of a wing that is 0.5 m wide. */
    s->components[1].moves = true;
    copy3(x_axis, s->components[1].axis);
    ck_assert_int_eq(visibility_count_exposed(&s->model, s->components, counts, NULL), GLINT_OK);
    ck_assert_int_eq(counts[BOX_BY_BOX], 0);
    ck_assert_int_eq(counts[BOX_BY_WING], 4);
    ck_assert_int_eq(counts[WING_BY_BOX], 2);
    ck_assert_int_eq(counts[WING_BY_WING], 0);
    scene_free(s);
}
END_TEST

START_TEST(test_visibility_counts_what_shadows_itself)
{
    scene *s = scene_new();
    add_satellite(s);
    scene_plan(s);
    int counts[N_COMPONENTS * N_COMPONENTS];
    ck_assert_int_eq(visibility_count_exposed(&s->model, s->components, counts, NULL), GLINT_OK);
    int n_first = 0;
    for (int k = 0; k < s->model.n_facets; k++)
        n_first += s->model.polygons.items[k].component == 0;
    /* Of the box's six faces the upper one alone has the dish before it, which is narrower than the
     * box; the dish's facets have the box or the rest of the dish before them. */
    ck_assert_int_eq(counts[0], n_first - 5);
    ck_assert_int_gt(counts[1], 0);
    ck_assert_int_gt(counts[2], 0);
    ck_assert_int_gt(counts[3], 0);
    scene_free(s);
}
END_TEST

int main(void)
{
    TCase *cases = tcase_create("visibility_pieces");
    tcase_set_timeout(cases, 60);
    tcase_add_test(cases, test_pieces_two_plates);
    tcase_add_test(cases, test_pieces_areas_are_the_fractions);
    tcase_add_test(cases, test_pieces_seen_area_is_the_outline);
    tcase_add_test(cases, test_pieces_edges_of_a_box);
    tcase_add_test(cases, test_pieces_edges_hidden_in_part);
    tcase_add_test(cases, test_pieces_sphere_has_no_creases);
    tcase_add_test(cases, test_visibility_counts_what_can_be_shadowed_by_what);
    tcase_add_test(cases, test_visibility_counts_what_shadows_itself);
    Suite *suite = suite_create("visibility_pieces");
    suite_add_tcase(suite, cases);
    return run_suite(suite);
}
