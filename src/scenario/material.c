/* material.c: one material by itself, apart from scenario and model: glint_material. */
#include "base/text.h"
#include "brdf/dhr.h"
#include "brdf/peak.h"
#include "brdf/table.h"
#include "scenario/read_material.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A material is kept as a scenario that has nothing but it, in one band (or none: NULL), so that it
 * is read as all materials are. */
struct glint_material {
    glint_scenario *scenario; /* owned */
    text model;               /* owned */
};

/* The [materials.NAME] tables of a file, in the order in which a model would take them. */
typedef struct table_list {
    const toml_node **items; /* owned array; of documents that the scenario owns */
    size_t n;
} table_list;

static bool is_known(const table_list *list, const char *name)
{
    for (size_t k = 0; k < list->n; k++)
        if (string_equal(list->items[k]->key, name)) return true;
    return false;
}

/* Adds the tables of one [materials]. */
static void add_tables(reading *rd, const toml_node *materials, table_list *list)
{
    const size_t most = list->n + (size_t)materials->n_children + 1;
    const toml_node **items = realloc(list->items, most * sizeof *items);
    if (!items) {
        reading_no_memory(rd);
        return;
    }
    list->items = items;
    for (int i = 0; i < materials->n_children; i++) {
        const toml_node *table = &materials->children[i];
        if (table->type != TOML_TABLE) {
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, table->where,
                                        "'%.60s' is %s; expected a table [materials.NAME]",
                                        table->key, toml_type_name(table->type)));
        } else if (is_known(list, table->key)) {
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, table->key_where,
                                        "material '%.60s' stands twice; expected another name",
                                        table->key));
        } else if (reading_good_name(rd, "material", table->key, table->key_where)) {
            list->items[list->n++] = table;
        }
    }
}

static void add_document(reading *rd, const toml_document *document, table_list *list)
{
    reader r = reader_start(&document->root, "the file", rd->errors);
    const toml_node *materials = reader_table(&r, "materials", false);
    reading_note(rd, r.status);
    if (materials) add_tables(rd, materials, list);
}

/* The tables of a file and, before them, of those in its materials_from. */
static void find_tables(reading *rd, const char *path, table_list *list)
{
    const toml_document *document = reading_open(rd, path, PLACE_NONE);
    if (!document) return;
    reader r = reader_start(&document->root, "the file", rd->errors);
    const toml_node *files =
        reader_get(&r, "materials_from", TOML_ARRAY, false, "a list of paths of files");
    reading_note(rd, r.status);
    for (int i = 0; files && i < files->n_children; i++) {
        const toml_node *file = &files->children[i];
        char *named = file->type == TOML_STRING ? reading_path(rd, file) : NULL;
        if (file->type != TOML_STRING)
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, file->where,
                                        "found %s; expected the path of a file of materials",
                                        toml_type_name(file->type)));
        const toml_document *other = named ? reading_open(rd, named, file->where) : NULL;
        free(named);
        if (other) add_document(rd, other, list);
    }
    add_document(rd, document, list);
    if (rd->status == GLINT_OK && list->n == 0)
        reading_note(rd,
                     errors_add(rd->errors, GLINT_INPUT, (place){path, 0, 0},
                                "there are no materials here; expected [materials.NAME] tables, "
                                "as in a file of materials or a model"));
}

/* ------------------------------------------------------------------- names */

/* The names in one block: the pointers, and behind them the letters. */
static const char **copy_names(const table_list *list)
{
    size_t letters = 0;
    for (size_t k = 0; k < list->n; k++)
        letters += strlen(list->items[k]->key) + 1;
    const char **names = malloc(list->n * sizeof *names + letters);
    if (!names) return NULL;
    char *to = (char *)(names + list->n);
    for (size_t k = 0; k < list->n; k++) {
        const size_t size = strlen(list->items[k]->key) + 1;
        memcpy(to, list->items[k]->key, size);
        names[k] = to;
        to += size;
    }
    return names;
}

