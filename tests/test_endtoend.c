/* Whole scenarios against an independent program that follows the same physics at every step
 * without interpolation (its rows lie in data/endtoend). */
#include "scenario_text.h"
#include "table.h"

/* How far a column may be off. The reference evaluates everything at every step; we interpolate the
 * frames and the Sun on grids, to 1e-5 arcsec = 3e-9 deg (physics page, section 5). What follows
 * from that: 0.4 m at 7000 km; 1e-8 of the solar disc, half a degree wide; shares and magnitudes by
 * the slope of a lobe, 1.1 mag x 2 tan(12 deg) / 0.04^2 per rad, 1e-8. Azimuths are worse near the
 * zenith, airmasses near the horizon, by the tangent of the elevation or its inverse. */
typedef struct tolerance {
    const char *column; /* begins with this */
    double absolute, relative;
} tolerance;

#define ANGLE_DEG 3e-9
#define SUNLIT 1e-8
#define MAG 1e-8

static const tolerance TOLERANCES[] = {
    {"t_s", 0, 0},
    {"range_km", 4e-7, 0},
    {"phase_angle_deg", ANGLE_DEG, 0},
    {"sunlit_fraction", SUNLIT, 0},
    {"azimuth_deg", 30 * ANGLE_DEG, 0},
    {"elevation_deg", ANGLE_DEG, 0},
    {"sun_elevation_deg", ANGLE_DEG, 0},
    {"airmass", 0, 1e-8},
    {"share_", MAG, 0},
};

static const tolerance *tolerance_of(const char *column)
{
    for (size_t k = 0; k < COUNT_OF(TOLERANCES); k++)
        if (strncmp(column, TOLERANCES[k].column, strlen(TOLERANCES[k].column)) == 0)
            return &TOLERANCES[k];
    return NULL;
}

/* Largest deviations, for the report. */
typedef struct worst {
    double light, penumbra; /* mag, or relative */
    double other[COUNT_OF(TOLERANCES)];
} worst;

static bool begins(const char *content, const char *start)
{
    return strncmp(content, start, strlen(start)) == 0;
}

static void raise_to(double *most, double value)
{
    if (value > *most) *most = value;
}

/* A magnitude or flux ratio; sunlit: the expected fraction of the row. */
static void compare_light(const char *label, const char *column, double got, double want,
                          double sunlit, worst *w)
{
    const bool whole = sunlit == 1;
    if (!whole && sunlit <= 0.01) return; /* the last rays: the reference says not to compare */
    const double allowed = MAG + (whole ? 0 : SUNLIT / sunlit); /* mag; nearly the same relative */
    const bool is_mag = begins(column, "mag_");
    const double off = is_mag ? fabs(got - want) : fabs(got / want - 1);
    raise_to(whole ? &w->light : &w->penumbra, off);
    ck_assert_msg(off <= 1.1 * allowed, "%s: %.12g instead of %.12g", label, got, want);
}

static void compare_cell(const glint_curve *curve, const glint_row *row, size_t column,
                         const glint_column *info, const csv_table *want, long k, worst *w)
{
    char label[128], cell[GLINT_CELL_SIZE];
    snprintf(label, sizeof label, "%s, row %ld, %s", want->path, k, info->name);
    glint_curve_text(curve, row, column, cell);
    const char *expected = table_text(want, k, info->name);
    if (begins(info->name, "flags")) return; /* the spelling is ours: test_curve.c */
    if (begins(info->name, "utc")) {
        ck_assert_msg(strncmp(cell, expected, 19) == 0, "%s: %s instead of %s", label, cell,
                      expected);
        return;
    }
    double got;
    const bool full = glint_curve_value(curve, row, column, &got);
    ck_assert_msg(full == (expected[0] != '\0'), "%s: '%s' instead of '%s'", label, cell, expected);
    if (!full) return;
    const double value = table_number(want, k, info->name);
    if (value == 0 && begins(info->name, "flux_ratio_")) {
        ck_assert_msg(got == 0, "%s: %g instead of 0", label, got);
    } else if (begins(info->name, "mag_") || begins(info->name, "flux_ratio_")) {
        compare_light(label, info->name, got, value, table_number(want, k, "sunlit_fraction"), w);
    } else {
        const tolerance *t = tolerance_of(info->name);
        ck_assert_msg(t != NULL, "%s has no tolerance", info->name);
        raise_to(&w->other[t - TOLERANCES], fabs(got - value));
        ck_assert_msg(is_near(got, value, t->absolute + t->relative * fabs(value)),
                      "%s: %.12g instead of %.12g", label, got, value);
    }
}

