#include "facets/primitive.h"

#include "base/constants.h"
#include "base/param.h"
#include "base/text.h"
#include "base/vec.h"
#include "facets/primitive_kinds.h"

#include <assert.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

static const primitive_kind *const table[] = {
    &primitive_plate,    &primitive_facet, &primitive_box,  &primitive_prism,   &primitive_sphere,
    &primitive_cylinder, &primitive_cone,  &primitive_disc, &primitive_annulus, &primitive_dish,
    &primitive_wing,     &primitive_boom,  &primitive_mesh,
};

const primitive_kind *primitive_kind_at(size_t k)
{
    return k < sizeof table / sizeof *table ? table[k] : NULL;
}

const primitive_kind *primitive_kind_named(const char *name)
{
    for (size_t k = 0; k < sizeof table / sizeof *table; k++)
        if (string_equal(table[k]->name, name)) return table[k];
    return NULL;
}

int primitive_key_index(const primitive_kind *kind, const char *name)
{
    for (int k = 0; k < kind->n_keys; k++)
        if (string_equal(kind->keys[k].name, name)) return k;
    return -1;
}

void primitive_spec_start(const primitive_kind *kind, place where, primitive_spec *spec)
{
    assert(kind->n_keys <= PRIMITIVE_MAX_KEYS);
    *spec = (primitive_spec){.kind = kind, .where = where, .repeat_count = 1};
    spec->rotation_axis[2] = spec->repeat_axis[2] = 1.0;
    for (int k = 0; k < PRIMITIVE_MAX_KEYS; k++) {
        spec->key_place[k] = where;
        spec->material[k] = PRIMITIVE_NO_MATERIAL;
        if (k < kind->n_keys) copy3(kind->keys[k].def, spec->value[k]);
    }
    for (int face = 0; face < 6; face++)
        spec->face_material[face] = PRIMITIVE_NO_MATERIAL;
}

void primitive_spec_free(primitive_spec *spec)
{
    if (!spec) return;
    free(spec->points);
    free(spec->path);
    free(spec->names);
    spec->points = NULL;
    spec->path = NULL;
    spec->names = NULL;
    spec->n_points = spec->n_names = 0;
}

/* --- checks --- */

/* How many numbers a value of this key has; 0 for kinds that are not plain numbers. */
static int number_count(const primitive_key *key)
{
    switch (key->kind) {
    case KEY_NUMBER:
    case KEY_COUNT:
    case KEY_SWITCH:
    case KEY_WORD:
        return 1;
    case KEY_VECTOR:
        return key->length;
    case KEY_DIRECTION:
        return 3;
    case KEY_POINTS:
    case KEY_MATERIAL:
    case KEY_FACES:
    case KEY_PATH:
    case KEY_NAMES:
    case KEY_CRINKLE:
        break;
    }
    return 0;
}

/* The range of each number of a key, in the words of param.h. */
static param_info range_of(const primitive_key *key)
{
    if (key->kind == KEY_DIRECTION)
        return (param_info){.name = key->name, .min = -HUGE_VAL, .max = HUGE_VAL};
    if (key->kind == KEY_WORD) return (param_info){.name = key->name, .max = key->n_words - 1};
    return (param_info){.name = key->name,
                        .unit = key->unit,
                        .min = key->min,
                        .max = key->max,
                        .flags = key->min_open ? PARAM_MIN_OPEN : 0u};
}

static bool is_given(const primitive_spec *spec, int k)
{
    return spec->given[k] || spec->material[k] != PRIMITIVE_NO_MATERIAL ||
           (spec->kind->keys[k].kind == KEY_POINTS && spec->points) ||
           (spec->kind->keys[k].kind == KEY_PATH && spec->path);
}

static glint_status out_of_range(const primitive_spec *spec, int k, const char *name, double value,
                                 glint_errors *errors)
{
    const param_info range = range_of(&spec->kind->keys[k]);
    char words[PARAM_RANGE_SIZE];
    param_range_text(&range, words);
    return errors_add(errors, GLINT_INPUT, spec->key_place[k], "%s is %.10g; expected %s", name,
                      value, words);
}

static bool is_zero(const double v[3])
{
    return v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0;
}

