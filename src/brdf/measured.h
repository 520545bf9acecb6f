/* measured.h: tables of measured BRDF values, read as people have them. */
#ifndef GLINT_BRDF_MEASURED_H
#define GLINT_BRDF_MEASURED_H

#include "base/error.h"

/* The five quantities of a row. */
enum {
    MEASURED_THETA_I,
    MEASURED_PHI_I,
    MEASURED_THETA_R,
    MEASURED_PHI_R,
    MEASURED_F,
    MEASURED_COLUMNS
};

/* Where a quantity stands: in the column of that name or, where name is NULL, in the column of that
 * number from 1. Neither (NULL and 0): the file has no such column. */
typedef struct measured_column {
    const char *name; /* borrowed */
    int number;
    place where; /* of the key, for messages */
} measured_column;

/* How a file is laid out. theta is the angle from the normal, phi the azimuth.
 *
 * theta_i, theta_r and f must be there. Without phi_i that azimuth is 0; without phi_r it is 180
 * deg from phi_i, on the mirror's side. All zero: the columns bear the names theta_i, phi_i,
 * theta_r, phi_r and f, and the two azimuths may be absent. */
typedef struct measured_format {
    measured_column column[MEASURED_COLUMNS];
    bool signed_zenith; /* theta may be negative, which means the opposite azimuth: without columns
                           of phi, theta_r is positive on the mirror's side of the normal and
                           negative on the source's */
    bool radians;       /* angles in rad instead of deg */
    bool unit_given;    /* the unit was said, and angles that look like another's are believed */
    double floor;       /* 1/sr, at least 0: what the instrument writes where it sees nothing; rows
                           with f at or below it are left out */
} measured_format;

/* One measurement. */
typedef struct measured_point {
    double i[3], r[3]; /* unit, facet frame (t, b, n), away from the facet */
    double angle[4];   /* theta_i, phi_i, theta_r, phi_r as they stand in the file, in its unit; of
                          an azimuth without a column, what stands in its place */
    double f;          /* 1/sr, > 0 */
    int line;          /* of the file */
} measured_point;

typedef struct measured {
    measured_point *points; /* owned */
    int n;
    int n_dropped; /* rows left out because f is not above the floor */
    bool in_plane; /* every row lies in the plane of incidence */
} measured;

/* Name of a quantity: "theta_i", ... */
const char *measured_name(int quantity);

/* Reads a file of rows of numbers.
 *
 * Lines that begin with #, %, ! or //, and blank lines, are skipped. The cells of a line are parted
 * by semicolons, else by commas, else by blanks and tabs. A first line without any number is the
 * header; where there is none, the last comment before the first row is, if it has as many words as
 * the row has cells. Columns that the format does not name may hold anything. CRLF and a byte order
 * mark are accepted.
 * asked_from: place of the value that names the file. *out is measured_free's on success and empty
 * on error.
 * Rows may stand in any order.
 * Errors (GLINT_INPUT, all that were found, at the file's line and column): unreadable, a zero
 * byte, more than 256 columns, no such column, a column named twice, a row of another length, a
 * cell that is no finite number, theta outside 0 to 90 deg (-90 to 90 when signed), f negative,
 * fewer than 3 usable rows; and, unless unit_given, angles in deg that look like rad: none from the
 * normal above pi/2 and no azimuth above 2 pi. GLINT_INTERNAL: memory is out.
 * A last row without a line end may have been cut: it is left out with a warning. */
glint_status measured_read(const char *path, place asked_from, const measured_format *format,
                           measured *out, glint_errors *errors);
void measured_free(measured *m);

/* Looks at the rows of a file together, as an interpolation needs them. path: for messages. Errors
 * (GLINT_INPUT): rows with the same four angles that disagree about f, each pair at the line of the
 * second. (Rows that repeat others word by word are no error; nor are those that measure the same
 * place in other words, as reciprocals or across the pole do.) GLINT_INTERNAL: memory is out.
 * Warns of gaps: where rows of a scan stand much farther apart than the rows on both sides. */
glint_status measured_check(const measured *rows, const char *path, glint_errors *errors);

#endif
