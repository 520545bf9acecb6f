/* attitude_csv.c: attitudes as a CSV table: t_s or utc, and qw, qx, qy, qz with v_frame = q v_body
 * q*. */
#include "orbit/attitude_table_parts.h"
#include "orbit/time_column.h"

#include <math.h>
#include <stdlib.h>

static void read_rows(attitude_reading *r, const csv_table *csv, const int column[4],
                      const double *t_s)
{
    for (long row = 0; row < csv->n_rows; row++) {
        double q[4];
        bool good = true;
        for (int i = 0; i < 4; i++)
            if (csv_number(csv, row, column[i], &q[i], r->errors)) {
                r->status = GLINT_INPUT;
                good = false;
            }
        if (good)
            attitude_table_add_row(r, t_s[row], q, csv_place(csv, csv_at(csv, row, column[0])));
    }
}

static bool find_columns(attitude_reading *r, const csv_table *csv, int column[4])
{
    static const char *const names[4] = {"qw", "qx", "qy", "qz"};
    bool good = true;
    for (int i = 0; i < 4; i++) {
        column[i] = csv_column(csv, names[i]);
        if (column[i] >= 0) continue;
        attitude_table_fail(r, csv_place(csv, &csv->cells[0]),
                            "the table has no column '%s'; expected t_s or utc, and qw, qx, qy, qz",
                            names[i]);
        good = false;
    }
    return good;
}

void attitude_csv_read(attitude_reading *r, attitude_frame frame, place asked_from)
{
    csv_table csv;
    int column[4];
    const glint_status read = csv_read(r->table->path, asked_from, &csv, r->errors);
    if (read) {
        r->status = read;
        return;
    }
    csv_leave_out_cut_row(&csv, r->errors);
    double *t_s = calloc((size_t)csv.n_rows + 1, sizeof *t_s);
    if (!t_s) {
        r->status = errors_add(r->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    } else if (find_columns(r, &csv, column)) {
        const glint_status status = time_column_read(&csv, r->clock, t_s, r->errors);
        if (status) r->status = status;
        if (status == GLINT_OK) {
            attitude_table_begin_span(r, (file_frame)frame, csv_place(&csv, &csv.cells[0]));
            read_rows(r, &csv, column, t_s);
            attitude_table_end_span(r, -INFINITY, INFINITY);
        }
    }
    free(t_s);
    csv_free(&csv);
}
