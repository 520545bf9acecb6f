/* material_plot.c: what is shown of materials, as a picture. Curves and maps are drawn through
 * directions of their own, finer than those of a table where a lobe is narrow. */
#include "base/constants.h"
#include "output/material_view.h"
#include "output/plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A picture being composed. */
typedef struct picture {
    const glint_material *const *materials; /* borrowed, n */
    size_t n;
    const glint_material_view *view;
    const view_points *points; /* of GLINT_VIEW_ANGLES and GLINT_VIEW_DHR; else NULL */
    text *t;                   /* the script */
} picture;

/* One material at one angle of incidence. */
typedef struct shown {
    const glint_material *material;
    const char *label;
    double theta_i_deg, phi_i_deg;
} shown;

/* Number k of those shown: the materials one after the other, at all angles each. */
static shown shown_at(const picture *p, size_t k)
{
    const size_t m = k / p->view->n_theta_i;
    return (shown){p->materials[m], view_label(p->view, p->materials, m),
                   p->view->theta_i_deg[k % p->view->n_theta_i], p->view->phi_i_deg};
}

static size_t shown_count(const picture *p)
{
    return p->n * p->view->n_theta_i;
}

/* f, 1/sr, at a zenith angle and an azimuth counted from the mirror side. */
static double f_at(const shown *s, double theta_r_deg, double from_mirror_deg)
{
    const view_point point = {s->theta_i_deg, s->phi_i_deg, theta_r_deg,
                              s->phi_i_deg + 180 + from_mirror_deg, 0};
    return view_point_brdf(s->material, &point);
}

/* ------------------------------------------------------------------- sampling */

enum { MOST_LINES = 1000, GRADED = 56 };

/* Angles at which a curve or a map is evaluated, in order. */
typedef struct lines {
    double deg[MOST_LINES];
    size_t n;
} lines;

/* f has no value in the horizon, and some models have no bound there; this is close enough. */
static const double LAST_DEG = 89.5;

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void add_line(lines *l, double from_deg, double to_deg, double deg)
{
    if (deg >= from_deg && deg <= to_deg && l->n < MOST_LINES) l->deg[l->n++] = deg;
}

/* Lines `coarse` apart, and around the middle of the lobe some whose distance from it grows as a
 * cube: a lobe of a tenth of a degree gets as many of them as one of ten. */
static void choose_lines(lines *l, double from_deg, double to_deg, double middle_deg, double coarse)
{
    const double reach_deg = fmax(to_deg - middle_deg, middle_deg - from_deg);
    l->n = 0;
    for (long k = lround(ceil(from_deg / coarse)); (double)k * coarse <= to_deg; k++)
        add_line(l, from_deg, to_deg, (double)k * coarse);
    add_line(l, from_deg, to_deg, from_deg);
    add_line(l, from_deg, to_deg, to_deg);
    for (int k = -GRADED; k <= GRADED; k++)
        add_line(l, from_deg, to_deg, middle_deg + reach_deg * pow((double)k / GRADED, 3));
    qsort(l->deg, l->n, sizeof *l->deg, by_size);
}

static void lines_of_plane(const shown *s, lines *l)
{
    choose_lines(l, -LAST_DEG, LAST_DEG, s->theta_i_deg, 0.5);
}

/* Zenith angles and azimuths of a map. */
static void lines_of_map(const shown *s, lines *theta_r, lines *from_mirror)
{
    choose_lines(theta_r, 0, LAST_DEG, s->theta_i_deg, 5);
    choose_lines(from_mirror, -180, 180, 0, 7.5);
}

/* -------------------------------------------------------------------- ranges */

typedef struct range {
    double low, high; /* of f, 1/sr; low leaves zeros out */
} range;

/* Towards the horizon some models grow without end: past this angle nothing raises the range. */
static const double STEEPEST_DEG = 85;

static void widen(range *r, double f, double theta_r_deg)
{
    if (f > 0) r->low = fmin(r->low, f);
    if (fabs(theta_r_deg) <= STEEPEST_DEG) r->high = fmax(r->high, f);
}

static range range_of_plane(const shown *s)
{
    range r = {INFINITY, 0};
    double theta_r, peak;
    lines l;
    lines_of_plane(s, &l);
    for (size_t k = 0; k < l.n; k++)
        widen(&r, f_at(s, l.deg[k], 0), l.deg[k]);
    if (glint_material_peak(s->material, s->theta_i_deg * DEG, s->phi_i_deg * DEG, &theta_r, &peak))
        r.high = peak;
    return r;
}

