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

double airmass_of_light(const glint_scenario *s, const glint_row *row)
{
    const bool below = row->flags & GLINT_BELOW_HORIZON && row->elevation_rad < 0;
    return below ? airmass_of(s, 0) : row->airmass;
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

/* What reaches the observer in lane k: the sums of the sources, each with its weight. */
typedef struct lane_light {
    const model *m;
    const double *sun, *earth; /* NULL: none */
    double sun_weight, earth_weight;
    int k;
} lane_light;

/* Flux ratio of one span in one band. */
static double span_flux(const lane_light *l, int band, int span)
{
    const size_t at = ((size_t)band * (size_t)l->m->n_spans + (size_t)span) * TILE + (size_t)l->k;
    double flux = 0;
    if (l->sun) flux += l->sun_weight * l->sun[at];
    if (l->earth) flux += l->earth_weight * l->earth[at];
    return fmax(flux, 0);
}

/* What one row's shares go to: n_materials, n_components, n_surfaces (or NULL). */
typedef struct row_shares {
    double *material, *component, *surface;
} row_shares;

static row_shares start_shares(const satellite *sat, const photometry_rows *out, size_t row)
{
    const size_t n_materials = (size_t)sat->model.n_materials;
    const size_t n_components = (size_t)sat->model.n_components;
    const size_t n_surfaces = (size_t)sat->n_surfaces;
    const row_shares to = {out->share_material + row * n_materials,
                           out->share_component + row * n_components,
                           out->share_surface ? out->share_surface + row * n_surfaces : NULL};
    memset(to.material, 0, n_materials * sizeof *to.material);
    memset(to.component, 0, n_components * sizeof *to.component);
    if (to.surface) memset(to.surface, 0, n_surfaces * sizeof *to.surface);
    return to;
}

/* Shares of the first band's flux by material, component and surface. */
static void fill_shares(const satellite *sat, const lane_light *l, row_shares to)
{
    const model *m = l->m;
    double total = 0;
    for (int span = 0; span < m->n_spans; span++) {
        const double part = span_flux(l, 0, span);
        to.material[m->spans[span].material] += part;
        to.component[m->spans[span].component] += part;
        if (to.surface) to.surface[m->spans[span].part] += part;
        total += part;
    }
    for (int i = 0; i < m->n_materials; i++)
        to.material[i] /= total;
    for (int i = 0; i < m->n_components; i++)
        to.component[i] /= total;
    for (int i = 0; to.surface && i < sat->n_surfaces; i++)
        to.surface[i] /= total;
}

/* Weight times the sum over all spans of one band, at least 0; sums: of one source, or NULL. */
static double source_flux(const lane_light *l, const double *sums, double weight, int band)
{
    if (!sums) return 0;
    double total = 0;
    for (int span = 0; span < l->m->n_spans; span++)
        total += sums[((size_t)band * (size_t)l->m->n_spans + (size_t)span) * TILE + (size_t)l->k];
    return total > 0 ? weight * total : 0;
}

glint_status photometry_rows_make(const glint_scenario *s, size_t n, photometry_rows *out,
                                  glint_error *error)
{
    const model *m = &s->satellite.model;
    const size_t n_bands = (size_t)s->n_bands, n_surfaces = (size_t)s->satellite.n_surfaces;
    *out =
        (photometry_rows){.rows = calloc(n, sizeof *out->rows),
                          .flux_ratio = calloc(n * n_bands, sizeof(double)),
                          .magnitude = calloc(n * n_bands, sizeof(double)),
                          .share_material = calloc(n * (size_t)m->n_materials, sizeof(double)),
                          .share_component = calloc(n * (size_t)m->n_components, sizeof(double))};
    if (n_surfaces) out->share_surface = calloc(n * n_surfaces, sizeof(double));
    if (s->earth.wanted) out->earthshine = calloc(n * n_bands, sizeof(double));
    if (out->rows && out->flux_ratio && out->magnitude && out->share_material &&
        out->share_component && (out->share_surface || !n_surfaces) &&
        (out->earthshine || !s->earth.wanted))
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
    free(rows->share_surface);
    free(rows->earthshine);
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

void photometry_fill(const glint_scenario *s, const tile_geometry *g, const double *sun,
                     const double *earth, const photometry_rows *out)
{
    const model *m = &s->satellite.model;
    const bool at_site = g->who && g->who->kind == OBSERVER_SITE;
    for (int k = 0; k < g->n; k++) {
        const size_t row = (size_t)k;
        double *flux = out->flux_ratio + row * (size_t)s->n_bands;
        double *magnitude = out->magnitude + row * (size_t)s->n_bands;
        const row_shares shares = start_shares(&s->satellite, out, row);
        double *earthshine = out->earthshine ? out->earthshine + row * (size_t)s->n_bands : NULL;
        const double airmass = at_site ? airmass_of(s, g->elevation[k]) : 0;
        const double square = g->range_m[k] * g->range_m[k];
        const lane_light light = {.m = m,
                                  .sun = g->seen[k] && g->sun_weight[k] > 0 ? sun : NULL,
                                  .earth = g->seen[k] ? earth : NULL,
                                  .sun_weight = g->sun_weight[k] / square,
                                  .earth_weight = 1 / square,
                                  .k = k};
        bool bright = false;
        for (int b = 0; b < s->n_bands; b++) {
            const double from_earth = source_flux(&light, light.earth, light.earth_weight, b);
            flux[b] = source_flux(&light, light.sun, light.sun_weight, b) + from_earth;
            if (earthshine) earthshine[b] = from_earth;
            magnitude[b] = 0;
            bright |= flux[b] > 0;
            if (flux[b] > 0)
                magnitude[b] =
                    magnitude_of(flux[b], s->sun_magnitude[b]) + s->extinction[b] * airmass;
            if (b == 0 && flux[0] > 0 && s->shares) fill_shares(&s->satellite, &light, shares);
        }
        glint_row *r = &out->rows[k];
        fill_place(s, g, k, r);
        r->airmass = airmass;
        r->flux_ratio = flux;
        r->magnitude = magnitude;
        r->share_material = shares.material;
        r->share_component = shares.component;
        r->share_surface = shares.surface;
        r->earthshine_flux_ratio = earthshine;
        r->flags = flags_of(s, g, k, bright);
    }
}
