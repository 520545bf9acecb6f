/* suggest.h: the name that the user may have meant. */
#ifndef GLINT_CLI_SUGGEST_H
#define GLINT_CLI_SUGGEST_H

#include <stddef.h>

/* The name among n that is nearest to `wanted`; NULL when none is near enough to be a slip. */
const char *suggest(const char *wanted, const char *const *names, size_t n);

#endif
