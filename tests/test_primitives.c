/* Primitives: areas, volumes, frames and copies against closed forms; what is refused, and where.
 */
#include "shapes.h"

/* Vertices and areas of bodies of some metres: a few units in the last place. */
#define TIGHT 1e-14

static const double origin[3] = {0, 0, 0};
static const double x_axis[3] = {1, 0, 0}, y_axis[3] = {0, 1, 0}, z_axis[3] = {0, 0, 1};

/* ---------------------------------------------------------------- properties of every facet */

/* Every facet: frame orthonormal, and its normal and area those of its own vertices. */
static void assert_frames(const facet_list *list)
{
    for (int k = 0; k < list->n; k++) {
        const facet *f = &list->items[k];
        const double(*v)[3] = list->vertices + f->first_vertex;
        assert_near(norm3(f->normal), 1.0, 4e-16);
        assert_near(norm3(f->tangent), 1.0, 4e-16);
        assert_near(dot3(f->normal, f->tangent), 0.0, 4e-16);
        double twice[3] = {0, 0, 0}, c[3];
        for (int j = 0; j < f->n_vertices; j++) {
            cross3(v[j], v[(j + 1) % f->n_vertices], c);
            add3(twice, c, twice);
        }
        const double scale_m2 = fmax(dot3(v[0], v[0]), f->area_m2);
        double want[3];
        scale3(f->normal, 2.0 * f->area_m2, want);
        assert_near3(twice, want, 1e-14 * scale_m2);
    }
}

/* Every facet looks away from the centre of a convex body. */
static void assert_outwards(const facet_list *list, const double centre_m[3])
{
    for (int k = 0; k < list->n; k++) {
        const facet *f = &list->items[k];
        for (int j = 0; j < f->n_vertices; j++) {
            double d[3];
            sub3(list->vertices[f->first_vertex + j], centre_m, d);
            ck_assert(dot3(d, f->normal) > 0.0);
        }
    }
}

/* A closed body of that area and volume. */
static void assert_body(const facet_list *list, double area_m2, double volume_m3, double rel)
{
    const surface s = surface_of(list, 0, list->n);
    assert_rel(s.area_m2, area_m2, rel);
    assert_rel(s.volume_m3, volume_m3, rel);
    assert_near3(s.vector_m2, origin, rel * area_m2);
}

/* ---------------------------------------------------------------- table */

START_TEST(test_primitive_table_names_each_kind_once)
{
    size_t n = 0;
    for (const primitive_kind *kind; (kind = primitive_kind_at(n)); n++) {
        ck_assert_ptr_eq(primitive_kind_named(kind->name), kind);
        ck_assert_int_gt((int)strlen(kind->doc), 0);
        ck_assert_int_le(kind->n_keys, PRIMITIVE_MAX_KEYS);
        for (int k = 0; k < kind->n_keys; k++) {
            const primitive_key *key = &kind->keys[k];
            ck_assert_int_eq(primitive_key_index(kind, key->name), k);
            ck_assert_int_gt((int)strlen(key->doc), 0);
            ck_assert_ptr_nonnull(key->unit);
            const char *tail = strrchr(key->name, '_');
            const bool is_m = tail && strcmp(tail, "_m") == 0,
                       is_deg = tail && strcmp(tail, "_deg") == 0;
            ck_assert_str_eq(key->unit, is_m ? "m" : is_deg ? "deg" : "");
            if (key->kind == KEY_VECTOR) ck_assert(key->length == 2 || key->length == 3);
        }
        ck_assert_int_eq(primitive_key_index(kind, "colour"), -1);
    }
    ck_assert_uint_eq(n, 13);
    ck_assert_ptr_null(primitive_kind_named("teapot"));
    ck_assert_ptr_null(primitive_kind_at(1000));
}
END_TEST

START_TEST(test_primitive_spec_start_fills_documented_defaults)
{
    primitive_spec spec = shape("sphere");
    assert_near(spec.value[primitive_key_index(spec.kind, "facets")][0], 1280, 0);
    assert_near3(spec.value[primitive_key_index(spec.kind, "centre_m")], origin, 0);
    ck_assert_int_eq(spec.repeat_count, 1);
    ck_assert_int_eq(spec.mirror, 0);
    spec = shape("prism");
    assert_near3(spec.value[primitive_key_index(spec.kind, "axis")], z_axis, 0);
    assert_near(spec.value[primitive_key_index(spec.kind, "open")][0], 0, 0);
    spec = shape("box");
    for (int face = 0; face < 6; face++)
        ck_assert_int_eq(spec.face_material[face], PRIMITIVE_NO_MATERIAL);
}
END_TEST

/* ---------------------------------------------------------------- plate */

