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

/* A growing list of errors and warnings, those of a file in the order of their places. The first 1000
 * are kept, all are counted. */
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
void glint_scenario_free(glint_scenario *scenario);

/* ------------------------------------------------------------- light curve */

/* Why a row is faint or dark; any number of them. */
typedef enum glint_flag {
    GLINT_BELOW_HORIZON = 1u << 0, /* elevation below min_elevation_deg */
    GLINT_UMBRA = 1u << 1,         /* no part of the Sun is seen from the satellite */
    GLINT_PENUMBRA = 1u << 2,      /* some part of it */
    GLINT_DARK = 1u << 3,          /* nothing lit is seen, though neither of the above says why */
    GLINT_SITE_DARK = 1u << 4      /* the Sun is below sun_elevation_max_deg at the site */
} glint_flag;

/* A moment of UTC; `second` may reach 60 in a leap second. microsecond: 0..999999. */
typedef struct glint_utc {
    int year, month, day, hour, minute, second, microsecond;
} glint_utc;

/* One step of a light curve. Angles in rad, lengths in m. Site fields are 0 where the observer is
 * not a site. */
typedef struct glint_row {
    glint_utc utc;             /* of reception at the observer; not set in [geometry] runs */
    double t_s;                /* TT seconds from the start of the scenario */
    double range_m;            /* observer to satellite, along the light path */
    double phase_angle_rad;    /* at the satellite, between Sun and observer */
    double sunlit_fraction;    /* visible part of the solar disc */
    double azimuth_rad;        /* from north through east */
    double elevation_rad;      /* geometric */
    double sun_elevation_rad;  /* topocentric, geometric */
    double airmass;            /* 0 below the horizon */
    double height_m;           /* geodetic, of the satellite; 0 where nothing asks for it */
    unsigned flags;            /* glint_flag */
    const double *flux_ratio;  /* n_bands: irradiance at the observer over the Sun's at 1 au */
    const double *magnitude;   /* n_bands; only where flux_ratio > 0, else 0 */
    const double *share_material;  /* n_materials, of the first band's flux; all 0 when dark */
    const double *share_component; /* n_components */
} glint_row;

/* An output column. */
typedef struct glint_column {
    const char *name, *unit, *description; /* borrowed from the curve; unit "" where there is none */
    bool is_text;
} glint_column;

/* A light curve that is being computed: blocks of rows in order of time, in constant memory. */
typedef struct glint_curve glint_curve;

/* Prepares a run. threads: 0 for all processors. The scenario must outlive the curve. Errors:
 * GLINT_INPUT (an orbit that cannot be propagated, ...), GLINT_INTERNAL. */
glint_status glint_curve_open(const glint_scenario *scenario, int threads, glint_curve **out,
                              glint_errors *errors);
void glint_curve_close(glint_curve *curve);
/* Number of steps of the whole run, before [output] rows chooses among them. */
int64_t glint_curve_length(const glint_curve *curve);

/* The next block: *rows points at *n rows, borrowed until the next call; *n = 0 at the end. Rows
 * that [output] rows leaves out are not among them. Errors: GLINT_INPUT where the orbit fails at
 * some time (decayed, ...); GLINT_INTERNAL. */
glint_status glint_curve_next(glint_curve *curve, const glint_row **rows, size_t *n,
                              glint_error *error);

/* Steps computed so far. */
int64_t glint_curve_done(const glint_curve *curve);
/* Number of threads that it computes with. */
int glint_curve_threads(const glint_curve *curve);
/* Name of the first band, "V". Borrowed. */
const char *glint_curve_band(const glint_curve *curve);
/* Time between rows in s; 0 where the scenario gives directions instead of times. */
double glint_curve_step_s(const glint_curve *curve);

/* What the header of a table says about the run: fact k from 0, "zero_point_V" and "-26.76 (...)";
 * false past the end. Texts borrowed. */
bool glint_curve_fact(const glint_curve *curve, size_t k, const char **key, const char **value);
/* The scenario's file, as read. */
const char *glint_curve_scenario(const glint_curve *curve);

/* The columns of the table, in order. */
const glint_column *glint_curve_columns(const glint_curve *curve, size_t *n);
/* Room that glint_curve_text needs. */
enum { GLINT_CELL_SIZE = 96 };
/* The number in a cell; false when the cell is empty, or a text. */
bool glint_curve_value(const glint_curve *curve, const glint_row *row, size_t column, double *value);
/* The cell as it stands in the table, terminated; returns its length. */
size_t glint_curve_text(const glint_curve *curve, const glint_row *row, size_t column,
                        char text[GLINT_CELL_SIZE]);

/* ------------------------------------------------------------------- table */

/* What a run came to; times in s of the rows that are in the table. */
typedef struct glint_summary {
    int64_t rows;            /* in the table */
    int64_t bright_rows;     /* with a magnitude in the first band */
    double magnitude_min, magnitude_median, magnitude_max; /* of those; the median to 0.001 mag */
    double percent_brighter_6, percent_brighter_7;         /* of those; first band */
    double sunlit_s, visible_s; /* sunlit_fraction > 0; that, and above the horizon */
    double brightest_t_s;       /* of the brightest row */
    glint_utc brightest_utc;    /* not set in [geometry] runs */
    bool has_utc;
    const char *band;           /* the first, borrowed from the curve */
} glint_summary;

/* Called after each block with the number of steps done; return false to stop the run. */
typedef bool glint_progress(void *context, int64_t done, int64_t all);

/* Writes the whole curve as a table with an ECSV header. path: NULL for standard output; a regular
 * file appears whole or not at all (written beside, synced, renamed); a pipe or device is written
 * to. summary, progress: NULL allowed. Errors: GLINT_OUTPUT, GLINT_INPUT, GLINT_INTERNAL. */
glint_status glint_table_write(glint_curve *curve, const char *path, glint_summary *summary,
                               glint_progress *progress, void *context, glint_error *error);

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
} glint_verdict;

/* Runs a scenario and holds it against its [[expect]], [expect_table] and [[require]]. Every
 * deviation is an error in the list, at the place of the expectation, and makes the result
 * GLINT_INPUT; so is a scenario that expects nothing. verdict: NULL allowed. */
glint_status glint_verify(const char *path, const char *const *overrides, size_t n_overrides,
                          int threads, glint_verdict *verdict, glint_errors *errors);

/* -------------------------------------------------------------------- BRDFs */

/* A parameter of a BRDF model. */
typedef struct glint_brdf_param {
    const char *name, *unit, *doc;
    double min, max;     /* may be infinite */
    double default_value; /* where not required */
    bool required;
} glint_brdf_param;

/* Model k of the table, counted from 0: its name, one line about it, its source; NULL past the end. */
const char *glint_brdf_name(size_t k);
const char *glint_brdf_doc(size_t k);
const char *glint_brdf_source(size_t k);
/* Parameter j of model k; false past the end. */
bool glint_brdf_parameter(size_t k, size_t j, glint_brdf_param *out);

/* -------------------------------------------------------------------- other */

/* The version, "0.1.0". */
const char *glint_version(void);
/* Frees memory that a function of this header handed out. */
void glint_free(void *memory);

#ifdef __cplusplus
}
#endif
#endif
