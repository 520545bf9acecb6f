/* compare.c: the prediction at the moments of an observed track, and how they differ. */
#include "base/constants.h"
#include "lightcurve/facts.h"
#include "lightcurve/photometry.h"
#include "lightcurve/predict.h"

#include <math.h>
#include <stdlib.h>

struct glint_comparison {
    const glint_scenario *s;  /* borrowed */
    glint_observation *items; /* owned; as the rows of the file */
    glint_comparison_summary total;
    fact_list facts;
};

/* ------------------------------------------------------------- predictions */

/* What a predicted apparent magnitude is as one of the observed kind. */
static double reduce(observed_kind kind, double magnitude, double range_m, double phase)
{
    /* An observation at 1000 km keeps its phase. */
    const double standard = kind == OBSERVED_AT_1000_KM ? phase : 0.5 * PI;
    return kind == OBSERVED_APPARENT ? magnitude
                                     : magnitude + magnitude_to_standard(range_m, phase, standard);
}

static void fill(const glint_scenario *s, const observed_row *from, const glint_row *row,
                 glint_observation *out)
{
    const observed_track *o = &s->observed;
    *out = (glint_observation){.line = from->line,
                               .utc = row->utc,
                               .t_s = from->t_s,
                               .observed = from->magnitude,
                               .sigma = from->sigma,
                               .range_m = row->range_m,
                               .phase_rad = row->phase_angle_rad,
                               .elevation_rad = row->elevation_rad,
                               .sunlit_fraction = row->sunlit_fraction,
                               .observed_range_m = from->range_m,
                               .observed_phase_rad = from->phase};
    if (row->flux_ratio[o->band] > 0)
        out->predicted =
            reduce(o->kind, row->magnitude[o->band], row->range_m, row->phase_angle_rad);
    else
        out->state = row->flags & GLINT_UMBRA                             ? GLINT_PREDICTED_ECLIPSED
                     : row->flags & (GLINT_BELOW_HORIZON | GLINT_BLOCKED) ? GLINT_PREDICTED_NOT_SEEN
                                                                          : GLINT_PREDICTED_DARK;
}

/* A row with its number in the file. */
typedef struct ordered_row {
    double t_s;
    size_t row;
} ordered_row;

static int by_time(const void *a, const void *b)
{
    const ordered_row *x = a, *y = b;
    if (x->t_s != y->t_s) return x->t_s < y->t_s ? -1 : 1;
    return x->row < y->row ? -1 : x->row > y->row;
}

/* Observations in the order of time. */
typedef struct track_order {
    glint_comparison *c;
    ordered_row *rows; /* owned */
    double *t_s;       /* owned */
} track_order;

static void take_observation(void *context, size_t k, const glint_row *row)
{
    const track_order *order = context;
    const size_t at = order->rows[k].row;
    fill(order->c->s, &order->c->s->observed.rows[at], row, &order->c->items[at]);
}

static glint_status predict_all(glint_comparison *c, int threads, glint_error *error)
{
    const observed_track *o = &c->s->observed;
    track_order order = {.c = c,
                         .rows = calloc(o->n + 1, sizeof *order.rows),
                         .t_s = calloc(o->n + 1, sizeof *order.t_s)};
    glint_status status = order.rows && order.t_s ? GLINT_OK : error_no_memory(error);
    for (size_t k = 0; !status && k < o->n; k++)
        order.rows[k] = (ordered_row){o->rows[k].t_s, k};
    if (!status && o->n > 1) qsort(order.rows, o->n, sizeof *order.rows, by_time);
    for (size_t k = 0; !status && k < o->n; k++)
        order.t_s[k] = order.rows[k].t_s;
    if (!status)
        status = predict_rows(c->s, &c->s->observers[o->observer], order.t_s, o->n, threads,
                              take_observation, &order, error);
    free(order.rows);
    free(order.t_s);
    return status;
}

/* Magnitudes at moments of one's own choice. */
typedef struct curve_points {
    const glint_scenario *s;
    double *magnitude;
} curve_points;

static void take_magnitude(void *context, size_t k, const glint_row *row)
{
    const curve_points *points = context;
    const observed_track *o = &points->s->observed;
    points->magnitude[k] = row->flux_ratio[o->band] > 0 ? reduce(o->kind, row->magnitude[o->band],
                                                                 row->range_m, row->phase_angle_rad)
                                                        : HUGE_VAL;
}

