/* fit.c: nonlinear least squares from many starting points, and what came of it. */
#include "brdf/fit.h"

#include "brdf/fit_parts.h"

#include <cminpack.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    N_STARTS = 48, /* random starts, and as many again for every two shapes past the first */
    MAX_STARTS = 192,
    N_FINALISTS = 6,        /* the best of them, which are carried to their minimum */
    SCREEN_POINTS = 400,    /* points that starts are judged by, */
    FINALIST_POINTS = 2000, /* and finalists; the winner sees all */
    SCREEN_STEPS = 25,      /* steps of the minimiser (each with its derivatives) */
    FINALIST_STEPS = 300,
    LAST_STEPS = 300
};

/* Where a start led to. */
typedef struct candidate {
    double u[FIT_MAX_PARAMS];
    double squares; /* sum of the squared residuals */
} candidate;

/* ---------------------------------------------------------------- minimiser */

/* Room for the minimiser: one block, owned. */
typedef struct room {
    double *all, *residuals, *jacobian, *spare, *vectors;
} room;

static glint_status room_make(const fit_problem *p, room *out, glint_error *error)
{
    const size_t m = (size_t)p->n_points, n = (size_t)p->n_variables;
    *out = (room){0};
    out->all = malloc((m * (n + 3) + 5 * n) * sizeof *out->all);
    if (!out->all) return error_no_memory(error);
    out->residuals = out->all;
    out->jacobian = out->residuals + m; /* n columns; a start takes two more */
    out->spare = out->jacobian + m * n;
    out->vectors = out->spare + 2 * m;
    return GLINT_OK;
}

/* cminpack's way of asking for residuals (what = 1) and derivatives (2). */
static int evaluate(void *context, int m, int n, const double *u, double *residuals,
                    double *jacobian, int stride, int what)
{
    fit_problem *p = context;
    (void)m, (void)n, (void)stride;
    if (what == 1) {
        fit_set(p, u);
        fit_residuals(p, residuals);
    } else if (what == 2) {
        fit_jacobian(p, u, residuals, jacobian);
    }
    return 0;
}

/* Sum of squares at the parameters that the problem holds now. */
static double squares_here(fit_problem *p, double *residuals)
{
    double sum = 0.0;
    fit_residuals(p, residuals);
    for (int k = 0; k < p->n_points; k++)
        sum += residuals[k] * residuals[k];
    return sum;
}

static double squares_at(fit_problem *p, const double *u, double *residuals)
{
    fit_set(p, u);
    return squares_here(p, residuals);
}

/* Goes downhill from c->u: Levenberg-Marquardt as in MINPACK (More 1978). */
static void minimise(fit_problem *p, int steps, const room *w, candidate *c)
{
    const double factor = 10.0; /* length of the first step; u is of the order of 10 */
    /* relative changes of the sum and of u at which it stops: rounding, and far below any error */
    const double sum_tolerance = 1e-15, u_tolerance = 1e-12;
    const int m = p->n_points, n = p->n_variables;
    int pivots[FIT_MAX_PARAMS], n_residuals, n_jacobians;
    double *diag = w->vectors, *qtf = diag + n, *w1 = qtf + n, *w2 = w1 + n, *w3 = w2 + n;
    double u[FIT_MAX_PARAMS];
    memcpy(u, c->u, sizeof u);
    lmder(evaluate, p, m, n, u, w->residuals, w->jacobian, m, sum_tolerance, u_tolerance, 0.0,
          steps, diag, 1, factor, 0, &n_residuals, &n_jacobians, pivots, qtf, w1, w2, w3, w->spare);
    const double squares = squares_at(p, u, w->residuals);
    if (!(squares < c->squares)) return;
    c->squares = squares;
    memcpy(c->u, u, sizeof u);
}

/* ------------------------------------------------------------------- starts */

