/* Light averaged over exposures: flashes against closed forms, however short they are; diffuse
 * light; sums of exposures; threads; errors. */
#include "base/constants.h"
#include "run_rows.h"

/* --------------------------------------------------------------- a mirror */

/* The Sun and the observer stay in the body's xz plane, in which a mirror's normal turns about y:
 * its image of the Sun crosses the observer through the middle of the disc once a turn. */
#define MIRROR_SECONDS 30
#define MIRROR_AREA_M2 2.0
#define MIRROR_REFLECTS 0.8
#define MIRROR_TURNS_DEG_S 40.0
static const char *const MIRROR[N_PARTS] = {
    [PART_OBSERVER] = "[observer]\nlatitude_deg = 48.2\nlongitude_deg = 16.37\n",
    [PART_ORBIT] = "[orbit]\ncircular = { height_km = 780, inclination_deg = 98.6, raan_deg = 80, "
                   "argument_of_latitude_deg = 132 }\n",
    [PART_ATTITUDE] = "[attitude]\nlaw = \"sun-pointing\"\naxis = [0, 0, 1]\n"
                      "second_axis = [1, 0, 0]\nsecond_to = \"observer\"\n",
    [PART_MATERIAL] = "[materials.mirror]\nbrdf = \"mirror\"\nR = 0.8\n",
    [PART_COMPONENT] = "[[component]]\nname = \"panel\"\nhinge = { origin_m = [0, 0, 0], "
                       "axis = [0, 1, 0], angle_deg = -170, rate_deg_s = 40 }\n",
    [PART_PRIMITIVE] = "[[component.plate]]\nsize_m = [1, 2]\nnormal = [0, 0, 1]\n"
                       "tangent = [1, 0, 0]\nmaterial = \"mirror\"\n",
};

static run_rows run_mirror(double step_s, double exposure_s, const char *settings)
{
    const char *parts[N_PARTS];
    char times[256];
    memcpy(parts, MIRROR, sizeof parts);
    snprintf(times, sizeof times,
             "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = %d\nstep_s = %.17g\n"
             "exposure_s = %.17g\n",
             MIRROR_SECONDS, step_s, exposure_s);
    parts[PART_TIME] = times;
    return run_with(parts, PART_SETTINGS, settings);
}

/* Integral of the flux ratio over all flashes between the first and the last row, from the rows'
 * phase angles and ranges alone. chord: integral of the disc's brightness along its diameter, in
 * means and radii: 2 for a uniform disc. */
static double flashes_by_hand(const run_rows *r, double chord, int *n_flashes)
{
    double sum = 0, before = 0;
    *n_flashes = 0;
    for (size_t k = 0; k < r->n; k++) {
        const glint_row *row = &r->rows[k];
        const double emitted_s = row->t_s - row->range_m / LIGHT_SPEED_M_S;
        const double normal = (-170 + MIRROR_TURNS_DEG_S * emitted_s) * DEG;
        const double ahead = remainder(normal - 0.5 * row->phase_angle_rad, TWO_PI);
        if (k > 0 && before < 0 && ahead >= 0 && ahead - before < 1) {
            const glint_row *last = &r->rows[k - 1];
            const double part = -before / (ahead - before);
            const double phase =
                last->phase_angle_rad + part * (row->phase_angle_rad - last->phase_angle_rad);
            const double range_m = last->range_m + part * (row->range_m - last->range_m);
            const double rate = 2 * (ahead - before) / (row->t_s - last->t_s); /* of the image */
            /* a mirror's irradiance R A cos / (pi sin^2(q) d^2), the Sun's (1 au / d_sun)^2 */
            const double radius = SUN_RADIUS_M / AU_M;
            const double level = MIRROR_REFLECTS * MIRROR_AREA_M2 * cos(0.5 * phase) /
                                 (PI * radius * radius * range_m * range_m);
            /* the disc of that evening, smaller by its distance (another implementation) */
            const double sun_au = 1.01567;
            sum += level * chord * asin(radius / sun_au) / rate;
            (*n_flashes)++;
        }
        before = ahead;
    }
    return sum;
}

static double integral(const run_rows *r, double exposure_s)
{
    double sum = 0;
    for (size_t k = 0; k < r->n; k++)
        sum += exposure_s * r->rows[k].flux_ratio[0];
    return sum;
}

