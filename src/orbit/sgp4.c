#include "orbit/sgp4.h"

#include "base/fasttrig.h"
#include "orbit/sgp4_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Functions of the inclination in the short-period terms, and the long-period terms of J3. */
typedef struct inclination_terms {
    double sin_i, cos_i;
    double c3, c1, c7; /* 3 cos^2 i - 1, 1 - cos^2 i, 7 cos^2 i - 1 */
    double long_y;     /* STR3: a_yNL = long_y / p */
    double long_l;     /* STR3: L_L = long_l * a_xN / p */
} inclination_terms;

/* Drag (STR3 sec. 6; the names of its coefficients). Zero where not in use. */
typedef struct drag_terms {
    bool simple;               /* perigee below 220 km, or deep space: only C1 and C4 act */
    double c1, d2, d3, d4;     /* semi-major axis: a factor (1 - C1 t - D2 t^2 - ...)^2 */
    double b4, b5;             /* eccentricity: B* C4, B* C5 */
    double t2, t3, t4, t5;     /* mean longitude over n0: powers of t */
    double node;               /* node: times t^2 */
    double argument, anomaly;  /* perigee and mean anomaly, per min and dimensionless */
    double eta, cube0, sin_m0; /* eta; (1 + eta cos M0)^3; sin M0 */
} drag_terms;

struct sgp4 {
    mean_elements epoch; /* mean_motion: Brouwer's, "un-Kozai'd" */
    mean_elements rate;  /* secular, of the Earth's figure */
    double axis;         /* semi-major axis at the epoch, Earth radii */
    double ke;           /* sqrt(mu), Earth radii^1.5 / min */
    drag_terms drag;
    inclination_terms at_epoch;
    bool deep_space;
    lunisolar third;    /* deep space only */
    resonance resonant; /* deep space only */
    int number;         /* of the catalogue, for messages */
    char name[32];
};

/* ------------------------------------------------------------------ setting up */

static glint_status check_elements(const tle *e, glint_error *error)
{
    const struct {
        const char *name;
        double value, min, max; /* min <= value < max */
        const char *wanted;
    } range[] = {
        {"eccentricity", e->eccentricity, 0.0, 1.0, "at least 0 and below 1"},
        {"inclination", e->inclination, 0.0, PI + 1e-9, "between 0 and pi rad"},
        {"mean motion", e->mean_motion, 1e-12, 1.0, "above 0 and below 1 rad/min"},
        {"right ascension of the node", e->raan, -1e3, 1e3, "an angle in rad"},
        {"argument of perigee", e->argument_of_perigee, -1e3, 1e3, "an angle in rad"},
        {"mean anomaly", e->mean_anomaly, -1e3, 1e3, "an angle in rad"},
        {"B*", e->bstar, -1e3, 1e3, "a drag term in 1/Earth radii, such as 1e-4"},
        {"epoch", e->epoch_jd[0] + e->epoch_jd[1], 2.4e6, 2.5e6, "a Julian date of our time"},
    };
    for (size_t k = 0; k < sizeof range / sizeof *range; k++)
        if (!(range[k].value >= range[k].min && range[k].value < range[k].max))
            return error_set(error, GLINT_INPUT, e->where,
                             "the %s of element set %d is %.9g; expected %s", range[k].name,
                             e->number, range[k].value, range[k].wanted);
    return GLINT_OK;
}

/* Brouwer's mean motion from Kozai's, which element sets carry (STR3 sec. 6, n0''). */
static double brouwer_mean_motion(double kozai, double e2, double cos_i)
{
    const double beta2 = 1.0 - e2;
    const double d = 0.75 * WGS72_J2 * (3.0 * cos_i * cos_i - 1.0) / (sqrt(beta2) * beta2);
    const double ratio = sgp4_ke() / kozai, a1 = cbrt(ratio * ratio);
    const double d1 = d / (a1 * a1);
    const double a0 = a1 * (1.0 - d1 * (1.0 / 3.0 + d1 * (1.0 + 134.0 / 81.0 * d1)));
    return kozai / (1.0 + d / (a0 * a0));
}

