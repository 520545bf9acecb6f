/* test_base.c: the error list, texts, growing arrays, numbers, names, paths, whole files and
 * parameter ranges. */
#include "testing.h"

#include "base/error.h"
#include "base/grow.h"
#include "base/param.h"
#include "base/random.h"
#include "base/sorted.h"
#include "base/text.h"

#include <float.h>
#include <limits.h>
#include <stdint.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---------------------------------------------------------------- errors */

static const place SOMEWHERE = {"a.toml", 3, 7};

START_TEST(test_errors_keeps_order_and_places_of_many)
{
    enum { N = 1000 };
    glint_errors *errors = glint_errors_new();
    ck_assert_ptr_nonnull(errors);
    ck_assert_uint_eq(glint_errors_count(errors), 0);
    for (int k = 0; k < N; k++)
        ck_assert_int_eq(
            errors_add(errors, GLINT_INPUT, (place){"a.toml", k + 1, 2}, "number %d", k),
            GLINT_INPUT);
    ck_assert_uint_eq(glint_errors_count(errors), N);
    ck_assert_uint_eq(glint_errors_error_count(errors), N);
    for (int k = 0; k < N; k++) {
        char message[32];
        snprintf(message, sizeof message, "number %d", k);
        const glint_error *error = glint_errors_get(errors, (size_t)k);
        ck_assert_str_eq(error->message, message);
        ck_assert_str_eq(error->file, "a.toml");
        ck_assert_int_eq(error->line, k + 1);
        ck_assert_int_eq(error->column, 2);
        ck_assert_int_eq(error->status, GLINT_INPUT);
        ck_assert_int_eq(error->severity, GLINT_ERROR);
    }
    ck_assert_ptr_null(glint_errors_get(errors, N));
    glint_errors_clear(errors);
    ck_assert_uint_eq(glint_errors_count(errors), 0);
    ck_assert_ptr_null(glint_errors_get(errors, 0));
    glint_errors_free(errors);
}
END_TEST

START_TEST(test_errors_counts_warnings_apart)
{
    glint_errors *errors = glint_errors_new();
    errors_warn(errors, SOMEWHERE, "old element set");
    ck_assert_uint_eq(glint_errors_count(errors), 1);
    ck_assert_uint_eq(glint_errors_error_count(errors), 0);
    ck_assert_int_eq(glint_errors_get(errors, 0)->severity, GLINT_WARNING);
    ck_assert_int_eq(glint_errors_get(errors, 0)->status, GLINT_OK);
    glint_errors_free(errors);
}
END_TEST

START_TEST(test_errors_take_fills_in_a_missing_place_only)
{
    glint_errors *errors = glint_errors_new();
    glint_error nowhere, somewhere;
    ck_assert_int_eq(error_set(&nowhere, GLINT_OUTPUT, PLACE_NONE, "x"), GLINT_OUTPUT);
    ck_assert_int_eq(error_set(&somewhere, GLINT_INPUT, (place){"b", 1, 2}, "y"), GLINT_INPUT);
    ck_assert_int_eq(errors_take(errors, &nowhere, SOMEWHERE), GLINT_OUTPUT);
    ck_assert_int_eq(errors_take(errors, &somewhere, SOMEWHERE), GLINT_INPUT);
    ck_assert_str_eq(glint_errors_get(errors, 0)->file, "a.toml");
    ck_assert_int_eq(glint_errors_get(errors, 0)->line, 3);
    ck_assert_int_eq(glint_errors_get(errors, 0)->column, 7);
    ck_assert_str_eq(glint_errors_get(errors, 1)->file, "b");
    ck_assert_int_eq(glint_errors_get(errors, 1)->line, 1);
    glint_errors_free(errors);
}
END_TEST

