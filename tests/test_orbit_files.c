/* [orbit] from files: messages, tables of positions, and several element sets of one satellite. */
#include "base/constants.h"
#include "base/random.h"
#include "base/text.h"
#include "base/vec.h"
#include "scenario/scenario.h"
#include "scenario_text.h"

/* The ISS of 25 July 2025, and two made-up later sets of it; all with their own place in the orbit,
 * so that there are jumps. */
#define ISS_A1 "1 25544U 98067A   25206.16725053  .00012111  00000+0  21923-3 0  9999"
#define ISS_A2 "2 25544  51.6348 118.8254 0002056 114.0852 246.0352 15.50079803521055"

/* ------------------------------------------------------------------- messages */

static void copy_here(const char *name)
{
    size_t n;
    char path[1024];
    snprintf(path, sizeof path, "%s/messages/%s", TEST_DATA_DIR, name);
    char *bytes = read_bytes(path, &n);
    write_bytes(name, bytes, n);
    free(bytes);
}

/* A state of the scenario's orbit in TEME or another frame of its own: no frames are needed to
 * compare two orbits of one kind. */
static void state_at(const orbit *o, double t_s, double r_m[3], double v_m_s[3])
{
    frame_set frames = {0};
    mat_identity(frames.gcrs_teme);
    mat_identity(frames.itrs_gcrs);
    glint_error error = {0};
    ck_assert_msg(orbit_state(o, t_s, &frames, NULL, r_m, v_m_s, &error) == GLINT_OK, "%s",
                  error.message);
}

static double distance_m(const orbit *a, const orbit *b, double t_s)
{
    double ra_m[3], rb_m[3], unused[3];
    state_at(a, t_s, ra_m, unused);
    state_at(b, t_s, rb_m, unused);
    sub3(ra_m, rb_m, ra_m);
    return norm3(ra_m);
}

START_TEST(test_orbit_files_omm_gives_the_orbit_of_two_lines)
{
    static const char *const texts[] = {
        "[orbit]\nomm = \"iss.omm\"\n", "[orbit]\nomm = \"iss.xml\"\n",
        "[orbit]\nomm = \"iss.json\"\ntle_name = \"iss (zarya)\"\n",
        "[orbit]\nomm = \"iss.csv\"\ntle_designator = \"1998-067A\"\n",
        "[orbit]\nomm = \"iss.csv\"\ntle_number = 25544\n"};
    copy_here("iss.omm");
    copy_here("iss.xml");
    copy_here("iss.json");
    copy_here("iss.csv");
    glint_scenario *lines =
        read_with(SOUND, PART_ORBIT, "[orbit]\ntle_lines = [\"" ISS_A1 "\",\n\"" ISS_A2 "\"]\n");
    for (size_t k = 0; k < COUNT_OF(texts); k++) {
        glint_scenario *s = read_with(SOUND, PART_ORBIT, texts[k]);
        for (double t_s = 0; t_s <= 60; t_s += 20) /* m: 1e-15 of angles */
            assert_near(distance_m(s->orbit.propagator, lines->orbit.propagator, t_s), 0, 1e-6);
        glint_scenario_free(s);
    }
    glint_scenario_free(lines);
}
END_TEST

/* --------------------------------------------------------- several element sets */

/* The ISS's set with another day of the year and another mean anomaly (deg), in steps of 0.01. */
static tle set_of(double day, double anomaly_deg)
{
    char line1[80], line2[80];
    snprintf(line1, sizeof line1, "%.20s%012.8f%s", ISS_A1, day, &ISS_A1[32]);
    snprintf(line2, sizeof line2, "%.43s%8.4f%s", ISS_A2, anomaly_deg, &ISS_A2[51]);
    tle out;
    glint_error error = {0};
    ck_assert_msg(tle_parse(line1, line2, false, PLACE_NONE, NULL, &out, &error) == GLINT_OK,
                  "%s\n%s\n%s", error.message, line1, line2);
    return out;
}

