#include "cli/output.h"

#include "cli/report.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void output_prepare(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) < 0 &&
            open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
            return;
}

glint_status output_open(output *o, const char *path, glint_error *error)
{
    *o = (output){.path = path};
    o->stream = path ? open_memstream(&o->text, &o->length) : stdout;
    return o->stream ? GLINT_OK : error_say(error, GLINT_INTERNAL, "out of memory");
}

glint_status output_finish(output *o, glint_error *error)
{
    if (!o->path) return GLINT_OK;
    glint_status status = GLINT_OK;
    if (fclose(o->stream) != 0)
        status = error_say(error, GLINT_INTERNAL, "out of memory");
    else
        status = glint_text_write(o->path, o->text, o->length, error);
    free(o->text);
    *o = (output){0};
    return status;
}

glint_status output_check(const glint_scenario *scenario, const char *path, glint_error *error)
{
    if (!path || !glint_scenario_reads(scenario, path)) return GLINT_OK;
    return error_say(error, GLINT_OUTPUT,
                     "the scenario is read from %s; expected another file to write to", path);
}

glint_status output_check_plot(const char *table, const char *plot, glint_error *error)
{
    return plot ? glint_plot_check(plot, table, error) : GLINT_OK;
}

glint_status output_close_stdout(bool *reader_left, glint_error *error)
{
    bool good = !ferror(stdout);
    errno = 0;
    good = fflush(stdout) == 0 && good;
    int number = errno;
    *reader_left = output_reader_left();
    errno = 0;
    good = fclose(stdout) == 0 && good;
    if (good) return GLINT_OK;
    if (number == 0) number = errno;
    return error_say(error, GLINT_OUTPUT, "cannot write standard output%s%s", number ? ": " : "",
                     number ? strerror(number) : ""); /* of an earlier write, the reason is gone */
}

bool output_reader_left(void)
{
    struct pollfd end = {STDOUT_FILENO, POLLOUT, 0};
    return poll(&end, 1, 0) > 0 && (end.revents & (POLLERR | POLLHUP));
}

glint_status output_fail(const char *path, const glint_error *error)
{
    if (error->status != GLINT_OUTPUT || path || !output_reader_left()) report_error(error);
    return error->status;
}
