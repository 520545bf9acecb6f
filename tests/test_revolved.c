/* Cylinders, cones, discs, rings, dishes, wings and booms: areas, volumes, frames and resolution
 * against closed forms; what is refused, and where. */
#include "shapes.h"

#define TIGHT 1e-13 /* bodies of some metres: some units in the last place, summed over facets */

static const double origin[3] = {0, 0, 0};
static const double x_axis[3] = {1, 0, 0}, y_axis[3] = {0, 1, 0}, z_axis[3] = {0, 0, 1};

static primitive_spec round_shape(const char *kind, double radius_m)
{
    primitive_spec spec = shape(kind);
    SET(&spec, "radius_m", radius_m);
    shape_material(&spec, "material", 0);
    return spec;
}

static primitive_spec cylinder_shape(double radius_m, double length_m, int sides)
{
    primitive_spec spec = round_shape("cylinder", radius_m);
    SET(&spec, "length_m", length_m);
    SET(&spec, "sides", sides);
    return spec;
}

static primitive_spec cone_shape(double radius_m, double top_m, double length_m, int sides)
{
    primitive_spec spec = round_shape("cone", radius_m);
    SET(&spec, "top_radius_m", top_m);
    SET(&spec, "length_m", length_m);
    SET(&spec, "sides", sides);
    return spec;
}

static primitive_spec flat_shape(const char *kind, double radius_m, int sides)
{
    primitive_spec spec = round_shape(kind, radius_m);
    SET(&spec, "normal", 0, 0, 1);
    SET(&spec, "sides", sides);
    return spec;
}

/* Frames orthonormal, and normals and areas those of the vertices. */
static void assert_frames(const facet_list *list)
{
    for (int k = 0; k < list->n; k++) {
        const facet *f = &list->items[k];
        const double(*v)[3] = list->vertices + f->first_vertex;
        assert_near(norm3(f->normal), 1, 4e-16);
        assert_near(norm3(f->tangent), 1, 4e-16);
        assert_near(dot3(f->normal, f->tangent), 0, 4e-16);
        double twice[3] = {0, 0, 0}, a[3], b[3], c[3], want[3];
        for (int j = 2; j < f->n_vertices; j++) {
            sub3(v[j - 1], v[0], a), sub3(v[j], v[0], b);
            cross3(a, b, c);
            add3(twice, c, twice);
        }
        scale3(f->normal, 2 * f->area_m2, want);
        assert_near3(twice, want, 1e-14 * (1 + f->area_m2));
        for (int j = 0; j < f->n_vertices; j++) { /* flat */
            sub3(v[j], v[0], a);
            assert_near(dot3(a, f->normal), 0, 2e-13); /* narrow sides lean by their rounding */
        }
    }
}

static void assert_body(const facet_list *list, double area_m2, double volume_m3)
{
    const surface s = surface_of(list, 0, list->n);
    assert_rel(s.area_m2, area_m2, TIGHT);
    assert_rel(s.volume_m3, volume_m3, TIGHT);
    assert_near3(s.vector_m2, origin, TIGHT * area_m2);
    assert_frames(list);
}

/* Area of a regular n-gon in a circle. */
static double polygon_area(int n, double r)
{
    return 0.5 * n * r * r * sin(TWO_PI / n);
}

/* ---------------------------------------------------------------- cylinder and cone */

START_TEST(test_cylinder_build_gives_closed_prism_that_stands_for_it)
{
    static const int sides[] = {3, 12, 64, 1000};
    for (size_t k = 0; k < sizeof sides / sizeof *sides; k++) {
        const int n = sides[k];
        primitive_spec spec = cylinder_shape(1.5, 8, n);
        SET(&spec, "centre_m", 3, -2, 1);
        SET(&spec, "axis", 1, 2, -2);
        facet_list list = {0};
        shape_add(&spec, 0, &list);
        ck_assert_int_eq(list.n, n + 2);
        const double base = polygon_area(n, 1.5);
        assert_body(&list, 2 * base + 2 * n * 1.5 * sin(PI / n) * 8, base * 8);
        const double axis[3] = {1 / 3.0, 2 / 3.0, -2 / 3.0};
        for (int f = 0; f < n; f++) {
            ck_assert_int_eq(list.items[f].surface, 1);
            assert_near3(list.items[f].tangent, axis, 2e-14); /* made orthogonal */
        }
        ck_assert_int_eq(list.items[n].surface, 0); /* caps are flat */
        ck_assert_int_eq(list.items[n + 1].surface, 0);
        ck_assert_int_eq(list.n_surfaces, 1);
        ck_assert_int_eq(list.surfaces[0].kind, SURFACE_CONE);
        assert_near3(list.surfaces[0].axis, axis, 1e-15);
        assert_near(list.surfaces[0].lean, 0, 0);
        facet_list_free(&list);
    }
}
END_TEST

