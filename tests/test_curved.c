/* Curved primitives in the light: shiny ones shine as the surfaces that their facets stand for, and
 * diffuse ones converge to closed forms. The integrals here are made from scalar BRDFs and true
 * normals, and know nothing of facets. */
#include "bench.h"

#include "brdf/sharpness.h"

static const double x_axis[3] = {1, 0, 0}, z_axis[3] = {0, 0, 1};

/* --- integrals over true normals --- */

/* g for the directions at a normal with a tangent (any length, not along it), 1/sr. */
static double g_at(const brdf_material *m, const double normal[3], const double tangent[3],
                   const double sun[3], const double observer[3])
{
    double t[3], b[3], frame[9], i[3], r[3];
    perp3(tangent, normal, t);
    cross3(normal, t, b);
    mat_rows(t, b, normal, frame);
    mat_vec(frame, sun, i), mat_vec(frame, observer, r);
    return brdf_material_eval(m, i, r);
}

/* A unit sphere of an isotropic material: rings about the bisector, even in the logarithm of their
 * angle, so that a lobe of any width is met. */
static double sphere_integral(const brdf_material *m, double phase)
{
    enum { RINGS = 3000, POINTS = 128 };
    const double from = log(1e-7), to = log(PI / 2), step = (to - from) / RINGS;
    const double sun[3] = {sin(0.5 * phase), 0, cos(0.5 * phase)};
    const double observer[3] = {-sun[0], 0, sun[2]};
    double sum = 0;
    for (int ring = 0; ring < RINGS; ring++) {
        const double angle = exp(from + (ring + 0.5) * step);
        double mean = 0;
        for (int k = 0; k < POINTS; k++) {
            const double a = TWO_PI * (k + 0.5) / POINTS;
            const double n[3] = {sin(angle) * cos(a), sin(angle) * sin(a), cos(angle)};
            mean += g_at(m, n, fabs(n[0]) < 0.9 ? x_axis : z_axis, sun, observer) / POINTS;
        }
        sum += mean * TWO_PI * sin(angle) * angle * step;
    }
    return sum;
}

/* The side of a cone about z, its tangent upwards: an even sum about the axis. slant: length along
 * the side; radius: mean radius; lean: z of the outward normal; side: -1 for the inside. */
static double cone_integral(const brdf_material *m, double radius, double slant, double lean,
                            double side, const double sun[3], const double observer[3])
{
    enum { POINTS = 20000 };
    const double upright = sqrt(1 - lean * lean);
    double sum = 0;
    for (int k = 0; k < POINTS; k++) {
        const double a = TWO_PI * (k + 0.5) / POINTS;
        const double n[3] = {side * upright * cos(a), side * upright * sin(a), side * lean};
        const double up[3] = {-lean * cos(a), -lean * sin(a), upright};
        sum += g_at(m, n, up, sun, observer);
    }
    return sum / POINTS * TWO_PI * radius * slant;
}

/* The hollow side (or, side = -1, the other) of a dish z = rho^2 / (2 R) about z up to a radius. */
static double dish_integral(const brdf_material *m, double radius, double curvature_radius,
                            double side, const double sun[3], const double observer[3])
{
    enum { RINGS = 300, POINTS = 900 };
    double sum = 0;
    for (int ring = 0; ring < RINGS; ring++) {
        const double rho = radius * (ring + 0.5) / RINGS, slope = rho / curvature_radius;
        const double stretch = sqrt(1 + slope * slope);
        double mean = 0;
        for (int k = 0; k < POINTS; k++) {
            const double a = TWO_PI * (k + 0.5) / POINTS;
            const double n[3] = {-side * slope / stretch * cos(a), -side * slope / stretch * sin(a),
                                 side / stretch};
            const double out[3] = {cos(a), sin(a), slope};
            mean += g_at(m, n, out, sun, observer) / POINTS;
        }
        sum += mean * TWO_PI * rho * stretch * (radius / RINGS);
    }
    return sum;
}

