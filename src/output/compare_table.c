/* compare_table.c: a prediction beside an observed track: as a table for people, as CSV with an
 * ECSV header, as JSON. */
#include "output/ecsv.h"
#include "output/facts.h"
#include "output/json.h"

static const double DEGREES = 57.295779513082320877; /* per rad */

static void add_utc(text *t, const glint_utc *u)
{
    text_printf(t, "%04d-%02d-%02dT%02d:%02d:%02d.%06dZ", u->year, u->month, u->day, u->hour,
                u->minute, u->second, u->microsecond);
}

/* A number of the whole; it is there or not. */
typedef struct fact {
    const char *key;
    double value;
    bool there;
} fact;

enum { N_FACTS = 26 };

static void list_facts(const glint_comparison_summary *s, fact out[N_FACTS])
{
    const bool any = s->compared > 0;
    const fact facts[N_FACTS] = {
        {"observations", (double)s->observations, true},
        {"compared", (double)s->compared, true},
        {"eclipsed", (double)s->eclipsed, true},
        {"not_seen", (double)s->not_seen, true},
        {"dark", (double)s->dark, true},
        {"outside_time", (double)s->outside_time, true},
        {"other_filter", (double)s->other_filter, true},
        {"without_magnitude", (double)s->without_magnitude, true},
        {"penumbra", (double)s->penumbra, true},
        {"zero_point_mag", s->zero_point, any && s->fitted},
        {"zero_point_sigma_mag", s->zero_point_sigma, any && s->fitted},
        {"mean_mag", s->mean, any},
        {"scatter_mag", s->scatter, any},
        {"rms_mag", s->rms, any},
        {"largest_mag", s->largest, any},
        {"r", s->r, s->has_r},
        {"chi2", s->chi2, s->with_sigma > 0},
        {"chi2_rows", (double)s->with_sigma, s->with_sigma > 0},
        {"chi2_freedom", (double)s->freedom, s->with_sigma > 0},
        {"chi2_relative_mag", s->chi2_relative, any && s->has_chi2_relative},
        {"with_range", (double)s->with_range, s->with_range > 0},
        {"range_mean_km", s->range_mean_m * 1e-3, s->with_range > 0},
        {"range_most_km", s->range_most_m * 1e-3, s->with_range > 0},
        {"with_phase", (double)s->with_phase, s->with_phase > 0},
        {"phase_mean_deg", s->phase_mean_rad * DEGREES, s->with_phase > 0},
        {"phase_most_deg", s->phase_most_rad * DEGREES, s->with_phase > 0},
    };
    for (size_t k = 0; k < N_FACTS; k++)
        out[k] = facts[k];
}

/* --------------------------------------------------------------- for people */

