/* read_time.c: [time] and [corrections]: the moments of a run, the clock that tells them in every
 * scale, and where UT1 comes from. */
#include "base/constants.h"
#include "scenario/reading.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A file of measured Earth orientation; whether it covers the run is known after [time]. */
static void read_eop(reading *rd, reader *r)
{
    glint_scenario *s = rd->s;
    const toml_node *file =
        reader_get(r, "eop", TOML_STRING, true, "the path of a file finals2000A or C04");
    if (reader_has(r, "dut1_s"))
        reader_fail(r, reader_place(r, "dut1_s"),
                    "both 'dut1_s' and 'eop', which holds it, are given; expected one of them");
    char *path = file ? reading_path(rd, file) : NULL;
    if (!path) return;
    s->eop_name = file->string;
    s->eop_where = file->where;
    reading_note(rd, eop_read(path, file->where, &s->eop, rd->errors));
    free(path);
}

void read_corrections(reading *rd, reader *root)
{
    static const param_info DUT1 = {"dut1_s", "s", "UT1-UTC", -0.9, 0.9, 0, 0};
    glint_scenario *s = rd->s;
    s->light_time = s->aberration = true;
    const toml_node *table = reader_table(root, "corrections", false);
    if (!table) return;
    reader r = reader_start(table, "[corrections]", rd->errors);
    reader_boolean(&r, "light_time", true, &s->light_time);
    reader_boolean(&r, "aberration", true, &s->aberration);
    reader_param(&r, &DUT1, &s->dut1_s);
    if (reader_has(&r, "eop")) read_eop(rd, &r);
    reading_done(rd, &r);
}

/* Counts steps: k step_s up to the end, the last one to within 1e-6 of a step. */
static void count_steps(reading *rd, reader *r, double span_s)
{
    static const double MOST = 1e10;
    glint_scenario *s = rd->s;
    const double steps = floor(span_s / s->step_s + 1e-6);
    if (steps >= MOST)
        reader_fail(
            r, reader_place(r, "step_s"),
            "this time span has %.3g steps of %g s; expected at most %g: take a longer step", steps,
            s->step_s, MOST);
    else
        s->n_steps = (int64_t)steps + 1;
}

/* A run that begins in time but goes on past what the ephemeris of the Sun covers. */
static void check_last_year(reader *r, const run_clock *clock, double span_s)
{
    enum { LAST_YEAR = 2100 }; /* as for times that are given: utc_check */
    glint_utc end;
    run_clock_utc(clock, span_s, &end);
    if (end.year > LAST_YEAR)
        reader_fail(r, reader_place(r, "duration_s"),
                    "the run ends in the year %d; expected an end up to %d, as far as the Sun's "
                    "ephemeris holds",
                    end.year, LAST_YEAR);
}

/* Date of a modified Julian day. */
static void write_date(int mjd, char out[16])
{
    glint_utc date;
    utc_from_mjd(mjd, &date);
    snprintf(out, 16, "%04d-%02d-%02d", date.year % 10000, date.month % 100, date.day % 100);
}

/* Lets the clock take UT1 from the file, which must cover the run. */
static void use_eop(reading *rd, reader *r, double span_s)
{
    glint_scenario *s = rd->s;
    double end_jd[2];
    run_clock_tt(&s->clock, span_s, end_jd);
    if (eop_covers(s->eop, s->clock.tt_jd) && eop_covers(s->eop, end_jd)) {
        run_clock_orient(&s->clock, s->eop);
        return;
    }
    int first, last, predicted;
    char from[16], to[16];
    eop_span(s->eop, &first, &last, &predicted);
    write_date(first, from);
    write_date(last, to);
    reader_fail(r, s->eop_where,
                "the file has Earth orientation from %s to %s, 0h UTC, which is not all of the "
                "run; expected a file that covers it, or dut1_s instead",
                from, to);
}

void read_time(reading *rd, reader *root)
{
    static const param_info STEP = {"step_s",       "s",           "time between rows", 0, 1e9,
                                    PARAM_REQUIRED, PARAM_MIN_OPEN};
    static const param_info EXPOSURE = {
        "exposure_s", "s", "light is averaged over it", 0, 86400, 0, 0};
    static const param_info DURATION = {"duration_s", "s", "length of the run", 0, 4.1e9, 0, 0};
    const toml_node *table = reader_table(root, "time", true);
    if (!table) return;
    glint_scenario *s = rd->s;
    reader r = reader_start(table, "[time]", rd->errors);
    utc_time start, end;
    double span_s = 0;
    const bool has_start = reader_time(&r, "start", true, &start);
    const bool has_end = reader_time(&r, "end", false, &end);
    const bool has_duration = reader_param(&r, &DURATION, &span_s);
    const bool has_step = reader_param(&r, &STEP, &s->step_s);
    reader_param(&r, &EXPOSURE, &s->exposure_s);
    if (reader_has(&r, "end") && reader_has(&r, "duration_s"))
        reader_fail(&r, reader_place(&r, "duration_s"),
                    "both 'end' and 'duration_s' are given; expected one of them");
    else if (!reader_has(&r, "end") && !reader_has(&r, "duration_s"))
        reader_fail(&r, table->where, "[time] has neither 'end' nor 'duration_s'; expected one");
    if (has_start && has_end) {
        double a[2], b[2], tai_utc;
        utc_to_tt(&start, a, &tai_utc, NULL);
        utc_to_tt(&end, b, &tai_utc, NULL);
        span_s = jd_difference_s(b, a);
        if (span_s < 0)
            reader_fail(&r, reader_place(&r, "end"),
                        "the end lies %g s before the start; expected an end not before it",
                        -span_s);
    }
    if (r.status == GLINT_OK && has_start && (has_end || has_duration) && has_step) {
        s->span_s = span_s;
        run_clock_start(&start, span_s, s->dut1_s, &s->clock);
        count_steps(rd, &r, span_s);
        check_last_year(&r, &s->clock, span_s);
        if (s->eop) use_eop(rd, &r, span_s);
        if (s->clock.dubious)
            errors_warn(rd->errors, table->where,
                        "leap seconds are not known for these years; UTC may be off by a second "
                        "or more");
    }
    reading_done(rd, &r);
}
