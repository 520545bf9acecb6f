#include "scenario/read_material.h"

#include "base/constants.h"
#include "base/text.h"
#include "brdf/dhr.h"
#include "scenario/read_lobe.h"
#include "scenario/read_measured.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void scenario_material_free(scenario_material *material)
{
    if (material->bands) {
        /* bands that share a table with the first were given copies: each is freed by itself */
        for (int b = 0; b < SCENARIO_MAX_BANDS && material->bands[b].lobes; b++)
            brdf_material_free(&material->bands[b]);
        free(material->bands);
    }
    *material = (scenario_material){0};
}

static int param_index(const brdf_model *brdf, const char *name)
{
    for (int k = 0; k < brdf->n_params; k++)
        if (string_equal(brdf->params[k].name, name)) return k;
    return -1;
}

static const brdf_model *read_brdf_name(reader *r, bool in_sum)
{
    const char *name, *names[64];
    size_t n = 0;
    if (!reader_string(r, "brdf", true, &name)) return NULL;
    const brdf_model *brdf = brdf_model_named(name);
    if (brdf) return brdf;
    for (; n < 63 && brdf_model_at(n); n++)
        names[n] = brdf_model_at(n)->name;
    if (!in_sum) names[n++] = "sum";
    text list = {0};
    for (size_t k = 0; k < n; k++)
        text_printf(&list, "%s%s", k ? ", " : "", names[k]);
    const char *near = nearest_name(name, names, n);
    reader_fail(r, reader_place(r, "brdf"), "there is no BRDF '%.40s'%s%s%s; expected one of: %s",
                name, near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "",
                list.data ? list.data : "");
    text_free(&list);
    return NULL;
}

/* The keys of a lobe: those of its model. band: NULL, or where the wavelength follows the band. */
static void read_lobe(reader *r, const brdf_model *brdf, const band_info *band, double weight,
                      measured_cache *tables, brdf_lobe *out)
{
    *out = (brdf_lobe){.model = brdf, .weight = weight};
    const glint_status before = r->status;
    r->status = GLINT_OK;
    read_lobe_params(r, band, out);
    if (brdf->flags & BRDF_MEASURED) read_measured(r, tables, out);
    bool follow = false;
    if (brdf->flags & BRDF_WAVELENGTH) {
        reader_boolean(r, "follow_band", false, &follow);
        const int w = param_index(brdf, "wavelength_um");
        if (follow && isnan(out->params[w]))
            reader_fail(r, reader_place(r, "follow_band"),
                        "'follow_band' needs k_per_um and wavelength_um; expected both");
        else if (follow && band)
            out->params[w] = band->pivot_um;
    }
    glint_error error;
    if (r->status == GLINT_OK && brdf_lobe_prepare(out, &error))
        r->status = errors_take(r->errors, &error, r->table->where);
    if (before > r->status) r->status = before;
}

