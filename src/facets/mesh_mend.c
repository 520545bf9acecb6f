#include "facets/mesh_mend.h"

#include "base/vec.h"
#include "facets/mesh_merge.h"
#include "facets/weld.h"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>

/* Twice the area over the square of the longest side, below which a triangle is a line. */
#define LINE_AREA 1e-9

const char *mesh_defect_words(mesh_defect defect, int n)
{
    static const char *const words[N_DEFECTS][2] = {
        [DEFECT_UNUSED] = {"vertex that no face uses", "vertices that no face uses"},
        [DEFECT_DEGENERATE] = {"face without area", "faces without area"},
        [DEFECT_DUPLICATE] = {"face that stands there already", "faces that stand there already"},
        [DEFECT_REVERSED] = {"face that looks the other way than its neighbours",
                             "faces that look the other way than their neighbours"},
        [DEFECT_INSIDE_OUT] = {"face of a closed piece that is inside out",
                               "faces of closed pieces that are inside out"},
        [DEFECT_CROWDED] = {"edge of more than two faces", "edges of more than two faces"},
        [DEFECT_OPEN] = {"open edge", "open edges"},
        [DEFECT_BACKWARD] = {"face whose normal in the file looks the other way",
                             "faces whose normals in the file look the other way"},
    };
    return words[defect][n == 1 ? 0 : 1];
}

bool mesh_defect_is_mended(mesh_defect defect)
{
    return defect == DEFECT_DUPLICATE || defect == DEFECT_REVERSED || defect == DEFECT_INSIDE_OUT;
}

void mesh_defect_note(mesh_defects *d, mesh_defect defect, int line)
{
    int *lines = d->line[defect], kept = 0, at = 0;
    d->n[defect]++;
    while (kept < DEFECT_EXAMPLES && lines[kept] > 0)
        kept++;
    while (at < kept && lines[at] < line)
        at++;
    if (at == DEFECT_EXAMPLES || (at < kept && lines[at] == line)) return;
    for (int k = kept < DEFECT_EXAMPLES ? kept : DEFECT_EXAMPLES - 1; k > at; k--)
        lines[k] = lines[k - 1];
    lines[at] = line;
}

/* --- faces --- */

static glint_status count_unused(const mesh *m, mesh_defects *d, glint_error *error)
{
    bool *used = calloc((size_t)m->n_vertices, sizeof *used);
    if (!used) return error_no_memory(error);
    for (int f = 0; f < m->n_faces; f++)
        for (int j = 0; j < 3; j++)
            used[m->faces[f].corner[j]] = true;
    for (int v = 0; v < m->n_vertices; v++)
        d->n[DEFECT_UNUSED] += !used[v];
    free(used);
    return GLINT_OK;
}

static glint_status weld(mesh *m, double same_m, glint_error *error)
{
    int *numbers = malloc((size_t)m->n_vertices * sizeof *numbers);
    if (!numbers) return error_no_memory(error);
    const glint_status status =
        weld_vertices_within(m->vertices, m->n_vertices, same_m, numbers, error);
    for (int f = 0; f < m->n_faces && !status; f++)
        for (int j = 0; j < 3; j++)
            m->faces[f].corner[j] = numbers[m->faces[f].corner[j]];
    free(numbers);
    return status;
}

static bool is_degenerate(const mesh *m, const mesh_face *f)
{
    if (f->corner[0] == f->corner[1] || f->corner[1] == f->corner[2] ||
        f->corner[2] == f->corner[0])
        return true;
    double ab[3], ac[3], bc[3], across[3];
    sub3(m->vertices[f->corner[1]], m->vertices[f->corner[0]], ab);
    sub3(m->vertices[f->corner[2]], m->vertices[f->corner[0]], ac);
    sub3(ac, ab, bc);
    cross3(ab, ac, across);
    const double longest2 = fmax(dot3(ab, ab), fmax(dot3(ac, ac), dot3(bc, bc)));
    return !(norm3(across) > LINE_AREA * longest2);
}

static void drop_face(mesh *m, int from, int *to, bool drop)
{
    if (drop)
        m->labels[m->faces[from].label].n_faces--;
    else
        m->faces[(*to)++] = m->faces[from];
}

static void drop_degenerate(mesh *m, mesh_defects *d)
{
    int kept = 0;
    for (int f = 0; f < m->n_faces; f++) {
        const bool drop = is_degenerate(m, &m->faces[f]);
        if (drop) mesh_defect_note(d, DEFECT_DEGENERATE, m->faces[f].line);
        drop_face(m, f, &kept, drop);
    }
    m->n_faces = kept;
}

