/* Meshes in the light: they shine as the primitives that they are copies of, with and without
 * smooth normals, merged or not, with shadows or without; large files are read in good time. */
#include "bench.h"
#include "lightcurve/tile.h"
#include "mesh_files.h"

#include <limits.h>

/* ---------------------------------------------------------------- copies of primitives */

typedef void normal_at(const double point[3], double out[3]);

static void radial(const double point[3], double out[3])
{
    unit3(point, out);
}

static void across_z(const double point[3], double out[3])
{
    const double p[3] = {point[0], point[1], 0};
    unit3(p, out);
}

/* Writes facets as an OBJ file, polygons as they are. normal: of the surface at a corner; NULL:
 * none are written, and none for facets that look along z. */
static void write_facets(const char *name, const facet_list *list, normal_at *normal)
{
    text t = {0};
    for (int v = 0; v < list->n_vertices; v++) {
        const double *p = list->vertices[v];
        double n[3] = {0, 0, 1};
        text_printf(&t, "v %.17g %.17g %.17g\n", p[0], p[1], p[2]);
        if (normal) normal(p, n);
        text_printf(&t, "vn %.17g %.17g %.17g\n", n[0], n[1], n[2]);
    }
    for (int k = 0; k < list->n; k++) {
        const facet *f = &list->items[k];
        text_char(&t, 'f');
        for (int v = f->first_vertex + 1; v <= f->first_vertex + f->n_vertices; v++)
            if (normal && fabs(f->normal[2]) < 1 - 1e-12)
                text_printf(&t, " %d//%d", v, v);
            else
                text_printf(&t, " %d", v);
        text_char(&t, '\n');
    }
    write_bytes(name, t.data, t.length);
    text_free(&t);
}

/* Writes triangles as an STL text whose solid has a name. */
static void write_triangles(const char *name, const facet_list *list)
{
    text t = {0};
    text_add(&t, "solid ball\n");
    for (int k = 0; k < list->n; k++) {
        const double(*p)[3] = (const double(*)[3])list->vertices + list->items[k].first_vertex;
        text_add(&t, "facet normal 0 0 0\nouter loop\n");
        for (int v = 0; v < 3; v++)
            text_printf(&t, "vertex %.17g %.17g %.17g\n", p[v][0], p[v][1], p[v][2]);
        text_add(&t, "endloop\nendfacet\n");
    }
    text_add(&t, "endsolid ball\n");
    write_bytes(name, t.data, t.length);
    text_free(&t);
}

static primitive_spec round_shape(const char *kind)
{
    primitive_spec spec = shape(kind);
    shape_material(&spec, "material", 0);
    if (strcmp(kind, "boom") == 0) {
        SET(&spec, "from_m", 0, 0, -1);
        SET(&spec, "to_m", 2, 1, 3);
        SET(&spec, "radius_m", 0.1);
        return spec;
    }
    SET(&spec, "radius_m", 1.3);
    if (strcmp(kind, "sphere") == 0) SET(&spec, "facets", 320);
    if (strcmp(kind, "dish") == 0) SET(&spec, "depth_m", 0.4);
    if (strcmp(kind, "prism") == 0) SET(&spec, "sides", 7);
    if (strcmp(kind, "cylinder") == 0 || strcmp(kind, "cone") == 0 || strcmp(kind, "prism") == 0)
        SET(&spec, "length_m", 2);
    return spec;
}

/* The sums of a primitive and of its copy, over three tiles of attitudes. */
static void assert_same_light(facet_list *original, facet_list *copy, const paint *p, double tol)
{
    bench *a = bench_of_facets(original, p), *b = bench_of_facets(copy, p);
    for (int tile = 0; tile < 3; tile++) {
        double sun[BRDF_TILE][3], observer[BRDF_TILE][3], x[BRDF_TILE], y[BRDF_TILE];
        for (int k = 0; k < BRDF_TILE; k++)
            light_at(tile * BRDF_TILE + k, 0.5 + tile, sun[k], observer[k]);
        sums_of(a, sun, observer, x);
        sums_of(b, sun, observer, y);
        for (int k = 0; k < BRDF_TILE; k++)
            assert_near(y[k], x[k], tol * (fabs(x[k]) + 1e-3));
    }
    bench_free(a);
    bench_free(b);
}

