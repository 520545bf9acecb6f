#include "orbit/attitude_plan.h"

#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/attitude_table.h"

#include <stdlib.h>

glint_status attitude_plan_add(attitude_plan *plan, const attitude_leg *leg, glint_errors *errors)
{
    attitude_leg *legs = realloc(plan->legs, (size_t)(plan->n + 1) * sizeof *legs);
    if (!legs) {
        attitude unused = leg->law;
        attitude_free(&unused);
        return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    }
    plan->legs = legs;
    legs[plan->n++] = *leg;
    return GLINT_OK;
}

void attitude_plan_free(attitude_plan *plan)
{
    for (int k = 0; k < plan->n; k++)
        attitude_free(&plan->legs[k].law);
    free(plan->legs);
    *plan = (attitude_plan){0};
}

/* The turn that brings one attitude to another, v_to = q v_from q*, by the shorter way (w >= 0). */
static void way_between(const double from_gcrs[9], const double to_gcrs[9], double way[4])
{
    double gcrs_from[9], to_from[9];
    mat_transpose(from_gcrs, gcrs_from);
    mat_mul(to_gcrs, gcrs_from, to_from);
    quat_from_mat(to_from, way);
}

/* The law before leg k at a moment, and the way from there to the leg's own. */
static glint_status both_laws(const attitude_plan *plan, int k, const moment *m,
                              double before_gcrs[9], double way[4], glint_error *error)
{
    double own_gcrs[9];
    glint_status status = attitude_at(&plan->legs[k - 1].law, m, before_gcrs, error);
    if (!status) status = attitude_at(&plan->legs[k].law, m, own_gcrs, error);
    if (!status) way_between(before_gcrs, own_gcrs, way);
    return status;
}

glint_status attitude_plan_settle(attitude_plan *plan, int k, const moment *start,
                                  glint_error *error)
{
    attitude_leg *leg = &plan->legs[k];
    double before_gcrs[9];
    const glint_status status = both_laws(plan, k, start, before_gcrs, leg->start_way, error);
    if (status) return status;
    leg->has_start_way = true;
    if (leg->rate_rad_s > 0)
        leg->slew_s = 2 * atan2(norm3(leg->start_way + 1), leg->start_way[0]) / leg->rate_rad_s;
    return GLINT_OK;
}

/* Leg k while it is being turned to: a part of the way from the law before. */
static glint_status slew_at(const attitude_plan *plan, int k, const moment *m, double body_gcrs[9],
                            glint_error *error)
{
    const attitude_leg *leg = &plan->legs[k];
    double before_gcrs[9], way[4], turn[9];
    const glint_status status = both_laws(plan, k, m, before_gcrs, way, error);
    if (status) return status;
    /* Of the two ways the one that goes on with the way of the start: no jump where the laws pass
     * through opposite attitudes. */
    if (leg->has_start_way && quat_dot(way, leg->start_way) < 0)
        for (int i = 0; i < 4; i++)
            way[i] = -way[i];
    quat_part(way, (m->t_s - leg->from_s) / leg->slew_s, way);
    mat_from_quat(way, turn);
    mat_mul(turn, before_gcrs, body_gcrs);
    return GLINT_OK;
}

glint_status attitude_plan_at(const attitude_plan *plan, const moment *m, double body_gcrs[9],
                              glint_error *error)
{
    int k = plan->n - 1;
    while (k > 0 && m->t_s < plan->legs[k].from_s)
        k--;
    const attitude_leg *leg = &plan->legs[k];
    if (k > 0 && m->t_s < leg->from_s + leg->slew_s) return slew_at(plan, k, m, body_gcrs, error);
    return attitude_at(&leg->law, m, body_gcrs, error);
}

bool attitude_plan_wants(const attitude_plan *plan, direction_kind kind)
{
    for (int k = 0; k < plan->n; k++)
        if (attitude_wants(&plan->legs[k].law, kind)) return true;
    return false;
}

double attitude_plan_next_change(const attitude_plan *plan, double t_s)
{
    double next_s = INFINITY;
    for (int k = 0; k < plan->n; k++) {
        const attitude_leg *leg = &plan->legs[k];
        if (k > 0 && leg->from_s > t_s) next_s = fmin(next_s, leg->from_s);
        if (k > 0 && leg->from_s + leg->slew_s > t_s)
            next_s = fmin(next_s, leg->from_s + leg->slew_s);
        if (leg->law.table) next_s = fmin(next_s, attitude_table_next_row(leg->law.table, t_s));
    }
    return next_s;
}

void attitude_plan_describe(const attitude_plan *plan, const char *indent, text *out)
{
    for (int k = 0; k < plan->n; k++) {
        const attitude_leg *leg = &plan->legs[k];
        if (k > 0) text_printf(out, "%sfrom %.10g s ", indent, leg->from_s);
        if (k > 0 && leg->slew_s > 0) text_printf(out, "by a slew of %.6g s to ", leg->slew_s);
        text_add(out, leg->law.law->name);
        if (leg->law.geodetic) text_add(out, ", geodetic");
        if (leg->law.table) {
            text_add(out, ": ");
            attitude_table_describe(leg->law.table, out);
        }
        if (leg->law.has_offset) text_add(out, ", with an offset");
        text_char(out, '\n');
    }
}

bool attitude_plan_gap(const attitude_plan *plan, int k, double end_s, double *gap_s)
{
    const attitude_leg *leg = &plan->legs[k];
    const attitude_leg *next = k + 1 < plan->n ? &plan->legs[k + 1] : NULL;
    const double from_s = k > 0 ? fmax(leg->from_s, 0) : 0;
    const double to_s = next ? fmin(next->from_s + next->slew_s, end_s) : end_s;
    if (!leg->law.table || from_s > to_s) return false;
    return attitude_table_gap(leg->law.table, from_s, to_s, gap_s);
}

attitude_turning attitude_plan_turning(const attitude_plan *plan)
{
    attitude_turning out = {0};
    if (plan->n == 1) return attitude_turning_of(&plan->legs[0].law);
    for (int k = 0; k < plan->n; k++)
        out.fastest_rad_s =
            fmax(out.fastest_rad_s, attitude_turning_of(&plan->legs[k].law).fastest_rad_s);
    return out;
}
