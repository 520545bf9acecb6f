#include "base/constants.h"
#include "scenario/reading.h"

#include <math.h>

void read_band_table(reading *rd, reader *r, const toml_node *node, const param_info *value,
                     double *out)
{
    const glint_scenario *s = rd->s;
    reader table = reader_start(node, value->name, rd->errors);
    for (size_t k = 0; band_at(k); k++)
        reader_has(&table,
                   band_at(k)->name); /* bands that this run does not ask for may stand there */
    for (int b = 0; b < s->n_bands; b++) {
        param_info one = *value;
        one.name = s->bands[b]->name;
        reader_param(&table, &one, &out[b]);
    }
    reading_done(rd, &table);
    if (table.status > r->status) r->status = table.status;
}

/* One number for all bands, or a table of them. */
static void read_per_band(reading *rd, reader *r, const param_info *value, double *out)
{
    const toml_node *node = reader_find(r, value->name);
    if (node && node->type == TOML_TABLE) {
        read_band_table(rd, r, node, value, out);
        return;
    }
    double number;
    reader_param(r, value, &number);
    for (int b = 0; b < rd->s->n_bands; b++)
        out[b] = number;
}

/* Electrons per s from a star of magnitude 0 in each band: said by a zero point, or by how much of
 * the light comes through. */
static void read_zero_points(reading *rd, reader *r, double area_m2, telescope *out)
{
    static const param_info POINT = {"zero_point_mag", "mag", "", -50, 100, PARAM_REQUIRED, 0};
    static const param_info PART = {"throughput", "", "", 0, 1, PARAM_REQUIRED, PARAM_MIN_OPEN};
    const glint_scenario *s = rd->s;
    const toml_node *point = reader_find(r, POINT.name), *part = reader_find(r, PART.name);
    if (!point == !part) {
        reader_fail(r, point ? part->where : r->table->where,
                    "%s 'zero_point_mag' and 'throughput' %s; expected one of them",
                    point ? "both" : "neither", point ? "are given" : "is given");
        return;
    }
    double values[SCENARIO_MAX_BANDS] = {0};
    read_per_band(rd, r, point ? &POINT : &PART, values);
    for (int b = 0; b < s->n_bands; b++) {
        out->electrons_s[b] =
            point ? pow(10, 0.4 * values[b])
                  : values[b] * area_m2 * band_photons_m2_s(s->bands[b], s->systems[b]);
        if (isnan(out->electrons_s[b]))
            reader_fail(r, part->where,
                        "the width of band %s is not known, so that 'throughput' says too little; "
                        "expected 'zero_point_mag': the magnitude that gives one electron per s",
                        s->bands[b]->name);
    }
}

/* Lengths and areas that must fit to each other. */
static void read_optics(reader *r, telescope *out, double *area_m2)
{
    static const param_info APERTURE = {"aperture_m",   "m",           "", 0, 100,
                                        PARAM_REQUIRED, PARAM_MIN_OPEN};
    static const param_info OBSTRUCTION = {"obstruction_m", "m", "", 0, 100, 0, 0};
    static const param_info PIXEL = {"pixel_scale_arcsec", "arcsec",      "", 0, 3600,
                                     PARAM_REQUIRED,       PARAM_MIN_OPEN};
    static const param_info SEEING = {"seeing_fwhm_arcsec", "arcsec",      "", 0, 3600,
                                      PARAM_REQUIRED,       PARAM_MIN_OPEN};
    static const param_info HALF = {
        "box_half_width_arcsec",        "arcsec", "", 0, 36000, PARAM_NONE,
        PARAM_MIN_OPEN | PARAM_OPTIONAL};
    double obstruction_m = 0, pixel = 1, seeing = 1, half;
    out->aperture_m = 1;
    reader_param(r, &APERTURE, &out->aperture_m);
    reader_param(r, &OBSTRUCTION, &obstruction_m);
    reader_param(r, &PIXEL, &pixel);
    reader_param(r, &SEEING, &seeing);
    if (!reader_param(r, &HALF, &half)) half = seeing;
    if (reader_has(r, OBSTRUCTION.name) && obstruction_m >= out->aperture_m)
        reader_fail(r, reader_place(r, OBSTRUCTION.name),
                    "'obstruction_m' is %g; expected less than 'aperture_m', %g", obstruction_m,
                    out->aperture_m);
    out->pixel_rad = pixel * ARCSEC;
    out->seeing_fwhm_rad = seeing * ARCSEC;
    out->half_width_rad = half * ARCSEC;
    *area_m2 = 0.25 * PI * (out->aperture_m * out->aperture_m - obstruction_m * obstruction_m);
}

/* Whether [time] has no exposure, or one of 0; one that is wrong is an error of its own. */
static bool lacks_exposure(const reader *root)
{
    const toml_node *time = toml_child(root->table, "time");
    if (!time || time->type != TOML_TABLE) return false;
    const toml_node *exposure = toml_child(time, "exposure_s");
    if (!exposure) return true;
    return (exposure->type == TOML_FLOAT || exposure->type == TOML_INTEGER) &&
           exposure->number == 0;
}

void read_telescope(reading *rd, reader *root)
{
    static const char *const TRACKING[] = {"sidereal", "satellite"};
    static const param_info READ = {"read_noise_e", "electrons", "", 0, 1e6, PARAM_REQUIRED, 0};
    static const param_info DARK = {
        "dark_current_e_s", "electrons/s", "", 0, 1e9, PARAM_REQUIRED, 0};
    static const param_info SKY = {
        "sky_mag_arcsec2", "mag/arcsec2", "", -30, 100, PARAM_REQUIRED, 0};
    /* m^(2/3) s^(1/2); the default is about the median of Osborn et al. 2015, table 1 */
    static const param_info YOUNG = {"scintillation", "m^(2/3) s^(1/2)", "", 0, 100, 1.5, 0};
    glint_scenario *s = rd->s;
    const toml_node *table = reader_table(root, "telescope", false);
    if (!table) return;
    reader r = reader_start(table, "[telescope]", rd->errors);
    telescope *scope = &s->telescope;
    double area_m2;
    int tracking;
    read_optics(&r, scope, &area_m2);
    read_zero_points(rd, &r, area_m2, scope);
    read_per_band(rd, &r, &SKY, scope->sky_mag);
    reader_param(&r, &READ, &scope->read_noise_e);
    reader_param(&r, &DARK, &scope->dark_current_e_s);
    reader_param(&r, &YOUNG, &scope->scintillation);
    reader_choice(&r, "tracking", TRACKING, 2, 0, &tracking);
    scope->follows = tracking == 1;
    if (s->has_geometry)
        reader_fail(&r, table->where,
                    "directions given by [geometry] have no time in which to expose; expected no "
                    "[telescope]");
    else if (lacks_exposure(root))
        reader_fail(&r, table->where,
                    "a telescope must expose; expected exposure_s above 0 in [time]");
    s->has_telescope = true;
    reading_done(rd, &r);
}
