/* read_scenario.c: a scenario as a whole: its documents with their overrides, the order in which
 * its tables are read, [satellite] and [output], and its end. */
#include "base/constants.h"
#include "base/text.h"
#include "scenario/read_material.h"
#include "scenario/reading.h"

#include <stdlib.h>
#include <string.h>

void reading_note(reading *rd, glint_status status)
{
    if (status > rd->status) rd->status = status;
}

void reading_done(reading *rd, reader *r)
{
    reading_note(rd, reader_done(r));
}

void reading_no_memory(reading *rd)
{
    reading_note(rd, errors_add(rd->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory"));
}

toml_document *reading_open(reading *rd, const char *path, place asked_from)
{
    glint_scenario *s = rd->s;
    toml_document **documents =
        realloc(s->documents, (size_t)(s->n_documents + 1) * sizeof *documents);
    if (!documents) {
        reading_no_memory(rd);
        return NULL;
    }
    s->documents = documents;
    toml_document *document;
    const glint_status status = toml_read(path, asked_from, &document, rd->errors);
    reading_note(rd, status);
    if (status) return NULL;
    documents[s->n_documents++] = document;
    return document;
}

char *reading_path(reading *rd, const toml_node *node)
{
    char *path = path_beside(node->where.file, node->string);
    if (!path || !file_list_add(&rd->s->files, path)) reading_no_memory(rd);
    return path;
}

moment_text reading_moment(const glint_scenario *s, double t_s)
{
    moment_text out = {""};
    double tt_jd[2];
    run_clock_tt(&s->clock, t_s, tt_jd);
    tt_write_utc(tt_jd, out.utc);
    return out;
}

/* True when a "key=value" names a key of a model: materials, materials_from, component. */
static bool belongs_to_model(const char *assignment)
{
    static const char *const KEYS[] = {"materials", "materials_from", "component"};
    const size_t n = strcspn(assignment, ".= \t");
    for (size_t k = 0; k < sizeof KEYS / sizeof *KEYS; k++)
        if (strlen(KEYS[k]) == n && strncmp(KEYS[k], assignment, n) == 0) return true;
    return false;
}

typedef enum override_choice { OVERRIDE_ALL, OVERRIDE_MODEL, OVERRIDE_OTHERS } override_choice;

static void apply_overrides(reading *rd, toml_document *document, override_choice which)
{
    for (size_t k = 0; k < rd->n_overrides; k++) {
        const bool for_model = belongs_to_model(rd->overrides[k]);
        if (for_model && reading_override_waits(document, rd->overrides[k])) continue;
        if (which == OVERRIDE_ALL || for_model == (which == OVERRIDE_MODEL))
            reading_note(rd, toml_override(document, rd->overrides[k], rd->errors));
    }
}

/* ---------------------------------------------------------- [satellite] */

/* How shadows between parts are found; the keys that go with one way are refused with another. */
static void read_shadows(glint_scenario *s, reader *r)
{
    static const char *const SHADOWS[] = {"exact", "none", "interpolated", "rays"};
    static const param_info STEP = {
        "shadow_step_deg", "deg", "motion between exact shadows", 0.001, 10, 1, 0};
    int shadows;
    int64_t rays;
    double step_deg;
    reader_choice(r, "self_shadows", SHADOWS, 4, SHADOWS_EXACT, &shadows);
    const bool has_step = reader_param(r, &STEP, &step_deg);
    const bool has_rays = reader_integer(r, "rays_per_facet", false, 1, VISIBILITY_MOST_RAYS,
                                         DEFAULT_RAYS_PER_FACET, &rays);
    s->self_shadows = (self_shadows)shadows;
    s->shadow_step = step_deg * DEG;
    s->rays_per_facet = (int)rays;
    if (has_step && shadows != SHADOWS_INTERPOLATED)
        reader_fail(r, reader_place(r, STEP.name),
                    "shadow_step_deg goes with self_shadows = \"interpolated\" only; expected "
                    "that, or no shadow_step_deg");
    if (has_rays && shadows != SHADOWS_RAYS)
        reader_fail(r, reader_place(r, "rays_per_facet"),
                    "rays_per_facet goes with self_shadows = \"rays\" only; expected that, or no "
                    "rays_per_facet");
    if (shadows == SHADOWS_RAYS && !visibility_has_rays())
        reader_fail(r, reader_place(r, "self_shadows"),
                    "self_shadows = \"rays\" takes Embree 3, without which this glint was built; "
                    "expected \"exact\", \"interpolated\" or \"none\", or a glint built with "
                    "libembree-dev");
}

static void read_satellite(reading *rd, reader *root)
{
    const toml_node *table = reader_table(root, "satellite", false);
    const bool tables_here = reader_has(root, "component") || reader_has(root, "materials") ||
                             reader_has(root, "materials_from");
    const toml_node *named = NULL;
    if (table) {
        reader r = reader_start(table, "[satellite]", rd->errors);
        named = reader_get(&r, "model", TOML_STRING, false, "the path of a model file");
        read_shadows(rd->s, &r);
        if (named && tables_here)
            reader_fail(&r, named->where,
                        "both a model file and a model's tables in this file are given; expected "
                        "one of them");
        else if (!reader_has(&r, "model") && !tables_here)
            reader_fail(&r, table->where,
                        "[satellite] has no 'model' and this file has no [[component]]; expected "
                        "one of them");
        reading_done(rd, &r);
    } else if (!tables_here) {
        reader_fail(root, root->table->where,
                    "there is no satellite; expected [satellite] with a model, or [[component]] "
                    "tables");
    }
    if (!named || tables_here) {
        if (tables_here) read_model_tables(rd, root);
        return;
    }
    char *path = reading_path(rd, named);
    toml_document *document = path ? reading_open(rd, path, named->where) : NULL;
    free(path);
    if (!document) return;
    apply_overrides(rd, document, OVERRIDE_MODEL);
    reader r = reader_start(&document->root, "the model file", rd->errors);
    reader_has(&r, "title");
    read_model_tables(rd, &r);
    reading_done(rd, &r);
}

/* ------------------------------------------------------------- [output] */

/* True also where the observers could not be read. */
static bool any_site(const glint_scenario *s)
{
    for (int i = 0; i < s->n_observers; i++)
        if (s->observers[i].kind == OBSERVER_SITE) return true;
    return s->n_observers == 0;
}

static void read_output(reading *rd, reader *root)
{
    static const char *const ROWS[] = {"all", "visible", "dark-site"};
    static const char *const SHARES[] = {"none", "material", "component", "both"};
    static const char *const STANDARDS[] = {"none", "phase90", "phase0", "both"};
    static const param_info SUN = {
        "sun_elevation_max_deg", "deg", "a dark site has the Sun below", -90, 90, -6, 0};
    glint_scenario *s = rd->s;
    s->sun_elevation_max = -6 * DEG;
    s->shares = SHARES_MATERIAL;
    s->moon_columns = false;
    const toml_node *table = reader_table(root, "output", false);
    if (!table) return;
    reader r = reader_start(table, "[output]", rd->errors);
    int rows, shares, standard;
    double sun_deg;
    reader_choice(&r, "rows", ROWS, 3, 0, &rows);
    reader_choice(&r, "shares", SHARES, 4, 1, &shares);
    reader_choice(&r, "standard_magnitudes", STANDARDS, 4, 0, &standard);
    reader_param(&r, &SUN, &sun_deg);
    reader_boolean(&r, "moon", false, &s->moon_columns);
    s->rows = (rows_choice)rows;
    s->shares = (unsigned)shares;     /* 1 material, 2 component, 3 both */
    s->standard = (unsigned)standard; /* 1 at 90 deg, 2 at 0 deg, 3 both */
    s->sun_elevation_max = sun_deg * DEG;
    if (s->has_geometry && s->rows != ROWS_ALL)
        reader_fail(&r, reader_place(&r, "rows"),
                    "directions given by [geometry] have no site; expected rows = \"all\"");
    if (s->has_geometry && s->moon_columns)
        reader_fail(&r, reader_place(&r, "moon"),
                    "directions given by [geometry] have no Moon; expected moon = false");
    if (!s->has_geometry && s->rows == ROWS_DARK_SITE && !any_site(s))
        reader_fail(&r, reader_place(&r, "rows"),
                    "no observer is a site that could be dark; expected rows = \"visible\"");
    reading_done(rd, &r);
}

/* --------------------------------------------------------------- the whole */

/* The tables that only make sense where positions are computed. */
static void refuse_with_geometry(reader *root)
{
    static const char *const KEYS[] = {"time", "observer", "orbit", "attitude", "corrections"};
    for (size_t k = 0; k < sizeof KEYS / sizeof *KEYS; k++) {
        const toml_node *node = reader_find(root, KEYS[k]);
        if (node)
            reader_fail(root, node->key_where,
                        "[%s] stands beside [geometry], which gives the directions itself; "
                        "expected one of them",
                        KEYS[k]);
    }
}

static bool wants_moon(const glint_scenario *s)
{
    for (int c = 0; c < s->satellite.n_components; c++)
        if (s->satellite.components[c].has_hinge &&
            s->satellite.components[c].hinge.drive == HINGE_TRACK &&
            s->satellite.components[c].hinge.target.kind == DIRECTION_MOON)
            return true;
    return attitude_plan_wants(&s->attitude, DIRECTION_MOON);
}

/* Observers that are fixed in the body need its attitude, which must not look for them in turn. */
static void check_body_directions(reading *rd)
{
    const glint_scenario *s = rd->s;
    for (int i = 0; i < s->n_observers && rd->status == GLINT_OK; i++) {
        const scenario_observer *o = &s->observers[i];
        if (o->kind != OBSERVER_DIRECTION || !o->in_body) continue;
        if (!s->has_attitude)
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, o->where,
                                        "the observer is fixed in the body frame, and there is no "
                                        "[attitude]; expected one"));
        else if (attitude_plan_wants(&s->attitude, DIRECTION_OBSERVER))
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, o->where,
                                        "the observer is fixed in the body frame, and the attitude "
                                        "follows the observer; expected one of them"));
    }
}