static inclination_terms inclination_terms_of(double sin_i, double cos_i)
{
    const double c2 = cos_i * cos_i, j3_j2 = WGS72_J3 / WGS72_J2;
    /* 1 + cos i is kept from 0, where the form is singular (AIAA 2006-6753). */
    const double least = 1.5e-12, divisor = fmax(1.0 + cos_i, least);
    return (inclination_terms){
        .sin_i = sin_i,
        .cos_i = cos_i,
        .c3 = 3.0 * c2 - 1.0,
        .c1 = 1.0 - c2,
        .c7 = 7.0 * c2 - 1.0,
        .long_y = -0.5 * j3_j2 * sin_i,
        .long_l = -0.25 * j3_j2 * sin_i * (3.0 + 5.0 * cos_i) / divisor,
    };
}

/* Secular rates by J2, J2^2 and J4 (STR3 sec. 6). */
static void set_figure_rates(sgp4 *s)
{
    const double n = s->epoch.mean_motion, e2 = s->epoch.eccentricity * s->epoch.eccentricity;
    const double beta2 = 1.0 - e2, p = s->axis * beta2, p2 = p * p;
    const double c = s->at_epoch.cos_i, c2 = c * c, c4 = c2 * c2;
    const double k2 = 1.5 * WGS72_J2 * n / p2, k22 = 0.5 * WGS72_J2 * k2 / p2;
    const double k4 = -0.46875 * WGS72_J4 * n / (p2 * p2);
    const double root = sqrt(beta2);
    s->rate = (mean_elements){
        .mean_anomaly = n + 0.5 * k2 * root * s->at_epoch.c3 +
                        0.0625 * k22 * root * (13.0 - 78.0 * c2 + 137.0 * c4),
        .argument_of_perigee = -0.5 * k2 * (1.0 - 5.0 * c2) +
                               0.0625 * k22 * (7.0 - 114.0 * c2 + 395.0 * c4) +
                               k4 * (3.0 - 36.0 * c2 + 49.0 * c4),
        .raan = c * (-k2 + 0.5 * k22 * (4.0 - 19.0 * c2) + 2.0 * k4 * (3.0 - 7.0 * c2)),
    };
}

/* The theory's density law (q0 - s)^4/(r - s)^4: its height parameter s in Earth radii and
 * (q0 - s)^4. s is lowered for perigees below 156 km, and held below 98 km (STR3 sec. 6). */
static double density_height(double perigee_height_km, double *q4)
{
    const double q0_km = 120.0;
    double s_km = 78.0;
    if (perigee_height_km < 98.0)
        s_km = 20.0;
    else if (perigee_height_km < 156.0)
        s_km = perigee_height_km - 78.0;
    const double q = (q0_km - s_km) / WGS72_RADIUS_KM;
    *q4 = q * q * q * q;
    return s_km / WGS72_RADIUS_KM + 1.0;
}

/* The terms of drag that act above 220 km of perigee, near the Earth (STR3: D2 to D4 and what
 * follows from them). s: height parameter, tsi = 1/(a - s). */
static void set_higher_drag(drag_terms *d, double a, double s, double tsi)
{
    const double c1 = d->c1, c1sq = c1 * c1;
    d->d2 = 4.0 * a * tsi * c1sq;
    const double third = d->d2 * tsi * c1 / 3.0;
    d->d3 = (17.0 * a + s) * third;
    d->d4 = 0.5 * third * a * tsi * (221.0 * a + 31.0 * s) * c1;
    d->t3 = d->d2 + 2.0 * c1sq;
    d->t4 = 0.25 * (3.0 * d->d3 + c1 * (12.0 * d->d2 + 10.0 * c1sq));
    d->t5 = 0.2 * (3.0 * d->d4 + 12.0 * c1 * d->d3 + 6.0 * d->d2 * d->d2 +
                   15.0 * c1sq * (2.0 * d->d2 + c1sq));
}

/* What the drag coefficients are made of (STR3's symbols). */
typedef struct drag_factors {
    double eta, eta2, e_eta; /* eta = a e/(a - s); its square; e eta */
    double q_tsi4;           /* (q0 - s)^4/(a - s)^4 */
    double k;                /* q_tsi4/|1 - eta^2|^3.5 */
    double oblate;           /* J2/((a - s)|1 - eta^2|) */
} drag_factors;

static drag_factors drag_factors_of(double a, double e, double tsi, double q4)
{
    const double eta = a * e * tsi, psi2 = fabs(1.0 - eta * eta);
    const double q_tsi4 = q4 * tsi * tsi * tsi * tsi;
    return (drag_factors){.eta = eta,
                          .eta2 = eta * eta,
                          .e_eta = e * eta,
                          .q_tsi4 = q_tsi4,
                          .k = q_tsi4 / (psi2 * psi2 * psi2 * sqrt(psi2)),
                          .oblate = WGS72_J2 * tsi / psi2};
}

