#include "lightcurve/facts.h"

#include "base/constants.h"
#include "base/grow.h"
#include "base/text.h"
#include "brdf/table.h"
#include "orbit/attitude_table.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glint_version.h"

void fact_list_add(fact_list *list, const char *key, const char *format, ...)
{
    if (list->failed) return;
    if (!grow_list(&list->items, &list->capacity, list->n + 1, sizeof *list->items)) {
        list->failed = true;
        return;
    }
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    const int n = vsnprintf(NULL, 0, format, args);
    va_end(args);
    fact *f = &list->items[list->n];
    f->key = string_copy(key, strlen(key));
    f->value = malloc((size_t)(n > 0 ? n : 0) + 1);
    if (f->key && f->value && n >= 0) {
        vsnprintf(f->value, (size_t)n + 1, format, again);
        list->n++;
    } else {
        free(f->key);
        free(f->value);
        list->failed = true;
    }
    va_end(again);
}

bool fact_list_get(const fact_list *list, size_t k, const char **key, const char **value)
{
    if (k >= list->n) return false;
    *key = list->items[k].key;
    *value = list->items[k].value;
    return true;
}

void fact_list_free(fact_list *list)
{
    for (size_t i = 0; i < list->n; i++) {
        free(list->items[i].key);
        free(list->items[i].value);
    }
    free(list->items);
    *list = (fact_list){0};
}

/* FNV-1a, 64 bits (Fowler, Noll, Vo): tells scenarios apart, is no signature. */
static uint64_t hash_text(uint64_t hash, const char *string)
{
    for (; *string; string++)
        hash = (hash ^ (unsigned char)*string) * 0x100000001b3ull;
    return (hash ^ 0xff) * 0x100000001b3ull; /* ends of texts count */
}

static uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t n)
{
    const unsigned char *b = bytes;
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ b[i]) * 0x100000001b3ull;
    return hash;
}

/* Numbers that came from files of their own: measured tables, meshes. */
static uint64_t hash_satellite(uint64_t hash, const satellite *sat, int n_bands)
{
    for (int m = 0; m < sat->n_materials; m++)
        for (int b = 0; b < n_bands; b++)
            for (int l = 0; l < sat->materials[m].bands[b].n_lobes; l++) {
                const brdf_lobe *lobe = &sat->materials[m].bands[b].lobes[l];
                if (lobe->numbers)
                    hash = hash_bytes(hash, lobe->numbers, lobe->n_numbers * sizeof *lobe->numbers);
            }
    const facet_list *polygons = &sat->model.polygons;
    for (int k = 0; k < polygons->n; k++) {
        const facet *f = &polygons->items[k];
        hash = hash_bytes(hash, &f->material, sizeof f->material);
        if (f->surface && polygons->surfaces[f->surface - 1].kind == SURFACE_SMOOTH)
            hash = hash_bytes(hash, polygons->normals[f->first_vertex],
                              (size_t)f->n_vertices * sizeof *polygons->normals);
    }
    return hash_bytes(hash, polygons->vertices,
                      (size_t)polygons->n_vertices * sizeof *polygons->vertices);
}

/* Element sets and positions, which come from files of their own. */
static uint64_t hash_orbit(uint64_t hash, const scenario_orbit *o)
{
    for (size_t k = 0; k < o->sets.n; k++) {
        const tle *e = &o->sets.sets[k];
        const double elements[] = {e->epoch_jd[0],         e->epoch_jd[1],  e->bstar,
                                   e->inclination,         e->raan,         e->eccentricity,
                                   e->argument_of_perigee, e->mean_anomaly, e->mean_motion};
        hash = hash_bytes(hash, elements, sizeof elements);
    }
    const orbit_table *table = orbit_table_of(o->propagator, NULL);
    /* the times of the records count from there */
    if (table) hash = hash_bytes(hash, table->reference_jd, sizeof table->reference_jd);
    for (size_t k = 0; table && k < table->n; k++) {
        const table_segment *part = &table->segments[k];
        const int how[] = {(int)part->frame, (int)part->method, part->degree};
        const double use_s[] = {part->from_s, part->to_s};
        hash = hash_bytes(hash, how, sizeof how);
        hash = hash_bytes(hash, use_s, sizeof use_s);
        hash = hash_bytes(hash, part->nodes, part->n * sizeof *part->nodes);
    }
    return hash;
}

