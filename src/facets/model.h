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
struct lobe_shape;

/* Points in the disc, in units of its radius, and weights that add to 1: rules from cheap to fine.
 */
typedef enum disc_rule_kind {
    DISC_CENTRE,
    DISC_CROSS,
    DISC_RING,
    DISC_TWO,
    DISC_THREE,
    DISC_FOUR,
    DISC_RULES
} disc_rule_kind;

enum { DISC_POINTS = 64 };

typedef struct disc_rule {
    int n;
    double x[DISC_POINTS], y[DISC_POINTS], weight[DISC_POINTS];
} disc_rule;

/* A source that is a disc, in each lane of a tile. */
typedef struct source_disc {
    bool limb_darkened; /* by SUN_LIMB_DARKENING */
    disc_rule rules[DISC_RULES];
    double radius[BRDF_TILE], scale[BRDF_TILE]; /* angular, rad, and its tangent; 0: a point */
} source_disc;

/* Fills all but the radii, which source_disc_set does, lane by lane: 0 to 0.1 rad. */
void source_disc_start(source_disc *disc, bool limb_darkened);
void source_disc_set(source_disc *disc, int lane, double radius);

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
    struct lobe_shape
        *shapes;      /* owned; of the lobes of all materials in all bands, in that order */
    int *first_shape; /* owned; n_materials x n_bands: where those of a band begin */
    int *same_band;   /* owned; n_materials x n_bands: first band that is the same function */
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
 * disc: the source; NULL: a point. The light of a disc is the mean over it, which narrow lobes
 * feel, mirrors live from, and facets notice when it sets: to 1e-3 mag (solar_disc.h). Surfaces
 * curved both ways feel it as mirrors only. lights: one per component, directions in that
 * component's frame. visible: n_facets x BRDF_TILE fractions in the order of the facets, or NULL
 * for all 1. x: n_bands x n_spans x BRDF_TILE, overwritten: lane k of span s in band b stands at (b
 * n_spans + s) BRDF_TILE + k. Bands that share a function are evaluated once. */
void model_sum(const model *m, const brdf_light *lights, const source_disc *disc,
               const double *visible, double *x);

/* The same facet by facet, in one band and one lane: x[k] is what facet k sends of itself when all
 * of it counts, m^2/sr. Errors: GLINT_INTERNAL (memory). */
glint_status model_sum_facets(const model *m, const brdf_light *lights, const source_disc *disc,
                              int band, int lane,
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

/* Edges of a mesh that bend by more are meant to be edges, rad: 40 deg. */
#define MODEL_MOST_BEND_RAD 0.698

/* How imported facets of each material look like a curve: bends_rad (n_materials) gets the angle,
 * rad, below which three quarters of those edges bend at which two of them meet that do not know of
 * a curved surface, counting edges that bend by less than MODEL_MOST_BEND_RAD. 0 where there are
 * fewer than 6 such edges. A lobe narrower than half of it flickers. Errors: GLINT_INTERNAL
 * (memory). */
glint_status model_material_bends(const model *m, double *bends_rad, glint_error *error);

#endif
