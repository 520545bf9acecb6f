/* facts.h: what a run assumes and neglects, in words: for headers and reports. */
#ifndef GLINT_LIGHTCURVE_FACTS_H
#define GLINT_LIGHTCURVE_FACTS_H

#include "base/text.h"
#include "scenario/scenario.h"

typedef struct fact {
    char *key, *value; /* owned */
} fact;

typedef struct fact_list {
    fact *items; /* owned */
    size_t n, capacity;
    bool failed; /* memory ran out */
} fact_list;

/* Appends a fact; `failed` is set when memory runs out. */
void fact_list_add(fact_list *list, const char *key, const char *format, ...) GLINT_PRINTF(3, 4);
/* Fact k from 0, borrowed; false past the end. */
bool fact_list_get(const fact_list *list, size_t k, const char **key, const char **value);
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
/* Appends a lobe in short: "ward rho_d=0.1 ...". */
void fact_lobe(const brdf_lobe *lobe, text *t);
/* Name of the satellite as the file of its orbit has it; "" where there is none. */
const char *scenario_object(const glint_scenario *s);
/* An observer in one line, likewise: its name, where it is, what it cannot see, its air. */
char *fact_observer(const glint_scenario *s, const scenario_observer *o);

#endif
