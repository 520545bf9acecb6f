/* Magnitudes: bands, airmass, standard magnitudes, and what a telescope makes of them. */
#include "base/constants.h"
#include "lightcurve/noise.h"
#include "lightcurve/photometry.h"
#include "run_rows.h"
#include "table.h"

/* -------------------------------------------------------------------- bands */

START_TEST(test_photometry_bands_have_the_published_magnitudes_of_the_sun)
{
    /* Willmer 2018, ApJS 236, 47: Vega, AB; 0 where there is none. */
    static const struct {
        const char *name;
        double vega, ab;
    } ALL[] = {
        {"U", -25.97, -25.25}, {"B", -26.13, -26.26}, {"V", -26.76, -26.77}, {"R", -27.15, -26.97},
        {"I", -27.47, -27.06}, {"sdss_u", 0, -25.18}, {"sdss_g", 0, -26.47}, {"sdss_r", 0, -26.93},
        {"sdss_i", 0, -27.05}, {"sdss_z", 0, -27.07}, {"lsst_u", 0, -25.30}, {"lsst_g", 0, -26.52},
        {"lsst_r", 0, -26.93}, {"lsst_i", 0, -27.05}, {"lsst_z", 0, -27.07}, {"lsst_y", 0, -27.07}};
    size_t n = 0;
    while (band_at(n))
        n++;
    ck_assert_uint_eq(n, COUNT_OF(ALL));
    for (size_t k = 0; k < n; k++) {
        const band_info *band = band_named(ALL[k].name);
        ck_assert_ptr_nonnull(band);
        assert_near(band_sun_magnitude(band, SYSTEM_AB), ALL[k].ab, 0);
        if (ALL[k].vega < 0)
            assert_near(band_sun_magnitude(band, SYSTEM_VEGA), ALL[k].vega, 0);
        else
            ck_assert(isnan(band_sun_magnitude(band, SYSTEM_VEGA)));
    }
}
END_TEST

/* Fluxes of magnitude 0 in Jy as Bessell 1979 calibrated them, who took Vega's spectrum from
 * elsewhere: 5 % are between the calibrations. A photon rate of 1.51e7 photons/(s m^2) is that of
 * 1 Jy in a relative width of 1. */
START_TEST(test_photometry_photons_of_magnitude_zero_agree_with_another_calibration)
{
    static const struct {
        const char *name;
        double jansky, relative_width;
    } ALL[] = {{"U", 1810, 0.15},
               {"B", 4260, 0.22},
               {"V", 3640, 0.16},
               {"R", 3080, 0.23},
               {"I", 2550, 0.19}};
    for (size_t k = 0; k < COUNT_OF(ALL); k++)
        assert_rel(band_photons_m2_s(band_named(ALL[k].name), SYSTEM_VEGA),
                   ALL[k].jansky * ALL[k].relative_width * 1.51e7, 0.05);
    /* the AB system needs no star: 3631 Jy / h */
    assert_rel(band_photons_m2_s(band_named("V"), SYSTEM_AB), 0.16 * 3631 * 1.50919018e7, 1e-8);
    ck_assert(isnan(band_photons_m2_s(band_named("lsst_g"), SYSTEM_AB)));
}
END_TEST

/* The integral over ln(wavelength) of the published response, by trapezoids; its peak counts as 1.
 * 0.4 % is half a unit of the last digit that is kept. */
START_TEST(test_photometry_widths_of_sdss_bands_are_those_of_their_response)
{
    csv_table table = table_open(path_in(TEST_DATA_DIR, "sdss_response.csv"));
    int n_bands = 0;
    for (long row = 0, first = 0; row < table.n_rows; row++) {
        const char *name = table_text(&table, row, "band");
        const bool last =
            row + 1 == table.n_rows || strcmp(table_text(&table, row + 1, "band"), name) != 0;
        if (!last) continue;
        double sum = 0;
        for (long k = first; k < row; k++)
            sum += 0.5 *
                   (table_number(&table, k, "response") + table_number(&table, k + 1, "response")) *
                   log(table_number(&table, k + 1, "wavelength_angstrom") /
                       table_number(&table, k, "wavelength_angstrom"));
        assert_rel(band_photons_m2_s(band_named(name), SYSTEM_AB),
                   sum / table_number(&table, row, "peak") * 3631 * 1.50919018e7, 4e-3);
        first = row + 1;
        n_bands++;
    }
    ck_assert_int_eq(n_bands, 5);
    csv_free(&table);
}
END_TEST

