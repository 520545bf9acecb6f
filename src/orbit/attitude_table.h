/* attitude_table.h: attitudes given in a file: quaternions over time, in spans without gaps. */
#ifndef GLINT_ORBIT_ATTITUDE_TABLE_H
#define GLINT_ORBIT_ATTITUDE_TABLE_H

#include "orbit/attitude.h"

struct text;

/* What a span's quaternions turn the body's axes into. */
typedef enum attitude_frame {
    ATTITUDE_GCRS,
    ATTITUDE_LVLH, /* of the law 'nadir' */
    ATTITUDE_RSW,  /* of the law 'rsw' */
    ATTITUDE_ITRS
} attitude_frame;

/* Rows that belong together: nothing is read between spans. */
typedef struct attitude_span {
    attitude_frame frame;
    long first, n;       /* of the table's rows */
    double from_s, to_s; /* usable: within the times of the rows; TT s from the start */
    place where;         /* of its first row; the file borrowed from the table */
} attitude_span;

typedef struct attitude_table {
    char *path;       /* owned */
    const char *kind; /* "CCSDS AEM": for reports */
    double *t_s;      /* owned; n; TT s from the start, ascending within a span */
    double (*q)[4];   /* owned; n; unit: v_frame = q v_body q* */
    long n;
    size_t capacity;
    attitude_span *spans; /* owned; by time once the table is complete, which do not overlap */
    int n_spans, span_capacity;
} attitude_table;

/* Most that the norm of a quaternion may differ from 1: three decimals in a file leave 1e-3. */
#define ATTITUDE_NORM_TOLERANCE 2e-3

/* Reads a file of one of the three kinds, told apart by what it begins with: a CCSDS attitude
 * ephemeris message (AEM 1.0 and 2.0; KVN and XML), an STK attitude file (.a), a CSV table.
 * object: OBJECT_NAME or OBJECT_ID in an AEM of several; NULL: there must be one only. csv_frame:
 * of a CSV table's quaternions; NULL: not said, which is GCRS, and the others must not be told.
 * asked_from: place of the value that names the file. Warnings: rows so far apart that the way
 * between them is a guess. Errors (GLINT_INPUT; all of the file). */
glint_status attitude_table_read(const char *path, const char *object,
                                 const attitude_frame *csv_frame, const run_clock *clock,
                                 place asked_from, attitude_table **out, glint_errors *errors);
/* NULL allowed. */
void attitude_table_free(attitude_table *t);

/* Body axes at a moment: v_body = R v_gcrs; between rows by the shortest way at a steady rate.
 * Errors (GLINT_INPUT): no span covers the moment, saying which are nearest. */
glint_status attitude_table_at(const attitude_table *t, const moment *m, double body_gcrs[9],
                               glint_error *error);
/* The first time after t_s at which a row stands, and the rates may change; INFINITY past the last.
 */
double attitude_table_next_row(const attitude_table *t, double t_s);
/* "CCSDS AEM 'file', 2 spans from t_s = 0 to 600 s". */
void attitude_table_describe(const attitude_table *t, struct text *out);
/* The first moment between from_s and to_s that no span covers, through *gap_s; false where all are
 * covered. */
bool attitude_table_gap(const attitude_table *t, double from_s, double to_s, double *gap_s);

#endif
