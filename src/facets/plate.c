/* A flat rectangle. */
#include "base/vec.h"
#include "facets/crinkle.h"

enum { SIZE, CENTRE, NORMAL, TANGENT, MATERIAL, BACK_MATERIAL, CRINKLE, N_KEYS };

static const primitive_key keys[N_KEYS] = {
    [SIZE] = {.name = "size_m",
              .unit = "m",
              .doc = "lengths along the tangent and along normal x tangent",
              .kind = KEY_VECTOR,
              .length = 2,
              .required = true,
              LENGTH_RANGE},
    [CENTRE] = CENTRE_KEY,
    [NORMAL] = NORMAL_KEY("direction in which the front looks"),
    [TANGENT] = {.name = "tangent",
                 .unit = "",
                 .doc = "direction of the first side, made orthogonal to the normal",
                 .kind = KEY_DIRECTION,
                 .required = true},
    [MATERIAL] = MATERIAL_KEY("material of the front"),
    [BACK_MATERIAL] = BACK_MATERIAL_KEY("material of the back"),
    [CRINKLE] = CRINKLE_KEY,
};

static glint_status check(const primitive_spec *spec, glint_errors *errors)
{
    return check_tangent_key(spec, NORMAL, TANGENT, errors);
}

static glint_status build_crinkled(const primitive_spec *spec, const double corner[4][3],
                                   const double tangent[3], int component, facet_list *out,
                                   glint_error *error)
{
    rectangle r = {.material = spec->material[MATERIAL],
                   .back_material = spec->material[BACK_MATERIAL]};
    copy3(corner[0], r.corner_m);
    sub3(corner[1], corner[0], r.first_m);
    sub3(corner[3], corner[0], r.second_m);
    copy3(tangent, r.tangent);
    crinkle_sums sums = {0};
    const glint_status status =
        rectangle_crinkle(&r, &spec->crinkle, 0, component, out, &sums, error);
    if (!status) crinkle_report(spec, &sums);
    return status;
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    double n[3], t[3], b[3];
    unit3(spec->value[NORMAL], n);
    perp3(spec->value[TANGENT], n, t);
    cross3(n, t, b);
    /* Corners in the order that runs from t to b, which is anticlockwise about n = t x b. */
    static const double corner[4][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    double front[4][3];
    for (int k = 0; k < 4; k++) {
        add_scaled3(spec->value[CENTRE], corner[k][0] * spec->value[SIZE][0], t, front[k]);
        add_scaled3(front[k], corner[k][1] * spec->value[SIZE][1], b, front[k]);
    }
    if (spec->crinkle.facets_per_side > 0)
        return build_crinkled(spec, front, t, component, out, error);
    return add_two_sided(out, front, 4, t, spec->material[MATERIAL], spec->material[BACK_MATERIAL],
                         component, error);
}

const primitive_kind primitive_plate = {
    .name = "plate",
    .doc = "flat rectangle that reflects in front, and behind where back_material is given",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre_key = CENTRE,
};
