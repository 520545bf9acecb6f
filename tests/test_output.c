/* Tables as files: header, summary, and output that appears whole or not at all. */
#define _GNU_SOURCE /* O_TMPFILE */
#include "scenario_text.h"

#include "output/file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

/* ------------------------------------------------------------------ helpers */

static glint_curve *open_curve(const glint_scenario *s)
{
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    return curve;
}

/* Writes the table of a scenario to `path`; its status. */
static glint_status write_table(const glint_scenario *s, const char *path, glint_error *error)
{
    glint_curve *curve = open_curve(s);
    const glint_status status = glint_table_write(curve, path, NULL, NULL, NULL, NULL, error);
    glint_curve_close(curve);
    return status;
}

static char *table_of(const glint_scenario *s)
{
    glint_error error;
    const char *path = in_folder("table.csv");
    ck_assert_msg(write_table(s, path, &error) == GLINT_OK, "%s", error.message);
    char *content = read_bytes(path, NULL);
    remove(path);
    return content;
}

/* Cuts the next line off a text; NULL at the end. */
static char *next_line(char **content)
{
    char *line = *content;
    if (!*line) return NULL;
    char *end = strchr(line, '\n');
    ck_assert_msg(end != NULL, "no line end after: %s", line);
    *end = '\0';
    *content = end + 1;
    return line;
}

/* The text inside YAML's double quotes; `quoted` begins with the quote. From malloc. */
static char *unquote(const char *quoted)
{
    char *out = malloc(strlen(quoted) + 1), *to = out;
    ck_assert_int_eq(quoted[0], '"');
    for (const char *c = quoted + 1; *c != '"';) {
        ck_assert_msg((unsigned char)*c >= 0x20, "a control character in: %s", quoted);
        if (*c != '\\') {
            *to++ = *c++;
            continue;
        }
        const int digits = c[1] == 'x' ? 2 : c[1] == 'u' ? 4 : 0;
        if (digits) {
            char hex[5] = "";
            memcpy(hex, c + 2, (size_t)digits);
            const unsigned code = (unsigned)strtoul(hex, NULL, 16);
            if (code < 0x80) {
                *to++ = (char)code;
            } else if (code < 0x800) {
                *to++ = (char)(0xc0 | code >> 6), *to++ = (char)(0x80 | (code & 63));
            } else {
                *to++ = (char)(0xe0 | code >> 12), *to++ = (char)(0x80 | (code >> 6 & 63));
                *to++ = (char)(0x80 | (code & 63));
            }
        } else {
            ck_assert(c[1] == '"' || c[1] == '\\');
            *to++ = c[1];
        }
        c += 2 + digits;
    }
    *to = '\0';
    return out;
}

/* ------------------------------------------------------------------ header */

START_TEST(test_output_header_is_ecsv)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_SETTINGS] = "[photometry]\nbands = [\"V\", \"B\"]\n";
    glint_scenario *s = read_with(parts, PART_TOP, "title = \"a \\\"box\\\"\"\n");
    glint_curve *curve = open_curve(s);
    size_t n, described = 0;
    const glint_column *columns = glint_curve_columns(curve, &n);
    char *table = table_of(s), *at = table, *line, want[256], names[1024] = "";
    ck_assert_str_eq(next_line(&at), "# %ECSV 1.0");
    ck_assert_str_eq(next_line(&at), "# ---");
    ck_assert_str_eq(next_line(&at), "# delimiter: ','");
    ck_assert_str_eq(next_line(&at), "# datatype:");
    while ((line = next_line(&at)) && line[0] == '#') {
        ck_assert_msg(strncmp(line, "# ", 2) == 0, "%s", line);
        if (strncmp(line, "# - {name: ", 11) != 0) continue;
        ck_assert_uint_lt(described, n);
        const glint_column *c = &columns[described++];
        snprintf(want, sizeof want, "# - {name: %s%s%s, datatype: %s, description: \"", c->name,
                 c->unit[0] ? ", unit: " : "", c->unit, c->is_text ? "string" : "float64");
        ck_assert_msg(strncmp(line, want, strlen(want)) == 0, "%s", line);
    }
    ck_assert_uint_eq(described, n);
    for (size_t i = 0; i < n; i++)
        sprintf(names + strlen(names), "%s%s", i ? "," : "", columns[i].name);
    ck_assert_str_eq(line, names);
    free(table);
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

