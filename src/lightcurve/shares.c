/* shares.c: what gives the light: a run of the satellite, and one of it with changes, row by row
 * beside each other. */
#include "base/grow.h"
#include "base/text.h"
#include "lightcurve/facts.h"
#include "scenario/scenario.h"

#include <math.h>
#include <stdlib.h>

enum { N_KINDS = GLINT_SHARE_SURFACE + 1 };

/* Numbers that grow in count. */
typedef struct numbers {
    double *items; /* owned */
    size_t n, capacity;
} numbers;

/* What is summed up of one material, component or surface. */
typedef struct share_sum {
    double flux, peak, magnitude;
    int64_t rows, dominant;
} share_sum;

/* One run of the two. */
typedef struct shares_run {
    glint_scenario *s; /* owned */
    int n[N_KINDS];
    share_sum *sums[N_KINDS]; /* owned */
    double flux;              /* sum over the rows */
    numbers magnitudes;
    glint_shares_total whole;
} shares_run;

struct glint_shares {
    shares_run plain, changed;
    bool has_changes;
    numbers differences;
    glint_shares_change change;
    fact_list facts;
};

static bool numbers_add(numbers *list, double value)
{
    if (!grow_list(&list->items, &list->capacity, list->n + 1, sizeof *list->items)) return false;
    list->items[list->n++] = value;
    return true;
}