START_TEST(test_mesh_of_flat_facets_shines_as_the_primitive_to_rounding)
{
    static const char *const kinds[] = {"box",  "prism", "sphere", "cylinder",
                                        "cone", "dish",  "boom"};
    static const paint paints[] = {{"lambert", {0.4}}, {"lommel-seeliger", {0.7}}};
    for (size_t k = 0; k < COUNT_OF(kinds); k++)
        for (size_t p = 0; p < COUNT_OF(paints); p++) {
            facet_list original = {0}, copy = {0};
            primitive_spec spec = k == 0 ? box_shape(1, 2, 3) : round_shape(kinds[k]);
            shape_add(&spec, 0, &original);
            write_facets("copy.obj", &original, NULL);
            spec = mesh_shape("copy.obj");
            free(mesh_add(&spec, &copy));
            ck_assert_int_eq(copy.n, original.n);
            assert_same_light(&original, &copy, &paints[p], 1e-13);
        }
}
END_TEST

START_TEST(test_mesh_of_stl_ball_shines_as_the_sphere_to_rounding)
{
    static const paint p = {"lambert", {0.4}};
    facet_list original = {0}, copy = {0};
    primitive_spec spec = sphere_shape(1.3, 1280);
    shape_add(&spec, 0, &original);
    write_triangles("ball.stl", &original);
    spec = mesh_shape("ball.stl");
    free(mesh_add(&spec, &copy));
    ck_assert_int_eq(copy.n, 1280);
    assert_same_light(&original, &copy, &p, 1e-13);
}
END_TEST

/* The normals at the corners are those of the true surface: the mesh then shines as the curved
 * primitive of the same facets. Between the corners a mesh takes slopes as linear and the matter as
 * even within each facet, where the primitive knows the surface: that is the tolerance. */
START_TEST(test_mesh_with_normals_shines_as_the_curved_primitive)
{
    static const paint shiny = {"ward-gmd", {0.05, 0.8, 0.05, 0.05, NONE, NONE}};
    facet_list original = {0}, copy = {0};
    primitive_spec spec = sphere_shape(1.3, 1280);
    shape_add(&spec, 0, &original);
    write_facets("copy.obj", &original, radial);
    spec = mesh_shape("copy.obj");
    free(mesh_add(&spec, &copy));
    assert_same_light(&original, &copy, &shiny, 0.008);
    original = copy = (facet_list){0};
    spec = round_shape("cylinder");
    shape_add(&spec, 0, &original);
    write_facets("copy.obj", &original, across_z);
    spec = mesh_shape("copy.obj");
    free(mesh_add(&spec, &copy));
    assert_same_light(&original, &copy, &shiny, 0.008);
}
END_TEST

/* ---------------------------------------------------------------- shadows */

/* Flux ratios of a scenario, in order; returns how many. */
static size_t fluxes_of(const char *path, const char *const *set, size_t n_set, double *out,
                        size_t most)
{
    glint_scenario *s = read_sound_set(path, set, n_set);
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    size_t total = 0;
    const glint_row *rows;
    for (size_t n = 1; n > 0;) {
        ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
        for (size_t k = 0; k < n; k++) {
            ck_assert_uint_lt(total, most);
            out[total++] = rows[k].flux_ratio[0];
        }
    }
    glint_curve_close(curve);
    glint_scenario_free(s);
    return total;
}

enum { TURNS = 72 };

/* A wing over a bus, turned under the light: fluxes of the component that the text describes. */
static void turn_under_light(const char *component, double out[TURNS])
{
    text t = {0};
    text_add(&t, "title = \"shadows\"\n[geometry]\nrange_km = 1000\nrotate = { axis = [1, 2, 3], "
                 "step_deg = 5, sun = [1, 0, 0.2], observer = [0.5, 1, -0.1] }\n"
                 "[materials.white]\nbrdf = \"lambert\"\nrho = 0.5\n[[component]]\nname = \"a\"\n");
    text_add(&t, component);
    ck_assert_uint_eq(fluxes_of(write_bytes("turn.toml", t.data, t.length), NULL, 0, out, TURNS),
                      TURNS);
    text_free(&t);
}

