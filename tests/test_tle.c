/* Reading two-line element sets, and choosing one from a file. */
#include "base/constants.h"
#include "orbit/tle.h"
#include "testing.h"

#include <unistd.h>

/* The ISS on 25 July 2025. */
static const char iss1[] = "1 25544U 98067A   25206.16725053  .00012111  00000+0  21923-3 0  9999";
static const char iss2[] = "2 25544  51.6348 118.8254 0002056 114.0852 246.0352 15.50079803521055";

static const place somewhere = {"stations.tle", 2, 1};

enum { LINE_ROOM = 256 };

static tle parse(const char *line1, const char *line2, bool check_sums)
{
    tle out;
    glint_error error = {0};
    const glint_status status = tle_parse(line1, line2, check_sums, somewhere, NULL, &out, &error);
    ck_assert_msg(status == GLINT_OK, "%d:%d: %s", error.line, error.column, error.message);
    return out;
}

/* Parsing must fail at that place, with a message that holds `word`. */
static void assert_refused(const char *line1, const char *line2, bool check_sums, int line,
                           int column, const char *word)
{
    tle out = {.number = -5};
    glint_error error = {0};
    ck_assert_int_eq(tle_parse(line1, line2, check_sums, somewhere, NULL, &out, &error),
                     GLINT_INPUT);
    ck_assert_msg(strstr(error.message, word) != NULL, "'%s' is not in: %s", word, error.message);
    ck_assert_msg(error.line == line && error.column == column, "%d:%d instead of %d:%d: %s",
                  error.line, error.column, line, column, error.message);
    ck_assert_str_eq(error.file, "stations.tle");
    ck_assert_int_eq(out.number, -5);
    ck_assert_int_eq(tle_parse(line1, line2, check_sums, somewhere, NULL, &out, NULL), GLINT_INPUT);
}

/* A copy of a line with `text` from that column on (columns count from 1). */
static const char *with(const char *line, int column, const char *text)
{
    static char copies[4][LINE_ROOM];
    static int next;
    char *copy = copies[next++ % 4];
    memmove(copy, line, strlen(line) + 1);
    memcpy(copy + column - 1, text, strlen(text));
    return copy;
}

/* ------------------------------------------------------------ values */

START_TEST(test_tle_parse_reads_all_elements)
{
    const tle e = parse(iss1, iss2, true);
    const double ulp = 1e-15; /* relative: one rounding of the conversion */
    ck_assert_int_eq(e.number, 25544);
    ck_assert_str_eq(e.designator, "98067A");
    ck_assert_str_eq(e.name, "");
    assert_near(e.epoch_jd[0], 2460881.5, 0.0); /* 25 July 2025, 0h */
    assert_near(e.epoch_jd[1], 0.16725053, 0.0);
    assert_near(e.mean_motion_dot, 0.00012111, 0.0);
    assert_near(e.bstar, 0.21923e-3, 0.0);
    assert_rel(e.inclination, 51.6348 * PI / 180.0, ulp);
    assert_rel(e.raan, 118.8254 * PI / 180.0, ulp);
    assert_near(e.eccentricity, 0.0002056, 0.0);
    assert_rel(e.argument_of_perigee, 114.0852 * PI / 180.0, ulp);
    assert_rel(e.mean_anomaly, 246.0352 * PI / 180.0, ulp);
    assert_rel(e.mean_motion, 15.50079803 * 2.0 * PI / 1440.0, ulp);
    ck_assert_str_eq(e.where.file, "stations.tle");
    ck_assert_int_eq(e.where.line, 2);
}
END_TEST

START_TEST(test_tle_parse_reads_signs_and_exponents)
{
    const char *line1 = "1 21897U 92011A   06176.02341244 -.00001273 +12345-6 -13525+1 0  3044";
    const tle e = parse(
        line1, "2 21897  62.1749 198.0096 7421690 253.0462  20.1561  2.01269994104880", false);
    assert_near(e.mean_motion_dot, -0.00001273, 0.0);
    assert_rel(e.bstar, -1.3525, 1e-15);
    assert_near(e.eccentricity, 0.7421690, 0.0);
}
END_TEST