static range range_of_map(const shown *s)
{
    range r = {INFINITY, 0};
    lines theta_r, from_mirror;
    lines_of_map(s, &theta_r, &from_mirror);
    for (size_t k = 0; k < theta_r.n; k++)
        for (size_t j = 0; j < from_mirror.n; j++)
            widen(&r, f_at(s, theta_r.deg[k], from_mirror.deg[j]), theta_r.deg[k]);
    return r;
}

/* The range of all that is shown: from 0, or over some decades. */
static range range_of_all(const picture *p)
{
    static const double MOST_DECADES = 1e8; /* deeper tails are of no use to anybody */
    range all = {INFINITY, 0};
    for (size_t k = 0; k < shown_count(p); k++) {
        const shown s = shown_at(p, k);
        const range r = p->view->kind == GLINT_VIEW_PLANE ? range_of_plane(&s) : range_of_map(&s);
        all.low = fmin(all.low, r.low);
        all.high = fmax(all.high, r.high);
    }
    if (!(all.high > 0)) all.high = 1; /* all is black */
    all.low =
        p->view->logarithmic ? fmax(fmin(all.low, all.high / 10), all.high / MOST_DECADES) : 0;
    return all;
}

/* -------------------------------------------------------------------- curves */

typedef struct colour {
    double r, g, b; /* 0 to 255 */
} colour;

/* Colour k of n, from dark to light, told apart without seeing red and green; 0xrrggbb. */
static unsigned colour_of(size_t k, size_t n)
{
    static const colour ANCHORS[] = {
        {68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 190, 37}};
    enum { STRETCHES = sizeof ANCHORS / sizeof *ANCHORS - 1 };
    const double at = n > 1 ? (double)k / (double)(n - 1) * STRETCHES : 1;
    const size_t low = at < STRETCHES ? (size_t)at : STRETCHES - 1;
    const colour a = ANCHORS[low], b = ANCHORS[low + 1];
    const double part = at - (double)low;
    return (unsigned)lround(a.r + part * (b.r - a.r)) << 16 |
           (unsigned)lround(a.g + part * (b.g - a.g)) << 8 |
           (unsigned)lround(a.b + part * (b.b - a.b));
}

/* The title: what is shown, of which material where there is one alone, and where. */
static void write_title(const picture *p, const char *command, const char *what, const char *where)
{
    text title = {0};
    const char *band = p->n > 0 ? glint_material_band(p->materials[0]) : "";
    text_add(&title, what);
    if (p->n == 1) text_printf(&title, " of %s", view_label(p->view, p->materials, 0));
    if (band[0]) text_printf(&title, " in band %s", band);
    text_add(&title, where);
    text_printf(p->t, "set %s ", command);
    plot_quote(p->t, title.failed ? what : title.data);
    text_add(p->t, " noenhanced\n");
    text_free(&title);
}

static void write_curve_setup(text *t)
{
    text_add(t, "set grid lt 1 lc rgb '#d8d8d8' lw 1 dt solid\nset border lc rgb '#444444'\n"
                "set tics nomirror\nset xtics out\nset lmargin 10\n"
                "set key outside right top Left reverse samplen 3 noenhanced\n");
}

static void write_point(const picture *p, double x, double f)
{
    if (p->view->logarithmic && !(f > 0))
        text_char(p->t, '\n'); /* interrupts the line */
    else
        text_printf(p->t, "%.10g %.10g\n", x, f);
}

/* The legend's line of a curve: the angle, and the material where there are several. */
static void write_curve_title(const picture *p, const shown *s)
{
    text title = {0};
    if (p->n > 1) text_printf(&title, "%s  ", s->label);
    text_printf(&title, "%g°", s->theta_i_deg);
    plot_quote(p->t, title.failed ? "" : title.data);
    text_free(&title);
}

static void write_plane(const picture *p, size_t k)
{
    const shown s = shown_at(p, k);
    lines l;
    lines_of_plane(&s, &l);
    text_printf(p->t, "$curve%zu << end\n", k);
    for (size_t j = 0; j < l.n; j++)
        write_point(p, l.deg[j], f_at(&s, l.deg[j], 0));
    text_add(p->t, "end\n");
}

