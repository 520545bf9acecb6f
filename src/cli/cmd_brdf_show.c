#include "cli/command.h"
#include "cli/output.h"
#include "cli/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_ANGLES = 180 };

static const double DEG = 57.295779513082321; /* per rad */

/* What is shown: materials, and how. */
typedef struct show {
    glint_material **materials; /* owned, each */
    char **labels;              /* owned, each */
    size_t n, capacity;
    double theta_i_deg[MOST_ANGLES];
    glint_material_view view;
} show;

static void show_free(show *s)
{
    for (size_t k = 0; k < s->n; k++) {
        glint_material_free(s->materials[k]);
        free(s->labels[k]);
    }
    free(s->materials);
    free(s->labels);
}

/* ----------------------------------------------------------------- materials */

static bool reserve(show *s)
{
    if (s->n < s->capacity) return true;
    const size_t capacity = s->capacity ? 2 * s->capacity : 8;
    glint_material **materials = realloc(s->materials, capacity * sizeof *materials);
    if (materials) s->materials = materials;
    char **labels = realloc(s->labels, capacity * sizeof *labels);
    if (labels) s->labels = labels;
    if (!materials || !labels) return false;
    s->capacity = capacity;
    return true;
}

/* Reads one material; its label is its name for now. */
static glint_status add_material(show *s, const char *path, const char *name, const char *band,
                                 glint_errors *errors)
{
    glint_material *material;
    const glint_status status = glint_material_read(path, name, band, &material, errors);
    if (status) return status;
    char *label = malloc(strlen(path) + strlen(name) + 2);
    if (!label || !reserve(s)) {
        free(label);
        glint_material_free(material);
        return GLINT_INTERNAL;
    }
    sprintf(label, "%s:%s", path, name);
    for (char *c = label; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 127) *c = '?'; /* what a terminal might obey */
    s->labels[s->n] = label;
    s->materials[s->n++] = material;
    return GLINT_OK;
}

/* All materials of a file. */
static glint_status add_file(show *s, const char *path, const char *band, glint_errors *errors)
{
    const char **names;
    size_t n;
    glint_status worst = glint_material_names(path, &names, &n, errors);
    for (size_t k = 0; k < n; k++) {
        const glint_status status = add_material(s, path, names[k], band, errors);
        if (status > worst) worst = status;
    }
    glint_free(names);
    return worst;
}

/* FILE:NAME, or FILE for all that are in it. A file whose name has a colon is taken whole. */
static glint_status add_operand(show *s, const char *operand, const char *band,
                                glint_errors *errors)
{
    const char *colon = strrchr(operand, ':');
    if (!colon || !colon[1] || access(operand, F_OK) == 0)
        return add_file(s, operand, band, errors);
    char *path = strndup(operand, (size_t)(colon - operand));
    if (!path) return GLINT_INTERNAL;
    const glint_status status = add_material(s, path, colon + 1, band, errors);
    free(path);
    return status;
}

/* Where no other material has the same name, the name is enough. */
static void shorten_labels(show *s)
{
    for (size_t k = 0; k < s->n; k++) {
        const char *name = glint_material_name(s->materials[k]);
        bool alone = true;
        for (size_t j = 0; j < s->n; j++)
            alone = alone && (j == k || strcmp(glint_material_name(s->materials[j]), name) != 0);
        if (alone) strcpy(s->labels[k], name);
    }
}

static glint_status read_materials(show *s, const options *o)
{
    glint_errors *errors = glint_errors_new();
    glint_status worst = GLINT_OK;
    for (size_t k = 0; k < o->n_operands; k++) {
        const glint_status status = add_operand(s, o->operands[k], o->values[OPTION_BAND], errors);
        if (status > worst) worst = status;
    }
    report_errors(errors, worst, o->quiet);
    glint_errors_free(errors);
    shorten_labels(s);
    return worst;
}

/* ---------------------------------------------------------------------- view */

/* The kind of view; GLINT_ARGUMENT where the options want two at once. */
static glint_status find_kind(const options *o, glint_material_view_kind *kind, glint_error *error)
{
    const bool hemisphere = options_has(o, OPTION_HEMISPHERE), dhr = options_has(o, OPTION_DHR);
    const bool angles = options_has(o, OPTION_GEOMETRY);
    const bool incidence = options_has(o, OPTION_INCIDENCE);
    *kind = hemisphere ? GLINT_VIEW_HEMISPHERE
            : angles   ? GLINT_VIEW_ANGLES
            : dhr      ? GLINT_VIEW_DHR
                       : GLINT_VIEW_PLANE;
    if (hemisphere + angles + (dhr || incidence) > 1)
        return error_say(error, GLINT_ARGUMENT,
                         "--incidence (also with --dhr), --hemisphere and --geometry exclude each "
                         "other; expected one of them");
    if (angles && (options_has(o, OPTION_AZIMUTH) || options_has(o, OPTION_STEP)))
        return error_say(error, GLINT_ARGUMENT,
                         "--azimuth and --step do not go with --geometry, which gives all angles");
    if (dhr && options_has(o, OPTION_STEP))
        return error_say(error, GLINT_ARGUMENT,
                         "--step does not go with --dhr; the angles are those of --incidence");
    return GLINT_OK;
}

