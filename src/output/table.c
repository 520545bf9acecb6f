/* table.c: a light curve as a CSV table with an ECSV header. */
#include "base/grow.h"
#include "base/text.h"
#include "output/curve_plot.h"
#include "output/ecsv.h"
#include "output/facts.h"
#include "output/file.h"
#include "output/plot.h"
#include "output/summary.h"

#include <stdlib.h>
#include <string.h>

/* Rows that one thread formats at a time. */
enum { CHUNK = 256 };

static bool fact_of(const void *curve, size_t k, const char **key, const char **value)
{
    return glint_curve_fact(curve, k, key, value);
}

static void write_header(const glint_curve *curve, text *t)
{
    size_t n;
    const glint_column *columns = glint_curve_columns(curve, &n);
    ecsv_begin(t, columns, n);
    ecsv_facts(t, fact_of, curve);
    ecsv_list(t, "scenario");
    for (const char *line = glint_curve_scenario(curve); *line;) {
        const size_t length = strcspn(line, "\n");
        ecsv_item(t, line, length);
        line += length + (line[length] == '\n');
    }
    ecsv_end(t, columns, n);
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
    const size_t had = chunks->capacity;
    if (!grow_list(&chunks->items, &chunks->capacity, n, sizeof *chunks->items)) return false;
    for (size_t k = had; k < chunks->capacity; k++)
        chunks->items[k] = (text){0};
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

/* What the rows of a run go to. */
typedef struct sinks {
    out_file *file;         /* owned until it is committed */
    summary_maker *summary; /* owned */
    plot *plot;             /* owned until it is finished; NULL: no picture is wanted */
    curve_plot *curve_plot; /* owned; as plot */
} sinks;

/* Opens them all: what cannot be written is said before anything is computed. */
static glint_status sinks_open(const glint_curve *curve, const char *path, const char *picture,
                               sinks *out, glint_error *error)
{
    size_t n;
    const glint_column *columns = glint_curve_columns(curve, &n);
    *out = (sinks){0};
    if (path && glint_curve_reads(curve, path)) return out_file_is_input(path, error);
    if (picture && glint_curve_reads(curve, picture)) return out_file_is_input(picture, error);
    const glint_status status = out_file_check_two(path, picture, error);
    if (status) return status;
    if (picture && glint_curve_observers(curve) > 1)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "a picture shows the curve of one observer, and there are %zu; expected a "
                         "scenario of one, or no picture",
                         glint_curve_observers(curve));
    const double step_s = glint_curve_step_s(curve);
    const int64_t n_steps = glint_curve_length(curve) / (int64_t)glint_curve_observers(curve);
    out->summary = summary_start(step_s, step_s * (double)(n_steps - 1),
                                 n > 0 && string_equal(columns[0].name, "utc"));
    if (!out->summary) return error_no_memory(error);
    if (picture) {
        const glint_status opened = plot_open(picture, &out->plot, error);
        if (opened) return opened;
        out->curve_plot = curve_plot_start(curve);
        if (!out->curve_plot) return error_no_memory(error);
    }
    return out_file_open(path, &out->file, error);
}

/* Closes them; what is not committed or finished by now leaves nothing behind. */
static void sinks_close(sinks *s)
{
    out_file_abandon(s->file);
    plot_abandon(s->plot);
    curve_plot_free(s->curve_plot);
    summary_free(s->summary);
}

/* Pulls all blocks. The header waits for the first, so that a run that fails at its start writes
 * nothing. */
static glint_status write_all(glint_curve *curve, sinks *to, glint_progress *progress,
                              void *context, glint_error *error)
{
    chunk_texts chunks = {0};
    glint_status status = GLINT_OK;
    bool first = true;
    for (;;) {
        const glint_row *rows;
        size_t n;
        status = glint_curve_next(curve, &rows, &n, error);
        if (!status && first) status = write_header_to(curve, to->file, error);
        first = false;
        if (status || n == 0) break;
        summary_add(to->summary, rows, n);
        if (to->curve_plot) curve_plot_add(to->curve_plot, rows, n);
        status = write_block(curve, rows, n, &chunks, to->file, error);
        if (!status && progress &&
            !progress(context, glint_curve_done(curve), glint_curve_length(curve)))
            status = error_set(error, GLINT_OUTPUT, PLACE_NONE, "stopped before the end");
        if (status) break;
    }
    chunks_free(&chunks);
    return status;
}

/* Puts the table in its place. */
static glint_status commit(sinks *s, glint_error *error)
{
    out_file *file = s->file;
    s->file = NULL;
    return out_file_commit(file, error);
}

/* Draws the picture and puts it in its place. */
static glint_status draw(sinks *s, glint_error *error)
{
    plot *picture = s->plot;
    text script = {0};
    curve_plot_write(s->curve_plot, &script);
    glint_status status;
    if (script.failed) {
        status = error_no_memory(error);
    } else {
        s->plot = NULL;
        status = plot_finish(picture, script.data, script.length, error);
    }
    text_free(&script);
    return status;
}

glint_status glint_table_write(glint_curve *curve, const char *path, const char *picture,
                               glint_summary *summary, glint_progress *progress, void *context,
                               glint_error *error)
{
    sinks to;
    glint_status status = sinks_open(curve, path, picture, &to, error);
    if (!status) status = write_all(curve, &to, progress, context, error);
    if (!status) status = commit(&to, error);
    if (!status && picture) status = draw(&to, error);
    if (!status && summary) {
        summary_finish(to.summary, summary);
        summary->band = glint_curve_band(curve);
        summary->n_observers = glint_curve_observers(curve);
    }
    sinks_close(&to);
    return status;
}
