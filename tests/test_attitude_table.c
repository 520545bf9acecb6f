/* Attitudes from files: CCSDS AEM, STK and CSV; what they mean, what lies between their rows, and
 * what damaged ones do. */
#include "base/constants.h"
#include "base/vec.h"
#include "orbit/attitude_table.h"
#include "orbit/frames.h"
#include "orbit/time_column.h"
#include "orbit/torque_free.h"
#include "scenario_text.h"
#include "table.h"

/* ------------------------------------------------------------------ helpers */

/* Rounding of a few dozen operations on numbers of size 1. */
static const double rounding = 1e-14;

static const run_clock *clock_2024(void)
{
    static run_clock clock;
    const utc_time start = {.year = 2024, .month = 1, .day = 1, .hour = 12};
    run_clock_start(&start, 600, 0, &clock);
    return &clock;
}

/* Uniform in -1..1, the same sequence on every machine (Knuth's MMIX generator). */
static double next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(int64_t)(*state >> 11) / 4503599627370496.0 - 1.0;
}

static void random_quaternion(uint64_t *state, double q[4])
{
    double norm;
    do {
        for (int i = 0; i < 4; i++)
            q[i] = next_random(state);
        norm = sqrt(quat_dot(q, q));
    } while (norm > 1 || norm < 0.1);
    for (int i = 0; i < 4; i++)
        q[i] /= norm;
}

static attitude_table *read_sound_table(const char *path, const char *object)
{
    attitude_table *t;
    glint_errors *errors = glint_errors_new();
    const glint_status status =
        attitude_table_read(path, object, NULL, clock_2024(), PLACE_NONE, &t, errors);
    ck_assert_msg(status == GLINT_OK, "%s:%s", path, list_errors(errors));
    glint_errors_free(errors);
    return t;
}

