/* table.h: measured BRDFs: an interpolation of tables, for isotropic and reciprocal surfaces.
 *
 * ln f is interpolated over theta_h, the angle between the normal and i + r, and theta_d, between i
 * and i + r; for full tables also over phi_d. The result is the same when i and r are exchanged,
 * has no cusp at the mirror direction (theta_h = 0), reproduces the nodes, and between them stays
 * in the range of the nodes around.
 *
 * Rows that by these symmetries measure the same place are merged: their ln f is averaged, and how
 * far they disagree is told. A table of one plane of incidence is carried out of that plane by
 * assuming that f does not depend on phi_d. Outside of the region that was measured the nearest
 * values hold, which is told by table_covers; there is no extrapolation along a slope. */
#ifndef GLINT_BRDF_TABLE_H
#define GLINT_BRDF_TABLE_H

#include "base/text.h"
#include "brdf/brdf.h"
#include "brdf/measured.h"

/* The model's one parameter. */
enum { TABLE_FLOOR }; /* 1/sr: rows with f at or below it are left out, as measured_format.floor */

/* What a table rests on. */
typedef struct table_facts {
    int n_rows;            /* of the file that are used */
    int n_dropped;         /* and that are not: without light */
    int n_nodes;           /* different places among them */
    int n_merged;          /* rows that share their place with others */
    double spread;         /* largest |ln f - mean| among those */
    bool in_plane;         /* else full */
    bool scans;            /* rows form scans at few incidences; else they are taken as scattered */
    double least, largest; /* range of f, 1/sr */
    double covered; /* part of the hemisphere that lies between the measurements: of all pairs of
                       directions, each counted with both its cosines, as a diffuse surface does */
    bool whole;     /* all of it, as far as `covered` is known (1 %), and not in one plane alone */
} table_facts;

/* Makes *lobe (its weight and params are kept) a lobe of the model `table` from measured rows;
 * brdf_lobe_free ends it. Errors: GLINT_INTERNAL: memory is out. */
glint_status table_prepare(const measured *rows, brdf_lobe *lobe, glint_error *error);

/* f, 1/sr, also at the horizon, where g is 0. lobe: made by table_prepare; i, r: unit, facet frame,
 * not below the horizon. */
double table_f(const brdf_lobe *lobe, const double i[3], const double r[3]);
/* Whether a pair of directions (as above) lies between the measurements: inside the convex hull of
 * what was measured, in (theta_h, theta_d) for a table of one plane, in both zenith angles and the
 * azimuth between them for a full one. */
bool table_covers(const brdf_lobe *lobe, const double i[3], const double r[3]);
void table_describe(const brdf_lobe *lobe, table_facts *facts);
/* Appends the facts in words: lines that begin with `indent`. */
void table_report(const brdf_lobe *lobe, const char *indent, text *t);

#endif
