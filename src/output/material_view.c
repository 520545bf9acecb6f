#include "output/material_view.h"

#include "base/angle.h"
#include "base/constants.h"
#include "base/csv.h"
#include "base/grow.h"
#include "base/text.h"

#include <math.h>
#include <stdlib.h>

void view_points_free(view_points *points)
{
    free(points->items);
    free(points->starts);
    *points = (view_points){0};
}

static bool add_point(view_points *points, const view_point *point)
{
    if (!grow_list(&points->items, &points->capacity, points->n + 1, sizeof *points->items))
        return false;
    points->items[points->n++] = *point;
    return true;
}

/* A multiple of a step without the last digits that multiplying leaves: 0.3, not
 * 0.30000000000000004. */
static double tidy(double angle_deg)
{
    return round(angle_deg * 1e9) / 1e9;
}

/* An azimuth brought into 0 to 360 deg. */
static double wrapped(double phi_deg)
{
    const double turned = tidy(phi_deg - 360 * floor(phi_deg / 360));
    return turned < 360 ? turned : 0;
}

/* Line k of those from the normal to the horizon: multiples of the step, and the mirror direction
 * among them in its place. False past the end. */
static bool theta_line(const glint_material_view *view, double theta_i_deg, size_t k,
                       double *theta_deg)
{
    const double on_grid = round(theta_i_deg / view->step_deg);
    const bool is_extra = fabs(tidy(on_grid * view->step_deg) - theta_i_deg) > 1e-9;
    const size_t its_k = (size_t)floor(theta_i_deg / view->step_deg) + 1; /* of the extra line */
    if (is_extra && k == its_k) {
        *theta_deg = theta_i_deg;
        return true;
    }
    *theta_deg = tidy((double)(is_extra && k > its_k ? k - 1 : k) * view->step_deg);
    return *theta_deg < 90;
}

static bool add_in_plane(const glint_material_view *view, double theta_i_deg, double signed_deg,
                         view_points *points)
{
    const double phi_i_deg = view->phi_i_deg;
    const view_point point = {theta_i_deg, phi_i_deg, fabs(signed_deg),
                              wrapped(signed_deg < 0 ? phi_i_deg : phi_i_deg + 180), signed_deg};
    return add_point(points, &point);
}

/* From the horizon on the side of the source to that on the mirror side, both left out: f has no
 * value there. */
static bool add_plane(const glint_material_view *view, double theta_i_deg, view_points *points)
{
    double theta_deg;
    const long n = (long)ceil(90 / view->step_deg);
    for (long k = n; k > 0; k--) {
        const double on_grid_deg = tidy((double)k * view->step_deg);
        if (on_grid_deg < 90 && !add_in_plane(view, theta_i_deg, -on_grid_deg, points))
            return false;
    }
    for (size_t k = 0; theta_line(view, theta_i_deg, k, &theta_deg); k++)
        if (!add_in_plane(view, theta_i_deg, theta_deg, points)) return false;
    return true;
}

/* Lines of equal theta_r, each a full turn of phi_r from phi_i on, in an even number of steps so
 * that the mirror direction is met. */
static bool add_hemisphere(const glint_material_view *view, double theta_i_deg, view_points *points)
{
    double theta_deg;
    const size_t half = (size_t)ceil(180 / view->step_deg - 1e-9);
    points->n_phi = 2 * half;
    for (size_t k = 0; theta_line(view, theta_i_deg, k, &theta_deg); k++)
        for (size_t j = 0; j < points->n_phi; j++) {
            const double phi_r_deg = view->phi_i_deg + 180.0 * (double)j / (double)half;
            const view_point point = {theta_i_deg, view->phi_i_deg, theta_deg, wrapped(phi_r_deg),
                                      0};
            if (!add_point(points, &point)) return false;
        }
    return true;
}

static bool add_runs(const glint_material_view *view, view_points *points)
{
    points->starts = calloc(view->n_theta_i + 1, sizeof *points->starts);
    if (!points->starts) return false;
    for (size_t k = 0; k < view->n_theta_i; k++) {
        const double theta_i_deg = view->theta_i_deg[k];
        const view_point alone = {.theta_i_deg = theta_i_deg, .phi_i_deg = view->phi_i_deg};
        const bool good = view->kind == GLINT_VIEW_PLANE ? add_plane(view, theta_i_deg, points)
                          : view->kind == GLINT_VIEW_HEMISPHERE
                              ? add_hemisphere(view, theta_i_deg, points)
                              : add_point(points, &alone);
        if (!good) return false;
        points->starts[++points->n_runs] = points->n;
    }
    return true;
}

