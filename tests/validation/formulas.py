"""Formulas of geometry, reflection and statistics, written down a second time.

Nothing here comes from glint: the scripts beside this file hold glint's results to these. Standard
library only. Angles are in degrees and lengths in metres at the edges of functions; vectors are tuples.
"""
import math

EARTH_STUDY_M = 6378e3           # radius of the spherical Earth of Fankhauser et al. 2023
IRRADIANCE_STUDY_W_M2 = 1360.0   # of the Sun, there
WAVELENGTH_STUDY_M = 532e-9
LIGHT_STUDY_M_S = 3e8
AB_ZERO_W_M2_HZ = 3631e-26       # 3631 Jy, Oke and Gunn 1983

WGS84_A_M = 6378137.0            # NIMA TR8350.2: semi-major axis, flattening
WGS84_F = 1 / 298.257223563
AU_KM = 149597870.7              # IAU 2012 B2


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def add(a, scale, b):
    return tuple(x + scale * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(x / length for x in a)


def angle_deg(a, b):
    c = cross(a, b)
    return math.degrees(math.atan2(math.sqrt(dot(c, c)), dot(a, b)))


def horizontal(altitude_deg, azimuth_deg):
    """The unit vector east, north, up; azimuth from north through east."""
    h, a = math.radians(altitude_deg), math.radians(azimuth_deg)
    return (math.cos(h) * math.sin(a), math.cos(h) * math.cos(a), math.sin(h))


def body_directions(down, sun, to_observer):
    """Sun and observer in the body frame of a Starlink of version 1.5: z against `down`, y as near to
    the Sun as that allows. All in one frame, any; x completes the axes to right-handed ones."""
    z = unit(tuple(-v for v in down))
    y = unit(add(sun, -dot(sun, z), z))
    x = cross(y, z)
    return (tuple(dot(sun, axis) for axis in (x, y, z)),
            tuple(dot(to_observer, axis) for axis in (x, y, z)))


# ------------------------------------------------------------- the geometry of the published study

def study_geometry(height_m, altitude_deg, azimuth_deg, sun_altitude_deg, sun_azimuth_deg):
    """Sun and observer in the body frame, range in m, and whether the satellite is in the Earth's
    shadow: a spherical Earth, the observer on it, a cylinder of shadow, the Sun infinitely far away."""
    radius_m = EARTH_STUDY_M + height_m
    line, sun = horizontal(altitude_deg, azimuth_deg), horizontal(sun_altitude_deg, sun_azimuth_deg)
    along_m = EARTH_STUDY_M * line[2]
    range_m = math.sqrt(along_m**2 + radius_m**2 - EARTH_STUDY_M**2) - along_m
    position_m = add((0, 0, EARTH_STUDY_M), range_m, line)
    down = tuple(-v for v in position_m)
    sun_body, observer_body = body_directions(down, sun, tuple(-v for v in line))
    dark = sun_body[2] < 0 and radius_m * sun_body[1] < EARTH_STUDY_M
    return sun_body, observer_body, range_m, dark


def study_frame(height_m, past_terminator_deg, observer_m):
    """As study_geometry, in the study's frame: the satellite at (0, 0, R + h), the Sun at
    (0, cos a, -sin a) with a the angle past the terminator, the observer's place given."""
    a, radius_m = math.radians(past_terminator_deg), EARTH_STUDY_M + height_m
    to_observer_m = add(observer_m, -1, (0, 0, radius_m))
    range_m = math.sqrt(dot(to_observer_m, to_observer_m))
    dark = a > 0 and radius_m * math.cos(a) < EARTH_STUDY_M
    return (0.0, math.cos(a), -math.sin(a)), unit(to_observer_m), range_m, dark


FAINTEST = 12.5  # what the study gives a satellite that is fainter, or without light


def magnitude(flux_ratio, of_sun):
    """Magnitude of a flux ratio, given that of the Sun. NaN stays NaN."""
    if flux_ratio <= 0:
        return FAINTEST
    found = of_sun - 2.5 * math.log10(flux_ratio)
    return FAINTEST if found > FAINTEST else found


def study_magnitude(flux_ratio):
    """AB magnitude with the study's Sun: -27.056."""
    per_hz = (IRRADIANCE_STUDY_W_M2 * WAVELENGTH_STUDY_M
              / (LIGHT_STUDY_M_S * AB_ZERO_W_M2_HZ))
    return magnitude(flux_ratio, -2.5 * math.log10(per_hz))


# --------------------------------------------------------------------------------- the real Earth

def geodetic_axes(latitude_deg, longitude_deg):
    """East, north and up in Earth-fixed axes."""
    b, l = math.radians(latitude_deg), math.radians(longitude_deg)
    return ((-math.sin(l), math.cos(l), 0.0),
            (-math.sin(b) * math.cos(l), -math.sin(b) * math.sin(l), math.cos(b)),
            (math.cos(b) * math.cos(l), math.cos(b) * math.sin(l), math.sin(b)))


def from_geodetic(latitude_deg, longitude_deg, height_m):
    """Earth-fixed position in m, on WGS84."""
    b = math.radians(latitude_deg)
    e2 = WGS84_F * (2 - WGS84_F)
    n_m = WGS84_A_M / math.sqrt(1 - e2 * math.sin(b)**2)
    up = geodetic_axes(latitude_deg, longitude_deg)[2]
    return ((n_m + height_m) * up[0], (n_m + height_m) * up[1],
            (n_m * (1 - e2) + height_m) * up[2])


def to_geodetic(position_m):
    """Latitude and longitude in deg, height in m on WGS84. The iteration gains a factor of 150 a
    turn near the Earth."""
    e2 = WGS84_F * (2 - WGS84_F)
    x_m, y_m, z_m = position_m
    axis_m = math.hypot(x_m, y_m)
    b = math.atan2(z_m, axis_m * (1 - e2))
    for _ in range(12):
        n_m = WGS84_A_M / math.sqrt(1 - e2 * math.sin(b)**2)
        b = math.atan2(z_m + e2 * n_m * math.sin(b), axis_m)
    n_m = WGS84_A_M / math.sqrt(1 - e2 * math.sin(b)**2)
    height_m = (axis_m * math.cos(b) + z_m * math.sin(b)
                - n_m * (1 - e2 * math.sin(b)**2))
    return math.degrees(b), math.degrees(math.atan2(y_m, x_m)), height_m


def to_fixed(vector_enu, axes):
    return tuple(sum(v * axis[k] for v, axis in zip(vector_enu, axes)) for k in range(3))


def satellite_position(site, height_m, altitude_deg, azimuth_deg):
    """Earth-fixed position in m of the satellite that stands in this place of the site's sky at this
    height above the ellipsoid, and its range in m. site: latitude, longitude in deg, height in m."""
    site_m = from_geodetic(*site)
    line = to_fixed(horizontal(altitude_deg, azimuth_deg), geodetic_axes(*site[:2]))
    near_m, far_m = 0.0, 4 * WGS84_A_M
    while far_m - near_m > 1e-5 and (near_m + far_m) / 2 not in (near_m, far_m):
        middle_m = (near_m + far_m) / 2
        if to_geodetic(add(site_m, middle_m, line))[2] < height_m:
            near_m = middle_m
        else:
            far_m = middle_m
    return add(site_m, near_m, line), near_m


def sky_geometry(site, height_m, altitude_deg, azimuth_deg, sun_fixed):
    """Sun and observer in the body frame and the range in m, the body's z opposite to the geodetic
    nadir. sun_fixed: Earth-fixed direction of the Sun, infinitely far away."""
    position_m, range_m = satellite_position(site, height_m, altitude_deg, azimuth_deg)
    up = geodetic_axes(*to_geodetic(position_m)[:2])[2]
    to_observer = unit(add(from_geodetic(*site), -1, position_m))
    return *body_directions(tuple(-v for v in up), sun_fixed, to_observer), range_m


def days_from_2000(time):
    """Days from 2000-01-01T12 of a datetime in UTC; the 69 s to terrestrial time move the Sun by 3
    arcsec, which these formulas do not see."""
    whole = time.toordinal() - 730120  # 2000-01-01
    return whole - 0.5 + (time.hour + (time.minute + time.second / 60) / 60) / 24


def sun_distance_au(time):
    """Low-precision formula of the Astronomical Almanac, good to about 1e-4 au."""
    g = math.radians(357.528 + 0.9856003 * days_from_2000(time))
    return 1.00014 - 0.01671 * math.cos(g) - 0.00014 * math.cos(2 * g)


def sun_fixed(time):
    """Apparent direction of the Sun in Earth-fixed axes: low-precision formulas of the Astronomical
    Almanac, good to 0.01 deg, and mean sidereal time."""
    n = days_from_2000(time)
    g, mean_deg = math.radians(357.528 + 0.9856003 * n), 280.460 + 0.9856474 * n
    longitude = math.radians(mean_deg + 1.915 * math.sin(g) + 0.020 * math.sin(2 * g))
    tilt = math.radians(23.439 - 4e-7 * n)
    inertial = (math.cos(longitude), math.cos(tilt) * math.sin(longitude),
                math.sin(tilt) * math.sin(longitude))
    turn = math.radians(280.46062 + 360.98564737 * n)  # Greenwich mean sidereal time
    return (math.cos(turn) * inertial[0] + math.sin(turn) * inertial[1],
            -math.sin(turn) * inertial[0] + math.cos(turn) * inertial[1], inertial[2])


# --------------------------------------------------------------------------------------- reflection

def phong(rho_d, rho_s, n):
    """f ci cr of the Phong model as the study writes it, in 1/sr, as a function of the normal and
    the directions to Sun and observer."""
    def kernel(normal, i, r):
        ci, cr = dot(normal, i), dot(normal, r)
        mirror = add(tuple(2 * ci * v for v in normal), -1, i)
        lobe = (n + 2) / (2 * math.pi) * max(0.0, dot(mirror, r))**n
        return ci * cr * (rho_d / math.pi + rho_s * lobe) if ci > 0 and cr > 0 else 0.0
    return kernel


def binomial(b, c, d, l1):
    """As phong, of the binomial model of Greynolds 2015 with one row of coefficients."""
    def kernel(normal, i, r):
        ci, cr = dot(normal, i), dot(normal, r)
        if ci <= 0 or cr <= 0:
            return 0.0
        distance = math.dist(add(r, -cr, normal), add(tuple(-v for v in i), ci, normal))
        exponent = sum(v * distance**k for k, v in enumerate(b)) + 0.5 * sum(
            v * math.log10(1 + d**(k + l1) * distance**2) for k, v in enumerate(c))
        return ci * cr * 10**exponent
    return kernel


CHASSIS_NORMAL, ARRAY_NORMAL = (0, 0, -1), (0, 1, 0)
# Models of Fankhauser et al. 2023: (area in m^2, normal, kernel) of chassis and array.
MODELS = {
    "inferred": ((1.0, CHASSIS_NORMAL, phong(0.34, 0.40, 8.9)),
                 (1.0, ARRAY_NORMAL, phong(0.15, 0.25, 0.26))),
    "laboratory": ((3.65, CHASSIS_NORMAL,
                    binomial((3.34, -98.085),
                             (-999.999, 867.538, 1000, 1000, -731.248, 618.552, -294.054, 269.248,
                              -144.853, 75.196), 3, -5)),
                   (22.0, ARRAY_NORMAL,
                    binomial((0.534, -20.409),
                             (-527.765, 1000, -676.579, 430.596, -175.806, 57.879), 3, -3))),
}


def flux_ratio(model, sun_body, observer_body, range_m):
    """Irradiance at the observer over that of the Sun at the satellite."""
    return sum(area * kernel(normal, sun_body, observer_body)
               for area, normal, kernel in MODELS[model]) / range_m**2


# --------------------------------------------------------------------------------------- statistics

def statistics(calculated, observed):
    """How magnitudes agree: r, Pearson's correlation; chi2, the mean of (C - O)^2 / O, which is what
    the study gives under that name; rms, mean and scatter (rms about the mean) of C - O."""
    n = len(observed)
    mean_c, mean_o = sum(calculated) / n, sum(observed) / n
    covariance = sum((c - mean_c) * (o - mean_o) for c, o in zip(calculated, observed))
    spread_c = sum((c - mean_c)**2 for c in calculated)
    spread_o = sum((o - mean_o)**2 for o in observed)
    errors = [c - o for c, o in zip(calculated, observed)]
    rms, mean = math.sqrt(sum(e * e for e in errors) / n), sum(errors) / n
    return {"r": covariance / math.sqrt(spread_c * spread_o), "rms": rms, "mean": mean,
            "chi2": sum(e * e / o for e, o in zip(errors, observed)) / n,
            "scatter": math.sqrt(rms**2 - mean**2)}
