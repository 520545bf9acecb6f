/* Files of positions that are no messages of the CCSDS: STK's ephemerides and SP3. */
#include "base/constants.h"
#include "base/random.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/clock.h"
#include "orbit/sp3.h"
#include "orbit/stk.h"
#include "scenario_text.h"

#include <ctype.h>

typedef glint_status position_reader(const char *path, const char *object, orbit_table **out,
                                     glint_errors *errors);

static glint_status stk(const char *path, const char *object, orbit_table **out,
                        glint_errors *errors)
{
    (void)object;
    return stk_read(path, PLACE_NONE, out, errors);
}

static glint_status sp3(const char *path, const char *object, orbit_table **out,
                        glint_errors *errors)
{
    return sp3_read(path, PLACE_NONE, object, out, errors);
}

static orbit_table *read_table(position_reader *read, const char *path, const char *object,
                               size_t n_entries)
{
    orbit_table *table;
    glint_errors *errors = glint_errors_new();
    ck_assert_msg(read(path, object, &table, errors) == GLINT_OK, "%s:%s", path,
                  list_errors(errors));
    ck_assert_msg(glint_errors_count(errors) == n_entries, "%s:%s", path, list_errors(errors));
    glint_errors_free(errors);
    return table;
}

static void assert_state(const orbit_table *table, double t_s, const double r_m[3],
                         const double v_m_s[3], double tol_m, double tol_m_s)
{
    double r[3], v[3];
    table_frame frame;
    glint_error error = {0};
    ck_assert_msg(orbit_table_state(table, t_s, &frame, r, v, &error) == GLINT_OK, "%s",
                  error.message);
    for (int i = 0; i < 3; i++) {
        assert_near(r[i], r_m[i], tol_m);
        assert_near(v[i], v_m_s[i], tol_m_s);
    }
}

/* Seconds of a UTC from the table's reference. */
static double at(const orbit_table *table, const char *utc)
{
    double tt_jd[2];
    ck_assert_int_eq(time_parse(utc, SCALE_UTC, PLACE_NONE, tt_jd, NULL), GLINT_OK);
    return orbit_table_seconds(table, tt_jd);
}

/* A circle about z, radius a (m), rate n (rad/s). */
static void circle(double a, double n, double t_s, double r_m[3], double v_m_s[3])
{
    const double c = cos(n * t_s), s = sin(n * t_s);
    r_m[0] = a * c, r_m[1] = a * s, r_m[2] = 0;
    v_m_s[0] = -a * n * s, v_m_s[1] = a * n * c, v_m_s[2] = 0;
}

/* A reading must fail with exactly one error, at the '@' (line 0 without one). */
static void assert_refused(position_reader *read, const char *content, const char *object,
                           const char *word)
{
    marked_text m = {.text = ""};
    strcpy(m.text, content);
    take_mark(&m);
    orbit_table *table = (orbit_table *)folder;
    glint_errors *errors = glint_errors_new();
    ck_assert_msg(read(write_file("in", m.text), object, &table, errors) == GLINT_INPUT,
                  "wanted '%s' for\n%s", word, m.text);
    ck_assert_ptr_null(table);
    ck_assert_msg(has_error(errors, in_folder("in"), m.line, m.column, word, NULL),
                  "wanted %d:%d '%s'; got:%s", m.line, m.column, word, list_errors(errors));
    ck_assert_msg(glint_errors_error_count(errors) == 1, "%s", list_errors(errors));
    glint_errors_free(errors);
}

/* Cut anywhere the file is refused, since its last words are gone; but for a line end. */
static void cut_everywhere(position_reader *read, const char *bytes, const char *object)
{
    size_t n = strlen(bytes);
    while (n > 0 && isspace((unsigned char)bytes[n - 1]))
        n--;
    for (size_t cut = 0; cut < n; cut++) {
        orbit_table *table;
        glint_errors *errors = glint_errors_new();
        ck_assert_msg(read(write_bytes("cut", bytes, cut), object, &table, errors) == GLINT_INPUT,
                      "%zu bytes of %zu", cut, n);
        ck_assert_uint_gt(glint_errors_error_count(errors), 0);
        glint_errors_free(errors);
    }
}

