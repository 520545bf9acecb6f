#include "cli/command.h"

#include <string.h>

static const char tagline[] = "predicts how bright an orbiting satellite looks over time";

static const struct {
    glint_status status;
    const char *doc;
} statuses[] = {
    {GLINT_OK, "done"},
    {GLINT_INPUT, "the input is wrong, absent or unreadable, or an expectation failed"},
    {GLINT_ARGUMENT, "the command line is wrong"},
    {GLINT_OUTPUT, "the output could not be written"},
    {GLINT_INTERNAL, "internal error"},
};
enum { N_STATUSES = sizeof statuses / sizeof *statuses };

static bool takes(option_set set, int id)
{
    return set >> id & 1u;
}

static void print_options(FILE *out, option_set set)
{
    fprintf(out, "\noptions:\n");
    for (int id = 0; id < OPTION_COUNT; id++) {
        if (!takes(set, id)) continue;
        const option_info *o = option_get((option_id)id);
        char left[64];
        snprintf(left, sizeof left, "%c%c%s --%s %s", o->letter ? '-' : ' ',
                 o->letter ? o->letter : ' ', o->letter ? "," : " ", o->name,
                 o->value ? o->value : "");
        fprintf(out, "  %-24s%s\n", left, o->doc);
    }
}

void help_program(FILE *out)
{
    fprintf(out, "glint %s %s\n\nusage: glint COMMAND [OPTION...] [FILE...]\n\ncommands:\n",
            glint_version(), tagline);
    const command *c;
    for (size_t k = 0; (c = command_get(k)); k++) {
        char left[64];
        snprintf(left, sizeof left, "%s %s", c->name, c->arguments);
        fprintf(out, "  %-24s%s\n", left, c->summary);
    }
    print_options(out, PROGRAM_OPTIONS);
    fprintf(out, "\nexit status:\n");
    for (size_t k = 0; k < N_STATUSES; k++)
        fprintf(out, "  %-24d%s\n", (int)statuses[k].status, statuses[k].doc);
    c = command_get(0);
    fprintf(out, "\nexample: %s\n  %s\n\n'glint COMMAND --help' explains a command.\n",
            c->example_doc, c->example);
}

void help_command(FILE *out, const command *c)
{
    fprintf(out, "usage: glint %s [OPTION...]%s%s\n\n%s\n", c->name, c->arguments[0] ? " " : "",
            c->arguments, c->details);
    print_options(out, c->options);
    fprintf(out, "\nformats:");
    for (const char *const *f = c->formats; *f; f++)
        fprintf(out, " %s", *f);
    fprintf(out, "\n\nexample: %s\n  %s\n", c->example_doc, c->example);
}

/* ---------------------------------------------------------------- manual */

/* Prints text as roff: no letter of it is taken as a request, and '-' stays a minus sign that can
 * be copied. An empty line begins a paragraph. */
static void man_text(FILE *out, const char *text)
{
    bool line_start = true;
    for (const char *c = text; *c; c++) {
        if (*c == '\n' && c[1] == '\n') {
            fputs("\n.PP", out);
            continue;
        }
        if (line_start && (*c == '.' || *c == '\'')) fputs("\\&", out);
        line_start = *c == '\n';
        if (*c == '-')
            fputs("\\-", out);
        else if (*c == '\\')
            fputs("\\e", out);
        else
            putc(*c, out);
    }
}

static void man_section(FILE *out, const char *name)
{
    fprintf(out, ".SH %s\n", name);
}

static void man_options(FILE *out)
{
    man_section(out, "OPTIONS");
    for (int id = 0; id < OPTION_COUNT; id++) {
        const option_info *o = option_get((option_id)id);
        fprintf(out, ".TP\n");
        if (o->letter) fprintf(out, "\\fB\\-%c\\fR, ", o->letter);
        fprintf(out, "\\fB\\-\\-%s\\fR", o->name);
        if (o->value) fprintf(out, " \\fI%s\\fR", o->value);
        putc('\n', out);
        man_text(out, o->doc);
        fprintf(out, ".\n");
    }
}

static void man_commands(FILE *out)
{
    man_section(out, "COMMANDS");
    const command *c;
    for (size_t k = 0; (c = command_get(k)); k++) {
        fprintf(out, ".SS glint %s %s\n", c->name, c->arguments);
        man_text(out, c->details);
        fprintf(out, "\n.PP\nFormats:");
        for (const char *const *f = c->formats; *f; f++)
            fprintf(out, " %s", *f);
        fprintf(out, ".\n");
    }
}

static void man_examples(FILE *out)
{
    man_section(out, "EXAMPLES");
    const command *c;
    for (size_t k = 0; (c = command_get(k)); k++) {
        fprintf(out, ".PP\n");
        man_text(out, c->example_doc);
        fprintf(out, "\n.PP\n.nf\n    ");
        man_text(out, c->example);
        fprintf(out, "\n.fi\n");
    }
}

void help_man(FILE *out)
{
    fprintf(out, ".TH GLINT 1 \"\" \"glint %s\" \"User Commands\"\n.nh\n", glint_version());
    man_section(out, "NAME");
    fprintf(out, "glint \\- %s\n", tagline);
    man_section(out, "SYNOPSIS");
    fprintf(out, "\\fBglint\\fR \\fICOMMAND\\fR [\\fIOPTION\\fR...] [\\fIFILE\\fR...]\n");
    man_section(out, "DESCRIPTION");
    man_text(
        out,
        "Data go to standard output or to a file; summary, progress and messages go to standard\n"
        "error. Messages name file, line and column. A progress bar is drawn only on a terminal.\n"
        "When the reader of standard output leaves early, as in a pipe to head, the program ends\n"
        "without a message and with exit status 3.\n");
    man_commands(out);
    man_options(out);
    man_section(out, "EXIT STATUS");
    for (size_t k = 0; k < N_STATUSES; k++)
        fprintf(out, ".TP\n%d\n%s.\n", (int)statuses[k].status, statuses[k].doc);
    man_section(out, "ENVIRONMENT");
    fprintf(out, ".TP\nNO_COLOR\nno colours in messages, when set and not empty.\n");
    man_examples(out);
}

