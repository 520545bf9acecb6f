/* fits.c: the public face of fits: a file of measurements, a list of models, a ranking. */
#include "base/constants.h"
#include "brdf/dhr.h"
#include "brdf/fit.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Zenith angle past which measurements are left out unless the caller says another: near grazing
 * the beam is longer than the sample, and instruments see its edge. rad */
#define USUAL_MAX_ZENITH (85.0 * DEG)

/* One fit in the ranking. */
typedef struct ranked {
    fit_result result; /* owned */
    char *model;       /* owned; "lambert+2*ward-gmd" */
    char *material;    /* owned; name of its table */
    int order;         /* in the list that was given */
} ranked;

struct glint_brdf_fits {
    char *path; /* owned */
    measured data;
    fit_options options;
    ranked *fits; /* owned; best first */
    int n;
};

void glint_brdf_fits_free(glint_brdf_fits *fits)
{
    if (!fits) return;
    for (int k = 0; k < fits->n; k++) {
        fit_result_free(&fits->fits[k].result);
        free(fits->fits[k].model);
        free(fits->fits[k].material);
    }
    free(fits->fits);
    measured_free(&fits->data);
    free(fits->path);
    free(fits);
}

bool glint_brdf_can_be_fitted(size_t k)
{
    const brdf_model *model = brdf_model_at(k);
    return model && fit_takes(model);
}

/* ------------------------------------------------------------------ columns */

/* Which quantity is called by the n bytes at `name`; -1 for none. */
static int quantity_named(const char *name, size_t n)
{
    for (int q = 0; q < MEASURED_COLUMNS; q++)
        if (strlen(measured_name(q)) == n && memcmp(measured_name(q), name, n) == 0) return q;
    return -1;
}

/* Reads one "theta_i=3" in place. */
static glint_status read_column(char *item, measured_format *format, glint_error *error)
{
    char *equals = strchr(item, '=');
    const int q = equals ? quantity_named(item, (size_t)(equals - item)) : -1;
    if (q < 0 || !equals[1])
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "the columns have '%.60s'; expected one of theta_i, phi_i, theta_r, phi_r "
                         "and f with the number or the name of its column, as in theta_i=1",
                         item);
    measured_column *column = &format->column[q];
    if (column->name || column->number)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE, "the columns have '%s' twice",
                         measured_name(q));
    const char *value = equals + 1;
    char *end;
    const long number = strtol(value, &end, 10);
    if (!isdigit((unsigned char)value[0]) || *end)
        column->name = value;
    else if (number >= 1 && number <= 100000)
        column->number = (int)number;
    else
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "the columns have '%.60s'; columns count from 1", item);
    return GLINT_OK;
}

/* Reads the layout. *names: a new text that the format borrows from. */
static glint_status read_layout(const glint_brdf_layout *layout, measured_format *format,
                                char **names, glint_error *error)
{
    *format = (measured_format){.signed_zenith = layout->signed_zenith,
                                .radians = layout->radians,
                                .unit_given = layout->unit_given,
                                .floor = layout->floor};
    *names = NULL;
    if (!(layout->floor >= 0.0 && isfinite(layout->floor)))
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "the floor is %g; expected a BRDF of at least 0", layout->floor);
    if (!layout->columns) return GLINT_OK;
    *names = string_copy(layout->columns, strlen(layout->columns));
    if (!*names) return error_no_memory(error);
    for (char *item = *names, *next; item; item = next) {
        next = strchr(item, ',');
        if (next) *next++ = '\0';
        const glint_status status = read_column(item, format, error);
        if (status) return status;
    }
    return GLINT_OK;
}

static glint_status read_data(glint_brdf_fits *fits, const glint_brdf_layout *layout,
                              glint_errors *errors)
{
    static const glint_brdf_layout usual = {0};
    measured_format format;
    char *names;
    glint_error error;
    glint_status status = read_layout(layout ? layout : &usual, &format, &names, &error);
    if (status)
        errors_take(errors, &error, PLACE_NONE);
    else
        status = measured_read(fits->path, PLACE_NONE, &format, &fits->data, errors);
    free(names);
    return status;
}

/* --------------------------------------------------------------------- fits */

/* Reads all models of the list; *forms: new. All errors are found. */
static glint_status read_forms(const char *models, fit_form **forms, int *n, glint_errors *errors)
{
    size_t most = 1;
    for (const char *c = models; *c; c++)
        most += *c == ',';
    *n = 0;
    *forms = malloc(most * sizeof **forms);
    if (!*forms) return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    glint_status worst = GLINT_OK;
    for (const char *item = models;; item++) {
        const size_t length = strcspn(item, ",");
        glint_error error;
        const glint_status status = fit_form_read(item, length, &(*forms)[*n], &error);
        if (status) errors_take(errors, &error, PLACE_NONE);
        if (status > worst) worst = status;
        (*n)++;
        item += length;
        if (!*item) return worst;
    }
}

