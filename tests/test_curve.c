/* Light curves as a whole: the same on any number of threads, in blocks, with shares, flags,
 * filters, extinction and corrections that do what they should. */
#include "base/constants.h"
#include "base/vec.h"
#include "lightcurve/photometry.h"
#include "run_rows.h"

#include <sys/resource.h>

static const char VIENNA[] = TEST_DATA_DIR "/endtoend/iss-vienna.toml";

/* The station over Vienna, with these settings. */
static run_rows run_vienna(const char *const *set, size_t n_set)
{
    glint_scenario *s = read_sound_set(VIENNA, set, n_set);
    const run_rows out = run(s, 1);
    glint_scenario_free(s);
    return out;
}

/* ------------------------------------------------------------------ threads, blocks */

/* A resonant orbit of half a day and great eccentricity: SGP4 integrates along it. */
#define MOLNIYA                                                                                    \
    "[orbit]\ntle_lines = [\"1 90002U 24001B   25206.00000000  .00000000  00000-0  00000+0 0  "    \
    "9992\",\n\"2 90002  63.4000 100.0000 7000000 270.0000  10.0000  2.00600000    13\"]\n"

static void assert_same_rows(const run_rows *a, const run_rows *b)
{
    ck_assert_uint_eq(a->n, b->n);
    const size_t width = rows_width(a);
    ck_assert_mem_eq(a->numbers, b->numbers, a->n * width * sizeof *a->numbers);
    for (size_t k = 0; k < a->n; k++) {
        const glint_row *x = &a->rows[k], *y = &b->rows[k];
        ck_assert_mem_eq(&x->t_s, &y->t_s, offsetof(glint_row, flags) - offsetof(glint_row, t_s));
        ck_assert_uint_eq(x->flags, y->flags);
    }
}

/* The bytes of the table that a run on so many threads writes. */
static char *table_bytes(const glint_scenario *s, int threads, size_t *n)
{
    glint_curve *curve;
    glint_error error;
    ck_assert_int_eq(glint_curve_open(s, threads, &curve, NULL), GLINT_OK);
    ck_assert_int_eq(glint_curve_threads(curve), threads);
    const char *path = in_folder("table.csv");
    ck_assert_msg(glint_table_write(curve, path, NULL, NULL, NULL, NULL, &error) == GLINT_OK, "%s",
                  error.message);
    glint_curve_close(curve);
    return read_bytes(path, n);
}

static void assert_threads_agree(const glint_scenario *s)
{
    static const int threads[] = {2, 3, 7};
    size_t n, n_one;
    run_rows one = run(s, 1);
    char *bytes_one = table_bytes(s, 1, &n_one);
    for (size_t k = 0; k < COUNT_OF(threads); k++) {
        run_rows many = run(s, threads[k]);
        assert_same_rows(&one, &many);
        rows_free(&many);
        char *bytes = table_bytes(s, threads[k], &n);
        ck_assert_uint_eq(n, n_one);
        ck_assert(memcmp(bytes, bytes_one, n) == 0);
        free(bytes);
    }
    free(bytes_one);
    rows_free(&one);
}

START_TEST(test_curve_threads_give_the_same_bits)
{
    glint_scenario *s = read_sound_set(VIENNA, NULL, 0);
    assert_threads_agree(s);
    glint_scenario_free(s);
    const char *const longer[] = {"time.start=2025-07-25T00:00:00Z",
                                  "time.end=2025-07-26T00:00:00Z", "time.step_s=5.0"};
    s = read_sound_set(VIENNA, longer, COUNT_OF(longer)); /* 17 281 rows: more than one block */
    assert_threads_agree(s);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_curve_threads_give_the_same_bits_on_a_resonant_orbit)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-07-26T00:00:00Z\nduration_s = 2e6\nstep_s = 400\n";
    glint_scenario *s = read_with(parts, PART_ORBIT, MOLNIYA);
    assert_threads_agree(s);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_curve_threads_give_the_same_bits_for_given_directions)
{
    glint_scenario *s = read_with(GIVEN, PART_TIME,
                                  "[geometry]\nrotate = { axis = [1, 2, 3], step_deg = 0.05, "
                                  "sun = [1, 0, 0], observer = [1, 1, 0] }\n");
    assert_threads_agree(s);
    glint_scenario_free(s);
}
END_TEST

