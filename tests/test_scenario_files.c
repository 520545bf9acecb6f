/* Scenario files as a whole: absent, cut off, damaged, nested too deep, overridden. In the texts an
 * '@' marks where an error must be. */
#include "scenario_text.h"

/* ------------------------------------------------------------------ the file as a whole */

START_TEST(test_scenario_tables_missing_or_misnamed_are_refused)
{
    static const struct {
        enum part part;
        const char *text, *found, *expected, *missing;
    } all[] = {
        {PART_TIME, "[@tiem]\nstep_s = 1\n", "unknown key 'tiem'", "did you mean 'time'?", "time"},
        {PART_OBSERVER, "[@sky]\nname = \"here\"\n", "unknown key 'sky'",
         "expected one of:", "observer"},
        {PART_ORBIT, "[@orbits]\nx = 1\n", "unknown key 'orbits'", "did you mean 'orbit'?",
         "orbit"},
        {PART_ATTITUDE, "[@atitude]\nlaw = \"nadir\"\n", "unknown key 'atitude'",
         "did you mean 'attitude'?", "attitude"},
    };
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        const marked_text m = with_part(SOUND, all[k].part, all[k].text);
        const char *path = write_file("scenario.toml", m.text);
        char expected[64];
        snprintf(expected, sizeof expected, "a table [%s]", all[k].missing);
        assert_refused_set(path, NULL, 0, path, 1, 1, all[k].missing, expected, 2);
        assert_refused_set(path, NULL, 0, path, m.line, m.column, all[k].found, all[k].expected, 2);
    }
    static const wrong_text others[] = {
        {PART_TOP, "title = @7\n", "'title' is the number 7", "a string", 0},
        {PART_TOP, "@titel = \"x\"\n", "unknown key 'titel'", "did you mean 'title'?", 0},
        {PART_TOP, "photometry = @\"V\"\n", "the string \"V\"", "a table [photometry]", 0},
        {PART_TOP, "corrections = @[]\n", "an array", "a table [corrections]", 0},
        {PART_TOP, "output = @2025-07-25\n", "a date or time", "a table [output]", 0},
        {PART_TOP, "expect = [@1]\n", "the number 1", "tables [[expect]]", 0},
    };
    ASSERT_ALL_WRONG(SOUND, others);
}
END_TEST

START_TEST(test_scenario_file_absent_or_no_file_is_refused)
{
    const char *path = in_folder("absent.toml");
    assert_refused_set(path, NULL, 0, path, 0, 0, "absent.toml", "No such file", 1);
    assert_refused_set(folder, NULL, 0, folder, 0, 0, "is a directory", "expected a file", 1);
    assert_refused_set("/dev/null", NULL, 0, "/dev/null", 0, 0, "not a regular file",
                       "expected a file", 1);
    path = write_file("empty.toml", "");
    assert_refused_set(path, NULL, 0, path, 0, 0, "no 'time'", "a table [time]", 5);
}
END_TEST

START_TEST(test_scenario_several_errors_are_all_reported_in_order)
{
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_TIME] = "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = -1\nstep_s = 0\n";
    parts[PART_OBSERVER] = "[observer]\nlatitude_deg = 91\nlongitude_deg = \"x\"\nfoo = 1\n";
    parts[PART_ATTITUDE] = "[attitude]\nlaw = \"none\"\n";
    parts[PART_MATERIAL] = "[materials.white]\nbrdf = \"lambert\"\nrho = 2\n";
    parts[PART_PRIMITIVE] = "[[component.box]]\nsize_m = [1, 1]\nmaterial = \"whitee\"\n";
    const marked_text m = with_part(parts, PART_SETTINGS, "[photometry]\nbands = [\"X\", \"Y\"]\n");
    const char *path = write_file("scenario.toml", m.text);
    const char *const found[] = {"-1",           "number 0", "91",        "\"x\"",
                                 "'foo'",        "\"none\"", "'X'",       "'Y'",
                                 "the number 2", "whitee",   "2 elements"};
    for (size_t k = 0; k < COUNT_OF(found); k++)
        assert_refused_set(path, NULL, 0, path, 0, 0, found[k], NULL, COUNT_OF(found));
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(glint_scenario_read(path, NULL, 0, &s, errors), GLINT_INPUT);
    for (size_t k = 1; k < glint_errors_count(errors); k++)
        ck_assert_int_le(glint_errors_get(errors, k - 1)->line, glint_errors_get(errors, k)->line);
    glint_errors_free(errors);
}
END_TEST

