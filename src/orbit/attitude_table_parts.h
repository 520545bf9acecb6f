/* attitude_table_parts.h: what the readers of attitude files share; for attitude_table*.c alone. */
#ifndef GLINT_ORBIT_ATTITUDE_TABLE_PARTS_H
#define GLINT_ORBIT_ATTITUDE_TABLE_PARTS_H

#include "orbit/attitude_table.h"

/* Axes that files name; the first four are those of spans. */
typedef enum file_frame {
    FILE_GCRS = ATTITUDE_GCRS,
    FILE_LVLH = ATTITUDE_LVLH,
    FILE_RSW = ATTITUDE_RSW,
    FILE_ITRS = ATTITUDE_ITRS,
    FILE_EME2000, /* turned into GCRS by the frame bias */
    FILE_TEME     /* of each row's date; turned into GCRS */
} file_frame;

/* A table being read. */
typedef struct attitude_reading {
    attitude_table *table;
    const run_clock *clock; /* borrowed */
    glint_errors *errors;
    glint_status status; /* the worst so far */
    file_frame frame;    /* of the span being read */
    double
        told_rad_s; /* how fast the body turns at the next row, as the file says; 0: it does not */
    /* the two rows of one span between which the body turns most: by the shortest way or, where
     * that is more, by what the file says of its rate */
    double widest_rad;
    place widest_where;
} attitude_reading;

/* Adds an error of the file and marks the reading as failed. */
void attitude_table_fail(attitude_reading *r, place where, const char *format, ...)
    GLINT_PRINTF(3, 4);

/* Begins a span with the next row. */
void attitude_table_begin_span(attitude_reading *r, file_frame frame, place where);
/* Adds a row to the last span. q: v_frame = q v_body q*, of norm 1 within ATTITUDE_NORM_TOLERANCE.
 * Errors: the norm; a time that does not come after the row before; more than 2e9 s from the
 * start. */
void attitude_table_add_row(attitude_reading *r, double t_s, const double q[4], place where);
/* Ends the last span and narrows it to from_s..to_s (infinite: to its rows). Errors: no rows; no
 * time is left. */
void attitude_table_end_span(attitude_reading *r, double from_s, double to_s);

/* The readers of single kinds. bytes: of the whole file, terminated, from malloc, taken over. */
void attitude_aem_read(attitude_reading *r, char *bytes, size_t size, const char *object);
void attitude_stk_read(attitude_reading *r, char *bytes, size_t size);
void attitude_csv_read(attitude_reading *r, attitude_frame frame, place asked_from);

#endif
