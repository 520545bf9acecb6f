#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/attitude_table.h"
#include "orbit/moon.h"
#include "orbit/time_column.h"
#include "scenario/reading.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const param_info LATITUDE = {"latitude_deg", "deg", "geodetic", -90, 90, PARAM_REQUIRED, 0};
static const param_info LONGITUDE = {"longitude_deg", "deg", "east", -360, 360, PARAM_REQUIRED, 0};
static const param_info HEIGHT = {"height_m", "m", "above WGS84", -10000, 1e7, 0, 0};
static const param_info RA = {"ra_deg", "deg", "ICRS", -360, 360, PARAM_REQUIRED, 0};
static const param_info DEC = {"dec_deg", "deg", "ICRS", -90, 90, PARAM_REQUIRED, 0};

static void read_direction_table(reader *r, const char *key, const toml_node *node, direction *out)
{
    reader inner = reader_start(node, key, r->errors);
    const bool place_given =
        reader_has(&inner, "latitude_deg") || reader_has(&inner, "longitude_deg");
    double a, b, height_m;
    if (place_given) {
        reader_param(&inner, &LATITUDE, &a);
        reader_param(&inner, &LONGITUDE, &b);
        reader_param(&inner, &HEIGHT, &height_m);
        glint_error error;
        if (inner.status == GLINT_OK && direction_place(a * DEG, b * DEG, height_m, out, &error))
            inner.status = errors_take(r->errors, &error, node->where);
    } else {
        reader_param(&inner, &RA, &a);
        reader_param(&inner, &DEC, &b);
        if (inner.status == GLINT_OK) direction_star(a * DEG, b * DEG, out);
    }
    const glint_status status = reader_done(&inner);
    if (status > r->status) r->status = status;
}

bool read_direction(reader *r, const char *key, bool required, direction *out)
{
    static const char EXPECTED[] =
        "a direction: nadir, geodetic-nadir, zenith, velocity, orbit-normal, north, sun, moon, "
        "observer, { ra_deg, dec_deg } or { latitude_deg, longitude_deg }";
    const toml_node *node = reader_find(r, key);
    if (!node) {
        if (required)
            reader_fail(r, r->table->where, "%s has no '%s'; expected %s", r->name, key, EXPECTED);
        return false;
    }
    if (node->type == TOML_TABLE) {
        read_direction_table(r, key, node, out);
        return r->status == GLINT_OK;
    }
    if (node->type == TOML_STRING && direction_from_word(node->string, out)) return true;
    const char *near = NULL;
    const char *words[16];
    size_t n = 0;
    for (; n < 16 && direction_word(n); n++)
        words[n] = direction_word(n);
    if (node->type == TOML_STRING) near = nearest_name(node->string, words, n);
    reader_fail(r, node->where, "'%s' is %s%.40s%s; expected %s%s%s%s", key,
                node->type == TOML_STRING ? "\"" : "",
                node->type == TOML_STRING ? node->string : toml_type_name(node->type),
                node->type == TOML_STRING ? "\"" : "", EXPECTED, near ? " (did you mean \"" : "",
                near ? near : "", near ? "\"?)" : "");
    return false;
}

/* A unit quaternion: norm 1 within 1e-6. */
static bool read_quaternion(reader *r, const attitude_key *key, double q[4])
{
    if (!reader_vector(r, key->name, key->required, 4, q)) return false;
    const double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (fabs(norm - 1) > 1e-6) {
        reader_fail(r, reader_place(r, key->name),
                    "'%s' has norm %.9g; expected a unit quaternion (w, x, y, z)", key->name, norm);
        return false;
    }
    for (int i = 0; i < 4; i++)
        q[i] /= norm;
    return true;
}

static bool read_word(reader *r, const attitude_key *key, double *value)
{
    int n = 0, word;
    while (key->words[n])
        n++;
    const bool given =
        reader_choice(r, key->name, key->words, n, key->required ? -1 : (int)key->def, &word);
    *value = word;
    return given;
}

static bool read_path(reading *rd, reader *r, const attitude_key *key, char **path)
{
    const toml_node *node =
        reader_get(r, key->name, TOML_STRING, key->required, "the path of a file");
    *path = node ? reading_path(rd, node) : NULL;
    return *path != NULL;
}

/* TT s from the start of the run. */
static double seconds_from_start(const reading *rd, const utc_time *utc)
{
    double tt_jd[2];
    utc_to_tt(utc, tt_jd, NULL, NULL);
    return jd_difference_s(tt_jd, rd->s->clock.tt_jd);
}

