/* Ephemerides: every column against an independent program or a closed form. */
#include "base/constants.h"
#include "base/vec.h"
#include "scenario_text.h"
#include "table.h"

/* ------------------------------------------------------------------ helpers */

static const char ISS_LINES[] =
    "\"1 25544U 98067A   24001.50000000  .00016717  00000-0  30270-3 0  9999\",\n"
    "\"2 25544  51.6400 208.9163 0006317  69.9862 290.2553 15.49560532 10001\"";
static const char GEO_LINES[] =
    "\"1 41866U 16071A   24001.50000000 -.00000100  00000-0  00000+0 0  9993\",\n"
    "\"2 41866   0.0300  90.0000 0001000 100.0000 262.0000  1.00271000 26000\"";
static const char MOLNIYA_LINES[] =
    "\"1 99901U 24001A   24001.50000000  .00000010  00000-0  00000+0 0  9997\",\n"
    "\"2 99901  63.4000 120.0000 7400000 270.0000  10.0000  2.00600000    16\"";

static const char *lines_of(const char *satellite)
{
    if (strcmp(satellite, "ISS-like") == 0) return ISS_LINES;
    if (strcmp(satellite, "GEO") == 0) return GEO_LINES;
    ck_assert_str_eq(satellite, "MOLNIYA");
    return MOLNIYA_LINES;
}

/* One row of an ephemeris at a moment. rest: more tables. */
static glint_ephemeris_row row_of(const char *utc, const char *lines, double latitude_deg,
                                  double longitude_deg, double height_m, const char *rest)
{
    char text[TEXT_SIZE];
    snprintf(text, sizeof text,
             "[time]\nstart = \"%s\"\nduration_s = 0\nstep_s = 1\n[observer]\nlatitude_deg = "
             "%.17g\nlongitude_deg = %.17g\nheight_m = %.17g\n[orbit]\ntle_lines = [%s]\n%s",
             utc, latitude_deg, longitude_deg, height_m, lines, rest);
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    ck_assert_msg(glint_scenario_read_orbit(write_file("at.toml", text), NULL, 0, &s, errors) ==
                      GLINT_OK,
                  "%s", list_errors(errors));
    glint_errors_free(errors);
    glint_ephemeris *e;
    const glint_ephemeris_row *rows;
    size_t n;
    glint_error error;
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, &error), GLINT_OK);
    ck_assert_msg(glint_ephemeris_next(e, &rows, &n, &error) == GLINT_OK, "%s", error.message);
    ck_assert_uint_eq(n, 1);
    glint_ephemeris_row row = rows[0];
    row.hinge_rad = NULL;
    glint_ephemeris_close(e);
    glint_scenario_free(s);
    return row;
}

static void assert_vector(const double got[3], const double want[3], double tolerance)
{
    for (int i = 0; i < 3; i++)
        assert_near(got[i], want[i], tolerance);
}

/* ---------------------------------------------------------- against the tables */

static void check_topocentric(const char *path)
{
    csv_table t = table_open(path);
    double worst_deg = 0.0, worst_km = 0.0;
    for (long k = 0; k < t.n_rows; k++) {
        const double latitude = table_number(&t, k, "lat_deg"),
                     longitude = table_number(&t, k, "lon_deg"),
                     height_m = table_number(&t, k, "h_m");
        const char *lines = lines_of(table_text(&t, k, "sat")), *utc = table_text(&t, k, "utc");
        const glint_ephemeris_row plain = row_of(utc, lines, latitude, longitude, height_m,
                                                 "[corrections]\nlight_time = false\n");
        double teme_km[3], itrs_km[3], got[3];
        table_vector(&t, k, "teme_", "_km", teme_km);
        table_vector(&t, k, "itrs_", "_km", itrs_km);
        scale3(plain.r_teme_m, 1e-3, got);
        assert_vector(got, teme_km, 1e-6);
        scale3(plain.r_itrs_m, 1e-3, got);
        assert_vector(got, itrs_km, 1e-6);
        assert_near(plain.azimuth_rad / DEG, table_number(&t, k, "az_deg"), 1e-6);
        assert_near(plain.elevation_rad / DEG, table_number(&t, k, "el_deg"), 1e-6);
        assert_near(plain.range_m * 1e-3, table_number(&t, k, "range_km"), 1e-5);
        assert_near(plain.range_rate_m_s * 1e-3, table_number(&t, k, "range_rate_kms"), 1e-6);
        const glint_ephemeris_row late = row_of(utc, lines, latitude, longitude, height_m, "");
        assert_near(late.azimuth_rad / DEG, table_number(&t, k, "lt_az_deg"), 1e-6);
        assert_near(late.elevation_rad / DEG, table_number(&t, k, "lt_el_deg"), 1e-6);
        assert_near(late.range_m * 1e-3, table_number(&t, k, "lt_range_km"), 1e-5);
        worst_deg =
            fmax(worst_deg, fabs(late.elevation_rad / DEG - table_number(&t, k, "lt_el_deg")));
        worst_deg =
            fmax(worst_deg, fabs(late.azimuth_rad / DEG - table_number(&t, k, "lt_az_deg")));
        worst_km = fmax(worst_km, fabs(late.range_m * 1e-3 - table_number(&t, k, "lt_range_km")));
    }
    printf("%s: %ld rows, worst: %.2g deg, %.2g km\n", path, t.n_rows, worst_deg, worst_km);
    csv_free(&t);
}