static int rising(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts the numbers; n > 0. */
static double median_of(numbers *list)
{
    qsort(list->items, list->n, sizeof *list->items, rising);
    return 0.5 * (list->items[(list->n - 1) / 2] + list->items[list->n / 2]);
}

static double mean_of(const numbers *list)
{
    double sum = 0;
    for (size_t k = 0; k < list->n; k++)
        sum += list->items[k];
    return sum / (double)list->n;
}

/* ------------------------------------------------------------------- rows */

static glint_status start_run(shares_run *run)
{
    const satellite *sat = &run->s->satellite;
    const int n[N_KINDS] = {sat->n_materials, sat->n_components, sat->n_surfaces};
    for (int kind = 0; kind < N_KINDS; kind++) {
        run->n[kind] = n[kind];
        run->sums[kind] = calloc((size_t)n[kind] + 1, sizeof *run->sums[kind]);
        if (!run->sums[kind]) return GLINT_INTERNAL;
    }
    run->whole.has_utc = !run->s->has_geometry;
    run->whole.band = run->s->bands[0]->name;
    return GLINT_OK;
}

static void free_run(shares_run *run)
{
    for (int kind = 0; kind < N_KINDS; kind++)
        free(run->sums[kind]);
    free(run->magnitudes.items);
    glint_scenario_free(run->s);
}

/* Adds the shares of one kind in one row that has light. */
static void add_kind(shares_run *run, int kind, const double *share, const glint_row *row,
                     bool is_peak)
{
    int largest = 0;
    for (int k = 0; k < run->n[kind]; k++) {
        share_sum *sum = &run->sums[kind][k];
        if (share[k] > share[largest]) largest = k;
        if (is_peak) sum->peak = share[k];
        if (!(share[k] > 0)) continue;
        sum->rows++;
        sum->flux += share[k] * row->flux_ratio[0];
        sum->magnitude += row->magnitude[0] - 2.5 * log10(share[k]);
    }
    run->sums[kind][largest].dominant++;
}

static bool add_row(shares_run *run, const glint_row *row)
{
    glint_shares_total *whole = &run->whole;
    whole->rows++;
    if (!(row->flux_ratio[0] > 0)) return true;
    const double mag = row->magnitude[0];
    const bool is_peak = whole->bright_rows == 0 || mag < whole->magnitude_peak;
    const double *share[N_KINDS] = {row->share_material, row->share_component, row->share_surface};
    if (is_peak) {
        whole->magnitude_peak = mag;
        whole->peak_t_s = row->t_s;
        whole->peak_utc = row->utc;
    }
    whole->bright_rows++;
    run->flux += row->flux_ratio[0];
    for (int kind = 0; kind < N_KINDS; kind++)
        add_kind(run, kind, share[kind], row, is_peak);
    return numbers_add(&run->magnitudes, mag);
}

/* A row of both. is_peak: the brightest so far of the one in the file. */
static bool add_difference(glint_shares *sh, const glint_row *plain, const glint_row *changed,
                           bool is_peak)
{
    glint_shares_change *c = &sh->change;
    const bool before = plain->flux_ratio[0] > 0, after = changed->flux_ratio[0] > 0;
    c->lost += before && !after;
    c->gained += after && !before;
    if (is_peak) c->has_peak = after;
    if (!before || !after) return true;
    const double difference = changed->magnitude[0] - plain->magnitude[0];
    if (is_peak) c->at_peak = difference;
    if (c->rows == 0 || difference < c->min) c->min = difference;
    if (c->rows == 0 || difference > c->max) c->max = difference;
    c->rows++;
    return numbers_add(&sh->differences, difference);
}

/* ------------------------------------------------------------------- runs */

/* A curve read row by row. */
typedef struct row_stream {
    glint_curve *curve; /* owned */
    const glint_row *rows;
    size_t n, at;
} row_stream;

/* *row is NULL at the end. */
static glint_status next_row(row_stream *stream, const glint_row **row, glint_error *error)
{
    *row = NULL;
    if (stream->at == stream->n) {
        const glint_status status =
            glint_curve_next(stream->curve, &stream->rows, &stream->n, error);
        stream->at = 0;
        if (status || stream->n == 0) return status;
    }
    *row = &stream->rows[stream->at++];
    return GLINT_OK;
}

/* Both give the same moments: what [output] rows lets through does not depend on the satellite. */
static glint_status pull_all(glint_shares *sh, row_stream *plain, row_stream *changed,
                             glint_progress *progress, void *context, glint_error *error)
{
    for (;;) {
        const glint_row *row, *other = NULL;
        const bool block_begins = plain->at == plain->n;
        glint_status status = next_row(plain, &row, error);
        if (!status && row && changed->curve) status = next_row(changed, &other, error);
        if (status || !row) return status;
        const bool is_peak =
            row->flux_ratio[0] > 0 && (sh->plain.whole.bright_rows == 0 ||
                                       row->magnitude[0] < sh->plain.whole.magnitude_peak);
        bool good = add_row(&sh->plain, row);
        if (other)
            good = good && add_row(&sh->changed, other) && add_difference(sh, row, other, is_peak);
        if (!good) return error_no_memory(error);
        if (block_begins && progress &&
            !progress(context, glint_curve_done(plain->curve), glint_curve_length(plain->curve)))
            return error_set(error, GLINT_OUTPUT, PLACE_NONE, "stopped before the end");
    }
}

static void finish_run(shares_run *run)
{
    if (run->magnitudes.n == 0) return;
    run->whole.magnitude_mean = mean_of(&run->magnitudes);
    run->whole.magnitude_median = median_of(&run->magnitudes);
}

static void finish(glint_shares *sh)
{
    finish_run(&sh->plain);
    finish_run(&sh->changed);
    if (sh->differences.n > 0) {
        sh->change.mean = mean_of(&sh->differences);
        sh->change.median = median_of(&sh->differences);
    }
    if (sh->plain.whole.bright_rows > 0 && sh->changed.whole.bright_rows > 0)
        sh->change.peak = sh->changed.whole.magnitude_peak - sh->plain.whole.magnitude_peak;
}

static glint_status run_both(glint_shares *sh, int threads, glint_progress *progress, void *context,
                             glint_errors *errors)
{
    row_stream plain = {0}, changed = {0};
    glint_status status = glint_curve_open(sh->plain.s, threads, &plain.curve, errors);
    if (!status && sh->has_changes)
        status = glint_curve_open(sh->changed.s, threads, &changed.curve, errors);
    if (!status) {
        glint_error error = {0};
        status = pull_all(sh, &plain, &changed, progress, context, &error);
        if (status) errors_take(errors, &error, PLACE_NONE);
    }
    glint_curve_close(plain.curve);
    glint_curve_close(changed.curve);
    if (!status) finish(sh);
    return status;
}

/* Reads the scenario with its changes. What it warns of has been said of the scenario without. */
static glint_status read_changed(const char *path, const char *const *overrides, size_t n,
                                 const glint_changes *changes, glint_shares *sh,
                                 glint_errors *errors)
{
    glint_errors *own = glint_errors_new();
    if (!own) return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    const glint_status status =
        scenario_read_surfaces(path, overrides, n, changes, &sh->changed.s, own);
    for (size_t k = 0; k < glint_errors_count(own); k++)
        if (glint_errors_get(own, k)->severity == GLINT_ERROR)
            errors_take(errors, glint_errors_get(own, k), PLACE_NONE);
    glint_errors_free(own);
    return status;
}

static void list_facts(glint_shares *sh, const glint_changes *changes)
{
    facts_of_run(sh->plain.s, &sh->facts);
    for (size_t k = 0; changes && k < changes->n_swaps; k++)
        fact_list_add(&sh->facts, "swap", "%s", changes->swaps[k]);
    for (size_t k = 0; changes && k < changes->n_without; k++)
        fact_list_add(&sh->facts, "without", "%s", changes->without[k]);
}

glint_status glint_shares_find(const char *path, const char *const *overrides, size_t n_overrides,
                               const glint_changes *changes, int threads, glint_progress *progress,
                               void *context, glint_shares **out, glint_errors *errors)
{
    *out = NULL;
    glint_shares *sh = calloc(1, sizeof *sh);
    if (!sh) return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    sh->has_changes = changes && (changes->n_swaps > 0 || changes->n_without > 0);
    glint_status status =
        scenario_read_surfaces(path, overrides, n_overrides, NULL, &sh->plain.s, errors);
    if (!status && sh->has_changes)
        status = read_changed(path, overrides, n_overrides, changes, sh, errors);
    if (!status && (start_run(&sh->plain) || (sh->has_changes && start_run(&sh->changed))))
        status = errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    if (!status) list_facts(sh, changes);
    if (!status && sh->facts.failed)
        status = errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    if (!status) status = run_both(sh, threads, progress, context, errors);
    if (status)
        glint_shares_free(sh);
    else
        *out = sh;
    return status;
}

void glint_shares_free(glint_shares *sh)
{
    if (!sh) return;
    free_run(&sh->plain);
    free_run(&sh->changed);
    free(sh->differences.items);
    fact_list_free(&sh->facts);
    free(sh);
}

/* ---------------------------------------------------------------- results */

/* Names and area of share k of a kind. */
static void describe(const satellite *sat, glint_share_kind kind, size_t k, glint_share *out)
{
    const model *m = &sat->model;
    *out = (glint_share){.kind = kind, .component = "", .material = "", .facing = ""};
    if (kind == GLINT_SHARE_MATERIAL) {
        out->name = out->material = sat->materials[k].name;
        out->area_m2 = model_material_area(m, (int)k, NULL);
    } else if (kind == GLINT_SHARE_COMPONENT) {
        out->name = out->component = sat->components[k].name;
        for (int s = 0; s < m->n_spans; s++)
            for (int j = 0; m->spans[s].component == (int)k && j < m->spans[s].n; j++)
                out->area_m2 += m->spans[s].facets.area[j];
    } else {
        const satellite_surface *surface = &sat->surfaces[k];
        out->name = surface->name;
        out->component = sat->components[surface->component].name;
        out->material = surface->material;
        out->facing = surface->facing;
        out->area_m2 = surface->area_m2;
    }
}

bool glint_shares_get(const glint_shares *sh, bool changed, glint_share_kind kind, size_t k,
                      glint_share *out)
{
    const shares_run *run = changed ? &sh->changed : &sh->plain;
    if ((changed && !sh->has_changes) || (int)kind < 0 || (int)kind >= N_KINDS ||
        k >= (size_t)run->n[kind])
        return false;
    const share_sum *sum = &run->sums[kind][k];
    describe(&run->s->satellite, kind, k, out);
    if (run->whole.bright_rows == 0) return true;
    out->share_mean = sum->flux / run->flux;
    out->share_peak = sum->peak;
    out->dominant_fraction = (double)sum->dominant / (double)run->whole.bright_rows;
    out->rows = sum->rows;
    if (sum->rows > 0) out->magnitude_mean = sum->magnitude / (double)sum->rows;
    return true;
}

bool glint_shares_whole(const glint_shares *sh, bool changed, glint_shares_total *out)
{
    if (changed && !sh->has_changes) return false;
    *out = changed ? sh->changed.whole : sh->plain.whole;
    return true;
}

bool glint_shares_difference(const glint_shares *sh, glint_shares_change *out)
{
    if (sh->has_changes) *out = sh->change;
    return sh->has_changes;
}

bool glint_shares_fact(const glint_shares *sh, size_t k, const char **key, const char **value)
{
    return fact_list_get(&sh->facts, k, key, value);
}

const glint_scenario *glint_shares_scenario(const glint_shares *sh, bool changed)
{
    return changed ? sh->changed.s : sh->plain.s; /* NULL without changes */
}
