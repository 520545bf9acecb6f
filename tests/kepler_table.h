/* kepler_table.h: the velocities of the reference tables of Kepler orbits. */
#ifndef GLINT_KEPLER_TABLE_H
#define GLINT_KEPLER_TABLE_H

#include "base/vec.h"
#include "table.h"

/* The velocity of a row, km/s. The tables give that on an ellipse which stands still and is run
 * through at the unperturbed mean motion. drifts: makes it that on the ellipse which turns: faster
 * by the ratio of the rates of the mean anomaly, and with what the turns about the normal and about
 * z add; all by the table's own rates. */
static inline void table_kepler_velocity(const csv_table *t, long row, bool drifts, double v[3])
{
    static const double MU = 398600.4418; /* km^3/s^2, of the tables */
    static const double z[3] = {0, 0, 1};
    double r[3], normal[3], turned[3];
    table_vector(t, row, "v", "_kms", v);
    if (!drifts) return;
    const double a = table_number(t, row, "a_km"), n = sqrt(MU / a) / a;
    table_vector(t, row, "", "_km", r);
    cross3(r, v, normal);
    unit3(normal, normal);
    scale3(v, table_number(t, row, "M_dot_rads") / n, v);
    cross3(normal, r, turned);
    add_scaled3(v, table_number(t, row, "argp_dot_rads"), turned, v);
    cross3(z, r, turned);
    add_scaled3(v, table_number(t, row, "raan_dot_rads"), turned, v);
}

#endif
