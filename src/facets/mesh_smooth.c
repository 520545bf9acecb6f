#include "facets/mesh_smooth.h"

#include "base/vec.h"

#include <stdlib.h>

void mesh_corners_free(mesh_corners *c)
{
    if (!c) return;
    free(c->is_smooth);
    free(c->normal);
    *c = (mesh_corners){0};
}

/* Which faces meet at each vertex. */
typedef struct meeting {
    int *first; /* owned; n_vertices + 1 */
    int *face;  /* owned; those at vertex v are face[first[v]] .. [first[v + 1] - 1] */
} meeting;

static bool find_meetings(const mesh *m, meeting *out)
{
    out->first = calloc((size_t)m->n_vertices + 2, sizeof *out->first);
    out->face = malloc(3 * (size_t)m->n_faces * sizeof *out->face);
    if (!out->first || !out->face) return false;
    int *end = out->first + 1; /* counts, then where the next face of each vertex goes */
    for (int f = 0; f < m->n_faces; f++)
        for (int j = 0; j < 3; j++)
            end[m->faces[f].corner[j] + 1]++;
    for (int v = 0; v < m->n_vertices; v++)
        end[v + 1] += end[v];
    for (int f = 0; f < m->n_faces; f++)
        for (int j = 0; j < 3; j++)
            out->face[end[m->faces[f].corner[j]]++] = f;
    return true;
}

/* The angle of face f at vertex v, rad: by it a face counts, so that how a surface is cut into
 * triangles does not matter (Thuermer and Wuethrich 1998, Journal of Graphics Tools 3(1), 43). */
static double angle_at(const mesh *m, int f, int v)
{
    const int *c = m->faces[f].corner;
    const int at = c[0] == v ? 0 : c[1] == v ? 1 : 2;
    double to[3], from[3];
    sub3(m->vertices[c[(at + 1) % 3]], m->vertices[v], to);
    sub3(m->vertices[c[(at + 2) % 3]], m->vertices[v], from);
    return angle3(to, from);
}

/* Faces at one vertex that are looked at; of more only every second, third, ..., so that the tip of
 * a cone of many faces does not take the square of their number. */
enum { LOOKED_AT = 256 };

/* The mean normal at a vertex of the faces there that meet face f at less than an angle. */
static void mean_normal(const mesh *m, const double (*normals)[3], const meeting *at, int f, int v,
                        double below, double out[3])
{
    double sum[3] = {0, 0, 0};
    const int step = 1 + (at->first[v + 1] - at->first[v] - 1) / LOOKED_AT;
    for (int k = at->first[v]; k < at->first[v + 1]; k += step) {
        const int other = at->face[k];
        if (angle3(normals[other], normals[f]) >= below) continue;
        add_scaled3(sum, angle_at(m, other, v), normals[other], sum);
    }
    if (!(unit3(sum, out) > 0.0)) copy3(normals[f], out);
}

/* Takes the normals of the file for face f; false when it has none. */
static bool take_normals(const mesh *m, const double (*normals)[3], int f, double out[3][3],
                         bool *backward)
{
    *backward = false;
    for (int j = 0; j < 3; j++) {
        const int k = m->faces[f].normal[j];
        if (k < 0) return false;
        copy3(m->normals[k], out[j]);
        if (!(dot3(out[j], normals[f]) > 0.0)) *backward = true;
    }
    return true;
}

/* Normals at corners nearer to each other than this are one, rad: files that write them with four
 * digits round by up to 1.4e-4. */
#define SAME_NORMAL_RAD 2e-4

static bool differ(const double corner[3][3])
{
    for (int j = 0; j < 3; j++)
        if (angle3(corner[j], corner[(j + 1) % 3]) > SAME_NORMAL_RAD) return true;
    return false;
}

static void smooth_face(const mesh *m, const double (*normals)[3], const smoothing *how,
                        const meeting *at, int f, mesh_corners *out, mesh_defects *defects)
{
    bool backward;
    bool given = take_normals(m, normals, f, out->normal[f], &backward);
    if (given && backward) mesh_defect_note(defects, DEFECT_BACKWARD, m->faces[f].line);
    given = given && how->from_file;
    if (given ? backward : !(how->below > 0.0)) return;
    for (int j = 0; j < 3 && !given; j++)
        mean_normal(m, normals, at, f, m->faces[f].corner[j], how->below, out->normal[f][j]);
    out->is_smooth[f] = differ(out->normal[f]);
}

glint_status mesh_smooth(const mesh *m, const double (*normals)[3], const smoothing *how,
                         mesh_corners *out, mesh_defects *defects, glint_error *error)
{
    meeting at = {0};
    out->is_smooth = calloc((size_t)m->n_faces, sizeof *out->is_smooth);
    out->normal = malloc((size_t)m->n_faces * sizeof *out->normal);
    const bool ok = out->is_smooth && out->normal && (!(how->below > 0.0) || find_meetings(m, &at));
    for (int f = 0; f < m->n_faces && ok; f++)
        smooth_face(m, normals, how, &at, f, out, defects);
    if (ok && m->n_backward > 0) { /* the reader's; there are no normals at corners then */
        defects->n[DEFECT_BACKWARD] = m->n_backward;
        defects->line[DEFECT_BACKWARD][0] = m->first_backward;
    }
    free(at.first);
    free(at.face);
    if (!ok) {
        mesh_corners_free(out);
        return error_no_memory(error);
    }
    return GLINT_OK;
}
