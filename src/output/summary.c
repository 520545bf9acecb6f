#include "output/summary.h"

#include <math.h>
#include <stdlib.h>

/* The median comes from a histogram: bins of 0.001 mag from -50 to 100 mag; what lies outside
 * counts at the ends. */
static const double FIRST_MAG = -50, BIN_MAG = 0.001;
enum { BINS = 150000 };

struct summary_maker {
    glint_summary so_far;
    double step_s, last_s;
    int64_t brighter_6, brighter_7;
    int64_t sunlit_halves, visible_halves; /* of steps */
    int64_t bins[BINS];
};

summary_maker *summary_start(double step_s, double last_s, bool has_utc)
{
    summary_maker *maker = calloc(1, sizeof *maker);
    if (!maker) return NULL;
    maker->step_s = step_s;
    maker->last_s = last_s;
    maker->so_far.has_utc = has_utc;
    return maker;
}

static void add_magnitude(summary_maker *m, const glint_row *row)
{
    glint_summary *s = &m->so_far;
    const double mag = row->magnitude[0];
    if (s->bright_rows == 0 || mag < s->magnitude_min) {
        s->magnitude_min = mag;
        s->brightest_t_s = row->t_s;
        s->brightest_observer = row->observer;
        s->brightest_utc = row->utc;
    }
    if (s->bright_rows == 0 || mag > s->magnitude_max) s->magnitude_max = mag;
    s->bright_rows++;
    m->brighter_6 += mag < 6;
    m->brighter_7 += mag < 7;
    const double bin = floor((mag - FIRST_MAG) / BIN_MAG);
    m->bins[bin < 0 ? 0 : bin >= BINS ? BINS - 1 : (int)bin]++;
}

/* Half steps that a row stands for: one before it and one after it, within the run (trapezoidal
 * rule). */
static int halves_of(const summary_maker *m, double t_s)
{
    return (t_s > 0) + (t_s < m->last_s - 0.5 * m->step_s);
}

void summary_add(summary_maker *m, const glint_row *rows, size_t n)
{
    m->so_far.rows += (int64_t)n;
    for (size_t k = 0; k < n; k++) {
        const bool sunlit = rows[k].sunlit_fraction > 0;
        const int halves = sunlit ? halves_of(m, rows[k].t_s) : 0;
        m->sunlit_halves += halves;
        m->visible_halves += rows[k].flags & (GLINT_BELOW_HORIZON | GLINT_BLOCKED) ? 0 : halves;
        if (rows[k].flux_ratio[0] > 0) add_magnitude(m, &rows[k]);
    }
}

/* The magnitude of that rank, counted from 1, to half a bin. */
static double ranked(const summary_maker *m, int64_t rank)
{
    int64_t count = 0;
    int bin = 0;
    while (bin < BINS - 1 && (count += m->bins[bin]) < rank)
        bin++;
    const double mag = FIRST_MAG + (bin + 0.5) * BIN_MAG;
    return fmin(fmax(mag, m->so_far.magnitude_min), m->so_far.magnitude_max);
}

/* The middle one, or the mean of the two in the middle. */
static double median_of(const summary_maker *m)
{
    const int64_t n = m->so_far.bright_rows;
    return 0.5 * (ranked(m, (n + 1) / 2) + ranked(m, n / 2 + 1));
}

void summary_finish(const summary_maker *m, glint_summary *out)
{
    *out = m->so_far;
    if (out->bright_rows > 0) {
        out->magnitude_median = median_of(m);
        out->percent_brighter_6 = 100.0 * (double)m->brighter_6 / (double)out->bright_rows;
        out->percent_brighter_7 = 100.0 * (double)m->brighter_7 / (double)out->bright_rows;
    }
    out->sunlit_s = 0.5 * (double)m->sunlit_halves * m->step_s;
    out->visible_s = 0.5 * (double)m->visible_halves * m->step_s;
}

void summary_free(summary_maker *m)
{
    free(m);
}
