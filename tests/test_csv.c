/* test_csv.c: tables of comma-separated values: what is read, and every error with its place. */
#include "testing.h"

#include "base/csv.h"

#include <stdbool.h>
#include <stdint.h>
#include <unistd.h>

/* A table read from bytes, with the errors that it gave. */
typedef struct reading {
    char path[32];
    csv_table table;
    glint_errors *errors;
    glint_status status;
} reading;

static reading read_bytes(const char *bytes, size_t n)
{
    reading r = {.path = "/tmp/glint-test-XXXXXX", .errors = glint_errors_new()};
    const int fd = mkstemp(r.path);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(write(fd, bytes, n), (ssize_t)n);
    close(fd);
    r.status = csv_read(r.path, PLACE_NONE, &r.table, r.errors);
    unlink(r.path);
    return r;
}

static reading read_text(const char *text)
{
    return read_bytes(text, strlen(text));
}

static void end_reading(reading *r)
{
    csv_free(&r->table);
    glint_errors_free(r->errors);
}

/* Checks a table against its cells, row by row with the header first, parted by '|'. */
static void check_table(const char *text, int n_columns, long n_rows, const char *cells)
{
    reading r = read_text(text);
    ck_assert_msg(r.status == GLINT_OK, "%s",
                  glint_errors_count(r.errors) ? glint_errors_get(r.errors, 0)->message : "?");
    ck_assert_uint_eq(glint_errors_count(r.errors), 0);
    ck_assert_int_eq(r.table.n_columns, n_columns);
    ck_assert_int_eq(r.table.n_rows, n_rows);
    char found[1000] = "";
    for (long row = -1; row < n_rows; row++)
        for (int column = 0; column < n_columns; column++) {
            strcat(found, found[0] || row + column >= 0 ? "|" : "");
            strcat(found, csv_at(&r.table, row, column)->text);
        }
    ck_assert_str_eq(found, cells);
    end_reading(&r);
}

START_TEST(test_csv_reads_plain_cells)
{
    check_table("a,b\n1,2\n3,4\n", 2, 2, "a|b|1|2|3|4");
    check_table("a,b\n1,2", 2, 1, "a|b|1|2");
    check_table("a\n1\n", 1, 1, "a|1");
    check_table("a,b\n", 2, 0, "a|b");
    check_table("a,b\n,\n", 2, 1, "a|b||");
    check_table("a,b\n1,", 2, 1, "a|b|1|");
}
END_TEST

START_TEST(test_csv_strips_blanks_around_cells)
{
    check_table(" a ,\tb\t\n  1  2 , 3\t\n", 2, 1, "a|b|1  2|3");
    check_table("a,b\n \" x \" ,\"y\"\t\n", 2, 1, "a|b| x |y");
}
END_TEST

START_TEST(test_csv_accepts_line_ends_of_both_kinds)
{
    check_table("a,b\r\n1,2\r\n\r\n3,4", 2, 2, "a|b|1|2|3|4");
    check_table("a,b\r\n1,\"2\"\r\n", 2, 1, "a|b|1|2");
    check_table("a,b\n1,2\r\n3,4\n", 2, 2, "a|b|1|2|3|4");
}
END_TEST

START_TEST(test_csv_skips_comments_and_blank_lines)
{
    check_table("# first, \"\n\n  # second\na,b\n\n#x\n1,2\n \t\n# end", 2, 1, "a|b|1|2");
    check_table("a,b\n1,#2\n", 2, 1, "a|b|1|#2");
}
END_TEST

START_TEST(test_csv_skips_a_byte_order_mark)
{
    check_table("\xEF\xBB\xBF"
                "a,b\n1,2\n",
                2, 1, "a|b|1|2");
    reading r = read_text("\xEF\xBB\xBF"
                          "a,b\n");
    ck_assert_int_eq(csv_at(&r.table, -1, 0)->column, 1);
    end_reading(&r);
}
END_TEST

START_TEST(test_csv_unquotes_cells)
{
    check_table("\"a\",\"b,c\"\n\"1\"\"2\",\"\"\n", 2, 1, "a|b,c|1\"2|");
    check_table("a,b\n\"\"\"\",\"# no comment\"\n", 2, 1, "a|b|\"|# no comment");
    check_table("a,b\nx\"y,z\n", 2, 1, "a|b|x\"y|z");
}
END_TEST

