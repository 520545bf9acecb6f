/* test_fit.c: fits of BRDF models to measurements. What is expected is known beforehand: data are
 * made from parameters, or have a closed form, or were fitted elsewhere. */
#include "base/constants.h"
#include "base/vec.h"
#include "brdf/fit.h"
#include "scenario/scenario.h"
#include "testing.h"

#include <stdint.h>
#include <unistd.h>

/* ------------------------------------------------------------------ helpers */

static const fit_options usual = {.max_zenith_rad = 85.0 * DEG};

/* Measurements that grow as they are added. */
typedef struct series {
    measured_point *points;
    int n, room;
} series;

static void series_add(series *s, const measured_point *point)
{
    if (s->n == s->room) {
        s->room = s->room ? 2 * s->room : 64;
        s->points = realloc(s->points, (size_t)s->room * sizeof *s->points);
        ck_assert_ptr_nonnull(s->points);
    }
    s->points[s->n++] = *point;
}

static void set_direction(double theta_deg, double phi_deg, double out[3])
{
    out[0] = sin(theta_deg * DEG) * cos(phi_deg * DEG);
    out[1] = sin(theta_deg * DEG) * sin(phi_deg * DEG);
    out[2] = cos(theta_deg * DEG);
}

static void series_angles(series *s, double theta_i, double phi_i, double theta_r, double phi_r)
{
    measured_point point = {.f = 1.0};
    set_direction(theta_i, phi_i, point.i);
    set_direction(theta_r, phi_r, point.r);
    series_add(s, &point);
}

/* In and out of the plane of incidence; f is not set. */
static series hemisphere(void)
{
    static const double INCIDENCES[] = {2.0, 20.0, 41.0, 60.0, 72.0};
    series s = {0};
    for (int i = 0; i < 5; i++)
        for (int azimuth = 0; azimuth <= 180; azimuth += 30)
            for (int theta = 0; theta <= 80; theta += 4)
                series_angles(&s, INCIDENCES[i], 17.0 * i, theta, 17.0 * i + azimuth);
    return s;
}

/* In the plane of incidence, which holds the tangent. */
static series plane(void)
{
    static const double INCIDENCES[] = {5.0, 40.0, 60.0, 75.0};
    series s = {0};
    for (int i = 0; i < 4; i++)
        for (int theta = -84; theta <= 84; theta += 2)
            series_angles(&s, INCIDENCES[i], 180.0, abs(theta), theta < 0 ? 180.0 : 0.0);
    return s;
}

static fit_form form_of(const char *expression)
{
    fit_form form;
    glint_error error;
    const glint_status status = fit_form_read(expression, strlen(expression), &form, &error);
    ck_assert_msg(status == GLINT_OK, "%s: %s", expression, status ? error.message : "");
    return form;
}

static fit_result run(const char *expression, const series *s, const fit_options *options)
{
    const fit_form form = form_of(expression);
    fit_result result;
    glint_error error;
    const glint_status status = fit_run(&form, s->points, s->n, options, &result, &error);
    ck_assert_msg(status == GLINT_OK, "%s: %s", expression, status ? error.message : "");
    return result;
}

static int index_of(const brdf_model *brdf, const char *name)
{
    for (int j = 0; j < brdf->n_params; j++)
        if (strcmp(brdf->params[j].name, name) == 0) return j;
    return -1;
}

/* A parameter of the result by the lobe and its name. */
static const fit_param *param_of(const fit_result *r, int lobe, const char *name)
{
    const int index = index_of(r->form.lobes[lobe], name);
    for (int k = 0; k < r->n_params; k++)
        if (r->params[k].lobe == lobe && r->params[k].index == index) return &r->params[k];
    ck_abort_msg("lobe %d has no parameter '%s'", lobe, name);
    return NULL;
}

/* Uniform in 0..1, the same sequence on every machine (Knuth's MMIX generator). */
static double next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Normal with variance 1 (Box and Muller). */
static double next_normal(uint64_t *state)
{
    const double u = 1.0 - next_random(state), v = next_random(state);
    return sqrt(-2.0 * log(u)) * cos(TWO_PI * v);
}

/* ------------------------------------------------------- materials as truth */

/* What the parameters of lobes are in these tests. */
typedef struct truth {
    const char *model, *name; /* model NULL: of all */
    double value;
} truth;

static const truth truths[] = {
    {"phong", "n", 40.0},    {"minnaert", "k", 0.8},    {NULL, "rho", 0.3},
    {NULL, "rho_d", 0.1},    {NULL, "rho_s", 0.3},      {NULL, "alpha_x", 0.15},
    {NULL, "alpha_y", 0.15}, {NULL, "sigma_deg", 25.0}, {NULL, "R_d", 0.2},
    {NULL, "R_s", 0.4},      {NULL, "n_u", 90.0},       {NULL, "n_v", 90.0},
    {NULL, "s", 0.5},        {NULL, "m", 0.2},          {NULL, "n", 1.6},
    {NULL, "k_b", 0.4},      {NULL, "k_r", 0.2},        {NULL, "k_d", 0.05},
    {NULL, "a", 1.3},        {NULL, "b", 0.3},          {NULL, "A", 0.01},
    {NULL, "B", 1e-4},       {NULL, "g", 2.2},          {NULL, "w", 0.6},
    {NULL, "B0", 0.8},       {NULL, "h", 0.1},
};

/* The value in the list, the default, or some value in the range for models that are new. */
static double true_value(const brdf_model *brdf, const param_info *p)
{
    for (size_t k = 0; k < sizeof truths / sizeof truths[0]; k++)
        if ((!truths[k].model || strcmp(truths[k].model, brdf->name) == 0) &&
            strcmp(truths[k].name, p->name) == 0 && !isfinite(p->def) &&
            !(p->flags & PARAM_OPTIONAL))
            return truths[k].value;
    if (isfinite(p->def) || p->flags & PARAM_OPTIONAL) return p->def;
    return p->min > 0.0 ? p->min * pow(p->max / p->min, 0.7) : 0.7 * p->min + 0.3 * p->max;
}

