/* geometry.h: where everything is during one tile of rows: orbit, frames, site, attitude, hinges,
 * the Earth's shadow; and the light in each component's frame. */
#ifndef GLINT_LIGHTCURVE_GEOMETRY_H
#define GLINT_LIGHTCURVE_GEOMETRY_H

#include "facets/visibility.h"
#include "lightcurve/sighting.h"

enum { TILE = BRDF_TILE };

/* One tile: rows first .. first + n - 1 of the run; spare lanes up to TILE repeat the last row. SI
 * and radians. */
typedef struct tile_geometry {
    int64_t first;
    int n;
    double t_s[TILE];             /* reception, TT s from the start */
    double range_m[TILE];         /* observer to satellite along the light path */
    double phase_angle[TILE];     /* at the satellite, between Sun and observer */
    double sunlit[TILE];          /* visible fraction of the solar disc */
    double sun_radius[TILE];      /* angular, of the solar disc */
    double sun_weight[TILE];      /* sunlit x (1 au / distance of the Sun)^2 */
    const scenario_observer *who; /* borrowed; NULL where directions are given */
    double azimuth[TILE], elevation[TILE], sun_elevation[TILE]; /* of a site; else 0 */
    bool moon_covers[TILE]; /* the Moon takes a part of the solar disc */
    /* Only with GEOMETRY_MOON; azimuth and elevation of a site, else 0: */
    double moon_azimuth[TILE], moon_elevation[TILE];
    double moon_separation[TILE];  /* between satellite and Moon, from the observer */
    double moon_illuminated[TILE]; /* fraction of its disc */
    double height_m[TILE];         /* geodetic, of the satellite; only with GEOMETRY_HEIGHT */
    double satellite_m[TILE][3];   /* from the Earth's centre, GCRS; unset in [geometry] runs */
    double sun_distance_m[TILE];   /* from the satellite; likewise */
    double angular_rate[TILE];     /* against the stars, rad/s, only with GEOMETRY_RATE: good to
                                      1e-4, under J2 to 2e-3 */
    bool seen[TILE];               /* not below the horizon, not behind the Earth */
    bool any_bright;               /* some lane is seen and sunlit: the sum is needed */
    double sun[TILE][3], observer[TILE][3]; /* unit; GCRS, or body where directions are given */
} tile_geometry;

enum { GEOMETRY_HEIGHT = 1u, GEOMETRY_MOON = 2u, GEOMETRY_RATE = 4u };

/* What one thread needs besides: zero-initialise but the arrays and the viewer. */
typedef struct geometry_worker {
    viewer viewer; /* unused where directions are given */
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
/* Plans the shadows that the satellite's parts cast on each other. Errors: GLINT_INTERNAL (memory).
 */
glint_status satellite_plan_shadows(const satellite *sat, visibility **out, glint_error *error);

/* counts[on n + by] of n = sat->n_components: visibility_count_exposed. Errors: GLINT_INTERNAL
 * (memory). */
glint_status satellite_count_shadowed(const satellite *sat, int *counts, glint_error *error);

#endif
