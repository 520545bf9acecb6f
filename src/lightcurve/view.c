/* view.c: the satellite as it looks at one moment, cut into polygons with their radiance. */
#include "base/constants.h"
#include "base/text.h"
#include "base/vec.h"
#include "facets/visibility_pieces.h"
#include "lightcurve/tile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct glint_view {
    glint_scenario *s; /* owned */
    glint_view_scene scene;
    glint_view_piece *pieces; /* owned */
    double (*points)[3];      /* owned; of the pieces */
    glint_view_edge *edges;   /* owned */
    size_t n_pieces, n_edges;
};

/* What is needed on the way. Directions and poses are in the frame of the geometry stage: GCRS, or
 * the body's where directions are given. */
typedef struct looker {
    glint_view *view;
    const glint_view_options *options;
    int64_t row; /* where directions are given */
    double t_s;  /* elsewhere */
    tile_worker worker;
    double sun[3], viewer[3];
    double axes[9]; /* rows: the picture's x, y, z */
} looker;

/* --- what is asked for --- */

/* A model is looked at from between its axes, and lit from there, too, but from a higher place:
 * the faces that are seen differ in brightness. */
static const double MODEL_FROM[3] = {3, -4, 2.5}, MODEL_SUN[3] = {0.5, -2, 3};

static glint_status read_direction(const double given[3], const char *what, double out[3],
                                   glint_error *error)
{
    if (!(norm3(given) > 0.0) || !isfinite(norm3(given)))
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "the direction %s is (%g, %g, %g); expected one that is finite and not 0",
                         what, given[0], given[1], given[2]);
    unit3(given, out);
    return GLINT_OK;
}

/* Makes a scenario of one row with given directions out of a model. */
static glint_status light_model(glint_scenario *s, const glint_view_options *o, bool *hinges_held,
                                glint_error *error)
{
    geometry_table *g = &s->geometry;
    if (o->at)
        return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                         "a model has no time, but '%s' is asked for; expected a scenario", o->at);
    g->sun = malloc(sizeof *g->sun);
    g->observer = malloc(sizeof *g->observer);
    g->range_m = malloc(sizeof *g->range_m);
    g->t_s = malloc(sizeof *g->t_s);
    if (!g->sun || !g->observer || !g->range_m || !g->t_s) return error_no_memory(error);
    s->has_geometry = true;
    g->n = s->n_steps = 1;
    g->range_m[0] = 1e6; /* m; not shown */
    g->t_s[0] = 0.0;
    const bool given = o->from == GLINT_FROM_DIRECTION;
    glint_status status =
        read_direction(o->has_sun ? o->sun_body : MODEL_SUN, "to the Sun", g->sun[0], error);
    if (!status)
        status = read_direction(given ? o->from_body : MODEL_FROM, "from which it is looked at",
                                g->observer[0], error);
    if (o->from == GLINT_FROM_SUN) copy3(g->sun[0], g->observer[0]);
    for (int c = 0; c < s->satellite.n_components; c++) {
        scenario_component *part = &s->satellite.components[c];
        hinge *h = &part->hinge;
        const direction_kind to = h->target.kind;
        if (!part->has_hinge || h->drive == HINGE_FIXED ||
            (h->drive == HINGE_TRACK && (to == DIRECTION_SUN || to == DIRECTION_OBSERVER)))
            continue;
        h->drive = HINGE_FIXED;
        h->angle = 0.0;
        *hinges_held = true;
    }
    return status;
}

static glint_status outside(const glint_scenario *s, const char *at, glint_error *error)
{
    glint_utc from, to;
    char a[UTC_TEXT_SIZE], b[UTC_TEXT_SIZE];
    run_clock_utc(&s->clock, 0, &from);
    run_clock_utc(&s->clock, s->span_s, &to);
    utc_write(&from, a);
    utc_write(&to, b);
    return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                     "'%s' is outside of the time of the scenario; expected one from %.19sZ to "
                     "%.19sZ, or 0 to %.10g s",
                     at, a, b, s->span_s);
}

