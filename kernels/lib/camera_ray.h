/* A camera's ray on its way into the queue. OpenCL C only. */
#ifndef MACULA_LIB_CAMERA_RAY_H
#define MACULA_LIB_CAMERA_RAY_H

#include "lib/camera.h"
#include "shared/ray.h"

/* `t_max`: -1 for a ray that is not to be traced. */
static inline void store_camera_ray(global const FrameParams* frame, global RayBlock* rays,
                                    uint slot, float3 direction, float t_max) {
    global RayBlock* block = rays + slot / MACULA_RAY_BLOCK;
    const uint lane = slot % MACULA_RAY_BLOCK;
    block->origin_x[lane] = frame->camera.origin[0];
    block->origin_y[lane] = frame->camera.origin[1];
    block->origin_z[lane] = frame->camera.origin[2];
    block->t_min[lane] = 0.0f;
    block->direction_x[lane] = direction.x;
    block->direction_y[lane] = direction.y;
    block->direction_z[lane] = direction.z;
    block->t_max[lane] = t_max;
}

#endif
