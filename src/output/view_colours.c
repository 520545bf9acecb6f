/* view_colours.c: the colours of a satellite's pieces, and what they mean. */
#include "output/view_sketch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Decades of a logarithmic scale. */
enum { DECADES = 4 };

static const colour LIT_COLOUR = {0.99, 0.86, 0.45}; /* where colours tell light from shadow */
/* Without sunlight: neutral, so that they are not taken for values of the scale. */
static const colour SHADOW_COLOUR = {0.50, 0.52, 0.55}, AWAY_COLOUR = {0.33, 0.34, 0.37},
                    BACK_COLOUR = {0.13, 0.13, 0.14};

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

colour sketch_piece_colour(const sketch *s, const glint_view_piece *p)
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

/* --- what the colours mean --- */

static void draw_swatch(const sketch *s, double y, colour c, const char *name)
{
    const double x = s->width - PANEL, size = 18;
    cairo_rectangle(s->pen, x, y - 14, size, size);
    sketch_set_colour(s, c);
    cairo_fill_preserve(s->pen);
    sketch_set_colour(s, ink());
    cairo_set_line_width(s->pen, 0.8);
    cairo_stroke(s->pen);
    sketch_write(s, name, SMALL_SIZE, ALIGN_LEFT, x + size + 10, y, PANEL - MARGIN - size - 10);
}

static void draw_heading(const sketch *s, double y, const char *heading)
{
    sketch_set_colour(s, ink());
    sketch_set_font(s, true);
    sketch_write(s, heading, SMALL_SIZE, ALIGN_LEFT, s->width - PANEL, y, PANEL - MARGIN);
    sketch_set_font(s, false);
}

static void draw_tick(const sketch *s, double x, double y, double value)
{
    char label[32];
    snprintf(label, sizeof label, "%.3g", value);
    sketch_set_colour(s, ink());
    cairo_set_line_width(s->pen, 1);
    cairo_move_to(s->pen, x, y);
    cairo_line_to(s->pen, x + 6, y);
    cairo_stroke(s->pen);
    sketch_write(s, label, SMALL_SIZE, ALIGN_LEFT, x + 11, y + 5, 80);
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
    sketch_set_colour(s, pale_ink());
    sketch_write(s, "1: a white plate that faces the Sun", SMALL_SIZE - 2, ALIGN_LEFT, x, y + 18,
                 PANEL - MARGIN);
    y += 34;
    for (int k = N_STEPS; k > 0; k--) { /* downwards, each as far as the end: without seams */
        cairo_rectangle(s->pen, x, y + HEIGHT - (double)HEIGHT * k / N_STEPS, WIDTH,
                        (double)HEIGHT * k / N_STEPS);
        sketch_set_colour(s, colour_scale((k - 0.5) / N_STEPS));
        cairo_fill(s->pen);
    }
    cairo_rectangle(s->pen, x, y, WIDTH, HEIGHT);
    sketch_set_colour(s, ink());
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
        sketch_write(s, line, SMALL_SIZE, ALIGN_LEFT, s->width - PANEL, y, PANEL - MARGIN);
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

void sketch_legend(const sketch *s, double end)
{
    bool lights[4];
    double y = HEAD + 30;
    find_lights(s, lights);
    const bool shadowed = lights[GLINT_PIECE_SHADOWED], away = lights[GLINT_PIECE_TURNED_AWAY];
    if (s->style.colour == GLINT_COLOUR_MATERIAL) {
        y = draw_materials(s, y, end - 4 * 26) + 8;
        sketch_set_colour(s, pale_ink());
        if (shadowed || away)
            sketch_write(s, "darker: in shadow; darkest: turned away", SMALL_SIZE - 2, ALIGN_LEFT,
                         s->width - PANEL, y, PANEL - MARGIN);
        sketch_set_colour(s, ink());
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
