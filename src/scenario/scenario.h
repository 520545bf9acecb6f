/* scenario.h: a scenario as read and checked: everything that a run needs, compiled, immutable. */
#ifndef GLINT_SCENARIO_SCENARIO_H
#define GLINT_SCENARIO_SCENARIO_H

#include "base/band.h"
#include "base/csv.h"
#include "facets/globe.h"
#include "facets/model.h"
#include "facets/visibility.h"
#include "orbit/attitude_plan.h"
#include "orbit/earth.h"
#include "orbit/hinge.h"
#include "orbit/horizon.h"
#include "orbit/orbit.h"
#include "orbit/refraction.h"
#include "scenario/files.h"
#include "scenario/toml.h"

enum { SCENARIO_MAX_BANDS = 16 };

/* A material: its reflection in each band of the scenario. */
typedef struct scenario_material {
    const char *name;       /* borrowed from its document */
    const char *source;     /* "" where not said */
    place where;            /* of its table */
    const toml_node *table; /* borrowed from its document */
    brdf_material *bands;   /* owned; n_bands */
    double holds_um[2]; /* wavelengths from and to which the parameters hold; 0 where not said */
    bool used;          /* by some facet */
    double flicker_rad; /* by how much meshes of it bend from facet to facet, where its lobe is too
                           narrow for that; else 0 */
} scenario_material;

/* A part of the satellite and how it turns. */
typedef struct scenario_component {
    const char *name; /* borrowed from its document */
    int parent;       /* index, -1 for none */
    bool has_hinge;
    hinge hinge;
    char *report; /* owned; lines on what its primitives became, for people; NULL: none */
} scenario_component;

/* What faces one way: the facets of a component, of one material as its file has it, that look in
 * one direction, or are curved. Numbered by facet.part. */
typedef struct satellite_surface {
    char *name;         /* owned: "bus/mli/+x": component, material as the file has it, facing */
    const char *facing; /* end of the name */
    int component;
    const char *material; /* as it is now, after swaps; borrowed */
    double area_m2;       /* 0 where its component was taken away */
} satellite_surface;

/* The satellite: a model file, or tables in the scenario. */
typedef struct satellite {
    scenario_material *materials;   /* owned */
    int n_materials;                /* those in use only, in the order of the files */
    scenario_component *components; /* owned; in the order of the file */
    int n_components;
    int *order;                        /* owned; parents before children */
    model_material *model_materials;   /* owned; what the compiled model borrows */
    model_component *model_components; /* owned */
    satellite_surface *surfaces;       /* owned; NULL where they are not told apart */
    int n_surfaces;
    model model;
} satellite;

typedef enum orbit_source {
    ORBIT_TLE,       /* element sets, from two lines or OMM */
    ORBIT_POSITIONS, /* a table of positions */
    ORBIT_KEPLER,
    ORBIT_CIRCULAR,
    ORBIT_GEOSTATIONARY
} orbit_source;

/* An orbit: how the scenario says it, and what propagates it. */
typedef struct scenario_orbit {
    orbit_source source;
    tle_list sets;          /* TLE; owned */
    const char *file;       /* of element sets or positions, as written; borrowed; NULL without */
    kepler_elements kepler; /* KEPLER and CIRCULAR */
    double epoch_s;         /* of these: TT s from the start */
    bool j2;
    double geostationary_longitude; /* rad */
    orbit *propagator;              /* owned */
} scenario_orbit;

typedef enum observer_kind {
    OBSERVER_SITE,      /* a place on the ground */
    OBSERVER_SATELLITE, /* with an orbit of its own */
    OBSERVER_DIRECTION  /* always in the same direction from the satellite */
} observer_kind;

/* Who looks. */
typedef struct scenario_observer {
    const char *name; /* "" where not said; borrowed from the document */
    place where;      /* of its table */
    observer_kind kind;
    /* Of a site: */
    earth_site site;
    horizon horizon; /* owned: what is lower is not seen */
    refraction air;
    /* Of a satellite: */
    scenario_orbit orbit;
    /* Of a direction: */
    bool in_body;        /* else in GCRS */
    double direction[3]; /* unit, from the satellite to the observer */
    double range_m;
} scenario_observer;

