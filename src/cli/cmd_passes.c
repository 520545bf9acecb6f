#include "cli/command.h"
#include "cli/output.h"
#include "cli/report.h"

#include <stdlib.h>

static const double RAD_PER_DEG = 0.017453292519943295;

/* The scenarios of a command line and their passes. */
typedef struct found {
    glint_scenario **scenarios; /* owned, with what they hold */
    glint_passes **passes;      /* owned, likewise */
    size_t n;
} found;

static void found_free(found *f)
{
    for (size_t k = 0; k < f->n; k++) {
        if (f->passes) glint_passes_free(f->passes[k]);
        if (f->scenarios) glint_scenario_free(f->scenarios[k]);
    }
    free(f->passes);
    free(f->scenarios);
}

/* Reads all scenarios, so that what is wrong in any of them is said before the work begins. */
static glint_status read_all(const options *o, found *f)
{
    glint_status worst = GLINT_OK;
    for (size_t k = 0; k < f->n; k++) {
        glint_errors *errors = glint_errors_new();
        glint_error error = {0};
        glint_status status = glint_scenario_read_orbit(o->operands[k], o->overrides,
                                                        o->n_overrides, &f->scenarios[k], errors);
        report_errors(errors, status, o->quiet);
        glint_errors_free(errors);
        if (status == GLINT_OK && glint_passes_check(f->scenarios[k], &error)) {
            report_error(&error);
            status = error.status;
        }
        if (status > worst) worst = status;
    }
    return worst;
}

static glint_status find_all(const options *o, double flash_angle, found *f, glint_error *error)
{
    const glint_pass_options wanted = {flash_angle, o->threads};
    for (size_t k = 0; k < f->n; k++) {
        const glint_status status =
            glint_passes_find(f->scenarios[k], &wanted, &f->passes[k], error);
        if (status) return status;
    }
    return GLINT_OK;
}

glint_status cmd_passes(const options *o)
{
    glint_error error = {0};
    double flash_angle_deg = 1;
    if (options_number(o, OPTION_FLASH_ANGLE, GLINT_FLASH_ANGLE_MIN_DEG, GLINT_FLASH_ANGLE_MAX_DEG,
                       &flash_angle_deg, &error))
        return output_fail(o->output, &error);
    found f = {calloc(o->n_operands, sizeof(glint_scenario *)),
               calloc(o->n_operands, sizeof(glint_passes *)), o->n_operands};
    glint_status status = GLINT_OK;
    if (!f.scenarios || !f.passes) {
        error_say(&error, GLINT_INTERNAL, "out of memory");
        status = output_fail(o->output, &error);
    }
    if (status == GLINT_OK) status = read_all(o, &f);
    if (status == GLINT_OK) {
        status = find_all(o, flash_angle_deg * RAD_PER_DEG, &f, &error);
        if (status == GLINT_OK)
            status = glint_passes_write((const glint_passes *const *)f.passes, f.n,
                                        options_format(o, GLINT_FORMAT_TABLE), o->output, &error);
        if (status) output_fail(o->output, &error);
    }
    found_free(&f);
    return status;
}
