/* Shares of materials, components and surfaces over a run, and what changes of the satellite do:
 * closed forms of Lambert plates, and the same curves from edited scenarios. */
#include "scenario_text.h"

#define POINT "[photometry]\nsolar_disc = \"point\"\n"

/* Two Lambert plates side by side that look along z, the second twice as large and half as white,
 * and one of the same material that looks along x; the Sun goes from z to x in steps of 30 deg, the
 * observer stands on z: with areas 1, 2, 1 m^2 and rho 0.8, 0.4, 0.4 the fluxes are as
 * 0.8 cos, 0.8 cos and, unseen from z, 0. */
#define PLATES                                                                                     \
    "[[component.plate]]\nsize_m = [1, 1]\nnormal = [0, 0, 1]\ntangent = [1, 0, 0]\n"              \
    "material = \"white\"\n"
#define MORE_PLATES                                                                                \
    "[[component]]\nname = \"wing\"\nparent = \"bus\"\n"                                           \
    "[[component.plate]]\nsize_m = [1, 2]\ncentre_m = [0, 5, 0]\nnormal = [0, 0, 1]\n"             \
    "tangent = [1, 0, 0]\nmaterial = \"grey\"\n"                                                   \
    "[[component.plate]]\nsize_m = [1, 1]\ncentre_m = [9, 9, 0]\nnormal = [1, 0, 0]\n"             \
    "tangent = [0, 1, 0]\nmaterial = \"grey\"\n"

static const char *const LAMBERT[N_PARTS] = {
    [PART_TIME] = "[geometry]\nsweep = { phase_deg = [0, 60, 30], plane = \"xz\" }\n",
    [PART_SETTINGS] = POINT,
    [PART_MATERIAL] = "[materials.white]\nbrdf = \"lambert\"\nrho = 0.8\n"
                      "[materials.grey]\nbrdf = \"lambert\"\nrho = 0.4\n"
                      "[materials.same]\nbrdf = \"lambert\"\nrho = 0.8\n",
    [PART_COMPONENT] = "[[component]]\nname = \"bus\"\n",
    [PART_PRIMITIVE] = PLATES MORE_PLATES,
};

static const char *write_plates(void)
{
    return write_file("scenario.toml", with_part(LAMBERT, PART_TOP, "title = \"plates\"\n").text);
}

static glint_shares *find_shares(const char *path, const glint_changes *changes)
{
    glint_shares *shares;
    glint_errors *errors = glint_errors_new();
    const glint_status status =
        glint_shares_find(path, NULL, 0, changes, 2, NULL, NULL, &shares, errors);
    ck_assert_msg(status == GLINT_OK, "status %d:%s", status, list_errors(errors));
    glint_errors_free(errors);
    return shares;
}

/* The share of that name; fails without one. */
static glint_share share_named(const glint_shares *shares, bool changed, glint_share_kind kind,
                               const char *name)
{
    glint_share share;
    for (size_t k = 0; glint_shares_get(shares, changed, kind, k, &share); k++)
        if (strcmp(share.name, name) == 0) return share;
    ck_abort_msg("there is no share '%s'", name);
    return share;
}

/* ------------------------------------------------------------- closed forms */

START_TEST(test_shares_closed_form)
{
    glint_shares *shares = find_shares(write_plates(), NULL);
    const struct {
        glint_share_kind kind;
        const char *name;
        double share, area_m2;
    } want[] = {
        {GLINT_SHARE_MATERIAL, "white", 0.5, 1},
        {GLINT_SHARE_MATERIAL, "grey", 0.5, 3},
        {GLINT_SHARE_COMPONENT, "bus", 0.5, 1},
        {GLINT_SHARE_COMPONENT, "wing", 0.5, 3},
        {GLINT_SHARE_SURFACE, "bus/white/+z", 0.5, 1},
        {GLINT_SHARE_SURFACE, "wing/grey/+z", 0.5, 2},
        {GLINT_SHARE_SURFACE, "wing/grey/+x", 0, 1},
    };
    for (size_t k = 0; k < COUNT_OF(want); k++) {
        const glint_share share = share_named(shares, false, want[k].kind, want[k].name);
        assert_near(share.share_mean, want[k].share, 1e-15);
        assert_near(share.share_peak, want[k].share, 1e-15);
        assert_near(share.area_m2, want[k].area_m2, 1e-15);
        ck_assert_int_eq(share.rows, want[k].share > 0 ? 3 : 0);
    }
    glint_shares_free(shares);
}
END_TEST

