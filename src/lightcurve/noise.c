#include "lightcurve/noise.h"

#include "base/constants.h"
#include "lightcurve/photometry.h"

#include <math.h>

/* Integral of erf(x / width) from 0 to x. */
static double erf_integral(double x, double width)
{
    const double u = x / width;
    return x * erf(u) + width * (exp(-u * u) - 1) / sqrt(PI);
}

/* Part of the light of a Gaussian image, drawn out along a trail, that falls into the box. */
static double fraction_in_box(const telescope *scope, double trail_rad)
{
    static const double FWHM = 2.3548200450309493; /* sigmas of a Gaussian: 2 sqrt(2 ln 2) */
    static const double SHORT = 1e-4;              /* of the width: like a point, to 1e-4 of it */
    const double width = sqrt(2.0) * scope->seeing_fwhm_rad / FWHM, half = scope->half_width_rad;
    const double across = erf(half / width);
    if (trail_rad < SHORT * width) return across * across;
    /* each point of the trail sends light past both ends; by symmetry one of them tells both */
    const double along =
        (erf_integral(trail_rad + half, width) - erf_integral(half, width)) / trail_rad;
    return across * along;
}

/* Relative scatter by scintillation. */
static double scintillation(const telescope *scope, const noise_view *view)
{
    static const double YOUNG = 1e-5;   /* m^(4/3) s / (m^(2/3) s^(1/2))^2 */
    static const double SCALE_M = 8000; /* scale height of the atmosphere, m */
    if (!(view->airmass > 0)) return 0;
    const double c = scope->scintillation;
    const double variance = YOUNG * c * c * pow(scope->aperture_m, -4.0 / 3.0) / view->exposure_s *
                            pow(view->airmass, 3) * exp(-2 * view->height_m / SCALE_M);
    return sqrt(variance);
}

void noise_of(const telescope *scope, int band, const noise_view *view, noise_terms *out)
{
    const double zero_e = scope->electrons_s[band] * view->exposure_s; /* of magnitude 0 */
    const double half = scope->half_width_rad, pixel = scope->pixel_rad;
    const double box = 2 * half * (view->trail_rad + 2 * half);                  /* rad^2 */
    const double sky = pow(10, -0.4 * scope->sky_mag[band]) / (ARCSEC * ARCSEC); /* per rad^2 */
    out->fraction = fraction_in_box(scope, view->trail_rad);
    out->pixels = box / (pixel * pixel);
    out->signal_e = zero_e * pow(10, -0.4 * view->magnitude) * out->fraction;
    out->photon_e = sqrt(out->signal_e);
    out->sky_e = sqrt(zero_e * sky * box);
    out->dark_e = sqrt(out->pixels * scope->dark_current_e_s * view->exposure_s);
    out->read_e = sqrt(out->pixels) * scope->read_noise_e;
    out->scintillation_e = scintillation(scope, view) * out->signal_e;
}

double noise_snr(const noise_terms *t)
{
    if (!(t->signal_e > 0)) return 0;
    const double terms[] = {t->photon_e, t->sky_e, t->dark_e, t->read_e, t->scintillation_e};
    double variance = 0;
    for (size_t k = 0; k < sizeof terms / sizeof *terms; k++)
        variance += terms[k] * terms[k];
    return t->signal_e / sqrt(variance);
}

double noise_sigma_mag(double snr)
{
    return 2.5 / (log(10.0) * snr);
}

double noise_row_snr(const glint_scenario *s, const glint_row *row, int band)
{
    const noise_view view = {.magnitude = row->magnitude[band],
                             .exposure_s = s->exposure_s,
                             .trail_rad =
                                 s->telescope.follows ? 0 : row->angular_rate_rad_s * s->exposure_s,
                             .airmass = airmass_of_light(s, row),
                             .height_m = row->site_height_m};
    noise_terms terms;
    noise_of(&s->telescope, band, &view, &terms);
    return noise_snr(&terms);
}
