/* The Sun as a disc: held against brute-force quadrature over it with scalar BRDFs, which knows
 * nothing of lobes, and against closed forms. */
#include "bench.h"

#include "base/random.h"
#include "facets/solar_disc.h"

#define SUN_Q (0.2664531 * DEG) /* rad, angular radius at 1 au (physics page, section 4) */

/* What the model sees of one pair, m^2/sr; every lane must say the same. */
static double sum_of(const bench *b, const double sun[3], const double observer[3], double q,
                     bool limb_darkened)
{
    brdf_light light;
    source_disc disc;
    source_disc_start(&disc, limb_darkened);
    double x[BRDF_TILE];
    for (int k = 0; k < BRDF_TILE; k++) {
        source_disc_set(&disc, k, q);
        for (int j = 0; j < 3; j++)
            light.i[j][k] = sun[j], light.r[j][k] = observer[j];
    }
    brdf_light_finish(&light);
    ck_assert_int_eq(b->model.n_spans, 1);
    model_sum(&b->model, &light, &disc, NULL, x);
    for (int k = 1; k < BRDF_TILE; k++)
        ck_assert_msg(x[k] == x[0], "lane %d: %.17g, lane 0: %.17g", k, x[k], x[0]);
    return x[0];
}

/* The mean of g over the disc by brute force: a square grid of n x n points. It covers the disc, or
 * what lies within 12 widths of the lobe of the mirror direction, if that is smaller: past it
 * Gaussian lobes are gone (exp(-72)). width: of the bisector, rad; HUGE_VAL for lobes with wings.
 */
static double brute(const brdf_material *m, const double sun[3], const double observer[3], double q,
                    bool limb_darkened, double width, int n)
{
    double e1[3], e2[3], total = 0;
    const double other[3] = {0.3, -0.7, 0.2}, image[3] = {-observer[0], -observer[1], observer[2]};
    perp3(other, sun, e1);
    cross3(sun, e1, e2);
    /* A tilt of the bisector is half of that of the source, at least. */
    const double reach = 24 * width / tan(q), along = dot3(image, sun) * tan(q);
    const double middle[2] = {dot3(image, e1) / along, dot3(image, e2) / along};
    double lo[2], step[2];
    for (int j = 0; j < 2; j++) {
        lo[j] = fmin(fmax(middle[j] - reach, -1), 1);
        step[j] = (fmax(fmin(middle[j] + reach, 1), -1) - lo[j]) / n;
    }
    for (int a = 0; a < n; a++)
        for (int b = 0; b < n; b++) {
            const double x = lo[0] + (a + 0.5) * step[0], y = lo[1] + (b + 0.5) * step[1];
            const double s = x * x + y * y;
            if (s > 1) continue;
            double i[3];
            for (int j = 0; j < 3; j++)
                i[j] = sun[j] + tan(q) * (x * e1[j] + y * e2[j]);
            unit3(i, i);
            const double bright = limb_darkened ? (1 - 0.6 * (1 - sqrt(1 - s))) / 0.8 : 1;
            total += bright * brdf_material_eval(m, i, observer);
        }
    return total * step[0] * step[1] / PI;
}

/* --- against brute force --- */

/* A direction to the observer for which the mirror normal is tilted from the facet's by `tilt`, in
 * the plane of incidence or across it. */
static void offset_mirror(const double sun[3], double tilt, double azimuth, double observer[3])
{
    const double n[3] = {sin(tilt) * cos(azimuth), sin(tilt) * sin(azimuth), cos(tilt)};
    const double c = dot3(sun, n);
    for (int j = 0; j < 3; j++)
        observer[j] = 2 * c * n[j] - sun[j];
}

/* Samples about the mirror direction: tilts in widths of the lobe and in radii of the disc, at
 * incidences up to 80 deg. Only where some light is: below `least` of the overhead value the
 * lobe is over. */