static void lift(soup *s, double x, double z)
{
    for (int k = 0; k < s->n_points; k++)
        s->point[k][0] += x, s->point[k][2] += z;
}

/* Both boxes of the next test as triangles, each a primitive of its own. */
static char *facets_text(const soup *s)
{
    text t = {0};
    for (int k = 0; k < s->n; k++) {
        text_add(&t, "[[component.facet]]\nmaterial = \"white\"\nvertices_m = [");
        for (int j = 0; j < 3; j++) {
            const double *p = s->point[s->triangle[k][j]];
            text_printf(&t, "[%.17g, %.17g, %.17g],", p[0], p[1], p[2]);
        }
        text_add(&t, "]\n");
    }
    return t.data;
}

/* The same body as two boxes, as a mesh whose triangles are merged into its 12 faces, and as 192
 * triangles: exact shadows are the same on all. */
START_TEST(test_mesh_merged_has_the_shadows_of_its_triangles_and_of_boxes)
{
    soup *s = box_soup(2, 2, 3, 4), *wing = box_soup(6, 1, 0.25, 4);
    lift(wing, 1, 2.5);
    const int first = s->n_points;
    for (int k = 0; k < wing->n_points; k++)
        add_point(s, wing->point[k][0], wing->point[k][1], wing->point[k][2]);
    for (int k = 0; k < wing->n; k++)
        add_triangle(s, first + wing->triangle[k][0], first + wing->triangle[k][1],
                     first + wing->triangle[k][2]);
    write_obj("body.obj", s, "");
    char *triangles = facets_text(s);
    free(s);
    free(wing);
    double boxes[TURNS], merged[TURNS], single[TURNS], unshadowed[TURNS], most = 0;
    turn_under_light("[[component.box]]\nsize_m = [2, 2, 3]\nmaterial = \"white\"\n"
                     "[[component.box]]\nsize_m = [6, 1, 0.25]\ncentre_m = [1, 0, 2.5]\n"
                     "material = \"white\"\n",
                     boxes);
    turn_under_light("[[component.mesh]]\nfile = \"body.obj\"\nmaterial = \"white\"\n", merged);
    turn_under_light(triangles, single);
    free(triangles);
    turn_under_light("[[component.mesh]]\nfile = \"body.obj\"\nmaterial = \"white\"\n"
                     "[satellite]\nself_shadows = \"none\"\n",
                     unshadowed);
    double shadow = 0;
    for (int k = 0; k < TURNS; k++) {
        most = fmax(most, boxes[k]);
        shadow = fmax(shadow, unshadowed[k] - boxes[k]);
    }
    ck_assert_msg(shadow > 0.1 * most, "%g of %g", shadow, most);
    for (int k = 0; k < TURNS; k++) {
        assert_near(merged[k], boxes[k], 1e-14 * most);
        assert_near(single[k], boxes[k], 1e-14 * most);
    }
}
END_TEST

/* ---------------------------------------------------------------- the probe that ships */

