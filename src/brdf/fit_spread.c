/* fit_spread.c: how well the measurements tell the parameters of a fit. */
#include "brdf/fit_parts.h"

#include <math.h>
#include <stdlib.h>

/* A variable is undetermined where
 * - a change of u by 1, a factor of e for most, changes ln f by less than this, rms; */
#define NO_EFFECT 1e-6
/* - its variance is this many times what it would be if all others were known; */
#define MOST_INFLATION 1e10
/* - or its standard error is a factor of 150. */
#define MOST_ERROR 5.0
/* What is added to the diagonal of the correlations, above their rounding: exact degeneracies then
 * give a variance that is huge, and finite. */
#define RIDGE 1e-13

/* Divides every column by its length, and returns the lengths. */
static void scale_columns(double *jacobian, int m, int n, double *length)
{
    for (int j = 0; j < n; j++) {
        double *column = jacobian + (size_t)j * (size_t)m, sum = 0.0;
        for (int k = 0; k < m; k++)
            sum += column[k] * column[k];
        length[j] = sqrt(sum);
        for (int k = 0; k < m; k++)
            column[k] = length[j] > 0.0 ? column[k] / length[j] : 0.0;
    }
}

/* Lower Cholesky factor of the correlations J^T J + ridge; they are at least the ridge. */
static void factor(const double *jacobian, int m, int n, double *l)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            const double *a = jacobian + (size_t)i * (size_t)m,
                         *b = jacobian + (size_t)j * (size_t)m;
            double sum = i == j ? RIDGE : 0.0;
            for (int k = 0; k < m; k++)
                sum += a[k] * b[k];
            for (int k = 0; k < j; k++)
                sum -= l[i * n + k] * l[j * n + k];
            l[i * n + j] = i == j ? sqrt(fmax(sum, RIDGE)) : sum / l[j * n + j];
        }
}

/* Diagonal element c of (l l^T)^-1: the square of column c of l^-1. work: n numbers. */
static double inverse_diagonal(const double *l, int n, int c, double *work)
{
    double total = 0.0;
    for (int i = c; i < n; i++) {
        double sum = i == c ? 1.0 : 0.0;
        for (int k = c; k < i; k++)
            sum -= l[i * n + k] * work[k];
        work[i] = sum / l[i * n + i];
        total += work[i] * work[i];
    }
    return total;
}

glint_status fit_spreads(double *jacobian, int m, int n, double variance, fit_spread *out,
                         glint_error *error)
{
    if (n == 0) return GLINT_OK;
    const size_t size = (size_t)n;
    double *work = malloc((size * size + 2 * size) * sizeof *work);
    if (!work) return error_no_memory(error);
    double *length = work, *column = work + size, *l = work + 2 * size;
    scale_columns(jacobian, m, n, length);
    factor(jacobian, m, n, l);
    for (int j = 0; j < n; j++) {
        const double inflation = inverse_diagonal(l, n, j, column);
        out[j] = (fit_spread){INFINITY, INFINITY, .undetermined = true};
        if (!(length[j] > NO_EFFECT * sqrt(m))) continue;
        out[j].conditional = sqrt(variance) / length[j];
        out[j].marginal = out[j].conditional * sqrt(inflation);
        out[j].undetermined = inflation > MOST_INFLATION || out[j].marginal > MOST_ERROR;
    }
    free(work);
    return GLINT_OK;
}
