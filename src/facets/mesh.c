/* A mesh of triangles from a file. */
#include "facets/mesh.h"

#include "base/constants.h"
#include "base/vec.h"
#include "facets/mesh_mend.h"
#include "facets/mesh_merge.h"
#include "facets/mesh_smooth.h"
#include "facets/revolved.h"

#include <stdlib.h>

enum {
    FILE_PATH,
    UNIT,
    SCALE,
    UP,
    ORIGIN,
    TANGENT,
    MATERIAL,
    MATERIALS,
    FILE_NORMALS,
    SMOOTH,
    WELD,
    REPAIR,
    N_KEYS
};

static const char *const unit_words[] = {"m", "cm", "mm", "km", "in", "ft"};
static const double unit_m[] = {1.0, 0.01, 0.001, 1000.0, 0.0254, 0.3048}; /* inch, foot: 1959 */

static const char *const up_words[] = {"z", "y", "x"};
/* Rows: the axes of the component in those of the file. */
static const double up_axes[3][9] = {
    {1, 0, 0, 0, 1, 0, 0, 0, 1}, {1, 0, 0, 0, 0, -1, 0, 1, 0}, {0, 1, 0, 0, 0, 1, 1, 0, 0}};

static const primitive_key keys[N_KEYS] = {
    [FILE_PATH] = {.name = "file",
                   .unit = "",
                   .doc = "an .obj or .stl file",
                   .kind = KEY_PATH,
                   .required = true},
    [UNIT] = {.name = "unit",
              .unit = "",
              .doc = "what lengths in the file are given in: m, cm, mm, km, in, ft",
              .kind = KEY_WORD,
              .words = unit_words,
              .n_words = sizeof unit_words / sizeof *unit_words},
    [SCALE] = {.name = "scale",
               .unit = "",
               .doc = "in place of unit: lengths in the file are multiplied by it to get m",
               .kind = KEY_NUMBER,
               .min = 1e-9,
               .max = 1e9},
    [UP] = {.name = "up",
            .unit = "",
            .doc = "axis of the file that is z of the component: z, y (x stays) or x (y, z follow)",
            .kind = KEY_WORD,
            .words = up_words,
            .n_words = 3},
    [ORIGIN] =
        POINT_KEY("origin_m", "where the origin of the file lies; rotation_deg turns about it"),
    [TANGENT] = {.name = "tangent",
                 .unit = "",
                 .doc = "direction made orthogonal to each normal; absent: x, or y where that is "
                        "less along the normal",
                 .kind = KEY_DIRECTION},
    [MATERIAL] = {.name = "material",
                  .unit = "",
                  .doc = "material of all faces that `materials` does not name",
                  .kind = KEY_MATERIAL},
    [MATERIALS] = {.name = "materials",
                   .unit = "",
                   .doc = "materials by the names of the file: usemtl, else g, else o or solid",
                   .kind = KEY_NAMES},
    [FILE_NORMALS] = {.name = "file_normals",
                      .unit = "",
                      .doc = "true: faces whose normals in the file differ from corner to corner "
                             "stand for a curved surface with these normals",
                      .kind = KEY_SWITCH,
                      .def = {1},
                      .max = 1},
    [SMOOTH] = {.name = "smooth_deg",
                .unit = "deg",
                .doc =
                    "where the file has no normals: faces that meet at less than this angle stand "
                    "for a curved surface",
                .kind = KEY_NUMBER,
                .min = 0,
                .max = 80},
    [WELD] = {.name = "weld_m",
              .unit = "m",
              .doc = "vertices nearer than this are one; absent: 1e-6 of the largest extent",
              .kind = KEY_NUMBER,
              .min = 1e-12,
              .max = 1e3},
    [REPAIR] = {.name = "repair",
                .unit = "",
                .doc =
                    "true leaves out faces that stand there already, and turns those that look the "
                    "wrong way",
                .kind = KEY_SWITCH,
                .max = 1},
};

static glint_status check(const primitive_spec *spec, glint_errors *errors)
{
    return check_resolution(spec, UNIT, SCALE, errors);
}

/* A mesh on its way to facets. */
typedef struct importer {
    const primitive_spec *spec;
    mesh mesh;
    double weld_m;
    double (*normals)[3]; /* owned; of the faces */
    int *material;        /* owned; of the labels */
    int *group; /* owned; of the faces: their material, or -1 where they stand for a curved
                   surface */
    mesh_corners corners; /* normals at the corners of curved ones */
    mesh_defects defects;
    mesh_polygons polygons;
    glint_errors *errors; /* and warnings */
    glint_error *error;
} importer;

/* --- materials --- */

/* The entry of `materials` of that name, or NULL. */
static const primitive_name *entry_of(const primitive_spec *spec, const char *name, size_t n)
{
    for (int k = 0; k < spec->n_names; k++)
        if (strlen(spec->names[k].name) == n && memcmp(spec->names[k].name, name, n) == 0)
            return &spec->names[k];
    return NULL;
}

