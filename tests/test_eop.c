/* Measured Earth orientation: files of the IERS against astropy's interpolation of them. */
#include "base/constants.h"
#include "base/vec.h"
#include "orbit/eop.h"
#include "orbit/frames.h"
#include "scenario/scenario.h"
#include "scenario_text.h"
#include "table.h"

static const char *in_data(const char *name)
{
    return path_in(TEST_DATA_DIR "/orbit", name);
}

static eop_table *open_table(const char *path)
{
    eop_table *t;
    glint_errors *errors = glint_errors_new();
    ck_assert_msg(eop_read(path, PLACE_NONE, &t, errors) == GLINT_OK, "%s:%s", path,
                  list_errors(errors));
    ck_assert_msg(glint_errors_count(errors) == 0, "%s:%s", path, list_errors(errors));
    glint_errors_free(errors);
    return t;
}

/* A clock of a minute from a row's time on, with the table's Earth orientation. */
static run_clock clock_at(const char *utc, const eop_table *t)
{
    utc_time start;
    run_clock clock;
    ck_assert_int_eq(utc_parse(utc, PLACE_NONE, &start, NULL), GLINT_OK);
    run_clock_start(&start, 60, 0, &clock);
    ck_assert(eop_covers(t, clock.tt_jd));
    run_clock_orient(&clock, t);
    return clock;
}

/* The table has 10 and 9 digits of the values, and all of the matrix. */
START_TEST(test_eop_agrees_with_another_program)
{
    csv_table rows = table_open(in_data("eop_expected.csv"));
    for (long row = 0; row < rows.n_rows; row++) {
        eop_table *t = open_table(in_data(table_text(&rows, row, "file")));
        const run_clock clock = clock_at(table_text(&rows, row, "utc"), t);
        eop_values got;
        eop_at(t, clock.tt_jd, &got);
        assert_near(clock.dut1_s, table_number(&rows, row, "ut1_utc_s"), 1e-10);
        assert_near(got.xp_rad / ARCSEC, table_number(&rows, row, "xp_arcsec"), 1e-9);
        assert_near(got.yp_rad / ARCSEC, table_number(&rows, row, "yp_arcsec"), 1e-9);
        frame_grid *grid = NULL;
        const earth_orientation still = {0, 0};
        frame_set frames;
        ck_assert_int_eq(frame_grid_prepare(&clock, &still, 0, 60, 1, &grid, NULL), GLINT_OK);
        frame_grid_at(grid, 0, 0, &frames);
        for (int i = 0; i < 9; i++) {
            char name[32];
            snprintf(name, sizeof name, "r%d%d", i / 3 + 1, i % 3 + 1);
            /* interpolated frames keep 1e-11; the values' last digits 1e-13 */
            assert_near(frames.itrs_gcrs[i], table_number(&rows, row, name), 2e-11);
        }
        frame_grid_free(grid);
        eop_free(t);
    }
    csv_free(&rows);
}
END_TEST

START_TEST(test_eop_formats_are_told_apart)
{
    static const struct {
        const char *file, *format;
        int first, last, predicted;
    } FILES[] = {{"eop_c04.txt", "C04", 57750, 57757, 57758},
                 {"eop_c04_hours.txt", "C04", 57750, 57757, 57758},
                 {"eop_finals.txt", "finals2000A", 57500, 57511, 57507}};
    for (size_t k = 0; k < COUNT_OF(FILES); k++) {
        eop_table *t = open_table(in_data(FILES[k].file));
        int first, last, predicted;
        eop_span(t, &first, &last, &predicted);
        ck_assert_str_eq(eop_format(t), FILES[k].format);
        ck_assert_int_eq(first, FILES[k].first);
        ck_assert_int_eq(last, FILES[k].last);
        ck_assert_int_eq(predicted, FILES[k].predicted);
        eop_free(t);
    }
    eop_table *a = open_table(in_data("eop_c04.txt")),
              *b = open_table(in_data("eop_c04_hours.txt"));
    ck_assert(eop_fingerprint(a) == eop_fingerprint(b));
    eop_free(b);
    b = open_table(in_data("eop_finals.txt"));
    ck_assert(eop_fingerprint(a) != eop_fingerprint(b));
    eop_free(a);
    eop_free(b);
}
END_TEST

#define FINALS_1 "16 422 57500.00 I  0.022149 0.000091  0.458767 0.000093  I-0.1219712 0.0000056\n"

/* A day counts as predicted from where either of its two values is. */
START_TEST(test_eop_either_flag_makes_a_day_a_prediction)
{
    static const char FLAGS[][3] = {"II", "PI", "IP", "PP"};
    for (size_t k = 0; k < COUNT_OF(FLAGS); k++) {
        char text[512];
        snprintf(
            text, sizeof text,
            FINALS_1
            "16 423 57501.00 %c  0.022149 0.000091  0.458767 0.000093  %c-0.1219712 0.0000056\n",
            FLAGS[k][0], FLAGS[k][1]);
        eop_table *t = open_table(write_bytes("flags.txt", text, strlen(text)));
        int first, last, predicted;
        eop_span(t, &first, &last, &predicted);
        ck_assert_int_eq(last, 57501);
        ck_assert_int_eq(predicted, k == 0 ? 57502 : 57501);
        eop_free(t);
    }
}
END_TEST

