/* passes_table.c: passes as a table for people, as CSV with an ECSV header, as JSON. */
#include "output/ecsv.h"
#include "output/facts.h"
#include "output/file.h"
#include "output/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double DEGREES = 57.295779513082320877; /* per rad */

/* A pass with where it comes from. */
typedef struct listed_pass {
    const glint_passes *of;
    const glint_pass *pass;
    size_t order; /* of the scenario on the command line */
} listed_pass;

static int64_t utc_key(const glint_utc *u)
{
    return ((((u->year * 12LL + u->month) * 31 + u->day) * 24 + u->hour) * 60 + u->minute) * 61 +
           u->second;
}

/* By the first event, to the microsecond, then as the scenarios were given. */
static int pass_order(const void *a, const void *b)
{
    const listed_pass *x = a, *y = b;
    const glint_utc *p = &x->pass->events[0].utc, *q = &y->pass->events[0].utc;
    const int64_t i = utc_key(p), k = utc_key(q);
    if (i != k) return i < k ? -1 : 1;
    if (p->microsecond != q->microsecond) return p->microsecond < q->microsecond ? -1 : 1;
    return (x->order > y->order) - (x->order < y->order);
}

/* All passes in order of time; owned by the caller. NULL when memory is out. */
static listed_pass *merge(const glint_passes *const *passes, size_t n, size_t *n_out)
{
    *n_out = 0;
    for (size_t i = 0; i < n; i++)
        *n_out += glint_passes_count(passes[i]);
    listed_pass *list = calloc(*n_out + 1, sizeof *list);
    if (!list) return NULL;
    size_t at = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < glint_passes_count(passes[i]); k++)
            list[at++] = (listed_pass){passes[i], glint_passes_get(passes[i], k), i};
    if (at > 1) qsort(list, at, sizeof *list, pass_order);
    return list;
}

static const glint_pass_event *event_of(const glint_pass *pass, glint_event_kind kind)
{
    for (size_t k = 0; k < pass->n_events; k++)
        if (pass->events[k].kind == kind) return &pass->events[k];
    return NULL;
}

static void add_utc(text *t, const glint_utc *u)
{
    text_printf(t, "%04d-%02d-%02dT%02d:%02d:%02d.%06dZ", u->year, u->month, u->day, u->hour,
                u->minute, u->second, u->microsecond);
}

/* "19:13:04.5" */
static void add_clock(text *t, const glint_utc *u)
{
    text_printf(t, "%02d:%02d:%02d.%d", u->hour, u->minute, u->second, u->microsecond / 100000);
}

/* --------------------------------------------------------------- for people */

static void add_end(text *t, const glint_pass_event *e, const char *otherwise)
{
    if (!e) {
        text_printf(t, "  %-10s %3s", otherwise, "");
        return;
    }
    text_add(t, "  ");
    add_clock(t, &e->utc);
    text_printf(t, " %3s", glint_compass_point(e->azimuth_rad));
}

static void add_line(text *t, const listed_pass *l)
{
    const glint_pass *p = l->pass;
    const glint_pass_event *top = event_of(p, GLINT_CULMINATION);
    const glint_pass_event *best = event_of(p, GLINT_BRIGHTEST);
    const glint_utc *day = &p->events[0].utc;
    text_printf(t, "%04d-%02d-%02d", day->year, day->month, day->day);
    add_end(t, event_of(p, GLINT_RISE), "up already");
    text_add(t, "  ");
    add_clock(t, &top->utc);
    text_printf(t, " %5s %3s", number_fixed(top->elevation_rad * DEGREES, 1).text,
                glint_compass_point(top->azimuth_rad));
    add_end(t, event_of(p, GLINT_SET), "still up");
    text_add(t, "  ");
    if (best) {
        add_clock(t, &best->utc);
        text_printf(t, " %6s", number_fixed(best->magnitude, 2).text);
    } else {
        text_printf(t, "%-10s %6s", "-", "-");
    }
    text_printf(t, "  %7.0f  %7.0f  %6s  %s%s%s\n", p->sunlit_s, p->dark_site_s,
                number_fixed(top->sun_elevation_rad * DEGREES, 1).text,
                glint_passes_satellite(l->of), p->site[0] ? ", " : "", p->site);
}

