/* view_text.c: words in the picture of a satellite. */
#include "output/utf8.h"
#include "output/view_sketch.h"

#include <math.h>
#include <string.h>

void sketch_set_colour(const sketch *s, colour c)
{
    cairo_set_source_rgb(s->pen, c.red, c.green, c.blue);
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

void sketch_write(const sketch *s, const char *string, double size, align side, double x, double y,
                  double most)
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

void sketch_set_font(const sketch *s, bool bold)
{
    cairo_select_font_face(s->pen, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
}
