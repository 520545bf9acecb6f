#include "facets/visibility_sectors.h"

#include "base/constants.h"
#include "base/grow.h"
#include "base/vec.h"

#include <math.h>
#include <stdlib.h>

/* A sector is a square of SIDE x SIDE on a face of a cube around the group, the squares of equal
 * angle at the middle of the sides: 15.8 deg from the middle to the farthest corner, at most. */
enum { SIDE = 6, N_SECTORS = 6 * SIDE * SIDE };

/* Visits after which lists pay: making them takes about as long as three visits without. */
enum { VISITS_BEFORE_LISTS = 4 };

/* From so many items on a list is not kept: the walk finds less. And where the walk for all of the
 * sector finds so many, a list is not tried. */
enum { LONG = 10, MANY_FOUND = 400 };

/* Memory for all lists of one thread, bytes; when it is full, no more are made. */
static const size_t MOST_BYTES = (size_t)64 << 20;

/* Margin of angles and cosines, rad: far above their rounding errors. */
#define ANGLE_MARGIN 1e-9
/* What rises less than this fraction of the contact height is left out: below 1, so that rounding
 * never leaves out what rises above it. */
#define CONTACT_FRACTION 0.5
/* A side of a shaft gives way by so many rounding errors of coordinates more than it does for a
 * single direction. */
#define SIDE_SLACK 4.0

bool sectors_allocate(sectors *s, const visibility *plan)
{
    const size_t n_occluders = (size_t)plan->n_occluders;
    s->lists = calloc((size_t)plan->n_roots * N_SECTORS, sizeof *s->lists);
    s->marks = calloc(n_occluders, sizeof *s->marks);
    s->nodes = malloc(((size_t)plan->n_nodes + NODE_CHILDREN) * sizeof *s->nodes);
    s->found = malloc((n_occluders + NODE_CHILDREN) * sizeof *s->found);
    return view_allocate(&s->view, plan) && s->lists && s->marks && s->nodes && s->found;
}

void sectors_free(sectors *s, const visibility *plan)
{
    for (int k = 0; s->lists && k < plan->n_roots * N_SECTORS; k++) {
        free(s->lists[k].first);
        free(s->lists[k].items);
    }
    free(s->lists);
    view_free(&s->view);
    free(s->marks);
    free(s->nodes);
    free(s->found);
    free(s->items);
}

/* --- the sky --- */

/* Place 0 to SIDE - 1 of a ratio -1 to 1 across a face. */
static int place_on_face(double ratio)
{
    const int k = (int)((atan(ratio) * (4.0 / PI) + 1.0) * (0.5 * SIDE));
    return k < 0 ? 0 : k < SIDE ? k : SIDE - 1;
}

static int sector_of(const double d[3])
{
    const int axis = largest3(d), face = 2 * axis + (d[axis] < 0.0);
    const double size = fabs(d[axis]);
    const int u = place_on_face(d[(axis + 1) % 3] / size);
    const int v = place_on_face(d[(axis + 2) % 3] / size);
    return (face * SIDE + u) * SIDE + v;
}

static void direction_on_face(int face, double u, double v, double out[3])
{
    const int axis = face / 2;
    double d[3];
    d[axis] = face % 2 ? -1.0 : 1.0;
    d[(axis + 1) % 3] = tan((2.0 * u / SIDE - 1.0) * (PI / 4.0));
    d[(axis + 2) % 3] = tan((2.0 * v / SIDE - 1.0) * (PI / 4.0));
    unit3(d, out);
}

/* The middle of a sector, and its angle to the farthest direction in it: a corner. */
static double sector_middle(int sector, double middle[3])
{
    const int face = sector / (SIDE * SIDE), u = sector / SIDE % SIDE, v = sector % SIDE;
    double most = 0.0;
    direction_on_face(face, u + 0.5, v + 0.5, middle);
    for (int k = 0; k < 4; k++) {
        double corner[3];
        direction_on_face(face, u + k % 2, v + k / 2, corner);
        most = fmax(most, angle3(middle, corner));
    }
    return most + ANGLE_MARGIN;
}

/* --- making lists --- */

enum { LEFT_OUT = 1, IN_FAN = 2 };

/* Marks the occluders of fans about a facet's corners: those about a corner all of whose facets are
 * turned to every direction of the sector hide nothing. */
static void mark_fans(sectors *s, const visibility *plan, const exposed_facet *f, double sine)
{
    s->marks[f->own] = LEFT_OUT;
    for (int c = f->first; c < f->first + f->n; c++) {
        const int fan = plan->fan_at[c];
        if (fan < 0) continue;
        bool open = true;
        for (int k = plan->first_blade[fan]; k < plan->first_blade[fan + 1]; k++)
            open &= s->view.cosine[plan->blades[k].facet] > sine;
        for (int k = plan->first_blade[fan]; k < plan->first_blade[fan + 1]; k++)
            s->marks[plan->blades[k].occluder] |= open ? LEFT_OUT : IN_FAN;
    }
}