/* At every moment the set with the nearest epoch, bit by bit; the earlier one halfway. */
START_TEST(test_orbit_sets_take_turns_at_the_midpoints)
{
    const tle sets[3] = {set_of(206, 10), set_of(206.5, 11), set_of(208, 12)};
    const utc_time start = {2025, 7, 25, 0, 0, 0.0}; /* day 206 */
    run_clock clock;
    run_clock_start(&start, 3 * DAY_S, 0, &clock);
    orbit *all, *one[3];
    ck_assert_int_eq(orbit_from_sets(sets, 3, &clock, 0, 3 * DAY_S, &all, NULL), GLINT_OK);
    for (int k = 0; k < 3; k++)
        ck_assert_int_eq(orbit_from_sets(&sets[k], 1, &clock, 0, 0, &one[k], NULL), GLINT_OK);
    static const double switches_s[2] = {0.25 * 86400, 1.25 * 86400}; /* halfway between epochs */
    for (double t_s = -3600; t_s < 3 * DAY_S; t_s += 1800) {
        const int k = t_s <= switches_s[0] ? 0 : t_s <= switches_s[1] ? 1 : 2;
        ck_assert_msg(distance_m(all, one[k], t_s) == 0.0, "t_s = %g", t_s);
    }
    for (int k = 0; k < 2; k++) {
        /* epochs as JDs are known to 4e-11 d or less, and so are the moments between */
        ck_assert(distance_m(all, one[k], switches_s[k] - 1e-5) == 0.0);
        ck_assert(distance_m(all, one[k + 1], switches_s[k] + 1e-5) == 0.0);
    }
    size_t n;
    const orbit_set_use *uses = orbit_sets(all, &n);
    ck_assert_uint_eq(n, 3);
    for (size_t k = 0; k < 3; k++) {
        ck_assert_uint_eq(uses[k].index, k);
        ck_assert_int_eq(uses[k].has_jump, k > 0);
        if (k == 0) continue;
        assert_near(uses[k].from_s, switches_s[k - 1], 1e-5);
        assert_near(uses[k - 1].to_s, uses[k].from_s, 0.0);
        assert_near(uses[k].jump_m, distance_m(one[k - 1], one[k], uses[k].from_s), 0.0);
        ck_assert(uses[k].jump_m > 1e3); /* a degree of the orbit is 118 km */
    }
    for (int k = 0; k < 3; k++)
        orbit_free(one[k]);
    orbit_free(all);
}
END_TEST

/* What a thread remembers of one resonant set does not reach into the next: not by one bit. */
START_TEST(test_orbit_sets_do_not_depend_on_the_cursor)
{
    tle sets[3];
    static const char *const epochs[3] = {"24001.50000000", "24002.50000000", "24004.00000000"};
    for (int k = 0; k < 3; k++) {
        char line1[80];
        snprintf(line1, sizeof line1, "1 99901U 24001A   %s  .00000010  00000-0  00000+0 0  9997",
                 epochs[k]);
        ck_assert_int_eq(tle_parse(line1,
                                   "2 99901  63.4000 120.0000 7400000 270.0000  10.0000  "
                                   "2.00600000    16",
                                   false, PLACE_NONE, NULL, &sets[k], NULL),
                         GLINT_OK);
    }
    const utc_time start = {2024, 1, 1, 0, 0, 0.0};
    run_clock clock;
    run_clock_start(&start, 6 * DAY_S, 0, &clock);
    orbit *o;
    ck_assert_int_eq(orbit_from_sets(sets, 3, &clock, 0, 6 * DAY_S, &o, NULL), GLINT_OK);
    orbit_cursor cursor = {0};
    frame_set frames = {0};
    mat_identity(frames.gcrs_teme);
    uint64_t seed = 3;
    for (int k = 0; k < 500; k++) {
        const double t_s = 6 * DAY_S * (k < 250 ? k / 250.0 : random_even(&seed));
        double with[6], without[6];
        ck_assert_int_eq(orbit_state(o, t_s, &frames, &cursor, with, with + 3, NULL), GLINT_OK);
        ck_assert_int_eq(orbit_state(o, t_s, &frames, NULL, without, without + 3, NULL), GLINT_OK);
        ck_assert_mem_eq(with, without, sizeof with);
    }
    orbit_free(o);
}
END_TEST

START_TEST(test_orbit_sets_that_no_moment_needs_are_left_out)
{
    const tle sets[4] = {set_of(204, 10), set_of(205, 11), set_of(206, 12), set_of(207, 13)};
    const utc_time start = {2025, 7, 25, 0, 0, 0.0};
    run_clock clock;
    run_clock_start(&start, DAY_S, 0, &clock);
    static const struct {
        double from_s, to_s;
        size_t n, first;
    } cases[] = {{-3600, 3600, 1, 2}, {-86400, 0, 2, 1},
                 {-1e6, 1e6, 4, 0},   {-43200 - 1, -43200 + 1, 2, 1},
                 {1e6, 2e6, 1, 3},    {-2e6, -1e6, 1, 0}};
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        orbit *o;
        size_t n;
        ck_assert_int_eq(orbit_from_sets(sets, 4, &clock, cases[k].from_s, cases[k].to_s, &o, NULL),
                         GLINT_OK);
        ck_assert_uint_eq(orbit_sets(o, &n)->index, cases[k].first);
        ck_assert_uint_eq(n, cases[k].n);
        orbit_free(o);
    }
}
END_TEST