START_TEST(test_scenario_first_syntax_error_is_reported_with_its_place)
{
    static const wrong_text all[] = {
        {PART_TOP, "title = @\n", "TOML syntax error", NULL, 0},
        {PART_TOP, "title = \"no end@\n", "TOML syntax error", NULL, 0},
        {PART_TOP, "title = \"a\"\ntitle = @\"b\"\n", NULL, NULL, 0},
        {PART_TOP, "[time@\n", "TOML syntax error", NULL, 0},
        {PART_TOP, "x = 1 @y = 2\nz = = 3\n", "TOML syntax error", NULL, 0},
        {PART_TOP, "x = 0x@g\n", "TOML syntax error", NULL, 0},
        {PART_TOP, "x = [1, 2@\n", NULL, NULL, 0},
    };
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        const marked_text m = with_part(SOUND, all[k].part, all[k].text);
        const char *path = write_file("scenario.toml", m.text);
        glint_scenario *s;
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(glint_scenario_read(path, NULL, 0, &s, errors), GLINT_INPUT);
        ck_assert_uint_eq(glint_errors_count(errors), 1);
        const glint_error *e = glint_errors_get(errors, 0);
        ck_assert_str_eq(e->file, path);
        ck_assert_msg(strstr(e->message, "TOML syntax error") != NULL, "%s", e->message);
        ck_assert_msg(e->line >= m.line && e->line <= m.line + 1, "line %d instead of %d: %s",
                      e->line, m.line, e->message);
        ck_assert_msg(e->line != m.line || abs(e->column - m.column) <= 1,
                      "column %d instead of %d: %s", e->column, m.column, e->message);
        glint_errors_free(errors);
    }
}
END_TEST

START_TEST(test_scenario_text_that_is_no_toml_is_refused)
{
    static const char zero[] = "title = \"a\"\n\0x = 1\n";
    const char *path = write_bytes("zero.toml", zero, sizeof zero - 1);
    assert_refused_set(path, NULL, 0, path, 0, 0, "syntax error", NULL, 1);
    path = write_file("escape.toml", "title = \"a\\u0000b\"\n");
    assert_refused_set(path, NULL, 0, path, 1, 9, "a zero byte", "expected text", 1);
    path = write_file("latin.toml", "title = \"\xe9\"\n");
    assert_refused_set(path, NULL, 0, path, 0, 0, "syntax error", NULL, 1);
}
END_TEST

/* Trees are walked by recursion: no text may make one so deep that the stack ends. */
START_TEST(test_scenario_deep_nesting_is_refused)
{
    enum { DEEP = 100000 };
    static const struct {
        const char *before, *each, *between, *last, *close;
    } all[] = {{"[", "a", ".", "]", ""},         {"", "a", ".", " = 1", ""},
               {"", "\"a\"", " . ", " = 1", ""}, {"x = { ", "a", ".", " = 1 }", ""},
               {"x = ", "[", "", "1", "]"},      {"x = ", "{ a = ", "", "1", " }"}};
    char *content = malloc(DEEP * 16);
    ck_assert_ptr_nonnull(content);
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        char *end = stpcpy(content, all[k].before);
        for (int i = 0; i < DEEP; i++) {
            if (i) end = stpcpy(end, all[k].between);
            end = stpcpy(end, all[k].each);
        }
        end = stpcpy(end, all[k].last);
        for (int i = 0; i < DEEP; i++)
            end = stpcpy(end, all[k].close);
        const char *path = write_file("deep.toml", content);
        assert_refused_set(path, NULL, 0, path, 0, 0, NULL, NULL, 1);
    }
    free(content);
    const char *path =
        write_file("deep.toml", "title = \"......................\" # ......................\n"
                                "a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q = 1\n");
    assert_refused_set(path, NULL, 0, path, 2, 32, "more than 16 parts", "fewer dots", 1);
}
END_TEST