START_TEST(test_tle_parse_takes_blanks_for_leading_zeros)
{
    /* as punch-card era sets are written: blanks in number, year, day, exponent and eccentricity */
    const tle e =
        parse("1     5U 58002B    7  9.78495062  .00000023  00000 0     98-4      3",
              "2     5   4.2682   8.7242    9667   1.7664    .3264  0.82419157     ", false);
    ck_assert_int_eq(e.number, 5);
    assert_near(e.epoch_jd[0], 2454109.5, 0.0); /* 9 January 2007, 0h */
    assert_near(e.epoch_jd[1], 0.78495062, 0.0);
    assert_near(e.bstar, 0.00098e-4, 0.0);
    assert_near(e.eccentricity, 0.0009667, 0.0);
    assert_rel(e.mean_anomaly, 0.3264 * PI / 180.0, 1e-15);
    assert_rel(e.inclination, 4.2682 * PI / 180.0, 1e-15);
    assert_rel(e.mean_motion, 0.82419157 * 2.0 * PI / 1440.0, 1e-15);
}
END_TEST

START_TEST(test_tle_parse_takes_line_ends_and_blanks_behind)
{
    char line1[LINE_ROOM], line2[LINE_ROOM];
    snprintf(line1, sizeof line1, "%s\r\n", iss1);
    snprintf(line2, sizeof line2, "%s  \t \r\nrest of the file", iss2);
    ck_assert_int_eq(parse(line1, line2, true).number, 25544);
}
END_TEST

/* Years 57 to 99 are of the 20th century: Julian days of 1 January, 0h. */
START_TEST(test_tle_parse_reads_years_from_1957_to_2056)
{
    static const struct {
        const char *year;
        double jd;
    } cases[] = {{"57", 2435839.5},
                 {"99", 2451179.5},
                 {"00", 2451544.5},
                 {"24", 2460310.5},
                 {"56", 2471998.5}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const char *line1 = with(with(iss1, 19, cases[k].year), 21, "001.00000000");
        const tle e = parse(line1, iss2, false);
        assert_near(e.epoch_jd[0], cases[k].jd, 0.0);
        assert_near(e.epoch_jd[1], 0.0, 0.0);
    }
}
END_TEST

/* Real sets count on past the end of the year: day 366 of 2019 is 1 January 2020. */
START_TEST(test_tle_parse_counts_days_into_the_next_year)
{
    const tle e = parse(with(iss1, 19, "19366.82137887"), iss2, false);
    assert_near(e.epoch_jd[0], 2458849.5, 0.0);
    assert_near(e.epoch_jd[1], 0.82137887, 0.0);
}
END_TEST

START_TEST(test_tle_parse_keeps_every_decimal_of_the_epoch)
{
    const tle e = parse(with(iss1, 21, "206.99999999"), iss2, false);
    assert_near(e.epoch_jd[0], 2460881.5, 0.0);
    assert_near(e.epoch_jd[1], 0.99999999, 0.0);
}
END_TEST

/* On a day that ends in a leap second, half a day of an element set is 43 200 s, too. */
START_TEST(test_tle_parse_counts_seconds_on_the_day_of_a_leap_second)
{
    const tle e = parse(with(iss1, 19, "16366.50000000"), iss2, false);
    assert_near(e.epoch_jd[0], 2457753.5, 0.0); /* 31 December 2016, 0h */
    assert_near(e.epoch_jd[1], 43200.0 / 86401.0, 1e-16);
}
END_TEST

/* Alpha-5 numbers with their values, as Space-Track documents them. */
static const struct {
    const char *text;
    int number;
} alpha5[] = {{"A0000", 100000}, {"E8493", 148493}, {"J2931", 182931}, {"P4018", 234018},
              {"W1928", 301928}, {"Z9999", 339999}, {"00005", 5},      {"    5", 5},
              {"99999", 99999},  {"H0000", 170000}, {"N0001", 220001}, {"Q0000", 240000}};

START_TEST(test_tle_number_read_decodes_alpha5)
{
    int number = -1;
    ck_assert(tle_number_read(alpha5[_i].text, &number));
    ck_assert_int_eq(number, alpha5[_i].number);
    const tle e = parse(with(iss1, 3, alpha5[_i].text), with(iss2, 3, alpha5[_i].text), false);
    ck_assert_int_eq(e.number, alpha5[_i].number);
}
END_TEST

START_TEST(test_tle_number_read_refuses_what_is_no_number)
{
    static const char *const bad[] = {"",      "     ", "I0000", "O1234", "a0000",
                                      "A000",  "A 123", "12 45", "1234",  "1234 ",
                                      "-1234", "AA123", "1A234", "12.45"};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        int number = 77;
        ck_assert_msg(!tle_number_read(bad[k], &number), "'%s' was read as %d", bad[k], number);
        ck_assert_int_eq(number, 77);
    }
}
END_TEST

/* ------------------------------------------------------------ refusals */

