#include "orbit/ccsds_parts.h"

#include "base/grow.h"
#include "base/text.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char BYTE_ORDER_MARK[] = "\xEF\xBB\xBF";

static bool is_blank(char c)
{
    return isspace((unsigned char)c) != 0;
}

/* Takes the blanks off both ends of the text at `at`, which `end` ends; terminates it. */
static char *trim(char *at, char *end)
{
    while (at < end && is_blank(*at))
        at++;
    while (end > at && is_blank(end[-1]))
        end--;
    *end = '\0';
    return at;
}

void ccsds_capitals(char *string)
{
    for (; *string; string++)
        *string = (char)toupper((unsigned char)*string);
}

bool ccsds_append(ccsds_file *file, const ccsds_item *item)
{
    if (!grow_list(&file->items, &file->capacity, file->count + 1, sizeof *file->items))
        return false;
    file->items[file->count++] = *item;
    return true;
}

/* ----------------------------------------------------------------------- KVN */

static bool is_word(const char *s)
{
    for (; *s; s++)
        if (!isalnum((unsigned char)*s) && *s != '_') return false;
    return true;
}

/* The name of the block that a line begins or ends, cut off its _START or _STOP in place; NULL
 * where the line does neither. */
static char *block_name(char *line, bool *ends)
{
    const size_t n = strlen(line);
    if (!is_word(line)) return NULL;
    if (n > 6 && strcasecmp(line + n - 6, "_START") == 0) {
        line[n - 6] = '\0';
        *ends = false;
    } else if (n > 5 && strcasecmp(line + n - 5, "_STOP") == 0) {
        line[n - 5] = '\0';
        *ends = true;
    } else {
        return NULL;
    }
    ccsds_capitals(line);
    return line;
}

static bool is_comment(const char *line)
{
    return strncasecmp(line, "COMMENT", 7) == 0 && (!line[7] || is_blank(line[7]));
}

/* Makes one item of a trimmed line that is neither blank nor a comment. */
static ccsds_item item_of_line(char *line, const char *line_start, int number)
{
    ccsds_item item = {.kind = CCSDS_LINE, .keyword = "", .unit = "", .line = number};
    char *equals = strchr(line, '='), *at = line;
    bool ends;
    if (equals) {
        at = trim(equals + 1, equals + 1 + strlen(equals + 1));
        item.kind = CCSDS_VALUE;
        item.keyword = trim(line, equals);
        ccsds_capitals(line);
    } else {
        const char *name = block_name(line, &ends);
        if (name) {
            item.kind = ends ? CCSDS_END : CCSDS_BEGIN;
            item.keyword = strcmp(name, "META") == 0 ? "METADATA" : name;
            at = line + strlen(line);
        }
    }
    item.value = at;
    item.column =
        (int)((item.kind == CCSDS_VALUE || item.kind == CCSDS_LINE ? at : line) - line_start) + 1;
    return item;
}

static glint_status scan_kvn(ccsds_file *file, char *at, char *end, glint_errors *errors)
{
    for (int number = 1; at < end; number++) {
        char *line_start = at, *line_end = memchr(at, '\n', (size_t)(end - at));
        const bool finished = line_end != NULL;
        if (!finished) line_end = end;
        at = line_end + finished;
        char *line = trim(line_start, line_end);
        if (!*line || is_comment(line)) continue;
        const ccsds_item item = item_of_line(line, line_start, number);
        if (!finished && item.kind != CCSDS_END) {
            errors_warn(errors, (place){file->path, number, 1},
                        "the last line has no line end: it may be cut and is left out; get the "
                        "file again, or end the line if it is whole");
            return GLINT_OK;
        }
        if (!ccsds_append(file, &item))
            return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    }
    return GLINT_OK;
}

/* ------------------------------------------------------------------- reading */

bool ccsds_is_xml(const char *bytes)
{
    if (strncmp(bytes, BYTE_ORDER_MARK, 3) == 0) bytes += 3;
    while (is_blank(*bytes))
        bytes++;
    return *bytes == '<';
}

glint_status ccsds_scan(const char *path, char *bytes, size_t size, ccsds_file *out,
                        glint_errors *errors)
{
    *out = (ccsds_file){.path = path, .is_xml = ccsds_is_xml(bytes)};
    glint_status status;
    if (memchr(bytes, '\0', size)) {
        status = errors_add(errors, GLINT_INPUT, (place){path, 0, 0},
                            "this is not a text file; expected a message of the CCSDS as KVN or "
                            "XML");
        free(bytes);
    } else if (out->is_xml) {
        status = ccsds_scan_xml(bytes, size, out, errors);
        free(bytes);
    } else {
        const size_t mark = strncmp(bytes, BYTE_ORDER_MARK, 3) == 0 ? 3 : 0;
        out->texts = bytes;
        status = scan_kvn(out, bytes + mark, bytes + size, errors);
    }
    if (status) ccsds_free(out);
    return status;
}

glint_status ccsds_read(const char *path, place asked_from, ccsds_file *out, glint_errors *errors)
{
    *out = (ccsds_file){0};
    char *bytes;
    size_t size;
    glint_error error;
    if (file_read(path, &bytes, &size, asked_from, &error))
        return errors_take(errors, &error, asked_from);
    return ccsds_scan(path, bytes, size, out, errors);
}

void ccsds_free(ccsds_file *file)
{
    free(file->items);
    free(file->texts);
    *file = (ccsds_file){0};
}

/* --------------------------------------------------------------------- items */

place ccsds_place(const ccsds_file *file, const ccsds_item *item)
{
    return (place){file->path, item->line, item->column};
}

bool ccsds_is(const ccsds_item *item, ccsds_kind kind, const char *keyword)
{
    return item->kind == kind && strcmp(item->keyword, keyword) == 0;
}

bool ccsds_says(const ccsds_item *item, const char *word)
{
    return strcasecmp(item->value, word) == 0;
}

/* Splits "15.0 [rev/day]" into lengths of the number and the unit. */
static size_t number_length(const char *value, const char **unit, size_t *unit_length)
{
    const size_t n = strlen(value);
    const char *bracket = strchr(value, '[');
    *unit = "";
    *unit_length = 0;
    if (!bracket || value[n - 1] != ']') return n;
    *unit = bracket + 1;
    *unit_length = (size_t)(value + n - 1 - *unit);
    while (bracket > value && is_blank(bracket[-1]))
        bracket--;
    return (size_t)(bracket - value);
}

glint_status ccsds_number(const ccsds_file *file, const ccsds_item *item, const char *unit,
                          double *value, glint_errors *errors)
{
    const char *written;
    size_t written_length;
    const size_t n = number_length(item->value, &written, &written_length);
    if (item->unit[0]) {
        written = item->unit;
        written_length = strlen(written);
    }
    if (!number_read(item->value, n, value))
        return errors_add(errors, GLINT_INPUT, ccsds_place(file, item),
                          "%s is '%.40s'; expected a finite number", item->keyword, item->value);
    if (unit && written_length &&
        (strlen(unit) != written_length || strncasecmp(unit, written, written_length) != 0))
        return errors_add(errors, GLINT_INPUT, ccsds_place(file, item),
                          "%s is in '%.*s'; expected the unit of the standard, %s", item->keyword,
                          (int)(written_length < 40 ? written_length : 40), written, unit);
    return GLINT_OK;
}