START_TEST(test_ephemeris_agrees_with_another_program)
{
    table_check(check_topocentric, "orbit/topocentric.csv");
}
END_TEST

static void check_attitude(const char *path)
{
    static const char *const LAWS[] = {"nadir", "rsw"}, *const PREFIXES[] = {"qvvlh_", "qrsw_"};
    csv_table t = table_open(path);
    for (long k = 0; k < t.n_rows; k++)
        for (int law = 0; law < 2; law++) {
            char rest[128], w[16];
            snprintf(rest, sizeof rest,
                     "[attitude]\nlaw = \"%s\"\n[corrections]\nlight_time = false\n", LAWS[law]);
            const glint_ephemeris_row row = row_of(
                table_text(&t, k, "utc"), lines_of(table_text(&t, k, "sat")), 48.2, 16.37, 0, rest);
            double r_km[3], v_km_s[3], want[4], got[3];
            table_vector(&t, k, "r_", "_km", r_km);
            table_vector(&t, k, "v_", "_kms", v_km_s);
            scale3(row.r_gcrs_m, 1e-3, got);
            assert_vector(got, r_km, 1e-6);
            scale3(row.v_gcrs_m_s, 1e-3, got);
            assert_vector(got, v_km_s, 1e-8);
            snprintf(w, sizeof w, "%sw", PREFIXES[law]);
            want[0] = table_number(&t, k, w);
            table_vector(&t, k, PREFIXES[law], "", want + 1);
            double same = 0;
            for (int i = 0; i < 4; i++)
                same += want[i] * row.quaternion_wxyz[i];
            /* q and -q are the same turn; positions are rounded to 1e-9 km, velocities to 1e-9 km/s
             */
            for (int i = 0; i < 4; i++)
                assert_near(same > 0 ? row.quaternion_wxyz[i] : -row.quaternion_wxyz[i], want[i],
                            1e-9);
        }
    csv_free(&t);
}

START_TEST(test_ephemeris_turns_body_axes_into_gcrs)
{
    table_check(check_attitude, "orbit/attitude_lvlh_array.csv");
}
END_TEST

/* A sequence of a table, a slew and another table, and hinges that follow a table, in a chain: the
 * quaternions are those of the files, the share of the slew is that of its time. */
