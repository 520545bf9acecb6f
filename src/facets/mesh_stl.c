/* mesh_stl.c: STL, text and binary.
 *
 * The format: 3D Systems, StereoLithography Interface Specification, 1989. Which side of a triangle
 * is outside follows from the order of its corners; the normal that the file repeats is only
 * compared. */
#include "base/vec.h"
#include "facets/mesh.h"

#include <ctype.h>
#include <stdint.h>
#include <stdlib.h>

/* A binary file: 80 bytes of anything, the number of triangles, and 50 bytes for each: normal and
 * corners as 12 floats, 2 bytes of anything. Little-endian. */
enum { HEADER = 80, START = 84, RECORD = 50 };

/* Adds a triangle; its three vertices are new. stated: the normal in the file. */
static glint_status add_triangle(mesh *m, const double corner[3][3], const double stated[3],
                                 place where, int line, glint_errors *errors)
{
    mesh_face face = {.normal = {-1, -1, -1}, .label = m->n_labels - 1, .line = line};
    double ab[3], ac[3], normal[3];
    for (int k = 0; k < 3; k++) {
        face.corner[k] = m->n_vertices;
        const glint_status status = mesh_add_vertex(m, corner[k], where, errors);
        if (status) return status;
    }
    sub3(corner[1], corner[0], ab);
    sub3(corner[2], corner[0], ac);
    cross3(ab, ac, normal);
    if (dot3(normal, stated) < 0.0 && m->n_backward++ == 0) m->first_backward = line;
    return mesh_add_face(m, &face, where, errors);
}

/* --- binary --- */

