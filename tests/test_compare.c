/* Observed tracks held against predictions: tracks made from the program's own curve with offsets
 * and errors that are known, whose rms, R and chi^2 are computed here; formats; what is left out.
 */
#include "scenario_text.h"

#define PI 3.14159265358979323846

enum { MOST_ROWS = 64 };

/* A curve as its rows, copied. */
typedef struct rows {
    size_t n;
    double magnitude[MOST_ROWS], range_km[MOST_ROWS], phase_deg[MOST_ROWS], t_s[MOST_ROWS];
    double sunlit[MOST_ROWS];
    char utc[MOST_ROWS][32];
} rows;

static rows curve_of(const char *path)
{
    rows out = {0};
    glint_scenario *s = read_sound(path);
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    for (;;) {
        const glint_row *r;
        size_t n;
        ck_assert_int_eq(glint_curve_next(curve, &r, &n, NULL), GLINT_OK);
        if (n == 0) break;
        for (size_t k = 0; k < n; k++, out.n++) {
            ck_assert_uint_lt(out.n, MOST_ROWS);
            out.magnitude[out.n] = r[k].magnitude[0];
            out.range_km[out.n] = r[k].range_m * 1e-3;
            out.phase_deg[out.n] = r[k].phase_angle_rad * 180 / PI;
            out.t_s[out.n] = r[k].t_s;
            out.sunlit[out.n] = r[k].sunlit_fraction;
            const glint_utc *u = &r[k].utc;
            snprintf(out.utc[out.n], sizeof out.utc[out.n], "%04d-%02d-%02dT%02d:%02d:%02d.%06dZ",
                     u->year, u->month, u->day, u->hour, u->minute, u->second, u->microsecond);
        }
    }
    glint_curve_close(curve);
    glint_scenario_free(s);
    return out;
}

/* The sound scenario with [observed] at its end. */
static const char *write_scenario(const char *observed)
{
    const marked_text m = with_part(SOUND, PART_EXPECT, observed);
    return write_file("scenario.toml", m.text);
}

static rows sound_curve(void)
{
    return curve_of(write_file("plain.toml", with_part(SOUND, PART_TOP, "").text));
}

/* A comparison with its scenario. */
typedef struct compared {
    glint_scenario *s;
    glint_comparison *c;
    glint_comparison_summary total;
} compared;

static compared compare(const char *observed)
{
    compared out = {.s = read_sound(write_scenario(observed))};
    glint_error error = {0};
    ck_assert_msg(glint_compare(out.s, 1, &out.c, &error) == GLINT_OK, "%s", error.message);
    glint_comparison_total(out.c, &out.total);
    return out;
}

static void end(compared *c)
{
    glint_comparison_free(c->c);
    glint_scenario_free(c->s);
}

static const char CSV[] = "[observed]\nfile = \"track.csv\"\n";

/* ------------------------------------------------------------ known numbers */

/* Residuals and errors that are known, of the seven rows of the sound scenario. */
static const double OFFSETS[7] = {0.5, 0.3, 0.6, 0.2, 0.4, 0.7, 0.1};
static const double SIGMAS[7] = {0.1, 0.2, 0.1, 0.3, 0.1, 0.2, 0.4};

static void write_track(const rows *r, bool with_sigma)
{
    char track[4096];
    int n = sprintf(track, "utc,magnitude%s\n", with_sigma ? ",sigma" : "");
    for (size_t k = 0; k < r->n; k++) {
        n += sprintf(track + n, "%s,%.15g", r->utc[k], r->magnitude[k] + OFFSETS[k]);
        n += with_sigma ? sprintf(track + n, ",%g\n", SIGMAS[k]) : sprintf(track + n, "\n");
    }
    write_file("track.csv", track);
}

/* Pearson's R from sums of products, another way than by means. */
static double correlation(const double *a, const double *b, size_t n)
{
    double sa = 0, sb = 0, aa = 0, bb = 0, ab = 0;
    for (size_t k = 0; k < n; k++) {
        sa += a[k], sb += b[k];
        aa += a[k] * a[k], bb += b[k] * b[k], ab += a[k] * b[k];
    }
    const double m = (double)n;
    return (m * ab - sa * sb) / sqrt((m * aa - sa * sa) * (m * bb - sb * sb));
}

START_TEST(test_compare_known_offsets_give_known_numbers)
{
    const rows r = sound_curve();
    ck_assert_uint_eq(r.n, 7);
    write_track(&r, true);
    compared c = compare(CSV);
    double observed[7], chi2 = 0, relative = 0;
    for (int k = 0; k < 7; k++) {
        observed[k] = r.magnitude[k] + OFFSETS[k];
        chi2 += OFFSETS[k] * OFFSETS[k] / (SIGMAS[k] * SIGMAS[k]);
        relative += OFFSETS[k] * OFFSETS[k] / observed[k] / 7;
    }
    const double exact = 1e-12; /* 15 digits of the track */
    ck_assert_int_eq(c.total.compared, 7);
    ck_assert_int_eq(c.total.penumbra, 0);
    assert_near(c.total.mean, 0.4, exact);      /* 2.8 / 7 */
    assert_near(c.total.rms, sqrt(0.2), exact); /* 1.40 / 7 */
    assert_near(c.total.scatter, 0.2, exact);   /* sqrt(0.2 - 0.16) */
    assert_near(c.total.largest, 0.7, exact);
    assert_rel(c.total.chi2, chi2, 1e-11);
    assert_near(c.total.chi2_relative, relative, exact);
    ck_assert(c.total.has_r && c.total.has_chi2_relative);
    assert_near(c.total.r, correlation(observed, r.magnitude, 7),
                1e-9); /* cancels: 1e-16 * 6^2/var */
    ck_assert_int_eq(c.total.freedom, 7);
    assert_near(c.total.zero_point, 0, 0);
    for (size_t k = 0; k < 7; k++) {
        glint_observation o;
        ck_assert(glint_comparison_get(c.c, k, &o));
        assert_near(o.predicted, r.magnitude[k], exact); /* as the curve has it */
        assert_near(o.residual, OFFSETS[k], exact);
        assert_near(o.t_s, r.t_s[k], 1e-9);
        ck_assert_int_eq(o.line, (int)k + 2);
    }
    end(&c);
}
END_TEST

