/* Each facet is cut up in its own plane: what lies before it in either view is carried along that
 * view's direction into the plane, and the facet is divided along the outlines that this gives. */
#include "facets/visibility_pieces.h"

#include "base/grow.h"
#include "base/vec.h"
#include "facets/polygon.h"
#include "facets/visibility_view.h"

#include <math.h>
#include <stdlib.h>

/* A facet in its plane: x along its tangent from its first corner, y so that it runs anticlockwise
 * as seen by the observer. */
typedef struct sheet {
    int facet, component;
    bool from_behind;
    double from_m[3], x[3], y[3]; /* component frame */
    double contact_m;             /* what rises no higher over the plane lies in it */
} sheet;

/* A sheet in one view. */
typedef struct sheet_view {
    view *view;
    double from_m[3], x[3], y[3], normal[3]; /* the normal is turned to the observer */
    double near_m;
    shaft shaft;
} sheet_view;

/* What is needed on the way. */
typedef struct cutter {
    const visibility *plan;
    const model *m;
    const visibility_pose *poses;
    visibility_pieces *out;
    view views[2];             /* of the observer, of the source */
    bool lights, casts_shadow; /* the second view counts */
    bool *is_open;             /* owned; of each facet: its back can be seen */
    int *neighbours;           /* owned; at each entry of the model's vertices: the facet beyond the
                                  edge that begins there, or -1 */
    polygon_list outline, covers;
    polygon_list seen, dark, spare; /* parts of the facet at hand */
    int *nodes, *candidates;        /* owned; for view_candidates */
    point2 *points;                 /* owned; of a body's part before the plane */
    double (*hidden)[2];            /* owned; from where to where on an edge, 0 to 1 */
    int hidden_capacity;
} cutter;

/* --- what the facets are parts of --- */

static void find_neighbours(const model *m, const solids *s, int *neighbours)
{
    for (int k = 0; k < m->polygons.n_vertices; k++)
        neighbours[k] = -1;
    for (int e = 0; e < s->n_edges; e++) {
        const solid_edge *edge = &s->edges[e];
        const int facets[2] = {edge->left, edge->right}, starts[2] = {edge->from, edge->to};
        for (int side = 0; side < 2; side++) {
            const facet *f = &m->polygons.items[facets[side]];
            for (int k = f->first_vertex; k < f->first_vertex + f->n_vertices; k++) {
                const int next = k + 1 < f->first_vertex + f->n_vertices ? k + 1 : f->first_vertex;
                if (s->corners[k] == starts[side] && s->corners[next] == starts[!side])
                    neighbours[k] = facets[!side];
            }
        }
    }
}

static glint_status look_at_solids(cutter *c, glint_error *error)
{
    solids found = {0};
    const glint_status status = solids_find(c->m, &found, error);
    if (!status) {
        find_neighbours(c->m, &found, c->neighbours);
        for (int k = 0; k < found.n; k++)
            for (int f = 0; f < found.items[k].n_facets; f++)
                c->is_open[found.facets[found.items[k].first_facet + f]] =
                    found.items[k].kind == SOLID_OPEN;
    }
    solids_free(&found);
    return status;
}

/* --- a facet in its plane --- */

static void set_sheet(const cutter *c, int k, bool from_behind, sheet *s)
{
    const facet *f = &c->m->polygons.items[k];
    const double(*corners)[3] = (const double(*)[3])c->m->polygons.vertices + f->first_vertex;
    *s = (sheet){.facet = k, .component = f->component, .from_behind = from_behind};
    copy3(corners[0], s->from_m);
    copy3(f->tangent, s->x);
    cross3(f->normal, f->tangent, s->y);
    if (from_behind) scale3(s->y, -1.0, s->y);
    double off_m = 0.0;
    for (int v = 1; v < f->n_vertices; v++) {
        double d[3];
        sub3(corners[v], corners[0], d);
        off_m = fmax(off_m, fabs(dot3(d, f->normal)));
    }
    s->contact_m = VISIBILITY_CONTACT * c->plan->size_m + 2.0 * off_m;
}

static point2 in_sheet(const sheet *s, const double point_m[3])
{
    double d[3];
    sub3(point_m, s->from_m, d);
    return (point2){dot3(s->x, d), dot3(s->y, d)};
}