/* -------------------------------------------------------------------- files */

/* Reads the row's angles in the order of view_point. Angles past a half turn are slips: of units,
 * or of columns. */
static glint_status read_row(const csv_table *table, long row, const int columns[4],
                             view_points *points, glint_errors *errors)
{
    double angles_deg[4];
    glint_status worst = GLINT_OK;
    for (int k = 0; k < 4; k++) {
        glint_status status = csv_number(table, row, columns[k], &angles_deg[k], errors);
        const csv_cell *cell = csv_at(table, row, columns[k]);
        const double most_deg = k % 2 == 0 ? 90 : 360;
        if (!status && fabs(angles_deg[k]) > most_deg)
            status = errors_add(errors, GLINT_INPUT, csv_place(table, cell),
                                "found %.40s; expected an angle from -%g to %g deg", cell->text,
                                most_deg, most_deg);
        if (status) worst = status;
    }
    const view_point point = {angles_deg[0], angles_deg[1], angles_deg[2], angles_deg[3], 0};
    if (worst || add_point(points, &point)) return worst;
    return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
}

/* Refuses angles that look like rad. */
static glint_status check_unit(const csv_table *table, const int columns[4],
                               const view_points *points, glint_errors *errors)
{
    double zenith = 0, azimuth = 0;
    long row = 0;
    int column = 0;
    for (size_t k = 0; k < points->n; k++) {
        const view_point *p = &points->items[k];
        azimuth = fmax(azimuth, fmax(fabs(p->phi_i_deg), fabs(p->phi_r_deg)));
        const double zeniths[2] = {fabs(p->theta_i_deg), fabs(p->theta_r_deg)};
        for (int j = 0; j < 2; j++) {
            if (!(zeniths[j] > zenith)) continue;
            zenith = zeniths[j];
            row = (long)k;
            column = columns[2 * j];
        }
    }
    if (!angles_look_like_rad(zenith, azimuth)) return GLINT_OK;
    const csv_cell *cell = csv_at(table, row, column);
    return errors_add(errors, GLINT_INPUT, csv_place(table, cell),
                      "the largest angle from the normal is %.40s: these look like radians; "
                      "expected degrees, or --angles deg where degrees are so small",
                      cell->text);
}

/* Says that there is no column of that name, and which may be meant. names: the n that there ought
 * to be. */
static glint_status refuse_column(const csv_table *table, const char *name,
                                  const char *const *names, int n, glint_errors *errors)
{
    enum { MOST = 256 };
    const char *others[MOST]; /* columns that have no use */
    size_t n_others = 0;
    for (int c = 0; c < table->n_columns && n_others < MOST; c++) {
        const char *here = csv_at(table, -1, c)->text;
        bool used = false;
        for (int k = 0; k < n; k++)
            used = used || string_equal(here, names[k]);
        if (!used) others[n_others++] = here;
    }
    const char *near = nearest_name(name, others, n_others);
    return errors_add(errors, GLINT_INPUT, csv_place(table, csv_at(table, -1, 0)),
                      "there is no column '%s'%s%.40s%s; expected theta_i_deg, phi_i_deg, "
                      "theta_r_deg and phi_r_deg",
                      name, near ? " (is '" : "", near ? near : "", near ? "' meant?)" : "");
}