/* C2: the decay of the semi-major axis over B*. */
static double drag_c2(const sgp4 *s, const drag_factors *f)
{
    return f->k * s->epoch.mean_motion *
           (s->axis * (1.0 + 1.5 * f->eta2 + f->e_eta * (4.0 + f->eta2)) +
            0.375 * f->oblate * s->at_epoch.c3 * (8.0 + 3.0 * f->eta2 * (8.0 + f->eta2)));
}

/* C4: the decay of the eccentricity over B*. */
static double drag_c4(const sgp4 *s, const drag_factors *f)
{
    const double e = s->epoch.eccentricity, eta2 = f->eta2, e_eta = f->e_eta;
    const double spherical = f->eta * (2.0 + 0.5 * eta2) + e * (0.5 + 2.0 * eta2);
    const double flat = -3.0 * s->at_epoch.c3 * (1.0 - 2.0 * e_eta + eta2 * (1.5 - 0.5 * e_eta)) +
                        0.75 * s->at_epoch.c1 * (2.0 * eta2 - e_eta * (1.0 + eta2)) *
                            cos(2.0 * s->epoch.argument_of_perigee);
    return 2.0 * s->epoch.mean_motion * f->k * s->axis * (1.0 - e * e) *
           (spherical - f->oblate / s->axis * flat);
}

/* All terms of drag (STR3 sec. 6). False where the density law has no value: the mean height of the
 * orbit below 20 km, or a perigee at its pole. */
static bool set_drag(sgp4 *s, double bstar)
{
    const mean_elements *m = &s->epoch;
    drag_terms *d = &s->drag;
    const double a = s->axis, e = m->eccentricity, beta2 = 1.0 - e * e, n = m->mean_motion;
    const double perigee = a * (1.0 - e), p = a * beta2;
    double q4;
    const double height = density_height((perigee - 1.0) * WGS72_RADIUS_KM, &q4);
    if (!(a > height)) return false;

    const double tsi = 1.0 / (a - height);
    const drag_factors f = drag_factors_of(a, e, tsi, q4);
    d->simple = s->deep_space || perigee < 220.0 / WGS72_RADIUS_KM + 1.0;
    d->c1 = bstar * drag_c2(s, &f);
    d->b4 = bstar * drag_c4(s, &f);
    d->b5 = bstar * 2.0 * f.k * p * (1.0 + 2.75 * (f.eta2 + f.e_eta) + f.e_eta * f.eta2);
    d->t2 = 1.5 * d->c1;
    d->node = -3.5 * beta2 * (1.5 * WGS72_J2 * n / (p * p)) * s->at_epoch.cos_i * d->c1;
    if (e > 1e-4) { /* these two have e in the divisor; below, the published code drops them */
        d->argument = -2.0 * bstar * f.q_tsi4 * tsi * (WGS72_J3 / WGS72_J2) * n *
                      s->at_epoch.sin_i / e * cos(m->argument_of_perigee);
        d->anomaly = -2.0 / 3.0 * f.q_tsi4 * bstar / f.e_eta;
    }
    d->eta = f.eta;
    const double root3 = 1.0 + f.eta * cos(m->mean_anomaly);
    d->cube0 = root3 * root3 * root3;
    d->sin_m0 = sin(m->mean_anomaly);
    if (!d->simple) set_higher_drag(d, a, height, tsi);
    return isfinite(d->c1) && isfinite(d->b4) && isfinite(d->b5);
}

