/* A single flat convex polygon. */
#include "base/constants.h"
#include "base/vec.h"
#include "facets/primitive_kinds.h"

enum { VERTICES, TANGENT, MATERIAL, BACK_MATERIAL, N_KEYS };

static const primitive_key keys[N_KEYS] = {
    [VERTICES] = {.name = "vertices_m",
                  .unit = "m",
                  .doc = "corners of a flat convex polygon, anticlockwise seen from its front",
                  .kind = KEY_POINTS,
                  .required = true,
                  COORDINATE_RANGE},
    [TANGENT] = {.name = "tangent",
                 .unit = "",
                 .doc = "direction made orthogonal to the normal; absent: the first edge",
                 .kind = KEY_DIRECTION},
    [MATERIAL] = MATERIAL_KEY("material of the front"),
    [BACK_MATERIAL] = BACK_MATERIAL_KEY("material of the back"),
};

/* How far a vertex may lie off the plane, or inside the outline, as a fraction of the polygon's
 * size. Leaves room for coordinates written with five digits, and turns the normal by less than
 * 2e-5 rad (4 arcsec), where a specular flash asks for 18 arcsec. */
#define FLATNESS 1e-5
/* Neighbouring vertices nearer than this fraction of the size are the same vertex. */
#define SAME_VERTEX 1e-9
/* Area over size squared below which a polygon is a line. */
#define LINE_AREA 1e-9
/* Sine of the turn below which an edge that goes back lies on the edge before it. */
#define FOLDED_SINE 1e-12

static void centre(const primitive_spec *spec, double out[3])
{
    double sum[3] = {0, 0, 0};
    for (int k = 0; k < spec->n_points; k++)
        add3(sum, spec->points[k], sum);
    scale3(sum, 1.0 / spec->n_points, out);
}

/* Largest distance of a vertex from their mean, m. */
static double size_of(const primitive_spec *spec, const double mean[3])
{
    double size = 0.0, d[3];
    for (int k = 0; k < spec->n_points; k++) {
        sub3(spec->points[k], mean, d);
        size = fmax(size, norm3(d));
    }
    return size;
}

/* Unit normal; returns the area, m^2. */
static double normal_of(const primitive_spec *spec, const double mean[3], double normal[3])
{
    double sum[3] = {0, 0, 0}, a[3], b[3], c[3];
    const int n = spec->n_points;
    for (int k = 0; k < n; k++) {
        sub3(spec->points[k], mean, a);
        sub3(spec->points[(k + 1) % n], mean, b);
        cross3(a, b, c);
        add3(sum, c, sum);
    }
    return 0.5 * unit3(sum, normal);
}

static glint_status check_repeats(const primitive_spec *spec, double size_m, glint_errors *errors)
{
    glint_status status = GLINT_OK;
    const int n = spec->n_points;
    double edge[3];
    for (int k = 0; k < n; k++) {
        const int next = (k + 1) % n;
        sub3(spec->points[next], spec->points[k], edge);
        if (norm3(edge) > SAME_VERTEX * size_m) continue;
        status = errors_add(errors, GLINT_INPUT, spec->key_place[VERTICES],
                            next ? "point %d repeats point %d; expected every corner once"
                                 : "point %d repeats point %d; expected every corner once (the "
                                   "polygon closes by itself)",
                            next ? next + 1 : n, next ? k + 1 : 1);
    }
    return status;
}

static glint_status check_plane(const primitive_spec *spec, const double mean[3], double size_m,
                                const double normal[3], glint_errors *errors)
{
    int worst = 0;
    double off_m = 0.0, d[3];
    for (int k = 0; k < spec->n_points; k++) {
        sub3(spec->points[k], mean, d);
        const double height_m = fabs(dot3(d, normal));
        if (height_m > off_m) off_m = height_m, worst = k;
    }
    if (off_m <= FLATNESS * size_m) return GLINT_OK;
    return errors_add(errors, GLINT_INPUT, spec->key_place[VERTICES],
                      "point %d is %.3g m off the plane of the polygon; expected all points within "
                      "%.3g m of one plane",
                      worst + 1, off_m, FLATNESS * size_m);
}

/* A polygon is convex when no vertex turns right and the turns add to one revolution (a star turns
 * left everywhere, but makes more). Vertices along a straight edge are allowed: they may be corners
 * of neighbouring facets. */
static glint_status check_convex(const primitive_spec *spec, double size_m, const double normal[3],
                                 glint_errors *errors)
{
    const int n = spec->n_points;
    double turned_rad = 0.0;
    for (int k = 0; k < n; k++) {
        double in[3], on[3], chord[3], c[3];
        sub3(spec->points[k], spec->points[(k + n - 1) % n], in);
        sub3(spec->points[(k + 1) % n], spec->points[k], on);
        cross3(in, on, c);
        add3(in, on, chord);
        const double left = dot3(c, normal), ahead = dot3(in, on);
        const bool dented = left < -FLATNESS * size_m * norm3(chord);
        const bool folded = ahead < 0.0 && left <= FOLDED_SINE * norm3(in) * norm3(on);
        if (dented || folded)
            return errors_add(errors, GLINT_INPUT, spec->key_place[VERTICES],
                              "the outline turns inwards at point %d; expected a convex polygon",
                              k + 1);
        turned_rad += atan2(left, ahead);
    }
    if (turned_rad < 1.5 * TWO_PI) return GLINT_OK; /* 1 or 2 revolutions: nothing between */
    return errors_add(errors, GLINT_INPUT, spec->key_place[VERTICES],
                      "the outline crosses itself; expected a convex polygon");
}

static glint_status check(const primitive_spec *spec, glint_errors *errors)
{
    if (!primitive_key_sound(spec, VERTICES)) return GLINT_OK; /* said already */
    double mean[3], normal[3];
    centre(spec, mean);
    const double size_m = size_of(spec, mean);
    glint_status status = check_repeats(spec, size_m, errors);
    if (status) return status;
    if (size_m < LENGTH_MIN_M || normal_of(spec, mean, normal) <= LINE_AREA * size_m * size_m)
        return errors_add(errors, GLINT_INPUT, spec->key_place[VERTICES],
                          "the points enclose no area; expected the corners of a polygon");
    const glint_status flat = check_plane(spec, mean, size_m, normal, errors);
    if (flat) status = flat;
    const glint_status convex = check_convex(spec, size_m, normal, errors);
    if (convex) status = convex;
    const glint_status across = check_tangent(spec, normal, TANGENT, errors);
    return across ? across : status;
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    double tangent[3];
    if (spec->given[TANGENT])
        copy3(spec->value[TANGENT], tangent);
    else
        sub3(spec->points[1], spec->points[0], tangent);
    return add_two_sided(out, spec->points, spec->n_points, tangent, spec->material[MATERIAL],
                         spec->material[BACK_MATERIAL], component, error);
}

const primitive_kind primitive_facet = {
    .name = "facet",
    .doc = "flat convex polygon; rotates about the mean of its corners",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre = centre,
};
