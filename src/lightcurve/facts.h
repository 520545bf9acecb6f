/* facts.h: what a run assumes and neglects, in words: for headers and reports. */
#ifndef GLINT_LIGHTCURVE_FACTS_H
#define GLINT_LIGHTCURVE_FACTS_H

#include "scenario/scenario.h"

typedef struct fact {
    char *key, *value; /* owned */
} fact;

typedef struct fact_list {
    fact *items; /* owned */
    size_t n, capacity;
    bool failed; /* memory ran out */
} fact_list;

/* Everything that the header of a table says of the run. */
void facts_of_run(const glint_scenario *s, fact_list *out);
/* Of these, what concerns positions only. */
void facts_of_orbit(const glint_scenario *s, fact_list *out);
void fact_list_free(fact_list *list);
/* An orbit in one line: its source, epoch, span, ...; from malloc, NULL when memory is out. */
char *fact_orbit(const glint_scenario *s, const scenario_orbit *o);
/* Which of several element sets is used when, how old it gets, and how far the satellite jumps from
 * one to the next; from malloc; NULL where there are not several, or when memory is out. */
char *fact_element_sets(const glint_scenario *s, const scenario_orbit *o);
/* Name of the satellite as the file of its orbit has it; "" where there is none. */
const char *scenario_object(const glint_scenario *s);
/* An observer in one line, likewise: its name, where it is, what it cannot see, its air. */
char *fact_observer(const glint_scenario *s, const scenario_observer *o);

#endif
