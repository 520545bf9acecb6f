/* Passes: rise, culmination and set against an independent program; the Earth's shadow, darkness,
 * brightness and flashes against closed forms and against light curves. */
#include "base/constants.h"
#include "base/roots.h"
#include "base/vec.h"
#include "orbit/frames.h"
#include "scenario/scenario.h"
#include "scenario_text.h"
#include "table.h"

/* ------------------------------------------------------------------ helpers */

/* The parts of a scenario without a satellite. */
static const char *const ISS_OBSERVER[] = {
    "[observer]\nlatitude_deg = 48.2\nlongitude_deg = 16.37\nheight_m = 200\n"
    "min_elevation_deg = 10\n",
    "[observer]\nlatitude_deg = 19.8207\nlongitude_deg = -155.4681\nheight_m = 4205\n"
    "min_elevation_deg = 10\n"};

/* Synthetic elements of the space station's kind, those of the reference table. */
static const char ISS_ORBIT[] =
    "[orbit]\ntle_lines = [\n"
    "\"1 25544U 98067A   24001.50000000  .00016717  00000-0  30270-3 0  9999\",\n"
    "\"2 25544  51.6400 208.9163 0006317  69.9862 290.2553 15.49560532 10001\"]\n";
static const char GEO_ORBIT[] =
    "[orbit]\ntle_lines = [\n"
    "\"1 41866U 16071A   24001.50000000 -.00000100  00000-0  00000+0 0  9993\",\n"
    "\"2 41866   0.0300  90.0000 0001000 100.0000 262.0000  1.00271000 26000\"]\n";
static const char MOLNIYA_ORBIT[] =
    "[orbit]\ntle_lines = [\n"
    "\"1 99901U 24001A   24001.50000000  .00000010  00000-0  00000+0 0  9997\",\n"
    "\"2 99901  63.4000 120.0000 7400000 270.0000  10.0000  2.00600000    16\"]\n";
static const char GNSS_ORBIT[] =
    "[orbit]\ntle_lines = [\n"
    "\"1 90005U 24001A   24001.50000000  .00000000  00000-0  00000+0 0  9992\",\n"
    "\"2 90005  55.0000 200.0000 0100000  30.0000 330.0000  2.00562000    14\"]\n";
static const char RETROGRADE_ORBIT[] =
    "[orbit]\ntle_lines = [\n"
    "\"1 90002U 24001A   24001.50000000  .00000000  00000-0  10000-4 0  9995\",\n"
    "\"2 90002  98.2000  15.0000 0010000  90.0000 270.0000 14.57000000    15\"]\n";
static const char PLAIN[] = "[corrections]\nlight_time = false\n";

static glint_scenario *read_orbit_only(const char *time, const char *observer,
                                       const char *orbit_text, const char *rest)
{
    char text[TEXT_SIZE];
    snprintf(text, sizeof text, "%s%s%s%s", time, observer, orbit_text, rest);
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    ck_assert_msg(glint_scenario_read_orbit(write_file("orbit_text.toml", text), NULL, 0, &s,
                                            errors) == GLINT_OK,
                  "%s", list_errors(errors));
    glint_errors_free(errors);
    return s;
}

static glint_passes *find(const glint_scenario *s, double flash_angle, int threads)
{
    const glint_pass_options options = {flash_angle, threads};
    glint_passes *passes;
    glint_error error;
    ck_assert_msg(glint_passes_find(s, &options, &passes, &error) == GLINT_OK, "%s", error.message);
    return passes;
}

/* The first event of that kind, or NULL. */
static const glint_pass_event *event(const glint_pass *pass, glint_event_kind kind)
{
    for (size_t k = 0; k < pass->n_events; k++)
        if (pass->events[k].kind == kind) return &pass->events[k];
    return NULL;
}

/* ------------------------------------------------------- the reference table */

static const char THREE_DAYS[] =
    "[time]\nstart = 2024-01-01T12:00:00Z\nduration_s = 259200\nstep_s = 60\n";

static void check_event(const csv_table *t, long row, const glint_pass *pass, glint_event_kind kind,
                        const char *name)
{
    static const double START_JD = 2460311.0; /* 2024-01-01T12:00:00, no leap second follows */
    const glint_pass_event *e = event(pass, kind);
    ck_assert_ptr_nonnull(e);
    ck_assert_str_eq(table_text(t, row, "event"), name);
    const double want_s = (table_number(t, row, "utc_jd1") - START_JD) * DAY_S +
                          table_number(t, row, "utc_jd2") * DAY_S;
    assert_near(e->t_s, want_s, 1e-3); /* s: what is promised */
    assert_near(e->elevation_rad / DEG, table_number(t, row, "el_deg"), 1e-6);
    /* at 88 deg the azimuth turns by 16 deg/s */
    const double azimuth_tolerance = kind == GLINT_CULMINATION ? 2e-2 : 1e-4;
    assert_near(e->azimuth_rad / DEG, table_number(t, row, "az_deg"), azimuth_tolerance);
}

static void check_site(const csv_table *t, const char *site, const char *observer)
{
    glint_scenario *s = read_orbit_only(THREE_DAYS, observer, ISS_ORBIT, PLAIN);
    glint_passes *passes = find(s, 0, 1);
    size_t n = 0;
    for (long row = 0; row < t->n_rows; row++) {
        if (strcmp(table_text(t, row, "site"), site) != 0) continue;
        ck_assert_str_eq(table_text(t, row, "sat"), "ISS-like");
        const glint_pass *pass = glint_passes_get(passes, n++);
        ck_assert_ptr_nonnull(pass);
        check_event(t, row, pass, GLINT_RISE, "rise");
        check_event(t, row + 1, pass, GLINT_CULMINATION, "culminate");
        check_event(t, row + 2, pass, GLINT_SET, "set");
        row += 2;
    }
    /* the table by the side of the tests has only the first passes */
    if (t->n_rows > 12) ck_assert_uint_eq(glint_passes_count(passes), n);
    glint_passes_free(passes);
    glint_scenario_free(s);
}