static int count_starts(const fit_problem *p)
{
    int shapes = 0;
    for (int j = 0; j < p->n_variables; j++)
        shapes += !p->variables[j].linear;
    const int n = N_STARTS * (1 + shapes / 2);
    return n < MAX_STARTS ? n : MAX_STARTS;
}

/* Puts c among the best, which are in order; *n: how many there are. */
static void keep_best(candidate *best, int *n, const candidate *c)
{
    if (*n == N_FINALISTS && !(c->squares < best[*n - 1].squares)) return;
    int at = *n < N_FINALISTS ? (*n)++ : *n - 1;
    for (; at > 0 && c->squares < best[at - 1].squares; at--)
        best[at] = best[at - 1];
    best[at] = *c;
}

/* Tries all starts with few steps on few points. */
static glint_status screen(const fit_problem *whole, candidate *best, int *n, glint_error *error)
{
    fit_problem p;
    room w;
    uint64_t state = 1; /* any number: the same starts every time */
    *n = 0;
    glint_status status = fit_problem_thin(whole, SCREEN_POINTS, &p, error);
    if (status) return status;
    status = room_make(&p, &w, error);
    if (!status) {
        const int n_starts = count_starts(&p);
        for (int k = 0; k < n_starts; k++) {
            candidate c = {.squares = INFINITY};
            fit_start(&p, &state, c.u, w.jacobian);
            minimise(&p, SCREEN_STEPS, &w, &c);
            keep_best(best, n, &c);
        }
        free(w.all);
    }
    fit_problem_free(&p);
    return status;
}

/* Carries n candidates to their minimum on at most `most` points, and puts the best of them
 * first. */
static glint_status descend(const fit_problem *whole, int most, int steps, candidate *c, int n,
                            glint_error *error)
{
    fit_problem p;
    room w;
    glint_status status = fit_problem_thin(whole, most, &p, error);
    if (status) return status;
    status = room_make(&p, &w, error);
    if (!status) {
        for (int k = 0; k < n; k++) {
            c[k].squares = squares_at(&p, c[k].u, w.residuals);
            minimise(&p, steps, &w, &c[k]);
            if (c[k].squares < c[0].squares) c[0] = c[k];
        }
        free(w.all);
    }
    fit_problem_free(&p);
    return status;
}

static glint_status search(const fit_problem *p, candidate *out, glint_error *error)
{
    candidate best[N_FINALISTS];
    int n;
    glint_status status = screen(p, best, &n, error);
    if (!status) status = descend(p, FINALIST_POINTS, FINALIST_STEPS, best, n, error);
    if (!status) status = descend(p, p->n_points, LAST_STEPS, best, 1, error);
    if (!status) *out = best[0];
    return status;
}

/* ------------------------------------------------------------------- result */

/* What is known of a variable at the minimum. */
typedef struct estimate {
    double value, standard_error;
    double resolution; /* a change that the measurements notice, were all others known */
    fit_state state;
} estimate;

/* The variable of a lobe that says how wide or steep it is: the first that is no strength; -1 where
 * there is none. *first, *n: the lobe's variables. */
static int shape_of(const fit_problem *p, int lobe, int *first, int *n)
{
    int shape = -1;
    *first = *n = 0;
    for (int j = p->n_variables - 1; j >= 0; j--) {
        if (p->variables[j].lobe != lobe) continue;
        *first = j;
        (*n)++;
        if (!p->variables[j].linear) shape = j;
    }
    return shape;
}

/* Puts lobes of one model, which may change places, in the order of that variable. */
static void sort_lobes(const fit_problem *p, double *u)
{
    for (int k = 1; k < p->n_lobes; k++) {
        for (int j = k; j > 0 && p->lobes[j].model == p->lobes[j - 1].model; j--) {
            int a, b, n_a, n_b;
            const int shape_a = shape_of(p, j - 1, &a, &n_a), shape_b = shape_of(p, j, &b, &n_b);
            if (n_a != n_b || shape_a < 0 || u[shape_a] <= u[shape_b]) break;
            for (int i = 0; i < n_a; i++) {
                const double kept = u[a + i];
                u[a + i] = u[b + i];
                u[b + i] = kept;
            }
        }
    }
}

