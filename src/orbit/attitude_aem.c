/* attitude_aem.c: attitude ephemeris messages, CCSDS 504.0-B-1 (version 1.0) and 504.0-B-2 (2.0).
 *
 * A message describes the turn of frame A's coordinates into frame B's. Its quaternion is that of
 * the frame transformation, whose four numbers are those of q with v_A = q v_B q* (the quaternion
 * of the coordinate change and that of the turn are each other's conjugates, and so are the two
 * products in which they are used). Euler angles are turns of the frame about its own axes, the
 * first one first. In SPIN the spin axis is z of the body: turned by 90 deg + alpha about z, by
 * 90 deg - delta about the new x, by the spin angle about the new z. */
#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/attitude_table_parts.h"
#include "orbit/ccsds.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef enum aem_kind { AEM_QUATERNION, AEM_EULER, AEM_SPIN } aem_kind;

/* What stands in the rows of an ATTITUDE_TYPE. */
typedef struct aem_type {
    const char *name;
    aem_kind kind;
    int n_numbers;       /* in a row, after the time */
    const char *refused; /* why it is not read; NULL: it is */
} aem_type;

static const char NUTATES[] = "how its angles fit together is not said well enough by the standard";
static const aem_type types[] = {
    {"QUATERNION", AEM_QUATERNION, 4, NULL},
    {"QUATERNION/DERIVATIVE", AEM_QUATERNION, 8, NULL},
    {"QUATERNION/RATE", AEM_QUATERNION, 7, NULL},
    {"QUATERNION/ANGVEL", AEM_QUATERNION, 7, NULL},
    {"EULER_ANGLE", AEM_EULER, 3, NULL},
    {"EULER_ANGLE/RATE", AEM_EULER, 6, NULL},
    {"EULER_ANGLE/DERIVATIVE", AEM_EULER, 6, NULL},
    {"EULER_ANGLE/ANGVEL", AEM_EULER, 6, NULL},
    {"SPIN", AEM_SPIN, 4, NULL},
    {"SPIN/NUTATION", AEM_SPIN, 7, NUTATES},
    {"SPIN/NUTATION_MOM", AEM_SPIN, 7, NUTATES},
};
enum { N_TYPES = sizeof types / sizeof *types, MOST_NUMBERS = 8 };

/* The metadata of a segment; items borrowed, NULL where not given. */
enum {
    META_OBJECT_NAME,
    META_OBJECT_ID,
    META_CENTER,
    META_FRAME_A,
    META_FRAME_B,
    META_DIR,
    META_TIME_SYSTEM,
    META_START,
    META_STOP,
    META_USEABLE_START,
    META_USEABLE_STOP,
    META_TYPE,
    META_QUATERNION_TYPE,
    META_EULER,
    N_META
};
static const char *const meta_names[N_META] = {
    "OBJECT_NAME",       "OBJECT_ID",     "CENTER_NAME",     "REF_FRAME_A",  "REF_FRAME_B",
    "ATTITUDE_DIR",      "TIME_SYSTEM",   "START_TIME",      "STOP_TIME",    "USEABLE_START_TIME",
    "USEABLE_STOP_TIME", "ATTITUDE_TYPE", "QUATERNION_TYPE", "EULER_ROT_SEQ"};
/* Known, and of no weight here: the way between rows is always the shortest one. */
static const char *const idle_names[] = {"INTERPOLATION_METHOD", "INTERPOLATION_DEGREE",
                                         "RATE_FRAME", "ANGVEL_FRAME"};

/* A message being read. */
typedef struct aem_reading {
    attitude_reading *r;
    ccsds_file file;
    const char *object; /* NULL: not said */
    bool is_v1;
    const ccsds_item *meta[N_META];
    /* of the segment, from its metadata */
    const ccsds_item *first_object; /* of the first segment taken */
    bool wanted;                    /* the object asked for, and the metadata are good */
    bool open;                      /* its data have not ended yet */
    const aem_type *type;
    time_scale scale;
    file_frame frame;
    bool a_is_body, back; /* A is the body; the turn is from B to A */
    bool scalar_first;
    int axes[3];         /* of Euler angles, 0 to 2 */
    double from_s, to_s; /* usable */
} aem_reading;

static place at_item(const aem_reading *a, const ccsds_item *item)
{
    return ccsds_place(&a->file, item);
}

/* ----------------------------------------------------------------- metadata */

typedef struct frame_name {
    const char *name;
    file_frame frame;
} frame_name;

