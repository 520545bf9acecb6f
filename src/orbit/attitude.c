#include "orbit/attitude.h"

#include "base/text.h"
#include "base/vec.h"
#include "orbit/attitude_law.h"
#include "orbit/attitude_table.h"

static const attitude_law *const laws[] = {
    &attitude_nadir,        &attitude_rsw,          &attitude_point,
    &attitude_sun_pointing, &attitude_yaw_steering, &attitude_inertial,
    &attitude_spin,         &attitude_torque_free,  &attitude_table_law};
enum { N_LAWS = sizeof laws / sizeof *laws };

const attitude_law *attitude_law_at(size_t k)
{
    return k < N_LAWS ? laws[k] : NULL;
}

const attitude_law *attitude_law_named(const char *name)
{
    for (size_t k = 0; k < N_LAWS; k++)
        if (string_equal(laws[k]->name, name)) return laws[k];
    return NULL;
}

int attitude_key_index(const attitude_law *law, const char *name)
{
    for (int k = 0; k < law->n_keys; k++)
        if (string_equal(law->keys[k].name, name)) return k;
    return -1;
}

void attitude_spec_start(const attitude_law *law, place where, attitude_spec *spec)
{
    *spec = (attitude_spec){.law = law, .where = where};
    for (int k = 0; k < law->n_keys; k++) {
        spec->key_place[k] = where;
        spec->value[k][0] = law->keys[k].def;
    }
}

bool attitude_triad(const double first[3], const double second[3], double triad[9])
{
    copy3(first, triad);
    if (!(perp3(second, first, triad + 3) > DIRECTION_PARALLEL)) return false;
    cross3(triad, triad + 3, triad + 6);
    return true;
}

/* With B and G the triads as rows, v_triad = B v_body = G v_gcrs, so v_body = B^T G v_gcrs. */
void attitude_align(const double triad_body[9], const double triad_gcrs[9], double body_gcrs[9])
{
    double body_triad[9];
    mat_transpose(triad_body, body_triad);
    mat_mul(body_triad, triad_gcrs, body_gcrs);
}

/* What can be said of any law's keys without knowing the law. */
static glint_status check_keys(const attitude_spec *spec, glint_errors *errors)
{
    glint_status status = GLINT_OK;
    for (int k = 0; k < spec->law->n_keys; k++) {
        const attitude_key *key = &spec->law->keys[k];
        const bool number = key->kind == ATTITUDE_NUMBER || key->kind == ATTITUDE_EPOCH;
        const bool vector = key->kind == ATTITUDE_VECTOR;
        if (key->required && !spec->given[k])
            status = errors_add(errors, GLINT_INPUT, spec->where, "the law '%s' needs the key '%s'",
                                spec->law->name, key->name);
        else if ((number && !isfinite(spec->value[k][0])) ||
                 (vector && !isfinite(norm3(spec->value[k]))))
            status = errors_add(errors, GLINT_INPUT, spec->key_place[k],
                                "'%s' is not a finite number", key->name);
    }
    return status;
}

/* The offset turns the body right-handed by an angle about its own axis, so a vector that stays
 * where it is in space turns by the opposite angle in body coordinates: v_body = T(axis, -angle)
 * v_law. */
static glint_status prepare_offset(const attitude_spec *spec, attitude *out, glint_errors *errors)
{
    mat_identity(out->offset);
    out->has_offset = spec->has_offset;
    if (!spec->has_offset) return GLINT_OK;
    if (!isfinite(spec->offset_rad))
        return errors_add(errors, GLINT_INPUT, spec->where,
                          "the angle of 'offset_deg' is not a finite number");
    mat_turn(spec->offset_axis, -spec->offset_rad, out->offset);
    return GLINT_OK;
}

glint_status attitude_prepare(const attitude_spec *spec, attitude *out, glint_errors *errors)
{
    *out = (attitude){.law = spec->law};
    const glint_status offset = prepare_offset(spec, out, errors);
    const glint_status keys = check_keys(spec, errors);
    const glint_status law = keys ? keys : spec->law->prepare(spec, out, errors);
    const glint_status status = law ? law : offset;
    if (status) attitude_free(out);
    return status;
}

void attitude_free(attitude *a)
{
    attitude_table_free(a->table);
    a->table = NULL;
}

glint_status attitude_at(const attitude *a, const moment *m, double body_gcrs[9],
                         glint_error *error)
{
    const glint_status status = a->law->at(a, m, body_gcrs, error);
    if (status) return status;
    if (a->has_offset) mat_mul(a->offset, body_gcrs, body_gcrs);
    return GLINT_OK;
}

attitude_turning attitude_turning_of(const attitude *a)
{
    attitude_turning out = {0};
    if (a->law->turning) a->law->turning(a, &out);
    if (a->has_offset) mat_vec(a->offset, out.axis_body, out.axis_body);
    return out;
}

bool attitude_wants(const attitude *a, direction_kind kind)
{
    return a->to.kind == kind || a->second_to.kind == kind;
}
