/* read_model.c: the tables of a model: components, their hinges and primitives. */
#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "brdf/sharpness.h"
#include "scenario/read_material.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Most facets of one satellite: 20 million take about 5 GB. */
enum { MOST_FACETS = 20000000 };

void satellite_free(satellite *sat)
{
    for (int m = 0; m < sat->n_materials; m++)
        scenario_material_free(&sat->materials[m]);
    free(sat->materials);
    for (int c = 0; c < sat->n_components; c++) {
        hinge_free(&sat->components[c].hinge);
        free(sat->components[c].report);
    }
    free(sat->components);
    free(sat->order);
    model_free(&sat->model);
    free(sat->model_materials);
    free(sat->model_components);
    *sat = (satellite){0};
}

/* ------------------------------------------------------------- primitives */

static int named_material(reading *rd, reader *r, const toml_node *node)
{
    satellite *sat = &rd->s->satellite;
    const char **names = calloc((size_t)sat->n_materials + 1, sizeof *names);
    for (int m = 0; names && m < sat->n_materials; m++) {
        names[m] = sat->materials[m].name;
        if (string_equal(names[m], node->string)) {
            sat->materials[m].used = true;
            free(names);
            return m;
        }
    }
    const char *near = names ? nearest_name(node->string, names, (size_t)sat->n_materials) : NULL;
    reader_fail(r, node->where,
                "there is no material '%.60s'%s%s%s; expected the name of a [materials.NAME] table",
                node->string, near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
    free(names);
    return PRIMITIVE_NO_MATERIAL;
}

static void read_faces(reading *rd, reader *r, const char *key, primitive_spec *spec)
{
    static const char *const FACES[6] = {"+x", "-x", "+y", "-y", "+z", "-z"};
    const toml_node *table = reader_table(r, key, false);
    if (!table) return;
    reader inner = reader_start(table, key, rd->errors);
    for (int f = 0; f < 6; f++) {
        const toml_node *node =
            reader_get(&inner, FACES[f], TOML_STRING, false, "the name of a material");
        if (node) spec->face_material[f] = named_material(rd, &inner, node);
    }
    const glint_status status = reader_done(&inner);
    if (status > r->status) r->status = status;
}

/* Names of a file's own, and the materials that they stand for. */
static void read_names(reading *rd, reader *r, const char *key, primitive_spec *spec)
{
    const toml_node *table = reader_table(r, key, false);
    if (!table || table->n_children == 0) return;
    spec->names = calloc((size_t)table->n_children, sizeof *spec->names);
    if (!spec->names) {
        r->status = errors_no_memory(r->errors);
        return;
    }
    for (int i = 0; i < table->n_children; i++) {
        const toml_node *node = &table->children[i];
        if (node->type != TOML_STRING) {
            reader_fail(r, node->where, "'%.60s' in %s is %s; expected the name of a material",
                        node->key, key, toml_type_name(node->type));
            continue;
        }
        spec->names[spec->n_names++] =
            (primitive_name){node->key, named_material(rd, r, node), node->where};
    }
}

static void read_crinkle(reading *rd, reader *r, const char *key, primitive_spec *spec)
{
    static const param_info TILT = {"tilt_rms_deg", "deg",         "", 0, CRINKLE_MOST_TILT_DEG,
                                    PARAM_REQUIRED, PARAM_MIN_OPEN};
    const toml_node *table = reader_table(r, key, false);
    if (!table) return;
    reader inner = reader_start(table, key, rd->errors);
    int64_t facets, seed;
    double tilt_deg;
    reader_integer(&inner, "facets_per_side", true, 2, CRINKLE_MAX, 0, &facets);
    reader_param(&inner, &TILT, &tilt_deg);
    reader_integer(&inner, "seed", false, 0, INT64_MAX, 1, &seed);
    spec->crinkle = (crinkle){(int)facets, tilt_deg * DEG, (uint64_t)seed};
    const glint_status status = reader_done(&inner);
    if (status > r->status) r->status = status;
}

static void read_path(reading *rd, reader *r, const primitive_key *key, primitive_spec *spec)
{
    const toml_node *node =
        reader_get(r, key->name, TOML_STRING, key->required, "the path of a file");
    if (!node) return;
    spec->path = reading_path(rd, node);
    if (!spec->path) r->status = GLINT_INTERNAL;
}

static void read_word(reader *r, const primitive_key *key, double *value)
{
    int word;
    reader_choice(r, key->name, key->words, key->n_words, key->required ? -1 : (int)key->def[0],
                  &word);
    value[0] = word;
}

static void read_points(reader *r, const primitive_key *key, primitive_spec *spec)
{
    const toml_node *node = reader_get(r, key->name, TOML_ARRAY, key->required,
                                       "three or more points of three numbers");
    if (!node) return;
    if (node->n_children < 3) {
        reader_fail(r, node->where, "'%s' has %d points; expected three or more", key->name,
                    node->n_children);
        return;
    }
    double(*points)[3] = calloc((size_t)node->n_children, sizeof *points);
    if (!points) {
        r->status = errors_no_memory(r->errors);
        return;
    }
    for (int i = 0; i < node->n_children; i++)
        node_vector(&node->children[i], key->name, 3, points[i], r);
    spec->points = points;
    spec->n_points = node->n_children;
}

/* Numbers of a vector key in the key's range. */
static void check_range(reader *r, const primitive_key *key, int n, const double *value)
{
    const param_info range = {
        key->name, key->unit, key->doc, key->min, key->max, 0, key->min_open ? PARAM_MIN_OPEN : 0};
    for (int i = 0; i < n; i++) {
        if (param_accepts(&range, value[i])) continue;
        char expected[PARAM_RANGE_SIZE];
        param_range_text(&range, expected);
        reader_fail(r, reader_place(r, key->name), "'%s' has the number %g; expected %s%s%s",
                    key->name, value[i], expected, key->unit && key->unit[0] ? ", in " : "",
                    key->unit ? key->unit : "");
        return;
    }
}

static void read_primitive_key(reading *rd, reader *r, primitive_spec *spec, int k)
{
    const primitive_key *key = &spec->kind->keys[k];
    double *value = spec->value[k];
    const param_info number = {key->name,
                               key->unit,
                               key->doc,
                               key->min,
                               key->max,
                               key->required ? PARAM_REQUIRED : key->def[0],
                               key->min_open ? PARAM_MIN_OPEN : 0};
    const toml_node *node;
    int64_t whole;
    bool on;
    spec->given[k] = reader_has(r, key->name);
    switch (key->kind) {
    case KEY_NUMBER:
        reader_param(r, &number, value);
        break;
    case KEY_COUNT:
        reader_integer(r, key->name, key->required, (int64_t)key->min, (int64_t)key->max,
                       (int64_t)key->def[0], &whole);
        value[0] = (double)whole;
        break;
    case KEY_SWITCH:
        reader_boolean(r, key->name, key->def[0] != 0, &on);
        value[0] = on;
        break;
    case KEY_VECTOR:
        if (reader_vector(r, key->name, key->required, key->length, value))
            check_range(r, key, key->length, value);
        break;
    case KEY_DIRECTION:
        reader_axis(r, key->name, key->required, value);
        break;
    case KEY_POINTS:
        read_points(r, key, spec);
        break;
    case KEY_MATERIAL:
        node = reader_get(r, key->name, TOML_STRING, key->required, "the name of a material");
        if (node) spec->material[k] = named_material(rd, r, node);
        break;
    case KEY_FACES:
        read_faces(rd, r, key->name, spec);
        break;
    case KEY_WORD:
        read_word(r, key, value);
        break;
    case KEY_PATH:
        read_path(rd, r, key, spec);
        break;
    case KEY_NAMES:
        read_names(rd, r, key->name, spec);
        break;
    case KEY_CRINKLE:
        read_crinkle(rd, r, key->name, spec);
        break;
    }
    spec->key_place[k] = reader_place(r, key->name);
}

/* The keys that every primitive takes. */
static void read_copies(reading *rd, reader *r, primitive_spec *spec)
{
    static const param_info ANGLE = {"angle", "deg", "", -360, 360, PARAM_REQUIRED, 0};
    static const param_info STEP = {"step_deg", "deg", "", -360, 360, PARAM_REQUIRED, 0};
    static const char *const MIRRORS[] = {"x", "y", "z"};
    const toml_node *rotation = reader_table(r, "rotation_deg", false);
    if (rotation) {
        reader inner = reader_start(rotation, "rotation_deg", rd->errors);
        double angle_deg;
        spec->has_rotation = true;
        reader_axis(&inner, "axis", true, spec->rotation_axis);
        reader_param(&inner, &ANGLE, &angle_deg);
        spec->rotation_rad = angle_deg * DEG;
        if (reader_done(&inner)) r->status = GLINT_INPUT;
    }
    const toml_node *repeat = reader_table(r, "repeat", false);
    if (repeat) {
        reader inner = reader_start(repeat, "repeat", rd->errors);
        int64_t count;
        double step_deg;
        reader_integer(&inner, "count", true, 1, 10000, 1, &count);
        reader_axis(&inner, "axis", true, spec->repeat_axis);
        reader_param(&inner, &STEP, &step_deg);
        spec->repeat_count = (int)count;
        spec->repeat_step_rad = step_deg * DEG;
        if (reader_done(&inner)) r->status = GLINT_INPUT;
    }
    int mirror;
    if (reader_choice(r, "mirror", MIRRORS, 3, 0, &mirror)) spec->mirror = mirror + 1;
}

/* Adds lines to the report of a component, and frees them. */
static void add_report(reading *rd, scenario_component *component, text *lines)
{
    if (lines->failed) reading_no_memory(rd);
    if (!component->report) {
        component->report = lines->data;
        return;
    }
    text both = {0};
    text_printf(&both, "%s%s", component->report, lines->data ? lines->data : "");
    text_free(lines);
    if (both.failed) {
        reading_no_memory(rd);
        return;
    }
    free(component->report);
    component->report = both.data;
}

static void read_primitive(reading *rd, const primitive_kind *kind, const toml_node *table,
                           int component, facet_list *facets)
{
    char name[64];
    snprintf(name, sizeof name, "[[component.%s]]", kind->name);
    reader r = reader_start(table, name, rd->errors);
    primitive_spec spec;
    primitive_spec_start(kind, table->where, &spec);
    for (int k = 0; k < kind->n_keys; k++)
        read_primitive_key(rd, &r, &spec, k);
    read_copies(rd, &r, &spec);
    text report = {0};
    spec.report = &report;
    glint_status status = reader_done(&r);
    if (status == GLINT_OK) status = primitive_add(&spec, component, facets, rd->errors);
    add_report(rd, &rd->s->satellite.components[component], &report);
    if (status == GLINT_OK && facets->n > MOST_FACETS)
        status = errors_add(rd->errors, GLINT_INPUT, table->where,
                            "the satellite has more than %d facets; expected fewer", MOST_FACETS);
    reading_note(rd, status);
    primitive_spec_free(&spec);
}

/* ------------------------------------------------------------- components */

static bool is_good_name(const char *name)
{
    static const char GOOD[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.+";
    return name[0] && strspn(name, GOOD) == strlen(name) && strlen(name) <= 64;
}

bool reading_good_name(reading *rd, const char *what, const char *name, place where)
{
    if (is_good_name(name)) return true;
    reading_note(rd,
                 errors_add(rd->errors, GLINT_INPUT, where,
                            "'%.70s' cannot name a %s: it names columns of the output; expected "
                            "up to 64 letters, digits, '_', '-', '.', '+'",
                            name, what));
    return false;
}

static void read_name(reading *rd, const toml_node *table, int c)
{
    scenario_component *component = &rd->s->satellite.components[c];
    const toml_node *name = toml_child(table, "name");
    component->name = "";
    component->parent = -1;
    if (!name || name->type != TOML_STRING) {
        reading_note(rd, errors_add(rd->errors, GLINT_INPUT, name ? name->where : table->where,
                                    "[[component]] has no 'name'; expected a string"));
        return;
    }
    component->name = name->string;
    reading_good_name(rd, "component", name->string, name->where);
    for (int k = 0; k < c; k++)
        if (string_equal(rd->s->satellite.components[k].name, name->string))
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, name->where,
                                        "component '%s' stands twice; expected another name",
                                        name->string));
}

