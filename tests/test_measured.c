/* test_measured.c: files of measured BRDF values: what is read, and every error with its place. */
#include "testing.h"

#include "base/constants.h"
#include "brdf/measured.h"

#include <unistd.h>

/* A file read from bytes, with the errors that it gave. */
typedef struct reading {
    char path[32];
    measured rows;
    glint_errors *errors;
    glint_status status;
} reading;

/* Where the file is said to be named. */
static const place NAMED = {"scene.toml", 4, 9};

static reading read_bytes(const char *bytes, size_t n, const measured_format *format)
{
    reading r = {.path = "/tmp/glint-test-XXXXXX", .errors = glint_errors_new()};
    const int fd = mkstemp(r.path);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(write(fd, bytes, n), (ssize_t)n);
    close(fd);
    r.status = measured_read(r.path, NAMED, format, &r.rows, r.errors);
    unlink(r.path);
    return r;
}

static void end_reading(reading *r)
{
    measured_free(&r->rows);
    glint_errors_free(r->errors);
}

/* Columns by number; 0: none. */
static measured_format numbered(int theta_i, int phi_i, int theta_r, int phi_r, int f)
{
    return (measured_format){.column = {[MEASURED_THETA_I] = {.number = theta_i},
                                        [MEASURED_PHI_I] = {.number = phi_i},
                                        [MEASURED_THETA_R] = {.number = theta_r},
                                        [MEASURED_PHI_R] = {.number = phi_r},
                                        [MEASURED_F] = {.number = f}}};
}

static measured_format named(const char *theta_i, const char *phi_i, const char *theta_r,
                             const char *phi_r, const char *f)
{
    return (measured_format){.column = {[MEASURED_THETA_I] = {.name = theta_i},
                                        [MEASURED_PHI_I] = {.name = phi_i},
                                        [MEASURED_THETA_R] = {.name = theta_r},
                                        [MEASURED_PHI_R] = {.name = phi_r},
                                        [MEASURED_F] = {.name = f}}};
}

/* A row as it ought to be: angles in deg, azimuths that need not be unique. */
typedef struct row {
    double theta_i, phi_i, theta_r, phi_r, f;
    int line;
} row;

