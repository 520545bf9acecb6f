/* mirror.c: flat shiny surfaces: which there are, how they turn, and how nearly they can mirror the
 * Sun to the observer whatever their phase. */
#include "base/constants.h"
#include "base/roots.h"
#include "base/vec.h"
#include "brdf/sharpness.h"
#include "lightcurve/pass_parts.h"

#include <math.h>
#include <stdlib.h>

/* ---------------------------------------------------------------- the turn */

/* Fills in how the mirror turns: at most how fast, and about what if it is one steady turn. */
static void find_turn(const satellite *sat, const attitude_plan *plan, mirror *m)
{
    /* Slower turns are as slow as everything else, and need no search of their own. */
    static const double LONGEST_PERIOD_S = 600;
    double normal[3]; /* in the frame that the walk up the chain of hinges has come to */
    bool tracks = false, clamped = false;
    int turns = 0;
    copy3(m->normal, normal);
    for (int c = m->component; c >= 0; c = sat->components[c].parent) {
        if (!sat->components[c].has_hinge) continue;
        const hinge *h = &sat->components[c].hinge;
        if (h->drive == HINGE_RATE && h->rate_rad_s != 0) {
            m->fastest_rad_s += fabs(h->rate_rad_s);
            clamped = clamped || h->has_limits;
            /* what tracks between the mirror and the turn does not move with the turn */
            if (turns++ > 0 || tracks) continue;
            m->frame = c;
            copy3(h->axis, m->axis);
        } else if (h->drive == HINGE_FIXED || h->drive == HINGE_RATE) {
            double turn[9], angle = 0;
            (void)hinge_angle(h, 0, NULL, &angle, NULL); /* only tables can fail */
            hinge_matrix(h, angle, turn);
            if (turns == 0) mat_tvec(turn, normal, normal);
        } else if (turns == 0) {
            tracks = true;
        }
    }
    const attitude_turning body = attitude_plan_turning(plan);
    m->fastest_rad_s += body.fastest_rad_s;
    if (body.fastest_rad_s > 0 && turns++ == 0) {
        m->frame = -1;
        copy3(body.axis_body, m->axis);
    }
    const bool steady = turns == 1 && !tracks && !clamped &&
                        (body.is_steady || !(body.fastest_rad_s > 0)) &&
                        m->fastest_rad_s > TWO_PI / LONGEST_PERIOD_S;
    m->period_s = steady ? TWO_PI / m->fastest_rad_s : 0;
    m->cosine = dot3(m->axis, normal);
}

/* ----------------------------------------------------------------- the list */

static bool is_shiny(const satellite *sat, int material)
{
    return brdf_material_width(&sat->model.materials[material].bands[0]) < HUGE_VAL;
}

/* By component, then along x: those that look the same way stand near each other. */
static int mirror_order(const void *a, const void *b)
{
    const mirror *p = a, *q = b;
    if (p->component != q->component) return p->component < q->component ? -1 : 1;
    if (p->normal[0] != q->normal[0]) return p->normal[0] < q->normal[0] ? -1 : 1;
    return (p->facet > q->facet) - (p->facet < q->facet);
}

static int facet_order(const void *a, const void *b)
{
    const mirror *p = a, *q = b;
    return (p->facet > q->facet) - (p->facet < q->facet);
}

/* Whether one of the n sorted mirrors before *m looks the same way. */
static bool is_known(const mirror *m, int n)
{
    static const double SAME = 1e-9; /* as parallel as rounding lets facets be */
    for (int k = 1; k <= n; k++) {
        const mirror *before = m - k;
        double apart[3];
        if (before->component != m->component || m->normal[0] - before->normal[0] > SAME) break;
        sub3(m->normal, before->normal, apart);
        if (norm3(apart) < SAME) return true;
    }
    return false;
}

glint_status mirrors_of(const satellite *sat, const attitude_plan *plan, mirror_list *out,
                        glint_error *error)
{
    const model *m = &sat->model;
    *out = (mirror_list){.items = calloc((size_t)m->n_facets + 1, sizeof *out->items)};
    bool *shiny = calloc((size_t)m->n_materials + 1, sizeof *shiny);
    if (!out->items || !shiny) {
        free(shiny);
        return error_no_memory(error);
    }
    for (int k = 0; k < m->n_materials; k++)
        shiny[k] = is_shiny(sat, k);
    int n = 0;
    for (int k = 0; k < m->polygons.n; k++) {
        const facet *f = &m->polygons.items[k];
        if (f->surface || !shiny[f->material]) continue;
        out->items[n] = (mirror){.component = f->component, .facet = k};
        copy3(f->normal, out->items[n++].normal);
    }
    free(shiny);
    qsort(out->items, (size_t)n, sizeof *out->items, mirror_order);
    for (int k = 0; k < n; k++)
        out->items[k].twin = is_known(&out->items[k], k);
    for (int k = 0; k < n; k++)
        if (!out->items[k].twin) out->items[out->n++] = out->items[k];
    qsort(out->items, (size_t)out->n, sizeof *out->items, facet_order);
    for (int k = 0; k < out->n; k++)
        find_turn(sat, plan, &out->items[k]);
    return GLINT_OK;
}

