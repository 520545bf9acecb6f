/* table_parts.h: what the files of the measured-table model share.
 *
 * A table is compiled into one array of numbers, which a lobe can own, copy and compare: a head
 * (TABLE_...), and behind it the arrays that the head points to by their index. */
#ifndef GLINT_BRDF_TABLE_PARTS_H
#define GLINT_BRDF_TABLE_PARTS_H

#include "brdf/measured.h"

#include <stddef.h>

/* The head. */
enum {
    TABLE_SCATTERED, /* 0: scans of the plane of incidence; 1: scattered nodes */
    TABLE_IN_PLANE,  /* 1: every row lies in the plane of incidence */
    TABLE_ROWS,      /* of the file that were used */
    TABLE_DROPPED,   /* rows that were left out: not above the instrument's floor */
    TABLE_NODES,     /* different places among the rows */
    TABLE_MERGED,    /* rows that share their place with others */
    TABLE_SPREAD,    /* the largest |ln f - mean| among those */
    TABLE_LEAST,     /* smallest and largest ln f of the nodes */
    TABLE_LARGEST,
    TABLE_LINES, /* scans: index of the lines, and their number; scattered: of the records */
    TABLE_N_LINES,
    TABLE_SCALE, /* scattered: theta_h up to which distances count evenly, rad */
    TABLE_HULL,  /* index and number of the corners of the coverage */
    TABLE_N_HULL,
    TABLE_AZIMUTH_MIN, /* full tables: range of the azimuth between i and r, 0 to pi, rad */
    TABLE_AZIMUTH_MAX,
    TABLE_COVERED, /* part of the hemisphere, see table_facts */
    TABLE_HEAD
};

/* Where a pair of directions stands, seen from an isotropic and reciprocal surface: nothing here
 * changes when i and r are exchanged, mirrored, or turned about the normal. */
typedef struct table_place {
    double theta_h; /* between the normal and i + r, rad, 0 to pi/2 */
    double theta_d; /* between i and i + r: half the phase angle, rad, 0 to pi/2 */
    double tilt;    /* ((ci - cr)/2)^2 = (sin theta_h sin theta_d cos phi_d)^2 */
} table_place;

typedef struct table_node {
    table_place place;
    double log_f; /* ln of f in 1/sr */
} table_node;

/* The numbers of a table while it is being made. */
typedef struct table_data {
    double *at; /* owned */
    size_t n, capacity;
    bool failed; /* memory is out: later additions do nothing */
} table_data;

/* Appends n numbers (NULL: zeros) and returns the index of the first. */
size_t table_data_add(table_data *data, const double *numbers, size_t n);

/* Angles closer than this are the same: 0.02 arcsec, finer than any table is written. rad */
#define TABLE_SAME_ANGLE 1e-7

/* Scans: rows of one plane of incidence that share few zenith angles of one direction. False when
 * the rows are not of that kind (or, with data->failed, when memory is out); data is then as
 * before, but for its capacity. */
bool table_scans_make(const measured *rows, const table_node *nodes, int n, table_data *data);
double table_scans_log_f(const double *data, const table_place *p);

/* Scattered nodes, any number and kind, in order of theta_h. */
void table_scatter_make(const table_node *nodes, int n, bool in_plane, table_data *data);
double table_scatter_log_f(const double *data, const table_place *p);

/* The region between the measurements; everything else in `data` is done before. */
void table_cover_make(const measured *rows, table_data *data);
bool table_cover_holds(const double *data, const double i[3], const double r[3]);

/* Where a pair of unit directions in the facet's frame stands. */
void table_find_place(const double i[3], const double r[3], table_place *out);

#endif
