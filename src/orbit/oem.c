#include "orbit/oem.h"

#include "base/text.h"
#include "base/vec.h"
#include "orbit/ccsds.h"
#include "orbit/clock.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Degree of interpolation where the file gives none. */
enum { DEFAULT_DEGREE = 7 };

/* The keywords of a segment's metadata that are looked at. */
typedef enum meta_key {
    OBJECT_NAME,
    OBJECT_ID,
    CENTER_NAME,
    REF_FRAME,
    REF_FRAME_EPOCH,
    TIME_SYSTEM,
    START_TIME,
    USEABLE_START_TIME,
    USEABLE_STOP_TIME,
    STOP_TIME,
    INTERPOLATION,
    INTERPOLATION_DEGREE,
    N_META
} meta_key;

static const char *const META_NAMES[N_META] = {
    [OBJECT_NAME] = "OBJECT_NAME",
    [OBJECT_ID] = "OBJECT_ID",
    [CENTER_NAME] = "CENTER_NAME",
    [REF_FRAME] = "REF_FRAME",
    [REF_FRAME_EPOCH] = "REF_FRAME_EPOCH",
    [TIME_SYSTEM] = "TIME_SYSTEM",
    [START_TIME] = "START_TIME",
    [USEABLE_START_TIME] = "USEABLE_START_TIME",
    [USEABLE_STOP_TIME] = "USEABLE_STOP_TIME",
    [STOP_TIME] = "STOP_TIME",
    [INTERPOLATION] = "INTERPOLATION",
    [INTERPOLATION_DEGREE] = "INTERPOLATION_DEGREE",
};

/* A segment's metadata: where its keywords are given. */
typedef struct metadata {
    const ccsds_item *begin;
    const ccsds_item *given[N_META]; /* NULL: absent */
} metadata;

/* A reading in progress. */
typedef struct oem_reading {
    const ccsds_file *file;
    orbit_table *table;
    glint_errors *errors;
    glint_status worst;
    /* of the segment being read */
    table_segment *segment; /* NULL: of another object, or before the first */
    time_scale scale;
    bool eme2000;
    bool other_centre; /* distances mean nothing */
} oem_reading;

static void note(oem_reading *o, glint_status status)
{
    if (status > o->worst) o->worst = status;
}

static void take_error(oem_reading *o, const glint_error *error)
{
    note(o, errors_take(o->errors, error, (place){o->file->path, 0, 0}));
}

/* ------------------------------------------------------------------- metadata */

/* Collects the block that begins at item k; returns the item behind it. */
static size_t collect_metadata(const ccsds_file *file, size_t k, metadata *out)
{
    *out = (metadata){.begin = &file->items[k]};
    for (k++; k < file->count && !ccsds_is(&file->items[k], CCSDS_END, "METADATA"); k++)
        for (int m = 0; m < N_META; m++)
            if (ccsds_is(&file->items[k], CCSDS_VALUE, META_NAMES[m]))
                out->given[m] = &file->items[k];
    return k < file->count ? k + 1 : k;
}

static const char *given(const metadata *meta, meta_key key)
{
    return meta->given[key] ? meta->given[key]->value : "";
}

/* What is said twice or not known, and a block without its end. */
static void check_metadata(oem_reading *o, const metadata *meta)
{
    const ccsds_file *file = o->file;
    bool seen[N_META] = {false};
    const ccsds_item *i = meta->begin + 1, *end = file->items + file->count;
    for (; i < end && !ccsds_is(i, CCSDS_END, "METADATA"); i++) {
        int m = 0;
        while (m < N_META && !ccsds_is(i, CCSDS_VALUE, META_NAMES[m]))
            m++;
        if (m < N_META && !seen[m]) {
            seen[m] = true;
        } else if (m < N_META) {
            note(o, errors_add(o->errors, GLINT_INPUT, ccsds_place(file, i),
                               "%s stands twice in the metadata of a segment; expected it once",
                               i->keyword));
        } else if (i->kind == CCSDS_VALUE) {
            const char *near = nearest_name(i->keyword, META_NAMES, N_META);
            errors_warn(o->errors, ccsds_place(file, i),
                        "the keyword '%.40s' is not known in metadata and not looked at%s%s%s",
                        i->keyword, near ? "; is it " : "", near ? near : "", near ? "?" : "");
        } else {
            note(o,
                 errors_add(o->errors, GLINT_INPUT, ccsds_place(file, i),
                            "'%.40s' stands in the metadata of a segment; expected keywords with "
                            "values, and then META_STOP",
                            i->keyword[0] ? i->keyword : i->value));
        }
    }
    if (i == end)
        note(o, errors_add(o->errors, GLINT_INPUT, ccsds_place(file, meta->begin),
                           "the metadata that begin here have no end: the file is cut; get it "
                           "again"));
}

