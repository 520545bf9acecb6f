/* glint.h: predicts how bright an orbiting satellite looks over time.
 *
 * The one public header. A scenario file is read and checked (glint_scenario_read), opened as a
 * light curve (glint_curve_open) and pulled block by block (glint_curve_next), or written as a
 * table in one call (glint_table_write).
 *
 * Units are SI and radians unless a name says otherwise. Every function that can fail returns a
 * glint_status; what went wrong, and in which file, line and column, is in the glint_error or the
 * glint_errors list that it was given (NULL where the caller does not want to know).
 * No function prints, exits, or keeps state between calls. Objects behind `const` may be shared by
 * threads; everything else belongs to one thread at a time.
 */
#ifndef GLINT_H
#define GLINT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------ errors */

/* What a call came to. The values are also the exit statuses of the program. */
typedef enum glint_status {
    GLINT_OK = 0,       /* done */
    GLINT_INPUT = 1,    /* the input is wrong, absent or unreadable, or an expectation failed */
    GLINT_ARGUMENT = 2, /* the call (or the command line) is wrong */
    GLINT_OUTPUT = 3,   /* the output could not be written */
    GLINT_INTERNAL = 4  /* out of memory, or a defect in glint */
} glint_status;

typedef enum glint_severity { GLINT_ERROR, GLINT_WARNING } glint_severity;

/* One error or warning. `line` and `column` count from 1; 0: the file as a whole. `file` is empty
 * where no file is to blame. Both texts are always terminated; over-long ones end in "...". */
typedef struct glint_error {
    glint_status status;
    glint_severity severity;
    int line, column;
    char file[512];
    char message[1024];
} glint_error;

/* A growing list of errors and warnings, those of a file in the order of their places. The first
 * 1000 are kept, all are counted. */
typedef struct glint_errors glint_errors;

/* A new empty list; NULL when memory is out. Every function takes a NULL list. */
glint_errors *glint_errors_new(void);
void glint_errors_free(glint_errors *errors);
/* Number of entries kept, warnings included. */
size_t glint_errors_count(const glint_errors *errors);
/* Number of errors, those that were not kept included. */
size_t glint_errors_error_count(const glint_errors *errors);
/* Entry k < count, borrowed until the list changes; NULL when k is out of range. */
const glint_error *glint_errors_get(const glint_errors *errors, size_t k);
void glint_errors_clear(glint_errors *errors);

/* ---------------------------------------------------------------- scenario */

/* A scenario, read and checked: what is looked at, from where, when, and what is wanted of it.
 * Immutable; may be shared by threads. */
typedef struct glint_scenario glint_scenario;

/* Reads a scenario file with all that it names (model, materials, element sets).
 * path: a regular file. overrides: n texts "key=value", each a dotted key and a TOML value, applied
 * before anything is checked. Errors: GLINT_INPUT; all semantic errors of a file, or its first
 * syntax error, are in the list with their places. Warnings may be in the list on success. */
glint_status glint_scenario_read(const char *path, const char *const *overrides, size_t n_overrides,
                                 glint_scenario **out, glint_errors *errors);
/* The same where the attitude and the satellite may be absent, for passes and ephemerides: what
 * depends on them is then left out of those. */
glint_status glint_scenario_read_orbit(const char *path, const char *const *overrides,
                                       size_t n_overrides, glint_scenario **out,
                                       glint_errors *errors);
void glint_scenario_free(glint_scenario *scenario);
/* True when a path names a file that the scenario was read from (itself, models, materials,
 * expected values, observations): nothing should be written there. */
bool glint_scenario_reads(const glint_scenario *scenario, const char *path);

/* ------------------------------------------------------------- light curve */

/* Why a row is faint or dark; any number of them. */
typedef enum glint_flag {
    GLINT_BELOW_HORIZON = 1u << 0, /* elevation below min_elevation_deg or the site's mask */
    GLINT_UMBRA = 1u << 1,         /* no part of the Sun is seen from the satellite */
    GLINT_PENUMBRA = 1u << 2,      /* some part of it */
    GLINT_DARK = 1u << 3,          /* nothing lit is seen, though neither of the above says why */
    GLINT_SITE_DARK = 1u << 4,     /* the Sun is below sun_elevation_max_deg at the site */
    GLINT_BLOCKED = 1u << 5,    /* the Earth stands between a satellite that looks and this one */
    GLINT_MOON_SHADOW = 1u << 6 /* the Moon covers some part of the Sun, or all of it */
} glint_flag;

/* A moment of UTC; `second` may reach 60 in a leap second. microsecond: 0..999999. */
typedef struct glint_utc {
    int year, month, day, hour, minute, second, microsecond;
} glint_utc;

/* One step of a light curve. Angles in rad, lengths in m. Site fields, from azimuth to airmass and
 * those of the Moon's place, are 0 where the observer is not a site; those of the Moon where
 * [output] moon does not ask for them. */
typedef struct glint_row {
    glint_utc utc;             /* of reception at the observer; not set in [geometry] runs */
    double t_s;                /* TT seconds from the start of the scenario */
    double range_m;            /* observer to satellite, along the light path */
    double phase_angle_rad;    /* at the satellite, between Sun and observer */
    double sunlit_fraction;    /* visible part of the solar disc */
    double azimuth_rad;        /* from north through east */
    double elevation_rad;      /* geometric, or apparent where the site has refraction */
    double sun_elevation_rad;  /* topocentric, geometric */
    double airmass;            /* 0 below the horizon */
    double height_m;           /* geodetic, of the satellite; 0 where nothing asks for it */
    double angular_rate_rad_s; /* against the stars; 0 where nothing asks for it */
    double site_height_m;      /* of the observer above the ellipsoid; 0 where it is no site */
    double moon_azimuth_rad, moon_elevation_rad; /* topocentric, geometric */
    double moon_separation_rad;                  /* between satellite and Moon, from the observer */
    double moon_illuminated;                     /* fraction of the Moon's disc */
    unsigned flags;                              /* glint_flag */
    bool has_site;                               /* the observer is a site */
    const char *observer;          /* its name, "" where not said; borrowed from the scenario */
    const double *flux_ratio;      /* n_bands: irradiance at the observer over the Sun's at 1 au */
    const double *magnitude;       /* n_bands; only where flux_ratio > 0, else 0 */
    const double *share_material;  /* n_materials, of the first band's flux; all 0 when dark */
    const double *share_component; /* n_components */
    const double *share_surface;   /* n_surfaces of glint_shares; NULL in other runs */
    const double *earthshine_flux_ratio; /* n_bands: the part of flux_ratio that came by way of the
                                            Earth; NULL where the scenario asks for no earthshine */
} glint_row;