/* The corner of a facet's ring that is k-th as seen by the observer. */
static const double *corner_of(const cutter *c, const sheet *s, int k)
{
    const facet *f = &c->m->polygons.items[s->facet];
    const int n = f->n_vertices;
    return c->m->polygons.vertices[f->first_vertex + (s->from_behind ? (n - k) % n : k % n)];
}

/* Puts the facet's outline in the list; false where it has no area to speak of. */
static bool trace_sheet(cutter *c, const sheet *s, double near_m, bool *ok)
{
    const int n = c->m->polygons.items[s->facet].n_vertices;
    polygon_list_clear(&c->outline);
    point2 *room = polygon_list_room(&c->outline, n);
    *ok = room;
    for (int k = 0; room && k < n; k++)
        room[k] = in_sheet(s, corner_of(c, s, k));
    return room && polygon_list_take(&c->outline, n, near_m);
}

/* Looks at the sheet in a view from which it is seen at an angle, so that rounding errors along
 * that view grow in the plane. */
static void set_sheet_view(const cutter *c, view *v, const sheet *s, sheet_view *out)
{
    const double *axes = v->axes[s->component];
    const facet *f = &c->m->polygons.items[s->facet];
    out->view = v;
    mat_vec(axes, s->from_m, out->from_m);
    add3(out->from_m, v->shift_m[s->component], out->from_m);
    mat_vec(axes, s->x, out->x);
    mat_vec(axes, s->y, out->y);
    cross3(out->x, out->y, out->normal);
    out->near_m = c->plan->near_m / fabs(out->normal[2]);
    shaft *box = &out->shaft;
    *box = (shaft){.offset_m = dot3(out->normal, out->from_m),
                   .contact_m = s->contact_m,
                   .lo_x = INFINITY,
                   .hi_x = -INFINITY,
                   .lo_y = INFINITY,
                   .hi_y = -INFINITY,
                   .lo_z = INFINITY};
    copy3(out->normal, box->normal);
    for (int k = f->first_vertex; k < f->first_vertex + f->n_vertices; k++) {
        double p[3];
        mat_vec(axes, c->m->polygons.vertices[k], p);
        add3(p, v->shift_m[s->component], p);
        box->lo_x = fmin(box->lo_x, p[0]), box->hi_x = fmax(box->hi_x, p[0]);
        box->lo_y = fmin(box->lo_y, p[1]), box->hi_y = fmax(box->hi_y, p[1]);
        box->lo_z = fmin(box->lo_z, p[2]);
    }
}

static double height_of(const sheet_view *s, const double p[3])
{
    return dot3(s->normal, p) - s->shaft.offset_m;
}

/* Where the shadow of a point falls in the plane, along the view's z. */
static point2 shadow_of(const sheet_view *s, const double p[3], double height_m)
{
    double d[3];
    sub3(p, s->from_m, d);
    d[2] -= height_m / s->normal[2];
    return (point2){dot3(s->x, d), dot3(s->y, d)};
}

static point2 shadow_of_crossing(const sheet_view *s, const double p[3], const double q[3],
                                 double height_p, double height_q)
{
    const double t = height_p / (height_p - height_q);
    double way[3], at[3];
    sub3(q, p, way);
    add_scaled3(p, t, way, at);
    return shadow_of(s, at, 0.0);
}

/* --- covers --- */

/* The shadow of the part of a ring that is before the plane. */
static int shadow_of_ring(const sheet_view *s, const double (*ring)[3], int n, point2 *out)
{
    int count = 0;
    for (int k = 0; k < n; k++) {
        const double *p = ring[k], *q = ring[k + 1 < n ? k + 1 : 0];
        const double at_p = height_of(s, p), at_q = height_of(s, q);
        if (at_p >= 0.0) out[count++] = shadow_of(s, p, at_p);
        if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0))
            out[count++] = shadow_of_crossing(s, p, q, at_p, at_q);
    }
    return count;
}