static void check_paint(const paint *p, double width, bool limb_darkened, int n_across,
                        double tolerance_mag)
{
    static const double INCIDENCE[] = {0, 30, 60, 80}; /* deg */
    static const double WIDTHS[] = {0, 1, 2.5, 4}, RADII[] = {0.3, 0.45};
    static const double UP[3] = {0, 0, 1};
    bench *b = plate_of(p);
    const double reach = strncmp(p->name, "ward", 4) ? HUGE_VAL : width;
    const double top = brute(&b->material, UP, UP, SUN_Q, limb_darkened, reach, 200);
    int n = 0;
    for (int c = 0; c < 4; c++)
        for (int o = 0; o < 12; o++) {
            const double azimuth = 0.4, theta = INCIDENCE[c] * DEG;
            const double tilt = o / 2 < 4 ? WIDTHS[o / 2] * width : RADII[o / 2 - 4] * SUN_Q;
            const double sun[3] = {sin(theta) * cos(azimuth), sin(theta) * sin(azimuth),
                                   cos(theta)};
            double observer[3];
            offset_mirror(sun, tilt, azimuth + (o % 2) * PI / 2, observer);
            if (observer[2] < 0.05) continue;
            const double want =
                brute(&b->material, sun, observer, SUN_Q, limb_darkened, reach, n_across);
            if (!(want > 1e-3 * top)) continue;
            const double got = sum_of(b, sun, observer, SUN_Q, limb_darkened);
            ck_assert_msg(got > 0, "%s: nothing at %g deg", p->name, INCIDENCE[c]);
            const double off = 2.5 * log10(got / want);
            ck_assert_msg(fabs(off) <= tolerance_mag,
                          "%s %g: %.2e mag at incidence %g deg, tilt %g widths, azimuth %d",
                          p->name, p->params[2], off, INCIDENCE[c], tilt / width, o % 2);
            n++;
        }
    ck_assert_int_ge(n, 12);
    bench_free(b);
}

/* Physics page, section 4: 1e-3 mag. Brute force itself is off by 2e-4 where its grid is a third of
 * the lobe, which sets the number of its points. */
START_TEST(test_solar_disc_blurs_gaussian_lobes_as_brute_force_does)
{
    static const double ALPHA[] = {1e-4, 1e-3, 3e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5};
    static const char *const NAME[] = {"ward", "ward-duer", "ward-gmd"};
    for (int k = 0; k < 9; k++) {
        const double alpha = ALPHA[k];
        const paint p = {NAME[k % 3], {0, 0.5, alpha, alpha, NONE, NONE}};
        check_paint(&p, alpha / sqrt(2), _i == 1, 300, 1e-3);
    }
}
END_TEST

START_TEST(test_solar_disc_blurs_every_kind_of_lobe_as_brute_force_does)
{
    static const paint PAINTS[] = {
        {"ward", {0.1, 0.4, 0.02, 0.006, NONE, NONE}},
        {"ward-gmd", {0.0, 0.4, 0.004, 0.05, NONE, NONE}},
        {"phong", {0, 0.5, 100}},
        {"phong", {0.1, 0.5, 20000}},
        {"ggx", {0, 0.5, 0.003, 0.003, 1.5, 0}},
        {"ggx", {0, 0.5, 0.05, 0.05, 1.5, 0}},
        {"cook-torrance", {0, 0.5, 0.01, 1.5, 0}},
        {"cook-torrance", {0, 0.5, 0.1, 1.5, 3}},
        {"ashikhmin-shirley", {0, 0.5, 1000, 20000}},
        {"ashikhmin-premoze", {0.2, 0.5, 5000, 5000}},
        {"abg", {0, 1e-4, 1e-4, 2.5}},
        {"five-parameter", {5, 0.05, 0.1, 1, -2}},
        {"lambert", {0.5}},
        {"oren-nayar", {0.5, 30}},
        {"minnaert", {0.5, 0.7}},
        {"lommel-seeliger", {0.3}},
        {"hapke", {0.3, 0.2, 1, 0.05}},
    };
    static const double WIDTH[] = {0.014, 0.035, 0.1, 0.007, 0.002, 0.03, 0.007, 0.07, 0.03,
                                   0.014, 0.02,  0.1, 0.3,   0.3,   0.3,  0.3,   0.3};
    const paint *p = &PAINTS[_i];
    check_paint(p, WIDTH[_i], _i % 2, 300, 1e-3);
}
END_TEST

