/* Which facets something can come before, over all angles of the hinges. */
#include "facets/visibility_planner.h"

#include "base/vec.h"

#include <stdlib.h>

static bool casts(const planner *p, int component)
{
    return p->caster == ALL_CAST || p->caster == component;
}

/* --- groups --- */

void planner_find_groups(planner *p)
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

glint_status planner_find_exposed(const planner *p, glint_error *error)
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

glint_status planner_list_exposed(const planner *p, glint_error *error)
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