START_TEST(test_plate_build_gives_one_facet_as_placed)
{
    const double centre_m[3] = {1, -2, 3}, normal[3] = {0, 0, 7}, tangent[3] = {3, 0, 5};
    primitive_spec spec = plate_shape(2, 8, centre_m, normal, tangent);
    facet_list list = {0};
    shape_add(&spec, 4, &list);
    ck_assert_int_eq(list.n, 1);
    const facet *f = &list.items[0];
    ck_assert_int_eq(f->component, 4);
    ck_assert_int_eq(f->n_vertices, 4);
    assert_near3(f->normal, z_axis, 0);
    assert_near3(f->tangent, x_axis, 0);
    assert_near(f->area_m2, 16, 0);
    /* 2 m along the tangent x, 8 m along normal x tangent = y, anticlockwise seen from +z. */
    const double want[4][3] = {{0, -6, 3}, {2, -6, 3}, {2, 2, 3}, {0, 2, 3}};
    for (int k = 0; k < 4; k++)
        assert_near3(list.vertices[k], want[k], 0);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_plate_build_adds_back_facing_the_other_way)
{
    const double normal[3] = {1, 2, -2}, tangent[3] = {1, 1, 1};
    primitive_spec spec = plate_shape(0.3, 0.7, origin, normal, tangent);
    shape_material(&spec, "back_material", 3);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 2);
    ck_assert_int_eq(list.items[0].material, 0);
    ck_assert_int_eq(list.items[1].material, 3);
    double reversed[3];
    scale3(list.items[0].normal, -1, reversed);
    assert_near3(list.items[1].normal, reversed, 2e-16);
    assert_near3(list.items[1].tangent, list.items[0].tangent, 2e-16);
    assert_frames(&list);
    /* normal (1,2,-2)/3; the part of (1,1,1) across it is (8,7,11)/9, of length sqrt(234)/9. */
    const double want_normal[3] = {1 / 3.0, 2 / 3.0, -2 / 3.0};
    const double want_tangent[3] = {8 / sqrt(234), 7 / sqrt(234), 11 / sqrt(234)};
    assert_near3(list.items[0].normal, want_normal, 4e-16);
    assert_near3(list.items[0].tangent, want_tangent, 4e-16);
    assert_near(list.items[0].area_m2, 0.21, 1e-16);
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- facet */

/* A regular n-gon of that radius in the plane z = height. */
static void regular(int n, double radius_m, double height_m, double (*out)[3])
{
    for (int k = 0; k < n; k++) {
        out[k][0] = radius_m * cos(k * TWO_PI / n);
        out[k][1] = radius_m * sin(k * TWO_PI / n);
        out[k][2] = height_m;
    }
}

static primitive_spec facet_shape(const double (*points)[3], int n)
{
    primitive_spec spec = shape("facet");
    shape_points(&spec, points, n);
    shape_material(&spec, "material", 0);
    return spec;
}