START_TEST(test_compare_zero_point_is_the_mean)
{
    const rows r = sound_curve();
    write_track(&r, false);
    compared c = compare("[observed]\nfile = \"track.csv\"\nfit_zero_point = true\n");
    assert_near(c.total.zero_point, 0.4, 1e-12);
    assert_near(c.total.mean, 0, 1e-12);
    assert_near(c.total.rms, 0.2, 1e-12);
    assert_near(c.total.zero_point_sigma, 0.2 / sqrt(6), 1e-12); /* s / sqrt(n), s^2 of n - 1 */
    ck_assert_int_eq(c.total.with_sigma, 0);
    end(&c);
    write_track(&r, true);
    c = compare("[observed]\nfile = \"track.csv\"\nfit_zero_point = true\n");
    double sum = 0, weights = 0, chi2 = 0;
    for (int k = 0; k < 7; k++) {
        sum += OFFSETS[k] / (SIGMAS[k] * SIGMAS[k]);
        weights += 1 / (SIGMAS[k] * SIGMAS[k]);
    }
    for (int k = 0; k < 7; k++)
        chi2 += pow((OFFSETS[k] - sum / weights) / SIGMAS[k], 2);
    assert_near(c.total.zero_point, sum / weights, 1e-12);
    assert_near(c.total.zero_point_sigma, 1 / sqrt(weights), 1e-12);
    assert_rel(c.total.chi2, chi2, 1e-10);
    ck_assert_int_eq(c.total.freedom, 6);
    end(&c);
}
END_TEST

/* Julian dates, modified or not, mean the same moments: 1e-10 d are 9 us. */
START_TEST(test_compare_julian_dates_are_the_same_moments)
{
    const rows r = sound_curve();
    static const char *const names[] = {"jd", "mjd"};
    static const char *const days[] = {"2460882", "60881"};
    for (int kind = 0; kind < 2; kind++) {
        char track[4096];
        int n = sprintf(track, "%s,magnitude\n", names[kind]);
        for (size_t k = 0; k < r.n; k++) {
            /* 20:37 of 25 July 2025 is 0.859027... d past MJD 60881, 0.5 d less past JD */
            const double day = (20 * 3600 + 37 * 60 + r.t_s[k]) / 86400 - (kind == 0 ? 0.5 : 0);
            char fraction[32];
            snprintf(fraction, sizeof fraction, "%.12f", day);
            n += sprintf(track + n, "%s%s,%.15g\n", days[kind], fraction + 1, r.magnitude[k]);
        }
        write_file("track.csv", track);
        compared c = compare(CSV);
        ck_assert_int_eq(c.total.compared, 7);
        for (size_t k = 0; k < r.n; k++) {
            glint_observation o;
            ck_assert(glint_comparison_get(c.c, k, &o));
            assert_near(o.t_s, r.t_s[k], 1e-7); /* 1e-12 d */
        }
        assert_near(c.total.rms, 0, 1e-8);
        end(&c);
    }
}
END_TEST

/* The number behind a key in JSON. */
static double number_of(const char *text, const char *key)
{
    char quoted[64];
    snprintf(quoted, sizeof quoted, "\"%s\":", key);
    const char *at = strstr(text, quoted);
    ck_assert_msg(at != NULL, "no %s in %s", key, text);
    return strtod(at + strlen(quoted), NULL);
}

/* What is written is what was found, in the units that the names tell, with ranges 2 km and phase
 * angles -0.5 deg off. */
static void check_written(const compared *c)
{
    const char *path = in_folder("out");
    ck_assert_int_eq(glint_comparison_write(c->c, GLINT_FORMAT_JSON, path, NULL), GLINT_OK);
    char *text = read_bytes(path, NULL);
    assert_near(number_of(text, "range_mean_km"), 2, 1e-9);
    assert_near(number_of(text, "range_most_km"), 2, 1e-9);
    assert_near(number_of(text, "phase_mean_deg"), -0.5, 1e-10);
    assert_near(number_of(text, "phase_most_deg"), -0.5, 1e-10);
    assert_near(number_of(text, "mean_mag"), c->total.mean, 0);
    assert_near(number_of(text, "rms_mag"), c->total.rms, 0);
    assert_near(number_of(text, "scatter_mag"), c->total.scatter, 0);
    assert_near(number_of(text, "largest_mag"), c->total.largest, 0);
    glint_observation o;
    ck_assert(glint_comparison_get(c->c, 0, &o));
    assert_near(number_of(text, "range_km"), o.range_m / 1000, 1e-9);
    assert_near(number_of(text, "observed_range_km"), o.range_m / 1000 + 2, 1e-9);
    assert_near(number_of(text, "phase_angle_deg"), o.phase_rad * 180 / PI, 1e-12);
    assert_near(number_of(text, "residual"), o.residual, 0);
    free(text);
}

