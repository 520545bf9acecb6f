#include "lightcurve/watch.h"

#include "base/constants.h"

void watch_free(watch *w)
{
    if (!w->borrowed) frame_grid_free(w->grid);
    *w = (watch){0};
}

void watch_borrow(watch *w, const watch *lender)
{
    if (!w->borrowed) frame_grid_free(w->grid);
    w->grid = lender->grid;
    w->from_s = lender->from_s;
    w->to_s = lender->to_s;
    w->borrowed = true;
}

glint_status watch_cover(watch *w, double first_s, double last_s, glint_error *error)
{
    /* The nodes of the grid are dear, so that it reaches ahead; searches look back a little, too.
     */
    static const double AHEAD_S = 2 * DAY_S, BEHIND_S = 600;
    static const double GRID_STEP_S = 1; /* any below the grid's own: it is never passed by */
    if (w->grid && first_s >= w->from_s && last_s <= w->to_s) return GLINT_OK;
    const earth_orientation still = {0, 0};
    const double from_s = first_s - BEHIND_S, to_s = last_s + AHEAD_S;
    if (w->borrowed) w->grid = NULL;
    w->borrowed = false;
    const glint_status status =
        frame_grid_prepare(&w->s->clock, &still, from_s, to_s, GRID_STEP_S, &w->grid, error);
    if (status) return status;
    w->from_s = from_s;
    w->to_s = to_s;
    return GLINT_OK;
}

glint_status watch_at(watch *w, double t_s, sighting *out, glint_error *error)
{
    glint_status status = watch_cover(w, t_s, t_s, error);
    if (!status) status = sighting_at(w->s, w->grid, t_s, w->light_time_s, &w->viewer, out, error);
    if (!status) w->light_time_s = out->light_time_s;
    return status;
}