static void body_axes(const attitude_table *t, double t_s, double body_gcrs[9])
{
    const moment m = {.t_s = t_s,
                      .r_m = {7e6, 0, 0},
                      .v_m_s = {0, 7.5e3, 0},
                      .itrs_gcrs = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    glint_error error = {0};
    ck_assert_msg(attitude_table_at(t, &m, body_gcrs, &error) == GLINT_OK, "%s", error.message);
}

static void assert_mat_near(const double got[9], const double want[9], double tol)
{
    for (int i = 0; i < 9; i++)
        assert_near(got[i], want[i], tol);
}

/* The file must be refused with an error at that line that holds the text. */
static void assert_file_wrong(const char *name, const char *content, int line, const char *found)
{
    attitude_table *t = (attitude_table *)folder; /* must be cleared */
    glint_errors *errors = glint_errors_new();
    const char *path = write_file(name, content);
    const glint_status status =
        attitude_table_read(path, NULL, NULL, clock_2024(), PLACE_NONE, &t, errors);
    bool there = false;
    for (size_t k = 0; k < glint_errors_count(errors); k++) {
        const glint_error *e = glint_errors_get(errors, k);
        there = there || (e->line == line && strcmp(e->file, path) == 0 &&
                          strstr(e->message, found) != NULL);
    }
    ck_assert_msg(status == GLINT_INPUT, "accepted:\n%s", content);
    ck_assert_ptr_null(t);
    ck_assert_msg(there, "wanted line %d with '%s'; got:%s", line, found, list_errors(errors));
    glint_errors_free(errors);
}

/* ------------------------------------------------------------- small messages */

#define AEM_HEAD(version)                                                                          \
    "CCSDS_AEM_VERS = " version "\nCREATION_DATE = 2024-01-01T00:00:00\nORIGINATOR = TEST\n"
#define AEM_META(frames, rest)                                                                     \
    "META_START\nOBJECT_NAME = BOX\nOBJECT_ID = 2024-001A\n" frames                                \
    "\nTIME_SYSTEM = UTC\nSTART_TIME = 2024-01-01T12:00:00\n"                                      \
    "STOP_TIME = 2024-01-01T12:01:40\n" rest "META_STOP\n"
#define TO_BODY "REF_FRAME_A = GCRF\nREF_FRAME_B = SC_BODY_1"
#define FROM_BODY "REF_FRAME_A = SC_BODY_1\nREF_FRAME_B = GCRF"

static const char AEM_2[] = AEM_HEAD("2.0") AEM_META(
    TO_BODY,
    "ATTITUDE_TYPE = QUATERNION\n") "DATA_START\n"
                                    "2024-01-01T12:00:00 0.0 0.0 0.0 1.0\n"
                                    "2024-01-01T12:00:40 0.0 0.0 0.6 0.8\n"
                                    "2024-01-01T12:01:40 0.0 0.6 0.0 0.8\n"
                                    "DATA_STOP\n"
                                    "META_START\nOBJECT_NAME = BOX\nOBJECT_ID = 2024-001A\n" TO_BODY
                                    "\nTIME_SYSTEM = UTC\nATTITUDE_TYPE = QUATERNION\nMETA_STOP\n"
                                    "DATA_START\n"
                                    "2024-01-01T12:02:00 0.0 0.0 0.0 1.0\n"
                                    "2024-01-01T12:03:00 0.6 0.0 0.0 0.8\n"
                                    "DATA_STOP\n";

static const char XML_ROW[] =
    "<attitudeState><quaternionEphemeris><EPOCH>%s</EPOCH><quaternion><Q1>%.17g</Q1><Q2>%.17g</Q2>"
    "<Q3>%.17g</Q3><QC>%.17g</QC></quaternion></quaternionEphemeris></attitudeState>\n";

static const char *aem_xml(void)
{
    static char out[4096];
    int n = snprintf(out, sizeof out,
                     "<?xml version=\"1.0\"?>\n<aem id=\"CCSDS_AEM_VERS\" version=\"2.0\">\n"
                     "<header><CREATION_DATE>2024-01-01T00:00:00</CREATION_DATE>"
                     "<ORIGINATOR>TEST</ORIGINATOR></header>\n<body><segment><metadata>\n"
                     "<OBJECT_NAME>BOX</OBJECT_NAME><OBJECT_ID>2024-001A</OBJECT_ID>\n"
                     "<REF_FRAME_A>GCRF</REF_FRAME_A><REF_FRAME_B>SC_BODY_1</REF_FRAME_B>\n"
                     "<TIME_SYSTEM>UTC</TIME_SYSTEM><START_TIME>2024-01-01T12:00:00</START_TIME>\n"
                     "<STOP_TIME>2024-01-01T12:01:40</STOP_TIME>"
                     "<ATTITUDE_TYPE>QUATERNION</ATTITUDE_TYPE></metadata>\n<data>\n");
    n += snprintf(out + n, sizeof out - (size_t)n, XML_ROW, "2024-01-01T12:00:00", 0., 0., 0., 1.);
    n += snprintf(out + n, sizeof out - (size_t)n, XML_ROW, "2024-01-01T12:00:40", 0., 0., .6, .8);
    n += snprintf(out + n, sizeof out - (size_t)n, XML_ROW, "2024-01-01T12:01:40", 0., .6, 0., .8);
    snprintf(out + n, sizeof out - (size_t)n, "</data></segment></body></aem>\n");
    return out;
}

#define STK_HEAD                                                                                   \
    "stk.v.11.0\n\nBEGIN Attitude\nNumberOfAttitudePoints 3\n"                                     \
    "ScenarioEpoch 1 Jan 2024 12:00:00.000000\nInterpolationOrder 1\nCentralBody Earth\n"
#define STK_AXES "CoordinateAxes ICRF\n"
#define STK_ROWS                                                                                   \
    "AttitudeTimeQuaternions\n0 0 0 0 1\n4.0e1 0 0 0.6 0.8\n100 0 0.6 0 0.8\nEND Attitude\n"
static const char STK[] = STK_HEAD STK_AXES STK_ROWS;

static const char CSV[] = "# body to GCRS\nt_s,qw,qx,qy,qz\n0,1,0,0,0\n40,0.8,0,0,0.6\n"
                          "100,0.8,0,0.6,0\n";

/* --------------------------------------------------------------------- meaning */

/* The matrix of CCSDS 504.0-B-1, section on quaternions: coordinates in B from coordinates in A. */
static void ccsds_matrix(const double q[4], double b_from_a[9])
{
    const double qc = q[0], q1 = q[1], q2 = q[2], q3 = q[3];
    const double m[9] = {q1 * q1 - q2 * q2 - q3 * q3 + qc * qc,
                         2 * (q1 * q2 + q3 * qc),
                         2 * (q1 * q3 - q2 * qc),
                         2 * (q1 * q2 - q3 * qc),
                         -q1 * q1 + q2 * q2 - q3 * q3 + qc * qc,
                         2 * (q2 * q3 + q1 * qc),
                         2 * (q1 * q3 + q2 * qc),
                         2 * (q2 * q3 - q1 * qc),
                         -q1 * q1 - q2 * q2 + q3 * q3 + qc * qc};
    memcpy(b_from_a, m, sizeof m);
}

/* Every combination of direction, order of frames and place of the scalar. */
START_TEST(test_attitude_table_aem_quaternion_is_a_frame_transformation)
{
    uint64_t state = 1;
    for (int which = 0; which < 8; which++) {
        const bool back = which & 1, swapped = which & 2, first = which & 4;
        double q[4], b_from_a[9], want[9], got[9];
        char content[2048], row[256];
        random_quaternion(&state, q);
        ccsds_matrix(q, b_from_a);
        /* the quaternion is of A to B, or of B to A; the body is B, or A */
        if (back != swapped)
            mat_transpose(b_from_a, want);
        else
            memcpy(want, b_from_a, sizeof want);
        snprintf(row, sizeof row,
                 first ? "2024-01-01T12:00:00 %.17g %.17g %.17g %.17g\n"
                       : "2024-01-01T12:00:00 %2$.17g %3$.17g %4$.17g %1$.17g\n",
                 q[0], q[1], q[2], q[3]);
        snprintf(content, sizeof content, "%s%s%s%s%sDATA_START\n%sDATA_STOP\n", AEM_HEAD("1.0"),
                 swapped ? "META_START\nOBJECT_NAME = BOX\nOBJECT_ID = 2024-001A\n" FROM_BODY "\n"
                         : "META_START\nOBJECT_NAME = BOX\nOBJECT_ID = 2024-001A\n" TO_BODY "\n",
                 back ? "ATTITUDE_DIR = B2A\n" : "ATTITUDE_DIR = A2B\n",
                 first ? "QUATERNION_TYPE = FIRST\n" : "QUATERNION_TYPE = LAST\n",
                 "TIME_SYSTEM = UTC\nATTITUDE_TYPE = QUATERNION\nMETA_STOP\n", row);
        attitude_table *t = read_sound_table(write_file("a.aem", content), NULL);
        body_axes(t, 0, got);
        assert_mat_near(got, want, rounding);
        attitude_table_free(t);
    }
}
END_TEST

/* Coordinates after the axes have been turned by `angle` about axis k. */
static void frame_turn(int k, double angle, double out[9])
{
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    memset(out, 0, 9 * sizeof *out);
    out[4 * k] = 1;
    out[4 * i] = out[4 * j] = cos(angle);
    out[3 * i + j] = sin(angle);
    out[3 * j + i] = -sin(angle);
}

static void one_row(const char *meta, const char *numbers, double body_gcrs[9])
{
    char content[2048];
    snprintf(content, sizeof content, "%sDATA_START\n2024-01-01T12:00:00 %s\nDATA_STOP\n", meta,
             numbers);
    attitude_table *t = read_sound_table(write_file("row.aem", content), NULL);
    body_axes(t, 0, body_gcrs);
    attitude_table_free(t);
}

/* The three turns of all twelve sequences, multiplied as matrices. */
START_TEST(test_attitude_table_aem_euler_angles_are_turns_of_the_frame)
{
    const double angles[3] = {25, -40, 110};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) {
                if (i == j || j == k) continue;
                double a[9], b[9], c[9], want[9], got[9];
                char meta[1024];
                frame_turn(i, angles[0] * DEG, a);
                frame_turn(j, angles[1] * DEG, b);
                frame_turn(k, angles[2] * DEG, c);
                mat_mul(b, a, want);
                mat_mul(c, want, want);
                snprintf(meta, sizeof meta, "%s%s%c%c%c\nMETA_STOP\n", AEM_HEAD("2.0"),
                         "META_START\nOBJECT_NAME = BOX\nOBJECT_ID = 2024-001A\n" TO_BODY
                         "\nTIME_SYSTEM = UTC\nATTITUDE_TYPE = EULER_ANGLE\nEULER_ROT_SEQ = ",
                         "XYZ"[i], "XYZ"[j], "XYZ"[k]);
                one_row(meta, "25 -40 110", got);
                assert_mat_near(got, want, rounding);
                *strstr(meta, "EULER_ROT_SEQ") = '\0';
                snprintf(meta + strlen(meta), 64, "EULER_ROT_SEQ = %d%d%d\nMETA_STOP\n", i + 1,
                         j + 1, k + 1);
                one_row(meta, "25 -40 110", got);
                assert_mat_near(got, want, rounding);
            }
}
END_TEST