static glint_status check_numbers(const primitive_spec *spec, int k, glint_errors *errors)
{
    const primitive_key *key = &spec->kind->keys[k];
    const param_info range = range_of(key);
    const int n = number_count(key);
    glint_status status = GLINT_OK;
    for (int j = 0; j < n; j++) {
        char name[64];
        if (n == 1)
            snprintf(name, sizeof name, "%s", key->name);
        else
            snprintf(name, sizeof name, "number %d of %s", j + 1, key->name);
        const double value = spec->value[k][j];
        if (!param_accepts(&range, value))
            status = out_of_range(spec, k, name, value, errors);
        else if ((key->kind == KEY_COUNT || key->kind == KEY_WORD) && value != floor(value))
            status = errors_add(errors, GLINT_INPUT, spec->key_place[k],
                                "%s is %.10g; expected a whole number", name, value);
    }
    if (!status && key->kind == KEY_DIRECTION && is_zero(spec->value[k]))
        status = errors_add(errors, GLINT_INPUT, spec->key_place[k],
                            "%s is zero; expected a direction", key->name);
    return status;
}

static glint_status check_points(const primitive_spec *spec, int k, glint_errors *errors)
{
    const primitive_key *key = &spec->kind->keys[k];
    const param_info range = range_of(key);
    glint_status status = GLINT_OK;
    if (spec->n_points < 3)
        status = errors_add(errors, GLINT_INPUT, spec->key_place[k],
                            "%s has %d points; expected 3 or more", key->name, spec->n_points);
    for (int p = 0; p < spec->n_points; p++)
        for (int j = 0; j < 3; j++) {
            char name[64];
            snprintf(name, sizeof name, "number %d of point %d of %s", j + 1, p + 1, key->name);
            if (!param_accepts(&range, spec->points[p][j]))
                status = out_of_range(spec, k, name, spec->points[p][j], errors);
        }
    return status;
}

static glint_status check_crinkle(const primitive_spec *spec, int k, glint_errors *errors)
{
    static const param_info SIDE = {"facets_per_side", "", "", 2, CRINKLE_MAX, PARAM_REQUIRED, 0};
    static const param_info TILT = {"tilt_rms_deg", "deg",         "", 0, CRINKLE_MOST_TILT_DEG,
                                    PARAM_REQUIRED, PARAM_MIN_OPEN};
    const double side = spec->crinkle.facets_per_side, tilt_deg = spec->crinkle.tilt_rms_rad / DEG;
    if (param_accepts(&SIDE, side) && param_accepts(&TILT, tilt_deg)) return GLINT_OK;
    return errors_add(errors, GLINT_INPUT, spec->key_place[k],
                      "crinkle has %g facets per side tilted by %.10g deg rms; expected between %g "
                      "and %g, tilted by more than 0 and at most %g deg",
                      side, tilt_deg, SIDE.min, SIDE.max, TILT.max);
}

static glint_status check_key(const primitive_spec *spec, int k, glint_errors *errors)
{
    const primitive_key *key = &spec->kind->keys[k];
    if (!is_given(spec, k)) {
        if (!key->required) return GLINT_OK;
        return errors_add(errors, GLINT_INPUT, spec->where, "%s is missing: %s", key->name,
                          key->doc);
    }
    if (key->kind == KEY_POINTS) return check_points(spec, k, errors);
    if (key->kind == KEY_CRINKLE) return check_crinkle(spec, k, errors);
    return check_numbers(spec, k, errors);
}

bool primitive_key_sound(const primitive_spec *spec, int k)
{
    return check_key(spec, k, NULL) == GLINT_OK;
}

bool primitive_parallel(const double a[3], const double b[3])
{
    /* Scaled first: the product of two very long or short vectors would leave the range. */
    double u[3], v[3];
    unit3(a, u), unit3(b, v);
    const double angle = angle3(u, v);
    return fmin(angle, PI - angle) <= PARALLEL_RAD;
}

glint_status check_tangent(const primitive_spec *spec, const double normal[3], int tangent_key,
                           glint_errors *errors)
{
    if (!spec->given[tangent_key] || !primitive_key_sound(spec, tangent_key) ||
        !primitive_parallel(normal, spec->value[tangent_key]))
        return GLINT_OK;
    return errors_add(errors, GLINT_INPUT, spec->key_place[tangent_key],
                      "tangent is along the normal; expected a direction across it");
}

glint_status check_tangent_key(const primitive_spec *spec, int normal_key, int tangent_key,
                               glint_errors *errors)
{
    if (!primitive_key_sound(spec, normal_key)) return GLINT_OK; /* said already */
    return check_tangent(spec, spec->value[normal_key], tangent_key, errors);
}

