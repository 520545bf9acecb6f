/* The plan: occluders, the tree over them, and which facets are exposed to any. */
#include "facets/visibility_plan.h"

#include "base/vec.h"
#include "facets/rays.h"
#include "facets/visibility_fans.h"
#include "facets/visibility_rays.h"

#include <stdlib.h>

/* Rounding error of coordinates after a rotation and a shift, over the model's size: 1e-16 for each
 * of a dozen operations, and some room. */
#define NEAR 1e-14
/* Facets narrower than this fraction of the model's size are splinters. Foreshortened a
 * thousandfold, the narrowest that is none is still a hundred times as wide as NEAR. */
#define SPLINTER 1e-9

/* A facet's plane in the body frame. */
typedef struct plane {
    double normal[3], offset_m, contact_m;
} plane;

/* What is needed on the way. Places are in the body frame at the moment of the components' poses;
 * vertices have the numbers that the solids give them. */
typedef struct planner {
    const model *m;
    const visibility_component *components;
    visibility *plan;
    solids solids;
    double (*vertices)[3]; /* owned */
    plane *planes;         /* owned; of the facets */
    int *own;              /* owned; the occluder that each facet is part of */
    int *group;            /* owned; of each component: those that never move to each other */
    int *hinge; /* owned; of each group: the component by whose hinge it turns; -1 for the body's */
    int n_groups;
    double (*box)[6]; /* owned; of each node: lowest and highest x, y, z */
    int *node_group;  /* owned; of each node */
    int caster;       /* the only component that counts as casting shadows; ALL_CAST: all do */
} planner;

enum { ALL_CAST = -1 };

static bool casts(const planner *p, int component)
{
    return p->caster == ALL_CAST || p->caster == component;
}

/* --- facets --- */

static void find_ranges(planner *p)
{
    visibility *plan = p->plan;
    for (int k = 0; k < plan->n_facets; k++) {
        const facet *f = &p->m->polygons.items[k];
        plan->first_facet[f->component + 1]++;
        for (int v = 0; v < f->n_vertices; v++) {
            int *end = &plan->first_vertex[f->component + 1];
            const int vertex = p->solids.corners[f->first_vertex + v];
            if (vertex >= *end) *end = vertex + 1;
        }
        if (f->n_vertices > plan->most_corners) plan->most_corners = f->n_vertices;
    }
    for (int c = 0; c < plan->n_components; c++) {
        plan->first_facet[c + 1] += plan->first_facet[c];
        if (plan->first_vertex[c + 1] < plan->first_vertex[c])
            plan->first_vertex[c + 1] = plan->first_vertex[c];
    }
}

static void place_vertices(planner *p)
{
    visibility *plan = p->plan;
    double most = 0.0;
    for (int c = 0; c < plan->n_components; c++) {
        const visibility_pose *pose = &p->components[c].pose;
        for (int v = plan->first_vertex[c]; v < plan->first_vertex[c + 1]; v++) {
            mat_vec(pose->body_component, p->solids.vertices[v], p->vertices[v]);
            add3(p->vertices[v], pose->origin_m, p->vertices[v]);
            most = fmax(most, dot3(p->vertices[v], p->vertices[v]));
        }
    }
    plan->size_m = sqrt(most);
    plan->near_m = NEAR * plan->size_m;
}

/* The plane of a facet goes through the mean of its corners; corners that were rounded may lie off
 * it, and with them the edges of its neighbours. */
static void place_planes(planner *p)
{
    const visibility *plan = p->plan;
    for (int k = 0; k < plan->n_facets; k++) {
        const facet *f = &p->m->polygons.items[k];
        const int *ring = p->solids.corners + f->first_vertex;
        plane *out = &p->planes[k];
        double sum = 0.0, off_m = 0.0;
        mat_vec(p->components[f->component].pose.body_component, f->normal, out->normal);
        for (int v = 0; v < f->n_vertices; v++)
            sum += dot3(out->normal, p->vertices[ring[v]]);
        out->offset_m = sum / f->n_vertices;
        for (int v = 0; v < f->n_vertices; v++)
            off_m = fmax(off_m, fabs(dot3(out->normal, p->vertices[ring[v]]) - out->offset_m));
        out->contact_m = VISIBILITY_CONTACT * plan->size_m + 2.0 * off_m;
        for (size_t j = 0; j < 3; j++)
            plan->normals[j * (size_t)plan->n_facets + (size_t)k] = f->normal[j];
    }
}

/* --- occluders --- */

