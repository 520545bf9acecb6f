/* tle_file.c: choosing one element set from a file of them. */
#include "base/text.h"
#include "orbit/tle.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Part of a line of the file: borrowed from its bytes, not terminated. */
typedef struct slice {
    const char *at;
    size_t n;
} slice;

/* One element set as it stands in the file. */
typedef struct element_set {
    slice name;                /* trimmed; n = 0 without one */
    const char *line1, *line2; /* to the end of the file's bytes */
    int number1, number2;      /* line numbers in the file */
    int satellite;             /* catalogue number; -1 when it cannot be read */
    bool fits;
} element_set;

typedef struct set_list {
    element_set *items; /* owned */
    size_t count, capacity;
} set_list;

/* Going through the lines of a file. */
typedef struct line_reader {
    const char *at; /* start of the next line */
    int number;     /* of the current line */
    slice line;     /* the current line, without its end and blanks behind */
} line_reader;

static slice trim(slice s)
{
    while (s.n > 0 && isspace((unsigned char)s.at[0]))
        s.at++, s.n--;
    while (s.n > 0 && isspace((unsigned char)s.at[s.n - 1]))
        s.n--;
    return s;
}

/* Goes to the next line that says something; false at the end. */
static bool next_line(line_reader *r)
{
    while (*r->at) {
        const size_t n = strcspn(r->at, "\n");
        r->line = (slice){r->at, n};
        r->number++;
        r->at += n + (r->at[n] == '\n');
        const slice trimmed = trim(r->line);
        if (trimmed.n > 0 && trimmed.at[0] != '#') return true;
    }
    return false;
}

/* True for a line that begins as line 1 or 2 of a set does; a name of that form must be written
 * with the "0 " of a name line. A bare digit is what a file cut there leaves. */
static bool begins_with(slice line, char which)
{
    if (line.n == 0 || line.at[0] != which) return false;
    return line.n == 1 || line.at[1] == ' ' || line.at[1] == '\r';
}

static slice name_in(slice line)
{
    if (line.n >= 2 && line.at[0] == '0' && line.at[1] == ' ') line.at += 2, line.n -= 2;
    return trim(line);
}

static bool append(set_list *list, const element_set *set)
{
    if (list->count == list->capacity) {
        const size_t capacity = list->capacity ? 2 * list->capacity : 64;
        element_set *items = realloc(list->items, capacity * sizeof *items);
        if (!items) return false;
        list->items = items;
        list->capacity = capacity;
    }
    list->items[list->count++] = *set;
    return true;
}

/* Finds the element sets of a file. */
static glint_status find_sets(const char *path, const char *bytes, set_list *list,
                              glint_error *error)
{
    static const char byte_order_mark[] = "\xEF\xBB\xBF";
    const bool marked = strncmp(bytes, byte_order_mark, 3) == 0;
    line_reader r = {.at = bytes + (marked ? 3 : 0)};
    slice name = {0};
    while (next_line(&r)) {
        const place where = {path, r.number, 1};
        if (begins_with(r.line, '2'))
            return error_set(error, GLINT_INPUT, where,
                             "a line 2 of an element set without its line 1 before it; get the "
                             "file again, or take this line out");
        if (!begins_with(r.line, '1')) {
            name = name_in(r.line);
            continue;
        }
        element_set set = {.name = name, .line1 = r.line.at, .number1 = r.number, .satellite = -1};
        if (r.line.n >= 7) tle_number_read(r.line.at + 2, &set.satellite);
        if (!next_line(&r) || !begins_with(r.line, '2'))
            return error_set(error, GLINT_INPUT, where,
                             "a line 1 of an element set without its line 2 after it: the file is "
                             "cut short or damaged; get it again");
        set.line2 = r.line.at;
        set.number2 = r.number;
        if (!append(list, &set)) return error_no_memory(error);
        name = (slice){0};
    }
    if (list->count == 0)
        return error_set(error, GLINT_INPUT, (place){path, 0, 0},
                         "there is no element set in this file; expected pairs of lines that begin "
                         "with '1 ' and '2 '");
    return GLINT_OK;
}

static bool fits(const element_set *set, const tle_query *query, slice wanted)
{
    if (query->number != 0 && set->satellite != query->number) return false;
    return !query->name ||
           (set->name.n == wanted.n && strncasecmp(set->name.at, wanted.at, wanted.n) == 0);
}

/* Lists up to five satellites, each once: "ISS (ZARYA) (25544), HST (20580) and others". */
static void list_satellites(const set_list *list, bool fitting_only, text *out)
{
    enum { MOST = 5 };
    int seen[MOST], n = 0;
    for (size_t k = 0; k < list->count; k++) {
        const element_set *set = &list->items[k];
        bool wanted = set->fits || !fitting_only;
        for (int j = 0; j < n; j++)
            wanted = wanted && seen[j] != set->satellite;
        if (!wanted) continue;
        if (n == MOST) {
            text_add(out, " and others");
            return;
        }
        seen[n] = set->satellite;
        text_add(out, n++ ? ", " : "");
        if (set->name.n) text_printf(out, "%.*s ", (int)set->name.n, set->name.at);
        if (set->satellite >= 0)
            text_printf(out, set->name.n ? "(%d)" : "%d", set->satellite);
        else
            text_add(out, "(number not readable)");
    }
}

static bool contains(const char *hay, slice needle)
{
    for (; *hay; hay++)
        if (strncasecmp(hay, needle.at, needle.n) == 0) return true;
    return false;
}