glint_status glint_material_names(const char *path, const char ***names, size_t *n,
                                  glint_errors *errors)
{
    *names = NULL;
    *n = 0;
    reading rd = {.s = calloc(1, sizeof *rd.s), .errors = errors};
    table_list list = {0};
    const size_t first_error = glint_errors_count(errors);
    if (rd.s)
        find_tables(&rd, path, &list);
    else
        reading_no_memory(&rd);
    if (rd.status == GLINT_OK) {
        *names = copy_names(&list);
        if (*names)
            *n = list.n;
        else
            reading_no_memory(&rd);
    }
    free(list.items);
    glint_scenario_free(rd.s);
    errors_sort(errors, first_error);
    return rd.status;
}

/* ----------------------------------------------------------------- reading */

static const toml_node *table_named(reading *rd, const char *path, const char *name,
                                    const table_list *list)
{
    const char **names = calloc(list->n + 1, sizeof *names);
    text all = {0};
    for (size_t k = 0; k < list->n; k++) {
        if (string_equal(list->items[k]->key, name)) {
            free(names);
            text_free(&all);
            return list->items[k];
        }
        if (names) names[k] = list->items[k]->key;
        text_printf(&all, "%s%s", k ? ", " : "", list->items[k]->key);
    }
    const char *near = names ? nearest_name(name, names, list->n) : NULL;
    reading_note(rd, errors_add(rd->errors, GLINT_INPUT, (place){path, 0, 0},
                                "there is no material '%.60s'%s%s%s; expected one of: %s", name,
                                near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "",
                                all.data ? all.data : ""));
    free(names);
    text_free(&all);
    return NULL;
}

/* "ward rho_d=0.17 ...", or the weighted parts of a sum. */
static void describe(const brdf_material *material, text *t)
{
    for (int k = 0; k < material->n_lobes; k++) {
        const brdf_lobe *lobe = &material->lobes[k];
        if (material->n_lobes > 1) text_printf(t, "%s%g * ", k ? " + " : "", lobe->weight);
        text_add(t, lobe->model->name);
        for (int j = 0; j < lobe->model->n_params; j++) {
            if (lobe->model->params[j].flags & PARAM_ROWS)
                text_printf(t, " %s=(%d x %d)", lobe->model->params[j].name, lobe->arrays[j].rows,
                            lobe->arrays[j].columns);
            if (isnan(lobe->params[j])) continue; /* not given, or an array */
            text_printf(t, " %s=", lobe->model->params[j].name);
            text_double(t, lobe->params[j]);
        }
    }
}

/* Reads the material's table into a scenario that has nothing else. */
static void read_alone(reading *rd, const toml_node *table, glint_material *out)
{
    satellite *sat = &rd->s->satellite;
    sat->materials = calloc(1, sizeof *sat->materials);
    if (!sat->materials) {
        reading_no_memory(rd);
        return;
    }
    sat->n_materials = 1;
    read_material(rd, table, &sat->materials[0]);
    measured_cache_free(&rd->tables);
    if (rd->status) return;
    warn_of_materials(rd);
    describe(&sat->materials[0].bands[0], &out->model);
    if (out->model.failed) reading_no_memory(rd);
}

static glint_status find_band(const char *name, const band_info **out, glint_errors *errors)
{
    *out = name ? band_named(name) : NULL;
    if (!name || *out) return GLINT_OK;
    return errors_add(
        errors, GLINT_ARGUMENT, PLACE_NONE,
        "'%.40s' is not a band; expected U, B, V, R, I, sdss_u to sdss_z, or lsst_u to "
        "lsst_y",
        name);
}

glint_status glint_material_read(const char *path, const char *name, const char *band,
                                 glint_material **out, glint_errors *errors)
{
    *out = NULL;
    const band_info *found_band;
    const glint_status status = find_band(band, &found_band, errors);
    if (status) return status;
    glint_material *material = calloc(1, sizeof *material);
    reading rd = {.s = calloc(1, sizeof *rd.s), .errors = errors};
    if (!material || !rd.s) {
        free(material);
        free(rd.s);
        return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    }
    material->scenario = rd.s;
    rd.s->n_bands = 1;
    rd.s->bands[0] = found_band;
    const size_t first_error = glint_errors_count(errors);
    table_list list = {0};
    find_tables(&rd, path, &list);
    const toml_node *table = rd.status ? NULL : table_named(&rd, path, name, &list);
    if (table) read_alone(&rd, table, material);
    free(list.items);
    errors_sort(errors, first_error);
    if (rd.status)
        glint_material_free(material);
    else
        *out = material;
    return rd.status;
}