static bool make_lobes(reader *r, int n, brdf_material *out)
{
    out->lobes = calloc((size_t)n, sizeof *out->lobes);
    if (!out->lobes) {
        r->status = errors_add(r->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
        return false;
    }
    out->n_lobes = n;
    return true;
}

static void read_parts(reader *r, const band_info *band, measured_cache *tables, brdf_material *out)
{
    static const param_info WEIGHT = {"weight", "", "", 0, 1e6, 1, 0};
    const toml_node *parts = reader_tables(r, "parts");
    if (!parts) {
        reader_fail(r, reader_place(r, "parts"),
                    "a sum needs 'parts'; expected a list of { weight, brdf, ... }");
        return;
    }
    if (!make_lobes(r, parts->n_children, out)) return;
    for (int i = 0; i < parts->n_children; i++) {
        reader inner = reader_start(&parts->children[i], "a part of the sum", r->errors);
        double weight;
        reader_param(&inner, &WEIGHT, &weight);
        const brdf_model *brdf = read_brdf_name(&inner, true);
        if (brdf) {
            read_lobe(&inner, brdf, band, weight, tables, &out->lobes[i]);
            reader_done(&inner);
        }
        if (inner.status > r->status) r->status = inner.status;
    }
}

void read_reflection(reading *rd, reader *r, const band_info *band, brdf_material *out)
{
    *out = (brdf_material){0};
    const toml_node *brdf_node = reader_find(r, "brdf");
    const bool is_sum =
        brdf_node && brdf_node->type == TOML_STRING && string_equal(brdf_node->string, "sum");
    if (is_sum) {
        read_parts(r, band, &rd->tables, out);
        reader_done(r);
    } else {
        const brdf_model *brdf = read_brdf_name(r, false);
        if (brdf && make_lobes(r, 1, out)) {
            read_lobe(r, brdf, band, 1.0, &rd->tables, &out->lobes[0]);
            reader_done(r);
        }
    }
    if (r->status) brdf_material_free(out);
}

/* One material, one band: overlay holds the keys that differ in it (NULL: none). band NULL: without
 * a band. Errors leave *out empty. */
static glint_status read_function(reading *rd, const toml_node *table, const toml_node *overlay,
                                  const band_info *band, brdf_material *out)
{
    char what[96];
    snprintf(what, sizeof what, "[materials.%s%s%s]", table->key, overlay ? ".bands." : "",
             overlay ? overlay->key : "");
    reader r = reader_start(table, what, rd->errors);
    r.overlay = overlay;
    reader_has(&r, "source");
    reader_has(&r, "status");
    reader_has(&r, "bands");
    reader_has(&r, "holds_um");
    read_reflection(rd, &r, band, out);
    return r.status;
}

/* holds_um = 0.532, or [0.4, 0.7]: where the parameters hold. */
static void read_holds(reading *rd, const toml_node *table, double holds_um[2])
{
    const toml_node *node = toml_child(table, "holds_um");
    if (!node) return;
    reader r = reader_start(table, "the material", rd->errors);
    double um[2];
    bool good = node->type == TOML_ARRAY ? node_vector(node, "holds_um", 2, um, &r)
                                         : node_number(node, "holds_um", &um[0], &r);
    if (good && node->type != TOML_ARRAY) um[1] = um[0];
    if (good && !(um[0] > 0 && um[1] >= um[0])) {
        reader_fail(&r, node->where,
                    "'holds_um' is %g to %g; expected a wavelength above 0, or two in rising order",
                    um[0], um[1]);
        good = false;
    }
    if (good) memcpy(holds_um, um, sizeof um);
    reading_note(rd, r.status);
}

/* The table of keys that differ in a band; checks the names of all bands once (`check`). */
static const toml_node *band_overlay(reading *rd, const toml_node *table, const char *band,
                                     bool check)
{
    const toml_node *bands = toml_child(table, "bands");
    if (!bands) return NULL;
    if (bands->type != TOML_TABLE) {
        if (check)
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, bands->where,
                                        "'bands' is %s; expected tables such as "
                                        "[materials.NAME.bands.V]",
                                        toml_type_name(bands->type)));
        return NULL;
    }
    const toml_node *found = NULL;
    for (int i = 0; i < bands->n_children; i++) {
        const toml_node *child = &bands->children[i];
        if (check && (child->type != TOML_TABLE || !band_named(child->key)))
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, child->key_where,
                                        "'%.40s' is not a table of a band; expected U, B, V, R, I, "
                                        "sdss_u to sdss_z, or lsst_u to lsst_y",
                                        child->key));
        else if (child->type == TOML_TABLE && band && string_equal(child->key, band))
            found = child;
    }
    return found;
}

/* Checks what a material says of bands that this scenario does not use. */
static void check_other_bands(reading *rd, const toml_node *table)
{
    const glint_scenario *s = rd->s;
    const toml_node *bands = toml_child(table, "bands");
    for (int i = 0; bands && i < bands->n_children; i++) {
        const toml_node *overlay = &bands->children[i];
        const band_info *band = band_named(overlay->key);
        bool used = false;
        for (int b = 0; b < s->n_bands; b++)
            used = used || s->bands[b] == band;
        if (used || !band || overlay->type != TOML_TABLE) continue;
        brdf_material unused;
        reading_note(rd, read_function(rd, table, overlay, band, &unused));
        brdf_material_free(&unused);
    }
}

