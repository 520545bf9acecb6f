#include "orbit/sp3.h"

#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/clock.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Degree that users of these files take for records 15 min apart: some millimetres. */
enum { DEGREE = 9, ID_LENGTH = 3, MOST_SATELLITES = 999 };

typedef struct sp3_reading {
    orbit_table *table;
    glint_errors *errors;
    glint_status worst;
    const char *line; /* the current one, terminated, without blanks behind */
    int number;
    bool ended, has_scale;
    char ids[MOST_SATELLITES][ID_LENGTH + 1]; /* that the heading names */
    int n_ids;
    const char *wanted; /* identifier; NULL: any */
    char frame_name[TABLE_TEXT_SIZE];
    double interval_s; /* 0 where not said */
    time_scale scale;
    long announced, n_epochs;
    double epoch_jd[2]; /* TT, of the current epoch */
    bool broken;        /* the next position begins a new segment */
    bool has_position;  /* of the current epoch */
} sp3_reading;

static void fail(sp3_reading *s, int column, const char *format, ...) GLINT_PRINTF(3, 4);

static void fail(sp3_reading *s, int column, const char *format, ...)
{
    char message[512];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    s->worst = errors_add(s->errors, GLINT_INPUT, (place){s->table->path, s->number, column}, "%s",
                          message);
}

