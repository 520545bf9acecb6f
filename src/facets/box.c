/* A rectangular box along the axes. */
#include "base/vec.h"
#include "facets/crinkle.h"

enum { SIZE, CENTRE, MATERIAL, FACES, CRINKLE, N_KEYS };

static const primitive_key keys[N_KEYS] = {
    [SIZE] = {.name = "size_m",
              .unit = "m",
              .doc = "lengths along x, y and z",
              .kind = KEY_VECTOR,
              .length = 3,
              .required = true,
              LENGTH_RANGE},
    [CENTRE] = CENTRE_KEY,
    [MATERIAL] =
        {.name = "material",
         .unit = "",
         .doc = "material of all faces that `faces` does not name; may be absent where it names "
                "all six",
         .kind = KEY_MATERIAL},
    [FACES] = {.name = "faces", .unit = "", .doc = "materials of single faces", .kind = KEY_FACES},
    [CRINKLE] = CRINKLE_KEY,
};

static const char *const face_names[6] = {"+x", "-x", "+y", "-y", "+z", "-z"};

static int face_material(const primitive_spec *spec, int face)
{
    const int own = spec->face_material[face];
    return own != PRIMITIVE_NO_MATERIAL ? own : spec->material[MATERIAL];
}

static glint_status check(const primitive_spec *spec, glint_errors *errors)
{
    if (spec->given[MATERIAL]) return GLINT_OK;
    for (int face = 0; face < 6; face++)
        if (face_material(spec, face) == PRIMITIVE_NO_MATERIAL)
            return errors_add(errors, GLINT_INPUT, spec->where,
                              "face %s has no material; expected the key material, or all six "
                              "faces in faces",
                              face_names[face]);
    return GLINT_OK;
}

/* The corners of a face: those of a rectangle in the axes u, v that follow the face's axis
 * cyclically, so that u x v is the axis; run backwards on the face that looks the other way. */
static void corners(const primitive_spec *spec, int axis, int sense, double out[4][3])
{
    static const int corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double *centre_m = spec->value[CENTRE], *size_m = spec->value[SIZE];
    for (int k = 0; k < 4; k++) {
        double *p = out[sense > 0 ? k : 3 - k];
        p[axis] = centre_m[axis] + 0.5 * sense * size_m[axis];
        p[u] = centre_m[u] + 0.5 * corner[k][0] * size_m[u];
        p[v] = centre_m[v] + 0.5 * corner[k][1] * size_m[v];
    }
}

static glint_status add_face(const primitive_spec *spec, int face, int component, facet_list *out,
                             crinkle_sums *sums, glint_error *error)
{
    static const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
    const int axis = face / 2, sense = face % 2 ? -1 : 1;
    const double *tangent = axis == 0 ? y : x;
    double vertices[4][3];
    corners(spec, axis, sense, vertices);
    if (spec->crinkle.facets_per_side == 0)
        return facet_list_add(out, vertices, 4, tangent, face_material(spec, face), component,
                              error);
    rectangle r = {.material = face_material(spec, face), .back_material = PRIMITIVE_NO_MATERIAL};
    copy3(vertices[0], r.corner_m);
    sub3(vertices[1], vertices[0], r.first_m);
    sub3(vertices[3], vertices[0], r.second_m);
    copy3(tangent, r.tangent);
    return rectangle_crinkle(&r, &spec->crinkle, (uint64_t)face, component, out, sums, error);
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    crinkle_sums sums = {0};
    glint_status status = GLINT_OK;
    for (int face = 0; face < 6 && !status; face++)
        status = add_face(spec, face, component, out, &sums, error);
    if (!status) crinkle_report(spec, &sums);
    return status;
}

const primitive_kind primitive_box = {
    .name = "box",
    .doc = "rectangular box along the axes; tangents: y on the x faces, x on the others",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre_key = CENTRE,
};
