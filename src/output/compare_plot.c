/* compare_plot.c: the picture of a prediction beside an observed track: points with their sigmas
 * over the predicted curve, and what they differ by below. Passes stand side by side, with the time
 * between them left out. */
#include "output/plot.h"

#include <math.h>
#include <stdlib.h>

/* Observations closer to each other belong to one pass, s: low satellites come back after an hour
 * and a half, and are up for less than half of this. */
static const double SAME_PASS_S = 2400;

/* Points of the predicted curve over all passes; where there are fewer than some in a pass, it is
 * not drawn. */
enum { CURVE_POINTS = 4000, CURVE_MOST = 800, CURVE_LEAST = 20 };

/* Observations first to first + n, and where the pass begins on the axis. */
typedef struct track_pass {
    size_t first, n;
    double from_s, to_s; /* TT s from the scenario's start */
    double x;
    bool is_marked; /* with its date */
} track_pass;

typedef struct track_picture {
    const glint_comparison *c; /* borrowed */
    glint_comparison_summary total;
    glint_observation *items; /* owned; those compared, in the order of time */
    size_t n;
    track_pass *passes; /* owned */
    size_t n_passes;
    double margin; /* between passes, on the axis */
    double end;    /* of the last pass there */
    bool all_marked;
} track_picture;

/* --------------------------------------------------------------------- layout */

static int in_time(const void *a, const void *b)
{
    const glint_observation *x = a, *y = b;
    if (x->t_s != y->t_s) return x->t_s < y->t_s ? -1 : 1;
    return (x->line > y->line) - (x->line < y->line);
}

/* Gathers what was compared; false when memory is out. */
static bool gather(track_picture *p)
{
    size_t all = 0;
    glint_observation o;
    while (glint_comparison_get(p->c, all, &o))
        all++;
    p->items = calloc(all + 1, sizeof *p->items);
    p->passes = calloc(all + 1, sizeof *p->passes);
    if (!p->items || !p->passes) return false;
    for (size_t k = 0; k < all; k++) {
        glint_comparison_get(p->c, k, &o);
        if (o.state == GLINT_COMPARED) p->items[p->n++] = o;
    }
    if (p->n > 1) qsort(p->items, p->n, sizeof *p->items, in_time);
    return true;
}

/* Cuts the track into passes, and sets them side by side. A single one stands on an axis of UTC,
 * several on one that counts their seconds. */
static void lay_out(track_picture *p)
{
    double sum_s = 0;
    for (size_t k = 0; k < p->n; k++) {
        const double t_s = p->items[k].t_s;
        if (k == 0 || t_s - p->items[k - 1].t_s > SAME_PASS_S)
            p->passes[p->n_passes++] = (track_pass){.first = k, .from_s = t_s};
        track_pass *pass = &p->passes[p->n_passes - 1];
        pass->n = k + 1 - pass->first;
        pass->to_s = t_s;
    }
    for (size_t k = 0; k < p->n_passes; k++)
        sum_s += p->passes[k].to_s - p->passes[k].from_s;
    p->margin = sum_s > 0 ? 0.5 * sum_s / (double)p->n_passes : 1;
    p->end = p->n_passes == 1 ? plot_utc_s(&p->items[0].utc) : 0;
    for (size_t k = 0; k < p->n_passes; k++) {
        track_pass *pass = &p->passes[k];
        pass->x = k ? p->end + p->margin : p->end;
        p->end = pass->x + pass->to_s - pass->from_s;
    }
}

/* A date takes so much of the axis that not every pass has room for its own. */
static void mark_passes(track_picture *p)
{
    static const double MOST_MARKS = 7;
    const double length = p->end - p->passes[0].x + p->margin;
    double last = -HUGE_VAL;
    p->all_marked = true;
    for (size_t k = 0; k < p->n_passes; k++) {
        track_pass *pass = &p->passes[k];
        pass->is_marked = pass->x - last >= length / MOST_MARKS;
        if (pass->is_marked) last = pass->x;
        p->all_marked = p->all_marked && pass->is_marked;
    }
}

/* ----------------------------------------------------------------------- data */