static void check_direction(const double got[3], double theta_deg, double phi_deg)
{
    const double theta = theta_deg * DEG, phi = phi_deg * DEG;
    const double want[3] = {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
    for (int k = 0; k < 3; k++)
        assert_near(got[k], want[k], 4e-16);
}

/* Checks that a text reads as three rows. */
static void check_rows(const char *text, measured_format format, const row rows[3])
{
    reading r = read_bytes(text, strlen(text), &format);
    ck_assert_msg(r.status == GLINT_OK, "%s: %s", text,
                  r.status ? glint_errors_get(r.errors, 0)->message : "");
    ck_assert_uint_eq(glint_errors_count(r.errors), 0);
    ck_assert_int_eq(r.rows.n, 3);
    for (int k = 0; k < 3; k++) {
        const measured_point *p = &r.rows.points[k];
        check_direction(p->i, rows[k].theta_i, rows[k].phi_i);
        check_direction(p->r, rows[k].theta_r, rows[k].phi_r);
        assert_near(p->f, rows[k].f, 0.0);
        ck_assert_int_eq(p->line, rows[k].line);
    }
    end_reading(&r);
}

/* The three rows that most texts here hold, from their first line on. */
#define PLANE_ROWS(line)                                                                           \
    (const row[])                                                                                  \
    {                                                                                              \
        {30, 0, 30, 180, 5.5, line}, {30, 0, 10.25, 180, 0.25, line + 1},                          \
        {                                                                                          \
            45, 0, 0, 180, 1e-3, line + 2                                                          \
        }                                                                                          \
    }

START_TEST(test_measured_reads_columns_by_their_usual_names)
{
    const measured_format none = {0};
    check_rows("theta_i,theta_r,f\n30,30,5.5\n30,10.25,.25\n45,0,1e-3\n", none, PLANE_ROWS(2));
    check_rows("f,note,theta_r,theta_i\n5.5,a,30,30\n0.25,,10.25,30\n+1E-3,1 2,0,45\n", none,
               PLANE_ROWS(2));
    check_rows(
        "theta_i,phi_i,theta_r,phi_r,f\n10,20,30,40,1\n11,-21,31,410,2\n12,22,32,42,3\n", none,
        (const row[]){{10, 20, 30, 40, 1, 2}, {11, -21, 31, 410, 2, 3}, {12, 22, 32, 42, 3, 4}});
}
END_TEST

START_TEST(test_measured_reads_columns_by_number)
{
    check_rows("30,30,5.5\n30,10.25,0.25\n45,0,0.001\n", numbered(1, 0, 2, 0, 3), PLANE_ROWS(1));
    check_rows("a,b,c,d\n5.5,7,30,30\n0.25,7,10.25,30\n0.001,7,0,45\n", numbered(4, 0, 3, 0, 1),
               PLANE_ROWS(2));
    check_rows(
        "10 20 30 40 1\n11 21 31 41 2\n12 22 32 42 3\n", numbered(1, 2, 3, 4, 5),
        (const row[]){{10, 20, 30, 40, 1, 1}, {11, 21, 31, 41, 2, 2}, {12, 22, 32, 42, 3, 3}});
    /* without phi_r: on the mirror's side of wherever the light comes from */
    check_rows(
        "10 20 30 1\n11 21 31 2\n12 22 32 3\n", numbered(1, 2, 3, 0, 4),
        (const row[]){{10, 20, 30, 200, 1, 1}, {11, 21, 31, 201, 2, 2}, {12, 22, 32, 202, 3, 3}});
}
END_TEST

START_TEST(test_measured_reads_columns_by_name)
{
    check_rows("Zi (deg);Zr (deg);BRDF (1/sr)\n30;30;5.5\n30;10.25;0.25\n45;0;0.001\n",
               named("Zi (deg)", NULL, "Zr (deg)", NULL, "BRDF (1/sr)"), PLANE_ROWS(2));
    check_rows("\"in\" ,\t\"out\", \"f\"\n30,30,5.5\n30,10.25,0.25\n45,0,0.001\n",
               named("in", NULL, "out", NULL, "f"), PLANE_ROWS(2));
    measured_format mixed = named("in", NULL, NULL, NULL, "f");
    mixed.column[MEASURED_THETA_R].number = 2;
    check_rows("in,out,f\n30,30,5.5\n30,10.25,0.25\n45,0,0.001\n", mixed, PLANE_ROWS(2));
}
END_TEST

/* As the files of laboratories: the names stand in the last comment. */
START_TEST(test_measured_takes_names_from_the_last_comment)
{
    static const char text[] = "# measured in May\n# (phi, theta): zenith and azimuth\n#\n"
                               "# phi_i  theta_i  phi_o  theta_o  brdf\n"
                               "75.00  -180.00  -90.00  0.00  1.5e-04\n"
                               "75.00  -180.00   75.00  0.00  8.0e+03\n"
                               "60.00  -180.00   10.00  0.00  2.0e-02\n";
    measured_format format = named("phi_i", "theta_i", "phi_o", "theta_o", "brdf");
    format.signed_zenith = true;
    check_rows(text, format,
               (const row[]){{75, 180, 90, 180, 1.5e-4, 5},
                             {75, 180, 75, 0, 8e3, 6},
                             {60, 180, 10, 0, 2e-2, 7}});
    check_rows("%% in out f\n30 30 5.5\n30 10.25 .25\n45 0 1e-3\n",
               named("in", NULL, "out", NULL, "f"), PLANE_ROWS(2));
}
END_TEST

START_TEST(test_measured_accepts_every_separator_and_line_end)
{
    const measured_format format = numbered(1, 0, 2, 0, 3);
    check_rows("30\t30\t5.5\n30\t10.25\t0.25\n45\t0\t0.001\n", format, PLANE_ROWS(1));
    check_rows("  30   30 \t 5.5  \n\t30 10.25 0.25\n45 0    0.001\n", format, PLANE_ROWS(1));
    check_rows("30;30;5.5\r\n30;10.25;0.25\r\n45;0;0.001\r\n", format, PLANE_ROWS(1));
    check_rows("30 , 30 , 5.5\n30, 10.25,0.25\n45 ,0, 0.001 ,\n", format, PLANE_ROWS(1));
    check_rows("\xEF\xBB\xBF"
               "30,30,5.5\n30,10.25,0.25\n45,0,0.001\n",
               format, PLANE_ROWS(1));
    check_rows("in out f\r\n30,30,5.5\r\n30;10.25;0.25\n45 0 0.001\r\n", format, PLANE_ROWS(2));
}
END_TEST

START_TEST(test_measured_skips_comments_and_blank_lines)
{
    static const char text[] = "# one\n! two\n\n  % three\n// four 1 2 3\nin,out,f\n# 9,9,9\n"
                               "30,30,5.5\n \t\n#\n30,10.25,0.25\n45,0,0.001\n//\n\n";
    check_rows(text, numbered(1, 0, 2, 0, 3),
               (const row[]){{30, 0, 30, 180, 5.5, 8},
                             {30, 0, 10.25, 180, 0.25, 11},
                             {45, 0, 0, 0, 1e-3, 12}});
}
END_TEST

START_TEST(test_measured_signed_zenith_means_the_opposite_azimuth)
{
    measured_format format = numbered(1, 0, 2, 0, 3);
    format.signed_zenith = true;
    check_rows("30 30 1\n30 -30 2\n-30 -20 3\n", format,
               (const row[]){{30, 0, 30, 180, 1, 1}, {30, 0, 30, 0, 2, 2}, {30, 180, 20, 0, 3, 3}});
    format = numbered(1, 2, 3, 4, 5);
    format.signed_zenith = true;
    check_rows(
        "30 10 -40 10 1\n30 10 -40 50 2\n-90 10 90 0 3\n", format,
        (const row[]){{30, 10, 40, 190, 1, 1}, {30, 10, 40, 230, 2, 2}, {90, 190, 90, 0, 3, 3}});
}
END_TEST

/* rad where deg are expected: refused, unless the unit is said. */
static const char small[] = "0.5 1 0.25 2 7\n0.1 0 1.5533 6.2832 8\n1 1 1 1 9\n";

START_TEST(test_measured_leaves_small_angles_that_can_be_degrees_alone)
{
    static const char *const texts[] = {
        "0.5 0 0.25 180 7\n0 0 1.5 180 8\n1 0 1 180 9\n", /* the azimuths are no rad */
        "0.5 1 0.25 2 7\n0 0 1.6 1 8\n1 1 1 1 9\n",       /* 1.6 rad lies below the horizon */
        "0 0 0 0 7\n0 0 0 0 8\n0 0 0 0 9\n",              /* the same in any unit */
    };
    const measured_format format = numbered(1, 2, 3, 4, 5);
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        reading r = read_bytes(texts[k], strlen(texts[k]), &format);
        ck_assert_msg(r.status == GLINT_OK, "%s", texts[k]);
        end_reading(&r);
    }
}
END_TEST

