#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/oem.h"
#include "orbit/omm.h"
#include "orbit/sp3.h"
#include "orbit/stk.h"
#include "scenario/reading.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const param_info AXIS = {"semi_major_axis_km", "km",          "", 0, 1e7,
                                PARAM_REQUIRED,       PARAM_MIN_OPEN};
static const param_info ECCENTRICITY = {"eccentricity", "", "", 0, 1, PARAM_REQUIRED,
                                        PARAM_MAX_OPEN};
static const param_info INCLINATION = {"inclination_deg", "deg", "", 0, 180, PARAM_REQUIRED, 0};
static const param_info RAAN = {"raan_deg", "deg", "", -360, 360, PARAM_REQUIRED, 0};
static const param_info PERIGEE = {
    "argument_of_perigee_deg", "deg", "", -360, 360, PARAM_REQUIRED, 0};
static const param_info ANOMALY = {"mean_anomaly_deg", "deg",          "", -INFINITY,
                                   INFINITY,           PARAM_REQUIRED, 0};
static const param_info HEIGHT = {
    "height_km", "km", "above the equatorial radius", 0, 1e7, PARAM_REQUIRED, PARAM_MIN_OPEN};
static const param_info LATITUDE_ARGUMENT = {
    "argument_of_latitude_deg", "deg", "", -INFINITY, INFINITY, PARAM_REQUIRED, 0};
static const param_info GEO_LONGITUDE = {
    "geostationary_longitude_deg", "deg", "east positive", -360, 360, PARAM_REQUIRED, 0};

/* The epoch, in TT s from the start; 0 (the start) where none is given. */
static double read_epoch_s(reading *rd, reader *r)
{
    utc_time epoch;
    if (!reader_time(r, "epoch", false, &epoch)) return 0;
    double tt_jd[2], tai_minus_utc_s;
    utc_to_tt(&epoch, tt_jd, &tai_minus_utc_s, NULL);
    return jd_difference_s(tt_jd, rd->s->clock.tt_jd);
}

/* Ends a table inside [orbit], whose status it becomes. */
static void end_inner(reader *inner, reader *outer)
{
    const glint_status status = reader_done(inner);
    if (status > outer->status) outer->status = status;
}

static void read_kepler(reading *rd, reader *outer, const toml_node *table, scenario_orbit *out)
{
    reader r = reader_start(table, "kepler", rd->errors);
    double a_km, e, inclination, raan, perigee, anomaly;
    reader_param(&r, &AXIS, &a_km);
    reader_param(&r, &ECCENTRICITY, &e);
    reader_param(&r, &INCLINATION, &inclination);
    reader_param(&r, &RAAN, &raan);
    reader_param(&r, &PERIGEE, &perigee);
    reader_param(&r, &ANOMALY, &anomaly);
    reader_boolean(&r, "j2", true, &out->j2);
    out->epoch_s = read_epoch_s(rd, &r);
    out->source = ORBIT_KEPLER;
    out->kepler = (kepler_elements){a_km * 1e3,   e, inclination * DEG, raan * DEG, perigee * DEG,
                                    anomaly * DEG};
    end_inner(&r, outer);
}

static void read_circular(reading *rd, reader *outer, const toml_node *table, scenario_orbit *out)
{
    reader r = reader_start(table, "circular", rd->errors);
    if (reader_has(&r, GEO_LONGITUDE.name)) {
        double longitude;
        reader_param(&r, &GEO_LONGITUDE, &longitude);
        out->source = ORBIT_GEOSTATIONARY;
        out->geostationary_longitude = longitude * DEG;
        end_inner(&r, outer);
        return;
    }
    double height_km, inclination, raan, u;
    reader_param(&r, &HEIGHT, &height_km);
    reader_param(&r, &INCLINATION, &inclination);
    reader_param(&r, &RAAN, &raan);
    reader_param(&r, &LATITUDE_ARGUMENT, &u);
    reader_boolean(&r, "j2", true, &out->j2);
    out->epoch_s = read_epoch_s(rd, &r);
    out->source = ORBIT_CIRCULAR;
    out->kepler = (kepler_elements){
        EARTH_RADIUS_M + height_km * 1e3, 0, inclination * DEG, raan * DEG, 0, u * DEG};
    end_inner(&r, outer);
}

