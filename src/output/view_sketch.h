/* view_sketch.h: what the files that draw a satellite share; for view_*.c alone. */
#ifndef GLINT_OUTPUT_VIEW_SKETCH_H
#define GLINT_OUTPUT_VIEW_SKETCH_H

#include "output/colour.h"
#include "output/picture.h"

/* Layout, in px of a picture of 1200 x 900; others are scaled. */
enum {
    MARGIN = 36,
    HEAD = 128,   /* title and lines below it */
    FOOT = 64,    /* scale bar */
    PANEL = 300,  /* legend and directions, to the right */
    COMPASS = 84, /* in the circle of directions: length of a unit vector */
    TITLE_SIZE = 26,
    TEXT_SIZE = 18,
    SMALL_SIZE = 15,
    FULL_WIDTH = 1200,
    FULL_HEIGHT = 900
};

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

/* Of lines and words; of lesser ones. */
static inline colour ink(void)
{
    return (colour){0.10, 0.10, 0.12};
}

static inline colour pale_ink(void)
{
    return (colour){0.38, 0.38, 0.42};
}

void sketch_set_colour(const sketch *s, colour c);
void sketch_set_font(const sketch *s, bool bold);

typedef enum align { ALIGN_LEFT, ALIGN_MIDDLE, ALIGN_RIGHT } align;
/* Writes a text with its base line at y, smaller or cut where it is wider than `most`; bytes that
 * are no UTF-8 become blanks. size, x, y, most: layout px. */
void sketch_write(const sketch *s, const char *string, double size, align side, double x, double y,
                  double most);

/* The colour that a piece of the satellite gets. */
colour sketch_piece_colour(const sketch *s, const glint_view_piece *piece);
/* What the colours mean, to the right, above y = `end`. */
void sketch_legend(const sketch *s, double end);

/* Title, moment and viewer, at the top. */
void sketch_head(const sketch *s);
/* A length, at the bottom. */
void sketch_scale_bar(const sketch *s);
/* Body axes, the Sun, and north and east on the sky, in a circle of their own. */
void sketch_directions(const sketch *s);

#endif