/* The body's z lies along (alpha, delta); at the angle 0 x lies along the ascending node. */
START_TEST(test_attitude_table_aem_spin_axis_and_angle)
{
    const double alpha = 50 * DEG, delta = 20 * DEG;
    static const char META[] = AEM_HEAD("2.0")
        AEM_META("REF_FRAME_A = ICRF\nREF_FRAME_B = SC_BODY", "ATTITUDE_TYPE = SPIN\n");
    double still[9], turned[9];
    one_row(META, "50 20 0 6", still);
    assert_near(still[6], cos(alpha) * cos(delta), rounding);
    assert_near(still[7], sin(alpha) * cos(delta), rounding);
    assert_near(still[8], sin(delta), rounding);
    assert_near(still[0], -sin(alpha), rounding);
    assert_near(still[1], cos(alpha), rounding);
    assert_near(still[2], 0, rounding);
    /* 90 deg later x is where y was */
    one_row(META, "50 20 90 6", turned);
    for (int i = 0; i < 3; i++) {
        assert_near(turned[i], still[3 + i], rounding);
        assert_near(turned[6 + i], still[6 + i], rounding);
    }
}
END_TEST

/* Rows that are whole turns apart look like a body at rest: only the rates tell. 6 deg/s make 360
 * deg in the minute between the rows; 1.4 deg/s make 84 deg, and 1.6 deg/s 96 deg, on either side
 * of the 90 deg of which a warning tells. */
START_TEST(test_attitude_table_aem_rates_tell_of_turns_between_rows)
{
    static const struct {
        const char *type, *row, *warned; /* NULL: no warning */
    } CASES[] = {
        {"SPIN", "50 20 0 6", "360 deg"},
        {"SPIN", "50 20 0 -6", "360 deg"},
        {"SPIN", "50 20 0 1.4", NULL},
        {"QUATERNION/ANGVEL", "0 0 0 1 0.96 0 -1.28", "96 deg"},
        {"QUATERNION/ANGVEL", "0 0 0 1 0.84 0 -1.12", NULL},
    };
    for (size_t k = 0; k < COUNT_OF(CASES); k++) {
        char content[1024];
        snprintf(content, sizeof content,
                 AEM_HEAD("2.0") "META_START\nOBJECT_NAME = BOX\nOBJECT_ID = 2024-001A\n" TO_BODY
                                 "\nTIME_SYSTEM = UTC\nATTITUDE_TYPE = %s\nMETA_STOP\nDATA_START\n"
                                 "2024-01-01T12:00:00 %s\n2024-01-01T12:01:00 %s\nDATA_STOP\n",
                 CASES[k].type, CASES[k].row, CASES[k].row);
        attitude_table *t;
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(attitude_table_read(write_file("rates.aem", content), NULL, NULL,
                                             clock_2024(), PLACE_NONE, &t, errors),
                         GLINT_OK);
        ck_assert_uint_eq(glint_errors_count(errors), CASES[k].warned ? 1 : 0);
        if (CASES[k].warned)
            ck_assert_ptr_nonnull(strstr(glint_errors_get(errors, 0)->message, CASES[k].warned));
        attitude_table_free(t);
        glint_errors_free(errors);
    }
}
END_TEST

/* A second program's file: its Euler angles Z (10, 40, ... deg), X (20, 50, ...), Z, and its
 * quaternions of the same motion, whose last turn about Z is 40 deg further on; six decimals. */
START_TEST(test_attitude_table_aem_euler_and_quaternions_of_another_program)
{
    const char *dir = reference_dir("an AEM of another program");
    if (!dir) return;
    char *bytes = read_bytes(path_in(dir, "samples/aem_v2_euler_spin_quaternion.aem"), NULL);
    const char *segment[5];
    int n = 0;
    for (const char *at = bytes; n < 5 && (at = strstr(at, "META_START")); at += 5)
        segment[n++] = at;
    ck_assert_int_ge(n, 4);
    char euler[4096], quaternions[4096];
    const int head = (int)(segment[0] - bytes);
    snprintf(euler, sizeof euler, "%.*s%.*s", head, bytes, (int)(segment[1] - segment[0]),
             segment[0]);
    snprintf(quaternions, sizeof quaternions, "%.*s%.*s", head, bytes,
             (int)(segment[3] - segment[2]), segment[2]);
    attitude_table *a = read_sound_table(write_file("euler.aem", euler), NULL);
    attitude_table *b = read_sound_table(write_file("quaternions.aem", quaternions), NULL);
    ck_assert_int_eq(a->n, 10);
    ck_assert_int_eq(b->n, 11);
    for (long k = 0; k < a->n; k++) {
        double back[4], way[4];
        assert_near(a->t_s[k], b->t_s[k], 1e-6);
        quat_conjugate(a->q[k], back);
        quat_mul(back, b->q[k], way); /* body to body */
        const double sign = way[0] < 0 ? -1 : 1;
        assert_near(sign * way[0], cos(20 * DEG), 5e-6);
        assert_near(sign * way[1], 0, 5e-6);
        assert_near(sign * way[2], 0, 5e-6);
        assert_near(sign * way[3], sin(20 * DEG), 5e-6);
    }
    attitude_table_free(a);
    attitude_table_free(b);
    free(bytes);
}
END_TEST

