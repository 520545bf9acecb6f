/* The compiled model: its order, its facts, and the sum over facets against closed forms. */
#include "shapes.h"

#include <stdint.h>

static const double origin[3] = {0, 0, 0};
static const double x_axis[3] = {1, 0, 0}, y_axis[3] = {0, 1, 0}, z_axis[3] = {0, 0, 1};

#define RANGE_M 1e6 /* of the closed forms: flux ratio = X / R^2 */

enum { MAX_MATERIALS = 4, MAX_COMPONENTS = 4, MAX_BANDS = 3 };

/* A model under test with its materials, of one lobe each. */
typedef struct bench {
    brdf_lobe lobes[MAX_MATERIALS][MAX_BANDS];
    brdf_material bands[MAX_MATERIALS][MAX_BANDS];
    model_material materials[MAX_MATERIALS];
    model_component components[MAX_COMPONENTS];
    facet_list facets;
    model model;
} bench;

static void set_material(bench *b, int material, int band, const char *name, const double *params)
{
    brdf_lobe *lobe = &b->lobes[material][band];
    *lobe = (brdf_lobe){.model = brdf_model_named(name), .weight = 1.0};
    ck_assert_ptr_nonnull(lobe->model);
    for (int k = 0; k < lobe->model->n_params; k++)
        lobe->params[k] = params[k];
    ck_assert_int_eq(lobe->model->prepare(lobe->params, lobe->coef, NULL), GLINT_OK);
    b->bands[material][band] = (brdf_material){1, lobe};
    b->materials[material] = (model_material){name, b->bands[material]};
}

static void set_lambert(bench *b, int material, int band, double rho)
{
    set_material(b, material, band, "lambert", &rho);
}

static void compile(bench *b, int n_materials, int n_components, int n_bands)
{
    for (int c = 0; c < n_components; c++)
        b->components[c].name = "part";
    const glint_status status = model_compile(&b->facets, b->materials, n_materials, b->components,
                                              n_components, n_bands, &b->model, NULL);
    ck_assert_int_eq(status, GLINT_OK);
    ck_assert_int_eq(b->facets.n, 0); /* taken over */
    ck_assert_ptr_null(b->facets.items);
}

/* A model of one Lambert material and one component from a primitive. */
static bench *lambert_bench(primitive_spec *spec, double rho)
{
    bench *b = calloc(1, sizeof *b);
    set_lambert(b, 0, 0, rho);
    shape_add(spec, 0, &b->facets);
    compile(b, 1, 1, 1);
    return b;
}

static void bench_free(bench *b)
{
    model_free(&b->model);
    free(b);
}

/* All lanes with one pair of directions (made unit). */
static brdf_light light_of(const double sun[3], const double observer[3])
{
    brdf_light light;
    double i[3], r[3];
    unit3(sun, i), unit3(observer, r);
    for (int k = 0; k < BRDF_TILE; k++)
        for (int j = 0; j < 3; j++)
            light.i[j][k] = i[j], light.r[j][k] = r[j];
    brdf_light_finish(&light);
    return light;
}

/* The whole sum, m^2/sr, of one band; every lane must say the same. */
static double total_in(const bench *b, const double sun[3], const double observer[3], int band)
{
    const model *m = &b->model;
    brdf_light lights[MAX_COMPONENTS];
    for (int c = 0; c < m->n_components; c++)
        lights[c] = light_of(sun, observer);
    double *x = malloc((size_t)m->n_bands * (size_t)m->n_spans * BRDF_TILE * sizeof *x);
    model_sum(m, lights, NULL, NULL, x);
    double sum = 0;
    for (int s = 0; s < m->n_spans; s++) {
        const double *lane = x + ((size_t)band * (size_t)m->n_spans + (size_t)s) * BRDF_TILE;
        for (int k = 1; k < BRDF_TILE; k++)
            ck_assert(lane[k] == lane[0]);
        sum += lane[0];
    }
    free(x);
    return sum;
}

static double total(const bench *b, const double sun[3], const double observer[3])
{
    return total_in(b, sun, observer, 0);
}

static double flux_ratio(const bench *b, const double sun[3], const double observer[3])
{
    return total(b, sun, observer) / (RANGE_M * RANGE_M);
}

