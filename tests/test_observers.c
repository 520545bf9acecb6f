/* Observers: on other satellites, in fixed directions, several at once; masks, refraction,
 * darkness; the Moon as they see it. */
#include "base/constants.h"
#include "base/vec.h"
#include "orbit/eclipse.h"
#include "orbit/moon.h"
#include "run_rows.h"
#include "table.h"

/* Without light time, what two orbits give is a closed form. */
static const char AT_ONCE[] = "[corrections]\nlight_time = false\n";

/* Two circles in one plane: the angle between the satellites grows steadily. */
static const char LOW_ORBIT[] =
    "[orbit]\ncircular = { height_km = 600, inclination_deg = 0, raan_deg = 0, "
    "argument_of_latitude_deg = 10, j2 = false }\n";
static const char HIGH_OBSERVER[] =
    "[observer.satellite]\ncircular = { height_km = 1400, inclination_deg = 0, raan_deg = 0, "
    "argument_of_latitude_deg = 0, j2 = false }\n";
static const double LOW_M = EARTH_RADIUS_M + 600e3, HIGH_M = EARTH_RADIUS_M + 1400e3;

static const char HOURS[] =
    "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 14400\nstep_s = 30\n";

/* SOUND with up to three parts replaced (NULL: kept); glint_scenario_free ends it. */
static glint_scenario *read_three(enum part a, const char *x, enum part b, const char *y,
                                  enum part c, const char *z)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[a] = x;
    parts[b] = y;
    return read_with(parts, c, z);
}

static double rate_of(double a_m)
{
    return sqrt(EARTH_MU_M3_S2 / (a_m * a_m * a_m));
}

/* Angle about the Earth between target and observer at a time, and with the target tau earlier. */
static double angle_between(double t_s, double tau_s)
{
    return 10 * DEG + rate_of(LOW_M) * (t_s - tau_s) - rate_of(HIGH_M) * t_s;
}

static double chord(double angle)
{
    return sqrt(LOW_M * LOW_M + HIGH_M * HIGH_M - 2 * LOW_M * HIGH_M * cos(angle));
}

/* Distance of the straight line from the Earth's centre. */
static double closest(double angle)
{
    return LOW_M * HIGH_M * fabs(sin(angle)) / chord(angle);
}

static glint_scenario *read_two_satellites(const char *settings)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = HOURS;
    parts[PART_ORBIT] = LOW_ORBIT;
    parts[PART_OBSERVER] = HIGH_OBSERVER;
    return read_with(parts, PART_SETTINGS, settings);
}

START_TEST(test_observers_satellite_sees_along_the_chord)
{
    for (int light = 0; light < 2; light++) {
        glint_scenario *s = read_two_satellites(light ? "" : AT_ONCE);
        run_rows r = run(s, 2);
        ck_assert_uint_eq(r.n, 481);
        int blocked = 0;
        for (size_t k = 0; k < r.n; k++) {
            const glint_row *row = &r.rows[k];
            const double tau = light ? row->range_m / LIGHT_SPEED_M_S : 0;
            const double angle = angle_between(row->t_s, tau);
            /* rounding of positions of 1e7 m in circles of some turns */
            assert_near(row->range_m, chord(angle), 1e-6);
            ck_assert(!row->has_site);
            ck_assert_uint_eq(row->flags & (GLINT_BELOW_HORIZON | GLINT_SITE_DARK), 0);
            assert_near(row->airmass, 0, 0);
            /* the Earth is between only when the satellite is beyond the horizon, where the line
             * passes within the equator; 100 km off, the equator of date (0.14 deg) is none */
            const bool behind = cos(angle) < LOW_M / HIGH_M;
            const double miss_m = closest(angle) - EARTH_RADIUS_M;
            const bool hidden = (row->flags & GLINT_BLOCKED) != 0;
            if (fabs(miss_m) > 1e5) ck_assert_int_eq(hidden, behind && miss_m < 0);
            if (hidden) assert_near(row->flux_ratio[0], 0, 0);
            blocked += hidden;
        }
        ck_assert_int_gt(blocked, 50);
        ck_assert_int_lt(blocked, 430);
        rows_free(&r);
        glint_scenario_free(s);
    }
}
END_TEST