static const ccsds_item *require(oem_reading *o, const metadata *meta, meta_key key,
                                 const char *expected)
{
    if (given(meta, key)[0]) return meta->given[key];
    note(o, errors_add(o->errors, GLINT_INPUT, ccsds_place(o->file, meta->begin),
                       "the metadata of this segment have no %s; expected %s", META_NAMES[key],
                       expected));
    return NULL;
}

static void read_frame(oem_reading *o, const metadata *meta)
{
    const ccsds_item *centre = require(o, meta, CENTER_NAME, "EARTH");
    o->other_centre = centre && !ccsds_says(centre, "EARTH");
    if (o->other_centre)
        note(o, errors_add(o->errors, GLINT_INPUT, ccsds_place(o->file, centre),
                           "CENTER_NAME is '%.40s'; expected EARTH, the only centre that is taken",
                           centre->value));
    const ccsds_item *frame = require(o, meta, REF_FRAME, "EME2000 or another frame");
    if (!frame) return;
    table_segment *s = o->segment;
    snprintf(s->frame_name, sizeof s->frame_name, "%s", frame->value);
    if (!table_frame_find(frame->value, &s->frame, &o->eme2000))
        note(o, errors_add(o->errors, GLINT_INPUT, ccsds_place(o->file, frame),
                           "REF_FRAME '%.40s' is not taken; expected EME2000, GCRF, ICRF, TEME, or "
                           "ITRF with a year; have the file written in one of these",
                           frame->value));
    else if (s->frame == TABLE_TEME && meta->given[REF_FRAME_EPOCH])
        note(o,
             errors_add(o->errors, GLINT_INPUT, ccsds_place(o->file, meta->given[REF_FRAME_EPOCH]),
                        "TEME of one epoch is not taken; expected TEME of date, without "
                        "REF_FRAME_EPOCH"));
}

static void read_method(oem_reading *o, const metadata *meta)
{
    table_segment *s = o->segment;
    s->method = TABLE_HERMITE;
    s->has_velocity = true;
    const ccsds_item *method = meta->given[INTERPOLATION];
    if (method) {
        if (ccsds_says(method, "LAGRANGE"))
            s->method = TABLE_LAGRANGE;
        else if (ccsds_says(method, "LINEAR"))
            s->method = TABLE_LINEAR;
        else if (!ccsds_says(method, "HERMITE"))
            note(o, errors_add(o->errors, GLINT_INPUT, ccsds_place(o->file, method),
                               "INTERPOLATION is '%.40s'; expected HERMITE, LAGRANGE or LINEAR",
                               method->value));
    }
    s->degree = s->method == TABLE_LINEAR ? 1 : DEFAULT_DEGREE;
    const ccsds_item *degree = meta->given[INTERPOLATION_DEGREE];
    double value;
    if (!degree) return;
    const glint_status status = ccsds_number(o->file, degree, NULL, &value, o->errors);
    note(o, status);
    if (status) return;
    if (value >= 1 && value <= TABLE_MAX_DEGREE && value == (int)value)
        s->degree = (int)value;
    else
        note(o, errors_add(o->errors, GLINT_INPUT, ccsds_place(o->file, degree),
                           "INTERPOLATION_DEGREE is %.20s; expected a whole number from 1 to %d",
                           degree->value, TABLE_MAX_DEGREE));
}

/* A moment; false, and an error, when it is none. */
static bool read_time(oem_reading *o, const ccsds_item *item, const char *string, double tt_jd[2])
{
    glint_error error;
    if (!time_parse(string, o->scale, ccsds_place(o->file, item), tt_jd, &error)) return true;
    take_error(o, &error);
    return false;
}

/* -------------------------------------------------------------------- records */

