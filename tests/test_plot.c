/* Pictures: how gnuplot is found, told and listened to (with programs of that name that the tests
 * write), and what of a long light curve comes into its picture. */
#include "scenario_text.h"

#include "output/curve_plot.h"
#include "output/plot.h"

#include <sys/stat.h>

/* ------------------------------------------------------------------ helpers */

static char old_path[4096];

static void keep_path(void)
{
    const char *path = getenv("PATH");
    snprintf(old_path, sizeof old_path, "%s", path ? path : "");
    folder_make();
}

/* Puts a program `gnuplot` with this text into the folder, which becomes the whole of PATH but for
 * where the tools lie that it needs. */
static void fake_gnuplot(const char *commands)
{
    char program[1024], path[512];
    snprintf(program, sizeof program, "#!/bin/sh\n%s\n", commands);
    ck_assert_int_eq(chmod(write_file("gnuplot", program), 0755), 0);
    snprintf(path, sizeof path, "%s:/usr/bin:/bin", folder);
    ck_assert_int_eq(setenv("PATH", path, 1), 0);
}

static void restore_gnuplot(void)
{
    remove(in_folder("gnuplot"));
    setenv("PATH", old_path, 1);
}

static void restore_path(void)
{
    restore_gnuplot();
    folder_remove();
}

/* Draws a script into a file of the folder. */
static glint_status draw(const char *name, const char *script, size_t n, glint_error *error)
{
    plot *p;
    *error = (glint_error){0};
    const glint_status status = plot_open(in_folder(name), &p, error);
    return status ? status : plot_finish(p, script, n, error);
}

static void assert_message(const glint_error *error, const char *wanted)
{
    ck_assert_msg(strstr(error->message, wanted) != NULL, "wanted '%s'; got '%s'", wanted,
                  error->message);
}

/* True where the real gnuplot is there. */
static bool has_gnuplot(const char *what)
{
    glint_error error;
    if (glint_plot_check(in_folder("try.png"), NULL, &error) == GLINT_OK) return true;
    printf("SKIPPED: %s: no gnuplot\n", what);
    return false;
}

/* ------------------------------------------------------------ the conversation */

START_TEST(test_plot_is_what_gnuplot_writes_to_its_output)
{
    static const char *const cases[][2] = {
        {"a.png", "set terminal pngcairo size 1200,800 "},
        {"a.svg", "set terminal svg size 1200,800 "},
        {"a.pdf", "set terminal pdfcairo "},
        {"A.PNG", "set terminal pngcairo "},
    };
    fake_gnuplot("echo \"$*\"; exec cat");
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        glint_error error;
        const glint_status status = draw(cases[k][0], "plot x\n", 7, &error);
        ck_assert_msg(status == GLINT_OK, "%s", error.message);
        char *got = read_bytes(in_folder(cases[k][0]), NULL);
        /* no user's start-up files, and the script from standard input */
        ck_assert_msg(strncmp(got, "--default-settings -\nset encoding utf8\n", 39) == 0, "%s",
                      got);
        ck_assert_msg(strstr(got, cases[k][1]) != NULL, "%s", got);
        ck_assert_msg(strstr(got, "\nplot x\n") != NULL, "%s", got);
        ck_assert_msg(strstr(got, folder) == NULL, "gnuplot was told the file's name: %s", got);
        free(got);
    }
    ck_assert_int_eq(folder_count(), 1 + (int)COUNT_OF(cases));
}
END_TEST

/* Both ways more than any buffer of the system holds: neither side may wait for the other. */
START_TEST(test_plot_of_megabytes_goes_through_both_ways)
{
    enum { SIZE = 8 << 20 };
    char *script = malloc(SIZE);
    ck_assert_ptr_nonnull(script);
    for (int k = 0; k < SIZE; k++)
        script[k] = (char)('a' + k % 25);
    fake_gnuplot("exec cat");
    glint_error error;
    ck_assert_int_eq(draw("big.png", script, SIZE, &error), GLINT_OK);
    size_t n;
    char *got = read_bytes(in_folder("big.png"), &n);
    const char *start = strstr(got, "abcdefg");
    ck_assert_ptr_nonnull(start);
    ck_assert(memcmp(start, script, SIZE) == 0);
    free(got);
    free(script);
}
END_TEST

