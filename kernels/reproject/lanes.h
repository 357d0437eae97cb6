/* Sixteen neighbours of a row of the mesh side by side, in the arithmetic of lib/vector.h and
 * lib/camera.h. */
#ifndef MACULA_REPROJECT_LANES_H
#define MACULA_REPROJECT_LANES_H

#include "lib/camera.h"
#include "lib/mesh_cells.h"
#include "lib/simd.h"
#include "lib/vector16.h"
#include "reproject/motion.h"
#include "shared/surface.h"
#include "shared/weier.h"

typedef struct Quad16 {
    float16 x, y, z, w;
} Quad16;

/* Entries from `first` on; the last one is repeated where there are fewer. */
MACULA_ALWAYS_INLINE float16 load_lanes(global const float* values, uint first, uint count) {
    if (first + 16u <= count)
        return vload16(0, values + first);
    float copy[16];
    for (uint lane = 0u; lane < 16u; ++lane)
        copy[lane] = values[min(first + lane, count - 1u)];
    return vload16(0, copy);
}

MACULA_ALWAYS_INLINE Quad16 load_quads(global const float4* values, uint first, uint count) {
    float16 a, b, c, d;
    if (first + 16u <= count) {
        global const float* from = (global const float*)(values + first);
        a = vload16(0, from), b = vload16(1, from), c = vload16(2, from), d = vload16(3, from);
    } else {
        float copy[64];
        for (uint lane = 0u; lane < 16u; ++lane)
            vstore4(values[min(first + lane, count - 1u)], lane, copy);
        a = vload16(0, copy), b = vload16(1, copy), c = vload16(2, copy), d = vload16(3, copy);
    }
    Quad16 q;
    q.x = (float16)(a.s048c, b.s048c, c.s048c, d.s048c);
    q.y = (float16)(a.s159d, b.s159d, c.s159d, d.s159d);
    q.z = (float16)(a.s26ae, b.s26ae, c.s26ae, d.s26ae);
    q.w = (float16)(a.s37bf, b.s37bf, c.s37bf, d.s37bf);
    return q;
}

/* The same for entries that need not exist: `first` may be -1. */
MACULA_ALWAYS_INLINE uint16 load_row_lanes(global const uint* row, int first, uint count) {
    if (first >= 0 && (uint)first + 16u <= count)
        return vload16(0, row + first);
    uint copy[16];
    for (int lane = 0; lane < 16; ++lane)
        copy[lane] = row[clamp(first + lane, 0, (int)count - 1)];
    return vload16(0, copy);
}

/* Inverse depths of support samples, 0 where one is not a depth. */
MACULA_ALWAYS_INLINE float16 inverse_depths(float16 depth) {
    const int16 valid = (depth > 0.0f) & (depth <= MACULA_BACKGROUND_DEPTH);
    const float16 inverse = m_divide((float16)(1.0f), valid ? depth : (float16)(1.0f));
    return valid ? inverse : (float16)(0.0f);
}

/* World-space directions through the places x, y of last frame's image; their depth is 1. */
MACULA_ALWAYS_INLINE Vector16 past_rays(global const FrameParams* frame, float16 x, float y) {
    global const Camera* camera = &frame->previous_camera;
    const float step_x = m_divide(camera->tan_right + camera->tan_left, (float)frame->width);
    const float step_y = m_divide(camera->tan_up + camera->tan_down, (float)frame->height);
    const float16 sx = fma(x, (float16)(step_x), (float16)(-camera->tan_left));
    const float sy = fma(y, -step_y, camera->tan_up);
    const float3 above = scale_add3(vector_at(camera->up), sy, vector_at(camera->forward));
    Vector16 ray;
    ray.x = fma((float16)(camera->right[0]), sx, (float16)(above.x));
    ray.y = fma((float16)(camera->right[1]), sx, (float16)(above.y));
    ray.z = fma((float16)(camera->right[2]), sx, (float16)(above.z));
    return ray;
}

/* Vertices (lib/reprojection.h) on the rays of last frame's image, at inverse depths, moved with
 * their objects; z is -1 where that depth is 0 or the vertex is not in front of the camera. */
MACULA_ALWAYS_INLINE Quad16 project_vertices(global const FrameParams* frame,
                                             const Motions* motions, uint16 motion,
                                             const Vector16* ray, float16 inverse) {
    global const Camera *past = &frame->previous_camera, *now = &frame->camera;
    const float16 depth = m_divide((float16)(1.0f), inverse > 0.0f ? inverse : (float16)(1.0f));
    const float3 moved = vector_at(past->origin) - vector_at(now->origin);
    Vector16 view;
    view.x = fma(ray->x, depth, (float16)(moved.x));
    view.y = fma(ray->y, depth, (float16)(moved.y));
    view.z = fma(ray->z, depth, (float16)(moved.z));
    if (motions->moved != 0u && any_lane16(motion != 0u))
        move_views(motions, motion, ray, depth, vector_at(past->origin), vector_at(now->origin),
                   &view);
    const float16 z = dot3(view, spread16(vector_at(now->forward)));
    const int16 seen = (inverse > 0.0f) & (z > 1e-20f);
    const float16 kept = seen ? z : (float16)(1.0f);
    const float16 share = m_divide((float16)(1.0f), kept);
    const float16 sx = dot3(view, spread16(vector_at(now->right))) * share;
    const float16 sy = dot3(view, spread16(vector_at(now->up))) * share;
    const float16 x = m_divide(sx + now->tan_left, (float16)(now->tan_right + now->tan_left)) *
                      (float)frame->width;
    const float16 y =
        m_divide(now->tan_up - sy, (float16)(now->tan_up + now->tan_down)) * (float)frame->height;
    Quad16 v;
    v.x = seen ? m_min(m_max(x, (float16)(-1e6f)), (float16)(1e6f)) : (float16)(0.0f);
    v.y = seen ? m_min(m_max(y, (float16)(-1e6f)), (float16)(1e6f)) : (float16)(0.0f);
    v.z = seen ? share : (float16)(-1.0f);
    v.w = seen ? m_divide(depth, kept) : (float16)(0.0f);
    return v;
}

#endif
