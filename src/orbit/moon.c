#include "orbit/moon.h"

#include "base/constants.h"
#include "base/vec.h"

#include <erfa.h>
#include <erfam.h>
#include <math.h>

#define STEP_DAYS 0.5 /* between nodes */

static void node_at(int64_t node, double pv[6])
{
    double au_days[2][3];
    eraMoon98(ERFA_DJ00, (double)node * STEP_DAYS, au_days);
    scale3(au_days[0], AU_M, pv);
    scale3(au_days[1], AU_M / DAY_S, pv + 3);
}

/* Has the nodes around a moment at hand. */
static void cover(moon_cursor *cursor, int64_t node)
{
    if (cursor->set && cursor->node == node) return;
    if (cursor->set && cursor->node + 1 == node)
        memcpy(cursor->pv[0], cursor->pv[1], sizeof cursor->pv[0]);
    else
        node_at(node, cursor->pv[0]);
    node_at(node + 1, cursor->pv[1]);
    cursor->set = true;
    cursor->node = node;
}

void moon_position(const run_clock *clock, double t_s, moon_cursor *cursor, double moon_gcrs_m[3])
{
    double tt_jd[2];
    moon_cursor own = {0};
    moon_cursor *c = cursor ? cursor : &own;
    run_clock_tt(clock, t_s, tt_jd);
    const double position = ((tt_jd[0] - ERFA_DJ00) + tt_jd[1]) / STEP_DAYS, base = floor(position);
    cover(c, (int64_t)base);
    /* Hermite's cubic: its error is the fourth derivative times step^4/384. */
    const double u = position - base, v = 1 - u, h_s = STEP_DAYS * DAY_S;
    const double *a = c->pv[0], *b = c->pv[1];
    for (int i = 0; i < 3; i++)
        moon_gcrs_m[i] = a[i] + u * u * (3 - 2 * u) * (b[i] - a[i]) +
                         u * v * h_s * (v * a[3 + i] - u * b[3 + i]);
}

double moon_illuminated(const double moon_m[3], const double sun_m[3])
{
    double back[3], to_sun[3];
    scale3(moon_m, -1, back);
    sub3(sun_m, moon_m, to_sun);
    return 0.5 * (1 + cos(angle3(back, to_sun)));
}
