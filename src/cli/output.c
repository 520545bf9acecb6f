#define _XOPEN_SOURCE 700 /* realpath */

#include "cli/output.h"

#include "cli/report.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
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

/* Writes and closes fd. errno says what failed. */
static bool write_and_close(int fd, const char *text, size_t length, bool sync)
{
    bool good = true;
    while (good && length > 0) {
        const ssize_t n = write(fd, text, length);
        if (n < 0 && errno == EINTR) continue;
        good = n >= 0;
        if (good) text += n, length -= (size_t)n;
    }
    if (good && sync) good = fsync(fd) == 0;
    const int number = errno;
    const bool closed = close(fd) == 0;
    if (!good) errno = number;
    return good && closed;
}

/* Writes a new file beside the path and renames it. mode: permissions; errno says what failed. */
static bool replace_file(const char *path, mode_t mode, const char *text, size_t length)
{
    static const char suffix[] = ".XXXXXX";
    const size_t n = strlen(path);
    char *beside = malloc(n + sizeof suffix);
    if (!beside) return false;
    memcpy(beside, path, n);
    memcpy(beside + n, suffix, sizeof suffix);
    const int fd = mkstemp(beside);
    bool good = fd >= 0;
    if (good) {
        good = fchmod(fd, mode) == 0; /* mkstemp's is for its owner alone */
        good = write_and_close(fd, text, length, true) && good;
        good = good && rename(beside, path) == 0;
        const int number = errno;
        if (!good) unlink(beside);
        errno = number;
    }
    const int number = errno;
    free(beside);
    errno = number;
    return good;
}

static bool write_file(const char *path, const char *text, size_t length)
{
    struct stat info;
    if (stat(path, &info) != 0) {
        const mode_t mask = umask(0);
        umask(mask);
        return replace_file(path, 0666 & ~mask, text, length);
    }
    if (S_ISREG(info.st_mode)) {
        char *target = realpath(path, NULL); /* a link stays, what it names is replaced */
        const bool good = target && replace_file(target, info.st_mode & 0777, text, length);
        const int number = errno;
        free(target);
        errno = number;
        return good;
    }
    const int fd = open(path, O_WRONLY | O_NOCTTY);
    return fd >= 0 && write_and_close(fd, text, length, false);
}

glint_status output_finish(output *o, glint_error *error)
{
    if (!o->path) return GLINT_OK;
    glint_status status = GLINT_OK;
    if (fclose(o->stream) != 0)
        status = error_say(error, GLINT_INTERNAL, "out of memory");
    else if (!write_file(o->path, o->text, o->length))
        status = error_say(error, GLINT_OUTPUT, "cannot write '%s': %s", o->path, strerror(errno));
    free(o->text);
    *o = (output){0};
    return status;
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