static void add_polygon(planner *p, int facet_index, bool both_sides, int *n_corners)
{
    visibility *plan = p->plan;
    const facet *f = &p->m->polygons.items[facet_index];
    occluder *o = &plan->occluders[plan->n_occluders];
    *o = (occluder){.component = f->component,
                    .first = *n_corners,
                    .n = f->n_vertices,
                    .facet = facet_index,
                    .both_sides = both_sides};
    memcpy(plan->corners + o->first, p->solids.corners + f->first_vertex,
           (size_t)o->n * sizeof *plan->corners);
    *n_corners += o->n;
    p->own[facet_index] = plan->n_occluders++;
}

/* A body's corners are the ends of its edges, each once. seen: a mark for each vertex, all clear.
 */
static void add_body(planner *p, const solid *s, bool *seen, int *n_corners)
{
    visibility *plan = p->plan;
    occluder *o = &plan->occluders[plan->n_occluders];
    *o = (occluder){.component = s->component,
                    .first = *n_corners,
                    .facet = -1,
                    .first_edge = s->first_edge,
                    .n_edges = s->n_edges};
    for (int e = s->first_edge; e < s->first_edge + s->n_edges; e++) {
        const int ends[2] = {p->solids.edges[e].from, p->solids.edges[e].to};
        for (int k = 0; k < 2; k++) {
            if (seen[ends[k]]) continue;
            seen[ends[k]] = true;
            plan->corners[o->first + o->n++] = ends[k];
        }
    }
    for (int v = o->first; v < o->first + o->n; v++)
        seen[plan->corners[v]] = false;
    *n_corners += o->n;
    if (o->n_edges > plan->most_edges) plan->most_edges = o->n_edges;
    for (int k = 0; k < s->n_facets; k++)
        p->own[p->solids.facets[s->first_facet + k]] = plan->n_occluders;
    plan->n_occluders++;
}

/* The least width of a facet, m: the least, over its edges, of how far its corners rise from them.
 */
static double width_of(const planner *p, int facet_index)
{
    const facet *f = &p->m->polygons.items[facet_index];
    const int *ring = p->solids.corners + f->first_vertex;
    double least = INFINITY;
    for (int k = 0; k < f->n_vertices; k++) {
        const double *from = p->solids.vertices[ring[k]];
        double along[3], inwards[3], d[3], most = 0.0;
        sub3(p->solids.vertices[ring[(k + 1) % f->n_vertices]], from, along);
        cross3(f->normal, along, inwards);
        if (!(unit3(inwards, inwards) > 0.0)) continue;
        for (int j = 0; j < f->n_vertices; j++) {
            sub3(p->solids.vertices[ring[j]], from, d);
            most = fmax(most, dot3(d, inwards));
        }
        least = fmin(least, most);
    }
    return least;
}

/* Notes down that `other` lies beyond the edge of a polygon that begins at a vertex. */
static void set_beyond(const planner *p, int facet_index, int from, int other)
{
    const visibility *plan = p->plan;
    const occluder *o = &plan->occluders[p->own[facet_index]];
    for (int c = o->first; c < o->first + o->n; c++)
        if (o->facet == facet_index && plan->corners[c] == from) plan->beyond[c] = other;
}

/* Splinters do not count: a view may lose them in rounding. */
static glint_status find_beyond(const planner *p, glint_error *error)
{
    bool *wide = malloc((size_t)p->plan->n_facets * sizeof *wide);
    if (!wide) return error_no_memory(error);
    for (int k = 0; k < p->plan->n_facets; k++)
        wide[k] = width_of(p, k) > SPLINTER * p->plan->size_m;
    for (int c = 0; c < p->plan->n_corners; c++)
        p->plan->beyond[c] = -1;
    for (int e = 0; e < p->solids.n_edges; e++) {
        const solid_edge *edge = &p->solids.edges[e];
        if (wide[edge->right]) set_beyond(p, edge->left, edge->from, edge->right);
        if (wide[edge->left]) set_beyond(p, edge->right, edge->to, edge->left);
    }
    free(wide);
    return GLINT_OK;
}

static glint_status list_occluders(planner *p, glint_error *error)
{
    visibility *plan = p->plan;
    bool *seen = calloc((size_t)plan->n_vertices, sizeof *seen);
    if (!seen) return error_no_memory(error);
    int n_corners = 0;
    for (int k = 0; k < p->solids.n; k++) {
        const solid *s = &p->solids.items[k];
        const int *facets = p->solids.facets + s->first_facet;
        if (s->kind == SOLID_CONVEX) {
            add_body(p, s, seen, &n_corners);
        } else if (s->kind == SOLID_SHEET) {
            add_polygon(p, facets[0], true, &n_corners);
            p->own[facets[1]] = p->own[facets[0]];
        } else {
            for (int f = 0; f < s->n_facets; f++)
                add_polygon(p, facets[f], s->kind == SOLID_OPEN, &n_corners);
        }
    }
    for (int k = 0; k < plan->n_occluders; k++)
        if (plan->occluders[k].n > plan->most_corners) plan->most_corners = plan->occluders[k].n;
    free(seen);
    return find_beyond(p, error);
}