/* Reads the moment: a time, or a row. */
static glint_status read_moment(looker *l, glint_error *error)
{
    const glint_scenario *s = l->view->s;
    const char *at = l->options->at;
    double number = 0.0;
    if (!at) return GLINT_OK;
    const bool is_number = number_read(at, strlen(at), &number);
    if (s->has_geometry) {
        if (!is_number || number != floor(number) || number < 0 || number >= (double)s->geometry.n)
            return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                             "'%s' is no row of the directions in the scenario; expected a whole "
                             "number from 0 to %lld",
                             at, (long long)s->geometry.n - 1);
        l->row = (int64_t)number;
        return GLINT_OK;
    }
    if (!is_number) {
        utc_time utc;
        if (utc_parse(at, PLACE_NONE, &utc, NULL))
            return error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                             "'%s' is no time; expected UTC as 2025-07-24T19:13:00Z, or s from the "
                             "start of the scenario",
                             at);
        double tt_jd[2];
        utc_to_tt(&utc, tt_jd, NULL, NULL);
        number = jd_difference_s(tt_jd, s->clock.tt_jd);
    }
    /* the rounding of a JD is 1e-11 s; the end itself is inside */
    static const double SLACK_S = 1e-9;
    if (number < -SLACK_S || number > s->span_s + SLACK_S) return outside(s, at, error);
    l->t_s = fmin(fmax(number, 0.0), s->span_s);
    return GLINT_OK;
}

/* --- the moment --- */

/* Geometry and brightness of the moment, as a run has them. */
static glint_status fill_moment(looker *l, glint_error *error)
{
    const glint_scenario *s = l->view->s;
    tile_worker *w = &l->worker;
    if (s->has_geometry)
        return geometry_fill(s, NULL, 0, l->row, 1, &w->geometry, &w->tile, w->lights, error);
    frame_grid *grid = NULL;
    const earth_orientation still = {0, 0};
    glint_status status =
        frame_grid_prepare(&s->clock, &still, l->t_s, l->t_s, s->step_s, &grid, error);
    if (!status)
        status = geometry_fill_at(s, grid, 0, &l->t_s, 1, &w->geometry, &w->tile, w->lights, error);
    frame_grid_free(grid);
    return status;
}

/* The row that a run would write. */
static glint_status find_row(looker *l, glint_row *out, glint_error *error)
{
    const glint_scenario *s = l->view->s;
    photometry_rows rows;
    glint_status status = photometry_rows_make(s, TILE, &rows, error);
    if (!status) status = tile_worker_sum(s, &l->worker, &rows, error);
    if (!status) {
        glint_view_scene *scene = &l->view->scene;
        *out = rows.rows[0];
        scene->has_magnitude = rows.flux_ratio[0] > 0;
        scene->magnitude = rows.magnitude[0];
    }
    photometry_rows_free(&rows);
    return status;
}

static void describe_moment(looker *l, const glint_row *row)
{
    const glint_scenario *s = l->view->s;
    glint_view_scene *scene = &l->view->scene;
    const bool observed = l->options->from == GLINT_FROM_OBSERVER && !scene->is_model;
    scene->title = s->title;
    scene->band = s->bands[0]->name;
    scene->from = l->options->from;
    scene->has_utc = !s->has_geometry;
    if (scene->has_utc) scene->utc = row->utc;
    scene->t_s = row->t_s;
    scene->row = l->row;
    scene->has_range = observed;
    scene->range_m = row->range_m;
    scene->sunlit_fraction = row->sunlit_fraction;
    scene->below_horizon = observed && (row->flags & GLINT_BELOW_HORIZON);
    scene->has_magnitude = scene->has_magnitude && observed;
    scene->has_shadows = s->self_shadows != SHADOWS_NONE;
}

/* --- the picture's axes --- */

static glint_status choose_viewer(looker *l, glint_error *error)
{
    double body[3];
    copy3(l->worker.tile.sun[0], l->sun);
    copy3(l->worker.tile.observer[0], l->viewer);
    if (l->options->from == GLINT_FROM_SUN) copy3(l->sun, l->viewer);
    if (l->options->from != GLINT_FROM_DIRECTION) return GLINT_OK;
    const glint_status status =
        read_direction(l->options->from_body, "from which it is looked at", body, error);
    if (!status) mat_tvec(l->worker.geometry.body[0], body, l->viewer);
    return status;
}