/* Flashes of 7 ms in exposures of half a second: hardly any sample meets one, and no light is lost.
 * The satellite is nearer to the Sun than the Earth is by up to 5e-5, and the motion within half a
 * second is not quite steady. */
START_TEST(test_exposure_mirror_that_crosses_the_disc_gives_its_closed_form)
{
    static const char *const DISCS[] = {"", "[photometry]\nsolar_disc = \"limb-darkened\"\n"};
    static const double U = 0.6;
    const double chords[] = {2, (2 * (1 - U) + 0.5 * PI * U) / (1 - U / 3)};
    for (int k = 0; k < 2; k++) {
        run_rows rows = run_mirror(0.5, 0.5, DISCS[k]);
        int n_flashes;
        const double want = flashes_by_hand(&rows, chords[k], &n_flashes);
        ck_assert_int_ge(n_flashes, 3);
        assert_rel(integral(&rows, 0.5), want, 4e-5);
        int bright = 0;
        for (size_t i = 0; i < rows.n; i++)
            bright += rows.rows[i].flux_ratio[0] > 0;
        ck_assert_int_ge(bright, n_flashes);
        ck_assert_int_le(bright, 2 * n_flashes);
        rows_free(&rows);
    }
}
END_TEST

/* Flashes weigh as much in one exposure of half a minute as in 59 of half a second. */
START_TEST(test_exposure_short_flash_is_not_lost_in_a_long_exposure)
{
    run_rows fine = run_mirror(0.5, 0.5, ""), coarse = run_mirror(15, 29.5, "");
    double sum = 0;
    for (size_t k = 1; k <= 59; k++) /* from 0.25 to 29.75 s */
        sum += 0.5 * fine.rows[k].flux_ratio[0];
    ck_assert(sum > 0);
    assert_rel(29.5 * coarse.rows[1].flux_ratio[0], sum, 1e-7);
    rows_free(&fine);
    rows_free(&coarse);
}
END_TEST

/* ------------------------------------------------------------ diffuse light */

static run_rows run_box(double step_s, double exposure_s, const char *settings)
{
    char times[256];
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    snprintf(times, sizeof times,
             "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 60\nstep_s = %.17g\n"
             "exposure_s = %.17g\n",
             step_s, exposure_s);
    parts[PART_TIME] = times;
    return run_with(parts, PART_SETTINGS, settings);
}

START_TEST(test_exposure_of_diffuse_light_differs_from_the_sample_by_the_square_of_its_length)
{
    run_rows none = run_box(20, 0, ""), one = run_box(20, 1, ""), two = run_box(20, 2, "");
    for (size_t k = 0; k < none.n; k++) {
        const double sample = none.rows[k].flux_ratio[0];
        const double a = one.rows[k].flux_ratio[0] / sample - 1;
        const double b = two.rows[k].flux_ratio[0] / sample - 1;
        ck_assert(fabs(b) < 2e-3 && fabs(a) > 1e-9);
        assert_rel(b, 4 * a, 1e-2); /* of fourth order */
    }
    rows_free(&none);
    rows_free(&one);
    rows_free(&two);
}
END_TEST

/* Simpson's rule over samples, whose error is of fourth order. */
START_TEST(test_exposure_of_diffuse_light_is_the_integral_of_the_samples)
{
    run_rows fine = run_box(0.5, 0, ""), mean = run_box(10, 8, "");
    for (size_t k = 1; k + 1 < mean.n; k++) {
        double sum = 0;
        for (int i = 0; i <= 16; i++)
            sum += (i == 0 || i == 16 ? 1
                    : i % 2           ? 4
                                      : 2) *
                   fine.rows[20 * k - 8 + (size_t)i].flux_ratio[0];
        assert_rel(mean.rows[k].flux_ratio[0], sum / 48, 1e-8);
    }
    rows_free(&fine);
    rows_free(&mean);
}
END_TEST

/* Earthshine is averaged as sunlight is: each by itself is near its sample, from which a second of
 * slow motion takes it by 1e-3 at most, and on top of sunlight the two add. */