/* ---------------------------------------------------------------- how sharp lobes are */

START_TEST(test_sharpness_of_gaussian_lobes_is_alpha_over_root_two)
{
    static const char *const names[] = {"ward", "ward-duer", "ward-gmd"};
    for (size_t k = 0; k < 3; k++)
        for (double alpha = 1e-5; alpha < 0.2; alpha *= 10) {
            bench b = {0};
            bench_paint(&b, &(paint){names[k], {0.3, 0.5, alpha, 2 * alpha, NONE, NONE}});
            brdf_sharpness s;
            brdf_lobe_sharpness(&b.lobe, &s);
            /* terms of third order in the tilt: alpha^2 of the width */
            assert_rel(s.width[0], alpha / sqrt(2), 1e-6 + alpha * alpha);
            assert_rel(s.width[1], 2 * alpha / sqrt(2), 1e-6 + 4 * alpha * alpha);
            if (alpha > 0.05) continue;
            /* 1e-4 of the height at alpha sqrt(ln 1e4), found to a step of a third */
            const double tail = alpha * sqrt(log(1e4));
            ck_assert(s.reach[0] > tail * (1 - 10 * alpha * alpha) && s.reach[0] < 1.35 * tail);
        }
}
END_TEST

START_TEST(test_sharpness_of_phong_follows_its_power)
{
    bench b = {0};
    bench_paint(&b, &(paint){"phong", {0, 0.5, 40000}});
    brdf_sharpness s;
    brdf_lobe_sharpness(&b.lobe, &s);
    /* cos^n(2 t) = exp(-1/2): t = 1 / (2 sqrt(n)) */
    assert_rel(s.width[0], 0.0025, 1e-4);
    assert_rel(s.width[1], 0.0025, 1e-4);
}
END_TEST

START_TEST(test_sharpness_of_diffuse_models_is_none)
{
    static const paint diffuse[] = {
        {"lambert", {0.5}},         {"oren-nayar", {0.5, 20}},       {"minnaert", {0.5, 0.8}},
        {"lommel-seeliger", {0.3}}, {"hapke", {0.3, -0.3, 1, 0.05}}, {"phong", {0.5, 0, 1000}},
        {"phong", {0.5, 0.001, 1}}};
    for (size_t k = 0; k < sizeof diffuse / sizeof *diffuse; k++) {
        bench b = {0};
        bench_paint(&b, &diffuse[k]);
        ck_assert_msg(brdf_material_width(&b.material) == HUGE_VAL, "%s", diffuse[k].name);
    }
}
END_TEST

START_TEST(test_sharpness_of_material_is_that_of_its_sharpest_lobe)
{
    bench a = {0}, b = {0};
    bench_paint(&a, &(paint){"ward-gmd", {0, 0.5, 0.2, 0.2, NONE, NONE}});
    bench_paint(&b, &(paint){"ward-gmd", {0, 0.1, 0.01, 0.03, NONE, NONE}});
    brdf_lobe lobes[2] = {a.lobe, b.lobe};
    brdf_material both = {2, lobes};
    assert_rel(brdf_material_width(&both), 0.01 / sqrt(2), 1e-3);
    lobes[1].weight = 0;
    assert_rel(brdf_material_width(&both), 0.2 / sqrt(2), 0.04);
}
END_TEST

/* ---------------------------------------------------------------- spheres */

static const double phases_deg[] = {2, 30, 60, 90, 120, 150};
enum { N_PHASES = sizeof phases_deg / sizeof *phases_deg, N_ATTITUDES = 320 };

/* The sphere's sums over attitudes and phase angles are within `rel` of what `want` says of the
 * phase angle. */