/* An output column. */
typedef struct glint_column {
    const char *name, *unit,
        *description; /* borrowed from the curve; unit "" where there is none */
    bool is_text;
} glint_column;

/* A light curve that is being computed: blocks of rows, for each observer in order of time, in
 * constant memory. */
typedef struct glint_curve glint_curve;

/* Prepares a run. threads: 0 for all processors. The scenario must outlive the curve. Errors:
 * GLINT_INPUT (an orbit that cannot be propagated, ...), GLINT_INTERNAL. */
glint_status glint_curve_open(const glint_scenario *scenario, int threads, glint_curve **out,
                              glint_errors *errors);
void glint_curve_close(glint_curve *curve);
/* Number of observers. The rows of the first come first, in order of time, then those of the
 * next. */
size_t glint_curve_observers(const glint_curve *curve);
/* Number of rows of the whole run, before [output] rows chooses among them. */
int64_t glint_curve_length(const glint_curve *curve);

/* The next block: *rows points at *n rows, borrowed until the next call; *n = 0 at the end. Rows
 * that [output] rows leaves out are not among them. Errors: GLINT_INPUT where the orbit fails at
 * some time (decayed, ...); GLINT_INTERNAL. */
glint_status glint_curve_next(glint_curve *curve, const glint_row **rows, size_t *n,
                              glint_error *error);

/* Rows computed so far. */
int64_t glint_curve_done(const glint_curve *curve);
/* Number of threads that it computes with. */
int glint_curve_threads(const glint_curve *curve);
/* Measured material k from 0 of those whose table does not cover the hemisphere, and in how many of
 * the rows handed out so far some facet of it was lit and seen at angles between which nothing was
 * measured: the nearest measured values were taken there. False past the end. *material borrowed.
 */
bool glint_curve_unmeasured(const glint_curve *curve, size_t k, const char **material,
                            int64_t *rows);
/* Name of the first band, "V". Borrowed. */
const char *glint_curve_band(const glint_curve *curve);
/* Time between rows in s; 0 where the scenario gives directions instead of times. */
double glint_curve_step_s(const glint_curve *curve);

/* What the header of a table says about the run: fact k from 0, "zero_point_V" and "-26.76 (...)";
 * false past the end. Texts borrowed. */
bool glint_curve_fact(const glint_curve *curve, size_t k, const char **key, const char **value);
/* True when a path names a file that the run was read from: nothing should be written there. */
bool glint_curve_reads(const glint_curve *curve, const char *path);
/* The scenario's file, as read. */
const char *glint_curve_scenario(const glint_curve *curve);

/* The columns of the table, in order. */
const glint_column *glint_curve_columns(const glint_curve *curve, size_t *n);
/* Room that glint_curve_text needs. */
enum { GLINT_CELL_SIZE = 96 };
/* The number in a cell; false when the cell is empty, or a text. */
bool glint_curve_value(const glint_curve *curve, const glint_row *row, size_t column,
                       double *value);
/* The cell as it stands in the table, terminated; returns its length. */
size_t glint_curve_text(const glint_curve *curve, const glint_row *row, size_t column,
                        char text[GLINT_CELL_SIZE]);

/* ------------------------------------------------------------------- table */

/* What a run came to, of the rows that are in the table. Times in s: each row stands for half a
 * step before it and half a step after it, within the run. */
typedef struct glint_summary {
    int64_t rows;                                          /* in the table */
    int64_t bright_rows;                                   /* with a magnitude in the first band */
    double magnitude_min, magnitude_median, magnitude_max; /* of those; the median to 0.001 mag */
    double percent_brighter_6, percent_brighter_7;         /* of those; first band */
    double sunlit_s, visible_s; /* sunlit_fraction > 0; that, and above the horizon */
    double brightest_t_s;       /* of the brightest row */
    const char
        *brightest_observer; /* the name of the one who sees it; borrowed from the scenario */
    glint_utc brightest_utc; /* not set in [geometry] runs */
    bool has_utc;
    size_t n_observers; /* of the run */
    const char *band;   /* the first, borrowed from the curve */
} glint_summary;

/* Called after each block with the number of steps done; return false to stop the run, which then
 * fails with GLINT_OUTPUT. */
typedef bool glint_progress(void *context, int64_t done, int64_t all);

/* Writes the whole curve as a table with an ECSV header. path: NULL for standard output; a regular
 * file appears whole or not at all (written beside, synced, renamed); a pipe or device is written
 * to. picture: a file for magnitudes and shares over time, as glint_plot_check takes it, written
 * after the table; NULL for none. summary, progress: NULL allowed. Errors: GLINT_OUTPUT,
 * GLINT_INPUT, GLINT_INTERNAL; GLINT_ARGUMENT for the picture's name. */
glint_status glint_table_write(glint_curve *curve, const char *path, const char *picture,
                               glint_summary *summary, glint_progress *progress, void *context,
                               glint_error *error);

/* ------------------------------------------------------------------- passes */

/* What happens during a pass. */
typedef enum glint_event_kind {
    GLINT_RISE,              /* above min_elevation_deg from here on */
    GLINT_CULMINATION,       /* highest */
    GLINT_SET,               /* below min_elevation_deg from here on */
    GLINT_UMBRA_END,         /* the first of the Sun is seen from the satellite */
    GLINT_PENUMBRA_END,      /* all of it */
    GLINT_PENUMBRA_BEGIN,    /* no longer all of it */
    GLINT_UMBRA_BEGIN,       /* nothing of it */
    GLINT_MOON_SHADOW_BEGIN, /* the Moon begins to cover what is seen of it */
    GLINT_MOON_SHADOW_END,   /* the Moon leaves it */
    GLINT_DARKNESS_BEGIN,    /* the Sun sets below sun_elevation_max_deg at the site */
    GLINT_DARKNESS_END,
    GLINT_BRIGHTEST, /* smallest magnitude in the first band */
    GLINT_FLASH,     /* a flat surface mirrors the Sun towards the observer, as nearly as it will */
    GLINT_MORE_FLASHES /* from here on flashes are left out: see more_flashes */
} glint_event_kind;