static bool is_direction(const double v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]) && !is_zero(v);
}

static glint_status check_copies(const primitive_spec *spec, glint_errors *errors)
{
    glint_status status = GLINT_OK;
    if (spec->repeat_count < 1 || spec->repeat_count > PRIMITIVE_MAX_FACETS)
        status = errors_add(errors, GLINT_INPUT, spec->where,
                            "repeat has a count of %d; expected between 1 and %d",
                            spec->repeat_count, PRIMITIVE_MAX_FACETS);
    if ((spec->has_rotation && !is_direction(spec->rotation_axis)) ||
        (spec->repeat_count > 1 && !is_direction(spec->repeat_axis)))
        status = errors_add(errors, GLINT_INPUT, spec->where,
                            "the axis of rotation_deg or repeat is no direction; expected three "
                            "finite numbers, not all zero");
    if (!isfinite(spec->repeat_step_rad) || !isfinite(spec->rotation_rad))
        status = errors_add(errors, GLINT_INPUT, spec->where,
                            "the angle of rotation_deg or repeat is not a finite number");
    return status;
}

glint_status primitive_check(const primitive_spec *spec, glint_errors *errors)
{
    glint_status status = GLINT_OK;
    for (int k = 0; k < spec->kind->n_keys; k++) {
        const glint_status key = check_key(spec, k, errors);
        if (key) status = key;
    }
    const glint_status copies = check_copies(spec, errors);
    if (copies) status = copies;
    const glint_status own = spec->kind->check ? spec->kind->check(spec, errors) : GLINT_OK;
    return own ? own : status;
}

/* --- building --- */

void reverse_points(double (*points)[3], int n)
{
    for (int a = 0, b = n - 1; a < b; a++, b--) {
        double swap[3];
        copy3(points[a], swap), copy3(points[b], points[a]), copy3(swap, points[b]);
    }
}

glint_status add_two_sided(facet_list *out, const double (*vertices)[3], int n,
                           const double tangent[3], int material, int back_material, int component,
                           glint_error *error)
{
    glint_status status = facet_list_add(out, vertices, n, tangent, material, component, error);
    if (status || back_material == PRIMITIVE_NO_MATERIAL) return status;
    double(*back)[3] = malloc((size_t)n * sizeof *back);
    if (!back) return error_no_memory(error);
    memcpy(back, vertices, (size_t)n * sizeof *back);
    reverse_points(back, n);
    status = facet_list_add(out, back, n, tangent, back_material, component, error);
    free(back);
    return status;
}

/* --- rotation and copies --- */

/* A movement of points: p -> about + R (p - about). R is a rotation or a reflection. */
typedef struct movement {
    double r[9], about[3];
} movement;

static bool is_smooth(const facet_list *list, const facet *f)
{
    return f->surface && list->surfaces[f->surface - 1].kind == SURFACE_SMOOTH;
}

static void move_point(const movement *m, double p[3])
{
    double d[3];
    sub3(p, m->about, d);
    mat_vec(m->r, d, d);
    add3(m->about, d, p);
}

/* A run of facets with the surfaces that they alone are pieces of. */
typedef struct block {
    int first, n, first_surface, n_surfaces;
} block;

static void move_block(const movement *m, facet_list *list, block b)
{
    for (int k = b.first; k < b.first + b.n; k++) {
        facet *f = &list->items[k];
        mat_vec(m->r, f->normal, f->normal);
        mat_vec(m->r, f->tangent, f->tangent);
        for (int v = f->first_vertex; v < f->first_vertex + f->n_vertices; v++) {
            move_point(m, list->vertices[v]);
            if (is_smooth(list, f)) mat_vec(m->r, list->normals[v], list->normals[v]);
        }
    }
    for (int s = b.first_surface; s < b.first_surface + b.n_surfaces; s++) {
        move_point(m, list->surfaces[s].centre_m);
        mat_vec(m->r, list->surfaces[s].axis, list->surfaces[s].axis);
    }
}