/* Warns of a material that cannot be. */
static void check_energy(const ranked *r, glint_errors *errors)
{
    brdf_energy worst;
    if (brdf_energy_gain(&r->result.material, &worst))
        errors_warn(errors, PLACE_NONE,
                    "material '%s' (%s) reflects %.4g of the light that falls on it at %g deg from "
                    "the normal: more than it gets",
                    r->material, r->model, worst.dhr, worst.theta_i / DEG);
}

/* Fits one model and puts it behind the others. One that takes more measurements than there are is
 * left out with a warning. */
static glint_status add_fit(glint_brdf_fits *fits, const fit_form *form, int order,
                            glint_errors *errors)
{
    ranked *r = &fits->fits[fits->n];
    glint_error error;
    text model = {0};
    *r = (ranked){.order = order};
    fit_form_write(form, &model);
    r->model = model.data;
    if (model.failed) {
        text_free(&model);
        return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    }
    const glint_status status =
        fit_run(form, fits->data.points, fits->data.n, &fits->options, &r->result, &error);
    if (status == GLINT_OK) {
        fits->n++;
        return GLINT_OK;
    }
    if (status == GLINT_INPUT)
        errors_warn(errors, (place){fits->path, 0, 0}, "'%s' was not fitted: %s", r->model,
                    error.message);
    else
        errors_take(errors, &error, PLACE_NONE);
    text_free(&model);
    r->model = NULL;
    return status == GLINT_INPUT ? GLINT_OK : status;
}

/* By misfit; of two alike the one with fewer parameters, then the one that was named first. */
static int compare(const void *a, const void *b)
{
    const ranked *x = a, *y = b;
    if (x->result.rms_dex != y->result.rms_dex)
        return x->result.rms_dex < y->result.rms_dex ? -1 : 1;
    if (x->result.n_free != y->result.n_free) return x->result.n_free - y->result.n_free;
    return x->order - y->order;
}

/* Appends the name of the file without folder and suffix, as far as a bare key of TOML can hold
 * it. */
static void add_stem(const char *path, text *out)
{
    enum { MOST = 48 }; /* names of materials have 64 letters at most */
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    const size_t n = dot && dot > name ? (size_t)(dot - name) : strlen(name);
    for (size_t k = 0; k < n && k < MOST; k++) {
        const char c = name[k];
        const bool bare = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '_' || c == '-';
        text_char(out, bare ? c : '-');
    }
    if (n == 0) text_add(out, "fit");
}

static glint_status rank(glint_brdf_fits *fits, glint_errors *errors)
{
    qsort(fits->fits, (size_t)fits->n, sizeof *fits->fits, compare);
    for (int k = 0; k < fits->n; k++) {
        text name = {0};
        add_stem(fits->path, &name);
        if (k > 0) text_printf(&name, "-%d", k + 1);
        fits->fits[k].material = name.data;
        if (name.failed) return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
        check_energy(&fits->fits[k], errors);
    }
    return GLINT_OK;
}

static glint_status fit_all(glint_brdf_fits *fits, const char *models, glint_errors *errors)
{
    fit_form *forms;
    int n;
    glint_status status = read_forms(models, &forms, &n, errors);
    if (!status) {
        fits->fits = calloc((size_t)n, sizeof *fits->fits);
        if (!fits->fits) status = errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    }
    for (int k = 0; k < n && !status; k++)
        status = add_fit(fits, &forms[k], k, errors);
    free(forms);
    if (!status && fits->n == 0)
        status = errors_add(errors, GLINT_INPUT, (place){fits->path, 0, 0},
                            "no model could be fitted to these measurements");
    return status ? status : rank(fits, errors);
}

static glint_status read_options(const glint_brdf_fit_options *given, fit_options *out,
                                 glint_errors *errors)
{
    *out = (fit_options){.max_zenith_rad = USUAL_MAX_ZENITH};
    if (!given) return GLINT_OK;
    out->anisotropic = given->anisotropic;
    if (given->max_zenith_rad == 0.0) return GLINT_OK;
    out->max_zenith_rad = given->max_zenith_rad;
    if (given->max_zenith_rad > 0.0 && given->max_zenith_rad <= PI / 2.0) return GLINT_OK;
    return errors_add(errors, GLINT_ARGUMENT, PLACE_NONE,
                      "the largest zenith angle is %g deg; expected more than 0, at most 90",
                      given->max_zenith_rad / DEG);
}

