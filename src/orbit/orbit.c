#include "orbit/orbit.h"

#include "base/constants.h"
#include "base/vec.h"
#include "orbit/earth.h"

#include <stdlib.h>

typedef enum orbit_kind { ORBIT_SGP4, ORBIT_KEPLER, ORBIT_GEOSTATIONARY, ORBIT_TABLE } orbit_kind;

struct orbit {
    orbit_kind kind;
    size_t n_sets;       /* ORBIT_SGP4 */
    orbit_set_use *uses; /* owned; n_sets, in the order of time */
    sgp4 **sgp4;         /* owned; n_sets */
    double epoch_s;      /* TT s from the start; Kepler; of a table: its reference */
    kepler_orbit kepler; /* ORBIT_KEPLER */
    double r_itrs_m[3];  /* ORBIT_GEOSTATIONARY */
    orbit_table *table;  /* owned; ORBIT_TABLE */
};

static glint_status orbit_new(orbit_kind kind, orbit **out, glint_error *error)
{
    *out = calloc(1, sizeof **out);
    if (!*out) return error_no_memory(error);
    (*out)->kind = kind;
    return GLINT_OK;
}

/* ---------------------------------------------------------------- element sets */

/* The set in use at t_s: the last whose use begins before. */
static size_t use_at(const orbit *o, double t_s)
{
    size_t lo = 0, hi = o->n_sets - 1;
    while (lo < hi) {
        const size_t middle = lo + (hi - lo) / 2;
        if (t_s > o->uses[middle].to_s)
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo;
}

static glint_status state_of_set(const orbit *o, size_t k, double t_s, sgp4_cursor *cursor,
                                 double r_teme_m[3], double v_teme_m_s[3], glint_error *error)
{
    return sgp4_state(o->sgp4[k], (t_s - o->uses[k].epoch_s) / 60.0, cursor, r_teme_m, v_teme_m_s,
                      error);
}

/* How far the satellite moves where set k takes over from the one before it. */
static void find_jump(orbit *o, size_t k)
{
    double before_m[3], after_m[3], unused[3];
    orbit_set_use *use = &o->uses[k];
    use->has_jump = !state_of_set(o, k - 1, use->from_s, NULL, before_m, unused, NULL) &&
                    !state_of_set(o, k, use->from_s, NULL, after_m, unused, NULL);
    if (!use->has_jump) return;
    sub3(after_m, before_m, after_m);
    use->jump_m = norm3(after_m);
}

static glint_status prepare_sets(orbit *o, const tle *sets, glint_error *error)
{
    for (size_t k = 0; k < o->n_sets; k++) {
        const glint_status status = sgp4_new(&sets[o->uses[k].index], &o->sgp4[k], error);
        if (status) return status;
        if (k > 0) find_jump(o, k);
    }
    return GLINT_OK;
}

/* Which sets are nearest to some moment of from_s..to_s, and when. */
static void divide_time(orbit *o, const tle *sets, size_t n, const run_clock *clock, double from_s,
                        double to_s)
{
    double begins_s = -INFINITY, epoch_s = 0;
    for (size_t k = 0; k < n; k++) {
        double tt_jd[2], next_s = INFINITY;
        utc_jd_to_tt(sets[k].epoch_jd, tt_jd, NULL);
        epoch_s = jd_difference_s(tt_jd, clock->tt_jd);
        if (k + 1 < n) {
            utc_jd_to_tt(sets[k + 1].epoch_jd, tt_jd, NULL);
            next_s = 0.5 * (epoch_s + jd_difference_s(tt_jd, clock->tt_jd));
        }
        if (next_s >= from_s && begins_s < to_s)
            o->uses[o->n_sets++] =
                (orbit_set_use){.index = k, .epoch_s = epoch_s, .from_s = begins_s, .to_s = next_s};
        begins_s = next_s;
    }
    o->uses[0].from_s = -INFINITY; /* moments outside belong to the sets at the ends */
    o->uses[o->n_sets - 1].to_s = INFINITY;
}

glint_status orbit_from_sets(const tle *sets, size_t n, const run_clock *clock, double from_s,
                             double to_s, orbit **out, glint_error *error)
{
    glint_status status = orbit_new(ORBIT_SGP4, out, error);
    if (status) return status;
    orbit *o = *out;
    o->uses = calloc(n, sizeof *o->uses);
    o->sgp4 = calloc(n, sizeof(sgp4 *));
    if (o->uses && o->sgp4) {
        divide_time(o, sets, n, clock, from_s, to_s);
        status = prepare_sets(o, sets, error);
    } else {
        status = error_no_memory(error);
    }
    if (!status) return GLINT_OK;
    orbit_free(o);
    *out = NULL;
    return status;
}

const orbit_set_use *orbit_sets(const orbit *o, size_t *n)
{
    *n = o->n_sets;
    return o->uses;
}

/* --------------------------------------------------------------- other orbits */

glint_status orbit_from_kepler(const kepler_elements *elements, double epoch_s, bool j2,
                               orbit **out, glint_error *error)
{
    *out = NULL;
    kepler_orbit kepler;
    glint_status status = kepler_start(elements, EARTH_MU_M3_S2, j2 ? earth_j2() : 0.0,
                                       EARTH_RADIUS_M, &kepler, error);
    if (status) return status;
    const double perigee_m = elements->semi_major_axis_m * (1.0 - elements->eccentricity);
    if (!(perigee_m >= EARTH_RADIUS_M))
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "the perigee of this orbit lies at a height of %.3f km, inside the Earth",
                         (perigee_m - EARTH_RADIUS_M) * 1e-3);
    status = orbit_new(ORBIT_KEPLER, out, error);
    if (status) return status;
    (*out)->kepler = kepler;
    (*out)->epoch_s = epoch_s;
    return GLINT_OK;
}