/* --- at grazing incidence --- */

/* Elevation and azimuth above a facet, deg. */
static void direction_at(double elevation, double azimuth, double out[3])
{
    out[0] = cos(elevation * DEG) * cos(azimuth * DEG);
    out[1] = cos(elevation * DEG) * sin(azimuth * DEG);
    out[2] = sin(elevation * DEG);
}

/* As brute, line by line from the horizon or the lower limb up; on each line only within 12 widths
 * of the lobe's ridge, which stands upright there. */
static double brute_low(const brdf_material *m, const double sun[3], const double observer[3],
                        double q, double alpha, int n)
{
    static const double UP[3] = {0, 0, 1};
    double e1[3], e2[3], total = 0;
    perp3(UP, sun, e1);
    cross3(sun, e1, e2);
    const double scale = tan(q), lowest = fmax(-1, -sun[2] / (scale * e1[2]));
    const double step = (1 - lowest) / n, ridge = -dot3(observer, e2) / scale;
    for (int a = 0; a < n; a++) {
        const double x = lowest + (a + 0.5) * step, c = sqrt(1 - x * x);
        const double height = sun[2] + scale * x * e1[2] + observer[2];
        const double reach = 12 * alpha * height / scale;
        const double lo = fmax(ridge - reach, -c), hi = fmin(ridge + reach, c);
        for (int b = 0; b < n && lo < hi; b++) {
            const double y = lo + (hi - lo) * (b + 0.5) / n;
            double i[3];
            for (int j = 0; j < 3; j++)
                i[j] = sun[j] + scale * (x * e1[j] + y * e2[j]);
            unit3(i, i);
            total += step * (hi - lo) / n * brdf_material_eval(m, i, observer);
        }
    }
    return total / PI;
}

/* A lobe is then narrower across the disc than along it by many times, and as wide as its distance
 * from the plane. 0.5 %, and 0.1 % of the highlight beside the limb; with the middle of the disc
 * alone it would be off by up to 20 mag. */
START_TEST(test_solar_disc_finds_narrow_lobes_at_grazing_incidence)
{
    static const double ALPHA[] = {1e-4, 1e-3, 8e-3, 0.03};
    static const double SUN[] = {3, 1, 0.5, 0.27, 0.2, 0.1, 0, -0.1, -0.2}; /* deg */
    static const double HIGHER[] = {-0.3, -0.05, 0, 0.003, 0.1, 0.3, 1}, ASIDE[] = {0, 0.02, 0.2};
    const double alpha = ALPHA[_i], turned = 58;
    const paint p = {"ward-gmd", {0, 0.5, alpha, alpha, NONE, NONE}};
    bench *b = plate_of(&p);
    int n = 0;
    for (int k = 0; k < 9 * 7 * 3; k++) {
        const double elevation = fabs(SUN[k / 21]) + HIGHER[k / 3 % 7];
        double sun[3], observer[3];
        if (elevation < 0.03) continue;
        direction_at(SUN[k / 21], turned, sun);
        /* towards the mirror image of the middle of what is up */
        const double lowest = fmax(SUN[k / 21] - SUN_Q / DEG, 0);
        direction_at(0.5 * (lowest + SUN[k / 21] + SUN_Q / DEG), turned + 180, observer);
        const double top = brute_low(&b->material, sun, observer, SUN_Q, alpha, 300);
        direction_at(elevation, turned + 180 + ASIDE[k % 3], observer);
        const double want = brute_low(&b->material, sun, observer, SUN_Q, alpha, 500);
        const double got = sum_of(b, sun, observer, SUN_Q, false);
        ck_assert_msg(fabs(got - want) <= 5e-3 * want + 1e-3 * top,
                      "alpha %g: %g, expected %g, Sun at %g, observer at %g, %g aside", alpha, got,
                      want, SUN[k / 21], elevation, ASIDE[k % 3]);
        n += want > 0.01 * top;
    }
    ck_assert_int_ge(n, 40);
    bench_free(b);
}
END_TEST