static bool names_satellite(reader *root)
{
    /* all are asked for, so that all are known */
    const bool table = reader_has(root, "satellite"), component = reader_has(root, "component"),
               materials = reader_has(root, "materials"), from = reader_has(root, "materials_from");
    return table || component || materials || from;
}

static void read_all(reading *rd, toml_document *document)
{
    glint_scenario *s = rd->s;
    reader root = reader_start(&document->root, "the scenario", rd->errors);
    s->title = "";
    reader_string(&root, "title", false, &s->title);
    const toml_node *geometry = reader_table(&root, "geometry", false);
    s->has_geometry = reader_has(&root, "geometry");
    read_photometry(rd, &root);
    if (s->has_geometry) {
        refuse_with_geometry(&root);
        if (geometry) read_geometry(rd, geometry);
    } else {
        read_corrections(rd, &root);
        read_time(rd, &root);
        read_observers(rd, &root);
        const toml_node *orbit_node = reader_table(&root, "orbit", true);
        if (orbit_node) read_orbit(rd, orbit_node, "[orbit]", &s->orbit);
        s->has_attitude = !rd->orbit_only || reader_has(&root, "attitude");
        if (s->has_attitude) read_attitude(rd, &root);
        check_body_directions(rd);
    }
    read_telescope(rd, &root);
    read_output(rd, &root);
    s->has_satellite = !rd->orbit_only || names_satellite(&root);
    if (s->has_satellite) read_satellite(rd, &root);
    if (rd->status == GLINT_OK) refuse_mirrors(rd);
    if (rd->status == GLINT_OK && s->has_satellite) make_earthshine(rd);
    s->needs_moon = !s->has_geometry && rd->status == GLINT_OK && wants_moon(s);
    read_expectations(rd, &root);
    read_observed(rd, &root);
    reading_done(rd, &root);
}