static int named_component(reading *rd, reader *r, const toml_node *node)
{
    const satellite *sat = &rd->s->satellite;
    const char **names = calloc((size_t)sat->n_components, sizeof *names);
    int found = -1;
    for (int k = 0; names && k < sat->n_components; k++) {
        names[k] = sat->components[k].name;
        if (found < 0 && string_equal(names[k], node->string)) found = k;
    }
    if (found < 0) {
        const char *near =
            names ? nearest_name(node->string, names, (size_t)sat->n_components) : NULL;
        reader_fail(r, node->where, "there is no component '%.60s'%s%s%s; expected the name of one",
                    node->string, near ? "; did you mean '" : "", near ? near : "",
                    near ? "'?" : "");
    }
    free(names);
    return found;
}

static void read_component(reading *rd, const toml_node *table, int c, facet_list *facets)
{
    scenario_component *component = &rd->s->satellite.components[c];
    reader r = reader_start(table, "[[component]]", rd->errors);
    reader_has(&r, "name");
    const toml_node *parent =
        reader_get(&r, "parent", TOML_STRING, false, "the name of another component");
    if (parent) component->parent = named_component(rd, &r, parent);
    const toml_node *turn = reader_table(&r, "hinge", false);
    if (turn) {
        component->has_hinge = true;
        read_hinge(rd, turn, &component->hinge);
    }
    for (size_t k = 0; primitive_kind_at(k); k++) {
        const primitive_kind *kind = primitive_kind_at(k);
        const toml_node *list = reader_tables(&r, kind->name);
        for (int i = 0; list && i < list->n_children; i++)
            read_primitive(rd, kind, &list->children[i], c, facets);
    }
    reading_done(rd, &r);
}