/* What the tables of SGP4's files are read by. */
typedef glint_status sets_reader(const char *path, place asked_from, const tle_query *query,
                                 tle_list *out, glint_errors *errors);

/* Files of element sets, as two lines or OMM: those of one satellite. */
static void read_sets(reading *rd, reader *r, const toml_node *file, sets_reader *read_file,
                      scenario_orbit *out)
{
    tle_query query = {0};
    int64_t number;
    reader_string(r, "tle_name", false, &query.name);
    reader_string(r, "tle_designator", false, &query.designator);
    if (reader_integer(r, "tle_number", false, 1, 999999999, 0, &number))
        query.number = (int)number;
    out->source = ORBIT_TLE;
    if (!file) return;
    out->file = file->string;
    char *path = reading_path(rd, file);
    if (!path) return;
    const glint_status status = read_file(path, file->where, &query, &out->sets, rd->errors);
    if (status > r->status) r->status = status;
    free(path);
}

static void read_tle_lines(reading *rd, reader *r, const toml_node *lines, scenario_orbit *out)
{
    out->source = ORBIT_TLE;
    if (!lines) return;
    if (lines->n_children != 2 || lines->children[0].type != TOML_STRING ||
        lines->children[1].type != TOML_STRING) {
        reader_fail(r, lines->where, "'tle_lines' must hold two strings: line 1 and line 2");
        return;
    }
    glint_error error;
    place first = lines->children[0].where, second = lines->children[1].where;
    first.column++; /* behind the quote */
    second.column++;
    out->sets = (tle_list){.sets = calloc(1, sizeof(tle)), .n = 1};
    if (!out->sets.sets) {
        reading_no_memory(rd);
        r->status = GLINT_INTERNAL;
        return;
    }
    if (tle_parse(lines->children[0].string, lines->children[1].string, true, first, &second,
                  out->sets.sets, &error))
        r->status = errors_take(rd->errors, &error, lines->where);
}

/* The files of positions: each by its key, and the key that chooses among its objects. */
static glint_status read_stk(const char *path, place asked_from, const char *object,
                             orbit_table **out, glint_errors *errors)
{
    (void)object; /* such a file has one */
    return stk_read(path, asked_from, out, errors);
}

static const struct {
    const char *key, *object_key; /* NULL: none */
    glint_status (*read)(const char *path, place asked_from, const char *object, orbit_table **out,
                         glint_errors *errors);
} POSITION_FILES[] = {
    {"oem", "oem_object", oem_read}, {"stk", NULL, read_stk}, {"sp3", "sp3_satellite", sp3_read}};
enum { N_POSITION_FILES = sizeof POSITION_FILES / sizeof *POSITION_FILES };

/* Reads a table of positions, and makes the orbit of it. */
static void read_positions(reading *rd, reader *r, size_t k, const toml_node *file,
                           scenario_orbit *out)
{
    const char *object = NULL;
    if (POSITION_FILES[k].object_key)
        reader_string(r, POSITION_FILES[k].object_key, false, &object);
    out->source = ORBIT_POSITIONS;
    if (!file) return;
    out->file = file->string;
    char *path = reading_path(rd, file);
    if (!path) return;
    orbit_table *table;
    glint_error error;
    glint_status status = POSITION_FILES[k].read(path, file->where, object, &table, rd->errors);
    if (!status && orbit_from_table(table, &rd->s->clock, &out->propagator, &error))
        status = errors_take(rd->errors, &error, file->where);
    if (status > r->status) r->status = status;
    free(path);
}

static double run_end_s(const glint_scenario *s)
{
    return (double)(s->n_steps - 1) * s->step_s;
}

/* A warning when the epoch of an element set is far from a moment at which it is used. */
static void warn_of_age(reading *rd, place where, const scenario_orbit *o)
{
    static const double FAR_DAYS = 14; /* physics page, section 5 */
    const double end_s = run_end_s(rd->s);
    size_t n;
    const orbit_set_use *uses = orbit_sets(o->propagator, &n);
    double worst_s = 0;
    for (size_t k = 0; k < n; k++) {
        const double moments_s[2] = {fmax(uses[k].from_s, 0), fmin(uses[k].to_s, end_s)};
        for (int i = 0; i < 2; i++) {
            const double age_s = moments_s[i] - uses[k].epoch_s;
            if (fabs(age_s) > fabs(worst_s)) worst_s = age_s;
        }
    }
    if (fabs(worst_s) > FAR_DAYS * DAY_S)
        errors_warn(rd->errors, where,
                    "the element set's epoch lies %.1f days %s the time computed; past 14 days its "
                    "position may be tens of km off",
                    fabs(worst_s) / DAY_S, worst_s > 0 ? "before" : "after");
}

