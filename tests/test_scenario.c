/* Scenarios that are right: every key, what it becomes, and what stands in its place where it is
 * left out. */
#include "base/constants.h"
#include "base/vec.h"
#include "scenario/scenario.h"
#include "scenario_text.h"

/* Two roundings of a conversion of units, relative. */
static const double rounding = 5e-16;

static void assert_vec(const double got[3], double x, double y, double z, double tol)
{
    assert_near(got[0], x, tol);
    assert_near(got[1], y, tol);
    assert_near(got[2], z, tol);
}

/* ------------------------------------------------------------------ time */

/* UTC of row k as the table writes it, in a static buffer. */
static const char *row_utc(const glint_scenario *s, size_t k)
{
    static char cell[GLINT_CELL_SIZE];
    glint_curve *curve;
    const glint_row *rows;
    size_t n;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
    ck_assert_uint_gt(n, k);
    glint_curve_text(curve, &rows[k], 0, cell);
    glint_curve_close(curve);
    return cell;
}

START_TEST(test_scenario_time_gives_rows_up_to_its_end)
{
    static const struct {
        const char *text;
        long long steps;
    } all[] = {
        {"duration_s = 60\nstep_s = 10", 7},
        {"duration_s = 60\nstep_s = 7", 9},
        {"duration_s = 0.3\nstep_s = 0.1", 4}, /* 3 x 0.1 > 0.3 in doubles: to 1e-6 of a step */
        {"duration_s = 59.99999\nstep_s = 10", 7},
        {"duration_s = 59.9999\nstep_s = 10", 6},
        {"duration_s = 0\nstep_s = 10", 1},
        {"end = 2025-07-25T20:37:00Z\nstep_s = 1e-3", 1},
        {"end = 2025-07-25T20:37:00.5Z\nstep_s = 0.25", 3},
        {"end = \"2025-07-25T22:38:00+02:00\"\nstep_s = 60", 2},
        {"duration_s = 1\nstep_s = 1e9", 1},
    };
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        char content[256];
        snprintf(content, sizeof content, "[time]\nstart = 2025-07-25T20:37:00Z\n%s\n",
                 all[k].text);
        glint_scenario *s = read_with(SOUND, PART_TIME, content);
        ck_assert_msg(s->n_steps == all[k].steps, "%s: %lld rows instead of %lld", all[k].text,
                      (long long)s->n_steps, all[k].steps);
        glint_scenario_free(s);
    }
}
END_TEST

