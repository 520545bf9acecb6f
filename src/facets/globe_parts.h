/* globe_parts.h: what the two files of globe.h share; private to them. */
#ifndef GLINT_FACETS_GLOBE_PARTS_H
#define GLINT_FACETS_GLOBE_PARTS_H

#include "brdf/sharpness.h"
#include "facets/globe.h"
#include "facets/solar_disc.h"

/* Points on 0..1 and their weights; borrowed. */
typedef struct gauss_rule {
    int n;
    const double *at, *weight;
} gauss_rule;

/* One material in one band. */
typedef struct globe_matter {
    brdf_material wide; /* what nodes resolve; its lobes are shallow copies in an owned array */
    int n_narrow;
    brdf_lobe *narrow;  /* owned array of shallow copies: what is looked at closely */
    lobe_shape *shapes; /* owned; of these */
} globe_matter;

struct globe {
    const model *model;          /* borrowed */
    const brdf_material *ground; /* borrowed; n_bands */
    int *same_ground;            /* owned; n_bands: first band with the same ground */
    int rings, spokes;           /* spokes: nodes of the ring at the limb */
    int n_rules;
    gauss_rule *rules;    /* owned */
    double *rule_numbers; /* owned; what they borrow */
    globe_matter *matter; /* owned; n_materials x n_bands; empty where same_band tells of another */
};

/* Nodes of one emission angle. */
typedef struct globe_ring {
    double sin_nadir, cos_nadir;     /* of the angle from nadir, at the satellite */
    double sin_central, cos_central; /* of that at the globe's centre */
    double sin_out, cos_out;         /* of that at the ground, from its normal */
    double lit;                      /* half the lit arc about the Sun's side, rad; PI: all of it */
    double weight;                   /* integral weight of the angle */
    const gauss_rule *azimuths;
} globe_ring;

typedef struct globe_lane {
    globe_view view;
    double towards[3], across[3]; /* unit; with view.up an orthogonal frame, the Sun over towards */
    double sun_up, sun_side;      /* the Sun's direction in it */
    int n_rings;                  /* 0: the lane is dark */
    globe_ring *rings;            /* borrowed from the scratch */
} globe_lane;

/* Rings past the wanted number: both parts of a cut globe are rounded up, to 8 at least. */
enum { GLOBE_SPARE = 16 };

struct globe_scratch {
    globe_lane lanes[BRDF_TILE];
    globe_ring *rings;  /* owned */
    brdf_light *lights; /* owned; n_components */
    double *weight;     /* owned; n_bands x BRDF_TILE */
    double *own;        /* owned; n_bands x BRDF_TILE */
};

/* Adds what is left of a narrow lobe away from its highlight, for one node's light: as
 * brdf_material_tile. */
void globe_add_outside(const globe_matter *matter, int which, const brdf_facets *facets,
                       const brdf_light *light, const double *visible, double *sum);

/* Adds what the narrow lobes of all facets show of the globe around their highlights. */
void globe_add_highlights(const globe *g, globe_scratch *s, const visibility_pose *poses,
                          const double *visible, double *x);

#endif
