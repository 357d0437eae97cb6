/* One ray through the middle of each block of the rings around the gaze (Smith et al. 2014, section
 * 3.2.1, figure 8). Blocks are listed by packets of 4 x 4 pixels in the order of lib/camera.h, so
 * that neighbours in the list lie close together, whatever their size. */
#include "lib/camera_ray.h"
#include "lib/random.h"
#include "lib/rings.h"

/* One work-item. */
kernel void place_rings(global const FrameParams* restrict frame,
                        global const RingParams* restrict params, global Rings* restrict rings) {
    place_rings_of(frame, params, rings);
}

/* Bits of four pixels from `at` on that lie in first <= x < end. */
static inline uint four_in(int first, int end, int at) {
    const int from = clamp(first - at, 0, 4), to = clamp(end - at, 0, 4);
    return to > from ? (1u << to) - (1u << from) : 0u;
}

/* Bit 4 y + x for the columns and rows of a packet. */
static inline uint sixteen(uint columns, uint rows) {
    return columns * ((rows & 1u) | (rows & 2u) << 3 | (rows & 4u) << 6 | (rows & 8u) << 9);
}

static inline uint bits_within(global const Rings* rings, uint k, int x0, int y0) {
    return sixteen(four_in(rings->left[k], rings->right[k], x0),
                   four_in(rings->top[k], rings->bottom[k], y0));
}

/* One work-item a packet. masks: bit n is set where a block begins in lane n. */
kernel void choose_blocks(global const FrameParams* restrict frame,
                          global const Rings* restrict rings, global uint* restrict masks,
                          global uint* restrict counts) {
    const uint packet = (uint)get_global_id(0);
    uint column, row;
    pixel_of_slot(packet * MACULA_RAY_BLOCK, frame->width, &column, &row);
    const int x0 = (int)column, y0 = (int)row;
    const uint pixels = bits_within(rings, 0u, x0, y0);
    const uint pairs = bits_within(rings, 1u, x0, y0) & ~pixels;
    /* A packet lies on one side of the other edges. */
    const bool widest = !touches_ring(rings, 2u, x0, y0, x0 + 4, y0 + 4);
    const uint first = widest && ((x0 | y0) & 4) != 0 ? 0u : 1u;
    const uint wide = touches_ring(rings, 1u, x0, y0, x0 + 4, y0 + 4) ? 0u : first;
    const uint inside =
        sixteen(four_in(0, (int)frame->width, x0), four_in(0, (int)frame->height, y0));
    const uint bits = (pixels | (pairs & 0x0505u) | wide) & inside;
    masks[packet] = bits;
    counts[packet] = popcount(bits);
}

/* The ray of sample `sample` of a block, of which the image shows width x height pixels. */
static inline void write_ray(global const FrameParams* frame, uint sample, uint x, uint y,
                             float width, float height, global RayBlock* rays, uint slot) {
    const uint key = random_key(y * frame->width + x, frame->frame, frame->seed);
    float dx, dy;
    sample_offset(frame, key, sample, frame->sample_grid, &dx, &dy);
    const float3 direction =
        camera_direction(&frame->camera, frame->width, frame->height, fma(dx, width, (float)x),
                         fma(dy, height, (float)y));
    store_camera_ray(frame, rays, slot, direction, MACULA_BACKGROUND_DEPTH);
}

/* One work-item a packet. pixels: the block's first one; spreads: the block's width. */
kernel void generate_block_rays(global const FrameParams* restrict frame,
                                global const Rings* restrict rings, uint sample,
                                global const uint* restrict masks,
                                global const uint* restrict offsets,
                                global const uint* restrict total, global RayBlock* restrict rays,
                                global uint* restrict pixels, global float* restrict spreads,
                                global uint* restrict ray_count, global ulong* restrict ray_totals,
                                uint ray_class) {
    const uint packet = (uint)get_global_id(0);
    if (packet == 0u) {
        pad_list(rays, pixels, *total);
        for (uint slot = *total; slot % MACULA_RAY_BLOCK != 0u; ++slot)
            spreads[slot] = 1.0f;
        *ray_count = (*total + MACULA_RAY_BLOCK - 1u) / MACULA_RAY_BLOCK * MACULA_RAY_BLOCK;
        ray_totals[ray_class] += *total;
    }
    uint x0, y0, slot = offsets[packet];
    pixel_of_slot(packet * MACULA_RAY_BLOCK, frame->width, &x0, &y0);
    for (uint bits = masks[packet]; bits != 0u; bits &= bits - 1u, ++slot) {
        const uint lane = popcount((bits & -bits) - 1u);
        const uint x = x0 + (lane & 3u), y = y0 + (lane >> 2);
        const uint block = (uint)block_of_pixel(rings, (int)x, (int)y);
        pixels[slot] = y * frame->width + x;
        spreads[slot] = (float)block;
        write_ray(frame, sample, x, y, (float)min(block, frame->width - x),
                  (float)min(block, frame->height - y), rays, slot);
    }
}