void read_material(reading *rd, const toml_node *table, scenario_material *out)
{
    glint_scenario *s = rd->s;
    out->name = table->key;
    out->where = table->where;
    const toml_node *source = toml_child(table, "source");
    out->source = source && source->type == TOML_STRING ? source->string : "";
    out->table = table;
    band_overlay(rd, table, NULL, true);
    read_holds(rd, table, out->holds_um);
    brdf_material base;
    glint_status status = read_function(rd, table, NULL, NULL, &base);
    reading_note(rd, status);
    if (status) return;
    brdf_material_free(&base);
    out->bands = calloc(SCENARIO_MAX_BANDS + 1, sizeof *out->bands);
    if (!out->bands) {
        reading_no_memory(rd);
        return;
    }
    for (int b = 0; b < s->n_bands; b++) {
        const char *band = s->bands[b] ? s->bands[b]->name : NULL;
        const toml_node *overlay = band_overlay(rd, table, band, false);
        status = read_function(rd, table, overlay, s->bands[b], &out->bands[b]);
        reading_note(rd, status);
        if (status) return;
    }
    check_other_bands(rd, table);
}

static bool is_taken(const satellite *sat, const char *name)
{
    for (int m = 0; m < sat->n_materials; m++)
        if (string_equal(sat->materials[m].name, name)) return true;
    return false;
}

static void add_materials(reading *rd, const toml_node *tables)
{
    satellite *sat = &rd->s->satellite;
    const size_t n = (size_t)(sat->n_materials + tables->n_children) + 1;
    scenario_material *materials = realloc(sat->materials, n * sizeof *materials);
    if (!materials) {
        reading_no_memory(rd);
        return;
    }
    sat->materials = materials;
    for (int i = 0; i < tables->n_children; i++) {
        const toml_node *table = &tables->children[i];
        if (table->type != TOML_TABLE)
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, table->where,
                                        "'%.60s' is %s; expected a table [materials.NAME]",
                                        table->key, toml_type_name(table->type)));
        else if (!reading_good_name(rd, "material", table->key, table->key_where))
            continue;
        else if (is_taken(sat, table->key))
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, table->key_where,
                                        "material '%s' stands twice; expected another name",
                                        table->key));
        else {
            scenario_material *material = &sat->materials[sat->n_materials++];
            *material = (scenario_material){0};
            read_material(rd, table, material);
        }
    }
}

/* The NAME in "materials.NAME...=value"; false for other keys. */
static bool named_by(const char *assignment, char name[80])
{
    static const char PREFIX[] = "materials.";
    if (strncmp(assignment, PREFIX, sizeof PREFIX - 1) != 0) return false;
    const char *from = assignment + sizeof PREFIX - 1;
    const size_t n = strcspn(from, ".= \t");
    if (n == 0 || n >= 80) return false;
    memcpy(name, from, n);
    name[n] = '\0';
    return true;
}

static bool has_material(const toml_document *document, const char *name)
{
    const toml_node *tables = toml_child(&document->root, "materials");
    return tables && toml_child(tables, name);
}

bool reading_override_waits(const toml_document *document, const char *assignment)
{
    char name[80];
    return named_by(assignment, name) && toml_child(&document->root, "materials_from") &&
           !has_material(document, name);
}

/* What was set of a file's own materials. */
static void override_materials(reading *rd, toml_document *document)
{
    char name[80];
    for (size_t k = 0; k < rd->n_overrides; k++)
        if (named_by(rd->overrides[k], name) && has_material(document, name))
            reading_note(rd, toml_override(document, rd->overrides[k], rd->errors));
}

/* What was set of a material that no file has. */
static void refuse_lost_overrides(reading *rd)
{
    const satellite *sat = &rd->s->satellite;
    char name[80];
    for (size_t k = 0; k < rd->n_overrides; k++) {
        bool found = !named_by(rd->overrides[k], name);
        for (int m = 0; m < sat->n_materials && !found; m++)
            found = string_equal(sat->materials[m].name, name);
        if (!found)
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, PLACE_NONE,
                                        "--set '%s': there is no material '%s'", rd->overrides[k],
                                        name));
    }
}

