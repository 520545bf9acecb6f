#include "facets/solids.h"

#include "base/constants.h"
#include "base/vec.h"
#include "facets/weld.h"

#include <stdint.h>
#include <stdlib.h>

/* How far a convex body may bulge inwards, over its size: what is left of coordinates that were
 * computed or written with 10 digits. Outlines are wrong by no more. */
#define DENT 1e-10
/* Angle below which two facets at one edge lie on each other, rad. */
#define FOLDED_RAD 1e-6
/* The solid angle that a star-shaped body fills is 4 pi, a multiple of that where it is wound
 * around more than once: any tolerance between rounding and 4 pi will do. */
#define SOLID_ANGLE_TOLERANCE 1e-3

/* Where more facets than this meet at an edge, none of them has a partner there: finding partners
 * takes the square of their number. Hubs of real bodies have some tens at most. */
enum { MOST_AT_EDGE = 64 };

/* One edge of one facet. */
typedef struct half_edge {
    int low, high; /* its vertices by number */
    bool rising;   /* the facet runs from low to high */
    int facet;
} half_edge;

/* What is needed on the way. */
typedef struct finder {
    const model *m;
    solids *out;
    half_edge *halves; /* owned */
    int n_halves;
    solid_edge *edges; /* owned; as found */
    int n_edges;
    int *root;      /* owned; union-find over the facets */
    int *open_ends; /* owned; edges of each facet that have no partner */
    int *solid_of;  /* owned; of each facet, by its root while they are counted */
} finder;

/* --- corners --- */

/* Joins corners that are the same vertex; each component's stand side by side. */
static glint_status weld(const model *m, solids *out, glint_error *error)
{
    const facet_list *polygons = &m->polygons;
    int *corners = out->corners;
    for (int k = 0, next; k < m->n_facets; k = next) {
        const facet *f = &polygons->items[k];
        next = k + 1;
        while (next < m->n_facets && polygons->items[next].component == f->component)
            next++;
        const facet *last = &polygons->items[next - 1];
        const int first = f->first_vertex, n = last->first_vertex + last->n_vertices - first;
        const glint_status status =
            weld_vertices(polygons->vertices + first, n, corners + first, error);
        if (status) return status;
        for (int c = first; c < first + n; c++) {
            if (corners[c] < c - first) { /* an earlier vertex has its number already */
                corners[c] = corners[first + corners[c]];
                continue;
            }
            copy3(polygons->vertices[c], out->vertices[out->n_vertices]);
            corners[c] = out->n_vertices++;
        }
    }
    return GLINT_OK;
}

static const double *corner_at(const finder *f, int facet_index, int corner)
{
    const facet *polygon = &f->m->polygons.items[facet_index];
    return f->out->vertices[f->out->corners[polygon->first_vertex + corner]];
}

/* --- edges --- */

static void list_halves(finder *f)
{
    for (int k = 0; k < f->m->n_facets; k++) {
        const facet *polygon = &f->m->polygons.items[k];
        const int *ring = f->out->corners + polygon->first_vertex;
        for (int v = 0; v < polygon->n_vertices; v++) {
            const int from = ring[v], to = ring[(v + 1) % polygon->n_vertices];
            if (from == to) continue; /* shorter than the distance at which vertices are one */
            const bool rising = from < to;
            f->halves[f->n_halves++] =
                (half_edge){rising ? from : to, rising ? to : from, rising, k};
        }
    }
}

static int compare_halves(const void *a, const void *b)
{
    const half_edge *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    if (p->high != q->high) return p->high < q->high ? -1 : 1;
    return (p->facet > q->facet) - (p->facet < q->facet);
}

/* The direction in the facet's plane that points away from the edge, into the facet. */
static void inwards(const finder *f, const half_edge *h, double out[3])
{
    double along[3];
    sub3(f->out->vertices[h->high], f->out->vertices[h->low], along);
    cross3(f->m->polygons.items[h->facet].normal, along, out);
    if (!h->rising) scale3(out, -1.0, out);
}

/* The angle of the wedge of matter between a facet and another at the same edge, 0 to 2 pi: turned
 * from the one through its inner side to the other. */
static double wedge(const finder *f, const half_edge *a, const half_edge *b)
{
    double from[3], to[3];
    inwards(f, a, from);
    inwards(f, b, to);
    const double depth = -dot3(to, f->m->polygons.items[a->facet].normal) * norm3(from);
    const double angle = atan2(depth, dot3(from, to));
    return angle > FOLDED_RAD ? angle : angle + TWO_PI;
}

/* Which of the n halves of one edge bounds the thinnest wedge with half k, running the other way;
 * -1 for none. */
