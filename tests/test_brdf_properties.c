/* What every BRDF model must satisfy, whichever the table holds: parameters drawn from the ranges
 * that the model itself declares. */
#include "base/constants.h"
#include "base/vec.h"
#include "brdf/table.h"
#include "testing.h"

#include <stdint.h>

/* ------------------------------------------------------------------ helpers */

enum { COEF_ROOM = 512 };

/* Uniform in 0..1, the same sequence on every machine (Knuth's MMIX generator). */
static double next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static void random_unit(uint64_t *state, double out[3])
{
    double v[3];
    do {
        for (int k = 0; k < 3; k++)
            v[k] = 2.0 * next_random(state) - 1.0;
    } while (norm3(v) > 1.0 || norm3(v) < 0.1);
    unit3(v, out);
}

/* A direction above the facet. */
static void random_up(uint64_t *state, double out[3])
{
    random_unit(state, out);
    out[2] = fabs(out[2]);
}

/* A value in the range: even where it is narrow, by magnitude where it is wide. */
static double draw_value(const param_info *p, uint64_t *state)
{
    const double u = 0.001 + 0.998 * next_random(state), width = p->max - p->min;
    if (p->min > 0.0 && p->max > 100.0 * p->min) return p->min * pow(p->max / p->min, u);
    if (p->min >= 0.0 && width > 10.0) return p->min + width * pow(u, 8.0);
    return p->min + width * u;
}

static void draw_params(const brdf_model *model, uint64_t *state, double params[BRDF_MAX_PARAMS])
{
    const bool with_optional = next_random(state) < 0.5;
    for (int j = 0; j < model->n_params; j++) {
        const param_info *p = &model->params[j];
        params[j] = draw_value(p, state);
        /* near 1, so that what they scale stays in range */
        if (p->flags & PARAM_OPTIONAL)
            params[j] = with_optional ? 0.5 + next_random(state) : PARAM_NONE;
    }
}

static int array_count(const brdf_model *model)
{
    int n = 0;
    for (int j = 0; j < model->n_params; j++)
        n += (model->params[j].flags & PARAM_ROWS) != 0;
    return n;
}

/* Fills the arrays of a lobe, all of as many rows. Elements are drawn from the middle of their
 * range, a ten thousandth of it, which keeps f among usable numbers; end: taken from the lower (-1)
 * or upper (1) end of the range instead. */
static void fill_arrays(brdf_lobe *lobe, uint64_t *state, int end)
{
    ck_assert(brdf_lobe_make_arrays(lobe));
    const int rows = 1 + (int)(3 * next_random(state));
    for (int j = 0; j < lobe->model->n_params; j++) {
        const param_info *p = &lobe->model->params[j];
        if (!(p->flags & PARAM_ROWS)) continue;
        brdf_array *array = &lobe->arrays[j];
        array->rows = rows;
        array->columns = 1 + (int)(6 * next_random(state));
        const int n = array->rows * array->columns;
        array->values = malloc((size_t)n * sizeof(double));
        ck_assert_ptr_nonnull(array->values);
        for (int k = 0; k < n; k++) {
            const double middle = 0.5 * (p->min + p->max), half = 0.5 * (p->max - p->min);
            array->values[k] =
                middle + half * (end ? end : 1e-4 * (2.0 * next_random(state) - 1.0));
        }
    }
}

/* Makes the lobe a table of three scans with drawn values, five decades apart at most. */
static void fill_table(brdf_lobe *lobe, uint64_t *state)
{
    enum { SCANS = 3, EACH = 7 };
    measured_point points[SCANS * EACH];
    for (int k = 0; k < SCANS * EACH; k++) {
        const double theta_i = (10 + 30 * (k / EACH)) * DEG, theta_r = (25 * (k % EACH) - 75) * DEG;
        points[k] = (measured_point){.i = {-sin(theta_i), 0, cos(theta_i)},
                                     .r = {sin(theta_r), 0, cos(theta_r)},
                                     .f = pow(10, 5 * next_random(state) - 3)};
    }
    const measured rows = {.points = points, .n = SCANS * EACH, .in_plane = true};
    ck_assert_int_eq(table_prepare(&rows, lobe, NULL), GLINT_OK);
}

