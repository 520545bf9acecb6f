/* table.h: tables of expected values (CSV with a header line) as the tests read them. */
#ifndef GLINT_TABLE_H
#define GLINT_TABLE_H

#include "base/csv.h"
#include "testing.h"

/* Opens a table, or fails the test. csv_free ends it. */
static inline csv_table table_open(const char *path)
{
    csv_table table;
    glint_errors *errors = glint_errors_new();
    const glint_status status = csv_read(path, PLACE_NONE, &table, errors);
    ck_assert_msg(status == GLINT_OK, "%s: %s", path,
                  status ? glint_errors_get(errors, 0)->message : "");
    ck_assert_msg(table.n_rows > 0, "%s has no rows", path);
    glint_errors_free(errors);
    return table;
}

static inline const char *table_text(const csv_table *table, long row, const char *name)
{
    const int column = csv_column(table, name);
    ck_assert_msg(column >= 0, "%s has no column '%s'", table->path, name);
    return csv_at(table, row, column)->text;
}

static inline double table_number(const csv_table *table, long row, const char *name)
{
    const int column = csv_column(table, name);
    double value;
    ck_assert_msg(column >= 0, "%s has no column '%s'", table->path, name);
    ck_assert_msg(csv_number(table, row, column, &value, NULL) == GLINT_OK,
                  "%s, row %ld: column '%s' has no number", table->path, row, name);
    return value;
}

/* Three numbers: x, y, z between a prefix and a suffix. */
static inline void table_vector(const csv_table *table, long row, const char *prefix,
                                const char *suffix, double out[3])
{
    for (int i = 0; i < 3; i++) {
        char name[64];
        snprintf(name, sizeof name, "%s%c%s", prefix, "xyz"[i], suffix);
        out[i] = table_number(table, row, name);
    }
}

/* Runs a check on the rows that lie beside the tests, and on the whole reference table where
 * that is at hand. */
static inline void table_check(void (*check)(const char *path), const char *name)
{
    check(path_in(TEST_DATA_DIR, name));
    const char *dir = reference_dir(name);
    char in_golden[256];
    snprintf(in_golden, sizeof in_golden, "golden/%s", name);
    if (dir) check(path_in(dir, in_golden));
}

#endif