/* Sets f of every point to that of the lobes, and drops points where it is 0. */
static void series_make(series *s, const brdf_lobe *lobes, int n_lobes)
{
    int kept = 0;
    for (int k = 0; k < s->n; k++) {
        measured_point *point = &s->points[k];
        point->f = 0.0;
        for (int j = 0; j < n_lobes; j++) {
            const double g = lobes[j].model->eval(lobes[j].coef, point->i, point->r);
            point->f += g / (point->i[2] * point->r[2]);
        }
        if (point->f > 0.0) s->points[kept++] = *point;
    }
    s->n = kept;
}

static brdf_lobe true_lobe(const brdf_model *brdf)
{
    brdf_lobe lobe = {.model = brdf, .weight = 1.0};
    for (int j = 0; j < brdf->n_params; j++)
        lobe.params[j] = true_value(brdf, &brdf->params[j]);
    ck_assert_int_eq(brdf->prepare(lobe.params, lobe.coef, NULL), GLINT_OK);
    return lobe;
}

/* A lobe with the parameters that are given by name, pairs that end with NULL. */
static brdf_lobe lobe_with(const char *name, const truth *given)
{
    brdf_lobe lobe = {.model = brdf_model_named(name), .weight = 1.0};
    for (int j = 0; j < lobe.model->n_params; j++)
        lobe.params[j] = lobe.model->params[j].def;
    for (; given->name; given++)
        lobe.params[index_of(lobe.model, given->name)] = given->value;
    ck_assert_int_eq(lobe.model->prepare(lobe.params, lobe.coef, NULL), GLINT_OK);
    return lobe;
}
#define LOBE(name, ...) lobe_with(name, (const truth[]){__VA_ARGS__, {NULL, NULL, 0}})

/* ----------------------------------------------------------------- recovery */

static bool is_fitted_here(const brdf_model *brdf)
{
    return fit_takes(brdf) && brdf->n_params <= 6;
}

START_TEST(test_fit_recovers_parameters_of_every_model_without_noise)
{
    for (size_t m = 0; brdf_model_at(m); m++) {
        const brdf_model *brdf = brdf_model_at(m);
        if (!is_fitted_here(brdf)) continue;
        const brdf_lobe lobe = true_lobe(brdf);
        series s = hemisphere();
        series_make(&s, &lobe, 1);
        fit_result r = run(brdf->name, &s, &usual);
        ck_assert_msg(r.rms_dex <= 1e-6, "%s: rms %g dex", brdf->name, r.rms_dex);
        for (int k = 0; k < r.n_params; k++) {
            const fit_param *p = &r.params[k];
            const double want = lobe.params[p->index];
            ck_assert_msg(p->state != FIT_UNDETERMINED && is_near(p->value, want, 1e-8 * want),
                          "%s, %s: %.12g (state %d); expected %.12g to 1e-8", brdf->name,
                          brdf->params[p->index].name, p->value, p->state, want);
        }
        fit_result_free(&r);
        free(s.points);
    }
}
END_TEST

START_TEST(test_fit_recovers_both_slopes_when_anisotropic)
{
    static const char *const names[] = {"ward", "ward-duer", "ward-gmd", "ggx"};
    const fit_options options = {.max_zenith_rad = 85.0 * DEG, .anisotropic = true};
    for (int m = 0; m < 4; m++) {
        brdf_lobe lobe = true_lobe(brdf_model_named(names[m]));
        lobe.params[index_of(lobe.model, "alpha_y")] = 0.06;
        ck_assert_int_eq(lobe.model->prepare(lobe.params, lobe.coef, NULL), GLINT_OK);
        series s = hemisphere();
        series_make(&s, &lobe, 1);
        fit_result r = run(names[m], &s, &options);
        assert_rel(param_of(&r, 0, "alpha_x")->value, 0.15, 1e-6);
        assert_rel(param_of(&r, 0, "alpha_y")->value, 0.06, 1e-6);
        fit_result_free(&r);
        free(s.points);
    }
}
END_TEST

/* The lobes come out in the order of their widths, whichever was found first. */
START_TEST(test_fit_recovers_sums_of_lobes)
{
    const brdf_lobe lobes[] = {LOBE("lambert", {NULL, "rho", 0.05}),
                               LOBE("ward-gmd", {NULL, "rho_d", 0.0}, {NULL, "rho_s", 0.12},
                                    {NULL, "alpha_x", 0.3}, {NULL, "alpha_y", 0.3}),
                               LOBE("ward-gmd", {NULL, "rho_d", 0.0}, {NULL, "rho_s", 0.25},
                                    {NULL, "alpha_x", 0.04}, {NULL, "alpha_y", 0.04})};
    series s = plane();
    series_make(&s, lobes, 3);
    fit_result r = run("lambert + 2*ward-gmd", &s, &usual);
    ck_assert_double_le(r.rms_dex, 1e-6);
    assert_rel(param_of(&r, 0, "rho")->value, 0.05, 1e-6);
    assert_rel(param_of(&r, 1, "alpha_x")->value, 0.04, 1e-6);
    assert_rel(param_of(&r, 1, "rho_s")->value, 0.25, 1e-6);
    assert_rel(param_of(&r, 2, "alpha_x")->value, 0.3, 1e-6);
    assert_rel(param_of(&r, 2, "rho_s")->value, 0.12, 1e-6);
    ck_assert_int_eq(r.n_free, 5);
    fit_result_free(&r);
    free(s.points);
}
END_TEST

/* ------------------------------------------------------------ closed forms */