static bool has_line(const char *table, const char *start)
{
    for (const char *c = table; c; c = strchr(c, '\n'), c = c ? c + 1 : NULL)
        if (strncmp(c, start, strlen(start)) == 0) return true;
    return false;
}

START_TEST(test_output_header_says_what_the_run_assumes)
{
    const marked_text m =
        with_part(SOUND, PART_SETTINGS,
                  "[photometry]\nbands = [\"V\", \"lsst_g\"]\nextinction = { V = 0.15, lsst_g = "
                  "0.2 }\n[corrections]\ndut1_s = 0.1\naberration = false\n");
    const char *path = write_file("scenario.toml", m.text);
    const char *const set[] = {"time.step_s=5", "title='x'"};
    glint_scenario *s = read_sound_set(path, set, 2);
    char *table = table_of(s);
    const char *const lines[] = {
        "# - glint_version: \"",
        "# - title: \"x\"\n",
        "# - scenario_hash: \"fnv1a64:",
        "# - set:\n#   - \"time.step_s=5\"\n#   - \"title='x'\"\n",
        "# - zero_point_V: \"apparent magnitude of the Sun -26.76 (vega; Willmer 2018",
        "# - zero_point_lsst_g: \"apparent magnitude of the Sun -26.52 (ab; Willmer 2018",
        "# - extinction_V: \"0.15 mag per airmass",
        "# - extinction_lsst_g: \"0.2 mag per airmass",
        "# - time_scale: \"",
        "# - dut1_s: \"0.1",
        "# - light_time: \"yes",
        "# - aberration: \"no",
        "# - self_shadows: \"",
        "# - solar_disc: \"",
        "# - earthshine: \"none",
        "# - not_modelled: \"interreflection",
        "# - scenario:\n",
        "# schema: astropy-2.0\n"};
    for (size_t k = 0; k < COUNT_OF(lines); k++)
        ck_assert_msg(has_line(table, lines[k]), "'%s' is not in the header", lines[k]);
    free(table);
    glint_scenario_free(s);
}
END_TEST

/* The value of a fact in the header: up to the end of its line; a static buffer. */
static const char *fact_of(const char *table, const char *key)
{
    static char out[256];
    const char *at = strstr(table, key);
    ck_assert_ptr_nonnull(at);
    snprintf(out, sizeof out, "%.*s", (int)strcspn(at, "\n"), at);
    return out;
}

/* Everything that decides the numbers changes the hash; what does not, does not. */
START_TEST(test_output_hash_tells_runs_apart)
{
    static const char sweep[] = "[geometry]\ntable = \"d.csv\"\n";
    static const char *const tables[] = {
        "sun_x,sun_y,sun_z,obs_x,obs_y,obs_z,t_s,range_km\n1,0,0,1,0,0,0,1000\n",
        "sun_x,sun_y,sun_z,obs_x,obs_y,obs_z,t_s,range_km\n1,0,0,1,0,0,1,1000\n",
        "sun_x,sun_y,sun_z,obs_x,obs_y,obs_z,t_s,range_km\n1,0,0,1,0,0,0,1001\n",
        "sun_x,sun_y,sun_z,obs_x,obs_y,obs_z,t_s,range_km\n1,0,0,1,1,0,0,1000\n",
        "sun_x,sun_y,sun_z,obs_x,obs_y,obs_z,t_s,range_km\n1,1,0,1,0,0,0,1000\n"};
    char hashes[COUNT_OF(tables)][64];
    for (size_t k = 0; k < COUNT_OF(tables); k++) {
        write_file("d.csv", tables[k]);
        glint_scenario *s = read_with(GIVEN, PART_TIME, sweep);
        char *table = table_of(s), *again = table_of(s);
        snprintf(hashes[k], sizeof hashes[k], "%.60s", fact_of(table, "scenario_hash"));
        ck_assert_str_eq(fact_of(again, "scenario_hash"), hashes[k]);
        for (size_t j = 0; j < k; j++)
            ck_assert_str_ne(hashes[j], hashes[k]);
        free(table);
        free(again);
        glint_scenario_free(s);
    }
}
END_TEST

