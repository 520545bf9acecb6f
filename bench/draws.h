/* draws.h: attitudes drawn at random, for benchmarks. */
#ifndef GLINT_BENCH_DRAWS_H
#define GLINT_BENCH_DRAWS_H

#include "base/constants.h"
#include "base/random.h"
#include "base/vec.h"

/* A uniformly distributed rotation (Shoemake 1992, Graphics Gems III). */
static inline void random_rotation(uint64_t *state, double out[9])
{
    const double u = random_even(state), a = TWO_PI * random_even(state);
    const double b = TWO_PI * random_even(state);
    const double q[4] = {sqrt(u) * cos(b), sqrt(1 - u) * sin(a), sqrt(1 - u) * cos(a),
                         sqrt(u) * sin(b)};
    mat_from_quat(q, out);
}

#endif