static void assert_constant(int facets, const paint *p,
                            double (*want)(const bench *b, double phase), double rel)
{
    primitive_spec spec = sphere_shape(1, facets);
    bench *b = bench_of(&spec, p);
    for (int ph = 0; ph < N_PHASES; ph++) {
        const double phase = phases_deg[ph] * DEG, right = want(b, phase);
        for (int tile = 0; tile < N_ATTITUDES / BRDF_TILE; tile++) {
            double sun[BRDF_TILE][3], observer[BRDF_TILE][3], x[BRDF_TILE];
            for (int k = 0; k < BRDF_TILE; k++)
                light_at(tile * BRDF_TILE + k, phase, sun[k], observer[k]);
            sums_of(b, sun, observer, x);
            for (int k = 0; k < BRDF_TILE; k++)
                ck_assert_msg(is_near(x[k], right, rel * right),
                              "%s %g, %d facets, phase %g deg, attitude %d: %.8g; expected %.8g "
                              "(off %.2g)",
                              p->name, p->params[2], facets, phases_deg[ph], tile * BRDF_TILE + k,
                              x[k], right, x[k] / right - 1);
        }
    }
    bench_free(b);
}

static double integral(const bench *b, double phase)
{
    return sphere_integral(&b->material, phase);
}

/* A sphere whose lobes are narrow: each point reflects from its own mirror direction alone, so that
 * X = r^2 integral of f ci cr over the normals = rho_s r^2 / 4, whatever the phase angle, where f
 * ci cr is rho_s / (4 pi a^2) at the peak; Ward's own has sqrt(ci cr) = cos(half of the phase
 * angle) more. */
static double quarter(const bench *b, double phase)
{
    const bool seed = strcmp(b->lobe.model->name, "ward") == 0;
    return 0.25 * b->lobe.params[1] * (seed ? cos(0.5 * phase) : 1);
}

START_TEST(test_sphere_of_narrow_lobe_reflects_a_quarter)
{
    static const char *const names[] = {"ward", "ward-duer", "ward-gmd"};
    for (size_t k = 0; k < 3; k++)
        for (double alpha = 1e-4; alpha < 5e-3; alpha *= 10) {
            const paint p = {names[k], {0, 0.6, alpha, alpha, NONE, NONE}};
            /* 2e-3: what is held of the integration; the rest is the closed form's: to first order
             * a^2/2 (1 + tan^2(75 deg)) */
            assert_constant(1280, &p, quarter, 2e-3 + 8 * alpha * alpha);
        }
}
END_TEST

START_TEST(test_sphere_of_shiny_paint_is_constant)
{
    static const paint shiny[] = {
        {"ward", {0, 0.5, 0.02, 0.02, NONE, NONE}},
        {"ward-duer", {0, 0.5, 0.02, 0.02, NONE, NONE}},
        {"ward-gmd", {0, 0.5, 0.02, 0.02, NONE, NONE}},
        {"ward-gmd", {0, 0.5, 0.05, 0.05, NONE, NONE}},
        {"ward-gmd", {0, 0.5, 0.1, 0.1, NONE, NONE}},
        {"ashikhmin-shirley", {0, 0.5, 5000, 5000}},
        {"ashikhmin-premoze", {0, 0.5, 5000, 5000}},
        {"cook-torrance", {0, 0.5, 0.02, 1.5, 0}},
        {"ggx", {0, 0.5, 0.02, 0.02, 1.5, 0}},
        {"phong", {0, 0.5, 5000}},
    };
    /* 0.3 %, and half of that for most; the physics page asks for 1 %. Diffuse light is left out:
     * its error is the polyhedron's. */
    for (size_t k = 0; k < sizeof shiny / sizeof *shiny; k++)
        assert_constant(1280, &shiny[k], integral, k == 9 ? 6e-3 : 3e-3);
}
END_TEST