/* In the order of the words in read_scenario.c. */
typedef enum self_shadows {
    SHADOWS_EXACT,
    SHADOWS_NONE,
    SHADOWS_INTERPOLATED,
    SHADOWS_RAYS
} self_shadows;

/* What the Sun is to the facets; to the Earth's shadow it is a disc in any case. */
typedef enum solar_disc_choice {
    SOLAR_UNIFORM,
    SOLAR_LIMB_DARKENED,
    SOLAR_POINT
} solar_disc_choice;

/* The Earth as a source of light. */
typedef struct earth_light {
    bool wanted;
    brdf_material *ground; /* owned; n_bands; of the sphere */
    double radius_m;
    int64_t rings; /* of nodes; 0: as the materials ask for */
    globe *source; /* owned; NULL where it is not wanted, or there is no satellite */
} earth_light;

/* How the airmass follows from the elevation. */
typedef enum airmass_choice { AIRMASS_KASTEN_YOUNG, AIRMASS_PICKERING } airmass_choice;

/* Magnitudes at 1000 km: columns that are asked for. */
enum { STANDARD_PHASE_90 = 1u, STANDARD_PHASE_0 = 2u };

/* A telescope with a camera. */
typedef struct telescope {
    double aperture_m;                      /* diameter */
    double electrons_s[SCENARIO_MAX_BANDS]; /* from a star of magnitude 0, above the atmosphere */
    double sky_mag[SCENARIO_MAX_BANDS];     /* per square arcsec */
    double pixel_rad, seeing_fwhm_rad;
    double half_width_rad; /* of the box in which light is summed, beside and beyond the trail */
    double read_noise_e, dark_current_e_s; /* per pixel */
    double scintillation;                  /* coefficient of Young's formula, m^(2/3) s^(1/2) */
    bool follows;                          /* the satellite, so that it leaves no trail */
} telescope;

typedef enum rows_choice { ROWS_ALL, ROWS_VISIBLE, ROWS_DARK_SITE } rows_choice;

enum { SHARES_MATERIAL = 1u, SHARES_COMPONENT = 2u };

enum { DEFAULT_RAYS_PER_FACET = 64 };

/* A geometry that is given, not computed: directions in the body frame. */
typedef struct geometry_table {
    double (*sun)[3], (*observer)[3]; /* owned; unit, body */
    double *range_m, *t_s;            /* owned */
    int64_t n;
} geometry_table;

/* A value that a column must have in some row. */
typedef struct expectation {
    place where;
    bool by_row; /* else by t_s */
    int64_t row;
    double t_s;
    const char *observer; /* with t_s: its name; borrowed from the document */
    const char *column;
    bool empty;                       /* the cell must be empty (from a table) */
    double value, absolute, relative; /* |got - value| <= absolute + relative |value| */
    const char *source;               /* "" where not said */
} expectation;

/* A condition on a column: lo <= value <= hi. */
typedef struct row_condition {
    const char *column;
    double lo, hi;
    place where;
} row_condition;

/* A design requirement on a column. */
typedef struct requirement {
    place where;
    const char *column;
    double fainter_than, for_fraction; /* mag; of the rows that `when` selects */
    bool has_reference;
    double reference_height_m;
    row_condition *when; /* owned */
    int n_when;
} requirement;

typedef struct expected_table {
    csv_table csv;
    place where;
    int n_columns;               /* compared columns: those with a tolerance */
    const char **columns;        /* owned array; borrowed names */
    double *absolute, *relative; /* owned */
} expected_table;

/* What observed magnitudes mean. */
typedef enum observed_kind {
    OBSERVED_APPARENT,
    OBSERVED_AT_1000_KM,       /* as if from 1000 km, at the phase angle that it was */
    OBSERVED_AT_1000_KM_90_DEG /* and as if at 90 deg, with the phase function of a Lambert sphere
                                */
} observed_kind;
extern const char *const observed_kind_names[3];

