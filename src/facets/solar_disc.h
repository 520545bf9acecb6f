/* solar_disc.h: the light of a source that is a disc, not a point; private to this room.
 *
 * What a facet reflects is the mean of its term over the disc. A lobe that is much wider than the
 * disc hardly notices; near the highlight of a narrow one, and where the source sets behind the
 * facet's plane, the mean is taken with as few points as do: chosen sample by sample from how far
 * the bisector of the two directions runs, in widths of the lobe, while the source moves across its
 * disc. The mirror direction of a perfect mirror lies on the disc or does not, which is a closed
 * form. Physics page, section 4. */
#ifndef GLINT_FACETS_SOLAR_DISC_H
#define GLINT_FACETS_SOLAR_DISC_H

#include "brdf/brdf.h"
#include "facets/batch.h"
#include "facets/model.h"

enum { LOBE_PHASES = 4, LOBE_ENDS = 7 };
/* A bend that needs no care under discs of 2 widths. */
#define LOBE_BEND 1e-3

/* How narrow a lobe is (brdf/sharpness.h), as the rooms for curved facets and discs ask. */
typedef struct lobe_shape {
    double width[2]; /* rad, along and across the tangent, at most LOBE_WIDEST */
    double narrow;   /* 1 / the smaller one */
    double reach;    /* past it nothing is left, in widths, at phase angle 0; may be infinite */
    /* Past end[p][j] f bends by less than LOBE_BEND 4^j per width^2 at phase angles up to 40 deg (p
     * + 1), the last p also beyond; widths, may be infinite. */
    double end[LOBE_PHASES][LOBE_ENDS];
    bool specular; /* all of it in the mirror direction */
    bool surge;    /* f changes over less than a few degrees of the phase angle */
    double wing;   /* power of the distance from its top with which it falls at most */
} lobe_shape;

/* In place of the width of what has no lobe along one axis, rad. */
#define LOBE_WIDEST 1e3

void lobe_shape_find(const brdf_lobe *lobe, lobe_shape *out);

/* One facet, or a piece of one, under the disc in one lane. */
typedef struct disc_sample {
    const lobe_shape *shape; /* of the batch's only lobe */
    const source_disc *disc;
    int lane;
} disc_sample;

/* What disc_rule_of says besides the rules of source_disc: */
enum {
    DISC_NARROW = DISC_RULES, /* a lobe narrower than the disc, or a mirror */
    DISC_SET                  /* the disc sets behind the facet's plane */
};

/* The rule for a pair of directions (i: to the disc's centre) in the facet's frame t, b, n:
 * DISC_CENTRE where the middle of the disc will do, or none of it is seen to shine. */
int disc_rule_of(const disc_sample *sample, const double i[3], const double r[3]);

/* The same for a disc whose size and distance from the lobe's top are known, in widths of the lobe:
 * any rule but DISC_SET. */
int disc_rule_at(const disc_sample *sample, const double i[3], const double r[3], double size,
                 double distance);

/* Adds the mean over the disc, by that rule of disc_rule_of, of the light of matter of that area.
 * Points of the disc below the horizon give nothing. */
void disc_push(batch *b, const disc_sample *sample, int rule, const double i[3], const double r[3],
               double area_m2);

/* Sets the limits of a watch so that it shows all samples of flat facets, in that light, for which
 * disc_rule_of may say something else than DISC_CENTRE, and few others. `finder` and `found` are
 * left as they are. False: there are none, as all lanes are points. */
bool disc_watch_set(const lobe_shape *shape, const brdf_light *light, const source_disc *disc,
                    brdf_watch *out);

/* Samples that wait for the same rule; set n and sum to 0. */
typedef struct disc_queue {
    _Alignas(64) double i[3][BRDF_TILE], r[3][BRDF_TILE]; /* unit; t, b, n */
    double scale[BRDF_TILE], area_m2[BRDF_TILE];
    int lane[BRDF_TILE], n;
    double sum[BRDF_TILE]; /* by lane, m^2/sr */
} disc_queue;

/* Adds the mean over the disc, by that rule, of a facet's light; scale: of source_disc. */
void disc_queue_push(disc_queue *q, const brdf_material *material, const disc_rule *rule,
                     double scale, int lane, const double i[3], const double r[3], double area_m2);
/* `sum` is complete then. */
void disc_queue_flush(disc_queue *q, const brdf_material *material, const disc_rule *rule);

#endif
