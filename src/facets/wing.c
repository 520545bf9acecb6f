/* A solar wing: a row of equal panels with gaps between them. */
#include "base/vec.h"
#include "facets/revolved.h"

enum { SIZE, PANELS, GAP, CENTRE, NORMAL, TANGENT, MATERIAL, BACK_MATERIAL, N_KEYS };

static const primitive_key keys[N_KEYS] = {
    [SIZE] = {.name = "size_m",
              .unit = "m",
              .doc = "lengths of the whole wing along the tangent and along normal x tangent, gaps "
                     "included",
              .kind = KEY_VECTOR,
              .length = 2,
              .required = true,
              LENGTH_RANGE},
    [PANELS] = {.name = "panels",
                .unit = "",
                .doc = "number of panels, side by side along normal x tangent",
                .kind = KEY_COUNT,
                .required = true,
                .min = 1,
                .max = 1000},
    [GAP] = {.name = "gap_m",
             .unit = "m",
             .doc = "width of the gap between two panels",
             .kind = KEY_NUMBER,
             .min = 0,
             .max = LENGTH_MAX_M},
    [CENTRE] = CENTRE_KEY,
    [NORMAL] = NORMAL_KEY("direction in which the cells look"),
    [TANGENT] = {.name = "tangent",
                 .unit = "",
                 .doc =
                     "direction of the strings of cells, across the wing, made orthogonal to the "
                     "normal",
                 .kind = KEY_DIRECTION,
                 .required = true},
    [MATERIAL] = MATERIAL_KEY("material of the cells"),
    [BACK_MATERIAL] = BACK_MATERIAL_KEY("material of the back"),
};

/* Length of one panel along the wing, m. */
static double panel_length(const primitive_spec *spec)
{
    const double n = spec->value[PANELS][0];
    return (spec->value[SIZE][1] - (n - 1.0) * spec->value[GAP][0]) / n;
}

static glint_status check(const primitive_spec *spec, glint_errors *errors)
{
    glint_status status = check_tangent_key(spec, NORMAL, TANGENT, errors);
    if (primitive_key_sound(spec, SIZE) && primitive_key_sound(spec, PANELS) &&
        primitive_key_sound(spec, GAP) && panel_length(spec) < LENGTH_MIN_M)
        status = errors_add(errors, GLINT_INPUT, spec->key_place[GAP],
                            "%.0f panels with gaps of %.10g m leave no room for cells in a wing of "
                            "%.10g m; expected smaller or fewer gaps",
                            spec->value[PANELS][0], spec->value[GAP][0], spec->value[SIZE][1]);
    return status;
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *warnings, glint_error *error)
{
    (void)warnings;
    static const double corner[4][2] = {{-0.5, 0}, {0.5, 0}, {0.5, 1}, {-0.5, 1}};
    double n[3], t[3], b[3];
    unit3(spec->value[NORMAL], n);
    perp3(spec->value[TANGENT], n, t);
    cross3(n, t, b);
    const double length_m = panel_length(spec), step_m = length_m + spec->value[GAP][0];
    glint_status status = GLINT_OK;
    for (int k = 0; k < (int)spec->value[PANELS][0] && !status; k++) {
        const double start_m = k * step_m - 0.5 * spec->value[SIZE][1];
        double panel[4][3];
        for (int c = 0; c < 4; c++) {
            add_scaled3(spec->value[CENTRE], corner[c][0] * spec->value[SIZE][0], t, panel[c]);
            add_scaled3(panel[c], start_m + corner[c][1] * length_m, b, panel[c]);
        }
        status = add_two_sided(out, panel, 4, t, spec->material[MATERIAL],
                               spec->material[BACK_MATERIAL], component, error);
    }
    return status;
}

const primitive_kind primitive_wing = {
    .name = "wing",
    .doc = "flat solar wing of equal panels with gaps between them; reflects in front, and behind "
           "where "
           "back_material is given",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre_key = CENTRE,
};
