/* Orbit mean-elements messages in their four notations. */
#include "base/constants.h"
#include "base/random.h"
#include "base/text.h"
#include "base/vec.h"
#include "orbit/clock.h"
#include "orbit/element_sets.h"
#include "orbit/omm.h"
#include "orbit/sgp4.h"
#include "scenario_text.h"
#include "table.h"

static const char *data(const char *name)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/messages/%s", TEST_DATA_DIR, name);
    return path;
}

static tle_list read_sets(const char *path, const tle_query *query, size_t n_entries)
{
    tle_list list;
    glint_errors *errors = glint_errors_new();
    const glint_status status = omm_file_read(path, PLACE_NONE, query, &list, errors);
    ck_assert_msg(status == GLINT_OK, "%s:%s", path, list_errors(errors));
    ck_assert_msg(glint_errors_count(errors) == n_entries, "%s:%s", path, list_errors(errors));
    glint_errors_free(errors);
    return list;
}

/* The same element set as two lines. */
static tle iss_of_lines(void)
{
    tle out;
    ck_assert_int_eq(
        tle_parse("1 25544U 98067A   25206.16725053  .00012111  00000+0  21923-3 0  9999",
                  "2 25544  51.6348 118.8254 0002056 114.0852 246.0352 15.50079803521055", true,
                  PLACE_NONE, NULL, &out, NULL),
        GLINT_OK);
    return out;
}

/* All digits of two lines are in a message, and the epoch's: 1e-8 d are 864 whole microseconds.
 * What remains is the rounding of degrees times pi/180, and that of the day's fraction. */
static void assert_same_elements(const tle *a, const tle *b)
{
    const double ulp = 3e-16;
    ck_assert_int_eq(a->number, b->number);
    ck_assert_str_eq(a->designator, b->designator);
    assert_near(a->epoch_jd[0] - b->epoch_jd[0], 0.0, 0.0);
    assert_near(a->epoch_jd[1], b->epoch_jd[1], ulp);
    assert_rel(a->bstar, b->bstar, ulp);
    assert_rel(a->inclination, b->inclination, ulp);
    assert_rel(a->raan, b->raan, ulp);
    assert_rel(a->eccentricity, b->eccentricity, ulp);
    assert_rel(a->argument_of_perigee, b->argument_of_perigee, ulp);
    assert_rel(a->mean_anomaly, b->mean_anomaly, ulp);
    assert_rel(a->mean_motion, b->mean_motion, ulp);
    assert_rel(a->mean_motion_dot, b->mean_motion_dot, ulp);
}

/* How far apart two sets put the satellite, m, `minutes` after their epochs. */
static double distance_m(const tle *a, const tle *b, double minutes)
{
    double r_m[2][3], unused[3];
    const tle *sets[2] = {a, b};
    for (int k = 0; k < 2; k++) {
        sgp4 *s;
        ck_assert_int_eq(sgp4_new(sets[k], &s, NULL), GLINT_OK);
        ck_assert_int_eq(sgp4_state(s, minutes, NULL, r_m[k], unused, NULL), GLINT_OK);
        sgp4_free(s);
    }
    sub3(r_m[1], r_m[0], r_m[0]);
    return norm3(r_m[0]);
}

static const char *const FILES[] = {"iss.omm", "iss.xml", "iss.json", "iss.csv"};
static const tle_query ISS = {.number = 25544};

START_TEST(test_omm_read_gives_the_set_of_two_lines_in_every_notation)
{
    const tle want = iss_of_lines();
    for (size_t k = 0; k < COUNT_OF(FILES); k++) {
        tle_list list = read_sets(data(FILES[k]), &ISS, 0);
        ck_assert_uint_eq(list.n, 1);
        ck_assert_str_eq(list.sets[0].name, "ISS (ZARYA)");
        ck_assert_str_eq(list.sets[0].where.file, data(FILES[k]));
        ck_assert_int_gt(list.sets[0].where.line, 0);
        assert_same_elements(&list.sets[0], &want);
        /* 1e-15 of the mean anomaly at 15 turns a day over a week: 1e-6 m */
        for (double minutes = -10080; minutes <= 10080; minutes += 1440)
            assert_near(distance_m(&list.sets[0], &want, minutes), 0.0, 1e-6);
        tle_list_free(&list);
    }
}
END_TEST

