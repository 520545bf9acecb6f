#include "lightcurve/exposure.h"

#include "base/constants.h"
#include "base/grow.h"
#include "base/kronrod.h"
#include "base/vec.h"
#include "brdf/sharpness.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A panel is a part of an exposure: its first moment and length, its error estimate, and its
 * integrals: of the flux in each band, then of the share of each material and component in the flux
 * of the first. */
enum { PANEL_FROM, PANEL_LENGTH, PANEL_ERROR, PANEL_SUMS };
enum { PAIR = 2, MOST_PANELS = 1 << 17 };

/* The samples of two panels in order: the beginning, the points of the one, those of the other, the
 * end. */
enum { FIRST_POINT = 1, SAMPLES = PAIR * KRONROD_POINTS + 2 };

_Static_assert((int)SAMPLES <= (int)TILE, "two panels fit into a tile");

static size_t count_sums(const glint_scenario *s)
{
    const model *m = &s->satellite.model;
    return (s->earth.wanted ? 2 : 1) * (size_t)s->n_bands + (size_t)m->n_materials +
           (size_t)m->n_components + (size_t)s->satellite.n_surfaces;
}

/* How far the Sun and the observer may move from sample to sample. */
static double find_largest_step(const glint_scenario *s)
{
    static const double BROAD = 5 * DEG; /* where all is diffuse: shadows, edges of bodies */
    /* of the Sun's radius: an image that is missed lies within 1/128 of it from the limb */
    static const double PART_OF_SUN = 0.25, PART_OF_LOBE = 0.5;
    const double sun = s->solar_disc == SOLAR_POINT ? 0 : asin(SUN_RADIUS_M / AU_M);
    const model *m = &s->satellite.model;
    double step = BROAD;
    for (int i = 0; i < m->n_materials; i++)
        for (int b = 0; b < s->n_bands; b++) {
            /* a lobe is passed through by twice the tilt of its normal */
            const double lobe = 2 * brdf_material_width(&m->materials[i].bands[b]);
            step = fmin(step, fmax(PART_OF_SUN * sun, PART_OF_LOBE * lobe));
        }
    return step;
}

glint_status exposure_worker_make(const glint_scenario *s, exposure_worker *out, glint_error *error)
{
    *out = (exposure_worker){.largest_step = find_largest_step(s)};
    return photometry_rows_make(s, TILE, &out->rows, error);
}

void exposure_worker_free(exposure_worker *e)
{
    photometry_rows_free(&e->rows);
    free(e->panels);
    free(e->stack);
    *e = (exposure_worker){0};
}

/* ------------------------------------------------------------------ samples */

/* One row's exposure. */
typedef struct exposure {
    const glint_scenario *s;
    const frame_grid *grid;
    tile_worker *w;
    exposure_worker *e;
    size_t n_sums;
} exposure;

/* Whether the Sun and the observer move little between the samples of a panel, in all components.
 */
static bool moves_little(const exposure *x, int panel)
{
    /* the square of the chord, on either side of which the sum of two motions may lie */
    const double limit = 0.5 * x->e->largest_step, most = limit * limit;
    for (int c = 0; c < x->s->satellite.n_components; c++) {
        const brdf_light *light = &x->w->lights[c];
        const int first = FIRST_POINT + panel * KRONROD_POINTS;
        for (int k = first + 1; k < first + KRONROD_POINTS; k++) {
            double sun = 0, observer = 0;
            for (int axis = 0; axis < 3; axis++) {
                const double di = light->i[axis][k] - light->i[axis][k - 1];
                const double dr = light->r[axis][k] - light->r[axis][k - 1];
                sun += di * di;
                observer += dr * dr;
            }
            if (sun > most || observer > most) return false;
        }
    }
    return true;
}

/* Panels whose points are no longer told apart in time are as good as can be. */
static bool is_tiny(const double *panel)
{
    return panel[PANEL_FROM] + 1e-3 * panel[PANEL_LENGTH] == panel[PANEL_FROM];
}

/* Kronrod's and Gauss's sums of one panel. */
static void sum_panel(const exposure *x, int which, double *panel)
{
    const model *m = &x->s->satellite.model;
    const int n_bands = x->s->n_bands;
    const double length = panel[PANEL_LENGTH];
    double *sums = panel + PANEL_SUMS, gauss[SCENARIO_MAX_BANDS] = {0};
    memset(sums, 0, x->n_sums * sizeof *sums);
    for (int k = 0; k < KRONROD_POINTS; k++) {
        const glint_row *row = &x->e->rows.rows[FIRST_POINT + which * KRONROD_POINTS + k];
        const double weight = length * KRONROD[k], first = weight * row->flux_ratio[0];
        for (int b = 0; b < n_bands; b++) {
            sums[b] += weight * row->flux_ratio[b];
            gauss[b] += length * KRONROD_GAUSS[k] * row->flux_ratio[b];
        }
        for (int i = 0; i < m->n_materials; i++)
            sums[n_bands + i] += first * row->share_material[i];
        for (int i = 0; i < m->n_components; i++)
            sums[n_bands + m->n_materials + i] += first * row->share_component[i];
        double *rest = sums + n_bands + m->n_materials + m->n_components;
        for (int i = 0; row->share_surface && i < x->s->satellite.n_surfaces; i++)
            rest[i] += first * row->share_surface[i];
        for (int b = 0; row->earthshine_flux_ratio && b < n_bands; b++)
            rest[x->s->satellite.n_surfaces + b] += weight * row->earthshine_flux_ratio[b];
    }
    panel[PANEL_ERROR] = 0;
    for (int b = 0; b < n_bands; b++)
        panel[PANEL_ERROR] = fmax(panel[PANEL_ERROR], fabs(sums[b] - gauss[b]));
}

