/* Meshes: reading OBJ and STL, what is refused and where, defects and their repair, merging,
 * smoothing. The files are written by the tests. */
#include "base/random.h"
#include "base/text.h"
#include "bench.h"
#include "facets/mesh.h"
#include "mesh_files.h"

static const double origin[3] = {0, 0, 0};

/* ---------------------------------------------------------------- files */

static void write_text_stl(const char *name, const soup *s)
{
    text t = {0};
    text_add(&t, "solid thing\n");
    for (int k = 0; k < s->n; k++) {
        text_add(&t, "  facet normal 0 0 0\n    outer loop\n");
        for (int j = 0; j < 3; j++) {
            const double *p = s->point[s->triangle[k][j]];
            text_printf(&t, "      vertex %.9e %.9e %.9e\n", p[0], p[1], p[2]);
        }
        text_add(&t, "    endloop\n  endfacet\n");
    }
    text_add(&t, "endsolid thing\n");
    write_bytes(name, t.data, t.length);
    text_free(&t);
}

static void put_number(unsigned char *b, uint32_t x)
{
    for (int k = 0; k < 4; k++)
        b[k] = (unsigned char)(x >> (8 * k));
}

static void put_float(unsigned char *b, double x)
{
    const float f = (float)x;
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    put_number(b, bits);
}

static size_t write_binary_stl(const char *name, const soup *s)
{
    const size_t size = 84 + 50 * (size_t)s->n;
    unsigned char *bytes = calloc(size, 1);
    memcpy(bytes, "solid in name only", 18); /* as some programs write */
    put_number(bytes + 80, (uint32_t)s->n);
    for (int k = 0; k < s->n; k++)
        for (int j = 0; j < 9; j++)
            put_float(bytes + 84 + 50 * k + 12 + 4 * j, s->point[s->triangle[k][j / 3]][j % 3]);
    write_bytes(name, (const char *)bytes, size);
    free(bytes);
    return size;
}

/* ---------------------------------------------------------------- primitives */

/* The mesh is refused with an error at that place (line 0: of no line) that holds the words. */
static void assert_mesh_refused(primitive_spec *spec, const char *file, int line, int column,
                                const char *words)
{
    glint_errors *errors = glint_errors_new();
    facet_list list = {0};
    ck_assert_int_eq(primitive_add(spec, 0, &list, errors), GLINT_INPUT);
    ck_assert_int_eq(list.n, 0);
    const glint_error *first = glint_errors_get(errors, 0);
    ck_assert_msg(strstr(first->message, words), "\"%s\" lacks \"%s\"", first->message, words);
    ck_assert_msg(strcmp(first->file, file) == 0 && first->line == line && first->column == column,
                  "%s at %s:%d:%d; expected %s:%d:%d", first->message, first->file, first->line,
                  first->column, file, line, column);
    glint_errors_free(errors);
    facet_list_free(&list);
    primitive_spec_free(spec);
}

/* Every facet of one list has its like in the other: normal, tangent, area, corners in some turn.
 */
static void assert_alike(const facet_list *a, const facet_list *b, double tol)
{
    ck_assert_int_eq(a->n, b->n);
    for (int k = 0; k < a->n; k++) {
        const facet *f = &a->items[k], *like = NULL;
        for (int j = 0; j < b->n && !like; j++)
            if (angle3(f->normal, b->items[j].normal) <= 10 * tol &&
                is_near(b->items[j].area_m2, f->area_m2, 10 * tol))
                like = &b->items[j];
        ck_assert_ptr_nonnull(like);
        ck_assert_int_eq(like->n_vertices, f->n_vertices);
        assert_near3(like->tangent, f->tangent, 10 * tol);
        int shift = 0;
        double d[3];
        for (; shift < f->n_vertices; shift++) {
            sub3(a->vertices[f->first_vertex], b->vertices[like->first_vertex + shift], d);
            if (norm3(d) <= tol) break;
        }
        ck_assert_int_lt(shift, f->n_vertices);
        for (int v = 0; v < f->n_vertices; v++)
            assert_near3(b->vertices[like->first_vertex + (v + shift) % f->n_vertices],
                         a->vertices[f->first_vertex + v], tol);
    }
}

/* ---------------------------------------------------------------- the box */

START_TEST(test_mesh_of_box_is_the_box)
{
    facet_list box = {0};
    primitive_spec spec = box_shape(2, 3, 5);
    shape_add(&spec, 0, &box);
    for (int n = 1; n <= 9; n += 4) { /* triangles of one plane are merged, whatever their number */
        soup *s = box_soup(2, 3, 5, n);
        write_obj("box.obj", s, "# a box\n");
        write_text_stl("box.stl", s);
        write_binary_stl("box.STL", s);
        static const char *const names[] = {"box.obj", "box.stl", "box.STL"};
        for (size_t k = 0; k < 3; k++) {
            facet_list imported = {0};
            spec = mesh_shape(names[k]);
            free(mesh_add(&spec, &imported));
            /* floats of a few metres, and vertices that are one within 5e-6 m */
            assert_alike(&box, &imported, k == 0 ? 1e-15 : 5e-7);
            facet_list_free(&imported);
        }
        free(s);
    }
    facet_list_free(&box);
}
END_TEST

START_TEST(test_mesh_units_scale_up_and_position_place_it)
{
    soup *s = box_soup(1, 2, 3, 1);
    write_obj("box.obj", s, "");
    free(s);
    static const struct {
        int units, up; /* of the words */
        double scale, size[3];
    } cases[] = {{0, 0, 0, {1, 2, 3}},
                 {1, 0, 0, {0.01, 0.02, 0.03}},
                 {2, 0, 0, {1e-3, 2e-3, 3e-3}},
                 {3, 0, 0, {1e3, 2e3, 3e3}},
                 {4, 0, 0, {0.0254, 0.0508, 0.0762}},
                 {5, 0, 0, {0.3048, 0.6096, 0.9144}},
                 {0, 1, 0, {1, 3, 2}},
                 {0, 2, 0, {2, 3, 1}},
                 {0, 0, 2.5, {2.5, 5, 7.5}}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        facet_list box = {0}, imported = {0};
        const double *d = cases[k].size;
        primitive_spec spec = box_shape(d[0], d[1], d[2]);
        SET(&spec, "centre_m", 7, -8, 9);
        shape_add(&spec, 0, &box);
        spec = mesh_shape("box.obj");
        SET(&spec, "origin_m", 7, -8, 9);
        SET(&spec, "up", cases[k].up);
        if (cases[k].scale > 0)
            SET(&spec, "scale", cases[k].scale);
        else
            SET(&spec, "unit", cases[k].units);
        free(mesh_add(&spec, &imported));
        assert_alike(&box, &imported, 1e-14 * (10 + d[2]));
        facet_list_free(&box);
        facet_list_free(&imported);
    }
}
END_TEST

/* A mark that tells the axes apart, turned as a modeller would: y up means that the file's y is z
 * here. */
