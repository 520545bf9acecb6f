/* tle.h: the element sets that SGP4 takes, as two lines, and files of them (with or without name
 * lines). */
#ifndef GLINT_ORBIT_TLE_H
#define GLINT_ORBIT_TLE_H

#include "base/error.h"

#include <stddef.h>

/* Room of an international designator in the form of element sets. */
enum { DESIGNATOR_SIZE = 12 };

/* One element set, as SGP4 takes it. Mean elements in TEME of date. */
typedef struct tle {
    char name[64]; /* from the name line, "0 " and blanks removed; "" without one */
    char designator[DESIGNATOR_SIZE]; /* international designator, "98067A" */
    int number;             /* catalogue number; Alpha-5 letters decoded (A0000 = 100000) */
    double epoch_jd[2];     /* UTC quasi-JD, two parts (day at 0h + 0.5, fraction) */
    double mean_motion_dot; /* first derivative over 2, rev/day^2 (SGP4 does not use it) */
    double bstar;           /* 1/Earth radii */
    double inclination, raan, eccentricity, argument_of_perigee, mean_anomaly; /* rad */
    double mean_motion;                                                        /* rad/min, Kozai */
    place where; /* of line 1, or of the record; file borrowed */
} tle;

/* What to choose from a file. All conditions that are given must hold. */
typedef struct tle_query {
    const char *name;       /* NULL: any; compared without regard to case and surrounding blanks */
    int number;             /* 0: any */
    const char *designator; /* NULL: any; "1998-067A" or "98067A" */
} tle_query;

/* Element sets of one satellite, in the order of their epochs, which differ. */
typedef struct tle_list {
    tle *sets; /* owned */
    size_t n;
    char *path; /* owned; what the sets' places point at; NULL where they came from no file */
} tle_list;

void tle_list_free(tle_list *list);

/* Ranges of elements as files give them: min <= value < max. Catalogues write both ends of a
 * circle; the ends here are the first values that four decimals tell from 180 and 360 deg. */
typedef struct element_range {
    const char *name;
    double min, max;
} element_range;

extern const element_range RANGE_INCLINATION_DEG, RANGE_NODE_DEG, RANGE_PERIGEE_DEG,
    RANGE_ANOMALY_DEG, RANGE_ECCENTRICITY, RANGE_MOTION_REV_DAY;

/* Checks an element. Errors: GLINT_INPUT, naming what was found and the range. */
glint_status element_check(const element_range *range, double value, place where,
                           glint_error *error);

/* Reads "1998-067A", "1998-067-A" or "98067A" (n characters, blanks around allowed) as "98067A";
 * false for other forms. */
bool designator_read(const char *s, size_t n, char out[DESIGNATOR_SIZE]);

/* Parses two lines (of length >= 68 each, a line end allowed; blanks may follow). out->name is "".
 * `where` is the place of line 1 for messages, its column that of the line's first character (0
 * counts as 1); line 2 is taken to be the next line unless `where2` is given (NULL allowed).
 * check_sums: column 69 must be there and hold, and nothing may follow it; otherwise whatever
 * stands from column 69 on is not looked at. Blanks are taken for missing leading zeros. Years 57
 * to 99 are 1957 to 1999. The day of the year may be 366 in every year: catalogues count on into
 * the next. On a day that ends in a leap second the fraction is of 86400 s, as it is written.
 * Errors: GLINT_INPUT: wrong line number, field layout, checksum (says which was found and which
 * expected), numbers of the lines differ, element out of range, ephemeris type 4 (an SGP4-XP set,
 * refused by name) or another that is not SGP4's. */
glint_status tle_parse(const char *line1, const char *line2, bool check_sums, place where,
                       const place *where2, tle *out, glint_error *error);

/* Reads the five characters of a catalogue number at `field`: digits, blanks before them for zeros,
 * or Alpha-5 (a capital letter but I and O, then four digits). False when it is none. */
bool tle_number_read(const char *field, int *number);

/* Reads a file of element sets, with or without name lines, and gives those of one satellite;
 * checksums must hold. Blank lines and lines that begin with '#' are skipped. asked_from: where the
 * file was asked for (PLACE_NONE allowed). Errors (GLINT_INPUT): unreadable; no element set; those
 * of element_sets_choose and, in the sets that fit, of tle_parse; a line 1 without its line 2 (a
 * truncated file) and a line 2 without its line 1, anywhere in the file. Sets of other satellites
 * are not parsed beyond what choosing needs. *out is empty on error; end it with tle_list_free. */
glint_status tle_file_read(const char *path, place asked_from, const tle_query *query,
                           tle_list *out, glint_errors *errors);

#endif