/* Fills what follows from checked elements; false where the orbit lies inside the Earth. */
static bool prepare(sgp4 *s, const tle *e)
{
    const double deep_period_min = 225.0; /* min; STR3 */
    s->ke = sgp4_ke();
    s->at_epoch = inclination_terms_of(sin(e->inclination), cos(e->inclination));
    s->epoch = (mean_elements){
        .mean_motion = brouwer_mean_motion(e->mean_motion, e->eccentricity * e->eccentricity,
                                           s->at_epoch.cos_i),
        .eccentricity = e->eccentricity,
        .inclination = e->inclination,
        .raan = e->raan,
        .argument_of_perigee = e->argument_of_perigee,
        .mean_anomaly = e->mean_anomaly,
    };
    const double ratio = s->ke / s->epoch.mean_motion;
    s->axis = cbrt(ratio * ratio);
    if (!(s->epoch.mean_motion > 0.0)) return false; /* perigee far below the surface */
    s->deep_space = TWO_PI / s->epoch.mean_motion >= deep_period_min;
    set_figure_rates(s);
    if (!set_drag(s, e->bstar)) return false;
    if (s->deep_space) {
        /* In one number, as in the published code: its rounding (20 microseconds) moves orbits that
         * reach out to the Moon by millimetres, and results are to agree to less. */
        const double epoch_jd = e->epoch_jd[0] + e->epoch_jd[1];
        lunisolar_start(&s->epoch, epoch_jd, &s->third);
        resonance_start(&s->epoch, &s->rate, &s->third.rate, epoch_jd, &s->resonant);
    }
    return true;
}

glint_status sgp4_new(const tle *elements, sgp4 **out, glint_error *error)
{
    *out = NULL;
    const glint_status status = check_elements(elements, error);
    if (status) return status;
    sgp4 *s = calloc(1, sizeof *s);
    if (!s) return error_no_memory(error);
    s->number = elements->number;
    memcpy(s->name, elements->name, sizeof s->name);
    s->name[sizeof s->name - 1] = '\0';
    if (!prepare(s, elements)) {
        const double height_km = (s->axis - 1.0) * WGS72_RADIUS_KM;
        const double perigee_km = height_km - s->axis * elements->eccentricity * WGS72_RADIUS_KM;
        free(s);
        return error_set(error, GLINT_INPUT, elements->where,
                         "the orbit of element set %d lies inside the Earth (mean height %.1f km, "
                         "perigee %.1f km); expected one above it, with a mean motion below 17 "
                         "rev/day; check mean motion and eccentricity",
                         elements->number, height_km, perigee_km);
    }
    *out = s;
    return GLINT_OK;
}

void sgp4_free(sgp4 *s)
{
    free(s);
}

bool sgp4_is_deep_space(const sgp4 *s)
{
    return s->deep_space;
}

/* ------------------------------------------------------------------ propagating */

/* Says what went wrong, by the published number. */
static glint_status fail(const sgp4 *s, double t, int number, const char *what, double found,
                         const char *expected, glint_error *error)
{
    return error_set(error, GLINT_INPUT, PLACE_NONE,
                     "SGP4 error %d: %s is %.6g, expected %s, for %s%s%d at %.9g min (%.1f days) "
                     "from the epoch of its elements; %s",
                     number, what, found, expected, s->name, s->name[0] ? ", number " : "number ",
                     s->number, t, t / 1440.0,
                     number == 6 ? "it has decayed: take a time before, or newer elements"
                                 : "take elements of an epoch nearer to that time");
}

/* The drag terms of orbits near the Earth above 220 km. m: mean anomaly and argument of perigee are
 * corrected; the other three are added to. */
static void add_higher_drag(const drag_terms *d, double t, mean_elements *m, double *root_axis,
                            double *eccentricity_loss, double *longitude_gain)
{
    const double t2 = t * t, t3 = t2 * t, t4 = t2 * t2;
    const double root3 = 1.0 + d->eta * cos(m->mean_anomaly);
    const double shift = d->argument * t + d->anomaly * (root3 * root3 * root3 - d->cube0);
    m->mean_anomaly += shift;
    m->argument_of_perigee -= shift;
    *root_axis -= d->d2 * t2 + d->d3 * t3 + d->d4 * t4;
    *eccentricity_loss += d->b5 * (sin(m->mean_anomaly) - d->sin_m0);
    *longitude_gain += d->t3 * t3 + t4 * (d->t4 + t * d->t5);
}

/* Brings the angles within a turn, in the published order: at eccentricities near 1 the rounding of
 * longer angles shows in the position. */
static void reduce_angles(mean_elements *m)
{
    const double longitude = fmod(m->mean_anomaly + m->argument_of_perigee + m->raan, TWO_PI);
    m->raan = fmod(m->raan, TWO_PI);
    m->argument_of_perigee = fmod(m->argument_of_perigee, TWO_PI);
    m->mean_anomaly = fmod(longitude - m->argument_of_perigee - m->raan, TWO_PI);
}

