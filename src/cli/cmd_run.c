#include "cli/command.h"
#include "cli/output.h"
#include "cli/report.h"

/* Says where measured materials were used outside of their measurements. */
static void report_unmeasured(const glint_curve *curve, const glint_summary *summary)
{
    const char *material;
    int64_t rows;
    for (size_t k = 0; glint_curve_unmeasured(curve, k, &material, &rows); k++)
        if (rows > 0)
            fprintf(stderr,
                    "unmeasured %s: in %lld of %lld rows parts of it are lit and seen at angles "
                    "that were not measured; the nearest measured values are taken\n",
                    material, (long long)rows, (long long)summary->bright_rows);
}

/* Writes the table and says what came of it. */
static glint_status write_table(glint_curve *curve, const options *o)
{
    glint_summary summary = {0};
    glint_error error = {0};
    progress_bar bar = {0};
    const bool drawn = progress_wanted(o->quiet, o->output != NULL);
    const glint_status status = glint_table_write(curve, o->output, o->plot, &summary,
                                                  drawn ? progress_draw : NULL, &bar, &error);
    progress_end(&bar);
    if (status) return output_fail(o->output, &error);
    if (o->quiet) return GLINT_OK;
    report_summary(&summary);
    report_unmeasured(curve, &summary);
    return status;
}

glint_status cmd_run(const options *o)
{
    glint_error error;
    if (output_check_plot(o->output, o->plot, &error)) {
        report_error(&error);
        return error.status;
    }
    glint_errors *errors = glint_errors_new();
    glint_scenario *scenario = NULL;
    glint_curve *curve = NULL;
    glint_status status =
        glint_scenario_read(o->operands[0], o->overrides, o->n_overrides, &scenario, errors);
    if (status == GLINT_OK) status = glint_curve_open(scenario, o->threads, &curve, errors);
    report_errors(errors, status, o->quiet);
    if (status == GLINT_OK) status = write_table(curve, o);
    glint_curve_close(curve);
    glint_scenario_free(scenario);
    glint_errors_free(errors);
    return status;
}