/* What a row says does not depend on the rows before it. */
START_TEST(test_curve_row_is_the_same_at_another_step)
{
    const char *const fine[] = {"time.step_s=0.5"}, *const coarse[] = {"time.step_s=30"};
    run_rows a = run_vienna(fine, 1), b = run_vienna(coarse, 1);
    for (size_t k = 0; k < b.n; k++) {
        const glint_row *x = &a.rows[60 * k], *y = &b.rows[k];
        assert_near(x->t_s, y->t_s, 0);
        assert_near(x->range_m, y->range_m, 1e-5); /* m: light times differ by 1e-15 s of 1e-6 */
        assert_near(x->flux_ratio[0], y->flux_ratio[0], 1e-9 * y->flux_ratio[0]);
    }
    rows_free(&a);
    rows_free(&b);
}
END_TEST

static long peak_memory_kb(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

START_TEST(test_curve_blocks_stream_in_constant_memory)
{
    enum { STEPS = 200000, MORE_KB = 4096 };
    glint_scenario *s = read_with(SOUND, PART_TIME,
                                  "[time]\nstart = 2025-07-25T00:00:00Z\nduration_s = 199999\n"
                                  "step_s = 1\n");
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    ck_assert_int_eq(glint_curve_length(curve), STEPS);
    const glint_row *rows, *first = NULL;
    size_t n, blocks = 0;
    long peak_kb = 0;
    int64_t total = 0;
    while (glint_curve_next(curve, &rows, &n, NULL) == GLINT_OK && n > 0) {
        ck_assert(rows == first || !first); /* the same memory every time */
        assert_near(rows[0].t_s, (double)total, 0);
        first = rows;
        total += (int64_t)n;
        if (++blocks == 2) peak_kb = peak_memory_kb();
    }
    ck_assert_int_eq(total, STEPS);
    ck_assert_uint_gt(blocks, 5);
#ifdef __SANITIZE_ADDRESS__ /* which keeps freed memory for a while */
    (void)peak_kb;
#else
    ck_assert_int_le(peak_memory_kb() - peak_kb, MORE_KB);
#endif
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------------ shares */

START_TEST(test_curve_shares_add_to_one)
{
    run_rows r = run_vienna(NULL, 0);
    size_t bright = 0;
    for (size_t k = 0; k < r.n; k++) {
        const glint_row *row = &r.rows[k];
        double material = 0, component = 0;
        for (size_t i = 0; i < r.n_materials; i++)
            material += fabs(row->share_material[i]);
        for (size_t i = 0; i < r.n_components; i++)
            component += fabs(row->share_component[i]);
        const double sum = row->flux_ratio[0] > 0;
        bright += row->flux_ratio[0] > 0;
        assert_near(material, sum, 1e-15); /* three shares: a few roundings */
        assert_near(component, sum, 1e-15);
    }
    ck_assert_uint_gt(bright, 50);
    rows_free(&r);
}
END_TEST

/* Two Lambert plates side by side, out of each other's shadow: shares are as rho A cos i cos r. */
START_TEST(test_curve_shares_closed_form)
{
    const char *parts[N_PARTS];
    memcpy(parts, GIVEN, sizeof parts);
    parts[PART_TIME] = "[geometry]\nsweep = { phase_deg = [0, 80, 20], plane = \"xz\" }\n";
    parts[PART_MATERIAL] = "[materials.a]\nbrdf = \"lambert\"\nrho = 0.3\n"
                           "[materials.b]\nbrdf = \"lambert\"\nrho = 0.8\n";
    parts[PART_SETTINGS] = "[photometry]\nsolar_disc = \"point\"\n[output]\nshares = \"both\"\n";
    parts[PART_COMPONENT] = "[[component]]\nname = \"flat\"\n";
    run_rows r = run_with(
        parts, PART_PRIMITIVE,
        "[[component.plate]]\nsize_m = [1, 2]\nnormal = [0, 0, 1]\ntangent = [1, 0, 0]\n"
        "material = \"a\"\n"
        "[[component]]\nname = \"tilted\"\n[[component.plate]]\nsize_m = [1, 1]\n"
        "centre_m = [0, 10, 0]\nnormal = [1, 0, 1]\ntangent = [0, 1, 0]\nmaterial = \"b\"\n");
    ck_assert_uint_eq(r.n, 5);
    for (size_t k = 0; k < r.n; k++) {
        const double phase = (double)k * 20 * DEG;
        const double a = 0.3 * 2 * cos(phase), b = 0.8 * cos(phase - PI / 4) * cos(PI / 4);
        assert_rel(r.rows[k].share_material[0], a / (a + b), 1e-14);
        assert_rel(r.rows[k].share_component[1], b / (a + b), 1e-14);
        assert_rel(r.rows[k].flux_ratio[0], (a + b) / PI / 1e12, 1e-14); /* 1000 km */
    }
    rows_free(&r);
}
END_TEST

/* ------------------------------------------------------------------ flags, rows, columns */

/* The station over Vienna from above the horizon into the shadow, with 10 deg for the horizon. */
START_TEST(test_curve_flags_say_why_a_row_is_dark)
{
    const char *const set[] = {"observer.min_elevation_deg=10",
                               "output.sun_elevation_max_deg=-11.5"};
    run_rows r = run_vienna(set, COUNT_OF(set));
    unsigned seen = 0;
    for (size_t k = 0; k < r.n; k++) {
        const glint_row *row = &r.rows[k];
        const bool low = row->elevation_rad<10 * DEG, bright = row->flux_ratio[0]> 0;
        ck_assert_int_eq((row->flags & GLINT_BELOW_HORIZON) != 0, low);
        ck_assert_int_eq((row->flags & GLINT_UMBRA) != 0, row->sunlit_fraction == 0);
        ck_assert_int_eq((row->flags & GLINT_PENUMBRA) != 0,
                         row->sunlit_fraction > 0 && row->sunlit_fraction < 1);
        ck_assert_int_eq((row->flags & GLINT_SITE_DARK) != 0, row->sun_elevation_rad < -11.5 * DEG);
        ck_assert_int_eq(bright, !low && row->sunlit_fraction > 0);
        ck_assert_int_eq((row->flags & GLINT_DARK) != 0, 0); /* some side is always lit and seen */
        seen |= row->flags;
        if (!bright) assert_near(row->magnitude[0], 0, 0);
    }
    ck_assert_uint_eq(seen, GLINT_BELOW_HORIZON | GLINT_UMBRA | GLINT_PENUMBRA | GLINT_SITE_DARK);
    rows_free(&r);
}
END_TEST

#define ONE_PLATE                                                                                  \
    "[[component.plate]]\nsize_m = [1, 1]\nnormal = [0, 0, 1]\ntangent = [1, 0, 0]\n"              \
    "material = \"white\"\n"

START_TEST(test_curve_row_with_nothing_lit_in_sight_is_flagged_dark)
{
    const char *parts[N_PARTS];
    memcpy(parts, GIVEN, sizeof parts);
    parts[PART_TIME] = "[geometry]\nsweep = { phase_deg = [80, 100, 10], plane = \"xz\" }\n";
    parts[PART_SETTINGS] = "[photometry]\nsolar_disc = \"point\"\n";
    run_rows r = run_with(parts, PART_PRIMITIVE, ONE_PLATE);
    for (size_t k = 0; k < 3; k++) { /* 80 deg; edge-on; behind */
        ck_assert_uint_eq(r.rows[k].flags, k ? GLINT_DARK : 0);
        ck_assert_int_eq(r.rows[k].flux_ratio[0] > 0, k == 0);
    }
    rows_free(&r);
}
END_TEST

START_TEST(test_curve_flags_are_written_as_words)
{
    static const struct {
        unsigned flags;
        const char *text;
    } all[] = {
        {0, ""},
        {GLINT_BELOW_HORIZON, "below-horizon"},
        {GLINT_UMBRA, "umbra"},
        {GLINT_PENUMBRA, "penumbra"},
        {GLINT_DARK, "dark"},
        {GLINT_SITE_DARK, "site-dark"},
        {GLINT_BELOW_HORIZON | GLINT_UMBRA | GLINT_SITE_DARK, "below-horizon|umbra|site-dark"},
        {GLINT_BELOW_HORIZON | GLINT_UMBRA | GLINT_PENUMBRA | GLINT_DARK | GLINT_SITE_DARK,
         "below-horizon|umbra|penumbra|dark|site-dark"}};
    glint_scenario *s = read_with(SOUND, PART_TOP, "");
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    size_t n, column = 0;
    const glint_column *columns = glint_curve_columns(curve, &n);
    while (strcmp(columns[column].name, "flags") != 0)
        column++;
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        const glint_row row = {.flags = all[k].flags};
        char cell[GLINT_CELL_SIZE];
        ck_assert_uint_eq(glint_curve_text(curve, &row, column, cell), strlen(all[k].text));
        ck_assert_str_eq(cell, all[k].text);
    }
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

/* [output] rows against the same run with all rows. */
START_TEST(test_curve_rows_are_chosen_as_asked)
{
    const char *const sets[3][3] = {
        {"observer.min_elevation_deg=10", "output.sun_elevation_max_deg=-11.5",
         "output.rows=\"all\""},
        {"observer.min_elevation_deg=10", "output.sun_elevation_max_deg=-11.5",
         "output.rows=\"visible\""},
        {"observer.min_elevation_deg=10", "output.sun_elevation_max_deg=-11.5",
         "output.rows=\"dark-site\""}};
    run_rows all = run_vienna(sets[0], 3), visible = run_vienna(sets[1], 3),
             dark = run_vienna(sets[2], 3);
    size_t v = 0, d = 0;
    for (size_t k = 0; k < all.n; k++) {
        const glint_row *row = &all.rows[k];
        if (row->elevation_rad < 10 * DEG || !(row->sunlit_fraction > 0)) continue;
        ck_assert_uint_lt(v, visible.n);
        assert_near(visible.rows[v].t_s, row->t_s, 0);
        assert_near(visible.rows[v++].flux_ratio[0], row->flux_ratio[0], 0);
        if (!(row->sun_elevation_rad < -11.5 * DEG)) continue;
        ck_assert_uint_lt(d, dark.n);
        assert_near(dark.rows[d++].t_s, row->t_s, 0);
    }
    ck_assert_uint_eq(v, visible.n);
    ck_assert_uint_eq(d, dark.n);
    ck_assert(0 < d && d < v && v < all.n);
    rows_free(&all);
    rows_free(&visible);
    rows_free(&dark);
}
END_TEST

START_TEST(test_curve_columns_follow_the_scenario)
{
    static const struct {
        const char *const *parts;
        const char *text, *columns;
    } all[] = {
        {SOUND, "",
         "utc,t_s,mag_V,flux_ratio_V,range_km,phase_angle_deg,sunlit_fraction,flags,azimuth_deg,"
         "elevation_deg,sun_elevation_deg,airmass,share_material_white"},
        {SOUND, "[photometry]\nbands = [\"lsst_g\", \"B\"]\n[output]\nshares = \"both\"\n",
         "utc,t_s,mag_lsst_g,mag_B,flux_ratio_lsst_g,flux_ratio_B,range_km,phase_angle_deg,"
         "sunlit_fraction,flags,azimuth_deg,elevation_deg,sun_elevation_deg,airmass,"
         "share_material_white,share_component_bus"},
        {GIVEN, "[output]\nshares = \"component\"\n",
         "t_s,mag_V,flux_ratio_V,range_km,phase_angle_deg,sunlit_fraction,flags,"
         "share_component_bus"},
        {GIVEN, "[output]\nshares = \"none\"\n",
         "t_s,mag_V,flux_ratio_V,range_km,phase_angle_deg,sunlit_fraction,flags"},
    };
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        glint_scenario *s = read_with(all[k].parts, PART_SETTINGS, all[k].text);
        glint_curve *curve;
        ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
        size_t n;
        const glint_column *columns = glint_curve_columns(curve, &n);
        char list[1024] = "";
        for (size_t i = 0; i < n; i++)
            sprintf(list + strlen(list), "%s%s", i ? "," : "", columns[i].name);
        ck_assert_str_eq(list, all[k].columns);
        double value;
        char cell[GLINT_CELL_SIZE] = "x";
        const glint_row row = {0};
        ck_assert(!glint_curve_value(curve, &row, n, &value)); /* past the end */
        ck_assert_uint_eq(glint_curve_text(curve, &row, n, cell), 0);
        glint_curve_close(curve);
        glint_scenario_free(s);
    }
}
END_TEST

/* Every cell holds the digits that read back as the number. */
START_TEST(test_curve_cells_read_back_exactly)
{
    glint_scenario *s = read_sound(VIENNA);
    glint_curve *curve;
    const glint_row *rows;
    size_t n, n_columns;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    const glint_column *columns = glint_curve_columns(curve, &n_columns);
    ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < n_columns; i++) {
            char cell[GLINT_CELL_SIZE], *end;
            double value;
            const bool full = glint_curve_value(curve, &rows[k], i, &value);
            const size_t length = glint_curve_text(curve, &rows[k], i, cell);
            ck_assert_uint_eq(length, strlen(cell));
            if (columns[i].is_text) continue;
            ck_assert_int_eq(full, length > 0);
            if (full) assert_near(strtod(cell, &end), value, 0);
        }
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------------ extinction */

/* Kasten and Young 1989, at zenith angles of 60 and 80 deg (physics page, section 9). */
START_TEST(test_curve_airmass_matches_the_formula)
{
    assert_near(airmass_kasten_young(30 * DEG), 1.9942928525, 1e-10);
    assert_near(airmass_kasten_young(10 * DEG), 5.5860358799, 1e-10);
    assert_near(airmass_kasten_young(-1e-9), 0, 0);
    assert_near(airmass_kasten_young(90 * DEG), 1, 1e-3); /* the formula's own 0.9997 */
}
END_TEST

START_TEST(test_curve_extinction_is_in_the_magnitude_alone)
{
    const char *const with[] = {"photometry.extinction={ V = 0.15 }"};
    run_rows a = run_vienna(NULL, 0), b = run_vienna(with, 1);
    for (size_t k = 0; k < a.n; k++) {
        const glint_row *x = &a.rows[k], *y = &b.rows[k];
        assert_near(x->flux_ratio[0], y->flux_ratio[0], 0);
        if (!(x->flux_ratio[0] > 0)) continue;
        const double airmass = airmass_kasten_young(x->elevation_rad);
        assert_near(x->airmass, airmass, 0);
        assert_near(y->magnitude[0] - x->magnitude[0], 0.15 * airmass, 1e-14); /* mag */
        assert_near(x->magnitude[0], -26.76 - 2.5 * log10(x->flux_ratio[0]), 1e-14);
    }
    rows_free(&a);
    rows_free(&b);
}
END_TEST

/* ------------------------------------------------------------------ corrections */

/* Where the light is slow, the satellite stands where it was: v tau back along its path. */
START_TEST(test_curve_light_time_moves_the_satellite_back_along_its_orbit)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T00:00:00Z\nduration_s = 5800\nstep_s = 10\n";
    parts[PART_OBSERVER] = "[observer]\nlatitude_deg = 0\nlongitude_deg = 0\n";
    parts[PART_ORBIT] = "[orbit]\ncircular = { height_km = 400, inclination_deg = 0, raan_deg = 0, "
                        "argument_of_latitude_deg = 0, j2 = false }\n";
    run_rows slow = run_with(parts, PART_SETTINGS, "");
    run_rows fast = run_with(parts, PART_SETTINGS, "[corrections]\nlight_time = false\n");
    const double a_m = 6778137, site_m = 6378137;
    const double rate = sqrt(398600.4418e9 / (a_m * a_m * a_m)); /* rad/s */
    double largest_m = 0;
    for (size_t k = 0; k + 1 < fast.n; k++) {
        /* In the plane of the equator R^2 = a^2 + s^2 - 2 a s cos(angle); the angle is rate x tau
         * behind. That the equators of 2000 and of date differ by 0.14 deg turns R by 3e-6. */
        const double range_m = fast.rows[k].range_m;
        const double cosine =
            (a_m * a_m + site_m * site_m - range_m * range_m) / (2 * a_m * site_m);
        const double sine = sqrt(1 - cosine * cosine);
        const double ahead =
            fast.rows[k + 1].range_m > range_m ? 1 : -1; /* of the site, or behind */
        const double tau = slow.rows[k].range_m / 299792458.0;
        const double want_m = -ahead * a_m * site_m * sine / range_m * rate * tau;
        if (fabs(cosine) > 0.9999) continue; /* overhead and opposite the sign turns */
        assert_near(slow.rows[k].range_m - fast.rows[k].range_m, want_m,
                    0.05 + 0.01 * fabs(want_m)); /* m */
        largest_m = fmax(largest_m, fabs(want_m));
        assert_near(slow.rows[k].sun_elevation_rad, fast.rows[k].sun_elevation_rad, 0);
    }
    ck_assert_double_gt(largest_m, 100);
    rows_free(&slow);
    rows_free(&fast);
}
END_TEST

