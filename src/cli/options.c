#include "cli/options.h"

#include "cli/report.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const option_info table[OPTION_COUNT] = {
    [OPTION_OUTPUT] = {'o', "output", "FILE",
                       "write to FILE, which appears whole or not at all, not to standard output"},
    [OPTION_PLOT] = {'\0', "plot", "FILE",
                     "draw a picture, too: FILE ends in .svg, .png or .pdf (takes gnuplot)"},
    [OPTION_FORMAT] = {'\0', "format", "FORMAT", "how the output is written"},
    [OPTION_SET] = {'\0', "set", "KEY=VALUE",
                    "override a scenario key; VALUE is written as in TOML; may be repeated"},
    [OPTION_INCIDENCE] = {'\0', "incidence", "ANGLES",
                          "curves in the plane of incidence, in deg from the normal, as 0,30,60"},
    [OPTION_HEMISPHERE] = {'\0', "hemisphere", "ANGLES",
                           "maps over the whole hemisphere at these angles of incidence, deg"},
    [OPTION_GEOMETRY] = {'\0', "geometry", "FILE",
                         "values at the angles in FILE: a table with the columns theta_i_deg, "
                         "phi_i_deg, theta_r_deg, phi_r_deg"},
    [OPTION_DHR] = {'\0', "dhr", NULL, "directional-hemispherical reflectance over incidence"},
    [OPTION_AZIMUTH] = {'\0', "azimuth", "ANGLE",
                        "azimuth of the incident light from the tangent, deg; default 0"},
    [OPTION_STEP] = {'\0', "step", "ANGLE", "deg between directions; default 0.5, of maps 2"},
    [OPTION_BAND] = {'\0', "band", "BAND",
                     "take what the materials say of this band, as V or lsst_g"},
    [OPTION_LOG] = {'\0', "log", NULL, "logarithmic scale in the picture"},
    [OPTION_MODEL] = {'\0', "model", "LIST",
                      "the models to fit: sums with commas between them, each of terms NAME or "
                      "N*NAME"},
    [OPTION_COLUMNS] = {'\0', "columns", "LIST",
                        "where the columns stand, by number or name: theta_i=1,phi_i=2,theta_r=3,"
                        "phi_r=4,f=5"},
    [OPTION_SIGNED_ZENITH] = {'\0', "signed-zenith", NULL,
                              "angles from the normal may be negative: the opposite azimuth"},
    [OPTION_ANGLES] = {'\0', "angles", "UNIT",
                       "unit of the angles: deg, the default, or (of 'brdf fit') rad"},
    [OPTION_FLOOR] = {'\0', "floor", "VALUE",
                      "leave out rows with f at or below VALUE, 1/sr: the instrument saw nothing"},
    [OPTION_MAX_ZENITH] = {'\0', "max-zenith", "ANGLE",
                           "leave out measurements farther from the normal, deg; default 85"},
    [OPTION_ANISOTROPIC] = {'\0', "anisotropic", NULL,
                            "fit the slopes along and across the tangent apart"},
    [OPTION_FLASH_ANGLE] =
        {'\0', "flash-angle", "ANGLE",
         "a flash: the mirrored Sun comes nearer to the observer, deg; default 1"},
    [OPTION_SWAP] = {'\0', "swap", "A=B",
                     "put material B in place of A; COMPONENT/A=B: in that component alone; may be "
                     "repeated"},
    [OPTION_WITHOUT] = {'\0', "without", "COMPONENT",
                        "take a component away, and its shadow; may be repeated"},
    [OPTION_AT] =
        {'\0', "at", "TIME",
         "the moment: UTC, s from the start, or the row of given directions; default: the "
         "start"},
    [OPTION_FROM] = {'\0', "from", "WHERE",
                     "look from the observer, the default, the sun, or a direction in the body "
                     "frame, as 1,-1,0.5"},
    [OPTION_SUN] = {'\0', "sun", "X,Y,Z", "direction to the Sun in the body frame, of a model"},
    [OPTION_COLOR] = {'\0', "color", "WHAT",
                      "what colours stand for: brightness, the default, material or lit"},
    [OPTION_SIZE] = {'\0', "size", "WxH", "size of the picture in px; default 1200x900"},
    [OPTION_THREADS] = {'\0', "threads", "N",
                        "compute on N threads; 0, the default, means all processors"},
    [OPTION_QUIET] = {'q', "quiet", NULL,
                      "errors only on standard error: no warnings, summary or progress"},
    [OPTION_HELP] = {'h', "help", NULL, "explain the command, with an example"},
    [OPTION_VERSION] = {'\0', "version", NULL, "print the version"},
    [OPTION_MAN] = {'\0', "man", NULL, "print the manual page (roff)"},
    [OPTION_COMPLETION] = {'\0', "completion", "SHELL",
                           "print the completion script for SHELL: bash"},
};

const option_info *option_get(option_id id)
{
    return &table[id];
}

