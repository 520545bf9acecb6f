/* output.h: where the text of a command goes: standard output, or a file that appears whole. */
#ifndef GLINT_CLI_OUTPUT_H
#define GLINT_CLI_OUTPUT_H

#include <glint/glint.h>
#include <stdio.h>

/* The text of one command. */
typedef struct output {
    FILE *stream;     /* print here; borrowed where it is stdout */
    const char *path; /* borrowed; NULL: standard output */
    char *text;       /* owned; what is collected for the file */
    size_t length;
} output;

/* Makes sure that descriptors 0 to 2 are open, so that no file that is opened later takes their
 * place: writing to one that was closed fails, as it should. */
void output_prepare(void);

/* Begins an output. path: NULL for standard output, else the file. Errors: GLINT_INTERNAL. */
glint_status output_open(output *o, const char *path, glint_error *error);
/* Ends it and writes the file: a regular file appears whole or not at all, a pipe or device is
 * written to. Errors: GLINT_OUTPUT; GLINT_INTERNAL. */
glint_status output_finish(output *o, glint_error *error);

/* Refuses to write over what a scenario is read from. path: NULL for standard output. Errors:
 * GLINT_OUTPUT. */
glint_status output_check(const glint_scenario *scenario, const char *path, glint_error *error);

/* glint_plot_check where a picture is wanted. plot: NULL: none. Errors: those of glint_plot_check.
 */
glint_status output_check_plot(const char *table, const char *plot, glint_error *error);

/* Flushes and closes stdout. *reader_left: as output_reader_left says before that. Errors:
 * GLINT_OUTPUT. */
glint_status output_close_stdout(bool *reader_left, glint_error *error);

/* Reports an error of a command that writes to `path` (NULL: standard output), unless it is that
 * the reader of a pipe has left; returns its status. */
glint_status output_fail(const char *path, const glint_error *error);

/* True when stdout is a pipe that nobody reads any more (`glint run ... | head`). */
bool output_reader_left(void);

#endif
