#include "output/curve_plot.h"

#include "output/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Long curves are kept as the brightest and the faintest row of each of so many stretches, two to a
 * pixel: flashes stay, and the picture looks as if all rows were drawn. */
enum { MOST_STRETCHES = 2000 };

/* Where a row may stand on the axis. */
typedef struct spot {
    double
        time_s; /* of UTC since 1970, without leap seconds; from the start where there is no UTC */
    double phase_deg; /* phase angle */
} spot;

/* The brightest and the faintest row of a stretch, in one band. */
typedef struct extremes {
    bool any; /* some row has a magnitude */
    spot bright_at, faint_at;
    double bright_mag, faint_mag;
} extremes;

/* Kinds of shares, a panel each. */
enum { BY_MATERIAL, BY_COMPONENT, BY_SURFACE, N_KINDS };
static const char *const PREFIXES[N_KINDS] = {"share_material_", "share_component_",
                                              "share_surface_"};
/* What axes say: where surfaces are drawn, panels have no room for more. */
static const char *const SHARE_OF[N_KINDS] = {"material share", "component share", ""};
static const char *const NAMES_OF[N_KINDS] = {"materials", "components", "surfaces"};

static const char MAGNITUDE[] = "mag_", FLUX[] = "flux_ratio_";

#define OTHERS SIZE_MAX

struct curve_plot {
    const glint_curve *curve; /* borrowed */
    bool has_utc;
    double step_s;           /* of time; 0 where rows are counted */
    int64_t stride, n_added; /* steps of a stretch; rows so far */
    spot first, last;        /* row so far */
    double from_s, to_s;     /* the earliest and the latest time so far */
    bool waxing, waning;     /* the phase angle has only grown so far, or only fallen */
    size_t n_stretches, n_bands, n_shares;
    size_t *band_columns;  /* owned */
    size_t *share_columns; /* owned; OTHERS: several together */
    int *share_kinds;      /* owned; of each share */
    size_t *slots;         /* owned; where a share goes when a panel has no room for all */
    size_t n_others[N_KINDS], others_slot[N_KINDS]; /* shares that are drawn together, and where */
    double *sums;                                   /* owned; n_shares: scratch */
    extremes *extremes;                             /* owned; n_stretches x n_bands */
    double *flux;            /* owned; n_stretches: sum over the rows of the first band's */
    double *shares;          /* owned; n_stretches x n_shares: sum of share times flux */
    const curve_plot *given; /* borrowed; of curve_plot_compare */
    const char *note;        /* borrowed */
};

static bool begins(const char *string, const char *prefix)
{
    return strncmp(string, prefix, strlen(prefix)) == 0;
}

/* Finds the columns that are drawn: of a band, those of its magnitude and its flux ratio have the
 * same ending. */
static void find_columns(curve_plot *p, const glint_column *columns, size_t n)
{
    for (size_t c = 0; c < n; c++)
        for (size_t f = 0; f < n && begins(columns[c].name, MAGNITUDE); f++)
            if (begins(columns[f].name, FLUX) &&
                string_equal(columns[c].name + strlen(MAGNITUDE), columns[f].name + strlen(FLUX)))
                p->band_columns[p->n_bands++] = c;
    for (int kind = 0; kind < N_KINDS; kind++)
        for (size_t c = 0; c < n; c++)
            if (begins(columns[c].name, PREFIXES[kind])) {
                p->share_kinds[p->n_shares] = kind;
                p->share_columns[p->n_shares++] = c;
            }
}