/* Attitudes and angles that came from files of their own. */
static uint64_t hash_motion(uint64_t hash, const glint_scenario *s)
{
    for (int k = 0; k < s->attitude.n; k++) {
        const attitude_table *t = s->attitude.legs[k].law.table;
        if (!t) continue;
        hash = hash_bytes(hash, t->t_s, (size_t)t->n * sizeof *t->t_s);
        hash = hash_bytes(hash, t->q, (size_t)t->n * sizeof *t->q);
        for (int i = 0; i < t->n_spans; i++) {
            const double span[] = {t->spans[i].frame, t->spans[i].from_s, t->spans[i].to_s};
            hash = hash_bytes(hash, span, sizeof span);
        }
    }
    for (int c = 0; c < s->satellite.n_components; c++) {
        const hinge_table *t = &s->satellite.components[c].hinge.table;
        if (t->n == 0) continue;
        hash = hash_bytes(hash, t->t_s, (size_t)t->n * sizeof *t->t_s);
        hash = hash_bytes(hash, t->angle, (size_t)t->n * sizeof *t->angle);
    }
    return hash;
}

/* Of all that decides the result: the files, what was set, element sets, positions, masks, Earth
 * orientation, directions, tables of attitudes and angles. */
static uint64_t scenario_hash(const glint_scenario *s)
{
    uint64_t hash = 0xcbf29ce484222325ull;
    for (int i = 0; i < s->n_documents; i++)
        hash = hash_text(hash, s->documents[i]->text);
    for (size_t i = 0; i < s->n_overrides; i++)
        hash = hash_text(hash, s->overrides[i]);
    hash = hash_satellite(hash, &s->satellite, s->n_bands);
    if (!s->has_geometry) hash = hash_orbit(hash, &s->orbit);
    hash = hash_motion(hash, s);
    for (int i = 0; i < s->n_observers; i++) {
        const scenario_observer *o = &s->observers[i];
        if (o->kind == OBSERVER_SATELLITE) hash = hash_orbit(hash, &o->orbit);
        for (int k = 0; k < o->horizon.n; k++) {
            const double point[] = {o->horizon.points[k].azimuth, o->horizon.points[k].elevation};
            hash = hash_bytes(hash, point, sizeof point);
        }
    }
    if (s->eop) {
        const uint64_t fingerprint = eop_fingerprint(s->eop);
        hash = hash_bytes(hash, &fingerprint, sizeof fingerprint);
    }
    if (s->has_geometry) {
        const size_t n = (size_t)s->geometry.n;
        hash = hash_bytes(hash, s->geometry.sun, n * sizeof *s->geometry.sun);
        hash = hash_bytes(hash, s->geometry.observer, n * sizeof *s->geometry.observer);
        hash = hash_bytes(hash, s->geometry.range_m, n * sizeof *s->geometry.range_m);
        hash = hash_bytes(hash, s->geometry.t_s, n * sizeof *s->geometry.t_s);
    }
    return hash;
}

static void describe_site(const scenario_observer *o, text *out)
{
    text_printf(out, "latitude %.6g deg, longitude %.6g deg, height %g m; nothing below %g deg",
                o->site.latitude / DEG, o->site.longitude / DEG, o->site.height_m,
                o->horizon.least / DEG);
    if (o->horizon.n > 0)
        text_printf(out, " and a mask of %d points up to %g deg", o->horizon.n,
                    o->horizon.highest / DEG);
    if (o->air.on)
        text_printf(out,
                    "; elevations with refraction (Bennett 1982; %.6g hPa, %.4g C; below 0 deg "
                    "as at 0 deg)",
                    o->air.pressure_hpa, o->air.temperature_c);
}

char *fact_observer(const glint_scenario *s, const scenario_observer *o)
{
    text out = {0};
    text_printf(&out, "%s%s", o->name, o->name[0] ? ": " : "");
    if (o->kind == OBSERVER_SITE) {
        describe_site(o, &out);
    } else if (o->kind == OBSERVER_SATELLITE) {
        char *line = fact_orbit(s, &o->orbit);
        text_printf(&out, "a satellite, %s; the Earth hides what is behind it", line ? line : "");
        free(line);
    } else {
        const double *d = o->direction;
        text_printf(&out, "always %g km in the direction (%.6g, %.6g, %.6g) of the %s",
                    o->range_m * 1e-3, d[0], d[1], d[2],
                    o->in_body ? "body, seen past everything" : "frame GCRS, seen past everything");
    }
    return out.data;
}

