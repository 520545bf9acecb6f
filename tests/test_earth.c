/* The WGS84 ellipsoid: sites, horizon coordinates, geodetic coordinates. */
#include "orbit/earth.h"

#include "base/constants.h"
#include "base/vec.h"
#include "lightcurve/sky.h"
#include "table.h"

#include <erfa.h>
#include <erfam.h>

static const double POLAR_RADIUS_M = 6356752.3142; /* NIMA TR8350.2 (2000), table 3.3 */

/* As runs see an ITRS point from a site: azimuth, elevation (rad) and range (m). */
static void look_from(const earth_site *site, const double r_itrs_m[3], double *azimuth,
                      double *elevation, double *range_m)
{
    double away[3], enu[3];
    sub3(r_itrs_m, site->r_itrs_m, away);
    mat_vec(site->enu_itrs, away, enu);
    *azimuth = sky_azimuth(enu[0], enu[1]);
    *elevation = sky_elevation(enu[0], enu[1], enu[2]);
    *range_m = norm3(enu);
}

static earth_site site_at(double latitude_deg, double longitude_deg, double height_m)
{
    earth_site site;
    ck_assert(earth_site_at(latitude_deg * DEG, longitude_deg * DEG, height_m, &site, NULL) ==
              GLINT_OK);
    return site;
}

static void check_look(const char *path)
{
    csv_table t = table_open(path);
    for (long k = 0; k < t.n_rows; k++) {
        double itrs[3], azimuth, elevation, range_m;
        const earth_site site = site_at(table_number(&t, k, "lat_deg"),
                                        table_number(&t, k, "lon_deg"), table_number(&t, k, "h_m"));
        table_vector(&t, k, "itrs_", "_km", itrs);
        scale3(itrs, 1e3, itrs);
        look_from(&site, itrs, &azimuth, &elevation, &range_m);
        /* the table's places end at 1e-7 km, its angles at 1e-9 deg */
        assert_near(azimuth / DEG, table_number(&t, k, "az_deg"), 5e-9);
        assert_near(elevation / DEG, table_number(&t, k, "el_deg"), 5e-9);
        assert_near(range_m / 1e3, table_number(&t, k, "range_km"), 2e-7);
    }
    csv_free(&t);
}

START_TEST(test_earth_look_matches_reference)
{
    table_check(check_look, "orbit/topocentric.csv");
}
END_TEST

START_TEST(test_earth_site_agrees_with_erfa)
{
    for (int latitude = -90; latitude <= 90; latitude += 10)
        for (int longitude = -360; longitude <= 360; longitude += 40)
            for (int h = 0; h < 4; h++) {
                static const double heights_m[] = {-400.0, 0.0, 8848.0, 3.6e7};
                const earth_site site = site_at(latitude, longitude, heights_m[h]);
                double want[3];
                eraGd2gc(ERFA_WGS84, longitude * DEG, latitude * DEG, heights_m[h], want);
                for (int i = 0; i < 3; i++)
                    assert_near(site.r_itrs_m[i], want[i], 2e-8);
                assert_near(site.latitude, latitude * DEG, 0.0);
                assert_near(site.longitude, longitude * DEG, 0.0);
                assert_near(site.height_m, heights_m[h], 0.0);
            }
}
END_TEST

/* East, north, up as the geodetic latitude and longitude define them. */
START_TEST(test_earth_site_axes_follow_latitude_and_longitude)
{
    for (int k = 0; k < 200; k++) {
        const double b = (fmod(k * 37.7, 180.0) - 90.0) * DEG, l = fmod(k * 71.3, 360.0) * DEG;
        const earth_site site = site_at(b / DEG, l / DEG, 100.0 * k);
        const double want[9] = {-sin(l),          cos(l),           0.0,
                                -sin(b) * cos(l), -sin(b) * sin(l), cos(b),
                                cos(b) * cos(l),  cos(b) * sin(l),  sin(b)};
        for (int i = 0; i < 9; i++)
            assert_near(site.enu_itrs[i], want[i], 1e-15);
    }
}
END_TEST

