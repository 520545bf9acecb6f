#include "output/facts.h"

#include "output/ecsv.h"

#include <string.h>

/* How many facts from the k-th on have its key. */
static size_t count_alike(fact_source *source, const void *of, size_t k)
{
    const char *first, *key, *value;
    size_t n = 1;
    if (!source(of, k, &first, &value)) return 0;
    while (source(of, k + n, &key, &value) && string_equal(key, first))
        n++;
    return n;
}

static bool is_list(const char *key, size_t n)
{
    return n > 1 || string_equal(key, "set") || string_equal(key, "swap") ||
           string_equal(key, "without");
}

void ecsv_facts(text *t, fact_source *source, const void *of)
{
    const char *key, *value;
    for (size_t k = 0, n; (n = count_alike(source, of, k)) > 0; k += n) {
        source(of, k, &key, &value);
        if (!is_list(key, n)) {
            ecsv_fact(t, key, value);
            continue;
        }
        ecsv_list(t, key);
        for (size_t i = k; i < k + n && source(of, i, &key, &value); i++)
            ecsv_item(t, value, strlen(value));
    }
}

void json_facts(json *j, fact_source *source, const void *of)
{
    const char *key, *value;
    bool has_set = false;
    for (size_t k = 0, n; (n = count_alike(source, of, k)) > 0; k += n) {
        source(of, k, &key, &value);
        if (!is_list(key, n)) {
            json_string(j, key, value);
            continue;
        }
        has_set = has_set || string_equal(key, "set");
        json_list(j, key);
        for (size_t i = k; i < k + n && source(of, i, &key, &value); i++)
            json_string(j, NULL, value);
        json_end(j, ']');
    }
    if (has_set) return;
    json_list(j, "set");
    json_end(j, ']');
}
