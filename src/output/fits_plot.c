/* fits_plot.c: the picture of fits to measured BRDF values: a column for each fit, measurements and
 * curve above, residuals below. */
#include "output/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_FITS = 4,      /* columns */
    MOST_CURVES = 8,    /* incidences that are told apart */
    MOST_POINTS = 10000 /* in the picture; of more, evenly taken ones */
};

static const double DEG_PER_RAD = 57.295779513082321;

/* A measurement in the picture. */
typedef struct spot {
    double theta_i_deg; /* incidence that it is drawn under */
    double x_deg;
    double f; /* 1/sr */
    double fitted[MOST_FITS];
} spot;

/* All that is drawn. */
typedef struct fits_plot {
    const glint_brdf_fits *fits;
    size_t n_fits;
    spot *spots; /* owned; in the order of incidence and x */
    size_t n_spots;
    /* Measurements in the plane of incidence at few incidences are curves over the signed angle of
     * the observer; others points over the angle from the mirror direction. */
    bool curves;
} fits_plot;

/* ------------------------------------------------------------------- points */

/* The signed angle of the observer in the plane of incidence, positive on the mirror's side; false
 * where it is not in that plane. */
static bool signed_angle(const glint_brdf_fit_point *p, double *x_deg)
{
    const double hair = 1e-6; /* sine of an angle */
    const double tangential = hypot(p->i[0], p->i[1]);
    double along = fabs(p->r[0]) > hair ? p->r[0] : p->r[1], across = 0.0;
    if (tangential > hair) {
        along = -(p->i[0] * p->r[0] + p->i[1] * p->r[1]) / tangential;
        across = (p->i[0] * p->r[1] - p->i[1] * p->r[0]) / tangential;
    } else if (fabs(p->r[0]) > hair) {
        across = p->r[1];
    }
    *x_deg = atan2(along, p->r[2]) * DEG_PER_RAD;
    return fabs(across) <= hair;
}

static double mirror_angle_deg(const glint_brdf_fit_point *p)
{
    const double d[3] = {p->r[0] + p->i[0], p->r[1] + p->i[1], p->r[2] - p->i[2]};
    const double half = 0.5 * sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    return 2.0 * asin(fmin(half, 1.0)) * DEG_PER_RAD;
}

static int compare(const void *a, const void *b)
{
    const spot *s = a, *t = b;
    if (s->theta_i_deg != t->theta_i_deg) return s->theta_i_deg < t->theta_i_deg ? -1 : 1;
    return (s->x_deg > t->x_deg) - (s->x_deg < t->x_deg);
}

static void take_point(fits_plot *p, size_t index, const glint_brdf_fit_point *first)
{
    spot *s = &p->spots[p->n_spots++];
    const double theta_deg = acos(fmin(first->i[2], 1.0)) * DEG_PER_RAD;
    *s = (spot){.theta_i_deg = round(theta_deg * 100.0) / 100.0, .f = first->f_measured};
    if (!signed_angle(first, &s->x_deg)) p->curves = false;
    for (size_t k = 0; k < p->n_fits; k++) {
        glint_brdf_fit_point point;
        glint_brdf_fits_point(p->fits, k, index, &point);
        s->fitted[k] = point.f_fitted;
    }
}

static size_t count_incidences(const fits_plot *p)
{
    size_t n = 0;
    for (size_t k = 0; k < p->n_spots; k++)
        n += k == 0 || p->spots[k].theta_i_deg != p->spots[k - 1].theta_i_deg;
    return n;
}