/* Least squares in ln f have the mean of ln f as the solution for one strength. */
START_TEST(test_fit_of_one_strength_has_its_closed_form)
{
    series s = plane();
    uint64_t state = 7;
    double sum = 0.0, squares = 0.0;
    for (int k = 0; k < s.n; k++) {
        s.points[k].f = 0.1 * exp(0.3 * next_normal(&state));
        sum += log(s.points[k].f);
    }
    for (int k = 0; k < s.n; k++)
        squares += pow(log(s.points[k].f) - sum / s.n, 2.0);
    const double rho = PI * exp(sum / s.n), spread = sqrt(squares / (s.n - 1));
    fit_result r = run("lambert", &s, &usual);
    const fit_param *p = param_of(&r, 0, "rho");
    const double want_error = rho * spread / sqrt(s.n);
    assert_near(p->value, rho, 0.01 * want_error); /* a hundredth is what rounding may take */
    assert_rel(p->standard_error, want_error, 1e-6);
    assert_rel(r.rms_dex, sqrt(squares / s.n) / log(10.0), 1e-6); /* flat at the minimum */
    assert_rel(r.aic, s.n * log(squares / s.n / pow(log(10.0), 2.0)) + 4.0, 1e-6);
    assert_rel(r.bic - r.aic, 2.0 * log(s.n) - 4.0, 1e-9);
    ck_assert_int_eq(r.n_points, s.n);
    fit_result_free(&r);
    free(s.points);
}
END_TEST

/* Over many realisations of the noise (error / standard error)^2 has the mean 1. */
START_TEST(test_fit_standard_errors_are_those_of_the_noise)
{
    enum { N_SEEDS = 40, N_NAMES = 3 };
    static const char *const names[N_NAMES] = {"rho_d", "rho_s", "alpha_x"};
    const brdf_lobe lobe = true_lobe(brdf_model_named("ward-gmd"));
    double total[N_NAMES] = {0};
    for (uint64_t seed = 1; seed <= N_SEEDS; seed++) {
        uint64_t state = seed;
        series s = plane();
        series_make(&s, &lobe, 1);
        for (int k = 0; k < s.n; k++)
            s.points[k].f *= exp(0.1 * next_normal(&state));
        fit_result r = run("ward-gmd", &s, &usual);
        for (int j = 0; j < N_NAMES; j++) {
            const fit_param *p = param_of(&r, 0, names[j]);
            const double z = (p->value - lobe.params[p->index]) / p->standard_error;
            ck_assert_int_eq(p->state, FIT_DETERMINED);
            assert_near(z, 0.0, 4.0); /* of 120 normal numbers none: odds of 1 in 130 */
            total[j] += z * z;
        }
        fit_result_free(&r);
        free(s.points);
    }
    /* chi^2 with 40 degrees of freedom: within 3.3 standard deviations, sqrt(2/40) each */
    for (int j = 0; j < N_NAMES; j++)
        assert_near(total[j] / N_SEEDS, 1.0, 0.75);
}
END_TEST

/* Rounding the parameters must not move the fit: the rms stays that of the minimum. */
START_TEST(test_fit_rounds_parameters_without_harm)
{
    const brdf_lobe lobe = true_lobe(brdf_model_named("abg"));
    series s = plane();
    series_make(&s, &lobe, 1);
    uint64_t state = 3;
    for (int k = 0; k < s.n; k++)
        s.points[k].f *= exp(0.2 * next_normal(&state));
    fit_result r = run("abg", &s, &usual);
    for (int k = 0; k < r.n_params; k++) {
        char shown[NUMBER_SIZE + 1] = "";
        number_format(r.params[k].value, shown);
        ck_assert_msg(strlen(shown) <= 12, "%s has more digits than can be told", shown);
    }
    /* a step of each parameter by a tenth of its error makes it worse, or by less than rounding */
    for (int k = 0; k < r.n_params; k++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            brdf_lobe moved = r.material.lobes[0];
            moved.params[r.params[k].index] += 0.1 * sign * r.params[k].standard_error;
            ck_assert_int_eq(moved.model->prepare(moved.params, moved.coef, NULL), GLINT_OK);
            const brdf_material material = {.n_lobes = 1, .lobes = &moved};
            ck_assert_double_ge(fit_rms_dex(&material, s.points, s.n, &usual), r.rms_dex);
        }
    }
    fit_result_free(&r);
    free(s.points);
}
END_TEST

/* ------------------------------------------------------------------- states */

START_TEST(test_fit_puts_diffuse_light_into_one_term)
{
    series s = plane();
    const brdf_lobe lobe = true_lobe(brdf_model_named("ward"));
    series_make(&s, &lobe, 1);
    fit_result r = run("lambert+ward", &s, &usual);
    ck_assert_int_eq(param_of(&r, 1, "rho_d")->state, FIT_FIXED);
    ck_assert(param_of(&r, 1, "rho_d")->value == 0.0);
    assert_rel(param_of(&r, 0, "rho")->value, 0.1, 1e-6);
    ck_assert_int_eq(r.n_free, 3);
    fit_result_free(&r);
    r = run("ward+phong", &s, &usual);
    ck_assert_int_ne(param_of(&r, 0, "rho_d")->state, FIT_FIXED);
    ck_assert_int_eq(param_of(&r, 1, "rho_d")->state, FIT_FIXED);
    fit_result_free(&r);
    free(s.points);
}
END_TEST

START_TEST(test_fit_says_what_is_at_the_end_of_its_range)
{
    series s = plane();
    const brdf_lobe lobe =
        LOBE("phong", {NULL, "rho_d", 0.0}, {NULL, "rho_s", 0.3}, {NULL, "n", 2.0});
    series_make(&s, &lobe, 1);
    fit_result r = run("phong", &s, &usual);
    const fit_param *p = param_of(&r, 0, "rho_d");
    ck_assert_int_eq(p->state, FIT_AT_BOUND);
    ck_assert(p->value == 0.0 && p->standard_error == 0.0);
    assert_rel(param_of(&r, 0, "n")->value, 2.0, 1e-6);
    fit_result_free(&r);
    for (int k = 0; k < s.n; k++)
        s.points[k].f = 0.5; /* a reflectance of 1.6 */
    r = run("lambert", &s, &usual);
    ck_assert_int_eq(param_of(&r, 0, "rho")->state, FIT_AT_BOUND);
    ck_assert(param_of(&r, 0, "rho")->value == 1.0);
    assert_near(r.rms_dex, log10(0.5 * PI), 1e-12);
    fit_result_free(&r);
    free(s.points);
}
END_TEST

