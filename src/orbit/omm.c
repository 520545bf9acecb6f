#include "orbit/omm.h"

#include "base/constants.h"
#include "base/csv.h"
#include "base/grow.h"
#include "base/text.h"
#include "orbit/ccsds.h"
#include "orbit/clock.h"
#include "orbit/element_sets.h"
#include "orbit/omm_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

const char *omm_keyword(omm_key key)
{
    static const char *const KEYWORDS[OMM_KEYS] = {
        [OMM_OBJECT_NAME] = "OBJECT_NAME",
        [OMM_OBJECT_ID] = "OBJECT_ID",
        [OMM_CENTER_NAME] = "CENTER_NAME",
        [OMM_REF_FRAME] = "REF_FRAME",
        [OMM_TIME_SYSTEM] = "TIME_SYSTEM",
        [OMM_THEORY] = "MEAN_ELEMENT_THEORY",
        [OMM_EPOCH] = "EPOCH",
        [OMM_MEAN_MOTION] = "MEAN_MOTION",
        [OMM_ECCENTRICITY] = "ECCENTRICITY",
        [OMM_INCLINATION] = "INCLINATION",
        [OMM_NODE] = "RA_OF_ASC_NODE",
        [OMM_PERICENTER] = "ARG_OF_PERICENTER",
        [OMM_ANOMALY] = "MEAN_ANOMALY",
        [OMM_EPHEMERIS_TYPE] = "EPHEMERIS_TYPE",
        [OMM_NUMBER] = "NORAD_CAT_ID",
        [OMM_BSTAR] = "BSTAR",
        [OMM_MOTION_DOT] = "MEAN_MOTION_DOT",
        [OMM_BTERM] = "BTERM",
        [OMM_AGOM] = "AGOM",
    };
    return KEYWORDS[key];
}

int omm_key_of(const char *keyword)
{
    for (int k = 0; k < OMM_KEYS; k++)
        if (strcasecmp(keyword, omm_keyword((omm_key)k)) == 0) return k;
    return -1;
}

omm_record *omm_add_record(omm_file *file)
{
    if (!grow_list(&file->records, &file->capacity, file->n + 1, sizeof *file->records))
        return NULL;
    omm_record *record = &file->records[file->n++];
    *record = (omm_record){0};
    return record;
}

/* -------------------------------------------------------------- reading values */

/* A record under reading. */
typedef struct record_reading {
    const omm_file *file;
    const omm_record *record;
    glint_errors *errors;
    glint_status worst;
} record_reading;

static void note(record_reading *r, glint_status status)
{
    if (status > r->worst) r->worst = status;
}

static place value_place(const record_reading *r, omm_key key)
{
    const omm_value *value = &r->record->values[key];
    return (place){r->file->path, value->line, value->column};
}

/* The value of a key; NULL where it is absent or empty. */
static const char *given(const record_reading *r, omm_key key)
{
    const char *said = r->record->values[key].text;
    return said && said[0] ? said : NULL;
}

static const char *require(record_reading *r, omm_key key)
{
    const char *said = given(r, key);
    if (!said)
        note(r, errors_add(r->errors, GLINT_INPUT,
                           (place){r->file->path, r->record->line, r->record->column},
                           "this message has no %s; expected all that SGP4 needs: the file may be "
                           "cut; get it again",
                           omm_keyword(key)));
    return said;
}

/* A word that must be the only one taken, letter case ignored. */
static void require_word(record_reading *r, omm_key key, const char *word, const char *why)
{
    const char *said = r->file->says_all ? require(r, key) : given(r, key);
    if (said && strcasecmp(said, word) != 0)
        note(r, errors_add(r->errors, GLINT_INPUT, value_place(r, key),
                           "%s is '%.40s'; expected %s%s", omm_keyword(key), said, word, why));
}

/* A number that is there; false, and an error, when it is none. */
static bool read_number(record_reading *r, omm_key key, const char *unit, double *value)
{
    const omm_value *v = &r->record->values[key];
    const ccsds_file file = {.path = r->file->path};
    const ccsds_item item = {CCSDS_VALUE, omm_keyword(key), v->text, v->unit, v->line, v->column};
    const glint_status status = ccsds_number(&file, &item, unit, value, r->errors);
    note(r, status);
    return !status;
}