/* ------------------------------------------------------------------ overrides */

START_TEST(test_scenario_override_wrong_is_refused)
{
    static const struct {
        const char *set, *found, *expected;
        size_t n;
    } all[] = {
        {"time.step_s=0", "the number 0", "above 0", 1},
        {"time.stepp_s=5", "unknown key 'stepp_s'", "did you mean 'step_s'?", 1},
        {"photometry.bands=[\"X\"]", "'X' is not a band", NULL, 1},
        {"attitude.law=nadir", "TOML", NULL, 2},
        {"time.step_s=", "TOML", NULL, 2},
        {"time", NULL, "expected key=value", 1},
        {"=5", NULL, "expected key=value", 1},
        {"component.1.name=\"a\"", "'1' is not an element of this array", "a number from 0 to 0",
         1},
        {"component.x.name=\"a\"", "'x' is not an element of this array", "a number from 0 to 0",
         1},
        {"component.0.box.0.size_m.3=1", "'3' is not an element", "a number from 0 to 2", 1},
        {"component.0.box.0.size_m.0=\"1\"", "the string \"1\"", "a number", 1},
        {"component.0.box.0.size_m=[1, 2]", "2 elements", "3 numbers", 1},
        {"time.start.year=2025", "'start' is a table", "a UTC time", 1},
        {"satellite.model=\"nothing.toml\"", "both a model file", "one of them", 1},
        {"a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q=1", "more than 16 parts", NULL, 1},
        {"x=nan", "nan", "a finite number", 1},
    };
    const marked_text m = with_part(SOUND, PART_TOP, "");
    const char *path = write_file("scenario.toml", m.text);
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        glint_scenario *s;
        glint_errors *errors = glint_errors_new();
        const char *const set[] = {"time.duration_s=30", all[k].set};
        ck_assert_int_ne(glint_scenario_read(path, set, 2, &s, errors), GLINT_OK);
        ck_assert_ptr_null(s);
        bool found = false;
        for (size_t i = 0; i < glint_errors_count(errors); i++) {
            const char *message = glint_errors_get(errors, i)->message;
            found = found || ((!all[k].found || strstr(message, all[k].found)) &&
                              (!all[k].expected || strstr(message, all[k].expected)));
        }
        ck_assert_msg(found && glint_errors_error_count(errors) == all[k].n, "--set %s:%s",
                      all[k].set, list_errors(errors));
        glint_errors_free(errors);
    }
}
END_TEST

/* ------------------------------------------------------------------ damaged files */

/* A scenario, its model, its element sets; and one with directions and expectations: together they
 * hold most keys there are. */
