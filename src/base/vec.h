/* vec.h: 3-vectors, 3x3 matrices and quaternions on plain arrays.
 *
 * Matrices are row-major; R_ab maps b to a: v_a = R_ab v_b.
 * Quaternions are Hamilton, scalar first (w, x, y, z): v_a = q v_b q*.
 * Outputs may alias inputs unless a function says otherwise. */
#ifndef GLINT_BASE_VEC_H
#define GLINT_BASE_VEC_H

#include "base/fasttrig.h"

#include <math.h>
#include <string.h>

static inline double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross3(const double a[3], const double b[3], double out[3])
{
    const double x = a[1] * b[2] - a[2] * b[1];
    const double y = a[2] * b[0] - a[0] * b[2];
    const double z = a[0] * b[1] - a[1] * b[0];
    out[0] = x, out[1] = y, out[2] = z;
}

static inline double norm3(const double a[3])
{
    return sqrt(dot3(a, a));
}

static inline void copy3(const double a[3], double out[3])
{
    out[0] = a[0], out[1] = a[1], out[2] = a[2];
}

static inline void scale3(const double a[3], double s, double out[3])
{
    out[0] = a[0] * s, out[1] = a[1] * s, out[2] = a[2] * s;
}

static inline void add3(const double a[3], const double b[3], double out[3])
{
    out[0] = a[0] + b[0], out[1] = a[1] + b[1], out[2] = a[2] + b[2];
}

static inline void sub3(const double a[3], const double b[3], double out[3])
{
    out[0] = a[0] - b[0], out[1] = a[1] - b[1], out[2] = a[2] - b[2];
}

/* out = a + s b */
static inline void add_scaled3(const double a[3], double s, const double b[3], double out[3])
{
    out[0] = a[0] + s * b[0], out[1] = a[1] + s * b[1], out[2] = a[2] + s * b[2];
}

/* Unit vector of a, safe from overflow and underflow; returns |a| (0 leaves out = 0). */
static inline double unit3(const double a[3], double out[3])
{
    const double square = dot3(a, a);
    if (square > 1e-280 && square < 1e280) { /* nothing can overflow, and no digits are lost */
        const double length = sqrt(square);
        scale3(a, 1.0 / length, out);
        return length;
    }
    const double m = fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
    if (!(m > 0.0)) {
        out[0] = out[1] = out[2] = 0.0;
        return 0.0;
    }
    const double s[3] = {a[0] / m, a[1] / m, a[2] / m};
    const double n = norm3(s);
    out[0] = s[0] / n, out[1] = s[1] / n, out[2] = s[2] / n;
    return m * n;
}

/* Angle between two vectors of any length, rad, accurate near 0 and pi. */
static inline double angle3(const double a[3], const double b[3])
{
    double c[3];
    cross3(a, b, c);
    return atan2(norm3(c), dot3(a, b));
}

/* The part of a normal to the unit vector n, unit; returns its length before scaling. */
static inline double perp3(const double a[3], const double n[3], double out[3])
{
    double p[3];
    add_scaled3(a, -dot3(a, n), n, p);
    add_scaled3(p, -dot3(p, n), n, p); /* once more: removes the rounding of the first */
    return unit3(p, out);
}

/* out = R v */
static inline void mat_vec(const double r[9], const double v[3], double out[3])
{
    const double x = dot3(r, v), y = dot3(r + 3, v), z = dot3(r + 6, v);
    out[0] = x, out[1] = y, out[2] = z;
}

/* out = R^T v */
static inline void mat_tvec(const double r[9], const double v[3], double out[3])
{
    const double x = r[0] * v[0] + r[3] * v[1] + r[6] * v[2];
    const double y = r[1] * v[0] + r[4] * v[1] + r[7] * v[2];
    const double z = r[2] * v[0] + r[5] * v[1] + r[8] * v[2];
    out[0] = x, out[1] = y, out[2] = z;
}

/* out = A B */
static inline void mat_mul(const double a[9], const double b[9], double out[9])
{
    double c[9];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
    memcpy(out, c, sizeof c);
}

static inline void mat_transpose(const double a[9], double out[9])
{
    const double c[9] = {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]};
    memcpy(out, c, sizeof c);
}

static inline void mat_identity(double out[9])
{
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(out, one, sizeof one);
}

/* Matrix whose rows are x, y, z: maps the frame they are given in to the frame they span. */
static inline void mat_rows(const double x[3], const double y[3], const double z[3], double out[9])
{
    copy3(x, out), copy3(y, out + 3), copy3(z, out + 6);
}

