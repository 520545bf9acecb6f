#include "orbit/attitude_plan.h"

#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/attitude_table.h"

#include <math.h>
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
    for (int k = 0; k < plan->n; k++) {
        attitude_free(&plan->legs[k].law);
        free(plan->legs[k].starts);
    }
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

glint_status attitude_plan_settle(attitude_plan *plan, int k, const moment *starts, int n,
                                  glint_error *error)
{
    attitude_leg *leg = &plan->legs[k];
    slew_start *settled = calloc((size_t)n, sizeof *settled);
    glint_status status = settled ? GLINT_OK : error_no_memory(error);
    double longest_s = 0;
    for (int i = 0; i < n && !status; i++) {
        double before_gcrs[9], *way = settled[i].way;
        status = both_laws(plan, k, &starts[i], before_gcrs, way, error);
        settled[i].length_s =
            leg->rate_rad_s > 0 ? 2 * atan2(norm3(way + 1), way[0]) / leg->rate_rad_s : leg->slew_s;
        longest_s = fmax(longest_s, settled[i].length_s);
    }
    if (status) {
        free(settled);
        return status;
    }
    free(leg->starts);
    leg->starts = settled;
    leg->n_starts = n;
    leg->slew_s = longest_s;
    return GLINT_OK;
}

/* How the slew of a leg begins for the observer of a moment; NULL where it is not settled. */
static const slew_start *start_of(const attitude_leg *leg, const moment *m)
{
    if (leg->n_starts == 0) return NULL;
    return &leg->starts[leg->n_starts > 1 ? m->viewer : 0];
}

/* Leg k while it is being turned to: a part of the way from the law before. */
static glint_status slew_at(const attitude_plan *plan, int k, const moment *m, double length_s,
                            double body_gcrs[9], glint_error *error)
{
    const attitude_leg *leg = &plan->legs[k];
    const slew_start *start = start_of(leg, m);
    double before_gcrs[9], way[4], turn[9];
    const glint_status status = both_laws(plan, k, m, before_gcrs, way, error);
    if (status) return status;
    /* Of the two ways the one that goes on with the way of the start: no jump where the laws pass
     * through opposite attitudes. */
    if (start && quat_dot(way, start->way) < 0)
        for (int i = 0; i < 4; i++)
            way[i] = -way[i];
    quat_part(way, (m->t_s - leg->from_s) / length_s, way);
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
    const slew_start *start = start_of(leg, m);
    const double length_s = start ? start->length_s : leg->slew_s;
    if (k > 0 && m->t_s < leg->from_s + length_s)
        return slew_at(plan, k, m, length_s, body_gcrs, error);
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
        for (int i = 0; i < leg->n_starts; i++)
            if (leg->from_s + leg->starts[i].length_s > t_s)
                next_s = fmin(next_s, leg->from_s + leg->starts[i].length_s);
        if (leg->law.table) next_s = fmin(next_s, attitude_table_next_row(leg->law.table, t_s));
    }
    return next_s;
}

/* Whether the slew to a leg takes longer for one observer than for another. */
static bool lengths_differ(const attitude_leg *leg)
{
    for (int i = 0; i < leg->n_starts; i++)
        if (leg->starts[i].length_s < leg->slew_s) return true;
    return false;
}

/* The turn of a law's own, and the offset. */
static void describe_turns(const attitude *law, text *out)
{
    const attitude_turning own = attitude_turning_of(law);
    if (own.is_steady && own.fastest_rad_s > 0)
        text_printf(out, ", one turn in %.6g s", TWO_PI / own.fastest_rad_s);
    else if (own.fastest_rad_s > 0 && !law->table)
        text_printf(out, ", at most %.6g deg/s", own.fastest_rad_s / DEG);
    if (!law->has_offset) return;
    const double *m = law->offset, cosine = 0.5 * (m[0] + m[4] + m[8] - 1);
    text_printf(out, ", with an offset of %.6g deg", acos(fmax(-1, fmin(cosine, 1))) / DEG);
}

void attitude_plan_describe(const attitude_plan *plan, const char *indent, text *out)
{
    for (int k = 0; k < plan->n; k++) {
        const attitude_leg *leg = &plan->legs[k];
        if (k > 0) text_printf(out, "%sfrom %.10g s ", indent, leg->from_s);
        if (k > 0 && leg->slew_s > 0)
            text_printf(out, "by a slew of %s%.6g s to ", lengths_differ(leg) ? "up to " : "",
                        leg->slew_s);
        text_add(out, leg->law.law->name);
        if (leg->law.geodetic) text_add(out, ", geodetic");
        if (leg->law.table) {
            text_add(out, ": ");
            attitude_table_describe(leg->law.table, out);
        }
        describe_turns(&leg->law, out);
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