START_TEST(test_mesh_up_turns_without_reflecting)
{
    write_file("arrow.obj",
               "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    static const double ends[3][3][3] = {{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}},  /* z up */
                                         {{1, 0, 0}, {0, 0, 2}, {0, -3, 0}}, /* y up */
                                         {{0, 0, 1}, {2, 0, 0}, {0, 3, 0}}}; /* x up */
    for (int up = 0; up < 3; up++) {
        primitive_spec spec = mesh_shape("arrow.obj");
        SET(&spec, "up", up);
        facet_list list = {0};
        free(mesh_add(&spec, &list));
        const surface s = surface_of(&list, 0, list.n);
        assert_rel(s.volume_m3, 1, 1e-14);
        for (int end = 0; end < 3; end++) {
            int n = 0;
            for (int v = 0; v < list.n_vertices; v++) {
                double d[3];
                sub3(list.vertices[v], ends[up][end], d);
                n += norm3(d) < 1e-15;
            }
            ck_assert_int_eq(n, 3); /* of three of the four faces */
        }
        facet_list_free(&list);
    }
}
END_TEST

START_TEST(test_mesh_tangent_is_x_or_y_or_what_is_asked_for)
{
    soup *s = box_soup(1, 1, 1, 1);
    write_obj("box.obj", s, "");
    free(s);
    primitive_spec spec = mesh_shape("box.obj");
    SET(&spec, "tangent", 0, 0, 4);
    facet_list list = {0};
    free(mesh_add(&spec, &list));
    for (int k = 0; k < 6; k++) {
        const double z[3] = {0, 0, 1}, x[3] = {1, 0, 0}; /* x where z is the normal itself */
        assert_near3(list.items[k].tangent, fabs(list.items[k].normal[2]) > 0.5 ? x : z, 1e-15);
    }
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- OBJ */

START_TEST(test_mesh_obj_reads_what_the_format_allows)
{
    static const char *const square[] = {
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
        "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3 4\r\n",
        "\n\n# v 9\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv\t1 1  0 # c\nv 0 1 0\n\nf -4 -3 -2 -1\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 \\\n0\nv 0 1 0\nf 1 2 \\\r\n 3 4\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1 2/1 3/1 4/1\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 2\nf 1//1 2//1 3//-1 4//1\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\ns 1\nf 1/1/1 2/1/1 3/1/1 4/1/1\n",
        ("mtllib a b.mtl\no thing\ng a b\nusemtl red\ns off\nv 0 0 0\nv 1 0 0\nl 1 2\np 1\nv 1 1 "
         "0\n"
         "v 0 1 0\nf 1 2 3\nf 1 3 4\n"),
        "\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4 # the end\n  ",
    };
    for (size_t k = 0; k < COUNT_OF(square); k++) {
        write_file("square.obj", square[k]);
        primitive_spec spec = mesh_shape("square.obj");
        facet_list list = {0};
        free(mesh_add(&spec, &list));
        ck_assert_msg(list.n == 1 && list.items[0].n_vertices == 4, "%s", square[k]);
        assert_near(list.items[0].area_m2, 1, 1e-15);
        assert_near(list.items[0].normal[2], 1, 1e-15);
        ck_assert_int_eq(list.items[0].surface, 0);
        facet_list_free(&list);
    }
}
END_TEST

START_TEST(test_mesh_obj_names_line_and_column_of_errors)
{
    static const struct {
        const char *content, *words;
        int line, column;
    } cases[] = {
        {"v 0 0 0\nv 1 0 x\n", "'x' is not a finite number", 2, 7},
        {"v 0 0 0\nv 1 0 nan\n", "'nan' is not a finite number", 2, 7},
        {"v 0 0 0\nv 1 0 1e999\n", "'1e999' is not a finite number", 2, 7},
        {"v 0 0 0\n  v 1 0\n", "'v' has 2 numbers; expected 3", 2, 3},
        {"vn 0 0 0\n", "the normal is zero", 1, 1},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "a face has 2 corners; expected 3 or more", 4, 1},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "'4' names vertex 4, but there are 3 so far", 4,
         7},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "'0' names vertex 0", 4, 7},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "'-4' names vertex -4, but there are 3", 4, 7},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n", "names vertex", 4, 7},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2 3\n", "'1//1' names normal 1, but there are 0", 4, 3},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/x 2 3\n", "'1/x' is not a corner", 4, 3},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1.5 2 3\n", "'1.5' is not a corner", 4, 3},
        {"v 0 0 0\n\\\nv 1 \\\n x 0\n", "'x' is not a finite number", 4, 2},
        {"vertex 0 0 0\n", "'vertex' begins no statement", 1, 1},
        {"usemt red\n", "did you mean 'usemtl'?", 1, 1},
        {"v 0 0 0\ncstype bezier\n", "free-form surfaces, which are not read", 2, 1},
        {"v 0 0 0\n# no faces\n", "the mesh has no faces", 0, 0},
        {"", "the mesh has no faces", 0, 0},
        {"v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", "all faces of the mesh are without area", 0, 0},
        {"v 0 0 0\nv 1e-9 0 0\nv 0 1e-9 0\nf 1 2 3\n", "the mesh is 1e-09 m large", 0, 0},
        {"v 0 0 0\nv 1e9 0 0\nv 0 1 0\nf 1 2 3\n", "has the coordinate 1e+09; expected at most", 2,
         1},
        {"v 0 0 0\nv 0 -1e308 0\nv 0 1 0\nf 1 2 3\n", "has the coordinate -1e+308", 2, 1},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3", "the file ends within this line", 5, 0},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# the en", "the file ends within this line", 5, 0},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 \\\n", "the file ends within this line", 4, 0},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 \\\r\n", "the file ends within this line", 4, 0},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3 4\n", "outline of the face crosses itself", 5,
         1},
    };
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        const char *path = write_file("bad.obj", cases[k].content);
        primitive_spec spec = mesh_shape("bad.obj");
        const bool placeless = strstr(cases[k].words, "without area") != NULL;
        assert_mesh_refused(&spec, placeless ? "shape.toml" : path,
                            placeless ? TABLE_LINE : cases[k].line, placeless ? 1 : cases[k].column,
                            cases[k].words);
    }
    const char zero[] = "v 0 0 0\nv 1 0 0\0\n";
    const char *path = write_bytes("bad.obj", zero, sizeof zero - 1);
    primitive_spec spec = mesh_shape("bad.obj");
    assert_mesh_refused(&spec, path, 0, 0, "zero byte");
}
END_TEST

static size_t errors_of(const char *name, const char *bytes, size_t n, int lines[MESH_MAX_ERRORS])
{
    write_bytes(name, bytes, n);
    mesh m;
    glint_errors *errors = glint_errors_new();
    ck_assert_int_eq(mesh_read(in_folder(name), PLACE_NONE, 1e7, &m, errors), GLINT_INPUT);
    const size_t n_errors = glint_errors_error_count(errors);
    ck_assert_uint_le(n_errors, MESH_MAX_ERRORS);
    for (size_t k = 0; k < n_errors; k++)
        lines[k] = glint_errors_get(errors, k)->line;
    glint_errors_free(errors);
    return n_errors;
}

START_TEST(test_mesh_obj_reports_all_errors_up_to_a_limit)
{
    /* A wrong vertex keeps its number: face 1 2 3 is right, and nothing is said of it. */
    static const char wrong[] = "v 0 0 0\nv 1 0 x\nv 0 1 0\nf 1 2 3\nf 1 2 4\nfoo\nvn 0 0 0\n"
                                "f 1//1 2 3\nf 1 2\n";
    int lines[MESH_MAX_ERRORS];
    ck_assert_uint_eq(errors_of("bad.obj", wrong, sizeof wrong - 1, lines), 5);
    static const int want[] = {2, 5, 6, 7, 9};
    for (int k = 0; k < 5; k++)
        ck_assert_int_eq(lines[k], want[k]);
    text t = {0};
    for (int k = 0; k < 1000; k++)
        text_add(&t, "v 0 0\n");
    ck_assert_uint_eq(errors_of("bad.obj", t.data, t.length, lines), MESH_MAX_ERRORS);
    text_free(&t);
}
END_TEST

