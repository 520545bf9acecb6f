/* picture.h: pictures drawn with cairo, into a file that appears whole or not at all. */
#ifndef GLINT_OUTPUT_PICTURE_H
#define GLINT_OUTPUT_PICTURE_H

#include "base/text.h"

#include <cairo.h>

/* A picture being drawn. */
typedef struct picture picture;

typedef enum picture_kind { PICTURE_SVG, PICTURE_PNG, PICTURE_PDF, N_PICTURE_KINDS } picture_kind;

/* The kind that a format names ("svg", "png", "pdf"), or where that is NULL the suffix of a path.
 * Errors: GLINT_ARGUMENT for others. */
glint_status picture_find_kind(const char *format, const char *path, picture_kind *out,
                               glint_error *error);

/* Begins a picture. path: where it goes; borrowed until the end. width, height: px; of .svg and
 * .pdf in units of 1/96 inch. The ground is white. Errors: GLINT_INTERNAL (memory). */
glint_status picture_open(const char *path, picture_kind kind, int width, int height, picture **out,
                          glint_error *error);
/* What is drawn with, in px, y downwards; borrowed until the end. */
cairo_t *picture_pen(picture *p);
/* Writes the file; frees `p` either way. The same strokes give the same bytes. Errors:
 * GLINT_OUTPUT; GLINT_INTERNAL (memory, or what cairo says). */
glint_status picture_finish(picture *p, glint_error *error);
/* Leaves nothing behind. NULL is fine. */
void picture_abandon(picture *p);

#endif
