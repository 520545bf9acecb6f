/* reader.h: reading one table of a TOML tree: each key is asked for by name, type and range; what
 * nobody asked for is unknown. Errors go to the list and reading goes on, so that all are found. */
#ifndef GLINT_SCENARIO_READER_H
#define GLINT_SCENARIO_READER_H

#include "base/param.h"
#include "orbit/clock.h"
#include "scenario/toml.h"

enum { READER_MAX_KEYS = 48 };

/* A table being read. */
typedef struct reader {
    const toml_node *table;
    const toml_node *overlay; /* keys that stand here win over the table's; NULL: none */
    const char *name;         /* "[time]": for messages; borrowed */
    const char *known[READER_MAX_KEYS];
    int n_known;
    glint_errors *errors;
    glint_status status; /* the worst so far */
} reader;

/* Starts reading a table (a node of type TOML_TABLE). */
reader reader_start(const toml_node *table, const char *name, glint_errors *errors);
/* Reports the keys that were not asked for, naming the nearest known one; returns the status. With
 * an overlay those of the overlay alone: the table has been read without it before, and may have
 * keys that count only there. */
glint_status reader_done(reader *r);
/* Adds an error at a place and marks the reading as failed. */
void reader_fail(reader *r, place where, const char *format, ...) GLINT_PRINTF(3, 4);

/* The value of a key, or NULL; makes the key known. */
const toml_node *reader_find(reader *r, const char *key);
bool reader_has(reader *r, const char *key);
/* The value if it is of that type; an error and NULL where it is of another, or required and
 * absent. `expected` says what was expected: "a string". */
const toml_node *reader_get(reader *r, const char *key, toml_type type, bool required,
                            const char *expected);
/* Place of the key's value, or of the table. */
place reader_place(reader *r, const char *key);

/* All return true when the key was given with a good value, and otherwise leave the default in *out
 * (an error is added where the value is bad or required and absent). */

/* A number in the range of its descriptor; the default is the descriptor's. */
bool reader_param(reader *r, const param_info *param, double *out);
/* A whole number. */
bool reader_integer(reader *r, const char *key, bool required, int64_t min, int64_t max,
                    int64_t def, int64_t *out);
bool reader_string(reader *r, const char *key, bool required, const char **out);
bool reader_boolean(reader *r, const char *key, bool def, bool *out);
/* Exactly n finite numbers; *out is untouched without them. */
bool reader_vector(reader *r, const char *key, bool required, int n, double *out);
/* Three numbers, not all zero, made unit. */
bool reader_axis(reader *r, const char *key, bool required, double out[3]);
/* A date-time or a text of one: UTC. */
bool reader_time(reader *r, const char *key, bool required, utc_time *out);
/* One of n words; *out is its index, `def` where absent (def < 0: required). */
bool reader_choice(reader *r, const char *key, const char *const *words, int n, int def, int *out);
/* A table; NULL where absent or of another type. */
const toml_node *reader_table(reader *r, const char *key, bool required);
/* An array whose elements are tables ([[key]]); NULL where absent, of another type, or empty. */
const toml_node *reader_tables(reader *r, const char *key);

/* For single nodes: n finite numbers; what: "size_m", for messages. */
bool node_vector(const toml_node *node, const char *what, int n, double *out, reader *r);
bool node_number(const toml_node *node, const char *what, double *out, reader *r);

#endif