/* A direction of the plane y = 0 at an angle from z towards x. */
static void in_plane(double deg, double out[3])
{
    out[0] = sin(deg * DEG), out[1] = 0, out[2] = cos(deg * DEG);
}

/* ---------------------------------------------------------------- compiling */

START_TEST(test_model_compile_sorts_by_component_then_material_and_keeps_order)
{
    static const int keys[9][2] = {{1, 0}, {0, 1}, {1, 1}, {0, 0}, {0, 1},
                                   {1, 0}, {0, 0}, {2, 1}, {0, 1}}; /* component, material */
    static const int order[9] = {3, 6, 1, 4, 8, 0, 5, 2, 7};
    bench b = {0};
    set_lambert(&b, 0, 0, 0.1);
    set_lambert(&b, 1, 0, 0.2);
    for (int k = 0; k < 9; k++) { /* facets told apart by their area k + 1 */
        primitive_spec spec = plate_shape(k + 1, 1, origin, z_axis, x_axis);
        shape_material(&spec, "material", keys[k][1]);
        shape_add(&spec, keys[k][0], &b.facets);
    }
    compile(&b, 2, 3, 1);
    const model *m = &b.model;
    ck_assert_int_eq(m->n_facets, 9);
    ck_assert_int_eq(m->n_spans, 5);
    int next = 0;
    for (int s = 0; s < m->n_spans; s++) {
        ck_assert_int_eq(m->spans[s].first, next);
        ck_assert_int_eq(m->spans[s].facets.n, m->spans[s].n);
        for (int k = 0; k < m->spans[s].n; k++, next++) {
            const int from = order[next];
            ck_assert_int_eq(m->spans[s].component, keys[from][0]);
            ck_assert_int_eq(m->spans[s].material, keys[from][1]);
            assert_near(m->spans[s].facets.area[k], from + 1, 0);
            const facet *f = &m->polygons.items[next];
            assert_near(f->area_m2, from + 1, 0);
            ck_assert_int_eq(f->first_vertex, 4 * next);
            assert_near(m->polygons.vertices[f->first_vertex][0], -0.5 * (from + 1), 0);
        }
    }
    ck_assert_int_eq(next, 9);
    model_free(&b.model);
}
END_TEST

START_TEST(test_model_compile_stores_right_handed_frames_of_the_polygons)
{
    primitive_spec spec = sphere_shape(1, 320);
    shape_rotate(&spec, 1, 2, 3, 40);
    bench *b = lambert_bench(&spec, 1);
    const model *m = &b->model;
    ck_assert_uint_eq((uintptr_t)m->arrays % 64, 0);
    for (int k = 0; k < m->n_facets; k++) {
        double bitangent[3];
        cross3(m->polygons.items[k].normal, m->polygons.items[k].tangent, bitangent);
        for (int j = 0; j < 3; j++) {
            assert_near(m->spans[0].facets.normal[j][k], m->polygons.items[k].normal[j], 0);
            assert_near(m->spans[0].facets.tangent[j][k], m->polygons.items[k].tangent[j], 0);
            assert_near(m->spans[0].facets.bitangent[j][k], bitangent[j], 0);
        }
    }
    bench_free(b);
}
END_TEST

START_TEST(test_model_compile_refuses_no_facets)
{
    bench b = {0};
    set_lambert(&b, 0, 0, 0.5);
    glint_error error;
    ck_assert_int_eq(model_compile(&b.facets, b.materials, 1, b.components, 1, 1, &b.model, &error),
                     GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "no facets"));
    ck_assert_ptr_null(b.model.spans);
    model_free(&b.model);
    model_free(NULL);
}
END_TEST

/* ---------------------------------------------------------------- facts */

static model_component_facts facts_of(const bench *b, int component)
{
    model_component_facts facts;
    ck_assert_int_eq(model_component_describe(&b->model, component, &facts, NULL), GLINT_OK);
    ck_assert_int_eq(facts.closed, facts.n_facets > 0 && facts.n_open_edges == 0);
    return facts;
}

