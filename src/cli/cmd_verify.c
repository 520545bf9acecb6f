#include "cli/command.h"
#include "cli/output.h"
#include "cli/report.h"

#include <string.h>

/* What has been verified so far. */
typedef struct tally {
    long long files, good_files, expectations;
} tally;

static glint_status verify_file(const char *path, const options *o, FILE *out, tally *done)
{
    glint_errors *errors = glint_errors_new();
    glint_verdict verdict = {0};
    const glint_status status =
        glint_verify(path, o->overrides, o->n_overrides, o->threads, &verdict, errors);
    if (status == GLINT_OK)
        fprintf(out, "ok    %s: %lld expectation%s\n", path, (long long)verdict.expectations,
                verdict.expectations == 1 ? "" : "s");
    else if (verdict.deviations > 0)
        fprintf(out, "FAIL  %s: %lld of %lld expectations not met\n", path,
                (long long)verdict.deviations, (long long)verdict.expectations);
    else
        fprintf(out, "FAIL  %s: could not be verified\n", path);
    for (const char *line = verdict.requirements; line && *line;) {
        const int n = (int)strcspn(line, "\n");
        fprintf(out, "      %.*s\n", n, line);
        line += n + (line[n] == '\n');
    }
    glint_free(verdict.requirements);
    fflush(stdout); /* keeps the order where both streams go to one place */
    report_errors(errors, status, o->quiet);
    glint_errors_free(errors);
    done->files++;
    done->good_files += status == GLINT_OK;
    done->expectations += verdict.expectations;
    return status;
}

glint_status cmd_verify(const options *o)
{
    output out;
    glint_error error;
    tally done = {0};
    glint_status worst = output_open(&out, o->output, &error);
    if (worst) {
        report_error(&error);
        return worst;
    }
    for (size_t k = 0; k < o->n_operands; k++) {
        const glint_status status = verify_file(o->operands[k], o, out.stream, &done);
        if (status > worst) worst = status;
    }
    const glint_status written = output_finish(&out, &error);
    if (written) report_error(&error);
    if (!o->quiet)
        fprintf(stderr, "%lld of %lld file%s as expected, %lld expectation%s compared\n",
                done.good_files, done.files, done.files == 1 ? "" : "s", done.expectations,
                done.expectations == 1 ? "" : "s");
    return written > worst ? written : worst;
}