/* A scenario that holds the document at `path`, overrides applied; NULL on error. */
static glint_scenario *start(const char *path, reading *rd, toml_document **document)
{
    rd->s = calloc(1, sizeof *rd->s);
    if (!rd->s) {
        reading_no_memory(rd);
        return NULL;
    }
    rd->tables.files = &rd->s->files;
    *document = reading_open(rd, path, PLACE_NONE);
    if (!*document) return NULL;
    rd->s->text = string_copy((*document)->text, strlen((*document)->text));
    rd->s->overrides = calloc(rd->n_overrides + 1, sizeof *rd->s->overrides);
    if (!rd->s->text || !rd->s->overrides || !file_list_add(&rd->s->files, path)) {
        reading_no_memory(rd);
        return NULL;
    }
    for (size_t k = 0; k < rd->n_overrides; k++) {
        char *copy = string_copy(rd->overrides[k], strlen(rd->overrides[k]));
        if (!copy) {
            reading_no_memory(rd);
            return NULL;
        }
        rd->s->overrides[rd->s->n_overrides++] = copy;
    }
    return rd->s;
}

static bool has_model_file(const toml_document *document)
{
    const toml_node *table = toml_child(&document->root, "satellite");
    return table && toml_child(table, "model");
}

static glint_status finish(reading *rd, size_t first_error, glint_scenario **out)
{
    errors_sort(rd->errors, first_error);
    if (rd->status) {
        glint_scenario_free(rd->s);
        rd->s = NULL;
    }
    *out = rd->s;
    return rd->status;
}

