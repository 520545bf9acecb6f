#include "orbit/refraction.h"

#include "base/constants.h"

#include <math.h>

/* 0 C, K. */
static const double ICE_K = 273.15;

refraction refraction_standard(double height_m)
{
    /* ISO 2533: 1013.25 hPa and 288.15 K at sea level, 6.5 K less for each km; the exponent is
     * g M/(R L). */
    static const double PRESSURE_HPA = 1013.25, SEA_K = 288.15, FALL_K_M = 6.5e-3;
    static const double EXPONENT = 5.25588, TOP_M = 11000;
    const double height = fmin(fmax(height_m, 0), TOP_M);
    const double kelvin = SEA_K - FALL_K_M * height;
    return (refraction){.on = true,
                        .pressure_hpa = PRESSURE_HPA * pow(kelvin / SEA_K, EXPONENT),
                        .temperature_c = kelvin - ICE_K};
}

double refraction_lift(const refraction *air, double apparent)
{
    /* Bennett's cot(h + 7.31/(h + 4.4)) arcmin, h in deg, is for this air. */
    static const double PRESSURE_HPA = 1010, TEMPERATURE_C = 10;
    if (!air->on) return 0;
    const double h_deg = fmax(apparent / DEG, 0);
    const double arcmin = 1 / tan((h_deg + 7.31 / (h_deg + 4.4)) * DEG);
    const double density =
        air->pressure_hpa / PRESSURE_HPA * (ICE_K + TEMPERATURE_C) / (ICE_K + air->temperature_c);
    return fmax(arcmin, 0) * density * 60 * ARCSEC;
}

double refraction_apparent(const refraction *air, double geometric)
{
    /* apparent = geometric + lift(apparent). The lift falls by at most 0.2 rad for a rad in usual
     * air, and by less than 0.4 in the densest that is accepted, so that each round leaves less
     * than half of the error. */
    enum { MOST_ROUNDS = 60 };
    static const double SMALL = 1e-15; /* rad */
    double apparent = geometric;
    for (int k = 0; air->on && k < MOST_ROUNDS; k++) {
        const double next = geometric + refraction_lift(air, apparent);
        const double change = fabs(next - apparent);
        apparent = next;
        if (change < SMALL) break;
    }
    return apparent;
}

double refraction_geometric(const refraction *air, double apparent)
{
    return apparent - refraction_lift(air, apparent);
}
