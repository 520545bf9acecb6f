#include "orbit/element_sets.h"

#include "base/text.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* A choice in progress. */
typedef struct choice {
    const char *path;
    place where; /* where the file was asked for, or the file */
    set_entry *entries;
    size_t n;
    const tle_query *query;
    slice name; /* wanted; n = 0: any */
    char designator[DESIGNATOR_SIZE];
    glint_errors *errors;
} choice;

slice slice_trim(slice s)
{
    while (s.n > 0 && isspace((unsigned char)s.at[0]))
        s.at++, s.n--;
    while (s.n > 0 && isspace((unsigned char)s.at[s.n - 1]))
        s.n--;
    return s;
}

static bool slice_equal(slice a, slice b)
{
    return a.n == b.n && (a.n == 0 || strncasecmp(a.at, b.at, a.n) == 0);
}

static bool fits(const choice *c, const set_entry *entry)
{
    if (c->query->number != 0 && entry->number != c->query->number) return false;
    if (c->query->designator) {
        char own[DESIGNATOR_SIZE];
        if (!designator_read(entry->designator.at, entry->designator.n, own) ||
            !string_equal(own, c->designator))
            return false;
    }
    return !c->query->name || slice_equal(entry->name, c->name);
}

/* Numbers tell satellites apart, where both have one; then designators, then names. */
static bool same_satellite(const set_entry *a, const set_entry *b)
{
    if (a->number >= 0 && b->number >= 0) return a->number == b->number;
    if (a->designator.n && b->designator.n) return slice_equal(a->designator, b->designator);
    return slice_equal(a->name, b->name);
}

/* --------------------------------------------------------------- what to say */

/* Lists up to five satellites, each once: "ISS (ZARYA) (25544), HST (20580) and others". */
static void list_satellites(const choice *c, bool fitting_only, text *out)
{
    enum { MOST = 5 };
    const set_entry *seen[MOST];
    int n = 0;
    for (size_t k = 0; k < c->n; k++) {
        const set_entry *entry = &c->entries[k];
        bool wanted = entry->fits || !fitting_only;
        for (int j = 0; j < n; j++)
            wanted = wanted && !same_satellite(seen[j], entry);
        if (!wanted) continue;
        if (n == MOST) {
            text_add(out, " and others");
            return;
        }
        seen[n] = entry;
        text_add(out, n++ ? ", " : "");
        if (entry->name.n) text_printf(out, "%.*s ", (int)entry->name.n, entry->name.at);
        if (entry->number >= 0)
            text_printf(out, entry->name.n ? "(%d)" : "%d", entry->number);
        else if (entry->designator.n)
            text_printf(out, "(%.*s)", (int)entry->designator.n, entry->designator.at);
        else
            text_add(out, "(number not readable)");
    }
}

static bool contains(slice hay, slice needle)
{
    for (; hay.n >= needle.n; hay.at++, hay.n--)
        if (strncasecmp(hay.at, needle.at, needle.n) == 0) return true;
    return false;
}

/* The name in the file that was probably meant: nearest, or else one that holds the wanted one.
 * From malloc; NULL without one, or when memory is out. */
static char *probable_name(const choice *c)
{
    char **names = calloc(c->n, sizeof *names);
    char *asked = string_copy(c->name.at, c->name.n), *found = NULL;
    size_t n = 0;
    for (size_t k = 0; names && asked && k < c->n; k++)
        if (c->entries[k].name.n)
            if ((names[n] = string_copy(c->entries[k].name.at, c->entries[k].name.n))) n++;
    if (names && asked) {
        const char *near = nearest_name(asked, (const char *const *)names, n);
        for (size_t k = 0; k < n && !near; k++)
            if (contains((slice){names[k], strlen(names[k])}, c->name)) near = names[k];
        if (near) found = string_copy(near, strlen(near));
    }
    for (size_t k = 0; k < n; k++)
        free(names[k]);
    free(names);
    free(asked);
    return found;
}

