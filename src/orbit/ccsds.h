/* ccsds.h: navigation messages of the CCSDS (OMM, OEM, AEM) in both of their notations, KVN
 * (keyword = value lines; CCSDS 502.0-B-3, section 7) and XML (CCSDS 505.0-B-3), as one list of
 * items with their places. */
#ifndef GLINT_ORBIT_CCSDS_H
#define GLINT_ORBIT_CCSDS_H

#include "base/error.h"

typedef enum ccsds_kind {
    CCSDS_VALUE, /* keyword and value; in XML an element that has no elements inside */
    CCSDS_BEGIN, /* a block begins: META_START in KVN, <metadata> in XML */
    CCSDS_END,
    CCSDS_LINE /* a line of KVN without '=': a record of a table */
} ccsds_kind;

/* One item. Keywords are in capitals whatever the file has. KVN's META_START and META_STOP begin
 * and end the block METADATA, X_START and X_STOP of any other X the block X; XML's elements begin
 * and end blocks of their own names (STATEVECTOR). The element of a message gives the item that
 * KVN begins with: <oem version="2.0"> is CCSDS_OEM_VERS with the value 2.0. */
typedef struct ccsds_item {
    ccsds_kind kind;
    const char *keyword; /* of CCSDS_LINE: "" */
    const char *value;   /* without blanks around; a unit in brackets is still in it (KVN) */
    const char *unit;    /* XML: the attribute `units`; "" without one */
    int line, column;    /* of the value in KVN, of the element in XML */
} ccsds_item;

/* A file of messages; immutable after reading. */
typedef struct ccsds_file {
    const char *path;  /* borrowed */
    bool is_xml;       /* else KVN */
    ccsds_item *items; /* owned array; texts borrowed from `texts` */
    size_t count, capacity;
    char *texts; /* owned */
} ccsds_file;

/* True when the bytes begin as XML does (after a byte order mark and blanks). */
bool ccsds_is_xml(const char *bytes);

/* Reads a file. asked_from: place of the value that names it (PLACE_NONE allowed). Comments and
 * blank lines are left out. The last line of a KVN file is left out with a warning when it has no
 * line end, since it may be cut (but for lines that end a block). Errors (GLINT_INPUT): unreadable;
 * not text; XML that is not well formed (a file cut short never is), has a document type
 * declaration or is nested deeper than 32 elements. *out is empty on error; end it with ccsds_free.
 */
glint_status ccsds_read(const char *path, place asked_from, ccsds_file *out, glint_errors *errors);
/* The same of bytes that are read already: terminated, from malloc; taken over in any case. */
glint_status ccsds_scan(const char *path, char *bytes, size_t size, ccsds_file *out,
                        glint_errors *errors);
void ccsds_free(ccsds_file *file);

place ccsds_place(const ccsds_file *file, const ccsds_item *item);
/* True for an item of that kind and keyword. */
bool ccsds_is(const ccsds_item *item, ccsds_kind kind, const char *keyword);
/* True when the value is that word, letter case ignored. */
bool ccsds_says(const ccsds_item *item, const char *word);
/* The number of an item. unit: the one that the standard gives it ("km"), which is what a unit in
 * brackets or in the attribute must be, letter case ignored; NULL: any. Errors: GLINT_INPUT, with
 * the item's place: no finite decimal number, another unit. */
glint_status ccsds_number(const ccsds_file *file, const ccsds_item *item, const char *unit,
                          double *value, glint_errors *errors);

#endif
