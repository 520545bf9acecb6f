#include "facets/mesh_merge.h"

#include "base/vec.h"
#include "facets/mesh_mend.h"

#include <stdlib.h>

typedef struct mean_plane {
    double normal_sum[3], point_sum[3], weight;
    double normal[3], point[3]; /* unit; in it */
} mean_plane;

/* Polygons as rings of half-edges. Half-edge 3 f + j begins as the side of face f from corner j. */
typedef struct merger {
    const mesh *mesh;
    const int *group;           /* borrowed; of the faces */
    const double (*normals)[3]; /* borrowed */
    double flat_m;
    int *twin, *next, *before; /* owned; of half-edges. next -1: it is gone */
    int *region;               /* owned; of faces: the first face of those in its plane */
    int *queue;                /* owned; n_faces: faces of one region */
    int *edges;                /* owned; half-edges of one region, or of one ring */
    int *uses;                 /* owned; by vertex: corners of polygons there */
    mean_plane plane;          /* of the region */
} merger;

static int vertex_of(const merger *g, int h)
{
    return g->mesh->faces[h / 3].corner[h % 3];
}

static const double *point_of(const merger *g, int h)
{
    return g->mesh->vertices[vertex_of(g, h)];
}

/* --- planes --- */

/* Cross product of two sides of a face: along its normal, twice its area long. */
static void across_of(const merger *g, int face, double out[3])
{
    double ab[3], ac[3];
    sub3(point_of(g, 3 * face + 1), point_of(g, 3 * face), ab);
    sub3(point_of(g, 3 * face + 2), point_of(g, 3 * face), ac);
    cross3(ab, ac, out);
}

/* By how much the normal of a face may be off its plane, rad: corners are only known to flat_m,
 * which tilts a low triangle. */
static double tilt_allowed(const merger *g, int face)
{
    static const double MOST = 3e-4; /* rad */
    double longest2 = 0.0, across[3];
    for (int j = 0; j < 3; j++) {
        double side[3];
        sub3(point_of(g, 3 * face + (j + 1) % 3), point_of(g, 3 * face + j), side);
        longest2 = fmax(longest2, dot3(side, side));
    }
    across_of(g, face, across);
    const double height_m = norm3(across) / sqrt(longest2);
    return MERGE_ANGLE_RAD + fmin(MOST, 2.0 * g->flat_m / height_m);
}

/* The mean plane of a region: sums over its faces, weighted by their area. */
static void plane_add(mean_plane *p, const merger *g, int face)
{
    double across[3];
    across_of(g, face, across);
    const double weight = norm3(across);
    add3(p->normal_sum, across, p->normal_sum);
    for (int j = 0; j < 3; j++)
        add_scaled3(p->point_sum, weight / 3.0, point_of(g, 3 * face + j), p->point_sum);
    p->weight += weight;
    unit3(p->normal_sum, p->normal);
    scale3(p->point_sum, 1.0 / p->weight, p->point);
}

static bool touches_plane(const merger *g, int face, const mean_plane *p)
{
    for (int j = 0; j < 3; j++) {
        double d[3];
        sub3(point_of(g, 3 * face + j), p->point, d);
        if (fabs(dot3(d, p->normal)) > g->flat_m) return false;
    }
    return true;
}

/* The faces that hang together with `seed` in its plane, or in their mean plane, which is written
 * to g->plane; they stand in the queue. Returns how many. */
static int flood(merger *g, int seed, bool mean)
{
    int n = 0;
    g->plane = (mean_plane){0};
    plane_add(&g->plane, g, seed);
    g->region[seed] = seed;
    g->queue[n++] = seed;
    for (int k = 0; k < n && g->group[seed] >= 0; k++)
        for (int j = 0; j < 3; j++) {
            const int twin = g->twin[3 * g->queue[k] + j];
            if (twin < 0) continue;
            const int other = twin / 3;
            if (g->region[other] >= 0 || g->group[other] != g->group[seed] ||
                angle3(g->normals[other], g->plane.normal) > tilt_allowed(g, other) ||
                !touches_plane(g, other, &g->plane))
                continue;
            g->region[other] = seed;
            g->queue[n++] = other;
            if (mean) plane_add(&g->plane, g, other);
        }
    return n;
}