static void write_observed(const track_picture *p, text *t)
{
    text_add(t, "$observed << end\n");
    for (size_t k = 0; k < p->n_passes; k++) {
        const track_pass *pass = &p->passes[k];
        for (size_t i = pass->first; i < pass->first + pass->n; i++) {
            const glint_observation *o = &p->items[i];
            text_printf(t, "%.6f %.5f %.5f %.5f %.5f\n", pass->x + o->t_s - pass->from_s,
                        o->observed, o->sigma, o->residual, o->predicted + p->total.zero_point);
        }
    }
    text_add(t, "end\n");
}

/* Appends the curve of a pass of n points. */
static glint_status write_pass(const track_picture *p, const track_pass *pass, int n, int threads,
                               text *t, glint_error *error)
{
    double t_s[CURVE_MOST] = {0}, predicted[CURVE_MOST];
    for (int k = 0; k < n; k++)
        t_s[k] = fmin(pass->from_s + (pass->to_s - pass->from_s) * k / (n - 1), pass->to_s);
    const glint_status status =
        glint_comparison_predict(p->c, t_s, (size_t)n, threads, predicted, error);
    for (int k = 0; k < n && !status; k++)
        if (predicted[k] < HUGE_VAL)
            text_printf(t, "%.6f %.5f\n", pass->x + t_s[k] - pass->from_s,
                        predicted[k] + p->total.zero_point);
        else
            text_char(t, '\n'); /* interrupts the line */
    text_char(t, '\n');
    return status;
}

/* The curve between the observations of each pass. */
static glint_status write_predicted(const track_picture *p, int threads, text *t,
                                    glint_error *error)
{
    glint_status status = GLINT_OK;
    const size_t fitting = CURVE_POINTS / p->n_passes;
    const int n = fitting < CURVE_MOST ? (int)fitting : CURVE_MOST;
    text_add(t, "$predicted << end\nNaN NaN\n\n");
    for (size_t k = 0; k < p->n_passes && n >= CURVE_LEAST && !status; k++)
        if (p->passes[k].from_s < p->passes[k].to_s)
            status = write_pass(p, &p->passes[k], n, threads, t, error);
    text_add(t, "end\n");
    return status;
}

/* --------------------------------------------------------------------- drawing */

/* Marks where some of the passes begin; labelled: with their dates. */
static void write_pass_marks(const track_picture *p, bool labelled, text *t)
{
    static const char *const MONTHS[12] = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                           "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    text_add(t, "set xtics out ()\n");
    for (size_t k = 0; k < p->n_passes; k++) {
        const track_pass *pass = &p->passes[k];
        if (!pass->is_marked) continue;
        const glint_utc *u = &p->items[pass->first].utc;
        text_add(t, "set xtics add (\"");
        if (labelled)
            text_printf(t, "%02d:%02d\\n%d %s %d", u->hour, u->minute, u->day,
                        MONTHS[(u->month + 11) % 12], u->year);
        text_printf(t, "\" %.6f)\n", pass->x);
    }
}

/* The axis of several passes, and a line between two. */
static void write_pass_axis(const track_picture *p, text *t)
{
    enum { MOST_LINES = 100 };
    text_printf(t,
                "set xrange [%.6f:%.6f]\nmarks = '%%g'\nset grid noxtics\n"
                "set xlabel offset 0,-1\n"
                "bottom = 'UTC at the beginning of %s; time between passes is left out'\n",
                -0.5 * p->margin, p->end + 0.5 * p->margin,
                p->all_marked ? "each pass" : "some passes");
    for (size_t k = 1; k < p->n_passes && p->n_passes <= MOST_LINES; k++) {
        const double x = p->passes[k].x - 0.5 * p->margin;
        text_printf(t,
                    "set arrow from first %.6f, graph 0 to first %.6f, graph 1 nohead "
                    "lc rgb '#b0b0b0' dt 2\n",
                    x, x);
    }
    write_pass_marks(p, false, t);
}

static void write_axis(const track_picture *p, text *t)
{
    const double from = p->passes[0].x, room = from < p->end ? 0.01 * (p->end - from) : 1;
    if (p->n_passes == 1)
        plot_time_axis(from - room, p->end + room, t);
    else
        write_pass_axis(p, t);
}