/* The entry of a label: by its material, else by its groups, one or all, else by its object. */
static const primitive_name *entry_of_label(const primitive_spec *spec, const mesh_label *label)
{
    const char *names[] = {label->material, label->group, label->object};
    for (size_t k = 0; k < 3; k++) {
        if (!names[k]) continue;
        const primitive_name *entry = entry_of(spec, names[k], strlen(names[k]));
        for (const char *at = names[k]; k == 1 && *at && !entry; at += strspn(at, " ")) {
            const size_t n = strcspn(at, " ");
            entry = entry_of(spec, at, n);
            at += n;
        }
        if (entry) return entry;
    }
    return NULL;
}

/* What a person would call the faces of a label. */
static const char *name_of(const mesh_label *label)
{
    if (label->material) return label->material;
    if (label->group) return label->group;
    return label->object ? label->object : "";
}

enum { NAMES_MOST = 12 };

/* Different names of the file, the first few, in its order. */
typedef struct name_list {
    const mesh_label *label[NAMES_MOST];
    int n;
    bool more;
} name_list;

/* The names of labels that have faces and, where that is asked for, no material. */
static void collect_names(const importer *im, bool without_material, name_list *out)
{
    *out = (name_list){0};
    for (int k = 0; k < im->mesh.n_labels && !out->more; k++) {
        const mesh_label *label = &im->mesh.labels[k];
        if (label->n_faces == 0) continue;
        if (without_material && im->material[k] != PRIMITIVE_NO_MATERIAL) continue;
        bool met = false;
        for (int j = 0; j < out->n && !met; j++)
            met = string_equal(name_of(out->label[j]), name_of(label));
        if (!met && out->n == NAMES_MOST) out->more = true;
        if (!met && out->n < NAMES_MOST) out->label[out->n++] = label;
    }
}

static glint_status fail_unmapped(const importer *im)
{
    const primitive_spec *spec = im->spec;
    name_list names;
    collect_names(im, true, &names);
    text list = {0};
    for (int k = 0; k < names.n; k++) {
        const char *name = name_of(names.label[k]), *quote = name[0] ? "'" : "";
        text_printf(&list, "%s%s%.40s%s", k ? ", " : "", quote,
                    name[0] ? name : "those without a name", quote);
        if (!im->mesh.is_binary) text_printf(&list, " (line %d)", names.label[k]->line);
    }
    if (names.more) text_add(&list, ", ...");
    const glint_status status =
        list.failed ? errors_no_memory(im->errors)
                    : errors_add(im->errors, GLINT_INPUT,
                                 spec->n_names > 0 ? spec->key_place[MATERIALS] : spec->where,
                                 "%s faces of the mesh have no material: %s; expected the key "
                                 "material, or entries for them in materials",
                                 spec->n_names > 0 ? "some" : "the", list.data);
    text_free(&list);
    return status;
}

/* An entry of `materials` that no face of the file has. */
static glint_status fail_unused(const importer *im, const primitive_name *entry)
{
    name_list names;
    collect_names(im, false, &names);
    text list = {0};
    for (int k = 0; k < names.n; k++) {
        const char *name = name_of(names.label[k]);
        if (name[0]) text_printf(&list, "%s%.40s", list.length ? ", " : "", name);
    }
    if (names.more) text_add(&list, ", ...");
    const glint_status status =
        list.failed ? errors_no_memory(im->errors)
                    : errors_add(im->errors, GLINT_INPUT, entry->where,
                                 "the mesh has no faces of '%.60s'; it has: %s", entry->name,
                                 list.length ? list.data : "none with a name");
    text_free(&list);
    return status;
}

static glint_status map_materials(importer *im)
{
    const primitive_spec *spec = im->spec;
    const mesh *m = &im->mesh;
    bool *used = calloc((size_t)spec->n_names + 1, sizeof *used), unmapped = false;
    im->material = malloc((size_t)m->n_labels * sizeof *im->material);
    glint_status status = used && im->material ? GLINT_OK : errors_no_memory(im->errors);
    for (int k = 0; k < m->n_labels && !status; k++) {
        const primitive_name *entry = entry_of_label(spec, &m->labels[k]);
        if (entry) used[entry - spec->names] |= m->labels[k].n_faces > 0;
        im->material[k] = entry ? entry->material : spec->material[MATERIAL];
        unmapped |= im->material[k] == PRIMITIVE_NO_MATERIAL && m->labels[k].n_faces > 0;
    }
    if (unmapped) status = fail_unmapped(im);
    for (int k = 0; k < spec->n_names && status != GLINT_INTERNAL; k++)
        if (!used[k]) status = fail_unused(im, &spec->names[k]);
    free(used);
    return status;
}

