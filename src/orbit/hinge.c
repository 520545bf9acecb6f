#include "orbit/hinge.h"

#include "base/vec.h"

glint_status hinge_set_face(hinge *h, const double face[3], place where, glint_error *error)
{
    double unit[3];
    if (!(unit3(face, unit) > 0.0))
        return error_set(error, GLINT_INPUT, where, "'face' is zero; expected a direction");
    if (!(perp3(unit, h->axis, h->face) > DIRECTION_PARALLEL))
        return error_set(error, GLINT_INPUT, where,
                         "'face' is parallel to the hinge's axis within %g, so no angle turns it "
                         "towards anything",
                         DIRECTION_PARALLEL);
    return GLINT_OK;
}

/* Turned by delta the face is n0 cos(delta) + (a x n0) sin(delta); its component along s is largest
 * at this delta. */
static double track_angle(const hinge *h, const double target_parent[3])
{
    double across[3];
    cross3(h->axis, h->face, across);
    const double c = dot3(target_parent, h->face), s = dot3(target_parent, across);
    return c * c + s * s > DIRECTION_PARALLEL * DIRECTION_PARALLEL ? atan2(s, c) : 0.0;
}

double hinge_angle(const hinge *h, double t_s, const double target_parent[3])
{
    double angle = h->angle;
    if (h->drive == HINGE_RATE) angle += h->rate_rad_s * (t_s - h->epoch_s);
    if (h->drive == HINGE_TRACK) angle = track_angle(h, target_parent);
    angle += h->offset;
    return h->has_limits ? fmin(fmax(angle, h->limits[0]), h->limits[1]) : angle;
}

/* The component turns right-handed by `angle` in its parent, so a vector that stays where it is
 * turns by the opposite angle in the component's coordinates. */
void hinge_matrix(const hinge *h, double angle, double component_parent[9])
{
    mat_turn(h->axis, -angle, component_parent);
}