/* m - 5 log10(range / 1000 km), and + 2.5 log10(sin phi + (pi - phi) cos phi) at 90 deg. */
START_TEST(test_compare_standard_magnitudes_closed_form)
{
    const rows r = sound_curve();
    for (int kind = 0; kind < 2; kind++) {
        char track[4096], observed[256];
        int n = sprintf(track, "utc,magnitude,range_km,phase_deg\n");
        for (size_t k = 0; k < r.n; k++) {
            const double phi = r.phase_deg[k] * PI / 180;
            double m = r.magnitude[k] - 5 * log10(r.range_km[k] / 1000);
            if (kind == 1) m += 2.5 * log10(sin(phi) + (PI - phi) * cos(phi));
            n += sprintf(track + n, "%s,%.15g,%.15g,%.15g\n", r.utc[k], m + 0.25, r.range_km[k] + 2,
                         r.phase_deg[k] - 0.5);
        }
        write_file("track.csv", track);
        snprintf(observed, sizeof observed, "%smagnitude = \"%s\"\n", CSV,
                 kind ? "at-1000-km-90-deg" : "at-1000-km");
        compared c = compare(observed);
        assert_near(c.total.mean, 0.25, 1e-12);
        assert_near(c.total.scatter, 0, 1e-11);
        ck_assert_int_eq(c.total.with_range, 7);
        assert_near(c.total.range_mean_m, 2000, 1e-6);
        assert_near(c.total.range_most_m, 2000, 1e-6);
        assert_near(c.total.phase_mean_rad, -0.5 * PI / 180, 1e-12);
        assert_near(c.total.phase_most_rad, -0.5 * PI / 180, 1e-12);
        check_written(&c);
        end(&c);
    }
}
END_TEST

/* ---------------------------------------------------------- what is left out */

/* The satellite enters the Earth's shadow at some moment of this half revolution, and a row lies on
 * the way there: rows in the shadow are told of and not compared, whatever their magnitudes. */
START_TEST(test_compare_eclipsed_observations_are_left_out)
{
    static const char *const parts[N_PARTS] = {
        [PART_TIME] = "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 3000\nstep_s = 100\n",
        [PART_OBSERVER] =
            "[observer]\nlatitude_deg = 48.2\nlongitude_deg = 16.37\nmin_elevation_deg = -90\n",
    };
    const char *all[N_PARTS];
    for (int k = 0; k < N_PARTS; k++)
        all[k] = parts[k] ? parts[k] : SOUND[k];
    const rows r = curve_of(write_file("plain.toml", with_part(all, PART_TOP, "").text));
    char track[4096];
    int n = sprintf(track, "utc,magnitude\n");
    int bright = 0, penumbra = 0;
    for (size_t k = 0; k < r.n; k++) {
        bright += r.magnitude[k] != 0;
        penumbra += r.sunlit[k] > 0 && r.sunlit[k] < 1;
        n += sprintf(track + n, "%s,%.15g\n", r.utc[k], r.magnitude[k] != 0 ? r.magnitude[k] : 12);
    }
    ck_assert_int_gt(bright, 3);
    ck_assert_int_lt(bright, (int)r.n - 3);
    write_file("track.csv", track);
    glint_scenario *s =
        read_sound(write_file("scenario.toml", with_part(all, PART_EXPECT, CSV).text));
    glint_comparison *c;
    glint_comparison_summary total;
    ck_assert_int_eq(glint_compare(s, 1, &c, NULL), GLINT_OK);
    glint_comparison_total(c, &total);
    ck_assert_int_eq(total.compared, bright);
    ck_assert_int_eq(total.compared + total.eclipsed + total.dark, (int)r.n);
    ck_assert_int_gt(total.eclipsed, 3);
    ck_assert_int_gt(penumbra, 0);
    ck_assert_int_eq(total.penumbra, penumbra);
    assert_near(total.rms, 0, 1e-11);
    glint_comparison_free(c);
    glint_scenario_free(s);
}
END_TEST

START_TEST(test_compare_counts_what_it_leaves_out)
{
    write_file("track.csv", "when,mag,err,band\n"
                            "2025-07-25T20:36:59Z,5,0.1,V\n" /* before the start */
                            "2025-07-25T20:37:00Z,5,,v\n"    /* at it */
                            "2025-07-25 20:37:30,5,0.1,V\n"
                            "2025-07-25T20:37:31Z,5,0.1,R\n"      /* another filter */
                            "2025-07-25T20:37:32Z,,0.1,V\n"       /* not detected */
                            "2025-07-25T22:38:00+02:00,5,0.1,V\n" /* at the end */
                            "2025-07-25T20:38:01Z,5,0.1,V\n"
                            "2025-07-25T20:37:03Z,5,0.1,V"); /* may be cut */
    compared c = compare("[observed]\nfile = \"track.csv\"\nfilter = \"V\"\n"
                         "columns = { utc = \"when\", magnitude = \"mag\", sigma = \"err\", "
                         "filter = \"band\" }\n");
    ck_assert_int_eq(c.total.observations, 7);
    ck_assert_int_eq(c.total.compared, 3);
    ck_assert_int_eq(c.total.outside_time, 2);
    ck_assert_int_eq(c.total.other_filter, 1);
    ck_assert_int_eq(c.total.without_magnitude, 1);
    ck_assert_int_eq(c.total.with_sigma, 2);
    end(&c);
}
END_TEST