/* The names of XML and the words of version 1.0, in a second program's file: the turn is from the
 * body to LVLH, so that its conjugate is wanted. */
START_TEST(test_attitude_table_aem_xml_of_another_program)
{
    static const double first[4] = {0.4886148886986714, -0.40215690839288926, 0.5816278675112939,
                                    0.5111108835743206};
    const char *dir = reference_dir("an AEM in XML of another program");
    if (!dir) return;
    attitude_table *t =
        read_sound_table(path_in(dir, "samples/aem_v1_quaternion_derivative_lvlh.xml"), NULL);
    ck_assert_int_eq(t->spans[0].frame, ATTITUDE_LVLH);
    ck_assert_int_eq(t->n, 7);
    assert_near(t->q[0][0], first[0], 1e-9); /* norm 1 to 1e-9 */
    for (int i = 1; i < 4; i++)
        assert_near(t->q[0][i], -first[i], 1e-9);
    for (long k = 1; k < t->n; k++)
        assert_near(t->t_s[k] - t->t_s[k - 1], 0.5, 1e-6); /* 2021 counted from 2024: 1e-8 s */
    attitude_table_free(t);
}
END_TEST

/* Version 1.0 in keywords, two segments about another planet: inertial axes do not mind. */
START_TEST(test_attitude_table_aem_keywords_of_another_program)
{
    static const double first[4] = {0.68427, 0.56748, 0.03146, 0.45689};
    const char *dir = reference_dir("an AEM in keywords of another program");
    if (!dir) return;
    attitude_table *t =
        read_sound_table(path_in(dir, "samples/aem_v1_quaternion_last_A2B.aem"), NULL);
    ck_assert_int_eq(t->n_spans, 2);
    ck_assert_int_eq(t->n, 8);
    for (int i = 0; i < 4; i++)
        assert_near(t->q[0][i], first[i], 1e-5); /* five decimals, made unit */
    /* the first span is usable from 22:08:02.5555 to 01:18:02.5555 two days later */
    assert_near(t->spans[0].to_s - t->spans[0].from_s, 27 * 3600 + 10 * 60, 1e-6);
    attitude_table_free(t);
}
END_TEST

/* A free tumble with 34 digits, through an STK file of its quaternions. */
static void check_tumble(const char *path)
{
    csv_table golden = table_open(path);
    char file[16384], wanted[64] = "";
    for (long first = 0; first < golden.n_rows;) {
        const char *name = table_text(&golden, first, "case");
        snprintf(wanted, sizeof wanted, "%s", name);
        long end = first;
        int n = snprintf(file, sizeof file,
                         "stk.v.11.0\nBEGIN Attitude\nScenarioEpoch 1 Jan 2024 12:00:00\n" STK_AXES
                         "AttitudeTimeQuatScalarFirst\n");
        for (; end < golden.n_rows && strcmp(table_text(&golden, end, "case"), wanted) == 0; end++)
            n += snprintf(file + n, sizeof file - (size_t)n, "%s %s %s %s %s\n",
                          table_text(&golden, end, "t_s"), table_text(&golden, end, "qw"),
                          table_text(&golden, end, "qx"), table_text(&golden, end, "qy"),
                          table_text(&golden, end, "qz"));
        snprintf(file + n, sizeof file - (size_t)n, "END Attitude\n");
        attitude_table *t = read_sound_table(write_file("tumble.a", file), NULL);
        for (long k = first; k < end; k++) {
            double q[4], gcrs_body[9], want[9], got[9];
            q[0] = table_number(&golden, k, "qw");
            table_vector(&golden, k, "q", "", q + 1);
            mat_from_quat(q, gcrs_body);
            mat_transpose(gcrs_body, want);
            body_axes(t, table_number(&golden, k, "t_s"), got);
            assert_mat_near(got, want, rounding);
        }
        attitude_table_free(t);
        first = end;
    }
    csv_free(&golden);
}

START_TEST(test_attitude_table_stk_rows_match_reference)
{
    table_check(check_tumble, "orbit/tumble_torquefree.csv");
}
END_TEST

/* A file that was made beside the reference: its rows are the torque-free rotation itself. */
START_TEST(test_attitude_table_stk_file_is_the_torque_free_rotation)
{
    const char *dir = reference_dir("an STK file of a tumble");
    if (!dir) return;
    attitude_table *t = read_sound_table(path_in(dir, "samples/stk_tumble_T1.a"), NULL);
    const double inertia[3] = {1200, 2600, 3300}, rates[3] = {0.021, -0.007, 0.0436};
    const double q[4] = {0.8, 0.2, -0.4, 0.4};
    double gcrs_body[9], start[9];
    torque_free tumble;
    mat_from_quat(q, gcrs_body);
    mat_transpose(gcrs_body, start);
    torque_free_start(inertia, rates, start, &tumble);
    ck_assert_int_eq(t->n, 10);
    for (long k = 0; k < t->n; k++) {
        double got[9], want[9];
        body_axes(t, t->t_s[k], got);
        torque_free_at(&tumble, t->t_s[k], want, NULL);
        assert_mat_near(got, want, 1e-11);
    }
    attitude_table_free(t);
}
END_TEST

/* ---------------------------------------------------------------------- frames */

static const char *aem_of_frames(const char *frame, const char *system, const char *time)
{
    static char content[1024];
    snprintf(content, sizeof content,
             AEM_HEAD("2.0") "META_START\nOBJECT_NAME = BOX\nOBJECT_ID = 1\nCENTER_NAME = EARTH\n"
                             "REF_FRAME_A = %s\nREF_FRAME_B = SC_BODY\nTIME_SYSTEM = %s\n"
                             "ATTITUDE_TYPE = QUATERNION\nMETA_STOP\nDATA_START\n%s 0 0 0 1\n"
                             "DATA_STOP\n",
             frame, system, time);
    return content;
}

