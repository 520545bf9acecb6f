// elliptic.cpp: see elliptic.h. The functions of GeographicLib that are used do not throw for
// arguments in the ranges that elliptic.h states.
#include "orbit/elliptic.h"

#include <cmath>
#include <limits>

#include <GeographicLib/EllipticFunction.hpp>

using GeographicLib::EllipticFunction;

extern "C" void elliptic_start(double k2, double kp2, double alpha2, double alphap2, elliptic *out)
{
    *out = elliptic{k2, kp2, alpha2, alphap2, 0, 0};
    if (kp2 > 0) {
        const EllipticFunction f(k2, alpha2, kp2, alphap2);
        out->quarter = f.K();
        out->third = f.Pi();
    } else {
        out->quarter = out->third = std::numeric_limits<double>::infinity();
    }
}

// k = 1: sn = tanh, cn = dn = 1/cosh, and with m = -alpha^2 the integral of 1/(1 + m tanh^2 u) is
// (u + sqrt(m) atan(sqrt(m) tanh u))/(1 + m), as its derivative shows.
static void at_separatrix(const elliptic *e, double u, double *sn, double *cn, double *dn,
                          double *pi)
{
    const double root = std::sqrt(-e->alpha2);
    *sn = std::tanh(u);
    *cn = *dn = 1 / std::cosh(u);
    *pi = (u + root * std::atan(root * *sn)) / e->alphap2;
}

extern "C" void elliptic_at(const elliptic *e, double u, double *sn, double *cn, double *dn,
                            double *pi)
{
    if (!(e->kp2 > 0)) {
        at_separatrix(e, u, sn, cn, dn, pi);
        return;
    }
    // Half periods are taken off first: over them sn and cn change sign and pi grows by 2 Pi.
    const EllipticFunction f(e->k2, e->alpha2, e->kp2, e->alphap2);
    const double halves = std::round(u / (2 * e->quarter));
    const double rest = u - halves * (2 * e->quarter);
    const double sign = std::fmod(halves, 2) == 0 ? 1 : -1;
    f.sncndn(rest, *sn, *cn, *dn);
    *pi = f.Pi(*sn, *cn, *dn) + halves * (2 * e->third);
    *sn *= sign;
    *cn *= sign;
}

extern "C" double elliptic_argument(const elliptic *e, double sine, double cosine)
{
    if (!(e->kp2 > 0)) return std::asinh(sine / std::fabs(cosine));
    const EllipticFunction f(e->k2, e->alpha2, e->kp2, e->alphap2);
    return f.F(std::atan2(sine, cosine));
}
