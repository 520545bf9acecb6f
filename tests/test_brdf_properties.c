/* What every BRDF model must satisfy, whichever the table holds: parameters drawn from the ranges
 * that the model itself declares. A property is a function of a model that tells whether it holds,
 * so that models that are wrong on purpose can show that each check is able to fail. */
#include "brdf/dhr.h"
#include "brdf/lane.h"
#include "brdf_draws.h"

#include <stdarg.h>

/* Room for why a property does not hold. */
enum { WHY = 256 };
#define ABOVE 1e-6 /* cosines above which f itself is asked for */

typedef struct property {
    const char *name;
    bool (*holds)(const brdf_model *model, uint64_t seed, char why[WHY]);
} property;

/* Says why a property does not hold; false. */
static bool broken(char why[WHY], const char *format, ...) GLINT_PRINTF(2, 3);

static bool broken(char why[WHY], const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(why, WHY, format, args);
    va_end(args);
    return false;
}

/* Calls check for awkward pairs of directions: normal, oblique and grazing to 2e-12, in, out of and
 * close to the plane of incidence. False as soon as it says so. */
typedef bool pair_check(const brdf_model *model, const double *coef, const double i[3],
                        const double r[3], char why[WHY]);

static bool for_awkward_pairs(const brdf_model *model, const double *coef, pair_check *check,
                              char why[WHY])
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
                if (!check(model, coef, i, r, why)) return false;
            }
    for (int a = 0; a < N; a++) { /* the exact mirror direction, and straight back */
        const double c = cosines[a], s = sqrt((1 - c) * (1 + c));
        const double i[3] = {0.6 * s, 0.8 * s, c}, mirror[3] = {-0.6 * s, -0.8 * s, c};
        if (!check(model, coef, i, mirror, why) || !check(model, coef, i, i, why)) return false;
    }
    return true;
}

/* The same for a hundred random pairs, too. */
static bool for_many_pairs(const brdf_model *model, const double *coef, uint64_t *state,
                           pair_check *check, char why[WHY])
{
    if (!for_awkward_pairs(model, coef, check, why)) return false;
    for (int k = 0; k < 100; k++) {
        double i[3], r[3];
        random_up(state, i);
        random_up(state, r);
        if (!check(model, coef, i, r, why)) return false;
    }
    return true;
}

/* ------------------------------------------------------------------ the scalar */

/* g everywhere, and f = g/(ci cr) where both cosines are above 1e-6. */
static bool is_usable(const brdf_model *model, const double *coef, const double i[3],
                      const double r[3], char why[WHY])
{
    const double g = model->eval(coef, i, r), w = i[2] * r[2];
    const bool finite = isfinite(g) && (i[2] <= ABOVE || r[2] <= ABOVE || isfinite(g / w));
    if (finite && g >= 0.0) return true;
    return broken(why, "g = %g at i = (%g %g %g), r = (%g %g %g)", g, i[0], i[1], i[2], r[0], r[1],
                  r[2]);
}

static bool finite_and_not_negative(const brdf_model *model, uint64_t seed, char why[WHY])
{
    double coef[COEF_ROOM];
    for (int draw = 0; draw < 100; draw++) {
        draw_coef(model, &seed, coef);
        if (!for_many_pairs(model, coef, &seed, is_usable, why)) return false;
    }
    return true;
}

/* An end of the range; where that is open, the next number inside. */
static double range_end(const param_info *p, bool upper)
{
    if (upper) return p->flags & PARAM_MAX_OPEN ? nextafter(p->max, p->min) : p->max;
    return p->flags & PARAM_MIN_OPEN ? nextafter(p->min, p->max) : p->min;
}

/* Every corner of the parameters' ranges. */
static bool finite_at_the_ends_of_its_ranges(const brdf_model *model, uint64_t seed, char why[WHY])
{
    double params[BRDF_MAX_PARAMS] = {0}, coef[COEF_ROOM];
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
        if (!make_coef(model, params, end, &seed, coef)) continue;
        if (!for_awkward_pairs(model, coef, is_usable, why)) return false;
        usable++;
    }
    return usable >= 2 || broken(why, "%d corners of the ranges are usable", usable);
}