/* The limits of use, once the table's reference is known: after a segment's records. */
static void read_use(oem_reading *o, const metadata *meta)
{
    table_segment *s = o->segment;
    const ccsds_item *from = meta->given[USEABLE_START_TIME], *to = meta->given[USEABLE_STOP_TIME];
    double tt_jd[2];
    if (s->n == 0 || (!from && !to)) return;
    s->has_use = true;
    s->from_s = s->nodes[0].t_s;
    s->to_s = s->nodes[s->n - 1].t_s;
    if (from && read_time(o, from, from->value, tt_jd))
        s->from_s = orbit_table_seconds(o->table, tt_jd);
    if (to && read_time(o, to, to->value, tt_jd)) s->to_s = orbit_table_seconds(o->table, tt_jd);
}

static void warn_of_early_end(oem_reading *o, const metadata *meta)
{
    /* s: of files whose STOP_TIME is rounded to whole seconds */
    static const double ROUNDED_S = 1.0;
    const ccsds_item *stop = meta->given[STOP_TIME];
    const table_segment *s = o->segment;
    double tt_jd[2];
    if (!stop || s->n == 0 || !read_time(o, stop, stop->value, tt_jd)) return;
    const double missing_s = orbit_table_seconds(o->table, tt_jd) - s->nodes[s->n - 1].t_s;
    if (missing_s > ROUNDED_S)
        errors_warn(o->errors, ccsds_place(o->file, stop),
                    "the records of this segment end %.6g s before its STOP_TIME: the file may be "
                    "cut",
                    missing_s);
}

