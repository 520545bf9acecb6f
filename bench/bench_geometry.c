/* bench_geometry.c: what the geometry of one step costs: light time, orbit, frames, Sun, site,
 * eclipse, attitude, hinges; on one core, without the sum over facets and without output.
 *
 * usage: bench_geometry [NUMBER]     one case alone, counted from 1, as for a profiler
 * Prints a table: nanoseconds a step. */
#include "timing.h"

#include "lightcurve/geometry.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 4096 };
enum { ROUNDS = 9 };
static const double AT_LEAST_S = 0.03; /* of each measurement */

#define TIME "time={start=2025-07-24T19:10:00Z, duration_s=4095, step_s=1}"
#define RIGID "satellite.model=\"" SCENARIO_DIR "/models/flat-satellite.toml\""
#define CIRCULAR                                                                                   \
    "orbit={circular={height_km=420, inclination_deg=51.6, raan_deg=120, "                         \
    "argument_of_latitude_deg=0}}"
#define GEOSTATIONARY "orbit={circular={geostationary_longitude_deg=10}}"
/* A geostationary satellite as a made-up element set: resonant, the dearest case of SGP4. */
#define DEEP_SPACE                                                                                 \
    "orbit={tle_lines=["                                                                           \
    "\"1 90001U 24001A   25205.00000000 -.00000100  00000-0  00000+0 0  9992\","                   \
    "\"2 90001   0.0400  80.0000 0002000 120.0000 262.0000  1.00271000    11\"]}"

typedef struct geometry_case {
    const char *name;
    const char *overrides[4]; /* of scenarios/iss-vienna.toml; NULL ends them */
} geometry_case;

static const geometry_case CASES[] = {
    {"Kepler with J2", {TIME, RIGID, CIRCULAR}},
    {"Kepler with J2, without light time", {TIME, RIGID, CIRCULAR, "corrections.light_time=false"}},
    {"geostationary point", {TIME, RIGID, GEOSTATIONARY}},
    {"SGP4 near the Earth", {TIME, RIGID}},
    {"SGP4 near the Earth, without light time", {TIME, RIGID, "corrections.light_time=false"}},
    {"SGP4 deep space, resonant", {TIME, RIGID, DEEP_SPACE}},
    {"Kepler with J2, two tracking hinges", {TIME, CIRCULAR}},
    {"SGP4 near the Earth, two tracking hinges", {TIME}},
};
enum { N_CASES = sizeof CASES / sizeof *CASES };

typedef struct setup {
    glint_scenario *scenario; /* owned */
    frame_grid *grid;         /* owned */
    geometry_worker worker;   /* owns component_gcrs */
    tile_geometry tile;
    brdf_light *lights; /* owned */
} setup;

static void fail(const char *name, const glint_errors *errors, const char *message)
{
    const glint_error *first = glint_errors_get(errors, 0);
    fprintf(stderr, "bench_geometry: %s: %s\n", name, first ? first->message : message);
    exit(1);
}

static void prepare(const geometry_case *c, setup *s)
{
    size_t n = 0;
    while (n < 4 && c->overrides[n])
        n++;
    glint_errors *errors = glint_errors_new();
    if (glint_scenario_read(SCENARIO_DIR "/iss-vienna.toml", c->overrides, n, &s->scenario, errors))
        fail(c->name, errors, "");
    const earth_orientation still = {0, 0};
    glint_error error = {0};
    if (s->scenario->n_steps != STEPS) fail(c->name, NULL, "another number of steps");
    if (frame_grid_prepare(&s->scenario->clock, &still, 0, STEPS - 1, 1, &s->grid, &error))
        fail(c->name, NULL, error.message);
    const size_t n_components = (size_t)s->scenario->satellite.n_components;
    s->lights = aligned_alloc(64, n_components * sizeof *s->lights);
    s->worker.viewer.observer = s->scenario->observers;
    s->worker.component_gcrs = calloc(n_components, sizeof *s->worker.component_gcrs);
    if (!s->lights || !s->worker.component_gcrs) fail(c->name, NULL, "out of memory");
    memset(s->lights, 0, n_components * sizeof *s->lights);
    glint_errors_free(errors);
}

static void release(setup *s)
{
    glint_scenario_free(s->scenario);
    frame_grid_free(s->grid);
    free(s->worker.component_gcrs);
    free(s->lights);
}

static void run_geometry(void *data)
{
    setup *s = data;
    glint_error error = {0};
    for (int64_t first = 0; first < STEPS; first += TILE)
        if (geometry_fill(s->scenario, s->grid, 0, first, TILE, &s->worker, &s->tile, s->lights,
                          &error))
            fail("geometry_fill", NULL, error.message);
}

int main(int argc, char **argv)
{
    const int only = argc > 1 ? atoi(argv[1]) : 0;
    setup setups[N_CASES] = {0};
    job jobs[N_CASES];
    const char *names[N_CASES];
    int n = 0;
    for (int c = 0; c < N_CASES; c++) {
        if (argc > 1 && c + 1 != only) continue;
        prepare(&CASES[c], &setups[n]);
        names[n] = CASES[c].name;
        jobs[n] = (job){.run = run_geometry, .data = &setups[n]};
        n++;
    }
    if (n == 0) {
        fprintf(stderr, "usage: bench_geometry [NUMBER], a number from 1 to %d\n", N_CASES);
        return 2;
    }
    measure(jobs, n, ROUNDS, AT_LEAST_S);
    printf("ns a step  of a satellite with nadir attitude, seen from a site\n");
    for (int j = 0; j < n; j++) {
        printf("%9.0f  %s\n", jobs[j].least / STEPS * 1e9, names[j]);
        release(&setups[j]);
    }
    return 0;
}