/* ------------------------------------------------------- the span of a table */

/* How much earlier than its reception light may have left the satellite, s: from where it is at the
 * table's beginning to the farther side of the Earth. */
static double longest_light_time_s(const orbit_table *table)
{
    static const double HIGHEST_SITE_M = 100e3; /* docs/scenario.md, [observer] */
    const table_node *first = &table->segments[0].nodes[0];
    return (norm3(first->r_m) + EARTH_RADIUS_M + HIGHEST_SITE_M) / LIGHT_SPEED_M_S;
}

/* A warning where records are so far apart that interpolation cannot follow the orbit. */
static void warn_of_wide_steps(reading *rd, place where, const orbit_table *table,
                               double reference_s)
{
    static const double FAR_M = 1000; /* 0.1 deg at a range of 500 km: physics page, section 5 */
    const double error_m = orbit_table_error_m(table, -reference_s, run_end_s(rd->s) - reference_s);
    if (error_m > FAR_M)
        errors_warn(rd->errors, where,
                    "the records of this table are far apart: interpolation of that degree may be "
                    "off by %.2g km; get a table with shorter steps",
                    error_m * 1e-3);
}

/* The run must lie inside the table, and so must the light that left before it. */
static void check_span(reading *rd, place where, const scenario_orbit *o)
{
    const glint_scenario *s = rd->s;
    double reference_s, from_s, to_s;
    const orbit_table *table = orbit_table_of(o->propagator, &reference_s);
    orbit_table_span(table, &from_s, &to_s);
    from_s += reference_s;
    to_s += reference_s;
    static const double ROUNDED_S = 1e-6; /* s: of dates */
    const double end_s = s->span_s;
    const bool seen = o == &s->orbit && s->light_time;
    const double light_s = seen ? longest_light_time_s(table) : 0;
    glint_status status = GLINT_OK;
    if (from_s > ROUNDED_S || to_s < end_s - ROUNDED_S)
        status = errors_add(rd->errors, GLINT_INPUT, where,
                            "the table of positions goes from %s to %s UTC, and the run from %s to "
                            "%s UTC; expected a run inside the table",
                            reading_moment(s, from_s).utc, reading_moment(s, to_s).utc,
                            reading_moment(s, 0).utc, reading_moment(s, end_s).utc);
    else if (seen && from_s > -light_s)
        status = errors_add(rd->errors, GLINT_INPUT, where,
                            "the table of positions begins at %s UTC, %.3g s before the run; light "
                            "time asks for up to %.3g s: begin the run that much later than the "
                            "table, or set light_time = false",
                            reading_moment(s, from_s).utc, fmax(-from_s, 0), light_s);
    for (size_t k = 1; k < table->n && !status; k++) {
        const double gap_s[2] = {reference_s + table->segments[k - 1].to_s,
                                 reference_s + table->segments[k].from_s};
        if (gap_s[0] < gap_s[1] && gap_s[0] + ROUNDED_S < end_s && gap_s[1] > -light_s)
            status = errors_add(rd->errors, GLINT_INPUT, where,
                                "the table of positions has a gap from %s to %s UTC, inside the "
                                "run; expected a run between gaps",
                                reading_moment(s, gap_s[0]).utc, reading_moment(s, gap_s[1]).utc);
    }
    reading_note(rd, status);
    if (!status) warn_of_wide_steps(rd, where, table, reference_s);
}

/* -------------------------------------------------------------------- [orbit] */

