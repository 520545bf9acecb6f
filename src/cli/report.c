#include "cli/report.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

glint_status error_say(glint_error *error, glint_status status, const char *format, ...)
{
    *error = (glint_error){.status = status};
    va_list args;
    va_start(args, format);
    vsnprintf(error->message, sizeof error->message, format, args);
    va_end(args);
    return status;
}

/* no-color.org: set and not empty means no. */
static bool colours_wanted(void)
{
    const char *no_color = getenv("NO_COLOR"), *term = getenv("TERM");
    return isatty(STDERR_FILENO) && !(no_color && no_color[0]) && term && strcmp(term, "dumb") != 0;
}

/* Prints a text with control characters made harmless: file names and file contents may hold
 * sequences that a terminal would obey. */
static void print_plain(const char *text)
{
    for (const char *c = text; *c; c++)
        putc((unsigned char)*c < ' ' || *c == 127 ? '?' : *c, stderr);
}

void report_error(const glint_error *error)
{
    const bool colours = colours_wanted();
    const bool warning = error->severity == GLINT_WARNING;
    print_plain(error->file[0] ? error->file : "glint");
    if (error->file[0] && error->line > 0) {
        fprintf(stderr, ":%d", error->line);
        if (error->column > 0) fprintf(stderr, ":%d", error->column);
    }
    fprintf(stderr, ": %s%s:%s ",
            !colours  ? ""
            : warning ? "\033[1;35m"
                      : "\033[1;31m",
            warning ? "warning" : "error", colours ? "\033[0m" : "");
    print_plain(error->message);
    putc('\n', stderr);
}

void report_errors(const glint_errors *errors, glint_status status, bool quiet)
{
    enum { MOST_SHOWN = 50 }; /* a file of another kind has an error on each line */
    const size_t n = glint_errors_count(errors), n_errors = glint_errors_error_count(errors);
    size_t shown = 0;
    for (size_t k = 0; k < n; k++) {
        const glint_error *error = glint_errors_get(errors, k);
        if (error->severity == GLINT_ERROR && shown++ >= MOST_SHOWN) continue;
        if (error->severity == GLINT_ERROR || !quiet) report_error(error);
    }
    if (n_errors > MOST_SHOWN)
        fprintf(stderr, "glint: %zu more errors are not shown\n", n_errors - MOST_SHOWN);
    if (status != GLINT_OK && glint_errors_error_count(errors) == 0)
        report_error(&(glint_error){.status = status, .message = "failed without saying why"});
}

void report_duration(double seconds, char out[DURATION_SIZE])
{
    enum { MINUTE = 60, HOUR = 3600, DAY = 86400 }; /* s */
    if (seconds < 59.95) {                          /* what "%.1f" does not round to 60.0 */
        snprintf(out, DURATION_SIZE, "%.1f s", seconds);
        return;
    }
    static const struct {
        long long unit, part; /* s */
        const char *unit_name, *part_name;
    } units[] = {{DAY, HOUR, "d", "h"}, {HOUR, MINUTE, "h", "min"}, {MINUTE, 1, "min", "s"}};
    const size_t n_units = sizeof units / sizeof *units;
    size_t k = 0;
    while (k + 1 < n_units && llround(seconds) < units[k].unit)
        k++;
    const long long parts = llround(seconds / (double)units[k].part);
    const long long per_unit = units[k].unit / units[k].part;
    snprintf(out, DURATION_SIZE, "%lld %s %lld %s", parts / per_unit, units[k].unit_name,
             parts % per_unit, units[k].part_name);
}

/* "2025-07-24T19:13:04.5Z": no more decimals than there are. */
static void print_utc(const glint_utc *utc)
{
    fprintf(stderr, "%04d-%02d-%02dT%02d:%02d:%02d", utc->year, utc->month, utc->day, utc->hour,
            utc->minute, utc->second);
    if (utc->microsecond) {
        int digits = 6, fraction = utc->microsecond;
        while (fraction % 10 == 0)
            fraction /= 10, digits--;
        fprintf(stderr, ".%0*d", digits, fraction);
    }
    putc('Z', stderr);
}

