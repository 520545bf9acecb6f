#include "orbit/time_column.h"

#include <math.h>

static glint_status read_cell(const csv_table *table, long row, int column, bool is_utc,
                              const run_clock *clock, double *t_s, glint_errors *errors)
{
    static const double FARTHEST_S = 2e9; /* 63 years: the years of UTC on both sides */
    const csv_cell *cell = csv_at(table, row, column);
    double tt_jd[2];
    glint_error error;
    if (is_utc) {
        if (time_parse(cell->text, SCALE_UTC, csv_place(table, cell), tt_jd, &error))
            return errors_take(errors, &error, csv_place(table, cell));
        *t_s = jd_difference_s(tt_jd, clock->tt_jd);
    } else if (csv_number(table, row, column, t_s, errors)) {
        return GLINT_INPUT;
    }
    if (fabs(*t_s) <= FARTHEST_S) return GLINT_OK;
    return errors_add(errors, GLINT_INPUT, csv_place(table, cell),
                      "this row lies %.4g s from the start; expected at most %g", *t_s, FARTHEST_S);
}

glint_status time_column_read(const csv_table *table, const run_clock *clock, double *t_s,
                              glint_errors *errors)
{
    const int seconds = csv_column(table, "t_s"), utc = csv_column(table, "utc");
    const place header = csv_place(table, &table->cells[0]);
    if ((seconds < 0) == (utc < 0))
        return errors_add(errors, GLINT_INPUT, header,
                          "the table has %s of the columns t_s and utc; expected one of them",
                          seconds < 0 ? "none" : "both");
    if (utc >= 0 && !clock)
        return errors_add(errors, GLINT_INPUT, csv_place(table, &table->cells[utc]),
                          "the table has a column utc, and this run has no dates; expected t_s");
    if (table->n_rows == 0)
        return errors_add(errors, GLINT_INPUT, (place){table->path, 0, 0},
                          "the table has no rows; expected at least one");
    const int column = seconds < 0 ? utc : seconds;
    glint_status status = GLINT_OK;
    for (long row = 0; row < table->n_rows; row++) {
        if (read_cell(table, row, column, seconds < 0, clock, &t_s[row], errors))
            status = GLINT_INPUT;
        else if (status == GLINT_OK && row > 0 && !(t_s[row] > t_s[row - 1]))
            status = errors_add(errors, GLINT_INPUT, csv_place(table, csv_at(table, row, column)),
                                "this row lies %g s before the one above it; expected times that "
                                "grow from row to row",
                                t_s[row - 1] - t_s[row]);
    }
    return status;
}
