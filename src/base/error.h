/* error.h: filling in errors, and lists of them (the types are public: glint.h). */
#ifndef GLINT_BASE_ERROR_H
#define GLINT_BASE_ERROR_H

#include <glint/glint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A place in a file; line and column count from 1, 0 where there is none. `file` borrowed. */
typedef struct place {
    const char *file;
    int line, column;
} place;

#define PLACE_NONE ((place){NULL, 0, 0})

#if defined(__GNUC__)
#define GLINT_PRINTF(f, a) __attribute__((format(printf, f, a)))
#else
#define GLINT_PRINTF(f, a)
#endif

/* Fills *error (NULL allowed) and returns `status`, so that a caller can return the call. */
glint_status error_set(glint_error *error, glint_status status, place where, const char *format,
                       ...) GLINT_PRINTF(4, 5);

/* Appends an error to the list (NULL allowed) and returns `status`. */
glint_status errors_add(glint_errors *errors, glint_status status, place where, const char *format,
                        ...) GLINT_PRINTF(4, 5);

/* Appends a warning. */
void errors_warn(glint_errors *errors, place where, const char *format, ...) GLINT_PRINTF(3, 4);

/* Appends a copy of one error, its place filled in from `where` if it has none; returns its
 * status. */
glint_status errors_take(glint_errors *errors, const glint_error *error, place where);

/* Puts the entries from `first` on in the order of their places within each file. */
void errors_sort(glint_errors *errors, size_t first);

/* The usual text for memory that is out; returns GLINT_INTERNAL. */
glint_status error_no_memory(glint_error *error);
glint_status errors_no_memory(glint_errors *errors);

#ifdef __cplusplus
}
#endif
#endif
