/* command.h: the table of subcommands, from which dispatch, --help, the manual page and the shell
 * completion all follow. */
#ifndef GLINT_CLI_COMMAND_H
#define GLINT_CLI_COMMAND_H

#include "cli/options.h"

#include <stdio.h>

/* A subcommand. A new one is a file cmd_<name>.c and a row in command.c. */
typedef struct command {
    const char *name;      /* one word or two, as typed after `glint` */
    const char *arguments; /* as in the usage line; "" for none */
    const char *summary;   /* one line, begins in lower case, no full stop */
    const char *details;   /* lines of 78 letters at most, paragraphs parted by an empty line */
    const char *example, *example_doc;
    const char *const *formats; /* what --format takes, NULL at the end; the first is the default */
    option_set options;         /* that it takes */
    int min_operands, max_operands;
    glint_status (*run)(const options *o); /* prints its own errors */
} command;

/* Row k of the table; NULL past the end. */
const command *command_get(size_t k);

/* Name k of the commands that later versions will have; NULL past the end. */
const char *command_planned(size_t k);

/* Finds the command whose words begin the n words. *used: how many words its name has.
 * Errors: GLINT_ARGUMENT, saying what there is, or that the command is not built yet. */
glint_status command_find(int n, const char *const *words, const command **out, int *used,
                          glint_error *error);

/* True when the command's name has two words, and `group` is the first. */
bool command_in_group(const command *c, const char *group);

/* Writes the names of all commands, "run, check, ...", as far as they go into `size` bytes. */
void command_names(char *out, size_t size);

/* What the commands are made of: cmd_*.c. */
glint_status cmd_run(const options *o);
glint_status cmd_check(const options *o);
glint_status cmd_verify(const options *o);
glint_status cmd_passes(const options *o);
glint_status cmd_ephemeris(const options *o);
glint_status cmd_view(const options *o);
glint_status cmd_brdf_list(const options *o);
glint_status cmd_brdf_show(const options *o);
glint_status cmd_brdf_fit(const options *o);

/* help.c: the same tables in four shapes. */
void help_program(FILE *out);
void help_command(FILE *out, const command *c);
void help_man(FILE *out);
void help_bash_completion(FILE *out);

#endif