/* A face by its corners, the smallest first, in their order. */
typedef struct face_key {
    int corner[3], face;
} face_key;

static int compare_keys(const void *a, const void *b)
{
    const face_key *p = a, *q = b;
    for (int j = 0; j < 3; j++)
        if (p->corner[j] != q->corner[j]) return p->corner[j] < q->corner[j] ? -1 : 1;
    return (p->face > q->face) - (p->face < q->face);
}

static glint_status find_duplicates(mesh *m, bool repair, mesh_defects *d, glint_error *error)
{
    const int n = m->n_faces;
    face_key *keys = malloc((size_t)n * sizeof *keys);
    bool *drop = calloc((size_t)n, sizeof *drop);
    const bool ok = keys && drop;
    for (int f = 0; f < n && ok; f++) {
        const int *c = m->faces[f].corner;
        const int first = c[0] < c[1] && c[0] < c[2] ? 0 : c[1] < c[2] ? 1 : 2;
        keys[f] = (face_key){{c[first], c[(first + 1) % 3], c[(first + 2) % 3]}, f};
    }
    if (ok) qsort(keys, (size_t)n, sizeof *keys, compare_keys);
    for (int k = 1; k < n && ok; k++) {
        if (memcmp(keys[k].corner, keys[k - 1].corner, sizeof keys[k].corner) != 0) continue;
        mesh_defect_note(d, DEFECT_DUPLICATE, m->faces[keys[k].face].line);
        drop[keys[k].face] = repair;
    }
    int kept = 0;
    for (int f = 0; f < n && ok; f++)
        drop_face(m, f, &kept, drop[f]);
    if (ok) m->n_faces = kept;
    free(keys);
    free(drop);
    return ok ? GLINT_OK : error_no_memory(error);
}

/* --- edges --- */

enum { MOST_PAIRED = 8 }; /* faces at one edge that are told apart */

/* One side of a face, to be sorted by the edge that it runs along. */
typedef struct edge_use {
    int low, high, half_edge;
} edge_use;

static int compare_uses(const void *a, const void *b)
{
    const edge_use *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    if (p->high != q->high) return p->high < q->high ? -1 : 1;
    return (p->half_edge > q->half_edge) - (p->half_edge < q->half_edge);
}

static int origin_of(const mesh *m, int half_edge)
{
    return m->faces[half_edge / 3].corner[half_edge % 3];
}

static int end_of(const mesh *m, int half_edge)
{
    return m->faces[half_edge / 3].corner[(half_edge % 3 + 1) % 3];
}

/* All half-edges, those of one edge side by side; NULL when memory is out. */
static edge_use *sorted_uses(const mesh *m)
{
    const int n = 3 * m->n_faces;
    edge_use *uses = malloc((size_t)n * sizeof *uses);
    for (int h = 0; h < n && uses; h++) {
        const int from = origin_of(m, h), to = end_of(m, h);
        uses[h] = (edge_use){from < to ? from : to, from < to ? to : from, h};
    }
    if (uses) qsort(uses, (size_t)n, sizeof *uses, compare_uses);
    return uses;
}

/* The end of the run of uses of the same edge that begins at k. */
static int run_end(const edge_use *uses, int n, int k)
{
    int end = k + 1;
    while (end < n && uses[end].low == uses[k].low && uses[end].high == uses[k].high)
        end++;
    return end;
}

/* The unit normal of a face. */
static void face_normal(const mesh *m, int f, double out[3])
{
    double ab[3], ac[3], across[3];
    sub3(m->vertices[m->faces[f].corner[1]], m->vertices[m->faces[f].corner[0]], ab);
    sub3(m->vertices[m->faces[f].corner[2]], m->vertices[m->faces[f].corner[0]], ac);
    cross3(ab, ac, across);
    unit3(across, out);
}

/* True when two half-edges run along an edge both ways, and their faces go on in one plane. */
static bool goes_on(const mesh *m, int a, int b)
{
    if (origin_of(m, a) == origin_of(m, b)) return false;
    double na[3], nb[3];
    face_normal(m, a / 3, na);
    face_normal(m, b / 3, nb);
    return angle3(na, nb) <= MERGE_ANGLE_RAD;
}

