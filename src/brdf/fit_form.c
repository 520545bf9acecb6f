/* fit_form.c: what a fit is made of, as it is typed. */
#include "brdf/fit.h"

#include <ctype.h>
#include <string.h>

/* Models cannot be added to a sum past these. */
static glint_status check_sum(const fit_form *form, glint_error *error)
{
    int n_params = 0;
    for (int k = 0; k < form->n_lobes; k++) {
        const brdf_model *model = form->lobes[k];
        n_params += model->n_params;
        for (int j = 0; j < k; j++)
            if (model == form->lobes[j] && model->n_params == 1)
                return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                                 "the sum has '%s' twice; two of them are one with a larger '%s'",
                                 model->name, model->params[0].name);
    }
    if (n_params > FIT_MAX_PARAMS)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "the sum has %d parameters; at most %d can be fitted", n_params,
                         FIT_MAX_PARAMS);
    return GLINT_OK;
}

static glint_status refuse_name(const char *name, glint_error *error)
{
    const char *names[64];
    size_t n = 0;
    for (const brdf_model *m; n < 64 && (m = brdf_model_at(n)); n++)
        names[n] = m->name;
    const char *near = nearest_name(name, names, n);
    return error_set(error, GLINT_ARGUMENT, PLACE_NONE, "there is no BRDF '%.40s'%s%s%s", name,
                     near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
}

bool fit_takes(const brdf_model *model)
{
    return !model->prepare_lobe && !model->specular;
}

/* Says why a model cannot be fitted. */
static glint_status refuse_model(const brdf_model *model, glint_error *error)
{
    if (model->specular)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "'%s' cannot be fitted: f is a delta function, which no measurement has; "
                         "fit a narrow lobe such as ward-gmd",
                         model->name);
    return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                     "'%s' cannot be fitted: it takes more than single numbers; models of numbers "
                     "alone are ward-gmd, abg, phong and others of 'glint brdf list'",
                     model->name);
}

static void trim(const char **s, size_t *n)
{
    while (*n > 0 && isspace((unsigned char)**s))
        (*s)++, (*n)--;
    while (*n > 0 && isspace((unsigned char)(*s)[*n - 1]))
        (*n)--;
}

/* The count before a '*', which is taken away with it; 1 where there is none, 0 where it is no
 * whole number from 1 to FIT_MAX_LOBES. */
static int take_count(const char **s, size_t *n)
{
    const char *star = memchr(*s, '*', *n);
    if (!star) return 1;
    const char *digits = *s;
    size_t n_digits = (size_t)(star - *s);
    trim(&digits, &n_digits);
    *n -= (size_t)(star + 1 - *s);
    *s = star + 1;
    trim(s, n);
    if (n_digits != 1 || *digits < '1' || *digits > '0' + FIT_MAX_LOBES) return 0;
    return *digits - '0';
}

static glint_status read_term(const char *s, size_t n, fit_form *form, glint_error *error)
{
    trim(&s, &n);
    const int shown = n < 40 ? (int)n : 40;
    const char *whole = s;
    const int count = take_count(&s, &n);
    if (count == 0)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "found '%.*s'; expected N*NAME with a whole number N from 1 to %d", shown,
                         whole, FIT_MAX_LOBES);
    if (n == 0)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "a term of the sum is empty; expected names of models as in "
                         "'lambert+2*ward-gmd'");
    char name[64];
    const size_t kept = n < sizeof name ? n : sizeof name - 1;
    memcpy(name, s, kept);
    name[kept] = '\0';
    const brdf_model *model = brdf_model_named(name);
    if (!model) return refuse_name(name, error);
    if (!fit_takes(model)) return refuse_model(model, error);
    if (form->n_lobes + count > FIT_MAX_LOBES)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE, "the sum has more than %d lobes",
                         FIT_MAX_LOBES);
    for (int k = 0; k < count; k++)
        form->lobes[form->n_lobes++] = model;
    return GLINT_OK;
}

glint_status fit_form_read(const char *s, size_t n, fit_form *out, glint_error *error)
{
    *out = (fit_form){0};
    const char *end = s + n;
    for (;;) {
        const char *plus = memchr(s, '+', (size_t)(end - s));
        const size_t length = (size_t)((plus ? plus : end) - s);
        const glint_status status = read_term(s, length, out, error);
        if (status) return status;
        if (!plus) return check_sum(out, error);
        s = plus + 1;
    }
}

void fit_form_write(const fit_form *form, text *out)
{
    for (int k = 0, count; k < form->n_lobes; k += count) {
        for (count = 1; k + count < form->n_lobes; count++)
            if (form->lobes[k + count] != form->lobes[k]) break;
        if (k > 0) text_char(out, '+');
        if (count > 1) text_printf(out, "%d*", count);
        text_add(out, form->lobes[k]->name);
    }
}