START_TEST(test_csv_knows_the_place_of_every_cell)
{
    reading r = read_text("# c\na, bb,c\n\n1,\"2\" ,  3\n");
    ck_assert_int_eq(r.status, GLINT_OK);
    static const int places[2][3][2] = {{{2, 1}, {2, 4}, {2, 7}}, {{4, 1}, {4, 3}, {4, 10}}};
    for (int row = 0; row < 2; row++)
        for (int column = 0; column < 3; column++) {
            const place found = csv_place(&r.table, csv_at(&r.table, row - 1, column));
            ck_assert_int_eq(found.line, places[row][column][0]);
            ck_assert_int_eq(found.column, places[row][column][1]);
            ck_assert_str_eq(found.file, r.path);
        }
    ck_assert_int_eq(csv_column(&r.table, "bb"), 1);
    ck_assert_int_eq(csv_column(&r.table, "b"), -1);
    ck_assert_int_eq(csv_column(&r.table, ""), -1);
    end_reading(&r);
}
END_TEST

/* What one wrong table must say: its errors in order. */
typedef struct wrong {
    const char *text;
    struct {
        int line, column;
        const char *part;
    } errors[4];
} wrong;

START_TEST(test_csv_reports_every_error_at_its_place)
{
    static const wrong cases[] = {
        {"", {{0, 0, "is empty"}}},
        {"# only\n\n", {{0, 0, "is empty"}}},
        {"a,,b\n1,2,3\n", {{1, 3, "column 2 has no name"}}},
        {"a,b,a\n", {{1, 5, "'a' stands twice"}}},
        {"a,b\n1\n1,2\n1,2,3\n", {{2, 1, "has 1 cells; expected 2"}, {4, 1, "has 3 cells"}}},
        {"a,b\n\"1,2\n3,4\n", {{2, 1, "no closing quote"}}},
        {"a,b\n1,\"2\n3,4\n5\n", {{2, 3, "no closing quote"}, {4, 1, "has 1 cells"}}},
        {"a,b\n\"1\"x,2\n", {{2, 4, "after the closing quote"}}},
        {"a,b\n1, \"2\" 3\n", {{2, 8, "after the closing quote"}}},
        {"a,b\n1,\"", {{2, 3, "no closing quote"}}},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        reading r = read_text(cases[k].text);
        ck_assert_msg(r.status == GLINT_INPUT, "accepted: %s", cases[k].text);
        ck_assert_ptr_null(r.table.cells);
        ck_assert_int_eq(r.table.n_rows, 0);
        size_t n = 0;
        while (n < 4 && cases[k].errors[n].part)
            n++;
        ck_assert_msg(glint_errors_count(r.errors) == n, "%zu errors: %s",
                      glint_errors_count(r.errors), cases[k].text);
        for (size_t j = 0; j < n; j++) {
            const glint_error *error = glint_errors_get(r.errors, j);
            ck_assert_str_eq(error->file, r.path);
            ck_assert_msg(error->line == cases[k].errors[j].line &&
                              error->column == cases[k].errors[j].column,
                          "%d:%d: %s", error->line, error->column, error->message);
            ck_assert_msg(strstr(error->message, cases[k].errors[j].part), "%s", error->message);
        }
        end_reading(&r);
    }
}
END_TEST

START_TEST(test_csv_refuses_what_is_no_text)
{
    reading r = read_bytes("a,b\n1,\0002\n", 10);
    ck_assert_int_eq(r.status, GLINT_INPUT);
    ck_assert_msg(strstr(glint_errors_get(r.errors, 0)->message, "zero byte"), "%s",
                  glint_errors_get(r.errors, 0)->message);
    end_reading(&r);
}
END_TEST

START_TEST(test_csv_says_where_an_absent_file_was_named)
{
    csv_table table;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(csv_read("no/such.csv", (place){"s.toml", 4, 9}, &table, errors), GLINT_INPUT);
    ck_assert_uint_eq(glint_errors_count(errors), 1);
    const glint_error *error = glint_errors_get(errors, 0);
    ck_assert_str_eq(error->file, "s.toml");
    ck_assert_int_eq(error->line, 4);
    ck_assert_int_eq(error->column, 9);
    ck_assert_msg(strstr(error->message, "no/such.csv"), "%s", error->message);
    glint_errors_free(errors);
}
END_TEST