/* Puts parents before children; a circle of parents is an error. */
static void order_components(reading *rd, const toml_node *tables)
{
    satellite *sat = &rd->s->satellite;
    const int n = sat->n_components;
    int *depth = calloc((size_t)n + 1, sizeof *depth);
    sat->order = calloc((size_t)n + 1, sizeof *sat->order);
    if (!depth || !sat->order) {
        free(depth);
        reading_no_memory(rd);
        return;
    }
    for (int c = 0; c < n; c++) {
        int at = c;
        while (at >= 0 && depth[c] <= n) {
            depth[c]++;
            at = sat->components[at].parent;
        }
        if (depth[c] > n)
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, tables->children[c].where,
                                        "component '%s' is its own ancestor: the parents form a "
                                        "circle; expected a chain that ends at a component without "
                                        "parent",
                                        sat->components[c].name));
    }
    int count = 0;
    for (int level = 1; level <= n; level++)
        for (int c = 0; c < n && count < n; c++)
            if (depth[c] == level) sat->order[count++] = c;
    free(depth);
}

static void read_components(reading *rd, reader *r, facet_list *facets)
{
    enum { MOST_COMPONENTS = 1000 };
    satellite *sat = &rd->s->satellite;
    const toml_node *tables = reader_tables(r, "component");
    if (!tables) {
        if (!reader_has(r, "component") || r->status == GLINT_OK)
            reader_fail(r, r->table->where,
                        "there is no component; expected at least one "
                        "[[component]] with a primitive");
        return;
    }
    if (tables->n_children > MOST_COMPONENTS) {
        reader_fail(r, tables->where, "there are %d components; expected at most %d",
                    tables->n_children, MOST_COMPONENTS);
        return;
    }
    sat->components = calloc((size_t)tables->n_children, sizeof *sat->components);
    if (!sat->components) {
        reading_no_memory(rd);
        return;
    }
    sat->n_components = tables->n_children;
    for (int c = 0; c < sat->n_components; c++)
        read_name(rd, &tables->children[c], c);
    for (int c = 0; c < sat->n_components; c++)
        read_component(rd, &tables->children[c], c, facets);
    order_components(rd, tables);
}

