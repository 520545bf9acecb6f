/* view_marks.c: what stands around the satellite in its picture: the head, a scale bar, directions.
 */
#include "base/constants.h"
#include "base/text.h"
#include "output/view_sketch.h"

#include <math.h>
#include <stdio.h>

static const colour SUN_COLOUR = {0.90, 0.55, 0.0};

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
        n += snprintf(out + n, size - (size_t)n, ",  %s = %s mag", scene->band,
                      number_fixed(scene->magnitude, 2).text);
    else if (scene->below_horizon)
        n += snprintf(out + n, size - (size_t)n, ",  below the horizon");
    else if (scene->sunlit_fraction <= 0)
        n += snprintf(out + n, size - (size_t)n, ",  dark");
    if (scene->sunlit_fraction <= 0)
        snprintf(out + n, size - (size_t)n, ",  in umbra");
    else if (scene->sunlit_fraction < 1)
        snprintf(out + n, size - (size_t)n, ",  in penumbra (%.0f %% of the Sun)",
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

void sketch_head(const sketch *s)
{
    char line[256];
    const double most = s->width - 2 * MARGIN;
    const char *title = s->scene->title[0] ? s->scene->title : "Satellite";
    sketch_set_colour(s, ink());
    sketch_set_font(s, true);
    sketch_write(s, title, TITLE_SIZE, ALIGN_LEFT, MARGIN, 46, most);
    sketch_set_font(s, false);
    write_moment(s, line, sizeof line);
    sketch_write(s, line, TEXT_SIZE, ALIGN_LEFT, MARGIN, 74, most);
    sketch_set_colour(s, pale_ink());
    write_viewer(s, line, sizeof line);
    sketch_write(s, line, SMALL_SIZE, ALIGN_LEFT, MARGIN, 96, most);
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

void sketch_scale_bar(const sketch *s)
{
    enum { MOST = 220 };
    char label[32];
    const double length_m = round_below(MOST / s->scale), length = length_m * s->scale;
    const double x = MARGIN, y = s->height - 26, tick = 5;
    length_text(length_m, label, sizeof label);
    sketch_set_colour(s, ink());
    cairo_set_line_width(s->pen, 2);
    cairo_set_line_cap(s->pen, CAIRO_LINE_CAP_BUTT);
    cairo_move_to(s->pen, x + 1, y - tick);
    cairo_line_to(s->pen, x + 1, y);
    cairo_line_to(s->pen, x + length - 1, y);
    cairo_line_to(s->pen, x + length - 1, y - tick);
    cairo_set_line_join(s->pen, CAIRO_LINE_JOIN_MITER);
    cairo_stroke(s->pen);
    sketch_write(s, label, TEXT_SIZE, ALIGN_LEFT, x + length + 10, y + 2, 200);
}

/* --- directions --- */

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
    sketch_set_colour(s, c);
    cairo_set_line_width(s->pen, width);
    cairo_set_line_cap(s->pen, CAIRO_LINE_CAP_BUTT);
    if (length < SHORTEST) {
        draw_point(s, centre, v[2] > 0);
        sketch_write(s, name, SMALL_SIZE, ALIGN_MIDDLE, centre[0] + 17, centre[1] - 7, 60);
        return;
    }
    const double ux = v[0] / across, uy = -v[1] / across, reach = length + BEYOND;
    draw_shaft(s, centre, ux, uy, length, v[2] < 0);
    sketch_write(s, name, SMALL_SIZE, ALIGN_MIDDLE, centre[0] + reach * ux,
                 centre[1] + reach * uy + 5, 60);
}

static void draw_north(const sketch *s, const double centre[2])
{
    sketch_set_colour(s, pale_ink());
    sketch_write(s, "N", SMALL_SIZE, ALIGN_MIDDLE, centre[0], centre[1] - COMPASS - 26, 40);
    sketch_write(s, "E", SMALL_SIZE, ALIGN_MIDDLE, centre[0] - COMPASS - 36, centre[1] + 5, 40);
    cairo_set_line_width(s->pen, 1.4);
    cairo_move_to(s->pen, centre[0], centre[1] - COMPASS);
    cairo_line_to(s->pen, centre[0], centre[1] - COMPASS - 7);
    cairo_move_to(s->pen, centre[0] - COMPASS, centre[1]);
    cairo_line_to(s->pen, centre[0] - COMPASS - 7, centre[1]);
    cairo_stroke(s->pen);
}

void sketch_directions(const sketch *s)
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
        draw_arrow(s, centre, scene->body_axes[k], ink(), 1.6, NAMES[k]);
    draw_arrow(s, centre, scene->sun, SUN_COLOUR, 2.4, "Sun");
    if (scene->north_up) draw_north(s, centre);
    sketch_set_colour(s, pale_ink());
    const bool behind = scene->sun[2] < 0;
    sketch_write(s, behind ? "the Sun is behind the satellite" : "the Sun is on the viewer's side",
                 SMALL_SIZE - 2, ALIGN_LEFT, s->width - PANEL, s->height - 26, PANEL - MARGIN);
}