/* ------------------------------------------------------------------ airmass */

START_TEST(test_photometry_airmass_follows_the_chosen_formula)
{
    glint_scenario s = {.airmass = AIRMASS_KASTEN_YOUNG};
    assert_near(airmass_of(&s, 30 * DEG), 1.9942928525, 1e-10);
    assert_near(airmass_of(&s, 10 * DEG), 5.5860358799, 1e-10);
    s.airmass = AIRMASS_PICKERING;
    /* the formula in 20 digits; the horizon as published is 38.75 */
    static const double PICKERING[][2] = {{0, 38.749398755780},  {1, 26.643769397641},
                                          {10, 5.5807371486819}, {30, 1.9931538464146},
                                          {60, 1.1540579205733}, {90, 1.0000001961713}};
    for (size_t k = 0; k < COUNT_OF(PICKERING); k++)
        assert_near(airmass_of(&s, PICKERING[k][0] * DEG), PICKERING[k][1], 1e-9);
    ck_assert(airmass_of(&s, -1 * DEG) == 0);
    /* the two agree where the air is well known */
    for (double deg = 15; deg <= 90; deg += 5)
        assert_rel(airmass_pickering(deg * DEG), airmass_kasten_young(deg * DEG), 3e-3);
}
END_TEST

static double last_value(const char *settings, const char *column)
{
    glint_scenario *s = read_with(SOUND, PART_SETTINGS, settings);
    glint_curve *curve;
    const glint_row *rows;
    size_t n_rows, n;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    ck_assert_int_eq(glint_curve_next(curve, &rows, &n_rows, NULL), GLINT_OK);
    const glint_column *columns = glint_curve_columns(curve, &n);
    double value = NAN;
    for (size_t k = 0; k < n; k++)
        if (strcmp(columns[k].name, column) == 0)
            ck_assert(glint_curve_value(curve, &rows[n_rows - 1], k, &value));
    glint_curve_close(curve);
    glint_scenario_free(s);
    return value;
}

START_TEST(test_photometry_extinction_takes_the_chosen_airmass)
{
    const double young = last_value("[photometry]\nextinction = { V = 0.5 }\n", "mag_V");
    const double pickering =
        last_value("[photometry]\nextinction = { V = 0.5 }\nairmass = \"pickering\"\n", "mag_V");
    const double elevation = last_value("", "elevation_deg") * DEG;
    assert_near(pickering - young,
                0.5 * (airmass_pickering(elevation) - airmass_kasten_young(elevation)), 1e-12);
    ck_assert(pickering != young);
}
END_TEST

/* ------------------------------------------------------ standard magnitudes */

/* The diffuse sphere of docs/physics.md: radius 1 m, albedo 0.25, at 1000 km. */
START_TEST(test_photometry_standard_magnitudes_of_a_diffuse_sphere_do_not_depend_on_the_phase)
{
    static const double SPHERE[][2] = {
        {0, 5.1853781260}, {60, 5.7238388504}, {90, 6.4282528077}, {120, 7.5918339841}};
    for (size_t k = 0; k < COUNT_OF(SPHERE); k++) {
        const double phase = SPHERE[k][0] * DEG, mag = SPHERE[k][1];
        assert_near(mag + magnitude_to_standard(1e6, phase, 0.5 * PI), 6.4282528077, 2e-10);
        assert_near(mag + magnitude_to_standard(1e6, phase, 0), 5.1853781260, 2e-10);
        /* twice as far, four times fainter */
        assert_near(mag + 5 * log10(2) + magnitude_to_standard(2e6, phase, 0), 5.1853781260, 2e-10);
    }
    assert_near(magnitude_to_standard(1e6, 0, 0.5 * PI), 1.2428746817, 1e-10);
    /* near pi the phase law is a cube: 2.5 log10(1000) for a tenth of the angle */
    assert_near(magnitude_to_standard(1e6, PI - 1e-3, 0) - magnitude_to_standard(1e6, PI - 1e-4, 0),
                7.5, 1e-6);
    ck_assert(!isfinite(magnitude_to_standard(1e6, PI, 0)));
}
END_TEST

