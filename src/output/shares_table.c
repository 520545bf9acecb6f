/* shares_table.c: shares as a table for people, as CSV with an ECSV header, as JSON, as a picture.
 */
#include "output/curve_plot.h"
#include "output/ecsv.h"
#include "output/facts.h"
#include "output/json.h"
#include "output/plot.h"

#include <stdlib.h>
#include <string.h>

static const char *const KIND_NAMES[] = {[GLINT_SHARE_MATERIAL] = "material",
                                         [GLINT_SHARE_COMPONENT] = "component",
                                         [GLINT_SHARE_SURFACE] = "surface"};
enum { N_KINDS = sizeof KIND_NAMES / sizeof *KIND_NAMES };

/* One row: a share, and the same after the changes. */
typedef struct share_pair {
    bool before, after; /* there is one */
    glint_share plain, changed;
} share_pair;

/* All rows of one kind. */
typedef struct pair_list {
    share_pair *items; /* owned */
    size_t n;
} pair_list;

static size_t count_of(const glint_shares *shares, bool changed, glint_share_kind kind)
{
    glint_share share;
    size_t n = 0;
    while (glint_shares_get(shares, changed, kind, n, &share))
        n++;
    return n;
}

/* Puts what changes brought to what was there before: by name. A material may be new. */
static void add_changed(pair_list *list, const glint_share *share)
{
    size_t k = 0;
    while (k < list->n && !string_equal(list->items[k].plain.name, share->name))
        k++;
    share_pair *pair = &list->items[k];
    if (k == list->n) {
        list->n++;
        *pair = (share_pair){.plain = *share};
        pair->plain.area_m2 = 0;
    }
    pair->after = true;
    pair->changed = *share;
}

/* Surfaces are the same in both, and two may have one name. */
static void pair_surfaces(const glint_shares *shares, pair_list *list)
{
    for (size_t k = 0; k < list->n; k++)
        list->items[k].after =
            glint_shares_get(shares, true, GLINT_SHARE_SURFACE, k, &list->items[k].changed);
}

static bool pairs_of(const glint_shares *shares, glint_share_kind kind, pair_list *out)
{
    const size_t most = count_of(shares, false, kind) + count_of(shares, true, kind);
    glint_share share;
    *out = (pair_list){calloc(most + 1, sizeof *out->items), 0};
    if (!out->items) return false;
    while (glint_shares_get(shares, false, kind, out->n, &share))
        out->items[out->n++] = (share_pair){.before = true, .plain = share};
    if (kind == GLINT_SHARE_SURFACE)
        pair_surfaces(shares, out);
    else
        for (size_t k = 0; glint_shares_get(shares, true, kind, k, &share); k++)
            add_changed(out, &share);
    return true;
}

static void add_moment(text *t, glint_shares_total whole)
{
    const glint_utc *u = &whole.peak_utc;
    if (whole.has_utc)
        text_printf(t, "%04d-%02d-%02dT%02d:%02d:%02d.%06dZ", u->year, u->month, u->day, u->hour,
                    u->minute, u->second, u->microsecond);
    else
        text_printf(t, "t_s = %.10g", whole.peak_t_s);
}

/* --------------------------------------------------------------- for people */

/* "bus/mli=white-paint, without wing-north" */
static void list_changes(const glint_shares *shares, text *t)
{
    const char *key, *value;
    bool any = false;
    for (size_t k = 0; glint_shares_fact(shares, k, &key, &value); k++) {
        const bool away = string_equal(key, "without");
        if (!away && !string_equal(key, "swap")) continue;
        text_printf(t, "%s%s%s", any ? ", " : "", away ? "without " : "", value);
        any = true;
    }
}

static void people_whole(const glint_shares *shares, bool changed, text *t)
{
    glint_shares_total whole;
    if (!glint_shares_whole(shares, changed, &whole)) return;
    if (changed) {
        text_add(t, "changed (");
        list_changes(shares, t);
        text_add(t, "): ");
    }
    text_printf(t, "light in %lld of %lld rows", (long long)whole.bright_rows,
                (long long)whole.rows);
    if (whole.bright_rows > 0) {
        text_printf(t, "; %s: mean %s, median %s, brightest %s at ", whole.band,
                    number_fixed(whole.magnitude_mean, 3).text,
                    number_fixed(whole.magnitude_median, 3).text,
                    number_fixed(whole.magnitude_peak, 3).text);
        add_moment(t, whole);
    }
    text_char(t, '\n');
}

