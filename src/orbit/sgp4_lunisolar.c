/* sgp4_lunisolar.c: what the Sun and the Moon do to a deep-space orbit (SDP4).
 *
 * Both bodies move on fixed ellipses whose planes and perigees are held at the epoch. Their
 * attraction, averaged over the satellite's revolution, is a quadratic form of the body's
 * direction. With the unit vectors p (to the body's perigee) and q (90 deg ahead of it), every
 * combination of elements k has such a form F_k, and from its values on (p,p), (p,q) and (q,q)
 * follow the secular rate (the mean over the body's revolution) and the terms in 2f, f being the
 * body's true anomaly: that is all that STR3's long list of Z and X terms says. */
#include "base/vec.h"
#include "orbit/sgp4_parts.h"

/* One perturbing body's orbit (STR3, sec. 7). */
typedef struct body_orbit {
    double strength;    /* rad/min^2: its mean motion squared, times its mass ratio */
    double mean_motion; /* rad/min */
    double eccentricity;
    double anomaly0;                /* mean anomaly at the epoch, rad */
    double to_perigee[3], ahead[3]; /* p and q, equatorial axes */
} body_orbit;

/* Mean motions in rad/min, eccentricities, strengths (STR3: n_s, n_m, e_s, e_m, C1_s, C1_m). */
static const double sun_mean_motion = 1.19459e-5, sun_eccentricity = 0.01675;
static const double sun_strength = 2.9864797e-6;
static const double moon_mean_motion = 1.5835218e-4, moon_eccentricity = 0.05490;
static const double moon_strength = 4.7968065e-7;

/* Sine and cosine of the obliquity and of the Sun's argument of perigee (STR3). */
static const double sin_obliquity = 0.39785416, cos_obliquity = 0.91744867;
static const double sin_sun_perigee = -0.98088458, cos_sun_perigee = 0.1945905;

/* p and q of an orbit with that argument of perigee, inclination and node on the equator, each
 * given by its sine and cosine. */
static void orient(double sin_g, double cos_g, double sin_i, double cos_i, double sin_h,
                   double cos_h, body_orbit *b)
{
    const double p[3] = {cos_g, sin_g * cos_i, sin_g * sin_i};
    const double q[3] = {-sin_g, cos_g * cos_i, cos_g * sin_i};
    b->to_perigee[0] = p[0] * cos_h - p[1] * sin_h;
    b->to_perigee[1] = p[0] * sin_h + p[1] * cos_h;
    b->to_perigee[2] = p[2];
    b->ahead[0] = q[0] * cos_h - q[1] * sin_h;
    b->ahead[1] = q[0] * sin_h + q[1] * cos_h;
    b->ahead[2] = q[2];
}

/* The Sun; day: days from 1900 January 0.5. */
static body_orbit sun_at(double day)
{
    body_orbit b = {.strength = sun_strength,
                    .mean_motion = sun_mean_motion,
                    .eccentricity = sun_eccentricity,
                    .anomaly0 = fmod(6.2565837 + 0.017201977 * day, TWO_PI)};
    orient(sin_sun_perigee, cos_sun_perigee, sin_obliquity, cos_obliquity, 0.0, 1.0, &b);
    return b;
}

/* The Moon; day: days from 1900 January 0.5. Its orbit is inclined to the ecliptic by 5.145 deg,
 * the sine of which is 0.089683511, and precesses: inclination and node on the equator follow from
 * the node on the ecliptic by the spherical triangle of the two nodes and the equinox (STR3, sec.
 * 7). */
static body_orbit moon_at(double day)
{
    const double ecliptic_node = fmod(4.5236020 - 9.2422029e-4 * day, TWO_PI); /* rad */
    const double sin_n = sin(ecliptic_node), cos_n = cos(ecliptic_node);
    const double cos_i = 0.91375164 - 0.03568096 * cos_n;
    const double sin_i = sqrt(1.0 - cos_i * cos_i);
    const double sin_h = 0.089683511 * sin_n / sin_i;
    const double cos_h = sqrt(1.0 - sin_h * sin_h);
    const double perigee_longitude = 5.8351514 + 0.0019443680 * day; /* rad */
    /* angle between the ecliptic's node and the equator's, along the lunar orbit */
    const double arc =
        atan2(sin_obliquity * sin_n / sin_i, cos_h * cos_n + cos_obliquity * sin_h * sin_n);
    const double g = perigee_longitude + arc - ecliptic_node;
    body_orbit b = {.strength = moon_strength,
                    .mean_motion = moon_mean_motion,
                    .eccentricity = moon_eccentricity,
                    .anomaly0 = fmod(4.7199672 + 0.22997150 * day - perigee_longitude, TWO_PI)};
    orient(sin(g), cos(g), sin_i, cos_i, sin_h, cos_h, &b);
    return b;
}

