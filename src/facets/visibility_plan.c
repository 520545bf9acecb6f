/* The plan: its facets, occluders and vertices, and the making of all of it. */
#include "facets/visibility_planner.h"

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

static glint_status list_fans(const planner *p, glint_error *error)
{
    visibility *plan = p->plan;
    fans found;
    const glint_status status = fans_find(p->m, &p->solids, &found, error);
    if (status) return status;
    const int n_blades = found.first[found.n];
    plan->fan_at = found.at_corner;
    plan->first_blade = found.first;
    found.at_corner = found.first = NULL;
    plan->blades = malloc(((size_t)n_blades + 1) * sizeof *plan->blades);
    for (int k = 0; plan->blades && k < n_blades; k++)
        plan->blades[k] = (fan_blade){found.facets[k], p->own[found.facets[k]]};
    fans_free(&found);
    return plan->blades ? GLINT_OK : error_no_memory(error);
}

static glint_status renumber(const planner *p, glint_error *error)
{
    int *number = malloc((size_t)p->plan->n_vertices * sizeof *number);
    int *next = malloc((size_t)p->plan->n_components * sizeof *next);
    const glint_status status = number && next ? GLINT_OK : error_no_memory(error);
    if (!status) number_vertices(p, number, next);
    if (!status) apply_numbers(p, number);
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
    plan->nodes = malloc(2 * n_facets * sizeof *plan->nodes);
    plan->component_root = calloc(n_components, sizeof *plan->component_root);
    plan->roots = malloc((n_components + 1) * sizeof *plan->roots);
    return plan->vertices && plan->first_vertex && plan->normals && plan->first_facet &&
           plan->is_exposed && plan->rings && plan->occluders && plan->corners && plan->beyond &&
           plan->edges && plan->nodes && plan->component_root && plan->roots;
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
    planner_find_groups(p);
    status = list_occluders(p, error);
    if (!status) status = planner_build_trees(p, error);
    return status;
}

static glint_status make_plan(planner *p, glint_error *error)
{
    glint_status status = start_plan(p, error);
    if (!status) status = planner_find_exposed(p, error);
    if (!status) status = planner_list_exposed(p, error);
    if (!status) status = planner_find_flats(p, error);
    if (!status) status = planner_find_sections(p, error);
    if (!status) status = list_fans(p, error);
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
        status = planner_find_exposed(&p, error);
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
    free(plan->flats);
    free(plan->corners);
    free(plan->beyond);
    free(plan->edges);
    free(plan->component_root);
    free(plan->sections);
    free(plan->section_points);
    free(plan->fan_at);
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
