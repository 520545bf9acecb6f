/* docs/scenario.md against the tables from which scenarios are read: every BRDF, attitude law,
 * primitive, direction and band is there, each key with its unit, range and default. */
#include "testing.h"

#include "base/band.h"
#include "base/text.h"
#include "brdf/brdf.h"
#include "facets/primitive.h"
#include "orbit/attitude.h"
#include "orbit/direction.h"

static char *book; /* the whole page */

static void open_book(void)
{
    size_t size;
    glint_error error;
    ck_assert_msg(file_read(DOCS_DIR "/scenario.md", &book, &size, PLACE_NONE, &error) == GLINT_OK,
                  "%s", error.message);
}

static void close_book(void)
{
    free(book);
}

/* The part under a heading, up to the next of its rank or higher; from malloc. */
static char *section(const char *heading)
{
    text line = {0};
    text_printf(&line, "\n%s\n", heading);
    const char *from = strstr(book, line.data);
    ck_assert_msg(from, "docs/scenario.md has no heading: %s", heading);
    from += line.length;
    const size_t rank = strspn(heading, "#");
    const char *to = from;
    while ((to = strstr(to, "\n#")) && strspn(to + 1, "#") > rank)
        to++;
    text_free(&line);
    char *part = string_copy(from, to ? (size_t)(to - from) : strlen(from));
    ck_assert_ptr_nonnull(part);
    return part;
}

/* The row of a table that begins with these cells: "| `ward` | `rho_d` |"; from malloc. */
static char *row_of(const char *part, const char *first, const char *second)
{
    text start = {0};
    text_printf(&start, "\n| `%s` |", first);
    if (second) text_printf(&start, " `%s` |", second);
    const char *from = strstr(part, start.data);
    ck_assert_msg(from, "docs/scenario.md has no row:%s", start.data);
    text_free(&start);
    from++;
    char *row = string_copy(from, strcspn(from, "\n"));
    ck_assert_ptr_nonnull(row);
    return row;
}

/* The next cell of a row, without the blanks around it; false past the last. */
static bool next_cell(const char **at, char cell[256])
{
    const char *from = *at + 1, *to = strchr(from, '|');
    if (**at != '|' || !to) return false;
    *at = to;
    while (from < to && *from == ' ')
        from++;
    while (to > from && to[-1] == ' ')
        to--;
    snprintf(cell, 256, "%.*s", (int)(to - from), from);
    return true;
}

/* Whether a cell holds these words alone. */
static bool has_cell(const char *row, const char *words)
{
    char cell[256];
    while (next_cell(&row, cell))
        if (string_equal(cell, words)) return true;
    return false;
}

static void assert_cell(const char *row, const char *words)
{
    ck_assert_msg(has_cell(row, words), "docs/scenario.md: no cell '%s' in: %s", words, row);
}

/* A cell must hold this number alone, however it is written. */
static void assert_number(const char *row, double value)
{
    char cell[256], *end;
    for (const char *at = row; next_cell(&at, cell);)
        if (cell[0] && strtod(cell, &end) == value && !*end) return;
    ck_abort_msg("docs/scenario.md: no number %g in: %s", value, row);
}

/* Reads "above X, to Y", "above X, below Y", "X to below Y" or "X to Y"; false when a cell says
 * something else. */
static bool read_range(const char *cell, double *min, double *max, bool *min_open, bool *max_open)
{
    char *end;
    *min_open = strncmp(cell, "above ", 6) == 0;
    *min = strtod(cell + (*min_open ? 6 : 0), &end);
    if (end == cell) return false;
    if (*min_open && *end == ',') end++;
    *max_open = strncmp(end, " below ", 7) == 0 || strncmp(end, " to below ", 10) == 0;
    if (!*max_open && strncmp(end, " to ", 4) != 0) return false;
    const char *number = end + strcspn(end, "-0123456789");
    *max = strtod(number, &end);
    return end != number && !*end;
}

/* A cell must hold the range, with "rows, " before it for arrays. */
static void assert_range(const char *row, double min, double max, bool min_open, bool max_open)
{
    char cell[256];
    for (const char *at = row; next_cell(&at, cell);) {
        const char *words = strncmp(cell, "rows, ", 6) == 0 ? cell + 6 : cell;
        double low, high;
        bool low_open, high_open;
        if (read_range(words, &low, &high, &low_open, &high_open) && low == min && high == max &&
            low_open == min_open && high_open == max_open)
            return;
    }
    ck_abort_msg("docs/scenario.md: no range from %g to %g%s%s in: %s", min, max,
                 min_open ? ", above" : "", max_open ? ", below" : "", row);
}

/* The row of a parameter. */
static void check_parameter(const param_info *p, const char *row)
{
    assert_range(row, p->min, p->max, p->flags & PARAM_MIN_OPEN, p->flags & PARAM_MAX_OPEN);
    assert_cell(row, p->unit);
    if (param_is_required(p))
        assert_cell(row, "required");
    else if (p->flags & PARAM_OPTIONAL)
        assert_cell(row, "optional");
    else
        assert_number(row, p->def);
}