START_TEST(test_errors_work_without_a_list)
{
    ck_assert_int_eq(errors_add(NULL, GLINT_INPUT, PLACE_NONE, "x"), GLINT_INPUT);
    errors_warn(NULL, PLACE_NONE, "x");
    ck_assert_int_eq(error_set(NULL, GLINT_OUTPUT, PLACE_NONE, "x"), GLINT_OUTPUT);
    ck_assert_int_eq(error_no_memory(NULL), GLINT_INTERNAL);
    ck_assert_uint_eq(glint_errors_count(NULL), 0);
    ck_assert_uint_eq(glint_errors_error_count(NULL), 0);
    ck_assert_ptr_null(glint_errors_get(NULL, 0));
    glint_errors_clear(NULL);
    glint_errors_free(NULL);
}
END_TEST

START_TEST(test_error_cuts_texts_that_are_too_long_visibly)
{
    char long_text[5000];
    memset(long_text, 'a', sizeof long_text - 1);
    long_text[sizeof long_text - 1] = '\0';
    glint_error error;
    error_set(&error, GLINT_INPUT, (place){long_text, 1, 1}, "%s", long_text);
    ck_assert_uint_eq(strlen(error.file), sizeof error.file - 1);
    ck_assert_str_eq(error.file + sizeof error.file - 5, "a...");
    ck_assert_uint_eq(strlen(error.message), sizeof error.message - 1);
    ck_assert_str_eq(error.message + sizeof error.message - 5, "a...");
}
END_TEST

START_TEST(test_error_keeps_a_text_that_just_fits)
{
    char text_1023[1024];
    memset(text_1023, 'b', sizeof text_1023 - 1);
    text_1023[sizeof text_1023 - 1] = '\0';
    glint_error error;
    error_set(&error, GLINT_INPUT, PLACE_NONE, "%s", text_1023);
    ck_assert_str_eq(error.message, text_1023);
    ck_assert_str_eq(error.file, "");
}
END_TEST

/* ------------------------------------------------------------------ text */

START_TEST(test_text_grows_and_stays_terminated)
{
    text t = {0};
    for (int k = 0; k < 10000; k++) {
        text_printf(&t, "%d,", k % 10);
        ck_assert_uint_eq(t.length, 2 * (size_t)(k + 1));
        ck_assert_int_eq(t.data[t.length], '\0');
    }
    ck_assert(!t.failed);
    for (int k = 0; k < 10000; k++) {
        ck_assert_int_eq(t.data[2 * k], '0' + k % 10);
        ck_assert_int_eq(t.data[2 * k + 1], ',');
    }
    text_clear(&t);
    ck_assert_uint_eq(t.length, 0);
    ck_assert_str_eq(t.data, "");
    text_add(&t, "ab");
    text_char(&t, 'c');
    text_append(&t, "defg", 2);
    text_append(&t, "", 0);
    text_double(&t, 0.5);
    ck_assert_str_eq(t.data, "abcde0.5");
    text_free(&t);
    ck_assert_ptr_null(t.data);
    text_free(&t);
}
END_TEST

START_TEST(test_text_remembers_that_memory_ran_out)
{
    text t = {0};
    text_add(&t, "kept");
    ck_assert(!text_reserve(&t, SIZE_MAX / 2));
    ck_assert(t.failed);
    text_add(&t, "lost");
    text_double(&t, 1);
    ck_assert_str_eq(t.data, "kept");
    text_free(&t);
}
END_TEST

/* --------------------------------------------------------------- numbers */

/* number_format with a terminator. */
static void format(double value, char out[NUMBER_SIZE + 1])
{
    memset(out, '~', NUMBER_SIZE);
    const size_t n = number_format(value, out);
    ck_assert_uint_le(n, NUMBER_SIZE);
    out[n] = '\0';
}

/* Significant digits of a decimal number, trailing zeros left out. */
static int significant_digits(const char *number)
{
    int digits = 0, zeros = 0;
    for (const char *c = number; *c && *c != 'e'; c++) {
        if (*c < '0' || *c > '9' || (*c == '0' && digits == 0)) continue;
        zeros = *c == '0' ? zeros + 1 : 0;
        digits++;
    }
    return digits - zeros;
}