/* --- groups --- */

/* Components that do not move belong to their parent's group; group 0 is the body's. */
static void find_groups(planner *p)
{
    const int n = p->plan->n_components;
    p->hinge[0] = -1;
    p->n_groups = 1;
    for (int c = 0; c < n; c++) {
        p->group[c] = -1;
        if (!p->components[c].moves) continue;
        p->hinge[p->n_groups] = c;
        p->group[c] = p->n_groups++;
    }
    for (int c = 0; c < n; c++) {
        int first = c;
        while (first >= 0 && p->group[first] < 0)
            first = p->components[first].parent;
        const int found = first < 0 ? 0 : p->group[first];
        for (int k = c; k >= 0 && p->group[k] < 0; k = p->components[k].parent)
            p->group[k] = found;
    }
}

/* --- the tree --- */

/* An occluder while the trees are built. */
typedef struct tree_item {
    int occluder, group;
    double box[6]; /* lowest and highest x, y, z */
    double key;    /* that it is being sorted by */
} tree_item;

static void join_boxes(double box[6], const double other[6])
{
    for (int j = 0; j < 3; j++) {
        box[j] = fmin(box[j], other[j]);
        box[3 + j] = fmax(box[3 + j], other[3 + j]);
    }
}

static void box_of_items(const tree_item *items, int n, double box[6])
{
    memcpy(box, items[0].box, sizeof items[0].box);
    for (int k = 1; k < n; k++)
        join_boxes(box, items[k].box);
}

static void box_of_vertices(const planner *p, const int *vertices, int n, double box[6])
{
    for (int j = 0; j < 3; j++)
        box[j] = INFINITY, box[3 + j] = -INFINITY;
    for (int k = 0; k < n; k++) {
        const double *at = p->vertices[vertices[k]];
        const double point[6] = {at[0], at[1], at[2], at[0], at[1], at[2]};
        join_boxes(box, point);
    }
}

static void make_items(const planner *p, tree_item *items)
{
    for (int k = 0; k < p->plan->n_occluders; k++) {
        const occluder *o = &p->plan->occluders[k];
        items[k] = (tree_item){.occluder = k, .group = p->group[o->component]};
        items[k].key = items[k].group;
        box_of_vertices(p, p->plan->corners + o->first, o->n, items[k].box);
    }
}

static int compare_items(const void *a, const void *b)
{
    const tree_item *p = a, *q = b;
    if (p->key != q->key) return p->key < q->key ? -1 : 1;
    return (p->occluder > q->occluder) - (p->occluder < q->occluder);
}

static void sort_along_longest_side(tree_item *items, int n)
{
    double box[6];
    int axis = 0;
    box_of_items(items, n, box);
    for (int j = 1; j < 3; j++)
        if (box[3 + j] - box[j] > box[3 + axis] - box[axis]) axis = j;
    for (int k = 0; k < n; k++)
        items[k].key = items[k].box[axis] + items[k].box[3 + axis];
    qsort(items, (size_t)n, sizeof *items, compare_items);
}

static int add_node(planner *p, tree_item *items, int first, int n);

/* Adds children to a node: n items in portions of `size` each, all full but one. Halved again and
 * again, so that a portion lies together. */
static void add_children(planner *p, int node, tree_item *items, int first, int n, int size)
{
    if (n > size) {
        sort_along_longest_side(items, n);
        const int portions = (n + size - 1) / size, left = portions / 2 * size;
        add_children(p, node, items, first, left, size);
        add_children(p, node, items + left, first + left, n - left, size);
        return;
    }
    const int child = size == 1 ? first : add_node(p, items, first, n);
    plan_node *own = &p->plan->nodes[node];
    own->child[own->n++] = child;
}

/* Appends the node over n items, which are number `first` and so on in the end, and all below it;
 * returns its index. */
static int add_node(planner *p, tree_item *items, int first, int n)
{
    const int own = p->plan->n_nodes++;
    int size = 1;
    while (size < n && size * NODE_CHILDREN < n)
        size *= NODE_CHILDREN;
    p->plan->nodes[own] = (plan_node){.leaf = size == 1};
    box_of_items(items, n, p->box[own]);
    p->node_group[own] = items[0].group;
    add_children(p, own, items, first, n, size);
    return own;
}

static void add_trees(planner *p, tree_item *items, int n)
{
    qsort(items, (size_t)n, sizeof *items, compare_items); /* by group */
    for (int first = 0, next; first < n; first = next) {
        next = first + 1;
        while (next < n && items[next].group == items[first].group)
            next++;
        const int component = p->plan->occluders[items[first].occluder].component;
        plan_root *root = &p->plan->roots[p->plan->n_roots++];
        *root = (plan_root){.component = component};
        root->node = add_node(p, items + first, first, next - first);
    }
}