/* --- geometry --- */

static double scale_of(const primitive_spec *spec)
{
    return spec->given[SCALE] ? spec->value[SCALE][0] : unit_m[(int)spec->value[UNIT][0]];
}

/* Puts vertices and normals into m and the component's axes. */
static glint_status place_mesh(importer *im)
{
    const primitive_spec *spec = im->spec;
    const double *axes = up_axes[(int)spec->value[UP][0]], scale = scale_of(spec);
    double lo[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, hi[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < im->mesh.n_vertices; k++) {
        double *v = im->mesh.vertices[k];
        mat_vec(axes, v, v);
        scale3(v, scale, v);
        add3(v, spec->value[ORIGIN], v);
        for (int j = 0; j < 3; j++) {
            lo[j] = fmin(lo[j], v[j]);
            hi[j] = fmax(hi[j], v[j]);
        }
    }
    for (int k = 0; k < im->mesh.n_normals; k++)
        mat_vec(axes, im->mesh.normals[k], im->mesh.normals[k]);
    const double extent_m = fmax(hi[0] - lo[0], fmax(hi[1] - lo[1], hi[2] - lo[2]));
    if (!(extent_m >= LENGTH_MIN_M))
        return error_set(im->error, GLINT_INPUT, (place){spec->path, 0, 0},
                         "the mesh is %.3g m large; expected at least %g m: check unit or scale",
                         extent_m, LENGTH_MIN_M);
    const double wanted_m = spec->given[WELD] ? spec->value[WELD][0] : 1e-6 * extent_m;
    double far_m = 0.0;
    for (int j = 0; j < 3; j++)
        far_m = fmax(far_m, fmax(fabs(lo[j]), fabs(hi[j])));
    im->weld_m = fmax(wanted_m, 1e-15 * far_m); /* what a double resolves there */
    return GLINT_OK;
}

static glint_status find_normals(importer *im)
{
    const mesh *m = &im->mesh;
    im->normals = malloc((size_t)m->n_faces * sizeof *im->normals);
    if (!im->normals) return error_no_memory(im->error);
    for (int f = 0; f < m->n_faces; f++) {
        const int *c = m->faces[f].corner;
        double ab[3], ac[3], across[3];
        sub3(m->vertices[c[1]], m->vertices[c[0]], ab);
        sub3(m->vertices[c[2]], m->vertices[c[0]], ac);
        cross3(ab, ac, across);
        unit3(across, im->normals[f]);
    }
    return GLINT_OK;
}

/* Decides which faces are flat, and may be merged. */
static glint_status find_groups(importer *im)
{
    const mesh *m = &im->mesh;
    const smoothing how = {im->spec->value[FILE_NORMALS][0] != 0.0,
                           im->spec->value[SMOOTH][0] * DEG};
    glint_status status = mesh_smooth(m, im->normals, &how, &im->corners, &im->defects, im->error);
    im->group = malloc((size_t)m->n_faces * sizeof *im->group);
    if (!status && !im->group) status = error_no_memory(im->error);
    for (int f = 0; f < m->n_faces && !status; f++)
        im->group[f] = im->corners.is_smooth[f] ? -1 : im->material[m->faces[f].label];
    return status;
}

/* --- facets --- */

static glint_status add_polygon(importer *im, int k, int component, int *surface, facet_list *out,
                                double (*points)[3])
{
    const mesh *m = &im->mesh;
    const int first = im->polygons.first[k], n = im->polygons.first[k + 1] - first;
    const int face = im->polygons.face[k];
    double normal[3], tangent[3];
    for (int c = 0; c < n; c++)
        copy3(m->vertices[im->polygons.corner[first + c]], points[c]);
    revolved_axes(im->normals[face], normal, tangent);
    if (im->spec->given[TANGENT] &&
        !primitive_parallel(im->spec->value[TANGENT], im->normals[face]))
        copy3(im->spec->value[TANGENT], tangent);
    glint_status status = facet_list_add(out, points, n, tangent,
                                         im->material[m->faces[face].label], component, im->error);
    if (!status) out->items[out->n - 1].imported = true;
    if (status || !im->corners.is_smooth[face]) return status;
    const curved_surface smooth = {.kind = SURFACE_SMOOTH, .axis = {0, 0, 1}};
    if (*surface == 0) status = facet_list_add_surface(out, &smooth, surface, im->error);
    if (status) return status;
    return facet_list_smooth(out, out->n - 1, *surface, im->corners.normal[face], im->error);
}

static glint_status add_polygons(importer *im, int component, facet_list *out)
{
    const mesh_polygons *p = &im->polygons;
    int most = 3, surface = 0;
    for (int k = 0; k < p->n; k++)
        if (p->first[k + 1] - p->first[k] > most) most = p->first[k + 1] - p->first[k];
    double(*points)[3] = malloc((size_t)most * sizeof *points);
    if (!points) return error_no_memory(im->error);
    glint_status status = facet_list_reserve(out, p->n, p->first[p->n], im->error);
    for (int k = 0; k < p->n && !status; k++)
        status = add_polygon(im, k, component, &surface, out, points);
    free(points);
    return status;
}

/* --- report --- */

static void describe_defect(const importer *im, mesh_defect defect, text *out)
{
    const mesh_defects *d = &im->defects;
    text_printf(out, "%d %s", d->n[defect], mesh_defect_words(defect, d->n[defect]));
    if (d->line[defect][0] == 0) return;
    text_printf(out, " (%s", im->mesh.is_binary ? "triangle" : "line");
    for (int k = 0; k < d->n[defect] && k < DEFECT_EXAMPLES && d->line[defect][k] > 0; k++)
        text_printf(out, "%s %d", k ? "," : "", d->line[defect][k]);
    text_printf(out, "%s)", d->n[defect] > DEFECT_EXAMPLES ? ", ..." : "");
}

/* What a warning of a defect adds; NULL: there is none. Open edges are no fault of a sheet. */
static const char *advice_on(mesh_defect defect)
{
    if (defect == DEFECT_DEGENERATE || defect == DEFECT_OPEN) return NULL;
    if (defect == DEFECT_UNUSED) return "; the file may have been cut off";
    return mesh_defect_is_mended(defect) ? "; repair = true mends this" : "";
}

static void report_defect(const importer *im, mesh_defect defect)
{
    const int line = im->mesh.is_binary ? 0 : im->defects.line[defect][0];
    const bool mended = im->spec->value[REPAIR][0] != 0.0 && mesh_defect_is_mended(defect);
    const char *done = defect == DEFECT_DEGENERATE ? ": left out" : mended ? ": mended" : "";
    const char *advice = advice_on(defect);
    text words = {0};
    describe_defect(im, defect, &words);
    if (!words.failed && im->spec->report)
        text_printf(im->spec->report, "  %s%s\n", words.data, done);
    if (!words.failed && advice && !mended)
        errors_warn(im->errors, (place){im->spec->path, line, 0}, "%s%s", words.data, advice);
    text_free(&words);
}

static void report_mesh(const importer *im, int n_triangles)
{
    int n_smooth = 0;
    for (int f = 0; f < im->mesh.n_faces; f++)
        n_smooth += im->corners.is_smooth[f];
    if (im->spec->report)
        text_printf(
            im->spec->report,
            "mesh %s: %d triangles in %d piece%s, %d of them with smooth normals, merged into "
            "%d facets; vertices within %.3g m are one\n",
            im->spec->path, n_triangles, im->defects.n_pieces, im->defects.n_pieces == 1 ? "" : "s",
            n_smooth, im->polygons.n, im->weld_m);
    for (mesh_defect defect = 0; defect < N_DEFECTS; defect++)
        if (im->defects.n[defect] > 0) report_defect(im, defect);
}

static glint_status import(importer *im, int component, facet_list *out)
{
    glint_status status = mesh_read(im->spec->path, im->spec->key_place[FILE_PATH],
                                    LENGTH_MAX_M / scale_of(im->spec), &im->mesh, im->errors);
    const int n_triangles = im->mesh.n_faces;
    if (!status) status = map_materials(im);
    if (!status) status = place_mesh(im);
    if (!status)
        status = mesh_mend(&im->mesh, im->weld_m, im->spec->value[REPAIR][0] != 0.0, &im->defects,
                           im->error);
    if (!status) status = find_normals(im);
    if (!status) status = find_groups(im);
    if (!status)
        status =
            mesh_merge(&im->mesh, im->group, im->normals, im->weld_m, &im->polygons, im->error);
    if (!status) status = add_polygons(im, component, out);
    if (!status) report_mesh(im, n_triangles);
    return status;
}

static glint_status build(const primitive_spec *spec, int component, facet_list *out,
                          glint_errors *errors, glint_error *error)
{
    importer im = {.spec = spec, .errors = errors, .error = error};
    const glint_status status = import(&im, component, out);
    mesh_free(&im.mesh);
    mesh_corners_free(&im.corners);
    mesh_polygons_free(&im.polygons);
    free(im.normals);
    free(im.material);
    free(im.group);
    return status;
}

const primitive_kind primitive_mesh = {
    .name = "mesh",
    .doc =
        "triangles of a Wavefront OBJ or STL file; those that adjoin in one plane become one "
        "polygon. Tangents: x, made orthogonal to each normal, or y where that is less along it, "
        "unless `tangent` says otherwise",
    .keys = keys,
    .n_keys = N_KEYS,
    .check = check,
    .build = build,
    .centre_key = ORIGIN,
};