/* The signal of a broken pipe would end the program that draws; here it would end the test. */
START_TEST(test_plot_survives_a_gnuplot_that_does_not_listen)
{
    enum { SIZE = 8 << 20 };
    char *script = calloc(1, SIZE);
    ck_assert_ptr_nonnull(script);
    static const char *const cases[] = {"exit 1", "exec <&-; sleep 0.2; exit 3",
                                        "head -c 1000 >&2"};
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        glint_error error;
        fake_gnuplot(cases[k]);
        ck_assert_int_eq(draw("a.png", script, SIZE, &error), GLINT_OUTPUT);
        assert_message(&error, "gnuplot drew no picture");
    }
    ck_assert_int_eq(folder_count(), 1); /* gnuplot */
    free(script);
}
END_TEST

START_TEST(test_plot_that_fails_says_what_gnuplot_said_and_keeps_the_old_file)
{
    write_file("a.svg", "precious");
    fake_gnuplot("cat >/dev/null; echo half a picture; printf 'gnuplot> plt x\\n         ^\\n"
                 "         line 3: invalid command\\n\\n' >&2; exit 1");
    glint_error error;
    ck_assert_int_eq(draw("a.svg", "plt x\n", 6, &error), GLINT_OUTPUT);
    assert_message(&error, "it said: gnuplot> plt x ^ line 3: invalid command");
    ck_assert_ptr_null(strchr(error.message, '\n'));
    char *kept = read_bytes(in_folder("a.svg"), NULL);
    ck_assert_str_eq(kept, "precious");
    free(kept);
    fake_gnuplot("cat >/dev/null; echo fine >&2"); /* and no picture */
    ck_assert_int_eq(draw("a.svg", "\n", 1, &error), GLINT_OUTPUT);
    assert_message(&error, "drew no picture; it said: fine");
    fake_gnuplot("kill -9 $$");
    ck_assert_int_eq(draw("a.svg", "\n", 1, &error), GLINT_OUTPUT);
    assert_message(&error, "ended by signal 9; it said: nothing");
    ck_assert_int_eq(folder_count(), 2);
}
END_TEST

START_TEST(test_plot_warnings_of_gnuplot_do_no_harm)
{
    fake_gnuplot("echo warning >&2; exec cat");
    glint_error error;
    ck_assert_int_eq(draw("a.pdf", "\n", 1, &error), GLINT_OK);
}
END_TEST

START_TEST(test_plot_without_gnuplot_says_what_to_install)
{
    fake_gnuplot("exec cat");
    char relative[512];
    snprintf(relative, sizeof relative, "%s/nothing::relative:.", folder);
    const char *const paths[] = {"", "/no/such/folder", relative};
    ck_assert_int_eq(chdir(folder), 0); /* what lies here is no installed program */
    for (size_t k = 0; k < COUNT_OF(paths); k++) {
        glint_error error = {0};
        ck_assert_int_eq(setenv("PATH", paths[k], 1), 0);
        ck_assert_int_eq(glint_plot_check(in_folder("a.png"), NULL, &error), GLINT_OUTPUT);
        assert_message(&error, "gnuplot-nox");
        ck_assert_str_eq(error.file, in_folder("a.png"));
    }
    ck_assert_int_eq(unsetenv("PATH"), 0);
    ck_assert_int_eq(glint_plot_check(in_folder("a.png"), NULL, NULL), GLINT_OUTPUT);
    ck_assert_int_eq(chdir("/"), 0);
    ck_assert_int_eq(folder_count(), 1);
}
END_TEST