/* Puts the occluders in the order of the trees' leaves. */
static void reorder(planner *p, const tree_item *items, occluder *sorted, int *order)
{
    visibility *plan = p->plan;
    for (int k = 0; k < plan->n_occluders; k++) {
        sorted[k] = plan->occluders[items[k].occluder];
        order[items[k].occluder] = k;
    }
    memcpy(plan->occluders, sorted, (size_t)plan->n_occluders * sizeof *sorted);
    for (int k = 0; k < plan->n_facets; k++)
        p->own[k] = order[p->own[k]];
}

static glint_status build_trees(planner *p, glint_error *error)
{
    const size_t n = (size_t)p->plan->n_occluders;
    tree_item *items = malloc(n * sizeof *items);
    occluder *sorted = malloc(n * sizeof *sorted);
    int *order = malloc(n * sizeof *order);
    const bool ok = items && sorted && order;
    if (ok) {
        make_items(p, items);
        add_trees(p, items, (int)n);
        reorder(p, items, sorted, order);
    }
    free(items);
    free(sorted);
    free(order);
    return ok ? GLINT_OK : error_no_memory(error);
}

/* --- where a group can get to, seen from another --- */

/* A line in space. */
typedef struct line {
    double origin_m[3], axis[3];
} line;

/* A cylinder that holds everything: along its line from `least` to `most`. */
typedef struct reach {
    line line;
    double least_m, most_m, radius_m;
} reach;

static line hinge_of(const planner *p, int group)
{
    const visibility_component *c = &p->components[p->hinge[group]];
    line out;
    copy3(c->pose.origin_m, out.origin_m);
    mat_vec(c->pose.body_component, c->axis, out.axis);
    return out;
}

static int group_above(const planner *p, int group)
{
    const int parent = p->components[p->hinge[group]].parent;
    return parent < 0 ? 0 : p->group[parent];
}

static bool is_above(const planner *p, int group, int below)
{
    while (below != group && below != 0)
        below = group_above(p, below);
    return below == group;
}

/* Widens a reach so that a ball of a radius about a point goes on fitting in while it is turned
 * about the line. */
static void take_in(reach *r, const double centre_m[3], double radius_m)
{
    double d[3];
    sub3(centre_m, r->line.origin_m, d);
    const double along_m = dot3(d, r->line.axis);
    add_scaled3(d, -along_m, r->line.axis, d);
    r->least_m = fmin(r->least_m, along_m - radius_m);
    r->most_m = fmax(r->most_m, along_m + radius_m);
    r->radius_m = fmax(r->radius_m, norm3(d) + radius_m);
}

/* Everything of a group, turned about a hinge by any angle. */
static reach turn_group(const planner *p, int group, const line *hinge)
{
    reach out = {*hinge, INFINITY, -INFINITY, 0.0};
    for (int c = 0; c < p->plan->n_components; c++) {
        if (p->group[c] != group || !casts(p, c)) continue;
        for (int v = p->plan->first_vertex[c]; v < p->plan->first_vertex[c + 1]; v++)
            take_in(&out, p->vertices[v], 0.0);
    }
    return out;
}

/* The ball around a reach, turned about another hinge. */
static reach turn_reach(const reach *r, const line *hinge)
{
    reach out = {*hinge, INFINITY, -INFINITY, 0.0};
    double centre_m[3];
    add_scaled3(r->line.origin_m, 0.5 * (r->least_m + r->most_m), r->line.axis, centre_m);
    take_in(&out, centre_m, hypot(0.5 * (r->most_m - r->least_m), r->radius_m));
    return out;
}

/* Where the parts of one group can get to, seen from another: they are turned about all hinges
 * between the two, their own first. path: room for n_groups. */
static reach reach_of(const planner *p, int group, int seen_from, int *path)
{
    int n = 0, meeting = group;
    for (; !is_above(p, meeting, seen_from); meeting = group_above(p, meeting))
        path[n++] = meeting;
    const int n_up = n;
    for (int g = seen_from; g != meeting; g = group_above(p, g))
        path[n++] = g;
    for (int a = n_up, b = n - 1; a < b; a++, b--) {
        const int swap = path[a];
        path[a] = path[b], path[b] = swap;
    }
    line hinge = hinge_of(p, path[0]);
    reach out = turn_group(p, group, &hinge);
    for (int k = 1; k < n; k++) {
        hinge = hinge_of(p, path[k]);
        out = turn_reach(&out, &hinge);
    }
    return out;
}

/* --- exposed facets --- */