/* One curve for each material and angle: the colour tells the angle, the dashes the material. */
static void draw_plane(const picture *p)
{
    static const char *const DASHES[] = {"solid", "(5,2)", "(1.5,2)", "(8,2,1.5,2)", "(3,5)"};
    enum { N_DASHES = sizeof DASHES / sizeof *DASHES };
    text *t = p->t;
    const range all = range_of_all(p);
    const size_t n_angles = p->view->n_theta_i;
    for (size_t k = 0; k < shown_count(p); k++)
        write_plane(p, k);
    write_curve_setup(t);
    write_title(p, "title", "BRDF", " in the plane of incidence");
    text_add(t, "set xrange [-90:90]\nset xtics 15\nset key title 'incidence' left\n"
                "set xlabel 'angle of reflection from the normal, positive on the mirror side "
                "(deg)'\nset ylabel 'BRDF (1/sr)'\n");
    text_printf(
        t, "%sset yrange [%.6g:%.6g]\nplot ", p->view->logarithmic ? "set logscale y\n" : "",
        all.low * (p->view->logarithmic ? 0.7 : 1), all.high * (p->view->logarithmic ? 1.5 : 1.06));
    for (size_t k = 0; k < shown_count(p); k++) {
        const shown s = shown_at(p, k);
        text_printf(t, "%s$curve%zu using 1:2 with lines lw 2.5 lc rgb '#%06x' dt %s title ",
                    k ? ", " : "", k, colour_of(k % n_angles, n_angles),
                    DASHES[k / n_angles % N_DASHES]);
        write_curve_title(p, &s);
    }
    text_char(t, '\n');
}

/* The rest of a picture with one curve of points for each material, whose data are written. */
static void plot_materials(const picture *p)
{
    text_printf(p->t, "%sset yrange [%s:*<1.5]\nplot ",
                p->view->logarithmic ? "set logscale y\n" : "", p->view->logarithmic ? "*" : "0");
    for (size_t m = 0; m < p->n; m++) {
        text_printf(p->t,
                    "%s$curve%zu using 1:2 with linespoints pt 7 ps 0.6 lw 2 lc rgb '#%06x' title ",
                    m ? ", " : "", m, colour_of(m, p->n));
        plot_quote(p->t, view_label(p->view, p->materials, m));
    }
    text_char(p->t, '\n');
}

/* Values at given angles, in the order of the file. */
static void draw_angles(const picture *p)
{
    for (size_t m = 0; m < p->n; m++) {
        text_printf(p->t, "$curve%zu << end\n", m);
        for (size_t k = 0; k < p->points->n; k++)
            write_point(p, (double)k + 1, view_point_brdf(p->materials[m], &p->points->items[k]));
        text_add(p->t, "end\n");
    }
    write_curve_setup(p->t);
    write_title(p, "title", "BRDF", " at the given angles");
    text_printf(p->t,
                "set xlabel 'row of the table of angles'\nset ylabel 'BRDF (1/sr)'\n"
                "set xrange [0:%zu]\n",
                p->points->n + 1);
    plot_materials(p);
}

static glint_status draw_dhr(const picture *p, glint_errors *errors)
{
    for (size_t m = 0; m < p->n; m++) {
        const char *label = view_label(p->view, p->materials, m);
        text_printf(p->t, "$curve%zu << end\n", m);
        for (size_t k = 0; k < p->points->n; k++) {
            const view_point *point = &p->points->items[k];
            double dhr, bound;
            const glint_status status =
                view_point_dhr(label, p->materials[m], point, &dhr, &bound, errors);
            if (status) return status;
            write_point(p, point->theta_i_deg, dhr);
        }
        text_add(p->t, "end\n");
    }
    write_curve_setup(p->t);
    write_title(p, "title", "Directional-hemispherical reflectance", "");
    text_add(p->t, "set xlabel 'angle of incidence (deg)'\n"
                   "set ylabel 'reflected part of the light'\nset xrange [0:90]\nset xtics 15\n");
    plot_materials(p);
    return GLINT_OK;
}

/* ---------------------------------------------------------------------- maps */

enum { MOST_MAPS = 12 };

/* One map as a surface over the plane of the facet: f above (sin theta cos phi, sin theta sin phi).
 */