static bool zero_below_the_horizon(const brdf_model *model, uint64_t seed, char why[WHY])
{
    static const double below[] = {-1, -0.5, -1e-9, -0.0, 0.0, 1e-13, BRDF_EDGE};
    double coef[COEF_ROOM], up[3];
    draw_coef(model, &seed, coef);
    for (size_t k = 0; k < sizeof below / sizeof below[0]; k++) {
        const double c = below[k], down[3] = {sqrt((1 - c) * (1 + c)), 0, c};
        random_up(&seed, up);
        if (!is_near(model->eval(coef, up, down), 0.0, 0.0) ||
            !is_near(model->eval(coef, down, up), 0.0, 0.0) ||
            !is_near(model->eval(coef, down, down), 0.0, 0.0))
            return broken(why, "light at a cosine of %g", c);
    }
    return true;
}

/* H is the same when i and r are exchanged, hence only a few roundings differ. */
static bool is_same_exchanged(const brdf_model *model, const double *coef, const double i[3],
                              const double r[3], char why[WHY])
{
    const double g = model->eval(coef, i, r), swapped = model->eval(coef, r, i);
    return is_near(g, swapped, 1e-14 * g) || broken(why, "%.17g and %.17g", g, swapped);
}

/* f(i,r) = f(r,i), and so for g. A model that is flagged otherwise must show a difference: the flag
 * may not be there for nothing. */
static bool reciprocal_unless_flagged(const brdf_model *model, uint64_t seed, char why[WHY])
{
    const bool reciprocal = !(model->flags & BRDF_NOT_RECIPROCAL);
    double coef[COEF_ROOM], i[3], r[3], largest = 0.0;
    for (int draw = 0; draw < 100; draw++) {
        draw_coef(model, &seed, coef);
        if (reciprocal && !for_many_pairs(model, coef, &seed, is_same_exchanged, why)) return false;
        random_up(&seed, i);
        random_up(&seed, r);
        largest = fmax(largest, fabs(model->eval(coef, i, r) / model->eval(coef, r, i) - 1.0));
    }
    return reciprocal || largest > 0.01 ||
           broken(why, "flagged as not reciprocal, and differs by %g only", largest);
}

/* Turning both directions about the normal changes nothing when the model is flagged isotropic, and
 * something when it is not. A lobe 1e-3 wide magnifies the rounding of the turn (2e-16) by some
 * 1e4, and in its far tail by 1e6. */
static bool isotropic_if_flagged(const brdf_model *model, uint64_t seed, char why[WHY])
{
    const bool isotropic = model->flags & BRDF_ISOTROPIC;
    double coef[COEF_ROOM], i[3], r[3], turn[9], largest = 0.0;
    const double normal[3] = {0, 0, 1};
    for (int draw = 0; draw < 100; draw++) {
        draw_coef(model, &seed, coef);
        for (int k = 0; k < 100; k++) {
            random_up(&seed, i);
            random_up(&seed, r);
            const double g = model->eval(coef, i, r);
            mat_turn(normal, TWO_PI * next_random(&seed), turn);
            mat_vec(turn, i, i);
            mat_vec(turn, r, r);
            const double turned = model->eval(coef, i, r);
            if (isotropic && !is_near(turned, g, 1e-10 * g))
                return broken(why, "%.17g becomes %.17g in a turn", g, turned);
            largest = fmax(largest, fabs(turned / g - 1.0));
        }
    }
    printf("%s: largest relative change in a turn about the normal: %.2g\n", model->name, largest);
    return isotropic || largest > 0.01 ||
           broken(why, "not flagged as isotropic, and changes by %g only", largest);
}

/* ------------------------------------------------------------------- energy */

/* A random lobe, some of its parameters at their largest; false where they are refused. */
static bool draw_strong_lobe(const brdf_model *model, uint64_t *state, brdf_lobe *out)
{
    double params[BRDF_MAX_PARAMS] = {0};
    draw_params(model, state, params);
    for (int j = 0; j < model->n_params; j++)
        if (next_random(state) < 0.3 && !isnan(params[j]))
            params[j] = range_end(&model->params[j], true);
    return make_lobe(model, params, 0, state, out);
}

/* A material of random parameters reflects at most what it gets, where the model is flagged so; a
 * model that is not flagged so must be able to do otherwise. */
