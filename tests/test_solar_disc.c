/* The Sun as a disc: held against brute-force quadrature over it with scalar BRDFs, which knows
 * nothing of lobes, and against closed forms. */
#include "shapes.h"

#define SUN_Q (0.2664531 * DEG) /* rad, angular radius at 1 au (physics page, section 4) */

/* A plate of 1 m^2 looking along z, of one material. */
typedef struct bench {
    brdf_lobe lobe;
    brdf_material material;
    model_material materials[1];
    model_component components[1];
    facet_list facets;
    model model;
} bench;

/* A material as its name and parameters; at[k] gets the slope, if it has one. */
typedef struct paint {
    const char *name;
    double params[6];
} paint;

#define NONE ((double)NAN) /* a parameter that is not given */

static bench *bench_of(primitive_spec *spec, const paint *p)
{
    bench *b = calloc(1, sizeof *b);
    b->lobe = (brdf_lobe){.model = brdf_model_named(p->name), .weight = 1.0};
    ck_assert_ptr_nonnull(b->lobe.model);
    for (int k = 0; k < b->lobe.model->n_params; k++)
        b->lobe.params[k] = p->params[k];
    ck_assert_int_eq(b->lobe.model->prepare(b->lobe.params, b->lobe.coef, NULL), GLINT_OK);
    b->material = (brdf_material){1, &b->lobe};
    b->materials[0] = (model_material){p->name, &b->material};
    b->components[0] = (model_component){"body"};
    shape_add(spec, 0, &b->facets);
    ck_assert_int_eq(
        model_compile(&b->facets, b->materials, 1, b->components, 1, 1, &b->model, NULL), GLINT_OK);
    return b;
}

static bench *plate_of(const paint *p)
{
    primitive_spec spec = shape("plate");
    SET(&spec, "size_m", 1, 1);
    SET(&spec, "normal", 0, 0, 1);
    SET(&spec, "tangent", 1, 0, 0);
    shape_material(&spec, "material", 0);
    return bench_of(&spec, p);
}

static void bench_free(bench *b)
{
    model_free(&b->model);
    free(b);
}

/* What the model sees of one pair, m^2/sr; every lane must say the same. */
static double sum_of(const bench *b, const double sun[3], const double observer[3], double q,
                     bool limb_darkened)
{
    brdf_light light;
    source_disc disc = {.limb_darkened = limb_darkened};
    double x[BRDF_TILE];
    for (int k = 0; k < BRDF_TILE; k++) {
        disc.radius[k] = q;
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

/* The mean of g over the disc by brute force: a square grid of points over it, its spacing `step`
 * in radii. */
static double brute(const brdf_material *m, const double sun[3], const double observer[3], double q,
                    bool limb_darkened, int n_across)
{
    double e1[3], e2[3], total = 0, weights = 0;
    const double other[3] = {0.3, -0.7, 0.2}, step = 2.0 / n_across;
    perp3(other, sun, e1);
    cross3(sun, e1, e2);
    for (int a = 0; a < n_across; a++)
        for (int b = 0; b < n_across; b++) {
            const double x = -1 + (a + 0.5) * step, y = -1 + (b + 0.5) * step, s = x * x + y * y;
            if (s > 1) continue;
            double i[3];
            for (int j = 0; j < 3; j++)
                i[j] = sun[j] + tan(q) * (x * e1[j] + y * e2[j]);
            unit3(i, i);
            const double weight = limb_darkened ? 1 - 0.6 * (1 - sqrt(1 - s)) : 1;
            weights += weight;
            total += weight * brdf_material_eval(m, i, observer);
        }
    return total / weights;
}

static int argc; static char **argv;
START_TEST(scratch)
{
    const double alphas[] = {1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5};
    const double incs[] = {0, 20, 40, 60, 75, 80};
    const char *names[] = {"ward-gmd", "ward-gmd", "ward-duer"};
    for (int limb = 0; limb < 2; limb++)
    for (int nm = 0; nm < 1; nm++)
    for (int a = 0; a < 10; a++) {
        double worst = 0, wi = 0, wo = 0, wp = 0;
        paint p = {names[nm], {0, 0.5, alphas[a], alphas[a] * (argc > 1 ? atof(argv[1]) : 1), NONE, NONE}};
        bench *b = plate_of(&p);
        for (int c = 0; c < 6; c++)
            for (int o = 0; o < 7; o++)
                for (int ph = 0; ph < 2; ph++) {
                    const double off[] = {0, 0.6, 1.4, 2.6, 4, 0.5, 1.0};
                    double tilt = (o < 5 ? off[o] * alphas[a] * 0.7 : off[o] * SUN_Q);
                    const double th = incs[c] * DEG, az = 0.4;
                    double sun[3] = {sin(th) * cos(az), sin(th) * sin(az), cos(th)}, n[3] = {0, 0, 1};
                    double ax[3], obs[3];
                    /* normal tilted, then mirror */
                    double t1 = ph ? az + PI / 2 : az;
                    n[0] = sin(tilt) * cos(t1), n[1] = sin(tilt) * sin(t1), n[2] = cos(tilt);
                    (void)ax;
                    double d = dot3(sun, n);
                    for (int j = 0; j < 3; j++) obs[j] = 2 * d * n[j] - sun[j];
                    if (obs[2] < 0.05) continue;
                    int na = alphas[a] < 2e-4 ? 3000 : alphas[a] < 2e-3 ? 1200 : 360;
                    if (argc > 2) na *= atoi(argv[2]);
                    double want = brute(&b->material, sun, obs, SUN_Q, limb, na);
                    double peak = brute(&b->material, (double[3]){0,0,1}, (double[3]){0,0,1}, SUN_Q, limb, 100);
                    if (want < 1e-4 * peak) continue;
                    double got = sum_of(b, sun, obs, SUN_Q, limb);
                    double e = 2.5 * log10(got / want);
                    if (fabs(e) > fabs(worst)) worst = e, wi = incs[c], wo = tilt / alphas[a] / .7, wp = ph;
                }
        printf("%d %s %g: worst %.2e mag at inc %g off %g plane %g\n", limb, names[nm], alphas[a], worst, wi, wo, wp);
        bench_free(b);
    }
}
END_TEST
int main(int c, char **v)
{ argc=c; argv=v; Suite *s = suite_create("x"); TCase *t = tcase_create("a"); tcase_add_test(t, scratch); tcase_set_timeout(t, 0); suite_add_tcase(s, t); SRunner *r = srunner_create(s); srunner_set_fork_status(r, CK_NOFORK); srunner_run_all(r, CK_NORMAL); }
