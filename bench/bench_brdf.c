/* bench_brdf.c: facet-samples per second of every model's kernel, on one core.
 *
 * A sphere of 1000 facets under 64 tiles of directions. Facets that face away count as samples, as
 * a user would count them. Beside it, on the same machine and in the same run: the roof, a loop
 * that does one exp, one root and one division a sample and nothing else, and the naive way, one
 * call of the scalar face a sample. Each figure is the best of several runs, since other work on
 * the machine only ever slows one down. */
#include "base/constants.h"
#include "base/vec.h"
#include "brdf/brdf.h"
#include "brdf/fastmath.h"

#include <stdio.h>
#include <time.h>

enum { N_FACETS = 1000, N_TILES = 64, RUNS = 25, SAMPLES = N_FACETS * N_TILES * BRDF_TILE };

typedef struct scene {
    double normal[3][N_FACETS], tangent[3][N_FACETS], bitangent[3][N_FACETS], area[N_FACETS];
    brdf_light coherent[N_TILES], scattered[N_TILES];
} scene;

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Uniform in 0..1 (Knuth's MMIX generator). */
static double next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static void fill_facets(scene *s)
{
    const double golden_angle = PI * (3.0 - sqrt(5.0));
    for (int f = 0; f < N_FACETS; f++) {
        const double z = 1.0 - (2.0 * f + 1.0) / N_FACETS, q = sqrt(1.0 - z * z);
        const double normal[3] = {q * cos(f * golden_angle), q * sin(f * golden_angle), z};
        const double tangent[3] = {-sin(f * golden_angle), cos(f * golden_angle), 0.0};
        double bitangent[3];
        cross3(normal, tangent, bitangent);
        for (int j = 0; j < 3; j++) {
            s->normal[j][f] = normal[j];
            s->tangent[j][f] = tangent[j];
            s->bitangent[j][f] = bitangent[j];
        }
        s->area[f] = 4.0 * PI / N_FACETS;
    }
}

/* A body that has turned by `angle` rad under a fixed source and observer 1 rad apart. */
static void fill_lane(brdf_light *light, int k, double angle)
{
    const double axis[3] = {0.36, 0.48, 0.8}, i0[3] = {1, 0, 0}, r0[3] = {cos(1), sin(1), 0};
    double turn[9], i[3], r[3];
    mat_turn(axis, angle, turn);
    mat_vec(turn, i0, i);
    mat_vec(turn, r0, r);
    for (int j = 0; j < 3; j++) {
        light->i[j][k] = i[j];
        light->r[j][k] = r[j];
    }
}

static void fill_light(scene *s)
{
    uint64_t state = 1;
    for (int t = 0; t < N_TILES; t++) {
        for (int k = 0; k < BRDF_TILE; k++) {
            fill_lane(&s->coherent[t], k, 0.01 * (t * BRDF_TILE + k));
            fill_lane(&s->scattered[t], k, TWO_PI * next_random(&state));
        }
        brdf_light_finish(&s->coherent[t]);
        brdf_light_finish(&s->scattered[t]);
    }
}

/* A value inside the range that makes a lobe of ordinary width. */
static double ordinary_value(const param_info *p)
{
    if (p->flags & PARAM_OPTIONAL) return PARAM_NONE;
    if (p->max <= 1.0) return p->min + 0.4 * (p->max - p->min);
    return p->max <= 10.0 ? 0.2 : 0.3 * sqrt(p->max);
}

/* M samples/s of a kernel. */
static double kernel_rate(const brdf_model *model, const double *coef, const scene *s,
                          const brdf_light *light, double *checksum)
{
    const brdf_facets facets = {
        .n = N_FACETS,
        .normal = {s->normal[0], s->normal[1], s->normal[2]},
        .tangent = {s->tangent[0], s->tangent[1], s->tangent[2]},
        .bitangent = {s->bitangent[0], s->bitangent[1], s->bitangent[2]},
        .area = s->area,
    };
    double best_s = HUGE_VAL, sum[BRDF_TILE] = {0};
    for (int run = 0; run < RUNS; run++) {
        const double start = now_s();
        for (int t = 0; t < N_TILES; t++)
            model->tile(coef, 1.0, &facets, &light[t], NULL, sum);
        best_s = fmin(best_s, now_s() - start);
    }
    *checksum += sum[0];
    return SAMPLES / best_s / 1e6;
}

/* M samples/s of the scalar face, called for every facet at every moment. */
static double naive_rate(const brdf_model *model, const double *coef, const scene *s,
                         const brdf_light *light, double *checksum)
{
    const double start = now_s();
    for (int t = 0; t < N_TILES; t++)
        for (int k = 0; k < BRDF_TILE; k++) {
            const double i[3] = {light[t].i[0][k], light[t].i[1][k], light[t].i[2][k]};
            const double r[3] = {light[t].r[0][k], light[t].r[1][k], light[t].r[2][k]};
            for (int f = 0; f < N_FACETS; f++) {
                double frame[9], i_facet[3], r_facet[3];
                for (int j = 0; j < 3; j++) {
                    frame[j] = s->tangent[j][f];
                    frame[3 + j] = s->bitangent[j][f];
                    frame[6 + j] = s->normal[j][f];
                }
                mat_vec(frame, i, i_facet);
                mat_vec(frame, r, r_facet);
                *checksum += s->area[f] * model->eval(coef, i_facet, r_facet);
            }
        }
    return SAMPLES / (now_s() - start) / 1e6;
}

/* What the vector units give at best to a lobe that needs an exp, a root and a division. It is
 * compiled for the same processors as the kernels. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
static void
roof_loop(double *restrict sum, const double *restrict a, const double *restrict b, int n)
{
    for (int k = 0; k < n; k++)
        sum[k] += sqrt(b[k]) * fast_exp(a[k] / b[k]);
}

static double roof_rate(double *checksum)
{
    enum { N = 4096, ROUNDS = 100 };
    static double a[N], b[N], sum[N];
    uint64_t state = 2;
    for (int k = 0; k < N; k++) {
        a[k] = -5.0 * next_random(&state);
        b[k] = 0.1 + next_random(&state);
    }
    double best_s = HUGE_VAL;
    for (int run = 0; run < 2 * RUNS; run++) {
        const double start = now_s();
        for (int round = 0; round < ROUNDS; round++)
            roof_loop(sum, a, b, N);
        best_s = fmin(best_s, now_s() - start);
    }
    *checksum += sum[0];
    return (double)N * ROUNDS / best_s / 1e6;
}

int main(void)
{
    static scene s;
    double checksum = 0.0;
    fill_facets(&s);
    fill_light(&s);
    const double roof = roof_rate(&checksum);
    printf("M facet-samples/s on one core, %d facets; roof %.0f\n", N_FACETS, roof);
    printf("%-20s %9s %7s %10s %7s %9s\n", "model", "coherent", "/roof", "scattered", "/roof",
           "scalar");
    for (size_t m = 0; brdf_model_at(m); m++) {
        const brdf_model *model = brdf_model_at(m);
        double params[BRDF_MAX_PARAMS], coef[BRDF_MAX_COEF];
        for (int j = 0; j < model->n_params; j++)
            params[j] = ordinary_value(&model->params[j]);
        if (model->prepare(params, coef, NULL) != GLINT_OK) continue;
        const double coherent = kernel_rate(model, coef, &s, s.coherent, &checksum);
        const double scattered = kernel_rate(model, coef, &s, s.scattered, &checksum);
        const double naive = naive_rate(model, coef, &s, s.coherent, &checksum);
        printf("%-20s %9.0f %7.2f %10.0f %7.2f %9.0f\n", model->name, coherent, coherent / roof,
               scattered, scattered / roof, naive);
    }
    printf("checksum %.6g\n", checksum);
    return 0;
}
