/* orbit_table.h: an orbit given as positions at a row of moments, and interpolation between them.
 */
#ifndef GLINT_ORBIT_ORBIT_TABLE_H
#define GLINT_ORBIT_ORBIT_TABLE_H

#include "base/error.h"

#include <stddef.h>

/* The axes that positions and velocities are given in. EME2000 is turned into GCRS when read, since
 * the turn is constant. */
typedef enum table_frame { TABLE_GCRS, TABLE_TEME, TABLE_ITRS } table_frame;

typedef enum table_method { TABLE_LINEAR, TABLE_LAGRANGE, TABLE_HERMITE } table_method;

/* Highest degree of interpolation that is taken. */
enum { TABLE_MAX_DEGREE = 25, TABLE_TEXT_SIZE = 64 };

/* s: a table answers so much before its first moment and after its last. Dates are rounded, and
 * searches for events take differences over 0.1 s on either side of moments of the run. */
#define TABLE_EDGE_S 0.15

/* One state: position (m) and velocity (m/s). In ITRS the velocity is the one against the Earth. */
typedef struct table_node {
    double t_s; /* TT s from the table's reference */
    double r_m[3], v_m_s[3];
} table_node;

/* A stretch without breaks: nothing is interpolated across its ends. */
typedef struct table_segment {
    char frame_name[TABLE_TEXT_SIZE]; /* as the file has it */
    table_frame frame;
    table_method method;
    int degree;        /* as the file has it, or by default; after orbit_table_finish: as used */
    bool has_velocity; /* else velocities are derivatives of the positions' polynomial */
    bool has_use;      /* the file narrows the use to from_s..to_s */
    double from_s, to_s;
    table_node *nodes; /* owned; in order of time */
    size_t n, capacity;
    int line; /* where it begins in the file; for messages */
} table_segment;

/* A table of one object; immutable once finished, and shared by threads. */
typedef struct orbit_table {
    char object[TABLE_TEXT_SIZE], id[TABLE_TEXT_SIZE]; /* "" where not said */
    const char *format;                                /* "OEM" */
    char *path;                                        /* owned */
    double reference_jd[2];                            /* TT */
    table_segment *segments;                           /* owned; in order of time */
    size_t n, capacity;
} orbit_table;

/* An empty table; NULL when memory is out. path: copied. */
orbit_table *orbit_table_new(const char *path, const char *format);
void orbit_table_free(orbit_table *table);
/* A new segment at the end, to be filled; NULL when memory is out. Earlier segments may move. */
table_segment *orbit_table_add(orbit_table *table);
/* Adds a node behind the others of its segment; false when memory is out. tt_jd: the first one of a
 * table becomes its reference. */
bool orbit_table_add_node(orbit_table *table, table_segment *segment, const double tt_jd[2],
                          const double r_m[3], const double v_m_s[3]);
/* TT s of a moment from the table's reference. */
double orbit_table_seconds(const orbit_table *table, const double tt_jd[2]);
/* True when the frame has that name in files of any of the formats: EME2000, J2000, GCRF, ICRF,
 * TEME, ITRF and their variants. eme2000: whether nodes must be turned by orbit_table_from_eme2000.
 */
bool table_frame_find(const char *name, table_frame *out, bool *eme2000);
/* Turns a node from EME2000 to GCRS by the frame bias of IAU 2006 (23 mas). */
void table_node_from_eme2000(double r_m[3], double v_m_s[3]);

/* Checks that a place (m) is outside the Earth and no farther than 1e7 km, and a velocity (m/s)
 * below 1000 km/s: others are mistakes, mostly of units. unit: the one of the file, "km". Errors:
 * GLINT_INPUT. */
glint_status table_state_check(const double r_m[3], const double v_m_s[3], const char *unit,
                               place where, glint_error *error);

/* Ends the making of a table: checks that there are segments of at least two nodes each, 1 ms to
 * 1e5 s apart (which keeps polynomials finite), in order and without overlap of their use; lowers
 * degrees that a segment has too few nodes for, with a warning. Errors: GLINT_INPUT, all of them.
 */
glint_status orbit_table_finish(orbit_table *table, glint_errors *errors);

/* First and last moment that the table answers for, TT s from its reference; there may be gaps. */
void orbit_table_span(const orbit_table *table, double *from_s, double *to_s);
/* The state at t_s (TT s from the reference), in the axes of *frame. At a moment that two segments
 * share the later one is taken. A Lagrange polynomial of degree k passes through the k + 1 nodes
 * around t_s, Hermite's through (k + 1)/2 of them with their velocities; near the ends of a segment
 * they lie to one side. Nodes are reproduced exactly. Errors: GLINT_INPUT: outside the table, or in
 * a gap, saying in UTC what there is. */
glint_status orbit_table_state(const orbit_table *table, double t_s, table_frame *frame,
                               double r_m[3], double v_m_s[3], glint_error *error);
/* How far interpolation may be off between from_s and to_s (TT s from the reference), m: the
 * largest difference, halfway between records, to polynomials of a higher degree (of a lower one
 * where a segment is too short). At most 64 intervals of a segment are looked at. */
double orbit_table_error_m(const orbit_table *table, double from_s, double to_s);
/* "Hermite": for reports. */
const char *table_method_name(table_method method);

#endif
