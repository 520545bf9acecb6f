/* fit_problem.c: which parameters are fitted, and the residuals as a function of them. */
#include "brdf/fit_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Stands for an end that a range does not have. */
#define NO_END 1e12
/* Past these, 1/(1 + e^-u) is 0 and 1 to the last digit that matters. */
#define LOWEST_U (-60.0)
#define HIGHEST_U 36.0

/* ---------------------------------------------------------------- variables */

static double low_end(const param_info *p)
{
    return isfinite(p->min) ? p->min : -NO_END;
}

static double high_end(const param_info *p)
{
    return isfinite(p->max) ? p->max : NO_END;
}

/* e^-|u| / (1 + e^-|u|): the part of the range between the value and its nearer end. */
static double tail(double u)
{
    const double e = exp(-fabs(u));
    return e / (1.0 + e);
}

double fit_value(const fit_variable *v, double u)
{
    const double low = low_end(v->info), high = high_end(v->info);
    u = fmin(fmax(u, LOWEST_U), HIGHEST_U);
    const double value = u < 0.0 ? low + (high - low) * tail(u) : high - (high - low) * tail(u);
    /* the ends themselves are not reached, since some do not belong to their range */
    return fmin(fmax(value, nextafter(low, high)), nextafter(high, low));
}

double fit_coordinate(const fit_variable *v, double value)
{
    const double low = low_end(v->info), high = high_end(v->info);
    return fmin(fmax(log((value - low) / (high - value)), LOWEST_U), HIGHEST_U);
}

double fit_slope(const fit_variable *v, double u)
{
    if (u <= LOWEST_U || u >= HIGHEST_U) return 0.0;
    const double part = tail(u);
    return (high_end(v->info) - low_end(v->info)) * part * (1.0 - part);
}

/* The diffuse light that some models of lobes bring along, by the names that it goes under. */
static bool is_diffuse(const param_info *p)
{
    return string_equal(p->name, "rho_d") || string_equal(p->name, "R_d") ||
           string_equal(p->name, "k_d");
}

static bool has_diffuse(const brdf_model *model)
{
    for (int j = 0; j < model->n_params; j++)
        if (is_diffuse(&model->params[j])) return true;
    return false;
}

/* The parameter across the tangent, given the one along it: alpha_y of alpha_x, n_v of n_u; -1
 * where there is none. */
static int partner(const brdf_model *model, int along)
{
    const char *name = model->params[along].name;
    const size_t n = strlen(name);
    if (n < 2 || name[n - 2] != '_' || (name[n - 1] != 'x' && name[n - 1] != 'u')) return -1;
    for (int j = 0; j < model->n_params; j++) {
        const char *other = model->params[j].name;
        if (strlen(other) == n && memcmp(other, name, n - 1) == 0 &&
            other[n - 1] == name[n - 1] + 1)
            return j;
    }
    return -1;
}

/* Adds the parameters of one lobe. diffuse: its diffuse part is fitted. */
static void add_lobe(fit_problem *p, int lobe, bool diffuse, bool anisotropic, fit_param *params,
                     int *n_params)
{
    const brdf_model *model = p->lobes[lobe].model;
    bool tied[BRDF_MAX_PARAMS] = {false};
    for (int j = 0; j < model->n_params; j++) {
        const param_info *info = &model->params[j];
        p->lobes[lobe].params[j] = PARAM_NONE;
        if (info->flags & PARAM_OPTIONAL) continue;
        fit_param *out = &params[(*n_params)++];
        *out = (fit_param){.lobe = lobe, .index = j, .state = FIT_DETERMINED};
        if (isfinite(info->def)) {
            out->state = FIT_FIXED;
            p->lobes[lobe].params[j] = info->def;
            continue;
        }
        const int across = anisotropic ? -1 : partner(model, j);
        if (across >= 0) tied[across] = true;
        if (is_diffuse(info) && !diffuse) {
            out->state = FIT_FIXED;
            p->lobes[lobe].params[j] = 0.0;
        } else if (tied[j]) {
            out->state = FIT_TIED;
        } else {
            p->variables[p->n_variables++] =
                (fit_variable){.lobe = lobe, .index = j, .tied = across, .info = info};
        }
    }
}

/* Diffuse light is there once: two such terms cannot be told apart. It is that of a model that is
 * nothing else (lambert), or the diffuse part of the first lobe that has one. */
