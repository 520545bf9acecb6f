#include "base/csv.h"

#include "base/grow.h"
#include "base/text.h"

#include <stdlib.h>
#include <string.h>

/* The state of one reading: a cursor over the bytes, which are terminated in place. */
typedef struct reader {
    csv_table *table;
    glint_errors *errors;
    char *at, *end;
    int line;
    char *line_start;
    size_t count, capacity; /* cells */
} reader;

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static bool at_line_end(const reader *r)
{
    return r->at >= r->end || *r->at == '\n' ||
           (*r->at == '\r' && r->at + 1 < r->end && r->at[1] == '\n');
}

static void next_line(reader *r)
{
    while (r->at < r->end && *r->at != '\n')
        r->at++;
    if (r->at < r->end) r->at++;
    r->line++;
    r->line_start = r->at;
}

static bool push(reader *r, csv_cell cell)
{
    if (!grow_list(&r->table->cells, &r->capacity, r->count + 1, sizeof *r->table->cells))
        return false;
    r->table->cells[r->count++] = cell;
    return true;
}

/* Reads a quoted cell at r->at (on the opening quote), unquoting in place. */
static glint_status read_quoted(reader *r, csv_cell *cell)
{
    char *out = r->at + 1, *in = r->at + 1;
    cell->text = out;
    for (;;) {
        if (in >= r->end || *in == '\n')
            return errors_add(r->errors, GLINT_INPUT,
                              (place){r->table->path, cell->line, cell->column},
                              "this cell's opening quote has no closing quote on its line");
        if (*in == '"' && in + 1 < r->end && in[1] == '"') {
            *out++ = '"';
            in += 2;
        } else if (*in == '"') {
            break;
        } else {
            *out++ = *in++;
        }
    }
    r->at = in + 1;
    *out = '\0';
    while (is_blank(r->at < r->end ? *r->at : 'x'))
        r->at++;
    return GLINT_OK;
}