START_TEST(test_plot_passes_over_what_is_no_program)
{
    char path[1024];
    fake_gnuplot("exec cat");
    ck_assert_int_eq(mkdir(in_folder("first"), 0755), 0);
    ck_assert_int_eq(mkdir(in_folder("first/gnuplot"), 0755), 0); /* a folder of that name */
    snprintf(path, sizeof path, "%s/first:%s", folder, folder);
    ck_assert_int_eq(setenv("PATH", path, 1), 0);
    ck_assert_int_eq(glint_plot_check(in_folder("a.png"), NULL, NULL), GLINT_OK);
    ck_assert_int_eq(chmod(in_folder("gnuplot"), 0644), 0);
    ck_assert_int_eq(glint_plot_check(in_folder("a.png"), NULL, NULL), GLINT_OUTPUT);
    ck_assert_int_eq(rmdir(in_folder("first/gnuplot")), 0);
}
END_TEST

START_TEST(test_plot_of_another_kind_is_refused)
{
    static const char *const names[] = {"a.jpg", "a", ".png", "png", "a.png.txt", "a.svgz", ""};
    fake_gnuplot("exec cat");
    for (size_t k = 0; k < COUNT_OF(names); k++) {
        glint_error error = {0};
        ck_assert_msg(glint_plot_check(names[k], NULL, &error) == GLINT_ARGUMENT, "%s", names[k]);
        assert_message(&error, ".svg, .png or .pdf");
    }
}
END_TEST

START_TEST(test_plot_where_nothing_can_be_written_is_refused)
{
    fake_gnuplot("exec cat");
    glint_error error = {0};
    ck_assert_int_eq(glint_plot_check(in_folder("no/such/a.png"), NULL, &error), GLINT_OUTPUT);
    ck_assert_int_eq(mkdir(in_folder("folder.png"), 0755), 0);
    ck_assert_int_eq(glint_plot_check(in_folder("folder.png"), NULL, &error), GLINT_OUTPUT);
    assert_message(&error, "directory");
}
END_TEST

START_TEST(test_plot_in_the_place_of_its_table_is_refused)
{
    fake_gnuplot("exec cat");
    glint_error error = {0};
    ck_assert_int_eq(glint_plot_check(in_folder("a.svg"), in_folder("./a.svg"), &error),
                     GLINT_ARGUMENT);
    assert_message(&error, "expected two files");
    ck_assert_int_eq(glint_plot_check(in_folder("a.svg"), in_folder("a.csv"), &error), GLINT_OK);
}
END_TEST

/* ---------------------------------------------------------------------- quotes */

START_TEST(test_plot_quote_keeps_a_text_in_its_quotes)
{
    static const char *const cases[][2] = {
        {"", "''"},
        {"plain", "'plain'"},
        {"it's", "'it' . \"'\" . 's'"},
        {"'", "'' . \"'\" . ''"},
        {"a\nb\tc\001d\177", "'a b c d '"},
        {"`ls` $x @y %z \\n \"q\"", "'`ls` $x @y %z \\n \"q\"'"},
        {"30\xc2\xb0", "'30\xc2\xb0'"},
        {"\xb0 \xc2", "'? ?'"},
    };
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        text t = {0};
        plot_quote(&t, cases[k][0]);
        ck_assert_str_eq(t.data, cases[k][1]);
        text_free(&t);
    }
}
END_TEST