static void damage(position_reader *read, const char *whole, const char *object, uint64_t seed)
{
    static const char likely[] = "0123456789.-+eE= \n\tPV*#\"T\0";
    const char *times = getenv("GLINT_DAMAGE"); /* more of it, on request */
    const size_t n = strlen(whole);
    for (int k = times ? atoi(times) : 1500; k > 0; k--) {
        char *bytes = string_copy(whole, n);
        for (int changes = 1 + (int)(random_next(&seed) % 4); changes > 0; changes--)
            bytes[random_next(&seed) % n] = random_next(&seed) % 4
                                                ? likely[random_next(&seed) % sizeof likely]
                                                : (char)random_next(&seed);
        orbit_table *table;
        if (!read(write_bytes("damaged", bytes, n), object, &table, NULL)) {
            double from_s, to_s, r_m[3], v_m_s[3];
            table_frame frame;
            orbit_table_span(table, &from_s, &to_s);
            for (int i = 0; i <= 10; i++)
                if (!orbit_table_state(table, from_s + 0.1 * i * (to_s - from_s), &frame, r_m,
                                       v_m_s, NULL))
                    ck_assert(isfinite(dot3(r_m, r_m)) && isfinite(dot3(v_m_s, v_m_s)));
            orbit_table_free(table);
        }
        free(bytes);
    }
}

/* ------------------------------------------------------------------------- STK */

static const double LOW_M = 6.8e6, LOW_RAD_S = 1.126e-3; /* a low orbit */

/* A file of n rows a minute apart; heading: more keywords. */
static char *stk_file(const char *axes, const char *heading, const char *form, int n_numbers, int n,
                      double unit_m)
{
    text out = {0};
    text_printf(&out,
                "stk.v.11.0\n\n# made up\nBEGIN Ephemeris\n  NumberOfEphemerisPoints %d\n"
                "ScenarioEpoch\t24 Jul 2025 12:00:00.000\nCentralBody Earth\n"
                "CoordinateSystem  %s\n%s\n%s\n\n",
                n, axes, heading, form);
    for (int k = 0; k < n; k++) {
        double state[9] = {0};
        circle(LOW_M, LOW_RAD_S, 60.0 * k, state, state + 3);
        text_printf(&out, " %.16e", 60.0 * k);
        for (int i = 0; i < n_numbers; i++)
            text_printf(&out, " %.16e", state[i] / unit_m);
        text_add(&out, "\n");
    }
    text_add(&out, "\nEND Ephemeris\n");
    return out.data;
}

START_TEST(test_positions_stk_takes_forms_axes_units_and_methods)
{
    static const struct {
        const char *axes, *heading, *form;
        int n_numbers;
        double unit_m;
        table_frame frame;
        table_method method;
        int degree;
    } cases[] = {
        {"ICRF", "InterpolationMethod Lagrange\nInterpolationSamplesM1 9", "EphemerisTimePosVel", 6,
         1, TABLE_GCRS, TABLE_LAGRANGE, 9},
        {"Inertial", "InterpolationMethod HERMITE\nInterpolationSamplesM1 4", "ephemeristimeposvel",
         6, 1, TABLE_GCRS, TABLE_HERMITE, 9},
        {"Fixed", "InterpolationOrder 9\nDistanceUnit Kilometers", "EphemerisTimePos", 3, 1e3,
         TABLE_ITRS, TABLE_LAGRANGE, 9},
        {"TEMEOfDate", "InterpolationSamplesM1 10\nDistanceUnit Meters\nBlockingFactor 20",
         "EphemerisTimePosVelAcc", 9, 1, TABLE_TEME, TABLE_LAGRANGE, 10},
    };
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        char *content = stk_file(cases[k].axes, cases[k].heading, cases[k].form, cases[k].n_numbers,
                                 31, cases[k].unit_m);
        orbit_table *table = read_table(stk, write_file("in.e", content), NULL, 0);
        ck_assert_uint_eq(table->n, 1);
        ck_assert_uint_eq(table->segments[0].n, 31);
        ck_assert_int_eq(table->segments[0].frame, cases[k].frame);
        ck_assert_int_eq(table->segments[0].method, cases[k].method);
        ck_assert_int_eq(table->segments[0].degree, cases[k].degree);
        assert_near(at(table, "2025-07-24T12:00:00"), 0, 1e-9);
        for (double t_s = 0; t_s < 1800; t_s += 13) {
            double r_m[3], v_m_s[3];
            circle(LOW_M, LOW_RAD_S, t_s, r_m, v_m_s);
            /* the remainder at the ends is a (n h)^10/10! times up to 5e4 on the circle: 2e-7 m;
             * its slope over a step, and the rounding of dates (5e-12 s) that of a minute */
            assert_state(table, t_s, r_m, v_m_s, 1e-6, 1e-7);
        }
        orbit_table_free(table);
        free(content);
    }
}
END_TEST

