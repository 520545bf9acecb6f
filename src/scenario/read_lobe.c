/* read_lobe.c: the parameters of one lobe.
 *
 * spectrum = [ { wavelength_um = 0.45, rho_d = 0.1 }, { wavelength_um = 0.7, rho_d = 0.2 } ]
 *
 * Each entry gives the same parameters at its wavelength, the wavelengths in rising order. A band
 * takes a number linearly between the two entries around its pivot wavelength; outside, that of the
 * nearest. Keys of [materials.NAME.bands.X] win over the spectrum, the spectrum over the material's
 * own. A band that names another `brdf` has no spectrum. In an entry wavelength_um is always the
 * entry's place, also where the model has a parameter of that name (the Ward models), which a
 * spectrum therefore cannot change. */
#include "scenario/read_lobe.h"

#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char PLACE_KEY[] = "wavelength_um";
static const param_info PLACE_PARAM = {"wavelength_um", "um",          "", 0, 1000,
                                       PARAM_REQUIRED,  PARAM_MIN_OPEN}; /* 1 mm: past any Sun */

static bool can_vary(const param_info *p)
{
    return !(p->flags & PARAM_ROWS) && !string_equal(p->name, PLACE_KEY);
}

/* ------------------------------------------------------------------ spectra */

static double entry_um(const toml_node *spectrum, int k)
{
    return toml_child(&spectrum->children[k], PLACE_KEY)->number;
}

/* Checks an entry's keys, and that they are those of the first. */
static void check_entry(reader *r, const brdf_model *model, const toml_node *spectrum, int k)
{
    const toml_node *entry = &spectrum->children[k], *first = &spectrum->children[0];
    reader inner = reader_start(entry, "an entry of the spectrum", r->errors);
    double value;
    reader_param(&inner, &PLACE_PARAM, &value);
    for (int j = 0; j < model->n_params; j++) {
        const param_info *p = &model->params[j];
        if (!can_vary(p)) continue;
        const toml_node *found = reader_find(&inner, p->name);
        if (found) reader_param(&inner, p, &value);
        if (!found != !toml_child(first, p->name))
            reader_fail(&inner, entry->where,
                        "'%s' stands in some entries of the spectrum only; expected it in all or "
                        "in none",
                        p->name);
    }
    if (reader_done(&inner) > r->status) r->status = inner.status;
}

/* Whether the overlay names a model of its own: the table's spectrum is not for that. */
static bool names_model(const toml_node *overlay)
{
    return overlay && toml_child(overlay, "brdf");
}

/* Checks the whole spectrum and returns it; NULL when there is none to be used. */
static const toml_node *check_spectrum(reader *r, const brdf_model *model)
{
    if (r->overlay && toml_child(r->overlay, "spectrum"))
        reader_fail(r, toml_child(r->overlay, "spectrum")->key_where,
                    "a band has no 'spectrum'; expected the numbers in this band");
    const toml_node *node = toml_child(r->table, "spectrum");
    if (!node || names_model(r->overlay)) return NULL;
    reader inner = reader_start(r->table, r->name, r->errors);
    if (!reader_tables(&inner, "spectrum") && inner.status == GLINT_OK)
        reader_fail(&inner, node->where,
                    "'spectrum' is empty; expected a list of { wavelength_um, ... }");
    const int n = inner.status == GLINT_OK ? node->n_children : 0;
    for (int k = 0; k < n; k++)
        check_entry(&inner, model, node, k);
    for (int k = 1; k < n && inner.status == GLINT_OK; k++)
        if (!(entry_um(node, k) > entry_um(node, k - 1)))
            reader_fail(&inner, node->children[k].where,
                        "%g um after %g um; expected the wavelengths of the spectrum in rising "
                        "order",
                        entry_um(node, k), entry_um(node, k - 1));
    if (inner.status > r->status) r->status = inner.status;
    return inner.status == GLINT_OK ? node : NULL;
}

/* The number of a spectrum at a wavelength, um. */
static double spectrum_at(const toml_node *spectrum, const char *key, double um)
{
    int k = 0; /* entries before um */
    while (k < spectrum->n_children && entry_um(spectrum, k) <= um)
        k++;
    const toml_node *after = &spectrum->children[k < spectrum->n_children ? k : k - 1];
    const toml_node *before = k > 0 ? &spectrum->children[k - 1] : after;
    const double a = toml_child(before, key)->number, b = toml_child(after, key)->number;
    const double low = toml_child(before, PLACE_KEY)->number;
    const double high = toml_child(after, PLACE_KEY)->number;
    return high > low ? a + (b - a) * ((um - low) / (high - low)) : a;
}

