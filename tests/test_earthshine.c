/* Earthshine through whole runs: what reaches the table, and that it is light beside the Sun's. */
#include "base/constants.h"
#include "base/vec.h"
#include "lightcurve/tile.h"
#include "scenario_text.h"

/* 24 h of a low orbit, seen from a station that never sets: all of the day and the umbra. */
static const char ORBIT_DAY[] =
    "[time]\nstart = 2025-07-25T00:00:00Z\nduration_s = 86400\nstep_s = 300\n";
static const char ANYWHERE[] =
    "[observer]\nlatitude_deg = 48.2\nlongitude_deg = 16.37\nmin_elevation_deg = -90\n";

static const char *settings_of(const char *ground)
{
    static char text[1024];
    snprintf(text, sizeof text,
             "[photometry]\nbands = [\"V\", \"B\"]\nearthshine = %s\n[output]\nshares = \"both\"\n",
             ground);
    return text;
}

static glint_scenario *scenario_of(const char *ground)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = ORBIT_DAY;
    parts[PART_OBSERVER] = ANYWHERE;
    return read_with(parts, PART_SETTINGS, settings_of(ground));
}

enum { MOST_ROWS = 400 };

typedef struct run {
    int n;
    double flux[MOST_ROWS][2], earth[MOST_ROWS][2], sunlit[MOST_ROWS], shares[MOST_ROWS];
    unsigned flags[MOST_ROWS];
    bool has_earth;
} run;

static run *run_of(const char *ground, int threads)
{
    run *out = calloc(1, sizeof *out);
    glint_scenario *s = scenario_of(ground);
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, threads, &curve, NULL), GLINT_OK);
    const glint_row *rows;
    size_t n;
    for (;;) {
        ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
        if (n == 0) break;
        for (size_t k = 0; k < n; k++, out->n++) {
            ck_assert_int_lt(out->n, MOST_ROWS);
            out->has_earth = rows[k].earthshine_flux_ratio != NULL;
            for (int b = 0; b < 2; b++) {
                out->flux[out->n][b] = rows[k].flux_ratio[b];
                if (out->has_earth) out->earth[out->n][b] = rows[k].earthshine_flux_ratio[b];
            }
            out->sunlit[out->n] = rows[k].sunlit_fraction;
            out->flags[out->n] = rows[k].flags;
            out->shares[out->n] = rows[k].share_material[0];
        }
    }
    glint_curve_close(curve);
    glint_scenario_free(s);
    return out;
}

START_TEST(test_earthshine_adds_to_sunlight)
{
    run *without = run_of("false", 1), *with = run_of("{ albedo = 0.3 }", 1);
    const double most = 0.5 * 1.74 * 0.3 / 3.14 / (780e3 * 780e3);
    int n_day = 0;
    ck_assert(!without->has_earth && with->has_earth);
    ck_assert_int_eq(with->n, without->n);
    for (int k = 0; k < with->n; k++) {
        const double earth = with->earth[k][0];
        assert_rel(with->flux[k][0], without->flux[k][0] + earth, 1e-14);
        ck_assert_int_eq(!!(with->flags[k] & GLINT_UMBRA), !!(without->flags[k] & GLINT_UMBRA));
        if (with->flux[k][0] > 0) assert_near(with->shares[k], 1, 1e-12);
        /* Where the limb hides the Sun, all ground in sight is dark: but for flattening. */
        if (!(with->sunlit[k] > 0)) ck_assert(earth < 1e-4 * most);
        /* no box of 1 m^2 sides, rho 0.5, shines by more: E < 0.3, 1.7 m^2 seen, 780 km */
        ck_assert(earth >= 0 && earth < 1.1 * most);
        n_day += earth > 0;
    }
    ck_assert_int_ge(n_day, 50);
    free(with);
    free(without);
}
END_TEST

/* A Lambertian ground by either name, twice as bright, and another in each band. */
START_TEST(test_earthshine_follows_the_ground)
{
    run *albedo = run_of("{ albedo = 0.3 }", 1);
    run *twice = run_of("{ brdf = \"lambert\", rho = 0.6 }", 1);
    run *spectrum =
        run_of("{ brdf = \"lambert\", rho = 0, spectrum = [ { wavelength_um = 0.4396, rho "
               "= 0.6 }, { wavelength_um = 0.5511, rho = 0.3 } ] }",
               1);
    for (int k = 0; k < albedo->n; k++) {
        assert_rel(twice->earth[k][0], 2 * albedo->earth[k][0], 1e-13);
        assert_rel(spectrum->earth[k][0], albedo->earth[k][0], 1e-13);
        assert_rel(spectrum->earth[k][1], twice->earth[k][1], 1e-13);
    }
    free(albedo);
    free(twice);
    free(spectrum);
}
END_TEST

