/* The picture of a satellite: its pieces in colours, edges, a scale, and what the colours mean. */
#include "base/constants.h"
#include "output/colour.h"
#include "output/picture.h"
#include "output/utf8.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Layout, in px of a picture of 1200 x 900; others are scaled. */
enum {
    MARGIN = 36,
    HEAD = 128,  /* title and lines below it */
    FOOT = 64,   /* scale bar */
    PANEL = 300, /* legend and directions, to the right */
    FULL_WIDTH = 1200,
    FULL_HEIGHT = 900
};
/* A picture that shrinks the layout by more has no room for words: it shows the satellite alone. */
static const double LEAST_SHRINK = 0.5;

static const double TITLE_SIZE = 26, TEXT_SIZE = 18, SMALL_SIZE = 15;

/* Decades of a logarithmic scale. */
enum { DECADES = 4 };

static const colour INK = {0.10, 0.10, 0.12}, PALE_INK = {0.38, 0.38, 0.42},
                    SUN_COLOUR = {0.90, 0.55, 0.0};
static const colour LIT_COLOUR = {0.99, 0.86, 0.45}; /* where colours tell light from shadow */
/* Without sunlight: neutral, so that they are not taken for values of the scale. */
static const colour SHADOW_COLOUR = {0.50, 0.52, 0.55}, AWAY_COLOUR = {0.33, 0.34, 0.37},
                    BACK_COLOUR = {0.13, 0.13, 0.14};

/* A picture on its way. */
typedef struct sketch {
    const glint_view *view;
    const glint_view_scene *scene;
    glint_view_style style;
    cairo_t *pen;
    double unit;          /* px of a layout px */
    double width, height; /* layout px */
    bool is_bare;         /* the satellite alone */
    double scale, at[2];  /* layout px per m; where the origin is */
} sketch;

/* --- text --- */

static void set_colour(cairo_t *pen, colour c)
{
    cairo_set_source_rgb(pen, c.red, c.green, c.blue);
}

/* A text that is UTF-8 on one line, whatever it was. */
static void clean(const char *from, char *out, size_t size)
{
    size_t n = strlen(from), used = 0;
    while (n > 0 && used + 5 < size) {
        unsigned character;
        size_t length = utf8_read(from, n, &character);
        const bool good = length > 0 && character >= 0x20 && character != 0x7f;
        if (length == 0) length = 1;
        if (good)
            memcpy(out + used, from, length);
        else
            out[used] = ' ';
        used += good ? length : 1;
        from += length, n -= length;
    }
    out[used] = '\0';
}

static double text_width(const sketch *s, const char *string)
{
    cairo_text_extents_t extents;
    cairo_text_extents(s->pen, string, &extents);
    return extents.x_advance;
}

typedef enum align { ALIGN_LEFT, ALIGN_MIDDLE, ALIGN_RIGHT } align;

/* Writes a text with its base line at y, smaller or cut where it is wider than `most`. */
static void write_text(const sketch *s, const char *string, double size, align side, double x,
                       double y, double most)
{
    char line[512];
    clean(string, line, sizeof line - 4);
    cairo_set_font_size(s->pen, size);
    const double width = text_width(s, line);
    if (width > most) cairo_set_font_size(s->pen, fmax(0.7, most / width) * size);
    for (size_t n = strlen(line); n > 0 && text_width(s, line) > 1.001 * most;) {
        while (n > 0 && ((unsigned char)line[--n] & 0xc0) == 0x80) {
        }
        strcpy(line + n, "...");
    }
    const double part = side == ALIGN_LEFT ? 0.0 : side == ALIGN_MIDDLE ? 0.5 : 1.0;
    cairo_move_to(s->pen, x - part * text_width(s, line), y);
    if (cairo_surface_get_type(cairo_get_target(s->pen)) != CAIRO_SURFACE_TYPE_SVG) {
        cairo_show_text(s->pen, line);
        return;
    }
    cairo_text_path(s->pen, line); /* plain paths: not all that show SVG know its symbols */
    cairo_fill(s->pen);
}