static void add_lobes(fit_problem *p, const fit_form *form, bool anisotropic, fit_param *params,
                      int *n_params)
{
    bool taken = false;
    for (int k = 0; k < form->n_lobes; k++)
        taken = taken || !has_diffuse(form->lobes[k]);
    p->n_lobes = form->n_lobes;
    for (int k = 0; k < form->n_lobes; k++) {
        p->lobes[k] = (brdf_lobe){.model = form->lobes[k], .weight = 1.0};
        add_lobe(p, k, !taken, anisotropic, params, n_params);
        taken = taken || has_diffuse(form->lobes[k]);
    }
}

/* ------------------------------------------------------------------- points */

bool fit_uses(const measured_point *point, const fit_options *options)
{
    /* A hair more than the limit, so that angles that were given in degrees are not lost to their
     * rounding. */
    const double hair = 1e-9; /* rad */
    const double cosine = fmin(point->i[2], point->r[2]);
    return point->f > 0.0 && isfinite(point->f) && cosine > BRDF_EDGE &&
           cosine >= cos(options->max_zenith_rad + hair);
}

static glint_status add_points(fit_problem *p, const measured_point *points, int n,
                               const fit_options *options, glint_error *error)
{
    double lowest = INFINITY;
    p->points = malloc((size_t)(n > 0 ? n : 1) * sizeof *p->points);
    if (!p->points) return error_no_memory(error);
    for (int k = 0; k < n; k++) {
        const measured_point *m = &points[k];
        if (!fit_uses(m, options)) continue;
        fit_point *out = &p->points[p->n_points++];
        memcpy(out->i, m->i, sizeof out->i);
        memcpy(out->r, m->r, sizeof out->r);
        out->inverse = 1.0 / (m->i[2] * m->r[2]);
        out->log_f = m->f;
        lowest = fmin(lowest, m->f);
    }
    p->floor = fmax(1e-9 * lowest, 1e-300);
    for (int k = 0; k < p->n_points; k++)
        p->points[k].log_f = log(p->points[k].log_f + p->floor);
    return GLINT_OK;
}

/* The second difference of g, relative to g, is rounding in that parameter at a few directions:
 * at v, 2 v and 3 v, all small, so that a lobe does not vanish off its peak. */
static bool is_straight(brdf_lobe *lobe, fit_problem *p, const fit_variable *variable, double v)
{
    static const double I[3] = {-0.6, 0.0, 0.8};
    static const double R[3][3] = {{0.6, 0.0, 0.8}, {0.48, 0.36, 0.8}, {0.0, 0.0, 1.0}};
    double g[3][3];
    for (int k = 0; k < 3; k++) {
        fit_put(p, variable, (k + 1) * v);
        if (lobe->model->prepare(lobe->params, lobe->coef, NULL)) return false;
        for (int j = 0; j < 3; j++)
            g[k][j] = lobe->model->eval(lobe->coef, I, R[j]);
    }
    for (int j = 0; j < 3; j++)
        if (!(fabs(g[0][j] - 2.0 * g[1][j] + g[2][j]) <= 1e-9 * (g[0][j] + g[2][j]))) return false;
    return true;
}

/* True when f is a + b v in that parameter, judged for two settings of the others. */
static bool is_linear(fit_problem *p, const fit_variable *v)
{
    if (v->info->min != 0.0 || !isfinite(v->info->max)) return false;
    for (int setting = 0; setting < 2; setting++) {
        for (int k = 0; k < p->n_variables; k++)
            if (p->variables[k].lobe == v->lobe)
                fit_put(p, &p->variables[k], fit_value(&p->variables[k], setting ? -1.0 : -3.0));
        for (double part = 1e-6; part < 0.3; part *= 300.0)
            if (!is_straight(&p->lobes[v->lobe], p, v, part * v->info->max)) return false;
    }
    return true;
}

glint_status fit_problem_make(const fit_form *form, const measured_point *points, int n,
                              const fit_options *options, fit_problem *out, fit_param *params,
                              int *n_params, glint_error *error)
{
    *out = (fit_problem){0};
    *n_params = 0;
    const glint_status status = add_points(out, points, n, options, error);
    if (status) return status;
    add_lobes(out, form, options->anisotropic, params, n_params);
    for (int k = 0; k < out->n_variables; k++)
        out->variables[k].linear = is_linear(out, &out->variables[k]);
    if (out->n_points > out->n_variables) return GLINT_OK;
    error_set(error, GLINT_INPUT, PLACE_NONE,
              "%d usable measurements cannot tell %d parameters; expected at least %d",
              out->n_points, out->n_variables, out->n_variables + 1);
    fit_problem_free(out);
    return GLINT_INPUT;
}