/* Across the leap second at the end of 2016 UT1 goes on with the length of the day: 86 400 s and a
 * ms or so, while UT1-UTC jumps by 1 s. */
START_TEST(test_eop_ut1_is_steady_across_a_leap_second)
{
    eop_table *t = open_table(in_data("eop_c04.txt"));
    utc_time start = {2016, 12, 31, 12, 0, 0};
    run_clock clock;
    run_clock_start(&start, DAY_S, 0, &clock);
    run_clock_orient(&clock, t);
    double before[2], after[2];
    run_clock_ut1(&clock, 0, before);
    for (double t_s = 10; t_s <= DAY_S; t_s += 10) {
        run_clock_ut1(&clock, t_s, after);
        /* parts of a JD keep 1e-11 d, 1e-6 s */
        assert_near(jd_difference_s(after, before), 10, 3e-6);
        memcpy(before, after, sizeof before);
    }
    eop_free(t);
}
END_TEST

/* Polar motion and UT1 of a table do what the same numbers given by hand do. */
START_TEST(test_eop_in_frames_is_as_given_by_hand)
{
    eop_table *t = open_table(in_data("eop_finals.txt"));
    const run_clock with = clock_at("2016-04-27T00:00:00Z", t);
    run_clock without = with;
    without.eop = NULL;
    eop_values v;
    eop_at(t, with.tt_jd, &v);
    const earth_orientation still = {0, 0}, moved = {v.xp_rad, v.yp_rad};
    frame_grid *a = NULL, *b = NULL;
    frame_set x, y;
    ck_assert_int_eq(frame_grid_prepare(&with, &still, 0, 60, 1, &a, NULL), GLINT_OK);
    ck_assert_int_eq(frame_grid_prepare(&without, &moved, 0, 60, 1, &b, NULL), GLINT_OK);
    frame_grid_at(a, 0, FRAMES_TEME, &x);
    frame_grid_at(b, 0, FRAMES_TEME, &y);
    for (int i = 0; i < 9; i++) {
        assert_near(x.itrs_gcrs[i], y.itrs_gcrs[i], 1e-13);
        assert_near(x.gcrs_teme[i], y.gcrs_teme[i], 1e-13);
    }
    frame_grid_free(a);
    frame_grid_free(b);
    eop_free(t);
}
END_TEST

/* ----------------------------------------------------------------- bad files */

/* Reads a file that must be refused for that reason at that line. */
static void assert_bad(const char *content, int line, const char *why)
{
    eop_table *t = (eop_table *)folder;
    glint_errors *errors = glint_errors_new();
    const char *path = write_file("eop.txt", content);
    ck_assert_int_eq(eop_read(path, PLACE_NONE, &t, errors), GLINT_INPUT);
    ck_assert_ptr_null(t);
    const glint_error *e = glint_errors_get(errors, 0);
    ck_assert_msg(e->line == line && strstr(e->message, why), "wanted line %d, '%s'; got:%s", line,
                  why, list_errors(errors));
    glint_errors_free(errors);
}

#define C04_1 "2016  12  28  57750   0.086769   0.264747  -0.4052887   0.0008161\n"
#define C04_2 "2016  12  29  57751   0.084557   0.264197  -0.4060978   0.0008055\n"

START_TEST(test_eop_bad_files_name_line_and_reason)
{
    assert_bad("", 0, "0 whole days");
    assert_bad(C04_1, 0, "1 whole days");
    assert_bad("nothing of the kind\n", 0, "0 whole days");
    assert_bad(C04_1 C04_1, 2, "expected the next day");
    assert_bad(C04_1 C04_2 "2016  12  30  57753 0.08 0.26 -0.4\n", 3, "does not fit MJD");
    assert_bad(C04_1 "2016  13  29  57751 0.08 0.26 -0.4\n", 2, "does not fit MJD");
    assert_bad(C04_1 "2016  12  29  57751 0.08 x -0.4\n", 2, "'x' is no number");
    assert_bad(C04_1 "2016  12  29  57751 0.08 nan -0.4\n", 2, "'nan' is no number");
    assert_bad(C04_1 "2016  12  29  57751 0.08 0.26\n", 2, "holds 6 numbers");
    assert_bad(C04_1 "2016  12  29  57751 8 0.26 -0.4\n", 2, "at most 1 arcsec");
    assert_bad(C04_1 "2016  12  29  57751 0.08 0.26 -4\n", 2, "at most 1 arcsec and 2 s");
    assert_bad(C04_1 "2016 12 29 12 57751.50 0.08 0.26 -0.4\n", 2, "the hour is 12");
    assert_bad(FINALS_1 "16 4x3 57501.00 I  0.024059\n", 2, "the month");
    assert_bad(FINALS_1
               "16 423 57501.00 X  0.022149 0.000091  0.458767 0.000093  I-0.1219712 0.0000056\n",
               2, "the flag I");
    assert_bad(FINALS_1
               "16 423 57501.00 I  0.022149 0.000091  0.45 767 0.000093  I-0.1219712 0.0000056\n",
               2, "polar motion y");
}
END_TEST