/* In the plane of the tangent only rho_s / alpha_y can be told. */
START_TEST(test_fit_says_what_is_undetermined)
{
    const fit_options options = {.max_zenith_rad = 85.0 * DEG, .anisotropic = true};
    const brdf_lobe lobe = true_lobe(brdf_model_named("ward-gmd"));
    series s = plane();
    series_make(&s, &lobe, 1);
    fit_result r = run("ward-gmd", &s, &options);
    ck_assert_double_le(r.rms_dex, 1e-6);
    ck_assert_int_eq(param_of(&r, 0, "alpha_y")->state, FIT_UNDETERMINED);
    ck_assert_int_eq(param_of(&r, 0, "rho_s")->state, FIT_UNDETERMINED);
    ck_assert_int_eq(param_of(&r, 0, "alpha_x")->state, FIT_DETERMINED);
    assert_rel(param_of(&r, 0, "alpha_x")->value, 0.15, 1e-6);
    assert_rel(param_of(&r, 0, "rho_s")->value / param_of(&r, 0, "alpha_y")->value, 2.0, 1e-6);
    fit_result_free(&r);
    free(s.points);
}
END_TEST

/* ----------------------------------------------------------- what is fitted */

START_TEST(test_fit_leaves_out_what_no_model_can_tell)
{
    series s = plane();
    for (int k = 0; k < s.n; k++)
        s.points[k].f = 0.2 / PI;
    const int n = s.n;
    series_angles(&s, 30.0, 180.0, 90.0, 0.0); /* edge-on */
    series_angles(&s, 30.0, 180.0, 85.5, 0.0); /* past the limit */
    series_angles(&s, 30.0, 180.0, 85.0, 0.0); /* on it */
    series_angles(&s, 85.5, 180.0, 30.0, 0.0);
    series_angles(&s, 30.0, 180.0, 30.0, 0.0);
    s.points[n + 2].f = 0.2 / PI;
    s.points[n + 4].f = NAN;
    series_add(&s, &(measured_point){.i = {0, 0, 1}, .r = {0, 0, 1}, .f = 0.0});
    series_add(&s, &(measured_point){.i = {0, 0, 1}, .r = {0, 0, 1}, .f = INFINITY});
    fit_result r = run("lambert", &s, &usual);
    ck_assert_int_eq(r.n_points, n + 1);
    assert_rel(param_of(&r, 0, "rho")->value, 0.2, 1e-6);
    ck_assert_double_le(r.rms_dex, 1e-6);
    fit_result_free(&r);
    free(s.points);
}
END_TEST

START_TEST(test_fit_refuses_fewer_measurements_than_it_needs)
{
    series s = {0};
    glint_error error = {0};
    fit_result r;
    const fit_form form = form_of("ward");
    for (int k = 0; k < 3; k++)
        series_angles(&s, 10.0, 180.0, 20.0 * k, 0.0);
    ck_assert_int_eq(fit_run(&form, s.points, 3, &usual, &r, &error), GLINT_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "3 usable measurements cannot tell 3 parameters"));
    ck_assert_ptr_null(r.material.lobes);
    fit_result_free(&r);
    ck_assert_int_eq(fit_run(&form, NULL, 0, &usual, &r, NULL), GLINT_INPUT);
    free(s.points);
}
END_TEST

/* The value is in its range, and nothing is a NaN. */
static void assert_sane(const fit_result *r, const char *what)
{
    ck_assert_msg(isfinite(r->rms_dex) && r->rms_dex >= 0.0 && isfinite(r->aic) && isfinite(r->bic),
                  "%s: rms %g, AIC %g, BIC %g", what, r->rms_dex, r->aic, r->bic);
    for (int k = 0; k < r->n_params; k++) {
        const fit_param *p = &r->params[k];
        const param_info *info = &r->form.lobes[p->lobe]->params[p->index];
        ck_assert_msg(param_accepts(info, p->value) && isfinite(p->standard_error) &&
                          p->standard_error >= 0.0,
                      "%s: %s = %g +- %g", what, info->name, p->value, p->standard_error);
    }
}

/* Data that no surface gives: each is fitted by every model. */
static void make_silly(series *s, int kind)
{
    uint64_t state = 11;
    for (int k = 0; k < s->n; k++) {
        double *f = &s->points[k].f;
        if (kind == 0) *f = 0.1;
        if (kind == 1) *f = pow(10.0, 600.0 * next_random(&state) - 300.0);
        if (kind == 2) *f = 1e300;
        if (kind == 3) *f = 1e-305;
        if (kind == 4) *f = k == 17 ? 1e200 : 1e-200;
        if (kind == 5) s->points[k] = s->points[0]; /* one direction */
    }
    if (kind == 6) s->n = 7;
}

START_TEST(test_fit_survives_silly_measurements)
{
    for (int kind = 0; kind <= 6; kind++) {
        for (size_t m = 0; brdf_model_at(m); m++) {
            if (!is_fitted_here(brdf_model_at(m))) continue;
            series s = plane();
            s.n = s.n > 60 ? 60 : s.n;
            make_silly(&s, kind);
            char what[64];
            snprintf(what, sizeof what, "%s, kind %d", brdf_model_at(m)->name, kind);
            fit_result r = run(brdf_model_at(m)->name, &s, &usual);
            assert_sane(&r, what);
            fit_result_free(&r);
            free(s.points);
        }
    }
}
END_TEST

START_TEST(test_fit_gives_the_same_twice)
{
    series s = plane();
    uint64_t state = 5;
    for (int k = 0; k < s.n; k++)
        s.points[k].f = exp(2.0 * next_normal(&state));
    fit_result a = run("lambert+2*ward-gmd", &s, &usual), b = run("lambert+2*ward-gmd", &s, &usual);
    ck_assert(brdf_material_same(&a.material, &b.material) && a.rms_dex == b.rms_dex);
    fit_result_free(&a);
    fit_result_free(&b);
    free(s.points);
}
END_TEST

/* -------------------------------------------------------------- expressions */