START_TEST(test_mesh_of_absent_or_other_files_is_refused_where_it_is_named)
{
    static const struct {
        const char *name, *words;
    } cases[] = {{"absent.obj", "No such file"},
                 {"mesh.ply", "neither an .obj nor an .stl file"},
                 {"obj", "neither an .obj nor an .stl file"}};
    write_file("mesh.ply", "ply\n");
    write_file("obj", "v\n");
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        primitive_spec spec = mesh_shape(cases[k].name);
        const int line = KEY_LINE + primitive_key_index(spec.kind, "file");
        assert_mesh_refused(&spec, "shape.toml", line, 5, cases[k].words);
    }
}
END_TEST

/* A polygon with a dent, of 40 corners: its area is kept, and no facet is concave. */
START_TEST(test_mesh_obj_cuts_concave_polygons)
{
    text t = {0}, face = {0};
    double want = 0, before[2] = {0, 0}, first[2] = {0, 0};
    for (int k = 0; k < 40; k++) {
        const double r = k % 2 ? 1 : 2.5, a = TWO_PI * k / 40, p[2] = {r * cos(a), r * sin(a)};
        text_printf(&t, "v %.17g %.17g 1\n", p[0], p[1]);
        text_printf(&face, " %d", k + 1);
        if (k) want += 0.5 * (before[0] * p[1] - before[1] * p[0]);
        if (!k) memcpy(first, p, sizeof p);
        memcpy(before, p, sizeof p);
    }
    want += 0.5 * (before[0] * first[1] - before[1] * first[0]);
    text_printf(&t, "f%s\n", face.data);
    write_bytes("star.obj", t.data, t.length);
    primitive_spec spec = mesh_shape("star.obj");
    facet_list list = {0};
    free(mesh_add(&spec, &list));
    ck_assert_int_gt(list.n, 1);
    const surface s = surface_of(&list, 0, list.n);
    assert_rel(s.area_m2, want, 1e-14);
    assert_rel(s.vector_m2[2], want, 1e-14); /* no triangle is counted backwards */
    facet_list_free(&list);
    text_free(&t);
    text_free(&face);
}
END_TEST

/* A square with a square hole: the outline runs to the hole and back along the same line. */
START_TEST(test_mesh_obj_cuts_polygon_with_hole)
{
    write_file("hole.obj",
               "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 1 1 0\nv 2 1 0\nv 2 2 0\nv 1 2 0\n"
               "f 1 2 3 4 1 5 8 7 6 5\n");
    primitive_spec spec = mesh_shape("hole.obj");
    facet_list list = {0};
    free(mesh_add(&spec, &list));
    const surface s = surface_of(&list, 0, list.n);
    assert_rel(s.area_m2, 8, 1e-14);
    assert_rel(s.vector_m2[2], 8, 1e-14);
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- STL */

START_TEST(test_mesh_stl_names_line_of_errors)
{
    static const struct {
        const char *content, *words;
        int line, column;
    } cases[] = {
        {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n",
         "'x' is unexpected; expected a finite", 4, 12},
        {"solid\nfacet normal 0 0 1\nouter lop\n", "'lop' is unexpected; expected loop", 3, 7},
        {"solid a\nface normal 0 0 1\n", "'face' is unexpected; expected facet or endsolid", 2, 1},
        {"solid a\n", "the file ends too early; expected facet or endsolid", 2, 1},
        {"solid a\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0\nvertex 0 1 0 endloop",
         "the file ends too early; expected endfacet", 3, 21},
        {"solid a\nendsolid a\nsolidd\n", "'solidd' is unexpected; expected solid", 3, 1},
        {"solid a\nendsolid a\n", "the mesh has no faces", 0, 0},
        {"not an stl", "the file has 10 bytes and is no text", 0, 0},
    };
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        const char *path = write_file("bad.stl", cases[k].content);
        primitive_spec spec = mesh_shape("bad.stl");
        assert_mesh_refused(&spec, path, cases[k].line, cases[k].column, cases[k].words);
    }
}
END_TEST

START_TEST(test_mesh_stl_binary_refuses_numbers_that_are_none)
{
    soup *s = box_soup(1, 1, 1, 1);
    s->point[s->triangle[4][2]][1] = HUGE_VAL;
    write_binary_stl("bad.stl", s);
    free(s);
    primitive_spec spec = mesh_shape("bad.stl");
    assert_mesh_refused(&spec, in_folder("bad.stl"), 0, 0, "has a corner that is no finite number");
    unsigned char head[84] = {0};
    put_number(head + 80, 0xffffffff);
    write_bytes("bad.stl", (const char *)head, sizeof head);
    spec = mesh_shape("bad.stl");
    assert_mesh_refused(&spec, in_folder("bad.stl"), 0, 0,
                        "says that it holds 4294967295 triangles");
}
END_TEST

/* ---------------------------------------------------------------- files that are cut or damaged */

/* Reads n bytes as a mesh: an error, or a mesh that makes sense. Returns its faces. */
static int read_some(const char *name, const char *bytes, size_t n)
{
    write_bytes(name, bytes, n);
    mesh m;
    glint_errors *errors = glint_errors_new();
    const glint_status status = mesh_read(in_folder(name), PLACE_NONE, 1e7, &m, errors);
    const size_t n_errors = glint_errors_error_count(errors);
    glint_errors_free(errors);
    if (status) {
        ck_assert_int_eq(status, GLINT_INPUT);
        ck_assert(n_errors >= 1 && n_errors <= MESH_MAX_ERRORS + 1);
        ck_assert_int_eq(m.n_faces, 0);
        return 0;
    }
    ck_assert_uint_eq(n_errors, 0);
    const int n_faces = m.n_faces;
    for (int f = 0; f < m.n_faces; f++)
        for (int j = 0; j < 3; j++) {
            ck_assert(m.faces[f].corner[j] >= 0 && m.faces[f].corner[j] < m.n_vertices);
            ck_assert(m.faces[f].normal[j] >= -1 && m.faces[f].normal[j] < m.n_normals);
        }
    for (int v = 0; v < m.n_vertices; v++)
        for (int j = 0; j < 3; j++)
            ck_assert(isfinite(m.vertices[v][j]));
    mesh_free(&m);
    return n_faces;
}

static const char rich_obj[] =
    "# all sorts\nmtllib a.mtl\no body\ng side top\nusemtl red\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 "
    "0\n"
    "v 0.5 0.5 1e0 1 1 1\nvt 0 0\nvn 0 0 -1\nvn 1 0 1\ns 1\nf 4//1 3//1 2//1 1//1\nf 1 2 5\n"
    "f 2/1/2 3/1/2 5/1/2\nf 3 4 \\\n 5\nusemtl blue\nf -2 -5 -1\n";