/* A magnitude of which "%.3f" writes no "-0.000". */
static double shown(double magnitude)
{
    return fabs(magnitude) < 0.0005 ? 0.0 : magnitude;
}

void report_summary(const glint_summary *s)
{
    char sunlit[DURATION_SIZE], visible[DURATION_SIZE];
    report_duration(s->sunlit_s, sunlit);
    report_duration(s->visible_s, visible);
    if (s->rows == 0) {
        fprintf(stderr, "rows       none: [output] rows lets no row of the run through\n");
        return;
    }
    fprintf(stderr, "rows       %lld, of which %lld %s a magnitude\n", (long long)s->rows,
            (long long)s->bright_rows, s->bright_rows == 1 ? "has" : "have");
    if (s->bright_rows > 0) {
        fprintf(stderr, "magnitude  %s: minimum %.3f, median %.3f, maximum %.3f\n", s->band,
                shown(s->magnitude_min), shown(s->magnitude_median), shown(s->magnitude_max));
        fprintf(stderr,
                "brighter   than 6: %.1f %%, than 7: %.1f %% of the rows with a magnitude\n",
                s->percent_brighter_6, s->percent_brighter_7);
    }
    if (s->has_utc) fprintf(stderr, "time       sunlit %s, visible %s\n", sunlit, visible);
    if (s->bright_rows > 0) {
        fprintf(stderr, "brightest  %s %.3f at ", s->band, shown(s->magnitude_min));
        if (s->has_utc) {
            print_utc(&s->brightest_utc);
            fprintf(stderr, ", ");
        }
        fprintf(stderr, "t_s = %.12g", s->brightest_t_s);
        if (s->n_observers > 1) {
            fprintf(stderr, ", seen by ");
            print_plain(s->brightest_observer);
        }
        putc('\n', stderr);
    }
}

bool progress_wanted(bool quiet, bool to_file)
{
    const char *term = getenv("TERM");
    return !quiet && isatty(STDERR_FILENO) && (to_file || !isatty(STDOUT_FILENO)) && term &&
           strcmp(term, "dumb") != 0;
}

static double seconds_between(const struct timespec *from, const struct timespec *to)
{
    return (double)(to->tv_sec - from->tv_sec) + 1e-9 * (double)(to->tv_nsec - from->tv_nsec);
}

bool progress_draw(void *context, int64_t done, int64_t all)
{
    enum { BAR = 40 };                             /* letters */
    const double REDRAW_S = 0.1, PATIENCE_S = 0.5; /* short runs need no bar */
    progress_bar *bar = context;
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (bar->started.tv_sec == 0) bar->started = bar->drawn = now;
    const double passed_s = seconds_between(&bar->started, &now);
    if (all <= 0 || done <= 0 || passed_s < PATIENCE_S ||
        seconds_between(&bar->drawn, &now) < REDRAW_S)
        return true;
    bar->drawn = now;
    const double part = fmin((double)done / (double)all, 1.0);
    char left[DURATION_SIZE], cells[BAR + 1];
    report_duration(passed_s * (1.0 - part) / part, left);
    memset(cells, ' ', BAR);
    memset(cells, '#', (size_t)(part * BAR));
    cells[BAR] = '\0';
    const int width = fprintf(stderr, "\r[%s] %3.0f %%, %s left", cells, 100.0 * part, left) - 1;
    if (width < bar->width) fprintf(stderr, "%*s", bar->width - width, "");
    if (width > bar->width) bar->width = width;
    fflush(stderr);
    return true;
}

void progress_end(progress_bar *bar)
{
    if (bar->width > 0) fprintf(stderr, "\r%*s\r", bar->width, "");
    bar->width = 0;
}
