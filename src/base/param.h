/* param.h: descriptors of named numeric parameters, from which readers, range checks, listings and
 * reference pages follow. */
#ifndef GLINT_BASE_PARAM_H
#define GLINT_BASE_PARAM_H

#include <math.h>
#include <stdbool.h>

/* One parameter. Ranges are closed unless OPEN is flagged. */
typedef struct param_info {
    const char *name, *unit, *doc;
    double min, max; /* in `unit`; -INFINITY, INFINITY: no limit; of an array: of each element */
    double def;      /* default; NAN: none, must be given unless PARAM_OPTIONAL is flagged */
    unsigned flags;  /* PARAM_MIN_OPEN, PARAM_MAX_OPEN: that end does not belong to the range;
                        PARAM_OPTIONAL: may be left out, and is NAN then;
                        PARAM_ROWS: not a number but rows of numbers, all of one length */
} param_info;

#define PARAM_REQUIRED ((double)NAN)
#define PARAM_NONE ((double)NAN) /* the default of an optional parameter that has none */
enum { PARAM_MIN_OPEN = 1u, PARAM_MAX_OPEN = 2u, PARAM_OPTIONAL = 4u, PARAM_ROWS = 8u };

static inline bool param_is_required(const param_info *p)
{
    return isnan(p->def) && !(p->flags & PARAM_OPTIONAL);
}

/* True when the value is finite and in range. */
static inline bool param_accepts(const param_info *p, double v)
{
    return isfinite(v) && (p->flags & PARAM_MIN_OPEN ? v > p->min : v >= p->min) &&
           (p->flags & PARAM_MAX_OPEN ? v < p->max : v <= p->max);
}

/* Room that param_range_text needs. */
enum { PARAM_RANGE_SIZE = 96 };
/* Writes the range in words ("at least 0", "between 0 and 1", "above 0"), for messages and docs. */
void param_range_text(const param_info *p, char out[PARAM_RANGE_SIZE]);

#endif