/* As flood: in the mean plane where all faces found lie in it in the end, too. */
static int find_region(merger *g, int seed)
{
    const int n = flood(g, seed, true);
    bool flat = true;
    for (int k = 0; k < n && flat; k++)
        flat = touches_plane(g, g->queue[k], &g->plane);
    if (flat) return n;
    for (int k = 0; k < n; k++)
        g->region[g->queue[k]] = -1;
    return flood(g, seed, false);
}

/* --- joining --- */

/* True when a polygon that runs over `at` from the corner before to the one after is convex there.
 */
static bool turns_left(const merger *g, int before, int at, int after, const double normal[3])
{
    double in[3], on[3], chord[3], c[3];
    sub3(point_of(g, at), point_of(g, before), in);
    sub3(point_of(g, after), point_of(g, at), on);
    add3(in, on, chord);
    cross3(in, on, c);
    const double left = dot3(c, normal), long_m = norm3(chord);
    if (left < -g->flat_m * long_m) return false;
    return dot3(in, on) > 0.0 || left > g->flat_m * long_m; /* else it goes back on itself */
}

/* Joins the polygons on both sides of half-edge h where that makes a convex one. What they share
 * may be several sides in a row: all of them go. */
static void join(merger *g, int h, const double normal[3])
{
    int first = h, first_twin = g->twin[h], last = h, last_twin = g->twin[h];
    while (g->twin[g->before[first]] == g->next[first_twin] && g->before[first] != last) {
        first = g->before[first];
        first_twin = g->next[first_twin];
    }
    while (g->twin[g->next[last]] == g->before[last_twin] && g->next[last] != first) {
        last = g->next[last];
        last_twin = g->before[last_twin];
    }
    /* The ends of the chain: over `first`'s origin the new ring runs from before(first) to
     * next(first_twin), over the end of `last` from before(last_twin) to next(last). */
    const int in = g->before[first], on = g->next[first_twin];
    const int in2 = g->before[last_twin], on2 = g->next[last];
    if (in == last || in2 == first_twin) return; /* one polygon within the other */
    if (!turns_left(g, in, on, g->next[on], normal) ||
        !turns_left(g, in2, on2, g->next[on2], normal))
        return;
    for (int e = first, gone = 0; !gone;) {
        const int after = g->next[e], twin = g->twin[e];
        gone = e == last;
        g->next[e] = g->next[twin] = -1;
        e = after;
    }
    g->next[in] = on, g->before[on] = in;
    g->next[in2] = on2, g->before[on2] = in2;
}

/* Runs along the sides of a region that no other of its faces shares, after a side about its end
 * from face to face until the next one; they stand in g->edges. n: faces in the queue. Returns how
 * many there are, or 0 where they are not one ring. */
static int walk_rim(merger *g, int n, int seed)
{
    int n_rim = 0, start = -1, met = 0;
    for (int k = 0; k < n; k++)
        for (int j = 0; j < 3; j++) {
            const int h = 3 * g->queue[k] + j, twin = g->twin[h];
            if (twin >= 0 && g->region[twin / 3] == seed) continue;
            start = h;
            n_rim++;
        }
    if (start < 0) return 0;
    for (int h = start; met == 0 || h != start; met++) {
        if (met == n_rim) return 0;
        int on = 3 * (h / 3) + (h % 3 + 1) % 3;
        for (int turns = 0; g->twin[on] >= 0 && g->region[g->twin[on] / 3] == seed; turns++) {
            if (turns > 3 * n) return 0;
            const int across = g->twin[on];
            on = 3 * (across / 3) + (across % 3 + 1) % 3;
        }
        g->edges[met] = h;
        h = on;
    }
    return met == n_rim ? met : 0; /* else there are holes */
}