/* Fills in all points; false when memory is out. */
static bool take_points(fits_plot *p)
{
    glint_brdf_fit_info info;
    glint_brdf_fit_point point;
    while (p->n_fits < MOST_FITS && glint_brdf_fits_get(p->fits, p->n_fits, &info))
        p->n_fits++;
    glint_brdf_fits_get(p->fits, 0, &info);
    const size_t stride = (info.n_points + MOST_POINTS - 1) / MOST_POINTS;
    p->spots = calloc(info.n_points + 1, sizeof *p->spots);
    if (!p->spots) return false;
    p->curves = true;
    for (size_t j = 0, n_used = 0; glint_brdf_fits_point(p->fits, 0, j, &point); j++)
        if (point.used && n_used++ % stride == 0) take_point(p, j, &point);
    qsort(p->spots, p->n_spots, sizeof *p->spots, compare);
    p->curves = p->curves && count_incidences(p) <= MOST_CURVES;
    if (p->curves) return true;
    p->n_spots = 0;
    for (size_t j = 0, n_used = 0; glint_brdf_fits_point(p->fits, 0, j, &point); j++) {
        if (!point.used || n_used++ % stride != 0) continue;
        take_point(p, j, &point);
        p->spots[p->n_spots - 1].theta_i_deg = 0.0;
        p->spots[p->n_spots - 1].x_deg = mirror_angle_deg(&point);
    }
    p->curves = false;
    qsort(p->spots, p->n_spots, sizeof *p->spots, compare);
    return true;
}

/* ------------------------------------------------------------------- script */

/* One data block for each incidence: x, f, and of each fit its value and the residual in dex.
 * Returns how many there are. */
static int write_blocks(const fits_plot *p, text *t)
{
    int n = 0;
    for (size_t k = 0; k < p->n_spots; k++) {
        const spot *s = &p->spots[k];
        if (k == 0 || s->theta_i_deg != p->spots[k - 1].theta_i_deg)
            text_printf(t, "%s$incidence%d << end\n", n ? "end\n" : "", n), n++;
        text_printf(t, "%.4f %.6g", s->x_deg, s->f);
        for (size_t j = 0; j < p->n_fits; j++) {
            if (s->fitted[j] > 0.0)
                text_printf(t, " %.6g %.5f", s->fitted[j], log10(s->fitted[j] / s->f));
            else
                text_add(t, " NaN NaN");
        }
        text_char(t, '\n');
    }
    text_add(t, "end\n");
    return n;
}

/* The ranges that all columns share. */
static void write_ranges(const fits_plot *p, text *t)
{
    double low = INFINITY, high = 0.0, residual = 0.0, left = INFINITY, right = -INFINITY;
    for (size_t k = 0; k < p->n_spots; k++) {
        const spot *s = &p->spots[k];
        low = fmin(low, s->f), high = fmax(high, s->f);
        left = fmin(left, s->x_deg), right = fmax(right, s->x_deg);
        for (size_t j = 0; j < p->n_fits; j++)
            if (s->fitted[j] > 0.0) residual = fmax(residual, fabs(log10(s->fitted[j] / s->f)));
    }
    const double most = 2.0; /* dex; what is farther off is not worth the room */
    residual = 1.05 * fmin(fmax(residual, 0.01), most);
    if (!(left < right)) left -= 1.0, right += 1.0;
    const double room = 0.08 * (right - left); /* for half a number, beside that of the neighbour */
    left -= room, right += room;
    text_printf(t, "low = %.6g\nhigh = %.6g\nmiss = %.6g\nset xrange [%.4f:%.4f]\n", 0.5 * low,
                2.0 * high, residual, left, right);
    text_printf(t, "across = '%s'\n",
                p->curves ? "angle of the observer (deg), + on the mirror side"
                          : "angle from the mirror direction (deg)");
}

/* Margins of the panel in column k of n; upper or lower. */
static void write_margins(size_t k, size_t n, bool upper, text *t)
{
    static const double LEFT = 0.075, RIGHT = 0.985, GAP = 0.012; /* of the picture's width */
    const double width = (RIGHT - LEFT + GAP) / (double)n, left = LEFT + (double)k * width;
    text_printf(t, "set lmargin at screen %.4f\nset rmargin at screen %.4f\n", left,
                left + width - GAP);
    text_printf(t, "set tmargin at screen %.3f\nset bmargin at screen %.3f\n", upper ? 0.91 : 0.37,
                upper ? 0.40 : 0.09);
}

static const char *colour(int k)
{
    static const char *const colours[MOST_CURVES] = {"#1f4e79", "#c0392b", "#2e8b57", "#8e44ad",
                                                     "#d68910", "#16a0a0", "#7f8c8d", "#5d4037"};
    return colours[k % MOST_CURVES];
}