static void check_teme(const char *path)
{
    csv_table golden = table_open(path);
    for (long k = 0; k < golden.n_rows; k++) {
        char time[64];
        snprintf(time, sizeof time, "%s", table_text(&golden, k, "utc"));
        char *zone = strchr(time, 'Z');
        if (zone) *zone = '\0';
        run_clock clock; /* UT1 goes by the leap seconds of the start */
        utc_time start;
        attitude_table *t;
        ck_assert_int_eq(utc_parse(time, PLACE_NONE, &start, NULL), GLINT_OK);
        run_clock_start(&start, 0, 0, &clock);
        ck_assert_int_eq(
            attitude_table_read(write_file("teme.aem", aem_of_frames("TEME", "UTC", time)), NULL,
                                NULL, &clock, PLACE_NONE, &t, NULL),
            GLINT_OK);
        double got[9];
        body_axes(t, t->t_s[0], got);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                char name[32];
                snprintf(name, sizeof name, "r%d%d", i, j);
                /* GCRS from TEME; here the other way */
                assert_near(got[3 * j + i], table_number(&golden, k, name), 1e-11);
            }
        attitude_table_free(t);
    }
    csv_free(&golden);
}

START_TEST(test_attitude_table_teme_matches_reference)
{
    table_check(check_teme, "orbit/teme_to_gcrs.csv");
}
END_TEST

/* The frame bias of IERS Conventions 2010, 5.4.4: xi0 = -16.617, eta0 = -6.8192, d alpha0 = -14.6
 * mas. The precession of 2006 has it 0.2 microarcsec, 9e-13 rad, elsewhere. */
START_TEST(test_attitude_table_eme2000_is_off_by_the_bias)
{
    const double mas = DEG / 3600e3;
    attitude_table *t = read_sound_table(
        write_file("j2000.aem", aem_of_frames("EME2000", "UTC", "2024-01-01T12:00:00")), NULL);
    double got[9];
    body_axes(t, 0, got);
    const double want[9] = {
        1, -14.6 * mas, 16.617 * mas, 14.6 * mas, 1, 6.8192 * mas, -16.617 * mas, -6.8192 * mas, 1};
    assert_mat_near(got, want, 1e-12);
    attitude_table_free(t);
}
END_TEST

/* The body's axes are those of the local frames, and of the Earth. */
START_TEST(test_attitude_table_local_frames_follow_the_orbit)
{
    static const struct {
        const char *name;
        double want[9];
    } all[] = {{"LVLH", {0, 1, 0, 0, 0, -1, -1, 0, 0}},
               {"RTN", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
               {"ITRF2020", {0, 1, 0, -1, 0, 0, 0, 0, 1}}};
    const moment m = {
        .r_m = {7e6, 0, 0}, .v_m_s = {0, 7.5e3, 0}, .itrs_gcrs = {0, 1, 0, -1, 0, 0, 0, 0, 1}};
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        attitude_table *t = read_sound_table(
            write_file("f.aem", aem_of_frames(all[k].name, "UTC", "2024-01-01T12:00:00")), NULL);
        double got[9];
        ck_assert_int_eq(attitude_table_at(t, &m, got, NULL), GLINT_OK);
        assert_mat_near(got, all[k].want, rounding);
        attitude_table_free(t);
    }
    const attitude_frame lvlh = ATTITUDE_LVLH;
    attitude_table *t;
    ck_assert_int_eq(attitude_table_read(write_file("l.csv", CSV), NULL, &lvlh, clock_2024(),
                                         PLACE_NONE, &t, NULL),
                     GLINT_OK);
    double got[9];
    ck_assert_int_eq(attitude_table_at(t, &m, got, NULL), GLINT_OK);
    assert_mat_near(got, all[0].want, rounding);
    attitude_table_free(t);
}
END_TEST

/* In 2024 TAI is 37 s ahead of UTC, GPS 19 s behind TAI, TT 32.184 s ahead of it. */
START_TEST(test_attitude_table_time_systems)
{
    static const struct {
        const char *system, *time;
        double t_s;
    } all[] = {{"UTC", "2024-01-01T12:00:10", 10}, {"TAI", "2024-01-01T12:00:10", -27},
               {"GPS", "2024-01-01T12:00:10", -8}, {"TT", "2024-01-01T12:00:10", -59.184},
               {"UTC", "2024-001T12:00:10", 10},   {"TAI", "2024-001T12:00:37.5", 0.5}};
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        attitude_table *t = read_sound_table(
            write_file("t.aem", aem_of_frames("ICRF", all[k].system, all[k].time)), NULL);
        assert_near(t->t_s[0], all[k].t_s, 1e-9);
        attitude_table_free(t);
    }
}
END_TEST

/* -------------------------------------------------------------- between the rows */

/* The same three rows in every kind of file: a turn about z by 2 atan(0.6 / 0.8), then on. */
START_TEST(test_attitude_table_every_kind_of_file_slerps)
{
    const char *paths[] = {write_file("a.aem", AEM_2), write_file("a.xml", aem_xml()),
                           write_file("a.a", STK), write_file("a.csv", CSV)};
    const double full = 2 * atan2(0.6, 0.8);
    for (size_t k = 0; k < COUNT_OF(paths); k++) {
        attitude_table *t = read_sound_table(paths[k], NULL);
        for (int i = 0; i <= 8; i++) {
            double got[9], want[9];
            body_axes(t, 5.0 * i, got);
            frame_turn(2, full * i / 8, want);
            assert_mat_near(got, want, 1e-12); /* times of day are right to 1e-11 s */
        }
        double at_end[9], last[9];
        body_axes(t, 100, at_end);
        frame_turn(1, full, last);
        assert_mat_near(at_end, last, 1e-12);
        attitude_table_free(t);
    }
}
END_TEST

