/* read_measured.c: the keys of a measured BRDF.
 *
 * file = "panel.csv"                        # relative to the file that names it
 * columns = { theta_i = 1, phi_i = 2, theta_r = 3, phi_r = 4, f = 5 }    # numbers, or names of the
 *                                           # header; absent: the header has these names
 * signed_zenith = true                      # theta may be negative
 * angles = "deg"                            # or "rad"; where absent, deg that look like rad are
 *                                           # refused
 * floor_per_sr = 1e-4                       # rows with f at or below it are left out */
#include "scenario/read_measured.h"

#include "base/text.h"
#include "brdf/table.h"

#include <stdlib.h>
#include <string.h>

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
    format->unit_given = reader_choice(r, "angles", UNITS, 2, 0, &unit);
    format->radians = unit == 1;
}

/* ------------------------------------------------------------------- cache */

/* A file as it was read, and the table that came of it. */
typedef struct measured_source {
    char *path; /* owned */
    measured_format format;
    double *numbers; /* owned; n of them: of the lobe */
    size_t n;
} measured_source;

void measured_cache_free(measured_cache *cache)
{
    for (int k = 0; k < cache->n; k++) {
        free(cache->items[k].path);
        free(cache->items[k].numbers);
    }
    free(cache->items);
    *cache = (measured_cache){0};
}

static bool same_format(const measured_format *a, const measured_format *b)
{
    for (int q = 0; q < MEASURED_COLUMNS; q++) {
        const measured_column *x = &a->column[q], *y = &b->column[q];
        if (!x->name != !y->name || (x->name && !string_equal(x->name, y->name)) ||
            x->number != y->number)
            return false;
    }
    return a->signed_zenith == b->signed_zenith && a->radians == b->radians &&
           a->unit_given == b->unit_given && a->floor == b->floor;
}

static double *copy_numbers(const double *numbers, size_t n)
{
    double *copy = malloc(n * sizeof *copy);
    if (copy) memcpy(copy, numbers, n * sizeof *copy);
    return copy;
}

/* Gives the lobe what is known of that file; false where nothing is, or memory is out. */
static bool take_known(const measured_cache *cache, const char *path, const measured_format *format,
                       brdf_lobe *lobe)
{
    for (int k = 0; k < cache->n; k++) {
        const measured_source *known = &cache->items[k];
        if (!string_equal(known->path, path) || !same_format(&known->format, format)) continue;
        lobe->numbers = copy_numbers(known->numbers, known->n);
        lobe->n_numbers = lobe->numbers ? known->n : 0;
        return lobe->numbers != NULL;
    }
    return false;
}

/* Keeps what a file came to; without memory for it, it is read again. */
static void keep(measured_cache *cache, const char *path, const measured_format *format,
                 const brdf_lobe *lobe)
{
    const size_t n = (size_t)cache->n + 1;
    measured_source *items = realloc(cache->items, n * sizeof *items);
    if (!items) return;
    cache->items = items;
    measured_source *next = &items[cache->n];
    *next = (measured_source){.path = string_copy(path, strlen(path)),
                              .format = *format,
                              .numbers = copy_numbers(lobe->numbers, lobe->n_numbers),
                              .n = lobe->n_numbers};
    if (next->path && next->numbers) {
        cache->n++;
        return;
    }
    free(next->path);
    free(next->numbers);
}

/* -------------------------------------------------------------------- file */

/* Makes the table of rows that are sound together. */
static glint_status make_table(const measured *rows, const char *path, place asked_from,
                               brdf_lobe *lobe, glint_errors *errors)
{
    enum { FEWEST = 3 }; /* places */
    glint_error error;
    glint_status status = measured_check(rows, path, errors);
    if (status) return status;
    status = table_prepare(rows, lobe, &error);
    if (status) return errors_take(errors, &error, asked_from);
    table_facts facts;
    table_describe(lobe, &facts);
    if (facts.n_nodes >= FEWEST) return GLINT_OK;
    return errors_add(errors, GLINT_INPUT, (place){path, 0, 0},
                      "the %d rows measure %d place%s of an isotropic and reciprocal surface; "
                      "expected at least %d, or there is nothing to interpolate",
                      facts.n_rows, facts.n_nodes, facts.n_nodes == 1 ? "" : "s", FEWEST);
}

static glint_status read_file(const char *path, place asked_from, const measured_format *format,
                              brdf_lobe *lobe, glint_errors *errors)
{
    measured rows;
    glint_status status = measured_read(path, asked_from, format, &rows, errors);
    if (status) return status;
    status = make_table(&rows, path, asked_from, lobe, errors);
    measured_free(&rows);
    return status;
}

void read_measured(reader *r, measured_cache *cache, brdf_lobe *lobe)
{
    measured_format format = {.floor = lobe->params[TABLE_FLOOR]};
    const char *name;
    read_format(r, &format);
    if (!reader_string(r, "file", true, &name) || r->status) return;
    const place where = reader_place(r, "file");
    char *path = path_beside(where.file, name);
    if (!path || (cache->files && !file_list_add(cache->files, path))) {
        r->status = errors_add(r->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
    } else if (!take_known(cache, path, &format, lobe)) {
        r->status = read_file(path, where, &format, lobe, r->errors);
        if (r->status == GLINT_OK) keep(cache, path, &format, lobe);
    }
    free(path);
}

void warn_of_measured(const brdf_material *material, const char *name, place where,
                      glint_errors *errors)
{
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
        else if (!facts.whole)
            errors_warn(errors, where,
                        "material '%s' was measured in a part of the hemisphere: %.0f %% lie "
                        "between its measurements, and elsewhere the nearest values hold",
                        name, percent);
    }
}