glint_status glint_comparison_predict(const glint_comparison *c, const double *t_s, size_t n,
                                      int threads, double *predicted, glint_error *error)
{
    curve_points points = {c->s, predicted};
    for (size_t k = 0; k < n; k++)
        if (!(t_s[k] >= (k ? t_s[k - 1] : 0) && t_s[k] <= c->s->span_s))
            return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                             "moment %zu is %g s; expected rising ones from 0 to %g s", k, t_s[k],
                             c->s->span_s);
    return predict_rows(c->s, &c->s->observers[c->s->observed.observer], t_s, n, threads,
                        take_magnitude, &points, error);
}

/* ----------------------------------------------------------------- numbers */

static void count_states(glint_comparison *c)
{
    glint_comparison_summary *t = &c->total;
    for (size_t k = 0; k < c->s->observed.n; k++) {
        const glint_observation *o = &c->items[k];
        t->compared += o->state == GLINT_COMPARED;
        t->eclipsed += o->state == GLINT_PREDICTED_ECLIPSED;
        t->not_seen += o->state == GLINT_PREDICTED_NOT_SEEN;
        t->dark += o->state == GLINT_PREDICTED_DARK;
        t->penumbra += o->state == GLINT_COMPARED && o->sunlit_fraction < 1;
        t->with_sigma += o->state == GLINT_COMPARED && o->sigma > 0;
    }
}

/* The constant that least squares add to the prediction: of equal weights unless every row has its
 * own. */
static void fit_zero_point(glint_comparison *c)
{
    glint_comparison_summary *t = &c->total;
    const bool weighted = t->with_sigma == t->compared;
    double sum = 0, weights = 0, squares = 0;
    for (size_t k = 0; k < c->s->observed.n; k++) {
        const glint_observation *o = &c->items[k];
        if (o->state != GLINT_COMPARED) continue;
        const double weight = weighted ? 1 / (o->sigma * o->sigma) : 1;
        sum += weight * (o->observed - o->predicted);
        weights += weight;
    }
    t->zero_point = sum / weights;
    if (weighted) {
        t->zero_point_sigma = 1 / sqrt(weights);
        return;
    }
    for (size_t k = 0; k < c->s->observed.n; k++) {
        const glint_observation *o = &c->items[k];
        const double rest = o->observed - o->predicted - t->zero_point;
        squares += o->state == GLINT_COMPARED ? rest * rest : 0;
    }
    const double n = (double)t->compared;
    if (n > 1) t->zero_point_sigma = sqrt(squares / (n * (n - 1)));
}

/* Residuals, and the sums that need no means. */
static void find_residuals(glint_comparison *c)
{
    glint_comparison_summary *t = &c->total;
    double squares = 0, relative = 0;
    t->has_chi2_relative = true;
    for (size_t k = 0; k < c->s->observed.n; k++) {
        glint_observation *o = &c->items[k];
        if (o->state != GLINT_COMPARED) continue;
        o->residual = o->observed - o->predicted - t->zero_point;
        t->mean += o->residual;
        squares += o->residual * o->residual;
        if (fabs(o->residual) > fabs(t->largest)) t->largest = o->residual;
        if (o->sigma > 0) t->chi2 += (o->residual / o->sigma) * (o->residual / o->sigma);
        if (o->observed > 0)
            relative += o->residual * o->residual / o->observed;
        else
            t->has_chi2_relative = false;
    }
    const double n = (double)t->compared;
    t->mean /= n;
    t->rms = sqrt(squares / n);
    t->chi2_relative = t->has_chi2_relative ? relative / n : 0;
    t->freedom = t->with_sigma - t->fitted;
}

/* Pearson's correlation and the scatter, about the means. */
static void find_correlation(glint_comparison *c)
{
    glint_comparison_summary *t = &c->total;
    double observed_mean = 0, predicted_mean = 0, scatter = 0, oo = 0, pp = 0, op = 0;
    const double n = (double)t->compared;
    for (size_t k = 0; k < c->s->observed.n; k++) {
        if (c->items[k].state != GLINT_COMPARED) continue;
        observed_mean += c->items[k].observed / n;
        predicted_mean += c->items[k].predicted / n;
    }
    for (size_t k = 0; k < c->s->observed.n; k++) {
        const glint_observation *item = &c->items[k];
        if (item->state != GLINT_COMPARED) continue;
        const double o = item->observed - observed_mean, p = item->predicted - predicted_mean;
        oo += o * o;
        pp += p * p;
        op += o * p;
        scatter += (item->residual - t->mean) * (item->residual - t->mean);
    }
    /* a constant series differs from its mean by roundings alone */
    const double least_o = n * pow(1e-14 * fabs(observed_mean), 2);
    const double least_p = n * pow(1e-14 * fabs(predicted_mean), 2);
    t->scatter = sqrt(scatter / n);
    t->has_r = t->compared > 1 && oo > least_o && pp > least_p;
    if (t->has_r) t->r = op / sqrt(oo * pp);
}

