/* curved.h: light from facets that stand for pieces of curved surfaces; private to this room.
 *
 * A flat facet has one normal, the matter that it stands for has many. Where a lobe is narrower
 * than the normals of one facet are apart, a sum over facets flickers: the highlight is there when
 * a facet happens to look the right way, and gone in between. So the lobe is integrated over the
 * normals that the facet stands for.
 *
 * A normal is known by its slopes x, y: n + x t + y b, made unit, with the facet's own n, t, b. In
 * the plane of slopes great circles are straight, so that the normals of a triangle of a sphere,
 * and those of a paraboloid's, fill a triangle; cones and cylinders are arcs, turned about their
 * axis. The highlight is where the normal bisects the two directions. Towards that point triangles
 * and arcs are halved, until each is narrower than the lobe or than a part of its distance; the
 * lobe is then smooth over each, and a rule of three points integrates it. The work grows with the
 * logarithm of the lobe's narrowness only.
 *
 * Facets that are small against the lobe, or far from the highlight, count with their own normal,
 * as flat ones do; so do all facets of diffuse surfaces. */
#ifndef GLINT_FACETS_CURVED_H
#define GLINT_FACETS_CURVED_H

#include "brdf/brdf.h"
#include "facets/primitive.h"

/* A piece of a facet's normals: a triangle of slopes, or an arc. */
typedef struct curved_piece {
    surface_kind kind; /* SURFACE_CONE: an arc; else a triangle of slopes */
    double area_m2; /* of the matter; of a triangle if the density were 1 all over it: that is, with
                       q = 1 + x^2 + y^2: q^-3/2 on a sphere, q^1/2 / (view . (x, y, 1))^4 on a
                       paraboloid, 1 where smooth */
    double corner[3][2], view[3]; /* of a triangle */
    /* Arc: the frame of its middle (t, b, n in component coordinates) is turned about the axis
     * (unit, in that frame) by -2 atan(end) to 2 atan(end). */
    double frame[9], axis[3], end;
    double off[2]; /* slopes of the facet's own normal in that frame */
} curved_piece;

/* What one lobe of a material asks of the facets of a span. */
typedef struct curved_lobe {
    bool active;     /* some facet is large against it; the rest is only filled in if so */
    double width[2]; /* rad, along and across the tangent */
    double reach;    /* past it nothing is left, in widths, at phase angle 0 */
    double
        *extent; /* owned; of each facet: how far its normals go from its own, in widths; 0: flat */
} curved_lobe;

/* The curved facets among those of a span. */
typedef struct curved_span {
    int n;
    curved_piece *pieces; /* owned */
    int *first_piece;     /* owned; n + 1: those of facet k are first_piece[k] .. [k + 1] - 1 */
    int n_bands;
    int *first_lobe; /* owned; n_bands + 1: those of band b are first_lobe[b] .. [b + 1] - 1; none
                        of a band that is the same as an earlier one */
    curved_lobe *lobes; /* owned */
} curved_span;

/* Looks at facets first .. first + n - 1 of the list. bands: the material in each of the n_bands;
 * same[b]: an earlier band that is the same function, or b. *out is NULL where all facets count as
 * flat in all bands. Errors: GLINT_INTERNAL (memory). */
glint_status curved_span_make(const facet_list *list, int first, int n, const brdf_material *bands,
                              const int *same, int n_bands, curved_span **out, glint_error *error);
void curved_span_free(curved_span *span);

#endif