START_TEST(test_ephemeris_follows_sequences_and_tables)
{
    static const char STARTS[] = "2024-01-01T12:00:00Z";
    write_file("rest.csv", "t_s,qw,qx,qy,qz\n-10,1,0,0,0\n1000,-1,0,0,0\n");
    write_file("turn.csv", "utc,qw,qx,qy,qz\n2024-01-01T11:59:00Z,0.8,0,0,0.6\n"
                           "2024-01-01T12:10:00Z,0.8,0,0,0.6\n");
    write_file("inner.csv", "t_s,angle_deg\n-10,0\n90,100\n");
    write_file("outer.csv", "t_s,angle_deg\n-10,340\n10,20\n90,20\n");
    const double full = 2 * atan2(0.6, 0.8);
    static const double AFTER_S[] = {0, 20, 50}, SHARE[] = {0, 0.25, 1};
    for (int k = 0; k < 3; k++) { /* the row at 0 s, and the sequence that long before */
        char text[TEXT_SIZE];
        snprintf(
            text, sizeof text,
            "[time]\nstart = \"%s\"\nduration_s = 60\nstep_s = %g\n[observer]\n"
            "latitude_deg = 48\nlongitude_deg = 16\n[orbit]\ntle_lines = [%s]\n"
            "[[attitude]]\nlaw = \"table\"\nfile = \"rest.csv\"\n"
            "[[attitude]]\nfrom = 10\nslew_s = 40\nlaw = \"table\"\nfile = \"turn.csv\"\n"
            "[corrections]\nlight_time = false\n[materials.m]\nbrdf = \"lambert\"\nrho = 1\n"
            "[[component]]\nname = \"inner\"\nhinge = { origin_m = [0, 0, 0], axis = [1, 0, 0], "
            "table = \"inner.csv\" }\n[[component]]\nname = \"outer\"\nparent = \"inner\"\n"
            "hinge = { origin_m = [0, 0, 0], axis = [0, 1, 0], table = \"outer.csv\", "
            "shortest_way = true, offset_deg = 5, limits_deg = [-7, 370] }\n"
            "[[component.plate]]\nsize_m = [1, 1]\nnormal = [0, 0, 1]\ntangent = [1, 0, 0]\n"
            "material = \"m\"\n",
            STARTS, k == 0 ? 60 : AFTER_S[k], ISS_LINES);
        glint_scenario *s = read_sound(write_file("sequence.toml", text));
        glint_ephemeris *e;
        const glint_ephemeris_row *rows;
        size_t n;
        ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
        ck_assert_int_eq(glint_ephemeris_next(e, &rows, &n, NULL), GLINT_OK);
        ck_assert_uint_ge(n, 2);
        const glint_ephemeris_row *row = &rows[k == 0 ? 0 : 1];
        const double t_s = AFTER_S[k], angle = 0.5 * full * SHARE[k];
        assert_near(row->t_s, t_s, 0);
        assert_near(row->quaternion_wxyz[0], cos(angle), 1e-12);
        assert_near(row->quaternion_wxyz[1], 0, 1e-12);
        assert_near(row->quaternion_wxyz[2], 0, 1e-12);
        assert_near(row->quaternion_wxyz[3], sin(angle), 1e-12);
        /* from 340 on to 380 deg; 5 deg more; not above 370 deg */
        assert_near(row->hinge_rad[0], (t_s + 10) * DEG, 1e-12);
        const double outer_deg = t_s < 10 ? 340 + 2 * (t_s + 10) : 380;
        assert_near(row->hinge_rad[1], fmin(outer_deg + 5, 370) * DEG, 1e-12);
        glint_ephemeris_close(e);
        glint_scenario_free(s);
    }
}
END_TEST

/* Laws that look at the observer turn the satellite otherwise for each of several: at 1 deg/s from
 * the axes of GCRS, about their z, by 30 deg to one observer and by 120 deg back to the other. */