/* flux = rho A cos(phase) / (pi range^2), the Sun of V = -26.76: the magnitude alone of 0.8 m^2. */
START_TEST(test_shares_magnitudes_closed_form)
{
    glint_shares *shares = find_shares(write_plates(), NULL);
    glint_shares_total whole;
    ck_assert(glint_shares_whole(shares, false, &whole));
    ck_assert(!glint_shares_whole(shares, true, &whole));
    double sum = 0, alone[3];
    for (int k = 0; k < 3; k++) {
        const double cosine = cos(30 * k * 3.14159265358979323846 / 180);
        alone[k] = -26.76 - 2.5 * log10(0.8 * cosine / (3.14159265358979323846 * 1e12));
        sum += alone[k];
    }
    const glint_share bus = share_named(shares, false, GLINT_SHARE_COMPONENT, "bus");
    assert_near(bus.magnitude_mean, sum / 3, 1e-12); /* of 1e1, summed: 1e-14 */
    assert_near(whole.magnitude_mean, sum / 3 - 2.5 * log10(2), 1e-12);
    assert_near(whole.magnitude_median, alone[1] - 2.5 * log10(2), 1e-12);
    assert_near(whole.magnitude_peak, alone[0] - 2.5 * log10(2), 1e-12);
    ck_assert_int_eq(whole.rows, 3);
    ck_assert_int_eq(whole.bright_rows, 3);
    assert_near(whole.peak_t_s, 0, 0);
    glint_shares_free(shares);
}
END_TEST

/* A plate of 1 m^2 that looks along z and one of 2 m^2 along x, Sun and observer in one direction
 * that goes round from 10 deg off z towards x: fluxes as cos^2 and 2 sin^2 where they see it. The
 * row at 100 deg is the brightest; of the six with light each plate has the larger part in three.
 * Then the second plate becomes half as white. */
START_TEST(test_shares_that_differ_from_row_to_row_closed_form)
{
    static const double PI_ = 3.14159265358979323846;
    static const int LIT[6] = {0, 1, 2, 3, 6, 7};
    static const char *const darker[] = {"same=grey"};
    const char *parts[N_PARTS];
    memcpy(parts, LAMBERT, sizeof parts);
    parts[PART_TIME] = "[geometry]\nrotate = { axis = [0, -1, 0], step_deg = 45, "
                       "sun = [0.17364817766693033, 0, 0.984807753012208], "
                       "observer = [0.17364817766693033, 0, 0.984807753012208] }\n";
    parts[PART_PRIMITIVE] = PLATES "[[component.plate]]\nsize_m = [1, 2]\ncentre_m = [9, 9, 0]\n"
                                   "normal = [1, 0, 0]\ntangent = [0, 1, 0]\nmaterial = \"same\"\n";
    const glint_changes changes = {.swaps = darker, .n_swaps = 1};
    glint_shares *shares = find_shares(
        write_file("scenario.toml", with_part(parts, PART_TOP, "title = \"plates\"\n").text),
        &changes);
    double before[6], difference[6], z_flux = 0, flux = 0;
    for (int k = 0; k < 6; k++) {
        const double a = (10 + 45 * LIT[k]) * PI_ / 180;
        const double z = pow(fmax(cos(a), 0), 2), x = pow(fmax(sin(a), 0), 2);
        before[k] = -26.76 - 2.5 * log10(0.8 * (z + 2 * x) / (PI_ * 1e12));
        difference[k] = -2.5 * log10((z + x) / (z + 2 * x));
        z_flux += z, flux += z + 2 * x;
    }
    glint_shares_total whole;
    glint_shares_change d;
    ck_assert(glint_shares_whole(shares, false, &whole) && glint_shares_difference(shares, &d));
    ck_assert_int_eq(whole.bright_rows, 6);
    assert_near(whole.magnitude_peak, before[2], 1e-12);
    ck_assert_int_eq((int)whole.peak_t_s, 2);
    /* in order of brightness: 100, 55, 10, 325, 145, 280 deg */
    assert_near(whole.magnitude_median, 0.5 * (before[0] + before[5]), 1e-12);
    assert_near(d.median, 0.5 * (difference[0] + difference[1]), 1e-12);
    assert_near(d.at_peak, 2.5 * log10(2), 1e-12);
    assert_near(d.peak, -2.5 * log10(1 / (2 * pow(sin(100 * PI_ / 180), 2))), 1e-12);
    const glint_share z = share_named(shares, false, GLINT_SHARE_MATERIAL, "white");
    assert_near(z.share_mean, z_flux / flux, 1e-14);
    assert_near(z.share_peak, 0, 0);
    assert_near(z.dominant_fraction, 0.5, 0);
    /* the table for people has the same: mean, peak, percent of rows, magnitude, area */
    const char *path = in_folder("shares.txt");
    ck_assert_int_eq(glint_shares_write(shares, GLINT_FORMAT_TABLE, path, NULL), GLINT_OK);
    char *text = read_bytes(path, NULL), line[128];
    snprintf(line, sizeof line, " %8.4f %8.4f    50.0%% %8.3f %9.4g", z.share_mean, 0.0,
             z.magnitude_mean, 1.0);
    ck_assert_msg(strstr(text, line) != NULL, "no '%s' in %s", line, text);
    free(text);
    ck_assert_int_eq(z.rows, 4);
    glint_shares_free(shares);
}
END_TEST