START_TEST(test_model_describe_gives_box_and_area)
{
    primitive_spec spec = box_shape(2, 2.4, 3);
    SET(&spec, "centre_m", 1, 0, -1);
    bench *b = lambert_bench(&spec, 0.5);
    const model_component_facts facts = facts_of(b, 0);
    const double lo_m[3] = {0, -1.2, -2.5}, hi_m[3] = {2, 1.2, 0.5};
    ck_assert_int_eq(facts.n_facets, 6);
    assert_near(facts.area_m2, 36, 1e-14);
    assert_near3(facts.lo_m, lo_m, 0);
    assert_near3(facts.hi_m, hi_m, 0);
    ck_assert(facts.closed);
    bench_free(b);
}
END_TEST

START_TEST(test_model_describe_counts_open_edges_of_each_shape)
{
    static const double up_m[3] = {0, 0, 1};
    struct {
        primitive_spec spec;
        int n_open;
    } cases[] = {
        {plate_shape(1, 2, origin, x_axis, y_axis), 4},
        {plate_shape(1, 2, up_m, z_axis, y_axis), 0},
        {prism_shape(7, 1, 2), 0},
        {prism_shape(7, 1, 2), 14},
        {sphere_shape(3, 20), 0},
        {sphere_shape(3, 1280), 0},
        {box_shape(1, 1, 1), 0},
        {box_shape(1, 1, 1), 0},
    };
    shape_material(&cases[1].spec, "back_material", 0);
    SET(&cases[3].spec, "open", 1);
    shape_rotate(&cases[5].spec, 1, 2, 3, 33);
    SET(&cases[6].spec, "centre_m", 0.5, 0, 0);
    cases[6].spec.mirror = 1; /* two boxes that share a face */
    SET(&cases[7].spec, "centre_m", 1e6, 0, 0);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        bench *b = lambert_bench(&cases[k].spec, 0.5);
        ck_assert_int_eq(facts_of(b, 0).n_open_edges, cases[k].n_open);
        bench_free(b);
    }
}
END_TEST

/* A cube of edge 2 from six plates, each turned into place by its own rotation, and moved outwards
 * by a gap. */
static bench *cube_of_plates(double gap_m)
{
    static const double turns[6][4] = {{0, 0, 1, 0},   {0, 1, 0, 90}, {0, 1, 0, 180},
                                       {0, 1, 0, 270}, {1, 0, 0, 90}, {1, 0, 0, 270}};
    bench *b = calloc(1, sizeof *b);
    set_lambert(b, 0, 0, 0.2);
    for (int k = 0; k < 6; k++) {
        const double centre_m[3] = {0, 0, 1 + gap_m};
        primitive_spec spec = plate_shape(2, 2, centre_m, z_axis, x_axis);
        facet_list one = {0};
        shape_add(&spec, 0, &one);
        double turn[9], moved[4][3], tangent[3];
        mat_turn(turns[k], turns[k][3] * DEG, turn);
        for (int v = 0; v < 4; v++)
            mat_vec(turn, one.vertices[v], moved[v]);
        mat_vec(turn, one.items[0].tangent, tangent);
        ck_assert_int_eq(facet_list_add(&b->facets, moved, 4, tangent, 0, 0, NULL), GLINT_OK);
        facet_list_free(&one);
    }
    compile(b, 1, 1, 1);
    return b;
}

START_TEST(test_model_describe_matches_vertices_within_a_nanometre)
{
    bench *b = cube_of_plates(0); /* corners that differ by rounding */
    ck_assert(facts_of(b, 0).closed);
    bench_free(b);
    b = cube_of_plates(4e-10); /* neighbours 5.7e-10 m apart */
    ck_assert(facts_of(b, 0).closed);
    bench_free(b);
    b = cube_of_plates(1e-9); /* neighbours 1.4e-9 m apart */
    ck_assert_int_eq(facts_of(b, 0).n_open_edges, 24);
    bench_free(b);
}
END_TEST

START_TEST(test_model_describe_finds_facet_that_looks_inwards)
{
    bench *b = calloc(1, sizeof *b);
    set_lambert(b, 0, 0, 0.2);
    primitive_spec spec = box_shape(1, 1, 1);
    shape_add(&spec, 0, &b->facets);
    double(*v)[3] = b->facets.vertices; /* of the +x face: run backwards */
    for (int j = 0; j < 3; j++) {
        const double swap = v[1][j];
        v[1][j] = v[3][j], v[3][j] = swap;
    }
    compile(b, 1, 1, 1);
    ck_assert_int_eq(facts_of(b, 0).n_open_edges, 4);
    bench_free(b);
}
END_TEST

