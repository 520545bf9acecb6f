#include "facets/rays.h"

#include <embree3/rtcore.h>
#include <stdlib.h>

struct ray_scene {
    RTCDevice device; /* owned */
    RTCScene scene;   /* owned */
};

bool rays_are_built(void)
{
    return true;
}

static bool fill_buffers(RTCGeometry geometry, const double (*vertices)[3], int n_vertices,
                         const int (*triangles)[3], int n_triangles)
{
    float *to = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                        3 * sizeof *to, (size_t)n_vertices);
    unsigned *corner = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                               3 * sizeof *corner, (size_t)n_triangles);
    if (!to || !corner) return false;
    for (int k = 0; k < n_vertices; k++)
        for (int j = 0; j < 3; j++)
            *to++ = (float)vertices[k][j];
    for (int k = 0; k < n_triangles; k++)
        for (int j = 0; j < 3; j++)
            *corner++ = (unsigned)triangles[k][j];
    return true;
}

/* Robust: without it rays slip through between triangles that meet. One thread: the tree that
 * Embree builds is then always the same. */
glint_status ray_scene_make(const double (*vertices)[3], int n_vertices, const int (*triangles)[3],
                            int n_triangles, ray_scene **out, glint_error *error)
{
    *out = NULL;
    ray_scene *s = calloc(1, sizeof *s);
    if (!s) return error_no_memory(error);
    s->device = rtcNewDevice("threads=1");
    if (s->device) s->scene = rtcNewScene(s->device);
    RTCGeometry geometry = s->scene ? rtcNewGeometry(s->device, RTC_GEOMETRY_TYPE_TRIANGLE) : NULL;
    const bool ok =
        geometry && fill_buffers(geometry, vertices, n_vertices, triangles, n_triangles);
    if (ok) {
        rtcSetSceneFlags(s->scene, RTC_SCENE_FLAG_ROBUST);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(s->scene, geometry);
        rtcCommitScene(s->scene);
    }
    if (geometry) rtcReleaseGeometry(geometry);
    if (!ok || rtcGetDeviceError(s->device) != RTC_ERROR_NONE) {
        ray_scene_free(s);
        return error_no_memory(error);
    }
    *out = s;
    return GLINT_OK;
}

void ray_scene_free(ray_scene *s)
{
    if (!s) return;
    if (s->scene) rtcReleaseScene(s->scene);
    if (s->device) rtcReleaseDevice(s->device);
    free(s);
}

void ray_scene_meet(const ray_scene *scene, const double (*origin_m)[3], const double direction[3],
                    int n, bool *met)
{
    _Alignas(32) int valid[RAY_BATCH];
    struct RTCRay8 rays = {0};
    for (int k = 0; k < RAY_BATCH; k++) {
        const double *from = origin_m[k < n ? k : 0];
        valid[k] = k < n && !met[k] ? -1 : 0;
        rays.org_x[k] = (float)from[0], rays.dir_x[k] = (float)direction[0];
        rays.org_y[k] = (float)from[1], rays.dir_y[k] = (float)direction[1];
        rays.org_z[k] = (float)from[2], rays.dir_z[k] = (float)direction[2];
        rays.tfar[k] = __builtin_inff();
        rays.mask[k] = ~0u;
    }
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded8(valid, scene->scene, &context, &rays);
    for (int k = 0; k < n; k++)
        met[k] = met[k] || rays.tfar[k] < 0.0f; /* Embree's mark of a ray that met something */
}
