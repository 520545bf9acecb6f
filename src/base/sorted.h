/* sorted.h: looking up numbers that ascend. */
#ifndef GLINT_BASE_SORTED_H
#define GLINT_BASE_SORTED_H

#include <stddef.h>

/* How many of n ascending numbers are at most x. first: the first of them; stride: bytes from one
 * to the next. */
static inline size_t sorted_up_to(const double *first, size_t n, size_t stride, double x)
{
    size_t lo = 0, hi = n; /* those before lo are at most x, those from hi are above it */
    while (lo < hi) {
        const size_t middle = lo + (hi - lo) / 2;
        if (*(const double *)((const char *)first + middle * stride) <= x)
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo;
}

/* Number k, 0 <= k <= n - 2, of the interval between neighbours k and k + 1 of n ascending numbers
 * in which x lies; the first one for x before them all, and where n is 1; the last one behind. */
static inline size_t sorted_interval(const double *first, size_t n, size_t stride, double x)
{
    const size_t before = sorted_up_to(first, n, stride, x);
    if (before == 0 || n < 2) return 0;
    return before < n ? before - 1 : n - 2;
}

#endif