/* ------------------------------------------------------------ compilation */

/* Drops materials that no facet uses, and renumbers those of the facets. */
static glint_status keep_used_materials(satellite *sat, facet_list *facets)
{
    int *number = calloc((size_t)sat->n_materials + 1, sizeof *number);
    if (!number) return GLINT_INTERNAL;
    for (int j = 0; j < facets->n; j++)
        number[facets->items[j].material] = 1;
    int kept = 0;
    for (int m = 0; m < sat->n_materials; m++) {
        if (number[m]) {
            number[m] = kept;
            sat->materials[kept++] = sat->materials[m];
        } else {
            scenario_material_free(&sat->materials[m]);
        }
    }
    sat->n_materials = kept;
    for (int j = 0; j < facets->n; j++)
        facets->items[j].material = number[facets->items[j].material];
    free(number);
    return GLINT_OK;
}

static void compile(reading *rd, facet_list *facets, place where)
{
    satellite *sat = &rd->s->satellite;
    if (keep_used_materials(sat, facets)) {
        reading_no_memory(rd);
        return;
    }
    sat->model_materials = calloc((size_t)sat->n_materials + 1, sizeof *sat->model_materials);
    sat->model_components = calloc((size_t)sat->n_components + 1, sizeof *sat->model_components);
    if (!sat->model_materials || !sat->model_components) {
        reading_no_memory(rd);
        return;
    }
    for (int m = 0; m < sat->n_materials; m++)
        sat->model_materials[m] = (model_material){sat->materials[m].name, sat->materials[m].bands};
    for (int c = 0; c < sat->n_components; c++)
        sat->model_components[c] = (model_component){sat->components[c].name};
    glint_error error;
    if (model_compile(facets, sat->model_materials, sat->n_materials, sat->model_components,
                      sat->n_components, rd->s->n_bands, &sat->model, &error))
        reading_note(rd, errors_take(rd->errors, &error, where));
}

