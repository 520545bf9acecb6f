/* options.h: the options of all commands in one table, and reading them from a command line. */
#ifndef GLINT_CLI_OPTIONS_H
#define GLINT_CLI_OPTIONS_H

#include <glint/glint.h>

/* An option: its row in the table, and its bit (OPTION_BIT) in the set that a command takes. */
typedef enum option_id {
    OPTION_OUTPUT,
    OPTION_PLOT,
    OPTION_FORMAT,
    OPTION_SET,
    OPTION_INCIDENCE,
    OPTION_HEMISPHERE,
    OPTION_GEOMETRY,
    OPTION_DHR,
    OPTION_AZIMUTH,
    OPTION_STEP,
    OPTION_BAND,
    OPTION_LOG,
    OPTION_MODEL,
    OPTION_COLUMNS,
    OPTION_SIGNED_ZENITH,
    OPTION_ANGLES,
    OPTION_FLOOR,
    OPTION_MAX_ZENITH,
    OPTION_ANISOTROPIC,
    OPTION_FLASH_ANGLE,
    OPTION_SWAP,
    OPTION_WITHOUT,
    OPTION_AT,
    OPTION_FROM,
    OPTION_SUN,
    OPTION_COLOR,
    OPTION_SIZE,
    OPTION_THREADS,
    OPTION_QUIET,
    OPTION_HELP,
    OPTION_VERSION,
    OPTION_MAN,
    OPTION_COMPLETION,
    OPTION_COUNT
} option_id;

/* A set of options. */
typedef uint64_t option_set;
#define OPTION_BIT(id) ((option_set)1 << (id))

/* The options that `glint` itself takes, with no command. */
#define PROGRAM_OPTIONS                                                                            \
    (OPTION_BIT(OPTION_HELP) | OPTION_BIT(OPTION_VERSION) | OPTION_BIT(OPTION_MAN) |               \
     OPTION_BIT(OPTION_COMPLETION))

/* What help, the manual and completion say of an option. */
typedef struct option_info {
    char letter;       /* '\0': long form only */
    const char *name;  /* without the dashes */
    const char *value; /* what its value is called; NULL where it takes none */
    const char *doc;   /* begins in lower case, no full stop */
} option_info;

/* Row `id` of the table. */
const option_info *option_get(option_id id);

/* A command line that has been read. The texts are borrowed from argv. */
typedef struct options {
    option_set given; /* that stood on the line */
    const char
        *values[OPTION_COUNT]; /* as written; of an option given twice the last; NULL: none */
    const char *output;        /* NULL: standard output */
    const char *plot;          /* NULL: no picture */
    const char *format;        /* NULL: the command's first */
    const char *completion;    /* the shell that --completion names */
    int threads;               /* 0: all processors */
    bool quiet;                /* nothing but errors on standard error */
    const char **overrides;    /* owned; "key=value" */
    const char **swaps;        /* owned; "A=B" */
    const char **without;      /* owned; names of components */
    const char **operands;     /* owned; what is no option */
    size_t n_overrides, n_swaps, n_without, n_operands;
} options;

/* Reads n words: `--name value`, `--name=value`, `-o value`, `-ovalue`, joined letters (`-qo
 * value`);
 * `--` ends the options, `-` is an operand. accepted: bits of the options that are known here;
 * formats: what --format may name, NULL at the end (NULL where --format is not accepted).
 * Errors: GLINT_ARGUMENT, naming the nearest option where the given one is unknown; GLINT_INTERNAL.
 * options_free ends *out in every case. */
glint_status options_read(int n, const char *const *words, option_set accepted,
                          const char *const *formats, options *out, glint_error *error);
void options_free(options *o);

/* Reads the value of an option as numbers with commas between them, "0,15,30". below: the numbers
 * are >= least and < below. most: room in out[]; *n: how many there are, 0 where the option was not
 * given. Errors: GLINT_ARGUMENT. */
glint_status options_numbers(const options *o, option_id id, double least, double below,
                             double *out, size_t most, size_t *n, glint_error *error);
/* The same of one number; *out is left alone where the option was not given. */
glint_status options_number(const options *o, option_id id, double least, double below, double *out,
                            glint_error *error);

/* Reads n finite numbers of any size with commas between them. expected: what to say, as "a
 * direction such as 1,0,-0.5". Errors: GLINT_ARGUMENT, also where there are not n of them. */
glint_status options_vector(const options *o, option_id id, const char *expected, double *out,
                            size_t n, glint_error *error);
/* Number of the word among those in `words` (NULL at the end) that the option has as its value;
 * *out is left alone where it was not given. Errors: GLINT_ARGUMENT. */
glint_status options_word(const options *o, option_id id, const char *const *words, int *out,
                          glint_error *error);
/* The format of tables that --format names; `otherwise` where it was not given. */
glint_format options_format(const options *o, glint_format otherwise);
/* True when that option stood on the line. */
static inline bool options_has(const options *o, option_id id)
{
    return o->given >> id & 1u;
}

#endif