/* Mean elements and semi-major axis (Earth radii) after all secular effects and drag. */
static glint_status mean_at(const sgp4 *s, double t, sgp4_cursor *cursor, mean_elements *m,
                            double *axis, glint_error *error)
{
    const drag_terms *d = &s->drag;
    const double t2 = t * t;
    *m = s->epoch;
    m->raan += s->rate.raan * t + d->node * t2;
    m->argument_of_perigee += s->rate.argument_of_perigee * t;
    m->mean_anomaly += s->rate.mean_anomaly * t;
    double root_axis = 1.0 - d->c1 * t, eccentricity_loss = d->b4 * t;
    double longitude_gain = d->t2 * t2;
    if (!d->simple) add_higher_drag(d, t, m, &root_axis, &eccentricity_loss, &longitude_gain);
    *axis = s->axis;
    if (s->deep_space) {
        lunisolar_add_secular(&s->third, t, m);
        if (s->resonant.active) {
            resonance_apply(&s->resonant, t, s, cursor, m);
            if (!(m->mean_motion > 0.0))
                return fail(s, t, 2, "the mean motion (rad/min)", m->mean_motion, "above 0", error);
            const double ratio = s->ke / m->mean_motion;
            *axis = cbrt(ratio * ratio);
        }
    }
    m->eccentricity -= eccentricity_loss;
    m->mean_anomaly += s->epoch.mean_motion * longitude_gain;
    /* The published limits: a little below 0 is forgiven, and 0 itself would be singular. */
    if (!(m->eccentricity < 1.0 && m->eccentricity >= -0.001))
        return fail(s, t, 1, "the mean eccentricity", m->eccentricity, "at least 0 and below 1",
                    error);
    m->eccentricity = fmax(m->eccentricity, 1e-6);
    /* The published code squares this factor and so lets a satellite that drag has brought down
     * rise again; here the orbit ends where it reaches 0. */
    if (!(root_axis > 0.0))
        return fail(s, t, 6, "the square root of the orbit's size by drag", root_axis, "above 0",
                    error);
    *axis *= root_axis * root_axis;
    m->mean_motion = s->ke / (*axis * sqrt(*axis));
    reduce_angles(m);
    return GLINT_OK;
}

/* Solves u = E' + ay cos E' - ax sin E' for E' (Kepler's equation with the perigee's argument
 * included) and gives its sine and cosine. Newton's method held inside a bracket, which the
 * published code has not: there a solution that leaps about is returned as it stands. */
static void solve_kepler(double u, double ax, double ay, double *sin_e, double *cos_e)
{
    const double reach = 1.1 * (fabs(ax) + fabs(ay)); /* above |E' - u| */
    double at = u, low = u - reach, high = u + reach;
    for (int k = 0; k < 60; k++) {
        double s, c;
        fast_sin_cos(at, &s, &c);
        const double miss = u - ay * c + ax * s - at, slope = 1.0 - c * ax - s * ay;
        double step = miss / slope;
        if (fabs(step) < 1e-7) { /* rad; after this step the error is of order 1e-14 */
            *sin_e = s + step * (c - 0.5 * step * s);
            *cos_e = c - step * (s + 0.5 * step * c);
            return;
        }
        if (miss > 0.0)
            low = at;
        else
            high = at;
        at += step;
        if (!(at > low && at < high)) at = 0.5 * (low + high);
    }
    fast_sin_cos(at, sin_e, cos_e);
}

/* Position and velocity from where the satellite is in its orbit: unit vectors along the radius and
 * ahead of it in the plane of the argument of latitude (sin_u, cos_u), node and inclination.
 * radius in Earth radii; the rates in Earth radii/min over k_e. */
static void to_vectors(const double sin_u, const double cos_u, double node, double inclination,
                       double radius, double radial_rate, double along_rate, double ke,
                       double r_teme_m[3], double v_teme_m_s[3])
{
    double sin_n, cos_n, sin_i, cos_i;
    fast_sin_cos(node, &sin_n, &cos_n);
    fast_sin_cos(inclination, &sin_i, &cos_i);
    const double mx = -sin_n * cos_i, my = cos_n * cos_i;
    const double up[3] = {mx * sin_u + cos_n * cos_u, my * sin_u + sin_n * cos_u, sin_i * sin_u};
    const double on[3] = {mx * cos_u - cos_n * sin_u, my * cos_u - sin_n * sin_u, sin_i * cos_u};
    const double metre = 1000.0 * WGS72_RADIUS_KM, metre_per_s = metre * ke / 60.0;
    for (int k = 0; k < 3; k++) {
        r_teme_m[k] = metre * radius * up[k];
        v_teme_m_s[k] = metre_per_s * (radial_rate * up[k] + along_rate * on[k]);
    }
}

