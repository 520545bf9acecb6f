/* changes.c: telling the surfaces of a satellite apart, and putting materials in place of others or
 * taking components away, on the facets before they are compiled: what comes out is what edited
 * files would give. */
#include "base/grow.h"
#include "base/text.h"
#include "base/vec.h"
#include "scenario/reading.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --------------------------------------------------------------- surfaces */

/* Facets look the same way within this, rad: less than any facet is placed by hand, more than
 * rotations round. */
static const double SAME_WAY = 1e-3;
/* A component that shows one material in more directions than this (an imported mesh) has them put
 * together by the axis of the component that is nearest. */
enum { MOST_WAYS = 24 };

/* Where a surface of a component faces. */
typedef struct way {
    bool curved;
    double facing[3]; /* unit; 0 where curved */
} way;

/* The surfaces of one material in one component. */
typedef struct ways {
    int component, material;
    bool by_axis; /* there were too many */
    int n;
    way items[MOST_WAYS + 1]; /* one more than there may be */
    int first;                /* number of the first surface */
} ways;

static way way_of(const facet_list *list, const facet *f)
{
    way w = {.curved = facet_is_curved(list, f)};
    if (w.curved) return w;
    if (!f->surface) {
        copy3(f->normal, w.facing);
        return w;
    }
    const double *axis = list->surfaces[f->surface - 1].axis; /* of a foil: front or back of it */
    scale3(axis, dot3(axis, f->normal) < 0 ? -1 : 1, w.facing);
    return w;
}

/* The nearest axis; the first of equals. */
static way nearest_axis(const way *w)
{
    int best = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(w->facing[i]) > fabs(w->facing[best])) best = i;
    way out = {0};
    out.facing[best] = w->facing[best] < 0 ? -1 : 1;
    return out;
}

static bool same_way(const way *a, const way *b)
{
    if (a->curved || b->curved) return a->curved && b->curved;
    double difference[3];
    sub3(a->facing, b->facing, difference);
    return norm3(difference) <= SAME_WAY;
}

/* The number of a way among those; it is added where it is new and there is room, else -1. */
static int find_way(ways *all, way w)
{
    if (all->by_axis && !w.curved) w = nearest_axis(&w);
    for (int k = 0; k < all->n; k++)
        if (same_way(&all->items[k], &w)) return k;
    if (all->n == MOST_WAYS) return -1;
    all->items[all->n] = w;
    return all->n++;
}

/* All pairs of a component and a material that have facets, in the order in which they come. */
typedef struct way_table {
    ways *items; /* owned */
    int n, capacity;
} way_table;

static ways *find_pair(way_table *t, int component, int material)
{
    for (int k = t->n - 1; k >= 0; k--) /* most often the last */
        if (t->items[k].component == component && t->items[k].material == material)
            return &t->items[k];
    if (!grow_room(&t->items, &t->capacity, t->n + 1L, sizeof *t->items)) return NULL;
    t->items[t->n] = (ways){.component = component, .material = material};
    return &t->items[t->n++];
}

/* Gathers the ways of all facets; those of which there are too many begin again, by axis. */
static bool gather_ways(const facet_list *list, way_table *t)
{
    for (int pass = 0; pass < 2; pass++) {
        bool again = false;
        for (int j = 0; j < list->n; j++) {
            const facet *f = &list->items[j];
            ways *pair = find_pair(t, f->component, f->material);
            if (!pair) return false;
            if (find_way(pair, way_of(list, f)) >= 0) continue;
            pair->by_axis = again = true;
            pair->n = 0;
        }
        if (!again) break;
    }
    int first = 0;
    for (int k = 0; k < t->n; k++) {
        t->items[k].first = first;
        first += t->items[k].n;
    }
    return true;
}

static void write_facing(const ways *pair, int k, text *out)
{
    const way *w = &pair->items[k];
    if (w->curved) {
        text_add(out, "round");
        return;
    }
    for (int i = 0; i < 3; i++)
        if (fabs(w->facing[i]) > 1 - 0.5 * SAME_WAY * SAME_WAY) {
            text_printf(out, "%s%c%c", pair->by_axis ? "about" : "", w->facing[i] < 0 ? '-' : '+',
                        "xyz"[i]);
            return;
        }
    text_printf(out, "(%s %s %s)", number_fixed(w->facing[0], 3).text,
                number_fixed(w->facing[1], 3).text, number_fixed(w->facing[2], 3).text);
}

