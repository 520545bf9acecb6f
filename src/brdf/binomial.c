/* binomial.c: Greynolds's generalised scatter model, a fit to measured lobes of any shape. */
#include "base/constants.h"
#include "brdf/fastmath.h"
#include "brdf/lane.h"
#include "brdf/models.h"

#include <stdlib.h>

enum { B, C, D, L1 };
enum { MAX_ROWS = 16, MAX_COLUMNS = 64 };

static const param_info params[] = {
    {"B", "", "coefficients of the powers of D: a row for each power of V", -1e4, 1e4,
     PARAM_REQUIRED, PARAM_ROWS},
    {"C", "", "coefficients of the logarithms, as many rows as B", -1e4, 1e4, PARAM_REQUIRED,
     PARAM_ROWS},
    {"d", "", "ratio of the widths of neighbouring logarithms", 1e-3, 100, PARAM_REQUIRED, 0},
    {"l1", "", "exponent of d in the first logarithm", -20, 20, PARAM_REQUIRED, 0},
};

/* The lobe's numbers: the shape, then for each column of C the scale d^(i+l1), then the rows of
 * ln 10 B, then those of C/2, so that their sum is ln f. */
enum { N_ROWS, N_B, N_C, HEADER };

static glint_status check_shape(const brdf_array *b, const brdf_array *c, glint_error *error)
{
    if (b->rows != c->rows)
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "B has %d rows and C has %d; expected as many", b->rows, c->rows);
    if (b->rows > MAX_ROWS || b->columns > MAX_COLUMNS || c->columns > MAX_COLUMNS)
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "B and C have %d rows of %d and %d numbers; expected at most %d rows of "
                         "%d",
                         b->rows, b->columns, c->columns, MAX_ROWS, MAX_COLUMNS);
    return GLINT_OK;
}

static glint_status prepare_lobe(brdf_lobe *lobe, glint_error *error)
{
    const brdf_array *b = &lobe->arrays[B], *c = &lobe->arrays[C];
    const glint_status status = check_shape(b, c, error);
    if (status) return status;
    const size_t n_b = (size_t)(b->rows * b->columns), n_c = (size_t)(c->rows * c->columns);
    lobe->n_numbers = HEADER + (size_t)c->columns + n_b + n_c;
    free(lobe->numbers);
    lobe->numbers = malloc(lobe->n_numbers * sizeof *lobe->numbers);
    if (!lobe->numbers) {
        lobe->n_numbers = 0;
        return error_no_memory(error);
    }
    double *out = lobe->numbers;
    out[N_ROWS] = b->rows;
    out[N_B] = b->columns;
    out[N_C] = c->columns;
    out += HEADER;
    for (int i = 0; i < c->columns; i++)
        *out++ = pow(lobe->params[D], i + lobe->params[L1]);
    for (size_t k = 0; k < n_b; k++)
        *out++ = log(10.0) * b->values[k];
    for (size_t k = 0; k < n_c; k++)
        *out++ = 0.5 * c->values[k];
    return GLINT_OK;
}

/* log10 f = sum_k V^k (sum_i B[k][i] D^i + 1/2 sum_i C[k][i] log10(1 + d^(i+l1) D^2)), D = |rho -
 * rho0|, V = rho . rho0, where rho and rho0 are the tangential parts of r and of i's mirror image:
 * D is the tangential part of H, and V = -(i_t r_t + i_b r_b). */
static inline double binomial_lane(const double *coef, const brdf_lane *l)
{
    static const double highest = 690.0; /* ln 1e300: nonsense far away, but still a number */
    const int rows = (int)coef[N_ROWS], n_b = (int)coef[N_B], n_c = (int)coef[N_C];
    const double *scale = coef + HEADER, *b = scale + n_c, *c = b + rows * n_b;
    const double d2 = l->ht * l->ht + l->hb * l->hb, d = sqrt(d2);
    const double v = -(l->it * l->rt + l->ib * l->rb);
    double logs[MAX_COLUMNS], total = 0.0;
    for (int i = 0; i < n_c; i++)
        logs[i] = fast_log_1m(1.0 + scale[i] * d2, -scale[i] * d2);
    for (int k = rows - 1; k >= 0; k--) {
        double polynomial = 0.0, sum = 0.0;
        for (int i = n_b - 1; i >= 0; i--)
            polynomial = polynomial * d + b[k * n_b + i];
        for (int i = 0; i < n_c; i++)
            sum += c[k * n_c + i] * logs[i];
        total = total * v + (polynomial + sum);
    }
    return fast_exp(total < highest ? total : highest) * (l->ci * l->cr);
}

#define BRDF_LANE binomial_lane
#define BRDF_LONG_COEF
#include "brdf/tile.h"

const brdf_model brdf_binomial = {
    .name = "binomial",
    .doc = "Greynolds's generalised scatter, log10 f as a sum of powers and logarithms of the "
           "distance from the mirror direction in direction cosines; for laboratory fits",
    .source = "Greynolds 2015, Proc. SPIE 9577, 95770A; used for satellites by Fankhauser, Tyson "
              "and Askari 2023, Astronomical Journal 166, 59",
    .params = params,
    .n_params = sizeof params / sizeof params[0],
    .flags = BRDF_ISOTROPIC,
    .prepare = brdf_prepare_without_arrays,
    .prepare_lobe = prepare_lobe,
    .eval = brdf_eval,
    .tile = brdf_tile,
};
