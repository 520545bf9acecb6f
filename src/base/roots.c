#include "base/roots.h"

#include "base/grow.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* The step of Brent's method from b, the best point so far: by interpolation through a, b and c
 * where that is safe, else to the middle. c: on the other side of the zero; before: the step before
 * last. */
static double next_step(double a, double fa, double b, double fb, double c, double fc, double tol,
                        double *last, double *before)
{
    const double middle = 0.5 * (c - b);
    double p, q;
    if (fabs(*before) >= tol && fabs(fa) > fabs(fb)) {
        const double s = fb / fa;
        if (a == c) { /* two points: a straight line */
            p = 2 * middle * s;
            q = 1 - s;
        } else { /* three: inverse quadratic */
            const double u = fa / fc, r = fb / fc;
            p = s * (2 * middle * u * (u - r) - (b - a) * (r - 1));
            q = (u - 1) * (r - 1) * (s - 1);
        }
        if (p > 0)
            q = -q;
        else
            p = -p;
        if (2 * p < fmin(3 * middle * q - fabs(tol * q), fabs(*before * q))) {
            *before = *last;
            *last = p / q;
            return *last;
        }
    }
    *last = *before = middle;
    return middle;
}

glint_status root_find(root_function *f, void *context, double a, double fa, double b, double fb,
                       double tolerance, double *x, glint_error *error)
{
    enum { MOST = 200 }; /* bisection alone takes about 60 */
    double c = a, fc = fa, last = b - a, before = last;
    for (int k = 0; k < MOST && fb != 0; k++) {
        if ((fb > 0) == (fc > 0)) {
            c = a, fc = fa;
            last = before = b - a;
        }
        if (fabs(fc) < fabs(fb)) {
            a = b, b = c, c = a;
            fa = fb, fb = fc, fc = fa;
        }
        const double tol = 2 * DBL_EPSILON * fabs(b) + 0.5 * tolerance;
        if (fabs(0.5 * (c - b)) <= tol) break;
        const double step = next_step(a, fa, b, fb, c, fc, tol, &last, &before);
        a = b, fa = fb;
        b += fabs(step) > tol ? step : c > b ? tol : -tol;
        const glint_status status = f(context, b, &fb, error);
        if (status) return status;
    }
    *x = b;
    return GLINT_OK;
}

glint_status minimum_find(root_function *f, void *context, double a, double b, double tolerance,
                          double *x, double *y, glint_error *error)
{
    static const double GOLDEN = 0.61803398874989484820; /* (sqrt(5) - 1) / 2 */
    double at[2] = {b - GOLDEN * (b - a), a + GOLDEN * (b - a)}, value[2], ends[2];
    const double from = a, to = b;
    glint_status status = f(context, at[0], &value[0], error);
    if (!status) status = f(context, at[1], &value[1], error);
    while (!status && b - a > tolerance + 4 * DBL_EPSILON * (fabs(a) + fabs(b))) {
        const int worse = value[0] < value[1] ? 1 : 0;
        if (worse) {
            b = at[1], at[1] = at[0], value[1] = value[0];
            at[0] = b - GOLDEN * (b - a);
        } else {
            a = at[0], at[0] = at[1], value[0] = value[1];
            at[1] = a + GOLDEN * (b - a);
        }
        status = f(context, at[1 - worse], &value[1 - worse], error);
    }
    if (!status) status = f(context, from, &ends[0], error);
    if (!status) status = f(context, to, &ends[1], error);
    if (status) return status;
    const int better = value[1] < value[0];
    double best = value[better];
    *x = at[better];
    if (ends[0] < best) best = ends[0], *x = from;
    if (ends[1] < best) best = ends[1], *x = to;
    if (y) *y = best;
    return GLINT_OK;
}

void root_list_free(root_list *list)
{
    free(list->items);
    *list = (root_list){0};
}

glint_status root_list_add(root_list *list, double x, glint_error *error)
{
    if (!grow_list(&list->items, &list->capacity, list->n + 1, sizeof *list->items))
        return error_no_memory(error);
    list->items[list->n++] = x;
    return GLINT_OK;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void sort(root_list *list)
{
    if (list->n > 1) qsort(list->items, list->n, sizeof *list->items, ascending);
}

/* A function with its sign turned, so that its extremum towards zero is a minimum. */
typedef struct turned {
    root_function *f;
    void *context;
    double sign;
} turned;

static glint_status turned_at(void *context, double x, double *y, glint_error *error)
{
    const turned *t = context;
    const glint_status status = t->f(t->context, x, y, error);
    *y *= t->sign;
    return status;
}

/* A search in progress: what lies outside a .. b is not kept. */
typedef struct search {
    root_function *f;
    void *context;
    double a, b, tolerance;
    root_list *out;
} search;

static glint_status keep(const search *s, double from, double f_from, double to, double f_to,
                         glint_error *error)
{
    double x;
    const glint_status status =
        root_find(s->f, s->context, from, f_from, to, f_to, s->tolerance, &x, error);
    if (status || x < s->a || x > s->b) return status;
    return root_list_add(s->out, x, error);
}

/* Looks for two zeros around the point nearest to zero of three with the same sign. */
static glint_status look_between(const search *s, const double x[3], const double y[3],
                                 glint_error *error)
{
    turned t = {s->f, s->context, y[1] > 0 ? 1 : -1};
    double at, least;
    glint_status status = minimum_find(turned_at, &t, x[0], x[2], s->tolerance, &at, &least, error);
    if (status || !(least < 0)) return status;
    status = keep(s, x[0], y[0], at, least * t.sign, error);
    return status ? status : keep(s, at, least * t.sign, x[2], y[2], error);
}

glint_status roots_between(root_function *f, void *context, double a, double b, int steps,
                           double tolerance, root_list *out, glint_error *error)
{
    const search s = {f, context, a, b, tolerance, out};
    const double step = (b - a) / steps;
    const size_t first = out->n;
    double x[3] = {0}, y[3] = {0};
    for (int k = -1; k <= steps + 1; k++) {
        x[0] = x[1], y[0] = y[1];
        x[1] = x[2], y[1] = y[2];
        x[2] = k == steps ? b : a + k * step;
        glint_status status = f(context, x[2], &y[2], error);
        if (!status && k >= 0 && (y[1] > 0) != (y[2] > 0))
            status = keep(&s, x[1], y[1], x[2], y[2], error);
        const bool alike = k > 0 && (y[0] > 0) == (y[1] > 0) && (y[1] > 0) == (y[2] > 0);
        if (!status && alike && fabs(y[1]) <= fabs(y[0]) && fabs(y[1]) <= fabs(y[2]))
            status = look_between(&s, x, y, error);
        if (status) return status;
    }
    root_list found = {out->items + first, out->n - first, 0};
    sort(&found);
    return GLINT_OK;
}
