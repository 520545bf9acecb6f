/* utf8.h: telling characters from bytes that are none. */
#ifndef GLINT_OUTPUT_UTF8_H
#define GLINT_OUTPUT_UTF8_H

#include <stddef.h>

/* Reads one character of UTF-8 from the n > 0 bytes at s into *out; returns its length, 0 where the
 * bytes are no character (names of files and in element sets may hold anything). */
size_t utf8_read(const char *s, size_t n, unsigned *out);

#endif