START_TEST(test_tle_parse_refuses_lines_cut_at_any_byte)
{
    char cut[LINE_ROOM];
    for (int n = 0; n < 69; n++) {
        snprintf(cut, sizeof cut, "%.*s", n, iss1);
        assert_refused(cut, iss2, true, 2, n + 1, "cut short");
        if (n < 68) assert_refused(cut, iss2, false, 2, n + 1, "cut short");
        snprintf(cut, sizeof cut, "%.*s", n, iss2);
        assert_refused(iss1, cut, true, 3, n + 1, "cut short");
        if (n < 68) assert_refused(iss1, cut, false, 3, n + 1, "cut short");
        snprintf(cut, sizeof cut, "%.*s\n%s", n, iss2, iss2); /* the next line does not help */
        assert_refused(iss1, cut, true, 3, n + 1, "cut short");
    }
    snprintf(cut, sizeof cut, "%.68s", iss2);
    ck_assert_int_eq(parse(iss1, cut, false).number, 25544);
}
END_TEST

/* The sum modulo 10 finds every digit that is changed. */
START_TEST(test_tle_parse_refuses_any_changed_digit)
{
    for (int line = 1; line <= 2; line++)
        for (int column = 1; column <= 69; column++) {
            const char *from = line == 1 ? iss1 : iss2;
            const char c = from[column - 1];
            if (c < '0' || c > '9') continue;
            for (char d = '0'; d <= '9'; d++) {
                if (d == c) continue;
                const char *changed = with(from, column, (char[]){d, '\0'});
                ck_assert_int_eq(tle_parse(line == 1 ? changed : iss1, line == 2 ? changed : iss2,
                                           true, somewhere, NULL, &(tle){0}, NULL),
                                 GLINT_INPUT);
            }
        }
}
END_TEST

START_TEST(test_tle_parse_names_found_and_expected_checksum)
{
    assert_refused(with(iss1, 69, "3"), iss2, true, 2, 69, "is '3'; its characters give 9");
    assert_refused(iss1, with(iss2, 69, "x"), true, 3, 69, "is 'x'; its characters give 5");
    ck_assert_int_eq(parse(with(iss1, 69, "3"), iss2, false).number, 25544);
}
END_TEST

/* A letter in any column but those of the international designator, which may hold any text. */
START_TEST(test_tle_parse_refuses_a_letter_in_any_column)
{
    for (int column = 1; column <= 68; column++) {
        tle out;
        if (column < 10 || column > 17)
            ck_assert_msg(tle_parse(with(iss1, column, "x"), iss2, false, somewhere, NULL, &out,
                                    NULL) == GLINT_INPUT,
                          "line 1, column %d", column);
        ck_assert_msg(tle_parse(iss1, with(iss2, column, "x"), false, somewhere, NULL, &out,
                                NULL) == GLINT_INPUT,
                      "line 2, column %d", column);
    }
}
END_TEST

/* A line that lost or gained a character early is shifted in all later columns. */
START_TEST(test_tle_parse_refuses_shifted_lines)
{
    char shifted[LINE_ROOM];
    /* up to the mean motion's point: behind it a digit too few cannot be told without checksum */
    for (int column = 2; column <= 55; column++) {
        tle out;
        snprintf(shifted, sizeof shifted, "%.*s%s0", column - 1, iss1, iss1 + column);
        ck_assert_int_eq(tle_parse(shifted, iss2, false, somewhere, NULL, &out, NULL), GLINT_INPUT);
        snprintf(shifted, sizeof shifted, "%.*s%s0", column - 1, iss2, iss2 + column);
        ck_assert_int_eq(tle_parse(iss1, shifted, false, somewhere, NULL, &out, NULL), GLINT_INPUT);
        snprintf(shifted, sizeof shifted, "%.*s0%s", column - 1, iss2, iss2 + column - 1);
        ck_assert_int_eq(tle_parse(iss1, shifted, false, somewhere, NULL, &out, NULL), GLINT_INPUT);
    }
}
END_TEST