/* The names of CCSDS 504 and of the SANA registries, and older ones. */
static const frame_name frame_names[] = {
    {"GCRF", FILE_GCRS},     {"ICRF", FILE_GCRS},          {"EME2000", FILE_EME2000},
    {"J2000", FILE_EME2000}, {"TEME", FILE_TEME},          {"TEMEOFDATE", FILE_TEME},
    {"LVLH", FILE_LVLH},     {"LVLH_ROTATING", FILE_LVLH}, {"RTN", FILE_RSW},
    {"RSW", FILE_RSW},       {"RSW_ROTATING", FILE_RSW},   {"QSW", FILE_RSW}};

static bool find_frame(const char *name, file_frame *out)
{
    for (size_t k = 0; k < sizeof frame_names / sizeof *frame_names; k++)
        if (strcasecmp(name, frame_names[k].name) == 0) {
            *out = frame_names[k].frame;
            return true;
        }
    if (strncasecmp(name, "ITRF", 4) != 0) return false;
    *out = FILE_ITRS;
    return true;
}

/* Frames that are fixed in the spacecraft, after CCSDS 504.0-B-1, annex A. */
static bool is_local(const char *name)
{
    static const char *const prefixes[] = {
        "SC_BODY", "SC_BODY_", "IMU_FRAME", "GYRO_FRAME", "INSTRUMENT",  "ACTUATOR", "CSS",
        "DSS",     "ESA",      "RW",        "SA",         "STARTRACKER", "TAM",      "MTA"};
    for (size_t k = 0; k < sizeof prefixes / sizeof *prefixes; k++)
        if (strncasecmp(name, prefixes[k], strlen(prefixes[k])) == 0) return true;
    return false;
}

/* Which of the two frames is the body, and what the other one is. */
static bool read_frames(aem_reading *a)
{
    const ccsds_item *first = a->meta[META_FRAME_A], *second = a->meta[META_FRAME_B];
    file_frame frame_a = FILE_GCRS, frame_b = FILE_GCRS;
    const bool a_known = find_frame(first->value, &frame_a),
               b_known = find_frame(second->value, &frame_b);
    const bool a_local = !a_known && is_local(first->value),
               b_local = !b_known && is_local(second->value);
    if (!(a_known && b_local) && !(a_local && b_known)) {
        const ccsds_item *wrong = a_known || a_local ? second : first;
        attitude_table_fail(
            a->r, at_item(a, wrong),
            "REF_FRAME_A and REF_FRAME_B are '%.40s' and '%.40s'; expected the body "
            "(SC_BODY, SC_BODY_1) and one of EME2000, ICRF, GCRF, TEME, ITRF..., LVLH, RTN",
            first->value, second->value);
        return false;
    }
    a->a_is_body = a_local;
    a->frame = a_local ? frame_b : frame_a;
    const ccsds_item *body = a_local ? first : second;
    if (strncasecmp(body->value, "SC_BODY", 7) != 0)
        errors_warn(a->r->errors, at_item(a, body),
                    "'%.40s' is taken as the axes of the body; where they differ, turn them with "
                    "'offset_deg' in the scenario",
                    body->value);
    const ccsds_item *centre = a->meta[META_CENTER];
    const bool orbital = a->frame == FILE_LVLH || a->frame == FILE_RSW || a->frame == FILE_ITRS;
    if (orbital && centre && !ccsds_says(centre, "EARTH")) {
        attitude_table_fail(a->r, at_item(a, centre),
                            "CENTER_NAME is '%.40s', and the attitude refers to it; expected EARTH",
                            centre->value);
        return false;
    }
    return true;
}

/* Version 1.0 says which way the turn goes; in 2.0 it is always from A to B. */
static bool read_direction(aem_reading *a)
{
    const ccsds_item *dir = a->meta[META_DIR];
    a->back = dir && ccsds_says(dir, "B2A");
    if (dir && !a->back && !ccsds_says(dir, "A2B")) {
        attitude_table_fail(a->r, at_item(a, dir), "ATTITUDE_DIR is '%.40s'; expected A2B or B2A",
                            dir->value);
        return false;
    }
    return true;
}

/* "321" or "ZYX": three axes, no two neighbours alike. */
static bool read_sequence(aem_reading *a)
{
    const ccsds_item *item = a->meta[META_EULER];
    bool good = strlen(item->value) == 3;
    for (int k = 0; good && k < 3; k++) {
        static const char names[] = "123XYZxyz";
        const char *found = strchr(names, item->value[k]);
        good = found && *found;
        if (good) a->axes[k] = (int)(found - names) % 3;
        good = good && (k == 0 || a->axes[k] != a->axes[k - 1]);
    }
    if (!good)
        attitude_table_fail(a->r, at_item(a, item),
                            "EULER_ROT_SEQ is '%.40s'; expected three axes such as 321 or ZXZ",
                            item->value);
    return good;
}