/* Names the surfaces of one pair. */
static bool name_surfaces(satellite *sat, const ways *pair)
{
    const char *material = sat->materials[pair->material].name;
    for (int k = 0; k < pair->n; k++) {
        text name = {0};
        text_printf(&name, "%s/%s/", sat->components[pair->component].name, material);
        const size_t start = name.length;
        write_facing(pair, k, &name);
        if (name.failed) return false;
        sat->surfaces[pair->first + k] = (satellite_surface){.name = name.data,
                                                             .facing = name.data + start,
                                                             .component = pair->component,
                                                             .material = material};
    }
    return true;
}

/* Numbers the facets' surfaces. */
static void tell_apart(reading *rd, facet_list *list)
{
    satellite *sat = &rd->s->satellite;
    way_table t = {0};
    bool good = gather_ways(list, &t);
    for (int k = 0; good && k < t.n; k++)
        sat->n_surfaces += t.items[k].n;
    sat->surfaces = calloc((size_t)sat->n_surfaces + 1, sizeof *sat->surfaces);
    if (!sat->surfaces) sat->n_surfaces = 0;
    good = good && sat->surfaces;
    for (int k = 0; good && k < t.n; k++)
        good = name_surfaces(sat, &t.items[k]);
    for (int j = 0; good && j < list->n; j++) {
        facet *f = &list->items[j];
        ways *pair = find_pair(&t, f->component, f->material);
        f->part = pair->first + find_way(pair, way_of(list, f));
    }
    free(t.items);
    if (!good) reading_no_memory(rd);
}

/* ---------------------------------------------------------------- changes */

/* A swap as numbers; component -1: of all. */
typedef struct swap {
    int component, from, to;
} swap;

/* Says which one was meant, or which ones there are. */
static void refuse(reading *rd, const char *option, const char *given, const char *what,
                   const char *wanted, const char *const *names, size_t n)
{
    enum { MOST_NAMES = 12 };
    const char *near = nearest_name(wanted, names, n);
    text hint = {0};
    if (near) text_printf(&hint, "; did you mean '%s'?", near);
    for (size_t k = 0; k < n && k < MOST_NAMES && !near; k++)
        text_printf(&hint, "%s%.64s", k ? ", " : "; there are: ", names[k]);
    if (!near && n > MOST_NAMES) text_add(&hint, ", ...");
    reading_note(rd, errors_add(rd->errors, GLINT_ARGUMENT, PLACE_NONE,
                                "--%s %.130s: there is no %s '%.64s'%s", option, given, what,
                                wanted, hint.data ? hint.data : ""));
    text_free(&hint);
}

/* The number of the component or material called by the n bytes at `name`; an error and -1 without
 * one. */
static int number_of(reading *rd, bool of_components, const char *name, size_t n,
                     const char *option, const char *given)
{
    const satellite *sat = &rd->s->satellite;
    const int count = of_components ? sat->n_components : sat->n_materials;
    const char **names = calloc((size_t)count + 1, sizeof *names);
    char *wanted = string_copy(name, n);
    int found = -1;
    for (int k = 0; names && wanted && k < count && found < 0; k++) {
        names[k] = of_components ? sat->components[k].name : sat->materials[k].name;
        if (string_equal(names[k], wanted)) found = k;
    }
    if (!names || !wanted)
        reading_no_memory(rd);
    else if (found < 0)
        refuse(rd, option, given, of_components ? "component" : "material", wanted, names,
               (size_t)count);
    free(names);
    free(wanted);
    return found;
}

/* Reads "A=B" or "COMPONENT/A=B". Names hold neither '=' nor '/'. */
static bool read_swap(reading *rd, const char *given, swap *out)
{
    const char *equals = strchr(given, '='), *slash = strchr(given, '/');
    if (slash && slash > equals) slash = NULL;
    const char *from = slash ? slash + 1 : given;
    if (!equals || equals == from || !equals[1] || slash == given) {
        reading_note(rd, errors_add(rd->errors, GLINT_ARGUMENT, PLACE_NONE,
                                    "--swap %.130s: expected A=B, material B in place of A, or "
                                    "COMPONENT/A=B, in that component alone",
                                    given));
        return false;
    }
    out->component =
        slash ? number_of(rd, true, given, (size_t)(slash - given), "swap", given) : -1;
    out->from = number_of(rd, false, from, (size_t)(equals - from), "swap", given);
    out->to = number_of(rd, false, equals + 1, strlen(equals + 1), "swap", given);
    return (!slash || out->component >= 0) && out->from >= 0 && out->to >= 0;
}