static const char SCENARIO[] =
    "title = \"everything\" # a comment\n"
    "[time]\nstart = \"2025-07-25T20:00:00Z\"\nend = 2025-07-25T20:02:00.5Z\nstep_s = 10.0\n"
    "[observer]\nname = 'Vienna'\nlatitude_deg = 48.2\nlongitude_deg = 16.37\nheight_m = 200\n"
    "min_elevation_deg = 5\n"
    "[orbit]\ntle = \"sets.tle\"\ntle_name = \"ISS (ZARYA)\"\n"
    "[attitude]\nlaw = \"point\"\naxis = [0, 0, 1]\nto = { ra_deg = 10, dec_deg = -20 }\n"
    "second_axis = [1, 0, 0]\nsecond_to = \"velocity\"\n"
    "offset_deg = { axis = [0, 1, 0], angle = 3 }\n"
    "[satellite]\nmodel = \"model.toml\"\nself_shadows = \"exact\"\n"
    "[photometry]\nbands = [\"V\", \"lsst_g\"]\nextinction = { V = 0.15, lsst_g = 2e-1 }\n"
    "[corrections]\nlight_time = true\naberration = true\ndut1_s = 0.1\n"
    "[output]\nrows = \"all\"\nshares = \"both\"\n"
    "[[require]]\ncolumn = \"mag_V\"\nfainter_than = 3.0\nreference_height_km = 550\n"
    "when = { sun_elevation_deg = [-90, -6] }\n";

/* No facet is of mli: a material in use has its reflectance integrated, which takes longer than all
 * of the reading. */
static const char MODEL[] =
    "materials_from = [\"others.toml\"]\n"
    "[materials.mli]\nbrdf = \"ward\"\nrho_d = 0.1\nrho_s = 0.75\nalpha_x = 0.06\n"
    "alpha_y = 0.06\nk_per_um = 0.14\nwavelength_um = 10.6\nfollow_band = false\n"
    "[materials.mli.bands.lsst_g]\nrho_d = 0.05\n"
    "[materials.glaze]\nbrdf = \"sum\"\n"
    "parts = [{ weight = 0.5, brdf = \"lambert\", rho = 0.4 }, { brdf = \"minnaert\", rho = 0.3, "
    "k = 0.6 }]\n"
    "[[component]]\nname = \"wing\"\nparent = \"bus\"\n"
    "hinge = { origin_m = [0, 1, 0], axis = [0, 1, 0], track = \"sun\", face = [0, 0, 1], "
    "offset_deg = 5, limits_deg = [-90, 90] }\n"
    "[[component.plate]]\nsize_m = [2, 8]\ncentre_m = [0, 5, 0]\nnormal = [0, 0, 1]\n"
    "tangent = [1, 0, 0]\nmaterial = \"glaze\"\nback_material = \"paint\"\n"
    "[[component]]\nname = \"bus\"\n"
    "[[component.box]]\nsize_m = [2, 2, 3]\nmaterial = \"glaze\"\nfaces = { \"+z\" = \"paint\" }\n"
    "[[component.prism]]\nsides = 12\nradius_m = 0.5\nlength_m = 1\ncentre_m = [0, 0, 2]\n"
    "material = \"glaze\"\nrotation_deg = { axis = [1, 0, 0], angle = 30 }\n"
    "repeat = { count = 3, axis = [0, 0, 1], step_deg = 120 }\nmirror = \"z\"\n"
    "[[component.sphere]]\nradius_m = 0.4\nfacets = 80\nmaterial = \"paint\"\n"
    "[[component.facet]]\nvertices_m = [[0, 0, 2], [1, 0, 2], [1, 1, 2], [0, 1, 2]]\n"
    "material = \"glaze\"\n";

static const char OTHERS[] = "[materials.paint]\nbrdf = \"lambert\"\nrho = 0.6\nsource = \"a\"\n";

static const char SETS[] =
    "0 ISS (ZARYA)\n1 25544U 98067A   25206.16725053  .00012111  00000+0  21923-3 0  9999\n"
    "2 25544  51.6348 118.8254 0002056 114.0852 246.0352 15.50079803521055\n";