START_TEST(test_cylinder_build_converges_with_square_of_side)
{
    double off[3];
    for (int k = 0; k < 3; k++) {
        primitive_spec spec = cylinder_shape(1.5, 8, 32 << k);
        facet_list list = {0};
        shape_add(&spec, 0, &list);
        const surface s = surface_of(&list, 0, list.n);
        off[k] = TWO_PI * 1.5 * 8 + TWO_PI * 2.25 - s.area_m2;
        ck_assert(s.volume_m3 < PI * 2.25 * 8);
        facet_list_free(&list);
    }
    assert_near(off[0] / off[1], 4, 0.01);
    assert_near(off[1] / off[2], 4, 0.003);
}
END_TEST

START_TEST(test_cylinder_defaults_to_64_sides)
{
    primitive_spec spec = round_shape("cylinder", 1);
    SET(&spec, "length_m", 1);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 66);
    facet_list_free(&list);
}
END_TEST

/* The middle of a side lies r (1 - cos(pi/n)) inside. */
START_TEST(test_cylinder_tolerance_gives_fewest_sides_that_keep_it)
{
    for (int n = 3; n < 200; n++) {
        const double sag_m = 1.5 * (1 - cos(PI / n));
        for (int less = 0; less < 2; less++) {
            primitive_spec spec = round_shape("cylinder", 1.5);
            SET(&spec, "length_m", 1);
            SET(&spec, "tolerance_m", less ? sag_m * (1 - 1e-6) : sag_m * (1 + 1e-12));
            facet_list list = {0};
            shape_add(&spec, 0, &list);
            ck_assert_int_eq(list.n, n + less + 2);
            facet_list_free(&list);
        }
    }
    primitive_spec spec = round_shape("cylinder", 1.5);
    SET(&spec, "length_m", 1);
    SET(&spec, "tolerance_m", 1e4); /* a triangle will do */
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 5);
    facet_list_free(&list);
    spec = round_shape("cylinder", 1000);
    SET(&spec, "length_m", 1);
    SET(&spec, "tolerance_m", 1e-6); /* 70 000 sides: as many as there may be */
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 10002);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_cylinder_open_shows_inside_where_it_has_a_material)
{
    primitive_spec spec = cylinder_shape(1, 2, 8);
    SET(&spec, "open", 1);
    shape_material(&spec, "inside_material", 4);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 16);
    for (int k = 0; k < 8; k++) {
        const facet *out = &list.items[k], *in = &list.items[8 + k];
        double back[3];
        scale3(out->normal, -1, back);
        assert_near3(in->normal, back, 1e-15);
        assert_near(in->area_m2, out->area_m2, 1e-15);
        assert_near3(in->tangent, z_axis, 1e-15);
        ck_assert_int_eq(out->material, 0);
        ck_assert_int_eq(in->material, 4);
    }
    assert_near3(surface_of(&list, 0, 16).vector_m2, origin, 1e-14);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_cone_build_gives_closed_pyramid_or_frustum)
{
    static const double tops_m[] = {0, 0.5, 2, 3};
    for (size_t k = 0; k < sizeof tops_m / sizeof *tops_m; k++) {
        const double bottom = 2, top = tops_m[k], length = 3;
        const int n = 24;
        primitive_spec spec = cone_shape(bottom, top, length, n);
        facet_list list = {0};
        shape_add(&spec, 0, &list);
        ck_assert_int_eq(list.n, top > 0 ? n + 2 : n + 1);
        const double chord = 2 * sin(PI / n), apothem = cos(PI / n);
        const double slant = hypot(length, (bottom - top) * apothem);
        const double sides = n * chord * 0.5 * (bottom + top) * slant;
        const double caps = polygon_area(n, bottom) + (top > 0 ? polygon_area(n, top) : 0);
        const double volume =
            polygon_area(n, 1) * length / 3 * (bottom * bottom + bottom * top + top * top);
        assert_body(&list, sides + caps, volume);
        assert_near(list.surfaces[0].lean, (bottom - top) / hypot(length, bottom - top), 1e-16);
        for (int f = 0; f < n; f++) { /* the tangent runs upwards along the side */
            ck_assert(list.items[f].tangent[2] > 0.5);
            const double mid = (f + 0.5) * TWO_PI / n;
            const double sideways[3] = {-sin(mid), cos(mid), 0};
            assert_near(dot3(list.items[f].tangent, sideways), 0, 1e-15);
        }
        facet_list_free(&list);
    }
}
END_TEST