START_TEST(test_omm_read_chooses_as_with_two_lines)
{
    static const tle_query queries[] = {
        {.name = "iss (zarya) "},
        {.number = 25544},
        {.designator = "1998-067A"},
        {.designator = "98067a"},
        {.name = "ISS (ZARYA)", .number = 25544, .designator = "1998-067-A"}};
    for (size_t f = 0; f < COUNT_OF(FILES); f++)
        for (size_t q = 0; q < COUNT_OF(queries); q++) {
            tle_list list = read_sets(data(FILES[f]), &queries[q], 0);
            ck_assert_int_eq(list.sets[0].number, 25544);
            tle_list_free(&list);
        }
}
END_TEST

static void assert_choice_refused(const char *path, const tle_query *query, const char *word)
{
    tle_list list;
    glint_errors *errors = glint_errors_new();
    const place asked = {"run.toml", 3, 7};
    ck_assert_int_eq(omm_file_read(path, asked, query, &list, errors), GLINT_INPUT);
    ck_assert_uint_eq(list.n, 0);
    ck_assert_msg(has_error(errors, "run.toml", 3, 7, word, NULL), "wanted '%s'; got:%s", word,
                  list_errors(errors));
    glint_errors_free(errors);
}

START_TEST(test_omm_read_says_what_there_is)
{
    const tle_query none = {0}, far = {.name = "ISS"}, wrong = {.designator = "1998"},
                    other = {.designator = "1998-067B"};
    assert_choice_refused(data("iss.csv"), &none,
                          "ISS (ZARYA) (25544), HST (20580); say which one by tle_name, tle_number or "
                          "tle_designator");
    assert_choice_refused(data("iss.csv"), &far, "did you mean 'ISS (ZARYA)'?");
    assert_choice_refused(data("iss.csv"), &wrong, "a form like 1998-067A");
    assert_choice_refused(data("iss.json"), &other, "of designator 98067B; it has HST (20580)");
    assert_choice_refused("/nonexistent.omm", &none, "cannot open");
}
END_TEST

START_TEST(test_omm_designator_read_takes_its_forms)
{
    static const char *const forms[][2] = {{"1998-067A", "98067A"},
                                           {"1998-067-A", "98067A"},
                                           {"98067A", "98067A"},
                                           {"98067abc", "98067ABC"},
                                           {" 2021-035A ", "21035A"},
                                           {"98067A  ", "98067A"},
                                           {"", NULL},
                                           {"98067", NULL},
                                           {"1998-067", NULL},
                                           {"1998-67A", NULL},
                                           {"1998067A", NULL},
                                           {"98067ABCD", NULL},
                                           {"UNKNOWN", NULL},
                                           {"98067A1", NULL},
                                           {"1998-0A7A", NULL},
                                           {"1998-", NULL},
                                           {"1998-06", NULL}};
    for (size_t k = 0; k < COUNT_OF(forms); k++) {
        char out[DESIGNATOR_SIZE];
        const bool read = designator_read(forms[k][0], strlen(forms[k][0]), out);
        ck_assert_msg(read == (forms[k][1] != NULL), "'%s'", forms[k][0]);
        if (read) ck_assert_str_eq(out, forms[k][1]);
    }
}
END_TEST

/* ------------------------------------------------------- the verification set */

