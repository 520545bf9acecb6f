#include "facets/visibility_view.h"

#include "base/vec.h"

#include <math.h>
#include <stdlib.h>

/* Margin of boxes in floats, over the model's size: a float is off by 6e-8 of the size at most, a
 * sum of three products by a few times that. */
#define FLOAT_MARGIN 1e-6

bool view_allocate(view *v, const visibility *plan)
{
    const size_t n_vertices = (size_t)plan->n_vertices, n_nodes = (size_t)plan->n_nodes;
    v->axes = malloc((size_t)plan->n_components * sizeof *v->axes);
    v->shift_m = malloc((size_t)plan->n_components * sizeof *v->shift_m);
    v->vertices = malloc(n_vertices * sizeof *v->vertices);
    v->cosine = malloc((size_t)plan->n_facets * sizeof *v->cosine);
    v->nodes = malloc(n_nodes * sizeof *v->nodes);
    v->roots = malloc((size_t)plan->n_roots * sizeof *v->roots);
    v->points = malloc((size_t)plan->n_corners * sizeof *v->points);
    v->rings = malloc((size_t)plan->n_occluders * sizeof *v->rings);
    v->next = malloc(n_vertices * sizeof *v->next);
    return v->axes && v->shift_m && v->vertices && v->cosine && v->nodes && v->roots && v->points &&
           v->rings && v->next;
}

void view_free(view *v)
{
    free(v->axes);
    free(v->shift_m);
    free(v->vertices);
    free(v->cosine);
    free(v->nodes);
    free(v->roots);
    free(v->points);
    free(v->rings);
    free(v->next);
}

/* --- placing --- */

/* Right-handed axes with z along a unit vector; x is near the axis that is farthest from it. */
static void basis_along(const double z[3], double basis[9])
{
    int least = 0;
    for (int j = 1; j < 3; j++)
        if (fabs(z[j]) < fabs(z[least])) least = j;
    double across[3] = {0, 0, 0};
    across[least] = 1.0;
    copy3(z, basis + 6);
    perp3(across, z, basis);
    cross3(basis + 6, basis, basis + 3);
}

/* out = axis . vector for n vectors. */
CLONES static void project(const double axis[3], const double *x, const double *y, const double *z,
                           int n, double *out)
{
    const double a = axis[0], b = axis[1], c = axis[2];
    for (int k = 0; k < n; k++)
        out[k] = a * x[k] + b * y[k] + c * z[k];
}

static void place_component(const visibility *plan, const visibility_pose *pose, int c, view *v)
{
    double *axes = v->axes[c], *shift_m = v->shift_m[c];
    mat_mul(v->basis, pose->body_component, axes);
    mat_vec(v->basis, pose->origin_m, shift_m);
    for (int k = plan->first_vertex[c]; k < plan->first_vertex[c + 1]; k++) {
        mat_vec(axes, plan->vertices[k], v->vertices[k]);
        add3(v->vertices[k], shift_m, v->vertices[k]);
    }
    const double *x = plan->normals + plan->first_facet[c], *y = x + plan->n_facets;
    project(axes + 6, x, y, y + plan->n_facets, plan->first_facet[c + 1] - plan->first_facet[c],
            v->cosine + plan->first_facet[c]);
}

/* --- boxes --- */

/* One box in doubles. */
typedef struct box3 {
    double lo_x, hi_x, lo_y, hi_y, hi_z;
} box3;

static const box3 EMPTY = {INFINITY, -INFINITY, INFINITY, -INFINITY, -INFINITY};

static inline double lower(double a, double b)
{
    return a < b ? a : b;
}

static inline double higher(double a, double b)
{
    return a > b ? a : b;
}

static inline void take_in(box3 *box, const double p[3])
{
    box->lo_x = lower(box->lo_x, p[0]), box->hi_x = higher(box->hi_x, p[0]);
    box->lo_y = lower(box->lo_y, p[1]), box->hi_y = higher(box->hi_y, p[1]);
    box->hi_z = higher(box->hi_z, p[2]);
}

