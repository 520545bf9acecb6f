/* bench_shadows.c: how many facet-samples a second exact two-sided shadows take (facets x time
 * steps, those that are not lit or not seen counted), on one core, over random attitudes at a phase
 * angle of 60 deg.
 *
 *   craft    a bus with two wings of panels (white on the back), a dish, a tank, units on its walls
 *   station  modules of many sides across each other, and pairs of panels on a truss
 *   foil     a bus in crinkled foil with two dishes and a mast
 *   lump     a closed mesh of triangles with hills and dales
 *   boxes    boxes in any position, some of them through others: closed convex bodies
 *   plates   plates in any position: nothing is closed, everything overlaps
 *
 * usage: bench_shadows [MODEL [FACETS]]     some cases instead of all
 * Prints a table: milliseconds of the plan; M facet-samples/s of the first rows, of a light curve
 * of CURVE_ROWS rows in which the body turns by CURVE_STEP_DEG each, and of rows in any attitude
 * after WARM_ROWS others; of these last, ns a facet that is lit and seen, and percent of the time
 * that goes into looking from both directions, into finding candidates by the walk (an upper bound:
 * lists spare many walks), and into the rest: taking covers, cutting; how large a part of the lit
 * and seen area is left. */
#include "draws.h"
#include "timing.h"

#include "base/constants.h"
#include "base/vec.h"
#include "facets/visibility_view.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { ROUNDS = 3 };
static const double AT_LEAST_S = 0.05; /* of each measurement */
static const double PHASE_DEG = 60.0;

static void fail(const char *what)
{
    fprintf(stderr, "bench_shadows: %s\n", what);
    exit(1);
}

static void *allocate(size_t n, size_t size)
{
    void *memory = calloc(n, size);
    if (!memory) fail("out of memory");
    return memory;
}

/* --- models --- */

static void add_facet(facet_list *list, const double (*vertices)[3], int n)
{
    double tangent[3];
    sub3(vertices[1], vertices[0], tangent);
    if (facet_list_add(list, vertices, n, tangent, 0, 0, NULL)) fail("a facet was refused");
}

/* A box with a corner at `corner` and edges u, v, w (right-handed). */
static void add_box(facet_list *list, const double corner[3], const double edge[3][3])
{
    for (int axis = 0; axis < 3; axis++) {
        const double *u = edge[(axis + 1) % 3], *v = edge[(axis + 2) % 3];
        double face[4][3];
        for (int side = 0; side < 2; side++) {
            copy3(corner, face[0]);
            if (side) add3(face[0], edge[axis], face[0]);
            add3(face[0], side ? u : v, face[1]);
            add3(face[1], side ? v : u, face[2]);
            add3(face[0], side ? v : u, face[3]);
            add_facet(list, (const double(*)[3])face, 4);
        }
    }
}

static void add_straight_box(facet_list *list, const double lo[3], const double hi[3])
{
    const double edge[3][3] = {{hi[0] - lo[0], 0, 0}, {0, hi[1] - lo[1], 0}, {0, 0, hi[2] - lo[2]}};
    add_box(list, lo, edge);
}

/* Two plates back to back. */
static void add_panel(facet_list *list, const double corner[3], const double u[3],
                      const double v[3])
{
    double front[4][3], back[4][3];
    copy3(corner, front[0]);
    add3(front[0], u, front[1]);
    add3(front[1], v, front[2]);
    add3(front[0], v, front[3]);
    for (int k = 0; k < 4; k++)
        copy3(front[3 - k], back[k]);
    add_facet(list, (const double(*)[3])front, 4);
    add_facet(list, (const double(*)[3])back, 4);
}

/* Two wings along y, each of panels in rows of two, turned about y. */
static void add_wings(facet_list *list, int n_rows)
{
    const double turn = 0.4, pitch_m = 8.0 / n_rows, gap_m = 0.02;
    const double across[3] = {cos(turn), 0, sin(turn)};
    for (int wing = 0; wing < 2; wing++)
        for (int row = 0; row < n_rows; row++)
            for (int column = 0; column < 2; column++) {
                const double y = (wing ? 2.0 : -2.0 - 8.0) + pitch_m * row;
                const double x = column - 1.0, v[3] = {0, pitch_m - gap_m, 0};
                double corner[3] = {x * across[0], y, x * across[2]}, u[3];
                scale3(across, 1.0 - gap_m, u);
                add_panel(list, corner, u, v);
            }
}