/* The table of such a run has no columns of a site, and blocked rows are empty, not strange. */
START_TEST(test_observers_satellite_has_no_site_columns)
{
    glint_scenario *s = read_two_satellites("");
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    size_t n;
    const glint_column *columns = glint_curve_columns(curve, &n);
    for (size_t k = 0; k < n; k++)
        ck_assert(!strstr(columns[k].name, "azimuth") && !strstr(columns[k].name, "elevation") &&
                  strcmp(columns[k].name, "airmass") != 0 &&
                  strcmp(columns[k].name, "observer") != 0);
    const char *path = in_folder("table.csv");
    ck_assert_int_eq(glint_table_write(curve, path, NULL, NULL, NULL, NULL, NULL), GLINT_OK);
    glint_curve_close(curve);
    csv_table t = table_open(path);
    int blocked = 0;
    for (long row = 0; row < t.n_rows; row++) {
        if (!strstr(table_text(&t, row, "flags"), "blocked")) continue;
        blocked++;
        ck_assert_str_eq(table_text(&t, row, "mag_V"), "");
        ck_assert_str_eq(table_text(&t, row, "flux_ratio_V"), "0");
    }
    ck_assert_int_gt(blocked, 50);
    csv_free(&t);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------ fixed directions */

static const char PLATE[] = "[[component.plate]]\nsize_m = [2, 1]\nnormal = [-1, 0, 0]\n"
                            "tangent = [0, 0, 1]\nmaterial = \"white\"\n";

/* A Lambert plate seen along its normal: rho/pi A cos(phase) (1 au/d)^2 / R^2. Its normal is -x,
 * against the motion. */
START_TEST(test_observers_direction_of_the_body_sees_a_plate_in_closed_form)
{
    static const char *const RANGES[] = {"1000", "2000"};
    double first = 0;
    for (size_t k = 0; k < COUNT_OF(RANGES); k++) {
        char observer[128];
        snprintf(observer, sizeof observer,
                 "[observer.direction]\nframe = \"body\"\nvector = [-3, 0, 0]\nrange_km = %s\n",
                 RANGES[k]);
        glint_scenario *s =
            read_three(PART_OBSERVER, observer, PART_SETTINGS, AT_ONCE, PART_PRIMITIVE, PLATE);
        run_rows r = run(s, 1);
        const double range_m = 1e3 * atof(RANGES[k]);
        for (size_t i = 0; i < r.n; i++) {
            const glint_row *row = &r.rows[i];
            assert_near(row->range_m, range_m, 0);
            ck_assert_uint_eq(row->flags, 0);
            const double full = 0.5 / PI * 2 * cos(row->phase_angle_rad) / (range_m * range_m);
            const double d2 = full / row->flux_ratio[0]; /* (d / 1 au)^2: the same in one minute */
            if (first == 0) first = d2;
            assert_rel(d2, first, 1e-5); /* the satellite moves 450 km */
            /* end of July: 1.0155 au (almanac); to half a day's change */
            assert_near(sqrt(d2), 1.0155, 5e-4);
        }
        rows_free(&r);
        glint_scenario_free(s);
    }
}
END_TEST

/* The line of sight of an observer below (body z is nadir) is that of the satellite's place; one
 * fixed in GCRS does not move. */
START_TEST(test_observers_direction_lies_where_it_is_said)
{
    static const struct {
        const char *text;
        bool is_nadir;
        double ra_deg, dec_deg; /* from the observer to the satellite */
    } CASES[] = {
        {"[observer.direction]\nframe = \"body\"\nvector = [0, 0, 1]\n", true, 0, 0},
        {"[observer.direction]\nframe = \"gcrs\"\nra_deg = 30\ndec_deg = 20\n", false, 210, -20},
        {"[observer.direction]\nframe = \"gcrs\"\nvector = [0, -2, 2]\n", false, 90, -45},
    };
    for (size_t k = 0; k < COUNT_OF(CASES); k++) {
        glint_scenario *s = read_with(SOUND, PART_OBSERVER, CASES[k].text);
        glint_ephemeris *e;
        ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
        const glint_ephemeris_row *rows;
        size_t n;
        ck_assert_int_eq(glint_ephemeris_next(e, &rows, &n, NULL), GLINT_OK);
        ck_assert_uint_eq(n, 7);
        for (size_t i = 0; i < n; i++) {
            const double ra = rows[i].ra_rad, dec = rows[i].dec_rad;
            const double *p = rows[i].r_gcrs_m;
            const double got[3] = {cos(dec) * cos(ra), cos(dec) * sin(ra), sin(dec)};
            const double a = CASES[k].ra_deg * DEG, d = CASES[k].dec_deg * DEG;
            double want[3] = {cos(d) * cos(a), cos(d) * sin(a), sin(d)};
            if (CASES[k].is_nadir) unit3(p, want);
            assert_near(angle3(got, want), 0, 1e-14);
            assert_near(rows[i].range_m, 1e6, 0);
        }
        /* its motion is not known: no rates */
        const glint_column *columns = glint_ephemeris_columns(e, &n);
        for (size_t i = 0; i < n; i++)
            ck_assert(!strstr(columns[i].name, "rate_") && !strstr(columns[i].name, "azimuth"));
        glint_ephemeris_close(e);
        glint_scenario_free(s);
    }
}
END_TEST

/* Rates of what another satellite sees are those of its rows' differences. */
START_TEST(test_observers_satellite_rates_are_differences_of_rows)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_ORBIT] = LOW_ORBIT;
    parts[PART_OBSERVER] = HIGH_OBSERVER;
    glint_scenario *s = read_with(
        parts, PART_TIME, "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 20\nstep_s = 0.5\n");
    glint_ephemeris *e;
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
    const glint_ephemeris_row *rows;
    size_t n;
    ck_assert_int_eq(glint_ephemeris_next(e, &rows, &n, NULL), GLINT_OK);
    for (size_t k = 1; k + 1 < n; k++) {
        const double rate = rows[k + 1].range_m - rows[k - 1].range_m; /* over 1 s */
        assert_near(rows[k].range_rate_m_s, rate, 2e-3); /* third derivative: 1e-3 m/s^3 / 6 */
        double u[2][3];
        for (int j = 0; j < 2; j++) {
            const glint_ephemeris_row *r = &rows[k - 1 + 2 * (size_t)j];
            u[j][0] = cos(r->dec_rad) * cos(r->ra_rad);
            u[j][1] = cos(r->dec_rad) * sin(r->ra_rad);
            u[j][2] = sin(r->dec_rad);
        }
        assert_rel(rows[k].angular_rate_rad_s, angle3(u[0], u[1]), 1e-5);
    }
    glint_ephemeris_close(e);
    glint_scenario_free(s);
}
END_TEST

/* Rows of an ephemeris of at most 2048 rows: their places in GCRS and ranges. */
static size_t places_of(const glint_scenario *s, double (*r_m)[3], double *range_m)
{
    glint_ephemeris *e;
    const glint_ephemeris_row *rows;
    size_t n;
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
    ck_assert_int_eq(glint_ephemeris_next(e, &rows, &n, NULL), GLINT_OK);
    for (size_t k = 0; k < n; k++) {
        copy3(rows[k].r_gcrs_m, r_m[k]);
        range_m[k] = rows[k].range_m;
    }
    glint_ephemeris_close(e);
    return n;
}

