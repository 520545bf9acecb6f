#include "cli/suggest.h"

#include <string.h>

/* Levenshtein distance of two words; words longer than LONGEST are far from all others. */
static size_t distance(const char *a, const char *b)
{
    enum { LONGEST = 31 };
    const size_t na = strlen(a), nb = strlen(b);
    if (na > LONGEST || nb > LONGEST) return LONGEST;
    size_t row[LONGEST + 1];
    for (size_t j = 0; j <= nb; j++)
        row[j] = j;
    for (size_t i = 1; i <= na; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= nb; j++) {
            const size_t above = row[j];
            size_t best = diagonal + (a[i - 1] != b[j - 1]);
            if (above + 1 < best) best = above + 1;
            if (row[j - 1] + 1 < best) best = row[j - 1] + 1;
            row[j] = best;
            diagonal = above;
        }
    }
    return row[nb];
}

const char *suggest(const char *wanted, const char *const *names, size_t n)
{
    const char *nearest = NULL;
    size_t least = 3; /* two letters off (or one pair swapped) is a slip, three another word */
    for (size_t k = 0; k < n; k++) {
        const size_t d = distance(wanted, names[k]);
        if (d < least && d < strlen(names[k])) {
            least = d;
            nearest = names[k];
        }
    }
    return nearest;
}
