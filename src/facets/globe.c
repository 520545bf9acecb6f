#include "facets/globe.h"

#include "base/constants.h"
#include "base/vec.h"
#include "facets/globe_parts.h"
#include "facets/solar_disc.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- radiance --- */

double globe_radiance(const globe_view *view, const brdf_material *ground, const double to[3])
{
    const double down = -dot3(to, view->up), d = view->distance;
    const double square = 1.0 - d * d * (1.0 - down * down); /* of the cosine at the ground */
    if (!(down > 0.0 && square > 0.0)) return 0.0;
    const double out = sqrt(square),
                 along = d * down - out; /* along: as far as the ground, radii */
    double normal[3];
    for (int j = 0; j < 3; j++)
        normal[j] = d * view->up[j] + along * to[j];
    const double in = dot3(normal, view->sun);
    if (!(in > BRDF_EDGE && out > BRDF_EDGE)) return 0.0;
    /* Both directions at the ground, the satellite's in the plane of x and z. */
    const double level = sqrt(fmax(1.0 - square, 0.0)), flat = sqrt(fmax(1.0 - in * in, 0.0));
    const double r[3] = {level, 0.0, out};
    const double x = level > 0.0 ? (-dot3(to, view->sun) - out * in) / level : flat;
    const double y = sqrt(fmax(flat * flat - x * x, 0.0));
    const double i[3] = {x, y, in};
    return view->irradiance * brdf_material_eval(ground, i, r) / out;
}

/* --- Gauss's rules --- */

enum { RULE_STEP = 4 }; /* there is a rule for every multiple of this */

/* Gauss's points on 0..1 and their weights, from the roots of Legendre's polynomial by Newton's
 * method (Abramowitz and Stegun 25.4.29; first guess: 22.16.6). */