START_TEST(test_measured_believes_a_unit_that_is_said)
{
    measured_format format = numbered(1, 2, 3, 4, 5);
    format.unit_given = true;
    reading r = read_bytes(small, sizeof small - 1, &format);
    ck_assert_int_eq(r.status, GLINT_OK);
    check_direction(r.rows.points[1].r, 1.5533, 6.2832);
    end_reading(&r);
    format.radians = true;
    r = read_bytes(small, sizeof small - 1, &format);
    ck_assert_int_eq(r.status, GLINT_OK);
    check_direction(r.rows.points[1].r, 1.5533 / DEG, 6.2832 / DEG);
    end_reading(&r);
}
END_TEST

START_TEST(test_measured_reads_radians)
{
    measured_format format = numbered(1, 2, 3, 4, 5);
    format.radians = true;
    static const char text[] = "0.5 1 0.25 2 7\n0 0 1.5707963268 0 8\n1 1 1 1 9\n";
    reading r = read_bytes(text, sizeof text - 1, &format);
    ck_assert_int_eq(r.status, GLINT_OK);
    assert_near(r.rows.points[0].i[0], sin(0.5) * cos(1.0), 4e-16);
    assert_near(r.rows.points[0].r[1], sin(0.25) * sin(2.0), 4e-16);
    /* a right angle that was rounded up is still one */
    assert_near(r.rows.points[1].r[2], 0.0, 1e-16);
    ck_assert(r.rows.points[1].r[2] >= 0.0);
    end_reading(&r);
}
END_TEST

START_TEST(test_measured_leaves_out_rows_without_light)
{
    measured_format format = numbered(1, 0, 2, 0, 3);
    static const char text[] = "30 30 5\n30 31 0\n30 32 0.0\n30 33 1e-4\n30 34 2e-4\n30 35 3\n";
    reading r = read_bytes(text, sizeof text - 1, &format);
    ck_assert_int_eq(r.rows.n, 4);
    ck_assert_int_eq(r.rows.n_dropped, 2);
    end_reading(&r);
    format.floor = 1e-4;
    r = read_bytes(text, sizeof text - 1, &format);
    ck_assert_int_eq(r.rows.n, 3);
    ck_assert_int_eq(r.rows.n_dropped, 3);
    assert_near(r.rows.points[1].f, 2e-4, 0.0);
    end_reading(&r);
}
END_TEST

