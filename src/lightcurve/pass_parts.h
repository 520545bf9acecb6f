/* pass_parts.h: what the files that find passes share. */
#ifndef GLINT_LIGHTCURVE_PASS_PARTS_H
#define GLINT_LIGHTCURVE_PASS_PARTS_H

#include "base/roots.h"
#include "lightcurve/tile.h"
#include "lightcurve/watch.h"

/* Events are found to this: a thousandth of the 1 ms that is promised. */
#define EVENT_TOLERANCE_S 1e-6

/* While the satellite is above a site's horizon. */
typedef struct pass_span {
    double from_s, to_s;
    bool up_at_start, up_at_end;
    const scenario_observer *site; /* borrowed */
} pass_span;

typedef struct pass_span_list {
    pass_span *items; /* owned */
    size_t n, capacity;
} pass_span_list;

/* Appends all spans over the watch's site within the scenario's time. Errors: of the orbit;
 * GLINT_INTERNAL (memory). */
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

/* The angles whose signs tell light from shadow and day from night. */
typedef enum edge_kind {
    EDGE_UMBRA,    /* > 0: some of the Sun is seen */
    EDGE_PENUMBRA, /* > 0: all of it */
    EDGE_MOON,     /* > 0: the Moon covers nothing of it */
    EDGE_DARKNESS, /* > 0: the site is dark */
    N_EDGES
} edge_kind;

/* Times at which one edge is crossed during a pass, and the side at its start. */
typedef struct edge {
    root_list at;
    bool above_at_start;
} edge;

/* Looks for the moments at which an edge is crossed. Errors: of the sighting; GLINT_INTERNAL
 * (memory); so below. */
glint_status pass_edge_find(watch *w, const pass_span *span, edge_kind kind, edge *out,
                            glint_error *error);
/* Appends the events of an edge's crossings. */
glint_status pass_edge_events(watch *w, const edge *e, edge_kind kind, event_list *out,
                              glint_error *error);
/* Intervals of a pass in which an edge is above, as pairs of from and to. */
glint_status pass_edge_spans(const edge *e, const pass_span *span, root_list *out,
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

/* The brightest moment so far. */
typedef struct brightest {
    double t_s, magnitude;
} brightest;

/* Looks through one sunlit span for what is brighter than *best: samples every second (more, so
 * that there are 64 at least; fewer, so that there are 20 000 at most, or where little moves), then
 * the minima among them by golden section. Errors: of light_meter_read; GLINT_INTERNAL (memory). */
glint_status pass_brightest_in_span(light_meter *meter, double from_s, double to_s, brightest *best,
                                    glint_error *error);
/* Gives the events from number `first` on their magnitudes. Flashes among them tell of bright
 * moments that samples may have missed: they go into *best (NULL: not wanted). */
glint_status pass_measure_events(light_meter *meter, event_list *events, size_t first,
                                 brightest *best, glint_error *error);

/* Flat shiny surfaces that look the same way: those that flash together. */
typedef struct mirror {
    int component;
    double normal[3]; /* unit, component's axes */
    int facet;        /* the first of them */
    bool twin;        /* another one looks the same way: not kept */
    /* By its own turn, and the hinges' and the body's that carry it; what follows the Sun, the
     * orbit or the observer moves as slowly as they do, and comes on top. */
    double fastest_rad_s; /* it turns no faster */
    double period_s;      /* of its turn, where it is a single steady one; else 0 */
    int frame;            /* component in whose axes the axis of that turn is given; -1: the body */
    double axis[3];       /* unit */
    double cosine;        /* of the angle between axis and normal, which stays */
} mirror;

typedef struct mirror_list {
    mirror *items; /* owned */
    int n;
} mirror_list;

/* Gathers the mirrors of a satellite. Errors: GLINT_INTERNAL (memory). */
glint_status mirrors_of(const satellite *sat, const attitude_plan *plan, mirror_list *out,
                        glint_error *error);

/* Angle, rad, between the direction to the observer and that into which a surface mirrors the Sun;
 * pi where one of them stands behind it. All unit, in one frame. */
double mirror_angle(const double normal[3], const double sun[3], const double observer[3]);
/* The smallest mirror angle of any phase of the mirror's steady turn about `pole`, or less by up to
 * 1e-9 rad; what stands behind the surface may count. All unit, in one frame. */
double mirror_least_angle(const mirror *m, const double pole[3], const double sun[3],
                          const double observer[3]);

/* What flashes are looked for, and where. */
typedef struct flash_request {
    const mirror_list *mirrors;
    double (*component_gcrs)[9]; /* n_components; scratch */
    double from_s, to_s;
    double limit; /* largest mirror angle, rad */
    size_t first; /* where the pass's flashes begin among the events */
    size_t most;  /* flashes of a pass */
} flash_request;

/* Appends the flashes, without their magnitudes and in any order. *until_s: all of them until then
 * were found; earlier than to_s where there are more, or where it would take too long to find out:
 * some millions of looks at the satellite. Errors: those of watch_at and satellite_turn;
 * GLINT_INTERNAL. */
glint_status flashes_find(watch *w, const flash_request *wanted, event_list *out, double *until_s,
                          glint_error *error);

#endif