glint_status orbit_geostationary(double longitude, orbit **out, glint_error *error)
{
    const glint_status status = orbit_new(ORBIT_GEOSTATIONARY, out, error);
    if (status) return status;
    (*out)->r_itrs_m[0] = GEOSTATIONARY_RADIUS_M * cos(longitude);
    (*out)->r_itrs_m[1] = GEOSTATIONARY_RADIUS_M * sin(longitude);
    return GLINT_OK;
}

glint_status orbit_from_table(orbit_table *table, const run_clock *clock, orbit **out,
                              glint_error *error)
{
    const glint_status status = orbit_new(ORBIT_TABLE, out, error);
    if (status) {
        orbit_table_free(table);
        return status;
    }
    (*out)->table = table;
    (*out)->epoch_s = jd_difference_s(table->reference_jd, clock->tt_jd);
    return GLINT_OK;
}

const orbit_table *orbit_table_of(const orbit *o, double *reference_s)
{
    if (reference_s) *reference_s = o->epoch_s;
    return o->table;
}

void orbit_free(orbit *o)
{
    if (!o) return;
    for (size_t k = 0; k < o->n_sets && o->sgp4; k++)
        sgp4_free(o->sgp4[k]);
    free(o->sgp4);
    free(o->uses);
    orbit_table_free(o->table);
    free(o);
}

/* ------------------------------------------------------------------ evaluation */

unsigned orbit_wanted_frames(const orbit *o)
{
    bool teme = o->kind == ORBIT_SGP4;
    for (size_t k = 0; o->table && k < o->table->n; k++)
        teme = teme || o->table->segments[k].frame == TABLE_TEME;
    return teme ? FRAMES_TEME : 0u;
}

static glint_status sgp4_in_gcrs(const orbit *o, double t_s, const frame_set *frames,
                                 orbit_cursor *cursor, double r_gcrs_m[3], double v_gcrs_m_s[3],
                                 glint_error *error)
{
    double r_teme_m[3], v_teme_m_s[3];
    glint_error cause;
    const glint_status status = state_of_set(o, use_at(o, t_s), t_s, cursor ? &cursor->sgp4 : NULL,
                                             r_teme_m, v_teme_m_s, &cause);
    if (status)
        return error_set(error, status, (place){cause.file, cause.line, cause.column},
                         "no position at %.10g s from the start: %s", t_s, cause.message);
    mat_vec(frames->gcrs_teme, r_teme_m, r_gcrs_m);
    mat_vec(frames->gcrs_teme, v_teme_m_s, v_gcrs_m_s);
    return GLINT_OK;
}

/* The Earth's turn adds omega x r to a velocity against the Earth, with omega along ITRS z. */
static void itrs_in_gcrs(const double r_itrs_m[3], const double v_itrs_m_s[3],
                         const frame_set *frames, double r_gcrs_m[3], double v_gcrs_m_s[3])
{
    const double v_inertial_m_s[3] = {v_itrs_m_s[0] - EARTH_TURN_RAD_S * r_itrs_m[1],
                                      v_itrs_m_s[1] + EARTH_TURN_RAD_S * r_itrs_m[0],
                                      v_itrs_m_s[2]};
    mat_tvec(frames->itrs_gcrs, r_itrs_m, r_gcrs_m);
    mat_tvec(frames->itrs_gcrs, v_inertial_m_s, v_gcrs_m_s);
}

static glint_status table_in_gcrs(const orbit *o, double t_s, const frame_set *frames,
                                  double r_gcrs_m[3], double v_gcrs_m_s[3], glint_error *error)
{
    double r_m[3], v_m_s[3];
    table_frame frame;
    const glint_status status =
        orbit_table_state(o->table, t_s - o->epoch_s, &frame, r_m, v_m_s, error);
    if (status) return status;
    if (frame == TABLE_ITRS) {
        itrs_in_gcrs(r_m, v_m_s, frames, r_gcrs_m, v_gcrs_m_s);
    } else if (frame == TABLE_TEME) {
        mat_vec(frames->gcrs_teme, r_m, r_gcrs_m);
        mat_vec(frames->gcrs_teme, v_m_s, v_gcrs_m_s);
    } else {
        copy3(r_m, r_gcrs_m);
        copy3(v_m_s, v_gcrs_m_s);
    }
    return GLINT_OK;
}

glint_status orbit_state(const orbit *o, double t_s, const frame_set *frames, orbit_cursor *cursor,
                         double r_gcrs_m[3], double v_gcrs_m_s[3], glint_error *error)
{
    switch (o->kind) {
    case ORBIT_SGP4:
        return sgp4_in_gcrs(o, t_s, frames, cursor, r_gcrs_m, v_gcrs_m_s, error);
    case ORBIT_KEPLER:
        kepler_state(&o->kepler, t_s - o->epoch_s, r_gcrs_m, v_gcrs_m_s);
        return GLINT_OK;
    case ORBIT_GEOSTATIONARY:
        itrs_in_gcrs(o->r_itrs_m, (const double[3]){0, 0, 0}, frames, r_gcrs_m, v_gcrs_m_s);
        return GLINT_OK;
    case ORBIT_TABLE:
        return table_in_gcrs(o, t_s, frames, r_gcrs_m, v_gcrs_m_s, error);
    }
    return GLINT_INTERNAL;
}