/* A spent stage: a 24-sided tube of 1.5 m by 8 m, closed by two 12-gons of the same radius. The
 * tube has 24 edges at either end, of which the 12 of the 12-gon are chords, not partners. */
START_TEST(test_model_describe_tells_components_apart)
{
    bench *b = calloc(1, sizeof *b);
    set_lambert(b, 0, 0, 0.3);
    set_lambert(b, 1, 0, 0.4);
    primitive_spec spec = prism_shape(24, 1.5, 8);
    SET(&spec, "open", 1);
    shape_add(&spec, 2, &b->facets);
    spec = shape("facet");
    double points[12][3];
    for (int k = 0; k < 12; k++) {
        points[k][0] = round(1.5e12 * cos(30 * k * DEG)) / 1e12; /* as a file has them */
        points[k][1] = round(1.5e12 * sin(30 * k * DEG)) / 1e12;
        points[k][2] = 4;
    }
    shape_points(&spec, points, 12);
    SET(&spec, "tangent", 1, 0, 0);
    shape_material(&spec, "material", 1);
    spec.mirror = 3;
    shape_add(&spec, 2, &b->facets);
    spec = prism_shape(12, 0.5, 1.2);
    SET(&spec, "centre_m", 0, 0, -4.6);
    shape_material(&spec, "cap_material", 1);
    shape_add(&spec, 0, &b->facets);
    compile(b, 2, 4, 1);
    const double tube_m2 = 24 * 2 * 1.5 * sin(7.5 * DEG) * 8, disc_m2 = 6.75;
    const double bell_m2 = 12 * 2 * 0.5 * sin(15 * DEG) * 1.2, cap_m2 = 0.75;
    model_component_facts facts = facts_of(b, 2);
    ck_assert_int_eq(facts.n_facets, 26);
    ck_assert_int_eq(facts.n_open_edges, 48 + 24);
    assert_rel(facts.area_m2, tube_m2 + 2 * disc_m2, 1e-12);
    facts = facts_of(b, 0);
    ck_assert_int_eq(facts.n_facets, 14);
    ck_assert(facts.closed);
    assert_rel(facts.area_m2, bell_m2 + 2 * cap_m2, 1e-14);
    assert_near(facts.lo_m[2], -5.2, 1e-15);
    facts = facts_of(b, 1);
    ck_assert_int_eq(facts.n_facets, 0);
    assert_near(facts.area_m2, 0, 0);
    assert_near3(facts.hi_m, origin, 0);
    int n;
    assert_rel(model_material_area(&b->model, 1, &n), 2 * disc_m2 + 2 * cap_m2, 1e-12);
    ck_assert_int_eq(n, 4);
    assert_rel(model_material_area(&b->model, 0, NULL), tube_m2 + bell_m2, 1e-14);
    bench_free(b);
}
END_TEST

/* ---------------------------------------------------------------- closed forms */

/* Flux ratios at 1000 km, from X = rho/pi A cos(i) cos(e) summed over lit and seen faces. */

START_TEST(test_model_sum_lambert_plate)
{
    primitive_spec spec = plate_shape(2, 1, origin, z_axis, x_axis);
    bench *b = lambert_bench(&spec, 0.3);
    double sun[3], observer[3];
    in_plane(30, sun), in_plane(-60, observer);
    assert_rel(flux_ratio(b, sun, observer), 8.269933431326883e-14, 1e-12);
    const double out_of_plane[3] = {0, sin(60 * DEG), cos(60 * DEG)};
    assert_rel(flux_ratio(b, sun, out_of_plane), 8.269933431326883e-14, 1e-12);
    bench_free(b);
}
END_TEST

START_TEST(test_model_sum_lambert_cube)
{
    const double sun[3] = {1, 2, 2}, observer[3] = {2, -1, 2};
    primitive_spec spec = box_shape(2, 2, 2);
    bench *b = lambert_bench(&spec, 0.2);
    assert_rel(flux_ratio(b, sun, observer), 1.697652726313550e-13, 1e-12);
    bench_free(b);
    b = cube_of_plates(0);
    assert_rel(flux_ratio(b, sun, observer), 1.697652726313550e-13, 1e-12);
    bench_free(b);
}
END_TEST

