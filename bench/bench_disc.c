/* bench_disc.c: what the Sun's disc costs beside a point, for materials from diffuse to mirrors.
 *
 * 1000 flat facets whose normals are spread evenly, under the Sun and an observer 60 deg apart:
 * turned by 0.5 deg a step (coherent) or by any angle (incoherent). */
#include "timing.h"

#include "base/constants.h"
#include "base/vec.h"
#include "facets/model.h"

#include <stdio.h>
#include <stdlib.h>

enum { FACETS = 1000, TILES = 32 };

typedef struct scene {
    model model;
    brdf_light lights[TILES];
    source_disc disc;
    bool is_disc;
    double x[BRDF_TILE], checksum;
} scene;

static void fail(const char *what)
{
    fprintf(stderr, "bench_disc: %s\n", what);
    exit(4);
}

/* Square plates about the golden spiral of normals. */
static void add_facets(facet_list *list)
{
    static const double GOLDEN = 2.39996322972865332; /* golden angle, rad */
    for (int j = 0; j < FACETS; j++) {
        const double z = 1.0 - (2.0 * j + 1.0) / FACETS, across = sqrt(1.0 - z * z);
        const double normal[3] = {across * cos(GOLDEN * j), across * sin(GOLDEN * j), z};
        const double up[3] = {0.3, 0.1, 0.9};
        double t[3], b[3], corners[4][3];
        perp3(up, normal, t);
        cross3(normal, t, b);
        for (int c = 0; c < 4; c++)
            for (int k = 0; k < 3; k++)
                corners[c][k] = 10.0 * normal[k] + ((c == 1 || c == 2) ? 0.05 : -0.05) * t[k] +
                                (c >= 2 ? 0.05 : -0.05) * b[k];
        if (facet_list_add(list, (const double(*)[3])corners, 4, t, 0, 0, NULL)) fail("memory");
    }
}

static void fill_lights(scene *s, bool coherent)
{
    for (int tile = 0; tile < TILES; tile++) {
        for (int k = 0; k < BRDF_TILE; k++) {
            const int step = tile * BRDF_TILE + k;
            const double axis[3] = {0.36, 0.48, 0.8}, other[3] = {0.8, -0.6, 0};
            const double sun[3] = {1, 0, 0}, observer[3] = {0.5, sqrt(0.75), 0};
            double turn[9], more[9], both[9], i[3], r[3];
            mat_turn(axis, coherent ? 0.5 * DEG * step : fmod(2.399963 * step, TWO_PI), turn);
            mat_turn(other, coherent ? 0 : fmod(1.7320508 * step, TWO_PI), more);
            mat_mul(turn, more, both);
            mat_vec(both, sun, i);
            mat_vec(both, observer, r);
            for (int j = 0; j < 3; j++) {
                s->lights[tile].i[j][k] = i[j];
                s->lights[tile].r[j][k] = r[j];
            }
        }
        brdf_light_finish(&s->lights[tile]);
    }
}

static void run(void *data)
{
    scene *s = data;
    for (int tile = 0; tile < TILES; tile++) {
        model_sum(&s->model, &s->lights[tile], s->is_disc ? &s->disc : NULL, NULL, s->x);
        s->checksum += s->x[0];
    }
}

int main(void)
{
    static const struct {
        const char *label, *name;
        double params[6];
    } CASES[] = {{"lambert", "lambert", {0.3}},
                 {"ward-gmd, alpha 0.2", "ward-gmd", {0.1, 0.3, 0.2, 0.2, NAN, NAN}},
                 {"ward-gmd, alpha 0.05", "ward-gmd", {0.1, 0.3, 0.05, 0.05, NAN, NAN}},
                 {"ward-gmd, alpha 0.01", "ward-gmd", {0.1, 0.3, 0.01, 0.01, NAN, NAN}},
                 {"ward-gmd, alpha 0.001", "ward-gmd", {0.1, 0.3, 0.001, 0.001, NAN, NAN}},
                 {"phong, n = 30", "phong", {0.1, 0.3, 30}},
                 {"cook-torrance, m 0.15", "cook-torrance", {0.1, 0.3, 0.15, 1.4, 7}},
                 {"abg", "abg", {0.05, 1e-4, 1e-4, 2.5}}};
    static const char *const MOTIONS[] = {"coherent", "incoherent"};
    double checksum = 0;
    printf("%-24s %-12s %10s %10s %7s\n", "material", "motion", "point M/s", "disc M/s", "cost");
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++)
        for (int motion = 0; motion < 2; motion++) {
            brdf_lobe lobe = {.model = brdf_model_named(CASES[c].name), .weight = 1};
            memcpy(lobe.params, CASES[c].params, sizeof CASES[c].params);
            if (brdf_lobe_prepare(&lobe, NULL)) fail(CASES[c].label);
            const brdf_material material = {1, &lobe};
            const model_material paint = {"paint", &material};
            const model_component part = {"body"};
            facet_list facets = {0};
            add_facets(&facets);
            scene *s[2];
            job jobs[2];
            for (int k = 0; k < 2; k++) {
                s[k] = aligned_alloc(64, (sizeof **s + 63) / 64 * 64);
                if (!s[k]) fail("no memory");
            }
            if (model_compile(&facets, &paint, 1, &part, 1, 1, &s[0]->model, NULL)) fail("model");
            for (int k = 0; k < 2; k++) {
                s[k]->model = s[0]->model;
                s[k]->is_disc = k == 1;
                s[k]->checksum = 0;
                fill_lights(s[k], motion == 0);
                source_disc_start(&s[k]->disc, false);
                for (int lane = 0; lane < BRDF_TILE; lane++)
                    source_disc_set(&s[k]->disc, lane, asin(SUN_RADIUS_M / AU_M));
                jobs[k] = (job){.run = run, .data = s[k]};
            }
            measure(jobs, 2, 5, 0.02);
            const double samples = (double)FACETS * TILES * BRDF_TILE * 1e-6;
            printf("%-24s %-12s %10.0f %10.0f %7.2f\n", CASES[c].label, MOTIONS[motion],
                   samples / jobs[0].least, samples / jobs[1].least, jobs[1].least / jobs[0].least);
            checksum += s[0]->checksum + s[1]->checksum;
            model_free(&s[0]->model);
            brdf_lobe_free(&lobe);
            free(s[0]);
            free(s[1]);
        }
    printf("checksum %.6g\n", checksum);
    return 0;
}