/* The probe of scenarios/models/probe.obj again, from primitives with the same facets. */
static const char probe_of_primitives[] =
    "materials_from = [\"" SCENARIO_DIR "/materials/huang2013.toml\"]\n"
    "[materials.white]\nbrdf = \"lambert\"\nrho = 0.6\n"
    "[materials.black]\nbrdf = \"lambert\"\nrho = 0\n"
    "[[component]]\nname = \"probe\"\n"
    "[[component.prism]]\nsides = 6\nradius_m = 1.1\nlength_m = 2.4\nmaterial = \"mli\"\n"
    "[[component.box]]\nsize_m = [5.2, 1.8, 0.03]\ncentre_m = [4.6, 0, 0]\nmaterial = \"white\"\n"
    "faces = { \"-z\" = \"solar-panel\" }\n"
    "[[component.box]]\nsize_m = [5.2, 1.8, 0.03]\ncentre_m = [-4.6, 0, 0]\nmaterial = \"white\"\n"
    "faces = { \"-z\" = \"solar-panel\" }\n"
    "[[component.dish]]\nradius_m = 1.5\ndepth_m = 0.375\nsides = 24\nrings = 5\n"
    "centre_m = [0, 0, 1.52]\nmaterial = \"white\"\n"
    "[[component.dish]]\nradius_m = 1.5\ndepth_m = 0.375\nsides = 24\nrings = 5\n"
    "centre_m = [0, 0, 1.5]\nmaterial = \"black\"\nback_material = \"white\"\n"
    "[[component.prism]]\nsides = 24\nradius_m = 1.5\nlength_m = 0.02\nopen = true\n"
    "centre_m = [0, 0, 1.885]\nmaterial = \"white\"\n";

START_TEST(test_mesh_probe_that_ships_shines_as_its_primitives)
{
    enum { MOST = 200 };
    static double mesh_flux[MOST], primitive_flux[MOST];
    static const char scenario[] = SCENARIO_DIR "/probe-mesh.toml";
    char set[1200];
    snprintf(set, sizeof set, "satellite.model=\"%s\"",
             write_file("primitives.toml", probe_of_primitives));
    const char *const sets[] = {set};
    const size_t n = fluxes_of(scenario, NULL, 0, mesh_flux, MOST);
    ck_assert_uint_gt(n, 40);
    ck_assert_uint_eq(fluxes_of(scenario, sets, 1, primitive_flux, MOST), n);
    for (size_t k = 0; k < n; k++) /* the file has its corners to 1e-7 m */
        assert_rel(mesh_flux[k], primitive_flux[k], 1e-7);
}
END_TEST

/* ---------------------------------------------------------------- time */

/* A ball of 4 n^2 triangles. */
static void write_ball(const char *name, int n)
{
    text t = {0};
    for (int row = 0; row <= n; row++)
        for (int k = 0; k < 2 * n; k++) {
            const double a = PI * row / n, b = PI * k / n;
            text_printf(&t, "v %.9g %.9g %.9g\n", sin(a) * cos(b), sin(a) * sin(b), cos(a));
        }
    for (int row = 0; row < n; row++)
        for (int k = 0; k < 2 * n; k++) {
            const int a = 2 * n * row + k + 1, b = 2 * n * row + (k + 1) % (2 * n) + 1;
            text_printf(&t, "f %d %d %d\nf %d %d %d\n", a, a + 2 * n, b + 2 * n, a, b + 2 * n, b);
        }
    write_bytes(name, t.data, t.length);
    text_free(&t);
}

/* A closed surface: the areas of its facets, as vectors, add up to nothing, and as numbers to those
 * of a ball but for about (pi / 158)^2. If each triangle was held against each, this would take
 * longer than these tests may. */