START_TEST(test_scenario_start_in_every_form_is_the_same_moment)
{
    static const char *const starts[] = {
        "2025-07-25T20:37:00Z",      "2025-07-25T20:37:00.000Z",      "2025-07-25 20:37:00Z",
        "2025-07-25T20:37:00",       "2025-07-25T22:37:00+02:00",     "2025-07-26T02:07:00+05:30",
        "2025-07-25T11:07:00-09:30", "\"2025-07-25T20:37:00Z\"",      "\"2025-07-25T20:37:00\"",
        "\"2025-07-25 20:37Z\"",     "\"2025-07-25T22:37:00+02:00\"", "'2025-07-25t20:37:00z'"};
    for (size_t k = 0; k < COUNT_OF(starts); k++) {
        char content[256];
        snprintf(content, sizeof content, "[time]\nstart = %s\nduration_s = 1\nstep_s = 1\n",
                 starts[k]);
        glint_scenario *s = read_with(SOUND, PART_TIME, content);
        ck_assert_msg(strcmp(row_utc(s, 1), "2025-07-25T20:37:01.000000Z") == 0, "%s: %s",
                      starts[k], row_utc(s, 1));
        glint_scenario_free(s);
    }
    glint_scenario *s =
        read_with(SOUND, PART_TIME, "[time]\nstart = 2025-07-25\nduration_s = 0\nstep_s = 1\n");
    ck_assert_str_eq(row_utc(s, 0), "2025-07-25T00:00:00.000000Z");
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_scenario_leap_second_can_be_said)
{
    glint_scenario *s =
        read_with(SOUND, PART_TIME,
                  "[time]\nstart = \"2016-12-31T23:59:60Z\"\nduration_s = 1\nstep_s = 0.5\n");
    ck_assert_str_eq(row_utc(s, 0), "2016-12-31T23:59:60.000000Z");
    ck_assert_str_eq(row_utc(s, 1), "2016-12-31T23:59:60.500000Z");
    ck_assert_str_eq(row_utc(s, 2), "2017-01-01T00:00:00.000000Z");
    glint_scenario_free(s);
    s = read_with(SOUND, PART_TIME,
                  "[time]\nstart = 2016-12-31T23:59:59Z\nend = 2017-01-01T00:00:00Z\nstep_s = 1\n");
    ck_assert_int_eq(s->n_steps, 3); /* the span has two seconds */
    ck_assert_str_eq(row_utc(s, 1), "2016-12-31T23:59:60.000000Z");
    glint_scenario_free(s);
    s = read_with(SOUND, PART_TIME,
                  "[time]\nstart = 2016-12-31T23:59:59Z\nend = \"2016-12-31T23:59:60.5Z\"\n"
                  "step_s = 0.5\n");
    ck_assert_int_eq(s->n_steps, 4);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------------ site, orbit */

START_TEST(test_scenario_observer_keys_and_defaults)
{
    glint_scenario *s = read_with(SOUND, PART_OBSERVER,
                                  "[observer]\nname = \"Vienna\"\nlatitude_deg = -48.25\n"
                                  "longitude_deg = 16\nheight_m = 200\nmin_elevation_deg = 10\n");
    ck_assert_str_eq(s->observers[0].name, "Vienna");
    assert_rel(s->observers[0].site.latitude, -48.25 * PI / 180, rounding);
    assert_rel(s->observers[0].site.longitude, 16 * PI / 180, rounding);
    assert_near(s->observers[0].site.height_m, 200, 0);
    assert_rel(s->observers[0].horizon.least, 10 * PI / 180, rounding);
    glint_scenario_free(s);
    s = read_with(SOUND, PART_OBSERVER, "[observer]\nlatitude_deg = 0\nlongitude_deg = -360\n");
    ck_assert_str_eq(s->observers[0].name, "");
    assert_near(s->observers[0].site.height_m, 0, 0);
    assert_near(s->observers[0].horizon.least, 0, 0);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_scenario_kepler_keys_and_defaults)
{
    glint_scenario *s =
        read_with(SOUND, PART_ORBIT,
                  "[orbit]\nkepler = { semi_major_axis_km = 26562, eccentricity = 0.7, "
                  "inclination_deg = 63.4, raan_deg = -20, argument_of_perigee_deg = 270, "
                  "mean_anomaly_deg = 400, epoch = 2025-07-25T20:36:30Z, j2 = false }\n");
    ck_assert_int_eq(s->orbit.source, ORBIT_KEPLER);
    assert_rel(s->orbit.kepler.semi_major_axis_m, 26562e3, rounding);
    assert_near(s->orbit.kepler.eccentricity, 0.7, 0);
    assert_rel(s->orbit.kepler.inclination, 63.4 * PI / 180, rounding);
    assert_rel(s->orbit.kepler.raan, -20 * PI / 180, rounding);
    assert_rel(s->orbit.kepler.argument_of_perigee, 270 * PI / 180, rounding);
    assert_rel(s->orbit.kepler.mean_anomaly, 400 * PI / 180, rounding);
    assert_near(s->orbit.epoch_s, -30, 1e-9); /* s: rounding of Julian dates */
    ck_assert(!s->orbit.j2);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_scenario_circular_keys_and_defaults)
{
    glint_scenario *s = read_with(SOUND, PART_ORBIT,
                                  "[orbit]\ncircular = { height_km = 500, inclination_deg = 97, "
                                  "raan_deg = 1, argument_of_latitude_deg = -90 }\n");
    ck_assert_int_eq(s->orbit.source, ORBIT_CIRCULAR);
    assert_rel(s->orbit.kepler.semi_major_axis_m, 6878.137e3,
               rounding); /* above the equatorial radius */
    assert_near(s->orbit.kepler.eccentricity, 0, 0);
    assert_rel(s->orbit.kepler.mean_anomaly + s->orbit.kepler.argument_of_perigee, -PI / 2,
               rounding);
    assert_near(s->orbit.epoch_s, 0, 0); /* the start */
    ck_assert(s->orbit.j2);
    glint_scenario_free(s);
    s = read_with(SOUND, PART_ORBIT, "[orbit]\ncircular = { geostationary_longitude_deg = -75 }\n");
    ck_assert_int_eq(s->orbit.source, ORBIT_GEOSTATIONARY);
    assert_rel(s->orbit.geostationary_longitude, -75 * PI / 180, rounding);
    glint_scenario_free(s);
}
END_TEST

#define ISS_LINE1 "1 25544U 98067A   25206.16725053  .00012111  00000+0  21923-3 0  9999"
#define ISS_LINE2 "2 25544  51.6348 118.8254 0002056 114.0852 246.0352 15.50079803521055"
#define GEO_LINE1 "1 90001U 24001A   24080.00000000 -.00000100  00000-0  00000+0 0  9992"
#define GEO_LINE2 "2 90001   0.0400  80.0000 0002000 120.0000 262.0000  1.00271000    11"

START_TEST(test_scenario_element_sets_by_file_name_number_or_lines)
{
    static const struct {
        const char *text;
        int number;
    } all[] = {
        {"tle = \"one.tle\"\n", 25544},
        {"tle = \"two.tle\"\ntle_name = \"iss (zarya)\"\n", 25544},
        {"tle = \"two.tle\"\ntle_number = 90001\n", 90001},
        {"tle = \"two.tle\"\ntle_number = 90001\ntle_name = \"GEO\"\n", 90001},
        {"tle_lines = [\"" ISS_LINE1 "\",\n\"" ISS_LINE2 "\"]\n", 25544},
    };
    write_file("one.tle", ISS_LINE1 "\n" ISS_LINE2 "\n");
    write_file("two.tle",
               "0 ISS (ZARYA)\n" ISS_LINE1 "\n" ISS_LINE2 "\nGEO\n" GEO_LINE1 "\n" GEO_LINE2 "\n");
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        char content[512];
        snprintf(content, sizeof content, "[orbit]\n%s", all[k].text);
        glint_scenario *s = read_with(SOUND, PART_ORBIT, content);
        ck_assert_int_eq(s->orbit.source, ORBIT_TLE);
        ck_assert_int_eq(s->orbit.sets.sets[0].number, all[k].number);
        glint_scenario_free(s);
    }
}
END_TEST

