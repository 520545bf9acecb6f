/* read_observer.c: [observer]: a site, a satellite or a direction; or several in [[observer]]. */
#include "base/constants.h"
#include "base/csv.h"
#include "base/text.h"
#include "base/vec.h"
#include "scenario/reading.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const param_info LATITUDE = {"latitude_deg", "deg", "geodetic, north positive", -90, 90,
                                    PARAM_REQUIRED, 0};
static const param_info LONGITUDE = {"longitude_deg", "deg", "east positive", -360, 360,
                                     PARAM_REQUIRED,  0};
static const param_info HEIGHT = {"height_m", "m", "above the WGS84 ellipsoid", -10000, 100000,
                                  0,          0};
static const param_info ELEVATION = {
    "min_elevation_deg", "deg", "lower is below the horizon", -90, 90, 0, 0};
static const param_info MASK_AZIMUTH = {"azimuth_deg",  "deg", "from north through east", -360, 360,
                                        PARAM_REQUIRED, 0};
static const param_info MASK_ELEVATION = {"elevation_deg", "deg", "", -90, 90, PARAM_REQUIRED, 0};

enum { MOST_MASK_POINTS = 100000, MOST_OBSERVERS = 1000, LONGEST_NAME = 64 };

/* ------------------------------------------------------------------ horizon */

/* Points of a mask with the places that they were read from. */
typedef struct mask {
    horizon_point *points; /* owned; handed over to the horizon */
    place *places;         /* owned */
    int n;
} mask;

static bool mask_reserve(reading *rd, mask *m, long n)
{
    m->points = calloc((size_t)n + 1, sizeof *m->points);
    m->places = calloc((size_t)n + 1, sizeof *m->places);
    if (m->points && m->places) return true;
    reading_no_memory(rd);
    return false;
}

static void mask_add(reading *rd, mask *m, double azimuth_deg, double elevation_deg, place where)
{
    if (!param_accepts(&MASK_AZIMUTH, azimuth_deg) ||
        !param_accepts(&MASK_ELEVATION, elevation_deg)) {
        reading_note(rd, errors_add(rd->errors, GLINT_INPUT, where,
                                    "the horizon has azimuth %g deg, elevation %g deg; expected "
                                    "-360 to 360, and -90 to 90",
                                    azimuth_deg, elevation_deg));
        return;
    }
    m->places[m->n] = where;
    m->points[m->n++] = (horizon_point){azimuth_deg * DEG, elevation_deg * DEG, 0};
}

static void mask_from_list(reading *rd, reader *r, mask *m)
{
    const toml_node *list =
        reader_get(r, "horizon_deg", TOML_ARRAY, true, "a list of [azimuth, elevation]");
    if (!list) return;
    if (list->n_children < 1 || list->n_children > MOST_MASK_POINTS) {
        reader_fail(r, list->where, "'horizon_deg' has %d points; expected 1 to %d",
                    list->n_children, MOST_MASK_POINTS);
        return;
    }
    if (!mask_reserve(rd, m, list->n_children)) return;
    for (int i = 0; i < list->n_children; i++) {
        double point[2];
        if (node_vector(&list->children[i], "a point of horizon_deg", 2, point, r))
            mask_add(rd, m, point[0], point[1], list->children[i].where);
    }
}

