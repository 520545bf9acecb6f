/* Light that comes by way of a lit globe: held against closed forms, and against brute-force sums
 * over its ground with scalar BRDFs, which know nothing of rings, terminators and lobes. */
#include "bench.h"

#include "facets/globe.h"

#define EARTH_KM 6378.137 /* physics page, section 8 */

/* --- the globe over a bench --- */

/* A ground of one lobe. */
typedef struct soil {
    brdf_lobe lobe;
    brdf_material material;
} soil;

static soil *soil_of(const paint *p)
{
    soil *s = calloc(1, sizeof *s);
    s->lobe = (brdf_lobe){.model = brdf_model_named(p->name), .weight = 1.0};
    memcpy(s->lobe.params, p->params, sizeof p->params);
    ck_assert_int_eq(s->lobe.model->prepare(s->lobe.params, s->lobe.coef, NULL), GLINT_OK);
    s->material = (brdf_material){1, &s->lobe};
    return s;
}

static const paint WHITE = {"lambert", {1}};

/* The satellite over +z of the frame of the views; the Sun `zenith` from there, towards `azimuth`. */
static globe_view view_of(double height_km, double zenith, double azimuth)
{
    return (globe_view){.up = {0, 0, 1},
                        .sun = {sin(zenith) * cos(azimuth), sin(zenith) * sin(azimuth), cos(zenith)},
                        .distance = 1 + height_km / EARTH_KM,
                        .irradiance = 1};
}

/* Rotation from the component's frame whose z is the plate's normal `n`. */
static void attitude_of(const double n[3], double out[9])
{
    double t[3], b[3];
    const double other[3] = {0.3, 0.5, -0.2};
    perp3(other, n, t);
    cross3(n, t, b);
    for (int j = 0; j < 3; j++)
        out[3 * j] = t[j], out[3 * j + 1] = b[j], out[3 * j + 2] = n[j];
}

/* m^2/sr of the bench, its z axis along `normal`, seen from `observer`, both in the view's frame, in
 * the one lane that is not dark; 0 in all others. */
static double shine(const bench *b, const soil *ground, int rings, const globe_view *view,
                    const double normal[3], const double observer[3])
{
    enum { LANE = 5 };
    globe *g;
    globe_scratch *scratch;
    visibility_pose poses[BRDF_TILE];
    brdf_light light;
    double r[3], *x = calloc((size_t)b->model.n_spans * BRDF_TILE, sizeof *x), sum = 0;
    ck_assert_int_eq(globe_make(&b->model, &ground->material, rings, &g, NULL), GLINT_OK);
    ck_assert_int_eq(globe_scratch_make(g, &scratch, NULL), GLINT_OK);
    memset(poses, 0, sizeof poses);
    attitude_of(normal, poses[LANE].body_component);
    mat_tvec(poses[LANE].body_component, observer, r);
    for (int k = 0; k < BRDF_TILE; k++)
        for (int j = 0; j < 3; j++)
            light.r[j][k] = light.i[j][k] = r[j];
    for (int k = 0; k < BRDF_TILE; k++)
        globe_look(g, scratch, k, k == LANE ? view : NULL, NULL);
    globe_sum(g, scratch, poses, &light, NULL, x);
    for (int s = 0; s < b->model.n_spans; s++)
        for (int k = 0; k < BRDF_TILE; k++) {
            if (k != LANE) ck_assert(x[s * BRDF_TILE + k] == 0.0);
            if (k == LANE) sum += x[s * BRDF_TILE + k];
        }
    free(x);
    globe_scratch_free(scratch);
    globe_free(g);
    return sum;
}

/* --- by brute force --- */

/* The same of a plate of 1 m^2, by a mesh of n x 2n pieces of ground that the satellite sees, equal
 * in area: irradiance of each from the inverse square of its distance. */
