/* bench_kernel.c: how many facet-samples a second the sum over facets takes (facets x time steps,
 * those that are not lit or not seen counted), on one core. Beside it, in the same run:
 *
 *   naive   the same sum facet after facet, step after step, in plain C with the C library's exp
 *   roof    one exp, one square root and one division per facet-sample and nothing else, all of
 *           them vectorised as in the kernel, nothing skipped
 *
 * usage: bench_kernel [MODEL FACETS MOTION]     one case instead of all
 * Prints a table: M facet-samples/s, and ratios. Fails when kernel and naive sum disagree. */
#include "draws.h"
#include "naive.h"
#include "timing.h"

#include "base/clones.h"
#include "base/constants.h"
#include "base/vec.h"
#include "brdf/brdf.h"
#include "brdf/fastmath.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { TILES = 24, STEPS = TILES * BRDF_TILE }; /* a little more than one turn */
enum { ROUNDS = 7 };
static const double AT_LEAST_S = 0.03; /* of each measurement */
static const double STEP_DEG = 0.5;    /* by which a body in coherent motion turns each step */
static const double PHASE_DEG = 60.0;

typedef struct model_case {
    const char *name;
    naive_sum *naive;
    naive_material material;
    double params[BRDF_MAX_PARAMS]; /* the same, in the order of the model's table */
} model_case;

static const model_case MODELS[] = {
    {"lambert", naive_lambert, {0.3, 0, 0, 0}, {0.3}},
    {"ward", naive_ward, {0.1, 0.3, 0.1, 0.2}, {0.1, 0.3, 0.1, 0.2, NAN, NAN}},
    {"ward-gmd", naive_ward_gmd, {0.1, 0.3, 0.1, 0.2}, {0.1, 0.3, 0.1, 0.2, NAN, NAN}},
};
static const int FACETS[] = {72, 1000, 10000, 100000};
static const char *const MOTIONS[] = {"coherent", "incoherent"};

/* One case with everything that its jobs read. */
typedef struct scene {
    const model_case *model;
    const brdf_model *brdf;
    double coef[BRDF_MAX_COEF];
    int n;
    double *arrays;     /* owned; backs `facets` */
    naive_facet *plain; /* owned; the same facets */
    brdf_facets facets;
    brdf_light *lights;          /* owned; TILES */
    double (*kernel)[BRDF_TILE]; /* owned; TILES; what it came to */
    double (*naive)[BRDF_TILE];  /* owned; TILES */
    double roof[BRDF_TILE];      /* kept so that the work cannot be left out */
} scene;

static void *allocate(size_t n, size_t size)
{
    void *memory = aligned_alloc(64, (n * size + 63) / 64 * 64);
    if (!memory) {
        fputs("bench_kernel: out of memory\n", stderr);
        exit(4);
    }
    memset(memory, 0, n * size);
    return memory;
}

/* Normals spread evenly over the sphere (the golden spiral), tangents eastward about z. */
static void make_facets(scene *s)
{
    static const double GOLDEN = 2.39996322972865332; /* golden angle, rad */
    s->arrays = allocate(10 * (size_t)s->n, sizeof *s->arrays);
    s->plain = allocate((size_t)s->n, sizeof *s->plain);
    double *array[10];
    for (int a = 0; a < 10; a++)
        array[a] = s->arrays + (size_t)a * (size_t)s->n;
    for (int j = 0; j < s->n; j++) {
        naive_facet *f = &s->plain[j];
        const double z = 1.0 - (2.0 * j + 1.0) / s->n, across = sqrt(1.0 - z * z);
        f->normal[0] = across * cos(GOLDEN * j);
        f->normal[1] = across * sin(GOLDEN * j);
        f->normal[2] = z;
        const double east[3] = {-f->normal[1], f->normal[0], 0.0};
        unit3(east, f->tangent);
        cross3(f->normal, f->tangent, f->bitangent);
        f->area_m2 = 1.0 / s->n;
        for (int axis = 0; axis < 3; axis++) {
            array[axis][j] = f->normal[axis];
            array[3 + axis][j] = f->tangent[axis];
            array[6 + axis][j] = f->bitangent[axis];
        }
        array[9][j] = f->area_m2;
    }
    s->facets = (brdf_facets){.n = s->n,
                              .normal = {array[0], array[1], array[2]},
                              .tangent = {array[3], array[4], array[5]},
                              .bitangent = {array[6], array[7], array[8]},
                              .area = array[9]};
}

/* Sun and observer stay; the body turns steadily, or takes any attitude at every step. */
static void make_lights(scene *s, bool coherent)
{
    static const double AXIS[3] = {1, 2, 3};
    double axis[3], turn[9], i[3], r[3];
    const double sun[3] = {sin(PHASE_DEG * DEG), 0, cos(PHASE_DEG * DEG)}, observer[3] = {0, 0, 1};
    uint64_t state = 1;
    unit3(AXIS, axis);
    s->lights = allocate(TILES, sizeof *s->lights);
    for (int step = 0; step < STEPS; step++) {
        brdf_light *light = &s->lights[step / BRDF_TILE];
        if (coherent)
            mat_turn(axis, step * STEP_DEG * DEG, turn);
        else
            random_rotation(&state, turn);
        mat_vec(turn, sun, i);
        mat_vec(turn, observer, r);
        for (int c = 0; c < 3; c++) {
            light->i[c][step % BRDF_TILE] = i[c];
            light->r[c][step % BRDF_TILE] = r[c];
        }
    }
    for (int tile = 0; tile < TILES; tile++)
        brdf_light_finish(&s->lights[tile]);
}

