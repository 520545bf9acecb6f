/* Crinkled foil: what is random, what is conserved, and its statistics. */
#include "base/random.h"
#include "base/text.h"
#include "shapes.h"

static const double origin[3] = {0, 0, 0};
static const double x_axis[3] = {1, 0, 0}, z_axis[3] = {0, 0, 1};

static void crinkle_shape(primitive_spec *spec, int facets_per_side, double tilt_deg, uint64_t seed)
{
    shape_key(spec, "crinkle");
    spec->crinkle = (crinkle){facets_per_side, tilt_deg * DEG, seed};
}

/* SplitMix64 from the states 0 and 1234567: the numbers that other implementations give (the test
 * vectors of Java's SplittableRandom and of the Rosetta code collection). */
START_TEST(test_random_next_gives_published_sequence)
{
    static const uint64_t from_0[] = {UINT64_C(0xe220a8397b1dcdaf), UINT64_C(0x6e789e6aa1b965f4),
                                      UINT64_C(0x06c45d188009454f), UINT64_C(0xf88bb8a8724c81ec)};
    static const uint64_t from_1234567[] = {UINT64_C(6457827717110365317),
                                            UINT64_C(3203168211198807973),
                                            UINT64_C(9817491932198370423)};
    uint64_t state = 0;
    for (size_t k = 0; k < sizeof from_0 / sizeof *from_0; k++)
        ck_assert_uint_eq(random_next(&state), from_0[k]);
    state = 1234567;
    for (size_t k = 0; k < sizeof from_1234567 / sizeof *from_1234567; k++)
        ck_assert_uint_eq(random_next(&state), from_1234567[k]);
}
END_TEST

START_TEST(test_random_numbers_have_their_moments)
{
    enum { N = 200000 };
    uint64_t state = 42;
    double even = 0, even2 = 0, mean = 0, square = 0, fourth = 0;
    for (int k = 0; k < N; k++) {
        const double u = random_even(&state), x = random_normal(&state);
        ck_assert(u >= 0 && u < 1);
        ck_assert(fabs(x) <= 6);
        even += u / N, even2 += u * u / N;
        mean += x / N, square += x * x / N, fourth += x * x * x * x / N;
    }
    /* five standard errors; kurtosis of the sum of 12: 3 - 1.2/12 */
    assert_near(even, 0.5, 5 * sqrt(1 / 12.0 / N));
    assert_near(even2, 1 / 3.0, 5 * sqrt(4 / 45.0 / N));
    assert_near(mean, 0, 5 / sqrt(N));
    assert_near(square, 1, 5 * sqrt(2.0 / N));
    assert_near(fourth, 2.9, 5 * sqrt(90.0 / N));
}
END_TEST

START_TEST(test_crinkle_of_plate_keeps_outline_and_projected_area)
{
    static const double normal[3] = {2, -1, 2}, tangent[3] = {1, 2, 0}, centre_m[3] = {3, 4, 5};
    for (int back = 0; back < 2; back++) {
        primitive_spec spec = plate_shape(2, 5, centre_m, normal, tangent);
        if (back) shape_material(&spec, "back_material", 1);
        crinkle_shape(&spec, 8, 15, 7);
        facet_list list = {0};
        shape_add(&spec, 0, &list);
        ck_assert_int_eq(list.n, back ? 256 : 128);
        surface s = {0};
        for (int k = 0; k < list.n; k++)
            if (list.items[k].material == 0)
                add_scaled3(s.vector_m2, list.items[k].area_m2, list.items[k].normal, s.vector_m2);
        double want[3];
        unit3(normal, want);
        scale3(want, 10, want);
        assert_near3(s.vector_m2, want, 1e-13); /* the vector area of the flat plate */
        if (back) assert_near3(surface_of(&list, 0, list.n).vector_m2, origin, 1e-13);
        facet_list_free(&list);
    }
}
END_TEST

