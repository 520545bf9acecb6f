#include "lightcurve/columns.h"

#include "base/constants.h"
#include "base/text.h"
#include "lightcurve/noise.h"
#include "lightcurve/photometry.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_text(column_kind kind)
{
    return kind == COLUMN_OBSERVER || kind == COLUMN_UTC || kind == COLUMN_FLAGS;
}

/* Adds a column whose name is `name` and `rest` put together. */
static bool add(column_set *set, column_kind kind, int index, const char *name, const char *rest,
                const char *unit, const char *description)
{
    const size_t n = set->n;
    char *whole = malloc(strlen(name) + strlen(rest) + 1);
    if (!whole) return false;
    strcpy(whole, name);
    strcat(whole, rest);
    set->names[n] = whole;
    set->kinds[n] = kind;
    set->indices[n] = index;
    set->columns[n] = (glint_column){whole, unit, description, is_text(kind)};
    set->n++;
    return true;
}

static bool add_bands(const glint_scenario *s, column_set *set)
{
    bool good = true;
    for (int b = 0; b < s->n_bands; b++)
        good = good && add(set, COLUMN_MAGNITUDE, b, "mag_", s->bands[b]->name, "mag",
                           "apparent magnitude; empty when dark");
    for (int b = 0; b < s->n_bands; b++)
        good = good && add(set, COLUMN_FLUX, b, "flux_ratio_", s->bands[b]->name, "",
                           "irradiance at the observer over the Sun's at 1 au, no extinction");
    for (int b = 0; s->earth.wanted && b < s->n_bands; b++)
        good = good && add(set, COLUMN_EARTHSHINE, b, "earthshine_flux_ratio_", s->bands[b]->name,
                           "", "the part of flux_ratio that came by way of the Earth");
    return good;
}

/* Magnitudes at 1000 km, where they are asked for. */
static bool add_standard(const glint_scenario *s, column_set *set)
{
#define DIFFUSE "no extinction; taken to 1000 km, and as a diffuse sphere's to a phase angle of "
    bool good = true;
    for (int b = 0; s->standard & STANDARD_PHASE_90 && b < s->n_bands; b++)
        good = good && add(set, COLUMN_STANDARD_90, b, "mag_std_1000km_phase90_", s->bands[b]->name,
                           "mag", DIFFUSE "90 deg");
    for (int b = 0; s->standard & STANDARD_PHASE_0 && b < s->n_bands; b++)
        good = good && add(set, COLUMN_STANDARD_0, b, "mag_std_1000km_phase0_", s->bands[b]->name,
                           "mag", DIFFUSE "0");
    return good;
#undef DIFFUSE
}

/* What the telescope makes of it. */
static bool add_telescope(const glint_scenario *s, column_set *set)
{
    bool good = true;
    if (!s->has_telescope) return true;
    for (int b = 0; b < s->n_bands; b++)
        good = good && add(set, COLUMN_SIGMA, b, "sigma_mag_", s->bands[b]->name, "mag",
                           "standard deviation of one exposure's magnitude; empty when dark");
    for (int b = 0; b < s->n_bands; b++)
        good = good && add(set, COLUMN_SNR, b, "snr_", s->bands[b]->name, "",
                           "signal to noise of one exposure; empty when dark");
    return good && add(set, COLUMN_ANGULAR_RATE, 0, "angular_rate_arcsec_s", "", "arcsec/s",
                       "of the satellite against the stars, from the observer");
}

/* Sites among the observers, and those that have refraction. */
static void count_sites(const glint_scenario *s, int *sites, int *refracted)
{
    *sites = *refracted = 0;
    for (int i = 0; i < s->n_observers; i++) {
        *sites += s->observers[i].kind == OBSERVER_SITE;
        *refracted += s->observers[i].kind == OBSERVER_SITE && s->observers[i].air.on;
    }
}

static bool add_site(const glint_scenario *s, column_set *set)
{
    int sites, refracted;
    count_sites(s, &sites, &refracted);
    if (sites == 0) return true;
    return add(set, COLUMN_AZIMUTH, 0, "azimuth_deg", "", "deg", "from north through east") &&
           add(set, COLUMN_ELEVATION, 0, "elevation_deg", "", "deg",
               refracted == 0       ? "geometric"
               : refracted == sites ? "apparent: with refraction"
                                    : "geometric; apparent for the sites that have refraction") &&
           add(set, COLUMN_SUN_ELEVATION, 0, "sun_elevation_deg", "", "deg",
               "of the Sun at the site, geometric") &&
           add(set, COLUMN_AIRMASS, 0, "airmass", "", "",
               s->airmass == AIRMASS_PICKERING ? "Pickering 2002; empty below the horizon"
                                               : "Kasten and Young 1989; empty below the horizon");
}