static bool passive_if_flagged(const brdf_model *model, uint64_t seed, char why[WHY])
{
    const bool passive = model->flags & BRDF_PASSIVE;
    brdf_lobe lobe = {.model = model, .weight = 1.0};
    const brdf_material material = {.n_lobes = 1, .lobes = &lobe};
    double most = 0.0;
    for (int draw = 0; draw < 40; draw++) {
        brdf_energy worst;
        if (!draw_strong_lobe(model, &seed, &lobe)) continue;
        const bool gains = brdf_energy_gain(&material, &worst);
        brdf_lobe_free(&lobe);
        if (passive && gains)
            return broken(why, "reflects %.9g of the light from %g deg", worst.dhr,
                          worst.theta_i / DEG);
        if (gains) most = fmax(most, worst.dhr);
    }
    return passive || most > 1.0 || broken(why, "not flagged as passive, and never gains");
}

/* What is mirrored is a reflectance. */
static bool mirrors_a_part_at_most(const brdf_model *model, uint64_t seed, char why[WHY])
{
    double coef[COEF_ROOM];
    for (int draw = 0; draw < 100 && model->specular; draw++) {
        draw_coef(model, &seed, coef);
        for (double ci = 1.0; ci > BRDF_EDGE; ci *= 0.7) {
            const double part = model->specular(coef, ci);
            if (!(part >= 0.0 && part <= 1.0 + 1e-15))
                return broken(why, "mirrors %.17g at a cosine of %g", part, ci);
        }
    }
    return true;
}

/* ------------------------------------------------------------------ the kernel */

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