START_TEST(test_exposure_earthshine_is_averaged_apart)
{
    static const char EARTH[] = "[photometry]\nearthshine = { albedo = 0.3 }\n";
    run_rows sample = run_box(20, 0, EARTH), mean = run_box(20, 2, EARTH), sun = run_box(20, 2, "");
    for (size_t k = 0; k < sample.n; k++) {
        const double earth = mean.rows[k].earthshine_flux_ratio[0];
        ck_assert(earth > 0);
        assert_rel(earth, sample.rows[k].earthshine_flux_ratio[0], 2e-3);
        assert_rel(mean.rows[k].flux_ratio[0], sun.rows[k].flux_ratio[0] + earth, 1e-12);
    }
    rows_free(&sample);
    rows_free(&mean);
    rows_free(&sun);
}
END_TEST

/* A mirror that never throws the Sun to the observer, who sees it lit from behind or aside. */
START_TEST(test_exposure_without_light_is_flagged_dark)
{
    const char *parts[N_PARTS];
    memcpy(parts, MIRROR, sizeof parts);
    parts[PART_COMPONENT] = "[[component]]\nname = \"panel\"\n";
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 2\nstep_s = 1\n"
                       "exposure_s = 1\n";
    run_rows rows = run_with(parts, PART_SETTINGS, "");
    ck_assert_uint_eq(rows.n, 3);
    for (size_t k = 0; k < rows.n; k++) {
        ck_assert(rows.rows[k].flux_ratio[0] == 0);
        ck_assert_uint_eq(rows.rows[k].flags & (GLINT_DARK | GLINT_BELOW_HORIZON | GLINT_UMBRA),
                          GLINT_DARK);
    }
    rows_free(&rows);
}
END_TEST

/* ------------------------------------------------------- sums of exposures */

/* A tumbling box with gloss, foil and a hinge: two halves are the whole. */
static run_rows run_tumbling(double exposure_s, int threads)
{
    char text[4096];
    snprintf(
        text, sizeof text,
        "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 60\nstep_s = 5\nexposure_s = %.17g\n"
        "%s%s[photometry]\nbands = [\"V\", \"B\"]\n[output]\nshares = \"both\"\n"
        "[attitude]\nlaw = \"spin\"\nbody_axis = [0.2, 1, 0.3]\npole = \"north\"\n"
        "rate_deg_s = 25\nphase_deg = 10\nepoch = 2025-07-25T20:37:00Z\n"
        "[materials.gloss]\nbrdf = \"ward-gmd\"\nrho_d = 0.1\nrho_s = 0.5\nalpha_x = 0.02\n"
        "alpha_y = 0.02\nbands.B = { rho_d = 0.3 }\n[materials.mirror]\nbrdf = \"mirror\"\nR = "
        "0.9\n"
        "[[component]]\nname = \"bus\"\n[[component.box]]\nsize_m = [1, 1, 2]\n"
        "material = \"gloss\"\n[[component]]\nname = \"wing\"\nparent = \"bus\"\n"
        "hinge = { origin_m = [0, 1, 0], axis = [0, 1, 0], angle_deg = 0, rate_deg_s = 3 }\n"
        "[[component.plate]]\nsize_m = [1, 2]\ncentre_m = [0, 1.1, 0]\nnormal = [0, 0, 1]\n"
        "tangent = [1, 0, 0]\nmaterial = \"mirror\"\nback_material = \"gloss\"\n",
        exposure_s, SOUND[PART_OBSERVER], SOUND[PART_ORBIT]);
    glint_scenario *s = read_sound(write_file("tumbling.toml", text));
    const run_rows out = run(s, threads);
    glint_scenario_free(s);
    return out;
}

START_TEST(test_exposure_two_halves_are_the_whole)
{
    run_rows whole = run_tumbling(20, 1), half = run_tumbling(10, 1);
    const size_t bands = whole.n_bands, parts = whole.n_materials + whole.n_components;
    for (size_t k = 1; k + 1 < whole.n; k++) {
        const glint_row *a = &half.rows[k - 1], *b = &half.rows[k + 1], *all = &whole.rows[k];
        for (size_t i = 0; i < bands; i++)
            assert_rel(all->flux_ratio[i], 0.5 * (a->flux_ratio[i] + b->flux_ratio[i]), 1e-7);
        for (size_t i = 0; i < parts; i++) {
            const size_t m = i - whole.n_materials;
            const bool of_component = i >= whole.n_materials;
            const double x = of_component ? a->share_component[m] : a->share_material[i],
                         y = of_component ? b->share_component[m] : b->share_material[i],
                         z = of_component ? all->share_component[m] : all->share_material[i];
            assert_near(z * all->flux_ratio[0], 0.5 * (x * a->flux_ratio[0] + y * b->flux_ratio[0]),
                        1e-7 * all->flux_ratio[0]);
        }
        ck_assert_int_eq(all->flags & GLINT_DARK, 0);
    }
    rows_free(&whole);
    rows_free(&half);
}
END_TEST