/* Names of files and titles of scenarios come from anywhere. */
START_TEST(test_plot_quote_lets_gnuplot_run_nothing)
{
    if (!has_gnuplot("hostile titles")) return;
    char hostile[1024], mark[512];
    snprintf(mark, sizeof mark, "%s/mark", folder);
    static const char *const forms[] = {"`touch %s`", "'; system 'touch %s'; x = '",
                                        "\n!touch %s\n", "' . system('touch %s') . '",
                                        "\"`touch %s`\" @x \\"};
    for (size_t k = 0; k < COUNT_OF(forms); k++) {
        const char *at = strstr(forms[k], "%s");
        snprintf(hostile, sizeof hostile, "%.*s%s%s", (int)(at - forms[k]), forms[k], mark, at + 2);
        text script = {0};
        text_add(&script, "set title ");
        plot_quote(&script, hostile);
        text_add(&script, " noenhanced\nplot x title ");
        plot_quote(&script, hostile);
        text_char(&script, '\n');
        glint_error error;
        const glint_status status = draw("a.svg", script.data, script.length, &error);
        ck_assert_msg(status == GLINT_OK, "%s: %s", hostile, error.message);
        ck_assert_msg(access(mark, F_OK) != 0, "gnuplot obeyed %s", hostile);
        text_free(&script);
    }
}
END_TEST

/* ---------------------------------------------------------------- light curves */

/* A plate that turns under the Sun in very small steps, lit and seen half of the time. Its lobe is
 * narrower than a pixel of any picture. */
static const char *const TURNING[N_PARTS] = {
    [PART_TOP] = "title = \"it's a `turning` plate\"\n",
    [PART_TIME] = "[geometry]\nrotate = { axis = [0, 0, 1], step_deg = 0.002, sun = [1, 0, 0], "
                  "observer = [1, 0, 0] }\nrange_km = 1000\n",
    [PART_SETTINGS] = "[photometry]\nbands = [\"V\", \"B\"]\n",
    [PART_MATERIAL] = "[materials.foil]\nbrdf = \"ward-gmd\"\nrho_d = 0.1\nrho_s = 0.3\n"
                      "alpha_x = 0.0002\nalpha_y = 0.0002\n",
    [PART_COMPONENT] = "[[component]]\nname = \"wing\"\n",
    [PART_PRIMITIVE] = "[[component.plate]]\nsize_m = [1, 1]\nnormal = [0, 1, 0]\n"
                       "tangent = [0, 0, 1]\nmaterial = \"foil\"\n",
};

/* The numbers of a data block: x and y of each line, a blank line as NaN. Returns their number. */
static size_t block_points(const char *script, const char *name, double (*points)[2], size_t most)
{
    char head[64];
    snprintf(head, sizeof head, "$%s << end\n", name);
    const char *at = strstr(script, head);
    ck_assert_msg(at != NULL, "there is no %s in %.500s", head, script);
    at += strlen(head);
    size_t n = 0;
    for (; strncmp(at, "end\n", 4) != 0; at = strchr(at, '\n') + 1) {
        ck_assert_uint_lt(n, most);
        if (sscanf(at, "%lf %lf", &points[n][0], &points[n][1]) != 2 || *at == '\n')
            points[n][0] = points[n][1] = (double)NAN;
        n++;
    }
    return n;
}

/* The script of a scenario's picture, and the brightest and the faintest magnitude in V of its
 * rows. */
static text script_of(const char *path, double *brightest, double *faintest, int64_t *n_rows)
{
    glint_scenario *s = read_sound(path);
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    curve_plot *p = curve_plot_start(curve);
    ck_assert_ptr_nonnull(p);
    *brightest = (double)INFINITY;
    *faintest = -(double)INFINITY;
    *n_rows = 0;
    for (;;) {
        const glint_row *rows;
        size_t n;
        ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
        if (n == 0) break;
        curve_plot_add(p, rows, n);
        *n_rows += (int64_t)n;
        for (size_t k = 0; k < n; k++) {
            if (!(rows[k].flux_ratio[0] > 0)) continue;
            *brightest = fmin(*brightest, rows[k].magnitude[0]);
            *faintest = fmax(*faintest, rows[k].magnitude[0]);
        }
    }
    text script = {0};
    curve_plot_write(p, &script);
    ck_assert(!script.failed);
    curve_plot_free(p);
    glint_curve_close(curve);
    glint_scenario_free(s);
    return script;
}

