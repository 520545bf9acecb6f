/* attitude_plan.h: attitude laws one after the other, with slews between them. */
#ifndef GLINT_ORBIT_ATTITUDE_PLAN_H
#define GLINT_ORBIT_ATTITUDE_PLAN_H

#include "orbit/attitude.h"

struct text;

/* A law from a moment on. */
typedef struct attitude_leg {
    attitude law;        /* owned */
    double from_s;       /* TT s from the start of the run; of the first leg not used */
    double slew_s;       /* length of the slew that begins then; 0: at once */
    double rate_rad_s;   /* of the slew, where that was given in place of its length; else 0 */
    double start_way[4]; /* the turn from the law before to this one when the slew begins, w >= 0 */
    bool has_start_way;  /* attitude_plan_settle has been here */
    place where;
} attitude_leg;

/* A run's attitude; immutable once it is settled. Zero-initialise; attitude_plan_free ends it. */
typedef struct attitude_plan {
    attitude_leg *legs; /* owned; in the order of their times */
    int n;
} attitude_plan;

/* Appends a leg; what it owns is taken over in any case. Errors: GLINT_INTERNAL (memory). */
glint_status attitude_plan_add(attitude_plan *plan, const attitude_leg *leg, glint_errors *errors);
void attitude_plan_free(attitude_plan *plan);

/* Tells leg k (> 0, with a slew) the moment at which its slew begins. That decides on which side
 * the slew goes, the shorter one then, and keeps to it while the laws move; and the length of a
 * slew whose rate is given. start: at from_s. Errors (GLINT_INPUT): those of the two laws then. */
glint_status attitude_plan_settle(attitude_plan *plan, int k, const moment *start,
                                  glint_error *error);

/* Body axes: v_body = R v_gcrs. During a slew the body turns away from the law before it, which
 * goes on meanwhile, by a growing part of the turn between the two laws: linear in time, about an
 * axis that stays in the body where both laws rest. Errors: those of attitude_at. */
glint_status attitude_plan_at(const attitude_plan *plan, const moment *m, double body_gcrs[9],
                              glint_error *error);
/* True when some law looks at that direction. */
/* How the laws turn the body by themselves, slews and tables apart: steadily only where there is
 * one law and it does. */
attitude_turning attitude_plan_turning(const attitude_plan *plan);
bool attitude_plan_wants(const attitude_plan *plan, direction_kind kind);
/* The first time after t_s at which the rates of turning may jump: a law or a slew begins or ends,
 * a row of a table; INFINITY where there is none. */
double attitude_plan_next_change(const attitude_plan *plan, double t_s);
/* One line for each leg, the ends of lines included; `indent` before all but the first. */
void attitude_plan_describe(const attitude_plan *plan, const char *indent, struct text *out);
/* The first moment of the run, from 0 to end_s, at which leg k is in use and its table says
 * nothing, through *gap_s; false where there is none. */
bool attitude_plan_gap(const attitude_plan *plan, int k, double end_s, double *gap_s);

#endif
