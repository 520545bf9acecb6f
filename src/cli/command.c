#include "cli/command.h"

#include "cli/report.h"

#include <limits.h>
#include <string.h>

#define BIT(option) OPTION_BIT(option)

#define GENERAL                                                                                    \
    (BIT(OPTION_OUTPUT) | BIT(OPTION_FORMAT) | BIT(OPTION_THREADS) | BIT(OPTION_QUIET) |           \
     BIT(OPTION_HELP))
#define WITH_SCENARIO (GENERAL | BIT(OPTION_SET))

static const char *const csv_only[] = {"csv", NULL};
static const char *const text_only[] = {"text", NULL};
static const char *const toml_only[] = {"toml", NULL};

static const char *const table_first[] = {"table", "csv", "json", NULL};
static const char *const picture_formats[] = {"svg", "png", "pdf", NULL};
static const char *const csv_first[] = {"csv", "json", "table", NULL};

static const command commands[] = {
    {.name = "run",
     .arguments = "SCENARIO",
     .summary = "compute the light curve and write it as a table",
     .details =
         "Reads SCENARIO with the files that it names and writes a row for every step: time,\n"
         "magnitudes, flux ratios, range, phase angle, sunlit fraction, flags, the place in the\n"
         "sky for a site on the ground, and the shares of materials and components. The table\n"
         "begins with a header of comments (ECSV) that holds units and the whole scenario. Rows\n"
         "of several observers follow each other, each with the observer's name.\n"
         "\n"
         "With --plot the magnitudes and the shares over time are drawn, too. A summary on\n"
         "standard error ends the run.",
     .example = "glint run scenarios/iss-vienna.toml --set time.step_s=0.5 -o iss-vienna.csv",
     .example_doc = "the space station over Vienna in steps of half a second",
     .formats = csv_only,
     .options = WITH_SCENARIO | BIT(OPTION_PLOT),
     .min_operands = 1,
     .max_operands = 1,
     .run = cmd_run},
    {.name = "check",
     .arguments = "FILE...",
     .summary = "read and validate scenarios or models, and explain them",
     .details =
         "Reports areas, whether a body is closed, materials and their reflectance, the age of\n"
         "element sets, what would run and what is neglected. No light curve is computed.",
     .example = "glint check scenarios/iss-vienna.toml",
     .example_doc = "what the scenario holds, and whether anything in it is wrong",
     .formats = text_only,
     .options = WITH_SCENARIO,
     .min_operands = 1,
     .max_operands = INT_MAX,
     .run = cmd_check},
    {.name = "verify",
     .arguments = "FILE...",
     .summary = "run scenarios and hold them against what they expect",
     .details =
         "Runs scenarios that carry expected values ([[expect]], [expect_table]) or requirements\n"
         "([[require]]). Prints a line for each file and for each requirement, with its margin in\n"
         "magnitudes, and on standard error every deviation with its place in the file. A\n"
         "scenario that expects nothing fails.",
     .example = "glint verify scenarios/known/*.toml",
     .example_doc = "do all known geometries come out as they should?",
     .formats = text_only,
     .options = WITH_SCENARIO,
     .min_operands = 1,
     .max_operands = INT_MAX,
     .run = cmd_verify},
    {.name = "shares",
     .arguments = "SCENARIO",
     .summary = "find which surfaces make the satellite bright, and what changes would do",
     .details =
         "Runs SCENARIO and writes for every material, component and surface its part of all the\n"
         "light, its part at the brightest moment, how often it is the largest of its kind, and\n"
         "the mean of the magnitude that it has alone, in the first band. A surface is what one\n"
         "material in one component shows in one direction: bus/mli/+x.\n"
         "\n"
         "With --swap or --without the satellite is run once more with these changes, and the\n"
         "differences are shown. What hangs on a component that is taken away stays.\n"
         "\n"
         "With --plot magnitudes and shares over time are drawn, of the changed satellite where\n"
         "there are changes, with the magnitudes of the given one behind.",
     .example = "glint shares scenarios/iss-vienna.toml --swap bus/mli=white-paint",
     .example_doc = "what makes it bright, and what if the bus were painted white?",
     .formats = table_first,
     .options = WITH_SCENARIO | BIT(OPTION_PLOT) | BIT(OPTION_SWAP) | BIT(OPTION_WITHOUT),
     .min_operands = 1,
     .max_operands = 1,
     .run = cmd_shares},
    {.name = "compare",
     .arguments = "SCENARIO",
     .summary = "hold the prediction against an observed track",
     .details =
         "Predicts the magnitude at every moment of the file that [observed] of SCENARIO names,\n"
         "and writes a row for each: what was observed, what is predicted, and the difference,\n"
         "observed less predicted. Rows in which nothing is predicted (in the Earth's shadow,\n"
         "below the horizon, dark) are told of and left out of the numbers: rms, mean, scatter,\n"
         "Pearson's R, chi^2. Only rows within [time] count.\n"
         "\n"
         "With --plot observed points, the predicted curve and the differences are drawn, passes\n"
         "side by side.",
     .example = "glint compare scenarios/compare-vienna.toml --format csv -o residuals.csv",
     .example_doc = "how far off is the prediction of a track?",
     .formats = table_first,
     .options = WITH_SCENARIO | BIT(OPTION_PLOT),
     .min_operands = 1,
     .max_operands = 1,
     .run = cmd_compare},
    {.name = "passes",
     .arguments = "SCENARIO...",
     .summary = "find passes over sites: rise, set, shadow, brightest moment, flashes",
     .details =
         "Finds when the satellite is above the horizon of a site (min_elevation_deg, its mask),\n"
         "when it culminates, when it enters and leaves the shadows of Earth and Moon, and when\n"
         "the site is dark, all to 1 ms; with an attitude and a satellite also when it is\n"
         "brightest, and when a flat shiny surface mirrors the Sun to the observer. The step of\n"
         "the scenario plays no part. Passes over several sites and of several scenarios become\n"
         "one table in order of time.\n"
         "\n"
         "[attitude] and [satellite] may be absent: there is no brightness then.",
     .example = "glint passes scenarios/iss-vienna.toml --set time.end=2025-07-27T19:10:00Z",
     .example_doc = "passes of the space station over Vienna in three days",
     .formats = table_first,
     .options = WITH_SCENARIO | BIT(OPTION_FLASH_ANGLE),
     .min_operands = 1,
     .max_operands = INT_MAX,
     .run = cmd_passes},
    {.name = "ephemeris",
     .arguments = "SCENARIO",
     .summary = "write positions, directions and angles over time, frame by frame",
     .details =
         "A row for every step: right ascension and declination from the observer, angular rate,\n"
         "azimuth, elevation, range and range rate, distance from the Sun and the Moon in the\n"
         "sky, phase angle, sunlit fraction, the Sun above the plane of the orbit, the point\n"
         "below the satellite, positions and velocities in GCRS, ITRS and (of element sets)\n"
         "TEME, the attitude as a quaternion, the angles of the hinges.\n"
         "\n"
         "[attitude] and [satellite] may be absent: their columns then are, too.",
     .example = "glint ephemeris scenarios/iss-vienna.toml --format table",
     .example_doc = "where to point a telescope, second by second",
     .formats = csv_first,
     .options = WITH_SCENARIO,
     .min_operands = 1,
     .max_operands = 1,
     .run = cmd_ephemeris},
    {.name = "view",
     .arguments = "FILE",
     .summary = "draw the satellite as the observer sees it at one moment",
     .details =
         "Draws the satellite of a scenario, or a model alone, into the picture -o FILE, which\n"
         "ends in .svg, .png or .pdf. What is hidden, and every shadow that one part casts on\n"
         "another, is cut out exactly. Celestial north is up for an observer, else the body's z\n"
         "axis; a circle beside it shows the body's axes and the Sun, with broken lines where\n"
         "they point away from the viewer.\n"
         "\n"
         "--color brightness shows the radiance factor: the radiance over that of a white plate\n"
         "that faces the Sun. --color material and --color lit show what the names say. A model\n"
         "has no time: --from and --sun say from where it is seen and lit.",
     .example = "glint view scenarios/iss-vienna.toml --at 2025-07-24T19:13:10Z -o iss.png",
     .example_doc = "the space station as it is seen from Vienna when it culminates",
     .formats = picture_formats,
     .options = WITH_SCENARIO | BIT(OPTION_AT) | BIT(OPTION_FROM) | BIT(OPTION_SUN) |
                BIT(OPTION_COLOR) | BIT(OPTION_LOG) | BIT(OPTION_SIZE),
     .min_operands = 1,
     .max_operands = 1,
     .run = cmd_view},
    {.name = "brdf list",
     .arguments = "",
     .summary = "list the reflectance models and their parameters",
     .details =
         "Each model with its source, and for every parameter the key that a material gives it\n"
         "under, its unit, range and default.",
     .example = "glint brdf list",
     .example_doc = "what `brdf = \"...\"` of a material may name",
     .formats = text_only,
     .options = GENERAL,
     .min_operands = 0,
     .max_operands = 0,
     .run = cmd_brdf_list},
    {.name = "brdf show",
     .arguments = "FILE:NAME...",
     .summary = "show how materials reflect: curves, maps, values",
     .details =
         "Writes the BRDF (1/sr) of materials side by side as a table: over the angle of\n"
         "reflection in the plane of incidence (--incidence, the default), over the hemisphere\n"
         "(--hemisphere), at angles from a file (--geometry), or its sum over the hemisphere, the\n"
         "reflectance (--dhr). NAME is a material of FILE, which is a file of materials or a\n"
         "model; without NAME all its materials are shown.\n"
         "\n"
         "Angles are in deg. Those that look like radians are refused: in a file none from the\n"
         "normal above 1.571 and no azimuth above 6.284, in a list none above 1.571 and not all\n"
         "whole tenths. --angles deg says that so small ones are meant.\n"
         "\n"
         "With --plot it is drawn, too. The peaks of curves end up on standard error.",
     .example = "glint brdf show scenarios/materials/huang2013.toml --plot panel-and-mli.png",
     .example_doc = "a solar panel and MLI at six angles of incidence",
     .formats = csv_only,
     .options = GENERAL | BIT(OPTION_PLOT) | BIT(OPTION_INCIDENCE) | BIT(OPTION_HEMISPHERE) |
                BIT(OPTION_GEOMETRY) | BIT(OPTION_ANGLES) | BIT(OPTION_DHR) | BIT(OPTION_AZIMUTH) |
                BIT(OPTION_STEP) | BIT(OPTION_BAND) | BIT(OPTION_LOG),
     .min_operands = 1,
     .max_operands = INT_MAX,
     .run = cmd_brdf_show},
    {.name = "brdf fit",
     .arguments = "DATA",
     .summary = "fit reflectance models to measurements",
     .details =
         "Reads DATA, a table of measured values of a BRDF: angles from the normal (theta) and\n"
         "azimuths (phi) of the light (i) and of the observer (r), and f in 1/sr. Fits every\n"
         "model of --model by least squares in the logarithm of f, and prints them in the order\n"
         "of their rms deviation in dex (powers of ten), with parameters and standard errors,\n"
         "and the materials to be used in a model file. Standard errors and the criteria AIC and\n"
         "BIC take the errors of the measurements for independent.\n"
         "\n"
         "Angles that look like radians (none from the normal above 1.571 and no azimuth above\n"
         "6.284) are refused unless --angles says their unit.\n"
         "\n"
         "In a sum such as lambert+2*ward-gmd only one term is diffuse: the other terms' own\n"
         "diffuse parts are 0. Lobes are the same along and across the tangent unless\n"
         "--anisotropic is given. Parameters that have a default keep it.\n"
         "\n"
         "With -o the materials go to the file, the report before them as comments, and the\n"
         "report is printed. With --plot measurements, curves and residuals of the four best\n"
         "fits are drawn.",
     .example = "glint brdf fit chassis_brdf.csv --columns theta_i=1,phi_i=2,theta_r=3,phi_r=4,f=5 "
                "--signed-zenith --model ward,lambert+abg,lambert+2*ward-gmd -o chassis.toml",
     .example_doc = "which model describes these measurements best?",
     .formats = toml_only,
     .options = GENERAL | BIT(OPTION_PLOT) | BIT(OPTION_MODEL) | BIT(OPTION_COLUMNS) |
                BIT(OPTION_SIGNED_ZENITH) | BIT(OPTION_ANGLES) | BIT(OPTION_FLOOR) |
                BIT(OPTION_MAX_ZENITH) | BIT(OPTION_ANISOTROPIC),
     .min_operands = 1,
     .max_operands = 1,
     .run = cmd_brdf_fit},
};

