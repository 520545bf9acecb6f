/* random.h: numbers that look random and are the same on every machine. */
#ifndef GLINT_BASE_RANDOM_H
#define GLINT_BASE_RANDOM_H

#include <stdint.h>

/* The next number of the sequence that *state stands in; any state may begin one. SplitMix64:
 * Steele, Lea and Flood 2014, OOPSLA, 453. */
static inline uint64_t random_next(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* Evenly distributed, at least 0 and below 1: a multiple of 2^-53. */
static inline double random_even(uint64_t *state)
{
    return (double)(random_next(state) >> 11) * 0x1p-53;
}

/* Nearly normally distributed with mean 0 and variance 1, between -6 and 6: the sum of 12 even
 * ones, which takes no function that machines round in different ways. */
static inline double random_normal(uint64_t *state)
{
    double sum = -6.0;
    for (int k = 0; k < 12; k++)
        sum += random_even(state);
    return sum;
}

#endif
