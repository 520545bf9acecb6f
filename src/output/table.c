/* table.c: a light curve as a CSV table with an ECSV header. */
#include "base/text.h"
#include "output/file.h"
#include "output/summary.h"

#include <stdlib.h>
#include <string.h>

/* Rows that one thread formats at a time. */
enum { CHUNK = 256 };

/* A string in YAML's double quotes: safe for any text. */
static void quote(text *t, const char *string, size_t n)
{
    text_char(t, '"');
    for (size_t i = 0; i < n; i++) {
        const unsigned char c = (unsigned char)string[i];
        if (c == '"' || c == '\\') {
            text_char(t, '\\');
            text_char(t, (char)c);
        } else if (c < 0x20 || c == 0x7f) {
            text_printf(t, "\\x%02x", c);
        } else {
            text_char(t, (char)c);
        }
    }
    text_char(t, '"');
}

static void quote_whole(text *t, const char *string)
{
    quote(t, string, strlen(string));
}

/* ECSV 1.0 (Astropy APE 6): a YAML document in comment lines, then the names of the columns. */
static void write_header(const glint_curve *curve, text *t)
{
    size_t n;
    const glint_column *columns = glint_curve_columns(curve, &n);
    text_add(t, "# %ECSV 1.0\n# ---\n# delimiter: ','\n# datatype:\n");
    for (size_t i = 0; i < n; i++) {
        text_printf(t, "# - {name: %s", columns[i].name);
        if (columns[i].unit[0]) text_printf(t, ", unit: %s", columns[i].unit);
        text_printf(t, ", datatype: %s, description: ", columns[i].is_text ? "string" : "float64");
        quote_whole(t, columns[i].description);
        text_add(t, "}\n");
    }
    text_add(t, "# meta: !!omap\n");
    const char *key, *value;
    for (size_t k = 0; glint_curve_fact(curve, k, &key, &value); k++) {
        text_printf(t, "# - %s: ", key);
        quote_whole(t, value);
        text_add(t, "\n");
    }
    text_add(t, "# - scenario:\n");
    for (const char *line = glint_curve_scenario(curve); *line;) {
        const size_t length = strcspn(line, "\n");
        text_add(t, "#   - ");
        quote(t, line, length);
        text_add(t, "\n");
        line += length + (line[length] == '\n');
    }
    text_add(t, "# schema: astropy-2.0\n");
    for (size_t i = 0; i < n; i++)
        text_printf(t, "%s%s", i ? "," : "", columns[i].name);
    text_char(t, '\n');
}

static void write_rows(const glint_curve *curve, const glint_row *rows, size_t n, text *t)
{
    size_t n_columns;
    glint_curve_columns(curve, &n_columns);
    for (size_t k = 0; k < n; k++) {
        if (!text_reserve(t, n_columns * (GLINT_CELL_SIZE + 1))) return;
        for (size_t i = 0; i < n_columns; i++) {
            if (i) t->data[t->length++] = ',';
            t->length += glint_curve_text(curve, &rows[k], i, t->data + t->length);
        }
        t->data[t->length++] = '\n';
    }
}

/* The texts of the chunks of one block. */
typedef struct chunk_texts {
    text *items; /* owned */
    size_t n, capacity;
} chunk_texts;

static void chunks_free(chunk_texts *chunks)
{
    for (size_t i = 0; i < chunks->capacity; i++)
        text_free(&chunks->items[i]);
    free(chunks->items);
}

static bool chunks_reserve(chunk_texts *chunks, size_t n)
{
    if (n > chunks->capacity) {
        text *items = realloc(chunks->items, n * sizeof *items);
        if (!items) return false;
        memset(items + chunks->capacity, 0, (n - chunks->capacity) * sizeof *items);
        chunks->items = items;
        chunks->capacity = n;
    }
    chunks->n = n;
    return true;
}

/* Formats the rows of a block on all threads and writes them in order. */
static glint_status write_block(const glint_curve *curve, const glint_row *rows, size_t n,
                                chunk_texts *chunks, out_file *file, glint_error *error)
{
    if (!chunks_reserve(chunks, (n + CHUNK - 1) / CHUNK)) return error_no_memory(error);
#pragma omp parallel for schedule(dynamic) num_threads(glint_curve_threads(curve)) if (n > CHUNK)
    for (size_t i = 0; i < chunks->n; i++) {
        const size_t first = i * CHUNK, count = n - first < CHUNK ? n - first : CHUNK;
        text_clear(&chunks->items[i]);
        write_rows(curve, rows + first, count, &chunks->items[i]);
    }
    for (size_t i = 0; i < chunks->n; i++) {
        const text *t = &chunks->items[i];
        if (t->failed) return error_no_memory(error);
        const glint_status status = out_file_write(file, t->data, t->length, error);
        if (status) return status;
    }
    return GLINT_OK;
}

static glint_status write_header_to(const glint_curve *curve, out_file *file, glint_error *error)
{
    text header = {0};
    write_header(curve, &header);
    const glint_status status = header.failed
                                    ? error_no_memory(error)
                                    : out_file_write(file, header.data, header.length, error);
    text_free(&header);
    return status;
}

/* Pulls all blocks. The header waits for the first, so that a run that fails at its start writes
 * nothing. */
static glint_status write_all(glint_curve *curve, out_file *file, summary_maker *maker,
                              glint_progress *progress, void *context, glint_error *error)
{
    chunk_texts chunks = {0};
    glint_status status = GLINT_OK;
    bool first = true;
    for (;;) {
        const glint_row *rows;
        size_t n;
        status = glint_curve_next(curve, &rows, &n, error);
        if (!status && first) status = write_header_to(curve, file, error);
        first = false;
        if (status || n == 0) break;
        summary_add(maker, rows, n);
        status = write_block(curve, rows, n, &chunks, file, error);
        if (!status && progress &&
            !progress(context, glint_curve_done(curve), glint_curve_length(curve)))
            status = error_set(error, GLINT_OUTPUT, PLACE_NONE, "stopped before the end");
        if (status) break;
    }
    chunks_free(&chunks);
    return status;
}

glint_status glint_table_write(glint_curve *curve, const char *path, glint_summary *summary,
                               glint_progress *progress, void *context, glint_error *error)
{
    size_t n;
    const glint_column *columns = glint_curve_columns(curve, &n);
    summary_maker *maker =
        summary_start(glint_curve_step_s(curve), n > 0 && string_equal(columns[0].name, "utc"));
    if (!maker) return error_no_memory(error);
    out_file *file;
    glint_status status = out_file_open(path, &file, error);
    if (!status) {
        status = write_all(curve, file, maker, progress, context, error);
        if (status)
            out_file_abandon(file);
        else
            status = out_file_commit(file, error);
    }
    if (!status && summary) {
        summary_finish(maker, summary);
        summary->band = glint_curve_band(curve);
    }
    summary_free(maker);
    return status;
}
