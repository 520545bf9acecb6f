/* elliptic.h: Jacobi's elliptic functions and the incomplete integral of the third kind through
 * GeographicLib's EllipticFunction, as a C face. */
#ifndef GLINT_ORBIT_ELLIPTIC_H
#define GLINT_ORBIT_ELLIPTIC_H

#ifdef __cplusplus
extern "C" {
#endif

/* Modulus and characteristic with their complements, and the complete integrals; plain data. */
typedef struct elliptic {
    double k2, kp2;         /* k^2 and 1 - k^2, 0 to 1 each */
    double alpha2, alphap2; /* characteristic alpha^2 <= 0, and 1 - alpha^2 */
    double quarter;         /* K(k); infinite where kp2 = 0 */
    double third;           /* complete integral Pi(alpha^2, k) */
} elliptic;

void elliptic_start(double k2, double kp2, double alpha2, double alphap2, elliptic *out);
/* sn, cn, dn of u, and pi = the integral of 1/(1 - alpha^2 sn^2) from 0 to u; for any finite u. */
void elliptic_at(const elliptic *e, double u, double *sn, double *cn, double *dn, double *pi);
/* The u in a period whose amplitude has this sine and cosine: F(phi, k), phi in -pi to pi. Finite
 * where kp2 = 0 only for |phi| < pi/2. */
double elliptic_argument(const elliptic *e, double sine, double cosine);

#ifdef __cplusplus
}
#endif
#endif
