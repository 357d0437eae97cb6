/* Up to 32 rays of one octant, in no other way alike, through the lower level in one traversal:
 * a node is loaded once for all rays that reach it. Layout wide8_block. (After Tsakok 2009,
 * "Faster Incoherent Rays: Multi-BVH Ray Stream Tracing".) OpenCL C only. */
#ifndef MACULA_LIB_WIDE_STREAM_H
#define MACULA_LIB_WIDE_STREAM_H

#include "lib/simd.h"
#include "lib/wide_block.h"

/* Each level leaves at most seven siblings behind. */
#define MACULA_WIDE_STACK (7 * MACULA_MAX_DEPTH + 8)

/* Bit k of a ray mask stands for ray k of the chunk. */
typedef struct StreamEntry {
    int child;
    uint rays;
} StreamEntry;

typedef struct StreamStack {
    StreamEntry entry[MACULA_WIDE_STACK];
    float near[MACULA_ANY_HIT ? 1 : MACULA_WIDE_STACK];
    uint depth;
} StreamStack;

static inline uint first_ray(uint rays) {
    return 31u - (uint)clz(rays & (~rays + 1u));
}

/* What the rays find in a node: lane c of `rays` is the mask of those that enter child c, lane c of
 * `near` the least t at which one does. */
typedef struct StreamChildren {
    int8 rays;
    float8 near;
} StreamChildren;

static inline StreamChildren enter_children8(global const Wide8Node* node, const StreamRay* stream,
                                             uint rays, uint octant) {
    const uint sx = octant & 1u, sy = (octant >> 1) & 1u, sz = octant >> 2;
    const float8 near_x = vload8(0, node->plane[0][sx]), far_x = vload8(0, node->plane[0][sx ^ 1u]);
    const float8 near_y = vload8(0, node->plane[1][sy]), far_y = vload8(0, node->plane[1][sy ^ 1u]);
    const float8 near_z = vload8(0, node->plane[2][sz]), far_z = vload8(0, node->plane[2][sz ^ 1u]);
    StreamChildren found;
    found.rays = 0;
    found.near = MACULA_EMPTY;
    do {
        const uint k = first_ray(rays);
        rays &= rays - 1u;
        const TraceRay* r = &stream[k].query.ray;
        float8 near, far;
        box_interval8(r, near_x, near_y, near_z, far_x, far_y, far_z, &near, &far);
        const int8 enters = near <= m_min8(far, (float8)(r->t_max));
        found.rays |= enters & (int8)((int)(1u << k));
        found.near = enters ? m_min8(found.near, near) : found.near;
    } while (rays != 0u);
    return found;
}

static inline void fetch_child(const TraceScene* scene, int child) {
    if (child >= 0) {
        global const Wide8Node* node = (global const Wide8Node*)scene->nodes + child;
        MACULA_FETCH(node, 0);
        MACULA_FETCH(node, 64);
        MACULA_FETCH(node, 128);
        MACULA_FETCH(node, 192);
    } else {
        global const TriangleBlock8* block = (global const TriangleBlock8*)scene->triangles +
                                             ((uint)~child >> MACULA_LEAF_COUNT_BITS);
        MACULA_FETCH(block, 0);
        MACULA_FETCH(block, 64);
        MACULA_FETCH(block, 128);
        MACULA_FETCH(block, 192);
        MACULA_FETCH(block, 256);
    }
}

#if MACULA_ANY_HIT
/* The child with most rays is visited first. */
static inline void push_children(const TraceScene* scene, global const Wide8Node* node,
                                 StreamChildren found, StreamStack* stack) {
    ulong lanes = lane_mask8(found.rays != 0);
    if (lanes == 0ul)
        return;
    StreamEntry top = {0, 0u};
    uint most = 0u;
    do {
        const uint i = first_lane8(lanes);
        lanes = without_lane8(lanes, i);
        StreamEntry entry;
        entry.child = node->child[i];
        fetch_child(scene, entry.child);
        entry.rays = ((const uint*)&found.rays)[i];
        const uint count = popcount(entry.rays);
        const bool more = count > most;
        if (most != 0u)
            stack->entry[stack->depth++] = more ? top : entry;
        top = more ? entry : top;
        most = more ? count : most;
    } while (lanes != 0ul);
    stack->entry[stack->depth++] = top;
}
#else
/* The nearest child is visited first. */
static inline void push_children(const TraceScene* scene, global const Wide8Node* node,
                                 StreamChildren found, StreamStack* stack) {
    ulong lanes = lane_mask8(found.rays != 0);
    const uint base = stack->depth;
    while (lanes != 0ul) {
        const uint lane = first_lane8(lanes);
        lanes = without_lane8(lanes, lane);
        const float near = ((const float*)&found.near)[lane];
        uint i = stack->depth++;
        for (; i > base && stack->near[i - 1u] < near; --i) {
            stack->near[i] = stack->near[i - 1u];
            stack->entry[i] = stack->entry[i - 1u];
        }
        stack->near[i] = near;
        fetch_child(scene, node->child[lane]);
        stack->entry[i].child = node->child[lane];
        stack->entry[i].rays = ((const uint*)&found.rays)[lane];
    }
}
#endif

/* Returns the rays whose query is answered. */
static inline uint test_leaf_of_rays(const TraceScene* scene, StreamRay* stream, int leaf,
                                     uint rays) {
    uint answered = 0u;
    for (; rays != 0u; rays &= rays - 1u) {
        const uint k = first_ray(rays);
        if (test_leaf_of_stream(scene, stream + k, leaf))
            answered |= 1u << k;
    }
    return answered;
}

/* Returns the rays whose query is answered. */
static inline uint traverse_stream(const TraceScene* scene, StreamRay* stream, int root, uint rays,
                                   uint octant) {
    global const Wide8Node* nodes = (global const Wide8Node*)scene->nodes;
    uint answered = 0u;
    StreamStack stack;
    stack.entry[0].child = root;
    stack.entry[0].rays = rays;
    stack.near[0] = 0.0f;
    stack.depth = 1u;
    while (stack.depth != 0u) {
        const StreamEntry entry = stack.entry[--stack.depth];
        const uint left = entry.rays & ~answered;
        if (left == 0u)
            continue;
        if (entry.child >= 0) {
            global const Wide8Node* node = nodes + entry.child;
            push_children(scene, node, enter_children8(node, stream, left, octant), &stack);
        } else {
            answered |= test_leaf_of_rays(scene, stream, entry.child, left);
            if (answered == rays)
                return answered;
        }
    }
    return answered;
}

#endif
