/* omm_json.c: OMM as JSON through jansson. */
#include "base/text.h"
#include "orbit/omm_parts.h"

#include <jansson.h>

#include <stdlib.h>
#include <string.h>

/* Where objects begin: jansson keeps no places. */
typedef struct place_finder {
    const char *at, *line_start;
    int line;
} place_finder;

/* Goes to the next '{' outside strings that stands `depth` brackets deep. */
static bool next_object(place_finder *f, int wanted_depth, int *depth)
{
    for (; *f->at; f->at++) {
        const char c = *f->at;
        if (c == '\n') {
            f->line++;
            f->line_start = f->at + 1;
        } else if (c == '"') {
            for (f->at++; *f->at && *f->at != '"'; f->at++)
                if (*f->at == '\\' && f->at[1]) f->at++;
            if (!*f->at) return false;
        } else if (c == '[' || c == '{') {
            if ((*depth)++ == wanted_depth && c == '{') return true;
        } else if (c == ']' || c == '}') {
            --*depth;
        }
    }
    return false;
}

/* A value as text; numbers with the digits that read back exactly. False for other types. */
static bool append_value(text *texts, const json_t *value)
{
    if (json_is_string(value))
        text_append(texts, json_string_value(value), json_string_length(value));
    else if (json_is_integer(value))
        text_printf(texts, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
    else if (json_is_real(value))
        text_double(texts, json_real_value(value));
    else if (!json_is_null(value))
        return false;
    text_append(texts, "", 1);
    return true;
}

/* Texts grow while records refer to them: offsets stand in place of addresses until the end. */
static glint_status add_object(const json_t *object, place where, omm_file *file, text *texts,
                               size_t (*offsets)[OMM_KEYS], glint_errors *errors)
{
    omm_record *record = omm_add_record(file);
    if (!record) return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    record->line = where.line;
    record->column = where.column;
    const char *keyword;
    json_t *value;
    for (void *at = json_object_iter((json_t *)(uintptr_t)object); at;
         at = json_object_iter_next((json_t *)(uintptr_t)object, at)) {
        keyword = json_object_iter_key(at);
        value = json_object_iter_value(at);
        const int key = omm_key_of(keyword);
        if (key < 0) continue;
        (*offsets)[key] = texts->length;
        if (!append_value(texts, value))
            return errors_add(
                errors, GLINT_INPUT, where,
                "%.40s of this object is neither a text nor a number; expected one of "
                "them",
                keyword);
        record->values[key] = (omm_value){"", "", where.line, where.column};
    }
    return GLINT_OK;
}

static glint_status load_objects(json_t *root, const char *bytes, omm_file *file, text *texts,
                                 size_t (*offsets)[OMM_KEYS], glint_errors *errors)
{
    const bool is_array = json_is_array(root);
    const size_t n = is_array ? json_array_size(root) : 1;
    place_finder finder = {bytes, bytes, 1};
    int depth = 0;
    for (size_t k = 0; k < n; k++) {
        const json_t *object = is_array ? json_array_get(root, k) : root;
        if (!json_is_object(object))
            return errors_add(errors, GLINT_INPUT, (place){file->path, 0, 0},
                              "element %zu of the array is no object; expected objects with the "
                              "keywords of OMM",
                              k);
        place where = {file->path, 0, 0};
        if (next_object(&finder, is_array, &depth)) {
            where = (place){file->path, finder.line, (int)(finder.at - finder.line_start) + 1};
            finder.at++;
        }
        const glint_status status = add_object(object, where, file, texts, &offsets[k], errors);
        if (status) return status;
    }
    return GLINT_OK;
}

/* jansson's place of an error, with lines and columns from 1. */
static glint_status refuse(const omm_file *file, const json_error_t *error, glint_errors *errors)
{
    return errors_add(errors, GLINT_INPUT,
                      (place){file->path, error->line > 0 ? error->line : 0,
                              error->column > 0 ? error->column : 0},
                      "this is no whole JSON: %s; the file is cut or damaged: get it again",
                      error->text);
}

glint_status omm_load_json(const char *bytes, size_t size, omm_file *file, char **texts,
                           glint_errors *errors)
{
    *texts = NULL;
    const size_t mark = strncmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    json_error_t error;
    json_t *root = json_loadb(bytes + mark, size - mark, JSON_REJECT_DUPLICATES, &error);
    if (!root) return refuse(file, &error, errors);
    const size_t n = json_is_array(root) ? json_array_size(root) : 1;
    size_t(*offsets)[OMM_KEYS] = calloc(n ? n : 1, sizeof *offsets);
    text kept = {0};
    glint_status status = GLINT_INTERNAL;
    if (offsets) status = load_objects(root, bytes + mark, file, &kept, offsets, errors);
    if (!offsets || kept.failed)
        status = errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    for (size_t k = 0; k < file->n && !status; k++)
        for (int key = 0; key < OMM_KEYS; key++)
            if (file->records[k].values[key].text)
                file->records[k].values[key].text = kept.data + offsets[k][key];
    free(offsets);
    json_decref(root);
    if (status)
        text_free(&kept);
    else
        *texts = kept.data;
    return status;
}