START_TEST(test_compare_observations_in_any_order_and_over_days)
{
    const char *path =
        write_file("track.csv", "utc,magnitude\n2025-07-30T20:37:00Z,1\n2025-07-25T20:37:10Z,2\n"
                                "2025-07-30T20:37:00Z,3\n2025-07-25T20:37:00Z,4\n");
    (void)path;
    const char *all[N_PARTS];
    for (int k = 0; k < N_PARTS; k++)
        all[k] = SOUND[k];
    all[PART_TIME] = "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 600000\nstep_s = 1000\n";
    glint_scenario *s =
        read_sound(write_file("scenario.toml", with_part(all, PART_EXPECT, CSV).text));
    glint_comparison *c;
    ck_assert_int_eq(glint_compare(s, 1, &c, NULL), GLINT_OK);
    const double want_t_s[4] = {432000, 10, 432000, 0};
    for (size_t k = 0; k < 4; k++) {
        glint_observation o;
        ck_assert(glint_comparison_get(c, k, &o));
        assert_near(o.t_s, want_t_s[k], 1e-6);
        ck_assert_int_eq(o.line, (int)k + 2);
    }
    glint_comparison_free(c);
    glint_scenario_free(s);
}
END_TEST

/* Of two observers the track is that of the one it names, and of nobody where it names none. */
START_TEST(test_compare_track_of_one_of_two_observers)
{
    static const char two[] =
        "[[observer]]\nname = \"Graz\"\nlatitude_deg = 47.07\nlongitude_deg = 15.44\n"
        "[[observer]]\nname = \"Vienna\"\nlatitude_deg = 48.2\nlongitude_deg = 16.37\n";
    const rows r = sound_curve();
    const char *all[N_PARTS];
    for (int k = 0; k < N_PARTS; k++)
        all[k] = SOUND[k];
    all[PART_OBSERVER] = two;
    write_track(&r, false);
    for (int k = 0; k < 2; k++) {
        char observed[256];
        snprintf(observed, sizeof observed, "%sobserver = \"%s\"\n", CSV, k ? "Vienna" : "Graz");
        glint_scenario *s =
            read_sound(write_file("scenario.toml", with_part(all, PART_EXPECT, observed).text));
        glint_comparison *c;
        glint_comparison_summary total;
        ck_assert_int_eq(glint_compare(s, 1, &c, NULL), GLINT_OK);
        glint_comparison_total(c, &total);
        if (k == 1)
            assert_near(total.mean, 0.4, 1e-12);
        else
            ck_assert(fabs(total.mean - 0.4) > 0.01); /* 140 km away */
        glint_comparison_free(c);
        glint_scenario_free(s);
    }
    const wrong_text nobody = {PART_EXPECT, "@[observed]\nfile = \"track.csv\"\n", "no 'observer'",
                               NULL, 0};
    assert_wrong(all, &nobody);
}
END_TEST

/* A single observation, and a constant series: no correlation, no NaN. */
START_TEST(test_compare_degenerate_tracks_have_no_correlation)
{
    static const char *const tracks[] = {
        "utc,magnitude\n2025-07-25T20:37:10Z,0\n",
        "utc,magnitude\n2025-07-25T20:37:10Z,5\n2025-07-25T20:37:20Z,5\n",
        "utc,magnitude\n2024-07-25T20:37:10Z,5\n",
    };
    for (size_t k = 0; k < COUNT_OF(tracks); k++) {
        write_file("track.csv", tracks[k]);
        compared c = compare("[observed]\nfile = \"track.csv\"\nfit_zero_point = true\n");
        ck_assert(!c.total.has_r);
        ck_assert(isfinite(c.total.rms) && isfinite(c.total.scatter) &&
                  isfinite(c.total.zero_point) && isfinite(c.total.zero_point_sigma));
        for (int format = GLINT_FORMAT_TABLE; format <= GLINT_FORMAT_JSON; format++) {
            ck_assert_int_eq(
                glint_comparison_write(c.c, (glint_format)format, in_folder("out"), NULL),
                GLINT_OK);
            char *bytes = read_bytes(in_folder("out"), NULL);
            ck_assert_ptr_null(strstr(bytes, "nan"));
            free(bytes);
        }
        end(&c);
    }
}
END_TEST

/* What rounds to zero is written without a sign, from either side. */
START_TEST(test_compare_table_has_no_negative_zeros)
{
    const rows r = sound_curve();
    for (int side = -1; side <= 1; side += 2) {
        char track[4096];
        int n = sprintf(track, "utc,magnitude\n");
        for (size_t k = 0; k < r.n; k++)
            n += sprintf(track + n, "%s,%.15g\n", r.utc[k], r.magnitude[k] + side * 1e-6);
        write_file("track.csv", track);
        compared c = compare(CSV);
        ck_assert_int_eq(glint_comparison_write(c.c, GLINT_FORMAT_TABLE, in_folder("out"), NULL),
                         GLINT_OK);
        char *bytes = read_bytes(in_folder("out"), NULL);
        ck_assert_ptr_nonnull(
            strstr(bytes, "mean 0.0000, scatter 0.0000, rms 0.0000, largest 0.0000 mag\n"));
        ck_assert_ptr_nonnull(strstr(bytes, "     0.000 "));
        ck_assert_ptr_null(strstr(bytes, "-0.0"));
        ck_assert_ptr_null(strstr(bytes, "+0.0"));
        free(bytes);
        end(&c);
    }
}
END_TEST