START_TEST(test_docs_scenario_lists_every_brdf_parameter)
{
    char *part = section("## Reflectance models");
    const brdf_model *model;
    for (size_t k = 0; (model = brdf_model_at(k)); k++)
        for (int j = 0; j < model->n_params; j++) {
            char *row = row_of(part, model->name, model->params[j].name);
            check_parameter(&model->params[j], row);
            free(row);
        }
    free(part);
}
END_TEST

/* physics.md gives the formula of each. */
START_TEST(test_docs_physics_has_every_brdf)
{
    size_t size;
    char *page, *own = book;
    ck_assert(file_read(DOCS_DIR "/physics.md", &page, &size, PLACE_NONE, NULL) == GLINT_OK);
    book = page;
    char *part = section("## Reflectance models");
    for (size_t k = 0; brdf_model_at(k); k++)
        free(row_of(part, brdf_model_at(k)->name, NULL));
    free(part);
    book = own;
    free(page);
}
END_TEST

START_TEST(test_docs_scenario_describes_every_attitude_law)
{
    const attitude_law *law;
    for (size_t k = 0; (law = attitude_law_at(k)); k++) {
        char heading[80];
        snprintf(heading, sizeof heading, "### `%s`", law->name);
        char *part = section(heading);
        for (int j = 0; j < law->n_keys; j++) {
            const attitude_key *key = &law->keys[j];
            char *row = row_of(part, key->name, NULL);
            if (key->unit[0]) assert_cell(row, key->unit);
            ck_assert_msg(has_cell(row, "required") == key->required, "'%s' of %s: %s", key->name,
                          law->name, row);
            free(row);
        }
        free(part);
    }
}
END_TEST

/* The default of a key of three numbers: "[0, 0, 1]". */
static void assert_vector(const char *row, const double def[3])
{
    char words[80];
    snprintf(words, sizeof words, "[%g, %g, %g]", def[0], def[1], def[2]);
    assert_cell(row, words);
}

static void check_primitive_key(const primitive_kind *kind, const primitive_key *key,
                                const char *row)
{
    static const double zero[3] = {0, 0, 0};
    char words[80];
    assert_cell(row, key->unit);
    ck_assert_msg(has_cell(row, "required") == key->required, "'%s' of %s: %s", key->name,
                  kind->name, row);
    switch (key->kind) {
    case KEY_NUMBER:
    case KEY_COUNT:
        assert_range(row, key->min, key->max, key->min_open, false);
        if (!key->required) assert_number(row, key->def[0]);
        break;
    case KEY_VECTOR:
        snprintf(words, sizeof words, "%d numbers", key->length);
        assert_cell(row, words);
        assert_range(row, key->min, key->max, key->min_open, false);
        if (!key->required) assert_vector(row, key->def);
        break;
    case KEY_DIRECTION:
        assert_cell(row, "3 numbers");
        if (memcmp(key->def, zero, sizeof zero) != 0) assert_vector(row, key->def);
        break;
    case KEY_POINTS:
        assert_range(row, key->min, key->max, key->min_open, false);
        break;
    case KEY_SWITCH:
        assert_cell(row, "boolean");
        assert_cell(row, key->def[0] != 0 ? "`true`" : "`false`");
        break;
    case KEY_MATERIAL:
        assert_cell(row, "name");
        break;
    case KEY_FACES:
        assert_cell(row, "table");
        break;
    default: /* paths, words: nothing but their name to compare */
        break;
    }
}

START_TEST(test_docs_scenario_describes_every_primitive)
{
    const primitive_kind *kind;
    for (size_t k = 0; (kind = primitive_kind_at(k)); k++) {
        char heading[80];
        snprintf(heading, sizeof heading, "### `%s`", kind->name);
        char *part = section(heading);
        for (int j = 0; j < kind->n_keys; j++) {
            char *row = row_of(part, kind->keys[j].name, NULL);
            check_primitive_key(kind, &kind->keys[j], row);
            free(row);
        }
        free(part);
    }
}
END_TEST

START_TEST(test_docs_scenario_lists_every_direction)
{
    char *part = section("## Directions");
    for (size_t k = 0; direction_word(k); k++)
        free(row_of(part, direction_word(k), NULL));
    free(part);
}
END_TEST

START_TEST(test_docs_scenario_lists_every_band)
{
    char *part = section("## `[photometry]`");
    const band_info *band;
    for (size_t k = 0; (band = band_at(k)); k++) {
        char *row = row_of(part, band->name, NULL);
        const double numbers[] = {band->sun_vega, band->sun_ab, band->pivot_um,
                                  band->site_extinction};
        for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
            if (!isnan(numbers[i])) assert_number(row, numbers[i]);
        assert_cell(row, band->doc);
        assert_cell(row, magnitude_system_name(band->system));
        free(row);
    }
    free(part);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("docs tables");
    TCase *tc = tcase_create("docs");
    tcase_add_checked_fixture(tc, open_book, close_book);
    tcase_add_test(tc, test_docs_scenario_lists_every_brdf_parameter);
    tcase_add_test(tc, test_docs_physics_has_every_brdf);
    tcase_add_test(tc, test_docs_scenario_describes_every_attitude_law);
    tcase_add_test(tc, test_docs_scenario_describes_every_primitive);
    tcase_add_test(tc, test_docs_scenario_lists_every_direction);
    tcase_add_test(tc, test_docs_scenario_lists_every_band);
    suite_add_tcase(suite, tc);
    return run_suite(suite);
}