/* A paraboloid of 1.2 m radius, open towards -x, of rings of quadrangles. */
static void add_dish(facet_list *list, int n_rings, int n_sides)
{
    const double radius_m = 1.2, depth_m = 0.4, hub = 0.1;
    for (int ring = 0; ring < n_rings; ring++)
        for (int side = 0; side < n_sides; side++) {
            double quad[4][3];
            for (int k = 0; k < 4; k++) {
                const double r = hub + (1 - hub) * (ring + (k == 1 || k == 2)) / n_rings;
                const double a = TWO_PI * ((side + (k >= 2)) % n_sides) / n_sides;
                quad[k][0] = 2.0 - depth_m * r * r;
                quad[k][1] = -radius_m * r * cos(a);
                quad[k][2] = radius_m * r * sin(a);
            }
            add_facet(list, (const double(*)[3])quad, 4);
        }
}

/* A prism along z on the bus, of about n facets in its wall: rings one on the other. */
static void add_tank(facet_list *list, int n)
{
    enum { MOST_SIDES = 96 };
    const int n_sides = n < MOST_SIDES ? n : MOST_SIDES, n_rings = n / n_sides;
    double bottom[MOST_SIDES][3], top[MOST_SIDES][3];
    const double radius_m = 0.6, from_m = 1.6, to_m = 3.0;
    for (int k = 0; k < n_sides; k++) {
        const double a = TWO_PI * k / n_sides;
        const double x = radius_m * cos(a), y = radius_m * sin(a);
        top[k][0] = bottom[n_sides - 1 - k][0] = x;
        top[k][1] = bottom[n_sides - 1 - k][1] = y;
        top[k][2] = to_m, bottom[n_sides - 1 - k][2] = from_m;
    }
    for (int k = 0; k < n_sides; k++) {
        const double *p = top[k], *q = top[(k + 1) % n_sides];
        for (int ring = 0; ring < n_rings; ring++) {
            const double z = from_m + (to_m - from_m) * ring / n_rings;
            const double next = from_m + (to_m - from_m) * (ring + 1) / n_rings;
            const double wall[4][3] = {
                {p[0], p[1], z}, {q[0], q[1], z}, {q[0], q[1], next}, {p[0], p[1], next}};
            add_facet(list, wall, 4);
        }
    }
    add_facet(list, (const double(*)[3])top, n_sides);
    add_facet(list, (const double(*)[3])bottom, n_sides);
}

/* Facets in about these parts: panels and dish a third each, tank and units a sixth each. */
static void make_craft(facet_list *list, int n, uint64_t *state)
{
    static const double lo[3] = {-1, -1.2, -1.5}, hi[3] = {1, 1.2, 1.5};
    const int n_sides = (int)(sqrt(n / 3.0) + 2), n_wall = n / 6;
    add_straight_box(list, lo, hi);
    add_wings(list, n / 24);
    add_dish(list, n / 3 / n_sides, n_sides);
    add_tank(list, n_wall);
    while (list->n < n) { /* units on the +y and -y walls */
        const double size = 2.0 / sqrt(n), x = -1 + (2 - size) * random_even(state);
        const double z = -1.5 + (3 - size) * random_even(state);
        const double y = random_even(state) < 0.5 ? -1.2 - 0.5 * size : 1.2;
        const double from[3] = {x, y, z}, to[3] = {x + size, y + 0.5 * size, z + size};
        add_straight_box(list, from, to);
    }
}

static void set_key(primitive_spec *spec, const char *key, double x, double y, double z)
{
    const int k = primitive_key_index(spec->kind, key);
    if (k < 0) fail("a primitive has no such key");
    spec->given[k] = true;
    spec->value[k][0] = x, spec->value[k][1] = y, spec->value[k][2] = z;
}

static void add_primitive(facet_list *list, primitive_spec *spec)
{
    const int k = primitive_key_index(spec->kind, "material");
    spec->given[k] = true;
    spec->material[k] = 0;
    if (primitive_add(spec, 0, list, NULL)) fail("a primitive was refused");
    primitive_spec_free(spec);
}