/* One fact for all of them: keys of a YAML map are unique. */
static void add_observers(const glint_scenario *s, fact_list *out)
{
    text all = {0};
    for (int i = 0; i < s->n_observers; i++) {
        char *line = fact_observer(s, &s->observers[i]);
        text_printf(&all, "%s%s", i ? " | " : "", line ? line : "");
        free(line);
    }
    if (all.failed)
        out->failed = true;
    else
        fact_list_add(out, s->n_observers > 1 ? "observers" : "observer", "%s",
                      all.data ? all.data : "");
    text_free(&all);
}

static bool any_refraction(const glint_scenario *s)
{
    for (int i = 0; i < s->n_observers; i++)
        if (s->observers[i].air.on) return true;
    return false;
}

static void write_date(int mjd, char out[16])
{
    glint_utc date;
    utc_from_mjd(mjd, &date);
    snprintf(out, 16, "%04d-%02d-%02d", date.year % 10000, date.month % 100, date.day % 100);
}

/* How the Earth turns. */
static void add_orientation(const glint_scenario *s, fact_list *out)
{
    char dut1[NUMBER_SIZE + 1];
    dut1[number_format(s->clock.dut1_s, dut1)] = '\0';
    if (!s->eop) {
        fact_list_add(out, "dut1_s", "%s%s", dut1,
                      s->dut1_s == 0 ? " (UT1-UTC taken as 0: at most 0.9 s, 0.4 km on the equator)"
                                     : "");
        fact_list_add(out, "polar_motion", "taken as 0 (at most 0.6 arcsec, 20 m on the ground)");
        return;
    }
    int first, last, predicted;
    char since[16], tt_end[16];
    eop_span(s->eop, &first, &last, &predicted);
    write_date(predicted, since);
    write_date(last, tt_end);
    fact_list_add(out, "dut1_s", "%.7f at the start (UT1-UTC), then as in eop", s->clock.dut1_s);
    fact_list_add(out, "polar_motion", "as in eop");
    fact_list_add(out, "eop", "%s (%s%s), linear between its days; %s%s", s->eop_name,
                  eop_format(s->eop), string_equal(eop_format(s->eop), "C04") ? "" : ", Bulletin A",
                  predicted <= last ? "predictions from " : "no predictions up to ",
                  predicted <= last ? since : tt_end);
}

static void add_bands(const glint_scenario *s, fact_list *out)
{
    for (int b = 0; b < s->n_bands; b++) {
        char key[32], value[NUMBER_SIZE + 1];
        snprintf(key, sizeof key, "zero_point_%s", s->bands[b]->name);
        value[number_format(s->sun_magnitude[b], value)] = '\0';
        fact_list_add(out, key, "apparent magnitude of the Sun %s (%s; " BAND_SOURCE ")", value,
                      magnitude_system_name(s->systems[b]));
        if (!s->has_extinction) continue;
        snprintf(key, sizeof key, "extinction_%s", s->bands[b]->name);
        value[number_format(s->extinction[b], value)] = '\0';
        fact_list_add(out, key, "%s mag per airmass, in mag_%s, not in flux_ratio_%s", value,
                      s->bands[b]->name, s->bands[b]->name);
    }
    if (!s->has_extinction) fact_list_add(out, "extinction", "none");
}

/* What the camera does, and magnitudes at 1000 km. */
static void add_camera(const glint_scenario *s, fact_list *out)
{
    char value[NUMBER_SIZE + 1];
    value[number_format(s->exposure_s, value)] = '\0';
    if (s->exposure_s > 0)
        fact_list_add(
            out, "exposure",
            "light is averaged over %s s, centred on the row's time; angles, ranges and flags (but "
            "'dark') are those of that time",
            value);
    for (int b = 0; s->has_telescope && b < s->n_bands; b++)
        fact_list_add(out, "telescope",
                      "%.4g m; %s of magnitude 0 in %s gives %.4g electrons per s; sky %.4g "
                      "mag per square arcsec; %s",
                      s->telescope.aperture_m, "a star above the atmosphere", s->bands[b]->name,
                      s->telescope.electrons_s[b], s->telescope.sky_mag[b],
                      s->telescope.follows ? "it follows the satellite" : "it follows the stars");
    if (s->standard)
        fact_list_add(
            out, "standard_magnitudes",
            "at 1000 km, with the phase law of a diffuse (Lambertian) sphere; sunlit_fraction and "
            "the Sun's distance stay in them");
}