/* The time of a note, with its date where that is not the one at the head of the pass. */
static void add_note_time(text *t, const glint_pass *pass, const glint_utc *u)
{
    const glint_utc *head = &pass->events[0].utc;
    if (u->year == head->year && u->month == head->month && u->day == head->day)
        text_printf(t, "%12s", "");
    else
        text_printf(t, "%04d-%02d-%02d  ", u->year, u->month, u->day);
    add_clock(t, u);
}

/* What happens besides: the Earth's shadow, darkness, flashes; and what stands in the pass's own
 * line, but so much later that its time of day does not say which day. */
static void add_note(text *t, const glint_passes *of, const glint_pass *pass,
                     const glint_pass_event *e)
{
    static const double DAY_S = 86400;
    static const char *const LATE_WORDS[] = {
        [GLINT_CULMINATION] = "culmination",
        [GLINT_SET] = "set",
        [GLINT_BRIGHTEST] = "brightest",
    };
    static const char *const WORDS[] = {
        [GLINT_UMBRA_END] = "first sunlight",
        [GLINT_PENUMBRA_END] = "in full sunlight",
        [GLINT_PENUMBRA_BEGIN] = "sunlight fades",
        [GLINT_UMBRA_BEGIN] = "in the Earth's shadow",
        [GLINT_MOON_SHADOW_BEGIN] = "the Moon begins to cover the Sun",
        [GLINT_MOON_SHADOW_END] = "the Moon leaves the Sun",
        [GLINT_DARKNESS_BEGIN] = "the site is dark",
        [GLINT_DARKNESS_END] = "the site is light",
        [GLINT_FLASH] = "flash",
        [GLINT_MORE_FLASHES] = "from here on flashes are left out: too many, or too long a search",
    };
    const char *word = NULL;
    if ((size_t)e->kind < sizeof WORDS / sizeof *WORDS) word = WORDS[e->kind];
    if (!word && (size_t)e->kind < sizeof LATE_WORDS / sizeof *LATE_WORDS &&
        e->t_s - pass->from_s >= DAY_S)
        word = LATE_WORDS[e->kind];
    if (!word) return;
    add_note_time(t, pass, &e->utc);
    text_printf(t, " %3s %5s  %s", glint_compass_point(e->azimuth_rad),
                number_fixed(e->elevation_rad * DEGREES, 1).text, word);
    if (e->kind == GLINT_FLASH) {
        text_printf(t, " of %s (%.3g, %.3g, %.3g) for %.3g s, %.2f deg off", e->component,
                    e->normal[0], e->normal[1], e->normal[2], e->to_s - e->from_s,
                    e->mirror_angle_rad * DEGREES);
        if (e->has_magnitude)
            text_printf(t, ", %s %s", glint_passes_band(of), number_fixed(e->magnitude, 2).text);
        else
            text_add(t, ", hidden");
    }
    text_char(t, '\n');
}

static void write_people(const listed_pass *list, size_t n, text *t)
{
    if (n == 0) {
        text_add(t, "no pass in this time\n");
        return;
    }
    text_add(t,
             "UTC         rise           culmination  deg       set             brightest     mag"
             "   sunlit  in dark     Sun\n"
             "                                                                               "
             "        s        s     deg\n");
    for (size_t k = 0; k < n; k++) {
        const glint_pass *p = list[k].pass;
        add_line(t, &list[k]);
        for (size_t i = 0; i < p->n_events; i++)
            add_note(t, list[k].of, p, &p->events[i]);
    }
}

/* ---------------------------------------------------------------------- CSV */

static const glint_column COLUMNS[] = {
    {"satellite", "", "name of the element set, or title of the scenario", true},
    {"site", "", "name of the observer", true},
    {"pass", "", "number of the pass, from 1, in order of time", false},
    {"event", "", "what happens", true},
    {"utc", "", "UTC of reception at the observer", true},
    {"azimuth_deg", "deg", "from north through east", false},
    {"azimuth_name", "", "point of the compass", true},
    {"elevation_deg", "deg", "geometric, or apparent where the site has refraction", false},
    {"range_km", "km", "observer to satellite", false},
    {"sun_elevation_deg", "deg", "of the Sun at the site, geometric", false},
    {"phase_angle_deg", "deg", "at the satellite, between Sun and observer; 0 is full", false},
    {"sunlit_fraction", "", "visible part of the solar disc, seen from the satellite", false},
    {"site_dark", "", "yes: the Sun is below sun_elevation_max_deg", true},
    {"band", "", "of the magnitude", true},
    {"magnitude", "mag", "empty when dark, or without a satellite", false},
    {"duration_s", "s", "of a flash: while the mirror angle is within the limit", false},
    {"mirror_angle_deg", "deg", "of a flash: from the observer to the mirrored Sun", false},
    {"component", "", "of a flash: what the surface belongs to", true},
    {"normal_x", "", "of the surface, in the component's axes", false},
    {"normal_y", "", "of the surface, in the component's axes", false},
    {"normal_z", "", "of the surface, in the component's axes", false},
};

