#include "orbit/direction.h"

#include "base/text.h"
#include "base/vec.h"
#include "orbit/earth.h"

static const char *const words[] = {"nadir",    "geodetic-nadir", "zenith",
                                    "velocity", "orbit-normal",   "north",
                                    "sun",      "moon",           "observer"};
enum { N_WORDS = sizeof words / sizeof *words };
_Static_assert((int)N_WORDS == (int)DIRECTION_STAR, "the words follow the enum");

const char *direction_word(size_t k)
{
    return k < N_WORDS ? words[k] : NULL;
}

bool direction_from_word(const char *word, direction *out)
{
    for (size_t k = 0; k < N_WORDS; k++)
        if (string_equal(word, words[k])) {
            *out = (direction){.kind = (direction_kind)k};
            return true;
        }
    return false;
}

const char *direction_name(const direction *d)
{
    if (d->kind == DIRECTION_STAR) return "{ ra_deg, dec_deg }";
    if (d->kind == DIRECTION_PLACE) return "{ latitude_deg, longitude_deg }";
    return words[d->kind];
}

void direction_star(double ra, double dec, direction *out)
{
    *out = (direction){.kind = DIRECTION_STAR,
                       .star = {cos(dec) * cos(ra), cos(dec) * sin(ra), sin(dec)}};
}

glint_status direction_place(double latitude, double longitude, double height_m, direction *out,
                             glint_error *error)
{
    earth_site site;
    const glint_status status = earth_site_at(latitude, longitude, height_m, &site, error);
    if (status) return status;
    *out = (direction){.kind = DIRECTION_PLACE};
    copy3(site.r_itrs_m, out->place_itrs_m);
    return GLINT_OK;
}

/* Where a direction is not defined, the functions below leave `out`, which comes zeroed, alone. */

static void geodetic_nadir(const moment *m, double out[3])
{
    if (!(norm3(m->r_m) > 0.0)) return;
    double r_itrs_m[3], nadir_itrs[3];
    mat_vec(m->itrs_gcrs, m->r_m, r_itrs_m);
    earth_geodetic_nadir(r_itrs_m, nadir_itrs);
    mat_tvec(m->itrs_gcrs, nadir_itrs, out);
}

/* r x v by way of v's part normal to r, which stays accurate where the two are nearly parallel. */
static void orbit_normal(const moment *m, double out[3])
{
    double radial[3], forward[3], along[3];
    unit3(m->r_m, radial);
    unit3(m->v_m_s, forward);
    if (perp3(forward, radial, along) > DIRECTION_PARALLEL) cross3(radial, along, out);
}

/* Below 1 mm the rounding of the positions (1e-8 m) would start to show in the direction. */
static void to_place(const double place_itrs_m[3], const moment *m, double out[3])
{
    static const double nearest_m = 1e-3;
    double place_m[3], way_m[3];
    mat_tvec(m->itrs_gcrs, place_itrs_m, place_m);
    sub3(place_m, m->r_m, way_m);
    if (norm3(way_m) >= nearest_m) copy3(way_m, out);
}

static const char *why_undefined(direction_kind kind)
{
    switch (kind) {
    case DIRECTION_NADIR:
    case DIRECTION_GEODETIC_NADIR:
    case DIRECTION_ZENITH:
        return "the satellite is at the Earth's centre";
    case DIRECTION_VELOCITY:
        return "the satellite is at rest";
    case DIRECTION_ORBIT_NORMAL:
        return "position and velocity are parallel";
    case DIRECTION_PLACE:
        return "the satellite is at that place";
    default:
        return "it is not known in this run";
    }
}

/* The direction in GCRS, of any length. */
static void vector_at(const direction *d, const moment *m, double out[3])
{
    static const double north[3] = {0, 0, 1};
    switch (d->kind) {
    case DIRECTION_NADIR:
        scale3(m->r_m, -1.0, out);
        break;
    case DIRECTION_GEODETIC_NADIR:
        geodetic_nadir(m, out);
        break;
    case DIRECTION_ZENITH:
        copy3(m->r_m, out);
        break;
    case DIRECTION_VELOCITY:
        copy3(m->v_m_s, out);
        break;
    case DIRECTION_ORBIT_NORMAL:
        orbit_normal(m, out);
        break;
    case DIRECTION_NORTH:
        copy3(north, out);
        break;
    case DIRECTION_SUN:
        copy3(m->sun, out);
        break;
    case DIRECTION_MOON:
        copy3(m->moon, out);
        break;
    case DIRECTION_OBSERVER:
        copy3(m->observer, out);
        break;
    case DIRECTION_STAR:
        copy3(d->star, out);
        break;
    case DIRECTION_PLACE:
        to_place(d->place_itrs_m, m, out);
        break;
    }
}

glint_status direction_at(const direction *d, const moment *m, double out[3], glint_error *error)
{
    double v[3] = {0, 0, 0};
    vector_at(d, m, v);
    if (unit3(v, out) > 0.0) return GLINT_OK;
    return error_set(error, GLINT_INPUT, PLACE_NONE,
                     "the direction '%s' is not defined at %.10g s from the start: %s",
                     direction_name(d), m->t_s, why_undefined(d->kind));
}
