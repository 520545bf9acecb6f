#include "facets/lobe_tile.h"

#include "base/vec.h"
#include "facets/curved_parts.h"
#include "facets/spread.h"

/* Facets that are handed to the kernel together. Their number is fixed, so that a lane's sum is the
 * same whatever the other lanes are. */
enum { CHUNK = 16 };

/* One lobe on its way over the facets. */
typedef struct lobe_run {
    curved_tile tile;
    bool curved, disc; /* what must be looked for */
    disc_queue queues[DISC_RULES];
    spread sources, bisectors;
    double widest_disc, cosine2; /* sine of the radius; of the tilt past which lobes are over */
    const double *visible;
} lobe_run;

static void fill_left(const double *seen, double left[BRDF_TILE])
{
    for (int lane = 0; lane < BRDF_TILE; lane++)
        left[lane] = seen ? seen[lane] : 1.0;
}

static void frame_of(const brdf_facets *facets, int k, double frame[9])
{
    for (int j = 0; j < 3; j++) {
        frame[j] = facets->tangent[j][k];
        frame[3 + j] = facets->bitangent[j][k];
        frame[6 + j] = facets->normal[j][k];
    }
}

/* Takes the mean over the disc for the lanes of facet k that have a rule, and takes them out of
 * `left`. */
static void add_blurred(lobe_run *run, int k, const double rules[BRDF_TILE], double left[BRDF_TILE])
{
    curved_tile *t = &run->tile;
    double frame[9];
    frame_of(t->facets, k, frame);
    for (int lane = 0; lane < BRDF_TILE; lane++) {
        const int rule = (int)rules[lane];
        if (rule == DISC_CENTRE) continue;
        const double part = left[lane];
        left[lane] = 0.0;
        if (!(part > 0.0)) continue;
        double i[3], r[3];
        const double light_i[3] = {t->light->i[0][lane], t->light->i[1][lane],
                                   t->light->i[2][lane]};
        const double light_r[3] = {t->light->r[0][lane], t->light->r[1][lane],
                                   t->light->r[2][lane]};
        mat_vec(frame, light_i, i);
        mat_vec(frame, light_r, r);
        const double area_m2 = part * t->facets->area[k];
        if (rule < DISC_RULES) {
            disc_queue_push(&run->queues[rule], t->batch.material, &t->disc->rules[rule],
                            t->disc->scale[lane], lane, i, r, area_m2);
            continue;
        }
        const disc_sample sample = {.shape = t->shape, .disc = t->disc, .lane = lane};
        disc_push(&t->batch, &sample, i, r, area_m2);
    }
}

static brdf_facets facets_from(const brdf_facets *facets, int first, int n)
{
    brdf_facets out = {.n = n, .area = facets->area + first};
    for (int j = 0; j < 3; j++) {
        out.normal[j] = facets->normal[j] + first;
        out.tangent[j] = facets->tangent[j] + first;
        out.bitangent[j] = facets->bitangent[j] + first;
    }
    return out;
}

/* Looks how far the directions of the tile are apart, and how far from the bisector a normal may be
 * for the disc to be felt. */
static void look_at_disc(lobe_run *run)
{
    const curved_tile *t = &run->tile;
    const lobe_shape *shape = t->shape;
    const double widest = shape->specular ? 1.0 : fmax(shape->width[0], shape->width[1]);
    double slope = 0.0;
    run->sources = spread_of(t->light->i);
    run->bisectors = spread_of(t->light->h);
    for (int k = 0; k < BRDF_TILE; k++) {
        const double size = 1.5 * t->disc->scale[k] / fmax(t->light->hlen[k], 1e-3);
        slope = fmax(slope, 2.0 * shape->end * widest / t->light->hlen[k] + size);
        run->widest_disc = fmax(run->widest_disc, t->disc->scale[k]);
    }
    run->cosine2 = shape->surge || !(slope < 1e3) ? 0.0 : 1.0 / (1.0 + slope * slope);
}

