#include "orbit/kepler.h"

#include "base/constants.h"
#include "base/fasttrig.h"

#include <math.h>

/* x less whole turns, -pi to pi. 2 pi is split in two, the first part so short that its product
 * with the number of turns is exact; the second is the rest of 2 pi to double precision. */
static double reduce_angle(double x)
{
    const double head = 0x1.921fb54p+2, tail = 3.968374318722162e-09;
    if (!(fabs(x) < 1e8)) return atan2(sin(x), cos(x)); /* the C library's exact reduction */
    const double turns = (double)llrint(x / TWO_PI);
    return (x - turns * head) - turns * tail;
}

/* x - sin(x) for 0 <= x <= pi, without its cancellation near 0. */
static double minus_sine(double x, double sin_x)
{
    if (x > 0.5) return x - sin_x;
    /* Taylor's series; the first term left out is below 1e-17 of the sum at 0.5. */
    const double x2 = x * x;
    double sum = 1.0;
    for (int k = 14; k >= 4; k -= 2)
        sum = 1.0 - sum * x2 / (k * (k + 1));
    return x * x2 / 6.0 * sum;
}

/* A start for 0 <= m <= pi, within 2e-3 rad: two terms of the series in e for a near circle, else
 * Mikkola's cubic. */
static double first_guess(double m, double e)
{
    if (e < 0.1) {
        double s, c;
        fast_sin_cos(m, &s, &c);
        return m + e * s * (1.0 + e * c);
    }
    const double scale = 1.0 / (4.0 * e + 0.5);
    const double alpha = (1.0 - e) * scale, beta = 0.5 * m * scale;
    const double z = cbrt(beta + sqrt(beta * beta + alpha * alpha * alpha));
    const double s = z - alpha / z, s2 = s * s;
    const double better = s - 0.078 * s * s2 * s2 / (1.0 + e);
    return m + e * (3.0 * better - 4.0 * better * better * better);
}

/* Solves E - e sin E = m for 0 <= m <= pi; leaves the sine and cosine of E, too. The function rises
 * from m to m + e, so the root stays in a bracket; a correction that would leave it is replaced by
 * a bisection. */
static double solve(double m, double e, double *sine, double *cosine)
{
    enum { MOST = 64 };        /* two are usual; bisection alone would end within this */
    const double close = 1e-4; /* relative; a step of fourth order then leaves rounding only */
    double low = m, high = fmin(m + e, PI);
    double x = fmin(fmax(first_guess(m, e), low), high);
    for (int k = 0; k < MOST; k++) {
        double s, c;
        fast_sin_cos(x, &s, &c);
        const double e_s = e * s, e_c = e * c;
        /* x - e sin x - m and its slope 1 - e cos x, without cancellation for e near 1 */
        const double minus_cosine = c > 0.0 ? s * s / (1.0 + c) : 1.0 - c;
        const double f = (1.0 - e) * x + e * minus_sine(x, s) - m;
        const double f1 = (1.0 - e) + e * minus_cosine;
        if (f > 0.0)
            high = x;
        else
            low = x;
        const double d1 = -f / f1;
        const double d2 = -f / (f1 + 0.5 * d1 * e_s);
        const double d3 = -f / (f1 + 0.5 * d2 * e_s + d2 * d2 * e_c / 6.0);
        double next = x + d3;
        if (!(next >= low && next <= high)) next = 0.5 * (low + high);
        const double step = next - x;
        x = next;
        if (fabs(step) > close * x) continue;
        turn_sin_cos(step, &s, &c);
        *sine = s;
        *cosine = c;
        return x;
    }
    fast_sin_cos(x, sine, cosine);
    return x;
}

/* The eccentric anomaly with its sine and cosine. */
static double eccentric_anomaly(double mean_anomaly, double e, double *sine, double *cosine)
{
    const double m = reduce_angle(mean_anomaly);
    if (e == 0.0) { /* a circle */
        fast_sin_cos(m, sine, cosine);
        return m;
    }
    const double x = solve(fmin(fabs(m), PI), e, sine, cosine);
    *sine = copysign(*sine, m);
    return copysign(x, m);
}