/* Writes the elements of two lines as a message: their own digits, in the units of messages. */
static void write_message(text *out, const char *line1, const char *line2)
{
    tle e;
    ck_assert_int_eq(tle_parse(line1, line2, false, PLACE_NONE, NULL, &e, NULL), GLINT_OK);
    const double day = strtod((char[]){line1[20], line1[21], line1[22], '\0'}, NULL);
    const double fraction = strtod(line1 + 23, NULL); /* columns 24 to 32 */
    const long microseconds = lround(fraction * 86400e6);
    const int year = 10 * (line1[18] - '0') + line1[19] - '0';
    text_printf(out,
                "CCSDS_OMM_VERS = 2.0\nOBJECT_NAME = %d\nOBJECT_ID = %.8s\nCENTER_NAME = EARTH\n"
                "REF_FRAME = TEME\nTIME_SYSTEM = UTC\nMEAN_ELEMENT_THEORY = SGP4\n",
                e.number, line1 + 9);
    text_printf(out, "EPOCH = %04d-%03dT%02ld:%02ld:%02ld.%06ld\n",
                year < 57 ? 2000 + year : 1900 + year, (int)day, microseconds / 3600000000,
                microseconds / 60000000 % 60, microseconds / 1000000 % 60, microseconds % 1000000);
    text_printf(out, "MEAN_MOTION = %.11s\nECCENTRICITY = .%.7s\nINCLINATION = %.8s\n", line2 + 52,
                line2 + 26, line2 + 8);
    text_printf(out, "RA_OF_ASC_NODE = %.8s\nARG_OF_PERICENTER = %.8s\nMEAN_ANOMALY = %.8s\n",
                line2 + 17, line2 + 34, line2 + 43);
    text_printf(out, "NORAD_CAT_ID = %d\nBSTAR = %c.%.5sE%.2s\n", e.number,
                line1[53] == '-' ? '-' : '+', line1 + 54, line1 + 59);
}

/* Every set of the public verification file as a message: SGP4's states of the file come out. */
START_TEST(test_omm_read_gives_the_states_of_the_verification_set)
{
    char line1[256], line2[256];
    text content = {0};
    FILE *file = fopen(path_in(TEST_DATA_DIR, "sgp4_verification.tle"), "r");
    ck_assert_ptr_nonnull(file);
    while (fgets(line1, sizeof line1, file)) {
        if (line1[0] == '#') continue;
        ck_assert_ptr_nonnull(fgets(line2, sizeof line2, file));
        if (!strchr(line2 + 26, ' ') || strcspn(line2 + 26, " ") == 7) /* no blanks for zeros */
            write_message(&content, line1, line2);
    }
    fclose(file);
    const char *path = write_bytes("verification.omm", content.data, content.length);
    text_free(&content);
    csv_table t = table_open(path_in(TEST_DATA_DIR, "sgp4_verification.csv"));
    long compared = 0;
    for (long row = 0; row < t.n_rows; row++) {
        const tle_query query = {.number = (int)table_number(&t, row, "number")};
        tle_list list;
        if (omm_file_read(path, PLACE_NONE, &query, &list, NULL)) continue;
        sgp4 *s;
        double r_m[3], v_m_s[3], want_km[3];
        ck_assert_int_eq(sgp4_new(&list.sets[0], &s, NULL), GLINT_OK);
        ck_assert_int_eq(sgp4_state(s, table_number(&t, row, "minutes"), NULL, r_m, v_m_s, NULL),
                         GLINT_OK);
        table_vector(&t, row, "", "_km", want_km);
        for (int i = 0; i < 3; i++) /* as SGP4 itself is held to the file */
            assert_near(r_m[i] * 1e-3, want_km[i], 1.2e-7);
        sgp4_free(s);
        tle_list_free(&list);
        compared++;
    }
    ck_assert_int_gt(compared, 9 * t.n_rows / 10);
    csv_free(&t);
}
END_TEST

/* --------------------------------------------------------------------- errors */