/* The satellite's orbit: unit vectors to the node, 90 deg ahead of it, and along the normal. */
typedef struct orbit_frame {
    double node[3], ahead[3], normal[3];
    double sin_w, cos_w; /* of the argument of perigee */
    double e2;           /* eccentricity squared */
} orbit_frame;

static orbit_frame frame_of(const mean_elements *m)
{
    const double sin_n = sin(m->raan), cos_n = cos(m->raan);
    const double sin_i = sin(m->inclination), cos_i = cos(m->inclination);
    return (orbit_frame){.node = {cos_n, sin_n, 0.0},
                         .ahead = {-sin_n * cos_i, cos_n * cos_i, sin_i},
                         .normal = {sin_n * sin_i, -cos_n * sin_i, cos_i},
                         .sin_w = sin(m->argument_of_perigee),
                         .cos_w = cos(m->argument_of_perigee),
                         .e2 = m->eccentricity * m->eccentricity};
}

/* A direction in that frame: along the node n, ahead of it m, along the normal w; f and g: along
 * the perigee and 90 deg ahead of it. */
typedef struct direction {
    double n, m, w, f, g;
} direction;

static direction direction_in(const orbit_frame *o, const double v[3])
{
    const double n = dot3(o->node, v), m = dot3(o->ahead, v);
    return (direction){.n = n,
                       .m = m,
                       .w = dot3(o->normal, v),
                       .f = n * o->cos_w + m * o->sin_w,
                       .g = m * o->cos_w - n * o->sin_w};
}

/* The forms F_k(u, v) of the five combinations, not symmetrised. They are STR3's products of X
 * and Z terms: X1 X3, Z11, Z1, Z31 and Z21 for u = v = p. */
static void forms(const orbit_frame *o, const direction *u, const direction *v,
                  double out[LS_COUNT])
{
    const double in_orbit = 12.0 * u->f * v->f - 3.0 * u->g * v->g;
    const double tilt_f = 24.0 * u->f, tilt_g = 6.0 * u->g;
    out[LS_E] = u->f * v->g;
    out[LS_I] = -v->w * (6.0 * u->n + o->e2 * (tilt_f * o->cos_w + tilt_g * o->sin_w));
    out[LS_L] = 6.0 * (u->n * v->n + u->m * v->m) + (1.0 + o->e2) * in_orbit;
    out[LS_GH] = in_orbit;
    out[LS_H] = v->w * (6.0 * u->m + o->e2 * (tilt_f * o->sin_w - tilt_g * o->cos_w));
}

/* Fills the periodic terms of one body and adds its secular rates of the five combinations. */
static void add_body(const orbit_frame *o, const mean_elements *m, const body_orbit *b,
                     third_body *out, double rate[LS_COUNT])
{
    const direction p = direction_in(o, b->to_perigee), q = direction_in(o, b->ahead);
    double pp[LS_COUNT], pq[LS_COUNT], qp[LS_COUNT], qq[LS_COUNT];
    forms(o, &p, &p, pp);
    forms(o, &p, &q, pq);
    forms(o, &q, &p, qp);
    forms(o, &q, &q, qq);
    const double root = sqrt(1.0 - o->e2), s3 = b->strength / m->mean_motion;
    const double scale[LS_COUNT] = {-15.0 * m->eccentricity * s3 * root, -0.5 * s3 / root, -s3,
                                    s3 * root, 0.5 * s3 / root};
    /* the part that does not depend on the direction: the attraction is larger at perigee */
    const double offset[LS_COUNT] = {0.0, 0.0, -14.0 - 6.0 * o->e2, -6.0, 0.0};
    out->anomaly0 = b->anomaly0;
    out->anomaly_rate = b->mean_motion;
    out->eccentricity = b->eccentricity;
    for (int k = 0; k < LS_COUNT; k++) {
        out->cos2f[k] = -0.5 * scale[k] * (pq[k] + qp[k]);
        out->sin2f[k] = -0.5 * scale[k] * (qq[k] - pp[k]);
        out->sinf[k] = 3.0 * scale[k] * offset[k] * b->eccentricity;
        rate[k] += scale[k] * b->mean_motion * (pp[k] + qq[k] + offset[k]);
    }
}