static const char DIRECTED[] =
    "[geometry]\ntable = \"directions.csv\"\nrange_km = 800\n"
    "[materials.paint]\nbrdf = \"hapke\"\nw = 0.3\nb = -0.2\nB0 = 1\nh = 0.05\n"
    "[[component]]\nname = \"bus\"\n"
    "hinge = { origin_m = [0, 0, 0], axis = [0, 0, 1], rate_deg_s = 3, angle_deg = 1 }\n"
    "[[component.box]]\nsize_m = [1, 1, 1]\nmaterial = \"paint\"\n"
    "[[expect]]\nrow = 0\ncolumn = \"mag_V\"\nvalue = 5\ntolerance = 50\nsource = \"none\"\n"
    "[expect_table]\nfile = \"expected.csv\"\nrelative = { t_s = 0 }\n";

static const char DIRECTIONS[] = "# given\nsun_x,sun_y,sun_z,obs_x,obs_y,obs_z,range_km,t_s\n"
                                 "1,0,0,0.6,0.8,0,1000,0\n\"0\",1,0,0,1e-3,-1,2000,1.5\n";

static const char EXPECTED[] = "t_s,mag_V\n0,\n1.5,7\n";

/* Every file that the two scenarios take. */
static const struct {
    const char *name, *text;
} FILES[] = {
    {"scenario.toml", SCENARIO}, {"model.toml", MODEL},       {"others.toml", OTHERS},
    {"sets.tle", SETS},          {"directed.toml", DIRECTED}, {"directions.csv", DIRECTIONS},
    {"expected.csv", EXPECTED},
};

static void write_files(void)
{
    for (size_t k = 0; k < COUNT_OF(FILES); k++)
        write_file(FILES[k].name, FILES[k].text);
}

/* The scenario that takes file k. */
static const char *scenario_of(size_t k)
{
    return in_folder(k < 4 ? "scenario.toml" : "directed.toml");
}

static void assert_row_sound(const glint_curve *curve, const glint_row *row)
{
    size_t n;
    const glint_column *columns = glint_curve_columns(curve, &n);
    for (size_t i = 0; i < n; i++) {
        double value;
        char cell[GLINT_CELL_SIZE];
        if (!glint_curve_value(curve, row, i, &value)) continue;
        glint_curve_text(curve, row, i, cell);
        ck_assert_msg(isfinite(value), "%s is %s", columns[i].name, cell);
    }
}

/* Reads a scenario, and runs it if it can be read: numbers or an error, nothing else. True when it
 * could be read. */
static bool survives(const char *path)
{
    enum { MOST_STEPS = 4000 }; /* of longer runs, which a changed digit makes, only the reading */
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    const glint_status status = glint_scenario_read(path, NULL, 0, &s, errors);
    ck_assert_msg(status == GLINT_OK || status == GLINT_INPUT, "%d:%s", status,
                  list_errors(errors));
    ck_assert_int_eq(status == GLINT_OK, glint_errors_error_count(errors) == 0);
    ck_assert_int_eq(status == GLINT_OK, s != NULL);
    glint_curve *curve = NULL;
    if (s) ck_assert_int_eq(glint_curve_open(s, 1, &curve, errors), GLINT_OK);
    const glint_row *rows;
    size_t n = 1;
    glint_error error = {0};
    while (s && n > 0 && glint_curve_length(curve) <= MOST_STEPS) {
        const glint_status next = glint_curve_next(curve, &rows, &n, &error);
        ck_assert_msg(next == GLINT_OK || next == GLINT_INPUT, "%d: %s", next, error.message);
        if (next) break;
        for (size_t k = 0; k < n; k++)
            assert_row_sound(curve, &rows[k]);
    }
    glint_curve_close(curve);
    glint_scenario_free(s);
    glint_errors_free(errors);
    return status == GLINT_OK;
}

START_TEST(test_scenario_whole_files_are_sound)
{
    write_files();
    ck_assert(survives(in_folder("scenario.toml")));
    ck_assert(survives(in_folder("directed.toml")));
}
END_TEST

/* _i: which file. */
START_TEST(test_scenario_file_cut_at_every_byte_is_refused_or_sound)
{
    write_files();
    const size_t size = strlen(FILES[_i].text);
    int refused = 0;
    for (size_t n = 0; n < size; n++) {
        write_bytes(FILES[_i].name, FILES[_i].text, n);
        refused += !survives(scenario_of((size_t)_i));
    }
    ck_assert_int_gt(refused, 0);
}
END_TEST