static void read_key(reading *rd, reader *r, attitude_spec *spec, int k)
{
    const attitude_key *key = &spec->law->keys[k];
    double *value = spec->value[k];
    const param_info number = {
        key->name, key->unit, key->doc, -1e9, 1e9, key->required ? PARAM_REQUIRED : key->def, 0};
    utc_time epoch;
    bool good = false;
    switch (key->kind) {
    case ATTITUDE_NUMBER:
        good = reader_param(r, &number, value);
        break;
    case ATTITUDE_VECTOR:
        good = reader_vector(r, key->name, key->required, 3, value);
        break;
    case ATTITUDE_AXIS:
        good = reader_axis(r, key->name, key->required, value);
        break;
    case ATTITUDE_DIRECTION:
        good = read_direction(r, key->name, key->required, &spec->to[k]);
        break;
    case ATTITUDE_QUATERNION:
        good = read_quaternion(r, key, value);
        break;
    case ATTITUDE_EPOCH:
        good = reader_time(r, key->name, key->required, &epoch);
        if (good) value[0] = seconds_from_start(rd, &epoch);
        break;
    case ATTITUDE_WORD:
        good = read_word(r, key, value);
        break;
    case ATTITUDE_STRING:
        good = reader_string(r, key->name, key->required, &spec->text[k]);
        break;
    case ATTITUDE_PATH:
        good = read_path(rd, r, key, &spec->path);
        break;
    }
    spec->given[k] = good;
    spec->key_place[k] = reader_place(r, key->name);
}

static void read_offset(reader *r, attitude_spec *spec)
{
    static const param_info ANGLE = {"angle", "deg", "", -360, 360, PARAM_REQUIRED, 0};
    const toml_node *node = reader_table(r, "offset_deg", false);
    if (!node) return;
    reader inner = reader_start(node, "offset_deg", r->errors);
    double angle_deg = 0;
    spec->has_offset = true;
    reader_axis(&inner, "axis", true, spec->offset_axis);
    reader_param(&inner, &ANGLE, &angle_deg);
    spec->offset_rad = angle_deg * DEG;
    const glint_status status = reader_done(&inner);
    if (status > r->status) r->status = status;
}

/* Reads the law of one table into a leg; its moment and its slew are read already. */
static void read_law(reading *rd, reader *r, attitude_leg *leg)
{
    const char *names[32], *name;
    size_t n = 0;
    for (; n < 32 && attitude_law_at(n); n++)
        names[n] = attitude_law_at(n)->name;
    if (!reader_string(r, "law", true, &name)) {
        reading_note(rd, r->status);
        return;
    }
    const attitude_law *law = attitude_law_named(name);
    if (!law) {
        int index;
        reader_choice(r, "law", names, (int)n, -1, &index); /* lists them */
        reading_note(rd, r->status);
        return;
    }
    attitude_spec spec;
    attitude_spec_start(law, r->table->where, &spec);
    spec.clock = &rd->s->clock;
    for (int k = 0; k < law->n_keys; k++)
        read_key(rd, r, &spec, k);
    read_offset(r, &spec);
    /* Where the time is wrong there is no clock to count a file's times from. */
    if (reader_done(r) == GLINT_OK && rd->s->n_steps > 0)
        r->status = attitude_prepare(&spec, &leg->law, rd->errors);
    free(spec.path);
    reading_note(rd, r->status);
}

/* A UTC time or seconds from the start. */
static bool read_from(reading *rd, reader *r, double *from_s)
{
    static const param_info FROM = {"from", "s", "", -2e9, 2e9, 0, 0};
    const toml_node *node = reader_find(r, FROM.name);
    utc_time utc;
    if (!node) return false;
    if (node->type == TOML_INTEGER || node->type == TOML_FLOAT)
        return reader_param(r, &FROM, from_s);
    if (!reader_time(r, FROM.name, false, &utc)) return false;
    *from_s = seconds_from_start(rd, &utc);
    return true;
}