static glint_status read_scenario(const char *path, reading *rd, glint_scenario **out)
{
    const size_t first_error = glint_errors_count(rd->errors);
    toml_document *document;
    *out = NULL;
    if (start(path, rd, &document)) {
        apply_overrides(rd, document, OVERRIDE_OTHERS);
        if (!has_model_file(document)) apply_overrides(rd, document, OVERRIDE_MODEL);
        if (!rd->status && scenario_is_model(document))
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, document->root.where,
                                        "this is a model file, not a scenario: it has no [time] "
                                        "and no [geometry]; expected a scenario (a model can be "
                                        "looked at with 'glint check')"));
        else if (!rd->status)
            read_all(rd, document);
    }
    return finish(rd, first_error, out);
}

glint_status glint_scenario_read(const char *path, const char *const *overrides, size_t n_overrides,
                                 glint_scenario **out, glint_errors *errors)
{
    reading rd = {.overrides = overrides, .n_overrides = n_overrides, .errors = errors};
    return read_scenario(path, &rd, out);
}

glint_status glint_scenario_read_orbit(const char *path, const char *const *overrides,
                                       size_t n_overrides, glint_scenario **out,
                                       glint_errors *errors)
{
    reading rd = {
        .overrides = overrides, .n_overrides = n_overrides, .errors = errors, .orbit_only = true};
    return read_scenario(path, &rd, out);
}

glint_status scenario_read_surfaces(const char *path, const char *const *overrides,
                                    size_t n_overrides, const glint_changes *changes,
                                    glint_scenario **out, glint_errors *errors)
{
    reading rd = {.overrides = overrides,
                  .n_overrides = n_overrides,
                  .errors = errors,
                  .by_surface = true,
                  .changes = changes};
    const glint_status status = read_scenario(path, &rd, out);
    if (!status) (*out)->shares = SHARES_MATERIAL | SHARES_COMPONENT;
    return status;
}

glint_status scenario_read_model(const char *path, const char *const *overrides, size_t n_overrides,
                                 glint_scenario **out, glint_errors *errors)
{
    reading rd = {.overrides = overrides, .n_overrides = n_overrides, .errors = errors};
    const size_t first_error = glint_errors_count(errors);
    toml_document *document;
    *out = NULL;
    if (start(path, &rd, &document)) {
        apply_overrides(&rd, document, OVERRIDE_ALL);
        reader r = reader_start(&document->root, "the model file", errors);
        rd.s->title = "";
        reader_string(&r, "title", false, &rd.s->title);
        rd.s->n_bands = 1;
        rd.s->bands[0] = band_named("V");
        read_model_tables(&rd, &r);
        reading_done(&rd, &r);
    }
    return finish(&rd, first_error, out);
}

bool glint_scenario_reads(const glint_scenario *s, const char *path)
{
    return file_list_has(&s->files, path);
}

bool scenario_is_model(const toml_document *document)
{
    const toml_node *root = &document->root;
    return !toml_child(root, "time") && !toml_child(root, "geometry") &&
           !toml_child(root, "observer") && !toml_child(root, "orbit") &&
           !toml_child(root, "satellite") &&
           (toml_child(root, "component") || toml_child(root, "materials"));
}

static void expectations_free(glint_scenario *s)
{
    for (int i = 0; i < s->n_requirements; i++)
        free(s->requirements[i].when);
    free(s->requirements);
    free(s->expectations);
    csv_free(&s->expected.csv);
    free(s->expected.columns);
    free(s->expected.absolute);
    free(s->expected.relative);
}

void glint_scenario_free(glint_scenario *s)
{
    if (!s) return;
    expectations_free(s);
    observed_free(&s->observed);
    earth_light_free(&s->earth, s->n_bands);
    satellite_free(&s->satellite);
    scenario_orbit_free(&s->orbit);
    attitude_plan_free(&s->attitude);
    observers_free(s);
    eop_free(s->eop);
    free(s->geometry.sun);
    free(s->geometry.observer);
    free(s->geometry.range_m);
    free(s->geometry.t_s);
    for (size_t k = 0; k < s->n_overrides; k++)
        free(s->overrides[k]);
    free(s->overrides);
    free(s->text);
    for (int i = 0; i < s->n_documents; i++)
        toml_free(s->documents[i]);
    free(s->documents);
    file_list_free(&s->files);
    free(s);
}