/* Changes of single fields, where they are reported, and a word of the message. */
static const struct {
    int line, column;
    const char *text;
    int reported_column;
    const char *word;
} bad_fields[] = {
    {1, 1, "2", 1, "begins with '2 '"},
    {2, 1, "1", 1, "begins with '1 '"},
    {1, 3, "I5544", 3, "Alpha-5"},
    {2, 3, "25545", 3, "satellite 25545 and line 1 of 25544"},
    {1, 8, "5", 8, "classification"},
    {1, 9, "x", 9, "column 9 of line 1 is 'x'; expected a blank"},
    {1, 19, "  ", 19, "epoch year (columns 19 to 20 of line 1) is blank"},
    {1, 21, "000.50000000", 21, "at least 1 and below 367"},
    {1, 21, "367.00000000", 21, "at least 1 and below 367"},
    {1, 21, "20616725053 ", 21, "no decimal point in its column"},
    {1, 34, "          ", 34, "is blank"},
    {1, 45, " 0000e+0", 45, "something else than digits"},
    {1, 54, " 21923x3", 54, "drag term B*"},
    {1, 54, " 21923-3", 54, NULL},
    {1, 54, "  1923- ", 54, "drag term B*"},
    {1, 54, "        ", 54, "is blank"},
    {1, 63, "4", 63, "SGP4-XP"},
    {1, 63, "1", 63, "ephemeris type '1'"},
    {1, 63, "x", 63, "ephemeris type 'x'"},
    {1, 65, "99 9", 65, "element set number"},
    {2, 9, "180.0001", 9, "inclination is 180.0001"},
    {2, 9, "180.0000", 9, NULL},
    {2, 9, " -1.6348", 9, "inclination is -1.6348"},
    {2, 9, " 51.634 ", 9, "fills its columns"},
    {2, 9, "        ", 9, "inclination (columns 9 to 16 of line 2) is blank"},
    {2, 18, "360.0001", 18, "right ascension of the node is 360.0001"},
    {2, 18, "360.0000", 18, NULL},
    {2, 27, "00020 6", 27, "does not consist of digits"},
    {2, 27, "       ", 27, "eccentricity (columns 27 to 33 of line 2) is blank"},
    {2, 35, "1140.852", 35, "argument of perigee"},
    {2, 44, "400.0352", 44, "mean anomaly is 400.0352"},
    {2, 53, " 0.00000000", 53, "mean motion is 0"},
    {2, 53, "  .00000001", 53, NULL},
    {2, 53, "-5.50079803", 53, "mean motion is -5.5"},
    {2, 64, "52x05", 64, "revolution number"},
    {2, 64, "     ", 64, NULL},
};

START_TEST(test_tle_parse_places_errors_on_the_field)
{
    const char *line1 = iss1, *line2 = iss2;
    if (bad_fields[_i].line == 1)
        line1 = with(iss1, bad_fields[_i].column, bad_fields[_i].text);
    else
        line2 = with(iss2, bad_fields[_i].column, bad_fields[_i].text);
    if (!bad_fields[_i].word) /* still in order */
        ck_assert_int_eq(parse(line1, line2, false).number, 25544);
    else
        assert_refused(line1, line2, false, bad_fields[_i].line + 1, bad_fields[_i].reported_column,
                       bad_fields[_i].word);
}
END_TEST

START_TEST(test_tle_parse_refuses_text_after_the_checksum)
{
    char longer[LINE_ROOM];
    snprintf(longer, sizeof longer, "%s  0.0  1440.0", iss2);
    assert_refused(iss1, longer, true, 3, 72, "goes on after its checksum");
    ck_assert_int_eq(parse(iss1, longer, false).number, 25544);
}
END_TEST

START_TEST(test_tle_parse_places_errors_where_the_lines_were_given)
{
    const place first = {"run.toml", 12, 15}, second = {"run.toml", 12, 90};
    glint_error error;
    tle out;
    ck_assert_int_eq(tle_parse(with(iss1, 63, "4"), iss2, false, first, &second, &out, &error),
                     GLINT_INPUT);
    ck_assert_int_eq(error.line, 12);
    ck_assert_int_eq(error.column, 15 + 62);
    ck_assert_int_eq(tle_parse(iss1, with(iss2, 9, "x"), false, first, &second, &out, &error),
                     GLINT_INPUT);
    ck_assert_int_eq(error.line, 12);
    ck_assert_int_eq(error.column, 90 + 8);
}
END_TEST

/* The public verification set: checksums are wrong in places, on purpose; nothing else is. */
START_TEST(test_tle_parse_reads_the_verification_set_without_checksums)
{
    char line1[2 * LINE_ROOM], line2[2 * LINE_ROOM];
    FILE *file = fopen(path_in(TEST_DATA_DIR, "sgp4_verification.tle"), "r");
    ck_assert_ptr_nonnull(file);
    int sets = 0, wrong_sums = 0;
    while (fgets(line1, sizeof line1, file)) {
        if (line1[0] == '#') continue;
        ck_assert_ptr_nonnull(fgets(line2, sizeof line2, file));
        parse(line1, line2, false);
        wrong_sums += tle_parse(line1, line2, true, somewhere, NULL, &(tle){0}, NULL) != GLINT_OK;
        sets++;
    }
    fclose(file);
    ck_assert_int_eq(sets, 26);
    ck_assert_int_gt(wrong_sums, 0);
}
END_TEST

