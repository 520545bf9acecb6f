#include "orbit/orbit.h"

#include "base/constants.h"
#include "base/vec.h"
#include "orbit/earth.h"

#include <stdlib.h>

typedef enum orbit_kind { ORBIT_SGP4, ORBIT_KEPLER, ORBIT_GEOSTATIONARY } orbit_kind;

struct orbit {
    orbit_kind kind;
    double epoch_s;      /* TT s from the start; SGP4 and Kepler */
    sgp4 *sgp4;          /* owned; ORBIT_SGP4 */
    kepler_orbit kepler; /* ORBIT_KEPLER */
    double r_itrs_m[3];  /* ORBIT_GEOSTATIONARY */
};

static glint_status orbit_new(orbit_kind kind, orbit **out, glint_error *error)
{
    *out = calloc(1, sizeof **out);
    if (!*out) return error_no_memory(error);
    (*out)->kind = kind;
    return GLINT_OK;
}

glint_status orbit_from_tle(const tle *elements, const run_clock *clock, orbit **out,
                            glint_error *error)
{
    glint_status status = orbit_new(ORBIT_SGP4, out, error);
    if (status) return status;
    status = sgp4_new(elements, &(*out)->sgp4, error);
    if (status) {
        orbit_free(*out);
        *out = NULL;
        return status;
    }
    double epoch_tt_jd[2];
    utc_jd_to_tt(elements->epoch_jd, epoch_tt_jd, NULL);
    (*out)->epoch_s = jd_difference_s(epoch_tt_jd, clock->tt_jd);
    return GLINT_OK;
}

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

void orbit_free(orbit *o)
{
    if (!o) return;
    sgp4_free(o->sgp4);
    free(o);
}

unsigned orbit_wanted_frames(const orbit *o)
{
    return o->kind == ORBIT_SGP4 ? FRAMES_TEME : 0u;
}

static glint_status sgp4_in_gcrs(const orbit *o, double t_s, const frame_set *frames,
                                 orbit_cursor *cursor, double r_gcrs_m[3], double v_gcrs_m_s[3],
                                 glint_error *error)
{
    double r_teme_m[3], v_teme_m_s[3];
    glint_error cause;
    const glint_status status =
        sgp4_state(o->sgp4, (t_s - o->epoch_s) / 60.0, cursor ? &cursor->sgp4 : NULL, r_teme_m,
                   v_teme_m_s, &cause);
    if (status)
        return error_set(error, status, (place){cause.file, cause.line, cause.column},
                         "no position at %.10g s from the start: %s", t_s, cause.message);
    mat_vec(frames->gcrs_teme, r_teme_m, r_gcrs_m);
    mat_vec(frames->gcrs_teme, v_teme_m_s, v_gcrs_m_s);
    return GLINT_OK;
}

/* omega x r, with omega along ITRS z. */
static void geostationary_in_gcrs(const orbit *o, const frame_set *frames, double r_gcrs_m[3],
                                  double v_gcrs_m_s[3])
{
    const double v_itrs_m_s[3] = {-EARTH_RATE_RAD_S * o->r_itrs_m[1],
                                  EARTH_RATE_RAD_S * o->r_itrs_m[0], 0.0};
    mat_tvec(frames->itrs_gcrs, o->r_itrs_m, r_gcrs_m);
    mat_tvec(frames->itrs_gcrs, v_itrs_m_s, v_gcrs_m_s);
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
        geostationary_in_gcrs(o, frames, r_gcrs_m, v_gcrs_m_s);
        return GLINT_OK;
    }
    return GLINT_INTERNAL;
}

double orbit_epoch_s(const orbit *o, bool *has_epoch)
{
    if (has_epoch) *has_epoch = o->kind != ORBIT_GEOSTATIONARY;
    return o->epoch_s;
}
