#include "orbit/frames.h"

#include "base/clones.h"
#include "base/constants.h"
#include "base/fasttrig.h"
#include "base/vec.h"

#include <erfa.h>
#include <erfam.h>
#include <stdlib.h>

/* Steps of the two tables in days; nodes stand at their multiples from J2000.0 TT. */
#define CIP_STEP_DAYS 0.25
#define SUN_STEP_DAYS 0.5
/* Light travels 600 000 km in 2 s: farther than any satellite of the Earth is seen. */
#define LIGHT_MARGIN_S 2.0

enum { CIP_WIDTH = 3, SUN_WIDTH = 9, CIP_NODES = 4, SUN_NODES = 2 };

/* Evaluates node k of a table. */
typedef void node_function(int64_t k, double *node);

/* Nodes first .. first + count - 1 of a function of time, `width` numbers each. */
typedef struct node_table {
    node_function *evaluate;
    int width;
    int64_t first, count;
    double *values; /* owned; count x width */
} node_table;

struct frame_grid {
    run_clock clock;
    double polar[9]; /* polar motion without s': v_itrs = R v_tirs; where the clock has none */
    bool still;      /* there is none */
    bool full;       /* evaluate at every moment, use no table */
    node_table cip;  /* X, Y, s */
    node_table sun;  /* see sun_state */
};

/* ------------------------------------------------------------------- tables */

/* X, Y of the celestial intermediate pole and the CIO locator s, rad. */
static void cip_state(double tt_1, double tt_2, double xys[CIP_WIDTH])
{
    eraXys06a(tt_1, tt_2, &xys[0], &xys[1], &xys[2]);
}

/* Geocentre to Sun (m), its rate (m/s), and the Sun's barycentric velocity (m/s), GCRS axes. */
static void sun_state(double tt_1, double tt_2, double state[SUN_WIDTH])
{
    double from_sun[2][3], from_barycentre[2][3]; /* the Earth's place and velocity; au, au/d */
    eraEpv00(tt_1, tt_2, from_sun, from_barycentre);
    const double au_per_day = AU_M / DAY_S;
    for (int i = 0; i < 3; i++) {
        state[i] = -from_sun[0][i] * AU_M;
        state[3 + i] = -from_sun[1][i] * au_per_day;
        state[6 + i] = (from_barycentre[1][i] - from_sun[1][i]) * au_per_day;
    }
}

static void cip_node(int64_t k, double *node)
{
    cip_state(ERFA_DJ00, (double)k * CIP_STEP_DAYS, node);
}

static void sun_node(int64_t k, double *node)
{
    sun_state(ERFA_DJ00, (double)k * SUN_STEP_DAYS, node);
}

/* Makes the table hold nodes first..last, keeping those that it has; false when memory is out. */
static bool table_cover(node_table *table, int64_t first, int64_t last)
{
    if (first >= table->first && last < table->first + table->count) return true;
    const size_t width = (size_t)table->width, count = (size_t)(last - first + 1);
    double *values = calloc(count, width * sizeof *values);
    if (!values) return false;
    for (size_t i = 0; i < count; i++) {
        const int64_t k = first + (int64_t)i, old = k - table->first;
        if (old >= 0 && old < table->count)
            memcpy(values + i * width, table->values + (size_t)old * width, width * sizeof *values);
        else
            table->evaluate(k, values + i * width);
    }
    free(table->values);
    table->values = values;
    table->first = first;
    table->count = (int64_t)count;
    return true;
}

/* n nodes in a row from k on: in the table, or evaluated into `room` where it does not hold them.
 */
static const double *table_nodes(const node_table *table, int64_t k, int n, double *room)
{
    if (k >= table->first && k + n <= table->first + table->count)
        return table->values + (k - table->first) * table->width;
    for (int i = 0; i < n; i++)
        table->evaluate(k + i, room + i * table->width);
    return room;
}

/* ------------------------------------------------------------- preparation */

static double days_since_j2000(const double jd[2])
{
    return (jd[0] - ERFA_DJ00) + jd[1];
}

static double tt_days_at(const run_clock *clock, double t_s)
{
    double tt_jd[2];
    run_clock_tt(clock, t_s, tt_jd);
    return days_since_j2000(tt_jd);
}