static bool read_scalar_place(aem_reading *a)
{
    const ccsds_item *item = a->meta[META_QUATERNION_TYPE];
    a->scalar_first = item && ccsds_says(item, "FIRST");
    if (item && !a->scalar_first && !ccsds_says(item, "LAST")) {
        attitude_table_fail(a->r, at_item(a, item),
                            "QUATERNION_TYPE is '%.40s'; expected FIRST or LAST", item->value);
        return false;
    }
    return true;
}

static bool read_type(aem_reading *a)
{
    const ccsds_item *item = a->meta[META_TYPE];
    a->type = NULL;
    for (int k = 0; k < N_TYPES && !a->type; k++)
        if (ccsds_says(item, types[k].name)) a->type = &types[k];
    if (!a->type) {
        attitude_table_fail(
            a->r, at_item(a, item),
            "ATTITUDE_TYPE is '%.40s'; expected QUATERNION, EULER_ANGLE (alone, or with "
            "/DERIVATIVE, /RATE or /ANGVEL) or SPIN",
            item->value);
        return false;
    }
    if (a->type->refused) {
        attitude_table_fail(
            a->r, at_item(a, item),
            "ATTITUDE_TYPE %s is not read: %s; expected QUATERNION, EULER_ANGLE or SPIN",
            a->type->name, a->type->refused);
        return false;
    }
    return true;
}

/* A time of the metadata; `none` where it is not given. */
static bool read_moment(aem_reading *a, const ccsds_item *item, double none, double *t_s)
{
    *t_s = none;
    if (!item) return true;
    double tt_jd[2];
    glint_error error;
    if (time_parse(item->value, a->scale, at_item(a, item), tt_jd, &error)) {
        a->r->status = errors_take(a->r->errors, &error, at_item(a, item));
        return false;
    }
    *t_s = jd_difference_s(tt_jd, a->r->clock->tt_jd);
    return true;
}

static bool read_times(aem_reading *a)
{
    const ccsds_item *system = a->meta[META_TIME_SYSTEM];
    glint_error error;
    double start_s, stop_s;
    if (time_scale_find(system->value, at_item(a, system), &a->scale, &error)) {
        a->r->status = errors_take(a->r->errors, &error, at_item(a, system));
        return false;
    }
    bool good = read_moment(a, a->meta[META_START], -INFINITY, &start_s);
    good = read_moment(a, a->meta[META_STOP], INFINITY, &stop_s) && good;
    good = read_moment(a, a->meta[META_USEABLE_START], start_s, &a->from_s) && good;
    good = read_moment(a, a->meta[META_USEABLE_STOP], stop_s, &a->to_s) && good;
    return good;
}

/* Whether everything that this segment needs is there. */
static bool has_all(aem_reading *a, place where)
{
    static const int always[] = {META_OBJECT_NAME, META_OBJECT_ID,   META_FRAME_A,
                                 META_FRAME_B,     META_TIME_SYSTEM, META_TYPE};
    bool good = true;
    for (size_t k = 0; k < sizeof always / sizeof *always; k++)
        if (!a->meta[always[k]]) {
            attitude_table_fail(a->r, where, "this segment has no %s; expected one in its metadata",
                                meta_names[always[k]]);
            good = false;
        }
    if (a->is_v1 && !a->meta[META_DIR]) {
        attitude_table_fail(a->r, where, "this segment has no ATTITUDE_DIR; expected A2B or B2A");
        good = false;
    }
    return good;
}

/* Whether this type's own keywords are there and good. */
static bool read_of_type(aem_reading *a, place where)
{
    if (!read_type(a)) return false;
    if (a->type->kind == AEM_QUATERNION && a->is_v1 && !a->file.is_xml &&
        !a->meta[META_QUATERNION_TYPE]) {
        attitude_table_fail(a->r, where,
                            "this segment has no QUATERNION_TYPE; expected FIRST or LAST, "
                            "which says where the scalar stands");
        return false;
    }
    if (a->type->kind == AEM_EULER && !a->meta[META_EULER]) {
        attitude_table_fail(a->r, where,
                            "this segment has no EULER_ROT_SEQ; expected axes such as 321");
        return false;
    }
    if (a->type->kind == AEM_EULER && a->is_v1 && a->file.is_xml) {
        attitude_table_fail(
            a->r, at_item(a, a->meta[META_TYPE]),
            "Euler angles in the XML of version 1.0, which names axes and order twice, are "
            "not read; expected version 2.0, the keyword notation, or quaternions");
        return false;
    }
    return read_scalar_place(a) && (a->type->kind != AEM_EULER || read_sequence(a));
}

