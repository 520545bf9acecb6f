/* read_photometry.c: [photometry]: the bands with their systems, the Sun's disc, and what the air
 * takes. */
#include "base/text.h"
#include "scenario/reading.h"

#include <math.h>

static void read_extinction(reading *rd, reader *r)
{
    static const char EXPECTED[] = "false, true (bands with a known site value), or a table of "
                                   "magnitudes per airmass such as { V = 0.15 }";
    glint_scenario *s = rd->s;
    const toml_node *node = reader_find(r, "extinction");
    if (!node || (node->type == TOML_BOOLEAN && !node->boolean)) return;
    s->has_extinction = true;
    if (node->type == TOML_BOOLEAN) {
        for (int b = 0; b < s->n_bands; b++) {
            s->extinction[b] = s->bands[b]->site_extinction;
            if (isnan(s->extinction[b]))
                reader_fail(r, node->where,
                            "no extinction is known for band %s; expected a table such as "
                            "{ %s = 0.15 } in magnitudes per airmass",
                            s->bands[b]->name, s->bands[b]->name);
        }
        return;
    }
    if (node->type != TOML_TABLE) {
        reader_fail(r, node->where, "'extinction' is %s; expected %s", toml_type_name(node->type),
                    EXPECTED);
        return;
    }
    static const param_info EACH = {"extinction", "mag per airmass", "", 0, 10, PARAM_REQUIRED, 0};
    read_band_table(rd, r, node, &EACH, s->extinction);
}

static void add_band(reading *rd, reader *r, const toml_node *node, const char *system)
{
    glint_scenario *s = rd->s;
    const char *names[64];
    size_t n = 0;
    for (; band_at(n) && n < 64; n++)
        names[n] = band_at(n)->name;
    const band_info *band = node->type == TOML_STRING ? band_named(node->string) : NULL;
    if (!band) {
        const char *near = node->type == TOML_STRING ? nearest_name(node->string, names, n) : NULL;
        reader_fail(r, node->where,
                    "'%.40s' is not a band; expected U, B, V, R, I, sdss_u to sdss_z, or lsst_u to "
                    "lsst_y%s%s%s",
                    node->type == TOML_STRING ? node->string : toml_type_name(node->type),
                    near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "");
        return;
    }
    for (int b = 0; b < s->n_bands; b++)
        if (s->bands[b] == band) {
            reader_fail(r, node->where, "band '%s' is listed twice", band->name);
            return;
        }
    const magnitude_system chosen = !system                        ? band->system
                                    : string_equal(system, "vega") ? SYSTEM_VEGA
                                                                   : SYSTEM_AB;
    const double sun = band_sun_magnitude(band, chosen);
    if (isnan(sun)) {
        reader_fail(r, node->where,
                    "band '%s' has no magnitude of the Sun in the %s system; expected "
                    "system = \"ab\", or no system",
                    band->name, magnitude_system_name(chosen));
        return;
    }
    if (s->n_bands == SCENARIO_MAX_BANDS) {
        reader_fail(r, node->where, "expected at most %d bands", SCENARIO_MAX_BANDS);
        return;
    }
    s->bands[s->n_bands] = band;
    s->systems[s->n_bands] = chosen;
    s->sun_magnitude[s->n_bands++] = sun;
}

static void read_bands(reading *rd, reader *r)
{
    static const char *const SYSTEMS[] = {"vega", "ab"};
    int system = 0;
    const bool given = reader_choice(r, "system", SYSTEMS, 2, 0, &system);
    const toml_node *list = reader_get(r, "bands", TOML_ARRAY, false, "a list such as [\"V\"]");
    for (int i = 0; list && i < list->n_children; i++)
        add_band(rd, r, &list->children[i], given ? SYSTEMS[system] : NULL);
    if (list && list->n_children == 0)
        reader_fail(r, list->where, "'bands' is empty; expected at least one band");
    if (!list && r->status == GLINT_OK) {
        char name[] = "V";
        const toml_node v = {.type = TOML_STRING, .string = name};
        add_band(rd, r, &v, given ? SYSTEMS[system] : NULL);
    }
}

static void refuse_extinction(reader *r)
{
    const toml_node *node = reader_find(r, "extinction");
    if (node && (node->type != TOML_BOOLEAN || node->boolean))
        reader_fail(r, node->where,
                    "directions given by [geometry] have no airmass; expected extinction = false");
}

void read_photometry(reading *rd, reader *root)
{
    static const char *const DISCS[] = {"uniform", "limb-darkened", "point"}; /* as the enum */
    static const char *const AIRMASSES[] = {"kasten-young", "pickering"};     /* as the enum */
    static const toml_node NOTHING = {.type = TOML_TABLE};
    const toml_node *table = reader_table(root, "photometry", false);
    reader r = reader_start(table ? table : &NOTHING, "[photometry]", rd->errors);
    int disc, airmass;
    read_bands(rd, &r);
    reader_choice(&r, "solar_disc", DISCS, 3, 0, &disc);
    rd->s->solar_disc = (solar_disc_choice)disc;
    reader_choice(&r, "airmass", AIRMASSES, 2, 0, &airmass);
    rd->s->airmass = (airmass_choice)airmass;
    read_earthshine(rd, &r);
    if (rd->s->has_geometry)
        refuse_extinction(&r);
    else
        read_extinction(rd, &r);
    reading_done(rd, &r);
}