/* An element set, which lives in TEME, looks at a geostationary satellite: the range is the
 * distance between the places that each has as the target of a scenario. */
START_TEST(test_observers_satellite_of_an_element_set_is_where_its_orbit_is)
{
    enum { N = 41 };
    static const char TIME[] = "[time]\nstart = 2025-07-24T19:00:00Z\nduration_s = 2400\nstep_s = "
                               "60\n";
    static const char GEO[] = "[orbit]\ncircular = { geostationary_longitude_deg = 30 }\n";
    static const char TLE[] = "tle = \"" TEST_DATA_DIR "/endtoend/iss.tle\"\n";
    double geo_m[N][3], range_m[N], iss_m[N][3], unused[N], between[3];
    char text[1024];
    snprintf(text, sizeof text, "[observer.satellite]\n%s", TLE);
    glint_scenario *s = read_three(PART_TIME, TIME, PART_ORBIT, GEO, PART_OBSERVER, text);
    ck_assert_uint_eq(places_of(s, geo_m, range_m), N);
    glint_scenario_free(s);
    snprintf(text, sizeof text, "[orbit]\n%s", TLE);
    s = read_three(PART_TIME, TIME, PART_SETTINGS, AT_ONCE, PART_ORBIT, text);
    ck_assert_uint_eq(places_of(s, iss_m, unused), N);
    glint_scenario_free(s);
    for (int k = 0; k < N; k++) {
        sub3(geo_m[k], iss_m[k], between);
        assert_near(range_m[k], norm3(between), 1e-6);
    }
}
END_TEST

/* ------------------------------------------------------------ several at once */

#define VIENNA_SITE "name = \"Vienna, Prater\"\nlatitude_deg = 48.2\nlongitude_deg = 16.37\n"
#define GRAZ_SITE "name = \"Graz\"\nlatitude_deg = 47.07\nlongitude_deg = 15.44\nheight_m = 400\n"
#define GEO_EYE "name = \"geo\"\nsatellite = { circular = { geostationary_longitude_deg = 10 } }\n"

static const char THREE[] =
    "[[observer]]\n" VIENNA_SITE "[[observer]]\n" GEO_EYE "[[observer]]\n" GRAZ_SITE;
static const char *const ALONE[] = {"[observer]\n" VIENNA_SITE, "[observer]\n" GEO_EYE,
                                    "[observer]\n" GRAZ_SITE};
static const char *const NAMES[] = {"Vienna, Prater", "geo", "Graz"};

START_TEST(test_observers_several_have_the_rows_of_each_alone)
{
    glint_scenario *s = read_with(SOUND, PART_OBSERVER, THREE);
    run_rows all = run(s, 3);
    ck_assert_uint_eq(all.n, 3 * 7);
    for (size_t k = 0; k < 3; k++) {
        run_rows one = run_with(SOUND, PART_OBSERVER, ALONE[k]);
        ck_assert_uint_eq(one.n, 7);
        for (size_t i = 0; i < one.n; i++) {
            const glint_row *a = &all.rows[7 * k + i], *b = &one.rows[i];
            ck_assert_str_eq(a->observer, NAMES[k]);
            ck_assert_double_eq(a->t_s, b->t_s);
            ck_assert_double_eq(a->range_m, b->range_m);
            ck_assert_double_eq(a->phase_angle_rad, b->phase_angle_rad);
            ck_assert_double_eq(a->elevation_rad, b->elevation_rad);
            ck_assert_double_eq(a->flux_ratio[0], b->flux_ratio[0]);
            ck_assert_uint_eq(a->flags, b->flags);
        }
        rows_free(&one);
    }
    rows_free(&all);
    glint_scenario_free(s);
}
END_TEST

/* One table: the same bytes on any number of threads, names with commas in quotes, cells that an
 * observer does not have empty. */
START_TEST(test_observers_several_make_one_table)
{
    char *bytes[2];
    for (int k = 0; k < 2; k++) {
        glint_scenario *s = read_with(SOUND, PART_OBSERVER, THREE);
        glint_curve *curve;
        ck_assert_int_eq(glint_curve_open(s, k ? 4 : 1, &curve, NULL), GLINT_OK);
        ck_assert_uint_eq(glint_curve_observers(curve), 3);
        ck_assert_int_eq(glint_curve_length(curve), 21);
        const char *path = in_folder("several.csv");
        ck_assert_int_eq(glint_table_write(curve, path, NULL, NULL, NULL, NULL, NULL), GLINT_OK);
        glint_error error;
        ck_assert_int_eq(glint_table_write(curve, path, "a.svg", NULL, NULL, NULL, &error),
                         GLINT_ARGUMENT);
        ck_assert_ptr_nonnull(strstr(error.message, "one observer"));
        bytes[k] = read_bytes(path, NULL);
        glint_curve_close(curve);
        glint_scenario_free(s);
    }
    ck_assert_str_eq(bytes[0], bytes[1]);
    free(bytes[0]);
    free(bytes[1]);
    csv_table t = table_open(in_folder("several.csv"));
    ck_assert_int_eq(t.n_rows, 21);
    ck_assert_int_eq(csv_column(&t, "observer"), 1);
    for (long row = 0; row < t.n_rows; row++) {
        ck_assert_str_eq(table_text(&t, row, "observer"), NAMES[row / 7]);
        ck_assert_int_eq(table_text(&t, row, "azimuth_deg")[0] == '\0', row / 7 == 1);
        ck_assert_int_eq(table_text(&t, row, "sun_elevation_deg")[0] == '\0', row / 7 == 1);
        ck_assert_str_ne(table_text(&t, row, "range_km"), "");
    }
    csv_free(&t);
}
END_TEST