/* The element set of 25 July 2025, 04:00:50 UTC. */
START_TEST(test_scenario_old_element_set_gets_a_warning_that_says_how_old)
{
    static const struct {
        const char *start, *said;
    } all[] = {{"2025-07-25", NULL},
               {"2025-08-08", NULL},
               {"2025-08-09", "14.8 days before"},
               {"2025-09-03", "39.8 days before"},
               {"2025-07-11", "14.2 days after"}};
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        const char *parts[N_PARTS];
        char time[128];
        memcpy(parts, SOUND, sizeof parts);
        snprintf(time, sizeof time, "[time]\nstart = %s\nduration_s = 60\nstep_s = 60\n",
                 all[k].start);
        parts[PART_TIME] = time;
        const marked_text m = with_part(
            parts, PART_ORBIT, "@[orbit]\ntle_lines = [\"" ISS_LINE1 "\",\n\"" ISS_LINE2 "\"]\n");
        const char *path = write_file("scenario.toml", m.text);
        glint_scenario *s;
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(glint_scenario_read(path, NULL, 0, &s, errors), GLINT_OK);
        ck_assert_uint_eq(glint_errors_count(errors), all[k].said != NULL);
        if (all[k].said) {
            const glint_error *e = glint_errors_get(errors, 0);
            ck_assert_int_eq(e->severity, GLINT_WARNING);
            ck_assert_msg(strstr(e->message, all[k].said) != NULL, "%s", e->message);
            ck_assert_int_eq(e->line, m.line);
        }
        glint_scenario_free(s);
        glint_errors_free(errors);
    }
}
END_TEST

/* ------------------------------------------------------------------ attitude */

START_TEST(test_scenario_attitude_laws_are_read)
{
    static const char *const all[] = {
        "law = \"nadir\"\n",
        "law = \"rsw\"\n",
        "law = \"point\"\naxis = [0, 0, 2]\nto = \"nadir\"\nsecond_axis = [1, 0, 0]\n"
        "second_to = \"velocity\"\n",
        "law = \"sun-pointing\"\naxis = [0, 0, 1]\nsecond_axis = [1, 0, 0]\n"
        "second_to = \"orbit-normal\"\n",
        "law = \"inertial\"\nquaternion_wxyz = [0.5, -0.5, 0.5, 0.5]\n",
        "law = \"spin\"\nbody_axis = [3, 0, 4]\npole = { ra_deg = 200, dec_deg = 35 }\n"
        "rate_deg_s = 7\nphase_deg = 25\nepoch = 2025-07-25T20:36:00Z\n",
        "law = \"spin\"\nbody_axis = [0, 0, 1]\npole = \"sun\"\nperiod_s = 30\n",
    };
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        char content[512];
        snprintf(content, sizeof content, "[attitude]\n%s", all[k]);
        glint_scenario *s = read_with(SOUND, PART_ATTITUDE, content);
        ck_assert_msg(strncmp(all[k] + 7, s->attitude.legs[0].law.law->name,
                              strlen(s->attitude.legs[0].law.law->name)) == 0,
                      "%s", s->attitude.legs[0].law.law->name);
        ck_assert(!s->attitude.legs[0].law.has_offset);
        glint_scenario_free(s);
    }
}
END_TEST