START_TEST(test_sphere_of_shiny_paint_is_constant_with_few_facets)
{
    static const paint p = {"ward-gmd", {0, 0.5, 0.02, 0.02, NONE, NONE}};
    /* A facet is dark where its own normal is: with 20 facets that is already half a facet away
     * from where the light ends, which counts at large phase angles. */
    assert_constant(5120, &p, integral, 3e-3);
    assert_constant(320, &p, integral, 3e-3);
    primitive_spec spec = sphere_shape(1, 80);
    bench *b = bench_of(&spec, &p);
    const double phase = 30 * DEG, right = integral(b, phase);
    double sun[BRDF_TILE][3], observer[BRDF_TILE][3], x[BRDF_TILE];
    for (int k = 0; k < BRDF_TILE; k++)
        light_at(k, phase, sun[k], observer[k]);
    sums_of(b, sun, observer, x);
    for (int k = 0; k < BRDF_TILE; k++)
        assert_rel(x[k], right, 3e-3);
    bench_free(b);
}
END_TEST

START_TEST(test_sphere_of_long_tailed_paint_is_nearly_constant)
{
    /* Much of such a lobe is as diffuse as Lambert's, and errs with the polyhedron. */
    static const paint p = {"abg", {0, 0.02, 2.3e-6, 2.26}};
    assert_constant(1280, &p, integral, 0.01);
}
END_TEST

START_TEST(test_sphere_of_diffuse_paint_is_the_polyhedron)
{
    const paint p = {"lambert", {0.25}};
    primitive_spec spec = sphere_shape(1.5, 320);
    bench *b = bench_of(&spec, &p);
    ck_assert_ptr_null(b->model.spans[0].curved);
    double sun[BRDF_TILE][3], observer[BRDF_TILE][3], x[BRDF_TILE];
    for (int k = 0; k < BRDF_TILE; k++)
        light_at(k, 1, sun[k], observer[k]);
    sums_of(b, sun, observer, x);
    for (int k = 0; k < BRDF_TILE; k++) {
        double want = 0;
        for (int f = 0; f < b->model.n_facets; f++) {
            const facet *one = &b->model.polygons.items[f];
            const double ci = dot3(one->normal, sun[k]), cr = dot3(one->normal, observer[k]);
            if (ci > 0 && cr > 0) want += 0.25 / PI * ci * cr * one->area_m2;
        }
        assert_rel(x[k], want, 1e-13);
    }
    bench_free(b);
}
END_TEST

/* ---------------------------------------------------------------- cylinders and cones */

/* All attitudes of a tile at a phase angle, near those in which the body glints: the bisector
 * within some widths of the normals. */
static void glinting(const brdf_sharpness *s, double lean, double phase, int first,
                     double (*sun)[3], double (*observer)[3])
{
    for (int k = 0; k < BRDF_TILE; k++) {
        const double tilt = (2 * number(first + k, 0) - 1) * 4 * s->width[0];
        const double a = TWO_PI * number(first + k, 1), up = asin(lean) + tilt;
        const double turn = PI * number(first + k, 2);
        const double h[3] = {cos(up) * cos(a), cos(up) * sin(a), sin(up)};
        double aside[3], other[3];
        perp3(z_axis, h, aside);
        cross3(h, aside, other);
        scale3(aside, cos(turn), aside);
        add_scaled3(aside, sin(turn), other, aside);
        for (int side = 0; side < 2; side++) {
            double *out = side ? observer[k] : sun[k];
            scale3(h, cos(0.5 * phase), out);
            add_scaled3(out, (side ? -1 : 1) * sin(0.5 * phase), aside, out);
        }
    }
}

/* A cone of those sides (radii 1.5 and top_m, length 4) agrees with its integral, to a part of its
 * brightest glint. */