/* The numbers of a lobe with these parameters, and arrays drawn; false where they are refused. */
static bool make_coef(const brdf_model *model, const double *params, int end, uint64_t *state,
                      double coef[COEF_ROOM])
{
    brdf_lobe lobe = {.model = model, .weight = 1.0};
    memcpy(lobe.params, params, sizeof lobe.params);
    if (array_count(model) > 0) fill_arrays(&lobe, state, end);
    if (model->flags & BRDF_MEASURED) fill_table(&lobe, state);
    const bool good = brdf_lobe_prepare(&lobe, NULL) == GLINT_OK;
    const size_t n = lobe.numbers ? lobe.n_numbers : BRDF_MAX_COEF;
    ck_assert_uint_le(n, COEF_ROOM);
    if (good) memcpy(coef, brdf_lobe_coef(&lobe), n * sizeof *coef);
    brdf_lobe_free(&lobe);
    return good;
}

/* Coefficients of a random material; draws again where the combination is refused. */
static void draw_coef(const brdf_model *model, uint64_t *state, double coef[COEF_ROOM])
{
    double params[BRDF_MAX_PARAMS] = {0};
    for (int attempt = 0; attempt < 100; attempt++) {
        draw_params(model, state, params);
        if (make_coef(model, params, 0, state, coef)) return;
    }
    ck_abort_msg("%s: no usable parameters found", model->name);
}

/* A seed of its own for every model and test. */
static uint64_t seed_of(int model, int test)
{
    return (uint64_t)(1000 * model + test);
}

static int model_count(void)
{
    int n = 0;
    while (brdf_model_at((size_t)n))
        n++;
    return n;
}

/* Calls check(model, coef, i, r) for awkward pairs of directions: normal, oblique and grazing to
 * 2e-12, in, out of and close to the plane of incidence. */
typedef void pair_check(const brdf_model *model, const double *coef, const double i[3],
                        const double r[3]);

static void for_awkward_pairs(const brdf_model *model, const double *coef, pair_check *check)
{
    static const double cosines[] = {1, 1 - 1e-9, 0.8, 0.3, 1e-3, 1e-9, 2e-12};
    static const double turns[] = {0, 1e-9, 1, PI / 2, 3, PI - 1e-9, PI};
    enum { N = sizeof cosines / sizeof cosines[0], T = sizeof turns / sizeof turns[0] };
    for (int a = 0; a < N; a++)
        for (int b = 0; b < N; b++)
            for (int t = 0; t < T; t++) {
                const double ci = cosines[a], si = sqrt((1 - ci) * (1 + ci)), cr = cosines[b];
                const double sr = sqrt((1 - cr) * (1 + cr)), phi = 0.7 + turns[t];
                const double i[3] = {si * cos(0.7), si * sin(0.7), ci};
                const double r[3] = {sr * cos(phi), sr * sin(phi), cr};
                check(model, coef, i, r);
            }
    for (int a = 0; a < N; a++) { /* the exact mirror direction, and straight back */
        const double c = cosines[a], s = sqrt((1 - c) * (1 + c));
        const double i[3] = {0.6 * s, 0.8 * s, c}, mirror[3] = {-0.6 * s, -0.8 * s, c};
        check(model, coef, i, mirror);
        check(model, coef, i, i);
    }
}

/* ----------------------------------------------------------------- the table */

START_TEST(test_brdf_model_describes_itself)
{
    const brdf_model *model = brdf_model_at((size_t)_i);
    ck_assert_ptr_eq(brdf_model_named(model->name), model);
    ck_assert(model->doc[0] && model->source[0]);
    ck_assert_int_ge(model->n_params, 1);
    ck_assert_int_le(model->n_params, BRDF_MAX_PARAMS);
    for (int j = 0; j < model->n_params; j++) {
        const param_info *p = &model->params[j];
        ck_assert(p->name[0] && p->unit && p->doc[0]);
        ck_assert_msg(isfinite(p->min) && isfinite(p->max) && p->min < p->max, "%s", p->name);
        ck_assert_msg(isnan(p->def) || param_accepts(p, p->def), "%s: default", p->name);
        for (int k = 0; k < j; k++)
            ck_assert_str_ne(p->name, model->params[k].name);
    }
}
END_TEST