START_TEST(test_fit_form_reads_what_it_writes)
{
    static const char *const expressions[][2] = {
        {"ward", "ward"},
        {"lambert+2*ward-gmd", "lambert+2*ward-gmd"},
        {" 2 * abg + lambert ", "2*abg+lambert"},
        {"ward+ward+phong+ward", "2*ward+phong+ward"},
        {"8*ward-gmd", "8*ward-gmd"},
    };
    for (size_t k = 0; k < sizeof expressions / sizeof expressions[0]; k++) {
        const fit_form form = form_of(expressions[k][0]);
        text t = {0};
        fit_form_write(&form, &t);
        ck_assert_str_eq(t.data, expressions[k][1]);
        text_free(&t);
    }
}
END_TEST

START_TEST(test_fit_form_refuses_what_is_no_sum)
{
    static const char *const wrong[][2] = {
        {"", "a term of the sum is empty"},
        {"ward+", "a term of the sum is empty"},
        {"+ward", "a term of the sum is empty"},
        {"2*", "a term of the sum is empty"},
        {"wrad", "did you mean 'ward'?"},
        {"ward gmd", "there is no BRDF 'ward gmd'"},
        {"0*ward", "expected N*NAME"},
        {"9*ward", "expected N*NAME"},
        {"-1*ward", "expected N*NAME"},
        {"1.5*ward", "expected N*NAME"},
        {"two*ward", "expected N*NAME"},
        {"5*ward+4*ward", "more than 8 lobes"},
        {"2*lambert", "has 'lambert' twice"},
        {"lambert+ward+lambert", "has 'lambert' twice"},
        {"binomial", "'binomial' cannot be fitted: it takes more than single numbers"},
        {"lambert+table", "'table' cannot be fitted: it takes more than single numbers"},
        {"mirror", "'mirror' cannot be fitted: f is a delta function"},
    };
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
        fit_form form;
        glint_error error;
        ck_assert_int_eq(fit_form_read(wrong[k][0], strlen(wrong[k][0]), &form, &error),
                         GLINT_ARGUMENT);
        ck_assert_msg(strstr(error.message, wrong[k][1]), "'%s': %s", wrong[k][0], error.message);
    }
}
END_TEST

/* -------------------------------------------------------------- public face */

static char folder[] = "/tmp/glint-fit-XXXXXX";

static void make_folder(void)
{
    ck_assert_ptr_nonnull(mkdtemp(folder));
}

static void remove_folder(void)
{
    static const char *const names[] = {"data.csv", "o\"dd \xff\n.csv", "model.toml", "fit.svg"};
    for (int k = 0; k < 4; k++)
        unlink(path_in(folder, names[k]));
    rmdir(folder);
}

/* Writes the points of the plane as a file: theta_i, signed theta_r, f. Returns its path. */
static const char *write_data(const char *name, const series *s)
{
    const char *path = path_in(folder, name);
    FILE *file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    fprintf(file, "# made up\ntheta_i, theta_r, f\n");
    for (int k = 0; k < s->n; k++) {
        const measured_point *p = &s->points[k];
        fprintf(file, "%.17g,%.17g,%.17g\n", acos(p->i[2]) / DEG, atan2(p->r[0], p->r[2]) / DEG,
                p->f);
    }
    ck_assert_int_eq(fclose(file), 0);
    return path;
}

static series noisy_plane(void)
{
    series s = plane();
    const brdf_lobe lobe = true_lobe(brdf_model_named("ward-gmd"));
    series_make(&s, &lobe, 1);
    uint64_t state = 2;
    for (int k = 0; k < s.n; k++)
        s.points[k].f *= exp(0.1 * next_normal(&state));
    return s;
}

static glint_brdf_fits *fit_file(const char *path, const char *models)
{
    const glint_brdf_layout layout = {.columns = "theta_i=1,theta_r=2,f=3", .signed_zenith = true};
    glint_errors *errors = glint_errors_new();
    glint_brdf_fits *fits;
    const glint_status status = glint_brdf_fit(path, &layout, models, NULL, &fits, errors);
    const glint_error *first = glint_errors_get(errors, 0);
    ck_assert_msg(status == GLINT_OK, "%s", first ? first->message : "?");
    glint_errors_free(errors);
    return fits;
}

START_TEST(test_fits_are_ranked_by_their_misfit)
{
    series s = noisy_plane();
    glint_brdf_fits *fits = fit_file(write_data("data.csv", &s), "lambert,ward-gmd,phong");
    glint_brdf_fit_info info[3], past;
    for (size_t k = 0; k < 3; k++)
        ck_assert(glint_brdf_fits_get(fits, k, &info[k]));
    ck_assert(!glint_brdf_fits_get(fits, 3, &past));
    ck_assert_str_eq(info[0].model, "ward-gmd");
    ck_assert_str_eq(info[1].model, "phong");
    ck_assert_str_eq(info[2].model, "lambert");
    ck_assert_str_eq(info[0].material, "data");
    ck_assert_str_eq(info[2].material, "data-3");
    ck_assert(info[0].rms_dex < info[1].rms_dex && info[1].rms_dex < info[2].rms_dex);
    assert_near(info[0].rms_dex, 0.1 / log(10.0),
                0.005); /* dex: the noise; 3 sigma of 340 points */
    ck_assert_uint_eq(info[0].n_rows, (size_t)s.n);
    ck_assert_uint_eq(info[0].n_points, (size_t)s.n);
    ck_assert_uint_eq(info[2].n_free, 1);
    glint_brdf_fit_parameter p;
    ck_assert(glint_brdf_fits_parameter(fits, 2, 0, &p) &&
              !glint_brdf_fits_parameter(fits, 2, 1, &p));
    ck_assert_str_eq(p.name, "rho");
    ck_assert_int_eq(p.state, GLINT_FIT_DETERMINED);
    glint_brdf_fits_free(fits);
    free(s.points);
}
END_TEST

