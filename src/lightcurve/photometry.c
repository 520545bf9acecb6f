#include "lightcurve/photometry.h"

#include "base/constants.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double airmass_kasten_young(double elevation)
{
    if (elevation < 0) return 0;
    const double deg = elevation / DEG;
    return 1 / (sin(elevation) + 0.50572 * pow(deg + 6.07995, -1.6364));
}

double airmass_pickering(double elevation)
{
    if (elevation < 0) return 0;
    const double deg = elevation / DEG;
    return 1 / sin((deg + 244 / (165 + 47 * pow(deg, 1.1))) * DEG);
}

double airmass_of(const glint_scenario *s, double elevation)
{
    return s->airmass == AIRMASS_PICKERING ? airmass_pickering(elevation)
                                           : airmass_kasten_young(elevation);
}

/* sin p + (pi - p) cos p without the loss of digits near pi: sin q - q cos q, q = pi - p. */
static double lambert_sphere(double phase_angle)
{
    static const double SMALL = 0.02; /* rad: the third term left out is 2e-13 of the first */
    const double q = PI - phase_angle, q2 = q * q;
    if (q < SMALL) return q * q2 / 3 * (1 - q2 / 10 + q2 * q2 / 280);
    return sin(q) - q * cos(q);
}

double magnitude_to_standard(double range_m, double phase_angle, double standard_phase)
{
    static const double STANDARD_M = 1e6;
    const double phase = lambert_sphere(phase_angle) / lambert_sphere(standard_phase);
    return 2.5 * log10(phase) - 5 * log10(range_m / STANDARD_M);
}

double magnitude_of(double flux_ratio, double sun_magnitude)
{
    return sun_magnitude - 2.5 * log10(flux_ratio);
}

/* Shares of the first band's sum by material and by component, lane k; total > 0. */
static void fill_shares(const model *m, const double *x, int k, double total,
                        double *share_material, double *share_component)
{
    for (int span = 0; span < m->n_spans; span++) {
        const double part = x[(size_t)span * TILE + (size_t)k];
        share_material[m->spans[span].material] += part;
        share_component[m->spans[span].component] += part;
    }
    for (int i = 0; i < m->n_materials; i++)
        share_material[i] /= total;
    for (int i = 0; i < m->n_components; i++)
        share_component[i] /= total;
}

/* Sum over all spans of one band, lane k, m^2/sr. */
static double total_of(const model *m, const double *x, int band, int k)
{
    double total = 0;
    for (int span = 0; span < m->n_spans; span++)
        total += x[((size_t)band * (size_t)m->n_spans + (size_t)span) * TILE + (size_t)k];
    return total;
}

glint_status photometry_rows_make(const glint_scenario *s, size_t n, photometry_rows *out,
                                  glint_error *error)
{
    const model *m = &s->satellite.model;
    *out =
        (photometry_rows){.rows = calloc(n, sizeof *out->rows),
                          .flux_ratio = calloc(n * (size_t)s->n_bands, sizeof(double)),
                          .magnitude = calloc(n * (size_t)s->n_bands, sizeof(double)),
                          .share_material = calloc(n * (size_t)m->n_materials, sizeof(double)),
                          .share_component = calloc(n * (size_t)m->n_components, sizeof(double))};
    if (out->rows && out->flux_ratio && out->magnitude && out->share_material &&
        out->share_component)
        return GLINT_OK;
    return error_no_memory(error);
}

void photometry_rows_free(photometry_rows *rows)
{
    free(rows->rows);
    free(rows->flux_ratio);
    free(rows->magnitude);
    free(rows->share_material);
    free(rows->share_component);
    *rows = (photometry_rows){0};
}

static unsigned flags_of(const glint_scenario *s, const tile_geometry *g, int k, bool bright)
{
    const bool at_site = g->who && g->who->kind == OBSERVER_SITE;
    unsigned flags = 0;
    if (!g->seen[k]) flags |= at_site ? GLINT_BELOW_HORIZON : GLINT_BLOCKED;
    if (!(g->sunlit[k] > 0))
        flags |= GLINT_UMBRA;
    else if (g->sunlit[k] < 1)
        flags |= GLINT_PENUMBRA;
    if (!flags || flags == GLINT_PENUMBRA) flags |= bright ? 0 : GLINT_DARK;
    if (at_site && g->sun_elevation[k] < s->sun_elevation_max) flags |= GLINT_SITE_DARK;
    if (g->moon_covers[k]) flags |= GLINT_MOON_SHADOW;
    return flags;
}

/* What a row says of time, places and directions; the rest of it is 0. */
static void fill_place(const glint_scenario *s, const tile_geometry *g, int k, glint_row *out)
{
    *out = (glint_row){.t_s = g->t_s[k],
                       .range_m = g->range_m[k],
                       .phase_angle_rad = g->phase_angle[k],
                       .sunlit_fraction = g->sunlit[k],
                       .azimuth_rad = g->azimuth[k],
                       .elevation_rad = g->elevation[k],
                       .sun_elevation_rad = g->sun_elevation[k],
                       .height_m = g->height_m[k],
                       .angular_rate_rad_s = g->angular_rate[k],
                       .site_height_m =
                           g->who && g->who->kind == OBSERVER_SITE ? g->who->site.height_m : 0,
                       .has_site = g->who && g->who->kind == OBSERVER_SITE,
                       .observer = g->who ? g->who->name : ""};
    if (!s->has_geometry) run_clock_utc(&s->clock, g->t_s[k], &out->utc);
    if (!s->moon_columns) return;
    out->moon_azimuth_rad = g->moon_azimuth[k];
    out->moon_elevation_rad = g->moon_elevation[k];
    out->moon_separation_rad = g->moon_separation[k];
    out->moon_illuminated = g->moon_illuminated[k];
}

void photometry_fill(const glint_scenario *s, const tile_geometry *g, const double *x,
                     const photometry_rows *out)
{
    const model *m = &s->satellite.model;
    const bool at_site = g->who && g->who->kind == OBSERVER_SITE;
    for (int k = 0; k < g->n; k++) {
        const size_t row = (size_t)k;
        double *flux = out->flux_ratio + row * (size_t)s->n_bands;
        double *magnitude = out->magnitude + row * (size_t)s->n_bands;
        double *material = out->share_material + row * (size_t)m->n_materials;
        double *component = out->share_component + row * (size_t)m->n_components;
        memset(material, 0, (size_t)m->n_materials * sizeof *material);
        memset(component, 0, (size_t)m->n_components * sizeof *component);
        const double airmass = at_site ? airmass_of(s, g->elevation[k]) : 0;
        const double weight =
            x && g->seen[k] ? g->sun_weight[k] / (g->range_m[k] * g->range_m[k]) : 0;
        bool bright = false;
        for (int b = 0; b < s->n_bands; b++) {
            const double total = weight > 0 ? total_of(m, x, b, k) : 0;
            flux[b] = total > 0 ? weight * total : 0;
            magnitude[b] = 0;
            bright |= flux[b] > 0;
            if (flux[b] > 0)
                magnitude[b] =
                    magnitude_of(flux[b], s->sun_magnitude[b]) + s->extinction[b] * airmass;
            if (b == 0 && flux[0] > 0 && s->shares)
                fill_shares(m, x, k, total, material, component);
        }
        glint_row *r = &out->rows[k];
        fill_place(s, g, k, r);
        r->airmass = airmass;
        r->flux_ratio = flux;
        r->magnitude = magnitude;
        r->share_material = material;
        r->share_component = component;
        r->flags = flags_of(s, g, k, bright);
    }
}