/* At the June solstice the Earth moves parallel to the equator. From the geostationary orbit the
 * observer's direction goes once around it in a day, so that somewhere the phase angle takes up the
 * whole aberration v/c: 29.3 km/s there (vis-viva at 1.0162 au), 20.16 arcsec. */
START_TEST(test_curve_aberration_moves_the_sun_alone)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-06-21T00:00:00Z\nduration_s = 86400\nstep_s = 300\n";
    parts[PART_OBSERVER] = "[observer]\nlatitude_deg = 0\nlongitude_deg = 0\n";
    parts[PART_ORBIT] = "[orbit]\ncircular = { geostationary_longitude_deg = 0 }\n";
    run_rows with = run_with(parts, PART_SETTINGS, "");
    run_rows without = run_with(parts, PART_SETTINGS, "[corrections]\naberration = false\n");
    double phase = 0, elevation = 0;
    for (size_t k = 0; k < with.n; k++) {
        const glint_row *x = &with.rows[k], *y = &without.rows[k];
        assert_near(x->range_m, y->range_m, 0);
        assert_near(x->azimuth_rad, y->azimuth_rad, 0);
        assert_near(x->elevation_rad, y->elevation_rad, 0);
        phase = fmax(phase, fabs(x->phase_angle_rad - y->phase_angle_rad));
        elevation = fmax(elevation, fabs(x->sun_elevation_rad - y->sun_elevation_rad));
    }
    const double speed_m_s = sqrt(1.32712440018e20 / 149597870700.0 * (2 / 1.01624 - 1));
    const double whole = speed_m_s / 299792458.0; /* rad */
    assert_near(phase / ARCSEC, whole / ARCSEC, 0.05);
    ck_assert_double_gt(elevation / ARCSEC, 15);
    ck_assert_double_le(elevation / ARCSEC, whole / ARCSEC + 0.05);
    rows_free(&with);
    rows_free(&without);
}
END_TEST