/* One observation. */
typedef struct observed_row {
    int line;              /* of the file */
    double t_s, magnitude; /* TT s from the start */
    double sigma;          /* mag; 0: not said */
    double range_m, phase; /* as the observer has them, rad; 0, -1: not said */
} observed_row;

/* An observed track. */
typedef struct observed_track {
    char *path;         /* owned */
    const char *format; /* "csv", ...: borrowed from the document */
    int observer, band; /* of the scenario's */
    observed_kind kind;
    bool fit_zero_point;
    observed_row *rows; /* owned; in the order of the file */
    size_t n;
    /* Rows that are not among them: */
    int64_t other_filter, without_magnitude, outside_time;
    double from_s, to_s; /* of what has a magnitude and the filter, also outside of the run; TT s
                            from the start; set where n + outside_time > 0 */
    char a_filter[24];   /* the first other filter, maybe cut; "" where there is none */
} observed_track;

struct glint_scenario {
    toml_document **documents; /* owned; the scenario first, then what it names */
    int n_documents;
    file_list files; /* all that it was read from: documents, and the files that they name */
    char **overrides; /* owned array of owned copies */
    size_t n_overrides;
    const char *title; /* "" where not said */
    char *text;        /* owned; the scenario's file, for the output's header */

    bool has_geometry; /* directions given: no time, site, orbit, attitude */
    geometry_table geometry;

    run_clock clock;
    double span_s; /* from start to end, TT */
    double step_s;
    int64_t n_steps;
    double exposure_s; /* light is averaged over it, centred on a row's time; 0: a sample */

    scenario_observer *observers; /* owned; in the order of the file */
    int n_observers;              /* 0 only where directions are given */

    scenario_orbit orbit;

    bool has_attitude, has_satellite; /* false only where they may be absent, and are */
    attitude_plan attitude;
    bool needs_moon; /* attitude or a hinge asks for the Moon */
    satellite satellite;
    self_shadows self_shadows;
    double shadow_step; /* rad; of SHADOWS_INTERPOLATED */
    int rays_per_facet; /* of SHADOWS_RAYS */

    int n_bands;
    const band_info *bands[SCENARIO_MAX_BANDS];
    magnitude_system systems[SCENARIO_MAX_BANDS];
    double sun_magnitude[SCENARIO_MAX_BANDS];
    solar_disc_choice solar_disc;
    earth_light earth;
    bool has_extinction;
    double extinction[SCENARIO_MAX_BANDS]; /* mag per airmass; 0 without */
    airmass_choice airmass;
    bool has_telescope;
    telescope telescope;

    bool light_time, aberration;
    double dut1_s;
    eop_table *eop;       /* owned; NULL: dut1_s throughout, and no polar motion */
    const char *eop_name; /* of its file, as written; borrowed from the document */
    place eop_where;

    rows_choice rows;
    bool moon_columns;
    double sun_elevation_max; /* rad; of a dark site */
    unsigned shares;
    unsigned standard; /* STANDARD_... */

    expectation *expectations; /* owned */
    int n_expectations;
    expected_table expected;
    bool has_expected_table;
    bool has_observed;
    observed_track observed;
    requirement *requirements; /* owned */
    int n_requirements;
};

/* Reads the model file at `path` alone, as a scenario of that satellite without anything else: for
 * reports. bands: as in the scenario. */
glint_status scenario_read_model(const char *path, const char *const *overrides, size_t n_overrides,
                                 glint_scenario **out, glint_errors *errors);
/* Reads a scenario whose surfaces are told apart, with changes of its satellite. changes: NULL:
 * none. Errors as glint_scenario_read; GLINT_ARGUMENT for changes that cannot be made. */
glint_status scenario_read_surfaces(const char *path, const char *const *overrides,
                                    size_t n_overrides, const glint_changes *changes,
                                    glint_scenario **out, glint_errors *errors);
/* True when the file holds a model, not a scenario: no [time] and no [geometry], but components or
 * materials. */
bool scenario_is_model(const toml_document *document);

#endif