/* When a law of a sequence begins, and how the body is turned to it. */
static void read_change(reading *rd, reader *r, int k, attitude_leg *leg)
{
    static const param_info SLEW = {"slew_s", "s", "", 0, 1e6, 0, 0};
    static const param_info RATE = {"slew_rate_deg_s", "deg/s", "", 0, 1e4, 0, PARAM_MIN_OPEN};
    const attitude_plan *plan = &rd->s->attitude;
    double rate_deg_s;
    const bool has_from = read_from(rd, r, &leg->from_s);
    const bool has_slew = reader_param(r, &SLEW, &leg->slew_s);
    const bool has_rate = reader_param(r, &RATE, &rate_deg_s);
    leg->rate_rad_s = has_rate ? rate_deg_s * DEG : 0;
    if (k == 0 && has_from && leg->from_s > 0)
        reader_fail(r, reader_place(r, "from"),
                    "the first law begins %.10g s after the start of the run; expected it at the "
                    "start, or no 'from'",
                    leg->from_s);
    if (k == 0 && (has_slew || has_rate))
        reader_fail(r, reader_place(r, has_slew ? SLEW.name : RATE.name),
                    "the first law has no law before it from which to turn; take the key out");
    if (k > 0 && !reader_has(r, "from"))
        reader_fail(r, r->table->where,
                    "this law has no 'from'; expected the time when it takes over, UTC or seconds "
                    "from the start");
    if (k > 0 && has_from && plan->n > 0 && !(leg->from_s > plan->legs[plan->n - 1].from_s))
        reader_fail(r, reader_place(r, "from"),
                    "this law begins %g s before the one above it; expected times that grow",
                    plan->legs[plan->n - 1].from_s - leg->from_s);
    if (has_slew && has_rate)
        reader_fail(r, reader_place(r, RATE.name),
                    "both slew_s and slew_rate_deg_s are given; expected one of them");
    if (k == 0 && !has_from) leg->from_s = -INFINITY;
}

static void read_leg(reading *rd, const toml_node *table, int k)
{
    reader r = reader_start(table, k < 0 ? "[attitude]" : "[[attitude]]", rd->errors);
    attitude_leg leg = {.where = table->where};
    if (k >= 0) read_change(rd, &r, k, &leg);
    read_law(rd, &r, &leg);
    reading_note(rd, attitude_plan_add(&rd->s->attitude, &leg, rd->errors));
}

/* The observer's direction when a slew begins, light time left aside (3e-5 rad): it only decides
 * the side and the length of the slew. */
static glint_status observer_of_slew(const glint_scenario *s, const frame_set *frames, moment *m,
                                     glint_error *error)
{
    const scenario_observer *o = s->observers; /* of several the first: the turn is one for all */
    double place_m[3], v_m_s[3];
    if (s->n_observers == 0) return GLINT_OK; /* it was wrong, and that has been said */
    if (o->kind == OBSERVER_DIRECTION) {
        copy3(o->direction, m->observer);
        return GLINT_OK;
    }
    if (o->kind == OBSERVER_SATELLITE) {
        if (!o->orbit.propagator) return GLINT_OK;
        const glint_status status =
            orbit_state(o->orbit.propagator, m->t_s, frames, NULL, place_m, v_m_s, error);
        if (status) return status;
    } else {
        mat_tvec(m->itrs_gcrs, o->site.r_itrs_m, place_m);
    }
    sub3(place_m, m->r_m, m->observer);
    unit3(m->observer, m->observer);
    return GLINT_OK;
}

/* What the laws of a slew look at when it begins. */
static glint_status moment_of_slew(const glint_scenario *s, double t_s, moment *m,
                                   glint_error *error)
{
    static const double GRID_STEP_S = 1; /* any below the grid's own: it is never passed by */
    const earth_orientation still = {0, 0};
    frame_grid *grid = NULL;
    frame_set frames;
    double distance_m;
    glint_status status =
        frame_grid_prepare(&s->clock, &still, t_s, t_s, GRID_STEP_S, &grid, error);
    if (status) return status;
    frame_grid_at(grid, t_s, FRAMES_TEME | FRAMES_SUN, &frames);
    frame_grid_free(grid);
    *m = (moment){.t_s = t_s};
    status = orbit_state(s->orbit.propagator, t_s, &frames, NULL, m->r_m, m->v_m_s, error);
    if (status) return status;
    memcpy(m->itrs_gcrs, frames.itrs_gcrs, sizeof m->itrs_gcrs);
    sun_from_point(&frames, m->r_m, s->aberration, m->sun, &distance_m);
    moon_position(&s->clock, t_s, NULL, m->moon);
    sub3(m->moon, m->r_m, m->moon);
    unit3(m->moon, m->moon);
    return observer_of_slew(s, &frames, m, error);
}