START_TEST(test_curve_plot_of_a_long_run_keeps_what_is_brightest_and_faintest)
{
    enum { MOST = 10000 };
    static double points[MOST][2];
    double brightest, faintest, least = (double)INFINITY, most = -(double)INFINITY;
    int64_t n_rows;
    int gaps = 0;
    const marked_text whole = with_part(TURNING, PART_TOP, TURNING[PART_TOP]);
    text script =
        script_of(write_file("scenario.toml", whole.text), &brightest, &faintest, &n_rows);
    ck_assert_int_eq(n_rows, 180000);
    const size_t n = block_points(script.data, "band0", points, MOST);
    for (size_t k = 0; k < n; k++) {
        if (isnan(points[k][0])) {
            gaps++;
            continue;
        }
        least = fmin(least, points[k][1]);
        most = fmax(most, points[k][1]);
    }
    /* to the digits that are written; the lobe lasts a few hundredths of a degree */
    assert_near(least, brightest, 1e-5);
    assert_near(most, faintest, 1e-5);
    ck_assert_uint_ge(n, 1000); /* half of 2000 stretches are lit */
    ck_assert_uint_le(n, 4010);
    ck_assert_int_eq(gaps, 0); /* lit in one go: the normal is on y, the Sun moves from x to y */
    ck_assert_uint_eq(block_points(script.data, "band1", points, MOST), n);
    ck_assert_ptr_nonnull(strstr(script.data, "'it' . \"'\" . 's a `turning` plate' noenhanced"));
    ck_assert_ptr_nonnull(strstr(script.data, "title 'foil'"));
    ck_assert_ptr_nonnull(strstr(script.data, "$shares0"));
    text_free(&script);
}
END_TEST

/* With a step of 30 deg every row is its own stretch. */
START_TEST(test_curve_plot_of_a_short_run_holds_every_row)
{
    enum { MOST = 100 };
    double points[MOST][2], brightest, faintest;
    int64_t n_rows;
    const marked_text whole = with_part(TURNING, PART_TIME,
                                        "[geometry]\nrotate = { axis = [0, 0, 1], step_deg = 30, "
                                        "sun = [1, 1, 0], observer = [1, 1, 0] }\n"
                                        "range_km = 1000\n");
    text script =
        script_of(write_file("scenario.toml", whole.text), &brightest, &faintest, &n_rows);
    ck_assert_int_eq(n_rows, 12);
    ck_assert_uint_eq(block_points(script.data, "band0", points, MOST), 6 + 1); /* and one gap */
    ck_assert_uint_eq(block_points(script.data, "dots0", points, MOST), 1);     /* NaN: none */
    ck_assert(isnan(points[0][0]));
    text_free(&script);
}
END_TEST

START_TEST(test_curve_plot_marks_rows_that_stand_alone)
{
    double points[10][2], brightest, faintest;
    int64_t n_rows;
    const marked_text whole = with_part(TURNING, PART_TIME,
                                        "[geometry]\nrotate = { axis = [0, 0, 1], step_deg = 120, "
                                        "sun = [0, 1, 0], observer = [0, 1, 0] }\n"
                                        "range_km = 1000\n");
    text script =
        script_of(write_file("scenario.toml", whole.text), &brightest, &faintest, &n_rows);
    ck_assert_uint_eq(block_points(script.data, "dots0", points, 10), 1);
    assert_near(points[0][0], 0, 0);
    assert_near(points[0][1], brightest, 1e-5);
    text_free(&script);
}
END_TEST

/* What is drawn must be a script that gnuplot takes: lit, dark, one row, over time and over phase.
 */