/* Adds a message that was put together as a text, which it frees. */
static glint_status say(const choice *c, text *message)
{
    const glint_status status =
        message->failed ? errors_add(c->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory")
                        : errors_add(c->errors, GLINT_INPUT, c->where, "%s", message->data);
    text_free(message);
    return status;
}

static glint_status none_fits(const choice *c)
{
    text message = {0};
    const tle_query *query = c->query;
    text_printf(&message, "'%s' has no element set", c->path);
    if (query->name) text_printf(&message, " named '%.*s'", (int)c->name.n, c->name.at);
    if (query->number)
        text_printf(&message, "%s number %d", query->name ? " with" : " of", query->number);
    if (query->designator)
        text_printf(&message, "%s designator %s", query->name || query->number ? " with" : " of",
                    c->designator);
    char *probable = query->name ? probable_name(c) : NULL;
    if (probable && !slice_equal((slice){probable, strlen(probable)}, c->name)) {
        text_printf(&message, "; did you mean '%s'?", probable);
    } else {
        text_add(&message, "; it has ");
        list_satellites(c, false, &message);
    }
    free(probable);
    return say(c, &message);
}

static glint_status several_fit(const choice *c)
{
    text message = {0};
    text_printf(&message, "'%s' has element sets of several satellites%s: ", c->path,
                c->query->name ? " of that name" : "");
    list_satellites(c, true, &message);
    text_printf(&message, "; say which one by %s",
                c->query->name ? "tle_number or tle_designator"
                               : "tle_name, tle_number or tle_designator");
    return say(c, &message);
}

/* ------------------------------------------------------------------- choosing */

static int by_epoch(const void *a_, const void *b_)
{
    const tle *a = a_, *b = b_;
    const double d = (a->epoch_jd[0] - b->epoch_jd[0]) + (a->epoch_jd[1] - b->epoch_jd[1]);
    if (d != 0) return d < 0 ? -1 : 1;
    if (a->where.line != b->where.line) return a->where.line < b->where.line ? -1 : 1;
    return (a->where.column > b->where.column) - (a->where.column < b->where.column);
}

/* In the order of epochs, each epoch once. */
static void put_in_order(tle_list *list)
{
    qsort(list->sets, list->n, sizeof *list->sets, by_epoch);
    size_t kept = 0;
    for (size_t k = 0; k < list->n; k++) {
        const tle *set = &list->sets[k];
        const tle *last = kept ? &list->sets[kept - 1] : NULL;
        if (last && last->epoch_jd[0] == set->epoch_jd[0] && last->epoch_jd[1] == set->epoch_jd[1])
            continue;
        list->sets[kept++] = *set;
    }
    list->n = kept;
}

static glint_status parse_fitting(const choice *c, size_t count, set_parser *parse,
                                  const void *file, tle_list *out)
{
    glint_status worst = GLINT_OK;
    out->sets = calloc(count, sizeof *out->sets);
    out->path = string_copy(c->path, strlen(c->path));
    if (!out->sets || !out->path)
        return errors_add(c->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    for (size_t k = 0; k < c->n; k++) {
        const set_entry *entry = &c->entries[k];
        if (!entry->fits) continue;
        tle *set = &out->sets[out->n];
        const glint_status status = parse(file, k, set, c->errors);
        if (status) {
            if (status > worst) worst = status;
            continue;
        }
        const size_t most = sizeof set->name - 1, n = entry->name.n < most ? entry->name.n : most;
        if (n) memcpy(set->name, entry->name.at, n);
        set->name[n] = '\0';
        set->where.file = out->path;
        out->n++;
    }
    if (!worst) put_in_order(out);
    return worst;
}

/* Marks the sets that fit; their number, and whether they are of several satellites. */
static size_t mark_fitting(choice *c, bool *several)
{
    size_t count = 0;
    const set_entry *first = NULL;
    *several = false;
    for (size_t k = 0; k < c->n; k++) {
        set_entry *entry = &c->entries[k];
        entry->fits = fits(c, entry);
        if (!entry->fits) continue;
        count++;
        if (entry->number < 0 && !entry->designator.n && !entry->name.n)
            continue; /* parsing will say what is wrong with its number */
        if (!first) first = entry;
        *several = *several || !same_satellite(first, entry);
    }
    return count;
}

glint_status element_sets_choose(const char *path, place asked_from, set_entry *entries, size_t n,
                                 const tle_query *query, set_parser *parse, const void *file,
                                 tle_list *out, glint_errors *errors)
{
    *out = (tle_list){0};
    choice c = {.path = path,
                .where = asked_from.file ? asked_from : (place){path, 0, 0},
                .entries = entries,
                .n = n,
                .query = query,
                .errors = errors};
    if (query->name) c.name = slice_trim((slice){query->name, strlen(query->name)});
    if (query->designator &&
        !designator_read(query->designator, strlen(query->designator), c.designator))
        return errors_add(errors, GLINT_INPUT, c.where,
                          "'%.20s' is no international designator; expected a form like "
                          "1998-067A",
                          query->designator);
    bool several;
    const size_t count = mark_fitting(&c, &several);
    if (count == 0) return none_fits(&c);
    if (several) return several_fit(&c);
    const glint_status status = parse_fitting(&c, count, parse, file, out);
    if (status) tle_list_free(out);
    return status;
}

void tle_list_free(tle_list *list)
{
    free(list->sets);
    free(list->path);
    *list = (tle_list){0};
}

bool designator_read(const char *s, size_t n, char out[DESIGNATOR_SIZE])
{
    const slice t = slice_trim((slice){s, n});
    size_t at = 0, digits = 0;
    while (digits < t.n && isdigit((unsigned char)t.at[digits]))
        digits++;
    const bool long_year = digits == 4 && t.n > 4 && t.at[4] == '-'; /* 1998-067A; else 98067A */
    if (!long_year && digits != 5) return false;
    memcpy(out, t.at + (long_year ? 2 : 0), 2);
    at = long_year ? 5 : 2;
    if (t.n < at + 4) return false;
    memcpy(out + 2, t.at + at, 3);
    for (int k = 2; k < 5; k++)
        if (!isdigit((unsigned char)out[k])) return false;
    at += 3;
    if (t.at[at] == '-') at++;
    size_t length = 5;
    for (; at < t.n; at++) {
        if (!isalpha((unsigned char)t.at[at]) || length == 8) return false;
        out[length++] = (char)toupper((unsigned char)t.at[at]);
    }
    out[length] = '\0';
    return length > 5;
}
