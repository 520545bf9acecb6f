/* sighting.h: the satellite as one observer sees it at one moment. */
#ifndef GLINT_LIGHTCURVE_SIGHTING_H
#define GLINT_LIGHTCURVE_SIGHTING_H

#include "orbit/moon.h"
#include "scenario/scenario.h"

/* An observer, and what one thread keeps between looks through its eyes; results do not depend on
 * it. Zero-initialise, set `observer`; start anew for another observer. */
typedef struct viewer {
    const scenario_observer *observer; /* borrowed, of the scenario */
    orbit_cursor target, own;          /* of the satellite's orbit; of the observer's */
    moon_cursor moon;
    double no_moon_from_s, no_moon_to_s; /* between these the Moon is far from the Sun, seen from
                                            the satellite; TT s of emission */
} viewer;

/* Satellite as seen at reception time t_s: all in GCRS. */
typedef struct sighting {
    frame_set frames; /* at reception */
    moment moment;    /* at emission */
    double range_m;
    double sight_gcrs[3]; /* unit, observer to satellite, along the light path */
    double observer_gcrs_m[3], observer_v_m_s[3]; /* of a direction: velocity 0 */
    double sun_distance_m;                        /* from the satellite */
    double light_time_s;
} sighting;

/* Finds where the satellite is seen. guess_s: first guess of the light time (0 will do). Errors
 * (GLINT_INPUT): an orbit, or the attitude that a direction is fixed to, is not defined. */
glint_status sighting_at(const glint_scenario *s, const frame_grid *grid, double t_s,
                         double guess_s, viewer *v, sighting *out, glint_error *error);

/* What frames a sighting takes, as of frame_grid_at. */
unsigned sighting_wanted_frames(const glint_scenario *s, const viewer *v);
/* The same as sighting_at where out->frames is filled in already. */
glint_status sighting_complete(const glint_scenario *s, double t_s, double guess_s, viewer *v,
                               sighting *out, glint_error *error);

/* East, north, up of a site, of a vector in GCRS. */
void sky_axes(const scenario_observer *site, const frame_set *frames, const double gcrs[3],
              double enu[3]);
/* Azimuth (0..2 pi, from north through east) and elevation, geometric, at a site of a unit vector
 * in GCRS. */
void sky_place(const scenario_observer *site, const frame_set *frames, const double gcrs[3],
               double *azimuth, double *elevation);
/* The same of the satellite, the elevation as it appears: with the refraction that the site asks
 * for. */
void sighting_place(const scenario_observer *site, const sighting *seen, double *azimuth,
                    double *elevation);
/* The Sun's elevation at a site at reception: topocentric, geometric. */
double sighting_sun_elevation(const glint_scenario *s, const scenario_observer *site,
                              const sighting *seen);
/* Visible fraction of the solar disc past the Earth and the Moon, as the satellite sees it.
 * moon_covers: whether the Moon takes a part of it; NULL allowed. */
double sighting_sunlit(const glint_scenario *s, viewer *v, const sighting *seen, bool *moon_covers);
/* Angle between the rims of Moon and Sun as the satellite sees them, rad; negative where the Moon
 * covers a part of the Sun. */
double sighting_moon_gap(const glint_scenario *s, viewer *v, const sighting *seen);
/* The Moon at reception, m, from the observer. */
void sighting_moon(const glint_scenario *s, viewer *v, const sighting *seen, double t_s,
                   double moon_m[3]);

#endif