/* Without the wing half of the light is lost; with grey in place of white a quarter. */
START_TEST(test_shares_changes_closed_form)
{
    static const char *const wing[] = {"wing"};
    static const char *const darker[] = {"white=grey"};
    const struct {
        glint_changes changes;
        double factor, bus_after;
    } cases[] = {{{.without = wing, .n_without = 1}, 0.5, 1},
                 {{.swaps = darker, .n_swaps = 1}, 0.75, 1.0 / 3}};
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        glint_shares *shares = find_shares(write_plates(), &cases[k].changes);
        glint_shares_change d;
        ck_assert(glint_shares_difference(shares, &d));
        const double want = -2.5 * log10(cases[k].factor);
        assert_near(d.mean, want, 1e-13);
        assert_near(d.median, want, 1e-13);
        assert_near(d.min, want, 1e-13);
        assert_near(d.max, want, 1e-13);
        assert_near(d.peak, want, 1e-13);
        ck_assert(d.has_peak);
        assert_near(d.at_peak, want, 1e-13);
        ck_assert_int_eq(d.rows, 3);
        ck_assert_int_eq(d.lost + d.gained, 0);
        const glint_share bus = share_named(shares, true, GLINT_SHARE_SURFACE, "bus/white/+z");
        assert_near(bus.share_mean, cases[k].bus_after, 1e-15);
        ck_assert_str_eq(bus.material, k == 1 ? "grey" : "white");
        glint_shares_free(shares);
    }
}
END_TEST

/* Everything that has light is taken away: all rows lose it, and nothing is divided by. */
START_TEST(test_shares_change_can_take_all_light)
{
    static const char *const both[] = {"white=black", "grey=black"};
    const glint_changes changes = {.swaps = both, .n_swaps = 2};
    const char *path = write_file(
        "scenario.toml",
        with_part(LAMBERT, PART_EXPECT, "[materials.black]\nbrdf = \"lambert\"\nrho = 0\n").text);
    glint_shares *shares = find_shares(path, &changes);
    glint_shares_change d;
    glint_shares_total whole;
    ck_assert(glint_shares_difference(shares, &d));
    ck_assert(glint_shares_whole(shares, true, &whole));
    ck_assert_int_eq(d.rows, 0);
    ck_assert_int_eq(d.lost, 3);
    ck_assert(!d.has_peak);
    ck_assert_int_eq(whole.bright_rows, 0);
    ck_assert_int_eq(whole.rows, 3);
    assert_near(share_named(shares, true, GLINT_SHARE_MATERIAL, "black").share_mean, 0, 0);
    for (int format = GLINT_FORMAT_TABLE; format <= GLINT_FORMAT_JSON; format++) {
        const char *out = in_folder("out");
        ck_assert_int_eq(glint_shares_write(shares, (glint_format)format, out, NULL), GLINT_OK);
        char *bytes = read_bytes(out, NULL);
        for (char *c = bytes; *c; c++)
            if (*c == '-') *c = ' '; /* "dominant" is no number */
        ck_assert_ptr_null(strstr(bytes, " nan"));
        ck_assert_ptr_null(strstr(bytes, ",nan"));
        ck_assert_ptr_null(strstr(bytes, " inf"));
        free(bytes);
    }
    glint_shares_free(shares);
}
END_TEST