curve_plot *curve_plot_start(const glint_curve *curve)
{
    size_t n;
    const glint_column *columns = glint_curve_columns(curve, &n);
    const int64_t length = glint_curve_length(curve);
    curve_plot *p = calloc(1, sizeof *p);
    if (!p) return NULL;
    p->curve = curve;
    p->waxing = p->waning = true;
    p->has_utc = n > 0 && string_equal(columns[0].name, "utc");
    p->step_s = glint_curve_step_s(curve);
    p->stride = length > MOST_STRETCHES ? (length + MOST_STRETCHES - 1) / MOST_STRETCHES : 1;
    p->n_stretches = (size_t)((length + p->stride - 1) / p->stride) + 1;
    p->band_columns = calloc(n + 1, sizeof *p->band_columns);
    p->share_columns = calloc(n + 1, sizeof *p->share_columns);
    p->share_kinds = calloc(n + 1, sizeof *p->share_kinds);
    p->slots = calloc(n + 1, sizeof *p->slots);
    p->sums = calloc(n + 1, sizeof *p->sums);
    if (p->band_columns && p->share_columns && p->share_kinds) find_columns(p, columns, n);
    p->extremes = calloc(p->n_stretches * (p->n_bands + 1), sizeof *p->extremes);
    p->flux = calloc(p->n_stretches, sizeof *p->flux);
    p->shares = calloc(p->n_stretches * (p->n_shares + 1), sizeof *p->shares);
    if (p->band_columns && p->share_columns && p->share_kinds && p->slots && p->sums &&
        p->extremes && p->flux && p->shares)
        return p;
    curve_plot_free(p);
    return NULL;
}

void curve_plot_free(curve_plot *p)
{
    if (!p) return;
    free(p->band_columns);
    free(p->share_columns);
    free(p->share_kinds);
    free(p->slots);
    free(p->sums);
    free(p->extremes);
    free(p->flux);
    free(p->shares);
    free(p);
}

void curve_plot_compare(curve_plot *p, const curve_plot *given, const char *note)
{
    p->given = given;
    p->note = note;
}

static spot spot_of(const curve_plot *p, const glint_row *row)
{
    static const double DEG = 57.295779513082321; /* per rad */
    return (spot){p->has_utc ? plot_utc_s(&row->utc) : row->t_s, row->phase_angle_rad * DEG};
}

static void add_magnitude(extremes *e, spot at, double mag)
{
    if (!e->any || mag < e->bright_mag) {
        e->bright_at = at;
        e->bright_mag = mag;
    }
    if (!e->any || mag > e->faint_mag) {
        e->faint_at = at;
        e->faint_mag = mag;
    }
    e->any = true;
}

static void add_spot(curve_plot *p, spot at)
{
    if (p->n_added > 0) {
        p->waxing = p->waxing && at.phase_deg > p->last.phase_deg;
        p->waning = p->waning && at.phase_deg < p->last.phase_deg;
    } else {
        p->first = at;
        p->from_s = p->to_s = at.time_s;
    }
    p->from_s = fmin(p->from_s, at.time_s);
    p->to_s = fmax(p->to_s, at.time_s);
    p->last = at;
    p->n_added++;
}

void curve_plot_add(curve_plot *p, const glint_row *rows, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        const glint_row *row = &rows[k];
        const int64_t step = p->step_s > 0 ? llround(row->t_s / p->step_s) : p->n_added;
        const int64_t end = (int64_t)p->n_stretches - 1;
        const int64_t at = step / p->stride < end ? step / p->stride : end;
        const spot here = spot_of(p, row);
        double value;
        add_spot(p, here);
        for (size_t b = 0; b < p->n_bands; b++)
            if (glint_curve_value(p->curve, row, p->band_columns[b], &value))
                add_magnitude(&p->extremes[(size_t)at * p->n_bands + b], here, value);
        p->flux[at] += row->flux_ratio[0];
        for (size_t s = 0; s < p->n_shares; s++)
            if (glint_curve_value(p->curve, row, p->share_columns[s], &value))
                p->shares[(size_t)at * p->n_shares + s] += value * row->flux_ratio[0];
    }
}

/* ---------------------------------------------------------------------- data */

/* Directions that are given are drawn over the phase angle where it orders them: a sweep. */
static bool is_over_phase(const curve_plot *p)
{
    return !p->has_utc && p->n_added > 1 && (p->waxing || p->waning);
}