/* One event, as seen from the site. Angles in rad, lengths in m. */
typedef struct glint_pass_event {
    glint_event_kind kind;
    double t_s; /* TT seconds from the start of the scenario, reception */
    glint_utc utc;
    double azimuth_rad, elevation_rad, range_m;
    double sun_elevation_rad; /* at the site */
    double phase_angle_rad;
    double sunlit_fraction;
    bool site_dark; /* the Sun is below sun_elevation_max_deg */
    bool has_magnitude;
    double magnitude; /* in the first band; where there is one */
    /* Of a flash: */
    double from_s, to_s;     /* while the mirror angle is within the limit */
    double mirror_angle_rad; /* between the observer and where the surface mirrors the Sun to */
    const char *component;   /* borrowed from the scenario; NULL for other events */
    double normal[3];        /* of the surface, unit, in the component's axes */
} glint_pass_event;

/* One pass over a site. */
typedef struct glint_pass {
    const char *site;            /* its name, "" where not said; borrowed from the scenario */
    double from_s, to_s;         /* rise and set, or where the time span cuts the pass off */
    bool up_at_start, up_at_end; /* it is cut off: there is no rise, no set */
    bool has_magnitudes;         /* attitude and satellite are known: brightness was looked for */
    bool more_flashes;           /* flashes are left out, from the time of an event of their own on:
                                  * there are more than 1000, or they take too long to find */
    double sunlit_s;             /* time with some sunlight on the satellite */
    double dark_site_s;          /* of that, while the site is dark */
    const glint_pass_event *events; /* in order of time */
    size_t n_events;
} glint_pass;

/* Limits of the largest mirror angle of a flash, deg. */
#define GLINT_FLASH_ANGLE_MIN_DEG 1e-3
#define GLINT_FLASH_ANGLE_MAX_DEG 90.0

/* What is looked for; zero-initialise for what is usual. */
typedef struct glint_pass_options {
    double flash_angle_rad; /* largest mirror angle of a flash, within these limits; 0: 1 deg */
    int threads;            /* 0: all processors */
} glint_pass_options;

/* All passes of a satellite over the sites of a scenario within its time span: site by site in the
 * order of the file, and in order of time over each. */
typedef struct glint_passes glint_passes;

/* Whether a scenario can have passes, before any are looked for. Errors: GLINT_INPUT (directions
 * are given instead of an orbit; no observer is a site). */
glint_status glint_passes_check(const glint_scenario *scenario, glint_error *error);
/* Finds them. scenario: must outlive *out; of glint_scenario_read_orbit, or glint_scenario_read.
 * options: NULL for what is usual. Rise, set and the Earth's shadow are found as roots, to 1e-6 s;
 * [time] step_s plays no part. Observers that are no sites are passed over. Errors: those of
 * glint_passes_check; GLINT_INPUT (the orbit fails at some time), GLINT_ARGUMENT, GLINT_INTERNAL.
 */
glint_status glint_passes_find(const glint_scenario *scenario, const glint_pass_options *options,
                               glint_passes **out, glint_error *error);
void glint_passes_free(glint_passes *passes);
size_t glint_passes_count(const glint_passes *passes);
/* Pass k from 0, borrowed; NULL past the end. */
const glint_pass *glint_passes_get(const glint_passes *passes, size_t k);
/* Name of the band of the magnitudes, and of the satellite; "" where not said. Borrowed. */
const char *glint_passes_band(const glint_passes *passes);
const char *glint_passes_satellite(const glint_passes *passes);
/* Fact k from 0 of the run, or of the orbit where there is no satellite: as of glint_curve_fact. */
bool glint_passes_fact(const glint_passes *passes, size_t k, const char **key, const char **value);
/* True when a path names a file that the scenario was read from: nothing should be written there.
 */
bool glint_passes_reads(const glint_passes *passes, const char *path);
/* "rise", "culmination", "set", "umbra-end", ...; NULL for no such kind. */
const char *glint_event_name(glint_event_kind kind);
/* The nearest of the 16 points of the compass, "NNE". azimuth: rad, finite. */
const char *glint_compass_point(double azimuth_rad);

/* Ways to write tables. */
typedef enum glint_format {
    GLINT_FORMAT_TABLE, /* for people */
    GLINT_FORMAT_CSV,   /* one line for each event, with an ECSV header */
    GLINT_FORMAT_JSON
} glint_format;

/* Writes the passes of n scenarios merged in order of time. path: as of glint_table_write. Errors:
 * GLINT_OUTPUT, also where a scenario was read from that file; GLINT_INTERNAL. */
glint_status glint_passes_write(const glint_passes *const *passes, size_t n, glint_format format,
                                const char *path, glint_error *error);

/* ---------------------------------------------------------------- ephemeris */

/* Where everything is at one step of a scenario. Positions and velocities are those at which the
 * light left the satellite; angles in rad, SI. */
typedef struct glint_ephemeris_row {
    double t_s; /* TT seconds from the start, of reception */
    glint_utc utc;
    size_t observer;           /* its number in the scenario, from 0 */
    const char *observer_name; /* borrowed from the scenario; "" where not said */
    double ra_rad,
        dec_rad;               /* from the observer along the light path, ICRS axes; 0..2 pi,
                                  -pi/2..pi/2.    Stars are displaced by annual aberration against it */
    double angular_rate_rad_s; /* against the stars */
    double azimuth_rad, elevation_rad; /* of a site, as glint_row has them; else 0 */
    double range_m, range_rate_m_s;
    double sun_elevation_rad;                       /* of a site; else 0 */
    double sun_separation_rad, moon_separation_rad; /* from the observer */
    double phase_angle_rad, sunlit_fraction;        /* at the satellite */
    double beta_rad; /* of the Sun above the plane of the orbit, positive towards r x v */
    double r_gcrs_m[3], v_gcrs_m_s[3];
    double r_itrs_m[3], v_itrs_m_s[3];            /* velocity against the turning Earth */
    double r_teme_m[3], v_teme_m_s[3];            /* of element sets; else 0 */
    double latitude_rad, longitude_rad, height_m; /* geodetic: below the satellite, and how high */
    double quaternion_wxyz[4]; /* turns body axes into GCRS; 0 without an attitude */
    const double *hinge_rad;   /* of each component that has a hinge, in the order of the model */
} glint_ephemeris_row;

/* An ephemeris that is being computed: blocks of rows, for each observer in order of time, in
 * constant memory. */
typedef struct glint_ephemeris glint_ephemeris;

