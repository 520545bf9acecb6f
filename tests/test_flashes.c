/* Flashes of surfaces that turn steadily, from one turn in 100 s to 20 in one: where the turn is
 * known in closed form, so are the flashes. The search must find them all, say where it stops, and
 * end in time. */
#include "base/constants.h"
#include "base/roots.h"
#include "base/vec.h"
#include "orbit/frames.h"
#include "scenario/scenario.h"
#include "scenario_text.h"

/* ------------------------------------------------------------------ the sky */

static const char OBSERVER[] =
    "[observer]\nlatitude_deg = 48.2\nlongitude_deg = 16.37\nheight_m = 200\n";
static const char GEO[] = "[orbit]\ncircular = { geostationary_longitude_deg = 19.2 }\n";
static const char LEO[] = "[orbit]\ncircular = { height_km = 780, inclination_deg = 98.6, "
                          "raan_deg = 80, argument_of_latitude_deg = 132 }\n";

/* Where Sun and observer stand, in rows of equal step; light time in s. */
typedef struct sky {
    double step_s;
    size_t n;
    double (*sun)[3], (*observer)[3], *light_s; /* owned */
} sky;

static glint_scenario *read_text(const char *const parts[N_PARTS])
{
    const marked_text m = with_part(parts, PART_TOP, "");
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    ck_assert_msg(glint_scenario_read_orbit(write_file("flashes.toml", m.text), NULL, 0, &s,
                                            errors) == GLINT_OK,
                  "%s", list_errors(errors));
    glint_errors_free(errors);
    return s;
}

/* The Sun's direction when the light left the satellite. */
static void find_sun(const glint_scenario *s, const frame_grid *grid,
                     const glint_ephemeris_row *row, double sun[3])
{
    double distance_m;
    frame_set frames;
    frame_grid_at(grid, row->t_s - row->range_m / LIGHT_SPEED_M_S, FRAMES_SUN, &frames);
    sun_from_point(&frames, row->r_gcrs_m, s->aberration, sun, &distance_m);
}

static sky look_up(const char *const parts[N_PARTS])
{
    const char *orbit_only[N_PARTS] = {[PART_TIME] = parts[PART_TIME],
                                       [PART_OBSERVER] = parts[PART_OBSERVER],
                                       [PART_ORBIT] = parts[PART_ORBIT]};
    glint_scenario *s = read_text(orbit_only);
    sky out = {.step_s = s->step_s};
    const size_t most = (size_t)s->n_steps;
    out.sun = calloc(most, sizeof *out.sun);
    out.observer = calloc(most, sizeof *out.observer);
    out.light_s = calloc(most, sizeof *out.light_s);
    frame_grid *grid = NULL;
    const earth_orientation still = {0, 0};
    ck_assert_int_eq(frame_grid_prepare(&s->clock, &still, 0, s->span_s, 1, &grid, NULL), GLINT_OK);
    glint_ephemeris *e;
    const glint_ephemeris_row *rows;
    size_t n;
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
    while (glint_ephemeris_next(e, &rows, &n, NULL) == GLINT_OK && n > 0)
        for (size_t k = 0; k < n; k++, out.n++) {
            const glint_ephemeris_row *row = &rows[k];
            find_sun(s, grid, row, out.sun[out.n]);
            out.observer[out.n][0] = -cos(row->dec_rad) * cos(row->ra_rad);
            out.observer[out.n][1] = -cos(row->dec_rad) * sin(row->ra_rad);
            out.observer[out.n][2] = -sin(row->dec_rad);
            out.light_s[out.n] = row->range_m / LIGHT_SPEED_M_S;
        }
    glint_ephemeris_close(e);
    frame_grid_free(grid);
    glint_scenario_free(s);
    return out;
}

static void sky_free(sky *s)
{
    free(s->sun);
    free(s->observer);
    free(s->light_s);
}

/* Straight between rows. */
static void sky_at(const sky *s, double t_s, double sun[3], double observer[3], double *light_s)
{
    const double at = fmin(fmax(t_s / s->step_s, 0), (double)(s->n - 1) - 1e-9), u = at - floor(at);
    const size_t k = (size_t)at;
    for (int i = 0; i < 3; i++) {
        sun[i] = s->sun[k][i] + u * (s->sun[k + 1][i] - s->sun[k][i]);
        observer[i] = s->observer[k][i] + u * (s->observer[k + 1][i] - s->observer[k][i]);
    }
    unit3(sun, sun);
    unit3(observer, observer);
    *light_s = s->light_s[k] + u * (s->light_s[k + 1] - s->light_s[k]);
}