static uint32_t number_at(const unsigned char *b)
{
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static double float_at(const unsigned char *b)
{
    const uint32_t bits = number_at(b);
    float x;
    memcpy(&x, &bits, sizeof x);
    return (double)x;
}

static glint_status read_record(const mesh_source *s, uint32_t k, mesh *out)
{
    const place where = {s->path, 0, 0};
    const unsigned char *b = (const unsigned char *)s->bytes + START + (size_t)RECORD * k;
    const int number = (int)k + 1;
    double v[4][3];
    for (int j = 0; j < 12; j++) {
        double *x = &v[j / 3][j % 3];
        *x = float_at(b + 4 * j);
        if (j < 3) continue;
        if (!isfinite(*x))
            return errors_add(s->errors, GLINT_INPUT, where,
                              "triangle %d has a corner that is no finite number", number);
        if (fabs(*x) > s->most)
            return errors_add(s->errors, GLINT_INPUT, where, "triangle %d " MESH_TOO_FAR, number,
                              *x, s->most);
    }
    return add_triangle(out, v + 1, v[0], where, number, s->errors);
}

static glint_status read_binary(const mesh_source *s, uint32_t n, mesh *out)
{
    const mesh_label label = {.line = 1};
    out->is_binary = true;
    if (n > MESH_MAX_FACES)
        return errors_add(s->errors, GLINT_INPUT, (place){s->path, 0, 0},
                          "the file has %u triangles; expected at most %d", (unsigned)n,
                          MESH_MAX_FACES);
    glint_status worst = mesh_add_label(out, &label, s->errors);
    int n_errors = 0;
    for (uint32_t k = 0; k < n && n_errors < MESH_MAX_ERRORS && worst != GLINT_INTERNAL; k++) {
        const glint_status status = read_record(s, k, out);
        n_errors += status != GLINT_OK;
        if (status > worst) worst = status;
    }
    return worst;
}

/* --- text --- */

typedef struct stl_reader {
    const char *path, *next, *end, *line_start;
    int line;
    double most; /* as of mesh_read */
    mesh *mesh;
    glint_errors *errors;
    const char *word; /* the last one */
    size_t n;
    place where; /* of it */
} stl_reader;

/* Reads a word; at the end of the file it is empty. */
static void next_word(stl_reader *r)
{
    while (r->next < r->end && isspace((unsigned char)*r->next))
        if (*r->next++ == '\n') r->line++, r->line_start = r->next;
    r->word = r->next;
    r->where = (place){r->path, r->line, (int)(r->next - r->line_start) + 1};
    while (r->next < r->end && !isspace((unsigned char)*r->next))
        r->next++;
    r->n = (size_t)(r->next - r->word);
}

static bool word_is(const stl_reader *r, const char *name)
{
    if (r->n != strlen(name)) return false;
    for (size_t k = 0; k < r->n; k++)
        if (tolower((unsigned char)r->word[k]) != name[k]) return false;
    return true;
}

static glint_status fail(const stl_reader *r, const char *expected)
{
    if (r->n == 0)
        return errors_add(r->errors, GLINT_INPUT, r->where,
                          "the file ends too early; expected %s: it was cut off", expected);
    return errors_add(r->errors, GLINT_INPUT, r->where, "'%.*s' is unexpected; expected %s",
                      (int)(r->n < 40 ? r->n : 40), r->word, expected);
}

static glint_status expect(stl_reader *r, const char *name)
{
    next_word(r);
    return word_is(r, name) ? GLINT_OK : fail(r, name);
}

static glint_status read_point(stl_reader *r, bool is_corner, double out[3])
{
    for (int j = 0; j < 3; j++) {
        next_word(r);
        if (!number_read(r->word, r->n, &out[j])) {
            if (r->n == 0 || is_corner) return fail(r, "a finite number");
            out[j] = 0.0; /* writers put nan where a triangle has no area */
        }
        if (is_corner && fabs(out[j]) > r->most)
            return errors_add(r->errors, GLINT_INPUT, r->where, "the vertex " MESH_TOO_FAR, out[j],
                              r->most);
    }
    return GLINT_OK;
}

/* facet normal x y z, outer loop, three times vertex x y z, endloop, endfacet; "facet" was read. */
static glint_status read_facet(stl_reader *r)
{
    double stated[3], corner[3][3];
    const place where = r->where;
    glint_status status = expect(r, "normal");
    if (!status) status = read_point(r, false, stated);
    if (!status) status = expect(r, "outer");
    if (!status) status = expect(r, "loop");
    for (int k = 0; k < 3 && !status; k++) {
        status = expect(r, "vertex");
        if (!status) status = read_point(r, true, corner[k]);
    }
    if (!status) status = expect(r, "endloop");
    if (!status) status = expect(r, "endfacet");
    if (status) return status;
    return add_triangle(r->mesh, corner, stated, where, where.line, r->errors);
}

/* The rest of the line, without the blanks about it; "solid" was read. */
static glint_status read_solid_name(stl_reader *r)
{
    const char *from = r->next;
    while (r->next < r->end && *r->next != '\n')
        r->next++;
    const char *to = r->next;
    while (from < to && isspace((unsigned char)*from))
        from++;
    while (to > from && isspace((unsigned char)to[-1]))
        to--;
    mesh_label label = {.line = r->line};
    if (to > from) {
        label.object = string_copy(from, (size_t)(to - from));
        if (!label.object) return errors_no_memory(r->errors);
    }
    const glint_status status = mesh_add_label(r->mesh, &label, r->errors);
    if (status) free(label.object);
    return status;
}

static glint_status read_solid(stl_reader *r)
{
    glint_status status = read_solid_name(r);
    while (!status) {
        next_word(r);
        if (word_is(r, "endsolid")) break;
        status = word_is(r, "facet") ? read_facet(r) : fail(r, "facet or endsolid");
    }
    while (!status && r->next < r->end && *r->next != '\n')
        r->next++; /* the name once more */
    return status;
}

static glint_status read_text(const mesh_source *s, mesh *out)
{
    stl_reader r = {.path = s->path,
                    .next = s->bytes,
                    .end = s->bytes + s->size,
                    .line_start = s->bytes,
                    .line = 1,
                    .most = s->most,
                    .mesh = out,
                    .errors = s->errors};
    for (next_word(&r); r.n > 0; next_word(&r)) {
        const glint_status status = word_is(&r, "solid") ? read_solid(&r) : fail(&r, "solid");
        if (status) return status;
    }
    return GLINT_OK;
}

static bool begins_solid(const char *bytes, size_t size)
{
    static const char solid[] = "solid";
    size_t start = 0, n = 0;
    while (start < size && isspace((unsigned char)bytes[start]))
        start++;
    while (n < 5 && start + n < size && tolower((unsigned char)bytes[start + n]) == solid[n])
        n++;
    return n == 5;
}

/* A binary file says how long it is; text begins with the word solid. Either may look like the
 * other, but not in both ways. */
glint_status mesh_read_stl(const mesh_source *s, mesh *out)
{
    const place where = {s->path, 0, 0};
    const uint32_t n = s->size >= START ? number_at((const unsigned char *)s->bytes + HEADER) : 0;
    const unsigned long long size = (unsigned long long)START + (unsigned long long)RECORD * n;
    if (s->size >= START && s->size == size) return read_binary(s, n, out);
    if (begins_solid(s->bytes, s->size) && !memchr(s->bytes, '\0', s->size))
        return read_text(s, out);
    if (s->size < START)
        return errors_add(
            s->errors, GLINT_INPUT, where,
            "the file has %zu bytes and is no text; expected 84 or more of an STL file", s->size);
    return errors_add(s->errors, GLINT_INPUT, where,
                      "the file has %zu bytes, but says that it holds %u triangles, which take "
                      "%llu; expected a whole STL file: %s, or it is none",
                      s->size, (unsigned)n, size,
                      s->size < size ? "it was cut off" : "something follows the triangles");
}
