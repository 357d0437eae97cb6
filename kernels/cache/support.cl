/* The support image and support G-buffer: every frame's coarse, regular part (Weier et al. 2016,
 * section 3). */
#include "lib/camera.h"
#include "shared/weier.h"

/* Bit n: pixel n of four in a row or column belongs to the grid. */
static inline uint on_grid(global const uint* cells, uint first) {
    const int4 on = (vload4(0, cells + first) != MACULA_NO_CELL) & (int4)(1, 2, 4, 8);
    const int2 half_of = on.lo | on.hi;
    return (uint)(half_of.x | half_of.y);
}

/* One work-item a packet, so that the list is read in its order; all of the grid is in it.
 * `columns`, `rows`: from pixel to support sample, or MACULA_NO_CELL, as far as the tiles reach.
 * geometry: the geometric normal, w: the depth; triangles may be null. */
kernel void extract_support(global const FrameParams* restrict frame,
                            global const WeierParams* restrict weier,
                            global const uint* restrict columns, global const uint* restrict rows,
                            global const uint* restrict masks, global const uint* restrict offsets,
                            global const float4* restrict sampled_colour,
                            global const float* restrict depth,
                            global const float4* restrict normal,
                            global const uint* restrict triangle, global float4* restrict image,
                            global float4* restrict geometry, global uint* restrict triangles) {
    const uint packet = (uint)get_global_id(0);
    uint x0, y0;
    pixel_of_slot(packet * 16u, frame->width, &x0, &y0);
    const uint across = on_grid(columns, x0), down = on_grid(rows, y0);
    const uint sampled = masks[packet] & 0xffffu, first = offsets[packet];
    for (uint y = 0u; down >> y != 0u; ++y)
        for (uint x = 0u; (down >> y & 1u) != 0u && across >> x != 0u; ++x) {
            if ((across >> x & 1u) == 0u)
                continue;
            const uint slot = first + popcount(sampled & ((1u << (4u * y + x)) - 1u));
            const uint index = rows[y0 + y] * weier->support_width + columns[x0 + x];
            image[index] = sampled_colour[slot];
            geometry[index] = (float4)(normal[slot].xyz, depth[slot]);
            if (triangles)
                triangles[index] = triangle[slot];
        }
}