static bool add_moon(const glint_scenario *s, column_set *set)
{
    int sites, refracted;
    count_sites(s, &sites, &refracted);
    if (!s->moon_columns) return true;
    bool good = true;
    if (sites > 0)
        good = add(set, COLUMN_MOON_AZIMUTH, 0, "moon_azimuth_deg", "", "deg",
                   "of the Moon at the site, from north through east") &&
               add(set, COLUMN_MOON_ELEVATION, 0, "moon_elevation_deg", "", "deg",
                   "of the Moon's centre at the site, geometric");
    return good &&
           add(set, COLUMN_MOON_SEPARATION, 0, "moon_separation_deg", "", "deg",
               "between satellite and Moon, from the observer") &&
           add(set, COLUMN_MOON_ILLUMINATED, 0, "moon_illuminated", "", "",
               "fraction of the Moon's disc, from the observer: 0 is new, 1 full");
}

static bool add_shares(const glint_scenario *s, column_set *set)
{
    const model *m = &s->satellite.model;
    bool good = true;
    for (int i = 0; s->shares & SHARES_MATERIAL && i < m->n_materials; i++)
        good = good && add(set, COLUMN_SHARE_MATERIAL, i, "share_material_", m->materials[i].name,
                           "", "share of the first band's flux; empty when dark");
    for (int i = 0; s->shares & SHARES_COMPONENT && i < m->n_components; i++)
        good = good &&
               add(set, COLUMN_SHARE_COMPONENT, i, "share_component_", m->components[i].name, "",
                   "share of the first band's flux, without the component's children; empty when "
                   "dark");
    for (int i = 0; i < s->satellite.n_surfaces; i++)
        good = good &&
               add(set, COLUMN_SHARE_SURFACE, i, "share_surface_", s->satellite.surfaces[i].name,
                   "", "share of the first band's flux; empty when dark");
    return good;
}

glint_status column_set_make(const glint_scenario *s, column_set *set, glint_error *error)
{
    const model *m = &s->satellite.model;
    const size_t most = 24 + 7 * (size_t)s->n_bands + (size_t)m->n_materials +
                        (size_t)m->n_components + (size_t)s->satellite.n_surfaces;
    *set = (column_set){.s = s,
                        .columns = calloc(most, sizeof *set->columns),
                        .kinds = calloc(most, sizeof *set->kinds),
                        .indices = calloc(most, sizeof *set->indices),
                        .names = calloc(most, sizeof *set->names)};
    bool good = set->columns && set->kinds && set->indices && set->names;
    if (good && !s->has_geometry)
        good = add(set, COLUMN_UTC, 0, "utc", "", "", "UTC of reception at the observer");
    if (good && s->n_observers > 1)
        good = add(set, COLUMN_OBSERVER, 0, "observer", "", "", "name of the observer");
    good = good && add(set, COLUMN_T, 0, "t_s", "", "s", "TT seconds from the start") &&
           add_bands(s, set) && add_standard(s, set) && add_telescope(s, set) &&
           add(set, COLUMN_RANGE, 0, "range_km", "", "km", "observer to satellite") &&
           add(set, COLUMN_PHASE, 0, "phase_angle_deg", "", "deg",
               "at the satellite, between Sun and observer; 0 is full") &&
           add(set, COLUMN_SUNLIT, 0, "sunlit_fraction", "", "",
               "visible part of the solar disc, seen from the satellite") &&
           add(set, COLUMN_FLAGS, 0, "flags", "", "", "why the row is faint or dark") &&
           add_site(s, set) && add_moon(s, set) && add_shares(s, set);
    if (good) return GLINT_OK;
    column_set_free(set);
    return error_no_memory(error);
}

void column_set_free(column_set *set)
{
    for (size_t i = 0; set->names && i < set->n; i++)
        free(set->names[i]);
    free(set->names);
    free(set->columns);
    free(set->kinds);
    free(set->indices);
    *set = (column_set){0};
}

static bool standard_magnitude(const glint_scenario *s, const glint_row *row, int band,
                               double phase, double *value)
{
    if (!(row->flux_ratio[band] > 0)) return false;
    *value = magnitude_of(row->flux_ratio[band], s->sun_magnitude[band]) +
             magnitude_to_standard(row->range_m, row->phase_angle_rad, phase);
    return isfinite(*value);
}

static bool noise_value(const column_set *set, const glint_row *row, size_t column, double *value)
{
    const int band = set->indices[column];
    if (!(row->flux_ratio[band] > 0)) return false;
    const double snr = noise_row_snr(set->s, row, band);
    *value = set->kinds[column] == COLUMN_SNR ? snr : noise_sigma_mag(snr);
    return isfinite(*value) && snr > 0;
}

