/* The picture of a satellite: its pieces in colours, edges, a scale, and what the colours mean. */
#include "output/view_sketch.h"

#include <math.h>
#include <stdlib.h>

/* A picture that shrinks the layout by more has no room for words: it shows the satellite alone. */
static const double LEAST_SHRINK = 0.5;

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
        list[k] = (painted){&pieces[k], k, sketch_piece_colour(s, &pieces[k]),
                            pieces[k].light != GLINT_PIECE_BACK};
    qsort(list, n, sizeof *list, compare_painted);
    cairo_set_line_join(s->pen, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(s->pen, SEAM);
    for (size_t k = 0; k < n; k++) {
        add_path(s, list[k].piece);
        if (k + 1 < n && is_same_paint(&list[k], &list[k + 1])) continue;
        sketch_set_colour(s, list[k].colour);
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
            cairo_set_source_rgba(s->pen, ink().red, ink().green, ink().blue, 0.9);
        cairo_set_line_width(s->pen, round == 0 ? 2.2 : 0.9);
        cairo_stroke(s->pen);
    }
}

/* --- all of it --- */

static glint_status draw(sketch *s, glint_error *error)
{
    sketch_set_font(s, false);
    cairo_scale(s->pen, s->unit, s->unit);
    fit(s);
    const glint_status status = paint_pieces(s, error);
    if (status) return status;
    draw_edges(s);
    if (s->is_bare) return GLINT_OK;
    sketch_head(s);
    sketch_scale_bar(s);
    sketch_legend(s, s->height - 2 * COMPASS - 130);
    sketch_directions(s);
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
