/* json.h: writing JSON (RFC 8259): commas, line breaks and escapes are taken care of. */
#ifndef GLINT_OUTPUT_JSON_H
#define GLINT_OUTPUT_JSON_H

#include "base/text.h"

/* A document being written; zero-initialise, set `out`. */
typedef struct json {
    text *out;    /* borrowed */
    int depth;    /* of objects and lists that are open */
    bool started; /* the open one has an element */
} json;

/* Each writes an element of what is open. key: plain ASCII without quotes; NULL inside a list and
 * for the document itself. */
void json_object(json *j, const char *key);
void json_list(json *j, const char *key);
/* Ends the object or list that is open: '}' or ']'. The document ends with a line break. */
void json_end(json *j, char bracket);
/* Any bytes; those that are no UTF-8 are taken for Latin-1. */
void json_string(json *j, const char *key, const char *value);
/* null where the value is not finite. */
void json_number(json *j, const char *key, double value);
void json_bool(json *j, const char *key, bool value);

#endif