START_TEST(test_crinkle_of_plate_moves_inner_corners_along_the_normal_only)
{
    primitive_spec spec = plate_shape(1, 2, origin, z_axis, x_axis);
    crinkle_shape(&spec, 4, 20, 1);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    int n_rim = 0;
    for (int v = 0; v < list.n_vertices; v++) {
        const double column = (list.vertices[v][0] + 0.5) * 4, row = (list.vertices[v][1] + 1) * 2;
        assert_near(column, round(column), 1e-14);
        assert_near(row, round(row), 1e-14);
        const bool rim =
            round(column) == 0 || round(column) == 4 || round(row) == 0 || round(row) == 4;
        if (rim)
            assert_near(list.vertices[v][2], 0, 0);
        else
            ck_assert(list.vertices[v][2] != 0);
        n_rim += rim;
    }
    ck_assert_int_gt(n_rim, 0);
    facet_list_free(&list);
}
END_TEST

/* Root mean square of the angle from the z axis, over the projected area; deg. */
static double tilt_rms_deg(const facet_list *list)
{
    double sum = 0, area = 0;
    for (int k = 0; k < list->n; k++) {
        const double projected = list->items[k].area_m2 * list->items[k].normal[2];
        const double tilt = acos(list->items[k].normal[2]);
        sum += projected * tilt * tilt;
        area += projected;
    }
    return sqrt(sum / area) / DEG;
}

START_TEST(test_crinkle_tilts_as_much_as_it_is_asked_to)
{
    static const struct {
        int n;
        double tilt_deg;
        uint64_t seed;
    } cases[] = {{2, 60, 3}, {3, 0.001, 1}, {8, 4, 7},
                 {8, 4, 8},  {32, 10, 0},   {64, 35, UINT64_MAX}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        primitive_spec spec = plate_shape(1, 3, origin, z_axis, x_axis);
        crinkle_shape(&spec, cases[k].n, cases[k].tilt_deg, cases[k].seed);
        facet_list list = {0};
        shape_add(&spec, 0, &list);
        /* acos loses half of the digits of small angles */
        assert_rel(tilt_rms_deg(&list), cases[k].tilt_deg, cases[k].tilt_deg < 1 ? 1e-4 : 1e-10);
        facet_list_free(&list);
    }
}
END_TEST

START_TEST(test_crinkle_of_square_tilts_alike_both_ways_and_evenly)
{
    primitive_spec spec = plate_shape(1, 1, origin, z_axis, x_axis);
    crinkle_shape(&spec, 128, 5, 11);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    double x2 = 0, y2 = 0, xy = 0, x4 = 0;
    for (int k = 0; k < list.n; k++) {
        const double *n = list.items[k].normal, x = n[0] / n[2], y = n[1] / n[2];
        x2 += x * x / list.n, y2 += y * y / list.n, xy += x * y / list.n;
        x4 += x * x * x * x / list.n;
    }
    assert_rel(x2, y2, 0.05); /* 16 000 cells, neighbours correlated */
    assert_near(xy, 0, 0.05 * x2);
    assert_near(x4 / (x2 * x2), 3, 0.2); /* normally distributed: the kurtosis is 3 */
    facet_list_free(&list);
}
END_TEST

START_TEST(test_crinkle_is_the_same_for_the_same_seed_only)
{
    facet_list lists[4] = {{0}, {0}, {0}, {0}};
    static const uint64_t seeds[4] = {7, 7, 8, 7 + (UINT64_C(1) << 40)};
    for (int k = 0; k < 4; k++) {
        primitive_spec spec = box_shape(1, 2, 3);
        crinkle_shape(&spec, 8, 4, seeds[k]);
        shape_add(&spec, 0, &lists[k]);
        ck_assert_int_eq(lists[k].n, 6 * 128);
    }
    const size_t size = (size_t)lists[0].n_vertices * sizeof *lists[0].vertices;
    ck_assert(memcmp(lists[0].vertices, lists[1].vertices, size) == 0);
    ck_assert(memcmp(lists[0].vertices, lists[2].vertices, size) != 0);
    ck_assert(memcmp(lists[0].vertices, lists[3].vertices, size) != 0);
    for (int k = 0; k < 4; k++)
        facet_list_free(&lists[k]);
}
END_TEST

/* The heights of a face of the unit cube along its normal, in the order of its corners. */
static double height(const facet_list *list, int face, int k)
{
    const double *v = list->vertices[list->items[128 * face].first_vertex + k];
    return (face % 2 ? -1 : 1) * v[face / 2] - 0.5;
}