START_TEST(test_ephemeris_slew_to_each_of_several_observers_is_its_own)
{
    static const char TEXT[] =
        "[time]\nstart = 2024-01-01T12:00:00Z\nduration_s = 160\nstep_s = 20\n"
        "[[observer]]\nname = \"30\"\n"
        "direction = { frame = \"gcrs\", vector = [0.8660254037844387, 0.5, 0] }\n"
        "[[observer]]\nname = \"-120\"\n"
        "direction = { frame = \"gcrs\", vector = [-0.5, -0.8660254037844387, 0] }\n"
        "[orbit]\ncircular = { geostationary_longitude_deg = 10 }\n"
        "[[attitude]]\nlaw = \"inertial\"\nquaternion_wxyz = [1, 0, 0, 0]\n"
        "[[attitude]]\nfrom = 10\nslew_rate_deg_s = 1\nlaw = \"point\"\naxis = [1, 0, 0]\n"
        "to = \"observer\"\nsecond_axis = [0, 0, 1]\nsecond_to = \"north\"\n"
        "[corrections]\nlight_time = false\n";
    static const double WHOLE_DEG[] = {30, -120};
    glint_scenario *s;
    ck_assert_int_eq(glint_scenario_read_orbit(write_file("slew.toml", TEXT), NULL, 0, &s, NULL),
                     GLINT_OK);
    glint_ephemeris *e;
    const glint_ephemeris_row *rows;
    size_t n, all = 0;
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
    while (glint_ephemeris_next(e, &rows, &n, NULL) == GLINT_OK && n > 0) {
        for (size_t k = 0; k < n; k++, all++) {
            const double whole = WHOLE_DEG[rows[k].observer];
            const double turned_deg = fmin(fmax(rows[k].t_s - 10, 0), fabs(whole));
            const double half = copysign(0.5 * turned_deg * DEG, whole);
            const double *q = rows[k].quaternion_wxyz, sign = q[0] < 0 ? -1 : 1;
            assert_near(sign * q[0], cos(half), 1e-12);
            assert_near(sign * q[3], sin(half), 1e-12);
        }
    }
    ck_assert_uint_eq(all, 18);
    glint_ephemeris_close(e);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------ what must hold */

/* Reads a scenario and holds it up for `check`, row by row, with the row before. */
static void each_row(const char *path, void (*check)(const glint_ephemeris_row *before,
                                                     const glint_ephemeris_row *row))
{
    glint_scenario *s = read_sound(path);
    glint_ephemeris *e;
    ck_assert_int_eq(glint_ephemeris_open(s, 2, &e, NULL), GLINT_OK);
    const glint_ephemeris_row *rows;
    size_t n, all = 0;
    while (glint_ephemeris_next(e, &rows, &n, NULL) == GLINT_OK && n > 0) {
        for (size_t k = 0; k < n; k++)
            check(k > 0 ? &rows[k - 1] : NULL, &rows[k]);
        all += n;
    }
    ck_assert_int_eq((int64_t)all, glint_ephemeris_length(e));
    ck_assert_int_eq((int64_t)all, glint_ephemeris_done(e));
    glint_ephemeris_close(e);
    glint_scenario_free(s);
}

/* Rates are differences of what they are rates of, over 0.1 s: the mean of two ends leaves dt^2/12
 * of the second derivative, 1e-4 m/s, and 1e-6 of the angular rate. */
static void check_rates(const glint_ephemeris_row *before, const glint_ephemeris_row *row)
{
    if (!before) return;
    const double dt_s = row->t_s - before->t_s;
    const double rate = 0.5 * (row->range_rate_m_s + before->range_rate_m_s);
    assert_near((row->range_m - before->range_m) / dt_s, rate, 1e-3); /* m/s of 7000 */
    const double a[3] = {cos(before->dec_rad) * cos(before->ra_rad),
                         cos(before->dec_rad) * sin(before->ra_rad), sin(before->dec_rad)};
    const double b[3] = {cos(row->dec_rad) * cos(row->ra_rad), cos(row->dec_rad) * sin(row->ra_rad),
                         sin(row->dec_rad)};
    assert_rel(angle3(a, b) / dt_s, 0.5 * (row->angular_rate_rad_s + before->angular_rate_rad_s),
               1e-5);
    /* The time of the light's way is known to 1e-6 s, in which the Earth turns by 0.5 mm up there:
     * twice that in 0.1 s. The light that arrives dt later left dt (1 - range rate / c) later. */
    const double slowed = 1 - row->range_rate_m_s / LIGHT_SPEED_M_S;
    double moved[3], mean[3];
    for (int i = 0; i < 3; i++) {
        moved[i] = (row->r_itrs_m[i] - before->r_itrs_m[i]) / dt_s;
        mean[i] = slowed * 0.5 * (row->v_itrs_m_s[i] + before->v_itrs_m_s[i]);
        assert_near(moved[i], mean[i], 1e-2); /* m/s */
    }
}

START_TEST(test_ephemeris_rates_are_differences)
{
    static const char TIME[] =
        "[time]\nstart = 2025-07-25T20:35:00Z\nduration_s = 240\nstep_s = 0.1\n";
    /* without J2: its precession is in the places, but not in the velocities */
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_ORBIT] = "[orbit]\ncircular = { height_km = 780, inclination_deg = 98.6, raan_deg = "
                        "80, argument_of_latitude_deg = 132, j2 = false }\n";
    const marked_text m = with_part(parts, PART_TIME, TIME);
    each_row(write_file("scenario.toml", m.text), check_rates);
}
END_TEST

