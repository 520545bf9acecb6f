/* painted.h: models of one primitive and one material, given by its name and parameters. */
#ifndef GLINT_PAINTED_H
#define GLINT_PAINTED_H

#include "shapes.h"

/* A model of one material. */
typedef struct bench {
    brdf_lobe lobe;
    brdf_material material;
    model_material materials[1];
    model_component components[1];
    facet_list facets;
    model model;
} bench;

/* A material as its name and parameters; at[k] gets the slope, if it has one. */
typedef struct paint {
    const char *name;
    double params[6];
} paint;

#define NONE ((double)NAN) /* a parameter that is not given */

static inline bench *bench_of(primitive_spec *spec, const paint *p)
{
    bench *b = calloc(1, sizeof *b);
    b->lobe = (brdf_lobe){.model = brdf_model_named(p->name), .weight = 1.0};
    ck_assert_ptr_nonnull(b->lobe.model);
    for (int k = 0; k < b->lobe.model->n_params; k++)
        b->lobe.params[k] = p->params[k];
    ck_assert_int_eq(b->lobe.model->prepare(b->lobe.params, b->lobe.coef, NULL), GLINT_OK);
    b->material = (brdf_material){1, &b->lobe};
    b->materials[0] = (model_material){p->name, &b->material};
    b->components[0] = (model_component){"body"};
    shape_add(spec, 0, &b->facets);
    ck_assert_int_eq(
        model_compile(&b->facets, b->materials, 1, b->components, 1, 1, &b->model, NULL), GLINT_OK);
    return b;
}

/* A plate of 1 m^2 looking along z. */
static inline bench *plate_of(const paint *p)
{
    primitive_spec spec = shape("plate");
    SET(&spec, "size_m", 1, 1);
    SET(&spec, "normal", 0, 0, 1);
    SET(&spec, "tangent", 1, 0, 0);
    shape_material(&spec, "material", 0);
    return bench_of(&spec, p);
}

static inline void bench_free(bench *b)
{
    model_free(&b->model);
    free(b);
}

#endif