/* Whether there is light on both sides of the beginning and the end of a panel, or on neither.
 * Light that begins or ends there, as at the horizon, is seen by no point of the panel. */
static bool has_whole_ends(const exposure *x, int panel)
{
    const glint_row *rows = x->e->rows.rows + panel * KRONROD_POINTS;
    for (int end = 0; end < 2; end++, rows += KRONROD_POINTS)
        for (int b = 0; b < x->s->n_bands; b++)
            if ((rows[0].flux_ratio[b] > 0) != (rows[1].flux_ratio[b] > 0)) return false;
    return true;
}

/* Samples the two halves of a part of the exposure. resolved: whether motion between samples is
 * small in each, and no light begins or ends between them and their ends; only then are there sums.
 */
static glint_status sample_halves(const exposure *x, double from_s, double length_s,
                                  double *halves[PAIR], bool resolved[PAIR], glint_error *error)
{
    double t_s[SAMPLES];
    t_s[0] = from_s;
    t_s[SAMPLES - 1] = from_s + length_s;
    for (int h = 0; h < PAIR; h++) {
        halves[h][PANEL_LENGTH] = 0.5 * length_s;
        halves[h][PANEL_FROM] = from_s + h * 0.5 * length_s;
        for (int k = 0; k < KRONROD_POINTS; k++)
            t_s[FIRST_POINT + h * KRONROD_POINTS + k] =
                halves[h][PANEL_FROM] + halves[h][PANEL_LENGTH] * KRONROD_NODES[k];
    }
    tile_worker *w = x->w;
    glint_status status =
        geometry_fill_at(x->s, x->grid, 0, t_s, SAMPLES, &w->geometry, &w->tile, w->lights, error);
    if (status) return status;
    for (int h = 0; h < PAIR; h++)
        resolved[h] = moves_little(x, h);
    if (!resolved[0] && !resolved[1]) return GLINT_OK;
    status = tile_worker_sum(x->s, w, &x->e->rows, error);
    for (int h = 0; h < PAIR && !status; h++) {
        if (resolved[h]) sum_panel(x, h, halves[h]);
        resolved[h] = resolved[h] && (is_tiny(halves[h]) || has_whole_ends(x, h));
    }
    return status;
}

/* ------------------------------------------------------------------ panels */

/* Makes room for more doubles in an owned array. */
static glint_status grow(double **array, size_t needed, size_t *capacity, glint_error *error)
{
    return grow_list(array, capacity, needed, sizeof **array) ? GLINT_OK : error_no_memory(error);
}

static glint_status push(exposure_worker *e, double from_s, double length_s, glint_error *error)
{
    const glint_status status = grow(&e->stack, 2 * (e->n_stack + 1), &e->stack_capacity, error);
    if (status) return status;
    e->stack[2 * e->n_stack] = from_s;
    e->stack[2 * e->n_stack++ + 1] = length_s;
    return GLINT_OK;
}

static double *panel_at(const exposure *x, size_t k)
{
    return x->e->panels + k * (PANEL_SUMS + x->n_sums);
}

/* Halves what is on the stack until `good` parts remain, and appends those to the panels.
 * most_error: largest error of a panel; HUGE_VAL: small motion is enough. */
static glint_status halve(const exposure *x, double most_error, glint_error *error)
{
    exposure_worker *e = x->e;
    const size_t width = PANEL_SUMS + x->n_sums;
    while (e->n_stack > 0) {
        if (e->n_panels + e->n_stack + PAIR > MOST_PANELS)
            return error_set(error, GLINT_INPUT, PLACE_NONE,
                             "the satellite turns too fast for its light to be averaged: more than "
                             "%d parts of one exposure; expected a shorter exposure_s, or slower "
                             "turns",
                             (int)MOST_PANELS);
        glint_status status =
            grow(&e->panels, (e->n_panels + PAIR) * width, &e->panel_capacity, error);
        if (status) return status;
        e->n_stack--;
        const double from_s = e->stack[2 * e->n_stack], length_s = e->stack[2 * e->n_stack + 1];
        double *halves[PAIR] = {panel_at(x, e->n_panels), panel_at(x, e->n_panels + 1)};
        bool resolved[PAIR];
        status = sample_halves(x, from_s, length_s, halves, resolved, error);
        if (status) return status;
        /* the later one first, so that the earlier one is halved next */
        for (int h = PAIR - 1; h >= 0 && !status; h--) {
            const double *half = halves[h];
            if (resolved[h] && (half[PANEL_ERROR] <= most_error || is_tiny(half))) continue;
            status = push(e, half[PANEL_FROM], half[PANEL_LENGTH], error);
            resolved[h] = false;
        }
        if (status) return status;
        if (resolved[1] && !resolved[0]) memcpy(halves[0], halves[1], width * sizeof **halves);
        e->n_panels += (size_t)resolved[0] + (size_t)resolved[1];
    }
    return GLINT_OK;
}