static void read_element(record_reading *r, omm_key key, const element_range *range,
                         const char *unit, double scale, double *out)
{
    double value;
    glint_error error;
    if (!require(r, key) || !read_number(r, key, unit, &value)) return;
    if (element_check(range, value, value_place(r, key), &error))
        note(r, errors_take(r->errors, &error, PLACE_NONE));
    *out = value * scale;
}

/* ------------------------------------------------------------ theory and epoch */

static bool refuse_xp(record_reading *r, omm_key key)
{
    note(r, errors_add(r->errors, GLINT_INPUT, value_place(r, key),
                       "%s '%.20s': this is an SGP4-XP element set, which SGP4 would propagate "
                       "wrongly; expected one of SGP4; get the SGP4 element set",
                       omm_keyword(key), given(r, key)));
    return false;
}

/* False for SGP4-XP, whose other keywords are not worth a word. */
static bool check_theory(record_reading *r)
{
    const char *theory = r->file->says_all ? require(r, OMM_THEORY) : given(r, OMM_THEORY);
    const char *type = given(r, OMM_EPHEMERIS_TYPE);
    double number = 0;
    if (theory && strcasecmp(theory, "SGP4-XP") == 0) return refuse_xp(r, OMM_THEORY);
    if (theory && strcasecmp(theory, "SGP4") != 0 && strcasecmp(theory, "SGP/SGP4") != 0)
        note(r, errors_add(r->errors, GLINT_INPUT, value_place(r, OMM_THEORY),
                           "MEAN_ELEMENT_THEORY is '%.40s'; expected SGP4 (or SGP/SGP4), the only "
                           "theory that is taken",
                           theory));
    else if (type && read_number(r, OMM_EPHEMERIS_TYPE, NULL, &number) && number == 4)
        return refuse_xp(r, OMM_EPHEMERIS_TYPE);
    else if (number != 0 && number != 2 && number != 3) /* SGP4, SDP4: as in two-line sets */
        note(r, errors_add(r->errors, GLINT_INPUT, value_place(r, OMM_EPHEMERIS_TYPE),
                           "EPHEMERIS_TYPE %.20s is not one of SGP4; expected 0; get the SGP4 "
                           "element set",
                           type));
    else if (given(r, OMM_BTERM) && !given(r, OMM_BSTAR))
        return refuse_xp(r, OMM_BTERM);
    else if (given(r, OMM_AGOM) && !given(r, OMM_BSTAR))
        return refuse_xp(r, OMM_AGOM);
    return true;
}

static void read_epoch(record_reading *r, double epoch_jd[2])
{
    const char *said = require(r, OMM_EPOCH);
    utc_time utc;
    glint_error error;
    if (!said) return;
    if (utc_parse(said, value_place(r, OMM_EPOCH), &utc, &error))
        note(r, errors_take(r->errors, &error, PLACE_NONE));
    else
        utc_to_jd(&utc, epoch_jd);
}

/* Up to nine digits; false for others. */
static bool number_of(const char *said, int *number)
{
    const size_t n = said ? strspn(said, "0123456789") : 0;
    if (n == 0 || n > 9 || said[n]) return false;
    *number = atoi(said);
    return true;
}

static void read_identity(record_reading *r, tle *out)
{
    const char *number = given(r, OMM_NUMBER), *id = given(r, OMM_OBJECT_ID);
    if (number && !number_of(number, &out->number))
        note(r,
             errors_add(r->errors, GLINT_INPUT, value_place(r, OMM_NUMBER),
                        "NORAD_CAT_ID is '%.20s'; expected a number of up to nine digits", number));
    if (id && !designator_read(id, strlen(id), out->designator))
        snprintf(out->designator, sizeof out->designator, "%s", id);
}

