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
static const char *const SHARE_OF[N_KINDS] = {"material share", "component share", "surface share"};

static const char MAGNITUDE[] = "mag_", FLUX[] = "flux_ratio_";

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
    size_t *share_columns; /* owned */
    size_t *kept;          /* owned; n_shares: scratch */
    extremes *extremes;    /* owned; n_stretches x n_bands */
    double *flux;          /* owned; n_stretches: sum over the rows of the first band's */
    double *shares;        /* owned; n_stretches x n_shares: sum of share times flux */
};

static bool begins(const char *string, const char *prefix)
{
    return strncmp(string, prefix, strlen(prefix)) == 0;
}

/* Of a column of shares. */
static int kind_of(const char *name)
{
    int kind = 0;
    while (kind < N_KINDS - 1 && !begins(name, PREFIXES[kind]))
        kind++;
    return kind;
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
            if (begins(columns[c].name, PREFIXES[kind])) p->share_columns[p->n_shares++] = c;
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
    p->kept = calloc(n + 1, sizeof *p->kept);
    if (p->band_columns && p->share_columns) find_columns(p, columns, n);
    p->extremes = calloc(p->n_stretches * (p->n_bands + 1), sizeof *p->extremes);
    p->flux = calloc(p->n_stretches, sizeof *p->flux);
    p->shares = calloc(p->n_stretches * (p->n_shares + 1), sizeof *p->shares);
    if (p->band_columns && p->share_columns && p->kept && p->extremes && p->flux && p->shares)
        return p;
    curve_plot_free(p);
    return NULL;
}

void curve_plot_free(curve_plot *p)
{
    if (!p) return;
    free(p->band_columns);
    free(p->share_columns);
    free(p->kept);
    free(p->extremes);
    free(p->flux);
    free(p->shares);
    free(p);
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
static bool write_band(const curve_plot *p, size_t band, text *t)
{
    bool any = false, gap = false;
    text dots = {0};
    text_printf(t, "$band%zu << end\n", band);
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
    text_printf(t, "end\n$dots%zu << end\n", band);
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
    for (size_t s = 0; s < p->n_shares; s++) {
        const char *name = columns[p->share_columns[s]].name;
        longest = larger(longest, strlen(name + strlen(PREFIXES[kind_of(name)])));
    }
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
    text_add(t, " noenhanced\n");
}

/* Begins panel k of n, counted from the top, where a blank line's room parts them. The first has
 * FIRST times the height of the others; the last says what the axis is. */
static void begin_panel(int k, int n, text *t)
{
    static const double TOP = 0.93, BOTTOM = 0.14, GAP = 0.045; /* of the picture's height */
    static const double FIRST = 1.3;
    const double height = (TOP - BOTTOM - (n - 1) * GAP) / (FIRST + n - 1);
    const double top = k == 0 ? TOP : TOP - FIRST * height - GAP - (k - 1) * (height + GAP);
    text_printf(t, "set tmargin at screen %.4f\nset bmargin at screen %.4f\n", top,
                top - (k == 0 ? FIRST : 1) * height);
    text_add(t, k == n - 1 ? "set format x marks\nset xlabel bottom noenhanced\n"
                           : "set format x ''\n");
}

static void write_magnitudes(const curve_plot *p, bool any, text *t)
{
    static const char *const COLOURS[] = {"#1f4e79", "#c0392b", "#2e8b57", "#8e44ad",
                                          "#d68910", "#16a0a0", "#7f8c8d", "#5d4037"};
    enum { N_COLOURS = sizeof COLOURS / sizeof *COLOURS };
    size_t n;
    const glint_column *columns = glint_curve_columns(p->curve, &n);
    if (p->n_bands == 1)
        text_printf(t, "unset key\nset ylabel 'magnitude %s' noenhanced\n",
                    columns[p->band_columns[0]].name + strlen(MAGNITUDE));
    else
        text_add(t, "set key\nset ylabel 'magnitude'\n");
    if (!any) {
        text_add(t, "unset key\nset yrange [1:0]\nset format y ''\n"
                    "set label 1 'no row has a magnitude' at graph 0.5,0.5 center\n"
                    "plot NaN\nunset label 1\nset format y '%h'\n");
        return;
    }
    text_add(t, "set yrange [*:*] reverse\nset offsets 0,0,graph 0.05,graph 0.05\nplot ");
    for (size_t b = 0; b < p->n_bands; b++) {
        const char *colour = COLOURS[b % N_COLOURS];
        text_printf(t, "%s$band%zu using 1:2 with lines lw 2.5 lc rgb '%s' title ", b ? ", " : "",
                    b, colour);
        plot_quote(t, columns[p->band_columns[b]].name + strlen(MAGNITUDE));
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
    text_printf(t, "set key\nset ylabel '%s%s%s' noenhanced\nset yrange [0:1] noreverse\nplot ",
                SHARE_OF[kind], p->n_bands > 1 ? " in " : "",
                p->n_bands > 1 ? columns[p->band_columns[0]].name + strlen(MAGNITUDE) : "");
    for (size_t s = 0; s < n; s++) {
        text_printf(t, "%s$shares%d using 1:%zu:%zu with filledcurves lc rgb '%s' title ",
                    s ? ", " : "", kind, s + 2, s + 3, COLOURS[s % N_COLOURS]);
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

/* Surfaces are many, and most of them never shine: those have no place in the legend. */
static void drop_dark_surfaces(curve_plot *p, const glint_column *columns)
{
    const size_t before = p->n_shares;
    size_t kept = 0;
    for (size_t s = 0; s < before; s++) {
        bool lit = kind_of(columns[p->share_columns[s]].name) != BY_SURFACE;
        for (size_t at = 0; at < p->n_stretches && !lit; at++)
            lit = p->shares[at * before + s] > 0;
        if (lit) p->kept[kept++] = s;
    }
    for (size_t s = 0; s < kept; s++)
        p->share_columns[s] = p->share_columns[p->kept[s]];
    for (size_t at = 0; at < p->n_stretches; at++)
        for (size_t s = 0; s < kept; s++)
            p->shares[at * kept + s] = p->shares[at * before + p->kept[s]];
    p->n_shares = kept;
}

void curve_plot_write(curve_plot *p, text *t)
{
    size_t n_columns, n_of[N_KINDS] = {0};
    const glint_column *columns = glint_curve_columns(p->curve, &n_columns);
    int panels = 1;
    bool any = false;
    drop_dark_surfaces(p, columns);
    for (size_t s = 0; s < p->n_shares; s++)
        n_of[kind_of(columns[p->share_columns[s]].name)]++;
    for (size_t b = 0; b < p->n_bands; b++)
        any = write_band(p, b, t) || any;
    for (int kind = 0; kind < N_KINDS; kind++) {
        if (n_of[kind] == 0) continue;
        panels++;
        write_shares(p, kind, first_of(n_of, kind), n_of[kind], t);
    }
    write_setup(p, t);
    begin_panel(0, panels, t);
    write_magnitudes(p, any, t);
    for (int kind = 0, panel = 1; kind < N_KINDS; kind++) {
        if (n_of[kind] == 0) continue;
        begin_panel(panel++, panels, t);
        write_share_panel(p, kind, first_of(n_of, kind), n_of[kind], t);
    }
    text_add(t, "unset multiplot\n");
}