/* Largest integral among the bands. */
static double largest_flux(const exposure *x)
{
    double largest = 0;
    for (int b = 0; b < x->s->n_bands; b++) {
        double sum = 0;
        for (size_t k = 0; k < x->e->n_panels; k++)
            sum += panel_at(x, k)[PANEL_SUMS + b];
        largest = fmax(largest, sum);
    }
    return largest;
}

/* Replaces panels whose error is too large by finer ones. */
static glint_status refine(const exposure *x, glint_error *error)
{
    exposure_worker *e = x->e;
    const size_t width = PANEL_SUMS + x->n_sums;
    const double most_error = EXPOSURE_TOLERANCE * largest_flux(x);
    const size_t n = e->n_panels;
    size_t kept = 0;
    for (size_t k = 0; k < n; k++) {
        const double *panel = panel_at(x, k);
        if (panel[PANEL_ERROR] > most_error) {
            const glint_status status = push(e, panel[PANEL_FROM], panel[PANEL_LENGTH], error);
            if (status) return status;
        } else if (kept++ != k) {
            memmove(panel_at(x, kept - 1), panel, width * sizeof *panel);
        }
    }
    e->n_panels = kept;
    return halve(x, most_error, error);
}

/* -------------------------------------------------------------------- rows */

/* Puts means in the place of what row k holds. */
static void replace_row(const exposure *x, double *sums, int k, const photometry_rows *rows)
{
    const glint_scenario *s = x->s;
    const model *m = &s->satellite.model;
    glint_row *row = &rows->rows[k];
    double *flux = rows->flux_ratio + k * s->n_bands, *magnitude = rows->magnitude + k * s->n_bands;
    double *material = rows->share_material + k * m->n_materials;
    double *component = rows->share_component + k * m->n_components;
    bool bright = false;
    const double airmass = airmass_of_light(s, row);
    for (int b = 0; b < s->n_bands; b++) {
        flux[b] = sums[b] / s->exposure_s;
        bright = bright || flux[b] > 0;
        magnitude[b] = flux[b] > 0
                           ? magnitude_of(flux[b], s->sun_magnitude[b]) + s->extinction[b] * airmass
                           : 0;
    }
    for (int i = 0; i < m->n_materials; i++)
        material[i] = sums[0] > 0 ? sums[s->n_bands + i] / sums[0] : 0;
    for (int i = 0; i < m->n_components; i++)
        component[i] = sums[0] > 0 ? sums[s->n_bands + m->n_materials + i] / sums[0] : 0;
    const int n_surfaces = s->satellite.n_surfaces;
    const double *rest = sums + s->n_bands + m->n_materials + m->n_components;
    for (int i = 0; rows->share_surface && i < n_surfaces; i++)
        rows->share_surface[k * n_surfaces + i] = sums[0] > 0 ? rest[i] / sums[0] : 0;
    for (int b = 0; rows->earthshine && b < s->n_bands; b++)
        rows->earthshine[k * s->n_bands + b] = rest[n_surfaces + b] / s->exposure_s;
    row->flags &= ~(unsigned)GLINT_DARK;
    if (!bright && !(row->flags & (GLINT_BELOW_HORIZON | GLINT_BLOCKED | GLINT_UMBRA)))
        row->flags |= GLINT_DARK;
}

glint_status exposure_average(const glint_scenario *s, const frame_grid *grid, tile_worker *w,
                              exposure_worker *e, int n, const photometry_rows *rows,
                              glint_error *error)
{
    const exposure x = {s, grid, w, e, count_sums(s)};
    const size_t n_sums = x.n_sums;
    for (int k = 0; k < n; k++) {
        e->n_panels = e->n_stack = 0;
        const double t_s = rows->rows[k].t_s;
        glint_status status = push(e, t_s - 0.5 * s->exposure_s, s->exposure_s, error);
        if (!status) status = halve(&x, HUGE_VAL, error);
        if (!status) status = refine(&x, error);
        if (!status) status = grow(&e->stack, n_sums, &e->stack_capacity, error);
        if (status) return status;
        double *sums = e->stack;
        memset(sums, 0, n_sums * sizeof *sums);
        for (size_t p = 0; p < e->n_panels; p++)
            for (size_t i = 0; i < n_sums; i++)
                sums[i] += panel_at(&x, p)[PANEL_SUMS + i];
        replace_row(&x, sums, k, rows);
    }
    return GLINT_OK;
}
