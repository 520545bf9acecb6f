/* Scenarios that are wrong: every message stands at the right place, and says what was found and
 * what was expected. In the texts an '@' marks that place. */
#include "scenario_text.h"

#define ORBIT "[orbit]\n"
#define START "[time]\nstart = 2025-07-25T20:37:00Z\n"

static void assert_all_wrong(const char *const parts[N_PARTS], const wrong_text *all, size_t n)
{
    for (size_t k = 0; k < n; k++)
        assert_wrong(parts, &all[k]);
}

#define ASSERT_ALL_WRONG(parts, all) assert_all_wrong(parts, all, COUNT_OF(all))

/* ------------------------------------------------------------------ times */

START_TEST(test_scenario_times_wrong)
{
    static const wrong_text all[] = {
        {PART_TIME, "@[time]\nduration_s = 60\nstep_s = 10\n", "no 'start'", "a UTC time", 0},
        {PART_TIME, "[time]\nstart = @3\nduration_s = 60\nstep_s = 1\n", "the number 3",
         "a UTC time", 0},
        {PART_TIME, "[time]\nstart = @20:37:00\nduration_s = 60\nstep_s = 1\n", "'start'",
         "a UTC time", 0},
        {PART_TIME, "[time]\nstart = @\"2025-07-25 20h\"\nduration_s = 60\nstep_s = 1\n",
         "2025-07-25 20h", "expected", 0},
        {PART_TIME, "[time]\nstart = @\"2025-02-29T00:00:00Z\"\nduration_s = 60\nstep_s = 1\n",
         "29", "expected", 0},
        {PART_TIME, "[time]\nstart = @\"2025-06-30T23:59:60Z\"\nduration_s = 60\nstep_s = 1\n", "60",
         "expected", 0},
        {PART_TIME, "[time]\nstart = @1957-10-04T19:28:34Z\nduration_s = 60\nstep_s = 1\n", "1957",
         "1972", 0},
        {PART_TIME, "[time]\nstart = @2101-01-01T00:00:00Z\nduration_s = 60\nstep_s = 1\n", "2101",
         "2100", 0},
        {PART_TIME, "[time]\nstart = 2100-12-31T00:00:00Z\nduration_s = @86400\nstep_s = 3600\n",
         "2101", "2100", 0},
        {PART_TIME, START "end = @2025-07-25T20:36:59Z\nstep_s = 1\n", "1 s before the start",
         "an end not before it", 0},
        {PART_TIME, START "end = @false\nstep_s = 1\n", "'end' is false", "a UTC time", 0},
        {PART_TIME, "@" START "step_s = 1\n", "neither 'end' nor 'duration_s'", "expected one", 0},
        {PART_TIME, START "end = 2025-07-25T20:38:00Z\nduration_s = @60\nstep_s = 1\n",
         "both 'end' and 'duration_s'", "expected one of them", 0},
        {PART_TIME, START "duration_s = @-1\nstep_s = 1\n", "the number -1", "between 0 and", 0},
        {PART_TIME, START "duration_s = @nan\nstep_s = 1\n", "nan", "a finite number", 0},
        {PART_TIME, START "duration_s = @-inf\nstep_s = 1\n", "inf", "a finite number", 0},
        {PART_TIME, "@" START "duration_s = 60\n", "no 'step_s'", "a number in s", 0},
        {PART_TIME, START "duration_s = 60\nstep_s = @0\n", "the number 0", "above 0", 0},
        {PART_TIME, START "duration_s = 60\nstep_s = @-5.0\n", "the number -5", "above 0", 0},
        {PART_TIME, START "duration_s = 60\nstep_s = @\"1\"\n", "the string \"1\"", "a number", 0},
        {PART_TIME, START "duration_s = 60\nstep_s = @[1]\n", "an array", "a number", 0},
        {PART_TIME, START "duration_s = 4e9\nstep_s = @1e-3\n", "4e+12 steps", "at most 1e+10", 1},
        {PART_TIME, START "duration_s = 60\nstep_s = 1\n@stepp_s = 1\n", "unknown key 'stepp_s'",
         "did you mean 'step_s'?", 0},
        {PART_TIME, START "duration_s = 60\nstep_s = 1\n@zone = \"CET\"\n", "unknown key 'zone'",
         "expected one of: start, end, duration_s, step_s", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

/* ------------------------------------------------------------------ tables of the scenario */

START_TEST(test_scenario_tables_missing_or_unknown)
{
    static const wrong_text all[] = {
        {PART_TIME, "[time_]\nstart = 2025-07-25T20:37:00Z\nduration_s = 1\nstep_s = 1\n@",
         NULL, NULL, 2}, /* place of the first: see below */
        {PART_TIME, "@", NULL, NULL, 1},
        {PART_OBSERVER, "[@sky]\nlatitude_deg = 1\n", "unknown key 'sky'", "expected one of", 2},
        {PART_OBSERVER, "[@obsever]\nlatitude_deg = 1\n", "unknown key 'obsever'",
         "did you mean 'observer'?", 2},
        {PART_SETTINGS, "[@fotometry]\nbands = [\"V\"]\n", "unknown key 'fotometry'",
         "did you mean 'photometry'?", 0},
        {PART_SETTINGS, "[@observed]\ntable = \"track.csv\"\n", "'observed'", "later", 0},
        {PART_ATTITUDE, "attitude = @\"nadir\"\n", "the string \"nadir\"", "a table [attitude]", 1},
        {PART_TOP, "title = @7\n", "'title' is the number 7", "a string", 0},
        {PART_TOP, "@titel = \"x\"\n", "unknown key 'titel'", "did you mean 'title'?", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all + 2);
    static const struct {
        enum part part;
        const char *name;
    } missing[] = {{PART_TIME, "time"},
                   {PART_OBSERVER, "observer"},
                   {PART_ORBIT, "orbit"},
                   {PART_ATTITUDE, "attitude"}};
    for (size_t k = 0; k < COUNT_OF(missing); k++) {
        char expected[64];
        snprintf(expected, sizeof expected, "a table [%s]", missing[k].name);
        const marked_text m = with_part(SOUND, missing[k].part, "");
        const char *path = write_file("scenario.toml", m.text);
        assert_refused_set(path, NULL, 0, path, 1, 1, missing[k].name, expected, 1);
    }
}
END_TEST