START_TEST(test_earth_site_stands_on_equator_and_poles)
{
    earth_site site = site_at(0.0, 0.0, 100.0);
    const double equator[3] = {6378137.0 + 100.0, 0.0, 0.0};
    for (int i = 0; i < 3; i++)
        assert_near(site.r_itrs_m[i], equator[i], 1e-8);
    for (int sign = -1; sign <= 1; sign += 2) {
        /* a latitude that rounding has put past the pole must stay at it */
        const double latitude = sign * (90.0 * DEG + 4e-16);
        ck_assert(earth_site_at(latitude, 0.3, 50.0, &site, NULL) == GLINT_OK);
        assert_near(site.r_itrs_m[0], 0.0, 1e-8);
        assert_near(site.r_itrs_m[1], 0.0, 1e-8);
        assert_near(site.r_itrs_m[2], sign * (POLAR_RADIUS_M + 50.0),
                    5e-5); /* the source's digits */
        /* at a pole, north follows the longitude that was said */
        assert_near(site.enu_itrs[3], -sign * cos(0.3), 1e-15);
        assert_near(site.enu_itrs[4], -sign * sin(0.3), 1e-15);
        double azimuth, elevation, range_m;
        const double above[3] = {0.0, 0.0, 1.5 * site.r_itrs_m[2]};
        look_from(&site, above, &azimuth, &elevation, &range_m);
        assert_near(elevation, PI / 2.0, 1e-12);
        assert_near(range_m, 0.5 * fabs(site.r_itrs_m[2]), 1e-8);
    }
}
END_TEST

/* A point that lies at a known azimuth, elevation and range by its east, north and up. */
START_TEST(test_earth_look_inverts_local_coordinates)
{
    const earth_site site = site_at(-33.3, 151.2, 777.0);
    for (int az = 0; az < 360; az += 15)
        for (int el = -85; el <= 85; el += 17) {
            const double a = az * DEG, e = el * DEG, range_m = 7.5e5;
            const double enu[3] = {range_m * cos(e) * sin(a), range_m * cos(e) * cos(a),
                                   range_m * sin(e)};
            double r[3], azimuth, elevation, range;
            mat_tvec(site.enu_itrs, enu, r);
            add3(r, site.r_itrs_m, r);
            look_from(&site, r, &azimuth, &elevation, &range);
            ck_assert(azimuth >= 0.0 && azimuth < TWO_PI);
            assert_near(sin(azimuth - a), 0.0, 2e-14); /* 1e-9 m of rounding over 65 km */
            assert_near(cos(azimuth - a), 1.0, 1e-15);
            assert_near(elevation, e, 5e-15);
            assert_near(range, range_m, 5e-9);
        }
}
END_TEST

START_TEST(test_earth_look_keeps_azimuth_below_full_turn)
{
    const earth_site site = site_at(0.0, 0.0, 0.0);
    double azimuth, elevation, range_m;
    const double north[3] = {6378137.0, -1e-30, 1e5};
    look_from(&site, north, &azimuth, &elevation, &range_m);
    assert_near(azimuth, 0.0, 0.0);
    const double west[3] = {6378137.0, -1e5, 0.0};
    look_from(&site, west, &azimuth, &elevation, &range_m);
    assert_near(azimuth, 1.5 * PI, 1e-15);
}
END_TEST

START_TEST(test_earth_geodetic_agrees_with_erfa_and_inverts_sites)
{
    for (int k = 0; k < 500; k++) {
        static const double heights_m[] = {-5000.0, 0.0, 400e3, 2e7, 4e8};
        const double b = fmod(k * 37.7, 180.1) - 90.0, l = fmod(k * 71.3, 360.0) - 180.0;
        const double h = heights_m[k % 5];
        const earth_site site = site_at(b > 90.0 ? 90.0 : b, l, h);
        double latitude, longitude, height_m, lat_erfa, lon_erfa, height_erfa_m;
        earth_geodetic(site.r_itrs_m, &latitude, &longitude, &height_m);
        double r[3];
        copy3(site.r_itrs_m, r);
        eraGc2gd(ERFA_WGS84, r, &lon_erfa, &lat_erfa, &height_erfa_m);
        assert_near(latitude, site.latitude, 1e-15);
        if (fabs(site.latitude) < 89.9 * DEG)
            assert_near(sin(longitude - site.longitude), 0.0, 1e-14);
        assert_near(height_m, h, 1e-8 + 1e-15 * h);
        assert_near(latitude, lat_erfa, 5e-11); /* ERFA's, one step of an iteration, is that good */
        assert_near(height_m, height_erfa_m, 1e-8 + 1e-15 * h);
    }
}
END_TEST

