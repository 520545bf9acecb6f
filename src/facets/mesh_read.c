/* mesh_read.c: meshes as their files have them. */
#include "base/grow.h"
#include "base/vec.h"
#include "facets/mesh.h"

#include <ctype.h>
#include <stdlib.h>

void mesh_free(mesh *m)
{
    if (!m) return;
    for (int k = 0; k < m->n_labels; k++) {
        free(m->labels[k].material);
        free(m->labels[k].group);
        free(m->labels[k].object);
    }
    free(m->labels);
    free(m->vertices);
    free(m->normals);
    free(m->faces);
    *m = (mesh){0};
}

glint_status mesh_add_vertex(mesh *m, const double v[3], place where, glint_errors *errors)
{
    if (m->n_vertices == MESH_MAX_VERTICES)
        return errors_add(errors, GLINT_INPUT, where, "more than %d vertices; expected fewer",
                          MESH_MAX_VERTICES);
    if (!grow_room(&m->vertices, &m->vertex_capacity, m->n_vertices + 1L, sizeof *m->vertices))
        return errors_no_memory(errors);
    copy3(v, m->vertices[m->n_vertices++]);
    return GLINT_OK;
}

glint_status mesh_add_normal(mesh *m, const double v[3], glint_errors *errors)
{
    if (!grow_room(&m->normals, &m->normal_capacity, m->n_normals + 1L, sizeof *m->normals))
        return errors_no_memory(errors);
    copy3(v, m->normals[m->n_normals++]);
    return GLINT_OK;
}

glint_status mesh_add_face(mesh *m, const mesh_face *face, place where, glint_errors *errors)
{
    if (m->n_faces == MESH_MAX_FACES)
        return errors_add(errors, GLINT_INPUT, where, "more than %d triangles; expected fewer",
                          MESH_MAX_FACES);
    if (!grow_room(&m->faces, &m->face_capacity, m->n_faces + 1L, sizeof *m->faces))
        return errors_no_memory(errors);
    m->faces[m->n_faces++] = *face;
    m->labels[face->label].n_faces++;
    return GLINT_OK;
}

glint_status mesh_add_label(mesh *m, const mesh_label *label, glint_errors *errors)
{
    if (!grow_room(&m->labels, &m->label_capacity, m->n_labels + 1L, sizeof *m->labels))
        return errors_no_memory(errors);
    m->labels[m->n_labels++] = *label;
    return GLINT_OK;
}

/* --- polygons --- */

/* What areas may be off by, over that of a square about them. */
#define ROUNDING 1e-9

/* A polygon in its plane; what is left of it is a ring. */
typedef struct ring {
    double (*at)[2];
    int *next, *before;
} ring;

/* Twice the area of a triangle of the ring's points, positive where it turns left. */
static double turn(const ring *r, int a, int b, int c)
{
    return (r->at[b][0] - r->at[a][0]) * (r->at[c][1] - r->at[a][1]) -
           (r->at[b][1] - r->at[a][1]) * (r->at[c][0] - r->at[a][0]);
}

/* Corners fall on each other where an outline runs to a hole and back. */
static bool same_place(const ring *r, int a, int b)
{
    return r->at[a][0] == r->at[b][0] && r->at[a][1] == r->at[b][1];
}

/* True when corner k can be cut off: it turns left, and no other corner lies in the triangle. */
static bool is_ear(const ring *r, int k)
{
    const int a = r->before[k], c = r->next[k];
    if (!(turn(r, a, k, c) > 0.0)) return false;
    for (int p = r->next[c]; p != a; p = r->next[p])
        if (turn(r, a, k, p) >= 0.0 && turn(r, k, c, p) >= 0.0 && turn(r, c, a, p) >= 0.0 &&
            turn(r, r->before[p], p, r->next[p]) < 0.0 && !same_place(r, p, a) &&
            !same_place(r, p, k) && !same_place(r, p, c))
            return false;
    return true;
}

/* The polygon in its mean plane (Newell's normal), anticlockwise. False where it has no such plane,
 * though it has some area: as a figure of eight. */
static bool flatten(const double (*vertices)[3], int n, double (*out)[2])
{
    double sum[3] = {0, 0, 0}, parts = 0.0, normal[3], first[3], second[3], a[3], b[3], c[3];
    for (int k = 1; k + 1 < n; k++) {
        sub3(vertices[k], vertices[0], a);
        sub3(vertices[k + 1], vertices[0], b);
        cross3(a, b, c);
        add3(sum, c, sum);
        parts += norm3(c);
    }
    static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (unit3(sum, normal) < ROUNDING * parts) return false;
    perp3(axes[smallest3(normal)], normal, first);
    cross3(normal, first, second);
    for (int k = 0; k < n; k++) {
        sub3(vertices[k], vertices[0], a);
        out[k][0] = dot3(a, first);
        out[k][1] = dot3(a, second);
    }
    return true;
}