#define START "CCSDS_OMM_VERS = 2.0\nOBJECT_NAME = X\nOBJECT_ID = 2020-001A\n"
#define META_OF(centre, frame, system, theory)                                                     \
    "CENTER_NAME = " centre "\nREF_FRAME = " frame "\nTIME_SYSTEM = " system                       \
    "\nMEAN_ELEMENT_THEORY = " theory "\n"
#define META META_OF("EARTH", "TEME", "UTC", "SGP4")
#define EPOCH "EPOCH = 2025-206T04:00:50\n"
#define ELEMENTS_OF(motion, e, i, node, perigee, anomaly)                                          \
    "MEAN_MOTION = " motion "\nECCENTRICITY = " e "\nINCLINATION = " i "\nRA_OF_ASC_NODE = " node  \
    "\nARG_OF_PERICENTER = " perigee "\nMEAN_ANOMALY = " anomaly "\n"
#define ELEMENTS ELEMENTS_OF("15.5", "0.01", "51", "10", "20", "30")
#define REST "NORAD_CAT_ID = 5\nBSTAR = 1e-4\n"

START_TEST(test_omm_read_places_every_error)
{
    static const char *const wrong[][2] = {
        {"CCSDS_OEM_VERS = @2.0\n", "begins with CCSDS_OEM_VERS"},
        {"@", "no whole message"},
        {"X = 1\n", "no whole message"},
        {"@a,b\n1,2\n", "no orbit mean-elements message"},
        {"{@\n", "no whole JSON"},
        {START META_OF("@MARS", "TEME", "UTC", "SGP4") EPOCH ELEMENTS REST, "expected EARTH"},
        {START META_OF("EARTH", "@EME2000", "UTC", "SGP4") EPOCH ELEMENTS REST, "expected TEME"},
        {START META_OF("EARTH", "TEME", "@TAI", "SGP4") EPOCH ELEMENTS REST, "expected UTC"},
        {START META_OF("EARTH", "TEME", "UTC", "@SGP4-XP") ELEMENTS, "SGP4-XP"},
        {START META_OF("EARTH", "TEME", "UTC", "@DSST") EPOCH ELEMENTS REST, "expected SGP4"},
        {START META EPOCH ELEMENTS REST "EPHEMERIS_TYPE = @4\n", "SGP4-XP"},
        {START META EPOCH ELEMENTS REST "EPHEMERIS_TYPE = @1\n", "not one of SGP4"},
        {START META EPOCH ELEMENTS REST "EPHEMERIS_TYPE = @x\n", "a finite number"},
        {START META EPOCH ELEMENTS "BTERM = @0.01 [m**2/kg]\n", "SGP4-XP"},
        {START META EPOCH ELEMENTS "AGOM = @0.01\n", "SGP4-XP"},
        {"CCSDS_OMM_VERS = @2.0\nOBJECT_NAME = X\n" META EPOCH ELEMENTS, "no BSTAR"},
        {START META "EPOCH = @2025-02-30T00:00:00\n" ELEMENTS REST, "has 28 days"},
        {START META "EPOCH = @2025\n" ELEMENTS REST, "is not a time"},
        {START META EPOCH ELEMENTS_OF("@0", "0.01", "51", "10", "20", "30") REST,
         "mean motion is 0"},
        {START META EPOCH ELEMENTS_OF("@101", "0.01", "51", "10", "20", "30") REST, "mean motion"},
        {START META EPOCH ELEMENTS_OF("@15.5 [deg]", "0.01", "51", "10", "20", "30") REST,
         "the unit of the standard, rev/day"},
        {START META EPOCH ELEMENTS_OF("15.5", "@1", "51", "10", "20", "30") REST, "eccentricity"},
        {START META EPOCH ELEMENTS_OF("15.5", "@-0.1", "51", "10", "20", "30") REST,
         "eccentricity"},
        {START META EPOCH ELEMENTS_OF("15.5", "0.01", "@181", "10", "20", "30") REST,
         "inclination is 181"},
        {START META EPOCH ELEMENTS_OF("15.5", "0.01", "51", "@361", "20", "30") REST,
         "node is 361"},
        {START META EPOCH ELEMENTS_OF("15.5", "0.01", "51", "10", "@-1", "30") REST,
         "perigee is -1"},
        {START META EPOCH ELEMENTS_OF("15.5", "0.01", "51", "10", "20", "@nan") REST,
         "a finite number"},
        {START META EPOCH ELEMENTS REST "BSTAR = @2e-4\n", "stands twice"},
        {START META EPOCH ELEMENTS "BSTAR = 1\nNORAD_CAT_ID = @5a\n", "up to nine digits"},
    };
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        marked_text m = {.text = ""};
        strcpy(m.text, wrong[k][0]);
        take_mark(&m);
        if (m.line == 1 && m.column == 1 && !m.text[0]) m.line = 0; /* of the whole file */
        if (strstr(wrong[k][1], "JSON")) m.line = 0;                /* where jansson says */
        tle_list list;
        glint_errors *errors = glint_errors_new();
        const tle_query any = {0};
        ck_assert_msg(omm_file_read(write_file("in.omm", m.text), PLACE_NONE, &any, &list,
                                    errors) == GLINT_INPUT,
                      "wanted '%s' for\n%s", wrong[k][1], m.text);
        ck_assert_msg(has_error(errors, in_folder("in.omm"), m.line, m.column, wrong[k][1], NULL),
                      "wanted %d:%d '%s'; got:%s", m.line, m.column, wrong[k][1],
                      list_errors(errors));
        ck_assert_msg(glint_errors_error_count(errors) == 1, "%s", list_errors(errors));
        ck_assert_ptr_null(list.sets);
        glint_errors_free(errors);
    }
}
END_TEST