/* Whether the unit of the angles was said, which for this command can be deg alone. */
static glint_status read_unit(const options *o, bool *given, glint_error *error)
{
    const char *unit = o->values[OPTION_ANGLES];
    *given = unit != NULL;
    if (!unit || strcmp(unit, "deg") == 0) return GLINT_OK;
    return error_say(error, GLINT_ARGUMENT,
                     "--angles has '%s'; 'brdf show' takes angles in deg: expected deg", unit);
}

/* Refuses angles of a list that look like rad: none above pi/2, and not all of them whole tenths,
 * as small angles in deg mostly are. */
static glint_status check_unit(const options *o, option_id id, const show *s, glint_error *error)
{
    static const double MOST = 1.571; /* pi/2, rounded up */
    double most = 0;
    bool all_tenths = true;
    for (size_t k = 0; k < s->view.n_theta_i; k++) {
        const double tenths = 10 * s->theta_i_deg[k];
        if (s->theta_i_deg[k] > most) most = s->theta_i_deg[k];
        all_tenths = all_tenths && fabs(tenths - round(tenths)) < 1e-9;
    }
    if (most > MOST || all_tenths) return GLINT_OK;
    return error_say(error, GLINT_ARGUMENT,
                     "--%s has '%s', which look like radians; expected degrees, or --angles deg "
                     "where degrees are so small",
                     option_get(id)->name, o->values[id]);
}

/* The angles where the options give none: those of the founding paper's curves, or every 5 deg. */
static void default_angles(show *s)
{
    static const double CURVES_DEG[] = {0, 15, 30, 45, 60, 75};
    const bool dhr = s->view.kind == GLINT_VIEW_DHR;
    const size_t n = dhr ? 18 : sizeof CURVES_DEG / sizeof *CURVES_DEG;
    for (size_t k = 0; k < n; k++)
        s->theta_i_deg[k] = dhr ? 5.0 * (double)k : CURVES_DEG[k];
    s->view.n_theta_i = n;
}

static glint_status read_view(show *s, const options *o, glint_error *error)
{
    glint_material_view *v = &s->view;
    glint_status status = find_kind(o, &v->kind, error);
    if (status) return status;
    const bool map = v->kind == GLINT_VIEW_HEMISPHERE;
    const option_id angles = map ? OPTION_HEMISPHERE : OPTION_INCIDENCE;
    v->theta_i_deg = s->theta_i_deg;
    v->step_deg = map ? 2 : 0.5;
    v->angles = o->values[OPTION_GEOMETRY];
    v->logarithmic = options_has(o, OPTION_LOG);
    status = options_numbers(o, angles, 0, 90, s->theta_i_deg, MOST_ANGLES, &v->n_theta_i, error);
    if (!status) status = options_number(o, OPTION_AZIMUTH, -360, 360, &v->phi_i_deg, error);
    if (!status) status = options_number(o, OPTION_STEP, 0.001, 45.001, &v->step_deg, error);
    if (!status) status = read_unit(o, &v->unit_given, error);
    if (!status && !v->unit_given) status = check_unit(o, angles, s, error);
    if (!status && v->n_theta_i == 0) default_angles(s);
    return status;
}

/* ------------------------------------------------------------------- summary */

/* The peaks of the curves, side by side, and what the others have of the first. */
static void report_peaks(const show *s)
{
    for (size_t k = 0; k < s->view.n_theta_i; k++) {
        const double theta_i_deg = s->theta_i_deg[k];
        double first = 0;
        fprintf(stderr, "%s %5g deg:", k ? "     " : "peaks", theta_i_deg);
        for (size_t m = 0; m < s->n; m++) {
            double theta_r, f;
            fprintf(stderr, "%s %s ", m ? ";" : "", s->labels[m]);
            const double mirrored = glint_material_mirrored(s->materials[m], theta_i_deg / DEG);
            if (mirrored > 0) fprintf(stderr, "mirrors %.4g; else ", mirrored);
            if (!glint_material_peak(s->materials[m], theta_i_deg / DEG, s->view.phi_i_deg / DEG,
                                     &theta_r, &f)) {
                fprintf(stderr, "none");
                continue;
            }
            fprintf(stderr, "%.5g per sr at %.2f deg", f, theta_r * DEG);
            if (m > 0 && first > 0) fprintf(stderr, ", ratio %.4f", f / first);
            if (m == 0) first = f;
        }
        putc('\n', stderr);
    }
}

/* -------------------------------------------------------------------- command */

static glint_status write_all(const show *s, const options *o)
{
    glint_errors *errors = glint_errors_new();
    const glint_material *const *materials = (const glint_material *const *)s->materials;
    glint_status status = glint_material_table_write(materials, s->n, &s->view, o->output, errors);
    if (!status && o->plot)
        status = glint_material_plot_write(materials, s->n, &s->view, o->plot, errors);
    if (!(status == GLINT_OUTPUT && !o->output && output_reader_left()))
        report_errors(errors, status, o->quiet);
    glint_errors_free(errors);
    return status;
}

glint_status cmd_brdf_show(const options *o)
{
    show s = {0};
    glint_error error;
    glint_status status = read_view(&s, o, &error);
    if (!status) status = output_check_plot(o->output, o->plot, &error);
    if (status) {
        report_error(&error);
        return status;
    }
    status = read_materials(&s, o);
    s.view.labels = (const char *const *)s.labels;
    if (!status) status = write_all(&s, o);
    if (!status && !o->quiet && s.view.kind == GLINT_VIEW_PLANE) report_peaks(&s);
    show_free(&s);
    return status;
}