/* What a report says of the run. */
static char *report_of(const char *path)
{
    char *report;
    glint_errors *errors = glint_errors_new();
    ck_assert_msg(glint_check(path, NULL, 0, &report, errors) == GLINT_OK, "%s",
                  list_errors(errors));
    glint_errors_free(errors);
    return report;
}

static void assert_reported(const char *path, const char *const *words, size_t n)
{
    char *report = report_of(path);
    for (size_t k = 0; k < n; k++)
        ck_assert_msg(strstr(report, words[k]) != NULL, "'%s' is not in:\n%s", words[k], report);
    glint_free(report);
}

/* Two sets 12 h apart, midnight and noon of 25 July; the run goes from 05:59 to 06:01. */
START_TEST(test_orbit_files_report_names_the_sets_in_use)
{
    static const char *const words[] = {
        "2 element sets of ISS (ZARYA), number 25544, at any time the one whose epoch is nearest",
        "element_sets",
        "epoch 2025-07-25T00:00:00Z, at most 0.250 days away; epoch "
        "2025-07-25T12:00:00Z from 2025-07-25T06:00:00Z, at most 0.250 days away, "
        "jump "};
    static const char content[] =
        "OBJECT_NAME,NORAD_CAT_ID,EPOCH,MEAN_MOTION,ECCENTRICITY,INCLINATION,RA_OF_ASC_NODE,"
        "ARG_OF_PERICENTER,MEAN_ANOMALY,BSTAR\n"
        "ISS (ZARYA),25544,2025-07-25T00:00:00,15.5,.0002,51.6,118,114,10,0\n"
        "ISS (ZARYA),25544,2025-07-25T12:00:00,15.5,.0002,51.6,116,116,280,0\n"
        "ISS (ZARYA),25544,2025-07-28T12:00:00,15.5,.0002,51.6,100,116,200,0\n";
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T05:59:00Z\nduration_s = 120\nstep_s = 10\n";
    write_file("sets.csv", content);
    const marked_text m = with_part(parts, PART_ORBIT, "[orbit]\nomm = \"sets.csv\"\n");
    assert_reported(write_file("scenario.toml", m.text), words, COUNT_OF(words));
}
END_TEST

/* --------------------------------------------------------------------- tables */

/* A row a minute of straight motion, 900 km above a place near the observer. */
static const char *write_rows(text *out, int from_minute, int to_minute)
{
    text_add(out, "META_START\nOBJECT_NAME = CUBE\nOBJECT_ID = 2025-001A\nCENTER_NAME = EARTH\n"
                  "REF_FRAME = ITRF2020\nTIME_SYSTEM = UTC\nINTERPOLATION = LAGRANGE\n"
                  "INTERPOLATION_DEGREE = 3\nMETA_STOP\n");
    for (int k = from_minute; k <= to_minute; k++)
        text_printf(out, "2025-07-25T20:%02d:00 6200 1380 %d 0 0 7\n", k, 5400 + 420 * (k - 37));
    return out->data;
}

/* A scenario of 60 s from 20:37:00 with a table of these minutes, in two segments or one. */
static const char *write_scenario(int from, int to, int again, int end, bool light_time,
                                  marked_text *m)
{
    text table = {0};
    text_add(&table, "CCSDS_OEM_VERS = 2.0\n");
    write_rows(&table, from, to);
    if (end) write_rows(&table, again, end);
    write_bytes("cube.oem", table.data, table.length);
    text_free(&table);
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_SETTINGS] = light_time ? "" : "[corrections]\nlight_time = false\n";
    *m = with_part(parts, PART_ORBIT, "@[orbit]\noem = \"cube.oem\"\n");
    return write_file("scenario.toml", m->text);
}