START_TEST(test_omm_read_finds_all_errors_of_a_set)
{
    tle_list list;
    glint_errors *errors = glint_errors_new();
    const tle_query any = {0};
    const char *path =
        write_file("in.omm", START META_OF("MARS", "X", "TAI", "SGP4")
                                 ELEMENTS_OF("x", "2", "200", "400", "400", "400") "BSTAR = y\n");
    ck_assert_int_eq(omm_file_read(path, PLACE_NONE, &any, &list, errors), GLINT_INPUT);
    ck_assert_msg(glint_errors_error_count(errors) == 11, "%s", list_errors(errors));
    glint_errors_free(errors);
}
END_TEST

/* Sets of other satellites are no matter. */
START_TEST(test_omm_read_ignores_faults_of_other_satellites)
{
    static const char content[] = START META_OF("EARTH", "TEME", "UTC", "SGP4-XP")
        EPOCH ELEMENTS REST "CCSDS_OMM_VERS = 2.0\nOBJECT_NAME = Y\n" META EPOCH ELEMENTS
                            "NORAD_CAT_ID = 6\nBSTAR = 0\n";
    const tle_query six = {.number = 6};
    tle_list list = read_sets(write_file("in.omm", content), &six, 0);
    ck_assert_str_eq(list.sets[0].name, "Y");
    tle_list_free(&list);
}
END_TEST

/* Several sets of one satellite come in the order of their epochs, each epoch once: the first. */
START_TEST(test_omm_read_puts_sets_in_order)
{
    static const char header[] = "NORAD_CAT_ID,EPOCH,MEAN_MOTION,ECCENTRICITY,INCLINATION,"
                                 "RA_OF_ASC_NODE,ARG_OF_PERICENTER,MEAN_ANOMALY,BSTAR\n";
    static const char *const rows[] = {"5,2025-07-26T00:00:00,15.1,.01,51,1,2,3,0\n",
                                       "5,2025-07-24T00:00:00,15.2,.01,51,1,2,3,0\n",
                                       "5,2025-07-25T00:00:00,15.3,.01,51,1,2,3,0\n",
                                       "5,2025-07-24T00:00:00,15.4,.01,51,1,2,3,0\n"};
    text content = {0};
    text_add(&content, header);
    for (int k = 0; k < 4; k++)
        text_add(&content, rows[k]);
    const tle_query any = {0};
    tle_list list = read_sets(write_bytes("in.csv", content.data, content.length), &any, 0);
    static const double want[] = {15.2, 15.3, 15.1};
    ck_assert_uint_eq(list.n, 3);
    for (int k = 0; k < 3; k++)
        assert_rel(list.sets[k].mean_motion, want[k] * 2 * PI / 1440, 1e-15);
    tle_list_free(&list);
    text_free(&content);
}
END_TEST

