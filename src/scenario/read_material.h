/* read_material.h: the materials of a model. */
#ifndef GLINT_SCENARIO_READ_MATERIAL_H
#define GLINT_SCENARIO_READ_MATERIAL_H

#include "scenario/reading.h"

/* Reads [materials.*] and those of the files in materials_from. */
void read_materials(reading *rd, reader *r);
/* Warns of materials that are used where their parameters do not hold. */
void warn_of_materials(reading *rd);
void scenario_material_free(scenario_material *material);
/* False, with an error, when a name cannot stand in the name of a column. what: "component". */
bool reading_good_name(reading *rd, const char *what, const char *name, place where);

#endif