START_TEST(test_fits_show_each_measurement_beside_the_fit)
{
    series s = noisy_plane();
    glint_brdf_fits *fits = fit_file(write_data("data.csv", &s), "ward-gmd");
    glint_brdf_fit_info info;
    glint_brdf_fit_point point;
    ck_assert(glint_brdf_fits_get(fits, 0, &info));
    double squares = 0.0;
    size_t n = 0;
    for (; glint_brdf_fits_point(fits, 0, n, &point); n++) {
        ck_assert(point.used);
        squares += pow(log10(point.f_fitted / point.f_measured), 2.0);
        assert_rel(point.f_measured, s.points[n].f, 1e-15);
        assert_near(dot3(point.i, point.r), dot3(s.points[n].i, s.points[n].r), 1e-12);
    }
    ck_assert_uint_eq(n, info.n_points);
    assert_rel(info.rms_dex, sqrt(squares / (double)n), 1e-12);
    glint_brdf_fits_free(fits);
    free(s.points);
}
END_TEST

/* The material of that name in a model made of the text and one plate; its lobes stay valid with
 * *scenario. */
static const brdf_material *read_back(const char *toml, const char *name, glint_scenario **scenario)
{
    const char *path = path_in(folder, "model.toml");
    FILE *file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    fprintf(file,
            "%s\n[[component]]\nname = \"plate\"\n[[component.plate]]\nsize_m = [1, 1]\n"
            "normal = [0, 0, 1]\ntangent = [1, 0, 0]\nmaterial = \"%s\"\n",
            toml, name);
    ck_assert_int_eq(fclose(file), 0);
    glint_errors *errors = glint_errors_new();
    const glint_status status = scenario_read_model(path, NULL, 0, scenario, errors);
    const glint_error *first = glint_errors_get(errors, 0);
    ck_assert_msg(status == GLINT_OK, "%s", first ? first->message : "?");
    glint_errors_free(errors);
    const satellite *sat = &(*scenario)->satellite;
    for (int m = 0; m < sat->n_materials; m++)
        if (strcmp(sat->materials[m].name, name) == 0) return &sat->materials[m].bands[0];
    ck_abort_msg("no material '%s' came back", name);
    return NULL;
}

/* rms in dex of a material over all measurements of a fit. */
static double rms_again(const glint_brdf_fits *fits, size_t k, const brdf_material *material)
{
    glint_brdf_fit_point point;
    double squares = 0.0;
    int n = 0;
    for (size_t j = 0; glint_brdf_fits_point(fits, k, j, &point); j++) {
        if (!point.used) continue;
        const double g = brdf_material_eval(material, point.i, point.r);
        squares += pow(log10(g / (point.i[2] * point.r[2])) - log10(point.f_measured), 2.0);
        n++;
    }
    return sqrt(squares / n);
}

START_TEST(test_fits_toml_read_back_has_the_rms_that_is_said)
{
    series s = noisy_plane();
    glint_brdf_fits *fits =
        fit_file(write_data("data.csv", &s), "ward,lambert+2*ward-gmd,ggx,cook-torrance,lambert");
    char *toml;
    glint_brdf_fit_info info;
    ck_assert_int_eq(glint_brdf_fits_toml(fits, &toml, NULL), GLINT_OK);
    for (size_t k = 0; glint_brdf_fits_get(fits, k, &info); k++) {
        glint_scenario *scenario;
        const brdf_material *material = read_back(toml, info.material, &scenario);
        assert_rel(rms_again(fits, k, material), info.rms_dex, 1e-12);
        glint_scenario_free(scenario);
    }
    glint_free(toml);
    glint_brdf_fits_free(fits);
    free(s.points);
}
END_TEST

START_TEST(test_fits_toml_holds_any_file_name)
{
    series s = noisy_plane();
    glint_brdf_fits *fits = fit_file(write_data("o\"dd \xff\n.csv", &s), "lambert");
    char *toml;
    glint_brdf_fit_info info;
    glint_scenario *scenario;
    ck_assert(glint_brdf_fits_get(fits, 0, &info));
    ck_assert_str_eq(info.material, "o-dd---");
    ck_assert_int_eq(glint_brdf_fits_toml(fits, &toml, NULL), GLINT_OK);
    read_back(toml, info.material, &scenario);
    ck_assert_ptr_nonnull(strstr(scenario->satellite.materials[0].source, "o\"dd ?\n.csv: 340 m"));
    glint_scenario_free(scenario);
    glint_free(toml);
    glint_brdf_fits_free(fits);
    free(s.points);
}
END_TEST

/* The message of a call that must fail with that status. */
static void assert_refused(glint_status want, const char *part, const char *path,
                           const glint_brdf_layout *layout, const char *models,
                           const glint_brdf_fit_options *options)
{
    glint_errors *errors = glint_errors_new();
    glint_brdf_fits *fits;
    ck_assert_int_eq(glint_brdf_fit(path, layout, models, options, &fits, errors), want);
    ck_assert_ptr_null(fits);
    bool found = false;
    for (size_t k = 0; k < glint_errors_count(errors); k++)
        found = found || strstr(glint_errors_get(errors, k)->message, part);
    ck_assert_msg(found, "no message has '%s'", part);
    glint_errors_free(errors);
}

START_TEST(test_fits_refuse_wrong_arguments)
{
    static const char *const columns[][2] = {
        {"", "the columns have ''"},
        {"theta_i", "the columns have 'theta_i'"},
        {"theta_i=1,theta_i=2", "'theta_i' twice"},
        {"zenith=1", "the columns have 'zenith=1'"},
        {"theta_i=", "the columns have 'theta_i='"},
        {"theta_i=0", "count from 1"},
        {"theta_i=1,", "the columns have ''"},
    };
    series s = noisy_plane();
    char path[1024];
    snprintf(path, sizeof path, "%s", write_data("data.csv", &s));
    const glint_brdf_layout good = {.signed_zenith = true};
    for (size_t k = 0; k < sizeof columns / sizeof columns[0]; k++) {
        const glint_brdf_layout layout = {.columns = columns[k][0], .signed_zenith = true};
        assert_refused(GLINT_ARGUMENT, columns[k][1], path, &layout, "ward", NULL);
    }
    const glint_brdf_layout low = {.floor = -1.0}, no_floor = {.floor = NAN};
    assert_refused(GLINT_ARGUMENT, "the floor is -1", path, &low, "ward", NULL);
    assert_refused(GLINT_ARGUMENT, "the floor is", path, &no_floor, "ward", NULL);
    assert_refused(GLINT_ARGUMENT, "there is no BRDF 'nothing'", path, &good, "ward,nothing", NULL);
    assert_refused(GLINT_ARGUMENT, "a term of the sum is empty", path, &good, "ward,", NULL);
    const glint_brdf_fit_options steep = {.max_zenith_rad = 2.0}, none = {.max_zenith_rad = NAN};
    assert_refused(GLINT_ARGUMENT, "the largest zenith angle", path, &good, "ward", &steep);
    assert_refused(GLINT_ARGUMENT, "the largest zenith angle", path, &good, "ward", &none);
    assert_refused(GLINT_INPUT, "", path_in(folder, "absent.csv"), &good, "ward", NULL);
    assert_refused(GLINT_INPUT, "signed", path, NULL, "ward", NULL); /* needs signed_zenith */
    free(s.points);
}
END_TEST

