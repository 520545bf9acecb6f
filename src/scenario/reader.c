#include "scenario/reader.h"

#include "base/text.h"
#include "base/vec.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

reader reader_start(const toml_node *table, const char *name, glint_errors *errors)
{
    return (reader){.table = table, .name = name, .errors = errors};
}

void reader_fail(reader *r, place where, const char *format, ...)
{
    char message[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    r->status = errors_add(r->errors, GLINT_INPUT, where, "%s", message);
}

static bool is_known(const reader *r, const char *key)
{
    for (int i = 0; i < r->n_known; i++)
        if (string_equal(r->known[i], key)) return true;
    return false;
}

static void report_unknown(reader *r, const toml_node *table)
{
    for (int i = 0; table && i < table->n_children; i++) {
        const toml_node *child = &table->children[i];
        if (is_known(r, child->key)) continue;
        const char *near = nearest_name(child->key, r->known, (size_t)r->n_known);
        text list = {0};
        for (int k = 0; k < r->n_known; k++)
            text_printf(&list, "%s%s", k ? ", " : "", r->known[k]);
        if (near)
            reader_fail(r, child->key_where, "unknown key '%.60s' in %s; did you mean '%s'?",
                        child->key, r->name, near);
        else
            reader_fail(r, child->key_where, "unknown key '%.60s' in %s; expected one of: %s",
                        child->key, r->name, list.data ? list.data : "(none)");
        text_free(&list);
    }
}

glint_status reader_done(reader *r)
{
    report_unknown(r, r->overlay ? r->overlay : r->table);
    return r->status;
}

const toml_node *reader_find(reader *r, const char *key)
{
    if (!is_known(r, key) && r->n_known < READER_MAX_KEYS) r->known[r->n_known++] = key;
    const toml_node *node = r->overlay ? toml_child(r->overlay, key) : NULL;
    return node ? node : toml_child(r->table, key);
}

bool reader_has(reader *r, const char *key)
{
    return reader_find(r, key) != NULL;
}

place reader_place(reader *r, const char *key)
{
    const toml_node *node = reader_find(r, key);
    return node ? node->where : r->table->where;
}

/* What a node holds, shortly, for messages. */
static void describe(const toml_node *node, char *out, size_t size)
{
    if (node->type == TOML_STRING)
        snprintf(out, size, "the string \"%.40s\"", node->string);
    else if (node->type == TOML_INTEGER || node->type == TOML_FLOAT)
        snprintf(out, size, "the number %g", node->number);
    else if (node->type == TOML_BOOLEAN)
        snprintf(out, size, "%s", node->boolean ? "true" : "false");
    else
        snprintf(out, size, "%s", toml_type_name(node->type));
}

static void fail_type(reader *r, const toml_node *node, const char *key, const char *expected)
{
    char found[80];
    describe(node, found, sizeof found);
    reader_fail(r, node->where, "'%s' is %s; expected %s", key, found, expected);
}

static void fail_missing(reader *r, const char *key, const char *expected)
{
    reader_fail(r, r->table->where, "%s has no '%s'; expected %s", r->name, key, expected);
}

const toml_node *reader_get(reader *r, const char *key, toml_type type, bool required,
                            const char *expected)
{
    const toml_node *node = reader_find(r, key);
    if (!node) {
        if (required) fail_missing(r, key, expected);
        return NULL;
    }
    if (node->type == type || (type == TOML_FLOAT && node->type == TOML_INTEGER)) return node;
    fail_type(r, node, key, expected);
    return NULL;
}

bool reader_param(reader *r, const param_info *param, double *out)
{
    char range[PARAM_RANGE_SIZE], expected[PARAM_RANGE_SIZE + 64];
    param_range_text(param, range);
    const bool unit = param->unit && param->unit[0];
    snprintf(expected, sizeof expected, "a number%s%s, %s", unit ? " in " : "",
             unit ? param->unit : "", range);
    const bool required = param_is_required(param);
    *out = required ? 0.0 : param->def;
    const toml_node *node = reader_get(r, param->name, TOML_FLOAT, required, expected);
    if (!node) return false;
    if (!param_accepts(param, node->number)) {
        fail_type(r, node, param->name, expected);
        return false;
    }
    *out = node->number;
    return true;
}

bool reader_integer(reader *r, const char *key, bool required, int64_t min, int64_t max,
                    int64_t def, int64_t *out)
{
    char expected[96];
    snprintf(expected, sizeof expected, "a whole number from %lld to %lld", (long long)min,
             (long long)max);
    *out = def;
    const toml_node *node = reader_get(r, key, TOML_INTEGER, required, expected);
    if (!node) return false;
    if (node->integer < min || node->integer > max) {
        fail_type(r, node, key, expected);
        return false;
    }
    *out = node->integer;
    return true;
}

bool reader_string(reader *r, const char *key, bool required, const char **out)
{
    const toml_node *node = reader_get(r, key, TOML_STRING, required, "a string");
    if (node) *out = node->string;
    return node != NULL;
}

bool reader_boolean(reader *r, const char *key, bool def, bool *out)
{
    *out = def;
    const toml_node *node = reader_get(r, key, TOML_BOOLEAN, false, "true or false");
    if (node) *out = node->boolean;
    return node != NULL;
}

bool node_number(const toml_node *node, const char *what, double *out, reader *r)
{
    if (node->type != TOML_INTEGER && node->type != TOML_FLOAT) {
        fail_type(r, node, what, "a number");
        return false;
    }
    *out = node->number;
    return true;
}

bool node_vector(const toml_node *node, const char *what, int n, double *out, reader *r)
{
    if (node->type != TOML_ARRAY) {
        char expected[48];
        snprintf(expected, sizeof expected, "%d numbers in brackets", n);
        fail_type(r, node, what, expected);
        return false;
    }
    if (node->n_children != n) {
        reader_fail(r, node->where, "'%s' has %d elements; expected %d numbers", what,
                    node->n_children, n);
        return false;
    }
    double read[16];
    bool good = n <= 16;
    for (int i = 0; i < n && i < 16; i++)
        good = node_number(&node->children[i], what, &read[i], r) && good;
    if (good) memcpy(out, read, (size_t)n * sizeof *out);
    return good;
}

bool reader_vector(reader *r, const char *key, bool required, int n, double *out)
{
    const toml_node *node = reader_find(r, key);
    if (!node) {
        char expected[48];
        snprintf(expected, sizeof expected, "%d numbers in brackets", n);
        if (required) fail_missing(r, key, expected);
        return false;
    }
    return node_vector(node, key, n, out, r);
}

bool reader_axis(reader *r, const char *key, bool required, double out[3])
{
    double v[3];
    if (!reader_vector(r, key, required, 3, v)) return false;
    if (unit3(v, out) > 0.0) return true;
    reader_fail(r, reader_place(r, key), "'%s' is a zero vector; expected a direction", key);
    return false;
}

static utc_time utc_of(const toml_moment *m)
{
    return (utc_time){.year = m->year,
                      .month = m->month,
                      .day = m->day,
                      .hour = m->hour,
                      .minute = m->minute,
                      .second = m->second + 1e-9 * m->nanosecond};
}

bool reader_time(reader *r, const char *key, bool required, utc_time *out)
{
    static const char EXPECTED[] = "a UTC time such as 2025-07-24T19:10:00Z";
    const toml_node *node = reader_find(r, key);
    if (!node) {
        if (required) fail_missing(r, key, EXPECTED);
        return false;
    }
    glint_error error = {0};
    glint_status status;
    utc_time read;
    if (node->type == TOML_STRING) {
        status = utc_parse(node->string, node->where, &read, &error);
    } else if (node->type == TOML_TIME && node->moment.has_date) {
        const toml_moment *m = &node->moment;
        if (m->has_offset && m->offset_min != 0) { /* one way to take offsets off: as a text */
            char written[64];
            const int off = m->offset_min < 0 ? -m->offset_min : m->offset_min;
            snprintf(written, sizeof written, "%04d-%02d-%02dT%02d:%02d:%02d.%09d%c%02d:%02d",
                     m->year, m->month, m->day, m->hour, m->minute, m->second, m->nanosecond,
                     m->offset_min < 0 ? '-' : '+', off / 60, off % 60);
            status = utc_parse(written, node->where, &read, &error);
        } else {
            read = utc_of(m);
            status = utc_check(&read, node->where, &error);
        }
    } else {
        fail_type(r, node, key, EXPECTED);
        return false;
    }
    if (status) {
        r->status = errors_take(r->errors, &error, node->where);
        return false;
    }
    *out = read;
    return true;
}

bool reader_choice(reader *r, const char *key, const char *const *words, int n, int def, int *out)
{
    *out = def < 0 ? 0 : def;
    const char *word;
    if (!reader_string(r, key, def < 0, &word)) return false;
    text list = {0};
    for (int i = 0; i < n; i++) {
        if (string_equal(word, words[i])) {
            *out = i;
            text_free(&list);
            return true;
        }
        text_printf(&list, "%s%s", i ? ", " : "", words[i]);
    }
    const char *near = nearest_name(word, words, (size_t)n);
    reader_fail(r, reader_place(r, key), "'%s' is \"%.40s\"; expected one of: %s%s%s%s", key, word,
                list.data ? list.data : "", near ? " (did you mean \"" : "", near ? near : "",
                near ? "\"?)" : "");
    text_free(&list);
    return false;
}

const toml_node *reader_table(reader *r, const char *key, bool required)
{
    char expected[96];
    snprintf(expected, sizeof expected, "a table [%s]", key);
    return reader_get(r, key, TOML_TABLE, required, expected);
}

const toml_node *reader_tables(reader *r, const char *key)
{
    char expected[96];
    snprintf(expected, sizeof expected, "tables [[%s]]", key);
    const toml_node *node = reader_get(r, key, TOML_ARRAY, false, expected);
    if (!node) return NULL;
    for (int i = 0; i < node->n_children; i++)
        if (node->children[i].type != TOML_TABLE) {
            fail_type(r, &node->children[i], key, expected);
            return NULL;
        }
    return node->n_children ? node : NULL;
}