static void assert_cone(const char *kind, int sides, double top_m, const paint *p, double part)
{
    const double bottom_m = 1.5, length_m = 4, inwards_m = bottom_m - top_m;
    const double slant = hypot(inwards_m, length_m), lean = inwards_m / slant;
    primitive_spec spec = shape(kind);
    SET(&spec, "radius_m", bottom_m);
    if (strcmp(kind, "cone") == 0) SET(&spec, "top_radius_m", top_m);
    SET(&spec, "length_m", length_m);
    SET(&spec, "sides", sides);
    SET(&spec, "open", 1);
    shape_material(&spec, "material", 0);
    bench *b = bench_of(&spec, p);
    brdf_sharpness s;
    brdf_lobe_sharpness(&b->lobe, &s);
    double want[3][BRDF_TILE], x[3][BRDF_TILE], brightest = 0;
    for (int ph = 0; ph < 3; ph++) {
        double sun[BRDF_TILE][3], observer[BRDF_TILE][3];
        glinting(&s, lean, (5 + 50 * ph) * DEG, ph * BRDF_TILE, sun, observer);
        sums_of(b, sun, observer, x[ph]);
        for (int k = 0; k < BRDF_TILE; k++) {
            want[ph][k] = cone_integral(&b->material, 0.5 * (bottom_m + top_m), slant, lean, 1,
                                        sun[k], observer[k]);
            brightest = fmax(brightest, want[ph][k]);
        }
    }
    for (int ph = 0; ph < 3; ph++)
        for (int k = 0; k < BRDF_TILE; k++)
            ck_assert_msg(
                is_near(x[ph][k], want[ph][k], part * brightest),
                "%s of %d sides, %s, attitude %d.%d: %.8g; expected %.8g (off %.2g of %g)", kind,
                sides, p->name, ph, k, x[ph][k], want[ph][k], (x[ph][k] - want[ph][k]) / brightest,
                brightest);
    bench_free(b);
}

START_TEST(test_cylinder_of_shiny_paint_glints_as_its_integral)
{
    static const paint shiny[] = {{"ward-gmd", {0, 0.5, 0.02, 0.02, NONE, NONE}},
                                  {"ward-gmd", {0, 0.5, 0.02, 0.3, NONE, NONE}},
                                  {"ward-gmd", {0, 0.5, 0.3, 0.02, NONE, NONE}},
                                  {"ward", {0, 0.5, 0.05, 0.05, NONE, NONE}},
                                  {"ggx", {0, 0.5, 0.03, 0.03, 1.5, 0}},
                                  {"phong", {0, 0.5, 2000}}};
    for (size_t k = 0; k < sizeof shiny / sizeof *shiny; k++) {
        /* where the lobe is wide against the facets they are flat, and their area is short of the
         * cylinder's by (pi/n)^2/6 */
        assert_cone("cylinder", 64, 1.5, &shiny[k], 5e-4);
        assert_cone("cylinder", 16, 1.5, &shiny[k], 1e-2);
    }
}
END_TEST

START_TEST(test_cone_of_shiny_paint_glints_as_its_integral)
{
    static const paint shiny[] = {{"ward-gmd", {0, 0.5, 0.02, 0.02, NONE, NONE}},
                                  {"ward-gmd", {0, 0.5, 0.02, 0.3, NONE, NONE}},
                                  {"cook-torrance", {0, 0.5, 0.05, 1.5, 0}}};
    for (size_t k = 0; k < sizeof shiny / sizeof *shiny; k++) {
        assert_cone("cone", 64, 0, &shiny[k], 1e-3);
        assert_cone("cone", 64, 1, &shiny[k], 1e-3);
        assert_cone("cone", 32, 3, &shiny[k], 1e-3);
    }
}
END_TEST

