#include "cli/command.h"
#include "cli/output.h"
#include "cli/report.h"

static glint_status compare(const glint_scenario *scenario, const options *o)
{
    glint_error error = {0};
    glint_comparison *comparison = NULL;
    glint_status status = output_check(scenario, o->output, &error);
    if (!status) status = output_check(scenario, o->plot, &error);
    if (!status) status = glint_compare(scenario, o->threads, &comparison, &error);
    if (!status)
        status = glint_comparison_write(comparison, options_format(o, GLINT_FORMAT_TABLE),
                                        o->output, &error);
    if (!status && o->plot) status = glint_comparison_plot(comparison, o->threads, o->plot, &error);
    glint_comparison_free(comparison);
    return status ? output_fail(o->output, &error) : GLINT_OK;
}

glint_status cmd_compare(const options *o)
{
    glint_error error;
    if (output_check_plot(o->output, o->plot, &error)) {
        report_error(&error);
        return error.status;
    }
    glint_errors *errors = glint_errors_new();
    glint_scenario *scenario = NULL;
    glint_status status =
        glint_scenario_read(o->operands[0], o->overrides, o->n_overrides, &scenario, errors);
    report_errors(errors, status, o->quiet);
    glint_errors_free(errors);
    if (status == GLINT_OK) status = compare(scenario, o);
    glint_scenario_free(scenario);
    return status;
}