/* Copies the corners of a polygon that counts in this view: a facet of a closed body only where it
 * is turned to the one who looks, and none where it is edge-on, since then it hides nothing. */
static void place_polygon(const visibility *plan, const occluder *o, view *v, view_ring *ring)
{
    const double cosine = v->cosine[o->facet], least = BRDF_EDGE - v->width;
    const bool backwards = cosine < 0.0;
    const int *corners = plan->corners + o->first;
    *ring = (view_ring){o->first, 0};
    if (!(cosine > least || (o->both_sides && cosine < -least))) return;
    ring->n = o->n;
    for (int k = 0; k < o->n; k++)
        copy3(v->vertices[corners[backwards ? o->n - 1 - k : k]], v->points[o->first + k]);
}

static void place_occluders(const visibility *plan, view *v)
{
    for (int k = 0; k < plan->n_occluders; k++) {
        const occluder *o = &plan->occluders[k];
        if (o->facet < 0)
            v->rings[k] = (view_ring){o->first, VIEW_NOT_TRACED};
        else
            place_polygon(plan, o, v, &v->rings[k]);
    }
}

static box3 box_of_occluder(const visibility *plan, const view *v, int k)
{
    const occluder *o = &plan->occluders[k];
    box3 box = EMPTY;
    if (v->rings[k].n == 0) return box;
    for (int c = o->first; c < o->first + o->n; c++)
        take_in(&box, v->vertices[plan->corners[c]]);
    return box;
}

static box3 box_of_node(const view_node *node)
{
    box3 box = EMPTY;
    for (int j = 0; j < NODE_CHILDREN; j++) {
        box.lo_x = lower(box.lo_x, (double)node->lo_x[j]);
        box.hi_x = higher(box.hi_x, (double)node->hi_x[j]);
        box.lo_y = lower(box.lo_y, (double)node->lo_y[j]);
        box.hi_y = higher(box.hi_y, (double)node->hi_y[j]);
        box.hi_z = higher(box.hi_z, (double)node->hi_z[j]);
    }
    return box;
}

static void put_box(view_node *node, int j, const box3 *box, double margin_m)
{
    node->lo_x[j] = (float)(box->lo_x - margin_m);
    node->hi_x[j] = (float)(box->hi_x + margin_m);
    node->lo_y[j] = (float)(box->lo_y - margin_m);
    node->hi_y[j] = (float)(box->hi_y + margin_m);
    node->hi_z[j] = (float)(box->hi_z + margin_m);
}

static void bound(const visibility *plan, view *v)
{
    const double margin_m = FLOAT_MARGIN * plan->size_m;
    for (int k = plan->n_nodes - 1; k >= 0; k--) { /* children come after their parents */
        const plan_node *node = &plan->nodes[k];
        for (int j = 0; j < NODE_CHILDREN; j++) {
            box3 box = EMPTY;
            if (j < node->n)
                box = node->leaf ? box_of_occluder(plan, v, node->child[j])
                                 : box_of_node(&v->nodes[node->child[j]]);
            put_box(&v->nodes[k], j, &box, node->leaf ? margin_m : 0.0);
        }
    }
    for (int k = 0; k < plan->n_roots; k++) {
        const box3 box = box_of_node(&v->nodes[plan->roots[k].node]);
        v->roots[k] = (view_box){(float)box.lo_x, (float)box.hi_x, (float)box.lo_y, (float)box.hi_y,
                                 (float)box.hi_z};
    }
}

void view_set_wide(const visibility *plan, const visibility_pose *poses,
                   const double towards_body[3], double sine, view *v)
{
    copy3(towards_body, v->towards_body);
    v->width = sine;
    basis_along(towards_body, v->basis);
    for (int c = 0; c < plan->n_components; c++)
        place_component(plan, &poses[c], c, v);
    place_occluders(plan, v);
    v->has_boxes = false;
    v->valid = true;
}

void view_set(const visibility *plan, const visibility_pose *poses, const double towards_body[3],
              view *v)
{
    if (v->valid && memcmp(v->towards_body, towards_body, sizeof v->towards_body) == 0) return;
    view_set_wide(plan, poses, towards_body, 0.0, v);
}

