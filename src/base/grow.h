/* grow.h: arrays that grow. */
#ifndef GLINT_BASE_GROW_H
#define GLINT_BASE_GROW_H

#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Makes room for `needed` entries of `size` bytes in the array that the pointer at `array` points
 * to: at least doubled, so that appending costs O(1) on average. Entries that are there stay. False
 * when memory is out: nothing has changed then. */
static inline bool grow_room(void *array, int *capacity, long needed, size_t size)
{
    if (needed <= *capacity) return true;
    if (needed > INT_MAX / 2) return false;
    const int wanted = needed > 2L * *capacity ? (int)needed + 16 : 2 * *capacity;
    void *old, *grown;
    memcpy(&old, array, sizeof old);
    grown = realloc(old, (size_t)wanted * size);
    if (!grown) return false;
    memcpy(array, &grown, sizeof grown);
    *capacity = wanted;
    return true;
}

#endif