static void make_orbit(reading *rd, place where, scenario_orbit *out)
{
    /* s: positions are asked for at emission, which is 2 s before reception at most; see frames.c
     */
    static const double EARLIER_S = 2;
    glint_error error;
    glint_status status = GLINT_OK;
    switch (out->source) {
    case ORBIT_TLE:
        status = orbit_from_sets(out->sets.sets, out->sets.n, &rd->s->clock, -EARLIER_S,
                                 run_end_s(rd->s), &out->propagator, &error);
        if (!status) warn_of_age(rd, where, out);
        break;
    case ORBIT_POSITIONS:
        check_span(rd, where, out);
        break;
    case ORBIT_KEPLER:
    case ORBIT_CIRCULAR:
        status = orbit_from_kepler(&out->kepler, out->epoch_s, out->j2, &out->propagator, &error);
        break;
    case ORBIT_GEOSTATIONARY:
        status = orbit_geostationary(out->geostationary_longitude, &out->propagator, &error);
        break;
    }
    if (status) reading_note(rd, errors_take(rd->errors, &error, where));
}

static void read_source(reading *rd, reader *r, scenario_orbit *out)
{
    static const char A_FILE[] = "the path of a file";
    if (reader_has(r, "tle")) {
        read_sets(rd, r, reader_get(r, "tle", TOML_STRING, true, A_FILE), tle_file_read, out);
    } else if (reader_has(r, "omm")) {
        read_sets(rd, r, reader_get(r, "omm", TOML_STRING, true, A_FILE), omm_file_read, out);
    } else if (reader_has(r, "tle_lines")) {
        read_tle_lines(
            rd, r, reader_get(r, "tle_lines", TOML_ARRAY, true, "two strings: line 1 and line 2"),
            out);
    } else if (reader_has(r, "kepler")) {
        const toml_node *elements = reader_table(r, "kepler", true);
        if (elements) read_kepler(rd, r, elements, out);
    } else if (reader_has(r, "circular")) {
        const toml_node *elements = reader_table(r, "circular", true);
        if (elements) read_circular(rd, r, elements, out);
    }
    for (size_t k = 0; k < N_POSITION_FILES; k++) {
        const char *key = POSITION_FILES[k].key;
        if (reader_has(r, key))
            read_positions(rd, r, k, reader_get(r, key, TOML_STRING, true, A_FILE), out);
    }
}

/* Keys that choose within a file stand beside the file. */
static void refuse_lost_choices(reader *r)
{
    static const struct {
        const char *key, *files[2];
    } CHOICES[] = {{"tle_name", {"tle", "omm"}},
                   {"tle_designator", {"tle", "omm"}},
                   {"tle_number", {"tle", "omm"}},
                   {"oem_object", {"oem", NULL}},
                   {"sp3_satellite", {"sp3", NULL}}};
    for (size_t k = 0; k < sizeof CHOICES / sizeof *CHOICES; k++) {
        const char *const *files = CHOICES[k].files;
        const bool has_file =
            toml_child(r->table, files[0]) || (files[1] && toml_child(r->table, files[1]));
        const toml_node *choice = reader_find(r, CHOICES[k].key);
        if (!choice || has_file) continue;
        reader_fail(r, choice->key_where,
                    "'%s' chooses from the file of '%s'%s%s%s, which is not given here; expected "
                    "it there, or not at all",
                    CHOICES[k].key, files[0], files[1] ? " or '" : "", files[1] ? files[1] : "",
                    files[1] ? "'" : "");
    }
}

void read_orbit(reading *rd, const toml_node *table, const char *name, scenario_orbit *out)
{
    static const char *const SOURCES[] = {"tle", "tle_lines", "omm",    "oem",
                                          "stk", "sp3",       "kepler", "circular"};
    reader r = reader_start(table, name, rd->errors);
    int given = 0;
    for (size_t k = 0; k < sizeof SOURCES / sizeof *SOURCES; k++)
        given += reader_has(&r, SOURCES[k]);
    if (given != 1)
        reader_fail(
            &r, table->where,
            "%s has %s; expected exactly one of tle, tle_lines, omm, oem, stk, sp3, kepler, "
            "circular",
            name, given ? "several sources" : "no source");
    if (given == 1) read_source(rd, &r, out);
    if (given > 0) refuse_lost_choices(&r);
    reading_done(rd, &r);
    if (r.status == GLINT_OK && rd->s->n_steps > 0) make_orbit(rd, table->where, out);
}

void scenario_orbit_free(scenario_orbit *o)
{
    tle_list_free(&o->sets);
    orbit_free(o->propagator);
    *o = (scenario_orbit){0};
}