/* Reads the cells of one line; the number of them through *n. */
static glint_status read_line(reader *r, int *n)
{
    *n = 0;
    for (;;) {
        while (is_blank(r->at < r->end ? *r->at : 'x'))
            r->at++;
        csv_cell cell = {r->at, r->line, (int)(r->at - r->line_start) + 1};
        char *stop = NULL;
        if (r->at < r->end && *r->at == '"') {
            const glint_status status = read_quoted(r, &cell);
            if (status) return status;
        } else {
            while (!at_line_end(r) && *r->at != ',')
                r->at++;
            stop = r->at;
            while (stop > cell.text && is_blank(stop[-1]))
                stop--;
        }
        if (!push(r, cell))
            return errors_add(r->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
        ++*n;
        const bool more = r->at < r->end && *r->at == ',';
        if (!more && !at_line_end(r))
            return errors_add(r->errors, GLINT_INPUT,
                              (place){r->table->path, r->line, (int)(r->at - r->line_start) + 1},
                              "expected a comma or the end of the line after the closing quote");
        if (!more) {
            char *line_end = r->at;
            r->table->may_be_cut = r->at >= r->end;
            if (r->at < r->end) next_line(r);
            if (line_end < r->end) *line_end = '\0';
            if (stop) *stop = '\0';
            return GLINT_OK;
        }
        r->at++;
        if (stop) *stop = '\0';
    }
}

static glint_status check_header(const csv_table *t, glint_errors *errors)
{
    glint_status status = GLINT_OK;
    for (int i = 0; i < t->n_columns; i++) {
        const csv_cell *cell = &t->cells[i];
        if (!cell->text[0])
            status = errors_add(errors, GLINT_INPUT, csv_place(t, cell),
                                "column %d has no name; expected a header line of names", i + 1);
        for (int j = 0; j < i; j++)
            if (cell->text[0] && string_equal(cell->text, t->cells[j].text))
                status = errors_add(errors, GLINT_INPUT, csv_place(t, cell),
                                    "column '%s' stands twice in the header", cell->text);
    }
    return status;
}

static glint_status read_all(reader *r)
{
    csv_table *t = r->table;
    glint_status status = GLINT_OK;
    while (r->at < r->end) {
        char *first = r->at;
        while (first < r->end && is_blank(*first))
            first++;
        if (first >= r->end) break;
        if (*first == '#' || *first == '\n' || *first == '\r') {
            next_line(r);
            continue;
        }
        int n;
        const int line = r->line;
        const size_t before = r->count;
        const glint_status failed = read_line(r, &n);
        if (failed == GLINT_INTERNAL || (failed && t->n_columns == 0)) return failed;
        if (failed) {
            status = failed;
            r->count = before;
            if (r->line == line) next_line(r);
            continue;
        }
        if (t->n_columns == 0) {
            t->n_columns = n;
            const glint_status bad = check_header(t, r->errors);
            if (bad) return bad;
        } else if (n != t->n_columns) {
            status =
                errors_add(r->errors, GLINT_INPUT, (place){t->path, line, 1},
                           "this row has %d cells; expected %d, as in the header", n, t->n_columns);
            r->count = before;
        } else {
            t->n_rows++;
        }
    }
    if (t->n_columns == 0 && status == GLINT_OK)
        return errors_add(r->errors, GLINT_INPUT, (place){t->path, 0, 0},
                          "the table is empty; expected a header line of column names");
    return status;
}

glint_status csv_read(const char *path, place asked_from, csv_table *table, glint_errors *errors)
{
    *table = (csv_table){0};
    glint_error error;
    size_t size;
    char *bytes;
    glint_status status = file_read(path, &bytes, &size, asked_from, &error);
    if (status) return errors_take(errors, &error, asked_from);
    table->bytes = bytes;
    table->path = string_copy(path, strlen(path));
    if (!table->path) {
        csv_free(table);
        return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    }
    const char *nul = memchr(bytes, '\0', size);
    if (nul) {
        status = errors_add(errors, GLINT_INPUT, (place){path, 0, 0},
                            "this is not a text file: a zero byte stands at offset %zu",
                            (size_t)(nul - bytes));
    } else {
        const size_t bom = size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
        reader r = {table, errors, bytes + bom, bytes + size, 1, bytes + bom, 0, 0};
        status = read_all(&r);
    }
    if (status) csv_free(table);
    return status;
}

void csv_free(csv_table *table)
{
    free(table->path);
    free(table->bytes);
    free(table->cells);
    *table = (csv_table){0};
}

void csv_leave_out_cut_row(csv_table *table, glint_errors *errors)
{
    if (!table->may_be_cut || table->n_rows == 0) return;
    errors_warn(errors, csv_place(table, csv_at(table, table->n_rows - 1, 0)),
                "the last row has no line end: it may be cut and is left out; get the file again, "
                "or end the line if it is whole");
    table->n_rows--;
    table->may_be_cut = false;
}

int csv_column(const csv_table *table, const char *name)
{
    for (int i = 0; i < table->n_columns; i++)
        if (string_equal(table->cells[i].text, name)) return i;
    return -1;
}

const csv_cell *csv_at(const csv_table *table, long row, int column)
{
    return &table->cells[(size_t)(row + 1) * (size_t)table->n_columns + (size_t)column];
}

place csv_place(const csv_table *table, const csv_cell *cell)
{
    return (place){table->path, cell->line, cell->column};
}

glint_status csv_number(const csv_table *table, long row, int column, double *value,
                        glint_errors *errors)
{
    const csv_cell *cell = csv_at(table, row, column);
    if (number_read(cell->text, strlen(cell->text), value)) return GLINT_OK;
    *value = 0;
    return errors_add(errors, GLINT_INPUT, csv_place(table, cell),
                      "column '%s' has '%.40s'; expected a finite number",
                      table->cells[column].text, cell->text);
}