/* True where the segment is of the object asked for. Several objects and none asked for is an
 * error. */
static bool is_of_object(aem_reading *a)
{
    const ccsds_item *name = a->meta[META_OBJECT_NAME], *id = a->meta[META_OBJECT_ID];
    if (a->object)
        return strcasecmp(a->object, name->value) == 0 || strcasecmp(a->object, id->value) == 0;
    if (!a->first_object) a->first_object = id;
    if (string_equal(a->first_object->value, id->value)) return true;
    attitude_table_fail(
        a->r, at_item(a, id),
        "this segment is of the object '%.40s', an earlier one of '%.40s'; choose with the "
        "key 'object'",
        id->value, a->first_object->value);
    return false;
}

/* The metadata are complete: prepares the rows that follow. */
static void end_metadata(aem_reading *a, place where)
{
    a->wanted = false;
    if (!has_all(a, where) || !is_of_object(a)) return;
    const bool type = read_of_type(a, where), frames = read_frames(a), way = read_direction(a),
               times = read_times(a);
    if (!type || !frames || !way || !times) return;
    a->wanted = a->open = true;
    attitude_table_begin_span(a->r, a->frame, where);
}

static void take_metadata(aem_reading *a, const ccsds_item *item)
{
    for (int k = 0; k < N_META; k++) {
        if (!string_equal(item->keyword, meta_names[k])) continue;
        if (a->meta[k])
            attitude_table_fail(a->r, at_item(a, item),
                                "%s stands twice in the metadata of a segment", item->keyword);
        a->meta[k] = item;
        return;
    }
    for (size_t k = 0; k < sizeof idle_names / sizeof *idle_names; k++)
        if (string_equal(item->keyword, idle_names[k])) return;
    errors_warn(a->r->errors, at_item(a, item), "%.40s is not a keyword of an AEM; left aside",
                item->keyword);
}

/* --------------------------------------------------------------------- rows */

/* One row; `at` is the place of its time. */
typedef struct aem_row {
    const char *time; /* NULL: none yet */
    place at;
    double numbers[MOST_NUMBERS];
    bool has[MOST_NUMBERS];
} aem_row;

/* q_ab with v_A = q v_B q*: turns of the frame about its own axes. */
static void quaternion_from_angles(const int axes[3], const double angles[3], double q[4])
{
    quat_turn((const double[3]){axes[0] == 0, axes[0] == 1, axes[0] == 2}, angles[0], q);
    for (int k = 1; k < 3; k++) {
        double turn[4];
        quat_turn((const double[3]){axes[k] == 0, axes[k] == 1, axes[k] == 2}, angles[k], turn);
        quat_mul(q, turn, q);
    }
}

/* numbers: in the order of keyword notation without QUATERNION_TYPE FIRST: Q1, Q2, Q3, QC. */
static void quaternion_of(const aem_reading *a, const double *numbers, double q[4])
{
    static const int zxz[3] = {2, 0, 2};
    double angles[3];
    for (int k = 0; k < 3; k++)
        angles[k] = numbers[k] * DEG;
    switch (a->type->kind) {
    case AEM_QUATERNION:
        q[0] = numbers[3];
        copy3(numbers, q + 1);
        break;
    case AEM_EULER:
        quaternion_from_angles(a->axes, angles, q);
        break;
    case AEM_SPIN:
        angles[0] = 0.5 * PI + angles[0];
        angles[1] = 0.5 * PI - angles[1];
        quaternion_from_angles(zxz, angles, q);
        break;
    }
    /* v_A = q v_B q*; wanted is the turn from the body to the other frame. */
    if (a->back != a->a_is_body) quat_conjugate(q, q);
}

/* How fast the body turns at a row, rad/s, as far as its numbers say (in XML, of SPIN alone). */
static double rate_of(const aem_reading *a, const aem_row *row)
{
    if (a->type->kind == AEM_SPIN) return fabs(row->numbers[3]) * DEG;
    if (!strstr(a->type->name, "/ANGVEL")) return 0;
    return norm3(row->numbers + a->type->n_numbers - 3) * DEG;
}