/* ------------------------------------------------------- properties of runs */

static const char *example(void)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/../../scenarios/slew-vienna.toml", TEST_DATA_DIR);
    return path;
}

START_TEST(test_shares_add_to_one_and_agree_between_kinds)
{
    glint_shares *shares = find_shares(example(), NULL);
    glint_share share;
    for (int kind = 0; kind <= GLINT_SHARE_SURFACE; kind++) {
        double mean = 0, peak = 0, dominant = 0;
        for (size_t k = 0; glint_shares_get(shares, false, (glint_share_kind)kind, k, &share);
             k++) {
            mean += share.share_mean;
            peak += share.share_peak;
            dominant += share.dominant_fraction;
        }
        assert_near(mean, 1, 1e-13); /* 500 rows: roundings of sums */
        assert_near(peak, 1, 1e-14);
        assert_near(dominant, 1, 1e-14);
    }
    double of_wing = 0;
    for (size_t k = 0; glint_shares_get(shares, false, GLINT_SHARE_SURFACE, k, &share); k++)
        if (strcmp(share.component, "wing-north") == 0) of_wing += share.share_mean;
    assert_near(of_wing, share_named(shares, false, GLINT_SHARE_COMPONENT, "wing-north").share_mean,
                1e-13);
    glint_shares_free(shares);
}
END_TEST

/* What the columns of an ordinary run come to, row by row. */
START_TEST(test_shares_equal_columns_of_a_run)
{
    static const char *const both[] = {"output.shares=\"both\""};
    glint_shares *shares = find_shares(example(), NULL);
    glint_scenario *s = read_sound_set(example(), both, 1);
    glint_curve *curve;
    ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
    double flux = 0, parts[8] = {0}, peak_mag = 99;
    double peak_parts[8] = {0};
    for (;;) {
        const glint_row *rows;
        size_t n;
        ck_assert_int_eq(glint_curve_next(curve, &rows, &n, NULL), GLINT_OK);
        if (n == 0) break;
        for (size_t k = 0; k < n; k++) {
            if (!(rows[k].flux_ratio[0] > 0)) continue;
            ck_assert_ptr_null(rows[k].share_surface);
            flux += rows[k].flux_ratio[0];
            for (int m = 0; m < 3; m++)
                parts[m] += rows[k].share_material[m] * rows[k].flux_ratio[0];
            if (rows[k].magnitude[0] < peak_mag) {
                peak_mag = rows[k].magnitude[0];
                memcpy(peak_parts, rows[k].share_material, 3 * sizeof *peak_parts);
            }
        }
    }
    glint_share share;
    for (size_t m = 0; m < 3; m++) {
        ck_assert(glint_shares_get(shares, false, GLINT_SHARE_MATERIAL, m, &share));
        assert_near(share.share_mean, parts[m] / flux, 1e-13);
        assert_near(share.share_peak, peak_parts[m], 1e-14); /* sums in another order */
    }
    ck_assert(!glint_shares_get(shares, false, GLINT_SHARE_MATERIAL, 3, &share));
    glint_curve_close(curve);
    glint_scenario_free(s);
    glint_shares_free(shares);
}
END_TEST