START_TEST(test_positions_stk_parts_segments_at_boundaries)
{
    static const char file[] =
        "stk.v.12.0\nBEGIN Ephemeris\nScenarioEpoch 24 Jul 2025 12:00:00\nCoordinateSystem ICRF\n"
        "InterpolationSamplesM1 1\nBEGIN SegmentBoundaryTimes\n 0\n 120\n 240\n 330\n"
        "END SegmentBoundaryTimes\nEphemerisTimePosVel\n"
        "0 7000000 0 0 1 0 0\n60 7000060 0 0 1 0 0\n120 7000120 0 0 1 0 0\n"    /* to 120 */
        "120 7000120 0 0 2 0 0\n180 7000240 0 0 2 0 0\n240 7000360 0 0 2 0 0\n" /* twice */
        "300 7000540 0 0 3 0 0\n"                                               /* 240 once */
        "360 7001000 0 0 5 0 0\n420 7001300 0 0 5 0 0\nEND Ephemeris\n";        /* a gap */
    orbit_table *table = read_table(stk, write_file("in.e", file), NULL, 0);
    static const size_t n[] = {3, 3, 2, 2};
    ck_assert_uint_eq(table->n, 4);
    for (size_t k = 0; k < 4; k++)
        ck_assert_uint_eq(table->segments[k].n, n[k]);
    static const double cases[][3] = {{30, 7000030, 1},  {119, 7000119, 1}, {120, 7000120, 2},
                                      {150, 7000180, 2}, {239, 7000358, 2}, {270, 7000450, 2.5},
                                      {390, 7001150, 5}};
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        double r_m[3] = {cases[k][1], 0, 0}, v_m_s[3] = {cases[k][2], 0, 0};
        assert_state(table, cases[k][0], r_m, v_m_s, 1e-8, 1e-8);
    }
    glint_error error;
    table_frame frame;
    double r_m[3], v_m_s[3];
    ck_assert_int_eq(orbit_table_state(table, 330, &frame, r_m, v_m_s, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "gap"));
    orbit_table_free(table);
}
END_TEST

#define STK_HEAD "stk.v.11.0\nBEGIN Ephemeris\n"
#define STK_EPOCH "ScenarioEpoch 1 Jan 2025 00:00:00.000\n"
#define STK_AXES "CoordinateSystem ICRF\nInterpolationSamplesM1 1\n"
#define STK_ROWS "EphemerisTimePosVel\n0 7e6 0 0 0 0 0\n60 7e6 0 0 0 0 0\n"
#define STK_END "END Ephemeris\n"

