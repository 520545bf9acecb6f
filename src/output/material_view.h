/* material_view.h: the directions in which materials are shown, for tables and pictures. */
#ifndef GLINT_OUTPUT_MATERIAL_VIEW_H
#define GLINT_OUTPUT_MATERIAL_VIEW_H

#include "base/error.h"

/* A pair of directions, deg, as it stands in columns: whole steps are round numbers. */
typedef struct view_point {
    double theta_i_deg, phi_i_deg, theta_r_deg, phi_r_deg; /* 0 <= phi_r < 360, but of files */
    double signed_theta_r_deg; /* in the plane of incidence: positive on the mirror side */
} view_point;

/* All points of a view, in runs of one angle of incidence. Of GLINT_VIEW_ANGLES there is one run;
 * of GLINT_VIEW_DHR each run is one point without a direction of reflection. */
typedef struct view_points {
    view_point *items; /* owned */
    size_t n, capacity;
    size_t *starts; /* owned; n_runs + 1 indices of items */
    size_t n_runs;
    size_t n_phi; /* of GLINT_VIEW_HEMISPHERE: points of a line of equal theta_r */
} view_points;

/* Whether a view can be; of GLINT_VIEW_ANGLES the file is not looked at. Errors: GLINT_ARGUMENT. */
glint_status view_check(const glint_material_view *view, glint_errors *errors);
/* Errors: GLINT_ARGUMENT for a view that cannot be; GLINT_INPUT from the file of angles;
 * GLINT_INTERNAL. On error *out is empty. */
glint_status view_points_make(const glint_material_view *view, view_points *out,
                              glint_errors *errors);
void view_points_free(view_points *points);

/* f, 1/sr, of a material at a point. */
double view_point_brdf(const glint_material *material, const view_point *point);
/* Whether f is made up at a point: light shines there, and nothing was measured around. */
bool view_point_is_unmeasured(const glint_material *material, const view_point *point, double f);
/* f cos(theta_i) cos(theta_r) at a point where f is known. */
double view_point_g(const view_point *point, double f);
/* The reflectance at a point of GLINT_VIEW_DHR and its error; a warning where it is worse than
 * aimed at. Errors: GLINT_INTERNAL. */
glint_status view_point_dhr(const char *label, const glint_material *material,
                            const view_point *point, double *dhr, double *error_bound,
                            glint_errors *errors);
/* What material k is called. */
const char *view_label(const glint_material_view *view, const glint_material *const *materials,
                       size_t k);

#endif