static double x_of(const curve_plot *p, spot at)
{
    return is_over_phase(p) ? at.phase_deg : at.time_s;
}

/* The range of the axis. */
static void find_range(const curve_plot *p, double *from, double *to)
{
    const bool over_phase = is_over_phase(p);
    *from = over_phase ? fmin(p->first.phase_deg, p->last.phase_deg) : p->from_s;
    *to = over_phase ? fmax(p->first.phase_deg, p->last.phase_deg) : p->to_s;
}

/* From one stretch to the next on the axis, about; where there is one row alone, some width. */
static double width_of_stretch(const curve_plot *p)
{
    double from, to, step = 1;
    find_range(p, &from, &to);
    if (p->step_s > 0)
        step = p->step_s;
    else if (from < to)
        step = (to - from) / (double)(p->n_added - 1);
    return step * (double)p->stride;
}

static void write_point(text *t, double x, double y)
{
    text_printf(t, "%.6f %.5f\n", x, y);
}

/* True when neither neighbour has a magnitude, so that no line leads to this stretch. */
static bool is_alone(const curve_plot *p, size_t band, size_t at)
{
    const extremes *e = &p->extremes[at * p->n_bands + band];
    return (at == 0 || !e[-(ptrdiff_t)p->n_bands].any) &&
           (at + 1 == p->n_stretches || !e[p->n_bands].any);
}

/* The two points of a stretch, in the order of time. */
static void write_extremes(const curve_plot *p, const extremes *e, text *t)
{
    const bool bright_first = e->bright_at.time_s < e->faint_at.time_s;
    const spot first = bright_first ? e->bright_at : e->faint_at;
    const spot second = bright_first ? e->faint_at : e->bright_at;
    write_point(t, x_of(p, first), bright_first ? e->bright_mag : e->faint_mag);
    if (first.time_s < second.time_s)
        write_point(t, x_of(p, second), bright_first ? e->faint_mag : e->bright_mag);
}

/* The points of one band: a blank line where the curve is interrupted. Single ones go to a second
 * block. Returns false when there are none. */
static bool write_band(const curve_plot *p, size_t band, const char *lines, const char *single,
                       text *t)
{
    bool any = false, gap = false;
    text dots = {0};
    text_printf(t, "$%s%zu << end\n", lines, band);
    for (size_t at = 0; at < p->n_stretches; at++) {
        const extremes *e = &p->extremes[at * p->n_bands + band];
        gap = gap || !e->any;
        if (!e->any) continue;
        if (gap && any) text_char(t, '\n');
        if (is_alone(p, band, at)) write_point(&dots, x_of(p, e->bright_at), e->bright_mag);
        write_extremes(p, e, t);
        any = true;
        gap = false;
    }
    text_printf(t, "end\n$%s%zu << end\n", single, band);
    text_append(t, dots.data, dots.length);
    text_add(t, dots.length ? "end\n" : "NaN NaN\nend\n");
    t->failed = t->failed || dots.failed;
    text_free(&dots);
    return any;
}

/* The middle of a stretch on the axis. */
static double middle_of(const curve_plot *p, size_t at)
{
    const extremes *e = &p->extremes[at * p->n_bands];
    return 0.5 * (x_of(p, e->bright_at) + x_of(p, e->faint_at));
}

/* One line of cumulated shares of a kind: x, 0, s1, s1 + s2, ... */
static void write_stack(const curve_plot *p, size_t first, size_t n, size_t at, double x, text *t)
{
    double sum = 0;
    text_printf(t, "%.6f 0", x);
    for (size_t s = first; s < first + n; s++) {
        sum += p->shares[at * p->n_shares + s] / p->flux[at];
        text_printf(t, " %.5f", sum);
    }
    text_char(t, '\n');
}

