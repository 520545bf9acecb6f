/* brdf.c: the table of models, and materials made of them. */
#include "brdf/brdf.h"

#include "brdf/models.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* In the order of the listings: diffuse, lobes, microfacets and mirrors, scatter, powders,
 * measurements. */
static const brdf_model *const models[] = {
    &brdf_lambert,
    &brdf_oren_nayar,
    &brdf_minnaert,
    &brdf_ward,
    &brdf_ward_duer,
    &brdf_ward_gmd,
    &brdf_phong,
    &brdf_ashikhmin_shirley,
    &brdf_ashikhmin_premoze,
    &brdf_cook_torrance,
    &brdf_ggx,
    &brdf_five_parameter,
    &brdf_mirror,
    &brdf_abg,
    &brdf_binomial,
    &brdf_lommel_seeliger,
    &brdf_hapke,
    &brdf_table,
};

enum { N_MODELS = sizeof models / sizeof models[0] };

const brdf_model *brdf_model_at(size_t k)
{
    return k < N_MODELS ? models[k] : NULL;
}

const brdf_model *brdf_model_named(const char *name)
{
    for (size_t k = 0; k < N_MODELS; k++)
        if (strcmp(models[k]->name, name) == 0) return models[k];
    return NULL;
}

void brdf_light_finish(brdf_light *light)
{
    for (int k = 0; k < BRDF_TILE; k++) {
        double hh = 0.0;
        for (int j = 0; j < 3; j++) {
            const double h = light->i[j][k] + light->r[j][k];
            light->h[j][k] = h;
            hh += h * h;
        }
        light->hh[k] = hh;
        light->hlen[k] = sqrt(hh);
    }
}

bool brdf_lobe_make_arrays(brdf_lobe *lobe)
{
    lobe->arrays = calloc((size_t)lobe->model->n_params, sizeof *lobe->arrays);
    return lobe->arrays != NULL;
}

glint_status brdf_lobe_prepare(brdf_lobe *lobe, glint_error *error)
{
    if (lobe->model->prepare_lobe) return lobe->model->prepare_lobe(lobe, error);
    return lobe->model->prepare(lobe->params, lobe->coef, error);
}

glint_status brdf_prepare_without_arrays(const double *params, double coef[BRDF_MAX_COEF],
                                         glint_error *error)
{
    (void)params;
    (void)coef;
    return error_set(error, GLINT_INPUT, PLACE_NONE, "this model takes more than numbers");
}

void brdf_lobe_free(brdf_lobe *lobe)
{
    for (int k = 0; lobe->arrays && k < lobe->model->n_params; k++)
        free(lobe->arrays[k].values);
    free(lobe->arrays);
    free(lobe->numbers);
    lobe->arrays = NULL;
    lobe->numbers = NULL;
    lobe->n_numbers = 0;
}

double brdf_material_eval(const brdf_material *material, const double i[3], const double r[3])
{
    double g = 0.0;
    for (int k = 0; k < material->n_lobes; k++) {
        const brdf_lobe *lobe = &material->lobes[k];
        g += lobe->weight * lobe->model->eval(brdf_lobe_coef(lobe), i, r);
    }
    return g;
}

double brdf_material_specular(const brdf_material *material, double ci)
{
    double part = 0.0;
    for (int k = 0; k < material->n_lobes; k++) {
        const brdf_lobe *lobe = &material->lobes[k];
        if (lobe->model->specular)
            part += lobe->weight * lobe->model->specular(brdf_lobe_coef(lobe), ci);
    }
    return part;
}

void brdf_material_tile(const brdf_material *material, const brdf_facets *facets,
                        const brdf_light *light, const double *visible, double sum[BRDF_TILE])
{
    for (int k = 0; k < material->n_lobes; k++) {
        const brdf_lobe *lobe = &material->lobes[k];
        lobe->model->tile(brdf_lobe_coef(lobe), lobe->weight, facets, light, visible, sum);
    }
}

bool brdf_material_is_measured(const brdf_material *material)
{
    for (int k = 0; k < material->n_lobes; k++)
        if (material->lobes[k].model->flags & BRDF_MEASURED) return true;
    return false;
}

static bool same_number(double a, double b)
{
    return a == b || (isnan(a) && isnan(b)); /* NAN: not given */
}

static bool same_lobe(const brdf_lobe *a, const brdf_lobe *b)
{
    if (a->model != b->model || a->weight != b->weight) return false;
    for (int j = 0; j < a->model->n_params; j++)
        if (!same_number(a->params[j], b->params[j])) return false;
    if (a->n_numbers != b->n_numbers) return false;
    for (size_t j = 0; j < a->n_numbers; j++)
        if (!same_number(a->numbers[j], b->numbers[j])) return false;
    return true;
}

bool brdf_material_same(const brdf_material *a, const brdf_material *b)
{
    if (a->n_lobes != b->n_lobes) return false;
    for (int k = 0; k < a->n_lobes; k++)
        if (!same_lobe(&a->lobes[k], &b->lobes[k])) return false;
    return true;
}

void brdf_material_free(brdf_material *material)
{
    if (!material) return;
    for (int k = 0; k < material->n_lobes; k++)
        brdf_lobe_free(&material->lobes[k]);
    free(material->lobes);
    *material = (brdf_material){0};
}

const char *glint_brdf_name(size_t k)
{
    return k < N_MODELS ? models[k]->name : NULL;
}

const char *glint_brdf_doc(size_t k)
{
    return k < N_MODELS ? models[k]->doc : NULL;
}

const char *glint_brdf_source(size_t k)
{
    return k < N_MODELS ? models[k]->source : NULL;
}

bool glint_brdf_parameter(size_t k, size_t j, glint_brdf_param *out)
{
    if (k >= N_MODELS || j >= (size_t)models[k]->n_params) return false;
    const param_info *p = &models[k]->params[j];
    *out = (glint_brdf_param){.name = p->name,
                              .unit = p->unit,
                              .doc = p->doc,
                              .min = p->min,
                              .max = p->max,
                              .min_open = p->flags & PARAM_MIN_OPEN,
                              .max_open = p->flags & PARAM_MAX_OPEN,
                              .default_value = p->def,
                              .dimensions = p->flags & PARAM_ROWS ? 2 : 0,
                              .required = param_is_required(p)};
    return true;
}