static bool cover_stretch(frame_grid *grid, double t0_s, double t1_s)
{
    const double d0 = tt_days_at(&grid->clock, t0_s - LIGHT_MARGIN_S);
    const double d1 = tt_days_at(&grid->clock, t1_s + LIGHT_MARGIN_S);
    return table_cover(&grid->cip, (int64_t)floor(d0 / CIP_STEP_DAYS) - 1,
                       (int64_t)floor(d1 / CIP_STEP_DAYS) + 2) &&
           table_cover(&grid->sun, (int64_t)floor(d0 / SUN_STEP_DAYS),
                       (int64_t)floor(d1 / SUN_STEP_DAYS) + 1);
}

glint_status frame_grid_prepare(const run_clock *clock, const earth_orientation *orientation,
                                double t0_s, double t1_s, double step_s, frame_grid **grid,
                                glint_error *error)
{
    if (!*grid) {
        *grid = calloc(1, sizeof **grid);
        if (!*grid) return error_no_memory(error);
        (*grid)->cip = (node_table){.evaluate = cip_node, .width = CIP_WIDTH};
        (*grid)->sun = (node_table){.evaluate = sun_node, .width = SUN_WIDTH};
    }
    frame_grid *g = *grid;
    g->clock = *clock;
    double polar[3][3];
    eraPom00(orientation->xp_rad, orientation->yp_rad, 0.0, polar);
    memcpy(g->polar, polar, sizeof g->polar);
    g->still = orientation->xp_rad == 0.0 && orientation->yp_rad == 0.0;
    g->full = step_s > CIP_STEP_DAYS * DAY_S;
    return g->full || cover_stretch(g, t0_s, t1_s) ? GLINT_OK : error_no_memory(error);
}

void frame_grid_free(frame_grid *grid)
{
    if (!grid) return;
    free(grid->cip.values);
    free(grid->sun.values);
    free(grid);
}

/* -------------------------------------------------------------- evaluation */

/* What follows is worked out moment by moment, or for a tile of moments at once: by the same lines,
 * and so to the same bits. */

/* Lagrange's cubic through four nodes at -1, 0, 1, 2; 0 <= u < 1. */
static inline void cip_between(const double *node, double u, double xys[CIP_WIDTH])
{
    const double a = u + 1.0, b = u - 1.0, c = u - 2.0, sixth = 1.0 / 6.0;
    const double w0 = -sixth * u * b * c, w1 = 0.5 * a * b * c, w2 = -0.5 * a * u * c,
                 w3 = sixth * a * u * b;
    for (int i = 0; i < CIP_WIDTH; i++)
        xys[i] = w0 * node[i] + w1 * node[3 + i] + w2 * node[6 + i] + w3 * node[9 + i];
}

/* Hermite's cubic for the Sun's place and its derivative for the rate; the Sun's own velocity (some
 * 15 m/s, over years) is linear between nodes. */
static inline void sun_between(const double *node, double u, double state[SUN_WIDTH])
{
    const double *next = node + SUN_WIDTH;
    const double h_s = SUN_STEP_DAYS * DAY_S, v = 1.0 - u;
    const double step = u * u * (3.0 - 2.0 * u), start = u * v * v * h_s, end = -u * u * v * h_s;
    const double d_step = 6.0 / h_s * (u * v), d_start = v * (1.0 - 3.0 * u),
                 d_end = u * (3.0 * u - 2.0);
    for (int i = 0; i < 3; i++) {
        const double change = next[i] - node[i];
        state[i] = node[i] + step * change + start * node[3 + i] + end * next[3 + i];
        state[3 + i] = d_step * change + d_start * node[3 + i] + d_end * next[3 + i];
        state[6 + i] = node[6 + i] + u * (next[6 + i] - node[6 + i]);
    }
}

/* GCRS to the intermediate frame, before the turn by -s about its pole: IERS Conventions 2010,
 * equation 5.10 (transposed), which is eraC2ixys without its six trigonometric functions. */