/* Down by the geodetic height one stands on the ellipsoid, square to it. */
START_TEST(test_earth_geodetic_nadir_is_square_to_ellipsoid)
{
    const double a2 = 6378137.0 * 6378137.0, flat = 1.0 - 1.0 / 298.257223563;
    for (int k = 0; k < 200; k++) {
        const double b = (fmod(k * 37.7, 180.0) - 90.0) * DEG, l = k * 0.7;
        const double length_m = 6.6e6 + 2e5 * k;
        const double r[3] = {length_m * cos(b) * cos(l), length_m * cos(b) * sin(l),
                             length_m * sin(b)};
        double nadir[3], foot[3], latitude, longitude, height_m;
        earth_geodetic_nadir(r, nadir);
        earth_geodetic(r, &latitude, &longitude, &height_m);
        assert_near(norm3(nadir), 1.0, 4e-16);
        add_scaled3(r, height_m, nadir, foot);
        const double normal[3] = {foot[0] / a2, foot[1] / a2, foot[2] / (a2 * flat * flat)};
        assert_near(dot3(foot, normal), 1.0, 1e-14);
        const double upward[3] = {-nadir[0], -nadir[1], -nadir[2]};
        assert_near(angle3(upward, normal), 0.0, 2e-15 * length_m / 6.6e6);
    }
}
END_TEST

/* NIMA TR8350.2 (2000), table 3.2: normalised C20 = -0.484166774985e-3. */
START_TEST(test_earth_j2_is_that_of_wgs84)
{
    assert_rel(earth_j2(), 0.484166774985e-3 * sqrt(5.0), 1e-9);
}
END_TEST

START_TEST(test_earth_site_refuses_what_is_no_place)
{
    const double bad[][3] = {{(double)NAN, 0.0, 0.0},
                             {0.0, (double)INFINITY, 0.0},
                             {0.0, 0.0, (double)NAN},
                             {90.001 * DEG, 0.0, 0.0},
                             {-2.0, 0.0, 0.0}};
    for (int k = 0; k < 5; k++) {
        earth_site site;
        glint_error error = {0};
        ck_assert(earth_site_at(bad[k][0], bad[k][1], bad[k][2], &site, &error) == GLINT_INTERNAL);
        ck_assert(strstr(error.message, "GeographicLib") != NULL);
        ck_assert(earth_site_at(bad[k][0], bad[k][1], bad[k][2], &site, NULL) == GLINT_INTERNAL);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("earth");
    TCase *tcase = tcase_create("earth");
    suite_add_tcase(suite, tcase);
    tcase_add_test(tcase, test_earth_look_matches_reference);
    tcase_add_test(tcase, test_earth_site_agrees_with_erfa);
    tcase_add_test(tcase, test_earth_site_axes_follow_latitude_and_longitude);
    tcase_add_test(tcase, test_earth_site_stands_on_equator_and_poles);
    tcase_add_test(tcase, test_earth_look_inverts_local_coordinates);
    tcase_add_test(tcase, test_earth_look_keeps_azimuth_below_full_turn);
    tcase_add_test(tcase, test_earth_geodetic_agrees_with_erfa_and_inverts_sites);
    tcase_add_test(tcase, test_earth_geodetic_nadir_is_square_to_ellipsoid);
    tcase_add_test(tcase, test_earth_j2_is_that_of_wgs84);
    tcase_add_test(tcase, test_earth_site_refuses_what_is_no_place);
    return run_suite(suite);
}