static void people_difference(const glint_shares *shares, text *t)
{
    glint_shares_change d;
    if (!glint_shares_difference(shares, &d)) return;
    if (d.rows > 0) {
        text_printf(t,
                    "changed less given, mag: mean %s, median %s, least %s, most %s; "
                    "brightest row %s",
                    number_signed(d.mean, 3).text, number_signed(d.median, 3).text,
                    number_signed(d.min, 3).text, number_signed(d.max, 3).text,
                    number_signed(d.peak, 3).text);
        if (d.has_peak)
            text_printf(t, "; at the brightest moment %s", number_signed(d.at_peak, 3).text);
        text_char(t, '\n');
    }
    if (d.lost > 0)
        text_printf(t, "%lld rows lose all their light by the changes\n", (long long)d.lost);
    if (d.gained > 0) text_printf(t, "%lld rows get light by the changes\n", (long long)d.gained);
}

/* The larger share first; equal ones stay as they came. */
static int by_share(const void *a, const void *b)
{
    const share_pair *x = a, *y = b;
    const double p = x->before ? x->plain.share_mean : -1, q = y->before ? y->plain.share_mean : -1;
    if (p != q) return p > q ? -1 : 1;
    return strcmp(x->plain.name, y->plain.name);
}

static void people_numbers(const glint_share *share, bool there, text *t)
{
    if (!there || share->area_m2 == 0)
        text_printf(t, " %8s %8s %8s %8s %9s", "-", "-", "-", "-", "-");
    else if (share->rows == 0)
        text_printf(t, " %8.4f %8.4f %7.1f%% %8s %9.4g", 0.0, 0.0, 0.0, "-", share->area_m2);
    else
        text_printf(t, " %8.4f %8.4f %7.1f%% %8s %9.4g", share->share_mean, share->share_peak,
                    100 * share->dominant_fraction, number_fixed(share->magnitude_mean, 3).text,
                    share->area_m2);
}

static void people_row(const share_pair *pair, bool with_changes, int width, text *t)
{
    const glint_share *a = &pair->plain, *b = &pair->changed;
    text_printf(t, "  %-*s", width, a->name);
    people_numbers(a, pair->before, t);
    if (with_changes) {
        text_add(t, "  |");
        people_numbers(b, pair->after, t);
        if (pair->before && pair->after && a->rows > 0 && b->rows > 0)
            text_printf(t, " %8s", number_signed(b->magnitude_mean - a->magnitude_mean, 3).text);
        if (pair->before && pair->after && !string_equal(a->material, b->material))
            text_printf(t, "  %s", b->material);
    }
    text_char(t, '\n');
}

static void people_kind(pair_list *list, int kind, bool with_changes, int width, text *t)
{
    if (list->n > 1) qsort(list->items, list->n, sizeof *list->items, by_share);
    static const char *const HEADS[] = {"materials", "components", "surfaces"};
    text_printf(t, "\n%-*s    share  at peak dominant    alone      area", width + 2, HEADS[kind]);
    if (with_changes) text_add(t, "  |    share  at peak dominant    alone      area   change");
    text_printf(t, "\n%-*s                                   mag       m^2", width + 2, "");
    if (with_changes) text_add(t, "  |                                   mag       m^2      mag");
    text_char(t, '\n');
    for (size_t k = 0; k < list->n; k++)
        people_row(&list->items[k], with_changes, width, t);
}

static int longest_name(const pair_list lists[N_KINDS])
{
    size_t longest = 12;
    for (int kind = 0; kind < N_KINDS; kind++)
        for (size_t k = 0; k < lists[kind].n; k++) {
            const size_t n = strlen(lists[kind].items[k].plain.name);
            if (n > longest) longest = n;
        }
    return longest < 60 ? (int)longest : 60;
}