/* The shares first to first + n. A run of stretches reaches half a width beyond its ends, so that
 * single rows are seen too. */
static void write_shares(const curve_plot *p, int kind, size_t first, size_t n, text *t)
{
    const double half = (p->waning && is_over_phase(p) ? -0.5 : 0.5) * width_of_stretch(p);
    bool begun = false;
    text_printf(t, "$shares%d << end\n", kind);
    for (size_t at = 0; at < p->n_stretches; at++) {
        if (!(p->flux[at] > 0)) continue;
        const bool starts = at == 0 || !(p->flux[at - 1] > 0);
        const bool ends = at + 1 == p->n_stretches || !(p->flux[at + 1] > 0);
        const double x = middle_of(p, at);
        if (starts && begun) text_char(t, '\n');
        if (starts) write_stack(p, first, n, at, x - half, t);
        write_stack(p, first, n, at, x, t);
        if (ends) write_stack(p, first, n, at, x + half, t);
        begun = true;
    }
    text_add(t, begun ? "end\n" : "NaN NaN NaN\nend\n");
}

/* -------------------------------------------------------------------- layout */

/* The axis: its range, what it is, and how much of a date its marks show. */
static void write_axis(const curve_plot *p, text *t)
{
    double from, to;
    find_range(p, &from, &to);
    const double room = from < to ? 0 : width_of_stretch(p);
    if (p->has_utc) {
        plot_time_axis(from - room, to + room, t);
        return;
    }
    text_printf(t, "first = %.6f\nlast = %.6f\nset xrange [first:last]\n", from - room, to + room);
    text_printf(t, "bottom = '%s'\nmarks = '%%g'\n",
                is_over_phase(p) ? "phase angle (deg)" : "t_s (s)");
}

static const char *fact_of(const glint_curve *curve, const char *wanted)
{
    const char *key, *value;
    for (size_t k = 0; glint_curve_fact(curve, k, &key, &value); k++)
        if (string_equal(key, wanted)) return value;
    return "";
}

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* Letters of the longest name in the legends. */
static size_t longest_name(const curve_plot *p)
{
    size_t n, longest = 0;
    const glint_column *columns = glint_curve_columns(p->curve, &n);
    for (size_t b = 0; b < p->n_bands && p->n_bands > 1; b++)
        longest = larger(longest, strlen(columns[p->band_columns[b]].name + strlen(MAGNITUDE)));
    for (size_t s = 0; s < p->n_shares; s++)
        if (p->share_columns[s] != OTHERS)
            longest = larger(longest, strlen(columns[p->share_columns[s]].name +
                                             strlen(PREFIXES[p->share_kinds[s]])));
    return longest;
}

/* What all panels have in common. */
static void write_setup(const curve_plot *p, text *t)
{
    const size_t longest = longest_name(p);
    text_add(t, "set grid lt 1 lc rgb '#d8d8d8' lw 1 dt solid\nset border lc rgb '#444444'\n"
                "set style fill solid 0.8 noborder\nset lmargin 10\n"
                "set key at graph 1.02, graph 1 left top Left reverse samplen 2 noenhanced\n"
                "set tics nomirror\nset xtics out\n");
    text_printf(t, "set rmargin %zu\n", longest == 0 ? 4 : longest < 30 ? longest + 6 : 36);
    write_axis(p, t);
    text_add(t, "set multiplot title ");
    plot_quote(t, fact_of(p->curve, "title"));
    if (p->note) {
        text_add(t, " . \"\\n\" . ");
        plot_quote(t, p->note);
    }
    text_add(t, " noenhanced\n");
}

/* Panels: magnitudes, and one for each kind of shares that there are. */
enum { MAGNITUDES = N_KINDS, N_PANELS };
static const int PANELS[N_PANELS] = {MAGNITUDES, BY_MATERIAL, BY_COMPONENT, BY_SURFACE};