enum { N_COLUMNS = sizeof COLUMNS / sizeof *COLUMNS };

static void add_cell(text *t, double value)
{
    text_char(t, ',');
    text_double(t, value);
}

static void add_event_row(text *t, const glint_passes *of, const glint_pass *pass, size_t number,
                          const glint_pass_event *e)
{
    ecsv_cell(t, glint_passes_satellite(of));
    text_char(t, ',');
    ecsv_cell(t, pass->site);
    text_printf(t, ",%zu,%s,", number, glint_event_name(e->kind));
    add_utc(t, &e->utc);
    add_cell(t, e->azimuth_rad * DEGREES);
    text_printf(t, ",%s", glint_compass_point(e->azimuth_rad));
    add_cell(t, e->elevation_rad * DEGREES);
    add_cell(t, e->range_m * 1e-3);
    add_cell(t, e->sun_elevation_rad * DEGREES);
    add_cell(t, e->phase_angle_rad * DEGREES);
    add_cell(t, e->sunlit_fraction);
    text_printf(t, ",%s,", e->site_dark ? "yes" : "no");
    if (e->has_magnitude) text_add(t, glint_passes_band(of));
    text_char(t, ',');
    if (e->has_magnitude) text_double(t, e->magnitude);
    if (e->kind == GLINT_FLASH) {
        add_cell(t, e->to_s - e->from_s);
        add_cell(t, e->mirror_angle_rad * DEGREES);
        text_char(t, ',');
        ecsv_cell(t, e->component);
        for (int i = 0; i < 3; i++)
            add_cell(t, e->normal[i]);
    } else {
        text_add(t, ",,,,,,");
    }
    text_char(t, '\n');
}

/* What the header of a table says, of one scenario or of several. */
typedef struct told_fact {
    const char *key, *value; /* borrowed */
} told_fact;

typedef struct header {
    told_fact *items; /* owned */
    size_t n;
} header;

/* Adds the facts with a key, of all scenarios one after the other; once: without those that are
 * there already. */
static void take_facts(header *h, const glint_passes *const *passes, size_t n, const char *wanted,
                       bool once)
{
    const char *key, *value;
    const size_t begun = h->n;
    for (size_t i = 0; i < n; i++)
        for (size_t f = 0; glint_passes_fact(passes[i], f, &key, &value); f++) {
            bool is_new = string_equal(key, wanted);
            for (size_t k = begun; k < h->n && is_new && once; k++)
                is_new = !string_equal(h->items[k].value, value);
            if (is_new) h->items[h->n++] = (told_fact){key, value};
        }
}

/* All that is known of one scenario; of several, what they are and where they come from, what was
 * set, as a rule alike for all, and what holds for all. False when memory is out. */
static bool gather_facts(const glint_passes *const *passes, size_t n, header *out)
{
    static const char *const KEYS[] = {"title", "orbit", "observer", "observers"};
    size_t all = 2;
    told_fact own;
    for (size_t i = 0; i < n; i++)
        for (size_t f = 0; glint_passes_fact(passes[i], f, &own.key, &own.value); f++)
            all++;
    *out = (header){calloc(all, sizeof *out->items), 0};
    if (!out->items) return false;
    if (n == 1) {
        for (; glint_passes_fact(passes[0], out->n, &own.key, &own.value); out->n++)
            out->items[out->n] = own;
        return true;
    }
    out->items[out->n++] = (told_fact){"glint_version", glint_version()};
    out->items[out->n++] = (told_fact){"time_scale", "utc is the reception at the observer"};
    take_facts(out, passes, n, "scenario_hash", false);
    take_facts(out, passes, n, "set", true);
    for (size_t k = 0; k < sizeof KEYS / sizeof *KEYS; k++)
        take_facts(out, passes, n, KEYS[k], false);
    return true;
}

static bool fact_of(const void *of, size_t k, const char **key, const char **value)
{
    const header *h = of;
    if (k >= h->n) return false;
    *key = h->items[k].key;
    *value = h->items[k].value;
    return true;
}