/* ------------------------------------------------------------------ the scalar */

static void check_finite(const brdf_model *model, const double *coef, const double i[3],
                         const double r[3])
{
    const double g = model->eval(coef, i, r);
    ck_assert_msg(isfinite(g) && g >= 0.0, "%s: g = %g at i = (%g %g %g), r = (%g %g %g)",
                  model->name, g, i[0], i[1], i[2], r[0], r[1], r[2]);
}

START_TEST(test_brdf_is_finite_and_not_negative_everywhere)
{
    const brdf_model *model = brdf_model_at((size_t)_i);
    uint64_t state = seed_of(_i, 1);
    double coef[COEF_ROOM], i[3], r[3];
    for (int draw = 0; draw < 100; draw++) {
        draw_coef(model, &state, coef);
        for_awkward_pairs(model, coef, check_finite);
        for (int k = 0; k < 100; k++) {
            random_up(&state, i);
            random_up(&state, r);
            check_finite(model, coef, i, r);
        }
    }
}
END_TEST

/* An end of the range; where that is open, the next number inside. */
static double range_end(const param_info *p, bool upper)
{
    if (upper) return p->flags & PARAM_MAX_OPEN ? nextafter(p->max, p->min) : p->max;
    return p->flags & PARAM_MIN_OPEN ? nextafter(p->min, p->max) : p->min;
}

/* Every corner of the parameters' ranges. */
START_TEST(test_brdf_is_finite_at_the_ends_of_its_ranges)
{
    const brdf_model *model = brdf_model_at((size_t)_i);
    double params[BRDF_MAX_PARAMS] = {0}, coef[COEF_ROOM];
    uint64_t state = seed_of(_i, 11);
    int usable = 0;
    for (unsigned corner = 0; corner < 1u << model->n_params; corner++) {
        int end = 0;
        for (int j = 0; j < model->n_params; j++) {
            const param_info *p = &model->params[j];
            const bool upper = corner >> j & 1u;
            params[j] = range_end(p, upper);
            if (p->flags & PARAM_OPTIONAL) params[j] = upper ? 1.0 : PARAM_NONE;
            if (p->flags & PARAM_ROWS) end = upper ? 1 : -1;
        }
        if (!make_coef(model, params, end, &state, coef)) continue;
        for_awkward_pairs(model, coef, check_finite);
        usable++;
    }
    ck_assert_int_ge(usable, 2);
}
END_TEST

START_TEST(test_brdf_is_zero_below_the_horizon)
{
    const brdf_model *model = brdf_model_at((size_t)_i);
    static const double below[] = {-1, -0.5, -1e-9, -0.0, 0.0, 1e-13, BRDF_EDGE};
    uint64_t state = seed_of(_i, 2);
    double coef[COEF_ROOM], up[3];
    draw_coef(model, &state, coef);
    for (size_t k = 0; k < sizeof below / sizeof below[0]; k++) {
        const double c = below[k], down[3] = {sqrt((1 - c) * (1 + c)), 0, c};
        random_up(&state, up);
        assert_near(model->eval(coef, up, down), 0.0, 0.0);
        assert_near(model->eval(coef, down, up), 0.0, 0.0);
        assert_near(model->eval(coef, down, down), 0.0, 0.0);
    }
}
END_TEST

static void check_reciprocal(const brdf_model *model, const double *coef, const double i[3],
                             const double r[3])
{
    const double g = model->eval(coef, i, r), swapped = model->eval(coef, r, i);
    ck_assert_msg(is_near(g, swapped, 1e-14 * g), "%s: %.17g and %.17g", model->name, g, swapped);
}

