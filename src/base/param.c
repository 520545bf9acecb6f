#include "base/param.h"

#include <stdio.h>

void param_range_text(const param_info *p, char out[PARAM_RANGE_SIZE])
{
    const bool low = isfinite(p->min), high = isfinite(p->max);
    const char *above = p->flags & PARAM_MIN_OPEN ? "above" : "at least";
    const char *below = p->flags & PARAM_MAX_OPEN ? "below" : "at most";
    const bool closed = !(p->flags & (PARAM_MIN_OPEN | PARAM_MAX_OPEN));
    if (low && high && closed)
        snprintf(out, PARAM_RANGE_SIZE, "between %g and %g", p->min, p->max);
    else if (low && high)
        snprintf(out, PARAM_RANGE_SIZE, "%s %g and %s %g", above, p->min, below, p->max);
    else if (low)
        snprintf(out, PARAM_RANGE_SIZE, "%s %g", above, p->min);
    else if (high)
        snprintf(out, PARAM_RANGE_SIZE, "%s %g", below, p->max);
    else
        snprintf(out, PARAM_RANGE_SIZE, "any finite number");
}
