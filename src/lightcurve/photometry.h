/* photometry.h: from sums to flux ratios and magnitudes. */
#ifndef GLINT_LIGHTCURVE_PHOTOMETRY_H
#define GLINT_LIGHTCURVE_PHOTOMETRY_H

#include "lightcurve/geometry.h"

/* Relative airmass at an elevation (rad, 0 to pi/2) by Kasten and Young 1989, Applied Optics 28,
 * 4735; 0 below the horizon. */
double airmass_kasten_young(double elevation);

/* Magnitude of a flux ratio > 0: sun - 2.5 log10(ratio). */
double magnitude_of(double flux_ratio, double sun_magnitude);

/* Per-row results of one tile; arrays owned by the caller. */
typedef struct photometry_rows {
    glint_row *rows;         /* TILE; flux_ratio etc. point into the arrays below */
    double *flux_ratio;      /* TILE x n_bands */
    double *magnitude;       /* TILE x n_bands */
    double *share_material;  /* TILE x n_materials */
    double *share_component; /* TILE x n_components */
    double *earthshine;      /* TILE x n_bands: its part of flux_ratio; NULL: nobody asks */
} photometry_rows;

/* Fills the rows of a tile. sun: n_bands x n_spans x TILE sums in m^2/sr, or NULL where no row of
 * the tile is bright; earth: likewise of the Earth's light, times its irradiance over that of the
 * Sun at 1 au, or NULL. */
void photometry_fill(const glint_scenario *s, const tile_geometry *geometry, const double *sun,
                     const double *earth, const photometry_rows *out);

#endif
