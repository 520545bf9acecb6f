/* bench_curve.c: a run as the program does it, on one thread: how long the rows take to compute,
 * and how long their table takes to write.
 *
 * usage: bench_curve SCENARIO [KEY=VALUE...]
 * Prints rows and CPU times: of computing the rows, of turning them into text, and of a whole table
 * written to /dev/null. The minimum of several rounds counts. */
#include "timing.h"

#include <glint/glint.h>

#include <stdio.h>
#include <stdlib.h>

enum { ROUNDS = 5 };

static void fail(const char *message)
{
    fprintf(stderr, "bench_curve: %s\n", message);
    exit(1);
}

static glint_curve *open_curve(const glint_scenario *scenario)
{
    glint_curve *curve;
    if (glint_curve_open(scenario, 1, &curve, NULL)) fail("the curve could not be opened");
    return curve;
}

/* What is measured, s. */
typedef struct times {
    double computing, writing, table;
} times;

/* The cells of n rows as the table has them; returns the number of bytes. */
static size_t write_rows(const glint_curve *curve, const glint_row *rows, size_t n,
                         char text[GLINT_CELL_SIZE])
{
    size_t n_columns, length = 0;
    glint_curve_columns(curve, &n_columns);
    for (size_t k = 0; k < n; k++)
        for (size_t column = 0; column < n_columns; column++)
            length += glint_curve_text(curve, &rows[k], column, text) + 1;
    return length;
}

/* Pulls the whole curve and writes its rows, block by block, which are timed apart. */
static times pull(const glint_scenario *scenario, long long *n_rows)
{
    char text[GLINT_CELL_SIZE];
    times t = {0};
    size_t n, length = 0;
    double from_s = cpu_s();
    glint_curve *curve = open_curve(scenario);
    *n_rows = 0;
    do {
        const glint_row *rows;
        glint_error error;
        if (glint_curve_next(curve, &rows, &n, &error)) fail(error.message);
        const double computed_s = cpu_s();
        length += write_rows(curve, rows, n, text);
        const double written_s = cpu_s();
        t.computing += computed_s - from_s;
        t.writing += written_s - computed_s;
        from_s = written_s;
        *n_rows += (long long)n;
    } while (n > 0);
    glint_curve_close(curve);
    if (length == 0) fail("there are no rows");
    return t;
}

static double table_s(const glint_scenario *scenario)
{
    const double from_s = cpu_s();
    glint_curve *curve = open_curve(scenario);
    glint_error error;
    if (glint_table_write(curve, "/dev/null", NULL, NULL, NULL, NULL, &error)) fail(error.message);
    glint_curve_close(curve);
    return cpu_s() - from_s;
}

int main(int argc, char **argv)
{
    if (argc < 2) fail("usage: bench_curve SCENARIO [KEY=VALUE...]");
    glint_errors *errors = glint_errors_new();
    glint_scenario *scenario;
    if (glint_scenario_read(argv[1], (const char *const *)argv + 2, (size_t)argc - 2, &scenario,
                            errors))
        fail(glint_errors_get(errors, 0)->message);
    long long rows = 0;
    times least = {1e99, 1e99, 1e99};
    for (int round = 0; round < ROUNDS; round++) {
        times t = pull(scenario, &rows);
        t.table = table_s(scenario);
        if (t.computing < least.computing) least.computing = t.computing;
        if (t.writing < least.writing) least.writing = t.writing;
        if (t.table < least.table) least.table = t.table;
    }
    const double million = 1e-6 * (double)rows;
    printf("rows         %lld\n", rows);
    printf("computing    %.3f s, %.3f M rows/s\n", least.computing, million / least.computing);
    printf("writing      %.3f s, %.3f M rows/s\n", least.writing, million / least.writing);
    printf("whole table  %.3f s, %.3f M rows/s\n", least.table, million / least.table);
    glint_scenario_free(scenario);
    glint_errors_free(errors);
    return 0;
}