/* The end of its range that a variable has come to; NAN: none. */
static double end_near(const fit_variable *v, double value)
{
    const double near = 1e-6; /* of the range */
    const param_info *p = v->info;
    const double width = p->max - p->min;
    /* where a range spans many powers of ten, above 0, its low end is near in the logarithm only */
    const double low = p->min > 0.0 ? p->min * (1.0 + near) : p->min + near * width;
    const double high = p->max - near * width;
    const double end = value <= low ? p->min : p->max;
    return (value <= low || value >= high) && param_accepts(p, end) ? end : PARAM_NONE;
}

/* Moves variables that have come to an end of their range right there, where that makes the fit no
 * worse than its own convergence leaves it. */
static void snap_to_ends(fit_problem *p, const candidate *c, double *residuals, estimate *e)
{
    const double rounding = 1e-12; /* of a residual */
    const double enough = c->squares * (1.0 + 1e-8) + p->n_points * rounding * rounding;
    fit_set(p, c->u);
    for (int j = 0; j < p->n_variables; j++) {
        const fit_variable *v = &p->variables[j];
        e[j] = (estimate){.value = fit_value(v, c->u[j])};
        const double end = end_near(v, e[j].value);
        if (isnan(end)) continue;
        fit_put(p, v, end);
        if (squares_here(p, residuals) <= enough) {
            e[j].value = end;
            e[j].state = FIT_AT_BOUND;
        } else {
            fit_put(p, v, e[j].value);
        }
    }
}

/* Standard errors of the variables that are not at an end. */
static glint_status find_errors(fit_problem *p, const candidate *c, const room *w, estimate *e,
                                glint_error *error)
{
    const int m = p->n_points;
    fit_spread spreads[FIT_MAX_PARAMS];
    int at[FIT_MAX_PARAMS], n = 0;
    fit_set(p, c->u);
    fit_residuals(p, w->residuals);
    fit_jacobian(p, c->u, w->residuals, w->jacobian);
    for (int j = 0; j < p->n_variables; j++) {
        if (e[j].state == FIT_AT_BOUND) continue;
        memmove(w->jacobian + (size_t)n * (size_t)m, w->jacobian + (size_t)j * (size_t)m,
                (size_t)m * sizeof *w->jacobian);
        at[n++] = j;
    }
    const double variance = c->squares / (m - p->n_variables);
    const glint_status status = fit_spreads(w->jacobian, m, n, variance, spreads, error);
    for (int k = 0; k < n && !status; k++) {
        estimate *out = &e[at[k]];
        const double slope = fit_slope(&p->variables[at[k]], c->u[at[k]]);
        out->resolution = slope > 0.0 ? spreads[k].conditional * slope : (double)INFINITY;
        if (spreads[k].undetermined)
            out->state = FIT_UNDETERMINED;
        else
            out->standard_error = spreads[k].marginal * slope;
    }
    return status;
}

/* The value with as many digits as its resolution warrants, of which rounding loses a hundredth at
 * most. */
static double round_value(const param_info *p, double value, double resolution)
{
    enum { FEWEST = 4, MOST = 12, EXACT = 17 };
    const double wanted = ceil(log10(fabs(value) / resolution)) + 2.0;
    int digits = wanted < FEWEST ? FEWEST : wanted < MOST ? (int)wanted : MOST;
    for (; digits < EXACT; digits++) { /* more where rounding leaves the range */
        char shown[NUMBER_SIZE];
        snprintf(shown, sizeof shown, "%.*e", digits - 1, value);
        const double rounded = strtod(shown, NULL);
        if (param_accepts(p, rounded)) return rounded;
    }
    return value;
}