/* --- outlines of bodies --- */

/* Walks along the edges between the facets that are turned to the one who looks and those that are
 * not: around a convex body they form one ring. Returns its length, 0 where they do not. */
static int trace(const visibility *plan, const occluder *o, view *v)
{
    int start = -1, n_edges = 0, n = 0;
    for (int e = o->first_edge; e < o->first_edge + o->n_edges; e++) {
        const solid_edge *edge = &plan->edges[e];
        const bool left = v->cosine[edge->left] > 0.0, right = v->cosine[edge->right] > 0.0;
        if (left == right) continue;
        start = left ? edge->from : edge->to;
        v->next[start] = left ? edge->to : edge->from;
        n_edges++;
    }
    int at = start;
    while (n < n_edges && n < o->n) {
        copy3(v->vertices[at], v->points[o->first + n++]);
        at = v->next[at];
        if (at == start) break;
    }
    return at == start && n == n_edges ? n : 0;
}

view_ring view_outline(const visibility *plan, view *v, int k)
{
    if (v->rings[k].n == VIEW_NOT_TRACED) v->rings[k].n = trace(plan, &plan->occluders[k], v);
    return v->rings[k];
}

/* --- the shaft before a facet --- */

/* The sides of a shaft, and the box around the facet. */
CLONES static void make_sides(const double (*vertices)[3], const int *ring, int n, double near_m,
                              shaft *s)
{
    double4 least = all4(INFINITY);
    double lo_z = INFINITY;
    for (int first = 0; first < n; first += 4) {
        const double *p[5]; /* ends of four edges; after the last, the first one again */
        for (int j = 0; j < 5; j++)
            p[j] = vertices[ring[first + j < n ? first + j : 0]];
        for (int j = 0; j < 4; j++) {
            least = least4(least, (double4){p[j][0], p[j][1], -p[j][0], -p[j][1]});
            lo_z = lower(lo_z, p[j][2]);
        }
        if (first >= SHAFT_SIDES) continue;
        const double4 x = {p[0][0], p[1][0], p[2][0], p[3][0]};
        const double4 y = {p[0][1], p[1][1], p[2][1], p[3][1]};
        const double4 dx = (double4){p[1][0], p[2][0], p[3][0], p[4][0]} - x;
        const double4 dy = (double4){p[1][1], p[2][1], p[3][1], p[4][1]} - y;
        const mask4 own = (mask4){0, 1, 2, 3} < (long long)(n - first);
        const double4 zero = {0};
        s->a[first / 4] = pick4(own, -dy, zero);
        s->b[first / 4] = pick4(own, dx, zero);
        s->c[first / 4] = pick4(own, dy * x - dx * y - near_m * (size4(dx) + size4(dy)), all4(1.0));
    }
    s->lo_x = least[0], s->hi_x = -least[2], s->lo_y = least[1], s->hi_y = -least[3];
    s->lo_z = lo_z;
}

void shaft_make(const visibility *plan, const view *v, const exposed_facet *f, double slope,
                shaft *s)
{
    mat_vec(v->axes[f->component], f->normal, s->normal);
    s->offset_m = f->offset_m + dot3(s->normal, v->shift_m[f->component]);
    s->contact_m = f->contact_m;
    s->slope = slope;
    s->n_fours = f->n > 4 ? 2 : 1;
    make_sides((const double(*)[3])v->vertices, plan->rings + f->first, f->n, plan->near_m, s);
}

/* The shaft in floats; `high_x`, `high_y`: which ends of a box rise highest over the facet's plane.
 */
typedef struct float_shaft {
    float lo_x, hi_x, lo_y, hi_y, lo_z, slope, a, b, c, d;
    bool high_x, high_y;
} float_shaft;