START_TEST(test_mesh_cut_at_every_byte_is_refused_or_whole_lines)
{
    const size_t n_obj = sizeof rich_obj - 1;
    ck_assert_int_eq(read_some("cut.obj", rich_obj, n_obj), 6);
    for (size_t n = 0; n < n_obj; n++) {
        /* Whole lines are all that is taken; what a cut between lines leaves out nothing tells. */
        int want = 0, blank = n > 0 && rich_obj[n - 1] == '\n' && rich_obj[n - 2] != '\\';
        for (size_t k = 1; k < n && blank; k++)
            want += rich_obj[k] == 'f' && rich_obj[k - 1] == '\n';
        if (want > 0) want++; /* the first one has four corners */
        ck_assert_int_eq(read_some("cut.obj", rich_obj, n), want);
    }

    soup *s = box_soup(1, 2, 3, 1);
    write_text_stl("whole.stl", s);
    const size_t n_binary = write_binary_stl("binary.stl", s);
    free(s);
    size_t n_text;
    char *bytes = read_bytes(in_folder("whole.stl"), &n_text);
    ck_assert_int_eq(read_some("cut.stl", bytes, n_text), 12);
    /* what comes after the last "endsolid" is only its name */
    const size_t end = n_text - strlen(" thing\n");
    for (size_t n = 0; n < n_text; n++)
        ck_assert_int_eq(read_some("cut.stl", bytes, n), n >= end ? 12 : 0);
    free(bytes);
    bytes = read_bytes(in_folder("binary.stl"), NULL);
    for (size_t n = 0; n <= n_binary; n++) /* a cut binary file is always noticed */
        ck_assert_int_eq(read_some("cut.stl", bytes, n), n == n_binary ? 12 : 0);
    free(bytes);
}
END_TEST

START_TEST(test_mesh_with_damaged_bytes_never_crashes)
{
    soup *s = box_soup(1, 2, 3, 1);
    write_text_stl("text.stl", s);
    write_binary_stl("binary.stl", s);
    free(s);
    write_file("rich.obj", rich_obj);
    static const char *const names[] = {"text.stl", "binary.stl", "rich.obj"};
    uint64_t state = 1;
    for (size_t k = 0; k < 3; k++) {
        size_t n;
        char *bytes = read_bytes(in_folder(names[k]), &n);
        for (int trial = 0; trial < 1500; trial++) {
            char *copy = malloc(n + 1);
            memcpy(copy, bytes, n);
            for (int damage = 0; damage < 3; damage++)
                copy[random_next(&state) % n] = (char)(random_next(&state) >> 56);
            write_bytes(k == 2 ? "bad.obj" : "bad.stl", copy, n);
            free(copy);
            primitive_spec spec = mesh_shape(k == 2 ? "bad.obj" : "bad.stl");
            facet_list list = {0};
            (void)primitive_add(&spec, 0, &list, NULL); /* all the way to facets */
            for (int f = 0; f < list.n; f++)
                ck_assert(list.items[f].area_m2 > 0 && isfinite(list.items[f].area_m2));
            facet_list_free(&list);
            primitive_spec_free(&spec);
        }
        free(bytes);
    }
}
END_TEST

/* ---------------------------------------------------------------- materials */

static const char named_obj[] =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 2 3\no part\nf 1 2 6\ng left wing\nf 2 3 7\nusemtl red paint\n"
    "f 3 4 8\nusemtl cells\ng\nf 4 1 5\n";

static void name_material(primitive_spec *spec, const char *name, int material)
{
    shape_key(spec, "materials");
    spec->names = realloc(spec->names, ((size_t)spec->n_names + 1) * sizeof *spec->names);
    spec->names[spec->n_names++] = (primitive_name){name, material, {"shape.toml", 99, 1}};
}

START_TEST(test_mesh_materials_go_by_usemtl_then_group_then_object)
{
    write_file("named.obj", named_obj);
    static const struct {
        const char *name;
        int material[5]; /* of the five faces */
    } cases[] = {{"part", {0, 7, 7, 7, 7}},      {"wing", {0, 0, 7, 7, 0}},
                 {"left", {0, 0, 7, 7, 0}},      {"left wing", {0, 0, 7, 7, 0}},
                 {"red paint", {0, 0, 0, 7, 0}}, {"cells", {0, 0, 0, 0, 7}}};
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        primitive_spec spec = mesh_shape("named.obj");
        name_material(&spec, cases[k].name, 7);
        facet_list list = {0};
        free(mesh_add(&spec, &list));
        ck_assert_int_eq(list.n, 5);
        for (int f = 0; f < 5; f++)
            ck_assert_msg(list.items[f].material == cases[k].material[f], "%s: face %d has %d",
                          cases[k].name, f, list.items[f].material);
        facet_list_free(&list);
    }
    primitive_spec spec = mesh_shape("named.obj");
    name_material(&spec, "part", 1);
    name_material(&spec, "wing", 2);
    name_material(&spec, "cells", 3);
    facet_list list = {0};
    free(mesh_add(&spec, &list));
    static const int want[5] = {0, 1, 2, 2, 3};
    for (int f = 0; f < 5; f++)
        ck_assert_int_eq(list.items[f].material, want[f]);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_mesh_materials_refuse_faces_without_one_and_names_without_faces)
{
    write_file("named.obj", named_obj);
    primitive_spec spec = mesh_shape("named.obj");
    spec.material[primitive_key_index(spec.kind, "material")] = PRIMITIVE_NO_MATERIAL;
    spec.given[primitive_key_index(spec.kind, "material")] = false;
    name_material(&spec, "cells", 1);
    assert_mesh_refused(&spec, "shape.toml", KEY_LINE + primitive_key_index(spec.kind, "materials"),
                        5,
                        "have no material: those without a name (line 9), 'part' (line 11), 'left "
                        "wing' (line 13), 'red paint' (line 15); expected");
    spec = mesh_shape("named.obj");
    name_material(&spec, "left", 1);
    name_material(&spec, "rigth", 1);
    assert_mesh_refused(&spec, "shape.toml", 99, 1,
                        "no faces of 'rigth'; it has: part, left wing, red paint, cells");
    spec = mesh_shape("named.obj");
    spec.material[primitive_key_index(spec.kind, "material")] = PRIMITIVE_NO_MATERIAL;
    spec.given[primitive_key_index(spec.kind, "material")] = false;
    assert_mesh_refused(&spec, "shape.toml", TABLE_LINE, 1,
                        "the faces of the mesh have no material: ");
    spec = mesh_shape("named.obj");
    SET(&spec, "unit", 0);
    SET(&spec, "scale", 1);
    assert_mesh_refused(&spec, "shape.toml", KEY_LINE + primitive_key_index(spec.kind, "scale"), 5,
                        "both unit and scale are given");
}
END_TEST

/* ---------------------------------------------------------------- defects */

#define HULL                                                                                       \
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"                     \
    "f 1 4 3\nf 1 3 2\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\n"
#define LAST_SIDE "f 4 1 5\nf 4 5 8\n"

