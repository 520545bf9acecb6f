#include "orbit/eclipse.h"

#include "base/constants.h"
#include "base/gauss.h"
#include "base/vec.h"
#include "orbit/moon.h"

/* (equatorial/polar radius)^2 - 1 of WGS84. */
static const double STRETCH = 1.0 / ((1.0 - EARTH_FLATTENING) * (1.0 - EARTH_FLATTENING)) - 1.0;

/* Scalar product after a stretch along the pole that makes the ellipsoid a sphere. */
static double stretched_dot(const double a[3], const double b[3], const double pole[3])
{
    return dot3(a, b) + STRETCH * dot3(a, pole) * dot3(b, pole);
}

/* Angle at the satellite between the Earth's centre and the ellipsoid's limb, on the side of p.
 * r: from the centre to the satellite, in equatorial radii, outside the ellipsoid; p: unit vector
 * across r. A ray r + t (-r/|r| cos x + p sin x) touches the ellipsoid where its stretched distance
 * from the centre is 1: with g the stretched product, (g(r,w))^2 = g(w,w) (g(r,r) - 1), which is
 * quadratic in cot x; the larger root is the limb on the side of p. */
static double limb_angle(const double r[3], const double p[3], const double pole[3])
{
    const double rr = stretched_dot(r, r, pole), rp = stretched_dot(r, p, pole);
    const double pp = stretched_dot(p, p, pole);
    const double root = sqrt(fmax(0.0, (rr - 1.0) * (rr * pp - rp * rp)));
    return atan2(rr, norm3(r) * (rp + root));
}

/* Angular radius of a sphere, rad. */
static double disc_radius(double radius_m, double distance_m)
{
    return asin(fmin(1.0, radius_m / distance_m));
}

double eclipse_sunlit_fraction(const double r_m[3], const double sun[3], double sun_distance_m,
                               const double pole[3], double limb_darkening)
{
    double r[3];
    scale3(r_m, 1.0 / EARTH_RADIUS_M, r);
    const double r2 = dot3(r, r);
    if (!(stretched_dot(r, r, pole) > 1.0)) return 0.0;

    /* Spheres around and inside the ellipsoid settle most moments without trigonometry: d is the
     * angle Sun - satellite - centre; lit when d > limb of the outer sphere + radius of the Sun,
     * dark when d < limb of the inner sphere - radius of the Sun. |r| cos(d) is compared. */
    const double r_cos_d = -dot3(r, sun);
    const double sin_sun = fmin(1.0, SUN_RADIUS_M / sun_distance_m);
    const double cos_sun = sqrt(1.0 - sin_sun * sin_sun);
    if (r2 > 1.0 && r_cos_d < cos_sun * sqrt(r2 - 1.0) - sin_sun) return 1.0;
    const double polar = 1.0 - EARTH_FLATTENING, polar2 = polar * polar;
    if (r2 * sin_sun * sin_sun < polar2 && r_cos_d > cos_sun * sqrt(r2 - polar2) + sin_sun * polar)
        return 0.0;

    eclipse_discs discs;
    eclipse_discs_at(r_m, sun, sun_distance_m, pole, &discs);
    return eclipse_disc_light(discs.sun, discs.earth, discs.separation, limb_darkening);
}

void eclipse_discs_at(const double r_m[3], const double sun[3], double sun_distance_m,
                      const double pole[3], eclipse_discs *out)
{
    double r[3], side[3];
    scale3(r_m, 1.0 / EARTH_RADIUS_M, r);
    const double length = norm3(r), down[3] = {-r[0] / length, -r[1] / length, -r[2] / length};
    const double sin_d = perp3(sun, down, side);
    if (sin_d == 0.0) {
        /* The Sun stands behind the very centre: any side will do. */
        double across[3] = {0.0, 0.0, 0.0};
        across[smallest3(down)] = 1.0;
        perp3(across, down, side);
    }
    out->sun = disc_radius(SUN_RADIUS_M, sun_distance_m);
    out->earth = limb_angle(r, side, pole);
    out->separation = atan2(sin_d, dot3(sun, down));
}