/* ------------------------------------------------------------------- angles */

/* pi where the Sun or the observer stands behind the surface. */
double mirror_angle(const double normal[3], const double sun[3], const double observer[3])
{
    double to[3];
    const double ci = dot3(normal, sun);
    if (!(ci > 0) || !(dot3(normal, observer) > 0)) return PI;
    for (int i = 0; i < 3; i++)
        to[i] = 2 * ci * normal[i] - sun[i];
    return angle3(to, observer);
}

/* Normals on a cone, against the Sun and the observer.
 *
 * With a the angle between Sun and observer, h the direction midway and w that normal to it in
 * their plane, n.s and n.o are n.h cos(a/2) +- n.w sin(a/2); so the mirror angle m of a normal n,
 * cos m = 2 (n.s)(n.o) - s.o, has sin^2(m/2) = |n x h|^2 cos^2(a/2) + (n.w)^2 sin^2(a/2). */
typedef struct normal_cone {
    double along[3], across[2][3]; /* n = along + across[0] cos(phase) + across[1] sin(phase) */
    double middle[3], apart[3];    /* h, w; 0 where not defined */
    double cos2, sin2;             /* of a/2, squared */
} normal_cone;

static glint_status cone_angle_at(void *context, double phase, double *y, glint_error *error)
{
    (void)error;
    const normal_cone *cone = context;
    double n[3], turned[3];
    const double c = cos(phase), s = sin(phase);
    for (int i = 0; i < 3; i++)
        n[i] = cone->along[i] + c * cone->across[0][i] + s * cone->across[1][i];
    cross3(n, cone->middle, turned);
    const double w = dot3(n, cone->apart);
    const double square = dot3(turned, turned) * cone->cos2 + w * w * cone->sin2;
    *y = dot3(n, cone->middle) < 0 ? PI : 2 * asin(fmin(1, sqrt(square)));
    return GLINT_OK;
}

static void make_cone(const mirror *m, const double pole[3], const double sun[3],
                      const double observer[3], normal_cone *out)
{
    double u[3], v[3];
    const double sine = sqrt(fmax(0, 1 - m->cosine * m->cosine));
    add3(sun, observer, u);
    out->cos2 = 0.25 * dot3(u, u);
    out->sin2 = 1 - out->cos2;
    unit3(u, out->middle);
    sub3(sun, observer, u);
    perp3(u, out->middle, out->apart);
    if (!(perp3(out->middle, pole, u) > 0)) {
        double any[3] = {0, 0, 0};
        any[smallest3(pole)] = 1;
        perp3(any, pole, u);
    }
    cross3(pole, u, v);
    scale3(pole, m->cosine, out->along);
    scale3(u, sine, out->across[0]);
    scale3(v, sine, out->across[1]);
}

double mirror_least_angle(const mirror *m, const double pole[3], const double sun[3],
                          const double observer[3])
{
    /* sin^2(m/2) has two minima over a turn at most, since it holds no higher harmonic than the
     * second. The minimum is a kink where it is 0, so the phase decides the angle's error. */
    enum { SAMPLES = 24 };
    static const double PHASE_TOLERANCE = 1e-9; /* rad */
    normal_cone cone;
    double angle[SAMPLES], least = PI;
    make_cone(m, pole, sun, observer, &cone);
    for (int k = 0; k < SAMPLES; k++)
        cone_angle_at(&cone, TWO_PI * k / SAMPLES, &angle[k], NULL);
    for (int k = 0; k < SAMPLES; k++) {
        const double before = angle[(k + SAMPLES - 1) % SAMPLES], after = angle[(k + 1) % SAMPLES];
        if (!(angle[k] <= before && angle[k] <= after && angle[k] < PI)) continue;
        double at, value;
        minimum_find(cone_angle_at, &cone, TWO_PI * (k - 1) / SAMPLES, TWO_PI * (k + 1) / SAMPLES,
                     PHASE_TOLERANCE, &at, &value, NULL);
        least = fmin(least, value);
    }
    return fmax(0, least - PHASE_TOLERANCE);
}