/* Pairs the uses k .. end - 1 of an edge of more than two faces: of sheets that have faces on both
 * sides each side goes on by itself. pair[i]: the half-edge across from use k + i, or -1. True when
 * all are paired. */
static bool pair_uses(const mesh *m, const edge_use *uses, int k, int end, int pair[MOST_PAIRED])
{
    for (int i = 0; i < MOST_PAIRED; i++)
        pair[i] = -1;
    if (end - k > MOST_PAIRED) return false;
    bool all = true;
    for (int i = 0; i < end - k; i++) {
        for (int j = i + 1; j < end - k && pair[i] < 0; j++)
            if (pair[j] < 0 && goes_on(m, uses[k + i].half_edge, uses[k + j].half_edge)) {
                pair[i] = uses[k + j].half_edge;
                pair[j] = uses[k + i].half_edge;
            }
        all = all && pair[i] >= 0;
    }
    return all;
}

glint_status mesh_twins(const mesh *m, int *twin, glint_error *error)
{
    const int n = 3 * m->n_faces;
    edge_use *uses = sorted_uses(m);
    if (!uses) return error_no_memory(error);
    for (int k = 0; k < n; k++)
        twin[k] = -1;
    for (int k = 0, end; k < n; k = end) {
        end = run_end(uses, n, k);
        const int a = uses[k].half_edge, b = uses[end - 1].half_edge;
        int pair[MOST_PAIRED];
        if (end - k == 2 && origin_of(m, a) != origin_of(m, b)) {
            twin[a] = b;
            twin[b] = a;
        } else if (end - k > 2) {
            (void)pair_uses(m, uses, k, end, pair);
            for (int i = k; i < end && i < k + MOST_PAIRED; i++)
                twin[uses[i].half_edge] = pair[i - k];
        }
    }
    free(uses);
    return GLINT_OK;
}

/* --- pieces --- */

/* Faces that hang together along edges of two, and which of them are to be turned. */
typedef struct pieces {
    const mesh *mesh;
    int *neighbour; /* owned; 3 n_faces: the face across each side, or -1 */
    bool *against;  /* owned; 3 n_faces: that face is wound the other way */
    int *piece;     /* owned; of each face */
    bool *turned;   /* owned; against the first face of its piece */
    int *queue;     /* owned; n_faces */
    bool *closed;   /* owned; by piece, n_faces at most */
} pieces;

static void pieces_free(pieces *p)
{
    free(p->neighbour);
    free(p->against);
    free(p->piece);
    free(p->turned);
    free(p->queue);
    free(p->closed);
}

static bool pieces_allocate(pieces *p)
{
    const size_t n = (size_t)p->mesh->n_faces;
    p->neighbour = malloc(3 * n * sizeof *p->neighbour);
    p->against = calloc(3 * n, sizeof *p->against);
    p->piece = malloc(n * sizeof *p->piece);
    p->turned = calloc(n, sizeof *p->turned);
    p->queue = malloc(n * sizeof *p->queue);
    p->closed = malloc(n * sizeof *p->closed);
    return p->neighbour && p->against && p->piece && p->turned && p->queue && p->closed;
}

/* Finds the neighbours, and notes edges of one face and of more than two. */
static glint_status find_neighbours(pieces *p, mesh_defects *d, glint_error *error)
{
    const mesh *m = p->mesh;
    const int n = 3 * m->n_faces;
    edge_use *uses = sorted_uses(m);
    if (!uses) return error_no_memory(error);
    for (int k = 0; k < n; k++)
        p->neighbour[k] = -1;
    for (int k = 0, end; k < n; k = end) {
        end = run_end(uses, n, k);
        const int a = uses[k].half_edge, b = uses[end - 1].half_edge;
        if (end - k == 1) mesh_defect_note(d, DEFECT_OPEN, m->faces[a / 3].line);
        if (end - k == 2) {
            p->neighbour[a] = b / 3;
            p->neighbour[b] = a / 3;
            p->against[a] = p->against[b] = origin_of(m, a) == origin_of(m, b);
        }
        if (end - k <= 2) continue;
        int pair[MOST_PAIRED];
        if (!pair_uses(m, uses, k, end, pair))
            mesh_defect_note(d, DEFECT_CROWDED, m->faces[a / 3].line);
        for (int i = k; i < end && i < k + MOST_PAIRED; i++)
            if (pair[i - k] >= 0) p->neighbour[uses[i].half_edge] = pair[i - k] / 3;
    }
    free(uses);
    return GLINT_OK;
}