/* Prepares one. scenario: must outlive it; of glint_scenario_read_orbit, or glint_scenario_read.
 * threads: 0 for all processors. Errors: GLINT_INPUT (directions are given instead of an orbit),
 * GLINT_ARGUMENT, GLINT_INTERNAL. */
glint_status glint_ephemeris_open(const glint_scenario *scenario, int threads,
                                  glint_ephemeris **out, glint_error *error);
void glint_ephemeris_close(glint_ephemeris *ephemeris);
/* The next block: *rows points at *n rows, borrowed until the next call; *n = 0 at the end. Errors:
 * GLINT_INPUT where orbit or attitude fail at some time; GLINT_INTERNAL. */
glint_status glint_ephemeris_next(glint_ephemeris *ephemeris, const glint_ephemeris_row **rows,
                                  size_t *n, glint_error *error);
/* Number of rows of the whole, and of those done: the steps of the first observer, then those of
 * the next. */
int64_t glint_ephemeris_length(const glint_ephemeris *ephemeris);
int64_t glint_ephemeris_done(const glint_ephemeris *ephemeris);
/* The columns of its table: what the scenario does not have (TEME, attitude, hinges) is not there.
 */
const glint_column *glint_ephemeris_columns(const glint_ephemeris *ephemeris, size_t *n);
/* The number in a cell; false where it is a text (utc and observer), or empty for this observer. */
bool glint_ephemeris_value(const glint_ephemeris *ephemeris, const glint_ephemeris_row *row,
                           size_t column, double *value);
/* What the header of its table says: fact k from 0; false past the end. Texts borrowed. */
bool glint_ephemeris_fact(const glint_ephemeris *ephemeris, size_t k, const char **key,
                          const char **value);
/* True when a path names a file that the scenario was read from: nothing should be written there.
 */
bool glint_ephemeris_reads(const glint_ephemeris *ephemeris, const char *path);
/* Writes all of it. path, progress: as of glint_table_write. Errors: those of glint_ephemeris_next;
 * GLINT_OUTPUT, also where the scenario was read from that file. */
glint_status glint_ephemeris_write(glint_ephemeris *ephemeris, glint_format format,
                                   const char *path, glint_progress *progress, void *context,
                                   glint_error *error);

/* ---------------------------------------------------------------- pictures */

/* Whether a picture can be drawn into a file: its name ends in .svg, .png or .pdf, gnuplot (a
 * program of its own) is found on PATH, and the file can be written. Pictures appear whole or not
 * at all. table: the file that a table is to go to at the same time; NULL: none, or standard
 * output. Errors: GLINT_ARGUMENT for another name, and where the table goes to the same file,
 * though it be spelled in another way or reached through links; GLINT_OUTPUT. */
glint_status glint_plot_check(const char *path, const char *table, glint_error *error);

/* ------------------------------------------------------------------- views */

/* The satellite as it looks at one moment: what is seen of every facet as polygons, lit and in
 * shadow apart, exactly. Immutable; may be shared by threads. */
typedef struct glint_view glint_view;

/* From where it is looked at. */
typedef enum glint_view_from {
    GLINT_FROM_OBSERVER, /* of the scenario */
    GLINT_FROM_SUN,
    GLINT_FROM_DIRECTION /* given in the body frame */
} glint_view_from;

/* What is looked at; zero-initialise for what is usual. */
typedef struct glint_view_options {
    const char *at; /* UTC as scenarios write it, or s from the start; where directions are given
                       the number of a row, from 0. NULL: the start. Not of a model. Borrowed */
    glint_view_from from; /* a model is looked at from a direction */
    double from_body[3];  /* towards the viewer, any length; GLINT_FROM_DIRECTION */
    bool has_sun;         /* of a model: */
    double sun_body[3];   /* towards the Sun, any length */
} glint_view_options;

/* How a piece of a facet is lit. */
typedef enum glint_view_light {
    GLINT_PIECE_LIT,
    GLINT_PIECE_SHADOWED,    /* turned to the Sun, but something is before it */
    GLINT_PIECE_TURNED_AWAY, /* from the Sun; everything in the Earth's umbra */
    GLINT_PIECE_BACK         /* of a facet without a back material: black */
} glint_view_light;

/* A convex piece of a facet that is seen. Points and lengths in the picture's axes, m: x to the
 * right, y up, z to the viewer; the body's origin is 0. */
typedef struct glint_view_piece {
    const double (*points)[3]; /* borrowed; anticlockwise */
    size_t n_points;
    double projected_m2;     /* area in the picture */
    int facet;               /* index; pieces of a facet follow each other */
    int component, material; /* indices; material -1: a back that has none */
    glint_view_light light;
    double facing;          /* cosine between the viewer and the normal of the side that is seen */
    double radiance_factor; /* radiance towards the viewer over that of a white Lambert plate that
                               faces the whole Sun; 0 unless lit */
} glint_view_piece;

/* A part of an edge that is seen, in the same axes. */
typedef struct glint_view_edge {
    double from_m[3], to_m[3];
    bool is_outline; /* beyond it the surface ends, or turns out of sight */
    bool is_smooth;  /* it lies within one flat surface, or one curved one */
    bool parts_materials;
    double turn_rad; /* between the facets on both sides; 0 at an end */
} glint_view_edge;

/* What there is to say of the view. Directions are unit vectors in the picture's axes. */
typedef struct glint_view_scene {
    const char *title, *band; /* borrowed; title "" where not said; the first band */
    glint_view_from from;
    bool is_model; /* no scenario, so no time */
    bool has_utc;  /* else the scenario gives directions, and there is a row */
    glint_utc utc;
    double t_s;
    int64_t row;
    bool north_up; /* the picture's y is celestial north, x west; else body z is up (body y
                      along z) */
    double sun[3], body_axes[3][3];
    double phase_angle_rad;
    bool has_range; /* from the observer */
    double range_m;
    double sunlit_fraction;
    bool below_horizon;
    bool has_magnitude;      /* from the observer, where it is bright */
    double magnitude;        /* in the first band */
    bool has_shadows;        /* false: self_shadows = "none" */
    bool hinges_held;        /* of a model: some hinge that would move stands at angle 0 */
    double lo_m[2], hi_m[2]; /* what the pieces fill; x, y */
    double brightest;        /* greatest radiance factor */
} glint_view_scene;

/* Reads a scenario or a model file and looks at it. overrides: as of glint_scenario_read. options:
 * NULL for what is usual. Hinges of a model that track the Sun or the observer do so, others stand
 * at their fixed angle, or at 0. Errors: GLINT_INPUT, those of reading and of the orbit;
 * GLINT_ARGUMENT: `at` is no time, or outside of the scenario's; a direction of length 0; what does
 * not go with a model or a scenario. Warnings may be in the list on success. */