/* sin q - q cos q, q the angle from pi, is the sum of -(-1)^n 2 n q^(2n+1) / (2n+1)!, whatever the
 * program does for small q and for large; over pi, it is the part of what a full sphere shows. */
START_TEST(test_photometry_standard_magnitudes_near_opposition_are_the_series)
{
    static const double ANGLES[] = {1, 0.6, 0.45, 0.3, 0.1, 0.03, 0.021, 0.019, 0.01, 1e-3, 1e-5};
    for (size_t k = 0; k < COUNT_OF(ANGLES); k++) {
        const double phase = PI - ANGLES[k], q = PI - phase; /* as PI - phase rounds */
        double term = -q, sum = 0;                           /* (-1)^(n+1) q^(2n+1) / (2n+1)! */
        for (int n = 1; n <= 12; n++) {
            term *= -q * q / (2 * n * (2 * n + 1));
            sum += 2 * n * term;
        }
        /* at q = 0.02 the difference of sin and q cos keeps 1e-16/1e-4 */
        assert_near(magnitude_to_standard(1e6, phase, 0), 2.5 * log10(sum / PI), 3e-12);
    }
}
END_TEST

START_TEST(test_photometry_columns_of_standard_magnitudes_are_named_and_without_extinction)
{
    static const char BOTH[] = "[photometry]\nextinction = { V = 0.5 }\n"
                               "[output]\nstandard_magnitudes = \"both\"\n";
    const double mag = last_value("", "mag_V"), range_m = 1e3 * last_value("", "range_km"),
                 phase = last_value("", "phase_angle_deg") * DEG;
    const double law = sin(phase) + (PI - phase) * cos(phase);
    const double at_90 = mag - 5 * log10(range_m / 1e6) + 2.5 * log10(law);
    assert_near(last_value(BOTH, "mag_std_1000km_phase90_V"), at_90, 1e-12);
    assert_near(last_value(BOTH, "mag_std_1000km_phase0_V"), at_90 - 2.5 * log10(PI), 1e-12);
    ck_assert(isnan(last_value("", "mag_std_1000km_phase0_V")));
    ck_assert(isnan(
        last_value("[output]\nstandard_magnitudes = \"phase0\"\n", "mag_std_1000km_phase90_V")));
}
END_TEST

/* -------------------------------------------------------------------- noise */

/* A telescope of half a metre, without anything that makes noise. */
static telescope quiet(void)
{
    telescope t = {.aperture_m = 0.5,
                   .pixel_rad = 1 * ARCSEC,
                   .seeing_fwhm_rad = 2 * ARCSEC,
                   .half_width_rad = 3 * ARCSEC};
    t.electrons_s[0] = 1e9;
    t.sky_mag[0] = 100; /* none to speak of */
    return t;
}

static noise_terms terms_of(const telescope *t, double magnitude, double exposure_s, double trail)
{
    const noise_view view = {
        .magnitude = magnitude, .exposure_s = exposure_s, .trail_rad = trail * ARCSEC};
    noise_terms terms;
    noise_of(t, 0, &view, &terms);
    return terms;
}

/* The light in the box by brute force: the trail as points, each a Gaussian summed over pixels. */
static double brute_fraction(double trail, double fwhm, double half)
{
    enum { POINTS = 400, PIXELS = 2000 };
    const double sigma = fwhm / sqrt(8 * log(2.0));
    double across = 0, along = 0;
    for (int p = 0; p < PIXELS; p++) {
        const double x = half * (2 * (p + 0.5) / PIXELS - 1);
        across += exp(-0.5 * x * x / (sigma * sigma)) * 2 * half / PIXELS;
        for (int k = 0; k < POINTS; k++) {
            const double reach = 0.5 * trail + half, y = reach * (2 * (p + 0.5) / PIXELS - 1);
            const double d = y - trail * ((k + 0.5) / POINTS - 0.5);
            along += exp(-0.5 * d * d / (sigma * sigma)) * 2 * reach / PIXELS / POINTS;
        }
    }
    return across * along / (TWO_PI * sigma * sigma);
}

