/* Sixteen rays a work-item, for CPUs: a frustum of the packet is tested against the eight boxes of
 * a node, then the sixteen rays against each box that the frustum enters (after Wald, Boulos and
 * Shirley 2007, "Ray Tracing Deformable Scenes", section 4, and Benthin and Wald 2009, "Efficient
 * Ray Traced Soft Shadows using Multi-Frusta Tracing"). Rays that have little in common are traced
 * one by one, so that no queue is a hazard. */
#include "lib/packet_scene.h"

kernel void trace(TRACE_ARGUMENTS) {
    const uint first = first_of_spread(*ray_count, MACULA_RAY_BLOCK);
    if (first >= *ray_count)
        return;
    const TraceScene scene = MACULA_TRACE_SCENE;
    trace_packet(&scene, rays, first, *ray_count, results);
}
