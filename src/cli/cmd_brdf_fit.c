#include "cli/command.h"
#include "cli/output.h"
#include "cli/report.h"

#include <string.h>

static const double RAD_PER_DEG = 0.017453292519943295;

/* What stands in place of a standard error. */
static const char *const states[] = {
    [GLINT_FIT_DETERMINED] = "",
    [GLINT_FIT_AT_BOUND] = "at the end of its range",
    [GLINT_FIT_UNDETERMINED] = "undetermined: the measurements do not tell it",
    [GLINT_FIT_TIED] = "as along the tangent",
    [GLINT_FIT_FIXED] = "not fitted",
};

/* ------------------------------------------------------------------- report */

/* How many measurements were fitted to, and why the others were not. `mark` begins every line: "# "
 * where it is a comment, else
 * "". */
static void print_count(FILE *out, const char *mark, const glint_brdf_fits *fits)
{
    glint_brdf_fit_info info;
    glint_brdf_fits_get(fits, 0, &info);
    const size_t n_past = info.n_rows - info.n_dark - info.n_points;
    fprintf(out, "%s%zu measurements, %zu fitted", mark, info.n_rows, info.n_points);
    if (info.n_dark > 0) fprintf(out, "; left out: %zu without light", info.n_dark);
    if (n_past > 0)
        fprintf(out, "%s%zu more than %.10g deg from the normal",
                info.n_dark ? ", " : "; left out: ", n_past, info.max_zenith_rad / RAD_PER_DEG);
    fprintf(out, "\n%.1s\n", mark);
}

static void print_ranking(FILE *out, const char *mark, const glint_brdf_fits *fits)
{
    int width = (int)strlen("model");
    glint_brdf_fit_info info;
    for (size_t k = 0; glint_brdf_fits_get(fits, k, &info); k++) {
        const int n = (int)strlen(info.model);
        if (n > width) width = n;
    }
    fprintf(out, "%srank  %-*s  rms (dex)  parameters        AIC        BIC\n", mark, width,
            "model");
    for (size_t k = 0; glint_brdf_fits_get(fits, k, &info); k++)
        fprintf(out, "%s%4zu  %-*s  %9.4g  %10zu  %9.1f  %9.1f\n", mark, k + 1, width, info.model,
                info.rms_dex, info.n_free, info.aic, info.bic);
}

static void print_parameters(FILE *out, const char *mark, const glint_brdf_fits *fits, size_t k)
{
    glint_brdf_fit_info info;
    glint_brdf_fit_parameter p;
    int lobe = -1;
    glint_brdf_fits_get(fits, k, &info);
    fprintf(out, "%.1s\n%s%s: rms %.4g dex, material '%s'\n", mark, mark, info.model, info.rms_dex,
            info.material);
    for (size_t j = 0; glint_brdf_fits_parameter(fits, k, j, &p); j++) {
        fprintf(out, "%s    %-18s %-10s %-14.12g", mark, p.lobe == lobe ? "" : p.model, p.name,
                p.value);
        lobe = p.lobe;
        if (p.state == GLINT_FIT_DETERMINED)
            fprintf(out, " +- %.2g%s%s\n", p.standard_error, p.unit[0] ? " " : "", p.unit);
        else
            fprintf(out, " %s\n", states[p.state]);
    }
}

static void print_report(FILE *out, const char *mark, const glint_brdf_fits *fits)
{
    glint_brdf_fit_info info;
    print_count(out, mark, fits);
    print_ranking(out, mark, fits);
    for (size_t k = 0; glint_brdf_fits_get(fits, k, &info); k++)
        print_parameters(out, mark, fits, k);
}

/* Writes the materials with the report as comments before them, so that the whole can stand in a
 * file of materials; where they go to a file, the report is printed, too. */
static glint_status write_fits(const glint_brdf_fits *fits, const options *o, glint_error *error)
{
    output out;
    char *toml;
    glint_status status = glint_brdf_fits_toml(fits, &toml, error);
    if (status) return status;
    status = output_open(&out, o->output, error);
    if (status == GLINT_OK) {
        print_report(out.stream, "# ", fits);
        fprintf(out.stream, "\n%s", toml);
        status = output_finish(&out, error);
        if (o->output && status == GLINT_OK) print_report(stdout, "", fits);
    }
    glint_free(toml);
    return status;
}

/* ------------------------------------------------------------------ command */

static glint_status read_angles(const options *o, bool *radians, glint_error *error)
{
    const char *unit = o->values[OPTION_ANGLES];
    *radians = unit && strcmp(unit, "rad") == 0;
    if (!unit || *radians || strcmp(unit, "deg") == 0) return GLINT_OK;
    return error_say(error, GLINT_ARGUMENT, "--angles has '%s'; expected deg or rad", unit);
}

static glint_status read_options(const options *o, glint_brdf_layout *layout,
                                 glint_brdf_fit_options *fit, glint_error *error)
{
    double max_zenith_deg = 0.0;
    *layout = (glint_brdf_layout){.columns = o->values[OPTION_COLUMNS],
                                  .signed_zenith = options_has(o, OPTION_SIGNED_ZENITH)};
    *fit = (glint_brdf_fit_options){.anisotropic = options_has(o, OPTION_ANISOTROPIC)};
    if (!o->values[OPTION_MODEL])
        return error_say(error, GLINT_ARGUMENT,
                         "no model is given; expected --model with sums of the models of `glint "
                         "brdf list`, as in --model ward,lambert+abg");
    glint_status status = read_angles(o, &layout->radians, error);
    layout->unit_given = options_has(o, OPTION_ANGLES);
    if (!status) status = options_number(o, OPTION_FLOOR, 0.0, 1e300, &layout->floor, error);
    if (!status) status = options_number(o, OPTION_MAX_ZENITH, 1.0, 90.0, &max_zenith_deg, error);
    fit->max_zenith_rad = max_zenith_deg * RAD_PER_DEG;
    if (!status) status = output_check_plot(o->output, o->plot, error);
    return status;
}

glint_status cmd_brdf_fit(const options *o)
{
    glint_brdf_layout layout;
    glint_brdf_fit_options fit;
    glint_brdf_fits *fits = NULL;
    glint_error error;
    glint_status status = read_options(o, &layout, &fit, &error);
    if (status) {
        report_error(&error);
        return status;
    }
    glint_errors *errors = glint_errors_new();
    status = glint_brdf_fit(o->operands[0], &layout, o->values[OPTION_MODEL], &fit, &fits, errors);
    report_errors(errors, status, o->quiet);
    glint_errors_free(errors);
    if (status) return status;
    status = write_fits(fits, o, &error);
    if (!status && o->plot) status = glint_brdf_fits_plot(fits, o->plot, &error);
    if (status) report_error(&error);
    glint_brdf_fits_free(fits);
    return status;
}