START_TEST(test_orbit_files_run_must_lie_inside_the_table)
{
    static const struct {
        int from, to, again, end;
        bool light_time;
        const char *found, *expected; /* NULL: good */
    } cases[] = {
        {35, 40, 0, 0, true, NULL, NULL},
        {36, 38, 0, 0, true, NULL, NULL},  /* to the last moment */
        {37, 38, 0, 0, false, NULL, NULL}, /* and from the first */
        {37, 40, 0, 0, true, "begins at 2025-07-25T20:37:00.000000Z UTC",
         "light time asks for up to 0.0494 s: begin the run that much later"},
        {38, 45, 0, 0, true,
         "goes from 2025-07-25T20:38:00.000000Z to 2025-07-25T20:45:00.000000Z UTC",
         "the run from 2025-07-25T20:37:00.000000Z to 2025-07-25T20:38:00.000000Z UTC"},
        {30, 37, 0, 0, true, "goes from 2025-07-25T20:30:00.000000Z",
         "expected a run inside the table"},
        {30, 36, 37, 40, true,
         "gap from 2025-07-25T20:36:00.000000Z to 2025-07-25T20:37:00.000000Z", "between gaps"},
        {30, 36, 38, 40, true,
         "gap from 2025-07-25T20:36:00.000000Z to 2025-07-25T20:38:00.000000Z", "between gaps"},
        {30, 36, 37, 40, false, NULL, NULL},
        {30, 38, 39, 42, true, NULL, NULL},
    };
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        marked_text m;
        const char *path = write_scenario(cases[k].from, cases[k].to, cases[k].again, cases[k].end,
                                          cases[k].light_time, &m);
        if (cases[k].found)
            assert_refused_set(path, NULL, 0, path, m.line, m.column, cases[k].found,
                               cases[k].expected, 1);
        else
            glint_scenario_free(read_sound(path));
    }
}
END_TEST

START_TEST(test_orbit_files_report_describes_the_table)
{
    static const char *const words[] = {
        "positions of CUBE, id 2025-001A (OEM): 11 records in ITRF2020, from 2025-07-25T20:30:00Z "
        "to 2025-07-25T20:40:00Z, Lagrange interpolation of degree 3, good to"};
    marked_text m;
    assert_reported(write_scenario(30, 40, 0, 0, true, &m), words, COUNT_OF(words));
}
END_TEST

/* The other files of positions come the same way. */
START_TEST(test_orbit_files_take_stk_and_sp3)
{
    text stk = {0}, sp3 = {0};
    text_add(&stk, "stk.v.11.0\nBEGIN Ephemeris\nScenarioEpoch 25 Jul 2025 20:30:00.000\n"
                   "CoordinateSystem Fixed\nInterpolationSamplesM1 3\nEphemerisTimePos\n");
    text_add(&sp3, "#cP2025  7 25 20 30  0.00000000      11 ORBIT IGS20 HLM  IGS\n"
                   "## 2376 388800.00000000    60.00000000 60880 0.5000000000000\n"
                   "+    1   G01\n%c G  cc UTC\n");
    for (int k = 0; k <= 10; k++) {
        text_printf(&stk, "%d 6200000 1380000 %d\n", 60 * k, 2460000 + 420000 * k);
        text_printf(&sp3,
                    "*  2025  7 25 20 %d  0.00000000\nPG01   6200.000000   1380.000000 %13.6f\n",
                    30 + k, 2460.0 + 420.0 * k);
    }
    text_add(&stk, "END Ephemeris\n");
    text_add(&sp3, "EOF\n");
    write_bytes("cube.e", stk.data, stk.length);
    write_bytes("cube.sp3", sp3.data, sp3.length);
    text_free(&stk);
    text_free(&sp3);
    marked_text m;
    glint_scenario *oem = read_sound(write_scenario(30, 40, 0, 0, true, &m));
    static const char *const texts[] = {"[orbit]\nstk = \"cube.e\"\n",
                                        "[orbit]\nsp3 = \"cube.sp3\"\nsp3_satellite = \"G01\"\n"};
    for (size_t k = 0; k < COUNT_OF(texts); k++) {
        glint_scenario *s = read_with(SOUND, PART_ORBIT, texts[k]);
        ck_assert_int_eq(s->orbit.source, ORBIT_POSITIONS);
        for (double t_s = 0; t_s <= 60; t_s += 7) /* m: rounding of dates, 5e-12 s at 7 km/s */
            assert_near(distance_m(s->orbit.propagator, oem->orbit.propagator, t_s), 0, 1e-6);
        glint_scenario_free(s);
    }
    glint_scenario_free(oem);
}
END_TEST

