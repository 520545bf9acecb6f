#include "base/error.h"

#include "base/grow.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Entries kept; what comes after is counted only. A file of a million bad cells must not fill the
 * memory with messages. */
enum { MOST_KEPT = 1000 };

struct glint_errors {
    glint_error *items; /* owned */
    size_t count, capacity, error_count;
};

static void mark_cut(char *text, size_t size)
{
    memcpy(text + size - 4, "...", 4);
}

GLINT_PRINTF(5, 0)
static void fill(glint_error *error, glint_status status, glint_severity severity, place where,
                 const char *format, va_list args)
{
    error->status = status;
    error->severity = severity;
    error->line = where.line;
    error->column = where.column;
    const int nf = snprintf(error->file, sizeof error->file, "%s", where.file ? where.file : "");
    if (nf >= (int)sizeof error->file) mark_cut(error->file, sizeof error->file);
    const int nm = vsnprintf(error->message, sizeof error->message, format, args);
    if (nm >= (int)sizeof error->message) mark_cut(error->message, sizeof error->message);
}

static void append(glint_errors *errors, const glint_error *error)
{
    errors->error_count += error->severity == GLINT_ERROR;
    if (errors->count < MOST_KEPT &&
        grow_list(&errors->items, &errors->capacity, errors->count + 1, sizeof *errors->items))
        errors->items[errors->count++] = *error;
}

glint_status error_set(glint_error *error, glint_status status, place where, const char *format,
                       ...)
{
    if (error) {
        va_list args;
        va_start(args, format);
        fill(error, status, GLINT_ERROR, where, format, args);
        va_end(args);
    }
    return status;
}

glint_status errors_add(glint_errors *errors, glint_status status, place where, const char *format,
                        ...)
{
    if (errors) {
        glint_error error;
        va_list args;
        va_start(args, format);
        fill(&error, status, GLINT_ERROR, where, format, args);
        va_end(args);
        append(errors, &error);
    }
    return status;
}

static bool is_same(const glint_error *a, const glint_error *b)
{
    return a->severity == b->severity && a->line == b->line && a->column == b->column &&
           strcmp(a->file, b->file) == 0 && strcmp(a->message, b->message) == 0;
}

void errors_warn(glint_errors *errors, place where, const char *format, ...)
{
    if (!errors) return;
    glint_error error;
    va_list args;
    va_start(args, format);
    fill(&error, GLINT_OK, GLINT_WARNING, where, format, args);
    va_end(args);
    for (size_t k = 0; k < errors->count; k++)
        if (is_same(&errors->items[k], &error)) return;
    append(errors, &error);
}

glint_status errors_take(glint_errors *errors, const glint_error *error, place where)
{
    if (errors) {
        glint_error copy = *error;
        if (!copy.file[0] && where.file) {
            snprintf(copy.file, sizeof copy.file, "%s", where.file);
            copy.line = where.line;
            copy.column = where.column;
        }
        append(errors, &copy);
    }
    return error->status;
}

/* True when b must stand before a: same file, earlier place. */
static bool is_later(const glint_error *a, const glint_error *b)
{
    if (strcmp(a->file, b->file) != 0 || !a->file[0]) return false;
    return a->line != b->line ? a->line > b->line : a->column > b->column;
}

void errors_sort(glint_errors *errors, size_t first)
{
    for (size_t i = first + 1; errors && i < errors->count; i++) {
        size_t at = i; /* files keep the order of their first entries */
        for (size_t k = i; k > first; k--)
            if (is_later(&errors->items[k - 1], &errors->items[i])) at = k - 1;
        const glint_error moved = errors->items[i];
        memmove(&errors->items[at + 1], &errors->items[at], (i - at) * sizeof moved);
        errors->items[at] = moved;
    }
}

glint_status error_no_memory(glint_error *error)
{
    return error_set(error, GLINT_INTERNAL, PLACE_NONE, "out of memory");
}

glint_status errors_no_memory(glint_errors *errors)
{
    return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
}

glint_errors *glint_errors_new(void)
{
    return calloc(1, sizeof(glint_errors));
}

void glint_errors_free(glint_errors *errors)
{
    if (!errors) return;
    free(errors->items);
    free(errors);
}

size_t glint_errors_count(const glint_errors *errors)
{
    return errors ? errors->count : 0;
}

size_t glint_errors_error_count(const glint_errors *errors)
{
    return errors ? errors->error_count : 0;
}

const glint_error *glint_errors_get(const glint_errors *errors, size_t k)
{
    return errors && k < errors->count ? &errors->items[k] : NULL;
}

void glint_errors_clear(glint_errors *errors)
{
    if (errors) errors->count = errors->error_count = 0;
}
