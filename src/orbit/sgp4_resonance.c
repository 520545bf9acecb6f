/* sgp4_resonance.c: orbits whose period is half a day or a day, where harmonics of the Earth's
 * field that turn with it act at every revolution in the same sense (SDP4, STR3 sec. 7).
 *
 * The mean motion n and the resonant longitude lambda obey
 *     dn/dt = sum over k, j of Im( C[k][j] exp(i (k lambda + m_j omega)) ),    k = 1..3
 *     d lambda/dt = n + drift
 * with complex constants C and multiples m_j = 0, 2, 1, -1 of the argument of perigee. They are
 * integrated from the epoch by Taylor steps of 720 min to second order; the last, shorter one leads
 * to the time wanted. The steps are part of the theory: another integrator gives other positions.
 */
#include "orbit/sgp4_parts.h"

#include <erfa.h>

static const double step_min = 720.0;
/* Earth's rotation rate against the mean equinox, rad/min (STR3: theta dot). */
static const double earth_rate = 4.37526908801129966e-3;

/* Order of the multiples of omega in the table of harmonics. */
enum { W_0, W_PLUS_2, W_PLUS_1, W_MINUS_1 };

/* A term `size` * sin(k lambda + m omega - phase). */
static void add_harmonic(resonance *r, int k, int m, double size, double phase)
{
    r->re[k - 1][m] += size * cos(phase);
    r->im[k - 1][m] -= size * sin(phase);
}

/* c0 + c1 e + c2 e^2 + c3 e^3 */
static double cubic(const double c[4], double e)
{
    return c[0] + e * (c[1] + e * (c[2] + e * c[3]));
}

/* Eccentricity functions G_lpq of the 12 h resonance: fits to the Hansen coefficients, made for
 * eccentricities from 0.5 up (STR3 sec. 7; coefficients of its listing). */
typedef struct eccentricity_functions {
    double g201, g211, g310, g322, g410, g422, g520, g521, g532, g533;
} eccentricity_functions;

static eccentricity_functions eccentricity_functions_12h(double e)
{
    static const double g211[2][4] = {{3.616, -13.2470, 16.2900, 0.0},
                                      {-72.099, 331.819, -508.738, 266.724}};
    static const double g310[2][4] = {{-19.302, 117.3900, -228.4190, 156.5910},
                                      {-346.844, 1582.851, -2415.925, 1246.113}};
    static const double g322[2][4] = {{-18.9068, 109.7927, -214.6334, 146.5816},
                                      {-342.585, 1554.908, -2366.899, 1215.972}};
    static const double g410[2][4] = {{-41.122, 242.6940, -471.0940, 313.9530},
                                      {-1052.797, 4758.686, -7193.992, 3651.957}};
    static const double g422[2][4] = {{-146.407, 841.8800, -1629.014, 1083.4350},
                                      {-3581.690, 16178.110, -24462.770, 12422.520}};
    static const double g520[3][4] = {{-532.114, 3017.977, -5740.032, 3708.2760},
                                      {1464.74, -4664.75, 3763.64, 0.0},
                                      {-5149.66, 29936.92, -54087.36, 31324.56}};
    static const double g521[2][4] = {{-822.71072, 4568.6173, -8491.4146, 5337.524},
                                      {-51752.104, 218913.95, -309468.16, 146349.42}};
    static const double g532[2][4] = {{-853.66600, 4690.2500, -8624.7700, 5341.4},
                                      {-40023.880, 170470.89, -242699.48, 115605.82}};
    static const double g533[2][4] = {{-919.22770, 4988.6100, -9064.7700, 5542.21},
                                      {-37995.780, 161616.52, -229838.20, 109377.94}};
    const int high = e > 0.65, highest = e <= 0.65 ? 0 : e <= 0.715 ? 1 : 2, above = e >= 0.7;
    return (eccentricity_functions){.g201 = -0.306 - (e - 0.64) * 0.440,
                                    .g211 = cubic(g211[high], e),
                                    .g310 = cubic(g310[high], e),
                                    .g322 = cubic(g322[high], e),
                                    .g410 = cubic(g410[high], e),
                                    .g422 = cubic(g422[high], e),
                                    .g520 = cubic(g520[highest], e),
                                    .g521 = cubic(g521[above], e),
                                    .g532 = cubic(g532[above], e),
                                    .g533 = cubic(g533[above], e)};
}

/* Inclination functions F_lmp of the same. */
typedef struct inclination_functions {
    double f220, f221, f321, f322, f441, f442, f522, f523, f542, f543;
} inclination_functions;