/* One fact for each law, and what is taken for granted between given attitudes. */
static void add_attitude(const glint_scenario *s, fact_list *out)
{
    text lines = {0};
    bool slews = false, tables = false;
    attitude_plan_describe(&s->attitude, "", &lines);
    if (lines.failed) out->failed = true;
    for (char *line = lines.data, *end; line && (end = strchr(line, '\n')); line = end + 1) {
        *end = '\0';
        fact_list_add(out, "attitude", "%s", line);
    }
    text_free(&lines);
    for (int k = 0; k < s->attitude.n; k++) {
        slews = slews || s->attitude.legs[k].slew_s > 0;
        tables = tables || s->attitude.legs[k].law.table;
    }
    if (slews)
        fact_list_add(out, "attitude_slews",
                      "at a steady share of the turn between the two laws, by the "
                      "shorter way when the slew begins; no wheel ramps up or down");
    if (tables)
        fact_list_add(out, "attitude_tables",
                      "between rows by the shortest way at a steady rate; nothing is "
                      "read outside their spans");
}

static void add_time(const glint_scenario *s, fact_list *out)
{
    fact_list_add(out, "time_scale",
                  "utc is the reception at the observer; t_s counts TT seconds from the start");
    add_orientation(s, out);
    if (s->clock.dubious) fact_list_add(out, "leap_seconds", "not known for these years");
    char *line = fact_orbit(s, &s->orbit);
    fact_list_add(out, "orbit", "%s", line ? line : "");
    free(line);
    char *sets = fact_element_sets(s, &s->orbit);
    if (sets) fact_list_add(out, "element_sets", "%s", sets);
    free(sets);
    add_attitude(s, out);
    fact_list_add(out, "light_time", s->light_time ? "yes" : "no");
    fact_list_add(out, "aberration", s->aberration ? "yes, of the Sun" : "no");
    fact_list_add(
        out, "eclipse",
        "by the WGS84 ellipsoid and by the Moon's disc (place good to 25 km), uniform solar disc, "
        "no refraction in the atmosphere");
    add_observers(s, out);
}

static void add_origin(const glint_scenario *s, fact_list *out)
{
    fact_list_add(out, "glint_version", GLINT_VERSION_TEXT);
    if (s->title[0]) fact_list_add(out, "title", "%s", s->title);
    fact_list_add(out, "scenario_hash", "fnv1a64:%016llx", (unsigned long long)scenario_hash(s));
    for (size_t k = 0; k < s->n_overrides; k++)
        fact_list_add(out, "set", "%s", s->overrides[k]);
}

/* What of the hemisphere measured materials cover. */
static void add_measured(const glint_scenario *s, fact_list *out)
{
    for (int m = 0; m < s->satellite.n_materials; m++)
        for (int b = 0; b < s->n_bands; b++) {
            if (s->satellite.model.same_band[m * s->n_bands + b] != b) continue;
            const brdf_material *band = &s->satellite.materials[m].bands[b];
            for (int l = 0; l < band->n_lobes; l++) {
                if (!(band->lobes[l].model->flags & BRDF_MEASURED)) continue;
                table_facts facts;
                table_describe(&band->lobes[l], &facts);
                fact_list_add(
                    out, "measured",
                    "material %s in %s: %d rows%s; %.0f %% of the hemisphere lie between them, and "
                    "elsewhere the nearest values hold",
                    s->satellite.materials[m].name, s->bands[b]->name, facts.n_rows,
                    facts.in_plane ? " of the plane of incidence, carried out of it as if f did "
                                     "not depend on phi_d"
                                   : "",
                    100.0 * facts.covered);
            }
        }
}

/* Lobes that are too narrow for the meshes that they are on. */
static void add_flicker(const glint_scenario *s, fact_list *out)
{
    for (int m = 0; m < s->satellite.n_materials; m++) {
        const scenario_material *material = &s->satellite.materials[m];
        if (material->flicker_rad > 0.0)
            fact_list_add(
                out, "mesh_flickers",
                "%s: its lobe is narrower than its mesh, which bends by %.3g deg from facet to "
                "facet",
                material->name, material->flicker_rad / DEG);
    }
}