glint_status glint_view_read(const char *path, const char *const *overrides, size_t n_overrides,
                             const glint_view_options *options, glint_view **out,
                             glint_errors *errors);
void glint_view_free(glint_view *view);

const glint_view_scene *glint_view_describe(const glint_view *view);
/* Pieces, in the order of facets; edges. Borrowed. */
const glint_view_piece *glint_view_pieces(const glint_view *view, size_t *n);
const glint_view_edge *glint_view_edges(const glint_view *view, size_t *n);
/* Names by index; NULL past the end. Borrowed. */
const char *glint_view_material(const glint_view *view, size_t k);
const char *glint_view_component(const glint_view *view, size_t k);

/* What the colours of a picture stand for. */
typedef enum glint_view_colour {
    GLINT_COLOUR_BRIGHTNESS, /* the radiance factor */
    GLINT_COLOUR_MATERIAL,
    GLINT_COLOUR_LIGHT /* lit, in shadow, turned away */
} glint_view_colour;

enum { GLINT_VIEW_LEAST_SIZE = 200, GLINT_VIEW_MOST_SIZE = 8192 };

/* How a view is drawn; zero-initialise for what is usual. */
typedef struct glint_view_style {
    glint_view_colour colour;
    bool logarithmic;   /* scale of the brightness */
    const char *format; /* "svg", "png" or "pdf"; NULL: as the file's name ends. Borrowed */
    int width, height;  /* px, GLINT_VIEW_LEAST_SIZE to GLINT_VIEW_MOST_SIZE; of .svg and .pdf in
                          units of 1/96 inch; 0: 1200 x 900 */
} glint_view_style;

/* Whether a view can be drawn so: the name of the file ends in .svg, .png or .pdf, or the style has
 * a format; and the size is in range. Errors: GLINT_ARGUMENT. */
glint_status glint_view_draw_check(const glint_view_style *style, const char *path,
                                   glint_error *error);
/* Draws it. path: as of glint_table_write. style: NULL for what is usual. The same view gives the
 * same bytes in every run of a program. Errors: those of glint_view_draw_check; GLINT_OUTPUT;
 * GLINT_INTERNAL. */
glint_status glint_view_draw(const glint_view *view, const glint_view_style *style,
                             const char *path, glint_error *error);

/* ------------------------------------------------------------ check, verify */

/* Reads a scenario or a model file and describes it: areas, materials, times, element set age, what
 * would run, what is neglected. *report: a new text, free it with glint_free. Errors as
 * glint_scenario_read. */
glint_status glint_check(const char *path, const char *const *overrides, size_t n_overrides,
                         char **report, glint_errors *errors);

/* What a verification found. */
typedef struct glint_verdict {
    int64_t expectations; /* values and requirements compared */
    int64_t deviations;   /* of these, not met */
    char *requirements; /* for each [[require]] that selects rows a line that says how it fares and
                           with what margin; NULL without; free it with glint_free */
} glint_verdict;

/* Runs a scenario and holds it against its [[expect]], [expect_table] and [[require]]. Every
 * deviation is an error in the list, at the place of the expectation, and makes the result
 * GLINT_INPUT; so is a scenario that expects nothing. verdict: NULL allowed. */
glint_status glint_verify(const char *path, const char *const *overrides, size_t n_overrides,
                          int threads, glint_verdict *verdict, glint_errors *errors);

/* ------------------------------------------------------------------- shares */

/* Changes of a satellite, to see what a part of it does. Zero-initialise for none. Texts borrowed.
 */
typedef struct glint_changes {
    const char *const *swaps; /* "A=B": material B in place of A, in all components; "bus/A=B": in
                                 that component alone, which then wins. All are made at once */
    size_t n_swaps;
    const char *const *without; /* names of components that are taken away, with their shadows; what
                                   hangs on them stays where it is */
    size_t n_without;
} glint_changes;

/* What gives the light: the shares of materials, components and surfaces over a run. */
typedef struct glint_shares glint_shares;

typedef enum glint_share_kind {
    GLINT_SHARE_MATERIAL,
    GLINT_SHARE_COMPONENT, /* its own facets, not those of its children */
    GLINT_SHARE_SURFACE    /* of one material in one component, facing one way */
} glint_share_kind;

/* One of them, in the first band, over the rows with any light. All shares are 0 and magnitudes 0
 * where there is no such row. Texts are borrowed. */
typedef struct glint_share {
    glint_share_kind kind;
    const char *name;      /* of a surface "component/material/facing" */
    const char *component; /* of a component or a surface; else "" */
    const char *material;  /* of a material or a surface; else "" */
    const char *facing;    /* of a surface: "+x", "(0.6, 0, 0.8)", "round"; else "" */
    double area_m2;
    double share_mean;        /* part of all light of the rows: sum of fluxes over sum of fluxes */
    double share_peak;        /* part of the light at the brightest row */
    double dominant_fraction; /* part of the rows in which it is the largest of its kind; the first
                                 of equals */
    int64_t rows;             /* with any light of it */
    double magnitude_mean;    /* mean over those rows of the magnitude that it has alone */
} glint_share;

/* What a whole run came to. */
typedef struct glint_shares_total {
    int64_t rows, bright_rows;               /* of the run; with any light */
    double magnitude_mean, magnitude_median; /* of those */
    double magnitude_peak;                   /* the brightest */
    double peak_t_s;
    glint_utc peak_utc; /* not set in [geometry] runs */
    bool has_utc;
    const char *band; /* the first; borrowed */
} glint_shares_total;

/* Magnitudes of the changed satellite less those of the one in the file. */
typedef struct glint_shares_change {
    int64_t rows;         /* in which both have light */
    int64_t lost, gained; /* rows in which only the one in the file has, only the changed one */
    double mean, median, min, max; /* mag; over those rows */
    bool has_peak;                 /* both have light at the brightest row of the one in the file */
    double at_peak;                /* mag, there */
    double peak;                   /* mag: brightest of the one, less brightest of the other */
} glint_shares_change;

/* Runs a scenario, and once more with the changes where there are any. changes: NULL: none.
 * threads: 0 for all processors. progress: as of glint_table_write, NULL allowed. Errors: as
 * glint_scenario_read and glint_curve_next; GLINT_ARGUMENT for changes that cannot be made. */