static double brute(const brdf_material *plate, const brdf_material *ground, const globe_view *view,
                    const double normal[3], const double observer[3], int n)
{
    const double d = view->distance, area = (1 - 1 / d) / n * TWO_PI / (2 * n);
    double frame[9], to_facet[9], r_facet[3], total = 0;
    attitude_of(normal, frame);
    mat_transpose(frame, to_facet);
    mat_vec(to_facet, observer, r_facet);
    for (int a = 0; a < n; a++)
        for (int k = 0; k < 2 * n; k++) {
            const double z = 1 - (a + 0.5) / n * (1 - 1 / d), s = sqrt(1 - z * z);
            const double psi = PI * (k + 0.5) / n;
            const double ground_up[3] = {s * cos(psi), s * sin(psi), z};
            if (!(dot3(ground_up, view->sun) > 0)) continue;
            double from[3], to[3], i_facet[3];
            for (int j = 0; j < 3; j++)
                to[j] = ground_up[j] - d * view->up[j];
            const double distance = unit3(to, to);
            mat_vec(to_facet, to, i_facet);
            if (!(i_facet[2] > 0)) continue;
            scale3(to, -1, from);
            double soil_frame[9], soil_to[9], i[3], r[3];
            attitude_of(ground_up, soil_frame);
            mat_transpose(soil_frame, soil_to);
            mat_vec(soil_to, view->sun, i);
            mat_vec(soil_to, from, r);
            total += brdf_material_eval(ground, i, r) * area / (distance * distance) *
                     brdf_material_eval(plate, i_facet, r_facet);
        }
    return total * view->irradiance;
}

/* --- closed forms --- */

static const double DOWN[3] = {0, 0, -1};

/* Physics page, section 8: a white Lambert globe under the Sun, a white plate that faces it: E/(a S)
 * at three heights; the plate's X is E rho/pi. */
START_TEST(test_globe_lights_a_nadir_plate_as_closed_form)
{
    static const double HEIGHT_KM[] = {550, 1200, 35786};
    static const double WANT[] = {0.8419490386, 0.6942040951, 0.0169155788};
    bench *b = plate_of(&WHITE);
    soil *ground = soil_of(&WHITE);
    for (int k = 0; k < 3; k++) {
        const globe_view view = view_of(HEIGHT_KM[k], 0, 0);
        for (int rings = 0; rings <= 96; rings += 48)
            assert_rel(shine(b, ground, rings, &view, DOWN, DOWN) * PI, WANT[k], 1e-9);
    }
    free(ground);
    bench_free(b);
}
END_TEST

START_TEST(test_globe_scratch)
{
    static const paint PAINTS[] = {{"lambert", {1}}, {"ward-gmd", {0.1, 0.4, 0.12, 0.12, NONE, NONE}}, {"ward-gmd", {0.1, 0.4, 0.072, 0.072, NONE, NONE}},
     {"ward-gmd", {0.1, 0.4, 0.06, 0.06, NONE, NONE}}, {"ward-gmd", {0.1, 0.4, 0.02, 0.02, NONE, NONE}}, {"ggx", {0, 0.5, 0.05, 0.05, 1.5, 0}}};
    static const double ZEN[] = {0, 0.5, 1.2, 1.5, 1.7, 1.9};
    static const double HEIGHT_KM[] = {300, 550, 35786};
    soil *ground = soil_of(&WHITE);
    for (int p = 0; p < 6; p++) {
        bench *b = plate_of(&PAINTS[p]);
        double worst[5] = {0}, worstb[5]={0};
        for (int h = 0; h < 3; h+=2)
        for (int z = 0; z < 6; z+=2) {
            const globe_view view = view_of(HEIGHT_KM[h], ZEN[z], 0.3);
            double face = 0;
            for (int t = 0; t < 12; t+=3) {
                const double tilt = t * 0.2, a = 1.0 + t;
                const double n[3] = {sin(tilt) * cos(a), sin(tilt) * sin(a), -cos(tilt)};
                double o[3] = {0.3 + 0.05 * t, 0.3, -0.7};
                add3(o, n, o); unit3(o, o);
                const double ref = shine(b, ground, 128, &view, n, o);
                if (t == 0) face = ref;
                if (face == 0) continue;
                static const int R[] = {0, 12, 24, 48, 64};
                for (int k = 0; k < 5; k++) {
                    const double off = fabs(shine(b, ground, R[k], &view, n, o) - ref);
                    worst[k] = fmax(worst[k], off / ref);
                    worstb[k] = fmax(worstb[k], off / face);
                }
            }
        }
        printf("%s %g:", PAINTS[p].name, PAINTS[p].params[2]);
        for (int k = 0; k < 5; k++) printf(" %.2e/%.2e", worst[k], worstb[k]);
        printf("\n");
        bench_free(b);
    }
    free(ground);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("globe");
    TCase *c = tcase_create("globe");
    tcase_set_timeout(c, 300);
    tcase_add_test(c, test_globe_lights_a_nadir_plate_as_closed_form);
    tcase_add_test(c, test_globe_scratch);
    suite_add_tcase(suite, c);
    return run_suite(suite);
}
