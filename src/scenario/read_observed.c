/* read_observed.c: [observed]: a track that `glint compare` holds the prediction against. */
#include "base/text.h"
#include "scenario/observed_file.h"
#include "scenario/reading.h"

#include <stdlib.h>

typedef enum observed_format { FORMAT_CSV, FORMAT_MMT, FORMAT_SCORE, N_FORMATS } observed_format;
static const char *const FORMATS[N_FORMATS] = {"csv", "mmt", "score"};

/* The columns of the template of SCORE, the Satellite Constellation Observation Repository of the
 * IAU CPS, by their meaning. */
static const char *const SCORE_COLUMNS[OBSERVED_COLUMNS] = {
    [OBSERVED_UTC] = "observation_time_utc",
    [OBSERVED_MAGNITUDE] = "apparent_magnitude",
    [OBSERVED_SIGMA] = "apparent_magnitude_uncertainty",
    [OBSERVED_RANGE] = "range_to_satellite_km",
    [OBSERVED_FILTER] = "observing_filter"};

const char *const observed_kind_names[3] = {[OBSERVED_APPARENT] = "apparent",
                                            [OBSERVED_AT_1000_KM] = "at-1000-km",
                                            [OBSERVED_AT_1000_KM_90_DEG] = "at-1000-km-90-deg"};

void observed_free(observed_track *o)
{
    free(o->path);
    free(o->rows);
    *o = (observed_track){0};
}

static void read_columns(reading *rd, reader *r, int format, observed_wanted *wanted)
{
    const toml_node *table = reader_table(r, "columns", false);
    for (int k = 0; format == FORMAT_SCORE && k < OBSERVED_COLUMNS; k++) {
        wanted->columns[k] = SCORE_COLUMNS[k];
        wanted->column_places[k] = r->table->where;
    }
    if (!table) return;
    if (format != FORMAT_CSV) {
        reader_fail(r, reader_place(r, "columns"),
                    "format = \"%s\" has columns of its own; expected no 'columns'",
                    FORMATS[format]);
        return;
    }
    reader inner = reader_start(table, "columns", rd->errors);
    for (int k = 0; k < OBSERVED_COLUMNS; k++)
        if (reader_string(&inner, observed_column_names[k], false, &wanted->columns[k]))
            wanted->column_places[k] = reader_place(&inner, observed_column_names[k]);
    reading_done(rd, &inner);
}

static void read_band(reading *rd, reader *r, observed_track *o)
{
    const glint_scenario *s = rd->s;
    const char *band = NULL, *names[SCENARIO_MAX_BANDS];
    if (!reader_string(r, "band", false, &band)) return;
    for (int b = 0; b < s->n_bands; b++) {
        names[b] = s->bands[b]->name;
        if (!string_equal(names[b], band)) continue;
        o->band = b;
        return;
    }
    const char *near = nearest_name(band, names, (size_t)s->n_bands);
    reader_fail(r, reader_place(r, "band"),
                "band '%.40s' is not among [photometry] bands; expected one of them%s%s%s", band,
                near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "");
}

/* Whose observations they are: of one observer there is no doubt. */
static void read_observer_name(reading *rd, reader *r, observed_track *o)
{
    const glint_scenario *s = rd->s;
    const char *name = NULL;
    if (!reader_string(r, "observer", s->n_observers > 1, &name)) return;
    for (int k = 0; k < s->n_observers; k++)
        if (string_equal(s->observers[k].name, name)) {
            o->observer = k;
            return;
        }
    if (s->n_observers > 0)
        reader_fail(r, reader_place(r, "observer"), "no observer is named '%.60s'", name);
}

/* Says why no observation is left. */
static void warn_of_none(const reading *rd, place where, const observed_track *o)
{
    text why = {0};
    if (o->outside_time > 0)
        text_printf(&why, "; %lld lie outside of [time], from %s to %s UTC",
                    (long long)o->outside_time, reading_moment(rd->s, o->from_s).utc,
                    reading_moment(rd->s, o->to_s).utc);
    if (o->other_filter > 0)
        text_printf(&why, "; %lld have another filter, as '%s'", (long long)o->other_filter,
                    o->a_filter);
    if (o->without_magnitude > 0)
        text_printf(&why, "; %lld have no magnitude", (long long)o->without_magnitude);
    errors_warn(rd->errors, where, "none of the observations can be compared%s",
                why.data ? why.data : "");
    text_free(&why);
}

static void read_file(reading *rd, reader *r, int format, observed_wanted *wanted,
                      observed_track *o)
{
    const toml_node *file = reader_get(r, "file", TOML_STRING, true, "the path of a file");
    if (!file) return;
    o->path = reading_path(rd, file);
    if (!o->path || rd->status || r->status) return; /* no clock without a time */
    wanted->path = o->path;
    wanted->asked_from = file->where;
    glint_status status = format == FORMAT_MMT ? observed_read_mmt(wanted, o, rd->errors)
                                               : observed_read_csv(wanted, o, rd->errors);
    if (!status && o->n + (size_t)(o->other_filter + o->without_magnitude + o->outside_time) == 0)
        status = errors_add(rd->errors, GLINT_INPUT, (place){o->path, 0, 0},
                            "the file has no observation; expected at least one");
    else if (!status && o->n == 0)
        warn_of_none(rd, file->where, o);
    reading_note(rd, status);
}

void read_observed(reading *rd, reader *root)
{
    glint_scenario *s = rd->s;
    const toml_node *table = reader_table(root, "observed", false);
    if (!table) return;
    observed_track *o = &s->observed;
    reader r = reader_start(table, "[observed]", rd->errors);
    observed_wanted wanted = {.clock = &s->clock, .span_s = s->span_s};
    int format, kind;
    s->has_observed = true;
    if (s->has_geometry)
        reader_fail(&r, table->where,
                    "[observed] stands beside [geometry], which has no time; expected one of them");
    reader_choice(&r, "format", FORMATS, N_FORMATS, FORMAT_CSV, &format);
    reader_choice(&r, "magnitude", observed_kind_names, 3, OBSERVED_APPARENT, &kind);
    o->format = FORMATS[format];
    o->kind = (observed_kind)kind;
    read_observer_name(rd, &r, o);
    read_band(rd, &r, o);
    reader_boolean(&r, "fit_zero_point", false, &o->fit_zero_point);
    reader_string(&r, "filter", false, &wanted.filter);
    read_columns(rd, &r, format, &wanted);
    wanted.is_template = format == FORMAT_SCORE;
    wanted.standard = kind == OBSERVED_AT_1000_KM_90_DEG;
    if (format == FORMAT_MMT && kind == OBSERVED_AT_1000_KM)
        reader_fail(&r, reader_place(&r, "magnitude"),
                    "tracks of MMT have no magnitudes of this kind; expected \"apparent\" (their "
                    "Mag) or \"at-1000-km-90-deg\" (their StdMag)");
    if (format == FORMAT_SCORE && kind != OBSERVED_APPARENT)
        reader_fail(&r, reader_place(&r, "magnitude"),
                    "SCORE has apparent magnitudes; expected \"apparent\"");
    read_file(rd, &r, format, &wanted, o);
    reading_done(rd, &r);
}
