#include "cli/command.h"
#include "cli/output.h"
#include "cli/report.h"

static glint_status find(const options *o, glint_shares **out)
{
    const glint_changes changes = {o->swaps, o->n_swaps, o->without, o->n_without};
    glint_errors *errors = glint_errors_new();
    progress_bar bar = {0};
    const bool drawn = progress_wanted(o->quiet, true);
    const glint_status status =
        glint_shares_find(o->operands[0], o->overrides, o->n_overrides, &changes, o->threads,
                          drawn ? progress_draw : NULL, &bar, out, errors);
    progress_end(&bar);
    report_errors(errors, status, o->quiet);
    glint_errors_free(errors);
    return status;
}

glint_status cmd_shares(const options *o)
{
    glint_error error = {0};
    if (output_check_plot(o->output, o->plot, &error)) {
        report_error(&error);
        return error.status;
    }
    glint_shares *shares = NULL;
    glint_status status = find(o, &shares);
    if (status) return status;
    status = output_check(glint_shares_scenario(shares, false), o->output, &error);
    if (!status) status = output_check(glint_shares_scenario(shares, false), o->plot, &error);
    if (!status)
        status =
            glint_shares_write(shares, options_format(o, GLINT_FORMAT_TABLE), o->output, &error);
    if (!status && o->plot) status = glint_shares_plot(shares, o->threads, o->plot, &error);
    glint_shares_free(shares);
    return status ? output_fail(o->output, &error) : GLINT_OK;
}