static bool has_panel(const curve_plot *p, int panel)
{
    bool found = panel == MAGNITUDES;
    for (size_t s = 0; s < p->n_shares && !found; s++)
        found = p->share_kinds[s] == panel;
    return found;
}

/* Where a panel begins and ends, in the picture's height from below: one below the other, where a
 * blank line's room parts them. */
static void place_panel(const curve_plot *p, int panel, double *top, double *bottom)
{
    static const double TOP = 0.93, BOTTOM = 0.14, GAP = 0.045;
    static const double TITLE = 0.03; /* another line of the title */
    static const double PARTS[N_PANELS] = {
        [MAGNITUDES] = 1.3, [BY_MATERIAL] = 1, [BY_COMPONENT] = 1, [BY_SURFACE] = 1.7};
    const double begin = p->note ? TOP - TITLE : TOP;
    double free = begin - BOTTOM + GAP, parts = 0;
    for (int k = 0; k < N_PANELS; k++) {
        parts += has_panel(p, PANELS[k]) ? PARTS[PANELS[k]] : 0;
        free -= has_panel(p, PANELS[k]) ? GAP : 0;
    }
    *bottom = begin + GAP;
    for (int k = 0; k < N_PANELS; k++) {
        if (!has_panel(p, PANELS[k])) continue;
        *top = *bottom - GAP;
        *bottom = *top - free * PARTS[PANELS[k]] / parts;
        if (PANELS[k] == panel) return;
    }
}

/* The last panel says what the axis is. */
static void begin_panel(const curve_plot *p, int panel, text *t)
{
    double top, bottom;
    bool is_last = true;
    place_panel(p, panel, &top, &bottom);
    for (int kind = panel == MAGNITUDES ? 0 : panel + 1; kind < N_KINDS; kind++)
        is_last = is_last && !has_panel(p, kind);
    text_printf(t, "set tmargin at screen %.4f\nset bmargin at screen %.4f\n", top, bottom);
    text_add(t,
             is_last ? "set format x marks\nset xlabel bottom noenhanced\n" : "set format x ''\n");
}

/* Names that a panel has room for beside it. */
static size_t room_for_names(const curve_plot *p, int panel)
{
    static const double LINE = 0.0285; /* of the picture's height */
    double top, bottom;
    place_panel(p, panel, &top, &bottom);
    const double lines = (top - bottom) / LINE;
    return lines > 2 ? (size_t)lines : 2;
}

/* Marks at round magnitudes, with room for their numbers. */
static void write_magnitude_marks(const curve_plot *p, text *t)
{
    static const double ROOM = 0.035; /* of a number, of the picture's height */
    double bright = HUGE_VAL, faint = -HUGE_VAL, top, bottom;
    for (const curve_plot *from = p; from; from = from->given)
        for (size_t k = 0; k < from->n_stretches * from->n_bands; k++)
            if (from->extremes[k].any) {
                bright = fmin(bright, from->extremes[k].bright_mag);
                faint = fmax(faint, from->extremes[k].faint_mag);
            }
    place_panel(p, MAGNITUDES, &top, &bottom);
    if (bright + 1e-3 < faint)
        text_printf(t, "set ytics %.6g\n",
                    plot_round_step(1.1 * (faint - bright) * ROOM / (top - bottom)));
    else
        text_add(t, "set ytics autofreq\n");
}

