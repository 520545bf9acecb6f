#include "cli/command.h"
#include "cli/report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the command line asks for. */
typedef struct request {
    glint_view_options options;
    glint_view_style style;
} request;

static glint_status read_from(const options *o, glint_view_options *out, glint_error *error)
{
    const char *from = o->values[OPTION_FROM];
    if (!from || strcmp(from, "observer") == 0) return GLINT_OK;
    if (strcmp(from, "sun") == 0) {
        out->from = GLINT_FROM_SUN;
        return GLINT_OK;
    }
    out->from = GLINT_FROM_DIRECTION;
    return options_vector(o, OPTION_FROM,
                          "observer, sun, or a direction in the body frame as 1,-1,0.5",
                          out->from_body, 3, error);
}

static glint_status read_size(const options *o, glint_view_style *out, glint_error *error)
{
    enum { LEAST = GLINT_VIEW_LEAST_SIZE, MOST = GLINT_VIEW_MOST_SIZE };
    const char *size = o->values[OPTION_SIZE];
    if (!size) return GLINT_OK;
    char *end = NULL;
    const bool digits = strspn(size, "0123456789x") == strlen(size) && size[0] != 'x';
    const long width = strtol(size, &end, 10);
    const long height = digits && *end == 'x' && end[1] ? strtol(end + 1, &end, 10) : 0;
    if (!digits || *end || width < LEAST || width > MOST || height < LEAST || height > MOST)
        return error_say(error, GLINT_ARGUMENT,
                         "--size has '%s'; expected width and height in px, %d to %d each, as "
                         "1200x900",
                         size, LEAST, MOST);
    out->width = (int)width;
    out->height = (int)height;
    return GLINT_OK;
}

static glint_status read_request(const options *o, request *out, glint_error *error)
{
    static const char *const colours[] = {"brightness", "material", "lit", NULL};
    int colour = 0;
    *out = (request){.options.at = o->values[OPTION_AT], .style.format = o->format};
    if (!o->output)
        return error_say(error, GLINT_ARGUMENT,
                         "a picture does not go to standard output; expected -o FILE, where FILE "
                         "ends in .svg, .png or .pdf");
    glint_status status = read_from(o, &out->options, error);
    out->options.has_sun = options_has(o, OPTION_SUN);
    if (!status)
        status = options_vector(o, OPTION_SUN, "a direction in the body frame as 1,0,0.5",
                                out->options.sun_body, 3, error);
    if (!status) status = options_word(o, OPTION_COLOR, colours, &colour, error);
    if (!status) status = read_size(o, &out->style, error);
    out->style.colour = (glint_view_colour)colour;
    out->style.logarithmic = options_has(o, OPTION_LOG);
    if (!status && out->style.logarithmic && out->style.colour != GLINT_COLOUR_BRIGHTNESS)
        status =
            error_say(error, GLINT_ARGUMENT,
                      "--log goes with --color brightness; '%s' has no scale", colours[colour]);
    if (!status) status = glint_view_draw_check(&out->style, o->output, error);
    return status;
}

glint_status cmd_view(const options *o)
{
    request asked;
    glint_error error = {0};
    glint_status status = read_request(o, &asked, &error);
    if (status) {
        report_error(&error);
        return status;
    }
    glint_errors *errors = glint_errors_new();
    glint_view *view = NULL;
    status = glint_view_read(o->operands[0], o->overrides, o->n_overrides, &asked.options, &view,
                             errors);
    report_errors(errors, status, o->quiet);
    glint_errors_free(errors);
    if (!status) {
        status = glint_view_draw(view, &asked.style, o->output, &error);
        if (status) report_error(&error);
    }
    glint_view_free(view);
    return status;
}