START_TEST(test_earthshine_is_the_same_on_any_number_of_threads)
{
    run *one = run_of("{ brdf = \"phong\", rho_d = 0.53, rho_s = 0.28, n = 7.31 }", 1);
    run *three = run_of("{ brdf = \"phong\", rho_d = 0.53, rho_s = 0.28, n = 7.31 }", 3);
    ck_assert_mem_eq(one, three, sizeof *one);
    free(one);
    free(three);
}
END_TEST

/* 1e-4 of the brightest row: rings by hand against the rings that are chosen. */
START_TEST(test_earthshine_converges_with_rings)
{
    run *chosen = run_of("{ albedo = 0.3 }", 0), *fine = run_of("{ albedo = 0.3, rings = 80 }", 0);
    double most = 0;
    for (int k = 0; k < fine->n; k++)
        most = fmax(most, fine->earth[k][0]);
    for (int k = 0; k < fine->n; k++)
        assert_near(chosen->earth[k][0], fine->earth[k][0], 1e-4 * most);
    free(chosen);
    free(fine);
}
END_TEST

/* --- through the satellite's own shadows --- */

/* A white plate of 4 m x 4 m that faces the Earth, and 5 m below it a black one that reaches from
 * cover_from_m on along x, and far on all other sides; the observer looks from the side, past both
 * edges. It is the geostationary orbit, from which the Earth is 17 deg wide, and a forenoon. */
#define COVER_M 5.0
static glint_scenario *covered_plate(double cover_from_m, const char *shadows)
{
    static char text[2048];
    const char *parts[N_PARTS] = {
        [PART_TIME] = "[time]\nstart = 2025-03-20T08:00:00Z\nduration_s = 21600\nstep_s = 2700\n",
        [PART_OBSERVER] = "[observer.direction]\nframe = \"body\"\nrange_km = 1000\n"
                          "vector = [-0.8660254037844386, 0, 0.5]\n",
        [PART_ORBIT] = "[orbit]\ncircular = { geostationary_longitude_deg = 0 }\n",
        [PART_ATTITUDE] = "[attitude]\nlaw = \"nadir\"\n",
        [PART_SETTINGS] = "[photometry]\nearthshine = { albedo = 0.3 }\n",
        [PART_SATELLITE] = shadows,
        [PART_MATERIAL] = "[materials.white]\nbrdf = \"lambert\"\nrho = 0.5\n"
                          "[materials.black]\nbrdf = \"lambert\"\nrho = 0\n",
        [PART_COMPONENT] = "[[component]]\nname = \"bus\"\n"};
    snprintf(text, sizeof text,
             "[[component.plate]]\nsize_m = [4, 4]\nnormal = [0, 0, 1]\ntangent = [1, 0, 0]\n"
             "material = \"white\"\n"
             "[[component.plate]]\nsize_m = [20, 20]\ncentre_m = [%.17g, 0, %.17g]\n"
             "normal = [0, 0, 1]\ntangent = [1, 0, 0]\nmaterial = \"black\"\n",
             cover_from_m + 10, COVER_M);
    return read_with(parts, PART_PRIMITIVE, text);
}

/* Part of the white plate that light from direction `to` (body) reaches past the cover. */
static double open_part(const double to[3], double cover_from_m)
{
    const double edge = cover_from_m - COVER_M * to[0] / to[2]; /* its shadow begins here */
    return fmin(fmax((edge + 2) / 4, 0), 1);
}

/* Light of the Earth by way of the white plate, as X times irradiance over that at 1 au, summed
 * over a mesh of the ground of a sphere: nothing of rings, centres or visibility in it. */
static double sum_over_ground(const tile_geometry *t, int lane, const double body[9],
                              double cover_from_m)
{
    enum { N = 500 };
    double up[3], sun[3], e1[3], e2[3], total = 0;
    const double far = unit3(t->satellite_m[lane], up) / EARTH_RADIUS_M;
    add_scaled3(t->satellite_m[lane], t->sun_distance_m[lane], t->sun[lane], sun);
    const double irradiance = pow(AU_M / unit3(sun, sun), 2), limb = 1 / far;
    const double other[3] = {0.3, -0.7, 0.2}, observer[3] = {-0.8660254037844386, 0, 0.5};
    perp3(other, up, e1);
    cross3(up, e1, e2);
    for (int a = 0; a < N; a++)
        for (int b = 0; b < N; b++) {
            const double c = 1 - (1 - limb) * (a + 0.5) / N, s = sqrt(1 - c * c);
            const double azimuth = TWO_PI * (b + 0.5) / N;
            double n[3], way[3], to[3];
            for (int j = 0; j < 3; j++) {
                n[j] = c * up[j] + s * (cos(azimuth) * e1[j] + sin(azimuth) * e2[j]);
                way[j] = n[j] - far * up[j];
            }
            const double d = unit3(way, way), out = -dot3(way, n), in = dot3(n, sun);
            if (!(in > 0 && out > 0)) continue;
            const double patch = TWO_PI * (1 - limb) / N / N; /* of ground, radii^2 */
            mat_vec(body, way, to);
            if (to[2] > 0)
                total += 0.3 / PI * in * irradiance * patch * out / (d * d) * 0.5 / PI * to[2] *
                         observer[2] * 16 * open_part(to, cover_from_m);
        }
    return total;
}