static void run_kernel(void *data)
{
    scene *s = data;
    for (int tile = 0; tile < TILES; tile++) {
        memset(s->kernel[tile], 0, sizeof s->kernel[tile]);
        s->brdf->tile(s->coef, 1.0, &s->facets, &s->lights[tile], NULL, s->kernel[tile]);
    }
}

static void run_naive(void *data)
{
    scene *s = data;
    for (int step = 0; step < STEPS; step++) {
        const brdf_light *light = &s->lights[step / BRDF_TILE];
        const int k = step % BRDF_TILE;
        const double i[3] = {light->i[0][k], light->i[1][k], light->i[2][k]};
        const double r[3] = {light->r[0][k], light->r[1][k], light->r[2][k]};
        s->naive[step / BRDF_TILE][k] = s->model->naive(s->plain, s->n, &s->model->material, i, r);
    }
}

/* The facet's numbers enter so that nothing can be taken out of the loop. */
CLONES static void roof_tile(const brdf_facets *facets, const brdf_light *light,
                             double sum[BRDF_TILE])
{
    _Alignas(64) double total[BRDF_TILE] = {0};
    for (int f = 0; f < facets->n; f++) {
        const double a = facets->normal[0][f], b = facets->normal[1][f], c = facets->area[f];
        for (int k = 0; k < BRDF_TILE; k++)
            total[k] +=
                c * sqrt(light->hh[k] + a) * fast_exp((b - light->hlen[k]) / (light->hh[k] + c));
    }
    for (int k = 0; k < BRDF_TILE; k++)
        sum[k] += total[k];
}

static void run_roof(void *data)
{
    scene *s = data;
    for (int tile = 0; tile < TILES; tile++)
        roof_tile(&s->facets, &s->lights[tile], s->roof);
}

static void check_sums(const scene *s)
{
    for (int step = 0; step < STEPS; step++) {
        const double got = s->kernel[step / BRDF_TILE][step % BRDF_TILE];
        const double want = s->naive[step / BRDF_TILE][step % BRDF_TILE];
        if (fabs(got - want) <= 1e-9 * want) continue;
        fprintf(stderr, "bench_kernel: %s, %d facets, step %d: kernel %.17g, naive %.17g\n",
                s->model->name, s->n, step, got, want);
        exit(1);
    }
}

static void run_case(const model_case *model, int n, const char *motion)
{
    scene s = {.model = model, .brdf = brdf_model_named(model->name), .n = n};
    glint_error error;
    if (!s.brdf || s.brdf->prepare(model->params, s.coef, &error)) {
        fprintf(stderr, "bench_kernel: %s: %s\n", model->name, s.brdf ? error.message : "no model");
        exit(1);
    }
    make_facets(&s);
    make_lights(&s, strcmp(motion, "coherent") == 0);
    s.kernel = allocate(TILES, sizeof *s.kernel);
    s.naive = allocate(TILES, sizeof *s.naive);
    job jobs[] = {{.run = run_kernel, .data = &s},
                  {.run = run_naive, .data = &s},
                  {.run = run_roof, .data = &s}};
    measure(jobs, 3, ROUNDS, AT_LEAST_S);
    check_sums(&s);
    double rate[3], sum = 0.0;
    for (int j = 0; j < 3; j++)
        rate[j] = (double)n * STEPS / jobs[j].least * 1e-6;
    for (int step = 0; step < STEPS; step++)
        sum += s.kernel[step / BRDF_TILE][step % BRDF_TILE];
    printf("%-9s %7d %-11s %8.0f %7.0f %7.0f %12.2f %13.1f  %.12e\n", model->name, n, motion,
           rate[0], rate[1], rate[2], rate[0] / rate[2], rate[0] / rate[1], sum / STEPS);
    fflush(stdout);
    free(s.arrays);
    free(s.plain);
    free(s.lights);
    free(s.kernel);
    free(s.naive);
}

int main(int argc, char **argv)
{
    if (argc != 1 && argc != 4) {
        fputs("usage: bench_kernel [MODEL FACETS MOTION]\n", stderr);
        return 2;
    }
    printf("model      facets motion        kernel   naive    roof  kernel/roof  kernel/naive  "
           "mean sum, m^2/sr\n");
    int n_run = 0;
    for (size_t m = 0; m < sizeof MODELS / sizeof *MODELS; m++)
        for (size_t c = 0; c < 2; c++)
            for (size_t f = 0; f < sizeof FACETS / sizeof *FACETS; f++) {
                if (argc == 4 && (strcmp(argv[1], MODELS[m].name) || atoi(argv[2]) != FACETS[f] ||
                                  strcmp(argv[3], MOTIONS[c])))
                    continue;
                run_case(&MODELS[m], FACETS[f], MOTIONS[c]);
                n_run++;
            }
    if (n_run == 0) fputs("bench_kernel: there is no such case\n", stderr);
    return n_run ? 0 : 2;
}
