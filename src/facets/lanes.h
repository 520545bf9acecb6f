/* lanes.h: several numbers that are worked on at once, on any processor; private to this room.
 *
 * Vectors of 32 bytes as GCC and Clang know them. Their alignment would depend on the processor
 * that a function is compiled for: it is set. */
#ifndef GLINT_FACETS_LANES_H
#define GLINT_FACETS_LANES_H

#include <stdlib.h> /* for __GLIBC__ */

typedef int int8 __attribute__((vector_size(32), aligned(sizeof(int))));
typedef float float8 __attribute__((vector_size(32), aligned(sizeof(float))));
typedef double double4 __attribute__((vector_size(32), aligned(sizeof(double))));
/* What comparing two double4 gives: -1 where it holds, else 0. */
typedef long long mask4 __attribute__((vector_size(32), aligned(sizeof(long long))));

/* A function marked so is compiled for three generations of x86-64, and the best one that the
 * processor has is chosen when the program is loaded. All of them round alike. Sanitizers cannot
 * run the code that chooses, and only GCC with glibc offers it. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__GLIBC__) &&       \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define LANES_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define LANES_CLONES
#endif

#endif
