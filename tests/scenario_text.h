/* scenario_text.h: a folder of its own for every test, and small scenarios whose parts can be put
 * in place of each other. */
#ifndef GLINT_SCENARIO_TEXT_H
#define GLINT_SCENARIO_TEXT_H

#include <glint/glint.h>

#include "testing.h"

#include <dirent.h>
#include <unistd.h>

/* ------------------------------------------------------------------ the folder */

static char folder[256];

/* "folder/name" in a static buffer that stays: the same for the same name. */
static inline const char *in_folder(const char *name)
{
    static char paths[64][1024];
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    int k = 0;
    while (k < 63 && paths[k][0] && strcmp(paths[k], path) != 0)
        k++;
    return strcpy(paths[k], path);
}

/* Number of entries besides "." and "..". */
static inline int folder_count(void)
{
    DIR *dir = opendir(folder);
    ck_assert_ptr_nonnull(dir);
    int n = -2;
    while (readdir(dir))
        n++;
    closedir(dir);
    return n;
}

/* For tcase_add_checked_fixture. */
static inline void folder_make(void)
{
    const char *base = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/glint-test-XXXXXX", base && base[0] ? base : "/tmp");
    ck_assert_ptr_nonnull(mkdtemp(folder));
}

static inline void folder_remove(void)
{
    DIR *dir = opendir(folder);
    ck_assert_ptr_nonnull(dir);
    for (struct dirent *entry; (entry = readdir(dir));)
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            remove(in_folder(entry->d_name));
    closedir(dir);
    rmdir(folder);
}

/* Writes n bytes as a file of the folder; returns its path. */
static inline const char *write_bytes(const char *name, const char *bytes, size_t n)
{
    const char *path = in_folder(name);
    FILE *file = fopen(path, "wb");
    ck_assert_msg(file != NULL, "cannot write %s", path);
    ck_assert_uint_eq(fwrite(bytes, 1, n, file), n);
    ck_assert_int_eq(fclose(file), 0);
    return path;
}

static inline const char *write_file(const char *name, const char *content)
{
    return write_bytes(name, content, strlen(content));
}

/* The bytes of a file, terminated, from malloc. */
static inline char *read_bytes(const char *path, size_t *n)
{
    FILE *file = fopen(path, "rb");
    ck_assert_msg(file != NULL, "cannot read %s", path);
    char *bytes = NULL;
    size_t used = 0, got;
    do {
        bytes = realloc(bytes, used + 65536 + 1);
        ck_assert_ptr_nonnull(bytes);
        got = fread(bytes + used, 1, 65536, file);
        used += got;
    } while (got > 0);
    fclose(file);
    bytes[used] = '\0';
    if (n) *n = used;
    return bytes;
}

/* ------------------------------------------------------------------ texts */

/* The parts of a scenario, in their order in the file. Those that are not named in SOUND or GIVEN
 * are empty until a test fills them. */
enum part {
    PART_TOP,
    PART_TIME,
    PART_OBSERVER,
    PART_ORBIT,
    PART_ATTITUDE,
    PART_SETTINGS, /* [photometry], [corrections], [output] */
    PART_SATELLITE,
    PART_MATERIAL,
    PART_COMPONENT,
    PART_PRIMITIVE,
    PART_EXPECT,
    N_PARTS
};

/* A small scenario that is right: seven rows over Vienna, the satellite sunlit and in sight. */
static const char *const SOUND[N_PARTS] = {
    [PART_TOP] = "title = \"a white box\"\n",
    [PART_TIME] = "[time]\nstart = 2025-07-25T20:37:00Z\nduration_s = 60\nstep_s = 10\n",
    [PART_OBSERVER] = "[observer]\nlatitude_deg = 48.2\nlongitude_deg = 16.37\n",
    [PART_ORBIT] = "[orbit]\ncircular = { height_km = 780, inclination_deg = 98.6, raan_deg = 80, "
                   "argument_of_latitude_deg = 132 }\n",
    [PART_ATTITUDE] = "[attitude]\nlaw = \"nadir\"\n",
    [PART_MATERIAL] = "[materials.white]\nbrdf = \"lambert\"\nrho = 0.5\n",
    [PART_COMPONENT] = "[[component]]\nname = \"bus\"\n",
    [PART_PRIMITIVE] = "[[component.box]]\nsize_m = [1, 1, 1]\nmaterial = \"white\"\n",
};

/* The same box under directions that are given: five rows. */
static const char *const GIVEN[N_PARTS] = {
    [PART_TOP] = "title = \"a white box\"\n",
    [PART_TIME] = "[geometry]\nsweep = { phase_deg = [0, 120, 30], plane = \"xz\" }\n",
    [PART_MATERIAL] = "[materials.white]\nbrdf = \"lambert\"\nrho = 0.5\n",
    [PART_COMPONENT] = "[[component]]\nname = \"bus\"\n",
    [PART_PRIMITIVE] = "[[component.box]]\nsize_m = [1, 1, 1]\nmaterial = \"white\"\n",
};

enum { TEXT_SIZE = 8192 };

/* A text with the place that its '@' marked. */
typedef struct marked_text {
    char text[TEXT_SIZE];
    int line, column; /* 0 where there was no mark */
} marked_text;

