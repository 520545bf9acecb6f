/* mesh_obj.c: Wavefront OBJ: vertices, normals, polygons, groups, objects and names of materials.
 *
 * The format: Alias|Wavefront, Advanced Visualizer Manual, appendix B1 (1990s). Lines, points and
 * texture coordinates are skipped; free-form curves and surfaces are refused. */
#include "base/vec.h"
#include "facets/mesh.h"

#include <stdint.h>
#include <stdlib.h>

/* A word of a statement, not terminated. */
typedef struct word {
    const char *text;
    size_t n;
    int line, column;
} word;

/* A file being read. */
typedef struct obj_reader {
    const mesh_source *source;
    const char *next, *end;
    int line;
    const char *line_start;
    mesh *mesh;
    char *material, *group, *object; /* owned; of the faces that follow */
    bool labelled; /* the last label of the mesh is that of the faces that follow */
    int corner[MESH_MAX_CORNERS], normal[MESH_MAX_CORNERS]; /* of one face */
    int triangle[MESH_MAX_CORNERS][3];
    double polygon[MESH_MAX_CORNERS][3];
    glint_errors *errors; /* the source's */
} obj_reader;

static place place_of(const obj_reader *r, const word *w)
{
    return (place){r->source->path, w->line, w->column};
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* True when the reader stands at a backslash that carries the statement on to the next line. */
static bool is_continued(const obj_reader *r)
{
    const size_t left = (size_t)(r->end - r->next);
    if (left < 2 || r->next[0] != '\\') return false;
    return r->next[1] == '\n' || (left > 2 && r->next[1] == '\r' && r->next[2] == '\n');
}

static void start_line(obj_reader *r)
{
    r->line++;
    r->line_start = r->next;
}

/* Skips blanks within the statement. */
static void skip_blanks(obj_reader *r)
{
    for (;;) {
        while (r->next < r->end && is_blank(*r->next))
            r->next++;
        if (!is_continued(r)) return;
        while (*r->next++ != '\n') {
        }
        start_line(r);
    }
}

/* The next word of the statement; false at its end. */
static bool next_word(obj_reader *r, word *out)
{
    skip_blanks(r);
    if (r->next == r->end || *r->next == '\n' || *r->next == '#') return false;
    *out = (word){r->next, 0, r->line, (int)(r->next - r->line_start) + 1};
    while (r->next < r->end && *r->next != '\n' && !is_blank(*r->next) && !is_continued(r))
        r->next++;
    out->n = (size_t)(r->next - out->text);
    return true;
}

/* Goes to the line after the statement. */
static void end_statement(obj_reader *r)
{
    for (bool ended = false; !ended;) {
        while (r->next < r->end && *r->next != '\n' && !is_continued(r))
            r->next++;
        if (r->next == r->end) return;
        ended = !is_continued(r);
        while (*r->next++ != '\n') {
        }
        start_line(r);
    }
}

static bool word_is(const word *w, const char *name)
{
    return w->n == strlen(name) && memcmp(w->text, name, w->n) == 0;
}

static glint_status bad_word(const obj_reader *r, const word *w, const char *expected)
{
    return errors_add(r->errors, GLINT_INPUT, place_of(r, w), "'%.*s' is not %s",
                      (int)(w->n < 40 ? w->n : 40), w->text, expected);
}

/* Three numbers; what else stands in the statement (weights, colours) is skipped. */
static glint_status read_point(obj_reader *r, const word *head, double out[3])
{
    for (int j = 0; j < 3; j++) {
        word w;
        if (!next_word(r, &w))
            return errors_add(r->errors, GLINT_INPUT, place_of(r, head),
                              "'%.*s' has %d number%s; expected 3", (int)head->n, head->text, j,
                              j == 1 ? "" : "s");
        if (!number_read(w.text, w.n, &out[j])) return bad_word(r, &w, "a finite number");
    }
    return GLINT_OK;
}

/* The larger of two outcomes: memory that is out counts more than a wrong value. */
static glint_status worse(glint_status a, glint_status b)
{
    return a > b ? a : b;
}

/* A wrong vertex or normal has its number all the same, so that faces after it mean what they say.
 */
static glint_status read_vertex(obj_reader *r, const word *head)
{
    double v[3] = {0, 0, 0};
    glint_status status = read_point(r, head, v);
    for (int j = 0; j < 3 && !status; j++)
        if (fabs(v[j]) > r->source->most)
            status = errors_add(r->errors, GLINT_INPUT, place_of(r, head),
                                "the vertex " MESH_TOO_FAR, v[j], r->source->most);
    return worse(status, mesh_add_vertex(r->mesh, v, place_of(r, head), r->errors));
}

static glint_status read_normal(obj_reader *r, const word *head)
{
    double v[3] = {0, 0, 0}, unit[3];
    glint_status status = read_point(r, head, v);
    if (!(unit3(v, unit) > 0.0) && !status)
        status = errors_add(r->errors, GLINT_INPUT, place_of(r, head),
                            "the normal is zero; expected a direction");
    return worse(status, mesh_add_normal(r->mesh, unit, r->errors));
}

/* One index of a corner ("12" or, counted back from the last, "-1") up to a slash: *out counts from
 * 0. n: how many there are so far. */
static glint_status read_index(const obj_reader *r, const word *w, size_t *at, int n,
                               const char *what, int *out)
{
    size_t k = *at;
    const bool back = k < w->n && w->text[k] == '-';
    if (back) k++;
    const size_t digits = k;
    int64_t value = 0;
    for (; k < w->n && w->text[k] >= '0' && w->text[k] <= '9'; k++)
        if (value < INT32_MAX) value = 10 * value + (w->text[k] - '0'); /* more is none of ours */
    if (k == digits || (k < w->n && w->text[k] != '/'))
        return bad_word(r, w, "a corner; expected numbers such as 1, 1/2, 1//3 or 1/2/3");
    const int64_t index = back ? n - value : value - 1;
    if (index < 0 || index >= n)
        return errors_add(r->errors, GLINT_INPUT, place_of(r, w),
                          "'%.*s' names %s %s%lld, but there are %d so far", (int)w->n, w->text,
                          what, back ? "-" : "", (long long)value, n);
    *at = k;
    *out = (int)index;
    return GLINT_OK;
}

/* A corner: v, v/vt, v//vn or v/vt/vn. */
static glint_status read_corner(const obj_reader *r, const word *w, int *corner, int *normal)
{
    size_t at = 0;
    *normal = -1;
    glint_status status = read_index(r, w, &at, r->mesh->n_vertices, "vertex", corner);
    if (status || at == w->n) return status;
    at++; /* texture coordinates: digits that nobody looks up */
    while (at < w->n && w->text[at] != '/') {
        if ((w->text[at] < '0' || w->text[at] > '9') && w->text[at] != '-')
            return bad_word(r, w, "a corner; expected numbers such as 1, 1/2, 1//3 or 1/2/3");
        at++;
    }
    if (at == w->n) return GLINT_OK;
    at++;
    status = read_index(r, w, &at, r->mesh->n_normals, "normal", normal);
    if (!status && at != w->n)
        status = bad_word(r, w, "a corner; expected numbers such as 1, 1/2, 1//3 or 1/2/3");
    return status;
}

static char *copy_of(const char *name)
{
    return name ? string_copy(name, strlen(name)) : NULL;
}

/* Sees that the last label is that of the faces to come. */
static glint_status make_label(obj_reader *r, int line)
{
    if (r->labelled) return GLINT_OK;
    const mesh_label label = {.material = copy_of(r->material),
                              .group = copy_of(r->group),
                              .object = copy_of(r->object),
                              .line = line};
    const bool complete = (!r->material || label.material) && (!r->group || label.group) &&
                          (!r->object || label.object);
    const glint_status status =
        complete ? mesh_add_label(r->mesh, &label, r->errors) : errors_no_memory(r->errors);
    if (status) {
        free(label.material);
        free(label.group);
        free(label.object);
        return status;
    }
    r->labelled = true;
    return GLINT_OK;
}

static glint_status add_polygon(obj_reader *r, const word *head, int n)
{
    for (int k = 0; k < n; k++)
        copy3(r->mesh->vertices[r->corner[k]], r->polygon[k]);
    glint_status status = make_label(r, head->line);
    if (!status)
        status = mesh_cut_polygon(r->polygon, n, r->triangle, place_of(r, head), r->errors);
    for (int t = 0; t < n - 2 && !status; t++) {
        mesh_face face = {.label = r->mesh->n_labels - 1, .line = head->line};
        for (int j = 0; j < 3; j++) {
            face.corner[j] = r->corner[r->triangle[t][j]];
            face.normal[j] = r->normal[r->triangle[t][j]];
        }
        status = mesh_add_face(r->mesh, &face, place_of(r, head), r->errors);
    }
    return status;
}

static glint_status read_face(obj_reader *r, const word *head)
{
    word w;
    int n = 0;
    while (next_word(r, &w)) {
        if (n == MESH_MAX_CORNERS)
            return errors_add(r->errors, GLINT_INPUT, place_of(r, head),
                              "a face has more than %d corners; expected fewer", MESH_MAX_CORNERS);
        const glint_status status = read_corner(r, &w, &r->corner[n], &r->normal[n]);
        if (status) return status;
        n++;
    }
    if (n < 3)
        return errors_add(r->errors, GLINT_INPUT, place_of(r, head),
                          "a face has %d corner%s; expected 3 or more", n, n == 1 ? "" : "s");
    return add_polygon(r, head, n);
}

/* The rest of the statement, its words parted by single blanks, in place of *name (owned). */
static glint_status read_name(obj_reader *r, char **name)
{
    text all = {0};
    word w;
    while (next_word(r, &w)) {
        if (all.length) text_char(&all, ' ');
        text_append(&all, w.text, w.n);
    }
    if (all.failed) {
        text_free(&all);
        return errors_no_memory(r->errors);
    }
    free(*name);
    *name = all.data;
    r->labelled = false;
    return GLINT_OK;
}

static glint_status refuse(const obj_reader *r, const word *head)
{
    static const char *const free_form[] = {"cstype", "deg",  "bmat", "step", "curv", "curv2",
                                            "surf",   "parm", "trim", "hole", "scrv", "sp",
                                            "end",    "con",  "mg",   "call", "csh",  "vp"};
    static const char *const known[] = {"v",      "vt",     "vn", "f", "g", "o",
                                        "usemtl", "mtllib", "s",  "l", "p"};
    for (size_t k = 0; k < sizeof free_form / sizeof *free_form; k++)
        if (word_is(head, free_form[k]))
            return errors_add(r->errors, GLINT_INPUT, place_of(r, head),
                              "'%s' belongs to free-form surfaces, which are not read; expected "
                              "polygons: convert the mesh",
                              free_form[k]);
    char name[41] = "";
    memcpy(name, head->text, head->n < 40 ? head->n : 40);
    const char *near = nearest_name(name, known, sizeof known / sizeof *known);
    return errors_add(r->errors, GLINT_INPUT, place_of(r, head),
                      "'%s' begins no statement of an OBJ file%s%s%s", name,
                      near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
}

static glint_status read_statement(obj_reader *r, const word *head)
{
    static const char *const skipped[] = {
        "vt",    "mtllib",   "s",        "l",   "p",          "usemap",   "maplib",
        "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj"};
    if (word_is(head, "v")) return read_vertex(r, head);
    if (word_is(head, "vn")) return read_normal(r, head);
    if (word_is(head, "f")) return read_face(r, head);
    if (word_is(head, "g")) return read_name(r, &r->group);
    if (word_is(head, "o")) return read_name(r, &r->object);
    if (word_is(head, "usemtl")) return read_name(r, &r->material);
    for (size_t k = 0; k < sizeof skipped / sizeof *skipped; k++)
        if (word_is(head, skipped[k])) return GLINT_OK;
    return refuse(r, head);
}

/* Every statement ends with its line. Where the last line has no end, or says that it goes on, the
 * file was cut off within it, or may have been: a number that lacks digits looks like any other. */
static glint_status check_end(const mesh_source *s)
{
    const char *end = s->bytes + s->size, *start = end, *last = end;
    while (start > s->bytes && start[-1] != '\n')
        start--;
    while (last > start && is_blank(last[-1]))
        last--;
    bool is_cut = last > start;
    const char *at = start;
    if (!is_cut && start > s->bytes) { /* the line before */
        last = start - 1;
        if (last > s->bytes && last[-1] == '\r') last--;
        is_cut = last > s->bytes && last[-1] == '\\';
        at = last - 1;
    }
    if (!is_cut) return GLINT_OK;
    int line = 1;
    for (const char *c = s->bytes; c < at; c++)
        line += *c == '\n';
    return errors_add(s->errors, GLINT_INPUT, (place){s->path, line, 0},
                      "the file ends within this line: it may have been cut off; expected the end "
                      "of the line (add one if the file is whole)");
}

static glint_status read_statements(obj_reader *r)
{
    glint_status worst = GLINT_OK;
    int n_errors = 0;
    start_line(r);
    while (r->next < r->end && n_errors < MESH_MAX_ERRORS && worst != GLINT_INTERNAL) {
        word head;
        const glint_status status = next_word(r, &head) ? read_statement(r, &head) : GLINT_OK;
        n_errors += status != GLINT_OK;
        worst = worse(worst, status);
        if (status && r->mesh->n_faces == MESH_MAX_FACES) break; /* the others say the same */
        end_statement(r);
    }
    return worst;
}

glint_status mesh_read_obj(const mesh_source *source, mesh *out)
{
    if (memchr(source->bytes, '\0', source->size))
        return errors_add(source->errors, GLINT_INPUT, (place){source->path, 0, 0},
                          "the file holds a zero byte; expected the text of an OBJ file");
    obj_reader *r = calloc(1, sizeof *r);
    if (!r) return errors_no_memory(source->errors);
    *r = (obj_reader){.source = source,
                      .next = source->bytes,
                      .end = source->bytes + source->size,
                      .mesh = out,
                      .errors = source->errors};
    const glint_status status = worse(read_statements(r), check_end(source));
    free(r->material);
    free(r->group);
    free(r->object);
    free(r);
    return status;
}