START_TEST(test_model_sum_rotating_plate)
{
    static const struct {
        double deg, flux_ratio; /* angle of the normal from the bisector; phase angle 50 deg */
    } cases[] = {{0, 3.137493222380783e-13},
                 {30, 2.182563563829411e-13},
                 {60, 2.727042467266678e-14},
                 {65, 0},
                 {90, 0},
                 {180, 0},
                 {-30, 2.182563563829411e-13},
                 {-60, 2.727042467266678e-14}};
    double sun[3], observer[3];
    in_plane(25, sun), in_plane(-25, observer);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        primitive_spec spec = plate_shape(3, 1, origin, z_axis, y_axis);
        shape_rotate(&spec, 0, 1, 0, cases[k].deg);
        bench *b = lambert_bench(&spec, 0.4);
        assert_rel(flux_ratio(b, sun, observer), cases[k].flux_ratio, 1e-12);
        bench_free(b);
    }
}
END_TEST

/* The relative error of a sphere of flat triangles at a phase angle, seen off its symmetries. */
static double sphere_error(const bench *b, double phase_deg, double flux)
{
    double sun[3], observer[3], turn[9], axis[3] = {1, 2, 3};
    in_plane(0, observer), in_plane(phase_deg, sun);
    unit3(axis, axis);
    mat_turn(axis, 0.7, turn);
    mat_vec(turn, sun, sun), mat_vec(turn, observer, observer);
    return flux_ratio(b, sun, observer) / flux - 1;
}

START_TEST(test_model_sum_lambert_sphere_converges_to_closed_form)
{
    /* F/F_sun = 2 rho r^2 [sin p + (pi - p) cos p] / (3 pi d^2). Flat triangles err by a term in
     * the square of their edge. What is left without it (`rest`, relative) and how far the ratio of
     * two errors may be from 4 (`irregular`) is smooth at full phase, and at others comes from the
     * few triangles at the terminator, a smaller and smaller share of the lit ones. */
    static const struct {
        double phase_deg, flux_ratio, rest, irregular;
    } cases[] = {{0, 1.666666666666667e-13, 1e-7, 0.02},
                 {60, 1.014996301740383e-13, 5e-6, 0.2},
                 {90, 5.305164769729845e-14, 5e-6, 0.2},
                 {120, 1.816629684070491e-14, 5e-6, 0.5}};
    double coarse[4] = {0}, fine[4] = {0};
    for (int level = 3; level < 7; level++) {
        primitive_spec spec = sphere_shape(1, 20 << 2 * level);
        bench *b = lambert_bench(&spec, 0.25);
        for (int c = 0; c < 4; c++) {
            coarse[c] = fine[c];
            fine[c] = sphere_error(b, cases[c].phase_deg, cases[c].flux_ratio);
            /* Second order: a quarter with every level. */
            if (level > 3) assert_near(coarse[c] / fine[c], 4, cases[c].irregular);
        }
        bench_free(b);
    }
    for (int c = 0; c < 4; c++) {
        assert_near(fine[c], 0, 8e-5);
        assert_near((4 * fine[c] - coarse[c]) / 3, 0, cases[c].rest);
    }
}
END_TEST

/* ---------------------------------------------------------------- properties of the sum */

/* A model of four reciprocal materials in three components, its pieces added in an order, and all
 * of it turned about the origin (NULL: not turned). */
enum { N_PIECES = 5 };