static inclination_functions inclination_functions_12h(double i)
{
    const double s = sin(i), c = cos(i), s2 = s * s, c2 = c * c;
    const double f220 = 0.75 * (1.0 + 2.0 * c + c2);
    return (inclination_functions){
        .f220 = f220,
        .f221 = 1.5 * s2,
        .f321 = 1.875 * s * (1.0 - 2.0 * c - 3.0 * c2),
        .f322 = -1.875 * s * (1.0 + 2.0 * c - 3.0 * c2),
        .f441 = 35.0 * s2 * f220,
        .f442 = 39.3750 * s2 * s2,
        .f522 = 9.84375 * s *
                (s2 * (1.0 - 2.0 * c - 5.0 * c2) + 0.33333333 * (-2.0 + 4.0 * c + 6.0 * c2)),
        .f523 = s * (4.92187512 * s2 * (-2.0 - 4.0 * c + 10.0 * c2) +
                     6.56250012 * (1.0 + 2.0 * c - 3.0 * c2)),
        .f542 = 29.53125 * s * (2.0 - 8.0 * c + c2 * (-12.0 + 8.0 * c + 10.0 * c2)),
        .f543 = 29.53125 * s * (-2.0 - 8.0 * c + c2 * (12.0 + 8.0 * c - 10.0 * c2))};
}

/* The 12 h resonance. inverse_a: 1/Earth radii. */
static void start_half_day(const mean_elements *m, double inverse_a, resonance *r)
{
    /* normalised field coefficients C_lm, and the phases G_lm in rad (STR3) */
    const double c22 = 1.7891679e-6, c32 = 3.7393792e-7, c44 = 7.3636953e-9;
    const double c52 = 1.1428639e-7, c54 = 2.1765803e-9;
    const double g22 = 5.7686396, g32 = 0.95240898, g44 = 1.8014998;
    const double g52 = 1.0508330, g54 = 4.4108898;
    const eccentricity_functions g = eccentricity_functions_12h(m->eccentricity);
    const inclination_functions f = inclination_functions_12h(m->inclination);
    const double n2 = m->mean_motion * m->mean_motion;
    const double a2 = 3.0 * n2 * inverse_a * inverse_a, a3 = a2 * inverse_a;
    const double a4 = a3 * inverse_a, a5 = a4 * inverse_a;
    add_harmonic(r, 1, W_PLUS_2, a2 * c22 * f.f220 * g.g201, g22);
    add_harmonic(r, 1, W_0, a2 * c22 * f.f221 * g.g211, g22);
    add_harmonic(r, 1, W_PLUS_1, a3 * c32 * f.f321 * g.g310, g32);
    add_harmonic(r, 1, W_MINUS_1, a3 * c32 * f.f322 * g.g322, g32);
    add_harmonic(r, 2, W_PLUS_2, 2.0 * a4 * c44 * f.f441 * g.g410, g44);
    add_harmonic(r, 2, W_0, 2.0 * a4 * c44 * f.f442 * g.g422, g44);
    add_harmonic(r, 1, W_PLUS_1, a5 * c52 * f.f522 * g.g520, g52);
    add_harmonic(r, 1, W_MINUS_1, a5 * c52 * f.f523 * g.g532, g52);
    add_harmonic(r, 2, W_PLUS_1, 2.0 * a5 * c54 * f.f542 * g.g521, g54);
    add_harmonic(r, 2, W_MINUS_1, 2.0 * a5 * c54 * f.f543 * g.g533, g54);
    r->with_perigee = 0.0;
    r->node_factor = 2.0;
}

/* The 24 h resonance. */
static void start_day(const mean_elements *m, double inverse_a, resonance *r)
{
    const double q22 = 1.7891679e-6, q31 = 2.1460748e-6, q33 = 2.2123015e-7;      /* STR3 */
    const double phase31 = 0.13130908, phase22 = 2.8843198, phase33 = 0.37448087; /* rad */
    const double e2 = m->eccentricity * m->eccentricity;
    const double s = sin(m->inclination), c = cos(m->inclination), c1 = 1.0 + c;
    const double g200 = 1.0 + e2 * (-2.5 + 0.8125 * e2);
    const double g310 = 1.0 + 2.0 * e2;
    const double g300 = 1.0 + e2 * (-6.0 + 6.60937 * e2);
    const double f220 = 0.75 * c1 * c1;
    const double f311 = 0.9375 * s * s * (1.0 + 3.0 * c) - 0.75 * c1;
    const double f330 = 1.875 * c1 * c1 * c1;
    const double n2 = m->mean_motion * m->mean_motion;
    const double a2 = 3.0 * n2 * inverse_a * inverse_a, a3 = a2 * inverse_a;
    add_harmonic(r, 1, W_0, a3 * q31 * f311 * g310, phase31);
    add_harmonic(r, 2, W_0, 2.0 * a2 * q22 * f220 * g200, 2.0 * phase22);
    add_harmonic(r, 3, W_0, 3.0 * a3 * q33 * f330 * g300, 3.0 * phase33);
    r->with_perigee = 1.0;
    r->node_factor = 1.0;
}

