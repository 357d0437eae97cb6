/* A camera's ray on its way into the queue. OpenCL C only. */
#ifndef MACULA_LIB_CAMERA_RAY_H
#define MACULA_LIB_CAMERA_RAY_H

#include "lib/camera.h"
#include "shared/ray.h"
#include "shared/surface.h"

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

/* The ray of sample `sample` of pixel `slot` of the order of lib/camera.h for width x height pixels
 * that cover the view. pixels: the pixel's index, MACULA_NO_PIXEL beyond the last. The launch
 * covers slot_count(width, height), which is the ray count. */
static inline void generate_camera_ray(global const FrameParams* frame, uint width, uint height,
                                       uint sample, uint slot, global RayBlock* rays,
                                       global uint* pixels, global uint* ray_count,
                                       global ulong* total) {
    uint x, y;
    pixel_of_slot(slot, width, &x, &y);
    const bool inside = x < width && y < height;
    const uint pixel = y * width + x;
    float dx, dy;
    sample_offset(frame, random_key(pixel, frame->frame, frame->seed), sample, frame->sample_grid,
                  &dx, &dy);
    const float3 direction =
        camera_direction(&frame->camera, width, height, (float)x + dx, (float)y + dy);
    store_camera_ray(frame, rays, slot, direction, inside ? MACULA_BACKGROUND_DEPTH : -1.0f);
    pixels[slot] = inside ? pixel : MACULA_NO_PIXEL;
    if (slot == 0u) {
        *ray_count = (uint)get_global_size(0);
        *total += width * height;
    }
}

/* Fills the list's last ray block with inactive rays. */
static inline void pad_list(global RayBlock* rays, global uint* pixels, uint total) {
    for (uint slot = total; slot % MACULA_RAY_BLOCK != 0u; ++slot) {
        global RayBlock* block = rays + slot / MACULA_RAY_BLOCK;
        const uint lane = slot % MACULA_RAY_BLOCK;
        block->origin_x[lane] = block->origin_y[lane] = block->origin_z[lane] = 0.0f;
        block->t_min[lane] = 0.0f;
        block->direction_x[lane] = block->direction_y[lane] = 0.0f;
        block->direction_z[lane] = 1.0f;
        block->t_max[lane] = -1.0f;
        pixels[slot] = MACULA_NO_PIXEL;
    }
}

#endif
