/* facts.h: what is known of a run, as the head of a table or of a JSON document. */
#ifndef GLINT_OUTPUT_FACTS_H
#define GLINT_OUTPUT_FACTS_H

#include "output/json.h"

/* Fact k from 0 of something; false past the end. */
typedef bool fact_source(const void *of, size_t k, const char **key, const char **value);

/* Both write all facts. Keys are unique in what is written: facts that stand next to each other
 * under one key make a list, and "set", "swap" and "without" always do. JSON has a list "set" in
 * any case. */
void ecsv_facts(text *t, fact_source *source, const void *of);
void json_facts(json *j, fact_source *source, const void *of);

#endif