static void write_csv(const listed_pass *list, size_t n, const header *facts, text *t)
{
    ecsv_begin(t, COLUMNS, N_COLUMNS);
    ecsv_facts(t, fact_of, facts);
    ecsv_end(t, COLUMNS, N_COLUMNS);
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < list[k].pass->n_events; i++)
            add_event_row(t, list[k].of, list[k].pass, k + 1, &list[k].pass->events[i]);
}

/* --------------------------------------------------------------------- JSON */

static void add_json_utc(json *j, const char *key, const glint_utc *utc)
{
    text t = {0};
    add_utc(&t, utc);
    if (t.failed)
        j->out->failed = true;
    else
        json_string(j, key, t.data);
    text_free(&t);
}

static void add_json_event(json *j, const glint_passes *of, const glint_pass_event *e)
{
    json_object(j, NULL);
    json_string(j, "event", glint_event_name(e->kind));
    add_json_utc(j, "utc", &e->utc);
    json_number(j, "azimuth_deg", e->azimuth_rad * DEGREES);
    json_string(j, "azimuth_name", glint_compass_point(e->azimuth_rad));
    json_number(j, "elevation_deg", e->elevation_rad * DEGREES);
    json_number(j, "range_km", e->range_m * 1e-3);
    json_number(j, "sun_elevation_deg", e->sun_elevation_rad * DEGREES);
    json_number(j, "phase_angle_deg", e->phase_angle_rad * DEGREES);
    json_number(j, "sunlit_fraction", e->sunlit_fraction);
    json_bool(j, "site_dark", e->site_dark);
    if (e->has_magnitude) {
        json_string(j, "band", glint_passes_band(of));
        json_number(j, "magnitude", e->magnitude);
    }
    if (e->kind == GLINT_FLASH) {
        json_number(j, "duration_s", e->to_s - e->from_s);
        json_number(j, "mirror_angle_deg", e->mirror_angle_rad * DEGREES);
        json_string(j, "component", e->component);
        json_list(j, "normal");
        for (int i = 0; i < 3; i++)
            json_number(j, NULL, e->normal[i]);
        json_end(j, ']');
    }
    json_end(j, '}');
}

static void write_json(const listed_pass *list, size_t n, const header *facts, text *t)
{
    json j = {.out = t};
    json_object(&j, NULL);
    json_facts(&j, fact_of, facts);
    json_list(&j, "passes");
    for (size_t k = 0; k < n; k++) {
        const glint_pass *p = list[k].pass;
        json_object(&j, NULL);
        json_string(&j, "satellite", glint_passes_satellite(list[k].of));
        json_string(&j, "site", p->site);
        json_bool(&j, "up_at_start", p->up_at_start);
        json_bool(&j, "up_at_end", p->up_at_end);
        json_number(&j, "sunlit_s", p->sunlit_s);
        json_number(&j, "dark_site_s", p->dark_site_s);
        json_bool(&j, "more_flashes", p->more_flashes);
        json_list(&j, "events");
        for (size_t i = 0; i < p->n_events; i++)
            add_json_event(&j, list[k].of, &p->events[i]);
        json_end(&j, ']');
        json_end(&j, '}');
    }
    json_end(&j, ']');
    json_end(&j, '}');
}

glint_status glint_passes_write(const glint_passes *const *passes, size_t n, glint_format format,
                                const char *path, glint_error *error)
{
    size_t n_list;
    for (size_t k = 0; path && k < n; k++)
        if (glint_passes_reads(passes[k], path)) return out_file_is_input(path, error);
    listed_pass *list = merge(passes, n, &n_list);
    if (!list) return error_no_memory(error);
    header facts;
    if (!gather_facts(passes, n, &facts)) {
        free(list);
        return error_no_memory(error);
    }
    text t = {0};
    switch (format) {
    case GLINT_FORMAT_TABLE:
        write_people(list, n_list, &t);
        break;
    case GLINT_FORMAT_CSV:
        write_csv(list, n_list, &facts, &t);
        break;
    case GLINT_FORMAT_JSON:
        write_json(list, n_list, &facts, &t);
        break;
    }
    free(facts.items);
    free(list);
    const glint_status status =
        t.failed ? error_no_memory(error) : glint_text_write(path, t.data, t.length, error);
    text_free(&t);
    return status;
}