START_TEST(test_curve_plot_is_drawn_whatever_the_rows_are)
{
    if (!has_gnuplot("pictures of light curves")) return;
    static const struct {
        const char *const *parts;
        enum part part;
        const char *text, *shown;
    } cases[] = {
        {SOUND, PART_TOP, "title = \"over time\"\n", "25 Jul 2025"},
        {SOUND, PART_TIME, "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 0\nstep_s = 1\n",
         "25 Jul 2025"},
        {SOUND, PART_TIME,
         "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 432000\nstep_s = 100\n",
         "25 Jul 2025 to 30 Jul 2025"},
        {SOUND, PART_SETTINGS, "[output]\nshares = \"none\"\n", "magnitude V"},
        {SOUND, PART_SETTINGS, "[output]\nshares = \"both\"\n", "component share"},
        {SOUND, PART_SETTINGS, "[photometry]\nbands = [\"sdss_g\", \"V\"]\n",
         "material share in sdss_g"},
        {GIVEN, PART_TOP, "", "phase angle (deg)"},
        {TURNING, PART_TIME,
         "[geometry]\nrotate = { axis = [0, 0, 1], step_deg = 30, sun = [0, 0, -1], "
         "observer = [0, 0, 1] }\n",
         "no row has a magnitude"},
    };
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        const marked_text whole = with_part(cases[k].parts, cases[k].part, cases[k].text);
        glint_scenario *s = read_sound(write_file("scenario.toml", whole.text));
        glint_curve *curve;
        glint_error error = {0};
        ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
        const glint_status status = glint_table_write(curve, in_folder("a.csv"), in_folder("a.svg"),
                                                      NULL, NULL, NULL, &error);
        ck_assert_msg(status == GLINT_OK, "case %zu: %s", k, error.message);
        char *svg = read_bytes(in_folder("a.svg"), NULL);
        ck_assert_msg(strstr(svg, "<svg") && strstr(svg, "</svg>"), "case %zu is no SVG", k);
        ck_assert_msg(strstr(svg, cases[k].shown) != NULL, "case %zu has no '%s'", k,
                      cases[k].shown);
        free(svg);
        glint_curve_close(curve);
        glint_scenario_free(s);
    }
}
END_TEST

/* A picture that cannot be drawn is said before anything is computed, and the table is not begun.
 */
START_TEST(test_curve_plot_that_cannot_be_drawn_stops_the_run_at_once)
{
    const marked_text whole = with_part(GIVEN, PART_TOP, "");
    glint_scenario *s = read_sound(write_file("scenario.toml", whole.text));
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    static const struct {
        const char *picture;
        glint_status status;
    } cases[] = {{"a.jpg", GLINT_ARGUMENT}, {"no/such/a.png", GLINT_OUTPUT}};
    fake_gnuplot("exec cat");
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        ck_assert_int_eq(glint_table_write(curve, in_folder("a.csv"), in_folder(cases[k].picture),
                                           NULL, NULL, NULL, NULL),
                         cases[k].status);
        ck_assert_int_eq(glint_curve_done(curve), 0);
        ck_assert_int_ne(access(in_folder("a.csv"), F_OK), 0);
    }
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

/* ----------------------------------------------------- tracks and predictions */

/* The script for the picture of a track of two days of the sound scenario, from a gnuplot that
 * gives it back; from malloc. */
static char *track_script(const char *track)
{
    const marked_text m = with_part(SOUND, PART_EXPECT, "[observed]\nfile = \"track.csv\"\n");
    const char *const days[] = {"time.duration_s=180000"};
    write_file("track.csv", track);
    glint_scenario *s;
    glint_comparison *c;
    glint_error error = {0};
    ck_assert_int_eq(glint_scenario_read(write_file("s.toml", m.text), days, 1, &s, NULL),
                     GLINT_OK);
    ck_assert_int_eq(glint_compare(s, 1, &c, NULL), GLINT_OK);
    fake_gnuplot("exec cat");
    ck_assert_msg(glint_comparison_plot(c, 1, in_folder("a.svg"), &error) == GLINT_OK, "%s",
                  error.message);
    char *script = read_bytes(in_folder("a.svg"), NULL);
    restore_gnuplot();
    if (has_gnuplot("pictures of tracks"))
        ck_assert_msg(glint_comparison_plot(c, 1, in_folder("b.svg"), &error) == GLINT_OK, "%s",
                      error.message);
    glint_comparison_free(c);
    glint_scenario_free(s);
    return script;
}