static void add_row(aem_reading *a, const aem_row *row)
{
    double tt_jd[2], q[4];
    glint_error error;
    if (time_parse(row->time, a->scale, row->at, tt_jd, &error)) {
        a->r->status = errors_take(a->r->errors, &error, row->at);
        return;
    }
    quaternion_of(a, row->numbers, q);
    a->r->told_rad_s = rate_of(a, row);
    attitude_table_add_row(a->r, jd_difference_s(tt_jd, a->r->clock->tt_jd), q, row->at);
}

/* A row in keyword notation: the time and its numbers, cut at blanks. The item's text is ours to
 * cut: it is terminated and used for nothing else. */
static void take_line(aem_reading *a, const ccsds_item *item)
{
    aem_row row = {.at = at_item(a, item)};
    char time[64];
    const char *at = item->value;
    int n = 0;
    for (;; n++) {
        at += strspn(at, " \t");
        const size_t length = strcspn(at, " \t");
        if (length == 0) break;
        place where = row.at;
        where.column += (int)(at - item->value);
        if (n == 0) {
            snprintf(time, sizeof time, "%.*s", (int)(length < 63 ? length : 63), at);
            row.time = time;
        } else if (n <= MOST_NUMBERS && !number_read(at, length, &row.numbers[n - 1])) {
            attitude_table_fail(a->r, where, "'%.*s' stands here; expected a finite number",
                                (int)(length < 40 ? length : 40), at);
            return;
        }
        at += length;
    }
    if (n != a->type->n_numbers + 1) {
        attitude_table_fail(a->r, row.at,
                            "this row has %d words; expected a time and %d numbers, as %s has", n,
                            a->type->n_numbers, a->type->name);
        return;
    }
    if (a->type->kind == AEM_QUATERNION && a->scalar_first) {
        const double scalar = row.numbers[0];
        memmove(row.numbers, row.numbers + 1, 3 * sizeof scalar);
        row.numbers[3] = scalar;
    }
    add_row(a, &row);
}

/* What XML calls the numbers that matter, in the order of keyword notation. */
static const char *const *names_of(aem_kind kind, int *n)
{
    static const char *const quaternion[] = {"Q1", "Q2", "Q3", "QC"};
    static const char *const euler[] = {"ANGLE_1", "ANGLE_2", "ANGLE_3"};
    static const char *const spin[] = {"SPIN_ALPHA", "SPIN_DELTA", "SPIN_ANGLE", "SPIN_ANGLE_VEL"};
    *n = kind == AEM_EULER ? 3 : 4;
    return kind == AEM_QUATERNION ? quaternion : kind == AEM_EULER ? euler : spin;
}

/* An element of a row in XML. */
static void take_element(aem_reading *a, const ccsds_item *item, aem_row *row)
{
    int n;
    const char *const *names = names_of(a->type->kind, &n);
    if (string_equal(item->keyword, "EPOCH")) {
        if (row->time) attitude_table_fail(a->r, at_item(a, item), "EPOCH stands twice in one row");
        row->time = item->value;
        row->at = at_item(a, item);
        return;
    }
    for (int k = 0; k < n; k++) {
        if (!string_equal(item->keyword, names[k])) continue;
        if (row->has[k])
            attitude_table_fail(a->r, at_item(a, item), "%s stands twice in one row",
                                item->keyword);
        row->has[k] = true;
        const char *unit = a->type->kind == AEM_QUATERNION ? NULL : k < 3 ? "deg" : "deg/s";
        const glint_status status =
            ccsds_number(&a->file, item, unit, &row->numbers[k], a->r->errors);
        if (status) a->r->status = status;
        return;
    }
}

static void end_element_row(aem_reading *a, const aem_row *row, place where)
{
    int n;
    const char *const *names = names_of(a->type->kind, &n);
    bool complete = row->time != NULL;
    if (!complete)
        attitude_table_fail(a->r, where, "this attitude has no EPOCH; expected its time");
    for (int k = 0; k < n; k++)
        if (!row->has[k]) {
            attitude_table_fail(a->r, where, "this attitude has no %s; expected it, as %s has",
                                names[k], a->type->name);
            complete = false;
        }
    if (complete) add_row(a, row);
}

/* --------------------------------------------------------------- the message */