static inline void pole_matrix(double x, double y, double out[9])
{
    const double cos_d = sqrt(1.0 - x * x - y * y), a = 1.0 / (1.0 + cos_d);
    out[0] = 1.0 - a * x * x, out[1] = -a * x * y, out[2] = -x;
    out[3] = -a * x * y, out[4] = 1.0 - a * y * y, out[5] = -y;
    out[6] = x, out[7] = y, out[8] = cos_d;
}

/* R3(angle) M, where M is the pole's matrix and R3 turns the axes about the third one. */
static inline void turn_about_pole(double angle, const double xys[CIP_WIDTH], double out[9])
{
    double s, c, m[9];
    near_sin_cos(angle, &s, &c);
    pole_matrix(xys[0], xys[1], m);
    for (int j = 0; j < 3; j++) {
        out[j] = c * m[j] + s * m[3 + j];
        out[3 + j] = c * m[3 + j] - s * m[j];
        out[6 + j] = m[6 + j];
    }
}

/* The Earth rotation angle, rad, whole turns left out: IERS Conventions 2010, equation 5.15, which
 * is eraEra00. ut1_jd[0] is a multiple of 0.5 (run_clock_ut1 makes it so) and counts no turns but
 * a half one. */
static double rotation_angle(const double ut1_jd[2])
{
    const double half = ut1_jd[0] - floor(ut1_jd[0]), days = days_since_j2000(ut1_jd);
    return TWO_PI * (half + ut1_jd[1] + 0.7790572732640 + 0.00273781191135448 * days);
}

/* GMST82 less the Earth rotation angle, rad, but for whole turns: Aoki et al. 1982, Astron.
 * Astrophys. 105, 359, which is eraGmst82, in s of time. The time of day is in both angles and
 * cancels, but that theirs counts from midnight and a JD from noon: 43 200 s. */
static double gmst82_minus_rotation(const double ut1_jd[2])
{
    const double days = days_since_j2000(ut1_jd), centuries = days / 36525.0;
    const double slow_s =
        (8640184.812866 + (0.093104 - 6.2e-6 * centuries) * centuries) * centuries;
    const double turns = (24110.54841 - 43200.0 + slow_s) / DAY_S;
    return TWO_PI * (turns - 0.7790572732640 - 0.00273781191135448 * days);
}

/* The TIO locator s', rad: IERS Conventions 2010, equation 5.13, which is eraSp00. */
static double tio_locator(double tt_days)
{
    return -47e-6 * ARCSEC / 36525.0 * tt_days;
}

/* What the clocks say at one moment. */
typedef struct clock_angles {
    double tt_days;  /* from J2000.0 */
    double rotation; /* ERA + s', rad */
    double mean;     /* GMST82 - ERA - s', rad; only with FRAMES_TEME */
} clock_angles;

static clock_angles read_clocks(const frame_grid *grid, double t_s, unsigned wanted)
{
    double tt_jd[2], ut1_jd[2];
    run_clock_tt(&grid->clock, t_s, tt_jd);
    run_clock_ut1(&grid->clock, t_s, ut1_jd);
    clock_angles out = {.tt_days = days_since_j2000(tt_jd)};
    const double locator = tio_locator(out.tt_days);
    out.rotation = rotation_angle(ut1_jd) + locator;
    if (wanted & FRAMES_TEME) out.mean = gmst82_minus_rotation(ut1_jd) - locator;
    return out;
}

/* Turns TIRS into ITRS: polar motion of the clock's table or of the grid, without s'. */
static void add_polar_motion(const frame_grid *grid, double tt_days, double itrs_gcrs[9])
{
    if (grid->clock.eop) {
        const double tt_jd[2] = {ERFA_DJ00, tt_days};
        eop_values values;
        double rows[3][3], polar[9];
        eop_at(grid->clock.eop, tt_jd, &values);
        eraPom00(values.xp_rad, values.yp_rad, 0.0, rows);
        memcpy(polar, rows, sizeof polar);
        mat_mul(polar, itrs_gcrs, itrs_gcrs);
    } else if (!grid->still) {
        mat_mul(grid->polar, itrs_gcrs, itrs_gcrs);
    }
}

static void keep_sun(const double state[SUN_WIDTH], frame_set *out)
{
    copy3(state, out->sun_gcrs_m);
    copy3(state + 6, out->sun_velocity_m_s);
    sub3(state + 6, state + 3, out->earth_velocity_m_s);
}