/* f(i,r) = f(r,i), and so for g; H is the same, hence only a few roundings differ. A model that is
 * flagged otherwise must show a difference: the flag may not be there for nothing. */
START_TEST(test_brdf_is_reciprocal_unless_flagged)
{
    const brdf_model *model = brdf_model_at((size_t)_i);
    const bool reciprocal = !(model->flags & BRDF_NOT_RECIPROCAL);
    uint64_t state = seed_of(_i, 3);
    double coef[COEF_ROOM], i[3], r[3], largest = 0.0;
    for (int draw = 0; draw < 100; draw++) {
        draw_coef(model, &state, coef);
        if (reciprocal) for_awkward_pairs(model, coef, check_reciprocal);
        for (int k = 0; k < 100; k++) {
            random_up(&state, i);
            random_up(&state, r);
            if (reciprocal) check_reciprocal(model, coef, i, r);
            largest = fmax(largest, fabs(model->eval(coef, i, r) / model->eval(coef, r, i) - 1.0));
        }
    }
    if (!reciprocal) ck_assert(largest > 0.01);
}
END_TEST

/* Turning both directions about the normal changes nothing when the model is flagged isotropic, and
 * something when it is not. A lobe 1e-3 wide magnifies the rounding of the turn (2e-16) by some
 * 1e4, and in its far tail by 1e6. */
START_TEST(test_brdf_turn_about_normal_shows_isotropy)
{
    const brdf_model *model = brdf_model_at((size_t)_i);
    const bool isotropic = model->flags & BRDF_ISOTROPIC;
    uint64_t state = seed_of(_i, 4);
    double coef[COEF_ROOM], i[3], r[3], turn[9], largest = 0.0;
    const double normal[3] = {0, 0, 1};
    for (int draw = 0; draw < 100; draw++) {
        draw_coef(model, &state, coef);
        for (int k = 0; k < 100; k++) {
            random_up(&state, i);
            random_up(&state, r);
            const double g = model->eval(coef, i, r);
            mat_turn(normal, TWO_PI * next_random(&state), turn);
            mat_vec(turn, i, i);
            mat_vec(turn, r, r);
            const double turned = model->eval(coef, i, r);
            if (isotropic) assert_near(turned, g, 1e-10 * g);
            largest = fmax(largest, fabs(turned / g - 1.0));
        }
    }
    printf("%s: largest relative change in a turn about the normal: %.2g\n", model->name, largest);
    if (!isotropic) ck_assert(largest > 0.01);
}
END_TEST

/* ------------------------------------------------------------------ the kernel */

enum { N_FACETS = 24 };

/* A set of facets with arrays of its own. */
typedef struct facet_set {
    double normal[3][N_FACETS], tangent[3][N_FACETS], bitangent[3][N_FACETS], area[N_FACETS];
} facet_set;

static void set_facet(facet_set *set, int f, const double normal[3], const double tangent[3],
                      double area)
{
    double bitangent[3];
    cross3(normal, tangent, bitangent);
    for (int j = 0; j < 3; j++) {
        set->normal[j][f] = normal[j];
        set->tangent[j][f] = tangent[j];
        set->bitangent[j][f] = bitangent[j];
    }
    set->area[f] = area;
}

static brdf_facets facets_of(const facet_set *set)
{
    return (brdf_facets){.n = N_FACETS,
                         .normal = {set->normal[0], set->normal[1], set->normal[2]},
                         .tangent = {set->tangent[0], set->tangent[1], set->tangent[2]},
                         .bitangent = {set->bitangent[0], set->bitangent[1], set->bitangent[2]},
                         .area = set->area};
}

/* The 24 right-handed frames along the axes: dot products with them are exact. */
static void axis_facets(facet_set *set, uint64_t *state)
{
    int f = 0;
    for (int n = 0; n < 6; n++)
        for (int t = 0; t < 6; t++) {
            if (n / 2 == t / 2) continue;
            double normal[3] = {0}, tangent[3] = {0};
            normal[n / 2] = n % 2 ? -1 : 1;
            tangent[t / 2] = t % 2 ? -1 : 1;
            set_facet(set, f++, normal, tangent, 0.1 + next_random(state));
        }
    ck_assert_int_eq(f, N_FACETS);
}

