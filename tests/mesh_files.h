/* mesh_files.h: mesh files that tests write, and meshes that they read. */
#ifndef GLINT_MESH_FILES_H
#define GLINT_MESH_FILES_H

#include "base/text.h"
#include "scenario_text.h"
#include "shapes.h"

/* A surface in the making: triangles over points. */
typedef struct soup {
    double point[12000][3];
    int triangle[20000][3];
    int n_points, n;
} soup;

static inline int add_point(soup *s, double x, double y, double z)
{
    double *p = s->point[s->n_points];
    p[0] = x, p[1] = y, p[2] = z;
    return s->n_points++;
}

static inline void add_triangle(soup *s, int a, int b, int c)
{
    int *t = s->triangle[s->n++];
    t[0] = a, t[1] = b, t[2] = c;
}

/* A box about the origin, each face an n x n grid of squares cut in two; corners are shared. */
static inline soup *box_soup(double x, double y, double z, int n)
{
    soup *s = calloc(1, sizeof *s);
    const double size[3] = {x, y, z};
    for (int face = 0; face < 6; face++) {
        const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const int first = s->n_points, sense = face % 2 ? -1 : 1;
        for (int row = 0; row <= n; row++)
            for (int column = 0; column <= n; column++) {
                double p[3];
                p[axis] = 0.5 * sense * size[axis];
                p[u] = ((double)column / n - 0.5) * size[u] * sense; /* so that u x v looks out */
                p[v] = ((double)row / n - 0.5) * size[v];
                add_point(s, p[0], p[1], p[2]);
            }
        for (int cell = 0; cell < n * n; cell++) {
            const int a = first + cell / n * (n + 1) + cell % n, b = a + 1, c = a + n + 1;
            add_triangle(s, a, b, c + 1);
            add_triangle(s, a, c + 1, c);
        }
    }
    return s;
}

static inline void write_obj(const char *name, const soup *s, const char *head)
{
    text t = {0};
    text_add(&t, head);
    for (int k = 0; k < s->n_points; k++)
        text_printf(&t, "v %.17g %.17g %.17g\n", s->point[k][0], s->point[k][1], s->point[k][2]);
    for (int k = 0; k < s->n; k++)
        text_printf(&t, "f %d %d %d\n", s->triangle[k][0] + 1, s->triangle[k][1] + 1,
                    s->triangle[k][2] + 1);
    write_bytes(name, t.data, t.length);
    text_free(&t);
}

static inline primitive_spec mesh_shape(const char *name)
{
    primitive_spec spec = shape("mesh");
    shape_key(&spec, "file");
    const char *path = in_folder(name);
    spec.path = string_copy(path, strlen(path));
    shape_material(&spec, "material", 0);
    return spec;
}

/* Adds the mesh, whatever it warns of, and frees it; returns what it reports (free). */
static inline char *mesh_add(primitive_spec *spec, facet_list *list)
{
    text report = {0};
    glint_errors *errors = glint_errors_new();
    spec->report = &report;
    const glint_status status = primitive_add(spec, 0, list, errors);
    ck_assert_msg(status == GLINT_OK, "%s", list_errors(errors));
    glint_errors_free(errors);
    primitive_spec_free(spec);
    return report.data;
}

#endif
