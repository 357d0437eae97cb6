/* The support image and support G-buffer: every frame's coarse, regular part (Weier et al. 2016,
 * section 3). */
#include "lib/camera.h"
#include "shared/weier.h"

/* One work-item a slot of the list. `columns`, `rows`: from pixel to support sample, or
 * MACULA_NO_CELL. geometry: the geometric normal, w: the depth. */
kernel void
extract_support(global const FrameParams* restrict frame, global const WeierParams* restrict weier,
                global const uint* restrict columns, global const uint* restrict rows,
                global const uint* restrict ray_count, global const uint* restrict pixels,
                global const float4* restrict sampled_colour, global const float* restrict depth,
                global const float4* restrict normal, global float4* restrict image,
                global float4* restrict geometry) {
    const uint slot = (uint)get_global_id(0);
    if (slot >= *ray_count || pixels[slot] == MACULA_NO_PIXEL)
        return;
    const uint pixel = pixels[slot];
    const uint y = pixel / frame->width, x = pixel - y * frame->width;
    const uint i = columns[x], j = rows[y];
    if (i == MACULA_NO_CELL || j == MACULA_NO_CELL)
        return;
    const uint index = j * weier->support_width + i;
    image[index] = sampled_colour[slot];
    geometry[index] = (float4)(normal[slot].xyz, depth[slot]);
}
