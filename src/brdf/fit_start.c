/* fit_start.c: points to start a fit from.
 *
 * A sum of squares in ln f has many local minima, above all where lobes are too narrow to reach a
 * measurement. So fits start from many places: shapes (slopes, exponents) are drawn at random, and
 * the strengths, on which f depends linearly, are then fitted to them, as in the variable
 * projection of Golub and Pereyra 1973, SIAM Journal on Numerical Analysis 10, 413. */
#include "brdf/fit_parts.h"

#include <math.h>

/* Uniform in 0..1, the same sequence on every machine (Knuth's MMIX generator). */
static double next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* A value where surfaces have it, judged by the shape of the range alone: by magnitude where the
 * range spans many, leaving out the least of them; more often small where it begins at 0, and more
 * often near the middle where it does not. */
static double draw_value(const param_info *p, double chance)
{
    const double width = p->max - p->min, middle = 0.5 * (p->min + p->max);
    if (!isfinite(width)) return pow(10.0, 4.0 * chance - 2.0);
    if (p->min > 0.0 && p->max > 1e3 * p->min)
        return p->min * pow(p->max / p->min, 0.35 + 0.6 * chance);
    if (p->min == 0.0 && width > 50.0) return pow(width, 0.1 + 0.8 * chance);
    if (p->min == 0.0) return width * (0.01 + 0.97 * chance * chance);
    return middle + 0.49 * width * pow(2.0 * chance - 1.0, 3.0);
}

/* f / f_measured of a lobe at every point. */
static void relative_values(fit_problem *problem, int lobe, double *out)
{
    fit_lobe_values(problem, lobe, out);
    for (int k = 0; k < problem->n_points; k++)
        out[k] *= exp(-problem->points[k].log_f);
}

/* Writes what the strongest value of each linear variable adds to f / f_measured into its column,
 * and what is missing to 1 with all of them at 0 into the column behind the last. The one after
 * that is for passing use. */
static void linear_columns(fit_problem *problem, double *work)
{
    const size_t m = (size_t)problem->n_points;
    double *rest = work + (size_t)problem->n_variables * m, *zero = rest + m;
    for (int j = 0; j < problem->n_variables; j++)
        if (problem->variables[j].linear) fit_put(problem, &problem->variables[j], 0.0);
    for (size_t k = 0; k < m; k++)
        rest[k] = 1.0;
    for (int lobe = 0; lobe < problem->n_lobes; lobe++) {
        relative_values(problem, lobe, zero);
        for (size_t k = 0; k < m; k++)
            rest[k] -= zero[k];
        for (int j = 0; j < problem->n_variables; j++) {
            const fit_variable *v = &problem->variables[j];
            if (!v->linear || v->lobe != lobe) continue;
            double *column = work + (size_t)j * m;
            fit_put(problem, v, v->info->max);
            relative_values(problem, lobe, column);
            fit_put(problem, v, 0.0);
            for (size_t k = 0; k < m; k++)
                column[k] -= zero[k];
        }
    }
}

static double column_dot(const double *a, const double *b, int m)
{
    double sum = 0.0;
    for (int k = 0; k < m; k++)
        sum += a[k] * b[k];
    return sum;
}

/* Least squares for the linear variables as parts x of their maximum, 0 <= x <= 0.9, one after
 * another until they hold still (Gauss-Seidel with projection). None is left at 0, where the
 * coordinate u has no derivative. */
static void linear_solve(const fit_problem *problem, const double *work, double *x)
{
    const int n = problem->n_variables, m = problem->n_points;
    double normal[FIT_MAX_PARAMS][FIT_MAX_PARAMS + 1];
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= n; j++)
            normal[i][j] =
                problem->variables[i].linear && (j == n || problem->variables[j].linear)
                    ? column_dot(work + (size_t)i * (size_t)m, work + (size_t)j * (size_t)m, m)
                    : 0.0;
    for (int i = 0; i < n; i++)
        x[i] = 0.0;
    for (int sweep = 0; sweep < 50; sweep++) {
        for (int i = 0; i < n; i++) {
            double rest = normal[i][n];
            for (int j = 0; j < n; j++)
                if (j != i) rest -= normal[i][j] * x[j];
            x[i] = normal[i][i] > 0.0 ? fmin(fmax(rest / normal[i][i], 0.0), 0.9) : 0.0;
        }
    }
    for (int i = 0; i < n; i++) {
        const double alone = normal[i][i] > 0.0 ? normal[i][n] / normal[i][i] : 0.0;
        x[i] = fmax(x[i], fmin(fmax(0.01 * alone, 1e-9), 0.1));
    }
}

void fit_start(fit_problem *problem, uint64_t *state, double *u, double *work)
{
    double x[FIT_MAX_PARAMS];
    for (int j = 0; j < problem->n_variables; j++) {
        const fit_variable *v = &problem->variables[j];
        if (v->linear) continue;
        const double value = draw_value(v->info, next_random(state));
        fit_put(problem, v, value);
        u[j] = fit_coordinate(v, value);
    }
    linear_columns(problem, work);
    linear_solve(problem, work, x);
    for (int j = 0; j < problem->n_variables; j++)
        if (problem->variables[j].linear)
            u[j] = fit_coordinate(&problem->variables[j], x[j] * problem->variables[j].info->max);
}
