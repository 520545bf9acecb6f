/* file.h: output that appears whole or not at all. */
#ifndef GLINT_OUTPUT_FILE_H
#define GLINT_OUTPUT_FILE_H

#include "base/error.h"

/* A file being written. */
typedef struct out_file out_file;

/* path: NULL for standard output. A regular file (or nothing yet) at `path` is replaced only by
 * out_file_commit; a link is followed, also to where there is nothing yet; a pipe or device is
 * written to at once. Errors: GLINT_OUTPUT. */
glint_status out_file_open(const char *path, out_file **out, glint_error *error);
/* Errors: GLINT_OUTPUT. */
glint_status out_file_write(out_file *file, const char *bytes, size_t n, glint_error *error);
/* Syncs, puts the file in its place and closes; on error nothing is left behind. Frees `file`
 * either way. Errors: GLINT_OUTPUT. */
glint_status out_file_commit(out_file *file, glint_error *error);
/* Refuses a table and a picture that go to one file, under whatever names: spelled in another way
 * or through links, also where there is nothing yet. table, picture: NULL: none, or standard
 * output. Errors: GLINT_ARGUMENT. */
glint_status out_file_check_two(const char *table, const char *picture, glint_error *error);
/* The error that `path` is a file which the scenario is read from. */
glint_status out_file_is_input(const char *path, glint_error *error);
/* Closes and leaves nothing behind. NULL is fine. */
void out_file_abandon(out_file *file);

#endif