/* ------------------------------------------------------------------ formats */

/* Two tracks of MMT, with comments and without, with the number of the track. */
START_TEST(test_compare_mmt_tracks)
{
    const rows r = sound_curve();
    char track[4096];
    int n = sprintf(track, "# Satellite: a box\n# Date(UTC) Time StdMag Mag Filter Penumbra "
                           "Distance(km) Phase(deg) Channel Track\n");
    for (size_t k = 0; k < r.n; k++) {
        const double phi = r.phase_deg[k] * PI / 180;
        const double standard = r.magnitude[k] - 5 * log10(r.range_km[k] / 1000) +
                                2.5 * log10(sin(phi) + (PI - phi) * cos(phi));
        if (k == 4) n += sprintf(track + n, "\n# another track\n");
        n += sprintf(track + n, "%.10s %.15s  %.15g\t%.15g %s 0 %.15g %.15g 3 %d\r\n", r.utc[k],
                     r.utc[k] + 11, standard + 0.5, r.magnitude[k] + 0.1, k == 2 ? "B" : "Clear",
                     r.range_km[k], r.phase_deg[k], k < 4 ? 17 : 18);
    }
    write_file("track.txt", track);
    static const char MMT[] = "[observed]\nfile = \"track.txt\"\nformat = \"mmt\"\n";
    compared c = compare(MMT);
    ck_assert_int_eq(c.total.compared, 7);
    assert_near(c.total.mean, 0.1, 1e-12);
    assert_near(c.total.scatter, 0, 1e-11);
    assert_near(c.total.range_most_m, 0, 1e-6);
    assert_near(c.total.phase_most_rad, 0, 1e-12);
    end(&c);
    char observed[256];
    snprintf(observed, sizeof observed, "%smagnitude = \"at-1000-km-90-deg\"\nfilter = \"clear\"\n",
             MMT);
    c = compare(observed);
    ck_assert_int_eq(c.total.compared, 6);
    ck_assert_int_eq(c.total.other_filter, 1);
    assert_near(c.total.mean, 0.5, 1e-12);
    assert_near(c.total.scatter, 0, 1e-11);
    end(&c);
}
END_TEST

/* The columns of SCORE's template; a non-detection has no magnitude, an unknown error is 0. */
START_TEST(test_compare_score_reports)
{
    static const char head[] =
        "satellite_name,norad_cat_id,observation_time_utc,observation_time_uncertainty_sec,"
        "apparent_magnitude,apparent_magnitude_uncertainty,observer_latitude_deg,"
        "observer_longitude_deg,observer_altitude_m,limiting_magnitude,instrument,observing_mode,"
        "observing_filter,observer_email,observer_orcid,range_to_satellite_km,comments\n";
    char report[2048];
    snprintf(report, sizeof report,
             "%sBOX,1,2025-07-25T20:37:10.000Z,.01,5.5,.1,48,16,0,9,none,CCD,V,a@b.c,\"1, "
             "2\",900,\"x, y\"\n"
             "BOX,1,2025-07-25T20:37:20.000Z,.01,5.6,0,48,16,0,9,none,CCD,V,a@b.c,1,,\n"
             "BOX,1,2025-07-25T20:37:30.000Z,.01,,,48,16,0,9,none,CCD,V,a@b.c,1,,\n",
             head);
    write_file("report.csv", report);
    compared c = compare("[observed]\nfile = \"report.csv\"\nformat = \"score\"\n");
    ck_assert_int_eq(c.total.compared, 2);
    ck_assert_int_eq(c.total.without_magnitude, 1);
    ck_assert_int_eq(c.total.with_sigma, 1);
    ck_assert_int_eq(c.total.with_range, 1);
    end(&c);
}
END_TEST

/* What is left of a report by somebody who needs little. */
START_TEST(test_compare_score_report_with_few_columns)
{
    write_file("report.csv", "observation_time_utc,apparent_magnitude\n"
                             "2025-07-25T20:37:10.000Z,5.5\n");
    compared c = compare("[observed]\nfile = \"report.csv\"\nformat = \"score\"\n");
    ck_assert_int_eq(c.total.compared, 1);
    ck_assert_int_eq(c.total.with_sigma, 0);
    ck_assert_int_eq(c.total.with_range, 0);
    end(&c);
}
END_TEST

/* A track of which nothing is left says why. */
START_TEST(test_compare_track_without_a_row_that_counts_is_warned_of)
{
    write_file("track.csv", "utc,magnitude,filter\n2025-07-24T20:37:10Z,5.5,V\n"
                            "2025-07-26T20:37:11.5Z,5.5,V\n2025-07-25T20:37:10Z,5.5,Clear\n"
                            "2025-07-25T20:37:10Z,,V\n");
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    const char *path = write_scenario("[observed]\nfile = \"track.csv\"\nfilter = \"v\"\n");
    ck_assert_int_eq(glint_scenario_read(path, NULL, 0, &s, errors), GLINT_OK);
    ck_assert_uint_eq(glint_errors_count(errors), 1);
    const char *said = glint_errors_get(errors, 0)->message;
    ck_assert_int_eq(glint_errors_get(errors, 0)->severity, GLINT_WARNING);
    ck_assert_msg(strstr(said, "2 lie outside of [time], from 2025-07-24T20:37:10.000000Z to "
                               "2025-07-26T20:37:11.500000Z UTC") &&
                      strstr(said, "1 have another filter, as 'Clear'") &&
                      strstr(said, "1 have no magnitude"),
                  "%s", said);
    glint_scenario_free(s);
    glint_errors_free(errors);
}
END_TEST