/* A pair of directions on both sides of a bisector that is tilted by up to `widths` of the lobe. */
static void random_pair(const lobe_shape *shape, double widths, uint64_t *state, double i[3],
                        double r[3])
{
    static const double OTHER[3] = {0.3, 0.7, 0.1};
    const double half = 65 * DEG * random_even(state), distance = widths * random_even(state);
    const double azimuth = TWO_PI * random_even(state), turn = TWO_PI * random_even(state);
    double h[3] = {distance * shape->width[0] * cos(azimuth),
                   distance * shape->width[1] * sin(azimuth), 1};
    double e1[3], e2[3];
    unit3(h, h);
    perp3(OTHER, h, e1);
    cross3(h, e1, e2);
    for (int j = 0; j < 3; j++) {
        const double aside = sin(half) * (cos(turn) * e1[j] + sin(turn) * e2[j]);
        i[j] = cos(half) * h[j] + aside;
        r[j] = cos(half) * h[j] - aside;
    }
}

/* Lobes that stand out from what the material reflects besides, out to where they are lost in it,
 * at any phase angle up to 130 deg and in any plane: 1e-3 mag. Brute force is good to 1e-4 here. */
START_TEST(test_solar_disc_blurs_lobes_to_their_ends_as_brute_force_does)
{
    static const paint PAINTS[] = {
        {"ward-gmd", {0.1, 0.3, 0.05, 0.05, NONE, NONE}},
        {"ward", {0.1, 0.3, 0.1, 0.1, NONE, NONE}},
        {"ggx", {0.1, 0.5, 0.05, 0.05, 1.5, 0}},
        {"abg", {0.02, 1e-4, 1e-4, 2.5}},
        {"abg", {0.05, 1e-3, 1e-2, 1.5}},
        {"phong", {0.1, 0.3, 300}},
        {"cook-torrance", {0.05, 0.5, 0.05, 1.5, 3}},
        {"ashikhmin-shirley", {0.1, 0.2, 5000, 200}},
    };
    const paint *p = &PAINTS[_i];
    bench *b = plate_of(p);
    uint64_t state = 1;
    int n = 0;
    while (n < 300) {
        double sun[3], observer[3];
        random_pair(b->model.shapes, 9, &state, sun, observer);
        if (sun[2] < 0.1 || observer[2] < 0.1) continue;
        const double want = brute(&b->material, sun, observer, SUN_Q, n % 2, HUGE_VAL, 60);
        const double off = 2.5 * log10(sum_of(b, sun, observer, SUN_Q, n % 2) / want);
        ck_assert_msg(fabs(off) <= 1e-3, "%s: %.2e mag at sun (%g %g %g), observer (%g %g %g)",
                      p->name, off, sun[0], sun[1], sun[2], observer[0], observer[1], observer[2]);
        n++;
    }
    bench_free(b);
}
END_TEST

/* --- which samples are looked at --- */

/* Directions anywhere, in pairs of any phase angle or of one, and discs of several sizes. */
static void random_lights(bool one_phase, uint64_t *state, brdf_light *light, source_disc *disc)
{
    const double phase = 179.9 * DEG * random_even(state);
    const double q = random_even(state) < 0.8 ? SUN_Q : 0.1 * random_even(state);
    for (int k = 0; k < BRDF_TILE; k++) {
        double sun[3], observer[3];
        light_at((int)(random_even(state) * 1e6),
                 one_phase ? phase : 179.9 * DEG * random_even(state), sun, observer);
        for (int j = 0; j < 3; j++)
            light->i[j][k] = sun[j], light->r[j][k] = observer[j];
        source_disc_set(disc, k, k % 7 == 0 ? 0 : q);
    }
    brdf_light_finish(light);
}