/* The inside of an open cylinder shines as its outside does, seen from the other side. */
START_TEST(test_cylinder_inside_shines_as_its_integral)
{
    const paint p = {"ward-gmd", {0, 0.5, 0.03, 0.03, NONE, NONE}};
    primitive_spec spec = shape("cylinder");
    SET(&spec, "radius_m", 1);
    SET(&spec, "length_m", 2);
    SET(&spec, "sides", 48);
    SET(&spec, "open", 1);
    shape_material(&spec, "material", 0);
    shape_material(&spec, "inside_material", 0);
    bench *b = bench_of(&spec, &p);
    ck_assert_int_eq(b->model.n_facets, 96);
    brdf_sharpness s;
    brdf_lobe_sharpness(&b->lobe, &s);
    double sun[BRDF_TILE][3], observer[BRDF_TILE][3], x[BRDF_TILE];
    glinting(&s, 0, 0.5, 0, sun, observer);
    sums_of(b, sun, observer, x);
    for (int k = 0; k < BRDF_TILE; k++) {
        double want = 0;
        for (int side = -1; side < 2; side += 2)
            want += cone_integral(&b->material, 1, 2, 0, side, sun[k], observer[k]);
        assert_near(x[k], want, 1e-3 * 4);
    }
    bench_free(b);
}
END_TEST

/* ---------------------------------------------------------------- diffuse ones */

/* Two directions e_s and e_o above the plane across the axis of a cylinder (z), D apart in azimuth.
 */
static void about_axis(double e_s, double e_o, double apart, double turn, double sun[3],
                       double observer[3])
{
    sun[0] = cos(e_s) * cos(turn), sun[1] = cos(e_s) * sin(turn), sun[2] = sin(e_s);
    observer[0] = cos(e_o) * cos(turn + apart), observer[1] = cos(e_o) * sin(turn + apart);
    observer[2] = sin(e_o);
}

/* Side of a cylinder: X = rho r L cos(e_s) cos(e_o) [sin D + (pi - D) cos D] / (2 pi) (physics
 * page, section 11). */
START_TEST(test_cylinder_of_diffuse_paint_converges_to_closed_form)
{
    const paint p = {"lambert", {0.4}};
    double worst[2] = {0, 0};
    for (int finer = 0; finer < 2; finer++) {
        primitive_spec spec = shape("cylinder");
        SET(&spec, "radius_m", 1.2);
        SET(&spec, "length_m", 5);
        SET(&spec, "sides", finer ? 128 : 64);
        SET(&spec, "open", 1);
        shape_material(&spec, "material", 0);
        bench *b = bench_of(&spec, &p);
        double sun[BRDF_TILE][3], observer[BRDF_TILE][3], x[BRDF_TILE];
        for (int k = 0; k < BRDF_TILE; k++)
            about_axis((number(k, 0) - 0.5) * 2.5, (number(k, 1) - 0.5) * 2.5, 2.4 * number(k, 2),
                       number(k, 3), sun[k], observer[k]);
        sums_of(b, sun, observer, x);
        for (int k = 0; k < BRDF_TILE; k++) {
            const double apart = 2.4 * number(k, 2);
            const double e_s = (number(k, 0) - 0.5) * 2.5, e_o = (number(k, 1) - 0.5) * 2.5;
            const double full = 0.4 * 1.2 * 5 * cos(e_s) * cos(e_o) / 2; /* at D = 0 */
            const double want = full * (sin(apart) + (PI - apart) * cos(apart)) / PI;
            worst[finer] = fmax(worst[finer], fabs(x[k] - want) / full);
        }
        bench_free(b);
    }
    /* Sides are short of the circle by (pi/n)^2/6, and light begins and ends within a side. */
    ck_assert_msg(worst[0] < 2e-3, "%g", worst[0]);
    ck_assert_msg(worst[1] < 0.4 * worst[0], "%g, %g", worst[0], worst[1]);
}
END_TEST