/* With M the pole's matrix, ITRS = W R3(ERA + s' - s) M GCRS: the locators s and s' are turns about
 * the axis of the Earth's rotation and join its angle. TEME has no s', ITRS = W R3(GMST82) TEME;
 * so W, polar motion, cancels in TEME = R3(s' - s + ERA - GMST82) M GCRS. */
void frame_grid_at(const frame_grid *grid, double t_s, unsigned wanted, frame_set *out)
{
    double xys[CIP_WIDTH], state[SUN_WIDTH], room[CIP_NODES * CIP_WIDTH];
    const clock_angles clock = read_clocks(grid, t_s, wanted);
    if (grid->full) {
        cip_state(ERFA_DJ00, clock.tt_days, xys);
    } else {
        const double position = clock.tt_days / CIP_STEP_DAYS, base = floor(position);
        cip_between(table_nodes(&grid->cip, (int64_t)base - 1, CIP_NODES, room), position - base,
                    xys);
    }
    turn_about_pole(clock.rotation - xys[2], xys, out->itrs_gcrs);
    add_polar_motion(grid, clock.tt_days, out->itrs_gcrs);
    if (wanted & FRAMES_TEME) {
        turn_about_pole(-clock.mean - xys[2], xys, out->gcrs_teme);
        mat_transpose(out->gcrs_teme, out->gcrs_teme);
    }
    if (!(wanted & FRAMES_SUN)) return;
    if (grid->full) {
        sun_state(ERFA_DJ00, clock.tt_days, state);
    } else {
        double sun_room[SUN_NODES * SUN_WIDTH];
        const double position = clock.tt_days / SUN_STEP_DAYS, base = floor(position);
        sun_between(table_nodes(&grid->sun, (int64_t)base, SUN_NODES, sun_room), position - base,
                    state);
    }
    keep_sun(state, out);
}

/* ----------------------------------------------------------- tiles of moments */

/* A tile on its way: number j of moment k at [j][k]. */
typedef struct frame_lanes {
    double tt_days[FRAME_LANES], rotation[FRAME_LANES], mean[FRAME_LANES];
    double xys[CIP_WIDTH][FRAME_LANES];
    double itrs_gcrs[9][FRAME_LANES], teme_gcrs[9][FRAME_LANES], sun[SUN_WIDTH][FRAME_LANES];
} frame_lanes;

/* node: the first of those around all moments; base: the position of the one before them. */
CLONES FLATTEN static void itrs_lanes(const double *restrict node, double base,
                                      frame_lanes *restrict l)
{
    for (int k = 0; k < FRAME_LANES; k++) {
        double xys[CIP_WIDTH], m[9];
        cip_between(node, l->tt_days[k] / CIP_STEP_DAYS - base, xys);
        turn_about_pole(l->rotation[k] - xys[2], xys, m);
        for (int j = 0; j < CIP_WIDTH; j++)
            l->xys[j][k] = xys[j];
        for (int j = 0; j < 9; j++)
            l->itrs_gcrs[j][k] = m[j];
    }
}

CLONES FLATTEN static void teme_lanes(frame_lanes *l)
{
    for (int k = 0; k < FRAME_LANES; k++) {
        const double xys[CIP_WIDTH] = {l->xys[0][k], l->xys[1][k], l->xys[2][k]};
        double m[9];
        turn_about_pole(-l->mean[k] - xys[2], xys, m);
        for (int j = 0; j < 9; j++)
            l->teme_gcrs[j][k] = m[j];
    }
}

CLONES FLATTEN static void sun_lanes(const double *restrict node, double base,
                                     frame_lanes *restrict l)
{
    for (int k = 0; k < FRAME_LANES; k++) {
        double state[SUN_WIDTH];
        sun_between(node, l->tt_days[k] / SUN_STEP_DAYS - base, state);
        for (int j = 0; j < SUN_WIDTH; j++)
            l->sun[j][k] = state[j];
    }
}

/* True, with that position, when all moments stand between the same two nodes, and the table holds
 * all that interpolation takes: `before` nodes before them, and `n` in all. */
