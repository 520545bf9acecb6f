/* curved.c: which normals the facets of a span stand for, and where that matters. */
#include "facets/curved.h"

#include "base/constants.h"
#include "base/grow.h"
#include "base/vec.h"
#include "facets/curved_parts.h"

#include <stdlib.h>

/* Normals of matter this far from the facet's own (cosine) are not what it stands for: a facet of
 * which a file says so counts as flat. */
#define LEAST_COSINE 0.2

/* What is at hand while a span is looked at. */
typedef struct maker {
    const facet_list *list;
    int first;
    curved_span *out;
    int n_pieces, capacity; /* of out->pieces */
    glint_error *error;
} maker;

static glint_status add_piece(maker *m, const curved_piece *piece)
{
    curved_span *out = m->out;
    if (!grow_room(&out->pieces, &m->capacity, m->n_pieces + 1L, sizeof *out->pieces))
        return error_no_memory(m->error);
    out->pieces[m->n_pieces++] = *piece;
    return GLINT_OK;
}

/* --- pieces --- */

/* The unit normal of the matter at vertex v of a facet, on the side that the facet shows. */
static void normal_at(const facet_list *list, const facet *f, int v, double out[3])
{
    const curved_surface *s = &list->surfaces[f->surface - 1];
    const int k = f->first_vertex + v;
    double d[3];
    sub3(list->vertices[k], s->centre_m, d);
    if (s->kind == SURFACE_SMOOTH) {
        copy3(list->normals[k], out);
        return;
    }
    if (s->kind == SURFACE_PARABOLOID) { /* z = rho^2 / (2 R): axis - (part across the axis) / R */
        add_scaled3(d, -dot3(d, s->axis), s->axis, d);
        add_scaled3(s->axis, -1.0 / s->radius_m, d, d);
    }
    unit3(d, out);
    if (dot3(out, f->normal) < 0.0) scale3(out, -1.0, out);
}