static bool is_shown(const brdf_watch *watch, int k, double ci, double cr)
{
    return cr > BRDF_EDGE && (fabs(ci) < watch->low[k] ||
                              (watch->kind >= BRDF_WATCH_LOBE && ci + cr > watch->near[k]) ||
                              (watch->kind >= BRDF_WATCH_WINGS && fabs(ci) + cr < watch->graze[k]));
}

/* A normal at any tilt from the bisector, or near to where the source of that lane sets. */
static void random_normal_to(const brdf_light *light, int k, double q, uint64_t *state,
                             double normal[3])
{
    const double i[3] = {light->i[0][k], light->i[1][k], light->i[2][k]};
    double any[3], aside[3], h[3] = {light->h[0][k], light->h[1][k], light->h[2][k]};
    direction_of(random_even(state), random_even(state), any);
    unit3(h, h);
    const bool sets = random_even(state) < 0.3;
    perp3(any, sets ? i : h, aside);
    const double tilt = pow(10, 8 * random_even(state) - 4);
    for (int j = 0; j < 3; j++)
        normal[j] = sets ? aside[j] : h[j] + tilt * aside[j];
    if (sets) add_scaled3(normal, q * (2.4 * random_even(state) - 1.2), i, normal);
    unit3(normal, normal);
}

/* A pair of directions of a lane as the facet of that normal sees it. */
static void turn_pair(const brdf_light *light, int k, const double normal[3], double i[3],
                      double r[3])
{
    static const double UP[3] = {0.1, 0.9, 0.2};
    const double sun[3] = {light->i[0][k], light->i[1][k], light->i[2][k]};
    const double observer[3] = {light->r[0][k], light->r[1][k], light->r[2][k]};
    double frame[9];
    perp3(UP, normal, frame);
    cross3(normal, frame, frame + 3);
    copy3(normal, frame + 6);
    mat_vec(frame, sun, i);
    mat_vec(frame, observer, r);
}

/* Any shape that a lobe may have, and some that none has. */
static void random_shape(int draw, uint64_t *state, lobe_shape *shape)
{
    *shape = (lobe_shape){.specular = draw % 8 == 0, .surge = draw % 16 == 1};
    for (int j = 0; j < 2; j++)
        shape->width[j] = pow(10, -4 + 5 * random_even(state));
    if (draw % 2) shape->width[1] = shape->width[0];
    shape->narrow = shape->specular ? HUGE_VAL : 1 / fmin(shape->width[0], shape->width[1]);
    shape->wing = draw % 5 == 0 ? 0 : pow(10, 2 * random_even(state) - 0.5);
    for (int p = 0; p < LOBE_PHASES; p++)
        for (int j = 0; j < LOBE_ENDS; j++)
            shape->end[p][j] = draw % 3 == 0 ? HUGE_VAL : 30.0 * (p + 1) / (1 + j);
}

/* The limits are found from the worst lane of a tile, by bounds; the rule of a sample does not know
 * them. None may be missed, or lanes would depend on each other. */
START_TEST(test_solar_disc_watch_misses_no_sample_that_has_a_rule)
{
    static source_disc disc;
    uint64_t state = 7;
    int with_rule = 0;
    for (int draw = 0; draw < 20000; draw++) {
        lobe_shape shape;
        brdf_light light;
        brdf_watch watch;
        random_shape(draw, &state, &shape);
        random_lights(draw % 4 < 2, &state, &light, &disc);
        ck_assert(disc_watch_set(&shape, &light, &disc, &watch));
        for (int k = 0; k < BRDF_TILE; k++) {
            double normal[3], i[3], r[3];
            random_normal_to(&light, k, disc.scale[k], &state, normal);
            turn_pair(&light, k, normal, i, r);
            const disc_sample sample = {.shape = &shape, .disc = &disc, .lane = k};
            const int rule = disc_rule_of(&sample, i, r);
            if (rule == DISC_CENTRE) continue;
            with_rule++;
            ck_assert_msg(is_shown(&watch, k, i[2], r[2]),
                          "draw %d: rule %d at ci %.17g, cr %.17g is missed", draw, rule, i[2],
                          r[2]);
        }
    }
    ck_assert_int_ge(with_rule, 50000);
}
END_TEST