void glint_material_free(glint_material *material)
{
    if (!material) return;
    glint_scenario_free(material->scenario);
    text_free(&material->model);
    free(material);
}

/* -------------------------------------------------------------- what it is */

static const scenario_material *inside(const glint_material *material)
{
    return &material->scenario->satellite.materials[0];
}

const brdf_material *material_function(const glint_material *material)
{
    return &inside(material)->bands[0];
}

const char *glint_material_name(const glint_material *material)
{
    return inside(material)->name;
}

const char *glint_material_band(const glint_material *material)
{
    const band_info *band = material->scenario->bands[0];
    return band ? band->name : "";
}

const char *glint_material_source(const glint_material *material)
{
    return inside(material)->source;
}

const char *glint_material_model(const glint_material *material)
{
    return material->model.data;
}

static void angles_to_unit(double theta, double phi, double out[3])
{
    out[0] = sin(theta) * cos(phi);
    out[1] = sin(theta) * sin(phi);
    out[2] = cos(theta);
}

glint_status glint_material_brdf(const glint_material *material, double theta_i, double phi_i,
                                 double theta_r, double phi_r, double *f, glint_error *error)
{
    if (!isfinite(theta_i) || !isfinite(phi_i) || !isfinite(theta_r) || !isfinite(phi_r))
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "an angle is not finite; expected four angles in rad");
    double i[3], r[3];
    angles_to_unit(theta_i, phi_i, i);
    angles_to_unit(theta_r, phi_r, r);
    const bool lit_and_seen = i[2] > BRDF_EDGE && r[2] > BRDF_EDGE;
    *f = lit_and_seen ? brdf_material_eval(&inside(material)->bands[0], i, r) / (i[2] * r[2]) : 0;
    return GLINT_OK;
}

bool glint_material_covers(const glint_material *material, double theta_i, double phi_i,
                           double theta_r, double phi_r)
{
    const brdf_material *function = &inside(material)->bands[0];
    double i[3], r[3];
    angles_to_unit(theta_i, phi_i, i);
    angles_to_unit(theta_r, phi_r, r);
    for (int k = 0; k < function->n_lobes; k++) {
        const brdf_lobe *lobe = &function->lobes[k];
        if (lobe->model->flags & BRDF_MEASURED && lobe->weight != 0.0 && !table_covers(lobe, i, r))
            return false;
    }
    return true;
}

double glint_material_mirrored(const glint_material *material, double theta_i)
{
    const double ci = cos(theta_i);
    if (!(theta_i >= 0.0 && ci > BRDF_EDGE)) return 0.0;
    return brdf_material_specular(&inside(material)->bands[0], ci);
}

glint_status glint_material_dhr(const glint_material *material, double theta_i, double phi_i,
                                double *dhr, double *error_bound, glint_error *error)
{
    /* relative; measured values are good to a percent, and their table is dear and not smooth */
    static const double TOLERANCE = 1e-8, OF_MEASURED = 1e-5;
    if (!isfinite(theta_i) || !isfinite(phi_i))
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "an angle is not finite; expected two angles in rad");
    const brdf_material *function = &inside(material)->bands[0];
    const double tolerance = brdf_material_is_measured(function) ? OF_MEASURED : TOLERANCE;
    return brdf_dhr(function, theta_i, phi_i, tolerance, dhr, error_bound, error);
}

bool glint_material_peak(const glint_material *material, double theta_i, double phi_i,
                         double *theta_r, double *f)
{
    return brdf_peak(&inside(material)->bands[0], theta_i, phi_i, theta_r, f);
}