/* The same of an ephemeris, in all its formats. */
START_TEST(test_observers_several_make_one_ephemeris)
{
    static const glint_format FORMATS[] = {GLINT_FORMAT_CSV, GLINT_FORMAT_JSON, GLINT_FORMAT_TABLE};
    glint_scenario *s = read_with(SOUND, PART_OBSERVER, THREE);
    char *written[3];
    for (size_t k = 0; k < 3; k++) {
        glint_ephemeris *e;
        const char *path = in_folder("ephemeris");
        ck_assert_int_eq(glint_ephemeris_open(s, 2, &e, NULL), GLINT_OK);
        ck_assert_int_eq(glint_ephemeris_length(e), 21);
        ck_assert_int_eq(glint_ephemeris_write(e, FORMATS[k], path, NULL, NULL, NULL), GLINT_OK);
        glint_ephemeris_close(e);
        written[k] = read_bytes(path, NULL);
    }
    const char *path = write_file("ephemeris.csv", written[0]);
    csv_table t = table_open(path);
    ck_assert_int_eq(t.n_rows, 21);
    for (long row = 0; row < t.n_rows; row++) {
        ck_assert_str_eq(table_text(&t, row, "observer"), NAMES[row / 7]);
        ck_assert_int_eq(table_text(&t, row, "elevation_deg")[0] == '\0', row / 7 == 1);
        assert_near(table_number(&t, row, "t_s"), 10.0 * (double)(row % 7), 0);
    }
    csv_free(&t);
    int azimuths = 0, geo = 0;
    for (const char *c = written[1]; (c = strstr(c, "\"azimuth_deg\"")); c++)
        azimuths++;
    for (const char *c = written[1]; (c = strstr(c, "\"observer\": \"geo\"")); c++)
        geo++;
    ck_assert_int_eq(azimuths, 14);
    ck_assert_int_eq(geo, 7);
    ck_assert_ptr_nonnull(strstr(written[2], "  Vienna, Prater\n"));
    for (size_t k = 0; k < 3; k++)
        free(written[k]);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_observers_expectations_name_theirs)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_OBSERVER] = THREE;
    glint_scenario *s = read_with(SOUND, PART_OBSERVER, THREE);
    run_rows all = run(s, 1);
    char expect[512];
    snprintf(expect, sizeof expect,
             "[[expect]]\nt_s = 10\ncolumn = \"range_km\"\nvalue = %.15g\ntolerance = 1e-9\n"
             "[[expect]]\nt_s = 10\nobserver = \"Graz\"\ncolumn = \"range_km\"\nvalue = %.15g\n"
             "tolerance = 1e-9\n[[expect]]\nrow = 8\ncolumn = \"range_km\"\nvalue = %.15g\n"
             "tolerance = 1e-9\n",
             all.rows[1].range_m * 1e-3, all.rows[15].range_m * 1e-3, all.rows[8].range_m * 1e-3);
    rows_free(&all);
    glint_scenario_free(s);
    const marked_text m = with_part(parts, PART_EXPECT, expect);
    const char *path = write_file("scenario.toml", m.text);
    glint_verdict verdict;
    ck_assert_int_eq(glint_verify(path, NULL, 0, 1, &verdict, NULL), GLINT_OK);
    ck_assert_int_eq(verdict.expectations, 3);
    static const wrong_text WRONG[] = {
        {PART_EXPECT,
         "[[expect]]\nt_s = 10\nobserver = @\"Linz\"\ncolumn = \"range_km\"\nvalue = 1\n"
         "tolerance = 1\n",
         "no observer is named 'Linz'", NULL, 0},
        {PART_EXPECT,
         "[[expect]]\nrow = 1\nobserver = @\"Graz\"\ncolumn = \"range_km\"\nvalue = 1\n"
         "tolerance = 1\n",
         "beside 'row'", "'t_s'", 0},
    };
    ASSERT_ALL_WRONG(parts, WRONG);
}
END_TEST

/* ----------------------------------------------------------- horizon, darkness */

static const char TWO_DAYS[] =
    "[time]\nstart = 2024-01-01T12:00:00Z\nduration_s = 172800\nstep_s = 5\n";
static const char ISS_LIKE[] =
    "[orbit]\ncircular = { height_km = 420, inclination_deg = 51.6, raan_deg = 100, "
    "argument_of_latitude_deg = 0 }\n";

/* Passes over the observers of a scenario of two days. */
static glint_passes *find_passes(const char *observer, glint_scenario **s)
{
    *s = read_three(PART_TIME, TWO_DAYS, PART_ORBIT, ISS_LIKE, PART_OBSERVER, observer);
    const glint_pass_options options = {.threads = 2};
    glint_passes *passes;
    glint_error error;
    ck_assert_msg(glint_passes_find(*s, &options, &passes, &error) == GLINT_OK, "%s",
                  error.message);
    return passes;
}

#define SITE "[observer]\nlatitude_deg = 48.2\nlongitude_deg = 16.37\nheight_m = 200\n"

