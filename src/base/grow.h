/* grow.h: arrays that grow. */
#ifndef GLINT_BASE_GROW_H
#define GLINT_BASE_GROW_H

#include <limits.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Makes room for `needed` entries of `size` bytes in the array that the pointer at `array` points
 * to: at least doubled, so that appending costs O(1) on average. Entries that are there stay. False
 * when memory is out: nothing has changed then. */
static inline bool grow_list(void *array, size_t *capacity, size_t needed, size_t size)
{
    enum { SPARE = 16 }; /* entries: short arrays grow rarely */
    if (needed <= *capacity) return true;
    if (needed > SIZE_MAX / 2 / size - SPARE) return false;
    const size_t wanted = needed > 2 * *capacity ? needed + SPARE : 2 * *capacity;
    void *old, *grown;
    memcpy(&old, array, sizeof old);
    grown = realloc(old, wanted * size);
    if (!grown) return false;
    memcpy(array, &grown, sizeof grown);
    *capacity = wanted;
    return true;
}

/* The same for arrays that count in int. */
static inline bool grow_room(void *array, int *capacity, long needed, size_t size)
{
    if (needed <= *capacity) return true;
    if (needed > INT_MAX / 2) return false;
    size_t grown = (size_t)*capacity;
    if (!grow_list(array, &grown, (size_t)needed, size)) return false;
    *capacity = (int)grown;
    return true;
}

#endif