static const char *const planned[] = {"sweep"};

enum {
    N_COMMANDS = sizeof commands / sizeof *commands,
    N_PLANNED = sizeof planned / sizeof *planned
};

const command *command_get(size_t k)
{
    return k < N_COMMANDS ? &commands[k] : NULL;
}

const char *command_planned(size_t k)
{
    return k < N_PLANNED ? planned[k] : NULL;
}

void command_names(char *out, size_t size)
{
    out[0] = '\0';
    for (size_t k = 0; k < N_COMMANDS; k++) {
        const size_t used = strlen(out);
        snprintf(out + used, size - used, "%s%s", k ? ", " : "", commands[k].name);
    }
}

/* How many words `name` has, when it begins the n words; 0 when it does not. */
static int match(const char *name, int n, const char *const *words)
{
    const char *space = strchr(name, ' ');
    const size_t first = space ? (size_t)(space - name) : strlen(name);
    if (n < 1 || strlen(words[0]) != first || memcmp(words[0], name, first) != 0) return 0;
    if (!space) return 1;
    return n > 1 && strcmp(words[1], space + 1) == 0 ? 2 : 0;
}

bool command_in_group(const command *c, const char *group)
{
    const size_t n = strlen(group);
    return strncmp(c->name, group, n) == 0 && c->name[n] == ' ';
}

