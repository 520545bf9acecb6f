/* A paraboloid of revolution, as antennas have it: a shell without thickness. */
#include "base/vec.h"
#include "facets/revolved.h"

#include <stdlib.h>

enum { RADIUS, DEPTH, SIDES, RINGS, TOLERANCE, CENTRE, AXIS, MATERIAL, BACK_MATERIAL, N_KEYS };

enum { RINGS_MAX = 1000 };

static const primitive_key keys[N_KEYS] = {
    [RADIUS] = LENGTH_KEY("radius_m",
                          "radius of the rim; the corners of the facets lie on the paraboloid"),
    [DEPTH] = LENGTH_KEY("depth_m", "distance of the rim from the vertex along the axis; the focal "
                                    "length is radius_m^2 / (4 depth_m)"),
    [SIDES] = SIDES_KEY,
    [RINGS] = {.name = "rings",
               .unit = "",
               .doc = "number of rings of facets, equally wide across the axis",
               .kind = KEY_COUNT,
               .def = {12},
               .min = 1,
               .max = RINGS_MAX},
    [TOLERANCE] = TOLERANCE_KEY,
    [CENTRE] = POINT_KEY("centre_m", "the vertex: the deepest point"),
    [AXIS] = AXIS_KEY("direction in which it opens"),
    [MATERIAL] = MATERIAL_KEY("material of the hollow side"),
    [BACK_MATERIAL] = BACK_MATERIAL_KEY("material of the other side"),
};

static glint_status check(const primitive_spec *spec, glint_errors *errors)
{
    const glint_status sides = check_resolution(spec, SIDES, TOLERANCE, errors);
    const glint_status rings = check_resolution(spec, RINGS, TOLERANCE, errors);
    return sides ? sides : rings;
}

/* A chord of z = rho^2/(4 f) between radii that differ by w lies w^2/(16 f) off the curve. */
static int rings_of(const primitive_spec *spec)
{
    if (!spec->given[TOLERANCE]) return (int)spec->value[RINGS][0];
    const double sag = sqrt(spec->value[TOLERANCE][0] * 4.0 / spec->value[DEPTH][0]);
    const double n = ceil(1.0 / sag - 1e-9);
    return n < 1.0 ? 1 : n > RINGS_MAX ? RINGS_MAX : (int)n;
}

/* What the facets of one dish share. */
typedef struct dish {
    const primitive_spec *spec;
    double axis[3], first[3];
    int sides, rings, surface, component;
    facet_list *out;
    glint_error *error;
} dish;

/* The corners on circle k of `rings`; the outermost is the rim. */
static void circle(const dish *d, int k, double (*out)[3])
{
    const double part = (double)k / d->rings;
    double centre_m[3];
    add_scaled3(d->spec->value[CENTRE], part * part * d->spec->value[DEPTH][0], d->axis, centre_m);
    revolved_ring(centre_m, d->axis, d->first, part * d->spec->value[RADIUS][0], d->sides, out);
}

/* The facet between corners k and the next of two circles; the inner circle is a point where inner
 * is NULL. Its tangent runs outwards, as the panels of an antenna do. */
static glint_status add_piece(const dish *d, const double (*inner)[3], const double (*outer)[3],
                              int k)
{
    const primitive_spec *spec = d->spec;
    const int next = (k + 1) % d->sides, before = d->out->n;
    double corners[4][3], outwards[3], low[3];
    int n = 0;
    add3(outer[k], outer[next], outwards);
    if (inner) {
        copy3(inner[next], corners[n++]), copy3(inner[k], corners[n++]);
        add3(inner[k], inner[next], low);
    } else {
        copy3(spec->value[CENTRE], corners[n++]);
        scale3(spec->value[CENTRE], 2.0, low);
    }
    copy3(outer[k], corners[n++]), copy3(outer[next], corners[n++]);
    sub3(outwards, low, outwards);
    const glint_status status =
        add_two_sided(d->out, corners, n, outwards, spec->material[MATERIAL],
                      spec->material[BACK_MATERIAL], d->component, d->error);
    for (int f = before; f < d->out->n; f++)
        d->out->items[f].surface = d->surface;
    return status;
}

static glint_status add_pieces(const dish *d, double (*circles)[3])
{
    double(*inner)[3] = circles, (*outer)[3] = circles + d->sides;
    glint_status status = GLINT_OK;
    for (int ring = 1; ring <= d->rings && !status; ring++) {
        double(*swap)[3] = inner;
        inner = outer, outer = swap;
        circle(d, ring, outer);
        for (int k = 0; k < d->sides && !status; k++)
            status = add_piece(d, ring > 1 ? inner : NULL, outer, k);
    }
    return status;
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    const double radius_m = spec->value[RADIUS][0], depth_m = spec->value[DEPTH][0];
    dish d = {.spec = spec,
              .sides = sides_of(spec, SIDES, TOLERANCE, radius_m),
              .rings = rings_of(spec),
              .component = component,
              .out = out,
              .error = error};
    revolved_axes(spec->value[AXIS], d.axis, d.first);
    curved_surface paraboloid = {.kind = SURFACE_PARABOLOID,
                                 .radius_m = 0.5 * radius_m * radius_m / depth_m};
    copy3(spec->value[CENTRE], paraboloid.centre_m);
    copy3(d.axis, paraboloid.axis);
    glint_status status = facet_list_add_surface(out, &paraboloid, &d.surface, error);
    if (status) return status;
    double(*circles)[3] = malloc(2 * (size_t)d.sides * sizeof *circles);
    if (!circles) return error_no_memory(error);
    status = add_pieces(&d, circles);
    free(circles);
    return status;
}

const primitive_kind primitive_dish = {
    .name = "dish",
    .doc = "paraboloid that opens along its axis, a shell without thickness; reflects inside, and "
           "outside "
           "where back_material is given. Tangents: outwards along the shell",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre_key = CENTRE,
};
