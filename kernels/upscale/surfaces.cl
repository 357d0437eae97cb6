/* Depth and motion of samples on their way from slots to pixels. */
#include "lib/camera.h"
#include "shared/planes.h"
#include "upscale/normals.h"

/* One work-item a slot. Samples of pixels go to the planes; others, of kernel log-polar foveation,
 * to its texels: depth, motion, the normal as a set. */
kernel void place_surfaces(global const FrameParams* restrict frame,
                           global const uint* restrict ray_count,
                           global const uint* restrict places, global const float* restrict depths,
                           global const float2* restrict motions,
                           global const float4* restrict normals, global float* restrict planes,
                           global float4* restrict texels) {
    const uint slot = (uint)get_global_id(0);
    if (slot >= *ray_count || places[slot] == MACULA_NO_PIXEL)
        return;
    const uint pixels = frame->width * frame->height, place = places[slot];
    const float depth = depths[slot];
    const float2 motion = motions[slot];
    const float3 normal = normals[slot].xyz;
    if (place < pixels) {
        planes[MACULA_PLANE_DEPTH * pixels + place] = depth;
        planes[MACULA_PLANE_MOTION_X * pixels + place] = motion.x;
        planes[MACULA_PLANE_MOTION_Y * pixels + place] = motion.y;
        planes[MACULA_PLANE_NORMAL * pixels + place] = pack_normal(normal);
    } else {
        texels[place - pixels] = (float4)(depth, motion, (float)normal_set(normal));
    }
}