START_TEST(test_measured_tells_in_plane_from_full)
{
    static const struct {
        const char *text;
        bool in_plane;
    } cases[] = {
        {"30 0 30 180 1\n30 0 20 0 1\n0 0 50 77 1\n", true},
        {"30 25 30 205 1\n30 -155 20 25 1\n50 77 0 0 1\n", true},
        {"30 0 30 180 1\n30 0 20 179.9 1\n10 0 50 180 1\n", false},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const measured_format format = numbered(1, 2, 3, 4, 5);
        reading r = read_bytes(cases[k].text, strlen(cases[k].text), &format);
        ck_assert_int_eq(r.status, GLINT_OK);
        ck_assert(r.rows.in_plane == cases[k].in_plane);
        end_reading(&r);
    }
}
END_TEST

/* ------------------------------------------------------------------ errors */

/* What one wrong file must say: its errors in order. file: 0: the file itself, 1: where it is
 * named. */
typedef struct wrong {
    const char *text;
    struct {
        int line, column;
        const char *part;
        bool named;
    } errors[4];
} wrong;

static void check_wrong(const wrong *w, measured_format format)
{
    reading r = read_bytes(w->text, strlen(w->text), &format);
    ck_assert_msg(r.status == GLINT_INPUT, "accepted: %s", w->text);
    ck_assert_ptr_null(r.rows.points);
    ck_assert_int_eq(r.rows.n, 0);
    size_t n = 0;
    while (n < 4 && w->errors[n].part)
        n++;
    for (size_t k = 0; k < glint_errors_count(r.errors) && k < n; k++) {
        const glint_error *error = glint_errors_get(r.errors, k);
        ck_assert_msg(strstr(error->message, w->errors[k].part), "%s: %s", w->text, error->message);
        ck_assert_str_eq(error->file, w->errors[k].named ? NAMED.file : r.path);
        ck_assert_msg(error->line == w->errors[k].line && error->column == w->errors[k].column,
                      "%d:%d: %s", error->line, error->column, error->message);
    }
    ck_assert_msg(glint_errors_count(r.errors) == n, "%zu errors: %s", glint_errors_count(r.errors),
                  w->text);
    end_reading(&r);
}