static void add_piece(bench *b, int piece)
{
    static const double wing_m[3] = {0, 5, 0}, dish_m[3] = {1.3, 0, 2}, tilted[3] = {1, 0.2, 2};
    primitive_spec spec;
    switch (piece) {
    case 0:
        spec = box_shape(2, 2.4, 3);
        spec.face_material[4] = 3;
        break;
    case 1:
        spec = plate_shape(2, 8, wing_m, tilted, x_axis);
        shape_material(&spec, "material", 1);
        shape_material(&spec, "back_material", 0);
        spec.mirror = 2;
        break;
    case 2:
        spec = sphere_shape(0.4, 80);
        SET(&spec, "centre_m", 0, 0, 2.1);
        shape_material(&spec, "material", 2);
        break;
    case 3:
        spec = prism_shape(9, 0.6, 1.5);
        SET(&spec, "axis", 1, 1, 0.3);
        shape_material(&spec, "material", 3);
        break;
    default:
        spec = plate_shape(1, 1, dish_m, tilted, y_axis);
        shape_material(&spec, "material", 2);
        break;
    }
    shape_add(&spec, piece < 3 ? piece : 0, &b->facets);
    for (int k = 0; k < b->facets.n;
         k++) /* facets as they are; test_curved.c has the curved ones */
        b->facets.items[k].surface = 0;
}

static void turn_facets(facet_list *list, const double turn[9])
{
    for (int k = 0; k < list->n; k++) {
        mat_vec(turn, list->items[k].normal, list->items[k].normal);
        mat_vec(turn, list->items[k].tangent, list->items[k].tangent);
    }
    for (int v = 0; v < list->n_vertices; v++)
        mat_vec(turn, list->vertices[v], list->vertices[v]);
}

static bench *mixed_bench(const int order[N_PIECES], const double turn[9])
{
    static const double panel[] = {0.17, 0.7, 0.12, 0.2, (double)NAN, (double)NAN};
    static const double foil[] = {0.1, 0.75, 0.3, 0.1, (double)NAN, (double)NAN};
    static const double glass[] = {0.05, 0.7, 80, 200};
    bench *b = calloc(1, sizeof *b);
    set_lambert(b, 0, 0, 0.6);
    set_material(b, 1, 0, "ward", panel);
    set_material(b, 2, 0, "ward-gmd", foil);
    set_material(b, 3, 0, "ashikhmin-shirley", glass);
    for (int k = 0; k < N_PIECES; k++)
        add_piece(b, order[k]);
    if (turn) turn_facets(&b->facets, turn);
    compile(b, 4, 3, 1);
    return b;
}

/* Relative: about 150 positive terms, added in another order or with factors swapped. */
#define ROUNDING 3e-14

static const int in_order[N_PIECES] = {0, 1, 2, 3, 4};

/* Pairs of directions over the whole sphere, the same on every run (a Weyl sequence). */
enum { N_PAIRS = 200 };

static void pair(int k, double sun[3], double observer[3])
{
    const double step[4] = {0.6180339887498949, 0.7548776662466927, 0.5698402909980532,
                            0.8191725133961645};
    double u[4];
    for (int j = 0; j < 4; j++)
        u[j] = fmod((k + 1) * step[j], 1.0);
    for (int j = 0; j < 2; j++) {
        const double z = 2 * u[2 * j] - 1, s = sqrt(1 - z * z), a = TWO_PI * u[2 * j + 1];
        double *out = j ? observer : sun;
        out[0] = s * cos(a), out[1] = s * sin(a), out[2] = z;
    }
}

START_TEST(test_model_sum_is_the_sum_of_its_facets)
{
    bench *b = mixed_bench(in_order, NULL);
    const model *m = &b->model;
    double brightest = 0;
    for (int p = 0; p < N_PAIRS; p++) {
        double sun[3], observer[3], want = 0;
        pair(p, sun, observer);
        for (int k = 0; k < m->n_facets; k++) { /* one by one, in the frame of the facet */
            const facet *f = &m->polygons.items[k];
            double bitangent[3], frame[9], i[3], r[3];
            cross3(f->normal, f->tangent, bitangent);
            mat_rows(f->tangent, bitangent, f->normal, frame);
            mat_vec(frame, sun, i), mat_vec(frame, observer, r);
            want += f->area_m2 * brdf_material_eval(&b->bands[f->material][0], i, r);
        }
        assert_rel(total(b, sun, observer), want, 1e-13);
        brightest = fmax(brightest, want);
    }
    ck_assert(brightest > 1); /* m^2/sr: something was seen */
    bench_free(b);
}
END_TEST