/* ------------------------------------------------------------ files */

/* A file of that content in the folder for temporary files, removed by forget_file. */
static char temporary[64];

static const char *file_of(const char *content, size_t n)
{
    snprintf(temporary, sizeof temporary, "/tmp/glint-tle-XXXXXX");
    const int descriptor = mkstemp(temporary);
    ck_assert_int_ge(descriptor, 0);
    ck_assert_int_eq(write(descriptor, content, n), (ssize_t)n);
    close(descriptor);
    return temporary;
}

static void forget_file(void)
{
    unlink(temporary);
}

/* What to choose, and the set whose epoch is nearest to a moment (UTC quasi-JD), the earlier one on
 * a tie. */
typedef struct near_query {
    const char *name;
    int number;
    double near_jd[2];
} near_query;

static glint_status choose_near(const char *path, place asked_from, const near_query *query,
                                tle *out, glint_error *error)
{
    const tle_query wanted = {.name = query->name, .number = query->number};
    tle_list list;
    glint_errors *errors = glint_errors_new();
    const glint_status status = tle_file_read(path, asked_from, &wanted, &list, errors);
    if (status && error) *error = *glint_errors_get(errors, 0);
    double least = INFINITY;
    for (size_t k = 0; k < list.n; k++) {
        const double *jd = list.sets[k].epoch_jd;
        const double days = fabs((jd[0] - query->near_jd[0]) + (jd[1] - query->near_jd[1]));
        if (days >= least) continue;
        least = days;
        *out = list.sets[k];
    }
    ck_assert_msg(status || list.n > 0, "no set and no error");
    tle_list_free(&list);
    glint_errors_free(errors);
    return status;
}

static glint_status choose_from(const char *content, const near_query *query, tle *out,
                                glint_error *error)
{
    memset(error, 0, sizeof *error);
    const glint_status status =
        choose_near(file_of(content, strlen(content)), PLACE_NONE, query, out, error);
    forget_file();
    return status;
}

static void assert_choice_refused(const char *content, const near_query *query, int line,
                                  const char *word)
{
    tle out;
    glint_error error;
    ck_assert_int_eq(choose_from(content, query, &out, &error), GLINT_INPUT);
    ck_assert_msg(strstr(error.message, word) != NULL, "'%s' is not in: %s", word, error.message);
    ck_assert_msg(error.line == line, "line %d instead of %d: %s", error.line, line, error.message);
}

static const near_query any = {NULL, 0, {2460881.5, 0.0}};

/* From the file beside the tests. */
static glint_status choose_here(const char *name, int number, double near_jd, tle *out,
                                glint_error *error)
{
    const near_query query = {name, number, {near_jd, 0.0}};
    return choose_near(path_in(TEST_DATA_DIR, "elements.3le"), (place){"run.toml", 9, 7}, &query,
                       out, error);
}

START_TEST(test_tle_file_read_finds_by_name)
{
    static const struct {
        const char *name;
        int number, line;
    } cases[] = {
        {"MADE-UP GEO", 41866, 8}, {"made-up molniya", 99901, 11}, {"  ISS (zarya) ", 25544, 4}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        tle out;
        glint_error error;
        ck_assert_int_eq(choose_here(cases[k].name, 0, 2460881.5, &out, &error), GLINT_OK);
        ck_assert_int_eq(out.number, cases[k].number);
        ck_assert_int_eq(out.where.line, cases[k].line);
    }
}
END_TEST

START_TEST(test_tle_file_read_finds_by_number_and_keeps_the_name)
{
    tle out;
    glint_error error;
    ck_assert_int_eq(choose_here(NULL, 41866, 2460881.5, &out, &error), GLINT_OK);
    ck_assert_str_eq(out.name, "MADE-UP GEO");
    assert_rel(out.inclination, 0.03 * PI / 180.0, 1e-15);
    ck_assert_int_eq(choose_here("ISS (ZARYA)", 25544, 2460881.5, &out, &error), GLINT_OK);
    ck_assert_int_eq(choose_here("ISS (ZARYA)", 41866, 2460881.5, &out, &error), GLINT_INPUT);
}
END_TEST

