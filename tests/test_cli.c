/* test_cli.c: the parts of the program that need no scenario: options, durations. The
 * program as a whole is tested by test_cli.sh. */
#include "testing.h"

#include "cli/command.h"
#include "cli/report.h"

static const char *const formats[] = {"csv", "json", NULL};
static const option_set ALL = OPTION_BIT(OPTION_COUNT) - 1;

/* Reads a command line that ends with NULL. */
static glint_status read_line(const char *const *words, options *o, glint_error *error)
{
    int n = 0;
    while (words[n])
        n++;
    return options_read(n, words, ALL, formats, o, error);
}

#define LINE(...) ((const char *const[]){__VA_ARGS__, NULL})

START_TEST(test_options_take_values_in_every_spelling)
{
    const char *const *const lines[] = {LINE("--output", "f", "in"),
                                        LINE("--output=f", "in"),
                                        LINE("in", "-o", "f"),
                                        LINE("-of", "in"),
                                        LINE("-qo", "f", "in"),
                                        LINE("-qof", "--", "in"),
                                        LINE("-o", "wrong", "in", "--output=f")};
    for (size_t k = 0; k < sizeof lines / sizeof *lines; k++) {
        options o;
        glint_error error;
        ck_assert_int_eq(read_line(lines[k], &o, &error), GLINT_OK);
        ck_assert_str_eq(o.output, "f");
        ck_assert_uint_eq(o.n_operands, 1);
        ck_assert_str_eq(o.operands[0], "in");
        ck_assert_int_eq(o.quiet, k == 4 || k == 5);
        options_free(&o);
    }
}
END_TEST

START_TEST(test_options_keep_overrides_and_operands_in_order)
{
    options o;
    glint_error error;
    const char *const *const line =
        LINE("a", "--set", "x.y=1", "-", "--set=z=\"a=b\"", "--", "--set", "-q", "--");
    ck_assert_int_eq(read_line(line, &o, &error), GLINT_OK);
    ck_assert_uint_eq(o.n_overrides, 2);
    ck_assert_str_eq(o.overrides[0], "x.y=1");
    ck_assert_str_eq(o.overrides[1], "z=\"a=b\"");
    static const char *const operands[] = {"a", "-", "--set", "-q", "--"};
    ck_assert_uint_eq(o.n_operands, 5);
    for (size_t k = 0; k < 5; k++)
        ck_assert_str_eq(o.operands[k], operands[k]);
    ck_assert(!o.quiet && options_has(&o, OPTION_SET) && !options_has(&o, OPTION_QUIET));
    options_free(&o);
}
END_TEST

START_TEST(test_options_start_from_defaults)
{
    options o;
    glint_error error;
    ck_assert_int_eq(options_read(0, NULL, ALL, formats, &o, &error), GLINT_OK);
    ck_assert(!o.output && !o.format && !o.quiet && !o.given);
    ck_assert_int_eq(o.threads, 0);
    ck_assert_uint_eq(o.n_operands + o.n_overrides, 0);
    options_free(&o);
    ck_assert_int_eq(read_line(LINE("--threads", "16", "--format=json"), &o, &error), GLINT_OK);
    ck_assert_int_eq(o.threads, 16);
    ck_assert_str_eq(o.format, "json");
    options_free(&o);
}
END_TEST

START_TEST(test_options_refuse_what_they_do_not_know)
{
    static const struct {
        const char *words[4];
        const char *part;
    } cases[] = {
        {{"--outptu", "f"}, "did you mean '--output'"},
        {{"--xyzzy"}, "unknown option '--xyzzy'"},
        {{"-z"}, "unknown option '-z'"},
        {{"-qz"}, "unknown option '-z'"},
        {{"--quiet=yes"}, "'--quiet' takes no value"},
        {{"--set"}, "needs a value: --set KEY=VALUE"},
        {{"-o"}, "needs a value: --output FILE"},
        {{"--output="}, "empty file name"},
        {{"--set", "novalue"}, "expected KEY=VALUE"},
        {{"--set", "=1"}, "expected KEY=VALUE"},
        {{"--threads", "-1"}, "whole number"},
        {{"--threads", "+1"}, "whole number"},
        {{"--threads", " 1"}, "whole number"},
        {{"--threads", "1.5"}, "whole number"},
        {{"--threads", ""}, "whole number"},
        {{"--threads", "99999999999999999999"}, "whole number"},
        {{"--format", "xml"}, "csv, json"},
        {{"--swpa", "a=b"}, "did you mean '--swap'?"},
        {{"--=x"}, "unknown option '--'"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        options o;
        glint_error error = {0};
        ck_assert_msg(read_line(cases[k].words, &o, &error) == GLINT_ARGUMENT, "%s accepted",
                      cases[k].words[0]);
        ck_assert_int_eq(error.status, GLINT_ARGUMENT);
        ck_assert_msg(strstr(error.message, cases[k].part), "%s", error.message);
        options_free(&o);
    }
}
END_TEST

START_TEST(test_options_know_only_those_of_the_command)
{
    options o;
    glint_error error;
    const char *const *const line = LINE("--set", "a=1");
    ck_assert_int_eq(options_read(2, line, 1u << OPTION_QUIET, formats, &o, &error),
                     GLINT_ARGUMENT);
    options_free(&o);
}
END_TEST

START_TEST(test_command_find_takes_one_word_or_two)
{
    const command *c;
    int used;
    glint_error error;
    const char *const run[] = {"run", "x"}, *const list[] = {"brdf", "list", "x"};
    ck_assert_int_eq(command_find(2, run, &c, &used, &error), GLINT_OK);
    ck_assert_str_eq(c->name, "run");
    ck_assert_int_eq(used, 1);
    ck_assert_int_eq(command_find(3, list, &c, &used, &error), GLINT_OK);
    ck_assert_str_eq(c->name, "brdf list");
    ck_assert_int_eq(used, 2);
    ck_assert_int_eq(command_find(1, list, &c, &used, &error), GLINT_ARGUMENT);
    ck_assert_ptr_null(c);
}
END_TEST

START_TEST(test_duration_uses_its_two_largest_units)
{
    static const struct {
        double seconds;
        const char *text;
    } cases[] = {{0, "0.0 s"},
                 {12.34, "12.3 s"},
                 {59.94, "59.9 s"},
                 {59.96, "1 min 0 s"},
                 {60, "1 min 0 s"},
                 {260.4, "4 min 20 s"},
                 {3599, "59 min 59 s"},
                 {3599.6, "1 h 0 min"},
                 {3600, "1 h 0 min"},
                 {7290, "2 h 2 min"},
                 {86400, "1 d 0 h"},
                 {183600, "2 d 3 h"},
                 {31557600, "365 d 6 h"},
                 {1e12, "11574074 d 2 h"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[DURATION_SIZE];
        report_duration(cases[k].seconds, text);
        ck_assert_str_eq(text, cases[k].text);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("cli");
    TCase *all = tcase_create("all");
    tcase_add_test(all, test_options_take_values_in_every_spelling);
    tcase_add_test(all, test_options_keep_overrides_and_operands_in_order);
    tcase_add_test(all, test_options_start_from_defaults);
    tcase_add_test(all, test_options_refuse_what_they_do_not_know);
    tcase_add_test(all, test_options_know_only_those_of_the_command);
    tcase_add_test(all, test_command_find_takes_one_word_or_two);
    tcase_add_test(all, test_duration_uses_its_two_largest_units);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