START_TEST(test_measured_reports_every_error_at_its_place)
{
    static const wrong cases[] = {
        {"", {{0, 0, "found 0 rows of numbers", false}}},
        {"# a\n\n", {{0, 0, "found 0 rows of numbers", false}}},
        {"1 2 3\n4 5 6\n", {{0, 0, "found 2 rows of numbers", false}}},
        {"1 2 3\n4 5 6\n7 8 0\n", {{0, 0, "found 2 usable rows (and 1 without light)", false}}},
        {"1 2 3\n4 5\n7 8 9 10\n1 2 3\n1 2 3\n",
         {{2, 1, "has 2 cells; expected 3", false}, {3, 1, "has 4 cells", false}}},
        {"a b\n1 2 3\n", {{2, 1, "has 3 cells; expected 2, as in the header", false}}},
        {"1 2 3\n4 x 6\n4 5  y\n",
         {{2, 3, "theta_r is 'x'; expected a finite number", false}, {3, 6, "f is 'y'", false}}},
        {"1,,nan\ninf,2,3\n4,1e999,6\n",
         {{1, 3, "theta_r is ''", false},
          {1, 4, "f is 'nan'", false},
          {2, 1, "theta_i is 'inf'", false},
          {3, 3, "'1e999'", false}}},
        {"-1 2 3\n91 5 6\n7 90.5 8\n",
         {{1, 1, "theta_i is -1 deg; expected 0 to 90 deg from the normal (signed angles", false},
          {2, 1, "theta_i is 91 deg", false},
          {3, 3, "theta_r is 90.5 deg", false}}},
        {"1 2 -3\n4 5 6\n", {{1, 5, "f is -3; expected a BRDF of at least 0", false}}},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        check_wrong(&cases[k], numbered(1, 0, 2, 0, 3));
}
END_TEST

START_TEST(test_measured_reports_angles_out_of_range_when_signed)
{
    measured_format format = numbered(1, 0, 2, 0, 3);
    format.signed_zenith = true;
    check_wrong(&(const wrong){"-1 -91 3\n4 5 6\n",
                               {{1, 4, "theta_r is -91 deg; expected -90 to 90 deg", false}}},
                format);
    format.radians = true;
    check_wrong(&(const wrong){"1.58 1 3\n4 5 6\n",
                               {{1, 1, "theta_i is 1.58 rad; expected -90 to 90 deg", false},
                                {2, 1, "theta_i is 4 rad", false},
                                {2, 3, "theta_r is 5 rad", false}}},
                format);
}
END_TEST

START_TEST(test_measured_reports_angles_that_look_like_radians)
{
    const measured_format format = numbered(1, 2, 3, 4, 5);
    check_wrong(&(const wrong){small, {{2, 7, "1.5533: these look like radians", false}}}, format);
    check_wrong(&(const wrong){"0 0 0 0 7\n0 0 1.5708 -3.1416 8\n0 0 0.5 0 9\n",
                               {{2, 5, "expected degrees, or the unit said outright", false}}},
                format);
}
END_TEST

START_TEST(test_measured_reports_degrees_where_radians_are_said)
{
    measured_format format = numbered(1, 0, 2, 0, 3);
    format.radians = true;
    check_wrong(&(const wrong){"30 0.1 3\n0 0.4 6\n",
                               {{1, 1,
                                 "30 rad; expected 0 to 90 deg from the normal (degrees need "
                                 "angles = \"deg\")",
                                 false}}},
                format);
}
END_TEST

START_TEST(test_measured_last_row_without_line_end_is_left_out)
{
    const measured_format format = numbered(1, 0, 2, 0, 3);
    static const char four[] = "30 30 5.5\n30 10 0.25\n45 0 0.001\n45 10 0.0123";
    reading r = read_bytes(four, sizeof four - 1, &format);
    ck_assert_int_eq(r.status, GLINT_OK);
    ck_assert_int_eq(r.rows.n, 3);
    ck_assert_uint_eq(glint_errors_count(r.errors), 1);
    const glint_error *warning = glint_errors_get(r.errors, 0);
    ck_assert_int_eq(warning->severity, GLINT_WARNING);
    ck_assert_int_eq(warning->line, 4);
    ck_assert_str_eq(warning->file, r.path);
    ck_assert_ptr_nonnull(strstr(warning->message, "end it with a new line if it is whole"));
    end_reading(&r);
    check_wrong(
        &(const wrong){"1 2 3\n4 5 6\n7 8 9",
                       {{3, 1, "no line end", false}, {0, 0, "found 2 rows of numbers", false}}},
        format);
    check_wrong(
        &(const wrong){"7 8 9",
                       {{1, 1, "no line end", false}, {0, 0, "found 0 rows of numbers", false}}},
        format);
}
END_TEST

START_TEST(test_measured_reports_columns_that_are_not_there)
{
    static const char header[] = "in,out,f\n1,2,3\n4,5,6\n7,8,9\n", plain[] = "1,2,3\n4,5,6\n";
    check_wrong(
        &(const wrong){header,
                       {{4, 9, "no column 'fi' (did you mean 'f'?); it has: in, out, f", true}}},
        named("in", NULL, "out", NULL, "fi"));
    check_wrong(&(const wrong){plain,
                               {{4, 9, "no header line that names its columns", true},
                                {4, 9, "in place of 'out'", true},
                                {4, 9, "in place of 'f'", true}}},
                named("in", NULL, "out", NULL, "f"));
    check_wrong(&(const wrong){plain,
                               {{4, 9, "in place of 'theta_i'", true},
                                {4, 9, "in place of 'theta_r'", true},
                                {4, 9, "in place of 'f'", true}}},
                (measured_format){0});
    check_wrong(&(const wrong){plain, {{4, 9, "column 7 for f is not in", true}}},
                numbered(1, 0, 2, 0, 7));
    check_wrong(&(const wrong){plain, {{4, 9, "no column is given for theta_r", true}}},
                numbered(1, 0, 0, 0, 3));
    measured_format twice = numbered(1, 0, 2, 0, 2);
    twice.column[MEASURED_F].where = (place){"scene.toml", 6, 2};
    check_wrong(&(const wrong){plain, {{6, 2, "theta_r and f are both column 2", true}}}, twice);
}
END_TEST

START_TEST(test_measured_refuses_what_is_no_table)
{
    const measured_format format = numbered(1, 0, 2, 0, 3);
    reading r = read_bytes("1 2 3\n4 5 \0006\n", 13, &format);
    ck_assert_int_eq(r.status, GLINT_INPUT);
    ck_assert(strstr(glint_errors_get(r.errors, 0)->message, "zero byte stands at offset 10"));
    end_reading(&r);
    char wide[2000] = "";
    for (int k = 0; k < 300; k++)
        strcat(wide, "1,");
    r = read_bytes(wide, strlen(wide), &format);
    ck_assert_int_eq(r.status, GLINT_INPUT);
    ck_assert(strstr(glint_errors_get(r.errors, 0)->message, "more than 256 cells"));
    end_reading(&r);
    measured rows;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(measured_read("no/such.csv", NAMED, &format, &rows, errors), GLINT_INPUT);
    const glint_error *error = glint_errors_get(errors, 0);
    ck_assert_str_eq(error->file, NAMED.file);
    ck_assert_int_eq(error->line, NAMED.line);
    ck_assert(strstr(error->message, "no/such.csv"));
    glint_errors_free(errors);
}
END_TEST

/* --------------------------------------------------------------- rows together */

/* What rows get together: status *want, and that many errors and warnings, of which the list holds
 * line and part of the text. */
typedef struct together {
    const char *text;
    int n;
    struct {
        int line;
        const char *part;
    } said[3];
} together;

static void check_together(const together *t, glint_status want)
{
    const measured_format format = numbered(1, 2, 3, 4, 5);
    reading r = read_bytes(t->text, strlen(t->text), &format);
    ck_assert_msg(r.status == GLINT_OK, "%s", t->text);
    ck_assert_msg(measured_check(&r.rows, r.path, r.errors) == want, "%s", t->text);
    ck_assert_msg((int)glint_errors_count(r.errors) == t->n, "%zu for: %s",
                  glint_errors_count(r.errors), t->text);
    for (int k = 0; k < t->n; k++) {
        const glint_error *e = glint_errors_get(r.errors, (size_t)k);
        ck_assert_int_eq(e->severity, want ? GLINT_ERROR : GLINT_WARNING);
        ck_assert_str_eq(e->file, r.path);
        ck_assert_msg(e->line == t->said[k].line && strstr(e->message, t->said[k].part), "%d: %s",
                      e->line, e->message);
    }
    end_reading(&r);
}

START_TEST(test_measured_doubles_that_disagree_name_both_lines)
{
    check_together(&(const together){"30 0 10 180 1\n"
                                     "30 0 20 180 2\n"
                                     "30 0 10 180 3\n" /* of line 1 */
                                     "30 0 0 180 4\n"
                                     "30 0 0 180 7\n" /* of line 4 */
                                     "30 0 10.0 180 1e0\n",
                                     2,
                                     {{5, "f is 7 here and 4 at the same angles in line 4"},
                                      {3, "f is 3 here and 1 at the same angles in line 1"}}},
                   GLINT_INPUT);
}
END_TEST

/* The same row word by word says nothing new; reciprocals, the pole seen from two azimuths and the
 * other side of the plane are measurements of their own, of one place. */
START_TEST(test_measured_doubles_that_agree_are_fine)
{
    check_together(&(const together){"30 0 10 180 1\n30 0 20 180 2\n30 0 10 180 1\n"
                                     "30 0 20.0 180 2e0\n",
                                     0,
                                     {{0, NULL}}},
                   GLINT_OK);
    check_together(&(const together){"30 0 10 180 1\n10 0 30 180 2\n30 0 0 180 3\n30 0 0 0 4\n"
                                     "30 0 10 -180 5\n",
                                     0,
                                     {{0, NULL}}},
                   GLINT_OK);
}
END_TEST

START_TEST(test_measured_gaps_of_scans_are_warned_of)
{
    /* one row of even steps is missing */
    check_together(
        &(const together){"30 0 0 180 1\n30 0 5 180 1\n30 0 10 180 1\n30 0 20 180 1\n"
                          "30 0 25 180 1\n30 0 30 180 1\n",
                          1,
                          {{4, "between theta_r = 10 (line 3) and 20 here, where rows stand 5 "
                               "apart on both sides; ln f"}}},
        GLINT_OK);
    /* rows in any order, two scans, the wider of two gaps */
    check_together(
        &(const together){"60 0 80 180 1\n60 0 10 180 1\n60 0 0 180 1\n60 0 70 180 1\n"
                          "30 0 0 180 1\n30 0 10 180 1\n30 0 50 180 1\n30 0 60 180 1\n",
                          1,
                          {{4, "between theta_r = 10 (line 2) and 70 here, where rows stand 10 "
                               "apart on both sides (the widest of 2 such gaps)"}}},
        GLINT_OK);
    /* rings: the azimuth moves */
    check_together(&(const together){"30 0 20 0 1\n30 0 20 30 1\n30 0 20 120 1\n30 0 20 150 1\n",
                                     1,
                                     {{3, "between phi_r = 30 (line 2) and 120 here"}}},
                   GLINT_OK);
}
END_TEST

START_TEST(test_measured_steps_that_change_are_no_gaps)
{
    /* even; finer near the peak; one row at each end; scattered */
    static const char *const texts[] = {
        "30 0 0 180 1\n30 0 5 180 1\n30 0 10 180 1\n30 0 15 180 1\n30 0 20 180 1\n",
        ("30 0 0 180 1\n30 0 10 180 1\n30 0 20 180 1\n30 0 28 180 1\n30 0 29 180 1\n"
         "30 0 30 180 1\n30 0 31 180 1\n30 0 32 180 1\n30 0 40 180 1\n30 0 50 180 1\n"),
        "30 0 0 180 1\n30 0 30 180 1\n30 0 40 180 1\n30 0 50 180 1\n30 0 80 180 1\n",
        "30 10 0 180 1\n35 20 30 170 1\n40 30 40 160 1\n45 40 50 150 1\n50 50 80 140 1\n",
    };
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++)
        check_together(&(const together){texts[k], 0, {{0, NULL}}}, GLINT_OK);
}
END_TEST

