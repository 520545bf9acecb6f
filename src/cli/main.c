/* main.c: from the command line to a command and its exit status. */
#include "cli/command.h"
#include "cli/output.h"
#include "cli/report.h"

#include <signal.h>
#include <string.h>

/* Says what is wrong with the command line and where help is. */
static glint_status refuse(const glint_error *error, const char *command_name)
{
    report_error(error);
    if (error->status == GLINT_ARGUMENT)
        fprintf(stderr, "'glint%s%s --help' says more\n", command_name ? " " : "",
                command_name ? command_name : "");
    return error->status;
}

/* `glint help [COMMAND]`; of "brdf" alone, all that begin with it. */
static glint_status show_help(size_t n, const char *const *words)
{
    if (n == 0) {
        help_program(stdout);
        return GLINT_OK;
    }
    const command *c;
    bool found = false;
    for (size_t k = 0; n == 1 && (c = command_get(k)); k++) {
        if (!command_in_group(c, words[0])) continue;
        if (found) putchar('\n');
        help_command(stdout, c);
        found = true;
    }
    if (found) return GLINT_OK;
    int used;
    glint_error error;
    const glint_status status = command_find((int)n, words, &c, &used, &error);
    if (status) return refuse(&error, NULL);
    help_command(stdout, c);
    return GLINT_OK;
}

static glint_status print_completion(const char *shell)
{
    glint_error error;
    if (strcmp(shell, "bash") != 0) {
        error_say(&error, GLINT_ARGUMENT, "--completion has '%s'; there is: bash", shell);
        return refuse(&error, NULL);
    }
    help_bash_completion(stdout);
    return GLINT_OK;
}

/* A command line that begins with an option of glint itself. */
static glint_status run_program(int n, const char *const *words)
{
    options o;
    glint_error error;
    glint_status status = options_read(n, words, PROGRAM_OPTIONS, NULL, &o, &error);
    if (status)
        refuse(&error, NULL);
    else if (options_has(&o, OPTION_HELP))
        status = show_help(o.n_operands, o.operands);
    else if (options_has(&o, OPTION_VERSION))
        printf("glint %s\n", glint_version());
    else if (options_has(&o, OPTION_MAN))
        help_man(stdout);
    else if (options_has(&o, OPTION_COMPLETION))
        status = print_completion(o.completion);
    else
        status = refuse(&(glint_error){.status = GLINT_ARGUMENT, .message = "no command is given"},
                        NULL);
    options_free(&o);
    return status;
}

static glint_status check_operands(const command *c, size_t n, glint_error *error)
{
    if (n < (size_t)c->min_operands)
        return error_say(error, GLINT_ARGUMENT, "'glint %s' needs %s", c->name, c->arguments);
    if (n > (size_t)c->max_operands)
        return error_say(error, GLINT_ARGUMENT, "'glint %s' takes %s, and %zu words are given",
                         c->name, c->arguments[0] ? c->arguments : "no arguments", n);
    return GLINT_OK;
}

static glint_status run_command(const command *c, int n, const char *const *words)
{
    options o;
    glint_error error;
    glint_status status = options_read(n, words, c->options, c->formats, &o, &error);
    if (status == GLINT_OK && options_has(&o, OPTION_HELP)) {
        help_command(stdout, c);
    } else {
        if (status == GLINT_OK) status = check_operands(c, o.n_operands, &error);
        status = status ? refuse(&error, c->name) : c->run(&o);
    }
    options_free(&o);
    return status;
}

static glint_status dispatch(int n, const char *const *words)
{
    if (n == 0) {
        help_program(stderr);
        return GLINT_ARGUMENT;
    }
    if (words[0][0] == '-') return run_program(n, words);
    if (strcmp(words[0], "help") == 0)
        return n > 1 && words[1][0] == '-' ? show_help(0, NULL)
                                           : show_help((size_t)n - 1, words + 1);
    if (n == 2 && (strcmp(words[1], "--help") == 0 || strcmp(words[1], "-h") == 0))
        return show_help(1, words);
    const command *c;
    int used;
    glint_error error;
    const glint_status status = command_find(n, words, &c, &used, &error);
    if (status) return refuse(&error, NULL);
    return run_command(c, n - used, words + used);
}

int main(int argc, char **argv)
{
    output_prepare();
    /* A pipe whose reader left is an error of writing like any other, so that an output file that
     * is not that pipe still gets finished; only the message is left out. */
    signal(SIGPIPE, SIG_IGN);
    glint_status status = dispatch(argc > 0 ? argc - 1 : 0, (const char *const *)argv + 1);
    bool reader_left;
    glint_error error;
    if (output_close_stdout(&reader_left, &error) != GLINT_OK && status < GLINT_OUTPUT) {
        if (!reader_left) report_error(&error);
        status = GLINT_OUTPUT;
    }
    return (int)status;
}