START_TEST(test_photometry_light_in_the_box_is_that_of_a_drawn_out_gaussian)
{
    static const double TRAILS[] = {0, 1e-5, 0.5, 3, 40};
    telescope t = quiet();
    for (size_t k = 0; k < COUNT_OF(TRAILS); k++) {
        const noise_terms terms = terms_of(&t, 0, 1, TRAILS[k]);
        /* the sum over points and pixels errs by the square of their distances */
        assert_rel(terms.fraction, brute_fraction(TRAILS[k], 2, 3), 2e-5);
        assert_rel(terms.pixels, 6 * (TRAILS[k] + 6), 1e-14);
    }
    /* a narrow box loses light, and a long trail loses none at its ends */
    t.half_width_rad = 0.5 * ARCSEC;
    assert_rel(terms_of(&t, 0, 1, 0).fraction, pow(erf(0.5 * sqrt(log(2.0))), 2), 1e-14);
    assert_rel(terms_of(&t, 0, 1, 1e7).fraction, erf(0.5 * sqrt(log(2.0))), 1e-6);
}
END_TEST

START_TEST(test_photometry_each_term_of_the_noise_has_its_closed_form)
{
    telescope t = quiet();
    t.sky_mag[0] = 20;
    t.read_noise_e = 7;
    t.dark_current_e_s = 0.25;
    const noise_terms terms = terms_of(&t, 10, 4, 12);
    const double pixels = 6 * 18;
    assert_rel(terms.signal_e, 1e9 * 4 * 1e-4 * terms.fraction, 1e-14);
    assert_rel(terms.photon_e, sqrt(terms.signal_e), 1e-14);
    assert_rel(terms.sky_e, sqrt(1e9 * 4 * 1e-8 * pixels), 1e-13); /* a pixel is a square arcsec */
    assert_rel(terms.dark_e, sqrt(0.25 * 4 * pixels), 1e-13);
    assert_rel(terms.read_e, 7 * sqrt(pixels), 1e-13);
    ck_assert(terms.scintillation_e == 0); /* no air */
    const double variance = terms.signal_e + 40 * pixels + 1 * pixels + 49 * pixels;
    assert_rel(noise_snr(&terms), terms.signal_e / sqrt(variance), 1e-13);
    assert_rel(noise_sigma_mag(noise_snr(&terms)), 1.0857362047581296 / noise_snr(&terms), 1e-15);
    const noise_terms none = {0};
    ck_assert(noise_snr(&none) == 0);
}
END_TEST

/* Young 1967: 0.09 D^(-2/3) X^1.75 exp(-h/8000 m) / sqrt(2 T), D in cm; today's coefficient of 1
 * differs from his by 7 %, and an exponent of 1.5 stands for 1.75. */
START_TEST(test_photometry_scintillation_is_near_youngs_own_formula)
{
    static const double VIEWS[][4] = {
        {0.3, 1, 1, 0}, {1, 10, 1, 2400}, {4, 0.5, 1, 4200}, {8, 30, 1.2, 2600}};
    for (size_t k = 0; k < COUNT_OF(VIEWS); k++) {
        const double d = VIEWS[k][0], time = VIEWS[k][1], x = VIEWS[k][2], h = VIEWS[k][3];
        telescope t = quiet();
        t.aperture_m = d;
        t.scintillation = 1;
        const noise_view view = {.magnitude = 5, .exposure_s = time, .airmass = x, .height_m = h};
        noise_terms terms;
        noise_of(&t, 0, &view, &terms);
        const double young =
            0.09 * pow(100 * d, -2.0 / 3) * pow(x, 1.75) * exp(-h / 8000) / sqrt(2 * time);
        assert_rel(terms.scintillation_e / terms.signal_e, young, 0.08);
        t.scintillation = 1.5;
        noise_terms more;
        noise_of(&t, 0, &view, &more);
        assert_rel(more.scintillation_e, 1.5 * terms.scintillation_e, 1e-14);
    }
}
END_TEST