START_TEST(test_facet_build_keeps_polygon_with_first_edge_as_tangent)
{
    double points[12][3];
    regular(12, 1.5, 4, points);
    primitive_spec spec = facet_shape(points, 12);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 1);
    assert_near(list.items[0].area_m2, 6.75, 4e-15); /* n/2 r^2 sin(360/n deg) = 6 * 2.25 * 1/2 */
    assert_near3(list.items[0].normal, z_axis, 1e-15);
    const double first_edge[3] = {-sin(15 * DEG), cos(15 * DEG), 0};
    assert_near3(list.items[0].tangent, first_edge, 1e-15);
    assert_frames(&list);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_facet_build_takes_tangent_and_back)
{
    const double points[3][3] = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
    primitive_spec spec = facet_shape(points, 3);
    SET(&spec, "tangent", 1, 1, 9);
    shape_material(&spec, "back_material", 1);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 2);
    const double want[3] = {sqrt(0.5), sqrt(0.5), 0}, down[3] = {0, 0, -1};
    for (int k = 0; k < 2; k++) {
        assert_near3(list.items[k].tangent, want, 2e-16);
        assert_near3(list.items[k].normal, k ? down : z_axis, 0);
        assert_near(list.items[k].area_m2, 6, 0);
        ck_assert_int_eq(list.items[k].material, k);
    }
    assert_frames(&list);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_facet_build_keeps_small_polygon_far_from_origin)
{
    /* A triangle of 1 mm, 1024 m away: coordinates there are multiples of 2^-43 m (1.1e-13 m), so
     * the sides are known to 1e-10 of their length. */
    const double points[3][3] = {
        {1024, 1024, 1024}, {1024.001, 1024, 1024}, {1024, 1024.001, 1024}};
    primitive_spec spec = facet_shape(points, 3);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    assert_rel(list.items[0].area_m2, 5e-7, 5e-10);
    assert_near3(list.items[0].normal, z_axis, 5e-10);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_facet_check_accepts_vertex_on_edge_and_rounded_vertices)
{
    /* Point 2 lies on the edge from 1 to 3, where a neighbour may have its corner. */
    const double on_edge[5][3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    /* The same 1e-6 m inwards, and 1e-6 m off the plane: within 1e-5 of the size of 1.3 m. */
    const double rounded[5][3] = {{0, 0, 0}, {1, 1e-6, 0}, {2, 0, 1e-6}, {2, 2, 0}, {0, 2, 0}};
    facet_list list = {0};
    primitive_spec spec = facet_shape(on_edge, 5);
    shape_add(&spec, 0, &list);
    spec = facet_shape(rounded, 5);
    shape_add(&spec, 0, &list);
    assert_near(list.items[0].area_m2, 4, 0);
    assert_near(list.items[1].area_m2, 4, 2e-6);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_facet_check_accepts_thin_triangle)
{
    const double points[3][3] = {{0, 0, 0}, {10, 0, 0}, {5, 1e-4, 0}};
    primitive_spec spec = facet_shape(points, 3);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    assert_rel(list.items[0].area_m2, 5e-4, 1e-15);
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- box */

START_TEST(test_box_build_gives_closed_body_of_known_area_and_volume)
{
    primitive_spec spec = box_shape(2, 3, 5);
    SET(&spec, "centre_m", 10, -20, 30);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 6);
    assert_body(&list, 62, 30, 0);
    assert_frames(&list);
    const double centre_m[3] = {10, -20, 30};
    assert_outwards(&list, centre_m);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_box_build_orders_faces_and_gives_documented_tangents)
{
    static const double normals[6][3] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                         {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    primitive_spec spec = box_shape(2, 3, 5);
    spec.face_material[4] = 7; /* +z */
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    for (int face = 0; face < 6; face++) {
        assert_near3(list.items[face].normal, normals[face], 0);
        assert_near3(list.items[face].tangent, face < 2 ? y_axis : x_axis, 0);
        ck_assert_int_eq(list.items[face].material, face == 4 ? 7 : 0);
    }
    facet_list_free(&list);
}
END_TEST

START_TEST(test_box_check_takes_six_faces_in_place_of_material)
{
    primitive_spec spec = shape("box");
    SET(&spec, "size_m", 1, 1, 1);
    for (int face = 0; face < 6; face++)
        spec.face_material[face] = face;
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    for (int face = 0; face < 6; face++)
        ck_assert_int_eq(list.items[face].material, face);
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- prism */

START_TEST(test_prism_build_gives_closed_body_of_known_area_and_volume)
{
    static const int sides[] = {3, 4, 7, 24, 1000};
    static const double centre_m[3] = {0.5, -0.25, 1};
    for (size_t k = 0; k < sizeof sides / sizeof *sides; k++) {
        const int n = sides[k];
        const double r = 1.5, length = 8, base = 0.5 * n * r * r * sin(TWO_PI / n);
        primitive_spec spec = prism_shape(n, r, length);
        shape_set(&spec, "centre_m", centre_m, 3);
        SET(&spec, "axis", 1, -2, 0.5);
        facet_list list = {0};
        shape_add(&spec, 0, &list);
        ck_assert_int_eq(list.n, n + 2);
        assert_body(&list, 2 * base + 2 * n * r * sin(PI / n) * length, base * length, TIGHT);
        assert_frames(&list);
        assert_outwards(&list, centre_m);
        facet_list_free(&list);
    }
}
END_TEST

START_TEST(test_prism_build_places_vertices_from_reference_direction)
{
    /* First of x, y that is perpendicular to the axis, or else least along it, made perpendicular.
     */
    static const struct {
        double axis[3], first[3];
    } cases[] = {
        {{0, 0, 1}, {1, 0, 0}},
        {{0, 0, -3}, {1, 0, 0}},
        {{1e-12, 0, 1}, {1, 0, 0}}, /* rounding in the axis does not turn the prism */
        {{2, 0, 0}, {0, 1, 0}},
        {{0, 1, 0}, {1, 0, 0}},
        {{0, 3, 4}, {1, 0, 0}},
        {{3, 0, 4}, {0, 1, 0}},
        {{1, 1, 0}, {0.70710678118654752, -0.70710678118654752, 0}},
        {{1, 2, 2}, {0.94280904158206337, -0.23570226039551584, -0.23570226039551584}},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        primitive_spec spec = prism_shape(5, 2, 6);
        shape_set(&spec, "axis", cases[c].axis, 3);
        facet_list list = {0};
        shape_add(&spec, 0, &list);
        double axis[3], second[3];
        unit3(cases[c].axis, axis);
        cross3(axis, cases[c].first, second);
        const facet *top = &list.items[5], *bottom = &list.items[6];
        assert_near3(top->normal, axis, 1e-15);
        assert_near(dot3(bottom->normal, axis), -1, 1e-15);
        assert_near3(top->tangent, cases[c].first, 2e-12);
        assert_near3(bottom->tangent, cases[c].first, 2e-12);
        for (int k = 0; k < 5; k++) {
            double want[3];
            scale3(axis, 3, want);
            add_scaled3(want, 2 * cos(72 * k * DEG), cases[c].first, want);
            add_scaled3(want, 2 * sin(72 * k * DEG), second, want);
            assert_near3(list.vertices[top->first_vertex + k], want, 5e-12);
            assert_near3(list.items[k].tangent, axis, 1e-15);
        }
        facet_list_free(&list);
    }
}
END_TEST

START_TEST(test_prism_build_leaves_out_caps_when_open)
{
    primitive_spec spec = prism_shape(6, 1, 2);
    SET(&spec, "open", 1);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 6);
    assert_rel(surface_of(&list, 0, 6).area_m2, 12, TIGHT); /* hexagon: side = radius */
    facet_list_free(&list);
}
END_TEST

START_TEST(test_prism_build_gives_caps_their_material)
{
    for (int own = 0; own < 2; own++) {
        primitive_spec spec = prism_shape(4, 1, 2);
        if (own) shape_material(&spec, "cap_material", 5);
        facet_list list = {0};
        shape_add(&spec, 0, &list);
        for (int k = 0; k < 6; k++)
            ck_assert_int_eq(list.items[k].material, own && k >= 4 ? 5 : 0);
        facet_list_free(&list);
    }
}
END_TEST

/* ---------------------------------------------------------------- sphere */

START_TEST(test_sphere_build_starts_from_icosahedron)
{
    primitive_spec spec = sphere_shape(2, 20);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 20);
    /* Edge of the icosahedron in a sphere of radius 2: 4 / sqrt(phi^2 + 1) = 8 / sqrt(10 + 2 sqrt
     * 5). */
    const double a = 8 / sqrt(10 + 2 * sqrt(5));
    assert_body(&list, 5 * sqrt(3) * a * a, 5.0 / 12 * (3 + sqrt(5)) * a * a * a, TIGHT);
    const double phi = 0.5 * (1 + sqrt(5)), scale = 2 / sqrt(1 + phi * phi);
    int n_matched = 0; /* every vertex is (0, 1, phi) up to signs and cyclic order */
    for (int k = 0; k < list.n_vertices; k++)
        for (int j = 0; j < 3; j++)
            n_matched += is_near(list.vertices[k][j], 0, 1e-15) &&
                         is_near(fabs(list.vertices[k][(j + 1) % 3]), scale, 1e-15) &&
                         is_near(fabs(list.vertices[k][(j + 2) % 3]), scale * phi, 1e-15);
    ck_assert_int_eq(n_matched, 60);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_sphere_build_converges_to_sphere_with_square_of_edge)
{
    const double r = 1.3, centre_m[3] = {3, -4, 5};
    double area_off[6], volume_off[6], area_rel = 0, volume_rel = 0;
    for (int level = 0; level < 6; level++) {
        primitive_spec spec = sphere_shape(r, 20 << 2 * level);
        shape_set(&spec, "centre_m", centre_m, 3);
        facet_list list = {0};
        shape_add(&spec, 0, &list);
        ck_assert_int_eq(list.n, 20 << 2 * level);
        assert_outwards(&list, centre_m);
        assert_frames(&list);
        for (int k = 0; k < list.n_vertices; k++) {
            double d[3];
            sub3(list.vertices[k], centre_m, d);
            assert_near(norm3(d), r, 3e-15);
        }
        const surface s = surface_of(&list, 0, list.n);
        assert_near3(s.vector_m2, origin, 1e-13);
        area_off[level] = 4 * PI * r * r - s.area_m2;
        volume_off[level] = 4 * PI / 3 * r * r * r - s.volume_m3;
        if (level >= 3) { /* halving the edge divides the error by 4, up to the next order */
            const double next_order = 0.08 / (1 << 2 * (level - 3));
            assert_near(area_off[level - 1] / area_off[level], 4, next_order);
            assert_near(volume_off[level - 1] / volume_off[level], 4, next_order);
        }
        area_rel = area_off[level] / (4 * PI * r * r);
        volume_rel = volume_off[level] / (4 * PI / 3 * r * r * r);
        facet_list_free(&list);
    }
    ck_assert(area_rel > 0 && area_rel < 5e-4 && volume_rel > 0 && volume_rel < 1e-3);
    /* Without the leading term (Richardson) the rest is of fourth order. */
    assert_near((4 * area_off[5] - area_off[4]) / 3, 0, 2e-6 * 4 * PI * r * r);
    assert_near((4 * volume_off[5] - volume_off[4]) / 3, 0, 2e-6 * 4 * PI / 3 * r * r * r);
}
END_TEST

START_TEST(test_sphere_build_gives_eastward_tangents)
{
    primitive_spec spec = sphere_shape(1, 1280);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    for (int k = 0; k < list.n; k++) {
        const facet *f = &list.items[k];
        double east[3];
        cross3(z_axis, f->normal, east);
        unit3(east, east);
        assert_near3(f->tangent, east, 1e-15);
    }
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- rotation and copies */

START_TEST(test_primitive_rotation_turns_box_about_its_centre_tangents_too)
{
    primitive_spec spec = box_shape(2, 4, 6);
    SET(&spec, "centre_m", 10, 0, 0);
    shape_rotate(&spec, 0, 0, 2, 30);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    const double c = cos(30 * DEG), s = sin(30 * DEG);
    const double normal[3] = {c, s, 0}, tangent[3] = {-s, c, 0};
    assert_near3(list.items[0].normal, normal, 2e-16);
    assert_near3(list.items[0].tangent, tangent, 2e-16);
    /* The corner (1, 2, 3) from the centre goes to (c - 2s, s + 2c, 3). */
    const double corner[3] = {10 + c - 2 * s, s + 2 * c, 3};
    assert_near3(list.vertices[list.items[0].first_vertex + 2], corner, 4e-15);
    assert_body(&list, 88, 48, TIGHT);
    assert_frames(&list);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_primitive_rotation_turns_facet_about_mean_of_corners)
{
    const double points[3][3] = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}; /* mean (1, 1, 0) */
    primitive_spec spec = facet_shape(points, 3);
    shape_rotate(&spec, 0, 0, 1, 90);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    const double want[3][3] = {{2, 0, 0}, {2, 3, 0}, {-1, 0, 0}};
    for (int k = 0; k < 3; k++)
        assert_near3(list.vertices[k], want[k], 1e-15);
    assert_near3(list.items[0].tangent, y_axis, 1e-15);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_primitive_rotation_of_whole_turn_changes_nothing)
{
    for (size_t kind = 0; kind < 3; kind++) {
        facet_list lists[2] = {{0}, {0}};
        for (int turned = 0; turned < 2; turned++) {
            primitive_spec spec = kind == 0   ? box_shape(1, 2, 3)
                                  : kind == 1 ? prism_shape(7, 1, 2)
                                              : sphere_shape(1, 80);
            SET(&spec, "centre_m", 1, 2, 3);
            if (turned) shape_rotate(&spec, 1, 2, 3, 360);
            shape_add(&spec, 0, &lists[turned]);
        }
        ck_assert_int_eq(lists[0].n_vertices, lists[1].n_vertices);
        for (int k = 0; k < lists[0].n_vertices; k++)
            assert_near3(lists[1].vertices[k], lists[0].vertices[k], 5e-15);
        for (int k = 0; k < lists[0].n; k++)
            assert_near3(lists[1].items[k].tangent, lists[0].items[k].tangent, 2e-15);
        facet_list_free(&lists[0]);
        facet_list_free(&lists[1]);
    }
}
END_TEST

START_TEST(test_primitive_repeat_turns_copies_about_component_origin)
{
    const double centre_m[3] = {5, 0, 1};
    primitive_spec spec = plate_shape(2, 1, centre_m, x_axis, z_axis);
    shape_repeat(&spec, 3, z_axis, 120);
    facet_list list = {0};
    shape_add(&spec, 2, &list);
    ck_assert_int_eq(list.n, 3);
    for (int k = 0; k < 3; k++) {
        const facet *f = &list.items[k];
        const double normal[3] = {cos(120 * k * DEG), sin(120 * k * DEG), 0};
        double mean[3] = {0, 0, 0}, want[3] = {5 * normal[0], 5 * normal[1], 1};
        for (int v = 0; v < 4; v++)
            add_scaled3(mean, 0.25, list.vertices[f->first_vertex + v], mean);
        assert_near3(f->normal, normal, 5e-16);
        assert_near3(f->tangent, z_axis, 5e-16);
        assert_near3(mean, want, 4e-15);
        ck_assert_int_eq(f->component, 2);
    }
    assert_frames(&list);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_primitive_mirror_adds_reflected_copy_with_outside_kept)
{
    for (int plane = 1; plane <= 3; plane++) {
        primitive_spec spec = box_shape(2, 3, 5);
        SET(&spec, "centre_m", 4, 6, 9);
        shape_rotate(&spec, 1, 1, 0, 20);
        spec.mirror = plane;
        facet_list list = {0};
        shape_add(&spec, 0, &list);
        ck_assert_int_eq(list.n, 12);
        assert_body(&list, 2 * 62, 2 * 30, 1e-13);
        assert_frames(&list);
        for (int k = 0; k < 6; k++) {
            const facet *f = &list.items[k], *g = &list.items[6 + k];
            for (int j = 0; j < 3; j++) {
                const double sign = j == plane - 1 ? -1 : 1;
                assert_near(g->normal[j], sign * f->normal[j], 0);
                assert_near(g->tangent[j], sign * f->tangent[j], 0);
                for (int v = 0; v < 4; v++)
                    assert_near(list.vertices[g->first_vertex + 3 - v][j],
                                sign * list.vertices[f->first_vertex + v][j], 0);
            }
        }
        facet_list_free(&list);
    }
}
END_TEST

START_TEST(test_primitive_copies_are_turned_then_repeated_then_mirrored)
{
    const double centre_m[3] = {3, 1, 0};
    primitive_spec spec = plate_shape(1, 1, centre_m, x_axis, y_axis);
    shape_rotate(&spec, 0, 0, 1, 90);   /* normal to y, about (3, 1, 0) */
    shape_repeat(&spec, 2, z_axis, 90); /* second: centre (-1, 3, 0), normal -x */
    spec.mirror = 2;                    /* third, fourth: y -> -y */
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    ck_assert_int_eq(list.n, 4);
    static const double normals[4][3] = {{0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {-1, 0, 0}};
    static const double centres[4][3] = {{3, 1, 0}, {-1, 3, 0}, {3, -1, 0}, {-1, -3, 0}};
    for (int k = 0; k < 4; k++) {
        double mean[3] = {0, 0, 0};
        for (int v = 0; v < 4; v++)
            add_scaled3(mean, 0.25, list.vertices[list.items[k].first_vertex + v], mean);
        assert_near3(list.items[k].normal, normals[k], 5e-16);
        assert_near3(mean, centres[k], 2e-15);
    }
    assert_frames(&list);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_primitive_add_appends_to_what_is_there)
{
    facet_list list = {0};
    for (int component = 0; component < 3; component++) {
        primitive_spec spec = box_shape(1, 1, 1 + component);
        spec.mirror = 1;
        shape_add(&spec, component, &list);
    }
    ck_assert_int_eq(list.n, 36);
    for (int k = 0; k < 36; k++) {
        ck_assert_int_eq(list.items[k].component, k / 12);
        ck_assert_int_eq(list.items[k].first_vertex, 4 * k);
    }
    assert_near(surface_of(&list, 24, 12).volume_m3, 6, TIGHT);
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- what is refused */

/* The primitive is refused with n errors, the first of which says `words` at `line`, and nothing is
 * added. */
static void assert_refused(primitive_spec *spec, size_t n, int line, const char *words)
{
    glint_errors *errors = glint_errors_new();
    facet_list list = {0};
    ck_assert_int_eq(primitive_add(spec, 0, &list, errors), GLINT_INPUT);
    ck_assert_int_eq(list.n, 0);
    ck_assert_int_eq(list.n_vertices, 0);
    const glint_error *first = glint_errors_get(errors, 0);
    ck_assert_ptr_nonnull(first);
    ck_assert_msg(strstr(first->message, words), "\"%s\" lacks \"%s\"", first->message, words);
    ck_assert_str_eq(first->file, "shape.toml");
    ck_assert_int_eq(first->line, line);
    ck_assert_uint_eq(glint_errors_error_count(errors), n);
    glint_errors_free(errors);
    facet_list_free(&list);
    primitive_spec_free(spec);
}

static int line_of(const primitive_spec *spec, const char *key)
{
    return KEY_LINE + primitive_key_index(spec->kind, key);
}

START_TEST(test_primitive_check_names_missing_keys)
{
    primitive_spec spec = shape("plate");
    assert_refused(&spec, 4, TABLE_LINE, "size_m is missing");
    spec = shape("facet");
    assert_refused(&spec, 2, TABLE_LINE, "vertices_m is missing");
    spec = shape("sphere");
    SET(&spec, "radius_m", 1);
    assert_refused(&spec, 1, TABLE_LINE, "material is missing");
    spec = shape("box");
    SET(&spec, "size_m", 1, 1, 1);
    spec.face_material[0] = 0;
    assert_refused(&spec, 1, TABLE_LINE, "face -x has no material");
}
END_TEST

START_TEST(test_primitive_check_refuses_numbers_out_of_range)
{
    static const double wrong[] = {0, -1, 1e-7, 2e7, (double)NAN, HUGE_VAL};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        primitive_spec spec = box_shape(1, 1, 1);
        SET(&spec, "size_m", 1, wrong[k], 1);
        assert_refused(&spec, 1, line_of(&spec, "size_m"), "number 2 of size_m is ");
        spec = prism_shape(6, 1, wrong[k]);
        assert_refused(&spec, 1, line_of(&spec, "length_m"), "expected between 1e-06 and 1e+07");
    }
    primitive_spec spec = prism_shape(2, 1, 1);
    assert_refused(&spec, 1, line_of(&spec, "sides"), "sides is 2; expected between 3 and 10000");
    spec = prism_shape(3, 1, 1);
    SET(&spec, "sides", 3.5);
    assert_refused(&spec, 1, line_of(&spec, "sides"), "expected a whole number");
    spec = prism_shape(3, 1, 1);
    SET(&spec, "axis", 0, 0, 0);
    assert_refused(&spec, 1, line_of(&spec, "axis"), "axis is zero; expected a direction");
    spec = prism_shape(3, 1, 1);
    SET(&spec, "axis", 0, NAN, 0);
    assert_refused(&spec, 1, line_of(&spec, "axis"), "number 2 of axis is nan");
}
END_TEST

START_TEST(test_primitive_check_reports_all_errors_at_once)
{
    primitive_spec spec = plate_shape(-1, 0, origin, z_axis, z_axis);
    assert_refused(&spec, 3, line_of(&spec, "size_m"), "number 1 of size_m is -1");
    spec = sphere_shape(-1, 100);
    SET(&spec, "centre_m", NAN, 0, 1e9);
    assert_refused(&spec, 4, line_of(&spec, "radius_m"), "radius_m is -1");
}
END_TEST

START_TEST(test_plate_check_refuses_tangent_along_normal)
{
    static const double along[3][3] = {{0, 0, 2}, {0, 0, -1e-300}, {1e-10, 0, 1}};
    for (int k = 0; k < 3; k++) {
        primitive_spec spec = plate_shape(1, 1, origin, z_axis, along[k]);
        assert_refused(&spec, 1, line_of(&spec, "tangent"),
                       "tangent is along the normal; expected a direction across it");
    }
}
END_TEST

START_TEST(test_sphere_check_names_nearest_counts)
{
    static const struct {
        int wanted;
        const char *words;
    } cases[] = {{21, "20 and 80"},
                 {79, "20 and 80"},
                 {100, "80 and 320"},
                 {1000, "320 and 1280"},
                 {5242879, "1310720 and 5242880"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        primitive_spec spec = sphere_shape(1, cases[k].wanted);
        assert_refused(&spec, 1, line_of(&spec, "facets"), cases[k].words);
    }
    primitive_spec spec = sphere_shape(1, 20971520);
    assert_refused(&spec, 1, line_of(&spec, "facets"), "expected between 20 and");
}
END_TEST

START_TEST(test_facet_check_refuses_polygons_that_are_none)
{
    static const struct {
        int n;
        double points[6][3];
        const char *words;
    } cases[] = {
        {2, {{0, 0, 0}, {1, 0, 0}}, "vertices_m has 2 points; expected 3 or more"},
        {3, {{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}}, "number 2 of point 3 of vertices_m is nan"},
        {4, {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}, "point 3 repeats point 2"},
        {4, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, "point 4 repeats point 1"},
        {3, {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, "enclose no area"},
        {4, {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, "enclose no area"},
        {4, {{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-4}, {0, 1, 0}}, "off the plane"},
        {4, {{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}, "turns inwards at point 3"},
        {4, {{0, 0, 0}, {0, 2, 0}, {0.5, 0.5, 0}, {2, 0, 0}}, "turns inwards at point 3"},
        /* A spike: out to (3, 0, 0) and back along the edge. */
        {5, {{0, 0, 0}, {3, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, "turns inwards at point 2"},
        /* The same along the edge itself: forwards, back, forwards. */
        {6,
         {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}},
         "turns inwards at point 2"},
        {3, {{0, 0, 0}, {1e-8, 0, 0}, {0, 1e-8, 0}}, "enclose no area"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        primitive_spec spec = facet_shape(cases[k].points, cases[k].n);
        assert_refused(&spec, 1, line_of(&spec, "vertices_m"), cases[k].words);
    }
}
END_TEST

START_TEST(test_facet_check_refuses_star)
{
    double ring[5][3], star[5][3];
    regular(5, 1, 0, ring);
    for (int k = 0; k < 5; k++)
        copy3(ring[2 * k % 5], star[k]);
    primitive_spec spec = facet_shape(star, 5);
    assert_refused(&spec, 1, line_of(&spec, "vertices_m"), "crosses itself");
}
END_TEST

START_TEST(test_facet_check_refuses_tangent_along_normal)
{
    const double points[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    primitive_spec spec = facet_shape(points, 3);
    SET(&spec, "tangent", 0, 0, -4);
    assert_refused(&spec, 1, line_of(&spec, "tangent"), "tangent is along the normal");
}
END_TEST

START_TEST(test_primitive_add_refuses_too_many_copies)
{
    primitive_spec spec = sphere_shape(1, 20480);
    shape_repeat(&spec, 129, z_axis, 1);
    spec.mirror = 1;
    assert_refused(&spec, 1, TABLE_LINE, "has 5283840 facets with its copies; expected at most");
    spec = box_shape(1, 1, 1);
    shape_repeat(&spec, 0, z_axis, 1);
    assert_refused(&spec, 1, TABLE_LINE, "repeat has a count of 0; expected between 1 and");
    spec = box_shape(1, 1, 1);
    shape_rotate(&spec, 0, 0, 1, NAN);
    assert_refused(&spec, 1, TABLE_LINE, "not a finite number");
    spec = box_shape(1, 1, 1);
    shape_repeat(&spec, 2, origin, 1);
    assert_refused(&spec, 1, TABLE_LINE, "no direction");
}
END_TEST

START_TEST(test_primitive_add_leaves_list_alone_on_error)
{
    facet_list list = {0};
    primitive_spec spec = box_shape(1, 1, 1);
    shape_add(&spec, 0, &list);
    spec = sphere_shape(1, 5242880 / 4);
    shape_repeat(&spec, 5, z_axis, 1);
    ck_assert_int_eq(primitive_add(&spec, 0, &list, NULL), GLINT_INPUT);
    ck_assert_int_eq(list.n, 6);
    ck_assert_int_eq(list.n_vertices, 24);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_facet_list_add_refuses_polygon_without_area)
{
    facet_list list = {0};
    glint_error error;
    const double line[3][3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    ck_assert_int_eq(facet_list_add(&list, line, 3, y_axis, 0, 0, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "no area"));
    ck_assert_int_eq(list.n, 0);
    facet_list_free(&list);
    facet_list_free(NULL);
    primitive_spec_free(NULL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("primitives");
    TCase *build = tcase_create("build"), *copies = tcase_create("copies"),
          *refused = tcase_create("refused");
    tcase_add_test(build, test_primitive_table_names_each_kind_once);
    tcase_add_test(build, test_primitive_spec_start_fills_documented_defaults);
    tcase_add_test(build, test_plate_build_gives_one_facet_as_placed);
    tcase_add_test(build, test_plate_build_adds_back_facing_the_other_way);
    tcase_add_test(build, test_facet_build_keeps_polygon_with_first_edge_as_tangent);
    tcase_add_test(build, test_facet_build_takes_tangent_and_back);
    tcase_add_test(build, test_facet_build_keeps_small_polygon_far_from_origin);
    tcase_add_test(build, test_facet_check_accepts_vertex_on_edge_and_rounded_vertices);
    tcase_add_test(build, test_facet_check_accepts_thin_triangle);
    tcase_add_test(build, test_box_build_gives_closed_body_of_known_area_and_volume);
    tcase_add_test(build, test_box_build_orders_faces_and_gives_documented_tangents);
    tcase_add_test(build, test_box_check_takes_six_faces_in_place_of_material);
    tcase_add_test(build, test_prism_build_gives_closed_body_of_known_area_and_volume);
    tcase_add_test(build, test_prism_build_places_vertices_from_reference_direction);
    tcase_add_test(build, test_prism_build_leaves_out_caps_when_open);
    tcase_add_test(build, test_prism_build_gives_caps_their_material);
    tcase_add_test(build, test_sphere_build_starts_from_icosahedron);
    tcase_add_test(build, test_sphere_build_converges_to_sphere_with_square_of_edge);
    tcase_add_test(build, test_sphere_build_gives_eastward_tangents);
    tcase_add_test(copies, test_primitive_rotation_turns_box_about_its_centre_tangents_too);
    tcase_add_test(copies, test_primitive_rotation_turns_facet_about_mean_of_corners);
    tcase_add_test(copies, test_primitive_rotation_of_whole_turn_changes_nothing);
    tcase_add_test(copies, test_primitive_repeat_turns_copies_about_component_origin);
    tcase_add_test(copies, test_primitive_mirror_adds_reflected_copy_with_outside_kept);
    tcase_add_test(copies, test_primitive_copies_are_turned_then_repeated_then_mirrored);
    tcase_add_test(copies, test_primitive_add_appends_to_what_is_there);
    tcase_add_test(refused, test_primitive_check_names_missing_keys);
    tcase_add_test(refused, test_primitive_check_refuses_numbers_out_of_range);
    tcase_add_test(refused, test_primitive_check_reports_all_errors_at_once);
    tcase_add_test(refused, test_plate_check_refuses_tangent_along_normal);
    tcase_add_test(refused, test_sphere_check_names_nearest_counts);
    tcase_add_test(refused, test_facet_check_refuses_polygons_that_are_none);
    tcase_add_test(refused, test_facet_check_refuses_star);
    tcase_add_test(refused, test_facet_check_refuses_tangent_along_normal);
    tcase_add_test(refused, test_primitive_add_refuses_too_many_copies);
    tcase_add_test(refused, test_primitive_add_leaves_list_alone_on_error);
    tcase_add_test(refused, test_facet_list_add_refuses_polygon_without_area);
    suite_add_tcase(suite, build);
    suite_add_tcase(suite, copies);
    suite_add_tcase(suite, refused);
    return run_suite(suite);
}