/* How often a text has another one in it. */
static int count_of(const char *in, const char *what)
{
    int n = 0;
    for (const char *at = in; (at = strstr(at, what)); at += strlen(what))
        n++;
    return n;
}

START_TEST(test_comparison_plot_of_one_pass_has_an_axis_of_utc_and_a_curve)
{
    char *script = track_script("utc,magnitude\n2025-07-25T20:37:10Z,9\n2025-07-25T20:38:00Z,9\n");
    ck_assert_ptr_nonnull(strstr(script, "set xdata time"));
    ck_assert_ptr_nonnull(strstr(script, "a white box"));
    const char *curve = strstr(script, "$predicted << end\n"), *end = strstr(curve, "\nend\n");
    int points = 0;
    for (const char *line = curve; line < end; line = strchr(line, '\n') + 1)
        points += line[0] >= '0' && line[0] <= '9';
    ck_assert_int_ge(points, 100); /* 50 s */
    /* 20:37:10 of 25 July 2025, 20294 days after 1 January 1970 */
    ck_assert_ptr_nonnull(strstr(curve, "\n1753475830.000000 "));
    free(script);
}
END_TEST

/* The box is up again 98 minutes after; a pass may have a single row. */
START_TEST(test_comparison_plot_sets_passes_side_by_side)
{
    char *script = track_script("utc,magnitude\n2025-07-25T20:37:10Z,9\n2025-07-25T20:38:00Z,9\n"
                                "2025-07-25T22:15:10Z,9\n");
    ck_assert_ptr_null(strstr(script, "set xdata time"));
    ck_assert_int_eq(count_of(script, "set arrow from"), 1);
    ck_assert_ptr_nonnull(strstr(script, "\"20:37\\n25 Jul 2025\" 0.000000"));
    /* 50 s, and half of the mean of 50 and 0 s */
    ck_assert_ptr_nonnull(strstr(script, "\"22:15\\n25 Jul 2025\" 62.500000"));
    free(script);
}
END_TEST

/* ------------------------------------------------------------- shares and changes */

/* Twelve plates that look the same way, the k-th of k + 1 m^2, as a component each. */
static const char *write_plates(void)
{
    text t = {0};
    for (int part = 0; part < PART_COMPONENT; part++)
        text_add(&t, TURNING[part] ? TURNING[part] : "");
    text_add(&t, "[materials.grey]\nbrdf = \"lambert\"\nrho = 0.25\n");
    for (int k = 0; k < 12; k++)
        text_printf(&t,
                    "[[component]]\nname = \"part-%d\"\n[[component.plate]]\nsize_m = [1, %d]\n"
                    "centre_m = [0, 0, %d]\nnormal = [0, 1, 0]\ntangent = [1, 0, 0]\n"
                    "material = \"foil\"\n",
                    k, k + 1, 20 * k);
    const char *path = write_file("plates.toml", t.data);
    text_free(&t);
    return path;
}

