/* Refraction against published values and another implementation. */
#include "base/constants.h"
#include "orbit/refraction.h"
#include "testing.h"

static const refraction BENNETT_AIR = {true, 1010, 10};

static double lift_arcmin(const refraction *air, double apparent_deg)
{
    return refraction_lift(air, apparent_deg * DEG) / (DEG / 60);
}

/* Meeus 1998, Astronomical Algorithms, example 16.a: R = 28.754 arcmin at 0 deg 30'. The horizon:
 * Bennett 1982 and the almanacs, 34.5 arcmin. */
START_TEST(test_refraction_has_published_values)
{
    assert_near(lift_arcmin(&BENNETT_AIR, 0.5), 28.754, 5e-4);
    assert_near(lift_arcmin(&BENNETT_AIR, 0), 34.5, 0.05);
    assert_near(lift_arcmin(&BENNETT_AIR, -3), lift_arcmin(&BENNETT_AIR, 0), 0);
    assert_near(lift_arcmin(&BENNETT_AIR, 90), 0, 0);
}
END_TEST

/* ERFA's eraRefco (dry air, 0.55 um), which follows another model: A tan z + B tan^3 z. Bennett
 * says of his formula that it is within 0.07 arcmin of the tables; dry air takes 0.01 off. */
START_TEST(test_refraction_agrees_with_another_model)
{
    static const struct {
        double pressure_hpa, temperature_c, apparent_deg, arcmin;
    } ROWS[] = {
        {1010, 10, 80, 0.1707}, {1010, 10, 60, 0.5586}, {1010, 10, 45, 0.9668},
        {1010, 10, 30, 1.6707}, {1010, 10, 20, 2.6366}, {1010, 10, 15, 3.5557},
        {700, 0, 80, 0.1226},   {700, 0, 60, 0.4013},   {700, 0, 45, 0.6946},
        {700, 0, 30, 1.2004},   {700, 0, 20, 1.8944},   {700, 0, 15, 2.5549},
    };
    for (size_t k = 0; k < sizeof ROWS / sizeof *ROWS; k++) {
        const refraction air = {true, ROWS[k].pressure_hpa, ROWS[k].temperature_c};
        assert_near(lift_arcmin(&air, ROWS[k].apparent_deg), ROWS[k].arcmin, 0.085);
    }
}
END_TEST

/* In the densest and the thinnest air that scenarios may ask for. */
START_TEST(test_refraction_rises_steadily_and_back)
{
    static const refraction AIRS[] = {
        {true, 1010, 10}, {true, 1200, -100}, {true, 0, 60}, {false, 0, 0}};
    for (size_t a = 0; a < sizeof AIRS / sizeof *AIRS; a++) {
        double before = -PI;
        for (double deg = -90; deg <= 90; deg += 0.01) {
            const double apparent = refraction_apparent(&AIRS[a], deg * DEG);
            ck_assert(apparent > before);
            ck_assert(apparent <= PI / 2 + 1e-12);
            assert_near(refraction_geometric(&AIRS[a], apparent), deg * DEG, 1e-14);
            before = apparent;
        }
    }
}
END_TEST

START_TEST(test_refraction_grows_with_the_density_of_air)
{
    const refraction half = {true, 505, 10}, hot = {true, 1010, 283.15 * 1.1 - 273.15};
    for (double deg = 0; deg < 90; deg += 7) {
        assert_near(lift_arcmin(&half, deg), 0.5 * lift_arcmin(&BENNETT_AIR, deg), 1e-12);
        assert_near(lift_arcmin(&hot, deg), lift_arcmin(&BENNETT_AIR, deg) / 1.1, 1e-12);
    }
}
END_TEST

/* ISO 2533:1975, table of the standard atmosphere, geopotential height. */
START_TEST(test_refraction_standard_air_is_that_of_the_table)
{
    static const double TABLE[][3] = {/* m, hPa, deg C */
                                      {0, 1013.25, 15},        {1000, 898.746, 8.5},
                                      {2000, 794.952, 2},      {5000, 540.199, -17.5},
                                      {11000, 226.321, -56.5}, {50000, 226.321, -56.5},
                                      {-400, 1013.25, 15}};
    for (size_t k = 0; k < sizeof TABLE / sizeof *TABLE; k++) {
        const refraction air = refraction_standard(TABLE[k][0]);
        ck_assert(air.on);
        assert_near(air.pressure_hpa, TABLE[k][1], 2e-3); /* six digits of the table */
        assert_near(air.temperature_c, TABLE[k][2], 1e-9);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("refraction");
    TCase *tc = tcase_create("refraction");
    tcase_add_test(tc, test_refraction_has_published_values);
    tcase_add_test(tc, test_refraction_agrees_with_another_model);
    tcase_add_test(tc, test_refraction_rises_steadily_and_back);
    tcase_add_test(tc, test_refraction_grows_with_the_density_of_air);
    tcase_add_test(tc, test_refraction_standard_air_is_that_of_the_table);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