START_TEST(test_positions_stk_places_every_error)
{
    static const char *const wrong[][2] = {
        {"@hello\n", "no file of STK"},
        {"stk.v.11.0\n@Row\n", "before BEGIN Ephemeris"},
        {STK_HEAD "ScenarioEpoch @1 Foo 2025 00:00:00\n" STK_AXES STK_ROWS STK_END,
         "is not a time"},
        {STK_HEAD "ScenarioEpoch @30 Feb 2025 00:00:00\n" STK_AXES STK_ROWS STK_END, "28 days"},
        {STK_HEAD STK_AXES "@" STK_ROWS STK_END, "no ScenarioEpoch"},
        {STK_HEAD STK_EPOCH "@" STK_ROWS STK_END, "no CoordinateSystem"},
        {STK_HEAD STK_EPOCH "CoordinateSystem @TrueOfDate\n" STK_ROWS STK_END, "'TrueOfDate'"},
        {STK_HEAD STK_EPOCH STK_AXES "@CoordinateSystemEpoch x\n" STK_ROWS STK_END, "of one epoch"},
        {STK_HEAD STK_EPOCH STK_AXES "CentralBody @Mars\n" STK_ROWS STK_END, "expected Earth"},
        {STK_HEAD STK_EPOCH STK_AXES "TimeFormat @UTCG\n" STK_ROWS STK_END, "expected EpSec"},
        {STK_HEAD STK_EPOCH STK_AXES "InterpolationMethod @VOP\n" STK_ROWS STK_END,
         "Lagrange or Hermite"},
        {STK_HEAD STK_EPOCH STK_AXES "InterpolationSamplesM1 @0\n" STK_ROWS STK_END,
         "from 1 to 15"},
        {STK_HEAD STK_EPOCH STK_AXES "DistanceUnit @Feet\n" STK_ROWS STK_END, "Kilometers"},
        {STK_HEAD STK_EPOCH STK_AXES "@EphemerisLLATimePos\n1 2 3\n" STK_END, "LLATimePos are not"},
        {STK_HEAD STK_EPOCH STK_AXES "InterpolationMethod Hermite\n@EphemerisTimePos\n" STK_END,
         "asks for velocities"},
        {STK_HEAD STK_EPOCH STK_AXES STK_ROWS "@90 7e6 0 0\n" STK_END, "has 4 numbers"},
        {STK_HEAD STK_EPOCH STK_AXES STK_ROWS "90 @7x6 0 0 0 0 0\n" STK_END, "'7x6' stands here"},
        {STK_HEAD STK_EPOCH STK_AXES STK_ROWS "@90 7000 0 0 0 0 0\n" STK_END, "the unit is m"},
        {STK_HEAD STK_EPOCH STK_AXES "NumberOfEphemerisPoints 3\n" STK_ROWS STK_END, "has 2 rows"},
        {STK_HEAD STK_EPOCH STK_AXES STK_ROWS, "without END Ephemeris"},
        {STK_HEAD STK_EPOCH STK_AXES STK_END, "no segment"},
        {STK_HEAD STK_EPOCH STK_AXES STK_ROWS "50 7e6 0 0 0 0 0\n" STK_END, "-10 s later"},
        {STK_HEAD STK_EPOCH STK_AXES STK_ROWS "@90 7e6 0 0 1e7 0 0\n" STK_END, "1000 km/s"},
        {STK_HEAD STK_EPOCH STK_AXES STK_ROWS "@9e99 7e6 0 0 0 0 0\n" STK_END, "time of this row"},
    };
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        marked_text m = {.text = ""};
        strcpy(m.text, wrong[k][0]);
        take_mark(&m);
        orbit_table *table;
        glint_errors *errors = glint_errors_new();
        ck_assert_msg(stk(write_file("in", m.text), NULL, &table, errors) == GLINT_INPUT,
                      "wanted '%s' for\n%s", wrong[k][1], m.text);
        ck_assert_msg(has_error(errors, in_folder("in"), m.line, m.column, wrong[k][1], NULL),
                      "wanted %d:%d '%s'; got:%s", m.line, m.column, wrong[k][1],
                      list_errors(errors));
        glint_errors_free(errors);
    }
}
END_TEST

START_TEST(test_positions_stk_survives_cuts_and_damage)
{
    char *content = stk_file("Fixed", "InterpolationSamplesM1 3", "EphemerisTimePosVel", 6, 8, 1);
    cut_everywhere(stk, content, NULL);
    damage(stk, content, NULL, 1);
    free(content);
}
END_TEST

START_TEST(test_positions_stk_reads_samples)
{
    const char *dir = reference_dir("samples of STK ephemerides");
    if (!dir) return;
    char path[1024];
    snprintf(path, sizeof path, "%s/samples/stk_J2000_pv.e", dir);
    orbit_table *table = read_table(stk, path, NULL, 0);
    double r_m[3] = {-2.0001994009168909e+06, -5.2891923627324430e+06, -4.6667659975418849e+06};
    double v_m_s[3] = {6.6125121299598577e+03, -2.9442358523333974e+03, 6.1695791256223322e+02};
    table_node_from_eme2000(r_m, v_m_s);
    assert_state(table, 360, r_m, v_m_s, 1e-7, 1e-8); /* rounding of dates, 1e-11 s */
    assert_near(at(table, "2007-01-12T00:00:00.000883"), 0, 1e-9);
    char *bytes = read_bytes(path, NULL);
    cut_everywhere(stk, bytes, NULL);
    free(bytes);
    orbit_table_free(table);
    snprintf(path, sizeof path, "%s/samples/stk_impulsive_maneuver.e", dir);
    table = read_table(stk, path, NULL, 0);
    ck_assert_uint_eq(table->n, 2);
    double unused[3], before_m_s[3], after_m_s[3];
    table_frame frame;
    /* the manoeuvre at 300 s: 15.54 m/s backwards, 41.76 and 22.67 m/s in the file */
    ck_assert_int_eq(orbit_table_state(table, 300 - 1e-6, &frame, unused, before_m_s, NULL), 0);
    ck_assert_int_eq(orbit_table_state(table, 300 + 1e-6, &frame, unused, after_m_s, NULL), 0);
    sub3(after_m_s, before_m_s, after_m_s);
    const double want[3] = {-2.4109546214707530e+03 + 2.3954153910685013e+03,
                            6.4801591037886537e+03 - 6.4383927907853858e+03,
                            3.5179240960554193e+03 - 3.4952501591096920e+03};
    assert_near(norm3(after_m_s), norm3(want), 1e-4); /* gravity over 2e-6 s: 2e-5 m/s */
    orbit_table_free(table);
}
END_TEST