/* No name is lost: what a legend has no room for is named together, and all adds up to 1. */
START_TEST(test_shares_plot_names_the_largest_and_sums_up_the_others)
{
    const char *const swap[] = {"foil=grey"};
    const glint_changes changes = {swap, 1, NULL, 0};
    glint_shares *shares;
    glint_error error = {0};
    const char *const set[] = {"geometry.rotate.step_deg=30"};
    ck_assert_int_eq(
        glint_shares_find(write_plates(), set, 1, &changes, 1, NULL, NULL, &shares, NULL),
        GLINT_OK);
    fake_gnuplot("exec cat");
    ck_assert_msg(glint_shares_plot(shares, 1, in_folder("a.svg"), &error) == GLINT_OK, "%s",
                  error.message);
    char *script = read_bytes(in_folder("a.svg"), NULL);
    restore_gnuplot();
    if (has_gnuplot("pictures of shares"))
        ck_assert_msg(glint_shares_plot(shares, 1, in_folder("b.svg"), &error) == GLINT_OK, "%s",
                      error.message);
    ck_assert_ptr_nonnull(strstr(script, "'foil=grey'"));
    ck_assert_ptr_nonnull(strstr(script, "$given0 << end"));
    ck_assert_ptr_nonnull(strstr(script, "title 'as given'"));
    const char *legend = strstr(script, "set ylabel 'components in V'");
    ck_assert_ptr_nonnull(legend);
    ck_assert_ptr_nonnull(strstr(legend, "title 'part-11'"));
    const char *others = strstr(legend, " others'");
    ck_assert_ptr_nonnull(others);
    const char *number = others;
    while (number[-1] != '\'')
        number--;
    const long n_others = strtol(number, NULL, 10);
    ck_assert_int_gt(n_others, 0);
    int names = 0;
    for (int k = 0; k < 12; k++) {
        char name[32];
        snprintf(name, sizeof name, "title 'part-%d'", k);
        names += strstr(legend, name) != NULL;
    }
    ck_assert_int_eq(names + n_others, 12);
    const char *row = strchr(strstr(script, "$shares1 << end"), '\n') + 1;
    char line[256];
    snprintf(line, sizeof line, "%.*s", (int)strcspn(row, "\n"), row);
    assert_near(strtod(strrchr(line, ' '), NULL), 1, 1e-5);
    free(script);
    glint_shares_free(shares);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("plot");
    TCase *all = tcase_create("all");
    tcase_add_checked_fixture(all, keep_path, restore_path);
    tcase_set_timeout(all, 120);
    tcase_add_test(all, test_plot_is_what_gnuplot_writes_to_its_output);
    tcase_add_test(all, test_plot_of_megabytes_goes_through_both_ways);
    tcase_add_test(all, test_plot_survives_a_gnuplot_that_does_not_listen);
    tcase_add_test(all, test_plot_that_fails_says_what_gnuplot_said_and_keeps_the_old_file);
    tcase_add_test(all, test_plot_warnings_of_gnuplot_do_no_harm);
    tcase_add_test(all, test_plot_without_gnuplot_says_what_to_install);
    tcase_add_test(all, test_plot_passes_over_what_is_no_program);
    tcase_add_test(all, test_plot_of_another_kind_is_refused);
    tcase_add_test(all, test_plot_in_the_place_of_its_table_is_refused);
    tcase_add_test(all, test_plot_where_nothing_can_be_written_is_refused);
    tcase_add_test(all, test_plot_quote_keeps_a_text_in_its_quotes);
    tcase_add_test(all, test_plot_quote_lets_gnuplot_run_nothing);
    tcase_add_test(all, test_curve_plot_of_a_long_run_keeps_what_is_brightest_and_faintest);
    tcase_add_test(all, test_curve_plot_of_a_short_run_holds_every_row);
    tcase_add_test(all, test_curve_plot_marks_rows_that_stand_alone);
    tcase_add_test(all, test_curve_plot_is_drawn_whatever_the_rows_are);
    tcase_add_test(all, test_curve_plot_that_cannot_be_drawn_stops_the_run_at_once);
    tcase_add_test(all, test_comparison_plot_of_one_pass_has_an_axis_of_utc_and_a_curve);
    tcase_add_test(all, test_comparison_plot_sets_passes_side_by_side);
    tcase_add_test(all, test_shares_plot_names_the_largest_and_sums_up_the_others);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