START_TEST(test_exposure_threads_give_the_same_bits)
{
    run_rows one = run_tumbling(2, 1);
    run_rows three = run_tumbling(2, 3);
    ck_assert_uint_eq(one.n, three.n);
    ck_assert_mem_eq(one.numbers, three.numbers, one.n * rows_width(&one) * sizeof *one.numbers);
    rows_free(&one);
    rows_free(&three);
}
END_TEST

/* ---------------------------------------------------------- edges, errors */

/* The satellite sinks below 60 deg within an exposure: the row's time lies after that, the light
 * comes from before. */
START_TEST(test_exposure_light_from_before_the_horizon_counts)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_OBSERVER] = "[observer]\nlatitude_deg = 48.2\nlongitude_deg = 16.37\n"
                           "min_elevation_deg = 60\n";
    parts[PART_ORBIT] = "[orbit]\ncircular = { height_km = 780, inclination_deg = 98.6, "
                        "raan_deg = 80, argument_of_latitude_deg = 132, "
                        "epoch = 2025-07-25T20:37:00Z }\n";
    run_rows samples = run_with(parts, PART_TIME,
                                "[time]\nstart = 2025-07-25T20:37:46Z\nduration_s = 8\n"
                                "step_s = 0.01\n");
    run_rows mean = run_with(parts, PART_TIME,
                             "[time]\nstart = 2025-07-25T20:37:50Z\nduration_s = 10\nstep_s = 10\n"
                             "exposure_s = 8\n");
    double sum = 0;
    for (size_t k = 0; k < 800; k++)
        sum += 0.01 * samples.rows[k].flux_ratio[0];
    ck_assert_int_eq(mean.rows[0].flags & (GLINT_BELOW_HORIZON | GLINT_DARK), GLINT_BELOW_HORIZON);
    assert_near(8 * mean.rows[0].flux_ratio[0], sum, 0.01 * samples.rows[0].flux_ratio[0]);
    ck_assert(mean.rows[1].flux_ratio[0] == 0); /* below throughout */
    rows_free(&samples);
    rows_free(&mean);
}
END_TEST

/* Light in the first or the last thousandth of an exposure: the satellite sinks below 60 deg so
 * soon after it begins, or next to its middle, where two parts of the integral meet. */
START_TEST(test_exposure_light_at_its_very_ends_counts)
{
    static const double LIT_S[] = {0.05, 29.95, 30.05, 59.97}; /* of 60 s */
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_OBSERVER] = "[observer]\nlatitude_deg = 48.2\nlongitude_deg = 16.37\n"
                           "min_elevation_deg = 60\n";
    parts[PART_ORBIT] = "[orbit]\ncircular = { height_km = 780, inclination_deg = 98.6, "
                        "raan_deg = 80, argument_of_latitude_deg = 132, "
                        "epoch = 2025-07-25T20:37:00Z }\n";
    run_rows samples = run_with(parts, PART_TIME,
                                "[time]\nstart = 2025-07-25T20:36:46Z\nduration_s = 68\n"
                                "step_s = 0.01\n");
    size_t last = samples.n - 1;
    while (!(samples.rows[last].flux_ratio[0] > 0))
        last--;
    const double above = samples.rows[last].elevation_rad - 60 * DEG;
    const double sunk_s = 0.01 * ((double)last + above / (samples.rows[last].elevation_rad -
                                                          samples.rows[last + 1].elevation_rad));
    for (int k = 0; k < 4; k++) {
        char text[256];
        const double middle_s = 46 + sunk_s - LIT_S[k] + 30; /* after 20:36 */
        double sum = 0;
        snprintf(text, sizeof text,
                 "[time]\nstart = 2025-07-25T20:%02d:%09.6fZ\nduration_s = 0\nstep_s = 1\n"
                 "exposure_s = 60\n",
                 36 + (int)(middle_s / 60), fmod(middle_s, 60));
        run_rows mean = run_with(parts, PART_TIME, text);
        const size_t n = (size_t)(LIT_S[k] / 0.01 + 0.5), from = last + 1 - n;
        for (size_t j = from; j <= last; j++) /* each stands for the step about it */
            sum += samples.rows[j].flux_ratio[0] / (double)n;
        assert_rel(mean.rows[0].flux_ratio[0], sum * LIT_S[k] / 60, 2e-4);
        rows_free(&mean);
    }
    rows_free(&samples);
}
END_TEST