static void mask_from_table(reading *rd, csv_table *csv, mask *m)
{
    const int azimuth = csv_column(csv, MASK_AZIMUTH.name);
    const int elevation = csv_column(csv, MASK_ELEVATION.name);
    if (azimuth < 0 || elevation < 0) {
        reading_note(rd, errors_add(rd->errors, GLINT_INPUT, csv_place(csv, &csv->cells[0]),
                                    "the table has no column '%s'; expected azimuth_deg and "
                                    "elevation_deg",
                                    azimuth < 0 ? MASK_AZIMUTH.name : MASK_ELEVATION.name));
        return;
    }
    csv_leave_out_cut_row(csv, rd->errors);
    const long n = csv->n_rows;
    if (n < 1 || n > MOST_MASK_POINTS) {
        reading_note(rd, errors_add(rd->errors, GLINT_INPUT, (place){csv->path, 0, 0},
                                    "the table has %ld whole rows; expected 1 to %d", n,
                                    MOST_MASK_POINTS));
        return;
    }
    if (!mask_reserve(rd, m, n)) return;
    for (long row = 0; row < n; row++) {
        double azimuth_deg, elevation_deg;
        glint_status status = csv_number(csv, row, azimuth, &azimuth_deg, rd->errors);
        if (csv_number(csv, row, elevation, &elevation_deg, rd->errors)) status = GLINT_INPUT;
        reading_note(rd, status);
        if (!status)
            mask_add(rd, m, azimuth_deg, elevation_deg, csv_place(csv, csv_at(csv, row, azimuth)));
    }
}

static void make_horizon(reading *rd, mask *m, double least, scenario_observer *out)
{
    const int twice = horizon_make(least, m->points, m->n, &out->horizon);
    m->points = NULL;
    if (twice >= 0)
        reading_note(rd, errors_add(rd->errors, GLINT_INPUT, m->places[twice],
                                    "this azimuth has another elevation already; expected one "
                                    "elevation for each (for a step, move one by 0.01 deg)"));
}

static void read_horizon(reading *rd, reader *r, double least, scenario_observer *out)
{
    mask m = {0};
    csv_table csv = {0};
    const bool has_file = reader_has(r, "horizon"), has_list = reader_has(r, "horizon_deg");
    if (has_file && has_list)
        reader_fail(r, reader_place(r, "horizon_deg"),
                    "both 'horizon' and 'horizon_deg' are given; expected one of them");
    if (has_file) {
        const toml_node *file =
            reader_get(r, "horizon", TOML_STRING, true, "the path of a CSV file");
        char *path = file ? reading_path(rd, file) : NULL;
        if (path) {
            const glint_status status = csv_read(path, file->where, &csv, rd->errors);
            reading_note(rd, status);
            if (!status) mask_from_table(rd, &csv, &m);
        }
        free(path);
    } else if (has_list) {
        mask_from_list(rd, r, &m);
    }
    make_horizon(rd, &m, least, out);
    csv_free(&csv); /* the places name its path up to here */
    free(m.places);
}

/* --------------------------------------------------------------- refraction */

static void read_refraction(reading *rd, reader *r, scenario_observer *out)
{
    static const param_info PRESSURE = {"pressure_hPa", "hPa",      "at the site", 0,
                                        1200,           PARAM_NONE, PARAM_OPTIONAL};
    static const param_info TEMPERATURE = {"temperature_C", "deg C",       "at the site", -100, 60,
                                           PARAM_NONE,      PARAM_OPTIONAL};
    const toml_node *node = reader_find(r, "refraction");
    if (!node || (node->type == TOML_BOOLEAN && !node->boolean)) return;
    out->air = refraction_standard(out->site.height_m);
    if (node->type == TOML_BOOLEAN) return;
    if (node->type != TOML_TABLE) {
        reader_fail(r, node->where,
                    "'refraction' is %s; expected true, false, or a table such as "
                    "{ pressure_hPa = 1010, temperature_C = 10 }",
                    toml_type_name(node->type));
        return;
    }
    reader table = reader_start(node, "refraction", rd->errors);
    double pressure, temperature;
    if (reader_param(&table, &PRESSURE, &pressure)) out->air.pressure_hpa = pressure;
    if (reader_param(&table, &TEMPERATURE, &temperature)) out->air.temperature_c = temperature;
    reading_done(rd, &table);
}

/* ---------------------------------------------------------------- the kinds */

static const char *const SITE_KEYS[] = {"latitude_deg",      "longitude_deg", "height_m",
                                        "min_elevation_deg", "horizon",       "horizon_deg",
                                        "refraction"};