/* Cut off at any byte, a file gives an error, or the days before the cut exactly as they are. */
static void cut_everywhere(const char *name)
{
    size_t n;
    char *bytes = read_bytes(in_data(name), &n);
    eop_table *whole = open_table(in_data(name));
    int first, last, predicted;
    eop_span(whole, &first, &last, &predicted);
    const char *path = write_bytes("cut.txt", bytes, n);
    for (size_t cut = n; cut-- > 0;) {
        eop_table *t;
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(truncate(path, (off_t)cut), 0);
        const bool in_line = cut > 0 && bytes[cut - 1] != '\n';
        if (eop_read(path, PLACE_NONE, &t, errors) == GLINT_OK) {
            int from, to, rest;
            eop_span(t, &from, &to, &rest);
            ck_assert_int_eq(from, first);
            int lines = 0; /* whole lines of data */
            for (size_t i = 0; i < cut; i++)
                lines += bytes[i] == '\n';
            ck_assert_int_le(to - from + 1, lines);
            for (double day = from; day <= to; day += 0.25) {
                const double tt_jd[2] = {2400000.5 + day, 37 / DAY_S};
                eop_values a, b;
                if (!eop_covers(t, tt_jd)) continue;
                eop_at(t, tt_jd, &a);
                eop_at(whole, tt_jd, &b);
                ck_assert(memcmp(&a, &b, sizeof a) == 0);
            }
            ck_assert_int_eq(glint_errors_count(errors) > 0, in_line);
        } else {
            ck_assert_uint_gt(glint_errors_error_count(errors), 0);
        }
        eop_free(t);
        glint_errors_free(errors);
    }
    eop_free(whole);
    free(bytes);
}

START_TEST(test_eop_cut_anywhere_is_an_error_or_what_was_before)
{
    cut_everywhere("eop_c04.txt");
    cut_everywhere("eop_c04_hours.txt");
    cut_everywhere("eop_finals.txt");
}
END_TEST

/* ----------------------------------------------------------------- scenarios */

/* A scenario of that day with that setting. */
static const char *scenario_of(const char *start, const char *settings)
{
    char time[256];
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    snprintf(time, sizeof time, "[time]\nstart = %s\nduration_s = 60\nstep_s = 10\n", start);
    parts[PART_SETTINGS] = settings;
    const marked_text m = with_part(parts, PART_TIME, time);
    return write_file("scenario.toml", m.text);
}

START_TEST(test_eop_of_a_scenario_must_cover_it)
{
    char settings[1200];
    snprintf(settings, sizeof settings, "[corrections]\neop = \"%s\"\n", in_data("eop_finals.txt"));
    const char *path = scenario_of("2016-04-25T12:00:00Z", settings);
    glint_scenario *s = read_sound(path);
    ck_assert_ptr_nonnull(s->clock.eop);
    assert_near(s->clock.dut1_s, 0.5 * (-0.1265278 - 0.1278231), 1e-9);
    glint_scenario_free(s);
    static const char *const OUTSIDE[] = {"2016-04-21T23:59:30Z", "2016-05-02T23:59:30Z"};
    for (size_t k = 0; k < COUNT_OF(OUTSIDE); k++) {
        path = scenario_of(OUTSIDE[k], settings);
        assert_refused_set(path, NULL, 0, path, 0, 0, "from 2016-04-22 to 2016-05-03", "covers it",
                           1);
    }
    snprintf(settings, sizeof settings, "[corrections]\ndut1_s = 0.1\neop = \"%s\"\n",
             in_data("eop_finals.txt"));
    path = scenario_of("2016-04-25T12:00:00Z", settings);
    assert_refused_set(path, NULL, 0, path, 0, 0, "both 'dut1_s' and 'eop'", "one of them", 1);
    path = scenario_of("2016-04-25T12:00:00Z", "[corrections]\neop = \"absent.txt\"\n");
    assert_refused_set(path, NULL, 0, path, 0, 0, "absent.txt", NULL, 1);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("eop");
    TCase *tc = tcase_create("eop");
    tcase_set_timeout(tc, 60);
    tcase_add_checked_fixture(tc, folder_make, folder_remove);
    tcase_add_test(tc, test_eop_agrees_with_another_program);
    tcase_add_test(tc, test_eop_formats_are_told_apart);
    tcase_add_test(tc, test_eop_either_flag_makes_a_day_a_prediction);
    tcase_add_test(tc, test_eop_ut1_is_steady_across_a_leap_second);
    tcase_add_test(tc, test_eop_in_frames_is_as_given_by_hand);
    tcase_add_test(tc, test_eop_bad_files_name_line_and_reason);
    tcase_add_test(tc, test_eop_cut_anywhere_is_an_error_or_what_was_before);
    tcase_add_test(tc, test_eop_of_a_scenario_must_cover_it);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
