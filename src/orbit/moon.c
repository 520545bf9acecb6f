#include "orbit/moon.h"

#include "base/constants.h"
#include "base/vec.h"

#include <erfa.h>

void moon_position(const run_clock *clock, double t_s, double moon_gcrs_m[3])
{
    double tt_jd[2], pv[2][3];
    run_clock_tt(clock, t_s, tt_jd);
    eraMoon98(tt_jd[0], tt_jd[1], pv);
    scale3(pv[0], AU_M, moon_gcrs_m);
}
