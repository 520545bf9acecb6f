/* material_table.c: what is shown of materials, as a table with an ECSV header. */
#include "base/constants.h"
#include "output/ecsv.h"
#include "output/file.h"
#include "output/material_view.h"

#include <string.h>

/* What the rows of a view hold, in the order of columns. */
static const glint_column MATERIAL = {"material", "", "name of the material", true};
static const glint_column ANGLES[] = {
    {"theta_i_deg", "deg", "of the incident light, from the normal", false},
    {"phi_i_deg", "deg", "of the incident light, from the tangent", false},
    {"theta_r_deg", "deg", "of the reflected light, from the normal", false},
    {"phi_r_deg", "deg", "of the reflected light, from the tangent", false},
};
static const glint_column SIGNED = {"signed_theta_r_deg", "deg",
                                    "theta_r, positive on the mirror side", false};
static const glint_column VALUES[] = {
    {"f_per_sr", "1/sr", "BRDF; 0 where a direction lies below the horizon", false},
    {"g_per_sr", "1/sr", "f cos(theta_i) cos(theta_r), of which a light curve is the sum", false},
};
static const glint_column REFLECTANCES[] = {
    {"dhr", "", "directional-hemispherical reflectance", false},
    {"dhr_error", "", "estimate of its absolute error", false},
};

enum { MOST_COLUMNS = 8 };

static size_t find_columns(glint_material_view_kind kind, glint_column out[MOST_COLUMNS])
{
    const bool is_dhr = kind == GLINT_VIEW_DHR;
    const size_t n_angles = is_dhr ? 2 : 4;
    size_t n = 0;
    out[n++] = MATERIAL;
    for (size_t k = 0; k < n_angles; k++)
        out[n++] = ANGLES[k];
    if (kind == GLINT_VIEW_PLANE) out[n++] = SIGNED;
    for (size_t k = 0; k < 2; k++)
        out[n++] = is_dhr ? REFLECTANCES[k] : VALUES[k];
    return n;
}

static const char *doc_of(glint_material_view_kind kind)
{
    switch (kind) {
    case GLINT_VIEW_PLANE:
        return "BRDF in the plane of incidence";
    case GLINT_VIEW_HEMISPHERE:
        return "BRDF over the hemisphere";
    case GLINT_VIEW_ANGLES:
        return "BRDF at the angles of a file";
    case GLINT_VIEW_DHR:
        return "directional-hemispherical reflectance";
    }
    return "";
}

/* One line about a material: "panel: ward rho_d=0.17 ...; Huang et al. 2013". */
static void write_material(const char *label, const glint_material *material, text *header)
{
    text line = {0};
    const char *band = glint_material_band(material), *source = glint_material_source(material);
    text_printf(&line, "%s: %s", label, glint_material_model(material));
    if (band[0]) text_printf(&line, ", in band %s", band);
    if (source[0]) text_printf(&line, "; %s", source);
    if (line.failed)
        header->failed = true;
    else
        ecsv_item(header, line.data, line.length);
    text_free(&line);
}

static void write_header(const glint_material *const *materials, size_t n,
                         const glint_material_view *view, text *t)
{
    glint_column columns[MOST_COLUMNS];
    const size_t n_columns = find_columns(view->kind, columns);
    ecsv_begin(t, columns, n_columns);
    ecsv_fact(t, "glint_version", glint_version());
    ecsv_fact(t, "shown", doc_of(view->kind));
    if (view->kind == GLINT_VIEW_ANGLES) ecsv_fact(t, "angles", view->angles);
    ecsv_list(t, "materials");
    for (size_t k = 0; k < n; k++)
        write_material(view_label(view, materials, k), materials[k], t);
    ecsv_end(t, columns, n_columns);
}

static void write_number(text *t, double value)
{
    text_char(t, ',');
    text_double(t, value);
}

/* Writes a row; true where its value was not measured. */
static bool write_value(const glint_material_view *view, const char *label,
                        const glint_material *material, const view_point *p, text *t)
{
    const double f = view_point_brdf(material, p);
    ecsv_cell(t, label);
    write_number(t, p->theta_i_deg);
    write_number(t, p->phi_i_deg);
    write_number(t, p->theta_r_deg);
    write_number(t, p->phi_r_deg);
    if (view->kind == GLINT_VIEW_PLANE) write_number(t, p->signed_theta_r_deg);
    write_number(t, f);
    write_number(t, view_point_g(p, f));
    text_char(t, '\n');
    return view_point_is_unmeasured(material, p, f);
}

