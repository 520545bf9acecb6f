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

/* How a file is laid out. theta is the angle from the normal, phi the azimuth. */
typedef struct measured_format {
    /* Each column by its name in the header (owned by the caller) or, where name is NULL, by its
     * number from 1; number 0 and no name: the file has no such column, and the angle is 0 (phi_i),
     * or phi_r is phi_i + 180 deg (in plane). theta_i, theta_r and f must be there. */
    struct {
        const char *name;
        int number;
        place where; /* of the key, for messages */
    } column[MEASURED_COLUMNS];
    bool signed_zenith; /* theta_r is negative on the side of the source (phi_r = phi_i), positive
                           on the mirror side; then phi_r is not read */
    bool radians;       /* angles in rad instead of deg */
} measured_format;

/* One measurement. */
typedef struct measured_point {
    double i[3], r[3]; /* unit, facet frame (t, b, n), away from the facet */
    double f;          /* 1/sr, > 0 */
    int line;          /* of the file */
} measured_point;

typedef struct measured {
    measured_point *points; /* owned */
    int n;
    int n_dropped; /* rows left out: f = 0 or below the horizon of the instrument; said in reports
                    */
    bool in_plane; /* every row lies in the plane of incidence */
} measured;

/* Comment lines (#, %, !, //) and blank lines are skipped; cells are separated by commas,
 * semicolons, tabs or blanks; a header line of names is recognised where the first line holds no
 * number. Errors (GLINT_INPUT, with file:line:column, all found): unreadable, no such column, a row
 * of another length, a cell that is no finite number, theta outside 0..90 deg (-90..90 when
 * signed), f negative; fewer than 3 usable rows. */
glint_status measured_read(const char *path, place asked_from, const measured_format *format,
                           measured *out, glint_errors *errors);
void measured_free(measured *m);

#endif