/* The file holds the ISS at 25, 26 and 28 July 2025, each at 0.16725053 d. */
START_TEST(test_tle_file_read_takes_the_nearest_epoch)
{
    static const struct {
        double near_jd, epoch_jd;
    } cases[] = {{2460000.5, 2460881.5}, {2460881.6, 2460881.5}, {2460882.5, 2460882.5},
                 {2460883.5, 2460882.5}, {2460884.5, 2460884.5}, {2461000.5, 2460884.5}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        tle out;
        glint_error error;
        ck_assert_int_eq(choose_here(NULL, 25544, cases[k].near_jd, &out, &error), GLINT_OK);
        assert_near(out.epoch_jd[0], cases[k].epoch_jd, 0.0);
    }
}
END_TEST

START_TEST(test_tle_file_read_takes_the_earlier_epoch_on_a_tie)
{
    tle out;
    glint_error error;
    const near_query half_way = {NULL, 25544, {2460882.0, 0.16725053}}; /* between 25 and 26 July */
    ck_assert_int_eq(
        choose_near(path_in(TEST_DATA_DIR, "elements.3le"), PLACE_NONE, &half_way, &out, &error),
        GLINT_OK);
    assert_near(out.epoch_jd[0], 2460881.5, 0.0);
}
END_TEST

START_TEST(test_tle_file_read_reads_files_without_names)
{
    char content[512];
    tle out;
    glint_error error;
    snprintf(content, sizeof content, "%s\r\n%s\r\n", iss1, iss2);
    ck_assert_int_eq(choose_from(content, &any, &out, &error), GLINT_OK);
    ck_assert_str_eq(out.name, "");
    ck_assert_int_eq(out.number, 25544);
    snprintf(content, sizeof content, "%s\n%s", iss1, iss2); /* no line end at the end */
    ck_assert_int_eq(choose_from(content, &any, &out, &error), GLINT_OK);
    snprintf(content, sizeof content, "\xEF\xBB\xBF%s\n%s\n", iss1, iss2); /* byte order mark */
    ck_assert_int_eq(choose_from(content, &any, &out, &error), GLINT_OK);
}
END_TEST

START_TEST(test_tle_file_read_shortens_long_names)
{
    char content[512];
    tle out;
    glint_error error;
    const char *name = "A NAME OF MORE THAN SIXTY-THREE CHARACTERS, WHICH NO CATALOGUE HAS";
    snprintf(content, sizeof content, "%s\n%s\n%s\n", name, iss1, iss2);
    const near_query query = {name, 0, {2460881.5, 0.0}};
    ck_assert_int_eq(choose_from(content, &query, &out, &error), GLINT_OK);
    ck_assert_uint_eq(strlen(out.name), 63);
    ck_assert_int_eq(strncmp(out.name, name, 63), 0);
}
END_TEST

START_TEST(test_tle_file_read_suggests_the_nearest_name)
{
    tle out;
    glint_error error;
    ck_assert_int_eq(choose_here("MADE-UP MOLNYIA", 0, 2460881.5, &out, &error), GLINT_INPUT);
    ck_assert_msg(strstr(error.message, "did you mean 'MADE-UP MOLNIYA'"), "%s", error.message);
    ck_assert_str_eq(error.file, "run.toml");
    ck_assert_int_eq(error.line, 9);
    ck_assert_int_eq(choose_here("iss", 0, 2460881.5, &out, &error), GLINT_INPUT);
    ck_assert_msg(strstr(error.message, "did you mean 'ISS (ZARYA)'"), "%s", error.message);
    ck_assert_int_eq(choose_here("HUBBLE", 0, 2460881.5, &out, &error), GLINT_INPUT);
    ck_assert_msg(strstr(error.message, "it has ISS (ZARYA) (25544), MADE-UP GEO (41866)"), "%s",
                  error.message);
    ck_assert_int_eq(choose_here(NULL, 20580, 2460881.5, &out, &error), GLINT_INPUT);
    ck_assert_msg(strstr(error.message, "number 20580; it has ISS"), "%s", error.message);
}
END_TEST

START_TEST(test_tle_file_read_names_the_satellites_when_several_fit)
{
    tle out;
    glint_error error;
    ck_assert_int_eq(choose_here(NULL, 0, 2460881.5, &out, &error), GLINT_INPUT);
    ck_assert_msg(strstr(error.message, "ISS (ZARYA) (25544), MADE-UP GEO (41866), MADE-UP "
                                        "MOLNIYA (99901); say which one by its name, number or "
                                        "designator"),
                  "%s", error.message);
}
END_TEST

START_TEST(test_tle_file_read_names_five_satellites_at_most)
{
    char content[2048] = "", number[16];
    for (int k = 0; k < 7; k++) {
        snprintf(number, sizeof number, "4000%d", k);
        strcat(strcat(content, with(iss1, 3, number)), "\n");
        strcat(strcat(content, with(iss2, 3, number)), "\n");
    }
    assert_choice_refused(content, &any, 0, ": 40000, 40001, 40002, 40003, 40004 and others;");
}
END_TEST

