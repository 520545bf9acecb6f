/* read_measured.h: the keys of a measured BRDF. */
#ifndef GLINT_SCENARIO_READ_MEASURED_H
#define GLINT_SCENARIO_READ_MEASURED_H

#include "brdf/brdf.h"
#include "scenario/files.h"
#include "scenario/reader.h"

/* Files that were read, so that a material with many bands, and materials of one file, read it
 * once. Zero-initialise; measured_cache_free ends it. It borrows from the documents of the readers.
 */
typedef struct measured_cache {
    struct measured_source *items; /* owned */
    int n;
    file_list *files; /* borrowed; what is read is added to it; NULL: not kept */
} measured_cache;

void measured_cache_free(measured_cache *cache);

/* Reads the file that the table of r names, and makes of it the numbers of a lobe whose model and
 * params are set (BRDF_MEASURED). Errors go to r, those in the file with the file's places. */
void read_measured(reader *r, measured_cache *cache, brdf_lobe *lobe);

/* Warns of each measured lobe of a material that is used where it was not measured: out of the
 * plane of incidence, or in a part of the hemisphere. name, where: of the material. */
void warn_of_measured(const brdf_material *material, const char *name, place where,
                      glint_errors *errors);

#endif
