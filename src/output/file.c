#define _GNU_SOURCE /* O_TMPFILE */
#include "output/file.h"

#include "base/text.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct out_file {
    int fd;
    char *path;      /* owned; where the file goes; NULL for standard output and devices */
    char *temporary; /* owned; its name until then; NULL while it has none */
    bool close_fd;
    char *shown; /* owned; for messages */
};

static void release(out_file *file)
{
    free(file->path);
    free(file->temporary);
    free(file->shown);
    free(file);
}

static glint_status fail(const char *shown, const char *what, glint_error *error)
{
    return error_set(error, GLINT_OUTPUT, (place){shown, 0, 0}, "cannot %s: %s", what,
                     strerror(errno));
}

/* The folder of a path, from malloc. */
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    if (!slash) return string_copy(".", 1);
    return string_copy(path, slash == path ? 1 : (size_t)(slash - path));
}

/* "folder/.name.XXXXXX", from malloc; of a long name only the start, since names have 255 bytes. */
static char *temporary_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    text t = {0};
    text_append(&t, path, (size_t)(name - path));
    text_printf(&t, ".%.200s.XXXXXX", name);
    return t.data;
}

/* The permissions that a new file gets, or those of the file that it replaces. */
static mode_t mode_for(const struct stat *old)
{
    if (old) return old->st_mode & 0777;
    const mode_t mask = umask(0);
    umask(mask);
    return 0666 & ~mask;
}

/* Opens a file beside `path`: without a name where the system can, so that nothing stays behind
 * even when the program is killed; else under a temporary name. */
static glint_status open_beside(out_file *file, const struct stat *old, glint_error *error)
{
    char *folder = folder_of(file->path);
    if (!folder) return error_no_memory(error);
    file->fd = open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
    free(folder);
    if (file->fd < 0) {
        file->temporary = temporary_name(file->path);
        if (!file->temporary) return error_no_memory(error);
        file->fd = mkstemp(file->temporary);
        if (file->fd < 0) {
            free(file->temporary);
            file->temporary = NULL;
            return fail(file->shown, "create a file there", error);
        }
    }
    file->close_fd = true;
    if (fchmod(file->fd, mode_for(old)) != 0)
        return fail(file->shown, "set its permissions", error);
    return GLINT_OK;
}

/* Where a link points to, from malloc; NULL where it is no link, with errno 0, or on error. */
static char *target_of(const char *path)
{
    char target[PATH_MAX];
    struct stat info;
    errno = 0;
    if (lstat(path, &info) != 0 || !S_ISLNK(info.st_mode)) {
        if (errno == ENOENT) errno = 0;
        return NULL;
    }
    const ssize_t n = readlink(path, target, sizeof target - 1);
    if (n < 0) return NULL;
    target[n] = '\0';
    return path_beside(path, target);
}

/* The name of a file that does not exist yet, from malloc: what a chain of links ends at. NULL on
 * error. */
static char *name_behind_links(const char *path)
{
    enum { MOST_LINKS = 40 }; /* as many as Linux follows */
    char *name = string_copy(path, strlen(path));
    for (int k = 0; name; k++) {
        char *target = target_of(name);
        if (!target && errno == 0) return name;
        free(name);
        name = target;
        if (k < MOST_LINKS) continue;
        free(name);
        errno = ELOOP;
        return NULL;
    }
    return NULL;
}

static glint_status open_path(out_file *file, const char *path, glint_error *error)
{
    struct stat info;
    if (!path[0])
        return error_set(error, GLINT_OUTPUT, PLACE_NONE,
                         "the name of the output file is empty; expected the name of a file");
    const bool exists = stat(path, &info) == 0;
    if (!exists && errno != ENOENT) return fail(path, "write there", error);
    if (exists && S_ISDIR(info.st_mode))
        return error_set(error, GLINT_OUTPUT, (place){path, 0, 0},
                         "this is a directory; expected the name of a file to write");
    if (exists && !S_ISREG(info.st_mode)) {
        file->fd = open(path, O_WRONLY | O_CLOEXEC);
        file->close_fd = true;
        return file->fd < 0 ? fail(path, "open it", error) : GLINT_OK;
    }
    if (exists && access(path, W_OK) != 0) return fail(path, "write to it", error);
    file->path = exists ? realpath(path, NULL) : name_behind_links(path);
    if (!file->path) return fail(path, "find it", error);
    return open_beside(file, exists ? &info : NULL, error);
}