START_TEST(test_mesh_defects_are_counted_with_their_lines)
{
    static const struct {
        const char *content, *report;
        int n;         /* facets as it is */
        int mended_n;  /* with repair */
        double volume; /* with repair */
    } cases[] = {
        {HULL LAST_SIDE, NULL, 6, 6, 1},
        {HULL, "4 open edges (line 9, 12, 14, ...)", 5, 5, 0},
        {HULL LAST_SIDE "f 1 1 2\nf 1 2 2\n", "2 faces without area (line 21, 22): left out", 6, 6,
         1},
        {HULL LAST_SIDE "v 3 3 3\nv 1 1 1\n", "2 vertices that no face uses\n", 6, 6, 1},
        {HULL LAST_SIDE "v 0.5 0 0\nf 1 9 2\n", "1 face without area (line 22)", 6, 6, 1},
        {HULL LAST_SIDE "f 4 3 1\n", "1 face that stands there already (line 21)", 7, 6, 1},
        {HULL "f 4 5 1\nf 4 5 8\n", "1 face that looks the other way than its neighbours (line 19)",
         7, 6, 1},
        {HULL LAST_SIDE "v 0.5 -1 -1\nf 1 2 9\n", "1 edge of more than two faces (line 10)", 7, 7,
         1},
        /* inside out: z reflected */
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
         "4 faces of closed pieces that are inside out (line 5, 6, 7, ...)", 4, 4, 1.0 / 6},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n",
         "1 face whose normal in the file looks the other way (line 5)", 1, 1, 0},
    };
    for (size_t k = 0; k < COUNT_OF(cases); k++)
        for (int repair = 0; repair < 2; repair++) {
            write_file("defect.obj", cases[k].content);
            primitive_spec spec = mesh_shape("defect.obj");
            SET(&spec, "repair", repair);
            facet_list list = {0};
            char *report = mesh_add(&spec, &list);
            if (cases[k].report)
                ck_assert_msg(strstr(report, cases[k].report), "'%s' lacks '%s'", report,
                              cases[k].report);
            else
                ck_assert_msg(strchr(report, '\n') == report + strlen(report) - 1, "%s", report);
            ck_assert_msg(list.n == (repair ? cases[k].mended_n : cases[k].n), "%d facets: %s",
                          list.n, cases[k].content);
            const surface s = surface_of(&list, 0, list.n);
            if (repair && cases[k].volume > 0 && k != 7)
                assert_rel(s.volume_m3, cases[k].volume, 1e-14);
            free(report);
            facet_list_free(&list);
        }
}
END_TEST

START_TEST(test_mesh_defects_that_repair_mends_are_warned_of)
{
    write_file("defect.obj", HULL LAST_SIDE "f 4 3 1\n");
    for (int repair = 0; repair < 2; repair++) {
        primitive_spec spec = mesh_shape("defect.obj");
        SET(&spec, "repair", repair);
        glint_errors *errors = glint_errors_new();
        facet_list list = {0};
        ck_assert_int_eq(primitive_add(&spec, 0, &list, errors), GLINT_OK);
        ck_assert_uint_eq(glint_errors_error_count(errors), 0);
        bool warned = false;
        for (size_t k = 0; k < glint_errors_count(errors); k++) {
            const glint_error *e = glint_errors_get(errors, k);
            warned = warned || (strstr(e->message, "stands there already") && e->line == 21 &&
                                strstr(e->message, "repair = true mends this"));
        }
        ck_assert_int_eq(warned, !repair);
        glint_errors_free(errors);
        facet_list_free(&list);
        primitive_spec_free(&spec);
    }
}
END_TEST

/* A surface that turns round in the middle of many faces: repair makes all of it look outwards
 * again. */
START_TEST(test_mesh_repair_turns_faces_that_look_inwards)
{
    soup *s = box_soup(1, 2, 3, 6);
    uint64_t state = 5;
    int turned = 0;
    for (int k = 0; k < s->n; k++)
        if (random_next(&state) % 3 == 0) {
            const int corner = s->triangle[k][1];
            s->triangle[k][1] = s->triangle[k][2];
            s->triangle[k][2] = corner;
            turned++;
        }
    write_obj("mixed.obj", s, "");
    primitive_spec spec = mesh_shape("mixed.obj");
    SET(&spec, "repair", 1);
    facet_list list = {0};
    char *report = mesh_add(&spec, &list), want[80];
    snprintf(want, sizeof want, "%d faces that look the other way", turned);
    ck_assert_msg(strstr(report, want), "%s lacks %s", report, want);
    ck_assert_int_eq(list.n, 6);
    assert_rel(surface_of(&list, 0, 6).volume_m3, 6, 1e-14);
    free(report);
    facet_list_free(&list);
    free(s);
}
END_TEST

START_TEST(test_mesh_weld_joins_vertices_within_its_tolerance)
{
    /* Two triangles that meet but for 1e-4 m. */
    write_file("gap.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1.0001 0 0\nv 1 1 0\nv 0 1.0001 0\n"
                          "f 1 2 3\nf 4 5 6\n");
    for (int wide = 0; wide < 2; wide++) {
        primitive_spec spec = mesh_shape("gap.obj");
        SET(&spec, "weld_m", wide ? 1e-3 : 1e-5);
        facet_list list = {0};
        free(mesh_add(&spec, &list));
        ck_assert_int_eq(list.n, wide ? 1 : 2);
        facet_list_free(&list);
    }
}
END_TEST

/* ---------------------------------------------------------------- merging */

START_TEST(test_mesh_merge_keeps_area_and_closure_of_random_solids)
{
    /* Boxes side by side on a grid, of different heights: concave outlines, T-shaped and with
     * holes. */
    uint64_t state = 9;
    for (int trial = 0; trial < 20; trial++) {
        bool full[6][6][3];
        for (int k = 0; k < 6 * 6 * 3; k++)
            full[k / 18][k / 3 % 6][k % 3] = random_next(&state) % 10 < 7;
        soup *s = calloc(1, sizeof *s);
        double area = 0, volume = 0;
        for (int c = 0; c < 6 * 6 * 3; c++) {
            const int at[3] = {c / 18, c / 3 % 6, c % 3};
            if (!full[at[0]][at[1]][at[2]]) continue;
            volume++;
            for (int face = 0; face < 6; face++) {
                const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
                const int sense = face % 2 ? -1 : 1, most[3] = {6, 6, 3};
                int next[3] = {at[0], at[1], at[2]};
                next[axis] += sense;
                if (next[axis] >= 0 && next[axis] < most[axis] && full[next[0]][next[1]][next[2]])
                    continue;
                area++;
                const int first = s->n_points;
                for (int k = 0; k < 4; k++) {
                    double p[3] = {at[0], at[1], at[2]};
                    p[axis] += sense > 0;
                    p[sense > 0 ? u : v] += k == 1 || k == 2;
                    p[sense > 0 ? v : u] += k >= 2;
                    add_point(s, p[0], p[1], p[2]);
                }
                const int flip = (at[0] + at[1] + at[2]) % 2;
                add_triangle(s, first + flip, first + 1 + flip, first + 2 + flip);
                add_triangle(s, first + flip, first + 2 + flip, first + (3 + flip) % 4);
            }
        }
        write_obj("blocks.obj", s, "");
        primitive_spec spec = mesh_shape("blocks.obj");
        facet_list list = {0};
        free(mesh_add(&spec, &list));
        const surface whole = surface_of(&list, 0, list.n);
        assert_rel(whole.area_m2, area, 1e-12);
        assert_rel(whole.volume_m3, volume, 1e-12);
        assert_near3(whole.vector_m2, origin, 1e-11);
        ck_assert_int_lt(list.n, s->n / 2);
        for (int k = 0; k < list.n; k++) { /* convex */
            const facet *f = &list.items[k];
            for (int v = 0; v < f->n_vertices; v++) {
                const double(*p)[3] = list.vertices + f->first_vertex;
                double in[3], on[3], c[3];
                sub3(p[(v + 1) % f->n_vertices], p[v], in);
                sub3(p[(v + 2) % f->n_vertices], p[(v + 1) % f->n_vertices], on);
                cross3(in, on, c);
                ck_assert(dot3(c, f->normal) > -1e-9);
                ck_assert(dot3(c, f->normal) > 1e-9 || dot3(in, on) > 0);
            }
        }
        facet_list_free(&list);
        free(s);
    }
}
END_TEST