static primitive_spec start_primitive(const char *kind)
{
    primitive_spec spec;
    primitive_spec_start(primitive_kind_named(kind), (place){0}, &spec);
    return spec;
}

static void add_prism(facet_list *list, int sides, double radius_m, double length_m,
                      const double centre[3], const double axis[3])
{
    primitive_spec spec = start_primitive("prism");
    set_key(&spec, "sides", sides, 0, 0);
    set_key(&spec, "radius_m", radius_m, 0, 0);
    set_key(&spec, "length_m", length_m, 0, 0);
    set_key(&spec, "centre_m", centre[0], centre[1], centre[2]);
    set_key(&spec, "axis", axis[0], axis[1], axis[2]);
    add_primitive(list, &spec);
}

/* Three or seven modules of at most 48 sides, along x and z in turn; the rest are panels. */
static void make_station(facet_list *list, int n, uint64_t *state)
{
    const int n_modules = n < 200 ? 3 : 7, most = n / 2 / n_modules - 2;
    const int sides = most < 48 ? most : 48;
    const double truss_lo[3] = {-1, -30, -1}, truss_hi[3] = {1, 30, 1};
    (void)state;
    for (int k = 0; k < n_modules; k++) {
        const bool along = k % 2 == 0;
        const double at = 12.0 * (k - 0.5 * (n_modules - 1)) / n_modules;
        const double centre[3] = {at + 8, 0.3 * at, along ? 0.5 * at : 0};
        const double axis[3] = {along, 0.1, !along};
        add_prism(list, sides < 3 ? 3 : sides, 2.0 - 0.5 * along, 30.0 / n_modules + 3, centre,
                  axis);
    }
    add_straight_box(list, truss_lo, truss_hi);
    const int rows = (n - list->n) / 16;
    for (int wing = 0; wing < 8; wing++)
        for (int row = 0; row < rows; row++) {
            const double pitch_m = 30.0 / rows, v[3] = {0, 0, 0.98 * pitch_m}, u[3] = {1.6, 4, 0};
            const double y = (wing % 2 ? 1 : -1) * (wing / 2 % 2 ? 18 : 26) - 2;
            const double z = wing / 4 ? 2 + pitch_m * row : -2 - pitch_m * (row + 1);
            const double corner[3] = {-0.8, y, z};
            add_panel(list, corner, u, v);
        }
}

/* Two thirds of the facets in the foil on the six faces of the bus, a third in the dishes. */
static void make_foil(facet_list *list, int n, uint64_t *state)
{
    static const double axes[2][3] = {{1, 0, 0.3}, {-1, 0.2, 0.2}}, mast[3] = {0, 0, 2.5};
    static const double up[3] = {0, 0, 1};
    (void)state;
    for (int k = 0; k < 2; k++) {
        primitive_spec dish = start_primitive("dish");
        set_key(&dish, "radius_m", 0.9, 0, 0);
        set_key(&dish, "depth_m", 0.3, 0, 0);
        set_key(&dish, "sides", n < 200 ? 6 : floor(sqrt(0.3 * n)), 0, 0);
        set_key(&dish, "rings", n < 200 ? 1 : floor(sqrt(0.1 * n)), 0, 0);
        set_key(&dish, "centre_m", axes[k][0] * 1.3, k ? 0.9 : -0.9, 1);
        set_key(&dish, "axis", axes[k][0], axes[k][1], axes[k][2]);
        add_primitive(list, &dish);
    }
    add_prism(list, 12, 0.1, 2, mast, up);
    primitive_spec bus = start_primitive("box");
    set_key(&bus, "size_m", 2, 2, 3);
    const int side = (int)sqrt((n - list->n) / 6.0);
    bus.crinkle =
        (crinkle){.facets_per_side = side < 2 ? 2 : side, .tilt_rms_rad = 4 * DEG, .seed = 7};
    bus.given[primitive_key_index(bus.kind, "crinkle")] = true;
    add_primitive(list, &bus);
}