START_TEST(test_shares_same_on_any_number_of_threads)
{
    char *first = NULL;
    for (int threads = 1; threads <= 3; threads++) {
        static const char *const wing[] = {"wing-south"};
        const glint_changes changes = {.without = wing, .n_without = 1};
        glint_shares *shares;
        ck_assert_int_eq(
            glint_shares_find(example(), NULL, 0, &changes, threads, NULL, NULL, &shares, NULL),
            GLINT_OK);
        ck_assert_int_eq(glint_shares_write(shares, GLINT_FORMAT_CSV, in_folder("out"), NULL),
                         GLINT_OK);
        char *bytes = read_bytes(in_folder("out"), NULL);
        if (first) ck_assert_str_eq(bytes, first);
        if (first)
            free(bytes);
        else
            first = bytes;
        glint_shares_free(shares);
    }
    free(first);
}
END_TEST

/* ------------------------------------------------------------------ changes */

/* The same material under another name changes no bit. */
START_TEST(test_shares_swap_of_identical_materials_changes_nothing)
{
    static const char *const swaps[] = {"bus/white=same"};
    const glint_changes changes = {.swaps = swaps, .n_swaps = 1};
    glint_shares *shares = find_shares(write_plates(), &changes);
    glint_shares_change d;
    ck_assert(glint_shares_difference(shares, &d));
    ck_assert(d.mean == 0 && d.min == 0 && d.max == 0 && d.median == 0 && d.peak == 0);
    glint_share before, after;
    for (size_t k = 0; glint_shares_get(shares, false, GLINT_SHARE_SURFACE, k, &before); k++) {
        ck_assert(glint_shares_get(shares, true, GLINT_SHARE_SURFACE, k, &after));
        ck_assert(before.share_mean == after.share_mean);
        ck_assert(before.magnitude_mean == after.magnitude_mean);
    }
    glint_shares_free(shares);
}
END_TEST

/* The brightest magnitude, the mean and the median of a scenario. */
static glint_shares_total total_of(const char *path, const glint_changes *changes)
{
    glint_shares *shares = find_shares(path, changes);
    glint_shares_total whole;
    ck_assert(glint_shares_whole(shares, changes != NULL, &whole));
    glint_shares_free(shares);
    whole.band = NULL; /* of the scenario, which is gone */
    return whole;
}

static void assert_same_totals(const glint_shares_total *a, const glint_shares_total *b)
{
    ck_assert_int_eq(a->bright_rows, b->bright_rows);
    assert_near(a->magnitude_mean, b->magnitude_mean, 1e-13); /* sums in another order */
    assert_near(a->magnitude_median, b->magnitude_median, 1e-13);
    assert_near(a->magnitude_peak, b->magnitude_peak, 1e-13);
    assert_near(a->peak_t_s, b->peak_t_s, 0);
}

/* A box and a wing that shades it, over Vienna: hinges, shadows, the finite Sun. */
#define BOX                                                                                        \
    "[[component.box]]\nsize_m = [1, 1, 1]\nmaterial = \"white\"\n"                                \
    "faces = { \"+z\" = \"%s\" }\n"
#define WING(cells)                                                                                \
    "[[component]]\nname = \"wing\"\nparent = \"bus\"\n"                                           \
    "hinge = { origin_m = [0, 0.5, 0], axis = [0, 1, 0], track = \"sun\", face = [0, 0, 1] }\n"    \
    "[[component.plate]]\nsize_m = [2, 3]\ncentre_m = [0, 1.5, 0]\nnormal = [0, 0, 1]\n"           \
    "tangent = [1, 0, 0]\nmaterial = \"" cells "\"\nback_material = \"white\"\n"
#define JOINT                                                                                      \
    "[[component]]\nname = \"wing\"\nparent = \"bus\"\n"                                           \
    "hinge = { origin_m = [0, 0.5, 0], axis = [0, 1, 0], track = \"sun\", face = [0, 0, 1] }\n"
#define TIP                                                                                        \
    "[[component]]\nname = \"tip\"\nparent = \"wing\"\n[[component.box]]\n"                        \
    "size_m = [0.5, 0.5, 0.5]\ncentre_m = [0, 3.5, 0]\nmaterial = \"white\"\n"