/* A turned box of 19 200 triangles in mm with three digits, as programs write it: each of them is
 * tilted by rounding, the faces are not. A cylinder of 720 sides is no plane anywhere. */
START_TEST(test_mesh_merge_sees_planes_through_rounding)
{
    soup *s = box_soup(1, 2, 3, 40);
    double turn[9];
    mat_turn((const double[]){0.6, 0, 0.8}, 0.7, turn);
    text t = {0};
    for (int k = 0; k < s->n_points; k++)
        mat_vec(turn, s->point[k], s->point[k]);
    for (int k = 0; k < s->n_points; k++)
        text_printf(&t, "v %.3f %.3f %.3f\n", 1e3 * s->point[k][0], 1e3 * s->point[k][1],
                    1e3 * s->point[k][2]);
    for (int k = 0; k < s->n; k++)
        text_printf(&t, "f %d %d %d\n", s->triangle[k][0] + 1, s->triangle[k][1] + 1,
                    s->triangle[k][2] + 1);
    write_bytes("rounded.obj", t.data, t.length);
    free(s);
    primitive_spec spec = mesh_shape("rounded.obj");
    SET(&spec, "unit", 2);
    facet_list list = {0};
    free(mesh_add(&spec, &list));
    ck_assert_int_eq(list.n, 6);
    assert_rel(surface_of(&list, 0, 6).area_m2, 22, 1e-6); /* 5e-7 m in each corner */
    assert_rel(surface_of(&list, 0, 6).volume_m3, 6, 1e-6);
    facet_list_free(&list);
    text_clear(&t);
    for (int k = 0; k < 720; k++)
        text_printf(&t, "v %.6f %.6f 0\nv %.6f %.6f 0.5\n", cos(0.5 * DEG * k), sin(0.5 * DEG * k),
                    cos(0.5 * DEG * k), sin(0.5 * DEG * k));
    for (int k = 0; k < 720; k++)
        text_printf(&t, "f %d %d %d %d\n", 2 * k + 1, (2 * k + 2) % 1440 + 1,
                    (2 * k + 2) % 1440 + 2, 2 * k + 2);
    write_bytes("tube.obj", t.data, t.length);
    text_free(&t);
    spec = mesh_shape("tube.obj");
    free(mesh_add(&spec, &list));
    ck_assert_int_eq(list.n, 720);
    facet_list_free(&list);
}
END_TEST

/* A sheet of 3 x 3 squares with faces on both sides is two polygons, and nothing is wrong with it.
 */
START_TEST(test_mesh_merge_of_sheet_with_two_sides_gives_two_polygons)
{
    text t = {0};
    for (int k = 0; k < 16; k++)
        text_printf(&t, "v %d %d 0\n", k % 4, k / 4);
    for (int k = 0; k < 9; k++) {
        const int a = k / 3 * 4 + k % 3 + 1;
        text_printf(&t, "f %d %d %d %d\nf %d %d %d %d\n", a, a + 1, a + 5, a + 4, a + 4, a + 5,
                    a + 1, a);
    }
    write_bytes("sheet.obj", t.data, t.length);
    text_free(&t);
    primitive_spec spec = mesh_shape("sheet.obj");
    facet_list list = {0};
    char *report = mesh_add(&spec, &list);
    ck_assert_ptr_null(strstr(report, "more than two"));
    ck_assert_ptr_null(strstr(report, "other way"));
    ck_assert_int_eq(list.n, 2);
    for (int k = 0; k < 2; k++) {
        ck_assert_int_eq(list.items[k].n_vertices, 4);
        assert_near(list.items[k].area_m2, 9, 1e-14);
    }
    assert_near3(surface_of(&list, 0, 2).vector_m2, origin, 1e-14);
    free(report);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_mesh_merge_keeps_materials_and_bends_apart)
{
    /* A strip of six squares: two of another material, then one that bends by 0.01 deg. */
    text t = {0};
    for (int k = 0; k <= 6; k++)
        text_printf(&t, "v %d 0 %.17g\nv %d 1 %.17g\n", k, k == 6 ? tan(0.01 * DEG) : 0, k,
                    k == 6 ? tan(0.01 * DEG) : 0);
    for (int k = 0; k < 6; k++)
        text_printf(&t, "usemtl %s\nf %d %d %d %d\n", k == 2 || k == 3 ? "b" : "a", 2 * k + 1,
                    2 * k + 3, 2 * k + 4, 2 * k + 2);
    write_bytes("strip.obj", t.data, t.length);
    text_free(&t);
    primitive_spec spec = mesh_shape("strip.obj");
    name_material(&spec, "b", 1);
    facet_list list = {0};
    free(mesh_add(&spec, &list));
    ck_assert_int_eq(list.n, 4); /* aa bb a, and the bend */
    double areas[2] = {0, 0};
    for (int k = 0; k < 4; k++)
        areas[list.items[k].material] += list.items[k].area_m2;
    assert_near(areas[1], 2, 1e-14);
    assert_near(areas[0], 3 + 1 / cos(0.01 * DEG), 1e-14);
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- smooth normals */

/* A sphere of latitudes and longitudes with the normals of a sphere at its corners, or without. */
static void write_sphere(const char *name, bool with_normals)
{
    enum { ROWS = 24, COLUMNS = 48 };
    text t = {0};
    for (int row = 0; row <= ROWS; row++)
        for (int column = 0; column < COLUMNS; column++) {
            const double a = PI * row / ROWS, b = TWO_PI * column / COLUMNS;
            const double p[3] = {sin(a) * cos(b), sin(a) * sin(b), cos(a)};
            text_printf(&t, "v %.17g %.17g %.17g\n", p[0], p[1], p[2]);
            if (with_normals) text_printf(&t, "vn %.17g %.17g %.17g\n", p[0], p[1], p[2]);
        }
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++) {
            const int a = row * COLUMNS + column + 1,
                      b = row * COLUMNS + (column + 1) % COLUMNS + 1;
            const int ring[4] = {a, a + COLUMNS, b + COLUMNS, b};
            text_add(&t, "f");
            for (int k = 0; k < 4; k++)
                if (with_normals)
                    text_printf(&t, " %d//%d", ring[k], ring[k]);
                else
                    text_printf(&t, " %d", ring[k]);
            text_char(&t, '\n');
        }
    write_bytes(name, t.data, t.length);
    text_free(&t);
}

/* Takes over the facets, and sums over 96 attitudes at a phase angle of 40 deg: the least and the
 * most, over a quarter of rho_s (the closed form of a narrow lobe). */
