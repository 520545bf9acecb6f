/* Scenarios that are wrong: every message stands at the right place, and says what was found and
 * what was expected. In the texts an '@' marks that place. */
#include "scenario_text.h"

/* ------------------------------------------------------------------ times, site */

#define START "[time]\nstart = 2025-07-25T20:37:00Z\n"
#define REST "duration_s = 60\nstep_s = 10\n"

START_TEST(test_scenario_time_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_TIME, "@[time]\n" REST, "no 'start'", "a UTC time", 0},
        {PART_TIME, "[time]\nstart = @3\n" REST, "the number 3", "a UTC time", 0},
        {PART_TIME, "[time]\nstart = @20:37:00\n" REST, "'start'", "a UTC time", 0},
        {PART_TIME, "[time]\nstart = @\"2025-07-25 20h\"\n" REST, "2025-07-25 20h", "expected", 0},
        {PART_TIME, "[time]\nstart = @\"2025-02-29T00:00:00Z\"\n" REST, "2025-02-29 does not exist",
         "28 days", 0},
        {PART_TIME, "[time]\nstart = @\"2025-06-30T23:59:60Z\"\n" REST, "second 60",
         "no leap second", 0},
        {PART_TIME, "[time]\nstart = @1957-10-04T19:28:34Z\n" REST, "1957", "1972", 0},
        {PART_TIME, "[time]\nstart = @2101-01-01T00:00:00Z\n" REST, "2101", "2100", 0},
        {PART_TIME, "[time]\nstart = 2100-12-31T00:00:00Z\nduration_s = @86400\nstep_s = 3600\n",
         "2101", "up to 2100", 0},
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
        {PART_TIME, START "duration_s = 2e9\nstep_s = @1e-3\n", "2e+12 steps", "at most 1e+10", 0},
        {PART_TIME, START REST "@stepp_s = 1\n", "unknown key 'stepp_s'", "did you mean 'step_s'?",
         0},
        {PART_TIME, START REST "@zone = \"CET\"\n", "unknown key 'zone'",
         "expected one of: start, end, duration_s, step_s", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

#define SITE "[observer]\nlatitude_deg = 0\nlongitude_deg = 0\n"

START_TEST(test_scenario_horizon_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_OBSERVER, SITE "horizon_deg = @[]\n", "0 points", "1 to", 0},
        {PART_OBSERVER, SITE "horizon_deg = [[0, 1], @[1, 2, 3]]\n", "horizon_deg", "2 numbers", 0},
        {PART_OBSERVER, SITE "horizon_deg = [@[400, 1]]\n", "400", "-360 to 360", 0},
        {PART_OBSERVER, SITE "horizon_deg = [@[0, 91]]\n", "91", "-90 to 90", 0},
        {PART_OBSERVER, SITE "horizon_deg = [[10, 1], [0, 0], @[370, 2]]\n", "370", NULL, 0},
        {PART_OBSERVER, SITE "horizon_deg = [[10, 1], [0, 0], @[-350, 2]]\n",
         "another elevation already", "one elevation", 0},
        {PART_OBSERVER, SITE "horizon = \"a.csv\"\nhorizon_deg = @[[0, 1]]\n",
         "both 'horizon' and 'horizon_deg'", "one of them", 2},
        {PART_OBSERVER, SITE "horizon = @\"absent.csv\"\n", "absent.csv", NULL, 0},
        {PART_OBSERVER, SITE "refraction = @1\n", "'refraction' is", "true, false, or a table", 0},
        {PART_OBSERVER, SITE "refraction = { pressure_hPa = @-1 }\n", "-1", "between 0 and 1200",
         0},
        {PART_OBSERVER, SITE "refraction = { @pressure = 1 }\n", "unknown key 'pressure'",
         "pressure_hPa", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

/* Several observers: their names tell their rows apart. */
START_TEST(test_scenario_observers_without_different_names_are_refused)
{
#define SEVERAL(a, b)                                                                              \
    "[[observer]]\n" a "latitude_deg = 0\nlongitude_deg = 0\n" b                                   \
    "latitude_deg = 1\nlongitude_deg = 0\n"
    static const wrong_text all[] = {
        {PART_OBSERVER, SEVERAL("name = \"a\"\n", "@[[observer]]\n"), "has no name", "a name", 0},
        {PART_OBSERVER, SEVERAL("name = \"a\"\n", "@[[observer]]\nname = \"a\"\n"), "named 'a'",
         "different names", 0},
        {PART_OBSERVER, SEVERAL("name = \"a\"\n", "@[[observer]]\nname = 'a\"b'\n"),
         "cannot stand in a table", "without double quotes", 0},
        {PART_OBSERVER, SEVERAL("name = \"a\"\n", "@[[observer]]\nname = \"a\\tb\"\n"),
         "cannot stand in a table", "control characters", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
#undef SEVERAL
}
END_TEST

/* What other tables want of an observer that it does not have. */
START_TEST(test_scenario_observer_wanted_of_it_is_refused)
{
    static const char *const GEO = "[observer.satellite]\ncircular = { "
                                   "geostationary_longitude_deg = 0 }\n";
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_OBSERVER] = GEO;
    static const wrong_text of_satellites[] = {
        {PART_SETTINGS, "[output]\nrows = @\"dark-site\"\n", "no observer is a site", "visible", 0},
    };
    ASSERT_ALL_WRONG(parts, of_satellites);
    parts[PART_OBSERVER] = "[observer.direction]\nframe = \"body\"\nvector = [0, 0, 1]\n";
    const marked_text m = with_part(parts, PART_ATTITUDE,
                                    "[attitude]\nlaw = \"point\"\naxis = [0, 0, 1]\nto = "
                                    "\"observer\"\nsecond_axis = [1, 0, 0]\nsecond_to = "
                                    "\"north\"\n");
    const char *path = write_file("scenario.toml", m.text);
    assert_refused_set(path, NULL, 0, path, 0, 0, "the attitude follows the observer",
                       "one of them", 1);
    parts[PART_OBSERVER] = GEO;
    const marked_text x =
        with_part(parts, PART_SETTINGS, "[photometry]\nextinction = { V = 0.1 }\n");
    path = write_file("scenario.toml", x.text);
    assert_refused_set(path, NULL, 0, path, 0, 0, "no observer is a site", "extinction = false", 1);
}
END_TEST

START_TEST(test_scenario_observer_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_OBSERVER, "@[observer]\nlongitude_deg = 16\n", "no 'latitude_deg'", "a number in deg",
         0},
        {PART_OBSERVER, "@[observer]\nlatitude_deg = 16\n", "no 'longitude_deg'", "a number in deg",
         0},
        {PART_OBSERVER, "[observer]\nlatitude_deg = @90.001\nlongitude_deg = 0\n", "90.001",
         "between -90 and 90", 0},
        {PART_OBSERVER, "[observer]\nlatitude_deg = 0\nlongitude_deg = @361\n", "361",
         "between -360 and 360", 0},
        {PART_OBSERVER, "[observer]\nlatitude_deg = 0\nlongitude_deg = 0\nheight_m = @200000\n",
         "200000", "between -10000 and 100000", 0},
        {PART_OBSERVER, "[observer]\nlatitude_deg = 0\nlongitude_deg = 0\nheight_m = @\"2 km\"\n",
         "the string \"2 km\"", "a number in m", 0},
        {PART_OBSERVER,
         "[observer]\nlatitude_deg = 0\nlongitude_deg = 0\nmin_elevation_deg = @90.5\n", "90.5",
         "between -90 and 90", 0},
        {PART_OBSERVER, "[observer]\nname = @1\nlatitude_deg = 0\nlongitude_deg = 0\n", "number 1",
         "a string", 0},
        {PART_OBSERVER, "[observer]\n@latitude = 48\nlatitude_deg = 0\nlongitude_deg = 0\n",
         "unknown key 'latitude'", "did you mean 'latitude_deg'?", 0},
        {PART_OBSERVER, "[observer]\nsatellite = @{}\n", "[observer.satellite] has no source",
         "exactly one of tle", 0},
        {PART_OBSERVER, "[observer]\nsatellite = @[1]\n", "'satellite'", "a table", 0},
        {PART_OBSERVER, "[observer]\ndirection = @[0, 0, 1]\n", "'direction'", "a table", 0},
        {PART_OBSERVER,
         "[observer]\nsatellite = { circular = { geostationary_longitude_deg = 0 } }\n"
         "direction = @{ frame = \"gcrs\", vector = [0, 0, 1] }\n",
         "both 'satellite' and 'direction'", "one of them", 0},
        {PART_OBSERVER,
         "[observer]\nlatitude_deg = @3\n"
         "satellite = { circular = { geostationary_longitude_deg = 0 } }\n",
         "'latitude_deg' stands beside 'satellite'", "one kind of observer", 0},
        {PART_OBSERVER, "[observer]\ndirection = @{ vector = [0, 0, 1] }\n", "no 'frame'", NULL, 0},
        {PART_OBSERVER, "[observer]\ndirection = @{ frame = \"gcrs\" }\n", "no 'vector'", NULL, 0},
        {PART_OBSERVER,
         "[observer]\ndirection = { frame = \"gcrs\", vector = @[0, 0, 1], ra_deg = 1, dec_deg = 2 "
         "}\n",
         "both 'vector' and 'ra_deg', 'dec_deg'", "one of them", 0},
        {PART_OBSERVER, "[observer]\ndirection = { frame = @\"body\", ra_deg = 1, dec_deg = 2 }\n",
         "no right ascension", "'vector'", 0},
        {PART_OBSERVER,
         "[observer]\ndirection = { frame = \"gcrs\", vector = [0, 0, 1], range_km = @1e6 }\n",
         "1e+06", "between 1e-06 and", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

/* ------------------------------------------------------------------ orbits */

#define CIRCLE "height_km = 780, inclination_deg = 98.6, raan_deg = 80"
#define KEPLER                                                                                     \
    "inclination_deg = 28, raan_deg = 0, argument_of_perigee_deg = 0, mean_anomaly_deg = 0"
#define LINE1 "1 25544U 98067A   25206.16725053  .00012111  00000+0  21923-3 0  9999"
#define LINE2 "2 25544  51.6348 118.8254 0002056 114.0852 246.0352 15.50079803521055"

START_TEST(test_scenario_orbit_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_ORBIT, "@[orbit]\n", "no source",
         "exactly one of tle, tle_lines, omm, oem, stk, sp3, kepler, circular", 0},
        {PART_ORBIT,
         "@[orbit]\ncircular = { " CIRCLE ", argument_of_latitude_deg = 0 }\n"
         "kepler = { semi_major_axis_km = 7000, eccentricity = 0, " KEPLER " }\n",
         "several sources", "exactly one", 1},
        {PART_ORBIT, "[orbit]\n@circle = {}\n", "unknown key 'circle'", NULL, 2},
        {PART_ORBIT, "[orbit]\ncircular = @7\n", "the number 7", "a table", 0},
        {PART_ORBIT, "[orbit]\ncircular = @{ " CIRCLE " }\n", "no 'argument_of_latitude_deg'",
         "a number in deg", 0},
        {PART_ORBIT,
         "[orbit]\ncircular = { height_km = @0, inclination_deg = 0, raan_deg = 0, "
         "argument_of_latitude_deg = 0 }\n",
         "the number 0", "above 0", 0},
        {PART_ORBIT, "[orbit]\ncircular = { " CIRCLE ", argument_of_latitude_deg = 0, @j3 = 1 }\n",
         "unknown key 'j3'", "did you mean 'j2'?", 0},
        {PART_ORBIT, "[orbit]\ncircular = { " CIRCLE ", argument_of_latitude_deg = 0, j2 = @1 }\n",
         "the number 1", "true or false", 0},
        {PART_ORBIT,
         "[orbit]\ncircular = { " CIRCLE ", argument_of_latitude_deg = 0, epoch = @\"noon\" }\n",
         "noon", "expected", 0},
        {PART_ORBIT, "[orbit]\ncircular = { geostationary_longitude_deg = @400 }\n", "400",
         "between -360 and 360", 0},
        {PART_ORBIT, "[orbit]\ncircular = { geostationary_longitude_deg = 4, @height_km = 9 }\n",
         "unknown key 'height_km'", "geostationary_longitude_deg", 0},
        {PART_ORBIT,
         "[orbit]\nkepler = { semi_major_axis_km = @-7000, eccentricity = 0, " KEPLER " }\n",
         "-7000", "above 0", 0},
        {PART_ORBIT,
         "[orbit]\nkepler = { semi_major_axis_km = 7000, eccentricity = @1.0, " KEPLER " }\n",
         "the number 1", "at least 0 and below 1", 0},
        {PART_ORBIT,
         "[orbit]\nkepler = { semi_major_axis_km = 7000, eccentricity = 0.1, @a = 1," KEPLER " }\n",
         "unknown key 'a'", "expected one of: semi_major_axis_km", 0},
        {PART_ORBIT,
         "[orbit]\nkepler = { semi_major_axis_km = 7000, eccentricity = 0.1, "
         "inclination_deg = @181, raan_deg = 0, argument_of_perigee_deg = 0, "
         "mean_anomaly_deg = 0 }\n",
         "181", "between 0 and 180", 0},
        {PART_ORBIT, "[orbit]\nomm = @\"iss.omm\"\n", "iss.omm", "No such file", 0},
        {PART_ORBIT, "[orbit]\noem = @\"iss.oem\"\n", "iss.oem", "No such file", 0},
        {PART_ORBIT, "[orbit]\noem = @5\n", "the number 5", "the path of a file", 0},
        {PART_ORBIT, "@[orbit]\noem = \"a\"\nomm = \"a\"\n", "several sources", "exactly one", 0},
        {PART_ORBIT, "[orbit]\n@oem_object = \"a\"\ntle_lines = [\"" LINE1 "\", \"" LINE2 "\"]\n",
         "'oem_object' chooses from the file of 'oem'", "not given here", 0},
        {PART_ORBIT, "[orbit]\n@tle_number = 1\ncircular = { geostationary_longitude_deg = 1 }\n",
         "'tle_number' chooses from the file of 'tle' or 'omm'", "not given here", 0},
        {PART_ORBIT, "[orbit]\ntle_lines = @[\"" LINE1 "\"]\n", "'tle_lines'", "two strings", 0},
        {PART_ORBIT, "[orbit]\ntle_lines = @[1, 2]\n", "'tle_lines'", "two strings", 0},
        {PART_ORBIT, "[orbit]\ntle_lines = @\"" LINE1 "\"\n", "the string", "two strings", 0},
        {PART_ORBIT,
         "[orbit]\ntle_lines = [\"1 25544U 98067A   25206.16725053  .00012111  00000+0  "
         "21923-3 0  999@8\", \"" LINE2 "\"]\n",
         "checksum", "give 9", 0},
        {PART_ORBIT,
         "[orbit]\ntle_lines = [\"" LINE1 "\",\n  \"2 25544  51.6348 118.8254 0002056 "
         "114.0852 246.0352 15.5007980352105@6\"]\n",
         "checksum", "give 5", 0},
        {PART_ORBIT, "[orbit]\ntle = @\"nothing.tle\"\n", "nothing.tle", "No such file", 0},
        {PART_ORBIT, "[orbit]\ntle = @\".\"\n", "directory", "expected a file", 0},
        {PART_ORBIT, "[orbit]\ntle = @3\n", "the number 3", "the path of a file", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

START_TEST(test_scenario_orbit_perigee_below_the_ground_is_refused)
{
    static const wrong_text w = {
        PART_ORBIT,
        "@[orbit]\nkepler = { semi_major_axis_km = 7000, eccentricity = 0.3, " KEPLER " }\n",
        "perigee", NULL, 0};
    assert_wrong(SOUND, &w);
}
END_TEST

START_TEST(test_scenario_tle_file_without_the_wanted_set_is_refused)
{
    static const wrong_text all[] = {
        {PART_ORBIT, "[orbit]\ntle = @\"two.tle\"\n", "ISS (ZARYA)", "NOT ISS", 0},
        {PART_ORBIT, "[orbit]\ntle = @\"two.tle\"\ntle_name = \"ISS (ZARYB)\"\n", "ISS (ZARYB)",
         "ISS (ZARYA)", 0},
        {PART_ORBIT, "[orbit]\ntle = @\"two.tle\"\ntle_number = 25545\n", "25545", NULL, 0},
        {PART_ORBIT, "[orbit]\ntle = \"two.tle\"\ntle_number = @\"25544\"\n", "the string",
         "a whole number", 2},
        {PART_ORBIT, "[orbit]\ntle = \"two.tle\"\ntle_number = @25544.0\n", "the number 25544",
         "a whole number", 2},
        {PART_ORBIT, "[orbit]\ntle = \"two.tle\"\ntle_number = 25544\ntle_name = @5\n",
         "the number 5", "a string", 0},
    };
    write_file("two.tle",
               "0 ISS (ZARYA)\n" LINE1 "\n" LINE2 "\n0 NOT ISS\n"
               "1 90001U 24001A   24080.00000000 -.00000100  00000-0  00000+0 0  9992\n"
               "2 90001   0.0400  80.0000 0002000 120.0000 262.0000  1.00271000    11\n");
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

START_TEST(test_scenario_tle_file_error_names_the_element_set_file)
{
    const char *tle = write_file("bad.tle", "0 ISS (ZARYA)\n" LINE1 "\n" /* no line 2 */);
    const marked_text m = with_part(SOUND, PART_ORBIT, "[orbit]\ntle = \"bad.tle\"\n");
    assert_refused_set(write_file("scenario.toml", m.text), NULL, 0, tle, 2, 1, "line 2", NULL, 1);
}
END_TEST

/* ------------------------------------------------------------------ attitudes */

#define POINT "[attitude]\nlaw = \"point\"\n"
#define SPIN "[attitude]\nlaw = \"spin\"\n"

START_TEST(test_scenario_attitude_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_ATTITUDE, "@[attitude]\n", "no 'law'", "a string", 0},
        {PART_ATTITUDE, "[attitude]\nlaw = @\"nadirr\"\n", "nadirr", "(did you mean \"nadir\"?)",
         0},
        {PART_ATTITUDE, "[attitude]\nlaw = @\"xyzzy\"\n", "xyzzy", "expected one of: nadir, rsw",
         0},
        {PART_ATTITUDE, "[attitude]\nlaw = @1\n", "the number 1", "a string", 0},
        {PART_ATTITUDE, "@[attitude]\nlaw = \"table\"\n", "no 'file'", "the path of a file", 0},
        {PART_ATTITUDE, "[attitude]\nlaw = \"table\"\nfile = @\"no.aem\"\n", "cannot open",
         "no.aem", 0},
        {PART_ATTITUDE, "[attitude]\nlaw = \"nadir\"\n@axis = [0, 0, 1]\n", "unknown key 'axis'",
         "expected one of", 0},
        {PART_ATTITUDE, "@" POINT "axis = [0, 0, 1]\nto = \"nadir\"\nsecond_axis = [1, 0, 0]\n",
         "no 'second_to'", "a direction: nadir", 0},
        {PART_ATTITUDE,
         POINT "axis = @[0, 0, 0]\nto = \"nadir\"\nsecond_axis = [1, 0, 0]\nsecond_to = "
               "\"velocity\"\n",
         "a zero vector", "a direction", 0},
        {PART_ATTITUDE,
         POINT "axis = @[0, 1]\nto = \"nadir\"\nsecond_axis = [1, 0, 0]\nsecond_to = "
               "\"velocity\"\n",
         "2 elements", "3 numbers", 0},
        {PART_ATTITUDE,
         POINT "axis = [0, @\"1\", 0]\nto = \"nadir\"\nsecond_axis = [1, 0, 0]\nsecond_to = "
               "\"velocity\"\n",
         "the string \"1\"", "a number", 0},
        {PART_ATTITUDE,
         POINT "axis = [0, 0, 1]\nto = \"nadir\"\nsecond_axis = @[0, 0, -2]\nsecond_to = "
               "\"velocity\"\n",
         "parallel", "another axis", 0},
        {PART_ATTITUDE,
         POINT "axis = [0, 0, 1]\nto = @\"nadr\"\nsecond_axis = [1, 0, 0]\nsecond_to = "
               "\"velocity\"\n",
         "\"nadr\"", "(did you mean \"nadir\"?)", 0},
        {PART_ATTITUDE,
         POINT "axis = [0, 0, 1]\nto = @7\nsecond_axis = [1, 0, 0]\nsecond_to = \"velocity\"\n",
         "a whole number", "a direction", 0},
        {PART_ATTITUDE,
         POINT "axis = [0, 0, 1]\nto = @{ ra_deg = 10 }\nsecond_axis = [1, 0, 0]\nsecond_to = "
               "\"velocity\"\n",
         "no 'dec_deg'", "a number in deg", 0},
        {PART_ATTITUDE,
         POINT "axis = [0, 0, 1]\nto = { ra_deg = 10, dec_deg = @100 }\nsecond_axis = [1, 0, 0]\n"
               "second_to = \"velocity\"\n",
         "the number 100", "between -90 and 90", 0},
        {PART_ATTITUDE,
         POINT "axis = [0, 0, 1]\nto = { latitude_deg = 10, longitude_deg = 3, @ra_deg = 1 }\n"
               "second_axis = [1, 0, 0]\nsecond_to = \"velocity\"\n",
         "unknown key 'ra_deg'", "expected one of: latitude_deg", 0},
        {PART_ATTITUDE, "@[attitude]\nlaw = \"inertial\"\n", "no 'quaternion_wxyz'", "4 numbers",
         0},
        {PART_ATTITUDE, "[attitude]\nlaw = \"inertial\"\nquaternion_wxyz = @[1, 1, 0, 0]\n",
         "norm 1.414", "a unit quaternion", 0},
        {PART_ATTITUDE,
         SPIN "body_axis = [0, 0, 1]\npole = \"sun\"\nperiod_s = 1\nrate_deg_s = @1\n",
         "'rate_deg_s' and 'period_s'", "only one", 0},
        {PART_ATTITUDE, "@" SPIN "body_axis = [0, 0, 1]\npole = \"sun\"\n", "period_s",
         "rate_deg_s", 0},
        {PART_ATTITUDE, SPIN "body_axis = [0, 0, 1]\npole = \"sun\"\nperiod_s = @0\n", "period_s",
         "expected", 0},
        {PART_ATTITUDE,
         SPIN "body_axis = [0, 0, 1]\npole = \"sun\"\nperiod_s = 1\nepoch = @\"soon\"\n", "soon",
         "expected", 0},
        {PART_ATTITUDE, "[attitude]\nlaw = \"nadir\"\noffset_deg = @4\n", "the number 4", "a table",
         0},
        {PART_ATTITUDE, "[attitude]\nlaw = \"nadir\"\noffset_deg = @{ axis = [0, 0, 1] }\n",
         "no 'angle'", "a number in deg", 0},
        {PART_ATTITUDE,
         "[attitude]\nlaw = \"nadir\"\noffset_deg = { axis = @[0, 0, 0], angle = 3 }\n",
         "a zero vector", "a direction", 0},
        {PART_ATTITUDE,
         "[attitude]\nlaw = \"nadir\"\noffset_deg = { axis = [0, 0, 1], angle = @361 }\n", "361",
         "between -360 and 360", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

/* ------------------------------------------------------------------ settings */

START_TEST(test_scenario_photometry_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_SETTINGS, "[photometry]\nbands = @\"V\"\n", "the string \"V\"", "[\"V\"]", 0},
        {PART_SETTINGS, "[photometry]\nbands = @[]\n", "empty", "at least one band", 0},
        {PART_SETTINGS, "[photometry]\nbands = [\"V\", @\"lsst_v\"]\n", "lsst_v",
         "lsst_u to lsst_y", 0},
        {PART_SETTINGS, "[photometry]\nbands = [@5]\n", "a whole number", "U, B, V, R, I", 0},
        {PART_SETTINGS, "[photometry]\nbands = [\"V\", \"B\", @\"V\"]\n", "listed twice", NULL, 0},
        {PART_SETTINGS, "[photometry]\nbands = [\"V\", @\"sdss_g\"]\nsystem = \"vega\"\n",
         "band 'sdss_g' has no magnitude of the Sun in the vega system", "system = \"ab\"", 0},
        {PART_SETTINGS, "[photometry]\nbands = [@\"lsst_y\"]\nsystem = \"vega\"\n", "lsst_y",
         "system = \"ab\"", 0},
        {PART_SETTINGS, "[photometry]\nsystem = @\"AB\"\n", "\"AB\"", "expected one of: vega, ab",
         0},
        {PART_SETTINGS, "[photometry]\nsolar_disc = @\"disc\"\n", "\"disc\"",
         "expected one of: uniform, limb-darkened, point", 0},
        {PART_SETTINGS, "[photometry]\nearthshine = @true\n", "'earthshine' is true",
         "albedo = 0.3", 0},
        {PART_SETTINGS, "[photometry]\nearthshine = @{ radius_km = 6371 }\n",
         "neither 'albedo' nor 'brdf'", "expected one of them", 0},
        {PART_SETTINGS, "[photometry]\nearthshine = @{ albedo = 0.3, brdf = \"lambert\" }\n",
         "both 'albedo' and 'brdf'", "expected one of them", 0},
        {PART_SETTINGS, "[photometry]\nearthshine = { albedo = @1.5 }\n", "1.5", "between 0 and 1",
         0},
        {PART_SETTINGS, "[photometry]\nearthshine = { albedo = 0.3, rings = @3 }\n", "3", "8", 0},
        {PART_SETTINGS, "[photometry]\nearthshine = { albedo = 0.3, @ring = 32 }\n", "ring",
         "rings", 0},
        {PART_SETTINGS, "[photometry]\nearthshine = { brdf = \"lambert\", rho = 0.3, @n = 2 }\n",
         "'n'", NULL, 0},
        {PART_SETTINGS,
         "[photometry]\nearthshine = { brdf = @\"ward\", rho_d = 0.1, rho_s = 0.2, alpha_x = 0.2, "
         "alpha_y = 0.3 }\n",
         "depends on the tangent", "isotropic", 0},
        {PART_SETTINGS,
         "[photometry]\nearthshine = { brdf = @\"phong\", rho_d = 0.1, rho_s = 0.2, n = 3000 }\n",
         "has a lobe of", "at least 0.05 rad", 0},
        {PART_SETTINGS, "[photometry]\nearthshine = { brdf = @\"mirror\", R = 0.2 }\n",
         "has a lobe of 0", "at least 0.05 rad", 0},
        {PART_SETTINGS, "[photometry]\nextinction = @0.15\n", "a number", "{ V = 0.15 }", 0},
        {PART_SETTINGS, "[photometry]\nextinction = @true\n", "no extinction is known for band V",
         "{ V = 0.15 }", 0},
        {PART_SETTINGS, "[photometry]\nbands = [\"V\", \"B\"]\nextinction = @{ V = 0.15 }\n",
         "no 'B'", "mag per airmass", 0},
        {PART_SETTINGS, "[photometry]\nextinction = { V = @-0.1 }\n", "-0.1", "between 0 and 10",
         0},
        {PART_SETTINGS, "[photometry]\nextinction = { V = 0.1, @W = 0.1 }\n", "unknown key 'W'",
         "V", 0},
        {PART_SETTINGS, "[photometry]\n@band = [\"V\"]\n", "unknown key 'band'",
         "did you mean 'bands'?", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

START_TEST(test_scenario_corrections_and_output_wrong_are_refused)
{
    static const wrong_text all[] = {
        {PART_SETTINGS, "[corrections]\nlight_time = @1\n", "the number 1", "true or false", 0},
        {PART_SETTINGS, "[corrections]\naberration = @\"no\"\n", "\"no\"", "true or false", 0},
        {PART_SETTINGS, "[corrections]\ndut1_s = @1.0\n", "the number 1", "between -0.9 and 0.9",
         0},
        {PART_SETTINGS, "[corrections]\n@refraction = true\n", "unknown key 'refraction'",
         "light_time, aberration, dut1_s", 0},
        {PART_SETTINGS, "[output]\nrows = @\"seen\"\n", "\"seen\"", "all, visible, dark-site", 0},
        {PART_SETTINGS, "[output]\nshares = @true\n", "true", "a string", 0},
        {PART_SETTINGS, "[output]\nshares = @\"materials\"\n", "\"materials\"",
         "(did you mean \"material\"?)", 0},
        {PART_SETTINGS, "[output]\nsun_elevation_max_deg = @-91\n", "-91", "between -90 and 90", 0},
        {PART_SETTINGS, "[output]\n@row = \"all\"\n", "unknown key 'row'", "did you mean 'rows'?",
         0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

/* ------------------------------------------------------------------ given directions */

#define BUS "[[component]]\nname = \"bus\"\n"

START_TEST(test_scenario_geometry_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_TIME, "@[geometry]\n", "no source", "exactly one of table, sweep, rotate", 0},
        {PART_TIME,
         "@[geometry]\ntable = \"d.csv\"\nsweep = { phase_deg = [0, 1, 1], plane = \"xy\" }\n",
         "several sources", "exactly one", 0},
        {PART_TIME, "[geometry]\ntable = @\"nothing.csv\"\n", "nothing.csv", "No such file", 0},
        {PART_TIME, "[geometry]\ntable = @\".\"\n", "directory", "expected a file", 0},
        {PART_TIME,
         "[geometry]\nrange_km = @0\nsweep = { phase_deg = [0, 1, 1], plane = \"xy\" }\n",
         "the number 0", "between 1e-06", 0},
        {PART_TIME, "[geometry]\nsweep = @{ plane = \"xy\" }\n", "no 'phase_deg'", "3 numbers", 0},
        {PART_TIME, "[geometry]\nsweep = @{ phase_deg = [0, 1, 1] }\n", "no 'plane'", "a string",
         0},
        {PART_TIME, "[geometry]\nsweep = { phase_deg = [0, 1, 1], plane = @\"xx\" }\n", "\"xx\"",
         "xy, xz, yz", 0},
        {PART_TIME, "[geometry]\nsweep = { phase_deg = @[0, 1, 0], plane = \"xy\" }\n", "[0, 1, 0]",
         "step > 0", 0},
        {PART_TIME, "[geometry]\nsweep = { phase_deg = @[9, 1, 1], plane = \"xy\" }\n", "[9, 1, 1]",
         "from <= to", 0},
        {PART_TIME, "[geometry]\nsweep = { phase_deg = @[0, 1e3, 1], plane = \"xy\" }\n", "1000",
         "within -360 to 360", 0},
        {PART_TIME, "[geometry]\nsweep = { phase_deg = @[0, 1, 1e-9], plane = \"xy\" }\n",
         "1e+09 rows", "at most", 0},
        {PART_TIME,
         "[geometry]\nrotate = { axis = @[0, 0, 0], step_deg = 1, sun = [1, 0, 0], "
         "observer = [1, 0, 0] }\n",
         "a zero vector", "a direction", 0},
        {PART_TIME,
         "[geometry]\nrotate = { axis = [0, 0, 1], step_deg = @0, sun = [1, 0, 0], "
         "observer = [1, 0, 0] }\n",
         "the number 0", "above 0", 0},
        {PART_TIME, "[geometry]\nrotate = @{ axis = [0, 0, 1], step_deg = 1, sun = [1, 0, 0] }\n",
         "no 'observer'", "3 numbers", 0},
        {PART_TIME,
         "[geometry]\n@ranje_km = 3\nsweep = { phase_deg = [0, 1, 1], plane = \"xy\" }\n",
         "unknown key 'ranje_km'", "did you mean 'range_km'?", 0},
        {PART_ORBIT, "[@orbit]\n", "[orbit] stands beside [geometry]", "one of them", 0},
        {PART_ATTITUDE, "[@attitude]\n", "[attitude] stands beside [geometry]", "one of them", 0},
        {PART_OBSERVER, "[@observer]\n", "[observer] stands beside [geometry]", "one of them", 0},
        {PART_SETTINGS, "[@corrections]\n", "[corrections] stands beside", "one of them", 0},
        {PART_SETTINGS, "[@time]\n", "[time] stands beside [geometry]", "one of them", 0},
        {PART_SETTINGS, "[photometry]\nextinction = @{ V = 0.1 }\n", "no airmass",
         "extinction = false", 0},
        {PART_SETTINGS, "[output]\nrows = @\"visible\"\n", "no site", "rows = \"all\"", 0},
        {PART_COMPONENT,
         BUS "hinge = { origin_m = [0, 0, 0], axis = [0, 1, 0], track = @\"nadir\", face = [0, 0, "
             "1] }\n",
         "the Sun and the observer only", "track = \"sun\" or \"observer\"", 0},
        {PART_COMPONENT,
         BUS "hinge = { origin_m = [0, 0, 0], axis = [0, 1, 0], track = @{ ra_deg = 1, dec_deg = 1 "
             "}, face = [0, 0, 1] }\n",
         "the Sun and the observer only", "track = \"sun\" or \"observer\"", 0},
    };
    ASSERT_ALL_WRONG(GIVEN, all);
}
END_TEST

START_TEST(test_scenario_geometry_table_wrong_is_refused_in_the_table)
{
    static const struct {
        const char *text, *found, *expected;
        size_t n;
    } all[] = {
        {"@sun_x,sun_y,sun_z,obs_x,obs_y\n1,0,0,1,0\n", "no column 'obs_z'", "sun_x, sun_y", 1},
        {"sun_x,sun_y,sun_z,obs_x,obs_y,obs_z\n@0,0,0,1,0,0\n", "sun_x to sun_z is a zero vector",
         "a direction", 1},
        {"sun_x,sun_y,sun_z,obs_x,obs_y,obs_z\n1,0,0,@0,0,-0\n", "obs_x to obs_z is a zero vector",
         "a direction", 1},
        {"sun_x,sun_y,sun_z,obs_x,obs_y,obs_z\n1,0,0,0,@nan,1\n", "'nan'", "a finite number", 1},
        {"sun_x,sun_y,sun_z,obs_x,obs_y,obs_z\n1,@inf,0,0,0,1\n", "'inf'", "a finite number", 1},
        {"sun_x,sun_y,sun_z,obs_x,obs_y,obs_z\n1,@1e999,0,0,0,1\n", "'1e999'", "a finite number",
         1},
        {"sun_x,sun_y,sun_z,obs_x,obs_y,obs_z\n1,0,0,0,@,1\n", "''", "a finite number", 1},
        {"sun_x,sun_y,sun_z,obs_x,obs_y,obs_z\n@1,0,0,0,1\n", "5 cells", "expected 6", 1},
        {"sun_x,sun_y,sun_z,obs_x,obs_y,obs_z,range_km\n1,0,0,0,0,1,@0\n", "range_km is 0",
         "between 1e-6", 1},
        {"sun_x,sun_y,sun_z,obs_x,obs_y,obs_z,range_km\n1,0,0,0,0,1,@-5\n", "range_km is -5",
         "between 1e-6", 1},
        {"sun_x,sun_y,sun_z,obs_x,obs_y,obs_z,t_s\n1,0,0,0,0,1,@soon\n", "'soon'",
         "a finite number", 1},
        {"sun_x,sun_y,sun_z,obs_x,obs_y,obs_z,@sun_x\n", "'sun_x' stands twice", NULL, 1},
    };
    const marked_text s = with_part(GIVEN, PART_TIME, "[geometry]\ntable = \"d.csv\"\n");
    const char *path = write_file("scenario.toml", s.text);
    for (size_t k = 0; k < COUNT_OF(all); k++) {
        marked_text m;
        strcpy(m.text, all[k].text);
        take_mark(&m);
        const char *table = write_file("d.csv", m.text);
        assert_refused_set(path, NULL, 0, table, m.line, m.column, all[k].found, all[k].expected,
                           all[k].n);
    }
    const char *empty = write_file("d.csv", "sun_x,sun_y,sun_z,obs_x,obs_y,obs_z\n");
    assert_refused_set(path, NULL, 0, empty, 0, 0, "no rows", "at least one", 1);
}
END_TEST

/* ------------------------------------------------------------------ expectations */

#define VALUE "column = \"mag_V\"\nvalue = 1\ntolerance = 1\n"

START_TEST(test_scenario_expectation_wrong_is_refused)
{
    static const wrong_text all[] = {
        {PART_EXPECT, "@[[expect]]\n" VALUE, "neither t_s nor row", "one of", 0},
        {PART_EXPECT, "@[[expect]]\nt_s = 0\nrow = 0\n" VALUE, "both t_s and row", "one of", 0},
        {PART_EXPECT, "[[expect]]\nrow = @-1\n" VALUE, "the number -1", "from 0", 1},
        {PART_EXPECT, "[[expect]]\nrow = @0.5\n" VALUE, "0.5", "a whole number", 1},
        {PART_EXPECT, "@[[expect]]\nrow = 0\nvalue = 1\ntolerance = 1\n", "no 'column'", "a string",
         0},
        {PART_EXPECT, "@[[expect]]\nrow = 0\ncolumn = \"mag_V\"\ntolerance = 1\n", "no 'value'",
         "a number", 0},
        {PART_EXPECT, "@[[expect]]\nrow = 0\ncolumn = \"mag_V\"\nvalue = 1\n", "no tolerance",
         "'tolerance' (absolute) or 'relative'", 0},
        {PART_EXPECT, "[[expect]]\nrow = 0\ncolumn = \"mag_V\"\nvalue = 1\ntolerance = @-1\n", "-1",
         "at least 0", 0},
        {PART_EXPECT, "[[expect]]\nrow = 0\ncolumn = \"mag_V\"\nvalue = 1\nrelative = @2\n",
         "the number 2", "between 0 and 1", 0},
        {PART_EXPECT, "[[expect]]\nrow = 0\n" VALUE "@sorce = \"x\"\n", "unknown key 'sorce'",
         "did you mean 'source'?", 0},
        {PART_EXPECT, "@[expect_table]\nrelative = { mag_V = 1 }\n", "no 'file'", "a CSV file", 0},
        {PART_EXPECT, "[expect_table]\nfile = @\"no.csv\"\nrelative = { mag_V = 1 }\n", "no.csv",
         "No such file", 0},
        {PART_EXPECT, "@[expect_table]\nfile = \"good.csv\"\n", "no tolerances", "relative = {", 0},
        {PART_EXPECT, "[expect_table]\nfile = \"good.csv\"\nrelative = { @mag_B = 1 }\n",
         "no column 'mag_B'", NULL, 0},
        {PART_EXPECT, "[expect_table]\nfile = \"good.csv\"\ntolerance = { mag_V = @-1 }\n", "is -1",
         "0 or more", 0},
        {PART_EXPECT, "[expect_table]\nfile = \"good.csv\"\ntolerance = { mag_V = @\"1\" }\n",
         "the string", "a number", 0},
        {PART_EXPECT, "@[[require]]\ncolumn = \"mag_V\"\n", "no 'fainter_than'", "a number in mag",
         0},
        {PART_EXPECT, "@[[require]]\nfainter_than = 7\n", "no 'column'", "a string", 0},
        {PART_EXPECT, "[[require]]\ncolumn = \"mag_V\"\nfainter_than = 7\nfor_fraction = @99\n",
         "the number 99", "between 0 and 1", 0},
        {PART_EXPECT,
         "[[require]]\ncolumn = \"mag_V\"\nfainter_than = 7\nwhen = { range_km = @[2, 1] }\n",
         "[2, 1]", "lower limit", 0},
        {PART_EXPECT,
         "[[require]]\ncolumn = \"mag_V\"\nfainter_than = 7\nwhen = { range_km = @5 }\n",
         "the number 5", "2 numbers", 0},
        {PART_EXPECT,
         "[[require]]\ncolumn = \"mag_V\"\nfainter_than = 7\nreference_height_km = @0\n",
         "the number 0", "above 0", 0},
    };
    write_file("good.csv", "t_s,mag_V\n0,1\n");
    ASSERT_ALL_WRONG(SOUND, all);
    static const wrong_text height = {
        PART_EXPECT,
        "[[require]]\ncolumn = \"mag_V\"\nfainter_than = 7\nreference_height_km = @5\n",
        "no height", "no reference height", 0};
    assert_wrong(GIVEN, &height);
}
END_TEST

static Suite *scenario_errors_suite(void)
{
    Suite *suite = suite_create("scenario errors");
    TCase *tables = tcase_create("tables");
    tcase_set_timeout(tables, 60);
    tcase_add_checked_fixture(tables, folder_make, folder_remove);
    tcase_add_test(tables, test_scenario_time_wrong_is_refused);
    tcase_add_test(tables, test_scenario_observer_wrong_is_refused);
    tcase_add_test(tables, test_scenario_horizon_wrong_is_refused);
    tcase_add_test(tables, test_scenario_observers_without_different_names_are_refused);
    tcase_add_test(tables, test_scenario_observer_wanted_of_it_is_refused);
    tcase_add_test(tables, test_scenario_orbit_wrong_is_refused);
    tcase_add_test(tables, test_scenario_orbit_perigee_below_the_ground_is_refused);
    tcase_add_test(tables, test_scenario_tle_file_without_the_wanted_set_is_refused);
    tcase_add_test(tables, test_scenario_tle_file_error_names_the_element_set_file);
    tcase_add_test(tables, test_scenario_attitude_wrong_is_refused);
    tcase_add_test(tables, test_scenario_photometry_wrong_is_refused);
    tcase_add_test(tables, test_scenario_corrections_and_output_wrong_are_refused);
    tcase_add_test(tables, test_scenario_geometry_wrong_is_refused);
    tcase_add_test(tables, test_scenario_geometry_table_wrong_is_refused_in_the_table);
    tcase_add_test(tables, test_scenario_expectation_wrong_is_refused);
    suite_add_tcase(suite, tables);
    return suite;
}

int main(void)
{
    return run_suite(scenario_errors_suite());
}
