#include "output/picture.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char *const SUFFIXES[N_PICTURE_KINDS] = {".svg", ".png", ".pdf"};

#ifdef __SANITIZE_ADDRESS__
/* Fontconfig, which finds cairo its fonts, keeps what it found until the process ends: that is no
 * leak, and nothing to talk about. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_options(void);
const char *__lsan_default_options(void)
{
    return "print_suppressions=0";
}
const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig";
}
#endif

struct picture {
    const char *path;
    picture_kind kind;
    text bytes;               /* owned; what becomes of it */
    cairo_surface_t *surface; /* owned */
    cairo_t *pen;             /* owned */
};

glint_status picture_find_kind(const char *format, const char *path, picture_kind *out,
                               glint_error *error)
{
    const size_t n = strlen(path);
    for (int k = 0; k < N_PICTURE_KINDS; k++) {
        const size_t suffix = strlen(SUFFIXES[k]);
        *out = (picture_kind)k;
        if (format && strcasecmp(format, SUFFIXES[k] + 1) == 0) return GLINT_OK;
        if (!format && n > suffix && strcasecmp(path + n - suffix, SUFFIXES[k]) == 0)
            return GLINT_OK;
    }
    if (format)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "'%s' is no format of pictures; expected svg, png or pdf", format);
    return error_set(error, GLINT_ARGUMENT, (place){path, 0, 0},
                     "pictures are written as .svg, .png or .pdf; expected a name that ends so");
}

static cairo_status_t collect(void *bytes, const unsigned char *data, unsigned n)
{
    text *t = bytes;
    text_append(t, (const char *)data, n);
    return t->failed ? CAIRO_STATUS_NO_MEMORY : CAIRO_STATUS_SUCCESS;
}

static cairo_surface_t *make_surface(picture *p, int width, int height)
{
    static const double POINTS_PER_PX = 72.0 / 96.0;
    if (p->kind == PICTURE_PNG)
        return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    if (p->kind == PICTURE_SVG) {
        cairo_surface_t *svg =
            cairo_svg_surface_create_for_stream(collect, &p->bytes, width, height);
        cairo_svg_surface_set_document_unit(svg, CAIRO_SVG_UNIT_PX);
        return svg;
    }
    cairo_surface_t *pdf = cairo_pdf_surface_create_for_stream(
        collect, &p->bytes, width * POINTS_PER_PX, height * POINTS_PER_PX);
    /* Else it is the time of day, and no two files are the same. */
    cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
    return pdf;
}

glint_status picture_open(const char *path, picture_kind kind, int width, int height, picture **out,
                          glint_error *error)
{
    *out = NULL;
    picture *p = calloc(1, sizeof *p);
    if (!p) return error_no_memory(error);
    p->path = path;
    p->kind = kind;
    p->surface = make_surface(p, width, height);
    p->pen = cairo_create(p->surface);
    if (kind == PICTURE_PDF) cairo_scale(p->pen, 72.0 / 96.0, 72.0 / 96.0);
    cairo_set_source_rgb(p->pen, 1, 1, 1);
    cairo_paint(p->pen);
    if (cairo_status(p->pen) != CAIRO_STATUS_SUCCESS) {
        picture_abandon(p);
        return error_no_memory(error);
    }
    *out = p;
    return GLINT_OK;
}

cairo_t *picture_pen(picture *p)
{
    return p->pen;
}

glint_status picture_finish(picture *p, glint_error *error)
{
    cairo_status_t drawn = cairo_status(p->pen);
    if (!drawn && p->kind == PICTURE_PNG)
        drawn = cairo_surface_write_to_png_stream(p->surface, collect, &p->bytes);
    cairo_surface_finish(p->surface);
    if (!drawn) drawn = cairo_surface_status(p->surface);
    glint_status status = GLINT_OK;
    if (p->bytes.failed || drawn == CAIRO_STATUS_NO_MEMORY)
        status = error_no_memory(error);
    else if (drawn)
        status = error_set(error, GLINT_INTERNAL, (place){p->path, 0, 0},
                           "cairo could not draw the picture: %s", cairo_status_to_string(drawn));
    if (!status) status = glint_text_write(p->path, p->bytes.data, p->bytes.length, error);
    picture_abandon(p);
    return status;
}

void picture_abandon(picture *p)
{
    if (!p) return;
    cairo_destroy(p->pen);
    cairo_surface_destroy(p->surface); /* may still write to bytes */
    text_free(&p->bytes);
    free(p);
}
