/* toml.h: a TOML file as a plain tree that keeps the place of every key and value. toml++ behind a
 * C face; no C++ type or exception passes it. */
#ifndef GLINT_SCENARIO_TOML_H
#define GLINT_SCENARIO_TOML_H

#include "base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum toml_type {
    TOML_TABLE,
    TOML_ARRAY,
    TOML_STRING,
    TOML_INTEGER,
    TOML_FLOAT,
    TOML_BOOLEAN,
    TOML_TIME /* a date, a time of day, or both */
} toml_type;

/* A date-time as written. */
typedef struct toml_moment {
    int year, month, day, hour, minute, second, nanosecond, offset_min;
    bool has_date, has_time, has_offset;
} toml_moment;

typedef struct toml_node toml_node;
struct toml_node {
    toml_type type;
    bool is_inline;      /* a table written in braces */
    place where;         /* of the value */
    place key_where;     /* of the key; of the value where it has none */
    char *key;           /* owned; NULL for array elements and the root */
    toml_node *children; /* owned; of tables and arrays, in the order of the file */
    int n_children;
    char *string;       /* owned; TOML_STRING, terminated; no zero byte inside */
    double number;      /* TOML_INTEGER and TOML_FLOAT: finite */
    int64_t integer;    /* TOML_INTEGER */
    bool boolean;       /* TOML_BOOLEAN */
    toml_moment moment; /* TOML_TIME */
};

/* A file and its tree. `path` is what the places of its nodes point at. */
typedef struct toml_document {
    char *path; /* owned */
    char *text; /* owned; the file's bytes, terminated */
    toml_node root;
} toml_document;

/* Reads a regular file. asked_from: place of the value that names it, for messages. Errors:
 * GLINT_INPUT: unreadable; the first syntax error with its place; a key of more than 16 parts; nan
 * and inf among the values, and strings with a zero byte, all of them. */
glint_status toml_read(const char *path, place asked_from, toml_document **out,
                       glint_errors *errors);
void toml_free(toml_document *document);

/* Applies "key=value" (a dotted key, a TOML value) to a document: tables on the way are made where
 * absent, elements of arrays are named by their number from 0. Errors: GLINT_INPUT, GLINT_ARGUMENT
 * for a text that is not of that form. */
glint_status toml_override(toml_document *document, const char *assignment, glint_errors *errors);

/* Child of a table by its key, or NULL. */
const toml_node *toml_child(const toml_node *table, const char *key);
/* "a table", "a string", ...: for messages. */
const char *toml_type_name(toml_type type);

#ifdef __cplusplus
}
#endif
#endif
