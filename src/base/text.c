#include "base/text.h"

#include "base/grow.h"

#include <ctype.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

void text_free(text *t)
{
    free(t->data);
    *t = (text){0};
}

void text_clear(text *t)
{
    t->length = 0;
    t->failed = false;
    if (t->data) t->data[0] = '\0';
}

bool text_reserve(text *t, size_t n)
{
    if (t->failed) return false;
    if (n >= SIZE_MAX / 2 - t->length) {
        t->failed = true;
        return false;
    }
    t->failed = !grow_list(&t->data, &t->capacity, t->length + n + 1, 1);
    return !t->failed;
}

void text_append(text *t, const char *bytes, size_t n)
{
    if (!text_reserve(t, n)) return;
    if (n) memcpy(t->data + t->length, bytes, n);
    t->length += n;
    t->data[t->length] = '\0';
}

void text_add(text *t, const char *string)
{
    text_append(t, string, strlen(string));
}

void text_char(text *t, char c)
{
    text_append(t, &c, 1);
}

void text_printf(text *t, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    const int n = vsnprintf(NULL, 0, format, args);
    va_end(args);
    if (n >= 0 && text_reserve(t, (size_t)n)) {
        vsnprintf(t->data + t->length, (size_t)n + 1, format, again);
        t->length += (size_t)n;
    }
    va_end(again);
}

void text_double(text *t, double value)
{
    if (!text_reserve(t, NUMBER_SIZE)) return;
    t->length += number_format(value, t->data + t->length);
    t->data[t->length] = '\0';
}

static number_text without_sign_of_zero(number_text number)
{
    const char *digits = number.text + strspn(number.text, "+-");
    if (digits[strspn(digits, "0.")] == '\0') memmove(number.text, digits, strlen(digits) + 1);
    return number;
}

number_text number_fixed(double value, int decimals)
{
    number_text out;
    snprintf(out.text, sizeof out.text, "%.*f", decimals, value);
    return without_sign_of_zero(out);
}

number_text number_signed(double value, int decimals)
{
    number_text out;
    snprintf(out.text, sizeof out.text, "%+.*f", decimals, value);
    return without_sign_of_zero(out);
}

char *string_copy(const char *s, size_t n)
{
    char *copy = malloc(n + 1);
    if (!copy) return NULL;
    if (n) memcpy(copy, s, n);
    copy[n] = '\0';
    return copy;
}

bool string_equal(const char *a, const char *b)
{
    return strcmp(a, b) == 0;
}

/* Whether the n1 and the n2 bytes at `path` ("" is the working folder) name the same folder. */
static bool same_folder(const char *path, size_t n1, size_t n2)
{
    struct stat found[2];
    const size_t lengths[2] = {n1, n2};
    for (int k = 0; k < 2; k++) {
        char *folder = n1 || k ? string_copy(path, lengths[k]) : string_copy(".", 1);
        const bool good = folder && stat(folder, &found[k]) == 0;
        free(folder);
        if (!good) return false;
    }
    return found[0].st_dev == found[1].st_dev && found[0].st_ino == found[1].st_ino;
}

/* Takes "name/../" out of a path where it leads back to where it began, which it does not behind a
 * symbolic link: messages name files as a user would. */
static void shorten_path(char *path)
{
    size_t at = 0; /* where a part of the path begins */
    while (path[at]) {
        const size_t name = strcspn(path + at, "/"), up = at + name;
        const bool is_name = name > 0 && strncmp(path + at, "..", name) != 0; /* nor "." */
        if (is_name && strncmp(path + up, "/../", 4) == 0 && same_folder(path, at, up + 3)) {
            memmove(path + at, path + up + 4, strlen(path + up + 4) + 1);
            at = 0; /* what stands before may meet a ".." now */
        } else {
            at = up + (path[up] == '/');
        }
    }
}

