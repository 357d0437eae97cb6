/* From ray slots to pixels, from pixels to rays, and from points back to pixels. */
#ifndef MACULA_LIB_CAMERA_H
#define MACULA_LIB_CAMERA_H

#include "lib/lanes.h"
#include "lib/random.h"
#include "shared/camera.h"

MACULA_SHARED_BEGIN

/* Order of the primary rays: tiles of 32 x 32 pixels, row by row; inside a tile 4 x 4 pixel
 * packets in Morton order; inside a packet row by row. Sixteen neighbouring slots are thus one
 * coherent packet (one RayBlock), and a few hundred are one compact neighbourhood. Tiles cross the
 * right and lower edge of the image; their slots outside it stay inactive. */
#define MACULA_TILE 32u
#define MACULA_TILE_SLOTS 1024u
#define MACULA_NO_PIXEL 0xffffffffu

MACULA_ALWAYS_INLINE uint tiles_across(uint pixels) {
    return (pixels + MACULA_TILE - 1u) / MACULA_TILE;
}

MACULA_ALWAYS_INLINE uint slot_count(uint width, uint height) {
    return tiles_across(width) * tiles_across(height) * MACULA_TILE_SLOTS;
}

MACULA_ALWAYS_INLINE void pixel_of_slot(uint slot, uint width, uint* x, uint* y) {
    const uint tile = slot / MACULA_TILE_SLOTS, across = tiles_across(width);
    const uint packet = (slot >> 4) & 63u, lane = slot & 15u;
    const uint packet_x = (packet & 1u) | ((packet >> 1) & 2u) | ((packet >> 2) & 4u);
    const uint packet_y = ((packet >> 1) & 1u) | ((packet >> 2) & 2u) | ((packet >> 3) & 4u);
    *x = (tile % across) * MACULA_TILE + packet_x * 4u + (lane & 3u);
    *y = (tile / across) * MACULA_TILE + packet_y * 4u + (lane >> 2);
}

MACULA_ALWAYS_INLINE uint slot_of_pixel(uint x, uint y, uint width) {
    const uint tile = (y / MACULA_TILE) * tiles_across(width) + x / MACULA_TILE;
    const uint px = (x >> 2) & 7u, py = (y >> 2) & 7u;
    const uint packet = (px & 1u) | ((py & 1u) << 1) | ((px & 2u) << 1) | ((py & 2u) << 2) |
                        ((px & 4u) << 2) | ((py & 4u) << 3);
    return tile * MACULA_TILE_SLOTS + packet * 16u + (y & 3u) * 4u + (x & 3u);
}

/* Where sample `sample` of a pixel lies inside it, in [0, 1)^2: the middle of a cell of the regular
 * grid (of the pixel itself for one sample), else a hashed offset. */
MACULA_ALWAYS_INLINE void subpixel_offset(uint key, uint sample, uint grid, float* x, float* y) {
    if (grid > 0u) {
        const float cell = m_divide(0.5f, (float)grid);
        *x = (float)(2u * (sample % grid) + 1u) * cell;
        *y = (float)(2u * (sample / grid) + 1u) * cell;
    } else {
        *x = random_unit(key, sample, MACULA_DIMENSION_PIXEL);
        *y = random_unit(key, sample, MACULA_DIMENSION_PIXEL + 1u);
    }
}

/* The same for a sample of a frame, whose jitter may put it beyond the pixel's edge. */
MACULA_ALWAYS_INLINE void sample_offset(MACULA_GLOBAL const FrameParams* frame, uint key,
                                        uint sample, uint grid, float* x, float* y) {
    subpixel_offset(key, sample, grid, x, y);
    *x += frame->jitter[0];
    *y += frame->jitter[1];
}

/* Direction through the image point (x, y) in pixels; its component along `forward` is 1. */
MACULA_ALWAYS_INLINE float3 camera_direction(MACULA_GLOBAL const Camera* camera, uint width,
                                             uint height, float x, float y) {
    const float step_x = m_divide(camera->tan_right + camera->tan_left, (float)width);
    const float step_y = m_divide(camera->tan_up + camera->tan_down, (float)height);
    const float sx = fma(x, step_x, -camera->tan_left);
    const float sy = fma(y, -step_y, camera->tan_up);
    return scale_add3(vector_at(camera->right), sx,
                      scale_add3(vector_at(camera->up), sy, vector_at(camera->forward)));
}

/* The image point in pixels to which the vector from the camera's origin projects; false, and any
 * point, where it does not lie in front of the camera. */
MACULA_ALWAYS_INLINE Mask camera_project(MACULA_GLOBAL const Camera* camera, uint width,
                                         uint height, Real3 view, Real* x, Real* y) {
    const Real z = dot3(view, splat_vector(vector_at(camera->forward)));
    const Mask ahead = z > splat(1e-20f);
    const Real inverse = m_divide(splat(1.0f), ahead ? z : splat(1.0f));
    const Real sx = dot3(view, splat_vector(vector_at(camera->right))) * inverse;
    const Real sy = dot3(view, splat_vector(vector_at(camera->up))) * inverse;
    *x =
        m_divide(sx + camera->tan_left, splat(camera->tan_right + camera->tan_left)) * (float)width;
    *y = m_divide(camera->tan_up - sy, splat(camera->tan_up + camera->tan_down)) * (float)height;
    return ahead;
}

MACULA_SHARED_END
#endif