glint_status glint_brdf_fit(const char *path, const glint_brdf_layout *layout, const char *models,
                            const glint_brdf_fit_options *options, glint_brdf_fits **out,
                            glint_errors *errors)
{
    *out = NULL;
    glint_brdf_fits *fits = calloc(1, sizeof *fits);
    if (fits) fits->path = string_copy(path, strlen(path));
    glint_status status = fits && fits->path ? GLINT_OK : GLINT_INTERNAL;
    if (status)
        errors_add(errors, status, PLACE_NONE, "out of memory");
    else
        status = read_options(options, &fits->options, errors);
    if (!status) status = read_data(fits, layout, errors);
    if (!status) status = fit_all(fits, models, errors);
    if (status)
        glint_brdf_fits_free(fits);
    else
        *out = fits;
    return status;
}

/* ------------------------------------------------------------------ results */

bool glint_brdf_fits_get(const glint_brdf_fits *fits, size_t k, glint_brdf_fit_info *out)
{
    if (k >= (size_t)fits->n) return false;
    const ranked *r = &fits->fits[k];
    const measured *m = &fits->data;
    *out = (glint_brdf_fit_info){.model = r->model,
                                 .material = r->material,
                                 .n_rows = (size_t)m->n + (size_t)m->n_dropped,
                                 .n_dark = (size_t)m->n_dropped,
                                 .n_points = (size_t)r->result.n_points,
                                 .n_free = (size_t)r->result.n_free,
                                 .max_zenith_rad = fits->options.max_zenith_rad,
                                 .rms_dex = r->result.rms_dex,
                                 .aic = r->result.aic,
                                 .bic = r->result.bic};
    return true;
}

bool glint_brdf_fits_parameter(const glint_brdf_fits *fits, size_t k, size_t j,
                               glint_brdf_fit_parameter *out)
{
    static const glint_brdf_fit_state states[] = {
        [FIT_DETERMINED] = GLINT_FIT_DETERMINED,
        [FIT_AT_BOUND] = GLINT_FIT_AT_BOUND,
        [FIT_UNDETERMINED] = GLINT_FIT_UNDETERMINED,
        [FIT_TIED] = GLINT_FIT_TIED,
        [FIT_FIXED] = GLINT_FIT_FIXED,
    };
    if (k >= (size_t)fits->n || j >= (size_t)fits->fits[k].result.n_params) return false;
    const fit_result *r = &fits->fits[k].result;
    const fit_param *p = &r->params[j];
    const brdf_model *model = r->form.lobes[p->lobe];
    *out = (glint_brdf_fit_parameter){.lobe = p->lobe,
                                      .model = model->name,
                                      .name = model->params[p->index].name,
                                      .unit = model->params[p->index].unit,
                                      .value = p->value,
                                      .standard_error = p->standard_error,
                                      .state = states[p->state]};
    return true;
}

bool glint_brdf_fits_point(const glint_brdf_fits *fits, size_t k, size_t j,
                           glint_brdf_fit_point *out)
{
    if (k >= (size_t)fits->n || j >= (size_t)fits->data.n) return false;
    const measured_point *p = &fits->data.points[j];
    *out = (glint_brdf_fit_point){.f_measured = p->f, .used = fit_uses(p, &fits->options)};
    memcpy(out->i, p->i, sizeof out->i);
    memcpy(out->r, p->r, sizeof out->r);
    if (out->used) out->f_fitted = fit_model_f(&fits->fits[k].result.material, p);
    return true;
}

glint_status glint_brdf_fits_toml(const glint_brdf_fits *fits, char **toml, glint_error *error)
{
    text t = {0}, source = {0};
    *toml = NULL;
    for (int k = 0; k < fits->n; k++) {
        const ranked *r = &fits->fits[k];
        text_clear(&source);
        text_printf(&source, "fit of %s to %s: %d measurements, rms %.4g dex", r->model, fits->path,
                    r->result.n_points, r->result.rms_dex);
        if (source.failed) break;
        if (k > 0) text_char(&t, '\n');
        fit_result_toml(&r->result, r->material, source.data, &t);
    }
    const bool failed = t.failed || source.failed;
    text_free(&source);
    if (!failed) {
        *toml = t.data;
        return GLINT_OK;
    }
    text_free(&t);
    return error_no_memory(error);
}