/* A swap that finds nothing to do is a slip, and so is a second one for the same place. */
static void check_swap(reading *rd, const facet_list *list, const swap *all, size_t k)
{
    const satellite *sat = &rd->s->satellite;
    const char *given = rd->changes->swaps[k], *part = NULL;
    bool used = false;
    if (all[k].component >= 0) part = sat->components[all[k].component].name;
    for (int j = 0; j < list->n && !used; j++)
        used = list->items[j].material == all[k].from &&
               (!part || list->items[j].component == all[k].component);
    if (!used)
        reading_note(rd, errors_add(rd->errors, GLINT_ARGUMENT, PLACE_NONE,
                                    "--swap %.130s: %s%s%s has no surface of material '%s'", given,
                                    part ? "component '" : "the satellite", part ? part : "",
                                    part ? "'" : "", sat->materials[all[k].from].name));
    for (size_t i = 0; i < k; i++)
        if (all[i].component == all[k].component && all[i].from == all[k].from)
            reading_note(rd, errors_add(rd->errors, GLINT_ARGUMENT, PLACE_NONE,
                                        "--swap %.130s: --swap %.130s stands before it and is for "
                                        "the same surfaces; expected one of them",
                                        given, rd->changes->swaps[i]));
}

/* The material that a component's facets get: of a swap for that component, else of one for all. */
static int swapped(const swap *all, size_t n, int component, int material)
{
    int general = material;
    for (size_t k = 0; k < n; k++) {
        if (all[k].from != material) continue;
        if (all[k].component == component) return all[k].to;
        if (all[k].component < 0) general = all[k].to;
    }
    return general;
}

static void swap_materials(reading *rd, facet_list *list)
{
    satellite *sat = &rd->s->satellite;
    const size_t n = rd->changes->n_swaps;
    swap *all = calloc(n + 1, sizeof *all);
    if (!all) {
        reading_no_memory(rd);
        return;
    }
    bool good = true;
    for (size_t k = 0; k < n; k++)
        good = read_swap(rd, rd->changes->swaps[k], &all[k]) && good;
    for (size_t k = 0; good && k < n; k++)
        check_swap(rd, list, all, k);
    for (int j = 0; !rd->status && j < list->n; j++) {
        facet *f = &list->items[j];
        f->material = swapped(all, n, f->component, f->material);
        sat->materials[f->material].used = true;
        if (sat->surfaces) sat->surfaces[f->part].material = sat->materials[f->material].name;
    }
    free(all);
}

/* Drops the facets of some components, which stay as joints. */
static void take_away(reading *rd, facet_list *list)
{
    const satellite *sat = &rd->s->satellite;
    bool *gone = calloc((size_t)sat->n_components + 1, sizeof *gone);
    if (!gone) {
        reading_no_memory(rd);
        return;
    }
    for (size_t k = 0; k < rd->changes->n_without; k++) {
        const char *name = rd->changes->without[k];
        const int c = number_of(rd, true, name, strlen(name), "without", name);
        if (c >= 0) gone[c] = true;
    }
    int n = 0;
    for (int j = 0; !rd->status && j < list->n; j++)
        if (!gone[list->items[j].component]) list->items[n++] = list->items[j];
    if (!rd->status) list->n = n;
    if (n == 0 && !rd->status)
        reading_note(rd, errors_add(rd->errors, GLINT_ARGUMENT, PLACE_NONE,
                                    "nothing is left of the satellite; expected --without to leave "
                                    "a component that has surfaces"));
    free(gone);
}

void change_satellite(reading *rd, facet_list *list)
{
    satellite *sat = &rd->s->satellite;
    if (rd->by_surface) tell_apart(rd, list);
    if (rd->status) return;
    if (rd->changes && rd->changes->n_swaps) swap_materials(rd, list);
    if (rd->changes && rd->changes->n_without) take_away(rd, list);
    for (int j = 0; !rd->status && sat->surfaces && j < list->n; j++)
        sat->surfaces[list->items[j].part].area_m2 += list->items[j].area_m2;
}
