/* photometry.h: from sums to flux ratios and magnitudes. */
#ifndef GLINT_LIGHTCURVE_PHOTOMETRY_H
#define GLINT_LIGHTCURVE_PHOTOMETRY_H

#include "lightcurve/geometry.h"

/* Relative airmass at an elevation (rad, 0 to pi/2) by Kasten and Young 1989, Applied Optics 28,
 * 4735; 0 below the horizon. */
double airmass_kasten_young(double elevation);

/* By the scenario's choice. */
double airmass_of(const glint_scenario *s, double elevation);

/* Of the light in a row's magnitude: the row's own airmass; that at the horizon where the row's
 * time lies below it, and the light of an exposure came from above. */
double airmass_of_light(const glint_scenario *s, const glint_row *row);

/* The same by Pickering 2002, DIO 12, 20: nearer to what the ray sees within some degrees of the
 * horizon. */
double airmass_pickering(double elevation);

/* What takes a magnitude at a range (m) and a phase angle (rad, 0 to pi) to one at 1000 km and
 * another phase angle, by the phase law of a diffuse (Lambertian) sphere, sin p + (pi - p) cos p:
 * add it. -INFINITY where that sphere is dark, at pi. */
double magnitude_to_standard(double range_m, double phase_angle, double standard_phase);

/* Magnitude of a flux ratio > 0: sun - 2.5 log10(ratio). */
double magnitude_of(double flux_ratio, double sun_magnitude);

/* Per-row results of one tile, or of several in a row; arrays owned by the caller. */
typedef struct photometry_rows {
    glint_row *rows;         /* n; flux_ratio etc. point into the arrays below */
    double *flux_ratio;      /* n x n_bands */
    double *magnitude;       /* n x n_bands */
    double *share_material;  /* n x n_materials */
    double *share_component; /* n x n_components */
    double *share_surface; /* n x n_surfaces of the satellite; NULL where they are not told apart */
    double *earthshine;    /* n x n_bands: its part of flux_ratio; NULL: nobody asks */
} photometry_rows;

/* Room for n >= TILE rows, a multiple of TILE, from calloc. photometry_rows_free ends *out in every
 * case. Errors: GLINT_INTERNAL (memory). */
glint_status photometry_rows_make(const glint_scenario *s, size_t n, photometry_rows *out,
                                  glint_error *error);
void photometry_rows_free(photometry_rows *rows);

/* Fills the rows of a tile. sun: n_bands x n_spans x TILE sums in m^2/sr, or NULL where no row of
 * the tile is bright; earth: likewise of the Earth's light, times its irradiance over that of the
 * Sun at 1 au, or NULL. */
void photometry_fill(const glint_scenario *s, const tile_geometry *geometry, const double *sun,
                     const double *earth, const photometry_rows *out);

#endif