/* ------------------------------------------------------ between observations */

/* Observations every 7 s on three days in turn, more than a thread takes at once: the numbers are
 * those of one thread. */
START_TEST(test_compare_any_number_of_threads_gives_the_same_numbers)
{
    enum { N = 300 };
    char *track = malloc(N * 64);
    int n = sprintf(track, "mjd,magnitude\n");
    for (int k = 0; k < N; k++)
        n += sprintf(track + n, "%.8f,%d\n", 60881.8591 + (k % 3) + 7.0 / 86400 * (k / 3),
                     5 + k % 4);
    write_file("track.csv", track);
    free(track);
    const marked_text m = with_part(SOUND, PART_EXPECT, CSV);
    const char *const days[] = {"time.duration_s=200000"};
    glint_scenario *s;
    ck_assert_int_eq(glint_scenario_read(write_file("days.toml", m.text), days, 1, &s, NULL),
                     GLINT_OK);
    glint_comparison *one;
    ck_assert_int_eq(glint_compare(s, 1, &one, NULL), GLINT_OK);
    for (int threads = 2; threads <= 7; threads += 5) {
        glint_comparison *many;
        glint_observation a, b;
        size_t k = 0;
        ck_assert_int_eq(glint_compare(s, threads, &many, NULL), GLINT_OK);
        for (; glint_comparison_get(one, k, &a) && glint_comparison_get(many, k, &b); k++)
            ck_assert(a.state == b.state && a.predicted == b.predicted && a.range_m == b.range_m &&
                      a.phase_rad == b.phase_rad);
        ck_assert_uint_eq(k, N);
        glint_comparison_free(many);
    }
    glint_comparison *none;
    ck_assert_int_eq(glint_compare(s, -1, &none, NULL), GLINT_ARGUMENT);
    glint_comparison_free(one);
    glint_scenario_free(s);
}
END_TEST

/* Predictions at any moment are the rows of the run there. */
START_TEST(test_compare_predicts_between_observations)
{
    const rows r = sound_curve();
    write_file("track.csv", "utc,magnitude\n2025-07-25T20:37:00Z,5\n2025-07-25T20:38:00Z,5\n");
    compared c = compare(CSV);
    double predicted[7], t_s[7];
    for (int threads = 0; threads < 3; threads++) {
        ck_assert_int_eq(glint_comparison_predict(c.c, r.t_s, r.n, threads, predicted, NULL),
                         GLINT_OK);
        for (size_t k = 0; k < r.n; k++)
            assert_near(predicted[k], r.magnitude[k], 1e-9); /* light times differ by 1e-12 s */
    }
    memcpy(t_s, r.t_s, sizeof t_s);
    t_s[3] = t_s[2] - 1;
    ck_assert_int_eq(glint_comparison_predict(c.c, t_s, 7, 1, predicted, NULL), GLINT_ARGUMENT);
    const double outside[] = {60.1}, before[] = {-0.1};
    ck_assert_int_eq(glint_comparison_predict(c.c, outside, 1, 1, predicted, NULL), GLINT_ARGUMENT);
    ck_assert_int_eq(glint_comparison_predict(c.c, before, 1, 1, predicted, NULL), GLINT_ARGUMENT);
    ck_assert_int_eq(glint_comparison_predict(c.c, r.t_s, r.n, 1025, predicted, NULL),
                     GLINT_ARGUMENT);
    end(&c);
    const char *const low[] = {"observer.min_elevation_deg=89"};
    glint_scenario *s;
    ck_assert_int_eq(glint_scenario_read(write_scenario(CSV), low, 1, &s, NULL), GLINT_OK);
    ck_assert_int_eq(glint_compare(s, 1, &c.c, NULL), GLINT_OK);
    ck_assert_int_eq(glint_comparison_predict(c.c, r.t_s, r.n, 1, predicted, NULL), GLINT_OK);
    for (size_t k = 0; k < r.n; k++)
        ck_assert(predicted[k] == HUGE_VAL);
    glint_comparison_free(c.c);
    glint_scenario_free(s);
}
END_TEST

/* Exposures are predicted as exposures: a mirror-like box that spins flashes within them. */
START_TEST(test_compare_exposures_are_those_of_the_run)
{
    static const char *const set[] = {
        "time.exposure_s=4",
        "attitude={law=\"spin\", body_axis=[1,0,0], pole=\"sun\", period_s=3, "
        "phase_deg=0}",
        "materials.white={brdf=\"ward-gmd\", rho_d=0.1, rho_s=0.5, alpha_x=0.05, alpha_y=0.05}"};
    write_file("track.csv", "utc,magnitude\n2025-07-25T20:37:00Z,5\n2025-07-25T20:37:30Z,5\n"
                            "2025-07-25T20:38:00Z,5\n");
    glint_scenario *s;
    ck_assert_int_eq(glint_scenario_read(write_scenario(CSV), set, COUNT_OF(set), &s, NULL),
                     GLINT_OK);
    glint_curve *curve;
    glint_comparison *c;
    const glint_row *run;
    glint_observation o;
    size_t n;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    ck_assert_int_eq(glint_curve_next(curve, &run, &n, NULL), GLINT_OK);
    ck_assert_uint_eq(n, 7);
    ck_assert_int_eq(glint_compare(s, 1, &c, NULL), GLINT_OK);
    for (size_t k = 0; k < 3; k++) {
        ck_assert(glint_comparison_get(c, k, &o));
        assert_near(o.predicted, run[3 * k].magnitude[0], 1e-7); /* EXPOSURE_TOLERANCE: 1e-8 */
    }
    glint_comparison_free(c);
    glint_curve_close(curve);
    glint_scenario_free(s);
}
END_TEST