/* Letters of every kind, and what some reader takes for the end of a line. */
static const char WILD[] =
    "title = \"quotes \\\" ' backslash \\\\ unit separator \\u001f next line \\u0085 \xc2\x85\"\n"
    "# tab \t colon: x - dash # hash {a: [b]} %ECSV &a *b !c |d >e @f `g ~\r\n"
    "# caf\xc3\xa9 \xe2\x80\xa8 \xe2\x80\xa9 \xef\xbb\xbf \xc2\x80 \xc2\xa0 \xf0\x9f\x9b\xb0 "
    "\xef\xbf\xbd\n"
    "   \n\n";

START_TEST(test_output_header_holds_the_whole_scenario)
{
    glint_scenario *s = read_with(SOUND, PART_TOP, WILD);
    char *table = table_of(s), *at = table, *line;
    char *content = read_bytes(in_folder("scenario.toml"), NULL), *want = content;
    while ((line = next_line(&at)) && strcmp(line, "# - scenario:") != 0)
        ;
    ck_assert_ptr_nonnull(line);
    while ((line = next_line(&at)) && strncmp(line, "#   - ", 6) == 0) {
        char *got = unquote(line + 6), *original = next_line(&want);
        ck_assert_ptr_nonnull(original);
        ck_assert_str_eq(got, original);
        free(got);
    }
    ck_assert_str_eq(want, ""); /* all of it */
    ck_assert_str_eq(line, "# schema: astropy-2.0");
    free(content);
    free(table);
    glint_scenario_free(s);
}
END_TEST

/* True when a text is UTF-8 that every reader splits into the same lines. */
static bool is_plain_utf8(const char *content)
{
    for (const unsigned char *c = (const unsigned char *)content; *c;) {
        const int length = *c < 0x80 ? 1 : (*c >> 5) == 6 ? 2 : (*c >> 4) == 14 ? 3 : 4;
        if (*c >= 0x80 && *c < 0xc2) return false;
        for (int k = 1; k < length; k++)
            if ((c[k] & 0xc0) != 0x80) return false;
        if (*c < 0x20 && *c != '\n') return false;
        if (c[0] == 0xc2 && c[1] < 0xa0) return false; /* next line and its like */
        if (c[0] == 0xe2 && c[1] == 0x80 && (c[2] == 0xa8 || c[2] == 0xa9)) return false;
        c += length;
    }
    return true;
}