/* ------------------------------------------------------------------------- SP3 */

static const double GPS_M = 2.656e7, GPS_RAD_S = 1.4586e-4;

/* Two satellites, n epochs 15 min apart; the second satellite has no position at `gap`. */
static char *sp3_file(int n, int gap)
{
    text out = {0};
    text_printf(&out,
                "#cP2025  7 24 12  0  0.00000000 %7d ORBIT IGS20 HLM  IGS\n"
                "## 2376 388800.00000000   900.00000000 60880 0.5000000000000\n"
                "+    2   G01R 7  0  0  0  0  0  0  0  0  0  0  0  0  0  0  0\n"
                "++         7  8  0  0  0  0  0  0  0  0  0  0  0  0  0  0  0\n"
                "%%c G  cc GPS ccc cccc cccc cccc cccc ccccc ccccc ccccc ccccc\n"
                "%%c cc cc ccc ccc cccc cccc cccc cccc ccccc ccccc ccccc ccccc\n"
                "/* MADE UP\n",
                n);
    for (int k = 0; k < n; k++) {
        double r_m[3], v_m_s[3];
        circle(GPS_M, GPS_RAD_S, 900.0 * k, r_m, v_m_s);
        const int seconds = 12 * 3600 + 900 * k;
        text_printf(&out, "*  2025  7 24 %2d %2d  0.00000000\n", seconds / 3600, seconds / 60 % 60);
        text_printf(&out, "PG01%14.6f%14.6f%14.6f    189.163300\n", r_m[0] * 1e-3, r_m[1] * 1e-3,
                    r_m[2] * 1e-3);
        if (k == gap) scale3(r_m, 0, r_m);
        text_printf(&out, "PR 7%14.6f%14.6f%14.6f 999999.999999\n", r_m[1] * 1e-3, r_m[0] * 1e-3,
                    r_m[2] * 1e-3);
    }
    text_add(&out, "EOF\n");
    return out.data;
}

/* Lagrange's remainder of degree 9 is a (n 900 s)^10/10! times up to 4e5 at the ends, 4 mm; the
 * file's positions are rounded to 0.5 mm. */
START_TEST(test_positions_sp3_follows_a_circle)
{
    char *content = sp3_file(24, -1);
    orbit_table *table = read_table(sp3, write_file("in.sp3", content), "g01", 0);
    ck_assert_str_eq(table->object, "G01");
    ck_assert_uint_eq(table->n, 1);
    ck_assert_int_eq(table->segments[0].frame, TABLE_ITRS);
    assert_near(at(table, "2025-07-24T11:59:42"), 0, 1e-9); /* GPS is 18 s ahead of UTC */
    for (double t_s = 0; t_s <= 23 * 900; t_s += 77) {
        double r_m[3], v_m_s[3];
        circle(GPS_M, GPS_RAD_S, t_s, r_m, v_m_s);
        const bool inside = t_s > 4 * 900 && t_s < 19 * 900;
        assert_state(table, t_s, r_m, v_m_s, inside ? 1e-3 : 2e-2, inside ? 1e-5 : 1e-4);
    }
    orbit_table_free(table);
    free(content);
}
END_TEST

START_TEST(test_positions_sp3_parts_segments_where_positions_are_missing)
{
    char *content = sp3_file(24, 12);
    orbit_table *table = read_table(sp3, write_file("in.sp3", content), "R 7", 0);
    ck_assert_uint_eq(table->n, 2);
    ck_assert_uint_eq(table->segments[0].n, 12);
    ck_assert_uint_eq(table->segments[1].n, 11);
    glint_error error;
    table_frame frame;
    double r_m[3], v_m_s[3];
    ck_assert_int_eq(orbit_table_state(table, 12 * 900, &frame, r_m, v_m_s, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "gap"));
    orbit_table_free(table);
    free(content);
}
END_TEST

