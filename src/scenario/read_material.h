/* read_material.h: the materials of a model. */
#ifndef GLINT_SCENARIO_READ_MATERIAL_H
#define GLINT_SCENARIO_READ_MATERIAL_H

#include "scenario/reading.h"

/* Reads [materials.*] and those of the files in materials_from. */
void read_materials(reading *rd, reader *r);
/* Reads one [materials.NAME] table in the scenario's bands (a band that is NULL: as the table says,
 * without the keys of any band) and checks the keys of all others. scenario_material_free ends *out
 * in every case. */
void read_material(reading *rd, const toml_node *table, scenario_material *out);
/* Reads the keys that say how a surface reflects, `brdf` and its parameters, from a table with other
 * keys that the caller knows; band NULL: without a band. Errors go to r and leave *out empty. */
void read_reflection(reading *rd, reader *r, const band_info *band, brdf_material *out);
/* What a material is as a function, in its one band; borrowed. */
const brdf_material *material_function(const glint_material *material);
/* Refuses the materials in use that are perfect mirrors: a point Sun has no image in them. */
void refuse_mirrors(reading *rd);
/* Warns of materials that are used where their parameters do not hold. */
void warn_of_materials(reading *rd);
void scenario_material_free(scenario_material *material);
/* False, with an error, when a name cannot stand in the name of a column. what: "component". */
bool reading_good_name(reading *rd, const char *what, const char *name, place where);

#endif