START_TEST(test_cone_build_is_cylinder_where_both_ends_are_alike)
{
    facet_list lists[2] = {{0}, {0}};
    primitive_spec cylinder = cylinder_shape(1.25, 2, 20), cone = cone_shape(1.25, 1.25, 2, 20);
    SET(&cylinder, "axis", 0, 1, 1);
    SET(&cone, "axis", 0, 1, 1);
    shape_add(&cylinder, 0, &lists[0]);
    shape_add(&cone, 0, &lists[1]);
    ck_assert_int_eq(lists[0].n, lists[1].n);
    for (int v = 0; v < lists[0].n_vertices; v++)
        assert_near3(lists[1].vertices[v], lists[0].vertices[v], 0);
    facet_list_free(&lists[0]);
    facet_list_free(&lists[1]);
}
END_TEST

/* ---------------------------------------------------------------- disc and ring */

START_TEST(test_disc_build_gives_one_polygon_with_corner_at_the_tangent)
{
    primitive_spec spec = flat_shape("disc", 2, 36);
    SET(&spec, "centre_m", 1, 2, 3);
    SET(&spec, "normal", 0, 0, -5);
    SET(&spec, "tangent", 1, 1, 7);
    shape_material(&spec, "back_material", 3);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 2);
    const double down[3] = {0, 0, -1}, along[3] = {sqrt(0.5), sqrt(0.5), 0};
    const double corner[3] = {1 + sqrt(2), 2 + sqrt(2), 3};
    assert_near3(list.items[0].normal, down, 1e-15);
    assert_near3(list.items[1].normal, z_axis, 1e-15);
    for (int k = 0; k < 2; k++) {
        assert_near3(list.items[k].tangent, along, 1e-15);
        assert_rel(list.items[k].area_m2, polygon_area(36, 2), TIGHT);
        ck_assert_int_eq(list.items[k].material, k ? 3 : 0);
        ck_assert_int_eq(list.items[k].surface, 0);
    }
    assert_near3(list.vertices[0], corner, 2e-15);
    assert_frames(&list);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_disc_closes_open_cylinder_of_the_same_radius)
{
    facet_list list = {0};
    primitive_spec spec = cylinder_shape(1, 2, 64);
    SET(&spec, "open", 1);
    shape_add(&spec, 0, &list);
    for (int side = -1; side < 2; side += 2) {
        spec = flat_shape("disc", 1, 64);
        SET(&spec, "centre_m", 0, 0, side);
        SET(&spec, "normal", 0, 0, side);
        shape_add(&spec, 0, &list);
    }
    assert_body(&list, 2 * polygon_area(64, 1) + 128 * sin(PI / 64) * 2, 2 * polygon_area(64, 1));
    facet_list_free(&list);
}
END_TEST

START_TEST(test_annulus_build_gives_disc_less_hole)
{
    primitive_spec spec = flat_shape("annulus", 2, 30);
    SET(&spec, "inner_radius_m", 0.5);
    SET(&spec, "normal", 1, 0, 0);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 30);
    const surface s = surface_of(&list, 0, 30);
    const double area = polygon_area(30, 2) - polygon_area(30, 0.5), want[3] = {area, 0, 0};
    assert_rel(s.area_m2, area, TIGHT);
    assert_near3(s.vector_m2, want, 1e-14);
    for (int k = 0; k < 30; k++)
        assert_near3(list.items[k].tangent, y_axis, 1e-15);
    assert_frames(&list);
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- dish */

