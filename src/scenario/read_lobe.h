/* read_lobe.h: the parameters of one lobe: numbers, arrays, and numbers that follow a spectrum. */
#ifndef GLINT_SCENARIO_READ_LOBE_H
#define GLINT_SCENARIO_READ_LOBE_H

#include "base/band.h"
#include "brdf/brdf.h"
#include "scenario/reader.h"

/* Fills the params and arrays of a lobe whose model is set from the table of r and, where they win,
 * from its `spectrum` and from r->overlay. band: NULL for none; a spectrum is then taken as in V.
 * Errors go to r: what is wrong in the table, and in all of its spectrum. brdf_lobe_free ends the
 * lobe in every case. */
void read_lobe_params(reader *r, const band_info *band, brdf_lobe *lobe);

/* Where the numbers of a spectrum are taken in a band. */
typedef struct spectrum_use {
    double lowest_um, highest_um; /* its range */
    bool outside; /* the band lies outside, and some number comes from the nearest */
} spectrum_use;

/* False when the table has no spectrum. table: of a lobe that was read without an error; overlay:
 * of the band, or NULL. */
bool spectrum_used(const toml_node *table, const toml_node *overlay, const band_info *band,
                   spectrum_use *use);

#endif
