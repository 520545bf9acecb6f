#include "cli/command.h"
#include "cli/output.h"
#include "cli/report.h"

static glint_status check_file(const char *path, const options *o, FILE *out)
{
    glint_errors *errors = glint_errors_new();
    char *report = NULL;
    const glint_status status = glint_check(path, o->overrides, o->n_overrides, &report, errors);
    if (report) fputs(report, out);
    fflush(stdout); /* keeps the order where both streams go to one place */
    report_errors(errors, status, o->quiet);
    glint_free(report);
    glint_errors_free(errors);
    return status;
}

glint_status cmd_check(const options *o)
{
    output out;
    glint_error error;
    glint_status worst = output_open(&out, o->output, &error);
    if (worst) {
        report_error(&error);
        return worst;
    }
    for (size_t k = 0; k < o->n_operands; k++) {
        if (k > 0) fputc('\n', out.stream);
        const glint_status status = check_file(o->operands[k], o, out.stream);
        if (status > worst) worst = status;
    }
    const glint_status written = output_finish(&out, &error);
    if (written) report_error(&error);
    return written > worst ? written : worst;
}
