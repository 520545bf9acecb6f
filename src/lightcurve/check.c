/* check.c: describes a scenario or a model without computing a curve. */
#include "base/constants.h"
#include "base/text.h"
#include "brdf/dhr.h"
#include "brdf/table.h"
#include "lightcurve/columns.h"
#include "lightcurve/facts.h"
#include "lightcurve/geometry.h"
#include "scenario/read_material.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What makes a word plural, where it is. */
static const char *plural(int64_t n)
{
    return n == 1 ? "" : "s";
}

static void report_time(const glint_scenario *s, text *t)
{
    glint_utc start, end;
    run_clock_utc(&s->clock, 0, &start);
    run_clock_utc(&s->clock, (double)(s->n_steps - 1) * s->step_s, &end);
    char a[UTC_TEXT_SIZE], b[UTC_TEXT_SIZE];
    utc_write(&start, a);
    utc_write(&end, b);
    text_printf(t, "time        %.19sZ to %.19sZ, every %g s: %lld row%s\n", a, b, s->step_s,
                (long long)s->n_steps, plural(s->n_steps));
    if (s->n_observers > 1)
        text_printf(t, "            for each of %d observers\n", s->n_observers);
    if (s->clock.n_leaps)
        text_printf(t, "            with %d leap second%s on the way\n", s->clock.n_leaps,
                    plural(s->clock.n_leaps));
    for (int i = 0; i < s->n_observers; i++) {
        char *who = fact_observer(s, &s->observers[i]);
        text_printf(t, "observer    %s\n", who ? who : "");
        free(who);
    }
    char *line = fact_orbit(s, &s->orbit);
    text_printf(t, "orbit       %s\n", line ? line : "");
    free(line);
    text_add(t, "attitude    ");
    attitude_plan_describe(&s->attitude, "            ", t);
}

/* has_time: false for a model file alone, whose dates are counted from nowhere. */
static void report_table(const hinge_table *table, bool has_time, text *t)
{
    const double from_s = table->t_s[0], to_s = table->t_s[table->n - 1];
    text_printf(t, "by a table of %ld angles", table->n);
    if (has_time)
        text_printf(t, " from %.10g to %.10g s", from_s, to_s);
    else
        text_printf(t, " over %.10g s", to_s - from_s);
}

static void report_hinge(const hinge *h, bool has_time, text *t)
{
    if (h->drive == HINGE_FIXED)
        text_printf(t, "fixed at %g deg", (h->angle + h->offset) / DEG);
    else if (h->drive == HINGE_RATE)
        text_printf(t, "turns at %g deg/s", h->rate_rad_s / DEG);
    else if (h->drive == HINGE_TABLE)
        report_table(&h->table, has_time, t);
    else if (h->target.kind < DIRECTION_STAR)
        text_printf(t, "tracks %s", direction_word((size_t)h->target.kind));
    else
        text_add(t, h->target.kind == DIRECTION_STAR ? "tracks a star" : "tracks a place");
    if (h->drive != HINGE_FIXED && h->offset != 0)
        text_printf(t, " with an offset of %g deg", h->offset / DEG);
    if (h->has_limits)
        text_printf(t, " between %g and %g deg", h->limits[0] / DEG, h->limits[1] / DEG);
}

/* Lines on the primitives of a component, set off from its own. */
static void report_primitives(const char *lines, text *t)
{
    for (const char *line = lines; line && *line;) {
        const size_t n = strcspn(line, "\n");
        text_printf(t, "            %.*s\n", (int)n, line);
        line += n + (line[n] == '\n');
    }
}

static glint_status report_components(const glint_scenario *s, text *t, glint_error *error)
{
    const satellite *sat = &s->satellite;
    text_printf(t, "satellite   %d facet%s, %d component%s, %d material%s\n", sat->model.n_facets,
                plural(sat->model.n_facets), sat->n_components, plural(sat->n_components),
                sat->n_materials, plural(sat->n_materials));
    for (int c = 0; c < sat->n_components; c++) {
        const scenario_component *component = &sat->components[c];
        model_component_facts facts;
        const glint_status status = model_component_describe(&sat->model, c, &facts, error);
        if (status) return status;
        text_printf(t, "  component %-20s", component->name);
        if (facts.n_facets)
            text_printf(t, " %6d %-6s  %10.4g m^2  %s", facts.n_facets,
                        facts.n_facets == 1 ? "facet" : "facets", facts.area_m2,
                        facts.closed ? "closed" : "open");
        else
            text_add(t, "      a joint without facets");
        if (component->parent >= 0)
            text_printf(t, "  on %s", sat->components[component->parent].name);
        if (component->has_hinge) {
            text_add(t, ", ");
            report_hinge(&component->hinge, s->n_steps > 0, t);
        }
        text_char(t, '\n');
        if (facts.n_facets)
            text_printf(t, "            x %.4g to %.4g, y %.4g to %.4g, z %.4g to %.4g m\n",
                        facts.lo_m[0], facts.hi_m[0], facts.lo_m[1], facts.hi_m[1], facts.lo_m[2],
                        facts.hi_m[2]);
        report_primitives(component->report, t);
    }
    return GLINT_OK;
}