glint_status glint_shares_find(const char *path, const char *const *overrides, size_t n_overrides,
                               const glint_changes *changes, int threads, glint_progress *progress,
                               void *context, glint_shares **out, glint_errors *errors);
void glint_shares_free(glint_shares *shares);
/* Share k from 0 of a kind, in the order of the files; false past the end. changed: of the changed
 * satellite (false without changes). Surfaces are the same in both, in the same order: of those
 * taken away the area is 0. */
bool glint_shares_get(const glint_shares *shares, bool changed, glint_share_kind kind, size_t k,
                      glint_share *out);
/* The whole; false where changed and there are no changes. */
bool glint_shares_whole(const glint_shares *shares, bool changed, glint_shares_total *out);
/* What the changes did; false without changes. */
bool glint_shares_difference(const glint_shares *shares, glint_shares_change *out);
/* Fact k from 0 of the run, and each change under "swap" or "without": as of glint_curve_fact. */
bool glint_shares_fact(const glint_shares *shares, size_t k, const char **key, const char **value);
/* The scenario that was run, or that with the changes: NULL without changes. Borrowed. */
const glint_scenario *glint_shares_scenario(const glint_shares *shares, bool changed);
/* Writes them as a table. path: as of glint_table_write. Errors: GLINT_OUTPUT, GLINT_INTERNAL. */
glint_status glint_shares_write(const glint_shares *shares, glint_format format, const char *path,
                                glint_error *error);
/* Draws the magnitudes over time and the shares below them, piled up, of the changed satellite
 * where there are changes; runs the curve again for it. path: as glint_plot_check takes it. Errors:
 * the same; of glint_curve_next. */
glint_status glint_shares_plot(const glint_shares *shares, int threads, const char *path,
                               glint_error *error);

/* ----------------------------------------------------------------- compare */

/* A prediction beside an observed track. */
typedef struct glint_comparison glint_comparison;

typedef enum glint_observation_state {
    GLINT_COMPARED,
    GLINT_PREDICTED_ECLIPSED, /* in the Earth's umbra: no light is predicted */
    GLINT_PREDICTED_NOT_SEEN, /* below the horizon, or behind the Earth */
    GLINT_PREDICTED_DARK      /* nothing lit is seen */
} glint_observation_state;

/* One observation; mag, m, rad. */
typedef struct glint_observation {
    int line; /* of its file */
    glint_utc utc;
    double t_s; /* TT seconds from the start */
    glint_observation_state state;
    double observed, sigma;     /* as in the file; sigma 0 where not said */
    double predicted, residual; /* of the same kind of magnitude, without the fitted zero point;
                                   observed - predicted - zero point. Where compared, else 0 */
    double range_m, phase_rad, elevation_rad, sunlit_fraction; /* as predicted */
    double observed_range_m, observed_phase_rad; /* as in the file; 0 and -1 where not said */
} glint_observation;

/* What a comparison came to; mag. Numbers are 0 where nothing was compared. */
typedef struct glint_comparison_summary {
    int64_t observations; /* in the file */
    int64_t compared;     /* of these; all others are counted below */
    int64_t eclipsed, not_seen, dark;
    int64_t outside_time, other_filter, without_magnitude;
    int64_t penumbra;        /* compared, but in the penumbra */
    bool fitted;             /* a zero point was fitted */
    double zero_point;       /* that is added to the prediction: the mean of observed - predicted,
                                weighted with 1/sigma^2 where every row has one; 0 without a fit */
    double zero_point_sigma; /* its standard error, from the scatter or the sigmas */
    double mean, scatter;    /* of the residuals; standard deviation about the mean, of n */
    double rms;              /* root of the mean square of the residuals */
    double largest;          /* residual of the largest size */
    bool has_r;              /* there are two rows, and neither series is constant */
    double r;                /* Pearson's correlation of observed and predicted */
    int64_t with_sigma;
    double chi2;            /* sum of (residual / sigma)^2 over the rows with a sigma */
    int64_t freedom;        /* its degrees of freedom: with_sigma, less 1 with a fit */
    bool has_chi2_relative; /* all observed magnitudes are above 0 */
    double chi2_relative;   /* mean of residual^2 / observed, as of Fankhauser et al. 2023 */
    int64_t with_range, with_phase;        /* observations that say so */
    double range_mean_m, range_most_m;     /* observed - predicted, of those; largest size */
    double phase_mean_rad, phase_most_rad; /* the same */
    const char *title, *band, *kind, *format, *file; /* borrowed from the scenario */
} glint_comparison_summary;

/* Compares. scenario: with [observed]; must outlive *out. threads: 0 for all processors; numbers
 * are the same on any number. Errors: GLINT_INPUT (no [observed]; directions are given; the orbit
 * fails at some time), GLINT_ARGUMENT (threads), GLINT_INTERNAL. */
glint_status glint_compare(const glint_scenario *scenario, int threads, glint_comparison **out,
                           glint_error *error);
void glint_comparison_free(glint_comparison *comparison);
/* Observation k from 0, of those within [time] and with a magnitude, in the order of the file;
 * false past the end. */
bool glint_comparison_get(const glint_comparison *comparison, size_t k, glint_observation *out);
void glint_comparison_total(const glint_comparison *comparison, glint_comparison_summary *out);
/* Fact k from 0 of the run, as of glint_curve_fact. */
bool glint_comparison_fact(const glint_comparison *comparison, size_t k, const char **key,
                           const char **value);
/* Predicts between the observations. t_s: n moments, TT s from the start, each not before the last,
 * within the scenario's time. predicted: n; magnitudes as glint_observation has them, HUGE_VAL
 * where nothing is seen. Errors: those of glint_compare; GLINT_ARGUMENT for other moments. */
glint_status glint_comparison_predict(const glint_comparison *comparison, const double *t_s,
                                      size_t n, int threads, double *predicted, glint_error *error);
/* Writes it as a table; path: as of glint_table_write. Errors: GLINT_OUTPUT, GLINT_INTERNAL. */
glint_status glint_comparison_write(const glint_comparison *comparison, glint_format format,
                                    const char *path, glint_error *error);
/* Draws it, with the curve predicted between observations. path: as glint_plot_check takes it.
 * Errors: the same; those of glint_comparison_predict; GLINT_INPUT where there is nothing to draw.
 */
glint_status glint_comparison_plot(const glint_comparison *comparison, int threads,
                                   const char *path, glint_error *error);