static glint_status write_reflectance(const char *label, const glint_material *material,
                                      const view_point *p, text *t, glint_errors *errors)
{
    double dhr, bound;
    const glint_status status = view_point_dhr(label, material, p, &dhr, &bound, errors);
    if (status) return status;
    ecsv_cell(t, label);
    write_number(t, p->theta_i_deg);
    write_number(t, p->phi_i_deg);
    write_number(t, dhr);
    write_number(t, bound);
    text_char(t, '\n');
    return GLINT_OK;
}

/* Writes what has been collected, and empties it. */
static glint_status flush(text *t, out_file *file, glint_errors *errors)
{
    glint_error error;
    glint_status status = t->failed ? error_no_memory(&error) : GLINT_OK;
    if (!status && t->length > 0) status = out_file_write(file, t->data, t->length, &error);
    text_clear(t);
    return status ? errors_take(errors, &error, PLACE_NONE) : GLINT_OK;
}

/* The rows of one material. */
static glint_status write_rows(const glint_material_view *view, const char *label,
                               const glint_material *material, const view_points *points, text *t,
                               out_file *file, glint_errors *errors)
{
    enum { AT_ONCE = 1 << 16 }; /* bytes */
    long n = 0, n_unmeasured = 0;
    for (size_t k = 0; k < points->n; k++) {
        const view_point *p = &points->items[k];
        /* the normal is one direction, whatever its azimuth */
        const bool again =
            view->kind == GLINT_VIEW_HEMISPHERE && p->theta_r_deg == 0 && k % points->n_phi != 0;
        glint_status status = GLINT_OK;
        if (again) continue;
        if (view->kind == GLINT_VIEW_DHR)
            status = write_reflectance(label, material, p, t, errors);
        else
            n_unmeasured += write_value(view, label, material, p, t);
        n++;
        if (!status && t->length > AT_ONCE) status = flush(t, file, errors);
        if (status) return status;
    }
    if (n_unmeasured > 0)
        errors_warn(errors, PLACE_NONE,
                    "%ld of the %ld values of '%s' lie outside of what was measured, and are the "
                    "nearest measured ones",
                    n_unmeasured, n, label);
    return flush(t, file, errors);
}

static glint_status write_all(const glint_material *const *materials, size_t n,
                              const glint_material_view *view, const view_points *points,
                              out_file *file, glint_errors *errors)
{
    text t = {0};
    glint_status status = GLINT_OK;
    write_header(materials, n, view, &t);
    for (size_t k = 0; k < n && !status; k++)
        status = write_rows(view, view_label(view, materials, k), materials[k], points, &t, file,
                            errors);
    if (!status) status = flush(&t, file, errors);
    text_free(&t);
    return status;
}

/* Says what f leaves out. */
static void warn_of_mirrors(const glint_material *const *materials, size_t n,
                            const glint_material_view *view, glint_errors *errors)
{
    if (view->kind == GLINT_VIEW_DHR) return;
    for (size_t k = 0; k < n; k++) {
        const double part = glint_material_mirrored(materials[k], 0);
        if (part > 0)
            errors_warn(errors, PLACE_NONE,
                        "'%s' is a perfect mirror for %.4g of the light at normal incidence: that "
                        "goes into one direction alone and is not in f; --dhr counts it",
                        view_label(view, materials, k), part);
    }
}

glint_status glint_material_table_write(const glint_material *const *materials, size_t n,
                                        const glint_material_view *view, const char *path,
                                        glint_errors *errors)
{
    view_points points;
    glint_status status = view_points_make(view, &points, errors);
    if (status) return status;
    warn_of_mirrors(materials, n, view, errors);
    out_file *file;
    glint_error error;
    status = out_file_open(path, &file, &error);
    if (status) {
        errors_take(errors, &error, PLACE_NONE);
    } else {
        status = write_all(materials, n, view, &points, file, errors);
        if (status)
            out_file_abandon(file);
        else if ((status = out_file_commit(file, &error)))
            errors_take(errors, &error, PLACE_NONE);
    }
    view_points_free(&points);
    return status;
}