/* ------------------------------------------------------------------- errors */

/* Reads a scenario that must be refused for its track, at that place of the file. */
static void assert_track_refused(const char *observed, const char *track, int line, int column,
                                 const char *said)
{
    const char *file = write_file("track.csv", track);
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(glint_scenario_read(write_scenario(observed), NULL, 0, &s, errors),
                     GLINT_INPUT);
    ck_assert_msg(has_error(errors, file, line, column, said, NULL),
                  "wanted %d:%d with '%s'; got:%s", line, column, said, list_errors(errors));
    ck_assert_uint_eq(glint_errors_error_count(errors), 1);
    glint_errors_free(errors);
}

START_TEST(test_compare_wrong_tracks_are_refused_at_their_place)
{
    static const struct {
        const char *track;
        int line, column;
        const char *said;
    } csv[] = {
        {"utc,magnitude\n2025-07-25T20:37:00Z,x\n", 2, 22, "the magnitude is 'x'"},
        {"utc,magnitude\n2025-07-25T20:37:00Z,nan\n", 2, 22, "the magnitude is 'nan'"},
        {"utc,magnitude\n2025-07-25T20:37:00Z,99\n", 2, 22, "the magnitude is 99"},
        {"utc,magnitude\n2025-07-32T20:37:00Z,9\n", 2, 1, "32"},
        {"jd,magnitude\n60881.859,9\n", 2, 1, "not in the years"},
        {"mjd,magnitude\n2460882.359,9\n", 2, 1, "not in the years"},
        {"mjd,magnitude\n-60881.859,9\n", 2, 1, "the date is '-60881.859'"},
        {"mjd,magnitude\n6.0e4,9\n", 2, 1, "the date is '6.0e4'"},
        {"utc,magnitude,sigma\n2025-07-25T20:37:00Z,9,0\n", 2, 24, "deviation is 0"},
        {"utc,magnitude,sigma\n2025-07-25T20:37:00Z,9,-1\n", 2, 24, "deviation is -1"},
        {"utc,magnitude,range_km\n2025-07-25T20:37:00Z,9,0\n", 2, 24, "range, km, is 0"},
        {"utc,magnitude,phase_deg\n2025-07-25T20:37:00Z,9,190\n", 2, 24, "deg, is 190"},
        {"time,magnitude\n2025-07-25T20:37:00Z,9\n", 1, 1, "none of the columns utc, jd and mjd"},
        {"utc,jd,magnitude\n2025-07-25T20:37:00Z,2460882.5,9\n", 1, 1, "several of the columns"},
        {"utc,mag\n2025-07-25T20:37:00Z,9\n", 1, 1, "no column 'magnitude'"},
        {"utc,magnitude\n", 0, 0, "no observation"},
    };
    for (size_t k = 0; k < COUNT_OF(csv); k++)
        assert_track_refused(CSV, csv[k].track, csv[k].line, csv[k].column, csv[k].said);
    static const char MMT[] = "[observed]\nfile = \"track.csv\"\nformat = \"mmt\"\n";
    static const char SCORE[] = "[observed]\nfile = \"track.csv\"\nformat = \"score\"\n";
    assert_track_refused(SCORE, "utc,apparent_magnitude\n2025-07-25T20:37:00Z,9\n", 1, 1,
                         "no column 'observation_time_utc'; expected the columns of SCORE");
    static const char row[] = "2025-07-25 20:37:00 5 6 Clear 0 900 80 3\n";
    char track[512];
    snprintf(track, sizeof track, "%s2025-07-25 20:37:00 5 6 Clear 0 900 80\n", row);
    assert_track_refused(MMT, track, 2, 1, "has 8 words");
    snprintf(track, sizeof track, "%s2025-07-25 20:37:00 5 x Clear 0 900 80 3\n", row);
    assert_track_refused(MMT, track, 2, 23, "the magnitude is 'x'");
    snprintf(track, sizeof track, "# Date Time Mag StdMag Filter\n%s", row);
    assert_track_refused(MMT, track, 1, 13, "column 3 of the track is 'Mag'");
    snprintf(track, sizeof track, "%s2025-07-25 25:37:00 5 6 Clear 0 900 80 3\n", row);
    assert_track_refused(MMT, track, 2, 1, "25");
}
END_TEST