START_TEST(test_photometry_bright_and_faint_limits_scale_as_they_must)
{
    telescope t = quiet();
    t.sky_mag[0] = 20;
    t.read_noise_e = 5;
    t.dark_current_e_s = 0.1;
    t.scintillation = 1.5;
    const noise_view bright = {.magnitude = -15, .exposure_s = 1, .airmass = 1};
    noise_terms terms;
    noise_of(&t, 0, &bright, &terms);
    /* scintillation alone: sqrt(1e-5) 1.5 0.5^(-2/3) */
    assert_rel(1 / noise_snr(&terms), sqrt(1e-5) * 1.5 * pow(0.5, -2.0 / 3), 1e-6);
    /* which grows as the airmass to the power 3/2 (Osborn et al. 2015, eq. 7: variance as its cube)
     */
    noise_view low = bright;
    low.airmass = 2.5;
    noise_terms more;
    noise_of(&t, 0, &low, &more);
    assert_rel(more.scintillation_e, pow(2.5, 1.5) * terms.scintillation_e, 1e-14);
    /* photons alone */
    t.scintillation = 0;
    noise_terms first = terms_of(&t, 2, 1, 0), second = terms_of(&t, 4, 1, 0);
    assert_rel(noise_snr(&first) / noise_snr(&second), pow(10, 0.4), 1e-3);
    /* sky alone: as the flux, and as the root of the time */
    t.read_noise_e = t.dark_current_e_s = 0;
    first = terms_of(&t, 27, 1, 0), second = terms_of(&t, 29, 1, 0);
    assert_rel(noise_snr(&first) / noise_snr(&second), pow(10, 0.8), 2e-3);
    second = terms_of(&t, 27, 100, 0);
    assert_rel(noise_snr(&second) / noise_snr(&first), 10, 1e-12);
    /* and falls with a longer trail */
    second = terms_of(&t, 27, 1, 100);
    ck_assert(noise_snr(&second) < noise_snr(&first));
}
END_TEST

#define SCOPE                                                                                      \
    "[telescope]\naperture_m = 0.5\nobstruction_m = 0.2\nthroughput = 0.4\n"                       \
    "pixel_scale_arcsec = 1.5\nseeing_fwhm_arcsec = 2\nsky_mag_arcsec2 = 20\n"                     \
    "read_noise_e = 8\ndark_current_e_s = 0.1\nscintillation = 0\n"

/* The box over Vienna, with a camera. */
static glint_scenario *read_scope(const char *settings)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 60\nstep_s = 10\n"
                       "exposure_s = 0.1\n";
    return read_with(parts, PART_SETTINGS, settings);
}

/* The whole of it by hand, from the row's magnitude and angular rate. */
START_TEST(test_photometry_noise_of_a_row_is_that_of_the_telescope)
{
    glint_scenario *s = read_scope(SCOPE);
    run_rows rows = run(s, 1);
    const double area = 0.25 * PI * (0.25 - 0.04);
    const double zero = 0.1 * 0.4 * area * band_photons_m2_s(band_named("V"), SYSTEM_VEGA);
    const double sigma = 2 / sqrt(8 * log(2.0));
    for (size_t k = 0; k < rows.n; k++) {
        const glint_row *row = &rows.rows[k];
        const double trail = 0.1 * row->angular_rate_rad_s / ARCSEC; /* > 100 arcsec */
        const double pixels = 4 * (trail + 4) / 2.25;
        /* what is lost over the ends of so long a trail is what two half-planes lose */
        const double u = 2 / (sqrt(2.0) * sigma);
        const double lost = sqrt(2.0) * sigma * (exp(-u * u) / sqrt(PI) - u * erfc(u));
        const double signal =
            zero * pow(10, -0.4 * row->magnitude[0]) * erf(u) * (1 - lost / trail);
        const double sky = zero * 1e-8 * pixels * 2.25;
        const double snr = signal / sqrt(signal + sky + pixels * (0.1 * 0.1 + 64));
        assert_rel(noise_row_snr(s, row, 0), snr, 1e-12);
    }
    rows_free(&rows);
    glint_scenario_free(s);
    /* a telescope that follows the satellite has a point to measure */
    s = read_scope(SCOPE "tracking = \"satellite\"\n");
    rows = run(s, 1);
    const double signal =
        zero * pow(10, -0.4 * rows.rows[0].magnitude[0]) * pow(erf(2 / (sqrt(2.0) * sigma)), 2);
    assert_rel(noise_row_snr(s, rows.rows, 0),
               signal / sqrt(signal + 16 * zero * 1e-8 + 16 / 2.25 * (0.01 + 64)), 1e-12);
    rows_free(&rows);
    glint_scenario_free(s);
}
END_TEST

/* An exposure centred below the horizon, whose light came from above: through the air at the
 * horizon, 37.92 by Kasten and Young's formula, whose share of the scatter is Young's 1e-5 C^2
 * D^(-4/3) X^3 exp(-2 h/8000 m)/T. */