static bool box_rises(const plane *face, const double box[6])
{
    double most_m = -face->offset_m;
    for (int j = 0; j < 3; j++)
        most_m += face->normal[j] * (face->normal[j] > 0.0 ? box[3 + j] : box[j]);
    return most_m > face->contact_m;
}

static bool occluder_rises(const planner *p, const plane *face, const occluder *o)
{
    for (int v = o->first; v < o->first + o->n; v++)
        if (dot3(face->normal, p->vertices[p->plan->corners[v]]) - face->offset_m > face->contact_m)
            return true;
    return false;
}

static bool reach_rises(const plane *face, const reach *r)
{
    const double slope = dot3(face->normal, r->line.axis);
    const double top_m = dot3(face->normal, r->line.origin_m) - face->offset_m +
                         fmax(r->least_m * slope, r->most_m * slope) +
                         r->radius_m * sqrt(fmax(0.0, 1.0 - slope * slope));
    return top_m > face->contact_m;
}

/* Whether anything below a node comes before a facet. */
static bool node_rises(const planner *p, int facet_index, const plane *face, int k)
{
    const plan_node *node = &p->plan->nodes[k];
    if (!box_rises(face, p->box[k])) return false;
    for (int j = 0; j < node->n; j++) {
        const int child = node->child[j];
        if (!node->leaf && node_rises(p, facet_index, face, child)) return true;
        if (node->leaf && child != p->own[facet_index] &&
            casts(p, p->plan->occluders[child].component) &&
            occluder_rises(p, face, &p->plan->occluders[child]))
            return true;
    }
    return false;
}

/* Whether anything that never moves to the facet comes before it. */
static bool is_exposed_within(const planner *p, int facet_index, int group)
{
    for (int k = 0; k < p->plan->n_roots; k++) {
        const int root = p->plan->roots[k].node;
        if (p->node_group[root] == group &&
            node_rises(p, facet_index, &p->planes[facet_index], root))
            return true;
    }
    return false;
}

static bool has_casters(const planner *p, int group)
{
    for (int c = 0; c < p->plan->n_components; c++)
        if (p->group[c] == group && casts(p, c) &&
            p->plan->first_vertex[c] < p->plan->first_vertex[c + 1])
            return true;
    return false;
}

/* Marks the facets of a group that another group can come before. */
static void expose_to_group(const planner *p, int group, const reach *r)
{
    visibility *plan = p->plan;
    for (int c = 0; c < plan->n_components; c++) {
        if (p->group[c] != group) continue;
        for (int k = plan->first_facet[c]; k < plan->first_facet[c + 1]; k++)
            plan->is_exposed[k] = plan->is_exposed[k] || reach_rises(&p->planes[k], r);
    }
}

/* Marks what the casters can come before in plan.is_exposed, which is all false. */
static glint_status find_exposed(const planner *p, glint_error *error)
{
    visibility *plan = p->plan;
    int *path = malloc((size_t)p->n_groups * sizeof *path);
    if (!path) return error_no_memory(error);
    for (int g = 0; g < p->n_groups; g++)
        for (int h = 0; h < p->n_groups; h++) {
            if (g == h || !has_casters(p, h)) continue;
            const reach r = reach_of(p, h, g, path);
            expose_to_group(p, g, &r);
        }
    for (int k = 0; k < plan->n_facets; k++) {
        const int group = p->group[p->m->polygons.items[k].component];
        plan->is_exposed[k] = plan->is_exposed[k] || is_exposed_within(p, k, group);
    }
    free(path);
    return GLINT_OK;
}

static int compare_exposed(const void *a, const void *b)
{
    const exposed_facet *p = a, *q = b;
    if (p->own != q->own) return p->own < q->own ? -1 : 1;
    return (p->facet > q->facet) - (p->facet < q->facet);
}

static glint_status list_exposed(const planner *p, glint_error *error)
{
    visibility *plan = p->plan;
    for (int k = 0; k < plan->n_facets; k++)
        plan->n_exposed += plan->is_exposed[k];
    plan->exposed = malloc(((size_t)plan->n_exposed + 1) * sizeof *plan->exposed);
    if (!plan->exposed) return error_no_memory(error);
    int n = 0;
    for (int k = 0; k < plan->n_facets; k++) {
        if (!plan->is_exposed[k]) continue;
        const facet *f = &p->m->polygons.items[k];
        exposed_facet *e = &plan->exposed[n++];
        *e = (exposed_facet){.facet = k,
                             .component = f->component,
                             .own = p->own[k],
                             .first = f->first_vertex,
                             .n = f->n_vertices,
                             .contact_m = p->planes[k].contact_m};
        copy3(f->normal, e->normal);
        const double *origin_m = p->components[f->component].pose.origin_m;
        e->offset_m = p->planes[k].offset_m - dot3(p->planes[k].normal, origin_m);
    }
    qsort(plan->exposed, (size_t)n, sizeof *plan->exposed, compare_exposed);
    for (int k = 0, root = 0; k < n; k++) { /* in the order of the trees, too */
        const int group = p->group[plan->exposed[k].component];
        while (p->node_group[plan->roots[root].node] != group)
            plan->roots[++root].first_exposed = k;
        plan->exposed[k].root = root;
        plan->roots[root].n_exposed++;
    }
    return GLINT_OK;
}

