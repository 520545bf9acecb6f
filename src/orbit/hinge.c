#include "orbit/hinge.h"

#include "base/constants.h"
#include "base/sorted.h"
#include "base/vec.h"
#include "orbit/time_column.h"

#include <stdlib.h>

void hinge_free(hinge *h)
{
    free(h->table.t_s);
    free(h->table.angle);
    h->table = (hinge_table){0};
}

/* Adds full turns so that no step from row to row is longer than half a turn. */
static void unwind(hinge_table *t)
{
    for (long k = 1; k < t->n; k++)
        t->angle[k] = t->angle[k - 1] + remainder(t->angle[k] - t->angle[k - 1], TWO_PI);
}

/* Reads the angles; warns once, of the widest step that may be meant the other way round. */
static glint_status read_angles(hinge_table *t, const csv_table *csv, int column,
                                bool as_they_stand, glint_errors *errors)
{
    static const double FARTHEST_DEG = 1e9; /* 2.8 million turns */
    glint_status status = GLINT_OK;
    double widest = PI;
    const csv_cell *widest_cell = NULL;
    for (long k = 0; k < t->n; k++) {
        const csv_cell *cell = csv_at(csv, k, column);
        double angle_deg;
        if (csv_number(csv, k, column, &angle_deg, errors))
            status = GLINT_INPUT;
        else if (!(fabs(angle_deg) <= FARTHEST_DEG))
            status =
                errors_add(errors, GLINT_INPUT, csv_place(csv, cell),
                           "angle_deg is %g; expected at most %g deg", angle_deg, FARTHEST_DEG);
        t->angle[k] = angle_deg * DEG;
        const double step = k > 0 ? fabs(t->angle[k] - t->angle[k - 1]) : 0;
        if (as_they_stand && step > widest) {
            widest = step;
            widest_cell = cell;
        }
    }
    if (widest_cell && status == GLINT_OK)
        errors_warn(errors, csv_place(csv, widest_cell),
                    "the hinge turns by %.6g deg from the row above to this one; where the angles "
                    "begin again after a full turn, set shortest_way = true",
                    widest / DEG);
    return status;
}

static glint_status read_table(hinge_table *t, const csv_table *csv, bool shortest_way,
                               const run_clock *clock, glint_errors *errors)
{
    const int column = csv_column(csv, "angle_deg");
    if (column < 0)
        return errors_add(
            errors, GLINT_INPUT, csv_place(csv, &csv->cells[0]),
            "the table has no column 'angle_deg'; expected t_s or utc, and angle_deg");
    t->n = csv->n_rows;
    t->t_s = calloc((size_t)t->n + 1, sizeof *t->t_s);
    t->angle = calloc((size_t)t->n + 1, sizeof *t->angle);
    if (!t->t_s || !t->angle)
        return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    const glint_status times = time_column_read(csv, clock, t->t_s, errors);
    const glint_status angles = read_angles(t, csv, column, !shortest_way, errors);
    if (!times && !angles && shortest_way) unwind(t);
    return times ? times : angles;
}

glint_status hinge_set_table(hinge *h, const char *path, bool shortest_way, const run_clock *clock,
                             place asked_from, glint_errors *errors)
{
    csv_table csv;
    glint_status status = csv_read(path, asked_from, &csv, errors);
    if (status) return status;
    csv_leave_out_cut_row(&csv, errors);
    status = read_table(&h->table, &csv, shortest_way, clock, errors);
    csv_free(&csv);
    if (status) hinge_free(h);
    return status;
}

glint_status hinge_set_face(hinge *h, const double face[3], place where, glint_error *error)
{
    double unit[3];
    if (!(unit3(face, unit) > 0.0))
        return error_set(error, GLINT_INPUT, where, "'face' is zero; expected a direction");
    if (!(perp3(unit, h->axis, h->face) > DIRECTION_PARALLEL))
        return error_set(error, GLINT_INPUT, where,
                         "'face' is parallel to the hinge's axis within %g, so no angle turns it "
                         "towards anything",
                         DIRECTION_PARALLEL);
    return GLINT_OK;
}

/* Turned by delta the face is n0 cos(delta) + (a x n0) sin(delta); its component along s is largest
 * at this delta. */
static double track_angle(const hinge *h, const double target_parent[3])
{
    double across[3];
    cross3(h->axis, h->face, across);
    const double c = dot3(target_parent, h->face), s = dot3(target_parent, across);
    return c * c + s * s > DIRECTION_PARALLEL * DIRECTION_PARALLEL ? atan2(s, c) : 0.0;
}

/* Last row, but for the very last one, that is not after t_s; the first one before that. */
static long row_before(const hinge_table *t, double t_s)
{
    return (long)sorted_interval(t->t_s, (size_t)t->n, sizeof *t->t_s, t_s);
}

double hinge_next_change(const hinge *h, double t_s)
{
    const hinge_table *t = &h->table;
    if (h->drive != HINGE_TABLE || !(t_s < t->t_s[t->n - 1])) return INFINITY;
    const long k = row_before(t, t_s);
    return t->t_s[k] > t_s ? t->t_s[k] : t->t_s[k + 1];
}

/* Straight between the rows. */
static glint_status table_angle(const hinge_table *t, double t_s, double *angle, glint_error *error)
{
    long lo = 0, hi = t->n - 1;
    if (!(t_s >= t->t_s[lo] - TIME_LEAD_S && t_s <= t->t_s[hi] + TIME_SLACK_S))
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "a hinge's table says nothing at %.10g s from the start: it goes from "
                         "%.10g to %.10g s; expected one that covers the run",
                         t_s, t->t_s[lo], t->t_s[hi]);
    lo = row_before(t, t_s);
    hi = lo + 1 < t->n ? lo + 1 : lo;
    *angle = t->angle[lo];
    if (hi > lo)
        *angle += (t->angle[hi] - t->angle[lo]) * ((t_s - t->t_s[lo]) / (t->t_s[hi] - t->t_s[lo]));
    return GLINT_OK;
}

glint_status hinge_angle(const hinge *h, double t_s, const double target_parent[3], double *angle,
                         glint_error *error)
{
    *angle = h->angle;
    if (h->drive == HINGE_RATE) *angle += h->rate_rad_s * (t_s - h->epoch_s);
    if (h->drive == HINGE_TRACK) *angle = track_angle(h, target_parent);
    if (h->drive == HINGE_TABLE) {
        const glint_status status = table_angle(&h->table, t_s, angle, error);
        if (status) return status;
    }
    *angle += h->offset;
    if (h->has_limits) *angle = fmin(fmax(*angle, h->limits[0]), h->limits[1]);
    return GLINT_OK;
}

/* The component turns right-handed by `angle` in its parent, so a vector that stays where it is
 * turns by the opposite angle in the component's coordinates. */
void hinge_matrix(const hinge *h, double angle, double component_parent[9])
{
    mat_turn(h->axis, -angle, component_parent);
}