double kepler_eccentric_anomaly(double mean_anomaly, double eccentricity)
{
    double sine, cosine;
    return eccentric_anomaly(mean_anomaly, eccentricity, &sine, &cosine);
}

static glint_status check(const kepler_elements *k, glint_error *error)
{
    if (!(k->eccentricity >= 0.0 && k->eccentricity < 1.0))
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "eccentricity is %g; expected at least 0 and below 1", k->eccentricity);
    if (!(k->semi_major_axis_m > 0.0 && isfinite(k->semi_major_axis_m)))
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "semi-major axis is %g m; expected a positive number",
                         k->semi_major_axis_m);
    if (!isfinite(k->inclination) || !isfinite(k->raan) || !isfinite(k->argument_of_perigee) ||
        !isfinite(k->mean_anomaly))
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "an angle of the orbit is not finite; expected numbers");
    return GLINT_OK;
}

glint_status kepler_start(const kepler_elements *elements, double mu_m3_s2, double j2,
                          double radius_m, kepler_orbit *out, glint_error *error)
{
    const glint_status status = check(elements, error);
    if (status) return status;
    const double a = elements->semi_major_axis_m, e = elements->eccentricity;
    const double axes = sqrt((1.0 - e) * (1.0 + e)); /* semi-minor over semi-major axis */
    const double n = sqrt(mu_m3_s2 / a) / a, c = cos(elements->inclination);
    const double radius_over_p = radius_m / (a * axes * axes);
    const double k = 0.75 * n * j2 * radius_over_p * radius_over_p;
    const double mean_motion = n + k * axes * (3.0 * c * c - 1.0);
    *out = (kepler_orbit){
        .at_epoch = *elements,
        .mean_motion = mean_motion,
        .speed_m_s = mean_motion * a,
        .raan_rate = -2.0 * k * c,
        .argument_rate = k * (5.0 * c * c - 1.0),
        .semi_minor_axis_m = a * axes,
        .sin_inclination = sin(elements->inclination),
        .cos_inclination = c,
    };
    return GLINT_OK;
}

void kepler_state(const kepler_orbit *orbit, double dt_s, double r_m[3], double v_m_s[3])
{
    const kepler_elements *k = &orbit->at_epoch;
    const double a = k->semi_major_axis_m, b = orbit->semi_minor_axis_m, e = k->eccentricity;
    double sin_e, cos_e;
    eccentric_anomaly(k->mean_anomaly + orbit->mean_motion * dt_s, e, &sin_e, &cos_e);
    const double rate = orbit->speed_m_s / (1.0 - e * cos_e); /* a dE/dt, m/s */
    const double x = a * (cos_e - e), y = b * sin_e;
    const double vx = -rate * sin_e, vy = rate * (b / a) * cos_e;

    /* p points to the perigee, q a quarter turn on along the motion. */
    const double node = k->raan + orbit->raan_rate * dt_s;
    const double argument = k->argument_of_perigee + orbit->argument_rate * dt_s;
    double sin_n, cos_n, sin_w, cos_w;
    fast_sin_cos(node, &sin_n, &cos_n);
    fast_sin_cos(argument, &sin_w, &cos_w);
    const double sin_i = orbit->sin_inclination, cos_i = orbit->cos_inclination;
    const double p[3] = {cos_n * cos_w - sin_n * sin_w * cos_i,
                         sin_n * cos_w + cos_n * sin_w * cos_i, sin_w * sin_i};
    const double q[3] = {-cos_n * sin_w - sin_n * cos_w * cos_i,
                         cos_n * cos_w * cos_i - sin_n * sin_w, cos_w * sin_i};
    for (int i = 0; i < 3; i++) {
        r_m[i] = x * p[i] + y * q[i];
        v_m_s[i] = vx * p[i] + vy * q[i];
    }
    /* The ellipse itself turns: in its plane about the normal p x q, and about z with its node. */
    const double turn = orbit->argument_rate, drift = orbit->raan_rate;
    for (int i = 0; i < 3; i++)
        v_m_s[i] += turn * (x * q[i] - y * p[i]);
    v_m_s[0] -= drift * r_m[1];
    v_m_s[1] += drift * r_m[0];
}
