/* brdf_draws.h: materials and directions drawn at random, for tests of whatever model there is. */
#ifndef GLINT_TESTS_BRDF_DRAWS_H
#define GLINT_TESTS_BRDF_DRAWS_H

#include "base/constants.h"
#include "base/vec.h"
#include "brdf/table.h"
#include "testing.h"

#include <stdint.h>

enum { COEF_ROOM = 512 };

/* Uniform in 0..1, the same sequence on every machine (Knuth's MMIX generator). */
static inline double next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static inline void random_unit(uint64_t *state, double out[3])
{
    double v[3];
    do {
        for (int k = 0; k < 3; k++)
            v[k] = 2.0 * next_random(state) - 1.0;
    } while (norm3(v) > 1.0 || norm3(v) < 0.1);
    unit3(v, out);
}

/* A direction above the facet. */
static inline void random_up(uint64_t *state, double out[3])
{
    random_unit(state, out);
    out[2] = fabs(out[2]);
}

/* A value in the range: even where it is narrow, by magnitude where it is wide. */
static inline double draw_value(const param_info *p, uint64_t *state)
{
    const double u = 0.001 + 0.998 * next_random(state), width = p->max - p->min;
    if (p->min > 0.0 && p->max > 100.0 * p->min) return p->min * pow(p->max / p->min, u);
    if (p->min >= 0.0 && width > 10.0) return p->min + width * pow(u, 8.0);
    return p->min + width * u;
}

static inline void draw_params(const brdf_model *model, uint64_t *state,
                               double params[BRDF_MAX_PARAMS])
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

static inline int array_count(const brdf_model *model)
{
    int n = 0;
    for (int j = 0; j < model->n_params; j++)
        n += (model->params[j].flags & PARAM_ROWS) != 0;
    return n;
}

/* Fills the arrays of a lobe, all of as many rows. Elements are drawn from the middle of their
 * range, a ten thousandth of it, which keeps f among usable numbers; end: taken from the lower (-1)
 * or upper (1) end of the range instead. */
static inline void fill_arrays(brdf_lobe *lobe, uint64_t *state, int end)
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
static inline void fill_table(brdf_lobe *lobe, uint64_t *state)
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

/* Prepares a lobe with these parameters, and arrays drawn; false where they are refused (the lobe
 * is then empty). brdf_lobe_free ends it. */
static inline bool make_lobe(const brdf_model *model, const double *params, int end,
                             uint64_t *state, brdf_lobe *out)
{
    *out = (brdf_lobe){.model = model, .weight = 1.0};
    memcpy(out->params, params, sizeof out->params);
    if (array_count(model) > 0) fill_arrays(out, state, end);
    if (model->flags & BRDF_MEASURED) fill_table(out, state);
    if (brdf_lobe_prepare(out, NULL) == GLINT_OK) return true;
    brdf_lobe_free(out);
    return false;
}

/* A random lobe; draws again where the combination is refused. */
static inline void draw_lobe(const brdf_model *model, uint64_t *state, brdf_lobe *out)
{
    double params[BRDF_MAX_PARAMS] = {0};
    for (int attempt = 0; attempt < 100; attempt++) {
        draw_params(model, state, params);
        if (make_lobe(model, params, 0, state, out)) return;
    }
    ck_abort_msg("%s: no usable parameters found", model->name);
}

/* The numbers alone, and the lobe is done with. */
static inline void take_coef(brdf_lobe *lobe, double coef[COEF_ROOM])
{
    const size_t n = lobe->numbers ? lobe->n_numbers : BRDF_MAX_COEF;
    ck_assert_uint_le(n, COEF_ROOM);
    memcpy(coef, brdf_lobe_coef(lobe), n * sizeof *coef);
    brdf_lobe_free(lobe);
}

static inline bool make_coef(const brdf_model *model, const double *params, int end,
                             uint64_t *state, double coef[COEF_ROOM])
{
    brdf_lobe lobe;
    if (!make_lobe(model, params, end, state, &lobe)) return false;
    take_coef(&lobe, coef);
    return true;
}

static inline void draw_coef(const brdf_model *model, uint64_t *state, double coef[COEF_ROOM])
{
    brdf_lobe lobe;
    draw_lobe(model, state, &lobe);
    take_coef(&lobe, coef);
}

/* A light of pairs of directions all around. */
static inline void set_lane(brdf_light *light, int k, const double i[3], const double r[3])
{
    for (int j = 0; j < 3; j++) {
        light->i[j][k] = i[j];
        light->r[j][k] = r[j];
    }
}

static inline void random_light(brdf_light *light, uint64_t *state)
{
    for (int k = 0; k < BRDF_TILE; k++) {
        double i[3], r[3];
        random_unit(state, i);
        random_unit(state, r);
        set_lane(light, k, i, r);
    }
    brdf_light_finish(light);
}

enum { N_FACETS = 24 };

/* A set of facets with arrays of its own. */
typedef struct facet_set {
    double normal[3][N_FACETS], tangent[3][N_FACETS], bitangent[3][N_FACETS], area[N_FACETS];
} facet_set;

static inline void set_facet(facet_set *set, int f, const double normal[3], const double tangent[3],
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

static inline brdf_facets facets_of(const facet_set *set)
{
    return (brdf_facets){.n = N_FACETS,
                         .normal = {set->normal[0], set->normal[1], set->normal[2]},
                         .tangent = {set->tangent[0], set->tangent[1], set->tangent[2]},
                         .bitangent = {set->bitangent[0], set->bitangent[1], set->bitangent[2]},
                         .area = set->area};
}

static inline void random_facets(facet_set *set, uint64_t *state)
{
    for (int f = 0; f < N_FACETS; f++) {
        double normal[3], tangent[3], other[3];
        random_unit(state, normal);
        random_unit(state, other);
        perp3(other, normal, tangent);
        set_facet(set, f, normal, tangent, 0.1 + next_random(state));
    }
}

#endif