/* Changes of single lines of a good file. */
START_TEST(test_positions_sp3_places_every_error)
{
    static const struct {
        const char *from, *to, *word;
        int line;
    } cases[] = {
        {"#cP", "#xP", "no SP3 file", 1},
        {"#cP", "xcP", "no SP3 file", 1},
        {"     12 ORBIT", "     1x ORBIT", "number of epochs", 1},
        {"     12 ORBIT", "     13 ORBIT", "says that it has 13 epochs, and has 12", 44},
        {"IGS20", "J2000", "an Earth-fixed one", 1},
        {"%c G  cc GPS", "%c G  cc BDT", "time system is 'BDT'", 5},
        {"  900.00000000", "  9x0.00000000", "interval", 2},
        {"*  2025  7 24 12  0", "*  2025  7 32 12  0", "has 31 days", 8},
        {"*  2025  7 24 12  0", "*  2025  7 24 1x  0", "is no epoch", 8},
        {"PG01  26560.000000", "PG01  2x560.000000", "the x (columns 5 to 18)", 9},
        {"PG01  26560.000000", "PG01    560.000000", "the unit is km", 9},
        {"EOF", "EOX", "without its EOF", 44},
    };
    char *good = sp3_file(12, -1);
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        text content = {0};
        const char *found = strstr(good, cases[k].from);
        ck_assert_msg(found != NULL, "'%s'", cases[k].from);
        text_append(&content, good, (size_t)(found - good));
        text_add(&content, cases[k].to);
        text_add(&content, found + strlen(cases[k].from));
        orbit_table *table;
        glint_errors *errors = glint_errors_new();
        ck_assert_msg(sp3(write_bytes("in", content.data, content.length), "G01", &table, errors) ==
                          GLINT_INPUT,
                      "wanted '%s'", cases[k].word);
        ck_assert_msg(has_error(errors, in_folder("in"), 0, 0, cases[k].word, NULL),
                      "wanted '%s'; got:%s", cases[k].word, list_errors(errors));
        ck_assert_int_eq(glint_errors_get(errors, 0)->line, cases[k].line);
        ck_assert_uint_eq(glint_errors_error_count(errors), 1);
        glint_errors_free(errors);
        text_free(&content);
    }
    assert_refused(sp3, good, "G02", "has no satellite 'G02'; it has G01, R 7");
    assert_refused(sp3, good, NULL, "several satellites: G01, R 7; say which one by sp3_satellite");
    free(good);
}
END_TEST

START_TEST(test_positions_sp3_survives_cuts_and_damage)
{
    char *content = sp3_file(4, 2);
    cut_everywhere(sp3, content, "G01");
    damage(sp3, content, "G01", 2);
    free(content);
}
END_TEST

/* The samples have two epochs, two days apart: nothing can lie between them. */
START_TEST(test_positions_sp3_refuses_samples_of_single_epochs)
{
    const char *dir = reference_dir("samples of SP3");
    static const char *const files[] = {"sp3c.sp3", "sp3d.sp3"};
    for (size_t k = 0; dir && k < COUNT_OF(files); k++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/samples/%s", dir, files[k]);
        orbit_table *table;
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(sp3(path, "G01", &table, errors), GLINT_INPUT);
        ck_assert(has_error(errors, path, 24, 0, "one record", NULL));
        glint_errors_free(errors);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("positions");
    TCase *all = tcase_create("all");
    tcase_add_checked_fixture(all, folder_make, folder_remove);
    tcase_set_timeout(all, 300);
    tcase_add_test(all, test_positions_stk_takes_forms_axes_units_and_methods);
    tcase_add_test(all, test_positions_stk_parts_segments_at_boundaries);
    tcase_add_test(all, test_positions_stk_places_every_error);
    tcase_add_test(all, test_positions_stk_survives_cuts_and_damage);
    tcase_add_test(all, test_positions_stk_reads_samples);
    tcase_add_test(all, test_positions_sp3_follows_a_circle);
    tcase_add_test(all, test_positions_sp3_parts_segments_where_positions_are_missing);
    tcase_add_test(all, test_positions_sp3_places_every_error);
    tcase_add_test(all, test_positions_sp3_survives_cuts_and_damage);
    tcase_add_test(all, test_positions_sp3_refuses_samples_of_single_epochs);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