/* What is shown for nothing costs time: at a phase angle of 60 deg no more than a fourth of it. */
START_TEST(test_solar_disc_watch_shows_few_others)
{
    static const paint PAINTS[] = {{"lambert", {0.3}},
                                   {"ward-gmd", {0.1, 0.3, 0.2, 0.2, NONE, NONE}},
                                   {"ward-gmd", {0.1, 0.3, 0.05, 0.05, NONE, NONE}},
                                   {"ward-gmd", {0.1, 0.3, 0.01, 0.01, NONE, NONE}},
                                   {"phong", {0.1, 0.3, 30}},
                                   {"abg", {0.05, 1e-4, 1e-4, 2.5}}};
    static source_disc disc;
    bench *b = plate_of(&PAINTS[_i]);
    int shown = 0, with_rule = 0;
    for (int tile = 0; tile < 20000; tile++) {
        brdf_light light;
        brdf_watch watch;
        for (int k = 0; k < BRDF_TILE; k++) {
            double sun[3], observer[3];
            light_at(tile * BRDF_TILE + k, 60 * DEG, sun, observer);
            for (int j = 0; j < 3; j++)
                light.i[j][k] = sun[j], light.r[j][k] = observer[j];
            source_disc_set(&disc, k, SUN_Q);
        }
        brdf_light_finish(&light);
        ck_assert(disc_watch_set(b->model.shapes, &light, &disc, &watch));
        for (int k = 0; k < BRDF_TILE; k++) {
            double i[3], r[3];
            turn_pair(&light, k, (double[]){0, 0, 1}, i, r);
            const disc_sample sample = {.shape = b->model.shapes, .disc = &disc, .lane = k};
            with_rule += disc_rule_of(&sample, i, r) != DISC_CENTRE;
            shown += is_shown(&watch, k, i[2], r[2]);
        }
    }
    ck_assert_int_ge(with_rule, 1000);
    ck_assert_msg(shown <= 1.25 * with_rule, "%s: %d are shown, %d have a rule", PAINTS[_i].name,
                  shown, with_rule);
    bench_free(b);
}
END_TEST

/* --- closed forms --- */

/* Physics page, section 4: at the peak of a Gaussian lobe, normal incidence, the mean over a disc
 * of angular radius q is 4 a^2/q^2 (1 - exp(-q^2/(4 a^2))) of the point value; holds to q^2. */
START_TEST(test_solar_disc_dims_peak_of_gaussian_as_closed_form)
{
    static const double ALPHA[] = {3e-4, 1e-3, 0.003, 0.01, 0.03, 0.1, 0.3};
    static const double UP[3] = {0, 0, 1};
    for (int k = 0; k < 7; k++) {
        const double a = ALPHA[k], z = SUN_Q * SUN_Q / (4 * a * a);
        const paint p = {"ward", {0, 0.5, a, a, NONE, NONE}};
        bench *b = plate_of(&p);
        const double point = 0.5 / (4 * PI * a * a);
        assert_rel(sum_of(b, UP, UP, SUN_Q, false), point * -expm1(-z) / z, 5e-4);
        bench_free(b);
    }
}
END_TEST

START_TEST(test_solar_disc_of_vanishing_radius_is_a_point)
{
    const paint p = {"ward", {0.1, 0.5, 0.02, 0.02, NONE, NONE}};
    bench *b = plate_of(&p);
    for (int k = 0; k < 50; k++) {
        const double theta = 0.02 * k, sun[3] = {sin(theta), 0, cos(theta)};
        const double observer[3] = {-sin(0.5), 0.02, sqrt(cos(0.5) * cos(0.5) - 4e-4)};
        const double point = brdf_material_eval(&b->material, sun, observer);
        assert_rel(sum_of(b, sun, observer, 1e-9, false), point, 1e-9);
        assert_rel(sum_of(b, sun, observer, 0, false), point, 1e-13);
    }
    bench_free(b);
}
END_TEST