/* ------------------------------------------------------------------- arrays */

/* Adds a row of numbers to the array; false, with an error, where it is none. */
static bool read_row(reader *r, const param_info *p, const toml_node *row, const char *expected,
                     brdf_array *out)
{
    if (row->type != TOML_ARRAY || row->n_children == 0) {
        reader_fail(r, row->where, "a row of '%s' is %s; expected %s", p->name,
                    row->type == TOML_ARRAY ? "empty" : toml_type_name(row->type), expected);
        return false;
    }
    if (out->rows > 0 && row->n_children != out->columns) {
        reader_fail(r, row->where, "a row of '%s' has %d numbers and the first has %d; expected %s",
                    p->name, row->n_children, out->columns, expected);
        return false;
    }
    out->columns = row->n_children;
    const size_t n = (size_t)out->columns * ((size_t)out->rows + 1);
    double *values = realloc(out->values, n * sizeof *values);
    if (!values) {
        r->status = errors_add(r->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
        return false;
    }
    out->values = values;
    double *to = values + (size_t)out->rows * (size_t)out->columns;
    for (int k = 0; k < row->n_children; k++) {
        if (!node_number(&row->children[k], p->name, &to[k], r)) return false;
        if (!param_accepts(p, to[k])) {
            reader_fail(r, row->children[k].where, "'%s' holds the number %g; expected %s", p->name,
                        to[k], expected);
            return false;
        }
    }
    out->rows++;
    return true;
}

/* Rows of numbers; one row may stand without the outer brackets. */
static void read_array(reader *r, const param_info *p, brdf_array *out)
{
    char range[PARAM_RANGE_SIZE], expected[PARAM_RANGE_SIZE + 64];
    param_range_text(p, range);
    snprintf(expected, sizeof expected, "rows of equally many numbers, each %s", range);
    const toml_node *node =
        reader_get(r, p->name, TOML_ARRAY, !(p->flags & PARAM_OPTIONAL), expected);
    if (!node) return;
    const bool nested = node->n_children > 0 && node->children[0].type == TOML_ARRAY;
    if (!nested)
        read_row(r, p, node, expected, out);
    else
        for (int k = 0; k < node->n_children; k++)
            if (!read_row(r, p, &node->children[k], expected, out)) return;
}

static bool has_arrays(const brdf_model *model)
{
    for (int k = 0; k < model->n_params; k++)
        if (model->params[k].flags & PARAM_ROWS) return true;
    return false;
}

/* --------------------------------------------------------------------- both */

void read_lobe_params(reader *r, const band_info *band, brdf_lobe *lobe)
{
    const brdf_model *model = lobe->model;
    if (has_arrays(model) && !brdf_lobe_make_arrays(lobe)) {
        r->status = errors_add(r->errors, GLINT_INTERNAL, PLACE_NONE, "out of memory");
        return;
    }
    reader_has(r, "spectrum");
    const toml_node *spectrum = check_spectrum(r, model);
    const double um = band ? band->pivot_um : band_named("V")->pivot_um;
    for (int k = 0; k < model->n_params; k++) {
        const param_info *p = &model->params[k];
        const bool by_band = r->overlay && toml_child(r->overlay, p->name);
        const bool varies = spectrum && can_vary(p) && toml_child(&spectrum->children[0], p->name);
        if (p->flags & PARAM_ROWS) {
            lobe->params[k] = PARAM_NONE;
            read_array(r, p, &lobe->arrays[k]);
        } else if (varies && !by_band) {
            if (reader_has(r, p->name))
                reader_param(r, p, &lobe->params[k]); /* must be sound too */
            lobe->params[k] = spectrum_at(spectrum, p->name, um);
        } else {
            reader_param(r, p, &lobe->params[k]);
        }
    }
}

bool spectrum_used(const toml_node *table, const toml_node *overlay, const band_info *band,
                   spectrum_use *use)
{
    const toml_node *spectrum = toml_child(table, "spectrum");
    if (!spectrum || names_model(overlay)) return false;
    *use = (spectrum_use){.lowest_um = entry_um(spectrum, 0),
                          .highest_um = entry_um(spectrum, spectrum->n_children - 1)};
    if (band->pivot_um >= use->lowest_um && band->pivot_um <= use->highest_um) return true;
    const toml_node *first = &spectrum->children[0];
    for (int k = 0; k < first->n_children; k++) {
        const char *key = first->children[k].key;
        if (!string_equal(key, PLACE_KEY) && !(overlay && toml_child(overlay, key)))
            use->outside = true;
    }
    return true;
}