START_TEST(test_curve_dut1_turns_the_earth)
{
    const char *const late[] = {"corrections.dut1_s=0.5"};
    run_rows a = run_vienna(NULL, 0), b = run_vienna(late, 1);
    const double sun = 19.458 * DEG, site = 48.2 * DEG; /* declination at 20:01: JPL DE ephemeris */
    for (size_t k = 0; k < a.n; k++) {
        const double elevation = a.rows[k].sun_elevation_rad;
        const double hour_angle =
            acos((sin(elevation) - sin(site) * sin(sun)) / (cos(site) * cos(sun)));
        const double slope = cos(site) * cos(sun) * sin(hour_angle) / cos(elevation);
        const double change = b.rows[k].sun_elevation_rad - elevation;
        /* 0.5 s of rotation at 7.2921e-5 rad/s */
        assert_rel(change, -slope * 0.5 * 7.2921e-5, 1e-3);
    }
    rows_free(&a);
    rows_free(&b);
}
END_TEST

/* ------------------------------------------------------------------ failing runs */

/* A drag that brings the satellite down within the day; the checksum is made to fit. */
static const char *decaying_orbit(void)
{
    static char content[256];
    char line1[] = "1 25544U 98067A   25206.16725053  .00012111  00000+0  99999+0 0  9990";
    int sum = 0;
    for (int k = 0; k < 68; k++)
        sum += line1[k] == '-' ? 1 : line1[k] >= '0' && line1[k] <= '9' ? line1[k] - '0' : 0;
    line1[68] = (char)('0' + sum % 10);
    snprintf(content, sizeof content,
             "[orbit]\ntle_lines = [\"%s\",\n\"2 25544  51.6348 118.8254 0002056 114.0852 246.0352 "
             "15.50079803521055\"]\n",
             line1);
    return content;
}