/* A Lambert plate while the Sun's uniform disc sets: the mean of max(0, i.n). With the centre at
 * the elevation x q, |x| <= 1 and q small, that is q/pi [sqrt(1 - x^2)(2 + x^2)/3 + x (pi/2 + asin
 * x)]. */
START_TEST(test_solar_disc_sets_behind_a_lambert_plate_as_closed_form)
{
    const paint p = {"lambert", {1}};
    bench *b = plate_of(&p);
    const double observer[3] = {0, sin(0.7), cos(0.7)};
    for (int k = -9; k <= 10; k++) {
        const double x = 0.1 * k, e = x * SUN_Q, sun[3] = {cos(e), 0, sin(e)};
        const double mean =
            SUN_Q / PI * (sqrt(fmax(1 - x * x, 0)) * (2 + x * x) / 3 + x * (PI / 2 + asin(x)));
        assert_rel(sum_of(b, sun, observer, SUN_Q, false), mean * cos(0.7) / PI, 3e-4);
    }
    const double set[3] = {cos(1.01 * SUN_Q), 0, -sin(1.01 * SUN_Q)};
    ck_assert(sum_of(b, set, observer, SUN_Q, false) == 0);
    bench_free(b);
}
END_TEST

/* --- mirrors --- */

/* A mirror plate of 1.88 x 0.86 m, R 0.9, 40 deg, 1000 km, the Sun at 1 au: physics page, section 4
 * and the numbers of its check. */
START_TEST(test_solar_disc_in_a_mirror_is_its_image)
{
    primitive_spec spec = shape("plate");
    SET(&spec, "size_m", 1.88, 0.86);
    SET(&spec, "normal", 0, 0, 1);
    SET(&spec, "tangent", 1, 0, 0);
    shape_material(&spec, "material", 0);
    const paint p = {"mirror", {0.9, NONE, NONE}};
    bench *b = bench_of(&spec, &p);
    const double theta = 40 * DEG, sun[3] = {sin(theta), 0, cos(theta)};
    const double q = asin(SUN_RADIUS_M / AU_M);
    for (int k = -12; k <= 12; k++) {
        const double off = 0.1 * k * q * (1 - 1e-9), up = theta + 0.6 * off;
        /* 0.6 and 0.8 of the way in and across the plane */
        const double observer[3] = {-sin(up) * cos(0.8 * off), sin(0.8 * off),
                                    cos(up) * cos(0.8 * off)};
        const double image[3] = {-sun[0], 0, sun[2]};
        const double r = tan(angle3(image, observer)) / tan(q), mu = sqrt(fmax(1 - r * r, 0));
        const double level = 1.640626496323961e-08 * 1e12 * observer[2] / cos(theta);
        const double uniform = sum_of(b, sun, observer, q, false);
        const double darkened = sum_of(b, sun, observer, q, true);
        if (r > 1) {
            ck_assert(uniform == 0 && darkened == 0);
            continue;
        }
        assert_rel(uniform, level, k ? 1e-9 : 1e-13);
        assert_rel(darkened, level * (1 - 0.6 * (1 - mu)) / 0.8, k ? 2e-5 : 1e-13);
    }
    bench_free(b);
}
END_TEST

/* Physics page, section 6: R r^2 / 4, whatever the attitude and the phase angle. */
START_TEST(test_solar_disc_in_a_mirror_sphere_is_a_quarter_of_its_square)
{
    primitive_spec spec = shape("sphere");
    SET(&spec, "radius_m", 1.5);
    SET(&spec, "facets", 320);
    shape_material(&spec, "material", 0);
    const paint p = {"mirror", {0.8, NONE, NONE}};
    bench *b = bench_of(&spec, &p);
    for (int k = 0; k < 300; k++) {
        double sun[3], observer[3];
        for (int j = 0; j < 3; j++) {
            sun[j] = sin(12.9898 * (k + 1) + 4.1 * j);
            observer[j] = sun[j] + 2.2 * (k % 7) / 7.0 * sin(78.233 * (k + 1) + 1.7 * j);
        }
        unit3(sun, sun), unit3(observer, observer);
        if (angle3(sun, observer) > 150 * DEG) continue;
        assert_rel(sum_of(b, sun, observer, SUN_Q, k % 2), 0.8 * 1.5 * 1.5 / 4, 1e-9);
    }
    bench_free(b);
}
END_TEST