/* What may follow the group's name: "list, show"; empty when there is no such group. */
static void group_members(const char *group, char *out, size_t size)
{
    out[0] = '\0';
    for (size_t k = 0; k < N_COMMANDS; k++) {
        if (!command_in_group(&commands[k], group)) continue;
        const size_t used = strlen(out);
        snprintf(out + used, size - used, "%s%s", used ? ", " : "",
                 commands[k].name + strlen(group) + 1);
    }
}

glint_status command_find(int n, const char *const *words, const command **out, int *used,
                          glint_error *error)
{
    const char *names[N_COMMANDS];
    char list[256];
    *out = NULL;
    for (size_t k = 0; k < N_COMMANDS; k++) {
        names[k] = commands[k].name;
        *used = match(commands[k].name, n, words);
        if (*used) {
            *out = &commands[k];
            return GLINT_OK;
        }
    }
    command_names(list, sizeof list);
    for (size_t k = 0; k < N_PLANNED; k++)
        if (match(planned[k], n, words))
            return error_say(error, GLINT_ARGUMENT, "'%s' is not built yet; this version has: %s",
                             planned[k], list);
    char members[128];
    group_members(words[0], members, sizeof members);
    if (members[0] && n > 1)
        return error_say(error, GLINT_ARGUMENT, "'glint %s' has no '%s'; it has: %s", words[0],
                         words[1], members);
    if (members[0])
        return error_say(error, GLINT_ARGUMENT, "'glint %s' needs one more word: %s", words[0],
                         members);
    const char *near = glint_nearest_name(words[0], names, N_COMMANDS);
    if (near)
        return error_say(error, GLINT_ARGUMENT, "unknown command '%s'; did you mean '%s'?",
                         words[0], near);
    return error_say(error, GLINT_ARGUMENT, "unknown command '%s'; this version has: %s", words[0],
                     list);
}