/* "compared", "eclipsed", "not-seen", "dark". */
const char *glint_observation_state_name(glint_observation_state state);

/* -------------------------------------------------------------------- BRDFs */

/* A parameter of a BRDF model. */
typedef struct glint_brdf_param {
    const char *name, *unit, *doc;
    double min, max;         /* may be infinite */
    bool min_open, max_open; /* that end does not belong to the range */
    double default_value;    /* where not required */
    bool required;
    int dimensions; /* 0: a number; 2: rows of numbers, each in the range */
} glint_brdf_param;

/* Model k of the table, counted from 0: its name, one line about it, its source; NULL past the end.
 */
const char *glint_brdf_name(size_t k);
const char *glint_brdf_doc(size_t k);
const char *glint_brdf_source(size_t k);
/* Parameter j of model k; false past the end. */
bool glint_brdf_parameter(size_t k, size_t j, glint_brdf_param *out);

/* Whether glint_brdf_fit takes model k: it has values everywhere, and numbers alone as parameters.
 */
bool glint_brdf_can_be_fitted(size_t k);

/* How a file of measured BRDF values is laid out: rows of numbers, parted by commas, semicolons or
 * blanks; lines that begin with # are skipped. Zero-initialise for what is usual. */
typedef struct glint_brdf_layout {
    /* The columns, "theta_i=1,phi_i=2,theta_r=3,phi_r=4,f=5": of each quantity the number, from 1,
     * or the name in the header line. theta is the angle from the normal, phi the azimuth, i stands
     * for the light, r for the observer. Without phi_i that azimuth is 0, without phi_r it is phi_i
     * + 180 deg. NULL: the columns bear these names. Borrowed. */
    const char *columns;
    bool signed_zenith; /* theta may be negative, which means the opposite azimuth */
    bool radians;       /* angles in rad instead of deg */
    bool unit_given;    /* deg are meant where radians is false, also if they look like rad: none
                           from the normal above pi/2 and no azimuth above 2 pi */
    double floor;       /* 1/sr; rows with f at or below it are left out */
} glint_brdf_layout;

/* Zero-initialise for what is usual. */
typedef struct glint_brdf_fit_options {
    double max_zenith_rad; /* measurements nearer to grazing are left out; 0: 85 deg */
    bool anisotropic;      /* fit the slopes along and across the tangent apart */
} glint_brdf_fit_options;

/* Fits of several models to the same measurements, the best first. */
typedef struct glint_brdf_fits glint_brdf_fits;

/* Fits models to a file of measurements: least squares in ln f, every measurement with the same
 * weight; parameters within their ranges; many starting points, the same every time.
 * layout, options: NULL for what is usual. models: sums with commas between them, each of terms
 * NAME or N*NAME, as in "ward,abg,lambert+2*ward-gmd". Of the terms that are diffuse, or have a
 * diffuse part, only one may be: the others' is 0. Parameters that have a default keep it.
 * A model with more parameters than there are measurements is left out with a warning; so are
 * warnings materials that reflect more than they get.
 * Errors: GLINT_ARGUMENT (models, columns), GLINT_INPUT (the file), GLINT_INTERNAL. */
glint_status glint_brdf_fit(const char *path, const glint_brdf_layout *layout, const char *models,
                            const glint_brdf_fit_options *options, glint_brdf_fits **out,
                            glint_errors *errors);
void glint_brdf_fits_free(glint_brdf_fits *fits);

/* What a fit came to. Texts are borrowed. */
typedef struct glint_brdf_fit_info {
    const char *model;     /* as glint_brdf_fit takes it */
    const char *material;  /* name of its table in glint_brdf_fits_toml */
    size_t n_rows, n_dark; /* in the file; of these, at or below the floor */
    size_t n_points;       /* that were fitted to */
    size_t n_free;         /* parameters that were fitted */
    double max_zenith_rad; /* of the points that were fitted to */
    double rms_dex;        /* of log10(f_fitted / f_measured), of the material as it is written */
    double aic, bic;       /* of Akaike and of Schwarz, to be compared among these fits */
} glint_brdf_fit_info;

/* Fit k in the order of rms_dex, from 0; false past the end. */
bool glint_brdf_fits_get(const glint_brdf_fits *fits, size_t k, glint_brdf_fit_info *out);

typedef enum glint_brdf_fit_state {
    GLINT_FIT_DETERMINED,
    GLINT_FIT_AT_BOUND,     /* the end of its range fits best */
    GLINT_FIT_UNDETERMINED, /* the measurements do not tell it */
    GLINT_FIT_TIED,         /* the same as along the tangent */
    GLINT_FIT_FIXED         /* not fitted */
} glint_brdf_fit_state;

/* A parameter of a fitted sum. Texts are borrowed. */
typedef struct glint_brdf_fit_parameter {
    int lobe;          /* term of the sum, from 0 */
    const char *model; /* of that term */
    const char *name, *unit;
    double value, standard_error; /* the error where determined, else 0 */
    glint_brdf_fit_state state;
} glint_brdf_fit_parameter;

/* Parameter j of fit k, in the order of the sum; false past the end. */
bool glint_brdf_fits_parameter(const glint_brdf_fits *fits, size_t k, size_t j,
                               glint_brdf_fit_parameter *out);

/* A measurement and what a fit makes of it. */
typedef struct glint_brdf_fit_point {
    double i[3], r[3]; /* unit, to the source and to the observer; tangent, bitangent, normal */
    double f_measured, f_fitted; /* 1/sr; f_fitted only where used */
    bool used;                   /* false: nearer to grazing than max_zenith_rad */
} glint_brdf_fit_point;

/* Measurement j beside fit k; false past the end. */
bool glint_brdf_fits_point(const glint_brdf_fits *fits, size_t k, size_t j,
                           glint_brdf_fit_point *out);

/* All fits as tables [materials.NAME], the best first. *toml: a new text, free it with glint_free.
 * Errors: GLINT_INTERNAL. */
glint_status glint_brdf_fits_toml(const glint_brdf_fits *fits, char **toml, glint_error *error);

/* Draws the four best fits: measurements and curves, and below them the residuals. path: as
 * glint_plot_check takes it. Errors: as that; GLINT_INTERNAL. */
glint_status glint_brdf_fits_plot(const glint_brdf_fits *fits, const char *path,
                                  glint_error *error);

/* --------------------------------------------------------------- materials */