void resonance_start(const mean_elements *epoch, const mean_elements *figure,
                     const mean_elements *third, double epoch_jd, resonance *out)
{
    /* The windows of mean motion (rad/min) and of eccentricity are STR3's: periods of 1200 to
     * 1800 min; 680 to 760 min, where a round orbit feels little and is left out. */
    const double n = epoch->mean_motion;
    const bool day = n > 0.0034906585 && n < 0.0052359877;
    const bool half_day = n >= 8.26e-3 && n <= 9.24e-3 && epoch->eccentricity >= 0.5;
    *out = (resonance){.active = day || half_day};
    if (!out->active) return;
    const double ratio = n / sgp4_ke(), inverse_a = cbrt(ratio * ratio);
    if (day)
        start_day(epoch, inverse_a, out);
    else
        start_half_day(epoch, inverse_a, out);

    const double p = out->with_perigee, q = out->node_factor;
    out->theta0 = eraGmst82(epoch_jd, 0.0); /* UTC serves as UT1, as in the theory */
    out->mean_motion0 = n;
    out->longitude0 =
        fmod(epoch->mean_anomaly + p * epoch->argument_of_perigee + q * (epoch->raan - out->theta0),
             TWO_PI);
    out->drift = figure->mean_anomaly + third->mean_anomaly +
                 p * (figure->argument_of_perigee + third->argument_of_perigee) +
                 q * (figure->raan + third->raan - earth_rate) - n;
    out->argument0 = epoch->argument_of_perigee;
    out->argument_rate = figure->argument_of_perigee;
}

/* Sets the first and second time derivative of the mean motion at the cursor's place. */
static void set_rates(const resonance *r, sgp4_cursor *c)
{
    const double w = r->argument0 + r->argument_rate * c->time_min;
    const double sin_w = sin(w), cos_w = cos(w);
    const double sin_l = sin(c->longitude), cos_l = cos(c->longitude);
    /* exp(i m omega) in the table's order */
    const double wr[4] = {1.0, cos_w * cos_w - sin_w * sin_w, cos_w, cos_w};
    const double wi[4] = {0.0, 2.0 * sin_w * cos_w, sin_w, -sin_w};
    double lr = cos_l, li = sin_l, sum = 0.0, sum_k = 0.0;
    for (int k = 0; k < 3; k++) {
        double re = 0.0, im = 0.0;
        for (int m = 0; m < 4; m++) {
            re += r->re[k][m] * wr[m] - r->im[k][m] * wi[m];
            im += r->re[k][m] * wi[m] + r->im[k][m] * wr[m];
        }
        sum += re * li + im * lr;
        sum_k += (k + 1) * (re * lr - im * li);
        const double next = lr * cos_l - li * sin_l; /* exp(i (k + 1) lambda) */
        li = lr * sin_l + li * cos_l;
        lr = next;
    }
    c->mean_motion_dot = sum;
    c->mean_motion_dot_dot = sum_k * (c->mean_motion + r->drift);
}

/* Moves by dt, with the derivatives of where the cursor stands. */
static void taylor(const resonance *r, const sgp4_cursor *c, double dt, double *mean_motion,
                   double *longitude)
{
    const double half = 0.5 * dt * dt, n = c->mean_motion; /* the outputs may be the cursor's */
    *mean_motion = n + c->mean_motion_dot * dt + c->mean_motion_dot_dot * half;
    *longitude = c->longitude + (n + r->drift) * dt + c->mean_motion_dot * half;
}

/* Takes the cursor to the last multiple of 720 min from the epoch that is not beyond t. Steps are
 * taken away from the epoch only, so that what is found does not depend on earlier calls. */
static void go_to(const resonance *r, double t, const sgp4 *of, sgp4_cursor *c)
{
    const bool on_the_way = c->of == of && c->time_min * t >= 0.0 && fabs(c->time_min) <= fabs(t);
    if (!on_the_way) {
        *c = (sgp4_cursor){.of = of, .mean_motion = r->mean_motion0, .longitude = r->longitude0};
        set_rates(r, c);
    }
    const double step = t < 0.0 ? -step_min : step_min;
    while (fabs(t - c->time_min) >= step_min) {
        taylor(r, c, step, &c->mean_motion, &c->longitude);
        c->time_min += step;
        set_rates(r, c);
    }
}

void resonance_apply(const resonance *r, double t, const sgp4 *of, sgp4_cursor *cursor,
                     mean_elements *m)
{
    sgp4_cursor own = {0};
    sgp4_cursor *c = cursor ? cursor : &own;
    double longitude;
    go_to(r, t, of, c);
    taylor(r, c, t - c->time_min, &m->mean_motion, &longitude);
    const double theta = r->theta0 + earth_rate * t;
    m->mean_anomaly =
        longitude - r->with_perigee * m->argument_of_perigee - r->node_factor * (m->raan - theta);
}