/* Checks that the C library and number_read read the same double from what number_format wrote, and
 * that one digit less would have been another double. */
static void check_number(double value)
{
    char written[NUMBER_SIZE + 1], shorter[64];
    format(value, written);
    double read = -1;
    ck_assert_msg(number_read(written, strlen(written), &read), "%s", written);
    ck_assert_msg(read == value, "%.17g became %s became %.17g", value, written, read);
    ck_assert_msg(strtod(written, NULL) == value, "%.17g became %s", value, written);
    const int digits = significant_digits(written);
    if (digits < 2 || !strpbrk(written, ".e")) return; /* a large integer is written out exactly */
    snprintf(shorter, sizeof shorter, "%.*e", digits - 2, value);
    ck_assert_msg(strtod(shorter, NULL) != value, "%s is longer than %s", written, shorter);
}

START_TEST(test_number_round_trips_at_the_edges)
{
    static const double values[] = {0.0,
                                    1.0,
                                    0.1,
                                    1.0 / 3.0,
                                    DBL_MAX,
                                    DBL_MIN,
                                    DBL_TRUE_MIN,
                                    DBL_EPSILON,
                                    2.2250738585072009e-308, /* the largest denormal */
                                    9007199254740993.0,
                                    123456789012345680.0,
                                    1e21,
                                    1e22,
                                    1e23,
                                    5e-324,
                                    299792458.0,
                                    149597870700.0};
    for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
        check_number(values[k]);
        check_number(-values[k]);
        check_number(nextafter(values[k], 1.0));
    }
}
END_TEST

START_TEST(test_number_round_trips_for_any_bits)
{
    uint64_t state = 20250724;
    for (int k = 0; k < 50000; k++) {
        const uint64_t bits = random_next(&state);
        double value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value)) check_number(value);
    }
}
END_TEST

START_TEST(test_number_round_trips_for_denormals)
{
    uint64_t state = 1;
    for (int k = 0; k < 20000; k++) {
        const uint64_t bits = random_next(&state) & 0x800fffffffffffffu;
        double value;
        memcpy(&value, &bits, sizeof value);
        check_number(value);
    }
}
END_TEST