/* ------------------------------------------------------------------ damage */

static const char sample[] = "# phi_i theta_i phi_o theta_o brdf\r\n"
                             "75.00  -180.00  -89.50  0.00  1.5e-04\r\n"
                             "75.00  -180.00   75.00  0.00  8.0e+03\n"
                             "# between\n"
                             "60.00  -180.00   10.00  0.00  2.0e-02\n"
                             "41.40  -180.00   41.00  0.00  12.9424\n"
                             "5.00  -180.00   -5.00  0.00  0.25625\n";

static measured_format sample_format(void)
{
    measured_format format = named("phi_i", "theta_i", "phi_o", "theta_o", "brdf");
    format.signed_zenith = true;
    return format;
}

/* A file cut at any byte: the rows before the cut are read as they are, and what the cut left of
 * one is left out with a warning that names its line. */
START_TEST(test_measured_takes_no_cut_row_for_a_whole_one)
{
    const measured_format format = sample_format();
    reading whole = read_bytes(sample, sizeof sample - 1, &format);
    ck_assert_int_eq(whole.status, GLINT_OK);
    ck_assert_int_eq(whole.rows.n, 5);
    for (size_t n = 0; n < sizeof sample - 1; n++) {
        reading cut = read_bytes(sample, n, &format);
        int line = 1, n_rows = 0; /* of the cut; whole rows before it */
        size_t start = 0;         /* of its line */
        for (size_t k = 0; k < n; k++) {
            if (sample[k] != '\n') continue;
            n_rows += sample[start] != '#';
            start = k + 1;
            line++;
        }
        ck_assert_int_eq(cut.status, n_rows >= 3 ? GLINT_OK : GLINT_INPUT);
        ck_assert_int_eq(cut.rows.n, n_rows >= 3 ? n_rows : 0);
        for (int k = 0; k < cut.rows.n; k++)
            ck_assert(
                memcmp(&cut.rows.points[k], &whole.rows.points[k], sizeof cut.rows.points[k]) == 0);
        if (start < n && sample[start] != '#') { /* no row begins with a blank */
            const glint_error *warning = glint_errors_get(cut.errors, 0);
            ck_assert_int_eq(warning->severity, GLINT_WARNING);
            ck_assert_int_eq(warning->line, line);
            ck_assert_ptr_nonnull(strstr(warning->message, "no line end"));
        }
        ck_assert(cut.status == GLINT_OK || glint_errors_error_count(cut.errors) > 0);
        end_reading(&cut);
    }
    end_reading(&whole);
}
END_TEST