static void make_boxes(facet_list *list, int n, uint64_t *state)
{
    const double reach = 3.0, size = 1.4 * cbrt(30.0 / n);
    while (list->n < n) {
        double turn[9], edge[3][3], corner[3];
        random_rotation(state, turn);
        for (int j = 0; j < 3; j++) {
            corner[j] = reach * (2 * random_even(state) - 1);
            scale3(turn + 3 * j, size * (0.2 + 0.8 * random_even(state)), edge[j]);
        }
        add_box(list, corner, (const double(*)[3])edge);
    }
}

static void make_plates(facet_list *list, int n, uint64_t *state)
{
    const double reach = 3.0, size = 4.0 * sqrt(10.0 / n);
    while (list->n < n) {
        double turn[9], plate[4][3];
        random_rotation(state, turn);
        for (int j = 0; j < 3; j++)
            plate[0][j] = reach * (2 * random_even(state) - 1);
        add_scaled3(plate[0], size * (0.2 + 0.8 * random_even(state)), turn, plate[1]);
        add_scaled3(plate[1], size * (0.2 + 0.8 * random_even(state)), turn + 3, plate[2]);
        sub3(plate[2], plate[1], plate[3]);
        add3(plate[3], plate[0], plate[3]);
        add_facet(list, (const double(*)[3])plate, 4);
    }
}

/* A point of the lump: rows from pole to pole, columns around. */
static void lump_point(int rows, int columns, int row, int column, double out[3])
{
    const double theta = PI * row / rows, phi = TWO_PI * (column % columns) / columns;
    const double r = 1 + 0.3 * sin(5 * phi) * sin(theta) * sin(theta) + 0.25 * cos(6 * theta);
    out[0] = r * sin(theta) * cos(phi), out[1] = r * sin(theta) * sin(phi), out[2] = r * cos(theta);
    if (row == 0 || row == rows) out[0] = out[1] = 0;
}

static void make_lump(facet_list *list, int n, uint64_t *state)
{
    (void)state;
    const int rows = (int)lround(sqrt(n / 4.0)) + 1, columns = n / (2 * (rows - 1));
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            double quad[4][3];
            lump_point(rows, columns, row, column, quad[0]);
            lump_point(rows, columns, row + 1, column, quad[1]);
            lump_point(rows, columns, row + 1, column + 1, quad[2]);
            lump_point(rows, columns, row, column + 1, quad[3]);
            if (row < rows - 1) add_facet(list, (const double(*)[3])quad, 3);
            copy3(quad[0], quad[1]);
            double half[3][3];
            copy3(quad[0], half[0]), copy3(quad[2], half[1]), copy3(quad[3], half[2]);
            if (row > 0) add_facet(list, (const double(*)[3])half, 3);
        }
}

typedef struct model_case {
    const char *name;
    void (*make)(facet_list *list, int n, uint64_t *state);
} model_case;

static const model_case MODELS[] = {{"craft", make_craft}, {"station", make_station},
                                    {"foil", make_foil},   {"lump", make_lump},
                                    {"boxes", make_boxes}, {"plates", make_plates}};
static const int FACETS[] = {72, 1000, 10000};

/* --- measuring --- */

/* Rows after which lists have been made for most directions (visibility_sectors.h). */
enum { WARM_ROWS = 2000 };
/* Rows of a light curve: one turn. */
enum { CURVE_ROWS = 720 };
static const double CURVE_STEP_DEG = 0.5;

typedef struct scene {
    model model;
    visibility *plan;
    visibility_scratch *scratch;
    visibility_pose pose;
    int first, n;                     /* rows of the next run */
    double (*sun)[3], (*observer)[3]; /* owned; of all rows */
    double *visible;                  /* owned */
    view views[2];
    int *nodes, *candidates;                      /* owned; for the walk */
    double (*curve_sun)[3], (*curve_observer)[3]; /* owned; of CURVE_ROWS rows */
} scene;

static void fill(void *data)
{
    scene *s = data;
    for (int k = s->first; k < s->first + s->n; k++)
        if (visibility_fill(s->plan, s->scratch, &s->pose, s->sun[k], s->observer[k], k % BRDF_TILE,
                            s->visible, NULL))
            fail("out of memory");
}