static primitive_spec dish_shape(double radius_m, double depth_m, int sides, int rings)
{
    primitive_spec spec = round_shape("dish", radius_m);
    SET(&spec, "depth_m", depth_m);
    SET(&spec, "sides", sides);
    SET(&spec, "rings", rings);
    return spec;
}

START_TEST(test_dish_build_puts_corners_on_paraboloid_looking_inwards)
{
    primitive_spec spec = dish_shape(1.5, 0.4, 24, 6);
    SET(&spec, "centre_m", 1, 1, 1);
    SET(&spec, "axis", 0, 1, 0);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 24 * 6);
    const double curvature_radius = 1.5 * 1.5 / (2 * 0.4),
                 focus[3] = {1, 1 + curvature_radius / 2, 1};
    for (int v = 0; v < list.n_vertices; v++) {
        double d[3];
        sub3(list.vertices[v], spec.value[primitive_key_index(spec.kind, "centre_m")], d);
        const double rho2 = d[0] * d[0] + d[2] * d[2];
        assert_near(d[1], rho2 / (2 * curvature_radius), 1e-15);
    }
    for (int k = 0; k < list.n; k++) { /* a ray along the axis goes to the focus */
        const facet *f = &list.items[k];
        double to[3];
        sub3(focus, list.vertices[f->first_vertex], to);
        ck_assert(dot3(to, f->normal) > 0);
        ck_assert(f->normal[1] > 0.7);
        ck_assert_int_eq(f->surface, 1);
    }
    assert_frames(&list);
    facet_list_free(&list);
}
END_TEST

/* Area 2 pi R^2 / 3 [(1 + a^2/R^2)^1.5 - 1] of the shell; its rim closes it to a volume pi a^2 d
 * / 2. */
START_TEST(test_dish_build_converges_to_paraboloid)
{
    const double a = 1.2, d = 0.5, R = a * a / (2 * d);
    double area_off[3], volume_off[3];
    for (int k = 0; k < 3; k++) {
        primitive_spec spec = dish_shape(a, d, 24 << k, 6 << k);
        facet_list list = {0};
        shape_add(&spec, 0, &list);
        const surface s = surface_of(&list, 0, list.n);
        /* volume between shell and rim: the shell alone as seen from the middle of the rim */
        double volume = 0;
        for (int f = 0; f < list.n; f++) {
            const facet *one = &list.items[f];
            double p[3];
            copy3(list.vertices[one->first_vertex], p);
            p[2] -= d;
            volume -= one->area_m2 * dot3(one->normal, p) / 3;
        }
        area_off[k] = TWO_PI * R * R / 3 * (pow(1 + a * a / (R * R), 1.5) - 1) - s.area_m2;
        volume_off[k] = 0.5 * PI * a * a * d - volume;
        facet_list_free(&list);
    }
    for (int k = 0; k < 2; k++) {
        assert_near(area_off[k] / area_off[k + 1], 4, 0.03);
        assert_near(volume_off[k] / volume_off[k + 1], 4, 0.03);
    }
    ck_assert(fabs(area_off[2]) < 5e-3);
}
END_TEST

START_TEST(test_dish_tolerance_holds_for_sides_and_rings)
{
    primitive_spec spec = round_shape("dish", 1);
    SET(&spec, "depth_m", 0.25);
    SET(&spec, "tolerance_m", 0.001);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    /* sides: pi / acos(1 - 0.001) = 70.2; rings: chords w of z = rho^2/4 lie w^2/16 off: w = 0.126
     */
    ck_assert_int_eq(list.n, 71 * 8);
    facet_list_free(&list);
}
END_TEST

/* The primitive is refused with one error, which says `words` at a key (NULL: at the table). */
static void assert_refused(primitive_spec *spec, const char *key, const char *words)
{
    glint_errors *errors = glint_errors_new();
    facet_list list = {0};
    ck_assert_int_eq(primitive_add(spec, 0, &list, errors), GLINT_INPUT);
    ck_assert_int_eq(list.n, 0);
    ck_assert_int_eq(list.n_surfaces, 0);
    const glint_error *first = glint_errors_get(errors, 0);
    ck_assert_msg(strstr(first->message, words), "\"%s\" lacks \"%s\"", first->message, words);
    ck_assert_int_eq(first->line,
                     key ? KEY_LINE + primitive_key_index(spec->kind, key) : TABLE_LINE);
    ck_assert_uint_eq(glint_errors_error_count(errors), 1);
    glint_errors_free(errors);
    facet_list_free(&list);
    primitive_spec_free(spec);
}