/* Midway between Sun and observer. */
static void middle_at(const sky *s, double t_s, double out[3])
{
    double sun[3], observer[3], light_s;
    sky_at(s, t_s, sun, observer, &light_s);
    add3(sun, observer, out);
    unit3(out, out);
}

/* ---------------------------------------------------------- the closed form */

/* A normal that circles about a pole: n = cosine pole + sine (e1 cos(rate t) + e2 sin(rate t)), t
 * the time at the satellite. */
typedef struct spinner {
    const sky *sky;
    double pole[3], e1[3], e2[3];
    double cosine, sine, rate_rad_s;
} spinner;

static glint_status exact_angle(void *context, double t_s, double *y, glint_error *error)
{
    (void)error;
    const spinner *s = context;
    double sun[3], observer[3], light_s, n[3], mirrored[3];
    sky_at(s->sky, t_s, sun, observer, &light_s);
    const double phase = s->rate_rad_s * (t_s - light_s);
    for (int i = 0; i < 3; i++)
        n[i] = s->cosine * s->pole[i] + s->sine * (cos(phase) * s->e1[i] + sin(phase) * s->e2[i]);
    const double c = dot3(n, sun);
    for (int i = 0; i < 3; i++)
        mirrored[i] = 2 * c * n[i] - sun[i];
    *y = c > 0 && dot3(n, observer) > 0 ? angle3(mirrored, observer) : PI;
    return GLINT_OK;
}

/* When the normal passes the middle between Sun and observer for the turn k: phase = azimuth. */
static double exact_passage(const spinner *s, long k)
{
    double t_s = TWO_PI * (double)k / s->rate_rad_s;
    for (int round = 0; round < 50; round++) {
        double middle[3], sun[3], observer[3], light_s;
        middle_at(s->sky, t_s, middle);
        sky_at(s->sky, t_s, sun, observer, &light_s);
        double azimuth = atan2(dot3(middle, s->e2), dot3(middle, s->e1));
        t_s = light_s + (azimuth + TWO_PI * (double)k) / s->rate_rad_s;
    }
    return t_s;
}

typedef struct exact_flash {
    double t_s, angle, duration_s;
} exact_flash;

/* All flashes with their whole turn inside 0 .. end_s, at most `most`. */
static size_t exact_flashes(spinner *s, double limit, double end_s, exact_flash *out, size_t most)
{
    const double period_s = TWO_PI / s->rate_rad_s;
    size_t n = 0;
    /* light that arrives at 0 left up to 0.15 s earlier: three turns */
    for (long k = -5; n < most; k++) {
        const double t_s = exact_passage(s, k), reach_s = 0.2 * period_s;
        double angle, peak_s, ends_s[2];
        if (t_s < 0.5 * period_s) continue;
        if (t_s > end_s - 0.5 * period_s) break;
        minimum_find(exact_angle, s, t_s - reach_s, t_s + reach_s, 1e-9, &peak_s, &angle, NULL);
        if (angle > limit) continue;
        for (int side = 0; side < 2; side++) { /* bisection */
            double in_s = peak_s, out_s = peak_s + (side ? 0.3 : -0.3) * period_s, y;
            while (fabs(out_s - in_s) > 1e-9) {
                const double mid_s = 0.5 * (in_s + out_s);
                exact_angle(s, mid_s, &y, NULL);
                *(y <= limit ? &in_s : &out_s) = mid_s;
            }
            ends_s[side] = in_s;
        }
        out[n++] = (exact_flash){peak_s, angle, ends_s[1] - ends_s[0]};
    }
    return n;
}

/* ------------------------------------------------------------------ the cases */

typedef enum drive { BY_SPIN, BY_HINGE } drive;

typedef struct flash_case {
    const char *orbit;
    drive drive;
    double rate_hz, duration_s, row_s, limit_deg;
    double from_axis_deg; /* the normal, from the axis of the turn */
} flash_case;