static void write_map(const picture *p, size_t k, double low)
{
    static const double POLE = 1e-3; /* rad; patches that shrink to a line have no slope to be lit
                                        by, so that the normal becomes a small ring */
    const shown s = shown_at(p, k);
    lines theta_r, from_mirror;
    lines_of_map(&s, &theta_r, &from_mirror);
    text_printf(p->t, "$map%zu << end\n", k);
    for (size_t a = 0; a < theta_r.n; a++) {
        const double radius = sin(fmax(theta_r.deg[a] * DEG, POLE));
        for (size_t b = 0; b < from_mirror.n; b++) {
            const double phi = (s.phi_i_deg + 180 + from_mirror.deg[b]) * DEG;
            text_printf(p->t, "%.6g %.6g %.6g\n", radius * cos(phi), radius * sin(phi),
                        fmax(f_at(&s, theta_r.deg[a], from_mirror.deg[b]), low));
        }
        text_char(p->t, '\n');
    }
    text_add(p->t, "end\n");
}

static void write_label(text *t, int number, const char *words, double radius, double phi,
                        double level, const char *ink)
{
    text_printf(t, "set label %d '%s' at %.4f,%.4f,%.6g center font ',11' tc rgb '%s'\n", number,
                words, radius * cos(phi), radius * sin(phi), level, ink);
}

/* Around the ground: azimuths, and the side from which the light comes. */
static void write_rim(const picture *p, double level)
{
    static const double RIM = 1.16, FROM = 1.30, TO = 1.06; /* distance from the middle */
    static const char GREY[] = "#666666", ORANGE[] = "#d68910";
    const double phi_i = p->view->phi_i_deg * DEG;
    char words[32];
    for (int k = 0; k < 4; k++) {
        snprintf(words, sizeof words, "%d°", 90 * k);
        if (cos(90 * k * DEG - phi_i) < 0.9) /* else the light stands there */
            write_label(p->t, k + 1, words, RIM, 90 * k * DEG, level, GREY);
    }
    snprintf(words, sizeof words, "light, %g°", p->view->phi_i_deg);
    write_label(p->t, 5, words, FROM + 0.22, phi_i, level, ORANGE);
    text_printf(p->t,
                "set arrow 1 from %.4f,%.4f,%.6g to %.4f,%.4f,%.6g head filled lw 2 "
                "lc rgb '%s'\n",
                FROM * cos(phi_i), FROM * sin(phi_i), level, TO * cos(phi_i), TO * sin(phi_i),
                level, ORANGE);
}

/* The lowest value of a map within the range of all; where all of it is black, the lowest there is.
 */
static double ground_of_map(const shown *s, const range *all)
{
    const double low = range_of_map(s).low;
    return isfinite(low) ? fmax(all->low, fmin(low, all->high)) : all->low;
}

/* What the top of the box stands for: more than the largest value where a map is high all around,
 * as that of a diffuse material, whose far edge would reach into its heading. */
static double top_of_box(const picture *p, const range *all)
{
    static const double HIGHEST_GROUND = 0.75; /* of the box */
    double part = 1;
    for (size_t k = 0; k < shown_count(p); k++) {
        const shown s = shown_at(p, k);
        const double ground = ground_of_map(&s, all);
        const double at = p->view->logarithmic ? log(ground / all->low) / log(all->high / all->low)
                                               : (ground - all->low) / (all->high - all->low);
        part = fmax(part, at / HIGHEST_GROUND);
    }
    return p->view->logarithmic ? all->low * pow(all->high / all->low, part)
                                : all->low + part * (all->high - all->low);
}

/* Height and colour tell the same, so that the scale of colours is the only axis: light colours for
 * little, from which lobes stand out. */
static void write_map_setup(const picture *p, const range *all)
{
    text_printf(p->t,
                "set palette defined (0 '#e4ecf4', 1 '#9ec5de', 2 '#4a90c2', 3 '#2d5aa0', "
                "4 '#5b2a86', 5 '#b5306e')\n"
                "set pm3d depthorder\nset pm3d lighting primary 0.4 specular 0.1\n"
                "set view 57,35,0.8,0.9\nset xyplane at %.6g\nunset key\nunset border\n"
                "set xrange [-1.3:1.3]\nset yrange [-1.3:1.3]\nset zrange [%.6g:%.6g]\n"
                "set cbrange [%.6g:%.6g]\n%s"
                "unset xtics\nunset ytics\nunset ztics\n"
                "set colorbox user origin screen 0.90,0.2 size screen 0.015,0.6\n"
                "set cblabel 'BRDF (1/sr)' offset 1,0\n",
                all->low, all->low, top_of_box(p, all), all->low, all->high,
                p->view->logarithmic ? "set logscale zcb\n" : "");
}

/* Where map k of n stands, row by row. Lengths are parts of the picture's height, which is two
 * thirds of its width; ground and heading reach beyond the box by parts of the box's height. */