static void check_table(const char *path)
{
    csv_table t = table_open(path);
    check_site(&t, "Vienna", ISS_OBSERVER[0]);
    check_site(&t, "MaunaKea", ISS_OBSERVER[1]);
    csv_free(&t);
}

START_TEST(test_passes_agree_with_another_program)
{
    table_check(check_table, "orbit/passes.csv");
}
END_TEST

/* ---------------------------------------------------------- spans of all kinds */

/* Everything that must hold of any list of passes. */
static void check_order(const glint_passes *passes, double span_s)
{
    double before_s = 0;
    for (size_t k = 0; k < glint_passes_count(passes); k++) {
        const glint_pass *p = glint_passes_get(passes, k);
        ck_assert_double_ge(p->from_s, before_s);
        ck_assert_double_ge(p->to_s, p->from_s);
        ck_assert_double_le(p->to_s, span_s);
        ck_assert_int_eq(event(p, GLINT_RISE) == NULL, p->up_at_start);
        ck_assert_int_eq(event(p, GLINT_SET) == NULL, p->up_at_end);
        for (size_t i = 0; i < p->n_events; i++) {
            const glint_pass_event *e = &p->events[i];
            ck_assert(e->t_s >= p->from_s && e->t_s <= p->to_s);
            ck_assert(i == 0 || e->t_s >= p->events[i - 1].t_s);
            ck_assert_ptr_nonnull(glint_event_name(e->kind));
            ck_assert_double_le(e->elevation_rad,
                                event(p, GLINT_CULMINATION)->elevation_rad + 1e-9);
        }
        before_s = p->to_s;
    }
    ck_assert_ptr_null(glint_passes_get(passes, glint_passes_count(passes)));
}

/* A geostationary satellite is up all the time, or never; a year is searched in bounded time. */
START_TEST(test_passes_of_a_geostationary_satellite_are_all_or_nothing)
{
    static const char YEAR[] = "[time]\nstart = 2024-01-01T12:00:00Z\nduration_s = 3.15e7\n"
                               "step_s = 3600\n";
    static const char ORBIT[] = "[orbit]\ncircular = { geostationary_longitude_deg = 19.2 }\n";
    glint_scenario *s = read_orbit_only(YEAR, ISS_OBSERVER[0], ORBIT, "");
    glint_passes *passes = find(s, 0, 1);
    ck_assert_uint_eq(glint_passes_count(passes), 1);
    const glint_pass *pass = glint_passes_get(passes, 0);
    ck_assert(pass->up_at_start && pass->up_at_end);
    assert_near(pass->to_s - pass->from_s, 3.15e7, 0);
    check_order(passes, 3.15e7);
    glint_passes_free(passes);
    glint_scenario_free(s);
    s = read_orbit_only(YEAR, ISS_OBSERVER[1], ORBIT, ""); /* on the other side of the Earth */
    passes = find(s, 0, 1);
    ck_assert_uint_eq(glint_passes_count(passes), 0);
    glint_passes_free(passes);
    glint_scenario_free(s);
}
END_TEST

/* At the poles every direction is south, or north: azimuths count from the meridian of the given
 * longitude. A year of a satellite that passes over them at each turn, of one that never comes up,
 * and of one that stays high for hours. */
START_TEST(test_passes_over_the_poles)
{
    static const struct {
        double latitude_deg;
        const char *orbit;
        size_t least, most;
    } CASES[] = {{90, RETROGRADE_ORBIT, 5300, 5340}, /* 14.57 turns a day, 365 days */
                 {-90, RETROGRADE_ORBIT, 5300, 5340},
                 {90, "[orbit]\ncircular = { geostationary_longitude_deg = 19.2 }\n", 0, 0},
                 {90,
                  "[orbit]\nkepler = { semi_major_axis_km = 26560, eccentricity = 0.74, "
                  "inclination_deg = 63.4, raan_deg = 120, argument_of_perigee_deg = 270, "
                  "mean_anomaly_deg = 180, j2 = false }\n",
                  730, 735}, /* 2.006 turns a day, 366 less 1 */
                 {-90,
                  "[orbit]\nkepler = { semi_major_axis_km = 26560, eccentricity = 0.74, "
                  "inclination_deg = 63.4, raan_deg = 120, argument_of_perigee_deg = 270, "
                  "mean_anomaly_deg = 180, j2 = false }\n",
                  0, 735}};
    static const char YEAR[] = "[time]\nstart = 2024-01-01T12:00:00Z\nduration_s = 31536000\n"
                               "step_s = 3600\n";
    for (size_t k = 0; k < COUNT_OF(CASES); k++) {
        char observer[128];
        snprintf(observer, sizeof observer,
                 "[observer]\nlatitude_deg = %g\nlongitude_deg = 0\nmin_elevation_deg = 5\n",
                 CASES[k].latitude_deg);
        glint_scenario *s = read_orbit_only(YEAR, observer, CASES[k].orbit, "");
        glint_passes *passes = find(s, 0, 2);
        const size_t n = glint_passes_count(passes);
        ck_assert_msg(n >= CASES[k].least && n <= CASES[k].most, "case %zu: %zu passes", k, n);
        check_order(passes, 31536000);
        glint_passes_free(passes);
        glint_scenario_free(s);
    }
}
END_TEST

/* A limit of elevation just below the highest point of a pass leaves a pass of some seconds; just
 * above it, none. */