static int partner(const finder *f, const half_edge *halves, int n, int k)
{
    int best = -1;
    double thinnest = INFINITY;
    for (int j = 0; j < n; j++) {
        if (halves[j].rising == halves[k].rising || halves[j].facet == halves[k].facet) continue;
        const double angle = n == 2 ? 0.0 : wedge(f, &halves[k], &halves[j]);
        if (angle >= thinnest) continue;
        thinnest = angle;
        best = j;
    }
    return best;
}

static int root_of(int *root, int k)
{
    while (root[k] != k)
        k = root[k] = root[root[k]];
    return k;
}

/* Links the facets that meet at one edge. */
static void link_edge(finder *f, const half_edge *halves, int n)
{
    const bool any = n <= MOST_AT_EDGE;
    for (int k = 0; k < n; k++) {
        const half_edge *own = &halves[k];
        const int j = any ? partner(f, halves, n, k) : -1;
        if (j < 0 || partner(f, halves, n, j) != k) {
            f->open_ends[own->facet]++;
            continue;
        }
        if (!own->rising) continue; /* once per pair */
        f->edges[f->n_edges++] = (solid_edge){own->low, own->high, own->facet, halves[j].facet};
        const int a = root_of(f->root, own->facet), b = root_of(f->root, halves[j].facet);
        f->root[a > b ? a : b] = a > b ? b : a;
    }
}

static void link_edges(finder *f)
{
    for (int k = 0; k < f->m->n_facets; k++)
        f->root[k] = k;
    list_halves(f);
    qsort(f->halves, (size_t)f->n_halves, sizeof *f->halves, compare_halves);
    for (int k = 0, next; k < f->n_halves; k = next) {
        next = k + 1;
        while (next < f->n_halves && f->halves[next].low == f->halves[k].low &&
               f->halves[next].high == f->halves[k].high)
            next++;
        link_edge(f, f->halves + k, next - k);
    }
}

/* --- solids --- */

/* Numbers the solids in the order of their first facets, and sorts facets and edges by them. A root
 * is the first facet of its solid. */
static void group(finder *f)
{
    solids *out = f->out;
    for (int k = 0; k < f->m->n_facets; k++) {
        const int root = root_of(f->root, k);
        if (root == k)
            out->items[out->n] =
                (solid){.component = f->m->polygons.items[k].component, .kind = SOLID_OPEN};
        f->solid_of[k] = root == k ? out->n++ : f->solid_of[root];
        out->items[f->solid_of[k]].n_facets++;
    }
    for (int e = 0; e < f->n_edges; e++)
        out->items[f->solid_of[f->edges[e].left]].n_edges++;
    for (int s = 1; s < out->n; s++) {
        const solid *before = &out->items[s - 1];
        out->items[s].first_facet = before->first_facet + before->n_facets;
        out->items[s].first_edge = before->first_edge + before->n_edges;
    }
    for (int s = 0; s < out->n; s++)
        out->items[s].n_facets = out->items[s].n_edges = 0;
    for (int k = 0; k < f->m->n_facets; k++) {
        solid *s = &out->items[f->solid_of[k]];
        out->facets[s->first_facet + s->n_facets++] = k;
    }
    for (int e = 0; e < f->n_edges; e++) {
        solid *s = &out->items[f->solid_of[f->edges[e].left]];
        out->edges[s->first_edge + s->n_edges++] = f->edges[e];
    }
    out->n_edges = f->n_edges;
}

static bool is_closed(const finder *f, const solid *s)
{
    for (int k = 0; k < s->n_facets; k++)
        if (f->open_ends[f->out->facets[s->first_facet + k]] > 0) return false;
    return true;
}

/* Mean of the corners, and the greatest distance of one from it. */
static double centre_of(const finder *f, const solid *s, double centre_m[3])
{
    double sum[3] = {0, 0, 0}, d[3], most = 0.0;
    long n = 0;
    for (int k = 0; k < s->n_facets; k++) {
        const int own = f->out->facets[s->first_facet + k];
        for (int v = 0; v < f->m->polygons.items[own].n_vertices; v++, n++)
            add3(sum, corner_at(f, own, v), sum);
    }
    scale3(sum, 1.0 / (double)n, centre_m);
    for (int k = 0; k < s->n_facets; k++) {
        const int own = f->out->facets[s->first_facet + k];
        for (int v = 0; v < f->m->polygons.items[own].n_vertices; v++) {
            sub3(corner_at(f, own, v), centre_m, d);
            most = fmax(most, dot3(d, d));
        }
    }
    return sqrt(most);
}

/* What a solid looks like from a point: the sum over its facets, in triangles. */
typedef struct fullness {
    double volume_m3;   /* signed */
    double solid_angle; /* sr, signed */
} fullness;