START_TEST(test_model_sum_of_parts_is_sum_of_whole)
{
    bench *whole = mixed_bench(in_order, NULL), *parts[N_PIECES];
    for (int k = 0; k < N_PIECES; k++) {
        parts[k] = calloc(1, sizeof *parts[k]);
        memcpy(parts[k]->bands, whole->bands, sizeof whole->bands);
        memcpy(parts[k]->materials, whole->materials, sizeof whole->materials);
        add_piece(parts[k], k);
        compile(parts[k], 4, 3, 1);
    }
    for (int p = 0; p < N_PAIRS; p++) {
        double sun[3], observer[3], sum = 0;
        pair(p, sun, observer);
        for (int k = 0; k < N_PIECES; k++)
            sum += total(parts[k], sun, observer);
        assert_rel(total(whole, sun, observer), sum, ROUNDING);
    }
    for (int k = 0; k < N_PIECES; k++)
        bench_free(parts[k]);
    bench_free(whole);
}
END_TEST

START_TEST(test_model_sum_stays_when_sun_and_observer_swap)
{
    bench *b = mixed_bench(in_order, NULL);
    for (int p = 0; p < N_PAIRS; p++) {
        double sun[3], observer[3];
        pair(p, sun, observer);
        assert_rel(total(b, observer, sun), total(b, sun, observer), ROUNDING);
    }
    bench_free(b);
}
END_TEST

START_TEST(test_model_sum_stays_when_everything_turns)
{
    double turn[9], axis[3] = {1, -2, 3};
    unit3(axis, axis);
    mat_turn(axis, 1.234, turn);
    bench *still = mixed_bench(in_order, NULL), *turned = mixed_bench(in_order, turn);
    for (int p = 0; p < N_PAIRS; p++) {
        double sun[3], observer[3], sun_turned[3], observer_turned[3];
        pair(p, sun, observer);
        mat_vec(turn, sun, sun_turned), mat_vec(turn, observer, observer_turned);
        assert_rel(total(turned, sun_turned, observer_turned), total(still, sun, observer), 1e-13);
    }
    bench_free(still);
    bench_free(turned);
}
END_TEST

START_TEST(test_model_sum_does_not_depend_on_order_of_primitives)
{
    static const int reversed[N_PIECES] = {4, 3, 2, 1, 0}, mixed[N_PIECES] = {2, 0, 4, 1, 3};
    bench *a = mixed_bench(in_order, NULL), *b = mixed_bench(reversed, NULL),
          *c = mixed_bench(mixed, NULL);
    for (int p = 0; p < N_PAIRS; p++) {
        double sun[3], observer[3];
        pair(p, sun, observer);
        const double want = total(a, sun, observer);
        assert_rel(total(b, sun, observer), want, ROUNDING);
        assert_rel(total(c, sun, observer), want, ROUNDING);
    }
    bench_free(a);
    bench_free(b);
    bench_free(c);
}
END_TEST

START_TEST(test_model_sum_of_edge_on_facet_is_zero)
{
    primitive_spec spec = plate_shape(1, 1, origin, z_axis, x_axis);
    bench *b = lambert_bench(&spec, 1);
    const double above[3] = {0, 0, 1};
    static const double dark[] = {0, 0.9e-12, -0.9e-12, -1};
    for (size_t k = 0; k < sizeof dark / sizeof *dark; k++) {
        const double along[3] = {dark[k] == -1 ? 0 : 1, 0, dark[k]};
        ck_assert(total(b, along, above) == 0.0);
        ck_assert(total(b, above, along) == 0.0);
    }
    const double just[3] = {1, 0, 1.1e-12};
    assert_rel(total(b, just, above), 1.1e-12 / PI, 1e-14);
    assert_rel(total(b, above, just), 1.1e-12 / PI, 1e-14);
    bench_free(b);
}
END_TEST