START_TEST(test_tle_file_read_asks_for_the_number_where_a_name_stands_twice)
{
    char content[1024];
    snprintf(content, sizeof content, "OBJECT A\n%s\n%s\nOBJECT A\n%s\n%s\n", iss1, iss2,
             with(with(iss1, 3, "25545"), 69, "0"), with(with(iss2, 3, "25545"), 69, "6"));
    const near_query by_name = {"object a", 0, {2460881.5, 0.0}};
    assert_choice_refused(content, &by_name, 0, "say which one by its number");
    const near_query by_number = {"object a", 25545, {2460881.5, 0.0}};
    tle out;
    glint_error error;
    ck_assert_int_eq(choose_from(content, &by_number, &out, &error), GLINT_OK);
    ck_assert_int_eq(out.where.line, 5);
}
END_TEST

/* A file that ends within a set is refused, wherever it ends. */
START_TEST(test_tle_file_read_refuses_files_cut_at_any_byte)
{
    char whole[512];
    const int size = snprintf(whole, sizeof whole, "0 ISS (ZARYA)\n%s\n%s\n", iss1, iss2);
    static const near_query queries[] = {{NULL, 0, {2460881.5, 0.0}},
                                         {"ISS (ZARYA)", 0, {2460881.5, 0.0}},
                                         {NULL, 25544, {2460881.5, 0.0}}};
    for (int n = 0; n < size; n++)
        for (int q = 0; q < 3; q++) {
            tle out;
            glint_error error = {0};
            const glint_status status =
                choose_near(file_of(whole, (size_t)n), PLACE_NONE, &queries[q], &out, &error);
            forget_file();
            /* without the last line end the set is still whole */
            ck_assert_msg((status == GLINT_OK) == (n >= size - 1), "cut to %d bytes", n);
            if (status)
                ck_assert_msg(strstr(error.message, "expected") || strstr(error.message, "cut"),
                              "%s", error.message);
        }
}
END_TEST

START_TEST(test_tle_file_read_places_errors_of_the_set)
{
    char content[1024];
    snprintf(content, sizeof content, "# comment\n0 ISS\n%s\n%s\n", iss1, with(iss2, 69, "7"));
    assert_choice_refused(content, &any, 4, "checksum of line 2");
    snprintf(content, sizeof content, "0 ISS\n%s\n\n0 HST\n", iss1);
    assert_choice_refused(content, &any, 2, "without its line 2");
    snprintf(content, sizeof content, "%s\n%s\n%s\n", iss1, iss2, iss2);
    assert_choice_refused(content, &any, 3, "without its line 1");
    snprintf(content, sizeof content, "0 ISS\n%s\n%s\n", with(with(iss1, 3, "2554x"), 69, "5"),
             iss2);
    assert_choice_refused(content, &any, 2, "catalogue number");
}
END_TEST

/* Faults in the sets of other satellites do not matter. */
START_TEST(test_tle_file_read_ignores_faults_in_other_sets)
{
    char content[1024];
    tle out;
    glint_error error;
    const near_query query = {"HST", 0, {2460881.5, 0.0}};
    snprintf(content, sizeof content, "0 ISS\n%s\n%s\n0 HST\n%s\n%s\n", with(iss1, 63, "4"),
             with(iss2, 9, "xxx"), iss1, iss2);
    ck_assert_int_eq(choose_from(content, &query, &out, &error), GLINT_OK);
    ck_assert_str_eq(out.name, "HST");
}
END_TEST

START_TEST(test_tle_file_read_refuses_what_is_no_file_of_element_sets)
{
    tle out;
    glint_error error = {0};
    static const char with_nul[] = "1 25\0"
                                   "544";
    assert_choice_refused("", &any, 0, "no element set");
    assert_choice_refused("ISS\nHST\n", &any, 0, "no element set");
    ck_assert_int_eq(
        choose_near(file_of(with_nul, sizeof with_nul), PLACE_NONE, &any, &out, &error),
        GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "not a text file"));
    forget_file();
    ck_assert_int_eq(choose_near("/nonexistent/file.tle", PLACE_NONE, &any, &out, &error),
                     GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "cannot open"));
    ck_assert_int_eq(choose_near("/tmp", PLACE_NONE, &any, &out, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "directory"));
}
END_TEST