START_TEST(test_measured_survives_any_one_byte_changed)
{
    static const char swaps[] = {'"', ',', ';', '\n', '\r', '#', ' ', '-', '9', 'x', '\0', '\xff'};
    const measured_format format = sample_format();
    for (size_t at = 0; at < sizeof sample - 1; at++)
        for (size_t k = 0; k < sizeof swaps; k++) {
            char changed[sizeof sample];
            memcpy(changed, sample, sizeof sample);
            changed[at] = swaps[k];
            reading r = read_bytes(changed, sizeof sample - 1, &format);
            if (r.status == GLINT_OK) {
                ck_assert_int_ge(r.rows.n, 3);
                for (int j = 0; j < r.rows.n; j++)
                    ck_assert(r.rows.points[j].f > 0.0 && r.rows.points[j].i[2] >= 0.0 &&
                              r.rows.points[j].r[2] >= 0.0);
            } else {
                ck_assert_int_eq(r.status, GLINT_INPUT);
                ck_assert_ptr_null(r.rows.points);
                ck_assert_uint_gt(glint_errors_error_count(r.errors), 0);
            }
            end_reading(&r);
        }
}
END_TEST

/* ------------------------------------------------------------------ real files */

/* Checks a row of a file against numbers that stand in it. */
static void check_point(const measured *m, int k, double theta_i, double theta_r, double f)
{
    check_direction(m->points[k].i, theta_i, -180);
    check_direction(m->points[k].r, theta_r, 0);
    assert_near(m->points[k].f, f, 0.0);
}