/* Angles hold together: the Sun's separation from the satellite and the phase angle add to 180 deg
 * but for the Sun's parallax over the range; frames have the same lengths; beta is that of the
 * definition. */
static void check_angles(const glint_ephemeris_row *before, const glint_ephemeris_row *row)
{
    (void)before;
    const double parallax = row->range_m / AU_M;
    /* from the site the Sun stands elsewhere by the parallax; aberration is the same for both */
    assert_near(row->sun_separation_rad + row->phase_angle_rad, PI, 1.1 * parallax + 1e-9);
    assert_rel(norm3(row->r_itrs_m), norm3(row->r_gcrs_m), 1e-14);
    ck_assert(row->moon_separation_rad >= 0 && row->moon_separation_rad <= PI);
    ck_assert(row->ra_rad >= 0 && row->ra_rad < TWO_PI);
    ck_assert(fabs(row->beta_rad) <= 0.5 * PI);
    const double latitude = row->latitude_rad, flat = EARTH_FLATTENING;
    /* the point below, lifted to the height: Hofmann-Wellenhof et al., ellipsoidal coordinates */
    const double e2 = flat * (2 - flat);
    const double curvature_m = EARTH_RADIUS_M / sqrt(1 - e2 * sin(latitude) * sin(latitude));
    const double across_m = (curvature_m + row->height_m) * cos(latitude);
    const double want[3] = {across_m * cos(row->longitude_rad), across_m * sin(row->longitude_rad),
                            (curvature_m * (1 - e2) + row->height_m) * sin(latitude)};
    assert_vector(row->r_itrs_m, want, 1e-6);
}

START_TEST(test_ephemeris_angles_hold_together)
{
    each_row(TEST_DATA_DIR "/endtoend/geo-eclipse-season.toml", check_angles);
    each_row(TEST_DATA_DIR "/endtoend/iss-vienna.toml", check_angles);
}
END_TEST

/* The direction at the satellite between Sun and plane of the orbit, from positions alone: a
 * circular orbit in the plane of the equator has beta = the Sun's declination, 23.4 deg at the
 * solstice. */
START_TEST(test_ephemeris_beta_is_the_declination_over_the_equator)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2024-06-20T20:51:00Z\nduration_s = 0\nstep_s = 1\n";
    parts[PART_ORBIT] = "[orbit]\ncircular = { height_km = 780, inclination_deg = 0, raan_deg = 0, "
                        "argument_of_latitude_deg = 0 }\n";
    const marked_text m = with_part(parts, PART_TOP, "");
    glint_scenario *s = read_sound(write_file("scenario.toml", m.text));
    glint_ephemeris *e;
    const glint_ephemeris_row *rows;
    size_t n;
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
    ck_assert_int_eq(glint_ephemeris_next(e, &rows, &n, NULL), GLINT_OK);
    /* the obliquity of 2024, 23.4361 deg (IAU 2006); GCRS and the equator of date differ by 0.14
     * deg in right ascension, 0.003 deg here; parallax at 7158 km: 0.003 deg */
    assert_near(rows[0].beta_rad / DEG, 23.436, 0.006);
    glint_ephemeris_close(e);
    glint_scenario_free(s);
}
END_TEST

/* A geostationary satellite stands still over the ground, and so moves with it while its light is
 * on its way: with light time it is 0.12 s, 370 m, behind where it is without. */
START_TEST(test_ephemeris_of_a_fixed_place_is_that_of_emission)
{
    static const char *const CORRECTIONS[] = {"", "[corrections]\nlight_time = false\n"};
    const char *parts[N_PARTS];
    glint_ephemeris_row row[2];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_ORBIT] = "[orbit]\ncircular = { geostationary_longitude_deg = 10 }\n";
    for (int k = 0; k < 2; k++) {
        const marked_text m = with_part(parts, PART_SETTINGS, CORRECTIONS[k]);
        glint_scenario *s = read_sound(write_file("scenario.toml", m.text));
        glint_ephemeris *e;
        const glint_ephemeris_row *rows;
        size_t n;
        ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
        ck_assert_int_eq(glint_ephemeris_next(e, &rows, &n, NULL), GLINT_OK);
        row[k] = rows[0];
        glint_ephemeris_close(e);
        glint_scenario_free(s);
    }
    double moved[3];
    const double light_s = row[0].range_m / LIGHT_SPEED_M_S;
    add_scaled3(row[1].r_gcrs_m, -light_s, row[1].v_gcrs_m_s, moved);
    assert_vector(row[0].r_gcrs_m, moved, 3e-3); /* a t^2 / 2 is 1.6 mm */
    /* the last step of light time, 1e-6 s at most, moves the satellite and not the axes: 3 mm */
    assert_vector(row[0].r_itrs_m, row[1].r_itrs_m, 3e-3);
}
END_TEST