/* The sum of all spans for each of the rows, by the program and by the mesh of the ground. */
static int sums_of(glint_scenario *s, double cover_from_m, double got[TILE], double want[TILE])
{
    const earth_orientation still = {0, 0};
    visibility *plan;
    tile_worker w;
    frame_grid *grid = NULL;
    bool any;
    const int n = (int)s->n_steps;
    ck_assert_int_le(n, TILE);
    ck_assert_int_eq(tile_plan_shadows(s, &plan, NULL), GLINT_OK);
    ck_assert_int_eq(tile_worker_make(s, plan, &w, NULL), GLINT_OK);
    w.geometry.viewer.observer = s->observers;
    ck_assert_int_eq(
        frame_grid_prepare(&s->clock, &still, 0, n * s->step_s, s->step_s, &grid, NULL), GLINT_OK);
    ck_assert_int_eq(geometry_fill(s, grid, 0, 0, n, &w.geometry, &w.tile, w.lights, NULL),
                     GLINT_OK);
    ck_assert_int_eq(
        earthshine_fill(s, plan, w.scratch, &w.geometry, &w.tile, w.lights, &w.earth, &any, NULL),
        GLINT_OK);
    ck_assert(any);
    for (int k = 0; k < n; k++) {
        double body[9];
        mat_transpose(w.geometry.poses[k].body_component, body);
        got[k] = 0;
        for (int span = 0; span < s->satellite.model.n_spans; span++)
            got[k] += w.earth.x[span * TILE + k];
        want[k] = sum_over_ground(&w.tile, k, body, cover_from_m);
    }
    frame_grid_free(grid);
    tile_worker_free(&w);
    visibility_free(plan);
    glint_scenario_free(s);
    return n;
}

/* A cover past which no ground is seen leaves nothing; without shadows all is there, and one that
 * covers nothing changes nothing. */
START_TEST(test_earthshine_is_covered_by_the_satellites_own_parts)
{
    double got[TILE], want[TILE], open[TILE];
    int n = sums_of(covered_plate(-5, ""), -5, got, want);
    ck_assert_int_eq(n, 9);
    for (int k = 0; k < n; k++)
        ck_assert_msg(got[k] == 0 && want[k] == 0, "row %d: %g and %g", k, got[k], want[k]);
    sums_of(covered_plate(-5, "[satellite]\nself_shadows = \"none\"\n"), 1e3, open, want);
    for (int k = 0; k < n; k++)
        assert_rel(open[k], want[k], 1e-3); /* the mesh is off by as much at the terminator */
    sums_of(covered_plate(3, ""), 1e3, got, want);
    for (int k = 0; k < n; k++)
        assert_rel(got[k], open[k], 1e-14);
}
END_TEST

/* What one direction stands for is right where the covered part changes evenly with the direction:
 * here over all of the Earth. */
START_TEST(test_earthshine_past_an_edge_is_that_of_its_mean_direction)
{
    double got[TILE], want[TILE];
    const int n = sums_of(covered_plate(0.25, ""), 0.25, got, want);
    for (int k = 0; k < n; k++)
        assert_rel(got[k], want[k], 2e-3);
}
END_TEST

START_TEST(test_earthshine_is_refused_where_directions_are_given)
{
    static const wrong_text WRONG[] = {
        {PART_SETTINGS, "[photometry]\nearthshine = @{ albedo = 0.3 }\n",
         "do not say where the Earth is", "earthshine = false", 0},
    };
    ASSERT_ALL_WRONG(GIVEN, WRONG);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("earthshine");
    TCase *c = tcase_create("earthshine");
    tcase_set_timeout(c, 300);
    tcase_add_checked_fixture(c, folder_make, folder_remove);
    tcase_add_test(c, test_earthshine_adds_to_sunlight);
    tcase_add_test(c, test_earthshine_follows_the_ground);
    tcase_add_test(c, test_earthshine_is_the_same_on_any_number_of_threads);
    tcase_add_test(c, test_earthshine_converges_with_rings);
    tcase_add_test(c, test_earthshine_is_covered_by_the_satellites_own_parts);
    tcase_add_test(c, test_earthshine_past_an_edge_is_that_of_its_mean_direction);
    tcase_add_test(c, test_earthshine_is_refused_where_directions_are_given);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