static void random_facets(facet_set *set, uint64_t *state)
{
    for (int f = 0; f < N_FACETS; f++) {
        double normal[3], tangent[3], other[3];
        random_unit(state, normal);
        random_unit(state, other);
        perp3(other, normal, tangent);
        set_facet(set, f, normal, tangent, 0.1 + next_random(state));
    }
}

static void set_lane(brdf_light *light, int k, const double i[3], const double r[3])
{
    for (int j = 0; j < 3; j++) {
        light->i[j][k] = i[j];
        light->r[j][k] = r[j];
    }
}

static void get_lane(const brdf_light *light, int k, double i[3], double r[3])
{
    for (int j = 0; j < 3; j++) {
        i[j] = light->i[j][k];
        r[j] = light->r[j][k];
    }
}

static void random_light(brdf_light *light, uint64_t *state)
{
    for (int k = 0; k < BRDF_TILE; k++) {
        double i[3], r[3];
        random_unit(state, i);
        random_unit(state, r);
        set_lane(light, k, i, r);
    }
    brdf_light_finish(light);
}

static void random_visible(double *visible, uint64_t *state)
{
    for (int k = 0; k < N_FACETS * BRDF_TILE; k++)
        visible[k] = next_random(state) < 0.2 ? 0.0 : next_random(state);
}

/* The sum over the facets of one lane by the scalar face. */
static double sum_by_eval(const brdf_model *model, const double *coef, const facet_set *set,
                          const brdf_light *light, const double *visible, int lane)
{
    double i[3], r[3], sum = 0.0;
    get_lane(light, lane, i, r);
    for (int f = 0; f < N_FACETS; f++) {
        double frame[9], i_facet[3], r_facet[3];
        for (int j = 0; j < 3; j++) {
            frame[j] = set->tangent[j][f];
            frame[3 + j] = set->bitangent[j][f];
            frame[6 + j] = set->normal[j][f];
        }
        mat_vec(frame, i, i_facet);
        mat_vec(frame, r, r_facet);
        const double part = visible ? visible[f * BRDF_TILE + lane] : 1.0;
        sum += model->eval(coef, i_facet, r_facet) * set->area[f] * part;
    }
    return sum;
}

/* Worst relative difference between kernel and scalar face over many tiles. */
static double kernel_difference(const brdf_model *model, uint64_t *state,
                                void (*make_facets)(facet_set *, uint64_t *))
{
    static double visible[N_FACETS * BRDF_TILE];
    double coef[COEF_ROOM], worst = 0.0;
    facet_set set;
    brdf_light light;
    for (int draw = 0; draw < 60; draw++) {
        double sum[BRDF_TILE] = {0};
        const bool all_visible = draw % 2 == 0;
        const double weight = 0.5 + next_random(state);
        draw_coef(model, state, coef);
        make_facets(&set, state);
        random_light(&light, state);
        random_visible(visible, state);
        const brdf_facets facets = facets_of(&set);
        model->tile(coef, weight, &facets, &light, all_visible ? NULL : visible, sum);
        for (int k = 0; k < BRDF_TILE; k++) {
            const double want =
                weight * sum_by_eval(model, coef, &set, &light, all_visible ? NULL : visible, k);
            ck_assert_msg(isfinite(sum[k]), "%s: lane %d", model->name, k);
            if (sum[k] != want) worst = fmax(worst, fabs(sum[k] - want) / want);
        }
    }
    return worst;
}

/* With exact dot products nothing but the roundings inside the formula may differ. */
START_TEST(test_brdf_tile_equals_eval_on_axis_facets)
{
    const brdf_model *model = brdf_model_at((size_t)_i);
    uint64_t state = seed_of(_i, 5);
    const double worst = kernel_difference(model, &state, axis_facets);
    printf("%s: kernel against scalar face, exact frames: %.2g\n", model->name, worst);
    assert_near(worst, 0.0, 1e-13);
}
END_TEST

