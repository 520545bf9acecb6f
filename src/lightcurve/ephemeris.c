/* ephemeris.c: positions, directions and angles over time, frame by frame. */
#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "lightcurve/facts.h"
#include "lightcurve/tile.h"
#include "lightcurve/watch.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 2048 }; /* rows computed together */

/* The part of the scenario that a column needs. */
typedef enum column_need {
    NEED_NOTHING,
    NEED_SITE,  /* some observer is one; only its rows have a number */
    NEED_PLACE, /* some observer is no direction, whose motion is not known; likewise */
    NEED_TEME,
    NEED_ATTITUDE
} column_need;

/* A column: where its number stands in a row, what to multiply it with, and which rows have it. */
typedef struct ephemeris_column {
    size_t offset;
    double unit;
    int hinge; /* index among the hinges; -1: not one */
    column_need need;
} ephemeris_column;

/* What one thread needs. */
typedef struct ephemeris_worker {
    watch w;
    double (*component_gcrs)[9]; /* owned; n_components */
    double *hinge_rad;           /* owned; n_components */
} ephemeris_worker;

struct glint_ephemeris {
    const glint_scenario *s; /* borrowed */
    int n_threads, n_hinges;
    ephemeris_worker *workers; /* owned; n_threads */
    int64_t next;
    glint_ephemeris_row *rows; /* owned; BLOCK */
    double *hinge_rad;         /* owned; BLOCK x n_hinges */
    glint_column *columns;     /* owned */
    ephemeris_column *places;  /* owned */
    char **names;              /* owned, each: of the hinges' columns */
    size_t n_columns;
    fact_list facts;
};

/* ------------------------------------------------------------------ columns */

#define AT(field) offsetof(glint_ephemeris_row, field)
#define AT3(field, i) (offsetof(glint_ephemeris_row, field) + (i) * sizeof(double))

static const double KM = 1e-3, TO_DEG = 1 / DEG, TO_ARCSEC = 1 / ARCSEC;

#define POSITION(axis, i, frame, need)                                                             \
    {                                                                                              \
        axis "_" #frame "_km", "km", "geocentric, when the light left", AT3(r_##frame##_m, i),     \
            &KM, need                                                                              \
    }