START_TEST(test_photometry_light_from_the_horizon_scintillates_as_there)
{
    const double magnitude = -30; /* scintillation alone */
    glint_scenario *s = read_scope(SCOPE);
    s->telescope.scintillation = 1.5;
    const glint_row row = {.magnitude = &magnitude,
                           .flags = GLINT_BELOW_HORIZON,
                           .elevation_rad = -0.1 * DEG,
                           .has_site = true,
                           .angular_rate_rad_s = 1 * ARCSEC};
    const double airmass = 1 / (0.50572 * pow(6.07995, -1.6364));
    const double variance = 2.25e-5 * pow(0.5, -4.0 / 3) * pow(airmass, 3) / 0.1;
    assert_rel(noise_row_snr(s, &row, 0), 1 / sqrt(variance), 1e-4);
    glint_scenario_free(s);
}
END_TEST

/* Against directions a second apart. */
START_TEST(test_photometry_angular_rate_is_that_of_the_directions)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    /* under J2 the velocity is that of the ellipse, not of its drift: 1e-3 off */
    parts[PART_ORBIT] = "[orbit]\ncircular = { height_km = 780, inclination_deg = 98.6, "
                        "raan_deg = 80, argument_of_latitude_deg = 132, j2 = false }\n";
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 60\nstep_s = 0.5\n"
                       "exposure_s = 0.001\n";
    glint_scenario *s = read_with(parts, PART_SETTINGS, SCOPE);
    run_rows rows = run(s, 1);
    for (size_t k = 1; k + 1 < rows.n; k++) {
        const glint_row *a = &rows.rows[k - 1], *b = &rows.rows[k + 1];
        /* the site turns under the stars: azimuths lie apart by its turn about the pole, which
         * is taken back here to first order */
        const double turn = 7.292115e-5, latitude = 48.2 * DEG;
        double va[3], vb[3];
        for (int i = 0; i < 2; i++) {
            const glint_row *r = i ? b : a;
            double *v = i ? vb : va;
            v[0] = cos(r->elevation_rad) * sin(r->azimuth_rad);
            v[1] = cos(r->elevation_rad) * cos(r->azimuth_rad);
            v[2] = sin(r->elevation_rad);
            const double w[3] = {0, turn * cos(latitude), turn * sin(latitude)};
            const double dt = i ? 0.5 : -0.5;
            const double d[3] = {w[1] * v[2] - w[2] * v[1], w[2] * v[0] - w[0] * v[2],
                                 w[0] * v[1] - w[1] * v[0]};
            for (int j = 0; j < 3; j++)
                v[j] += dt * d[j];
        }
        const double dx = vb[0] - va[0], dy = vb[1] - va[1], dz = vb[2] - va[2];
        assert_rel(rows.rows[k].angular_rate_rad_s, sqrt(dx * dx + dy * dy + dz * dz), 2e-4);
    }
    rows_free(&rows);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------------- errors */