/* Begins the slew of leg k, and sees that it ends before the next one. */
static void settle(reading *rd, int k)
{
    glint_scenario *s = rd->s;
    attitude_leg *leg = &s->attitude.legs[k];
    const attitude_leg *next = k + 1 < s->attitude.n ? leg + 1 : NULL;
    moment start;
    glint_error error;
    glint_status status = moment_of_slew(s, leg->from_s, &start, &error);
    if (!status) status = attitude_plan_settle(&s->attitude, k, &start, &error);
    if (status) {
        reading_note(rd, errors_take(rd->errors, &error, leg->where));
        return;
    }
    if (next && leg->from_s + leg->slew_s > next->from_s)
        reading_note(rd, errors_add(rd->errors, GLINT_INPUT, leg->where,
                                    "the slew to this law takes %.6g s and ends %.6g s after the "
                                    "next law begins; expected it to end before",
                                    leg->slew_s, leg->from_s + leg->slew_s - next->from_s));
}

/* Whether the run has rows at or after the beginning of a slew to this law. */
static bool is_slewed_to(const glint_scenario *s, const attitude_leg *leg)
{
    const double end_s = (double)(s->n_steps - 1) * s->step_s;
    return leg->from_s <= end_s && (leg->rate_rad_s > 0 || leg->slew_s > fmax(0, -leg->from_s));
}

/* Tables that do not reach over the time when they are in use: rows there cannot be computed. */
static void warn_of_gaps(reading *rd)
{
    const glint_scenario *s = rd->s;
    for (int k = 0; k < s->attitude.n; k++) {
        double gap_s;
        if (attitude_plan_gap(&s->attitude, k, (double)(s->n_steps - 1) * s->step_s, &gap_s))
            errors_warn(rd->errors, s->attitude.legs[k].where,
                        "the attitude table says nothing at %.10g s from the start; a run that has "
                        "rows there ends with an error",
                        gap_s);
    }
}

void read_attitude(reading *rd, reader *root)
{
    const toml_node *node = reader_find(root, "attitude");
    const glint_status before = rd->status;
    rd->status = GLINT_OK;
    if (node && node->type == TOML_ARRAY) {
        const toml_node *tables = reader_tables(root, "attitude");
        for (int k = 0; tables && k < tables->n_children; k++)
            read_leg(rd, &tables->children[k], k);
        if (!tables && root->status == GLINT_OK)
            reader_fail(root, node->where, "'attitude' is empty; expected at least one law");
    } else {
        const toml_node *table = reader_table(root, "attitude", true);
        if (table) read_leg(rd, table, -1);
    }
    const bool sound = rd->status == GLINT_OK && rd->s->n_steps > 0 && rd->s->attitude.n > 0;
    for (int k = 1; sound && rd->s->orbit.propagator && k < rd->s->attitude.n; k++)
        if (is_slewed_to(rd->s, &rd->s->attitude.legs[k])) settle(rd, k);
    if (sound && rd->status == GLINT_OK) warn_of_gaps(rd);
    reading_note(rd, before);
}

/* ------------------------------------------------------------------ hinges */

/* The times that the run asks hinges for; false where they are not known (a model file alone). */
static bool run_span(const glint_scenario *s, double *from_s, double *to_s)
{
    *from_s = 0;
    *to_s = (double)(s->n_steps - 1) * s->step_s;
    for (int64_t k = 0; s->has_geometry && k < s->geometry.n; k++) {
        *from_s = k > 0 ? fmin(*from_s, s->geometry.t_s[k]) : s->geometry.t_s[k];
        *to_s = k > 0 ? fmax(*to_s, s->geometry.t_s[k]) : s->geometry.t_s[k];
    }
    return s->n_steps > 0;
}

static void read_hinge_table(reading *rd, reader *r, hinge *out)
{
    const toml_node *file = reader_get(r, "table", TOML_STRING, true, "the path of a CSV file");
    bool shortest_way;
    reader_boolean(r, "shortest_way", false, &shortest_way);
    char *path = file ? reading_path(rd, file) : NULL;
    if (!path) return;
    /* A model file alone has no time; any will do to see whether its tables are sound. */
    static const utc_time any = {.year = 2000, .month = 1, .day = 1};
    run_clock clock = rd->s->clock;
    double from_s, to_s;
    const bool has_span = run_span(rd->s, &from_s, &to_s);
    if (!has_span) run_clock_start(&any, 0, 0, &clock);
    const glint_status status = hinge_set_table(
        out, path, shortest_way, rd->s->has_geometry ? NULL : &clock, file->where, rd->errors);
    free(path);
    if (status > r->status) r->status = status;
    const hinge_table *t = &out->table;
    if (!status && has_span &&
        (t->t_s[0] - TIME_LEAD_S > from_s || t->t_s[t->n - 1] + TIME_SLACK_S < to_s))
        errors_warn(rd->errors, file->where,
                    "the table goes from %.10g to %.10g s, the run from %.10g to %.10g s; a run "
                    "that has rows outside the table ends with an error",
                    t->t_s[0], t->t_s[t->n - 1], from_s, to_s);
}