/* A light curve, with all that is found out on the way. */
static void run_curve(void *data)
{
    scene *s = data;
    visibility_scratch *scratch;
    if (visibility_scratch_make(s->plan, &scratch, NULL)) fail("out of memory");
    for (int k = 0; k < CURVE_ROWS; k++)
        if (visibility_fill(s->plan, scratch, &s->pose, s->curve_sun[k], s->curve_observer[k],
                            k % BRDF_TILE, s->visible, NULL))
            fail("out of memory");
    visibility_scratch_free(scratch);
}

/* Looks from both directions, and nothing else. */
static void project(void *data)
{
    scene *s = data;
    for (int k = s->first; k < s->first + s->n; k++) {
        view_set_wide(s->plan, &s->pose, s->sun[k], 0.0, &s->views[0]);
        view_set_wide(s->plan, &s->pose, s->observer[k], 0.0, &s->views[1]);
    }
}

/* The same, and walks for every facet that is lit and seen. */
static void walk(void *data)
{
    scene *s = data;
    for (int k = s->first; k < s->first + s->n; k++) {
        view_set_wide(s->plan, &s->pose, s->sun[k], 0.0, &s->views[0]);
        view_set_wide(s->plan, &s->pose, s->observer[k], 0.0, &s->views[1]);
        for (int e = 0; e < s->plan->n_exposed; e++) {
            const exposed_facet *f = &s->plan->exposed[e];
            const bool counts = s->views[0].cosine[f->facet] > BRDF_EDGE &&
                                s->views[1].cosine[f->facet] > BRDF_EDGE;
            for (int which = 0; which < 2 && counts; which++) {
                shaft before;
                shaft_make(s->plan, &s->views[which], f, 0.0, &before);
                view_candidates(s->plan, &s->views[which], &before, 0, 1, s->nodes, s->candidates);
            }
        }
    }
}

static void make_directions(scene *s, int n)
{
    const double sun[3] = {sin(PHASE_DEG * DEG), 0, cos(PHASE_DEG * DEG)}, observer[3] = {0, 0, 1};
    uint64_t state = 1;
    s->sun = allocate((size_t)n, sizeof *s->sun);
    s->observer = allocate((size_t)n, sizeof *s->observer);
    for (int k = 0; k < n; k++) {
        double turn[9];
        random_rotation(&state, turn);
        mat_vec(turn, sun, s->sun[k]);
        mat_vec(turn, observer, s->observer[k]);
    }
    s->curve_sun = allocate(CURVE_ROWS, sizeof *s->curve_sun);
    s->curve_observer = allocate(CURVE_ROWS, sizeof *s->curve_observer);
    for (int k = 0; k < CURVE_ROWS; k++) { /* about an axis that is none of the body's */
        const double half = 0.5 * CURVE_STEP_DEG * DEG * k, part = sin(half) / sqrt(14.0);
        const double q[4] = {cos(half), part, 2 * part, 3 * part};
        double turn[9];
        mat_from_quat(q, turn);
        mat_vec(turn, sun, s->curve_sun[k]);
        mat_vec(turn, observer, s->curve_observer[k]);
    }
}

/* Facets that are lit and seen in the rows; *left: part of their projected area that is left. */
static double count_active(scene *s, double *left)
{
    const int first = s->first, n_rows = s->n;
    double n = 0, all = 0, sum = 0;
    s->n = 1;
    for (int k = first; k < first + n_rows; k++) {
        s->first = k;
        fill(s);
        for (int j = 0; j < s->model.n_facets; j++) {
            const facet *f = &s->model.polygons.items[j];
            const double ci = dot3(f->normal, s->sun[k]), cr = dot3(f->normal, s->observer[k]);
            if (ci <= BRDF_EDGE || cr <= BRDF_EDGE) continue;
            n++;
            all += ci * cr * f->area_m2;
            sum +=
                ci * cr * f->area_m2 * s->visible[(size_t)j * BRDF_TILE + (size_t)(k % BRDF_TILE)];
        }
    }
    s->first = first, s->n = n_rows;
    *left = sum / all;
    return n;
}