/* Cuts off one corner after the other. Where none can be cut off any more the polygon has no area
 * left, or crosses itself: then it takes any, and the areas tell in the end. */
static void cut_ears(const ring *r, int n, int (*triangles)[3])
{
    int at = 0, left = n, misses = 0;
    for (int done = 0; left > 3;) {
        if (!is_ear(r, at) && misses < left) {
            at = r->next[at];
            misses++;
            continue;
        }
        triangles[done][0] = r->before[at];
        triangles[done][1] = at;
        triangles[done++][2] = r->next[at];
        r->next[r->before[at]] = r->next[at];
        r->before[r->next[at]] = r->before[at];
        at = r->next[r->next[at]]; /* not the neighbour: a fan of slivers */
        left--;
        misses = 0;
        if (left == 3) {
            triangles[done][0] = r->before[at];
            triangles[done][1] = at;
            triangles[done][2] = r->next[at];
        }
    }
}

/* True when triangles fill a polygon once: none of them lies upside down. */
static bool fill_once(const ring *r, int n, const int (*triangles)[3])
{
    double size2 = 0.0, backward = 0.0;
    for (int k = 1; k < n; k++) {
        const double x = r->at[k][0] - r->at[0][0], y = r->at[k][1] - r->at[0][1];
        size2 = fmax(size2, x * x + y * y);
    }
    for (int t = 0; t < n - 2; t++)
        backward -= fmin(0.0, turn(r, triangles[t][0], triangles[t][1], triangles[t][2]));
    return backward <= ROUNDING * size2;
}

glint_status mesh_cut_polygon(const double (*vertices)[3], int n, int (*triangles)[3], place where,
                              glint_errors *errors)
{
    if (n == 3) {
        triangles[0][0] = 0, triangles[0][1] = 1, triangles[0][2] = 2;
        return GLINT_OK;
    }
    ring r = {malloc((size_t)n * sizeof *r.at), malloc((size_t)n * sizeof *r.next),
              malloc((size_t)n * sizeof *r.before)};
    glint_status status = r.at && r.next && r.before ? GLINT_OK : errors_no_memory(errors);
    if (!status) {
        const bool has_plane = flatten(vertices, n, r.at);
        for (int k = 0; k < n; k++) {
            r.next[k] = (k + 1) % n;
            r.before[k] = (k + n - 1) % n;
        }
        if (has_plane) cut_ears(&r, n, triangles);
        if (!has_plane || !fill_once(&r, n, (const int(*)[3])triangles))
            status = errors_add(errors, GLINT_INPUT, where,
                                "the outline of the face crosses itself; expected one that does "
                                "not: cut the face into triangles");
    }
    free(r.at);
    free(r.next);
    free(r.before);
    return status;
}

/* --- files --- */

static bool has_suffix(const char *path, const char *suffix)
{
    const size_t n = strlen(path), m = strlen(suffix);
    for (size_t k = 0; k < m; k++)
        if (n < m || tolower((unsigned char)path[n - m + k]) != suffix[k]) return false;
    return true;
}

glint_status mesh_read(const char *path, place asked_from, double most, mesh *out,
                       glint_errors *errors)
{
    static const char mark[] = "\xef\xbb\xbf"; /* some editors begin texts with it: UTF-8 */
    *out = (mesh){0};
    const bool is_obj = has_suffix(path, ".obj");
    if (!is_obj && !has_suffix(path, ".stl"))
        return errors_add(
            errors, GLINT_INPUT, asked_from,
            "'%.200s' is neither an .obj nor an .stl file; expected one of these meshes", path);
    char *bytes;
    glint_error error;
    mesh_source source = {.path = path, .most = most, .errors = errors};
    glint_status status = file_read(path, &bytes, &source.size, asked_from, &error);
    if (status) return errors_take(errors, &error, asked_from);
    const size_t skip = is_obj && strncmp(bytes, mark, 3) == 0 ? 3 : 0;
    source.bytes = bytes + skip;
    source.size -= skip;
    status = is_obj ? mesh_read_obj(&source, out) : mesh_read_stl(&source, out);
    free(bytes);
    if (!status && out->n_faces == 0)
        status = errors_add(errors, GLINT_INPUT, (place){path, 0, 0},
                            "the mesh has no faces; expected at least one");
    if (status) mesh_free(out);
    return status;
}