static void check_version(aem_reading *a)
{
    const ccsds_item *version = NULL;
    for (size_t k = 0; k < a->file.count && !version; k++)
        if (a->file.items[k].kind == CCSDS_VALUE) version = &a->file.items[k];
    if (!version || strncmp(version->keyword, "CCSDS_", 6) != 0) {
        attitude_table_fail(a->r, (place){a->file.path, 1, 1},
                            "this is no message of the CCSDS; expected an AEM, which begins with "
                            "CCSDS_AEM_VERS");
        return;
    }
    if (!string_equal(version->keyword, "CCSDS_AEM_VERS")) {
        attitude_table_fail(a->r, at_item(a, version),
                            "this message begins with %.40s; expected attitudes: CCSDS_AEM_VERS",
                            version->keyword);
        return;
    }
    a->is_v1 = string_equal(version->value, "1.0");
    if (!a->is_v1 && !string_equal(version->value, "2.0"))
        attitude_table_fail(a->r, at_item(a, version),
                            "CCSDS_AEM_VERS is '%.40s'; expected 1.0 or 2.0", version->value);
}

/* Where in a message the reading is. */
typedef enum aem_part { IN_HEADER, IN_METADATA, IN_DATA } aem_part;

static aem_part begin_block(aem_reading *a, const ccsds_item *item, aem_part part)
{
    if (string_equal(item->keyword, "METADATA")) {
        if (a->open)
            attitude_table_fail(a->r, at_item(a, item), "the segment before this one has no data");
        memset(a->meta, 0, sizeof a->meta);
        a->wanted = a->open = false;
        return IN_METADATA;
    }
    if (string_equal(item->keyword, "DATA")) {
        if (!a->meta[META_TYPE] && !a->r->status)
            attitude_table_fail(a->r, at_item(a, item), "data begin without metadata before them");
        return IN_DATA;
    }
    return part;
}

static void take_item(aem_reading *a, const ccsds_item *item, aem_part *part, aem_row *row)
{
    const place where = at_item(a, item);
    const bool is_row = string_equal(item->keyword, "ATTITUDESTATE");
    switch (item->kind) {
    case CCSDS_BEGIN:
        *part = begin_block(a, item, *part);
        if (is_row) *row = (aem_row){.at = where};
        break;
    case CCSDS_END:
        if (*part == IN_METADATA && string_equal(item->keyword, "METADATA"))
            end_metadata(a, where);
        else if (*part == IN_DATA && is_row && a->wanted)
            end_element_row(a, row, row->at);
        else if (*part == IN_DATA && string_equal(item->keyword, "DATA") && a->wanted) {
            attitude_table_end_span(a->r, a->from_s, a->to_s);
            a->open = false;
        }
        if (string_equal(item->keyword, "METADATA") || string_equal(item->keyword, "DATA"))
            *part = IN_HEADER;
        break;
    case CCSDS_VALUE:
        if (*part == IN_METADATA)
            take_metadata(a, item);
        else if (*part == IN_DATA && !a->file.is_xml)
            attitude_table_fail(a->r, where,
                                "%.40s stands among the data; expected rows of numbers",
                                item->keyword);
        else if (*part == IN_DATA && a->wanted)
            take_element(a, item, row);
        break;
    case CCSDS_LINE:
        if (*part != IN_DATA)
            attitude_table_fail(a->r, where,
                                "'%.40s' stands outside the data; expected KEYWORD = value",
                                item->value);
        else if (a->wanted)
            take_line(a, item);
        break;
    }
}

void attitude_aem_read(attitude_reading *r, char *bytes, size_t size, const char *object)
{
    aem_reading a = {.r = r, .object = object};
    aem_part part = IN_HEADER;
    aem_row row = {0};
    const glint_status status = ccsds_scan(r->table->path, bytes, size, &a.file, r->errors);
    if (status) {
        r->status = status;
        return;
    }
    check_version(&a);
    const int last_line = a.file.count ? a.file.items[a.file.count - 1].line : 0;
    const bool readable = !r->status;
    for (size_t k = 0; k < a.file.count && readable && r->status != GLINT_INTERNAL; k++)
        take_item(&a, &a.file.items[k], &part, &row);
    if (readable && (part != IN_HEADER || a.open))
        attitude_table_fail(
            r, (place){r->table->path, last_line, 0},
            "the file ends before its last segment does: it is cut off; get it again");
    else if (readable && !r->status && r->table->n_spans == 0 && object)
        attitude_table_fail(
            r, (place){r->table->path, 0, 0},
            "no segment is of the object '%.40s'; expected its OBJECT_NAME or OBJECT_ID", object);
    ccsds_free(&a.file);
}