/* False where the middle of the disc will do for a facet in all lanes, as far as that is seen at
 * once. */
static bool may_feel_disc(const lobe_run *run, int k)
{
    const brdf_facets *f = run->tile.facets;
    const double n[3] = {f->normal[0][k], f->normal[1][k], f->normal[2][k]};
    if (!spread_is_off_plane(&run->sources, n, run->widest_disc)) return true;
    return dot3(run->sources.middle, n) > 0.0 &&
           (run->cosine2 == 0.0 || spread_can_be_near(&run->bisectors, n, run->cosine2));
}

/* A chunk of facets: what is special lane by lane, the rest through the kernel. */
static void add_chunk(lobe_run *run, int first, int n, double sum[BRDF_TILE])
{
    _Alignas(64) double left[CHUNK][BRDF_TILE], own[BRDF_TILE];
    const curved_tile *t = &run->tile;
    const double *seen = run->visible ? run->visible + (size_t)first * BRDF_TILE : NULL;
    bool any = false;
    for (int k = 0; k < n; k++) {
        _Alignas(64) double rules[BRDF_TILE];
        const bool blurred =
            run->disc && may_feel_disc(run, first + k) &&
            disc_rules_of(t->shape, t->facets, first + k, t->light, t->disc, rules);
        if (!blurred && !run->curved && !any) continue;
        fill_left(seen ? seen + k * BRDF_TILE : NULL, own);
        bool taken = run->curved && curved_add_near(&run->tile, first + k, own);
        if (blurred) add_blurred(run, first + k, rules, own);
        taken |= blurred;
        for (int j = 0; j < k && taken && !any; j++)
            fill_left(seen ? seen + j * BRDF_TILE : NULL, left[j]);
        any |= taken;
        if (any) memcpy(left[k], own, sizeof own);
    }
    const brdf_facets some = facets_from(t->facets, first, n);
    brdf_material_tile(t->batch.material, &some, t->light, any ? left[0] : seen, sum);
}

static void add_lobe(lobe_run *run, double sum[BRDF_TILE])
{
    const int n = run->tile.facets->n;
    if (run->curved) curved_tile_start(&run->tile);
    if (run->disc) look_at_disc(run);
    for (int first = 0; first < n; first += CHUNK)
        add_chunk(run, first, n - first < CHUNK ? n - first : CHUNK, sum);
    batch_flush(&run->tile.batch);
    for (int lane = 0; lane < BRDF_TILE; lane++)
        sum[lane] += run->tile.batch.sum[lane];
    for (int k = 0; run->disc && k < DISC_RULES; k++) {
        disc_queue *q = &run->queues[k];
        disc_queue_flush(q, run->tile.batch.material, &run->tile.disc->rules[k]);
        for (int lane = 0; lane < BRDF_TILE; lane++)
            sum[lane] += q->sum[lane];
    }
}

void lobe_tile(const curved_span *curved, int band, const brdf_material *material,
               const lobe_shape *shapes, const brdf_facets *facets, const brdf_light *light,
               const source_disc *disc, const double *visible, double sum[BRDF_TILE])
{
    const curved_lobe *lobes = curved ? curved->lobes + curved->first_lobe[band] : NULL;
    for (int k = 0; k < material->n_lobes; k++) {
        const brdf_material one = {.n_lobes = 1, .lobes = &material->lobes[k]};
        lobe_run run = {.curved = lobes && lobes[k].active, .disc = disc, .visible = visible};
        if (!run.curved && !run.disc) {
            brdf_material_tile(&one, facets, light, visible, sum);
            continue;
        }
        run.tile = (curved_tile){.span = curved,
                                 .lobe = run.curved ? &lobes[k] : NULL,
                                 .shape = &shapes[k],
                                 .facets = facets,
                                 .light = light,
                                 .disc = disc,
                                 .batch = {.material = &one}};
        add_lobe(&run, sum);
    }
}
