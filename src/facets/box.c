/* A rectangular box along the axes. */
#include "base/vec.h"
#include "facets/primitive_kinds.h"

enum { SIZE, CENTRE, MATERIAL, FACES, N_KEYS };

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

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_error *error)
{
    static const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
    for (int face = 0; face < 6; face++) {
        const int axis = face / 2, sense = face % 2 ? -1 : 1;
        double vertices[4][3];
        corners(spec, axis, sense, vertices);
        const glint_status status = facet_list_add(out, vertices, 4, axis == 0 ? y : x,
                                                   face_material(spec, face), component, error);
        if (status) return status;
    }
    return GLINT_OK;
}

static void centre(const primitive_spec *spec, double out[3])
{
    copy3(spec->value[CENTRE], out);
}

const primitive_kind primitive_box = {
    .name = "box",
    .doc = "rectangular box along the axes; tangents: y on the x faces, x on the others",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre = centre,
};