static void people_left_out(const glint_comparison_summary *s, text *t)
{
    const struct {
        int64_t n;
        const char *why;
    } all[] = {{s->eclipsed, "are predicted in the Earth's shadow"},
               {s->not_seen, "are predicted below the horizon"},
               {s->dark, "are predicted dark"},
               {s->outside_time, "lie outside of [time]"},
               {s->other_filter, "have another filter"},
               {s->without_magnitude, "have no magnitude"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        if (all[k].n > 0)
            text_printf(t, "%lld observations %s and are left out\n", (long long)all[k].n,
                        all[k].why);
    if (s->penumbra > 0)
        text_printf(t, "%lld observations were compared in the penumbra\n", (long long)s->penumbra);
}

static void people_numbers(const glint_comparison_summary *s, text *t)
{
    text_printf(t,
                "%lld of %lld observations compared, band %s, magnitudes %s, observed less "
                "predicted\n",
                (long long)s->compared, (long long)s->observations, s->band, s->kind);
    people_left_out(s, t);
    if (s->compared > 0) {
        text_printf(t, "mean %s, scatter %.4f, rms %.4f, largest %s mag\n",
                    number_signed(s->mean, 4).text, s->scatter, s->rms,
                    number_signed(s->largest, 4).text);
        if (s->fitted)
            text_printf(t, "after a zero point of %s +- %.4f mag, which was fitted\n",
                        number_signed(s->zero_point, 4).text, s->zero_point_sigma);
    }
    if (s->has_r) text_printf(t, "Pearson R %s\n", number_fixed(s->r, 4).text);
    if (s->with_sigma > 0)
        text_printf(t, "chi^2 %.4f of %lld rows, %lld degrees of freedom\n", s->chi2,
                    (long long)s->with_sigma, (long long)s->freedom);
    if (s->compared > 0 && s->has_chi2_relative)
        text_printf(t, "mean square over observed magnitude %.4f mag\n", s->chi2_relative);
    if (s->with_range > 0)
        text_printf(t, "range, observed less predicted: mean %s, largest %s km\n",
                    number_signed(s->range_mean_m * 1e-3, 3).text,
                    number_signed(s->range_most_m * 1e-3, 3).text);
    if (s->with_phase > 0)
        text_printf(t, "phase angle, observed less predicted: mean %s, largest %s deg\n",
                    number_signed(s->phase_mean_rad * DEGREES, 3).text,
                    number_signed(s->phase_most_rad * DEGREES, 3).text);
}

static void write_people(const glint_comparison *c, const glint_comparison_summary *s, text *t)
{
    glint_observation o;
    people_numbers(s, t);
    text_printf(t, "\n%-27s %8s %7s %9s %9s %10s %7s  %s\n", "UTC", "observed", "sigma",
                "predicted", "residual", "range km", "phase", "");
    for (size_t k = 0; glint_comparison_get(c, k, &o); k++) {
        add_utc(t, &o.utc);
        text_printf(t, " %8s", number_fixed(o.observed, 3).text);
        if (o.sigma > 0)
            text_printf(t, " %7.3f", o.sigma);
        else
            text_printf(t, " %7s", "-");
        if (o.state == GLINT_COMPARED)
            text_printf(t, " %9s %9s", number_fixed(o.predicted + s->zero_point, 3).text,
                        number_signed(o.residual, 3).text);
        else
            text_printf(t, " %9s %9s", "-", "-");
        text_printf(t, " %10.3f %7.2f%s%s\n", o.range_m * 1e-3, o.phase_rad * DEGREES,
                    o.state == GLINT_COMPARED ? "" : "  ",
                    o.state == GLINT_COMPARED ? "" : glint_observation_state_name(o.state));
    }
}

/* ---------------------------------------------------------------------- CSV */

static const glint_column COLUMNS[] = {
    {"line", "", "of the file of observations", false},
    {"utc", "", "UTC of reception at the observer", true},
    {"t_s", "s", "TT seconds from the start", false},
    {"observed", "mag", "as in the file", false},
    {"sigma", "mag", "as in the file; empty where not said", false},
    {"predicted", "mag", "with the fitted zero point; empty where nothing is predicted", false},
    {"residual", "mag", "observed - predicted", false},
    {"state", "", "compared, eclipsed, not-seen or dark", true},
    {"range_km", "km", "predicted", false},
    {"phase_angle_deg", "deg", "predicted", false},
    {"elevation_deg", "deg", "predicted", false},
    {"sunlit_fraction", "", "predicted", false},
    {"observed_range_km", "km", "as in the file", false},
    {"observed_phase_deg", "deg", "as in the file", false},
};

enum { N_COLUMNS = sizeof COLUMNS / sizeof *COLUMNS };

static void csv_cell(text *t, bool there, double value)
{
    text_char(t, ',');
    if (there) text_double(t, value);
}

static void csv_row(const glint_observation *o, double zero_point, text *t)
{
    const bool compared = o->state == GLINT_COMPARED;
    text_printf(t, "%d,", o->line);
    add_utc(t, &o->utc);
    csv_cell(t, true, o->t_s);
    csv_cell(t, true, o->observed);
    csv_cell(t, o->sigma > 0, o->sigma);
    csv_cell(t, compared, o->predicted + zero_point);
    csv_cell(t, compared, o->residual);
    text_printf(t, ",%s", glint_observation_state_name(o->state));
    csv_cell(t, true, o->range_m * 1e-3);
    csv_cell(t, true, o->phase_rad * DEGREES);
    csv_cell(t, true, o->elevation_rad * DEGREES);
    csv_cell(t, true, o->sunlit_fraction);
    csv_cell(t, o->observed_range_m > 0, o->observed_range_m * 1e-3);
    csv_cell(t, o->observed_phase_rad >= 0, o->observed_phase_rad * DEGREES);
    text_char(t, '\n');
}

static bool fact_of(const void *comparison, size_t k, const char **key, const char **value)
{
    return glint_comparison_fact(comparison, k, key, value);
}

static void csv_facts(const glint_comparison_summary *s, text *t)
{
    fact facts[N_FACTS];
    list_facts(s, facts);
    ecsv_fact(t, "file", s->file);
    ecsv_fact(t, "format", s->format);
    ecsv_fact(t, "magnitude", s->kind);
    ecsv_fact(t, "band", s->band);
    for (size_t k = 0; k < N_FACTS; k++) {
        if (!facts[k].there) continue;
        text number = {0};
        text_double(&number, facts[k].value);
        if (number.failed)
            t->failed = true;
        else
            ecsv_fact(t, facts[k].key, number.data);
        text_free(&number);
    }
}

static void write_csv(const glint_comparison *c, const glint_comparison_summary *s, text *t)
{
    glint_observation o;
    ecsv_begin(t, COLUMNS, N_COLUMNS);
    ecsv_facts(t, fact_of, c);
    csv_facts(s, t);
    ecsv_end(t, COLUMNS, N_COLUMNS);
    for (size_t k = 0; glint_comparison_get(c, k, &o); k++)
        csv_row(&o, s->zero_point, t);
}

/* --------------------------------------------------------------------- JSON */

static void json_row(const glint_observation *o, double zero_point, json *j)
{
    text utc = {0};
    add_utc(&utc, &o->utc);
    json_object(j, NULL);
    json_number(j, "line", o->line);
    if (utc.failed)
        j->out->failed = true;
    else
        json_string(j, "utc", utc.data);
    json_number(j, "t_s", o->t_s);
    json_string(j, "state", glint_observation_state_name(o->state));
    json_number(j, "observed", o->observed);
    if (o->sigma > 0) json_number(j, "sigma", o->sigma);
    if (o->state == GLINT_COMPARED) {
        json_number(j, "predicted", o->predicted + zero_point);
        json_number(j, "residual", o->residual);
    }
    json_number(j, "range_km", o->range_m * 1e-3);
    json_number(j, "phase_angle_deg", o->phase_rad * DEGREES);
    json_number(j, "elevation_deg", o->elevation_rad * DEGREES);
    json_number(j, "sunlit_fraction", o->sunlit_fraction);
    if (o->observed_range_m > 0) json_number(j, "observed_range_km", o->observed_range_m * 1e-3);
    if (o->observed_phase_rad >= 0)
        json_number(j, "observed_phase_deg", o->observed_phase_rad * DEGREES);
    json_end(j, '}');
    text_free(&utc);
}

static void write_json(const glint_comparison *c, const glint_comparison_summary *s, text *t)
{
    fact facts[N_FACTS];
    glint_observation o;
    json j = {.out = t};
    list_facts(s, facts);
    json_object(&j, NULL);
    json_facts(&j, fact_of, c);
    json_string(&j, "file", s->file);
    json_string(&j, "format", s->format);
    json_string(&j, "magnitude", s->kind);
    json_string(&j, "band", s->band);
    for (size_t k = 0; k < N_FACTS; k++)
        if (facts[k].there) json_number(&j, facts[k].key, facts[k].value);
    json_list(&j, "observations_compared");
    for (size_t k = 0; glint_comparison_get(c, k, &o); k++)
        json_row(&o, s->zero_point, &j);
    json_end(&j, ']');
    json_end(&j, '}');
}

glint_status glint_comparison_write(const glint_comparison *c, glint_format format,
                                    const char *path, glint_error *error)
{
    glint_comparison_summary total;
    glint_comparison_total(c, &total);
    text t = {0};
    if (format == GLINT_FORMAT_TABLE)
        write_people(c, &total, &t);
    else if (format == GLINT_FORMAT_CSV)
        write_csv(c, &total, &t);
    else
        write_json(c, &total, &t);
    const glint_status status =
        t.failed ? error_no_memory(error) : glint_text_write(path, t.data, t.length, error);
    text_free(&t);
    return status;
}