static void shine(facet_list *list, double alpha, double *least, double *most)
{
    const paint shiny = {"ward-gmd", {0, 0.8, alpha, alpha, NONE, NONE}};
    bench *b = bench_of_facets(list, &shiny);
    double sun[BRDF_TILE][3], observer[BRDF_TILE][3], x[BRDF_TILE];
    *least = HUGE_VAL, *most = 0;
    for (int tile = 0; tile < 3; tile++) {
        for (int k = 0; k < BRDF_TILE; k++)
            light_at(tile * BRDF_TILE + k, 40 * DEG, sun[k], observer[k]);
        sums_of(b, sun, observer, x);
        for (int k = 0; k < BRDF_TILE; k++) {
            *least = fmin(*least, x[k] / 0.2);
            *most = fmax(*most, x[k] / 0.2);
        }
    }
    bench_free(b);
}

START_TEST(test_mesh_with_smooth_normals_shines_steadily)
{
    write_sphere("normals.obj", true);
    write_sphere("plain.obj", false);
    double least, most;
    for (int from_file = 0; from_file < 2; from_file++) {
        primitive_spec spec = mesh_shape(from_file ? "normals.obj" : "plain.obj");
        if (!from_file) SET(&spec, "smooth_deg", 30);
        facet_list list = {0};
        free(mesh_add(&spec, &list));
        shine(&list, 0.02, &least, &most);
        /* Density of matter over the normals is what the triangles say: even within each. */
        ck_assert_msg(least > 0.97 && most < 1.03, "%g to %g", least, most);
    }
    for (int plain = 0; plain < 2; plain++) { /* as facets it flickers */
        primitive_spec spec = mesh_shape(plain ? "plain.obj" : "normals.obj");
        SET(&spec, "file_normals", 0);
        facet_list list = {0};
        free(mesh_add(&spec, &list));
        ck_assert_int_eq(list.n, 24 * 48); /* quads; triangles at the poles */
        shine(&list, 0.02, &least, &most);
        ck_assert_msg(least < 0.3 && most > 2, "%g to %g", least, most);
    }
}
END_TEST

START_TEST(test_mesh_smooth_deg_leaves_edges_of_box_sharp)
{
    soup *s = box_soup(1, 1, 1, 4);
    write_obj("box.obj", s, "");
    free(s);
    primitive_spec spec = mesh_shape("box.obj");
    SET(&spec, "smooth_deg", 60);
    facet_list list = {0};
    free(mesh_add(&spec, &list));
    ck_assert_int_eq(list.n, 6);
    ck_assert_int_eq(list.n_surfaces, 0);
    facet_list_free(&list);
}
END_TEST

/* A turned box as drawing programs write it: a normal of four digits for each face. They do not
 * make it round. */
START_TEST(test_mesh_with_rounded_normals_stays_flat)
{
    soup *s = box_soup(1, 2, 3, 2);
    double turn[9];
    mat_turn((const double[]){0.6, 0, 0.8}, 0.7, turn);
    text t = {0};
    for (int k = 0; k < s->n_points; k++) {
        mat_vec(turn, s->point[k], s->point[k]);
        text_printf(&t, "v %.6f %.6f %.6f\n", s->point[k][0], s->point[k][1], s->point[k][2]);
    }
    for (int k = 0; k < s->n; k++) {
        double ab[3], ac[3], n[3];
        sub3(s->point[s->triangle[k][1]], s->point[s->triangle[k][0]], ab);
        sub3(s->point[s->triangle[k][2]], s->point[s->triangle[k][0]], ac);
        cross3(ab, ac, n);
        unit3(n, n);
        text_printf(&t, "vn %.4f %.4f %.4f\nf", n[0], n[1], n[2]);
        for (int j = 0; j < 3; j++)
            text_printf(&t, " %d//%d", s->triangle[k][j] + 1, k + 1);
        text_char(&t, '\n');
    }
    write_bytes("turned.obj", t.data, t.length);
    text_free(&t);
    free(s);
    primitive_spec spec = mesh_shape("turned.obj");
    facet_list list = {0};
    free(mesh_add(&spec, &list));
    ck_assert_int_eq(list.n, 6);
    ck_assert_int_eq(list.n_surfaces, 0);
    facet_list_free(&list);
}
END_TEST

START_TEST(test_mesh_copies_keep_smooth_normals)
{
    write_sphere("normals.obj", true);
    primitive_spec spec = mesh_shape("normals.obj");
    SET(&spec, "origin_m", 3, 0, 0);
    shape_repeat(&spec, 2, (double[]){0, 0, 1}, 90);
    spec.mirror = 1;
    facet_list list = {0};
    free(mesh_add(&spec, &list));
    static const double centres[4][3] = {{3, 0, 0}, {0, 3, 0}, {-3, 0, 0}, {0, 3, 0}};
    const int n = list.n / 4;
    for (int k = 0; k < list.n; k++) {
        const facet *f = &list.items[k];
        ck_assert_int_eq(f->surface, k / n + 1);
        for (int v = f->first_vertex; v < f->first_vertex + f->n_vertices; v++) {
            double from[3];
            sub3(list.vertices[v], centres[k / n], from);
            assert_near3(list.normals[v], from, 2e-15);
        }
    }
    facet_list_free(&list);
}
END_TEST

/* ---------------------------------------------------------------- scenarios */

START_TEST(test_scenario_reads_mesh_beside_it_and_check_tells_of_it)
{
    write_file("hull.obj", "usemtl skin\n" HULL);
    const marked_text m = with_part(SOUND, PART_PRIMITIVE,
                                    "[[component.mesh]]\nfile = \"hull.obj\"\nunit = \"cm\"\n"
                                    "up = \"y\"\nmaterials = { skin = \"white\" }\n"
                                    "repair = true\nsmooth_deg = 20\n");
    const char *path = write_file("scenario.toml", m.text);
    glint_scenario_free(read_sound(path));
    char *report = NULL;
    ck_assert_int_eq(glint_check(path, NULL, 0, &report, NULL), GLINT_OK);
    ck_assert_msg(strstr(report,
                         "10 triangles in 1 piece, 0 of them with smooth normals, merged into "
                         "5 facets"),
                  "%s", report);
    ck_assert_msg(strstr(report, "4 open edges (line 10, 13, 15, ...)"), "%s", report);
    glint_free(report);
}
END_TEST

START_TEST(test_scenario_mesh_wrong_is_refused)
{
    write_file("hull.obj", "usemtl skin\n" HULL);
#define MESH "[[component.mesh]]\nfile = \"hull.obj\"\n"
    static const wrong_text all[] = {
        {PART_PRIMITIVE, "@[[component.mesh]]\nmaterial = \"white\"\n", "no 'file'",
         "the path of a file", 0},
        {PART_PRIMITIVE, "[[component.mesh]]\nfile = @3\nmaterial = \"white\"\n", "the number 3",
         "the path of a file", 0},
        {PART_PRIMITIVE, "[[component.mesh]]\nfile = @\"no.obj\"\nmaterial = \"white\"\n", "no.obj",
         "No such file", 0},
        {PART_PRIMITIVE, MESH "material = \"white\"\nunit = @\"metre\"\n", "\"metre\"",
         "m, cm, mm, km, in, ft", 0},
        {PART_PRIMITIVE, MESH "material = \"white\"\nup = @\"w\"\n", "\"w\"", "z, y, x", 0},
        {PART_PRIMITIVE, MESH "material = \"white\"\nscale = @0\n", "the number 0", "between", 0},
        {PART_PRIMITIVE, MESH "materials = { skin = @\"grey\" }\n", "no material 'grey'",
         "[materials.NAME]", 0},
        {PART_PRIMITIVE, MESH "materials = { skin = @4 }\n",
         "'skin' in materials is a whole number", "the name of a material", 0},
        {PART_PRIMITIVE, MESH "material = \"white\"\nmaterials = { skni = @\"white\" }\n",
         "no faces of 'skni'", "it has: skin", 0},
        {PART_PRIMITIVE, "@" MESH, "the faces of the mesh have no material", "the key material", 0},
    };
    ASSERT_ALL_WRONG(SOUND, all);
}
END_TEST

