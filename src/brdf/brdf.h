/* brdf.h: bidirectional reflectance distribution functions (1/sr).
 *
 * Every model is evaluated as g = f ci cr, which is finite over the whole hemisphere (f is not, for
 * some). i (to the source) and r (to the observer) are unit vectors that both point away from the
 * facet; n is its outward normal, t its tangent, b = n x t. ci = i.n, cr = r.n, H = i + r.
 * g is 0 unless ci > BRDF_EDGE and cr > BRDF_EDGE: such a facet is edge-on and counts as dark. */
#ifndef GLINT_BRDF_BRDF_H
#define GLINT_BRDF_BRDF_H

#include "base/error.h"
#include "base/param.h"

#include <stdint.h>

#define BRDF_EDGE 1e-12 /* cosine below which a facet is edge-on (physics page, section 6) */

enum {
    BRDF_TILE = 32,       /* directions handled together: the inner loop of the kernel */
    BRDF_MAX_PARAMS = 12, /* numeric parameters of one model */
    BRDF_MAX_COEF = 24    /* numbers that a prepared model keeps */
};

/* What a watch looks at, each with all before it. */
typedef enum brdf_watch_kind {
    BRDF_WATCH_SOURCE, /* |ci| < low: the source is about to set */
    BRDF_WATCH_LOBE,   /* H.n > near: the bisector is near the normal */
    BRDF_WATCH_WINGS   /* |ci| + cr < graze: it is near the facet's plane */
} brdf_watch_kind;

/* Samples that the kernel shows to its caller before it adds them: those are rare, and the kernel
 * has their cosines at hand, good to 1e-15. A sample is shown where cr > BRDF_EDGE and one of the
 * above holds with the limits of its lane. */
typedef struct brdf_watch {
    brdf_watch_kind kind;
    _Alignas(64) double low[BRDF_TILE], near[BRDF_TILE], graze[BRDF_TILE];
    void *finder; /* for `found`; borrowed */
    /* Told of a facet and its lanes, bit k for lane k. Returns those among them that the caller has
     * seen to: the kernel leaves them out. */
    uint32_t (*found)(void *finder, int facet, uint32_t lanes);
} brdf_watch;

/* Facets of one material in one component: structure of arrays, component coordinates.
 * All arrays have n entries; borrowed. */
typedef struct brdf_facets {
    int n;
    const double *normal[3], *tangent[3], *bitangent[3]; /* unit, orthogonal, right-handed */
    const double *area;                                  /* m^2 */
    const brdf_watch *watch;                             /* borrowed; NULL: none */
} brdf_facets;

/* BRDF_TILE pairs of directions in the component's frame, all of them usable numbers (spare lanes
 * repeat a pair in use). */
typedef struct brdf_light {
    _Alignas(64) double i[3][BRDF_TILE]; /* unit, to the source */
    double r[3][BRDF_TILE];              /* unit, to the observer */
    double h[3][BRDF_TILE];              /* i + r, not normalised */
    double hh[BRDF_TILE];                /* |i + r|^2 */
    double hlen[BRDF_TILE];              /* |i + r| */
} brdf_light;

/* Fills h, hh, hlen from i and r. */
void brdf_light_finish(brdf_light *light);

enum {
    BRDF_ISOTROPIC = 1u << 0,      /* does not depend on the tangent */
    BRDF_NOT_RECIPROCAL = 1u << 1, /* f(i,r) != f(r,i), documented in `doc` */
    BRDF_WAVELENGTH = 1u << 2,     /* takes k_per_um and wavelength_um: both or neither */
    BRDF_MEASURED = 1u << 3,       /* takes the rows of a file: table_prepare makes its lobes */
    BRDF_PASSIVE = 1u << 4         /* reflects at most what it gets, whatever its parameters are */
};

struct brdf_lobe;

