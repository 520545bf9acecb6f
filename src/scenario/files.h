/* files.h: the files that a scenario is read from. */
#ifndef GLINT_SCENARIO_FILES_H
#define GLINT_SCENARIO_FILES_H

#include <stdbool.h>

/* Their paths. Zero-initialise; file_list_free ends it. */
typedef struct file_list {
    char **paths; /* owned, each */
    int n;
} file_list;

/* Adds a copy of the path; false when memory is out. */
bool file_list_add(file_list *list, const char *path);
/* True when `path` is one of them: the same file, under whatever name. False where there is none.
 */
bool file_list_has(const file_list *list, const char *path);
void file_list_free(file_list *list);

#endif