static void no_memory(sp3_reading *s)
{
    s->worst = errors_add(s->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
}

/* Copies columns first..last (from 1), as far as the line goes, without blanks around. */
static const char *columns(const char *line, int first, int last, char out[64])
{
    const size_t length = strlen(line), from = (size_t)first - 1;
    size_t n = from < length ? length - from : 0;
    if (n > (size_t)(last - first + 1)) n = (size_t)(last - first + 1);
    const char *at = line + (n ? from : 0);
    while (n > 0 && isspace((unsigned char)*at))
        at++, n--;
    while (n > 0 && isspace((unsigned char)at[n - 1]))
        n--;
    memcpy(out, at, n);
    out[n] = '\0';
    return out;
}

static bool read_field(sp3_reading *s, int first, int last, const char *what, double *out)
{
    char field[64];
    columns(s->line, first, last, field);
    if (number_read(field, strlen(field), out)) return true;
    fail(s, first, "the %s (columns %d to %d) is '%s'; expected a number", what, first, last,
         field);
    return false;
}

/* -------------------------------------------------------------------- heading */

/* "#cP2025  7 24 ..." with the number of epochs and the coordinate system. */
static void take_first(sp3_reading *s)
{
    static const char *const EARTH_FIXED[] = {"IGS", "IGb", "IGR", "ITR", "WGS", "SLR", "GTR"};
    double epochs;
    if (!strchr("abcd", s->line[1]) || !s->line[1] || !strchr("PV", s->line[2]) || !s->line[2]) {
        fail(s, 1, "this is no SP3 file: it begins with '%.3s'; expected #aP to #dV", s->line);
        return;
    }
    if (read_field(s, 33, 39, "number of epochs", &epochs)) s->announced = (long)epochs;
    columns(s->line, 47, 51, s->frame_name);
    for (size_t k = 0; k < sizeof EARTH_FIXED / sizeof *EARTH_FIXED; k++)
        if (strncasecmp(s->frame_name, EARTH_FIXED[k], 3) == 0) return;
    fail(s, 47,
         "the coordinate system is '%.5s'; expected an Earth-fixed one (IGS.., ITR.., WGS..)",
         s->frame_name);
}

/* "+   26   G01G02...": seventeen identifiers a line; blanks before digits stand for zeros. */
static void take_ids(sp3_reading *s)
{
    for (int k = 0; k < 17 && s->n_ids < MOST_SATELLITES; k++) {
        char id[64];
        columns(s->line, 10 + 3 * k, 12 + 3 * k, id);
        if (!id[0] || string_equal(id, "0")) continue;
        snprintf(s->ids[s->n_ids++], sizeof s->ids[0], "%.3s", id);
    }
}

static void take_scale(sp3_reading *s)
{
    static const struct {
        const char *name;
        time_scale scale;
    } SCALES[] = {{"GPS", SCALE_GPS}, {"GAL", SCALE_GPS}, {"QZS", SCALE_GPS}, {"UTC", SCALE_UTC},
                  {"GLO", SCALE_UTC}, {"TAI", SCALE_TAI}, {"ccc", SCALE_GPS}};
    char name[64];
    columns(s->line, 10, 12, name);
    s->has_scale = true; /* the second line of its kind says nothing */
    for (size_t k = 0; k < sizeof SCALES / sizeof *SCALES; k++)
        if (strcasecmp(name, SCALES[k].name) == 0) {
            s->scale = SCALES[k].scale;
            return;
        }
    fail(s, 10, "the time system is '%s'; expected GPS, GAL, QZS, UTC, GLO or TAI", name);
}

/* Of the heading's satellites the wanted one must be there, or one alone. */
static void choose_satellite(sp3_reading *s, place where, const char *satellite)
{
    text list = {0};
    for (int k = 0; k < s->n_ids; k++) {
        if (satellite && strcasecmp(s->ids[k], satellite) == 0) s->wanted = s->ids[k];
        if (k < 40) text_printf(&list, "%s%s", k ? ", " : "", s->ids[k]);
    }
    if (!satellite && s->n_ids == 1) s->wanted = s->ids[0];
    if (list.failed)
        no_memory(s);
    else if (!s->wanted)
        s->worst =
            errors_add(s->errors, GLINT_INPUT, where,
                       satellite ? "'%s' has no satellite '%.20s'; it has %s"
                                 : "'%s' has several satellites%.0s: %s; say which one by "
                                   "sp3_satellite",
                       s->table->path, satellite ? satellite : "", list.data ? list.data : "none");
    text_free(&list);
}

/* ------------------------------------------------------------------------ epochs */

/* "*  2025  7 24  0  0  0.00000000" */
static void take_epoch(sp3_reading *s)
{
    int year, month, day, hour, minute;
    char second[32], plain[96];
    glint_error error;
    const place where = {s->table->path, s->number, 4};
    const double before_jd[2] = {s->epoch_jd[0], s->epoch_jd[1]};
    if (sscanf(s->line + 1, "%d %d %d %d %d %31[0-9.]", &year, &month, &day, &hour, &minute,
               second) != 6) {
        fail(s, 4, "'%.40s' is no epoch; expected year, month, day, hour, minute and second",
             s->line + 1);
        return;
    }
    snprintf(plain, sizeof plain, "%04d-%02d-%02dT%02d:%02d:%s%s", year, month, day, hour, minute,
             second[0] && isdigit((unsigned char)second[1]) ? "" : "0", second);
    if (time_parse(plain, s->scale, where, s->epoch_jd, &error)) {
        s->worst = errors_take(s->errors, &error, PLACE_NONE);
        return;
    }
    const bool late = s->n_epochs > 0 && s->interval_s > 0 &&
                      jd_difference_s(s->epoch_jd, before_jd) > 1.5 * s->interval_s;
    s->broken = s->broken || late || (s->n_epochs > 0 && !s->has_position);
    s->has_position = false;
    s->n_epochs++;
}

static table_segment *segment_now(sp3_reading *s)
{
    if (s->table->n && !s->broken) return &s->table->segments[s->table->n - 1];
    table_segment *segment = orbit_table_add(s->table);
    if (!segment) {
        no_memory(s);
        return NULL;
    }
    s->broken = false;
    memcpy(segment->frame_name, s->frame_name, sizeof segment->frame_name);
    segment->frame = TABLE_ITRS;
    segment->method = TABLE_LAGRANGE;
    segment->degree = DEGREE;
    segment->line = s->number;
    return segment;
}

/* "PG01 -11044.805800 -10475.672350  21929.418200 ..." */
static void take_position(sp3_reading *s)
{
    static const char *const NAMES[] = {"x", "y", "z"};
    static const double NO_VELOCITY[3] = {0, 0, 0};
    char id[64];
    double r_m[3];
    glint_error error;
    if (strcasecmp(columns(s->line, 2, 4, id), s->wanted) != 0) return;
    for (int i = 0; i < 3; i++) {
        if (!read_field(s, 5 + 14 * i, 18 + 14 * i, NAMES[i], &r_m[i])) return;
        r_m[i] *= 1e3;
    }
    if (r_m[0] == 0 && r_m[1] == 0 && r_m[2] == 0) return; /* not known then */
    if (table_state_check(r_m, NO_VELOCITY, "km", (place){s->table->path, s->number, 5}, &error)) {
        s->worst = errors_take(s->errors, &error, PLACE_NONE);
        return;
    }
    table_segment *segment = segment_now(s);
    if (!segment) return;
    if (!orbit_table_add_node(s->table, segment, s->epoch_jd, r_m, NO_VELOCITY)) no_memory(s);
    s->has_position = true;
}

static void take_line(sp3_reading *s, place where, const char *satellite)
{
    const char *line = s->line;
    if (s->number == 1)
        take_first(s);
    else if (line[0] == '#' && line[1] == '#')
        read_field(s, 25, 38, "interval between epochs", &s->interval_s);
    else if (line[0] == '+' && line[1] != '+')
        take_ids(s);
    else if (strncmp(line, "%c", 2) == 0 && !s->has_scale)
        take_scale(s);
    else if (line[0] == '*') {
        if (!s->wanted && !s->worst) choose_satellite(s, where, satellite);
        take_epoch(s);
    } else if (line[0] == 'P' && s->wanted)
        take_position(s);
    else if (strcmp(line, "EOF") == 0)
        s->ended = true;
}

static void finish(sp3_reading *s)
{
    const place end = {s->table->path, s->number, 0};
    glint_status status = GLINT_OK;
    if (!s->ended)
        status = errors_add(s->errors, GLINT_INPUT, end,
                            "the file ends without its EOF: it is cut off; get it again");
    else if (!s->worst && s->n_epochs != s->announced)
        status = errors_add(s->errors, GLINT_INPUT, end,
                            "the file says that it has %ld epochs, and has %ld: it is damaged; get "
                            "it again",
                            s->announced, s->n_epochs);
    else if (!s->worst)
        status = orbit_table_finish(s->table, s->errors);
    if (status) s->worst = status;
}

static void take_file(sp3_reading *s, char *at, place where, const char *satellite)
{
    if (strncmp(at, "\xEF\xBB\xBF", 3) == 0) at += 3;
    if (*at != '#') {
        s->number = 1;
        fail(s, 1, "this is no SP3 file; expected a first line that begins with #a to #d");
        return;
    }
    while (*at && !s->ended && s->worst != GLINT_INTERNAL) {
        char *line = at, *end = line + strcspn(line, "\n");
        at = *end ? end + 1 : end;
        while (end > line && strchr(" \t\r", end[-1]))
            end--;
        *end = '\0';
        s->number++;
        s->line = line;
        take_line(s, where, satellite);
        if (s->number == 1 && s->worst) return;
    }
    finish(s);
}

glint_status sp3_read(const char *path, place asked_from, const char *satellite, orbit_table **out,
                      glint_errors *errors)
{
    *out = NULL;
    char *bytes;
    size_t size;
    glint_error error;
    if (file_read(path, &bytes, &size, asked_from, &error))
        return errors_take(errors, &error, asked_from);
    sp3_reading *s = calloc(1, sizeof *s);
    orbit_table *table = orbit_table_new(path, "SP3");
    glint_status status = GLINT_OK;
    if (!s || !table) {
        status = errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    } else if (memchr(bytes, '\0', size)) {
        status = errors_add(errors, GLINT_INPUT, (place){path, 0, 0},
                            "this is not a text file; expected precise orbits in SP3");
    } else {
        *s = (sp3_reading){.table = table, .errors = errors, .scale = SCALE_GPS};
        take_file(s, bytes, asked_from.file ? asked_from : (place){path, 0, 0}, satellite);
        status = s->worst;
        if (!status) snprintf(table->object, sizeof table->object, "%s", s->wanted);
    }
    free(s);
    free(bytes);
    if (status)
        orbit_table_free(table);
    else
        *out = table;
    return status;
}
