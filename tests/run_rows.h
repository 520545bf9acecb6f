/* run_rows.h: all rows of a run at once. */
#ifndef GLINT_RUN_ROWS_H
#define GLINT_RUN_ROWS_H

#include "scenario/scenario.h"
#include "scenario_text.h"

/* All rows of a run, copied: their numbers lie in `numbers`. */
typedef struct run_rows {
    glint_row *rows;
    double *numbers; /* per row: bands x (flux ratio, magnitude), materials, components, and the
                        bands of the earthshine where there is any */
    size_t n, n_bands, n_materials, n_components, n_earth, n_blocks;
} run_rows;

static inline size_t rows_width(const run_rows *r)
{
    return 2 * r->n_bands + r->n_materials + r->n_components + r->n_earth;
}

static inline void rows_free(run_rows *r)
{
    free(r->rows);
    free(r->numbers);
}

static inline void copy_row(const glint_row *row, run_rows *out)
{
    double *to = out->numbers + out->n * rows_width(out);
    glint_row *copy = &out->rows[out->n++];
    *copy = *row;
    memcpy(to, row->flux_ratio, out->n_bands * sizeof *to);
    copy->flux_ratio = to, to += out->n_bands;
    memcpy(to, row->magnitude, out->n_bands * sizeof *to);
    copy->magnitude = to, to += out->n_bands;
    memcpy(to, row->share_material, out->n_materials * sizeof *to);
    copy->share_material = to, to += out->n_materials;
    memcpy(to, row->share_component, out->n_components * sizeof *to);
    copy->share_component = to, to += out->n_components;
    copy->share_surface = NULL;
    if (out->n_earth) memcpy(to, row->earthshine_flux_ratio, out->n_earth * sizeof *to);
    copy->earthshine_flux_ratio = out->n_earth ? to : NULL;
}

/* Runs a scenario; rows_free ends it. */
static inline run_rows run(const glint_scenario *s, int threads)
{
    glint_curve *curve;
    glint_errors *errors = glint_errors_new();
    ck_assert_msg(glint_curve_open(s, threads, &curve, errors) == GLINT_OK, "%s",
                  list_errors(errors));
    glint_errors_free(errors);
    const size_t most = (size_t)glint_curve_length(curve);
    run_rows out = {.n_bands = (size_t)s->n_bands,
                    .n_materials = (size_t)s->satellite.model.n_materials,
                    .n_components = (size_t)s->satellite.model.n_components,
                    .n_earth = s->earth.wanted ? (size_t)s->n_bands : 0};
    out.rows = calloc(most, sizeof *out.rows);
    out.numbers = calloc(most * rows_width(&out), sizeof *out.numbers);
    const glint_row *rows;
    glint_error error;
    for (size_t n = 1; n > 0;) {
        ck_assert_msg(glint_curve_next(curve, &rows, &n, &error) == GLINT_OK, "%s", error.message);
        ck_assert_uint_le(out.n + n, most);
        out.n_blocks += n > 0;
        for (size_t k = 0; k < n; k++)
            copy_row(&rows[k], &out);
    }
    ck_assert_int_eq(glint_curve_done(curve), (int64_t)most);
    glint_curve_close(curve);
    return out;
}

/* Reads a scenario with one part replaced and runs it. */
static inline run_rows run_with(const char *const parts[N_PARTS], enum part part,
                                const char *content)
{
    glint_scenario *s = read_with(parts, part, content);
    const run_rows out = run(s, 1);
    glint_scenario_free(s);
    return out;
}

#endif