/* Where the reading stands. */
typedef struct reader {
    int n, at;
    const char *const *words;
    option_set accepted;
    const char *const *formats;
    options *out;
    glint_error *error;
} reader;

static glint_status read_threads(const char *value, options *out, glint_error *error)
{
    enum { MOST = 4096 }; /* more is a slip, not a machine */
    char *end;
    errno = 0;
    const long n = strtol(value, &end, 10);
    if (value[0] < '0' || value[0] > '9' || *end || errno || n > MOST)
        return error_say(error, GLINT_ARGUMENT,
                         "--threads has '%s'; expected a whole number from 0 to %d", value, MOST);
    out->threads = (int)n;
    return GLINT_OK;
}

static glint_status read_format(const char *value, const reader *r)
{
    char known[128] = "";
    for (const char *const *name = r->formats; *name; name++) {
        if (strcmp(*name, value) == 0) {
            r->out->format = value;
            return GLINT_OK;
        }
        const size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", *name);
    }
    return error_say(r->error, GLINT_ARGUMENT, "--format has '%s'; this command writes: %s", value,
                     known);
}

static glint_status apply(const reader *r, option_id id, const char *value)
{
    options *out = r->out;
    out->given |= OPTION_BIT(id);
    out->values[id] = value;
    if (value && !value[0] && strcmp(table[id].value, "FILE") == 0)
        return error_say(r->error, GLINT_ARGUMENT, "--%s has an empty file name", table[id].name);
    switch (id) {
    case OPTION_OUTPUT:
        out->output = value;
        return GLINT_OK;
    case OPTION_PLOT:
        out->plot = value;
        return GLINT_OK;
    case OPTION_FORMAT:
        return read_format(value, r);
    case OPTION_SET:
        if (!strchr(value, '=') || value[0] == '=')
            return error_say(r->error, GLINT_ARGUMENT,
                             "--set has '%s'; expected KEY=VALUE, as in time.step_s=0.5", value);
        out->overrides[out->n_overrides++] = value;
        return GLINT_OK;
    case OPTION_SWAP:
        out->swaps[out->n_swaps++] = value;
        return GLINT_OK;
    case OPTION_WITHOUT:
        out->without[out->n_without++] = value;
        return GLINT_OK;
    case OPTION_THREADS:
        return read_threads(value, out, r->error);
    case OPTION_QUIET:
        out->quiet = true;
        return GLINT_OK;
    case OPTION_COMPLETION:
        out->completion = value;
        return GLINT_OK;
    default:
        return GLINT_OK;
    }
}

/* The option called by the first n bytes of `name`, or OPTION_COUNT. */
static option_id find_name(const reader *r, const char *name, size_t n)
{
    for (int id = 0; id < OPTION_COUNT; id++)
        if ((r->accepted >> id & 1u) && strlen(table[id].name) == n &&
            memcmp(table[id].name, name, n) == 0)
            return (option_id)id;
    return OPTION_COUNT;
}

static option_id find_letter(const reader *r, char letter)
{
    for (int id = 0; id < OPTION_COUNT; id++)
        if ((r->accepted >> id & 1u) && table[id].letter && table[id].letter == letter)
            return (option_id)id;
    return OPTION_COUNT;
}

static glint_status refuse_name(const reader *r, const char *name, size_t n)
{
    char wanted[64];
    snprintf(wanted, sizeof wanted, "%.*s", n < sizeof wanted ? (int)n : (int)sizeof wanted - 1,
             name);
    const char *names[OPTION_COUNT];
    size_t n_names = 0;
    for (int id = 0; id < OPTION_COUNT; id++)
        if (r->accepted >> id & 1u) names[n_names++] = table[id].name;
    const char *near = glint_nearest_name(wanted, names, n_names);
    if (near)
        return error_say(r->error, GLINT_ARGUMENT, "unknown option '--%s'; did you mean '--%s'?",
                         wanted, near);
    return error_say(r->error, GLINT_ARGUMENT, "unknown option '--%s'", wanted);
}

/* The value of an option that stands in the next word; GLINT_ARGUMENT when there is none. */
static glint_status next_value(reader *r, option_id id, const char **value)
{
    if (r->at >= r->n)
        return error_say(r->error, GLINT_ARGUMENT, "'--%s' needs a value: --%s %s", table[id].name,
                         table[id].name, table[id].value);
    *value = r->words[r->at++];
    return GLINT_OK;
}

static glint_status read_long(reader *r, const char *word)
{
    const char *equals = strchr(word, '=');
    const size_t n = equals ? (size_t)(equals - word) : strlen(word);
    const option_id id = find_name(r, word, n);
    if (id == OPTION_COUNT) return refuse_name(r, word, n);
    const char *value = equals ? equals + 1 : NULL;
    if (value && !table[id].value)
        return error_say(r->error, GLINT_ARGUMENT, "'--%s' takes no value", table[id].name);
    if (!value && table[id].value) {
        const glint_status status = next_value(r, id, &value);
        if (status) return status;
    }
    return apply(r, id, value);
}