void lunisolar_start(const mean_elements *epoch, double epoch_jd, lunisolar *out)
{
    const double day = epoch_jd - 2415020.0; /* JD 2415020: 1900 January 0.5 */
    const orbit_frame frame = frame_of(epoch);
    const body_orbit bodies[2] = {sun_at(day), moon_at(day)};
    double rate[LS_COUNT] = {0};
    for (int k = 0; k < 2; k++)
        add_body(&frame, epoch, &bodies[k], &out->body[k], rate);

    /* The node's rate has a factor 1/sin i. It is left out within 3 deg of the equator, where the
     * division would magnify an effect that hardly exists (STR3; beside 180 deg AIAA 2006-6753). */
    const double margin = 5.2359877e-2, i = epoch->inclination;
    const double node_rate = i < margin || i > PI - margin ? 0.0 : rate[LS_H] / sin(i);
    out->rate = (mean_elements){.eccentricity = rate[LS_E],
                                .inclination = rate[LS_I],
                                .raan = node_rate,
                                .argument_of_perigee = rate[LS_GH] - cos(i) * node_rate,
                                .mean_anomaly = rate[LS_L]};
}

void lunisolar_add_secular(const lunisolar *ls, double t, mean_elements *m)
{
    m->eccentricity += ls->rate.eccentricity * t;
    m->inclination += ls->rate.inclination * t;
    m->raan += ls->rate.raan * t;
    m->argument_of_perigee += ls->rate.argument_of_perigee * t;
    m->mean_anomaly += ls->rate.mean_anomaly * t;
}

/* Sums the periodic terms of both bodies. */
static void periodic_sums(const lunisolar *ls, double t, double sum[LS_COUNT])
{
    for (int k = 0; k < LS_COUNT; k++)
        sum[k] = 0.0;
    for (int j = 0; j < 2; j++) {
        const third_body *b = &ls->body[j];
        const double anomaly = b->anomaly0 + b->anomaly_rate * t;
        const double f = anomaly + 2.0 * b->eccentricity * sin(anomaly); /* to first order in e */
        const double s = sin(f), c = cos(f);
        const double sin2f = 2.0 * s * c, cos2f = 1.0 - 2.0 * s * s;
        for (int k = 0; k < LS_COUNT; k++)
            sum[k] += b->cos2f[k] * cos2f + b->sin2f[k] * sin2f + b->sinf[k] * s;
    }
}

/* Near the equator node and perigee are ill defined; Lyddane's form perturbs the vector
 * (sin i sin Omega, sin i cos Omega) and the mean longitude instead. m->inclination is perturbed
 * already. */
static void add_lyddane(const double sum[LS_COUNT], double sin_i, double cos_i, mean_elements *m)
{
    const double node = m->raan; /* within a turn */
    const double sin_n = sin(node), cos_n = cos(node);
    const double y = sin_i * sin_n + sum[LS_H] * cos_n + sum[LS_I] * cos_i * sin_n;
    const double x = sin_i * cos_n - sum[LS_H] * sin_n + sum[LS_I] * cos_i * cos_n;
    const double longitude = m->mean_anomaly + m->argument_of_perigee + cos_i * node + sum[LS_L] +
                             sum[LS_GH] - sum[LS_I] * node * sin_i;
    double turned = atan2(y, x);
    /* the new node must lie on the same turn as the old one: it enters by itself below */
    if (fabs(node - turned) > PI) turned += turned < node ? TWO_PI : -TWO_PI;
    m->mean_anomaly += sum[LS_L];
    m->argument_of_perigee = longitude - m->mean_anomaly - cos_i * turned;
    m->raan = turned;
}

void lunisolar_add_periodic(const lunisolar *ls, double t, mean_elements *m)
{
    double sum[LS_COUNT];
    periodic_sums(ls, t, sum);
    m->inclination += sum[LS_I];
    m->eccentricity += sum[LS_E];
    const double sin_i = sin(m->inclination), cos_i = cos(m->inclination);
    if (m->inclination >= 0.2) { /* rad; STR3's limit, on the perturbed inclination (AIAA 2006) */
        const double node = sum[LS_H] / sin_i;
        m->raan += node;
        m->argument_of_perigee += sum[LS_GH] - cos_i * node;
        m->mean_anomaly += sum[LS_L];
    } else {
        add_lyddane(sum, sin_i, cos_i, m);
    }
    if (m->inclination < 0.0) { /* the same plane, seen from its other node */
        m->inclination = -m->inclination;
        m->raan += PI;
        m->argument_of_perigee -= PI;
    }
}