/* Matrix that turns vectors right-handed by `angle` rad about the unit `axis` (Rodrigues). */
static inline void mat_turn(const double axis[3], double angle, double out[9])
{
    double s, c;
    fast_sin_cos(angle, &s, &c);
    const double d = 1.0 - c;
    const double x = axis[0], y = axis[1], z = axis[2];
    out[0] = c + d * x * x, out[1] = d * x * y - s * z, out[2] = d * x * z + s * y;
    out[3] = d * y * x + s * z, out[4] = c + d * y * y, out[5] = d * y * z - s * x;
    out[6] = d * z * x - s * y, out[7] = d * z * y + s * x, out[8] = c + d * z * z;
}

/* Matrix R_ab of the unit quaternion q with v_a = q v_b q*. */
static inline void mat_from_quat(const double q[4], double out[9])
{
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    out[0] = 1 - 2 * (y * y + z * z), out[1] = 2 * (x * y - w * z), out[2] = 2 * (x * z + w * y);
    out[3] = 2 * (x * y + w * z), out[4] = 1 - 2 * (x * x + z * z), out[5] = 2 * (y * z - w * x);
    out[6] = 2 * (x * z - w * y), out[7] = 2 * (y * z + w * x), out[8] = 1 - 2 * (x * x + y * y);
}

/* Unit quaternion, w >= 0, of the rotation matrix r (Shepperd's choice of the largest part). */
static inline void quat_from_mat(const double r[9], double q[4])
{
    const double t = r[0] + r[4] + r[8];
    const double d[4] = {t, r[0], r[4], r[8]};
    int k = 0;
    for (int i = 1; i < 4; i++)
        if (d[i] > d[k]) k = i;
    if (k == 0) {
        q[0] = 1 + t, q[1] = r[7] - r[5], q[2] = r[2] - r[6], q[3] = r[3] - r[1];
    } else if (k == 1) {
        q[0] = r[7] - r[5], q[1] = 1 + 2 * r[0] - t, q[2] = r[1] + r[3], q[3] = r[2] + r[6];
    } else if (k == 2) {
        q[0] = r[2] - r[6], q[1] = r[1] + r[3], q[2] = 1 + 2 * r[4] - t, q[3] = r[5] + r[7];
    } else {
        q[0] = r[3] - r[1], q[1] = r[2] + r[6], q[2] = r[5] + r[7], q[3] = 1 + 2 * r[8] - t;
    }
    const double n = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double s = (q[0] < 0 ? -1 : 1) / n;
    for (int i = 0; i < 4; i++)
        q[i] *= s;
}

/* out = a b (Hamilton): the turn b, then the turn a. */
static inline void quat_mul(const double a[4], const double b[4], double out[4])
{
    const double w = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    const double x = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    const double y = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    const double z = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
    out[0] = w, out[1] = x, out[2] = y, out[3] = z;
}

/* q*: the turn back. */
static inline void quat_conjugate(const double q[4], double out[4])
{
    out[0] = q[0], out[1] = -q[1], out[2] = -q[2], out[3] = -q[3];
}

static inline double quat_dot(const double a[4], const double b[4])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/* Unit quaternion of a turn by `angle` rad, right-handed, about the unit `axis`. */
static inline void quat_turn(const double axis[3], double angle, double out[4])
{
    out[0] = cos(0.5 * angle);
    scale3(axis, sin(0.5 * angle), out + 1);
}

/* The part `f` of the turn q (unit): the same axis, f times the angle, which is 2 acos(w), 0 to
 * 2 pi. q = (-1, 0, 0, 0), a full turn about no axis, gives no turn. */
static inline void quat_part(const double q[4], double f, double out[4])
{
    double axis[3];
    const double half = atan2(unit3(q + 1, axis), q[0]);
    quat_turn(axis, 2.0 * f * half, out);
}

/* From a (f = 0) to b (f = 1) by the shortest way at a steady rate (Shoemake 1985); q and -q are
 * the same turn. a, b: unit. */
static inline void quat_slerp(const double a[4], const double b[4], double f, double out[4])
{
    double back[4], way[4];
    quat_conjugate(a, back);
    quat_mul(b, back, way);
    if (way[0] < 0)
        for (int i = 0; i < 4; i++)
            way[i] = -way[i];
    quat_part(way, f, way);
    quat_mul(way, a, out);
}

/* Index 0..2 of the component that is largest (smallest) by absolute value; first on a tie. */
static inline int largest3(const double a[3])
{
    int k = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(a[i]) > fabs(a[k])) k = i;
    return k;
}

static inline int smallest3(const double a[3])
{
    int k = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(a[i]) < fabs(a[k])) k = i;
    return k;
}

#endif