START_TEST(test_crinkle_of_box_is_closed_with_faces_unlike_each_other)
{
    primitive_spec spec = box_shape(1, 1, 1);
    spec.face_material[3] = 2;
    crinkle_shape(&spec, 8, 12, 3);
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    const surface s = surface_of(&list, 0, list.n);
    assert_near3(s.vector_m2, origin, 1e-14);
    ck_assert(s.area_m2 > 6);
    for (int face = 0; face < 6; face++) {
        double vector[3] = {0, 0, 0}, want[3] = {0, 0, 0};
        want[face / 2] = face % 2 ? -1 : 1;
        for (int k = 128 * face; k < 128 * (face + 1); k++) {
            add_scaled3(vector, list.items[k].area_m2, list.items[k].normal, vector);
            ck_assert_int_eq(list.items[k].material, face == 3 ? 2 : 0);
        }
        assert_near3(vector, want, 1e-14);
        bool same = face > 0;
        for (int k = 0; k < 3 * 128 && same; k++)
            same = is_near(height(&list, face, k), height(&list, face - 1, k), 1e-9);
        ck_assert(!same);
    }
    facet_list_free(&list);
}
END_TEST

START_TEST(test_crinkle_reports_its_statistics)
{
    primitive_spec spec = plate_shape(1, 1, origin, z_axis, x_axis);
    crinkle_shape(&spec, 16, 4, 7);
    text report = {0};
    spec.report = &report;
    facet_list list = {0};
    shape_add(&spec, 0, &list);
    int n = 0;
    double all = 0, along = 0, across = 0, most = 0, area = 0;
    ck_assert_int_eq(
        sscanf(report.data,
               "plate of crinkled foil: %d facets, tilted by %lf deg rms (%lf along the "
               "tangent, %lf across it), at most %lf; their area is %lf of the outline's",
               &n, &all, &along, &across, &most, &area),
        6);
    ck_assert_int_eq(n, 512);
    assert_near(all, 4, 1e-9);
    assert_near(hypot(along, across), 4, 0.02); /* angles add as slopes do, but for third order */
    double worst = 0, x2 = 0, y2 = 0;
    for (int k = 0; k < list.n; k++) { /* all have the same projected area */
        const double *normal = list.items[k].normal;
        worst = fmax(worst, acos(normal[2]) / DEG);
        x2 += pow(atan(normal[0] / normal[2]) / DEG, 2) / list.n;
        y2 += pow(atan(normal[1] / normal[2]) / DEG, 2) / list.n;
    }
    assert_rel(along, sqrt(x2), 1e-3);
    assert_rel(across, sqrt(y2), 1e-3);
    assert_rel(most, worst, 1e-3); /* four digits are written */
    assert_rel(area, surface_of(&list, 0, list.n).area_m2, 1e-5);
    text_free(&report);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_crinkle_check_refuses_what_cannot_be)
{
    static const crinkle wrong[] = {
        {1, 0.1, 0}, {257, 0.1, 0}, {8, 0, 0}, {8, 1.1, 0}, {8, (double)NAN, 0}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        primitive_spec spec = box_shape(1, 1, 1);
        shape_key(&spec, "crinkle");
        spec.crinkle = wrong[k];
        facet_list list = {0};
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(primitive_add(&spec, 0, &list, errors), GLINT_INPUT);
        ck_assert_ptr_nonnull(strstr(glint_errors_get(errors, 0)->message, "crinkle has"));
        glint_errors_free(errors);
        facet_list_free(&list);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("crinkle");
    TCase *tcase = tcase_create("crinkle");
    tcase_add_test(tcase, test_random_next_gives_published_sequence);
    tcase_add_test(tcase, test_random_numbers_have_their_moments);
    tcase_add_test(tcase, test_crinkle_of_plate_keeps_outline_and_projected_area);
    tcase_add_test(tcase, test_crinkle_of_plate_moves_inner_corners_along_the_normal_only);
    tcase_add_test(tcase, test_crinkle_tilts_as_much_as_it_is_asked_to);
    tcase_add_test(tcase, test_crinkle_of_square_tilts_alike_both_ways_and_evenly);
    tcase_add_test(tcase, test_crinkle_is_the_same_for_the_same_seed_only);
    tcase_add_test(tcase, test_crinkle_of_box_is_closed_with_faces_unlike_each_other);
    tcase_add_test(tcase, test_crinkle_reports_its_statistics);
    tcase_add_test(tcase, test_crinkle_check_refuses_what_cannot_be);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