static void read_materials_file(reading *rd, const toml_node *file)
{
    if (file->type != TOML_STRING) {
        reading_note(rd, errors_add(rd->errors, GLINT_INPUT, file->where,
                                    "found %s; expected the path of a file of materials",
                                    toml_type_name(file->type)));
        return;
    }
    char *path = reading_path(rd, file);
    toml_document *document = path ? reading_open(rd, path, file->where) : NULL;
    free(path);
    if (!document) return;
    override_materials(rd, document);
    reader r = reader_start(&document->root, "the file of materials", rd->errors);
    reader_has(&r, "title");
    const toml_node *tables = reader_table(&r, "materials", true);
    if (tables) add_materials(rd, tables);
    reading_done(rd, &r);
}

void read_materials(reading *rd, reader *r)
{
    const toml_node *files =
        reader_get(r, "materials_from", TOML_ARRAY, false, "a list of paths of files");
    for (int i = 0; files && i < files->n_children; i++)
        read_materials_file(rd, &files->children[i]);
    const toml_node *tables = reader_table(r, "materials", false);
    if (tables) add_materials(rd, tables);
    if (rd->status == GLINT_OK) refuse_lost_overrides(rd);
    measured_cache_free(&rd->tables);
}

/* ---------------------------------------------------------------- warnings */

/* The effective slope of a Ward lobe along one axis: alpha / (k lambda). */
static double effective_slope(const brdf_lobe *lobe, const char *name)
{
    const int a = param_index(lobe->model, name);
    const int k = param_index(lobe->model, "k_per_um");
    const int w = param_index(lobe->model, "wavelength_um");
    if (a < 0 || k < 0 || w < 0) return 0;
    const double kl = isnan(lobe->params[k]) ? 1.0 : lobe->params[k] * lobe->params[w];
    return lobe->params[a] / kl;
}

static const double APART = 1.5; /* ratio of wavelengths past which another band is meant */

/* Warns once of a material far from where it holds, in a band for which it has no keys. */
static void warn_of_wavelength(reading *rd, const scenario_material *material,
                               const band_info *band, bool *said)
{
    const double *um = material->holds_um;
    if (!band || !(um[0] > 0) || *said) return;
    if (band->pivot_um >= um[0] / APART && band->pivot_um <= um[1] * APART) return;
    if (band_overlay(rd, material->table, band->name, false)) return;
    *said = true;
    if (um[1] > um[0])
        errors_warn(rd->errors, material->where,
                    "material '%s' has parameters that hold from %g to %g um and is used in band "
                    "%s (%.3g um)",
                    material->name, um[0], um[1], band->name, band->pivot_um);
    else
        errors_warn(rd->errors, material->where,
                    "material '%s' has parameters that hold at %g um and is used in band %s (%.3g "
                    "um)",
                    material->name, um[0], band->name, band->pivot_um);
}

static void warn_of_lobe(reading *rd, const scenario_material *material, const brdf_lobe *lobe,
                         const band_info *band, bool *said_wavelength)
{
    static const double STEEP = 0.5; /* the lobe has lost a third of its energy (physics page, 3) */
    if (!(lobe->model->flags & BRDF_WAVELENGTH)) return;
    const double slope = fmax(effective_slope(lobe, "alpha_x"), effective_slope(lobe, "alpha_y"));
    if (slope > STEEP)
        errors_warn(rd->errors, material->where,
                    "material '%s' has an effective slope alpha/(k lambda) of %.3g%s%s; "
                    "above 0.5 this lobe loses more than a third of its energy",
                    material->name, slope, band ? " in band " : "", band ? band->name : "");
    const double um = lobe->params[param_index(lobe->model, "wavelength_um")];
    if (!band || isnan(um) || *said_wavelength) return;
    const double ratio = um > band->pivot_um ? um / band->pivot_um : band->pivot_um / um;
    if (ratio > APART) {
        errors_warn(rd->errors, material->where,
                    "material '%s' has parameters that hold at %g um and is used in band %s "
                    "(%.3g um)",
                    material->name, um, band->name, band->pivot_um);
        *said_wavelength = true;
    }
}