static glint_status parse_record(const void *of, size_t k, tle *out, glint_errors *errors)
{
    const omm_file *file = of;
    const omm_record *record = &file->records[k];
    record_reading r = {file, record, errors, GLINT_OK};
    *out = (tle){.where = {file->path, record->line, record->column}};
    if (!check_theory(&r)) return r.worst;
    require_word(&r, OMM_CENTER_NAME, "EARTH", "");
    require_word(&r, OMM_REF_FRAME, "TEME", ", the frame of SGP4's elements");
    require_word(&r, OMM_TIME_SYSTEM, "UTC", ", the scale of SGP4's epochs");
    read_identity(&r, out);
    read_epoch(&r, out->epoch_jd);
    read_element(&r, OMM_MEAN_MOTION, &RANGE_MOTION_REV_DAY, "rev/day", TWO_PI / 1440.0,
                 &out->mean_motion);
    read_element(&r, OMM_ECCENTRICITY, &RANGE_ECCENTRICITY, NULL, 1.0, &out->eccentricity);
    read_element(&r, OMM_INCLINATION, &RANGE_INCLINATION_DEG, "deg", DEG, &out->inclination);
    read_element(&r, OMM_NODE, &RANGE_NODE_DEG, "deg", DEG, &out->raan);
    read_element(&r, OMM_PERICENTER, &RANGE_PERIGEE_DEG, "deg", DEG, &out->argument_of_perigee);
    read_element(&r, OMM_ANOMALY, &RANGE_ANOMALY_DEG, "deg", DEG, &out->mean_anomaly);
    if (require(&r, OMM_BSTAR)) read_number(&r, OMM_BSTAR, "1/ER", &out->bstar);
    if (given(&r, OMM_MOTION_DOT))
        read_number(&r, OMM_MOTION_DOT, "rev/day**2", &out->mean_motion_dot);
    return r.worst;
}

/* --------------------------------------------------------------------- loading */

static glint_status no_memory(glint_errors *errors)
{
    return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
}

/* KVN and XML: records begin with CCSDS_OMM_VERS; what stands in covariances is none of theirs. */
static glint_status load_messages(const ccsds_file *messages, omm_file *file, glint_errors *errors)
{
    omm_record *record = NULL;
    bool inside_covariance = false;
    file->says_all = true;
    for (size_t k = 0; k < messages->count; k++) {
        const ccsds_item *item = &messages->items[k];
        if (item->kind == CCSDS_BEGIN && strncmp(item->keyword, "COVARIANCE", 10) == 0)
            inside_covariance = true;
        if (item->kind == CCSDS_END && strncmp(item->keyword, "COVARIANCE", 10) == 0)
            inside_covariance = false;
        if (item->kind != CCSDS_VALUE || inside_covariance) continue;
        if (strcmp(item->keyword, "CCSDS_OMM_VERS") == 0) {
            record = omm_add_record(file);
            if (!record) return no_memory(errors);
            record->line = item->line;
            record->column = item->column;
            continue;
        }
        if (!record && strncmp(item->keyword, "CCSDS_", 6) == 0 &&
            strcmp(item->keyword, "CCSDS_NDM_VERS") != 0)
            return errors_add(errors, GLINT_INPUT, ccsds_place(messages, item),
                              "this message begins with %.40s; expected an orbit mean-elements "
                              "message, CCSDS_OMM_VERS (<omm> in XML)",
                              item->keyword);
        const int key = record ? omm_key_of(item->keyword) : -1;
        if (key < 0) continue;
        if (record->values[key].text)
            return errors_add(errors, GLINT_INPUT, ccsds_place(messages, item),
                              "%s stands twice in one message; expected it once, or a line "
                              "CCSDS_OMM_VERS where the next message begins",
                              item->keyword);
        record->values[key] = (omm_value){item->value, item->unit, item->line, item->column};
    }
    return GLINT_OK;
}

