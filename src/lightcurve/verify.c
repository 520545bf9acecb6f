/* verify.c: holds a run against the values and requirements that its scenario carries. */
#include "base/grow.h"
#include "base/text.h"
#include "base/vec.h"
#include "scenario/scenario.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

/* Rows are matched to t_s within this, s: TT seconds are rounded to the microsecond in tables. */
static const double SAME_TIME_S = 1e-6;

/* How one requirement fares. */
typedef struct tally {
    int64_t selected, met;
    double worst, worst_limit; /* the brightest above its limit */
    glint_row worst_row;
    int64_t worst_index; /* of that row, counted from 0 */
    bool any_worst;
    char surface[192]; /* what most of the light of that row comes from; "" where not known */
    double *excess;    /* owned; of each selected row: magnitude less limit, HUGE_VAL where dark */
    size_t capacity;
} tally;

typedef struct verification {
    const glint_scenario *s;
    const glint_curve *curve;
    size_t *expect_column;  /* owned; of each expectation */
    bool *met_row;          /* owned; whether its row came */
    size_t *table_column;   /* owned; of each compared column of the table */
    size_t *require_column; /* owned */
    size_t *when_column;    /* owned; of all conditions of all requirements, in order */
    tally *tallies;         /* owned */
    text report;            /* owned; a line for each requirement */
    int64_t row;            /* rows so far */
    glint_verdict verdict;
    glint_errors *errors;
    glint_status status;
} verification;

static void deviate(verification *v, place where, const char *format, ...) GLINT_PRINTF(3, 4);