static void write_people(const glint_shares *shares, pair_list lists[N_KINDS], text *t)
{
    glint_shares_change d;
    const bool with_changes = glint_shares_difference(shares, &d);
    const int width = longest_name(lists);
    people_whole(shares, false, t);
    people_whole(shares, true, t);
    people_difference(shares, t);
    for (int kind = 0; kind < N_KINDS; kind++)
        people_kind(&lists[kind], kind, with_changes, width, t);
}

/* ---------------------------------------------------------------------- CSV */

static const glint_column COLUMNS[] = {
    {"kind", "", "material, component or surface", true},
    {"name", "", "of a surface: component/material/where it faces, in the component's axes", true},
    {"component", "", "of a component or a surface", true},
    {"material", "", "of a material or a surface", true},
    {"facing", "", "of a surface: an axis, a direction, or round", true},
    {"area_m2", "m^2", "", false},
    {"share_mean", "", "part of all light of the rows, first band", false},
    {"share_peak", "", "part of the light at the brightest row", false},
    {"dominant_fraction", "", "part of the rows with light in which it is the largest of its kind",
     false},
    {"rows", "", "with any light of it", false},
    {"magnitude_mean", "mag", "mean over those rows of its magnitude alone", false},
    {"changed_material", "", "of the changed satellite", true},
    {"changed_area_m2", "m^2", "of the changed satellite", false},
    {"changed_share_mean", "", "of the changed satellite", false},
    {"changed_share_peak", "", "of the changed satellite, at its own brightest row", false},
    {"changed_dominant_fraction", "", "of the changed satellite", false},
    {"changed_rows", "", "of the changed satellite", false},
    {"changed_magnitude_mean", "mag", "of the changed satellite", false},
};

enum { N_COLUMNS = sizeof COLUMNS / sizeof *COLUMNS, N_PLAIN_COLUMNS = 11 };

static void csv_fact(text *t, const char *key, double value)
{
    text number = {0};
    text_double(&number, value);
    if (number.failed)
        t->failed = true;
    else
        ecsv_fact(t, key, number.data);
    text_free(&number);
}

static void csv_whole(const glint_shares *shares, bool changed, text *t)
{
    glint_shares_total whole;
    if (!glint_shares_whole(shares, changed, &whole)) return;
    if (!changed) {
        ecsv_fact(t, "band", whole.band);
        csv_fact(t, "rows", (double)whole.rows);
    }
    csv_fact(t, changed ? "changed_bright_rows" : "bright_rows", (double)whole.bright_rows);
    if (whole.bright_rows == 0) return;
    csv_fact(t, changed ? "changed_magnitude_mean" : "magnitude_mean", whole.magnitude_mean);
    csv_fact(t, changed ? "changed_magnitude_median" : "magnitude_median", whole.magnitude_median);
    csv_fact(t, changed ? "changed_magnitude_peak" : "magnitude_peak", whole.magnitude_peak);
    text moment = {0};
    add_moment(&moment, whole);
    if (moment.failed)
        t->failed = true;
    else
        ecsv_fact(t, changed ? "changed_peak" : "peak", moment.data);
    text_free(&moment);
}

static void csv_difference(const glint_shares *shares, text *t)
{
    glint_shares_change d;
    if (!glint_shares_difference(shares, &d)) return;
    csv_fact(t, "difference_rows", (double)d.rows);
    csv_fact(t, "difference_lost", (double)d.lost);
    csv_fact(t, "difference_gained", (double)d.gained);
    if (d.has_peak) csv_fact(t, "difference_at_peak", d.at_peak);
    if (d.rows == 0) return;
    csv_fact(t, "difference_mean", d.mean);
    csv_fact(t, "difference_median", d.median);
    csv_fact(t, "difference_min", d.min);
    csv_fact(t, "difference_max", d.max);
    csv_fact(t, "difference_of_peaks", d.peak);
}

static void csv_number(text *t, double value)
{
    text_char(t, ',');
    text_double(t, value);
}

static void csv_numbers(const glint_share *share, bool there, text *t)
{
    if (!there || share->area_m2 == 0) {
        text_add(t, ",0,,,,,");
        return;
    }
    csv_number(t, share->area_m2);
    csv_number(t, share->share_mean);
    csv_number(t, share->share_peak);
    csv_number(t, share->dominant_fraction);
    csv_number(t, (double)share->rows);
    text_char(t, ',');
    if (share->rows > 0) text_double(t, share->magnitude_mean);
}