/* --- bodies that go through facets --- */

/* A growing list of bodies. */
typedef struct body_list {
    int *items;
    int n, capacity;
} body_list;

static bool append_body(body_list *list, int body)
{
    if (list->n == list->capacity) {
        const int capacity = 2 * list->capacity + 64;
        int *items = realloc(list->items, (size_t)capacity * sizeof *items);
        if (!items) return false;
        list->items = items;
        list->capacity = capacity;
    }
    list->items[list->n++] = body;
    return true;
}

static bool boxes_meet(const double a[6], const double b[6], double margin_m)
{
    for (int j = 0; j < 3; j++)
        if (a[j] > b[3 + j] + margin_m || b[j] > a[3 + j] + margin_m) return false;
    return true;
}

/* Whether all corners of a body are outside the side of a facet's outline along one of its edges,
 * by more than what counts as contact. */
static bool is_beside_edge(const planner *p, const exposed_facet *f, const occluder *o, int edge)
{
    const int *ring = p->solids.corners + f->first;
    const double *from = p->vertices[ring[edge]];
    double along[3], inwards[3], d[3];
    sub3(p->vertices[ring[(edge + 1) % f->n]], from, along);
    cross3(p->planes[f->facet].normal, along, inwards);
    if (!(unit3(inwards, inwards) > 0.0)) return false;
    for (int c = o->first; c < o->first + o->n; c++) {
        sub3(p->vertices[p->plan->corners[c]], from, d);
        if (dot3(d, inwards) > -VISIBILITY_CONTACT * p->plan->size_m) return false;
    }
    return true;
}

/* Whether all corners of a facet are outside a face of a body. */
static bool is_before_face(const planner *p, const exposed_facet *f, int face)
{
    const plane *own = &p->planes[face];
    for (int c = f->first; c < f->first + f->n; c++) {
        const double *at = p->vertices[p->solids.corners[c]];
        if (dot3(own->normal, at) - own->offset_m < own->contact_m) return false;
    }
    return true;
}

/* Whether a body may go through a facet; false only where it certainly does not. */
static bool may_pierce(const planner *p, const exposed_facet *f, const occluder *o)
{
    const plane *own = &p->planes[f->facet];
    double least_m = INFINITY;
    for (int c = o->first; c < o->first + o->n; c++) {
        const double *at = p->vertices[p->plan->corners[c]];
        least_m = fmin(least_m, dot3(own->normal, at) - own->offset_m);
    }
    if (least_m > own->contact_m) return false;
    for (int edge = 0; edge < f->n; edge++)
        if (is_beside_edge(p, f, o, edge)) return false;
    for (int e = o->first_edge; e < o->first_edge + o->n_edges; e++)
        if (is_before_face(p, f, p->solids.edges[e].left) ||
            is_before_face(p, f, p->solids.edges[e].right))
            return false;
    return true;
}

/* Appends the bodies below a node that may go through a facet; box: the facet's. */
static bool list_piercing(const planner *p, const exposed_facet *f, const double box[6], int k,
                          body_list *list)
{
    const visibility *plan = p->plan;
    const plan_node *node = &plan->nodes[k];
    bool ok = true;
    if (!boxes_meet(box, p->box[k], VISIBILITY_CONTACT * plan->size_m)) return true;
    for (int j = 0; j < node->n && ok; j++) {
        const int child = node->child[j];
        if (!node->leaf)
            ok = list_piercing(p, f, box, child, list);
        else if (plan->occluders[child].facet < 0 && child != f->own &&
                 may_pierce(p, f, &plan->occluders[child]))
            ok = append_body(list, child);
    }
    return ok;
}

static glint_status find_piercing(const planner *p, glint_error *error)
{
    visibility *plan = p->plan;
    body_list list = {0};
    bool ok = true;
    for (int k = 0; k < plan->n_exposed && ok; k++) {
        exposed_facet *f = &plan->exposed[k];
        double box[6];
        box_of_vertices(p, p->solids.corners + f->first, f->n, box);
        f->first_piercing = list.n;
        ok = list_piercing(p, f, box, plan->roots[f->root].node, &list);
        f->n_piercing = list.n - f->first_piercing;
    }
    plan->piercing = list.items;
    for (int c = 0; c < plan->n_components; c++)
        for (int root = 0; root < plan->n_roots; root++)
            if (p->node_group[plan->roots[root].node] == p->group[c])
                plan->component_root[c] = root;
    return ok ? GLINT_OK : error_no_memory(error);
}

