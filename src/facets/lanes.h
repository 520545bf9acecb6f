/* lanes.h: several numbers that are worked on at once, on any processor; private to this room.
 *
 * Vectors of 32 bytes as GCC and Clang know them. Their alignment would depend on the processor
 * that a function is compiled for: it is set. */
#ifndef GLINT_FACETS_LANES_H
#define GLINT_FACETS_LANES_H

#include "base/clones.h"

typedef int int8 __attribute__((vector_size(32), aligned(sizeof(int))));
typedef float float8 __attribute__((vector_size(32), aligned(sizeof(float))));
typedef double double4 __attribute__((vector_size(32), aligned(sizeof(double))));
/* What comparing two double4 gives: -1 where it holds, else 0. */
typedef long long mask4 __attribute__((vector_size(32), aligned(sizeof(long long))));

static inline double4 all4(double x)
{
    return (double4){x, x, x, x};
}

/* a where the mask is set, else b. */
static inline double4 pick4(mask4 mask, double4 a, double4 b)
{
    return (double4)((mask & (mask4)a) | (~mask & (mask4)b));
}

static inline double4 least4(double4 a, double4 b)
{
    return pick4(a < b, a, b);
}

static inline double4 most4(double4 a, double4 b)
{
    return pick4(a > b, a, b);
}

static inline double4 size4(double4 a)
{
    return most4(a, -a);
}

#endif