/* Facets of a component. */
static int facets_of(const satellite *sat, int component)
{
    int n = 0;
    for (int s = 0; s < sat->model.n_spans; s++)
        if (sat->model.spans[s].component == component) n += sat->model.spans[s].n;
    return n;
}

/* "  wing-north: 4 of 6 facets of bus, 1 of 2 of itself" for what it can shadow; nothing for what
 * shadows nothing. */
static void report_caster(const satellite *sat, const int *counts, int by, text *t)
{
    bool any = false;
    for (int on = 0; on < sat->n_components; on++) {
        const int count = counts[on * sat->n_components + by];
        if (!count) continue;
        if (!any) text_printf(t, "  shadow of %-20s", sat->components[by].name);
        text_printf(t, "%s %d of %d facets of %s", any ? "," : " on", count, facets_of(sat, on),
                    on == by ? "itself" : sat->components[on].name);
        any = true;
    }
    if (any) text_char(t, '\n');
}

/* What can come before what at some angle of the hinges, seen from anywhere. */
static glint_status report_shadows(const glint_scenario *s, text *t, glint_error *error)
{
    const satellite *sat = &s->satellite;
    const size_t n = (size_t)sat->n_components;
    visibility *plan;
    glint_status status = satellite_plan_shadows(sat, &plan, error);
    if (status) return status;
    const int exposed = visibility_n_exposed(plan);
    visibility_free(plan);
    if (s->self_shadows == SHADOWS_NONE)
        text_printf(t, "shadows     none computed; %d of %d facets can be shadowed or hidden\n",
                    exposed, sat->model.n_facets);
    else
        text_printf(t, "shadows     %d of %d facets can be shadowed or hidden by others\n", exposed,
                    sat->model.n_facets);
    if (!exposed) return GLINT_OK;
    int *counts = malloc(n * n * sizeof *counts);
    if (!counts) return error_no_memory(error);
    status = satellite_count_shadowed(sat, counts, error);
    for (int by = 0; !status && by < sat->n_components; by++)
        report_caster(sat, counts, by, t);
    free(counts);
    return status;
}

/* What the measured lobes of a material rest on. */
static void report_tables(const brdf_material *material, text *t)
{
    for (int k = 0; k < material->n_lobes; k++)
        if (material->lobes[k].model->flags & BRDF_MEASURED)
            table_report(&material->lobes[k], "              ", t);
}

/* Directional-hemispherical reflectance at three incidences from one azimuth. */
static void reflectances(const brdf_material *material, double phi_i, double dhr[3])
{
    static const double THETA_DEG[3] = {0, 30, 60};
    for (int k = 0; k < 3; k++) {
        dhr[k] = 0;
        /* short of the tolerance, the best value found serves as well */
        (void)brdf_dhr(material, THETA_DEG[k] * DEG, phi_i, 1e-5, &dhr[k], NULL, NULL);
    }
}

static void report_reflectance(const brdf_material *material, text *t)
{
    double along[3], across[3];
    reflectances(material, 0, along);
    reflectances(material, PI / 2, across);
    bool differs = false;
    for (int k = 0; k < 3; k++)
        differs = differs || fabs(along[k] - across[k]) > 5e-4; /* as printed */
    text_printf(t, "              reflects %.3f, %.3f, %.3f of the light from 0, 30, 60 deg%s",
                along[0], along[1], along[2], differs ? " along the tangent" : "");
    if (differs) text_printf(t, ", %.3f, %.3f, %.3f across it", across[0], across[1], across[2]);
    text_char(t, '\n');
}