static void read_site(reading *rd, reader *r, scenario_observer *out)
{
    double latitude, longitude, height_m, elevation_deg;
    out->kind = OBSERVER_SITE;
    reader_param(r, &LATITUDE, &latitude);
    reader_param(r, &LONGITUDE, &longitude);
    reader_param(r, &HEIGHT, &height_m);
    reader_param(r, &ELEVATION, &elevation_deg);
    glint_error error;
    if (r->status == GLINT_OK &&
        earth_site_at(latitude * DEG, longitude * DEG, height_m, &out->site, &error))
        r->status = errors_take(rd->errors, &error, r->table->where);
    read_horizon(rd, r, elevation_deg * DEG, out);
    read_refraction(rd, r, out);
}

/* [observer.direction]: where the observer is, seen from the satellite. */
static void read_fixed_direction(reading *rd, const toml_node *table, scenario_observer *out)
{
    /* Light takes 2 s over the longest: what the frames of a run are prepared for. */
    static const param_info RANGE = {"range_km", "km", "observer to satellite", 1e-6, 5.9e5,
                                     1000,       0};
    static const param_info RA = {"ra_deg", "deg", "", -360, 360, PARAM_REQUIRED, 0};
    static const param_info DEC = {"dec_deg", "deg", "", -90, 90, PARAM_REQUIRED, 0};
    static const char *const FRAMES[] = {"body", "gcrs"};
    reader r = reader_start(table, "[observer.direction]", rd->errors);
    int frame;
    double range_km, ra, dec;
    out->kind = OBSERVER_DIRECTION;
    const bool has_frame = reader_choice(&r, "frame", FRAMES, 2, -1, &frame);
    out->in_body = has_frame && frame == 0;
    reader_param(&r, &RANGE, &range_km);
    out->range_m = range_km * 1e3;
    const bool has_ra = reader_has(&r, RA.name), has_dec = reader_has(&r, DEC.name);
    const bool angles = has_ra || has_dec;
    if (angles && reader_has(&r, "vector")) {
        reader_fail(&r, reader_place(&r, "vector"),
                    "both 'vector' and 'ra_deg', 'dec_deg' are given; expected one of them");
    } else if (angles) {
        direction star;
        if (out->in_body)
            reader_fail(&r, reader_place(&r, "frame"),
                        "the body frame has no right ascension; expected 'vector', or "
                        "frame = \"gcrs\"");
        if (reader_param(&r, &RA, &ra) && reader_param(&r, &DEC, &dec)) {
            direction_star(ra * DEG, dec * DEG, &star);
            copy3(star.star, out->direction);
        }
    } else {
        reader_axis(&r, "vector", true, out->direction);
    }
    reading_done(rd, &r);
}

/* The keys of a site stand beside another kind of observer. */
static void refuse_site_keys(reader *r, const char *kind)
{
    for (size_t k = 0; k < sizeof SITE_KEYS / sizeof *SITE_KEYS; k++)
        if (reader_has(r, SITE_KEYS[k]))
            reader_fail(r, reader_place(r, SITE_KEYS[k]),
                        "'%s' stands beside '%s', which is no site; expected one kind of observer",
                        SITE_KEYS[k], kind);
}

static void read_observer(reading *rd, const toml_node *table, const char *name,
                          scenario_observer *out)
{
    reader r = reader_start(table, name, rd->errors);
    *out = (scenario_observer){.name = "", .where = table->where};
    reader_string(&r, "name", false, &out->name);
    const bool flies = reader_has(&r, "satellite"), fixed = reader_has(&r, "direction");
    if (flies && fixed)
        reader_fail(&r, reader_place(&r, "direction"),
                    "both 'satellite' and 'direction' are given; expected one of them");
    if (flies) {
        const toml_node *own = reader_table(&r, "satellite", true);
        out->kind = OBSERVER_SATELLITE;
        refuse_site_keys(&r, "satellite");
        if (own) read_orbit(rd, own, "[observer.satellite]", &out->orbit);
    } else if (fixed) {
        const toml_node *way = reader_table(&r, "direction", true);
        refuse_site_keys(&r, "direction");
        if (way) read_fixed_direction(rd, way, out);
    } else {
        read_site(rd, &r, out);
    }
    reading_done(rd, &r);
}