static void csv_row(const share_pair *pair, int kind, bool with_changes, text *t)
{
    const glint_share *a = &pair->plain;
    const char *const names[] = {KIND_NAMES[kind], a->name, a->component, a->material, a->facing};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        if (k) text_char(t, ',');
        ecsv_cell(t, names[k]);
    }
    csv_numbers(a, pair->before, t);
    if (with_changes) {
        text_char(t, ',');
        ecsv_cell(t, pair->after ? pair->changed.material : "");
        csv_numbers(&pair->changed, pair->after, t);
    }
    text_char(t, '\n');
}

static bool fact_of(const void *shares, size_t k, const char **key, const char **value)
{
    return glint_shares_fact(shares, k, key, value);
}

static void write_csv(const glint_shares *shares, const pair_list lists[N_KINDS], text *t)
{
    glint_shares_change d;
    const bool with_changes = glint_shares_difference(shares, &d);
    const size_t n_columns = with_changes ? N_COLUMNS : N_PLAIN_COLUMNS;
    ecsv_begin(t, COLUMNS, n_columns);
    ecsv_facts(t, fact_of, shares);
    csv_whole(shares, false, t);
    csv_whole(shares, true, t);
    csv_difference(shares, t);
    ecsv_end(t, COLUMNS, n_columns);
    for (int kind = 0; kind < N_KINDS; kind++)
        for (size_t k = 0; k < lists[kind].n; k++)
            csv_row(&lists[kind].items[k], kind, with_changes, t);
}

/* --------------------------------------------------------------------- JSON */

static void json_whole(const glint_shares *shares, bool changed, json *j)
{
    glint_shares_total whole;
    if (!glint_shares_whole(shares, changed, &whole)) return;
    json_object(j, changed ? "changed" : "given");
    json_number(j, "rows", (double)whole.rows);
    json_number(j, "bright_rows", (double)whole.bright_rows);
    if (whole.bright_rows > 0) {
        json_number(j, "magnitude_mean", whole.magnitude_mean);
        json_number(j, "magnitude_median", whole.magnitude_median);
        json_number(j, "magnitude_peak", whole.magnitude_peak);
        json_number(j, "peak_t_s", whole.peak_t_s);
        text moment = {0};
        add_moment(&moment, whole);
        if (moment.failed) j->out->failed = true;
        if (whole.has_utc && !moment.failed) json_string(j, "peak_utc", moment.data);
        text_free(&moment);
    }
    json_end(j, '}');
}

static void json_difference(const glint_shares *shares, json *j)
{
    glint_shares_change d;
    if (!glint_shares_difference(shares, &d)) return;
    json_object(j, "difference");
    json_number(j, "rows", (double)d.rows);
    json_number(j, "lost", (double)d.lost);
    json_number(j, "gained", (double)d.gained);
    if (d.has_peak) json_number(j, "at_peak", d.at_peak);
    if (d.rows > 0) {
        json_number(j, "mean", d.mean);
        json_number(j, "median", d.median);
        json_number(j, "min", d.min);
        json_number(j, "max", d.max);
        json_number(j, "of_peaks", d.peak);
    }
    json_end(j, '}');
}

static void json_share(const glint_share *share, const char *key, json *j)
{
    json_object(j, key);
    if (share->material[0]) json_string(j, "material", share->material);
    json_number(j, "area_m2", share->area_m2);
    json_number(j, "share_mean", share->share_mean);
    json_number(j, "share_peak", share->share_peak);
    json_number(j, "dominant_fraction", share->dominant_fraction);
    json_number(j, "rows", (double)share->rows);
    if (share->rows > 0) json_number(j, "magnitude_mean", share->magnitude_mean);
    json_end(j, '}');
}

static void json_row(const share_pair *pair, int kind, json *j)
{
    json_object(j, NULL);
    json_string(j, "kind", KIND_NAMES[kind]);
    json_string(j, "name", pair->plain.name);
    if (pair->plain.component[0]) json_string(j, "component", pair->plain.component);
    if (pair->plain.facing[0]) json_string(j, "facing", pair->plain.facing);
    if (pair->before) json_share(&pair->plain, "given", j);
    if (pair->after) json_share(&pair->changed, "changed", j);
    json_end(j, '}');
}