#define MATERIALS                                                                                  \
    "[materials.white]\nbrdf = \"lambert\"\nrho = 0.5\n[materials.cells]\nbrdf = \"phong\"\n"      \
    "rho_d = 0.1\nrho_s = 0.3\nn = 20\n[materials.dark]\nbrdf = \"lambert\"\nrho = 0.05\n"

static const char *write_wing(const char *name, const char *face, const char *wing)
{
    char text[TEXT_SIZE], scenario[TEXT_SIZE + 64];
    snprintf(text, sizeof text, BOX "%s", face, wing);
    snprintf(scenario, sizeof scenario, "%s", with_part(SOUND, PART_PRIMITIVE, text).text);
    char *material = strstr(scenario, "[materials.white]\nbrdf = \"lambert\"\nrho = 0.5\n");
    ck_assert_ptr_nonnull(material);
    char whole[2 * TEXT_SIZE];
    snprintf(whole, sizeof whole, "%.*s%s%s", (int)(material - scenario), scenario, MATERIALS,
             material + strlen("[materials.white]\nbrdf = \"lambert\"\nrho = 0.5\n"));
    return write_file(name, whole);
}

START_TEST(test_shares_without_equals_a_scenario_without)
{
    static const char *const wing[] = {"wing"};
    const glint_changes changes = {.without = wing, .n_without = 1};
    const glint_shares_total alone = total_of(write_wing("alone.toml", "dark", ""), NULL);
    const glint_shares_total whole =
        total_of(write_wing("whole.toml", "dark", WING("cells")), NULL);
    const glint_shares_total without =
        total_of(write_wing("whole.toml", "dark", WING("cells")), &changes);
    ck_assert_int_eq(alone.bright_rows, 7);
    ck_assert(fabs(alone.magnitude_mean - whole.magnitude_mean) > 0.01);
    assert_same_totals(&without, &alone);
    /* what hangs on it stays where it is: on a joint without surfaces */
    const glint_shares_total tip = total_of(write_wing("tip.toml", "dark", JOINT TIP), NULL);
    const glint_shares_total left =
        total_of(write_wing("both.toml", "dark", WING("cells") TIP), &changes);
    assert_same_totals(&left, &tip);
}
END_TEST

START_TEST(test_shares_swap_equals_an_edited_scenario)
{
    static const char *const everywhere[] = {"dark=cells"};
    static const char *const exchanged[] = {"bus/dark=cells", "wing/cells=dark"};
    const glint_changes one = {.swaps = everywhere, .n_swaps = 1};
    const glint_changes two = {.swaps = exchanged, .n_swaps = 2};
    const char *path = write_wing("whole.toml", "dark", WING("cells"));
    const glint_shares_total swapped = total_of(path, &one), crossed = total_of(path, &two);
    const glint_shares_total all =
        total_of(write_wing("edited.toml", "cells", WING("cells")), NULL);
    const glint_shares_total edited =
        total_of(write_wing("edited.toml", "cells", WING("dark")), NULL);
    assert_same_totals(&swapped, &all);
    assert_same_totals(&crossed, &edited);
    ck_assert(fabs(crossed.magnitude_mean - swapped.magnitude_mean) > 0.01);
}
END_TEST

/* A swap for one component wins over one for all, and all are made at once: no chains. */
START_TEST(test_shares_swaps_are_made_at_once)
{
    static const char *const swaps[] = {"white=grey", "grey=white", "bus/white=same"};
    const glint_changes changes = {.swaps = swaps, .n_swaps = 3};
    glint_shares *shares = find_shares(write_plates(), &changes);
    ck_assert_str_eq(share_named(shares, true, GLINT_SHARE_SURFACE, "bus/white/+z").material,
                     "same");
    ck_assert_str_eq(share_named(shares, true, GLINT_SHARE_SURFACE, "wing/grey/+z").material,
                     "white");
    glint_shares_free(shares);
}
END_TEST