/* z to the viewer; y up: celestial north for an observer, else the body's z axis, or where that
 * points to the viewer or away, its y axis. */
static void set_axes(looker *l)
{
    static const double LEAST_SINE = 1e-3; /* nearer to the line of sight `up` says little */
    const double *body = l->worker.geometry.body[0];
    const double north[3] = {0, 0, 1}, x[3] = {1, 0, 0};
    glint_view_scene *scene = &l->view->scene;
    scene->north_up = !l->view->s->has_geometry && l->options->from == GLINT_FROM_OBSERVER;
    const double *up = scene->north_up ? north : body + 6,
                 *instead = scene->north_up ? x : body + 3;
    double across[3];
    copy3(l->viewer, l->axes + 6);
    cross3(up, l->viewer, across);
    if (norm3(across) < LEAST_SINE) cross3(instead, l->viewer, across);
    unit3(across, l->axes);
    cross3(l->axes + 6, l->axes, l->axes + 3);
    mat_vec(l->axes, l->sun, scene->sun);
    for (int k = 0; k < 3; k++)
        mat_vec(l->axes, body + 3 * k, scene->body_axes[k]);
    scene->phase_angle_rad = angle3(l->sun, l->viewer);
}

/* --- pieces --- */

_Static_assert((int)VISIBILITY_LIT == (int)GLINT_PIECE_LIT &&
                   (int)VISIBILITY_SHADOWED == (int)GLINT_PIECE_SHADOWED &&
                   (int)VISIBILITY_TURNED_AWAY == (int)GLINT_PIECE_TURNED_AWAY &&
                   (int)VISIBILITY_BACK == (int)GLINT_PIECE_BACK,
               "one is given out as the other");

/* Radiance factor of every facet towards the viewer in full sunlight: pi X / (area x cosine). */
static glint_status find_radiances(looker *l, double *radiance, glint_error *error)
{
    const satellite *sat = &l->view->s->satellite;
    const model *m = &sat->model;
    for (int c = 0; c < sat->n_components; c++) {
        const double *axes = l->worker.geometry.poses[c].body_component;
        brdf_light *light = &l->worker.lights[c];
        double i[3], r[3];
        mat_tvec(axes, l->sun, i);
        mat_tvec(axes, l->viewer, r);
        for (int axis = 0; axis < 3; axis++)
            for (int k = 0; k < TILE; k++)
                light->i[axis][k] = i[axis], light->r[axis][k] = r[axis];
        brdf_light_finish(light);
    }
    source_disc disc;
    const solar_disc_choice choice = l->view->s->solar_disc;
    source_disc_start(&disc, choice == SOLAR_LIMB_DARKENED);
    for (int k = 0; k < TILE; k++) /* the Sun at 1 au: full sunlight */
        source_disc_set(&disc, k, asin(SUN_RADIUS_M / AU_M));
    const glint_status status = model_sum_facets(
        m, l->worker.lights, choice == SOLAR_POINT ? NULL : &disc, 0, 0, radiance, error);
    for (int k = 0; !status && k < m->n_facets; k++) {
        const facet *f = &m->polygons.items[k];
        const brdf_light *light = &l->worker.lights[f->component];
        const double r[3] = {light->r[0][0], light->r[1][0], light->r[2][0]};
        const double cosine = dot3(f->normal, r);
        radiance[k] = cosine > BRDF_EDGE ? PI * radiance[k] / (f->area_m2 * cosine) : 0.0;
    }
    return status;
}

static void widen(glint_view_scene *scene, const double p[3])
{
    for (int k = 0; k < 2; k++) {
        scene->lo_m[k] = fmin(scene->lo_m[k], p[k]);
        scene->hi_m[k] = fmax(scene->hi_m[k], p[k]);
    }
}

static double shoelace(const double (*p)[3], size_t n)
{
    double twice = 0.0;
    for (size_t k = 0; k < n; k++) {
        const double *a = p[k], *b = p[k + 1 < n ? k + 1 : 0];
        twice += (a[0] - p[0][0]) * (b[1] - p[0][1]) - (b[0] - p[0][0]) * (a[1] - p[0][1]);
    }
    return 0.5 * twice;
}