double eclipse_moon_fraction(const double moon_m[3], const double sun[3], double sun_distance_m,
                             double limb_darkening)
{
    const double distance_m = norm3(moon_m);
    if (!(distance_m > MOON_RADIUS_M)) return 0.0;
    /* Nearly always the Moon is somewhere else. From 20 000 km on, both radii together are less
     * than 5.3 deg, and 0.99 is the cosine of 8.1 deg. */
    static const double FAR_M = 2e7, APART = 0.99;
    if (distance_m > FAR_M && dot3(moon_m, sun) < APART * distance_m) return 1.0;
    return eclipse_disc_light(disc_radius(SUN_RADIUS_M, sun_distance_m),
                              disc_radius(MOON_RADIUS_M, distance_m), angle3(moon_m, sun),
                              limb_darkening);
}

double eclipse_moon_gap(const double moon_m[3], const double sun[3], double sun_distance_m)
{
    return angle3(moon_m, sun) - disc_radius(SUN_RADIUS_M, sun_distance_m) -
           disc_radius(MOON_RADIUS_M, norm3(moon_m));
}

bool eclipse_earth_between(const double a_m[3], const double b_m[3], const double pole[3])
{
    double a[3], way[3], b[3];
    scale3(a_m, 1.0 / EARTH_RADIUS_M, a);
    scale3(b_m, 1.0 / EARTH_RADIUS_M, b);
    sub3(b, a, way);
    /* The point of the straight line that comes nearest to the centre, after the stretch that makes
     * the ellipsoid a sphere, if it lies between the two. */
    const double aa = stretched_dot(a, a, pole), aw = stretched_dot(a, way, pole);
    const double ww = stretched_dot(way, way, pole);
    if (!(aw < 0.0 && -aw < ww)) return false;
    return aa * ww - aw * aw < ww;
}

double eclipse_disc_fraction(double a, double b, double d)
{
    if (d >= a + b) return 1.0;
    if (d <= b - a) return 0.0;
    if (d <= a - b) return 1.0 - (b / a) * (b / a);
    /* The triangle of the two centres and a crossing of the rims has sides a, b, d; four times its
     * area by Heron gives its angles at the centres without the cancellation of acos near 1. */
    const double area4 = sqrt(fmax(0.0, (a + b + d) * (a + b - d) * (a - b + d) * (b - a + d)));
    const double at_a = atan2(area4, a * a + (d - b) * (d + b));
    const double at_b = atan2(area4, b * b + (d - a) * (d + a));
    /* Two circular segments make the lens. */
    const double lens =
        a * a * (at_a - sin(at_a) * cos(at_a)) + b * b * (at_b - sin(at_b) * cos(at_b));
    return fmin(1.0, fmax(0.0, 1.0 - lens / (PI * a * a)));
}

/* The disc is made of uniform ones: with f(x) the uncovered fraction of one of radius x,
 * integration by parts of the brightness over the radius gives, over the mean 1 - u/3,
 *
 *     (1 - u) f(a) + u (integral from 0 to pi/2 of sin^3 t f(a sin t))
 *
 * f bends where a disc comes to touch the other one's rim: there the integral is parted. */
double eclipse_disc_light(double a, double b, double d, double limb_darkening)
{
    const double whole = eclipse_disc_fraction(a, b, d), u = limb_darkening;
    if (u == 0.0 || whole == 1.0 || whole == 0.0 || !(a > 0.0)) return whole;
    enum { PARTS = 4 };
    const double touch = asin(fmin(1.0, fabs(d - b) / a));
    double integral = 0.0;
    for (int side = 0; side < 2; side++) {
        const double from = side ? touch : 0.0, length = (side ? 0.5 * PI - touch : touch) / PARTS;
        for (int k = 0; k < PARTS; k++)
            for (int g = 0; g < 5; g++) {
                const double sine = sin(from + length * (k + 0.5 + 0.5 * GAUSS5[g]));
                integral += GAUSS5_WEIGHT[g] * length * sine * sine * sine *
                            eclipse_disc_fraction(a * sine, b, d);
            }
    }
    return fmin(1.0, ((1.0 - u) * whole + u * integral) / (1.0 - u / 3.0));
}