static glint_status read_angles(const char *path, bool unit_given, view_points *points,
                                glint_errors *errors)
{
    static const char *const NAMES[4] = {"theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg"};
    csv_table table;
    int columns[4];
    glint_status status = csv_read(path, PLACE_NONE, &table, errors);
    if (status) return status;
    csv_leave_out_cut_row(&table, errors);
    for (int k = 0; k < 4; k++) {
        columns[k] = csv_column(&table, NAMES[k]);
        if (columns[k] < 0) status = refuse_column(&table, NAMES[k], NAMES, 4, errors);
    }
    if (!status && table.n_rows == 0)
        status = errors_add(errors, GLINT_INPUT, (place){path, 0, 0},
                            "there are no rows below the header; expected at least one");
    const bool has_columns = !status;
    for (long row = 0; has_columns && row < table.n_rows; row++) {
        const glint_status row_status = read_row(&table, row, columns, points, errors);
        if (row_status > status) status = row_status;
        if (status == GLINT_INTERNAL) break;
    }
    if (!status && !unit_given) status = check_unit(&table, columns, points, errors);
    csv_free(&table);
    points->starts = calloc(2, sizeof *points->starts);
    if (!points->starts) return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    points->starts[1] = points->n;
    points->n_runs = 1;
    return status;
}

/* -------------------------------------------------------------------- views */

glint_status view_check(const glint_material_view *view, glint_errors *errors)
{
    static const double LEAST_PLANE_DEG = 0.001,
                        LEAST_MAP_DEG = 0.25; /* 180 000 and 520 000 points */
    static const double MOST_DEG = 45;
    const double least_deg = view->kind == GLINT_VIEW_HEMISPHERE ? LEAST_MAP_DEG : LEAST_PLANE_DEG;
    if (view->kind == GLINT_VIEW_ANGLES) return GLINT_OK;
    for (size_t k = 0; k < view->n_theta_i; k++)
        if (!(view->theta_i_deg[k] >= 0 && view->theta_i_deg[k] < 90))
            return errors_add(errors, GLINT_ARGUMENT, PLACE_NONE,
                              "the angle of incidence is %g deg; expected 0 to below 90",
                              view->theta_i_deg[k]);
    if (!(fabs(view->phi_i_deg) <= 360))
        return errors_add(errors, GLINT_ARGUMENT, PLACE_NONE,
                          "the azimuth is %g deg; expected -360 to 360", view->phi_i_deg);
    if (view->kind != GLINT_VIEW_DHR &&
        !(view->step_deg >= least_deg && view->step_deg <= MOST_DEG))
        return errors_add(errors, GLINT_ARGUMENT, PLACE_NONE,
                          "the step is %g deg; expected %g to %g", view->step_deg, least_deg,
                          MOST_DEG);
    return GLINT_OK;
}

glint_status view_points_make(const glint_material_view *view, view_points *out,
                              glint_errors *errors)
{
    *out = (view_points){0};
    glint_status status = view_check(view, errors);
    if (status) return status;
    if (view->kind == GLINT_VIEW_ANGLES)
        status = read_angles(view->angles, view->unit_given, out, errors);
    else if (!add_runs(view, out))
        status = errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    if (status) view_points_free(out);
    return status;
}

double view_point_brdf(const glint_material *material, const view_point *point)
{
    double f = 0;
    glint_material_brdf(material, point->theta_i_deg * DEG, point->phi_i_deg * DEG,
                        point->theta_r_deg * DEG, point->phi_r_deg * DEG, &f, NULL);
    return f;
}

bool view_point_is_unmeasured(const glint_material *material, const view_point *point, double f)
{
    return f > 0 &&
           !glint_material_covers(material, point->theta_i_deg * DEG, point->phi_i_deg * DEG,
                                  point->theta_r_deg * DEG, point->phi_r_deg * DEG);
}

double view_point_g(const view_point *point, double f)
{
    return f * cos(point->theta_i_deg * DEG) * cos(point->theta_r_deg * DEG);
}

glint_status view_point_dhr(const char *label, const glint_material *material,
                            const view_point *point, double *dhr, double *error_bound,
                            glint_errors *errors)
{
    glint_error error;
    const glint_status status = glint_material_dhr(
        material, point->theta_i_deg * DEG, point->phi_i_deg * DEG, dhr, error_bound, &error);
    if (status == GLINT_OK) return status;
    if (status != GLINT_INPUT) return errors_take(errors, &error, PLACE_NONE);
    errors_warn(errors, PLACE_NONE, "the reflectance of '%s' at %g deg is good to %.1g only", label,
                point->theta_i_deg, *error_bound);
    return GLINT_OK;
}

const char *view_label(const glint_material_view *view, const glint_material *const *materials,
                       size_t k)
{
    return view->labels ? view->labels[k] : glint_material_name(materials[k]);
}