/* Its time lies 0.09 deg below the horizon, its light above: the air is that at the horizon, which
 * Kasten and Young's formula has at 1/(0.50572 x 6.07995^-1.6364). */
START_TEST(test_exposure_centred_below_the_horizon_is_dimmed_as_at_the_horizon)
{
    static const char *const SETTINGS[] = {"", "extinction = { V = 0.2 }\n"};
    const char *parts[N_PARTS];
    double magnitude[2];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_ORBIT] = "[orbit]\ncircular = { height_km = 780, inclination_deg = 98.6, "
                        "raan_deg = 80, argument_of_latitude_deg = 132, "
                        "epoch = 2025-07-25T20:37:00Z }\n";
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T20:29:13Z\nduration_s = 0\nstep_s = 1\n"
                       "exposure_s = 8\n";
    for (int k = 0; k < 2; k++) {
        char text[64];
        snprintf(text, sizeof text, "[photometry]\n%s", SETTINGS[k]);
        run_rows rows = run_with(parts, PART_SETTINGS, text);
        ck_assert(rows.rows[0].flags & GLINT_BELOW_HORIZON && rows.rows[0].flux_ratio[0] > 0);
        magnitude[k] = rows.rows[0].magnitude[0];
        rows_free(&rows);
    }
    const double airmass = 1 / (0.50572 * pow(6.07995, -1.6364));
    assert_near(magnitude[1] - magnitude[0], 0.2 * airmass, 1e-9);
}
END_TEST

START_TEST(test_exposure_of_a_satellite_that_turns_too_fast_is_an_error)
{
    const char *parts[N_PARTS];
    memcpy(parts, MIRROR, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 0\nstep_s = 1\n"
                       "exposure_s = 10\n";
    glint_scenario *s =
        read_with(parts, PART_COMPONENT,
                  "[[component]]\nname = \"panel\"\nhinge = { origin_m = [0, 0, 0], "
                  "axis = [0, 1, 0], angle_deg = 0, rate_deg_s = 1e6 }\n");
    glint_curve *curve;
    const glint_row *rows;
    size_t n;
    glint_error error;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    ck_assert_int_eq(glint_curve_next(curve, &rows, &n, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "expected a shorter exposure_s"));
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("exposure");
    TCase *all = tcase_create("all");
    tcase_add_checked_fixture(all, folder_make, folder_remove);
    tcase_set_timeout(all, 120);
    tcase_add_test(all, test_exposure_mirror_that_crosses_the_disc_gives_its_closed_form);
    tcase_add_test(all, test_exposure_short_flash_is_not_lost_in_a_long_exposure);
    tcase_add_test(
        all, test_exposure_of_diffuse_light_differs_from_the_sample_by_the_square_of_its_length);
    tcase_add_test(all, test_exposure_of_diffuse_light_is_the_integral_of_the_samples);
    tcase_add_test(all, test_exposure_earthshine_is_averaged_apart);
    tcase_add_test(all, test_exposure_without_light_is_flagged_dark);
    tcase_add_test(all, test_exposure_two_halves_are_the_whole);
    tcase_add_test(all, test_exposure_threads_give_the_same_bits);
    tcase_add_test(all, test_exposure_light_from_before_the_horizon_counts);
    tcase_add_test(all, test_exposure_light_at_its_very_ends_counts);
    tcase_add_test(all, test_exposure_centred_below_the_horizon_is_dimmed_as_at_the_horizon);
    tcase_add_test(all, test_exposure_of_a_satellite_that_turns_too_fast_is_an_error);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