/* The same sequence on every machine (Knuth's MMIX generator): 0 <= result < n. */
static size_t draw(uint64_t *state, size_t n)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (size_t)((*state >> 33) % n);
}

/* Replaces, inserts, takes out or doubles a few bytes. Returns the new length. */
static size_t damage(uint64_t *state, char *content, size_t n)
{
    static const char LIKELY[] = "0123456789.-+e\"'[]{}=,#\n \\_\0\xff\xc3\t\r:TZn";
    for (size_t changes = 1 + draw(state, 3); changes > 0 && n > 1; changes--) {
        const size_t at = draw(state, n), kind = draw(state, 4);
        const char c =
            draw(state, 4) ? LIKELY[draw(state, sizeof LIKELY - 1)] : (char)draw(state, 256);
        const size_t length = 1 + draw(state, n - at < 20 ? n - at : 20);
        if (kind == 0) {
            content[at] = c;
        } else if (kind == 1) {
            memmove(content + at + 1, content + at, n - at);
            content[at] = c;
            n++;
        } else if (kind == 2) {
            memmove(content + at, content + at + length, n - at - length);
            n -= length;
        } else {
            memmove(content + at + length, content + at, n - at);
            n += length;
        }
    }
    return n;
}

/* _i: which file. */
START_TEST(test_scenario_file_with_damaged_bytes_is_refused_or_sound)
{
    enum { ROUNDS = 1000, ROOM = 4 * 20 };
    write_files();
    const size_t size = strlen(FILES[_i].text);
    char *content = malloc(size + ROOM);
    ck_assert_ptr_nonnull(content);
    uint64_t state = 1 + (uint64_t)_i;
    int sound = 0;
    for (int round = 0; round < ROUNDS; round++) {
        memcpy(content, FILES[_i].text, size);
        const size_t n = damage(&state, content, size);
        write_bytes(FILES[_i].name, content, n);
        sound += survives(scenario_of((size_t)_i));
    }
    free(content);
    ck_assert_int_lt(sound, ROUNDS);
}
END_TEST

static Suite *scenario_files_suite(void)
{
    Suite *suite = suite_create("scenario files");
    TCase *whole = tcase_create("whole file");
    tcase_set_timeout(whole, 60);
    tcase_add_checked_fixture(whole, folder_make, folder_remove);
    tcase_add_test(whole, test_scenario_tables_missing_or_misnamed_are_refused);
    tcase_add_test(whole, test_scenario_file_absent_or_no_file_is_refused);
    tcase_add_test(whole, test_scenario_several_errors_are_all_reported_in_order);
    tcase_add_test(whole, test_scenario_first_syntax_error_is_reported_with_its_place);
    tcase_add_test(whole, test_scenario_text_that_is_no_toml_is_refused);
    tcase_add_test(whole, test_scenario_deep_nesting_is_refused);
    tcase_add_test(whole, test_scenario_override_wrong_is_refused);
    suite_add_tcase(suite, whole);
    TCase *damaged = tcase_create("damaged");
    tcase_add_checked_fixture(damaged, folder_make, folder_remove);
    tcase_set_timeout(damaged, 300);
    tcase_add_test(damaged, test_scenario_whole_files_are_sound);
    tcase_add_loop_test(damaged, test_scenario_file_cut_at_every_byte_is_refused_or_sound, 0,
                        COUNT_OF(FILES));
    tcase_add_loop_test(damaged, test_scenario_file_with_damaged_bytes_is_refused_or_sound, 0,
                        COUNT_OF(FILES));
    suite_add_tcase(suite, damaged);
    return suite;
}

int main(void)
{
    return run_suite(scenario_files_suite());
}