static void add_piece(looker *l, const visibility_pieces *cut, const visibility_piece *from,
                      const double *radiance)
{
    glint_view *v = l->view;
    const facet *f = &v->s->satellite.model.polygons.items[from->facet];
    double(*points)[3] = v->points + from->first;
    for (int k = 0; k < from->n; k++) {
        mat_vec(l->axes, cut->points[from->first + k], points[k]);
        widen(&v->scene, points[k]);
    }
    double normal[3];
    mat_vec(l->worker.geometry.poses[f->component].body_component, f->normal, normal);
    const bool lit = from->light == VISIBILITY_LIT;
    const double sunlit = v->scene.sunlit_fraction;
    const glint_view_light light = (glint_view_light)from->light;
    v->pieces[v->n_pieces++] =
        (glint_view_piece){.points = (const double(*)[3])points,
                           .n_points = (size_t)from->n,
                           .projected_m2 = shoelace((const double(*)[3])points, (size_t)from->n),
                           .facet = from->facet,
                           .component = f->component,
                           .material = from->light == VISIBILITY_BACK ? -1 : f->material,
                           .light = light,
                           .facing = fabs(dot3(normal, l->viewer)),
                           .radiance_factor = lit ? radiance[from->facet] * sunlit : 0.0};
    v->scene.brightest = fmax(v->scene.brightest, v->pieces[v->n_pieces - 1].radiance_factor);
}

static void add_edge(looker *l, const visibility_edge *from)
{
    const facet_list *polygons = &l->view->s->satellite.model.polygons;
    const facet *items = polygons->items;
    glint_view_edge *e = &l->view->edges[l->view->n_edges++];
    const bool one_surface = from->neighbour >= 0 &&
                             facet_is_curved(polygons, &items[from->facet]) &&
                             items[from->facet].surface == items[from->neighbour].surface;
    *e = (glint_view_edge){.is_outline = from->kind == VISIBILITY_RIM,
                           .is_smooth = one_surface || from->kind == VISIBILITY_SMOOTH,
                           .turn_rad = from->turn_rad};
    e->parts_materials =
        from->neighbour >= 0 && items[from->facet].material != items[from->neighbour].material;
    mat_vec(l->axes, from->from_m, e->from_m);
    mat_vec(l->axes, from->to_m, e->to_m);
}

static glint_status keep_pieces(looker *l, const visibility_pieces *cut, const double *radiance,
                                glint_error *error)
{
    glint_view *v = l->view;
    v->pieces = malloc(((size_t)cut->n + 1) * sizeof *v->pieces);
    v->points = malloc(((size_t)cut->n_points + 1) * sizeof *v->points);
    v->edges = malloc(((size_t)cut->n_edges + 1) * sizeof *v->edges);
    if (!v->pieces || !v->points || !v->edges) return error_no_memory(error);
    for (int k = 0; k < 2; k++)
        v->scene.lo_m[k] = INFINITY, v->scene.hi_m[k] = -INFINITY;
    for (int k = 0; k < cut->n; k++)
        add_piece(l, cut, &cut->items[k], radiance);
    for (int k = 0; k < cut->n_edges; k++)
        add_edge(l, &cut->edges[k]);
    if (cut->n == 0) /* all facets edge-on */
        for (int k = 0; k < 2; k++)
            v->scene.lo_m[k] = v->scene.hi_m[k] = 0.0;
    return GLINT_OK;
}

static glint_status cut_pieces(looker *l, const visibility *plan, glint_error *error)
{
    const glint_view_scene *scene = &l->view->scene;
    const model *m = &l->view->s->satellite.model;
    visibility_pieces cut = {0};
    double *radiance = malloc((size_t)m->n_facets * sizeof *radiance);
    glint_status status = radiance ? find_radiances(l, radiance, error) : error_no_memory(error);
    if (!status)
        status = visibility_pieces_find(plan, m, l->worker.geometry.poses,
                                        scene->sunlit_fraction > 0 ? l->sun : NULL,
                                        scene->has_shadows, l->viewer, &cut, error);
    if (!status) status = keep_pieces(l, &cut, radiance, error);
    visibility_pieces_free(&cut);
    free(radiance);
    return status;
}

