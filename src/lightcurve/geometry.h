/* geometry.h: where everything is during one tile of rows: orbit, frames, site, attitude, hinges,
 * the Earth's shadow; and the light in each component's frame. */
#ifndef GLINT_LIGHTCURVE_GEOMETRY_H
#define GLINT_LIGHTCURVE_GEOMETRY_H

#include "scenario/scenario.h"

enum { TILE = BRDF_TILE };

/* One tile: rows first .. first + n - 1 of the run; spare lanes up to TILE repeat the last row. SI and
 * radians. */
typedef struct tile_geometry {
    int64_t first;
    int n;
    double t_s[TILE];           /* reception, TT s from the start */
    double range_m[TILE];       /* observer to satellite along the light path */
    double phase_angle[TILE];   /* at the satellite, between Sun and observer */
    double sunlit[TILE];        /* visible fraction of the solar disc */
    double sun_weight[TILE];    /* sunlit x (1 au / distance of the Sun)^2 */
    double azimuth[TILE], elevation[TILE], sun_elevation[TILE]; /* of a site */
    double height_m[TILE];      /* geodetic, of the satellite; only with GEOMETRY_HEIGHT */
    bool seen[TILE];            /* not below the horizon */
    bool any_bright;            /* some lane is seen and sunlit: the sum is needed */
} tile_geometry;

enum { GEOMETRY_HEIGHT = 1u };

/* What one thread needs besides: zero-initialise. */
typedef struct geometry_worker {
    orbit_cursor cursor;
    double (*component_gcrs)[9]; /* n_components: v_component = R v_gcrs (or body), scratch; owned */
} geometry_worker;

/* Fills a tile and the light in each of the n_components frames.
 * grid: covers the rows' times; NULL for [geometry] runs. Errors (GLINT_INPUT): orbit or attitude not
 * defined at some time. */
glint_status geometry_fill(const glint_scenario *s, const frame_grid *grid, unsigned wanted,
                           int64_t first, int n, geometry_worker *worker, tile_geometry *out,
                           brdf_light *lights, glint_error *error);

/* Satellite as seen from a site at reception time t_s: all in GCRS. */
typedef struct sighting {
    frame_set frames;    /* at reception */
    moment moment;       /* at emission */
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