START_TEST(test_curve_orbit_that_fails_says_when)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T05:00:00Z\nduration_s = 864000\nstep_s = 30\n";
    glint_scenario *s = read_with(parts, PART_ORBIT, decaying_orbit());
    char message[1024] = "";
    for (int threads = 1; threads <= 4; threads++) {
        glint_curve *curve;
        const glint_row *rows;
        size_t n;
        glint_status status;
        glint_error error;
        ck_assert_int_eq(glint_curve_open(s, threads, &curve, NULL), GLINT_OK);
        do
            status = glint_curve_next(curve, &rows, &n, &error);
        while (status == GLINT_OK && n > 0);
        ck_assert_int_eq(status, GLINT_INPUT);
        ck_assert_str_eq(error.file, in_folder("scenario.toml"));
        if (threads == 1) strcpy(message, error.message);
        ck_assert_str_eq(error.message, message); /* the earliest, whoever meets it first */
        glint_curve_close(curve);
    }
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_curve_open_takes_a_sensible_number_of_threads)
{
    glint_scenario *s = read_with(SOUND, PART_TOP, "");
    glint_curve *curve;
    const int wrong[] = {-1, 1025, 1 << 30};
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(glint_curve_open(s, wrong[k], &curve, errors), GLINT_ARGUMENT);
        ck_assert_ptr_null(curve);
        ck_assert_uint_eq(glint_errors_error_count(errors), 1);
        ck_assert_ptr_nonnull(strstr(glint_errors_get(errors, 0)->message, "expected 1 to 1024"));
        glint_errors_free(errors);
    }
    ck_assert_int_eq(glint_curve_open(s, 0, &curve, NULL), GLINT_OK);
    ck_assert_int_ge(glint_curve_threads(curve), 1);
    assert_near(glint_curve_step_s(curve), 10, 0);
    ck_assert_str_eq(glint_curve_band(curve), "V");
    glint_curve_close(curve);
    glint_curve_close(NULL);
    glint_scenario_free(s);
}
END_TEST