START_TEST(test_shares_changes_are_refused_with_the_nearest_name)
{
    static const struct {
        const char *swap, *without, *said[2];
    } cases[] = {
        {"whit=grey", NULL, {"no material 'whit'", "did you mean 'white'"}},
        {"white=gray", NULL, {"no material 'gray'", "did you mean 'grey'"}},
        {"buss/white=grey", NULL, {"no component 'buss'", "did you mean 'bus'"}},
        {NULL, "wnig", {"no component 'wnig'", "did you mean 'wing'"}},
        {"bus/grey=white", NULL, {"component 'bus'", "no surface of material 'grey'"}},
        {"same=white", NULL, {"the satellite", "no surface of material 'same'"}},
        {"white", NULL, {"white", "expected A=B"}},
        {"=white", NULL, {"=white", "expected A=B"}},
        {"white=", NULL, {"white=", "expected A=B"}},
        {"/white=grey", NULL, {"/white=grey", "expected A=B"}},
        {"bus/=grey", NULL, {"bus/=grey", "expected A=B"}},
    };
    const char *path = write_plates();
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        const glint_changes changes = {&cases[k].swap, cases[k].swap != NULL, &cases[k].without,
                                       cases[k].without != NULL};
        glint_shares *shares = (glint_shares *)folder;
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(glint_shares_find(path, NULL, 0, &changes, 1, NULL, NULL, &shares, errors),
                         GLINT_ARGUMENT);
        ck_assert_ptr_null(shares);
        ck_assert_msg(has_error(errors, "", 0, 0, cases[k].said[0], cases[k].said[1]),
                      "wanted '%s' and '%s'; got:%s", cases[k].said[0], cases[k].said[1],
                      list_errors(errors));
        ck_assert_uint_eq(glint_errors_error_count(errors), 1);
        glint_errors_free(errors);
    }
}
END_TEST

START_TEST(test_shares_all_wrong_changes_are_said_at_once)
{
    static const char *const swaps[] = {"whit=grey", "white=gray"}, *const without[] = {"wnig"};
    const glint_changes changes = {swaps, 2, without, 1};
    glint_shares *shares;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(
        glint_shares_find(write_plates(), NULL, 0, &changes, 1, NULL, NULL, &shares, errors),
        GLINT_ARGUMENT);
    ck_assert_uint_eq(glint_errors_error_count(errors), 3);
    glint_errors_free(errors);
    static const char *const twice[] = {"white=grey", "white=same"}, *const all[] = {"bus", "wing"};
    const glint_changes repeated = {.swaps = twice, .n_swaps = 2},
                        nothing = {.without = all, .n_without = 2};
    ck_assert_int_eq(
        glint_shares_find(write_plates(), NULL, 0, &repeated, 1, NULL, NULL, &shares, NULL),
        GLINT_ARGUMENT);
    ck_assert_int_eq(
        glint_shares_find(write_plates(), NULL, 0, &nothing, 1, NULL, NULL, &shares, NULL),
        GLINT_ARGUMENT);
}
END_TEST

/* ----------------------------------------------------------------- surfaces */

/* Number of surfaces, and whether there is one of each name. */
static void assert_surfaces(const char *primitives, size_t n, const char *const *names)
{
    const char *path =
        write_file("scenario.toml", with_part(LAMBERT, PART_PRIMITIVE, primitives).text);
    glint_shares *shares = find_shares(path, NULL);
    glint_share share;
    for (size_t k = 0; k < n; k++)
        share_named(shares, false, GLINT_SHARE_SURFACE, names[k]);
    ck_assert(!glint_shares_get(shares, false, GLINT_SHARE_SURFACE, n, &share));
    glint_shares_free(shares);
}

START_TEST(test_shares_surfaces_are_what_faces_one_way)
{
    static const char *const box[] = {"bus/white/+x", "bus/white/-x", "bus/white/+y",
                                      "bus/white/-y", "bus/white/+z", "bus/white/-z"};
    static const char *const can[] = {"bus/white/round", "bus/grey/+z", "bus/grey/-z"};
    static const char *const tilted[] = {"bus/white/(0.600 0.000 0.800)",
                                         "bus/white/(-0.600 0.000 -0.800)"};
    assert_surfaces("[[component.box]]\nsize_m = [1, 2, 3]\nmaterial = \"white\"\n"
                    "[[component.box]]\nsize_m = [1, 1, 1]\ncentre_m = [9, 0, 0]\n"
                    "material = \"white\"\n",
                    6, box);
    assert_surfaces("[[component.cylinder]]\nradius_m = 1\nlength_m = 2\nmaterial = \"white\"\n"
                    "cap_material = \"grey\"\n",
                    3, can);
    assert_surfaces("[[component.plate]]\nsize_m = [1, 1]\nnormal = [0.6, 0, 0.8]\n"
                    "tangent = [0, 1, 0]\nmaterial = \"white\"\nback_material = \"white\"\n",
                    2, tilted);
}
END_TEST