glint_status out_file_open(const char *path, out_file **out, glint_error *error)
{
    *out = NULL;
    out_file *file = calloc(1, sizeof *file);
    const char *shown = path ? path : "standard output";
    if (file) file->shown = string_copy(shown, strlen(shown));
    if (!file || !file->shown) {
        free(file);
        return error_no_memory(error);
    }
    file->fd = -1;
    if (!path) {
        file->fd = STDOUT_FILENO;
        *out = file;
        return GLINT_OK;
    }
    const glint_status status = open_path(file, path, error);
    if (status)
        out_file_abandon(file);
    else
        *out = file;
    return status;
}

glint_status out_file_write(out_file *file, const char *bytes, size_t n, glint_error *error)
{
    while (n > 0) {
        const ssize_t written = write(file->fd, bytes, n);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return fail(file->shown, "write", error);
        bytes += written;
        n -= (size_t)written;
    }
    return GLINT_OK;
}

/* Gives a nameless file a temporary name. */
static glint_status name_file(out_file *file, glint_error *error)
{
    char link[32];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file->fd);
    for (int attempt = 0; attempt < 100; attempt++) {
        char *name = temporary_name(file->path);
        if (!name) return error_no_memory(error);
        const unsigned mark = (unsigned)getpid() % 10000u * 100u + (unsigned)attempt;
        snprintf(name + strlen(name) - 6, 7, "%06u", mark % 1000000u);
        if (linkat(AT_FDCWD, link, AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0) {
            file->temporary = name;
            return GLINT_OK;
        }
        free(name);
        if (errno != EEXIST) break;
    }
    return fail(file->shown, "put the file in its place", error);
}

glint_status out_file_commit(out_file *file, glint_error *error)
{
    glint_status status = GLINT_OK;
    if (file->path) {
        if (fsync(file->fd) != 0) status = fail(file->shown, "sync", error);
        if (!status && !file->temporary) status = name_file(file, error);
        if (!status && rename(file->temporary, file->path) != 0)
            status = fail(file->shown, "put the file in its place", error);
        if (!status) {
            free(file->temporary);
            file->temporary = NULL;
        }
    }
    if (status) {
        out_file_abandon(file);
        return status;
    }
    if (file->close_fd && close(file->fd) != 0) status = fail(file->shown, "close", error);
    release(file);
    return status;
}

void out_file_abandon(out_file *file)
{
    if (!file) return;
    if (file->temporary) unlink(file->temporary);
    if (file->close_fd && file->fd >= 0) close(file->fd);
    release(file);
}

/* The one name, from malloc, that all spellings of a path lead to; of a file that does not exist
 * its folder must. NULL on error. */
static char *only_name(const char *path)
{
    char *name = realpath(path, NULL);
    if (name || errno != ENOENT) return name;
    char *last = name_behind_links(path), *folder = last ? folder_of(last) : NULL;
    char *real_folder = folder ? realpath(folder, NULL) : NULL;
    text t = {0};
    if (real_folder) {
        const char *slash = strrchr(last, '/');
        text_printf(&t, "%s/%s", real_folder, slash ? slash + 1 : last);
        if (t.failed) text_free(&t);
    }
    free(real_folder);
    free(folder);
    free(last);
    return t.data;
}

glint_status out_file_check_two(const char *table, const char *picture, glint_error *error)
{
    if (!table || !picture) return GLINT_OK;
    char *a = only_name(table), *b = only_name(picture);
    /* a name that leads nowhere is refused where it is opened */
    const bool same = string_equal(a && b ? a : table, a && b ? b : picture);
    free(a);
    free(b);
    if (!same) return GLINT_OK;
    return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                     "table and picture both go to '%s'; expected two files", picture);
}

glint_status out_file_is_input(const char *path, glint_error *error)
{
    return error_set(error, GLINT_OUTPUT, (place){path, 0, 0},
                     "the scenario is read from this file; expected another one to write to");
}

glint_status glint_text_write(const char *path, const char *bytes, size_t length,
                              glint_error *error)
{
    out_file *file;
    glint_status status = out_file_open(path, &file, error);
    if (status) return status;
    status = out_file_write(file, bytes, length, error);
    if (!status) return out_file_commit(file, error);
    out_file_abandon(file);
    return status;
}