/* The name in the file that was probably meant: nearest, or else one that holds the wanted one.
 * From malloc; NULL without one, or when memory is out. */
static char *probable_name(const set_list *list, slice wanted)
{
    char **names = calloc(list->count, sizeof *names);
    char *asked = string_copy(wanted.at, wanted.n), *found = NULL;
    size_t n = 0;
    for (size_t k = 0; names && asked && k < list->count; k++)
        if (list->items[k].name.n)
            if ((names[n] = string_copy(list->items[k].name.at, list->items[k].name.n))) n++;
    if (names && asked) {
        const char *near = nearest_name(asked, (const char *const *)names, n);
        for (size_t k = 0; k < n && !near; k++)
            if (contains(names[k], wanted)) near = names[k];
        if (near) found = string_copy(near, strlen(near));
    }
    for (size_t k = 0; k < n; k++)
        free(names[k]);
    free(names);
    free(asked);
    return found;
}

/* Says that nothing fits, and what there is. */
static glint_status none_fits(const char *path, place where, const set_list *list,
                              const tle_query *query, slice wanted, glint_error *error)
{
    text message = {0};
    text_printf(&message, "'%s' has no element set", path);
    if (query->name) text_printf(&message, " named '%.*s'", (int)wanted.n, wanted.at);
    if (query->number)
        text_printf(&message, "%s number %d", query->name ? " with" : " of", query->number);
    char *probable = query->name ? probable_name(list, wanted) : NULL;
    const bool same =
        probable && strlen(probable) == wanted.n && strncasecmp(probable, wanted.at, wanted.n) == 0;
    if (probable && !same) {
        text_printf(&message, "; did you mean '%s'?", probable);
    } else {
        text_add(&message, "; it has ");
        list_satellites(list, false, &message);
    }
    free(probable);
    const glint_status status = message.failed
                                    ? error_no_memory(error)
                                    : error_set(error, GLINT_INPUT, where, "%s", message.data);
    text_free(&message);
    return status;
}

static glint_status several_fit(const char *path, place where, const set_list *list,
                                const tle_query *query, glint_error *error)
{
    text names = {0};
    list_satellites(list, true, &names);
    const glint_status status =
        names.failed
            ? error_no_memory(error)
            : error_set(
                  error, GLINT_INPUT, where,
                  "'%s' has element sets of several satellites%s: %s; say which one by its %s",
                  path, query->name ? " of that name" : "", names.data,
                  query->name ? "number" : "name or number");
    text_free(&names);
    return status;
}

/* True when a lies nearer to the moment than b, or as near and earlier. */
static bool is_better(const tle *a, const tle *b, const double near_jd[2])
{
    const double da = (a->epoch_jd[0] - near_jd[0]) + (a->epoch_jd[1] - near_jd[1]);
    const double db = (b->epoch_jd[0] - near_jd[0]) + (b->epoch_jd[1] - near_jd[1]);
    return fabs(da) < fabs(db) || (fabs(da) == fabs(db) && da < db);
}

/* Parses the sets that fit and takes the one that is nearest in time. */
static glint_status take_nearest(const char *path, const set_list *list, const tle_query *query,
                                 tle *out, glint_error *error)
{
    tle best = {0}, read;
    bool any = false;
    for (size_t k = 0; k < list->count; k++) {
        const element_set *set = &list->items[k];
        if (!set->fits) continue;
        const place where2 = {path, set->number2, 1};
        const glint_status status = tle_parse(
            set->line1, set->line2, true, (place){path, set->number1, 1}, &where2, &read, error);
        if (status) return status;
        const size_t most = sizeof read.name - 1, n = set->name.n < most ? set->name.n : most;
        if (n) memcpy(read.name, set->name.at, n);
        read.name[n] = '\0';
        if (!any || is_better(&read, &best, query->near_jd)) best = read;
        any = true;
    }
    *out = best;
    return GLINT_OK;
}

static glint_status choose(const char *path, place asked_from, set_list *list,
                           const tle_query *query, tle *out, glint_error *error)
{
    const place where = asked_from.file ? asked_from : (place){path, 0, 0};
    const slice wanted = query->name ? trim((slice){query->name, strlen(query->name)}) : (slice){0};
    size_t count = 0;
    int first = -1;
    bool several = false;
    for (size_t k = 0; k < list->count; k++) {
        element_set *set = &list->items[k];
        set->fits = fits(set, query, wanted);
        if (!set->fits) continue;
        count++;
        if (set->satellite < 0) continue; /* parsing will say what is wrong with its number */
        if (first < 0) first = set->satellite;
        several = several || set->satellite != first;
    }
    if (count == 0) return none_fits(path, where, list, query, wanted, error);
    if (several) return several_fit(path, where, list, query, error);
    return take_nearest(path, list, query, out, error);
}

glint_status tle_file_choose(const char *path, place asked_from, const tle_query *query, tle *out,
                             glint_error *error)
{
    char *bytes;
    size_t size;
    glint_status status = file_read(path, &bytes, &size, asked_from, error);
    if (status) return status;
    set_list list = {0};
    if (memchr(bytes, '\0', size))
        status = error_set(error, GLINT_INPUT, (place){path, 0, 0},
                           "this is not a text file; expected element sets as two lines each");
    if (!status) status = find_sets(path, bytes, &list, error);
    if (!status) status = choose(path, asked_from, &list, query, out, error);
    free(list.items);
    free(bytes);
    return status;
}