/* Walks over the piece of a face from there, and turns what is wound against it. Returns how many
 * faces it has; they stand in the queue. */
static int walk(pieces *p, int start, int number)
{
    int n = 0;
    p->closed[number] = true;
    p->piece[start] = number;
    p->queue[n++] = start;
    for (int k = 0; k < n; k++)
        for (int j = 0; j < 3; j++) {
            const int side = 3 * p->queue[k] + j, other = p->neighbour[side];
            if (other < 0) p->closed[number] = false;
            if (other < 0 || p->piece[other] >= 0) continue;
            p->piece[other] = number;
            p->turned[other] = p->turned[p->queue[k]] != p->against[side];
            p->queue[n++] = other;
        }
    return n;
}

/* Area of a face, and six times the volume between it and a point. */
static double face_area(const mesh *m, int f, const double from[3], double *six_volumes)
{
    double a[3], b[3], c[3], ab[3], ac[3], across[3];
    sub3(m->vertices[m->faces[f].corner[0]], from, a);
    sub3(m->vertices[m->faces[f].corner[1]], from, b);
    sub3(m->vertices[m->faces[f].corner[2]], from, c);
    sub3(b, a, ab), sub3(c, a, ac);
    cross3(ab, ac, across);
    *six_volumes = dot3(a, across);
    return 0.5 * norm3(across);
}

/* Decides which way round a piece of n faces in the queue is right: by its volume where it is
 * closed, by what most of its area says where not. Notes what is turned. */
static void judge(pieces *p, int n, int number, mesh_defects *d)
{
    const mesh *m = p->mesh;
    const double *from = m->vertices[m->faces[p->queue[0]].corner[0]];
    double kept = 0.0, turned = 0.0, volume = 0.0;
    for (int k = 0; k < n; k++) {
        const int f = p->queue[k];
        double six_volumes;
        const double area = face_area(m, f, from, &six_volumes);
        *(p->turned[f] ? &turned : &kept) += area;
        volume += p->turned[f] ? -six_volumes : six_volumes;
    }
    const bool majority_turned = turned > kept;
    /* As seen from the first face, which stays; then as most of the area says. */
    const bool inside_out = p->closed[number] && (majority_turned ? volume > 0.0 : volume < 0.0);
    for (int k = 0; k < n; k++) {
        const int f = p->queue[k];
        const bool minority = p->turned[f] != majority_turned;
        if (minority) mesh_defect_note(d, DEFECT_REVERSED, m->faces[f].line);
        if (inside_out) mesh_defect_note(d, DEFECT_INSIDE_OUT, m->faces[f].line);
        p->turned[f] = minority != inside_out;
    }
}

static void turn_face(mesh_face *f)
{
    const int corner = f->corner[1], normal = f->normal[1];
    f->corner[1] = f->corner[2], f->corner[2] = corner;
    f->normal[1] = f->normal[2], f->normal[2] = normal;
}

static glint_status find_pieces(mesh *m, bool repair, mesh_defects *d, glint_error *error)
{
    pieces p = {.mesh = m};
    glint_status status = pieces_allocate(&p) ? GLINT_OK : error_no_memory(error);
    if (!status) status = find_neighbours(&p, d, error);
    for (int f = 0; f < m->n_faces && !status; f++)
        p.piece[f] = -1;
    for (int f = 0; f < m->n_faces && !status; f++) {
        if (p.piece[f] >= 0) continue;
        judge(&p, walk(&p, f, d->n_pieces), d->n_pieces, d);
        d->n_pieces++;
    }
    for (int f = 0; f < m->n_faces && !status && repair; f++)
        if (p.turned[f]) turn_face(&m->faces[f]);
    pieces_free(&p);
    return status;
}

glint_status mesh_mend(mesh *m, double same_m, bool repair, mesh_defects *out, glint_error *error)
{
    *out = (mesh_defects){0};
    glint_status status = count_unused(m, out, error);
    if (!status) status = weld(m, same_m, error);
    if (status) return status;
    drop_degenerate(m, out);
    if (m->n_faces == 0)
        return error_set(error, GLINT_INPUT, PLACE_NONE,
                         "all faces of the mesh are without area within %.3g m, where vertices are "
                         "one; expected a larger mesh: check unit or scale",
                         same_m);
    status = find_duplicates(m, repair, out, error);
    if (!status) status = find_pieces(m, repair, out, error);
    return status;
}
