#include "base/band.h"

#include "base/constants.h"

#include <math.h>
#include <string.h>

/* Magnitudes of the Sun: Willmer 2018, ApJS 236, 47, tables 3 and 4, rounded to 0.01 as there;
 * pivot wavelengths from the same tables. Extinction: LSST site (Cerro Pachon), as documented by
 * the lightcurvelynx project. Relative widths of U to I: Bessell 1979, PASP 91, 589; of SDSS: the
 * integral over ln(wavelength) of the response from Doi et al. 2010, AJ 139, 1628, table 4, with
 * air of airmass 1.3, over the response at its peak. */
static const band_info BANDS[] = {
    {"U", "Johnson U", 0.3611, -25.97, -25.25, NAN, SYSTEM_VEGA, 0.15},
    {"B", "Johnson B", 0.4396, -26.13, -26.26, NAN, SYSTEM_VEGA, 0.22},
    {"V", "Johnson V", 0.5511, -26.76, -26.77, NAN, SYSTEM_VEGA, 0.16},
    {"R", "Cousins R", 0.6582, -27.15, -26.97, NAN, SYSTEM_VEGA, 0.23},
    {"I", "Cousins I", 0.8034, -27.47, -27.06, NAN, SYSTEM_VEGA, 0.19},
    {"sdss_u", "SDSS u", 0.3556, NAN, -25.18, NAN, SYSTEM_AB, 0.161},
    {"sdss_g", "SDSS g", 0.4702, NAN, -26.47, NAN, SYSTEM_AB, 0.264},
    {"sdss_r", "SDSS r", 0.6176, NAN, -26.93, NAN, SYSTEM_AB, 0.180},
    {"sdss_i", "SDSS i", 0.7490, NAN, -27.05, NAN, SYSTEM_AB, 0.150},
    {"sdss_z", "SDSS z", 0.8947, NAN, -27.07, NAN, SYSTEM_AB, 0.131},
    {"lsst_u", "LSST u", 0.3665, NAN, -25.30, 0.458, SYSTEM_AB, NAN},
    {"lsst_g", "LSST g", 0.4808, NAN, -26.52, 0.208, SYSTEM_AB, NAN},
    {"lsst_r", "LSST r", 0.6210, NAN, -26.93, 0.122, SYSTEM_AB, NAN},
    {"lsst_i", "LSST i", 0.7537, NAN, -27.05, 0.074, SYSTEM_AB, NAN},
    {"lsst_z", "LSST z", 0.8686, NAN, -27.07, 0.057, SYSTEM_AB, NAN},
    {"lsst_y", "LSST y", 0.9705, NAN, -27.07, 0.095, SYSTEM_AB, NAN},
};

const band_info *band_at(size_t k)
{
    return k < sizeof BANDS / sizeof *BANDS ? &BANDS[k] : NULL;
}

const band_info *band_named(const char *name)
{
    for (size_t k = 0; k < sizeof BANDS / sizeof *BANDS; k++)
        if (strcmp(BANDS[k].name, name) == 0) return &BANDS[k];
    return NULL;
}

double band_sun_magnitude(const band_info *band, magnitude_system system)
{
    return system == SYSTEM_VEGA ? band->sun_vega : band->sun_ab;
}

double band_photons_m2_s(const band_info *band, magnitude_system system)
{
    /* W/(m^2 Hz) of AB magnitude 0: Oke and Gunn 1983, ApJ 266, 713, as 3631 Jy */
    static const double AB_ZERO = 3631e-26;
    const double ab_of_zero = band->sun_ab - band_sun_magnitude(band, system);
    return AB_ZERO / PLANCK_J_S * band->relative_width * pow(10, -0.4 * ab_of_zero);
}

const char *magnitude_system_name(magnitude_system system)
{
    return system == SYSTEM_VEGA ? "vega" : "ab";
}