static bool same_cell(const node_table *table, const frame_lanes *l, double step_days, int before,
                      int n, double *base)
{
    *base = floor(l->tt_days[0] / step_days);
    for (int k = 1; k < FRAME_LANES; k++)
        if (floor(l->tt_days[k] / step_days) != *base) return false;
    const int64_t first = (int64_t)*base - before;
    return first >= table->first && first + n <= table->first + table->count;
}

static const double *node_of(const node_table *table, int64_t k)
{
    return table->values + (k - table->first) * table->width;
}

static void take_lane(const frame_grid *grid, const frame_lanes *l, int k, unsigned wanted,
                      frame_set *out)
{
    for (int j = 0; j < 9; j++)
        out->itrs_gcrs[j] = l->itrs_gcrs[j][k];
    add_polar_motion(grid, l->tt_days[k], out->itrs_gcrs);
    if (wanted & FRAMES_TEME)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                out->gcrs_teme[3 * i + j] = l->teme_gcrs[3 * j + i][k];
    if (!(wanted & FRAMES_SUN)) return;
    double state[SUN_WIDTH];
    for (int j = 0; j < SUN_WIDTH; j++)
        state[j] = l->sun[j][k];
    keep_sun(state, out);
}

void frame_grid_fill(const frame_grid *grid, const double *t_s, int n, unsigned wanted,
                     frame_set *out)
{
    frame_lanes lanes;
    for (int k = 0; k < FRAME_LANES; k++) {
        const clock_angles clock = read_clocks(grid, t_s[k < n ? k : n - 1], wanted);
        lanes.tt_days[k] = clock.tt_days;
        lanes.rotation[k] = clock.rotation;
        lanes.mean[k] = clock.mean;
    }
    double cip, sun;
    const bool together = !grid->full &&
                          same_cell(&grid->cip, &lanes, CIP_STEP_DAYS, 1, CIP_NODES, &cip) &&
                          same_cell(&grid->sun, &lanes, SUN_STEP_DAYS, 0, SUN_NODES, &sun);
    if (!together) {
        for (int k = 0; k < n; k++)
            frame_grid_at(grid, t_s[k], wanted, &out[k]);
        return;
    }
    itrs_lanes(node_of(&grid->cip, (int64_t)cip - 1), cip, &lanes);
    if (wanted & FRAMES_TEME) teme_lanes(&lanes);
    if (wanted & FRAMES_SUN) sun_lanes(node_of(&grid->sun, (int64_t)sun), sun, &lanes);
    for (int k = 0; k < n; k++)
        take_lane(grid, &lanes, k, wanted, &out[k]);
}

/* ---------------------------------------------------------------------- Sun */

void sun_from_point(const frame_set *frames, const double r_gcrs_m[3], bool aberration,
                    double sun_gcrs[3], double *distance_m)
{
    double to_sun[3];
    sub3(frames->sun_gcrs_m, r_gcrs_m, to_sun);
    *distance_m = norm3(to_sun);
    if (aberration) {
        /* The Sun as it stood when the light left it. */
        const double per_light_speed = 1.0 / LIGHT_SPEED_M_S;
        add_scaled3(to_sun, -*distance_m * per_light_speed, frames->sun_velocity_m_s, to_sun);
        /* Relativistic aberration (Explanatory Supplement 2013, equation 7.40) but for a common
         * factor: u/g + b + (u.b) b/(1 + 1/g), with b = v/c and 1/g = sqrt(1 - b^2), of which the
         * series ends here: b^4/8 is 1e-17. */
        double b[3];
        scale3(frames->earth_velocity_m_s, per_light_speed, b);
        const double inverse_gamma = 1.0 - 0.5 * dot3(b, b), length = norm3(to_sun);
        const double along = length + dot3(to_sun, b) / (1.0 + inverse_gamma);
        scale3(to_sun, inverse_gamma, to_sun);
        add_scaled3(to_sun, along, b, to_sun);
    }
    scale3(to_sun, 1.0 / norm3(to_sun), sun_gcrs);
}

void frame_bias(double eme2000_gcrs[9])
{
    double bias[3][3], precession[3][3], both[3][3];
    eraBp06(ERFA_DJ00, 0.0, bias, precession, both);
    memcpy(eme2000_gcrs, bias, sizeof bias);
}