/* Long- and short-period terms of the Earth's figure (STR3 sec. 6), and the vectors. */
static glint_status osculate(const sgp4 *s, double t, const mean_elements *m, double a,
                             const inclination_terms *i, double r_teme_m[3], double v_teme_m_s[3],
                             glint_error *error)
{
    const double inverse_p = 1.0 / (a * (1.0 - m->eccentricity * m->eccentricity));
    double sin_w, cos_w;
    fast_sin_cos(m->argument_of_perigee, &sin_w, &cos_w);
    const double ax = m->eccentricity * cos_w;
    const double ay = m->eccentricity * sin_w + inverse_p * i->long_y;
    const double e2 = ax * ax + ay * ay, p = a * (1.0 - e2);
    if (!(p >= 0.0)) return fail(s, t, 4, "the semi-latus rectum", p, "at least 0", error);

    double sin_e, cos_e;
    const double latitude = m->mean_anomaly + m->argument_of_perigee + inverse_p * i->long_l * ax;
    solve_kepler(fmod(latitude, TWO_PI), ax, ay, &sin_e, &cos_e);
    const double e_cos = ax * cos_e + ay * sin_e, e_sin = ax * sin_e - ay * cos_e;
    const double r = a * (1.0 - e_cos), beta = sqrt(1.0 - e2), part = e_sin / (1.0 + beta);
    const double sin_u = a / r * (sin_e - ay - ax * part);
    const double cos_u = a / r * (cos_e - ax + ay * part);
    const double sin_2u = 2.0 * cos_u * sin_u, cos_2u = 1.0 - 2.0 * sin_u * sin_u;

    const double k1 = 0.5 * WGS72_J2 / p, k2 = k1 / p, nk1 = m->mean_motion * k1 / s->ke;
    const double radius = r * (1.0 - 1.5 * k2 * beta * i->c3) + 0.5 * k1 * i->c1 * cos_2u;
    if (!(radius >= 1.0))
        return fail(s, t, 6, "the distance from the Earth's centre (in its radii)", radius,
                    "at least 1", error);
    const double turn = -0.25 * k2 * i->c7 * sin_2u; /* of the argument of latitude */
    double sin_t, cos_t;
    fast_sin_cos(turn, &sin_t, &cos_t);
    to_vectors(sin_u * cos_t + cos_u * sin_t, cos_u * cos_t - sin_u * sin_t,
               m->raan + 1.5 * k2 * i->cos_i * sin_2u,
               m->inclination + 1.5 * k2 * i->cos_i * i->sin_i * cos_2u, radius,
               sqrt(a) * e_sin / r - nk1 * i->c1 * sin_2u,
               sqrt(p) / r + nk1 * (i->c1 * cos_2u + 1.5 * i->c3), s->ke, r_teme_m, v_teme_m_s);
    return GLINT_OK;
}

glint_status sgp4_state(const sgp4 *s, double minutes, sgp4_cursor *cursor, double r_teme_m[3],
                        double v_teme_m_s[3], glint_error *error)
{
    if (!(fabs(minutes) <= SGP4_SPAN_MIN))
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "%.9g min from the epoch of the elements of %s%s%d is out of reach of "
                         "SGP4; expected at most a century; check the dates",
                         minutes, s->name, s->name[0] ? ", number " : "number ", s->number);
    mean_elements m;
    double axis;
    const glint_status status = mean_at(s, minutes, cursor, &m, &axis, error);
    if (status) return status;
    if (!s->deep_space)
        return osculate(s, minutes, &m, axis, &s->at_epoch, r_teme_m, v_teme_m_s, error);

    lunisolar_add_periodic(&s->third, minutes, &m);
    if (!(m.eccentricity >= 0.0 && m.eccentricity <= 1.0))
        return fail(s, minutes, 3, "the perturbed eccentricity", m.eccentricity, "0 to 1", error);
    const inclination_terms i = inclination_terms_of(sin(m.inclination), cos(m.inclination));
    return osculate(s, minutes, &m, axis, &i, r_teme_m, v_teme_m_s, error);
}
