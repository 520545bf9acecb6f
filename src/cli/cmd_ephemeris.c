#include "cli/command.h"
#include "cli/output.h"
#include "cli/report.h"

#include <string.h>

static glint_format format_of(const options *o)
{
    if (!o->format || strcmp(o->format, "csv") == 0) return GLINT_FORMAT_CSV;
    return strcmp(o->format, "json") == 0 ? GLINT_FORMAT_JSON : GLINT_FORMAT_TABLE;
}

static glint_status write_ephemeris(const glint_scenario *scenario, const options *o)
{
    glint_ephemeris *ephemeris = NULL;
    glint_error error = {0};
    progress_bar bar = {0};
    const bool drawn = progress_wanted(o->quiet, o->output != NULL);
    glint_status status = glint_ephemeris_open(scenario, o->threads, &ephemeris, &error);
    if (status == GLINT_OK)
        status = glint_ephemeris_write(ephemeris, format_of(o), o->output,
                                       drawn ? progress_draw : NULL, &bar, &error);
    progress_end(&bar);
    glint_ephemeris_close(ephemeris);
    if (status == GLINT_OUTPUT && !o->output && output_reader_left()) return status;
    if (status) report_error(&error);
    return status;
}

glint_status cmd_ephemeris(const options *o)
{
    glint_errors *errors = glint_errors_new();
    glint_scenario *scenario = NULL;
    glint_status status =
        glint_scenario_read_orbit(o->operands[0], o->overrides, o->n_overrides, &scenario, errors);
    report_errors(errors, status, o->quiet);
    glint_errors_free(errors);
    if (status == GLINT_OK) status = write_ephemeris(scenario, o);
    glint_scenario_free(scenario);
    return status;
}