static double triangle_area(const double a[2], const double b[2], const double c[2])
{
    return 0.5 * fabs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

/* The matter below a triangle a, b, c of the facet's polygon, m^2, where its density is 1. */
static double density_area(const facet_list *list, const facet *f, int b, int c,
                           const curved_piece *piece)
{
    const curved_surface *s = &list->surfaces[f->surface - 1];
    if (s->kind != SURFACE_SMOOTH)
        return s->radius_m * s->radius_m *
               triangle_area(piece->corner[0], piece->corner[1], piece->corner[2]);
    const double(*v)[3] = list->vertices + f->first_vertex;
    double ab[3], ac[3], across[3];
    sub3(v[b], v[0], ab);
    sub3(v[c], v[0], ac);
    cross3(ab, ac, across);
    return 0.5 * norm3(across);
}

static bool stands_for_all(const facet_list *list, const facet *f)
{
    for (int v = 0; v < f->n_vertices; v++) {
        double normal[3];
        normal_at(list, f, v, normal);
        if (!(dot3(normal, f->normal) >= LEAST_COSINE)) return false;
    }
    return true;
}

static void slope_at(const facet_list *list, const facet *f, int v, double out[2])
{
    double normal[3], across[3];
    normal_at(list, f, v, normal);
    cross3(f->normal, f->tangent, across);
    const double c = dot3(normal, f->normal);
    out[0] = dot3(normal, f->tangent) / c;
    out[1] = dot3(normal, across) / c;
}

/* Triangles of slopes, a fan over the polygon. What curves both ways shows its area in its normals:
 * on a sphere dA = r^2 dw, on a paraboloid R^2 dw / cos^4 of the angle from the axis (its Gaussian
 * curvature is cos^4 / R^2); over slopes dw = dx dy / (1 + x^2 + y^2)^(3/2). A SMOOTH facet's area
 * is its own. */
static glint_status add_triangles(maker *m, const facet *f)
{
    const curved_surface *s = &m->list->surfaces[f->surface - 1];
    curved_piece piece = {.kind = s->kind};
    double across[3];
    cross3(f->normal, f->tangent, across);
    piece.view[0] = dot3(s->axis, f->tangent);
    piece.view[1] = dot3(s->axis, across);
    piece.view[2] = dot3(s->axis, f->normal);
    if (!stands_for_all(m->list, f)) return GLINT_OK;
    slope_at(m->list, f, 0, piece.corner[0]);
    slope_at(m->list, f, 1, piece.corner[2]);
    for (int v = 2; v < f->n_vertices; v++) {
        memcpy(piece.corner[1], piece.corner[2], sizeof piece.corner[1]);
        slope_at(m->list, f, v, piece.corner[2]);
        piece.area_m2 = density_area(m->list, f, v - 1, v, &piece);
        const glint_status status = add_piece(m, &piece);
        if (status) return status;
    }
    return GLINT_OK;
}

/* The largest angle of a vertex about the axis from a radial direction, rad. */
static double half_angle(const facet_list *list, const facet *f, const curved_surface *s,
                         const double radial[3])
{
    double sideways[3], most = 0.0, size_m = 0.0;
    cross3(s->axis, radial, sideways);
    for (int v = 0; v < f->n_vertices; v++)
        for (int pass = 0; pass < 2; pass++) {
            double d[3];
            sub3(list->vertices[f->first_vertex + v], s->centre_m, d);
            const double x = dot3(d, radial), y = dot3(d, sideways);
            if (pass == 0)
                size_m = fmax(size_m, hypot(x, y));
            else if (hypot(x, y) > 1e-9 * size_m) /* the tip of a cone has no angle */
                most = fmax(most, fabs(atan2(y, x)));
        }
    return most;
}

/* The arc of a cone or cylinder. The flat facet is narrower than the piece of cone: its sides are
 * chords, sin a for a, and it leans more steeply than the cone by the ratio of the cosines. */
static glint_status add_arc(maker *m, const facet *f)
{
    const curved_surface *s = &m->list->surfaces[f->surface - 1];
    double mean[3] = {0, 0, 0}, radial[3], d[3];
    for (int v = 0; v < f->n_vertices; v++) {
        sub3(m->list->vertices[f->first_vertex + v], s->centre_m, d);
        add3(mean, d, mean);
    }
    perp3(mean, s->axis, radial);
    const double side = dot3(radial, f->normal) < 0.0 ? -1.0 : 1.0; /* -1: the inside */
    const double a = half_angle(m->list, f, s, radial), upright = sqrt(1.0 - s->lean * s->lean);
    curved_piece piece = {.kind = SURFACE_CONE, .end = tan(0.5 * a)};
    piece.area_m2 = f->area_m2 * (a / sin(a)) * (fabs(dot3(radial, f->normal)) / upright);
    double *t = piece.frame, *b = piece.frame + 3, *n = piece.frame + 6;
    scale3(radial, side * upright, n);
    add_scaled3(n, side * s->lean, s->axis, n);
    perp3(f->tangent, n, t);
    cross3(n, t, b);
    mat_vec(piece.frame, s->axis, piece.axis);
    piece.off[0] = dot3(t, f->normal) / dot3(n, f->normal);
    piece.off[1] = dot3(b, f->normal) / dot3(n, f->normal);
    return add_piece(m, &piece);
}

static glint_status add_pieces(maker *m)
{
    for (int k = 0; k < m->out->n; k++) {
        const facet *f = &m->list->items[m->first + k];
        glint_status status = GLINT_OK;
        if (facet_is_curved(m->list, f))
            status = m->list->surfaces[f->surface - 1].kind == SURFACE_CONE ? add_arc(m, f)
                                                                            : add_triangles(m, f);
        if (status) return status;
        m->out->first_piece[k + 1] = m->n_pieces;
    }
    return GLINT_OK;
}

/* --- where it matters --- */

/* How far, in widths of the lobe, the normals of a piece go from its middle. */
static double piece_extent(const curved_piece *p, const double width[2])
{
    if (p->kind == SURFACE_CONE)
        return 2.0 * atan(p->end) * hypot(p->axis[1] / width[0], p->axis[0] / width[1]);
    double most = 0.0;
    for (int c = 0; c < 3; c++)
        most = fmax(most, hypot(p->corner[c][0] / width[0], p->corner[c][1] / width[1]));
    return most;
}

static double facet_extent(const curved_span *span, int k, const double width[2])
{
    double most = 0.0;
    for (int p = span->first_piece[k]; p < span->first_piece[k + 1]; p++)
        most = fmax(most, piece_extent(&span->pieces[p], width));
    return most;
}

/* Whether the normal of facet k alone will not do for a lobe of those widths: because there are
 * many, or because a cone leans otherwise than its facets do, which moves its highlight as a whole.
 */
static bool is_large(const curved_span *span, int k, const double width[2])
{
    if (facet_extent(span, k, width) > CURVED_ACTIVE) return true;
    for (int p = span->first_piece[k]; p < span->first_piece[k + 1]; p++) {
        const curved_piece *piece = &span->pieces[p];
        if (hypot(piece->off[0] / width[0], piece->off[1] / width[1]) > CURVED_OFF) return true;
    }
    return false;
}

/* Fills in where the facets are large against a lobe. All of a span are integrated near the
 * highlight, or none: a mean over one facet and the value in the middle of its neighbour do not
 * make up for each other's errors. */
static glint_status look_at_lobe(const curved_span *span, const brdf_lobe *lobe, curved_lobe *out,
                                 glint_error *error)
{
    lobe_shape shape;
    lobe_shape_find(lobe, &shape);
    for (int j = 0; j < 2; j++)
        out->width[j] = shape.specular ? CURVED_MIRROR_WIDTH : shape.width[j];
    out->reach = shape.reach;
    for (int k = 0; k < span->n && !out->active; k++)
        out->active = is_large(span, k, out->width);
    if (!out->active || lobe->weight == 0.0) return GLINT_OK;
    out->extent = malloc((size_t)span->n * sizeof *out->extent);
    if (!out->extent) return error_no_memory(error);
    for (int k = 0; k < span->n; k++)
        out->extent[k] = facet_extent(span, k, out->width);
    return GLINT_OK;
}

static glint_status look_at_lobes(curved_span *span, const brdf_material *bands, const int *same,
                                  glint_error *error)
{
    for (int b = 0; b < span->n_bands; b++)
        span->first_lobe[b + 1] = span->first_lobe[b] + (same[b] < b ? 0 : bands[b].n_lobes);
    span->lobes = calloc((size_t)span->first_lobe[span->n_bands] + 1, sizeof *span->lobes);
    if (!span->lobes) return error_no_memory(error);
    for (int b = 0; b < span->n_bands; b++)
        for (int k = span->first_lobe[b]; k < span->first_lobe[b + 1]; k++) {
            const brdf_lobe *lobe = &bands[b].lobes[k - span->first_lobe[b]];
            const glint_status status = look_at_lobe(span, lobe, &span->lobes[k], error);
            if (status) return status;
        }
    return GLINT_OK;
}

static bool is_active(const curved_span *span)
{
    for (int k = 0; k < span->first_lobe[span->n_bands]; k++)
        if (span->lobes[k].active) return true;
    return false;
}

static bool has_curved(const facet_list *list, int first, int n)
{
    for (int k = first; k < first + n; k++)
        if (facet_is_curved(list, &list->items[k])) return true;
    return false;
}

glint_status curved_span_make(const facet_list *list, int first, int n, const brdf_material *bands,
                              const int *same, int n_bands, curved_span **out, glint_error *error)
{
    *out = NULL;
    if (!has_curved(list, first, n)) return GLINT_OK;
    curved_span *span = calloc(1, sizeof *span);
    if (!span) return error_no_memory(error);
    *span = (curved_span){.n = n, .n_bands = n_bands};
    span->first_piece = calloc((size_t)n + 1, sizeof *span->first_piece);
    span->first_lobe = calloc((size_t)n_bands + 1, sizeof *span->first_lobe);
    maker m = {list, first, span, 0, 0, error};
    glint_status status =
        span->first_piece && span->first_lobe ? add_pieces(&m) : error_no_memory(error);
    if (!status) status = look_at_lobes(span, bands, same, error);
    if (!status && is_active(span))
        *out = span;
    else
        curved_span_free(span);
    return status;
}

void curved_span_free(curved_span *span)
{
    if (!span) return;
    for (int k = 0; span->lobes && k < span->first_lobe[span->n_bands]; k++)
        free(span->lobes[k].extent);
    free(span->lobes);
    free(span->first_lobe);
    free(span->pieces);
    free(span->first_piece);
    free(span);
}