/* A pole that the middle between Sun and observer stands at that angle from, half-way through. */
static void choose_pole(const sky *s, const flash_case *c, spinner *out)
{
    static const double SIDE[3] = {0.3, -0.5, 0.8}, north[3] = {0, 0, 1};
    double middle[3], across[3];
    middle_at(s, 0.5 * c->duration_s, middle);
    perp3(SIDE, middle, across);
    const double angle = c->from_axis_deg * DEG;
    for (int i = 0; i < 3; i++)
        out->pole[i] = cos(angle) * middle[i] + sin(angle) * across[i];
    perp3(north, out->pole, out->e1); /* where the law of spin begins */
    cross3(out->pole, out->e1, out->e2);
    out->sky = s;
    out->cosine = cos(angle);
    out->sine = sin(angle);
    out->rate_rad_s = TWO_PI * c->rate_hz;
}

static const char SHINY[] = "[materials.shiny]\nbrdf = \"ward-gmd\"\nrho_d = 0.1\nrho_s = 0.5\n"
                            "alpha_x = 0.02\nalpha_y = 0.02\n";

/* The texts of a satellite whose plate's normal turns as the spinner says. */
static void describe(const flash_case *c, const spinner *s, char turn[512], char parts[1024])
{
    const double rate_deg_s = 360 * c->rate_hz;
    if (c->drive == BY_SPIN) {
        snprintf(turn, 512,
                 "[attitude]\nlaw = \"spin\"\nbody_axis = [0, 0, 1]\npole = { ra_deg = %.17g, "
                 "dec_deg = %.17g }\nrate_deg_s = %.17g\n",
                 atan2(s->pole[1], s->pole[0]) / DEG, asin(s->pole[2]) / DEG, rate_deg_s);
        snprintf(parts, 1024,
                 "[[component]]\nname = \"bus\"\n[[component.plate]]\nsize_m = [1, 1]\n"
                 "normal = [%.17g, 0, %.17g]\ntangent = [0, 1, 0]\nmaterial = \"shiny\"\n",
                 s->sine, s->cosine);
        return;
    }
    snprintf(turn, 512, "[attitude]\nlaw = \"inertial\"\nquaternion_wxyz = [1, 0, 0, 0]\n");
    double n[3];
    for (int i = 0; i < 3; i++)
        n[i] = s->cosine * s->pole[i] + s->sine * s->e1[i];
    snprintf(parts, 1024,
             "[[component]]\nname = \"bus\"\n[[component]]\nname = \"mirror\"\nparent = \"bus\"\n"
             "hinge = { origin_m = [0, 0, 0], axis = [%.17g, %.17g, %.17g], rate_deg_s = %.17g, "
             "angle_deg = 0 }\n[[component.plate]]\nsize_m = [1, 1]\nnormal = [%.17g, %.17g, "
             "%.17g]\ntangent = [%.17g, %.17g, %.17g]\nmaterial = \"shiny\"\n",
             s->pole[0], s->pole[1], s->pole[2], rate_deg_s, n[0], n[1], n[2], s->e2[0], s->e2[1],
             s->e2[2]);
}

static glint_passes *find(const glint_scenario *s, double limit_deg)
{
    const glint_pass_options options = {limit_deg * DEG, 1};
    glint_passes *passes;
    glint_error error;
    ck_assert_msg(glint_passes_find(s, &options, &passes, &error) == GLINT_OK, "%s", error.message);
    return passes;
}

/* Holds one flash against the exact one. */
static void check_flash(const glint_pass_event *e, const exact_flash *want)
{
    /* s: what the search promises, and rows interpolated to 1e-7 rad on the side of the test */
    assert_near(e->t_s, want->t_s, 5e-6);
    /* rad: the peak is found to 1e-6 rad of the turn or 1e-6 s, and mirroring doubles that */
    assert_near(e->mirror_angle_rad, want->angle, 4e-6);
    assert_near(e->to_s - e->from_s, want->duration_s, 2e-5);
}

