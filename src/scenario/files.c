#include "scenario/files.h"

#include "base/text.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool file_list_add(file_list *list, const char *path)
{
    char **paths = realloc(list->paths, (size_t)(list->n + 1) * sizeof *paths);
    if (!paths) return false;
    list->paths = paths;
    paths[list->n] = string_copy(path, strlen(path));
    if (!paths[list->n]) return false;
    list->n++;
    return true;
}

bool file_list_has(const file_list *list, const char *path)
{
    struct stat wanted, own;
    if (stat(path, &wanted) != 0) return false;
    for (int k = 0; k < list->n; k++)
        if (stat(list->paths[k], &own) == 0 && own.st_dev == wanted.st_dev &&
            own.st_ino == wanted.st_ino)
            return true;
    return false;
}

void file_list_free(file_list *list)
{
    for (int k = 0; k < list->n; k++)
        free(list->paths[k]);
    free(list->paths);
    *list = (file_list){0};
}