void fact_lobe(const brdf_lobe *lobe, text *t)
{
    if (lobe->weight != 1) text_printf(t, "%g x ", lobe->weight);
    text_add(t, lobe->model->name);
    for (int k = 0; k < lobe->model->n_params; k++)
        if (lobe->model->params[k].flags & PARAM_ROWS)
            text_printf(t, " %s=(%d x %d)", lobe->model->params[k].name, lobe->arrays[k].rows,
                        lobe->arrays[k].columns);
        else if (!isnan(lobe->params[k]))
            text_printf(t, " %s=%g", lobe->model->params[k].name, lobe->params[k]);
}

static void add_earthshine(const glint_scenario *s, fact_list *out)
{
    if (!s->earth.wanted) {
        fact_list_add(out, "earthshine", "none");
        return;
    }
    fact_list_add(
        out, "earthshine",
        "from a sphere of %.7g km, lit by the Sun's centre, in %d rings of directions; no clouds, "
        "no "
        "seasons; %s; pieces of curved surfaces count as flat",
        s->earth.radius_m * 1e-3, s->earth.source ? globe_rings(s->earth.source) : 0,
        s->self_shadows == SHADOWS_NONE
            ? "shadows are neglected"
            : "its shadows are those of the centre of the lit ground; facets that do not see that "
              "centre are hidden from the observer only");
    for (int b = 0; b < s->n_bands; b++) {
        if (b > 0 && brdf_material_same(&s->earth.ground[b - 1], &s->earth.ground[b])) continue;
        text ground = {0};
        for (int l = 0; l < s->earth.ground[b].n_lobes; l++) {
            if (l) text_add(&ground, " + ");
            fact_lobe(&s->earth.ground[b].lobes[l], &ground);
        }
        fact_list_add(out, "earthshine_ground", "from %s on: %s", s->bands[b]->name,
                      ground.data ? ground.data : "");
        text_free(&ground);
    }
}

void facts_of_orbit(const glint_scenario *s, fact_list *out)
{
    add_origin(s, out);
    add_time(s, out);
}

/* What interpolated shadows are off by, of the mean flux, for each rad of shadow_step: as measured
 * on several bodies (docs/physics.md, Shadows between parts). */
static const double INTERPOLATION_RMS_PER_RAD = 0.017;

static void add_shadows(const glint_scenario *s, fact_list *out)
{
    static const char *const AREA =
        "facets shine with the area that is both lit by the Sun and seen by the observer";
    if (s->self_shadows == SHADOWS_NONE)
        fact_list_add(out, "self_shadows",
                      "none: shadows that parts cast on each other are neglected");
    else if (s->self_shadows == SHADOWS_INTERPOLATED)
        fact_list_add(
            out, "self_shadows",
            "interpolated: %s; exact every %g deg of motion, and interpolated between: off by "
            "about %.2g of the mean flux, rms",
            AREA, s->shadow_step / DEG, INTERPOLATION_RMS_PER_RAD * s->shadow_step);
    else if (s->self_shadows == SHADOWS_RAYS)
        fact_list_add(
            out, "self_shadows",
            "rays: %s, by %d points of each facet: its fraction is off by up to %.2g, rms", AREA,
            s->rays_per_facet, 0.5 * pow(s->rays_per_facet, -0.7));
    else
        fact_list_add(out, "self_shadows", "exact: %s", AREA);
}

void facts_of_run(const glint_scenario *s, fact_list *out)
{
    add_origin(s, out);
    add_bands(s, out);
    if (s->has_geometry)
        fact_list_add(out, "geometry", "directions given in the body frame, the Sun at 1 au");
    else
        add_time(s, out);
    add_camera(s, out);
    add_measured(s, out);
    add_shadows(s, out);
    add_flicker(s, out);
    static const char *const DISCS[] = {
        [SOLAR_UNIFORM] =
            "uniform: the mean over the Sun's disc; shadows between parts are those of "
            "its centre",
        [SOLAR_LIMB_DARKENED] = "limb-darkened (linear, u = 0.6): the mean over the Sun's disc; "
                                "shadows between parts are those of its centre",
        [SOLAR_POINT] = "point: facets see the Sun's light from the centre of its disc"};
    fact_list_add(out, "solar_disc", "%s", DISCS[s->solar_disc]);
    add_earthshine(s, out);
    fact_list_add(
        out, "not_modelled",
        "interreflection between parts, polarisation, transmission, thermal emission, moonlight%s",
        s->has_geometry || any_refraction(s) ? "" : ", refraction of the line of sight");
}
