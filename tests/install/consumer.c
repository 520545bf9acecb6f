/* A user's program: reads a scenario if one is named, and says which library it was linked to. */
#include <glint/glint.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    glint_errors *errors = glint_errors_new();
    glint_scenario *scenario = NULL;
    const char *path = argc > 1 ? argv[1] : "no/such/scenario.toml";
    const glint_status status = glint_scenario_read(path, NULL, 0, &scenario, errors);
    printf("glint %s: status %d, %zu errors\n", glint_version(), (int)status,
           glint_errors_error_count(errors));
    glint_scenario_free(scenario);
    glint_errors_free(errors);
    return 0;
}
