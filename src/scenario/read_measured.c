/* read_measured.c: the keys of a measured BRDF.
 *
 * file = "panel.csv"                        # relative to the file that names it
 * columns = { theta_i = 1, phi_i = 2, theta_r = 3, phi_r = 4, f = 5 }    # numbers, or names of the
 *                                           # header; absent: the header has these names
 * signed_zenith = true                      # theta may be negative
 * angles = "deg"                            # or "rad"
 * floor_per_sr = 1e-4                       # rows with f at or below it are left out */
#include "scenario/read_measured.h"

#include "base/text.h"
#include "brdf/table.h"

#include <stdlib.h>

/* What `columns` says of one quantity. */
static void read_column(reader *r, int quantity, measured_column *out)
{
    enum { MOST = 256 };
    const toml_node *node = reader_find(r, measured_name(quantity));
    if (!node) return;
    out->where = node->where;
    if (node->type == TOML_STRING && node->string[0])
        out->name = node->string;
    else if (node->type == TOML_INTEGER && node->integer >= 1 && node->integer <= MOST)
        out->number = (int)node->integer;
    else
        reader_fail(r, node->where,
                    "'%s' is not a column; expected its number from 1 to %d or its name in the "
                    "header",
                    measured_name(quantity), MOST);
}

static void read_columns(reader *r, measured_format *format)
{
    const toml_node *node = reader_table(r, "columns", false);
    if (!node) return;
    reader inner = reader_start(node, "'columns'", r->errors);
    for (int q = 0; q < MEASURED_COLUMNS; q++) {
        read_column(&inner, q, &format->column[q]);
        if (!format->column[q].where.file) format->column[q].where = node->where;
    }
    if (reader_done(&inner) > r->status) r->status = inner.status;
}

static void read_format(reader *r, measured_format *format)
{
    static const char *const UNITS[] = {"deg", "rad"};
    int unit;
    read_columns(r, format);
    reader_boolean(r, "signed_zenith", false, &format->signed_zenith);
    reader_choice(r, "angles", UNITS, 2, 0, &unit);
    format->radians = unit == 1;
}

static glint_status read_file(const char *path, place asked_from, const measured_format *format,
                              brdf_lobe *lobe, glint_errors *errors)
{
    measured rows;
    glint_error error;
    glint_status status = measured_read(path, asked_from, format, &rows, errors);
    if (status) return status;
    status = table_prepare(&rows, lobe, &error);
    measured_free(&rows);
    return status ? errors_take(errors, &error, asked_from) : GLINT_OK;
}

void read_measured(reader *r, brdf_lobe *lobe)
{
    measured_format format = {.floor = lobe->params[TABLE_FLOOR]};
    const char *name;
    read_format(r, &format);
    if (!reader_string(r, "file", true, &name) || r->status) return;
    const place where = reader_place(r, "file");
    char *path = path_beside(where.file, name);
    if (path)
        r->status = read_file(path, where, &format, lobe, r->errors);
    else
        r->status = errors_add(r->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    free(path);
}

void warn_of_measured(const brdf_material *material, const char *name, place where,
                      glint_errors *errors)
{
    static const double WHOLE = 0.995; /* found to about 1 % */
    for (int k = 0; k < material->n_lobes; k++) {
        if (!(material->lobes[k].model->flags & BRDF_MEASURED)) continue;
        table_facts facts;
        table_describe(&material->lobes[k], &facts);
        const double percent = 100.0 * facts.covered;
        if (facts.in_plane)
            errors_warn(
                errors, where,
                "material '%s' was measured in the plane of incidence only, and is used "
                "out of it as if f did not depend on phi_d; so %.0f %% of the hemisphere lie "
                "between its measurements, and elsewhere the nearest values hold",
                name, percent);
        else if (facts.covered < WHOLE)
            errors_warn(errors, where,
                        "material '%s' was measured in a part of the hemisphere: %.0f %% lie "
                        "between its measurements, and elsewhere the nearest values hold",
                        name, percent);
    }
}