static void set_font(const sketch *s, bool bold)
{
    cairo_select_font_face(s->pen, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
}

/* --- colours --- */

/* Top of the scale: the first of 1, 1.2, 1.5, 2, ... times a power of ten that is not exceeded. */
static double top_of_scale(double brightest)
{
    static const double STEPS[] = {1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
    if (!(brightest > 0.0)) return 1.0;
    const double decade = pow(10.0, floor(log10(brightest)));
    for (size_t k = 0; k < sizeof STEPS / sizeof *STEPS; k++)
        if (brightest <= STEPS[k] * decade * (1 + 1e-12)) return STEPS[k] * decade;
    return 10.0 * decade;
}

/* Place of a radiance factor on the scale, 0 to 1. */
static double on_scale(const sketch *s, double radiance)
{
    const double top = top_of_scale(s->scene->brightest);
    if (!s->style.logarithmic) return radiance / top;
    return radiance > 0.0 ? fmax(0.0, 1.0 + log10(radiance / top) / DECADES) : 0.0;
}

/* Surfaces that look aside are a little darker, so that forms are seen where colours do not stand
 * for brightness. In 16 steps: pictures keep pieces of one colour together. */
static double shade(double facing)
{
    return 0.55 + 0.45 * floor(16.0 * facing) / 16.0;
}

static colour colour_of_piece(const sketch *s, const glint_view_piece *p)
{
    if (p->light == GLINT_PIECE_BACK) return BACK_COLOUR;
    const bool lit = p->light == GLINT_PIECE_LIT, shadowed = p->light == GLINT_PIECE_SHADOWED;
    if (s->style.colour == GLINT_COLOUR_MATERIAL) {
        const double light = lit ? 1.0 : shadowed ? 0.42 : 0.25;
        return colour_dim(colour_of_set(p->material), light * shade(p->facing));
    }
    if (shadowed) return colour_dim(SHADOW_COLOUR, shade(p->facing));
    if (!lit) return colour_dim(AWAY_COLOUR, shade(p->facing));
    if (s->style.colour == GLINT_COLOUR_LIGHT) return colour_dim(LIT_COLOUR, shade(p->facing));
    /* in 256 steps, for the same reason */
    return colour_scale(round(255.0 * on_scale(s, p->radiance_factor)) / 255.0);
}

/* --- the satellite --- */

/* Chooses scale and place so that it fits between the margins, the origin on whole px. */
static void fit(sketch *s)
{
    const glint_view_scene *scene = s->scene;
    const double left = MARGIN, right = s->width - (s->is_bare ? MARGIN : PANEL + MARGIN);
    const double top = s->is_bare ? MARGIN : HEAD,
                 bottom = s->height - (s->is_bare ? MARGIN : FOOT);
    const double wide = scene->hi_m[0] - scene->lo_m[0], high = scene->hi_m[1] - scene->lo_m[1];
    s->scale = fmin((right - left) / wide, (bottom - top) / high);
    if (!isfinite(s->scale)) s->scale = 1.0; /* nothing is seen */
    s->at[0] = 0.5 * (left + right) - 0.5 * s->scale * (scene->lo_m[0] + scene->hi_m[0]);
    s->at[1] = 0.5 * (top + bottom) + 0.5 * s->scale * (scene->lo_m[1] + scene->hi_m[1]);
}

static double x_of(const sketch *s, const double point_m[3])
{
    return s->at[0] + s->scale * point_m[0];
}

static double y_of(const sketch *s, const double point_m[3])
{
    return s->at[1] - s->scale * point_m[1];
}

/* A piece and what it is sorted by. */
typedef struct painted {
    const glint_view_piece *piece;
    size_t index;
    colour colour;
    bool is_front;
} painted;

/* Backs first: where one lies in the plane of another facet, that one shows. Then by colour. */
static int compare_painted(const void *a, const void *b)
{
    const painted *p = a, *q = b;
    if (p->is_front != q->is_front) return p->is_front ? 1 : -1;
    const double d[3] = {p->colour.red - q->colour.red, p->colour.green - q->colour.green,
                         p->colour.blue - q->colour.blue};
    for (int k = 0; k < 3; k++)
        if (d[k] != 0.0) return d[k] < 0.0 ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

static bool is_same_paint(const painted *p, const painted *q)
{
    return p->is_front == q->is_front && p->colour.red == q->colour.red &&
           p->colour.green == q->colour.green && p->colour.blue == q->colour.blue;
}

static void add_path(const sketch *s, const glint_view_piece *p)
{
    for (size_t k = 0; k < p->n_points; k++) {
        const double x = x_of(s, p->points[k]), y = y_of(s, p->points[k]);
        if (k == 0)
            cairo_move_to(s->pen, x, y);
        else
            cairo_line_to(s->pen, x, y);
    }
    cairo_close_path(s->pen);
}

/* Pieces of one colour are one path, which leaves no seams between them; a thin line in the same
 * colour closes those to others, which smoothed edges would leave. */
static glint_status paint_pieces(const sketch *s, glint_error *error)
{
    static const double SEAM = 0.6;
    size_t n;
    const glint_view_piece *pieces = glint_view_pieces(s->view, &n);
    painted *list = malloc((n + 1) * sizeof *list);
    if (!list) return error_no_memory(error);
    for (size_t k = 0; k < n; k++)
        list[k] = (painted){&pieces[k], k, colour_of_piece(s, &pieces[k]),
                            pieces[k].light != GLINT_PIECE_BACK};
    qsort(list, n, sizeof *list, compare_painted);
    cairo_set_line_join(s->pen, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(s->pen, SEAM);
    for (size_t k = 0; k < n; k++) {
        add_path(s, list[k].piece);
        if (k + 1 < n && is_same_paint(&list[k], &list[k + 1])) continue;
        set_colour(s->pen, list[k].colour);
        cairo_fill_preserve(s->pen);
        cairo_stroke(s->pen);
    }
    free(list);
    return GLINT_OK;
}

/* Whether an edge is drawn, which is `length` long: ends, outlines, and where the surface turns or
 * changes. */
static bool is_drawn(const glint_view_edge *e, double length)
{
    static const double LEAST_TURN = 0.5;    /* rad; what turns less is the net of a mesh */
    static const double LEAST_LENGTH = 0.15; /* what rounding leaves of an edge makes no dot */
    static const double LEAST_FOLD = 4;      /* of crinkled foil: smaller ones are only a clutter */
    if (length < LEAST_LENGTH) return false;
    const bool is_flat = e->turn_rad > 0 && e->turn_rad < LEAST_TURN;
    if (e->is_outline && is_flat && !e->is_smooth) return length >= LEAST_FOLD;
    if (e->is_outline || e->parts_materials) return true;
    return !e->is_smooth && !is_flat;
}

/* A pale line below each dark one shows it on dark surfaces, too. */
static void draw_edges(const sketch *s)
{
    size_t n;
    const glint_view_edge *edges = glint_view_edges(s->view, &n);
    cairo_set_line_cap(s->pen, CAIRO_LINE_CAP_ROUND);
    for (int round = 0; round < 2; round++) {
        for (size_t k = 0; k < n; k++) {
            const double *from = edges[k].from_m, *to = edges[k].to_m;
            const double length = s->scale * hypot(to[0] - from[0], to[1] - from[1]);
            if (!is_drawn(&edges[k], length)) continue;
            cairo_move_to(s->pen, x_of(s, from), y_of(s, from));
            cairo_line_to(s->pen, x_of(s, to), y_of(s, to));
        }
        if (round == 0)
            cairo_set_source_rgba(s->pen, 1, 1, 1, 0.35);
        else
            cairo_set_source_rgba(s->pen, INK.red, INK.green, INK.blue, 0.9);
        cairo_set_line_width(s->pen, round == 0 ? 2.2 : 0.9);
        cairo_stroke(s->pen);
    }
}

/* --- the head --- */

static void write_moment(const sketch *s, char *out, size_t size)
{
    const glint_view_scene *scene = s->scene;
    const glint_utc *u = &scene->utc;
    int n = 0;
    if (scene->is_model) {
        n = snprintf(out, size, "a model");
    } else if (scene->has_utc) {
        n = snprintf(out, size, "%04d-%02d-%02d %02d:%02d:%02d", u->year, u->month, u->day, u->hour,
                     u->minute, u->second);
        if (u->microsecond)
            n += snprintf(out + n, size - (size_t)n, ".%03d", u->microsecond / 1000);
        n += snprintf(out + n, size - (size_t)n, " UTC");
    } else {
        n = snprintf(out, size, "row %lld, t = %g s", (long long)scene->row, scene->t_s);
    }
    if (scene->has_magnitude)
        n += snprintf(out + n, size - (size_t)n, ",  %s = %.2f mag", scene->band, scene->magnitude);
    else if (scene->below_horizon)
        n += snprintf(out + n, size - (size_t)n, ",  below the horizon");
    else if (scene->sunlit_fraction <= 0)
        n += snprintf(out + n, size - (size_t)n, ",  dark");
    if (scene->sunlit_fraction <= 0)
        snprintf(out + n, size - (size_t)n, ",  in the Earth's umbra");
    else if (scene->sunlit_fraction < 1)
        snprintf(out + n, size - (size_t)n, ",  in the Earth's penumbra (%.0f %% of the Sun)",
                 100 * scene->sunlit_fraction);
}

static void write_viewer(const sketch *s, char *out, size_t size)
{
    static const char *const FROM[] = {"seen by the observer", "seen from the Sun",
                                       "seen from a direction in the body frame"};
    const glint_view_scene *scene = s->scene;
    const bool is_aside = scene->is_model && scene->from == GLINT_FROM_OBSERVER;
    int n = snprintf(out, size, "%s", FROM[is_aside ? GLINT_FROM_DIRECTION : scene->from]);
    if (scene->has_range)
        n += snprintf(out + n, size - (size_t)n, " at %.*f km", scene->range_m < 1e5 ? 3 : 0,
                      scene->range_m / 1000);
    n += snprintf(out + n, size - (size_t)n, ",  phase angle %.1f\302\260",
                  scene->phase_angle_rad / DEG);
    if (!scene->has_shadows)
        n += snprintf(out + n, size - (size_t)n, ",  without its shadows on itself");
    if (scene->hinges_held) snprintf(out + n, size - (size_t)n, ",  moving hinges at 0");
}

static void draw_head(const sketch *s)
{
    char line[256];
    const double most = s->width - 2 * MARGIN;
    const char *title = s->scene->title[0] ? s->scene->title : "Satellite";
    set_colour(s->pen, INK);
    set_font(s, true);
    write_text(s, title, TITLE_SIZE, ALIGN_LEFT, MARGIN, 46, most);
    set_font(s, false);
    write_moment(s, line, sizeof line);
    write_text(s, line, TEXT_SIZE, ALIGN_LEFT, MARGIN, 74, most);
    set_colour(s->pen, PALE_INK);
    write_viewer(s, line, sizeof line);
    write_text(s, line, SMALL_SIZE, ALIGN_LEFT, MARGIN, 96, most);
}

/* --- the scale bar --- */

/* The longest of 1, 2, 5 times a power of ten that is not above `most`. */
static double round_below(double most)
{
    const double decade = pow(10.0, floor(log10(most) + 1e-12));
    return (most >= 5 * decade ? 5 : most >= 2 * decade ? 2 : 1) * decade;
}

static void length_text(double length_m, char *out, size_t size)
{
    if (length_m < 0.0099)
        snprintf(out, size, "%g mm", 1e3 * length_m);
    else if (length_m < 0.99)
        snprintf(out, size, "%g cm", 1e2 * length_m);
    else if (length_m < 999)
        snprintf(out, size, "%g m", length_m);
    else
        snprintf(out, size, "%g km", 1e-3 * length_m);
}

static void draw_scale_bar(const sketch *s)
{
    enum { MOST = 220 };
    char label[32];
    const double length_m = round_below(MOST / s->scale), length = length_m * s->scale;
    const double x = MARGIN, y = s->height - 26, tick = 5;
    length_text(length_m, label, sizeof label);
    set_colour(s->pen, INK);
    cairo_set_line_width(s->pen, 2);
    cairo_set_line_cap(s->pen, CAIRO_LINE_CAP_BUTT);
    cairo_move_to(s->pen, x + 1, y - tick);
    cairo_line_to(s->pen, x + 1, y);
    cairo_line_to(s->pen, x + length - 1, y);
    cairo_line_to(s->pen, x + length - 1, y - tick);
    cairo_set_line_join(s->pen, CAIRO_LINE_JOIN_MITER);
    cairo_stroke(s->pen);
    write_text(s, label, TEXT_SIZE, ALIGN_LEFT, x + length + 10, y + 2, 200);
}

/* --- what the colours mean --- */

static void draw_swatch(const sketch *s, double y, colour c, const char *name)
{
    const double x = s->width - PANEL, size = 18;
    cairo_rectangle(s->pen, x, y - 14, size, size);
    set_colour(s->pen, c);
    cairo_fill_preserve(s->pen);
    set_colour(s->pen, INK);
    cairo_set_line_width(s->pen, 0.8);
    cairo_stroke(s->pen);
    write_text(s, name, SMALL_SIZE, ALIGN_LEFT, x + size + 10, y, PANEL - MARGIN - size - 10);
}

static void draw_heading(const sketch *s, double y, const char *heading)
{
    set_colour(s->pen, INK);
    set_font(s, true);
    write_text(s, heading, SMALL_SIZE, ALIGN_LEFT, s->width - PANEL, y, PANEL - MARGIN);
    set_font(s, false);
}

static void draw_tick(const sketch *s, double x, double y, double value)
{
    char label[32];
    snprintf(label, sizeof label, "%.3g", value);
    set_colour(s->pen, INK);
    cairo_set_line_width(s->pen, 1);
    cairo_move_to(s->pen, x, y);
    cairo_line_to(s->pen, x + 6, y);
    cairo_stroke(s->pen);
    write_text(s, label, SMALL_SIZE, ALIGN_LEFT, x + 11, y + 5, 80);
}

/* A tick at every power of ten. */
static void draw_decades(const sketch *s, double x, double y, double height, double top)
{
    const int highest = (int)floor(log10(top) + 1e-9);
    if (log10(top) - highest > 0.3) draw_tick(s, x, y, top);
    for (int k = highest; k >= highest - DECADES; k--) {
        const double below = (log10(top) - k) / DECADES;
        if (below <= 1 + 1e-9) draw_tick(s, x, y + height * below, pow(10.0, k));
    }
}

/* A tick at every fourth or fifth of the top, whichever gives the rounder numbers. */
static void draw_steps(const sketch *s, double x, double y, double height, double top)
{
    const int first_digits = (int)lround(10 * top / pow(10.0, floor(log10(top) + 1e-9)));
    const int n = first_digits == 10 || first_digits % 4 ? 5 : 4;
    for (int k = 0; k <= n; k++)
        draw_tick(s, x, y + height * (n - k) / n, top * k / n);
}

/* Scale of the radiance factor; returns the y below it. */
static double draw_colour_bar(const sketch *s, double y)
{
    enum { HEIGHT = 230, WIDTH = 22, N_STEPS = 115 };
    const double x = s->width - PANEL, top = top_of_scale(s->scene->brightest);
    draw_heading(s, y, "radiance factor");
    set_colour(s->pen, PALE_INK);
    write_text(s, "1: a white plate that faces the Sun", SMALL_SIZE - 2, ALIGN_LEFT, x, y + 18,
               PANEL - MARGIN);
    y += 34;
    for (int k = N_STEPS; k > 0; k--) { /* downwards, each as far as the end: without seams */
        cairo_rectangle(s->pen, x, y + HEIGHT - (double)HEIGHT * k / N_STEPS, WIDTH,
                        (double)HEIGHT * k / N_STEPS);
        set_colour(s->pen, colour_scale((k - 0.5) / N_STEPS));
        cairo_fill(s->pen);
    }
    cairo_rectangle(s->pen, x, y, WIDTH, HEIGHT);
    set_colour(s->pen, INK);
    cairo_set_line_width(s->pen, 0.8);
    cairo_stroke(s->pen);
    if (s->style.logarithmic)
        draw_decades(s, x + WIDTH, y, HEIGHT, top);
    else
        draw_steps(s, x + WIDTH, y, HEIGHT, top);
    return y + HEIGHT + 36;
}

/* What kinds of light there are in the picture. */
static void find_lights(const sketch *s, bool lights[4])
{
    size_t n;
    const glint_view_piece *pieces = glint_view_pieces(s->view, &n);
    memset(lights, 0, 4 * sizeof *lights);
    for (size_t k = 0; k < n; k++)
        lights[pieces[k].light] = true;
}

/* Materials that are seen, as many as there is room for above `end`. */
static double draw_materials(const sketch *s, double y, double end)
{
    size_t n;
    int left = 0;
    const glint_view_piece *pieces = glint_view_pieces(s->view, &n);
    draw_heading(s, y, "materials");
    y += 28;
    for (int m = 0; glint_view_material(s->view, (size_t)m); m++) {
        bool seen = false;
        for (size_t k = 0; k < n && !seen; k++)
            seen = pieces[k].material == m;
        if (!seen) continue;
        if (y + 26 > end) {
            left++;
            continue;
        }
        draw_swatch(s, y, colour_of_set(m), glint_view_material(s->view, (size_t)m));
        y += 26;
    }
    if (left) {
        char line[48];
        snprintf(line, sizeof line, "and %d more", left);
        write_text(s, line, SMALL_SIZE, ALIGN_LEFT, s->width - PANEL, y, PANEL - MARGIN);
        y += 26;
    }
    return y;
}

/* What stands for light; returns the y below it. */
static double draw_lit(const sketch *s, double y, bool any_lit)
{
    if (s->style.colour == GLINT_COLOUR_BRIGHTNESS && s->scene->brightest > 0)
        return draw_colour_bar(s, y);
    const bool by_light = s->style.colour == GLINT_COLOUR_LIGHT;
    draw_heading(s, y, by_light ? "light" : "nothing lit is seen");
    y += 28;
    if (!by_light || !any_lit) return y;
    draw_swatch(s, y, LIT_COLOUR, "lit");
    return y + 26;
}

/* The legend, above `end`. */
static void draw_legend(const sketch *s, double end)
{
    bool lights[4];
    double y = HEAD + 30;
    find_lights(s, lights);
    const bool shadowed = lights[GLINT_PIECE_SHADOWED], away = lights[GLINT_PIECE_TURNED_AWAY];
    if (s->style.colour == GLINT_COLOUR_MATERIAL) {
        y = draw_materials(s, y, end - 4 * 26) + 8;
        set_colour(s->pen, PALE_INK);
        if (shadowed || away)
            write_text(s, "darker: in shadow; darkest: turned away", SMALL_SIZE - 2, ALIGN_LEFT,
                       s->width - PANEL, y, PANEL - MARGIN);
        set_colour(s->pen, INK);
        y += 28;
    } else {
        y = draw_lit(s, y, lights[GLINT_PIECE_LIT]);
        if (shadowed) draw_swatch(s, y, SHADOW_COLOUR, "in shadow");
        y += shadowed ? 26 : 0;
        const bool umbra = s->scene->sunlit_fraction <= 0;
        if (away)
            draw_swatch(s, y, AWAY_COLOUR, umbra ? "without sunlight" : "turned from the Sun");
        y += away ? 26 : 0;
    }
    if (lights[GLINT_PIECE_BACK]) draw_swatch(s, y, BACK_COLOUR, "back, black");
}

/* --- directions --- */

enum { COMPASS = 84 }; /* radius: length of a unit vector */

/* A direction along the line of sight: a point to the viewer, a cross away from him. */
static void draw_point(const sketch *s, const double centre[2], bool to_viewer)
{
    static const double RADIUS = 6, DOT = 2;
    cairo_new_sub_path(s->pen);
    cairo_arc(s->pen, centre[0], centre[1], RADIUS, 0, TWO_PI);
    cairo_stroke(s->pen);
    if (to_viewer) {
        cairo_arc(s->pen, centre[0], centre[1], DOT, 0, TWO_PI);
        cairo_fill(s->pen);
        return;
    }
    const double d = RADIUS * sqrt(0.5);
    cairo_move_to(s->pen, centre[0] - d, centre[1] - d);
    cairo_line_to(s->pen, centre[0] + d, centre[1] + d);
    cairo_move_to(s->pen, centre[0] - d, centre[1] + d);
    cairo_line_to(s->pen, centre[0] + d, centre[1] - d);
    cairo_stroke(s->pen);
}

/* The line and the tip of an arrow `length` > 0 long along the unit vector (ux, uy). */
static void draw_shaft(const sketch *s, const double centre[2], double ux, double uy, double length,
                       bool is_broken)
{
    const double dashes[] = {4, 4}, head = fmin(10, 0.5 * length), half = 0.4 * head;
    const double x = centre[0] + length * ux, y = centre[1] + length * uy;
    const double neck_x = x - head * ux, neck_y = y - head * uy;
    if (is_broken) cairo_set_dash(s->pen, dashes, 2, 0);
    cairo_move_to(s->pen, centre[0], centre[1]);
    cairo_line_to(s->pen, neck_x, neck_y);
    cairo_stroke(s->pen);
    cairo_set_dash(s->pen, NULL, 0, 0);
    cairo_move_to(s->pen, x, y);
    cairo_line_to(s->pen, neck_x - half * uy, neck_y + half * ux);
    cairo_line_to(s->pen, neck_x + half * uy, neck_y - half * ux);
    cairo_close_path(s->pen);
    cairo_fill(s->pen);
}

/* An arrow along a unit vector, broken where it points away from the viewer; its name beyond the
 * tip. */
static void draw_arrow(const sketch *s, const double centre[2], const double v[3], colour c,
                       double width, const char *name)
{
    static const double SHORTEST = 14, BEYOND = 15;
    const double across = hypot(v[0], v[1]), length = COMPASS * across;
    set_colour(s->pen, c);
    cairo_set_line_width(s->pen, width);
    cairo_set_line_cap(s->pen, CAIRO_LINE_CAP_BUTT);
    if (length < SHORTEST) {
        draw_point(s, centre, v[2] > 0);
        write_text(s, name, SMALL_SIZE, ALIGN_MIDDLE, centre[0] + 17, centre[1] - 7, 60);
        return;
    }
    const double ux = v[0] / across, uy = -v[1] / across, reach = length + BEYOND;
    draw_shaft(s, centre, ux, uy, length, v[2] < 0);
    write_text(s, name, SMALL_SIZE, ALIGN_MIDDLE, centre[0] + reach * ux,
               centre[1] + reach * uy + 5, 60);
}

static void draw_north(const sketch *s, const double centre[2])
{
    set_colour(s->pen, PALE_INK);
    write_text(s, "N", SMALL_SIZE, ALIGN_MIDDLE, centre[0], centre[1] - COMPASS - 26, 40);
    write_text(s, "E", SMALL_SIZE, ALIGN_MIDDLE, centre[0] - COMPASS - 36, centre[1] + 5, 40);
    cairo_set_line_width(s->pen, 1.4);
    cairo_move_to(s->pen, centre[0], centre[1] - COMPASS);
    cairo_line_to(s->pen, centre[0], centre[1] - COMPASS - 7);
    cairo_move_to(s->pen, centre[0] - COMPASS, centre[1]);
    cairo_line_to(s->pen, centre[0] - COMPASS - 7, centre[1]);
    cairo_stroke(s->pen);
}

/* Body axes, the Sun, and north and east on the sky, in a circle of their own. */
static void draw_directions(const sketch *s)
{
    static const char *const NAMES[] = {"x", "y", "z"};
    const glint_view_scene *scene = s->scene;
    const double centre[2] = {s->width - PANEL + COMPASS + 34, s->height - COMPASS - 74};
    cairo_set_line_width(s->pen, 1);
    cairo_set_source_rgb(s->pen, 0.82, 0.82, 0.84);
    cairo_new_sub_path(s->pen);
    cairo_arc(s->pen, centre[0], centre[1], COMPASS, 0, TWO_PI);
    cairo_stroke(s->pen);
    for (int k = 0; k < 3; k++)
        draw_arrow(s, centre, scene->body_axes[k], INK, 1.6, NAMES[k]);
    draw_arrow(s, centre, scene->sun, SUN_COLOUR, 2.4, "Sun");
    if (scene->north_up) draw_north(s, centre);
    set_colour(s->pen, PALE_INK);
    const bool behind = scene->sun[2] < 0;
    write_text(s, behind ? "the Sun is behind the satellite" : "the Sun is on the viewer's side",
               SMALL_SIZE - 2, ALIGN_LEFT, s->width - PANEL, s->height - 26, PANEL - MARGIN);
}

/* --- all of it --- */

static glint_status draw(sketch *s, glint_error *error)
{
    set_font(s, false);
    cairo_scale(s->pen, s->unit, s->unit);
    fit(s);
    const glint_status status = paint_pieces(s, error);
    if (status) return status;
    draw_edges(s);
    if (s->is_bare) return GLINT_OK;
    draw_head(s);
    draw_scale_bar(s);
    draw_legend(s, s->height - 2 * COMPASS - 130);
    draw_directions(s);
    return GLINT_OK;
}

static glint_status read_style(const glint_view_style *given, const char *path,
                               glint_view_style *out, picture_kind *kind, glint_error *error)
{
    *out = given ? *given : (glint_view_style){0};
    if (!out->width && !out->height) out->width = FULL_WIDTH, out->height = FULL_HEIGHT;
    if (out->width < GLINT_VIEW_LEAST_SIZE || out->width > GLINT_VIEW_MOST_SIZE ||
        out->height < GLINT_VIEW_LEAST_SIZE || out->height > GLINT_VIEW_MOST_SIZE)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "a picture of %d x %d is asked for; expected %d to %d px either way",
                         out->width, out->height, (int)GLINT_VIEW_LEAST_SIZE,
                         (int)GLINT_VIEW_MOST_SIZE);
    return picture_find_kind(out->format, path, kind, error);
}

glint_status glint_view_draw_check(const glint_view_style *style, const char *path,
                                   glint_error *error)
{
    glint_view_style read;
    picture_kind kind;
    return read_style(style, path, &read, &kind, error);
}

glint_status glint_view_draw(const glint_view *view, const glint_view_style *style,
                             const char *path, glint_error *error)
{
    sketch s = {.view = view, .scene = glint_view_describe(view)};
    picture_kind kind;
    picture *p;
    glint_status status = read_style(style, path, &s.style, &kind, error);
    if (!status) status = picture_open(path, kind, s.style.width, s.style.height, &p, error);
    if (status) return status;
    s.pen = picture_pen(p);
    s.unit = fmin(s.style.width / (double)FULL_WIDTH, s.style.height / (double)FULL_HEIGHT);
    s.is_bare = s.unit < LEAST_SHRINK;
    s.width = s.style.width / s.unit;
    s.height = s.style.height / s.unit;
    status = draw(&s, error);
    if (!status) return picture_finish(p, error);
    picture_abandon(p);
    return status;
}
