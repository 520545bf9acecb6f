/* tle_file.c: the element sets of one satellite from a file of two-line sets. */
#include "base/grow.h"
#include "base/text.h"
#include "orbit/element_sets.h"

#include <stdlib.h>
#include <string.h>

/* One element set as it stands in the file. */
typedef struct two_lines {
    const char *line1, *line2; /* to the end of the file's bytes */
    int number1, number2;      /* line numbers in the file */
} two_lines;

/* All sets of a file. */
typedef struct set_list {
    const char *path;
    two_lines *lines;   /* owned */
    set_entry *entries; /* owned; as many */
    size_t count, capacity;
} set_list;

/* Going through the lines of a file. */
typedef struct line_reader {
    const char *at; /* start of the next line */
    int number;     /* of the current line */
    slice line;     /* the current line, without its end */
} line_reader;

/* Goes to the next line that says something; false at the end. */
static bool next_line(line_reader *r)
{
    while (*r->at) {
        const size_t n = strcspn(r->at, "\n");
        r->line = (slice){r->at, n};
        r->number++;
        r->at += n + (r->at[n] == '\n');
        const slice trimmed = slice_trim(r->line);
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
    return slice_trim(line);
}

static bool append(set_list *list, const two_lines *lines, const set_entry *entry)
{
    const size_t needed = list->count + 1;
    size_t of_lines = list->capacity;
    if (!grow_list(&list->lines, &of_lines, needed, sizeof *list->lines) ||
        !grow_list(&list->entries, &list->capacity, needed, sizeof *list->entries))
        return false;
    list->lines[list->count] = *lines;
    list->entries[list->count++] = *entry;
    return true;
}

/* What line 1 says of the satellite; a line too short for it says nothing. */
static set_entry entry_of(slice line1, slice name)
{
    set_entry entry = {.name = name, .number = -1};
    if (line1.n >= 7 && !tle_number_read(line1.at + 2, &entry.number)) entry.number = -1;
    if (line1.n >= 17) entry.designator = slice_trim((slice){line1.at + 9, 8});
    return entry;
}

/* Finds the element sets of a file. */
static glint_status find_sets(const char *bytes, set_list *list, glint_errors *errors)
{
    static const char byte_order_mark[] = "\xEF\xBB\xBF";
    const bool marked = strncmp(bytes, byte_order_mark, 3) == 0;
    line_reader r = {.at = bytes + (marked ? 3 : 0)};
    slice name = {0};
    while (next_line(&r)) {
        const place where = {list->path, r.number, 1};
        if (begins_with(r.line, '2'))
            return errors_add(errors, GLINT_INPUT, where,
                              "a line 2 of an element set without its line 1 before it; get the "
                              "file again, or take this line out");
        if (!begins_with(r.line, '1')) {
            name = name_in(r.line);
            continue;
        }
        const set_entry entry = entry_of(r.line, name);
        two_lines lines = {.line1 = r.line.at, .number1 = r.number};
        if (!next_line(&r) || !begins_with(r.line, '2'))
            return errors_add(errors, GLINT_INPUT, where,
                              "a line 1 of an element set without its line 2 after it: the file is "
                              "cut short or damaged; get it again");
        lines.line2 = r.line.at;
        lines.number2 = r.number;
        if (!append(list, &lines, &entry))
            return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
        name = (slice){0};
    }
    if (list->count == 0)
        return errors_add(errors, GLINT_INPUT, (place){list->path, 0, 0},
                          "there is no element set in this file; expected pairs of lines that "
                          "begin with '1 ' and '2 '");
    return GLINT_OK;
}

static glint_status parse_set(const void *file, size_t k, tle *out, glint_errors *errors)
{
    const set_list *list = file;
    const two_lines *lines = &list->lines[k];
    const place where = {list->path, lines->number1, 1}, where2 = {list->path, lines->number2, 1};
    glint_error error;
    const glint_status status =
        tle_parse(lines->line1, lines->line2, true, where, &where2, out, &error);
    return status ? errors_take(errors, &error, where) : GLINT_OK;
}

glint_status tle_file_read(const char *path, place asked_from, const tle_query *query,
                           tle_list *out, glint_errors *errors)
{
    *out = (tle_list){0};
    char *bytes;
    size_t size;
    glint_error error;
    glint_status status = file_read(path, &bytes, &size, asked_from, &error);
    if (status) return errors_take(errors, &error, asked_from);
    set_list list = {.path = path};
    if (memchr(bytes, '\0', size))
        status = errors_add(errors, GLINT_INPUT, (place){path, 0, 0},
                            "this is not a text file; expected element sets as two lines each");
    if (!status) status = find_sets(bytes, &list, errors);
    if (!status)
        status = element_sets_choose(path, asked_from, list.entries, list.count, query, parse_set,
                                     &list, out, errors);
    free(list.lines);
    free(list.entries);
    free(bytes);
    return status;
}