/* Incidence of a block, deg from the normal. */
static double incidence_deg(const fits_plot *p, int block)
{
    size_t k = 0;
    for (int n = 0; n < block; k++)
        n += p->spots[k + 1].theta_i_deg != p->spots[k].theta_i_deg;
    return p->spots[k].theta_i_deg;
}

static void write_upper(const fits_plot *p, size_t k, int n_blocks, text *t)
{
    glint_brdf_fit_info info;
    glint_brdf_fits_get(p->fits, k, &info);
    text_add(t, "set title ");
    plot_quote(t, info.model);
    text_printf(t,
                " . \"\\nrms %.3g dex\" noenhanced\nset logscale y\nset yrange [low:high]\n"
                "set format x ''\nset format y '%s'\nunset label 1\n%s\nplot ",
                info.rms_dex, k == 0 ? "10^{%T}" : "",
                k == 0 ? "set ylabel 'f (1/sr)'\nset key top left Left reverse samplen 0.5"
                       : "unset ylabel\nunset key");
    for (int b = 0; b < n_blocks; b++) {
        text_printf(t, "%s$incidence%d using 1:2 with points pt 7 ps 0.35 lc rgb '%s' ",
                    b ? ", " : "", b, colour(b));
        if (p->curves)
            text_printf(t,
                        "title '%g deg', $incidence%d using 1:%zu with lines lw 1.5 lc rgb '%s' "
                        "notitle",
                        incidence_deg(p, b), b, 2 * k + 3, colour(b));
        else
            text_printf(t,
                        "title 'measured', $incidence%d using 1:%zu with points pt 6 ps 0.35 lc "
                        "rgb '%s' title 'fitted'",
                        b, 2 * k + 3, colour(1));
    }
    text_char(t, '\n');
}

static void write_lower(size_t k, int n_blocks, text *t)
{
    text_printf(t,
                "unset title\nunset logscale y\nset yrange [-miss:miss]\nset format x '%%g'\n"
                "set format y '%s'\nunset key\n%s\nplot 0 with lines lc rgb '#888888' lw 1",
                k == 0 ? "%g" : "",
                k == 0 ? "set ylabel 'log_{10}(fitted/measured)'\n"
                         "set label 1 across at screen 0.53,0.025 center"
                       : "unset ylabel\nunset label 1");
    for (int b = 0; b < n_blocks; b++)
        text_printf(t, ", $incidence%d using 1:%zu with points pt 7 ps 0.3 lc rgb '%s'", b,
                    2 * k + 4, colour(b));
    text_char(t, '\n');
}

static void write_script(const fits_plot *p, text *t)
{
    const int n_blocks = write_blocks(p, t);
    write_ranges(p, t);
    text_add(t, "set grid lt 1 lc rgb '#d8d8d8' lw 1 dt solid\nset border lc rgb '#444444'\n"
                "set tics nomirror\nset multiplot\n");
    if (p->curves) text_add(t, "set key title 'incidence' left\n");
    if (p->curves && p->n_fits > 3) text_add(t, "set xtics 40\n"); /* the columns are narrow */
    for (size_t k = 0; k < p->n_fits; k++) {
        write_margins(k, p->n_fits, true, t);
        write_upper(p, k, n_blocks, t);
        write_margins(k, p->n_fits, false, t);
        write_lower(k, n_blocks, t);
    }
    text_add(t, "unset multiplot\n");
}

glint_status glint_brdf_fits_plot(const glint_brdf_fits *fits, const char *path, glint_error *error)
{
    fits_plot p = {.fits = fits};
    text script = {0};
    plot *picture;
    glint_status status = plot_open(path, &picture, error);
    if (status) return status;
    if (take_points(&p)) write_script(&p, &script);
    if (!p.spots || script.failed) {
        plot_abandon(picture);
        status = error_no_memory(error);
    } else {
        status = plot_finish(picture, script.data, script.length, error);
    }
    text_free(&script);
    free(p.spots);
    return status;
}
