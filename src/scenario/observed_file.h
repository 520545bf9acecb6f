/* observed_file.h: files of observed magnitudes, as rows. */
#ifndef GLINT_SCENARIO_OBSERVED_FILE_H
#define GLINT_SCENARIO_OBSERVED_FILE_H

#include "orbit/clock.h"
#include "scenario/scenario.h"

/* How a CSV file says the time: the names of the columns are those of the words. */
typedef enum observed_time {
    OBSERVED_UTC,
    OBSERVED_JD,
    OBSERVED_MJD,
    OBSERVED_TIMES
} observed_time;

/* What columns are called; NULL: by the name in observed_column_names, if there is one. Borrowed.
 */
typedef enum observed_column {
    OBSERVED_MAGNITUDE = OBSERVED_TIMES,
    OBSERVED_SIGMA,
    OBSERVED_RANGE,
    OBSERVED_PHASE,
    OBSERVED_FILTER,
    OBSERVED_COLUMNS
} observed_column;

extern const char *const observed_column_names[OBSERVED_COLUMNS];

/* What is asked of a file. */
typedef struct observed_wanted {
    const char *path;
    place asked_from;
    const char *columns[OBSERVED_COLUMNS]; /* of CSV */
    place column_places[OBSERVED_COLUMNS]; /* of what says so */
    bool is_template;   /* the columns are those of SCORE's template: not all need be there, and a
                           sigma of 0 says nothing */
    const char *filter; /* rows of another one are left out; NULL: of none */
    bool standard;      /* of MMT: the column StdMag instead of Mag */
    const run_clock *clock;
    double span_s; /* rows later than that, or earlier than the start, are left out */
} observed_wanted;

/* Both fill rows and counts of *out. Errors: GLINT_INPUT, all that is wrong with the file;
 * GLINT_INTERNAL. A last line without its end is left out with a warning. */
glint_status observed_read_csv(const observed_wanted *wanted, observed_track *out,
                               glint_errors *errors);
/* Tracks of the MMT database: lines of nine or ten words, Date Time StdMag Mag Filter Penumbra
 * Distance (km) Phase (deg) Channel and the number of the track; lines that begin with # are
 * skipped, and what names the columns there is checked. */
glint_status observed_read_mmt(const observed_wanted *wanted, observed_track *out,
                               glint_errors *errors);

#endif