/* ---------------------------------------------------------------- truncation */

static bool same_bits(const tle *a, const tle *b)
{
    return a->number == b->number && a->bstar == b->bstar && a->raan == b->raan &&
           memcmp(a->epoch_jd, b->epoch_jd, sizeof a->epoch_jd) == 0 &&
           a->inclination == b->inclination && a->eccentricity == b->eccentricity &&
           a->argument_of_perigee == b->argument_of_perigee && a->mean_anomaly == b->mean_anomaly &&
           a->mean_motion == b->mean_motion;
}

/* The mean motion's derivative is not compared: SGP4 does not use it, and it may be absent. */
static void cut_everywhere(const char *path, const tle_query *query)
{
    size_t n;
    char *bytes = read_bytes(path, &n);
    tle_list whole, part;
    const glint_status status = omm_file_read(path, PLACE_NONE, query, &whole, NULL);
    size_t sound = 0;
    for (size_t cut = 0; cut < n; cut++) {
        glint_errors *errors = glint_errors_new();
        if (omm_file_read(write_bytes("cut", bytes, cut), PLACE_NONE, query, &part, errors)) {
            ck_assert_uint_gt(glint_errors_error_count(errors), 0);
            ck_assert_ptr_null(part.sets);
        } else {
            ck_assert_msg(status == GLINT_OK && part.n <= whole.n, "%s cut at %zu", path, cut);
            for (size_t k = 0; k < part.n; k++)
                ck_assert_msg(same_bits(&part.sets[k], &whole.sets[k]), "%s cut at %zu", path, cut);
            tle_list_free(&part);
            sound++;
        }
        glint_errors_free(errors);
    }
    printf("%s: %zu of %zu cuts leave whole sets\n", path, sound, n);
    tle_list_free(&whole);
    free(bytes);
}

static const char *const SAMPLES[] = {
    "omm_real_43508.omm", "omm_real_43508.xml", "omm_v3_sgp4xp_must_refuse.omm",
    "sample_omm.csv",     "sample_omm.json",    "sample_omm.xml"};

START_TEST(test_omm_read_takes_no_cut_number_for_a_whole_one)
{
    const tle_query any = {0};
    for (size_t k = 0; k < COUNT_OF(FILES); k++)
        cut_everywhere(data(FILES[k]), &ISS);
    const char *dir = reference_dir("cut samples of OMM");
    for (size_t k = 0; dir && k < COUNT_OF(SAMPLES); k++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/samples/%s", dir, SAMPLES[k]);
        cut_everywhere(path, &any);
    }
}
END_TEST

static void damage(const char *path, int n_times, uint64_t seed)
{
    size_t n;
    char *whole = read_bytes(path, &n);
    for (int k = 0; k < n_times; k++) {
        static const char likely[] = "0123456789.-+eE= \n\t<>/[]{},:\"T#\0";
        char *bytes = string_copy(whole, n);
        for (int changes = 1 + (int)(random_next(&seed) % 4); changes > 0; changes--)
            bytes[random_next(&seed) % n] = random_next(&seed) % 4
                                                ? likely[random_next(&seed) % sizeof likely]
                                                : (char)random_next(&seed);
        tle_list list;
        if (!omm_file_read(write_bytes("damaged", bytes, n), PLACE_NONE, &ISS, &list, NULL)) {
            for (size_t j = 0; j < list.n; j++)
                ck_assert(isfinite(list.sets[j].mean_motion) && isfinite(list.sets[j].raan) &&
                          isfinite(list.sets[j].bstar) && isfinite(list.sets[j].epoch_jd[1]));
            tle_list_free(&list);
        }
        free(bytes);
    }
    free(whole);
}