/* The same of a body: the hull of its corners there and of where its edges go through the plane. */
static int shadow_of_body(cutter *c, const sheet_view *s, const occluder *o, point2 *out)
{
    const double(*const vertices)[3] = (const double(*)[3])s->view->vertices;
    int n = 0;
    double highest_m = -INFINITY;
    for (int k = o->first; k < o->first + o->n; k++) {
        const double *p = vertices[c->plan->corners[k]], height_m = height_of(s, p);
        highest_m = fmax(highest_m, height_m);
        if (height_m >= 0.0) c->points[n++] = shadow_of(s, p, height_m);
    }
    if (highest_m <= s->shaft.contact_m) return 0;
    for (int e = o->first_edge; e < o->first_edge + o->n_edges; e++) {
        const double *p = vertices[c->plan->edges[e].from], *q = vertices[c->plan->edges[e].to];
        const double at_p = height_of(s, p), at_q = height_of(s, q);
        if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0))
            c->points[n++] = shadow_of_crossing(s, p, q, at_p, at_q);
    }
    return polygon_hull(c->points, n, out);
}

/* Takes in what occluder k covers of the facet; false when memory is out. A body's outline may lie
 * behind the plane where the body does not. */
static bool cover_by(cutter *c, const sheet_view *s, int k)
{
    const occluder *o = &c->plan->occluders[k];
    const view_ring outline = view_outline(c->plan, s->view, k);
    const double(*ring)[3] = (const double(*)[3])s->view->points + outline.first;
    unsigned lies = SHAFT_CROSSES;
    if (outline.n > 0) lies = view_relate(&s->shaft, ring, outline.n);
    const bool by_ring = o->facet >= 0 || !(lies & (SHAFT_BELOW | SHAFT_CROSSES));
    if (o->facet >= 0 && ((lies & SHAFT_BELOW) || outline.n == 0)) return true;
    point2 *room = polygon_list_room(&c->covers, by_ring ? 2 * outline.n : o->n + o->n_edges + 1);
    if (!room) return false;
    const int n =
        by_ring ? shadow_of_ring(s, ring, outline.n, room) : shadow_of_body(c, s, o, room);
    if (polygon_list_take(&c->covers, n, s->near_m) &&
        polygon_relate(&c->outline, 0, &c->covers, c->covers.n - 1) == POLYGON_APART)
        polygon_list_drop(&c->covers);
    return true;
}

static bool find_covers(cutter *c, const sheet_view *s)
{
    polygon_list_clear(&c->covers);
    const int n =
        view_candidates(c->plan, s->view, &s->shaft, 0, c->plan->n_roots, c->nodes, c->candidates);
    for (int k = 0; k < n; k++)
        if (!cover_by(c, s, c->candidates[k])) return false;
    return true;
}

/* --- division --- */

static bool copy_polygon(const polygon_list *from, int k, polygon_list *to, double near_m)
{
    const polygon_item *item = &from->items[k];
    point2 *room = polygon_list_room(to, item->n);
    if (!room) return false;
    memcpy(room, from->points + item->first, (size_t)item->n * sizeof *room);
    polygon_list_take(to, item->n, near_m);
    return true;
}

/* Room for what is left of a polygon of n points that is cut along lines one after the other: each
 * adds one point, and rounding one more. */
enum { MORE_POINTS = 2 };

/* The part of a ring on the inner side of the line a x + b y + c = 0, or (sign -1) the other one.
 * Points nearer than the slack belong to both. */