static glint_status read_letters(reader *r, const char *letters)
{
    for (const char *letter = letters; *letter; letter++) {
        const option_id id = find_letter(r, *letter);
        if (id == OPTION_COUNT)
            return error_say(r->error, GLINT_ARGUMENT, "unknown option '-%c'", *letter);
        const char *value = NULL;
        if (table[id].value) {
            value = letter + 1;
            const glint_status status = *value ? GLINT_OK : next_value(r, id, &value);
            if (status) return status;
        }
        const glint_status status = apply(r, id, value);
        if (status || value) return status;
    }
    return GLINT_OK;
}

glint_status options_read(int n, const char *const *words, option_set accepted,
                          const char *const *formats, options *out, glint_error *error)
{
    *out = (options){0};
    reader r = {n, 0, words, accepted, formats, out, error};
    const size_t most = n > 0 ? (size_t)n : 1;
    out->overrides = malloc(most * sizeof *out->overrides);
    out->operands = malloc(most * sizeof *out->operands);
    out->swaps = malloc(most * sizeof *out->swaps);
    out->without = malloc(most * sizeof *out->without);
    if (!out->overrides || !out->operands || !out->swaps || !out->without)
        return error_say(error, GLINT_INTERNAL, "out of memory");
    bool ended = false;
    while (r.at < n) {
        const char *word = words[r.at++];
        glint_status status = GLINT_OK;
        if (ended || word[0] != '-' || !word[1])
            out->operands[out->n_operands++] = word;
        else if (strcmp(word, "--") == 0)
            ended = true;
        else
            status = word[1] == '-' ? read_long(&r, word + 2) : read_letters(&r, word + 1);
        if (status) return status;
    }
    return GLINT_OK;
}

void options_free(options *o)
{
    free(o->overrides);
    free(o->swaps);
    free(o->without);
    free(o->operands);
    *o = (options){0};
}

glint_status options_numbers(const options *o, option_id id, double least, double below,
                             double *out, size_t most, size_t *n, glint_error *error)
{
    const char *at = o->values[id];
    *n = 0;
    while (at) {
        char *end;
        errno = 0;
        const double number = strtod(at, &end);
        /* strtod takes leading blanks, "nan", "inf" and "0x10", too */
        const bool decimal = end > at && strspn(at, "+-.0123456789eE") >= (size_t)(end - at);
        const bool good =
            decimal && (*end == ',' || !*end) && !errno && number >= least && number < below;
        if (!good)
            return error_say(error, GLINT_ARGUMENT,
                             "--%s has '%s'; expected %s from %g to below %g", table[id].name,
                             o->values[id], most > 1 ? "numbers such as 0,15,30," : "a number",
                             least, below);
        if (*n == most)
            return error_say(error, GLINT_ARGUMENT, "--%s has '%s'; expected at most %zu number%s",
                             table[id].name, o->values[id], most, most > 1 ? "s" : "");
        out[(*n)++] = number;
        at = *end ? end + 1 : NULL;
    }
    return GLINT_OK;
}

glint_status options_number(const options *o, option_id id, double least, double below, double *out,
                            glint_error *error)
{
    size_t n;
    double number;
    const glint_status status = options_numbers(o, id, least, below, &number, 1, &n, error);
    if (status == GLINT_OK && n == 1) *out = number;
    return status;
}

glint_status options_vector(const options *o, option_id id, const char *expected, double *out,
                            size_t n, glint_error *error)
{
    const char *at = o->values[id];
    for (size_t k = 0; at && k < n; k++) {
        char *end;
        errno = 0;
        out[k] = strtod(at, &end);
        const bool decimal = end > at && strspn(at, "+-.0123456789eE") >= (size_t)(end - at);
        const char after = k + 1 < n ? ',' : '\0';
        if (!decimal || errno || *end != after)
            return error_say(error, GLINT_ARGUMENT, "--%s has '%s'; expected %s", table[id].name,
                             o->values[id], expected);
        at = end + 1;
    }
    return GLINT_OK;
}

glint_status options_word(const options *o, option_id id, const char *const *words, int *out,
                          glint_error *error)
{
    char known[128] = "";
    if (!o->values[id]) return GLINT_OK;
    for (int k = 0; words[k]; k++) {
        if (strcmp(words[k], o->values[id]) == 0) {
            *out = k;
            return GLINT_OK;
        }
        const size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", k ? ", " : "", words[k]);
    }
    return error_say(error, GLINT_ARGUMENT, "--%s has '%s'; expected one of: %s", table[id].name,
                     o->values[id], known);
}

glint_format options_format(const options *o, glint_format otherwise)
{
    if (!o->format) return otherwise;
    if (strcmp(o->format, "csv") == 0) return GLINT_FORMAT_CSV;
    return strcmp(o->format, "json") == 0 ? GLINT_FORMAT_JSON : GLINT_FORMAT_TABLE;
}