/* Appends a block once more; room for it was made. Returns the copy. */
static block copy_block(facet_list *list, block b)
{
    const block copy = {list->n, b.n, list->n_surfaces, b.n_surfaces};
    const size_t size = sizeof *list->vertices;
    for (int k = b.first; k < b.first + b.n; k++) {
        facet f = list->items[k];
        const size_t n = (size_t)f.n_vertices;
        memcpy(list->vertices + list->n_vertices, list->vertices + f.first_vertex, n * size);
        if (is_smooth(list, &f))
            memcpy(list->normals + list->n_vertices, list->normals + f.first_vertex, n * size);
        f.first_vertex = list->n_vertices;
        if (f.surface) f.surface += copy.first_surface - b.first_surface;
        list->n_vertices += f.n_vertices;
        list->items[list->n++] = f;
    }
    for (int s = b.first_surface; s < b.first_surface + b.n_surfaces; s++)
        list->surfaces[list->n_surfaces++] = list->surfaces[s];
    return copy;
}

/* A reflection turns anticlockwise into clockwise: the vertices run backwards to make up for it. */
static void reverse_vertices(facet_list *list, block b)
{
    for (int k = b.first; k < b.first + b.n; k++) {
        const facet *f = &list->items[k];
        reverse_points(list->vertices + f->first_vertex, f->n_vertices);
        if (is_smooth(list, f)) reverse_points(list->normals + f->first_vertex, f->n_vertices);
    }
}

static void rotate_about_centre(const primitive_spec *spec, facet_list *list, block b)
{
    movement m;
    double axis[3];
    unit3(spec->rotation_axis, axis);
    mat_turn(axis, spec->rotation_rad, m.r);
    if (spec->kind->centre)
        spec->kind->centre(spec, m.about);
    else
        copy3(spec->value[spec->kind->centre_key], m.about);
    move_block(&m, list, b);
}

static void repeat_block(const primitive_spec *spec, facet_list *list, block b)
{
    movement m = {.about = {0, 0, 0}};
    double axis[3];
    unit3(spec->repeat_axis, axis);
    for (int k = 1; k < spec->repeat_count; k++) {
        mat_turn(axis, k * spec->repeat_step_rad, m.r);
        move_block(&m, list, copy_block(list, b));
    }
}

static void mirror_block(int plane, facet_list *list, block b)
{
    movement m = {.about = {0, 0, 0}};
    mat_identity(m.r);
    m.r[4 * (plane - 1)] = -1.0;
    const block copy = copy_block(list, b);
    move_block(&m, list, copy);
    reverse_vertices(list, copy);
}

/* The facets and surfaces of the list from these on. */
static block block_from(const facet_list *list, int first, int first_surface)
{
    return (block){first, list->n - first, first_surface, list->n_surfaces - first_surface};
}

/* Makes the copies of the block, which stands at the end of the list. */
static glint_status add_copies(const primitive_spec *spec, facet_list *list, block b,
                               glint_error *error)
{
    const int n_vertices = list->n_vertices - list->items[b.first].first_vertex;
    const long long copies = (long long)spec->repeat_count * (spec->mirror ? 2 : 1);
    if (copies * b.n > PRIMITIVE_MAX_FACETS)
        return error_set(error, GLINT_INPUT, spec->where,
                         "this %s has %lld facets with its copies; expected at most %d",
                         spec->kind->name, copies * b.n, PRIMITIVE_MAX_FACETS);
    if ((copies - 1) * n_vertices > INT_MAX) return error_no_memory(error);
    glint_status status =
        facet_list_reserve(list, (int)(copies - 1) * b.n, (int)((copies - 1) * n_vertices), error);
    if (!status)
        status = facet_list_reserve_surfaces(list, (int)(copies - 1) * b.n_surfaces, error);
    if (status) return status;
    repeat_block(spec, list, b);
    if (spec->mirror) mirror_block(spec->mirror, list, block_from(list, b.first, b.first_surface));
    return GLINT_OK;
}

glint_status primitive_add(const primitive_spec *spec, int component, facet_list *out,
                           glint_errors *errors)
{
    assert(spec->mirror >= 0 && spec->mirror <= 3);
    glint_status status = primitive_check(spec, errors);
    if (status) return status;
    const int first = out->n, first_vertex = out->n_vertices, first_surface = out->n_surfaces;
    glint_error error = {0};
    status = spec->kind->build(spec, component, out, errors, &error);
    if (!status) {
        const block b = block_from(out, first, first_surface);
        if (spec->has_rotation) rotate_about_centre(spec, out, b);
        status = add_copies(spec, out, b, &error);
    }
    if (!status) return GLINT_OK;
    facet_list_truncate(out, first, first_vertex, first_surface);
    return error.status ? errors_take(errors, &error, spec->where) : status;
}
