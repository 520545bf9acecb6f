/* table.c: a light curve as a CSV table with an ECSV header. */
#include "base/text.h"
#include "output/file.h"
#include "output/summary.h"

#include <stdlib.h>
#include <string.h>

/* Rows that one thread formats at a time. */
enum { CHUNK = 256 };

/* Reads one character of UTF-8 from the n > 0 bytes at s; returns its length, 0 where the bytes are no
 * character (names in element sets may hold anything). */
static size_t utf8_read(const unsigned char *s, size_t n, unsigned *out)
{
    static const unsigned LEAST[5] = {0, 0, 0x80, 0x800, 0x10000}; /* shorter forms are not allowed */
    const size_t length = s[0] < 0x80             ? 1
                          : (s[0] & 0xe0) == 0xc0 ? 2
                          : (s[0] & 0xf0) == 0xe0 ? 3
                          : (s[0] & 0xf8) == 0xf0 ? 4
                                                  : 0;
    if (length == 0 || length > n) return 0;
    unsigned c = length == 1 ? s[0] : s[0] & (0x7fu >> length);
    for (size_t i = 1; i < length; i++) {
        if ((s[i] & 0xc0) != 0x80) return 0;
        c = c << 6 | (s[i] & 0x3fu);
    }
    if (c < LEAST[length] || c > 0x10ffff || (c >= 0xd800 && c < 0xe000)) return 0;
    *out = c;
    return length;
}

/* What YAML does not take as it is, or some reader may take for the end of a line: control
 * characters, next line, line and paragraph separator, byte order mark, U+FFFE and U+FFFF. */
static bool needs_escape(unsigned c)
{
    return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x2028 || c == 0x2029 || c == 0xfeff ||
           (c >= 0xfffe && c <= 0xffff);
}

/* A string in YAML's double quotes, on one line: safe for any bytes. Those that are no UTF-8 are
 * taken for Latin-1. */
static void quote(text *t, const char *string, size_t n)
{
    text_char(t, '"');
    for (size_t i = 0, length; i < n; i += length) {
        unsigned c = (unsigned char)string[i];
        length = utf8_read((const unsigned char *)string + i, n - i, &c);
        if (c == '"' || c == '\\')
            text_char(t, '\\');
        if (length == 0 || needs_escape(c))
            text_printf(t, c < 0x100 ? "\\x%02x" : "\\u%04x", c);
        else
            text_append(t, string + i, length);
        if (length == 0) length = 1;
    }
    text_char(t, '"');
}

static void quote_whole(text *t, const char *string)
{
    quote(t, string, strlen(string));
}

/* What is known of the run. Keys of a YAML map are unique, so what was set makes one list. */
static void write_facts(const glint_curve *curve, text *t)
{
    const char *key, *value;
    bool in_list = false;
    for (size_t k = 0; glint_curve_fact(curve, k, &key, &value); k++) {
        const bool of_list = string_equal(key, "set");
        if (of_list && !in_list) text_add(t, "# - set:\n");
        in_list = of_list;
        if (of_list)
            text_add(t, "#   - ");
        else
            text_printf(t, "# - %s: ", key);
        quote_whole(t, value);
        text_add(t, "\n");
    }
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
    write_facts(curve, t);
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