START_TEST(test_passes_find_grazing_ones)
{
    static const struct {
        double above_deg;
        size_t more;
    } CASES[] = {{1e-3, 1}, {1e-6, 1}, {1e-9, 1}, {-1e-9, 0}};
    glint_scenario *s = read_orbit_only(THREE_DAYS, ISS_OBSERVER[0], ISS_ORBIT, PLAIN);
    glint_passes *passes = find(s, 0, 1);
    const size_t lowest = 2; /* 18.858 deg: among the first three the lowest */
    const double top_deg =
        event(glint_passes_get(passes, lowest), GLINT_CULMINATION)->elevation_rad / DEG;
    const double top_s = event(glint_passes_get(passes, lowest), GLINT_CULMINATION)->t_s;
    glint_passes_free(passes);
    glint_scenario_free(s);
    for (size_t k = 0; k < COUNT_OF(CASES); k++) {
        char observer[256];
        snprintf(observer, sizeof observer,
                 "[observer]\nlatitude_deg = 48.2\nlongitude_deg = 16.37\nheight_m = 200\n"
                 "min_elevation_deg = %.15g\n",
                 top_deg - CASES[k].above_deg);
        s = read_orbit_only(THREE_DAYS, observer, ISS_ORBIT, PLAIN);
        passes = find(s, 0, 1);
        size_t n = 0;
        for (size_t i = 0; i < glint_passes_count(passes); i++)
            if (fabs(event(glint_passes_get(passes, i), GLINT_CULMINATION)->t_s - top_s) < 60) n++;
        ck_assert_msg(n == CASES[k].more, "%g deg below the top: %zu passes", CASES[k].above_deg,
                      n);
        check_order(passes, 259200);
        glint_passes_free(passes);
        glint_scenario_free(s);
    }
}
END_TEST

/* Every row of a light curve that is up lies in a pass, and no other. Elevations of an orbit of
 * high eccentricity rise and fall within a pass, too. */
START_TEST(test_passes_agree_with_rows)
{
    static const char *const ORBITS[] = {
        ISS_ORBIT,
        GEO_ORBIT,
        MOLNIYA_ORBIT,
        GNSS_ORBIT,
        RETROGRADE_ORBIT,
        "[orbit]\nkepler = { semi_major_axis_km = 26560, eccentricity = 0.74, inclination_deg = "
        "63.4, raan_deg = 120, argument_of_perigee_deg = 270, mean_anomaly_deg = 10 }\n",
        "[orbit]\nkepler = { semi_major_axis_km = 12000, eccentricity = 0.45, inclination_deg = "
        "97, "
        "raan_deg = 20, argument_of_perigee_deg = 60, mean_anomaly_deg = 0 }\n"};
    static const char DAYS[] =
        "[time]\nstart = 2024-01-01T12:00:00Z\nduration_s = 172800\nstep_s = 20\n";
    for (size_t k = 0; k < COUNT_OF(ORBITS); k++) {
        glint_scenario *s = read_orbit_only(DAYS, ISS_OBSERVER[0], ORBITS[k], "");
        glint_passes *passes = find(s, 0, 2);
        check_order(passes, 172800);
        glint_ephemeris *e;
        ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
        const glint_ephemeris_row *rows;
        size_t n, at = 0;
        while (glint_ephemeris_next(e, &rows, &n, NULL) == GLINT_OK && n > 0)
            for (size_t i = 0; i < n; i++) {
                while (at < glint_passes_count(passes) &&
                       glint_passes_get(passes, at)->to_s < rows[i].t_s)
                    at++;
                const glint_pass *p = glint_passes_get(passes, at);
                const bool in_pass = p && rows[i].t_s >= p->from_s && rows[i].t_s <= p->to_s;
                ck_assert_msg(in_pass == (rows[i].elevation_rad >= 10 * DEG),
                              "orbit %zu, t_s = %g: elevation %g deg", k, rows[i].t_s,
                              rows[i].elevation_rad / DEG);
            }
        glint_ephemeris_close(e);
        glint_passes_free(passes);
        glint_scenario_free(s);
    }
}
END_TEST

/* ------------------------------------------------------------ light and dark */

/* The Earth's shadow falls between the rows of the independent program where its fraction changes.
 */
START_TEST(test_passes_meet_the_shadow_of_the_reference)
{
    glint_scenario *s = read_sound(TEST_DATA_DIR "/endtoend/geo-eclipse-season.toml");
    glint_passes *passes = find(s, 0, 1);
    ck_assert_uint_eq(glint_passes_count(passes), 1);
    const glint_pass *p = glint_passes_get(passes, 0);
    csv_table t = table_open(TEST_DATA_DIR "/endtoend/geo-eclipse-season.plain.expected.csv");
    static const struct {
        glint_event_kind kind;
        bool full, falls; /* the edge of full sunlight; the fraction falls */
    } EDGES[] = {{GLINT_PENUMBRA_BEGIN, true, true},
                 {GLINT_UMBRA_BEGIN, false, true},
                 {GLINT_UMBRA_END, false, false},
                 {GLINT_PENUMBRA_END, true, false}};
    for (size_t k = 0; k < COUNT_OF(EDGES); k++) {
        const glint_pass_event *e = event(p, EDGES[k].kind);
        ck_assert_ptr_nonnull(e);
        int found = 0;
        for (long row = 0; row + 1 < t.n_rows; row++) {
            const double a = table_number(&t, row, "sunlit_fraction");
            const double b = table_number(&t, row + 1, "sunlit_fraction");
            const bool lit_a = EDGES[k].full ? a == 1 : a > 0,
                       lit_b = EDGES[k].full ? b == 1 : b > 0;
            if (lit_a == lit_b || lit_a != EDGES[k].falls) continue;
            found++;
            ck_assert(e->t_s >= 200.0 * (double)row && e->t_s <= 200.0 * (double)(row + 1));
        }
        ck_assert_int_eq(found, 1);
        /* the fraction of a disc leaves 0 and 1 as the power 3/2 of the distance from the edge: the
         * penumbra takes 130 s, so that 1e-5 s make less than 1e-10 */
        assert_near(e->sunlit_fraction, EDGES[k].full ? 1 : 0, 1e-9);
    }
    csv_free(&t);
    glint_passes_free(passes);
    glint_scenario_free(s);
}
END_TEST

/* The Moon begins to cover the Sun between those rows of the other program where the gap between
 * the rims changes its sign, and leaves it likewise: nearly where a straight line through the gaps
 * passes 0. The chord of a curve over these 6 min, 18 min where the Moon begins, is off it by some
 * seconds; the Moon's place, by 0.3 km. */