START_TEST(test_scenario_spin_and_offset_values)
{
    glint_scenario *s = read_with(
        SOUND, PART_ATTITUDE,
        "[attitude]\nlaw = \"spin\"\nbody_axis = [3, 0, 4]\npole = { ra_deg = 200, dec_deg = 35 }\n"
        "rate_deg_s = 7\nphase_deg = 25\nepoch = 2025-07-25T20:36:00Z\n"
        "offset_deg = { axis = [0, 2, 0], angle = 90 }\n");
    const attitude *a = &s->attitude.legs[0].law;
    assert_vec(a->axis, 0.6, 0, 0.8, rounding);
    assert_rel(a->rate_rad_s, 7 * PI / 180, rounding);
    assert_rel(a->phase_rad, 25 * PI / 180, rounding);
    assert_near(a->epoch_s, -60, 1e-9); /* s: rounding of Julian dates */
    ck_assert_int_eq(a->to.kind, DIRECTION_STAR);
    assert_vec(a->to.star, cos(35 * DEG) * cos(200 * DEG), cos(35 * DEG) * sin(200 * DEG),
               sin(35 * DEG), rounding);
    ck_assert(a->has_offset);
    glint_scenario_free(s);
    s = read_with(SOUND, PART_ATTITUDE,
                  "[attitude]\nlaw = \"spin\"\nbody_axis = [0, 0, 1]\npole = \"north\"\n"
                  "period_s = 30\n");
    assert_rel(s->attitude.legs[0].law.rate_rad_s, 2 * PI / 30, rounding);
    assert_near(s->attitude.legs[0].law.phase_rad, 0, 0);
    assert_near(s->attitude.legs[0].law.epoch_s, 0, 0);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_scenario_every_direction_is_read)
{
    static const struct {
        const char *text;
        direction_kind kind;
    } all[] = {
        {"\"nadir\"", DIRECTION_NADIR},
        {"\"geodetic-nadir\"", DIRECTION_GEODETIC_NADIR},
        {"\"zenith\"", DIRECTION_ZENITH},
        {"\"velocity\"", DIRECTION_VELOCITY},
        {"\"orbit-normal\"", DIRECTION_ORBIT_NORMAL},
        {"\"north\"", DIRECTION_NORTH},
        {"\"sun\"", DIRECTION_SUN},
        {"\"moon\"", DIRECTION_MOON},
        {"\"observer\"", DIRECTION_OBSERVER},
        {"{ ra_deg = 10, dec_deg = -5 }", DIRECTION_STAR},
        {"{ latitude_deg = 10, longitude_deg = -5 }", DIRECTION_PLACE},
        {"{ latitude_deg = 10, longitude_deg = -5, height_m = 4000 }", DIRECTION_PLACE},
    };
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        char content[512];
        snprintf(content, sizeof content,
                 "[attitude]\nlaw = \"point\"\naxis = [0, 0, 1]\nto = %s\nsecond_axis = [1, 0, 0]\n"
                 "second_to = { ra_deg = 77, dec_deg = 11 }\n",
                 all[k].text);
        glint_scenario *s = read_with(SOUND, PART_ATTITUDE, content);
        ck_assert_int_eq(s->attitude.legs[0].law.to.kind, all[k].kind);
        ck_assert_int_eq(s->needs_moon, all[k].kind == DIRECTION_MOON);
        glint_scenario_free(s);
    }
}
END_TEST

/* ------------------------------------------------------------------ settings */