static void clear_marks(sectors *s, const visibility *plan, const exposed_facet *f)
{
    s->marks[f->own] = 0;
    for (int c = f->first; c < f->first + f->n; c++) {
        const int fan = plan->fan_at[c];
        if (fan < 0) continue;
        for (int k = plan->first_blade[fan]; k < plan->first_blade[fan + 1]; k++)
            s->marks[plan->blades[k].occluder] = 0;
    }
}

/* Whether any of an occluder's corners is inside a side of a shaft that is widened by margin_m. */
static bool reaches_in(const visibility *plan, const view *v, const occluder *o, double a, double b,
                       double c, double margin_m)
{
    const double least = -margin_m * hypot(a, b);
    for (int k = o->first; k < o->first + o->n; k++) {
        const double *p = v->vertices[plan->corners[k]];
        if (a * p[0] + b * p[1] + c > least) return true;
    }
    return false;
}

/* Whether an occluder may cover any of the facet, from any direction of the sector. */
static bool may_cover(const visibility *plan, const view *v, const shaft *s, const occluder *o)
{
    double highest_m = -INFINITY, z = -INFINITY;
    for (int k = o->first; k < o->first + o->n; k++) {
        const double *p = v->vertices[plan->corners[k]];
        const double height_m = dot3(s->normal, p) - s->offset_m;
        highest_m = height_m > highest_m ? height_m : highest_m; /* fmax would be a call */
        z = p[2] > z ? p[2] : z;
    }
    const double before_m = z - s->lo_z + plan->near_m;
    if (highest_m <= CONTACT_FRACTION * s->contact_m || before_m <= 0.0) return false;
    const double margin_m = s->slope * before_m + SIDE_SLACK * plan->near_m;
    for (int side = 0; side < s->n_fours; side++)
        for (int j = 0; j < 4; j++)
            if (!reaches_in(plan, v, o, s->a[side][j], s->b[side][j], s->c[side][j], margin_m))
                return false;
    return true;
}

static bool add_item(sectors *s, int n, int item)
{
    if (!grow_room(&s->items, &s->item_capacity, n + 1L, sizeof *s->items)) return false;
    s->items[n] = item;
    return true;
}

/* Appends what may cover one facet; *n_items is moved on. */
static bool list_facet(sectors *s, const visibility *plan, const exposed_facet *f, double angle,
                       int *n_items)
{
    const double sine = sin(angle);
    if (s->view.cosine[f->facet] <= -sine) return true; /* turned away from all of the sector */
    shaft before;
    shaft_make(plan, &s->view, f, tan(angle), &before);
    /* seen from behind, the sides are inside out: its box must do */
    if (s->view.cosine[f->facet] < ANGLE_MARGIN) before.n_fours = 0;
    const int n =
        view_candidates(plan, &s->view, &before, f->root, f->root + 1, s->nodes, s->found);
    int count = n > MANY_FOUND ? LONG : 0;
    mark_fans(s, plan, f, sine);
    for (int k = 0; k < n && count < LONG; k++) {
        const unsigned char mark = s->marks[s->found[k]];
        if (mark & LEFT_OUT) continue;
        if (!may_cover(plan, &s->view, &before, &plan->occluders[s->found[k]])) continue;
        if (!add_item(s, *n_items + count++, s->found[k] - (mark & IN_FAN ? SECTOR_FAN : 0)))
            return false;
    }
    clear_marks(s, plan, f);
    if (count == LONG && !add_item(s, *n_items, SECTOR_WALK)) return false;
    *n_items += count == LONG ? 1 : count;
    return true;
}

static void make_lists(sectors *s, const visibility *plan, const visibility_pose *poses, int root,
                       int sector, sector_lists *out)
{
    const plan_root *r = &plan->roots[root];
    double middle[3], middle_body[3];
    const double angle = sector_middle(sector, middle);
    int *first = malloc(((size_t)r->n_exposed + 1) * sizeof *first), n = 0;
    bool ok = first != NULL;
    mat_vec(poses[r->component].body_component, middle, middle_body);
    view_set_wide(plan, poses, middle_body, sin(angle), &s->view);
    for (int e = 0; e < r->n_exposed && ok; e++) {
        first[e] = n;
        ok = list_facet(s, plan, &plan->exposed[r->first_exposed + e], angle, &n);
    }
    int *items = ok ? malloc(((size_t)n + 1) * sizeof *items) : NULL;
    if (!items) {
        free(first);
        return;
    }
    first[r->n_exposed] = n;
    if (n > 0) memcpy(items, s->items, (size_t)n * sizeof *items);
    out->first = first;
    out->items = items;
    s->bytes += ((size_t)r->n_exposed + (size_t)n + 2) * sizeof *items;
}

const sector_lists *sectors_visit(sectors *s, const visibility *plan, const visibility_pose *poses,
                                  const view *v, int root)
{
    const int sector = sector_of(v->axes[plan->roots[root].component] + 6);
    sector_lists *lists = &s->lists[root * N_SECTORS + sector];
    if (lists->first) return lists;
    if (++lists->n_visits <= VISITS_BEFORE_LISTS || s->bytes > MOST_BYTES) return NULL;
    make_lists(s, plan, poses, root, sector, lists);
    return lists->first ? lists : NULL;
}