START_TEST(test_observers_level_mask_is_a_least_elevation)
{
    glint_scenario *s, *masked;
    glint_passes *a = find_passes(SITE "min_elevation_deg = 12\n", &s);
    glint_passes *b = find_passes(SITE "horizon_deg = [[0, 12], [100, 12]]\n", &masked);
    ck_assert_uint_ge(glint_passes_count(a), 6);
    ck_assert_uint_eq(glint_passes_count(a), glint_passes_count(b));
    for (size_t k = 0; k < glint_passes_count(a); k++) {
        const glint_pass *p = glint_passes_get(a, k), *q = glint_passes_get(b, k);
        assert_near(p->from_s, q->from_s, 3e-6); /* each to 1e-6 s, and inward */
        assert_near(p->to_s, q->to_s, 3e-6);
    }
    glint_passes_free(a);
    glint_passes_free(b);
    glint_scenario_free(s);
    glint_scenario_free(masked);
}
END_TEST

/* A skyline with towers 1 deg wide: every row that is above it lies in a pass, and no other, and
 * rise and set are on it. */
START_TEST(test_observers_passes_over_a_skyline_agree_with_rows)
{
    glint_scenario *s;
    glint_passes *passes = find_passes(
        SITE
        "horizon_deg = [[0, 2], [40, 5], [40.1, 60], [41, 60], [41.1, 5], [120, 25], [180, 0], "
        "[250, 70], [250.5, 3], [300, 3], [300.1, 30], [310, 30], [310.1, 2]]\n",
        &s);
    const scenario_observer *o = &s->observers[0];
    ck_assert_uint_ge(glint_passes_count(passes), 8);
    for (size_t k = 0; k < glint_passes_count(passes); k++) {
        const glint_pass *p = glint_passes_get(passes, k);
        for (size_t i = 0; i < p->n_events; i++) {
            const glint_pass_event *e = &p->events[i];
            const double over = e->elevation_rad - horizon_limit(&o->horizon, e->azimuth_rad);
            if (e->kind == GLINT_RISE || e->kind == GLINT_SET)
                /* a tower's side rises by 550 deg for a deg, and the azimuth runs at up to 3 deg/s:
                 * 1e-6 s are 1.6e-3 deg */
                assert_near(over / DEG, 0, 2e-3);
            else
                ck_assert(over > -1e-9);
        }
    }
    run_rows r = run(s, 2);
    size_t at = 0, up = 0;
    for (size_t k = 0; k < r.n; k++) {
        const glint_row *row = &r.rows[k];
        while (at < glint_passes_count(passes) && glint_passes_get(passes, at)->to_s < row->t_s)
            at++;
        const glint_pass *p = glint_passes_get(passes, at);
        const bool in_pass = p && row->t_s >= p->from_s && row->t_s <= p->to_s;
        const bool seen = !(row->flags & GLINT_BELOW_HORIZON);
        ck_assert_msg(in_pass == seen, "t_s = %g: azimuth %g, elevation %g", row->t_s,
                      row->azimuth_rad / DEG, row->elevation_rad / DEG);
        ck_assert_int_eq(seen, row->elevation_rad >= horizon_limit(&o->horizon, row->azimuth_rad));
        up += seen;
    }
    ck_assert_uint_gt(up, 300);
    rows_free(&r);
    glint_passes_free(passes);
    glint_scenario_free(s);
}
END_TEST

/* Refraction lets the satellite rise where its geometric elevation is the limit's, lowered. */
START_TEST(test_observers_refraction_moves_rise_and_set)
{
    char lowered[256];
    const refraction air = {true, 980, 15};
    snprintf(lowered, sizeof lowered, SITE "min_elevation_deg = %.15g\n",
             refraction_geometric(&air, 1 * DEG) / DEG);
    glint_scenario *s, *geometric;
    glint_passes *a = find_passes(SITE "min_elevation_deg = 1\nrefraction = { pressure_hPa = 980, "
                                       "temperature_C = 15 }\n",
                                  &s);
    glint_passes *b = find_passes(lowered, &geometric);
    ck_assert_uint_ge(glint_passes_count(a), 8);
    ck_assert_uint_eq(glint_passes_count(a), glint_passes_count(b));
    for (size_t k = 0; k < glint_passes_count(a); k++) {
        const glint_pass *p = glint_passes_get(a, k), *q = glint_passes_get(b, k);
        assert_near(p->from_s, q->from_s, 3e-6);
        assert_near(p->to_s, q->to_s, 3e-6);
        for (size_t i = 0; i < p->n_events; i++)
            if (p->events[i].kind == GLINT_RISE)
                assert_near(p->events[i].elevation_rad, 1 * DEG, 1e-8);
    }
    run_rows apparent = run(s, 2), plain = run(geometric, 2);
    for (size_t k = 0; k < plain.n; k++) {
        const glint_row *x = &apparent.rows[k], *y = &plain.rows[k];
        assert_near(x->elevation_rad, refraction_apparent(&air, y->elevation_rad), 1e-14);
        ck_assert_double_eq(x->azimuth_rad, y->azimuth_rad);
        ck_assert_double_eq(x->sun_elevation_rad, y->sun_elevation_rad);
        if (!(x->flags & GLINT_BELOW_HORIZON)) ck_assert(x->airmass < y->airmass);
        ck_assert_uint_eq(x->flags, y->flags);
    }
    rows_free(&apparent);
    rows_free(&plain);
    glint_passes_free(a);
    glint_passes_free(b);
    glint_scenario_free(s);
    glint_scenario_free(geometric);
}
END_TEST

/* Passes over all sites, each named; satellites among the observers have none; none but satellites
 * is an error. */