START_TEST(test_omm_read_survives_damage)
{
    const char *times = getenv("GLINT_DAMAGE"); /* more of it, on request */
    for (size_t k = 0; k < COUNT_OF(FILES); k++)
        damage(data(FILES[k]), times ? atoi(times) : 1000, k + 1);
}
END_TEST

/* Files that others wrote. */
START_TEST(test_omm_read_reads_samples)
{
    static const struct {
        const char *file;
        int number;
        double motion_rev_day, anomaly_deg, epoch_jd; /* whole days */
        size_t warnings;
    } cases[] = {{"omm_real_43508.omm", 43508, 2.13101992, 132.6293, 2461241.5, 0},
                 {"omm_real_43508.xml", 43508, 2.13101992, 132.6293, 2461241.5, 0},
                 {"sample_omm.json", 5, 10.85873516, 281.1229, 2460720.5, 0},
                 {"sample_omm.xml", 5, 10.84869164, 205.2356, 2459135.5, 0}};
    const char *dir = reference_dir("samples of OMM");
    const tle_query any = {0};
    for (size_t k = 0; dir && k < COUNT_OF(cases); k++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/samples/%s", dir, cases[k].file);
        tle_list list = read_sets(path, &any, cases[k].warnings);
        ck_assert_int_eq(list.sets[0].number, cases[k].number);
        assert_rel(list.sets[0].mean_motion, cases[k].motion_rev_day * 2 * PI / 1440, 1e-15);
        assert_rel(list.sets[0].mean_anomaly, cases[k].anomaly_deg * DEG, 1e-15);
        assert_near(list.sets[0].epoch_jd[0], cases[k].epoch_jd, 0.0);
        tle_list_free(&list);
    }
    tle_list list;
    char path[1024];
    snprintf(path, sizeof path, "%s/samples/omm_v3_sgp4xp_must_refuse.omm", dir ? dir : "");
    glint_errors *errors = glint_errors_new();
    if (dir) {
        ck_assert_int_eq(omm_file_read(path, PLACE_NONE, &any, &list, errors), GLINT_INPUT);
        ck_assert(has_error(errors, path, 13, 23, "SGP4-XP", NULL));
    }
    glint_errors_free(errors);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("omm");
    TCase *all = tcase_create("all");
    tcase_add_checked_fixture(all, folder_make, folder_remove);
    tcase_set_timeout(all, 300);
    tcase_add_test(all, test_omm_read_gives_the_set_of_two_lines_in_every_notation);
    tcase_add_test(all, test_omm_read_chooses_as_with_two_lines);
    tcase_add_test(all, test_omm_read_says_what_there_is);
    tcase_add_test(all, test_omm_designator_read_takes_its_forms);
    tcase_add_test(all, test_omm_read_gives_the_states_of_the_verification_set);
    tcase_add_test(all, test_omm_read_places_every_error);
    tcase_add_test(all, test_omm_read_finds_all_errors_of_a_set);
    tcase_add_test(all, test_omm_read_ignores_faults_of_other_satellites);
    tcase_add_test(all, test_omm_read_puts_sets_in_order);
    tcase_add_test(all, test_omm_read_takes_no_cut_number_for_a_whole_one);
    tcase_add_test(all, test_omm_read_survives_damage);
    tcase_add_test(all, test_omm_read_reads_samples);
    suite_add_tcase(suite, all);
    return run_suite(suite);
}
