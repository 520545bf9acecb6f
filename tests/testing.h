/* testing.h: what the tests share: comparing numbers so that NaN never passes, and finding data. */
#ifndef GLINT_TESTING_H
#define GLINT_TESTING_H

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* |got - want| <= tol, false for NaN. */
static inline int is_near(double got, double want, double tol)
{
    return fabs(got - want) <= tol;
}

/* Fails with both values when |got - want| > tol (absolute) or either is NaN. */
#define assert_near(got, want, tol)                                                                \
    do {                                                                                           \
        const double got_ = (got), want_ = (want), tol_ = (tol);                                   \
        ck_assert_msg(is_near(got_, want_, tol_), "%s = %.17g; expected %.17g within %g (off %g)", \
                      #got, got_, want_, tol_, got_ - want_);                                      \
    } while (0)

/* Fails when got deviates from want by more than rel |want|, or either is NaN. */
#define assert_rel(got, want, rel)                                                                 \
    do {                                                                                           \
        const double got_ = (got), want_ = (want), rel_ = (rel);                                   \
        ck_assert_msg(is_near(got_, want_, rel_ *fabs(want_)),                                     \
                      "%s = %.17g; expected %.17g, relative error %g, allowed %g", #got, got_,     \
                      want_, (got_ - want_) / want_, rel_);                                        \
    } while (0)

/* The folder of the reference data, or NULL, and then says that `what` is skipped. */
static inline const char *reference_dir(const char *what)
{
    const char *dir = getenv("GLINT_REFERENCE_DIR");
    if (!dir || !dir[0]) {
        printf("SKIPPED: %s: GLINT_REFERENCE_DIR is not set\n", what);
        return NULL;
    }
    return dir;
}

/* "folder/name" in a static buffer that the next call overwrites. */
static inline const char *path_in(const char *folder, const char *name)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

/* Runs a suite; main's exit status. */
static inline int run_suite(Suite *suite)
{
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