static void write_json(const glint_shares *shares, const pair_list lists[N_KINDS], text *t)
{
    glint_shares_total whole;
    glint_shares_whole(shares, false, &whole);
    json j = {.out = t};
    json_object(&j, NULL);
    json_facts(&j, fact_of, shares);
    json_string(&j, "band", whole.band);
    json_whole(shares, false, &j);
    json_whole(shares, true, &j);
    json_difference(shares, &j);
    json_list(&j, "shares");
    for (int kind = 0; kind < N_KINDS; kind++)
        for (size_t k = 0; k < lists[kind].n; k++)
            json_row(&lists[kind].items[k], kind, &j);
    json_end(&j, ']');
    json_end(&j, '}');
}

glint_status glint_shares_write(const glint_shares *shares, glint_format format, const char *path,
                                glint_error *error)
{
    pair_list lists[N_KINDS] = {0};
    text t = {0};
    bool good = true;
    for (int kind = 0; kind < N_KINDS; kind++)
        good = pairs_of(shares, (glint_share_kind)kind, &lists[kind]) && good;
    if (good && format == GLINT_FORMAT_TABLE)
        write_people(shares, lists, &t);
    else if (good && format == GLINT_FORMAT_CSV)
        write_csv(shares, lists, &t);
    else if (good)
        write_json(shares, lists, &t);
    const glint_status status = !good || t.failed ? error_no_memory(error)
                                                  : glint_text_write(path, t.data, t.length, error);
    for (int kind = 0; kind < N_KINDS; kind++)
        free(lists[kind].items);
    text_free(&t);
    return status;
}

/* ------------------------------------------------------------------ picture */

/* Runs a scenario into a picture. *curve must outlive it, and is the caller's in any case. */
static glint_status draw_curve(const glint_scenario *s, int threads, glint_curve **curve,
                               curve_plot **picture, glint_error *error)
{
    glint_errors *errors = glint_errors_new();
    glint_status status = glint_curve_open(s, threads, curve, errors);
    const glint_error *first = glint_errors_get(errors, 0);
    if (status && error && first) *error = *first;
    glint_errors_free(errors);
    if (status) return status;
    if (glint_curve_observers(*curve) > 1)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "a picture shows the curve of one observer, and there are %zu; expected a "
                         "scenario of one, or no picture",
                         glint_curve_observers(*curve));
    *picture = curve_plot_start(*curve);
    if (!*picture) return error_no_memory(error);
    for (;;) {
        const glint_row *rows;
        size_t n;
        status = glint_curve_next(*curve, &rows, &n, error);
        if (status || n == 0) return status;
        curve_plot_add(*picture, rows, n);
    }
}

glint_status glint_shares_plot(const glint_shares *shares, int threads, const char *path,
                               glint_error *error)
{
    enum { GIVEN, CHANGED };
    plot *file;
    glint_curve *curves[2] = {NULL, NULL};
    curve_plot *pictures[2] = {NULL, NULL};
    text script = {0}, note = {0};
    const bool has_changes = glint_shares_scenario(shares, true) != NULL;
    glint_status status = plot_open(path, &file, error);
    for (int k = GIVEN; k <= has_changes && !status; k++)
        status = draw_curve(glint_shares_scenario(shares, k == CHANGED), threads, &curves[k],
                            &pictures[k], error);
    list_changes(shares, &note);
    if (!status && has_changes)
        curve_plot_compare(pictures[CHANGED], pictures[GIVEN], note.data ? note.data : "");
    if (!status) {
        curve_plot_write(pictures[has_changes], &script);
        if (script.failed || note.failed) status = error_no_memory(error);
    }
    if (status)
        plot_abandon(file);
    else
        status = plot_finish(file, script.data, script.length, error);
    text_free(&script);
    text_free(&note);
    for (int k = GIVEN; k <= CHANGED; k++) {
        curve_plot_free(pictures[k]);
        glint_curve_close(curves[k]);
    }
    return status;
}