static void write_magnitudes(const curve_plot *p, bool any, text *t)
{
    static const char *const COLOURS[] = {"#1f4e79", "#c0392b", "#2e8b57", "#8e44ad",
                                          "#d68910", "#16a0a0", "#7f8c8d", "#5d4037"};
    enum { N_COLOURS = sizeof COLOURS / sizeof *COLOURS };
    size_t n;
    const glint_column *columns = glint_curve_columns(p->curve, &n);
    if (p->n_bands == 1 && !p->given)
        text_printf(t, "unset key\nset ylabel 'magnitude %s' noenhanced\n",
                    columns[p->band_columns[0]].name + strlen(MAGNITUDE));
    else
        text_printf(t, "set key\nset ylabel 'magnitude%s%s' noenhanced\n",
                    p->n_bands == 1 ? " " : "",
                    p->n_bands == 1 ? columns[p->band_columns[0]].name + strlen(MAGNITUDE) : "");
    if (!any) {
        text_add(t, "unset key\nset yrange [1:0]\nset format y ''\n"
                    "set label 1 'no row has a magnitude' at graph 0.5,0.5 center\n"
                    "plot NaN\nunset label 1\nset format y '%h'\n");
        return;
    }
    write_magnitude_marks(p, t);
    text_add(t, "set yrange [*:*] reverse\nset offsets 0,0,graph 0.05,graph 0.05\nplot ");
    if (p->given)
        text_add(t, "$given0 using 1:2 with lines lw 2 lc rgb '#a0a0a0' title 'as given', "
                    "$given_dots0 using 1:2 with points pt 7 ps 0.5 lc rgb '#a0a0a0' notitle, ");
    for (size_t b = 0; b < p->n_bands; b++) {
        const char *colour = COLOURS[b % N_COLOURS];
        text_printf(t, "%s$band%zu using 1:2 with lines lw 2.5 lc rgb '%s' title ", b ? ", " : "",
                    b, colour);
        plot_quote(t, p->n_bands == 1 ? "changed"
                                      : columns[p->band_columns[b]].name + strlen(MAGNITUDE));
        text_printf(t, ", $dots%zu using 1:2 with points pt 7 ps 0.5 lc rgb '%s' notitle", b,
                    colour);
    }
    text_add(t, "\nset offsets\n");
}

static void write_share_panel(const curve_plot *p, int kind, size_t first, size_t n, text *t)
{
    static const char *const COLOURS[] = {"#c58b1b", "#7a8ca3", "#6aa84f", "#a64d79",
                                          "#3d85c6", "#999999", "#e06666", "#45818e"};
    enum { N_COLOURS = sizeof COLOURS / sizeof *COLOURS };
    size_t n_columns;
    const glint_column *columns = glint_curve_columns(p->curve, &n_columns);
    const bool small = has_panel(p, BY_SURFACE);
    text_printf(t,
                "set key\nset ylabel '%s%s%s' noenhanced\nset yrange [0:1] noreverse\n"
                "set ytics %s\nplot ",
                small ? NAMES_OF[kind] : SHARE_OF[kind], p->n_bands > 1 ? " in " : "",
                p->n_bands > 1 ? columns[p->band_columns[0]].name + strlen(MAGNITUDE) : "",
                small ? "0.5" : "0.2");
    for (size_t s = 0; s < n; s++) {
        text_printf(t, "%s$shares%d using 1:%zu:%zu with filledcurves lc rgb '%s' title ",
                    s ? ", " : "", kind, s + 2, s + 3,
                    p->share_columns[first + s] == OTHERS ? "#cccccc" : COLOURS[s % N_COLOURS]);
        if (p->share_columns[first + s] == OTHERS)
            text_printf(t, "'%zu others'", p->n_others[kind]);
        else
            plot_quote(t, columns[p->share_columns[first + s]].name + strlen(PREFIXES[kind]));
    }
    text_char(t, '\n');
}

/* Shares of a kind stand together, in the order of the kinds. */
static size_t first_of(const size_t n_of[N_KINDS], int kind)
{
    size_t first = 0;
    for (int k = 0; k < kind; k++)
        first += n_of[k];
    return first;
}

/* ------------------------------------------------------------ what has a name */

/* Of how many of the n shares from `first` on a share is the smaller one. */
static size_t rank_of(const curve_plot *p, size_t share, size_t first, size_t n)
{
    size_t rank = 0;
    for (size_t s = first; s < first + n; s++)
        rank += p->sums[s] > p->sums[share] || (p->sums[s] == p->sums[share] && s < share);
    return rank;
}