static void deviate(verification *v, place where, const char *format, ...)
{
    char message[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    v->verdict.deviations++;
    v->status = errors_add(v->errors, GLINT_INPUT, where, "%s", message);
}

/* The number column of that name; an error at `where` without one. */
static bool find_column(verification *v, const char *name, place where, size_t *out)
{
    size_t n;
    const glint_column *columns = glint_curve_columns(v->curve, &n);
    const char **names = calloc(n + 1, sizeof *names);
    size_t count = 0;
    for (size_t i = 0; names && i < n; i++) {
        if (!columns[i].is_text) names[count++] = columns[i].name;
        if (columns[i].is_text || !string_equal(columns[i].name, name)) continue;
        *out = i;
        free(names);
        return true;
    }
    const char *near = names ? nearest_name(name, names, count) : NULL;
    v->status =
        errors_add(v->errors, GLINT_INPUT, where, "the table has no number column '%.60s'%s%s%s",
                   name, near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
    free(names);
    return false;
}

static void find_columns(verification *v)
{
    const glint_scenario *s = v->s;
    for (int i = 0; i < s->n_expectations; i++)
        find_column(v, s->expectations[i].column, s->expectations[i].where, &v->expect_column[i]);
    for (int i = 0; i < s->expected.n_columns; i++)
        find_column(v, s->expected.columns[i], s->expected.where, &v->table_column[i]);
    size_t at = 0;
    for (int i = 0; i < s->n_requirements; i++) {
        const requirement *r = &s->requirements[i];
        find_column(v, r->column, r->where, &v->require_column[i]);
        for (int k = 0; k < r->n_when; k++)
            find_column(v, r->when[k].column, r->when[k].where, &v->when_column[at++]);
    }
}

static size_t count_conditions(const glint_scenario *s)
{
    size_t n = 0;
    for (int i = 0; i < s->n_requirements; i++)
        n += (size_t)s->requirements[i].n_when;
    return n;
}

static bool allocate(verification *v)
{
    const glint_scenario *s = v->s;
    v->expect_column = calloc((size_t)s->n_expectations + 1, sizeof *v->expect_column);
    v->met_row = calloc((size_t)s->n_expectations + 1, sizeof *v->met_row);
    v->table_column = calloc((size_t)s->expected.n_columns + 1, sizeof *v->table_column);
    v->require_column = calloc((size_t)s->n_requirements + 1, sizeof *v->require_column);
    v->when_column = calloc(count_conditions(s) + 1, sizeof *v->when_column);
    v->tallies = calloc((size_t)s->n_requirements + 1, sizeof *v->tallies);
    return v->expect_column && v->met_row && v->table_column && v->require_column &&
           v->when_column && v->tallies;
}

static void release(verification *v)
{
    free(v->expect_column);
    free(v->met_row);
    free(v->table_column);
    free(v->require_column);
    free(v->when_column);
    for (int i = 0; v->tallies && i < v->s->n_requirements; i++)
        free(v->tallies[i].excess);
    free(v->tallies);
}

/* Compares a cell with a value; `label` says which row. */
static void compare(verification *v, const glint_row *row, size_t column, const expectation *e,
                    const char *label)
{
    double got;
    v->verdict.expectations++;
    const bool full = glint_curve_value(v->curve, row, column, &got);
    const double allowed = e->absolute + e->relative * fabs(e->value);
    if (!full && !e->empty)
        deviate(v, e->where, "%s at %s is empty; expected %.15g", e->column, label, e->value);
    else if (full && e->empty)
        deviate(v, e->where, "%s at %s is %.15g; expected an empty cell", e->column, label, got);
    else if (full && !(fabs(got - e->value) <= allowed))
        deviate(v, e->where, "%s at %s is %.15g; expected %.15g within %.3g, off by %.3g%s%s%s",
                e->column, label, got, e->value, allowed, got - e->value, e->source[0] ? " (" : "",
                e->source, e->source[0] ? ")" : "");
}

static void hold_expectations(verification *v, const glint_row *row)
{
    for (int i = 0; i < v->s->n_expectations; i++) {
        const expectation *e = &v->s->expectations[i];
        const bool here = e->by_row ? e->row == v->row
                                    : fabs(row->t_s - e->t_s) <= SAME_TIME_S &&
                                          string_equal(row->observer, e->observer);
        if (!here || v->met_row[i]) continue;
        char label[64];
        snprintf(label, sizeof label, "t_s = %.9g (row %lld)", row->t_s, (long long)v->row);
        v->met_row[i] = true;
        compare(v, row, v->expect_column[i], e, label);
    }
}

static void hold_table(verification *v, const glint_row *row)
{
    const expected_table *t = &v->s->expected;
    if (!v->s->has_expected_table || v->row >= t->csv.n_rows) return;
    for (int c = 0; c < t->n_columns; c++) {
        const csv_cell *cell = csv_at(&t->csv, (long)v->row, csv_column(&t->csv, t->columns[c]));
        expectation e = {.where = csv_place(&t->csv, cell),
                         .column = t->columns[c],
                         .absolute = t->absolute[c],
                         .relative = t->relative[c],
                         .source = ""};
        e.empty = cell->text[0] == '\0';
        if (!e.empty && !number_read(cell->text, strlen(cell->text), &e.value)) {
            v->verdict.expectations++;
            deviate(v, e.where, "column '%s' has '%.40s'; expected a number or nothing",
                    t->columns[c], cell->text);
            continue;
        }
        char label[64];
        snprintf(label, sizeof label, "row %lld", (long long)v->row);
        compare(v, row, v->table_column[c], &e, label);
    }
}

static bool is_selected(const verification *v, const requirement *r, const size_t *columns,
                        const glint_row *row)
{
    for (int k = 0; k < r->n_when; k++) {
        double value;
        if (!glint_curve_value(v->curve, row, columns[k], &value)) return false;
        if (value < r->when[k].lo || value > r->when[k].hi) return false;
    }
    return true;
}

static bool keep_excess(tally *t, double excess)
{
    if (!grow_list(&t->excess, &t->capacity, (size_t)t->selected + 1, sizeof *t->excess))
        return false;
    t->excess[t->selected] = excess;
    return true;
}

static void hold_requirements(verification *v, const glint_row *row)
{
    size_t at = 0;
    for (int i = 0; i < v->s->n_requirements; i++) {
        const requirement *r = &v->s->requirements[i];
        tally *t = &v->tallies[i];
        const bool selected = is_selected(v, r, v->when_column + at, row);
        at += (size_t)r->n_when;
        if (!selected) continue;
        double value, limit = r->fainter_than;
        if (r->has_reference) limit += 2.5 * log10(row->height_m / r->reference_height_m);
        const bool bright = glint_curve_value(v->curve, row, v->require_column[i], &value);
        if (!keep_excess(t, bright ? value - limit : HUGE_VAL)) {
            v->status = errors_no_memory(v->errors);
            return;
        }
        t->selected++;
        if (!bright || value > limit) { /* a dark satellite is fainter than anything */
            t->met++;
        } else if (!t->any_worst || value - limit < t->worst - t->worst_limit) {
            t->any_worst = true;
            t->worst = value;
            t->worst_limit = limit;
            t->worst_row = *row;
            t->worst_index = v->row;
        }
    }
}

static double met_fraction(const tally *t)
{
    return (double)t->met / (double)t->selected;
}

static bool is_broken(const verification *v, int i)
{
    const tally *t = &v->tallies[i];
    return t->selected > 0 && met_fraction(t) < v->s->requirements[i].for_fraction && t->any_worst;
}

static void name_surface(const glint_scenario *s, const glint_row *row, tally *t)
{
    const satellite *sat = &s->satellite;
    int largest = 0;
    for (int k = 1; k < sat->n_surfaces; k++)
        if (row->share_surface[k] > row->share_surface[largest]) largest = k;
    snprintf(t->surface, sizeof t->surface, "; %.0f %% of its light in %s comes from %s",
             100 * row->share_surface[largest], s->bands[0]->name, sat->surfaces[largest].name);
}

/* Runs up to the last row that breaks a requirement once more, with the surfaces told apart. What
 * fails here has not failed before, for lack of memory at most: then no surface is named. */
static void find_surfaces(verification *v)
{
    int64_t last = -1;
    for (int i = 0; i < v->s->n_requirements; i++)
        if (is_broken(v, i) && v->tallies[i].worst_index > last) last = v->tallies[i].worst_index;
    glint_scenario *s = NULL;
    glint_curve *curve = NULL;
    if (last < 0 ||
        scenario_read_surfaces(v->s->documents[0]->path, (const char *const *)v->s->overrides,
                               v->s->n_overrides, NULL, &s, NULL) ||
        glint_curve_open(s, glint_curve_threads(v->curve), &curve, NULL)) {
        glint_scenario_free(s);
        return;
    }
    const glint_row *rows;
    size_t n;
    for (int64_t first = 0; first <= last; first += (int64_t)n) {
        if (glint_curve_next(curve, &rows, &n, NULL) || n == 0) break;
        for (int i = 0; i < v->s->n_requirements; i++) {
            tally *t = &v->tallies[i];
            if (is_broken(v, i) && t->worst_index >= first && t->worst_index < first + (int64_t)n)
                name_surface(s, &rows[t->worst_index - first], t);
        }
    }
    glint_curve_close(curve);
    glint_scenario_free(s);
}

static int rising(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* By how much all rows may brighten (must fade, where negative) until a requirement is just met:
 * the excess of the row that is then the brightest of those that must be fainter. Sorts. */
static double margin_of(const requirement *r, tally *t)
{
    const double ROUNDED = 1e-9; /* of a fraction of rows that is a whole number */
    const int64_t needed = (int64_t)ceil(r->for_fraction * (double)t->selected - ROUNDED);
    qsort(t->excess, (size_t)t->selected, sizeof *t->excess, rising);
    return needed > 0 ? t->excess[t->selected - needed] : HUGE_VAL;
}

static void report_requirement(const requirement *r, tally *t, text *out)
{
    if (t->selected == 0) return;
    text_printf(out, "%s fainter than %g", r->column, r->fainter_than);
    if (r->has_reference) text_printf(out, " (at a height of %g km)", r->reference_height_m * 1e-3);
    text_printf(out, " in %.4g %% of %lld rows, required %.4g %%; ", 100 * met_fraction(t),
                (long long)t->selected, 100 * r->for_fraction);
    const double margin = margin_of(r, t);
    if (margin < HUGE_VAL)
        text_printf(out, "margin %s mag\n", number_signed(margin, 3).text);
    else
        text_add(out, "any brightness would do\n");
}

static void judge_requirements(verification *v)
{
    for (int i = 0; i < v->s->n_requirements; i++)
        report_requirement(&v->s->requirements[i], &v->tallies[i], &v->report);

    for (int i = 0; i < v->s->n_requirements; i++) {
        const requirement *r = &v->s->requirements[i];
        const tally *t = &v->tallies[i];
        v->verdict.expectations++;
        if (t->selected == 0) {
            deviate(v, r->where, "no row fits 'when', so the requirement says nothing");
            continue;
        }
        const bool several = v->s->n_observers > 1;
        const double fraction = met_fraction(t);
        if (fraction >= r->for_fraction) continue;
        char when[64];
        const glint_utc *u = &t->worst_row.utc;
        if (u->year)
            snprintf(when, sizeof when, "%04d-%02d-%02dT%02d:%02d:%02dZ", u->year, u->month, u->day,
                     u->hour, u->minute, u->second);
        else
            snprintf(when, sizeof when, "t_s = %.9g", t->worst_row.t_s);
        deviate(v, r->where,
                "%s is fainter than required in %.4g %% of %lld rows; expected %.4g %%; it breaks "
                "its limit of %s most at %s%s%s with %s%s",
                r->column, 100 * fraction, (long long)t->selected, 100 * r->for_fraction,
                number_fixed(t->worst_limit, 3).text, when, several ? " for " : "",
                several ? t->worst_row.observer : "", number_fixed(t->worst, 3).text, t->surface);
    }
}

static void judge_missing_rows(verification *v)
{
    for (int i = 0; i < v->s->n_expectations; i++) {
        const expectation *e = &v->s->expectations[i];
        if (v->met_row[i]) continue;
        v->verdict.expectations++;
        if (e->by_row)
            deviate(v, e->where, "there is no row %lld; the run has %lld rows", (long long)e->row,
                    (long long)v->row);
        else
            deviate(v, e->where, "there is no row at t_s = %.9g%s%s", e->t_s,
                    e->observer[0] ? " of " : "", e->observer);
    }
    if (v->s->has_expected_table && v->row != v->s->expected.csv.n_rows) {
        v->verdict.expectations++;
        deviate(v, v->s->expected.where, "the run has %lld rows; the expected table has %ld",
                (long long)v->row, v->s->expected.csv.n_rows);
    }
}

static glint_status hold_all(verification *v, glint_curve *curve)
{
    for (;;) {
        const glint_row *rows;
        size_t n;
        glint_error error;
        const glint_status status = glint_curve_next(curve, &rows, &n, &error);
        if (status) return errors_take(v->errors, &error, (place){v->s->documents[0]->path, 0, 0});
        if (n == 0) break;
        for (size_t k = 0; k < n; k++, v->row++) {
            hold_expectations(v, &rows[k]);
            hold_table(v, &rows[k]);
            hold_requirements(v, &rows[k]);
        }
    }
    judge_missing_rows(v);
    find_surfaces(v);
    judge_requirements(v);
    return v->status;
}

static glint_status verify_scenario(const glint_scenario *s, int threads, glint_verdict *verdict,
                                    glint_errors *errors)
{
    if (s->n_expectations == 0 && !s->has_expected_table && s->n_requirements == 0)
        return errors_add(errors, GLINT_INPUT, (place){s->documents[0]->path, 0, 0},
                          "nothing to verify: the scenario has no [[expect]], [expect_table] or "
                          "[[require]]");
    glint_curve *curve;
    glint_status status = glint_curve_open(s, threads, &curve, errors);
    if (status) return status;
    verification v = {.s = s, .curve = curve, .errors = errors};
    if (!allocate(&v)) {
        status = errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    } else {
        find_columns(&v);
        status = v.status ? v.status : hold_all(&v, curve);
    }
    if (v.report.failed && !status) status = errors_no_memory(errors);
    *verdict = v.verdict;
    if (v.report.failed || !v.report.data)
        text_free(&v.report);
    else
        verdict->requirements = v.report.data;
    release(&v);
    glint_curve_close(curve);
    return status;
}

glint_status glint_verify(const char *path, const char *const *overrides, size_t n_overrides,
                          int threads, glint_verdict *verdict, glint_errors *errors)
{
    glint_verdict own = {0};
    glint_scenario *s;
    glint_status status = glint_scenario_read(path, overrides, n_overrides, &s, errors);
    if (!status) status = verify_scenario(s, threads, &own, errors);
    glint_scenario_free(s);
    if (verdict)
        *verdict = own;
    else
        free(own.requirements);
    return status;
}