START_TEST(test_passes_meet_the_shadow_of_the_moon)
{
    csv_table t = table_open(TEST_DATA_DIR "/orbit/moon_shadow.csv");
    static const char TIME[] =
        "[time]\nstart = 2025-03-29T04:00:00Z\nduration_s = 10800\nstep_s = 60\n";
    static const char OBSERVER[] = "[observer]\nlatitude_deg = 0\nlongitude_deg = 65\n";
    static const char ORBIT[] = "[orbit]\ncircular = { geostationary_longitude_deg = 65 }\n";
    static const double TOLERANCE_S = 12;
    glint_scenario *s = read_orbit_only(TIME, OBSERVER, ORBIT, "");
    glint_passes *passes = find(s, 0, 1);
    ck_assert_uint_eq(glint_passes_count(passes), 1);
    const glint_pass *p = glint_passes_get(passes, 0);
    double before_s = 0, gap_before = NAN;
    int found = 0;
    for (long row = 0; row < t.n_rows; row++) {
        int hour, minute;
        if (strncmp(table_text(&t, row, "utc"), "2025-03-29", 10) != 0) continue;
        ck_assert_int_eq(sscanf(table_text(&t, row, "utc") + 11, "%d:%d", &hour, &minute), 2);
        const double t_s = 3600.0 * (hour - 4) + 60.0 * minute;
        const double gap = table_number(&t, row, "separation_deg") -
                           table_number(&t, row, "sun_radius_deg") -
                           table_number(&t, row, "moon_radius_deg");
        if ((gap_before < 0 && gap > 0) || (gap_before > 0 && gap < 0)) {
            const glint_pass_event *e =
                event(p, gap < 0 ? GLINT_MOON_SHADOW_BEGIN : GLINT_MOON_SHADOW_END);
            ck_assert_ptr_nonnull(e);
            const double crossed = gap_before / (gap_before - gap);
            assert_near(e->t_s, before_s + crossed * (t_s - before_s), TOLERANCE_S);
            assert_near(e->sunlit_fraction, 1, 1e-9); /* as at the edges of the Earth's shadow */
            found++;
        }
        before_s = t_s, gap_before = gap;
    }
    ck_assert_int_eq(found, 2);
    csv_free(&t);
    glint_passes_free(passes);
    glint_scenario_free(s);
}
END_TEST

/* On 8 April 2024 this satellite comes out of the Earth's shadow while the Moon covers a part of
 * the Sun: that the Moon began to do so behind the Earth is no event, that it ends is one. */
START_TEST(test_passes_leave_out_what_the_moon_does_behind_the_earth)
{
    static const char TIME[] =
        "[time]\nstart = 2024-04-08T16:50:00Z\nduration_s = 2100\nstep_s = 60\n";
    static const char OBSERVER[] =
        "[observer]\nlatitude_deg = 48.2\nlongitude_deg = 16.37\nmin_elevation_deg = -90\n";
    static const char ORBIT[] =
        "[orbit]\ncircular = { height_km = 780, inclination_deg = 60, raan_deg = 80, "
        "argument_of_latitude_deg = 132, epoch = 2024-04-08T12:00:00Z }\n";
    glint_scenario *s = read_orbit_only(TIME, OBSERVER, ORBIT, "");
    glint_passes *passes = find(s, 0, 1);
    const glint_pass *p = glint_passes_get(passes, 0);
    const glint_pass_event *out = event(p, GLINT_PENUMBRA_END);
    const glint_pass_event *end = event(p, GLINT_MOON_SHADOW_END);
    ck_assert(event(p, GLINT_UMBRA_BEGIN) && event(p, GLINT_UMBRA_END) && out && end);
    ck_assert_ptr_null(event(p, GLINT_MOON_SHADOW_BEGIN));
    ck_assert(out->sunlit_fraction > 0.1 && out->sunlit_fraction < 0.9);
    ck_assert(end->t_s > out->t_s);
    glint_passes_free(passes);
    glint_scenario_free(s);
}
END_TEST

/* The seconds of light and of light over a dark site are those between the events: for a satellite
 * that stays up for days through the season of eclipses. */