START_TEST(test_output_header_stays_utf8_whatever_a_file_holds)
{
    write_file("sets.tle",
               "0 S\xc3\xa9RIE \xe9\xff \x01\n"
               "1 25544U 98067A   25206.16725053  .00012111  00000+0  21923-3 0  9999\n"
               "2 25544  51.6348 118.8254 0002056 114.0852 246.0352 15.50079803521055\n");
    glint_scenario *s = read_with(SOUND, PART_ORBIT, "[orbit]\ntle = \"sets.tle\"\n");
    char *table = table_of(s);
    ck_assert(is_plain_utf8(table));
    ck_assert_ptr_nonnull(strstr(table, "S\xc3\xa9RIE \\xe9\\xff \\x01"));
    free(table);
    glint_scenario_free(s);
    s = read_with(SOUND, PART_TOP, WILD);
    table = table_of(s);
    ck_assert(is_plain_utf8(table));
    free(table);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_output_rows_are_the_cells_of_the_curve)
{
    glint_scenario *s = read_sound(TEST_DATA_DIR "/endtoend/iss-vienna.toml");
    char *table = table_of(s), *at = table, *line = next_line(&at);
    while (line[0] == '#')
        line = next_line(&at);
    glint_curve *curve = open_curve(s);
    const glint_row *rows;
    size_t n, n_columns;
    glint_curve_columns(curve, &n_columns);
    ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
    for (size_t k = 0; k < n; k++) {
        char want[2048] = "", cell[GLINT_CELL_SIZE];
        for (size_t i = 0; i < n_columns; i++) {
            glint_curve_text(curve, &rows[k], i, cell);
            sprintf(want + strlen(want), "%s%s", i ? "," : "", cell);
        }
        line = next_line(&at);
        ck_assert_ptr_nonnull(line);
        ck_assert_str_eq(line, want);
    }
    ck_assert_str_eq(at, "");
    free(table);
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

/* What each column's name says is what its value is: in km, degrees and seconds of arc of the row.
 */
START_TEST(test_output_columns_are_in_the_units_of_their_names)
{
    static const double DEG_ = 180 / 3.14159265358979323846;
    static const char MORE[] = "[photometry]\nextinction = { V = 0.15 }\n[output]\nmoon = true\n";
    glint_scenario *s = read_with(SOUND, PART_SETTINGS, MORE);
    glint_curve *curve = open_curve(s);
    const glint_row *rows;
    size_t n, n_columns, met = 0;
    const glint_column *columns = glint_curve_columns(curve, &n_columns);
    ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
    for (size_t k = 0; k < n; k++) {
        const glint_row *r = &rows[k];
        const struct {
            const char *name;
            double value;
        } WANT[] = {{"t_s", r->t_s},
                    {"mag_V", r->magnitude[0]},
                    {"flux_ratio_V", r->flux_ratio[0]},
                    {"range_km", r->range_m / 1000},
                    {"phase_angle_deg", r->phase_angle_rad * DEG_},
                    {"sunlit_fraction", r->sunlit_fraction},
                    {"azimuth_deg", r->azimuth_rad * DEG_},
                    {"elevation_deg", r->elevation_rad * DEG_},
                    {"sun_elevation_deg", r->sun_elevation_rad * DEG_},
                    {"airmass", r->airmass},
                    {"moon_azimuth_deg", r->moon_azimuth_rad * DEG_},
                    {"moon_elevation_deg", r->moon_elevation_rad * DEG_},
                    {"moon_separation_deg", r->moon_separation_rad * DEG_},
                    {"moon_illuminated", r->moon_illuminated}};
        for (size_t i = 0; i < n_columns; i++)
            for (size_t w = 0; w < sizeof WANT / sizeof *WANT; w++) {
                double value;
                if (strcmp(columns[i].name, WANT[w].name) != 0) continue;
                ck_assert(glint_curve_value(curve, r, i, &value));
                assert_rel(value, WANT[w].value, 1e-15);
                met++;
            }
    }
    ck_assert_uint_eq(met, 14 * n);
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------------ summary */

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The summary of a run against all its rows. all_lit_s: its span where all rows are sunlit and up;
 * 0: they are not, or there is no time. */
static void check_summary(const glint_scenario *s, double step_s, double all_lit_s)
{
    glint_curve *curve = open_curve(s);
    glint_summary got;
    glint_error error;
    ck_assert_int_eq(
        glint_table_write(curve, in_folder("table.csv"), NULL, &got, NULL, NULL, &error), GLINT_OK);
    glint_curve_close(curve);
    curve = open_curve(s);
    enum { MOST = 4096 };
    static double mags[MOST];
    size_t n, bright = 0, all = 0, b6 = 0, b7 = 0;
    double sunlit_s = 0, visible_s = 0;
    const double last_s = step_s * (double)(glint_curve_length(curve) - 1);
    const glint_row *rows;
    double brightest_t_s = 0, least = INFINITY;
    while (glint_curve_next(curve, &rows, &n, &error) == GLINT_OK && n > 0)
        for (size_t k = 0; k < n; k++, all++) {
            const bool at_end = !(rows[k].t_s > 0 && rows[k].t_s < last_s);
            const double stands_for_s = at_end ? 0.5 * step_s : step_s;
            const bool sunlit = rows[k].sunlit_fraction > 0;
            const bool visible = sunlit && !(rows[k].flags & GLINT_BELOW_HORIZON);
            sunlit_s += sunlit ? stands_for_s : 0;
            visible_s += visible ? stands_for_s : 0;
            if (!(rows[k].flux_ratio[0] > 0)) continue;
            const double mag = rows[k].magnitude[0];
            ck_assert_uint_lt(bright, MOST);
            mags[bright++] = mag;
            b6 += mag < 6, b7 += mag < 7;
            if (mag < least) least = mag, brightest_t_s = rows[k].t_s;
        }
    ck_assert_int_eq(got.rows, (int64_t)all);
    ck_assert_int_eq(got.bright_rows, (int64_t)bright);
    ck_assert_uint_gt(bright, 0);
    qsort(mags, bright, sizeof *mags, by_size);
    const double median = 0.5 * (mags[(bright - 1) / 2] + mags[bright / 2]);
    assert_near(got.magnitude_min, mags[0], 0);
    assert_near(got.magnitude_max, mags[bright - 1], 0);
    assert_near(got.magnitude_median, median, 0.001); /* mag, as promised */
    assert_near(got.percent_brighter_6, 100.0 * (double)b6 / (double)bright, 1e-12);
    assert_near(got.percent_brighter_7, 100.0 * (double)b7 / (double)bright, 1e-12);
    assert_near(got.sunlit_s, sunlit_s, 1e-9);
    assert_near(got.visible_s, visible_s, 1e-9);
    if (all_lit_s > 0) assert_near(got.visible_s, all_lit_s, 1e-9);
    assert_near(got.brightest_t_s, brightest_t_s, 0);
    ck_assert_str_eq(got.band, glint_curve_band(curve));
    ck_assert_int_eq(got.has_utc, step_s > 0);
    glint_curve_close(curve);
}

START_TEST(test_output_summary_of_a_pass)
{
    const char *const set[] = {"observer.min_elevation_deg=10"};
    glint_scenario *s = read_sound_set(TEST_DATA_DIR "/endtoend/iss-vienna.toml", set, 1);
    check_summary(s, 5, 0);
    glint_scenario_free(s);
}
END_TEST

/* Few rows, odd and even in number, far apart in magnitude. */
START_TEST(test_output_summary_median_of_few_rows)
{
    static const char *const phases[] = {"[0, 0, 1]", "[0, 80, 80]", "[0, 88, 44]", "[0, 87, 29]",
                                         "[0, 120, 40]"};
    const char *parts[N_PARTS];
    memcpy(parts, GIVEN, sizeof parts);
    parts[PART_PRIMITIVE] = "[[component.plate]]\nsize_m = [1, 1]\nnormal = [0, 0, 1]\n"
                            "tangent = [1, 0, 0]\nmaterial = \"white\"\n";
    for (size_t k = 0; k < COUNT_OF(phases); k++) {
        char content[128];
        snprintf(content, sizeof content,
                 "[geometry]\nsweep = { phase_deg = %s, plane = \"xz\" }\n", phases[k]);
        glint_scenario *s = read_with(parts, PART_TIME, content);
        check_summary(s, 0, 0);
        glint_scenario_free(s);
    }
}
END_TEST

/* Seven rows in a minute are a minute of light, and three of them 20 s. */
START_TEST(test_output_summary_times_do_not_exceed_the_span)
{
    glint_scenario *s = read_with(SOUND, PART_TOP, "");
    check_summary(s, 10, 60);
    glint_scenario_free(s);
    s = read_with(SOUND, PART_TIME,
                  "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 27\nstep_s = 10\n");
    check_summary(s, 10, 20);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_output_summary_without_a_bright_row)
{
    glint_scenario *s =
        read_with(SOUND, PART_OBSERVER, "[observer]\nlatitude_deg = -48\nlongitude_deg = -164\n");
    glint_curve *curve = open_curve(s);
    glint_summary got;
    ck_assert_int_eq(glint_table_write(curve, in_folder("table.csv"), NULL, &got, NULL, NULL, NULL),
                     GLINT_OK);
    ck_assert_int_eq(got.rows, 7);
    ck_assert_int_eq(got.bright_rows, 0);
    assert_near(got.visible_s, 0, 0);
    assert_near(got.percent_brighter_6, 0, 0);
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------------ files */

START_TEST(test_output_to_a_place_that_cannot_be_written_fails)
{
    glint_scenario *s = read_with(SOUND, PART_TOP, "");
    ck_assert_int_eq(mkdir(in_folder("sub"), 0755), 0);
    char too_long[300];
    memset(too_long, 'a', 256);
    too_long[256] = '\0';
    const char *const places[] = {in_folder("nowhere/table.csv"),
                                  in_folder("sub"),
                                  "/dev/full",
                                  in_folder("scenario.toml/table.csv"),
                                  "",
                                  in_folder("nowhere/"),
                                  in_folder(too_long),
                                  "/proc/table.csv"};
    for (size_t k = 0; k < COUNT_OF(places); k++) {
        glint_error error = {0};
        const glint_status status = write_table(s, places[k], &error);
        ck_assert_msg(status == GLINT_OUTPUT, "%s: status %d", places[k], status);
        ck_assert_msg(error.message[0] && error.status == GLINT_OUTPUT, "%s", places[k]);
        ck_assert_str_eq(error.file, places[k]);
        ck_assert_int_eq(folder_count(), 2); /* scenario.toml, sub */
    }
    glint_scenario_free(s);
}
END_TEST

/* Ways to name a.svg in the folder, which has sub/, a link `back` to itself, a link b.svg to a.svg
 * and a link c.svg to that. */
static const char *const SPELLINGS[] = {
    "a.svg", "./a.svg", "sub/../a.svg",      "sub//.././a.svg",  "back/a.svg",
    "b.svg", "c.svg",   "sub/../back/c.svg", "back/sub/../b.svg"};

static void assert_one_file(const char *when)
{
    for (size_t k = 0; k < COUNT_OF(SPELLINGS); k++) {
        for (size_t j = 0; j < COUNT_OF(SPELLINGS); j++) {
            glint_error error = {0};
            const glint_status status =
                out_file_check_two(in_folder(SPELLINGS[k]), in_folder(SPELLINGS[j]), &error);
            ck_assert_msg(status == GLINT_ARGUMENT, "%s and %s, %s", SPELLINGS[k], SPELLINGS[j],
                          when);
            ck_assert_ptr_nonnull(strstr(error.message, in_folder(SPELLINGS[j])));
        }
        ck_assert_int_eq(out_file_check_two(SPELLINGS[k], in_folder("a.svg"), NULL),
                         GLINT_ARGUMENT); /* seen from the folder itself */
    }
}

START_TEST(test_output_of_table_and_picture_to_one_file_is_refused_however_it_is_spelled)
{
    ck_assert_int_eq(mkdir(in_folder("sub"), 0755), 0);
    ck_assert_int_eq(symlink(".", in_folder("back")), 0);
    ck_assert_int_eq(symlink("a.svg", in_folder("b.svg")), 0);
    ck_assert_int_eq(symlink("sub/../b.svg", in_folder("c.svg")), 0);
    ck_assert_int_eq(chdir(folder), 0);
    assert_one_file("which is not there yet");
    write_file("a.svg", "old");
    assert_one_file("which is there");
    ck_assert_int_eq(chdir("/"), 0);
    ck_assert_int_eq(out_file_check_two("no/such/a.svg", "no/such/a.svg", NULL), GLINT_ARGUMENT);
    glint_scenario *s = read_with(SOUND, PART_TOP, "");
    glint_curve *curve = open_curve(s);
    ck_assert_int_eq(glint_table_write(curve, in_folder("a.svg"), in_folder("sub/../c.svg"), NULL,
                                       NULL, NULL, NULL),
                     GLINT_ARGUMENT);
    ck_assert_int_eq(glint_curve_done(curve), 0);
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_output_of_table_and_picture_to_two_files_is_accepted)
{
    ck_assert_int_eq(mkdir(in_folder("sub"), 0755), 0);
    const char *const a = write_file("a.svg", "old"), *const twin = in_folder("twin.svg");
    const char *const others[] = {in_folder("b.svg"), in_folder("sub/a.svg"), in_folder("A.svg"),
                                  in_folder("no/such/a.svg"), twin};
    ck_assert_int_eq(link(a, twin), 0); /* each name is replaced on its own */
    for (size_t k = 0; k < COUNT_OF(others); k++) {
        ck_assert_int_eq(out_file_check_two(a, others[k], NULL), GLINT_OK);
        ck_assert_int_eq(out_file_check_two(others[k], a, NULL), GLINT_OK);
    }
    ck_assert_int_eq(out_file_check_two(NULL, a, NULL), GLINT_OK);
    ck_assert_int_eq(out_file_check_two(a, NULL, NULL), GLINT_OK);
}
END_TEST

START_TEST(test_output_to_a_name_of_the_greatest_length)
{
    glint_scenario *s = read_with(SOUND, PART_TOP, "");
    char name[256];
    memset(name, 'a', 255);
    name[255] = '\0';
    glint_error error = {0};
    ck_assert_msg(write_table(s, in_folder(name), &error) == GLINT_OK, "%s", error.message);
    ck_assert_int_eq(folder_count(), 2);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_output_to_a_device_leaves_it_a_device)
{
    glint_scenario *s = read_with(SOUND, PART_TOP, "");
    glint_error error;
    struct stat info;
    ck_assert_int_eq(write_table(s, "/dev/null", &error), GLINT_OK);
    ck_assert_int_eq(stat("/dev/null", &info), 0);
    ck_assert(S_ISCHR(info.st_mode));
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_output_to_a_named_pipe_goes_through_it)
{
    glint_scenario *s = read_with(SOUND, PART_TOP, "");
    char *want = table_of(s);
    const char *fifo = in_folder("pipe");
    ck_assert_int_eq(mkfifo(fifo, 0600), 0);
    const pid_t child = fork();
    if (child == 0) _exit(write_table(s, fifo, NULL));
    char *got = read_bytes(fifo, NULL);
    int status;
    ck_assert_int_eq(waitpid(child, &status, 0), child);
    ck_assert_int_eq(WEXITSTATUS(status), GLINT_OK);
    ck_assert_str_eq(got, want);
    struct stat info;
    ck_assert_int_eq(stat(fifo, &info), 0);
    ck_assert(S_ISFIFO(info.st_mode));
    free(got);
    free(want);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_output_to_standard_output_is_the_same)
{
    glint_scenario *s = read_with(SOUND, PART_TOP, "");
    char *want = table_of(s);
    const char *path = in_folder("stdout");
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        const int fd = open(path, O_CREAT | O_WRONLY, 0600);
        dup2(fd, STDOUT_FILENO);
        _exit(write_table(s, NULL, NULL));
    }
    int status;
    ck_assert_int_eq(waitpid(child, &status, 0), child);
    ck_assert_int_eq(WEXITSTATUS(status), GLINT_OK);
    char *got = read_bytes(path, NULL);
    ck_assert_str_eq(got, want);
    free(got);
    free(want);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_output_replaces_a_file_and_keeps_its_permissions)
{
    glint_scenario *s = read_with(SOUND, PART_TOP, "");
    char *want = table_of(s);
    const char *path = write_file("out.csv", "old");
    ck_assert_int_eq(chmod(path, 0640), 0);
    ck_assert_int_eq(symlink("out.csv", in_folder("link")), 0);
    ck_assert_int_eq(write_table(s, in_folder("link"), NULL), GLINT_OK);
    char *got = read_bytes(path, NULL);
    ck_assert_str_eq(got, want);
    struct stat info;
    ck_assert_int_eq(lstat(in_folder("link"), &info), 0);
    ck_assert(S_ISLNK(info.st_mode)); /* a link is followed, not replaced */
    ck_assert_int_eq(stat(path, &info), 0);
    ck_assert_int_eq(info.st_mode & 0777, 0640);
    ck_assert_int_eq(folder_count(), 3);
    free(got);
    free(want);
    glint_scenario_free(s);
}
END_TEST

static glint_scenario *read_long_run(void)
{
    return read_with(SOUND, PART_TIME,
                     "[time]\nstart = 2025-07-25T00:00:00Z\nduration_s = 60000\nstep_s = 1\n");
}

static bool stop_after_the_first(void *context, int64_t done, int64_t all)
{
    int64_t *calls = context;
    ck_assert_int_le(done, all);
    return ++*calls < 2;
}

/* A run that is stopped leaves the old file as it was, and nothing beside it. */
START_TEST(test_output_of_a_run_that_stops_keeps_the_old_file)
{
    glint_scenario *s = read_long_run();
    const char *path = write_file("out.csv", "old");
    for (int k = 0; k < 2; k++) {
        glint_curve *curve = open_curve(s);
        glint_error error = {0};
        int64_t calls = 0;
        ck_assert_int_eq(glint_table_write(curve, k ? path : in_folder("new.csv"), NULL, NULL,
                                           stop_after_the_first, &calls, &error),
                         GLINT_OUTPUT);
        ck_assert_int_eq(calls, 2);
        ck_assert_ptr_nonnull(strstr(error.message, "stopped"));
        glint_curve_close(curve);
        ck_assert_int_eq(folder_count(), 2);
    }
    char *kept = read_bytes(path, NULL);
    ck_assert_str_eq(kept, "old");
    free(kept);
    glint_scenario_free(s);
}
END_TEST

/* The same for a run that fails by itself: an element set that decays on the way. */
START_TEST(test_output_of_a_run_that_fails_keeps_the_old_file)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T05:00:00Z\nduration_s = 864000\nstep_s = 30\n";
    glint_scenario *s =
        read_with(parts, PART_ORBIT,
                  "[orbit]\ntle_lines = [\"1 25544U 98067A   25206.16725053  .00012111  00000+0  "
                  "99999+0 0  9993\",\n\"2 25544  51.6348 118.8254 0002056 114.0852 246.0352 "
                  "15.50079803521055\"]\n");
    const char *path = write_file("out.csv", "old");
    glint_error error;
    ck_assert_int_eq(write_table(s, path, &error), GLINT_INPUT);
    char *kept = read_bytes(path, NULL);
    ck_assert_str_eq(kept, "old");
    ck_assert_int_eq(folder_count(), 2);
    free(kept);
    glint_scenario_free(s);
}
END_TEST

static bool die(void *context, int64_t done, int64_t all)
{
    (void)context, (void)done, (void)all;
    raise(SIGKILL);
    return true;
}

/* Where the system has files without a name, even a program that is killed leaves nothing behind.
 */
START_TEST(test_output_of_a_run_that_is_killed_leaves_nothing)
{
    const int probe = open(folder, O_TMPFILE | O_WRONLY, 0600);
    if (probe < 0) {
        printf("SKIPPED: killed run: this file system has no files without a name\n");
        return;
    }
    close(probe);
    glint_scenario *s = read_long_run();
    const char *path = write_file("out.csv", "old");
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        glint_curve *curve;
        if (glint_curve_open(s, 1, &curve, NULL)) _exit(1);
        _exit(glint_table_write(curve, path, NULL, NULL, die, NULL, NULL));
    }
    int status;
    ck_assert_int_eq(waitpid(child, &status, 0), child);
    ck_assert(WIFSIGNALED(status));
    ck_assert_int_eq(folder_count(), 2);
    char *kept = read_bytes(path, NULL);
    ck_assert_str_eq(kept, "old");
    free(kept);
    glint_scenario_free(s);
}
END_TEST