/* ------------------------------------------------------------- completion */

static void completion_options(FILE *out, option_set set)
{
    for (int id = 0; id < OPTION_COUNT; id++) {
        if (!takes(set, id)) continue;
        const option_info *o = option_get((option_id)id);
        fprintf(out, " --%s", o->name);
        if (o->letter) fprintf(out, " -%c", o->letter);
    }
}

/* The words that may follow `glint`, each once: of "brdf list" its "brdf". */
static void completion_first_words(FILE *out)
{
    const command *c;
    const char *last = "";
    size_t n_last = 0;
    for (size_t k = 0; (c = command_get(k)); k++) {
        const size_t n = strcspn(c->name, " ");
        if (n != n_last || memcmp(last, c->name, n) != 0) fprintf(out, " %.*s", (int)n, c->name);
        last = c->name;
        n_last = n;
    }
    fprintf(out, " help");
}

static void completion_case(FILE *out, const command *c)
{
    const size_t n = strcspn(c->name, " ");
    fprintf(out, "        %.*s)", (int)n, c->name);
    fprintf(out, " words+=' %s", c->name[n] ? c->name + n + 1 : "");
    completion_options(out, c->options);
    fprintf(out, "' formats+='");
    for (const char *const *f = c->formats; *f; f++)
        fprintf(out, " %s", *f);
    fprintf(out, "' ;;&\n"); /* the next is tried too: "brdf list", "brdf show" */
}

/* Whether the value of an option is completed in a way of its own. */
static bool has_own_words(int id)
{
    return id == OPTION_FORMAT || id == OPTION_COMPLETION || id == OPTION_MODEL ||
           id == OPTION_COLUMNS;
}

/* A pattern of the options whose value is (is not) the name of a file, but for those that have
 * words of their own. */
static void completion_values(FILE *out, bool files)
{
    const char *between = "";
    for (int id = 0; id < OPTION_COUNT; id++) {
        const option_info *o = option_get((option_id)id);
        if (!o->value || has_own_words(id)) continue;
        if ((strcmp(o->value, "FILE") == 0) != files) continue;
        fprintf(out, "%s--%s", between, o->name);
        if (o->letter) fprintf(out, " | -%c", o->letter);
        between = " | ";
    }
}

/* Completes the last item of a list, which stands behind one of `separators`. */
static void completion_list(FILE *out, const char *separators)
{
    fprintf(out,
            "            local item=${current##*[%s]}\n"
            "            mapfile -t COMPREPLY < <(compgen -P \"${current%%\"$item\"}\" -W "
            "\"$words\" -- "
            "\"$item\")\n"
            "            compopt -o nospace 2>/dev/null\n"
            "            return ;;\n",
            separators);
}

/* The values that are lists: models with commas, pluses and counts, columns with commas. */
static void completion_lists(FILE *out)
{
    const char *name;
    fprintf(out, "        --%s)\n            words='", option_get(OPTION_MODEL)->name);
    for (size_t k = 0; (name = glint_brdf_name(k)); k++)
        if (glint_brdf_can_be_fitted(k)) fprintf(out, " %s", name);
    fprintf(out, "'\n");
    completion_list(out, ",+*");
    fprintf(out, "        --%s)\n            words='theta_i= phi_i= theta_r= phi_r= f='\n",
            option_get(OPTION_COLUMNS)->name);
    completion_list(out, ",");
}

void help_bash_completion(FILE *out)
{
    fprintf(out,
            "# bash completion for glint %s\n"
            "_glint()\n{\n"
            "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
            "    local words='' formats='' at=$COMP_CWORD\n"
            "    # bash takes '=' for a word of its own: --name=value, a=1,b=2\n"
            "    if [[ $previous == '=' ]]; then\n"
            "        while ((at > 0)) && [[ ${COMP_WORDS[at]} != --* ]]; do ((at--)); done\n"
            "        previous=${COMP_WORDS[at]}\n"
            "    fi\n"
            "    case ${COMP_WORDS[1]} in\n",
            glint_version());
    const command *c;
    for (size_t k = 0; (c = command_get(k)); k++)
        completion_case(out, c);
    fprintf(out, "        help) words='");
    completion_first_words(out);
    fprintf(out, "' ;;\n    esac\n    if ((COMP_CWORD == 1)); then\n        words='");
    completion_first_words(out);
    completion_options(out, PROGRAM_OPTIONS);
    fprintf(out, "'\n    fi\n"
                 "    case $previous in\n"
                 "        --format) words=$formats ;;\n"
                 "        --completion) words=bash ;;\n");
    completion_lists(out);
    fprintf(out, "        ");
    completion_values(out, false);
    fprintf(out, ") return ;;\n        ");
    completion_values(out, true);
    fprintf(out, ") words='' ;;\n"
                 "    esac\n"
                 "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
                 "    if ((${#COMPREPLY[@]} == 0 && COMP_CWORD > 1)); then\n"
                 "        compopt -o filenames 2>/dev/null\n"
                 "        mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
                 "    fi\n"
                 "}\n"
                 "complete -F _glint glint\n");
}
