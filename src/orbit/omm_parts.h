/* omm_parts.h: what the notations of OMM share: records of keywords and values. */
#ifndef GLINT_ORBIT_OMM_PARTS_H
#define GLINT_ORBIT_OMM_PARTS_H

#include "base/error.h"

#include <stddef.h>

typedef enum omm_key {
    OMM_OBJECT_NAME,
    OMM_OBJECT_ID,
    OMM_CENTER_NAME,
    OMM_REF_FRAME,
    OMM_TIME_SYSTEM,
    OMM_THEORY,
    OMM_EPOCH,
    OMM_MEAN_MOTION,
    OMM_ECCENTRICITY,
    OMM_INCLINATION,
    OMM_NODE,
    OMM_PERICENTER,
    OMM_ANOMALY,
    OMM_EPHEMERIS_TYPE,
    OMM_NUMBER,
    OMM_BSTAR,
    OMM_MOTION_DOT,
    OMM_BTERM,
    OMM_AGOM,
    OMM_KEYS
} omm_key;

/* The keyword of the standard. */
const char *omm_keyword(omm_key key);
/* The key of a keyword, letter case ignored; -1 when it is not one of these. */
int omm_key_of(const char *keyword);

/* A value as the file has it. */
typedef struct omm_value {
    const char *text; /* borrowed; NULL: absent */
    const char *unit; /* "" without one */
    int line, column;
} omm_value;

typedef struct omm_record {
    int line, column; /* where it begins */
    omm_value values[OMM_KEYS];
} omm_record;

/* All records of a file. */
typedef struct omm_file {
    const char *path;    /* borrowed */
    bool says_all;       /* KVN and XML: frame, centre, time system and theory must be said */
    omm_record *records; /* owned */
    size_t n, capacity;
} omm_file;

/* A new record at the end; NULL when memory is out. */
omm_record *omm_add_record(omm_file *file);
/* Reads JSON: an array of objects, or one object. *texts: keeps what the records borrow, free()d by
 * the caller. Errors: GLINT_INPUT: no JSON (a file cut short never is), other types. */
glint_status omm_load_json(const char *bytes, size_t size, omm_file *file, char **texts,
                           glint_errors *errors);

#endif