/* One model: a row of the table. */
typedef struct brdf_model {
    const char *name, *doc, *source;
    const param_info *params;
    int n_params;
    unsigned flags;
    /* Turns parameters (in the table's order and units, checked against their ranges by the caller;
     * an optional one that was not given is NAN) into the numbers that the kernel reads. Errors
     * (GLINT_INPUT): combinations that make no sense; of a model with prepare_lobe: always. */
    glint_status (*prepare)(const double *params, double coef[BRDF_MAX_COEF], glint_error *error);
    /* For models that take arrays, and keep more numbers than coef has room for: turns the lobe's
     * params and arrays into lobe->numbers, which then stand in the place of coef below. NULL for
     * the others. Errors: GLINT_INPUT as above; GLINT_INTERNAL: memory is out. */
    glint_status (*prepare_lobe)(struct brdf_lobe *lobe, glint_error *error);
    /* g = f ci cr, 1/sr, for one pair; i, r in the facet's frame (t, b, n), unit. Here and below
     * coef has all BRDF_MAX_COEF entries, of which `prepare` fills the model's own, or is the
     * lobe's `numbers`: brdf_lobe_coef tells which. */
    double (*eval)(const double *coef, const double i[3], const double r[3]);
    /* sum[k] += sum over facets of weight * g * area * visible[facet * BRDF_TILE + k], for every
     * lane k, m^2/sr. visible: NULL for all 1. The fused kernel: same formula as eval. A lane's
     * result depends on that lane alone, and its facets are added in their order. */
    void (*tile)(const double *coef, double weight, const brdf_facets *facets,
                 const brdf_light *light, const double *visible, double sum[BRDF_TILE]);
    /* Of models that send light into the mirror direction alone, a delta function in f: the
     * reflectance there, 0 to 1, at an incidence of cosine 0 < ci <= 1. eval and tile leave that
     * light out. NULL: there is none. */
    double (*specular)(const double *coef, double ci);
} brdf_model;

/* The table: model k from 0, NULL past the end. */
const brdf_model *brdf_model_at(size_t k);
/* The model of that name, or NULL. */
const brdf_model *brdf_model_named(const char *name);

/* A parameter that is an array: rows of equal length, row-major. `values` owned by the lobe. */
typedef struct brdf_array {
    int rows, columns;
    double *values;
} brdf_array;

/* One weighted lobe of a material, prepared. What brdf_lobe_free ends is owned. */
typedef struct brdf_lobe {
    const brdf_model *model;
    double weight;
    double params[BRDF_MAX_PARAMS]; /* as given, for reports; NAN where not given */
    double coef[BRDF_MAX_COEF];
    brdf_array *arrays; /* owned; NULL, or one for each parameter, empty where that is a number */
    double *numbers;    /* owned; NULL, or what prepare_lobe made */
    size_t n_numbers;
} brdf_lobe;

/* Makes room for the arrays of a model that takes some, all empty. False when memory is out. */
bool brdf_lobe_make_arrays(brdf_lobe *lobe);
/* Prepares a lobe whose model, params and arrays are set. Errors as brdf_model.prepare and
 * prepare_lobe. */
glint_status brdf_lobe_prepare(brdf_lobe *lobe, glint_error *error);
void brdf_lobe_free(brdf_lobe *lobe);
/* The `prepare` of models that have prepare_lobe: an error. */
glint_status brdf_prepare_without_arrays(const double *params, double coef[BRDF_MAX_COEF],
                                         glint_error *error);

/* The numbers that the model's eval and tile read. */
static inline const double *brdf_lobe_coef(const brdf_lobe *lobe)
{
    return lobe->numbers ? lobe->numbers : lobe->coef;
}

/* A material in one band: the weighted sum of its lobes. `lobes` owned. */
typedef struct brdf_material {
    int n_lobes;
    brdf_lobe *lobes;
} brdf_material;

/* g = f ci cr of a material, facet frame. */
double brdf_material_eval(const brdf_material *material, const double i[3], const double r[3]);
/* The part of the light from an incidence of cosine 0 < ci <= 1 that goes into the mirror direction
 * alone: the weighted sum of brdf_model.specular, 0 where no lobe is a mirror. */
double brdf_material_specular(const brdf_material *material, double ci);
/* sum[k] += ... over all lobes, as brdf_model.tile. */
void brdf_material_tile(const brdf_material *material, const brdf_facets *facets,
                        const brdf_light *light, const double *visible, double sum[BRDF_TILE]);
/* True when some lobe is measured values: those are good to a percent or so. */
bool brdf_material_is_measured(const brdf_material *material);
/* True when two materials are the same function: their sums may be shared. */
bool brdf_material_same(const brdf_material *a, const brdf_material *b);
void brdf_material_free(brdf_material *material);

#endif