START_TEST(test_scenario_defaults_where_nothing_is_set)
{
    glint_scenario *s = read_with(SOUND, PART_SETTINGS, "");
    ck_assert_int_eq(s->n_bands, 1);
    ck_assert_str_eq(s->bands[0]->name, "V");
    ck_assert_int_eq(s->systems[0], SYSTEM_VEGA);
    ck_assert(!s->has_extinction);
    ck_assert(s->light_time && s->aberration);
    assert_near(s->dut1_s, 0, 0);
    ck_assert_int_eq(s->rows, ROWS_ALL);
    ck_assert_uint_eq(s->shares, SHARES_MATERIAL);
    assert_rel(s->sun_elevation_max, -6 * PI / 180, rounding);
    ck_assert_str_eq(s->title, "a white box");
    ck_assert(!s->has_geometry && !s->needs_moon);
    glint_scenario_free(s);
}
END_TEST

/* Willmer 2018, ApJS 236 47: Vega for U to I and AB for the others unless the scenario says so. */
START_TEST(test_scenario_bands_have_their_zero_points)
{
    static const struct {
        const char *name;
        double usual, ab;
    } all[] = {{"U", -25.97, -25.25},      {"B", -26.13, -26.26},      {"V", -26.76, -26.77},
               {"R", -27.15, -26.97},      {"I", -27.47, -27.06},      {"sdss_u", -25.18, -25.18},
               {"sdss_g", -26.47, -26.47}, {"sdss_r", -26.93, -26.93}, {"sdss_i", -27.05, -27.05},
               {"sdss_z", -27.07, -27.07}, {"lsst_u", -25.30, -25.30}, {"lsst_g", -26.52, -26.52},
               {"lsst_r", -26.93, -26.93}, {"lsst_i", -27.05, -27.05}, {"lsst_z", -27.07, -27.07},
               {"lsst_y", -27.07, -27.07}};
    char list[256] = "", content[512];
    for (size_t k = 0; k < COUNT_OF(all); k++)
        sprintf(list + strlen(list), "%s\"%s\"", k ? ", " : "", all[k].name);
    for (int ab = 0; ab < 2; ab++) {
        snprintf(content, sizeof content, "[photometry]\nbands = [%s]\n%s", list,
                 ab ? "system = \"ab\"\n" : "");
        glint_scenario *s = read_with(SOUND, PART_SETTINGS, content);
        ck_assert_int_eq(s->n_bands, COUNT_OF(all));
        for (size_t k = 0; k < COUNT_OF(all); k++) {
            ck_assert_str_eq(s->bands[k]->name, all[k].name);
            assert_near(s->sun_magnitude[k], ab ? all[k].ab : all[k].usual, 0);
            ck_assert_int_eq(s->systems[k], ab || k > 4 ? SYSTEM_AB : SYSTEM_VEGA);
        }
        glint_scenario_free(s);
    }
}
END_TEST

