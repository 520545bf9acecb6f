#include "orbit/attitude_table.h"

#include "base/constants.h"
#include "base/grow.h"
#include "base/sorted.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/attitude_law.h"
#include "orbit/attitude_table_parts.h"
#include "orbit/ccsds.h"
#include "orbit/frames.h"
#include "orbit/time_column.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

void attitude_table_free(attitude_table *t)
{
    if (!t) return;
    free(t->path);
    free(t->t_s);
    free(t->q);
    free(t->spans);
    free(t);
}

/* -------------------------------------------------------------- building one */

void attitude_table_fail(attitude_reading *r, place where, const char *format, ...)
{
    char message[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    const glint_status status = errors_add(r->errors, GLINT_INPUT, where, "%s", message);
    if (status > r->status) r->status = status;
}

static void no_memory(attitude_reading *r)
{
    if (r->status != GLINT_INTERNAL)
        r->status = errors_add(r->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
}

void attitude_table_begin_span(attitude_reading *r, file_frame frame, place where)
{
    attitude_table *t = r->table;
    if (!grow_room(&t->spans, &t->span_capacity, t->n_spans + 1L, sizeof *t->spans)) {
        no_memory(r);
        return;
    }
    where.file = t->path;
    t->spans[t->n_spans++] = (attitude_span){.first = t->n, .where = where};
    r->frame = frame;
}

static bool make_room(attitude_reading *r)
{
    attitude_table *t = r->table;
    const size_t needed = (size_t)t->n + 1;
    size_t of_times = t->capacity;
    if (grow_list(&t->t_s, &of_times, needed, sizeof *t->t_s) &&
        grow_list(&t->q, &t->capacity, needed, sizeof *t->q))
        return true;
    no_memory(r);
    return false;
}

/* The angle between two attitudes by the shortest way, rad. */
static double angle_between(const double a[4], const double b[4])
{
    double back[4], way[4];
    quat_conjugate(a, back);
    quat_mul(b, back, way);
    return 2 * atan2(norm3(way + 1), fabs(way[0]));
}

void attitude_table_add_row(attitude_reading *r, double t_s, const double q[4], place where)
{
    static const double FARTHEST_S = 2e9; /* 63 years: the years of UTC on both sides */
    attitude_table *t = r->table;
    const double norm = sqrt(quat_dot(q, q));
    if (t->n_spans == 0 || r->status == GLINT_INTERNAL) return;
    attitude_span *span = &t->spans[t->n_spans - 1];
    if (!(fabs(norm - 1) <= ATTITUDE_NORM_TOLERANCE)) {
        attitude_table_fail(r, where, "the quaternion has the norm %.6g; expected 1 within %g",
                            norm, ATTITUDE_NORM_TOLERANCE);
        return;
    }
    if (!(fabs(t_s) <= FARTHEST_S)) {
        attitude_table_fail(r, where,
                            "this row lies %.4g s from the start of the run; expected at most %g",
                            t_s, FARTHEST_S);
        return;
    }
    if (span->n > 0 && !(t_s > t->t_s[t->n - 1])) {
        attitude_table_fail(r, where,
                            "this row lies %g s before the one above it; expected times that grow "
                            "from row to row",
                            t->t_s[t->n - 1] - t_s);
        return;
    }
    if (!make_room(r)) return;
    for (int i = 0; i < 4; i++)
        t->q[t->n][i] = q[i] / norm;
    t->t_s[t->n] = t_s;
    if (span->n > 0) {
        const double told = r->told_rad_s * (t_s - t->t_s[t->n - 1]);
        const double angle = fmax(angle_between(t->q[t->n - 1], t->q[t->n]), told);
        if (angle > r->widest_rad) {
            r->widest_rad = angle;
            r->widest_where = where;
            r->widest_where.file = t->path; /* outlives the reader of the file */
        }
    }
    t->n++;
    span->n++;
}

/* Turns the rows of a span from the file's axes into GCRS: v_gcrs = R v_file. */
static void turn_rows(attitude_table *t, long first, long n, const double gcrs_file[9])
{
    double turn[4];
    quat_from_mat(gcrs_file, turn);
    for (long k = first; k < first + n; k++)
        quat_mul(turn, t->q[k], t->q[k]);
}

static void turn_from_eme2000(attitude_table *t, const attitude_span *span)
{
    double eme2000_gcrs[9], gcrs_eme2000[9];
    frame_bias(eme2000_gcrs);
    mat_transpose(eme2000_gcrs, gcrs_eme2000);
    turn_rows(t, span->first, span->n, gcrs_eme2000);
}

static void turn_from_teme(attitude_reading *r, const attitude_span *span)
{
    attitude_table *t = r->table;
    const earth_orientation still = {0, 0};
    frame_grid *grid = NULL;
    glint_error error;
    /* Rows are evaluated one by one: a grid of this step is never passed by. */
    const double step_s = 1, from_s = t->t_s[span->first], to_s = t->t_s[t->n - 1];
    if (frame_grid_prepare(r->clock, &still, from_s, to_s, step_s, &grid, &error)) {
        r->status = errors_take(r->errors, &error, PLACE_NONE);
        return;
    }
    for (long k = span->first; k < t->n; k++) {
        frame_set frames;
        frame_grid_at(grid, t->t_s[k], FRAMES_TEME, &frames);
        turn_rows(t, k, 1, frames.gcrs_teme);
    }
    frame_grid_free(grid);
}

void attitude_table_end_span(attitude_reading *r, double from_s, double to_s)
{
    attitude_table *t = r->table;
    if (t->n_spans == 0 || r->status) return;
    attitude_span *span = &t->spans[t->n_spans - 1];
    if (span->n == 0) {
        attitude_table_fail(r, span->where, "no attitude stands here; expected one row or more");
        return;
    }
    span->from_s = fmax(from_s, t->t_s[span->first]);
    span->to_s = fmin(to_s, t->t_s[t->n - 1]);
    if (!(span->from_s <= span->to_s)) {
        attitude_table_fail(r, span->where,
                            "the rows lie outside the usable time of their segment");
        return;
    }
    span->frame = r->frame <= FILE_ITRS ? (attitude_frame)r->frame : ATTITUDE_GCRS;
    if (r->frame == FILE_EME2000) turn_from_eme2000(t, span);
    if (r->frame == FILE_TEME) turn_from_teme(r, span);
}

/* ----------------------------------------------------------------- reading */

static int by_time(const void *a, const void *b)
{
    const attitude_span *p = a, *q = b;
    if (p->from_s != q->from_s) return p->from_s < q->from_s ? -1 : 1;
    return p->to_s < q->to_s ? -1 : p->to_s > q->to_s;
}

/* Puts the spans in their order and refuses those that overlap. */
static void order_spans(attitude_reading *r)
{
    attitude_table *t = r->table;
    if (t->n_spans) qsort(t->spans, (size_t)t->n_spans, sizeof *t->spans, by_time);
    for (int k = 1; k < t->n_spans; k++)
        if (t->spans[k].from_s < t->spans[k - 1].to_s - TIME_SLACK_S)
            attitude_table_fail(
                r, t->spans[k].where,
                "the usable time of this segment begins %g s before that of the segment at "
                "line %d ends; expected segments that do not overlap",
                t->spans[k - 1].to_s - t->spans[k].from_s, t->spans[k - 1].where.line);
}

static void warn_of_wide_steps(const attitude_reading *r)
{
    static const double WIDE_RAD = 0.5 * PI;
    if (!(r->widest_rad > WIDE_RAD)) return;
    errors_warn(r->errors, r->widest_where,
                "the body turns by %.0f deg from the row above to this one; between rows the "
                "shortest way at a steady rate is taken, which may not be the real one: give rows "
                "closer to each other",
                r->widest_rad / DEG);
}

/* What a file begins with, blanks, comments and a byte order mark left aside. */
static const char *first_words(const char *bytes)
{
    if (strncmp(bytes, "\xEF\xBB\xBF", 3) == 0) bytes += 3;
    for (;;) {
        bytes += strspn(bytes, " \t\r\n");
        if (*bytes != '#' && strncasecmp(bytes, "COMMENT", 7) != 0) return bytes;
        bytes += strcspn(bytes, "\n");
    }
}

static void read_kind(attitude_reading *r, const char *object, const attitude_frame *csv_frame,
                      char *bytes, size_t size, place asked_from)
{
    const char *begins = first_words(bytes);
    const bool is_stk = strncasecmp(begins, "stk.v", 5) == 0;
    const bool is_ccsds = ccsds_is_xml(bytes) || strncasecmp(begins, "CCSDS_", 6) == 0;
    if (object && !is_ccsds)
        attitude_table_fail(r, asked_from,
                            "'object' chooses among the objects of a CCSDS AEM, and this "
                            "file is none; take the key out");
    if (csv_frame && (is_ccsds || is_stk))
        attitude_table_fail(r, asked_from,
                            "'frame' belongs to CSV tables, and this file names its axes "
                            "itself; take the key out");
    if (is_ccsds) {
        r->table->kind = "CCSDS AEM";
        attitude_aem_read(r, bytes, size, object);
    } else if (is_stk) {
        r->table->kind = "STK attitude file";
        attitude_stk_read(r, bytes, size);
    } else {
        r->table->kind = "CSV table";
        free(bytes);
        attitude_csv_read(r, csv_frame ? *csv_frame : ATTITUDE_GCRS, asked_from);
    }
}

glint_status attitude_table_read(const char *path, const char *object,
                                 const attitude_frame *csv_frame, const run_clock *clock,
                                 place asked_from, attitude_table **out, glint_errors *errors)
{
    *out = NULL;
    char *bytes;
    size_t size;
    glint_error error;
    if (file_read(path, &bytes, &size, asked_from, &error))
        return errors_take(errors, &error, asked_from);
    attitude_reading r = {.clock = clock, .errors = errors};
    r.table = calloc(1, sizeof *r.table);
    if (r.table) r.table->path = string_copy(path, strlen(path));
    if (!r.table || !r.table->path) {
        free(bytes);
        attitude_table_free(r.table);
        return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    }
    read_kind(&r, object, csv_frame, bytes, size, asked_from);
    if (!r.status) order_spans(&r);
    if (!r.status && r.table->n == 0)
        attitude_table_fail(&r, (place){r.table->path, 0, 0},
                            "the file has no attitudes; expected some");
    if (!r.status) warn_of_wide_steps(&r);
    if (r.status)
        attitude_table_free(r.table);
    else
        *out = r.table;
    return r.status;
}

/* -------------------------------------------------------------- evaluating */

/* The span that a moment belongs to; NULL where there is none. Where two spans meet the later one
 * counts. */
static const attitude_span *span_at(const attitude_table *t, double t_s)
{
    const int next =
        (int)sorted_up_to(&t->spans->from_s, (size_t)t->n_spans, sizeof *t->spans, t_s);
    if (next > 0 && t_s <= t->spans[next - 1].to_s + TIME_SLACK_S) return &t->spans[next - 1];
    if (next < t->n_spans && t_s >= t->spans[next].from_s - TIME_LEAD_S) return &t->spans[next];
    return NULL;
}

static glint_status outside(const attitude_table *t, double t_s, glint_error *error)
{
    const attitude_span *before = NULL, *after = NULL;
    for (int k = 0; k < t->n_spans; k++) {
        if (t->spans[k].to_s < t_s) before = &t->spans[k];
        if (t->spans[k].from_s > t_s && !after) after = &t->spans[k];
    }
    if (before && after)
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "the attitude table '%s' says nothing at %.10g s from the start: it has a "
                         "gap from %.10g to %.10g s",
                         t->path, t_s, before->to_s, after->from_s);
    return error_set(error, GLINT_INPUT, PLACE_NONE,
                     "the attitude table '%s' says nothing at %.10g s from the start: it %s at "
                     "%.10g s; expected a table that covers the run",
                     t->path, t_s, before ? "ends" : "begins",
                     before  ? before->to_s
                     : after ? after->from_s
                             : 0.0);
}

/* Last row of the span, but for its last one, that is not after t_s; its first one before that. */
static long row_before(const attitude_table *t, const attitude_span *span, double t_s)
{
    const double *rows_s = t->t_s + span->first;
    return span->first + (long)sorted_interval(rows_s, (size_t)span->n, sizeof *rows_s, t_s);
}

/* The quaternion of a span at a moment: v_frame = q v_body q*. */
static void quaternion_at(const attitude_table *t, const attitude_span *span, double t_s,
                          double q[4])
{
    const long k = row_before(t, span, t_s);
    if (span->n == 1) {
        memcpy(q, t->q[k], sizeof t->q[k]);
        return;
    }
    const double step_s = t->t_s[k + 1] - t->t_s[k];
    quat_slerp(t->q[k], t->q[k + 1], (t_s - t->t_s[k]) / step_s, q);
}

glint_status attitude_table_at(const attitude_table *t, const moment *m, double body_gcrs[9],
                               glint_error *error)
{
    static const attitude centred = {0}; /* the laws 'nadir' and 'rsw' without options */
    const attitude_span *span = span_at(t, m->t_s);
    if (!span) return outside(t, m->t_s, error);
    double q[4], frame_body[9], frame_gcrs[9];
    quaternion_at(t, span, m->t_s, q);
    mat_from_quat(q, frame_body);
    mat_transpose(frame_body, body_gcrs);
    glint_status status = GLINT_OK;
    switch (span->frame) {
    case ATTITUDE_GCRS:
        return GLINT_OK;
    case ATTITUDE_LVLH:
        status = attitude_nadir.at(&centred, m, frame_gcrs, error);
        break;
    case ATTITUDE_RSW:
        status = attitude_rsw.at(&centred, m, frame_gcrs, error);
        break;
    case ATTITUDE_ITRS:
        memcpy(frame_gcrs, m->itrs_gcrs, sizeof frame_gcrs);
        break;
    }
    if (!status) mat_mul(body_gcrs, frame_gcrs, body_gcrs);
    return status;
}

double attitude_table_next_row(const attitude_table *t, double t_s)
{
    double next_s = INFINITY;
    for (int i = 0; i < t->n_spans; i++) {
        const attitude_span *span = &t->spans[i];
        const long last = span->first + span->n - 1;
        if (t->t_s[last] <= t_s) continue;
        const long k = row_before(t, span, t_s);
        next_s = fmin(next_s, t->t_s[k] > t_s ? t->t_s[k] : t->t_s[k + 1]);
    }
    return next_s;
}

void attitude_table_describe(const attitude_table *t, text *out)
{
    const char *slash = strrchr(t->path, '/');
    text_printf(out, "%s '%s', %ld rows", t->kind, slash ? slash + 1 : t->path, t->n);
    if (t->n_spans > 1) text_printf(out, " in %d spans", t->n_spans);
    text_printf(out, " from %.10g to %.10g s", t->spans[0].from_s, t->spans[t->n_spans - 1].to_s);
}

bool attitude_table_gap(const attitude_table *t, double from_s, double to_s, double *gap_s)
{
    double covered_s = from_s;
    for (int k = 0; k < t->n_spans; k++) {
        if (t->spans[k].from_s - TIME_LEAD_S > covered_s) break;
        covered_s = fmax(covered_s, t->spans[k].to_s);
    }
    *gap_s = covered_s;
    return covered_s < to_s - TIME_SLACK_S;
}

/* -------------------------------------------------------------------- the law */

enum { FILE_KEY, OBJECT_KEY, FRAME_KEY, N_KEYS };
static const char *const frames[] = {"gcrs", "lvlh", NULL};
static const attitude_key keys[N_KEYS] = {
    {"file", "", "a CCSDS AEM, an STK attitude file (.a) or a CSV table", ATTITUDE_PATH, true, 0,
     NULL},
    {"object", "", "OBJECT_NAME or OBJECT_ID in an AEM of several objects", ATTITUDE_STRING, false,
     0, NULL},
    {"frame", "", "what the quaternions of a CSV table turn the body's axes into", ATTITUDE_WORD,
     false, 0, frames},
};

static glint_status prepare(const attitude_spec *spec, attitude *out, glint_errors *errors)
{
    const attitude_frame frame = spec->value[FRAME_KEY][0] == 1 ? ATTITUDE_LVLH : ATTITUDE_GCRS;
    out->to.kind = out->second_to.kind = DIRECTION_NORTH; /* asks for nothing that moves */
    return attitude_table_read(spec->path, spec->text[OBJECT_KEY],
                               spec->given[FRAME_KEY] ? &frame : NULL, spec->clock,
                               spec->key_place[FILE_KEY], &out->table, errors);
}

static glint_status at(const attitude *a, const moment *m, double body_gcrs[9], glint_error *error)
{
    return attitude_table_at(a->table, m, body_gcrs, error);
}

const attitude_law attitude_table_law = {
    .name = "table",
    .doc = "quaternions from a file; between its rows the shortest way at a steady rate",
    .keys = keys,
    .n_keys = N_KEYS,
    .prepare = prepare,
    .at = at,
};
