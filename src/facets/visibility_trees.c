/* The trees over the occluders, one for every group of components. */
#include "facets/visibility_planner.h"

#include "base/vec.h"

#include <stdlib.h>

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

void planner_box(const planner *p, const int *vertices, int n, double box[6])
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
        planner_box(p, p->plan->corners + o->first, o->n, items[k].box);
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

static void find_component_roots(const planner *p)
{
    visibility *plan = p->plan;
    for (int c = 0; c < plan->n_components; c++)
        for (int root = 0; root < plan->n_roots; root++)
            if (p->node_group[plan->roots[root].node] == p->group[c])
                plan->component_root[c] = root;
}

glint_status planner_build_trees(planner *p, glint_error *error)
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
        find_component_roots(p);
    }
    free(items);
    free(sorted);
    free(order);
    return ok ? GLINT_OK : error_no_memory(error);
}
