#include "cli/command.h"
#include "cli/output.h"
#include "cli/report.h"

static glint_status write_ephemeris(const glint_scenario *scenario, const options *o)
{
    glint_ephemeris *ephemeris = NULL;
    glint_error error = {0};
    progress_bar bar = {0};
    const bool drawn = progress_wanted(o->quiet, o->output != NULL);
    glint_status status = glint_ephemeris_open(scenario, o->threads, &ephemeris, &error);
    if (status == GLINT_OK)
        status = glint_ephemeris_write(ephemeris, options_format(o, GLINT_FORMAT_CSV), o->output,
                                       drawn ? progress_draw : NULL, &bar, &error);
    progress_end(&bar);
    glint_ephemeris_close(ephemeris);
    return status ? output_fail(o->output, &error) : GLINT_OK;
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