#define VELOCITY(axis, i, frame, need)                                                             \
    {                                                                                              \
        "v" axis "_" #frame "_km_s", "km / s", "when the light left; ITRS: against the Earth",     \
            AT3(v_##frame##_m_s, i), &KM, need                                                     \
    }

static const struct {
    const char *name, *unit, *description;
    size_t offset;
    const double *scale; /* NULL: 1 */
    column_need need;
} COLUMNS[] = {
    {"t_s", "s", "TT seconds from the start", AT(t_s), NULL, NEED_NOTHING},
    {"ra_deg", "deg", "right ascension from the observer, ICRS axes, along the light path",
     AT(ra_rad), &TO_DEG, NEED_NOTHING},
    {"dec_deg", "deg", "declination from the observer, ICRS axes, along the light path",
     AT(dec_rad), &TO_DEG, NEED_NOTHING},
    {"rate_arcsec_s", "arcsec / s", "angular rate against the stars", AT(angular_rate_rad_s),
     &TO_ARCSEC, NEED_PLACE},
    {"azimuth_deg", "deg", "from north through east", AT(azimuth_rad), &TO_DEG, NEED_SITE},
    {"elevation_deg", "deg", "geometric, or apparent where the site has refraction",
     AT(elevation_rad), &TO_DEG, NEED_SITE},
    {"range_km", "km", "observer to satellite", AT(range_m), &KM, NEED_NOTHING},
    {"range_rate_km_s", "km / s", "positive when receding", AT(range_rate_m_s), &KM, NEED_PLACE},
    {"sun_elevation_deg", "deg", "of the Sun at the site, geometric", AT(sun_elevation_rad),
     &TO_DEG, NEED_SITE},
    {"sun_separation_deg", "deg", "between satellite and Sun, from the observer",
     AT(sun_separation_rad), &TO_DEG, NEED_NOTHING},
    {"moon_separation_deg", "deg", "between satellite and Moon, from the observer",
     AT(moon_separation_rad), &TO_DEG, NEED_NOTHING},
    {"phase_angle_deg", "deg", "at the satellite, between Sun and observer; 0 is full",
     AT(phase_angle_rad), &TO_DEG, NEED_NOTHING},
    {"sunlit_fraction", "", "visible part of the solar disc, seen from the satellite",
     AT(sunlit_fraction), NULL, NEED_NOTHING},
    {"beta_deg", "deg", "of the Sun above the plane of the orbit, positive towards r x v",
     AT(beta_rad), &TO_DEG, NEED_NOTHING},
    {"latitude_deg", "deg", "geodetic, of the point below the satellite", AT(latitude_rad), &TO_DEG,
     NEED_NOTHING},
    {"longitude_deg", "deg", "east, of the point below the satellite", AT(longitude_rad), &TO_DEG,
     NEED_NOTHING},
    {"height_km", "km", "above the WGS84 ellipsoid", AT(height_m), &KM, NEED_NOTHING},
    POSITION("x", 0, gcrs, NEED_NOTHING),
    POSITION("y", 1, gcrs, NEED_NOTHING),
    POSITION("z", 2, gcrs, NEED_NOTHING),
    VELOCITY("x", 0, gcrs, NEED_NOTHING),
    VELOCITY("y", 1, gcrs, NEED_NOTHING),
    VELOCITY("z", 2, gcrs, NEED_NOTHING),
    POSITION("x", 0, itrs, NEED_NOTHING),
    POSITION("y", 1, itrs, NEED_NOTHING),
    POSITION("z", 2, itrs, NEED_NOTHING),
    VELOCITY("x", 0, itrs, NEED_NOTHING),
    VELOCITY("y", 1, itrs, NEED_NOTHING),
    VELOCITY("z", 2, itrs, NEED_NOTHING),
    POSITION("x", 0, teme, NEED_TEME),
    POSITION("y", 1, teme, NEED_TEME),
    POSITION("z", 2, teme, NEED_TEME),
    VELOCITY("x", 0, teme, NEED_TEME),
    VELOCITY("y", 1, teme, NEED_TEME),
    VELOCITY("z", 2, teme, NEED_TEME),
    {"q_w", "", "quaternion that turns body axes into GCRS, scalar part", AT3(quaternion_wxyz, 0),
     NULL, NEED_ATTITUDE},
    {"q_x", "", "its x", AT3(quaternion_wxyz, 1), NULL, NEED_ATTITUDE},
    {"q_y", "", "its y", AT3(quaternion_wxyz, 2), NULL, NEED_ATTITUDE},
    {"q_z", "", "its z", AT3(quaternion_wxyz, 3), NULL, NEED_ATTITUDE},
};

enum { N_COLUMNS = sizeof COLUMNS / sizeof *COLUMNS };

/* Whether an observer has what a column needs of it. */
static bool observer_has(const scenario_observer *o, column_need need)
{
    if (need == NEED_SITE) return o->kind == OBSERVER_SITE;
    return need == NEED_PLACE ? o->kind != OBSERVER_DIRECTION : true;
}

static bool has(const glint_scenario *s, column_need need)
{
    if (need == NEED_TEME) return orbit_wanted_frames(s->orbit.propagator) & FRAMES_TEME;
    if (need == NEED_ATTITUDE) return s->has_attitude;
    for (int k = 0; k < s->n_observers; k++)
        if (observer_has(&s->observers[k], need)) return true;
    return false;
}

static void add_column(glint_ephemeris *e, glint_column column, ephemeris_column at)
{
    e->columns[e->n_columns] = column;
    e->places[e->n_columns++] = at;
}

static bool add_hinges(glint_ephemeris *e)
{
    const satellite *sat = &e->s->satellite;
    for (int c = 0, k = 0; c < sat->n_components && e->n_hinges > 0; c++) {
        if (!sat->components[c].has_hinge) continue;
        text name = {0};
        text_printf(&name, "hinge_%s_deg", sat->components[c].name);
        if (name.failed) return false;
        e->names[k] = name.data;
        add_column(e, (glint_column){name.data, "deg", "angle of the component's hinge", false},
                   (ephemeris_column){0, TO_DEG, k++, NEED_NOTHING});
    }
    return true;
}

static bool make_columns(glint_ephemeris *e)
{
    const size_t most = 2 + N_COLUMNS + (size_t)e->n_hinges;
    e->columns = calloc(most, sizeof *e->columns);
    e->places = calloc(most, sizeof *e->places);
    e->names = calloc((size_t)e->n_hinges + 1, sizeof *e->names);
    if (!e->columns || !e->places || !e->names) return false;
    add_column(e, (glint_column){"utc", "", "UTC of reception at the observer", true},
               (ephemeris_column){0, 0, -1, NEED_NOTHING});
    if (e->s->n_observers > 1)
        add_column(e, (glint_column){"observer", "", "name of the observer", true},
                   (ephemeris_column){0, 0, -1, NEED_NOTHING});
    for (size_t k = 0; k < N_COLUMNS; k++)
        if (has(e->s, COLUMNS[k].need))
            add_column(
                e, (glint_column){COLUMNS[k].name, COLUMNS[k].unit, COLUMNS[k].description, false},
                (ephemeris_column){COLUMNS[k].offset, COLUMNS[k].scale ? *COLUMNS[k].scale : 1, -1,
                                   COLUMNS[k].need});
    return add_hinges(e);
}

bool glint_ephemeris_value(const glint_ephemeris *e, const glint_ephemeris_row *row, size_t column,
                           double *value)
{
    if (column >= e->n_columns || e->columns[column].is_text) return false;
    const ephemeris_column *at = &e->places[column];
    if (!observer_has(e->s->observers + row->observer, at->need)) return false;
    double number;
    if (at->hinge >= 0)
        number = row->hinge_rad[at->hinge];
    else
        memcpy(&number, (const char *)row + at->offset, sizeof number);
    *value = number * at->unit;
    return true;
}

/* ---------------------------------------------------------------------- rows */

/* Direction and distance as they change. Light that arrives now left a time range/c ago, so that
 * the satellite seems to move at v (1 - range_rate/c). */
static void fill_rates(const sighting *seen, glint_ephemeris_row *row)
{
    const double *u = seen->sight_gcrs, *v = seen->moment.v_m_s, *own = seen->observer_v_m_s;
    double relative[3];
    const double along = dot3(u, v), late = seen->light_time_s > 0 ? along / LIGHT_SPEED_M_S : 0;
    row->range_rate_m_s = (along - dot3(u, own)) / (1 + late);
    const double slowed = seen->light_time_s > 0 ? 1 - row->range_rate_m_s / LIGHT_SPEED_M_S : 1;
    for (int i = 0; i < 3; i++)
        relative[i] = slowed * v[i] - own[i];
    add_scaled3(relative, -dot3(relative, u), u, relative);
    row->angular_rate_rad_s = norm3(relative) / seen->range_m;
}

static void fill_sky(const glint_scenario *s, viewer *v, const sighting *seen,
                     glint_ephemeris_row *row)
{
    const double *u = seen->sight_gcrs;
    double sun[3], moon[3], distance_m;
    row->ra_rad = atan2(u[1], u[0]);
    if (row->ra_rad < 0) row->ra_rad = fmod(row->ra_rad + TWO_PI, TWO_PI);
    row->dec_rad = atan2(u[2], hypot(u[0], u[1]));
    if (v->observer->kind == OBSERVER_SITE) {
        sighting_place(v->observer, seen, &row->azimuth_rad, &row->elevation_rad);
        row->sun_elevation_rad = sighting_sun_elevation(s, v->observer, seen);
    }
    sun_from_point(&seen->frames, seen->observer_gcrs_m, s->aberration, sun, &distance_m);
    row->sun_separation_rad = angle3(u, sun);
    sighting_moon(s, v, seen, row->t_s, moon);
    row->moon_separation_rad = angle3(u, moon);
}

static void fill_frames(const glint_scenario *s, const sighting *seen, const double spin[3],
                        glint_ephemeris_row *row)
{
    const moment *m = &seen->moment;
    double carried[3], fixed[3];
    copy3(m->r_m, row->r_gcrs_m);
    copy3(m->v_m_s, row->v_gcrs_m_s);
    cross3(spin, m->r_m, carried);
    sub3(m->v_m_s, carried, fixed);
    mat_vec(m->itrs_gcrs, m->r_m, row->r_itrs_m);
    mat_vec(m->itrs_gcrs, fixed, row->v_itrs_m_s);
    earth_geodetic(row->r_itrs_m, &row->latitude_rad, &row->longitude_rad, &row->height_m);
    if (!has(s, NEED_TEME)) return;
    mat_tvec(seen->frames.gcrs_teme, m->r_m, row->r_teme_m);
    mat_tvec(seen->frames.gcrs_teme, m->v_m_s, row->v_teme_m_s);
}

static glint_status fill_attitude(const glint_ephemeris *e, ephemeris_worker *worker,
                                  const moment *m, glint_ephemeris_row *row, double *hinge_rad,
                                  glint_error *error)
{
    const satellite *sat = &e->s->satellite;
    double body_gcrs[9], gcrs_body[9];
    glint_status status;
    if (!e->s->has_attitude) return GLINT_OK;
    if (e->n_hinges > 0)
        status =
            satellite_turn(e->s, m, body_gcrs, worker->component_gcrs, worker->hinge_rad, error);
    else
        status = attitude_plan_at(&e->s->attitude, m, body_gcrs, error);
    if (status) return status;
    mat_transpose(body_gcrs, gcrs_body);
    quat_from_mat(gcrs_body, row->quaternion_wxyz);
    for (int c = 0, k = 0; k < e->n_hinges; c++)
        if (sat->components[c].has_hinge) hinge_rad[k++] = worker->hinge_rad[c];
    return GLINT_OK;
}

static glint_status fill_row(const glint_ephemeris *e, ephemeris_worker *worker, int64_t number,
                             glint_ephemeris_row *row, double *hinge_rad, glint_error *error)
{
    const glint_scenario *s = e->s;
    sighting seen;
    *row = (glint_ephemeris_row){.t_s = (double)(number % s->n_steps) * s->step_s,
                                 .observer = (size_t)(number / s->n_steps),
                                 .hinge_rad = hinge_rad};
    const scenario_observer *o = s->observers + row->observer;
    row->observer_name = o->name;
    if (worker->w.viewer.observer != o) worker->w.viewer = (viewer){.observer = o};
    const glint_status status = watch_at(&worker->w, row->t_s, &seen, error);
    if (status) return status;
    const moment *m = &seen.moment;
    double spin[3], normal[3];
    scale3(m->itrs_gcrs + 6, EARTH_TURN_RAD_S, spin);
    run_clock_utc(&s->clock, row->t_s, &row->utc);
    row->range_m = seen.range_m;
    fill_rates(&seen, row);
    fill_sky(s, &worker->w.viewer, &seen, row);
    fill_frames(s, &seen, spin, row);
    row->phase_angle_rad = angle3(m->sun, m->observer);
    row->sunlit_fraction = sighting_sunlit(s, &worker->w.viewer, &seen, NULL);
    cross3(m->r_m, m->v_m_s, normal);
    row->beta_rad = 0.5 * PI - angle3(normal, m->sun);
    return fill_attitude(e, worker, m, row, hinge_rad, error);
}

/* ---------------------------------------------------------------- the whole */

static int count_hinges(const glint_scenario *s)
{
    int n = 0;
    for (int c = 0; c < s->satellite.n_components && s->has_attitude; c++)
        n += s->satellite.components[c].has_hinge;
    return n;
}

static bool make_workers(glint_ephemeris *e)
{
    const size_t n = (size_t)e->s->satellite.n_components + 1;
    e->workers = calloc((size_t)e->n_threads, sizeof *e->workers);
    for (int i = 0; e->workers && i < e->n_threads; i++) {
        ephemeris_worker *w = &e->workers[i];
        w->w.s = e->s;
        w->component_gcrs = calloc(n, sizeof *w->component_gcrs);
        w->hinge_rad = calloc(n, sizeof *w->hinge_rad);
        if (!w->component_gcrs || !w->hinge_rad) return false;
    }
    return e->workers;
}

glint_status glint_ephemeris_open(const glint_scenario *s, int threads, glint_ephemeris **out,
                                  glint_error *error)
{
    int n_threads;
    *out = NULL;
    if (s->has_geometry)
        return error_set(error, GLINT_INPUT, (place){s->documents[0]->path, 0, 0},
                         "[geometry] gives directions, so there are no positions; expected [time], "
                         "[observer] and [orbit]");
    const glint_status status = tile_count_threads(threads, &n_threads, error);
    if (status) return status;
    glint_ephemeris *e = calloc(1, sizeof *e);
    if (!e) return error_no_memory(error);
    e->s = s;
    e->n_threads = n_threads;
    e->n_hinges = count_hinges(s);
    e->rows = calloc(BLOCK, sizeof *e->rows);
    e->hinge_rad = calloc((size_t)BLOCK * (size_t)e->n_hinges + 1, sizeof(double));
    facts_of_orbit(s, &e->facts);
    if (!e->rows || !e->hinge_rad || e->facts.failed || !make_workers(e) || !make_columns(e)) {
        glint_ephemeris_close(e);
        return error_no_memory(error);
    }
    *out = e;
    return GLINT_OK;
}

void glint_ephemeris_close(glint_ephemeris *e)
{
    if (!e) return;
    for (int i = 0; e->workers && i < e->n_threads; i++) {
        watch_free(&e->workers[i].w);
        free(e->workers[i].component_gcrs);
        free(e->workers[i].hinge_rad);
    }
    for (int k = 0; e->names && k < e->n_hinges; k++)
        free(e->names[k]);
    free(e->workers);
    free(e->rows);
    free(e->hinge_rad);
    free(e->columns);
    free(e->places);
    free(e->names);
    fact_list_free(&e->facts);
    free(e);
}

enum { CHUNK = 64 }; /* rows that one thread does in order */

/* The rows of a block. */
typedef struct block {
    glint_ephemeris *e;
    int n;
} block;

static glint_status fill_chunk(void *context, int thread, int64_t chunk, glint_error *error)
{
    const block *b = context;
    glint_ephemeris *e = b->e;
    const int first = (int)chunk * CHUNK, end = first + CHUNK < b->n ? first + CHUNK : b->n;
    /* A chunk must not know what its thread did before: guesses decide last digits. */
    e->workers[thread].w.light_time_s = 0;
    for (int k = first; k < end; k++) {
        const glint_status status = fill_row(e, &e->workers[thread], e->next + k, &e->rows[k],
                                             e->hinge_rad + (size_t)k * (size_t)e->n_hinges, error);
        if (status) return status;
    }
    return GLINT_OK;
}

/* The error of the earliest row wins. */
static glint_status fill_block(glint_ephemeris *e, int n, glint_error *error)
{
    block b = {e, n};
    return tiles_do(fill_chunk, &b, (n + CHUNK - 1) / CHUNK, e->n_threads, error);
}

glint_status glint_ephemeris_next(glint_ephemeris *e, const glint_ephemeris_row **rows, size_t *n,
                                  glint_error *error)
{
    const int64_t all = glint_ephemeris_length(e), n_steps = e->s->n_steps;
    const int64_t left = e->next < all ? n_steps - e->next % n_steps : 0; /* of one observer */
    const int count = left < BLOCK ? (int)left : BLOCK;
    *rows = e->rows;
    *n = 0;
    const glint_status status = fill_block(e, count, error);
    if (status) {
        if (error && !error->file[0])
            snprintf(error->file, sizeof error->file, "%s", e->s->documents[0]->path);
        return status;
    }
    *n = (size_t)count;
    e->next += count;
    return GLINT_OK;
}

int64_t glint_ephemeris_length(const glint_ephemeris *e)
{
    return e->s->n_steps * e->s->n_observers;
}

int64_t glint_ephemeris_done(const glint_ephemeris *e)
{
    return e->next;
}

const glint_column *glint_ephemeris_columns(const glint_ephemeris *e, size_t *n)
{
    *n = e->n_columns;
    return e->columns;
}

bool glint_ephemeris_fact(const glint_ephemeris *e, size_t k, const char **key, const char **value)
{
    return fact_list_get(&e->facts, k, key, value);
}

bool glint_ephemeris_reads(const glint_ephemeris *e, const char *path)
{
    return file_list_has(&e->s->files, path);
}
