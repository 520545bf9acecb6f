/* bench.h: one shape of one material in the light, for tests of what it reflects. */
#ifndef GLINT_BENCH_H
#define GLINT_BENCH_H

#include "shapes.h"

/* A model of one material with one lobe. */
typedef struct bench {
    brdf_lobe lobe;
    brdf_material material;
    model_material materials[1];
    model_component components[1];
    model model;
} bench;

/* A material as its name and parameters. */
typedef struct paint {
    const char *name;
    double params[6];
} paint;

#define NONE ((double)NAN) /* a parameter that is not given */

static inline void bench_paint(bench *b, const paint *p)
{
    b->lobe = (brdf_lobe){.model = brdf_model_named(p->name), .weight = 1.0};
    ck_assert_ptr_nonnull(b->lobe.model);
    for (int k = 0; k < b->lobe.model->n_params; k++)
        b->lobe.params[k] = p->params[k];
    ck_assert_int_eq(b->lobe.model->prepare(b->lobe.params, b->lobe.coef, NULL), GLINT_OK);
    b->material = (brdf_material){1, &b->lobe};
    b->materials[0] = (model_material){p->name, &b->material};
    b->components[0] = (model_component){"body"};
}

/* Takes over the facets. bench_free ends it. */
static inline bench *bench_of_facets(facet_list *facets, const paint *p)
{
    bench *b = calloc(1, sizeof *b);
    bench_paint(b, p);
    ck_assert_int_eq(model_compile(facets, b->materials, 1, b->components, 1, 1, &b->model, NULL),
                     GLINT_OK);
    return b;
}

static inline bench *bench_of(primitive_spec *spec, const paint *p)
{
    facet_list facets = {0};
    shape_add(spec, 0, &facets);
    return bench_of_facets(&facets, p);
}

static inline void bench_free(bench *b)
{
    model_free(&b->model);
    free(b);
}

/* The sums of BRDF_TILE pairs of directions, m^2/sr. */
static inline void sums_of(const bench *b, double (*sun)[3], double (*observer)[3],
                           double x[BRDF_TILE])
{
    brdf_light light;
    for (int k = 0; k < BRDF_TILE; k++)
        for (int j = 0; j < 3; j++)
            light.i[j][k] = sun[k][j], light.r[j][k] = observer[k][j];
    brdf_light_finish(&light);
    ck_assert_int_eq(b->model.n_spans, 1);
    model_sum(&b->model, &light, NULL, NULL, x);
}

/* --- directions --- */

/* Even numbers in 0 to 1, the same on every run (a Weyl sequence). */
static inline double number(int k, int which)
{
    static const double step[4] = {0.6180339887498949, 0.7548776662466927, 0.5698402909980532,
                                   0.8191725133961645};
    return fmod((k + 1) * step[which], 1.0);
}

static inline void direction_of(double u, double v, double out[3])
{
    const double z = 2 * u - 1, s = sqrt(1 - z * z), a = TWO_PI * v;
    out[0] = s * cos(a), out[1] = s * sin(a), out[2] = z;
}

/* Attitude k: two directions at a phase angle, their bisector and their plane anywhere. */
static inline void light_at(int k, double phase, double sun[3], double observer[3])
{
    double h[3], other[3], aside[3];
    direction_of(number(k, 0), number(k, 1), h);
    direction_of(number(k, 2), number(k, 3), other);
    perp3(other, h, aside);
    scale3(h, cos(0.5 * phase), sun);
    copy3(sun, observer);
    add_scaled3(sun, sin(0.5 * phase), aside, sun);
    add_scaled3(observer, -sin(0.5 * phase), aside, observer);
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

#endif