/* True when the first `met` of g->edges turn left all along, and about themselves once. */
static bool is_convex_ring(const merger *g, int met)
{
    double turned = 0.0;
    for (int k = 0; k < met; k++) {
        const int before = g->edges[k], at = g->edges[(k + 1) % met],
                  after = g->edges[(k + 2) % met];
        if (!turns_left(g, before, at, after, g->plane.normal)) return false;
        double in[3], on[3], c[3];
        sub3(point_of(g, at), point_of(g, before), in);
        sub3(point_of(g, after), point_of(g, at), on);
        cross3(in, on, c);
        turned += atan2(dot3(c, g->plane.normal), dot3(in, on));
    }
    return turned < 9.0; /* 2 pi is one revolution */
}

/* True when the rim of a region is one convex ring; links it then, and drops the other sides. */
static bool join_all(merger *g, int n, int seed)
{
    const int met = walk_rim(g, n, seed);
    if (met == 0 || !is_convex_ring(g, met)) return false;
    for (int k = 0; k < n; k++)
        for (int j = 0; j < 3; j++)
            g->next[3 * g->queue[k] + j] = -1;
    for (int k = 0; k < met; k++) {
        g->next[g->edges[k]] = g->edges[(k + 1) % met];
        g->before[g->edges[(k + 1) % met]] = g->edges[k];
    }
    return true;
}

/* A shared side and its length, to begin with the longest: the diagonals of what was cut up. */
typedef struct shared_side {
    double length2;
    int half_edge;
} shared_side;

static int compare_sides(const void *a, const void *b)
{
    const shared_side *p = a, *q = b;
    if (p->length2 != q->length2) return p->length2 > q->length2 ? -1 : 1;
    return (p->half_edge > q->half_edge) - (p->half_edge < q->half_edge);
}

static glint_status join_some(merger *g, int n, int seed, glint_error *error)
{
    shared_side *sides = malloc(3 * (size_t)n * sizeof *sides);
    if (!sides) return error_no_memory(error);
    int n_sides = 0;
    for (int k = 0; k < n; k++)
        for (int j = 0; j < 3; j++) {
            const int h = 3 * g->queue[k] + j, twin = g->twin[h];
            if (twin < h || g->region[twin / 3] != seed) continue; /* once; -1: none */
            double d[3];
            sub3(point_of(g, h), point_of(g, twin), d);
            sides[n_sides++] = (shared_side){dot3(d, d), h};
        }
    qsort(sides, (size_t)n_sides, sizeof *sides, compare_sides);
    for (int k = 0; k < n_sides; k++)
        if (g->next[sides[k].half_edge] >= 0) join(g, sides[k].half_edge, g->plane.normal);
    free(sides);
    return GLINT_OK;
}

static glint_status join_regions(merger *g, glint_error *error)
{
    for (int f = 0; f < g->mesh->n_faces; f++) {
        if (g->region[f] >= 0) continue;
        const int n = find_region(g, f);
        if (n == 1 || join_all(g, n, f)) continue;
        const glint_status status = join_some(g, n, f, error);
        if (status) return status;
    }
    return GLINT_OK;
}

/* --- corners --- */

/* True when the ring goes straight on at the origin of h, and is no triangle. */
static bool is_straight(const merger *g, int h)
{
    const int before = g->before[h], after = g->next[h];
    if (g->next[after] == before || g->group[h / 3] < 0) return false;
    double in[3], chord[3], across[3];
    sub3(point_of(g, h), point_of(g, before), in);
    sub3(point_of(g, after), point_of(g, before), chord);
    cross3(in, chord, across);
    const double long2 = dot3(chord, chord), along = dot3(in, chord);
    return dot3(across, across) <= g->flat_m * g->flat_m * long2 && along > 0.0 && along < long2;
}

static void drop_corner(merger *g, int h)
{
    /* The half-edge before takes over the way to the next corner. */
    g->next[g->before[h]] = g->next[h];
    g->before[g->next[h]] = g->before[h];
    g->next[h] = -1;
}

/* Drops corners where a ring goes straight on: of an open side, or of two polygons that meet there
 * alone and along the same line. */
