/* columns.h: the columns of a light curve's table: names, units, cells. */
#ifndef GLINT_LIGHTCURVE_COLUMNS_H
#define GLINT_LIGHTCURVE_COLUMNS_H

#include "scenario/scenario.h"

/* What a column shows. */
typedef enum column_kind {
    COLUMN_OBSERVER,
    COLUMN_UTC,
    COLUMN_T,
    COLUMN_MAGNITUDE,   /* index: band */
    COLUMN_FLUX,        /* index: band */
    COLUMN_STANDARD_90, /* index: band; at 1000 km and a phase angle of 90 deg */
    COLUMN_STANDARD_0,  /* at 1000 km, full */
    COLUMN_SIGMA,       /* index: band */
    COLUMN_SNR,         /* index: band */
    COLUMN_ANGULAR_RATE,
    COLUMN_EARTHSHINE, /* index: band */
    COLUMN_RANGE,
    COLUMN_PHASE,
    COLUMN_SUNLIT,
    COLUMN_FLAGS,
    COLUMN_AZIMUTH,
    COLUMN_ELEVATION,
    COLUMN_SUN_ELEVATION,
    COLUMN_AIRMASS,
    COLUMN_MOON_AZIMUTH,
    COLUMN_MOON_ELEVATION,
    COLUMN_MOON_SEPARATION,
    COLUMN_MOON_ILLUMINATED,
    COLUMN_SHARE_MATERIAL,  /* index: material */
    COLUMN_SHARE_COMPONENT, /* index: component */
    COLUMN_SHARE_SURFACE    /* index: surface */
} column_kind;

typedef struct column_set {
    const glint_scenario *s; /* borrowed */
    glint_column *columns;   /* owned */
    column_kind *kinds;      /* owned */
    int *indices;            /* owned */
    char **names;            /* owned, each: those that were put together */
    size_t n;
} column_set;

/* Errors: GLINT_INTERNAL (memory). */
glint_status column_set_make(const glint_scenario *s, column_set *out, glint_error *error);
void column_set_free(column_set *set);
/* As glint_curve_value and glint_curve_text. */
bool column_value(const column_set *set, const glint_row *row, size_t column, double *value);
size_t column_text(const column_set *set, const glint_row *row, size_t column,
                   char out[GLINT_CELL_SIZE]);

#endif
