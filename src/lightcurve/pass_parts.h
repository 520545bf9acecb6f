/* pass_parts.h: what the files that find passes share. */
#ifndef GLINT_LIGHTCURVE_PASS_PARTS_H
#define GLINT_LIGHTCURVE_PASS_PARTS_H

#include "base/roots.h"
#include "lightcurve/tile.h"
#include "lightcurve/watch.h"

/* Events are found to this: a thousandth of the 1 ms that is promised. */
#define EVENT_TOLERANCE_S 1e-6

/* While the satellite is above min_elevation. */
typedef struct pass_span {
    double from_s, to_s;
    bool up_at_start, up_at_end;
} pass_span;

typedef struct pass_span_list {
    pass_span *items; /* owned */
    size_t n, capacity;
} pass_span_list;

/* Finds all spans within the scenario's time. Errors: of the orbit; GLINT_INTERNAL (memory). */
glint_status pass_spans_find(watch *w, pass_span_list *out, glint_error *error);
/* The highest moment of a span. */
glint_status pass_culmination(watch *w, const pass_span *span, double *t_s, glint_error *error);
/* Time in which the satellite would run once around the Earth on the ellipse that it is on, s. */
double pass_period_s(const sighting *seen);

/* Events of a pass while they are gathered; owned array. */
typedef struct event_list {
    glint_pass_event *items;
    size_t n, capacity;
} event_list;

/* Appends an event at t_s, with its place in the sky. Errors: of the sighting; GLINT_INTERNAL. */
glint_status event_list_add(event_list *list, watch *w, glint_event_kind kind, double t_s,
                            glint_error *error);

/* Brightness at any moment; one for each thread. */
typedef struct light_meter {
    watch *w; /* borrowed */
    tile_worker worker;
    photometry_rows photometry; /* owned; TILE */
} light_meter;

/* plan: as of tile_worker_make. light_meter_free ends *out in every case. */
glint_status light_meter_make(watch *w, const visibility *plan, light_meter *out,
                              glint_error *error);
void light_meter_free(light_meter *meter);
/* Magnitudes in the first band at n <= TILE times; HUGE_VAL where nothing is seen. */
glint_status light_meter_read(light_meter *meter, const double *t_s, int n, double *magnitude,
                              glint_error *error);

/* Flat shiny surfaces that look the same way: those that flash together. */
typedef struct mirror {
    int component;
    double normal[3]; /* unit, component's axes */
} mirror;

typedef struct mirror_list {
    mirror *items; /* owned */
    int n;
} mirror_list;

/* Gathers the mirrors of a satellite. Errors: GLINT_INTERNAL (memory). */
glint_status mirrors_of(const satellite *sat, mirror_list *out, glint_error *error);

/* Appends the flashes between from_s and to_s, without their magnitudes; no more than `most` events
 * in all, else *more. limit: largest mirror angle, rad. */
glint_status flashes_find(watch *w, const mirror_list *mirrors, double (*component_gcrs)[9],
                          double from_s, double to_s, double limit, size_t most, event_list *out,
                          bool *more, glint_error *error);

#endif
