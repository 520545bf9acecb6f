#include "cli/command.h"
#include "cli/output.h"
#include "cli/report.h"

#include <math.h>
#include <string.h>

enum { CELL = 64 }; /* bytes */

/* Columns of the list, as wide as their widest cell. */
typedef struct widths {
    int name, unit, range;
} widths;

static void range_text(const glint_brdf_param *p, char out[CELL])
{
    const bool low = isfinite(p->min), high = isfinite(p->max);
    const char *rows = p->dimensions ? " (rows)" : "";
    if (low && high)
        snprintf(out, CELL, "%s%g to %s%g%s", p->min_open ? "above " : "", p->min,
                 p->max_open ? "below " : "", p->max, rows);
    else if (low)
        snprintf(out, CELL, "%s %g%s", p->min_open ? "above" : "from", p->min, rows);
    else if (high)
        snprintf(out, CELL, "%s %g%s", p->max_open ? "below" : "to", p->max, rows);
    else
        snprintf(out, CELL, "any%s", rows);
}

static int wider(int width, const char *text)
{
    const int n = (int)strlen(text);
    return n > width ? n : width;
}

static widths measure(void)
{
    widths w = {0};
    for (size_t k = 0; glint_brdf_name(k); k++) {
        glint_brdf_param p;
        for (size_t j = 0; glint_brdf_parameter(k, j, &p); j++) {
            char range[CELL];
            range_text(&p, range);
            w.name = wider(w.name, p.name);
            w.unit = wider(w.unit, p.unit);
            w.range = wider(w.range, range);
        }
    }
    return w;
}

static void print_parameter(FILE *out, const glint_brdf_param *p, const widths *w)
{
    char range[CELL], standard[CELL];
    range_text(p, range);
    if (p->required)
        snprintf(standard, sizeof standard, "required");
    else if (isnan(p->default_value))
        snprintf(standard, sizeof standard, "optional");
    else
        snprintf(standard, sizeof standard, "default %g", p->default_value);
    fprintf(out, "    %-*s  %-*s  %-*s  %-12s  %s\n", w->name, p->name, w->unit, p->unit, w->range,
            range, standard, p->doc);
}

glint_status cmd_brdf_list(const options *o)
{
    output out;
    glint_error error;
    glint_status status = output_open(&out, o->output, &error);
    if (status == GLINT_OK) {
        const widths w = measure();
        for (size_t k = 0; glint_brdf_name(k); k++) {
            fprintf(out.stream, "%s%s: %s\n    source: %s\n", k ? "\n" : "", glint_brdf_name(k),
                    glint_brdf_doc(k), glint_brdf_source(k));
            glint_brdf_param p;
            for (size_t j = 0; glint_brdf_parameter(k, j, &p); j++)
                print_parameter(out.stream, &p, &w);
        }
        status = output_finish(&out, &error);
    }
    if (status) report_error(&error);
    return status;
}
