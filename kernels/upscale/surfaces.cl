/* Depth and motion of samples on their way from slots to pixels. */
#include "upscale/follow.h"

/* What is seen at a place in the world does not move as if it stood still. */
static inline bool moves_by_itself(global const FrameParams* frame, float3 position,
                                   float2 motion) {
    global const Camera *now = &frame->camera, *then = &frame->previous_camera;
    float x, y, past_x, past_y;
    const bool seen = camera_project(now, frame->width, frame->height,
                                     sub3(position, vector_at(now->origin)), &x, &y) &
                      camera_project(then, frame->width, frame->height,
                                     sub3(position, vector_at(then->origin)), &past_x, &past_y);
    const float apart = m_max(fabs(past_x - (x + motion.x)), fabs(past_y - (y + motion.y)));
    return seen && fabs(motion.x) < MACULA_NO_MOTION && apart > OWN_MOTION;
}

/* One work-item a slot. Samples of pixels go to the planes; others, of kernel log-polar foveation,
 * to its texels: depth, motion, the normal as a set, the set's negative if it moves by itself.
 * positions: null where there are no texels. */
kernel void place_surfaces(global const FrameParams* restrict frame,
                           global const uint* restrict ray_count,
                           global const uint* restrict places, global const float* restrict depths,
                           global const float2* restrict motions,
                           global const float4* restrict normals,
                           global const float4* restrict positions, global float* restrict planes,
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
        const float set = (float)normal_set(normal);
        const bool moves = depth < FAR_AWAY && moves_by_itself(frame, positions[slot].xyz, motion);
        texels[place - pixels] = (float4)(depth, motion, moves ? -set : set);
    }
}
