/* read_expectations.c: [[expect]], [expect_table] and [[require]]: what `glint verify` holds a
 * scenario to. Whether the columns exist is known only once the run is set up. */
#include "scenario/reading.h"

#include "base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const param_info TOLERANCE = {"tolerance", "the column's unit", "", 0, INFINITY, 0, 0};
static const param_info RELATIVE = {"relative", "", "", 0, 1, 0, 0};

/* The observer of an expectation must be one of the scenario's, and there be a time to go with. */
static void check_observer(reading *rd, reader *r, const expectation *e)
{
    const glint_scenario *s = rd->s;
    bool known = s->n_observers == 0 && !s->has_geometry; /* they could not be read */
    for (int i = 0; i < s->n_observers; i++)
        known = known || string_equal(s->observers[i].name, e->observer);
    if (!known)
        reader_fail(r, reader_place(r, "observer"), "no observer is named '%.60s'", e->observer);
    if (e->by_row)
        reader_fail(r, reader_place(r, "observer"),
                    "'observer' stands beside 'row', which counts the rows of all; expected 't_s'");
}

static void read_expectation(reading *rd, const toml_node *table, expectation *out)
{
    static const param_info TIME = {"t_s", "s", "", -INFINITY, INFINITY, 0, 0};
    static const param_info VALUE = {"value", "", "", -INFINITY, INFINITY, PARAM_REQUIRED, 0};
    reader r = reader_start(table, "[[expect]]", rd->errors);
    *out = (expectation){.where = table->where,
                         .observer = rd->s->n_observers > 0 ? rd->s->observers[0].name : "",
                         .column = "",
                         .source = ""};
    const bool has_time = reader_param(&r, &TIME, &out->t_s);
    out->by_row = reader_integer(&r, "row", false, 0, INT64_MAX, 0, &out->row);
    if (reader_has(&r, "t_s") == reader_has(&r, "row"))
        reader_fail(&r, table->where, "[[expect]] has %s; expected one of t_s and row",
                    has_time ? "both t_s and row" : "neither t_s nor row");
    if (reader_string(&r, "observer", false, &out->observer)) check_observer(rd, &r, out);
    reader_string(&r, "column", true, &out->column);
    reader_param(&r, &VALUE, &out->value);
    const bool absolute = reader_param(&r, &TOLERANCE, &out->absolute);
    const bool relative = reader_param(&r, &RELATIVE, &out->relative);
    if (!absolute && !relative && r.status == GLINT_OK)
        reader_fail(&r, table->where,
                    "[[expect]] has no tolerance; expected 'tolerance' (absolute) or 'relative'");
    reader_string(&r, "source", false, &out->source);
    reading_done(rd, &r);
}

/* Adds the columns of a table of tolerances. */
static void read_tolerances(reading *rd, reader *outer, const char *key, bool relative)
{
    expected_table *t = &rd->s->expected;
    const toml_node *table = reader_table(outer, key, false);
    for (int i = 0; table && i < table->n_children; i++) {
        const toml_node *node = &table->children[i];
        double tolerance;
        if (!node_number(node, node->key, &tolerance, outer)) continue;
        if (!(tolerance >= 0)) {
            reader_fail(outer, node->where, "the tolerance is %g; expected 0 or more", tolerance);
            continue;
        }
        if (t->csv.path && csv_column(&t->csv, node->key) < 0)
            reader_fail(outer, node->key_where, "the file has no column '%.60s'", node->key);
        int c = 0;
        while (c < t->n_columns && !string_equal(t->columns[c], node->key))
            c++;
        if (c == t->n_columns) {
            t->columns[c] = node->key;
            t->n_columns++;
        }
        *(relative ? &t->relative[c] : &t->absolute[c]) = tolerance;
    }
}