/* The whole way to a light curve: straight motion in ITRS gives these ranges. */
START_TEST(test_orbit_files_table_reaches_the_light_curve)
{
    marked_text m;
    glint_scenario *s = read_sound(write_scenario(30, 40, 0, 0, false, &m));
    glint_curve *curve;
    earth_site site;
    ck_assert_int_eq(earth_site_at(48.2 * DEG, 16.37 * DEG, 0, &site, NULL), GLINT_OK);
    const glint_row *rows;
    size_t n;
    glint_error error = {0};
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    ck_assert_msg(glint_curve_next(curve, &rows, &n, &error) == GLINT_OK, "%s", error.message);
    ck_assert_uint_eq(n, 7);
    for (int k = 0; k < 7; k++) {
        const double at_m[3] = {6200e3, 1380e3, 5400e3 + 7e3 * rows[k].t_s};
        double sight[3];
        sub3(at_m, site.r_itrs_m, sight);
        assert_near(rows[k].range_m, norm3(sight), 1e-6);
    }
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

/* A run over all of a table: searches for passes and rates reach no farther than it answers. */
START_TEST(test_orbit_files_passes_and_ephemeris_keep_to_the_table)
{
    marked_text m;
    glint_scenario *s = read_sound(write_scenario(37, 38, 0, 0, false, &m));
    glint_error error = {0};
    glint_passes *passes;
    glint_ephemeris *ephemeris;
    ck_assert_msg(glint_passes_find(s, NULL, &passes, &error) == GLINT_OK, "%s", error.message);
    ck_assert_uint_eq(glint_passes_count(passes), 1);
    glint_passes_free(passes);
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &ephemeris, &error), GLINT_OK);
    const glint_ephemeris_row *rows;
    size_t n;
    ck_assert_msg(glint_ephemeris_next(ephemeris, &rows, &n, &error) == GLINT_OK, "%s",
                  error.message);
    ck_assert_uint_eq(n, 7);
    glint_ephemeris_close(ephemeris);
    glint_scenario_free(s);
}
END_TEST

/* Records an hour apart cannot say where a low satellite is. */
START_TEST(test_orbit_files_records_far_apart_get_a_warning)
{
    const kepler_elements low = {6.8e6, 0.001, 0.9, 1.0, 0.5, 0.2};
    kepler_orbit kepler;
    ck_assert_int_eq(kepler_start(&low, EARTH_MU_M3_S2, 0, EARTH_RADIUS_M, &kepler, NULL),
                     GLINT_OK);
    text table = {0};
    text_add(&table, "CCSDS_OEM_VERS = 2.0\nMETA_START\nOBJECT_NAME = CUBE\nCENTER_NAME = EARTH\n"
                     "REF_FRAME = GCRF\nTIME_SYSTEM = UTC\nMETA_STOP\n");
    for (int hour = 15; hour < 24; hour++) {
        double r_m[3], v_m_s[3];
        kepler_state(&kepler, 3600.0 * hour, r_m, v_m_s);
        text_printf(&table, "2025-07-25T%02d:00:00 %.9f %.9f %.9f %.9f %.9f %.9f\n", hour,
                    r_m[0] * 1e-3, r_m[1] * 1e-3, r_m[2] * 1e-3, v_m_s[0] * 1e-3, v_m_s[1] * 1e-3,
                    v_m_s[2] * 1e-3);
    }
    write_bytes("cube.oem", table.data, table.length);
    text_free(&table);
    const marked_text m = with_part(SOUND, PART_ORBIT, "@[orbit]\noem = \"cube.oem\"\n");
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(glint_scenario_read(write_file("scenario.toml", m.text), NULL, 0, &s, errors),
                     GLINT_OK);
    ck_assert_uint_eq(glint_errors_count(errors), 1);
    const glint_error *warning = glint_errors_get(errors, 0);
    ck_assert_int_eq(warning->line, m.line);
    ck_assert_msg(strstr(warning->message, "far apart") != NULL, "%s", warning->message);
    glint_scenario_free(s);
    glint_errors_free(errors);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("orbit_files");
    TCase *all = tcase_create("all");
    tcase_add_checked_fixture(all, folder_make, folder_remove);
    tcase_add_test(all, test_orbit_files_omm_gives_the_orbit_of_two_lines);
    tcase_add_test(all, test_orbit_sets_take_turns_at_the_midpoints);
    tcase_add_test(all, test_orbit_sets_do_not_depend_on_the_cursor);
    tcase_add_test(all, test_orbit_sets_that_no_moment_needs_are_left_out);
    tcase_add_test(all, test_orbit_files_report_names_the_sets_in_use);
    tcase_add_test(all, test_orbit_files_run_must_lie_inside_the_table);
    tcase_add_test(all, test_orbit_files_report_describes_the_table);
    tcase_add_test(all, test_orbit_files_take_stk_and_sp3);
    tcase_add_test(all, test_orbit_files_table_reaches_the_light_curve);
    tcase_add_test(all, test_orbit_files_passes_and_ephemeris_keep_to_the_table);
    tcase_add_test(all, test_orbit_files_records_far_apart_get_a_warning);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