static void write_place(const picture *p, size_t k, size_t n)
{
    static const double WIDTH = 1.305, HEIGHT = 0.94; /* for all maps */
    static const double GROUND = 0.18, HEADING = 0.14, ASPECT = 1.13;
    const size_t columns = (size_t)lround(sqrt((double)n * 1.5));
    const size_t rows = (n + columns - 1) / columns;
    const double width = WIDTH / (double)columns, height = HEIGHT / (double)rows;
    const double box = fmin(height / (1 + GROUND + HEADING), width / ASPECT);
    const double middle = width * ((double)(k % columns) + 0.5);
    const double room = height - box * (1 + GROUND + HEADING);
    const double bottom = HEIGHT - height * (double)(k / columns + 1) + 0.5 * room + GROUND * box;
    text_printf(p->t,
                "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
                "set bmargin at screen %.4f\nset tmargin at screen %.4f\n",
                (middle - 0.5 * ASPECT * box) / 1.5, (middle + 0.5 * ASPECT * box) / 1.5, bottom,
                bottom + box);
}

/* Which material where there are several, from where the light comes, and how high the map reaches.
 */
static void write_map_title(const picture *p, const shown *s)
{
    text title = {0};
    double theta_r, f;
    if (p->n > 1) text_printf(&title, "%s, ", s->label);
    text_printf(&title, "incidence %g°", s->theta_i_deg);
    if (glint_material_peak(s->material, s->theta_i_deg * DEG, s->phi_i_deg * DEG, &theta_r, &f))
        text_printf(&title, ": peak %#.4g", f);
    text_add(p->t, "set title ");
    plot_quote(p->t, title.failed ? "" : title.data);
    text_add(p->t, " noenhanced\n");
    text_free(&title);
}

static void draw_maps(const picture *p)
{
    const range all = range_of_all(p);
    const size_t n = shown_count(p);
    for (size_t k = 0; k < n; k++)
        write_map(p, k, all.low);
    write_map_setup(p, &all);
    write_title(p, "multiplot title", "BRDF", " over the hemisphere");
    for (size_t k = 0; k < n; k++) {
        const shown s = shown_at(p, k);
        write_place(p, k, n);
        write_map_title(p, &s);
        write_rim(p, ground_of_map(&s, &all));
        text_printf(p->t, "splot $map%zu using 1:2:3:3 with pm3d\nunset colorbox\n", k);
    }
    text_add(p->t, "unset multiplot\n");
}

/* ------------------------------------------------------------------- the whole */

static glint_status draw(const picture *p, glint_errors *errors)
{
    switch (p->view->kind) {
    case GLINT_VIEW_PLANE:
        draw_plane(p);
        break;
    case GLINT_VIEW_HEMISPHERE:
        draw_maps(p);
        break;
    case GLINT_VIEW_ANGLES:
        draw_angles(p);
        break;
    case GLINT_VIEW_DHR:
        return draw_dhr(p, errors);
    }
    return GLINT_OK;
}

/* The script of the picture. */
static glint_status compose(const glint_material *const *materials, size_t n,
                            const glint_material_view *view, text *script, glint_errors *errors)
{
    view_points points = {0};
    const bool is_map = view->kind == GLINT_VIEW_HEMISPHERE;
    const bool by_points = view->kind == GLINT_VIEW_ANGLES || view->kind == GLINT_VIEW_DHR;
    if (is_map && n * view->n_theta_i > MOST_MAPS)
        return errors_add(errors, GLINT_ARGUMENT, PLACE_NONE,
                          "%zu maps are asked for; expected at most %d in one picture",
                          n * view->n_theta_i, MOST_MAPS);
    glint_status status =
        by_points ? view_points_make(view, &points, errors) : view_check(view, errors);
    if (status) return status;
    const picture p = {materials, n, view, by_points ? &points : NULL, script};
    status = draw(&p, errors);
    if (!status && script->failed)
        status = errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    view_points_free(&points);
    return status;
}

glint_status glint_material_plot_write(const glint_material *const *materials, size_t n,
                                       const glint_material_view *view, const char *path,
                                       glint_errors *errors)
{
    plot *file;
    text script = {0};
    glint_error error;
    glint_status status = plot_open(path, &file, &error);
    if (status) return errors_take(errors, &error, PLACE_NONE);
    status = compose(materials, n, view, &script, errors);
    if (status)
        plot_abandon(file);
    else if ((status = plot_finish(file, script.data, script.length, &error)))
        errors_take(errors, &error, PLACE_NONE);
    text_free(&script);
    return status;
}