static void read_expected_table(reading *rd, const toml_node *table)
{
    expected_table *t = &rd->s->expected;
    reader r = reader_start(table, "[expect_table]", rd->errors);
    const toml_node *file = reader_get(&r, "file", TOML_STRING, true, "the path of a CSV file");
    t->where = table->where;
    if (file) {
        char *path = reading_path(rd, file);
        const glint_status status =
            path ? csv_read(path, file->where, &t->csv, rd->errors) : GLINT_INTERNAL;
        if (!status) csv_leave_out_cut_row(&t->csv, rd->errors);
        reading_note(rd, status);
        free(path);
    }
    const toml_node *a = toml_child(table, "tolerance"), *b = toml_child(table, "relative");
    const size_t most = (size_t)((a ? a->n_children : 0) + (b ? b->n_children : 0)) + 1;
    t->columns = calloc(most, sizeof *t->columns);
    t->absolute = calloc(most, sizeof *t->absolute);
    t->relative = calloc(most, sizeof *t->relative);
    if (!t->columns || !t->absolute || !t->relative) {
        reading_no_memory(rd);
        return;
    }
    read_tolerances(rd, &r, "tolerance", false);
    read_tolerances(rd, &r, "relative", true);
    if (t->n_columns == 0 && r.status == GLINT_OK)
        reader_fail(&r, table->where,
                    "[expect_table] has no tolerances; expected tolerance = { COLUMN = number } or "
                    "relative = { COLUMN = number }");
    rd->s->has_expected_table = true;
    reading_done(rd, &r);
}

static void read_conditions(reading *rd, reader *r, requirement *out)
{
    const toml_node *table = reader_table(r, "when", false);
    if (!table || table->n_children == 0) return;
    out->when = calloc((size_t)table->n_children, sizeof *out->when);
    if (!out->when) {
        reading_no_memory(rd);
        return;
    }
    for (int i = 0; i < table->n_children; i++) {
        const toml_node *node = &table->children[i];
        double range[2] = {0, 0};
        if (!node_vector(node, node->key, 2, range, r)) continue;
        if (range[0] > range[1])
            reader_fail(r, node->where, "[%g, %g]: the lower limit lies above the upper one",
                        range[0], range[1]);
        out->when[out->n_when++] = (row_condition){node->key, range[0], range[1], node->key_where};
    }
}

static void read_requirement(reading *rd, const toml_node *table, requirement *out)
{
    static const param_info FAINTER = {"fainter_than", "mag",          "", -INFINITY,
                                       INFINITY,       PARAM_REQUIRED, 0};
    static const param_info FRACTION = {"for_fraction", "", "", 0, 1, 1, 0};
    static const param_info REFERENCE = {
        "reference_height_km", "km", "", 0, 1e7, PARAM_NONE, PARAM_MIN_OPEN | PARAM_OPTIONAL};
    reader r = reader_start(table, "[[require]]", rd->errors);
    double height_km;
    *out = (requirement){.where = table->where, .column = ""};
    if (reader_string(&r, "column", true, &out->column) && strncmp(out->column, "mag_", 4) != 0)
        reader_fail(
            &r, reader_place(&r, "column"),
            "a requirement is on a magnitude, and '%.60s' is none; expected mag_V or the like",
            out->column);
    reader_param(&r, &FAINTER, &out->fainter_than);
    reader_param(&r, &FRACTION, &out->for_fraction);
    out->has_reference = reader_param(&r, &REFERENCE, &height_km);
    out->reference_height_m = out->has_reference ? height_km * 1e3 : 0;
    if (out->has_reference && rd->s->has_geometry)
        reader_fail(&r, reader_place(&r, "reference_height_km"),
                    "directions given by [geometry] have no height; expected no reference height");
    read_conditions(rd, &r, out);
    reading_done(rd, &r);
}

void read_expectations(reading *rd, reader *root)
{
    glint_scenario *s = rd->s;
    const toml_node *expect = reader_tables(root, "expect");
    const toml_node *require = reader_tables(root, "require");
    const toml_node *table = reader_table(root, "expect_table", false);
    if (expect) s->expectations = calloc((size_t)expect->n_children, sizeof *s->expectations);
    if (require) s->requirements = calloc((size_t)require->n_children, sizeof *s->requirements);
    if ((expect && !s->expectations) || (require && !s->requirements)) {
        reading_no_memory(rd);
        return;
    }
    for (int i = 0; expect && i < expect->n_children; i++)
        read_expectation(rd, &expect->children[i], &s->expectations[s->n_expectations++]);
    for (int i = 0; require && i < require->n_children; i++)
        read_requirement(rd, &require->children[i], &s->requirements[s->n_requirements++]);
    if (table) read_expected_table(rd, table);
}