START_TEST(test_fits_leave_out_models_that_take_more_measurements)
{
    series s = noisy_plane();
    s.n = 4;
    const glint_brdf_layout layout = {.signed_zenith = true};
    glint_errors *errors = glint_errors_new();
    glint_brdf_fits *fits;
    glint_brdf_fit_info info;
    const char *path = write_data("data.csv", &s);
    ck_assert_int_eq(glint_brdf_fit(path, &layout, "lambert+2*ward,lambert", NULL, &fits, errors),
                     GLINT_OK);
    ck_assert_uint_eq(glint_errors_count(errors), 1);
    ck_assert_int_eq(glint_errors_get(errors, 0)->severity, GLINT_WARNING);
    ck_assert(glint_brdf_fits_get(fits, 0, &info) && !glint_brdf_fits_get(fits, 1, &info));
    glint_brdf_fits_free(fits);
    glint_errors_free(errors);
    assert_refused(GLINT_INPUT, "no model could be fitted", path_in(folder, "data.csv"), &layout,
                   "lambert+2*ward", NULL);
    free(s.points);
}
END_TEST

START_TEST(test_fits_warn_of_materials_that_reflect_more_than_they_get)
{
    series s = plane();
    for (int k = 0; k < s.n; k++)
        s.points[k].f = 100.0;
    const glint_brdf_layout layout = {.signed_zenith = true};
    glint_errors *errors = glint_errors_new();
    glint_brdf_fits *fits;
    ck_assert_int_eq(
        glint_brdf_fit(write_data("data.csv", &s), &layout, "abg", NULL, &fits, errors), GLINT_OK);
    ck_assert_uint_eq(glint_errors_count(errors), 1);
    ck_assert_int_eq(glint_errors_get(errors, 0)->severity, GLINT_WARNING);
    ck_assert_ptr_nonnull(strstr(glint_errors_get(errors, 0)->message, "more than it gets"));
    glint_brdf_fits_free(fits);
    glint_errors_free(errors);
    free(s.points);
}
END_TEST

/* ----------------------------------------------------------------- pictures */

/* Writes the points as they are: five columns with their names. */
static const char *write_angles(const char *name, const series *s)
{
    const char *path = path_in(folder, name);
    FILE *file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    fprintf(file, "theta_i;phi_i;theta_r;phi_r;f\n");
    for (int k = 0; k < s->n; k++) {
        const measured_point *p = &s->points[k];
        fprintf(file, "%.17g;%.17g;%.17g;%.17g;%.17g\n", acos(p->i[2]) / DEG,
                atan2(p->i[1], p->i[0]) / DEG, acos(p->r[2]) / DEG, atan2(p->r[1], p->r[0]) / DEG,
                p->f);
    }
    ck_assert_int_eq(fclose(file), 0);
    return path;
}

/* Draws fits to the points into a file, which must hold all the words; false without gnuplot. */
static bool check_picture(const series *s, const char *models, const char *const *words)
{
    glint_error error;
    char path[1024];
    snprintf(path, sizeof path, "%s", path_in(folder, "fit.svg"));
    if (glint_plot_check(path, NULL, &error) == GLINT_OUTPUT) {
        printf("SKIPPED: pictures of fits: %s\n", error.message);
        return false;
    }
    glint_brdf_fits *fits;
    ck_assert_int_eq(glint_brdf_fit(write_angles("data.csv", s), NULL, models, NULL, &fits, NULL),
                     GLINT_OK);
    const glint_status status = glint_brdf_fits_plot(fits, path, &error);
    ck_assert_msg(status == GLINT_OK, "%s", status ? error.message : "");
    char *svg;
    size_t size;
    ck_assert_int_eq(file_read(path, &svg, &size, PLACE_NONE, &error), GLINT_OK);
    for (; *words; words++)
        ck_assert_msg(strstr(svg, *words), "the picture has no '%s'", *words);
    free(svg);
    glint_brdf_fits_free(fits);
    return true;
}

START_TEST(test_fits_plot_shows_curves_in_the_plane_of_incidence)
{
    static const char *const words[] = {"</svg>", "lambert+ward",         "rms",
                                        "60 deg", "+ on the mirror side", NULL};
    series s = noisy_plane();
    check_picture(&s, "phong,lambert+ward,lambert,abg,minnaert", words);
    free(s.points);
}
END_TEST

START_TEST(test_fits_plot_shows_points_out_of_the_plane_of_incidence)
{
    static const char *const words[] = {"</svg>", "measured", "angle from the mirror direction",
                                        NULL};
    series s = hemisphere();
    const brdf_lobe lobe = true_lobe(brdf_model_named("ward-gmd"));
    series_make(&s, &lobe, 1);
    check_picture(&s, "phong", words);
    free(s.points);
}
END_TEST

/* --------------------------------------------------------- real measurements */

/* Fits that were made elsewhere to the flight materials of Starlink v1.5 (golden/brdf/materials.csv
 * in the reference data, rows `fit here`): ours, to the same measurements, may not be worse. */
