/* fit_parts.h: what the files that make up a fit share. */
#ifndef GLINT_BRDF_FIT_PARTS_H
#define GLINT_BRDF_FIT_PARTS_H

#include "brdf/fit.h"

#include <stdint.h>

/* A parameter that is fitted. Its coordinate u has no limits:
 * value = min + (max - min) / (1 + e^-u). Where a range begins at 0, which is where most do, u is
 * the logarithm of the value as long as that is far below the maximum. */
typedef struct fit_variable {
    int lobe, index;
    int tied;    /* another parameter of the lobe that has the same value; -1: none */
    bool linear; /* f is a + b value, and the range begins at 0: a strength */
    const param_info *info;
} fit_variable;

/* A measurement as the sums need it. */
typedef struct fit_point {
    double i[3], r[3];
    double inverse; /* 1/(ci cr) */
    double log_f;   /* ln(f + floor) */
} fit_point;

/* Parameters and points of one fit, and room to work in. */
typedef struct fit_problem {
    brdf_lobe lobes[FIT_MAX_LOBES]; /* parameters of the last evaluation */
    int n_lobes;
    fit_variable variables[FIT_MAX_PARAMS];
    int n_variables;
    fit_point *points; /* owned */
    int n_points;
    /* 1/sr, added to f before the logarithm, far below every measurement: where a narrow lobe
     * vanishes the residual stays a number. */
    double floor;
} fit_problem;

/* Sets up everything; params: the list of the result with its states, values of the fixed ones.
 * Errors as fit_run. */
glint_status fit_problem_make(const fit_form *form, const measured_point *points, int n,
                              const fit_options *options, fit_problem *out, fit_param *params,
                              int *n_params, glint_error *error);
void fit_problem_free(fit_problem *problem);
/* A copy with `most` points at most, evenly taken. Errors: GLINT_INTERNAL. */
glint_status fit_problem_thin(const fit_problem *problem, int most, fit_problem *out,
                              glint_error *error);

/* Value of a variable at u, u of a value, and d value / du. */
double fit_value(const fit_variable *v, double u);
double fit_coordinate(const fit_variable *v, double value);
double fit_slope(const fit_variable *v, double u);

/* Puts a value into the lobe's parameters (and into the tied one). The lobe is not prepared. */
void fit_put(fit_problem *problem, const fit_variable *v, double value);
/* Prepares the lobe and writes its f at every point, 1/sr. Where the model refuses the parameters,
 * f is 0. */
void fit_lobe_values(fit_problem *problem, int lobe, double *f);

/* Sets all variables to the coordinates u. */
void fit_set(fit_problem *problem, const double *u);
/* Residuals ln f_model - ln f_measured at the parameters that are set; prepares the lobes, of which
 * one whose model refuses its parameters counts as 0. */
void fit_residuals(fit_problem *problem, double *residuals);
/* Their derivatives at u, given the residuals there: n_variables columns of n_points. Sets u. */
void fit_jacobian(fit_problem *problem, const double *u, const double *residuals, double *jacobian);

/* Random coordinates to start from: shapes drawn from the ranges, strengths fitted to them.
 * *state: of the generator. work: n_points * (n_variables + 2) numbers. */
void fit_start(fit_problem *problem, uint64_t *state, double *u, double *work);

/* What the measurements say of one variable; the errors are infinite where they say nothing. */
typedef struct fit_spread {
    double marginal;    /* standard error of u, whatever the others are */
    double conditional; /* standard error of u if all others were known */
    bool undetermined;
} fit_spread;

/* From the Jacobian at the solution (its columns are scaled in place) and the variance of a
 * residual; n columns of m. Errors: GLINT_INTERNAL. */
glint_status fit_spreads(double *jacobian, int m, int n, double variance, fit_spread *out,
                         glint_error *error);

#endif
