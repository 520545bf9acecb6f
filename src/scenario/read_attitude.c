#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "scenario/reading.h"

#include <math.h>
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
        if (good) {
            double tt_jd[2], tai_minus_utc_s;
            utc_to_tt(&epoch, tt_jd, &tai_minus_utc_s, NULL);
            value[0] = jd_difference_s(tt_jd, rd->s->clock.tt_jd);
        }
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

/* Laws that are planned: their names are known, and refused by name. */
static bool is_planned(const char *law)
{
    return string_equal(law, "table");
}

void read_attitude(reading *rd, reader *root)
{
    const toml_node *table = reader_table(root, "attitude", true);
    if (!table) return;
    reader r = reader_start(table, "[attitude]", rd->errors);
    const char *names[32], *name;
    size_t n = 0;
    for (; n < 32 && attitude_law_at(n); n++)
        names[n] = attitude_law_at(n)->name;
    if (!reader_string(&r, "law", true, &name)) {
        reading_note(rd, r.status);
        return;
    }
    const attitude_law *law = attitude_law_named(name);
    if (!law) {
        int index;
        if (is_planned(name))
            reader_fail(&r, reader_place(&r, "law"),
                        "the law \"%s\" is not built yet; expected another one", name);
        else
            reader_choice(&r, "law", names, (int)n, -1, &index); /* lists them */
        reading_note(rd, r.status);
        return;
    }
    attitude_spec spec;
    attitude_spec_start(law, table->where, &spec);
    for (int k = 0; k < law->n_keys; k++)
        read_key(rd, &r, &spec, k);
    read_offset(&r, &spec);
    if (reader_done(&r) == GLINT_OK)
        r.status = attitude_prepare(&spec, &rd->s->attitude, rd->errors);
    reading_note(rd, r.status);
}

/* ------------------------------------------------------------------ hinges */

static void read_drive(reading *rd, reader *r, hinge *out)
{
    static const param_info ANGLE = {"angle_deg", "deg", "", -1e9, 1e9, 0, 0};
    static const param_info RATE = {"rate_deg_s", "deg/s", "", -1e6, 1e6, 0, 0};
    double angle_deg, rate_deg_s, face[3];
    const bool has_angle = reader_param(r, &ANGLE, &angle_deg);
    const bool has_rate = reader_param(r, &RATE, &rate_deg_s);
    const bool has_track = reader_has(r, "track");
    reader_refuse(r, "table", "this version turns hinges by angle_deg, rate_deg_s or track");
    out->angle = angle_deg * DEG;
    out->rate_rad_s = rate_deg_s * DEG;
    out->drive = has_track ? HINGE_TRACK : has_rate ? HINGE_RATE : HINGE_FIXED;
    if (!has_track) {
        if (reader_has(r, "face"))
            reader_fail(r, reader_place(r, "face"),
                        "'face' belongs to 'track', which is not given; expected both or neither");
        if (!reader_has(r, ANGLE.name) && !reader_has(r, RATE.name) &&
            !toml_child(r->table, "table"))
            reader_fail(r, r->table->where,
                        "the hinge has no drive; expected one of angle_deg, rate_deg_s, track");
        return;
    }
    if (has_angle || has_rate)
        reader_fail(r, reader_place(r, has_angle ? "angle_deg" : "rate_deg_s"),
                    "the hinge has both 'track' and '%s'; expected one drive",
                    has_angle ? "angle_deg" : "rate_deg_s");
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