/* -------------------------------------------------------------------- columns */

static size_t column(const glint_ephemeris *e, const char *name)
{
    size_t n;
    const glint_column *columns = glint_ephemeris_columns(e, &n);
    for (size_t k = 0; k < n; k++)
        if (strcmp(columns[k].name, name) == 0) return k;
    return n;
}

START_TEST(test_ephemeris_has_the_columns_that_the_scenario_has)
{
    glint_scenario *s = read_sound(TEST_DATA_DIR "/endtoend/iss-vienna.toml");
    glint_ephemeris *e;
    const glint_ephemeris_row *rows;
    size_t n, n_columns;
    double value;
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
    ck_assert_int_eq(glint_ephemeris_next(e, &rows, &n, NULL), GLINT_OK);
    glint_ephemeris_columns(e, &n_columns);
    ck_assert_uint_lt(column(e, "x_teme_km"), n_columns);
    ck_assert_uint_lt(column(e, "q_w"), n_columns);
    ck_assert(!glint_ephemeris_value(e, &rows[0], 0, &value));
    ck_assert(!glint_ephemeris_value(e, &rows[0], n_columns, &value));
    for (size_t k = 1; k < n_columns; k++) {
        ck_assert(glint_ephemeris_value(e, &rows[0], k, &value));
        ck_assert(isfinite(value));
    }
    ck_assert(glint_ephemeris_value(e, &rows[0], column(e, "height_km"), &value));
    assert_rel(value, rows[0].height_m * 1e-3, 1e-15);
    glint_ephemeris_close(e);
    glint_scenario_free(s);
    s = read_with(SOUND, PART_TOP, ""); /* a circular orbit: no TEME */
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
    glint_ephemeris_columns(e, &n_columns);
    ck_assert_uint_eq(column(e, "x_teme_km"), n_columns);
    glint_ephemeris_close(e);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_ephemeris_tells_the_angles_of_hinges)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_COMPONENT] =
        "[[component]]\nname = \"bus\"\n[[component]]\nname = \"wing\"\nparent = "
        "\"bus\"\nhinge = { origin_m = [0, 1, 0], axis = [0, 1, 0], rate_deg_s = "
        "2, angle_deg = 5 }\n";
    const marked_text m = with_part(parts, PART_SETTINGS, "[corrections]\nlight_time = false\n");
    glint_scenario *s = read_sound(write_file("scenario.toml", m.text));
    glint_ephemeris *e;
    const glint_ephemeris_row *rows;
    size_t n;
    double value;
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
    ck_assert_int_eq(glint_ephemeris_next(e, &rows, &n, NULL), GLINT_OK);
    for (size_t k = 0; k < n; k++) {
        ck_assert(glint_ephemeris_value(e, &rows[k], column(e, "hinge_wing_deg"), &value));
        assert_near(value, 5 + 2 * rows[k].t_s, 1e-12);
    }
    glint_ephemeris_close(e);
    glint_scenario_free(s);
}
END_TEST