/* Whether the material is in band b what it is in one before: it is warned of once. */
static bool is_repeated(const scenario_material *material, int b)
{
    for (int before = 0; before < b; before++)
        if (brdf_material_same(&material->bands[before], &material->bands[b])) return true;
    return false;
}

/* Warns of a material that reflects more than it gets in band b. */
static void warn_of_energy(reading *rd, const scenario_material *material, int b)
{
    brdf_energy worst;
    if (!brdf_energy_gain(&material->bands[b], &worst)) return;
    const band_info *band = rd->s->bands[b];
    errors_warn(rd->errors, material->where,
                "material '%s' reflects more than it gets%s%s: %.4g times the light that comes at "
                "%g deg from the normal",
                material->name, band ? " in band " : "", band ? band->name : "", worst.dhr,
                worst.theta_i / DEG);
}

/* Warns where a spectrum does not reach a band. lobe: a table with the keys of one lobe. */
static void warn_of_spectrum(reading *rd, const scenario_material *material, const toml_node *lobe,
                             const toml_node *overlay, const band_info *band)
{
    spectrum_use use;
    if (!band || !spectrum_used(lobe, overlay, band, &use) || !use.outside) return;
    errors_warn(rd->errors, toml_child(lobe, "spectrum")->where,
                "the spectrum of material '%s' reaches from %g to %g um; in band %s (%.3g um) the "
                "numbers of the nearest wavelength are taken",
                material->name, use.lowest_um, use.highest_um, band->name, band->pivot_um);
}

static void warn_of_spectra(reading *rd, const scenario_material *material, const band_info *band)
{
    const toml_node *overlay = band ? band_overlay(rd, material->table, band->name, false) : NULL;
    warn_of_spectrum(rd, material, material->table, overlay, band);
    const toml_node *parts = overlay ? toml_child(overlay, "parts") : NULL;
    if (!parts) parts = toml_child(material->table, "parts");
    for (int k = 0; parts && k < parts->n_children; k++)
        warn_of_spectrum(rd, material, &parts->children[k], NULL, band);
}

void refuse_mirrors(reading *rd)
{
    const glint_scenario *s = rd->s;
    if (s->solar_disc != SOLAR_POINT) return;
    for (int m = 0; m < s->satellite.n_materials; m++) {
        const scenario_material *material = &s->satellite.materials[m];
        bool found = false;
        for (int b = 0; b < s->n_bands && !found; b++)
            for (int l = 0; l < material->bands[b].n_lobes; l++)
                found = found || material->bands[b].lobes[l].model->specular;
        if (found)
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, material->where,
                                        "material '%s' is a perfect mirror, which shows the Sun's "
                                        "disc, and the Sun is a point here (solar_disc = "
                                        "\"point\"); expected solar_disc = \"uniform\", or a "
                                        "narrow lobe such as brdf = \"ward-gmd\"",
                                        material->name));
    }
}

void warn_of_materials(reading *rd)
{
    const glint_scenario *s = rd->s;
    for (int m = 0; m < s->satellite.n_materials; m++) {
        const scenario_material *material = &s->satellite.materials[m];
        bool said_wavelength = false;
        for (int b = 0; b < s->n_bands; b++) {
            warn_of_wavelength(rd, material, s->bands[b], &said_wavelength);
            for (int l = 0; l < material->bands[b].n_lobes; l++)
                warn_of_lobe(rd, material, &material->bands[b].lobes[l], s->bands[b],
                             &said_wavelength);
            warn_of_spectra(rd, material, s->bands[b]);
            if (is_repeated(material, b)) continue;
            warn_of_energy(rd, material, b);
            warn_of_measured(&material->bands[b], material->name, material->where, rd->errors);
        }
    }
}
