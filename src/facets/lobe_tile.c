#include "facets/lobe_tile.h"

#include "base/vec.h"
#include "facets/curved_parts.h"

/* Facets that are handed to the kernel together. Their number is fixed, so that a lane's sum is the
 * same whatever the other lanes are. */
enum { CHUNK = 16 };

/* One lobe on its way over the facets. */
typedef struct lobe_run {
    curved_tile tile;
    batch batch;
    bool curved, disc; /* what must be looked for */
    disc_queue queues[DISC_RULES];
    brdf_watch watch;      /* for the disc */
    const double *visible; /* of the span */
    int first;             /* facet of the span that is the kernel's first */
    const double *left;    /* what the kernel gets in place of `visible` */
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

static void turn_into(const double frame[9], const double v[3][BRDF_TILE], int lane, double out[3])
{
    const double one[3] = {v[0][lane], v[1][lane], v[2][lane]};
    mat_vec(frame, one, out);
}

/* The kernel shows a facet that may feel the disc: takes the mean over it in the lanes that do. */
static uint32_t add_facet(void *finder, int which, uint32_t lanes)
{
    lobe_run *run = finder;
    curved_tile *t = &run->tile;
    const int k = run->first + which;
    const double *left = run->left ? run->left + (size_t)which * BRDF_TILE : NULL;
    uint32_t taken = 0;
    double frame[9];
    frame_of(t->facets, k, frame);
    for (; lanes; lanes &= lanes - 1) {
        const int lane = __builtin_ctz(lanes);
        double i[3], r[3];
        turn_into(frame, t->light->i, lane, i);
        turn_into(frame, t->light->r, lane, r);
        const disc_sample sample = {.shape = t->shape, .disc = t->disc, .lane = lane};
        const int rule = disc_rule_of(&sample, i, r);
        if (rule == DISC_CENTRE) continue;
        taken |= (uint32_t)1 << lane;
        const double area_m2 = (left ? left[lane] : 1.0) * t->facets->area[k];
        if (!(area_m2 > 0.0)) continue;
        if (rule < DISC_RULES)
            disc_queue_push(&run->queues[rule], t->batch->material, &t->disc->rules[rule],
                            t->disc->scale[lane], lane, i, r, area_m2);
        else
            disc_push(t->batch, &sample, rule, i, r, area_m2);
    }
    return taken;
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

/* Sends facets through the kernel. left: in place of `visible`. */
static void add_facets(lobe_run *run, int first, int n, const double *left, double sum[BRDF_TILE])
{
    brdf_facets some = facets_from(run->tile.facets, first, n);
    some.watch = run->disc ? &run->watch : NULL;
    run->first = first;
    run->left = left;
    brdf_material_tile(run->batch.material, &some, run->tile.light, left, sum);
}

/* A chunk of curved facets: those whose highlight is near by themselves. */
static void add_chunk(lobe_run *run, int first, int n, double sum[BRDF_TILE])
{
    _Alignas(64) double left[CHUNK][BRDF_TILE];
    const double *seen = run->visible ? run->visible + (size_t)first * BRDF_TILE : NULL;
    bool any = false;
    for (int k = 0; k < n; k++) {
        fill_left(seen ? seen + k * BRDF_TILE : NULL, left[k]);
        any |= curved_add_near(&run->tile, first + k, left[k]);
    }
    add_facets(run, first, n, any ? left[0] : seen, sum);
}

static void flush_queues(lobe_run *run, double sum[BRDF_TILE])
{
    for (int k = 0; k < DISC_RULES; k++) {
        disc_queue *q = &run->queues[k];
        disc_queue_flush(q, run->batch.material, &run->tile.disc->rules[k]);
        for (int lane = 0; lane < BRDF_TILE; lane++)
            sum[lane] += q->sum[lane];
    }
}

static void add_lobe(lobe_run *run, double sum[BRDF_TILE])
{
    const int n = run->tile.facets->n;
    if (run->curved) curved_tile_start(&run->tile);
    for (int first = 0; run->curved && first < n; first += CHUNK)
        add_chunk(run, first, n - first < CHUNK ? n - first : CHUNK, sum);
    if (!run->curved) add_facets(run, 0, n, run->visible, sum);
    batch_flush(&run->batch);
    for (int lane = 0; lane < BRDF_TILE; lane++)
        sum[lane] += run->batch.sum[lane];
    if (run->disc) flush_queues(run, sum);
}

/* The disc matters where it is one in some lane. The run is large: what need not be set is not. */
static void start_disc(lobe_run *run)
{
    const curved_tile *t = &run->tile;
    run->watch.finder = run;
    run->watch.found = add_facet;
    run->disc = t->disc && disc_watch_set(t->shape, t->light, t->disc, &run->watch);
    for (int k = 0; k < DISC_RULES; k++) {
        run->queues[k].n = 0;
        memset(run->queues[k].sum, 0, sizeof run->queues[k].sum);
    }
}

void lobe_tile(const curved_span *curved, int band, const brdf_material *material,
               const lobe_shape *shapes, const brdf_facets *facets, const brdf_light *light,
               const source_disc *disc, const double *visible, double sum[BRDF_TILE])
{
    const curved_lobe *lobes = curved ? curved->lobes + curved->first_lobe[band] : NULL;
    for (int k = 0; k < material->n_lobes; k++) {
        const brdf_material one = {.n_lobes = 1, .lobes = &material->lobes[k]};
        lobe_run run;
        run.curved = lobes && lobes[k].active;
        run.visible = visible;
        if (!run.curved && !disc) {
            brdf_material_tile(&one, facets, light, visible, sum);
            continue;
        }
        run.tile = (curved_tile){.span = curved,
                                 .lobe = run.curved ? &lobes[k] : NULL,
                                 .shape = &shapes[k],
                                 .facets = facets,
                                 .light = light,
                                 .disc = disc,
                                 .batch = &run.batch};
        batch_start(&run.batch, &one);
        start_disc(&run);
        add_lobe(&run, sum);
    }
}
