/* geometry.h: where everything is during one tile of rows: orbit, frames, site, attitude, hinges,
 * the Earth's shadow; and the light in each component's frame. */
#ifndef GLINT_LIGHTCURVE_GEOMETRY_H
#define GLINT_LIGHTCURVE_GEOMETRY_H

#include "facets/visibility.h"
#include "scenario/scenario.h"

enum { TILE = BRDF_TILE };

/* One tile: rows first .. first + n - 1 of the run; spare lanes up to TILE repeat the last row. SI
 * and radians. */
typedef struct tile_geometry {
    int64_t first;
    int n;
    double t_s[TILE];         /* reception, TT s from the start */
    double range_m[TILE];     /* observer to satellite along the light path */
    double phase_angle[TILE]; /* at the satellite, between Sun and observer */
    double sunlit[TILE];      /* visible fraction of the solar disc */
    double sun_radius[TILE];  /* angular, of the solar disc */
    double sun_weight[TILE];  /* sunlit x (1 au / distance of the Sun)^2 */
    double azimuth[TILE], elevation[TILE], sun_elevation[TILE]; /* of a site */
    double height_m[TILE]; /* geodetic, of the satellite; only with GEOMETRY_HEIGHT */
    double angular_rate[TILE]; /* of the satellite against the stars, rad/s; good to 1e-4 */
    bool seen[TILE];       /* not below the horizon */
    bool any_bright;       /* some lane is seen and sunlit: the sum is needed */
    double sun[TILE][3], observer[TILE][3]; /* unit; GCRS, or body where directions are given */
} tile_geometry;

enum { GEOMETRY_HEIGHT = 1u };

/* What one thread needs besides: zero-initialise but the arrays. */
typedef struct geometry_worker {
    orbit_cursor cursor;
    double (
        *component_gcrs)[9]; /* n_components: v_component = R v_gcrs (or body), scratch; owned */
    visibility_pose *poses;  /* TILE x n_components, in the frame of tile_geometry.sun; owned; NULL
                                where  nobody asks where components are */
    double (*body)[9];       /* TILE; v_body = R v of that frame; owned; NULL likewise */
} geometry_worker;

/* Fills a tile and the light in each of the n_components frames.
 * grid: covers the rows' times; NULL for [geometry] runs. Errors (GLINT_INPUT): orbit or attitude
 * not defined at some time. */
glint_status geometry_fill(const glint_scenario *s, const frame_grid *grid, unsigned wanted,
                           int64_t first, int n, geometry_worker *worker, tile_geometry *out,
                           brdf_light *lights, glint_error *error);

/* The same of a run with an orbit at n <= TILE times of reception of any order, t_s (TT s from the
 * start), instead of rows; out->first is 0. */
glint_status geometry_fill_at(const glint_scenario *s, const frame_grid *grid, unsigned wanted,
                              const double *t_s, int n, geometry_worker *worker, tile_geometry *out,
                              brdf_light *lights, glint_error *error);

/* The first time after t_s, both of emission, at which the rates of the body or of a hinge may
 * jump; INFINITY where there is none. */
double satellite_next_change(const glint_scenario *s, double t_s);

/* Orientation of every component at one moment, and the angles of their hinges (rad; 0 without
 * one). component_gcrs, hinge_rad (NULL allowed): n_components. Errors (GLINT_INPUT): attitude or a
 * hinge's target not defined. */
glint_status satellite_turn(const glint_scenario *s, const moment *m, double body_gcrs[9],
                            double (*component_gcrs)[9], double *hinge_rad, glint_error *error);
/* Azimuth (0..2 pi, from north through east) and elevation at the site of a unit vector in GCRS. */
void sky_place(const glint_scenario *s, const frame_set *frames, const double gcrs[3],
               double *azimuth, double *elevation);

/* Plans the shadows that the satellite's parts cast on each other. Errors: GLINT_INTERNAL (memory).
 */
glint_status satellite_plan_shadows(const satellite *sat, visibility **out, glint_error *error);

/* counts[on n + by] of n = sat->n_components: visibility_count_exposed. Errors: GLINT_INTERNAL
 * (memory). */
glint_status satellite_count_shadowed(const satellite *sat, int *counts, glint_error *error);

/* Satellite as seen from a site at reception time t_s: all in GCRS. */
typedef struct sighting {
    frame_set frames; /* at reception */
    moment moment;    /* at emission */
    double range_m;
    double sight_gcrs[3]; /* unit, site to satellite, along the light path */
    double site_gcrs_m[3];
    double sun_distance_m; /* from the satellite */
    double light_time_s;
} sighting;

/* Finds where the satellite is seen. guess_s: first guess of the light time (0 will do). Errors as
 * above. */
glint_status sighting_at(const glint_scenario *s, const frame_grid *grid, double t_s,
                         double guess_s, orbit_cursor *cursor, sighting *out, glint_error *error);

#endif