/* A mirror cylinder, side only, against the integral of the flat mirror's closed form over its
 * normals. */
START_TEST(test_solar_disc_in_a_mirror_cylinder_is_its_integral)
{
    enum { N = 2000000 };
    primitive_spec spec = shape("cylinder");
    SET(&spec, "radius_m", 0.5);
    SET(&spec, "length_m", 2);
    SET(&spec, "axis", 0, 0, 1);
    shape_material(&spec, "material", 0);
    SET(&spec, "open", 1);
    const paint p = {"mirror", {1, NONE, NONE}};
    bench *b = bench_of(&spec, &p);
    for (int c = 0; c < 6; c++) {
        const double up = 0.3, sun[3] = {cos(up), 0, sin(up)};
        const double down = up + (c - 2.5) * 0.35 * SUN_Q, turn = 0.7 + 0.11 * c;
        const double observer[3] = {cos(down) * cos(turn), cos(down) * sin(turn), -sin(down)};
        double want = 0;
        for (int k = 0; k < N; k++) { /* normals within 0.01 rad of the bisector */
            const double at = 0.5 * turn + 0.02 * ((k + 0.5) / N - 0.5);
            const double n[3] = {cos(at), sin(at), 0}, cr = dot3(n, observer);
            double image[3];
            for (int j = 0; j < 3; j++)
                image[j] = 2 * cr * n[j] - observer[j];
            if (angle3(image, sun) <= SUN_Q)
                want += cr * 0.5 * 2 * 0.02 / N / (PI * sin(SUN_Q) * sin(SUN_Q));
        }
        assert_rel(sum_of(b, sun, observer, SUN_Q, false), want, 0.005);
    }
    bench_free(b);
}
END_TEST

int main(void)
{
    TCase *brute_force = tcase_create("brute force");
    tcase_set_timeout(brute_force, 120);
    tcase_add_loop_test(brute_force, test_solar_disc_blurs_gaussian_lobes_as_brute_force_does, 0,
                        2);
    tcase_add_loop_test(brute_force, test_solar_disc_finds_narrow_lobes_at_grazing_incidence, 0, 4);
    tcase_add_loop_test(brute_force, test_solar_disc_blurs_every_kind_of_lobe_as_brute_force_does,
                        0, 17);
    tcase_add_loop_test(brute_force, test_solar_disc_blurs_lobes_to_their_ends_as_brute_force_does,
                        0, 8);
    Suite *suite = suite_create("solar_disc");
    TCase *watch = tcase_create("watch");
    tcase_set_timeout(watch, 120);
    tcase_add_test(watch, test_solar_disc_watch_misses_no_sample_that_has_a_rule);
    tcase_add_loop_test(watch, test_solar_disc_watch_shows_few_others, 0, 6);
    TCase *closed = tcase_create("closed forms");
    tcase_add_test(closed, test_solar_disc_dims_peak_of_gaussian_as_closed_form);
    tcase_add_test(closed, test_solar_disc_of_vanishing_radius_is_a_point);
    tcase_add_test(closed, test_solar_disc_sets_behind_a_lambert_plate_as_closed_form);
    TCase *mirrors = tcase_create("mirrors");
    tcase_set_timeout(mirrors, 120);
    tcase_add_test(mirrors, test_solar_disc_in_a_mirror_is_its_image);
    tcase_add_test(mirrors, test_solar_disc_in_a_mirror_sphere_is_a_quarter_of_its_square);
    tcase_add_test(mirrors, test_solar_disc_in_a_mirror_cylinder_is_its_integral);
    suite_add_tcase(suite, brute_force);
    suite_add_tcase(suite, watch);
    suite_add_tcase(suite, closed);
    suite_add_tcase(suite, mirrors);
    return run_suite(suite);
}