/* Turned facets: the components of the directions round differently (2e-16), which narrow lobes
 * magnify as in the test of isotropy. */
START_TEST(test_brdf_tile_equals_eval_on_turned_facets)
{
    const brdf_model *model = brdf_model_at((size_t)_i);
    uint64_t state = seed_of(_i, 6);
    const double worst = kernel_difference(model, &state, random_facets);
    printf("%s: kernel against scalar face, turned frames: %.2g\n", model->name, worst);
    assert_near(worst, 0.0, 1e-10);
}
END_TEST

/* Turning facets and directions together changes nothing. */
START_TEST(test_brdf_tile_is_the_same_in_a_turned_frame)
{
    const brdf_model *model = brdf_model_at((size_t)_i);
    uint64_t state = seed_of(_i, 7);
    double coef[COEF_ROOM], axis[3], turn[9], sum[BRDF_TILE] = {0}, turned[BRDF_TILE] = {0};
    facet_set set, set_turned;
    brdf_light light, light_turned;
    draw_coef(model, &state, coef);
    random_facets(&set, &state);
    random_light(&light, &state);
    random_unit(&state, axis);
    mat_turn(axis, 2.0, turn);
    for (int f = 0; f < N_FACETS; f++) {
        double n[3] = {set.normal[0][f], set.normal[1][f], set.normal[2][f]};
        double t[3] = {set.tangent[0][f], set.tangent[1][f], set.tangent[2][f]};
        mat_vec(turn, n, n);
        mat_vec(turn, t, t);
        set_facet(&set_turned, f, n, t, set.area[f]);
    }
    for (int k = 0; k < BRDF_TILE; k++) {
        double i[3], r[3];
        get_lane(&light, k, i, r);
        mat_vec(turn, i, i);
        mat_vec(turn, r, r);
        set_lane(&light_turned, k, i, r);
    }
    brdf_light_finish(&light_turned);
    const brdf_facets facets = facets_of(&set), facets_turned = facets_of(&set_turned);
    model->tile(coef, 1.0, &facets, &light, NULL, sum);
    model->tile(coef, 1.0, &facets_turned, &light_turned, NULL, turned);
    for (int k = 0; k < BRDF_TILE; k++)
        assert_near(turned[k], sum[k], 1e-10 * sum[k]);
}
END_TEST

/* Powers of two are exact: half the weight, half the area or half the visibility is half the sum,
 * and the kernel adds to what is there. */
START_TEST(test_brdf_tile_is_linear_and_adds)
{
    const brdf_model *model = brdf_model_at((size_t)_i);
    uint64_t state = seed_of(_i, 8);
    static double half[N_FACETS * BRDF_TILE];
    double coef[COEF_ROOM], sum[4][BRDF_TILE] = {{0}}, twice[BRDF_TILE] = {0};
    facet_set set;
    brdf_light light;
    draw_coef(model, &state, coef);
    random_facets(&set, &state);
    random_light(&light, &state);
    for (int k = 0; k < N_FACETS * BRDF_TILE; k++)
        half[k] = 0.5;
    const brdf_facets facets = facets_of(&set);
    model->tile(coef, 1.0, &facets, &light, NULL, sum[0]);
    model->tile(coef, 0.5, &facets, &light, NULL, sum[1]);
    model->tile(coef, 1.0, &facets, &light, half, sum[2]);
    model->tile(coef, 1.0, &facets, &light, NULL, twice);
    model->tile(coef, 1.0, &facets, &light, NULL, twice);
    for (int f = 0; f < N_FACETS; f++)
        set.area[f] *= 0.5;
    model->tile(coef, 1.0, &facets, &light, NULL, sum[3]);
    double bright = 0.0;
    for (int k = 0; k < BRDF_TILE; k++) {
        bright += sum[0][k];
        for (int j = 1; j < 4; j++)
            assert_near(sum[j][k], 0.5 * sum[0][k], 0.0);
        assert_near(twice[k], 2.0 * sum[0][k], 0.0);
    }
    ck_assert(bright > 0.0);
}
END_TEST

