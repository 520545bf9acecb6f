/* roots.h: zeros and minima of functions of one variable that may fail. */
#ifndef GLINT_BASE_ROOTS_H
#define GLINT_BASE_ROOTS_H

#include "base/error.h"

/* A continuous function: *y at x. Errors are handed through by everything below. */
typedef glint_status root_function(void *context, double x, double *y, glint_error *error);

/* Finds the zero between a and b, where f has the values fa and fb of opposite signs (one may be
 * 0), to within `tolerance` > 0 in x, or to rounding where that is more. Brent 1973, Algorithms for
 * Minimization without Derivatives, ch. 4: never slower than a few times bisection. */
glint_status root_find(root_function *f, void *context, double a, double fa, double b, double fb,
                       double tolerance, double *x, glint_error *error);

/* Finds a minimum between a < b by golden section (Kiefer 1953, Proc. AMS 4, 502), to within
 * `tolerance` in x: the only one, where f has only one there. Ends of the interval can be the
 * minimum, too. y: its value, NULL allowed. */
glint_status minimum_find(root_function *f, void *context, double a, double b, double tolerance,
                          double *x, double *y, glint_error *error);

/* A growing list of numbers; zero-initialise. Owned; root_list_free ends it. */
typedef struct root_list {
    double *items;
    size_t n, capacity;
} root_list;

void root_list_free(root_list *list);
/* Errors: GLINT_INTERNAL (memory). */
glint_status root_list_add(root_list *list, double x, glint_error *error);

/* Appends all zeros from a to b in ascending order. f is looked at on a grid of the given number of
 * steps, which goes on for one step beyond both ends. Where it comes nearest to zero without a
 * change of sign, its extremum is sought, so that two zeros between neighbours are found, too:
 * nothing is missed if f has no more than one extremum within two steps. Errors: of f;
 * GLINT_INTERNAL (memory). */
glint_status roots_between(root_function *f, void *context, double a, double b, int steps,
                           double tolerance, root_list *out, glint_error *error);

#endif