START_TEST(test_disc_of_diffuse_paint_converges_to_closed_form)
{
    const paint p = {"lambert", {0.4}};
    double off[2];
    for (int finer = 0; finer < 2; finer++) {
        primitive_spec spec = shape("disc");
        SET(&spec, "radius_m", 1.5);
        SET(&spec, "normal", 0, 0, 1);
        SET(&spec, "sides", finer ? 128 : 64);
        shape_material(&spec, "material", 0);
        bench *b = bench_of(&spec, &p);
        double sun[BRDF_TILE][3], observer[BRDF_TILE][3], x[BRDF_TILE];
        for (int k = 0; k < BRDF_TILE; k++)
            about_axis(60 * DEG, 45 * DEG, k, 1, sun[k], observer[k]);
        sums_of(b, sun, observer, x);
        const double want = 0.4 / PI * PI * 2.25 * sin(60 * DEG) * sin(45 * DEG);
        off[finer] = 1 - x[0] / want;
        for (int k = 1; k < BRDF_TILE; k++)
            assert_rel(x[k], x[0], 1e-14);
        bench_free(b);
    }
    /* 1 - sin(2a)/(2a), a = pi/n */
    assert_rel(off[0], 2 * PI * PI / (3 * 64 * 64), 1e-3);
    assert_rel(off[1], 2 * PI * PI / (3 * 128 * 128), 1e-3);
}
END_TEST

START_TEST(test_cone_and_dish_of_diffuse_paint_converge_to_their_integrals)
{
    const paint p = {"lambert", {0.4}};
    double sun[BRDF_TILE][3], observer[BRDF_TILE][3], x[BRDF_TILE], worst[2][2] = {{0}};
    for (int k = 0; k < BRDF_TILE; k++)
        about_axis(0.3 + number(k, 0), 0.3 + number(k, 1), 2 * number(k, 2), number(k, 3), sun[k],
                   observer[k]);
    for (int finer = 0; finer < 2; finer++)
        for (int dish = 0; dish < 2; dish++) {
            primitive_spec spec = shape(dish ? "dish" : "cone");
            SET(&spec, "radius_m", 1);
            if (dish)
                SET(&spec, "depth_m", 0.25);
            else
                SET(&spec, "length_m", 2);
            if (dish) SET(&spec, "rings", finer ? 16 : 8);
            SET(&spec, "sides", finer ? 128 : 64);
            if (!dish) SET(&spec, "open", 1);
            shape_material(&spec, "material", 0);
            bench *b = bench_of(&spec, &p);
            sums_of(b, sun, observer, x);
            for (int k = 0; k < BRDF_TILE; k++) {
                const double want = dish ? dish_integral(&b->material, 1, 2, 1, sun[k], observer[k])
                                         : cone_integral(&b->material, 0.5, sqrt(5), 1 / sqrt(5), 1,
                                                         sun[k], observer[k]);
                worst[dish][finer] = fmax(worst[dish][finer], fabs(x[k] / want - 1));
            }
            bench_free(b);
        }
    for (int dish = 0; dish < 2; dish++) {
        ck_assert_msg(worst[dish][0] < 4e-3, "%d: %g", dish, worst[dish][0]);
        ck_assert_msg(worst[dish][1] < 0.4 * worst[dish][0], "%d: %g, %g", dish, worst[dish][0],
                      worst[dish][1]);
    }
}
END_TEST

/* ---------------------------------------------------------------- dishes */

/* A dish of radius 1 and depth 0.25 (R = 2) with those facets agrees with its integral on both
 * sides, for highlights anywhere but at the rim (which is a polygon), to a part of the brightest.
 */