static void report(const char *name, long rows, const worst *w)
{
    printf("%s: %ld rows, worst: mag %.2g, in the penumbra %.2g", name, rows, w->light,
           w->penumbra);
    for (size_t k = 0; k < COUNT_OF(TOLERANCES); k++)
        printf(", %s %.2g", TOLERANCES[k].column, w->other[k]);
    printf("\n");
}

static void check_scenario(const char *folder_of_data, const char *name, const char *expected,
                           const char *const *set, size_t n_set)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s.toml", folder_of_data, name);
    glint_scenario *s = read_sound_set(path, set, n_set);
    snprintf(path, sizeof path, "%s/%s.expected.csv", folder_of_data, expected);
    csv_table want = table_open(path);
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 0, &curve, NULL), GLINT_OK);
    size_t n_columns, n;
    const glint_column *columns = glint_curve_columns(curve, &n_columns);
    ck_assert_int_eq((int)n_columns, want.n_columns);
    for (size_t i = 0; i < n_columns; i++)
        ck_assert_str_eq(columns[i].name, want.cells[i].text);
    worst w = {0};
    long k = 0;
    const glint_row *rows;
    while (glint_curve_next(curve, &rows, &n, NULL) == GLINT_OK && n > 0)
        for (size_t i = 0; i < n; i++, k++) {
            ck_assert_int_lt(k, want.n_rows);
            for (size_t c = 0; c < n_columns; c++)
                compare_cell(curve, &rows[i], c, &columns[c], &want, k, &w);
        }
    ck_assert_int_eq(k, want.n_rows);
    report(expected, k, &w);
    glint_curve_close(curve);
    glint_scenario_free(s);
    csv_free(&want);
}

static void check_everywhere(const char *name, const char *expected, const char *const *set,
                             size_t n_set)
{
    check_scenario(TEST_DATA_DIR "/endtoend", name, expected, set, n_set);
    const char *dir = reference_dir(name);
    if (dir) check_scenario(path_in(dir, "golden/endtoend"), name, expected, set, n_set);
}

START_TEST(test_endtoend_station_over_vienna)
{
    check_everywhere("iss-vienna", "iss-vienna", NULL, 0);
}
END_TEST

START_TEST(test_endtoend_spinning_rocket_body)
{
    check_everywhere("rocket-spin", "rocket-spin", NULL, 0);
}
END_TEST

START_TEST(test_endtoend_geostationary_night_with_shadows)
{
    check_everywhere("geo-eclipse-season", "geo-eclipse-season", NULL, 0);
}
END_TEST

START_TEST(test_endtoend_geostationary_night_without_shadows)
{
    static const char *const set[] = {"satellite.self_shadows=\"none\"",
                                      "photometry.solar_disc=\"point\""};
    check_everywhere("geo-eclipse-season", "geo-eclipse-season.plain", set, COUNT_OF(set));
}
END_TEST

static Suite *endtoend_suite(void)
{
    Suite *suite = suite_create("endtoend");
    TCase *all = tcase_create("scenarios");
    tcase_set_timeout(all, 60);
    tcase_add_test(all, test_endtoend_station_over_vienna);
    tcase_add_test(all, test_endtoend_spinning_rocket_body);
    tcase_add_test(all, test_endtoend_geostationary_night_with_shadows);
    tcase_add_test(all, test_endtoend_geostationary_night_without_shadows);
    suite_add_tcase(suite, all);
    return suite;
}

int main(void)
{
    return run_suite(endtoend_suite());
}
