// earth.cpp: the C face of GeographicLib. Only Forward with its matrix can meet an exception
// (memory); the other calls throw nothing on the WGS84 objects, and the helpers say so with
// noexcept.
#include "orbit/earth.h"

#include "base/constants.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/NormalGravity.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <vector>

using GeographicLib::Geocentric;

namespace
{

// GeographicLib counts in degrees and returns NaN past 90 deg. A pole gets there by rounding, and
// is put back; what lies farther out is no latitude and keeps its NaN.
double latitude_degrees(double latitude)
{
    const double degrees = latitude / DEG, rounding = 1e-12;
    return std::fabs(degrees) <= 90.0 + rounding ? std::clamp(degrees, -90.0, 90.0) : degrees;
}

void fill_site(double latitude, double longitude, double height_m, earth_site *out)
{
    // local_itrs maps east, north, up to ITRS, row-major; out wants the inverse.
    std::vector<double> local_itrs(9);
    out->latitude = latitude;
    out->longitude = longitude;
    out->height_m = height_m;
    double *r = out->r_itrs_m;
    Geocentric::WGS84().Forward(latitude_degrees(latitude), longitude / DEG, height_m, r[0], r[1],
                                r[2], local_itrs);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out->enu_itrs[3 * i + j] = local_itrs[3 * j + i];
}

void reverse(const double r_itrs_m[3], double *latitude, double *longitude,
             double *height_m) noexcept
{
    double latitude_deg, longitude_deg;
    Geocentric::WGS84().Reverse(r_itrs_m[0], r_itrs_m[1], r_itrs_m[2], latitude_deg, longitude_deg,
                                *height_m);
    *latitude = latitude_deg * DEG;
    *longitude = longitude_deg * DEG;
}

double form_factor_j2() noexcept
{
    return GeographicLib::NormalGravity::WGS84().DynamicalFormFactor(2);
}

bool is_finite(const double *values, int n)
{
    return std::all_of(values, values + n, [](double v) { return std::isfinite(v); });
}

} // namespace

extern "C" {

glint_status earth_site_at(double latitude, double longitude, double height_m, earth_site *out,
                           glint_error *error)
{
    try {
        fill_site(latitude, longitude, height_m, out);
    } catch (const std::exception &e) {
        return error_set(error, GLINT_INTERNAL, place{nullptr, 0, 0}, "GeographicLib: %s",
                         e.what());
    } catch (...) {
        return error_set(error, GLINT_INTERNAL, place{nullptr, 0, 0}, "GeographicLib failed");
    }
    if (!is_finite(out->r_itrs_m, 3) || !is_finite(out->enu_itrs, 9))
        return error_set(error, GLINT_INTERNAL, place{nullptr, 0, 0},
                         "GeographicLib has no place at latitude %g deg, longitude %g deg, height "
                         "%g m; expected finite numbers",
                         latitude / DEG, longitude / DEG, height_m);
    return GLINT_OK;
}

void earth_geodetic(const double r_itrs_m[3], double *latitude, double *longitude, double *height_m)
{
    reverse(r_itrs_m, latitude, longitude, height_m);
}

void earth_geodetic_nadir(const double r_itrs_m[3], double nadir_itrs[3])
{
    double latitude, longitude, height_m;
    reverse(r_itrs_m, &latitude, &longitude, &height_m);
    nadir_itrs[0] = -std::cos(latitude) * std::cos(longitude);
    nadir_itrs[1] = -std::cos(latitude) * std::sin(longitude);
    nadir_itrs[2] = -std::sin(latitude);
}

double earth_j2(void)
{
    return form_factor_j2();
}
}