START_TEST(test_passes_seconds_of_light_lie_between_the_events)
{
    static const char TIME[] =
        "[time]\nstart = 2025-03-20T12:00:00Z\nduration_s = 259200\nstep_s = 60\n";
    static const char ORBIT[] = "[orbit]\ncircular = { geostationary_longitude_deg = 16 }\n";
    glint_scenario *s = read_orbit_only(TIME, ISS_OBSERVER[0], ORBIT, "");
    glint_passes *passes = find(s, 0, 1);
    const glint_pass *p = glint_passes_get(passes, 0);
    bool lit = true, dark = false; /* at noon of the first day */
    double before_s = 0, lit_s = 0, both_s = 0;
    int changes = 0;
    for (size_t k = 0; k <= p->n_events; k++) {
        const double t_s = k < p->n_events ? p->events[k].t_s : 259200;
        lit_s += lit ? t_s - before_s : 0;
        both_s += lit && dark ? t_s - before_s : 0;
        before_s = t_s;
        if (k == p->n_events) break;
        const glint_event_kind kind = p->events[k].kind;
        const bool was_lit = lit, was_dark = dark;
        lit = kind == GLINT_UMBRA_END || (lit && kind != GLINT_UMBRA_BEGIN);
        dark = kind == GLINT_DARKNESS_BEGIN || (dark && kind != GLINT_DARKNESS_END);
        changes += (lit != was_lit) + (dark != was_dark);
    }
    ck_assert_int_eq(changes, 12); /* three nights, three eclipses */
    assert_near(p->sunlit_s, lit_s, 1e-6);
    assert_near(p->dark_site_s, both_s, 1e-6);
    const char *path = in_folder("passes.txt");
    char line[64];
    ck_assert_int_eq(
        glint_passes_write((const glint_passes *const *)&passes, 1, GLINT_FORMAT_TABLE, path, NULL),
        GLINT_OK);
    char *text = read_bytes(path, NULL);
    snprintf(line, sizeof line, "  %7.0f  %7.0f  ", lit_s, both_s);
    ck_assert_ptr_nonnull(strstr(text, line));
    free(text);
    /* an hour of umbra a night at the equinox: 67 min at the most */
    assert_near(259200 - p->sunlit_s, 3 * 67 * 60, 3 * 3 * 60);
    glint_passes_free(passes);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------------ brightness */

/* A mirror that is bent by 0.02 deg alone, so that it is none of the flat ones whose flashes are
 * sought, on a geostationary satellite over the site: for two minutes of the day it throws the Sun
 * there, when the Sun stands at twice its tilt of 22 deg. A white plate outshines it else, and is
 * brightest at another time. Samples left out where little moves must not lose those minutes. */
START_TEST(test_passes_find_a_narrow_peak_of_a_slow_satellite)
{
    static const char TEXT[] =
        "[time]\nstart = 2025-09-23T00:00:00Z\nduration_s = 43200\nstep_s = 10\n"
        "[observer]\nlatitude_deg = 0\nlongitude_deg = 10\n"
        "[orbit]\ncircular = { geostationary_longitude_deg = 10 }\n"
        "[attitude]\nlaw = \"nadir\"\n[photometry]\nsolar_disc = \"point\"\n"
        "[materials.shiny]\nbrdf = \"ward-gmd\"\nrho_d = 0.02\nrho_s = 0.5\nalpha_x = 0.001\n"
        "alpha_y = 0.001\n[materials.white]\nbrdf = \"lambert\"\nrho = 0.8\n"
        "[[component]]\nname = \"dish\"\n[[component.dish]]\nradius_m = 1\ndepth_m = 0.0002\n"
        "axis = [0.37460659341591203, 0, 0.9271838545667874]\nmaterial = \"shiny\"\n"
        "[[component]]\nname = \"panel\"\n[[component.plate]]\nsize_m = [4, 4]\n"
        "centre_m = [0, 20, 0]\nnormal = [0, 0, 1]\ntangent = [1, 0, 0]\nmaterial = \"white\"\n";
    glint_scenario *s = read_sound(write_file("dish.toml", TEXT));
    glint_passes *passes = find(s, 0, 1);
    const glint_pass_event *best = event(glint_passes_get(passes, 0), GLINT_BRIGHTEST);
    ck_assert_ptr_nonnull(best);
    ck_assert_int_eq(best->has_magnitude, 1);
    ck_assert_double_lt(best->magnitude, 0); /* the plate: 9.5 and fainter */
    /* The phase angle is that between Sun and nadir; the Sun's declination, -0.1 deg, hardly adds.
     */
    assert_near(best->phase_angle_rad / DEG, 44, 0.03);
    glint_passes_free(passes);
    glint_scenario_free(s);
}
END_TEST

/* A shiny plate in inertial attitude: its normal bisects Sun and observer at one moment. */
static const char MIRROR[] =
    "[materials.shiny]\nbrdf = \"ward-gmd\"\nrho_d = 0.1\nrho_s = 0.5\nalpha_x = 0.02\n"
    "alpha_y = 0.02\n[[component]]\nname = \"bus\"\n[[component.plate]]\nsize_m = [2, 1]\n"
    "normal = [0, 0, 1]\ntangent = [1, 0, 0]\nmaterial = \"shiny\"\n";

static const char PASS_TIME[] =
    "[time]\nstart = 2025-07-25T20:33:00Z\nduration_s = 600\nstep_s = 0.5\n";

/* A quaternion that turns body z into n, scalar first. */
static void turn_z_to(const double n[3], double q[4])
{
    const double norm = sqrt(2 + 2 * n[2]); /* 1 + z.n + z x n, made unit */
    q[0] = (1 + n[2]) / norm, q[1] = -n[1] / norm, q[2] = n[0] / norm, q[3] = 0;
}

/* Unit vector from the satellite to the site. */
static void to_observer(const glint_ephemeris_row *row, double out[3])
{
    out[0] = -cos(row->dec_rad) * cos(row->ra_rad);
    out[1] = -cos(row->dec_rad) * sin(row->ra_rad);
    out[2] = -sin(row->dec_rad);
}

/* The plate does not turn and the Sun hardly moves, so that the mirrored Sun stays where the
 * observer was at the peak: a flash lasts while the observer's direction is within the limit of
 * that. */
static void check_duration(const glint_scenario *s, const glint_pass_event *flash, double limit)
{
    static const double SUN =
        1e-4; /* rad: its way in half a minute, and what the satellite's adds */
    glint_ephemeris *e;
    const glint_ephemeris_row *rows;
    double peak[3] = {0}, now[3];
    size_t n;
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
    ck_assert_int_eq(glint_ephemeris_next(e, &rows, &n, NULL), GLINT_OK);
    for (size_t k = 0; k < n; k++)
        if (fabs(rows[k].t_s - flash->t_s) < 0.01) to_observer(&rows[k], peak);
    for (size_t k = 0; k < n; k++) {
        if (rows[k].elevation_rad < 0 || !(rows[k].sunlit_fraction > 0))
            continue; /* cut off there */
        to_observer(&rows[k], now);
        const double angle = angle3(now, peak);
        const bool within = rows[k].t_s >= flash->from_s && rows[k].t_s <= flash->to_s;
        ck_assert_msg(within ? angle <= limit + SUN : angle >= limit - SUN,
                      "t_s = %g: %g deg, limit %g", rows[k].t_s, angle / DEG, limit / DEG);
    }
    glint_ephemeris_close(e);
}

/* The row of an ephemeris of the scenario at `step`. */
static glint_ephemeris_row row_at(const glint_scenario *s, size_t step)
{
    glint_ephemeris *e;
    const glint_ephemeris_row *rows;
    size_t n;
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
    ck_assert_int_eq(glint_ephemeris_next(e, &rows, &n, NULL), GLINT_OK);
    ck_assert_uint_lt(step, n);
    const glint_ephemeris_row row = rows[step];
    glint_ephemeris_close(e);
    return row;
}

/* Writes a scenario whose plate faces the bisector at `step`, and reads it. */
static glint_scenario *read_mirror(size_t step, glint_ephemeris_row *row)
{
    char attitude_text[256];
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    glint_scenario *s = read_orbit_only(PASS_TIME, SOUND[PART_OBSERVER], SOUND[PART_ORBIT], "");
    *row = row_at(s, step);
    frame_grid *grid = NULL;
    frame_set frames;
    const earth_orientation still = {0, 0};
    ck_assert_int_eq(frame_grid_prepare(&s->clock, &still, 0, 600, 1, &grid, NULL), GLINT_OK);
    frame_grid_at(grid, row->t_s, FRAMES_SUN, &frames);
    double sun[3], distance_m, normal[3], q[4];
    sun_from_point(&frames, row->r_gcrs_m, true, sun, &distance_m);
    double observer[3];
    to_observer(row, observer);
    add3(sun, observer, normal);
    unit3(normal, normal);
    turn_z_to(normal, q);
    snprintf(attitude_text, sizeof attitude_text,
             "[attitude]\nlaw = \"inertial\"\nquaternion_wxyz = [%.17g, %.17g, %.17g, %.17g]\n",
             q[0], q[1], q[2], q[3]);
    parts[PART_TIME] = PASS_TIME;
    parts[PART_ATTITUDE] = attitude_text;
    parts[PART_MATERIAL] = MIRROR;
    parts[PART_COMPONENT] = parts[PART_PRIMITIVE] = "";
    frame_grid_free(grid);
    glint_scenario_free(s);
    return read_with(parts, PART_TOP, SOUND[PART_TOP]);
}

/* The flash is there where it was put, however short it is. */
START_TEST(test_passes_find_a_flash_where_it_was_put)
{
    static const double LIMITS_DEG[] = {0, 0.1, 3};   /* 0: the usual 1 deg */
    for (size_t step = 201; step < 580; step += 63) { /* after that comes the shadow */
        glint_ephemeris_row row;
        glint_scenario *s = read_mirror(step, &row);
        for (size_t k = 0; k < COUNT_OF(LIMITS_DEG); k++) {
            const double limit = LIMITS_DEG[k] > 0 ? LIMITS_DEG[k] * DEG : DEG;
            glint_passes *passes = find(s, LIMITS_DEG[k] * DEG, 1);
            ck_assert_uint_eq(glint_passes_count(passes), 1);
            const glint_pass_event *e = event(glint_passes_get(passes, 0), GLINT_FLASH);
            ck_assert_ptr_nonnull(e);
            assert_near(e->t_s, row.t_s, 1e-3);
            assert_near(e->mirror_angle_rad, 0, 1e-6);
            check_duration(s, e, limit);
            ck_assert_str_eq(e->component, "bus");
            assert_near(e->normal[2], 1, 1e-15);
            ck_assert(e->has_magnitude);
            const glint_pass_event *best = event(glint_passes_get(passes, 0), GLINT_BRIGHTEST);
            ck_assert_double_le(best->magnitude, e->magnitude);
            /* Range and cosines move the top of the lobe, 1.6 deg wide, by some tenths of a deg */
            if (limit >= DEG) ck_assert(best->t_s >= e->from_s && best->t_s <= e->to_s);
            glint_passes_free(passes);
        }
        glint_scenario_free(s);
    }
}
END_TEST

/* Mirror angle of a plane with that normal in the body, from an ephemeris: pi where Sun or observer
 * stand behind it. */
static double mirror_angle_at(const glint_ephemeris_row *row, const frame_grid *grid,
                              const double normal_body[3])
{
    double gcrs_body[9], normal[3], sun[3], observer[3], mirrored[3], distance_m;
    frame_set frames;
    frame_grid_at(grid, row->t_s, FRAMES_SUN, &frames);
    sun_from_point(&frames, row->r_gcrs_m, true, sun, &distance_m);
    to_observer(row, observer);
    mat_from_quat(row->quaternion_wxyz, gcrs_body);
    mat_vec(gcrs_body, normal_body, normal);
    const double c = dot3(normal, sun);
    if (c <= 0 || dot3(normal, observer) <= 0 || row->elevation_rad < 0 ||
        !(row->sunlit_fraction > 0))
        return PI;
    for (int i = 0; i < 3; i++)
        mirrored[i] = 2 * c * normal[i] - sun[i];
    return angle3(mirrored, observer);
}

/* Flashes of a box by its mirror angles at every row: how many begin. */
static size_t count_among_rows(const glint_scenario *s, double limit)
{
    static const double NORMALS[6][3] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                         {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    frame_grid *grid = NULL;
    const earth_orientation still = {0, 0};
    ck_assert_int_eq(frame_grid_prepare(&s->clock, &still, 0, s->span_s, 1, &grid, NULL), GLINT_OK);
    glint_ephemeris *e;
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
    const glint_ephemeris_row *rows;
    size_t n, count = 0;
    bool inside[6] = {false};
    while (glint_ephemeris_next(e, &rows, &n, NULL) == GLINT_OK && n > 0)
        for (size_t k = 0; k < n; k++)
            for (int i = 0; i < 6; i++) {
                const bool now = mirror_angle_at(&rows[k], grid, NORMALS[i]) <= limit;
                count += now && !inside[i];
                inside[i] = now;
            }
    glint_ephemeris_close(e);
    frame_grid_free(grid);
    return count;
}

/* The box flashes as often as looking at every hundredth of a second says, at least so often. */
static void check_flashes(const char *laws, size_t least)
{
    static const double LIMIT = 3 * DEG;
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T20:33:00Z\nduration_s = 400\nstep_s = 0.01\n";
    parts[PART_MATERIAL] = "[materials.white]\nbrdf = \"ward-gmd\"\nrho_d = 0.1\nrho_s = 0.5\n"
                           "alpha_x = 0.05\nalpha_y = 0.05\n";
    glint_scenario *s = read_with(parts, PART_ATTITUDE, laws);
    const size_t want = count_among_rows(s, LIMIT);
    glint_passes *passes = find(s, LIMIT, 1);
    size_t got = 0;
    for (size_t k = 0; k < glint_passes_count(passes); k++)
        for (size_t i = 0; i < glint_passes_get(passes, k)->n_events; i++)
            got += glint_passes_get(passes, k)->events[i].kind == GLINT_FLASH;
    ck_assert_uint_ge(want, least);
    /* one that dips below the limit for less than 0.01 s may be seen by the search alone */
    ck_assert_msg(got >= want && got <= want + 1, "%zu flashes, %zu among samples", got, want);
    glint_passes_free(passes);
    glint_scenario_free(s);
}

START_TEST(test_passes_find_all_flashes_of_a_turning_box)
{
    check_flashes("[attitude]\nlaw = \"spin\"\nbody_axis = [1, 2, 3]\npole = { ra_deg = 40, "
                  "dec_deg = 25 }\nrate_deg_s = 47\n",
                  6);
    check_flashes("[attitude]\nlaw = \"torque-free\"\ninertia_kg_m2 = [3, 4, 5]\n"
                  "rates_deg_s = [40, 20, 15]\nquaternion_wxyz = [0.6, 0, 0.8, 0]\n",
                  4);
}
END_TEST

/* A face looks at the Sun for 19 s, at the observer for 19 s, and so on, and turns from one to the
 * other in 1 s, through the direction of a flash: the search must not step over what moves only
 * later. */
START_TEST(test_passes_find_all_flashes_of_fast_slews)
{
    static const char *const LAWS[2] = {
        "axis = [0, 0, 1]\nto = \"sun\"\nsecond_axis = [1, 0, 0]\nsecond_to = \"observer\"\n",
        "axis = [0, 0, 1]\nto = \"observer\"\nsecond_axis = [-1, 0, 0]\nsecond_to = \"sun\"\n"};
    char laws[TEXT_SIZE];
    int n = 0;
    for (int k = 0; k < 20; k++) {
        n += snprintf(laws + n, sizeof laws - (size_t)n, "[[attitude]]\n");
        if (k > 0)
            n += snprintf(laws + n, sizeof laws - (size_t)n, "from = %d\nslew_s = 1\n", 20 * k);
        n += snprintf(laws + n, sizeof laws - (size_t)n, "law = \"point\"\n%s", LAWS[k % 2]);
    }
    check_flashes(laws, 10);
}
END_TEST

/* The brightest moment of the only pass of a scenario in one piece is at least as bright as every
 * row of its light curve, and brighter by `by_mag` at most. */
static void assert_brighter_than_rows(const char *const parts[N_PARTS], enum part part,
                                      double by_mag)
{
    const marked_text m = with_part(parts, part, parts[part]);
    glint_scenario *s = read_sound(write_file("scenario.toml", m.text));
    glint_passes *passes = find(s, 0, 1);
    ck_assert_uint_eq(glint_passes_count(passes), 1);
    const glint_pass_event *best = event(glint_passes_get(passes, 0), GLINT_BRIGHTEST);
    ck_assert_ptr_nonnull(best);
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    const glint_row *rows;
    double least = HUGE_VAL;
    size_t n;
    while (glint_curve_next(curve, &rows, &n, NULL) == GLINT_OK && n > 0)
        for (size_t k = 0; k < n; k++)
            if (rows[k].flux_ratio[0] > 0) least = fmin(least, rows[k].magnitude[0]);
    ck_assert_double_le(best->magnitude, least + 1e-9);
    assert_near(best->magnitude, least, by_mag);
    glint_curve_close(curve);
    glint_passes_free(passes);
    glint_scenario_free(s);
}

/* No row of a light curve, however fine, is brighter than the brightest moment. */
START_TEST(test_passes_brightest_is_brighter_than_any_row)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T20:33:00Z\nduration_s = 600\nstep_s = 0.02\n";
    assert_brighter_than_rows(parts, PART_TIME, 1e-3); /* it changes by 0.01 mag/s */
}
END_TEST

/* Over a slow satellite seconds are left out: the glint of a narrow lobe on a round tank, which is
 * no flash and lasts for minutes, must not be. */
START_TEST(test_passes_brightest_of_a_slow_satellite_is_brighter_than_any_row)
{
    static const char *const TANKS[] = {
        "[[component.cylinder]]\nradius_m = 1\nlength_m = 3\naxis = [0, 1, 0.03]\n"
        "material = \"shiny\"\n",
        "[[component.cone]]\nradius_m = 1\ntop_radius_m = 0.9\nlength_m = 3\naxis = [0, 1, 0]\n"
        "material = \"shiny\"\n",
    };
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-03-05T18:00:00Z\nduration_s = 36000\nstep_s = 3\n";
    parts[PART_ORBIT] = "[orbit]\ncircular = { geostationary_longitude_deg = 10 }\n";
    parts[PART_MATERIAL] = "[materials.shiny]\nbrdf = \"ward-gmd\"\nrho_d = 0.05\nrho_s = 0.8\n"
                           "alpha_x = 0.004\nalpha_y = 0.004\n";
    for (size_t k = 0; k < sizeof TANKS / sizeof *TANKS; k++) {
        parts[PART_PRIMITIVE] = TANKS[k];
        assert_brighter_than_rows(parts, PART_PRIMITIVE, 1e-3); /* three seconds are 0.0125 deg */
    }
}
END_TEST

/* -------------------------------------------------------------------- the rest */

START_TEST(test_passes_are_the_same_on_any_number_of_threads)
{
    glint_scenario *s = read_orbit_only(THREE_DAYS, ISS_OBSERVER[0], ISS_ORBIT, "");
    glint_passes *one = find(s, 0, 1), *three = find(s, 0, 3);
    ck_assert_uint_eq(glint_passes_count(one), glint_passes_count(three));
    for (size_t k = 0; k < glint_passes_count(one); k++) {
        const glint_pass *a = glint_passes_get(one, k), *b = glint_passes_get(three, k);
        ck_assert_uint_eq(a->n_events, b->n_events);
        for (size_t i = 0; i < a->n_events; i++) {
            assert_near(a->events[i].t_s, b->events[i].t_s,
                        1e-4); /* s: the light time's first guess */
            ck_assert_int_eq(a->events[i].kind, b->events[i].kind);
        }
    }
    glint_passes_free(one);
    glint_passes_free(three);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_passes_refuse_wrong_calls)
{
    glint_passes *passes;
    glint_error error;
    glint_scenario *s = read_with(GIVEN, PART_TOP, GIVEN[PART_TOP]);
    ck_assert_int_eq(glint_passes_find(s, NULL, &passes, &error), GLINT_INPUT);
    ck_assert_ptr_null(passes);
    ck_assert(strstr(error.message, "[geometry]") != NULL);
    glint_scenario_free(s);
    s = read_orbit_only(THREE_DAYS, ISS_OBSERVER[0], ISS_ORBIT, "");
    ck_assert_int_eq(glint_passes_find(s, &(glint_pass_options){2, 0}, &passes, NULL),
                     GLINT_ARGUMENT);
    ck_assert_int_eq(glint_passes_find(s, &(glint_pass_options){NAN, 0}, &passes, NULL),
                     GLINT_ARGUMENT);
    ck_assert_int_eq(glint_passes_find(s, &(glint_pass_options){0, -1}, &passes, NULL),
                     GLINT_ARGUMENT);
    ck_assert_int_eq(glint_passes_find(s, &(glint_pass_options){0, 1025}, &passes, NULL),
                     GLINT_ARGUMENT);
    /* it has no satellite: no light curve */
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_ARGUMENT);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_passes_name_the_points_of_the_compass)
{
    static const struct {
        double azimuth_deg;
        const char *name;
    } CASES[] = {{0, "N"},       {11.2, "N"}, {11.3, "NNE"}, {45, "NE"},     {90, "E"},
                 {180, "S"},     {225, "SW"}, {270, "W"},    {348.7, "NNW"}, {348.8, "N"},
                 {359.999, "N"}, {360, "N"},  {-90, "W"}};
    for (size_t k = 0; k < COUNT_OF(CASES); k++)
        ck_assert_str_eq(glint_compass_point(CASES[k].azimuth_deg * DEG), CASES[k].name);
    ck_assert_ptr_null(glint_event_name((glint_event_kind)99));
}
END_TEST

