/* facts_orbit.c: where positions come from. */
#include "base/constants.h"
#include "base/text.h"
#include "lightcurve/facts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A moment of the run (TT s from the start) as UTC, to the second. */
static void add_moment(text *out, const glint_scenario *s, double t_s)
{
    char utc[UTC_TEXT_SIZE + 1];
    double tt_jd[2];
    run_clock_tt(&s->clock, t_s + 0.5, tt_jd); /* cut, not rounded, below */
    tt_write_utc(tt_jd, utc);
    text_printf(out, "%.19sZ", utc);
}

static double run_end_s(const glint_scenario *s)
{
    return (double)(s->n_steps - 1) * s->step_s;
}

static void add_name(text *out, const char *name, const char *kind, const char *id)
{
    text_printf(out, "%s%s%s", name, name[0] && id[0] ? ", " : "", id[0] ? kind : "");
    text_printf(out, "%s%s", id[0] ? " " : "", id);
}

static void describe_sets(text *out, const glint_scenario *s, const scenario_orbit *o)
{
    size_t n;
    const orbit_set_use *uses = orbit_sets(o->propagator, &n);
    const tle *set = &o->sets.sets[uses[0].index];
    char number[16] = "";
    if (set->number > 0) snprintf(number, sizeof number, "%d", set->number);
    text_add(out, "SGP4 (AIAA 2006-6753, WGS72, mode i), ");
    if (n == 1)
        text_add(out, "element set of ");
    else
        text_printf(out, "%zu element sets of ", n);
    add_name(out, set->name, "number", number[0] ? number : set->designator);
    if (n > 1) {
        text_add(out, ", at any time the one whose epoch is nearest");
        return;
    }
    const double days = -uses[0].epoch_s / DAY_S;
    text_add(out, ", epoch ");
    add_moment(out, s, uses[0].epoch_s);
    text_printf(out, ", %.3f days %s the start", fabs(days), days >= 0 ? "before" : "after");
    if (o->sets.n > 1) text_printf(out, "; nearest of %zu sets", o->sets.n);
}

/* How a table's segments are interpolated, where all are alike; else what the first is. */
static void describe_table(text *out, const glint_scenario *s, const scenario_orbit *o)
{
    double reference_s, from_s, to_s;
    const orbit_table *table = orbit_table_of(o->propagator, &reference_s);
    const table_segment *first = &table->segments[0];
    size_t records = 0;
    orbit_table_span(table, &from_s, &to_s);
    for (size_t k = 0; k < table->n; k++)
        records += table->segments[k].n;
    const bool named = table->object[0] || table->id[0];
    text_add(out, named ? "positions of " : "positions");
    add_name(out, table->object, "id", table->id);
    text_printf(out, " (%s): %zu records in %s", table->format, records, first->frame_name);
    if (table->n > 1) text_printf(out, ", %zu segments", table->n);
    text_add(out, ", from ");
    add_moment(out, s, reference_s + from_s);
    text_add(out, " to ");
    add_moment(out, s, reference_s + to_s);
    if (first->method == TABLE_LINEAR)
        text_add(out, ", linear between them");
    else
        text_printf(out, ", %s interpolation of degree %d", table_method_name(first->method),
                    first->degree);
    text_printf(out, ", good to %.1g m",
                orbit_table_error_m(table, -reference_s, run_end_s(s) - reference_s));
}

char *fact_orbit(const glint_scenario *s, const scenario_orbit *o)
{
    text out = {0};
    const kepler_elements *k = &o->kepler;
    switch (o->source) {
    case ORBIT_TLE:
        describe_sets(&out, s, o);
        break;
    case ORBIT_POSITIONS:
        describe_table(&out, s, o);
        break;
    case ORBIT_KEPLER:
    case ORBIT_CIRCULAR:
        text_printf(&out,
                    "Kepler%s, a = %.6g km, e = %.6g, i = %.6g deg; equator of date neglected",
                    o->j2 ? " with the secular drift of J2" : ", two bodies",
                    k->semi_major_axis_m * 1e-3, k->eccentricity, k->inclination / DEG);
        break;
    case ORBIT_GEOSTATIONARY:
        text_printf(&out, "geostationary, longitude %.6g deg", o->geostationary_longitude / DEG);
        break;
    }
    return out.data;
}

char *fact_element_sets(const glint_scenario *s, const scenario_orbit *o)
{
    enum { MOST = 8 };
    text out = {0};
    size_t n;
    const orbit_set_use *uses = orbit_sets(o->propagator, &n);
    if (n < 2) return NULL;
    double largest_m = 0;
    for (size_t k = 0; k < n; k++) {
        if (uses[k].has_jump && uses[k].jump_m > largest_m) largest_m = uses[k].jump_m;
        if (k >= MOST) continue;
        const double from_s = fmax(uses[k].from_s, 0), to_s = fmin(uses[k].to_s, run_end_s(s));
        const double age_s = fmax(fabs(from_s - uses[k].epoch_s), fabs(to_s - uses[k].epoch_s));
        text_add(&out, k ? "; epoch " : "epoch ");
        add_moment(&out, s, uses[k].epoch_s);
        if (k) {
            text_add(&out, " from ");
            add_moment(&out, s, uses[k].from_s);
        }
        text_printf(&out, ", at most %.3f days away", age_s / DAY_S);
        if (uses[k].has_jump) text_printf(&out, ", jump %.4g m", uses[k].jump_m);
    }
    if (n > MOST) text_printf(&out, "; and %zu more, largest jump %.4g m", n - MOST, largest_m);
    return out.data;
}

const char *scenario_object(const glint_scenario *s)
{
    const orbit_table *table = orbit_table_of(s->orbit.propagator, NULL);
    if (table) return table->object[0] ? table->object : table->id;
    return s->orbit.sets.n ? s->orbit.sets.sets[0].name : "";
}