/* A light curve of each kind of orbit stands where the ephemeris does. */
START_TEST(test_ephemeris_agrees_with_light_curves)
{
    static const char *const ORBITS[] = {
        ISS_LINES, GEO_LINES, MOLNIYA_LINES,
        "\"1 90005U 24001A   24001.50000000  .00000000  00000-0  00000+0 0  9992\",\n"
        "\"2 90005  55.0000 200.0000 0100000  30.0000 330.0000  2.00562000    14\"",
        "\"1 90002U 24001A   24001.50000000  .00000000  00000-0  10000-4 0  9995\",\n"
        "\"2 90002  98.2000  15.0000 0010000  90.0000 270.0000 14.57000000    15\""};
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2024-01-02T00:00:00Z\nduration_s = 86400\nstep_s = 97\n";
    for (size_t k = 0; k < COUNT_OF(ORBITS); k++) {
        char orbit[1024];
        snprintf(orbit, sizeof orbit, "[orbit]\ntle_lines = [%s]\n", ORBITS[k]);
        glint_scenario *s = read_with(parts, PART_ORBIT, orbit);
        glint_curve *curve;
        glint_ephemeris *e;
        const glint_row *rows;
        const glint_ephemeris_row *places;
        size_t n, m, count = 0;
        ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
        ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, NULL), GLINT_OK);
        ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
        ck_assert_int_eq(glint_ephemeris_next(e, &places, &m, NULL), GLINT_OK);
        for (size_t i = 0; i < n && i < m; i++, count++) {
            /* the light time's first guess differs, and with it the rounding of the time of
             * emission and of angles of up to 100 rad: 3e-14 rad, times 42 000 km */
            assert_near(rows[i].range_m, places[i].range_m, 4e-6);
            assert_near(rows[i].azimuth_rad, places[i].azimuth_rad, 1e-11);
            assert_near(rows[i].elevation_rad, places[i].elevation_rad, 1e-12);
            assert_near(rows[i].phase_angle_rad, places[i].phase_angle_rad, 1e-12);
            assert_near(rows[i].sunlit_fraction, places[i].sunlit_fraction, 1e-10);
            assert_near(rows[i].sun_elevation_rad, places[i].sun_elevation_rad, 1e-14);
        }
        ck_assert_uint_gt(count, 500);
        glint_curve_close(curve);
        glint_ephemeris_close(e);
        glint_scenario_free(s);
    }
}
END_TEST

START_TEST(test_ephemeris_refuses_given_directions)
{
    glint_scenario *s = read_with(GIVEN, PART_TOP, GIVEN[PART_TOP]);
    glint_ephemeris *e;
    glint_error error;
    ck_assert_int_eq(glint_ephemeris_open(s, 1, &e, &error), GLINT_INPUT);
    ck_assert_ptr_null(e);
    ck_assert(strstr(error.message, "[geometry]") != NULL);
    ck_assert_int_eq(glint_ephemeris_open(s, -1, &e, NULL), GLINT_INPUT);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_ephemeris_open_takes_a_sensible_number_of_threads)
{
    static const int wrong[] = {-1, 1025};
    glint_scenario *s = read_with(SOUND, PART_TOP, "");
    glint_ephemeris *e;
    glint_error error;
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        ck_assert_int_eq(glint_ephemeris_open(s, wrong[k], &e, &error), GLINT_ARGUMENT);
        ck_assert_ptr_null(e);
        ck_assert_ptr_nonnull(strstr(error.message, "expected 1 to 1024"));
    }
    ck_assert_int_eq(glint_ephemeris_open(s, 0, &e, &error), GLINT_OK);
    glint_ephemeris_close(e);
    glint_scenario_free(s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("ephemeris");
    TCase *tc = tcase_create("ephemeris");
    tcase_add_checked_fixture(tc, folder_make, folder_remove);
    tcase_set_timeout(tc, 120);
    tcase_add_test(tc, test_ephemeris_agrees_with_another_program);
    tcase_add_test(tc, test_ephemeris_turns_body_axes_into_gcrs);
    tcase_add_test(tc, test_ephemeris_follows_sequences_and_tables);
    tcase_add_test(tc, test_ephemeris_slew_to_each_of_several_observers_is_its_own);
    tcase_add_test(tc, test_ephemeris_rates_are_differences);
    tcase_add_test(tc, test_ephemeris_angles_hold_together);
    tcase_add_test(tc, test_ephemeris_beta_is_the_declination_over_the_equator);
    tcase_add_test(tc, test_ephemeris_of_a_fixed_place_is_that_of_emission);
    tcase_add_test(tc, test_ephemeris_has_the_columns_that_the_scenario_has);
    tcase_add_test(tc, test_ephemeris_tells_the_angles_of_hinges);
    tcase_add_test(tc, test_ephemeris_agrees_with_light_curves);
    tcase_add_test(tc, test_ephemeris_refuses_given_directions);
    tcase_add_test(tc, test_ephemeris_open_takes_a_sensible_number_of_threads);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
