/* fit.h: fits sums of BRDF models to measurements by least squares in the logarithm of f.
 *
 * Measurements of one surface span many powers of ten, and their errors are relative: the sum of
 * squares is that of ln f_model - ln f_measured, every measurement with the same weight. */
#ifndef GLINT_BRDF_FIT_H
#define GLINT_BRDF_FIT_H

#include "base/text.h"
#include "brdf/brdf.h"
#include "brdf/measured.h"

enum {
    FIT_MAX_LOBES = 8,  /* of one sum */
    FIT_MAX_PARAMS = 48 /* of all lobes of a sum */
};

/* What is fitted: a sum of models, each with the weight 1. */
typedef struct fit_form {
    int n_lobes;
    const brdf_model *lobes[FIT_MAX_LOBES];
} fit_form;

/* Whether a model can be a term of a sum: it has values everywhere, and single numbers as
 * parameters. */
bool fit_takes(const brdf_model *model);
/* Reads a sum of terms, each NAME or N*NAME, from the n bytes at s ("lambert+2*ward-gmd"; blanks
 * are skipped). Errors (GLINT_ARGUMENT): an empty term, a model that is unknown or cannot be
 * fitted, too many lobes or parameters, and a model whose one parameter is its strength twice. */
glint_status fit_form_read(const char *s, size_t n, fit_form *out, glint_error *error);
/* Appends the sum as fit_form_read takes it. */
void fit_form_write(const fit_form *form, text *out);

typedef struct fit_options {
    /* rad; measurements with a larger zenith angle of the source or of the observer are left out.
     * Those at exactly pi/2 are always: no model has a value there. */
    double max_zenith_rad;
    bool anisotropic; /* fit both of alpha_x and alpha_y, n_u and n_v; else they are equal */
} fit_options;

typedef enum fit_state {
    FIT_DETERMINED,   /* fitted */
    FIT_AT_BOUND,     /* fitted: the end of the range fits best; no standard error */
    FIT_UNDETERMINED, /* fitted, but the measurements do not tell it, alone or apart from others */
    FIT_TIED,         /* equal to another: alpha_y to alpha_x */
    FIT_FIXED         /* not fitted: 0, the diffuse part of a lobe beside another diffuse part; or
                         the default, where a parameter has one */
} fit_state;

/* One parameter of the fitted sum. */
typedef struct fit_param {
    int lobe, index;              /* parameter form.lobes[lobe]->params[index] */
    double value, standard_error; /* in its unit; the error only where FIT_DETERMINED, else 0 */
    fit_state state;
} fit_param;

/* A fit. The material holds the parameters as they are written: rounded where no digit more would
 * say anything. */
typedef struct fit_result {
    fit_form form;
    brdf_material material; /* owned */
    fit_param params[FIT_MAX_PARAMS];
    int n_params, n_free, n_points;
    double rms_dex;  /* of the material as it stands here */
    double aic, bic; /* of Akaike and of Schwarz, but for a constant that all fits to the same
                        points share; they take the errors for independent */
} fit_result;

/* Fits `form` to those of the n points that are usable. Takes a bounded number of steps, and gives
 * the same result for the same input. fit_result_free ends *out, which is empty after an error.
 * Errors: GLINT_INPUT, when there are no more usable points than free parameters;
 * GLINT_INTERNAL. */
glint_status fit_run(const fit_form *form, const measured_point *points, int n,
                     const fit_options *options, fit_result *out, glint_error *error);
void fit_result_free(fit_result *result);

/* True when a fit uses that measurement. */
bool fit_uses(const measured_point *point, const fit_options *options);
/* Value of a material in the direction of a measurement, 1/sr. */
double fit_model_f(const brdf_material *material, const measured_point *point);
/* Root mean square of log10(f_material / f_measured) over the usable points, in dex (powers of
 * ten). A material that is 0 somewhere counts with the smallest normal double there. */
double fit_rms_dex(const brdf_material *material, const measured_point *points, int n,
                   const fit_options *options);

/* Appends a material's table [materials.NAME] in TOML. name: a bare key; source: any text. */
void fit_result_toml(const fit_result *result, const char *name, const char *source, text *out);

#endif