static void read_track(reading *rd, reader *r, hinge *out)
{
    double face[3];
    read_direction(r, "track", true, &out->target);
    if (rd->s->has_geometry && r->status == GLINT_OK && out->target.kind != DIRECTION_SUN &&
        out->target.kind != DIRECTION_OBSERVER)
        reader_fail(r, reader_place(r, "track"),
                    "directions given by [geometry] know the Sun and the observer only; expected "
                    "track = \"sun\" or \"observer\"");
    glint_error error;
    if (reader_axis(r, "face", true, face) && r->status == GLINT_OK &&
        hinge_set_face(out, face, reader_place(r, "face"), &error))
        r->status = errors_take(r->errors, &error, reader_place(r, "face"));
}

/* A key that says something of a drive that is not given. */
static void refuse_without(reader *r, const char *key, const char *drive)
{
    if (reader_has(r, key))
        reader_fail(r, reader_place(r, key),
                    "'%s' belongs to '%s', which is not given; expected both or neither", key,
                    drive);
}

static void read_drive(reading *rd, reader *r, hinge *out)
{
    static const param_info ANGLE = {"angle_deg", "deg", "", -1e9, 1e9, 0, 0};
    static const param_info RATE = {"rate_deg_s", "deg/s", "", -1e6, 1e6, 0, 0};
    double angle_deg, rate_deg_s;
    const bool has_angle = reader_param(r, &ANGLE, &angle_deg);
    const bool has_rate = reader_param(r, &RATE, &rate_deg_s);
    const bool has_track = reader_has(r, "track"), has_table = reader_has(r, "table");
    out->angle = angle_deg * DEG;
    out->rate_rad_s = rate_deg_s * DEG;
    out->drive = has_track   ? HINGE_TRACK
                 : has_table ? HINGE_TABLE
                 : has_rate  ? HINGE_RATE
                             : HINGE_FIXED;
    if (!has_track) refuse_without(r, "face", "track");
    if (!has_table) refuse_without(r, "shortest_way", "table");
    if (!has_track && !has_table && !reader_has(r, ANGLE.name) && !reader_has(r, RATE.name))
        reader_fail(r, r->table->where,
                    "the hinge has no drive; expected one of angle_deg, rate_deg_s, track, table");
    if (has_track && has_table)
        reader_fail(r, reader_place(r, "table"),
                    "the hinge has both 'track' and 'table'; expected one drive");
    else if ((has_track || has_table) && (has_angle || has_rate))
        reader_fail(r, reader_place(r, has_angle ? "angle_deg" : "rate_deg_s"),
                    "the hinge has both '%s' and '%s'; expected one drive",
                    has_track ? "track" : "table", has_angle ? "angle_deg" : "rate_deg_s");
    if (has_track) read_track(rd, r, out);
    if (has_table) read_hinge_table(rd, r, out);
}

void read_hinge(reading *rd, const toml_node *table, hinge *out)
{
    static const double FARTHEST_M = 1e7; /* as for the centres of primitives */
    static const param_info OFFSET = {"offset_deg", "deg", "", -360, 360, 0, 0};
    *out = (hinge){0};
    reader r = reader_start(table, "hinge", rd->errors);
    double offset_deg, limits[2];
    if (reader_vector(&r, "origin_m", true, 3, out->origin_m) &&
        !(norm3(out->origin_m) <= FARTHEST_M))
        reader_fail(&r, reader_place(&r, "origin_m"),
                    "the hinge lies %g m from its parent's origin; expected at most %g m",
                    norm3(out->origin_m), FARTHEST_M);
    reader_axis(&r, "axis", true, out->axis);
    read_drive(rd, &r, out);
    reader_param(&r, &OFFSET, &offset_deg);
    out->offset = offset_deg * DEG;
    if (reader_vector(&r, "limits_deg", false, 2, limits)) {
        out->has_limits = true;
        out->limits[0] = limits[0] * DEG;
        out->limits[1] = limits[1] * DEG;
        if (limits[0] > limits[1])
            reader_fail(&r, reader_place(&r, "limits_deg"),
                        "limits_deg = [%g, %g]: the lower limit lies above the upper one; expected "
                        "[lower, upper]",
                        limits[0], limits[1]);
    }
    reading_done(rd, &r);
}