/* Crinkled foil faces where the face does, however its facets are tilted; front and back apart. */
START_TEST(test_shares_crinkled_faces_stay_together)
{
    static const char *const box[] = {"bus/white/+x", "bus/white/-x", "bus/white/+y",
                                      "bus/white/-y", "bus/white/+z", "bus/white/-z"};
    static const char *const plate[] = {"bus/white/+z", "bus/white/-z"};
    assert_surfaces("[[component.box]]\nsize_m = [1, 2, 3]\nmaterial = \"white\"\n"
                    "crinkle = { facets_per_side = 8, tilt_rms_deg = 20, seed = 3 }\n",
                    6, box);
    assert_surfaces("[[component.plate]]\nsize_m = [1, 1]\nnormal = [0, 0, 1]\n"
                    "tangent = [0, 1, 0]\nmaterial = \"white\"\nback_material = \"white\"\n"
                    "crinkle = { facets_per_side = 8, tilt_rms_deg = 20, seed = 3 }\n"
                    "repeat = { count = 2, axis = [0, 0, 1], step_deg = 90 }\n",
                    2, plate);
}
END_TEST

/* A prism of 40 sides shows too many ways: its sides are put together by the nearest axis. */
START_TEST(test_shares_many_directions_are_put_together_by_axis)
{
    static const char *const names[] = {"bus/white/about+x", "bus/white/about-x",
                                        "bus/white/about+y", "bus/white/about-y",
                                        "bus/white/about+z", "bus/white/about-z"};
    assert_surfaces("[[component.prism]]\nradius_m = 1\nlength_m = 2\nsides = 40\n"
                    "material = \"white\"\n",
                    6, names);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("shares");
    TCase *numbers = tcase_create("numbers"), *changes = tcase_create("changes");
    TCase *surfaces = tcase_create("surfaces");
    tcase_add_checked_fixture(numbers, folder_make, folder_remove);
    tcase_add_test(numbers, test_shares_closed_form);
    tcase_add_test(numbers, test_shares_magnitudes_closed_form);
    tcase_add_test(numbers, test_shares_add_to_one_and_agree_between_kinds);
    tcase_add_test(numbers, test_shares_equal_columns_of_a_run);
    tcase_add_test(numbers, test_shares_same_on_any_number_of_threads);
    tcase_add_checked_fixture(changes, folder_make, folder_remove);
    tcase_add_test(changes, test_shares_that_differ_from_row_to_row_closed_form);
    tcase_add_test(changes, test_shares_changes_closed_form);
    tcase_add_test(changes, test_shares_change_can_take_all_light);
    tcase_add_test(changes, test_shares_swap_of_identical_materials_changes_nothing);
    tcase_add_test(changes, test_shares_without_equals_a_scenario_without);
    tcase_add_test(changes, test_shares_swap_equals_an_edited_scenario);
    tcase_add_test(changes, test_shares_swaps_are_made_at_once);
    tcase_add_test(changes, test_shares_changes_are_refused_with_the_nearest_name);
    tcase_add_test(changes, test_shares_all_wrong_changes_are_said_at_once);
    tcase_add_checked_fixture(surfaces, folder_make, folder_remove);
    tcase_add_test(surfaces, test_shares_surfaces_are_what_faces_one_way);
    tcase_add_test(surfaces, test_shares_crinkled_faces_stay_together);
    tcase_add_test(surfaces, test_shares_many_directions_are_put_together_by_axis);
    suite_add_tcase(suite, numbers);
    suite_add_tcase(suite, changes);
    suite_add_tcase(suite, surfaces);
    return run_suite(suite);
}
