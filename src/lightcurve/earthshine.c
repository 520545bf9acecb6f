#include "lightcurve/earthshine.h"

#include "base/constants.h"
#include "base/vec.h"

#include <math.h>
#include <stdlib.h>

glint_status earthshine_make(const glint_scenario *s, bool has_shadows, earthshine *e,
                             glint_error *error)
{
    const model *m = &s->satellite.model;
    *e = (earthshine){0};
    if (!s->earth.source) return GLINT_OK;
    e->x = calloc((size_t)m->n_bands * (size_t)m->n_spans * TILE, sizeof *e->x);
    if (!e->x) return error_no_memory(error);
    if (has_shadows) {
        e->visible = calloc((size_t)m->n_facets * TILE, sizeof *e->visible);
        e->joint = calloc((size_t)m->n_facets * TILE, sizeof *e->joint);
        if (!e->visible || !e->joint) return error_no_memory(error);
    }
    return globe_scratch_make(s->earth.source, &e->scratch, error);
}

void earthshine_free(earthshine *e)
{
    globe_scratch_free(e->scratch);
    free(e->x);
    free(e->visible);
    free(e->joint);
    *e = (earthshine){0};
}

/* Earth and Sun as lane k sees them. The Sun's direction from the Earth's centre: that from the
 * satellite, moved there. */
static glint_status view_of(const glint_scenario *s, const tile_geometry *tile, int k,
                            globe_view *out, glint_error *error)
{
    const double *r = tile->satellite_m[k];
    double sun[3];
    add_scaled3(r, tile->sun_distance_m[k], tile->sun[k], sun);
    const double au = AU_M / unit3(sun, out->sun);
    out->irradiance = au * au;
    out->distance = unit3(r, out->up) / s->earth.radius_m;
    if (out->distance > 1.0) return GLINT_OK;
    return error_set(error, GLINT_INPUT, PLACE_NONE,
                     "at t_s = %.3f the satellite is %.1f km from the Earth's centre, within the "
                     "sphere that shines on it (earthshine radius_km = %g); expected it above",
                     tile->t_s[k], norm3(r) * 1e-3, s->earth.radius_m * 1e-3);
}

/* Takes the joint fractions over for the facets that are turned to the centre. */
static void take_joint(const model *m, const visibility_pose *poses, const double centre[3], int k,
                       earthshine *e)
{
    for (int j = 0; j < m->n_spans; j++) {
        const model_span *span = &m->spans[j];
        double to[3];
        mat_tvec(poses[span->component].body_component, centre, to);
        for (int f = 0; f < span->n; f++) {
            const double *const *n = span->facets.normal;
            if (!(n[0][f] * to[0] + n[1][f] * to[1] + n[2][f] * to[2] > BRDF_EDGE)) continue;
            const size_t at = (size_t)(span->first + f) * TILE + (size_t)k;
            e->visible[at] = e->joint[at];
        }
    }
}

static glint_status find_visible(const model *m, const visibility *plan,
                                 visibility_scratch *scratch, const visibility_pose *poses,
                                 const tile_geometry *tile, const double centre[3], int k,
                                 earthshine *e, glint_error *error)
{
    const double *observer = tile->observer[k];
    glint_status status =
        visibility_fill(plan, scratch, poses, observer, observer, k, e->visible, error);
    if (!status)
        status = visibility_fill(plan, scratch, poses, centre, observer, k, e->joint, error);
    if (!status) take_joint(m, poses, centre, k, e);
    return status;
}

glint_status earthshine_fill(const glint_scenario *s, const visibility *plan,
                             visibility_scratch *scratch, const geometry_worker *worker,
                             const tile_geometry *tile, const brdf_light *lights, earthshine *e,
                             bool *any, glint_error *error)
{
    const model *m = &s->satellite.model;
    *any = false;
    for (int k = 0; k < TILE; k++) {
        globe_view view;
        double centre[3];
        const bool wanted = k < tile->n && tile->seen[k];
        glint_status status = wanted ? view_of(s, tile, k, &view, error) : GLINT_OK;
        if (status) return status;
        const bool lit =
            globe_look(s->earth.source, e->scratch, k, wanted ? &view : NULL, plan ? centre : NULL);
        *any |= lit;
        if (lit && plan)
            status =
                find_visible(m, plan, scratch, worker->poses + (size_t)k * (size_t)m->n_components,
                             tile, centre, k, e, error);
        if (status) return status;
    }
    if (*any) globe_sum(s->earth.source, e->scratch, worker->poses, lights, e->visible, e->x);
    return GLINT_OK;
}