/* The distance of the facets' planes from the centre is that of the nearest point of the facets:
 * all of them hold their feet. */
START_TEST(test_sphere_tolerance_gives_fewest_facets_that_keep_it)
{
    static const int counts[] = {20, 80, 320, 1280, 5120};
    for (int k = 0; k < 5; k++) {
        primitive_spec spec = sphere_shape(2, counts[k]);
        facet_list list = {0};
        shape_add(&spec, 0, &list);
        double sag_m = 0;
        for (int f = 0; f < list.n; f++) {
            const facet *item = &list.items[f];
            sag_m = fmax(sag_m, 2 - dot3(item->normal, list.vertices[item->first_vertex]));
        }
        facet_list_free(&list);
        for (int less = 0; less < 2; less++) {
            spec = shape("sphere");
            SET(&spec, "radius_m", 2);
            SET(&spec, "tolerance_m", less ? sag_m * (1 - 1e-9) : sag_m * (1 + 1e-9));
            shape_material(&spec, "material", 0);
            shape_add(&spec, 0, &list);
            ck_assert_int_eq(list.n, less ? 4 * counts[k] : counts[k]);
            facet_list_free(&list);
        }
    }
    primitive_spec spec = sphere_shape(2, 1280);
    SET(&spec, "tolerance_m", 0.1);
    assert_refused(&spec, "tolerance_m", "both facets and tolerance_m are given");
}
END_TEST

START_TEST(test_dish_with_back_is_closed_shell)
{
    primitive_spec spec = dish_shape(1, 0.25, 12, 3);
    shape_material(&spec, "back_material", 1);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 72);
    const surface s = surface_of(&list, 0, list.n);
    assert_near3(s.vector_m2, origin, 1e-15);
    assert_near(s.volume_m3, 0, 1e-15);
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- wing and boom */

START_TEST(test_wing_build_divides_its_length_in_panels_and_gaps)
{
    primitive_spec spec = shape("wing");
    SET(&spec, "size_m", 2, 8);
    SET(&spec, "panels", 4);
    SET(&spec, "gap_m", 0.1);
    SET(&spec, "centre_m", 0, 5, 0);
    SET(&spec, "normal", 0, 0, 1);
    SET(&spec, "tangent", 1, 0, 0);
    shape_material(&spec, "material", 0);
    shape_material(&spec, "back_material", 1);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 8);
    const double panel = (8 - 0.3) / 4;
    for (int k = 0; k < 4; k++) {
        const facet *front = &list.items[2 * k];
        assert_rel(front->area_m2, 2 * panel, TIGHT);
        assert_near3(front->normal, z_axis, 0);
        assert_near3(front->tangent, x_axis, 0);
        const double want[2][3] = {{-1, 1 + k * (panel + 0.1), 0},
                                   {1, 1 + k * (panel + 0.1) + panel, 0}};
        assert_near3(list.vertices[front->first_vertex], want[0], 2e-15);
        assert_near3(list.vertices[front->first_vertex + 2], want[1], 2e-15);
        ck_assert_int_eq(list.items[2 * k + 1].material, 1);
    }
    assert_frames(&list);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_boom_build_is_prism_between_its_ends)
{
    primitive_spec spec = shape("boom");
    SET(&spec, "from_m", 1, 0, 0);
    SET(&spec, "to_m", 1, 6, 8);
    SET(&spec, "radius_m", 0.1);
    shape_material(&spec, "material", 0);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 6); /* four sides and two caps */
    const double side = 0.1 * sqrt(2);
    assert_body(&list, 4 * side * 10 + 2 * side * side, side * side * 10);
    const double along[3] = {0, 0.6, 0.8};
    assert_near3(list.items[0].tangent, along, 1e-15);
    ck_assert_int_eq(list.n_surfaces, 0); /* its sides are flat */
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- copies */