static void get_lane(const brdf_light *light, int k, double i[3], double r[3])
{
    for (int j = 0; j < 3; j++) {
        i[j] = light->i[j][k];
        r[j] = light->r[j][k];
    }
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

/* Whether kernel and scalar face agree over many tiles to that relative difference. */
static bool kernel_agrees(const brdf_model *model, uint64_t *state,
                          void (*make_facets)(facet_set *, uint64_t *), double most, char why[WHY])
{
    static double visible[N_FACETS * BRDF_TILE];
    double coef[COEF_ROOM];
    facet_set set;
    brdf_light light;
    for (int draw = 0; draw < 60; draw++) {
        double sum[BRDF_TILE] = {0};
        const double *seen = draw % 2 == 0 ? NULL : visible;
        const double weight = 0.5 + next_random(state);
        draw_coef(model, state, coef);
        make_facets(&set, state);
        random_light(&light, state);
        random_visible(visible, state);
        const brdf_facets facets = facets_of(&set);
        model->tile(coef, weight, &facets, &light, seen, sum);
        for (int k = 0; k < BRDF_TILE; k++) {
            const double want = weight * sum_by_eval(model, coef, &set, &light, seen, k);
            if (!isfinite(sum[k]) || !is_near(sum[k], want, most * want))
                return broken(why, "lane %d: the kernel has %.17g, the scalar face %.17g", k,
                              sum[k], want);
        }
    }
    return true;
}

/* With exact dot products nothing but the roundings inside the formula may differ. */
static bool tile_equals_eval_on_axis_facets(const brdf_model *model, uint64_t seed, char why[WHY])
{
    return kernel_agrees(model, &seed, axis_facets, 1e-13, why);
}

/* Turned facets: the components of the directions round differently (2e-16), which narrow lobes
 * magnify as in the check of isotropy. */
static bool tile_equals_eval_on_turned_facets(const brdf_model *model, uint64_t seed, char why[WHY])
{
    return kernel_agrees(model, &seed, random_facets, 1e-10, why);
}

/* Facets and directions turned together. */
static void turn_all(const facet_set *set, const brdf_light *light, const double turn[9],
                     facet_set *set_turned, brdf_light *light_turned)
{
    for (int f = 0; f < N_FACETS; f++) {
        double n[3] = {set->normal[0][f], set->normal[1][f], set->normal[2][f]};
        double t[3] = {set->tangent[0][f], set->tangent[1][f], set->tangent[2][f]};
        mat_vec(turn, n, n);
        mat_vec(turn, t, t);
        set_facet(set_turned, f, n, t, set->area[f]);
    }
    for (int k = 0; k < BRDF_TILE; k++) {
        double i[3], r[3];
        get_lane(light, k, i, r);
        mat_vec(turn, i, i);
        mat_vec(turn, r, r);
        set_lane(light_turned, k, i, r);
    }
    brdf_light_finish(light_turned);
}

/* Turning facets and directions together changes nothing. */
static bool tile_is_the_same_in_a_turned_frame(const brdf_model *model, uint64_t seed,
                                               char why[WHY])
{
    double coef[COEF_ROOM], axis[3], turn[9], sum[BRDF_TILE] = {0}, turned[BRDF_TILE] = {0};
    facet_set set, set_turned;
    brdf_light light, light_turned;
    draw_coef(model, &seed, coef);
    random_facets(&set, &seed);
    random_light(&light, &seed);
    random_unit(&seed, axis);
    mat_turn(axis, 2.0, turn);
    turn_all(&set, &light, turn, &set_turned, &light_turned);
    const brdf_facets facets = facets_of(&set), facets_turned = facets_of(&set_turned);
    model->tile(coef, 1.0, &facets, &light, NULL, sum);
    model->tile(coef, 1.0, &facets_turned, &light_turned, NULL, turned);
    for (int k = 0; k < BRDF_TILE; k++)
        if (!is_near(turned[k], sum[k], 1e-10 * sum[k]))
            return broken(why, "%.17g becomes %.17g", sum[k], turned[k]);
    return true;
}

/* Powers of two are exact: half the weight, half the area or half the visibility is half the sum,
 * and the kernel adds to what is there. */
static bool tile_is_linear_and_adds(const brdf_model *model, uint64_t seed, char why[WHY])
{
    static double half[N_FACETS * BRDF_TILE];
    double coef[COEF_ROOM], sum[4][BRDF_TILE] = {{0}}, twice[BRDF_TILE] = {0}, bright = 0.0;
    facet_set set;
    brdf_light light;
    draw_coef(model, &seed, coef);
    random_facets(&set, &seed);
    random_light(&light, &seed);
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
    for (int k = 0; k < BRDF_TILE; k++) {
        bright += sum[0][k];
        bool good = is_near(twice[k], 2.0 * sum[0][k], 0.0);
        for (int j = 1; j < 4; j++)
            good = good && is_near(sum[j][k], 0.5 * sum[0][k], 0.0);
        if (!good) return broken(why, "lane %d", k);
    }
    return bright > 0.0 || model->specular || broken(why, "nothing shines");
}

/* A lane's result depends on that lane alone, bit by bit: also when its neighbours look at the
 * facets from below, or exactly along the line to the source. */
static bool tile_lanes_are_independent(const brdf_model *model, uint64_t seed, char why[WHY])
{
    double coef[COEF_ROOM], alone[BRDF_TILE] = {0}, mixed[BRDF_TILE] = {0};
    facet_set set;
    brdf_light light, other;
    draw_coef(model, &seed, coef);
    random_facets(&set, &seed);
    random_light(&light, &seed);
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
    for (int k = 0; k < BRDF_TILE; k++) {
        const double want = k % 3 == 0 ? 0.0 : alone[BRDF_TILE - 1 - k];
        if (!is_near(mixed[k], want, 0.0))
            return broken(why, "%.17g among others, %.17g alone", mixed[k], want);
    }
    return true;
}

/* The coefficients carry no NaN into the kernel where every lane is dark, and no facets add
 * nothing. */
static bool tile_of_nothing_lit_adds_nothing(const brdf_model *model, uint64_t seed, char why[WHY])
{
    double coef[COEF_ROOM], sum[BRDF_TILE];
    facet_set set;
    brdf_light light;
    draw_coef(model, &seed, coef);
    random_light(&light, &seed);
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
        if (!is_near(sum[k], k, 0.0)) return broken(why, "lane %d has %g", k, sum[k] - k);
    return true;
}

/* What a watch was shown, and a part of it that is taken. */
typedef struct record {
    uint32_t shown[N_FACETS], taken[N_FACETS];
    int calls;
} record;

static uint32_t note(void *finder, int facet, uint32_t lanes)
{
    record *seen = finder;
    seen->calls++;
    seen->shown[facet] = lanes;
    seen->taken[facet] = lanes & UINT32_C(0x5a5af0c3);
    return seen->taken[facet];
}

/* Some lanes are never to be shown at the horizon; the other limits are met by some percent. */
static void random_watch(brdf_watch *watch, brdf_watch_kind kind, record *seen, uint64_t *state)
{
    *seen = (record){.calls = 0};
    *watch = (brdf_watch){.kind = kind, .finder = seen, .found = note};
    for (int k = 0; k < BRDF_TILE; k++) {
        watch->low[k] = k % 5 == 0 ? -1.0 : 0.2 * next_random(state);
        watch->near[k] = 1.5 + 0.5 * next_random(state);
        watch->graze[k] = 0.3 * next_random(state);
    }
}

/* By how much a sample is beyond the limits of its watch. */
static double beyond_limits(const brdf_watch *watch, int k, double ci, double cr)
{
    double most = watch->low[k] - fabs(ci);
    if (watch->kind >= BRDF_WATCH_LOBE) most = fmax(most, ci + cr - watch->near[k]);
    if (watch->kind >= BRDF_WATCH_WINGS) most = fmax(most, watch->graze[k] - fabs(ci) - cr);
    return fmin(most, cr - BRDF_EDGE);
}

/* The kernel shows what its watch asks for and nothing else, and adds all but what is taken: the
 * same as with these samples hidden. */
static bool tile_shows_what_is_watched(const brdf_model *model, uint64_t seed, char why[WHY])
{
    static double visible[N_FACETS * BRDF_TILE];
    double coef[COEF_ROOM];
    facet_set set;
    brdf_light light;
    brdf_watch watch;
    record seen;
    for (int draw = 0; draw < 30; draw++) {
        draw_coef(model, &seed, coef);
        random_facets(&set, &seed);
        random_light(&light, &seed);
        random_watch(&watch, (brdf_watch_kind)(draw % 3), &seen, &seed);
        brdf_facets facets = facets_of(&set);
        double sum[BRDF_TILE] = {0}, want[BRDF_TILE] = {0};
        facets.watch = &watch;
        model->tile(coef, 1.0, &facets, &light, NULL, sum);
        if (seen.calls == 0) return broken(why, "nothing is shown");
        for (int n = 0; n < N_FACETS * BRDF_TILE; n++) {
            const int f = n / BRDF_TILE, k = n % BRDF_TILE;
            double i[3], r[3];
            get_lane(&light, k, i, r);
            const double normal[3] = {set.normal[0][f], set.normal[1][f], set.normal[2][f]};
            const double beyond = beyond_limits(&watch, k, dot3(i, normal), dot3(r, normal));
            const bool shown = seen.shown[f] >> k & 1;
            if (fabs(beyond) > 1e-14 && shown != (beyond > 0.0))
                return broken(why, "a sample %g beyond the limits is%s shown", beyond,
                              shown ? "" : " not");
            visible[n] = seen.taken[f] >> k & 1 ? 0.0 : 1.0;
        }
        facets.watch = NULL;
        model->tile(coef, 1.0, &facets, &light, visible, want);
        for (int k = 0; k < BRDF_TILE; k++)
            if (!is_near(sum[k], want[k], 0.0))
                return broken(why, "lane %d has %.17g, not %.17g", k, sum[k], want[k]);
    }
    return true;
}

/* ---------------------------------------------------------------- descriptors */

static bool descriptor_is_complete(const brdf_model *model, uint64_t seed, char why[WHY])
{
    (void)seed;
    if (!model->name[0] || !model->doc[0] || !model->source[0])
        return broken(why, "no name, doc or source");
    if (model->n_params < 1 || model->n_params > BRDF_MAX_PARAMS)
        return broken(why, "%d parameters", model->n_params);
    for (int j = 0; j < model->n_params; j++) {
        const param_info *p = &model->params[j];
        if (!p->name[0] || !p->unit || !p->doc[0]) return broken(why, "parameter %d: no name", j);
        if (!(isfinite(p->min) && isfinite(p->max) && p->min < p->max))
            return broken(why, "%s: range", p->name);
        if (!isnan(p->def) && !param_accepts(p, p->def)) return broken(why, "%s: default", p->name);
        for (int k = 0; k < j; k++)
            if (strcmp(p->name, model->params[k].name) == 0)
                return broken(why, "%s stands twice", p->name);
    }
    return true;
}

static const property properties[] = {
    {"descriptor is complete", descriptor_is_complete},
    {"finite and not negative", finite_and_not_negative},
    {"finite at the ends of its ranges", finite_at_the_ends_of_its_ranges},
    {"zero below the horizon", zero_below_the_horizon},
    {"reciprocal unless flagged", reciprocal_unless_flagged},
    {"isotropic if flagged", isotropic_if_flagged},
    {"passive if flagged", passive_if_flagged},
    {"mirrors a part at most", mirrors_a_part_at_most},
    {"tile equals eval on axis facets", tile_equals_eval_on_axis_facets},
    {"tile equals eval on turned facets", tile_equals_eval_on_turned_facets},
    {"tile is the same in a turned frame", tile_is_the_same_in_a_turned_frame},
    {"tile is linear and adds", tile_is_linear_and_adds},
    {"tile lanes are independent", tile_lanes_are_independent},
    {"tile of nothing lit adds nothing", tile_of_nothing_lit_adds_nothing},
    {"tile shows what is watched", tile_shows_what_is_watched},
};
enum { N_PROPERTIES = sizeof properties / sizeof properties[0] };

/* ------------------------------------------------------------------- the table */

static int model_count(void)
{
    int n = 0;
    while (brdf_model_at((size_t)n))
        n++;
    return n;
}

/* Test _i: property _i % N_PROPERTIES of model _i / N_PROPERTIES. */
START_TEST(test_brdf_every_model_has_every_property)
{
    const brdf_model *model = brdf_model_at((size_t)(_i / N_PROPERTIES));
    const property *p = &properties[_i % N_PROPERTIES];
    char why[WHY] = "";
    ck_assert_msg(p->holds(model, (uint64_t)_i, why), "%s: %s: %s", model->name, p->name, why);
}
END_TEST

START_TEST(test_brdf_every_model_is_found_by_its_name)
{
    for (size_t k = 0; brdf_model_at(k); k++)
        ck_assert_ptr_eq(brdf_model_named(brdf_model_at(k)->name), brdf_model_at(k));
}
END_TEST

/* -------------------------------------------------------------------- toys */

/* A toy takes its two faces from its formula, like every model; a formula of the test's own stands
 * in for the file of a model. */
static const param_info toy_params[] = {
    {"rho", "", "reflectance", 0, 1, PARAM_REQUIRED, 0},
};

static glint_status toy_prepare(const double *given, double coef[BRDF_MAX_COEF], glint_error *error)
{
    (void)error;
    coef[0] = given[0] / PI;
    return GLINT_OK;
}

#define TOY(NAME, FLAGS)                                                                           \
    {                                                                                              \
        .name = #NAME, .doc = "a toy", .source = "this test", .params = toy_params, .n_params = 1, \
        .flags = (FLAGS), .prepare = toy_prepare, .eval = NAME##_eval, .tile = NAME##_tile         \
    }

/* Right: Lambert's law with a darker rim, f = rho/pi ci cr. */
static inline double sound_lane(const double *coef, const brdf_lane *l)
{
    const double w = l->ci * l->cr;
    return coef[0] * (w * w);
}
#define BRDF_LANE sound_lane
#define brdf_eval sound_eval
#define brdf_tile_add sound_tile_add
#define brdf_tile_run sound_tile_run
#define brdf_tile sound_tile
#include "brdf/tile.h"
#undef BRDF_LANE
#undef brdf_eval
#undef brdf_tile_add
#undef brdf_tile_run
#undef brdf_tile

/* Wrong: f depends on the incidence alone. */
static inline double one_way_lane(const double *coef, const brdf_lane *l)
{
    return coef[0] * (l->ci * l->ci * l->cr);
}
#define BRDF_LANE one_way_lane
#define brdf_eval one_way_eval
#define brdf_tile_add one_way_tile_add
#define brdf_tile_run one_way_tile_run
#define brdf_tile one_way_tile
#include "brdf/tile.h"
#undef BRDF_LANE
#undef brdf_eval
#undef brdf_tile_add
#undef brdf_tile_run
#undef brdf_tile

/* Wrong: reflects 1.3 times the share that it says. */
static inline double generous_lane(const double *coef, const brdf_lane *l)
{
    return 1.3 * coef[0] * (l->ci * l->cr);
}
#define BRDF_LANE generous_lane
#define brdf_eval generous_eval
#define brdf_tile_add generous_tile_add
#define brdf_tile_run generous_tile_run
#define brdf_tile generous_tile
#include "brdf/tile.h"
#undef BRDF_LANE
#undef brdf_eval
#undef brdf_tile_add
#undef brdf_tile_run
#undef brdf_tile

/* Wrong: no number where source and observer both graze the surface. */
static inline double grazing_lane(const double *coef, const brdf_lane *l)
{
    const double w = l->ci * l->cr;
    return coef[0] * w * sqrt(w - 1e-14) / sqrt(w);
}
#define BRDF_LANE grazing_lane
#define brdf_eval grazing_eval
#define brdf_tile_add grazing_tile_add
#define brdf_tile_run grazing_tile_run
#define brdf_tile grazing_tile
#include "brdf/tile.h"
#undef BRDF_LANE
#undef brdf_eval
#undef brdf_tile_add
#undef brdf_tile_run
#undef brdf_tile

/* Wrong: depends on the tangent. */
static inline double brushed_lane(const double *coef, const brdf_lane *l)
{
    return coef[0] * (l->ci * l->cr) * (l->ht * l->ht) / l->hh;
}
#define BRDF_LANE brushed_lane
#define brdf_eval brushed_eval
#define brdf_tile_add brushed_tile_add
#define brdf_tile_run brushed_tile_run
#define brdf_tile brushed_tile
#include "brdf/tile.h"
#undef BRDF_LANE
#undef brdf_eval
#undef brdf_tile_add
#undef brdf_tile_run
#undef brdf_tile

/* Wrong: a scalar face without a horizon, and below 0 for some pairs. */
static double shining_eval(const double *coef, const double i[3], const double r[3])
{
    return coef[0] * i[2] * r[2];
}

static double owing_eval(const double *coef, const double i[3], const double r[3])
{
    return i[2] > BRDF_EDGE && r[2] > BRDF_EDGE ? coef[0] * i[2] * r[2] * (i[2] - 0.5) : 0.0;
}

/* Wrong: kernels that write over what is there, that let one lane see another, that read the
 * component's axes for the facet's, that shine in the dark, and that show nothing. */
static void forgetting_tile(const double *coef, double weight, const brdf_facets *facets,
                            const brdf_light *light, const double *visible, double sum[BRDF_TILE])
{
    for (int k = 0; k < BRDF_TILE; k++)
        sum[k] = 0.0;
    sound_tile(coef, weight, facets, light, visible, sum);
}

static void leaking_tile(const double *coef, double weight, const brdf_facets *facets,
                         const brdf_light *light, const double *visible, double sum[BRDF_TILE])
{
    double own[BRDF_TILE] = {0};
    sound_tile(coef, weight, facets, light, visible, own);
    for (int k = 0; k < BRDF_TILE; k++)
        sum[k] += own[k] + 1e-9 * own[(k + 1) % BRDF_TILE];
}

static void axis_bound_tile(const double *coef, double weight, const brdf_facets *facets,
                            const brdf_light *light, const double *visible, double sum[BRDF_TILE])
{
    double own[BRDF_TILE] = {0};
    sound_tile(coef, weight, facets, light, visible, own);
    for (int k = 0; k < BRDF_TILE; k++)
        sum[k] += own[k] * (1.0 + 1e-6 * light->i[0][k]);
}

static void glowing_tile(const double *coef, double weight, const brdf_facets *facets,
                         const brdf_light *light, const double *visible, double sum[BRDF_TILE])
{
    sound_tile(coef, weight, facets, light, visible, sum);
    for (int k = 0; k < BRDF_TILE; k++)
        sum[k] += 1e-9 * coef[0];
}

static void hiding_tile(const double *coef, double weight, const brdf_facets *facets,
                        const brdf_light *light, const double *visible, double sum[BRDF_TILE])
{
    brdf_facets unwatched = *facets;
    unwatched.watch = NULL;
    sound_tile(coef, weight, &unwatched, light, visible, sum);
}

static double generous_specular(const double *coef, double ci)
{
    return PI * coef[0] / sqrt(ci);
}

#define DIFFUSE (BRDF_ISOTROPIC | BRDF_PASSIVE)

static const brdf_model sound_toy = TOY(sound, DIFFUSE);

START_TEST(test_brdf_toy_that_is_sound_has_every_property)
{
    const property *p = &properties[_i];
    char why[WHY] = "";
    ck_assert_msg(p->holds(&sound_toy, (uint64_t)_i, why), "%s: %s", p->name, why);
}
END_TEST

/* The sound toy with another kernel. */
#define KERNEL(NAME)                                                                               \
    {                                                                                              \
        .name = #NAME, .doc = "a toy", .source = "this test", .params = toy_params, .n_params = 1, \
        .flags = DIFFUSE, .prepare = toy_prepare, .eval = sound_eval, .tile = NAME##_tile          \
    }

static const struct {
    brdf_model toy;
    bool (*broken)(const brdf_model *model, uint64_t seed, char why[WHY]);
    const char *why;
} wrong_toys[] = {
    {TOY(one_way, DIFFUSE), reciprocal_unless_flagged, " and "},
    {TOY(sound, DIFFUSE | BRDF_NOT_RECIPROCAL), reciprocal_unless_flagged, "differs by 0 only"},
    {TOY(generous, DIFFUSE), passive_if_flagged, "of the light from 0 deg"},
    {TOY(sound, BRDF_ISOTROPIC), passive_if_flagged, "never gains"},
    {TOY(grazing, DIFFUSE), finite_and_not_negative, "nan at i ="},
    {TOY(grazing, DIFFUSE), finite_at_the_ends_of_its_ranges, "nan at i ="},
    {TOY(brushed, DIFFUSE), isotropic_if_flagged, "in a turn"},
    {TOY(sound, BRDF_PASSIVE), isotropic_if_flagged, "not flagged as isotropic"},
    {{.name = "shining",
      .params = toy_params,
      .n_params = 1,
      .prepare = toy_prepare,
      .eval = shining_eval},
     zero_below_the_horizon,
     "light at a cosine of -1"},
    {{.name = "owing",
      .params = toy_params,
      .n_params = 1,
      .prepare = toy_prepare,
      .eval = owing_eval},
     finite_and_not_negative,
     "g = -"},
    {{.name = "bright mirror",
      .params = toy_params,
      .n_params = 1,
      .prepare = toy_prepare,
      .specular = generous_specular},
     mirrors_a_part_at_most,
     "mirrors 1."},
    {{.name = "nameless", .doc = "", .source = ""}, descriptor_is_complete, "no name"},
    {KERNEL(generous), tile_equals_eval_on_axis_facets, "the kernel has"},
    {KERNEL(generous), tile_equals_eval_on_turned_facets, "the kernel has"},
    {KERNEL(axis_bound), tile_is_the_same_in_a_turned_frame, "becomes"},
    {KERNEL(forgetting), tile_is_linear_and_adds, "lane 0"},
    {KERNEL(leaking), tile_lanes_are_independent, "alone"},
    {KERNEL(glowing), tile_of_nothing_lit_adds_nothing, "lane 0"},
    {KERNEL(hiding), tile_shows_what_is_watched, "nothing is shown"},
};
enum { N_WRONG = sizeof wrong_toys / sizeof wrong_toys[0] };

START_TEST(test_brdf_toy_that_is_wrong_is_found_out)
{
    const brdf_model *toy = &wrong_toys[_i].toy;
    char why[WHY] = "";
    ck_assert_msg(!wrong_toys[_i].broken(toy, 1, why), "%s passes", toy->name);
    ck_assert_msg(strstr(why, wrong_toys[_i].why), "%s: %s", toy->name, why);
}
END_TEST

/* No check is there that has not been seen to fail. */
START_TEST(test_brdf_every_property_has_a_toy_that_breaks_it)
{
    for (int p = 0; p < N_PROPERTIES; p++) {
        bool found = false;
        for (int k = 0; k < N_WRONG; k++)
            found = found || wrong_toys[k].broken == properties[p].holds;
        ck_assert_msg(found, "no toy breaks: %s", properties[p].name);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("brdf properties");
    TCase *tests = tcase_create("every model");
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, test_brdf_every_model_is_found_by_its_name);
    tcase_add_loop_test(tests, test_brdf_every_model_has_every_property, 0,
                        model_count() * N_PROPERTIES);
    suite_add_tcase(suite, tests);
    TCase *toys = tcase_create("toys");
    tcase_set_timeout(toys, 60);
    tcase_add_loop_test(toys, test_brdf_toy_that_is_sound_has_every_property, 0, N_PROPERTIES);
    tcase_add_loop_test(toys, test_brdf_toy_that_is_wrong_is_found_out, 0, N_WRONG);
    tcase_add_test(toys, test_brdf_every_property_has_a_toy_that_breaks_it);
    suite_add_tcase(suite, toys);
    return run_suite(suite);
}