START_TEST(test_compare_wrong_keys_are_refused)
{
    write_file("track.csv", "utc,magnitude\n2025-07-25T20:37:00Z,9\n");
    static const wrong_text all[] = {
        {PART_EXPECT, "@[observed]\nformat = \"csv\"\n", "no 'file'", NULL, 0},
        {PART_EXPECT, "[observed]\nfile = \"track.csv\"\nformat = @\"xml\"\n", "xml", "csv", 0},
        {PART_EXPECT, "[observed]\nfile = \"track.csv\"\nband = @\"R\"\n", "band 'R'",
         "[photometry] bands", 0},
        {PART_EXPECT, "[observed]\nfile = \"track.csv\"\ncolumns = { magnitude = @\"magnitud\" }\n",
         "no column 'magnitud'", "did you mean 'magnitude'", 0},
        {PART_EXPECT, "[observed]\nfile = \"track.csv\"\nmagnitude = @\"standard\"\n", "standard",
         "apparent", 0},
        {PART_EXPECT,
         "[observed]\nfile = \"track.csv\"\nformat = \"mmt\"\ncolumns = @{ magnitude = \"a\" }\n",
         "columns of its own", "expected", 0},
        {PART_EXPECT,
         "[observed]\nfile = \"track.csv\"\nformat = \"score\"\nmagnitude = @\"at-1000-km\"\n",
         "SCORE has apparent magnitudes", "expected", 0},
        {PART_EXPECT, "[observed]\nfile = \"track.csv\"\nobserver = @\"Wien\"\n",
         "no observer is named 'Wien'", NULL, 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
    static const wrong_text given[] = {
        {PART_EXPECT, "@[observed]\nfile = \"track.csv\"\n", "[geometry]", "expected one", 0}};
    ASSERT_ALL_WRONG(GIVEN, given);
    glint_scenario *s = read_sound(write_scenario(""));
    glint_comparison *c;
    glint_error error;
    ck_assert_int_eq(glint_compare(s, 1, &c, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "no [observed]"));
    glint_scenario_free(s);
}
END_TEST

/* Cut off at any byte, a track is refused or gives its whole rows; never a cut number. */
static void assert_cuts(const char *observed, const char *track, const char *const *magnitudes)
{
    const char *path = write_scenario(observed);
    for (size_t cut = 0; cut <= strlen(track); cut++) {
        write_bytes("track.csv", track, cut);
        glint_scenario *s;
        glint_comparison *c;
        if (glint_scenario_read(path, NULL, 0, &s, NULL)) continue;
        ck_assert_int_eq(glint_compare(s, 1, &c, NULL), GLINT_OK);
        glint_observation o;
        for (size_t k = 0; glint_comparison_get(c, k, &o); k++)
            assert_near(o.observed, strtod(magnitudes[k], NULL), 0);
        glint_comparison_free(c);
        glint_scenario_free(s);
    }
}

START_TEST(test_compare_cut_tracks_give_whole_rows_only)
{
    static const char *const magnitudes[] = {"5.25", "6.75", "7.125"};
    assert_cuts(CSV,
                "utc,magnitude\n2025-07-25T20:37:00Z,5.25\n2025-07-25T20:37:10Z,6.75\n"
                "2025-07-25T20:37:20Z,7.125\n",
                magnitudes);
    assert_cuts("[observed]\nfile = \"track.csv\"\nformat = \"mmt\"\n",
                "# Date Time StdMag Mag Filter Penumbra Distance Phase Channel\n"
                "2025-07-25 20:37:00 9 5.25 Clear 0 900 80 3\n"
                "2025-07-25 20:37:10 9 6.75 Clear 0 900 80 3\n"
                "2025-07-25 20:37:20 9 7.125 Clear 0 900 80 3\n",
                magnitudes);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("compare");
    TCase *numbers = tcase_create("numbers"), *files = tcase_create("files");
    tcase_set_timeout(files, 60); /* sanitizers */
    tcase_add_checked_fixture(numbers, folder_make, folder_remove);
    tcase_add_test(numbers, test_compare_known_offsets_give_known_numbers);
    tcase_add_test(numbers, test_compare_zero_point_is_the_mean);
    tcase_add_test(numbers, test_compare_julian_dates_are_the_same_moments);
    tcase_add_test(numbers, test_compare_standard_magnitudes_closed_form);
    tcase_add_test(numbers, test_compare_eclipsed_observations_are_left_out);
    tcase_add_test(numbers, test_compare_counts_what_it_leaves_out);
    tcase_add_test(numbers, test_compare_observations_in_any_order_and_over_days);
    tcase_add_test(numbers, test_compare_track_of_one_of_two_observers);
    tcase_add_test(numbers, test_compare_table_has_no_negative_zeros);
    tcase_add_test(numbers, test_compare_degenerate_tracks_have_no_correlation);
    tcase_add_checked_fixture(files, folder_make, folder_remove);
    tcase_add_test(files, test_compare_any_number_of_threads_gives_the_same_numbers);
    tcase_add_test(files, test_compare_predicts_between_observations);
    tcase_add_test(files, test_compare_exposures_are_those_of_the_run);
    tcase_add_test(files, test_compare_mmt_tracks);
    tcase_add_test(files, test_compare_score_reports);
    tcase_add_test(files, test_compare_score_report_with_few_columns);
    tcase_add_test(files, test_compare_track_without_a_row_that_counts_is_warned_of);
    tcase_add_test(files, test_compare_wrong_tracks_are_refused_at_their_place);
    tcase_add_test(files, test_compare_wrong_keys_are_refused);
    tcase_add_test(files, test_compare_cut_tracks_give_whole_rows_only);
    suite_add_tcase(suite, numbers);
    suite_add_tcase(suite, files);
    return run_suite(suite);
}