static Suite *output_suite(void)
{
    Suite *suite = suite_create("output");
    TCase *header = tcase_create("header");
    tcase_set_timeout(header, 60);
    tcase_add_checked_fixture(header, folder_make, folder_remove);
    tcase_add_test(header, test_output_header_is_ecsv);
    tcase_add_test(header, test_output_header_says_what_the_run_assumes);
    tcase_add_test(header, test_output_hash_tells_runs_apart);
    tcase_add_test(header, test_output_header_holds_the_whole_scenario);
    tcase_add_test(header, test_output_header_stays_utf8_whatever_a_file_holds);
    tcase_add_test(header, test_output_rows_are_the_cells_of_the_curve);
    tcase_add_test(header, test_output_columns_are_in_the_units_of_their_names);
    suite_add_tcase(suite, header);
    TCase *summary = tcase_create("summary");
    tcase_set_timeout(summary, 60);
    tcase_add_checked_fixture(summary, folder_make, folder_remove);
    tcase_add_test(summary, test_output_summary_of_a_pass);
    tcase_add_test(summary, test_output_summary_median_of_few_rows);
    tcase_add_test(summary, test_output_summary_times_do_not_exceed_the_span);
    tcase_add_test(summary, test_output_summary_without_a_bright_row);
    suite_add_tcase(suite, summary);
    TCase *files = tcase_create("files");
    tcase_add_checked_fixture(files, folder_make, folder_remove);
    tcase_set_timeout(files, 60);
    tcase_add_test(files, test_output_to_a_place_that_cannot_be_written_fails);
    tcase_add_test(files,
                   test_output_of_table_and_picture_to_one_file_is_refused_however_it_is_spelled);
    tcase_add_test(files, test_output_of_table_and_picture_to_two_files_is_accepted);
    tcase_add_test(files, test_output_to_a_name_of_the_greatest_length);
    tcase_add_test(files, test_output_to_a_device_leaves_it_a_device);
    tcase_add_test(files, test_output_to_a_named_pipe_goes_through_it);
    tcase_add_test(files, test_output_to_standard_output_is_the_same);
    tcase_add_test(files, test_output_replaces_a_file_and_keeps_its_permissions);
    tcase_add_test(files, test_output_of_a_run_that_stops_keeps_the_old_file);
    tcase_add_test(files, test_output_of_a_run_that_fails_keeps_the_old_file);
    tcase_add_test(files, test_output_of_a_run_that_is_killed_leaves_nothing);
    suite_add_tcase(suite, files);
    return suite;
}

int main(void)
{
    return run_suite(output_suite());
}
