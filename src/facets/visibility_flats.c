/* Polygons that lie in one plane, and so hide nothing of each other. */
#include "facets/visibility_planner.h"

#include "base/vec.h"

#include <stdlib.h>

/* Steps in which normals and offsets (over the model's size) count as one: polygons that lie in one
 * plane and fall into two steps are merely found to hide nothing one by one. */
#define FLAT_STEP 1e-6

/* A polygon and the step of its plane: group, normal, offset. */
typedef struct flat_key {
    long step[5];
    int occluder;
} flat_key;

/* A box, in axes of its own, around the polygons of one step. */
typedef struct flat_box {
    double axes[3][3], lo_m[3], hi_m[3];
} flat_box;

static int compare_flats(const void *a, const void *b)
{
    const flat_key *p = a, *q = b;
    for (int j = 0; j < 5; j++)
        if (p->step[j] != q->step[j]) return p->step[j] < q->step[j] ? -1 : 1;
    return (p->occluder > q->occluder) - (p->occluder < q->occluder);
}

/* Sorts the polygons by their planes; returns how many there are. */
static int sort_flats(const planner *p, flat_key *keys)
{
    int n = 0;
    for (int k = 0; k < p->plan->n_occluders; k++) {
        const occluder *o = &p->plan->occluders[k];
        if (o->facet < 0) continue;
        const plane *own = &p->planes[o->facet];
        flat_key *key = &keys[n++];
        *key = (flat_key){{p->group[o->component]}, k};
        for (int j = 0; j < 3; j++)
            key->step[1 + j] = lround(own->normal[j] / FLAT_STEP);
        key->step[4] = lround(own->offset_m / (FLAT_STEP * p->plan->size_m));
    }
    qsort(keys, (size_t)n, sizeof *keys, compare_flats);
    return n;
}

static void set_flat_box(const planner *p, const flat_key *keys, int n, flat_box *box)
{
    const visibility *plan = p->plan;
    const occluder *first = &plan->occluders[keys[0].occluder];
    const int *ring = plan->corners + first->first;
    copy3(p->planes[first->facet].normal, box->axes[2]);
    sub3(p->vertices[ring[1]], p->vertices[ring[0]], box->axes[0]);
    cross3(box->axes[2], box->axes[0], box->axes[1]);
    for (int j = 0; j < 3; j++) {
        unit3(box->axes[j], box->axes[j]);
        box->lo_m[j] = INFINITY, box->hi_m[j] = -INFINITY;
    }
    for (int k = 0; k < n; k++) {
        const occluder *o = &plan->occluders[keys[k].occluder];
        for (int c = o->first; c < o->first + o->n; c++)
            for (int j = 0; j < 3; j++) {
                const double at_m = dot3(box->axes[j], p->vertices[plan->corners[c]]);
                box->lo_m[j] = fmin(box->lo_m[j], at_m);
                box->hi_m[j] = fmax(box->hi_m[j], at_m);
            }
    }
}

/* Whether all of a box is so near to a facet's plane that whatever is in it counts as lying there,
 * with room for rounding: half of what does. The corners of the box, from axes that are
 * perpendicular to within rounding. */
static bool lies_in_plane(const plane *own, const flat_box *box)
{
    double highest_m = -own->offset_m, lowest_m = -own->offset_m;
    for (int j = 0; j < 3; j++) {
        const double slope = dot3(own->normal, box->axes[j]);
        highest_m += fmax(slope * box->lo_m[j], slope * box->hi_m[j]);
        lowest_m += fmin(slope * box->lo_m[j], slope * box->hi_m[j]);
    }
    return highest_m < 0.5 * own->contact_m && lowest_m > -0.5 * own->contact_m;
}

glint_status planner_find_flats(const planner *p, glint_error *error)
{
    visibility *plan = p->plan;
    const size_t most = (size_t)plan->n_occluders;
    flat_key *keys = malloc(most * sizeof *keys);
    flat_box *boxes = malloc(most * sizeof *boxes);
    plan->flats = malloc(most * sizeof *plan->flats);
    const bool ok = keys && boxes && plan->flats;
    for (int k = 0; ok && k < plan->n_occluders; k++)
        plan->flats[k] = k;
    const int n_keys = ok ? sort_flats(p, keys) : 0;
    for (int k = 0, next, n_boxes = 0; k < n_keys; k = next, n_boxes++) {
        for (next = k + 1; next < n_keys; next++)
            if (memcmp(keys[k].step, keys[next].step, sizeof keys[k].step) != 0) break;
        set_flat_box(p, keys + k, next - k, &boxes[n_boxes]);
        for (int j = k; j < next; j++)
            plan->flats[keys[j].occluder] = plan->n_occluders + n_boxes;
    }
    for (int k = 0; ok && k < plan->n_facets; k++) { /* one polygon may be two facets */
        const int own = p->own[k], box = plan->flats[own] - plan->n_occluders;
        if (box >= 0 && !lies_in_plane(&p->planes[k], &boxes[box])) plan->flats[own] = own;
    }
    free(keys);
    free(boxes);
    return ok ? GLINT_OK : error_no_memory(error);
}
