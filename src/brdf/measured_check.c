/* measured_check.c: the rows of a file of measurements together: doubles, and gaps. */
#include "brdf/measured.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A row as a member of a scan: three angles rest, one moves. */
typedef struct member {
    double rests[3], moves; /* in the file's unit */
    double f;               /* 1/sr */
    int line;
} member;

static int compare_numbers(double x, double y)
{
    return (x > y) - (x < y);
}

static int compare_scans(const member *a, const member *b)
{
    for (int k = 0; k < 3; k++) {
        const int order = compare_numbers(a->rests[k], b->rests[k]);
        if (order) return order;
    }
    return 0;
}

static int compare_members(const void *a, const void *b)
{
    const member *x = a, *y = b;
    const int scans = compare_scans(x, y), moved = compare_numbers(x->moves, y->moves);
    return scans ? scans : moved ? moved : x->line - y->line;
}

/* The rows in the order of the scans in which angle `moving` moves. */
static void sort_members(const measured *rows, int moving, member *out)
{
    for (int k = 0; k < rows->n; k++) {
        const measured_point *p = &rows->points[k];
        out[k] = (member){.moves = p->angle[moving], .f = p->f, .line = p->line};
        for (int j = 0, n = 0; j < 4; j++)
            if (j != moving) out[k].rests[n++] = p->angle[j];
    }
    qsort(out, (size_t)rows->n, sizeof *out, compare_members);
}

/* Reports rows with the same angles; leaves one of each, and returns their number. */
static int merge_doubles(member *rows, int n, const char *path, glint_status *status,
                         glint_errors *errors)
{
    int kept = 0;
    for (int k = 0; k < n; k++) {
        const member *last = kept ? &rows[kept - 1] : NULL;
        if (!last || compare_scans(last, &rows[k]) || last->moves != rows[k].moves)
            rows[kept++] = rows[k];
        else if (last->f != rows[k].f)
            *status = errors_add(errors, GLINT_INPUT, (place){path, rows[k].line, 1},
                                 "f is %.10g here and %.10g at the same angles in line %d; "
                                 "expected one value, as their mean",
                                 rows[k].f, last->f, last->line);
    }
    return kept;
}

/* Gaps in scans. */
typedef struct gaps {
    int n, n_scans; /* gaps, and scans altogether */
    member before, after;
    double usual; /* step beside the widest gap */
} gaps;

/* Looks for gaps in one scan of n rows: steps that are wider by far than those on both sides. */
static void look_for_gaps(const member *rows, int n, gaps *found)
{
    static const double WIDER = 1.8; /* where one row of even steps is missing it is 2 */
    found->n_scans++;
    for (int k = 1; k + 2 < n; k++) {
        const double step = rows[k + 1].moves - rows[k].moves;
        const double sides =
            fmax(rows[k].moves - rows[k - 1].moves, rows[k + 2].moves - rows[k + 1].moves);
        if (!(step > WIDER * sides)) continue;
        if (found->n == 0 || step > found->after.moves - found->before.moves) {
            found->before = rows[k];
            found->after = rows[k + 1];
            found->usual = sides;
        }
        found->n++;
    }
}

static gaps find_gaps(const member *rows, int n)
{
    gaps found = {0};
    for (int from = 0, to; from < n; from = to) {
        to = from + 1;
        while (to < n && compare_scans(&rows[from], &rows[to]) == 0)
            to++;
        look_for_gaps(rows + from, to - from, &found);
    }
    return found;
}

static void warn_of_gaps(const gaps *found, const char *moves, const char *path,
                         glint_errors *errors)
{
    char more[64] = "";
    if (found->n > 1) snprintf(more, sizeof more, " (the widest of %d such gaps)", found->n);
    errors_warn(errors, (place){path, found->after.line, 1},
                "nothing was measured between %s = %.6g (line %d) and %.6g here, where rows stand "
                "%.4g apart on both sides%s; ln f is interpolated across",
                moves, found->before.moves, found->before.line, found->after.moves, found->usual,
                more);
}

glint_status measured_check(const measured *rows, const char *path, glint_errors *errors)
{
    /* what moves fastest in files of laboratories; scans are those of the first that makes some */
    static const int MOVING[] = {MEASURED_THETA_R, MEASURED_THETA_I, MEASURED_PHI_R};
    enum { KINDS = sizeof MOVING / sizeof MOVING[0], FEWEST = 4 }; /* rows of a scan, on average */
    member *members = malloc((size_t)rows->n * sizeof *members);
    if (!members) return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    glint_status status = GLINT_OK;
    for (int kind = 0; kind < KINDS; kind++) {
        sort_members(rows, MOVING[kind], members);
        glint_status seen = GLINT_OK; /* doubles are the same of every kind */
        const int n = merge_doubles(members, rows->n, path, &seen, kind == 0 ? errors : NULL);
        if (kind == 0) status = seen;
        const gaps found = find_gaps(members, n);
        if (found.n_scans > n / FEWEST) continue;
        if (found.n > 0) warn_of_gaps(&found, measured_name(MOVING[kind]), path, errors);
        break;
    }
    free(members);
    return status;
}