START_TEST(test_observers_passes_are_those_of_every_site)
{
    glint_scenario *s, *one, *none;
    glint_passes *all = find_passes(THREE, &s);
    size_t at = 0;
    for (size_t k = 0; k < 3; k += 2) {
        glint_passes *alone = find_passes(ALONE[k], &one);
        for (size_t i = 0; i < glint_passes_count(alone); i++, at++) {
            const glint_pass *p = glint_passes_get(all, at), *q = glint_passes_get(alone, i);
            ck_assert_ptr_nonnull(p);
            ck_assert_str_eq(p->site, NAMES[k]);
            ck_assert_double_eq(p->from_s, q->from_s);
            ck_assert_uint_eq(p->n_events, q->n_events);
        }
        glint_passes_free(alone);
        glint_scenario_free(one);
    }
    ck_assert_uint_eq(glint_passes_count(all), at);
    const char *path = in_folder("passes.csv");
    const glint_passes *const list[] = {all};
    ck_assert_int_eq(glint_passes_write(list, 1, GLINT_FORMAT_CSV, path, NULL), GLINT_OK);
    csv_table t = table_open(path);
    for (long row = 1; row < t.n_rows; row++)
        ck_assert(table_number(&t, row, "pass") > table_number(&t, row - 1, "pass") ||
                  strcmp(table_text(&t, row, "site"), table_text(&t, row - 1, "site")) == 0);
    csv_free(&t);
    none = read_with(SOUND, PART_OBSERVER, ALONE[1]);
    glint_passes *nothing;
    glint_error error;
    ck_assert_int_eq(glint_passes_find(none, NULL, &nothing, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "no observer is a site"));
    glint_passes_free(all);
    glint_scenario_free(s);
    glint_scenario_free(none);
}
END_TEST

/* The same limit of the Sun's altitude decides rows, flags and the darkness of passes. */
START_TEST(test_observers_darkness_is_one_for_rows_and_passes)
{
    static const char DARK[] = "[output]\nsun_elevation_max_deg = -9\nrows = \"dark-site\"\n";
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = TWO_DAYS;
    parts[PART_ORBIT] = ISS_LIKE;
    parts[PART_OBSERVER] = SITE;
    glint_scenario *s = read_with(parts, PART_SETTINGS, DARK);
    run_rows r = run(s, 1);
    glint_passes *passes;
    ck_assert_int_eq(glint_passes_find(s, NULL, &passes, NULL), GLINT_OK);
    double dark_s = 0;
    for (size_t k = 0; k < glint_passes_count(passes); k++)
        dark_s += glint_passes_get(passes, k)->dark_site_s;
    ck_assert(dark_s > 300);
    /* a row every 5 s; each span of darkness cuts a step at both ends */
    assert_near(5.0 * (double)r.n, dark_s, 5.0 * 2 * (double)glint_passes_count(passes));
    for (size_t k = 0; k < r.n; k++) {
        ck_assert(r.rows[k].flags & GLINT_SITE_DARK);
        ck_assert(r.rows[k].sun_elevation_rad < -9 * DEG);
        ck_assert_uint_eq(r.rows[k].flags & (GLINT_BELOW_HORIZON | GLINT_UMBRA), 0);
    }
    rows_free(&r);
    glint_passes_free(passes);
    glint_scenario_free(s);
}
END_TEST

static const char MASK[] = "# a mask\nazimuth_deg,elevation_deg\n0,5\n120,12.5\n245.5,33\n";

/* Cut off at any byte, a mask is an error, or the points before the cut exactly as they are. */
START_TEST(test_observers_mask_cut_anywhere_is_an_error_or_what_was_before)
{
    static const double POINTS[][2] = {{0, 5}, {120, 12.5}, {245.5, 33}};
    const marked_text m = with_part(SOUND, PART_OBSERVER, SITE "horizon = \"mask.csv\"\n");
    int whole = 0;
    const char *path = write_file("scenario.toml", m.text), *file = write_file("mask.csv", MASK);
    for (size_t cut = strlen(MASK) + 1; cut-- > 0;) {
        glint_scenario *s;
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(truncate(file, (off_t)cut), 0);
        if (glint_scenario_read(path, NULL, 0, &s, errors) == GLINT_OK) {
            const horizon *h = &s->observers[0].horizon;
            ck_assert_int_ge(h->n, 1);
            for (int k = 0; k < h->n; k++) {
                assert_near(h->points[k].azimuth, POINTS[k][0] * DEG, 1e-15);
                assert_near(h->points[k].elevation, POINTS[k][1] * DEG, 1e-15);
            }
            const bool in_line = cut > 0 && MASK[cut - 1] != '\n';
            ck_assert_int_eq(glint_errors_count(errors) > 0, in_line);
            whole += h->n == 3;
        }
        glint_scenario_free(s);
        glint_errors_free(errors);
    }
    ck_assert_int_eq(whole, 1);
}
END_TEST

/* ------------------------------------------------------------------- the Moon */

/* astropy 5.2.1 (get_body, AltAz without air, measured UT1: 0.1 s or 1.5 arcsec; the Moon good to
 * 14 arcsec in both, from the same series). */
START_TEST(test_observers_moon_is_where_another_program_sees_it)
{
    static const struct {
        const char *start;
        double azimuth_deg, elevation_deg, illuminated;
    } ROWS[] = {
        {"2025-07-25T20:37:00", 312.1243, -10.4752, 0.013514},
        {"2022-03-12T18:00:00", 151.6195, 65.7047, 0.713361},
        {"2021-10-20T21:30:00", 148.3917, 46.4987, 0.998451},
    };
    for (size_t k = 0; k < COUNT_OF(ROWS); k++) {
        char time[128];
        snprintf(time, sizeof time, "[time]\nstart = %sZ\nduration_s = 0\nstep_s = 1\n",
                 ROWS[k].start);
        glint_scenario *s = read_three(PART_TIME, time, PART_OBSERVER, SITE, PART_SETTINGS,
                                       "[output]\nmoon = true\n");
        run_rows r = run(s, 1);
        assert_near(r.rows[0].moon_azimuth_rad / DEG, ROWS[k].azimuth_deg, 0.003);
        assert_near(r.rows[0].moon_elevation_rad / DEG, ROWS[k].elevation_deg, 0.002);
        assert_near(r.rows[0].moon_illuminated, ROWS[k].illuminated, 1e-5);
        glint_ephemeris *e;
        const glint_ephemeris_row *rows;
        size_t n;
        ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
        ck_assert_int_eq(glint_ephemeris_next(e, &rows, &n, NULL), GLINT_OK);
        assert_near(rows[0].moon_separation_rad, r.rows[0].moon_separation_rad, 1e-13);
        glint_ephemeris_close(e);
        rows_free(&r);
        glint_scenario_free(s);
    }
}
END_TEST