START_TEST(test_number_writes_plain_values_plainly)
{
    static const struct {
        double value;
        const char *text;
    } cases[] = {{0.0, "0"},   {-0.0, "0"},  {1.0, "1"},     {-2.5, "-2.5"},
                 {0.1, "0.1"}, {100, "100"}, {0.05, "0.05"}, {5.9462449657, "5.9462449657"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char written[NUMBER_SIZE + 1];
        format(cases[k].value, written);
        ck_assert_str_eq(written, cases[k].text);
    }
}
END_TEST

START_TEST(test_number_for_people_has_no_sign_where_it_rounds_to_zero)
{
    static const struct {
        double value;
        int decimals;
        const char *fixed, *with_sign;
    } cases[] = {{0.0, 4, "0.0000", "0.0000"},
                 {-0.0, 4, "0.0000", "0.0000"},
                 {-4.9e-5, 4, "0.0000", "0.0000"},
                 {4.9e-5, 4, "0.0000", "0.0000"},
                 {-5.1e-5, 4, "-0.0001", "-0.0001"},
                 {5.1e-5, 4, "0.0001", "+0.0001"},
                 {-0.3, 0, "0", "0"},
                 {-10.0, 0, "-10", "-10"},
                 {10.0, 2, "10.00", "+10.00"},
                 {-1e-300, 9, "0.000000000", "0.000000000"},
                 {-2.5, 1, "-2.5", "-2.5"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        ck_assert_str_eq(number_fixed(cases[k].value, cases[k].decimals).text, cases[k].fixed);
        ck_assert_str_eq(number_signed(cases[k].value, cases[k].decimals).text, cases[k].with_sign);
    }
    /* the longest */
    ck_assert_uint_eq(strlen(number_signed(-DBL_MAX, 9).text), 1 + 309 + 1 + 9);
    ck_assert_str_eq(number_signed(HUGE_VAL, 3).text, "+inf");
}
END_TEST

START_TEST(test_number_reads_decimals_as_the_c_library_does)
{
    static const char *const texts[] = {"0",
                                        "-0",
                                        "+1",
                                        "007",
                                        "1.",
                                        ".5",
                                        "-.5",
                                        "1e3",
                                        "1E3",
                                        "1e+3",
                                        "1e-3",
                                        "1.5e0007",
                                        "1e-400",
                                        "-1e-400",
                                        "4e-324",
                                        "2e-324",
                                        "1e308",
                                        "1.7976931348623158e308",
                                        "0.1000000000000000055511151231257827021181583404541015625",
                                        "9007199254740992.99999999999999999999",
                                        "2.2250738585072011e-308"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        double read = -7;
        ck_assert_msg(number_read(texts[k], strlen(texts[k]), &read), "%s", texts[k]);
        ck_assert_msg(read == strtod(texts[k], NULL), "%s became %.17g", texts[k], read);
    }
}
END_TEST

START_TEST(test_number_tells_underflow_from_overflow_of_long_numbers)
{
    /* What stands before and after 400 zeros. */
    static const struct {
        const char *before, *after;
        bool good;
    } cases[] = {{"1", "", false},      {"1", "e-50", false},   {"1", "e-390", true},
                 {"1", "e-800", true},  {"0.", "1", true},      {"0.", "1e50", true},
                 {"0.", "1e390", true}, {"0.", "1e800", false}, {"-1", "e-50", false},
                 {"-0.", "1", true}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char number[512];
        snprintf(number, sizeof number, "%s%0400d%s", cases[k].before, 0, cases[k].after);
        double read = -7;
        ck_assert_msg(number_read(number, strlen(number), &read) == cases[k].good, "%s...%s",
                      cases[k].before, cases[k].after);
        if (cases[k].good)
            ck_assert_msg(read == strtod(number, NULL), "%s...%s became %g", cases[k].before,
                          cases[k].after, read);
    }
}
END_TEST

START_TEST(test_number_refuses_what_is_no_decimal_number)
{
    static const char *const texts[] = {
        "",      "+",      "-",     "+-1",   "--1", "++1",  "-+1",      " 1",
        "1 ",    ".",      "-.",    "e5",    ".e5", "1e",   "1e+",      "1,5",
        "1.2.3", "0x10",   "0x1p3", "inf",   "nan", "-inf", "NaN",      "INF",
        "1e309", "-1e309", "1d3",   "1_000", "one", "1;",   "\xc2\xb2", "infinity"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        double read = -7;
        ck_assert_msg(!number_read(texts[k], strlen(texts[k]), &read), "'%s' was read as %g",
                      texts[k], read);
    }
}
END_TEST

START_TEST(test_number_reads_no_further_than_told)
{
    double read = 0;
    ck_assert(number_read("12345", 3, &read));
    assert_near(read, 123, 0);
    ck_assert(!number_read("1e5", 2, &read));
    ck_assert(!number_read("1", 0, &read));
    ck_assert(!number_read("1\0002", 3, &read));
}
END_TEST

/* ----------------------------------------------------------------- names */

START_TEST(test_nearest_name_finds_slips)
{
    static const char *const names[] = {"start", "end", "step_s", "duration_s", "rho_d", "xy"};
    static const struct {
        const char *wanted, *nearest;
    } cases[] = {
        {"strat", "start"},          {"START", "start"}, {"ned", "end"},     {"steps_s", "step_s"},
        {"durations", "duration_s"}, {"rho_s", "rho_d"}, {"x", "xy"},        {"", NULL},
        {"wavelength_um", NULL},     {"zzz", NULL},      {"start", "start"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const char *found = nearest_name(cases[k].wanted, names, 6);
        if (cases[k].nearest) {
            ck_assert_msg(found, "nothing for '%s'", cases[k].wanted);
            ck_assert_str_eq(found, cases[k].nearest);
        } else {
            ck_assert_msg(!found, "'%s' for '%s'", found, cases[k].wanted);
        }
    }
    ck_assert_ptr_null(nearest_name("start", names, 0));
}
END_TEST

START_TEST(test_nearest_name_stands_very_long_names)
{
    char a[1000], b[64], c[65];
    memset(a, 'a', sizeof a), memset(b, 'b', sizeof b), memset(c, 'b', sizeof c);
    a[sizeof a - 1] = b[sizeof b - 1] = c[sizeof c - 1] = '\0';
    const char *const names[] = {a, b, c};
    ck_assert_ptr_null(nearest_name(a, names, 3));
    ck_assert_ptr_eq(nearest_name(b, names, 3), b);
    ck_assert_ptr_null(nearest_name("start", names, 3));
}
END_TEST

START_TEST(test_path_beside_joins_folder_and_name)
{
    static const struct {
        const char *from, *path, *joined;
    } cases[] = {
        {"a/b.toml", "c.tle", "a/c.tle"},
        {"b.toml", "c.tle", "c.tle"},
        {"/x/y/b.toml", "../c", "/x/y/../c"},
        {"a/b.toml", "/c", "/c"},
        {"/b.toml", "c", "/c"},
        {NULL, "c", "c"},
        {"a/b.toml", "", "a/"},
        {"./b.toml", "sub/../c", "./sub/../c"}, /* there is no folder 'sub' to go through */
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char *joined = path_beside(cases[k].from, cases[k].path);
        ck_assert_str_eq(joined, cases[k].joined);
        free(joined);
    }
}
END_TEST

/* A path is shortened where folders show that it may be, and not behind a link. */
START_TEST(test_path_beside_leaves_out_ways_back)
{
    char folder[] = "/tmp/glint-path-XXXXXX", from[64], expected[64];
    ck_assert_ptr_nonnull(mkdtemp(folder));
    ck_assert_int_eq(chdir(folder), 0);
    ck_assert_int_eq(mkdir("a", 0700) | mkdir("a/b", 0700) | symlink("a/b", "link"), 0);
    static const struct {
        const char *from, *path, *joined;
    } cases[] = {
        {"a/m.toml", "../c", "c"},
        {"a/b/m.toml", "../../c", "c"},
        {"a/b/m.toml", "../c", "a/c"},
        {"./a/m.toml", "../c", "./c"},
        {"link/m.toml", "../c", "link/../c"},
        {"../a/m.toml", "../c", "../a/../c"},
        {"a/m.toml", "../a/../c", "c"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char *joined = path_beside(cases[k].from, cases[k].path);
        ck_assert_str_eq(joined, cases[k].joined);
        free(joined);
    }
    snprintf(from, sizeof from, "%s/a/m.toml", folder);
    snprintf(expected, sizeof expected, "%s/c", folder);
    char *joined = path_beside(from, "../c");
    ck_assert_str_eq(joined, expected);
    free(joined);
    ck_assert_int_eq(unlink("link") | rmdir("a/b") | rmdir("a") | chdir("/") | rmdir(folder), 0);
}
END_TEST

START_TEST(test_string_copy_takes_part_of_a_text)
{
    char *copy = string_copy("abcdef", 3);
    ck_assert_str_eq(copy, "abc");
    free(copy);
    copy = string_copy(NULL, 0);
    ck_assert_str_eq(copy, "");
    free(copy);
    ck_assert(string_equal("a", "a") && !string_equal("a", "A"));
}
END_TEST

/* ----------------------------------------------------------------- files */

START_TEST(test_file_read_gives_every_byte)
{
    char path[] = "/tmp/glint-test-XXXXXX";
    const int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    static const char bytes[] = "a\0b\r\n\xff";
    ck_assert_int_eq(write(fd, bytes, sizeof bytes), (ssize_t)sizeof bytes);
    close(fd);
    char *data;
    size_t size;
    glint_error error;
    ck_assert_int_eq(file_read(path, &data, &size, PLACE_NONE, &error), GLINT_OK);
    unlink(path);
    ck_assert_uint_eq(size, sizeof bytes);
    ck_assert_mem_eq(data, bytes, sizeof bytes);
    ck_assert_int_eq(data[size], '\0');
    free(data);
}
END_TEST

static void check_unreadable(const char *path, const char *part)
{
    char *data;
    size_t size;
    glint_error error;
    ck_assert_int_eq(file_read(path, &data, &size, PLACE_NONE, &error), GLINT_INPUT);
    ck_assert_ptr_null(data);
    ck_assert_msg(strstr(error.message, path) && strstr(error.message, part), "%s", error.message);
    ck_assert_str_eq(error.file, path);
    ck_assert_int_eq(file_read(path, &data, &size, SOMEWHERE, &error), GLINT_INPUT);
    ck_assert_str_eq(error.file, SOMEWHERE.file);
    ck_assert_int_eq(error.line, SOMEWHERE.line);
}

START_TEST(test_file_read_refuses_what_is_no_file)
{
    check_unreadable("/no/such/file", "No such file");
    check_unreadable("/", "a directory");
    check_unreadable("/dev/null", "not a regular file");
}
END_TEST

/* ------------------------------------------------------------ parameters */

START_TEST(test_param_accepts_its_range_only)
{
    const param_info closed = {"a", "", "", 0, 1, 0.5, 0};
    const param_info open = {"b", "", "", 0, 1, PARAM_REQUIRED, PARAM_MIN_OPEN | PARAM_MAX_OPEN};
    const param_info any = {"c", "", "", -INFINITY, INFINITY, 0, 0};
    ck_assert(param_accepts(&closed, 0) && param_accepts(&closed, 1));
    ck_assert(!param_accepts(&open, 0) && !param_accepts(&open, 1) && param_accepts(&open, 0.5));
    ck_assert(!param_accepts(&closed, nextafter(1, 2)) && !param_accepts(&closed, -DBL_TRUE_MIN));
    ck_assert(param_accepts(&any, -DBL_MAX));
    ck_assert(!param_accepts(&any, NAN) && !param_accepts(&any, INFINITY));
    ck_assert(!param_accepts(&closed, NAN) && !param_accepts(&open, NAN));
    ck_assert(param_is_required(&open) && !param_is_required(&closed));
}
END_TEST

START_TEST(test_param_says_its_range_in_words)
{
    static const struct {
        param_info param;
        const char *words;
    } cases[] = {
        {{"a", "", "", 0, 1, 0, 0}, "between 0 and 1"},
        {{"a", "", "", 0, 1, 0, PARAM_MIN_OPEN}, "above 0 and at most 1"},
        {{"a", "", "", 0, 1, 0, PARAM_MAX_OPEN}, "at least 0 and below 1"},
        {{"a", "", "", 0, INFINITY, 0, 0}, "at least 0"},
        {{"a", "", "", 0, INFINITY, 0, PARAM_MIN_OPEN}, "above 0"},
        {{"a", "", "", -INFINITY, 90, 0, 0}, "at most 90"},
        {{"a", "", "", -INFINITY, 90, 0, PARAM_MAX_OPEN}, "below 90"},
        {{"a", "", "", -INFINITY, INFINITY, 0, 0}, "any finite number"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char words[PARAM_RANGE_SIZE];
        param_range_text(&cases[k].param, words);
        ck_assert_str_eq(words, cases[k].words);
    }
}
END_TEST

/* The first numbers from the state 1234567, as Rosetta Code's page on splitmix64 lists them. */
START_TEST(test_random_gives_the_published_sequence)
{
    static const uint64_t EXPECTED[5] = {
        UINT64_C(6457827717110365317), UINT64_C(3203168211198807973), UINT64_C(9817491932198370423),
        UINT64_C(4593380528125082431), UINT64_C(16408922859458223821)};
    uint64_t state = 1234567;
    for (int k = 0; k < 5; k++)
        ck_assert_uint_eq(random_next(&state), EXPECTED[k]);
}
END_TEST

/* Means and variances of the two distributions; of n = 10^5 numbers they scatter by sqrt(1/12n) and
 * sqrt(1/n), their variances by about sqrt(2/n) of themselves. Five times that is allowed. */
START_TEST(test_random_has_the_moments_it_says)
{
    enum { N = 100000 };
    uint64_t state = 1;
    double even = 0.0, even2 = 0.0, normal = 0.0, normal2 = 0.0;
    for (int k = 0; k < N; k++) {
        const double e = random_even(&state), n = random_normal(&state);
        ck_assert(e >= 0.0 && e < 1.0);
        ck_assert(n >= -6.0 && n <= 6.0);
        even += e / N, even2 += e * e / N, normal += n / N, normal2 += n * n / N;
    }
    assert_near(even, 0.5, 5.0 * sqrt(1.0 / 12.0 / N));
    assert_near(even2 - even * even, 1.0 / 12.0, 5.0 * sqrt(2.0 / N) / 12.0);
    assert_near(normal, 0.0, 5.0 * sqrt(1.0 / N));
    assert_near(normal2 - normal * normal, 1.0, 5.0 * sqrt(2.0 / N));
}
END_TEST

/* ------------------------------------------------- numbers that ascend */

/* Numbers with others between them, as in an array of structures; one of them twice. */
static const double ASCENDING[5][2] = {{1, -9}, {2, -9}, {2, -9}, {4, -9}, {8, -9}};

START_TEST(test_sorted_up_to_counts_as_one_by_one_does)
{
    static const double AT[] = {-1, 1, 1.5, 2, 3, 4, 7.9, 8, 9, INFINITY, -INFINITY};
    for (size_t a = 0; a < sizeof AT / sizeof *AT; a++)
        for (size_t n = 0; n <= 5; n++) {
            size_t count = 0;
            for (size_t k = 0; k < n; k++)
                count += ASCENDING[k][0] <= AT[a];
            ck_assert_uint_eq(sorted_up_to(ASCENDING[0], n, sizeof ASCENDING[0], AT[a]), count);
        }
}
END_TEST

START_TEST(test_sorted_interval_stays_within_the_ends)
{
    static const struct {
        double x;
        size_t interval;
    } CASES[] = {{0, 0}, {1, 0}, {1.9, 0}, {2, 2}, {3.9, 2}, {4, 3}, {7, 3}, {8, 3}, {99, 3}};
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++)
        ck_assert_uint_eq(sorted_interval(ASCENDING[0], 5, sizeof ASCENDING[0], CASES[c].x),
                          CASES[c].interval);
    ck_assert_uint_eq(sorted_interval(ASCENDING[0], 1, sizeof ASCENDING[0], 5), 0);
}
END_TEST

/* ---------------------------------------------------------------- arrays */

START_TEST(test_grow_keeps_entries_and_grows_rarely)
{
    enum { N = 100000 };
    long *list = NULL, *room = NULL;
    size_t of_list = 0;
    int of_room = 0, n_moves = 0;
    for (int k = 0; k < N; k++) {
        const size_t before = of_list;
        ck_assert(grow_list(&list, &of_list, (size_t)k + 1, sizeof *list));
        ck_assert(grow_room(&room, &of_room, k + 1L, sizeof *room));
        ck_assert_uint_gt(of_list, (size_t)k);
        ck_assert_int_eq(of_room, (int)of_list);
        n_moves += of_list != before;
        list[k] = room[k] = 3L * k;
    }
    for (int k = 0; k < N; k++)
        ck_assert(list[k] == 3L * k && room[k] == 3L * k);
    ck_assert_int_le(n_moves, 17); /* at least doubled each time: log2 of N, rounded up */
    const size_t enough = of_list;
    ck_assert(grow_list(&list, &of_list, 1, sizeof *list));
    ck_assert_uint_eq(of_list, enough);
    free(list);
    free(room);
}
END_TEST

START_TEST(test_grow_refuses_what_no_memory_can_hold_and_changes_nothing)
{
    static const size_t TOO_MANY[] = {SIZE_MAX, SIZE_MAX / 2, SIZE_MAX / sizeof(long)};
    long *list = NULL;
    size_t of_list = 0;
    ck_assert(grow_list(&list, &of_list, 1, sizeof *list));
    list[0] = 7;
    long *const held = list;
    const size_t had = of_list;
    for (size_t k = 0; k < sizeof TOO_MANY / sizeof TOO_MANY[0]; k++) {
        ck_assert(!grow_list(&list, &of_list, TOO_MANY[k], sizeof *list));
        ck_assert_ptr_eq(list, held);
        ck_assert_uint_eq(of_list, had);
    }
    int of_room = (int)of_list;
    ck_assert(!grow_room(&list, &of_room, 1L + INT_MAX, sizeof *list));
    ck_assert(list == held && of_room == (int)had && list[0] == 7);
    free(list);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("base");
    TCase *errors = tcase_create("errors"), *texts = tcase_create("texts"),
          *numbers = tcase_create("numbers"), *names = tcase_create("names");
    tcase_set_timeout(numbers, 60); /* s: sanitizers are slow */
    tcase_add_test(errors, test_errors_keeps_order_and_places_of_many);
    tcase_add_test(errors, test_errors_counts_warnings_apart);
    tcase_add_test(errors, test_errors_take_fills_in_a_missing_place_only);
    tcase_add_test(errors, test_errors_work_without_a_list);
    tcase_add_test(errors, test_error_cuts_texts_that_are_too_long_visibly);
    tcase_add_test(errors, test_error_keeps_a_text_that_just_fits);
    tcase_add_test(texts, test_text_grows_and_stays_terminated);
    tcase_add_test(texts, test_text_remembers_that_memory_ran_out);
    tcase_add_test(texts, test_grow_keeps_entries_and_grows_rarely);
    tcase_add_test(texts, test_grow_refuses_what_no_memory_can_hold_and_changes_nothing);
    tcase_add_test(texts, test_string_copy_takes_part_of_a_text);
    tcase_add_test(texts, test_file_read_gives_every_byte);
    tcase_add_test(texts, test_file_read_refuses_what_is_no_file);
    tcase_add_test(numbers, test_number_round_trips_at_the_edges);
    tcase_add_test(numbers, test_number_round_trips_for_any_bits);
    tcase_add_test(numbers, test_number_round_trips_for_denormals);
    tcase_add_test(numbers, test_number_writes_plain_values_plainly);
    tcase_add_test(numbers, test_number_for_people_has_no_sign_where_it_rounds_to_zero);
    tcase_add_test(numbers, test_number_reads_decimals_as_the_c_library_does);
    tcase_add_test(numbers, test_number_tells_underflow_from_overflow_of_long_numbers);
    tcase_add_test(numbers, test_number_refuses_what_is_no_decimal_number);
    tcase_add_test(numbers, test_number_reads_no_further_than_told);
    tcase_add_test(numbers, test_random_gives_the_published_sequence);
    tcase_add_test(numbers, test_random_has_the_moments_it_says);
    tcase_add_test(numbers, test_sorted_up_to_counts_as_one_by_one_does);
    tcase_add_test(numbers, test_sorted_interval_stays_within_the_ends);
    tcase_add_test(names, test_nearest_name_finds_slips);
    tcase_add_test(names, test_nearest_name_stands_very_long_names);
    tcase_add_test(names, test_path_beside_joins_folder_and_name);
    tcase_add_test(names, test_path_beside_leaves_out_ways_back);
    tcase_add_test(names, test_param_accepts_its_range_only);
    tcase_add_test(names, test_param_says_its_range_in_words);
    suite_add_tcase(suite, errors);
    suite_add_tcase(suite, texts);
    suite_add_tcase(suite, numbers);
    suite_add_tcase(suite, names);
    return run_suite(suite);
}