START_TEST(test_csv_number_gives_values_and_names_what_is_none)
{
    reading r = read_text("x,y\n1.5,-2e3\n,nan\n0x1,\"7\"\n");
    ck_assert_int_eq(r.status, GLINT_OK);
    double value = -1;
    ck_assert_int_eq(csv_number(&r.table, 0, 0, &value, r.errors), GLINT_OK);
    assert_near(value, 1.5, 0);
    ck_assert_int_eq(csv_number(&r.table, 0, 1, &value, r.errors), GLINT_OK);
    assert_near(value, -2000, 0);
    ck_assert_int_eq(csv_number(&r.table, 2, 1, &value, r.errors), GLINT_OK);
    assert_near(value, 7, 0);
    static const int bad[3][4] = {
        {1, 0, 3, 1}, {1, 1, 3, 2}, {2, 0, 4, 1}}; /* row, column, place */
    for (size_t k = 0; k < 3; k++) {
        ck_assert_int_eq(csv_number(&r.table, bad[k][0], bad[k][1], &value, r.errors), GLINT_INPUT);
        const glint_error *error = glint_errors_get(r.errors, k);
        ck_assert_int_eq(error->line, bad[k][2]);
        ck_assert_int_eq(error->column, bad[k][3]);
        ck_assert_msg(strstr(error->message, bad[k][1] ? "'y'" : "'x'"), "%s", error->message);
    }
    end_reading(&r);
}
END_TEST

/* Any bytes either read, or are refused with a reason. */
static void check_survives(const char *bytes, size_t n)
{
    reading r = read_bytes(bytes, n);
    if (r.status == GLINT_OK) {
        ck_assert_uint_eq(glint_errors_error_count(r.errors), 0);
        for (long row = -1; row < r.table.n_rows; row++)
            for (int column = 0; column < r.table.n_columns; column++) {
                const csv_cell *cell = csv_at(&r.table, row, column);
                ck_assert(cell->line > 0 && cell->column > 0 && strlen(cell->text) <= n);
            }
    } else {
        ck_assert_int_eq(r.status, GLINT_INPUT);
        ck_assert_uint_gt(glint_errors_error_count(r.errors), 0);
        ck_assert_ptr_null(r.table.cells);
    }
    end_reading(&r);
}

static const char sample[] = "\xEF\xBB\xBF# comment\r\nutc,\"sun \"\"x\"\"\",z\r\n\r\n"
                             "\"a,b\" , 1.5e-3,\t\"\"\r\n#\n,,\"\"\"\"\r\n-1,2,\"last\"";

START_TEST(test_csv_survives_truncation_at_every_byte)
{
    for (size_t n = 0; n < sizeof sample; n++)
        check_survives(sample, n);
}
END_TEST

START_TEST(test_csv_survives_any_one_byte_changed)
{
    static const char swaps[] = {'"', ',', '\n', '\r', '#', ' ', 'x', '\0', '\xff'};
    for (size_t at = 0; at < sizeof sample - 1; at++)
        for (size_t k = 0; k < sizeof swaps; k++) {
            char changed[sizeof sample];
            memcpy(changed, sample, sizeof sample);
            changed[at] = swaps[k];
            check_survives(changed, sizeof sample - 1);
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("csv");
    TCase *all = tcase_create("all");
    tcase_set_timeout(all, 60); /* s: sanitizers are slow */
    tcase_add_test(all, test_csv_reads_plain_cells);
    tcase_add_test(all, test_csv_strips_blanks_around_cells);
    tcase_add_test(all, test_csv_accepts_line_ends_of_both_kinds);
    tcase_add_test(all, test_csv_skips_comments_and_blank_lines);
    tcase_add_test(all, test_csv_skips_a_byte_order_mark);
    tcase_add_test(all, test_csv_unquotes_cells);
    tcase_add_test(all, test_csv_knows_the_place_of_every_cell);
    tcase_add_test(all, test_csv_reports_every_error_at_its_place);
    tcase_add_test(all, test_csv_refuses_what_is_no_text);
    tcase_add_test(all, test_csv_says_where_an_absent_file_was_named);
    tcase_add_test(all, test_csv_number_gives_values_and_names_what_is_none);
    tcase_add_test(all, test_csv_survives_truncation_at_every_byte);
    tcase_add_test(all, test_csv_survives_any_one_byte_changed);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