static Suite *curve_suite(void)
{
    Suite *suite = suite_create("curve");
    TCase *threads = tcase_create("threads and blocks");
    tcase_add_checked_fixture(threads, folder_make, folder_remove);
    tcase_set_timeout(threads, 300);
    tcase_add_test(threads, test_curve_threads_give_the_same_bits);
    tcase_add_test(threads, test_curve_threads_give_the_same_bits_on_a_resonant_orbit);
    tcase_add_test(threads, test_curve_threads_give_the_same_bits_for_given_directions);
    tcase_add_test(threads, test_curve_row_is_the_same_at_another_step);
    tcase_add_test(threads, test_curve_blocks_stream_in_constant_memory);
    tcase_add_test(threads, test_curve_orbit_that_fails_says_when);
    tcase_add_test(threads, test_curve_open_takes_a_sensible_number_of_threads);
    suite_add_tcase(suite, threads);
    TCase *rows = tcase_create("rows");
    tcase_set_timeout(rows, 60);
    tcase_add_checked_fixture(rows, folder_make, folder_remove);
    tcase_add_test(rows, test_curve_shares_add_to_one);
    tcase_add_test(rows, test_curve_shares_closed_form);
    tcase_add_test(rows, test_curve_flags_say_why_a_row_is_dark);
    tcase_add_test(rows, test_curve_row_with_nothing_lit_in_sight_is_flagged_dark);
    tcase_add_test(rows, test_curve_flags_are_written_as_words);
    tcase_add_test(rows, test_curve_rows_are_chosen_as_asked);
    tcase_add_test(rows, test_curve_columns_follow_the_scenario);
    tcase_add_test(rows, test_curve_cells_read_back_exactly);
    suite_add_tcase(suite, rows);
    TCase *effects = tcase_create("effects");
    tcase_set_timeout(effects, 60);
    tcase_add_checked_fixture(effects, folder_make, folder_remove);
    tcase_add_test(effects, test_curve_airmass_matches_the_formula);
    tcase_add_test(effects, test_curve_extinction_is_in_the_magnitude_alone);
    tcase_add_test(effects, test_curve_light_time_moves_the_satellite_back_along_its_orbit);
    tcase_add_test(effects, test_curve_aberration_moves_the_sun_alone);
    tcase_add_test(effects, test_curve_dut1_turns_the_earth);
    suite_add_tcase(suite, effects);
    return suite;
}

int main(void)
{
    return run_suite(curve_suite());
}