/* --- vertices in order --- */

/* Gives the vertices new numbers, in the order in which the occluders come to them; those of a
 * component stay side by side. */
static void number_vertices(const planner *p, int *number, int *next)
{
    const visibility *plan = p->plan;
    for (int v = 0; v < plan->n_vertices; v++)
        number[v] = -1;
    for (int c = 0; c < plan->n_components; c++)
        next[c] = plan->first_vertex[c];
    for (int k = 0; k < plan->n_occluders; k++) {
        const occluder *o = &plan->occluders[k];
        for (int c = o->first; c < o->first + o->n; c++)
            if (number[plan->corners[c]] < 0) number[plan->corners[c]] = next[o->component]++;
    }
}

static void apply_numbers(const planner *p, const int *number)
{
    visibility *plan = p->plan;
    for (int v = 0; v < plan->n_vertices; v++)
        copy3(p->solids.vertices[v], plan->vertices[number[v]]);
    for (int c = 0; c < plan->n_corners; c++)
        plan->rings[c] = number[p->solids.corners[c]];
    for (int k = 0; k < plan->n_occluders; k++) {
        const occluder *o = &plan->occluders[k];
        for (int c = o->first; c < o->first + o->n; c++)
            plan->corners[c] = number[plan->corners[c]];
    }
    for (int e = 0; e < p->solids.n_edges; e++) {
        const solid_edge *edge = &p->solids.edges[e];
        plan->edges[e] =
            (solid_edge){number[edge->from], number[edge->to], edge->left, edge->right};
    }
}

static glint_status list_fans(const planner *p, const int *number, glint_error *error)
{
    visibility *plan = p->plan;
    fans found;
    const glint_status status = fans_find(&p->solids, &found, error);
    if (status) return status;
    plan->blades = malloc(((size_t)found.n_facets + 1) * sizeof *plan->blades);
    for (int v = 0; plan->blades && v < plan->n_vertices; v++)
        plan->first_blade[number[v] + 1] = found.first[v + 1] - found.first[v];
    for (int v = 0; plan->blades && v < plan->n_vertices; v++)
        plan->first_blade[v + 1] += plan->first_blade[v];
    for (int v = 0; plan->blades && v < plan->n_vertices; v++)
        for (int k = found.first[v], j = plan->first_blade[number[v]]; k < found.first[v + 1]; k++)
            plan->blades[j++] = (fan_blade){found.facets[k], p->own[found.facets[k]]};
    fans_free(&found);
    return plan->blades ? GLINT_OK : error_no_memory(error);
}

static glint_status renumber(const planner *p, glint_error *error)
{
    int *number = malloc((size_t)p->plan->n_vertices * sizeof *number);
    int *next = malloc((size_t)p->plan->n_components * sizeof *next);
    glint_status status = number && next ? GLINT_OK : error_no_memory(error);
    if (!status) {
        number_vertices(p, number, next);
        apply_numbers(p, number);
        status = list_fans(p, number, error);
    }
    free(number);
    free(next);
    return status;
}

/* --- making and freeing --- */

static bool allocate_plan(visibility *plan)
{
    const size_t n_facets = (size_t)plan->n_facets, n_components = (size_t)plan->n_components;
    const size_t n_corners = (size_t)plan->n_corners;
    plan->vertices = malloc((size_t)plan->n_vertices * sizeof *plan->vertices);
    plan->first_vertex = calloc(n_components + 1, sizeof *plan->first_vertex);
    plan->normals = malloc(3 * n_facets * sizeof *plan->normals);
    plan->first_facet = calloc(n_components + 1, sizeof *plan->first_facet);
    plan->is_exposed = calloc(n_facets, sizeof *plan->is_exposed);
    plan->rings = malloc(n_corners * sizeof *plan->rings);
    plan->occluders = malloc(n_facets * sizeof *plan->occluders);
    plan->corners = malloc(n_corners * sizeof *plan->corners);
    plan->beyond = malloc(n_corners * sizeof *plan->beyond);
    plan->edges = malloc(n_corners * sizeof *plan->edges);
    plan->first_blade = calloc((size_t)plan->n_vertices + 1, sizeof *plan->first_blade);
    plan->nodes = malloc(2 * n_facets * sizeof *plan->nodes);
    plan->component_root = calloc(n_components, sizeof *plan->component_root);
    plan->roots = malloc((n_components + 1) * sizeof *plan->roots);
    return plan->vertices && plan->first_vertex && plan->normals && plan->first_facet &&
           plan->is_exposed && plan->rings && plan->occluders && plan->corners && plan->beyond &&
           plan->edges && plan->first_blade && plan->nodes && plan->component_root && plan->roots;
}