/* Adds a record: km and km/s. */
static void add_record(oem_reading *o, const ccsds_item *item, const double tt_jd[2],
                       const double numbers[6])
{
    double r_m[3], v_m_s[3];
    scale3(numbers, 1e3, r_m);
    scale3(numbers + 3, 1e3, v_m_s);
    glint_error error;
    if (!o->other_centre &&
        table_state_check(r_m, v_m_s, "km", ccsds_place(o->file, item), &error)) {
        take_error(o, &error);
        return;
    }
    if (o->eme2000) table_node_from_eme2000(r_m, v_m_s);
    if (!orbit_table_add_node(o->table, o->segment, tt_jd, r_m, v_m_s))
        note(o, errors_add(o->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory"));
}

/* The words of a line: at most `most` are kept; returns how many there are. */
static int split_words(const char *line, int most, const char **words, int *lengths)
{
    int n = 0;
    while (*line) {
        while (isspace((unsigned char)*line))
            line++;
        const char *from = line;
        while (*line && !isspace((unsigned char)*line))
            line++;
        if (line == from) break;
        if (n < most) {
            words[n] = from;
            lengths[n] = (int)(line - from);
        }
        n++;
    }
    return n;
}

/* KVN: a time, place and velocity, and accelerations at will. */
static void read_line(oem_reading *o, const ccsds_item *item)
{
    enum { WORDS = 10, WITHOUT_ACCELERATION = 7 };
    const char *words[WORDS];
    int lengths[WORDS];
    double numbers[WORDS - 1], tt_jd[2];
    const int n = split_words(item->value, WORDS, words, lengths);
    if (n != WORDS && n != WITHOUT_ACCELERATION) {
        note(o,
             errors_add(o->errors, GLINT_INPUT, ccsds_place(o->file, item),
                        "this record has %d parts; expected a time, three coordinates (km), three "
                        "velocities (km/s) and, at will, three accelerations",
                        n));
        return;
    }
    for (int k = 1; k < n; k++) {
        if (number_read(words[k], (size_t)lengths[k], &numbers[k - 1])) continue;
        place where = ccsds_place(o->file, item);
        where.column += (int)(words[k] - item->value);
        note(o, errors_add(o->errors, GLINT_INPUT, where, "'%.*s' is no number; expected one in %s",
                           lengths[k] < 40 ? lengths[k] : 40, words[k],
                           k < 4   ? "km"
                           : k < 7 ? "km/s"
                                   : "km/s**2"));
        return;
    }
    char time[64];
    snprintf(time, sizeof time, "%.*s", lengths[0], words[0]);
    if (read_time(o, item, time, tt_jd)) add_record(o, item, tt_jd, numbers);
}

/* XML: the element that begins at item k; returns the item behind it. */
static size_t read_vector(oem_reading *o, size_t k)
{
    static const char *const NAMES[] = {"X", "Y", "Z", "X_DOT", "Y_DOT", "Z_DOT"};
    const ccsds_file *file = o->file;
    const ccsds_item *begin = &file->items[k], *parts[6] = {NULL}, *epoch = NULL;
    for (k++; k < file->count && !ccsds_is(&file->items[k], CCSDS_END, "STATEVECTOR"); k++) {
        const ccsds_item *item = &file->items[k];
        if (ccsds_is(item, CCSDS_VALUE, "EPOCH")) epoch = item;
        for (int i = 0; i < 6; i++)
            if (ccsds_is(item, CCSDS_VALUE, NAMES[i])) parts[i] = item;
    }
    if (k < file->count) k++;
    if (!o->segment) return k;
    double numbers[6], tt_jd[2];
    bool good = epoch != NULL;
    const char *missing = epoch ? NULL : "EPOCH";
    for (int i = 0; i < 6; i++) {
        if (!parts[i]) {
            missing = missing ? missing : NAMES[i];
            good = false;
            continue;
        }
        const glint_status status =
            ccsds_number(file, parts[i], i < 3 ? "km" : "km/s", &numbers[i], o->errors);
        note(o, status);
        good = good && !status;
    }
    if (missing)
        note(o, errors_add(o->errors, GLINT_INPUT, ccsds_place(file, begin),
                           "this state vector has no %s; expected EPOCH, X, Y, Z, X_DOT, Y_DOT and "
                           "Z_DOT",
                           missing));
    if (good && read_time(o, epoch, epoch->value, tt_jd)) add_record(o, begin, tt_jd, numbers);
    return k;
}

/* The item behind a block, which may lack its end. */
static size_t skip_block(const ccsds_file *file, size_t k)
{
    const char *name = file->items[k].keyword;
    for (k++; k < file->count; k++)
        if (ccsds_is(&file->items[k], CCSDS_END, name)) return k + 1;
    return k;
}

/* The records behind a segment's metadata; returns the item at which they end. */
static size_t read_records(oem_reading *o, size_t k)
{
    const ccsds_file *file = o->file;
    while (k < file->count) {
        const ccsds_item *item = &file->items[k];
        if (item->kind == CCSDS_BEGIN && strcmp(item->keyword, "METADATA") == 0) break;
        if (item->kind == CCSDS_BEGIN && strncmp(item->keyword, "COVARIANCE", 10) == 0) {
            k = skip_block(file, k);
            continue;
        }
        if (item->kind == CCSDS_BEGIN && strcmp(item->keyword, "STATEVECTOR") == 0) {
            k = read_vector(o, k);
            continue;
        }
        if (o->segment && item->kind == CCSDS_LINE)
            read_line(o, item);
        else if (!file->is_xml && item->kind != CCSDS_LINE)
            note(o, errors_add(o->errors, GLINT_INPUT, ccsds_place(file, item),
                               "'%.40s' stands among the records; expected records, a block of "
                               "covariances, or META_START",
                               item->keyword));
        k++;
    }
    return k;
}

/* -------------------------------------------------------------------- objects */

static bool same_object(const metadata *a, const metadata *b)
{
    const meta_key key = given(a, OBJECT_ID)[0] && given(b, OBJECT_ID)[0] ? OBJECT_ID : OBJECT_NAME;
    return strcasecmp(given(a, key), given(b, key)) == 0;
}

static bool is_wanted(const metadata *meta, const char *object)
{
    return !object || strcasecmp(given(meta, OBJECT_NAME), object) == 0 ||
           strcasecmp(given(meta, OBJECT_ID), object) == 0;
}

static size_t next_metadata(const ccsds_file *file, size_t k)
{
    while (k < file->count && !ccsds_is(&file->items[k], CCSDS_BEGIN, "METADATA"))
        k++;
    return k;
}

static void add_name(text *list, const metadata *meta)
{
    text_printf(list, "%s%s", list->length ? ", " : "", given(meta, OBJECT_NAME));
    if (given(meta, OBJECT_ID)[0]) text_printf(list, " (%s)", given(meta, OBJECT_ID));
}

/* Exactly one object must be wanted. */
static void check_objects(oem_reading *o, place where, const char *object)
{
    const ccsds_file *file = o->file;
    metadata first = {0}, meta;
    text all = {0}, wanted = {0};
    bool several = false;
    for (size_t k = next_metadata(file, 0); k < file->count; k = next_metadata(file, k)) {
        k = collect_metadata(file, k, &meta);
        if (all.length < 200) add_name(&all, &meta);
        if (!is_wanted(&meta, object)) continue;
        if (!first.begin)
            first = meta;
        else if (same_object(&first, &meta))
            continue;
        several = several || first.begin != meta.begin;
        if (wanted.length < 200) add_name(&wanted, &meta);
    }
    if (all.failed || wanted.failed)
        note(o, errors_add(o->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory"));
    else if (!all.length && !all.data)
        note(o,
             errors_add(o->errors, GLINT_INPUT, (place){file->path, 0, 0},
                        "there is no segment in this message; expected META_START (<metadata> in "
                        "XML), keywords, META_STOP and records"));
    else if (!first.begin)
        note(o, errors_add(o->errors, GLINT_INPUT, where,
                           "'%s' has no object of the name or id '%.60s'; it has %s", file->path,
                           object, all.data));
    else if (several)
        note(o, errors_add(o->errors, GLINT_INPUT, where,
                           "'%s' has several objects: %s; say which one by oem_object, its name or "
                           "id",
                           file->path, wanted.data));
    text_free(&all);
    text_free(&wanted);
}

/* -------------------------------------------------------------------- message */

static void check_version(oem_reading *o)
{
    const ccsds_file *file = o->file;
    const ccsds_item *first = file->count ? &file->items[0] : NULL;
    for (size_t k = 0; k < file->count && file->is_xml; k++) /* <ndm> may come first */
        if (ccsds_is(&file->items[k], CCSDS_VALUE, "CCSDS_OEM_VERS")) first = &file->items[k];
    if (!first || !ccsds_is(first, CCSDS_VALUE, "CCSDS_OEM_VERS"))
        note(o, errors_add(o->errors, GLINT_INPUT,
                           first ? ccsds_place(file, first) : (place){file->path, 0, 0},
                           "this is no orbit ephemeris message: it begins with '%.40s'; expected "
                           "CCSDS_OEM_VERS (<oem> in XML)",
                           first ? first->keyword[0] ? first->keyword : first->value : ""));
    else if (!strchr("123", first->value[0]) || (first->value[0] && first->value[1] != '.'))
        note(o, errors_add(o->errors, GLINT_INPUT, ccsds_place(file, first),
                           "the version of this message is '%.20s'; expected 1.0, 2.0 or 3.0",
                           first->value));
}

/* One segment: its metadata at item k, and its records. */
static size_t read_segment(oem_reading *o, size_t k, const char *object)
{
    metadata meta;
    k = collect_metadata(o->file, k, &meta);
    o->segment = NULL;
    if (!is_wanted(&meta, object)) return read_records(o, k);
    o->segment = orbit_table_add(o->table);
    if (!o->segment) {
        note(o, errors_add(o->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory"));
        return o->file->count;
    }
    o->segment->line = meta.begin->line;
    check_metadata(o, &meta);
    if (!meta.given[OBJECT_ID]) require(o, &meta, OBJECT_NAME, "the name of the object");
    snprintf(o->table->object, TABLE_TEXT_SIZE, "%s", given(&meta, OBJECT_NAME));
    snprintf(o->table->id, TABLE_TEXT_SIZE, "%s", given(&meta, OBJECT_ID));
    read_frame(o, &meta);
    read_method(o, &meta);
    const ccsds_item *system = require(o, &meta, TIME_SYSTEM, "UTC or another time system");
    glint_error error;
    if (!system ||
        time_scale_find(system->value, ccsds_place(o->file, system), &o->scale, &error)) {
        if (system) take_error(o, &error);
        o->segment = NULL; /* records mean nothing now */
        return read_records(o, k);
    }
    k = read_records(o, k);
    read_use(o, &meta);
    warn_of_early_end(o, &meta);
    return k;
}

glint_status oem_read(const char *path, place asked_from, const char *object, orbit_table **out,
                      glint_errors *errors)
{
    *out = NULL;
    ccsds_file file;
    const glint_status status = ccsds_read(path, asked_from, &file, errors);
    if (status) return status;
    oem_reading o = {.file = &file, .table = orbit_table_new(path, "OEM"), .errors = errors};
    if (!o.table) o.worst = errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    if (!o.worst) check_version(&o);
    if (!o.worst) check_objects(&o, asked_from.file ? asked_from : (place){path, 0, 0}, object);
    for (size_t k = 0; !o.worst && k < file.count;) {
        k = next_metadata(&file, k);
        while (k < file.count) /* errors of one segment do not hide those of the next */
            k = read_segment(&o, k, object);
    }
    if (!o.worst) o.worst = orbit_table_finish(o.table, errors);
    ccsds_free(&file);
    if (o.worst)
        orbit_table_free(o.table);
    else
        *out = o.table;
    return o.worst;
}