/* Solid angle of a triangle: Van Oosterom and Strackee 1983, IEEE Trans. Biomed. Eng. 30(2) 125. */
static fullness fullness_from(const finder *f, const solid *s, const double from_m[3])
{
    fullness sum = {0.0, 0.0};
    for (int k = 0; k < s->n_facets; k++) {
        const int own = f->out->facets[s->first_facet + k];
        double a[3], b[3], c[3], cross[3];
        sub3(corner_at(f, own, 0), from_m, a);
        sub3(corner_at(f, own, 1), from_m, b);
        for (int v = 2; v < f->m->polygons.items[own].n_vertices; v++) {
            sub3(corner_at(f, own, v), from_m, c);
            cross3(b, c, cross);
            const double six_volumes = dot3(a, cross);
            const double la = norm3(a), lb = norm3(b), lc = norm3(c);
            sum.volume_m3 += six_volumes / 6.0;
            sum.solid_angle += 2.0 * atan2(six_volumes, la * lb * lc + dot3(a, b) * lc +
                                                            dot3(b, c) * la + dot3(c, a) * lb);
            copy3(c, b);
        }
    }
    return sum;
}

/* Height of a point over a facet's plane. */
static double height_over(const finder *f, int facet_index, const double p[3])
{
    double d[3];
    sub3(p, corner_at(f, facet_index, 0), d);
    return dot3(d, f->m->polygons.items[facet_index].normal);
}

/* True when no facet rises over a neighbour's plane by more than that. */
static bool bends_outwards(const finder *f, const solid *s, double dent_m)
{
    for (int e = s->first_edge; e < s->first_edge + s->n_edges; e++) {
        const solid_edge *edge = &f->out->edges[e];
        for (int v = 0; v < f->m->polygons.items[edge->right].n_vertices; v++)
            if (height_over(f, edge->left, corner_at(f, edge->right, v)) > dent_m) return false;
    }
    return true;
}

static bool looks_outwards(const finder *f, const solid *s, const double centre_m[3], double dent_m)
{
    for (int k = 0; k < s->n_facets; k++)
        if (!(height_over(f, f->out->facets[s->first_facet + k], centre_m) < -dent_m)) return false;
    return true;
}

/* A closed surface is convex when all of it faces away from one point and surrounds that once, so
 * that it is the boundary of a star-shaped body, and bends outwards at every edge: a body that is
 * convex everywhere near its boundary is convex (Tietze 1928, Nakajima 1928). */
static solid_kind kind_of(const finder *f, const solid *s)
{
    if (!is_closed(f, s)) return SOLID_OPEN;
    if (s->n_facets == 2) return SOLID_SHEET;
    double centre_m[3];
    const double size_m = centre_of(f, s, centre_m), dent_m = DENT * size_m;
    const fullness full = fullness_from(f, s, centre_m);
    if (full.volume_m3 < -DENT * size_m * size_m * size_m) return SOLID_OPEN;
    const bool once = fabs(full.solid_angle - 2.0 * TWO_PI) < SOLID_ANGLE_TOLERANCE;
    const bool convex =
        once && looks_outwards(f, s, centre_m, dent_m) && bends_outwards(f, s, dent_m);
    return convex ? SOLID_CONVEX : SOLID_CLOSED;
}

static bool allocate(finder *f)
{
    const size_t n_facets = (size_t)f->m->n_facets, n = (size_t)f->m->polygons.n_vertices;
    solids *out = f->out;
    out->vertices = malloc(n * sizeof *out->vertices);
    out->corners = malloc(n * sizeof *out->corners);
    out->items = malloc(n_facets * sizeof *out->items);
    out->facets = malloc(n_facets * sizeof *out->facets);
    out->edges = malloc(n * sizeof *out->edges);
    f->halves = malloc(n * sizeof *f->halves);
    f->edges = malloc(n * sizeof *f->edges);
    f->root = malloc(n_facets * sizeof *f->root);
    f->open_ends = calloc(n_facets, sizeof *f->open_ends);
    f->solid_of = malloc(n_facets * sizeof *f->solid_of);
    return out->vertices && out->corners && out->items && out->facets && out->edges && f->halves &&
           f->edges && f->root && f->open_ends && f->solid_of;
}

glint_status solids_find(const model *m, solids *out, glint_error *error)
{
    *out = (solids){0};
    finder f = {.m = m, .out = out};
    glint_status status = allocate(&f) ? GLINT_OK : error_no_memory(error);
    if (!status) status = weld(m, out, error);
    if (!status) {
        link_edges(&f);
        group(&f);
        for (int s = 0; s < out->n; s++)
            out->items[s].kind = kind_of(&f, &out->items[s]);
    }
    free(f.halves);
    free(f.edges);
    free(f.root);
    free(f.open_ends);
    free(f.solid_of);
    if (status) solids_free(out);
    return status;
}

void solids_free(solids *s)
{
    if (!s) return;
    free(s->vertices);
    free(s->corners);
    free(s->items);
    free(s->facets);
    free(s->edges);
    *s = (solids){0};
}