CLONES static int walk(const plan_node *nodes, const view_node *boxes, const float_shaft *s,
                       int root, int *stack, int *out)
{
    int n = 0, n_stack = 1;
    stack[0] = root;
    while (n_stack > 0) {
        const int k = stack[--n_stack];
        const plan_node *node = &nodes[k];
        const view_node *box = &boxes[k];
        const float8 x = s->high_x ? box->hi_x : box->lo_x, y = s->high_y ? box->hi_y : box->lo_y;
        const float8 height = box->hi_z - s->lo_z, margin = s->slope * height;
        const int8 marks = (box->lo_x - margin < s->hi_x) & (box->hi_x + margin > s->lo_x) &
                           (box->lo_y - margin < s->hi_y) & (box->hi_y + margin > s->lo_y) &
                           (height > 0.0f) & (s->a * x + s->b * y + s->c * box->hi_z + s->d > 0.0f);
        int *list = node->leaf ? out + n : stack + n_stack, count = 0;
        for (int j = 0; j < NODE_CHILDREN;
             j++) { /* without branches, that would be guessed wrong */
            list[count] = node->child[j];
            count -= marks[j]; /* -1 where it holds */
        }
        if (node->leaf) {
            n += count;
            continue;
        }
        for (int j = 0; j < count; j++) /* the first is the last to be needed */
            __builtin_prefetch(&boxes[list[j]]);
        n_stack += count;
    }
    return n;
}

/* Whether a box may reach into a shaft. */
static inline bool reaches_in(const view_box *box, const float_shaft *s)
{
    const float height = box->hi_z - s->lo_z, margin = s->slope * height;
    return (box->lo_x - margin < s->hi_x) & (box->hi_x + margin > s->lo_x) &
           (box->lo_y - margin < s->hi_y) & (box->hi_y + margin > s->lo_y) & (height > 0.0f);
}

int view_candidates(const visibility *plan, view *v, const shaft *s, int first_root, int end_root,
                    int *nodes, int *out)
{
    if (first_root == end_root) return 0;
    const double margin_m = FLOAT_MARGIN * plan->size_m;
    float_shaft rough = {.lo_x = (float)(s->lo_x - margin_m),
                         .hi_x = (float)(s->hi_x + margin_m),
                         .lo_y = (float)(s->lo_y - margin_m),
                         .hi_y = (float)(s->hi_y + margin_m),
                         .lo_z = (float)(s->lo_z - margin_m),
                         .slope = (float)s->slope,
                         .a = (float)s->normal[0],
                         .b = (float)s->normal[1],
                         .c = (float)s->normal[2],
                         .d = (float)(margin_m - s->offset_m - s->contact_m),
                         .high_x = s->normal[0] > 0.0,
                         .high_y = s->normal[1] > 0.0};
    /* Of a plane that is seen from behind, a box's highest point is not known: anything may be over
     * it. */
    if (s->normal[2] < 0.0) rough.a = rough.b = rough.c = 0.0f, rough.d = 1.0f;
    if (!v->has_boxes) bound(plan, v);
    v->has_boxes = true;
    int n = 0;
    for (int k = first_root; k < end_root; k++)
        if (reaches_in(&v->roots[k], &rough))
            n += walk(plan->nodes, v->nodes, &rough, plan->roots[k].node, nodes, out + n);
    for (int k = 0; k < n; k++) {
        const double *first = v->points[v->rings[out[k]].first];
        __builtin_prefetch(first);
        __builtin_prefetch(first + 8);
    }
    return n;
}

CLONES unsigned view_relate(const shaft *s, const double (*points)[3], int n)
{
    double lowest = INFINITY, highest = -INFINITY;
    for (int k = 0; k < n; k++) {
        const double height_m = dot3(s->normal, points[k]) - s->offset_m;
        lowest = lower(lowest, height_m);
        highest = higher(highest, height_m);
    }
    const unsigned crosses = lowest < 0.0 ? SHAFT_CROSSES : 0;
    if (highest <= s->contact_m) return SHAFT_BELOW | crosses;
    for (int side = 0; side < s->n_fours; side++) {
        const double4 a = s->a[side], b = s->b[side], c = s->c[side];
        mask4 inside = {0};
        for (int k = 0; k < n; k++)
            inside |= a * points[k][0] + b * points[k][1] + c > 0.0;
        if (!(inside[0] & inside[1] & inside[2] & inside[3])) return SHAFT_ASIDE | crosses;
    }
    return crosses;
}