static void assert_dish(int sides, int rings, const paint *p, double part)
{
    primitive_spec spec = shape("dish");
    SET(&spec, "radius_m", 1);
    SET(&spec, "depth_m", 0.25);
    SET(&spec, "sides", sides);
    SET(&spec, "rings", rings);
    shape_material(&spec, "material", 0);
    shape_material(&spec, "back_material", 0);
    bench *b = bench_of(&spec, p);
    double sun[BRDF_TILE][3], observer[BRDF_TILE][3], x[BRDF_TILE], want[BRDF_TILE], brightest = 0;
    for (int k = 0; k < BRDF_TILE; k++) {
        const double rho = 0.85 * sqrt(number(k, 0)), a = TWO_PI * number(k, 1),
                     side = k % 2 ? 1 : -1;
        double h[3] = {-side * 0.5 * rho * cos(a), -side * 0.5 * rho * sin(a), side}, aside[3];
        unit3(h, h);
        perp3(x_axis, h, aside);
        const double half = 0.05 + 0.4 * number(k, 2);
        for (int which = 0; which < 2; which++) {
            double *out = which ? observer[k] : sun[k];
            scale3(h, cos(half), out);
            add_scaled3(out, (which ? -1 : 1) * sin(half), aside, out);
        }
        want[k] = dish_integral(&b->material, 1, 2, side, sun[k], observer[k]);
        brightest = fmax(brightest, want[k]);
    }
    sums_of(b, sun, observer, x);
    for (int k = 0; k < BRDF_TILE; k++)
        ck_assert_msg(is_near(x[k], want[k], part * brightest),
                      "%d x %d, %s %g, highlight %d: %.8g; expected %.8g (off %.2g of %g)", sides,
                      rings, p->name, p->params[2], k, x[k], want[k], (x[k] - want[k]) / brightest,
                      brightest);
    bench_free(b);
}

START_TEST(test_dish_of_shiny_paint_shines_as_its_integral)
{
    static const paint shiny[] = {{"ward-gmd", {0, 0.5, 0.03, 0.03, NONE, NONE}},
                                  {"ggx", {0, 0.5, 0.02, 0.02, 1.5, 0}}};
    for (size_t k = 0; k < sizeof shiny / sizeof *shiny; k++) {
        assert_dish(64, 12, &shiny[k], 2e-3);
        assert_dish(24, 4, &shiny[k], 1e-2);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("curved");
    TCase *sharp = tcase_create("sharpness"), *sphere = tcase_create("sphere"),
          *cone = tcase_create("cone"), *dish = tcase_create("dish");
    tcase_add_test(sharp, test_sharpness_of_gaussian_lobes_is_alpha_over_root_two);
    tcase_add_test(sharp, test_sharpness_of_phong_follows_its_power);
    tcase_add_test(sharp, test_sharpness_of_diffuse_models_is_none);
    tcase_add_test(sharp, test_sharpness_of_material_is_that_of_its_sharpest_lobe);
    tcase_add_test(sphere, test_sphere_of_narrow_lobe_reflects_a_quarter);
    tcase_add_test(sphere, test_sphere_of_shiny_paint_is_constant);
    tcase_add_test(sphere, test_sphere_of_shiny_paint_is_constant_with_few_facets);
    tcase_add_test(sphere, test_sphere_of_long_tailed_paint_is_nearly_constant);
    tcase_add_test(sphere, test_sphere_of_diffuse_paint_is_the_polyhedron);
    tcase_add_test(cone, test_cylinder_of_shiny_paint_glints_as_its_integral);
    tcase_add_test(cone, test_cone_of_shiny_paint_glints_as_its_integral);
    tcase_add_test(cone, test_cylinder_inside_shines_as_its_integral);
    tcase_add_test(cone, test_cylinder_of_diffuse_paint_converges_to_closed_form);
    tcase_add_test(cone, test_disc_of_diffuse_paint_converges_to_closed_form);
    tcase_add_test(cone, test_cone_and_dish_of_diffuse_paint_converge_to_their_integrals);
    tcase_add_test(dish, test_dish_of_shiny_paint_shines_as_its_integral);
    tcase_set_timeout(dish, 300);
    tcase_set_timeout(sharp, 60);
    tcase_set_timeout(sphere, 300);
    tcase_set_timeout(cone, 300);
    suite_add_tcase(suite, sharp);
    suite_add_tcase(suite, sphere);
    suite_add_tcase(suite, cone);
    suite_add_tcase(suite, dish);
    return run_suite(suite);
}