static void drop_straight_corners(merger *g)
{
    const int n = 3 * g->mesh->n_faces;
    for (int h = 0; h < n; h++)
        if (g->next[h] >= 0) g->uses[vertex_of(g, h)]++;
    for (int h = 0; h < n; h++) {
        if (g->next[h] < 0 || !is_straight(g, h)) continue;
        const int uses = g->uses[vertex_of(g, h)];
        if (uses == 1) {
            drop_corner(g, h);
            continue;
        }
        const int other = g->twin[g->before[h]]; /* begins here, if it is still there */
        if (uses != 2 || other < 0 || g->next[other] < 0 ||
            vertex_of(g, other) != vertex_of(g, h) || !is_straight(g, other) ||
            vertex_of(g, g->next[other]) != vertex_of(g, g->before[h]) ||
            vertex_of(g, g->before[other]) != vertex_of(g, g->next[h]))
            continue;
        /* what comes before each then runs along the whole side: they are each other's twins */
        const int a = g->before[h], b = g->before[other];
        drop_corner(g, h);
        drop_corner(g, other);
        g->twin[a] = b;
        g->twin[b] = a;
    }
}

/* --- result --- */

static glint_status collect(const merger *g, mesh_polygons *out, glint_error *error)
{
    const int n = 3 * g->mesh->n_faces;
    bool *done = calloc((size_t)n, sizeof *done);
    out->first = malloc(((size_t)g->mesh->n_faces + 1) * sizeof *out->first);
    out->face = malloc((size_t)g->mesh->n_faces * sizeof *out->face);
    out->corner = malloc((size_t)n * sizeof *out->corner);
    if (!done || !out->first || !out->face || !out->corner) {
        free(done);
        return error_no_memory(error);
    }
    int n_corners = 0;
    out->first[0] = 0;
    for (int h = 0; h < n; h++) {
        if (g->next[h] < 0 || done[h]) continue;
        for (int at = h; !done[at]; at = g->next[at]) {
            done[at] = true;
            out->corner[n_corners++] = vertex_of(g, at);
        }
        out->face[out->n++] = h / 3;
        out->first[out->n] = n_corners;
    }
    free(done);
    return GLINT_OK;
}

void mesh_polygons_free(mesh_polygons *p)
{
    if (!p) return;
    free(p->first);
    free(p->corner);
    free(p->face);
    *p = (mesh_polygons){0};
}

static bool allocate(merger *g)
{
    const size_t n_faces = (size_t)g->mesh->n_faces, n = 3 * n_faces;
    g->twin = malloc(n * sizeof *g->twin);
    g->next = malloc(n * sizeof *g->next);
    g->before = malloc(n * sizeof *g->before);
    g->edges = malloc(n * sizeof *g->edges);
    g->region = malloc(n_faces * sizeof *g->region);
    g->queue = malloc(n_faces * sizeof *g->queue);
    g->uses = calloc((size_t)g->mesh->n_vertices, sizeof *g->uses);
    return g->twin && g->next && g->before && g->edges && g->region && g->queue && g->uses;
}

static void start_rings(merger *g)
{
    for (int h = 0; h < 3 * g->mesh->n_faces; h++) {
        g->next[h] = 3 * (h / 3) + (h % 3 + 1) % 3;
        g->before[h] = 3 * (h / 3) + (h % 3 + 2) % 3;
    }
    for (int f = 0; f < g->mesh->n_faces; f++)
        g->region[f] = -1;
}

glint_status mesh_merge(const mesh *m, const int *group, const double (*normals)[3], double flat_m,
                        mesh_polygons *out, glint_error *error)
{
    *out = (mesh_polygons){0};
    merger g = {.mesh = m, .group = group, .normals = normals, .flat_m = flat_m};
    glint_status status = allocate(&g) ? GLINT_OK : error_no_memory(error);
    if (!status) status = mesh_twins(m, g.twin, error);
    if (!status) {
        start_rings(&g);
        status = join_regions(&g, error);
    }
    if (!status) {
        drop_straight_corners(&g);
        status = collect(&g, out, error);
    }
    free(g.twin);
    free(g.next);
    free(g.before);
    free(g.edges);
    free(g.region);
    free(g.queue);
    free(g.uses);
    if (status) mesh_polygons_free(out);
    return status;
}
