#include "cli/options.h"

#include "cli/report.h"
#include "cli/suggest.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const option_info table[OPTION_COUNT] = {
    [OPTION_OUTPUT] = {'o', "output", "FILE",
                       "write to FILE, which appears whole or not at all, not to standard output"},
    [OPTION_FORMAT] = {'\0', "format", "FORMAT", "how the output is written"},
    [OPTION_SET] = {'\0', "set", "KEY=VALUE",
                    "override a scenario key; VALUE is written as in TOML; may be repeated"},
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

/* Options of later versions: refused by name, so that nobody looks for a slip of the hand. */
static const char *const planned[] = {"plot", "swap", "without"};

const option_info *option_get(option_id id)
{
    return &table[id];
}

/* Where the reading stands. */
typedef struct reader {
    int n, at;
    const char *const *words;
    unsigned accepted;
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
    out->given |= 1u << id;
    switch (id) {
    case OPTION_OUTPUT:
        if (!value[0])
            return error_say(r->error, GLINT_ARGUMENT, "--output has an empty file name");
        out->output = value;
        return GLINT_OK;
    case OPTION_FORMAT:
        return read_format(value, r);
    case OPTION_SET:
        if (!strchr(value, '=') || value[0] == '=')
            return error_say(r->error, GLINT_ARGUMENT,
                             "--set has '%s'; expected KEY=VALUE, as in time.step_s=0.5", value);
        out->overrides[out->n_overrides++] = value;
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

static glint_status refuse_planned(const reader *r, const char *name)
{
    char list[256] = "";
    for (int id = 0; id < OPTION_COUNT; id++) {
        if (!(r->accepted >> id & 1u)) continue;
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s--%s", used ? ", " : "", table[id].name);
    }
    return error_say(r->error, GLINT_ARGUMENT, "'--%s' is not built yet; this command has: %s",
                     name, list);
}

static glint_status refuse_name(const reader *r, const char *name, size_t n)
{
    char wanted[64];
    snprintf(wanted, sizeof wanted, "%.*s", n < sizeof wanted ? (int)n : (int)sizeof wanted - 1,
             name);
    for (size_t k = 0; k < sizeof planned / sizeof *planned; k++)
        if (strcmp(planned[k], wanted) == 0) return refuse_planned(r, wanted);
    const char *names[OPTION_COUNT];
    size_t n_names = 0;
    for (int id = 0; id < OPTION_COUNT; id++)
        if (r->accepted >> id & 1u) names[n_names++] = table[id].name;
    const char *near = suggest(wanted, names, n_names);
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

glint_status options_read(int n, const char *const *words, unsigned accepted,
                          const char *const *formats, options *out, glint_error *error)
{
    *out = (options){0};
    reader r = {n, 0, words, accepted, formats, out, error};
    const size_t most = n > 0 ? (size_t)n : 1;
    out->overrides = malloc(most * sizeof *out->overrides);
    out->operands = malloc(most * sizeof *out->operands);
    if (!out->overrides || !out->operands) return error_say(error, GLINT_INTERNAL, "out of memory");
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
    free(o->operands);
    *o = (options){0};
}