/* Changing the sign of a row's quaternion changes nothing: the way is the shortest in any case. */
START_TEST(test_attitude_table_signs_of_quaternions_do_not_matter)
{
    attitude_table *plain = read_sound_table(write_file("a.csv", CSV), NULL);
    attitude_table *signs = read_sound_table(
        write_file("b.csv", "t_s,qw,qx,qy,qz\n0,1,0,0,0\n40,-0.8,0,0,-0.6\n100,0.8,0,0.6,0\n"),
        NULL);
    for (int i = 0; i <= 100; i++) {
        double a[9], b[9];
        body_axes(plain, i, a);
        body_axes(signs, i, b);
        assert_mat_near(a, b, rounding);
    }
    attitude_table_free(plain);
    attitude_table_free(signs);
}
END_TEST

static void assert_outside(const attitude_table *t, double t_s, const char *says)
{
    const moment m = {.t_s = t_s};
    double body_gcrs[9];
    glint_error error;
    ck_assert_int_eq(attitude_table_at(t, &m, body_gcrs, &error), GLINT_INPUT);
    ck_assert_msg(strstr(error.message, says) != NULL, "'%s' says nothing of '%s'", error.message,
                  says);
}

START_TEST(test_attitude_table_outside_its_spans_says_nothing)
{
    attitude_table *t = read_sound_table(write_file("a.aem", AEM_2), NULL);
    double got[9], want[9], gap_s;
    ck_assert_int_eq(t->n_spans, 2);
    assert_outside(t, -1, "begins at 0 s");
    assert_outside(t, 110, "a gap from 100 to 120 s");
    assert_outside(t, 180.1, "ends at 180 s");
    assert_outside(t, NAN, "says nothing");
    /* the first interval is drawn out by the time that light takes */
    body_axes(t, -TIME_LEAD_S, got);
    frame_turn(2, -2 * atan2(0.6, 0.8) * TIME_LEAD_S / 40, want);
    assert_mat_near(got, want, rounding);
    ck_assert(attitude_table_gap(t, 0, 180, &gap_s));
    assert_near(gap_s, 100, 1e-9);
    ck_assert(!attitude_table_gap(t, 120, 180, &gap_s));
    attitude_table_free(t);
}
END_TEST

START_TEST(test_attitude_table_usable_times_narrow_the_span)
{
    static const char CONTENT[] = AEM_HEAD("2.0")
        AEM_META(TO_BODY,
                 "USEABLE_START_TIME = 2024-01-01T12:00:10\n"
                 "USEABLE_STOP_TIME = 2024-01-01T12:00:30\n"
                 "ATTITUDE_TYPE = QUATERNION\n") "DATA_START\n2024-01-01T12:00:00 0 0 0 "
                                                 "1\n2024-01-01T12:00:40 0 0 0.6 0.8\nDATA_STOP\n";
    attitude_table *t = read_sound_table(write_file("a.aem", CONTENT), NULL);
    double got[9], want[9];
    body_axes(t, 30, got);
    frame_turn(2, 2 * atan2(0.6, 0.8) * 0.75, want);
    assert_mat_near(got, want, 1e-12); /* times of day are right to 1e-11 s */
    assert_outside(t, 9, "begins at 10 s");
    assert_outside(t, 31, "ends at 30 s");
    attitude_table_free(t);
}
END_TEST

START_TEST(test_attitude_table_chooses_among_objects)
{
    static const char CONTENT[] = AEM_HEAD("2.0") AEM_META(
        TO_BODY,
        "ATTITUDE_TYPE = QUATERNION\n") "DATA_START\n2024-01-01T12:00:00 0 0 0 1\nDATA_STOP\n"
                                        "META_START\nOBJECT_NAME = LID\nOBJECT_ID = "
                                        "2024-001B\n" TO_BODY "\nTIME_SYSTEM = UTC\nATTITUDE_TYPE "
                                        "= QUATERNION\nMETA_STOP\n"
                                        "DATA_START\n2024-01-01T12:00:00 0 0 1 0\nDATA_STOP\n";
    const char *path = write_file("two.aem", CONTENT);
    assert_file_wrong("two.aem", CONTENT, 19, "choose with the key 'object'");
    attitude_table *t = read_sound_table(path, "lid");
    ck_assert_int_eq(t->n, 1);
    assert_near(fabs(t->q[0][3]), 1, 0);
    attitude_table_free(t);
    t = read_sound_table(path, "2024-001A");
    assert_near(t->q[0][0], 1, 0);
    attitude_table_free(t);
    ck_assert_int_eq(attitude_table_read(path, "no", NULL, clock_2024(), PLACE_NONE, &t, NULL),
                     GLINT_INPUT);
    ck_assert_int_eq(attitude_table_read(write_file("a.csv", CSV), "no", NULL, clock_2024(),
                                         PLACE_NONE, &t, NULL),
                     GLINT_INPUT);
}
END_TEST

START_TEST(test_attitude_table_warns_of_wide_steps_and_other_axes)
{
    glint_errors *errors = glint_errors_new();
    attitude_table *t;
    const char *path =
        write_file("a.csv", "t_s,qw,qx,qy,qz\n0,1,0,0,0\n40,0.6,0,0,0.8\n80,0.6,0,0,0.8\n");
    ck_assert_int_eq(attitude_table_read(path, NULL, NULL, clock_2024(), PLACE_NONE, &t, errors),
                     GLINT_OK);
    ck_assert_uint_eq(glint_errors_count(errors), 1);
    ck_assert_int_eq(glint_errors_get(errors, 0)->line, 3);
    ck_assert_ptr_nonnull(strstr(glint_errors_get(errors, 0)->message, "106 deg"));
    attitude_table_free(t);
    char content[2048];
    snprintf(content, sizeof content, "%s", AEM_2);
    memcpy(strstr(content, "SC_BODY_1"), "IMU_FRAME", 9);
    ck_assert_int_eq(attitude_table_read(write_file("a.aem", content), NULL, NULL, clock_2024(),
                                         PLACE_NONE, &t, errors),
                     GLINT_OK);
    ck_assert_uint_eq(glint_errors_count(errors), 3); /* and a step of 100 deg */
    ck_assert_ptr_nonnull(strstr(glint_errors_get(errors, 1)->message, "'IMU_FRAME'"));
    attitude_table_free(t);
    glint_errors_free(errors);
}
END_TEST