/* What of it a mirror sends into one direction. */
static void report_mirror(const brdf_material *material, text *t)
{
    const double part[3] = {brdf_material_specular(material, 1.0),
                            brdf_material_specular(material, cos(30 * DEG)),
                            brdf_material_specular(material, cos(60 * DEG))};
    if (part[0] > 0)
        text_printf(t, "              of that %.3f, %.3f, %.3f into the mirror direction alone\n",
                    part[0], part[1], part[2]);
}

static void report_materials(const glint_scenario *s, text *t)
{
    const satellite *sat = &s->satellite;
    for (int m = 0; m < sat->n_materials; m++) {
        int n_facets;
        const double area_m2 = model_material_area(&sat->model, m, &n_facets);
        text_printf(t, "  material  %-20s %6d %-6s  %10.4g m^2", sat->materials[m].name, n_facets,
                    n_facets == 1 ? "facet" : "facets", area_m2);
        if (sat->materials[m].source[0]) text_printf(t, "  (%s)", sat->materials[m].source);
        text_char(t, '\n');
        for (int b = 0; b < s->n_bands; b++) {
            if (sat->model.same_band[m * s->n_bands + b] != b) continue;
            text_printf(t, "            %s: ", s->bands[b]->name);
            for (int l = 0; l < sat->materials[m].bands[b].n_lobes; l++) {
                if (l) text_add(t, " + ");
                fact_lobe(&sat->materials[m].bands[b].lobes[l], t);
            }
            text_char(t, '\n');
            report_tables(&sat->materials[m].bands[b], t);
            report_reflectance(&sat->materials[m].bands[b], t);
            report_mirror(&sat->materials[m].bands[b], t);
        }
    }
}

/* The track that `glint compare` holds the prediction against. */
static void report_observed(const glint_scenario *s, text *t)
{
    const observed_track *o = &s->observed;
    const char *name = s->observers[o->observer].name;
    text_printf(t, "observed    %zu observation%s of %s (%s), magnitudes %s, band %s%s%s%s\n", o->n,
                plural((int64_t)o->n), o->path, o->format, observed_kind_names[o->kind],
                s->bands[o->band]->name, name[0] ? ", by " : "", name,
                o->fit_zero_point ? "; a zero point is fitted" : "");
    double from_s = HUGE_VAL, to_s = -HUGE_VAL;
    for (size_t k = 0; k < o->n; k++) {
        from_s = fmin(from_s, o->rows[k].t_s);
        to_s = fmax(to_s, o->rows[k].t_s);
    }
    if (o->n > 0) {
        glint_utc from, to;
        run_clock_utc(&s->clock, from_s, &from);
        run_clock_utc(&s->clock, to_s, &to);
        char a[UTC_TEXT_SIZE], b[UTC_TEXT_SIZE];
        utc_write(&from, a);
        utc_write(&to, b);
        text_printf(t, "            from %.19sZ to %.19sZ\n", a, b);
    }
    if (o->outside_time + o->other_filter + o->without_magnitude > 0)
        text_printf(t,
                    "            left out: %lld outside of [time], %lld of another filter, %lld "
                    "without a magnitude\n",
                    (long long)o->outside_time, (long long)o->other_filter,
                    (long long)o->without_magnitude);
}

/* Names with commas between them, on lines of WIDTH. */
static void report_columns(const column_set *columns, text *t)
{
    enum { INDENT = 12, WIDTH = 100 };
    size_t at = INDENT;
    text_add(t, "columns     ");
    for (size_t i = 0; i < columns->n; i++) {
        const char *name = columns->columns[i].name;
        const size_t length = strlen(name) + 2;
        const bool breaks = at > INDENT && at + length > WIDTH;
        if (breaks) at = INDENT;
        if (i > 0) text_add(t, breaks ? ",\n            " : ", ");
        text_add(t, name);
        at += length;
    }
    text_char(t, '\n');
}

static void report_run(const glint_scenario *s, text *t)
{
    fact_list facts = {0};
    facts_of_run(s, &facts);
    for (size_t i = 0; i < facts.n; i++)
        if (!string_equal(facts.items[i].key, "glint_version") &&
            !string_equal(facts.items[i].key, "title") &&
            !string_equal(facts.items[i].key, "orbit") &&
            !string_equal(facts.items[i].key, "attitude") &&
            !string_equal(facts.items[i].key, "observer") &&
            !string_equal(facts.items[i].key, "observers"))
            text_printf(t, "%-23s %s\n", facts.items[i].key, facts.items[i].value);
    fact_list_free(&facts);
    column_set columns;
    if (column_set_make(s, &columns, NULL) == GLINT_OK) {
        report_columns(&columns, t);
        column_set_free(&columns);
    }
    if (s->n_expectations || s->n_requirements || s->has_expected_table)
        text_printf(t, "verify      %d expected value%s, %d requirement%s%s\n", s->n_expectations,
                    plural(s->n_expectations), s->n_requirements, plural(s->n_requirements),
                    s->has_expected_table ? ", and a table of expected values" : "");
    if (s->has_observed) report_observed(s, t);
}

