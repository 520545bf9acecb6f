#include "output/json.h"

#include "output/utf8.h"

#include <math.h>
#include <string.h>

enum { INDENT = 2, COMPACT_DEPTH = 4 }; /* deeper elements share a line */

static void line_break(json *j)
{
    if (j->depth >= COMPACT_DEPTH) return;
    text_char(j->out, '\n');
    for (int k = 0; k < INDENT * j->depth; k++)
        text_char(j->out, ' ');
}

/* What stands before an element: a comma, a new line, its key. */
static void begin_element(json *j, const char *key)
{
    if (j->started) text_add(j->out, j->depth >= COMPACT_DEPTH ? ", " : ",");
    if (j->depth > 0) line_break(j);
    if (key) text_printf(j->out, "\"%s\": ", key);
    j->started = true;
}

static void open_with(json *j, const char *key, char bracket)
{
    begin_element(j, key);
    text_char(j->out, bracket);
    j->depth++;
    j->started = false;
}

void json_object(json *j, const char *key)
{
    open_with(j, key, '{');
}

void json_list(json *j, const char *key)
{
    open_with(j, key, '[');
}

void json_end(json *j, char bracket)
{
    const bool empty = !j->started;
    const bool compact = j->depth >= COMPACT_DEPTH;
    j->depth--;
    if (!empty && !compact) line_break(j);
    text_char(j->out, bracket);
    j->started = true;
    if (j->depth == 0) text_char(j->out, '\n');
}

void json_string(json *j, const char *key, const char *value)
{
    const size_t n = strlen(value);
    begin_element(j, key);
    text_char(j->out, '"');
    for (size_t i = 0, length; i < n; i += length) {
        unsigned c = (unsigned char)value[i];
        length = utf8_read(value + i, n - i, &c);
        if (c == '"' || c == '\\') text_char(j->out, '\\');
        if (length == 0 || c < 0x20)
            text_printf(j->out, "\\u%04x", c);
        else
            text_append(j->out, value + i, length);
        if (length == 0) length = 1;
    }
    text_char(j->out, '"');
}

void json_number(json *j, const char *key, double value)
{
    begin_element(j, key);
    if (isfinite(value))
        text_double(j->out, value);
    else
        text_add(j->out, "null");
}

void json_bool(json *j, const char *key, bool value)
{
    begin_element(j, key);
    text_add(j->out, value ? "true" : "false");
}