/* The events of moon_shadow.csv as runs: the sunlit fraction of a geostationary point. */
START_TEST(test_observers_moon_shadow_dims_a_geostationary_satellite)
{
    csv_table t = table_open(TEST_DATA_DIR "/orbit/moon_shadow.csv");
    int covered = 0;
    for (long row = 0; row < t.n_rows; row++) {
        char time[128], orbit_text[128];
        snprintf(time, sizeof time, "[time]\nstart = %s\nduration_s = 0\nstep_s = 1\n",
                 table_text(&t, row, "utc"));
        snprintf(orbit_text, sizeof orbit_text,
                 "[orbit]\ncircular = { geostationary_longitude_deg = %s }\n",
                 table_text(&t, row, "longitude_deg"));
        const char *parts[N_PARTS];
        memcpy(parts, SOUND, sizeof parts);
        parts[PART_TIME] = time;
        parts[PART_ORBIT] = orbit_text;
        parts[PART_OBSERVER] =
            "[observer.direction]\nframe = \"gcrs\"\nvector = [0, 0, 1]\nrange_km = 1\n";
        run_rows r = run_with(parts, PART_SETTINGS, AT_ONCE);
        const double want = table_number(&t, row, "fraction");
        /* the cubic between nodes: 0.3 km at the Moon is 5e-5 deg, of a disc of half a degree */
        assert_near(r.rows[0].sunlit_fraction, want, 2e-4);
        const unsigned flags = r.rows[0].flags;
        ck_assert_int_eq((flags & GLINT_MOON_SHADOW) != 0, want < 1);
        ck_assert_int_eq((flags & GLINT_PENUMBRA) != 0, want < 1);
        covered += want < 1;
        rows_free(&r);
    }
    ck_assert_int_gt(covered, 15);
    csv_free(&t);
}
END_TEST

/* A run that comes from far away in time meets the same event. */
START_TEST(test_observers_moon_shadow_is_met_by_a_run_on_its_way)
{
    csv_table t = table_open(TEST_DATA_DIR "/orbit/moon_shadow.csv");
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-09-21T00:00:00Z\nduration_s = 86400\nstep_s = 360\n";
    parts[PART_ORBIT] = "[orbit]\ncircular = { geostationary_longitude_deg = -85 }\n";
    parts[PART_OBSERVER] =
        "[observer.direction]\nframe = \"gcrs\"\nvector = [0, 0, 1]\nrange_km = 1\n";
    run_rows r = run_with(parts, PART_SETTINGS, AT_ONCE);
    int found = 0;
    for (long row = 0; row < t.n_rows; row++) {
        const char *utc = table_text(&t, row, "utc");
        if (strncmp(utc, "2025-09-21T", 11) != 0) continue;
        const int step = 10 * atoi(utc + 11) + atoi(utc + 14) / 6;
        assert_near(r.rows[step].sunlit_fraction, table_number(&t, row, "fraction"), 2e-4);
        found++;
    }
    ck_assert_int_gt(found, 8);
    int flagged = 0; /* from 15:54 to 16:42, and nowhere else */
    for (size_t k = 0; k < r.n; k++)
        flagged += (r.rows[k].flags & GLINT_MOON_SHADOW) != 0;
    ck_assert_int_eq(flagged, 9);
    rows_free(&r);
    csv_free(&t);
}
END_TEST

/* ------------------------------------------------------------ what is said of it */

/* The fact of a run in a new text; "" where there is none. */
static char *fact_of(const glint_scenario *s, const char *wanted)
{
    glint_curve *curve;
    const char *key, *value;
    char *out = NULL;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    for (size_t k = 0; !out && glint_curve_fact(curve, k, &key, &value); k++)
        if (strcmp(key, wanted) == 0) out = strdup(value);
    glint_curve_close(curve);
    return out ? out : strdup("");
}

static void assert_says(const glint_scenario *s, const char *key, const char *with,
                        const char *without)
{
    char *value = fact_of(s, key);
    ck_assert_msg(!with || strstr(value, with), "%s: %s; wanted '%s'", key, value, with);
    ck_assert_msg(!without || !strstr(value, without), "%s: %s; unwanted '%s'", key, value,
                  without);
    free(value);
}

