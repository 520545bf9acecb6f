/* torque_free.c: Euler's free top. With the axes named so that j has the middle moment of inertia
 * and the angular momentum L circles about k (I_i < I_j < I_k, or the other way round), the rates
 * are
 *
 *     w_i = A cn u,   w_j = B sn u,   w_k = C dn u,   u = u0 + p t,
 *
 * and the azimuth of axis k about L, which is fixed in space, runs as
 *
 *     d phi/dt = L (I_i w_i^2 + I_j w_j^2) / (I_i^2 w_i^2 + I_j^2 w_j^2)
 *              = L/I_k + L (I_k - I_i)/(I_i I_k) / (1 - alpha^2 sn^2 u),
 *     alpha^2  = -I_k (I_j - I_i) / (I_i (I_k - I_j)) <= 0,
 *
 * whose integral is the elliptic integral of the third kind. In space, L and the direction of axis
 * k across it are known at every moment; in the body too; the two triads give the attitude. */
#include "orbit/torque_free.h"

#include "base/vec.h"

#include <math.h>
#include <stdbool.h>

/* Differences of moments of inertia this small, relative, are equal: the top is then symmetric. */
static const double EQUAL = 1e-14;

/* The body turns about a fixed axis at a fixed rate. */
static void start_steady(const double rates[3], const double body_inertial[9], torque_free *b)
{
    b->is_steady = 1;
    b->steady_rate = unit3(rates, b->steady_axis);
    memcpy(b->steady_start, body_inertial, 9 * sizeof(double));
}

/* Names the axes i, j, k by the moments of inertia. */
static void order_axes(const double inertia[3], const double w[3], torque_free *b)
{
    int at[3] = {0, 1, 2};
    for (int pass = 0; pass < 2; pass++)
        for (int a = 0; a < 2; a++)
            if (inertia[at[a]] > inertia[at[a + 1]]) {
                const int other = at[a];
                at[a] = at[a + 1];
                at[a + 1] = other;
            }
    /* L^2 - 2 T I_j: its sign says about which end of the scale the momentum circles. */
    const double low = inertia[at[0]], middle = inertia[at[1]], high = inertia[at[2]];
    const double above = high * w[at[2]] * w[at[2]] * (high - middle);
    const double below = low * w[at[0]] * w[at[0]] * (middle - low);
    const int swap = above < below || high - middle <= EQUAL * high;
    b->i = at[swap ? 2 : 0];
    b->j = at[1];
    b->k = at[swap ? 0 : 2];
}

/* Orthonormal triad as rows: along the momentum, axis k's part normal to it, their cross product;
 * in body coordinates. s, c: sn u, cn u. */
static void momentum_triad(const torque_free *b, double sn, double cn, double dn, double triad[9])
{
    double w[3];
    w[0] = b->amplitude[0] * cn, w[1] = b->amplitude[1] * sn, w[2] = b->amplitude[2] * dn;
    double x = b->side_i * cn, y = b->side_j * sn;
    const double side = sqrt(x * x + y * y);
    x /= side, y /= side;
    /* sin and cos of the angle between the momentum and axis k; x, y hold where it vanishes. */
    const double across = hypot(b->inertia[0] * w[0], b->inertia[1] * w[1]);
    const double along = b->inertia[2] * w[2], length = hypot(across, along);
    const double sine = across / length, cosine = along / length;
    double *l = triad, *u = triad + 3;
    l[b->i] = sine * x, l[b->j] = sine * y, l[b->k] = cosine;
    u[b->i] = -cosine * x, u[b->j] = -cosine * y, u[b->k] = sine;
    cross3(l, u, triad + 6);
}