START_TEST(test_model_sum_weighs_facets_by_what_is_visible)
{
    bench *b = calloc(1, sizeof *b);
    set_lambert(b, 0, 0, 0.5);
    set_lambert(b, 1, 0, 0.25);
    primitive_spec spec = plate_shape(2, 1, origin, z_axis, x_axis); /* component 1, material 0 */
    shape_add(&spec, 1, &b->facets);
    spec = plate_shape(3, 1, origin, z_axis, x_axis); /* component 0, material 1 */
    shape_material(&spec, "material", 1);
    shape_add(&spec, 0, &b->facets);
    compile(b, 2, 2, 1);
    brdf_light lights[2] = {light_of(z_axis, z_axis), light_of(z_axis, z_axis)};
    for (int k = 0; k < BRDF_TILE;
         k++) { /* component 1 sees the Sun at another angle in each lane */
        lights[1].i[0][k] = sin(k * DEG), lights[1].i[2][k] = cos(k * DEG);
    }
    brdf_light_finish(&lights[1]);
    double visible[2][BRDF_TILE], x[2][BRDF_TILE];
    for (int k = 0; k < BRDF_TILE; k++)
        visible[0][k] = k / 31.0, visible[1][k] = 1 - k / 31.0;
    model_sum(&b->model, lights, NULL, &visible[0][0], &x[0][0]);
    for (int k = 0; k < BRDF_TILE; k++) {
        assert_rel(x[0][k], 3 * 0.25 / PI * (k / 31.0), 1e-15);
        assert_rel(x[1][k], 2 * 0.5 / PI * cos(k * DEG) * (1 - k / 31.0), 1e-15);
    }
    bench_free(b);
}
END_TEST

START_TEST(test_model_sum_evaluates_each_band)
{
    /* Material 0: bands 0 and 2 alike; material 1: all alike. */
    static const double rho[2][3] = {{0.5, 0.3, 0.5}, {0.2, 0.2, 0.2}};
    static const int same[6] = {0, 1, 0, 0, 0, 0};
    bench *b = calloc(1, sizeof *b);
    for (int material = 0; material < 2; material++)
        for (int band = 0; band < 3; band++)
            set_lambert(b, material, band, rho[material][band]);
    primitive_spec spec = plate_shape(1, 1, origin, z_axis, x_axis);
    shape_add(&spec, 0, &b->facets);
    spec = plate_shape(1, 4, origin, z_axis, x_axis);
    shape_material(&spec, "material", 1);
    shape_add(&spec, 0, &b->facets);
    compile(b, 2, 1, 3);
    for (int k = 0; k < 6; k++)
        ck_assert_int_eq(b->model.same_band[k], same[k]);
    for (int band = 0; band < 3; band++)
        assert_rel(total_in(b, z_axis, z_axis, band), (rho[0][band] + 4 * rho[1][band]) / PI,
                   4e-16);
    bench_free(b);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("model");
    TCase *compiling = tcase_create("compile"), *facts = tcase_create("facts"),
          *sum = tcase_create("sum");
    tcase_set_timeout(sum, 60);
    tcase_add_test(compiling, test_model_compile_sorts_by_component_then_material_and_keeps_order);
    tcase_add_test(compiling, test_model_compile_stores_right_handed_frames_of_the_polygons);
    tcase_add_test(compiling, test_model_compile_refuses_no_facets);
    tcase_add_test(facts, test_model_describe_gives_box_and_area);
    tcase_add_test(facts, test_model_describe_counts_open_edges_of_each_shape);
    tcase_add_test(facts, test_model_describe_matches_vertices_within_a_nanometre);
    tcase_add_test(facts, test_model_describe_finds_facet_that_looks_inwards);
    tcase_add_test(facts, test_model_describe_tells_components_apart);
    tcase_add_test(sum, test_model_sum_lambert_plate);
    tcase_add_test(sum, test_model_sum_lambert_cube);
    tcase_add_test(sum, test_model_sum_rotating_plate);
    tcase_add_test(sum, test_model_sum_lambert_sphere_converges_to_closed_form);
    tcase_add_test(sum, test_model_sum_is_the_sum_of_its_facets);
    tcase_add_test(sum, test_model_sum_of_parts_is_sum_of_whole);
    tcase_add_test(sum, test_model_sum_stays_when_sun_and_observer_swap);
    tcase_add_test(sum, test_model_sum_stays_when_everything_turns);
    tcase_add_test(sum, test_model_sum_does_not_depend_on_order_of_primitives);
    tcase_add_test(sum, test_model_sum_of_edge_on_facet_is_zero);
    tcase_add_test(sum, test_model_sum_weighs_facets_by_what_is_visible);
    tcase_add_test(sum, test_model_sum_evaluates_each_band);
    suite_add_tcase(suite, compiling);
    suite_add_tcase(suite, facts);
    suite_add_tcase(suite, sum);
    return run_suite(suite);
}
