/* One ray at a time through layout wide8_single: what the packet variants do with rays that have
 * little in common. OpenCL C only. */
#ifndef MACULA_LIB_WIDE_SINGLE_H
#define MACULA_LIB_WIDE_SINGLE_H

#include "lib/traverse_query.h"
#include "lib/traverse_wide8.h"
#include "lib/wide_stack.h"

static inline bool traverse_lower(const TraceScene* scene, TraceQuery* query, int root) {
    global const Wide8Node* nodes = (global const Wide8Node*)scene->nodes;
    WideStack stack;
    uint depth = push_child(&stack, 0u, 0u, root, 0.0f);
    while (depth != 0u) {
        const int child = stack.child[--depth];
#if !MACULA_ANY_HIT
        if (stack.near[depth] > query->ray.t_max)
            continue;
#endif
        if (child < 0) {
            if (test_leaf(scene, query, child))
                return true;
            continue;
        }
        float8 near;
        ulong lanes = enter_wide8(nodes + child, &query->ray, &near);
        const uint base = depth;
        while (lanes != 0ul) {
            const uint i = first_lane8(lanes);
            lanes = without_lane8(lanes, i);
            depth =
                push_child(&stack, base, depth, nodes[child].child[i], ((const float*)&near)[i]);
        }
    }
    return false;
}

#include "lib/traverse_scene.h"

static inline void trace_single_rays(const TraceScene* scene, global const RayBlock* rays,
                                     uint first, uint count, global uint* results) {
    const uint end = count - first < MACULA_RAY_BLOCK ? count : first + MACULA_RAY_BLOCK;
    for (uint i = first; i < end; ++i)
        trace_ray(scene, rays, i, results);
}

#endif