/* What only a site sees, rad. */
static double site_angle(column_kind kind, const glint_row *row)
{
    if (kind == COLUMN_AZIMUTH) return row->azimuth_rad;
    if (kind == COLUMN_ELEVATION) return row->elevation_rad;
    if (kind == COLUMN_SUN_ELEVATION) return row->sun_elevation_rad;
    return kind == COLUMN_MOON_AZIMUTH ? row->moon_azimuth_rad : row->moon_elevation_rad;
}

bool column_value(const column_set *set, const glint_row *row, size_t column, double *value)
{
    const int i = set->indices[column];
    switch (set->kinds[column]) {
    case COLUMN_OBSERVER:
    case COLUMN_UTC:
    case COLUMN_FLAGS:
        return false;
    case COLUMN_T:
        *value = row->t_s;
        return true;
    case COLUMN_MAGNITUDE:
        *value = row->magnitude[i];
        return row->flux_ratio[i] > 0;
    case COLUMN_FLUX:
        *value = row->flux_ratio[i];
        return true;
    case COLUMN_EARTHSHINE:
        *value = row->earthshine_flux_ratio[i];
        return true;
    case COLUMN_STANDARD_90:
        return standard_magnitude(set->s, row, i, 0.5 * PI, value);
    case COLUMN_STANDARD_0:
        return standard_magnitude(set->s, row, i, 0, value);
    case COLUMN_SNR:
    case COLUMN_SIGMA:
        return noise_value(set, row, column, value);
    case COLUMN_ANGULAR_RATE:
        *value = row->angular_rate_rad_s / ARCSEC;
        return true;
    case COLUMN_RANGE:
        *value = row->range_m * 1e-3;
        return true;
    case COLUMN_PHASE:
        *value = row->phase_angle_rad / DEG;
        return true;
    case COLUMN_SUNLIT:
        *value = row->sunlit_fraction;
        return true;
    case COLUMN_AZIMUTH:
    case COLUMN_ELEVATION:
    case COLUMN_SUN_ELEVATION:
    case COLUMN_MOON_AZIMUTH:
    case COLUMN_MOON_ELEVATION:
        *value = site_angle(set->kinds[column], row) / DEG;
        return row->has_site;
    case COLUMN_AIRMASS:
        *value = row->airmass;
        return row->airmass > 0;
    case COLUMN_MOON_SEPARATION:
        *value = row->moon_separation_rad / DEG;
        return true;
    case COLUMN_MOON_ILLUMINATED:
        *value = row->moon_illuminated;
        return true;
    case COLUMN_SHARE_MATERIAL:
        *value = row->share_material[i];
        return row->flux_ratio[0] > 0;
    case COLUMN_SHARE_COMPONENT:
        *value = row->share_component[i];
        return row->flux_ratio[0] > 0;
    case COLUMN_SHARE_SURFACE:
        *value = row->share_surface[i];
        return row->flux_ratio[0] > 0;
    }
    return false;
}

static size_t write_flags(unsigned flags, char *out)
{
    static const struct {
        unsigned flag;
        const char *name;
    } NAMES[] = {{GLINT_BELOW_HORIZON, "below-horizon"}, {GLINT_UMBRA, "umbra"},
                 {GLINT_PENUMBRA, "penumbra"},           {GLINT_DARK, "dark"},
                 {GLINT_SITE_DARK, "site-dark"},         {GLINT_BLOCKED, "blocked"},
                 {GLINT_MOON_SHADOW, "moon-shadow"}};
    size_t n = 0;
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; k++) {
        if (!(flags & NAMES[k].flag)) continue;
        if (n) out[n++] = '|';
        const size_t length = strlen(NAMES[k].name);
        memcpy(out + n, NAMES[k].name, length);
        n += length;
    }
    out[n] = '\0';
    return n;
}

/* A name without double quotes; in quotes where the table's reader needs them. */
static size_t write_name(const char *name, char out[GLINT_CELL_SIZE])
{
    const char *quote = strchr(name, ',') ? "\"" : "";
    const int n = snprintf(out, GLINT_CELL_SIZE, "%s%s%s", quote, name, quote);
    return n < 0 ? 0 : n < GLINT_CELL_SIZE ? (size_t)n : GLINT_CELL_SIZE - 1;
}

size_t column_text(const column_set *set, const glint_row *row, size_t column,
                   char out[GLINT_CELL_SIZE])
{
    double value;
    size_t n = 0;
    if (set->kinds[column] == COLUMN_UTC) {
        utc_write(&row->utc, out);
        return UTC_TEXT_SIZE - 1;
    }
    if (set->kinds[column] == COLUMN_OBSERVER) return write_name(row->observer, out);
    if (set->kinds[column] == COLUMN_FLAGS) return write_flags(row->flags, out);
    if (column_value(set, row, column, &value)) n = number_format(value, out);
    out[n] = '\0';
    return n;
}
