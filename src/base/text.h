/* text.h: growing text buffers, number formatting and reading, paths, nearest names, whole files.
 */
#ifndef GLINT_BASE_TEXT_H
#define GLINT_BASE_TEXT_H

#include "base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A growing text; `data` is owned, terminated when not NULL. Zero-initialise; text_free ends it.
 * When memory runs out `failed` is set, and later appends do nothing: check it once at the end. */
typedef struct text {
    char *data;
    size_t length, capacity;
    bool failed;
} text;

void text_free(text *t);
void text_clear(text *t);
/* Makes room for n more bytes and the terminator; false when memory is out. */
bool text_reserve(text *t, size_t n);
void text_append(text *t, const char *bytes, size_t n);
void text_add(text *t, const char *string);
void text_char(text *t, char c);
void text_printf(text *t, const char *format, ...) GLINT_PRINTF(2, 3);
/* Appends a finite double with the fewest digits that read back exactly. */
void text_double(text *t, double value);

/* Room that number_format needs; the longest number that printf writes with 9 decimals: a sign, 309
 * digits, a point, the decimals and the terminator. */
enum { NUMBER_SIZE = 32, NUMBER_TEXT_SIZE = 324 };
/* Writes the shortest decimal form that reads back as the same double; returns its length, not
 * counting a terminator (none is written). */
size_t number_format(double value, char *out);
/* A number for people, made to stand where printf has %s: `text` ends with the expression. */
typedef struct number_text {
    char text[NUMBER_TEXT_SIZE];
} number_text;
/* With that many decimals (0 to 9), as printf writes %.3f; what rounds to zero has no sign. */
number_text number_fixed(double value, int decimals);
/* The same with '+' before what is more than zero: for differences. */
number_text number_signed(double value, int decimals);
/* Reads one decimal number that fills the `n` bytes at `s` entirely (a leading '+' is accepted;
 * hex, inf and nan are not). False when there is none, or it overflows. */
bool number_read(const char *s, size_t n, double *value);

/* A copy of s (length n) from malloc; NULL when memory is out. */
char *string_copy(const char *s, size_t n);
bool string_equal(const char *a, const char *b);

/* `path` as seen from the folder of the file `from`: unchanged when absolute. "name/../" is left
 * out where both ways lead to the same folder. From malloc. */
char *path_beside(const char *from, const char *path);

/* The name among n that is nearest to `wanted` by edit distance (swaps of neighbours count as one,
 * letter case as nothing); NULL when none is near enough to be a likely slip. */
const char *nearest_name(const char *wanted, const char *const *names, size_t n);

/* Reads a whole regular file (not a directory, a pipe or a device) into a new terminated buffer.
 * Errors: GLINT_INPUT, naming the file, when it is absent, unreadable, not a regular file or larger
 * than 1 GiB. */
glint_status file_read(const char *path, char **data, size_t *size, place asked_from,
                       glint_error *error);

#ifdef __cplusplus
}
#endif
#endif
