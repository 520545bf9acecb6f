/* attitude.h: which way the satellite is turned: laws that give body axes from the moment.
 *
 * A law is one row in the table; its keys, kinds, defaults stand there, and the reader follows. */
#ifndef GLINT_ORBIT_ATTITUDE_H
#define GLINT_ORBIT_ATTITUDE_H

#include "orbit/clock.h"
#include "orbit/direction.h"
#include "orbit/torque_free.h"

typedef enum attitude_key_kind {
    ATTITUDE_NUMBER,     /* value[0] */
    ATTITUDE_VECTOR,     /* 3 numbers */
    ATTITUDE_AXIS,       /* body axis: 3 numbers, not all zero; made unit by the reader */
    ATTITUDE_DIRECTION,  /* of the vocabulary */
    ATTITUDE_QUATERNION, /* w, x, y, z; norm 1 within 1e-6, made unit by the reader */
    ATTITUDE_EPOCH,      /* a UTC time; value[0] = TT s from the start of the run */
    ATTITUDE_WORD,       /* one of the key's words; value[0] = its index */
    ATTITUDE_STRING,     /* text */
    ATTITUDE_PATH        /* a file's path: `path` of the spec */
} attitude_key_kind;

typedef struct attitude_key {
    const char *name, *unit, *doc;
    attitude_key_kind kind;
    bool required;
    double def; /* default of ATTITUDE_NUMBER, ATTITUDE_EPOCH (0: the start), ATTITUDE_WORD */
    const char *const *words; /* of ATTITUDE_WORD; NULL ends them */
} attitude_key;

enum { ATTITUDE_MAX_KEYS = 8 };

/* A law with its values in the order of its keys; angles still in the key's unit. Plain data. */
typedef struct attitude_spec {
    const struct attitude_law *law;
    place where, key_place[ATTITUDE_MAX_KEYS];
    bool given[ATTITUDE_MAX_KEYS];
    double value[ATTITUDE_MAX_KEYS][4];
    direction to[ATTITUDE_MAX_KEYS];
    const char *text[ATTITUDE_MAX_KEYS]; /* borrowed; NULL where not given */
    char *path;                          /* as seen from the working directory; the maker's */
    const run_clock *clock;              /* borrowed; what files' times are counted from */
    bool has_offset;
    double offset_axis[3], offset_rad; /* unit, body; a turn after the law: mispointing */
} attitude_spec;

/* Ready to evaluate; immutable. attitude_free ends it. */
typedef struct attitude {
    const struct attitude_law *law;
    double axis[3], second_axis[3]; /* unit, body */
    direction to, second_to; /* what the law looks at; a law without keys for them sets them too */
    double matrix[9];        /* the law's own: body_gcrs (inertial), or the triad that the body axes
                              * span, as rows in body coordinates (point, spin) */
    double rate_rad_s;       /* right-handed about `axis` */
    torque_free tumble;      /* torque-free */
    double phase_rad;        /* turned at the epoch */
    double epoch_s;          /* TT s from the start */
    bool geodetic;           /* nadir: straight down to the ellipsoid, not to the centre */
    struct attitude_table *table; /* table: owned */
    double offset[9];             /* v_body = offset v_law; identity where none */
    bool has_offset;
} attitude;

enum { ATTITUDE_NEEDS_ORBIT = 1u }; /* needs r, v: not for runs without an orbit */

/* How a law turns the body by itself, besides following the directions that it looks at. */
typedef struct attitude_turning {
    double fastest_rad_s; /* it turns no faster; 0: not at all */
    bool is_steady;       /* it is one turn, at that rate for ever, about this axis: */
    double axis_body[3];  /* unit */
} attitude_turning;

typedef struct attitude_law {
    const char *name, *doc;
    const attitude_key *keys;
    int n_keys;
    unsigned flags;
    /* Turns values into numbers; *out comes zeroed, with its law. Errors (all found): axes parallel
     * within 1e-9, both or neither of two exclusive keys, ... at the places of the keys. */
    glint_status (*prepare)(const attitude_spec *spec, attitude *out, glint_errors *errors);
    /* body_gcrs: v_body = R v_gcrs. Errors (GLINT_INPUT): directions parallel within 1e-9 at this
     * moment. */
    glint_status (*at)(const attitude *a, const moment *m, double body_gcrs[9], glint_error *error);
    /* Fills *out, which comes zeroed, in the law's axes. NULL: it only follows directions. */
    void (*turning)(const attitude *a, attitude_turning *out);
} attitude_law;

/* Law k of the table, counted from 0; NULL past the end. */
const attitude_law *attitude_law_at(size_t k);
/* NULL when there is no such law. */
const attitude_law *attitude_law_named(const char *name);
/* Position of a key in law->keys, or -1. */
int attitude_key_index(const attitude_law *law, const char *name);
/* A spec with no key given: defaults, and `where` (of the law; file borrowed) as the place of every
 * key until the reader knows better. */
void attitude_spec_start(const attitude_law *law, place where, attitude_spec *spec);

/* Prepares a law with its offset. Errors (all found, GLINT_INPUT, at the places of the keys): a
 * required key is not given; a number is not finite; those of the law. */
glint_status attitude_prepare(const attitude_spec *spec, attitude *out, glint_errors *errors);
/* Frees what a prepared attitude owns. Zeroed and failed ones are allowed. */
void attitude_free(attitude *a);
/* Evaluates it: v_body = R v_gcrs; R is orthogonal and right-handed to rounding. Errors
 * (GLINT_INPUT): a direction is not defined, or two are parallel, at this moment; saying when. */
glint_status attitude_at(const attitude *a, const moment *m, double body_gcrs[9],
                         glint_error *error);
/* How it turns by itself; axis in body axes, with the offset. */
attitude_turning attitude_turning_of(const attitude *a);
/* True when the law looks at that direction: whether the Moon has to be computed. */
bool attitude_wants(const attitude *a, direction_kind kind);

#endif
