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
    &primitive_plate, &primitive_facet, &primitive_box, &primitive_prism, &primitive_sphere,
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
    spec->points = NULL;
    spec->n_points = 0;
}

/* --- checks --- */

/* How many numbers a value of this key has; 0 for kinds that are not plain numbers. */
static int number_count(const primitive_key *key)
{
    switch (key->kind) {
    case KEY_NUMBER:
    case KEY_COUNT:
    case KEY_SWITCH:
        return 1;
    case KEY_VECTOR:
        return key->length;
    case KEY_DIRECTION:
        return 3;
    case KEY_POINTS:
    case KEY_MATERIAL:
    case KEY_FACES:
        break;
    }
    return 0;
}

/* The range of each number of a key, in the words of param.h. */
static param_info range_of(const primitive_key *key)
{
    if (key->kind == KEY_DIRECTION)
        return (param_info){.name = key->name, .min = -HUGE_VAL, .max = HUGE_VAL};
    return (param_info){.name = key->name,
                        .unit = key->unit,
                        .min = key->min,
                        .max = key->max,
                        .flags = key->min_open ? PARAM_MIN_OPEN : 0u};
}

static bool is_given(const primitive_spec *spec, int k)
{
    return spec->given[k] || spec->material[k] != PRIMITIVE_NO_MATERIAL ||
           (spec->kind->keys[k].kind == KEY_POINTS && spec->points);
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
        else if (key->kind == KEY_COUNT && value != floor(value))
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

static glint_status check_key(const primitive_spec *spec, int k, glint_errors *errors)
{
    const primitive_key *key = &spec->kind->keys[k];
    if (!is_given(spec, k)) {
        if (!key->required) return GLINT_OK;
        return errors_add(errors, GLINT_INPUT, spec->where, "%s is missing: %s", key->name,
                          key->doc);
    }
    return key->kind == KEY_POINTS ? check_points(spec, k, errors) : check_numbers(spec, k, errors);
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

/* --- rotation and copies --- */

/* A movement of points: p -> about + R (p - about). R is a rotation or a reflection. */
typedef struct movement {
    double r[9], about[3];
} movement;

static void move_point(const movement *m, double p[3])
{
    double d[3];
    sub3(p, m->about, d);
    mat_vec(m->r, d, d);
    add3(m->about, d, p);
}

static void move_facets(const movement *m, facet_list *list, int first, int n)
{
    for (int k = first; k < first + n; k++) {
        facet *f = &list->items[k];
        mat_vec(m->r, f->normal, f->normal);
        mat_vec(m->r, f->tangent, f->tangent);
        for (int v = 0; v < f->n_vertices; v++)
            move_point(m, list->vertices[f->first_vertex + v]);
    }
}

/* Appends the n facets from `first` once more; room for them was made. */
static void copy_facets(facet_list *list, int first, int n)
{
    for (int k = first; k < first + n; k++) {
        facet f = list->items[k];
        memcpy(list->vertices + list->n_vertices, list->vertices + f.first_vertex,
               (size_t)f.n_vertices * sizeof *list->vertices);
        f.first_vertex = list->n_vertices;
        list->n_vertices += f.n_vertices;
        list->items[list->n++] = f;
    }
}

/* A reflection turns anticlockwise into clockwise: the vertices run backwards to make up for it. */
static void reverse_vertices(facet_list *list, int first, int n)
{
    for (int k = first; k < first + n; k++) {
        double(*v)[3] = list->vertices + list->items[k].first_vertex;
        for (int a = 0, b = list->items[k].n_vertices - 1; a < b; a++, b--) {
            double swap[3];
            copy3(v[a], swap), copy3(v[b], v[a]), copy3(swap, v[b]);
        }
    }
}

static void rotate_about_centre(const primitive_spec *spec, facet_list *list, int first, int n)
{
    movement m;
    double axis[3];
    unit3(spec->rotation_axis, axis);
    mat_turn(axis, spec->rotation_rad, m.r);
    spec->kind->centre(spec, m.about);
    move_facets(&m, list, first, n);
}

static void repeat_facets(const primitive_spec *spec, facet_list *list, int first, int n)
{
    movement m = {.about = {0, 0, 0}};
    double axis[3];
    unit3(spec->repeat_axis, axis);
    for (int k = 1; k < spec->repeat_count; k++) {
        copy_facets(list, first, n);
        mat_turn(axis, k * spec->repeat_step_rad, m.r);
        move_facets(&m, list, first + k * n, n);
    }
}

static void mirror_facets(int plane, facet_list *list, int first, int n)
{
    movement m = {.about = {0, 0, 0}};
    mat_identity(m.r);
    m.r[4 * (plane - 1)] = -1.0;
    copy_facets(list, first, n);
    move_facets(&m, list, first + n, n);
    reverse_vertices(list, first + n, n);
}

/* Makes the copies of the facets from `first` to the end of the list. */
static glint_status add_copies(const primitive_spec *spec, facet_list *list, int first,
                               glint_error *error)
{
    const int n = list->n - first;
    const int n_vertices = list->n_vertices - list->items[first].first_vertex;
    const long long copies = (long long)spec->repeat_count * (spec->mirror ? 2 : 1);
    if (copies * n > PRIMITIVE_MAX_FACETS)
        return error_set(error, GLINT_INPUT, spec->where,
                         "this %s has %lld facets with its copies; expected at most %d",
                         spec->kind->name, copies * n, PRIMITIVE_MAX_FACETS);
    if ((copies - 1) * n_vertices > INT_MAX) return error_no_memory(error);
    const glint_status status =
        facet_list_reserve(list, (int)(copies - 1) * n, (int)((copies - 1) * n_vertices), error);
    if (status) return status;
    repeat_facets(spec, list, first, n);
    if (spec->mirror) mirror_facets(spec->mirror, list, first, list->n - first);
    return GLINT_OK;
}

glint_status primitive_add(const primitive_spec *spec, int component, facet_list *out,
                           glint_errors *errors)
{
    assert(spec->mirror >= 0 && spec->mirror <= 3);
    glint_status status = primitive_check(spec, errors);
    if (status) return status;
    const int first = out->n, first_vertex = out->n_vertices;
    glint_error error;
    status = spec->kind->build(spec, component, out, &error);
    if (!status) {
        if (spec->has_rotation) rotate_about_centre(spec, out, first, out->n - first);
        status = add_copies(spec, out, first, &error);
    }
    if (!status) return GLINT_OK;
    out->n = first;
    out->n_vertices = first_vertex;
    return errors_take(errors, &error, spec->where);
}