static glint_status describe(const glint_scenario *s, bool is_model, text *t, glint_error *error)
{
    text_printf(t, "%s: %s\n", s->documents[0]->path, is_model ? "a model" : "a scenario");
    if (s->title[0]) text_printf(t, "title       %s\n", s->title);
    if (!is_model && s->has_geometry)
        text_printf(t, "geometry    %lld pair%s of directions, given in the body frame\n",
                    (long long)s->geometry.n, plural(s->geometry.n));
    else if (!is_model)
        report_time(s, t);
    glint_status status = report_components(s, t, error);
    if (!status) status = report_shadows(s, t, error);
    if (status) return status;
    report_materials(s, t);
    if (!is_model) report_run(s, t);
    return GLINT_OK;
}

/* What a file holds. */
typedef enum file_kind { FILE_SCENARIO, FILE_MODEL, FILE_MATERIALS } file_kind;

/* A file that cannot be read counts as a scenario and says so when it is read for good. */
static file_kind kind_of_file(const char *path)
{
    toml_document *document;
    if (toml_read(path, PLACE_NONE, &document, NULL)) return FILE_SCENARIO;
    file_kind kind = FILE_SCENARIO;
    if (scenario_is_model(document))
        kind = toml_child(&document->root, "component") ? FILE_MODEL : FILE_MATERIALS;
    toml_free(document);
    return kind;
}

static glint_status describe_material(const char *path, const char *name, text *t,
                                      glint_errors *errors)
{
    glint_material *material;
    const glint_status status = glint_material_read(path, name, NULL, &material, errors);
    if (status) return status;
    const char *source = glint_material_source(material);
    text_printf(t, "  material  %s", name);
    if (source[0]) text_printf(t, "  (%s)", source);
    text_printf(t, "\n            %s\n", glint_material_model(material));
    report_tables(material_function(material), t);
    report_reflectance(material_function(material), t);
    report_mirror(material_function(material), t);
    glint_material_free(material);
    return GLINT_OK;
}

/* A file of materials: each by itself, without a band. */
static glint_status check_materials(const char *path, size_t n_overrides, char **report,
                                    glint_errors *errors)
{
    if (n_overrides)
        return errors_add(errors, GLINT_ARGUMENT, PLACE_NONE,
                          "'%s' is a file of materials; expected a scenario or a model with --set",
                          path);
    const char **names;
    size_t n;
    glint_status worst = glint_material_names(path, &names, &n, errors);
    if (worst) return worst;
    text t = {0};
    text_printf(&t, "%s: a file of %zu material%s\n", path, n, plural((int64_t)n));
    for (size_t k = 0; k < n; k++) {
        const glint_status status = describe_material(path, names[k], &t, errors);
        if (status > worst) worst = status;
    }
    glint_free(names);
    if (!worst && t.failed) worst = errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    if (worst)
        text_free(&t);
    else
        *report = t.data;
    return worst;
}

glint_status glint_check(const char *path, const char *const *overrides, size_t n_overrides,
                         char **report, glint_errors *errors)
{
    *report = NULL;
    const file_kind kind = kind_of_file(path);
    if (kind == FILE_MATERIALS) return check_materials(path, n_overrides, report, errors);
    const bool is_model = kind == FILE_MODEL;
    glint_scenario *s;
    glint_status status = is_model ? scenario_read_model(path, overrides, n_overrides, &s, errors)
                                   : glint_scenario_read(path, overrides, n_overrides, &s, errors);
    if (status) return status;
    text t = {0};
    glint_error error;
    status = describe(s, is_model, &t, &error);
    glint_scenario_free(s);
    if (!status && t.failed) status = error_no_memory(&error);
    if (status) {
        text_free(&t);
        return errors_take(errors, &error, PLACE_NONE);
    }
    *report = t.data;
    return GLINT_OK;
}