/* --- all of it --- */

/* The worker's own plan may be absent where nothing is ever shadowed; what is hidden has to be
 * known all the same. */
static glint_status look(looker *l, const visibility *shadows, const visibility *plan,
                         glint_error *error)
{
    const glint_scenario *s = l->view->s;
    const size_t n_components = (size_t)s->satellite.n_components;
    geometry_worker *g = &l->worker.geometry;
    glint_row row = {0};
    glint_status status = tile_worker_make(s, shadows, &l->worker, error);
    if (status) return status;
    g->viewer = (viewer){.observer = s->observers}; /* the first, where there are several */
    g->body = calloc(TILE, sizeof *g->body);
    if (!g->poses) g->poses = calloc(TILE * n_components, sizeof *g->poses);
    if (!g->body || !g->poses) return error_no_memory(error);
    status = fill_moment(l, error);
    if (!status) status = find_row(l, &row, error);
    if (!status) status = choose_viewer(l, error);
    if (status) return status;
    describe_moment(l, &row);
    set_axes(l);
    return cut_pieces(l, plan, error);
}

static glint_status make(glint_view *v, const glint_view_options *options, glint_error *error)
{
    looker l = {.view = v, .options = options};
    visibility *shadows = NULL, *plan = NULL;
    glint_status status = GLINT_OK;
    if (v->scene.is_model)
        status = light_model(v->s, options, &v->scene.hinges_held, error);
    else if (options->has_sun)
        status = error_set(error, GLINT_ARGUMENT, PLACE_NONE,
                           "the scenario says where the Sun is; a direction to it is only taken "
                           "with a model");
    if (!status && !v->scene.is_model) status = read_moment(&l, error);
    if (!status) status = tile_plan_shadows(v->s, &shadows, error);
    if (!status) status = satellite_plan_shadows(&v->s->satellite, &plan, error);
    if (!status) status = look(&l, shadows, plan, error);
    tile_worker_free(&l.worker);
    visibility_free(shadows);
    visibility_free(plan);
    return status;
}

glint_status glint_view_read(const char *path, const char *const *overrides, size_t n_overrides,
                             const glint_view_options *options, glint_view **out,
                             glint_errors *errors)
{
    static const glint_view_options usual = {0};
    *out = NULL;
    glint_view *v = calloc(1, sizeof *v);
    if (!v) return errors_add(errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    toml_document *document;
    if (!toml_read(path, PLACE_NONE, &document, NULL)) { /* else it is read again, to say why */
        v->scene.is_model = scenario_is_model(document);
        toml_free(document);
    }
    glint_status status = v->scene.is_model
                              ? scenario_read_model(path, overrides, n_overrides, &v->s, errors)
                              : glint_scenario_read(path, overrides, n_overrides, &v->s, errors);
    glint_error error = {0};
    if (!status) {
        status = make(v, options ? options : &usual, &error);
        if (status) errors_take(errors, &error, PLACE_NONE);
    }
    if (status)
        glint_view_free(v);
    else
        *out = v;
    return status;
}

void glint_view_free(glint_view *v)
{
    if (!v) return;
    glint_scenario_free(v->s);
    free(v->pieces);
    free(v->points);
    free(v->edges);
    free(v);
}

const glint_view_scene *glint_view_describe(const glint_view *v)
{
    return &v->scene;
}

const glint_view_piece *glint_view_pieces(const glint_view *v, size_t *n)
{
    *n = v->n_pieces;
    return v->pieces;
}

const glint_view_edge *glint_view_edges(const glint_view *v, size_t *n)
{
    *n = v->n_edges;
    return v->edges;
}

const char *glint_view_material(const glint_view *v, size_t k)
{
    return k < (size_t)v->s->satellite.n_materials ? v->s->satellite.materials[k].name : NULL;
}

const char *glint_view_component(const glint_view *v, size_t k)
{
    return k < (size_t)v->s->satellite.n_components ? v->s->satellite.components[k].name : NULL;
}