/* A lane's result depends on that lane alone, bit by bit: also when its neighbours look at the
 * facets from below, or exactly along the line to the source. */
START_TEST(test_brdf_tile_lanes_are_independent)
{
    const brdf_model *model = brdf_model_at((size_t)_i);
    uint64_t state = seed_of(_i, 9);
    double coef[COEF_ROOM], alone[BRDF_TILE] = {0}, mixed[BRDF_TILE] = {0};
    facet_set set;
    brdf_light light, other;
    draw_coef(model, &state, coef);
    random_facets(&set, &state);
    random_light(&light, &state);
    for (int k = 0; k < BRDF_TILE; k++) { /* reversed order; every third pair is opposite */
        double i[3], r[3];
        get_lane(&light, BRDF_TILE - 1 - k, i, r);
        if (k % 3 == 0) scale3(i, -1.0, r);
        set_lane(&other, k, i, r);
    }
    brdf_light_finish(&other);
    const brdf_facets facets = facets_of(&set);
    model->tile(coef, 1.0, &facets, &light, NULL, alone);
    model->tile(coef, 1.0, &facets, &other, NULL, mixed);
    for (int k = 0; k < BRDF_TILE; k++)
        assert_near(mixed[k], k % 3 == 0 ? 0.0 : alone[BRDF_TILE - 1 - k], 0.0);
}
END_TEST

/* The coefficients carry no NaN into the kernel where every lane is dark, and no facets add
 * nothing. */
START_TEST(test_brdf_tile_of_nothing_lit_adds_nothing)
{
    const brdf_model *model = brdf_model_at((size_t)_i);
    uint64_t state = seed_of(_i, 10);
    double coef[COEF_ROOM], sum[BRDF_TILE];
    facet_set set;
    brdf_light light;
    draw_coef(model, &state, coef);
    random_light(&light, &state);
    for (int k = 0; k < BRDF_TILE; k++) {
        light.i[2][k] = fabs(light.i[2][k]);
        sum[k] = k;
    }
    brdf_light_finish(&light);
    for (int f = 0; f < N_FACETS; f++)
        set_facet(&set, f, (double[]){0, 0, -1}, (double[]){1, 0, 0}, 1.0);
    brdf_facets facets = facets_of(&set);
    model->tile(coef, 1.0, &facets, &light, NULL, sum);
    facets.n = 0;
    model->tile(coef, 1.0, &facets, &light, NULL, sum);
    for (int k = 0; k < BRDF_TILE; k++)
        assert_near(sum[k], k, 0.0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("brdf properties");
    TCase *tests = tcase_create("every model");
    const int n = model_count();
    tcase_set_timeout(tests, 60);
    tcase_add_loop_test(tests, test_brdf_model_describes_itself, 0, n);
    tcase_add_loop_test(tests, test_brdf_is_finite_and_not_negative_everywhere, 0, n);
    tcase_add_loop_test(tests, test_brdf_is_finite_at_the_ends_of_its_ranges, 0, n);
    tcase_add_loop_test(tests, test_brdf_is_zero_below_the_horizon, 0, n);
    tcase_add_loop_test(tests, test_brdf_is_reciprocal_unless_flagged, 0, n);
    tcase_add_loop_test(tests, test_brdf_turn_about_normal_shows_isotropy, 0, n);
    tcase_add_loop_test(tests, test_brdf_tile_equals_eval_on_axis_facets, 0, n);
    tcase_add_loop_test(tests, test_brdf_tile_equals_eval_on_turned_facets, 0, n);
    tcase_add_loop_test(tests, test_brdf_tile_is_the_same_in_a_turned_frame, 0, n);
    tcase_add_loop_test(tests, test_brdf_tile_is_linear_and_adds, 0, n);
    tcase_add_loop_test(tests, test_brdf_tile_lanes_are_independent, 0, n);
    tcase_add_loop_test(tests, test_brdf_tile_of_nothing_lit_adds_nothing, 0, n);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