/* Takes the first '@' out and notes where it stood. */
static inline void take_mark(marked_text *m)
{
    char *mark = strchr(m->text, '@');
    m->line = m->column = 0;
    if (!mark) return;
    m->line = m->column = 1;
    for (const char *c = m->text; c < mark; c++) {
        m->column = *c == '\n' ? 1 : m->column + 1;
        m->line += *c == '\n';
    }
    memmove(mark, mark + 1, strlen(mark));
}

/* The scenario `parts` with another text in place of one part. */
static inline marked_text with_part(const char *const parts[N_PARTS], enum part part,
                                    const char *replacement)
{
    marked_text out = {.text = ""};
    size_t n = 0;
    for (int k = 0; k < N_PARTS; k++) {
        const char *piece = k == (int)part ? replacement : parts[k] ? parts[k] : "";
        ck_assert_uint_lt(n + strlen(piece), sizeof out.text);
        strcpy(out.text + n, piece);
        n += strlen(piece);
    }
    take_mark(&out);
    return out;
}

/* ------------------------------------------------------------------ reading */

/* All entries of a list, for messages; a static buffer. */
static inline const char *list_errors(const glint_errors *errors)
{
    static char out[8192];
    size_t n = 0;
    out[0] = '\0';
    for (size_t k = 0; k < glint_errors_count(errors) && n + 1 < sizeof out; k++) {
        const glint_error *e = glint_errors_get(errors, k);
        n += (size_t)snprintf(out + n, sizeof out - n, "\n  %s:%d:%d: %s: %s", e->file, e->line,
                              e->column, e->severity == GLINT_ERROR ? "error" : "warning",
                              e->message);
    }
    return out;
}

/* Reads a scenario that must be right. glint_scenario_free ends it. */
static inline glint_scenario *read_sound_set(const char *path, const char *const *set, size_t n)
{
    glint_scenario *s;
    glint_errors *errors = glint_errors_new();
    const glint_status status = glint_scenario_read(path, set, n, &s, errors);
    ck_assert_msg(status == GLINT_OK, "%s:%s", path, list_errors(errors));
    ck_assert_uint_eq(glint_errors_error_count(errors), 0);
    ck_assert_ptr_nonnull(s);
    glint_errors_free(errors);
    return s;
}

static inline glint_scenario *read_sound(const char *path)
{
    return read_sound_set(path, NULL, 0);
}

/* Writes a scenario with one part replaced, and reads it; it must be right. */
static inline glint_scenario *read_with(const char *const parts[N_PARTS], enum part part,
                                        const char *replacement)
{
    const marked_text m = with_part(parts, part, replacement);
    return read_sound(write_file("scenario.toml", m.text));
}

/* True when some error stands at that place (line 0: anywhere) and holds both texts (NULL: any). */
static inline bool has_error(const glint_errors *errors, const char *file, int line, int column,
                             const char *found, const char *expected)
{
    for (size_t k = 0; k < glint_errors_count(errors); k++) {
        const glint_error *e = glint_errors_get(errors, k);
        if (e->severity == GLINT_ERROR && strcmp(e->file, file) == 0 &&
            (line == 0 || (e->line == line && e->column == column)) &&
            (!found || strstr(e->message, found)) && (!expected || strstr(e->message, expected)))
            return true;
    }
    return false;
}

/* Reads a scenario that must be refused with that error among exactly n errors. */
static inline void assert_refused_set(const char *path, const char *const *set, size_t n_set,
                                      const char *file, int line, int column, const char *found,
                                      const char *expected, size_t n)
{
    glint_scenario *s = (glint_scenario *)folder; /* must be cleared */
    glint_errors *errors = glint_errors_new();
    const glint_status status = glint_scenario_read(path, set, n_set, &s, errors);
    ck_assert_msg(status == GLINT_INPUT, "status %d; wanted '%s' and '%s' at %s:%d:%d", status,
                  found ? found : "", expected ? expected : "", file, line, column);
    ck_assert_ptr_null(s);
    ck_assert_msg(has_error(errors, file, line, column, found, expected),
                  "wanted %s:%d:%d with '%s' and '%s'; got:%s", file, line, column,
                  found ? found : "", expected ? expected : "", list_errors(errors));
    ck_assert_msg(glint_errors_error_count(errors) == n, "%zu errors wanted; got:%s", n,
                  list_errors(errors));
    glint_errors_free(errors);
    ck_assert_int_eq(glint_scenario_read(path, set, n_set, &s, NULL), GLINT_INPUT);
}

/* One wrong text in place of a part: the '@' marks where the error must be. */
typedef struct wrong_text {
    enum part part;
    const char *text, *found, *expected;
    size_t n; /* errors in all; 0 counts as 1 */
} wrong_text;

static inline void assert_wrong(const char *const parts[N_PARTS], const wrong_text *w)
{
    const marked_text m = with_part(parts, w->part, w->text);
    ck_assert_msg(m.line > 0, "no place is marked in:\n%s", w->text);
    const char *path = write_file("scenario.toml", m.text);
    assert_refused_set(path, NULL, 0, path, m.line, m.column, w->found, w->expected,
                       w->n ? w->n : 1);
}

#define COUNT_OF(array) (sizeof(array) / sizeof *(array))

static inline void assert_all_wrong(const char *const parts[N_PARTS], const wrong_text *all,
                                    size_t n)
{
    for (size_t k = 0; k < n; k++)
        assert_wrong(parts, &all[k]);
}

#define ASSERT_ALL_WRONG(parts, all) assert_all_wrong(parts, all, COUNT_OF(all))

#endif