static void fill_params(fit_problem *p, const estimate *e, fit_result *out)
{
    for (int j = 0; j < p->n_variables; j++) {
        const fit_variable *v = &p->variables[j];
        fit_put(p, v,
                e[j].state == FIT_AT_BOUND ? e[j].value
                                           : round_value(v->info, e[j].value, e[j].resolution));
        for (int k = 0; k < out->n_params; k++) {
            fit_param *param = &out->params[k];
            if (param->lobe != v->lobe || param->index != v->index) continue;
            param->standard_error = e[j].standard_error;
            param->state = e[j].state;
        }
    }
    for (int k = 0; k < out->n_params; k++)
        out->params[k].value = p->lobes[out->params[k].lobe].params[out->params[k].index];
}

static glint_status fill_material(const fit_problem *p, brdf_material *out, glint_error *error)
{
    out->lobes = calloc((size_t)p->n_lobes, sizeof *out->lobes);
    if (!out->lobes) return error_no_memory(error);
    out->n_lobes = p->n_lobes;
    for (int k = 0; k < p->n_lobes; k++) {
        brdf_lobe *lobe = &out->lobes[k];
        *lobe = p->lobes[k];
        const glint_status status = lobe->model->prepare(lobe->params, lobe->coef, error);
        if (status) return status;
    }
    return GLINT_OK;
}

/* -2 ln L of normal errors with their variance fitted, but for a constant, and the price of the
 * parameters, of which that variance is one. */
static void fill_criteria(fit_result *r)
{
    const double least = 1e-15; /* dex: rounding; keeps the logarithm finite */
    const double misfit = 2.0 * r->n_points * log(fmax(r->rms_dex, least));
    r->aic = misfit + 2.0 * (r->n_free + 1);
    r->bic = misfit + log(r->n_points) * (r->n_free + 1);
}

static glint_status conclude(fit_problem *p, candidate *c, fit_result *out, glint_error *error)
{
    room w;
    estimate e[FIT_MAX_PARAMS];
    glint_status status = room_make(p, &w, error);
    if (status) return status;
    sort_lobes(p, c->u);
    snap_to_ends(p, c, w.residuals, e);
    status = find_errors(p, c, &w, e, error);
    free(w.all);
    if (status) return status;
    fill_params(p, e, out);
    return fill_material(p, &out->material, error);
}

glint_status fit_run(const fit_form *form, const measured_point *points, int n,
                     const fit_options *options, fit_result *out, glint_error *error)
{
    fit_problem p;
    candidate best;
    *out = (fit_result){.form = *form};
    glint_status status =
        fit_problem_make(form, points, n, options, &p, out->params, &out->n_params, error);
    if (status) {
        fit_result_free(out);
        return status;
    }
    out->n_points = p.n_points;
    out->n_free = p.n_variables;
    status = search(&p, &best, error);
    if (!status) status = conclude(&p, &best, out, error);
    fit_problem_free(&p);
    if (status) {
        fit_result_free(out);
        return status;
    }
    out->rms_dex = fit_rms_dex(&out->material, points, n, options);
    fill_criteria(out);
    return GLINT_OK;
}

void fit_result_free(fit_result *result)
{
    if (!result) return;
    brdf_material_free(&result->material);
    *result = (fit_result){0};
}

double fit_model_f(const brdf_material *material, const measured_point *point)
{
    return brdf_material_eval(material, point->i, point->r) / (point->i[2] * point->r[2]);
}

double fit_rms_dex(const brdf_material *material, const measured_point *points, int n,
                   const fit_options *options)
{
    double sum = 0.0;
    int used = 0;
    for (int k = 0; k < n; k++) {
        if (!fit_uses(&points[k], options)) continue;
        const double f = fmin(fmax(fit_model_f(material, &points[k]), DBL_MIN), DBL_MAX);
        const double dex = log10(f) - log10(points[k].f);
        sum += dex * dex;
        used++;
    }
    return used > 0 ? sqrt(sum / used) : 0.0;
}