/* Amplitudes, modulus, rate and phase of the elliptic functions. */
static void start_elliptic(const double w[3], torque_free *b)
{
    const double ii = b->inertia[0], ij = b->inertia[1], ik = b->inertia[2];
    const double wi2 = w[b->i] * w[b->i], wj2 = w[b->j] * w[b->j], wk2 = w[b->k] * w[b->k];
    /* 2 T I_k - L^2, L^2 - 2 T I_i and L^2 - 2 T I_j, all of the sign of I_k - I_i, without
     * cancellation in the first two. */
    const double p = ii * wi2 * (ik - ii) + ij * wj2 * (ik - ij);
    const double q = ij * wj2 * (ij - ii) + ik * wk2 * (ik - ii);
    const double s = ik * wk2 * (ik - ij) - ii * wi2 * (ij - ii);
    /* Euler: I_j dw_j/dt = (I_k - I_i) w_k w_i where i, j, k are right-handed, else the negative.
     */
    const bool right_handed = (b->j - b->i + 3) % 3 == 1;
    const double sign_k = w[b->k] < 0 ? -1 : 1;
    const double sign_j = (ik > ij) == right_handed ? sign_k : -sign_k;
    b->amplitude[0] = sqrt(p / (ii * (ik - ii)));
    b->amplitude[1] = sign_j * sqrt(p / (ij * (ik - ij)));
    b->amplitude[2] = sign_k * sqrt(q / (ik * (ik - ii)));
    b->side_i = sqrt(ii * fabs(ik - ij));
    b->side_j = sign_j * sqrt(ij * fabs(ik - ii));
    b->rate = sqrt((ik - ij) * q / (ii * ij * ik));
    const double k2 = (ij - ii) * p / ((ik - ij) * q);
    const double kp2 = (ik - ii) * s / ((ik - ij) * q);
    const double alpha2 = -ik * (ij - ii) / (ii * (ik - ij));
    const double alphap2 = ij * (ik - ii) / (ii * (ik - ij));
    elliptic_start(fmin(k2, 1), fmin(fmax(kp2, 0), 1), alpha2, alphap2, &b->e);
    b->u0 = 0;
    if (p != 0)
        b->u0 = elliptic_argument(&b->e, w[b->j] / b->amplitude[1], w[b->i] / b->amplitude[0]);
}

void torque_free_start(const double inertia[3], const double rates[3],
                       const double body_inertial[9], torque_free *b)
{
    *b = (torque_free){0};
    order_axes(inertia, rates, b);
    const int axes[3] = {b->i, b->j, b->k};
    double momentum[3];
    for (int a = 0; a < 3; a++) {
        b->inertia[a] = inertia[axes[a]];
        momentum[a] = inertia[a] * rates[a];
    }
    b->momentum = norm3(momentum);
    const double spread = fabs(b->inertia[2] - b->inertia[1]);
    if (!(b->momentum > 0) || spread <= EQUAL * b->inertia[2]) {
        start_steady(rates, body_inertial, b);
        return;
    }
    start_elliptic(rates, b);
    if (!(b->rate > 0) || !isfinite(b->u0)) { /* about the middle axis exactly: it stays there */
        start_steady(rates, body_inertial, b);
        return;
    }
    b->precession = b->momentum / b->inertia[2];
    b->nutation = b->momentum * (b->inertia[2] - b->inertia[0]) / (b->inertia[0] * b->inertia[2]);
    double sn, cn, dn, triad[9], inertial_body[9];
    elliptic_at(&b->e, b->u0, &sn, &cn, &dn, &b->pi0);
    momentum_triad(b, sn, cn, dn, triad);
    mat_transpose(body_inertial, inertial_body);
    mat_transpose(triad, triad); /* columns: the triad in the body */
    mat_mul(inertial_body, triad, b->start_from_momentum);
}

void torque_free_at(const torque_free *b, double t_s, double body_inertial[9], double rates[3])
{
    if (b->is_steady) {
        double turn[9];
        mat_turn(b->steady_axis, -b->steady_rate * t_s, turn);
        mat_mul(turn, b->steady_start, body_inertial);
        if (rates) scale3(b->steady_axis, b->steady_rate, rates);
        return;
    }
    double sn, cn, dn, pi, triad[9];
    elliptic_at(&b->e, b->u0 + b->rate * t_s, &sn, &cn, &dn, &pi);
    if (rates) {
        rates[b->i] = b->amplitude[0] * cn;
        rates[b->j] = b->amplitude[1] * sn;
        rates[b->k] = b->amplitude[2] * dn;
    }
    momentum_triad(b, sn, cn, dn, triad);
    /* The triad has turned about the momentum by the azimuth of axis k. */
    const double azimuth = b->precession * t_s + b->nutation * ((pi - b->pi0) / b->rate);
    const double along[3] = {1, 0, 0};
    double turn[9], inertial_momentum[9], body_momentum[9], momentum_inertial[9];
    mat_turn(along, azimuth, turn);
    mat_mul(b->start_from_momentum, turn, inertial_momentum);
    mat_transpose(inertial_momentum, momentum_inertial);
    mat_transpose(triad, body_momentum);
    mat_mul(body_momentum, momentum_inertial, body_inertial);
}

/* The squares of sn and cn add to 1, and dn is 1 at most. */
double torque_free_fastest(const torque_free *b)
{
    if (b->is_steady) return fabs(b->steady_rate);
    const double *a = b->amplitude;
    return sqrt(fmax(a[0] * a[0], a[1] * a[1]) + a[2] * a[2]);
}
