/* ecsv.h: the header of a table in ECSV 1.0 (Astropy APE 6): a YAML document in comment lines, then
 * the names of the columns. A table is begun with ecsv_begin, given its facts, and ended with
 * ecsv_end; rows follow. */
#ifndef GLINT_OUTPUT_ECSV_H
#define GLINT_OUTPUT_ECSV_H

#include "base/text.h"

/* The version of the format, and name, unit, type and description of n columns. */
void ecsv_begin(text *t, const glint_column *columns, size_t n);
/* One fact, "key: value". Keys are unique and plain words. */
void ecsv_fact(text *t, const char *key, const char *value);
/* A fact that is a list: its key, then its items, the n bytes at `item` each. */
void ecsv_list(text *t, const char *key);
void ecsv_item(text *t, const char *item, size_t n);
/* The end of the header and the line of the columns' names. */
void ecsv_end(text *t, const glint_column *columns, size_t n);
/* Appends a text as a cell of a row: quoted where it holds a comma, a quote or a line break, and
 * '?' for bytes that are no UTF-8. */
void ecsv_cell(text *t, const char *string);

#endif