static int keep_side(const point2 *ring, int n, const polygon_lines *l, int j, double sign,
                     point2 *out)
{
    int count = 0;
    const double a = sign * l->a[j], b = sign * l->b[j], c = sign * l->c[j], slack = l->slack[j];
    for (int k = 0; k < n; k++) {
        const point2 p = ring[k], q = ring[k + 1 < n ? k + 1 : 0];
        const double at_p = a * p.x + b * p.y + c, at_q = a * q.x + b * q.y + c;
        if (at_p >= -slack) out[count++] = p;
        if ((at_p > slack && at_q < -slack) || (at_p < -slack && at_q > slack)) {
            const double t = at_p / (at_p - at_q);
            out[count++] = (point2){p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
        }
    }
    return count;
}

/* Divides polygon k along the edges of a cover: the parts outside go to one list, what is inside to
 * the other. */
static bool divide(const polygon_list *from, int k, const polygon_list *covers, int cover,
                   double near_m, polygon_list *outside, polygon_list *inside)
{
    const polygon_item *item = &from->items[k], *by = &covers->items[cover];
    const int most = item->n + MORE_POINTS * by->n;
    point2 *rings = malloc(2 * (size_t)most * sizeof *rings);
    point2 *ring = rings, *next = rings ? rings + most : NULL;
    int n = item->n;
    bool ok = rings;
    if (ok) memcpy(ring, from->points + item->first, (size_t)n * sizeof *ring);
    for (int edge = 0; ok && edge < by->n && n >= 3; edge++) {
        const polygon_lines *line = &covers->lines[by->first_lines + edge / 4];
        point2 *room = polygon_list_room(outside, n + MORE_POINTS);
        ok = room;
        if (!ok) break;
        const int n_out = keep_side(ring, n, line, edge % 4, -1.0, room);
        if (!polygon_list_take(outside, n_out, near_m)) continue; /* all of it is inside */
        n = keep_side(ring, n, line, edge % 4, 1.0, next);
        point2 *const swap = ring;
        ring = next, next = swap;
    }
    point2 *room = ok ? polygon_list_room(inside, n) : NULL;
    ok = room;
    if (ok) memcpy(room, ring, (size_t)n * sizeof *room);
    if (ok) polygon_list_take(inside, n, near_m);
    free(rings);
    return ok;
}

/* Takes the covers away from the polygons of *from: what is outside all of them stays there, what
 * is inside one goes to `inside`. */
static bool take_away(cutter *c, polygon_list *from, double near_m, polygon_list *inside)
{
    for (int cover = 0; cover < c->covers.n; cover++) {
        polygon_list_clear(&c->spare);
        for (int k = 0; k < from->n; k++) {
            const polygon_relation lies = polygon_relate(from, k, &c->covers, cover);
            bool ok;
            if (lies == POLYGON_CROSSED)
                ok = divide(from, k, &c->covers, cover, near_m, &c->spare, inside);
            else
                ok = copy_polygon(from, k, lies == POLYGON_APART ? &c->spare : inside, near_m);
            if (!ok) return false;
        }
        const polygon_list swap = *from;
        *from = c->spare;
        c->spare = swap;
    }
    return true;
}

/* --- results --- */

static void to_body(const cutter *c, const sheet *s, point2 p, double out[3])
{
    const visibility_pose *pose = &c->poses[s->component];
    double at[3];
    add_scaled3(s->from_m, p.x, s->x, at);
    add_scaled3(at, p.y, s->y, at);
    mat_vec(pose->body_component, at, out);
    add3(out, pose->origin_m, out);
}

static bool add_pieces(cutter *c, const sheet *s, const polygon_list *list, visibility_light light)
{
    visibility_pieces *out = c->out;
    for (int k = 0; k < list->n; k++) {
        const polygon_item *item = &list->items[k];
        const point2 *points = list->points + item->first;
        if (!grow_room(&out->items, &out->capacity, out->n + 1, sizeof *out->items) ||
            !grow_room(&out->points, &out->point_capacity, out->n_points + item->n,
                       sizeof *out->points))
            return false;
        out->items[out->n++] = (visibility_piece){.facet = s->facet,
                                                  .light = light,
                                                  .first = out->n_points,
                                                  .n = item->n,
                                                  .area_m2 = polygon_area(points, item->n)};
        for (int p = 0; p < item->n; p++)
            to_body(c, s, points[p], out->points[out->n_points++]);
    }
    return true;
}

/* --- edges --- */

/* The part of the way from p to q, 0 to 1, that lies inside a cover (Cyrus and Beck 1978, Computers
 * & Graphics 3, 23); false where none does. */
static bool part_inside(const polygon_list *covers, int cover, point2 p, point2 q, double part[2])
{
    const polygon_item *item = &covers->items[cover];
    part[0] = 0.0, part[1] = 1.0;
    for (int edge = 0; edge < item->n; edge++) {
        const polygon_lines *l = &covers->lines[item->first_lines + edge / 4];
        const int j = edge % 4;
        const double at_p = l->a[j] * p.x + l->b[j] * p.y + l->c[j];
        const double at_q = l->a[j] * q.x + l->b[j] * q.y + l->c[j];
        if (at_p <= l->slack[j] && at_q <= l->slack[j]) return false;
        if (at_p < 0.0) part[0] = fmax(part[0], at_p / (at_p - at_q));
        if (at_q < 0.0) part[1] = fmin(part[1], at_p / (at_p - at_q));
    }
    return part[1] > part[0];
}

static int compare_parts(const void *a, const void *b)
{
    const double *p = a, *q = b;
    return (p[0] > q[0]) - (p[0] < q[0]);
}

/* Where a facet's neighbour beyond an edge stands to the observer. */
static void describe_edge(const cutter *c, const sheet *s, int neighbour, visibility_edge *out)
{
    /* Facets of a body that lie in one plane differ by rounding only; no crease is that flat. */
    static const double FLAT_RAD = 1e-6;
    const facet *f = &c->m->polygons.items[s->facet];
    *out = (visibility_edge){.facet = s->facet, .neighbour = neighbour, .kind = VISIBILITY_RIM};
    if (neighbour < 0) return;
    const facet *other = &c->m->polygons.items[neighbour];
    const double cosine = c->views[0].cosine[neighbour];
    out->turn_rad = angle3(f->normal, other->normal);
    if (s->from_behind ? cosine >= -BRDF_EDGE : cosine <= BRDF_EDGE) return;
    const bool one_surface = facet_is_curved(&c->m->polygons, f) && f->surface == other->surface;
    out->kind = one_surface || out->turn_rad < FLAT_RAD ? VISIBILITY_SMOOTH : VISIBILITY_CREASE;
}

/* Adds what is seen of the edge from p to q. */
static bool add_edge(cutter *c, const sheet *s, point2 p, point2 q, visibility_edge edge)
{
    int n = 0;
    if (!grow_room(&c->hidden, &c->hidden_capacity, c->covers.n + 1, sizeof *c->hidden))
        return false;
    for (int k = 0; k < c->covers.n; k++)
        n += part_inside(&c->covers, k, p, q, c->hidden[n]);
    qsort(c->hidden, (size_t)n, sizeof *c->hidden, compare_parts);
    c->hidden[n][0] = 1.0; /* the end, past all that is hidden */
    double from = 0.0;
    for (int k = 0; k <= n; k++) {
        const double to = c->hidden[k][0];
        if (to > from) {
            visibility_pieces *out = c->out;
            if (!grow_room(&out->edges, &out->edge_capacity, out->n_edges + 1, sizeof *out->edges))
                return false;
            const double dx = q.x - p.x, dy = q.y - p.y;
            to_body(c, s, (point2){p.x + from * dx, p.y + from * dy}, edge.from_m);
            to_body(c, s, (point2){p.x + to * dx, p.y + to * dy}, edge.to_m);
            out->edges[out->n_edges++] = edge;
        }
        if (k < n) from = fmax(from, c->hidden[k][1]);
    }
    return true;
}

/* Adds the facet's edges; the covers are those before it in the observer's view. */
static bool add_edges(cutter *c, const sheet *s)
{
    const facet *f = &c->m->polygons.items[s->facet];
    for (int k = 0; k < f->n_vertices; k++) {
        const int start = f->first_vertex + k;
        const int end = f->first_vertex + (k + 1 < f->n_vertices ? k + 1 : 0);
        visibility_edge edge;
        describe_edge(c, s, c->neighbours[start], &edge);
        if (edge.kind != VISIBILITY_RIM && edge.neighbour < s->facet) continue; /* by the other */
        const point2 p = in_sheet(s, c->m->polygons.vertices[start]);
        const point2 q = in_sheet(s, c->m->polygons.vertices[end]);
        if (!add_edge(c, s, p, q, edge)) return false;
    }
    return true;
}

/* --- all facets --- */

/* Divides what is seen of a facet into what is lit and what is in shadow. */
static bool divide_light(cutter *c, const sheet *s, const double near_m)
{
    const bool turned = c->lights && c->views[1].cosine[s->facet] > BRDF_EDGE;
    if (s->from_behind) return add_pieces(c, s, &c->seen, VISIBILITY_BACK);
    if (!turned) return add_pieces(c, s, &c->seen, VISIBILITY_TURNED_AWAY);
    polygon_list_clear(&c->dark);
    if (c->casts_shadow && c->plan->is_exposed[s->facet]) {
        sheet_view from_source;
        set_sheet_view(c, &c->views[1], s, &from_source);
        const double worse_m = fmax(near_m, from_source.near_m);
        if (!find_covers(c, &from_source) || !take_away(c, &c->seen, worse_m, &c->dark))
            return false;
    }
    return add_pieces(c, s, &c->seen, VISIBILITY_LIT) &&
           add_pieces(c, s, &c->dark, VISIBILITY_SHADOWED);
}

static bool cut_facet(cutter *c, int k)
{
    const double cosine = c->views[0].cosine[k];
    const bool from_behind = cosine < 0.0;
    if (fabs(cosine) <= BRDF_EDGE || (from_behind && !c->is_open[k])) return true;
    sheet s;
    sheet_view seen;
    bool ok;
    set_sheet(c, k, from_behind, &s);
    set_sheet_view(c, &c->views[0], &s, &seen);
    polygon_list_clear(&c->covers);
    polygon_list_clear(&c->seen);
    polygon_list_clear(&c->dark);
    if (!trace_sheet(c, &s, seen.near_m, &ok) || !copy_polygon(&c->outline, 0, &c->seen, 0.0))
        return ok;
    if (from_behind || c->plan->is_exposed[k])
        ok = find_covers(c, &seen) && take_away(c, &c->seen, seen.near_m, &c->dark);
    return ok && add_edges(c, &s) && divide_light(c, &s, seen.near_m);
}

static bool allocate(cutter *c)
{
    const visibility *plan = c->plan;
    const size_t n_points = (size_t)plan->most_corners + (size_t)plan->most_edges + 1;
    c->is_open = calloc((size_t)plan->n_facets, sizeof *c->is_open);
    c->neighbours = malloc((size_t)c->m->polygons.n_vertices * sizeof *c->neighbours);
    c->nodes = malloc(((size_t)plan->n_nodes + NODE_CHILDREN) * sizeof *c->nodes);
    c->candidates = malloc(((size_t)plan->n_occluders + NODE_CHILDREN) * sizeof *c->candidates);
    c->points = malloc(n_points * sizeof *c->points);
    return view_allocate(&c->views[0], plan) && view_allocate(&c->views[1], plan) && c->is_open &&
           c->neighbours && c->nodes && c->candidates && c->points;
}

static void release(cutter *c)
{
    view_free(&c->views[0]);
    view_free(&c->views[1]);
    polygon_list *const lists[] = {&c->outline, &c->covers, &c->seen, &c->dark, &c->spare};
    for (size_t k = 0; k < sizeof lists / sizeof *lists; k++)
        polygon_list_free(lists[k]);
    free(c->is_open);
    free(c->neighbours);
    free(c->nodes);
    free(c->candidates);
    free(c->points);
    free(c->hidden);
}

glint_status visibility_pieces_find(const visibility *plan, const model *m,
                                    const visibility_pose *poses, const double *source_body,
                                    bool casts_shadows, const double observer_body[3],
                                    visibility_pieces *out, glint_error *error)
{
    *out = (visibility_pieces){0};
    cutter c = {.plan = plan,
                .m = m,
                .poses = poses,
                .out = out,
                .lights = source_body,
                .casts_shadow = source_body && casts_shadows};
    bool ok = allocate(&c);
    glint_status status = ok ? look_at_solids(&c, error) : GLINT_OK;
    if (ok && !status) {
        view_set(plan, poses, observer_body, &c.views[0]);
        if (source_body) view_set(plan, poses, source_body, &c.views[1]);
        for (int k = 0; ok && k < plan->n_facets; k++)
            ok = cut_facet(&c, k);
    }
    release(&c);
    return ok ? status : error_no_memory(error);
}

void visibility_pieces_free(visibility_pieces *pieces)
{
    if (!pieces) return;
    free(pieces->items);
    free(pieces->points);
    free(pieces->edges);
    *pieces = (visibility_pieces){0};
}