static void check_case(const flash_case *c)
{
    enum { MOST = 1200, KEPT = 1000 };
    static exact_flash want[MOST];
    char time[256], turn[512], plate[1024];
    snprintf(time, sizeof time,
             "[time]\nstart = 2025-07-25T20:35:00Z\nduration_s = %.17g\nstep_s = %.17g\n",
             c->duration_s, c->row_s);
    const char *parts[N_PARTS] = {
        [PART_TIME] = time, [PART_OBSERVER] = OBSERVER, [PART_ORBIT] = c->orbit};
    sky around = look_up(parts);
    spinner turning;
    choose_pole(&around, c, &turning);
    describe(c, &turning, turn, plate);
    parts[PART_ATTITUDE] = turn;
    parts[PART_MATERIAL] = SHINY;
    parts[PART_COMPONENT] = plate;
    glint_scenario *s = read_text(parts);
    glint_passes *passes = find(s, c->limit_deg);
    ck_assert_uint_eq(glint_passes_count(passes), 1);
    const glint_pass *pass = glint_passes_get(passes, 0);
    const double half_s = 0.5 / c->rate_hz;
    const size_t n = exact_flashes(&turning, c->limit_deg * DEG, c->duration_s, want, MOST);
    size_t at = 0, found = 0;
    double stopped_s = HUGE_VAL;
    for (size_t k = 0; k < pass->n_events; k++) {
        const glint_pass_event *e = &pass->events[k];
        if (e->kind == GLINT_MORE_FLASHES) stopped_s = e->t_s;
        if (e->kind != GLINT_FLASH) continue;
        found++;
        if (e->t_s < half_s || e->t_s > c->duration_s - half_s) continue;
        while (at < n && want[at].t_s < half_s + 1e-5) /* either side of the edge by rounding */
            at++;
        ck_assert_msg(at < n, "%g Hz: a flash at %g s that must not be", c->rate_hz, e->t_s);
        check_flash(e, &want[at++]);
    }
    ck_assert_uint_ge(found, 1);
    ck_assert_int_eq(pass->more_flashes, stopped_s < HUGE_VAL);
    if (pass->more_flashes) {
        ck_assert_uint_le(found, KEPT);
        ck_assert_uint_ge(found, KEPT - 3); /* the last may be left open */
        ck_assert_uint_lt(at, n);
        ck_assert(want[at - 1].t_s <= stopped_s + 1e-5 && stopped_s <= want[at + 2].t_s);
    } else {
        ck_assert_msg(at == n, "%g Hz: %zu flashes, expected %zu", c->rate_hz, at, n);
    }
    glint_passes_free(passes);
    glint_scenario_free(s);
    sky_free(&around);
}

START_TEST(test_flashes_of_a_spinning_plate_are_where_the_phase_says)
{
    static const flash_case CASES[] = {
        {GEO, BY_SPIN, 0.01, 1200, 1, 1, 90},  {GEO, BY_SPIN, 0.1, 300, 1, 1, 90},
        {GEO, BY_SPIN, 1, 200, 1, 0.1, 90},    {GEO, BY_SPIN, 3, 300, 1, 1, 60},
        {GEO, BY_SPIN, 10, 300, 1, 1, 90},     {GEO, BY_SPIN, 20, 30, 1, 3, 25},
        {GEO, BY_SPIN, 20, 300, 1, 1, 90},     {LEO, BY_SPIN, 0.03, 300, 0.01, 3, 90},
        {LEO, BY_SPIN, 0.1, 200, 0.01, 3, 90}, {LEO, BY_SPIN, 5, 200, 0.01, 1, 90},
        {LEO, BY_SPIN, 20, 100, 0.01, 1, 60},
    };
    for (size_t k = 0; k < COUNT_OF(CASES); k++)
        check_case(&CASES[k]);
}
END_TEST

START_TEST(test_flashes_of_a_turning_hinge_are_where_the_phase_says)
{
    static const flash_case CASES[] = {
        {GEO, BY_HINGE, 0.02, 600, 1, 1, 90},
        {GEO, BY_HINGE, 2, 100, 1, 1, 40},
        {LEO, BY_HINGE, 12, 100, 0.01, 1, 90},
    };
    for (size_t k = 0; k < COUNT_OF(CASES); k++)
        check_case(&CASES[k]);
}
END_TEST

/* ------------------------------------------------------------- bounded work */

static const char PLATE[] = "[[component]]\nname = \"bus\"\n[[component.plate]]\nsize_m = [1, 1]\n"
                            "normal = [0.1736, 0, 0.9848]\ntangent = [0, 1, 0]\n"
                            "material = \"shiny\"\n";

static const glint_pass *only_pass(const glint_passes *passes)
{
    ck_assert_uint_eq(glint_passes_count(passes), 1);
    return glint_passes_get(passes, 0);
}

static size_t count_flashes(const glint_pass *pass)
{
    size_t n = 0;
    for (size_t k = 0; k < pass->n_events; k++)
        n += pass->events[k].kind == GLINT_FLASH;
    return n;
}

/* The normal stays within 10 deg of the zenith, and Vienna within 9 deg of the nadir: the plate is
 * never seen. 630 million turns are passed over. */