/* A material of a file: how its surface reflects, in one band. Immutable; may be shared by threads.
 *
 * Angles are those of a facet: theta from its normal, phi from its tangent t towards n x t. The
 * light comes from (theta_i, phi_i) and is seen from (theta_r, phi_r); both directions point away
 * from the facet. A negative theta is the direction on the other side of the normal. */
typedef struct glint_material glint_material;

/* The names of the materials in a file: those of [materials.NAME] tables, and before them those of
 * the files in materials_from. path: a file of materials, a model, or a scenario that holds its
 * model. *names: *n texts in one block of memory, free it with glint_free. Errors: GLINT_INPUT:
 * unreadable, or there are none. */
glint_status glint_material_names(const char *path, const char ***names, size_t *n,
                                  glint_errors *errors);

/* Reads one material of such a file; what else is in the file need not be right. band: "V",
 * "lsst_g", ...: with the keys that differ in that band; NULL: as the table says, without a band.
 * Errors: GLINT_INPUT, all that is wrong with the material, or no such name; GLINT_ARGUMENT, no
 * such band. Warnings may be in the list on success. */
glint_status glint_material_read(const char *path, const char *name, const char *band,
                                 glint_material **out, glint_errors *errors);
void glint_material_free(glint_material *material);

/* Its name, its band ("" without one), its `source` ("" where not said), and its model with the
 * parameters, "ward rho_d=0.17 ...". Borrowed. */
const char *glint_material_name(const glint_material *material);
const char *glint_material_band(const glint_material *material);
const char *glint_material_source(const glint_material *material);
const char *glint_material_model(const glint_material *material);

/* The bidirectional reflectance *f, 1/sr, angles in rad. 0 where a direction lies below the horizon
 * or in it (cosine up to 1e-12): such a facet is dark. Near the horizon f is finite, but may be
 * very large; a light curve sums f cos(theta_i) cos(theta_r), which is not. Errors: GLINT_ARGUMENT
 * for angles that are not finite. */
glint_status glint_material_brdf(const glint_material *material, double theta_i, double phi_i,
                                 double theta_r, double phi_r, double *f, glint_error *error);

/* Whether what is measured of a material was measured around these directions (as above, not below
 * the horizon): between its measurements. Elsewhere f is the nearest measured one. True of
 * materials without measured tables. */
bool glint_material_covers(const glint_material *material, double theta_i, double phi_i,
                           double theta_r, double phi_r);

/* The part of the light from an incidence theta_i (rad, 0 <= theta_i < pi/2) that goes into the
 * mirror direction alone, as off a perfect mirror: it is no part of f, and part of the reflectance.
 * 0 for other surfaces, and for other angles. */
double glint_material_mirrored(const glint_material *material, double theta_i);

/* The directional-hemispherical reflectance: the part of the light from one direction that is sent
 * back. theta_i: rad, 0 <= theta_i < pi/2. error_bound: estimate of the absolute error of *dhr,
 * NULL allowed; 1e-8 of it is aimed at, 1e-5 of measured tables. Errors: GLINT_ARGUMENT for
 * theta_i; GLINT_INPUT where so much could not be reached (*dhr and *error_bound hold what was);
 * GLINT_INTERNAL. */
glint_status glint_material_dhr(const glint_material *material, double theta_i, double phi_i,
                                double *dhr, double *error_bound, glint_error *error);

/* The maximum of f in the plane of incidence that is reached uphill from the mirror direction:
 * *theta_r in rad, positive on the mirror side; *f in 1/sr. |theta_i| < pi/2. False where there is
 * none: f rises as far as the horizon, or is 0. */
bool glint_material_peak(const glint_material *material, double theta_i, double phi_i,
                         double *theta_r, double *f);

/* What is shown of materials. */
typedef enum glint_material_view_kind {
    GLINT_VIEW_PLANE,      /* curves in the plane of incidence */
    GLINT_VIEW_HEMISPHERE, /* maps over all directions of reflection */
    GLINT_VIEW_ANGLES,     /* values at the angles in a file */
    GLINT_VIEW_DHR         /* directional-hemispherical reflectance */
} glint_material_view_kind;

/* How it is shown; angles in deg, since they end up in columns. */
typedef struct glint_material_view {
    glint_material_view_kind kind;
    const double
        *theta_i_deg; /* angles of incidence, 0 <= theta_i < 90; not of GLINT_VIEW_ANGLES */
    size_t n_theta_i;
    double phi_i_deg; /* azimuth of the plane of incidence */
    double step_deg; /* between directions of reflection in the table, at most 45; at least 0.001 in
                        the plane of incidence, 0.25 of maps. The mirror direction is always among
                        them. Pictures are as fine as they need be */
    const char *angles; /* file with columns theta_i_deg, phi_i_deg, theta_r_deg, phi_r_deg; of
                           GLINT_VIEW_ANGLES */
    bool unit_given;    /* its angles are in deg indeed, also if they look like rad: none from the
                           normal above pi/2 and no azimuth above 2 pi */
    const char *const *labels; /* what materials are called in columns and legends; NULL: by name */
    bool logarithmic;          /* scale of the picture */
} glint_material_view;

/* Writes what is shown of n materials as a table with an ECSV header. path: as of
 * glint_table_write. Errors: GLINT_ARGUMENT; GLINT_INPUT from the file of angles, with its places;
 * GLINT_OUTPUT; GLINT_INTERNAL. */
glint_status glint_material_table_write(const glint_material *const *materials, size_t n,
                                        const glint_material_view *view, const char *path,
                                        glint_errors *errors);
/* Draws it. path: as glint_plot_check takes it. Errors: the same; GLINT_ARGUMENT also for more than
 * 12 maps. */
glint_status glint_material_plot_write(const glint_material *const *materials, size_t n,
                                       const glint_material_view *view, const char *path,
                                       glint_errors *errors);

/* -------------------------------------------------------------------- other */

/* The version, "0.1.0". */
const char *glint_version(void);
/* The name among n that is nearest to `wanted`, as a message might suggest it; NULL when none is
 * near enough to be a slip. */
const char *glint_nearest_name(const char *wanted, const char *const *names, size_t n);
/* Writes a text to a file that appears whole or not at all, as glint_table_write does. path: NULL
 * for standard output. Errors: GLINT_OUTPUT, GLINT_INTERNAL. */
glint_status glint_text_write(const char *path, const char *text, size_t length,
                              glint_error *error);
/* Frees memory that a function of this header handed out. */
void glint_free(void *memory);

#ifdef __cplusplus
}
#endif
#endif