/* ---------------------------------------------------------------------- errors */

/* AEM_2 with one text in place of another. */
static const char *changed(const char *content, const char *from, const char *to)
{
    static char out[4096];
    const char *at = strstr(content, from);
    ck_assert_msg(at != NULL, "no '%s'", from);
    snprintf(out, sizeof out, "%.*s%s%s", (int)(at - content), content, to, at + strlen(from));
    return out;
}

START_TEST(test_attitude_table_wrong_messages_are_refused)
{
    static const struct {
        const char *from, *to;
        int line;
        const char *found;
    } all[] = {
        {"AEM_VERS = 2.0", "AEM_VERS = 3.0", 1, "expected 1.0 or 2.0"},
        {"CCSDS_AEM_VERS", "CCSDS_OEM_VERS", 1, "expected attitudes"},
        {"REF_FRAME_A = GCRF", "REF_FRAME_A = MARS", 7, "'MARS' and 'SC_BODY_1'"},
        {"REF_FRAME_B = SC_BODY_1", "REF_FRAME_B = EME2000", 8, "expected the body"},
        {"REF_FRAME_B = SC_BODY_1\n", "", 12, "no REF_FRAME_B"},
        {"TIME_SYSTEM = UTC", "TIME_SYSTEM = SCLK", 9, "SCLK"},
        {"START_TIME = 2024-01-01T12:00:00", "START_TIME = noon", 10, "noon"},
        {"QUATERNION\n", "SPIN/NUTATION\n", 12, "SPIN/NUTATION is not read"},
        {"QUATERNION\n", "MATRIX\n", 12, "'MATRIX'"},
        {"QUATERNION\n", "EULER_ANGLE\n", 13, "no EULER_ROT_SEQ"},
        {"QUATERNION\n", "EULER_ANGLE\nEULER_ROT_SEQ = 331\n", 13, "'331'"},
        {"META_STOP\n", "OBJECT_ID = X\nMETA_STOP\n", 13, "stands twice"},
        {"0.0 0.0 0.6 0.8", "0.0 0.0 0.6", 16, "4 words"},
        {"0.0 0.0 0.6 0.8", "0.0 0.0 0.6 0.8 1", 16, "6 words"},
        {"0.0 0.0 0.6 0.8", "0.0 0.0 0.6 0.x8", 16, "'0.x8'"},
        {"0.0 0.0 0.6 0.8", "0.0 0.0 nan 0.8", 16, "'nan'"},
        {"0.0 0.0 0.6 0.8", "0.0 0.0 0.6 0.81", 16, "the norm 1.008"},
        {"2024-01-01T12:00:40", "2023-01-01T12:00:40", 16, "before the one above"},
        {"2024-01-01T12:00:40", "2024-01-01T25:00:40", 16, "25:00:40"},
        {"2024-01-01T12:02:00", "2024-01-01T12:01:00", 26, "do not overlap"},
    };
    for (size_t k = 0; k < COUNT_OF(all); k++)
        assert_file_wrong("a.aem", changed(AEM_2, all[k].from, all[k].to), all[k].line,
                          all[k].found);
}
END_TEST

START_TEST(test_attitude_table_wrong_version_1_messages_are_refused)
{
    static const char SOUND_1[] = AEM_HEAD("1.0") AEM_META(
        TO_BODY,
        "ATTITUDE_DIR = A2B\nQUATERNION_TYPE = LAST\n"
        "ATTITUDE_TYPE = QUATERNION\n") "DATA_START\n2024-01-01T12:00:00 0 0 0 1\nDATA_STOP\n";
    attitude_table_free(read_sound_table(write_file("a.aem", SOUND_1), NULL));
    assert_file_wrong("a.aem", changed(SOUND_1, "ATTITUDE_DIR = A2B\n", ""), 14, "no ATTITUDE_DIR");
    assert_file_wrong("a.aem", changed(SOUND_1, "= A2B", "= UP"), 12, "expected A2B or B2A");
    assert_file_wrong("a.aem", changed(SOUND_1, "QUATERNION_TYPE = LAST\n", ""), 14,
                      "no QUATERNION_TYPE");
    assert_file_wrong("a.aem", changed(SOUND_1, "= LAST", "= MIDDLE"), 13, "FIRST or LAST");
}
END_TEST

START_TEST(test_attitude_table_wrong_stk_files_are_refused)
{
    assert_file_wrong("a.a", changed(STK, "Points 3", "Points 4"), 13, "has 3 rows");
    assert_file_wrong("a.a", changed(STK, "CoordinateAxes ICRF\n", ""), 8, "no CoordinateAxes");
    assert_file_wrong("a.a", changed(STK, "ICRF", "Moon"), 8, "'Moon'");
    assert_file_wrong("a.a", changed(STK, "Earth", "Mars"), 7, "expected Earth");
    assert_file_wrong("a.a", changed(STK, "1 Jan 2024", "1 Foo 2024"), 5, "1 Foo 2024");
    assert_file_wrong("a.a", changed(STK, "12:00:00.000000", "12:00:00.0x"), 5, "12:00:00.0x");
    assert_file_wrong("a.a", changed(STK, "TimeQuaternions", "TimeDCM"), 9, "AttitudeTimeDCM");
    assert_file_wrong("a.a", changed(STK, "InterpolationOrder", "Colour"), 6, "'Colour'");
    assert_file_wrong("a.a", changed(STK, "4.0e1", "4.0e1x"), 11, "'4.0e1x'");
    assert_file_wrong("a.a", changed(STK, "0.6 0.8", "0.6"), 11, "4 numbers; expected 5");
}
END_TEST