char *path_beside(const char *from, const char *path)
{
    const char *slash = from && path[0] != '/' ? strrchr(from, '/') : NULL;
    if (!slash) return string_copy(path, strlen(path));
    const size_t folder = (size_t)(slash - from) + 1, rest = strlen(path);
    char *joined = malloc(folder + rest + 1);
    if (!joined) return NULL;
    memcpy(joined, from, folder);
    memcpy(joined + folder, path, rest + 1);
    shorten_path(joined);
    return joined;
}

/* Optimal string alignment distance, letter case ignored; names longer than LONGEST are far. */
static size_t edit_distance(const char *a, const char *b)
{
    enum { LONGEST = 63 };
    const size_t na = strlen(a), nb = strlen(b);
    if (na > LONGEST || nb > LONGEST) return SIZE_MAX;
    size_t d[3][LONGEST + 1];
    for (size_t j = 0; j <= nb; j++)
        d[0][j] = j;
    for (size_t i = 1; i <= na; i++) {
        size_t *row = d[i % 3], *above = d[(i - 1) % 3], *above2 = d[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= nb; j++) {
            const int ca = tolower((unsigned char)a[i - 1]), cb = tolower((unsigned char)b[j - 1]);
            size_t best = above[j - 1] + (ca != cb);
            if (above[j] + 1 < best) best = above[j] + 1;
            if (row[j - 1] + 1 < best) best = row[j - 1] + 1;
            if (i > 1 && j > 1 && ca == tolower((unsigned char)b[j - 2]) &&
                cb == tolower((unsigned char)a[i - 2]) && above2[j - 2] + 1 < best)
                best = above2[j - 2] + 1;
            row[j] = best;
        }
    }
    return d[na % 3][nb];
}

const char *nearest_name(const char *wanted, const char *const *names, size_t n)
{
    const char *nearest = NULL;
    size_t least = SIZE_MAX;
    for (size_t k = 0; k < n; k++) {
        const size_t distance = edit_distance(wanted, names[k]);
        if (distance < least) {
            least = distance;
            nearest = names[k];
        }
    }
    /* A slip changes few letters: at most one in three of the longer name, and two at the least
     * for names of four letters or more; single letters are never slips of each other. */
    if (!nearest) return NULL;
    const size_t a = strlen(wanted), b = strlen(nearest), longer = a > b ? a : b;
    const size_t limit = longer < 2 ? 0 : longer < 4 ? 1 : longer / 3 > 2 ? longer / 3 : 2;
    return least <= limit ? nearest : NULL;
}

const char *glint_nearest_name(const char *wanted, const char *const *names, size_t n)
{
    return nearest_name(wanted, names, n);
}

glint_status file_read(const char *path, char **data, size_t *size, place asked_from,
                       glint_error *error)
{
    enum { LARGEST = 1 << 30 }; /* bytes */
    *data = NULL;
    *size = 0;
    const place where = asked_from.file ? asked_from : (place){path, 0, 0};
    struct stat info;
    if (stat(path, &info) != 0)
        return error_set(error, GLINT_INPUT, where, "cannot open '%s': %s", path, strerror(errno));
    if (!S_ISREG(info.st_mode))
        return error_set(error, GLINT_INPUT, where, "'%s' is %s; expected a file", path,
                         S_ISDIR(info.st_mode) ? "a directory" : "not a regular file");
    if (info.st_size > LARGEST)
        return error_set(error, GLINT_INPUT, where,
                         "'%s' has more than 1 GiB; expected a smaller file", path);
    FILE *file = fopen(path, "rb");
    if (!file)
        return error_set(error, GLINT_INPUT, where, "cannot open '%s': %s", path, strerror(errno));
    char *bytes = malloc((size_t)info.st_size + 1);
    if (!bytes) {
        fclose(file);
        return error_no_memory(error);
    }
    const size_t n = fread(bytes, 1, (size_t)info.st_size, file);
    const bool bad = ferror(file) != 0;
    fclose(file);
    if (bad) {
        free(bytes);
        return error_set(error, GLINT_INPUT, where, "cannot read '%s': %s", path, strerror(errno));
    }
    bytes[n] = '\0';
    *data = bytes;
    *size = n;
    return GLINT_OK;
}