/* Milliseconds of the plan. */
static double make_scene(const model_case *c, int n_facets, const model_material *material,
                         scene *s)
{
    static const model_component component = {"all"};
    visibility_component whole = {.parent = -1};
    facet_list facets = {0};
    uint64_t state = 7;
    mat_identity(whole.pose.body_component);
    s->pose = whole.pose;
    c->make(&facets, n_facets, &state);
    if (model_compile(&facets, material, 1, &component, 1, 1, &s->model, NULL)) fail("no model");
    const double from_s = cpu_s();
    if (visibility_make(&s->model, &whole, &s->plan, NULL)) fail("no plan");
    const double plan_s = cpu_s() - from_s;
    if (visibility_scratch_make(s->plan, &s->scratch, NULL)) fail("no scratch");
    if (!view_allocate(&s->views[0], s->plan) || !view_allocate(&s->views[1], s->plan))
        fail("out of memory");
    s->nodes = allocate((size_t)s->plan->n_nodes + NODE_CHILDREN, sizeof *s->nodes);
    s->candidates = allocate((size_t)s->plan->n_occluders + NODE_CHILDREN, sizeof *s->candidates);
    s->visible = allocate((size_t)s->model.n_facets * BRDF_TILE, sizeof *s->visible);
    return plan_s * 1e3;
}

static void free_scene(scene *s)
{
    visibility_scratch_free(s->scratch);
    visibility_free(s->plan);
    model_free(&s->model);
    view_free(&s->views[0]);
    view_free(&s->views[1]);
    free(s->nodes);
    free(s->candidates);
    free(s->visible);
    free(s->curve_sun);
    free(s->curve_observer);
    free(s->sun);
    free(s->observer);
}

static void run_case(const model_case *c, int n_facets)
{
    static const double reflectance = 0.5;
    brdf_lobe lobe = {.model = brdf_model_named("lambert"), .weight = 1};
    brdf_material band = {1, &lobe};
    const model_material material = {"grey", &band};
    scene s = {.n = n_facets > 5000 ? 32 : n_facets > 500 ? 256 : 1024};
    lobe.model->prepare(&reflectance, lobe.coef, NULL);
    const double plan_ms = make_scene(c, n_facets, &material, &s);
    const int n_rows = s.n, n_all = WARM_ROWS + n_rows;
    make_directions(&s, n_all);
    s.n = n_facets > 5000 ? 32 : 64;
    const double samples = s.model.n_facets, first_s = cpu_s();
    fill(&s);
    const double first = samples * s.n / (cpu_s() - first_s) * 1e-6;
    s.first = s.n, s.n = WARM_ROWS - s.n;
    fill(&s);
    s.first = WARM_ROWS, s.n = n_rows;
    job jobs[4] = {{.run = fill, .data = &s},
                   {.run = project, .data = &s},
                   {.run = walk, .data = &s},
                   {.run = run_curve, .data = &s}};
    measure(jobs, 4, ROUNDS, AT_LEAST_S);
    double left;
    const double active = count_active(&s, &left), all_s = jobs[0].least;
    const double look = 100 * jobs[1].least / all_s, found = 100 * jobs[2].least / all_s - look;
    printf("%-8s %6d %8d %8.2f %7.2f %7.2f %7.2f %10.0f %5.0f %5.0f %5.0f %8.4f\n", c->name,
           s.model.n_facets, visibility_n_exposed(s.plan), plan_ms, first,
           samples * CURVE_ROWS / jobs[3].least * 1e-6, samples * n_rows / all_s * 1e-6,
           all_s / active * 1e9, look, found, 100 - look - found, left);
    fflush(stdout);
    free_scene(&s);
}

int main(int argc, char **argv)
{
    if (argc > 3) {
        fputs("usage: bench_shadows [MODEL [FACETS]]\n", stderr);
        return 2;
    }
    int n_run = 0;
    printf("model    facets  exposed  plan/ms   first   curve   later  ns/active look%% walk%% "
           "rest%%     "
           "left\n");
    for (size_t m = 0; m < sizeof MODELS / sizeof *MODELS; m++)
        for (size_t f = 0; f < sizeof FACETS / sizeof *FACETS; f++) {
            if (argc > 1 && strcmp(argv[1], MODELS[m].name) != 0) continue;
            if (argc > 2 && atoi(argv[2]) != FACETS[f]) continue;
            run_case(&MODELS[m], FACETS[f]);
            n_run++;
        }
    if (n_run == 0) fputs("bench_shadows: there is no such case\n", stderr);
    return n_run ? 0 : 2;
}