/* Files that others wrote. */
START_TEST(test_tle_file_read_reads_samples)
{
    const char *dir = reference_dir("element sets in samples/");
    if (!dir) return;
    static const struct {
        const char *file;
        int number;
        const char *name;
    } cases[] = {{"samples/real.3le", 8820, "LAGEOS 1"},
                 {"samples/real.3le", 61247, "STARLINK-11305 [DTC]"},
                 {"samples/synthetic.3le", 99901, "SYNTH MOLNIYA"},
                 {"samples/synthetic_2le_crlf.tle", 41866, ""}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        tle out;
        glint_error error;
        const near_query query = {NULL, cases[k].number, {2460881.5, 0.0}};
        const glint_status status =
            choose_near(path_in(dir, cases[k].file), PLACE_NONE, &query, &out, &error);
        ck_assert_msg(status == GLINT_OK, "%s: %s", cases[k].file, error.message);
        ck_assert_str_eq(out.name, cases[k].name);
    }
}
END_TEST

static TCase *value_tests(void)
{
    TCase *values = tcase_create("values");
    tcase_add_test(values, test_tle_parse_reads_all_elements);
    tcase_add_test(values, test_tle_parse_reads_signs_and_exponents);
    tcase_add_test(values, test_tle_parse_takes_blanks_for_leading_zeros);
    tcase_add_test(values, test_tle_parse_takes_line_ends_and_blanks_behind);
    tcase_add_test(values, test_tle_parse_reads_years_from_1957_to_2056);
    tcase_add_test(values, test_tle_parse_counts_days_into_the_next_year);
    tcase_add_test(values, test_tle_parse_keeps_every_decimal_of_the_epoch);
    tcase_add_test(values, test_tle_parse_counts_seconds_on_the_day_of_a_leap_second);
    tcase_add_loop_test(values, test_tle_number_read_decodes_alpha5, 0,
                        sizeof alpha5 / sizeof *alpha5);
    tcase_add_test(values, test_tle_number_read_refuses_what_is_no_number);
    return values;
}

static TCase *refusal_tests(void)
{
    TCase *refusals = tcase_create("refusals");
    tcase_add_test(refusals, test_tle_parse_refuses_lines_cut_at_any_byte);
    tcase_add_test(refusals, test_tle_parse_refuses_any_changed_digit);
    tcase_add_test(refusals, test_tle_parse_names_found_and_expected_checksum);
    tcase_add_test(refusals, test_tle_parse_refuses_a_letter_in_any_column);
    tcase_add_test(refusals, test_tle_parse_refuses_shifted_lines);
    tcase_add_loop_test(refusals, test_tle_parse_places_errors_on_the_field, 0,
                        sizeof bad_fields / sizeof *bad_fields);
    tcase_add_test(refusals, test_tle_parse_refuses_text_after_the_checksum);
    tcase_add_test(refusals, test_tle_parse_places_errors_where_the_lines_were_given);
    tcase_add_test(refusals, test_tle_parse_reads_the_verification_set_without_checksums);
    return refusals;
}

static TCase *file_tests(void)
{
    TCase *files = tcase_create("files");
    tcase_add_test(files, test_tle_file_read_finds_by_name);
    tcase_add_test(files, test_tle_file_read_finds_by_number_and_keeps_the_name);
    tcase_add_test(files, test_tle_file_read_takes_the_nearest_epoch);
    tcase_add_test(files, test_tle_file_read_takes_the_earlier_epoch_on_a_tie);
    tcase_add_test(files, test_tle_file_read_reads_files_without_names);
    tcase_add_test(files, test_tle_file_read_shortens_long_names);
    tcase_add_test(files, test_tle_file_read_suggests_the_nearest_name);
    tcase_add_test(files, test_tle_file_read_names_the_satellites_when_several_fit);
    tcase_add_test(files, test_tle_file_read_names_five_satellites_at_most);
    tcase_add_test(files, test_tle_file_read_asks_for_the_number_where_a_name_stands_twice);
    tcase_add_test(files, test_tle_file_read_refuses_files_cut_at_any_byte);
    tcase_add_test(files, test_tle_file_read_places_errors_of_the_set);
    tcase_add_test(files, test_tle_file_read_ignores_faults_in_other_sets);
    tcase_add_test(files, test_tle_file_read_refuses_what_is_no_file_of_element_sets);
    tcase_add_test(files, test_tle_file_read_reads_samples);
    return files;
}

int main(void)
{
    Suite *suite = suite_create("tle");
    suite_add_tcase(suite, value_tests());
    suite_add_tcase(suite, refusal_tests());
    suite_add_tcase(suite, file_tests());
    return run_suite(suite);
}