/* Differences of what the observer says of range and phase angle, of the rows with light or not. */
static void compare_places(glint_comparison *c)
{
    glint_comparison_summary *t = &c->total;
    for (size_t k = 0; k < c->s->observed.n; k++) {
        const glint_observation *o = &c->items[k];
        if (o->observed_range_m > 0) {
            const double off = o->observed_range_m - o->range_m;
            t->with_range++;
            t->range_mean_m += off;
            if (fabs(off) > fabs(t->range_most_m)) t->range_most_m = off;
        }
        if (o->observed_phase_rad >= 0) {
            const double off = o->observed_phase_rad - o->phase_rad;
            t->with_phase++;
            t->phase_mean_rad += off;
            if (fabs(off) > fabs(t->phase_most_rad)) t->phase_most_rad = off;
        }
    }
    if (t->with_range > 0) t->range_mean_m /= (double)t->with_range;
    if (t->with_phase > 0) t->phase_mean_rad /= (double)t->with_phase;
}

static void start_total(const glint_scenario *s, glint_comparison_summary *t)
{
    const observed_track *o = &s->observed;
    *t = (glint_comparison_summary){.observations = (int64_t)o->n + o->outside_time +
                                                    o->other_filter + o->without_magnitude,
                                    .outside_time = o->outside_time,
                                    .other_filter = o->other_filter,
                                    .without_magnitude = o->without_magnitude,
                                    .fitted = o->fit_zero_point,
                                    .title = s->title,
                                    .band = s->bands[o->band]->name,
                                    .kind = observed_kind_names[o->kind],
                                    .format = o->format,
                                    .file = o->path};
}

static glint_status check_scenario(const glint_scenario *s, glint_error *error)
{
    const place where = {s->documents[0]->path, 0, 0};
    if (!s->has_observed)
        return error_set(error, GLINT_INPUT, where,
                         "the scenario has no [observed]; expected one that names a file of "
                         "observations");
    if (!s->has_satellite || !s->has_attitude)
        return error_set(error, GLINT_ARGUMENT, where,
                         "this scenario was read without a satellite that could shine; expected "
                         "one from glint_scenario_read");
    return GLINT_OK;
}

glint_status glint_compare(const glint_scenario *s, int threads, glint_comparison **out,
                           glint_error *error)
{
    *out = NULL;
    glint_status status = check_scenario(s, error);
    if (status) return status;
    glint_comparison *c = calloc(1, sizeof *c);
    if (c) c->items = calloc(s->observed.n + 1, sizeof *c->items);
    if (!c || !c->items) {
        free(c);
        return error_no_memory(error);
    }
    c->s = s;
    start_total(s, &c->total);
    facts_of_run(s, &c->facts);
    status = c->facts.failed ? error_no_memory(error) : predict_all(c, threads, error);
    if (status) {
        glint_comparison_free(c);
        return status;
    }
    count_states(c);
    if (c->total.compared > 0) {
        if (c->total.fitted) fit_zero_point(c);
        find_residuals(c);
        find_correlation(c);
    }
    compare_places(c);
    *out = c;
    return GLINT_OK;
}

void glint_comparison_free(glint_comparison *c)
{
    if (!c) return;
    free(c->items);
    fact_list_free(&c->facts);
    free(c);
}

bool glint_comparison_get(const glint_comparison *c, size_t k, glint_observation *out)
{
    if (k >= c->s->observed.n) return false;
    *out = c->items[k];
    return true;
}

bool glint_comparison_fact(const glint_comparison *c, size_t k, const char **key,
                           const char **value)
{
    return fact_list_get(&c->facts, k, key, value);
}

void glint_comparison_total(const glint_comparison *c, glint_comparison_summary *out)
{
    *out = c->total;
}

const char *glint_observation_state_name(glint_observation_state state)
{
    switch (state) {
    case GLINT_COMPARED:
        return "compared";
    case GLINT_PREDICTED_ECLIPSED:
        return "eclipsed";
    case GLINT_PREDICTED_NOT_SEEN:
        return "not-seen";
    case GLINT_PREDICTED_DARK:
        return "dark";
    }
    return "";
}
