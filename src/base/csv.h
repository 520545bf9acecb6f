/* csv.h: reading tables of comma-separated values with the place of every cell. */
#ifndef GLINT_BASE_CSV_H
#define GLINT_BASE_CSV_H

#include "base/error.h"

/* One cell: borrowed from the table's text, surrounding blanks removed, terminated. */
typedef struct csv_cell {
    const char *text;
    int line, column;
} csv_cell;

/* A table with a header line. Lines that begin with '#' and blank lines are skipped; cells may be
 * quoted with " (doubled inside); CRLF is accepted. Every row has as many cells as the header. */
typedef struct csv_table {
    char *path;      /* owned */
    char *bytes;     /* owned */
    csv_cell *cells; /* owned; (n_rows + 1) x n_columns, the header's first */
    int n_columns;
    long n_rows;
    bool may_be_cut; /* the last row ends with the file, without a line end */
} csv_table;

/* Reads a file. Errors (all of the file, GLINT_INPUT): unreadable, no header, a repeated or empty
 * column name, rows of another length, a quote without end. On error the table is empty. */
glint_status csv_read(const char *path, place asked_from, csv_table *table, glint_errors *errors);
void csv_free(csv_table *table);

/* Leaves out a last row without line end, with a warning that names its line: the file may have
 * been cut within its last number. For tables that a longer or shorter version makes no less sound.
 */
void csv_leave_out_cut_row(csv_table *table, glint_errors *errors);

/* Column of that name, or -1. */
int csv_column(const csv_table *table, const char *name);
const csv_cell *csv_at(const csv_table *table, long row, int column);
place csv_place(const csv_table *table, const csv_cell *cell);

/* The number in a cell. Errors: GLINT_INPUT, with the cell's place, when it is not a finite
 * decimal number. */
glint_status csv_number(const csv_table *table, long row, int column, double *value,
                        glint_errors *errors);

#endif