/* The narrowest lobe of a material in all bands, rad. */
static double narrowest_width(const scenario_material *material, int n_bands)
{
    double width_rad = HUGE_VAL;
    for (int b = 0; b < n_bands; b++)
        width_rad = fmin(width_rad, brdf_material_width(&material->bands[b]));
    return width_rad;
}

/* Flat facets of a mesh that bend by more than a lobe is wide make it flicker. */
static void warn_of_mesh(reading *rd, scenario_material *material, double width_rad,
                         double bend_rad)
{
    if (!(width_rad < 0.5 * bend_rad)) return;
    material->flicker_rad = bend_rad;
    errors_warn(rd->errors, material->where,
                "the lobe of '%s' is %.3g deg wide, and the mesh made of it bends by %.3g deg "
                "from facet to facet: it flickers; smooth normals in the file, or smooth_deg, "
                "make it steady",
                material->name, width_rad / DEG, bend_rad / DEG);
}

static bool has_mesh(const model *m)
{
    for (int k = 0; k < m->n_facets; k++)
        if (m->polygons.items[k].imported) return true;
    return false;
}

static void warn_of_meshes(reading *rd)
{
    satellite *sat = &rd->s->satellite;
    const size_t n = (size_t)sat->n_materials;
    if (!has_mesh(&sat->model)) return;
    double *numbers = malloc(2 * n * sizeof *numbers);
    if (!numbers) {
        reading_no_memory(rd);
        return;
    }
    double *widths_rad = numbers, *bends_rad = numbers + n;
    bool some_lobe = false; /* that could flicker; else nobody need look at the edges */
    for (size_t m = 0; m < n; m++) {
        widths_rad[m] = narrowest_width(&sat->materials[m], rd->s->n_bands);
        some_lobe |= widths_rad[m] < 0.5 * MODEL_MOST_BEND_RAD;
    }
    if (some_lobe && model_material_bends(&sat->model, bends_rad, NULL))
        reading_no_memory(rd);
    else if (some_lobe)
        for (size_t m = 0; m < n; m++)
            warn_of_mesh(rd, &sat->materials[m], widths_rad[m], bends_rad[m]);
    free(numbers);
}

void read_model_tables(reading *rd, reader *r)
{
    const glint_status before = rd->status;
    rd->status = GLINT_OK;
    facet_list facets = {0};
    read_materials(rd, r);
    read_components(rd, r, &facets);
    const place where = {r->table->where.file, 0, 0};
    if (rd->status == GLINT_OK && r->status == GLINT_OK) compile(rd, &facets, where);
    if (rd->status == GLINT_OK && r->status == GLINT_OK) warn_of_materials(rd);
    if (rd->status == GLINT_OK && r->status == GLINT_OK) warn_of_meshes(rd);
    facet_list_free(&facets);
    reading_note(rd, before);
}