START_TEST(test_attitude_table_wrong_csv_tables_are_refused)
{
    assert_file_wrong("a.csv", changed(CSV, "qw", "w"), 2, "no column 'qw'");
    assert_file_wrong("a.csv", changed(CSV, "t_s", "time"), 2, "t_s and utc");
    assert_file_wrong("a.csv", changed(CSV, "40,", "0,"), 4, "times that grow");
    assert_file_wrong("a.csv", changed(CSV, "40,0.8", "40,0.9"), 4, "the norm 1.08");
    assert_file_wrong("a.csv", changed(CSV, "40,0.8", "40,?"), 4, "'?'");
    assert_file_wrong("a.csv", changed(CSV, "100,", "1e10,"), 5, "at most 2e+09");
    assert_file_wrong("a.csv", "t_s,qw,qx,qy,qz\n", 0, "no rows");
}
END_TEST

/* --------------------------------------------------------------- damaged files */

/* A cut file is refused, or read as rows that stand before the cut and are whole. */
static void check_cuts(const char *name, const char *content, bool has_end)
{
    attitude_table *whole = read_sound_table(write_file(name, content), NULL);
    const size_t size = strlen(content);
    long read = 0;
    for (size_t n = 0; n < size; n++) {
        attitude_table *t;
        const char *path = write_bytes("cut", content, n);
        if (attitude_table_read(path, NULL, NULL, clock_2024(), PLACE_NONE, &t, NULL)) continue;
        read++;
        ck_assert_msg(t->n <= whole->n, "cut at %zu of %s", n, name);
        if (has_end) ck_assert_msg(t->spans[t->n_spans - 1].n >= 2, "cut at %zu of %s", n, name);
        for (long k = 0; k < t->n; k++) {
            assert_near(t->t_s[k], whole->t_s[k], 0);
            for (int i = 0; i < 4; i++)
                assert_near(t->q[k][i], whole->q[k][i], 0);
        }
        attitude_table_free(t);
    }
    ck_assert_int_gt(read, 0);
    attitude_table_free(whole);
}

START_TEST(test_attitude_table_cut_anywhere_gives_whole_rows_or_an_error)
{
    check_cuts("a.aem", AEM_2, true);
    check_cuts("a.xml", aem_xml(), true);
    check_cuts("a.a", STK, true);
    check_cuts("a.csv", CSV, false);
}
END_TEST

/* Whatever happens to a file, what is read from it is a set of rotations. */
static void check_damage(const char *content)
{
    const size_t size = strlen(content);
    char *bytes = malloc(size);
    uint64_t state = 7;
    ck_assert_ptr_nonnull(bytes);
    for (int round = 0; round < 400; round++) {
        memcpy(bytes, content, size);
        for (int k = 0; k <= round % 4; k++) {
            const size_t at = (size_t)((next_random(&state) + 1) / 2 * (double)(size - 1));
            bytes[at] = (char)(int)(128 * next_random(&state));
        }
        attitude_table *t;
        const char *path = write_bytes("damaged", bytes, size);
        if (attitude_table_read(path, NULL, NULL, clock_2024(), PLACE_NONE, &t, NULL)) continue;
        for (long k = 0; k < t->n; k++) {
            assert_near(quat_dot(t->q[k], t->q[k]), 1, rounding);
            ck_assert(isfinite(t->t_s[k]));
        }
        attitude_table_free(t);
    }
    free(bytes);
}

START_TEST(test_attitude_table_random_damage_gives_rotations_or_an_error)
{
    check_damage(AEM_2);
    check_damage(aem_xml());
    check_damage(STK);
    check_damage(CSV);
}
END_TEST

static Suite *table_suite(void)
{
    Suite *suite = suite_create("attitude table");
    TCase *tests = tcase_create("attitude table");
    tcase_set_timeout(tests, 120);
    tcase_add_checked_fixture(tests, folder_make, folder_remove);
    tcase_add_test(tests, test_attitude_table_aem_quaternion_is_a_frame_transformation);
    tcase_add_test(tests, test_attitude_table_aem_euler_angles_are_turns_of_the_frame);
    tcase_add_test(tests, test_attitude_table_aem_spin_axis_and_angle);
    tcase_add_test(tests, test_attitude_table_aem_rates_tell_of_turns_between_rows);
    tcase_add_test(tests, test_attitude_table_aem_euler_and_quaternions_of_another_program);
    tcase_add_test(tests, test_attitude_table_aem_xml_of_another_program);
    tcase_add_test(tests, test_attitude_table_aem_keywords_of_another_program);
    tcase_add_test(tests, test_attitude_table_stk_rows_match_reference);
    tcase_add_test(tests, test_attitude_table_stk_file_is_the_torque_free_rotation);
    tcase_add_test(tests, test_attitude_table_teme_matches_reference);
    tcase_add_test(tests, test_attitude_table_eme2000_is_off_by_the_bias);
    tcase_add_test(tests, test_attitude_table_local_frames_follow_the_orbit);
    tcase_add_test(tests, test_attitude_table_time_systems);
    tcase_add_test(tests, test_attitude_table_every_kind_of_file_slerps);
    tcase_add_test(tests, test_attitude_table_signs_of_quaternions_do_not_matter);
    tcase_add_test(tests, test_attitude_table_outside_its_spans_says_nothing);
    tcase_add_test(tests, test_attitude_table_usable_times_narrow_the_span);
    tcase_add_test(tests, test_attitude_table_chooses_among_objects);
    tcase_add_test(tests, test_attitude_table_warns_of_wide_steps_and_other_axes);
    tcase_add_test(tests, test_attitude_table_wrong_messages_are_refused);
    tcase_add_test(tests, test_attitude_table_wrong_version_1_messages_are_refused);
    tcase_add_test(tests, test_attitude_table_wrong_stk_files_are_refused);
    tcase_add_test(tests, test_attitude_table_wrong_csv_tables_are_refused);
    tcase_add_test(tests, test_attitude_table_cut_anywhere_gives_whole_rows_or_an_error);
    tcase_add_test(tests, test_attitude_table_random_damage_gives_rotations_or_an_error);
    suite_add_tcase(suite, tests);
    return suite;
}

int main(void)
{
    return run_suite(table_suite());
}
