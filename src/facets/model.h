/* model.h: the compiled satellite: facets as structure of arrays, spans of one material in one
 * component, and the sum over them. Knows no orbit, no time, no file. */
#ifndef GLINT_FACETS_MODEL_H
#define GLINT_FACETS_MODEL_H

#include "brdf/brdf.h"
#include "facets/primitive.h"

/* A material as the model takes it: one function per band, borrowed until the model is freed. */
typedef struct model_material {
    const char *name;
    const brdf_material *bands; /* n_bands of them */
} model_material;

/* A component as the model takes it; borrowed. */
typedef struct model_component {
    const char *name;
} model_component;

struct curved_span;

/* Facets of one material in one component. */
typedef struct model_span {
    int component, material;
    int first, n;               /* facets of the model */
    brdf_facets facets;         /* borrowed from the model's arrays */
    struct curved_span *curved; /* owned; NULL where every facet counts with its own normal */
} model_span;

/* Immutable after model_compile; shared by threads. */
typedef struct model {
    int n_materials, n_components, n_bands, n_spans, n_facets;
    const model_material *materials;   /* borrowed */
    const model_component *components; /* borrowed */
    model_span *spans;                 /* owned; by component, then material */
    facet_list polygons;               /* owned; in the same order as the arrays */
    double *arrays;                    /* owned; backs the spans */
    int *same_band; /* owned; n_materials x n_bands: first band that is the same function */
} model;

/* Takes over *facets (emptied on success). Facets are sorted by component, then material, keeping
 * their order otherwise; every facet's indices must be in range. materials, components: borrowed
 * until model_free. n_bands: 1 or more, the length of every material's `bands`. Errors: GLINT_INPUT
 * when there is no facet; GLINT_INTERNAL (memory). On error *out is empty and *facets unchanged. */
glint_status model_compile(facet_list *facets, const model_material *materials, int n_materials,
                           const model_component *components, int n_components, int n_bands,
                           model *out, glint_error *error);
void model_free(model *m);

/* Sums g * area * visible over each span for one tile of BRDF_TILE direction pairs, m^2/sr. A facet
 * that stands for a piece of a curved surface counts with all the normals of that piece where the
 * material's lobe is narrow against them (curved.h).
 * lights: one per component, directions in that component's frame.
 * visible: n_facets x BRDF_TILE fractions in the order of the facets, or NULL for all 1.
 * x: n_bands x n_spans x BRDF_TILE, overwritten: lane k of span s in band b stands at
 * (b n_spans + s) BRDF_TILE + k. Bands that share a function are evaluated once. */
void model_sum(const model *m, const brdf_light *lights, const double *visible, double *x);

/* The same facet by facet, in one band and one lane: x[k] is what facet k sends of itself when all
 * of it counts, m^2/sr. Errors: GLINT_INTERNAL (memory). */
glint_status model_sum_facets(const model *m, const brdf_light *lights, int band, int lane,
                              double *x, glint_error *error);

/* Geometry in numbers, for reports. */
typedef struct model_component_facts {
    int n_facets;
    double area_m2;
    double lo_m[3], hi_m[3]; /* bounding box, component coordinates */
    bool closed;      /* every edge is run through as often one way as the other: no rim is left */
    int n_open_edges; /* different edges of which that is not true (vertices match within 1e-9 m) */
} model_component_facts;
/* Of component c; all zero for one without facets. Errors: GLINT_INTERNAL (memory). */
glint_status model_component_describe(const model *m, int c, model_component_facts *out,
                                      glint_error *error);
/* Area of a material over the whole model, m^2, and its number of facets (NULL allowed). */
double model_material_area(const model *m, int material, int *n_facets);

#endif