START_TEST(test_primitive_copies_take_their_surfaces_along)
{
    primitive_spec spec = cylinder_shape(1, 2, 6);
    SET(&spec, "centre_m", 5, 0, 0);
    SET(&spec, "axis", 1, 0, 0);
    shape_rotate(&spec, 0, 0, 1, 90);   /* axis y, about (5, 0, 0) */
    shape_repeat(&spec, 2, z_axis, 90); /* the second: centre (0, 5, 0), axis -x */
    spec.mirror = 3;
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 32);
    ck_assert_int_eq(list.n_surfaces, 4);
    const double minus_x[3] = {-1, 0, 0}, far[3] = {5, 0, 0}, side[3] = {0, 5, 0};
    for (int s = 0; s < 4; s++) {
        assert_near3(list.surfaces[s].axis, s % 2 ? minus_x : y_axis, 5e-16);
        assert_near3(list.surfaces[s].centre_m, s % 2 ? side : far, 1e-15);
        for (int f = 0; f < 6; f++)
            ck_assert_int_eq(list.items[8 * s + f].surface, s + 1);
    }
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- what is refused */

/* One of each kind, away from the origin; mesh is in test_mesh.c. */
static primitive_spec any_shape(const primitive_kind *kind)
{
    static const double centre_m[3] = {3, 2, 1}, normal[3] = {1, 1, 0}, tangent[3] = {0, 0, 1};
    primitive_spec spec = shape(kind->name);
    for (int k = 0; k < kind->n_keys; k++) {
        const primitive_key *key = &kind->keys[k];
        if (key->kind == KEY_MATERIAL && key->required) shape_material(&spec, key->name, 0);
        if (key->kind == KEY_NUMBER && key->required) SET(&spec, key->name, 0.5);
        if (key->kind == KEY_COUNT && key->required) SET(&spec, key->name, 5);
        if (key->kind == KEY_VECTOR && key->required)
            SET(&spec, key->name, 1, 2, strcmp(key->name, "to_m") == 0 ? 9 : 3);
    }
    if (primitive_key_index(kind, "centre_m") >= 0) shape_set(&spec, "centre_m", centre_m, 3);
    if (primitive_key_index(kind, "normal") >= 0) shape_set(&spec, "normal", normal, 3);
    if (primitive_key_index(kind, "tangent") >= 0) shape_set(&spec, "tangent", tangent, 3);
    if (strcmp(kind->name, "annulus") == 0) SET(&spec, "inner_radius_m", 0.25);
    if (strcmp(kind->name, "boom") == 0) SET(&spec, "radius_m", 0.01);
    if (strcmp(kind->name, "box") == 0) shape_material(&spec, "material", 0);
    if (strcmp(kind->name, "facet") == 0)
        shape_points(&spec, (const double[3][3]){{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 3);
    return spec;
}

/* Copies have the area of the original, and those of a closed body its volume: none of them is
 * inside out. The last of the copies is the original turned and reflected. */
START_TEST(test_primitive_of_every_kind_is_repeated_and_mirrored)
{
    for (size_t kind = 0; primitive_kind_at(kind); kind++) {
        if (strcmp(primitive_kind_at(kind)->name, "mesh") == 0) continue;
        facet_list one = {0}, six = {0};
        primitive_spec spec = any_shape(primitive_kind_at(kind));
        shape_add(&spec, 0, &one);
        spec = any_shape(primitive_kind_at(kind));
        shape_repeat(&spec, 3, (const double[]){0, 0, 1}, 120);
        spec.mirror = 3;
        shape_add(&spec, 0, &six);
        ck_assert_int_eq(six.n, 6 * one.n);
        const surface single = surface_of(&one, 0, one.n), all = surface_of(&six, 0, six.n);
        assert_rel(all.area_m2, 6 * single.area_m2, 1e-13);
        if (norm3(single.vector_m2) < 1e-9 * single.area_m2)
            assert_rel(all.volume_m3, 6 * single.volume_m3, 1e-9);
        for (int k = 0; k < one.n; k++) {
            double turn[9], want[3];
            mat_turn((const double[]){0, 0, 1}, 240 * DEG, turn);
            mat_vec(turn, one.items[k].normal, want);
            want[2] = -want[2];
            assert_near3(six.items[5 * one.n + k].normal, want, 1e-14);
            mat_vec(turn, one.items[k].tangent, want);
            want[2] = -want[2];
            assert_near3(six.items[5 * one.n + k].tangent, want, 1e-14);
        }
        facet_list_free(&one);
        facet_list_free(&six);
    }
}
END_TEST

START_TEST(test_revolved_check_refuses_what_cannot_be)
{
    primitive_spec spec = cylinder_shape(1, 1, 8);
    SET(&spec, "tolerance_m", 0.1);
    assert_refused(&spec, "tolerance_m", "both sides and tolerance_m are given");
    spec = cylinder_shape(1, 1, 8);
    shape_material(&spec, "inside_material", 0);
    assert_refused(&spec, "inside_material", "caps hide the inside; expected open = true");
    spec = cylinder_shape(1, 1, 10001);
    assert_refused(&spec, "sides", "expected between 3 and 10000");
    spec = cone_shape(1, 1e-7, 1, 8);
    assert_refused(&spec, "top_radius_m", "expected 0 for a point");
    spec = cone_shape(1, -1, 1, 8);
    assert_refused(&spec, "top_radius_m", "top_radius_m is -1");
    spec = flat_shape("annulus", 1, 8);
    SET(&spec, "inner_radius_m", 1);
    assert_refused(&spec, "inner_radius_m", "expected a hole smaller than the disc");
    spec = flat_shape("disc", 1, 8);
    SET(&spec, "tangent", 0, 0, 3);
    assert_refused(&spec, "tangent", "tangent is along the normal");
    spec = round_shape("dish", 1);
    SET(&spec, "depth_m", 0.1);
    SET(&spec, "rings", 3);
    SET(&spec, "tolerance_m", 0.1);
    assert_refused(&spec, "tolerance_m", "both rings and tolerance_m are given");
}
END_TEST

START_TEST(test_wing_and_boom_check_refuse_what_has_no_room)
{
    primitive_spec spec = shape("wing");
    SET(&spec, "size_m", 2, 8);
    SET(&spec, "panels", 5);
    SET(&spec, "gap_m", 2);
    SET(&spec, "normal", 0, 0, 1);
    SET(&spec, "tangent", 1, 0, 0);
    shape_material(&spec, "material", 0);
    assert_refused(&spec, "gap_m", "leave no room for cells in a wing of 8 m");
    spec = shape("boom");
    SET(&spec, "from_m", 1, 2, 3);
    SET(&spec, "to_m", 1, 2, 3);
    SET(&spec, "radius_m", 1);
    shape_material(&spec, "material", 0);
    assert_refused(&spec, "to_m", "the boom has no length");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("revolved");
    TCase *build = tcase_create("build"), *refused = tcase_create("refused");
    tcase_add_test(build, test_cylinder_build_gives_closed_prism_that_stands_for_it);
    tcase_add_test(build, test_cylinder_build_converges_with_square_of_side);
    tcase_add_test(build, test_cylinder_defaults_to_64_sides);
    tcase_add_test(build, test_cylinder_tolerance_gives_fewest_sides_that_keep_it);
    tcase_add_test(build, test_cylinder_open_shows_inside_where_it_has_a_material);
    tcase_add_test(build, test_cone_build_gives_closed_pyramid_or_frustum);
    tcase_add_test(build, test_cone_build_is_cylinder_where_both_ends_are_alike);
    tcase_add_test(build, test_disc_build_gives_one_polygon_with_corner_at_the_tangent);
    tcase_add_test(build, test_disc_closes_open_cylinder_of_the_same_radius);
    tcase_add_test(build, test_annulus_build_gives_disc_less_hole);
    tcase_add_test(build, test_dish_build_puts_corners_on_paraboloid_looking_inwards);
    tcase_add_test(build, test_dish_build_converges_to_paraboloid);
    tcase_add_test(build, test_dish_tolerance_holds_for_sides_and_rings);
    tcase_add_test(build, test_sphere_tolerance_gives_fewest_facets_that_keep_it);
    tcase_add_test(build, test_dish_with_back_is_closed_shell);
    tcase_add_test(build, test_wing_build_divides_its_length_in_panels_and_gaps);
    tcase_add_test(build, test_boom_build_is_prism_between_its_ends);
    tcase_add_test(build, test_primitive_copies_take_their_surfaces_along);
    tcase_add_test(refused, test_primitive_of_every_kind_is_repeated_and_mirrored);
    tcase_add_test(refused, test_revolved_check_refuses_what_cannot_be);
    tcase_add_test(refused, test_wing_and_boom_check_refuse_what_has_no_room);
    suite_add_tcase(suite, build);
    suite_add_tcase(suite, refused);
    return run_suite(suite);
}
