/* read_earthshine.c: [photometry] earthshine: false, { albedo = 0.3 }, or { brdf = ..., ... }. */
#include "base/constants.h"
#include "base/vec.h"
#include "brdf/dhr.h"
#include "brdf/sharpness.h"
#include "scenario/read_material.h"

#include <math.h>
#include <stdlib.h>

/* Whether what the ground sends depends on how it is turned about its normal. */
static bool has_grain(const brdf_material *ground)
{
    static const double TILT[] = {0.3, 1.1}, TURN[] = {0.7, 1.5, 2.4}; /* rad */
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++) {
            const double i[3] = {sin(TILT[a]), 0, cos(TILT[a])};
            const double r[3] = {-sin(TILT[b]) * cos(0.1), sin(TILT[b]) * sin(0.1), cos(TILT[b])};
            const double straight = brdf_material_eval(ground, i, r);
            for (int k = 0; k < 3; k++) {
                static const double UP[3] = {0, 0, 1};
                double turn[9], i2[3], r2[3];
                mat_turn(UP, TURN[k], turn);
                mat_vec(turn, i, i2);
                mat_vec(turn, r, r2);
                if (fabs(brdf_material_eval(ground, i2, r2) - straight) > 1e-9 * straight)
                    return true;
            }
        }
    return false;
}

/* What the nodes on the ground cannot follow. */
static void check_ground(reader *r, const brdf_material *ground)
{
    brdf_energy worst;
    const place where = reader_place(r, "brdf");
    const double width = brdf_material_width(ground);
    if (has_grain(ground))
        reader_fail(r, where,
                    "the Earth's BRDF depends on the tangent, and its ground has none; expected an "
                    "isotropic one, such as phong, or equal parameters along both axes");
    else if (width < GLOBE_NARROW)
        reader_fail(r, where,
                    "the Earth's BRDF has a lobe of %.3g rad; expected at least %g rad (%.2g deg), "
                    "as of a sea under wind, which the nodes of its light resolve",
                    width, GLOBE_NARROW, GLOBE_NARROW / DEG);
    else if (brdf_energy_gain(ground, &worst))
        errors_warn(r->errors, where,
                    "the Earth reflects more than it gets: %.4g times the light that comes at %g "
                    "deg from the vertical",
                    worst.dhr, worst.theta_i / DEG);
}

/* The ground in every band; first without a band, so that errors come once. */
static void read_grounds(reading *rd, reader *r)
{
    glint_scenario *s = rd->s;
    brdf_material any;
    read_reflection(rd, r, NULL, &any);
    if (!r->status) check_ground(r, &any);
    brdf_material_free(&any);
    for (int b = 0; b < s->n_bands && !r->status; b++) {
        read_reflection(rd, r, s->bands[b], &s->earth.ground[b]);
        const bool repeated =
            b > 0 && !r->status && brdf_material_same(&s->earth.ground[b - 1], &s->earth.ground[b]);
        if (!r->status && b > 0 && !repeated) check_ground(r, &s->earth.ground[b]);
    }
}

static void read_albedo(reading *rd, reader *r)
{
    static const param_info ALBEDO = {"albedo", "", "", 0, 1, PARAM_REQUIRED, 0};
    double albedo;
    if (!reader_param(r, &ALBEDO, &albedo)) return;
    for (int b = 0; b < rd->s->n_bands; b++) {
        brdf_material *ground = &rd->s->earth.ground[b];
        ground->lobes = calloc(1, sizeof *ground->lobes);
        if (!ground->lobes) {
            reading_no_memory(rd);
            return;
        }
        ground->n_lobes = 1;
        *ground->lobes = (brdf_lobe){.model = brdf_model_named("lambert"), .weight = 1.0};
        ground->lobes->params[0] = albedo;
        (void)brdf_lobe_prepare(ground->lobes, NULL); /* takes every reflectance from 0 to 1 */
    }
}

static void read_table(reading *rd, const toml_node *node)
{
    /* The Earth's equatorial radius; from a shell to what is still below every satellite. */
    static const param_info RADIUS = {"radius_km", "km", "", 6000, 6500, EARTH_RADIUS_M * 1e-3, 0};
    earth_light *earth = &rd->s->earth;
    reader r = reader_start(node, "earthshine", rd->errors);
    double radius_km;
    if (reader_param(&r, &RADIUS, &radius_km)) earth->radius_m = radius_km * 1e3;
    reader_integer(&r, "rings", false, GLOBE_FEWEST_RINGS, GLOBE_MOST_RINGS, 0, &earth->rings);
    const bool albedo = reader_has(&r, "albedo"), brdf = reader_has(&r, "brdf");
    if (albedo == brdf)
        reader_fail(&r, node->where,
                    "earthshine has %s; expected one of them: { albedo = 0.3 }, or { brdf = "
                    "\"phong\", ... } with its keys",
                    albedo ? "both 'albedo' and 'brdf'" : "neither 'albedo' nor 'brdf'");
    else if (albedo)
        read_albedo(rd, &r);
    else
        read_grounds(rd, &r);
    if (brdf && !albedo)
        reading_note(rd, r.status); /* the keys of a BRDF end the table */
    else
        reading_done(rd, &r);
    measured_cache_free(&rd->tables);
}

void read_earthshine(reading *rd, reader *photometry)
{
    earth_light *earth = &rd->s->earth;
    const toml_node *node = reader_find(photometry, "earthshine");
    if (!node || (node->type == TOML_BOOLEAN && !node->boolean)) return;
    if (node->type != TOML_TABLE) {
        reader_fail(photometry, node->where,
                    "'earthshine' is %s; expected false, { albedo = 0.3 }, or { brdf = \"phong\", "
                    "... } with its keys",
                    node->type == TOML_BOOLEAN ? "true" : toml_type_name(node->type));
        return;
    }
    if (rd->s->has_geometry) {
        reader_fail(photometry, node->where,
                    "directions given by [geometry] do not say where the Earth is; expected "
                    "earthshine = false");
        return;
    }
    earth->wanted = true;
    earth->radius_m = EARTH_RADIUS_M;
    earth->ground = calloc((size_t)rd->s->n_bands + 1, sizeof *earth->ground);
    if (!earth->ground)
        reading_no_memory(rd);
    else
        read_table(rd, node);
}

void make_earthshine(reading *rd)
{
    earth_light *earth = &rd->s->earth;
    glint_error error;
    if (!earth->wanted) return;
    const glint_status status = globe_make(&rd->s->satellite.model, earth->ground,
                                           (int)earth->rings, &earth->source, &error);
    if (status) reading_note(rd, errors_take(rd->errors, &error, PLACE_NONE));
}

void earth_light_free(earth_light *earth, int n_bands)
{
    globe_free(earth->source);
    for (int b = 0; earth->ground && b < n_bands; b++)
        brdf_material_free(&earth->ground[b]);
    free(earth->ground);
    *earth = (earth_light){0};
}