/* CSV: a header of keywords, and a line for each record. */
static glint_status load_csv(csv_table *table, omm_file *file, glint_errors *errors)
{
    int keys[OMM_KEYS];
    for (int k = 0; k < OMM_KEYS; k++) {
        keys[k] = -1;
        for (int column = 0; column < table->n_columns; column++)
            if (strcasecmp(csv_at(table, -1, column)->text, omm_keyword((omm_key)k)) == 0)
                keys[k] = column;
    }
    if (keys[OMM_MEAN_MOTION] < 0 || keys[OMM_EPOCH] < 0)
        return errors_add(errors, GLINT_INPUT, (place){file->path, 1, 1},
                          "this is no orbit mean-elements message; expected KVN, XML, JSON, or CSV "
                          "with a header line of OBJECT_NAME, EPOCH, MEAN_MOTION and the like");
    csv_leave_out_cut_row(table, errors);
    for (long row = 0; row < table->n_rows; row++) {
        omm_record *record = omm_add_record(file);
        if (!record) return no_memory(errors);
        record->line = csv_at(table, row, 0)->line;
        record->column = 1;
        for (int k = 0; k < OMM_KEYS; k++) {
            if (keys[k] < 0) continue;
            const csv_cell *cell = csv_at(table, row, keys[k]);
            record->values[k] = (omm_value){cell->text, "", cell->line, cell->column};
        }
    }
    return GLINT_OK;
}

/* ------------------------------------------------------------------- choosing */

static slice slice_of(const char *said)
{
    return said ? slice_trim((slice){said, strlen(said)}) : (slice){0};
}

static glint_status choose(const omm_file *file, place asked_from, const tle_query *query,
                           tle_list *out, glint_errors *errors)
{
    if (file->n == 0)
        return errors_add(errors, GLINT_INPUT, (place){file->path, 0, 0},
                          "there is no whole message in this file; expected orbit mean-elements "
                          "messages");
    set_entry *entries = calloc(file->n, sizeof *entries);
    if (!entries) return no_memory(errors);
    for (size_t k = 0; k < file->n; k++) {
        const omm_value *values = file->records[k].values;
        entries[k] = (set_entry){.name = slice_of(values[OMM_OBJECT_NAME].text),
                                 .designator = slice_of(values[OMM_OBJECT_ID].text),
                                 .number = -1};
        number_of(values[OMM_NUMBER].text, &entries[k].number);
    }
    const glint_status status = element_sets_choose(file->path, asked_from, entries, file->n, query,
                                                    parse_record, file, out, errors);
    free(entries);
    return status;
}

typedef enum notation { NOTATION_MESSAGES, NOTATION_JSON, NOTATION_CSV } notation;

/* Told by the first line that says something. */
static notation notation_of(const char *bytes)
{
    if (ccsds_is_xml(bytes)) return NOTATION_MESSAGES;
    if (strncmp(bytes, "\xEF\xBB\xBF", 3) == 0) bytes += 3;
    for (;;) {
        bytes += strspn(bytes, " \t\r\n");
        if (*bytes == '{' || *bytes == '[') return NOTATION_JSON;
        const size_t n = strcspn(bytes, "\n");
        if (n == 0 || memchr(bytes, '=', n)) return NOTATION_MESSAGES;
        if (strncasecmp(bytes, "COMMENT", 7) != 0 && *bytes != '#') break;
        bytes += n;
    }
    return memchr(bytes, ',', strcspn(bytes, "\n")) ? NOTATION_CSV : NOTATION_MESSAGES;
}

glint_status omm_file_read(const char *path, place asked_from, const tle_query *query,
                           tle_list *out, glint_errors *errors)
{
    *out = (tle_list){0};
    char *bytes, *texts = NULL;
    size_t size;
    glint_error error;
    glint_status status = file_read(path, &bytes, &size, asked_from, &error);
    if (status) return errors_take(errors, &error, asked_from);
    omm_file file = {.path = path};
    ccsds_file messages = {0};
    csv_table table = {0};
    switch (notation_of(bytes)) {
    case NOTATION_JSON:
        status = omm_load_json(bytes, size, &file, &texts, errors);
        free(bytes);
        break;
    case NOTATION_CSV:
        free(bytes);
        status = csv_read(path, asked_from, &table, errors);
        if (!status) status = load_csv(&table, &file, errors);
        break;
    case NOTATION_MESSAGES:
        status = ccsds_scan(path, bytes, size, &messages, errors);
        if (!status) status = load_messages(&messages, &file, errors);
        break;
    }
    if (!status) status = choose(&file, asked_from, query, out, errors);
    free(file.records);
    free(texts);
    csv_free(&table);
    ccsds_free(&messages);
    return status;
}