void fit_problem_free(fit_problem *problem)
{
    free(problem->points);
    *problem = (fit_problem){0};
}

glint_status fit_problem_thin(const fit_problem *problem, int most, fit_problem *out,
                              glint_error *error)
{
    const int n = problem->n_points < most ? problem->n_points : most;
    *out = *problem;
    out->points = malloc((size_t)n * sizeof *out->points);
    if (!out->points) {
        *out = (fit_problem){0};
        return error_no_memory(error);
    }
    out->n_points = n;
    for (int k = 0; k < n; k++)
        out->points[k] = problem->points[(int64_t)k * problem->n_points / n];
    return GLINT_OK;
}

/* ---------------------------------------------------------------- residuals */

void fit_put(fit_problem *problem, const fit_variable *v, double value)
{
    double *params = problem->lobes[v->lobe].params;
    params[v->index] = value;
    if (v->tied >= 0) params[v->tied] = value;
}

/* A number that can be added and whose logarithm can be taken. */
static double tame(double f)
{
    return f > 0.0 ? fmin(f, 1e300) : 0.0;
}

void fit_lobe_values(fit_problem *problem, int lobe, double *f)
{
    brdf_lobe *l = &problem->lobes[lobe];
    const bool good = l->model->prepare(l->params, l->coef, NULL) == GLINT_OK;
    for (int k = 0; k < problem->n_points; k++) {
        const fit_point *p = &problem->points[k];
        f[k] = good ? tame(l->model->eval(l->coef, p->i, p->r) * p->inverse) : 0.0;
    }
}

void fit_set(fit_problem *problem, const double *u)
{
    for (int k = 0; k < problem->n_variables; k++)
        fit_put(problem, &problem->variables[k], fit_value(&problem->variables[k], u[k]));
}

void fit_residuals(fit_problem *problem, double *residuals)
{
    bool good[FIT_MAX_LOBES];
    for (int j = 0; j < problem->n_lobes; j++) {
        brdf_lobe *lobe = &problem->lobes[j];
        good[j] = lobe->model->prepare(lobe->params, lobe->coef, NULL) == GLINT_OK;
    }
    for (int k = 0; k < problem->n_points; k++) {
        const fit_point *p = &problem->points[k];
        double f = problem->floor;
        for (int j = 0; j < problem->n_lobes; j++) {
            const brdf_lobe *lobe = &problem->lobes[j];
            if (good[j]) f += tame(lobe->model->eval(lobe->coef, p->i, p->r) * p->inverse);
        }
        residuals[k] = log(f) - p->log_f;
    }
}

/* Coefficients of the variable's lobe with the variable at u; false where the model refuses. */
static bool coef_at(fit_problem *problem, const fit_variable *v, double u,
                    double coef[BRDF_MAX_COEF])
{
    const brdf_lobe *lobe = &problem->lobes[v->lobe];
    fit_put(problem, v, fit_value(v, u));
    return lobe->model->prepare(lobe->params, coef, NULL) == GLINT_OK;
}

/* Central differences of the one lobe that a variable belongs to. In u every variable has the same
 * scale: a step of 1e-5 leaves about 1e-10 both of the third derivative and of the rounding. */
void fit_jacobian(fit_problem *problem, const double *u, const double *residuals, double *jacobian)
{
    const double step = 1e-5;
    fit_set(problem, u);
    for (int j = 0; j < problem->n_variables; j++) {
        const fit_variable *v = &problem->variables[j];
        const brdf_model *model = problem->lobes[v->lobe].model;
        double *column = jacobian + (size_t)j * (size_t)problem->n_points;
        double below[BRDF_MAX_COEF], above[BRDF_MAX_COEF];
        bool good = coef_at(problem, v, u[j] - step, below);
        good = coef_at(problem, v, u[j] + step, above) && good;
        fit_put(problem, v, fit_value(v, u[j]));
        for (int k = 0; k < problem->n_points; k++) {
            const fit_point *p = &problem->points[k];
            const double low = tame(model->eval(below, p->i, p->r) * p->inverse);
            const double high = tame(model->eval(above, p->i, p->r) * p->inverse);
            const double f = exp(residuals[k] + p->log_f); /* of the whole sum */
            column[k] = good ? (high - low) / (2.0 * step * f) : 0.0;
        }
    }
}
