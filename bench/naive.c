#include "naive.h"

#include "base/constants.h"
#include "base/vec.h"

double naive_lambert(const naive_facet *facets, int n, const naive_material *m, const double i[3],
                     const double r[3])
{
    double sum = 0.0;
    for (int j = 0; j < n; j++) {
        const naive_facet *facet = &facets[j];
        const double ci = dot3(i, facet->normal), cr = dot3(r, facet->normal);
        if (ci <= 0.0 || cr <= 0.0) continue;
        sum += m->rho_d / PI * ci * cr * facet->area_m2;
    }
    return sum;
}

double naive_ward(const naive_facet *facets, int n, const naive_material *m, const double i[3],
                  const double r[3])
{
    double sum = 0.0, h[3];
    add3(i, r, h);
    scale3(h, 1.0 / norm3(h), h);
    for (int j = 0; j < n; j++) {
        const naive_facet *facet = &facets[j];
        const double ci = dot3(i, facet->normal), cr = dot3(r, facet->normal);
        if (ci <= 0.0 || cr <= 0.0) continue;
        const double x = dot3(h, facet->tangent) / m->alpha_x;
        const double y = dot3(h, facet->bitangent) / m->alpha_y;
        const double lobe = exp(-2.0 * (x * x + y * y) / (1.0 + dot3(h, facet->normal)));
        const double f =
            m->rho_d / PI + m->rho_s / (4.0 * PI * m->alpha_x * m->alpha_y * sqrt(ci * cr)) * lobe;
        sum += f * ci * cr * facet->area_m2;
    }
    return sum;
}

double naive_ward_gmd(const naive_facet *facets, int n, const naive_material *m, const double i[3],
                      const double r[3])
{
    double sum = 0.0, h[3];
    add3(i, r, h);
    for (int j = 0; j < n; j++) {
        const naive_facet *facet = &facets[j];
        const double ci = dot3(i, facet->normal), cr = dot3(r, facet->normal);
        if (ci <= 0.0 || cr <= 0.0) continue;
        const double x = dot3(h, facet->tangent) / m->alpha_x;
        const double y = dot3(h, facet->bitangent) / m->alpha_y;
        const double z = dot3(h, facet->normal);
        const double lobe = exp(-(x * x + y * y) / (z * z)) * dot3(h, h) / (z * z * z * z);
        const double f = m->rho_d / PI + m->rho_s / (PI * m->alpha_x * m->alpha_y) * lobe;
        sum += f * ci * cr * facet->area_m2;
    }
    return sum;
}