typedef struct published {
    const char *file, *model;
    double rms_dex; /* three digits */
    double params[5];
} published;

static const published fits_elsewhere[] = {
    {"chassis_brdf.csv", "lambert+abg", 0.137, {0.0296, 5.372e-3, 1.431e-6, 2.301}},
    {"chassis_brdf.csv", "lambert+2*ward-gmd", 0.236, {0.0433, 0.197, 0.0249, 0.114, 0.175}},
    {"solar_array_brdf.csv", "lambert+abg", 0.187, {0.00436, 1.556e-3, 1.221e-7, 1.779}},
    {"solar_array_brdf.csv", "lambert+2*ward-gmd", 0.296, {0.00782, 0.0136, 0.0687, 0.0107, 0.218}},
};

/* The published rms follows from the published parameters and the points that we fit to. */
static void check_published(const published *p, const series *s)
{
    brdf_lobe lobes[3] = {LOBE("lambert", {NULL, "rho", p->params[0]})};
    brdf_material material = {.n_lobes = 2, .lobes = lobes};
    if (strstr(p->model, "abg")) {
        lobes[1] = LOBE("abg", {NULL, "rho_d", 0.0}, {NULL, "A", p->params[1]},
                        {NULL, "B", p->params[2]}, {NULL, "g", p->params[3]});
    } else {
        material.n_lobes = 3;
        for (int k = 0; k < 2; k++)
            lobes[1 + k] = LOBE(
                "ward-gmd", {NULL, "rho_d", 0.0}, {NULL, "rho_s", p->params[1 + 2 * k]},
                {NULL, "alpha_x", p->params[2 + 2 * k]}, {NULL, "alpha_y", p->params[2 + 2 * k]});
    }
    assert_near(fit_rms_dex(&material, s->points, s->n, &usual), p->rms_dex, 0.0005);
}

static series series_of(const glint_brdf_fits *fits)
{
    series s = {0};
    glint_brdf_fit_point point;
    for (size_t j = 0; glint_brdf_fits_point(fits, 0, j, &point); j++) {
        measured_point m = {.f = point.f_measured};
        memcpy(m.i, point.i, sizeof m.i);
        memcpy(m.r, point.r, sizeof m.r);
        series_add(&s, &m);
    }
    return s;
}

START_TEST(test_fits_of_flight_materials_are_no_worse_than_those_published)
{
    const char *dir = reference_dir("fits to flight materials");
    if (!dir) return;
    const glint_brdf_layout layout = {.columns = "theta_i=1,phi_i=2,theta_r=3,phi_r=4,f=5",
                                      .signed_zenith = true};
    for (size_t k = 0; k < sizeof fits_elsewhere / sizeof fits_elsewhere[0]; k++) {
        const published *p = &fits_elsewhere[k];
        char name[128];
        snprintf(name, sizeof name, "validation/starlink_v15/%s", p->file);
        glint_errors *errors = glint_errors_new();
        glint_brdf_fits *fits;
        glint_brdf_fit_info info;
        ck_assert_int_eq(glint_brdf_fit(path_in(dir, name), &layout, p->model, NULL, &fits, errors),
                         GLINT_OK);
        ck_assert(glint_brdf_fits_get(fits, 0, &info));
        ck_assert_uint_eq(info.n_rows, 724);
        ck_assert_uint_eq(info.n_points, 684);
        ck_assert_msg(info.rms_dex <= p->rms_dex + 0.0005, "%s, %s: rms %g dex; published %g",
                      p->file, p->model, info.rms_dex, p->rms_dex);
        series s = series_of(fits);
        check_published(p, &s);
        free(s.points);
        glint_brdf_fits_free(fits);
        glint_errors_free(errors);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fit");
    TCase *c = tcase_create("fit");
    tcase_set_timeout(c, 300);
    tcase_add_test(c, test_fit_recovers_parameters_of_every_model_without_noise);
    tcase_add_test(c, test_fit_recovers_both_slopes_when_anisotropic);
    tcase_add_test(c, test_fit_recovers_sums_of_lobes);
    tcase_add_test(c, test_fit_of_one_strength_has_its_closed_form);
    tcase_add_test(c, test_fit_standard_errors_are_those_of_the_noise);
    tcase_add_test(c, test_fit_rounds_parameters_without_harm);
    tcase_add_test(c, test_fit_puts_diffuse_light_into_one_term);
    tcase_add_test(c, test_fit_says_what_is_at_the_end_of_its_range);
    tcase_add_test(c, test_fit_says_what_is_undetermined);
    tcase_add_test(c, test_fit_leaves_out_what_no_model_can_tell);
    tcase_add_test(c, test_fit_refuses_fewer_measurements_than_it_needs);
    tcase_add_test(c, test_fit_survives_silly_measurements);
    tcase_add_test(c, test_fit_gives_the_same_twice);
    tcase_add_test(c, test_fit_form_reads_what_it_writes);
    tcase_add_test(c, test_fit_form_refuses_what_is_no_sum);
    suite_add_tcase(suite, c);
    TCase *files = tcase_create("files");
    tcase_set_timeout(files, 300);
    tcase_add_unchecked_fixture(files, make_folder, remove_folder);
    tcase_add_test(files, test_fits_are_ranked_by_their_misfit);
    tcase_add_test(files, test_fits_show_each_measurement_beside_the_fit);
    tcase_add_test(files, test_fits_toml_read_back_has_the_rms_that_is_said);
    tcase_add_test(files, test_fits_toml_holds_any_file_name);
    tcase_add_test(files, test_fits_refuse_wrong_arguments);
    tcase_add_test(files, test_fits_leave_out_models_that_take_more_measurements);
    tcase_add_test(files, test_fits_warn_of_materials_that_reflect_more_than_they_get);
    tcase_add_test(files, test_fits_plot_shows_curves_in_the_plane_of_incidence);
    tcase_add_test(files, test_fits_plot_shows_points_out_of_the_plane_of_incidence);
    tcase_add_test(files, test_fits_of_flight_materials_are_no_worse_than_those_published);
    suite_add_tcase(suite, files);
    return run_suite(suite);
}