START_TEST(test_photometry_wrong_telescopes_are_refused_at_their_place)
{
#define AFTER(first)                                                                               \
    "[telescope]\n" first "pixel_scale_arcsec = 1\nseeing_fwhm_arcsec = 2\n"                       \
    "read_noise_e = 8\ndark_current_e_s = 0.1\n"
    static const wrong_text WRONG[] = {
        {PART_SETTINGS, AFTER("aperture_m = @0\nthroughput = 0.4\nsky_mag_arcsec2 = 20\n"),
         "aperture_m", "above 0", 1},
        {PART_SETTINGS,
         AFTER("aperture_m = 1\nobstruction_m = @1\nthroughput = 0.4\nsky_mag_arcsec2 = 20\n"),
         "obstruction_m", "less than", 1},
        {PART_SETTINGS, "@" AFTER("aperture_m = 1\nsky_mag_arcsec2 = 20\n"), "neither",
         "expected one of them", 1},
        {PART_SETTINGS,
         AFTER("aperture_m = 1\nzero_point_mag = 22\nthroughput = @0.4\nsky_mag_arcsec2 = 20\n"),
         "both", "expected one of them", 1},
        {PART_SETTINGS, AFTER("aperture_m = 1\nthroughput = @1.5\nsky_mag_arcsec2 = 20\n"),
         "throughput", "above 0", 1},
        {PART_SETTINGS, AFTER("aperture_m = 1\nthroughput = 0.4\nsky_mag_arcsec2 = @{ B = 20 }\n"),
         "V", NULL, 1},
        {PART_SETTINGS,
         "[photometry]\nbands = [\"lsst_g\"]\n" AFTER(
             "aperture_m = 1\nthroughput = @0.4\nsky_mag_arcsec2 = 20\n"),
         "lsst_g", "zero_point_mag", 1},
        {PART_SETTINGS,
         AFTER("aperture_m = 1\nthroughput = 0.4\nsky_mag_arcsec2 = 20\ntracking = @\"lunar\"\n"),
         "lunar", "sidereal", 1},
        {PART_SETTINGS, "[photometry]\nairmass = @\"secz\"\n", "secz", "pickering", 1},
        {PART_SETTINGS, "[output]\nstandard_magnitudes = @\"all\"\n", "all", "phase90", 1},
    };
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 60\nstep_s = 10\n"
                       "exposure_s = 0.1\n";
    ASSERT_ALL_WRONG(parts, WRONG);
    static const wrong_text SAMPLES = {
        PART_SETTINGS, "@" AFTER("aperture_m = 1\nthroughput = 0.4\nsky_mag_arcsec2 = 20\n"),
        "must expose", "exposure_s", 1};
    assert_wrong(SOUND, &SAMPLES);
    static const wrong_text LABORATORY = {
        PART_SETTINGS, "@" AFTER("aperture_m = 1\nthroughput = 0.4\nsky_mag_arcsec2 = 20\n"),
        "[geometry]", "no [telescope]", 1};
    assert_wrong(GIVEN, &LABORATORY);
    static const wrong_text TIMES = {
        PART_TIME,
        "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 60\nstep_s = 10\nexposure_s = @-1\n",
        "exposure_s", "between 0 and", 1};
    assert_wrong(SOUND, &TIMES);
    /* beside a telescope, too, it is one error */
    parts[PART_SETTINGS] = AFTER("aperture_m = 1\nthroughput = 0.4\nsky_mag_arcsec2 = 20\n");
    assert_wrong(parts, &TIMES);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("photometry");
    TCase *bands = tcase_create("bands");
    tcase_add_test(bands, test_photometry_bands_have_the_published_magnitudes_of_the_sun);
    tcase_add_test(bands, test_photometry_photons_of_magnitude_zero_agree_with_another_calibration);
    tcase_add_test(bands, test_photometry_widths_of_sdss_bands_are_those_of_their_response);
    suite_add_tcase(suite, bands);
    TCase *airmass = tcase_create("airmass");
    tcase_add_checked_fixture(airmass, folder_make, folder_remove);
    tcase_add_test(airmass, test_photometry_airmass_follows_the_chosen_formula);
    tcase_add_test(airmass, test_photometry_extinction_takes_the_chosen_airmass);
    suite_add_tcase(suite, airmass);
    TCase *standard = tcase_create("standard");
    tcase_add_checked_fixture(standard, folder_make, folder_remove);
    tcase_add_test(
        standard,
        test_photometry_standard_magnitudes_of_a_diffuse_sphere_do_not_depend_on_the_phase);
    tcase_add_test(standard, test_photometry_standard_magnitudes_near_opposition_are_the_series);
    tcase_add_test(standard,
                   test_photometry_columns_of_standard_magnitudes_are_named_and_without_extinction);
    suite_add_tcase(suite, standard);
    TCase *noise = tcase_create("noise");
    tcase_add_checked_fixture(noise, folder_make, folder_remove);
    tcase_add_test(noise, test_photometry_light_in_the_box_is_that_of_a_drawn_out_gaussian);
    tcase_add_test(noise, test_photometry_each_term_of_the_noise_has_its_closed_form);
    tcase_add_test(noise, test_photometry_scintillation_is_near_youngs_own_formula);
    tcase_add_test(noise, test_photometry_bright_and_faint_limits_scale_as_they_must);
    tcase_add_test(noise, test_photometry_noise_of_a_row_is_that_of_the_telescope);
    tcase_add_test(noise, test_photometry_light_from_the_horizon_scintillates_as_there);
    tcase_add_test(noise, test_photometry_angular_rate_is_that_of_the_directions);
    tcase_add_test(noise, test_photometry_wrong_telescopes_are_refused_at_their_place);
    suite_add_tcase(suite, noise);
    return run_suite(suite);
}