static void gauss_fill(int n, double *at, double *weight)
{
    for (int k = 0; k < n; k++) {
        double x = cos(PI * (k + 0.75) / (n + 0.5)), slope = 1.0;
        for (int round = 0; round < 8; round++) { /* digits double: 4 rounds do */
            double p = 1.0, before = 0.0;
            for (int j = 1; j <= n; j++) {
                const double next = ((2 * j - 1) * x * p - (j - 1) * before) / j;
                before = p;
                p = next;
            }
            slope = n * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
        }
        at[k] = 0.5 * (1.0 - x);
        weight[k] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
}

static glint_status make_rules(globe *g, glint_error *error)
{
    size_t size = 0;
    g->n_rules = (g->spokes + GLOBE_SPARE) / RULE_STEP;
    for (int k = 1; k <= g->n_rules; k++)
        size += (size_t)(2 * RULE_STEP * k);
    g->rules = calloc((size_t)g->n_rules, sizeof *g->rules);
    g->rule_numbers = malloc(size * sizeof *g->rule_numbers);
    if (!g->rules || !g->rule_numbers) return error_no_memory(error);
    double *next = g->rule_numbers;
    for (int k = 0; k < g->n_rules; k++) {
        const int n = RULE_STEP * (k + 1);
        gauss_fill(n, next, next + n);
        g->rules[k] = (gauss_rule){n, next, next + n};
        next += 2 * n;
    }
    return GLINT_OK;
}

/* The rule with at least n points, which must be among those made. */
static const gauss_rule *rule_of(const globe *g, int n)
{
    const int k = (n + RULE_STEP - 1) / RULE_STEP - 1;
    return &g->rules[k < 0 ? 0 : k < g->n_rules ? k : g->n_rules - 1];
}

/* --- lobes that nodes resolve, and the others --- */

/* The parameter that is a model's diffuse part by itself; -1: it has none. What is left of the
 * model without it is its lobe alone (physics page, section 3: the models are sums). */
static int diffuse_param(const brdf_model *brdf)
{
    static const char *const NAMES[] = {"rho_d", "R_d", "k_d"};
    for (int k = 0; k < brdf->n_params; k++)
        for (size_t j = 0; j < sizeof NAMES / sizeof *NAMES; j++)
            if (strcmp(brdf->params[k].name, NAMES[j]) == 0) return k;
    return -1;
}

/* Splits a narrow lobe: *narrow is what must be looked at closely, and `wide` minus that is left
 * for the nodes; false: nothing is left for them. */
static bool split_lobe(const brdf_lobe *lobe, brdf_lobe *narrow)
{
    const int diffuse = diffuse_param(lobe->model);
    *narrow = *lobe;
    if (diffuse < 0 || lobe->model->prepare_lobe || !(lobe->params[diffuse] > 0.0)) return false;
    narrow->params[diffuse] = 0.0;
    if (lobe->model->prepare(narrow->params, narrow->coef, NULL) == GLINT_OK) return true;
    *narrow = *lobe; /* a model that must have a diffuse part is looked at closely as a whole */
    return false;
}

/* One material in one band. The lists have room for two lobes each. All lobes are shallow copies:
 * what they own stays the material's. */
static void split_material(const brdf_material *from, globe_matter *out, double *width)
{
    for (int k = 0; k < from->n_lobes; k++) {
        const brdf_lobe *lobe = &from->lobes[k];
        if (lobe->weight == 0.0) continue;
        lobe_shape shape;
        lobe_shape_find(lobe, &shape);
        const double own = 1.0 / shape.narrow;
        if (own >= GLOBE_NARROW) {
            *width = fmin(*width, own);
            out->wide.lobes[out->wide.n_lobes++] = *lobe;
            continue;
        }
        brdf_lobe *narrow = &out->narrow[out->n_narrow];
        if (split_lobe(lobe, narrow)) {
            /* The lobe cancels at every node, and the rest stays: to rounding of the lobe. */
            out->wide.lobes[out->wide.n_lobes++] = *lobe;
            out->wide.lobes[out->wide.n_lobes] = *narrow;
            out->wide.lobes[out->wide.n_lobes++].weight = -lobe->weight;
        }
        lobe_shape_find(narrow, &out->shapes[out->n_narrow++]);
    }
}

static glint_status split_materials(globe *g, double *width, glint_error *error)
{
    const model *m = g->model;
    const size_t n = (size_t)m->n_materials * (size_t)m->n_bands;
    g->matter = calloc(n, sizeof *g->matter);
    if (!g->matter) return error_no_memory(error);
    for (size_t k = 0; k < n; k++) {
        const size_t band = k % (size_t)m->n_bands;
        const brdf_material *from = &m->materials[k / (size_t)m->n_bands].bands[band];
        globe_matter *matter = &g->matter[k];
        const size_t lobes = (size_t)from->n_lobes;
        matter->wide.lobes = calloc(2 * lobes, sizeof *matter->wide.lobes);
        matter->narrow = calloc(lobes, sizeof *matter->narrow);
        matter->shapes = calloc(lobes, sizeof *matter->shapes);
        if (!matter->wide.lobes || !matter->narrow || !matter->shapes)
            return error_no_memory(error);
        if (m->same_band[k] == (int)band) split_material(from, matter, width);
    }
    return GLINT_OK;
}

/* --- making --- */

/* Rings for lobes of a width, rad. A lobe of that width in the bisector is twice as wide in the
 * direction of the source; facets whose horizon cuts the globe want the least number. */
static int rings_for(double width)
{
    static const double LEAST = 24, PER_WIDTH = 2.4; /* held by the tests of convergence */
    return (int)ceil(fmax(LEAST, PER_WIDTH / width));
}

static void find_same_ground(globe *g)
{
    for (int b = 0; b < g->model->n_bands; b++) {
        g->same_ground[b] = 0;
        while (g->same_ground[b] < b &&
               !brdf_material_same(&g->ground[g->same_ground[b]], &g->ground[b]))
            g->same_ground[b]++;
    }
}

glint_status globe_make(const model *m, const brdf_material *ground, int rings, globe **out,
                        glint_error *error)
{
    *out = NULL;
    globe *g = calloc(1, sizeof *g);
    if (!g) return error_no_memory(error);
    g->model = m;
    g->ground = ground;
    g->same_ground = calloc((size_t)m->n_bands, sizeof *g->same_ground);
    double width = HUGE_VAL;
    glint_status status = g->same_ground ? GLINT_OK : error_no_memory(error);
    if (!status) status = split_materials(g, &width, error);
    if (!status) {
        find_same_ground(g);
        for (int b = 0; b < m->n_bands; b++)
            width = fmin(width, brdf_material_width(&ground[b]));
        if (rings == 0) rings = rings_for(width);
        g->rings = (rings + RULE_STEP - 1) / RULE_STEP * RULE_STEP;
        g->spokes = 2 * g->rings;
        status = make_rules(g, error);
    }
    if (status) {
        globe_free(g);
        return status;
    }
    *out = g;
    return GLINT_OK;
}

void globe_free(globe *g)
{
    if (!g) return;
    const size_t n = (size_t)g->model->n_materials * (size_t)g->model->n_bands;
    for (size_t k = 0; g->matter && k < n; k++) {
        free(g->matter[k].wide.lobes); /* shallow copies */
        free(g->matter[k].narrow);
        free(g->matter[k].shapes);
    }
    free(g->matter);
    free(g->same_ground);
    free(g->rules);
    free(g->rule_numbers);
    free(g);
}

int globe_rings(const globe *g)
{
    return g->rings;
}

/* --- laying nodes out --- */

/* One ring at emission angle v, which stands for `length` of it. */
static void add_ring(const globe *g, globe_lane *lane, double v, double length)
{
    const double d = lane->view.distance, sine = sin(v) / d;
    const double nadir = asin(sine), central = v - nadir;
    globe_ring *ring = &lane->rings[lane->n_rings];
    const double height = cos(central) * lane->sun_up, swing = sin(central) * lane->sun_side;
    ring->lit = height >= swing ? PI : height <= -swing ? 0.0 : acos(-height / swing);
    if (!(ring->lit > 0.0)) return;
    ring->sin_nadir = sine;
    ring->cos_nadir = cos(nadir);
    ring->sin_central = sin(central);
    ring->cos_central = cos(central);
    ring->sin_out = sin(v);
    ring->cos_out = cos(v);
    ring->weight = length * sine / (d * ring->cos_nadir);
    ring->azimuths = rule_of(g, (int)ceil(fmax(8.0, g->spokes * sine * d)));
    lane->n_rings++;
}

/* Rings between two emission angles. rooted: what is lit of a ring begins with a root at `from`. */
static void add_rings(const globe *g, globe_lane *lane, double from, double to, bool rooted)
{
    static const int FEWEST = 8;
    const int wanted = (int)ceil(g->rings * (to - from) / (0.5 * PI));
    const gauss_rule *rule = rule_of(g, wanted > FEWEST ? wanted : FEWEST);
    for (int k = 0; k < rule->n; k++) {
        const double x = rule->at[k], length = (to - from) * rule->weight[k];
        if (rooted)
            add_ring(g, lane, from + (to - from) * x * x, 2.0 * x * length);
        else
            add_ring(g, lane, from + (to - from) * x, length);
    }
}

/* Node k of a ring: the direction, and whether there is one. */
static bool node_at(const globe_lane *lane, const globe_ring *ring, int k, double azimuth[2],
                    double *weight, double to[3])
{
    const gauss_rule *rule = ring->azimuths;
    if (k >= rule->n) return false;
    double angle;
    if (ring->lit < PI) {
        angle = ring->lit * (2.0 * rule->at[k] - 1.0);
        *weight = ring->weight * 2.0 * ring->lit * rule->weight[k];
    } else { /* every other ring is turned by half a step, so that edges average out */
        const int index = (int)(ring - lane->rings);
        angle = TWO_PI * (k + 0.5 * (index % 2)) / rule->n;
        *weight = ring->weight * TWO_PI / rule->n;
    }
    azimuth[0] = cos(angle);
    azimuth[1] = sin(angle);
    for (int j = 0; j < 3; j++)
        to[j] = ring->sin_nadir * (azimuth[0] * lane->towards[j] + azimuth[1] * lane->across[j]) -
                ring->cos_nadir * lane->view.up[j];
    return true;
}

/* What the ground of one band sends from a node, for the unit of the node's weight. */
static double ground_at(const globe_lane *lane, const globe_ring *ring, const double azimuth[2],
                        const brdf_material *ground)
{
    const double c = ring->cos_central, s = ring->sin_central;
    const double i[3] = {c * lane->sun_side * azimuth[0] - s * lane->sun_up,
                         -lane->sun_side * azimuth[1],
                         c * lane->sun_up + s * lane->sun_side * azimuth[0]};
    const double r[3] = {-ring->sin_out, 0.0, ring->cos_out};
    return lane->view.irradiance * brdf_material_eval(ground, i, r);
}

/* The mean direction, weighted with the first band. */
static bool find_centre(const globe *g, const globe_lane *lane, double centre[3])
{
    double sum[3] = {0, 0, 0}, azimuth[2], weight, to[3];
    for (int j = 0; j < lane->n_rings; j++)
        for (int k = 0; node_at(lane, &lane->rings[j], k, azimuth, &weight, to); k++)
            add_scaled3(sum, weight * ground_at(lane, &lane->rings[j], azimuth, &g->ground[0]), to,
                        sum);
    return unit3(sum, centre) > 0.0;
}

bool globe_look(const globe *g, globe_scratch *scratch, int which, const globe_view *view,
                double centre[3])
{
    globe_lane *lane = &scratch->lanes[which];
    lane->n_rings = 0;
    if (!view) return false;
    lane->view = *view;
    lane->sun_up = fmin(fmax(dot3(view->up, view->sun), -1.0), 1.0);
    static const double ANY[2][3] = {{1, 0, 0}, {0, 1, 0}};
    if (!(perp3(view->sun, view->up, lane->towards) > 1e-9) &&
        !(perp3(ANY[0], view->up, lane->towards) > 0.5))
        perp3(ANY[1], view->up, lane->towards);
    cross3(view->up, lane->towards, lane->across);
    lane->sun_side = sqrt(1.0 - lane->sun_up * lane->sun_up);
    /* The central angle at which rings begin to cross the terminator, and its emission angle. */
    const double zenith = acos(lane->sun_up), crossing = fabs(0.5 * PI - zenith),
                 d = view->distance;
    const bool crosses = crossing < acos(1.0 / d), day = zenith < 0.5 * PI;
    const double v = crosses ? atan2(d * sin(crossing), d * cos(crossing) - 1.0) : 0.5 * PI;
    if (day) add_rings(g, lane, 0.0, v, false);
    if (crosses) add_rings(g, lane, v, 0.5 * PI, true);
    if (lane->n_rings > 0 && (!centre || find_centre(g, lane, centre))) return true;
    lane->n_rings = 0;
    return false;
}

/* --- the sum over nodes --- */

glint_status globe_scratch_make(const globe *g, globe_scratch **out, glint_error *error)
{
    const model *m = g->model;
    const size_t n_lights = (size_t)m->n_components, n_bands = (size_t)m->n_bands;
    const size_t rings = (size_t)(g->rings + GLOBE_SPARE);
    *out = NULL;
    globe_scratch *s = calloc(1, sizeof *s);
    if (!s) return error_no_memory(error);
    s->lights = aligned_alloc(64, n_lights * sizeof *s->lights);
    s->weight = calloc(n_bands * BRDF_TILE, sizeof *s->weight);
    s->own = calloc(n_bands * BRDF_TILE, sizeof *s->own);
    s->rings = calloc(BRDF_TILE * rings, sizeof *s->rings);
    if (!s->lights || !s->weight || !s->own || !s->rings) {
        globe_scratch_free(s);
        return error_no_memory(error);
    }
    for (size_t k = 0; k < BRDF_TILE; k++)
        s->lanes[k].rings = s->rings + k * rings;
    *out = s;
    return GLINT_OK;
}

void globe_scratch_free(globe_scratch *s)
{
    if (!s) return;
    free(s->lights);
    free(s->weight);
    free(s->own);
    free(s->rings);
    free(s);
}

/* A lane's light from the direction `to`, in every component's frame. */
static void turn_light(const globe *g, globe_scratch *s, const visibility_pose *poses, int lane,
                       const double to[3])
{
    for (int c = 0; c < g->model->n_components; c++) {
        double i[3];
        mat_tvec(poses[(size_t)lane * (size_t)g->model->n_components + (size_t)c].body_component,
                 to, i);
        for (int j = 0; j < 3; j++)
            s->lights[c].i[j][lane] = i[j];
    }
}

/* Sets the k-th node of ring j in all lanes; false where no lane has one. */
static bool set_node(const globe *g, globe_scratch *s, const visibility_pose *poses, int j, int k)
{
    const int n_bands = g->model->n_bands;
    bool any = false;
    for (int lane = 0; lane < BRDF_TILE; lane++) {
        const globe_lane *l = &s->lanes[lane];
        double azimuth[2], weight, to[3];
        const bool has = j < l->n_rings && node_at(l, &l->rings[j], k, azimuth, &weight, to);
        any |= has;
        for (int b = 0; b < n_bands; b++) {
            double *own = s->weight + b * BRDF_TILE;
            own[lane] = !has ? 0.0
                        : g->same_ground[b] < b
                            ? s->weight[g->same_ground[b] * BRDF_TILE + lane]
                            : weight * ground_at(l, &l->rings[j], azimuth, &g->ground[b]);
        }
        if (has) turn_light(g, s, poses, lane, to);
    }
    for (int c = 0; any && c < g->model->n_components; c++)
        brdf_light_finish(&s->lights[c]);
    return any;
}

/* Adds one node's light to all spans. */
static void add_node(const globe *g, globe_scratch *s, const double *visible, double *x)
{
    const model *m = g->model;
    for (int k = 0; k < m->n_spans; k++) {
        const model_span *span = &m->spans[k];
        const size_t first = (size_t)span->material * (size_t)m->n_bands;
        const double *seen = visible ? visible + (size_t)span->first * BRDF_TILE : NULL;
        for (int b = 0; b < m->n_bands; b++) {
            const int same = m->same_band[first + (size_t)b];
            double *own = s->own + same * BRDF_TILE, *weight = s->weight + b * BRDF_TILE;
            if (same == b) {
                memset(own, 0, BRDF_TILE * sizeof *own);
                const globe_matter *matter = &g->matter[first + (size_t)b];
                const brdf_light *light = &s->lights[span->component];
                brdf_material_tile(&matter->wide, &span->facets, light, seen, own);
                for (int n = 0; n < matter->n_narrow; n++)
                    if (!matter->shapes[n].specular)
                        globe_add_outside(matter, n, &span->facets, light, seen, own);
            }
            double *sum = x + ((size_t)b * (size_t)m->n_spans + (size_t)k) * BRDF_TILE;
            for (int lane = 0; lane < BRDF_TILE; lane++)
                sum[lane] += weight[lane] * own[lane];
        }
    }
}

/* The observers' directions; sources that are not set stand with them. */
static void start_lights(const globe *g, globe_scratch *s, const brdf_light *lights)
{
    for (int c = 0; c < g->model->n_components; c++) {
        memcpy(s->lights[c].r, lights[c].r, sizeof lights[c].r);
        memcpy(s->lights[c].i, lights[c].r, sizeof lights[c].r);
    }
}

void globe_sum(const globe *g, globe_scratch *s, const visibility_pose *poses,
               const brdf_light *lights, const double *visible, double *x)
{
    const model *m = g->model;
    memset(x, 0, (size_t)m->n_bands * (size_t)m->n_spans * BRDF_TILE * sizeof *x);
    start_lights(g, s, lights);
    int most = 0;
    for (int lane = 0; lane < BRDF_TILE; lane++)
        most = s->lanes[lane].n_rings > most ? s->lanes[lane].n_rings : most;
    for (int j = 0; j < most; j++)
        for (int k = 0; set_node(g, s, poses, j, k); k++)
            add_node(g, s, visible, x);
    globe_add_highlights(g, s, poses, visible, x);
}