START_TEST(test_scenario_settings_are_read)
{
    glint_scenario *s = read_with(
        SOUND, PART_SETTINGS,
        "[photometry]\nbands = [\"B\", \"V\"]\nsystem = \"vega\"\nsolar_disc = \"point\"\n"
        "earthshine = false\nextinction = { V = 0.15, B = 0.25 }\n"
        "[corrections]\nlight_time = false\naberration = false\ndut1_s = -0.2\n"
        "[output]\nrows = \"dark-site\"\nshares = \"both\"\nsun_elevation_max_deg = -18\n"
        "[satellite]\nself_shadows = \"none\"\n");
    ck_assert(s->has_extinction);
    assert_near(s->extinction[0], 0.25, 0);
    assert_near(s->extinction[1], 0.15, 0);
    ck_assert(!s->light_time && !s->aberration);
    assert_near(s->dut1_s, -0.2, 0);
    assert_near(s->clock.dut1_s, -0.2, 0);
    ck_assert_int_eq(s->rows, ROWS_DARK_SITE);
    ck_assert_uint_eq(s->shares, SHARES_MATERIAL | SHARES_COMPONENT);
    assert_rel(s->sun_elevation_max, -18 * PI / 180, rounding);
    glint_scenario_free(s);
    static const struct {
        const char *word;
        unsigned shares;
    } shares[] = {{"none", 0}, {"material", SHARES_MATERIAL}, {"component", SHARES_COMPONENT}};
    for (size_t k = 0; k < COUNT_OF(shares); k++) {
        char content[64];
        snprintf(content, sizeof content, "[output]\nshares = \"%s\"\n", shares[k].word);
        s = read_with(SOUND, PART_SETTINGS, content);
        ck_assert_uint_eq(s->shares, shares[k].shares);
        glint_scenario_free(s);
    }
    s = read_with(SOUND, PART_SETTINGS,
                  "[photometry]\nextinction = false\n[output]\nrows = "
                  "\"visible\"\n");
    ck_assert(!s->has_extinction);
    ck_assert_int_eq(s->rows, ROWS_VISIBLE);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------------ given directions */

START_TEST(test_scenario_sweep_moves_the_sun_from_the_second_axis_to_the_first)
{
    glint_scenario *s = read_with(GIVEN, PART_TIME,
                                  "[geometry]\nrange_km = 500\n"
                                  "sweep = { phase_deg = [-30, 90, 60], plane = \"zx\" }\n");
    ck_assert(s->has_geometry);
    ck_assert_int_eq(s->n_steps, 3);
    const double c = cos(PI / 6);
    assert_vec(s->geometry.sun[0], c, 0, -0.5, rounding);
    assert_vec(s->geometry.sun[1], c, 0, 0.5, rounding);
    assert_vec(s->geometry.sun[2], 0, 0, 1, rounding);
    for (int k = 0; k < 3; k++) {
        assert_vec(s->geometry.observer[k], 1, 0, 0, 0);
        assert_near(s->geometry.range_m[k], 500e3, 0);
        assert_near(s->geometry.t_s[k], k, 0);
    }
    glint_scenario_free(s);
    s = read_with(GIVEN, PART_TIME,
                  "[geometry]\nsweep = { phase_deg = [0, 0.3, 0.1], plane = \"xy\" }\n");
    ck_assert_int_eq(s->n_steps, 4); /* the end belongs to it, rounding or not */
    assert_near(s->geometry.range_m[0], 1e6, 0);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_scenario_rotate_turns_the_satellite_right_handed)
{
    glint_scenario *s = read_with(GIVEN, PART_TIME,
                                  "[geometry]\nrotate = { axis = [0, 0, 5], step_deg = 90, "
                                  "sun = [2, 0, 0], observer = [0, 0, 1] }\n");
    ck_assert_int_eq(s->n_steps, 4);
    assert_vec(s->geometry.sun[0], 1, 0, 0, 0);
    assert_vec(s->geometry.sun[1], 0, -1, 0, rounding); /* the body turns, the Sun stays */
    assert_vec(s->geometry.sun[2], -1, 0, 0, rounding);
    assert_vec(s->geometry.sun[3], 0, 1, 0, rounding);
    for (int k = 0; k < 4; k++)
        assert_vec(s->geometry.observer[k], 0, 0, 1, rounding);
    glint_scenario_free(s);
    static const struct {
        const char *step;
        long long n;
    } counts[] = {{"360", 1}, {"120", 3}, {"100", 4}, {"0.1", 3600}, {"0.7", 515}};
    for (size_t k = 0; k < COUNT_OF(counts); k++) {
        char content[256];
        snprintf(content, sizeof content,
                 "[geometry]\nrotate = { axis = [0, 0, 1], step_deg = %s, sun = [1, 0, 0], "
                 "observer = [0, 0, 1] }\n",
                 counts[k].step);
        s = read_with(GIVEN, PART_TIME, content);
        ck_assert_int_eq(s->n_steps, counts[k].n); /* k step < 360 */
        glint_scenario_free(s);
    }
}
END_TEST

START_TEST(test_scenario_table_of_directions_is_made_unit)
{
    write_file("d.csv", "# directions\nobs_x,obs_y,obs_z,sun_x,sun_y,sun_z,note\n"
                        "3,0,4,0,0,-1e-300,a\n1e300,0,0,-7,0,0,b\n");
    glint_scenario *s =
        read_with(GIVEN, PART_TIME, "[geometry]\ntable = \"d.csv\"\nrange_km = 2\n");
    ck_assert_int_eq(s->n_steps, 2);
    assert_vec(s->geometry.observer[0], 0.6, 0, 0.8, rounding);
    assert_vec(s->geometry.observer[1], 1, 0, 0, 0);
    assert_vec(s->geometry.sun[0], 0, 0, -1, 0);
    assert_vec(s->geometry.sun[1], -1, 0, 0, 0);
    for (int k = 0; k < 2; k++) {
        assert_near(s->geometry.range_m[k], 2e3, 0);
        assert_near(s->geometry.t_s[k], k, 0);
    }
    glint_scenario_free(s);
    write_file("d.csv", "sun_x,sun_y,sun_z,obs_x,obs_y,obs_z,range_km,t_s\n"
                        "1,0,0,1,0,0,36000.5,-3\n1,0,0,1,0,0,0.001,1e4\n");
    s = read_with(GIVEN, PART_TIME, "[geometry]\ntable = \"d.csv\"\nrange_km = 2\n");
    assert_rel(s->geometry.range_m[0], 36000.5e3, rounding);
    assert_rel(s->geometry.range_m[1], 1, rounding);
    assert_near(s->geometry.t_s[0], -3, 0);
    assert_near(s->geometry.t_s[1], 1e4, 0);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------------ expectations */

START_TEST(test_scenario_expectations_are_read)
{
    write_file("expected.csv", "t_s,mag_V,range_km\n0,1,2\n");
    const marked_text m = with_part(
        SOUND, PART_EXPECT,
        "[[expect]]\nt_s = 10\ncolumn = \"mag_V\"\nvalue = 5\ntolerance = 1e-9\nsource = \"me\"\n"
        "[[expect]]\nrow = 3\ncolumn = \"range_km\"\nvalue = 7.5\nrelative = 1e-12\n"
        "[expect_table]\nfile = \"expected.csv\"\nrelative = { mag_V = 1e-12 }\n"
        "tolerance = { mag_V = 0.5, range_km = 1 }\n"
        "[[require]]\ncolumn = \"mag_V\"\nfainter_than = 7\nfor_fraction = 0.99\n"
        "reference_height_km = 550\n"
        "when = { sun_elevation_deg = [-90, -12], elevation_deg = [20, 90] }\n"
        "[[require]]\ncolumn = \"mag_V\"\nfainter_than = 8.5\n");
    glint_scenario *s = read_sound(write_file("scenario.toml", m.text));
    ck_assert_int_eq(s->n_expectations, 2);
    ck_assert(!s->expectations[0].by_row && s->expectations[1].by_row);
    assert_near(s->expectations[0].t_s, 10, 0);
    ck_assert_int_eq(s->expectations[1].row, 3);
    ck_assert_str_eq(s->expectations[0].source, "me");
    assert_near(s->expectations[0].absolute, 1e-9, 0);
    assert_near(s->expectations[0].relative, 0, 0);
    assert_near(s->expectations[1].relative, 1e-12, 0);
    ck_assert(s->has_expected_table);
    ck_assert_int_eq(s->expected.n_columns, 2);
    ck_assert_int_eq(s->n_requirements, 2);
    const requirement *r = &s->requirements[0];
    assert_near(r->fainter_than, 7, 0);
    assert_near(r->for_fraction, 0.99, 0);
    ck_assert(r->has_reference);
    assert_near(r->reference_height_m, 550e3, 0);
    ck_assert_int_eq(r->n_when, 2);
    ck_assert_str_eq(r->when[1].column, "elevation_deg");
    assert_near(r->when[1].lo, 20, 0);
    assert_near(r->when[1].hi, 90, 0);
    assert_near(s->requirements[1].for_fraction, 1, 0); /* all rows where nothing is said */
    ck_assert(!s->requirements[1].has_reference);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------------ overrides */

START_TEST(test_scenario_overrides_of_every_kind)
{
    const marked_text m = with_part(SOUND, PART_TOP, "");
    const char *path = write_file("scenario.toml", m.text);
    const char *const set[] = {
        "time.step_s=0.5",                                  /* a number, */
        "title='set'",                                      /* a key that was not there, */
        "photometry.bands=[\"B\", \"V\"]",                  /* a table that was not there, */
        "observer={ latitude_deg = 1, longitude_deg = 2 }", /* a whole table, */
        "orbit.circular.raan_deg = 90 ", /* a key of a table in braces, with blanks, */
        "component.0.box.0.size_m.2=7",  /* a number of an array, */
        "component.0.name=\"body\"",     /* a text in an array of tables, */
        "materials.white.rho=0.25",      /* a key of a model */
        "time.step_s=1.5",               /* and one once more: the last counts */
    };
    glint_scenario *s = read_sound_set(path, set, COUNT_OF(set));
    assert_near(s->step_s, 1.5, 0);
    ck_assert_int_eq(s->n_steps, 41);
    ck_assert_str_eq(s->title, "set");
    ck_assert_int_eq(s->n_bands, 2);
    assert_rel(s->observers[0].site.longitude, 2 * PI / 180, rounding);
    assert_rel(s->orbit.kepler.raan, PI / 2, rounding);
    assert_rel(s->orbit.kepler.inclination, 98.6 * PI / 180, rounding);
    ck_assert_str_eq(s->satellite.components[0].name, "body");
    assert_near(s->satellite.materials[0].bands[0].lobes[0].params[0], 0.25, 0);
    assert_rel(model_material_area(&s->satellite.model, 0, NULL), 2 * (1 + 7 + 7), 1e-14);
    ck_assert_uint_eq(s->n_overrides, COUNT_OF(set));
    ck_assert_str_eq(s->overrides[0], set[0]);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_scenario_override_of_a_model_file_goes_to_the_model)
{
    write_file("model.toml", "[materials.white]\nbrdf = \"lambert\"\nrho = 0.5\n"
                             "[[component]]\nname = \"ball\"\n"
                             "[[component.plate]]\nsize_m = [1, 1]\nnormal = [0, 0, 1]\n"
                             "tangent = [1, 0, 0]\nmaterial = \"white\"\n");
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_MATERIAL] = parts[PART_COMPONENT] = parts[PART_PRIMITIVE] = NULL;
    const marked_text m = with_part(parts, PART_SATELLITE, "[satellite]\nmodel = \"model.toml\"\n");
    const char *path = write_file("scenario.toml", m.text);
    const char *const set[] = {"materials.white.rho=0.75", "component.0.plate.0.size_m=[2, 3]"};
    glint_scenario *s = read_sound_set(path, set, 2);
    assert_near(s->satellite.materials[0].bands[0].lobes[0].params[0], 0.75, 0);
    assert_rel(model_material_area(&s->satellite.model, 0, NULL), 6, 1e-15);
    glint_scenario_free(s);

    /* Another model: the path of a --set is relative to the working folder. */
    write_file("other.toml", "[materials.grey]\nbrdf = \"lambert\"\nrho = 0.1\n"
                             "[[component]]\nname = \"ball\"\n[[component.sphere]]\nradius_m = 1\n"
                             "material = \"grey\"\n");
    char other[600];
    snprintf(other, sizeof other, "satellite.model=\"%s\"", in_folder("other.toml"));
    const char *const set_model[] = {other};
    s = read_sound_set(path, set_model, 1);
    ck_assert_str_eq(s->satellite.materials[0].name, "grey");
    glint_scenario_free(s);
}
END_TEST

static Suite *scenario_suite(void)
{
    Suite *suite = suite_create("scenario");
    TCase *tables = tcase_create("tables");
    tcase_set_timeout(tables, 60);
    tcase_add_checked_fixture(tables, folder_make, folder_remove);
    tcase_add_test(tables, test_scenario_time_gives_rows_up_to_its_end);
    tcase_add_test(tables, test_scenario_start_in_every_form_is_the_same_moment);
    tcase_add_test(tables, test_scenario_leap_second_can_be_said);
    tcase_add_test(tables, test_scenario_observer_keys_and_defaults);
    tcase_add_test(tables, test_scenario_kepler_keys_and_defaults);
    tcase_add_test(tables, test_scenario_circular_keys_and_defaults);
    tcase_add_test(tables, test_scenario_element_sets_by_file_name_number_or_lines);
    tcase_add_test(tables, test_scenario_old_element_set_gets_a_warning_that_says_how_old);
    tcase_add_test(tables, test_scenario_attitude_laws_are_read);
    tcase_add_test(tables, test_scenario_spin_and_offset_values);
    tcase_add_test(tables, test_scenario_every_direction_is_read);
    tcase_add_test(tables, test_scenario_defaults_where_nothing_is_set);
    tcase_add_test(tables, test_scenario_bands_have_their_zero_points);
    tcase_add_test(tables, test_scenario_settings_are_read);
    tcase_add_test(tables, test_scenario_sweep_moves_the_sun_from_the_second_axis_to_the_first);
    tcase_add_test(tables, test_scenario_rotate_turns_the_satellite_right_handed);
    tcase_add_test(tables, test_scenario_table_of_directions_is_made_unit);
    tcase_add_test(tables, test_scenario_expectations_are_read);
    tcase_add_test(tables, test_scenario_overrides_of_every_kind);
    tcase_add_test(tables, test_scenario_override_of_a_model_file_goes_to_the_model);
    suite_add_tcase(suite, tables);
    return suite;
}

int main(void)
{
    return run_suite(scenario_suite());
}