START_TEST(test_measured_reads_laboratory_files)
{
    const char *dir = reference_dir("laboratory files");
    if (!dir) return;
    static const struct {
        const char *name;
        double f[3]; /* of rows 0 (75, -90), 165 (75, 75), 723 (5, 90) */
    } files[] = {{"validation/starlink_v15/chassis_brdf.csv", {1e-4, 8.03803e3, 1e-4}},
                 {"validation/starlink_v15/solar_array_brdf.csv", {1e-4, 53341.4, 1e-4}}};
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        measured_format formats[2] = {numbered(1, 2, 3, 4, 5), sample_format()};
        formats[0].signed_zenith = true;
        for (int j = 0; j < 2; j++) {
            measured m;
            glint_errors *errors = glint_errors_new();
            const char *path = path_in(dir, files[k].name);
            ck_assert_int_eq(measured_read(path, PLACE_NONE, &formats[j], &m, errors), GLINT_OK);
            ck_assert_int_eq(m.n, 724);
            ck_assert_int_eq(m.n_dropped, 0);
            ck_assert(m.in_plane);
            check_point(&m, 0, 75, -90, files[k].f[0]);
            check_point(&m, 165, 75, 75, files[k].f[1]);
            check_point(&m, 723, 5, 90, files[k].f[2]);
            measured_free(&m);
            glint_errors_free(errors);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("measured");
    TCase *all = tcase_create("all");
    tcase_set_timeout(all, 60); /* s: sanitizers are slow */
    tcase_add_test(all, test_measured_reads_columns_by_their_usual_names);
    tcase_add_test(all, test_measured_reads_columns_by_number);
    tcase_add_test(all, test_measured_reads_columns_by_name);
    tcase_add_test(all, test_measured_takes_names_from_the_last_comment);
    tcase_add_test(all, test_measured_accepts_every_separator_and_line_end);
    tcase_add_test(all, test_measured_skips_comments_and_blank_lines);
    tcase_add_test(all, test_measured_signed_zenith_means_the_opposite_azimuth);
    tcase_add_test(all, test_measured_reads_radians);
    tcase_add_test(all, test_measured_leaves_small_angles_that_can_be_degrees_alone);
    tcase_add_test(all, test_measured_believes_a_unit_that_is_said);
    tcase_add_test(all, test_measured_reports_angles_that_look_like_radians);
    tcase_add_test(all, test_measured_reports_degrees_where_radians_are_said);
    tcase_add_test(all, test_measured_last_row_without_line_end_is_left_out);
    tcase_add_test(all, test_measured_doubles_that_disagree_name_both_lines);
    tcase_add_test(all, test_measured_doubles_that_agree_are_fine);
    tcase_add_test(all, test_measured_gaps_of_scans_are_warned_of);
    tcase_add_test(all, test_measured_steps_that_change_are_no_gaps);
    tcase_add_test(all, test_measured_leaves_out_rows_without_light);
    tcase_add_test(all, test_measured_tells_in_plane_from_full);
    tcase_add_test(all, test_measured_reports_every_error_at_its_place);
    tcase_add_test(all, test_measured_reports_angles_out_of_range_when_signed);
    tcase_add_test(all, test_measured_reports_columns_that_are_not_there);
    tcase_add_test(all, test_measured_refuses_what_is_no_table);
    tcase_add_test(all, test_measured_takes_no_cut_row_for_a_whole_one);
    tcase_add_test(all, test_measured_survives_any_one_byte_changed);
    tcase_add_test(all, test_measured_reads_laboratory_files);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
