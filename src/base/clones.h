/* clones.h: functions compiled for several generations of processors. */
#ifndef GLINT_BASE_CLONES_H
#define GLINT_BASE_CLONES_H

#include <stdlib.h> /* for __GLIBC__ */

/* A function marked so is compiled for three generations of x86-64, and the best one that the
 * processor has is chosen when the program is loaded. Where multiplications and additions are not
 * fused (-ffp-contract=off), all of them round alike. Sanitizers cannot run the code that chooses,
 * and only GCC with glibc offers it. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__GLIBC__) &&       \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define CLONES
#endif

/* Everything that a function marked so calls becomes part of it: only so can it be vectorised, and
 * compiled for the processor that it is chosen for. */
#if defined(__GNUC__)
#define FLATTEN __attribute__((flatten))
#else
#define FLATTEN
#endif

#endif