/* ---------------------------------------------------------------- the whole */

/* The names tell the rows of several observers apart: they are needed, and stand in the table. */
static void check_names(reading *rd)
{
    const glint_scenario *s = rd->s;
    for (int i = 0; i < s->n_observers && s->n_observers > 1; i++) {
        const scenario_observer *o = &s->observers[i];
        bool plain = strlen(o->name) <= LONGEST_NAME && !strchr(o->name, '"');
        for (const char *c = o->name; *c; c++)
            plain = plain && (unsigned char)*c >= ' ' && *c != 127;
        if (!o->name[0])
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, o->where,
                                        "there are several observers, and this one has no name; "
                                        "expected a name for each"));
        else if (!plain)
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, o->where,
                                        "the name of this observer cannot stand in a table; "
                                        "expected up to %d bytes without double quotes and control "
                                        "characters",
                                        LONGEST_NAME));
        for (int k = 0; k < i; k++)
            if (o->name[0] && string_equal(o->name, s->observers[k].name))
                reading_note(rd, errors_add(rd->errors, GLINT_INPUT, o->where,
                                            "another observer is named '%s', too; expected "
                                            "different names",
                                            o->name));
    }
}

/* What the other tables ask of the observers. */
static void check_extinction(reading *rd)
{
    const glint_scenario *s = rd->s;
    if (!s->has_extinction) return;
    bool any_site = false;
    for (int i = 0; i < s->n_observers; i++) {
        const scenario_observer *o = &s->observers[i];
        if (o->kind != OBSERVER_SITE) continue;
        any_site = true;
        if (o->horizon.lowest < 0)
            reading_note(rd, errors_add(rd->errors, GLINT_INPUT, o->where,
                                        "extinction is wanted and min_elevation_deg is below 0, "
                                        "where there is no airmass; expected one of them to be "
                                        "left out"));
    }
    if (!any_site && s->n_observers > 0)
        reading_note(rd, errors_add(rd->errors, GLINT_INPUT, s->observers[0].where,
                                    "extinction is wanted and no observer is a site; expected "
                                    "extinction = false"));
}

void read_observers(reading *rd, reader *root)
{
    glint_scenario *s = rd->s;
    const toml_node *node = reader_find(root, "observer");
    const bool many = node && node->type == TOML_ARRAY;
    const toml_node *list = many ? reader_tables(root, "observer") : NULL;
    const toml_node *table = many ? NULL : reader_table(root, "observer", true);
    const int n = list ? list->n_children : table ? 1 : 0;
    if (many && node->n_children == 0)
        reader_fail(root, node->where, "'observer' is empty; expected at least one observer");
    if (n == 0) return;
    if (n > MOST_OBSERVERS) {
        reader_fail(root, list->where, "there are %d observers; expected at most %d", n,
                    MOST_OBSERVERS);
        return;
    }
    s->observers = calloc((size_t)n, sizeof *s->observers);
    if (!s->observers) {
        reading_no_memory(rd);
        return;
    }
    s->n_observers = n;
    for (int i = 0; i < n; i++)
        read_observer(rd, list ? &list->children[i] : table, list ? "[[observer]]" : "[observer]",
                      &s->observers[i]);
    check_names(rd);
    check_extinction(rd);
}

void observers_free(glint_scenario *s)
{
    for (int i = 0; i < s->n_observers; i++) {
        horizon_free(&s->observers[i].horizon);
        scenario_orbit_free(&s->observers[i].orbit);
    }
    free(s->observers);
}