/* "title", and below it the numbers. */
static void write_title(const track_picture *p, text *t)
{
    const glint_comparison_summary *s = &p->total;
    text numbers = {0};
    text_printf(&numbers, "%lld observation%s, rms %.3f mag", (long long)s->compared,
                s->compared == 1 ? "" : "s", s->rms);
    if (s->has_r) text_printf(&numbers, ", R %s", number_fixed(s->r, 3).text);
    if (s->fitted)
        text_printf(&numbers, ", zero point %s mag", number_signed(s->zero_point, 3).text);
    text_add(t, "set multiplot title ");
    if (s->title[0]) {
        plot_quote(t, s->title);
        text_add(t, " . \"\\n\" . ");
    }
    plot_quote(t, numbers.data ? numbers.data : "");
    text_add(t, " noenhanced\n");
    t->failed = t->failed || numbers.failed;
    text_free(&numbers);
}

/* Half the height of the residuals' axis: with their sigmas, where those are not far larger. */
static double residual_height(const track_picture *p)
{
    static const double LEAST = 1e-3; /* mag */
    const double largest = fmax(fabs(p->total.largest), LEAST);
    double reach = 0;
    for (size_t k = 0; k < p->n; k++)
        reach = fmax(reach, fabs(p->items[k].residual) + p->items[k].sigma);
    return 1.1 * fmax(largest, fmin(reach, 3 * largest));
}

/* Points of a column of $observed, with their sigmas where there are any. */
static void add_observed(const track_picture *p, int column, text *t)
{
    if (p->total.with_sigma > 0)
        text_printf(t,
                    ", $observed using 1:%d:($3 > 0 ? $3 : NaN) with yerrorbars pt 7 ps 0 "
                    "lc rgb '#c9a09a' notitle",
                    column);
    text_printf(t,
                ", $observed using 1:%d with points pt 7 ps 0.6 lc rgb '#c0392b' title 'observed'",
                column);
}

static void write_panels(const track_picture *p, text *t)
{
    const double most = residual_height(p);
    text_printf(t,
                "set tmargin at screen 0.86\nset bmargin at screen 0.40\nset format x ''\n"
                "set yrange [*:*] reverse\nset ylabel 'magnitude %s' noenhanced\n"
                "set offsets 0,0,graph 0.05,graph 0.05\n"
                "set key at graph 1, graph 1.02 right bottom horizontal Left reverse\n",
                p->total.band);
    text_add(t, "plot $predicted using 1:2 with lines lw 1.5 lc rgb '#1f4e79' title 'predicted', "
                "$observed using 1:5 with points pt 7 ps 0.25 lc rgb '#1f4e79' notitle");
    add_observed(p, 2, t);
    text_add(t, "\nset offsets\nunset key\nset tmargin at screen 0.37\nset bmargin at screen 0.15\n"
                "set format x marks\nset xlabel bottom noenhanced\n");
    text_printf(t, "set yrange [%.6g:%.6g] noreverse\nset ytics %.6g\n", -most, most,
                plot_round_step(most / 2.5));
    if (p->n_passes > 1) write_pass_marks(p, true, t);
    text_add(t, "set ylabel 'observed - predicted'\n"
                "plot 0 with lines lc rgb '#1f4e79' lw 1");
    add_observed(p, 4, t);
    text_add(t, "\nunset multiplot\n");
}

static glint_status write_script(const track_picture *p, int threads, text *t, glint_error *error)
{
    write_observed(p, t);
    const glint_status status = write_predicted(p, threads, t, error);
    text_add(t, "set grid lt 1 lc rgb '#d8d8d8' lw 1 dt solid\nset border lc rgb '#444444'\n"
                "set lmargin 10\nset rmargin 4\nset tics nomirror\nset xtics out\n");
    write_axis(p, t);
    write_title(p, t);
    write_panels(p, t);
    return status;
}

glint_status glint_comparison_plot(const glint_comparison *c, int threads, const char *path,
                                   glint_error *error)
{
    track_picture p = {.c = c};
    plot *picture;
    text script = {0};
    glint_comparison_total(c, &p.total);
    glint_status status = plot_open(path, &picture, error);
    if (status) return status;
    if (!gather(&p)) {
        status = error_no_memory(error);
    } else if (p.n == 0) {
        status = error_set(error, GLINT_INPUT, (place){p.total.file, 0, 0},
                           "no observation could be compared, so there is nothing to draw");
    } else {
        lay_out(&p);
        mark_passes(&p);
        status = write_script(&p, threads, &script, error);
    }
    if (!status && script.failed) status = error_no_memory(error);
    if (status)
        plot_abandon(picture);
    else
        status = plot_finish(picture, script.data, script.length, error);
    text_free(&script);
    free(p.items);
    free(p.passes);
    return status;
}
