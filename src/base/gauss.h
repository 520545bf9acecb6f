/* gauss.h: Gauss's rule of five points, right for polynomials of degree 9. */
#ifndef GLINT_BASE_GAUSS_H
#define GLINT_BASE_GAUSS_H

/* Roots of the Legendre polynomial P5 on -1..1, and their weights over 2, which add to 1
 * (Abramowitz and Stegun, table 25.4). */
static const double GAUSS5[5] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                 0.9061798459386640};
static const double GAUSS5_WEIGHT[5] = {0.1184634425280945, 0.2393143352496832, 0.2844444444444444,
                                        0.2393143352496832, 0.1184634425280945};

#endif