static bool allocate(planner *p)
{
    const size_t n_facets = (size_t)p->plan->n_facets, n_components = (size_t)p->plan->n_components;
    p->vertices = malloc((size_t)p->plan->n_vertices * sizeof *p->vertices);
    p->planes = malloc(n_facets * sizeof *p->planes);
    p->own = malloc(n_facets * sizeof *p->own);
    p->group = malloc(n_components * sizeof *p->group);
    p->hinge = malloc((n_components + 1) * sizeof *p->hinge);
    p->box = malloc(2 * n_facets * sizeof *p->box);
    p->node_group = malloc(2 * n_facets * sizeof *p->node_group);
    return p->vertices && p->planes && p->own && p->group && p->hinge && p->box && p->node_group;
}

/* As far as the trees. */
static glint_status start_plan(planner *p, glint_error *error)
{
    glint_status status = solids_find(p->m, &p->solids, error);
    if (status) return status;
    p->plan->n_vertices = p->solids.n_vertices;
    p->plan->n_corners = p->m->polygons.n_vertices;
    if (!allocate_plan(p->plan) || !allocate(p)) return error_no_memory(error);
    find_ranges(p);
    place_vertices(p);
    place_planes(p);
    find_groups(p);
    status = list_occluders(p, error);
    if (!status) status = build_trees(p, error);
    return status;
}

static glint_status make_plan(planner *p, glint_error *error)
{
    glint_status status = start_plan(p, error);
    if (!status) status = find_exposed(p, error);
    if (!status) status = list_exposed(p, error);
    if (!status) status = find_piercing(p, error);
    if (!status) status = renumber(p, error);
    return status;
}

static void planner_free(planner *p)
{
    solids_free(&p->solids);
    free(p->vertices);
    free(p->planes);
    free(p->own);
    free(p->group);
    free(p->hinge);
    free(p->box);
    free(p->node_group);
}

glint_status visibility_make(const model *m, const visibility_component *components,
                             visibility **out, glint_error *error)
{
    *out = NULL;
    visibility *plan = calloc(1, sizeof *plan);
    if (!plan) return error_no_memory(error);
    plan->n_facets = m->n_facets;
    plan->n_components = m->n_components;
    planner p = {.m = m, .components = components, .plan = plan, .caster = ALL_CAST};
    const glint_status status = make_plan(&p, error);
    planner_free(&p);
    if (status)
        visibility_free(plan);
    else
        *out = plan;
    return status;
}

glint_status visibility_count_exposed(const model *m, const visibility_component *components,
                                      int *counts, glint_error *error)
{
    const int n = m->n_components;
    visibility *plan = calloc(1, sizeof *plan);
    if (!plan) return error_no_memory(error);
    plan->n_facets = m->n_facets;
    plan->n_components = n;
    planner p = {.m = m, .components = components, .plan = plan};
    glint_status status = start_plan(&p, error);
    memset(counts, 0, (size_t)n * (size_t)n * sizeof *counts);
    for (p.caster = 0; !status && p.caster < n; p.caster++) {
        memset(plan->is_exposed, 0, (size_t)plan->n_facets * sizeof *plan->is_exposed);
        status = find_exposed(&p, error);
        for (int k = 0; !status && k < plan->n_facets; k++)
            counts[m->polygons.items[k].component * n + p.caster] += plan->is_exposed[k];
    }
    planner_free(&p);
    visibility_free(plan);
    return status;
}

void visibility_free(visibility *plan)
{
    if (!plan) return;
    ray_plan_free(plan->rays, plan->n_components);
    free(plan->vertices);
    free(plan->first_vertex);
    free(plan->normals);
    free(plan->first_facet);
    free(plan->exposed);
    free(plan->is_exposed);
    free(plan->rings);
    free(plan->occluders);
    free(plan->corners);
    free(plan->beyond);
    free(plan->edges);
    free(plan->component_root);
    free(plan->piercing);
    free(plan->first_blade);
    free(plan->blades);
    free(plan->nodes);
    free(plan->roots);
    free(plan);
}

glint_status visibility_use_rays(visibility *plan, const model *m, int rays_per_facet,
                                 glint_error *error)
{
    ray_plan_free(plan->rays, plan->n_components);
    return ray_plan_make(plan, m, rays_per_facet, &plan->rays, error);
}

bool visibility_has_rays(void)
{
    return rays_are_built();
}

bool visibility_is_trivial(const visibility *plan)
{
    return plan->n_exposed == 0;
}

int visibility_n_exposed(const visibility *plan)
{
    return plan->n_exposed;
}
