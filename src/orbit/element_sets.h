/* element_sets.h: choosing the element sets of one satellite from a file of many, whatever its
 * format. */
#ifndef GLINT_ORBIT_ELEMENT_SETS_H
#define GLINT_ORBIT_ELEMENT_SETS_H

#include "orbit/tle.h"

#include <stddef.h>

/* Part of a text, not terminated. */
typedef struct slice {
    const char *at;
    size_t n;
} slice;

/* What choosing needs of an element set, before the set is parsed. */
typedef struct set_entry {
    slice name;       /* trimmed; n = 0 without one */
    slice designator; /* as the file has it; n = 0 without one */
    int number;       /* catalogue number; -1 when there is none, or it cannot be read */
    bool fits;        /* filled in by choosing */
} set_entry;

/* Parses set k of a file. Errors go to the list. */
typedef glint_status set_parser(const void *file, size_t k, tle *out, glint_errors *errors);

/* Parses those of the n sets that fit the query, which must be of one satellite, and gives them in
 * the order of their epochs; of equal epochs the one that stands first in the file is kept. path:
 * copied. asked_from: where the file was asked for (PLACE_NONE allowed). Errors (GLINT_INPUT): none
 * fits (the nearest name is suggested); several different satellites fit (they are named); all
 * those of the parser. *out is empty on error; end it with tle_list_free. */
glint_status element_sets_choose(const char *path, place asked_from, set_entry *entries, size_t n,
                                 const tle_query *query, set_parser *parse, const void *file,
                                 tle_list *out, glint_errors *errors);

/* Without the blanks around it. */
slice slice_trim(slice s);

#endif
