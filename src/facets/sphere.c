/* A sphere of flat triangles: the icosahedron, its faces divided in four again and again. */
#include "base/vec.h"
#include "facets/revolved.h"

enum { RADIUS, CENTRE, FACETS, TOLERANCE, MATERIAL, N_KEYS };

static const primitive_key keys[N_KEYS] = {
    [RADIUS] = LENGTH_KEY("radius_m", "radius of the sphere through the vertices"),
    [CENTRE] = CENTRE_KEY,
    [FACETS] = {.name = "facets",
                .unit = "",
                .doc = "number of triangles: 20 times a power of 4",
                .kind = KEY_COUNT,
                .def = {1280},
                .min = 20,
                .max = PRIMITIVE_MAX_FACETS},
    [TOLERANCE] = TOLERANCE_KEY,
    [MATERIAL] = MATERIAL_KEY("material"),
};

#define GOLDEN_RATIO 1.61803398874989484820

/* The icosahedron, edge 2. */
static const double corners[12][3] = {
    {0, 1, GOLDEN_RATIO}, {0, 1, -GOLDEN_RATIO}, {0, -1, GOLDEN_RATIO}, {0, -1, -GOLDEN_RATIO},
    {1, GOLDEN_RATIO, 0}, {1, -GOLDEN_RATIO, 0}, {-1, GOLDEN_RATIO, 0}, {-1, -GOLDEN_RATIO, 0},
    {GOLDEN_RATIO, 0, 1}, {-GOLDEN_RATIO, 0, 1}, {GOLDEN_RATIO, 0, -1}, {-GOLDEN_RATIO, 0, -1},
};

static glint_status check(const primitive_spec *spec, glint_errors *errors)
{
    const glint_status both = check_resolution(spec, FACETS, TOLERANCE, errors);
    if (both) return both;
    if (!primitive_key_sound(spec, FACETS)) return GLINT_OK; /* said already */
    const int wanted = (int)spec->value[FACETS][0];
    int below = 20;
    while (below <= wanted / 4)
        below *= 4;
    if (below == wanted) return GLINT_OK;
    return errors_add(errors, GLINT_INPUT, spec->key_place[FACETS],
                      "facets is %d; expected 20 times a power of 4, the nearest of which are %d "
                      "and %d",
                      wanted, below, 4 * below);
}

/* What all triangles of one sphere share while it is built. */
typedef struct sphere_builder {
    const double *centre_m;
    double radius_m;
    int material, component, surface;
    facet_list *out;
    glint_error *error;
} sphere_builder;

/* Appends the flat triangle over three points of the unit sphere. Its tangent is eastward about z:
 * z x normal, and x where the normal is along z. */
static glint_status add_triangle(const sphere_builder *s, const double a[3], const double b[3],
                                 const double c[3])
{
    double ab[3], ac[3], across[3], normal[3], vertices[3][3];
    sub3(b, a, ab), sub3(c, a, ac);
    cross3(ab, ac, across);
    unit3(across, normal);
    double east[3] = {-normal[1], normal[0], 0};
    if (norm3(east) <= PARALLEL_RAD) east[0] = 1, east[1] = 0;
    add_scaled3(s->centre_m, s->radius_m, a, vertices[0]);
    add_scaled3(s->centre_m, s->radius_m, b, vertices[1]);
    add_scaled3(s->centre_m, s->radius_m, c, vertices[2]);
    const glint_status status =
        facet_list_add(s->out, vertices, 3, east, s->material, s->component, s->error);
    if (!status) s->out->items[s->out->n - 1].surface = s->surface;
    return status;
}

/* Point of the unit sphere midway between two others: the same to the last bit from either side. */
static void midway(const double a[3], const double b[3], double out[3])
{
    double sum[3];
    add3(a, b, sum);
    unit3(sum, out);
}

/* Divides a triangle `levels` times into four. */
static glint_status divide(const sphere_builder *s, const double a[3], const double b[3],
                           const double c[3], int levels)
{
    if (levels == 0) return add_triangle(s, a, b, c);
    double ab[3], bc[3], ca[3];
    midway(a, b, ab), midway(b, c, bc), midway(c, a, ca);
    glint_status status = divide(s, a, ab, ca, levels - 1);
    if (!status) status = divide(s, ab, b, bc, levels - 1);
    if (!status) status = divide(s, ca, bc, c, levels - 1);
    if (!status) status = divide(s, ab, bc, ca, levels - 1);
    return status;
}

static bool are_neighbours(int a, int b)
{
    double d[3];
    sub3(corners[a], corners[b], d);
    return dot3(d, d) < 5.0; /* 4 for an edge; the next distance squared is 10.5 */
}

/* Divides the face with corners a < b < c, turned so that it is anticlockwise from outside. */
static glint_status divide_face(const sphere_builder *s, int a, int b, int c, int levels)
{
    double p[3][3], normal[3];
    cross3(corners[a], corners[b], normal);
    const bool outwards = dot3(normal, corners[c]) > 0.0;
    unit3(corners[a], p[0]);
    unit3(corners[outwards ? b : c], p[1]);
    unit3(corners[outwards ? c : b], p[2]);
    return divide(s, p[0], p[1], p[2], levels);
}

/* How often the faces of the icosahedron are divided. The middle one of the four parts of an
 * equilateral triangle is the largest, again equilateral, and its corners lie at half the tangent
 * of the angle from its centre: edges are halved where the perpendicular of the triangle meets
 * them. */
static int levels_of(const primitive_spec *spec)
{
    enum { MOST_LEVELS = 9 }; /* 20 4^9 = PRIMITIVE_MAX_FACETS */
    int levels = 0;
    if (!spec->given[TOLERANCE]) {
        for (int n = (int)spec->value[FACETS][0]; n > 20; n /= 4)
            levels++;
        return levels;
    }
    double tangent = 3.0 - sqrt(5.0); /* from the centre of a face of the icosahedron to a corner */
    while (levels < MOST_LEVELS &&
           spec->value[RADIUS][0] * (1.0 - 1.0 / hypot(1.0, tangent)) > spec->value[TOLERANCE][0]) {
        tangent *= 0.5;
        levels++;
    }
    return levels;
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    const int levels = levels_of(spec), n = 20 << 2 * levels;
    curved_surface sphere = {.kind = SURFACE_SPHERE, .radius_m = spec->value[RADIUS][0]};
    copy3(spec->value[CENTRE], sphere.centre_m);
    int surface = 0;
    glint_status status = facet_list_reserve(out, n, 3 * n, error);
    if (!status) status = facet_list_add_surface(out, &sphere, &surface, error);
    const sphere_builder s = {spec->value[CENTRE],
                              spec->value[RADIUS][0],
                              spec->material[MATERIAL],
                              component,
                              surface,
                              out,
                              error};
    for (int a = 0; a < 12 && !status; a++)
        for (int b = a + 1; b < 12 && !status; b++)
            for (int c = b + 1; c < 12 && !status; c++)
                if (are_neighbours(a, b) && are_neighbours(b, c) && are_neighbours(c, a))
                    status = divide_face(&s, a, b, c, levels);
    return status;
}

const primitive_kind primitive_sphere = {
    .name = "sphere",
    .doc =
        "sphere of flat triangles, an icosahedron divided in four again and again; vertices on the "
        "sphere; tangents eastward about z (x where the normal is along z)",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre_key = CENTRE,
};