/* ----------------------------------------------------------------------- roots */

static glint_status cosine(void *context, double x, double *y, glint_error *error)
{
    (void)error;
    ++*(int *)context;
    *y = cos(x);
    return GLINT_OK;
}

/* (x - 1)^2 - 1e-8: two zeros 2e-4 apart, far below the grid. */
static glint_status close_pair(void *context, double x, double *y, glint_error *error)
{
    (void)context, (void)error;
    *y = (x - 1) * (x - 1) - 1e-8;
    return GLINT_OK;
}

static glint_status failing(void *context, double x, double *y, glint_error *error)
{
    (void)context, (void)x, (void)y, (void)error;
    return GLINT_INPUT;
}

START_TEST(test_roots_are_found)
{
    int calls = 0;
    double x, y;
    ck_assert_int_eq(root_find(cosine, &calls, 0, 1, 3, cos(3), 1e-14, &x, NULL), GLINT_OK);
    assert_near(x, 0.5 * PI, 1e-14);
    ck_assert_int_lt(calls, 12); /* Brent's method needs 8; bisection 48 */
    ck_assert_int_eq(minimum_find(cosine, &calls, 2, 4, 1e-9, &x, &y, NULL), GLINT_OK);
    assert_near(x, PI, 1e-7); /* half the digits: the minimum is flat */
    assert_near(y, -1, 1e-15);
    ck_assert_int_eq(minimum_find(cosine, &calls, 4, 5, 1e-9, &x, &y, NULL), GLINT_OK);
    assert_near(x, 4, 0); /* at the end */
    root_list list = {0};
    ck_assert_int_eq(roots_between(cosine, &calls, 0, 10, 20, 1e-13, &list, NULL), GLINT_OK);
    ck_assert_uint_eq(list.n, 3);
    for (size_t k = 0; k < 3; k++)
        assert_near(list.items[k], (0.5 + (double)k) * PI, 1e-13);
    list.n = 0;
    ck_assert_int_eq(roots_between(close_pair, NULL, 0, 3.3, 11, 1e-12, &list, NULL), GLINT_OK);
    ck_assert_uint_eq(list.n, 2);
    assert_near(list.items[0], 1 - 1e-4, 1e-11);
    assert_near(list.items[1], 1 + 1e-4, 1e-11);
    ck_assert_int_eq(roots_between(failing, NULL, 0, 1, 4, 1e-9, &list, NULL), GLINT_INPUT);
    ck_assert_int_eq(root_find(failing, NULL, 0, -1, 1, 1, 1e-9, &x, NULL), GLINT_INPUT);
    ck_assert_int_eq(minimum_find(failing, NULL, 0, 1, 1e-9, &x, NULL, NULL), GLINT_INPUT);
    root_list_free(&list);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("passes");
    TCase *tc = tcase_create("passes");
    tcase_add_checked_fixture(tc, folder_make, folder_remove);
    tcase_set_timeout(tc, 120);
    tcase_add_test(tc, test_passes_agree_with_another_program);
    tcase_add_test(tc, test_passes_of_a_geostationary_satellite_are_all_or_nothing);
    tcase_add_test(tc, test_passes_over_the_poles);
    tcase_add_test(tc, test_passes_find_grazing_ones);
    tcase_add_test(tc, test_passes_agree_with_rows);
    tcase_add_test(tc, test_passes_meet_the_shadow_of_the_reference);
    tcase_add_test(tc, test_passes_seconds_of_light_lie_between_the_events);
    tcase_add_test(tc, test_passes_meet_the_shadow_of_the_moon);
    tcase_add_test(tc, test_passes_leave_out_what_the_moon_does_behind_the_earth);
    tcase_add_test(tc, test_passes_find_a_narrow_peak_of_a_slow_satellite);
    tcase_add_test(tc, test_passes_find_a_flash_where_it_was_put);
    tcase_add_test(tc, test_passes_find_all_flashes_of_a_turning_box);
    tcase_add_test(tc, test_passes_find_all_flashes_of_fast_slews);
    tcase_add_test(tc, test_passes_brightest_is_brighter_than_any_row);
    tcase_add_test(tc, test_passes_brightest_of_a_slow_satellite_is_brighter_than_any_row);
    tcase_add_test(tc, test_passes_are_the_same_on_any_number_of_threads);
    tcase_add_test(tc, test_passes_refuse_wrong_calls);
    tcase_add_test(tc, test_passes_name_the_points_of_the_compass);
    tcase_add_test(tc, test_roots_are_found);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
