#include "output/ecsv.h"

#include "output/utf8.h"

#include <string.h>

/* What YAML does not take as it is, or some reader may take for the end of a line: control
 * characters, next line, line and paragraph separator, byte order mark, U+FFFE and U+FFFF. */
static bool needs_escape(unsigned c)
{
    return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x2028 || c == 0x2029 || c == 0xfeff ||
           (c >= 0xfffe && c <= 0xffff);
}

/* A string in YAML's double quotes, on one line: safe for any bytes. Those that are no UTF-8 are
 * taken for Latin-1. */
static void quote(text *t, const char *string, size_t n)
{
    text_char(t, '"');
    for (size_t i = 0, length; i < n; i += length) {
        unsigned c = (unsigned char)string[i];
        length = utf8_read(string + i, n - i, &c);
        if (c == '"' || c == '\\') text_char(t, '\\');
        if (length == 0 || needs_escape(c))
            text_printf(t, c < 0x100 ? "\\x%02x" : "\\u%04x", c);
        else
            text_append(t, string + i, length);
        if (length == 0) length = 1;
    }
    text_char(t, '"');
}

void ecsv_begin(text *t, const glint_column *columns, size_t n)
{
    text_add(t, "# %ECSV 1.0\n# ---\n# delimiter: ','\n# datatype:\n");
    for (size_t i = 0; i < n; i++) {
        text_printf(t, "# - {name: %s", columns[i].name);
        if (columns[i].unit[0]) text_printf(t, ", unit: %s", columns[i].unit);
        text_printf(t, ", datatype: %s, description: ", columns[i].is_text ? "string" : "float64");
        quote(t, columns[i].description, strlen(columns[i].description));
        text_add(t, "}\n");
    }
    text_add(t, "# meta: !!omap\n");
}

void ecsv_fact(text *t, const char *key, const char *value)
{
    text_printf(t, "# - %s: ", key);
    quote(t, value, strlen(value));
    text_char(t, '\n');
}

void ecsv_list(text *t, const char *key)
{
    text_printf(t, "# - %s:\n", key);
}

void ecsv_item(text *t, const char *item, size_t n)
{
    text_add(t, "#   - ");
    quote(t, item, n);
    text_char(t, '\n');
}

void ecsv_end(text *t, const glint_column *columns, size_t n)
{
    text_add(t, "# schema: astropy-2.0\n");
    for (size_t i = 0; i < n; i++)
        text_printf(t, "%s%s", i ? "," : "", columns[i].name);
    text_char(t, '\n');
}

void ecsv_cell(text *t, const char *string)
{
    const size_t n = strlen(string);
    const bool quoted = string[strcspn(string, ",\"\r\n")] != '\0';
    if (quoted) text_char(t, '"');
    for (size_t i = 0, length; i < n; i += length ? length : 1) {
        unsigned c;
        length = utf8_read(string + i, n - i, &c);
        if (string[i] == '"') text_char(t, '"');
        text_append(t, length ? string + i : "?", length ? length : 1);
    }
    if (quoted) text_char(t, '"');
}
