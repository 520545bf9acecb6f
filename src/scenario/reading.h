/* reading.h: what the files of this room share while a scenario is being read. */
#ifndef GLINT_SCENARIO_READING_H
#define GLINT_SCENARIO_READING_H

#include "scenario/read_measured.h"
#include "scenario/reader.h"
#include "scenario/scenario.h"

/* A reading in progress. */
typedef struct reading {
    glint_scenario *s;
    const char *const *overrides; /* borrowed */
    size_t n_overrides;
    glint_errors *errors;
    glint_status status;          /* the worst so far */
    bool orbit_only;              /* [attitude] and the satellite may be absent */
    bool by_surface;              /* surfaces are told apart */
    const glint_changes *changes; /* of the satellite; NULL: none */
    measured_cache tables;        /* files of measured BRDFs; ended where the materials end */
} reading;

/* Keeps the worst of the statuses. */
void reading_note(reading *rd, glint_status status);
/* Ends a table: unknown keys, status. */
void reading_done(reading *rd, reader *r);
/* Memory is out: notes it. */
void reading_no_memory(reading *rd);
/* Opens a document that the scenario keeps; NULL on error (noted). */
toml_document *reading_open(reading *rd, const char *path, place asked_from);
/* Whether a "materials.NAME...=value" is for a material of a file in materials_from: the document
 * names such files and has no material of that name itself. */
bool reading_override_waits(const toml_document *document, const char *assignment);
/* Resolves a path that a node names, relative to its file, and keeps it among the scenario's files;
 * owned by the caller; NULL on error. */
char *reading_path(reading *rd, const toml_node *node);

/* A moment (TT s from the scenario's start) as UTC, for messages. */
typedef struct moment_text {
    char utc[UTC_TEXT_SIZE + 1];
} moment_text;
moment_text reading_moment(const glint_scenario *s, double t_s);

/* A word of the vocabulary, or { ra_deg, dec_deg }, or { latitude_deg, longitude_deg, height_m }.
 */
bool read_direction(reader *r, const char *key, bool required, direction *out);

/* [corrections], whose file of Earth orientation [time] then needs. */
void read_corrections(reading *rd, reader *root);
void read_time(reading *rd, reader *root);
void read_photometry(reading *rd, reader *root);
/* The table of an orbit; name: "[orbit]", for messages. */
void read_orbit(reading *rd, const toml_node *table, const char *name, scenario_orbit *out);
void scenario_orbit_free(scenario_orbit *o);
/* [observer], or every [[observer]]: after [time]. */
void read_observers(reading *rd, reader *root);
void observers_free(glint_scenario *s);
void read_attitude(reading *rd, reader *root);
void read_hinge(reading *rd, const toml_node *table, hinge *out);
void read_geometry(reading *rd, const toml_node *table);
/* The tables of a model: materials_from, materials, component. */
void read_model_tables(reading *rd, reader *r);
/* Tells the surfaces apart where that is wanted, then makes the changes of the satellite. */
void change_satellite(reading *rd, facet_list *facets);
/* The Earth's light: what [photometry] says of it, and, once there is a satellite, the source. */
void read_earthshine(reading *rd, reader *photometry);
void make_earthshine(reading *rd);
void earth_light_free(earth_light *earth, int n_bands);
/* A table of one number for each of the scenario's bands; those of other bands may stand there.
 * value: its unit and range; out: n_bands. Errors go to the list and mark r as failed. */
void read_band_table(reading *rd, reader *r, const toml_node *node, const param_info *value,
                     double *out);
void read_telescope(reading *rd, reader *root);
void read_expectations(reading *rd, reader *root);
/* [observed], and the file that it names. After the time. */
void read_observed(reading *rd, reader *root);
void observed_free(observed_track *o);

void satellite_free(satellite *sat);

#endif
