#include "base/constants.h"
#include "base/text.h"
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

/* The middle of the run as a UTC quasi-JD, near which an element set's epoch should lie. */
static void middle_of_run(const glint_scenario *s, double jd[2])
{
    if (s->n_steps == 0) return; /* the time is wrong: reported already */
    const double span_s = (double)(s->n_steps - 1) * s->step_s;
    utc_to_jd(&s->clock.start, jd);
    jd[1] += 0.5 * span_s / DAY_S;
}

static void read_tle_file(reading *rd, reader *r, const toml_node *file, scenario_orbit *out)
{
    tle_query query = {.near_jd = {2451545.0, 0.0}};
    int64_t number;
    reader_string(r, "tle_name", false, &query.name);
    if (reader_integer(r, "tle_number", false, 1, 339999, 0, &number)) query.number = (int)number;
    middle_of_run(rd->s, query.near_jd);
    char *path = reading_path(rd, file);
    if (!path) return;
    glint_error error;
    const place from = file->where;
    if (tle_file_choose(path, from, &query, &out->tle, &error))
        r->status = errors_take(rd->errors, &error, from);
    out->tle.where.file = NULL; /* the path ends here */
    free(path);
}

static void read_tle_lines(reading *rd, reader *r, const toml_node *lines, scenario_orbit *out)
{
    if (lines->n_children != 2 || lines->children[0].type != TOML_STRING ||
        lines->children[1].type != TOML_STRING) {
        reader_fail(r, lines->where, "'tle_lines' must hold two strings: line 1 and line 2");
        return;
    }
    glint_error error;
    place first = lines->children[0].where, second = lines->children[1].where;
    first.column++; /* behind the quote */
    second.column++;
    if (tle_parse(lines->children[0].string, lines->children[1].string, true, first, &second,
                  &out->tle, &error))
        r->status = errors_take(rd->errors, &error, lines->where);
}

/* A warning when the epoch of the element set is far from the run. */
static void warn_of_age(reading *rd, place where, const tle *elements)
{
    static const double FAR_DAYS = 14; /* physics page, section 5 */
    const glint_scenario *s = rd->s;
    double tt_jd[2];
    utc_jd_to_tt(elements->epoch_jd, tt_jd, NULL);
    const double start_days = jd_difference_s(s->clock.tt_jd, tt_jd) / DAY_S;
    const double end_days = start_days + (double)(s->n_steps - 1) * s->step_s / DAY_S;
    const double days = fabs(end_days) > fabs(start_days) ? end_days : start_days;
    if (fabs(days) > FAR_DAYS)
        errors_warn(rd->errors, where,
                    "the element set's epoch lies %.1f days %s the time computed; past 14 days its "
                    "position may be tens of km off",
                    fabs(days), days > 0 ? "before" : "after");
}

static void make_orbit(reading *rd, place where, scenario_orbit *out)
{
    glint_error error;
    glint_status status = GLINT_OK;
    switch (out->source) {
    case ORBIT_TLE:
        status = orbit_from_tle(&out->tle, &rd->s->clock, &out->propagator, &error);
        if (!status) warn_of_age(rd, where, &out->tle);
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

void read_orbit(reading *rd, const toml_node *table, const char *name, scenario_orbit *out)
{
    static const char *const SOURCES[] = {"tle", "tle_lines", "kepler", "circular", "omm", "oem"};
    reader r = reader_start(table, name, rd->errors);
    int given = 0;
    for (size_t k = 0; k < sizeof SOURCES / sizeof *SOURCES; k++)
        given += reader_has(&r, SOURCES[k]);
    if (given != 1)
        reader_fail(&r, table->where,
                    "%s has %s; expected exactly one of tle, tle_lines, kepler, circular", name,
                    given ? "several sources" : "no source");
    reader_refuse(&r, "omm", "this version reads element sets as two lines (tle, tle_lines)");
    reader_refuse(&r, "oem", "this version reads element sets, not position tables");
    if (reader_has(&r, "tle")) {
        const toml_node *file =
            reader_get(&r, "tle", TOML_STRING, true, "the path of a file of element sets");
        out->source = ORBIT_TLE;
        if (file) read_tle_file(rd, &r, file, out);
        reader_has(&r, "tle_name");
        reader_has(&r, "tle_number");
    } else if (reader_has(&r, "tle_lines")) {
        const toml_node *lines =
            reader_get(&r, "tle_lines", TOML_ARRAY, true, "two strings: line 1 and line 2");
        out->source = ORBIT_TLE;
        if (lines) read_tle_lines(rd, &r, lines, out);
    } else if (reader_has(&r, "kepler")) {
        const toml_node *elements = reader_table(&r, "kepler", true);
        if (elements) read_kepler(rd, &r, elements, out);
    } else if (reader_has(&r, "circular")) {
        const toml_node *elements = reader_table(&r, "circular", true);
        if (elements) read_circular(rd, &r, elements, out);
    }
    reading_done(rd, &r);
    if (r.status == GLINT_OK && rd->s->n_steps > 0) make_orbit(rd, table->where, out);
}
