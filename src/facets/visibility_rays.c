#include "facets/visibility_rays.h"

#include "base/random.h"
#include "base/vec.h"
#include "facets/rays.h"

#include <math.h>
#include <stdlib.h>

/* Rays begin so far off their facet, over the model's size: coordinates are floats, good to 6e-8,
 * and a few of them are added on the way. What lies nearer casts no shadow. */
#define LIFT 2e-6

struct ray_plan {
    int n;              /* rays of each facet to each side */
    ray_scene **scenes; /* owned; of each component; NULL where it has no facets */
    double lift_m;
};

/* --- making --- */

/* The facets of a component as fans of triangles. */
static glint_status make_scene(const visibility *plan, const model *m, int c, ray_scene **out,
                               glint_error *error)
{
    const int first_vertex = plan->first_vertex[c];
    const int n_vertices = plan->first_vertex[c + 1] - first_vertex;
    int n = 0;
    *out = NULL;
    for (int k = plan->first_facet[c]; k < plan->first_facet[c + 1]; k++)
        n += m->polygons.items[k].n_vertices - 2;
    if (n == 0) return GLINT_OK;
    int(*triangles)[3] = malloc((size_t)n * sizeof *triangles);
    if (!triangles) return error_no_memory(error);
    n = 0;
    for (int k = plan->first_facet[c]; k < plan->first_facet[c + 1]; k++) {
        const facet *f = &m->polygons.items[k];
        const int *ring = plan->rings + f->first_vertex;
        for (int v = 1; v + 1 < f->n_vertices; v++, n++) {
            triangles[n][0] = ring[0] - first_vertex;
            triangles[n][1] = ring[v] - first_vertex;
            triangles[n][2] = ring[v + 1] - first_vertex;
        }
    }
    const glint_status status =
        ray_scene_make((const double(*)[3])plan->vertices + first_vertex, n_vertices,
                       (const int(*)[3])triangles, n, out, error);
    free(triangles);
    return status;
}

glint_status ray_plan_make(const visibility *plan, const model *m, int rays_per_facet,
                           ray_plan **out, glint_error *error)
{
    *out = NULL;
    ray_plan *rays = calloc(1, sizeof *rays);
    if (!rays) return error_no_memory(error);
    rays->n = rays_per_facet;
    rays->lift_m = LIFT * plan->size_m;
    rays->scenes = calloc((size_t)plan->n_components, sizeof *rays->scenes);
    glint_status status = rays->scenes ? GLINT_OK : error_no_memory(error);
    for (int c = 0; c < plan->n_components && !status; c++)
        status = make_scene(plan, m, c, &rays->scenes[c], error);
    if (status)
        ray_plan_free(rays, plan->n_components);
    else
        *out = rays;
    return status;
}

void ray_plan_free(ray_plan *rays, int n_components)
{
    if (!rays) return;
    for (int c = 0; rays->scenes && c < n_components; c++)
        ray_scene_free(rays->scenes[c]);
    free(rays->scenes);
    free(rays);
}

/* --- points --- */

/* Point k of a sequence that fills the unit square evenly: the one of the plastic number (Roberts
 * 2018, "The unreasonable effectiveness of quasirandom sequences"), moved by a shift of the
 * facet's, so that the errors of neighbouring facets are not alike. */
static void square_point(int k, const double shift[2], double out[2])
{
    static const double STEP[2] = {0.7548776662466927, 0.5698402909980532}; /* 1/p, 1/p^2 */
    for (int j = 0; j < 2; j++) {
        const double x = shift[j] + k * STEP[j];
        out[j] = x - floor(x);
    }
}

/* A polygon as a fan of triangles from its first corner. */
typedef struct fan {
    const visibility *plan;
    const int *ring;
    int n;
    double all; /* twice its area */
} fan;

static void fan_sides(const fan *f, int v, double a[3], double b[3])
{
    const double *corner = f->plan->vertices[f->ring[0]];
    sub3(f->plan->vertices[f->ring[v]], corner, a);
    sub3(f->plan->vertices[f->ring[v + 1]], corner, b);
}

static double fan_twice_area(const fan *f, int v)
{
    double a[3], b[3], across[3];
    fan_sides(f, v, a, b);
    cross3(a, b, across);
    return norm3(across);
}

/* Maps the unit square evenly on the polygon: the first number chooses the triangle by its area. */
static void fan_point(const fan *f, const double square[2], double out[3])
{
    double a[3], b[3], left = square[0] * f->all, area = fan_twice_area(f, 1);
    int v = 1;
    while (left > area && v < f->n - 2) {
        left -= area;
        area = fan_twice_area(f, ++v);
    }
    double u = area > 0.0 ? fmin(1.0, left / area) : 0.0, w = square[1];
    if (u + w > 1.0) u = 1.0 - u, w = 1.0 - w; /* the other half of the parallelogram */
    fan_sides(f, v, a, b);
    add_scaled3(f->plan->vertices[f->ring[0]], u, a, out);
    add_scaled3(out, w, b, out);
}

/* --- rays --- */

/* Sends rays from n points in the body frame along a direction through all components. */
static void send(const visibility *plan, const ray_plan *rays, const visibility_pose *poses,
                 const double (*from_body)[3], const double direction_body[3], int n, bool *met)
{
    for (int c = 0; c < plan->n_components; c++) {
        if (!rays->scenes[c]) continue;
        double from[RAY_BATCH][3], direction[3], d[3];
        for (int k = 0; k < n; k++) {
            sub3(from_body[k], poses[c].origin_m, d);
            mat_tvec(poses[c].body_component, d, from[k]);
        }
        mat_tvec(poses[c].body_component, direction_body, direction);
        ray_scene_meet(rays->scenes[c], (const double(*)[3])from, direction, n, met);
    }
}

double ray_plan_fraction(const visibility *plan, const ray_plan *rays, const visibility_pose *poses,
                         const exposed_facet *e, const double sun_body[3],
                         const double observer_body[3])
{
    const visibility_pose *pose = &poses[e->component];
    fan f = {plan, plan->rings + e->first, e->n, 0.0};
    uint64_t state = (uint64_t)e->facet;
    const double shift[2] = {random_even(&state), random_even(&state)};
    int n_free = 0;
    for (int v = 1; v + 1 < f.n; v++)
        f.all += fan_twice_area(&f, v);
    for (int first = 0; first < rays->n; first += RAY_BATCH) {
        const int n = rays->n - first < RAY_BATCH ? rays->n - first : RAY_BATCH;
        double from_body[RAY_BATCH][3];
        bool met[RAY_BATCH] = {false};
        for (int k = 0; k < n; k++) {
            double square[2], point[3];
            square_point(first + k, shift, square);
            fan_point(&f, square, point);
            add_scaled3(point, rays->lift_m, e->normal, point);
            mat_vec(pose->body_component, point, from_body[k]);
            add3(from_body[k], pose->origin_m, from_body[k]);
        }
        send(plan, rays, poses, (const double(*)[3])from_body, sun_body, n, met);
        send(plan, rays, poses, (const double(*)[3])from_body, observer_body, n, met);
        for (int k = 0; k < n; k++)
            n_free += !met[k];
    }
    return (double)n_free / rays->n;
}
