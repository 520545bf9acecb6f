#include "facets/batch.h"

#include <math.h>

static const double ZERO = 0.0, ONE = 1.0;
const brdf_facets BATCH_FACET = {.n = 1,
                                 .normal = {&ZERO, &ZERO, &ONE},
                                 .tangent = {&ONE, &ZERO, &ZERO},
                                 .bitangent = {&ZERO, &ONE, &ZERO},
                                 .area = &ONE};

/* The pairs in the frames of their own normals: n = (x, y, 1) made unit, and the tangent (1, 0, 0)
 * made orthogonal to it. */
static void turn_into_frames(const batch *b, brdf_light *light)
{
    for (int k = 0; k < BRDF_TILE; k++) {
        const double x = b->x[k], y = b->y[k];
        const double c = 1.0 + y * y, q = c + x * x, n_scale = 1.0 / sqrt(q);
        const double b_scale = 1.0 / sqrt(c), t_scale = n_scale * b_scale;
        const double i0 = b->i[0][k], i1 = b->i[1][k], i2 = b->i[2][k];
        const double r0 = b->r[0][k], r1 = b->r[1][k], r2 = b->r[2][k];
        light->i[0][k] = (c * i0 - x * (y * i1 + i2)) * t_scale;
        light->i[1][k] = (i1 - y * i2) * b_scale;
        light->i[2][k] = (x * i0 + y * i1 + i2) * n_scale;
        light->r[0][k] = (c * r0 - x * (y * r1 + r2)) * t_scale;
        light->r[1][k] = (r1 - y * r2) * b_scale;
        light->r[2][k] = (x * r0 + y * r1 + r2) * n_scale;
    }
}

void batch_flush(batch *b)
{
    if (b->n == 0) return;
    for (int k = b->n; k < BRDF_TILE; k++) { /* spare lanes */
        for (int j = 0; j < 3; j++)
            b->i[j][k] = b->i[j][0], b->r[j][k] = b->r[j][0];
        b->x[k] = b->y[k] = b->area_m2[k] = 0.0;
    }
    brdf_light light;
    turn_into_frames(b, &light);
    brdf_light_finish(&light);
    double sum[BRDF_TILE] = {0};
    brdf_material_tile(b->material, &BATCH_FACET, &light, b->area_m2, sum);
    for (int k = 0; k < b->n; k++)
        b->sum[b->lane[k]] += sum[k];
    b->n = 0;
}

void batch_push(batch *b, int lane, const double i[3], const double r[3], double x, double y,
                double area_m2)
{
    const int k = b->n++;
    for (int j = 0; j < 3; j++)
        b->i[j][k] = i[j], b->r[j][k] = r[j];
    b->x[k] = x;
    b->y[k] = y;
    b->area_m2[k] = area_m2;
    b->lane[k] = lane;
    if (b->n == BRDF_TILE) batch_flush(b);
}