START_TEST(test_observers_header_says_what_is_assumed)
{
    glint_scenario *s = read_with(SOUND, PART_OBSERVER, SITE);
    assert_says(s, "not_modelled", "refraction of the line of sight", "Moon's shadow");
    assert_says(s, "eclipse", "Moon's disc", NULL);
    assert_says(s, "dut1_s", "taken as 0", NULL);
    assert_says(s, "polar_motion", "taken as 0", NULL);
    assert_says(s, "observer", "48.2", "refraction");
    glint_scenario_free(s);
    s = read_with(SOUND, PART_OBSERVER, SITE "refraction = true\nhorizon_deg = [[0, 5]]\n");
    assert_says(s, "not_modelled", NULL, "refraction of the line of sight");
    assert_says(s, "observer", "Bennett 1982", NULL);
    assert_says(s, "observer", "a mask of 1 points up to 5 deg", NULL);
    glint_scenario_free(s);
    s = read_with(SOUND, PART_OBSERVER, THREE);
    assert_says(s, "observers", "geo: a satellite, geostationary", NULL);
    assert_says(s, "observer", NULL, "Vienna");
    glint_scenario_free(s);
    char settings[1200];
    snprintf(settings, sizeof settings, "[corrections]\neop = \"%s\"\n",
             TEST_DATA_DIR "/orbit/eop_finals.txt");
    s = read_three(PART_TIME,
                   "[time]\nstart = 2016-04-25T12:00:00Z\nduration_s = 60\nstep_s = 10\n",
                   PART_OBSERVER, SITE, PART_SETTINGS, settings);
    assert_says(s, "eop", "predictions from 2016-04-29", NULL);
    assert_says(s, "dut1_s", "-0.127", "taken as 0");
    glint_scenario_free(s);
}
END_TEST

/* What a mask's file holds is a part of what tells runs apart. */
START_TEST(test_observers_hash_knows_the_mask)
{
    char *hash[2];
    for (int k = 0; k < 2; k++) {
        write_file("mask.csv", k ? "azimuth_deg,elevation_deg\n0,5\n" : MASK);
        glint_scenario *s = read_with(SOUND, PART_OBSERVER, SITE "horizon = \"mask.csv\"\n");
        hash[k] = fact_of(s, "scenario_hash");
        glint_scenario_free(s);
    }
    ck_assert_str_ne(hash[0], hash[1]);
    free(hash[0]);
    free(hash[1]);
}
END_TEST

/* The total eclipse of 8 April 2024 where it was greatest: 25.3 N, 104.1 W, 18:18:29 TD, 4 min 28 s
 * of totality (Espenak, NASA eclipse predictions, from JPL's ephemerides and a Moon 0.05 %
 * smaller). 25 km of the Moon's place move the middle by up to 40 s and change the duration by 3 %;
 * its size does by 2 s. */
START_TEST(test_observers_moon_makes_the_eclipse_of_april_2024)
{
    utc_time start = {2024, 4, 8, 18, 10, 0};
    run_clock clock;
    frame_grid *grid = NULL;
    const earth_orientation still = {0, 0};
    earth_site site;
    run_clock_start(&start, 1200, 0, &clock);
    ck_assert_int_eq(frame_grid_prepare(&clock, &still, 0, 1200, 1, &grid, NULL), GLINT_OK);
    ck_assert_int_eq(earth_site_at(25.29 * DEG, -104.14 * DEG, 0, &site, NULL), GLINT_OK);
    double from_s = -1, to_s = -1;
    for (double t_s = 0; t_s <= 1200; t_s += 0.5) {
        frame_set f;
        double r[3], sun[3], moon[3], distance_m;
        frame_grid_at(grid, t_s, FRAMES_SUN, &f);
        mat_tvec(f.itrs_gcrs, site.r_itrs_m, r);
        sun_from_point(&f, r, true, sun, &distance_m);
        moon_position(&clock, t_s, NULL, moon);
        sub3(moon, r, moon);
        if (eclipse_moon_fraction(moon, sun, distance_m, 0) > 0) continue;
        if (from_s < 0) from_s = t_s;
        to_s = t_s;
    }
    const double tt_minus_utc_s = 69.184, greatest_s = 8 * 60 + 29 - tt_minus_utc_s;
    assert_near(to_s - from_s, 268, 11);
    assert_near(0.5 * (from_s + to_s), greatest_s, 40);
    frame_grid_free(grid);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("observers");
    TCase *tc = tcase_create("observers");
    tcase_set_timeout(tc, 60);
    tcase_add_checked_fixture(tc, folder_make, folder_remove);
    tcase_add_test(tc, test_observers_satellite_sees_along_the_chord);
    tcase_add_test(tc, test_observers_satellite_has_no_site_columns);
    tcase_add_test(tc, test_observers_direction_of_the_body_sees_a_plate_in_closed_form);
    tcase_add_test(tc, test_observers_direction_lies_where_it_is_said);
    tcase_add_test(tc, test_observers_satellite_rates_are_differences_of_rows);
    tcase_add_test(tc, test_observers_satellite_of_an_element_set_is_where_its_orbit_is);
    tcase_add_test(tc, test_observers_several_have_the_rows_of_each_alone);
    tcase_add_test(tc, test_observers_several_make_one_table);
    tcase_add_test(tc, test_observers_several_make_one_ephemeris);
    tcase_add_test(tc, test_observers_expectations_name_theirs);
    tcase_add_test(tc, test_observers_level_mask_is_a_least_elevation);
    tcase_add_test(tc, test_observers_passes_over_a_skyline_agree_with_rows);
    tcase_add_test(tc, test_observers_refraction_moves_rise_and_set);
    tcase_add_test(tc, test_observers_passes_are_those_of_every_site);
    tcase_add_test(tc, test_observers_darkness_is_one_for_rows_and_passes);
    tcase_add_test(tc, test_observers_mask_cut_anywhere_is_an_error_or_what_was_before);
    tcase_add_test(tc, test_observers_moon_is_where_another_program_sees_it);
    tcase_add_test(tc, test_observers_moon_shadow_dims_a_geostationary_satellite);
    tcase_add_test(tc, test_observers_moon_shadow_is_met_by_a_run_on_its_way);
    tcase_add_test(tc, test_observers_header_says_what_is_assumed);
    tcase_add_test(tc, test_observers_hash_knows_the_mask);
    tcase_add_test(tc, test_observers_moon_makes_the_eclipse_of_april_2024);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