/* Gives the n shares from `first` on, of one kind, slots from `next` on, in their order; returns
 * the next one. Surfaces are many, and most of them never shine: those have no place in the legend.
 * What it has no room for beyond that shares a slot, the last. */
static size_t choose_kind(curve_plot *p, int kind, size_t first, size_t n, size_t next)
{
    size_t wanted = 0;
    for (size_t s = first; s < first + n; s++)
        wanted += kind != BY_SURFACE || p->sums[s] > 0;
    const size_t room = room_for_names(p, kind), named = wanted > room ? room - 1 : wanted;
    p->n_others[kind] = wanted - named;
    p->others_slot[kind] =
        p->n_others[kind] > 0 ? next + named : OTHERS; /* there is none: dropped */
    for (size_t s = first; s < first + n; s++)
        p->slots[s] = rank_of(p, s, first, n) < named ? next++ : p->others_slot[kind];
    return p->n_others[kind] > 0 ? next + 1 : next;
}

/* Brings the shares into their slots. */
static void move_shares(curve_plot *p, size_t n_slots)
{
    for (size_t at = 0; at < p->n_stretches; at++) {
        memcpy(p->sums, p->shares + at * p->n_shares, p->n_shares * sizeof *p->sums);
        double *to = p->shares + at * n_slots; /* never behind what is still to be read */
        for (size_t slot = 0; slot < n_slots; slot++)
            to[slot] = 0;
        for (size_t s = 0; s < p->n_shares; s++)
            if (p->slots[s] < n_slots) to[p->slots[s]] += p->sums[s];
    }
    for (size_t s = 0; s < p->n_shares; s++) { /* no named share moves back */
        const int kind = p->share_kinds[s];
        if (p->slots[s] == p->others_slot[kind]) continue;
        p->share_columns[p->slots[s]] = p->share_columns[s];
        p->share_kinds[p->slots[s]] = kind;
    }
    for (int kind = 0; kind < N_KINDS; kind++)
        if (p->n_others[kind] > 0) {
            p->share_columns[p->others_slot[kind]] = OTHERS;
            p->share_kinds[p->others_slot[kind]] = kind;
        }
    p->n_shares = n_slots;
}

static void choose_shares(curve_plot *p)
{
    size_t first = 0, next = 0;
    for (size_t s = 0; s < p->n_shares; s++) {
        p->sums[s] = 0;
        for (size_t at = 0; at < p->n_stretches; at++)
            p->sums[s] += p->shares[at * p->n_shares + s];
    }
    for (int kind = 0; kind < N_KINDS; kind++) {
        size_t n = 0;
        while (first + n < p->n_shares && p->share_kinds[first + n] == kind)
            n++;
        if (n > 0) next = choose_kind(p, kind, first, n, next);
        first += n;
    }
    move_shares(p, next);
}

void curve_plot_write(curve_plot *p, text *t)
{
    size_t n_of[N_KINDS] = {0};
    bool any = p->given && write_band(p->given, 0, "given", "given_dots", t);
    choose_shares(p);
    for (size_t s = 0; s < p->n_shares; s++)
        n_of[p->share_kinds[s]]++;
    for (size_t b = 0; b < p->n_bands; b++)
        any = write_band(p, b, "band", "dots", t) || any;
    for (int kind = 0; kind < N_KINDS; kind++)
        if (n_of[kind] > 0) write_shares(p, kind, first_of(n_of, kind), n_of[kind], t);
    write_setup(p, t);
    begin_panel(p, MAGNITUDES, t);
    write_magnitudes(p, any, t);
    for (int kind = 0; kind < N_KINDS; kind++) {
        if (n_of[kind] == 0) continue;
        begin_panel(p, kind, t);
        write_share_panel(p, kind, first_of(n_of, kind), n_of[kind], t);
    }
    text_add(t, "unset multiplot\n");
}
