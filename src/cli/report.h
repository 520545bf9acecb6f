/* report.h: what the program says on standard error: errors, warnings, progress, the summary. */
#ifndef GLINT_CLI_REPORT_H
#define GLINT_CLI_REPORT_H

#include <glint/glint.h>
#include <time.h>

/* Fills *error with a message of the program's own, with no place; returns `status`. */
glint_status error_say(glint_error *error, glint_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Prints one error or warning: "file:line:column: error: message", "glint: error: message" where no
 * file is to blame. Colours only on a terminal without NO_COLOR. */
void report_error(const glint_error *error);

/* Prints a list; warnings too unless quiet. status: what the call came to, so that a failure that
 * could not even note its error does not pass in silence. */
void report_errors(const glint_errors *errors, glint_status status, bool quiet);

/* Room that report_duration needs. */
enum { DURATION_SIZE = 32 };
/* Writes a time span of `seconds` >= 0 in its two largest units: "12.5 s", "4 min 20 s", "2 d 3 h".
 */
void report_duration(double seconds, char out[DURATION_SIZE]);

/* Prints what a run came to. */
void report_summary(const glint_summary *summary);

/* A progress bar: zero-initialise. */
typedef struct progress_bar {
    struct timespec started, drawn; /* monotonic clock; tv_sec 0: not yet */
    int width;                      /* of what stands on the line now, in letters */
} progress_bar;

/* True when a bar can be seen and disturbs nothing: standard error is a terminal, and the table
 * does not scroll through the same one. */
bool progress_wanted(bool quiet, bool to_file);
/* A glint_progress over a progress_bar; draws ten times a second at most. */
bool progress_draw(void *bar, int64_t done, int64_t all);
/* Wipes the bar. */
void progress_end(progress_bar *bar);

#endif