START_TEST(test_scenario_warns_of_mesh_that_flickers)
{
    write_sphere("plain.obj", false);
    const char *parts[N_PARTS];
    memcpy(parts, SOUND, sizeof parts);
    parts[PART_PRIMITIVE] = "[[component.mesh]]\nfile = \"plain.obj\"\nmaterial = \"white\"\n";
    for (int narrow = 0; narrow < 2; narrow++) {
        char material[256];
        snprintf(material, sizeof material,
                 "[materials.white]\nbrdf = \"ward-gmd\"\nrho_d = 0.1\nrho_s = 0.5\nalpha_x = %g\n"
                 "alpha_y = 0.3\n",
                 narrow ? 0.05 : 0.3);
        const marked_text m = with_part(parts, PART_MATERIAL, material);
        glint_scenario *s;
        glint_errors *errors = glint_errors_new();
        ck_assert_int_eq(
            glint_scenario_read(write_file("scenario.toml", m.text), NULL, 0, &s, errors),
            GLINT_OK);
        int warned = 0;
        for (size_t k = 0; k < glint_errors_count(errors); k++)
            warned += strstr(glint_errors_get(errors, k)->message, "it flickers") != NULL;
        ck_assert_msg(warned == narrow, "%s", list_errors(errors));
        glint_curve *curve;
        ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
        const char *key, *value;
        int in_header = 0;
        for (size_t k = 0; glint_curve_fact(curve, k, &key, &value); k++)
            in_header += strcmp(key, "mesh_flickers") == 0 && strstr(value, "white: its lobe");
        ck_assert_int_eq(in_header, narrow);
        glint_curve_close(curve);
        glint_errors_free(errors);
        glint_scenario_free(s);
    }
}
END_TEST

/* What a mesh file says decides the result: the hash must tell files apart that differ in corners,
 * in normals or in names of materials only. */
START_TEST(test_scenario_hash_knows_what_the_mesh_file_says)
{
    static const struct {
        const char *corner, *normal, *first, *second;
    } files[] = {{"0 1 0", "0 1 1", "a", "b"},
                 {"0 2 0", "0 1 1", "a", "b"},
                 {"0 1 0", "0 1 2", "a", "b"},
                 {"0 1 0", "0 1 1", "b", "a"}};
    const marked_text m = with_part(
        GIVEN, PART_PRIMITIVE,
        "[[component.mesh]]\nfile = \"skin.obj\"\nmaterials = { a = \"white\", b = \"grey\" }\n"
        "[materials.grey]\nbrdf = \"lambert\"\nrho = 0.2\n");
    char hashes[COUNT_OF(files)][64];
    for (size_t f = 0; f < COUNT_OF(files); f++) {
        char content[256];
        snprintf(content, sizeof content,
                 "v 0 0 0\nv 1 0 0\nv %s\nvn 0 0 1\nvn %s\nusemtl %s\nf 1//1 2//1 3//2\n"
                 "v 1 1 0\nusemtl %s\nf 2 4 3\n",
                 files[f].corner, files[f].normal, files[f].first, files[f].second);
        write_file("skin.obj", content);
        glint_scenario *s = read_sound(write_file("scenario.toml", m.text));
        glint_curve *curve;
        ck_assert_int_eq(glint_curve_open(s, 1, &curve, NULL), GLINT_OK);
        const char *key, *value;
        for (size_t k = 0; glint_curve_fact(curve, k, &key, &value); k++)
            if (strcmp(key, "scenario_hash") == 0)
                snprintf(hashes[f], sizeof hashes[f], "%s", value);
        glint_curve_close(curve);
        glint_scenario_free(s);
        for (size_t k = 0; k < f; k++)
            ck_assert_str_ne(hashes[k], hashes[f]);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("mesh");
    TCase *tcase = tcase_create("mesh");
    tcase_set_timeout(tcase, 120);
    tcase_add_checked_fixture(tcase, folder_make, folder_remove);
    tcase_add_test(tcase, test_mesh_of_box_is_the_box);
    tcase_add_test(tcase, test_mesh_units_scale_up_and_position_place_it);
    tcase_add_test(tcase, test_mesh_up_turns_without_reflecting);
    tcase_add_test(tcase, test_mesh_tangent_is_x_or_y_or_what_is_asked_for);
    tcase_add_test(tcase, test_mesh_obj_reads_what_the_format_allows);
    tcase_add_test(tcase, test_mesh_obj_names_line_and_column_of_errors);
    tcase_add_test(tcase, test_mesh_obj_reports_all_errors_up_to_a_limit);
    tcase_add_test(tcase, test_mesh_of_absent_or_other_files_is_refused_where_it_is_named);
    tcase_add_test(tcase, test_mesh_obj_cuts_concave_polygons);
    tcase_add_test(tcase, test_mesh_obj_cuts_polygon_with_hole);
    tcase_add_test(tcase, test_mesh_stl_names_line_of_errors);
    tcase_add_test(tcase, test_mesh_stl_binary_refuses_numbers_that_are_none);
    tcase_add_test(tcase, test_mesh_cut_at_every_byte_is_refused_or_whole_lines);
    tcase_add_test(tcase, test_mesh_with_damaged_bytes_never_crashes);
    tcase_add_test(tcase, test_mesh_materials_go_by_usemtl_then_group_then_object);
    tcase_add_test(tcase, test_mesh_materials_refuse_faces_without_one_and_names_without_faces);
    tcase_add_test(tcase, test_mesh_defects_are_counted_with_their_lines);
    tcase_add_test(tcase, test_mesh_defects_that_repair_mends_are_warned_of);
    tcase_add_test(tcase, test_mesh_repair_turns_faces_that_look_inwards);
    tcase_add_test(tcase, test_mesh_weld_joins_vertices_within_its_tolerance);
    tcase_add_test(tcase, test_mesh_merge_keeps_area_and_closure_of_random_solids);
    tcase_add_test(tcase, test_mesh_merge_sees_planes_through_rounding);
    tcase_add_test(tcase, test_mesh_merge_of_sheet_with_two_sides_gives_two_polygons);
    tcase_add_test(tcase, test_mesh_merge_keeps_materials_and_bends_apart);
    tcase_add_test(tcase, test_mesh_with_smooth_normals_shines_steadily);
    tcase_add_test(tcase, test_mesh_smooth_deg_leaves_edges_of_box_sharp);
    tcase_add_test(tcase, test_mesh_with_rounded_normals_stays_flat);
    tcase_add_test(tcase, test_mesh_copies_keep_smooth_normals);
    tcase_add_test(tcase, test_scenario_reads_mesh_beside_it_and_check_tells_of_it);
    tcase_add_test(tcase, test_scenario_mesh_wrong_is_refused);
    tcase_add_test(tcase, test_scenario_warns_of_mesh_that_flickers);
    tcase_add_test(tcase, test_scenario_hash_knows_what_the_mesh_file_says);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
