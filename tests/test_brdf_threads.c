/* Evaluating a material takes no memory and shares nothing: allocations are counted, and threads
 * that evaluate the same materials at once get the same bits. */
#include "brdf_draws.h"

#include <pthread.h>
#include <stdatomic.h>

/* ----------------------------------------------------------------- allocations */

/* The linker puts these in the place of the C library's (see CMakeLists.txt), for the whole of the
 * library under test. */
void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);

static atomic_long n_allocations;

void *__wrap_malloc(size_t size)
{
    atomic_fetch_add(&n_allocations, 1);
    return __real_malloc(size);
}

void *__wrap_calloc(size_t n, size_t size)
{
    atomic_fetch_add(&n_allocations, 1);
    return __real_calloc(n, size);
}

void *__wrap_realloc(void *memory, size_t size)
{
    atomic_fetch_add(&n_allocations, 1);
    return __real_realloc(memory, size);
}

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    atomic_fetch_add(&n_allocations, 1);
    return __real_aligned_alloc(alignment, size);
}

/* ------------------------------------------------------------------- materials */

enum { EACH = 4, MOST_LOBES = 64 * EACH }; /* lobes of each model */

/* Lobes of all models there are, and a material of all of them. */
typedef struct collection {
    brdf_lobe lobes[MOST_LOBES];
    brdf_material all;
    brdf_light light;
    facet_set facets;
} collection;

static void collect(collection *c)
{
    uint64_t state = 42;
    int n = 0;
    for (size_t k = 0; brdf_model_at(k); k++)
        for (int each = 0; each < EACH; each++) {
            ck_assert_int_lt(n, MOST_LOBES);
            draw_lobe(brdf_model_at(k), &state, &c->lobes[n++]);
        }
    c->all = (brdf_material){.n_lobes = n, .lobes = c->lobes};
    random_light(&c->light, &state);
    random_facets(&c->facets, &state);
}

static void discard(collection *c)
{
    for (int k = 0; k < c->all.n_lobes; k++)
        brdf_lobe_free(&c->lobes[k]);
}

/* All that a run asks of a lobe: the kernel, pairs of directions, what is mirrored. */
enum { PAIRS = 16, VALUES = BRDF_TILE + 2 * PAIRS };

static void evaluate(collection *c, int lobe, double out[VALUES])
{
    const brdf_material one = {.n_lobes = 1, .lobes = &c->lobes[lobe]};
    const brdf_facets facets = facets_of(&c->facets);
    uint64_t state = (uint64_t)lobe;
    memset(out, 0, VALUES * sizeof *out);
    brdf_material_tile(&one, &facets, &c->light, NULL, out);
    for (int k = 0; k < PAIRS; k++) {
        double i[3], r[3];
        random_up(&state, i);
        random_up(&state, r);
        out[BRDF_TILE + k] = brdf_material_eval(&one, i, r);
        out[BRDF_TILE + PAIRS + k] = brdf_material_specular(&one, i[2]);
    }
}

/* The test's own framework takes memory, too: only what happens in between counts. */
START_TEST(test_brdf_evaluation_allocates_nothing)
{
    static collection c;
    double values[VALUES], sum[BRDF_TILE] = {0};
    collect(&c);
    ck_assert_int_gt(atomic_load(&n_allocations), 0); /* the count works: tables take memory */
    for (int k = 0; k < c.all.n_lobes; k++) {
        const long before = atomic_load(&n_allocations);
        evaluate(&c, k, values);
        const long taken = atomic_load(&n_allocations) - before;
        ck_assert_msg(taken == 0, "%s took memory %ld times", c.lobes[k].model->name, taken);
    }
    const brdf_facets facets = facets_of(&c.facets);
    const long before = atomic_load(&n_allocations);
    brdf_material_tile(&c.all, &facets, &c.light, NULL, sum);
    const long taken = atomic_load(&n_allocations) - before;
    ck_assert_int_eq(taken, 0);
    discard(&c);
}
END_TEST

/* --------------------------------------------------------------------- threads */

enum { THREADS = 4, REPEATS = 50 };

typedef struct worker {
    collection *c; /* only read */
    const double (*want)[VALUES];
    int start; /* the lobe that it begins with, so that threads are not in step */
    int n_different;
} worker;

static void *work(void *argument)
{
    worker *w = argument;
    const int n = w->c->all.n_lobes;
    for (int repeat = 0; repeat < REPEATS; repeat++)
        for (int k = 0; k < n; k++) {
            const int lobe = (w->start + k) % n;
            double got[VALUES];
            evaluate(w->c, lobe, got);
            w->n_different += memcmp(got, w->want[lobe], sizeof got) != 0;
        }
    return NULL;
}

START_TEST(test_brdf_evaluation_on_threads_gives_the_same_bits)
{
    static collection c;
    static double want[MOST_LOBES][VALUES];
    collect(&c);
    for (int k = 0; k < c.all.n_lobes; k++)
        evaluate(&c, k, want[k]);
    pthread_t threads[THREADS];
    worker workers[THREADS];
    for (int k = 0; k < THREADS; k++) {
        workers[k] = (worker){&c, (const double(*)[VALUES])want, k * c.all.n_lobes / THREADS, 0};
        ck_assert_int_eq(pthread_create(&threads[k], NULL, work, &workers[k]), 0);
    }
    for (int k = 0; k < THREADS; k++) {
        ck_assert_int_eq(pthread_join(threads[k], NULL), 0);
        ck_assert_int_eq(workers[k].n_different, 0);
    }
    discard(&c);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("brdf threads");
    TCase *tests = tcase_create("evaluation");
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, test_brdf_evaluation_allocates_nothing);
    tcase_add_test(tests, test_brdf_evaluation_on_threads_gives_the_same_bits);
    suite_add_tcase(suite, tests);
    return run_suite(suite);
}