START_TEST(test_flashes_that_cannot_be_are_not_sought_turn_by_turn)
{
    static const char *const PARTS[N_PARTS] = {
        [PART_TIME] = "[time]\nstart = 2025-01-01T00:00:00Z\nduration_s = 3.15e7\n"
                      "step_s = 3600\n",
        [PART_OBSERVER] = OBSERVER,
        [PART_ORBIT] = GEO,
        [PART_ATTITUDE] = "[attitude]\nlaw = \"spin\"\nbody_axis = [0, 0, 1]\npole = \"zenith\"\n"
                          "period_s = 0.05\n",
        [PART_MATERIAL] = SHINY,
        [PART_COMPONENT] = PLATE,
    };
    glint_scenario *s = read_text(PARTS);
    glint_passes *passes = find(s, 1);
    ck_assert_uint_eq(count_flashes(only_pass(passes)), 0);
    ck_assert(!only_pass(passes)->more_flashes);
    glint_passes_free(passes);
    glint_scenario_free(s);
}
END_TEST

/* Ten tumbles a second have no period to search by, and for a year too many looks: the search says
 * where it stopped. */
START_TEST(test_flashes_of_a_fast_tumbling_body_stop_with_a_word)
{
    static const char *const PARTS[N_PARTS] = {
        [PART_TIME] = "[time]\nstart = 2025-01-01T00:00:00Z\nduration_s = 1e6\n"
                      "step_s = 3600\n",
        [PART_OBSERVER] = OBSERVER,
        [PART_ORBIT] = GEO,
        [PART_ATTITUDE] = "[attitude]\nlaw = \"torque-free\"\ninertia_kg_m2 = [3, 4, 5]\n"
                          "rates_deg_s = [3000, 100, 500]\nquaternion_wxyz = [1, 0, 0, 0]\n",
        [PART_MATERIAL] = SHINY,
        [PART_COMPONENT] = PLATE,
    };
    glint_scenario *s = read_text(PARTS);
    glint_passes *passes = find(s, 0.001);
    const glint_pass *pass = only_pass(passes);
    ck_assert(pass->more_flashes);
    double stopped_s = HUGE_VAL;
    for (size_t k = 0; k < pass->n_events; k++)
        if (pass->events[k].kind == GLINT_MORE_FLASHES) stopped_s = pass->events[k].t_s;
    ck_assert(stopped_s > 0 && stopped_s < 1e6);
    for (size_t k = 0; k < pass->n_events; k++)
        if (pass->events[k].kind == GLINT_FLASH)
            ck_assert_double_le(pass->events[k].t_s, stopped_s);
    glint_passes_free(passes);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_flashes_refuse_angles_out_of_range)
{
    static const double WRONG_DEG[] = {9e-4, 90.1, -1, NAN, INFINITY};
    static const double RIGHT_DEG[] = {1e-3, 90};
    const char *parts[N_PARTS] = {
        [PART_TIME] = SOUND[PART_TIME], [PART_OBSERVER] = OBSERVER, [PART_ORBIT] = GEO};
    glint_scenario *s = read_text(parts);
    for (size_t k = 0; k < COUNT_OF(WRONG_DEG); k++) {
        glint_passes *passes;
        glint_error error = {0};
        const glint_pass_options options = {WRONG_DEG[k] * DEG, 1};
        ck_assert_int_eq(glint_passes_find(s, &options, &passes, &error), GLINT_ARGUMENT);
        ck_assert(strstr(error.message, "0.001 to 90") != NULL);
    }
    for (size_t k = 0; k < COUNT_OF(RIGHT_DEG); k++)
        glint_passes_free(find(s, RIGHT_DEG[k]));
    glint_scenario_free(s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("flashes");
    TCase *tc = tcase_create("flashes");
    tcase_add_checked_fixture(tc, folder_make, folder_remove);
    tcase_set_timeout(tc, 300);
    tcase_add_test(tc, test_flashes_of_a_spinning_plate_are_where_the_phase_says);
    tcase_add_test(tc, test_flashes_of_a_turning_hinge_are_where_the_phase_says);
    tcase_add_test(tc, test_flashes_that_cannot_be_are_not_sought_turn_by_turn);
    tcase_add_test(tc, test_flashes_of_a_fast_tumbling_body_stop_with_a_word);
    tcase_add_test(tc, test_flashes_refuse_angles_out_of_range);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
