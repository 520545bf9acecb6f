/* timing.h: what the benchmarks share: measuring CPU time by repetition. */
#ifndef GLINT_BENCH_TIMING_H
#define GLINT_BENCH_TIMING_H

#include <time.h>

/* CPU time of this thread in s. Time in which others have the processor does not count. */
static inline double cpu_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* One thing to measure: `run` does a fixed piece of work. */
typedef struct job {
    void (*run)(void *data);
    void *data;
    int repeats;  /* set by measure */
    double least; /* s of one piece of work: the minimum over all rounds; set by measure */
} job;

/* Measures n jobs side by side: in every round each of them runs for `at_least_s`, one after the
 * other, so that all meet the same changes of the clock and of the load. The minimum counts. */
static inline void measure(job *jobs, int n, int rounds, double at_least_s)
{
    for (int j = 0; j < n; j++) {
        jobs[j].repeats = 1;
        jobs[j].least = 1e99;
    }
    for (int round = 0; round < rounds; round++)
        for (int j = 0; j < n; j++) {
            job *one = &jobs[j];
            for (;;) {
                const double from_s = cpu_s();
                for (int k = 0; k < one->repeats; k++)
                    one->run(one->data);
                const double took_s = cpu_s() - from_s;
                const double each_s = took_s / one->repeats;
                if (each_s < one->least) one->least = each_s;
                if (took_s >= at_least_s || one->repeats > 1 << 28) break;
                one->repeats *= 2;
            }
        }
}

#endif