START_TEST(test_mesh_of_many_triangles_is_read_whole)
{
    write_ball("large.obj", 158);
    primitive_spec spec = mesh_shape("large.obj");
    facet_list list = {0};
    free(mesh_add(&spec, &list));
    double all[3] = {0}, area_m2 = 0.0;
    for (int k = 0; k < list.n; k++) {
        const facet *f = &list.items[k];
        const double(*v)[3] = (const double(*)[3])list.vertices + f->first_vertex;
        double own[3] = {0}, a[3], b[3], c[3];
        for (int j = 2; j < f->n_vertices; j++) {
            sub3(v[j - 1], v[0], a);
            sub3(v[j], v[0], b);
            cross3(a, b, c);
            add_scaled3(own, 0.5, c, own);
        }
        add3(all, own, all);
        area_m2 += norm3(own);
    }
    assert_near(norm3(all), 0.0, 1e-12);
    assert_rel(area_m2, 4 * PI, 4e-4);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_mesh_fan_about_one_corner_is_smoothed)
{
    enum { SIDES = 20000 };
    text t = {0};
    text_add(&t, "v 0 0 1\n");
    for (int k = 0; k < SIDES; k++)
        text_printf(&t, "v %.12g %.12g 0\n", cos(TWO_PI * k / SIDES), sin(TWO_PI * k / SIDES));
    for (int k = 0; k < SIDES; k++)
        text_printf(&t, "f 1 %d %d\n", k + 2, (k + 1) % SIDES + 2);
    write_bytes("fan.obj", t.data, t.length);
    text_free(&t);
    primitive_spec spec = mesh_shape("fan.obj");
    SET(&spec, "smooth_deg", 60);
    facet_list list = {0};
    free(mesh_add(&spec, &list));
    ck_assert_int_eq(list.n, SIDES);
    for (int k = 0; k < list.n; k += 999) {
        /* the side of the cone looks 45 deg up; at the tip all that is within 60 deg counts */
        const double *tip = list.normals[list.items[k].first_vertex];
        ck_assert(tip[2] > sqrt(0.5) && dot3(tip, list.items[k].normal) > cos(20 * DEG));
    }
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- memory */

START_TEST(test_tile_threads_share_a_stated_work_space)
{
    glint_error error;
    int n = 0;
    ck_assert_int_eq(tile_fit_threads(1000, false, 1024, &n, &error), GLINT_OK);
    ck_assert_int_eq(n, 1024);
    /* a facet takes TILE doubles, and what the two views need of it */
    ck_assert_int_eq(tile_fit_threads(2000000, false, 1024, &n, &error), GLINT_OK);
    ck_assert(n >= 1 && n * 2e6 * TILE * 8 < TILE_MOST_SHADOW_BYTES);
    ck_assert_int_eq(tile_fit_threads(20000000, false, 8, &n, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "20000000 facets"));
    ck_assert_ptr_nonnull(strstr(error.message, "self_shadows = \"none\""));
}
END_TEST

START_TEST(test_tile_count_of_threads_is_1_to_1024_or_all_processors)
{
    static const int wrong[] = {INT_MIN, -1, 1025, INT_MAX};
    glint_error error = {0};
    int n = -7;
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        ck_assert_int_eq(tile_count_threads(wrong[k], &n, &error), GLINT_ARGUMENT);
        char found[32];
        snprintf(found, sizeof found, "%d threads", wrong[k]);
        ck_assert_ptr_nonnull(strstr(error.message, found));
        ck_assert_ptr_nonnull(strstr(error.message, "expected 1 to 1024, or 0"));
        ck_assert_int_eq(n, -7);
    }
    for (int wanted = 1; wanted <= 1024; wanted += 341) {
        ck_assert_int_eq(tile_count_threads(wanted, &n, &error), GLINT_OK);
        ck_assert_int_eq(n, wanted);
    }
    ck_assert_int_eq(tile_count_threads(0, &n, &error), GLINT_OK);
    ck_assert_int_ge(n, 1);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("mesh light");
    TCase *tcase = tcase_create("mesh light");
    tcase_set_timeout(tcase, 120);
    tcase_add_checked_fixture(tcase, folder_make, folder_remove);
    tcase_add_test(tcase, test_mesh_of_flat_facets_shines_as_the_primitive_to_rounding);
    tcase_add_test(tcase, test_mesh_of_stl_ball_shines_as_the_sphere_to_rounding);
    tcase_add_test(tcase, test_mesh_with_normals_shines_as_the_curved_primitive);
    tcase_add_test(tcase, test_mesh_merged_has_the_shadows_of_its_triangles_and_of_boxes);
    tcase_add_test(tcase, test_mesh_probe_that_ships_shines_as_its_primitives);
    tcase_add_test(tcase, test_mesh_of_many_triangles_is_read_whole);
    tcase_add_test(tcase, test_mesh_fan_about_one_corner_is_smoothed);
    tcase_add_test(tcase, test_tile_threads_share_a_stated_work_space);
    tcase_add_test(tcase, test_tile_count_of_threads_is_1_to_1024_or_all_processors);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
